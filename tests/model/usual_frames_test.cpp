#include "model/usual_frames.hpp"

#include <gtest/gtest.h>

#include "tests/model/scenes.hpp"

namespace nereid::model::usual_frames_test {
namespace {

TEST(UsualFrames, AreFortyWhereTheyAreCheap) {
  EXPECT_EQ(usual_frames(8, 1, 10), 40);
  EXPECT_EQ(usual_frames(1'300, 1'000, 50), 40) << "in a tenth of a second";
  EXPECT_EQ(usual_frames(265'000, 250'000, 1e5), 40) << "beside many steps";
}

TEST(UsualFrames, TakeATenthOfTheStepsAtMost) {
  const double nodes = 265'000, elements = 250'000;
  double before = 1;
  for (const double steps : {250.0, 1000.0, 2000.0, 3000.0}) {
    const double found = usual_frames(nodes, elements, steps);
    EXPECT_GE(found, before);
    if (found > 1) {
      EXPECT_EQ(found, usual_frames(2 * nodes, 2 * elements, steps)) << "both grow with the scene";
    }
    before = found;
  }
  EXPECT_GT(before, 1);
  EXPECT_LT(usual_frames(nodes, elements, 250), 10);
  EXPECT_EQ(usual_frames(nodes, elements, 1), 1) << "a run has its first and last state";
}

TEST(UsualFrames, FollowFromTheFirstStepOfARun) {
  Scene scene = with({bar()});
  scene.time.end = 1;
  Simulation simulation = build(scene);
  EXPECT_FALSE(simulation.recording.frames > 0);
  EXPECT_DOUBLE_EQ(simulation.time.audit_every, 1.0 / 40);
  simulation.state.progress.first_step = 0.01;
  EXPECT_DOUBLE_EQ(frames_every(simulation), 1.0 / 40);
  simulation.recording.frames = 0.3;
  EXPECT_DOUBLE_EQ(frames_every(simulation), 0.3) << "the case leads";
}

}  // namespace
}  // namespace nereid::model::usual_frames_test
