#include "contact/tracking/tracking.hpp"

#include "contact/tracking/depth.hpp"
#include "contact/search/near.hpp"
#include "contact/surface/cone.hpp"
#include "mesh/adjacency.hpp"
#include "tests/contact/pressed.hpp"

namespace nereid::contact::tracking_test {
namespace {

using geometry::Kind;
using namespace pressed;

// ------------------------------------------------------------------ initial penetration

TEST(InitialPenetrations, AreReportedWithTheirNumberAndDepthAndNothingIsPushed) {
  const Shape shape = sheet(4, 4, flat);
  const Scene scene = press(shape, {{1.2, 1.3, 0.07}, {2.2, 2.3, 0.2}, {3.2, 2.3, -0.01}}, 0.1);
  EXPECT_EQ(scene.gaps.apexes, 3);
  EXPECT_EQ(scene.gaps.penetrating, 2);
  EXPECT_NEAR(scene.gaps.deepest, 0.11, 1e-14);
  EXPECT_NEAR(scene.gaps.least, -0.11, 1e-14);
  EXPECT_NEAR(scene.gaps.largest, 0.1, 1e-14);
  EXPECT_EQ(scene.x(2, scene.apex(2)), -0.01);
  EXPECT_EQ(scene.gaps.by_kind[static_cast<int>(Kind::facet)], 3);
}

TEST(InitialPenetrations, AcceptedBecomeOffsetsThatMakeNoForceAndShrink) {
  const Shape shape = sheet(4, 4, flat);
  Vectors x(3, shape.x.cols() + 2);
  x << shape.x, Vec3(1.2, 1.3, 0.07), Vec3(2.2, 2.3, -0.01);
  Scene scene = scene_of(x, interface_over(shape, 2), {false, 0, 0.1}, InitialPenetration::accept);
  EXPECT_EQ(scene.gaps.penetrating, 2);
  EXPECT_NEAR(scene.offset(0), 0.03, 1e-15);
  EXPECT_NEAR(scene.offset(1), 0.11, 1e-15);
  scene.update();
  EXPECT_LT(scene.forces().norm(), 1e-10);
  scene.x(2, scene.apex(1)) -= 0.02;
  scene.update();
  EXPECT_NEAR(scene.forces()(2, scene.apex(1)), penalty * 0.02, 1e-9);
  for (const double z : {0.05, 0.0999, 0.15}) {  // it leaves, without a force
    scene.x(2, scene.apex(1)) = z;
    scene.update();
    EXPECT_TRUE(scene.forces().col(scene.apex(1)).isZero(0)) << z;
    EXPECT_NEAR(scene.offset(1), std::max(0.0, 0.1 - z), 1e-15);
  }
  scene.x(2, scene.apex(1)) = 0.08;  // and lands on the surface
  scene.update();
  EXPECT_NEAR(scene.forces()(2, scene.apex(1)), penalty * 0.02, 1e-9);
}

TEST(EntryOfAnApex, ThroughTheSurfaceIsContact) {
  Scene scene = press(sheet(4, 4, flat), {{1.2, 1.3, 0.2}}, 0.1);
  step_to(scene, 0, {1.25, 1.3, 0.04});
  EXPECT_EQ(scene.memory.status[0], Status::closed);
  EXPECT_NEAR(scene.forces()(2, scene.apex()), penalty * 0.06, 1e-9);
}

TEST(EntryOfAnApex, FromTheSideUnderASurfaceIsNone) {
  Scene scene = press(sheet(4, 4, flat), {{4.5, 2.3, -0.3}}, 0);  // the sheet ends at 4
  for (double x = 4.4; x > 2; x -= 0.1) {
    step_to(scene, 0, {x, 2.3, -0.3});
    ASSERT_TRUE(scene.forces().isZero(0)) << x;
    ASSERT_NE(scene.memory.status[0], Status::closed);
  }
}

TEST(EntryOfAnApex, FromTheSideAsDeepAsItsNeighbourMakesNoForceThatSpringsAndThenResists) {
  Scene scene = press(sheet(4, 4, flat), {{2.2, 2.3, 0.1}, {4.5, 2.3, -0.04}}, 0);
  step_to(scene, 0, {2.2, 2.3, -0.03});
  for (double x = 4.4; x > 3.5; x -= 0.02) step_to(scene, 1, {x, 2.3, -0.04});
  EXPECT_NEAR(scene.offset(1), 0.04, 1e-15);
  EXPECT_NEAR(scene.forces()(2, scene.apex(1)), 0, 1e-9);
  step_to(scene, 1, {3.5, 2.3, -0.05});
  EXPECT_NEAR(scene.forces()(2, scene.apex(1)), penalty * 0.01, 1e-9);
  EXPECT_LT(std::abs(scene.memory.created_by_reconnection), 1e-12);
}

TEST(EntryOfAnApex, FromTheSideIsOpenWhateverRoundOffSays) {
  for (int k = 1; k < 30; ++k) {  // of planes that are not along an axis, whose heights have round-off of either sign
    const double slope = 0.01 * k, depth = 0.04 + 1e-4 * k;
    const auto below = [&](double x, double by) { return Vec3(x, 2.3, slope * x - by); };
    Scene scene = press(sheet(4, 4, [slope](double x, double) { return slope * x; }), {below(2.2, -0.1), below(4.5, depth)}, 0);
    step_to(scene, 0, below(2.2, 0.03));
    for (double x = 4.4; x > 3.5 && scene.near(1).tracks.count == 0; x -= 0.02) step_to(scene, 1, below(x, depth));
    ASSERT_EQ(scene.near(1).tracks.count, 1);
    EXPECT_EQ(scene.memory.status[1], Status::open) << slope;
    EXPECT_GT(scene.memory.gap[1], 0) << slope;
    EXPECT_LT(scene.memory.gap[1], 1e-11) << slope;
  }
}

Shape both(const Shape& one, const Shape& other) {
  Shape two{Vectors(3, one.x.cols() + other.x.cols()), Table<3>(3, one.facets.cols() + other.facets.cols())};
  two.x << one.x, other.x;
  two.facets << one.facets, (other.facets.array() + static_cast<Index>(one.x.cols())).matrix();
  return two;
}

TEST(EntryOfAnApex, IntoAThinBodyIsRememberedBeyondItsMiddle) {
  Scene scene = press(block({0, 0, 0}, {4, 4, 0.1}, {4, 4, 1}), {{1.3, 1.2, 0.15}}, 0);
  for (double z = 0.12; z > -0.05; z -= 0.03) step_to(scene, 0, {1.3, 1.2, z});
  const Vec3 f = scene.forces().col(scene.apex());
  EXPECT_GT(f.z(), 0.1 * penalty);  // back to where it came from, and more than the thickness
  EXPECT_LT(f.head<2>().norm(), 1e-9);
}

TEST(EntryOfAnApex, IntoTwoPartsOfASurfaceIsPushedOutOfBoth) {
  Scene scene = press(both(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}), block({2, 0, 0.9}, {4, 4, 2}, {2, 4, 1})), {{1.9, 1.7, 1.05}}, 0);
  step_to(scene, 0, {1.97, 1.7, 0.98});
  step_to(scene, 0, {2.02, 1.7, 0.97});
  EXPECT_EQ(scene.near().tracks.count, 2);
  EXPECT_LT((Vec3(scene.forces().col(scene.apex())) - penalty * Vec3(-0.02, 0, 0.03)).norm(), 1e-9);
}

