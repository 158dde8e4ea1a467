#include "contact/contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.hpp"
#include "contact/stand.hpp"
#include "geometry/height.hpp"

namespace nereid::contact {

namespace {

using geometry::Closest;
using geometry::Kind;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double votes_within = 0.25;   // of the depth of an element: open apexes that are nearer vote for the step
constexpr double steps_ahead = 2;       // and those that may be in contact after so many of the longest steps
constexpr double least_area = 0.2;      // of the tributary area: with less of it facing, the surface of the apex stands edge-on
constexpr double in_plane = 1e-6;       // of a distance: a node that lies in a symmetry plane
constexpr double bond_past_border = 0.05;  // of a facet's size: half of what a border apex stands for lies inside
constexpr double depth_to_check = 0.25;  // of the depth of an element: half of what is warned of
constexpr Index facets_at_first = 32;   // near an apex, for which memory is taken at the start

/// Directions that an apex on a symmetry plane may go; null for the others.
const Mat3* allowed_of(const Interface& interface, Index a) {
  return interface.allowed.empty() || interface.allowed[a].isIdentity(0) ? nullptr : &interface.allowed[a];
}

bool same(const Feature& a, const Feature& b) {
  return a.facet == b.facet && a.kind == b.kind && (a.kind == Kind::facet || a.local == b.local);
}

std::span<const Index> near_facets(const Memory& memory, const Near& near) {
  return std::span<const Index>(memory.near_facets).subspan(near.first_facet, near.facets);
}

/// The closest of the facets near an apex.
struct Nearest {
  Feature feature;
  Closest closest{Kind::facet, 0, {}, infinite};
  double clear = infinite;  ///< [m] way to where the first of the facets can be entered, which may reach past a border
  double distance() const { return std::sqrt(closest.distance_squared); }
};
Nearest nearest_of(const Interface& interface, const Vectors& x, Index a, std::span<const Index> facets) {
  Nearest best;
  const Vector<double> p = position(x, interface.apexes[a]);
  for (const Index f : facets) {
    const Closest there = geometry::closest_on_triangle(corners(interface.base, x, f), p);
    if (there.distance_squared < best.closest.distance_squared) best.feature = {f, there.kind, there.local}, best.closest = there;
    best.clear = std::min(best.clear, std::sqrt(there.distance_squared) - whole_past_wall * interface.base.size(f));
  }
  return best;
}

/// Weights of the point of a facet that is closest to an apex.
std::array<double, 3> weights_of(const Interface& interface, const Vectors& x, Index a, Index facet) {
  return geometry::closest_on_triangle(corners(interface.base, x, facet), position(x, interface.apexes[a])).weight;
}

/// Visits the base nodes of a stencil with what they take of the push and of the stiffness.
template <class Visit>
void for_each_node(const Interface& interface, const Stencil& stencil, Visit&& visit) {
  for (int I = 0; I < 3; ++I) visit(interface.base.facets(I, stencil.facet), stencil.weight[I], stencil.share[I]);
}

/// Shares out the stiffness of an apex over its base nodes. A node of several stencils counts once, by its largest weight: they push as
/// one. To a node off the symmetry plane of the apex comes the same from the image of its facet.
void share_stiffness(const Interface& interface, const Vectors& x, Index a, ElementForces& element) {
  const Mat3* allowed = allowed_of(interface, a);
  for (int i = 0; i < element.count; ++i) {
    Stencil& stencil = element.stencil[i];
    for (int I = 0; I < 3; ++I) {
      const Index node = interface.base.facets(I, stencil.facet);
      stencil.share[I] = std::abs(stencil.weight[I]);
      if (allowed && stencil.share[I] > 0) {
        const Vec3 away = x.col(node) - x.col(interface.apexes[a]);
        if ((away - *allowed * away).norm() > in_plane * away.norm()) stencil.share[I] *= 2;
      }
      for (int j = 0; j < i; ++j)
        for (int J = 0; J < 3; ++J) {
          double& first = element.stencil[j].share[J];
          if (first == 0 || interface.base.facets(J, element.stencil[j].facet) != node) continue;
          first = std::max(first, stencil.share[I]);
          stencil.share[I] = 0;
        }
    }
  }
}

/// Power of the forces of one apex at scale 1. [W]
double power(const Interface& interface, const Vectors& v, Index a, const ElementForces& element) {
  if (!element.closed) return 0;
  double sum = 0;
  for (int i = 0; i < element.count; ++i) {
    const Stencil& stencil = element.stencil[i];
    Vec3 rate = stencil.apex * v.col(interface.apexes[a]);
    for_each_node(interface, stencil, [&](Index node, double weight, double) { rate -= weight * v.col(node); });
    sum += stencil.push.dot(rate);
  }
  return sum;
}

/// Moment about the origin of the normal forces of one apex, at the positions `later` [s] after x. It is computed where there can be one.
Vec3 moment(const Interface& interface, const Vectors& x, const Vectors& v, double later, Index a, const ElementForces& element) {
  Vec3 sum = Vec3::Zero();
  if (!element.closed || (interface.allowed.empty() && !element.has_moment)) return sum;
  const auto place = [&](Index node) { return Vec3(x.col(node) + later * v.col(node)); };
  for (int i = 0; i < element.count; ++i) {
    const Stencil& stencil = element.stencil[i];
    Vec3 arm = stencil.apex * place(interface.apexes[a]);
    for_each_node(interface, stencil, [&](Index node, double weight, double) { arm -= weight * place(node); });
    sum += arm.cross(stencil.push);
  }
  return element.scale * sum;
}

/// How fast an apex moves against a facet: no slower than against the foot. [m/s]
double speed_over(const Interface& interface, const Vectors& v, Index a, Index facet) {
  double fastest = 0;
  for (int I = 0; I < 3; ++I)
    fastest = std::max(fastest, (v.col(interface.apexes[a]) - v.col(interface.base.facets(I, facet))).squaredNorm());
  return std::sqrt(fastest);
}

/// The tributary area of the sides of an apex that face a facet; all of it where next to none does, as of a sole on a steep flank. [m2]
double area_facing(const Interface& interface, const Vectors& x, Index a, Index facet) {
  if (interface.faces.begin.empty()) return interface.area(a);
  const double facing = mesh::tributary_area_against(interface.faces, x, a, facet_normal(interface.base, x, facet));
  return facing > least_area * interface.area(a) ? facing : interface.area(a);
}

/// A stencil without a push, so that the apex votes for the time step.
void vote_over(const Interface& interface, const Vectors& x, Index a, const Feature& feature, const std::array<double, 3>& weight,
               ElementForces& element) {
  element.count = 1;
  element.stencil[0] = {.facet = feature.facet, .apex = 1, .weight = weight, .push = Vec3::Zero()};
  element.stiffness = stiffness(interface, a, feature, interface.area(a));
  share_stiffness(interface, x, a, element);
}

/// An apex that is in contact with nothing: how far it is, whether it votes, and how long it need not be looked at.
void look_around(const Interface& interface, const Vectors& x, const Vectors& v, double moved, Near& near, Memory& memory) {
  const Index a = near.apex;
  const Nearest nearest = nearest_of(interface, x, a, near_facets(memory, near));
  near.clear = infinite;  // until the next search
  memory.feature[a] = nearest.feature;
  memory.status[a] = nearest.feature.facet < 0 ? Status::unpaired : Status::open;
  memory.gap[a] = std::numeric_limits<double>::quiet_NaN();
  if (nearest.feature.facet < 0) return;
  memory.gap[a] = nearest.distance() - interface.contact_height(a);
  double soon = infinite;
  if (interface.depth > 0) {
    const double speed = speed_over(interface, v, a, nearest.feature.facet);
    soon = std::max(votes_within * interface.depth, steps_ahead * speed * interface.longest_step);
  }
  const bool votes = memory.gap[a] <= soon;
  near.clear = nearest.clear - interface.contact_height(a) - moved - (votes ? 0 : soon);
  if (votes) vote_over(interface, x, a, nearest.feature, nearest.closest.weight, near.element);
}

/// Finds what an apex is in contact with, and its forces.
void update_element(const Interface& interface, const Vectors& x, const Vectors& v, double dt, double moved, Near& near, Memory& memory) {
  const Index a = near.apex;
  const double contact_height = interface.contact_height(a);
  const Mat3* allowed = allowed_of(interface, a);
  const Index node = interface.apexes[a];
  const Sweep sweep{interface.base, interface.own, x, v, dt, near_facets(memory, near), node, allowed, contact_height};
  const Tracks before = near.tracks;
  if (before.count == 0 && dt > 0) enter(sweep, memory.deepest_now, near.tracks);
  if (before.count == 0 && !(dt > 0)) {  // at the start, displaced from the reference
    double depth = 0;
    const Index facet = behind(sweep, interface.depth > 0 ? interface.depth : infinite, depth);
    if (facet >= 0) near.tracks.begin(facet, contact_height);
  }
  if (near.tracks.count == 0) return look_around(interface, x, v, moved, near, memory);
  if (before.count == 0) near.clear = -infinite;
  if (before.count == 0 || !(near.area > 0)) {  // it keeps it while it is in contact: a stiffness that changes makes energy
    near.area = area_facing(interface, x, a, near.tracks.track[0].facet);
  }

  WayOut out = way_out(interface.base, x, x.col(node), contact_height, allowed, moved, near.tracks, near.element.stencil);
  if (moved + out.length >= near.clear) {
    const Index other = other_part(sweep, before, near.tracks);
    if (other >= 0) {
      const int lost = out.lost;
      near.tracks.begin(other, contact_height);
      out = way_out(interface.base, x, x.col(node), contact_height, allowed, moved, near.tracks, near.element.stencil);
      out.lost += lost;
    }
    near.clear = other >= 0 ? -infinite : nearest_other_part(sweep, near.tracks) - moved - out.length - contact_height;
  }
  ElementForces& element = near.element;
  element.lost = out.lost;
  if (near.tracks.count == 0) near.clear = -infinite;
  if (out.count == 0) {
    if (near.tracks.count == 0) return look_around(interface, x, v, moved, near, memory);
    memory.status[a] = Status::open;
    memory.feature[a] = out.strongest;
    memory.gap[a] = std::max(0.0, out.gap);
    return vote_over(interface, x, a, out.strongest, weights_of(interface, x, a, out.strongest.facet), element);
  }
  const double k = stiffness(interface, a, out.strongest, near.area > 0 ? near.area : interface.area(a));
  memory.status[a] = Status::closed;
  memory.feature[a] = out.strongest;
  memory.gap[a] = -out.length;
  memory.stored[a] = 0.5 * k * out.squared;
  element.closed = true;
  element.has_moment = out.has_moment;
  element.stiffness = k * out.steepest;
  element.depth = out.depth;
  element.count = out.count;
  for (int i = 0; i < out.count; ++i) {
    Stencil& stencil = element.stencil[i];
    stencil.push *= k;
    element.apex += stencil.apex * stencil.push;
  }
  share_stiffness(interface, x, a, element);
}

/// Pulls or pushes a bonded apex back over its point of the base.
///
/// With d = x_apex - sum of w_I x_I - h n the potential is 1/2 k d.d, and with G_I the gradients of the
/// facet's shape functions  dn = - sum of (n . dx_I) G_I,  so the forces are exactly its gradient:
///     apex  -k d,     base nodes  k (w_I d - h (d . G_I) n), the second part a couple
void hold_bond(const Interface& interface, const Vectors& x, Near& near, Memory& memory) {
  const Index a = near.apex;
  ElementForces& element = near.element;
  const Bond& bond = interface.bonds[a];
  const Vec3 corner[3] = {x.col(interface.base.facets(0, bond.facet)), x.col(interface.base.facets(1, bond.facet)),
                          x.col(interface.base.facets(2, bond.facet))};
  const Vec3 area = area_vector(interface.base, x, bond.facet);
  const double twice_area = area.norm();
  const Vec3 n = area / twice_area;
  Vec3 d = x.col(interface.apexes[a]) - bond.height * n;
  for (int I = 0; I < 3; ++I) d -= bond.weight[I] * corner[I];
  const double k = stiffness(interface, a, memory.feature[a], interface.area(a));
  Stencil hold{.facet = bond.facet, .apex = 1, .weight = bond.weight, .push = -k * d}, couple{.facet = bond.facet, .apex = 0};
  couple.push = k * bond.height * n;
  for (int I = 0; I < 3; ++I) {
    const Vec3 gradient = n.cross(corner[(I + 2) % 3] - corner[(I + 1) % 3]) / twice_area;
    couple.weight[I] = d.dot(gradient);
    hold.share[I] = std::abs(bond.weight[I]) + std::abs(bond.height) * gradient.norm();
  }
  element.closed = true;
  element.stiffness = k;
  element.apex = hold.push;
  element.stencil[0] = hold;
  element.stencil[1] = couple;
  element.count = bond.height != 0 ? 2 : 1;
  memory.status[a] = Status::closed;
  memory.gap[a] = d.dot(n);
  memory.stored[a] = 0.5 * k * d.squaredNorm();
}

/// Where the apex stands on its base, for friction.
Touch touch_of(const Interface& interface, const Vectors& x, Index a, const Feature& feature, const Vec3& normal) {
  Touch touch;
  touch.normal = normal;
  touch.apex = interface.apexes[a];
  const auto c = corners(interface.base, x, feature.facet);
  const Vec3 at = x.col(touch.apex);
  std::array<Vec3, 3> corner;
  for (int I = 0; I < 3; ++I) {
    touch.node[I] = interface.base.facets(I, feature.facet);
    corner[I] = {c[I].x, c[I].y, c[I].z};
  }
  measure_base(corner, touch);
  if (interface.weights == Weights::paper) {
    const FeatureNodes base = nodes_of(interface.base, feature);
    for (int I = 0; I < 3; ++I)
      for (int b = 0; b < base.count; ++b)
        if (base.node[b] == touch.node[I]) touch.weight[I] = 1.0 / base.count;
    return touch;
  }
  touch.weight = geometry::closest_on_triangle(c, {at.x(), at.y(), at.z()}).weight;
  touch.arm = at;
  for (int I = 0; I < 3; ++I) touch.arm -= touch.weight[I] * corner[I];
  touch.apex_arm = interface.arm_of_apex * touch.arm;
  touch.base_arm = touch.arm - touch.apex_arm;
  touch.base_rotates = !interface.rotation_of_node.empty() && interface.rotation_of_node[touch.node[0]] >= 0;
  return touch;
}

/// Rotation of the base over the step that led to x, from its positions in the middle, where a rigid
/// rotation is met exactly. [rad]
Vec3 rotation_of_base(const Touch& touch, const Vectors& x, const Vectors& v, double dt) {
  Touch middle = touch;
  std::array<Vec3, 3> corner;
  for (int I = 0; I < 3; ++I) corner[I] = x.col(touch.node[I]) - 0.5 * dt * v.col(touch.node[I]);
  measure_base(corner, middle);
  return dt * spin_of_base(middle, v);
}

/// Friction on one apex whose normal force is known: slip carried on, stuck or slid.
void advance_friction(const Interface& interface, const Vectors& x, const Vectors& v, const Vectors& omega, double dt, Near& near,
                      Memory& memory) {
  const Index a = near.apex;
  const ElementForces& element = near.element;
  FrictionForces& friction = near.friction;
  Vec3& angular_impulse = near.element.angular_impulse;
  const bool turns = interface.weights == Weights::paper || !interface.allowed.empty();
  const double stored_before = memory.tangential_stored[a];
  Vec3 rate_before = Vec3::Zero();
  double work = 0;
  if (friction.acts) {
    rate_before = slip_rate(friction.touch, v, omega, interface.rotation_of_node);
    work = 0.5 * dt * friction.force.dot(rate_before);
    if (turns) angular_impulse += 0.5 * dt * moment_of_friction(friction.touch, friction.force, x, v, -dt);
  }
  // on a symmetry plane the images of the bases take what leads out of it
  const Vec3 pushed = interface.allowed.empty() ? element.apex : Vec3(interface.allowed[a] * element.apex);
  const double push = element.scale * pushed.norm();
  if (!element.closed || !(push > 0)) {
    friction.acts = false;
    friction.force.setZero();
    memory.slip[a].setZero();
    memory.tangential_stored[a] = 0;
    friction.work = work;
    friction.dissipated = std::max(0.0, stored_before - work);  // the stick lets go
    friction.created = friction.work + friction.dissipated - stored_before;
    return;
  }
  const Touch touch = touch_of(interface, x, a, memory.feature[a], pushed.normalized());
  const Vec3 rotation = rotation_of_base(touch, x, v, dt);
  const Vec3 rate = slip_rate(touch, v, omega, interface.rotation_of_node);
  const Vec3 held = carried(memory.slip[a], rotation, touch.normal);
  Vec3 trial = held;
  if (friction.acts) trial += 0.5 * dt * (carried(rate_before, rotation, touch.normal) + rate);
  if (!interface.allowed.empty()) trial = interface.allowed[a] * trial;
  friction.stiffness = interface.friction.tangential_penalty * element.stiffness;
  const Slip slip = stick_or_slide(trial, friction.stiffness, interface.friction.coefficient * push);
  friction.acts = true;
  friction.touch = touch;
  friction.force = -friction.stiffness * slip.elastic;
  memory.slip[a] = slip.elastic;
  memory.tangential_stored[a] = 0.5 * friction.stiffness * slip.elastic.squaredNorm();
  friction.work = work + 0.5 * dt * friction.force.dot(rate);
  friction.dissipated = std::max(0.0, 0.5 * friction.stiffness * (held + slip.elastic).dot(slip.slid));
  friction.created = friction.work + friction.dissipated + memory.tangential_stored[a] - stored_before;
  if (turns) angular_impulse += 0.5 * dt * moment_of_friction(touch, friction.force, x, v, 0);
}

/// Moves one apex and computes its force.
void advance_element(const Interface& interface, const Vectors& x, const Vectors& v, double dt, double moved, Near& near, Memory& memory) {
  const Index a = near.apex;
  ElementForces& element = near.element;
  const double power_before = power(interface, v, a, element), scale_before = element.scale;
  element.angular_impulse = 0.5 * dt * moment(interface, x, v, -dt, a, element);
  const double stored_before = memory.stored[a];
  const Feature before = memory.feature[a];
  const bool was_closed = element.closed;
  element.closed = element.has_moment = false;
  element.depth = 0;
  element.lost = 0;
  element.apex.setZero();
  element.count = 0;
  memory.stored[a] = 0;
  if (interface.kind == InterfaceKind::bonded) hold_bond(interface, x, near, memory);
  else update_element(interface, x, v, dt, moved, near, memory);
  element.moved = (was_closed || element.closed) && !same(memory.feature[a], before);
  near.rests = !was_closed && !element.closed && near.tracks.count == 0;
  const double power_after = power(interface, v, a, element);
  // the power of the elastic force is  -k |d| d|d|/dt = -2 stored d|d|/dt / |d|
  element.scale = 1;
  if (memory.stored[a] > 0 && interface.damping_time > 0)
    element.scale = std::max(0.0, 1 - 0.5 * interface.damping_time * power_after / memory.stored[a]);
  element.angular_impulse += 0.5 * dt * moment(interface, x, v, 0, a, element);
  element.work = 0.5 * dt * (scale_before * power_before + element.scale * power_after);
  element.dissipated = 0.5 * dt * ((1 - scale_before) * power_before + (1 - element.scale) * power_after);
  element.created = element.work + element.dissipated + memory.stored[a] - stored_before;
}

/// The largest squared way of nodes from where they were, less a common way; adds up the ways. [m2]
double farthest_moved(const Subset& nodes, const Vectors& x, const Vectors& then, const Vec3& common, Vec3& sum) {
  double most = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3 way = x.col(nodes[i]) - then.col(static_cast<Eigen::Index>(i));
    sum += way;
    most = std::max(most, (way - common).squaredNorm());
  }
  return most;
}

/// How far apexes and base have moved against each other since the last search, at most. [m]
///
/// Any way taken as common gives a bound. That of the base in the mean is good: here that of its first node now, and what the mean was
/// beyond it a step before, which takes no pass of its own.
double moved_since_search(const Interface& interface, const Vectors& x, Memory& memory) {
  const Vec3 first = x.col(interface.base_nodes[0]) - memory.base_then.col(0), common = first + memory.mean_way;
  Vec3 of_apexes = Vec3::Zero(), of_base = Vec3::Zero();
  const double apexes = farthest_moved(interface.apexes, x, memory.apexes_then, common, of_apexes);
  const double base = farthest_moved(interface.base_nodes, x, memory.base_then, common, of_base);
  memory.mean_way = of_base / static_cast<double>(interface.base_nodes.size()) - first;
  return std::sqrt(apexes) + std::sqrt(base);
}

/// The margin of a search, or what apexes and base can go against each other in some steps where that is more. [m]
double margin_of(const Interface& interface, const Vectors& v) {
  Vec3 common = Vec3::Zero();
  for (const Index node : interface.base_nodes) common += v.col(node) / static_cast<double>(interface.base_nodes.size());
  double apexes = 0, base = 0;
  for (const Index node : interface.apexes) apexes = std::max(apexes, (v.col(node) - common).squaredNorm());
  for (const Index node : interface.base_nodes) base = std::max(base, (v.col(node) - common).squaredNorm());
  const double way = 4 * steps_ahead * interface.longest_step * (std::sqrt(apexes) + std::sqrt(base));
  return std::max(interface.margin, std::isfinite(way) ? way : 0.0);
}

void keep_positions(const Subset& nodes, const Vectors& x, Vectors& then) {
  for (std::size_t i = 0; i < nodes.size(); ++i) then.col(static_cast<Eigen::Index>(i)) = x.col(nodes[i]);
}

/// Leaves an apex alone until a search finds it near its base again.
void unpair(Index a, Memory& memory) {
  memory.feature[a].facet = -1;
  memory.status[a] = Status::unpaired;
  memory.gap[a] = std::numeric_limits<double>::quiet_NaN();
  memory.slot[a] = -1;
}

/// Lists the apexes nearer to their base than h_c and the margin, with the facets that are so near, and those in contact.
///
/// All stay as they are where the base surface has positions that are not finite or beyond farthest_place: the elements say so at this
/// very state, and the run ends.
void search(const Interface& interface, const Vectors& x, Memory& memory, Workspace& workspace) {
  if (!workspace.broad.sort(interface.base, x)) return;
  keep_positions(interface.apexes, x, memory.apexes_then);
  keep_positions(interface.base_nodes, x, memory.base_then);
  memory.mean_way.setZero();
  ++memory.searches;
  const auto count = static_cast<Index>(interface.apexes.size());
  const auto visit_near = [&](Index a, auto&& visit) {
    const double reach = interface.contact_height(a) + memory.margin;
    workspace.broad.within(interface.base, x, position(x, interface.apexes[a]), reach, [&](Index facet, double) { visit(facet); });
  };
  parallel_for(count, 64, [&](Index a) {
    Index found = 0;
    visit_near(a, [&](Index) { ++found; });
    workspace.facets[a] = found;
  });
  workspace.near.clear();
  Index facets = 0;
  for (Index a = 0; a < count; ++a) {
    const Near* was = near(memory, a);
    if (workspace.facets[a] == 0 && !(was && was->tracks.count > 0)) {
      if (was) unpair(a, memory);
      continue;
    }
    if (was) workspace.near.push_back(*was);
    else workspace.near.push_back({.apex = a, .tracks = {}, .element = {}, .friction = {}});
    if (memory.status[a] == Status::unpaired) memory.status[a] = Status::open, ++memory.recovered;
    Near& now = workspace.near.back();
    now.first_facet = facets;
    now.facets = workspace.facets[a];
    now.clear = now.tracks.owned = -infinite;
    now.rests = false;
    facets += now.facets;
    memory.slot[a] = static_cast<Index>(workspace.near.size()) - 1;
  }
  std::swap(memory.near, workspace.near);
  memory.near_facets.resize(facets);
  parallel_for(static_cast<Index>(memory.near.size()), 64, [&](Index i) {
    const Near& one = memory.near[i];
    Index at = one.first_facet;
    visit_near(one.apex, [&](Index facet) { memory.near_facets[at++] = facet; });
    std::sort(memory.near_facets.begin() + one.first_facet, memory.near_facets.begin() + at);
  });
}

/// How an apex stands over its nearest facet at the start.
struct Start {
  Index facet = -1;   ///< -1: none within reach
  Stand stand;
  double distance = 0;  ///< [m]
};
Start start_of(const Interface& interface, const Vectors& x, Index a, double reach, const BroadSearch& broad) {
  const Index node = interface.apexes[a], facet = broad.nearest(interface.base, x, position(x, node), reach);
  if (facet < 0) return {};
  const Closest closest = geometry::closest_on_triangle(corners(interface.base, x, facet), position(x, node));
  return {facet, stand(interface.base, x, x.col(node), facet), std::sqrt(closest.distance_squared)};
}

void prepare(const Interface& interface, Memory& memory) {
  const auto count = static_cast<Index>(interface.apexes.size());
  memory = {};
  memory.near.reserve(count);
  memory.near_facets.reserve(static_cast<std::size_t>(facets_at_first) * count);
  memory.slot.assign(count, -1);
  memory.feature.resize(count);
  memory.status.assign(count, Status::unpaired);
  memory.gap.assign(count, std::numeric_limits<double>::quiet_NaN());
  memory.stored.assign(count, 0.0);
  memory.apexes_then = Vectors::Zero(3, count);
  memory.base_then = Vectors::Zero(3, static_cast<Eigen::Index>(interface.base_nodes.size()));
  if (interface.friction.coefficient > 0) {
    memory.slip.assign(count, Vec3::Zero());
    memory.tangential_stored.assign(count, 0.0);
  }
  memory.reconnections.assign(count, 0);
}

/// Puts a bonded apex over its point of the base, unless it stands past the border.
bool bond(const Vectors& x, Index a, const Start& start, Interface& interface, Memory& memory) {
  if (start.facet < 0) return false;
  const Index facet = start.stand.feature.facet;
  if (start.stand.past > bond_past_border * std::sqrt(area_vector(interface.base, x, facet).norm())) return false;
  const FeatureHeight over = height_over(interface.base, x, {facet, Kind::facet, 0}, x.col(interface.apexes[a]));
  interface.bonds[a] = {facet, over.weight, over.height};
  memory.feature[a] = {facet, Kind::facet, 0};
  memory.status[a] = Status::open;
  memory.slot[a] = static_cast<Index>(memory.near.size());
  memory.near.push_back({.apex = a, .tracks = {}, .element = {}, .friction = {}});
  return true;
}

/// Remembers the depth of an apex that is the deepest so far. A deep one may stand beside the body that it is pushed out of, or near
/// another of its faces: it is no deeper than the surface is far.
void see_depth(const Interface& interface, const Vectors& x, const Near& near, Memory& memory) {
  double depth = near.element.depth;
  if (depth > depth_to_check * interface.depth) {
    const Nearest nearest = nearest_of(interface, x, near.apex, near_facets(memory, near));
    depth = std::min(depth, interface.contact_height(near.apex) + nearest.distance());
  }
  if (depth > memory.deepest) memory.deepest = depth, memory.deepest_apex = interface.apexes[near.apex];
}

}  // namespace

