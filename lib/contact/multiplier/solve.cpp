#include "contact/multiplier/solve.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contact/multiplier/rigid_nodes.hpp"
#include "contact/multiplier/stick.hpp"

namespace nereid::contact {

namespace {

constexpr int usual_iterations = 8, most_iterations = 100;
constexpr int most_for_overlaps = 1000;  // of thin elements
constexpr int rounds_of_turns = 4;       // of rigid bodies
constexpr double turned = 1e-5;          // of what an impulse does: rates of bodies that turn may differ by so much
constexpr double still = 1e-6;     // of what the impulses do: iterations end as soon as one changes less
constexpr double settled = 1e-5;   // the same: enough without friction, whose sticks need more iterations beside heavy loads
constexpr double may_gain = 1e-4;  // of the energy that the impulses exchange: iterations go on while single contactors gain more
constexpr double may_close = 0.01;  // of the depth of an element: the same, while a gap would be more negative in the step to come

/// How far the constraints of a node turn an impulse along a normal into the plane across it. [-]
double slant(const Motion& m, Index node, const Vec3& normal) {
  if (!m.allowed[node]) return 0;
  const Vec3 let = *m.allowed[node] * normal;
  return (let - normal.dot(let) * normal).norm();
}

/// Bounds of what all impulses together change in each rate: an iteration by them overshoots nowhere, whatever the order.
///
///     1/a  sum over the nodes of |w| S |P n| / m,   S = sum of |w| a of all conditions at the node
///
/// with any a > 0 (Gershgorin's circles of the matrix with rows and columns scaled). Impulses go with the areas, so these are good, and
/// half a body on its symmetry plane has nearly the iterations of the whole one. Friction has the same with its own weights. Where edges
/// cross it acts along their normal too, by its lifts, which count as weights of both. Where constraints slant to the normal, an impulse
/// along it changes slip rates, and friction normal rates.
void find_bounds(const Motion& m, Multipliers& all) {
  if (m.rigid) leave_out(*m.rigid, all);
  const bool rubs = !all.frictions.empty();
  for (const Contactor& one : all.contactors) {
    const double per_area = 1 / one.area;
    for (Index i = one.first; i < one.last; ++i) {
      Condition& c = all.conditions[i];
      double sum = 0;
      for (const Member& at : members_of(c, all)) {
        const double size = std::abs(at.weight), let = m.allowed[at.node] ? let_through(m, at).norm() : size;
        double shared = let * all.shared(at.node);
        if (rubs) shared += size * slant(m, at.node, c.normal) * all.rubbed(at.node);
        sum += all.mobility(at.node) * shared;
      }
      c.bound = per_area * sum;
    }
    if (one.friction < 0) continue;
    FrictionCondition& condition = all.frictions[one.friction];
    const Touch& touch = condition.touch;
    double alone = 0, together = 0, across = 0;
    const auto see = [&](Index node, double weight, double lift) {
      const double mobility = 1 / m.mass(node);
      alone += mobility * (weight * weight + lift * lift);
      together += mobility * per_area * (weight * all.rubbed(node) + lift * all.shared(node));
      across += mobility * per_area * slant(m, node, touch.normal) * weight * all.shared(node);
    };
    if (touch.apex >= 0) see(touch.apex, 1, 0);
    for (int j = 0; j < touch.nodes; ++j) see(touch.node[j], std::abs(touch.weight[j]), touch.apex < 0 ? touch.lift[j].norm() : 0);
    condition.bound = condition.per_mass * together / alone + across;
  }
  if (m.rigid) add_bounds(*m.rigid, m, all);
}

/// Lets one contactor iteration: its impulses change by the rates that all impulses have made so far, and go on by some of what they moved
/// (Nesterov's momentum).
NEREID_HOT void iteration(double momentum, const Contactor& one, Multipliers& all, Progress& sum) {
  double pressed = 0;
  for (Index i = one.first; i < one.last; ++i) {
    Condition& c = all.conditions[i];
    const double now = std::max(0.0, c.impulse + (c.least - rate(c, all)) / c.bound), A2 = c.per_mass * c.per_mass;
    c.moved = now - c.met;
    c.met = now;
    if ((one.rubs >> (i - one.first) & 1u) != 0) pressed += now;
    sum.moved += c.moved * c.moved * A2, sum.made += now * now * A2;
    sum.turned += c.bound * (now - c.impulse) * c.moved;
    const double change = now + momentum * c.moved - c.impulse;
    c.impulse += change;
    if (change != 0) give(c.row, change, all.rows);
  }
  if (one.friction < 0) return;
  FrictionCondition& friction = all.frictions[one.friction];
  find_change(pressed, rate(friction, all), friction);
  const Vec3 now = friction.impulse + friction.change;
  const double A2 = friction.per_mass * friction.per_mass;
  friction.moved = now - friction.met;
  friction.met = now;
  sum.moved_along += friction.moved.squaredNorm() * A2, sum.made_along += now.squaredNorm() * A2;
  sum.turned += friction.bound * (now - friction.impulse).dot(friction.moved);
  friction.change += momentum * friction.moved;
  friction.impulse += friction.change;
  if (!friction.change.isZero(0)) give(friction, friction.change, all.rows);
}

/// What an iteration has done to all contacts.
struct IterationResult {
  double turned = 0;  ///< [J] below zero, and the momentum is to begin anew (O'Donoghue & Candes 2015)
  double change = 0;  ///< [-] of the impulses over all that they do, of the contact where that is most, friction for itself; by
                      ///< velocities, so that light bodies count beside heavy ones
};

/// One iteration of all contactors, in any order: no rate changes before move_all().
IterationResult iteration(double momentum, Multipliers& all) {
  const auto count = static_cast<Index>(all.contactors.size());
  const Index ranges = (count + contactors_of_a_range - 1) / contactors_of_a_range;
  const auto contacts = all.first.size() - 1;
  all.progress.assign(static_cast<std::size_t>(ranges) * contacts, {});
  parallel_for(ranges, 1, [&](Index r) {
    const Index begin = r * contactors_of_a_range, end = std::min(count, begin + contactors_of_a_range);
    std::size_t contact = 0;
    for (Index k = begin; k < end; ++k) {
      while (k >= all.first[contact + 1]) ++contact;
      iteration(momentum, all.contactors[k], all, all.progress[static_cast<std::size_t>(r) * contacts + contact]);
    }
  });
  IterationResult result;
  for (std::size_t contact = 0; contact < contacts; ++contact) {
    Progress sum;
    for (Index r = 0; r < ranges; ++r) {
      const Progress& part = all.progress[static_cast<std::size_t>(r) * contacts + contact];
      sum.turned += part.turned;
      sum.moved += part.moved, sum.made += part.made;
      sum.moved_along += part.moved_along, sum.made_along += part.made_along;
    }
    result.turned += sum.turned;
    if (sum.moved > 0) result.change = std::max(result.change, sum.moved / sum.made);
    if (sum.moved_along > 0) result.change = std::max(result.change, sum.moved_along / sum.made_along);
  }
  result.change = std::sqrt(result.change);
  return result;
}

/// Leaves out the momentum of the last iteration, so that no impulse pulls.
void leave_out_momentum(Multipliers& all) {
  for (Condition& c : all.conditions) c.change = c.met - c.impulse;
  for (FrictionCondition& f : all.frictions) f.change = f.met - f.impulse;
}

/// Whether single contactors gain energy that counts, beyond what they hold and may give back.
bool gains(const Multipliers& all) {
  double gained = 0, exchanged = 0;
  for (const Contactor& one : all.contactors) {
    double sum = 0;
    for (Index i = one.first; i < one.last; ++i) {
      const Condition& c = all.conditions[i];
      sum += work(c, rate(c, all));
      exchanged += 0.5 * c.impulse * c.impulse * c.per_mass;
    }
    // where it rubs, what iterations leave of its push goes into friction
    gained += std::max(0.0, sum - (one.friction < 0 ? std::max(0.0, one.memory->held) : 0));
    if (one.friction < 0) continue;
    const FrictionCondition& friction = all.frictions[one.friction];
    gained += std::max(0.0, work(friction, rate(friction, all)));
    exchanged += 0.5 * friction.impulse.squaredNorm() * friction.per_mass;
  }
  return gained > may_gain * exchanged;
}

/// Whether the rate that iterations have left would penetrate by what counts of an element: thin elements are less deep than a node
/// moves in a step, and light ones beside heavy ones take many iterations.
bool overlaps(const Motion& m, const Multipliers& all) {
  for (const Contactor& one : all.contactors)
    for (Index i = one.first; i < one.last; ++i) {
      const Condition& c = all.conditions[i];
      if (one.depth > 0 && (c.least - rate(c, all)) * m.next > may_close * one.depth) return true;
    }
  return false;
}

/// Whether any contactor is between rigid bodies alone: nothing follows their blow that would even out what iterations leave.
bool any_between_rigid_bodies(const Motion& m, const Multipliers& all) {
  if (!m.rigid) return false;
  return std::any_of(all.contactors.begin(), all.contactors.end(), [&](const Contactor& one) {
    const auto members = members_of(all.conditions[one.first], all);
    return std::all_of(members.begin(), members.end(), [&](const Member& at) { return m.rigid->of_node[at.node] >= 0; });
  });
}

/// Iterations until nothing changes; or until no contactor gains energy or penetrates by what counts, and none is between rigid bodies.
///
/// returns the number of iterations
int iterate(const Motion& m, bool to_the_end, Multipliers& all) {
  double t = 1;
  int iterations = 1;
  for (; iterations <= most_for_overlaps; ++iterations) {
    const double next = 0.5 * (1 + std::sqrt(1 + 4 * t * t));
    const IterationResult made = iteration(iterations > 1 ? (t - 1) / next : 0, all);
    t = made.turned < 0 ? 1 : next;
    move_all(m, all);
    if (!(made.change > still)) break;
    if (iterations % 2 > 0 || (iterations < usual_iterations && !(made.change < settled && all.frictions.empty()))) continue;
    if (!(iterations < most_iterations && (to_the_end || gains(all))) && !overlaps(m, all)) break;
  }
  leave_out_momentum(all);
  apply_changes(m, all);
  return std::min(iterations, most_for_overlaps);
}

/// The largest velocity that an impulse of a condition makes by itself. [m/s]
double largest_effect(const Multipliers& all) {
  double most = 0;
  for (const Condition& c : all.conditions) most = std::max(most, c.per_mass * c.impulse);
  return most;
}

}  // namespace

void move_all(const Motion& m, Multipliers& all) {
  move(all.rows);
  if (!all.ties.touched) return;
  for (const Mover& mover : all.rows.movers)
    if (mover.kind == MoverKind::node) all.velocity.col(mover.of) = velocity_of(mover, all.rows);
  hold(m, all.velocity, all.ties);
  for (const Mover& mover : all.rows.movers)
    if (mover.kind == MoverKind::node && all.ties.has[mover.of]) place(mover, padded(all.velocity.col(mover.of)), all.rows);
}

void apply_changes(const Motion& m, Multipliers& all) {
  for (const Contactor& one : all.contactors) {
    for (Index i = one.first; i < one.last; ++i) {
      Condition& c = all.conditions[i];
      if (c.change == 0) continue;
      c.impulse += c.change;
      give(c.row, c.change, all.rows);
    }
    if (one.friction < 0 || all.frictions[one.friction].change.isZero(0)) continue;
    FrictionCondition& condition = all.frictions[one.friction];
    condition.impulse += condition.change;
    give(condition, condition.change, all.rows);
  }
  move_all(m, all);
}

int solve(const Motion& m, Multipliers& all) {
  make_rows(m, all);
  find_bounds(m, all);
  const bool to_the_end = any_between_rigid_bodies(m, all);
  for (const Condition& c : all.conditions)
    if (c.impulse > 0) give(c.row, c.impulse, all.rows);
  for (const FrictionCondition& f : all.frictions)
    if (!f.impulse.isZero(0)) give(f, f.impulse, all.rows);
  move_all(m, all);
  int iterations = iterate(m, to_the_end, all);
  // rigid bodies turn by angles that are not small: until their rates are those of the step
  for (int round = 1; round < rounds_of_turns && find_velocities(m, all) > turned * largest_effect(all); ++round)
    iterations += iterate(m, to_the_end, all);
  return iterations;
}

}  // namespace nereid::contact
