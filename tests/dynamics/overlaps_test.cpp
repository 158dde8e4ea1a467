#include "dynamics/overlaps.hpp"

#include <gtest/gtest.h>

#include "mesh/box.hpp"
#include "mesh/disc.hpp"
#include "mesh/placement.hpp"
#include "tests/dynamics/scene.hpp"

namespace nereid::dynamics::overlaps_test {
namespace {

const material::Elastic rubber{1000, 1e6, 0.3};

/// Two cubes of side 1, a gap of 0.1 between them, that close in with a speed, without a contact or with a soft one.
Scene closing(double speed, double penalty = 0) {
  Scene s;
  const auto cube = [](const std::string& name, double x) {
    return mesh::moved(mesh::box(name, {Vec3::Zero(), Vec3::Ones(), {2, 2, 2}}), Vec3(x, 0.1 * x, 0));
  };
  s.model.mesh = mesh::join(cube("a", 0), cube("b", 1.1));
  for (const char* name : {"a", "b"}) s.model.blocks.push_back(element::hexahedra(s.model.mesh, name, rubber, {}));
  finalize(s.model);
  InterfaceOptions options{.method = contact::Method::penalty};
  options.penalty = penalty;
  if (penalty > 0) s.joined("touch", "a.x_high", "b.x_low", options);
  s.ready();
  s.move("b", {-speed, 0, 0});
  return s;
}

TEST(SeeOverlaps, StopsARunWhereBodiesAreHalfAnElementInEachOther) {
  Scene s = closing(1);
  const Outcome outcome = s.run_to(1, 0.01);
  EXPECT_EQ(outcome.ending, Ending::bodies_overlap) << word(outcome.ending);
  EXPECT_FALSE(good(outcome.ending));
  EXPECT_EQ(word(outcome.ending), "bodies_overlap");
  EXPECT_NEAR(s.state.t, 0.35, 0.011) << "a gap of 0.1, then half of 0.5";
  EXPECT_NE(outcome.reason.find("a and b overlap by 0.2"), std::string::npos) << outcome.reason;
  EXPECT_NE(outcome.reason.find("without a contact between them; the limit is 0.5 of an element"), std::string::npos) << outcome.reason;
}

TEST(SeeOverlaps, LooksAtTheEndInAnyCase) {
  Scene s = closing(1);
  EXPECT_EQ(s.run_to(0.4).ending, Ending::bodies_overlap);
  EXPECT_NEAR(audit::worst(s.state.audit)->deepest, 0.3, 1e-6);
  EXPECT_EQ(s.state.progress.audited_itself, s.state.step);
}

TEST(SeeOverlaps, OfATenthOfAnElementStopsNothing) {
  Scene s = closing(1);
  EXPECT_EQ(s.run_to(0.2, 0.01).ending, Ending::reached_end);
  const audit::Overlap* worst = audit::worst(s.state.audit);
  ASSERT_NE(worst, nullptr);
  EXPECT_NEAR(worst->deepest, 0.1, 1e-9);
  EXPECT_NEAR(worst->grown, 0.2, 1e-9);
  EXPECT_NE(in_words(s.forces.audit.surfaces, *worst).find("a and b overlap by 0.1 m, 0.2 of an element"), std::string::npos);
}

TEST(SeeOverlaps, IsAllowedAsMuchAsTheLimitSays) {
  Scene s = closing(1);
  Time time;
  time.end = 0.4, time.overlap_limit = 1;
  EXPECT_EQ(run(s.model, s.state, s.forces, time, 0.01).ending, Ending::reached_end);
}

TEST(SeeOverlaps, KnowsWhichContactJoinsTheBodies) {
  Scene s = closing(1, 3e4);
  EXPECT_TRUE(good(s.run_to(0.3, 0.01).ending));
  const audit::Overlap* worst = audit::worst(s.state.audit);
  ASSERT_NE(worst, nullptr);
  EXPECT_GT(worst->deepest, 0.01);
  EXPECT_TRUE(joins(std::get<contact::Interface>(s.model.contacts[0]), s.forces.audit.surfaces, *worst));
  audit::Overlap itself = *worst;
  itself.surface = {0, 0};
  EXPECT_FALSE(joins(std::get<contact::Interface>(s.model.contacts[0]), s.forces.audit.surfaces, itself));
}

TEST(SeeOverlaps, LooksOnlyWhereALookIsDue) {
  Scene s = closing(0);
  Time time;
  time.end = 0.4, time.audit_every = 0.1;
  run(s.model, s.state, s.forces, time, 0.01);
  EXPECT_EQ(s.state.audit.looks, 5) << "start, three between, end";
}

TEST(SeeOverlaps, GoesOnWithTheBitsOfARunWithoutABreak) {
  Scene s = closing(1, 3e4);
  State kept;
  const Observer keep = [&](const View& view) {
    if (view.now.t < 0.2) kept = view.now;
  };
  s.run_to(0.4, 0.01, {&keep, 1});
  ASSERT_FALSE(kept.audit.overlaps.empty());
  Forces forces = make_forces(s.model);
  Time time;
  time.end = 0.4;
  run(s.model, kept, forces, time, 0.01);
  expect_same_bits(s.state, kept);
}

/// A cube whose lower side stands at a height over the mid-surface of a plate that is 0.1 thick.
Scene over_plate(double height, const contact::ContactHeight& at, contact::InterfaceKind kind = contact::InterfaceKind::contact) {
  Scene s;
  s.model.mesh = mesh::join(mesh::moved(mesh::box("block", {Vec3::Zero(), Vec3::Ones(), {2, 2, 2}}), Vec3(0.5, 0.6, height)),
                            mesh::sheet("plate", {2, 2, 2, 2}));
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "block", rubber, {}));
  element::Plate::Options plate;
  plate.thickness = 0.1;
  s.model.blocks.push_back(element::plates(s.model.mesh, "plate", rubber, plate));
  finalize(s.model);
  InterfaceOptions options{.method = contact::Method::penalty};
  options.kind = kind, options.height = at;
  s.joined("touch", "block.z_low", "plate.top", options);
  s.ready();
  return s;
}

