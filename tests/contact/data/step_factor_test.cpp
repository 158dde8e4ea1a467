#include "contact/data/step_factor.hpp"

#include <gtest/gtest.h>

#include "contact/penalty/impact_step.hpp"
#include "contact/penalty/rigid_plane.hpp"

namespace nereid::contact::step_factor_test {
namespace {

TEST(StepFactor, IsLongerUntilItIsLoweredAndNeverBelowTheImpacts) {
  RigidPlane plane;
  plane.first_step_factor = 0.5, plane.impact_step_factor = 0.14;
  EXPECT_EQ(step_factor(plane, {}), 0.5);
  EXPECT_EQ(step_factor(plane, {.lowered_at = 0}), 0.14);
  plane.first_step_factor = 0;
  EXPECT_EQ(step_factor(plane, {}), 0.14);
}

TEST(StepFactor, TheMostOfABounceIsTheInverseOfTheImpactStepFactor) {
  for (const double bound : {1e-5, 0.005, 0.04})
    EXPECT_NEAR(most_created_in_a_bounce(impact_step_factor_for(bound)), bound, 1e-15);
}

}  // namespace
}  // namespace nereid::contact::step_factor_test
