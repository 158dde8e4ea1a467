#pragma once
// What the tests of hexahedra share: shapes, motions, and one element that remembers.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "base/dense.hpp"
#include "base/types.hpp"
#include "element/full_hexahedron.hpp"
#include "material/laws.hpp"
#include "tests/base/chance.hpp"
#include "tests/element/metal.hpp"

namespace nereid::element {

using material::Elastic;
using material::J2Bilinear;
using material::J2JohnsonCook;
using material::J2Mixed;
using material::Laws;
using Point = Vector<double>;
using Corners = std::array<Point, 8>;
using Matrix24 = Eigen::MatrixXd;  // 24 x 24; of a fixed size it compiles far longer

constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                            {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

inline Chance chance(7);
inline double random(double low = -1.0, double high = 1.0) {
  return std::uniform_real_distribution<double>(low, high)(chance);
}
inline Point random_point(double size) { return {size * random(), size * random(), size * random()}; }
inline Corners random_field(double size) {
  Corners field;
  for (Point& p : field) p = random_point(size);
  return field;
}

inline Corners brick(double hx, double hy, double hz) {
  Corners x;
  for (int i = 0; i < 8; ++i)
    x[i] = {0.5 * hx * sign[i][0], 0.5 * hy * sign[i][1], 0.5 * hz * sign[i][2]};
  return x;
}
inline Corners sum(const Corners& a, const Corners& b, double factor = 1.0) {
  Corners c;
  for (int i = 0; i < 8; ++i) c[i] = a[i] + factor * b[i];
  return c;
}
inline Corners distorted(double amount) { return sum(brick(1.0, 1.1, 0.9), random_field(amount)); }

inline Mat3 random_rotation(double most = 3.0) {
  return Eigen::AngleAxisd(random(-most, most), Vec3(random(), random(), random()).normalized())
      .toRotationMatrix();
}
inline Point times(const Mat3& A, const Point& p) {
  const Vec3 q = A * Vec3(p.x, p.y, p.z);
  return {q.x(), q.y(), q.z()};
}
inline Corners times(const Mat3& A, const Corners& x) {
  Corners y;
  for (int i = 0; i < 8; ++i) y[i] = times(A, x[i]);
  return y;
}
inline Mat3 full(const Symmetric<double>& s) {
  Mat3 m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}
inline Symmetric<double> symmetric(const Mat3& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)};
}

