#include "contact/multiplier/stick.hpp"

#include <algorithm>
#include <cmath>

#include "contact/multiplier/rigid_nodes.hpp"

namespace nereid::contact {

namespace {

constexpr double repaid_share = 0.2;   // of the energy deficit of friction, in a step
constexpr double most_yield = 1e-6;    // of the depth of an element: way by which a stick yields for that in a step

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
  const double first_rate = product(one, one), other_rate = product(other, other);
  // the larger eigenvalue, whichever directions were taken
  return 0.5 * (first_rate + other_rate) + std::hypot(0.5 * (first_rate - other_rate), product(one, other));
}

}  // namespace

Index add_friction(const Touch& touch, const Coulomb& law, const Vec3& force, bool stuck, const Motion& m,
                   std::vector<FrictionCondition>& frictions) {
  double per_mass = response(touch, m, true);
  if (!(per_mass > no_response / m.mass(touch.apex >= 0 ? touch.apex : touch.node[0]))) per_mass = response(touch, m, false);
  const Vec3 impulse = 0.5 * (m.dt + m.next) * (force - touch.normal.dot(force) * touch.normal);
  const Vec3 before = slip_rate(touch, m.v, m.omega, m.rotation_of_node);
  const Vec3 along = touch.normal.unitOrthogonal();
  frictions.push_back({.touch = touch, .coefficient = coefficient_at(law, stuck ? 0 : before.norm()), .per_mass = per_mass,
                       .bound = 0, .before = before, .stuck = Vec3::Zero(), .impulse = impulse, .change = Vec3::Zero(),
                       .met = impulse, .moved = Vec3::Zero(), .after = before, .along = {along, touch.normal.cross(along)}, .row = {}});
  return static_cast<Index>(frictions.size()) - 1;
}

void let_yield(double deficit, double depth, const Motion& m, std::size_t first, Multipliers& all) {
  if (!(deficit > 0)) return;
  double sum = 0;
  for (std::size_t k = first; k < all.frictions.size(); ++k) sum += all.frictions[k].impulse.norm();
  if (!(sum > 0)) return;
  const double speed = std::min(repaid_share * deficit / sum, most_yield * depth / m.next);
  for (std::size_t k = first; k < all.frictions.size(); ++k) {
    FrictionCondition& friction = all.frictions[k];
    const double size = friction.impulse.norm();
    if (size > 0) friction.stuck = -speed / size * friction.impulse;
  }
}

void find_change(double pressed, const Vec3& rate, FrictionCondition& friction) {
  const double limit = friction.coefficient * pressed;
  friction.change.setZero();
  if (!(limit > 0) && friction.impulse.isZero(0)) return;
  Vec3 now = friction.impulse - (rate - friction.stuck) / friction.bound;
  const double size = now.norm();
  friction.slides = size > limit;
  if (friction.slides) now *= limit / size;
  friction.change = now - friction.impulse;
}

void follow_release(Multipliers& all) {
  for (Condition& c : all.conditions) c.change = 0;
  for (const Contactor& one : all.contactors) {
    if (one.friction < 0) continue;
    FrictionCondition& friction = all.frictions[one.friction];
    find_change(rubbing_impulse_of(one, all), rate(friction, all), friction);
    friction.change -= friction.rest;
  }
}

void end_friction(Seldom<FrictionForces>& one) {
  if (!one.exists()) return;
  FrictionForces& friction = one.make();
  friction.acts = friction.stuck = false;
  friction.force.setZero();
}

void book_friction(const Contactor& contactor, bool closed, double h, const Multipliers& all, Seldom<FrictionForces>& one) {
  if (!closed) return;
  FrictionForces& friction = one.make();
  friction.stuck = contactor.friction < 0 || !all.frictions[static_cast<std::size_t>(contactor.friction)].slides;
  if (contactor.friction < 0) return;
  const FrictionCondition& found = all.frictions[static_cast<std::size_t>(contactor.friction)];
  friction.touch = found.touch, friction.coefficient = found.coefficient, friction.force = found.impulse / h;
  friction.acts = true;
}

}  // namespace nereid::contact
