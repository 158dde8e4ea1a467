#pragma once
// Three lifetimes, three types: Model is constant, State is what a restart needs, Forces can be
// thrown away.

#include <vector>

#include "contact/contact.hpp"
#include "contact/rigid_plane.hpp"
#include "dynamics/ledger.hpp"
#include "element/block.hpp"
#include "load/constraints.hpp"

namespace nereid::dynamics {

/// Which places of a block's tiles make up each node: the fixed order in which forces are summed.
struct PlacesOfNodes {
  Subset node;               ///< nodes of the block, ascending
  std::vector<Index> begin;  ///< [nodes of the block + 1] in `place`
  std::vector<Index> place;
};

/// What is simulated. Built once, then only ever passed as const.
struct Model {
  mesh::Mesh mesh;
  std::vector<element::AnyBlock> blocks;
  std::vector<contact::Interface> interfaces;
  std::vector<contact::RigidPlane> rigid_planes;
  load::Constraints constraints;
  Vec3 gravity = Vec3::Zero();      ///< [m/s2]

  // set by finish()
  Scalars mass;                     ///< [kg] lumped, [nodes]
  Scalars inertia;                  ///< [kg m2] isotropic, [plate nodes]
  std::vector<Index> turn_of_node;  ///< [nodes] column of the angular velocity, or -1
  Subset node_of_turn;              ///< [plate nodes]
  std::vector<PlacesOfNodes> places;  ///< beside blocks
};

/// Computes what follows from the blocks: masses, columns of angular velocities, orders of summing.
///
/// Throws InternalError if a node belongs to no element.
void finish(Model&);

/// Where the simulation stands: exactly what a restart needs.
struct State {
  double t = 0;                                    ///< [s]
  std::int64_t step = 0;
  double dt = 0;                                   ///< [s] of the step before
  Vectors x;                                       ///< [m] position at t
  Vectors v;                                       ///< [m/s] velocity at t
  Vectors w;                                       ///< [rad/s] angular velocity at t, plate nodes only
  std::vector<element::Memory> blocks;             ///< beside Model::blocks
  std::vector<contact::Memory> interfaces;         ///< beside Model::interfaces
  std::vector<contact::PlaneMemory> rigid_planes;  ///< beside Model::rigid_planes
  load::Memory constraints;
  Ledger ledger;
};

/// Recomputed every step.
struct Forces {
  std::vector<element::TileForces> blocks;
  std::vector<contact::Workspace> interfaces;
  Vectors force;                                   ///< [N] on the nodes
  Vectors moment;                                  ///< [N m] on the plate nodes
  std::vector<double> partial;                     ///< sums of node ranges, in order
};

/// Who asks for which step, and whether any element is lost.
struct Votes {
  double step = 1e300;          ///< [s] the smallest of all votes
  std::string_view by;          ///< block, interface or plane that asks for it
  double element_step = 1e300;  ///< [s] the linear bound of the elements: a run stays below it
  double contact_step = 1e300;  ///< [s] of interfaces and planes: their own bound, not the linear one
  Index element = -1;
  double size = 1e300;          ///< [-] smallest volume or area ratio; not positive or NaN: inverted
  std::string_view smallest_block;
  Index smallest_element = -1;
};

/// The state at rest in the reference positions. Interfaces must have been connected: their
/// memories are taken over as they are.
State initial_state(const Model&, std::vector<contact::Memory> interfaces);

Forces make_forces(const Model&, std::vector<contact::Workspace> interfaces);

}  // namespace nereid::dynamics
