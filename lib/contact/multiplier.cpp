#include "contact/multiplier.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/parallel.hpp"
#include "contact/apex.hpp"
#include "contact/blow.hpp"
#include "contact/crossing.hpp"
#include "contact/meeting.hpp"
#include "contact/restitution.hpp"
#include "contact/rigid_nodes.hpp"

namespace nereid::contact {

namespace {

constexpr int usual_sweeps = 8, most_sweeps = 100;
constexpr int most_for_overlaps = 1000;  // of thin elements
constexpr int rounds_of_turns = 4;       // of rigid bodies
constexpr double turned = 1e-5;          // of what an impulse does: rates of bodies that turn may differ by so much
constexpr double still = 1e-6;     // of what the impulses do: sweeps end as soon as one changes less
constexpr double settled = 1e-5;   // the same: fewer sweeps than usual will do without friction, whose sticks need more beside heavy loads
constexpr double is_trend = 0.04;  // of the squared changes of impulses: less that their trend left of them, and it is trusted once more
constexpr double may_gain = 1e-4;  // of the energy that the impulses exchange: sweeps go on while single contactors gain more
constexpr double may_close = 0.01;  // of the depth of an element: the same, while a gap would be more negative in the step to come

/// Whether the forces of all apexes can have a moment, and not only of those that say so.
bool all_have_moments(const Interface& interface) { return !interface.allowed.empty() || interface.weights == Weights::paper; }

/// Books the moments of one apex in half of a step.
///
/// later  [s] at which positions they count, after t
void book_moments(const Interface& interface, const Motion& m, double later, const Near& near, Memory& memory) {
  const double half = 0.5 * m.dt;
  memory.angular_impulse += half * moment(interface, memory.shares, m.x, m.v, later, near.apex, near.element);
  if (near.friction.acts && all_have_moments(interface))
    memory.angular_impulse += half * moment_of_friction(near.friction.touch, near.friction.force, m.x, m.v, later);
}

/// Books the first half of the step that led to t, in which the forces of the memory have acted.
void book_first_half(const Interface& interface, const Motion& m, Memory& memory) {
  const double half = 0.5 * m.dt;
  const bool rubs = interface.friction.coefficient > 0, turns = all_have_moments(interface);
  book_first_half_of_crossings(m, memory);
  for (const Near& near : memory.near) {
    if (!near.element.closed) continue;
    memory.work += half * power(interface, memory.shares, m.v, near.apex, near.element);
    if (rubs && near.friction.acts)
      memory.work += half * near.friction.force.dot(slip_rate(near.friction.touch, m.v, m.omega, m.rotation_of_node));
    if (turns || near.element.has_moment) book_moments(interface, m, -m.dt, near, memory);
  }
}

/// How far the constraints of a node turn an impulse along a normal into the plane across it. [-]
double slant(const Motion& m, Index node, const Vec3& normal) {
  if (!m.allowed[node]) return 0;
  const Vec3 let = *m.allowed[node] * normal;
  return (let - normal.dot(let) * normal).norm();
}

/// Bounds of what all impulses together change in each rate: a sweep by them overshoots nowhere, whatever the order.
///
///     1/a  sum over the nodes of |w| S |P n| / m,   S = sum of |w| a of all conditions at the node
///
/// with any a > 0 (Gershgorin's circles of the matrix with rows and columns scaled). Impulses go with the areas, so these are good, and
/// half a body on its symmetry plane has nearly the sweeps of the whole one. Friction has the same with its own weights. Where edges cross
/// it acts along their normal too, by its lifts, which count as weights of both. Where constraints slant to the normal, an impulse along
/// it changes slip rates, and friction normal rates.
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

/// Lets one contactor sweep: its impulses change by the rates that all impulses have made so far, and go on by some of what they moved
/// (Nesterov's momentum).
NEREID_HOT void sweep(double momentum, const Contactor& one, Multipliers& all, Progress& sum) {
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

/// What a sweep has done to all contacts.
struct Swept {
  double turned = 0;  ///< [J] below zero, and the momentum is to begin anew (O'Donoghue & Candes 2015)
  double change = 0;  ///< [-] of the impulses over all that they do, of the contact where that is most, friction for itself; by
                      ///< velocities, so that light bodies count beside heavy ones
};

/// One sweep of all contactors, in any order: no rate changes before move_all().
Swept sweep(double momentum, Multipliers& all) {
  const auto count = static_cast<Index>(all.contactors.size());
  const Index ranges = (count + contactors_of_a_range - 1) / contactors_of_a_range;
  const auto contacts = all.first.size() - 1;
  all.progress.assign(static_cast<std::size_t>(ranges) * contacts, {});
  parallel_for(ranges, 1, [&](Index r) {
    const Index begin = r * contactors_of_a_range, end = std::min(count, begin + contactors_of_a_range);
    std::size_t contact = 0;
    for (Index k = begin; k < end; ++k) {
      while (k >= all.first[contact + 1]) ++contact;
      sweep(momentum, all.contactors[k], all, all.progress[static_cast<std::size_t>(r) * contacts + contact]);
    }
  });
  Swept swept;
  for (std::size_t contact = 0; contact < contacts; ++contact) {
    Progress sum;
    for (Index r = 0; r < ranges; ++r) {
      const Progress& part = all.progress[static_cast<std::size_t>(r) * contacts + contact];
      sum.turned += part.turned;
      sum.moved += part.moved, sum.made += part.made;
      sum.moved_along += part.moved_along, sum.made_along += part.made_along;
    }
    swept.turned += sum.turned;
    if (sum.moved > 0) swept.change = std::max(swept.change, sum.moved / sum.made);
    if (sum.moved_along > 0) swept.change = std::max(swept.change, sum.moved_along / sum.made_along);
  }
  swept.change = std::sqrt(swept.change);
  return swept;
}

/// Leaves out the momentum of the last sweep, so that no impulse pulls.
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
    // where it rubs, what sweeps leave of its push goes into friction
    gained += std::max(0.0, sum - (one.friction < 0 ? std::max(0.0, one.memory->held) : 0));
    if (one.friction < 0) continue;
    const FrictionCondition& friction = all.frictions[one.friction];
    gained += std::max(0.0, work(friction, rate(friction, all)));
    exchanged += 0.5 * friction.impulse.squaredNorm() * friction.per_mass;
  }
  return gained > may_gain * exchanged;
}

/// Whether what sweeps have left of a rate would penetrate by what counts of an element: thin ones are less deep than the way of a step, of
/// which a part is soon too much, and light ones beside heavy ones take many sweeps.
bool overlaps(const Motion& m, const Multipliers& all) {
  for (const Contactor& one : all.contactors)
    for (Index i = one.first; i < one.last; ++i) {
      const Condition& c = all.conditions[i];
      if (one.depth > 0 && (c.least - rate(c, all)) * m.next > may_close * one.depth) return true;
    }
  return false;
}

/// Whether any contactor is between rigid bodies alone: nothing follows their blow that would even out what sweeps leave.
bool any_between_rigid_bodies(const Motion& m, const Multipliers& all) {
  if (!m.rigid) return false;
  return std::any_of(all.contactors.begin(), all.contactors.end(), [&](const Contactor& one) {
    const auto members = members_of(all.conditions[one.first], all);
    return std::all_of(members.begin(), members.end(), [&](const Member& at) { return m.rigid->of_node[at.node] >= 0; });
  });
}

/// Sweeps until nothing changes, or no contactor gains energy that counts nor penetrates by what counts and none is between rigid bodies.
///
/// returns how often it swept
int iterate(const Motion& m, bool to_the_end, Multipliers& all) {
  double t = 1;
  int sweeps = 1;
  for (; sweeps <= most_for_overlaps; ++sweeps) {
    const double next = 0.5 * (1 + std::sqrt(1 + 4 * t * t));
    const Swept made = sweep(sweeps > 1 ? (t - 1) / next : 0, all);
    t = made.turned < 0 ? 1 : next;
    move_all(m, all);
    if (!(made.change > still)) break;
    if (sweeps % 2 > 0 || (sweeps < usual_sweeps && !(made.change < settled && all.frictions.empty()))) continue;
    if (!(sweeps < most_sweeps && (to_the_end || gains(all))) && !overlaps(m, all)) break;
  }
  leave_out_momentum(all);
  apply_changes(m, all);
  return std::min(sweeps, most_for_overlaps);
}

/// The largest velocity that an impulse of a condition makes by itself. [m/s]
double largest_effect(const Multipliers& all) {
  double most = 0;
  for (const Condition& c : all.conditions) most = std::max(most, c.per_mass * c.impulse);
  return most;
}

/// Finds the impulses; returns how often it swept.
int solve(const Motion& m, Multipliers& all) {
  make_rows(m, all);
  find_bounds(m, all);
  const bool to_the_end = any_between_rigid_bodies(m, all);
  for (const Condition& c : all.conditions)
    if (c.impulse > 0) give(c.row, c.impulse, all.rows);
  for (const FrictionCondition& f : all.frictions)
    if (!f.impulse.isZero(0)) give(f, f.impulse, all.rows);
  move_all(m, all);
  int sweeps = iterate(m, to_the_end, all);
  // rigid bodies turn by angles that are not small: until their rates are those of the step
  for (int round = 1; round < rounds_of_turns && find_velocities(m, all) > turned * largest_effect(all); ++round)
    sweeps += iterate(m, to_the_end, all);
  return sweeps;
}

/// What friction takes in a step, and how much of that in the half that begins. [J]
struct FrictionLoss {
  double all = 0, to_come = 0;
};
FrictionLoss friction_loss(const Motion& m, Index first, Index last, const Multipliers& all) {
  const double share = share_to_come(m);
  FrictionLoss sum;
  if (all.frictions.empty()) return sum;
  for (Index k = first; k < last; ++k) {
    if (all.contactors[k].friction < 0) continue;
    const FrictionCondition& friction = all.frictions[all.contactors[k].friction];
    sum.all -= friction.work;
    sum.to_come -= share * friction.impulse.dot(mean_to_come(friction.before, friction.after, share));
  }
  return sum;
}

/// What the impulses of some contactors do around t.
struct Doing {
  double work = 0;        ///< [J] in the half step that ends
  double to_come = 0;     ///< [J] of the normal impulses in the half step that begins
  double power_rate = 0;  ///< [W/s] force times acceleration
};
Doing doing(const Motion& m, Index first, Index last, const Multipliers& all) {
  const double share = share_to_come(m), h = 0.5 * (m.dt + m.next);
  Doing sum;
  for (Index k = first; k < last; ++k) {
    const Contactor& one = all.contactors[k];
    for (Index i = one.first; i < one.last; ++i) {
      const Condition& c = all.conditions[i];
      if (!(c.impulse > 0)) continue;
      sum.work += c.impulse * c.before;
      sum.to_come += c.impulse * mean_to_come(c.before, c.after, share);
      sum.power_rate += c.impulse * (c.after - c.before);
    }
    if (one.friction < 0) continue;
    const FrictionCondition& friction = all.frictions[one.friction];
    sum.work += friction.impulse.dot(friction.before);
    sum.power_rate += friction.impulse.dot(friction.after - friction.before);
  }
  return {0.5 * m.dt / h * sum.work, share * sum.to_come, sum.power_rate / (h * h)};
}

/// Writes impulses into the memory of an interface as forces, and books them.
void take_over(const Interface& interface, const Motion& m, double h, double t, Index first, Index last, const Doing& now, Memory& memory,
               const Multipliers& all) {
  const bool rubs = interface.friction.coefficient > 0, turns = all_have_moments(interface);
  Index at = first < last ? all.contactors[first].first : 0, contactor = first;
  double from_trend = 0, from_before = 0;
  memory.deepest_now = 0;
  memory.shares.clear();
  const Vec3 force_before = memory.force;
  memory.force.setZero();
  for (Near& near : memory.near) {
    ElementForces& element = near.element;
    memory.stored[near.apex] = 0;
    element.closed = false;
    element.scale = 1;
    element.apex.setZero();
    element.depth = 0;
    double gap = infinite, most = 0;
    near.pressed_most = -1;
    for (int s = 0; s < element.count; ++s) {
      Stencil& stencil = element.stencil[s];
      if (stencil.apex == 0) continue;
      const Condition& c = all.conditions[at++];
      gap = std::min(gap, c.gap);
      if (c.impulse > most) most = c.impulse, near.pressed_most = stencil.facet;
      element.depth = std::max(element.depth, -c.gap);
      stencil.push *= c.impulse / h;
      if (stencil.over_points) {
        stencil.first_share = static_cast<Index>(memory.shares.size()), stencil.shares = c.nodes;
        for (int j = 0; j < c.nodes; ++j) {
          const Member& member = members_of(c, all)[static_cast<std::size_t>(j)];
          memory.shares.push_back({member.node, member.push, member.weight > 0});
        }
      }
      element.apex += stencil.push;
      element.closed = element.closed || c.impulse > 0;
    }
    if (rubs) {
      near.friction.acts = near.friction.stuck = false;
      near.friction.force.setZero();
    }
    if (rubs && gap < infinite) {
      const Contactor& one = all.contactors[contactor++];
      near.friction.stuck = element.closed && (one.friction < 0 || !all.frictions[one.friction].slides);
      if (one.friction >= 0 && element.closed) {
        near.friction.touch = all.frictions[one.friction].touch;
        near.friction.coefficient = all.frictions[one.friction].coefficient;
        near.friction.force = all.frictions[one.friction].impulse / h;
        near.friction.acts = true;
      }
    }
    if (gap < infinite) memory.gap[near.apex] = gap, memory.status[near.apex] = element.closed ? Status::closed : Status::open;
    memory.deepest_now = std::max(memory.deepest_now, element.depth);
    if (element.depth > memory.deepest) see_depth(interface, m.x, near, memory), memory.deepest_time = t;
    memory.lost += element.lost;
    if (element.moved && !near.rests) ++memory.walks, ++memory.reconnections[near.apex];
    if (element.closed) memory.force += element.apex;
    if (element.count == 1) {
      const double pressed = element.apex.norm(), off_trend = pressed - trend(near), off_before = pressed - near.pressed;
      from_trend += off_trend * off_trend, from_before += off_before * off_before;
    }
    if (element.closed && (turns || element.has_moment)) book_moments(interface, m, 0, near, memory);
    if (rubs && near.friction.acts) memory.force += near.friction.force;
  }
  memory.has_trend = from_trend < is_trend * from_before;
  if (interface.kind == InterfaceKind::edges) take_over_crossings(interface, h, t, first, last, all, memory);
  memory.work += now.work;
  memory.impulse += 0.5 * m.dt * (force_before + memory.force);
  memory.held = now.to_come + held(first, last, all) + memory.transferred;
}

/// The same for a rigid plane.
void take_over(const RigidPlane& plane, const Motion& m, double h, double t, Index first, Index last, const Doing& now, PlaneMemory& memory,
               const Multipliers& all) {
  const double deepest = memory.deepest;
  std::size_t i = 0;
  for (Index k = first; k < last; ++k) {
    const Condition& c = all.conditions[all.contactors[k].first];
    while (plane.nodes[i] != members_of(c, all)[0].node) ++i;
    memory.next_force[i] = c.impulse / h;
    const Index friction = all.contactors[k].friction;
    if (friction >= 0) memory.next_friction[i] = all.frictions[friction].impulse / h;
    if (!memory.stuck.empty()) memory.stuck[i] = c.impulse > 0 && (friction < 0 || !all.frictions[friction].slides);
  }
  advance(plane, m.x, m.v, m.dt, memory);
  if (memory.deepest > deepest) memory.deepest_time = t;
  memory.stored = now.to_come + held(first, last, all) + memory.transferred;
}

/// What acts by multipliers, and where its contactors begin in Multipliers::first.
struct Acting {
  std::span<const Interface> interfaces;
  std::span<const RigidPlane> planes;
  std::span<Memory> memories;
  std::span<PlaneMemory> of_planes;

