#include "contact/penalty/impact_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "contact/contact.hpp"
#include "contact/penalty/rigid_plane.hpp"

namespace nereid::contact::impact_step_test {
namespace {

TEST(Bounce, ReproducesTheTableOfRebounds) {
  // The penalty oscillator: rebound over impact speed of central differences on an on/off spring
  const auto rebound = [](double step) { return std::sqrt(1 + energy_created_in_a_bounce(step)); };
  EXPECT_NEAR(rebound(0.05), 1.0002, 1.01e-4);
  EXPECT_NEAR(rebound(0.1), 1.0012, 1.01e-4);
  EXPECT_NEAR(rebound(0.2), 1.0044, 1.01e-4);
  EXPECT_NEAR(rebound(0.5), 1.0222, 1.01e-4);
}

TEST(Bounce, CreatesAtMostTheSquareOfTheStepOverFour) {
  // v^2 + x_n x_(n+1) is kept while the spring acts; touch can take nothing from it and release can
  // give back no more than (step v / 2)^2: docs/theory/contact_energy.md
  double most = 0, least = 1;
  for (int i = 1; i <= 1000; ++i) {
    const double step = 5e-4 * i, ratio = energy_created_in_a_bounce(step) * (4 - step * step) / (step * step);
    most = std::max(most, ratio), least = std::min(least, ratio);
  }
  EXPECT_LE(most, 1 + 1e-9);
  EXPECT_GT(most, 0.99);   // the bound is attained
  EXPECT_LT(least, 0.05);  // and missed by far: what is created swings with the step
}

TEST(Bounce, StepKeepsTheBoundAndSoDoesEverySmallerStep) {
  for (const double bound : {1e-4, 1e-3, 0.005, 0.01, 0.03}) {
    const double step = impact_step_factor_for(bound);
    double most = 0, beyond = 0;
    for (int i = 1; i <= 200; ++i) {
      most = std::max(most, energy_created_in_a_bounce(step * i / 200));
      beyond = std::max(beyond, energy_created_in_a_bounce(step * (1 + 0.2 * i / 200)));
    }
    EXPECT_LE(most, bound);
    EXPECT_GT(beyond, bound);
  }
}

TEST(Bounce, StepOfTheDefaultBoundIsTheOneInterfacesHave) {
  EXPECT_NEAR(impact_step_factor_for(0.005), Interface{}.impact_step_factor, 1e-4);
  EXPECT_NEAR(impact_step_factor_for(0.005), RigidPlane{}.impact_step_factor, 1e-4);
  EXPECT_LE(Interface{}.impact_step_factor, impact_step_factor_for(0.005));
}

TEST(Bounce, StepIsCappedWhereABounceCreatesFourAndAHalfPercent) {
  EXPECT_EQ(impact_step_factor_for(0.9), 0.5);
  EXPECT_NEAR(energy_created_in_a_bounce(0.5), 0.045, 1e-3);
}

TEST(Bounce, RefusesABoundThatIsNone) {
  EXPECT_THROW(impact_step_factor_for(0), InternalError);
  EXPECT_THROW(impact_step_factor_for(1), InternalError);
}

}  // namespace
}  // namespace nereid::contact::impact_step_test
