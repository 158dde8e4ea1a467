#include "element/limiter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"
#include "element/block.hpp"
#include "mesh/box.hpp"
#include "mesh/mesh.hpp"

namespace nereid::element::limiter_test {
namespace {

double departure_of(double e, double left, double right) {
  const double sign = e < 0 ? -1 : 1;
  return departure(sign * e, 0.5 * sign * (left + right), std::min(sign * left, sign * right));
}

TEST(Departure, IsNoneWhereStrainsAreLinearAndAllWhereTheyTurn) {
  EXPECT_EQ(departure_of(2e-6, 1e-6, 3e-6), 0);
  EXPECT_EQ(departure_of(-2e-6, -1e-6, -3e-6), 0);
  EXPECT_EQ(departure_of(1e-6, 2e-6, 2e-6), 0) << "less than the mean beside it";
  EXPECT_NEAR(departure_of(1e-6, 0, 0), 1, 1e-5);
  EXPECT_NEAR(departure_of(1e-6, -1e-6, -1e-6), 1, 1e-5);
  EXPECT_NEAR(departure_of(1e-6, 1e-6, 0), 1, 1e-5) << "a front";
  EXPECT_NEAR(departure_of(1e-6, 0.9e-6, 0.9e-6), 0.04, 1e-5);
}

TEST(Departure, OfAlmostNoStrainIsNone) {
  EXPECT_EQ(departure_of(0, 0, 0), 0);
  EXPECT_EQ(departure_of(0, 1e-6, -1e-6), 0);
  EXPECT_LT(departure_of(1e-16, 0, 0), 1e-7) << "round-off";
}

TEST(Departure, DoesNotDependOnTheSign) {
  for (const double left : {-1e-6, 2e-7, 3e-6})
    for (const double right : {-2e-6, 5e-7, 1e-6}) {
      EXPECT_EQ(departure_of(1e-6, left, right), departure_of(-1e-6, -left, -right));
      EXPECT_EQ(departure_of(1e-6, left, right), departure_of(1e-6, right, left));
    }
}

/// Strains by element and axis, as a table of a tiling; fillers as their element.
std::vector<double> table(const Tiling& tiling, std::size_t axes, const std::vector<std::vector<double>>& of_element) {
  std::vector<double> all(tiling.filled.size() * axes * lanes);
  for (std::size_t at = 0; at < tiling.element.size(); ++at)
    for (std::size_t k = 0; k < axes; ++k)
      all[(at / lanes * axes + k) * lanes + at % lanes] = of_element[static_cast<std::size_t>(tiling.element[at])][k];
  return all;
}
double value(const Tiling& tiling, std::size_t axes, const std::vector<double>& all, Index element, std::size_t axis) {
  const auto at = static_cast<std::size_t>(std::find(tiling.element.begin(), tiling.element.end(), element) - tiling.element.begin());
  return all[(at / lanes * axes + axis) * lanes + at % lanes];
}

TEST(PlacesBeside, OfABoxAreThoseOfItsNeighboursAndAtTheSurfaceItsOwn) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3(0, 0, 0), Vec3(7, 6, 5), {7, 6, 5}});
  const Connectivity& nodes = mesh.hexahedra[0].nodes;
  const Tiling tiling = cut_into_tiles(nodes, mesh.X, 64);
  ASSERT_GT(tiling.tiles.size(), 2u);
  const std::vector<Index> beside = places_beside(tiling, nodes);
  const auto centre = [&](Index e) {
    Vec3 sum = Vec3::Zero();
    for (Index a = 0; a < 8; ++a) sum += mesh.X.col(nodes(a, e)) / 8;
    return sum;
  };
  std::vector<std::vector<double>> numbers;
  for (Index e = 0; e < nodes.cols(); ++e) numbers.push_back({e + 0.0, e + 0.1, e + 0.2});
  const auto all = table(tiling, 3, numbers);
  const Vec3 sizes(7, 6, 5);
  for (std::size_t at = 0; at < tiling.element.size(); ++at) {
    const Index e = tiling.element[at];
    if (static_cast<int>(at % lanes) >= tiling.filled[at / lanes]) continue;
    for (std::size_t side = 0; side < 6; ++side) {
      const double found = all[static_cast<std::size_t>(beside[(at / lanes * 6 + side) * lanes + at % lanes])];
      const auto k = static_cast<Eigen::Index>(side / 2);
      Vec3 there = centre(e);
      there(k) += side % 2 ? 1 : -1;
      const bool is_inside = there(k) > 0 && there(k) < sizes(k);
      EXPECT_LT((centre(static_cast<Index>(found)) - (is_inside ? there : centre(e))).norm(), 1e-12);
      EXPECT_NEAR(found - std::floor(found), 0.1 * static_cast<double>(k), 1e-12) << "the neighbour's axis";
    }
  }
}

TEST(PlacesBeside, TakeTheAxisOfTheNeighbourThroughTheFaceThatBothShare) {
  // two cubes side by side along x; the axes of the second are numbered y, z, x
  mesh::Mesh mesh = mesh::box("box", {Vec3(0, 0, 0), Vec3(2, 1, 1), {2, 1, 1}});
  Connectivity nodes = mesh.hexahedra[0].nodes;
  const Connectivity old = nodes;
  const int to[8] = {0, 3, 7, 4, 1, 2, 6, 5};
  for (int a = 0; a < 8; ++a) nodes(a, 1) = old(to[a], 1);
  const Tiling tiling = cut_into_tiles(nodes, mesh.X);
  const auto beside = places_beside(tiling, nodes);
  const auto all = table(tiling, 3, {{0.0, 0.1, 0.2}, {1.0, 1.1, 1.2}});
  const auto first = static_cast<std::size_t>(std::find(tiling.element.begin(), tiling.element.end(), 0) - tiling.element.begin());
  EXPECT_NEAR(all[static_cast<std::size_t>(beside[(first / lanes * 6 + 1) * lanes + first % lanes])], 1.2, 1e-12);
}

