#include "base/memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <vector>

namespace nereid::memory_test {
namespace {

std::vector<char> written(double size) {
  std::vector<char> bytes(static_cast<std::size_t>(size), 1);  // a compiler may leave out what nobody sees
  for (volatile char* at = bytes.data(); at < bytes.data() + bytes.size(); at += 4096) *at = 2;
  return bytes;
}

TEST(MostResident, GrowsByWhatIsWritten) {
  constexpr double size = 64e6;  // [bytes] more than a test of this folder has freed and could use again
  const std::vector<char> held = written(most_resident());  // a process begins with the most of the one that started it
  const double before = most_resident();
  EXPECT_GT(before, 1e6);
  written(size);
  const double after = most_resident();
  EXPECT_GT(after - before, 0.9 * size);
#ifndef NEREID_SANITIZED  // sanitizers note much beside each byte
  EXPECT_LT(after - before, 1.2 * size);
#endif
  EXPECT_GE(most_resident(), after) << "what was freed still counts";
}

TEST(MemoryLeft, IsThatOfTheMachineOrWhatALimitLeaves) {
  const double free = memory_left();
  EXPECT_GT(free, 1e7);
  EXPECT_LT(free, 1e15);
#ifndef NEREID_SANITIZED
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  const rlimit small{rlim_t{1} << 32, before.rlim_max};  // more than this test has, less than machines have
  setrlimit(RLIMIT_AS, &small);
  EXPECT_LT(memory_left(), 4.3e9);
  setrlimit(RLIMIT_AS, &before);
#endif
}

}  // namespace
}  // namespace nereid::memory_test
