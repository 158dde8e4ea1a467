#include "contact/multiplier/restitution.hpp"

#include <algorithm>
#include <cmath>

#include "contact/multiplier/blow.hpp"
#include "contact/multiplier/solve.hpp"
#include "contact/multiplier/stick.hpp"

namespace nereid::contact {

namespace {

constexpr double own_share = 0.5;       // of the force with which a wave leaves a node that moves with what is held
constexpr double fallen = 0.5;          // of the largest force: the middle of the front that ends a contact
constexpr double settled = 8;           // times a wave takes through the node's mass: a layer of elements turns round in six
constexpr double small_loss = 1e-3;     // of what is held: less, taken in a step, delays no release
constexpr double no_force = 1e-14;      // of the energy with which a node goes apart: so much of what it held is no force
constexpr double least_held = 1e-3;     // of what is taken in a step: a contactor that holds less gives nothing back in that step
constexpr double stands = 1e-8;         // of the square of the rate with which a node leaves: one that goes in by less does so by round-off
constexpr double much_faster = 10;      // times the change of speed by forces in a step
constexpr double small_rest = 1e-6;     // of what is held: less is not worth another round
constexpr int rounds_of_rigid = 30;     // in which contactors of rigid bodies give back what they hold
constexpr int passes = 8;               // in which gaps are closed again

/// The condition of a contactor that presses hardest.
Condition& hardest(const Contactor& one, Multipliers& all) {
  Index best = one.first;
  for (Index i = one.first + 1; i < one.last; ++i)
    if (all.conditions[i].impulse > all.conditions[best].impulse) best = i;
  return all.conditions[best];
}

/// What one more impulse d of each condition adds to the energy, at most the sum of  d (B + A/2 d),  where the changes of all other
/// conditions are in v - v_free and A bounds what they change in each other.
struct Gain {
  double B, A;
  double of(double d) const { return d * (B + 0.5 * A * d); }
  double impulse_for(double energy) const { return std::max(0.0, (-B + std::sqrt(std::max(0.0, B * B + 2 * A * energy))) / A); }
};
Gain gain(const Condition& c, double after) { return {0.5 * (c.before - c.free) + after, c.bound}; }

/// Calls visit(condition, share) for the conditions along which a contactor gives back what it holds: as it is pressed, so that a node on
/// a ridge goes back along neither side; without an impulse along the one that presses hardest.
template <class Visit>
void each_share(const Contactor& one, Condition& hardest, Multipliers& all, Visit&& visit) {
  const double pressed = impulse_of(one, all);
  if (!(pressed > 0)) return visit(hardest, 1.0);
  for (Index i = one.first; i < one.last; ++i) visit(all.conditions[i], all.conditions[i].impulse / pressed);
}

/// The same of one more impulse of a contactor in these shares.
Gain gain(const Contactor& one, Condition& hardest, Multipliers& all) {
  Gain sum{0, 0};
  each_share(one, hardest, all, [&](Condition& c, double share) {
    const Gain by = gain(c, rate(c, all));
    sum.B += share * by.B, sum.A += share * share * by.A;
  });
  return sum;
}

/// Whether a contactor is without a force, or has one that only what it holds could make: which has fallen to that, as where a body has
/// turned round, or has long been so, as of a body that flows.
bool releases(const Contactor& one, const Condition& c, double pressed, double h, double t) {
  const Restitution& memory = *one.memory;
  if (memory.held < least_held * -one.work) return false;  // what is left of a blow before, as another begins
  if (!(pressed > 0)) return true;
  const double own = own_share * one.impedance * std::sqrt(2 * memory.held * c.per_mass), little = fallen * memory.most_force;
  const double larger = std::max(pressed, memory.mean_force), time = 1 / (c.per_mass * one.impedance);
  const double since = t - memory.last_loss + 0.5 * h;
  return larger < own && since >= (larger < little ? time : settled * time);
}

/// Whether an energy that a contactor holds is of a blow, and not of forces that press it in every step: it leaves much faster than these
/// move it.
bool is_blow(double held, const Condition& c) {
  const double in_a_step = much_faster * (c.free - c.before);
  return 2 * held * c.per_mass > in_a_step * in_a_step;
}

double left_of(const Contactor& one) { return one.memory->held - one.work - one.lost; }

/// Sets what the iterations have left of each impulse. A release closes gaps again and lets friction follow, but takes no part of this:
/// else the slightest of them would change all impulses by it, and round-off decides whether there is one.
void find_rests(Multipliers& all) {
  for (const Contactor& one : all.contactors) {
    for (Index i = one.first; i < one.last; ++i) {
      Condition& c = all.conditions[i];
      c.rest = std::max(0.0, (c.least - rate(c, all)) / c.bound);
    }
    if (one.friction < 0) continue;
    FrictionCondition& friction = all.frictions[one.friction];
    find_change(rubbing_impulse_of(one, all), rate(friction, all), friction);
    friction.rest = friction.change;
  }
  for (FrictionCondition& friction : all.frictions) friction.change.setZero();
}

/// Sets the changes by which contactors give back what they hold, as far as the bounds of what they change in each other let them.
///
/// first     whether they are to be asked if they let go; else those that have after a blow go on together: what one has given too much, by
///           what others gave, they have less
/// returns   whether any gave something
bool give_back(const Motion& m, double t, bool first, Multipliers& all) {
  const double h = 0.5 * (m.dt + m.next);
  bool any = false;
  double sum = 0, positive = 0, held = 0;
  for (const Contactor& one : all.contactors) {
    if (first || !one.releases) continue;
    sum += left_of(one), positive += std::max(0.0, left_of(one)), held += one.memory->held;
  }
  const double part = first ? 1 : sum / positive;
  if (!first && !(sum > small_rest * held)) return false;
  for (Contactor& one : all.contactors) {
    for (Index i = one.first; i < one.last; ++i) all.conditions[i].change = 0;
    const Restitution& memory = *one.memory;
    if (one.is_rigid) continue;  // gives back by find_blows()
    const double left = part * left_of(one);
    if (!(memory.held > 0) || !(left > 0)) continue;
    Condition& c = hardest(one, all);
    const bool goes = first ? releases(one, c, impulse_of(one, all) / h, h, t) : one.releases;
    if (!goes) continue;
    if (first) one.releases = is_blow(memory.held, c);
    const Gain by = gain(one, c, all);
    if (by.B < 0 && by.B * by.B > stands * left * by.A) continue;  // on its way in
    if (left * by.A < no_force * by.B * by.B) continue;            // released before
    const double lost = (1 - one.square) * std::max(0.0, left - memory.kept);
    one.lost += lost;
    one.memory->kept = left - lost;
    const double impulse = by.impulse_for(left - lost);
    each_share(one, c, all, [&](Condition& condition, double share) { condition.change = share * impulse; });
    one.work += left - lost;
    any = any || impulse > 0;
  }
  return any;
}

}  // namespace

void release(const Motion& m, double t, Multipliers& all) {
  for (FrictionCondition& condition : all.frictions) condition.change.setZero();
  const bool strikes = find_blows(m, all), gives = give_back(m, t, true, all);
  if (!strikes && !gives) return;
  find_rests(all);
  if (gives) apply_changes(m, all);
  // rigid bodies leave in one step, and what several contactors hold of one blow is to be gone by then
  for (int round = 1; m.rigid && gives && round < rounds_of_rigid; ++round) {
    find_work(m, all);
    if (!give_back(m, t, false, all)) break;
    apply_changes(m, all);
  }
  if (strikes) give_back_blows(m, all);
  bool any = true;
  // gaps that this has made negative, with what each holds itself
  for (int pass = 0; pass < passes && (any || all.ties.touched); ++pass) {
    any = false;
    for (Contactor& one : all.contactors)
      for (Index i = one.first; i < one.last; ++i) {
        Condition& c = all.conditions[i];
        const double after = rate(c, all);
        const Gain by = gain(c, after);
        const double left = one.blow >= 0 ? 0 : std::max(0.0, one.memory->held - one.work - one.lost);
        c.change = std::max(0.0, (c.least - after) / c.bound - c.rest);
        if (c.change > 0 && by.of(c.change) > left) c.change = by.impulse_for(left);
        one.work += by.of(c.change);
        any = any || c.change != 0;
      }
    if (any || all.ties.touched) apply_changes(m, all);
  }
  for (int pass = 0; pass < passes && !all.frictions.empty(); ++pass) {  // what is given back presses, too
    follow_release(all);
    apply_changes(m, all);
  }
  if (strikes) give_back_blows(m, all);  // gaps that closed and friction have changed what was given
  find_work(m, all);
}

BlowLimit limit_of_blows(double energy, bool goes_on, const Multipliers& all) {
  BlowLimit limit{.energy = energy};
  double sum = 0, taken = 0, most = 0;
  std::size_t at = 0;
  for (std::size_t k = 0; k < all.contactors.size(); ++k) {
    const Contactor& one = all.contactors[k];
    if (!std::isfinite(one.impedance)) continue;  // rigid bodies do not ring, and plates not through their thickness
    const Condition& c = all.conditions[static_cast<std::size_t>(one.first)];
    const double b = std::max(0.0, one.memory->held - std::min(0.0, one.work));
    if (!goes_on && !is_blow(b, c)) continue;
    const double rate = c.per_mass * one.impedance, part = b * rate * rate;  // rate is 1/tau
    sum += part, taken += b;
    if (part > most) most = part, at = k;
  }
  if (!(sum > 0)) return limit;
  limit.energy = std::max(energy, taken);
  limit.step = 2 * std::sqrt(most_ringing * limit.energy / sum);
  const Condition& c = all.conditions[static_cast<std::size_t>(all.contactors[at].first)];
  limit.node = members_of(c, all)[0].node;
  limit.of = static_cast<std::size_t>(std::upper_bound(all.first.begin(), all.first.end(), static_cast<Index>(at)) - all.first.begin()) - 1;
  return limit;
}

double update_restitution(const Motion& m, double t, Pool& pool, Multipliers& all) {
  const double h = 0.5 * (m.dt + m.next);
  double lost = 0;
  for (Index k = pool.first; k < pool.last; ++k) {
    const Contactor& one = all.contactors[k];
    Restitution& memory = *one.memory;
    if (-one.work > small_loss * memory.held) memory.last_loss = t, memory.most_force = 0;
    memory.held -= one.work + one.lost;
    memory.kept = std::clamp(memory.held, 0.0, memory.kept);
    update_blow(one, all);
    (memory.held < 0 ? pool.deficit : pool.held) += std::abs(memory.held);
    lost += one.lost;
    const double pressed = impulse_of(one, all) / h;
    const double time = 2 / (hardest(one, all).per_mass * one.impedance);
    memory.mean_force += (pressed - memory.mean_force) * (time > m.next ? m.next / time : 1);
    memory.most_force = std::max(memory.most_force, memory.mean_force);
  }
  return lost;
}

double held(Index first, Index last, const Multipliers& all) {
  double sum = 0;
  for (Index k = first; k < last; ++k) sum += std::max(0.0, all.contactors[k].memory->held);
  return sum;
}

void balance(std::span<Pool> pools, Multipliers& all) {
  double held_by_all = 0, deficit = 0;
  for (const Pool& pool : pools) held_by_all += pool.held, deficit += pool.deficit;
  if (!(deficit > 0)) return;
  const double covered = std::min(1.0, held_by_all / deficit), left = deficit < held_by_all ? 1 - deficit / held_by_all : 0;
  for (Pool& pool : pools) {
    pool.held *= left, pool.deficit *= 1 - covered;
    for (Index k = pool.first; k < pool.last; ++k) {
      double& one = all.contactors[k].memory->held;
      const double before = one;
      one *= one > 0 ? left : 1 - covered;
      *pool.transferred += before - one;
    }
  }
}

void balance_friction(std::span<Pool> pools) {
  double taken = 0, given = 0;
  for (const Pool& pool : pools) (pool.rubbed < 0 ? given : taken) += std::abs(pool.rubbed);
  if (!(given > 0) || !(taken > 0)) return;
  const double covered = std::min(1.0, taken / given), left = std::max(0.0, 1 - given / taken);
  for (Pool& pool : pools) {
    const double before = pool.rubbed;
    pool.rubbed *= before > 0 ? left : 1 - covered;
    *pool.transferred += before - pool.rubbed;
  }
}

void pay_for_friction(Pool& pool, Multipliers& all) {
  if (!(pool.rubbed < 0)) return;
  const double sum = held(pool.first, pool.last, all);
  if (!(sum > 0)) return;
  const double paid = std::min(sum, -pool.rubbed);
  for (Index k = pool.first; k < pool.last; ++k) {
    double& one = all.contactors[k].memory->held;
    if (one > 0) one *= 1 - paid / sum;
  }
  pool.rubbed += paid;
}

void spread_unreleased(Multipliers& all) {
  std::fill(all.at_node.begin(), all.at_node.end(), UnreleasedAtNode{});
  for (const Condition& c : all.conditions)
    for (const Member& one : members_of(c, all)) ++all.at_node[one.node].conditions;
  for (const Unreleased& one : all.unreleased) {
    const std::span nodes(one.node.begin(), static_cast<std::size_t>(one.nodes));
    const auto acts = [&](Index node) { return all.at_node[node].conditions > 0; };
    const auto count = std::count_if(nodes.begin(), nodes.end(), acts);
    (count == 0 ? *one.impact : *one.transferred) += one.energy;
    for (const Index node : nodes)
      if (acts(node)) all.at_node[node].energy += one.energy / static_cast<double>(count);
  }
}

void take_unreleased(Index first, Index last, double& transferred, Multipliers& all) {
  for (Index k = first; k < last; ++k) {
    const Contactor& one = all.contactors[k];
    for (Index i = one.first; i < one.last; ++i) {
      const Condition& c = all.conditions[i];
      for (const Member& member : members_of(c, all)) {
        const UnreleasedAtNode& at = all.at_node[member.node];
        const double part = at.energy / at.conditions;
        one.memory->held += part, one.memory->kept += part;
        transferred -= part;
      }
    }
  }
}

namespace {

double deficit(const Restitution& one) { return std::max(0.0, -one.held); }

template <class Remembered>
double deficits_of_nodes(const Remembered& memory) {
  double sum = memory.friction_deficit;
  for (const Restitution& one : memory.restitution) sum += deficit(one);
  return sum;
}

}  // namespace

double deficit(const Memory& memory) { return deficits_of_nodes(memory); }
double deficit(const PlaneMemory& memory) { return deficits_of_nodes(memory); }
double deficit(const EdgeMemory& memory) {
  double sum = memory.friction_deficit;
  for (const Crossing& one : memory.crossings) sum += deficit(one.restitution);
  return sum;
}

}  // namespace nereid::contact
