#pragma once
// What acts on a model: planes, point masses, loads, springs and the motion at the start. Parts of model::build.
//
// Names of node sets, surfaces and bodies are those of the mesh: build() has checked them.

#include "model/fault.hpp"
#include "model/scene.hpp"

namespace nereid::model {

/// Adds planes (rigid ones come with add_rigid_planes) and point masses to a model whose mesh stands, before dynamics::finalize.
///
/// Faults: planes that move a node against one another, or constrain too many directions of one; nodes of a symmetry plane that lie on
/// none; velocities that are no number at the start. With a conflict no plane is added.
void add_planes(const Scene&, dynamics::Model&, Faults&);

/// Adds rigid planes to a model after dynamics::finalize.
void add_rigid_planes(const Scene&, dynamics::Model&);

/// Faults: nodes that start behind a floor or a rigid plane.
///
/// x  [m] positions at the start
void check_sides_of_planes(const Scene&, const dynamics::Model&, const Vectors& x, Faults&);

/// Adds gravity, loads, springs and relaxation to a model after dynamics::finalize.
///
/// Faults: moments on nodes of solids, springs that do not end at single nodes, values that are no number at the start,
/// a plane that rotates nodes of which none is one of plates.
void add_loads(const Scene&, dynamics::Model&, Faults&);

/// Adds velocities that bodies are given, and the angular velocities of plate nodes that follow from their gradients. [m/s] [rad/s]
///
/// Faults: values that are no number
void add_velocities(const std::vector<Initial>&, const dynamics::Model&, Vectors& velocity, Vectors& spin, Faults&);

/// A field that bodies are given at the start.
struct InitialField {
  Vectors value;               ///< [3 x nodes]
  std::vector<Mat3> gradient;  ///< [plate nodes]
};

/// The sum of all initial displacements, after dynamics::finalize; empty without any, or after a fault. [m]
///
/// Faults: values that are no number, displacements that are too large
std::optional<InitialField> initial_displacement(const Scene&, const dynamics::Model&, Faults&);

/// Sets velocities and takes the bodies to their initial displacements; before dynamics::start.
///
/// Faults: values that are no number, displacements that turn elements inside out
void set_initial(const Scene&, const dynamics::Model&, const std::optional<InitialField>& displacement, dynamics::State&, Faults&);

}  // namespace nereid::model
