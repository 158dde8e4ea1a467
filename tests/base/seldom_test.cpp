#include "base/seldom.hpp"

#include <gtest/gtest.h>

namespace nereid::seldom_test {
namespace {

struct Part {
  int number = 7;
};

TEST(Seldom, ReadsAsADefaultUntilItIsWritten) {
  Seldom<Part> one;
  EXPECT_FALSE(one.exists());
  EXPECT_EQ(one->number, 7);
  one.make().number = 8;
  EXPECT_TRUE(one.exists());
  EXPECT_EQ(one->number, 8);
  EXPECT_EQ(one.make().number, 8) << "it is made once";
}

TEST(Seldom, GivesEachCopyAValueOfItsOwn) {
  Seldom<Part> one;
  one.make().number = 8;
  Seldom<Part> copy = one, assigned;
  assigned = one;
  one.make().number = 9;
  EXPECT_EQ(copy->number, 8);
  EXPECT_EQ(assigned->number, 8);
  assigned = Seldom<Part>();
  EXPECT_FALSE(assigned.exists());
}

TEST(Seldom, TakesThePlaceOfAPointer) { EXPECT_EQ(sizeof(Seldom<Part>), sizeof(void*)); }

}  // namespace
}  // namespace nereid::seldom_test
