#pragma once
// From a scene to a simulation that runs, in one step.

#include "contact/contact.hpp"
#include "dynamics/measure.hpp"
#include "model/fault.hpp"
#include "model/meshes.hpp"
#include "model/scene.hpp"

namespace nereid::model {

/// Everything that a run needs. Only build() makes one, so nothing in it is half built.
struct Simulation {
  dynamics::Model model;
  dynamics::State state;
  dynamics::Forces forces;
  std::vector<contact::InitialGaps> gaps;  ///< beside Model::interfaces
  dynamics::Time time;
  Recording recording;
  /// Those of the scene, and what a driver adds before the run. A probe without a name is no column of the history.
  std::vector<dynamics::Probe> probes;
  std::vector<Stop> stops;
  MeshWarnings mesh_warnings;
};

/// Builds meshes, elements, planes, loads and contacts, and the state at the start.
///
/// Throws SceneError with all faults: first of values and names as they are given, then of what only the meshes show, as names that
/// name nothing, maps that turn elements inside out, planes against one another, nodes behind a floor, penetrations, functions that give
/// no number.
Simulation build(const Scene&);

/// Runs a simulation to its end, to what its conditions ask for, or to what stops it; or on from where it was left.
dynamics::Outcome run(Simulation&, std::span<const dynamics::Observer> observers = {}, const dynamics::Interrupt& interrupt = {});

/// What observers and probes would see of a simulation as it stands.
dynamics::View view(const Simulation&);

/// What a probe remembers of the run so far. Throws InternalError if there is none of that name or nothing was run.
const dynamics::ProbeMemory& probe(const Simulation&, const std::string& name);

}  // namespace nereid::model
