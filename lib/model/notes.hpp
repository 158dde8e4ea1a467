#pragma once
// What a simulation says of itself in words: its bodies, gaps at the start, apexes that are too coarse, what sets its step, penetrations
// that are too deep, elements that are too distorted, energy that appears or vanishes.

#include <string>
#include <vector>

#include "model/build.hpp"

namespace nereid::model {

/// The table of bodies and their regions with nodes, elements and mass, each region below its body if it is not all of it.
std::vector<std::string> body_table(const Simulation&);

/// The table of initial gaps, one interface a line, with its penalty; empty without contacts.
std::vector<std::string> gap_table(const Simulation&);

/// Of each block whose step a narrow element sets, what that width costs, one block a line; of those that may set the step of the run.
std::vector<std::string> width_notes(const Simulation&);

/// Each contact and tie in one pass whose apexes are a quarter or more farther apart than the nodes of the base below them, unless all of
/// these are held.
std::vector<std::string> coarseness_notes(const Simulation&);

/// The body that lies farthest from the origin for its elements, if round-off of its positions is more than 1e-12 of its smallest element.
std::vector<std::string> rounding_notes(const Simulation&);

/// Each interface and rigid plane that was penetrated by more than half an element so far, one a line.
std::vector<std::string> depth_notes(const Simulation&);

/// Each two bodies that overlap by more than a tenth of an element, and each body that overlaps itself, one a line; of what
/// overlapped at the start only what no contact says.
std::vector<std::string> overlap_notes(const Simulation&);

/// Each body whose elements spoil its results: corners that are inverted, distortion control above a hundredth of its internal energy,
/// hourglass springs and dashpots above a tenth, solids of the law `elastic` that are pressed by more than half of Young's modulus, plates
/// that keep a thickness which their strain would have changed by more than a twentieth, or whose nodes spin about their normals with more
/// than a hundredth of the energy.
std::vector<std::string> quality_notes(const Simulation&);

/// Strain energy that is concentrated in single elements, of a run that ended well: docs/coarse_meshes.md.
std::vector<std::string> mesh_warnings(const Simulation&);

/// What a run that ended well cannot tell of the error of its mesh, and no fault: elements that bend unlike their neighbours, plates, peaks
/// of the force of a few nodes, the largest plastic strain, restitution where bodies flow. What warnings say more of is left out.
std::vector<std::string> mesh_notes(const Simulation&);

/// Each block whose plastic strain went beyond the last point of its measured hardening curve, from where on the stress is constant.
std::vector<std::string> curve_notes(const Simulation&);

/// Each formula of probes that was no finite number in some steps.
std::vector<std::string> formula_notes(const Simulation&);

/// Each source, and time integration, that created or lost more than a fifth of the created_limit, of the energy of the scene or of what it
/// transferred, and more than 1e-4 of the energy of the scene, one a line. Beyond the limit the run stops. Each contact and rigid plane by
/// multipliers that holds more than this of what it transferred, between bodies that do not touch at the end.
std::vector<std::string> energy_notes(const Simulation&);

/// Each interface and rigid plane by a penalty whose steps became shorter because of what it created, one a line.
std::vector<std::string> step_notes(const Simulation&);

/// Elements of all blocks.
std::int64_t count_elements(const dynamics::Model&);

/// Where the energy of a run went, in one line: what was there at the start and what came in, and what both have become. [J]
std::string energy_line(const Simulation&);

}  // namespace nereid::model
