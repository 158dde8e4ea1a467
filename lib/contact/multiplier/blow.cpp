#include "contact/multiplier/blow.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "contact/multiplier/rigid_nodes.hpp"
#include "contact/multiplier/solve.hpp"
#include "contact/multiplier/stick.hpp"

namespace nereid::contact {

namespace {

constexpr double approaches = 0.01;   // of the rate at which they will separate: bodies that approach faster are still being stopped
constexpr double small_loss = 1e-3;   // of what is held: less, taken in a step, delays no release
constexpr double least_held = 1e-3;   // of what is taken in a step: a pair that held less has only just met, and may meet in more places
constexpr double no_energy = 1e-14;   // of the energy of the relative motion: so little is round-off of an earlier release
constexpr double small_part = 1e-3;   // of the energy of all blows: pairs that approach with less pass a blow on as if they were stopped
constexpr double much_faster = 10;    // times the change of speed by forces in a step: impulses that make more are of a blow
constexpr double small_rest = 1e-9;   // of the energy of a blow: less is left for the next step
constexpr int rounds = 30;            // friction changes what the normal impulses give, and bodies turn within the step

double left_of(const Contactor& one) { return one.memory->held - one.work - one.lost; }

bool is_between_rigid_bodies(const RigidNodes& rigid, const Contactor& one, const Multipliers& all) {
  for (Index i = one.first; i < one.last; ++i)
    for (const Member& at : members_of(all.conditions[i], all))
      if (rigid.of_node[at.node] < 0) return false;
  return true;
}

/// The two bodies of a condition; the first is -1 over a rigid plane.
OfPair pair_of(const RigidNodes& rigid, const Condition& c, const Multipliers& all) {
  OfPair pair{-1, -1, -1};
  for (const Member& at : members_of(c, all)) {
    const Index body = rigid.of_node[at.node];
    if (pair.second < 0) pair.second = body;
    else if (body != pair.second) pair.first = body;
  }
  if (pair.first > pair.second) std::swap(pair.first, pair.second);
  return pair;
}

/// The condition of a contactor that presses hardest.
Index hardest(const Contactor& one, const Multipliers& all) {
  Index best = one.first;
  for (Index i = one.first + 1; i < one.last; ++i)
    if (all.conditions[i].impulse > all.conditions[best].impulse) best = i;
  return best;
}

/// Sets the impulses of the blow for the conditions of a contactor: in the shares in which they press now, or along the first of them.
///
/// size  [N s] of the contactor
void set_impulses(const Contactor& one, double size, Multipliers& all) {
  const double pressed = impulse_of(one, all);
  for (Index i = one.first; i < one.last; ++i)
    all.blow_impulse[i] = pressed > 0 ? size * all.conditions[i].impulse / pressed : i == one.first ? size : 0;
}

/// Lists contactors between rigid bodies that press or hold energy, pair after pair.
void list_pairs(const RigidNodes& rigid, Multipliers& all) {
  all.of_pairs.clear();
  for (std::size_t k = 0; k < all.contactors.size(); ++k) {
    Contactor& one = all.contactors[k];
    one.is_rigid = is_between_rigid_bodies(rigid, one, all);
    if (!one.is_rigid) continue;
    const double impulse = one.memory->blow + impulse_of(one, all);
    if (!(impulse > 0) && one.memory->held == 0) continue;
    set_impulses(one, impulse, all);
    OfPair pair = pair_of(rigid, all.conditions[hardest(one, all)], all);
    pair.contactor = static_cast<Index>(k);
    all.of_pairs.push_back(pair);
  }
  std::sort(all.of_pairs.begin(), all.of_pairs.end(), [](const OfPair& a, const OfPair& b) {
    return std::tie(a.first, a.second, a.contactor) < std::tie(b.first, b.second, b.contactor);
  });
}

/// Whether impulses move a body: not if it is driven, or if planes hold it.
bool can_move(const MovingBody& body) { return !body.driven && !(body.shift.isZero(0) && body.turn.isZero(0)); }

Index a_free_body_of(const RigidNodes& rigid, const OfPair& pair) {
  for (const Index body : {pair.first, pair.second})
    if (body >= 0 && can_move(rigid.bodies[body])) return body;
  return -1;
}

/// What the contactors of a pair of bodies hold and do.
struct PairSum {
  double left = 0, held = 0, taken = 0;          ///< [J] held after this step and before it, and taken in it
  double closing = 0, moving = 0;                ///< [J] impulses of the blow times rates that are left, of those that approach, of all
  double impulse = 0;                            ///< [N s] of the blow
  double by_impulses = 0, by_forces = 0;         ///< [m/s] changes of rates in this step