TEST(EntryOfAnApex, OnARidgeOrACornerIsThroughAllItsSides) {
  const Shape block = skin();  // 1 x 1 x 0.3 m
  const auto tracks = [&](const Vec3& from, const Vec3& to) {
    Scene scene = press(block, {from}, 0);
    step_to(scene, 0, to);
    const Vec3 push = scene.forces().col(scene.apex());
    EXPECT_GT(push.dot(from - to), 0.999 * push.norm() * (from - to).norm());  // back the way it came
    return scene.near().tracks.count;
  };
  EXPECT_EQ(tracks({0.5, 0.4, 0.31}, {0.5, 0.4, 0.29}), 1);
  EXPECT_EQ(tracks({1.01, 0.4, 0.31}, {0.99, 0.4, 0.29}), 2);
  EXPECT_EQ(tracks({1.01, 1.01, 0.31}, {0.99, 0.99, 0.29}), 3);
}

TEST(EntryOfAnApex, HeadOnIsSeenJustBesideARidgeThatItsOwnSurfaceLiesOver) {
  const Shape block = skin();  // 1 x 1 x 0.3 m
  const auto tracks = [&](double past, double toward) {  // how far beside the ridge it comes down, and where its surface goes on from there
    const auto first = static_cast<Index>(block.x.cols());
    Vectors x(3, first + 3);
    x << block.x, Vec3(1 + past, 0.4, 0.31), Vec3(1 + past + toward, 0.3, 0.31), Vec3(1 + past + toward, 0.5, 0.31);
    Interface in = interface_over(block, 1);
    Table<3> own(3, 1);
    own.col(0) << first, first + 1, first + 2;
    if (facet_normal(fans(own, first + 3), x, 0).z() > 0) std::swap(own(1, 0), own(2, 0));  // it faces down
    in.own = fans(own, first + 3);
    Scene scene = scene_of(x, in, {false, 0, 0});
    scene.update();
    step_to(scene, 0, {1 + past, 0.4, 0.29});
    return scene.near().tracks.count;
  };
  for (const double past : {1e-8, 1e-5}) {
    EXPECT_EQ(tracks(past, -0.2), 1) << "its face is over that of the block";
    EXPECT_EQ(tracks(past, 0.2), 0) << "its body passes beside the block";
  }
  EXPECT_EQ(tracks(0.1, -0.2), 0) << "farther than neighbours overlap";
}

