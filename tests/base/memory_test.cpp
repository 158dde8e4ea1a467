#include "base/memory.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace nereid {
namespace {

TEST(MostResident, GrowsByWhatIsWritten) {
  constexpr double size = 64e6;  // [bytes] more than a test of this folder has freed and could use again
  const double before = most_resident();
  EXPECT_GT(before, 1e6);
  { const std::vector<char> written(static_cast<std::size_t>(size), 1); }
  const double after = most_resident();
  EXPECT_GT(after - before, 0.9 * size);
  EXPECT_LT(after - before, 1.2 * size);
  EXPECT_GE(most_resident(), after) << "what was freed still counts";
}

}  // namespace
}  // namespace nereid
