#include "drivers/forecast.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "base/memory.hpp"
#include "base/words.hpp"
#include "dynamics/balance.hpp"
#include "dynamics/footing.hpp"
#include "dynamics/overlaps.hpp"
#include "dynamics/quality.hpp"
#include "model/usual_frames.hpp"
#include "output/recorder.hpp"

namespace nereid::driver {

namespace {

constexpr int least_steps = 5, most_steps = 50;
constexpr double long_enough = 0.02;     // [s] for the steps of a rehearsal
constexpr double strain = 0.01;          // [-] that shaking leads to: beyond the yield point of metals
constexpr double waves = 2.7;            // [-] in a body: no multiple of its cells

double seconds_of(const std::function<void()>& work) {
  const auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

/// Whether the nodes of a block lie at more than two places along an axis: a bar of one cell across does not, and nothing varies there.
bool varies(const Vectors& X, const element::Connectivity& nodes, int axis) {
  double low = 1e300, high = -1e300;
  for (const Index node : nodes.reshaped()) low = std::min(low, X(axis, node)), high = std::max(high, X(axis, node));
  const double close = 1e-6 * (high - low);
  const auto between = [&](Index node) { return X(axis, node) > low + close && X(axis, node) < high - close; };
  const auto all = nodes.reshaped();
  return std::any_of(all.begin(), all.end(), between);
}

/// Adds waves to the velocities of all bodies, so that all that a frame shows is in motion. Where nothing varies, nothing is added.
void shake(const dynamics::Model& model, double duration, dynamics::State& now) {
  const Vectors& X = model.mesh.X;
  const Vec3 size = X.rowwise().maxCoeff() - X.rowwise().minCoeff();
  std::vector<char> shaken(static_cast<std::size_t>(X.cols()), 0);
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    if (dynamics::is_rigid_block(model, b)) continue;
    const element::Connectivity& nodes = element::nodes(model.blocks[b]);
    Vec3 wave = Vec3::Zero();  // [1/m]
    for (int axis = 0; axis < 3; ++axis)
      if (varies(X, nodes, axis)) wave(axis) = 2 * pi * waves * (1 + 0.1 * axis) / size(axis);
    const bool plates = element::rotates(model.blocks[b]);
    if (wave.isZero(0)) wave = Vec3::Constant(2 * pi / size.norm());
    const double speed = strain / (duration * wave.norm());
    for (const Index node : nodes.reshaped()) {
      if (shaken[static_cast<std::size_t>(node)]) continue;
      shaken[static_cast<std::size_t>(node)] = 1;
      for (int axis = 0; axis < 3; ++axis)
        if (plates || wave(axis) > 0) now.v(axis, node) += speed * std::sin(wave.dot(X.col(node)) + axis);
    }
  }
}

/// What a rehearsal measures: times [s] and bytes, each of one.
struct Costs {
  double step = 0, row = 0, frame = 0, look = 0;
  double row_bytes = 0, frame_bytes = 0, first_frame_bytes = 0, walls_bytes = 0, summary_bytes = 0;
};

/// A frame as a run makes it, both grids at once, after one that has packed what does not change.
double bytes_of_frame(const dynamics::View& view, const model::Recording& recording, std::array<grid::Kept, 2>& kept) {
  const output::Precision precision = output::output_precision(recording);
  const output::FrameFields which = output::frame_fields(recording);
  const output::Grid body = output::body_grid(view, which), contact = output::contact_grid(view, which);
  return static_cast<double>(grid::bytes_of(body, output::GridKind::volume, precision, &kept[0]) +
                             grid::bytes_of(contact, output::GridKind::surface, precision, &kept[1]));
}

/// One line of a .pvd for each frame, and its four others.
double bytes_of_index(const std::string& name, double frames) {
  if (!grid::vtk_available()) return 0;
  return 113 + frames * (71 + 2 * static_cast<double>(name.size()));
}

/// A row of the history as it will be when contacts that are open have closed: no probe is zero, and nothing that they hold.
std::vector<double> filled(std::vector<double> row, const std::vector<output::Column>& columns, const dynamics::Model& model) {
  constexpr double long_number = 1e-7 / 3;  // has as many digits as most
  std::vector<std::string> of_contacts;
  const auto add = [&of_contacts](const std::string& name) {
    for (const char* what : {"_restitution", "_penalty", "_friction"}) of_contacts.push_back("energy_" + name + what);
    of_contacts.push_back("energy_created_" + name);
  };
  for (const contact::AnyContact& any : model.contacts)
    if (contact::side_of(any) > 0 || contact::sides(any).heights != contact::Heights::guards) add(contact::sides(any).name);
  for (const contact::RigidPlane& plane : model.rigid_planes) add(plane.name);
  for (std::size_t c = 0; c < row.size(); ++c) {
    const std::string& name = columns[c].name;
    const bool is_probe = name.rfind("energy_", 0) != 0 && !of_contacts.empty();
    if (row[c] == 0 && (is_probe || std::find(of_contacts.begin(), of_contacts.end(), name) != of_contacts.end())) row[c] = long_number;
  }
  return row;
}

/// Runs on to a time, and returns what a step takes that is no row. [s]
double seconds_of_a_step(model::Simulation& simulation, double end) {
  std::vector<double> stamps, steps;
  const dynamics::Observer stamp = [&stamps](const dynamics::View&) {
    stamps.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count());
  };
  dynamics::Time time = simulation.time;
  time.end = end;
  dynamics::run(simulation.model, simulation.state, simulation.forces, time, end,
                {.probes = simulation.probes, .observers = {&stamp, 1}, .until = {}});
  for (std::size_t s = 1; s < stamps.size(); ++s) steps.push_back(stamps[s] - stamps[s - 1]);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// Steps of the scene, then what a row, a frame and a look for overlaps take.
///
/// dt  [s] of a step
/// Needs  a simulation that has been started by a run
Costs rehearse(model::Simulation& simulation, double dt, const std::function<std::size_t()>& summary) {
  const dynamics::Model& model = simulation.model;
  dynamics::State& now = simulation.state;
  dynamics::Forces& forces = simulation.forces;
  const output::Precision precision = output::output_precision(simulation.recording);
  const auto view = [&] { return dynamics::View{model, now, forces, true}; };
  Costs costs;
  std::array<grid::Kept, 2> kept;
  costs.first_frame_bytes = bytes_of_frame(view(), simulation.recording, kept);
  costs.walls_bytes = static_cast<double>(grid::bytes_of(output::walls_grid(view()), output::GridKind::surface, precision));
  costs.look = seconds_of([&] { dynamics::update_overlaps(model, true, 0, now, forces); });
  costs.step = seconds_of_a_step(simulation, least_steps * dt);
  if (costs.step * least_steps < long_enough) costs.step = seconds_of_a_step(simulation, most_steps * dt);
  const dynamics::Pace pace{.safety = simulation.time.safety};
  shake(model, least_steps * dynamics::choose_step(now.step_limits, pace.safety).dt, now);
  for (int s = 0; s < least_steps && now.step_limits.volume_ratio > 0; ++s)
    dynamics::step(model, dynamics::next_length(now.step_limits, pace, now.t, now.dt), pace, now, forces);

  const std::vector<dynamics::Probe> ledger = dynamics::ledger_probes(model);
  std::string text;
  const auto add_row = [&] {
    text.clear();
    dynamics::update_ledger(model, now);
    dynamics::check_artificial_energy(model, now);
    dynamics::look_at_footings(model, now);
    for (std::size_t p = 0; p < now.probes.size(); ++p) dynamics::sample_row(simulation.probes[p], view(), now.probes, now.probes[p]);
    const std::vector<double> row = output::row_of(view(), simulation.probes, ledger);
    output::append_row(now.t, filled(row, output::columns_of(simulation.probes, ledger), model), text);
  };
  add_row();  // the first one takes longer than all others
  costs.row = seconds_of(add_row);
  costs.row_bytes = static_cast<double>(text.size());
  costs.summary_bytes = static_cast<double>(summary());
  costs.frame = seconds_of([&] { costs.frame_bytes = bytes_of_frame(view(), simulation.recording, kept); });
  return costs;
}

/// Contacts that are open at the start, and the nodes of their surfaces.
struct Open {
  std::vector<std::string> names;
  double apexes = 0;
};
Open open_contacts(const dynamics::Model& model, const dynamics::State& now) {
  Open open;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const contact::Interface* interface = contact::interface_of(model.contacts[c]);
    if (interface == nullptr) continue;
    const auto& near = std::get<contact::Memory>(now.contacts[c]).near;
    if (std::any_of(near.begin(), near.end(), [](const contact::Near& one) { return one.element.closed; })) continue;
    open.apexes += static_cast<double>(interface->apexes.size());
    if (interface->pass != contact::Pass::back) open.names.push_back(quote(interface->name));
  }
  return open;
}

/// What a forecast cannot count: contacts that close later, and what ends a run before its time.
std::vector<std::string> not_counted(const model::Simulation& simulation, const Open& open, const Forecast& forecast, double step) {
  constexpr double updates = 5;       // of an element, as long as an apex in contact takes by multipliers: docs/cost.md
  constexpr double worth_saying = 0.5;  // of the seconds: with them twice as many are not far
  std::vector<std::string> lines;
  const double elements = static_cast<double>(dynamics::element_count(simulation.model));
  const double more = elements > 0 ? forecast.steps * updates * open.apexes * step / elements : 0;
  if (more > worth_saying * forecast.seconds)
    lines.push_back(listed(open.names) + (open.names.size() > 1 ? " are open at the start, and their" : " is open at the start, and its") +
                    formatted(" cost is not in the forecast: about %.2g s more if all %.0f nodes of the surfaces touched all the time",
                              more, open.apexes));
  const auto& stages = simulation.stages;
  const bool relaxes = std::any_of(stages.begin(), stages.end(), [](const auto& one) { return one.relaxation.has_value(); });
  if (relaxes || simulation.model.relaxation || !simulation.stops.empty())
    lines.push_back(std::string(simulation.stops.empty() ? "a relaxation" : "a condition") +
                    " may end the run earlier than forecast");
  return lines;
}

}  // namespace