TEST(EntryOfAnApex, PastAnOpenBorderIsSeenHoweverSlowlyItComesDown) {
  // as far past the border as a force stays whole, the facet is nearer below than beside
  Scene scene = press(sheet(4, 4, flat), {{4.04, 2.3, 0.2}}, 0);
  for (double z = 0.199; z > -0.02; z -= 0.001) step_to(scene, 0, {4.04, 2.3, z});
  EXPECT_EQ(scene.near().tracks.count, 1);
  EXPECT_NEAR(scene.forces()(2, scene.apex()), -penalty * scene.x(2, scene.apex()), 1e-9);
}

Shape with_both_sides(Shape shape) {
  shape.facets = mesh::both_sides(shape.facets);
  return shape;
}

TEST(EntryOfAnApex, OverASheetWithBothSidesIsOnTheSideFromWhichItComes) {
  for (const double side : {1.0, -1.0}) {
    Scene scene = press(with_both_sides(sheet(4, 4, flat)), {{1.2, 1.3, 0.2 * side}}, 0.1);
    step_to(scene, 0, {1.25, 1.3, 0.07 * side});
    EXPECT_NEAR(scene.forces()(2, scene.apex()), side * penalty * 0.03, 1e-9);
    step_to(scene, 0, {1.25, 1.3, -0.02 * side});  // through the middle it is still on that side
    EXPECT_NEAR(scene.forces()(2, scene.apex()), side * penalty * 0.12, 1e-9);
  }
}

