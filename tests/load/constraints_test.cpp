#include "load/constraints.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "base/check.hpp"

namespace nereid::load::constraints_test {
namespace {

/// The same vectors in every run.
class Vectors3 {
 public:
  Vec3 any() { return {number_(engine_), number_(engine_), number_(engine_)}; }
  Vec3 unit() { return any().normalized(); }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> number_{-1, 1};
};

Plane plane(PlaneKind kind, const Vec3& normal) {
  Plane p;
  p.kind = kind;
  p.normal = normal;
  p.nodes = {0};
  return p;
}

/// One node, with a plate's rotation, on planes of one kind.
struct OneNode {
  explicit OneNode(const std::vector<Vec3>& normals, PlaneKind kind = PlaneKind::symmetry) {
    for (const Vec3& normal : normals) constraints.planes.push_back(plane(kind, normal));
    memory = prepare(constraints, 1, {0});
  }
  Vec3 restrained(Vec3 v, const Vec3& x = Vec3::Zero(), double mass = 1) {
    restrain(constraints, memory.nodes[0], x, mass, v, memory.account);
    return v;
  }
  Vec3 restrained_turn(Vec3 omega, double inertia = 1) {
    restrain_rotation(memory.nodes[0], inertia, omega, memory.account);
    return omega;
  }
  Constraints constraints;
  Memory memory;
};

TEST(Constraints, ANodeOnOnePlaneMovesInIt) {
  Vectors3 random;
  for (int i = 0; i < 100; ++i) {
    const Vec3 n = random.unit(), v = random.any();
    EXPECT_NEAR((OneNode({n}).restrained(v) - (v - v.dot(n) * n)).norm(), 0, 1e-15);
  }
}

TEST(Constraints, ANodeOnTwoPlanesMovesAlongTheirIntersection) {
  Vectors3 random;
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = random.unit(), b = random.unit(), v = random.any();
    const Vec3 line = a.cross(b).normalized();
    // the angle between the planes amplifies round-off
    EXPECT_NEAR((OneNode({a, b}).restrained(v) - v.dot(line) * line).norm(), 0,
                1e-14 / a.cross(b).norm());
  }
}

TEST(Constraints, ANodeOnThreePlanesIsFixed) {
  Vectors3 random;
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = random.unit(), b = random.unit(), c = random.unit();
    const double volume = std::abs(a.dot(b.cross(c)));
    EXPECT_NEAR(OneNode({a, b, c}).restrained(random.any()).norm(), 0, 1e-14 / volume);
  }
}

TEST(Constraints, WhatPlanesAllowIsAnOrthogonalProjection) {
  Vectors3 random;
  for (int i = 0; i < 100; ++i) {
    const Mat3 allowed = OneNode({random.unit(), random.unit()}).memory.nodes[0].allowed;
    EXPECT_NEAR((allowed - allowed.transpose()).norm(), 0, 1e-12);
    EXPECT_NEAR((allowed * allowed - allowed).norm(), 0, 1e-12);
  }
}

TEST(Constraints, APlaneGivenTwiceOrFromTheOtherSideHoldsOnce) {
  Vectors3 random;
  for (int i = 0; i < 100; ++i) {
    const Vec3 n = random.unit(), v = random.any(), in_plane = v - v.dot(n) * n;
    EXPECT_NEAR((OneNode({n, n}).restrained(v) - in_plane).norm(), 0, 1e-15);
    EXPECT_NEAR((OneNode({n, -n, n}).restrained(v) - in_plane).norm(), 0, 1e-15);
  }
}

TEST(Constraints, ThreePlanesThroughALineLeaveTheLineFree) {
  Vectors3 random;
  for (int i = 0; i < 100; ++i) {
    const Vec3 line = random.unit(), a = line.cross(random.unit()).normalized(), v = random.any();
    const Eigen::AngleAxisd third(pi / 3, line), other(1.0, line);
    const Vec3 along = v.dot(line) * line;
    EXPECT_NEAR((OneNode({a, third * a, other * a}).restrained(v) - along).norm(), 0, 1e-14);
  }
}

