#include "dynamics/quality.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "dynamics/balance.hpp"
#include "dynamics/displace.hpp"
#include "dynamics/overlaps.hpp"
#include "mesh/box.hpp"
#include "mesh/disc.hpp"
#include "tests/dynamics/scene.hpp"

namespace nereid::dynamics::quality_test {
namespace {

const material::Elastic rubber{1000, 1e6, 0.3};

const element::Hexahedron::Options bare{.viscosity = {}, .distortion = {0}};

/// A block clamped below, whose middle of the top is pushed down; by default one-point elements whose corners nothing keeps open.
///
/// back  [s] from when on it is pulled up again
Scene pushed(double speed, double back = 1e300, const element::AnyHexahedronOptions& options = bare) {
  Scene s;
  s.model.mesh = mesh::box("box", {Vec3(-1, -1, 0), Vec3(1, 1, 1), {2, 2, 2}});
  s.model.blocks.push_back(element::solids(s.model.mesh, "box", rubber, options));
  Index middle = 0;
  for (Index n = 0; n < s.model.mesh.X.cols(); ++n)
    if ((s.model.mesh.X.col(n) - Vec3::UnitZ()).norm() < 1e-9) middle = n;
  load::Plane push = plane("push", load::PlaneKind::driven, Vec3::UnitZ(), {middle});
  const auto none = [](double, double, double, double) { return 0.0; };
  push.field = {none, none, [=](double, double, double, double t) { return t < back ? -speed : speed; }};
  s.model.constraints.planes = {plane("clamp", load::PlaneKind::fixed, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "box.z_low")), push};
  finalize(s.model);
  s.ready();
  return s;
}

TEST(Quality, OfACornerThatInvertsEndsTheRunWithItsElement) {
  Scene s = pushed(1);
  Time time;
  time.end = 1.2, time.created_limit = time.overlap_limit = 1e300;
  const Outcome outcome = run(s.model, s.state, s.forces, time, 0.01);
  EXPECT_EQ(outcome.ending, Ending::inverted_element);
  EXPECT_GE(outcome.element, 4) << "one of the upper four";
  EXPECT_EQ(outcome.block, "box");
  EXPECT_NE(outcome.reason.find("the Jacobian of a corner is"), std::string::npos) << outcome.reason;
  EXPECT_GT(s.state.quality[0].corner, -0.5) << "it has looked in time";
  EXPECT_EQ(s.state.quality[0].time, s.state.t);
}

TEST(Quality, OfANodePushedThroughItsElementsIsAnInvertedCornerAndHourglassEnergy) {
  Scene s = pushed(1);
  Time time;
  time.end = 1.2, time.created_limit = time.overlap_limit = 1e300, time.corner_limit = -1e300;  // it goes out at the bottom, too
  EXPECT_TRUE(good(run(s.model, s.state, s.forces, time, 0.01).ending)) << "volumes stay positive";
  EXPECT_LT(s.state.quality[0].corner, 0);
  EXPECT_GE(s.state.quality[0].element, 4) << "one of the upper four";
  EXPECT_GT(s.state.quality[0].time, 0.5);
  EXPECT_GT(of_internal(s.state.quality[0], s.state.quality[0].hourglass, energy_scale(s.state.ledger)), 0.1);
}

TEST(Quality, OfCornersThatAreKeptOpenIsAnAccountOfTheLedgerAndSoIsHowFarTheLawIsPressed) {
  for (const element::AnyHexahedronOptions& options :
       {element::AnyHexahedronOptions(element::Hexahedron::Options{}), element::AnyHexahedronOptions(element::FullHexahedron::Options{})}) {
    Scene s = pushed(1, 1e300, options);
    Time time;
    time.end = 0.9, time.created_limit = time.overlap_limit = 1e300;
    EXPECT_TRUE(good(run(s.model, s.state, s.forces, time, 0.01).ending));
    const Quality& seen = s.state.quality[0];
    EXPECT_GT(seen.corner, 0);
    EXPECT_LT(seen.corner, 0.3) << "the control acts";
    const Account& account = s.state.ledger.accounts[0];
    EXPECT_GT(account.stored[Stored::distortion], 0);
    EXPECT_EQ(seen.distortion, account.stored[Stored::distortion]) << "it is pushed on to the end";
    EXPECT_LT(std::abs(created(account)), 0.02 * std::abs(account.work)) << "what is stored is the work of the nodes";
    EXPECT_GT(seen.pressed.ratio, 0.1);
    EXPECT_GE(seen.pressed.element, 0);
    EXPECT_GT(seen.pressed_at, 0.5);
  }
}

TEST(Quality, OfPlatesThatKeepTheirThicknessIsHowFarItIsOff) {
  for (const auto thinning : {element::Plate::Thinning::constant, element::Plate::Thinning::by_law}) {
    Scene s;
    s.model.mesh = mesh::sheet("sheet", {1, 1, 2, 2, mesh::Cuts::columns});
    const material::J2Bilinear metal{1000, 1e9, 0.3, {1e6, 1e7}};
    s.model.blocks.push_back(element::plates(s.model.mesh, "sheet", metal, {.thickness = 0.1, .viscosity = {}, .thinning = thinning}));
    finalize(s.model);
    s.ready();
    for (Eigen::Index n = 0; n < s.state.v.cols(); ++n)
      s.state.v.col(n) = 70 * (s.model.mesh.X.col(n) - Vec3(0.5, 0.5, 0)).cwiseProduct(Vec3(1, 1, 0));
    s.run_to(0.01, 1e-3);
    if (thinning == element::Plate::Thinning::by_law) {
      EXPECT_EQ(s.state.quality[0].thinned.element, -1);
      EXPECT_LT(s.state.tiles[0].thickness.mean(), 0.09);
    } else {
      EXPECT_GE(s.state.quality[0].thinned.element, 0);
      EXPECT_LT(s.state.quality[0].thinned.ratio, 0.9);
      EXPECT_GT(s.state.quality[0].thinned_at, 0);
    }
  }
}

/// A square of rubber plates whose middle node is given a spin about the normal.
Scene spun(double drilling) {
  Scene s;
  s.model.mesh = mesh::sheet("sheet", {1, 1, 4, 4, mesh::Cuts::columns});
  s.model.blocks.push_back(element::plates(s.model.mesh, "sheet", material::Elastic{1000, 1e6, 0.3},
                                           {.thickness = 0.1, .viscosity = {}, .drilling = drilling}));
  finalize(s.model);
  s.ready();
  return s;
}
Index middle(const Scene& s) {
  for (Index n = 0; n < static_cast<Index>(s.model.mesh.X.cols()); ++n)
    if ((s.model.mesh.X.col(n) - Vec3(0.5, 0.5, 0)).norm() < 1e-9) return n;
  return -1;
}

TEST(Quality, OfPlatesWhoseNodesSpinAboutTheirNormalsIsTheEnergyOfThat) {
  Scene s = spun(0);
  const Index node = middle(s), r = s.model.rotation_of_node[node];
  s.state.omega.col(r) = Vec3(0, 0, 2);
  s.run_to(0.1);
  EXPECT_EQ(s.state.quality[0].spin.node, node);
  EXPECT_NEAR(s.state.quality[0].spin.energy, 0.5 * s.model.inertia(r) * 4, 1e-12);
  EXPECT_NEAR(s.state.omega(2, r), 2, 1e-12) << "nothing resists it";
}

TEST(Quality, OfPlatesThatTurnWithTheirNodesHasNoSpin) {
  Scene s = spun(0);
  for (Eigen::Index n = 0; n < s.state.v.cols(); ++n) s.state.v.col(n) = Vec3(0, 0, 2).cross(Vec3(s.model.mesh.X.col(n)));
  for (Eigen::Index r = 0; r < s.state.omega.cols(); ++r) s.state.omega.col(r) = Vec3(0, 0, 2);
  EXPECT_NEAR(free_spin(s.model, 0, s.state).energy, 0, 1e-12);
}

TEST(Quality, OfASpinThatDrillingStiffnessTakesUpIsNotLookedAtAndItsEnergyIsAccountedFor) {
  Scene s = spun(0.01);
  const Index node = middle(s), r = s.model.rotation_of_node[node];
  s.state.omega.col(r) = Vec3(0, 0, 2);
  const double kinetic = 0.5 * s.model.inertia(r) * 4;
  double most = 0;
  for (int i = 1; i <= 50; ++i) {
    s.run_to(0.01 * i);
    most = std::max(most, account(s, "sheet").stored[Stored::drilling]);
  }
  EXPECT_EQ(s.state.quality[0].spin.energy, 0);
  EXPECT_GT(most, 0.3 * kinetic);
  EXPECT_LT(most, 1.01 * kinetic);
  EXPECT_LT(std::abs(created(account(s, "sheet"))), 1e-3 * kinetic);
}

TEST(Quality, OfCornersIsSeenInAShortRunToo) {
  Scene s = pushed(1, 0.8);
  Time time;
  time.end = 1.5, time.created_limit = time.overlap_limit = 1e300, time.corner_limit = -1e300, time.audit_every = 0.1;
  run(s.model, s.state, s.forces, time, 0.01);
  EXPECT_LT(s.state.step, corners_every);
  EXPECT_LT(s.state.quality[0].corner, 0);
  EXPECT_NEAR(s.state.quality[0].time, 0.8, 0.11);
  EXPECT_FALSE(s.state.quality[0].inverted) << "it has come back";
}

TEST(Quality, OfAnInvertedCornerHasABodyLookedAtForOverlapsWithItself) {
  Scene s = pushed(1);
  Time time;
  time.end = 1.2, time.created_limit = time.overlap_limit = 1e300, time.corner_limit = -1e300, time.audit_every = 0.1;
  std::vector<std::int64_t> looks;
  const Observer see = [&](const View& view) {
    const Progress& progress = view.now.progress;
    if (view.now.t < 1.15 && (looks.empty() || looks.back() != progress.audited_itself)) looks.push_back(progress.audited_itself);
  };
  run(s.model, s.state, s.forces, time, 0.01, {.observers = {&see, 1}});
  EXPECT_LT(s.state.step, updates_per_edge);
  EXPECT_GT(looks.size(), 2) << "not at the start and at the end alone";
}

TEST(Quality, IsLookedAtWhereverARunEndsAlsoByACondition) {
  Scene s = pushed(1);
  Time time;
  time.end = 1.2, time.created_limit = 1e300;
  const Until enough = [](const View& view, auto&) { return view.now.t > 0.3 ? std::string("enough") : std::string(); };
  EXPECT_EQ(run(s.model, s.state, s.forces, time, 0.01, {.until = enough}).ending, Ending::stopped_by_condition);
  EXPECT_EQ(s.state.progress.corners_seen, s.state.step);
  EXPECT_LT(s.state.quality[0].corner, 0.9);
}

TEST(Quality, CountsTheEnergyThatABlockHasAtTheStart) {
  Scene s;
  s.model.mesh = mesh::box("box", {Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1), {2, 2, 2}});
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "box", rubber, {}));
  s.model.constraints.planes = {plane("clamp", load::PlaneKind::fixed, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "box.z_low"))};
  finalize(s.model);
  s.ready();
  Vectors u = Vectors::Zero(3, s.model.mesh.X.cols());
  u.row(2) = -0.1 * s.model.mesh.X.row(2);  // let go, it bulges beside the clamp, and what is stored falls
  displace(s.model, s.state, u, {});
  s.run_to(0.1, 0.001);
  const double fraction = of_internal(s.state.quality[0], s.state.quality[0].hourglass, energy_scale(s.state.ledger));
  EXPECT_GT(fraction, 0);
  EXPECT_LT(fraction, 0.3);
}

