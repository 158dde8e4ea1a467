#include "model/stages.hpp"

#include <algorithm>
#include <cmath>

#include "base/words.hpp"
#include "model/actions.hpp"
#include "model/names.hpp"
#include "model/rigid_bodies.hpp"
#include "model/values.hpp"

namespace nereid::model {

namespace {

using Names = std::vector<std::string>;

Part part_of(const Stage& stage) { return part("stage", stage); }

/// Why something is on in all stages; empty if it can be off.
std::string always_on(const Scene& scene, const std::string& name) {
  const auto named = [&](const auto& all) {
    return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
  };
  if (name == "gravity") return "gravity";
  if (named(scene.contacts) || named(scene.automatic_contacts)) return "a contact";
  if (named(scene.rigid_planes)) return "a rigid plane";
  if (named(scene.springs)) return "a spring";
  for (const Plane& plane : scene.planes) {
    if (plane.name != name) continue;
    if (plane.kind == load::PlaneKind::floor) return "a floor";
    if (plane.kind == load::PlaneKind::symmetry) return "a symmetry plane";
  }
  return "";
}

void check_off(const Scene& scene, const Stage& stage, Faults& faults) {
  Names can_be_off;
  for (const Plane& plane : scene.planes)
    if (always_on(scene, plane.name).empty()) can_be_off.push_back(plane.name);
  for (const Load& load : scene.loads) can_be_off.push_back(load.name);
  for (std::size_t i = 0; i < stage.off.size(); ++i) {
    const std::string key = "off[" + std::to_string(i) + "]", why = always_on(scene, stage.off[i]);
    if (!why.empty()) refuse(faults, part_of(stage), key, quote(stage.off[i]) + " is " + why + ", which acts in all stages");
    else expect(faults, part_of(stage), key, stage.off[i], "planes and loads that can be off", can_be_off);
  }
}

void refuse_velocities(const std::vector<Initial>& initial, const char* what, Faults& faults) {
  for (const Initial& one : initial)
    if (!one.displacement)
      refuse(faults, {one.at, "initial motion of '" + one.body + "'"}, "velocity",
             quote(one.body) + " has a velocity, and " + what + " would bring it to rest: give the velocity in a later stage");
}

bool is_on(const StageOfRun& stage, const std::string& name) { return !has(stage.off, name); }

}  // namespace

void check_stages(const Scene& scene, Faults& faults) {
  const bool relaxes = scene.stages.empty() ? scene.relaxation.has_value() : scene.stages.front().relaxation.has_value();
  if (relaxes) refuse_velocities(scene.initial, "relaxation", faults);
  if (scene.stages.empty()) return;
  if (scene.relaxation) refuse(faults, {"relaxation", "relaxation"}, "", "'relaxation' belongs to a stage, where there are 'stages'");
  Names names;
  double end = 0;
  for (const Stage& stage : scene.stages) {
    if (!is_name(stage.name)) refuse(faults, part_of(stage), "name", is_no_name(stage.name));
    if (has(names, stage.name)) refuse(faults, part_of(stage), "name", "'name' = " + stage.name + " is given twice");
    names.push_back(stage.name);
    end += stage.duration;
    check_duration(part_of(stage), stage.duration, faults);
    if (stage.relaxation) check_relaxation(part_of(stage), "relaxation.", *stage.relaxation, faults);
    check_off(scene, stage, faults);
    if (stage.relaxation) refuse_velocities(stage.initial, "this stage", faults);
    for (const Initial& one : stage.initial)
      if (one.displacement)
        refuse(faults, {one.at, "initial motion of '" + one.body + "'"}, "displacement",
               "a stage gives velocities: displacements belong to 'initial' of the scene");
  }
  if (!(std::abs(scene.time.end - end) <= 1e-9 * end))
    refuse(faults, {"time", "time"}, "end",
           "'end' = " + shortest(scene.time.end) + " s is not the sum of the stages, " + shortest(end) + " s");
}

load::Constraints constraints_in(const Stage& stage, const load::Constraints& all) {
  load::Constraints here = all;
  for (load::Plane& plane : here.planes)
    if (has(stage.off, plane.name)) plane.nodes.clear();
  return here;
}

std::optional<dynamics::Relaxation> any_relaxation(const Scene& scene) {
  for (const Stage& stage : scene.stages)
    if (stage.relaxation) return stage.relaxation;
  return scene.relaxation;
}

std::vector<StageOfRun> make_stages(const Scene& scene, const load::Constraints& all, dynamics::Model& model, Faults& faults) {
  std::vector<StageOfRun> stages;
  for (const Stage& stage : scene.stages) {
    StageOfRun made{.name = stage.name, .duration = stage.duration, .relaxation = stage.relaxation, .off = stage.off,
                    .constraints = constraints_in(stage, all)};
    hold_rigid_bodies(scene, made.constraints, model, faults);
    made.held = model.held_bodies;
    for (const rigid::Body& body : model.rigid_bodies) made.holds.push_back(body.hold);
    if (stage.relaxation) refuse_to_relax_free_bodies(part_of(stage), model, faults);
    if (!stages.empty()) refuse_late_holds(scene, stages.back().constraints, made.constraints, model, faults);
    stages.push_back(std::move(made));
  }
  if (stages.empty()) return stages;
  model.constraints = stages.front().constraints;
  model.held_bodies = stages.front().held;
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) model.rigid_bodies[b].hold = stages.front().holds[b];
  return stages;
}

