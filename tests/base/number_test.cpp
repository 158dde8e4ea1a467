#include "base/number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/dual.hpp"

namespace nereid::number_test {
namespace {

/// One row of lanes: first, first + 1, ...
Pack ascending(double first) {
  return Pack([&](auto lane) { return first + static_cast<double>(static_cast<int>(lane)); });
}

TEST(Number, SelectTakesOneOfTwo) {
  EXPECT_EQ(select(true, 1.0, 2.0), 1.0);
  EXPECT_EQ(select(false, 1.0, 2.0), 2.0);
  EXPECT_EQ(select(true, Dual<1>(1.0), Dual<1>(2.0)).value, 1.0);
  EXPECT_EQ(select(false, Dual<1>(1.0), Dual<1>(2.0)).value, 2.0);
}

TEST(Number, SelectOfPacksChoosesLaneByLane) {
  const Pack number = ascending(0.0);
  const Pack chosen = select(number < Pack(1.0), Pack(-1.0), number);
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(chosen[l], l < 1 ? -1.0 : l);
}

TEST(Number, SelectKeepsNotANumberOutOfTheLanesThatDoNotChooseIt) {
  const Pack nothing(std::numeric_limits<double>::quiet_NaN());
  const Pack number = ascending(0.0);
  const Pack chosen = select(number >= Pack(0.0), number, nothing);
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(chosen[l], l);
}

TEST(Number, AnyIsTrueIfOneLaneIs) {
  EXPECT_TRUE(any(true));
  EXPECT_FALSE(any(false));
  const Pack number = ascending(0.0);
  EXPECT_TRUE(any(number > Pack(lanes - 1.5)));
  EXPECT_FALSE(any(number > Pack(lanes - 0.5)));
}

TEST(Number, RootIsTheSquareRoot) {
  EXPECT_EQ(root(9.0), 3.0);
  const Pack roots = root(ascending(2.0));
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(roots[l], std::sqrt(2.0 + l));
  EXPECT_EQ(root(Dual<1>(9.0)).value, 3.0);
}

TEST(Number, LargerAndSmallerOfAllNumberTypes) {
  EXPECT_EQ(larger(1.0, 2.0), 2.0);
  EXPECT_EQ(smaller(1.0, 2.0), 1.0);
  const Dual<1> x = Dual<1>::variable(1.0, 0);
  EXPECT_EQ(larger(x, Dual<1>(0.5)).by[0], 1.0);
  EXPECT_EQ(smaller(x, Dual<1>(0.5)).by[0], 0.0);
  const Pack number = ascending(0.0), high = larger(number, Pack(1.0)),
             low = smaller(number, Pack(1.0));
  for (int l = 0; l < lanes; ++l) {
    EXPECT_EQ(high[l], std::max<double>(l, 1.0));
    EXPECT_EQ(low[l], std::min<double>(l, 1.0));
  }
}

TEST(Number, LanesAreReadAndWrittenInOrder) {
  double row[lanes + 1], back[lanes + 1];
  for (int l = 0; l <= lanes; ++l) row[l] = 10.0 + l, back[l] = -1.0;
  Pack pack;
  read_lanes(row + 1, pack);  // need not be aligned
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(pack[l], 11.0 + l);
  write_lanes(pack, back);
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(back[l], 11.0 + l);
  EXPECT_EQ(back[lanes], -1.0) << "and nothing beyond";
  double one = 0;
  read_lanes(row, one);
  EXPECT_EQ(one, 10.0);
  write_lanes(7.0, back);
  EXPECT_EQ(back[0], 7.0);
}

}  // namespace
}  // namespace nereid::number_test
