#include "model/fault.hpp"

#include <gtest/gtest.h>

namespace nereid::model::fault_test {
namespace {

TEST(Expect, SaysWhatThereIsAndWhatIsNear) {
  Faults faults;
  expect(faults, {"", "contact 'touch'"}, "base", "bar.x_high", "surfaces", {"bar.x_low", "bar.x_high"});
  EXPECT_TRUE(faults.empty());
  expect(faults, {"contacts[0]", "contact 'touch'"}, "base", "bar.x_hihg", "surfaces", {"bar.x_low", "bar.x_high"});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].at, "contacts[0]");
  EXPECT_EQ(faults[0].key, "base");
  EXPECT_EQ(faults[0].message, "'base' = bar.x_hihg is unknown: surfaces are bar.x_low, bar.x_high");
  EXPECT_EQ(faults[0].hint, "did you mean 'bar.x_high'?");
  expect(faults, {"", "plane 'side'"}, "nodes[1]", "bar", "node sets", {});
  EXPECT_EQ(faults[1].message, "'nodes' = bar is unknown: there are no node sets");
}

TEST(Refuse, KeepsTheFirstFaultOfEachKeyOfAPart) {
  Faults faults;
  refuse(faults, {"", "load 'pull'"}, "value", "first");
  refuse(faults, {"", "load 'pull'"}, "value", "second");
  refuse(faults, {"", "load 'push'"}, "value", "third");
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].message, "first");
}

TEST(SceneError, NamesTheThingOfEachFault) {
  Faults faults;
  EXPECT_NO_THROW(throw_if_any(faults));
  refuse(faults, {"", "contact 'touch'"}, "base", "is wrong", "try another");
  refuse(faults, {"", "body 'bar'"}, "mesh", "is flat");
  try {
    throw_if_any(faults);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_STREQ(error.what(), "contact 'touch': is wrong (try another)\nbody 'bar': is flat");
  }
}

}  // namespace
}  // namespace nereid::model::fault_test
