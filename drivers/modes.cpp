// Natural frequencies of a scene, by the stiffness and the mass with which it would run.
//
//        .--""--.                    .
//      -'        '-.        .-----       K u = omega^2 M u
//     |             '--..--'
//
// Question  How does a scene vibrate about rest, and how long a step could its run take?
// Answer    history.csv, a row per mode; summary.json; body.pvd, a frame per mode with its frequency as time
// Run       modes cases/modes/square_plate.yaml --out out/square_plate
//           modes cases/scene/taylor_bar.yaml --set modes.lowest=20 ...    a scene without contacts and walls

#include "dynamics/modes.hpp"
#include "drivers/driver.hpp"
#include "model/notes.hpp"

using namespace nereid;

constexpr double largest_displacement = 0.1;  // of a frame, over the size of the scene

/// The scene moved as a mode moves it; the frequency stands for the time.
output::Grid frame(const dynamics::Model& model, const dynamics::Mode& mode) {
  dynamics::State state = dynamics::initial_state(model, {});
  const dynamics::Forces forces = dynamics::make_forces(model);
  const double size = (model.mesh.X.rowwise().maxCoeff() - model.mesh.X.rowwise().minCoeff()).norm();
  const double most = mode.shape.colwise().norm().maxCoeff();
  if (most > 0) state.x += largest_displacement * size / most * mode.shape;
  state.t = mode.frequency;
  output::Grid grid = output::body_grid({model, state, forces, true});
  const auto keep = [](std::vector<Field>& fields) { std::erase_if(fields, [](const Field& field) { return !field.integer; }); };
  keep(grid.point_fields), keep(grid.cell_fields);  // forces and stresses are those of no motion
  return grid;
}

driver::Answer answer(const dynamics::Model& model, int lowest, int highest) {
  const dynamics::Modes modes = dynamics::find_modes(model, lowest, highest);
  driver::Answer found{.columns = {{"frequency", "Hz"}, {"residual", "1"}}, .time = {}, .rows = {}, .results = {}};
  found.counted = {"mode", "1"};
  found.elements = model::count_elements(model);
  const auto list = [&](const char* name, const std::vector<dynamics::Mode>& all) {
    for (std::size_t i = 0; i < all.size(); ++i) found.results.push_back({name + std::to_string(i + 1), all[i].frequency, "Hz"});
  };
  list("frequency_", modes.lowest);
  list("highest_frequency_", modes.highest);
  found.results.insert(found.results.end(), {{"without_stiffness", static_cast<double>(modes.without_stiffness), "1"},
                                             {"exact_step", modes.exact_step, "s"},
                                             {"voted_step", modes.voted_step, "s"},
                                             {"asymmetry", modes.asymmetry, "1"},
                                             {"freedoms", static_cast<double>(modes.freedoms), "1"},
                                             {"drilling_freedoms", static_cast<double>(modes.drilling), "1"}});
  // a frame at the time of another would replace it
  const double apart = modes.lowest.empty() ? 0 : 1e-9 * modes.lowest.back().frequency;
  for (std::size_t i = 0; i < modes.lowest.size(); ++i) {
    found.time.push_back(static_cast<double>(i + 1));
    found.rows.push_back({modes.lowest[i].frequency, modes.lowest[i].residual});
    found.frames.push_back(frame(model, modes.lowest[i]));
    if (i > 0) found.frames[i].time = std::max(found.frames[i].time, found.frames[i - 1].time + apart);
  }
  if (modes.without_stiffness > 0)
    found.notes.push_back(std::to_string(modes.without_stiffness) +
                          " of the lowest modes meet no stiffness: rigid motions or mechanisms, whose frequencies are round-off");
  if (modes.drilling > 0)
    found.notes.push_back(std::to_string(modes.drilling) +
                          " rotations of plate nodes about their normal, which no element resists, are left out");
  if (!modes.finite) {
    found.stopped = "not_finite";
    found.reason = "stiffness, or stiffness over mass, is beyond what numbers hold";
  } else if (!modes.complete) {
    found.stopped = "not_converged";
    found.reason = "some of the modes asked for were not found, or one was passed over";
  }
  return found;
}

std::function<driver::Answer()> plan(const input::CaseFile& file) {
  const model::Scene scene = input::read_scene_at_rest(file.root());
  const input::Section modes = file.root().section_or_empty("modes");
  const int lowest = modes.count_or("lowest", 10, 1, 1000), highest = modes.count_or("highest", 1, 1, 1000);
  model::Simulation simulation = input::build(file, scene);
  return [model = std::move(simulation.model), warnings = std::move(simulation.mesh_warnings), lowest, highest] {
    driver::Answer found = answer(model, lowest, highest);
    found.notes.insert(found.notes.begin(), warnings.texts.begin(), warnings.texts.end());
    found.offenders = warnings.offenders;
    return found;
  };
}

int main(int argc, char** argv) { return driver::answer(argc, argv, "modes", plan); }
