#include "contact/multiplier/enforce.hpp"

#include <algorithm>
#include <type_traits>

#include "contact/data/meeting.hpp"
#include "contact/multiplier/assemble.hpp"
#include "contact/multiplier/blow.hpp"
#include "contact/multiplier/book.hpp"
#include "contact/multiplier/predict.hpp"
#include "contact/multiplier/restitution.hpp"
#include "contact/multiplier/rigid_nodes.hpp"
#include "contact/multiplier/solve.hpp"
#include "contact/search/near.hpp"
#include "contact/tracking/element.hpp"

namespace nereid::contact {

namespace {

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

/// Books the impulse of a condition that stopped at the start what two bodies of an automatic contact did.
void meet_at_start(const Interface& interface, const Condition& c, const Multipliers& all, double t, Memory& memory) {
  if (!(c.impulse > 0)) return;
  const auto members = members_of(c, all);
  const auto node_of = [&](auto wanted) {
    return std::find_if(members.begin(), members.end() - 1, [&](const Member& one) { return wanted(one.weight); })->node;
  };
  meet_at_start(interface, node_of([](double weight) { return weight > 0; }), node_of([](double weight) { return weight < 0; }),
                c.impulse * c.normal, t, memory);
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