/// A bar of ten cells of which one in the middle is bent by its nodes alone, or that bends as a beam.
Scene bent(bool alone) {
  Scene s;
  s.model.mesh = mesh::box("box", {Vec3::Zero(), Vec3(10, 1, 1), {10, 1, 1}});
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "box", rubber, {}));
  finalize(s.model);
  s.ready();
  const Vectors& X = s.model.mesh.X;
  Vectors u = Vectors::Zero(3, X.cols());
  for (Eigen::Index n = 0; n < X.cols(); ++n) {
    if (!alone) u(0, n) = 1e-3 * (X(2, n) - 0.5) * X(0, n), u(2, n) = -0.5e-3 * X(0, n) * X(0, n);
    else if (std::abs(X(0, n) - 5) < 0.1) u(0, n) = 1e-3 * (X(2, n) - 0.5);
  }
  displace(s.model, s.state, u, {});
  update_ledger(s.model, s.state);
  check_artificial_energy(s.model, s.state);
  return s;
}

TEST(Quality, AddsUpHowElementsDifferFromTheirNeighboursOverTheLooks) {
  Scene beam = bent(false), alone = bent(true);
  for (Scene* s : {&beam, &alone}) {
    compare_elements(s->model, 1, false, s->state);
    EXPECT_EQ(s->state.progress.contrast_looks, 0) << "it is not time";
    s->state.step = contrast_every;
    compare_elements(s->model, 1, false, s->state);
    compare_elements(s->model, 1, true, s->state);
    EXPECT_EQ(s->state.progress.contrast_looks, 1) << "one look a step";
    s->state.step += 1, s->state.t = 1.0 / least_contrast_looks;
    compare_elements(s->model, 1, false, s->state);
    EXPECT_EQ(s->state.progress.contrast_looks, 2);
    s->state.ledger.initial_available = s->state.ledger.initial_kinetic = stored(s->state.ledger.accounts[0]);
  }
  EXPECT_LT(contrast(beam.state).bending, 0.03);
  EXPECT_GT(contrast(alone.state).bending, 0.1) << "both cells at the plane, whose energy is in strain too";
  EXPECT_NEAR(contrast(beam.state).strain, 1, 1e-3) << "of the energy of the scene: two looks, and their mean";
  beam.state.ledger.initial_available = beam.state.ledger.initial_kinetic = 1e5 * beam.state.ledger.initial_kinetic;
  EXPECT_EQ(contrast(beam.state).bending, 0) << "so little strain says nothing";
}