TEST(EntryOfAnApex, BetweenBothSidesOfASheetAtTheStartIsOnTheNearerSide) {
  for (const double side : {1.0, -1.0}) {
    Shape shape = with_both_sides(sheet(4, 4, flat));
    Vectors x(3, shape.x.cols() + 1);
    x << shape.x, Vec3(1.2, 1.3, 0.06 * side);
    const Scene scene = scene_of(x, interface_over(shape, 1), {false, 0, 0.1});
    EXPECT_EQ(scene.gaps.penetrating, 1);
    EXPECT_NEAR(scene.gaps.deepest, 0.04, 1e-15);
  }
}

TEST(NearestOf, ASheetWithBothSidesIsTheSideInFront) {
  for (const double side : {1.0, -1.0}) {
    const Scene scene = press(with_both_sides(sheet(4, 4, flat)), {{1.2, 1.3, 0.2 * side}}, 0.1);
    const Feature& feature = scene.memory.feature[0];
    EXPECT_EQ(facet_normal(scene.interface.base, scene.x, feature.facet).z(), side);
    EXPECT_NEAR(scene.memory.gap[0], 0.1, 1e-15);
  }
}

TEST(EntryOfAnApex, SlidesAroundTheRimOfASheetWithBothSides) {
  constexpr double h = 0.1, deep = 0.02;
  const auto round = [](double way) {  // along the top, around the rim at x = 4, and along the bottom
    const double r = h - deep, arc = EIGEN_PI * r;
    if (way < 0.5) return Vec3(3.5 + way, 2.3, r);
    const double angle = (way - 0.5) / r;
    return way < 0.5 + arc ? Vec3(4 + r * std::sin(angle), 2.3, r * std::cos(angle)) : Vec3(4 - (way - 0.5 - arc), 2.3, -r);
  };
  Scene scene = press(with_both_sides(sheet(4, 4, flat)), {{3.5, 2.3, 0.2}}, h);
  for (double way = 0; way < 1.2; way += 0.003) {
    step_to(scene, 0, round(way));
    ASSERT_EQ(scene.near().tracks.count, 1) << way;
    const Vec3 foot(std::min(4.0, round(way).x()), 2.3, 0), out = (round(way) - foot).normalized();
    EXPECT_LT((scene.forces().col(scene.apex()) - penalty * deep * out).norm(), 1e-6 * penalty * deep) << way;
  }
  EXPECT_LT(std::abs(scene.memory.created_by_reconnection), 1e-3 * stored(scene.memory));
  EXPECT_LT(scene.forces().rowwise().sum().norm(), 1e-12);
}

TEST(EntryOfAnApex, OntoTheRimOfASheetWithBothSides) {
  for (const double up : {0.02, 0.0, -0.02}) {
    Scene scene = press(with_both_sides(sheet(4, 4, flat)), {{4.2, 2.3, up}}, 0.1);
    step_to(scene, 0, {4.07, 2.3, up});
    const Vec3 push = scene.forces().col(scene.apex());
    EXPECT_NEAR(push.norm(), penalty * (0.1 - std::hypot(0.07, up)), 1e-6) << up;
    EXPECT_NEAR(push.z() / push.norm(), up / std::hypot(0.07, up), 1e-6) << up;
  }
}

TEST(EntryOfAnApex, PastAWallOfOnePartAndIntoAnotherBooksTheMomentThatIsLeft) {
  Scene scene = press(both(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}), block({4.06, 0, 0.5}, {6, 4, 2}, {2, 4, 1})), {{3.9, 1.7, 1.05}}, 0);
  step_to(scene, 0, {3.97, 1.7, 0.97});
  step_to(scene, 0, {4.04, 1.7, 0.97});
  step_to(scene, 0, {4.08, 1.7, 0.97});
  ASSERT_EQ(scene.near().tracks.count, 2);
  ASSERT_GT(scene.element().count, 2);
  const Vectors f = scene.forces();
  EXPECT_LT(f.rowwise().sum().norm(), 1e-12 * f.norm());
  Vec3 moment = Vec3::Zero();
  for (Index n = 0; n < scene.x.cols(); ++n) moment += Vec3(scene.x.col(n)).cross(Vec3(f.col(n)));
  scene.memory.angular_impulse.setZero();
  scene.update(2);  // at rest: half of it with the forces before, half with those after
  EXPECT_LT((scene.memory.angular_impulse - 2 * moment).norm(), 1e-9);
}

