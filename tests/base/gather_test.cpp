#include "base/gather.hpp"

#include <gtest/gtest.h>

#include <array>

namespace nereid::gather_test {
namespace {

TEST(Gather, EachLaneHasWhatItsIndexSays) {
  Vectors vectors(3, 3 * lanes);
  std::array<Index, lanes> at;
  for (Index i = 0; i < vectors.cols(); ++i) vectors.col(i) = Vec3(i, 100 + i, 200 + i);
  for (int lane = 0; lane < lanes; ++lane) at[lane] = (7 * lane + 2) % (3 * lanes);
  const Vector<Pack> gathered = gather(vectors.data(), at.data());
  for (int lane = 0; lane < lanes; ++lane)
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(gathered[axis][lane], vectors(axis, at[lane])) << lane;
}

}  // namespace
}  // namespace nereid::gather_test
