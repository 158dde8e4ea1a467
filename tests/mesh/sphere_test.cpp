#include "mesh/sphere.hpp"

#include <gtest/gtest.h>

#include "base/check.hpp"
#include "tests/mesh/measures.hpp"

namespace nereid::mesh::sphere_test {
namespace {

using namespace measures;

constexpr double radius = 0.3;

Mesh sample(SpherePart part, int cells = 3) { return sphere("ball", {radius, part, cells, cells}); }
const Table<8>& elements(const Mesh& mesh) { return hexahedra(mesh, "ball").nodes; }

const std::pair<SpherePart, int> parts[] = {
    {SpherePart::full, 1}, {SpherePart::half, 2}, {SpherePart::quarter, 4}, {SpherePart::eighth, 8}};

TEST(Sphere, VolumeTendsToThatOfTheBallAtSecondOrder) {
  double error_before = 0;
  for (const int cells : {1, 2, 4, 8}) {
    const Mesh mesh = sample(SpherePart::eighth, cells);
    const double error = 1 - trilinear_volume(mesh, elements(mesh)) / (pi / 6 * std::pow(radius, 3));
    RecordProperty("volume_missing_" + std::to_string(cells), std::to_string(error));
    EXPECT_GT(error, 0);
    if (cells > 1) {
      EXPECT_NEAR(std::log2(error_before / error), 2, 0.2);  // the next order shows at the coarsest pair
    }
    error_before = error;
  }
  EXPECT_LT(error_before, 0.006);
}

TEST(Sphere, HasWellShapedElementsWithEdgesWithinAFactor) {
  for (int cells = 1; cells <= 6; ++cells) {
    const Mesh mesh = sample(SpherePart::eighth, cells);
    const double jacobian = scaled_jacobian(mesh, elements(mesh));
    RecordProperty("scaled_jacobian_" + std::to_string(cells), std::to_string(jacobian));
    EXPECT_GT(jacobian, 0.70) << cells;
    double shortest = radius, longest = 0;
    for (Index e = 0; e < elements(mesh).cols(); ++e) {
      for (const Corner& corner : corners) {
        const Mat3 edges = edges_at(mesh, elements(mesh), e, corner);
        shortest = std::min(shortest, edges.colwise().norm().minCoeff());
        longest = std::max(longest, edges.colwise().norm().maxCoeff());
      }
    }
    EXPECT_LT(longest, 2.2 * shortest) << cells;
    EXPECT_GT(shortest, 0.36 * radius / cells) << cells;
  }
}

TEST(Sphere, PartsAreThatPartOfTheWholeWithPositiveVolumes) {
  const Mesh whole = sample(SpherePart::full);
  for (const auto& [part, share] : parts) {
    const Mesh mesh = sample(part);
    EXPECT_EQ(elements(mesh).cols() * share, elements(whole).cols());
    EXPECT_GT(smallest_volume(mesh, elements(mesh)), 0);
    EXPECT_NEAR(trilinear_volume(mesh, elements(mesh)) * share / trilinear_volume(whole, elements(whole)), 1, 1e-13);  // round-off
  }
}

TEST(Sphere, SurfaceIsWatertightWithItsNodesOnTheSphereAndNormalsOutwards) {
  const Mesh whole = sample(SpherePart::full);
  const Table<3>& facets = surface(whole, "ball.surface").facets;
  Sides sides;
  add_sides(facets, sides);
  EXPECT_EQ(open_sides(sides), 0);
  EXPECT_EQ(euler_characteristic(facets), 2);
  for (const auto& [part, share] : parts) {
    const Mesh mesh = sample(part);
    EXPECT_EQ(surface(mesh, "ball.surface").facets.cols() * share, facets.cols());
    EXPECT_GT(worst_normal(mesh, surface(mesh, "ball.surface").facets, [](const Vec3& at) -> Vec3 { return at; }), std::cos(0.16));
    for (const Index node : node_set(mesh, "ball.surface")) EXPECT_NEAR(mesh.X.col(node).norm() / radius, 1, 1e-14);
    EXPECT_EQ(node_set(mesh, "ball.surface"),
              nodes_where(mesh, [](const Vec3& at) { return at.norm() > radius * (1 - 1e-12); }));
  }
}

TEST(Sphere, PartsHaveThePlanesThatCutThem) {
  const std::vector<std::pair<SpherePart, std::string>> cuts{
      {SpherePart::full, ""}, {SpherePart::half, "z"}, {SpherePart::quarter, "xy"}, {SpherePart::eighth, "xyz"}};
  for (const auto& [part, axes] : cuts) {
    const Mesh mesh = sample(part);
    for (int axis = 0; axis < 3; ++axis) {
      const char letter = "xyz"[axis];
      const std::string set = std::string("ball.") + letter + "_plane";
      if (axes.find(letter) == std::string::npos) {
        EXPECT_THROW(node_set(mesh, set), InternalError);
        continue;
      }
      EXPECT_GE(mesh.X.row(axis).minCoeff(), 0);
      EXPECT_EQ(node_set(mesh, set), nodes_where(mesh, [axis](const Vec3& at) { return at(axis) == 0; }));
    }
  }
}

TEST(Sphere, IsMirroredBitForBit) {
  const Mesh whole = sample(SpherePart::full, 2);
  for (const int axis : {0, 1, 2}) {
    EXPECT_TRUE(is_mirrored<8>(whole, elements(whole), {1, 0, 3, 2, 5, 4, 7, 6}, axis));
    EXPECT_TRUE(is_mirrored<3>(whole, surface(whole, "ball.surface").facets, {1, 0, 2}, axis));
  }
}

TEST(Sphere, HasSixFacetsAtEachNodeOfItsSurfaceButEightOnTheAxesAndFourMidwayBetweenThem) {
  const Mesh whole = sample(SpherePart::full);
  std::map<Index, int> facets_at;
  const Table<3>& facets = surface(whole, "ball.surface").facets;
  for (const Index node : facets.reshaped()) ++facets_at[node];
  for (const auto& [node, count] : facets_at) {
    const Vec3 at = whole.X.col(node).cwiseAbs();
    const auto zeros = (at.array() == 0).count();
    const bool midway = zeros == 1 && std::abs(at.maxCoeff() - radius * std::sqrt(0.5)) < 1e-12;
    EXPECT_EQ(count, zeros == 2 ? 8 : midway ? 4 : 6);
  }
}

TEST(Sphere, RefusesEmptyShapes) {
  EXPECT_THROW(sphere("ball", {0, SpherePart::full, 1, 1}), InternalError);
  EXPECT_THROW(sphere("ball", {1, SpherePart::full, 1, 0}), InternalError);
}

}  // namespace
}  // namespace nereid::mesh::sphere_test