Workspace::Workspace(const Interface& interface)
    : broad(static_cast<Index>(interface.base.facets.cols())),
      facets(interface.apexes.size(), 0),
      spring_sum(Scalars::Zero(static_cast<Eigen::Index>(interface.base.ring_begin.size()) - 1)),
      rotation_sum(Scalars::Zero(interface.friction.coefficient > 0 && !interface.rotation_of_node.empty() ? spring_sum.size() : 0)) {
  near.reserve(interface.apexes.size());
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

double stiffness(const Interface& interface, Index apex, const Feature& feature, double area) {
  if (interface.spring.size() > 0) return interface.spring(apex);
  if (interface.area_kind == Area::apex) return interface.penalty * area;
  if (feature.kind == Kind::facet) return interface.penalty * interface.facet_area(feature.facet);
  double sum = 0;
  int count = 0;
  const auto add = [&](Index facet) {
    if (facet >= 0) sum += interface.facet_area(facet), ++count;
  };
  if (feature.kind == Kind::edge) {
    add(feature.facet);
    add(interface.base.neighbour(feature.local, feature.facet));
  } else {
    const Index node = interface.base.facets(feature.local, feature.facet);
    for (Index r = interface.base.ring_begin[node]; r < interface.base.ring_begin[node + 1]; ++r) add(interface.base.ring[r]);
  }
  return interface.penalty * sum / count;
}

double least_gap(const Interface& interface, const Vectors& x, const Memory& memory, double reach) {
  double least = std::numeric_limits<double>::quiet_NaN();
  const auto see = [&least](double gap) {
    if (!(gap >= least)) least = gap;
  };
  for (const Near& near : memory.near) {
    if (near.element.closed) see(memory.gap[near.apex]);
    else if (near.facets > 0)
      see(nearest_of(interface, x, near.apex, near_facets(memory, near)).distance() - interface.contact_height(near.apex));
  }
  if (!memory.near.empty()) return least;  // who is not near is farther away
  BroadSearch broad(static_cast<Index>(interface.base.facets.cols()));
  if (!broad.sort(interface.base, x)) return least;
  for (std::size_t a = 0; a < interface.apexes.size(); ++a) {
    const Vector<double> p = position(x, interface.apexes[a]);
    const double height = interface.contact_height(static_cast<Eigen::Index>(a));
    const Index facet = broad.nearest(interface.base, x, p, std::isnan(least) ? reach : least + height);
    if (facet < 0) continue;
    see(std::sqrt(geometry::closest_on_triangle(corners(interface.base, x, facet), p).distance_squared) - height);
  }
  return least;
}

InitialGaps connect(Interface& interface, const Vectors& x, double reach, const ContactHeight& height, InitialPenetration penetration,
                    Memory& memory, Workspace& workspace) {
  const auto count = static_cast<Index>(interface.apexes.size());
  const bool bonded = interface.kind == InterfaceKind::bonded;
  interface.base_nodes.assign(interface.base.facets.data(), interface.base.facets.data() + interface.base.facets.size());
  std::sort(interface.base_nodes.begin(), interface.base_nodes.end());
  interface.base_nodes.erase(std::unique(interface.base_nodes.begin(), interface.base_nodes.end()), interface.base_nodes.end());
  prepare(interface, memory);
  interface.bonds.assign(bonded ? count : 0, Bond{});
  interface.contact_height = Scalars::Constant(count, height.given);
  memory.margin = interface.margin;

  InitialGaps gaps;
  gaps.apexes = count;
  gaps.least = infinite;
  gaps.largest = -infinite;
  std::vector<double> initial(count, std::numeric_limits<double>::quiet_NaN());
  workspace.broad.sort(interface.base, x);
  for (Index a = 0; a < count; ++a) {
    const Start start = start_of(interface, x, a, reach, workspace.broad);
    if (bonded && !bond(x, a, start, interface, memory)) ++gaps.free;
    if (start.facet < 0) {
      ++gaps.without_base;
      continue;
    }
    // past a wall only the distance has a meaning
    const double h = start.stand.past > 0 ? start.distance : start.stand.over.height;
    if (height.from_initial_height) interface.contact_height(a) = h - height.clearance;
    // a height of round-off would be a layer around walls and edges, and none is meant
    const double least_height = 1e-9 * interface.base.longest(start.stand.feature.facet);
    if (std::abs(interface.contact_height(a)) < least_height) interface.contact_height(a) = 0;
    initial[a] = h - interface.contact_height(a);
    if (bonded) memory.gap[a] = initial[a];
    ++gaps.by_kind[static_cast<int>(start.stand.feature.kind)];
  }
  if (!bonded) {
    search(interface, x, memory, workspace);
    memory.recovered = memory.searches = 0;
  }
  const Vectors rest = Vectors::Zero(3, x.cols());
  for (Near& near : memory.near) {
    if (bonded) break;
    const Index a = near.apex, node = interface.apexes[a];
    const double contact_height = interface.contact_height(a);
    const Mat3* allowed = allowed_of(interface, a);
    const Sweep sweep{interface.base, interface.own, x, rest, 0, near_facets(memory, near), node, allowed, contact_height};
    const Nearest nearest = nearest_of(interface, x, a, sweep.near);
    memory.feature[a] = nearest.feature;
    memory.gap[a] = nearest.distance() - contact_height;
    double depth = 0;
    const Index facet = behind(sweep, interface.depth > 0 ? interface.depth : infinite, depth);
    if (facet < 0) continue;
    // positions are no more exact than their distance from the origin allows, and differences no more than the facet's size
    const double round_off = 1e-12 * (std::abs(depth) + 2 * std::abs(contact_height) + interface.base.longest(facet));
    const bool counts = depth > round_off, accepted = !counts || penetration == InitialPenetration::accept;
    near.tracks.begin(facet, accepted ? contact_height - depth : contact_height);
    memory.gap[a] = initial[a] = accepted ? 0 : -depth;
    if (!counts) continue;
    ++gaps.penetrating;
    gaps.deepest = std::max(gaps.deepest, depth);
  }
  for (const double gap : initial) {
    if (std::isnan(gap)) continue;
    gaps.least = std::min(gaps.least, gap);
    gaps.largest = std::max(gaps.largest, gap);
    gaps.mean += gap;
  }
  const Index connected = gaps.apexes - gaps.without_base;
  if (connected == 0) gaps.least = gaps.largest = 0;
  else gaps.mean /= connected;
  return gaps;
}

Memory tried_out(const Interface& interface, const Vectors& x, double reach, Workspace& workspace) {
  Memory trial;
  prepare(interface, trial);
  if (!workspace.broad.sort(interface.base, x)) return trial;
  const auto count = static_cast<Index>(interface.apexes.size());
  for (Index a = 0; a < count; ++a) {
    const Start start = start_of(interface, x, a, reach, workspace.broad);
    const bool bonded = interface.kind == InterfaceKind::bonded;
    if (start.facet < 0 || (bonded && interface.bonds[a].facet < 0)) continue;
    trial.slot[a] = static_cast<Index>(trial.near.size());
    trial.near.push_back({.apex = a, .tracks = {}, .element = {}, .friction = {}});
    Near& near = trial.near.back();
    trial.feature[a] = start.stand.feature;
    if (bonded) hold_bond(interface, x, near, trial);
    else vote_over(interface, x, a, start.stand.feature,
                   weights_of(interface, x, a, start.stand.feature.facet), near.element);
  }
  return trial;
}

void advance(const Interface& interface, const Vectors& x, const Vectors& v, const Vectors& omega, double dt, Memory& memory,
             Workspace& workspace) {
  double moved = 0;
  if (interface.kind == InterfaceKind::contact) {
    moved = memory.searches == 0 ? infinite : moved_since_search(interface, x, memory);
    if (moved > 0.5 * memory.margin) {
      memory.margin = margin_of(interface, v);
      search(interface, x, memory, workspace);
      moved = 0;
    }
  }
  parallel_for(static_cast<Index>(memory.near.size()), 64, [&](Index i) {
    Near& near = memory.near[i];
    if (near.rests && moved < near.clear) return;
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
}

void add_forces(const Interface& interface, const Memory& memory, Vectors& force, Vectors& moment) {
  for (const Near& near : memory.near) {
    const ElementForces& element = near.element;
    if (!element.closed) continue;
    force.col(interface.apexes[near.apex]) += element.scale * element.apex;
    for (int i = 0; i < element.count; ++i) {
      const Vec3 push = element.scale * element.stencil[i].push;
      for_each_node(interface, element.stencil[i], [&](Index node, double weight, double) { force.col(node) -= weight * push; });
    }
  }
  for (const Near& near : memory.near)
    if (near.friction.acts) add_friction(near.friction.touch, near.friction.force, interface.rotation_of_node, force, moment);
}

namespace {

/// The largest squared frequency among the apexes. [1/s2]
struct Fastest {
  double omega_squared = 0;
  Index apex = -1;  // in Interface::apexes
  void see(double value, Index a) {
    if (value > omega_squared) omega_squared = value, apex = a;
  }
};

/// Largest squared frequency of the moments of sticking friction, which turn plate nodes.
Fastest moments_of_friction(const Interface& interface, const Scalars& inertia, const Memory& memory, Workspace& workspace) {
  Fastest fastest;
  if (interface.rotation_of_node.empty()) return fastest;
  Scalars& sum = workspace.rotation_sum;
  const auto arms = [](const FrictionForces& friction, auto&& visit) {  // weights of the turning nodes [m]
    if (!friction.acts) return;
    const Touch& touch = friction.touch;
    if (!touch.apex_arm.isZero(0)) visit(touch.apex, touch.apex_arm.norm());
    for (int I = 0; touch.base_rotates && I < 3; ++I) visit(touch.node[I], touch.weight[I] * touch.base_arm.norm());
  };
  for (const Near& near : memory.near) arms(near.friction, [&](Index node, double) { sum(node) = 0; });
  for (const Near& near : memory.near) arms(near.friction, [&](Index node, double share) { sum(node) += near.friction.stiffness * share; });
  for (const Near& near : memory.near) {
    double omega_squared = 0;
    arms(near.friction, [&](Index node, double share) { omega_squared += share * sum(node) / inertia(interface.rotation_of_node[node]); });
    fastest.see(omega_squared, near.apex);
  }
  return fastest;
}

/// Largest squared frequency of the normal springs between apexes and bases.
Fastest normal_springs(const Interface& interface, const Scalars& mass, const Memory& memory, Workspace& workspace) {
  Scalars& sum = workspace.spring_sum;
  const auto shares = [&](const ElementForces& element, auto&& visit) {
    for (int i = 0; i < element.count; ++i)
      for_each_node(interface, element.stencil[i], [&](Index node, double, double share) {
        if (share > 0) visit(node, share);
      });
  };
  for (const Near& near : memory.near) shares(near.element, [&](Index node, double) { sum(node) = 0; });
  for (const Near& near : memory.near) {
    const double k = near.element.stiffness;
    shares(near.element, [&](Index node, double share) { sum(node) += k * share; });
  }
  Fastest fastest;
  for (const Near& near : memory.near) {
    const ElementForces& element = near.element;
    if (element.count == 0) continue;
    double omega_squared = element.stiffness / mass(interface.apexes[near.apex]);
    shares(element, [&](Index node, double share) { omega_squared += share * sum(node) / mass(node); });
    fastest.see(omega_squared, near.apex);
  }
  return fastest;
}

}  // namespace

StepLimit stable_step(const Interface& interface, const Scalars& mass, const Scalars& inertia, const Memory& memory,
                      Workspace& workspace) {
  const Fastest normal = normal_springs(interface, mass, memory, workspace);
  if (normal.apex < 0) return {};
  const double omega_squared = normal.omega_squared / interface.pass_factor;
  const Index apex = interface.apexes[normal.apex];
  if (interface.kind == InterfaceKind::bonded) return {linear_step / std::sqrt(omega_squared), apex};
  const StepLimit bounce{interface.impact_step_factor / std::sqrt(omega_squared), apex};
  if (memory.slip.empty()) return bounce;
  // sticks are parallel to the normal springs, and their moments turn plate nodes besides
  const Fastest turning = moments_of_friction(interface, inertia, memory, workspace);
  const double most = interface.friction.tangential_penalty * omega_squared + turning.omega_squared / interface.pass_factor;
  const StepLimit stick{linear_step / std::sqrt(most), turning.apex >= 0 ? interface.apexes[turning.apex] : apex};
  return stick.step < bounce.step ? stick : bounce;
}

Source source(const Interface& interface) {
  const bool has_friction = interface.friction.coefficient > 0;
  return {interface.name, SourceKind::interface,
          has_friction ? std::vector{Stored::penalty, Stored::tangential_penalty} : std::vector{Stored::penalty},
          has_friction ? std::vector{Dissipated::damping, Dissipated::friction} : std::vector{Dissipated::damping}};
}

void post(const Interface&, const Memory& memory, Account& account) {
  account.work = memory.work;
  account.hold(Stored::penalty, stored(memory));
  account.hold(Stored::tangential_penalty, tangential_stored(memory));
  account.dissipated[Dissipated::damping] = memory.damped;
  account.dissipated[Dissipated::friction] = memory.friction_dissipated;
  account.created_by_reconnection = memory.created_by_reconnection;
  account.angular_impulse = memory.angular_impulse;
}

ElementView view(const Interface& interface, const Vectors& x, const Memory& memory, Index apex) {
  ElementView v{.apex = interface.apexes[apex], .feature = memory.feature[apex], .weight = {0, 0, 0}, .gap = memory.gap[apex],
                .traction = 0, .shear_traction = 0, .slides = false, .status = memory.status[apex],
                .reconnections = memory.reconnections[apex]};
  const Near* near = contact::near(memory, apex);
  if (v.status == Status::open && near && near->facets > 0 && near->tracks.count == 0) {  // where it stands now, not when last looked at
    const Nearest nearest = nearest_of(interface, x, apex, near_facets(memory, *near));
    v.feature = nearest.feature;
    v.gap = nearest.distance() - interface.contact_height(apex);
  }
  if (v.feature.facet >= 0) {
    const auto c = corners(interface.base, x, v.feature.facet);
    v.weight = geometry::closest_on_triangle(c, position(x, v.apex)).weight;
  }
  if (v.status != Status::closed) return v;
  const double per_area = interface.spring.size() > 0 ? interface.spring(apex) / interface.area(apex) : interface.penalty;
  v.traction = -per_area * v.gap;
  if (interface.kind == InterfaceKind::bonded) {
    const double k = stiffness(interface, apex, v.feature, interface.area(apex)), along = k * v.gap;
    const double all = 2 * k * memory.stored[apex];  // |k d|^2
    v.shear_traction = per_area / k * std::sqrt(std::max(0.0, all - along * along));
  } else if (!memory.slip.empty()) {
    v.shear_traction = interface.friction.tangential_penalty * per_area * memory.slip[apex].norm();
    v.slides = v.shear_traction >= (1 - 1e-9) * interface.friction.coefficient * v.traction;  // round-off
  }
  return v;
}

}  // namespace nereid::contact
