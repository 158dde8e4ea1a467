#include "contact/multiplier/condition.hpp"

#include <numbers>
#include <random>
#include <utility>

#include "contact/multiplier/assemble.hpp"
#include "contact/multiplier/predict.hpp"
#include "contact/multiplier/solve.hpp"
#include "contact/multiplier/stick.hpp"
#include "mesh/skin.hpp"
#include "tests/contact/pressed.hpp"

namespace nereid::contact::condition_test {
namespace {

using namespace pressed;

/// An apex close above a sheet, with masses and velocities at random, and what a condition needs of them.
struct Setting {
  pressed::Scene scene;
  Vectors v, force, no_spins{3, 0};
  Scalars mass, none_turns;
  std::vector<Index> rotation_of_node;
  std::vector<const Mat3*> allowed, allowed_rotation;
  Multipliers all;
  double friction = 0;

  explicit Setting(const Vec3& apex, double coefficient = 0, const Shape& shape = sheet(4, 4, flat), double contact_height = 0)
      : scene(press(shape, {apex}, contact_height)), friction(coefficient) {
    scene.interface.method = Method::multiplier;
    scene.interface.friction.coefficient = coefficient;
    scene.interface.depth = 1, scene.interface.impedance = 1;
    scene.memory.restitution.resize(1);
    const Index nodes = static_cast<Index>(scene.x.cols());
    std::mt19937 engine(4);
    std::uniform_real_distribution<double> number(-1, 1);
    v = force = Vectors::Zero(3, nodes);
    mass = Scalars::Zero(nodes);
    for (Index n = 0; n < nodes; ++n) {
      mass(n) = 2 + number(engine);
      for (int i = 0; i < 3; ++i) v(i, n) = number(engine), force(i, n) = number(engine);
    }
    rotation_of_node.assign(nodes, -1);
    allowed.assign(nodes, nullptr);
    all = make_multipliers(std::vector<AnyContact>{scene.interface}, {}, nodes, 0);
  }
  Motion motion(double dt) const {
    return {scene.x, v, no_spins, force, no_spins, mass, none_turns, rotation_of_node, allowed, allowed_rotation, dt, dt};
  }
  const Condition& find(double dt) {
    const Motion m = motion(dt);
    look_ahead(scene.interface.apexes, m, all);
    look_ahead(scene.interface.base_nodes, m, all);
    find_conditions(scene.interface, m, scene.memory, scene.workspace, all);
    EXPECT_EQ(all.conditions.size(), 1U);
    return all.conditions[0];
  }
};

TEST(Condition, HasTheGapTheFootAndTheRatesOfItsNodes) {
  Setting at(Vec3(1.3, 2.1, 1e-3));
  const Condition& c = at.find(1e-3);
  EXPECT_NEAR(c.gap, 1e-3, 1e-15);
  const auto members = members_of(c, at.all);
  ASSERT_EQ(members.size(), 4U);
  EXPECT_NEAR(members[1].weight + members[2].weight + members[3].weight, -1, 1e-15);
  Vec3 arm = Vec3::Zero();
  double before = 0, free = 0, per_mass = 0;
  for (const Member& one : members) {
    arm += one.weight * at.scene.x.col(one.node);
    before += one.weight * at.v(2, one.node);
    free += one.weight * (at.v(2, one.node) + 1e-3 * at.force(2, one.node) / at.mass(one.node));
    per_mass += one.weight * one.weight / at.mass(one.node);
  }
  EXPECT_LT((arm - 1e-3 * Vec3::UnitZ()).norm(), 1e-15);  // the push makes no moment
  EXPECT_NEAR(c.before, before, 1e-15);
  EXPECT_NEAR(c.free, free, 1e-15);
  EXPECT_NEAR(c.per_mass, per_mass, 1e-15);
}

TEST(Condition, AnImpulseChangesItsRateByWhatItSays) {
  Setting at(Vec3(1.3, 2.1, 1e-3));
  const Mat3 slanted = Mat3::Identity() - Vec3(0.6, 0, 0.8) * Vec3(0.6, 0, 0.8).transpose();  // one node moves on a plane
  at.allowed[at.scene.interface.base.facets(0, at.scene.near().element.stencil[0].facet)] = &slanted;
  at.find(1e-3);
  make_rows(at.motion(1e-3), at.all);
  const Condition& c = at.all.conditions[0];
  const double before = rate(c, at.all);
  give(c.row, 0.7, at.all.rows);
  move(at.all.rows);
  EXPECT_NEAR(rate(c, at.all) - before, 0.7 * c.per_mass, 1e-14);
}

TEST(Condition, FrictionChangesTheSlipRateByNoMoreThanItSays) {
  Setting at(Vec3(1.3, 2.1, 1e-3), 0.3);
  at.find(1e-3);
  ASSERT_EQ(at.all.frictions.size(), 1U);
  make_rows(at.motion(1e-3), at.all);
  const FrictionCondition& f = at.all.frictions[0];
  for (const Vec3& push : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.6, -0.8, 0)}) {
    const Vec3 before = rate(f, at.all);
    give(f, push, at.all.rows);
    move(at.all.rows);
    const Vec3 change = rate(f, at.all) - before;
    EXPECT_LE(change.norm(), f.per_mass * (1 + 1e-12));
    EXPECT_GT(change.dot(push), 0.9 * f.per_mass);
  }
}

