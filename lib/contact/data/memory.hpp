#pragma once
// What a contact remembers from step to step: checkpoints have it.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "base/account.hpp"
#include "contact/data/face_points.hpp"
#include "contact/data/friction.hpp"
#include "contact/data/interface.hpp"
#include "contact/data/method.hpp"
#include "contact/data/stencil.hpp"
#include "contact/data/step_factor.hpp"
#include "contact/data/tracks.hpp"

namespace nereid::contact {

enum class Status : int {
  unpaired = -1,  ///< farther from its base than the margin
  open = 0,       ///< near, no contact
  closed = 1,     ///< in contact
};

/// Forces of one apex and its bases, and what its last step did.
struct ElementForces {
  bool closed = false;
  bool has_moment = false;               ///< the forces may leave a small moment, see Exit
  bool moved = false;                    ///< to another feature in the last step
  int lost = 0;                          ///< parts of the surface that the apex left over a wall in the last step
  int count = 0;                         ///< of stencils; of an open apex that limits the time step one without a push
  double penalty = 0;                    ///< [N/m] of the apex
  double stiffness = 0;                  ///< [N/m] of the spring between the apex and its bases: past a wall more than the penalty
  double scale = 1;                      ///< of all these forces: 1 + damping_time d|d|/dt / |d|, not negative
  double depth = 0;                      ///< [m] penetration without the offset
  double closes_in = 0;                  ///< [s] at least, at the present speeds, of an open apex that limits the step; 0: unknown
  double work = 0, created = 0;          ///< [J] in the last step
  double dissipated = 0;                 ///< [J] in the last step
  Vec3 apex = Vec3::Zero();              ///< [N]
  Vec3 angular_impulse = Vec3::Zero();   ///< [N m s] about the origin in the last step, see Memory
  Stencils stencil;
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
  double safe_distance = 0;
  double area = 0;        ///< [m2] of the sides of the apex that the base loaded as it came into contact; zero: not known, all
  bool is_idle = false;     ///< free, and its forces are booked: nothing is to do within its safe distance
  Kept kept = Kept::nothing;  ///< by multipliers
  bool by_points = false;     ///< its gap was that of points alone in the step before
  /// [m] By multipliers: as long as Moved::now and the reach of a condition are less together, it has none.
  double no_condition_until = -std::numeric_limits<double>::infinity();
  double pressed = 0, earlier = 0;  ///< [N] by multipliers in the last two steps: the first iteration starts from them
  Index pressed_most = -1;  ///< by multipliers, the facet that pushed it most in the step before: friction acts on the body of that
  Tracks tracks;
  ElementForces element;
  Seldom<FrictionForces> friction;
};

/// Two edges near each other at the last search.
struct EdgePair {
  Index edge = -1, base_edge = -1;  ///< in EdgeContact::edges and base_edges
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
  Seldom<FrictionForces> friction;
};

/// Two bodies of an automatic contact that have touched, or both sides of a declared one.
struct PairRecord {
  Index one = -1, other = -1;      ///< bodies, the first not behind the other; -1: the side of the apexes and that of the base
  double first = 0, last = 0;      ///< [s] steps at which they touched
  Vec3 impulse = Vec3::Zero();     ///< [N s] on `one` since the start, with friction; zero of a body and itself
  Vec3 now = Vec3::Zero(), before = Vec3::Zero();  ///< [N] of an automatic contact: at the last step, and the one before
};

/// What every contact remembers. The force is that at the end of the last step: the work of the next one needs it.
struct SidesMemory {
  double work = 0;                          ///< [J] done on the nodes
  double friction_dissipated = 0;           ///< [J] dissipated by friction
  double friction_to_come = 0;              ///< [J] part of it that multipliers will only take in the half step that begins
  double friction_deficit = 0;             ///< [J] that friction gave, as a stick sways, and has not taken back: created until then
  double impact = 0;                        ///< [J] kinetic energy lost as multipliers stopped nodes
  Vec3 force = Vec3::Zero();                ///< [N] on all apexes, with friction; on the bases it is the opposite
  Vec3 impulse = Vec3::Zero();              ///< [N s] of that force since the start
  double transferred = 0;                   ///< [J] of what multipliers have taken here, that other contacts hold
  double held = 0;                          ///< [J] what multipliers hold, with their work in the half step that begins
  double power_rate = 0;                    ///< [W/s] force times acceleration of multipliers: dt^2/8 of it is their work
  /// [N m s] about the origin: what weights of the paper lose, what the mirror images of bases at a symmetry plane give, and what
  /// pushes leave that are found by iteration; else zero.
  Vec3 angular_impulse = Vec3::Zero();
  std::vector<PairRecord> pair_records;            ///< ascending bodies: see pair_records.hpp
  double deepest = 0;        ///< [m] penetration of any apex since the start, not negative
  Index deepest_apex = -1;   ///< node of that apex, -1 before any contact
  double deepest_time = 0;   ///< [s] when; set by the caller of advance()
  double deepest_in = 0;     ///< [m] Between::depth of the pair of bodies that it was in
  double deepest_now = 0;    ///< [m] of apexes in contact at the last update
  std::int64_t searches = 0;
  int looks = 0;               ///< at how far apexes and base have moved, since the last search
  double margin = 0;               ///< [m] of the last search
  /// [m] By which nodes have gone against each other at the most, by multipliers; of an automatic contact since the last search.
  double way = 0;
  std::vector<double> way_of_body;         ///< [m] [bodies] the same of each body and those near it alone
  std::vector<double> apart_from_itself;  ///< [m] [bodies] beyond h_c, by which folds of each were apart when it was last searched, or zero
  Vectors apart_then;                     ///< [m] positions then, beside Bodies::nodes
  std::vector<char> active;         ///< [bodies] whether a body was near another one, or folds of it near each other, at the last search
  Vectors apexes_then, base_then;  ///< [m] positions at the last search, beside Interface::apexes and base_nodes
  Vec3 mean_way = Vec3::Zero();    ///< [m] of the base nodes since then, beyond that of the first of them, at the step before
};

/// What multipliers remember besides; empty of a penalty.
struct MultiplierMemory {
  std::vector<Restitution> restitution;     ///< [apexes]; none of a tie
  std::vector<Share> shares;                ///< of the stencils over points: Stencil::first_share
  bool has_trend = false;                   ///< what pressed apexes in the step before had followed from the two steps before that
  std::vector<NearFeature> near_shapes;     ///< features that shapes were near to at the last search
  std::vector<ShapePoint> shape_points;     ///< pair after pair
  std::vector<double> shape_overlap;        ///< [m] [Shapes::pairs] accepted at the start, zero or less
};

/// What a penalty remembers besides; zero or empty of multipliers.
struct SpringMemory {
  std::vector<Vec3> slip;                   ///< [m] elastic part of the slip, [apexes]; empty without friction
  std::vector<double> tangential_stored;    ///< [J] by the elastic stick, [apexes]; empty without friction
  double damped = 0;                        ///< [J] dissipated by contact damping
  double thinned = 0;                       ///< [J] by the penalty, as plates thinned under it
  double created_by_reconnection = 0;       ///< [J] created in steps in which the apex changed its base
  StepFactorMemory step_factor;
};

/// What an interface remembers. The forces are those at the end of the last step: the work of the next one needs them.
struct Memory : SidesMemory, MultiplierMemory, SpringMemory {
  std::vector<Near> near;                   ///< ascending apexes; of a tied interface all that have a tie
  Subset near_facets;                       ///< facets within the margin of each near apex, ascending
  Subset slot;                              ///< [apexes] place in `near`, or -1
  std::vector<Feature> feature;             ///< [apexes] the element in use
  std::vector<Status> status;               ///< [apexes]
  std::vector<double> gap;                  ///< [m] [apexes], open for positive; when last looked at; NaN where unpaired
  std::vector<double> stored;               ///< [J] by the penalty, [apexes]; of multipliers what one would store, which means nothing
  std::vector<std::int64_t> reconnections;  ///< [apexes] walks to another feature
  std::vector<double> thicker;              ///< [m] [apexes] by which h_c has grown since the start; empty where it does not change
  std::int64_t walks = 0;      ///< to another feature, since the start
  std::int64_t lost = 0;       ///< parts of the surface left over a wall in contact
  std::int64_t recovered = 0;  ///< apexes that a search found near
};

/// What edges over edges remember.
struct EdgeMemory : SidesMemory {
  std::vector<EdgePair> edge_pairs;  ///< within the margin at the last search, ascending
  std::vector<Crossing> crossings;   ///< those of them whose edges are over each other, ascending
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

/// Facets within the margin of a near apex.
inline std::span<const Index> near_facets(const Memory& memory, const Near& near) {
  return std::span<const Index>(memory.near_facets).subspan(near.first_facet, near.facets);
}

/// A crossing of two edges that has not been looked at.
inline Crossing crossing_of(const EdgePair& pair) {
  Crossing crossing;
  crossing.edge = pair.edge, crossing.base_edge = pair.base_edge, crossing.in_face = pair.in_face;
  return crossing;
}

/// The order of pairs, and of crossings as of their pairs.
inline constexpr auto in_order = [](const auto& a, const auto& b) { return std::tie(a.edge, a.base_edge) < std::tie(b.edge, b.base_edge); };

}  // namespace nereid::contact
