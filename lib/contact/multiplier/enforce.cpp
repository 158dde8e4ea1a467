#include "contact/multiplier/enforce.hpp"

#include <algorithm>
#include <type_traits>

#include "contact/data/pair_records.hpp"
#include "contact/multiplier/assemble.hpp"
#include "contact/multiplier/blow.hpp"
#include "contact/multiplier/book.hpp"
#include "contact/multiplier/crossing.hpp"
#include "contact/multiplier/predict.hpp"
#include "contact/multiplier/restitution.hpp"
#include "contact/multiplier/rigid_nodes.hpp"
#include "contact/multiplier/shape_points.hpp"
#include "contact/multiplier/solve.hpp"
#include "contact/search/body_ways.hpp"
#include "contact/search/edge_pairs.hpp"
#include "contact/search/near.hpp"
#include "contact/tracking/element.hpp"

namespace nereid::contact {

namespace {

/// What acts by multipliers, and where its contactors begin in Multipliers::first.
struct Acting {
  std::span<const AnyContact> contacts;
  std::span<const RigidPlane> planes;
  std::span<AnyMemory> memories;
  std::span<PlaneMemory> of_planes;

  /// Calls visit(place, contact, memory) for each that may part, contacts between bodies first.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (by_multipliers(contacts[i]) && !tied_by_multipliers(contacts[i]))
        with_memory(contacts[i], memories[i], [&](const auto& contact, auto& memory) { visit(i, contact, memory); });
    for (std::size_t p = 0; p < planes.size(); ++p)
      if (by_multipliers(planes[p])) visit(contacts.size() + p, planes[p], of_planes[p]);
  }

