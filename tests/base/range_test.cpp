#include "base/range.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nereid::range_test {
namespace {

TEST(Range, ContainsItsEndsWhereTheyBelongToIt) {
  EXPECT_TRUE(within(0, 1).contains(0) && within(0, 1).contains(1));
  EXPECT_FALSE(between(0, 1).contains(0) || between(0, 1).contains(1));
  EXPECT_TRUE(above(-1).up_to(0.5).contains(0.5));
}

TEST(Range, ContainsFiniteNumbersOnly) {
  for (const Range& range : {finite, positive, not_negative, below(3), up_to(3), within(0, 1)}) {
    EXPECT_FALSE(range.contains(std::nan("")));
    EXPECT_FALSE(range.contains(INFINITY));
    EXPECT_FALSE(range.contains(-INFINITY));
  }
}

TEST(WordsOf, ARangeHaveTheUnitOfItsEnds) {
  EXPECT_EQ(words_of(above(0).up_to(10), "safety", "1"), "0 < safety <= 10");
  EXPECT_EQ(words_of(not_negative.below(2e9), "tangent", "Pa"), "0 <= tangent < 2e+09 Pa");
  EXPECT_EQ(words_of(positive, "end", "s"), "end > 0");
  EXPECT_EQ(words_of(up_to(3), "x", "m"), "x <= 3 m");
  EXPECT_EQ(words_of(finite, "x", "m"), "a finite number");
}

}  // namespace
}  // namespace nereid::range_test
