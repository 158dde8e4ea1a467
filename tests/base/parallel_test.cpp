#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nereid::parallel_test {
namespace {

TEST(Parallel, EveryIndexIsCalledOnce) {
  for (const int count : {1, 2, 4}) {
    use_threads(count);
    for (const Index calls : {0, 1, 3, 1000}) {
      for (const Index grain : {1, 10, 10000}) {
        std::vector<int> called(calls, 0);
        parallel_for(calls, grain, [&](Index i) { ++called[i]; });
        EXPECT_EQ(called, std::vector<int>(calls, 1));
      }
    }
  }
  use_threads(1);
}

TEST(Parallel, GivesTheSameBitsForAnyNumberOfThreads) {
  const auto run = [](int count) {
    use_threads(count);
    std::vector<double> values(1000);
    parallel_for(1000, 1, [&](Index i) { values[i] = std::sin(0.1 * i) / (1.0 + i); });
    double sum = 0;
    for (const double v : values) sum += v;
    return sum;
  };
  const double one = run(1);
  EXPECT_EQ(run(2), one);
  EXPECT_EQ(run(4), one);
  use_threads(1);
}

TEST(Parallel, KnowsItsNumberOfThreads) {
  use_threads(3);
  EXPECT_EQ(threads(), 3);
  use_threads(1);
  EXPECT_EQ(threads(), 1);
}

}  // namespace
}  // namespace nereid::parallel_test