  /// Calls visit(place, contact, memory) for each that may part, interfaces first.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t i = 0; i < interfaces.size(); ++i)
      if (by_multipliers(interfaces[i]) && !bonded_by_multipliers(interfaces[i])) visit(i, interfaces[i], memories[i]);
    for (std::size_t p = 0; p < planes.size(); ++p)
      if (by_multipliers(planes[p])) visit(interfaces.size() + p, planes[p], of_planes[p]);
  }

  /// The same of bonds: visit(interface, bonds, memory).
  template <class Visit>
  void for_each_bond(const Bonds& all, Visit&& visit) const {
    for (std::size_t i = 0; i < interfaces.size(); ++i)
      if (bonded_by_multipliers(interfaces[i])) visit(interfaces[i], bonds_of(all, i), memories[i]);
  }
};

bool is_back_pass(const Interface& interface) { return interface.pass == Pass::back; }
bool is_back_pass(const RigidPlane&) { return false; }

/// Whether a contact acts on a node of a bond.
bool any_touched(const Multipliers& all) {
  if (all.bonds.held.empty()) return false;
  for (const Contactor& one : all.contactors)
    for (Index i = one.first; i < one.last; ++i)
      for (const Member& at : members_of(all.conditions[i], all))
        if (all.bonds.has[at.node]) return true;
  return false;
}