TEST(AllowedOverlaps, AreWhatTheContactHeightIsLessThanHalfTheThickness) {
  const auto allowed = [](const contact::ContactHeight& height, double from = 0.2, auto... kind) {
    const auto all = over_plate(from, height, kind...).forces.audit.allowed;
    return all.empty() ? 0 : all.at({0, 1});
  };
  EXPECT_EQ(allowed({false, 0, 0.05}), 0);
  EXPECT_NEAR(allowed({false, 0, 0.03}), 0.02, 1e-15);
  EXPECT_NEAR(allowed({false, 0, 0}), 0.05, 1e-15);
  EXPECT_EQ(allowed({true, 0, 0}), 0) << "it starts farther away";
  EXPECT_NEAR(allowed({true, 0, 0}, 0.04), 0.01, 1e-12);
  EXPECT_NEAR(allowed({true, 0, 0}, -0.01), 0.05, 1e-12) << "of the solid nothing";
  EXPECT_EQ(allowed({true, 0, 0}, 0.04, contact::InterfaceKind::tied), 0) << "at the start is accepted, and it stays";
}

TEST(SeeOverlaps, AcceptsOfAPlateWhatItsContactHeightAllowsAgainAndAgain) {
  Scene s = over_plate(0.03, {true, 0, 0});
  ASSERT_EQ(s.state.audit.looks, 0);
  const auto at = [&](double height) {
    for (const Index n : mesh::node_set(s.model.mesh, "block")) s.state.x(2, n) = s.model.mesh.X(2, n) - 0.03 + height;
    ++s.state.step;
    update_overlaps(s.model, true, 0, s.state, s.forces);
    return audit::worst(s.state.audit)->grown;
  };
  EXPECT_EQ(at(0.03), 0);
  EXPECT_EQ(at(0.3), 0);
  EXPECT_NEAR(at(0.029), 0.01, 1e-9) << "as at the start, and a millimetre";
  EXPECT_NEAR(at(-0.01), 0.4, 1e-9);
}

}  // namespace
}  // namespace nereid::dynamics::overlaps_test
