#include "base/child.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>

namespace nereid::child_test {
namespace {

TEST(InChild, ReturnsAllBytes) {
  std::string large(300'000, 'a');  // more than a pipe holds
  for (std::size_t i = 0; i < large.size(); i += 7) large[i] = static_cast<char>(i);
  const OfChild found = in_child([&] { return large; }, {});
  EXPECT_EQ(found.why, "");
  EXPECT_TRUE(found.bytes == large);
}

TEST(InChild, TellsOfACrash) {
  for (const int signal : {SIGABRT, SIGSEGV}) {
    const OfChild found = in_child(
        [signal] {
          std::signal(signal, SIG_DFL);  // sanitizers have their own
          std::raise(signal);
          return std::string("never");
        },
        {});
    EXPECT_EQ(found.why.rfind("it crashed: ", 0), 0U) << found.why;
    EXPECT_EQ(found.bytes, "");
    EXPECT_FALSE(found.out_of_memory);
  }
}

TEST(InChild, TellsOfMemoryAndOfWhatIsThrown) {
  const OfChild large = in_child([]() -> std::string { throw std::bad_alloc(); }, {});
  EXPECT_TRUE(large.out_of_memory);
  EXPECT_EQ(large.why, "it takes too much memory");
  EXPECT_EQ(in_child([]() -> std::string { throw std::runtime_error("x"); }, {}).why, "it failed");
}

#ifndef NEREID_SANITIZED
TEST(InChild, LimitsMemory) {
  const OfChild found = in_child([] { return std::string(std::size_t{1} << 30, 'x').substr(0, 1); }, {.memory = 1e8});
  EXPECT_TRUE(found.out_of_memory) << found.why;
}
#endif

TEST(InChild, EndsWhatHangs) {
  const OfChild found = in_child(
      [] {
        for (volatile bool goes_on = true; goes_on;) {
        }
        return std::string();
      },
      {.seconds = 1});
  EXPECT_EQ(found.why, "it took more than 1 s");
}

}  // namespace
}  // namespace nereid::child_test