TEST(Constraints, PlanesThatDifferByTheirLastDigitsAreOne) {
  const Vec3 n = Vec3(std::cos(pi / 6), 0.5, 0), typed = Vec3(0.8660254, 0.5, 0).normalized();
  const Vec3 v(0.3, -0.4, 0.5), in_plane = v - v.dot(n) * n;
  EXPECT_NEAR((OneNode({n, typed}).restrained(v) - in_plane).norm(), 0, 1e-15);
  EXPECT_NEAR(
      (OneNode({n, Vec3::UnitZ(), typed}).restrained(v) - Vec3(in_plane.x(), in_plane.y(), 0))
          .norm(),
      0, 1e-15);
  // the rotation about the normal survives as well
  EXPECT_NEAR((OneNode({n, typed}).restrained_turn(n) - n).norm(), 0, 1e-6);
}

TEST(Constraints, PlanesAtASmallAngleHoldAcrossTheirLine) {
  const double angle = 1e-4;  // a wedge of a body of revolution may be that thin
  OneNode wedge({Vec3::UnitX(), Vec3(-std::cos(angle), std::sin(angle), 0)});
  const Vec3 v = wedge.restrained({0.3, -0.4, 0.5});
  EXPECT_NEAR((v - Vec3(0, 0, 0.5)).norm(), 0, 1e-11);
}

TEST(Constraints, AlongAxesHeldComponentsAreZeroAndOthersUntouchedToTheLastBit) {
  const Vec3 v(0.1, -1.0 / 3, 1e17 / 7);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vec3 r = OneNode({sign * Vec3::Unit(axis)}).restrained(v);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(r(i), i == axis ? 0.0 : v(i));
      const Vec3 two = OneNode({sign * Vec3::Unit(axis), Vec3::Unit((axis + 1) % 3)}).restrained(v);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(two(i), i == (axis + 2) % 3 ? v(i) : 0.0);
    }
  }
  EXPECT_EQ(OneNode({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}).restrained(v), Vec3(0, 0, 0));
}

TEST(Constraints, PlatesOnASymmetryPlaneTurnOnlyAboutItsNormal) {
  Vectors3 random;
  for (int i = 0; i < 100; ++i) {
    const Vec3 n = random.unit(), omega = random.any();
    EXPECT_NEAR((OneNode({n}).restrained_turn(omega) - omega.dot(n) * n).norm(), 0, 1e-15);
    EXPECT_NEAR((OneNode({n, -n}).restrained_turn(omega) - omega.dot(n) * n).norm(), 0, 1e-15);
  }
}

TEST(Constraints, PlatesOnTwoSymmetryPlanesDoNotTurn) {
  Vectors3 random;
  for (int i = 0; i < 100; ++i) {
    const Vec3 omega = random.any();
    EXPECT_EQ(OneNode({random.unit(), random.unit()}).restrained_turn(omega), Vec3(0, 0, 0));
  }
}

TEST(Constraints, PlatesOnHeldPlanesTurnFreely) {
  const Vec3 omega(1, 2, 3);
  EXPECT_EQ(OneNode({Vec3::UnitX(), Vec3::UnitY()}, PlaneKind::constrained).restrained_turn(omega), omega);
}

TEST(Constraints, PlanesShareTheImpulseAlongTheirNormals) {
  Vectors3 random;
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = random.unit(), b = random.unit(), v = random.any(), x = random.any();
    const double mass = 2.5;
    OneNode one({a, b, a});  // the third is redundant
    const Vec3 impulse = mass * (one.restrained(v, x, mass) - v);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t p = 0; p < one.memory.account.size(); ++p) {
      const PlaneAccount& account = one.memory.account[p];
      sum += account.impulse;
      moment += account.angular_impulse;
      EXPECT_NEAR(account.impulse.cross(one.constraints.planes[p].normal).norm(), 0,
                  1e-15 * (1 + account.impulse.norm()));
      EXPECT_NEAR((account.angular_impulse - x.cross(account.impulse)).norm(), 0,
                  1e-14 * (1 + account.impulse.norm()));
    }
    const double amplified = 1e-14 / a.cross(b).norm();
    EXPECT_NEAR((sum - impulse).norm(), 0, amplified);
    EXPECT_NEAR((moment - x.cross(impulse)).norm(), 0, amplified);
    EXPECT_EQ(one.memory.account[2].impulse, Vec3(0, 0, 0));
  }
}