TEST(Quality, OfARunIsComparedTwentyTimesOrMore) {
  Scene s = bent(true);
  Time time;
  time.end = 0.1;
  EXPECT_TRUE(good(run(s.model, s.state, s.forces, time, 0.01).ending));
  EXPECT_GE(s.state.progress.contrast_looks, std::min<std::int64_t>(least_contrast_looks, s.state.step));
  EXPECT_LE(s.state.progress.contrast_looks, least_contrast_looks + 1 + s.state.step / contrast_every);
}

TEST(Quality, OfAStageIsComparedAsOften) {
  Scene s = bent(true);
  s.state.progress.stages = {0, 10};
  s.state.t = s.state.progress.contrast_seen = 10, s.state.step = s.state.progress.contrast_step = 7;
  for (int k = 1; k <= 3; ++k) {
    s.state.step += 1, s.state.t = 10 + 0.9 * k / least_contrast_looks;
    compare_elements(s.model, 11, false, s.state);
  }
  EXPECT_EQ(s.state.progress.contrast_looks, 1) << "one second is left of eleven";
}

TEST(DissipatedShare, IsWhatAChannelTookOverTheEnergyOfTheScene) {
  Ledger ledger;
  EXPECT_EQ(dissipated_share(ledger, Dissipated::viscous), 0);
  ledger.initial_available = ledger.initial_kinetic = 8;
  ledger.accounts.resize(2);
  ledger.accounts[0].dissipated[Dissipated::viscous] = 1, ledger.accounts[1].dissipated[Dissipated::viscous] = 3;
  ledger.accounts[1].dissipated[Dissipated::plastic] = 3;
  EXPECT_EQ(dissipated_share(ledger, Dissipated::viscous), 0.5);
  EXPECT_EQ(dissipated_share(ledger, Dissipated::plastic), 0.375);
}

TEST(Quality, OfABlockThatMovesAsOneIsThatOfTheReference) {
  Scene s;
  s.model.mesh = mesh::box("box", {Vec3::Zero(), Vec3::Ones(), {2, 2, 2}});
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "box", rubber, {}));
  finalize(s.model);
  s.ready();
  s.move("box", {3, 4, 5});
  s.run_to(0.2, 0.01);
  EXPECT_NEAR(s.state.quality[0].corner, 1, 1e-12);
  EXPECT_EQ(of_internal(s.state.quality[0], s.state.quality[0].hourglass, energy_scale(s.state.ledger)), 0) << "round-off is no energy";
}

}  // namespace
}  // namespace nereid::dynamics::quality_test
