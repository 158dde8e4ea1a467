#include "contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.hpp"
#include "contact/apex.hpp"
#include "contact/bond.hpp"
#include "contact/near.hpp"

namespace nereid::contact {

namespace {

constexpr double depth_to_check = 0.25;  // of the depth of an element: half of what is warned of

}  // namespace

void see_depth(const Interface& interface, const Vectors& x, const Near& near, Memory& memory) {
  double depth = near.element.depth;
  const Index on = memory.feature[near.apex].facet;
  const double of_element = on < 0 ? interface.depth : between(interface, near.apex, on).depth;
  if (depth > depth_to_check * of_element) depth = std::min(depth, overlap_of(interface, x, near, memory));
  if (depth > memory.deepest) memory.deepest = depth, memory.deepest_apex = interface.apexes[near.apex], memory.deepest_in = of_element;
}

Workspace::Workspace(const Interface& interface)
    : near_itself(static_cast<std::size_t>(interface.bodies.count()), 0),
      apex_near_itself(interface.apexes.size(), 0),
      facets(interface.apexes.size(), 0),
      spring_sum(Scalars::Zero(std::max<Eigen::Index>(1, static_cast<Eigen::Index>(interface.base.ring_begin.size())) - 1)),
      rotation_sum(Scalars::Zero(interface.friction.coefficient > 0 && !interface.rotation_of_node.empty() ? spring_sum.size() : 0)) {
  near.reserve(interface.apexes.size());
  found.resize((interface.apexes.size() + apexes_of_a_range - 1) / apexes_of_a_range);
  for (Subset& one : found) one.reserve(static_cast<std::size_t>(facets_at_first * apexes_of_a_range));
  if (interface.heights != Heights::nodes) {
    const auto faces = static_cast<std::size_t>(interface.faces.faces.cols());
    points.of_face.resize(faces), points.used.reserve(faces), points.used_before.reserve(faces);
  }
  const Bodies& bodies = interface.bodies;
  if (bodies.count() == 0) broad.emplace_back(static_cast<Index>(interface.base.facets.cols()));
  for (Index b = 0; interface.kind != InterfaceKind::edges && b < bodies.count(); ++b)
    broad.emplace_back(bodies.first_facet[b + 1] - bodies.first_facet[b], bodies.first_facet[b]);
}

void follow_thickness(const Interface& interface, const Scalars& half_growth, Memory& memory) {
  constexpr double worth_following = 1e-5;  // of h_c
  if (!interface.follows_thickness) return;
  memory.thicker.resize(interface.apexes.size(), 0);
  for (std::size_t i = 0; i < interface.apexes.size(); ++i) {
    const auto a = static_cast<Index>(i);
    Near* near = memory.slot[a] < 0 ? nullptr : &memory.near[memory.slot[a]];
    const Index facet = near && near->tracks.count > 0 ? near->tracks.track[0].facet : memory.feature[a].facet;
    double wanted = half_growth(interface.apexes[a]);
    if (facet >= 0)
      for (int I = 0; I < 3; ++I) wanted += half_growth(interface.base.facets(I, facet)) / 3;
    double change = wanted - memory.thicker[a];
    if (near && near->tracks.count == 0 && change > 0) change = std::min(change, std::max(0.0, 0.5 * memory.gap[a]));
    if (!(std::abs(change) > worth_following * interface.contact_height(a))) continue;
    memory.thicker[a] += change;
    if (!near) continue;
    near->no_condition_until -= std::max(0.0, change);
    near->clear -= std::max(0.0, change);
    if (near->rests) continue;
    near->clear = -std::numeric_limits<double>::infinity();
    const double height = contact_height(interface, memory, a);
    for (int t = 0; t < near->tracks.count; ++t) {
      double& level = near->tracks.track[t].height;
      const double most = height + stand_off(interface.base, near->tracks.track[t].facet);
      if (!(level > most)) continue;
      if (near->element.closed && !by_multipliers(interface)) memory.thinned += near->element.apex.norm() * (level - most);
      level = most;
    }
  }
}

void sum_force(double dt, Memory& memory) {
  const Vec3 before = memory.force;
  memory.force.setZero();
  for (const Near& near : memory.near) {
    if (near.element.closed) memory.force += near.element.scale * near.element.apex;
    if (near.friction.acts) memory.force += near.friction.force;
  }
  memory.impulse += 0.5 * dt * (before + memory.force);
}

double stored(const Memory& memory) {
  double sum = 0;
  for (const double energy : memory.stored) sum += energy;
  return sum;
}

double tangential_stored(const Memory& memory) {
  double sum = 0;
  for (const double energy : memory.tangential_stored) sum += energy;
  return sum;
}

void advance(const Interface& interface, const Vectors& x, const Vectors& v, const Vectors& omega, double dt, Memory& memory,
             Workspace& workspace) {
  const bool searches = interface.kind == InterfaceKind::contact;
  const Moved moved = from_search(searches ? search_where_due(interface, x, v, memory, workspace) : 0);
  parallel_for(static_cast<Index>(memory.near.size()), 64, [&](Index i) {
    Near& near = memory.near[i];
    if (near.rests && moved.now < near.clear) return;
    advance_element(interface, x, v, dt, moved, near, memory);
    if (!memory.slip.empty()) advance_friction(interface, x, v, omega, dt, near, memory);
  });
  memory.deepest_now = 0;
  for (const Near& near : memory.near) {
    if (near.rests) continue;
    const ElementForces& element = near.element;
    memory.deepest_now = std::max(memory.deepest_now, element.depth);
    if (element.depth > memory.deepest) see_depth(interface, x, near, memory);
    memory.work += element.work;
    memory.damped += element.dissipated;
    memory.angular_impulse += element.angular_impulse;
    memory.lost += element.lost;
    double created = element.created;
    if (!memory.slip.empty()) {
      memory.work += near.friction.work;
      memory.friction_dissipated += near.friction.dissipated;
      created += near.friction.created;
    }
    if (!element.moved) continue;
    memory.created_by_reconnection += created;
    ++memory.walks;
    ++memory.reconnections[near.apex];
  }
  sum_force(dt, memory);
}

namespace {

/// Calls push(node, force) for what presses nodes, and rub(touch, force) for friction.
template <class Push, class Rub>
void visit_forces(const Interface& interface, const Memory& memory, Push&& push, Rub&& rub) {
  for (const Near& near : memory.near) {
    const ElementForces& element = near.element;
    if (!element.closed) continue;
    const auto stencils = std::span(element.stencil).first(static_cast<std::size_t>(element.count));
    if (std::any_of(stencils.begin(), stencils.end(), [](const Stencil& one) { return one.shares > 0; })) {
      for (const Stencil& one : stencils)
        for_each_force(interface, memory.shares, near.apex, one, push);
      continue;
    }
    push(interface.apexes[near.apex], Vec3(element.scale * element.apex));
    for (int i = 0; i < element.count; ++i) {
      const Vec3 of_stencil = element.scale * element.stencil[i].push;
      for_each_node(interface, element.stencil[i], [&](Index node, double weight, double) { push(node, Vec3(-weight * of_stencil)); });
    }
  }
  for (const Crossing& crossing : memory.crossings) {
    if (!crossing.closed) continue;
    for (std::size_t j = 0; j < 4; ++j) push(crossing.node[j], Vec3(crossing.weight[j] * crossing.push));
    if (crossing.friction.acts) rub(crossing.friction.touch, crossing.friction.force);
  }
  if (!(interface.friction.coefficient > 0)) return;
  for (const Near& near : memory.near)
    if (near.friction.acts) rub(near.friction.touch, near.friction.force);
}

}  // namespace

void add_forces(const Interface& interface, const Memory& memory, Vectors& force, Vectors& moment) {
  visit_forces(
      interface, memory, [&](Index node, const Vec3& push) { force.col(node) += push; },
      [&](const Touch& touch, const Vec3& friction) { add_friction(touch, friction, interface.rotation_of_node, force, moment); });
}

void list_forces(const Interface& interface, const Memory& memory, std::vector<NodeForce>& forces) {
  visit_forces(
      interface, memory, [&](Index node, const Vec3& push) { forces.push_back({node, push, Vec3::Zero()}); },
      [&](const Touch& touch, const Vec3& friction) {
        const FrictionShares shares = share_friction(touch, friction);
        for (int i = 0; i < shares.count; ++i) forces.push_back({shares.node[i], Vec3::Zero(), shares.force[i]});
      });
}

Source source(const Interface& interface) {
  const bool has_friction = interface.friction.coefficient > 0;
  if (bonded_by_multipliers(interface)) return {interface.name, SourceKind::interface, {}, {Dissipated::inelastic_impact}};
  if (by_multipliers(interface))
    return {interface.name, SourceKind::interface, {Stored::restitution},
            has_friction ? std::vector{Dissipated::friction, Dissipated::inelastic_impact} : std::vector{Dissipated::inelastic_impact}};
  std::vector<Dissipated> takes{Dissipated::damping};
  if (interface.follows_thickness) takes.push_back(Dissipated::thinning);
  if (has_friction) takes.push_back(Dissipated::friction);
  return {interface.name, SourceKind::interface,
          has_friction ? std::vector{Stored::penalty, Stored::tangential_penalty} : std::vector{Stored::penalty}, takes};
}

void post(const Interface& interface, const Memory& memory, Account& account) {
  account.work = memory.work;
  account.hold(Stored::penalty, by_multipliers(interface) ? 0 : stored(memory));
  if (!bonded_by_multipliers(interface)) account.hold(Stored::restitution, memory.held);
  account.hold(Stored::tangential_penalty, tangential_stored(memory));
  account.dissipated[Dissipated::damping] = memory.damped;
  account.dissipated[Dissipated::thinning] = memory.thinned;
  account.dissipated[Dissipated::friction] = memory.friction_dissipated - memory.friction_to_come;
  account.dissipated[Dissipated::inelastic_impact] = memory.impact;
  account.created_by_reconnection = memory.created_by_reconnection;
  account.angular_impulse = memory.angular_impulse;
}

double least_gap(const Interface& interface, const Vectors& x, const Memory& memory, double reach) {
  double least = std::numeric_limits<double>::quiet_NaN();
  if (interface.kind == InterfaceKind::edges) return least;  // of edges that cross nothing is known before
  const auto see = [&least](double gap) {
    if (!(gap >= least)) least = gap;
  };
  for (const Near& near : memory.near) {
    if (near.element.closed) see(memory.gap[near.apex]);
    else if (near.facets > 0) {
      const Nearest nearest = nearest_of(interface, x, near.apex, near_facets(memory, near));
      see(nearest.distance() - level(interface, memory, near.apex, nearest.feature.facet));
    }
  }
  if (!memory.near.empty() || interface.bodies.count() > 0) return least;  // who is not near is farther away
  BroadSearch broad(static_cast<Index>(interface.base.facets.cols()));
  if (!broad.sort(interface.base, x)) return least;
  for (std::size_t a = 0; a < interface.apexes.size(); ++a) {
    const Vector<double> p = position(x, interface.apexes[a]);
    const double height = contact_height(interface, memory, static_cast<Index>(a));
    const Index facet = broad.nearest(interface.base, x, p, std::isnan(least) ? reach : least + height);
    if (facet < 0) continue;
    see(std::sqrt(geometry::closest_on_triangle(corners(interface.base, x, facet), p).distance_squared) - height);
  }
  return least;
}

ElementView view(const Interface& interface, const Vectors& x, const Memory& memory, Index apex) {
  ElementView v{.apex = interface.apexes[apex], .feature = memory.feature[apex], .weight = {0, 0, 0}, .gap = memory.gap[apex],
                .traction = 0, .shear_traction = 0, .slides = false, .status = memory.status[apex],
                .reconnections = memory.reconnections[apex]};
  const Near* near = contact::near(memory, apex);
  if (v.status == Status::open && near && near->facets > 0 && near->tracks.count == 0) {  // where it stands now, not when last looked at
    const Nearest nearest = nearest_of(interface, x, apex, near_facets(memory, *near));
    v.feature = nearest.feature;
    v.gap = nearest.distance() - level(interface, memory, apex, nearest.feature.facet);
  }
  if (v.feature.facet >= 0) {
    const auto c = corners(interface.base, x, v.feature.facet);
    v.weight = geometry::closest_on_triangle(c, position(x, v.apex)).weight;
  }
  if (v.status != Status::closed) return v;
  if (bonded_by_multipliers(interface)) {
    const Vec3 force = near->element.apex, normal = normal_of(interface, apex, x);
    v.traction = force.dot(normal) / interface.area(apex);
    v.shear_traction = (force - force.dot(normal) * normal).norm() / interface.area(apex);
    return v;
  }
  if (by_multipliers(interface)) {
    v.traction = near->element.apex.norm() / interface.area(apex);
    v.shear_traction = near->friction.acts ? near->friction.force.norm() / interface.area(apex) : 0;
    v.slides = v.shear_traction >= (1 - 1e-9) * near->friction.coefficient * v.traction;
    return v;
  }
  const double per_area = between(interface, apex, v.feature.facet).penalty;
  v.traction = -per_area * v.gap;
  if (interface.kind == InterfaceKind::bonded) {
    const double k = stiffness(interface, apex, v.feature, interface.area(apex)), along = k * v.gap;
    const double all = 2 * k * memory.stored[apex];  // |k d|^2
    v.shear_traction = per_area / k * std::sqrt(std::max(0.0, all - along * along));
  } else if (!memory.slip.empty()) {
    v.shear_traction = interface.friction.tangential_penalty * per_area * memory.slip[apex].norm();
    v.slides = v.shear_traction >= (1 - 1e-9) * near->friction.coefficient * v.traction;  // round-off
  }
  return v;
}

}  // namespace nereid::contact
