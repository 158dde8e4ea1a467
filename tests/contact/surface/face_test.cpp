#include "contact/surface/face.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nereid::contact::face_test {
namespace {

/// A warped face around a point at the origin, over the middle of it or near an edge.
std::array<Vector<double>, 4> warped(std::mt19937& engine, double aside) {
  std::uniform_real_distribution<double> number(-0.1, 0.1);
  const auto off = [&] { return number(engine); };
  return {{{-1 - aside + off(), -1 + off(), -0.3 + off()},
           {1 - aside + off(), -1 + off(), -0.3 + off()},
           {1 - aside + off(), 1 + off(), -0.3 + off()},
           {-1 - aside + off(), 1 + off(), -0.3 + off()}}};
}

OverFace<double> over(const std::array<Vector<double>, 4>& corner, bool& stands) {
  OverFace<double> at;
  at.at.a = at.at.b = 0.5;
  stands = stand_over(corner, at);
  return at;
}

TEST(Face, TheFootIsTheClosestPointAndItsWeightsLeadThere) {
  std::mt19937 engine(3);
  for (int round = 0; round < 100; ++round) {
    const auto corner = warped(engine, 0.3);
    bool stands = false;
    const OverFace<double> at = over(corner, stands);
    ASSERT_TRUE(stands);
    EXPECT_NEAR(norm(at.normal), 1, 1e-14);
    Vector<double> foot{0, 0, 0};
    for (int I = 0; I < 4; ++I) foot = foot + at.weight[I] * corner[I];
    EXPECT_LT(norm(foot + at.height * at.normal), 1e-13) << round;
  }
}

TEST(Face, AllLanesOfAPackStandAsTheyDoAlone) {
  std::mt19937 engine(4);
  for (int round = 0; round < 100; ++round) {
    std::array<std::array<Vector<double>, 4>, lanes> faces;
    for (int lane = 0; lane < lanes; ++lane) faces[lane] = warped(engine, lane == round % lanes ? 3 : lane % 2 == 0 ? 0.95 : 0.2);
    std::array<Vector<Pack>, 4> corner;
    for (int I = 0; I < 4; ++I)
      for (int axis = 0; axis < 3; ++axis) corner[I][axis] = Pack([&](auto lane) { return faces[static_cast<int>(lane)][I][axis]; });
    OverFace<Pack> all;
    all.at.a = all.at.b = Pack(0.5);
    const Mask<Pack> stand = stand_over(corner, all), within = is_within(Pack(0.05), all);
    for (int lane = 0; lane < lanes; ++lane) {
      bool stands = false;
      const OverFace<double> alone = over(faces[lane], stands);
      EXPECT_EQ(stand[lane], stands) << round;
      EXPECT_EQ(stands, lane != round % lanes) << "far beside its face there is no foot";
      if (!stands) continue;
      EXPECT_NEAR(all.height[lane], alone.height, 1e-14) << round;
      EXPECT_NEAR(all.normal.z[lane], alone.normal.z, 1e-14) << round;
      for (int I = 0; I < 4; ++I) EXPECT_NEAR(all.weight[I][lane], alone.weight[I], 1e-14) << round;
      EXPECT_EQ(within[lane], is_within(0.05, alone)) << round;
    }
  }
}

TEST(Face, AFaceThatIsWarpedTooMuchHasNoFoot) {
  bool stands = true;
  over({{{-1, -1, -2}, {1, -1, 0}, {1, 1, -2}, {-1, 1, 6}}}, stands);
  EXPECT_FALSE(stands);
}

}  // namespace
}  // namespace nereid::contact::face_test
