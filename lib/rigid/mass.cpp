#include "rigid/mass.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "base/dense.hpp"

namespace nereid::rigid {

namespace {

void add(const Vec3& r, double mass, Moments& sum) {
  sum.mass += mass;
  sum.first += mass * r;
  sum.second += mass * r * r.transpose();
}

/// Natural coordinates of the nodes of a hexahedron.
constexpr int corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};

}  // namespace

void add_hexahedra(const Vectors& X, const Table<8>& nodes, double density, const Vec3& about, Moments& sum) {
  const double far = std::sqrt(0.6);
  const std::array<double, 3> point{-far, 0, far}, weight{5.0 / 9, 8.0 / 9, 5.0 / 9};
  for (Eigen::Index e = 0; e < nodes.cols(); ++e) {
    Eigen::Matrix<double, 3, 8> r;
    for (int a = 0; a < 8; ++a) r.col(a) = X.col(nodes(a, e)) - about;
    for (int i = 0; i < 27; ++i) {
      const int at[3] = {i % 3, i / 3 % 3, i / 9};
      Eigen::Matrix<double, 8, 1> shape;
      Eigen::Matrix<double, 8, 3> slope;
      for (int a = 0; a < 8; ++a) {
        const double one[3] = {1 + corner[a][0] * point[at[0]], 1 + corner[a][1] * point[at[1]], 1 + corner[a][2] * point[at[2]]};
        shape(a) = one[0] * one[1] * one[2] / 8;
        slope(a, 0) = corner[a][0] * one[1] * one[2] / 8;
        slope(a, 1) = corner[a][1] * one[2] * one[0] / 8;
        slope(a, 2) = corner[a][2] * one[0] * one[1] / 8;
      }
      const double volume = weight[at[0]] * weight[at[1]] * weight[at[2]] * Mat3(r * slope).determinant();
      add(r * shape, density * volume, sum);
    }
  }
}

void add_plates(const Vectors& X, const Table<3>& nodes, double density, double thickness, const Vec3& about, Moments& sum) {
  for (Eigen::Index e = 0; e < nodes.cols(); ++e) {
    const Vec3 r[3] = {X.col(nodes(0, e)) - about, X.col(nodes(1, e)) - about, X.col(nodes(2, e)) - about};
    const Vec3 twice = (r[1] - r[0]).cross(r[2] - r[0]), n = twice.normalized(), s = r[0] + r[1] + r[2];
    const double mass = density * thickness * twice.norm() / 2;
    sum.mass += mass;
    sum.first += mass / 3 * s;
    for (const Vec3& one : r) sum.second += mass / 12 * one * one.transpose();
    sum.second += mass / 12 * (s * s.transpose() + thickness * thickness * n * n.transpose());
  }
}

void add_point(const Vec3& X, double mass, const Vec3& about, Moments& sum) { add(X - about, mass, sum); }

MassProperties properties(const Moments& sum, const Vec3& about) {
  const Vec3 d = sum.first / sum.mass;
  const Mat3 second = sum.second - sum.mass * d * d.transpose();
  return {sum.mass, about + d, second.trace() * Mat3::Identity() - second};
}

bool is_possible(const Mat3& inertia) {
  if (!inertia.allFinite()) return false;
  const Vec3 moment = eigenvalues(inertia);
  return moment(0) > 0 && moment(2) <= (1 + 1e-9) * (moment(0) + moment(1));
}

}  // namespace nereid::rigid
