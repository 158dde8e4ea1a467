#pragma once
// Stages of a run: which planes and loads act in each, whether it looks for an equilibrium, and what bodies are given as it begins.

#include "model/build.hpp"

namespace nereid::model {

/// Faults of stages that need no mesh: names, durations, things that cannot be off, velocities given where a stage relaxes.
void check_stages(const Scene&, Faults&);

/// The planes of a stage: those that are off have no nodes.
load::Constraints constraints_in(const Stage&, const load::Constraints& all);

/// What relaxes in a scene, in any stage: the model has an account for it.
std::optional<dynamics::Relaxation> any_relaxation(const Scene&);

/// Makes the stages of a model that has its planes and rigid bodies; the planes of the first one stand in the model then.
///
/// all  planes with their nodes
std::vector<StageOfRun> make_stages(const Scene&, const load::Constraints& all, dynamics::Model&, Faults&);

/// Adds to a stage the velocities that it gives to bodies. Faults: values that are no numbers, no rigid motions of rigid bodies.
void set_velocities_of_stages(const Scene&, Simulation&, Faults&);

/// Puts planes, loads and relaxation of the stage that runs into the model: the last of Progress::stages.
void set_model_of_stage(Simulation&);

/// Begins the stage after the one that runs, in the state that it has left.
void begin_next_stage(Simulation&);

}  // namespace nereid::model
