// Bonds by multipliers in whole models: tests/contact/bond_test.cpp has one step of them.

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "base/parallel.hpp"
#include "contact/bond.hpp"
#include "dynamics/step.hpp"
#include "mesh/box.hpp"
#include "mesh/placement.hpp"
#include "tests/dynamics/scene.hpp"

namespace nereid::dynamics {
namespace {

const material::Elastic rubber{1000, 1e6, 0.3};
const element::Hexahedron::Options inviscid{.hourglass = 0.1, .viscosity = {0, 0}};

InterfaceOptions bonded(contact::Method method = contact::Method::multiplier) {
  return {.kind = contact::InterfaceKind::bonded, .method = method};
}

/// Boxes that share faces along x.
Scene boxes(std::vector<std::pair<std::string, mesh::Box>> all, bool symmetric = false) {
  Scene s;
  s.model.mesh = mesh::box(all[0].first, all[0].second);
  for (std::size_t b = 1; b < all.size(); ++b) s.model.mesh = mesh::join(s.model.mesh, mesh::box(all[b].first, all[b].second));
  for (const auto& [name, shape] : all) s.model.blocks.push_back(element::hexahedra(s.model.mesh, name, rubber, inviscid));
  if (symmetric) {
    Subset nodes;
    for (Index n = 0; n < s.model.mesh.X.cols(); ++n)
      if (std::abs(s.model.mesh.X(1, n)) < 1e-12) nodes.push_back(n);
    s.model.constraints.planes = {plane("mirror", load::PlaneKind::symmetry, Vec3::UnitY(), nodes)};
  }
  finalize(s.model);
  return s;
}

void move(Scene& s, const std::function<Vec3(const Vec3&)>& v) {
  for (Eigen::Index n = 0; n < s.state.v.cols(); ++n) s.state.v.col(n) = v(s.model.mesh.X.col(n));
}

Vec3 wave(const Vec3& X) { return {2 * std::sin(9 * X.x() + 4 * X.y()), std::cos(7 * X.z()), std::sin(5 * X.x() * X.z())}; }

/// The largest difference in velocity between the nodes of two scenes that stand at the same places in the reference. [m/s]
double apart(const Scene& a, const Scene& b) {
  double most = 0;
  for (Eigen::Index m = 0; m < a.state.v.cols(); ++m) {
    Eigen::Index at = 0;
    (b.model.mesh.X.colwise() - a.model.mesh.X.col(m)).colwise().norm().minCoeff(&at);
    most = std::max(most, (a.state.v.col(m) - b.state.v.col(at)).norm());
  }
  return most;
}

void expect_closed(const Scene& s, double tolerance = 1e-12) {
  const Ledger& l = s.state.ledger;
  const double momentum = std::sqrt(2 * s.model.mass.sum() * l.initial_kinetic);
  EXPECT_LT(std::abs(energy_residual(l)), tolerance * l.initial_kinetic);
  EXPECT_LT(momentum_residual(l).norm(), tolerance * momentum);
  EXPECT_LT(angular_momentum_residual(l).norm(), tolerance * momentum);
}

TEST(BondByMultipliers, TwoPartsAreAsOneBody) {
  Scene one = boxes({{"all", {{0, 0, 0}, {0.8, 0.3, 0.3}, {8, 3, 3}}}});
  Scene two = boxes({{"left", {{0, 0, 0}, {0.4, 0.3, 0.3}, {4, 3, 3}}}, {"right", {{0.4, 0, 0}, {0.8, 0.3, 0.3}, {4, 3, 3}}}});
  two.joined("glue", "left.x_high", "right.x_low", bonded());
  for (Scene* s : {&one, &two}) s->ready(), move(*s, wave), s->run_to(0.1);
  EXPECT_EQ(one.state.step, two.state.step) << "it votes for no step";
  EXPECT_LT(apart(one, two), 1e-10);
  const double scale = two.state.ledger.initial_kinetic;
  EXPECT_LT(std::abs(created(account(two, "glue"))), 1e-12 * scale);
  EXPECT_LT(account(two, "glue").dissipated[Dissipated::inelastic_impact], 1e-12 * scale) << "nothing moved against the bond";
  expect_closed(two);
}

TEST(BondByMultipliers, TwoPartsStrikeAWallAsOneBody) {
  const auto walled = [](Scene& s) {  // nodes of the bond touch it
    contact::RigidPlane wall;
    wall.name = "wall", wall.point = Vec3(0, 0, -1e-4), wall.normal = Vec3::UnitZ(), wall.method = contact::Method::multiplier;
    for (Index n = 0; n < s.model.mesh.X.cols(); ++n)
      if (s.model.mesh.X(2, n) < 1e-9) wall.nodes.push_back(n);
    wall.area = Scalars::Constant(static_cast<Eigen::Index>(wall.nodes.size()), 1e-2);
    wall.impedance = 3e4, wall.depth = 0.1, wall.restitution = 0;
    s.model.rigid_planes.push_back(wall);
  };
  Scene one = boxes({{"all", {{0, 0, 0}, {0.8, 0.3, 0.3}, {8, 3, 3}}}});
  Scene two = boxes({{"left", {{0, 0, 0}, {0.4, 0.3, 0.3}, {4, 3, 3}}}, {"right", {{0.4, 0, 0}, {0.8, 0.3, 0.3}, {4, 3, 3}}}});
  two.joined("glue", "left.x_high", "right.x_low", bonded());
  for (Scene* s : {&one, &two}) {
    walled(*s), s->ready(), move(*s, [](const Vec3& X) { return Vec3(wave(X) - 3 * Vec3::UnitZ()); });
    s->run_to(0.02);
  }
  EXPECT_GT(one.state.rigid_planes[0].impulse.z(), 0);
  EXPECT_NEAR(two.state.rigid_planes[0].impulse.z() / one.state.rigid_planes[0].impulse.z(), 1, 1e-4);
  EXPECT_LT(apart(one, two), 1e-3);  // sweeps end at 1e-6 of impulses, and first touches go by their last digits
  EXPECT_TRUE(two.forces.multipliers.bonds.touched);
  EXPECT_LT(std::abs(created(account(two, "glue"))), 1e-10 * two.state.ledger.initial_kinetic);
  expect_closed(two);
}

/// Two bodies on unlike grids with a gap between, which turn and shake.
Scene unlike(const InterfaceOptions& options, bool symmetric = false, int finer = 1) {
  Scene s = boxes({{"left", {{0, 0, 0}, {0.4, 0.3, 0.3}, {4 * finer, 4 * finer, 4 * finer}}},
                   {"right", {{0.42, 0, 0}, {0.8, 0.3, 0.3}, {4 * finer, 3 * finer, 3 * finer}}}}, symmetric);
  s.joined("glue", "left.x_high", "right.x_low", options);
  s.ready();
  move(s, [](const Vec3& X) { return Vec3(0.2 * wave(X) + Vec3(0, 4, 5).cross(X)); });
  return s;
}

TEST(BondByMultipliers, KeepsMomentaAndAlmostAllEnergyOverAGap) {
  double before = 0;
  for (const double safety : {0.8, 0.4}) {
    Scene s = unlike(bonded());
    Time time;
    time.end = 0.1, time.safety = safety;
    run(s.model, s.state, s.forces, time, 1e300, {});
    expect_closed(s);
    const double made = std::abs(created(account(s, "glue"))) / s.state.ledger.initial_kinetic;
    EXPECT_LT(made, 1e-4) << "of the second order of the step";
    if (safety < 0.5) {
      EXPECT_LT(made, std::max(0.5 * before, 1e-7));
    }
    before = made;
    for (const contact::HeldBond& b : s.forces.multipliers.bonds.held) EXPECT_LT(b.off.norm(), 1e-12);
    EXPECT_TRUE(std::isinf(s.state.votes.contact.step) || s.state.votes.contact.step > 1e100);
  }
}

TEST(BondByMultipliers, StopsAtTheStartWhatMovesAgainstIt) {
  Scene s = unlike(bonded());
  s.move("left", {1, 0.5, 2});
  s.move("right", {-1, 0, 0});
  s.run_to(1e-3);
  const Account& glue = account(s, "glue");
  EXPECT_GT(glue.dissipated[Dissipated::inelastic_impact], 0.05 * s.state.ledger.initial_kinetic);
  EXPECT_LT(std::abs(created(glue)), 1e-5 * s.state.ledger.initial_kinetic);
  expect_closed(s);
}

TEST(BondByMultipliers, HalfABodyOnItsSymmetryPlaneMovesLikeTheWhole) {
  const auto velocity = [](const Vec3& X) {
    return Vec3(std::sin(9 * X.x()) * std::cos(5 * X.y()), 0.5 * std::sin(8 * X.y()), std::sin(7 * X.x() + 2 * X.z()));
  };
  Scene half = boxes({{"left", {{0, 0, 0}, {0.4, 0.3, 0.3}, {4, 4, 4}}}, {"right", {{0.4, 0, 0}, {0.8, 0.3, 0.3}, {4, 4, 4}}}}, true);
  Scene whole = boxes({{"left", {{0, -0.3, 0}, {0.4, 0.3, 0.3}, {4, 8, 4}}}, {"right", {{0.4, -0.3, 0}, {0.8, 0.3, 0.3}, {4, 8, 4}}}});
  for (Scene* s : {&half, &whole}) {
    s->joined("glue", "left.x_high", "right.x_low", bonded());
    s->ready(), move(*s, velocity), s->run_to(0.02);
    expect_closed(*s);
  }
  double most = 0;
  for (Eigen::Index n = 0; n < half.state.v.cols(); ++n)
    if (std::abs(half.model.mesh.X(1, n)) < 1e-12) most = std::max(most, std::abs(half.state.v(1, n)));
  EXPECT_LT(most, 1e-14);
  EXPECT_LT(apart(half, whole), 1e-10);
  EXPECT_LT(std::abs(created(account(half, "glue"))), 1e-11 * half.state.ledger.initial_kinetic);
  Scene other = unlike(bonded(), true);  // facets beside the plane turn: their images take what would leave it
  other.run_to(0.05);
  expect_closed(other);
  EXPECT_GT(account(other, "glue").angular_impulse.norm(), 0);
  EXPECT_LT(std::abs(created(account(other, "glue"))), 1e-4 * other.state.ledger.initial_kinetic);
}

TEST(BondByMultipliers, HeldNodesCollectNothing) {
  Scene s = boxes({{"left", {{0, 0, 0}, {0.4, 0.3, 0.3}, {4, 4, 4}}}, {"right", {{0.4, 0, 0}, {0.8, 0.3, 0.3}, {4, 3, 3}}}});
  Subset low;
  for (Index n = 0; n < s.model.mesh.X.cols(); ++n)
    if (s.model.mesh.X(2, n) < 1e-12) low.push_back(n);
  s.model.constraints.planes = {plane("held", load::PlaneKind::fixed, Vec3::UnitZ(), low)};  // both sides of the bond
  finalize(s.model);
  s.joined("glue", "left.x_high", "right.x_low", bonded());
  s.ready(), move(s, wave), s.run_to(0.05);
  expect_closed(s);
  const contact::Interface& glue = s.model.interfaces[0];
  for (const contact::Near& near : s.state.interfaces[0].near)
    if (s.model.mesh.X(2, glue.apexes[near.apex]) < 1e-12) {
      EXPECT_EQ(near.element.apex.norm(), 0);
    }
  EXPECT_GT(s.state.interfaces[0].force.norm(), 0);
}

TEST(BondByMultipliers, FollowsANodeThatIsDriven) {
  Scene s = boxes({{"left", {{0, 0, 0}, {0.4, 0.3, 0.3}, {4, 4, 4}}}, {"right", {{0.4, 0, 0}, {0.8, 0.3, 0.3}, {4, 3, 3}}}});
  load::Plane shaken = plane("shaken", load::PlaneKind::constrained, Vec3::UnitX(), mesh::node_set(s.model.mesh, "right.y_low"));
  shaken.velocity = [](double t) { return 2 * std::sin(100 * t); };
  s.model.constraints.planes = {shaken};
  finalize(s.model);
  s.joined("glue", "left.x_high", "right.x_low", bonded());
  s.ready(), s.run_to(0.05);
  const Ledger& l = s.state.ledger;
  EXPECT_LT(std::abs(energy_residual(l)), 1e-12 * l.kinetic);
  EXPECT_LT(std::abs(created(account(s, "glue"))), 0.01 * l.kinetic);
}

TEST(BondByMultipliers, GivesTheSameBitsWithAnyThreadsAndWithoutABreak) {
  std::vector<State> states;
  for (const int threads : {1, 2, 4}) {
    use_threads(threads);
    Scene s = unlike(bonded(), true, 4);
    Time time;
    time.end = 0.02;
    if (threads == 4) {  // on from a copy
      int steps = 0;
      State half;
      const Observer copy = [&](const View& view) {
        if (++steps == 10) half = view.now;
      };
      run(s.model, s.state, s.forces, time, 1e300, {.observers = {&copy, 1}});
      s.state = half;
      s.forces = make_forces(s.model);
    }
    run(s.model, s.state, s.forces, time, 1e300, {});
    states.push_back(s.state);
  }
  use_threads(1);
  expect_same_bits(states[0], states[1]);
  expect_same_bits(states[0], states[2]);
  EXPECT_GT(states[0].interfaces[0].near.size(), 256U);  // more than a thread takes at once
  EXPECT_GT(states[0].step, 20);
}

}  // namespace
}  // namespace nereid::dynamics
