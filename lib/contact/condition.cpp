#include "contact/condition.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contact/apex.hpp"
#include "contact/foot.hpp"
#include "contact/near.hpp"
#include "contact/restitution.hpp"
#include "contact/rigid_nodes.hpp"
#include "contact/stand.hpp"

namespace nereid::contact {

namespace {

constexpr double steps_to_touch = 4;   // open apexes that can touch within so many steps have a condition too
constexpr double corrected = 0.2;      // of a penetration in a step
constexpr double no_direction = 1e-3;  // of the size of a face: an edge or vertex that is nearer has no normal of its own
constexpr double along = 0.5;          // cosine between a push and the normal of a facet that takes it over
constexpr double paid_back = 0.2;      // of what friction owes, in a step
constexpr double most_yield = 1e-6;    // of the depth of an element: way by which a stick yields for that in a step
constexpr double no_response = 1e-9;   // of that of a free apex: constraints hold all nodes
constexpr double faces_below = 0.3;    // cosine between the normals of an apex and of what it may touch

/// Whether an apex that is pressed stays over the inside of the one facet that it slides on, and comes to no other part: its stencil of the
/// step before says which, and conditions need no more.
bool stays(const Interface& interface, const Memory& memory, double moved, const Near& near) {
  const Tracks& tracks = near.tracks;
  const ElementForces& element = near.element;
  return near.pressed > 0 && moved < tracks.owned && 2 * moved + element.depth < near.clear && tracks.count == 1 && element.count == 1 &&
         !(tracks.track[0].height < contact_height(interface, memory, near.apex)) && allowed_of(interface, near.apex) == nullptr;
}

/// Finds which apexes are in contact, or near to it, where the nodes would be.
void find(const Interface& interface, const Motion& m, Memory& memory, Workspace& workspace, Multipliers& all) {
  const auto look = [&](const Vectors& x, const Vectors& way, double dt) {
    const double moved = search_where_due(interface, x, way, memory, workspace);
    parallel_for(static_cast<Index>(memory.near.size()), 64, [&](Index i) {
      Near& near = memory.near[i];
      near.pressed = near.element.closed && m.dt > 0 ? near.element.apex.norm() : 0;
      if (near.rests && moved < near.clear) return;
      if (stays(interface, memory, moved, near)) {
        near.element.moved = false;
        near.element.lost = 0;
        return;
      }
      const Feature before = memory.feature[near.apex];
      find_contact(interface, x, way, dt, moved, near, memory);
      near.element.moved = near.pressed > 0 && !same(memory.feature[near.apex], before);
      near.rests = near.tracks.count == 0 && near.element.count == 0;
    });
  };
  if (!(m.dt > 0)) look(m.x, m.v, 0);  // at the start apexes may stand behind the surface
  look(all.ahead, all.way, m.dt + m.next);
}

/// Nodes, weights, normal and gap of an apex over the feature of a stencil where the nodes are at t; false if it is out of reach.
///
/// A stencil with a push was found where the nodes would be: it counts however far the apex is now, and the push has the direction.
bool make(const Interface& interface, const Motion& m, const Multipliers& all, const Near& near, Stencil& stencil, bool& has_moment,
          Condition& c) {
  const Index apex = interface.apexes[near.apex];
  const Vec3 p = m.x.col(apex);
  const double push = stencil.push.norm();
  FeatureHeight over;
  const auto feature = [&] { return Feature{stencil.facet, stencil.kind, stencil.local}; };
  if (stencil.kind != geometry::Kind::facet) {  // where the apex would be; now it may be over a facet beside
    const Stand here = stand(interface.base, m.x, p, stencil.facet);
    if (here.past == 0) stencil.facet = here.feature.facet, stencil.kind = here.feature.kind, stencil.local = here.feature.local;
    over = height_over(interface.base, m.x, feature(), p);
  }
  if (stencil.kind != geometry::Kind::facet && std::abs(over.height) < no_direction * interface.base.size(stencil.facet)) {
    const Vec3 facet = facet_normal(interface.base, m.x, stencil.facet);
    if (push > 0 && facet.dot(stencil.push) < along * push) has_moment = true, over.normal = stencil.push / push;
    else stencil.kind = geometry::Kind::facet;
  }
  // beside a rim, below its level: the normal from there to the apex leads along the surface, and nothing was penetrated
  if (stencil.kind != geometry::Kind::facet && near.tracks.count == 0 && over.height < 0) return false;
  if (stencil.kind == geometry::Kind::facet) over.weight = stencil.weight;
  else if (push > 0 && over.normal.dot(stencil.push) < 0) over.normal = -over.normal, over.height = -over.height;
  // over plates the foot would leave its node, and where several push each has its own
  const bool blends = near.element.count == 1 && stencil.level < blended * interface.base.size(stencil.facet);
  const Mat3* allowed = allowed_of(interface, near.apex);
  if (!stand_on_face(interface.base, m.x, p, feature(), blends, allowed, over, stencil.fourth)) {
    stencil.fourth = 0;
    if (stencil.kind == geometry::Kind::facet) over = height_over(interface.base, m.x, feature(), p);
    if (blends && stencil.kind == geometry::Kind::facet && interface.base.half[stencil.facet].cut < 0)
      blend_over_facet(interface.base, m.x, p, feature(), allowed, over);
  }
  stencil.weight = over.weight;
  c.gap = over.height - stencil.level;
  c.normal = over.normal;
  c.node[0] = apex;
  c.weight[0] = 1;
  for (int I = 0; I < 3; ++I) c.node[I + 1] = interface.base.facets(I, stencil.facet), c.weight[I + 1] = -over.weight[I];
  c.nodes = 4;
  if (stencil.fourth != 0) c.nodes = 5, c.node[4] = interface.base.half[stencil.facet].fourth, c.weight[4] = -stencil.fourth;
  if (!(push > 0)) {
    double fastest = 0;
    for (int I = 1; I < c.nodes; ++I) fastest = std::max(fastest, (all.velocity.col(apex) - all.velocity.col(c.node[I])).squaredNorm());
    if (c.gap > std::max(multipliers_reach * interface.depth, steps_to_touch * m.next * std::sqrt(fastest))) return false;
    const bool faced = near.tracks.count > 0 || interface.own.facets.cols() == 0;
    if (!faced && !(node_normal(interface.own, m.x, apex).dot(c.normal) < faces_below)) return false;
  }
  return true;
}

/// Whether a stencil before this one has the other half of its face: both are one bilinear surface.
bool is_same_face(const BaseSurface& base, const ElementForces& element, int s) {
  const Half& half = base.half[element.stencil[s].facet];
  if (half.cut < 0) return false;
  const Index other = base.neighbour(half.cut, element.stencil[s].facet);
  for (int before = 0; before < s; ++before)
    if (element.stencil[before].apex != 0 && element.stencil[before].facet == other) return true;
  return false;
}

/// What follows from these; false where constraints hold all its nodes.
///
/// pressed  [N] by all conditions of the contactor in the step before;  held  [J] by it
bool complete(const Motion& m, const Vectors& free, double pressed, double held, Condition& c) {
  c.constrained = false;
  c.per_mass = c.before = c.free = 0;
  for (int j = 0; j < c.nodes; ++j) {
    const Index node = c.node[j];
    c.response[j] = c.weight[j] / m.mass(node);
    const double let = m.allowed[node] ? c.normal.dot(*m.allowed[node] * c.normal) : 1;
    c.constrained = c.constrained || m.allowed[node];
    c.per_mass += let * c.weight[j] * c.response[j];
    c.before += c.weight[j] * c.normal.dot(m.v.col(node));
    c.free += c.weight[j] * c.normal.dot(free.col(node));
  }
  if (m.rigid) c.per_mass = per_mass(*m.rigid, m, c);
  const double closing = (c.gap > 0 ? -c.gap : -corrected * c.gap) / m.next, impulse = 0.5 * pressed * (m.dt + m.next);
  const double from_held = impulse > 0 ? std::max(0.0, held) / impulse : 0;
  const double may = 2 * from_held - c.before;  // the work of this step; to stop again takes as much as to go apart
  c.least = std::min(closing, may > 0 ? 0.5 * may : may);
  return c.per_mass > no_response / m.mass(c.node[0]);
}

/// How much slip rate an impulse makes, at most: with the constraints, or as if all nodes were free. [1/kg]
double response(const Touch& touch, const Motion& m, bool constrained) {
  const Vec3 first = touch.normal.unitOrthogonal(), second = touch.normal.cross(first);
  const FrictionShares one = share_friction(touch, first), other = share_friction(touch, second);
  const auto product = [&](const FrictionShares& a, const FrictionShares& b) {
    const bool of_bodies = constrained && m.rigid;
    double sum = of_bodies ? product_of_bodies(*m.rigid, a, b, m.x) : 0;
    for (int i = 0; i < a.count; ++i) {
      const Index node = a.node[i];
      if (of_bodies && m.rigid->of_node[node] >= 0) continue;
      const Vec3 let = constrained && m.allowed[node] ? Vec3(*m.allowed[node] * b.force[i]) : b.force[i];
      sum += a.force[i].dot(let) / m.mass(node);
      if (a.turns[i] && b.turns[i]) sum += a.moment[i].dot(b.moment[i]) / m.inertia(m.rotation_of_node[node]);
    }
    return sum;
  };
  return std::max(product(one, one), product(other, other)) + std::abs(product(one, other));
}

/// Adds the friction of a contactor, with the force of the step before as a first guess. Where constraints hold or drive all nodes along
/// the plane, no impulse changes the slip rate; it grows to what the normal impulse allows, and they take it.
///
/// stuck  in the step before: what sweeps have left of its slip rate is no sliding
Index add_friction(const Touch& touch, const Coulomb& law, const Vec3& force, bool stuck, const Motion& m, Multipliers& all) {
  double per_mass = response(touch, m, true);
  if (!(per_mass > no_response / m.mass(touch.apex))) per_mass = response(touch, m, false);
  const Vec3 impulse = 0.5 * (m.dt + m.next) * (force - touch.normal.dot(force) * touch.normal);
  const Vec3 before = slip_rate(touch, m.v, m.omega, m.rotation_of_node);
  all.frictions.push_back({.touch = touch, .coefficient = coefficient_at(law, stuck ? 0 : before.norm()), .per_mass = per_mass,
                           .bound = 0, .before = before, .stuck = Vec3::Zero(), .impulse = impulse, .change = Vec3::Zero(),
                           .met = impulse, .moved = Vec3::Zero(), .after = before});
  return static_cast<Index>(all.frictions.size()) - 1;
}

/// Lets sticks yield against their forces, so that friction takes back what it owes [J].
void let_yield(double owed, double depth, const Motion& m, std::size_t first, Multipliers& all) {
  if (!(owed > 0)) return;
  double sum = 0;
  for (std::size_t k = first; k < all.frictions.size(); ++k) sum += all.frictions[k].impulse.norm();
  if (!(sum > 0)) return;
  const double speed = std::min(paid_back * owed / sum, most_yield * depth / m.next);
  for (std::size_t k = first; k < all.frictions.size(); ++k) {
    FrictionCondition& friction = all.frictions[k];
    const double size = friction.impulse.norm();
    if (size > 0) friction.stuck = -speed / size * friction.impulse;
  }
}

/// The stencil of the first condition of an apex.
const Stencil& first_of(const ElementForces& element) {
  int s = 0;
  while (element.stencil[s].apex == 0) ++s;
  return element.stencil[s];
}

}  // namespace

Multipliers make_multipliers(std::span<const Interface> interfaces, std::span<const RigidPlane> planes, Index nodes, Index plate_nodes) {
  constexpr std::size_t most_of_an_apex = 3;  // conditions; some may have more, but not many
  Multipliers all;
  all.ahead = all.way = all.velocity = Vectors::Zero(3, nodes);
  all.spin = Vectors::Zero(3, plate_nodes);
  all.shared = Scalars::Zero(nodes);
  std::size_t apexes = 0;
  for (const Interface& interface : interfaces)
    if (by_multipliers(interface) && !bonded_by_multipliers(interface)) apexes += interface.apexes.size();
  for (const RigidPlane& plane : planes) apexes += by_multipliers(plane) ? plane.nodes.size() : 0;
  all.conditions.reserve(most_of_an_apex * apexes);
  all.frictions.reserve(apexes);
  all.contactors.reserve(apexes);
  all.first.reserve(interfaces.size() + planes.size() + 1);
  all.pools.reserve(interfaces.size() + planes.size());
  all.bonds = make_bonds(interfaces, nodes);
  return all;
}

namespace {

void see_ahead(Index node, const Motion& m, Multipliers& all) {
  const Vec3 way = m.next * all.velocity.col(node);
  all.ahead.col(node) = m.x.col(node) + way;
  all.way.col(node) = (m.dt * m.v.col(node) + way) / (m.dt + m.next);
}

}  // namespace

void see_ahead(const Subset& nodes, const Motion& m, Multipliers& all) {
  for (const Index node : nodes) see_ahead(node, m, all);
}

void look_ahead(const Subset& nodes, const Motion& m, Multipliers& all) {
  const double h = 0.5 * (m.dt + m.next);
  for (const Index node : nodes) {
    all.shared(node) = 0;
    Vec3 change = h / m.mass(node) * m.force.col(node);
    if (m.allowed[node]) change = *m.allowed[node] * change;
    all.velocity.col(node) = m.v.col(node) + change;
    see_ahead(node, m, all);
    const Index turns = m.rotation_of_node[node];
    if (turns < 0) continue;
    Vec3 turn = h / m.inertia(turns) * m.moment.col(turns);
    if (m.allowed_rotation[turns]) turn = *m.allowed_rotation[turns] * turn;
    all.spin.col(turns) = m.omega.col(turns) + turn;
  }
}

void find_conditions(const Interface& interface, const Motion& m, Memory& memory, Workspace& workspace, Multipliers& all) {
  const double h = 0.5 * (m.dt + m.next);
  const std::size_t first_friction = all.frictions.size();
  find(interface, m, memory, workspace, all);
  for (Near& near : memory.near) {
    const auto first = static_cast<Index>(all.conditions.size());
    for (int s = 0; s < near.element.count; ++s) {
      Stencil& stencil = near.element.stencil[s];
      Condition& c = all.conditions.emplace_back();
      const bool counts = !std::isnan(stencil.level) && !is_same_face(interface.base, near.element, s) &&
                          make(interface, m, all, near, stencil, near.element.has_moment, c) &&
                          complete(m, all.velocity, near.pressed, memory.restitution[near.apex].held, c);
      if (!counts) {
        stencil.apex = 0, stencil.weight = {}, stencil.fourth = 0, stencil.push.setZero();
        all.conditions.pop_back();
        continue;
      }
      c.impulse = c.met = near.element.count == 1 ? near.pressed * h : 0;
      stencil.push = c.normal;
    }
    const auto last = static_cast<Index>(all.conditions.size());
    Restitution& restitution = memory.restitution[near.apex];
    if (last == first) {
      discard(restitution, memory.impact);
      continue;
    }
    const double area = interface.area(near.apex);
    Index friction = -1;
    if (interface.friction.coefficient > 0 && m.dt > 0) {
      const Stencil& foot = first_of(near.element);
      const Touch touch = touch_of(interface, m.x, near.apex, {foot.facet, geometry::Kind::facet, 0}, all.conditions[first].normal, &foot);
      const Vec3 force = near.friction.acts ? near.friction.force : Vec3(Vec3::Zero());
      friction = add_friction(touch, interface.friction, force, near.friction.stuck, m, all);
    }
    all.contactors.push_back({.memory = &restitution, .first = first, .last = last, .friction = friction,
                              .area = area, .depth = interface.depth,
                              .impedance = interface.pass_factor * interface.impedance * area,
                              .square = interface.restitution * interface.restitution});
  }
  for (std::size_t a = 0; a < memory.restitution.size(); ++a)
    if (memory.slot[a] < 0 && memory.restitution[a].held != 0) discard(memory.restitution[a], memory.impact);
  let_yield(memory.friction_owed, interface.depth, m, first_friction, all);
}

void find_conditions(const RigidPlane& plane, const Motion& m, PlaneMemory& memory, Multipliers& all) {
  const std::size_t first_friction = all.frictions.size();
  for (std::size_t i = 0; i < plane.nodes.size(); ++i) {
    const Index node = plane.nodes[i];
    const auto first = static_cast<Index>(all.conditions.size());
    Condition& c = all.conditions.emplace_back();
    c.nodes = 1, c.node[0] = node, c.weight[0] = 1, c.normal = plane.normal;
    c.gap = (m.x.col(node) - plane.point).dot(plane.normal);
    const double way = steps_to_touch * m.next * std::abs(plane.normal.dot(all.velocity.col(node)));
    const bool far = !(memory.force[i] > 0) && c.gap > std::max(multipliers_reach * plane.depth, way);
    if (far || !complete(m, all.velocity, m.dt > 0 ? memory.force[i] : 0, memory.restitution[i].held, c)) {
      discard(memory.restitution[i], memory.impact);
      memory.next_force[i] = 0;
      if (!memory.next_friction.empty()) memory.next_friction[i].setZero(), memory.stuck[i] = 0;
      all.conditions.pop_back();
      continue;
    }
    const double area = plane.area(static_cast<Eigen::Index>(i));
    c.impulse = c.met = memory.force[i] * 0.5 * (m.dt + m.next);
    Index friction = -1;
    if (plane.friction.coefficient > 0 && m.dt > 0) {
      Touch touch;
      touch.normal = plane.normal, touch.apex = node, touch.nodes = 0;
      friction = add_friction(touch, plane.friction, memory.friction[i], memory.stuck[i] != 0, m, all);
    }
    all.contactors.push_back({.memory = &memory.restitution[i], .first = first, .last = first + 1, .friction = friction,
                              .area = area, .depth = plane.depth, .impedance = plane.impedance * area,
                              .square = plane.restitution * plane.restitution});
  }
  let_yield(memory.friction_owed, plane.depth, m, first_friction, all);
}

void find_change(double pressed, const Motion& m, const Multipliers& all, FrictionCondition& friction) {
  const double limit = friction.coefficient * pressed;
  friction.change.setZero();
  if (!(limit > 0) && friction.impulse.isZero(0)) return;
  Vec3 now = friction.impulse - (rate(friction, m, all) - friction.stuck) / friction.bound;
  const double size = now.norm();
  friction.slides = size > limit;
  if (friction.slides) now *= limit / size;
  friction.change = now - friction.impulse;
}

void apply_changes(const Motion& m, Multipliers& all) {
  for (const Contactor& one : all.contactors) {
    for (Index i = one.first; i < one.last; ++i) {
      Condition& c = all.conditions[i];
      if (c.change == 0) continue;
      c.impulse += c.change;
      give(c, c.change, m, all.velocity);
    }
    if (one.friction < 0 || all.frictions[one.friction].change.isZero(0)) continue;
    FrictionCondition& condition = all.frictions[one.friction];
    condition.impulse += condition.change;
    give(condition, condition.change, m, all);
  }
  if (m.rigid) settle(*m.rigid, m, all.velocity);
  if (all.bonds.touched) hold(m, all.velocity, all.bonds);
}

void find_work(const Motion& m, Multipliers& all) {
  for (Contactor& one : all.contactors) {
    one.work = 0;
    for (Index i = one.first; i < one.last; ++i) {
      Condition& c = all.conditions[i];
      c.after = rate(c, all.velocity);
      one.work += work(c, c.after);
    }
  }
  for (FrictionCondition& condition : all.frictions) {
    condition.after = rate(condition, m, all);
    condition.work = work(condition, condition.after);
  }
}

}  // namespace nereid::contact