TEST(Condition, TheNormalGoesEvenlyFromFacetToFacet) {
  const auto normal_at = [](double aside) {
    Setting at(Vec3(2, 2, 0) + aside * Vec3(0.7, -0.4, 0));
    Vectors& x = at.scene.x;
    for (Index n = 0; n < at.scene.apex(); ++n) x(2, n) = -0.02 * (x.col(n).head<2>() - Eigen::Vector2d(2, 2)).squaredNorm();
    at.v.setZero(), at.force.setZero();
    return at.find(1e-3).normal;
  };
  EXPECT_LT((normal_at(1e-9) - normal_at(-1e-9)).norm(), 1e-6);  // over the top of a dome of facets
  EXPECT_GT((normal_at(0.1) - normal_at(-0.1)).norm(), 1e-2);
}

/// The normal over the sole of a body beside a ridge, behind which its surface falls away by an angle [degrees]. The apex is of a flat
/// surface, or of none.
Vec3 normal_beside_ridge(double angle, bool has_surface) {
  Setting at(Vec3(1.995, 2.3, 0));
  const double slope = std::tan(angle * std::numbers::pi / 180);
  for (Index n = 0; n < at.scene.apex(); ++n) at.scene.x(2, n) = -slope * std::max(0.0, at.scene.x(0, n) - 2);
  if (has_surface) {
    const Index apex = at.scene.apex();
    at.scene.x.conservativeResize(3, apex + 5);
    at.scene.x.rightCols(4) = at.scene.x.col(apex).replicate(1, 4);
    at.scene.x.rightCols(4).topRows(2) += (Eigen::Matrix<double, 2, 4>() << 1, 0, -1, 0, 0, 1, 0, -1).finished();
    Table<3> own(3, 4);
    for (int f = 0; f < 4; ++f) own.col(f) << apex, apex + 1 + (f + 1) % 4, apex + 1 + f;  // it looks down
    at.scene.interface.own = fans(own, apex + 5);
  }
  at.v.setZero(), at.force.setZero();
  return at.find(1e-3).normal;
}

TEST(Condition, ANormalGoesOverIntoThatOfABevelOnlyWhereTheSurfaceOfTheApexAdmitsIt) {
  for (const double angle : {5.0, 20.0}) {
    EXPECT_GT((normal_beside_ridge(angle, false) - Vec3::UnitZ()).norm(), 0.2 * angle * std::numbers::pi / 180) << angle;
    EXPECT_LT((normal_beside_ridge(angle, true) - Vec3::UnitZ()).norm(), 1e-12) << angle;
  }
  EXPECT_GT((normal_beside_ridge(0.9, true) - Vec3::UnitZ()).norm(), 1e-4);  // as a mesh is uneven
}

