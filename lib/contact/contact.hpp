#pragma once
// Contact: apexes over a base surface, with the adaptive connectivity of Kulak & Fiala; and edges over edges (crossing.hpp).
//
//            apex  *                An apex interacts with the closest feature of the base surface:
//                  |  h             a facet (tetrahedral element), an edge (triangular) or a vertex
//        1 --------+------- 2       (line). It walks from feature to feature as it slides. With the
//          \     foot     /         gap g = h - h_c open for g > 0, a closed element pushes its apex
//             \       /             out with the traction -g / delta on its area.
//                 3
//
// Four rooms:  find       which parts of the surface an apex has come into contact with, and where it stands there
//                         (search.hpp, near.hpp, tracking.hpp, stand.hpp)
//              stencil    nodes, weights and push of one contact (stencil.hpp)
//              enforce    the shortest way out d, with the potential  1/2 (area/delta) |d|^2 (way_out.hpp, projection.hpp, friction.hpp);
//                         or by multipliers, without a penalty (multiplier.hpp, condition.hpp, foot.hpp,
//                         restitution.hpp; bond.hpp)
//              account    work, what is stored, dissipated and created: here, with forces, time step and output
//              apex.hpp goes with one apex through all of them. Of many bodies in one contact bodies.hpp has what pairs of them have,
//              and beside.hpp what a node does not touch on its own body.
//
// On a plain and on a ridge the potential is the paper's element; in a valley both flanks push, and as the valley flattens the two
// become one, so a tributary area counts exactly once: docs/theory/contact.md. A closed element may also rub, and a bonded one
// neither opens nor slides: docs/theory/friction.md.

#include <algorithm>
#include <limits>
#include <span>
#include <string>

#include "base/account.hpp"
#include "base/step_limit.hpp"
#include "contact/bodies.hpp"
#include "contact/cone.hpp"
#include "contact/edges.hpp"
#include "contact/face_points.hpp"
#include "contact/friction.hpp"
#include "contact/method.hpp"
#include "contact/search.hpp"
#include "contact/step_factor.hpp"
#include "contact/stencil.hpp"
#include "contact/way_out.hpp"