  /// The same of ties: visit(interface, ties, memory).
  template <class Visit>
  void for_each_tie(const Ties& all, Visit&& visit) const {
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (tied_by_multipliers(contacts[i])) visit(std::get<Interface>(contacts[i]), ties_of(all, i), std::get<Memory>(memories[i]));
  }
};

bool is_back_pass(const Interface& interface) { return interface.pass == Pass::back; }
bool is_back_pass(const EdgeContact&) { return false; }
bool is_back_pass(const RigidPlane&) { return false; }

/// Whether a contact acts on a node of a tie.
bool any_touched(const Multipliers& all) {
  if (all.ties.held.empty()) return false;
  for (const Contactor& one : all.contactors)
    for (Index i = one.first; i < one.last; ++i)
      for (const Member& at : members_of(all.conditions[i], all))
        if (all.ties.has[at.node]) return true;
  return false;
}

bool is_automatic(const AnyContact& contact) { return sides(contact).bodies.count() > 0 && by_multipliers(contact); }
bool any_automatic(const Acting& acting) { return std::any_of(acting.contacts.begin(), acting.contacts.end(), is_automatic); }

/// Calls look_at(node) for the nodes of bodies that are active.
template <class LookAt>
void visit_active(const Interface& interface, const Memory& memory, LookAt&& look_at) {
  for (std::size_t a = 0; a < interface.bodies.of_apex.size(); ++a)
    if (memory.active[static_cast<std::size_t>(interface.bodies.of_apex[a])] != 0) look_at(interface.apexes[a]);
}
template <class LookAt>
void visit_active(const EdgeContact& contact, const EdgeMemory& memory, LookAt&& look_at) {
  const Edges& edges = contact.edges;
  for (std::size_t e = 0; e < edges.body.size(); ++e) {
    const auto edge = static_cast<Eigen::Index>(e);
    for (int end = 0; end < 2 && memory.active[static_cast<std::size_t>(edges.body[e])] != 0; ++end)
      look_at(edges.nodes(end, edge)), look_at(edges.across(end, edge)), look_at(edges.opposite(end, edge));
  }
}

/// Searches for automatic contacts, and lists the nodes that are to be looked at.
void wake(const Acting& acting, const Motion& m, std::span<AnyWorkspace> workspaces, Multipliers& all) {
  if (!any_automatic(acting)) {
    if (!all.has_looked) all.looked_at = all.nodes, all.has_looked = true;
    return;
  }
  const double apart = speed_apart(m.v), passed = m.again ? 0 : m.dt;
  bool searched = !all.has_looked;
  for (std::size_t i = 0; i < acting.contacts.size(); ++i)
    if (is_automatic(acting.contacts[i]))
      with_all(acting.contacts[i], acting.memories[i], workspaces[i], [&](const auto& contact, auto& memory, auto& workspace) {
        if (!workspace.knows_near_bodies && memory.searches > 0) find_near_bodies(contact, memory, workspace);  // as after a restart
        add_ways(contact, m.v, passed, memory, workspace);
        searched = search_bodies_where_due(contact, m.x, m.v, passed * apart, m.next * apart, memory, workspace) || searched;
      });
  if (!searched) return;
  std::vector<char> looked_at(static_cast<std::size_t>(m.x.cols()), 0);
  const auto look_at = [&](Index node) {
    if (node >= 0) looked_at[static_cast<std::size_t>(node)] = 1;
  };
  for (const Index node : all.always) look_at(node);
  for (std::size_t i = 0; i < acting.contacts.size(); ++i)
    if (is_automatic(acting.contacts[i]))
      with_memory(acting.contacts[i], acting.memories[i],
                  [&](const auto& contact, const auto& memory) { visit_active(contact, memory, look_at); });
  all.has_looked = true;
  all.looked_at.clear();
  for (std::size_t node = 0; node < looked_at.size(); ++node)
    if (looked_at[node] != 0) all.looked_at.push_back(static_cast<Index>(node));
}

/// Finds the conditions of all contacts by multipliers, their impulses, and the work of these.
void find_impulses(const Acting& acting, const Motion& m, std::span<AnyWorkspace> workspaces, Multipliers& all) {
  all.conditions.clear();
  all.members.clear();
  all.contactors.clear();
  all.unreleased.clear();
  all.frictions.clear();
  all.first.assign(acting.contacts.size() + acting.planes.size() + 1, 0);
  wake(acting, m, workspaces, all);
  all.spent.end(Stage::search);
  look_ahead(all.looked_at, m, all);
  if (m.rigid) look_ahead(*m.rigid, m, all);
  find_ties(acting.contacts, m, acting.memories, all.velocity, all.ties);
  predict_positions(all.ties.nodes, m, all);
  all.spent.end(Stage::predict);
  for (std::size_t i = 0; i < acting.contacts.size(); ++i) {
    if (by_multipliers(acting.contacts[i]) && !tied_by_multipliers(acting.contacts[i]))
      with_all(acting.contacts[i], acting.memories[i], workspaces[i],
               [&](const auto& contact, auto& memory, auto& workspace) { find_conditions(contact, m, memory, workspace, all); });
    all.first[i + 1] = static_cast<Index>(all.contactors.size());
  }
  for (std::size_t p = 0; p < acting.planes.size(); ++p) {
    if (by_multipliers(acting.planes[p])) find_conditions(acting.planes[p], m, acting.of_planes[p], all);
    all.first[acting.contacts.size() + p + 1] = static_cast<Index>(all.contactors.size());
  }
  if (!all.unreleased.empty()) {
    spread_unreleased(all);
    acting.for_each([&](std::size_t at, const auto&, auto& memory) {
      take_unreleased(all.first[at], all.first[at + 1], memory.transferred, all);
    });
  }
  all.ties.touched = any_touched(all);
  all.spent.end(Stage::conditions);
  const int iterations = solve(m, all);
  if (!all.contactors.empty()) {
    ++all.spent.steps;
    all.spent.apexes += static_cast<std::int64_t>(all.contactors.size());
    all.spent.conditions += static_cast<std::int64_t>(all.conditions.size());
    all.spent.iterations += iterations;
  }
  find_work(m, all);
  all.spent.end(Stage::solve);
}

/// Books the impulse of a condition that stopped at the start what two bodies of an automatic contact did.
void record_at_start(const Sides& sides, const Condition& c, const Multipliers& all, double t, SidesMemory& memory) {
  if (!(c.impulse > 0)) return;
  const auto members = members_of(c, all);
  const auto node_of = [&](auto wanted) {
    return std::find_if(members.begin(), members.end() - 1, [&](const Member& one) { return wanted(one.weight); })->node;
  };
  record_at_start(sides, node_of([](double weight) { return weight > 0; }), node_of([](double weight) { return weight < 0; }),
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

/// Work of a friction force over `half` a step with a change of velocities. [J]
double work_of(const FrictionForces& friction, const Vectors& change, const Vectors& spin, const std::vector<Index>& rotation_of_node,
               double half) {
  return friction.acts ? half * friction.force.dot(slip_rate(friction.touch, change, spin, rotation_of_node)) : 0;
}

/// The same of points of shapes: what is held, and the work of friction that is returned. [J]
double change_held_of_shapes(std::vector<ShapePoint>& points, const Vectors& change, const Vectors& spin,
                             const std::vector<Index>& rotation_of_node, double half) {
  double of_friction = 0;
  for (ShapePoint& point : points) {
    if (point.closed) point.restitution.held -= half * point.pressed * point.normal.dot(relative(point, change));
    if (point.rubs) of_friction += half * point.friction.dot(slip_rate(touch_of(point), change, spin, rotation_of_node));
  }
  return of_friction;
}

/// Takes from what is held the work of normal forces over `half` a step with a change of velocities; returns that of friction. [J]
double change_held(const Interface& interface, const Vectors& change, const Vectors& spin, const std::vector<Index>& rotation_of_node,
                   double half, Memory& memory) {
  double of_friction = 0;
  for (const Near& near : memory.near) {
    if (near.element.closed)
      memory.restitution[near.apex].held -= half * power(interface, memory.shares, change, near.apex, near.element);
    of_friction += work_of(*near.friction, change, spin, rotation_of_node, half);
  }
  return of_friction + change_held_of_shapes(memory.shape_points, change, spin, rotation_of_node, half);
}
double change_held(const EdgeContact&, const Vectors& change, const Vectors& spin, const std::vector<Index>& rotation_of_node, double half,
                   EdgeMemory& memory) {
  double of_friction = 0;
  for (Crossing& crossing : memory.crossings) {
    for (std::size_t j = 0; crossing.closed && j < 4; ++j)
      crossing.restitution.held -= half * crossing.weight[j] * crossing.push.dot(change.col(crossing.node[j]));
    of_friction += work_of(*crossing.friction, change, spin, rotation_of_node, half);
  }
  return of_friction;
}
double change_held(const RigidPlane& plane, const Vectors& change, const Vectors& spin, const std::vector<Index>& rotation_of_node,
                   double half, PlaneMemory& memory) {
  double of_friction = 0;
  for (std::size_t i = 0; i < plane.nodes.size(); ++i) {
    memory.restitution[i].held -= half * memory.force[i] * plane.normal.dot(change.col(plane.nodes[i]));
    if (!memory.friction.empty()) of_friction += half * memory.friction[i].dot(change.col(plane.nodes[i]));
  }
  return of_friction + change_held_of_shapes(memory.shape_points, change, spin, rotation_of_node, half);
}

}  // namespace

bool any_by_multipliers(std::span<const AnyContact> contacts, std::span<const RigidPlane> planes) {
  return std::any_of(contacts.begin(), contacts.end(), [](const AnyContact& one) { return by_multipliers(one); }) ||
         std::any_of(planes.begin(), planes.end(), [](const RigidPlane& p) { return by_multipliers(p); });
}

void stop_at_start(std::span<const AnyContact> contacts, std::span<const RigidPlane> planes, const Motion& m, double t,
                   std::span<AnyMemory> memories, std::span<PlaneMemory> of_planes, std::span<AnyWorkspace> workspaces, Multipliers& all,
                   Vectors& impulse) {
  const Acting acting{contacts, planes, memories, of_planes};
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
        if constexpr (!std::is_same_v<std::decay_t<decltype(contact)>, RigidPlane>)
          record_at_start(contact, all.conditions[i], all, t, memory);
      }
    }
    Pool alone{first, last, &memory.transferred, 0};
    memory.impact += update_restitution(m, t, alone, all);
  });
  acting.for_each_tie(all.ties, [&](const Interface&, std::span<const HeldTie> ties, Memory& memory) {
    book_start(m, ties, all.velocity, memory, impulse);
  });
}

