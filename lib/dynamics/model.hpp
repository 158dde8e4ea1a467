#pragma once
// Three lifetimes, three types: Model is constant, State is exactly what a restart needs, Forces can be
// thrown away and made anew from the two.

#include <limits>
#include <optional>
#include <vector>

#include "audit/audit.hpp"
#include "contact/contact.hpp"
#include "contact/multiplier/enforce.hpp"
#include "contact/multiplier/rigid_nodes.hpp"
#include "contact/penalty/rigid_plane.hpp"
#include "dynamics/ledger.hpp"
#include "dynamics/step_limits.hpp"
#include "element/block.hpp"
#include "element/node_sums.hpp"
#include "load/constraints.hpp"
#include "load/loads.hpp"
#include "rigid/body.hpp"

namespace nereid::dynamics {

/// How a run looks for the static equilibrium, see dynamics/relax.hpp.
struct Relaxation {
  double residual = 1e-6;  ///< [-] unbalanced over all forces at which a state counts as balanced
  double after = 0;        ///< [s] not before: loads that grow must have grown
  int samples = 5;         ///< samples in a row that must be balanced
};

/// What planes of the constraints do to a rigid body; Body::hold is what they leave to it.
struct HeldBody {
  struct Row {
    int plane;      ///< in Constraints::planes
    Vec3 normal;    ///< that it holds
    Vec3 reaction;  ///< component of a reaction that belongs to it
  };
  std::vector<Row> rows;
  int first = -1;   ///< plane that takes the moments, or -1: nothing holds the body
  int driver = -1;  ///< plane that drives it, or -1
};

/// A plane or a cylinder through a body, across which forces are seen: section.hpp.
struct Section {
  struct Part {
    std::size_t block;         ///< in Model::blocks
    std::vector<Index> slots;  ///< of its tiles that have nodes on both sides: those of the nodes ahead
    Subset nodes;              ///< of these slots
  };
  std::string name;
  Vec3 point;  ///< [m] about which moments are taken
  std::vector<Part> parts;
};

/// What is simulated. Built once, then only ever passed as const.
struct Model {
  mesh::Mesh mesh;
  std::vector<element::AnyBlock> blocks;
  std::vector<contact::AnyContact> contacts;
  std::vector<contact::RigidPlane> rigid_planes;
  load::Constraints constraints;
  std::vector<load::AnyLoad> loads;
  std::vector<load::PointMass> point_masses;
  Vec3 gravity = Vec3::Zero();      ///< [m/s2]
  std::optional<Relaxation> relaxation;
  bool relaxes = true;              ///< whether `relaxation`, if any, acts: it need not in every stage of a run
  std::vector<rigid::Body> rigid_bodies;
  std::vector<HeldBody> held_bodies;    ///< beside rigid_bodies
  std::vector<Index> rigid_of_block;    ///< beside blocks: the rigid body that it belongs to, or -1; empty without any
  std::vector<Section> sections;
  double longest_step = 1e300;          ///< [s] no step is longer

