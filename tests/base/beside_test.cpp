#include "base/beside.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <memory>
#include <vector>

#include "base/check.hpp"

namespace nereid::beside_test {
namespace {

TEST(Beside, DoesAllWorkInItsOrder) {
  std::vector<int> done;
  {
    Beside beside;
    for (int i = 0; i < 100; ++i) beside.begin([&done, i] { done.push_back(i); });
    beside.wait();
    EXPECT_EQ(done.size(), 100U);
    beside.begin([&done] { done.push_back(100); });
  }
  ASSERT_EQ(done.size(), 101U) << "its end waits";
  for (int i = 0; i <= 100; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
}

TEST(Beside, HoldsOnePieceOfWorkAtATime) {
  const auto held = std::make_shared<int>(0);
  Beside beside;
  for (int i = 0; i < 20; ++i) {
    beside.begin([held] { ++*held; });
    EXPECT_LE(held.use_count(), 2);
  }
  beside.wait();
  EXPECT_EQ(held.use_count(), 1);
  EXPECT_EQ(*held, 20);
}

TEST(Beside, TellsOnceWhatTheWorkThrew) {
  Beside beside;
  beside.wait();
  beside.look();
  beside.begin([] { throw MachineError("no room"); });
  EXPECT_THROW(beside.wait(), MachineError);
  beside.wait();
  bool begun = false;
  if (beside.has_thread()) beside.begin([] { throw MachineError("no room"); });
  EXPECT_THROW(beside.begin([&begun] { begun = true; }), MachineError);
  EXPECT_FALSE(begun) << "nothing is written behind what failed";
  beside.begin([&begun] { begun = true; });
  beside.wait();
  EXPECT_TRUE(begun);
}

TEST(Beside, LooksWithoutWaiting) {
  Beside beside;
  std::atomic<bool> goes_on = false;
  ASSERT_TRUE(beside.has_thread());
  beside.begin([&goes_on] {
    while (!goes_on) goes_on.wait(false);
    throw MachineError("no room");
  });
  beside.look();
  goes_on = true;
  goes_on.notify_all();
  EXPECT_THROW(
      for (;;) beside.look(), MachineError);
}

TEST(Beside, DoesTheWorkItselfWhereNoThreadCanBeStarted) {
#ifdef NEREID_SANITIZED
  GTEST_SKIP() << "sanitizers need address space";
#endif
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  const rlimit none{1, limit.rlim_max};  // there is no room for the stack of a thread
  std::vector<std::unique_ptr<Beside>> all;  // the first ones have the stacks of threads that have ended
  all.reserve(100);
  setrlimit(RLIMIT_AS, &none);
  do all.push_back(std::make_unique<Beside>());
  while (all.back()->has_thread() && all.size() < 100);
  setrlimit(RLIMIT_AS, &limit);
  Beside* beside = all.back().get();
  ASSERT_FALSE(beside->has_thread());
  bool done = false;
  beside->begin([&done] { done = true; });
  EXPECT_TRUE(done);
  EXPECT_THROW(beside->begin([] { throw MachineError("no room"); }), MachineError);
  beside->wait();
}

}  // namespace
}  // namespace nereid::beside_test
