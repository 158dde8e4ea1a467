#include "contact/surface/projection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace nereid::contact::projection_test {
namespace {

class Draw {
 public:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 direction(double spread) {
    return (Vec3::UnitZ() + spread * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))).normalized();
  }
  /// Contacts whose normals lie within a cone, so that a penetration vector exists.
  Contacts contacts(int count, double spread) {
    Contacts c;
    c.count = count;
    for (int i = 0; i < count; ++i) c.normal[i] = direction(spread), c.depth[i] = uniform(-0.3, 1);
    return c;
  }

 private:
  std::mt19937 random_{3};
};

Vec3 way(const Contacts& c) {
  const auto lambda = projection_multipliers(c);
  Vec3 d = Vec3::Zero();
  for (int i = 0; i < c.count; ++i) d += lambda[i] * c.normal[i];
  return d;
}

/// Spreads from a sharp corner to facets that are all but coplanar.
constexpr std::array spreads{0.55, 0.3, 0.1, 1e-2, 1e-3, 1e-5, 1e-7};

TEST(ShortestWayOut, SatisfiesTheConditionsOfKarushKuhnAndTucker) {
  Draw draw;
  for (const double spread : spreads) {
    double worst_lack = 0, worst_slack = 0;
    for (int trial = 0; trial < 3000; ++trial) {
      const Contacts c = draw.contacts(1 + trial % most_candidates, spread);
      const auto lambda = projection_multipliers(c);
      const Vec3 d = way(c);
      int active = 0;
      for (int i = 0; i < c.count; ++i) {
        const double lack = c.depth[i] - c.normal[i].dot(d);
        EXPECT_GE(lambda[i], 0);
        active += lambda[i] > 0;
        worst_lack = std::max(worst_lack, lack);
        worst_slack = std::max(worst_slack, std::min(lambda[i], -lack));  // complementarity
      }
      EXPECT_LE(active, 3);
    }
    EXPECT_LT(worst_lack, 1e-9) << "spread " << spread;
    EXPECT_LT(worst_slack, 1e-9) << "spread " << spread;
  }
}

TEST(ShortestWayOut, MovesNoFartherThanTheApexThatIsPushed) {
  // the end p + d is a projection on a convex set: |end' - end| <= |p' - p|
  Draw draw;
  for (const double spread : spreads) {
    double worst = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      const Contacts c = draw.contacts(1 + trial % most_candidates, spread);
      const Vec3 step = draw.uniform(1e-6, 0.3) * draw.direction(1);
      Contacts moved = c;
      for (int i = 0; i < c.count; ++i) moved.depth[i] -= c.normal[i].dot(step);
      worst = std::max(worst, (step + way(moved) - way(c)).norm() - step.norm());
    }
    EXPECT_LT(worst, 1e-9) << "spread " << spread;
  }
}

TEST(ShortestWayOut, IsContinuousWhereContactsComeAndGo) {
  // depths vary along a line in small steps; the way may change by a step times the worst pair's angle
  Draw draw;
  double worst = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Contacts c = draw.contacts(most_candidates, 0.4);
    std::array<double, most_candidates> rate{};
    const Vec3 direction = draw.direction(1);
    for (int i = 0; i < c.count; ++i) rate[i] = -c.normal[i].dot(direction);
    Vec3 before = way(c);
    for (int step = 0; step < 300; ++step) {
      for (int i = 0; i < c.count; ++i) c.depth[i] += 1e-2 * rate[i];
      const Vec3 after = way(c);
      worst = std::max(worst, (after - before).norm());
      before = after;
    }
  }
  EXPECT_LT(worst, 1e-2 * (1 + 1e-6));
}

TEST(ShortestWayOut, OfOneContactIsItsDepth) {
  Contacts c;
  c.count = 1;
  c.normal[0] = Vec3(1, 2, 2) / 3;
  c.depth[0] = 0.25;
  EXPECT_DOUBLE_EQ(projection_multipliers(c)[0], 0.25);
  c.depth[0] = -0.25;
  EXPECT_EQ(projection_multipliers(c)[0], 0);
  c.depth[0] = 0;
  EXPECT_EQ(projection_multipliers(c)[0], 0);
  c.count = 0;
  EXPECT_TRUE(way(c).isZero(0));
}

TEST(ShortestWayOut, OfAPartOfANormalIsLonger) {
  // a symmetry plane leaves the part of a normal in the plane: the way along it is depth / cos
  Contacts c;
  c.count = 1;
  c.normal[0] = Vec3(0, 0, 0.8);
  c.depth[0] = 0.4;
  EXPECT_NEAR(way(c).z(), 0.5, 1e-15);
}

TEST(ShortestWayOut, CountsCoplanarFacetsOnce) {
  Contacts c;
  c.count = most_candidates;
  for (int i = 0; i < c.count; ++i) c.normal[i] = Vec3::UnitZ(), c.depth[i] = 0.1 * (1 + 1e-15 * i);
  EXPECT_NEAR((way(c) - Vec3(0, 0, 0.1)).norm(), 0, 1e-12);
}

TEST(ShortestWayOut, PushesFullyOnBothFlanksOfARightAngle) {
  Contacts c;
  c.count = 2;
  c.normal[0] = Vec3::UnitX(), c.normal[1] = Vec3::UnitZ();
  c.depth[0] = 0.1, c.depth[1] = 0.2;
  EXPECT_EQ(way(c), Vec3(0.1, 0, 0.2));
}

}  // namespace
}  // namespace nereid::contact::projection_test
