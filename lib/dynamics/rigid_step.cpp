#include "dynamics/rigid_step.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace nereid::dynamics {

namespace {

constexpr double most_turn = 0.02;  // [rad] in a step: the phase of a free rotation is then off by 1e-8 of it

/// Calls visit(place, body, state, forces) for each rigid body.
template <class Visit>
void for_each(const Model& model, State& now, Forces& f, Visit&& visit) {
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) visit(b, model.rigid_bodies[b], now.rigid_bodies[b], f.rigid_bodies[b]);
}

/// Sum of (R A) x f. [N m]
Vec3 moment_of(const RigidForces& forces, const rigid::Turn& turn) {
  const Mat3 by_arm = forces.spread * rigid::matrix(turn).transpose();
  return {by_arm(2, 1) - by_arm(1, 2), by_arm(0, 2) - by_arm(2, 0), by_arm(1, 0) - by_arm(0, 1)};
}

double square_of(const rigid::Body& body, const rigid::State& now, const RigidForces& forces) {
  const Vec3 moment = moment_of(forces, now.turn);
  return forces.force.dot(rigid::response_of_shift(body) * forces.force) + moment.dot(rigid::response_of_spin(body, now) * moment);
}

/// Half of the work of the forces of now along the step. [J]
double half_of_work(const RigidForces& forces) {
  return 0.5 * (forces.force.dot(forces.way) + forces.turned.cwiseProduct(forces.spread).sum());
}

/// Velocity and spin that a plane prescribes, at the centre of the body in the reference.
rigid::Twist driven_twist(const load::Plane& plane, const rigid::Body& body, double t) {
  const Vec3& X = body.mass.centre;
  rigid::Twist twist;
  for (int axis = 0; axis < 3; ++axis) {
    if (plane.field[axis]) twist.velocity(axis) = plane.field[axis](X.x(), X.y(), X.z(), t);
    if (plane.angular_velocity[axis]) twist.spin(axis) = plane.angular_velocity[axis](X.x(), X.y(), X.z(), t);
  }
  return twist;
}

/// The velocity that planes that move along their normals prescribe.
Vec3 given_velocity(const Model& model, const HeldBody& held, double t) {
  Vec3 sum = Vec3::Zero();
  for (const HeldBody::Row& row : held.rows)
    if (const load::Plane& plane = model.constraints.planes[row.plane]; plane.velocity) sum += plane.velocity(t) * row.reaction;
  return sum;
}

/// Gives a body what impulses and what holds it make of its velocities at t.
void set_momenta(const Model& model, std::size_t b, const Vec3& impulse, const Vec3& angular, double t, rigid::State& now) {
  const rigid::Body& body = model.rigid_bodies[b];
  const HeldBody& held = model.held_bodies[b];
  if (held.driver >= 0) {
    const rigid::Twist twist = driven_twist(model.constraints.planes[held.driver], body, t);
    rigid::set_velocities(body, twist.velocity, twist.spin, now);
    return;
  }
  if (held.first < 0) {
    rigid::kick(body, impulse, angular, now);
    return;
  }
  now.momentum = body.hold.shift * now.momentum + body.mass.mass * given_velocity(model, held, t);
  if (body.hold.turns == 0) now.angular_momentum.setZero();
  if (body.hold.turns == 1) rigid::set_velocities(body, rigid::velocity(body, now),
                                                  body.hold.axis.dot(rigid::angular_velocity(body, now)) * body.hold.axis, now);
  rigid::kick(body, impulse, angular, now);
}

