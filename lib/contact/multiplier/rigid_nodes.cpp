#include "contact/multiplier/rigid_nodes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "contact/multiplier/predict.hpp"

namespace nereid::contact {

namespace {

/// A force and its moment about the centre of a body, per impulse of a condition.
struct OnBody {
  Index body = -1;
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

/// What acts on rigid bodies: contact has two sides, so no more than two of them.
struct OnBodies {
  std::array<OnBody, 2> on;

  void add(const RigidNodes& all, const Vectors& x, Index node, const Vec3& force) {
    const Index body = all.of_node[node];
    if (body < 0) return;
    OnBody& here = on[0].body < 0 || on[0].body == body ? on[0] : on[1];
    here.body = body;
    here.force += force;
    here.moment += (x.col(node) - all.bodies[body].centre).cross(force);
  }
};

double product(const MovingBody& body, const OnBody& a, const OnBody& b) {
  return a.force.dot(body.shift * b.force) + a.moment.dot(body.turn * b.moment);
}

OnBodies of_condition(const RigidNodes& all, const Vectors& x, const ConditionList& list, const Condition& c) {
  OnBodies sum;
  const auto members = members_of(c, list);
  for (int j = 0; j < c.nodes; ++j) sum.add(all, x, members[static_cast<std::size_t>(j)].node, members[static_cast<std::size_t>(j)].push);
  return sum;
}

OnBodies of_shares(const RigidNodes& all, const Vectors& x, const FrictionShares& shares) {
  OnBodies sum;
  for (int i = 0; i < shares.count; ++i) sum.add(all, x, shares.node[i], shares.force[i]);
  return sum;
}

/// Friction along two directions of its plane.
struct Along {
  FrictionShares first, second;
};
Along along(const Touch& touch) {
  const Vec3 one = touch.normal.unitOrthogonal();
  return {share_friction(touch, one), share_friction(touch, touch.normal.cross(one))};
}

/// Calls visit(body, q, condition) for each body that a contactor acts on: its conditions one by one, then, with -1, its friction in all
/// directions.
template <class Visit>
void for_each_body(const Multipliers& multipliers, const Contactor& one, Visit&& visit) {
  for (Index i = one.first; i < one.last; ++i) {
    const Row& row = multipliers.conditions[i].row;
    for (Index k = 0; k < row.bodies; ++k) visit(body_of(row, k, multipliers.rows), size_on_body(row, k, multipliers.rows), i);
  }
  if (one.friction < 0) return;
  const std::array<Row, 2>& rows = multipliers.frictions[one.friction].row;
  for (Index k = 0; k < rows[0].bodies; ++k)
    visit(body_of(rows[0], k, multipliers.rows),
          std::hypot(size_on_body(rows[0], k, multipliers.rows), size_on_body(rows[1], k, multipliers.rows)), Index{-1});
}

bool acts_on_bodies(const Multipliers& multipliers, const Contactor& one) {
  return std::any_of(multipliers.conditions.begin() + one.first, multipliers.conditions.begin() + one.last,
                     [](const Condition& c) { return c.row.bodies > 0; });
}

/// What friction does to its slip rate through nodes that are not rigid, alone and with all that share them. [1/kg]
double bound_of_nodes(const RigidNodes& all, const Motion& m, const Multipliers& multipliers, const Contactor& one) {
  const Touch& touch = multipliers.frictions[one.friction].touch;
  const Along both = along(touch);
  const auto product = [&](const FrictionShares& a, const FrictionShares& b) {
    double sum = 0;
    for (int i = 0; i < a.count; ++i) {
      const Index node = a.node[i];
      if (all.of_node[node] >= 0) continue;
      sum += a.force[i].dot(m.allowed[node] ? Vec3(*m.allowed[node] * b.force[i]) : b.force[i]) / m.mass(node);
      if (a.turns[i] && b.turns[i]) sum += a.moment[i].dot(b.moment[i]) / m.inertia(m.rotation_of_node[node]);
    }
    return sum;
  };
  double alone = 0, together = 0;
  const auto see = [&](Index node, double weight) {
    if (all.of_node[node] >= 0) return;
    alone += weight * weight / m.mass(node);
    together += weight * multipliers.rubbed(node) / (one.area * m.mass(node));
  };
  if (touch.apex >= 0) see(touch.apex, 1);
  for (int j = 0; j < touch.nodes; ++j) see(touch.node[j], std::abs(touch.weight[j]));
  if (!(alone > 0)) return 0;
  const double most = std::max(product(both.first, both.first), product(both.second, both.second));
  return (most + std::abs(product(both.first, both.second))) * together / alone;
}

}  // namespace

RigidNodes make_rigid_nodes(std::span<const AnyContact> contacts, std::span<const RigidPlane> planes, std::span<const rigid::Body> bodies,
                            const std::vector<Index>& of_node) {
  RigidNodes all;
  all.of_node = of_node;
  all.bodies.resize(bodies.size());
  const auto add = [&](const Subset& nodes) {
    for (const Index node : nodes)
      if (of_node[node] >= 0) all.bodies[of_node[node]].nodes.push_back(node);
  };
  for (const AnyContact& one : contacts)
    if (by_multipliers(one)) add(sides(one).apexes), add(sides(one).base_nodes);
  for (const RigidPlane& plane : planes)
    if (by_multipliers(plane)) {
      add(plane.nodes);
      for (const mesh::RoundBody& round : plane.rounds) add({round.anchor.begin(), round.anchor.end()});
    }
  for (MovingBody& body : all.bodies) {
    std::sort(body.nodes.begin(), body.nodes.end());
    body.nodes.erase(std::unique(body.nodes.begin(), body.nodes.end()), body.nodes.end());
  }
  return all;
}

void begin(const rigid::Body& body, const rigid::State& state, double next, MovingBody& moving) {
  moving.body = &body;
  moving.driven = false;
  moving.centre = rigid::centre(body, state);
  moving.shift = rigid::response_of_shift(body);
  moving.turn = rigid::response_of_spin(body, state);
  moving.state = state;
  moving.next = next;
  moving.twist = rigid::twist_of(body, state, next);
}

void begin_driven(const rigid::Body& body, const rigid::State& state, const rigid::Twist& twist, double next, MovingBody& moving) {
  moving.body = &body;
  moving.driven = true;
  moving.centre = rigid::centre(body, state);
  moving.shift.setZero(), moving.turn.setZero();
  moving.state = state;
  moving.next = next;
  moving.twist = twist;
}

void look_ahead(RigidNodes& all, const Motion& m, Multipliers& multipliers) {
  for (MovingBody& body : all.bodies) {
    for (const Index node : body.nodes)
      multipliers.velocity.col(node) = rigid::velocity_at(body.twist, m.x.col(node) - body.centre, body.next);
    predict_positions(body.nodes, m, multipliers);
  }
}

void push(MovingBody& body, const Vec3& impulse, const Vec3& angular, const Motion& m, Vectors& velocity) {
  if (body.driven) return;
  rigid::kick(*body.body, impulse, angular, body.state);
  body.twist = rigid::twist_of(*body.body, body.state, body.next);
  for (const Index node : body.nodes) velocity.col(node) = rigid::velocity_at(body.twist, m.x.col(node) - body.centre, body.next);
}

double per_mass(const RigidNodes& all, const Motion& m, const ConditionList& list, const Condition& c) {
  double sum = 0;
  for (const Member& one : members_of(c, list))
    if (all.of_node[one.node] < 0) sum += let_through(m, one).squaredNorm() / m.mass(one.node);
  for (const OnBody& on : of_condition(all, m.x, list, c).on)
    if (on.body >= 0) sum += product(all.bodies[on.body], on, on);
  return sum;
}

double product_of_bodies(const RigidNodes& all, const FrictionShares& a, const FrictionShares& b, const Vectors& x) {
  const OnBodies first = of_shares(all, x, a), second = of_shares(all, x, b);
  double sum = 0;
  for (int k = 0; k < 2; ++k)
    if (first.on[k].body >= 0) sum += product(all.bodies[first.on[k].body], first.on[k], second.on[k]);
  return sum;
}

void leave_out(const RigidNodes& all, Multipliers& multipliers) {
  for (const MovingBody& body : all.bodies)
    for (const Index node : body.nodes) multipliers.shared(node) = multipliers.rubbed(node) = 0;
}

void add_bounds(const RigidNodes& all, const Motion& m, Multipliers& multipliers) {
  std::vector<double> shared(all.bodies.size(), 0);
  for (const Contactor& one : multipliers.contactors)
    for_each_body(multipliers, one, [&](Index body, double q, Index) { shared[body] += one.area * q; });
  for (const Contactor& one : multipliers.contactors) {
    if (!acts_on_bodies(multipliers, one)) continue;
    double of_friction = one.friction < 0 ? 0 : bound_of_nodes(all, m, multipliers, one);
    for_each_body(multipliers, one, [&](Index body, double q, Index condition) {
      const double bound = q * shared[body] / one.area;
      if (condition >= 0) multipliers.conditions[condition].bound += bound;
      else of_friction += bound;
    });
    if (one.friction < 0) continue;
    FrictionCondition& friction = multipliers.frictions[one.friction];
    friction.bound = of_friction > 0 ? of_friction : friction.per_mass;  // held: what it would be alone
  }
}

}  // namespace nereid::contact