bool is_automatic(const Interface& interface) { return interface.bodies.count() > 0 && by_multipliers(interface); }
bool any_automatic(const Acting& acting) { return std::any_of(acting.interfaces.begin(), acting.interfaces.end(), is_automatic); }

/// Searches for automatic contacts, and lists the nodes that are to be looked at.
void wake(const Acting& acting, const Motion& m, std::span<Workspace> workspaces, Multipliers& all) {
  if (!any_automatic(acting)) {
    if (!all.has_looked) all.looked_at = all.nodes, all.has_looked = true;
    return;
  }
  const double apart = speed_apart(m.v);
  bool searched = !all.has_looked;
  for (std::size_t i = 0; i < acting.interfaces.size(); ++i)
    if (is_automatic(acting.interfaces[i]))
      searched = search_bodies_where_due(acting.interfaces[i], m.x, m.v, m.dt * apart, m.next * apart, acting.memories[i], workspaces[i]) ||
                 searched;
  if (!searched) return;
  std::vector<char> looked_at(static_cast<std::size_t>(m.x.cols()), 0);
  const auto look_at = [&](Index node) {
    if (node >= 0) looked_at[static_cast<std::size_t>(node)] = 1;
  };
  for (const Index node : all.always) look_at(node);
  for (std::size_t i = 0; i < acting.interfaces.size(); ++i) {
    if (!is_automatic(acting.interfaces[i])) continue;
    const Interface& interface = acting.interfaces[i];
    const auto awake = [&](Index body) { return acting.memories[i].awake[static_cast<std::size_t>(body)] != 0; };
    for (std::size_t a = 0; a < interface.bodies.of_apex.size(); ++a)
      if (awake(interface.bodies.of_apex[a])) look_at(interface.apexes[a]);
    for (std::size_t e = 0; e < interface.edges.body.size(); ++e)
      for (int end = 0; end < 2 && awake(interface.edges.body[e]); ++end) {
        const auto edge = static_cast<Eigen::Index>(e);
        look_at(interface.edges.nodes(end, edge));
        look_at(interface.edges.across(end, edge)), look_at(interface.edges.opposite(end, edge));
      }
  }
  all.has_looked = true;
  all.looked_at.clear();
  for (std::size_t node = 0; node < looked_at.size(); ++node)
    if (looked_at[node] != 0) all.looked_at.push_back(static_cast<Index>(node));
}

