#include "element/held.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>

#include "mesh/box.hpp"
#include "mesh/disc.hpp"

namespace nereid::element::held_test {
namespace {

using Displacement = std::function<Vec3(const Vec3&)>;
const material::Elastic elastic{1, 2, 0.3};

/// A mesh whose nodes were displaced a little: what its elements hold.
struct Displaced {
  Contrast contrast;
  double elastic = 0, hourglass = 0;  // of the ledger
};
Displaced displaced(const mesh::Mesh& mesh, const Displacement& u, const AnyHexahedronOptions& options = Hexahedron::Options{},
                    const material::AnyLaw& law = elastic) {
  const AnyBlock block = solids(mesh, "box", law, options);
  Memory memory = initial_memory(block);
  TileForces forces = tile_forces(block);
  TileReports reports = tile_reports(block);
  Vectors dx(3, mesh.X.cols());
  for (Eigen::Index n = 0; n < dx.cols(); ++n) dx.col(n) = 1e-6 * u(mesh.X.col(n));
  const Vectors x = mesh.X + dx;
  advance(block, x, dx, Vectors(), 1.0, memory, forces, reports);
  return {contrast(block, x, memory), memory.stored[Stored::elastic], memory.stored[Stored::hourglass]};
}
/// Bending above the neighbours over all of it.
double unlike(const mesh::Mesh& mesh, const Displacement& u, const Hexahedron::Options& options = {}) {
  const Displaced found = displaced(mesh, u, options);
  return found.contrast.bending / found.hourglass;
}
/// Strain energy above the density of the neighbours over all of it.
double concentrated(const mesh::Mesh& mesh, const Displacement& u, const AnyHexahedronOptions& options = Hexahedron::Options{}) {
  const Displaced found = displaced(mesh, u, options);
  return found.contrast.density / found.contrast.strain;
}

mesh::Mesh box(const Vec3& size, const Eigen::Vector3i& cells) { return mesh::box("box", {Vec3::Zero(), size, cells}); }

/// Of a cantilever under a force at its end.
Vec3 beam(const Vec3& X) { return {(X.z() - 0.5) * (X.x() - 0.05 * X.x() * X.x()), 0, 0}; }
/// Of a motion without any symmetry.
Vec3 any_motion(const Vec3& X) {
  return {(X.z() - 0.5) * std::sin(X.x()) + 0.3 * X.y() * X.z(), 0.4 * X.x() * X.z() * X.y(), 0.2 * std::cos(2 * X.x()) * X.y()};
}

TEST(HookeEnergy, IsTheWorkOfAStressOnItsStrain) {
  const material::Elastic law{1, 210e9, 0.29};
  const Symmetric<double> strain{1e-3, -4e-4, 2e-4, 3e-4, -6e-4, 5e-4}, stress = material::hooke(law, strain);
  EXPECT_NEAR(material::hooke_energy(law, stress) / (0.5 * contract(stress, strain)), 1, 1e-14);
}

TEST(Held, AddsUpToWhatTheLedgerSays) {
  const mesh::Mesh mesh = box({5, 2, 2}, {5, 2, 2});
  for (const AnyHexahedronOptions& options :
       {AnyHexahedronOptions(Hexahedron::Options{}), AnyHexahedronOptions(FullHexahedron::Options{}),
        AnyHexahedronOptions(Hexahedron::Options{.hourglass = 0.1, .viscosity = {}, .hourglass_kind = Hexahedron::Hourglass::stiffness})}) {
    const Displaced found = displaced(mesh, any_motion, options);
    EXPECT_NEAR(found.contrast.strain / (found.elastic + found.hourglass), 1, 1e-5) << options.index();
  }
}

TEST(Held, OfBothElementsIsAlike) {
  const mesh::Mesh mesh = box({5, 2, 2}, {5, 2, 2});
  const Contrast one = displaced(mesh, any_motion).contrast, eight = displaced(mesh, any_motion, FullHexahedron::Options{}).contrast;
  EXPECT_NEAR(eight.bending / one.bending, 1, 0.02);
  EXPECT_NEAR(eight.density / one.density, 1, 0.02);
  EXPECT_NEAR(eight.strain / one.strain, 1, 0.02);
}

TEST(Contrast, OfABeamOfOneLayerIsSmall) {
  for (const Eigen::Vector3i& cells : {Eigen::Vector3i(10, 1, 1), Eigen::Vector3i(5, 1, 1)}) {
    EXPECT_LT(unlike(box({10, 1, 1}, cells), beam), 0.05);
    EXPECT_LT(concentrated(box({10, 1, 1}, cells), beam), 0.05);
  }
}

TEST(Contrast, OfCellsThatBendInTurnsIsNone) {
  const mesh::Mesh mesh = box({10, 1, 1}, {10, 1, 1});
  const Displacement in_turns = [](const Vec3& X) -> Vec3 { return {(X.z() - 0.5) * std::cos(pi * X.x()), 0, 0}; };
  const Displaced turns = displaced(mesh, in_turns);
  EXPECT_GT(turns.hourglass, 0.5 * turns.contrast.strain);
  EXPECT_LT(turns.contrast.bending, 1e-9 * turns.contrast.strain) << "a known blind spot";
}

TEST(Contrast, OfUniformStrainIsNoneWhateverTheSizes) {
  mesh::Mesh mesh = box({3, 2, 2}, {3, 2, 2});
  for (Eigen::Index n = 0; n < mesh.X.cols(); ++n)
    if (mesh.X(0, n) > 2.5) mesh.X(0, n) = 7;
  const Displacement stretch = [](const Vec3& X) -> Vec3 { return {X.x() + 0.2 * X.y(), -0.3 * X.y(), 0.1 * X.z()}; };
  const Displaced found = displaced(mesh, stretch);
  EXPECT_LT(found.contrast.density, 1e-5 * found.contrast.strain);  // as the geometry changes
  EXPECT_LT(found.contrast.bending, 1e-9 * found.contrast.strain);
}

TEST(Contrast, OfANodeThatIsPushedIsMostOfItsElements) {
  // the 2 x 2 cells at the node have all the energy, and of what is around the nodes of each of them
  const double around = (1 + 2 * 0.5 + 0.25 + 0.5 + 2 * 0.25 + 0.125) / 8;
  const Displacement pushed = [](const Vec3& X) -> Vec3 { return Vec3(0, 0, (X - Vec3(3, 3, 3)).norm() < 0.1 ? -1 : 0); };
  for (const AnyHexahedronOptions& options :
       {AnyHexahedronOptions(Hexahedron::Options{}), AnyHexahedronOptions(FullHexahedron::Options{})}) {
    EXPECT_NEAR(concentrated(box({6, 6, 3}, {6, 6, 3}), pushed, options), 1 - around, 1e-4);
  }
  EXPECT_GT(unlike(box({6, 6, 3}, {6, 6, 3}), pushed), 0.4);
}

TEST(Contrast, OfOneCellIsByTheMeansAtItsNodes) {
  // two cells of which one bends: four nodes of each are shared, so its mean there is 1/2 h, and 3/4 h of all
  const Displacement one_bends = [](const Vec3& X) -> Vec3 { return {X.x() > 1.5 ? X.z() - 0.5 : 0, 0, 0}; };
  EXPECT_NEAR(unlike(box({2, 1, 1}, {2, 1, 1}), one_bends), 0.25, 1e-9);
}

TEST(Contrast, OfCellsWithoutNeighboursAndOfSpringsIsAllOfTheirBending) {
  EXPECT_NEAR(unlike(box({1, 1, 1}, {1, 1, 1}), beam), 1, 1e-6);
  EXPECT_NEAR(unlike(box({10, 1, 1}, {10, 1, 1}), beam,
                     {.hourglass = 0.1, .viscosity = {}, .hourglass_kind = Hexahedron::Hourglass::stiffness}), 1, 1e-6);
}

TEST(Contrast, OfCellsThatLeanTooMuchIsAllOfTheirBending) {
  for (const double by : {0.2, 0.5}) {
    mesh::Mesh all_alike = box({10, 1, 1}, {10, 1, 1}), in_turns = all_alike;
    for (Eigen::Index n = 0; n < all_alike.X.cols(); ++n) {
      const Vec3 X = all_alike.X.col(n);
      all_alike.X(0, n) += by * (X.z() - 0.5);
      in_turns.X(0, n) += by * (X.z() - 0.5) * std::cos(pi * X.x());
    }
    for (const mesh::Mesh& mesh : {all_alike, in_turns}) {
      if (by < 0.35) EXPECT_LT(unlike(mesh, beam), 0.1);
      else EXPECT_NEAR(unlike(mesh, beam), 1, 1e-6);
    }
  }
}

TEST(Contrast, DoesNotDependOnTheDirectionOfTheAxesOrOnUnits) {
  const mesh::Mesh straight = box({5, 2, 1}, {5, 2, 1});
  const Displaced found = displaced(straight, any_motion);
  const double bending = found.contrast.bending / found.contrast.strain, density = found.contrast.density / found.contrast.strain;
  EXPECT_GT(bending, 0.005);
  EXPECT_GT(density, 0.05);
  for (const double angle : {0.4, 1.1, 2.1}) {
    const Eigen::AngleAxisd turn(angle, Vec3(1, -2, 0.7).normalized());
    mesh::Mesh turned = straight;
    turned.X = turn.toRotationMatrix() * straight.X;
    const auto turned_motion = [&](const Vec3& x) -> Vec3 { return turn * any_motion(turn.inverse() * x); };
    const Contrast there = displaced(turned, turned_motion).contrast;
    // displacements are differences of positions: round-off is 1e-16 of these over 1e-6 of the displacements
    EXPECT_NEAR(there.bending / there.strain, bending, 1e-9) << angle;
    EXPECT_NEAR(there.density / there.strain, density, 1e-9) << angle;
  }
  const Contrast stiffer = displaced(straight, any_motion, Hexahedron::Options{}, material::Elastic{7, 2e9, 0.3}).contrast;
  EXPECT_NEAR(stiffer.bending / stiffer.strain, bending, 1e-12);
}

TEST(Contrast, OfPlatesIsNone) {
  const mesh::Mesh mesh = mesh::sheet("box", {1, 1, 2, 2, mesh::Cuts::columns});
  const AnyBlock block = plates(mesh, "box", elastic, {.thickness = 0.1, .viscosity = {}});
  EXPECT_EQ(contrast(block, mesh.X, initial_memory(block)).strain, 0);
}

}  // namespace
}  // namespace nereid::element::held_test