/// Posts what a kick did beyond its impulses to the planes that hold a body.
void post_reactions(const Model& model, std::size_t b, const rigid::State& before, const Vec3& impulse, const Vec3& angular,
                    double quarter_step, const rigid::State& now, const RigidForces& forces, std::vector<load::PlaneAccount>& accounts,
                    double& driven) {
  const rigid::Body& body = model.rigid_bodies[b];
  const HeldBody& held = model.held_bodies[b];
  const Vec3 reaction = now.momentum - before.momentum - impulse, turning = now.angular_momentum - before.angular_momentum - angular;
  const Vec3 v0 = rigid::velocity(body, before), v1 = rigid::velocity(body, now), centre = rigid::centre(body, now);
  const int first = held.driver >= 0 ? held.driver : held.first;
  const auto post = [&](int plane, const Vec3& share, double work) {
    load::PlaneAccount& account = accounts[plane];
    account.impulse += share;
    account.angular_impulse += centre.cross(share);
    if (load::moves(model.constraints.planes[plane])) account.driven += work, driven += work;
    else account.stopped -= work;
  };
  if (held.driver >= 0) {
    const Vec3 w0 = rigid::angular_velocity(body, before), w1 = rigid::angular_velocity(body, now);
    const double turned = 0.5 * turning.dot(w0 + w1) + quarter_step * moment_of(forces, now.turn).dot(w1 - w0);
    post(first, reaction, 0.5 * reaction.dot(v0 + v1) + quarter_step * forces.force.dot(v1 - v0) + turned);
  } else {
    for (const HeldBody::Row& row : held.rows) {
      const Vec3 share = row.reaction.dot(reaction) * row.normal;
      const bool moves = load::moves(model.constraints.planes[row.plane]);
      const double late = quarter_step * row.reaction.dot(forces.force) * row.normal.dot(v1 - v0);
      post(row.plane, share, moves ? 0.5 * share.dot(v0 + v1) + late : 0);
    }
  }
  accounts[first].angular_impulse += turning;
}

}  // namespace

void start_rigid_bodies(const Model& model, State& now) {
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const rigid::Twist twist = rigid::fit(model.rigid_bodies[b], now.v);
    rigid::set_velocities(model.rigid_bodies[b], twist.velocity, twist.spin, now.rigid_bodies[b]);
    rigid::set_node_velocities(model.rigid_bodies[b], now.rigid_bodies[b], now.v);
  }
}

void begin_rigid_forces(const Model& model, Forces& f) {
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    f.rigid_bodies[b].force = model.rigid_bodies[b].mass.mass * model.gravity;
    f.rigid_bodies[b].spread.setZero();
    for (const Index node : model.rigid_bodies[b].nodes) f.force.col(node).setZero();
  }
}

void gather_rigid_forces(const Model& model, Forces& f) {
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const rigid::Body& body = model.rigid_bodies[b];
    Vec3 force = Vec3::Zero();
    Mat3 spread = Mat3::Zero();
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
      auto one = f.force.col(body.nodes[i]);
      if (one.isZero(0)) continue;
      force += one;
      spread += one * body.arm.col(static_cast<Eigen::Index>(i)).transpose();
      one.setZero();
    }
    f.rigid_bodies[b].force += force;
    f.rigid_bodies[b].spread += spread;
  }
}

double kick_rigid_bodies(const Model& model, double dt, double t, bool first, State& now, Forces& f) {
  double sum = 0;
  for_each(model, now, f, [&](std::size_t b, const rigid::Body& body, rigid::State& state, RigidForces& forces) {
    const double square = square_of(body, state, forces);
    sum += square;
    if (first) forces.kinetic = rigid::kinetic_energy(body, state), forces.driven = 0, forces.square = square;
    const rigid::State before = state;
    const Vec3 impulse = dt * forces.force, angular = dt * moment_of(forces, state.turn);
    set_momenta(model, b, impulse, angular, t, state);
    if (model.held_bodies[b].first >= 0 || model.held_bodies[b].driver >= 0)
      post_reactions(model, b, before, impulse, angular, first ? -dt / 2 : dt / 2, state, forces, now.constraints.account, forces.driven);
  });
  return sum;
}

