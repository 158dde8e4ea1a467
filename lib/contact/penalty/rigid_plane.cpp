#include "contact/penalty/rigid_plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace nereid::contact {

PlaneMemory initial_memory(const RigidPlane& plane) {
  PlaneMemory memory;
  memory.force.assign(plane.nodes.size(), 0.0);
  if (by_multipliers(plane)) {
    memory.next_force.assign(plane.nodes.size(), 0.0);
    memory.area.assign(plane.nodes.size(), 0.0);
    memory.restitution.resize(plane.nodes.size());
    if (plane.friction.coefficient > 0) memory.friction.assign(plane.nodes.size(), Vec3::Zero());
    memory.next_friction = memory.friction;
    memory.stuck.assign(memory.friction.size(), 0);
    return memory;
  }
  if (plane.friction.coefficient > 0) memory.slip.assign(plane.nodes.size(), Vec3::Zero()), memory.sliding.assign(plane.nodes.size(), 0);
  return memory;
}

namespace {

/// Friction on one node over the step `moved` [m] that led to `at`; returns its mean force. [N]
Vec3 advance_friction(const RigidPlane& plane, double k, double push_before, double push, const Vec3& moved, double dt, Vec3& slip,
                      double& sliding, PlaneMemory& memory) {
  const double stiffness = plane.friction.tangential_penalty * k;
  const Vec3 held = slip, slid_by = moved - moved.dot(plane.normal) * plane.normal;
  if (push > 0) {
    const Vec3 trial = push_before > 0 ? Vec3(held + slid_by) : held;  // a node that has just come down has not slid yet
    const Slip now = stick_or_slide(trial, stiffness, coefficient_at(plane.friction, sliding) * push);
    slip = now.elastic;
    sliding = dt > 0 ? now.slid.norm() / dt : 0;
    memory.friction_dissipated += std::max(0.0, 0.5 * stiffness * (held + slip).dot(now.slid));
  } else {
    slip.setZero();
    sliding = 0;
    memory.friction_dissipated += std::max(0.0, 0.5 * stiffness * (held.squaredNorm() + held.dot(slid_by)));  // the stick lets go
  }
  memory.tangential_stored += 0.5 * stiffness * slip.squaredNorm();
  const Vec3 mean = -0.5 * stiffness * (held + slip);
  memory.work += mean.dot(slid_by);
  return mean;
}

}  // namespace

void advance(const RigidPlane& plane, const Vectors& x, const Vectors& v, double dt, PlaneMemory& memory) {
  memory.stored = memory.tangential_stored = 0;
  for (std::size_t i = 0; i < plane.nodes.size(); ++i) {
    const Vec3 at = x.col(plane.nodes[i]), moved = dt * v.col(plane.nodes[i]);
    const double gap = std::min(0.0, (at - plane.point).dot(plane.normal));
    const double k = plane.penalty * plane.area(static_cast<Eigen::Index>(i));
    const bool given = !memory.next_force.empty();
    const double before = memory.force[i], after = given ? memory.next_force[i] : -k * gap;
    memory.force[i] = after;
    if (-gap > memory.deepest) memory.deepest = -gap, memory.deepest_node = plane.nodes[i];
    if (!given) memory.stored += 0.5 * k * gap * gap;
    if (before == 0 && after == 0) continue;
    memory.work += 0.5 * (before + after) * moved.dot(plane.normal);
    memory.impulse += 0.5 * dt * (before + after) * plane.normal;
    memory.angular_impulse += 0.5 * dt * (before * (at - moved) + after * at).cross(plane.normal);
    if (!memory.friction.empty()) {
      const Vec3 mean = 0.5 * (memory.friction[i] + memory.next_friction[i]);
      memory.work += mean.dot(moved);
      memory.impulse += dt * mean;
      memory.angular_impulse += 0.5 * dt * ((at - moved).cross(memory.friction[i]) + at.cross(memory.next_friction[i]));
      memory.friction[i] = memory.next_friction[i];
    }
    if (memory.slip.empty()) continue;
    const Vec3 held = memory.slip[i];
    const Vec3 mean = advance_friction(plane, k, before, after, moved, dt, memory.slip[i], memory.sliding[i], memory);
    memory.impulse += dt * mean;
    memory.angular_impulse -= 0.5 * dt * plane.friction.tangential_penalty * k * ((at - moved).cross(held) + at.cross(memory.slip[i]));
  }
}

