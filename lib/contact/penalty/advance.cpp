#include "contact/penalty/advance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contact/search/near.hpp"
#include "contact/tracking/depth.hpp"
#include "contact/tracking/element.hpp"

namespace nereid::contact {

namespace {

/// Rotation of the base over the step that led to x, from its positions in the middle, where a rigid
/// rotation is met exactly. [rad]
Vec3 rotation_of_base(const Touch& touch, const Vectors& x, const Vectors& v, double dt) {
  Touch middle = touch;
  constexpr std::array<double, 3> alike{1, 1, 1};
  std::array<Vec3, 3> corner;
  for (int I = 0; I < 3; ++I) corner[I] = x.col(touch.node[I]) - 0.5 * dt * v.col(touch.node[I]);
  measure_base(corner, alike, middle);
  return dt * spin_of_base(middle, v);
}

/// Friction on one apex whose normal force is known: slip carried on, stuck or slid.
void advance_friction(const Interface& interface, const Vectors& x, const Vectors& v, const Vectors& omega, double dt, Near& near,
                      Memory& memory) {
  const Index a = near.apex;
  const ElementForces& element = near.element;
  if (!element.closed && !near.friction.exists()) return;
  FrictionForces& friction = near.friction.make();
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
    friction.sliding = 0;
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
  const double stiffness_before = friction.stiffness;
  friction.stiffness = interface.friction.tangential_penalty * element.penalty;
  Vec3 held = carried(memory.slip[a], rotation, touch.normal);
  if (friction.acts) held *= std::sqrt(stiffness_before / friction.stiffness);  // of the paper's areas: the stick keeps its energy
  Vec3 trial = held;
  if (friction.acts) trial += 0.5 * dt * (carried(rate_before, rotation, touch.normal) + rate);
  if (!interface.allowed.empty()) trial = interface.allowed[a] * trial;
  friction.coefficient = coefficient_at(interface.friction, friction.sliding);
  const Slip slip = stick_or_slide(trial, friction.stiffness, friction.coefficient * push);
  friction.sliding = dt > 0 ? slip.slid.norm() / dt : 0;
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

/// Moves one apex and computes its force, with the work of the step that led to x.
///
/// moved  see Near::safe_distance
void advance_element(const Interface& interface, const Vectors& x, const Vectors& v, double dt, Moved moved, Near& near, Memory& memory) {
  const Index a = near.apex;
  ElementForces& element = near.element;
  const double power_before = power(interface, memory.shares, v, a, element), scale_before = element.scale;
  element.angular_impulse = 0.5 * dt * moment(interface, memory.shares, x, v, -dt, a, element);
  const double stored_before = memory.stored[a];
  const Feature before = memory.feature[a];
  const bool was_closed = element.closed;
  find_contact(interface, x, v, dt, moved, near, memory);
  element.moved = (was_closed || element.closed) && !same(memory.feature[a], before);
  near.is_idle = !was_closed && !element.closed && near.tracks.count == 0;
  const double power_after = power(interface, memory.shares, v, a, element);
  // the power of the elastic force is  -k |d| d|d|/dt = -2 stored d|d|/dt / |d|
  element.scale = 1;
  if (memory.stored[a] > 0 && interface.damping_time > 0)
    element.scale = std::max(0.0, 1 - 0.5 * interface.damping_time * power_after / memory.stored[a]);
  element.angular_impulse += 0.5 * dt * moment(interface, memory.shares, x, v, 0, a, element);
  element.work = 0.5 * dt * (scale_before * power_before + element.scale * power_after);
  element.dissipated = 0.5 * dt * ((1 - scale_before) * power_before + (1 - element.scale) * power_after);
  element.created = element.work + element.dissipated + memory.stored[a] - stored_before;
}

}  // namespace

void advance(const Interface& interface, const Vectors& x, const Vectors& v, const Vectors& omega, double dt, Memory& memory,
             Workspace& workspace) {
  const bool searches = interface.kind == InterfaceKind::contact;
  const Moved moved = from_search(searches ? search_where_due(interface, x, v, memory, workspace) : 0);
  parallel_for(static_cast<Index>(memory.near.size()), 64, [&](Index i) {
    Near& near = memory.near[i];
    if (near.is_idle && moved.now < near.safe_distance) return;
    advance_element(interface, x, v, dt, moved, near, memory);
    if (!memory.slip.empty()) advance_friction(interface, x, v, omega, dt, near, memory);
  });
  memory.deepest_now = 0;
  for (const Near& near : memory.near) {
    if (near.is_idle) continue;
    const ElementForces& element = near.element;
    memory.deepest_now = std::max(memory.deepest_now, element.depth);
    if (element.depth > memory.deepest) update_deepest(interface, x, near, memory);
    memory.work += element.work;
    memory.damped += element.dissipated;
    memory.angular_impulse += element.angular_impulse;
    memory.lost += element.lost;
    double created = element.created;
    if (!memory.slip.empty()) {
      memory.work += near.friction->work;
      memory.friction_dissipated += near.friction->dissipated;
      created += near.friction->created;
    }
    if (!element.moved) continue;
    memory.created_by_reconnection += created;
    ++memory.walks;
    ++memory.reconnections[near.apex];
  }
  sum_force(dt, memory);
}

}  // namespace nereid::contact
