#include "contact/multiplier/condition.hpp"

#include <algorithm>
#include <cmath>

#include "contact/multiplier/rigid_nodes.hpp"
#include "contact/multiplier/solve.hpp"

namespace nereid::contact {

namespace {

/// The rate a after a step in which a condition alone does the work E:  (a - free)/A (before + a)/2 = E.
double rate_for(double E, const Condition& c) {
  const double difference = c.before - c.free;
  return 0.5 * (std::sqrt(std::max(0.0, difference * difference + 4 * (c.before * c.free + 2 * c.per_mass * E))) - difference);
}

}  // namespace

Vec3 let_through(const Motion& m, const Member& one) {
  const Mat3* allowed = m.allowed[one.node];
  return allowed ? Vec3(*allowed * one.push) : one.push;
}

bool complete(const Motion& m, double pressed, double held, const Multipliers& all, const ConditionList& list, Condition& c) {
  double sum = 0;
  for (const Member& one : members_of(c, list)) sum += all.mobility(one.node) * let_through(m, one).squaredNorm();
  c.per_mass = m.rigid ? per_mass(*m.rigid, m, list, c) : sum;
  c.before = relative(c, list, m.v), c.free = relative(c, list, all.velocity);
  const double closing = (c.gap > 0 ? -c.gap : -corrected * c.gap) / m.next, impulse = 0.5 * pressed * (m.dt + m.next);
  const double from_held = impulse > 0 ? std::max(0.0, held) / impulse : 0;
  const double may = 2 * from_held - c.before;  // the work of this step; to stop again takes as much as to go apart
  c.least = std::min(closing, may > 0 ? 0.5 * may : may);
  // the last force makes a small impulse where the step has fallen, and what this rate takes alone is not
  if (from_held > 0 && (c.least - c.free) * (c.least + c.before) > 2 * c.per_mass * held) c.least = std::min(c.least, rate_for(held, c));
  return c.per_mass * m.mass(members_of(c, list)[0].node) > no_response;
}

Condition& begin_condition(ConditionList& list) {
  Condition& c = list.conditions.emplace_back();
  c.first = static_cast<Index>(list.members.size());
  return c;
}

void take_back(ConditionList& list) {
  list.members.resize(static_cast<std::size_t>(list.conditions.back().first));
  list.conditions.pop_back();
}

void add(const Contactor& one, Multipliers& all) {
  all.contactors.push_back(one);
  for (Index i = one.first; i < one.last; ++i) {
    const Condition& c = all.conditions[i];
    for (const Member& at : members_of(c, all)) all.shared(at.node) += one.area * std::abs(at.weight);
  }
  if (one.friction < 0) return;
  const Touch& touch = all.frictions[one.friction].touch;
  if (touch.apex >= 0) all.rubbed(touch.apex) += one.area;
  for (int j = 0; j < touch.nodes; ++j) {
    all.rubbed(touch.node[j]) += one.area * std::abs(touch.weight[j]);
    if (touch.apex < 0) all.shared(touch.node[j]) += one.area * touch.lift[j].norm();
  }
}

Multipliers make_multipliers(std::span<const AnyContact> contacts, std::span<const RigidPlane> planes, Index nodes, Index plate_nodes) {
  constexpr std::size_t most_of_an_apex = 3;  // conditions; some may have more, but not many
  Multipliers all;
  all.ahead = all.way = all.velocity = Vectors::Zero(3, nodes);
  all.spin = Vectors::Zero(3, plate_nodes);
  all.shared = all.rubbed = all.mobility = Scalars::Zero(nodes);
  std::size_t apexes = 0, most_near = 0;
  std::vector<char> acts(static_cast<std::size_t>(nodes), 0), always = acts;
  const auto see = [&](const Subset& some, bool is_automatic = false) {
    for (const Index node : some) acts[static_cast<std::size_t>(node)] = 1;
    for (const Index node : some)
      if (!is_automatic) always[static_cast<std::size_t>(node)] = 1;
  };
  for (const AnyContact& one : contacts) {
    if (!by_multipliers(one)) continue;
    const Sides& both = sides(one);
    const bool is_automatic = both.bodies.count() > 0;
    see(both.apexes, is_automatic), see(both.base_nodes, is_automatic);
    if (tied_by_multipliers(one)) continue;
    apexes += both.apexes.size();
    most_near = std::max(most_near, both.apexes.size());
  }
  for (const RigidPlane& plane : planes) {
    if (!by_multipliers(plane)) continue;
    see(plane.nodes);
    for (const mesh::RoundBody& round : plane.rounds) see({round.anchor.begin(), round.anchor.end()});
    apexes += plane.nodes.size();
  }
  for (Index node = 0; node < nodes; ++node)
    if (acts[static_cast<std::size_t>(node)] != 0) all.nodes.push_back(node);
  for (const Index node : all.nodes)
    if (always[static_cast<std::size_t>(node)] != 0) all.always.push_back(node);
  all.conditions.reserve(most_of_an_apex * apexes);
  all.members.reserve(5 * most_of_an_apex * apexes);
  for (auto* list : {&all.rows.velocity, &all.rows.given, &all.rows.push}) list->reserve(5 * most_of_an_apex * apexes);
  for (auto* list : {&all.rows.slot, &all.rows.mover_of_slot, &all.rows.copies}) list->reserve(5 * most_of_an_apex * apexes);
  all.rows.mobility.reserve(5 * most_of_an_apex * apexes);
  all.rows.movers.reserve(all.nodes.size()), all.rows.others.reserve(all.nodes.size());
  all.frictions.reserve(apexes);
  all.contactors.reserve(apexes);
  all.unreleased.reserve(apexes);
  all.at_node.resize(static_cast<std::size_t>(nodes));
  all.first.reserve(contacts.size() + planes.size() + 1);
  all.progress.reserve(apexes / contactors_of_a_range + 1);
  all.pools.reserve(contacts.size() + planes.size());
  all.found.resize((most_near + apexes_of_conditions - 1) / apexes_of_conditions);
  for (FoundInRange& one : all.found) {
    one.list.conditions.reserve(2 * apexes_of_conditions), one.list.members.reserve(10 * apexes_of_conditions);
    one.contactors.reserve(apexes_of_conditions), one.ended.reserve(apexes_of_conditions);
  }
  all.ties = make_ties(contacts, nodes);
  return all;
}

void find_work(const Motion& m, Multipliers& all) {
  find_velocities(m, all);
  for (Contactor& one : all.contactors) {
    one.work = 0;
    for (Index i = one.first; i < one.last; ++i) {
      Condition& c = all.conditions[i];
      c.after = rate(c, all);
      one.work += work(c, c.after);
    }
  }
  for (FrictionCondition& condition : all.frictions) {
    condition.after = rate(condition, all);
    condition.work = work(condition, condition.after);
  }
}

}  // namespace nereid::contact