TEST(EntryOfAnApex, OfABodyUnderATableIsNone) {
  // the table's top from below: the foot of the body is near it, and faces the other way
  Scene scene = press(block({0, 0, 1}, {4, 4, 1.2}, {4, 4, 1}), {{-0.5, 2.1, 0.9}}, 0);
  for (double x = -0.4; x < 4.5; x += 0.1) {
    step_to(scene, 0, {x, 2.1, 0.98});
    ASSERT_TRUE(scene.forces().isZero(0)) << x;
  }
}

TEST(EntryOfAnApex, NeedsASurfaceThatFacesTheFacet) {
  // the corner of a body that comes over a rim goes through the side of the table, which it does not face
  for (const bool faces : {false, true}) {
    Scene scene = press(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}), {{-0.1, 2.1, 0.95}}, 0);
    Table<3> own(3, 1);
    const Index apex = scene.apex();
    scene.x.conservativeResize(3, apex + 3);
    // looks along x, or back and down
    scene.x.col(apex + 1) = faces ? Vec3(-0.1, 2.6, 0.95) : Vec3(-0.6, 2.1, 1.45);
    scene.x.col(apex + 2) = faces ? Vec3(-0.1, 2.6, 1.45) : Vec3(-0.1, 2.6, 0.95);
    own << apex, apex + 1, apex + 2;
    scene.interface.own = fans(own, apex + 3);
    const Vec3 normal = facet_normal(scene.interface.own, scene.x, 0);
    ASSERT_LT((normal - (faces ? Vec3(1, 0, 0) : Vec3(-1, 0, -1).normalized())).norm(), 1e-12);
    step_to(scene, 0, {0.02, 2.1, 0.95});
    ASSERT_EQ(scene.near().tracks.count, 1);
    const bool from_the_side = facet_normal(scene.interface.base, scene.x, scene.near().tracks.track[0].facet).x() < -0.5;
    EXPECT_EQ(from_the_side, faces);
    if (faces) continue;
    EXPECT_LT(scene.forces().norm(), 1e-9);  // with an offset: nothing springs
  }
}

TEST(EntryOfAnApex, OverARidgeByRoundOffIsNone) {
  // the rim of a block that lies flush on a block of its size, and slides on it
  Scene scene = press(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}), {{-1e-12, 2.1, 1 + 1e-12}}, 0);
  Table<3> own(3, 1);
  const Index apex = scene.apex();
  scene.x.conservativeResize(3, apex + 3);
  scene.x.col(apex + 1) = Vec3(-0.5, 2.1, 1.5), scene.x.col(apex + 2) = Vec3(0, 2.6, 1);  // it looks back and down
  own << apex, apex + 1, apex + 2;
  scene.interface.own = fans(own, apex + 3);
  for (const double x : {1e-12, 0.02}) {
    step_to(scene, 0, {x, 2.1, 1 + 1e-12});
    ASSERT_EQ(scene.near().tracks.count, 0);
  }
  step_to(scene, 0, {0.02, 2.1, 0.99});
  EXPECT_LT((Vec3(scene.forces().col(apex)) - Vec3(0, 0, 0.01 * penalty)).norm(), 1e-9);
}

