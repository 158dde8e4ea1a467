#include "contact/tracking/shortest_exit.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include "tests/contact/pressed.hpp"

namespace nereid::contact::shortest_exit_test {
namespace {

using geometry::Kind;
using namespace pressed;

TEST(Force, OverAFacetIsTheGradientOfTheStoredEnergy) {
  for (const double h_c : {0.1, 0.0})
    has_a_potential(press(sheet(4, 4, flat, 0.2), {{1.33, 1.21, h_c - 0.03}}, h_c), by_differences);
}

TEST(Force, OverARidgeIsTheGradientOfTheStoredEnergy) {
  const Scene scene = press(sheet(4, 4, fold(-0.5), 0), {{2.01, 1.3, 0.07}}, 0.1);
  EXPECT_EQ(scene.memory.feature[0].kind, Kind::edge);
  has_a_potential(scene, by_differences);
}

TEST(Force, OverAVertexIsTheGradientOfTheStoredEnergy) {
  const Scene scene = press(corner(false), {Vec3(-0.03, -0.04, -0.05)}, 0.1);
  EXPECT_EQ(scene.memory.feature[0].kind, Kind::vertex);
  has_a_potential(scene, by_differences);
}

TEST(Force, InAValleyIsTheGradientOfTheStoredEnergy) {
  for (const double slope : {0.01, 0.1, 0.5, 1.0}) {
    // a depth of 0.03 at equal heights, a little off the middle so that both flanks push unequally
    const double up = 0.07 * std::sqrt(1 + slope * slope);
    const Scene scene = press(sheet(4, 4, fold(slope), 0), {{2 + 0.003 * slope, 1.3, up}}, 0.1);
    EXPECT_EQ(scene.element().count, 2) << slope;
    has_a_potential(scene, by_differences);
  }
}

TEST(Force, InAValleyThatWasFlatIsTheGradientOfTheStoredEnergy) {
  const double slope = 0.5, up = 0.07 * std::sqrt(1 + slope * slope);
  Scene scene = press(sheet(4, 4, flat, 0), {{2.0015, 1.3, 0.07}}, 0.1);
  EXPECT_EQ(scene.element().count, 1);
  const Shape bent = sheet(4, 4, fold(slope), 0);
  scene.x.leftCols(bent.x.cols()) = bent.x;
  scene.move({2.0015, 1.3, up});
  scene.update(1);
  EXPECT_EQ(scene.element().count, 2) << "both flanks, as the surface stands now";
  has_a_potential(scene, by_differences);
}

TEST(Force, BelowAValleyIsTheGradientOfTheStoredEnergy) {
  for (const double x : {2.001, 1.7}) has_a_potential(press(sheet(4, 4, fold(0.5), 0), {{x, 1.3, -0.03}}, 0.0), by_differences);
}

TEST(Force, InACornerOfThreeFlanksIsTheGradientOfTheStoredEnergy) {
  const Scene scene = press(corner(true), {Vec3(0.06, 0.07, 0.08)}, 0.1);
  EXPECT_EQ(scene.element().count, 3);
  has_a_potential(scene, by_differences);
  EXPECT_LT((scene.forces().col(scene.apex()) - penalty * Vec3(0.04, 0.03, 0.02)).norm(), 1e-10);
}

TEST(Force, AtASaddleIsTheGradientOfTheStoredEnergy) {
  const auto saddle = [](double x, double y) { return -0.5 * std::abs(x - 2) + 0.3 * std::abs(y - 2); };
  int several = 0;
  for (const double x : {2.0007, 2.01, 1.97}) {
    for (const double y : {2.0011, 2.004, 1.98}) {
      const Scene scene = press(sheet(4, 4, saddle, 0), {{x, y, 0.085}}, 0.1);
      several += scene.element().count > 1;
      has_a_potential(scene, 1e-5);
    }
  }
  EXPECT_GT(several, 2);
}

TEST(Force, OverRandomGroundIsTheGradientOfTheStoredEnergy) {
  // hills as high as the cells are wide: ridges, valleys, pits and saddles in all mixtures
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(-1, 1);
  int closed = 0, several = 0, mixed = 0, wrong = 0;
  double worst = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Shape shape = sheet(4, 4, flat, 0.2);
    for (Index n = 0; n < shape.x.cols(); ++n) shape.x(2, n) = 0.25 * unit(random);
    const bool over_a_pit = trial % 2 == 1;
    if (over_a_pit) shape.x(2, 12) = -0.4;
    const double away = over_a_pit ? 0.03 : 1.0;
    const Vec3 start(shape.x(0, 12) + away * unit(random), shape.x(1, 12) + away * unit(random), 3);
    const Scene probe = press(shape, {start}, 0.1);
    Scene scene = probe;
    const double top = 3 - (probe.memory.gap[0] + 0.1);
    scene.move({probe.x(0, probe.apex()), probe.x(1, probe.apex()), top + 0.1 * unit(random)});
    scene.update();
    for (int fall = 0; fall < 400 && scene.memory.gap[0] > -0.03; ++fall) {
      scene.x(2, scene.apex()) -= 0.005;
      scene.update();
    }
    if (scene.memory.status[0] != Status::closed) continue;
    ++closed;
    const ElementForces& element = scene.element();
    bool over_edge = false;
    for (int i = 0; i < element.count; ++i)
      for (const double weight : element.stencil[i].weight) over_edge = over_edge || weight == 0;
    several += element.count > 1, mixed += element.count > 1 && over_edge;
    const double error = gradient_error(scene);
    worst = std::max(worst, error);
    wrong += error > 1e-5;
  }
  EXPECT_GT(closed, 200);
  EXPECT_GT(several, 50);
  EXPECT_GT(mixed, 5);
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LE(wrong, closed / 100) << "of " << closed << ", worst " << worst;
}

TEST(Force, OnASymmetryPlaneIsTheGradientOfTheStoredEnergy) {
  // the apex may not move along x; one facet leans against that plane
  const auto lean = [](double x, double) { return 0.4 * x; };
  Scene scene = press(sheet(4, 4, lean, 0.2), {{1.3, 1.2, 0.4 * 1.3 + 0.07}}, 0.1);
  Mat3 allowed = Mat3::Identity();
  allowed(0, 0) = 0;
  scene.interface.allowed.assign(1, allowed);
  scene.update();
  EXPECT_EQ(scene.element().count, 1);
  EXPECT_LT(gradient_error(scene), by_differences);
}

// ------------------------------------------------------------------ an area counts once

/// Stiffness along z of an apex in a valley of a dihedral angle in degrees.
double stiffness_on_bisector(double dihedral) {
  const double slope = std::tan((180 - dihedral) / 2 * pi / 180), cosine = 1 / std::sqrt(1 + slope * slope);
  Scene scene = press(sheet(4, 4, fold(slope), 0), {{2, 1.3, 0.07 / cosine}}, 0.1);
  constexpr double step = 1e-6;
  const double here = scene.forces()(2, scene.apex());
  scene.x(2, scene.apex()) -= step;
  scene.update();
  return (scene.forces()(2, scene.apex()) - here) / step;
}

TEST(Valley, CountsATributaryAreaOnceAtEveryAngle) {
  for (const double dihedral : {90.0, 120.0, 150.0, 170.0, 179.0, 179.9, 179.999, 179.99999, 180.0})
    EXPECT_NEAR(stiffness_on_bisector(dihedral) / penalty, 1, 1e-6) << dihedral;
}

TEST(Valley, OfARightAnglePushesFullyOnBothFlanks) {
  const double h = 0.07;
  const Scene scene = press(sheet(4, 4, fold(1), 0), {{2, 1.3, h * std::sqrt(2.0)}}, 0.1);
  EXPECT_NEAR(scene.forces()(2, scene.apex()), penalty * (0.1 - h) * std::sqrt(2.0), 1e-9);
  double right = 0;  // what the flank beyond the fold gets, along its normal
  const Vectors f = scene.forces();
  for (Index n = 0; n < scene.base_nodes; ++n) right -= f.col(n).dot(Vec3(-1, 0, 1)) / std::sqrt(2.0);
  EXPECT_NEAR(right, penalty * (0.1 - h), 1e-9);
}

TEST(Exit, CountsSidesInOnePlaneOnceWhicheverWayTheyLeanToAThird) {
  // below a floor, and behind sides of two bodies that are flush: each leans a little towards the floor or away from it
  const double below = 0.01, behind = 0.02;
  std::array<Index, 3> order{0, 1, 2};
  do {
    for (const double lean : {1e-3, 1e-5, 1e-7, 0.0, -1e-7, -1e-5, -1e-3}) {
      Shape shape{Vectors(3, 9), Table<3>(3, 3)};
      for (Index f = 0; f < 3; ++f) {
        const double slope = f == 1 ? lean : f == 2 ? -0.7 * lean : 0;
        for (Index corner = 0; corner < 3; ++corner) {
          const double angle = 2 * std::acos(-1.0) * corner / 3, u = std::cos(angle), w = std::sin(angle);
          shape.x.col(3 * f + corner) = f == 0 ? Vec3(u, 0, -w) : Vec3(-slope * u, u, w);
          shape.facets(corner, f) = 3 * f + corner;
        }
      }
      const BaseSurface base = base_of(shape);
      Tracks tracks;
      for (const Index f : order) tracks.begin(f, 0);
      Stencils stencils;
      const Moved unknown{std::numeric_limits<double>::infinity(), 0};
      const Exit out = shortest_exit(base, shape.x, Vec3(-behind, -below, 0), 0, nullptr, unknown, tracks, stencils);
      EXPECT_NEAR(out.squared, below * below + behind * behind, 2 * std::abs(lean) * behind * behind + 1e-12) << lean;
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Exit, BelowAnEdgeHoldsWhereAnotherSidePushesAcrossIt) {
  const double below = 0.01, behind = 0.02;
  for (const double rise : {1e-7, 1e-5, 1e-3}) {  // of a valley that is almost flat, so that its edge is closest
    for (const bool floor_first : {true, false}) {
      Shape shape{Vectors(3, 7), Table<3>(3, 3)};
      shape.x << -behind, -behind, -behind - 1, -behind + 1, 0, 0, 0,  //
          0, 0, rise, rise, -1, 1, 0,                                  //
          -1, 1, 0, 0, -1, -1, 1;
      shape.facets.transpose() << 1, 0, 2, 0, 1, 3, 4, 5, 6;
      const BaseSurface base = base_of(shape);
      Tracks tracks;
      for (const Index f : {floor_first ? 0 : 2, floor_first ? 2 : 0}) tracks.begin(f, 0);
      Stencils stencils;
      const Moved unknown{std::numeric_limits<double>::infinity(), 0};
      const Exit out = shortest_exit(base, shape.x, Vec3(-behind, -below, 0), 0, nullptr, unknown, tracks, stencils);
      EXPECT_NEAR(out.squared, below * below + behind * behind, 2 * rise * behind * behind + 1e-12) << rise << floor_first;
    }
  }
}

TEST(Ridge, IsNoThinWallForAnApexAboveIt) {
  // a blade of 30 degrees: above one side the apex lies behind the other one's plane, and outside
  for (const double turn : {100.0, 120.0, 150.0}) {
    const double slope = std::tan(turn / 2 * pi / 180), cosine = 1 / std::sqrt(1 + slope * slope);
    const Shape blade = sheet(4, 4, fold(-slope), 0);
    const Vec3 normal = Vec3(slope, 0, 1) * cosine;
    for (const double down : {0.001, 0.005, 0.01, 0.015, 0.02, 0.03, 0.05, 0.1, 0.2}) {
      const Vec3 foot(2 + down, 1.3, -slope * down);
      const Scene scene = press(blade, {foot + 0.07 * normal}, 0.1);
      EXPECT_LT((scene.forces().col(scene.apex()) - penalty * 0.03 * normal).norm(), 1e-9) << turn << ' ' << down;
    }
  }
}

TEST(Ridge, WithoutContactHeightPushesTheShallowWayOut) {
  // Below a ridge two facets own the apex. The force is that of the less deep: never more than the
  // penalty times the depth; the energy is continuous where the direction turns, on the bisector.
  for (const double turn : {10.0, 45.0, 80.0}) {
    const double slope = std::tan(turn / 2 * pi / 180), cosine = 1 / std::sqrt(1 + slope * slope);
    Scene scene = press(sheet(4, 4, fold(-slope), 0), {{1.7, 1.3, -slope * 0.3 - 0.05}}, 0.0);
    double energy = stored(scene.memory), jump = 0;
    constexpr int steps = 600;
    for (int step = 0; step <= steps; ++step) {
      const double x = 0.6 * (static_cast<double>(step) / steps - 0.5), depth = 0.05 * cosine;
      scene.move({2 + x, 1.3, -slope * std::abs(x) - 0.05});
      scene.update();
      const Vec3 f = scene.forces().col(scene.apex());
      EXPECT_NEAR(f.norm(), penalty * depth, 1e-9);
      jump = std::max(jump, std::abs(stored(scene.memory) - energy));
      energy = stored(scene.memory);
    }
    EXPECT_LT(jump, 1e-9) << turn;
  }
}

// ------------------------------------------------------------------ the border, and being lost

TEST(Border, TheLayerIsRoundWithContactHeightAndAnApexThatLeavesComesBack) {
  Scene scene = press(sheet(4, 4, flat), {{3.9, 2.2, 0.07}}, 0.1);
  for (const double x : {3.9, 4.0, 4.05}) {  // 5 % of a face past the border it is still over the surface
    scene.move({x, 2.2, 0.07});
    scene.update();
    EXPECT_LT((scene.element().apex - Vec3(0, 0, penalty * 0.03)).norm(), 1e-9) << x;
  }
  for (const double x : {4.07, 4.1, 4.12}) {
    scene.move({x, 2.2, 0.07});
    scene.update();
    const Vec3 way(x - 4.05, 0, 0.07);
    EXPECT_LT((scene.element().apex - penalty * (0.1 - way.norm()) * way.normalized()).norm(), 1e-9) << x;
    has_a_potential(scene, by_differences);
  }
  scene.move({4.17, 2.2, 0.07});
  scene.update();
  EXPECT_EQ(scene.memory.status[0], Status::open);
  EXPECT_TRUE(scene.forces().isZero(0));
  scene.move({4.15, 4.15, 0.07});  // beyond a corner
  scene.update();
  EXPECT_EQ(scene.memory.status[0], Status::open);
  scene.move({3.9, 3.95, 0.07});
  scene.update();
  EXPECT_EQ(scene.memory.status[0], Status::closed);
}

TEST(Border, WithoutContactHeightTheForceFadesPastItAlongAPotential) {
  Scene scene = press(sheet(4, 4, flat), {{3.9, 2.2, -0.03}}, 0);
  double before = penalty * 0.03;
  for (const double past : {0.0, 0.03, 0.055, 0.07, 0.09, 0.109}) {  // whole up to 5 % of a face, then gone at twice the depth
    scene.move({4 + past, 2.2, -0.03});
    scene.update();
    const double u = std::max(0.0, past - 0.05) / 0.06, left = 0.03 * (1 - u * u);
    EXPECT_NEAR(std::sqrt(2 * stored(scene.memory) / penalty), left, 1e-12);
    EXPECT_LE(scene.element().apex.z(), before * (1 + 1e-9));
    before = scene.element().apex.z();
    if (past > 0) has_a_potential(scene, by_differences);
  }
  scene.move({4.111, 2.2, -0.03});
  scene.update();
  EXPECT_EQ(scene.near().tracks.count, 0);
  EXPECT_EQ(scene.memory.lost, 1);
  EXPECT_TRUE(scene.forces().isZero(0));
  for (const Vec3& place : {Vec3(4.05, 4.06, -0.03), Vec3(4.06, 3.2, -0.002)}) {  // past a corner; shallow, over the least way
    Scene other = press(sheet(4, 4, flat), {{3.9, 3.3, place.z()}}, 0);
    other.move(place);
    other.update();
    has_a_potential(other, 2e-6);
  }
}

TEST(Border, BelowTheSurfaceAndPastItsWallTheLayerHasAPotential) {
  for (const double past : {0.01, 0.06, 0.08, 0.12}) {
    Scene scene = press(sheet(4, 4, flat), {{3.9, 2.2, -0.02}}, 0.1);
    scene.move({4 + past, 2.2, -0.02});
    scene.update();
    has_a_potential(scene, 2e-6);
  }
}

TEST(Border, OfAnApexOnASymmetryPlaneActsAsAllOthers) {
  // the sheet ends at x = 0 because its image goes on there, and at y = 4 because it ends
  Mat3 allowed = Mat3::Identity();
  allowed(0, 0) = 0;
  for (const double contact_height : {0.1, 0.0}) {
    const double height = contact_height - 0.03;
    Scene in_plane = press(sheet(4, 4, flat), {{0, 3.9, height}}, contact_height);
    Scene inside = press(sheet(4, 4, flat), {{1.2, 3.9, height}}, contact_height);
    in_plane.interface.allowed.assign(1, allowed);
    goes_on_behind(in_plane.interface.base, nodes_at_zero(sheet(4, 4, flat).x, 0));
    for (const double y : {3.9, 4.0, 4.001, 4.03, 4.15}) {
      in_plane.move({0, y, height});
      inside.move({1.2, y, height});
      in_plane.update();
      inside.update();
      EXPECT_EQ(in_plane.memory.status[0], inside.memory.status[0]) << contact_height << ' ' << y;
      EXPECT_LT((allowed * in_plane.element().apex - inside.element().apex).norm(), 1e-9) << contact_height << ' ' << y;
    }
  }
}

TEST(Border, EnergyOfAnApexThatLeavesIsBooked) {
  Scene scene = press(sheet(4, 4, flat), {{3.9, 2.2, 0.07}}, 0.1);
  const double energy = stored(scene.memory);
  scene.move({4.15, 2.2, 0.07});
  scene.update();
  EXPECT_NEAR(scene.memory.created_by_reconnection, -energy, 1e-15);
}

// ------------------------------------------------------------------ odd surfaces

TEST(OddSurface, OfOneFacetPushesOverAllItsInterior) {
  Shape one{Vectors(3, 3), Table<3>(Eigen::Vector3i(0, 1, 2))};
  one.x << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  for (const Vec3& at : {Vec3(0.3, 0.3, 0.07), Vec3(0.5, 0.5, 0.07), Vec3(0, 0, 0.07), Vec3(0.2, 0, 0.07)})
    EXPECT_NEAR(press(one, {at}, 0.1).forces()(2, 3), penalty * 0.03, 1e-9);
  EXPECT_TRUE(press(one, {Vec3(-0.1, 0.3, 0.07)}, 0.1).forces().isZero(0));
}

/// `count` facets around the origin that rise like a cone by `slope`; the pit's axis is z.
Shape pit(int count, double slope) {
  Shape shape{Vectors::Zero(3, count + 1), Table<3>(3, count)};
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    shape.x.col(i + 1) = Vec3(std::cos(angle), std::sin(angle), slope);
    shape.facets.col(i) = Eigen::Vector3i(0, i + 1, (i + 1) % count + 1);
  }
  return shape;
}

// exact for the eight facets that are remembered; of more, the eight lowest push, 4 % short at worst
TEST(OddSurface, WithManyFacetsAtAVertexCountsTheAreaOnce) {
  for (const int count : {3, 5, 8, 12, 20, 40}) {
    for (const double slope : {0.0, 1e-3, 0.05, 0.3}) {
      // height over all facets alike on the axis
      const double tilt = slope / std::cos(pi / count), cosine = 1 / std::sqrt(1 + tilt * tilt);
      Scene scene = press(pit(count, slope), {Vec3(0, 0, 0.07 / cosine)}, 0.1);
      EXPECT_NEAR(scene.forces()(2, scene.apex()) / (penalty * 0.03 / cosine), 1, count <= most_candidates ? 1e-6 : 0.05)
          << count << ' ' << slope;
      // off the axis no facet is left out
      for (int i = 0; i < count; ++i) {
        const double angle = 2 * pi * (i + 0.5) / count;
        const Vec3 outwards(std::cos(angle), std::sin(angle), 0);
        scene.move(Vec3(0, 0, 0.08 / cosine) + 0.001 * outwards);
        scene.update();
        const Vec3 f = scene.forces().col(scene.apex());
        EXPECT_LE(f.dot(outwards), 1e-9) << count << ' ' << slope << ' ' << i;
        EXPECT_GT(f.z(), penalty * (count <= most_candidates ? 0.019 : 0.017) / cosine) << count << ' ' << slope;
      }
    }
  }
}

TEST(OddSurface, ThatIsClosedPushesOutEverywhere) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const Shape shape = ball(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 way = Vec3(normal(random), normal(random), normal(random)).normalized();
    for (const double r : {0.9, 1.0, 1.05}) {
      const Scene scene = press(shape, {r * way}, 0.1);
      const Vec3 f = scene.forces().col(scene.apex());
      EXPECT_GE(f.dot(way), 0.9 * f.norm());
      EXPECT_LE(f.norm(), penalty * (1.1 - r + 1e-12));
    }
  }
}

TEST(OddSurface, PushesAnApexOnNodesAndEdgesOnce) {
  Scene scene = press(sheet(6, 6, flat, 0.2), {{2, 2, 0.07}}, 0.1);
  for (Index f = 0; f < scene.interface.base.facets.cols(); ++f) {
    for (int a = 0; a < 3; ++a) {
      const Vec3 node = scene.x.col(scene.interface.base.facets(a, f));
      const Vec3 next = scene.x.col(scene.interface.base.facets((a + 1) % 3, f));
      for (const double s : {0.0, 0.25, 0.5}) {
        scene.move((1 - s) * node + s * next + Vec3(0, 0, 0.07));
        scene.update();
        ASSERT_EQ(scene.memory.status[0], Status::closed);
        EXPECT_NEAR(scene.forces()(2, scene.apex()), penalty * 0.03, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace nereid::contact::shortest_exit_test