/// Finds the conditions of all contacts by multipliers, their impulses, and the work of these.
void find_impulses(const Acting& acting, const Motion& m, std::span<Workspace> workspaces, Multipliers& all) {
  all.conditions.clear();
  all.members.clear();
  all.contactors.clear();
  all.unreleased.clear();
  all.frictions.clear();
  all.first.assign(acting.interfaces.size() + acting.planes.size() + 1, 0);
  wake(acting, m, workspaces, all);
  all.spent.end(Stage::search);
  look_ahead(all.looked_at, m, all);
  if (m.rigid) look_ahead(*m.rigid, m, all);
  find_bonds(acting.interfaces, m, acting.memories, all.velocity, all.bonds);
  see_ahead(all.bonds.nodes, m, all);
  all.way_apart = any_automatic(acting) ? m.next * speed_apart(all.velocity, {all.looked_at}) : 0;
  all.spent.end(Stage::predict);
  for (std::size_t i = 0; i < acting.interfaces.size(); ++i) {
    const Interface& interface = acting.interfaces[i];
    if (by_multipliers(interface) && !bonded_by_multipliers(interface))
      find_conditions(interface, m, acting.memories[i], workspaces[i], all);
    all.first[i + 1] = static_cast<Index>(all.contactors.size());
  }
  for (std::size_t p = 0; p < acting.planes.size(); ++p) {
    if (by_multipliers(acting.planes[p])) find_conditions(acting.planes[p], m, acting.of_planes[p], all);
    all.first[acting.interfaces.size() + p + 1] = static_cast<Index>(all.contactors.size());
  }
  if (!all.unreleased.empty()) {
    spread_unreleased(all);
    acting.for_each([&](std::size_t at, const auto&, auto& memory) {
      take_unreleased(all.first[at], all.first[at + 1], memory.transferred, all);
    });
  }
  all.bonds.touched = any_touched(all);
  all.spent.end(Stage::conditions);
  const int sweeps = solve(m, all);
  if (!all.contactors.empty()) {
    ++all.spent.steps;
    all.spent.apexes += static_cast<std::int64_t>(all.contactors.size());
    all.spent.conditions += static_cast<std::int64_t>(all.conditions.size());
    all.spent.sweeps += sweeps;
  }
  find_work(m, all);
  all.spent.end(Stage::solve);
}

