#include "contact/contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.hpp"
#include "contact/active_features.hpp"
#include "geometry/height.hpp"

namespace nereid::contact {

namespace {

using geometry::Closest;
using geometry::Kind;

constexpr double near_contact = 1.25;   // of h_c: from here on all active features of an apex are looked at
constexpr double tie = 1e-3;            // of the height: on the flanks of a valley the element in use stays so long
constexpr double really_closer = 1e-6;  // relative distance by which a search must beat the walk
constexpr int most_rounds = 60;         // in which feet over edges are found; few need more than six
constexpr double votes_within = 0.25;   // of the depth of an element: open apexes that are nearer vote for the step
constexpr double steps_ahead = 2;       // and those that may be in contact after so many of the longest steps

/// Directions that an apex on a symmetry plane may go; null for the others.
const Mat3* allowed_of(const Interface& interface, Index a) {
  return interface.allowed.empty() || interface.allowed[a].isIdentity(0) ? nullptr : &interface.allowed[a];
}

bool same(const Feature& a, const Feature& b) {
  return a.facet == b.facet && a.kind == b.kind && (a.kind == Kind::facet || a.local == b.local);
}

/// Pushes an apex out of its active features, and distributes the force over their nodes.
///
/// returns  the energy stored [J]; gap becomes minus the length of the penetration vector
double project_out(const Interface& interface, const Vectors& x, Index a, double contact_height, ActiveFeatures& active,
                   ElementForces& forces, double& gap) {
  const Vector<double> p = position(x, interface.apexes[a]);
  Contacts contacts;
  contacts.count = active.count;
  const auto set = [&](int i, const Vec3& way) {  // contact i, seen from the end of the vector so far
    contacts.normal[i] = active.at[i].normal;
    if (!interface.allowed.empty()) contacts.normal[i] = interface.allowed[a] * contacts.normal[i];
    contacts.depth[i] = contact_height - active.at[i].height + contacts.normal[i].dot(way);
  };
  bool curved = false;  // heights over edges and vertices are not linear in the vector
  for (int i = 0; i < active.count; ++i) {
    set(i, Vec3::Zero());
    curved = curved || active.feature[i].kind != Kind::facet;
  }
  auto lambda = projection_multipliers(contacts);
  const auto penetration_vector = [&] {
    Vec3 way = Vec3::Zero();
    for (int i = 0; i < active.count; ++i) way += lambda[i] * contacts.normal[i];
    return way;
  };
  Vec3 d = penetration_vector();
  if (d.isZero(0)) return 0;
  // The foot of every force is that of the point at the end of the vector, so that the potential has
  // the forces as its gradient and their moments cancel. For one contact that foot is the apex's own,
  // unless a symmetry plane turns the vector; for facets one look is exact.
  const bool foot_moves = active.count > 1 || !interface.allowed.empty();
  for (int round = 0; foot_moves && round < most_rounds; ++round) {
    const Vector<double> end{p.x + d.x(), p.y + d.y(), p.z + d.z()};
    for (int i = 0; i < active.count; ++i) {
      if (!curved && !(lambda[i] > 0)) continue;
      const FeatureHeight there = height_over(interface.base, x, active.feature[i], end);
      // with h_c = 0 the vector ends on the edge or vertex itself, which has no normal: its own stays, and the foot is there
      if (!(std::abs(there.height) > 1e-6 * d.norm()) && active.feature[i].kind != Kind::facet) {
        active.at[i].weight = there.weight;
        continue;
      }
      active.at[i] = there;
      if (curved) set(i, d);
    }
    if (!curved) break;
    lambda = projection_multipliers(contacts);
    const Vec3 next = penetration_vector();
    const bool converged = (next - d).squaredNorm() <= 1e-28 * d.squaredNorm();
    d = next;
    if (converged) break;
  }
  int strongest = 0;
  for (int i = 1; i < active.count; ++i)
    if (lambda[i] > lambda[strongest]) strongest = i;
  const double k = stiffness(interface, a, active.feature[strongest]);
  const double length = d.norm();
  forces.closed = true;
  forces.has_moment = curved && active.count > 1;
  forces.stiffness = k;
  for (int i = 0; i < active.count; ++i) {
    if (!(lambda[i] > 0)) continue;
    const Vec3 push = k * lambda[i] * active.at[i].normal;
    forces.apex += push;
    const FeatureNodes base = nodes_of(interface.base, active.feature[i]);
    for (int b = 0; b < base.count; ++b) {
      const double weight = active.at[i].weight[b];
      forces.node[forces.count] = base.node[b];
      forces.weight[forces.count] = std::abs(weight);
      forces.force[forces.count++] = -weight * push;
    }
  }
  gap = -length;
  return 0.5 * k * length * length;
}

/// Weights of the bases of an apex that is not in contact: of all active features.
void weigh_bases(const Interface& interface, Index a, const Feature& feature, const ActiveFeatures& active, ElementForces& forces) {
  forces.stiffness = stiffness(interface, a, feature);
  for (int i = 0; i < active.count; ++i) {
    const FeatureNodes base = nodes_of(interface.base, active.feature[i]);
    for (int b = 0; b < base.count; ++b) {
      forces.node[forces.count] = base.node[b];
      forces.weight[forces.count++] = std::abs(active.at[i].weight[b]);
    }
  }
}

/// A node of several active features counts once, by its largest weight: its facets push as one. To a node
/// off the symmetry plane of the apex comes the same from the image of its facet.
void weigh_once(const Interface& interface, const Vectors& x, Index a, ElementForces& forces) {
  if (const Mat3* allowed = allowed_of(interface, a)) {
    for (int i = 0; i < forces.count; ++i) {
      const Vec3 away = x.col(forces.node[i]) - x.col(interface.apexes[a]);
      if ((away - *allowed * away).norm() > border_tolerance * away.norm()) forces.weight[i] *= 2;
    }
  }
  for (int i = 0; i < forces.count; ++i) {
    for (int j = 0; j < i; ++j) {
      if (forces.node[j] != forces.node[i]) continue;
      forces.weight[j] = std::max(forces.weight[j], forces.weight[i]);
      forces.weight[i] = 0;
      break;
    }
  }
}

/// Power of the forces of one apex at scale 1. [W]
double power(const Interface& interface, const Vectors& v, Index a, const ElementForces& forces) {
  if (!forces.closed) return 0;
  double p = forces.apex.dot(v.col(interface.apexes[a]));
  for (int i = 0; i < forces.count; ++i) p += forces.force[i].dot(v.col(forces.node[i]));
  return p;
}

/// Moment about the origin of the normal forces of one apex, at the positions `later` [s] after x. Without symmetry planes and over
/// facets alone there is none, and it is not computed.
Vec3 moment(const Interface& interface, const Vectors& x, const Vectors& v, double later, Index a,
            const ElementForces& forces) {
  Vec3 sum = Vec3::Zero();
  if (!forces.closed || (interface.allowed.empty() && !forces.has_moment)) return sum;
  const auto add = [&](Index node, const Vec3& force) {
    const Vec3 at = x.col(node) + later * v.col(node);
    sum += at.cross(force);
  };
  add(interface.apexes[a], forces.apex);
  for (int i = 0; i < forces.count; ++i) add(forces.node[i], forces.force[i]);
  return forces.scale * sum;
}

/// How fast an apex moves against its base: no slower than against the foot. [m/s]
double speed_over(const Interface& interface, const Vectors& v, Index a, const Feature& feature) {
  double fastest = 0;
  for (int I = 0; I < 3; ++I)
    fastest = std::max(fastest, (v.col(interface.apexes[a]) - v.col(interface.base.facets(I, feature.facet))).squaredNorm());
  return std::sqrt(fastest);
}

/// How an apex that was not in contact may come to stand behind its base.
enum class Entry {
  through,   ///< through the surface: no deeper than it moved
  sideways,  ///< in from under a border, about as deep as its neighbours are: with an offset, so that nothing springs
  none,      ///< behind the surface, as under a table top: it has not touched it
};
Entry entry(double depth, double way, double size, double deepest) {
  constexpr double like_neighbours = 2;  // [-] times the deepest contact of the step before
  if (depth <= (1 + 1e-6) * way + 1e-12 * size) return Entry::through;
  return depth <= like_neighbours * deepest ? Entry::sideways : Entry::none;
}

/// Leaves an apex alone until a search finds it near its base again.
void unpair(Index a, Memory& memory) {
  memory.feature[a].facet = -1;
  memory.status[a] = Status::unpaired;
  memory.gap[a] = std::numeric_limits<double>::quiet_NaN();
  memory.offset[a] = 0;
}

/// Finds the element of an apex at the new positions and its force; false if its walk did not end.
bool update_element(const Interface& interface, const Vectors& x, const Vectors& v, double dt, Index a, const Feature& before,
                    Memory& memory, ElementForces& forces) {
  const Vector<double> p = position(x, interface.apexes[a]);
  const WalkEnd end = walk(interface.base, x, p, before.facet);
  if (end.feature.facet < 0) return false;
  const double distance = std::sqrt(end.closest.distance_squared);
  const bool was_closed = memory.status[a] == Status::closed;
  const double contact_height = interface.contact_height(a);
  if (!was_closed && distance > contact_height + 2 * memory.margin) {
    unpair(a, memory);
    return true;
  }
  const double speed = speed_over(interface, v, a, end.feature);
  memory.feature[a] = end.feature;
  memory.gap[a] = distance - contact_height;
  ActiveFeatures active;
  // Behind the surface the distance is no height; there and near contact, look for all active features. Who is outside of the
  // closest edge or vertex is outside of the surface, and no facet acts that it stands behind.
  const auto height = [&] { return height_over(interface.base, x, end.feature, p).height; };
  if (distance < near_contact * contact_height || height() < contact_height) {
    active = active_features_on(interface.base, x, p, end, std::max(distance, contact_height), allowed_of(interface, a));
    if (active.count == 0) {
      memory.status[a] = Status::off_surface;
      return true;
    }
    // the lowest takes over; of flanks as near as each other the one in use stays
    double least = std::numeric_limits<double>::infinity(), in_use = least;
    for (int i = 0; i < active.count; ++i) {
      const double h = active.at[i].height;
      if (same(active.feature[i], before)) in_use = h;
      if (h < least) least = h, memory.feature[a] = active.feature[i];
    }
    if (in_use <= least + tie * (std::abs(least) + contact_height)) memory.feature[a] = before;
    const double depth = contact_height - least;
    if (dt > 0 && !was_closed && depth > memory.offset[a]) {
      const Entry way_in = entry(depth - memory.offset[a], dt * speed, distance + interface.depth, memory.deepest_now);
      if (way_in == Entry::none) {
        memory.status[a] = Status::off_surface;
        memory.gap[a] = -depth;
        forces.overlap = depth;
        return true;
      }
      if (way_in == Entry::sideways) memory.offset[a] = depth;
    }
    memory.offset[a] = std::min(memory.offset[a], std::max(0.0, depth));
    const double height_now = contact_height - memory.offset[a];
    memory.gap[a] = least - height_now;
    memory.stored[a] = project_out(interface, x, a, height_now, active, forces, memory.gap[a]);
  } else {
    const bool left = end.closest.kind != Kind::facet && on_border(interface.base, end.feature.facet, end.closest) &&
                      past_border(interface.base, x, end.feature.facet, end.closest, p, allowed_of(interface, a), true);
    memory.status[a] = left ? Status::off_surface : Status::open;
    if (left) return true;
    memory.offset[a] = 0;
    active.add(end.feature, height_over(interface.base, x, end.feature, p));
  }
  memory.status[a] = forces.closed ? Status::closed : Status::open;
  if (!forces.closed) {
    const double soon = std::max(votes_within * interface.depth, steps_ahead * speed * interface.longest_step);
    if (interface.depth > 0 && memory.gap[a] > soon) return true;
    weigh_bases(interface, a, memory.feature[a], active, forces);
  }
  weigh_once(interface, x, a, forces);
  return true;
}

/// Pulls or pushes a bonded apex back over its point of the base.
///
/// With d = x_apex - sum of w_I x_I - h n the potential is 1/2 k d.d, and with G_I the gradients of the
/// facet's shape functions  dn = - sum of (n . dx_I) G_I,  so the forces are exactly its gradient:
///     apex  -k d,     base nodes  k (w_I d - h (d . G_I) n)
bool hold_bond(const Interface& interface, const Vectors& x, Index a, Memory& memory, ElementForces& forces) {
  const Bond& bond = interface.bonds[a];
  if (bond.facet < 0) return false;
  const Vec3 corner[3] = {x.col(interface.base.facets(0, bond.facet)), x.col(interface.base.facets(1, bond.facet)),
                          x.col(interface.base.facets(2, bond.facet))};
  const Vec3 area = (corner[1] - corner[0]).cross(corner[2] - corner[0]);  // twice, along the normal
  const double twice_area = area.norm();
  const Vec3 n = area / twice_area;
  Vec3 d = x.col(interface.apexes[a]) - bond.height * n;
  for (int I = 0; I < 3; ++I) d -= bond.weight[I] * corner[I];
  const double k = stiffness(interface, a, memory.feature[a]);
  forces.closed = true;
  forces.stiffness = k;
  forces.apex = -k * d;
  forces.count = 3;
  for (int I = 0; I < 3; ++I) {
    const Vec3 gradient = n.cross(corner[(I + 2) % 3] - corner[(I + 1) % 3]) / twice_area;
    forces.node[I] = interface.base.facets(I, bond.facet);
    forces.force[I] = k * (bond.weight[I] * d - bond.height * d.dot(gradient) * n);
    forces.weight[I] = std::abs(bond.weight[I]) + std::abs(bond.height) * gradient.norm();
  }
  memory.status[a] = Status::closed;
  memory.gap[a] = d.dot(n);
  memory.stored[a] = 0.5 * k * d.squaredNorm();
  return true;
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
void advance_friction(const Interface& interface, const Vectors& x, const Vectors& v, const Vectors& omega, double dt, Index a,
                      const ElementForces& element, Memory& memory, FrictionForces& friction, Vec3& angular_impulse) {
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
void advance_apex(const Interface& interface, const Vectors& x, const Vectors& v, double dt, Index a, Memory& memory,
                  ElementForces& forces) {
  const double power_before = power(interface, v, a, forces), scale_before = forces.scale;
  forces.angular_impulse = 0.5 * dt * moment(interface, x, v, -dt, a, forces);
  const double stored_before = memory.stored[a];
  const Feature before = memory.feature[a];
  forces.closed = forces.has_moment = false;
  forces.overlap = 0;
  forces.apex.setZero();
  forces.count = 0;
  forces.moved = false;
  memory.stored[a] = 0;
  const bool found_anew = std::exchange(forces.found_anew, false);
  if (before.facet >= 0) {
    const bool found = interface.kind == InterfaceKind::bonded ? hold_bond(interface, x, a, memory, forces)
                                                               : update_element(interface, x, v, dt, a, before, memory, forces);
    if (found) {
      forces.moved = memory.feature[a].facet >= 0 && (found_anew || !same(memory.feature[a], before));
    } else {
      forces.moved = true;
      unpair(a, memory);
    }
  }
  const double power_after = power(interface, v, a, forces);
  // the power of the elastic force is  -k |d| d|d|/dt = -2 stored d|d|/dt / |d|
  forces.scale = 1;
  if (memory.stored[a] > 0 && interface.damping_time > 0)
    forces.scale = std::max(0.0, 1 - 0.5 * interface.damping_time * power_after / memory.stored[a]);
  forces.angular_impulse += 0.5 * dt * moment(interface, x, v, 0, a, forces);
  forces.work = 0.5 * dt * (scale_before * power_before + forces.scale * power_after);
  forces.dissipated = 0.5 * dt * ((1 - scale_before) * power_before + (1 - forces.scale) * power_after);
  forces.created = forces.work + forces.dissipated + memory.stored[a] - stored_before;
}

bool share_a_node(const BaseSurface& base, Index f, Index g) {
  for (int a = 0; a < 3; ++a)
    if ((base.facets.col(g).array() == base.facets(a, f)).any()) return true;
  return false;
}

/// The largest squared distance of nodes from where they were, less a common way. [m2]
double farthest_moved(const Subset& nodes, const Vectors& x, const Vectors& then, const Vec3& common) {
  double most = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    most = std::max(most, (x.col(nodes[i]) - then.col(static_cast<Eigen::Index>(i)) - common).squaredNorm());
  return most;
}

/// Whether apexes and base have moved so far against each other that an apex beyond the margin may be near.
bool search_is_due(const Interface& interface, const Vectors& x, const Memory& memory) {
  Vec3 common = Vec3::Zero();
  for (std::size_t i = 0; i < interface.base_nodes.size(); ++i)
    common += x.col(interface.base_nodes[i]) - memory.base_then.col(static_cast<Eigen::Index>(i));
  common /= static_cast<double>(interface.base_nodes.size());
  const double moved = std::sqrt(farthest_moved(interface.apexes, x, memory.apexes_then, common)) +
                       std::sqrt(farthest_moved(interface.base_nodes, x, memory.base_then, common));
  return moved > 0.5 * memory.margin;
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

/// Looks for the bases of apexes that have none, or a farther one than they could have. An apex that has a base takes another one only
/// if it stands in front of it: what it stands behind, such as the far side of a thin body, it did not come through.
///
/// All stay as they are where the base surface has positions that are not finite or beyond farthest_place, and an apex
/// that is itself there stays as it is: the elements say so at this very state, and the run ends.
///
/// reach(a)  [m] how far apex a looks
template <class Reach>
void search(const Interface& interface, const Vectors& x, const Reach& reach, Memory& memory, Workspace& workspace) {
  if (!workspace.broad.sort(interface.base, x)) return;
  keep_positions(interface.apexes, x, memory.apexes_then);
  keep_positions(interface.base_nodes, x, memory.base_then);
  ++memory.searches;
  const auto count = static_cast<Index>(interface.apexes.size());
  Subset& found = workspace.found;
  parallel_for(count, 64, [&](Index a) {
    found[a] = -1;
    const Vector<double> p = position(x, interface.apexes[a]);
    const Index facet = workspace.broad.nearest(interface.base, x, p, reach(a));
    if (facet < 0) return;
    if (memory.feature[a].facet >= 0) {
      if (share_a_node(interface.base, facet, memory.feature[a].facet)) return;  // the walk knows of it
      const auto mine = geometry::closest_on_triangle(corners(interface.base, x, memory.feature[a].facet), p);
      const auto theirs = geometry::closest_on_triangle(corners(interface.base, x, facet), p);
      if (std::sqrt(theirs.distance_squared) > (1 - really_closer) * std::sqrt(mine.distance_squared)) return;
      if (height_over(interface.base, x, {facet, theirs.kind, theirs.local}, p).height < 0) return;
    }
    found[a] = facet;
  });
  for (Index a = 0; a < count; ++a) {
    if (found[a] < 0) continue;
    memory.feature[a] = {found[a], Kind::facet, 0};
    if (memory.status[a] == Status::unpaired) memory.status[a] = Status::open;
    memory.elements[a].found_anew = true;
    ++memory.recovered;
  }
}

}  // namespace

Workspace::Workspace(const Interface& interface)
    : broad(static_cast<Index>(interface.base.facets.cols())),
      found(interface.apexes.size(), -1),
      spring_sum(Scalars::Zero(static_cast<Eigen::Index>(interface.base.ring_begin.size()) - 1)),
      rotation_sum(Scalars::Zero(interface.friction.coefficient > 0 && !interface.rotation_of_node.empty() ? spring_sum.size() : 0)) {}

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

double stiffness(const Interface& interface, Index apex, const Feature& feature) {
  if (interface.spring.size() > 0) return interface.spring(apex);
  if (interface.area_kind == Area::apex) return interface.penalty * interface.area(apex);
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

double least_gap(const Interface& interface, const Vectors& x, double reach) {
  BroadSearch broad(static_cast<Index>(interface.base.facets.cols()));
  double least = std::numeric_limits<double>::quiet_NaN();
  if (!broad.sort(interface.base, x)) return least;
  for (std::size_t a = 0; a < interface.apexes.size(); ++a) {
    const Vector<double> p = position(x, interface.apexes[a]);
    const double height = interface.contact_height(static_cast<Eigen::Index>(a));
    const Index facet = broad.nearest(interface.base, x, p, std::isnan(least) ? reach : least + height);
    if (facet < 0) continue;
    const auto closest = geometry::closest_on_triangle(corners(interface.base, x, facet), p);
    const double gap = std::sqrt(closest.distance_squared) - height;
    if (!(gap >= least)) least = gap;
  }
  return least;
}

InitialGaps connect(Interface& interface, const Vectors& x, double reach, const ContactHeight& height, InitialPenetration penetration,
                    Memory& memory, Workspace& workspace) {
  const auto count = static_cast<Index>(interface.apexes.size());
  memory = {};
  memory.feature.resize(count);
  memory.status.assign(count, Status::unpaired);
  memory.gap.assign(count, std::numeric_limits<double>::quiet_NaN());
  memory.stored.assign(count, 0.0);
  memory.offset.assign(count, 0.0);
  memory.elements.resize(count);
  interface.base_nodes.assign(interface.base.facets.data(), interface.base.facets.data() + interface.base.facets.size());
  std::sort(interface.base_nodes.begin(), interface.base_nodes.end());
  interface.base_nodes.erase(std::unique(interface.base_nodes.begin(), interface.base_nodes.end()), interface.base_nodes.end());
  memory.apexes_then = Vectors::Zero(3, count);
  memory.base_then = Vectors::Zero(3, static_cast<Eigen::Index>(interface.base_nodes.size()));
  if (interface.friction.coefficient > 0) {
    memory.friction.resize(count);
    memory.slip.assign(count, Vec3::Zero());
    memory.tangential_stored.assign(count, 0.0);
  }
  interface.bonds.assign(interface.kind == InterfaceKind::bonded ? count : 0, Bond{});
  memory.reconnections.assign(count, 0);
  interface.contact_height = Scalars::Constant(count, height.given);
  memory.margin = reach;
  search(interface, x, [reach](Index) { return reach; }, memory, workspace);
  memory.recovered = memory.searches = 0;
  for (ElementForces& element : memory.elements) element.found_anew = false;

  InitialGaps gaps;
  gaps.apexes = count;
  gaps.least = std::numeric_limits<double>::infinity();
  gaps.largest = -gaps.least;
  for (Index a = 0; a < count; ++a) {
    if (memory.feature[a].facet < 0) {
      ++gaps.without_base;
      if (interface.kind == InterfaceKind::bonded) ++gaps.free;
      continue;
    }
    const Vector<double> p = position(x, interface.apexes[a]);
    const WalkEnd end = walk(interface.base, x, p, memory.feature[a].facet);
    double h = std::sqrt(end.closest.distance_squared);
    const ActiveFeatures active = active_features_on(interface.base, x, p, end, h, allowed_of(interface, a));
    memory.status[a] = active.count > 0 ? Status::open : Status::off_surface;
    memory.feature[a] = end.feature;
    for (int i = 0; i < active.count; ++i) {
      const double here = active.at[i].height;
      if (i == 0 || here < h) h = here, memory.feature[a] = active.feature[i];
    }
    double& contact_height = interface.contact_height(a);
    if (height.from_initial_height) contact_height = h - height.clearance;
    // positions are no more exact than their distance from the origin allows, and differences no more than the facet's size
    const auto facet = interface.base.facets.col(memory.feature[a].facet);
    const double size = (x.col(facet(1)) - x.col(facet(0))).norm();
    const double round_off = 1e-12 * (std::abs(h) + std::abs(contact_height) + size);
    const bool bonded = interface.kind == InterfaceKind::bonded;
    if (!bonded && h - contact_height < -round_off && memory.status[a] == Status::open) {
      ++gaps.penetrating;
      gaps.deepest = std::max(gaps.deepest, contact_height - h);
      if (penetration == InitialPenetration::accept) memory.offset[a] = contact_height - h;
    }
    memory.gap[a] = h - contact_height + memory.offset[a];
    gaps.least = std::min(gaps.least, memory.gap[a]);
    gaps.largest = std::max(gaps.largest, memory.gap[a]);
    if (bonded && memory.status[a] == Status::open) {
      const FeatureHeight over = height_over(interface.base, x, {memory.feature[a].facet, Kind::facet, 0}, p);
      interface.bonds[a] = {memory.feature[a].facet, over.weight, over.height};
    }
    if (bonded && memory.status[a] != Status::open) ++gaps.free;
    gaps.mean += memory.gap[a];
    ++gaps.by_kind[static_cast<int>(memory.feature[a].kind)];
  }
  const Index connected = gaps.apexes - gaps.without_base;
  if (connected == 0) gaps.least = gaps.largest = 0;
  else gaps.mean /= connected;
  return gaps;
}

void advance(const Interface& interface, const Vectors& x, const Vectors& v, const Vectors& omega, double dt, Memory& memory,
             Workspace& workspace) {
  std::vector<ElementForces>& forces = memory.elements;
  const bool walks = interface.kind == InterfaceKind::contact;
  if (walks && (memory.searches == 0 || search_is_due(interface, x, memory))) {
    memory.margin = margin_of(interface, v);
    search(interface, x, [&](Index a) { return interface.contact_height(a) + memory.margin; }, memory, workspace);
  }
  parallel_for(static_cast<Index>(interface.apexes.size()), 64, [&](Index a) {
    advance_apex(interface, x, v, dt, a, memory, forces[a]);
    if (!memory.friction.empty())
      advance_friction(interface, x, v, omega, dt, a, forces[a], memory, memory.friction[a], forces[a].angular_impulse);
  });
  memory.deepest_now = 0;
  for (std::size_t a = 0; a < forces.size(); ++a) {
    if (memory.status[a] == Status::closed) memory.deepest_now = std::max(memory.deepest_now, -memory.gap[a]);
    // what came in from the side and is no deeper than an element overlaps as well, though nothing pushes it out
    if (forces[a].overlap <= interface.depth) memory.deepest = std::max(memory.deepest, forces[a].overlap);
    memory.work += forces[a].work;
    memory.damped += forces[a].dissipated;
    memory.angular_impulse += forces[a].angular_impulse;
    double created = forces[a].created;
    if (!memory.friction.empty()) {
      memory.work += memory.friction[a].work;
      memory.friction_dissipated += memory.friction[a].dissipated;
      created += memory.friction[a].created;
    }
    if (!forces[a].moved) continue;
    memory.created_by_reconnection += created;
    ++(memory.status[a] == Status::unpaired ? memory.unpaired : memory.walks);
    if (memory.status[a] != Status::unpaired) ++memory.reconnections[a];
  }
  memory.deepest = std::max(memory.deepest, memory.deepest_now);
}

void add_forces(const Interface& interface, const Memory& memory, Vectors& force, Vectors& moment) {
  const std::vector<ElementForces>& forces = memory.elements;
  for (std::size_t a = 0; a < forces.size(); ++a) {
    if (!forces[a].closed) continue;
    force.col(interface.apexes[a]) += forces[a].scale * forces[a].apex;
    for (int i = 0; i < forces[a].count; ++i) force.col(forces[a].node[i]) += forces[a].scale * forces[a].force[i];
  }
  for (const FrictionForces& friction : memory.friction)
    if (friction.acts) add_friction(friction.touch, friction.force, interface.rotation_of_node, force, moment);
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
  for (const FrictionForces& f : memory.friction) arms(f, [&](Index node, double) { sum(node) = 0; });
  for (const FrictionForces& f : memory.friction) arms(f, [&](Index node, double share) { sum(node) += f.stiffness * share; });
  for (std::size_t a = 0; a < memory.friction.size(); ++a) {
    double omega_squared = 0;
    arms(memory.friction[a],
         [&](Index node, double share) { omega_squared += share * sum(node) / inertia(interface.rotation_of_node[node]); });
    fastest.see(omega_squared, static_cast<Index>(a));
  }
  return fastest;
}

/// Largest squared frequency of the normal springs between apexes and bases.
Fastest normal_springs(const Interface& interface, const Scalars& mass, const Memory& memory, Workspace& workspace) {
  Scalars& sum = workspace.spring_sum;
  const std::vector<ElementForces>& elements = memory.elements;
  for (const ElementForces& e : elements)
    for (int b = 0; b < e.count; ++b) sum(e.node[b]) = 0;
  for (const ElementForces& e : elements)
    for (int b = 0; b < e.count; ++b) sum(e.node[b]) += e.stiffness * e.weight[b];
  Fastest fastest;
  for (std::size_t a = 0; a < elements.size(); ++a) {
    const ElementForces& e = elements[a];
    if (e.count == 0) continue;
    double omega_squared = e.stiffness / mass(interface.apexes[a]);
    for (int b = 0; b < e.count; ++b) omega_squared += e.weight[b] * sum(e.node[b]) / mass(e.node[b]);
    fastest.see(omega_squared, static_cast<Index>(a));
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
  if (memory.friction.empty()) return bounce;
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
  if (v.feature.facet >= 0) {
    const auto c = corners(interface.base, x, v.feature.facet);
    v.weight = geometry::closest_on_triangle(c, position(x, v.apex)).weight;
  }
  if (v.status != Status::closed) return v;
  const double per_area = interface.spring.size() > 0 ? interface.spring(apex) / interface.area(apex) : interface.penalty;
  v.traction = -per_area * v.gap;
  if (interface.kind == InterfaceKind::bonded) {
    const double k = stiffness(interface, apex, v.feature), along = k * v.gap;
    const double all = 2 * k * memory.stored[apex];  // |k d|^2
    v.shear_traction = per_area / k * std::sqrt(std::max(0.0, all - along * along));
  } else if (!memory.slip.empty()) {
    v.shear_traction = interface.friction.tangential_penalty * per_area * memory.slip[apex].norm();
    v.slides = v.shear_traction >= (1 - 1e-9) * interface.friction.coefficient * v.traction;  // round-off
  }
  return v;
}

}  // namespace nereid::contact
