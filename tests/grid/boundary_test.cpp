#include "grid/boundary.hpp"

#include <gtest/gtest.h>

namespace nereid::grid::boundary_test {
namespace {

const std::array<Index, 8> brick{0, 1, 2, 3, 4, 5, 6, 7};

TEST(FacesOfSolids, AreFoundByAnyThreeOfTheirCorners) {
  const FacesOfSolids faces({brick});
  EXPECT_TRUE(faces.has(corners(0, 1, 2)));
  EXPECT_TRUE(faces.has(corners(3, 1, 2)));
  EXPECT_TRUE(faces.has(corners(6, 1, 5)));
  EXPECT_FALSE(faces.has(corners(0, 1, 6)));  // two edges of the brick, on no face
  EXPECT_FALSE(faces.has(corners(0, 2, 5)));
}

TEST(FacesOfSolids, AreCoveredByBothHalvesOfEitherCut) {
  const FacesOfSolids faces({brick});
  const Corners half = corners(4, 5, 6), other = corners(4, 6, 7), of_other_cut = corners(4, 5, 7);
  EXPECT_FALSE(faces.is_covered(half, {half}));
  EXPECT_FALSE(faces.is_covered(half, {half, of_other_cut}));
  EXPECT_TRUE(faces.is_covered(half, {half, other}));
  EXPECT_TRUE(faces.is_covered(of_other_cut, {of_other_cut, corners(5, 6, 7)}));
  EXPECT_FALSE(faces.is_covered(corners(0, 2, 5), {corners(0, 2, 5)}));  // on no face
}

TEST(FacesOfSolids, WithTwoCornersInOneAreTriangles) {
  const FacesOfSolids faces({{0, 1, 2, 0, 4, 5, 6, 4}});
  EXPECT_TRUE(faces.is_covered(corners(0, 1, 2), {}));
  EXPECT_TRUE(faces.has(corners(0, 1, 2)));
  Boundary end{"end", {}};
  faces.add_to(end, corners(0, 1, 2));
  EXPECT_EQ(nodes_on(end), (Subset{0, 1, 2}));
}

TEST(ABoundary, HasWholeFacesAndTheirFacetsHoweverTheyAreCut) {
  const FacesOfSolids faces({brick});
  Boundary low{"low", {}};
  faces.add_to(low, corners(0, 1, 2));
  EXPECT_EQ(nodes_on(low), (Subset{0, 1, 2, 3}));
  Table<3> facets(3, 4);
  facets << 0, 0, 1, 4,  //
      3, 1, 3, 5,        //
      1, 2, 2, 6;
  EXPECT_EQ(facets_on(facets, low), facets.leftCols(3));
}

TEST(ABoundary, TakesNewNumbers) {
  const FacesOfSolids faces({brick});
  Boundary high{"high", {}};
  faces.add_to(high, corners(5, 6, 7));
  renumber(high, {-1, -1, -1, -1, 0, 1, 2, 3});
  EXPECT_EQ(nodes_on(high), (Subset{0, 1, 2, 3}));
}

}  // namespace
}  // namespace nereid::grid::boundary_test