TEST(Constraints, ImpulsesAddUpOverTime) {
  OneNode one({Vec3::UnitZ()});
  for (int i = 0; i < 3; ++i) one.restrained({1, 2, 3}, {0, 1, 0}, 2);
  EXPECT_EQ(one.memory.account[0].impulse, Vec3(0, 0, -18));
  EXPECT_EQ(one.memory.account[0].angular_impulse, Vec3(-18, 0, 0));
}

TEST(Constraints, ATurnThatIsTakenAwayIsBookedAsAngularImpulse) {
  OneNode one({Vec3::UnitZ()});
  EXPECT_EQ(one.restrained_turn({1, 2, 3}, 0.5), Vec3(0, 0, 3));
  EXPECT_EQ(one.memory.account[0].angular_impulse, Vec3(-0.5, -1, 0));
}

TEST(Constraints, AFloorHoldsNobodyAtTheStart) {
  OneNode one({Vec3::UnitZ()}, PlaneKind::floor);
  const Vec3 v(1, 2, -3);
  EXPECT_EQ(one.restrained(v), v);
  EXPECT_EQ(one.restrained_turn(v), v);
  add_plane(one.constraints, one.memory.nodes[0], 0);
  EXPECT_EQ(one.restrained(v), Vec3(1, 2, 0));
  EXPECT_EQ(one.restrained_turn(v), v);  // a floor holds no turn
}

TEST(Constraints, NodesOfNoPlaneAreNotRemembered) {
  Constraints constraints;
  constraints.planes.push_back(plane(PlaneKind::constrained, Vec3::UnitX()));
  constraints.planes[0].nodes = {1, 4};
  const Memory memory = prepare(constraints, 6, std::vector<Index>(6, -1));
  EXPECT_EQ(memory.nodes.size(), 2u);
  EXPECT_EQ(memory.row_of_node, (std::vector<Index>{-1, 0, -1, -1, 1, -1}));
}

TEST(Constraints, MoreThanEightDirectionsAtANodeAreRefusedBeforeTheStart) {
  Vectors3 random;
  std::vector<Vec3> normals;
  for (int i = 0; i < ConstrainedNode::most_rows; ++i) normals.push_back(random.unit());
  EXPECT_NO_THROW(OneNode{normals});
  normals.push_back(random.unit());
  EXPECT_THROW(OneNode{normals}, InternalError);
  normals.pop_back();
  Constraints with_floor = OneNode(normals).constraints;
  with_floor.planes.push_back(plane(PlaneKind::floor, Vec3::UnitZ()));
  EXPECT_THROW(prepare(with_floor, 1, {-1}), InternalError);
}

TEST(Constraints, AFixedNodeNeitherMovesNorTurnsAndItsReactionIsOnePlanes) {
  OneNode one({Vec3::UnitZ()}, PlaneKind::fixed);
  EXPECT_EQ(one.restrained({1, 2, 3}, Vec3::Zero(), 2), Vec3(0, 0, 0));
  EXPECT_EQ(one.restrained_turn({1, 2, 3}), Vec3(0, 0, 0));
  EXPECT_EQ(one.memory.account[0].impulse, Vec3(-2, -4, -6));
}

