#include "mesh/adjacency.hpp"

#include <gtest/gtest.h>

#include "base/check.hpp"
#include "mesh/disc.hpp"

namespace nereid::mesh::adjacency_test {
namespace {

/// Plates that meet at the edge from node 0 to node 1, along z: each leads off to its own node in a direction [degrees].
struct Star {
  Vectors X;
  Table<3> facets;
};
Star star(const std::vector<double>& directions) {
  Star made{Vectors::Zero(3, 2 + static_cast<Eigen::Index>(directions.size())), Table<3>(3, static_cast<Eigen::Index>(directions.size()))};
  made.X(2, 1) = 1;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double angle = directions[i] * EIGEN_PI / 180;
    const auto at = static_cast<Eigen::Index>(i);
    made.X.col(2 + at) = Vec3(std::cos(angle), std::sin(angle), 0.5);
    made.facets.col(at) << 0, 1, static_cast<Index>(2 + i);
  }
  return made;
}

TEST(Neighbours, OfASheetWithBothSidesStayOnTheirSideAndMeetAtTheRim) {
  const Mesh sheet = mesh::sheet("s", Sheet{.length = 3, .width = 2, .cells_along = 3, .cells_across = 2});
  const Table<3> facets = both_sides(sheet.triangles[0].nodes), across = neighbours(sheet.X, facets);
  const auto count = static_cast<Index>(facets.cols() / 2);
  const std::vector<Index> other = other_sides(facets);
  int rim = 0;
  for (Index f = 0; f < 2 * count; ++f) {
    EXPECT_EQ(other[f], f < count ? f + count : f - count);
    for (int e = 0; e < 3; ++e) {
      const Index next = across(e, f);
      if (next == other[f]) ++rim;
      else EXPECT_EQ(next < count, f < count);
    }
  }
  EXPECT_EQ(rim, 2 * 2 * (3 + 2));  // on both sides
}

TEST(Neighbours, WherePlatesMeetAreTheNextAroundTheEdge) {
  const Star made = star({0, 100, 230});
  const Table<3> facets = both_sides(made.facets), across = neighbours(made.X, facets);
  // the edge 0-1 is the first of each; a plate at an angle has its front, 0 to 2, towards larger angles, its back is 3 to 5
  EXPECT_EQ(across(0, 0), 4);
  EXPECT_EQ(across(0, 1), 5);
  EXPECT_EQ(across(0, 2), 3);
  EXPECT_EQ(across(0, 3), 2);
  EXPECT_EQ(across(0, 4), 0);
  EXPECT_EQ(across(0, 5), 1);
}

TEST(Neighbours, AreMutual) {
  const Star made = star({10, 350, 90, 91, 270});
  const Table<3> facets = both_sides(made.facets), across = neighbours(made.X, facets);
  for (Index f = 0; f < facets.cols(); ++f) {
    const Index next = across(0, f);
    EXPECT_EQ(across(0, next), f);
  }
}

TEST(Neighbours, RefuseThreeFacetsOfWhichTwoAgree) {
  const Star made = star({0, 90, 180});
  Table<3> facets = made.facets;
  facets.col(1).head<2>().reverseInPlace();
  EXPECT_FALSE(goes_on(facets));
  EXPECT_THROW(neighbours(made.X, facets), InternalError);
}

TEST(OtherSides, AreOfTheSameNodesReversed) {
  Table<3> facets(3, 3);
  facets << 0, 2, 0, 1, 1, 1, 2, 0, 3;
  EXPECT_EQ(other_sides(facets), (std::vector<Index>{1, 0, -1}));
  EXPECT_TRUE(has_both_sides(facets));
  EXPECT_FALSE(has_both_sides(facets.rightCols(1)));
}

}  // namespace
}  // namespace nereid::mesh::adjacency_test
