#pragma once
// Readers of a whole scene: bodies, contacts, planes, loads, probes and conditions. Syntax: docs/scene.md.
//
//     const model::Scene scene = input::read_scene(file.root());
//     model::Simulation simulation = input::build(file, scene);

#include "input/section.hpp"
#include "model/build.hpp"

namespace nereid::input {

/// Reads a scene, with all faults that can be found without meshes: names given twice, conditions on no probe.
model::Scene read_scene(const Section& root);

/// A probe as conditions see it.
struct Measured {
  std::string name;
  std::string unit;  ///< SI; empty where the probe is at fault
};

/// Probes of a scene as conditions see them.
std::vector<Measured> measured_by(const std::vector<model::Probe>&);

/// Reads the list `stop`, for drivers with probes of their own: what a driver reads here it puts into Simulation::stops.
std::vector<model::Stop> read_stops(const Section& root, const std::vector<Measured>& probes, const model::Recording&);

/// Reads of a scene what it is at rest: bodies, planes, springs and point masses. The rest is listed as not used.
///
/// Faults: contacts, floors and rigid planes, which are nothing that small motions about rest could keep.
model::Scene read_scene_at_rest(const Section& root);

/// model::build of a scene that was read from this case: calls finish() of the file first, and tells what only the meshes
/// show at its place in the file. Throws CaseError.
model::Simulation build(const CaseFile&, const model::Scene&);

}  // namespace nereid::input