TEST(Condition, AnApexRubsOnTheBodyThatPressedItMostWithThePushOfThatOneAlone) {
  Setting at(Vec3(0.4, 0.05, 0.05), 0.3, corner(true), 0.1);
  Bodies& bodies = at.scene.interface.bodies;
  bodies.names = {"one", "two", "three"}, bodies.of_facet = {0, 1, 2}, bodies.of_apex = {0};
  bodies.between.assign(9, at.scene.interface), bodies.touch.assign(9, 1);
  at.scene.memory.way_of_body.assign(3, 0);
  at.v.setZero(), at.force.setZero();
  Near& near = at.scene.memory.near[0];
  std::array<Index, 2> pushes{-1, -1};  // the two facets in whose layers it is
  int count = 0;
  for (Index f = 0; f < 3 && count < 2; ++f)
    if (facet_normal(at.scene.interface.base, at.scene.x, f).x() < 0.5) pushes[static_cast<std::size_t>(count++)] = f;
  ASSERT_EQ(count, 2);
  near.tracks.count = 0;
  for (const Index f : pushes) near.tracks.begin(f, 0.1);
  for (const Index most : {Index{-1}, pushes[0], pushes[1]}) {
    at.all.conditions.clear(), at.all.contactors.clear(), at.all.frictions.clear();
    near.pressed_most = most;
    const Motion m = at.motion(1e-3);
    look_ahead(at.scene.interface.apexes, m, at.all), look_ahead(at.scene.interface.base_nodes, m, at.all);
    find_conditions(at.scene.interface, m, at.scene.memory, at.scene.workspace, at.all);
    ASSERT_EQ(at.all.conditions.size(), 2U);
    ASSERT_EQ(at.all.frictions.size(), 1U);
    Contactor& one = at.all.contactors[0];
    const Vec3 expected = facet_normal(at.scene.interface.base, at.scene.x, most < 0 ? near.element.stencil[0].facet : most);
    EXPECT_LT((at.all.conditions[static_cast<std::size_t>(one.foot)].normal - expected).norm(), 1e-9);
    EXPECT_LT((at.all.frictions[0].touch.normal - expected).norm(), 1e-9);
    for (Condition& c : at.all.conditions) c.impulse = (c.normal - expected).norm() < 1e-9 ? 2 : 5;
    EXPECT_EQ(rubbing_impulse_of(one, at.all), 2);
    EXPECT_EQ(impulse_of(one, at.all), 7);
  }
}

TEST(Condition, BesideARimAndBelowItsLevelThereIsNone) {
  Setting at(Vec3(4.05, 2.1, -1e-6));
  at.v.setZero(), at.force.setZero();
  const Motion m = at.motion(1e-3);
  look_ahead(at.scene.interface.apexes, m, at.all);
  look_ahead(at.scene.interface.base_nodes, m, at.all);
  find_conditions(at.scene.interface, m, at.scene.memory, at.scene.workspace, at.all);
  for (const Condition& c : at.all.conditions) EXPECT_GT(std::abs(c.normal.z()), 0.9) << "the way past the rim is no penetration";
}

TEST(Condition, OfAnApexThatIsOpenOverAnEdgeHasItsDistance) {
  Setting at(Vec3(0.3, -0.099, -0.0316), 0, corner(false), 0.1);  // over the edge of two faces, 0.1039 away, 0.0316 from one plane
  at.scene.interface.release_height = 0.01;
  at.v.setZero(), at.force.setZero();
  Near& near = at.scene.memory.near[0];
  near.tracks.count = 0;
  near.tracks.begin(0, 0.1);  // it has been over that face
  const Condition& c = at.find(1e-3);
  EXPECT_NEAR(c.gap, std::hypot(0.099, 0.0316) - 0.1, 1e-9);
  EXPECT_NEAR(c.normal.y(), -0.099 / std::hypot(0.099, 0.0316), 1e-9);
}

TEST(Condition, FrictionOfNodesThatAreHeldAlongThePlaneIsThatOfTheirSlip) {
  Setting at(Vec3(1.3, 2.1, 0), 0.3);  // without an arm, so that friction does not turn the facet
  const Mat3 upwards = Vec3::UnitZ() * Vec3::UnitZ().transpose();
  at.allowed.assign(at.allowed.size(), &upwards);
  at.v.topRows(2).setZero();
  at.force.topRows(2).setZero();
  for (const double speed : {0.0, 2.0}) {
    at.v(0, at.scene.apex()) = speed;
    at.all.conditions.clear(), at.all.contactors.clear(), at.all.frictions.clear();
    at.find(1e-3);
    ASSERT_EQ(at.all.frictions.size(), 1U);
    make_rows(at.motion(1e-3), at.all);
    FrictionCondition& friction = at.all.frictions[0];
    friction.bound = friction.per_mass;
    find_change(1e-3, rate(friction, at.all), friction);
    EXPECT_LT((friction.change - Vec3(speed > 0 ? -0.3e-3 : 0, 0, 0)).norm(), 1e-18);
  }
}

