#include "rigid/body.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/dense.hpp"

namespace nereid::rigid {

namespace {

constexpr int most_iterations = 30;
constexpr double round_off = 1e-15;  // of the angular momentum
constexpr double outer_part = 1.3512071919596578;  // [-] 1/(2 - 2^(1/3))
constexpr double large_turn = 0.5;                 // [rad] in a step, as an impact may make it

Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// The implicit midpoint rule from S: S_m and W = J^-1 S_m of S_m - S - dt/2 S_m x W = 0 by Newton's method.
struct Mean {
  Vec3 momentum, spin;  ///< [N m s] [rad/s] in the axes of the body
};
Mean mean_of(const Mat3& inverse, const Vec3& S, double dt) {
  const double enough = round_off * S.norm();
  Vec3 mean = S, spin = inverse * mean;
  for (int k = 0; k < most_iterations; ++k) {
    const Vec3 residual = mean - S - 0.5 * dt * mean.cross(spin);
    const Mat3 slope = Mat3::Identity() - 0.5 * dt * (cross_matrix(mean) * inverse - cross_matrix(spin));
    const Vec3 change = slope.partialPivLu().solve(residual);
    mean -= change, spin = inverse * mean;
    if (!(change.norm() > enough)) break;
  }
  return {mean, spin};
}

/// The spin of a step, its turn's vector of Cayley over dt: three parts of the midpoint rule, a, 1 - 2a and a of the step. Each keeps
/// energy and angular momentum, so all do; a = 1/(2 - 2^(1/3)) makes the phase of fourth order. A large turn takes one part.  [rad/s]
Vec3 spin_of_step(const Mat3& inverse, const Vec3& S, double dt) {
  const double angle = dt * (inverse * S).norm();
  if (angle == 0 || angle > large_turn) return mean_of(inverse, S, dt).spin;
  Turn turn;
  Vec3 now = S;
  for (const double part : {outer_part, 1 - 2 * outer_part, outer_part}) {
    const Mean mean = mean_of(inverse, now, part * dt);
    const Vec3 half = 0.5 * part * dt * mean.spin;
    turn = {turn.real - half.dot(turn.vector), turn.vector + turn.real * half + turn.vector.cross(half)};
    now += part * dt * mean.momentum.cross(mean.spin);
  }
  return 2 / (dt * turn.real) * turn.vector;
}

/// Inertia about the fixed axis of a body that has one. [kg m2]
double about_axis(const Body& body) { return body.hold.axis.dot(body.mass.inertia * body.hold.axis); }

}  // namespace

Body make_body(const std::string& name, const MassProperties& mass, const Vectors& X, const Subset& nodes) {
  Body body{.name = name, .mass = mass, .inverse = mass.inertia.inverse(), .nodes = nodes,
            .arm = Vectors(3, static_cast<Eigen::Index>(nodes.size())), .hold = {}};
  for (std::size_t i = 0; i < nodes.size(); ++i) body.arm.col(static_cast<Eigen::Index>(i)) = X.col(nodes[i]) - mass.centre;
  return body;
}

Vec3 change_by(const Turn& turn, const Vec3& a) {
  const Vec3 twice = 2 * turn.vector.cross(a);
  return turn.real * twice + turn.vector.cross(twice);
}

Vec3 turned(const Turn& turn, const Vec3& a) { return a + change_by(turn, a); }

Vec3 turned_back(const Turn& turn, const Vec3& a) { return a + change_by({turn.real, -turn.vector}, a); }

Mat3 matrix(const Turn& turn) {
  const Mat3 q = cross_matrix(turn.vector);
  return Mat3::Identity() + 2 * turn.real * q + 2 * q * q;
}

Mat3 inertia_now(const Body& body, const State& now) {
  const Mat3 R = matrix(now.turn);
  return R * body.mass.inertia * R.transpose();
}

Mat3 response_of_shift(const Body& body) { return body.hold.shift / body.mass.mass; }

Mat3 response_of_spin(const Body& body, const State& now) {
  if (body.hold.turns == 0) return Mat3::Zero();
  if (body.hold.turns == 1) return body.hold.axis * body.hold.axis.transpose() / about_axis(body);
  const Mat3 R = matrix(now.turn);
  return R * body.inverse * R.transpose();
}

Vec3 centre(const Body& body, const State& now) { return body.mass.centre + now.shift; }

Vec3 velocity(const Body& body, const State& now) { return now.momentum / body.mass.mass; }

Vec3 angular_velocity(const Body& body, const State& now) {
  return turned(now.turn, body.inverse * turned_back(now.turn, now.angular_momentum));
}

double kinetic_energy(const Body& body, const State& now) {
  const Vec3 S = turned_back(now.turn, now.angular_momentum);
  return 0.5 * now.momentum.squaredNorm() / body.mass.mass + 0.5 * S.dot(body.inverse * S);
}

void kick(const Body& body, const Vec3& impulse, const Vec3& angular_impulse, State& now) {
  now.momentum += body.hold.shift * impulse;
  if (body.hold.turns == 3) now.angular_momentum += angular_impulse;
  else if (body.hold.turns == 1)
    now.angular_momentum += inertia_now(body, now) * (body.hold.axis.dot(angular_impulse) / about_axis(body) * body.hold.axis);
}

void set_velocities(const Body& body, const Vec3& velocity, const Vec3& spin, State& now) {
  now.momentum = body.mass.mass * velocity;
  now.angular_momentum = inertia_now(body, now) * spin;
}

Twist twist_of(const Body& body, const State& now, double dt) {
  if (body.hold.turns < 3) return {velocity(body, now), angular_velocity(body, now)};  // about an axis that stays
  return {velocity(body, now), turned(now.turn, spin_of_step(body.inverse, turned_back(now.turn, now.angular_momentum), dt))};
}

void drift(const Body& body, const Twist& twist, double dt, State& now) {
  now.shift += dt * twist.velocity;
  if (twist.spin.isZero(0)) return;
  const Vec3 half = 0.5 * dt * twist.spin;
  const Turn before = now.turn;
  now.turn.real = before.real - half.dot(before.vector);
  now.turn.vector = before.vector + before.real * half + half.cross(before.vector);
  const double length = std::sqrt(now.turn.real * now.turn.real + now.turn.vector.squaredNorm());
  now.turn.real /= length, now.turn.vector /= length;
  if (body.hold.turns < 3) now.angular_momentum = inertia_now(body, now) * twist.spin;
}

Vec3 velocity_at(const Twist& twist, const Vec3& arm, double dt) {
  const Vec3 along = twist.spin.cross(arm);
  return twist.velocity + (along + 0.5 * dt * twist.spin.cross(along)) / (1 + 0.25 * dt * dt * twist.spin.squaredNorm());
}

Mat3 turn_in_step(const Twist& twist, const Turn& before, double dt) {
  const Mat3 w = cross_matrix(twist.spin);
  return dt / (1 + 0.25 * dt * dt * twist.spin.squaredNorm()) * (w + 0.5 * dt * w * w) * matrix(before);
}

void place_nodes(const Body& body, const State& now, const Vectors& X, Vectors& x) {
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    const Index node = body.nodes[i];
    x.col(node) = X.col(node) + (now.shift + change_by(now.turn, body.arm.col(static_cast<Eigen::Index>(i))));
  }
}