  bool has_energy() const { return left > no_energy * moving; }
};
PairSum sum_of(std::span<const OfPair> pair, const Multipliers& all) {
  PairSum sum;
  for (const OfPair& at : pair) {
    const Contactor& one = all.contactors[at.contactor];
    sum.left += left_of(one), sum.held += std::max(0.0, one.memory->held), sum.taken += std::max(0.0, -one.work);
    for (Index i = one.first; i < one.last; ++i) {
      const Condition& c = all.conditions[i];
      const double power = all.blow_impulse[i] * c.after;
      sum.closing += std::max(0.0, -power), sum.moving += std::abs(power), sum.impulse += all.blow_impulse[i];
      sum.by_impulses += all.blow_impulse[i] * c.per_mass, sum.by_forces += std::abs(c.free - c.before);
    }
  }
  return sum;
}

/// Whether the bodies of a pair have been stopped, and hold energy that separates them.
bool gives_back(const PairSum& pair) {
  const bool has_only_met = pair.held < least_held * pair.taken;
  return pair.has_energy() && !has_only_met && (pair.closing < approaches * 2 * pair.left || pair.taken < small_loss * pair.held);
}

/// Whether a pair holds next to nothing of a blow, but its impulses are of one.
///
/// held_by_all  [J] by all pairs
bool passes_on(const PairSum& pair, double held_by_all) {
  return pair.left <= small_part * held_by_all && pair.closing <= small_part * 2 * held_by_all &&
         pair.by_impulses > much_faster * pair.by_forces;
}

/// Of a pair that has no impulses, but energy that ended contactors have left: as if each gave it back alone.
void set_impulses_by_energy(std::span<const OfPair> pair, Multipliers& all) {
  for (const OfPair& at : pair) {
    const Contactor& one = all.contactors[at.contactor];
    set_impulses(one, std::sqrt(2 * std::max(0.0, left_of(one)) / all.conditions[one.first].per_mass), all);
  }
}

/// Calls visit(contactors of a pair, what they hold and do) for each pair of bodies that can move.
template <class Visit>
void each_pair(const RigidNodes& rigid, Multipliers& all, Visit&& visit) {
  for (std::size_t begin = 0, end = 0; begin < all.of_pairs.size(); begin = end) {
    const OfPair first = all.of_pairs[begin];
    while (end < all.of_pairs.size() && all.of_pairs[end].first == first.first && all.of_pairs[end].second == first.second) ++end;
    const std::span<const OfPair> pair{&all.of_pairs[begin], end - begin};
    if (a_free_body_of(rigid, first) >= 0) visit(pair, sum_of(pair, all));
  }
}

Index root_of(Index body, Subset& next) {
  while (next[body] != body) body = next[body] = next[next[body]];
  return body;
}

/// Joins bodies that a contactor moves together. What does not answer impulses, as a rigid plane, passes nothing on.
void join(const RigidNodes& rigid, const Contactor& one, Multipliers& all) {
  Index root = -1;
  for (Index i = one.first; i < one.last; ++i) {
    const OfPair pair = pair_of(rigid, all.conditions[i], all);
    for (const Index body : {pair.first, pair.second}) {
      if (body < 0 || !can_move(rigid.bodies[body])) continue;
      const Index other = root_of(body, all.blow_of_body);
      if (root < 0) root = other;
      const Index low = std::min(root, other);
      all.blow_of_body[std::max(root, other)] = low;
      root = low;
    }
  }
}

/// Takes what is lost of what the contactors of each blow hold, as much as if each of them held its share of the sum.
void lose(Multipliers& all) {
  std::vector<double> positive(all.blows.size(), 0);
  for (const Contactor& one : all.contactors) {
    if (one.blow < 0) continue;
    all.blows[one.blow].energy += left_of(one), positive[one.blow] += std::max(0.0, left_of(one));
  }
  for (Contactor& one : all.contactors) {
    if (one.blow < 0 || !(left_of(one) > 0)) continue;
    const double left = std::max(0.0, all.blows[one.blow].energy / positive[one.blow]) * left_of(one);
    const double lost = (1 - one.square) * std::max(0.0, left - one.memory->kept);
    one.lost += lost;
    one.memory->kept = left - lost;
  }
}

/// Friction that gives energy in a step, as one that stops a slip which the release turns round, takes it from what contactors hold.
void find_what_is_left(Multipliers& all) {
  std::vector<double> by_friction(all.blows.size(), 0);
  for (Blow& blow : all.blows) blow.left = 0;
  for (const Contactor& one : all.contactors) {
    if (one.blow < 0) continue;
    all.blows[one.blow].left += left_of(one);
    if (one.friction >= 0) by_friction[one.blow] += all.frictions[one.friction].work;
  }
  for (std::size_t b = 0; b < all.blows.size(); ++b) all.blows[b].left -= std::max(0.0, by_friction[b]);
}

/// Calls visit(condition, its place, its blow).
template <class Visit>
void each_of_blows(Multipliers& all, Visit&& visit) {
  for (const Contactor& one : all.contactors)
    for (Index i = one.first; one.blow >= 0 && i < one.last; ++i) visit(all.conditions[i], i, one.blow);
}

/// Lets friction follow the normal impulses.
void follow(const Motion& m, Multipliers& all) {
  if (all.frictions.empty()) return;
  follow_release(all);
  apply_changes(m, all);
  for (FrictionCondition& friction : all.frictions) friction.change.setZero();
}

/// Adds the impulses of each blow, times a factor.
void add_impulses(const Motion& m, const std::vector<double>& factor, Multipliers& all) {
  for (Condition& c : all.conditions) c.change = 0;
  each_of_blows(all, [&](Condition& c, Index i, Index blow) { c.change = std::max(-c.impulse, factor[blow] * all.blow_impulse[i]); });
  for (std::size_t b = 0; b < all.blows.size(); ++b) all.blows[b].scale += factor[b];
  apply_changes(m, all);
}

/// Adds the impulses of the blows once, as of bodies that bounce, and notes what they change in the rates.
void strike(const Motion& m, Multipliers& all) {
  each_of_blows(all, [&](Condition& c, Index i, Index) { all.blow_rate[i] = -rate(c, all); });
  add_impulses(m, std::vector<double>(all.blows.size(), 1.0), all);
  each_of_blows(all, [&](Condition& c, Index i, Index) { all.blow_rate[i] += rate(c, all); });
}

/// How far each blow is still to go: the ds for which
///
///     1/2 sum of (J + ds d)_k (v_b + v_a + ds A d)_k - J_k (v_b + v_a)_k  =  the energy that is left
std::vector<double> find_factors(Multipliers& all) {
  std::vector<double> linear(all.blows.size(), 0), quadratic = linear, factor = linear;
  each_of_blows(all, [&](Condition& c, Index i, Index blow) {
    const double d = all.blow_impulse[i], change = all.blow_rate[i];
    linear[blow] += 0.5 * (d * (c.before + c.after) + c.impulse * change), quadratic[blow] += d * change;
  });
  for (std::size_t b = 0; b < all.blows.size(); ++b) {
    const Blow& blow = all.blows[b];
    const double B = linear[b], A = quadratic[b];
    if (!(A > 0)) continue;
    factor[b] = std::max(-blow.scale, (-B + std::sqrt(std::max(0.0, B * B + 2 * A * blow.left))) / A);
  }
  return factor;
}

}  // namespace

bool find_blows(const Motion& m, Multipliers& all) {
  all.blows.clear();
  for (Contactor& one : all.contactors) one.blow = -1;
  if (!m.rigid) return false;
  all.blow_impulse.assign(all.conditions.size(), 0), all.blow_rate.assign(all.conditions.size(), 0);
  list_pairs(*m.rigid, all);
  all.blow_of_body.resize(m.rigid->bodies.size());
  std::iota(all.blow_of_body.begin(), all.blow_of_body.end(), Index{0});
  double held_by_all = 0;
  each_pair(*m.rigid, all, [&](std::span<const OfPair>, const PairSum& sum) { held_by_all += std::max(0.0, sum.left); });
  const auto visit_those_that_act = [&](auto&& visit) {
    each_pair(*m.rigid, all, [&](std::span<const OfPair> pair, const PairSum& sum) {
      if (gives_back(sum) || passes_on(sum, held_by_all)) visit(pair, sum);
    });
  };
  visit_those_that_act([&](std::span<const OfPair> pair, const PairSum&) {
    for (const OfPair& at : pair) join(*m.rigid, all.contactors[at.contactor], all);
  });
  const auto root = [&](std::span<const OfPair> pair) { return root_of(a_free_body_of(*m.rigid, pair[0]), all.blow_of_body); };
  Subset blow_of_root(all.blow_of_body.size(), -1);
  visit_those_that_act([&](std::span<const OfPair> pair, const PairSum& sum) {
    Index& blow = blow_of_root[root(pair)];
    if (blow < 0 && gives_back(sum)) blow = static_cast<Index>(all.blows.size()), all.blows.emplace_back();
  });
  visit_those_that_act([&](std::span<const OfPair> pair, const PairSum& sum) {
    const Index blow = blow_of_root[root(pair)];
    if (sum.impulse == 0) set_impulses_by_energy(pair, all);
    for (const OfPair& at : pair) all.contactors[at.contactor].blow = blow;
  });
  lose(all);
  return !all.blows.empty();
}

void give_back_blows(const Motion& m, Multipliers& all) {
  if (all.blows[0].scale == 0) strike(m, all), follow(m, all);
  for (int round = 0; round < rounds; ++round) {
    find_work(m, all);
    find_what_is_left(all);
    if (std::all_of(all.blows.begin(), all.blows.end(), [](const Blow& b) { return std::abs(b.left) <= small_rest * b.energy; })) return;
    add_impulses(m, find_factors(all), all);
    follow(m, all);
  }
}

void share_out_blows(std::span<Pool> pools, Multipliers& all) {
  if (all.blows.empty()) return;
  std::vector<double> impulse(all.blows.size(), 0);
  const auto impulse_in = [&](const Contactor& one) {
    return std::accumulate(&all.blow_impulse[one.first], &all.blow_impulse[one.first] + (one.last - one.first), 0.0);
  };
  for (Blow& blow : all.blows) blow.left = 0;
  for (const Contactor& one : all.contactors)
    if (one.blow >= 0) all.blows[one.blow].left += one.memory->held, impulse[one.blow] += impulse_in(one);
  for (Pool& pool : pools) {
    pool.held = pool.deficit = 0;
    for (Index k = pool.first; k < pool.last; ++k) {
      const Contactor& one = all.contactors[k];
      double& held = one.memory->held;
      if (one.blow >= 0 && impulse[one.blow] > 0) {
        const double share = all.blows[one.blow].left * impulse_in(one) / impulse[one.blow];
        *pool.transferred += held - share;
        held = share;
      }
      (held < 0 ? pool.deficit : pool.held) += std::abs(held);
    }
  }
}

void update_blow(const Contactor& one, const Multipliers& all) {
  if (!one.is_rigid) return;
  Restitution& memory = *one.memory;
  const auto is_of_a_blow = [](const Condition& c) { return c.impulse * c.per_mass > much_faster * std::abs(c.free - c.before); };
  const bool is_struck = std::any_of(&all.conditions[one.first], &all.conditions[one.first] + (one.last - one.first), is_of_a_blow);
  const bool goes_on = one.blow < 0 && (memory.held > 0 || is_struck);
  memory.blow = goes_on ? memory.blow + impulse_of(one, all) : 0;
}

}  // namespace nereid::contact