TEST(Condition, TheSlipRateOfTheStepBeforeCountsUnlessItStuckThen) {
  for (const bool stuck : {false, true}) {
    Setting at(Vec3(1.3, 2.1, 1e-3), 0.3);
    at.scene.interface.friction.kinetic = 0.1, at.scene.interface.friction.decay = 1e9;
    at.scene.memory.near[0].friction.make().stuck = stuck;
    at.find(1e-3);
    ASSERT_EQ(at.all.frictions.size(), 1U);
    EXPECT_EQ(at.all.frictions[0].coefficient, stuck ? 0.3 : 0.1);
  }
}

/// A brick of one element whose eight nodes, after those of a sheet, are apexes; it stands over the sheet, close to it.
struct Brick {
  static constexpr double width = 0.5, height = 2;  // m
  pressed::Scene scene;
  mesh::Mesh mesh;
  Vectors v, none{3, 0}, force;
  Scalars mass, no_inertia;
  std::vector<Index> turns;
  std::vector<const Mat3*> allowed, no_rotations;

  Brick() : scene(press(sheet(4, 4, flat), corners(), 0)) {
    mesh.X = scene.x;
    mesh.hexahedra.push_back({"brick", Table<8>(8, 1)});
    for (int i = 0; i < 8; ++i) mesh.hexahedra[0].nodes(i, 0) = scene.apex(i);
    mesh.surfaces.push_back({"skin", mesh::skin(mesh.X, mesh.hexahedra).facets});
    Interface& interface = scene.interface;
    interface.method = Method::multiplier;
    interface.depth = 1, interface.impedance = 3;
    interface.area = mesh::tributary_areas(mesh, mesh.surfaces[0], interface.apexes);
    interface.faces = mesh::faces_around(mesh, mesh.surfaces[0], interface.apexes);
    scene.memory.restitution.resize(8);
    const Eigen::Index nodes = mesh.X.cols();
    v = force = Vectors::Zero(3, nodes);
    v.row(2).tail(8).setConstant(-1);
    mass = Scalars::Ones(nodes);
    turns.assign(static_cast<std::size_t>(nodes), -1), allowed.assign(static_cast<std::size_t>(nodes), nullptr);
  }
  static std::vector<Vec3> corners() {
    std::vector<Vec3> all;
    for (const double z : {1e-3, height})
      for (const auto& [x, y] : {std::pair(0.0, 0.0), {width, 0.0}, {width, width}, {0.0, width}}) all.emplace_back(1 + x, 1 + y, z);
    return all;
  }
  Motion motion() const { return {scene.x, v, none, force, none, mass, no_inertia, turns, allowed, no_rotations, 1e-3, 1e-3}; }
};

TEST(Contactor, OfACornerHasTheImpedanceOfTheFaceThatTouchesOverFacetsAndPlanes) {
  Brick at;
  const double face = 0.25 * Brick::width * Brick::width;  // of a node; of its three faces it has 9 times as much
  Interface& interface = at.scene.interface;
  const auto nodes = static_cast<Index>(at.mesh.X.cols());
  Multipliers all = make_multipliers(std::vector<AnyContact>{interface}, {}, nodes, 0);
  look_ahead(interface.apexes, at.motion(), all), look_ahead(interface.base_nodes, at.motion(), all);
  find_conditions(interface, at.motion(), at.scene.memory, at.scene.workspace, all);
  ASSERT_EQ(all.contactors.size(), 4U);
  for (const Contactor& one : all.contactors) EXPECT_NEAR(one.impedance, 3 * face, 1e-15);
  RigidPlane plane;
  plane.point = Vec3::Zero(), plane.normal = Vec3::UnitZ(), plane.method = Method::multiplier;
  plane.nodes = interface.apexes, plane.area = interface.area, plane.faces = interface.faces;
  plane.depth = 1, plane.impedance = 5;
  PlaneMemory memory = initial_memory(plane);
  all = make_multipliers({}, {&plane, 1}, nodes, 0);
  look_ahead(plane.nodes, at.motion(), all);
  find_conditions(plane, at.motion(), memory, all);
  ASSERT_EQ(all.contactors.size(), 4U);
  for (const Contactor& one : all.contactors) EXPECT_NEAR(one.impedance, 5 * face, 1e-15);
}

