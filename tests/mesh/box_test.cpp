#include "mesh/box.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/check.hpp"
#include "tests/mesh/measures.hpp"

namespace nereid::mesh::box_test {
namespace {

using namespace measures;

const Box sample{{-0.1, 0.2, 0.3}, {0.7, 0.5, 1.0}, {4, 3, 5}};

TEST(Box, FillsItsVolumeWithEqualElements) {
  const Mesh mesh = box("A", sample);
  const Table<8>& nodes = hexahedra(mesh, "A").nodes;
  const double exact = (sample.high - sample.low).prod();
  EXPECT_EQ(nodes.cols(), 60);
  EXPECT_EQ(mesh.X.cols(), 5 * 4 * 6);
  EXPECT_NEAR(volume(mesh, nodes), exact, 1e-14 * exact);  // round-off
  EXPECT_NEAR(smallest_volume(mesh, nodes), exact / 60, 1e-14 * exact);
  EXPECT_NEAR(scaled_jacobian(mesh, nodes), 1, 1e-14);
}

TEST(Box, MeetsBothCornersExactly) {
  const Mesh mesh = box("A", sample);
  EXPECT_EQ(mesh.X.col(0), sample.low);
  EXPECT_EQ(mesh.X.col(mesh.X.cols() - 1), sample.high);
  const Subset outside = nodes_where(mesh, [](const Vec3& at) {
    return (at.array() < sample.low.array()).any() || (at.array() > sample.high.array()).any();
  });
  EXPECT_TRUE(outside.empty());
}

TEST(Box, HasFacesWithOutwardNormalsAndAllTheirNodes) {
  const Mesh mesh = box("A", sample);
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      const std::string name = std::string("A.") + "xyz"[axis] + (high ? "_high" : "_low");
      const double level = high ? sample.high(axis) : sample.low(axis);
      const Vec3 outwards = (high ? 1 : -1) * Vec3::Unit(axis);
      EXPECT_NEAR(
          worst_normal(mesh, surface(mesh, name).facets, [&](const Vec3&) { return outwards; }), 1,
          1e-14);
      EXPECT_EQ(node_set(mesh, name),
                nodes_where(mesh, [&](const Vec3& at) { return at(axis) == level; }));
    }
  }
  EXPECT_EQ(node_set(mesh, "A").size(), static_cast<std::size_t>(mesh.X.cols()));
}

TEST(Box, HasAWatertightSurface) {
  const Mesh mesh = box("A", sample);
  const Table<3> facets = together(mesh.surfaces);
  Sides sides;
  add_sides(facets, sides);
  EXPECT_EQ(open_sides(sides), 0);
  EXPECT_EQ(euler_characteristic(facets), 2);
}

TEST(Box, HasTributaryAreasThatAreEqualWithinAFaceAndSumToItsArea) {
  const Mesh mesh = box("A", sample);
  const Surface& face = surface(mesh, "A.x_low");
  const Scalars areas = tributary_areas(mesh, face, node_set(mesh, face.name));
  const double exact = 0.3 * 0.7, cell = exact / 15;
  EXPECT_NEAR(sum(areas), exact, 1e-14);
  const Subset inside = nodes_where(mesh, [&](const Vec3& at) {
    return at.x() == sample.low.x() && at.y() > 0.21 && at.y() < 0.49 && at.z() > 0.31 &&
           at.z() < 0.99;
  });
  EXPECT_EQ(inside.size(), 2u * 4u);
  EXPECT_LT(unevenness(tributary_areas(mesh, face, inside), cell), 1e-13);
  // a quarter of a cell at each corner, a half along the rims: cuts do not show
  const auto count = [&](double part) {
    return std::count_if(areas.begin(), areas.end(), [&](double area) { return std::abs(area / (part * cell) - 1) < 1e-12; });
  };
  EXPECT_EQ(count(0.25), 4);
  EXPECT_EQ(count(0.5), 2 * (2 + 4));
}

TEST(Box, RefusesEmptyShapes) {
  EXPECT_THROW(box("A", {{0, 0, 0}, {1, 1, 1}, {1, 0, 1}}), InternalError);
  EXPECT_THROW(box("A", {{0, 0, 0}, {1, 0, 1}, {1, 1, 1}}), InternalError);
}

}  // namespace
}  // namespace nereid::mesh::box_test