TEST(EntryOfAnApex, BesideASideThatIsFlushIsOntoThatSideWithAnOffset) {
  for (const double height : {1.0, 0.01}) {        // of a block, or of a sheet of long cells, whose side is no less a step
    for (const double lower : {0.1, 0.9, 1.1}) {  // times the largest step that is flush
      const double z = height - lower * level_by * std::min(height, std::sqrt(2.0));
      Scene scene = press(block({0, 0, 0}, {4, 4, height}, {4, 4, 1}), {{-0.02, 2.1, z}}, 0);
      step_to(scene, 0, {0.02, 2.1, z});
      ASSERT_EQ(scene.near().tracks.count, 1);
      const bool onto = facet_normal(scene.interface.base, scene.x, scene.near().tracks.track[0].facet).z() > 0.5;
      EXPECT_EQ(onto, lower < 1) << height << ' ' << lower;
      EXPECT_EQ(scene.forces().norm() > 1e-9, !onto) << "with an offset nothing springs";
    }
  }
}

TEST(EntryOfAnApex, WhatFallsOnARidgeIsOntoTheSideThatItCameThrough) {
  // a roof of two flanks of 45 degrees: the fall of one step ends below both by less than what is flush
  const double z = std::sqrt(0.5);
  Shape roof = block({-0.5, 0, -0.5}, {0.5, 4, 0.5}, {1, 4, 1});
  const Mat3 turn = Eigen::AngleAxisd(0.25 * std::acos(-1.0), Vec3::UnitY()).toRotationMatrix();
  roof.x = (turn * roof.x).eval();
  Scene scene = press(roof, {{1e-5, 2.1, z + 2e-4}}, 0);
  step_to(scene, 0, {1e-5, 2.1, z - 2e-4});
  ASSERT_GE(scene.near().tracks.count, 1);
  EXPECT_GT(facet_normal(scene.interface.base, scene.x, scene.near().tracks.track[0].facet).x(), 0.5);
}

TEST(EntryOfAnApex, OverACornerByRoundOffIsNone) {
  // a corner of a cube that lies on a cube of its size, within it by round-off along one side and by more along the other
  for (const double far : {0.0, 4.0})
    for (const double wide : {0.0, 4.0})
      for (const bool along_x : {false, true}) {
        const double in_x = far > 0 ? -1 : 1, in_y = wide > 0 ? -1 : 1, dx = along_x ? 1e-12 : 2e-9, dy = along_x ? 2e-9 : 1e-12;
        Scene scene = press(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}), {{far + in_x * dx, wide + in_y * dy, 1}}, 0);
        Table<3> own(3, 3);
        const Index apex = scene.apex();
        scene.x.conservativeResize(3, apex + 4);
        const Vec3 at = scene.x.col(apex);
        scene.x.col(apex + 1) = at + Vec3(in_x, 0, 0), scene.x.col(apex + 2) = at + Vec3(0, in_y, 0);
        scene.x.col(apex + 3) = at + Vec3(0, 0, 1);
        const bool turned = in_x * in_y > 0;
        for (int f = 0; f < 3; ++f) {
          const Index one = apex + 1 + f, other = apex + 1 + (f + 1) % 3;
          own.col(f) << apex, (turned ? other : one), (turned ? one : other);
        }
        scene.interface.own = fans(own, apex + 4);
        const Vec3 normal = node_normal(scene.interface.own, scene.x, apex);
        ASSERT_LT((normal - Vec3(-in_x, -in_y, -1).normalized()).norm(), 1e-6) << normal.transpose();
        step_to(scene, 0, at + Vec3(in_x * 1e-13, in_y * 1e-13, 1e-13));
        EXPECT_EQ(scene.near().tracks.count, 0) << far << ' ' << wide << ' ' << along_x;
      }
}

TEST(Penetration, OfAnApexNearAnotherFaceIsReportedNoDeeperThanThatIsFar) {
  Scene scene = press(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}), {{0.06, 2.1, 1.1}}, 0);
  for (double z = 1; z > 0.45; z -= 0.05) step_to(scene, 0, {0.06, 2.1, z});
  EXPECT_NEAR(scene.element().depth, 1 - scene.x(2, scene.apex()), 1e-12) << "it is pushed back to where it came from";
  EXPECT_NEAR(scene.memory.deepest, 0.06, 1e-12);
  EXPECT_EQ(scene.memory.deepest_apex, scene.apex());
}