/// Gives the nodes the impulse of a condition, and books where they are what moment this has.
void apply(const Condition& c, const Multipliers& all, const Vectors& x, Vectors& impulse, Vec3& moment) {
  for (int j = 0; j < c.nodes; ++j) {
    const Member& one = members_of(c, all)[static_cast<std::size_t>(j)];
    const Vec3 part = c.impulse * one.push;
    impulse.col(one.node) += part;
    moment += x.col(one.node).cross(part);
  }
}

}  // namespace

bool any_by_multipliers(std::span<const Interface> interfaces, std::span<const RigidPlane> planes) {
  return std::any_of(interfaces.begin(), interfaces.end(), [](const Interface& i) { return by_multipliers(i); }) ||
         std::any_of(planes.begin(), planes.end(), [](const RigidPlane& p) { return by_multipliers(p); });
}

void stop_at_start(std::span<const Interface> interfaces, std::span<const RigidPlane> planes, const Motion& m, double t,
                   std::span<Memory> memories, std::span<PlaneMemory> of_planes, std::span<Workspace> workspaces, Multipliers& all,
                   Vectors& impulse) {
  const Acting acting{interfaces, planes, memories, of_planes};
  all.spent.begin();
  find_impulses(acting, m, workspaces, all);
  acting.for_each([&](std::size_t at, const auto& contact, auto& memory) {
    const Index first = all.first[at], last = all.first[at + 1];
    for (Index k = first; k < last; ++k) {
      const Contactor& one = all.contactors[k];
      memory.work += one.work;
      for (Index i = one.first; i < one.last; ++i) {
        apply(all.conditions[i], all, m.x, impulse, memory.angular_impulse);
        memory.impulse += all.conditions[i].impulse * all.conditions[i].normal;
        if constexpr (std::is_same_v<std::decay_t<decltype(contact)>, Interface>) meet_at_start(contact, all.conditions[i], all, t, memory);
      }
    }
    Pool alone{first, last, &memory.transferred, 0};
    memory.impact += update_restitution(m, t, alone, all);
  });
  acting.for_each_bond(all.bonds, [&](const Interface&, std::span<const HeldBond> bonds, Memory& memory) {
    book_start(m, bonds, all.velocity, memory, impulse);
  });
}