namespace nereid::contact {

/// Whether an apex may leave its base.
enum class InterfaceKind {
  contact,  ///< unilateral: pushes only, and the apex slides from base to base
  bonded,   ///< the apex stays over the point of its base where it began, pulled as well as pushed
  edges,    ///< of a contact: edges of the surface of its apexes over edges of its base, always by multipliers
};

/// How friction on an apex is shared out over its base, and against what its sliding is measured.
enum class Weights {
  consistent,  ///< by the foot of the apex, with the moments of Touch: keeps angular momentum
  paper,       ///< equally over the nodes of the base, Kulak & Fiala Eqs. 9 and 10: loses angular momentum
};

/// What a traction is multiplied by to become the force on an apex.
enum class Area {
  apex,  ///< the tributary area of the apex, of the sides that face the base within 60 degrees as it comes into contact
  base,  ///< the mean area of the facets of the base, as in the paper's Eqs. 6 and 12
};

/// Which of two passes, in which each surface has apexes over the other; the back pass follows the forth one in the model.
enum class Pass { only, forth, back };

/// Which penetrations of the initial geometry are accepted.
enum class InitialPenetration {
  refuse,  ///< the scene is not built
  accept,  ///< the penetration becomes an offset of the apex: no force at the start, see Track::height
};

/// Where a bonded apex belongs: over fixed weights of the nodes of a facet, or of the face that it is half of, at a fixed height.
struct Bond {
  Index facet = -1;                ///< -1: the apex found no base and is free
  bool on_face = false;            ///< of a hexahedron, by bilinear weights
  std::array<double, 4> weight{};  ///< of the nodes of the facet, then of Half::fourth
  double height = 0;               ///< [m] along the normal of the facet, or of the face at that point
};

/// Apexes over a base surface. Constant in time.
///
/// What it is between is that of its two surfaces; of many bodies the least depth and the largest penalty of all pairs.
struct Interface : Between {
  std::string name;
  InterfaceKind kind = InterfaceKind::contact;
  Method method = Method::penalty;
  BaseSurface base;
  Fans own;                      ///< the surface of the apexes: an apex comes into contact with facets that this faces; may be empty
  Subset apexes;                 ///< nodes, ascending
  Scalars area;                  ///< [m2] tributary area, [apexes]
  mesh::FacesAround faces;       ///< [apexes] what the tributary area lies on; may be empty
  Scalars facet_area;            ///< [m2] of the reference, [facets]
  Scalars contact_height;        ///< [m] h_c, [apexes], with plates as thick as at the start
  bool follows_thickness = false;  ///< whether h_c changes as plates do: see Memory::thicker
  double restitution = 1;        ///< [-] speed of a node released by a multiplier over that with which it was stopped
  Coulomb friction;
  /// [nodes] column of a plate node's angular velocity, or -1; empty where no node of the interface turns
  std::vector<Index> rotation_of_node;
  std::vector<Bond> bonds;             ///< [apexes] of a bonded interface; set by connect()
  double impact_step_factor = 0.1410;  ///< [-] dt sqrt(k/m) of the vote: impact_step_factor_for(0.005)
  double first_step_factor = 0;        ///< [-] the same until the contact has created too much, where it is larger: step_factor.hpp
  Pass pass = Pass::only;
  double pass_factor = 1;              ///< [-] part of the stiffness between its nodes: 1/2 in each of two passes
  /// [s] a closed element pushes with k (|d| + damping_time d|d|/dt), never pulls. It takes
  /// the chatter out of an interface; what it dissipates is booked.
  double damping_time = 0;
  Weights weights = Weights::consistent;
  Area area_kind = Area::apex;
  /// An apex on a symmetry plane meets the mirror images of its bases too: [apexes] projector onto
  /// the directions the plane allows; empty where there are no planes.
  std::vector<Mat3> allowed;
  /// [m] Only apexes nearer to their base than h_c and this are looked at, or than they can move in some steps. A search is due when
  /// apexes and base have moved by half of it since the last one, so that no apex comes into contact unseen.
  double margin = 0;
  double longest_step = 0;  ///< [s] stable step of the elements at the start: no step is much longer
  Subset base_nodes;  ///< ascending; set by connect()
  /// Of kind `edges`: those of both sides. Then `apexes` and `base_nodes` are their nodes_of(), and there is no base.
  Edges edges, base_edges;
  double edge_height = 0;  ///< [m] h_c between them, beside Edges::half
  Bodies bodies;           ///< of an automatic contact
};

/// What an apex has together with a facet.
inline const Between& between(const Interface& interface, Index apex, Index facet) {
  const Bodies& bodies = interface.bodies;
  return bodies.names.empty() ? interface : bodies.between[bodies.pair(bodies.of_apex[apex], bodies.of_facet[facet])];
}

/// 1, or -1 of a back pass, whose apexes are on the other side of the contact. [-]
inline double side_of(const Interface& interface) { return interface.pass == Pass::back ? -1 : 1; }

/// How far the surface of an apex may reach behind a plane along whose normal its base pushes it. [-]
inline double most_behind(const Interface& interface) {
  return interface.pass == Pass::only && interface.bodies.names.empty() ? behind_in_one_direction : behind_in_two_directions;
}

/// How many of interfaces are passes of nodes, and not edges.
inline std::size_t passes_of(std::span<const Interface> interfaces) {
  return static_cast<std::size_t>(
      std::count_if(interfaces.begin(), interfaces.end(), [](const Interface& one) { return one.kind != InterfaceKind::edges; }));
}

/// [-] of the depth of an element: apexes that are nearer to their base have a condition by multipliers.
constexpr double multipliers_reach = 0.02;
constexpr double steps_to_touch = 4;  ///< open apexes that can touch within so many steps have one too

enum class Status : int {
  unpaired = -1,  ///< farther from its base than the margin
  open = 0,       ///< near, no contact
  closed = 1,     ///< in contact
};

/// Forces of one apex and its bases, and what its last step did.
struct ElementForces {
  bool closed = false;
  bool has_moment = false;               ///< the forces may leave a small moment, see WayOut
  bool moved = false;                    ///< to another feature in the last step
  int lost = 0;                          ///< parts of the surface that the apex left over a wall in the last step
  int count = 0;                         ///< of stencils; of an open apex that votes for the time step one without a push
  double penalty = 0;                    ///< [N/m] of the apex
  double stiffness = 0;                  ///< [N/m] of the spring between the apex and its bases: past a wall more than the penalty
  double scale = 1;                      ///< of all these forces: 1 + damping_time d|d|/dt / |d|, not negative
  double depth = 0;                      ///< [m] penetration without the offset
  double closes_in = 0;                  ///< [s] at the least, at the speeds of now, of an open apex that votes by a penalty; 0: not known
  double work = 0, created = 0;          ///< [J] in the last step
  double dissipated = 0;                 ///< [J] in the last step
  Vec3 apex = Vec3::Zero();              ///< [N]
  Vec3 angular_impulse = Vec3::Zero();   ///< [N m s] about the origin in the last step, see Memory
  std::array<Stencil, most_stencils> stencil;  // last: most have one, and what is read in every step lies together
};

/// Friction on one apex, and what its last step did.
struct FrictionForces {
  bool acts = false;
  bool stuck = false;                            ///< by multipliers, in the last step
  Touch touch;
  Vec3 force = Vec3::Zero();                     ///< [N] on the apex
  double stiffness = 0;                          ///< [N/m] of the stick
  double coefficient = 0;                        ///< [-] at the speed of sliding in the last step
  double sliding = 0;                            ///< [m/s] that speed, by a penalty
  double work = 0, dissipated = 0, created = 0;  ///< [J] in the last step
};

/// What of an apex goes on from the step before, so that it is not looked for among the facets near it.
enum class Kept : std::uint8_t {
  nothing,
  stencil,  ///< pressed, over the inside of the one facet that it slides on
  points,   ///< over what points of the faces around it find alone
  guard,    ///< a guard that does not act
};

/// All about an apex near its base.
struct Near {
  Index apex = -1;        ///< in Interface::apexes
  Index first_facet = 0;  ///< of its near facets in Memory::near_facets
  Index facets = 0;       ///< how many
  /// [m] As long as Moved::now is less, a free apex cannot have come into contact, and one in contact not to another part.
  double clear = 0;
  double area = 0;        ///< [m2] of the sides of the apex that faced the base as it came into contact; zero: all
  bool rests = false;     ///< free, and its forces are booked: nothing is to do while it is clear
  Kept kept = Kept::nothing;  ///< by multipliers
  bool by_points = false;     ///< its gap was that of points alone in the step before
  /// [m] By multipliers: as long as Moved::now and the reach of a condition are less together, it has none.
  double no_condition_until = -std::numeric_limits<double>::infinity();
  double pressed = 0, earlier = 0;  ///< [N] by multipliers in the step before and in that before: where the sweeps of the next one begin
  Index pressed_most = -1;  ///< by multipliers, the facet that pushed it most in the step before: friction acts on the body of that
  Tracks tracks;
  ElementForces element;
  FrictionForces friction;  // behind stencils of which most are not in use: most contact has no friction
};

/// Two edges near each other at the last search.
struct EdgePair {
  Index edge = -1, base_edge = -1;  ///< in Interface::edges and base_edges
  bool in_face = false;             ///< one of them is no ridge, but between elements of a face or in a valley
  double apart = 0;                 ///< [m] less h_c
  /// [m] As long as Memory::way is less, one edge is beside the other, or lies flat in a face of it, and none comes over the other.
  double flat = -std::numeric_limits<double>::infinity();
};

/// An edge of the surface of the apexes near an edge of the base: a contact element where they cross.
struct Crossing {
  Index edge = -1, base_edge = -1;   ///< as of the pair
  bool in_face = false;              ///< as of the pair
  int side = 0;                      ///< sign of the normal on the product of both edges; 0: they are not over each other
  bool of_ridges = false;            ///< both have been ridges while they were over each other: one that is flattened then is held as one
  Vec3 normal = Vec3::Zero();        ///< of that side, when last looked at
  double level = 0;                  ///< [m] h_c less the offset with which it came in sideways, as of a track
  bool acts = false;                 ///< it has a condition in the step to come
  bool closed = false;
  std::array<Index, 4> node{};       ///< of the edge, then of the base edge
  std::array<double, 4> weight{};    ///< of the point of the edge, positive, then of that of the base edge, negative
  Vec3 push = Vec3::Zero();          ///< [N] on the edge
  double gap = 0;                    ///< [m]
  double pressed = 0;                ///< [N] in the step before
  Restitution restitution;
  FrictionForces friction;
};

/// Two edges where one is over the other.
struct Over {
  bool is = false;                 ///< within both edges, and in front of both
  int side = 0;                    ///< sign of the normal on the product of both edges
  Vec3 normal = Vec3::UnitZ();     ///< unit vector from the base edge to the other one
  double height = 0;               ///< [m]
  double first = 0, second = 0;    ///< [-] places along the edge and the base edge
};

/// Two bodies of an automatic contact that have touched, or both sides of a declared one.
struct Meeting {
  Index one = -1, other = -1;      ///< bodies, the first not behind the other; -1: the side of the apexes and that of the base
  double first = 0, last = 0;      ///< [s] steps at which they touched
  Vec3 impulse = Vec3::Zero();     ///< [N s] on `one` since the start, with friction; zero of a body and itself
  Vec3 now = Vec3::Zero(), before = Vec3::Zero();  ///< [N] of an automatic contact: at the last step, and the one before
};

/// What an interface remembers. The forces are those at the end of the last step: the work of the next one needs them.
struct Memory {
  std::vector<Share> shares;                ///< of the stencils over points: Stencil::first_share
  std::vector<Near> near;                   ///< ascending apexes; of a bonded interface all that have a bond
  std::vector<EdgePair> edge_pairs;         ///< of kind `edges`: within the margin at the last search, ascending
  std::vector<Crossing> crossings;          ///< those of them whose edges are over each other, ascending
  Subset near_facets;                       ///< facets within the margin of each near apex, ascending
  Subset slot;                              ///< [apexes] place in `near`, or -1
  std::vector<Feature> feature;             ///< [apexes] the element in use
  std::vector<Status> status;               ///< [apexes]
  std::vector<double> gap;                  ///< [m] [apexes], open for positive; when last looked at; NaN where unpaired
  std::vector<double> stored;               ///< [J] by the penalty, [apexes]
  std::vector<Vec3> slip;                   ///< [m] elastic part of the slip, [apexes]; empty without friction
  std::vector<double> tangential_stored;    ///< [J] by the elastic stick, [apexes]; empty without friction
  std::vector<std::int64_t> reconnections;  ///< [apexes] walks to another feature
  std::vector<double> thicker;              ///< [m] [apexes] by which h_c has grown since the start; empty where it does not change
  double work = 0;                          ///< [J] done on the nodes
  double damped = 0;                        ///< [J] dissipated by contact damping
  double thinned = 0;                       ///< [J] by the penalty, as plates thinned under it
  double friction_dissipated = 0;           ///< [J] dissipated by friction
  double friction_to_come = 0;              ///< [J] part of it that multipliers will only take in the half step that begins
  double friction_owed = 0;                 ///< [J] that friction gave, as a stick sways, and has not taken back: created until then
  std::vector<Restitution> restitution;     ///< [apexes] of multipliers; else empty
  double impact = 0;                        ///< [J] kinetic energy lost as multipliers stopped nodes
  Vec3 force = Vec3::Zero();                ///< [N] on all apexes, with friction; on the bases it is the opposite
  Vec3 impulse = Vec3::Zero();              ///< [N s] of that force since the start
  double transferred = 0;                   ///< [J] of what multipliers have taken here, that other contacts hold
  bool has_trend = false;                   ///< what pressed apexes in the step before had followed from the two steps before that
  double held = 0;                          ///< [J] what multipliers hold, with their work in the half step that begins
  double power_rate = 0;                    ///< [W/s] force times acceleration of multipliers: dt^2/8 of it is their work
  double created_by_reconnection = 0;       ///< [J] created in steps in which the apex changed its base
  /// [N m s] about the origin: what weights of the paper lose, what the mirror images of bases at a symmetry plane give, and what
  /// pushes leave that are found by iteration; else zero.
  Vec3 angular_impulse = Vec3::Zero();
  std::vector<Meeting> meetings;            ///< ascending bodies: see meeting.hpp
  double deepest = 0;        ///< [m] penetration of any apex since the start, not negative
  Index deepest_apex = -1;   ///< node of that apex, -1 before any contact
  double deepest_time = 0;   ///< [s] when; set by the caller of advance()
  double deepest_in = 0;     ///< [m] Between::depth of the pair of bodies that it was in
  StepFactorMemory step_factor;
  double deepest_now = 0;    ///< [m] of apexes in contact at the last update
  std::int64_t walks = 0;      ///< to another feature, since the start
  std::int64_t lost = 0;       ///< parts of the surface left over a wall in contact
  std::int64_t recovered = 0;  ///< apexes that a search found near
  std::int64_t searches = 0;
  int looks = 0;               ///< at how far apexes and base have moved, since the last search
  double margin = 0;               ///< [m] of the last search
  /// [m] By which nodes have gone against each other at the most, by multipliers; of an automatic contact since the last search.
  double way = 0;
  std::vector<double> apart_from_itself;  ///< [m] [bodies] beyond h_c, by which folds of each were apart when it was last searched, or zero
  Vectors apart_then;                     ///< [m] positions then, beside Bodies::nodes
  std::vector<char> awake;         ///< [bodies] whether a body was near another one, or folds of it near each other, at the last search
  Vectors apexes_then, base_then;  ///< [m] positions at the last search, beside Interface::apexes and base_nodes
  Vec3 mean_way = Vec3::Zero();    ///< [m] of the base nodes since then, beyond that of the first of them, at the step before
};
inline const Near* near(const Memory& memory, Index apex) {
  return memory.slot[apex] < 0 ? nullptr : &memory.near[memory.slot[apex]];
}

/// h_c of an apex now. [m]
inline double contact_height(const Interface& interface, const Memory& memory, Index apex) {
  return interface.contact_height(apex) + (memory.thicker.empty() ? 0 : memory.thicker[apex]);
}

/// The height over a facet at which contact with an apex closes. [m]
inline double level(const Interface& interface, const Memory& memory, Index apex, Index facet) {
  return contact_height(interface, memory, apex) + stand_off(interface.base, facet);
}

/// Lets the contact height follow the thickness of plates: that of an apex and that of the base below it.
///
/// What presses never becomes thicker: an h_c that falls takes tracks with it, and one that rises lets them rise as the apex leaves, since
/// a track that rose by itself would push in one step. An apex near its base is given no more than half its gap.
///
/// half_growth  [m] [nodes] by which half the thickness of plates has grown since the start; zero elsewhere
void follow_thickness(const Interface&, const Scalars& half_growth, Memory&);

/// Sums the force on the apexes, and adds to its impulse that of the step dt [s] that led here.
void sum_force(double dt, Memory&);

double stored(const Memory&);             ///< [J] by the penalty
double tangential_stored(const Memory&);  ///< [J] by the elastic stick of friction

/// The schema of an interface in the ledger, and its values now.
Source source(const Interface&);
void post(const Interface&, const Memory&, Account&);

/// A box around the facets of a body.
struct BodyBox {
  Vec3 low, high;  ///< [m]
};

/// An edge in a search, with the box around it.
struct EdgeBox {
  Index edge;
  bool ridge;      ///< or a rim
  Vec3 low, high;  ///< [m]
};

constexpr Index apexes_of_a_range = 64;  ///< that are searched for one after the other, whatever the number of threads
constexpr Index facets_at_first = 32;    ///< of an apex, for which there is room before any search

/// What an interface works with and may throw away between steps.
struct Workspace {
  explicit Workspace(const Interface&);
  std::vector<BroadSearch> broad;            ///< of the base, or [bodies]
  std::vector<BodyBox> boxes;                ///< [bodies] around the facets
  Subset first_partner, partners;            ///< [bodies + 1] bodies whose boxes are near that of each
  std::vector<char> near_itself;             ///< [bodies] whether folds of each are nearer than was asked: Memory::apart_from_itself
  std::vector<char> apex_near_itself;        ///< [apexes] of which node this is so
  Vectors normals;                           ///< [facets] of bodies that touch themselves
  PointWork points;                          ///< where heights are those of points
  Subset facets;           ///< [apexes] how many facets a search found near
  std::vector<Subset> found;  ///< these facets, by ranges of apexes
  std::vector<Near> near;  ///< the next list of near apexes
  std::vector<EdgeBox> edges, base_edges, base_ridges;  ///< what a search looks at
  std::vector<EdgePair> edge_pairs;        ///< the next list of pairs
  std::vector<Crossing> crossings;         ///< the next list of crossings
  std::vector<Over> over;                  ///< how these stand
  Scalars spring_sum;      ///< [N/m] [nodes of the mesh] stiffness of all springs at a base node
  Scalars rotation_sum;    ///< [N] [nodes of the mesh] the same for the moments of friction
};

/// Spacing of the nodes of one surface over that of the other, in the direction of the surface where it is largest. [-]
struct Coarseness {
  double apexes = 0;  ///< of the apexes over the base; zero where none was looked for, or no apex faces the base
  double base = 0;    ///< of the base over the apexes: what it would be with the sides exchanged
};

/// Part of the flattest element behind two surfaces by which they may overlap at the start. [-] It is round-off of whoever placed them.
constexpr double slight = 1e-6;

/// Apexes or edges of two bodies that overlap by no more than this part of an element at the start: they are taken as contact.
struct SlightOverlap {
  Index apex_body = -1, base_body = -1;  ///< in Bodies, the lower one first; -1 of a pair of surfaces
  Index count = 0;
  double deepest = 0;                    ///< [m] positive
};

/// What the broad search found before the first step.
struct InitialGaps {
  double least = 0, mean = 0, largest = 0;  ///< [m] over the apexes that have a base in front of them; 0 without any
  Index apexes = 0, without_base = 0;
  Index behind = 0;                         ///< apexes that stand behind the base without being in contact, as under a table
  Index penetrating = 0;                    ///< apexes nearer than h_c at the start
  Index free = 0;                           ///< apexes of a bonded interface that stand past its border or have no base: nothing holds them
  double deepest = 0;                       ///< [m] penetration, positive
  Index pairs = 0;                          ///< of edges within the margin, of kind `edges`; the numbers above are then of these
  std::array<Index, 4> by_kind{};           ///< apexes by Kind of feature
  std::vector<SlightOverlap> slight_overlaps;  ///< of round-off size, beyond that of the program itself
  Coarseness coarseness;                    ///< of a single pass: see coarseness.hpp
};

/// How h_c is chosen: from the initial heights so that the initial gap is the clearance, or given.
struct ContactHeight {
  bool from_initial_height = true;
  double clearance = 0;  ///< [m]
  double given = 0;      ///< [m]
  bool from_thickness = false;  ///< given is that of plates, and follows it where it changes
};

/// Finds the first feature of every apex, sets h_c and reports the initial gaps.
///
/// reach  [m] apexes farther away have no base
/// Penetrations are reported and, where InitialPenetration::accept is not asked for, left for the
/// caller to refuse: nothing is pushed. Slight ones are accepted in any case.
InitialGaps connect(Interface&, const Vectors& x, double reach, const ContactHeight&, InitialPenetration, Memory&, Workspace&);

/// Finds the edges that are near each other at the start. Those that stand below the level at which they touch count as penetrating, but
/// for slight overlaps.
InitialGaps connect_edges(const Interface&, const Vectors& x, Memory&, Workspace&);

/// The memory of an interface whose apexes all stand over their nearest facets, also those that are far: for damping, which goes by the
/// stiffest pair of all.
///
/// reach  [m] apexes farther away have no base
Memory tried_out(const Interface&, const Vectors& x, double reach, Workspace&);

/// Moves the apexes of an interface to the closest features at x, and computes their forces by the penalty.
///
/// v  [m/s] and omega [rad/s] (of plate nodes) constant over the step that led to x;  dt  [s], zero at the start
/// Work is posted by the trapezoid rule, with the forces found in the memory and the new ones.
void advance(const Interface&, const Vectors& x, const Vectors& v, const Vectors& omega, double dt, Memory&, Workspace&);

/// Adds the forces of all elements to the nodes [N], and their moments to plate nodes [N m], apex by apex.
void add_forces(const Interface&, const Memory&, Vectors& force, Vectors& moment);

/// What contact does to a node. [N]
struct NodeForce {
  Index node = -1;
  Vec3 push = Vec3::Zero(), friction = Vec3::Zero();
};

/// Adds the forces on nodes to a list, element after element: a node is there as often as elements act on it. Moments are left out.
void list_forces(const Interface&, const Memory&, std::vector<NodeForce>&);

/// The largest step of an interface, and the apex that sets it: step_factor() / omega. With the impact step factor a bounce creates no more
/// energy than the interface's bound.
///
/// An apex and its base are a spring,  omega^2 = k (1/m_apex + sum of w_I S_I / (k m_I)),  where S_I
/// sums the stiffness of all springs at base node I: springs that share nodes add up. What never opens
/// (a bond, a stick) creates nothing at any stable step: dt = `linear_step` / omega, with the moments of
/// friction on plate nodes in omega.
///
/// Each of two passes has its `pass_factor` s of the stiffness between the same nodes and votes as if for all of it: omega^2 is divided
/// by it. With omega_1^2 <= s omega^2 and omega_2^2 <= (1 - s) omega^2 both together are within omega^2.
///
/// Closed elements vote, and those that may close in the next steps: nearer than a quarter of Interface::depth, or than twice the way of
/// the longest step. Where the spring of an open apex allows less than the last step, the step falls to 0.8 of that at a time as long as
/// the apex cannot close within two steps: a step that falls at once makes energy of what rings (docs/theory/contact_energy.md).
///
/// mass [kg] of the nodes;  inertia [kg m2] of the columns of omega;  last [s] step; 0: none, and open apexes vote as closed ones
StepLimit stable_step(const Interface&, const Scalars& mass, const Scalars& inertia, const Memory&, Workspace&, double last = 0);

/// [-] dt omega of a spring that never opens. The linear bound is 2; a quarter of it lowers the bound of
/// the elements that share its nodes by 3 % at most, which the run's safety of 0.9 covers.
constexpr double linear_step = 0.5;

/// One potential contact element as it stands, for output and tests.
struct ElementView {
  Index apex;                    ///< node
  Feature feature;               ///< facet -1 where lost
  std::array<double, 3> weight;  ///< of the foot on the facet's nodes
  double gap, traction;          ///< [m], [Pa] compression positive, without what contact damping adds
  double shear_traction;         ///< [Pa] of friction, not negative
  bool slides;                   ///< friction is at its limit
  Status status;
  std::int64_t reconnections;
};
ElementView view(const Interface&, const Vectors& x, const Memory&, Index apex);

/// The smallest distance of any apex from the base less its h_c, by a search of its own where no apex is near. [m]
///
/// reach  [m] NaN if none is nearer
double least_gap(const Interface&, const Vectors& x, const Memory&, double reach);

/// Stiffness of an apex over a feature: penalty times the chosen area. [N/m]
///
/// area  [m2] tributary, of the sides that are in contact
double stiffness(const Interface&, Index apex, const Feature&, double area);

}  // namespace nereid::contact