void set_velocities_of_stages(const Scene& scene, Simulation& simulation, Faults& faults) {
  for (std::size_t k = 0; k < scene.stages.size(); ++k) {
    StageOfRun& stage = simulation.stages[k];
    stage.velocity = Vectors::Zero(3, simulation.state.v.cols()), stage.spin = Vectors::Zero(3, simulation.state.omega.cols());
    add_velocities(scene.stages[k].initial, simulation.model, stage.velocity, stage.spin, faults);
    refuse_no_rigid_motions(scene.stages[k].initial, simulation.model, stage.velocity, faults);
    if (k > 0) continue;
    simulation.state.v += stage.velocity, simulation.state.omega += stage.spin;
    simulation.state.progress.stages = {0};
  }
  simulation.all_loads = simulation.model.loads;
  if (!simulation.stages.empty()) set_model_of_stage(simulation);
}

void set_model_of_stage(Simulation& simulation) {
  dynamics::Model& model = simulation.model;
  const std::vector<double>& began = simulation.state.progress.stages;
  const StageOfRun& stage = simulation.stages[began.size() - 1];
  const auto start = [&](const std::string& name) {  // [s] of the first stage in which it is on
    for (std::size_t k = 0; k < began.size(); ++k)
      if (is_on(simulation.stages[k], name)) return began[k];
    return 0.0;
  };
  model.constraints = stage.constraints;
  for (load::Plane& plane : model.constraints.planes) {
    const double from = start(plane.name);
    plane.velocity = load::in_stage(plane.velocity, true, from);
    for (auto* field : {&plane.field, &plane.angular_velocity})
      for (load::OverSpace& value : *field) value = load::in_stage(value, true, from);
  }
  model.held_bodies = stage.held;
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) model.rigid_bodies[b].hold = stage.holds[b];
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const std::string& name = load::name(simulation.all_loads[l]);
    model.loads[l] = load::in_stage(simulation.all_loads[l], is_on(stage, name), start(name));
  }
  model.relaxes = stage.relaxation.has_value();
  if (!model.relaxes) return;
  model.relaxation = stage.relaxation;
  model.relaxation->after += began.back();
}

void begin_next_stage(Simulation& simulation) {
  dynamics::State& state = simulation.state;
  state.progress.stages.push_back(state.t);
  set_model_of_stage(simulation);
  simulation.forces = dynamics::make_forces(simulation.model);
  const StageOfRun& stage = simulation.stages[state.progress.stages.size() - 1];
  dynamics::change(simulation.model, stage.velocity, stage.spin, state, simulation.forces);
}

}  // namespace nereid::model