TEST(Constraints, OfANodeThatIsFixedTheReactionIsThatOfTheFixedPlaneWhateverTheOrder) {
  Vectors3 random;
  for (int i = 0; i < 20; ++i) {
    const std::vector<Plane> sides{plane(PlaneKind::symmetry, random.unit()), plane(PlaneKind::constrained, random.unit())};
    const Vec3 v = random.any(), omega = random.any();
    for (std::size_t at = 0; at <= sides.size(); ++at) {  // the fixed plane stands there in the case
      Constraints constraints{sides};
      constraints.planes.insert(constraints.planes.begin() + static_cast<std::ptrdiff_t>(at), plane(PlaneKind::fixed, Vec3::UnitZ()));
      Memory memory = prepare(constraints, 1, {0});
      Vec3 stopped = v, turned = omega;
      restrain(constraints, memory.nodes[0], Vec3::Zero(), 2, stopped, memory.account);
      restrain_rotation(memory.nodes[0], 1, turned, memory.account);
      EXPECT_EQ(stopped, Vec3(0, 0, 0));
      EXPECT_EQ(turned, Vec3(0, 0, 0));
      for (std::size_t p = 0; p < constraints.planes.size(); ++p) {
        EXPECT_EQ(memory.account[p].impulse, p == at ? Vec3(-2 * v) : Vec3(0, 0, 0));
        EXPECT_EQ(memory.account[p].angular_impulse, p == at ? Vec3(-omega) : Vec3(0, 0, 0));
      }
    }
  }
}

TEST(Constraints, SharesOfAReactionTurnWithThePlanes) {
  Vectors3 random;
  for (int i = 0; i < 50; ++i) {
    const Mat3 turn = Eigen::AngleAxisd(2.1, random.unit()).toRotationMatrix();
    Constraints constraints{{plane(PlaneKind::symmetry, random.unit()), plane(PlaneKind::fixed, Vec3::UnitZ()),
                             plane(PlaneKind::constrained, random.unit())}};
    if (i % 2 != 0) constraints.planes[1] = plane(PlaneKind::constrained, random.unit());
    Constraints turned = constraints;
    for (Plane& one : turned.planes) one.normal = turn * one.normal;
    Memory memory = prepare(constraints, 1, {-1}), turned_memory = prepare(turned, 1, {-1});
    Vec3 v = random.any(), turned_v = turn * v;
    restrain(constraints, memory.nodes[0], Vec3::Zero(), 1, v, memory.account);
    restrain(turned, turned_memory.nodes[0], Vec3::Zero(), 1, turned_v, turned_memory.account);
    double most = 0;
    for (const PlaneAccount& account : memory.account) most = std::max(most, account.impulse.norm());
    for (std::size_t p = 0; p < memory.account.size(); ++p)
      EXPECT_NEAR((turned_memory.account[p].impulse - turn * memory.account[p].impulse).norm(), 0, 1e-11 * most);
  }
}

TEST(Drive, GivesANodeTheSpeedsOfItsPlanesAndBooksItsKineticEnergy) {
  Vectors3 random;
  for (int i = 0; i < 100; ++i) {
    OneNode one({random.unit(), random.unit()}, PlaneKind::constrained);
    for (Plane& plane : one.constraints.planes) plane.velocity = [](double t) { return 2 + t; };
    one.memory = prepare(one.constraints, 1, {-1});
    set_speeds(one.constraints, Vectors::Zero(3, 1), 1, one.memory);
    EXPECT_TRUE(one.memory.nodes[0].moves);
    const Vec3 before = random.any();
    Vec3 v = before;
    drive(one.constraints, one.memory.nodes[0], random.any(), 3, before, Vec3::Zero(), 0, v, one.memory.account);
    double work = 0;
    for (int p = 0; p < 2; ++p) {
      EXPECT_NEAR(v.dot(one.constraints.planes[p].normal), 3, 1e-9);  // planes at a small angle amplify round-off
      work += one.memory.account[p].driven;
    }
    EXPECT_NEAR(work / (1.5 * (v.squaredNorm() - before.squaredNorm())), 1, 1e-9);
  }
}

Constraints one_driven_node() {
  Constraints one;
  one.planes = {plane(PlaneKind::driven, Vec3::UnitZ())};
  one.planes[0].field = {[](double x, double, double, double t) { return x * t; }, [](double, double y, double, double t) { return y * t; },
                         [](double, double, double z, double t) { return z * t; }};
  return one;
}

