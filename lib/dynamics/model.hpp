#pragma once
// Three lifetimes, three types: Model is constant, State is what a restart needs, Forces can be
// thrown away.

#include <optional>
#include <vector>

#include "contact/contact.hpp"
#include "contact/rigid_plane.hpp"
#include "dynamics/ledger.hpp"
#include "element/block.hpp"
#include "load/constraints.hpp"
#include "load/loads.hpp"

namespace nereid::dynamics {

/// Which places of a block's tiles make up each node: the fixed order in which forces are summed.
struct PlacesOfNodes {
  Subset node;               ///< nodes of the block, ascending
  std::vector<Index> begin;  ///< [nodes of the block + 1] in `place`
  std::vector<Index> place;
};

/// How a run looks for the static equilibrium, see dynamics/relax.hpp.
struct Relaxation {
  double residual = 1e-6;  ///< [-] unbalanced over all forces at which a state counts as balanced
  double after = 0;        ///< [s] not before: loads that grow must have grown
  int samples = 5;         ///< samples in a row that must be balanced
};

/// What is simulated. Built once, then only ever passed as const.
struct Model {
  mesh::Mesh mesh;
  std::vector<element::AnyBlock> blocks;
  std::vector<contact::Interface> interfaces;
  std::vector<contact::RigidPlane> rigid_planes;
  load::Constraints constraints;
  std::vector<load::AnyLoad> loads;
  std::vector<load::PointMass> point_masses;
  Vec3 gravity = Vec3::Zero();      ///< [m/s2]
  std::optional<Relaxation> relaxation;

  // set by finish()
  Scalars mass;                     ///< [kg] lumped, [nodes]
  Scalars inertia;                  ///< [kg m2] isotropic, [plate nodes]
  std::vector<Index> turn_of_node;  ///< [nodes] column of the angular velocity, or -1
  Subset node_of_turn;              ///< [plate nodes]
  std::vector<PlacesOfNodes> places;  ///< beside blocks
};

/// Computes what follows from blocks and point masses: masses, columns of angular velocities, orders of summing.
///
/// Throws InternalError if a node has no mass, neither of an element nor of a point mass.
void finish(Model&);

/// What a search for the static equilibrium took away, and how near it is.
struct RelaxationMemory {
  double removed = 0;                   ///< [J] kinetic energy
  Vec3 impulse = Vec3::Zero();          ///< [N s] given to the nodes
  Vec3 angular_impulse = Vec3::Zero();  ///< [N m s] about the origin
  double residual = 1;                  ///< [-] unbalanced over all forces, at the last sample
  double most_force = 0, most_kinetic = 0;  ///< largest so far: [N/kg^(1/2)], [J]
  int balanced = 0;                     ///< samples in a row
  double since = 0;                     ///< [s] when the state was that of Forces::Before
};

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
  std::vector<load::LoadMemory> loads;             ///< beside Model::loads
  RelaxationMemory relaxation;
  Ledger ledger;
};

/// Recomputed every step.
struct Forces {
  std::vector<element::TileForces> blocks;
  std::vector<contact::Workspace> interfaces;
  Vectors force;                                   ///< [N] on the nodes
  Vectors moment;                                  ///< [N m] on the plate nodes
  std::vector<double> partial;                     ///< sums of node ranges, in order
  load::SpringRates springs;                       ///< of the model: for the vote
  /// Only while a model relaxes: positions, turns since then, forces and moments that resist at an earlier time.
  struct Before {
    Vectors x, turned, force, moment;
    Vectors w;                                     ///< [rad/s] at the step before
    Vectors source_force, source_moment;           ///< of one source, or all that resist
  } before;
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