inline double product(const Corners& a, const Corners& b) {
  double s = 0;
  for (int i = 0; i < 8; ++i) s += dot(a[i], b[i]);
  return s;
}
inline double largest(const Corners& a) {
  double s = 0;
  for (const Point& p : a) s = std::max({s, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return s;
}

/// Logarithmic strain xy of simple shear by an angle whose tangent this is; that of xx is half the tangent times it. [-]
inline double logarithmic_shear(double tangent) { return 2 * std::asinh(0.5 * tangent) / std::sqrt(4 + tangent * tangent); }

const Viscosity no_viscosity{.linear = 0, .quadratic = 0};

inline Modes<double> amplitudes(const Corners& x) {
  Corners eighth;
  for (int i = 0; i < 8; ++i) eighth[i] = 0.125 * x[i];
  return sums_by_mode(eighth);
}

inline Symmetric<double> random_tensor(double size) {
  return {size * random(), size * random(), size * random(), size * random(), size * random(), size * random()};
}

/// Every stress that an element remembers, every tensor of its law, and every force of its hourglasses.
template <class Law>
std::vector<Symmetric<double>*> stresses(Hexahedron::Memory<double, Law>& memory) {
  return {&memory.stress};
}
template <class Law>
std::vector<Symmetric<double>*> stresses(FullHexahedron::Memory<double, Law>& memory) {
  std::vector<Symmetric<double>*> all;
  for (auto& point : memory.points) all.push_back(&point.stress);
  return all;
}
template <class Law>
std::vector<Symmetric<double>*> tensors(Hexahedron::Memory<double, Law>& memory) {
  std::vector<Symmetric<double>*> all;
  for (auto& tensor : memory.internal.tensor) all.push_back(&tensor);
  return all;
}
template <class Law>
std::vector<Symmetric<double>*> tensors(FullHexahedron::Memory<double, Law>& memory) {
  std::vector<Symmetric<double>*> all;
  for (auto& point : memory.points)
    for (auto& tensor : point.internal.tensor) all.push_back(&tensor);
  return all;
}
template <class Law>
std::vector<Point*> hourglasses(Hexahedron::Memory<double, Law>& memory) {
  std::vector<Point*> all;
  for (Point& q : memory.hourglass) all.push_back(&q);
  return all;
}
template <class Law>
std::vector<Point*> hourglasses(FullHexahedron::Memory<double, Law>&) {
  return {};
}

/// What the hourglass forces of an element hold as those of assumed strains. [J]
template <class Law>
void remember_store(const Law& law, const Corners& x, Hexahedron::Memory<double, Law>& memory) {
  const Modes<double> X = amplitudes(x);
  const auto frame = centre_frame<double>({X.xi, X.eta, X.zeta});
  memory.bent = energy_of(frame, moments_of(frame, memory.hourglass), volume_gradient(X).per_volume, law.young, law.poisson);
}
template <class Law>
void remember_store(const Law&, const Corners&, FullHexahedron::Memory<double, Law>&) {}

/// One element of a kind.
template <class Kind, class Law>
struct OneElement {
  Law law;
  typename Kind::Options options;
  Corners X;
  typename Kind::template Constants<double> constants = element::constants(law, options, X);
  typename Kind::template Memory<double, Law> memory{};
  Corners x = X, force{};
  Shares<double, 3> share{1, 1, 1};  // of the viscosity

  auto step(const Corners& to, const Corners& du, double dt) {
    x = to;
    return advance(law, options, constants, share, to, du, dt, memory, force);
  }
  auto move(const Corners& to, double dt = 1.0) { return step(to, sum(to, x, -1.0), dt); }
  /// forces of the present state
  void rest() { step(x, Corners{}, 1.0); }

  void randomise(double stress) {
    for (auto* s : stresses(memory)) *s = random_tensor(stress);
    for (auto* tensor : tensors(memory)) *tensor = 0.3 * material::deviator(random_tensor(stress));
    for (Point* q : hourglasses(memory)) *q = random_point(0.1 * stress);  // below the fully plastic moment
    remember_store(law, x, memory);
    rest();  // what it remembers of stresses besides follows
  }
  /// turns all that the memory holds
  void turn(const Mat3& R) {
    const auto both = {stresses(memory), tensors(memory)};
    for (const auto& list : both)
      for (auto* s : list) *s = symmetric(R * full(*s) * R.transpose());
    for (Point* q : hourglasses(memory)) *q = times(R, *q);
  }
};

/// Largest difference of what two elements remember, turned: their tensors, then their hourglass forces.
template <class Kind, class Law>
double difference_of_memory(OneElement<Kind, Law> turned, OneElement<Kind, Law> still, const Mat3& R) {
  still.turn(R);
  double most = 0;
  const auto compare = [&most](const auto& a, const auto& b) {
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (full(*a[i]) - full(*b[i])).norm());
  };
  compare(stresses(turned.memory), stresses(still.memory));
  compare(tensors(turned.memory), tensors(still.memory));
  const auto a = hourglasses(turned.memory), b = hourglasses(still.memory);
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, norm(*a[i] - *b[i]));
  return most;
}

/// The stiffness of an unstressed element. Forces are proportional to the increment, so nothing
/// cancels; taking both directions leaves an error of second order in the increment.
template <class Kind, class Law>
Matrix24 stiffness(const OneElement<Kind, Law>& e) {
  constexpr double small = 1e-6;
  Matrix24 K(24, 24);
  for (int j = 0; j < 24; ++j) {
    Corners u{};
    u[j / 3][j % 3] = small;
    OneElement<Kind, Law> there{e.law, e.options, e.X}, back{e.law, e.options, e.X};
    there.step(e.X, u, 1.0);
    back.step(e.X, sum(Corners{}, u, -1.0), 1.0);
    for (int i = 0; i < 24; ++i)
      K(i, j) = -(there.force[i / 3][i % 3] - back.force[i / 3][i % 3]) / (2.0 * small);
  }
  return K;
}

template <class Kind, class Law>
Eigen::VectorXd stiffness_eigenvalues(const OneElement<Kind, Law>& e) {
  const Matrix24 K = stiffness(e);
  const Matrix24 symmetrised = 0.5 * (K + K.transpose());
  return eigenvalues(symmetrised);
}