/// What overlap_of() says of an apex at a place that a facet presses: the one at the place `pressed_at` whose normal is nearest to `side`.
double overlap(const Shape& shape, double contact_height, const Vec3& place, const Vec3& pressed_at, const Vec3& side) {
  const Scene scene = press(shape, {place}, contact_height);
  const BaseSurface& base = scene.interface.base;
  Index facet = 0;
  const auto miss = [&](Index f) {
    const Vector<double> at{pressed_at.x(), pressed_at.y(), pressed_at.z()};
    return geometry::closest_on_triangle(corners(base, scene.x, f), at).distance_squared - 1e-6 * facet_normal(base, scene.x, f).dot(side);
  };
  for (Index f = 1; f < base.facets.cols(); ++f)
    if (miss(f) < miss(facet)) facet = f;
  Near near = scene.near();
  near.element.count = 1;
  near.element.stencil[0].facet = facet, near.element.stencil[0].apex = 1;
  return overlap_of(scene.interface, scene.x, near, scene.memory);
}

TEST(Penetration, AtASheetIsTheOverlapOfLayersOnTheSideThatTheApexIsOn) {
  const Vec3 up(0, 0, 1);
  Shape shape = sheet(4, 4, flat);
  shape.facets = mesh::both_sides(shape.facets);
  EXPECT_NEAR(overlap(shape, 0.5, {2.2, 2.3, 0.1}, {2.2, 2.3, 0}, up), 0.4, 1e-12);
  for (const double side : {-1.0, 1.0}) EXPECT_NEAR(overlap(shape, 0.5, {2.2, 2.3, -0.1}, {2.2, 2.3, 0}, side * up), 0.4, 1e-12);
  for (const double side : {-1.0, 1.0})  // past the rim neither side has it behind
    for (const double height : {-0.03, 0.0, 0.03})
      EXPECT_NEAR(overlap(shape, 0.5, {4.04, 2.3, height}, {4, 2.3, 0}, side * up), 0.5 - std::hypot(0.04, height), 1e-12);
}

TEST(Penetration, InAFoldOfASheetIsTheOverlapWithTheWallThatIsNearest) {
  Shape shape = sheet(9, 2, flat);
  for (auto at : shape.x.colwise()) {  // two walls, 1.2 m apart, around x = 4.5
    const double past = at.x() - 4.5, angle = std::clamp(past / 1.5, -1.0, 1.0) * 0.5 * M_PI;
    at = std::abs(past) < 1.5 ? Vec3(3 + std::cos(angle), at.y(), 0.6 * std::sin(angle))
                              : Vec3(4.5 - std::abs(past), at.y(), std::copysign(0.6, past));
  }
  shape.facets = mesh::both_sides(shape.facets);
  const Vec3 inside(1.2, 1.1, 0.4), lower(1.2, 1.1, -0.6), up(0, 0, 1);
  for (const double side : {-1.0, 1.0})  // of the lower wall, which presses
    EXPECT_NEAR(overlap(shape, 0.25, inside, lower, side * up), 0.05, 1e-12) << "the upper wall is nearer";
}