TEST(PlacesBeside, OfCollapsedFacesAndOfThoseOfThreeElementsAreTheElementsOwn) {
  Connectivity nodes(8, 3);
  nodes.col(0) << 0, 1, 1, 0, 4, 5, 5, 4;  // its sides y are one face, and x are edges
  nodes.col(1) << 8, 9, 10, 11, 0, 1, 5, 4;
  nodes.col(2) << 12, 13, 14, 15, 0, 1, 5, 4;
  const Vectors X = Vectors::Random(3, 16);
  const Tiling tiling = cut_into_tiles(nodes, X);
  const auto beside = places_beside(tiling, nodes);
  for (std::size_t at = 0; at < tiling.element.size(); ++at)
    for (std::size_t side = 0; side < 6; ++side)
      EXPECT_EQ(beside[(at / lanes * 6 + side) * lanes + at % lanes],
                static_cast<Index>((at / lanes * 3 + side / 2) * lanes + at % lanes)) << side;
}

TEST(FindDepartures, OfALinearFieldAreNoneAndAFrontIsSpreadByOneElement) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3(0, 0, 0), Vec3(20, 1, 1), {20, 1, 1}});
  const Connectivity& nodes = mesh.hexahedra[0].nodes;
  const Tiling tiling = cut_into_tiles(nodes, mesh.X, 8);
  const auto beside = places_beside(tiling, nodes);
  std::vector<std::vector<double>> ramp, front;
  for (int e = 0; e < 20; ++e) ramp.push_back({1e-6 * (e + 2), 0, 0}), front.push_back({e < 10 ? 1e-6 : 0, 0, 0});
  Departures found = departures_for(tiling, true);
  find_departures(tiling, beside, table(tiling, 3, ramp), found);
  for (Index e = 1; e < 19; ++e) EXPECT_NEAR(value(tiling, 3, found.spread, e, 0), 0, 1e-20);
  find_departures(tiling, beside, table(tiling, 3, front), found);
  for (Index e = 0; e < 20; ++e) EXPECT_NEAR(value(tiling, 3, found.spread, e, 0), e == 9 ? 1 : 0, 1e-5);
  const auto at = static_cast<std::size_t>(std::find(tiling.element.begin(), tiling.element.end(), 10) - tiling.element.begin());
  const auto share = shares_of<3, 6>(found.spread.data(), at / lanes, beside.data() + at / lanes * 6 * lanes);
  EXPECT_NEAR(share[0][static_cast<int>(at % lanes)], 1, 1e-5) << "ahead of the front";
}

TEST(FindDepartures, OfTrianglesAreSpreadOnceBeforeTheyAreShared) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3(0, 0, 0), Vec3(6, 6, 1), {6, 6, 1}});
  const Table<3> nodes = mesh::surface(mesh, "box.z_high").facets;
  const Tiling tiling = cut_into_tiles(nodes, mesh.X, 16);
  const auto beside = places_beside(tiling, nodes);
  std::vector<std::vector<double>> one(static_cast<std::size_t>(nodes.cols()), {0.0});
  one[30] = {1e-6};
  Departures found = departures_for(tiling, true);
  find_departures(tiling, beside, table(tiling, 1, one), found);
  int own = 0, spread = 0;
  for (Index e = 0; e < nodes.cols(); ++e) {
    own += value(tiling, 1, found.own, e, 0) > 0.5;
    spread += value(tiling, 1, found.spread, e, 0) > 0.5;
  }
  EXPECT_EQ(own, 1);
  EXPECT_EQ(spread, 4) << "itself and its three neighbours";
}

TEST(FindDepartures, AreTheSameBitsForAnyNumberOfThreads) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3(0, 0, 0), Vec3(12, 12, 5), {12, 12, 5}});
  const Connectivity both[] = {mesh.hexahedra[0].nodes, mesh::surface(mesh, "box.z_high").facets};
  for (const Connectivity& nodes : both) {
    const std::size_t axes = nodes.rows() == 8 ? 3 : 1;
    const Tiling tiling = cut_into_tiles(nodes, mesh.X, 8);
    ASSERT_GT(tiling.tiles.size(), 32u) << "enough to be shared out";
    const auto beside = places_beside(tiling, nodes);
    std::vector<std::vector<double>> strains;
    for (Index e = 0; e < nodes.cols(); ++e) strains.push_back({1e-6 * std::sin(3.0 * e), 1e-6 * std::cos(5.0 * e), 1e-6 * std::sin(e)});
    const auto along = table(tiling, axes, strains);
    std::vector<double> first;
    for (const int count : {1, 2, 4}) {
      use_threads(count);
      Departures found = departures_for(tiling, true);
      find_departures(tiling, beside, along, found);
      if (count == 1) first = found.spread;
      EXPECT_EQ(found.spread, first);
    }
    use_threads(1);
    EXPECT_GT(*std::max_element(first.begin(), first.end()), 0.5);
  }
}

}  // namespace
}  // namespace nereid::element::limiter_test