Start start_of(model::Simulation& simulation) {
  dynamics::Time none = simulation.time;
  none.end = 0;
  dynamics::Outcome outcome = dynamics::run(simulation.model, simulation.state, simulation.forces, none, simulation.time.end,
                                            {.probes = simulation.probes, .observers = {}, .until = {}});
  if (outcome.ending == dynamics::Ending::not_relaxed) outcome = {};  // it has not had the time
  return {outcome, dynamics::choose_step(simulation.state.step_limits, simulation.time.safety)};
}

Forecast forecast(model::Simulation& simulation, const std::function<std::size_t()>& summary) {
  const dynamics::Time& time = simulation.time;
  Forecast found;
  found.start = start_of(simulation).outcome;
  found.step_limits = simulation.state.step_limits;
  found.expected = model::expected_steps(simulation);
  found.advice = model::step_advice(simulation, found.expected);
  for (const std::string& note : model::strain_notes(simulation)) found.advice.push_back(note);
  found.steps = model::count(found.expected, time.end);
  const auto times = [&](double every) { return 1 + std::min(found.steps, std::ceil(time.end / every - 1e-9)); };
  found.rows = times(simulation.recording.history);
  found.frames = std::min(found.rows, times(model::frames_every(simulation)));
  if (!(simulation.recording.frames > 0) && model::frames_every(simulation) > time.end / model::most_usual_frames)
    found.advice.push_back(formatted("%.0f frames in place of %.0f, so that they take no more than a tenth of the run; "
                                     "'output.frames_every' in the case sets another interval",
                                     found.frames, 1 + model::most_usual_frames));
  const double looks = std::min(found.rows, times(time.audit_every));

  const Open open = open_contacts(simulation.model, simulation.state);  // a rehearsal closes some
  const Costs costs = rehearse(simulation, found.expected.first.dt, summary);
  const auto head = output::head_text(output::columns_of(simulation.probes, dynamics::ledger_probes(simulation.model)));
  found.seconds = found.steps * costs.step + found.rows * costs.row + found.frames * costs.frame + looks * costs.look;
  const double frames = costs.first_frame_bytes + (found.frames - 1) * costs.frame_bytes + costs.walls_bytes;
  const double indices = bytes_of_index("body", found.frames) + bytes_of_index("contact", found.frames) + bytes_of_index("walls", 1);
  found.bytes = static_cast<double>(head.size()) + found.rows * costs.row_bytes + frames + indices + costs.summary_bytes;
  for (const std::string& line : not_counted(simulation, open, found, costs.step)) found.advice.push_back(line);
  found.memory = most_resident();
  return found;
}

std::string in_words(const Forecast& forecast) {
  return formatted("%.0f steps, %.3g s, %.0f rows, %.0f frames, %.5g MB of files, %.5g MB of memory", forecast.steps, forecast.seconds,
                   forecast.rows, forecast.frames, forecast.bytes / 1e6, forecast.memory / 1e6);
}

}  // namespace nereid::driver