void drift_rigid_bodies(const Model& model, double dt, State& now, Forces& f) {
  for_each(model, now, f, [&](std::size_t b, const rigid::Body& body, rigid::State& state, RigidForces& forces) {
    const rigid::State before = state;
    const Vec3 centre = rigid::centre(body, state);
    rigid::Twist twist = rigid::twist_of(body, state, dt);
    const HeldBody& held = model.held_bodies[b];
    if (held.driver >= 0) twist = {rigid::velocity(body, state), rigid::angular_velocity(body, state)};
    rigid::drift(body, twist, dt, state);
    if (held.driver >= 0) rigid::set_velocities(body, twist.velocity, twist.spin, state);
    const int plane = held.driver >= 0 ? held.driver : body.hold.turns == 1 ? held.first : -1;
    if (plane >= 0) now.constraints.account[plane].angular_impulse += state.angular_momentum - before.angular_momentum;
    for (const Index node : body.nodes) now.v.col(node) = rigid::velocity_at(twist, now.x.col(node) - centre, dt);
    forces.way = dt * twist.velocity, forces.turned = rigid::turn_in_step(twist, before.turn, dt);
    forces.work = half_of_work(forces);
  });
}

void place_rigid_nodes(const Model& model, State& now) {
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b)
    rigid::place_nodes(model.rigid_bodies[b], now.rigid_bodies[b], model.mesh.X, now.x);
}

double finish_rigid_step(const Model& model, double dt, State& now, Forces& f) {
  double sum = 0;
  for_each(model, now, f, [&](std::size_t b, const rigid::Body& body, rigid::State& state, RigidForces& forces) {
    const double work = forces.work + half_of_work(forces);
    const double grown = rigid::kinetic_energy(body, state) - forces.kinetic;
    const double rest = grown - work - forces.driven - dt * dt / 8 * (square_of(body, state, forces) - forces.square);
    const int driver = model.held_bodies[b].driver;
    if (driver >= 0) now.constraints.account[driver].driven += rest;
    else sum += rest;
    rigid::set_node_velocities(body, state, now.v);
  });
  return sum;
}

contact::RigidNodes* predict_rigid_bodies(const Model& model, double h, double next, const State& now, Forces& f) {
  if (model.rigid_bodies.empty()) return nullptr;
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const rigid::Body& body = model.rigid_bodies[b];
    const HeldBody& held = model.held_bodies[b];
    contact::MovingBody& moving = f.rigid_nodes.bodies[b];
    const double step = h > 0 ? next : 0, t = now.t + 0.5 * step;
    if (held.driver >= 0) {
      contact::begin_driven(body, now.rigid_bodies[b], driven_twist(model.constraints.planes[held.driver], body, t), step, moving);
      continue;
    }
    rigid::State state = now.rigid_bodies[b];
    const RigidForces& forces = f.rigid_bodies[b];
    set_momenta(model, b, h * forces.force, h * moment_of(forces, state.turn), t, state);
    contact::begin(body, state, step, moving);
  }
  return &f.rigid_nodes;
}

void push_rigid_bodies(const Model& model, const Vectors& impulse, State& now) {
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const rigid::Body& body = model.rigid_bodies[b];
    rigid::State& state = now.rigid_bodies[b];
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    const Vec3 centre = rigid::centre(body, state);
    for (const Index node : body.nodes) {
      linear += impulse.col(node);
      angular += (now.x.col(node) - centre).cross(impulse.col(node));
    }
    const rigid::State before = state;
    rigid::kick(body, linear, angular, state);
    if (model.held_bodies[b].first >= 0 || model.held_bodies[b].driver >= 0) {
      double driven = 0;
      if (model.held_bodies[b].driver >= 0) state = before;
      post_reactions(model, b, before, linear, angular, 0, state, {}, now.constraints.account, driven);
    }
    rigid::set_node_velocities(body, state, now.v);
  }
}

double rigid_step_limit(const Model& model, const State& now, std::size_t body) {
  const double spin = rigid::angular_velocity(model.rigid_bodies[body], now.rigid_bodies[body]).norm();
  return spin * model.longest_step > most_turn ? most_turn / spin : model.longest_step;
}

double rigid_kinetic_energy(const Model& model, const State& now) {
  double sum = 0;
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) sum += rigid::kinetic_energy(model.rigid_bodies[b], now.rigid_bodies[b]);
  return sum;
}

void add_rigid_momenta(const Model& model, const State& now, Vec3& linear, Vec3& angular) {
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const rigid::State& state = now.rigid_bodies[b];
    linear += state.momentum;
    angular += rigid::centre(model.rigid_bodies[b], state).cross(state.momentum) + state.angular_momentum;
  }
}

}  // namespace nereid::dynamics