void enforce(std::span<const Interface> interfaces, std::span<const RigidPlane> planes, const Motion& m, double t,
             std::span<Memory> memories, std::span<PlaneMemory> of_planes, std::span<Workspace> workspaces, Multipliers& all) {
  all.spent.begin();
  const double h = 0.5 * (m.dt + m.next);
  const Acting acting{interfaces, planes, memories, of_planes};
  for (std::size_t i = 0; i < interfaces.size(); ++i)
    if (by_multipliers(interfaces[i])) book_first_half(interfaces[i], m, memories[i]);
  all.spent.end(Stage::book);
  find_impulses(acting, m, workspaces, all);
  if (m.dt > 0) release(m, t, all);
  all.spent.end(Stage::release);
  std::vector<Pool>& pools = all.pools;
  pools.clear();
  acting.for_each([&](std::size_t at, const auto&, auto& memory) {
    const Index first = all.first[at], last = all.first[at + 1];
    const FrictionLoss friction = friction_loss(m, first, last, all);
    memory.friction_to_come = friction.to_come;
    pools.push_back({first, last, &memory.transferred, friction.all - memory.friction_owed});
    memory.impact += update_restitution(m, t, pools.back(), all);
  });
  share_out_blows(pools, all);
  std::size_t of_contact = 0;
  acting.for_each([&](std::size_t, const auto& contact, auto&) {
    Pool* pool = &pools[of_contact++];
    balance({pool, 1}, all);
    if (!is_back_pass(contact)) return;
    balance({pool - 1, 2}, all);
    balance_friction({pool - 1, 2});
  });
  balance(pools, all);
  balance_friction(pools);
  std::size_t pool = 0;
  acting.for_each([&](std::size_t, const auto&, auto& memory) {
    pay_for_friction(pools[pool], all);
    const double rubbed = pools[pool++].rubbed;
    memory.friction_dissipated += std::max(0.0, rubbed);
    memory.friction_owed = std::max(0.0, -rubbed);
  });
  acting.for_each([&](std::size_t at, const auto& contact, auto& memory) {
    const Index first = all.first[at], last = all.first[at + 1];
    const Doing now = doing(m, first, last, all);
    take_over(contact, m, h, t, first, last, now, memory, all);
    memory.work += m.dt * m.dt / 8 * (now.power_rate - memory.power_rate);
    memory.power_rate = now.power_rate;
  });
  acting.for_each_bond(all.bonds, [&](const Interface& interface, std::span<const HeldBond> bonds, Memory& memory) {
    take_over(interface, m, bonds, all.velocity, memory);
  });
  all.spent.end(Stage::book);
}