template <class Kind, class Law>
double largest_eigenvalue_of(const OneElement<Kind, Law>& e) {
  return 8.0 / e.constants.mass * stiffness_eigenvalues(e).maxCoeff();
}

template <class Kind, class Law>
double hot_bound(OneElement<Kind, Law> e) {
  const double step = e.step(e.X, Corners{}, 1.0).step;
  return 4.0 / (step * step);
}

/// A random element that is no brick: its shape, and nodes moved by a part of the shortest side.
inline Corners random_shape(double part) {
  const Point h{random(0.3, 2.0), random(0.3, 2.0), random(0.3, 2.0)};
  return sum(brick(h.x, h.y, h.z), random_field(part * std::min({h.x, h.y, h.z})));
}

/// Kinetic energy of a free element after some steps of a factor times its exact limit, over that at the start.
template <class Kind, class Law>
double growth(OneElement<Kind, Law> e, double factor) {
  const double dt = factor * 2 / std::sqrt(largest_eigenvalue_of(e));
  std::mt19937 same(3);
  std::uniform_real_distribution<double> speed(-1e-12, 1e-12);
  Corners v;
  for (Point& p : v) p = {speed(same), speed(same), speed(same)};
  const double start = product(v, v);
  double most = 0;
  for (int step = 0; step < 60; ++step) {
    Corners du;
    for (int i = 0; i < 8; ++i) {
      v[i] = v[i] + (8 * dt / e.constants.mass) * e.force[i];
      du[i] = dt * v[i];
    }
    e.move(sum(e.x, du), dt);
    most = std::max(most, product(v, v));
  }
  return most / start;
}

/// The patch of MacNeal & Harder, Finite Elements in Analysis and Design 1 (1985) 3: a unit cube of seven
/// distorted hexahedra; nodes 0 to 7 are inner ones.
struct SevenElements {
  std::array<Point, 16> X;
  std::vector<std::array<int, 8>> nodes;
  Corners corners(std::size_t element) const {
    Corners c;
    for (int i = 0; i < 8; ++i) c[i] = X[nodes[element][i]];
    return c;
  }
};
inline SevenElements seven_elements() {
  const Corners inner{{{0.249, 0.342, 0.192},
                       {0.826, 0.288, 0.288},
                       {0.850, 0.649, 0.263},
                       {0.273, 0.750, 0.230},
                       {0.320, 0.186, 0.643},
                       {0.677, 0.305, 0.683},
                       {0.788, 0.693, 0.644},
                       {0.165, 0.745, 0.702}}};
  SevenElements patch;
  for (int i = 0; i < 8; ++i) {
    patch.X[i] = inner[i];
    patch.X[8 + i] = {0.5 + 0.5 * sign[i][0], 0.5 + 0.5 * sign[i][1], 0.5 + 0.5 * sign[i][2]};
  }
  const int face[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                          {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  patch.nodes = {{0, 1, 2, 3, 4, 5, 6, 7}};
  for (const auto& f : face)
    patch.nodes.push_back({f[0], f[1], f[2], f[3], 8 + f[0], 8 + f[1], 8 + f[2], 8 + f[3]});
  return patch;
}

/// Integrates f(J^-T grad N, det J) by the 2 x 2 x 2 rule of Gauss, exact for what is asked here.
template <class F>
void integrate(const Corners& x, F&& f) {
  const double g = 1.0 / std::sqrt(3.0);
  for (const auto& at : sign) {
    const double r[3] = {g * at[0], g * at[1], g * at[2]};
    Eigen::Matrix<double, 3, 8> by;
    Mat3 J = Mat3::Zero();
    for (int i = 0; i < 8; ++i) {
      const double a = 1 + sign[i][0] * r[0], b = 1 + sign[i][1] * r[1], c = 1 + sign[i][2] * r[2];
      by.col(i) << 0.125 * sign[i][0] * b * c, 0.125 * sign[i][1] * a * c,
          0.125 * sign[i][2] * a * b;
      J += Vec3(x[i].x, x[i].y, x[i].z) * by.col(i).transpose();
    }
    const Eigen::Matrix<double, 3, 8> gradients = J.inverse().transpose() * by;
    f(gradients, J.determinant());
  }
}

}  // namespace nereid::element
