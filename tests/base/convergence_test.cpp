#include "base/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nereid::convergence_test {
namespace {

std::vector<Level> power_law(const std::vector<double>& refine, double limit, double size, double order) {
  std::vector<Level> levels;
  for (const double r : refine) levels.push_back({r, limit + size * std::pow(r, -order), std::pow(r, 4), 0});
  return levels;
}

TEST(MeshError, FindsTheOrderOfAPowerLawWhateverTheRatiosOfTheMeshes) {
  for (const double order : {0.6, 1.0, 1.5, 2.7}) {
    const auto levels = power_law({0.5, 0.75, 1, 1.75}, 3, 0.1, order);
    const MeshError seen = mesh_error(levels);
    EXPECT_NEAR(seen.order, order, 1e-9);
    const double error = 0.1 * std::pow(1.75, -order);
    if (order <= 1.5) EXPECT_NEAR(seen.error / error, 1.25, 1e-9);
    else EXPECT_GT(seen.error / error, 1.5) << "an order above one and a half is not believed";
  }
}

TEST(MeshError, IsThreeTimesTheSpreadWhereThereIsNoOrder) {
  std::vector<Level> levels{{1, 2.0, 0, 0}, {2, 2.2, 0, 0}, {4, 2.1, 0, 0}};
  EXPECT_NEAR(mesh_error(levels).error, 0.6, 1e-12);
  EXPECT_TRUE(std::isnan(mesh_error(levels).order));
  levels.pop_back();
  EXPECT_NEAR(mesh_error(levels).error, 0.6, 1e-12) << "of two, by an order of one";
  levels.pop_back();
  EXPECT_TRUE(std::isinf(mesh_error(levels).error)) << "one mesh tells nothing";
  EXPECT_EQ(mesh_error({{1, 5, 0, 0}, {2, 5, 0, 0}, {4, 5, 0, 0}}).error, 0);
}

TEST(EvenFactors, KeepCountsWhole) {
  for (const double factor : even_factors({4, 6})) {
    EXPECT_LE(std::abs(std::round(4 * factor) / (4 * factor) - 1), 0.02);
    EXPECT_LE(std::abs(std::round(6 * factor) / (6 * factor) - 1), 0.02);
  }
  const auto even = even_factors({4, 6});
  EXPECT_EQ(first_factor(even, {4, 6}), 0.5) << "two of four cells";
  EXPECT_EQ(first_factor(even_factors({48}), {48}), 1.0 / 3) << "no sixth is a quarter";
  EXPECT_EQ(first_factor(even_factors({3}), {3}), 2.0 / 3);
  EXPECT_EQ(first_factor(even_factors({}), {}), 1.0);
}

TEST(EvenFactors, AmongThoseGivenOnly) {
  const auto splits = even_factors({3, 10}, {1, 2, 4});
  EXPECT_EQ(splits, (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(next_factor(splits, power_law({1}, 3, 0.1, 1), 1e-6), 2);
  EXPECT_EQ(next_factor(splits, power_law({1, 2}, 3, 0.1, 1), 1e-6), 4);
  EXPECT_EQ(next_factor(splits, power_law({1, 2, 4}, 3, 0.1, 1), 1e-6), 0);
}

TEST(NextFactor, GoesAsFarAsTheOrderAsksForAndNoFartherThanTwice) {
  const auto even = even_factors({100});
  const auto levels = power_law({0.5, 0.75, 1}, 3, 0.1, 1);  // its error is taken as 0.125
  EXPECT_NEAR(next_factor(even, levels, 0.125 / 1.5), 1.5, 0.09);
  EXPECT_NEAR(next_factor(even, levels, 1e-6), 2, 0.09);
  EXPECT_NEAR(next_factor(even, {levels[0]}, 1), 0.75, 0.09);
  EXPECT_EQ(next_factor({0.5, 1}, levels, 1e-6), 0) << "no finer one";
}

TEST(Updates, FollowThoseOfTheLastTwoLevels) {
  auto levels = power_law({1, 2}, 1, 1, 1);
  EXPECT_NEAR(updates_at(levels, 4), 256, 1e-9);
  levels[0].updates = 4;  // of a bar whose cells are counted along it alone
  EXPECT_NEAR(updates_at(levels, 4), 64, 1e-9);
  EXPECT_NEAR(updates_at({levels[1]}, 4), 256, 1e-9) << "three dimensions and time";
}

}  // namespace
}  // namespace nereid::convergence_test