  // set by finalize()
  /// [kg] lumped, [nodes]. Those of a rigid body are bounds: its nodes, if they were free, would move no less by any impulses
  Scalars mass;
  std::vector<Index> rigid_of_node;     ///< [nodes] the same as of blocks; empty without any
  Scalars rigid_share;                  ///< [-] [rigid bodies] by which masses of their nodes are bounds, of what their elements have
  Scalars inertia;                  ///< [kg m2] isotropic, [plate nodes]
  std::vector<Index> rotation_of_node;  ///< [nodes] column of the angular velocity, or -1
  Subset node_of_rotation;              ///< [plate nodes]
  std::vector<element::NodeSums> node_sums;  ///< beside blocks: the order in which the forces of tiles are summed
};

/// Computes what follows from blocks and point masses: masses, columns of angular velocities, orders of summing.
///
/// Throws InternalError if a node has no mass, neither of an element nor of a point mass.
/// Needs  rigid bodies and the blocks that belong to them
void finalize(Model&);

/// What a search for the static equilibrium took away, and how near it is.
struct RelaxationMemory {
  double removed = 0;                       ///< [J] kinetic energy
  Vec3 impulse = Vec3::Zero();              ///< [N s] given to the nodes
  Vec3 angular_impulse = Vec3::Zero();      ///< [N m s] about the origin
  double residual = 1;                      ///< [-] unbalanced over all forces, at the last sample
  double kinetic = 0;                       ///< [J] of displacements, at the last step
  double most_force = 0, most_kinetic = 0;  ///< largest so far: [N/kg^(1/2)], [J]
  int balanced = 0;                         ///< samples in a row
  /// The reference from which the frequency is taken: time, positions, rotations since then, forces and moments that resist.
  double since = 0;                     ///< [s]
  Vectors x, rotated, force, moment;
  Vectors omega;                            ///< [rad/s] at the step before
};

/// What a measurement needs from one look to the next.
struct Kept {
  Vec3 integral = Vec3::Zero();  ///< of a mean over time: at `since`, as an impulse [N s] of a force
  Vec3 value = Vec3::Zero();     ///< what it was at the last look, as a mean force [N]
  double since = -1;             ///< [s] of the last look; -1: there was none
};

/// What a probe remembers: its value over the steps of a run, and what its measurement needs from one to the next.
struct ProbeMemory {
  double last = std::numeric_limits<double>::quiet_NaN();  ///< what a row shows
  double now = last;                                       ///< at the last step
  double largest = last, smallest = last;                  ///< of all steps; NaN where no step had a value
  double time_of_largest = 0, time_of_smallest = 0;        ///< [s] first of equal ones
  double largest_row = last, smallest_row = last;          ///< of a mean: of all rows
  double integral = 0;                                     ///< over time: each value times the step that led to it
  double first_above_zero = -1, last_above_zero = -1;      ///< [s]; -1: at no step
  std::int64_t samples = 0;                                ///< steps, and the start
  std::int64_t not_finite = 0;                             ///< of these, of a formula: where its value was no finite number
  Kept of_steps, of_rows;                                  ///< for means over a step, and since the row before
};

/// What a condition that may end a run remembers of what it has been shown so far.
struct ConditionMemory {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double first = none, last = none;             ///< values
  double time = -1;                             ///< [s] of the last one; -1: there was none
  double extreme = none, time_of_extreme = -1;  ///< the largest value, or the smallest, and when it was there first [s]
  double since = -1;                            ///< [s] when a window began, or since when the condition holds; -1: it does not
  double integral = 0;                          ///< over the window so far
  double mean = none;                           ///< over the window before
};

/// What a run keeps from step to step.
struct Progress {
  bool started = false;
  std::vector<double> stages;   ///< [s] when each stage began, up to the one that runs; empty for a run without stages
  double first_step = 0;        ///< [s] chosen at the start
  std::int64_t updates = 0;     ///< of the ledger: multiples of the interval between two that have passed
  bool ledger_is_current = false;
  std::int64_t corners_seen = 0;  ///< step of the last look at the corners of elements
  std::int64_t corners_next = 0;  ///< step of the next one, at the latest
  double corner = 1;              ///< [-] the smallest one at the last look
  double contrast_seen = 0;     ///< [s] time of the last look at how elements differ from their neighbours
  std::int64_t contrast_step = 0;   ///< step of that
  std::int64_t contrast_looks = 0;
  double audits = 0;            ///< looks for overlaps: multiples of the interval between two that have passed
  std::int64_t audited = 0;     ///< step of the last look for overlaps
  std::int64_t audited_itself = 0;  ///< step of the last look for overlaps of bodies with themselves
  Step smallest;                ///< the smallest step so far, and what limited it
  double largest_step = 0;      ///< [s]
};

/// Kinetic energy of plate nodes that turn about their normals and faster than the plate around them, which nothing resists.
struct Spin {
  double energy = 0;  ///< [J] of all nodes of a block at one look
  Index node = -1;    ///< the fastest of them
  double time = 0;    ///< [s] when
};

/// What a run has seen of the elements of a block.
struct Quality {
  double corner = 1;                   ///< [-] smallest corner Jacobian over that of the reference
  Index element = -1;                  ///< whose it was
  double time = 0;                     ///< [s] when
  double hourglass = 0, internal = 0;  ///< [J] the largest at any update of the ledger
  double distortion = 0;               ///< [J] the same, of distortion control
  double drilling = 0, residual_bending = 0, artificial = 0;  ///< [J] the same, of plates, and of the sum of all these
  element::Contrast contrast;          ///< [J] of solids: sums over the looks
  bool inverted = false;               ///< whether a corner was at the last look
  element::Thinned thinned;            ///< of plates that keep their thickness: how far it is off at most, at any look
  double thinned_at = 0;               ///< [s] when
  element::Pressed pressed;            ///< of solids of the law `elastic`: the most at any look
  double pressed_at = 0;               ///< [s] when
  Spin spin;                           ///< of plates without drilling stiffness: the largest at any look
};

/// On how many nodes a contact or a rigid plane acted while its force was largest.
struct Footing {
  double force = 0;  ///< [N] the sum of the sizes of the forces on all nodes
  double nodes = 0;  ///< [-] effective_nodes()
};

/// What the material behind a section exerts on that ahead of it.
struct SectionMemory {
  Vec3 force = Vec3::Zero();    ///< [N]
  Vec3 moment = Vec3::Zero();   ///< [N m]
  Vec3 impulse = Vec3::Zero();  ///< [N s] since the start
};

/// Where the simulation stands: exactly what a restart needs.
struct State {
  double t = 0;                                    ///< [s]
  std::int64_t step = 0;
  double dt = 0;                                   ///< [s] of the step before
  Vectors x;                                       ///< [m] position at t
  Vectors v;                                       ///< [m/s] velocity at t
  Vectors omega;                                   ///< [rad/s] angular velocity at t, plate nodes only
  std::vector<element::Memory> blocks;             ///< beside Model::blocks
  std::vector<element::TileForces> tiles;          ///< beside Model::blocks: at t, for the work of the next step
  std::vector<contact::AnyMemory> contacts;        ///< beside Model::contacts
  std::vector<contact::PlaneMemory> rigid_planes;  ///< beside Model::rigid_planes
  std::vector<rigid::State> rigid_bodies;          ///< beside Model::rigid_bodies
  load::Memory constraints;
  std::vector<load::LoadMemory> loads;             ///< beside Model::loads
  std::vector<SectionMemory> sections;             ///< beside Model::sections
  RelaxationMemory relaxation;
  Ledger ledger;
  StepLimits step_limits;                                     ///< for the next step
  Progress progress;
  std::vector<Quality> quality;                    ///< beside Model::blocks
  std::vector<Footing> footings;                   ///< beside Model::contacts, then Model::rigid_planes; those that follow have none
  audit::Memory audit;                             ///< what overlaps
  std::vector<ProbeMemory> probes;                 ///< beside the probes of the run
  std::vector<ConditionMemory> conditions;         ///< of conditions that may end the run
};

/// What acts on a rigid body, and what a step does to it.
struct RigidForces {
  Vec3 force = Vec3::Zero();   ///< [N]
  Mat3 spread = Mat3::Zero();  ///< [N m] sum of f A^T over the nodes, with their arms in the reference
  double kinetic = 0;          ///< [J] at the start of the step
  double work = 0;             ///< [J] of half of the forces at the start and half of those at the end
  double driven = 0;           ///< [J] by planes that move it
  double square = 0;           ///< [W/s] F.F/m + M.J^-1.M at the start, of what is free to move
  Vec3 way = Vec3::Zero();     ///< [m] of the centre in the step
  Mat3 turned = Mat3::Zero();  ///< [-] what the step changed in the rotation
};

/// Sums and scratch of a step; resume() makes them from model and state.
struct Forces {
  Vectors dx;                                 ///< [m] increment of the positions over the step
  Vectors rotation;                           ///< [rad] increment of the rotations of the plate nodes
  std::vector<element::TileReports> reports;  ///< beside Model::blocks
  std::vector<contact::AnyWorkspace> contacts;     ///< beside Model::contacts
  Vectors force;                                   ///< [N] on the nodes
  Vectors moment;                                  ///< [N m] on the plate nodes
  std::vector<double> partial;                     ///< sums of node ranges, in order
  load::SpringRates springs;                       ///< of the model: for the step limit
  audit::Workspace audit;                          ///< the surfaces of the model
  Scalars half_growth;  ///< [m] [nodes] by which half the thickness of plates has grown since the start; empty where none changes
  Scalars plate_mass;   ///< [kg] [nodes] of the plates there; empty likewise
  std::vector<Scalars> element_mass;  ///< [kg] [elements] beside Model::blocks, of plates whose thickness changes; empty likewise
  contact::Multipliers multipliers;
  std::vector<const Mat3*> allowed, allowed_rotation;  ///< [nodes] [plate nodes] for multipliers: null or a projector in the state
  Vectors driven;                                  ///< [m/s] for ties: what planes that move change in velocities; else empty
  std::vector<RigidForces> rigid_bodies;           ///< beside Model::rigid_bodies
  contact::RigidNodes rigid_nodes;                 ///< for multipliers
  Vectors source_force, source_moment;             ///< only while a model relaxes: of one source, or all that resist
};

/// Whether a block is of a rigid body, or a node: nothing is to be done for them one by one.
inline bool is_rigid_block(const Model& model, std::size_t block) {
  return !model.rigid_of_block.empty() && model.rigid_of_block[block] >= 0;
}
inline bool is_rigid_node(const Model& model, Index node) { return !model.rigid_of_node.empty() && model.rigid_of_node[node] >= 0; }

/// The mass of all bodies. [kg]
double total_mass(const Model&);

/// The number of elements of all blocks.
std::int64_t element_count(const Model&);

/// The planes of a model without what they hold of rigid bodies, which is in Model::held_bodies.
load::Constraints constraints_of_nodes(const Model&);

/// The state at rest in the reference positions. Contacts must have been connected: their
/// memories are taken over as they are.
State initial_state(const Model&, std::vector<contact::AnyMemory> contacts);

Forces make_forces(const Model&);

/// The schema of the ledger: one source for every account, in the order of Model: blocks, contacts, rigid planes,
/// planes of the constraints, loads, relaxation, gravity.
std::vector<Source> sources(const Model&);

}  // namespace nereid::dynamics
