#include "element/bending.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>

#include "mesh/box.hpp"

namespace nereid::element::bending_test {
namespace {

using Displacement = std::function<Vec3(const Vec3&)>;

/// What is uneven of a mesh whose nodes were displaced a little.
double uneven(mesh::Mesh mesh, const Displacement& u, const Hexahedron::Options& options = {}) {
  const AnyBlock block = hexahedra(mesh, "box", material::Elastic{1, 2, 0.3}, options);
  Memory memory = initial_memory(block);
  TileForces forces = tile_forces(block);
  TileReports reports = tile_reports(block);
  Vectors dx(3, mesh.X.cols());
  for (Eigen::Index n = 0; n < dx.cols(); ++n) dx.col(n) = 1e-6 * u(mesh.X.col(n));
  const Vectors x = mesh.X + dx;
  advance(block, x, dx, Vectors(), 1.0, memory, forces, reports);
  return uneven_bending(block, x, memory);
}

mesh::Mesh box(const Vec3& size, const Eigen::Vector3i& cells) { return mesh::box("box", {Vec3::Zero(), size, cells}); }

/// Of a cantilever under a force at its end.
Vec3 beam(const Vec3& X) { return {(X.z() - 0.5) * (X.x() - 0.05 * X.x() * X.x()), 0, 0}; }

TEST(UnevenBending, OfABeamOfOneLayerIsSmall) {
  EXPECT_LT(uneven(box({10, 1, 1}, {10, 1, 1}), beam), 0.05);
  EXPECT_LT(uneven(box({10, 4, 1}, {10, 4, 1}), beam), 0.05);
  EXPECT_LT(uneven(box({10, 1, 1}, {3, 1, 1}), beam), 0.3);
}

TEST(UnevenBending, OfCellsThatBendInTurnsIsAll) {
  const Displacement in_turns = [](const Vec3& X) -> Vec3 { return {(X.z() - 0.5) * std::cos(pi * X.x()), 0, 0}; };
  EXPECT_NEAR(uneven(box({10, 1, 1}, {10, 1, 1}), in_turns), 1, 1e-9);
  const Displacement board = [](const Vec3& X) -> Vec3 { return {0, 0, std::cos(pi * X.x()) * std::cos(pi * X.y())}; };
  EXPECT_NEAR(uneven(box({6, 6, 6}, {6, 6, 6}), board), 1, 0.1);
}

TEST(UnevenBending, OfCellsWithoutNeighboursAndOfSpringsIsAll) {
  EXPECT_EQ(uneven(box({1, 1, 1}, {1, 1, 1}), beam), 1);
  EXPECT_EQ(uneven(box({10, 1, 1}, {10, 1, 1}), beam,
                   {.hourglass = 0.1, .viscosity = {}, .hourglass_kind = Hexahedron::Hourglass::stiffness}), 1);
}

TEST(UnevenBending, OfCellsOfUnlikeLengthThatBendAlikeIsAFifthForTwiceAndHalfForFourTimes) {
  // M goes with the length: 1 - 2 a b/(a^2 + b^2)
  const Displacement alike = [](const Vec3& X) -> Vec3 { return {(X.z() - 0.5) * X.x(), 0, 0}; };
  for (const double times : {1.0, 2.0, 4.0}) {
    mesh::Mesh mesh = box({2, 1, 1}, {2, 1, 1});
    for (Eigen::Index n = 0; n < mesh.X.cols(); ++n)
      if (mesh.X(0, n) > 1.5) mesh.X(0, n) = 1 + times;
    EXPECT_NEAR(uneven(mesh, alike), 1 - 2 * times / (1 + times * times), 1e-6) << times;
  }
}

TEST(UnevenBending, OfABeamWhoseCellsLeanTooMuchIsAll) {
  for (const double by : {0.2, 0.5}) {
    mesh::Mesh all_alike = box({10, 1, 1}, {10, 1, 1}), in_turns = all_alike;
    for (Eigen::Index n = 0; n < all_alike.X.cols(); ++n) {
      const Vec3 X = all_alike.X.col(n);
      all_alike.X(0, n) += by * (X.z() - 0.5);
      in_turns.X(0, n) += by * (X.z() - 0.5) * std::cos(pi * X.x());
    }
    if (by < 0.35) {
      EXPECT_LT(uneven(all_alike, beam), 0.1);
      EXPECT_LT(uneven(in_turns, beam), 0.3);
    } else {
      EXPECT_EQ(uneven(all_alike, beam), 1);
      EXPECT_EQ(uneven(in_turns, beam), 1);
    }
  }
}

TEST(UnevenBending, DoesNotDependOnTheDirectionOfTheAxes) {
  const mesh::Mesh straight = box({5, 2, 1}, {5, 2, 1});
  const auto bent = [](const Vec3& X) -> Vec3 {
    return {(X.z() - 0.5) * std::sin(X.x()) + 0.3 * X.y() * X.z(), 0.4 * X.x() * X.z() * X.y(), 0.2 * std::cos(2 * X.x()) * X.y()};
  };
  const double uneven_straight = uneven(straight, bent);
  EXPECT_GT(uneven_straight, 0.05);
  EXPECT_LT(uneven_straight, 0.95);
  for (const double angle : {0.4, 1.1, 2.1}) {
    const Eigen::AngleAxisd turn(angle, Vec3(1, -2, 0.7).normalized());
    mesh::Mesh turned = straight;
    turned.X = turn.toRotationMatrix() * straight.X;
    const auto turned_bent = [&](const Vec3& x) -> Vec3 { return turn * bent(turn.inverse() * x); };
    // hourglass forces are differences of positions: round-off is 1e-16 of these over 1e-6 of the displacements
    EXPECT_NEAR(uneven(turned, turned_bent), uneven_straight, 1e-9) << angle;
  }
}

TEST(Bending, HasProductsThatDoNotDependOnTheDirectionOfTheAxes) {
  const std::array<Vector<double>, 8> corners{{{0, 0, 0}, {2, 0.1, 0}, {2.2, 1, 0.1}, {0.1, 1.1, 0}, {0, 0.2, 1}, {1.9, 0, 1.2}, {2, 1, 1},
                                               {0.2, 0.9, 1.1}}};
  const std::array<Vector<double>, 4> one{{{1, -2, 0.5}, {0.3, 0.8, -1.1}, {-0.7, 0.2, 2}, {0.4, -0.6, 0.9}}},
      other{{{-0.2, 0.6, 1.5}, {1.3, -0.1, 0.7}, {0.9, 1.2, -0.4}, {2, 0.3, -0.8}}};
  const auto turned = [](const Mat3& turn, auto vectors) {
    for (auto& v : vectors) {
      const Vec3 w = turn * Vec3(v.x, v.y, v.z);
      v = {w.x(), w.y(), w.z()};
    }
    return vectors;
  };
  const auto product = [](const Bending& a, const Bending& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.moment.size(); ++i) sum += a.moment[i] * b.moment[i];
    return sum;
  };
  const Bending a = bending_of(corners, one), b = bending_of(corners, other);
  for (const double angle : {0.4, 1.1, 2.1}) {
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3(1, -2, 0.7).normalized()).toRotationMatrix();
    const Bending c = bending_of(turned(turn, corners), turned(turn, one)), d = bending_of(turned(turn, corners), turned(turn, other));
    EXPECT_NEAR(product(c, c) / product(a, a), 1, 1e-12);
    EXPECT_NEAR(product(c, d) / std::sqrt(product(a, a) * product(b, b)), product(a, b) / std::sqrt(product(a, a) * product(b, b)), 1e-12);
    EXPECT_EQ(c.leans, a.leans);
  }
}

}  // namespace
}  // namespace nereid::element::bending_test