void change_work_to_come(std::span<const Interface> interfaces, std::span<const RigidPlane> planes, const Vectors& change,
                         const Vectors& spin, const std::vector<Index>& rotation_of_node, double next, std::span<Memory> memories,
                         std::span<PlaneMemory> of_planes) {
  const Acting acting{interfaces, planes, memories, of_planes};
  const double half = 0.5 * next;
  acting.for_each([&](std::size_t, const auto& contact, auto& memory) {
    double of_friction = 0;
    const auto see = [&](const FrictionForces& friction) {
      if (friction.acts) of_friction += half * friction.force.dot(slip_rate(friction.touch, change, spin, rotation_of_node));
    };
    if constexpr (std::is_same_v<std::decay_t<decltype(contact)>, Interface>) {
      for (const Near& near : memory.near) {
        const double by_change = power(contact, memory.shares, change, near.apex, near.element);
        if (near.element.closed) memory.restitution[near.apex].held -= half * by_change;
        see(near.friction);
      }
      for (Crossing& crossing : memory.crossings) {
        for (std::size_t j = 0; crossing.closed && j < 4; ++j)
          crossing.restitution.held -= half * crossing.weight[j] * crossing.push.dot(change.col(crossing.node[j]));
        see(crossing.friction);
      }
    } else {
      for (std::size_t i = 0; i < contact.nodes.size(); ++i) {
        memory.restitution[i].held -= half * memory.force[i] * contact.normal.dot(change.col(contact.nodes[i]));
        if (!memory.friction.empty()) of_friction += half * memory.friction[i].dot(change.col(contact.nodes[i]));
      }
    }
    memory.friction_to_come -= of_friction;
    memory.friction_dissipated -= of_friction;
  });
}

}  // namespace nereid::contact