TEST(Drive, GivesADrivenNodeItsFieldAndItsTurnAndBooksTheWork) {
  Constraints one = one_driven_node();
  one.planes[0].angular_velocity[2] = [](double x, double, double, double t) { return x + t; };
  Memory memory = prepare(one, 1, {0});
  const Vec3 X(1, 2, -3), before(0.3, -0.2, 0.7), w_before(1, 2, 3);
  set_speeds(one, X, 2, memory);
  Vec3 v = before, omega = w_before;
  drive(one, memory.nodes[0], X, 3, before, Vec3::Zero(), 0, v, memory.account);
  drive_rotation(memory.nodes[0], 0.5, w_before, Vec3::Zero(), 0, omega, memory.account);
  EXPECT_EQ(v, 2 * X);
  EXPECT_EQ(omega, Vec3(0, 0, 3));
  EXPECT_NEAR(memory.account[0].driven, 1.5 * (v.squaredNorm() - before.squaredNorm()) + 0.25 * (9 - 14), 1e-13);
  EXPECT_NEAR((memory.account[0].impulse - 3 * (v - before)).norm(), 0, 1e-14);
  EXPECT_NEAR((memory.account[0].angular_impulse - 3 * X.cross(v - before) - Vec3(-0.5, -1, 0)).norm(), 0, 1e-14);
}

TEST(FindConflict, IsADrivenNodeOnAnyOtherPlaneButAFloor) {
  Constraints two = one_driven_node();
  EXPECT_EQ(find_conflict(two).moving, -1);
  two.planes.push_back(plane(PlaneKind::floor, Vec3::UnitZ()));
  EXPECT_EQ(find_conflict(two).moving, -1);
  for (const PlaneKind kind : {PlaneKind::constrained, PlaneKind::symmetry, PlaneKind::fixed, PlaneKind::driven}) {
    two.planes.push_back(plane(kind, Vec3::UnitX()));
    EXPECT_EQ(find_conflict(two).moving, 0);
    EXPECT_EQ(find_conflict(two).other, 2);
    two.planes.pop_back();
  }
}

TEST(FindConflict, IsAPlaneThatMovesANodeWhereOthersHoldIt) {
  Constraints both;
  both.planes = {plane(PlaneKind::constrained, Vec3::UnitX()), plane(PlaneKind::constrained, Vec3(1, 1, 0).normalized())};
  EXPECT_EQ(find_conflict(both).moving, -1);
  both.planes[0].velocity = [](double) { return 1.0; };
  EXPECT_EQ(find_conflict(both).moving, -1);
  both.planes.push_back(plane(PlaneKind::symmetry, Vec3::UnitY()));  // two planes hold x between them
  EXPECT_EQ(find_conflict(both).moving, 0);
  EXPECT_EQ(find_conflict(both).other, 2);
  both.planes.back().nodes = {5};
  EXPECT_EQ(find_conflict(both).moving, -1);
}

TEST(FindOverheld, CountsAFixedPlaneThreeTimes) {
  Constraints many;
  for (int i = 0; i < 2; ++i) many.planes.push_back(plane(PlaneKind::fixed, Vec3::UnitX()));
  for (int i = 0; i < 2; ++i) many.planes.push_back(plane(PlaneKind::constrained, Vec3::UnitX()));
  EXPECT_EQ(find_overconstrained(many), -1);
  many.planes.push_back(plane(PlaneKind::floor, Vec3::UnitX()));
  EXPECT_EQ(find_overconstrained(many), 0);
}

TEST(InPlaceOf, KeepsAccountsAndWhatFloorsHaveStopped) {
  Constraints before{{plane(PlaneKind::floor, Vec3::UnitZ()), plane(PlaneKind::fixed, Vec3::UnitX())}};
  Memory memory = prepare(before, 1, {0});
  memory.account[1].stopped = 7;
  memory.stopped[0][0] = 1;  // as finish_impacts() does
  add_plane(before, memory.nodes[0], 0);
  Constraints after = before;
  after.planes[1].nodes.clear();
  const Memory changed = in_place_of(memory, after, 1, {0});
  EXPECT_EQ(changed.account[1].stopped, 7);
  ASSERT_EQ(changed.active, Subset{0});
  EXPECT_EQ(changed.nodes[0].count, 1) << "the floor still holds it, the other plane does not";
  EXPECT_EQ(changed.nodes[0].allowed, Mat3(Vec3(1, 1, 0).asDiagonal()));
}

}  // namespace
}  // namespace nereid::load::constraints_test