BlowLimit enforce(std::span<const AnyContact> contacts, std::span<const RigidPlane> planes, const Motion& m, double t,
                  std::span<AnyMemory> memories, std::span<PlaneMemory> of_planes, std::span<AnyWorkspace> workspaces, double energy,
                  bool goes_on, Multipliers& all) {
  all.spent.begin();
  const double h = 0.5 * (m.dt + m.next);
  const Acting acting{contacts, planes, memories, of_planes};
  if (!m.again) {
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (by_multipliers(contacts[i]))
        with_memory(contacts[i], memories[i], [&](const auto& contact, auto& memory) { book_first_half(contact, m, memory); });
    for (PlaneMemory& memory : of_planes) book_first_half_of_shapes(m, memory);
  }
  all.spent.end(Stage::book);
  find_impulses(acting, m, workspaces, all);
  const BlowLimit limit = limit_of_blows(energy, goes_on, all);
  if (limit.step < m.next && !m.again) return limit;
  if (m.dt > 0) release(m, t, all);
  all.spent.end(Stage::release);
  std::vector<Pool>& pools = all.pools;
  pools.clear();
  acting.for_each([&](std::size_t at, const auto&, auto& memory) {
    const Index first = all.first[at], last = all.first[at + 1];
    const FrictionLoss friction = friction_loss(m, first, last, all);
    memory.friction_to_come = friction.to_come;
    pools.push_back({first, last, &memory.transferred, friction.all - memory.friction_deficit});
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
    memory.friction_deficit = std::max(0.0, -rubbed);
  });
  acting.for_each([&](std::size_t at, const auto& contact, auto& memory) {
    const Index first = all.first[at], last = all.first[at + 1];
    const Doing now = doing(m, first, last, all);
    take_over(contact, m, h, t, first, last, now, memory, all);
    memory.work += m.dt * m.dt / 8 * (now.power_rate - memory.power_rate);
    memory.power_rate = now.power_rate;
  });
  acting.for_each_tie(all.ties, [&](const Interface& interface, std::span<const HeldTie> ties, Memory& memory) {
    take_over(interface, m, ties, all.velocity, memory);
  });
  all.spent.end(Stage::book);
  return limit;
}

void change_work_to_come(std::span<const AnyContact> contacts, std::span<const RigidPlane> planes, const Vectors& change,
                         const Vectors& spin, const std::vector<Index>& rotation_of_node, double next, std::span<AnyMemory> memories,
                         std::span<PlaneMemory> of_planes) {
  const Acting acting{contacts, planes, memories, of_planes};
  acting.for_each([&](std::size_t, const auto& contact, auto& memory) {
    const double of_friction = change_held(contact, change, spin, rotation_of_node, 0.5 * next, memory);
    memory.friction_to_come -= of_friction;
    memory.friction_dissipated -= of_friction;
  });
}

}  // namespace nereid::contact