namespace {
Vec3 force_on(const RigidPlane& plane, const PlaneMemory& memory, std::size_t i) {
  Vec3 force = memory.force[i] * plane.normal;
  if (!memory.friction.empty()) force += memory.friction[i];
  if (!memory.slip.empty())
    force -= plane.friction.tangential_penalty * plane.penalty * plane.area(static_cast<Eigen::Index>(i)) * memory.slip[i];
  return force;
}
}  // namespace

void add_forces(const RigidPlane& plane, const PlaneMemory& memory, Vectors& force) {
  const auto push = [&](Index node, const Vec3& part) { force.col(node) += part; };
  visit_forces(memory.shape_points, push, [&](const Touch& touch, const Vec3& friction) {
    const FrictionShares shares = share_friction(touch, friction);
    for (int i = 0; i < shares.count; ++i) push(shares.node[static_cast<std::size_t>(i)], shares.force[static_cast<std::size_t>(i)]);
  });
  for (std::size_t i = 0; i < plane.nodes.size(); ++i) force.col(plane.nodes[i]) += force_on(plane, memory, i);
}

Vec3 force(const RigidPlane& plane, const PlaneMemory& memory) {
  Vec3 sum = Vec3::Zero();
  for (const ShapePoint& point : memory.shape_points) sum += point.pressed * point.normal + point.friction;
  for (std::size_t i = 0; i < plane.nodes.size(); ++i) sum += force_on(plane, memory, i);
  return sum;
}

StepLimit stable_step(const RigidPlane& plane, const Scalars& mass, const StepFactorMemory& memory) {
  if (by_multipliers(plane)) return {};
  double most = 0;
  Index at = -1;
  for (std::size_t i = 0; i < plane.nodes.size(); ++i) {
    const double omega_squared = plane.penalty * plane.area(static_cast<Eigen::Index>(i)) / mass(plane.nodes[i]);
    if (omega_squared > most) most = omega_squared, at = plane.nodes[i];
  }
  if (at < 0) return {};
  return {step_factor(plane, memory) / std::sqrt(most * std::max(1.0, plane.friction.tangential_penalty)), at};
}

Source source(const RigidPlane& plane) {
  const bool has_friction = plane.friction.coefficient > 0;
  if (by_multipliers(plane))
    return {plane.name, SourceKind::rigid_plane, {Stored::restitution},
            has_friction ? std::vector{Dissipated::friction, Dissipated::inelastic_impact} : std::vector{Dissipated::inelastic_impact}};
  if (!has_friction) return {plane.name, SourceKind::rigid_plane, {Stored::penalty}, {}};
  return {plane.name, SourceKind::rigid_plane, {Stored::penalty, Stored::tangential_penalty}, {Dissipated::friction}};
}

void post(const RigidPlane& plane, const PlaneMemory& memory, Account& account) {
  account.work = memory.work;
  account.hold(by_multipliers(plane) ? Stored::restitution : Stored::penalty, memory.stored);
  account.hold(Stored::tangential_penalty, memory.tangential_stored);
  account.dissipated[Dissipated::friction] = memory.friction_dissipated - memory.friction_to_come;
  account.dissipated[Dissipated::inelastic_impact] = memory.impact;
  account.impulse = memory.impulse;
  account.angular_impulse = memory.angular_impulse;
}

}  // namespace nereid::contact
