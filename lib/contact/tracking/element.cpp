#include "contact/tracking/element.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "contact/search/near.hpp"
#include "contact/surface/foot.hpp"
#include "contact/tracking/tracking.hpp"
#include "contact/tracking/shortest_exit.hpp"

namespace nereid::contact {

namespace {

using geometry::Kind;

constexpr double limits_within = 0.25;   // of the depth of an element: open apexes that are nearer limit the step
constexpr double least_area = 0.2;      // of the tributary area: with less of it facing, the surface of the apex stands edge-on
constexpr double most_sag = 0.055;      // of the size of a face: the sag of a base that turns by 25 degrees from face to face
constexpr double in_plane = 1e-6;       // of a distance: a node that lies in a symmetry plane

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

/// The tributary area of the sides of an apex that a facet loads. [m2]
double area_facing(const Interface& interface, const Vectors& x, Index a, Index facet) {
  return mesh::tributary_area_loaded(interface.faces, x, a, facet_normal(interface.base, x, facet), interface.area(a), least_area);
}

/// Lets the nodes around the foot take the moment of the base. Which face has a foot on its border is a matter of round-off, or of numbers,
/// so faces that meet there share the moment.
void turn_nodes_around(const BaseSurface& base, const Vectors& x, Index facet, Touch& touch) {
  const NodesAround around = nodes_around(base, x, x.col(touch.apex) - touch.arm, facet);
  static_assert(NodesAround::most <= std::tuple_size_v<decltype(Touch::node)>);
  std::array<Vec3, NodesAround::most> place;
  for (int I = 0; I < around.count; ++I) place[I] = x.col(around.node[I]);
  touch.nodes = around.count, touch.node = around.node;
  measure_base({place.data(), static_cast<std::size_t>(around.count)}, around.weight, touch);
}

}  // namespace

double power(const Interface& interface, std::span<const Share> shares, const Vectors& v, Index a, const ElementForces& element) {
  if (!element.closed) return 0;
  double sum = 0;
  for (int i = 0; i < element.count; ++i) {
    for_each_force(interface, shares, a, element.stencil[i], [&](Index node, const Vec3& force) { sum += force.dot(v.col(node)); });
  }
  return sum;
}

Vec3 moment(const Interface& interface, std::span<const Share> shares, const Vectors& x, const Vectors& v, double later, Index a,
            const ElementForces& element) {
  Vec3 sum = Vec3::Zero();
  if (!element.closed || (interface.allowed.empty() && !element.has_moment)) return sum;
  const auto place = [&](Index node) { return Vec3(x.col(node) + later * v.col(node)); };
  for (int i = 0; i < element.count; ++i) {
    for_each_force(interface, shares, a, element.stencil[i], [&](Index node, const Vec3& force) { sum += place(node).cross(force); });
  }
  return element.scale * sum;
}

Touch touch_of(const Interface& interface, const Vectors& x, Index a, const Feature& feature, const Vec3& normal, const Stencil* foot) {
  Touch touch;
  touch.normal = normal;
  touch.apex = interface.apexes[a];
  const auto c = corners(interface.base, x, feature.facet);
  const Vec3 at = x.col(touch.apex);
  for (int I = 0; I < 3; ++I) touch.node[I] = interface.base.facets(I, feature.facet);
  if (interface.weights == Weights::paper) {
    const FeatureNodes base = nodes_of(interface.base, feature);
    for (int I = 0; I < 3; ++I)
      for (int b = 0; b < base.count; ++b)
        if (base.node[b] == touch.node[I]) touch.weight[I] = 1.0 / base.count;
    return touch;
  }
  const std::array<double, 3> weight = foot ? foot->weight : geometry::closest_on_triangle(c, {at.x(), at.y(), at.z()}).weight;
  std::copy(weight.begin(), weight.end(), touch.weight.begin());
  if (foot && foot->fourth != 0) touch.nodes = 4, touch.node[3] = interface.base.half[feature.facet].fourth, touch.weight[3] = foot->fourth;
  touch.arm = at;
  for (int I = 0; I < touch.nodes; ++I) touch.arm -= touch.weight[I] * x.col(touch.node[I]);
  touch.apex_arm = between(interface, a, feature.facet).arm_of_apex * touch.arm;
  touch.base_arm = touch.arm - touch.apex_arm;
  touch.base_rotates = !interface.rotation_of_node.empty() && interface.rotation_of_node[touch.node[0]] >= 0;
  if (!touch.base_rotates && !touch.base_arm.isZero(0)) turn_nodes_around(interface.base, x, feature.facet, touch);
  return touch;
}

double speed_over(const Interface& interface, const Vectors& v, Index a, const Feature& feature) {
  const FeatureNodes base = nodes_of(interface.base, feature);
  double fastest = 0;
  for (int b = 0; b < base.count; ++b) fastest = std::max(fastest, (v.col(interface.apexes[a]) - v.col(base.node[b])).squaredNorm());
  return std::sqrt(fastest);
}

std::array<double, 3> weights_of(const Interface& interface, const Vectors& x, Index a, Index facet) {
  return geometry::closest_on_triangle(corners(interface.base, x, facet), position(x, interface.apexes[a])).weight;
}

double stiffness(const Interface& interface, Index a, const Feature& feature, double area) {
  const double penalty = between(interface, a, feature.facet).penalty;
  if (interface.area_kind == Area::apex) return penalty * area;
  if (feature.kind == Kind::facet) return penalty * interface.facet_area(feature.facet);
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
  return penalty * sum / count;
}

void vote_over(const Interface& interface, const Vectors& x, Index a, const Feature& feature, const std::array<double, 3>& weight,
               double level, ElementForces& element) {
  element.count = 1;
  element.stencil[0] = {.facet = feature.facet, .apex = 1, .weight = weight, .push = Vec3::Zero(),
                        .kind = feature.kind, .local = feature.local, .level = level};
  if (by_multipliers(interface)) return;  // they limit no step
  element.stiffness = stiffness(interface, a, feature, interface.area(a));
  share_stiffness(interface, x, a, element);
}

void hold_tie(const Interface& interface, const Vectors& x, Near& near, Memory& memory) {
  const Index a = near.apex;
  ElementForces& element = near.element;
  const Tie& tie = interface.ties[a];
  const Vec3 corner[3] = {x.col(interface.base.facets(0, tie.facet)), x.col(interface.base.facets(1, tie.facet)),
                          x.col(interface.base.facets(2, tie.facet))};
  const Vec3 area = area_vector(interface.base, x, tie.facet);
  const double twice_area = area.norm();
  const Vec3 n = area / twice_area;
  Vec3 d = x.col(interface.apexes[a]) - tie.height * n;
  for (int I = 0; I < 3; ++I) d -= tie.weight[I] * corner[I];
  const double k = stiffness(interface, a, memory.feature[a], interface.area(a));
  Stencil hold{.facet = tie.facet, .apex = 1, .push = -k * d}, couple{.facet = tie.facet, .apex = 0};
  couple.push = k * tie.height * n;
  for (int I = 0; I < 3; ++I) {
    const Vec3 gradient = n.cross(corner[(I + 2) % 3] - corner[(I + 1) % 3]) / twice_area;
    couple.weight[I] = d.dot(gradient);
    hold.weight[I] = tie.weight[I];
    hold.share[I] = std::abs(tie.weight[I]) + std::abs(tie.height) * gradient.norm();
  }
  element.closed = true;
  element.penalty = element.stiffness = k;
  element.apex = hold.push;
  element.stencil[0] = hold;
  element.stencil[1] = couple;
  element.count = tie.height != 0 ? 2 : 1;
  memory.status[a] = Status::closed;
  memory.gap[a] = d.dot(n);
  memory.stored[a] = 0.5 * k * d.squaredNorm();
}

namespace {

/// The gap up to which an apex in contact with nothing is looked at in each step. [m]
///
/// A penalty has to know how fast it closes. Faces of an apex may lie on a base that the apex itself stands beside; where it is over a
/// facet, they are no nearer than what bends between them.
double soon_of(const Interface& interface, Index a, const Feature& feature, double speed) {
  const Between& pair = between(interface, a, feature.facet);
  const double way = speed * interface.longest_step;
  if (!by_multipliers(interface)) return std::max(limits_within * pair.depth, steps_ahead * way);
  if (pair.heights != Heights::points) return std::max(multipliers_reach * pair.depth, steps_to_touch * way);
  const double bends = most_sag * interface.base.size(feature.facet) + multipliers_reach * pair.depth;
  return std::max(feature.kind == Kind::facet ? bends : limits_within * pair.depth, steps_to_touch * way);
}

/// An apex that is in contact with nothing: how far it is, whether it limits the step, and how long it need not be looked at.
void look_around(const Interface& interface, const Vectors& x, const Vectors& v, Moved moved, Near& near, Memory& memory) {
  const Index a = near.apex;
  const Nearest nearest = nearest_of(interface, x, a, near_facets(memory, near));
  near.safe_distance = infinite;  // until the next search
  memory.feature[a] = nearest.feature;
  memory.status[a] = nearest.feature.facet < 0 ? Status::unpaired : Status::open;
  memory.gap[a] = std::numeric_limits<double>::quiet_NaN();
  if (nearest.feature.facet < 0) return;
  const Index facet = nearest.feature.facet;
  const double contact_height = contact::contact_height(interface, memory, a), level = contact::level(interface, memory, a, facet);
  memory.gap[a] = nearest.distance() - level;
  double soon = infinite, speed = 0;
  const double depth = between(interface, a, facet).depth;
  if (depth > 0) {
    speed = speed_over(interface, v, a, nearest.feature);
    soon = soon_of(interface, a, nearest.feature, speed);
  }
  const bool limits = memory.gap[a] <= soon;
  near.safe_distance = moved.until(nearest.safe_distance - contact_height - (limits ? 0 : soon));
  if (!limits) return;
  vote_over(interface, x, a, nearest.feature, nearest.closest.weight, level, near.element);
  if (!(speed > 0) || by_multipliers(interface)) return;
  near.element.closes_in = std::max(0.0, memory.gap[a]) / speed;
  near.safe_distance = -infinite;  // speeds change, and this one lets the step be long
}

/// Finds what an apex is in contact with, and its forces.
void update_element(const Interface& interface, const Vectors& x, const Vectors& v, double dt, Moved moved, Near& near, Memory& memory) {
  const Index a = near.apex;
  const double contact_height = contact::contact_height(interface, memory, a);
  const Mat3* allowed = allowed_of(interface, a);
  const Index node = interface.apexes[a];
  const ApexPath path{interface.base, interface.own, x, v, dt, near_facets(memory, near), node, allowed, contact_height,
                      most_behind(interface)};
  const Tracks before = near.tracks;
  if (before.count == 0 && dt > 0) enter(path, memory.deepest_now, near.tracks);
  if (before.count == 0 && !(dt > 0)) {  // at the start, displaced from the reference
    double depth = 0;
    const Index facet = behind(path, interface.depth > 0 ? interface.depth : infinite, depth);
    if (facet >= 0) near.tracks.begin(facet, path.level(facet));
  }
  if (near.tracks.count == 0) return look_around(interface, x, v, moved, near, memory);
  if (before.count == 0) near.safe_distance = -infinite;
  if (before.count == 0 || !(near.area > 0)) {  // it keeps it while it is in contact: a stiffness that changes makes energy
    // multipliers set their own
    near.area = interface.method == Method::multiplier ? 0 : area_facing(interface, x, a, near.tracks.track[0].facet);
  }

  const double release_height = between(interface, a, near.tracks.track[0].facet).release_height;
  const auto find_exit = [&] {
    return shortest_exit(interface.base, x, x.col(node), contact_height, allowed, moved, near.tracks, near.element.stencil, release_height,
                         node);
  };
  Exit out = find_exit();
  if (moved.now + out.length >= near.safe_distance) {
    const Track other = other_part(path, before, near.tracks, memory.deepest_now);
    if (other.facet >= 0) {
      const int lost = out.lost;
      near.tracks.begin(other.facet, other.height);
      out = find_exit();
      out.lost += lost;
    }
    near.safe_distance = other.facet >= 0 ? -infinite : moved.until(nearest_other_part(path, near.tracks) - out.length - contact_height);
  }
  ElementForces& element = near.element;
  element.lost = out.lost;
  if (near.tracks.count == 0) near.safe_distance = -infinite;
  if (out.count == 0) {
    if (near.tracks.count == 0) return look_around(interface, x, v, moved, near, memory);
    memory.status[a] = Status::open;
    memory.feature[a] = out.strongest;
    memory.gap[a] = std::max(0.0, out.gap);
    const bool limits = !by_multipliers(interface);
    const auto weight = limits ? weights_of(interface, x, a, out.strongest.facet) : std::array<double, 3>{};
    return vote_over(interface, x, a, out.strongest, weight, out.level, element);
  }
  const double k = stiffness(interface, a, out.strongest, near.area > 0 ? near.area : interface.area(a));
  memory.status[a] = Status::closed;
  memory.feature[a] = out.strongest;
  memory.gap[a] = -out.length;
  memory.stored[a] = 0.5 * k * out.squared;
  element.closed = true;
  element.has_moment = out.has_moment;
  element.penalty = k;
  element.stiffness = k * out.steepest;
  element.depth = out.depth;
  element.count = out.count;
  for (int i = 0; i < out.count; ++i) {
    Stencil& stencil = element.stencil[i];
    stencil.push *= k;
    element.apex += stencil.apex * stencil.push;
  }
  if (!by_multipliers(interface)) share_stiffness(interface, x, a, element);
}

}  // namespace

void find_contact(const Interface& interface, const Vectors& x, const Vectors& v, double dt, Moved moved, Near& near, Memory& memory) {
  ElementForces& element = near.element;
  element.closed = element.has_moment = false;
  element.depth = element.closes_in = 0;
  element.lost = 0;
  element.apex.setZero();
  element.count = 0;
  memory.stored[near.apex] = 0;
  if (interface.kind == InterfaceKind::tied) hold_tie(interface, x, near, memory);
  else update_element(interface, x, v, dt, moved, near, memory);
}

void sum_force(double dt, Memory& memory) {
  const Vec3 before = memory.force;
  memory.force.setZero();
  for (const Near& near : memory.near) {
    if (near.element.closed) memory.force += near.element.scale * near.element.apex;
    if (near.friction->acts) memory.force += near.friction->force;
  }
  memory.impulse += 0.5 * dt * (before + memory.force);
}

}  // namespace nereid::contact
