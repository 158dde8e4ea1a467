#include "mesh/cylinder.hpp"

#include <gtest/gtest.h>

#include "base/check.hpp"
#include "tests/mesh/measures.hpp"

namespace nereid::mesh::cylinder_test {
namespace {

using namespace measures;

constexpr double radius = 0.3, length = 0.7;

Mesh sample(Revolution turn, int cells = 3) {
  return cylinder("lead", {radius, length, turn, cells, cells, cells + 1});
}

const Table<8>& elements(const Mesh& mesh) { return hexahedra(mesh, "lead").nodes; }

TEST(Cylinder, EveryHexahedronHasPositiveVolume) {
  for (const Revolution turn : {Revolution::quarter, Revolution::full}) {
    for (int core = 1; core <= 4; ++core) {
      for (int ring = 1; ring <= 4; ++ring) {
        const Mesh mesh = cylinder("lead", {radius, length, turn, core, ring, 2});
        EXPECT_GT(smallest_volume(mesh, elements(mesh)), 0) << core << ' ' << ring;
      }
    }
  }
}

TEST(Cylinder, HasTheVolumeOfItsPolygonAndSoConvergesAtSecondOrder) {
  double error_before = 0;
  for (const int cells : {1, 2, 4, 8}) {
    const Mesh mesh = sample(Revolution::full, cells);
    const double around = 8 * cells, got = volume(mesh, elements(mesh));
    const double polygon = around / 2 * std::sin(2 * pi / around) * radius * radius * length;
    EXPECT_NEAR(got, polygon, 1e-13);  // round-off
    const double error = pi * radius * radius * length - got;
    // The next term of the sine's series is below 0.1 of the order at the coarsest pair.
    if (cells > 1) {
      EXPECT_NEAR(std::log2(error_before / error), 2, 0.1);
    }
    error_before = error;
  }
}

TEST(Cylinder, HasWellShapedElements) {
  for (int cells = 1; cells <= 8; ++cells) {
    const Mesh mesh = sample(Revolution::quarter, cells);
    EXPECT_GT(scaled_jacobian(mesh, elements(mesh)), 0.81) << cells;
  }
}

TEST(Cylinder, HasEdgesWithinAFactorOfTwoInASection) {
  for (int cells = 1; cells <= 8; ++cells) {
    const Mesh mesh = sample(Revolution::quarter, cells);
    double shortest = radius, longest = 0;
    for (Index element = 0; element < elements(mesh).cols(); ++element) {
      for (int a = 0; a < 4; ++a) {
        const Index node = elements(mesh)(a, element), next = elements(mesh)((a + 1) % 4, element);
        const double edge = (mesh.X.col(next) - mesh.X.col(node)).norm();
        shortest = std::min(shortest, edge);
        longest = std::max(longest, edge);
      }
    }
    EXPECT_LT(longest, 2 * shortest) << cells;
    EXPECT_GT(shortest, 0.41 * radius / cells) << cells;
    EXPECT_LT(longest, 0.79 * radius / cells) << cells;
  }
}

TEST(Cylinder, HasOutwardNormals) {
  for (const Revolution turn : {Revolution::quarter, Revolution::full}) {
    const Mesh mesh = sample(turn);
    const auto up = [](const Vec3&) -> Vec3 { return Vec3::UnitZ(); };
    const auto down = [](const Vec3&) -> Vec3 { return -Vec3::UnitZ(); };
    EXPECT_NEAR(worst_normal(mesh, surface(mesh, "lead.top").facets, up), 1, 1e-14);
    EXPECT_NEAR(worst_normal(mesh, surface(mesh, "lead.bottom").facets, down), 1, 1e-14);
    // A flat facet over the angle pi / 12 turns by at most half of it.
    EXPECT_GT(worst_normal(mesh, surface(mesh, "lead.side").facets, from_axis), std::cos(pi / 24));
  }
}

TEST(Cylinder, HasCompleteNodeSets) {
  for (const Revolution turn : {Revolution::quarter, Revolution::full}) {
    const Mesh mesh = sample(turn);
    const auto all = nodes_where(mesh, [](const Vec3&) { return true; });
    const auto bottom = nodes_where(mesh, [](const Vec3& at) { return at.z() == 0; });
    const auto top = nodes_where(mesh, [](const Vec3& at) { return at.z() == length; });
    const auto side = nodes_where(
        mesh, [](const Vec3& at) { return std::hypot(at.x(), at.y()) > radius * (1 - 1e-12); });
    EXPECT_EQ(node_set(mesh, "lead"), all);
    EXPECT_EQ(node_set(mesh, "lead.bottom"), bottom);
    EXPECT_EQ(node_set(mesh, "lead.top"), top);
    EXPECT_EQ(node_set(mesh, "lead.side"), side);
  }
}

TEST(Cylinder, HasTheNodesOfItsPlanesExactlyOnThem) {
  const Mesh mesh = sample(Revolution::quarter);
  for (const auto& [name, axis] : {std::pair("lead.x_plane", 0), std::pair("lead.y_plane", 1)}) {
    const int layers = 5, across = 3 + 3 + 1;
    EXPECT_EQ(node_set(mesh, name).size(), static_cast<std::size_t>(layers * across));
    for (const Index node : node_set(mesh, name)) EXPECT_EQ(mesh.X(axis, node), 0.0);
  }
  EXPECT_TRUE(nodes_where(mesh, [](const Vec3& at) { return (at.array() < 0).any(); }).empty());
  EXPECT_THROW(node_set(sample(Revolution::full), "lead.x_plane"), InternalError);
}

TEST(Cylinder, FullIsFourQuarters) {
  const Mesh quarter = sample(Revolution::quarter), full = sample(Revolution::full);
  EXPECT_EQ(elements(full).cols(), 4 * elements(quarter).cols());
  EXPECT_NEAR(volume(full, elements(full)), 4 * volume(quarter, elements(quarter)), 1e-14);
  const Index layers = 5, on_planes = 4 * 6 + 1, per_layer = (quarter.X.cols() / layers - 13) * 4;
  EXPECT_EQ(full.X.cols(), layers * (per_layer + on_planes));
  const Places at = nodes_by_place(full);
  EXPECT_EQ(at.size(), static_cast<std::size_t>(full.X.cols()));
  for (Index node = 0; node < quarter.X.cols(); ++node) {
    EXPECT_TRUE(at.count({quarter.X(0, node), quarter.X(1, node), quarter.X(2, node)}));
  }
}

TEST(Cylinder, FullIsMirroredBitForBitWithFirstSidesReversed) {
  const Mesh full = sample(Revolution::full);
  for (const int axis : {0, 1}) {
    EXPECT_TRUE(is_mirrored<8>(full, elements(full), {1, 0, 3, 2, 5, 4, 7, 6}, axis));
    for (const Surface& surface : full.surfaces) {
      EXPECT_TRUE(is_mirrored<3>(full, surface.facets, {1, 0, 2}, axis)) << surface.name;
    }
  }
}

TEST(Cylinder, QuarterIsSymmetricAboutItsDiagonalBitForBit) {
  const Mesh mesh = sample(Revolution::quarter);
  const Places at = nodes_by_place(mesh);
  for (Index node = 0; node < mesh.X.cols(); ++node) {
    EXPECT_TRUE(at.count({mesh.X(1, node), mesh.X(0, node), mesh.X(2, node)}));
  }
}

TEST(Cylinder, NumbersNodesAndElementsLayerByLayer) {
  const Mesh full = sample(Revolution::full);
  for (Index node = 1; node < full.X.cols(); ++node)
    EXPECT_GE(full.X(2, node), full.X(2, node - 1));
  for (Index element = 1; element < elements(full).cols(); ++element) {
    EXPECT_GE(full.X(2, elements(full)(0, element)), full.X(2, elements(full)(0, element - 1)));
  }
}

TEST(Cylinder, HasAWatertightSurface) {
  const Mesh mesh = sample(Revolution::full);
  const Table<3> facets = together(mesh.surfaces);
  Sides sides;
  add_sides(facets, sides);
  EXPECT_EQ(open_sides(sides), 0);
  EXPECT_EQ(euler_characteristic(facets), 2);
}

TEST(Cylinder, HasTributaryAreasThatSumToTheArea) {
  for (const Revolution turn : {Revolution::quarter, Revolution::full}) {
    const Mesh mesh = sample(turn);
    for (const Surface& surface : mesh.surfaces) {
      const double area = sum(facet_areas(mesh, surface));
      const Scalars areas = tributary_areas(mesh, surface, node_set(mesh, surface.name));
      EXPECT_NEAR(sum(areas), area, 1e-14) << surface.name;
      EXPECT_TRUE(std::all_of(areas.begin(), areas.end(), [](double one) { return one > 0; }))
          << surface.name;
    }
  }
}

TEST(Cylinder, HasEqualTributaryAreasInsideItsSide) {
  const Mesh mesh = sample(Revolution::full);
  const Surface& side = surface(mesh, "lead.side");
  Subset inside;
  for (const Index node : node_set(mesh, "lead.side")) {
    if (mesh.X(2, node) > 0 && mesh.X(2, node) < length) inside.push_back(node);
  }
  const double cell = 2 * radius * std::sin(pi / 24) * length / 4;
  EXPECT_LT(unevenness(tributary_areas(mesh, side, inside), cell), 1e-13);
}

TEST(Cylinder, RefusesEmptyShapes) {
  EXPECT_THROW(cylinder("lead", {0, 1, Revolution::full, 1, 1, 1}), InternalError);
  EXPECT_THROW(cylinder("lead", {1, 1, Revolution::full, 1, 0, 1}), InternalError);
}

}  // namespace
}  // namespace nereid::mesh::cylinder_test