void set_node_velocities(const Body& body, const State& now, Vectors& v) {
  const Vec3 of_centre = velocity(body, now), spin = angular_velocity(body, now);
  for (std::size_t i = 0; i < body.nodes.size(); ++i)
    v.col(body.nodes[i]) = of_centre + spin.cross(turned(now.turn, body.arm.col(static_cast<Eigen::Index>(i))));
}

Twist fit(const Body& body, const Vectors& v) {
  const auto count = static_cast<double>(body.nodes.size());
  const Vec3 middle = body.arm.rowwise().mean();
  Vec3 mean = Vec3::Zero(), turning = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
  for (const Index node : body.nodes) mean += v.col(node) / count;
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    const Vec3 r = body.arm.col(static_cast<Eigen::Index>(i)) - middle;
    turning += r.cross(v.col(body.nodes[i]) - mean);
    inertia += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
  }
  const Vec3 spin = inertia.inverse() * turning;
  return {mean - spin.cross(middle), spin};
}

Scalars shares_of_mass(const Body& body, const Scalars& mass) {
  const auto count = static_cast<Eigen::Index>(body.nodes.size());
  Scalars share(count);
  double sum = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec3 r = body.arm.col(i);
    share(i) = mass(body.nodes[static_cast<std::size_t>(i)]);
    sum += share(i), first += share(i) * r, second += share(i) * r * r.transpose();
  }
  // k (1 + b . r) with  sum + b . first = mass / k  and  first + second b = 0
  const Vec3 b = -second.inverse() * first;
  const double k = body.mass.mass / (sum + b.dot(first));
  for (Eigen::Index i = 0; i < count; ++i) share(i) *= k * (1 + b.dot(body.arm.col(i)));
  return share;
}

double safe_share(const Body& body, const Scalars& mass) {
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  double size2 = 0;
  for (Eigen::Index i = 0; i < body.arm.cols(); ++i) size2 = std::max(size2, body.arm.col(i).squaredNorm());
  const double size = std::sqrt(size2);  // the same units in both halves
  Mat6 of_nodes = Mat6::Zero(), of_body = Mat6::Zero();
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    Eigen::Matrix<double, 3, 6> motion;
    motion << Mat3::Identity(), -cross_matrix(body.arm.col(static_cast<Eigen::Index>(i)) / size);
    of_nodes += mass(body.nodes[i]) * motion.transpose() * motion;
  }
  of_body.topLeftCorner<3, 3>() = body.mass.mass * Mat3::Identity();
  of_body.bottomRightCorner<3, 3>() = body.mass.inertia / (size * size);
  return 1 / eigenvalues(of_nodes, of_body).maxCoeff();
}

}  // namespace nereid::rigid
