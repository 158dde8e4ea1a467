#pragma once
// The conditions that multipliers meet, and what they work with.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "contact/data/any.hpp"
#include "contact/multiplier/tie.hpp"
#include "contact/multiplier/motion.hpp"
#include "contact/multiplier/rows.hpp"
#include "contact/multiplier/stages.hpp"
#include "contact/penalty/rigid_plane.hpp"

namespace nereid::contact {

constexpr double corrected = 0.2;     ///< [-] of a penetration, that is taken back in a step
constexpr double no_response = 1e-9;  ///< [-] of that of free nodes: constraints hold them in a direction

/// A node of a condition.
struct Member {
  Index node;
  double weight;  ///< size of its share of the push, positive of the side of the apex, negative of the base
  Vec3 push;      ///< what it gets of an impulse of the condition
};

/// One condition: an apex over a feature, or a node over a rigid plane. What iterations read and write comes first.
struct Condition {
  double impulse, change;          ///< [N s] so far, and what an iteration adds
  double met, moved;               ///< [N s] what the last iteration found before it went on by its momentum, and by how much that moved
  double per_mass;                 ///< [1/kg] relative velocity per impulse
  double bound;                    ///< [1/kg] of what all impulses together change in it
  double least;                    ///< [m/s] relative velocity that may be afterwards
  double rest;                     ///< [N s] by which iterations have left its impulse too small, set by release()
  int nodes;                       ///< 1 over a rigid plane, 4 over a facet, 5 over a face of a hexahedron, more over points of faces
  Index first;                     ///< of its nodes in Multipliers::members, the apex before those of the base
  Row row;                         ///< set by make_rows()
  Vec3 normal;                     ///< unit vector, from the base to the apex
  double before;                   ///< [m/s] relative velocity in the step before
  double free;                     ///< [m/s] relative velocity afterwards if no multiplier acted
  double after;                    ///< [m/s] relative velocity afterwards, set by find_work()
  double gap;                      ///< [m]
};

/// Friction of one apex, or of one node over a rigid plane: it sticks as far as it can.
struct FrictionCondition {
  Touch touch;
  double coefficient;    ///< [-] at the slip rate of the step before, static of what stuck in it
  double per_mass;       ///< [1/kg] slip rate per impulse, at most
  double bound;          ///< [1/kg] the same of all impulses together
  Vec3 before;           ///< [m/s] slip rate in the step before
  Vec3 stuck;            ///< [m/s] slip rate of a stick: zero, but where friction has an energy deficit it yields slowly against its force
  Vec3 impulse, change;  ///< [N s]
  Vec3 met, moved;       ///< [N s] as of a condition
  Vec3 rest = Vec3::Zero();  ///< [N s] change that iterations have left, set by release()
  Vec3 after;            ///< [m/s] slip rate afterwards, set by find_work()
  std::array<Vec3, 2> along;  ///< unit vectors in the plane
  std::array<Row, 2> row;     ///< along these, set by make_rows()
  bool slides = false;   ///< at its limit, set by find_change()
  double work = 0;       ///< [J] in this step
};

/// The conditions of one apex, or of one node over a rigid plane.
struct Contactor {
  Restitution* memory;
  Index first, last;     ///< its conditions
  Index friction;        ///< in Multipliers::frictions, or -1
  Index foot = first;    ///< the condition along whose base it rubs
  unsigned rubs = ~0u;   ///< a bit for each of its conditions, from the first on, whose bases are of that body
  double area;           ///< [m2] tributary: its weight among the conditions of a node
  double depth;          ///< [m] of the flattest element of its contact
  double impedance;      ///< [N s/m] of the part of its area that the contact loads
  double square;         ///< [-] of the coefficient of restitution
  double work = 0;       ///< [J] of its impulses in this step
  double lost = 0;       ///< [J] of what it held, as it was released
  bool releases = false;  ///< it gives back in this step what it holds of a blow
  bool is_rigid = false; ///< between rigid bodies, or one and a plane; set by find_blows()
  Index blow = -1;       ///< in Multipliers::blows, or -1
};

/// Contactors between rigid bodies that give back in this step, all together, what they hold: those of connected pairs of bodies.
struct Blow {
  double energy = 0;  ///< [J] that it gives back
  double scale = 0;   ///< [-] impulses of the release over those of the blow
  double left = 0;    ///< [J] still to be given back; negative: too much was given
};

/// A contactor between rigid bodies, by the pair that touches.
struct OfPair {
  Index first, second;  ///< bodies, the lower one first; -1: a rigid plane
  Index contactor;
};

/// Contactors that share what they hold, and how much of it others of the pool have received. [J]
struct Pool {
  Index first, last;
  double* transferred;
  double rubbed;             ///< what friction has taken in this step, less its deficit
  double held = 0, deficit = 0; ///< what some of them hold, and what others have given beyond what they held
};

/// What a contactor held that ended without a release, as its apex slid off its facet or its edges do not cross any more.
struct Unreleased {
  std::array<Index, 4> node;     ///< that it was between, as far as it has so many
  int nodes;
  double energy;                 ///< [J] that its coefficient of restitution gives back
  double *impact, *transferred;  ///< [J] of its contact
};

/// What of this falls to a node, and how many conditions act there.
struct UnreleasedAtNode {
  double energy = 0;  ///< [J]
  int conditions = 0;
};

/// What an iteration, or a part of it, has done to the impulses of a contact.
struct Progress {
  double turned = 0;       ///< [J] work of what moved against where it moved to
  double moved = 0, made = 0;              ///< [m2/s2] sums of (A J)^2: of what the iteration moved, and of all
  double moved_along = 0, made_along = 0;  ///< the same of friction
};

/// Conditions, with their nodes one after the other.
struct ConditionList {
  std::vector<Condition> conditions;
  std::vector<Member> members;
};

constexpr Index apexes_of_conditions = 64;  ///< whose conditions are found one after the other, whatever the number of threads

/// The conditions of a range of apexes, found beside those of other ranges.
struct FoundInRange {
  ConditionList list;
  std::vector<FrictionCondition> frictions;
  std::vector<Contactor> contactors;  ///< whose conditions and frictions are those of this range
  Subset ended;                       ///< places in Memory::near of apexes without a condition that hold energy
  PointSum points;
};

/// What multipliers work with and may throw away between steps.
struct Multipliers : ConditionList {
  Spent spent;
  Vectors ahead;        ///< [m] [nodes] where the nodes would be after the step to come
  Vectors way;          ///< [m/s] [nodes] mean velocity from the start of the step that led to t up to there
  Vectors velocity;     ///< [m/s] [nodes] in the step to come, with the impulses so far
  Vectors spin;         ///< [rad/s] [plate nodes] the same of angular velocities
  Scalars shared;       ///< [m2] [nodes] sum of the weights of all conditions, and of lifts of friction, times the areas of their apexes
  Scalars rubbed;       ///< [m2] [nodes] the same of the weights of friction; look_ahead() begins both
  Scalars mobility;     ///< [1/kg] [nodes] of what was looked ahead for
  Subset nodes;         ///< on which multipliers can act, ascending
  Subset always;        ///< of these what is not only of automatic contacts
  Subset looked_at;     ///< that and the skins of bodies that are active, ascending
  bool has_looked = false;  ///< whether `looked_at` is listed
  std::vector<FoundInRange> found;  ///< by ranges of near apexes
  Rows rows;
  std::vector<FrictionCondition> frictions;
  std::vector<Contactor> contactors;
  std::vector<Unreleased> unreleased;  ///< of contactors that end in this step
  std::vector<UnreleasedAtNode> at_node;  ///< [nodes] of these; set where there are any
  std::vector<Index> first;  ///< [interfaces, then planes, then one] of their contactors
  std::vector<Progress> progress;  ///< of an iteration by ranges of contactors
  std::vector<Pool> pools;
  std::vector<Blow> blows;           ///< that end in this step
  std::vector<OfPair> of_pairs;      ///< contactors between rigid bodies, pair after pair
  Subset blow_of_body;               ///< [rigid bodies] where sets of connected bodies are looked up, then their blows
  std::vector<double> blow_impulse;  ///< [N s] [conditions] of their blow
  std::vector<double> blow_rate;     ///< [m/s] [conditions] what these impulses change in the rate
  Ties ties;
};

/// Room for all conditions that can be expected, so that a step takes no memory.
Multipliers make_multipliers(std::span<const AnyContact>, std::span<const RigidPlane>, Index nodes, Index plate_nodes);

/// Begins a condition that add_member() gives its nodes; take_back() ends it again.
Condition& begin_condition(ConditionList&);
void take_back(ConditionList&);
inline void add_member(Index node, double weight, const Vec3& push, ConditionList& list, Condition& c) {
  list.members.push_back({node, weight, push});
  ++c.nodes;
}
/// The same of a node that is pushed along the normal.
inline void add_member(Index node, double weight, ConditionList& list, Condition& c) {
  add_member(node, weight, weight * c.normal, list, c);
}

/// Its nodes, the apex before those of the base.
inline std::span<const Member> members_of(const Condition& c, const ConditionList& list) {
  return {&list.members[static_cast<std::size_t>(c.first)], static_cast<std::size_t>(c.nodes)};
}

/// The relative normal velocity, by velocities v of all nodes. [m/s]
inline double relative(const Condition& c, const ConditionList& list, const Vectors& v) {
  double sum = 0;
  for (const Member& one : members_of(c, list)) sum += one.push.dot(v.col(one.node));
  return sum;
}

/// The same in the step to come, with the impulses so far; after make_rows(). [m/s]
inline double rate(const Condition& c, const Multipliers& all) { return rate(c.row, all.rows); }

/// The work of its impulse, with the relative velocity afterwards: the mean of both velocities, whatever the steps. [J]
inline double work(const Condition& c, double after) { return 0.5 * c.impulse * (c.before + after); }

/// The slip rate of friction, the same. [m/s]
inline Vec3 rate(const FrictionCondition& f, const Multipliers& all) {
  return rate(f.row[0], all.rows) * f.along[0] + rate(f.row[1], all.rows) * f.along[1];
}

inline double work(const FrictionCondition& condition, const Vec3& after) {
  return 0.5 * condition.impulse.dot(condition.before + after);
}

inline void give(const FrictionCondition& f, const Vec3& impulse, Rows& rows) {
  for (std::size_t k = 0; k < 2; ++k) give(f.row[k], f.along[k].dot(impulse), rows);
}

/// The sum of its normal impulses. [N s]
inline double impulse_of(const Contactor& one, const Multipliers& all) {
  double sum = 0;
  for (Index i = one.first; i < one.last; ++i) sum += all.conditions[i].impulse;
  return sum;
}

/// The sum of those of the body on which it rubs. [N s]
inline double rubbing_impulse_of(const Contactor& one, const Multipliers& all) {
  double sum = 0;
  for (Index i = one.first; i < one.last; ++i)
    if ((one.rubs >> (i - one.first) & 1u) != 0) sum += all.conditions[i].impulse;
  return sum;
}

/// What constraints let through of the push of a node.
Vec3 let_through(const Motion&, const Member&);

/// Sets what follows from nodes, weights, normal and gap of a condition; false where constraints hold all its nodes.
///
/// pressed  [N] by all conditions of the contactor in the step before;  held  [J] by it
bool complete(const Motion&, double pressed, double held, const Multipliers&, const ConditionList&, Condition&);

/// Adds a contactor, with what it adds to Multipliers::shared and rubbed.
void add(const Contactor&, Multipliers&);

/// Sets the velocities that all impulses lead to as they stand, and their works. [J]
void find_work(const Motion&, Multipliers&);

}  // namespace nereid::contact