TEST(Penetration, OfASolidIsHowFarTheApexIsBehindTheSurface) {
  const Shape shape = block({0, 0, 0}, {4, 4, 0.4}, {4, 4, 1});
  const Vec3 up(0, 0, 1), top(2.2, 2.3, 0.4);
  EXPECT_NEAR(overlap(shape, 0, {2.2, 2.3, 0.3}, top, up), 0.1, 1e-12);
  EXPECT_NEAR(overlap(shape, 0, {2.2, 2.3, 0.1}, top, up), 0.1, 1e-12) << "the far side is nearer";
  EXPECT_NEAR(overlap(shape, 0, {2.2, 2.3, -0.1}, top, up), 0.1, 1e-12) << "it has gone out there";
  const Shape slot = both(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}), block({0, 0, 1.5}, {4, 4, 2.5}, {4, 4, 1}));
  EXPECT_NEAR(overlap(slot, 0.4, {2.2, 2.3, 1.3}, {2.2, 2.3, 1}, up), 0.2, 1e-12) << "between two faces, nearer to the other one";
  EXPECT_NEAR(overlap(shape, 0, {4.05, 2.3, 0.3}, {4, 2.3, 0.4}, up), -0.05, 1e-12) << "beside the block nothing overlaps";
  EXPECT_NEAR(overlap(shape, 0, {4.03, 2.3, 0.44}, {4, 2.3, 0.4}, up), -0.05, 1e-12) << "past its ridge";
}

TEST(Penetration, BetweenTwoBodiesIsThatInTheOneThatPresses) {
  const Shape low = block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}), high = block({0, 0, 1.1}, {4, 4, 2.1}, {4, 4, 1});
  Scene scene = press(both(low, high), {{2.2, 2.3, 1.05}}, 0);
  Bodies& bodies = scene.interface.bodies;
  bodies.names = {"low", "high", "apexes"};
  bodies.of_apex = {2};
  bodies.of_facet.assign(static_cast<std::size_t>(low.facets.cols()), 0);
  bodies.of_facet.resize(static_cast<std::size_t>(scene.interface.base.facets.cols()), 1);
  scene.move({2.2, 2.3, 0.7});  // nearer to the top of the low one than to the high one, and then not
  Near near = scene.near();
  near.element.count = 1, near.element.stencil[0].apex = 1;
  near.element.stencil[0].facet = 0;
  while (facet_normal(scene.interface.base, scene.x, near.element.stencil[0].facet).z() < 0.5) ++near.element.stencil[0].facet;
  EXPECT_NEAR(overlap_of(scene.interface, scene.x, near, scene.memory), 0.3, 1e-12);
  for (Index n = static_cast<Index>(low.x.cols()); n < scene.apex(); ++n) scene.x(2, n) -= 0.3;
  EXPECT_NEAR(overlap_of(scene.interface, scene.x, near, scene.memory), 0.3, 1e-12);
}

TEST(EntryOfAnApex, EdgewaysIsNeverPushedAlongItsOwnSurface) {
  // a node of a ceiling over a block, past its rim
  for (const double depth : {0.02, 0.15}) {
    Scene scene = press(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}), {{-0.1, 2.1, 1 - depth}}, 0);
    Table<3> own(3, 1);
    const Index apex = scene.apex();
    scene.x.conservativeResize(3, apex + 3);
    scene.x.col(apex + 1) = Vec3(-0.1, 2.6, 1 - depth), scene.x.col(apex + 2) = Vec3(0.4, 2.1, 1 - depth);
    own << apex, apex + 1, apex + 2;
    scene.interface.own = fans(own, apex + 3);
    ASSERT_LT((facet_normal(scene.interface.own, scene.x, 0) - Vec3(0, 0, -1)).norm(), 1e-12);
    step_to(scene, 0, {0.02, 2.1, 1 - depth});
    ASSERT_EQ(scene.near().tracks.count, 1);
    const Vec3 normal = facet_normal(scene.interface.base, scene.x, scene.near().tracks.track[0].facet);
    EXPECT_LT((normal - Vec3(0, 0, 1)).norm(), 1e-12) << depth;
    EXPECT_TRUE(scene.forces().col(apex).isZero(0)) << "it has an offset";
    step_to(scene, 0, {0.02, 2.1, 0.99 - depth});
    EXPECT_LT((scene.forces().col(apex) - penalty * Vec3(0, 0, 0.01)).norm(), 1e-9) << "but goes no deeper freely";
  }
}

}  // namespace
}  // namespace nereid::contact::tracking_test
