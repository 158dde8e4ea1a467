#pragma once
// From a scene to a simulation that runs, in one step.

#include "contact/contact.hpp"
#include "dynamics/measure.hpp"
#include "model/fault.hpp"
#include "model/meshes.hpp"
#include "model/scene.hpp"

namespace nereid::model {

/// A stage of a run: what it changes in the model.
struct StageOfRun {
  std::string name;
  double duration = 0;                             ///< [s] at most
  std::optional<dynamics::Relaxation> relaxation;  ///< empty: it does not relax
  std::vector<std::string> off;                    ///< planes and loads that do not act
  load::Constraints constraints = {};              ///< planes; those that are off have no nodes
  std::vector<dynamics::HeldBody> held = {};       ///< beside Model::rigid_bodies
  std::vector<rigid::Hold> holds = {};             ///< the same
  Vectors velocity = {}, spin = {};                ///< [m/s] [rad/s] that it gives to nodes and plate nodes as it begins
};

/// Everything that a run needs. Only build() makes one, so nothing in it is half built.
struct Simulation {
  dynamics::Model model;
  dynamics::State state;
  dynamics::Forces forces;
  std::vector<contact::InitialGaps> gaps;  ///< beside Model::contacts
  dynamics::Time time;
  Recording recording;
  /// Those of the scene, and what a driver adds before the run. A probe without a name is no column of the history.
  std::vector<dynamics::Probe> probes;
  std::vector<Stop> stops;               ///< looked at in the last stage
  std::vector<StageOfRun> stages;        ///< empty: the run has none; the one that runs is the last of Progress::stages
  std::vector<load::AnyLoad> all_loads;  ///< as the scene has them; the model has those of the stage that runs
  MeshWarnings mesh_warnings;
  std::vector<std::string> remarks;      ///< a line each: which element a probe at a place measures, materials that no element has
};

/// Builds meshes, elements, planes, loads and contacts, and the state at the start.
///
/// Throws SceneError with all faults: first of values and names as they are given, then of what only the meshes show, as names that
/// name nothing, maps that turn elements inside out, planes against one another, nodes behind a floor, penetrations, functions that give
/// no number.
Simulation build(const Scene&);

/// Runs a simulation through its stages to its end, to what its conditions ask for, or to what stops it; or on from where it was left.
dynamics::Outcome run(Simulation&, std::span<const dynamics::Observer> observers = {}, const dynamics::Interrupt& interrupt = {});

/// What observers and probes would see of a simulation as it stands.
dynamics::View view(const Simulation&);

/// What a probe remembers of the run so far. Throws InternalError if there is none of that name or nothing was run.
const dynamics::ProbeMemory& probe(const Simulation&, const std::string& name);

}  // namespace nereid::model