TEST(Trend, IsTheLineThroughTheLastTwoStepsWhereBothPress) {
  const auto of = [](double pressed, double earlier) {
    Near near;
    near.pressed = pressed, near.earlier = earlier;
    return trend(near);
  };
  EXPECT_EQ(of(3, 2), 4);
  EXPECT_EQ(of(1, 3), 0);  // nothing pulls
  EXPECT_EQ(of(3, 0), 3);
  EXPECT_EQ(of(0, 3), 0);
}

// --- the example of docs/adding.md: a kind of contact that the program does not have ------------------

// A rope joins two nodes, which may come nearer to each other, but not farther apart than its length. Solver, restitution and balances take
// its conditions as those of any contact.

/// What is constant.
struct Rope {
  Index one, other;  ///< nodes
  double length;     ///< [m]
};

/// What it remembers.
struct RopeMemory {
  double pressed = 0;  ///< [N] in the last step
  Restitution restitution;
};

/// The condition of a rope: its normal points from the first node to the other, so the rate of its gap is what the nodes approach by.
void find_conditions(const Rope& rope, const Motion& m, RopeMemory& memory, Multipliers& all) {
  const Vec3 along = m.x.col(rope.other) - m.x.col(rope.one);
  Condition& c = begin_condition(all);
  c.normal = along.normalized(), c.gap = rope.length - along.norm();
  add_member(rope.one, 1, all, c);
  add_member(rope.other, -1, all, c);
  if (!complete(m, memory.pressed, memory.restitution.held, all, all, c)) return take_back(all);
  const auto last = static_cast<Index>(all.conditions.size());
  add({.memory = &memory.restitution, .first = last - 1, .last = last, .friction = -1, .area = 1, .depth = rope.length, .impedance = 0,
       .square = 0}, all);
}

/// Impulses become forces over the mean h [s] of both steps.
void take_over(double h, const Multipliers& all, RopeMemory& memory) { memory.pressed = all.conditions[0].impulse / h; }

/// Two nodes of 1 and 3 kg on a rope of 1 m.
struct OnARope {
  Vectors x = Vectors::Zero(3, 2), v = Vectors::Zero(3, 2), none{3, 0};
  Scalars mass{{1.0, 3.0}}, no_inertia;
  std::vector<Index> turns{-1, -1};
  std::vector<const Mat3*> allowed{nullptr, nullptr}, no_rotations;
  Multipliers all = make_multipliers({}, {}, 2, 0);
  RopeMemory memory;

  void solve_at(double distance, double apart) {
    x(0, 1) = distance, v(0, 0) = -0.75 * apart, v(0, 1) = 0.25 * apart;
    const Vectors force = Vectors::Zero(3, 2);
    const Motion m{x, v, none, force, none, mass, no_inertia, turns, allowed, no_rotations, 1e-3, 1e-3};
    look_ahead(Subset{0, 1}, m, all);
    find_conditions(Rope{0, 1, 1.0}, m, memory, all);
    all.first = {0, 1};  // its contactors among those of all contacts
    solve(m, all);
    find_velocities(m, all);
    take_over(1e-3, all, memory);
  }
};

TEST(NewKind, HoldsWhatWouldGoTooFarAndKeepsMomentum) {
  OnARope at;
  at.solve_at(1.0, 2.0);
  EXPECT_NEAR(at.all.velocity(0, 1) - at.all.velocity(0, 0), 0, 1e-12);
  EXPECT_NEAR(at.all.velocity.row(0).dot(at.mass), 0, 1e-12);
  EXPECT_NEAR(at.memory.pressed, 0.75 * 2.0 / 1e-3, 1e-6) << "reduced mass times speed over the step";
}

TEST(NewKind, DoesNothingWhereTheRopeIsSlack) {
  OnARope at;
  at.solve_at(0.5, 2.0);
  EXPECT_EQ(at.memory.pressed, 0);
  EXPECT_NEAR(at.all.velocity(0, 1) - at.all.velocity(0, 0), 2.0, 1e-15);
}

}  // namespace
}  // namespace nereid::contact::condition_test
