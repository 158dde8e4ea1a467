#pragma once
// Random numbers of tests: what a test draws does not depend on those that ran before it.

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace nereid {

/// A source of random numbers that begins anew with each test, and so do those of the C library, which Eigen draws from.
template <class Engine>
class ChanceOf : public Engine {
 public:
  explicit ChanceOf(typename Engine::result_type seed) : Engine(seed) {
    testing::UnitTest::GetInstance()->listeners().Append(new AtStart(*this, seed));  // which takes it
  }

 private:
  class AtStart : public testing::EmptyTestEventListener {
   public:
    AtStart(Engine& engine, typename Engine::result_type seed) : engine_(engine), seed_(seed) {}
    void OnTestStart(const testing::TestInfo&) override { engine_.seed(seed_), std::srand(1); }

   private:
    Engine& engine_;
    typename Engine::result_type seed_;
  };
};
using Chance = ChanceOf<std::mt19937>;
using Chance64 = ChanceOf<std::mt19937_64>;

}  // namespace nereid
