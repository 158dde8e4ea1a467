#include "dynamics/thickness.hpp"

#include <gtest/gtest.h>

#include "dynamics/step.hpp"
#include "mesh/disc.hpp"
#include "mesh/placement.hpp"
#include "tests/dynamics/scene.hpp"

namespace nereid::dynamics::thickness_test {
namespace {

const material::J2Bilinear soft{1000, 1e9, 0.3, {1e6, 1e7}};
const material::Elastic rubber{1000, 1e6, 0.3};

/// Two sheets 1 x 1 of 0.1 thickness, one metal and one rubber, mid-surfaces 0.1 + gap apart.
Scene sheets(double gap, contact::Method method = contact::Method::penalty) {
  Scene s;
  const mesh::Sheet square{1, 1, 2, 2, mesh::Cuts::columns};
  s.model.mesh = mesh::join(mesh::sheet("low", square), mesh::moved(mesh::sheet("high", square), Vec3(0.05, 0.05, 0.1 + gap)));
  s.model.blocks.push_back(element::plates(s.model.mesh, "low", soft, {.thickness = 0.1, .viscosity = {}}));
  s.model.blocks.push_back(element::plates(s.model.mesh, "high", rubber, {.thickness = 0.1, .viscosity = {}}));
  finalize(s.model);
  InterfaceOptions options{.method = method};
  options.height = {.from_initial_height = false, .given = 0.1, .from_thickness = true};
  options.initial_penetration = contact::InitialPenetration::accept;
  s.joined("touch", "high.bottom", "low.top", options);
  s.ready();
  return s;
}

TEST(SeeThickness, GivesANodeTheMeanGrowthOfHalfItsPlatesByMass) {
  Scene s = sheets(0.1);
  Scalars& thickness = s.state.tiles[0].thickness;
  ASSERT_EQ(thickness.size(), 8);
  EXPECT_EQ(s.state.tiles[1].thickness.size(), 0) << "rubber is elastic";
  for (Index e = 0; e < 8; ++e) thickness(e) = 0.1 - 0.001 * e;
  update_thickness(s.model, s.state, s.forces);
  const auto& nodes = element::nodes(s.model.blocks[0]);
  for (Index n = 0; n < s.forces.half_growth.size(); ++n) {
    double sum = 0;
    int count = 0;
    for (Index e = 0; e < 8; ++e)  // all of one mass
      if ((nodes.col(e).array() == n).any()) sum += -0.0005 * e, ++count;
    EXPECT_NEAR(s.forces.half_growth(n), count > 0 ? sum / count : 0, 1e-15);
  }
}

TEST(SeeThickness, IsForNothingWhereAllPlatesAreElastic) {
  Scene s;
  s.model.mesh = mesh::sheet("sheet", {1, 1, 2, 2, mesh::Cuts::columns});
  s.model.blocks.push_back(element::plates(s.model.mesh, "sheet", rubber, {.thickness = 0.1, .viscosity = {}}));
  finalize(s.model);
  s.ready();
  EXPECT_EQ(s.forces.half_growth.size(), 0);
  EXPECT_EQ(s.state.tiles[0].thickness.size(), 0);
}

TEST(FollowThickness, GivesAFreeApexTheHeightOfBothSides) {
  Scene s = sheets(0.05);
  const contact::Interface& touch = std::get<contact::Interface>(s.model.contacts[0]);
  ASSERT_TRUE(touch.follows_thickness);
  Scalars growth = Scalars::Zero(s.model.mesh.X.cols());
  for (const Index n : mesh::node_set(s.model.mesh, "low")) growth(n) = -0.01;
  for (const Index n : mesh::node_set(s.model.mesh, "high")) growth(n) = -0.002;
  contact::follow_thickness(touch, growth, std::get<contact::Memory>(s.state.contacts[0]));
  for (std::size_t a = 0; a < touch.apexes.size(); ++a)
    EXPECT_NEAR(contact::contact_height(touch, std::get<contact::Memory>(s.state.contacts[0]), static_cast<Index>(a)), 0.088, 1e-15);
}

TEST(FollowThickness, NeverRaisesAHeightByMoreThanHalfTheGap) {
  Scene s = sheets(0.002);
  const contact::Interface& touch = std::get<contact::Interface>(s.model.contacts[0]);
  const Scalars growth = Scalars::Constant(s.model.mesh.X.cols(), 0.01);
  contact::Memory& memory = std::get<contact::Memory>(s.state.contacts[0]);
  ASSERT_FALSE(memory.near.empty());
  contact::follow_thickness(touch, growth, memory);
  for (const contact::Near& near : memory.near)
    EXPECT_LE(contact::contact_height(touch, memory, near.apex), 0.1 + 0.5 * memory.gap[near.apex] + 1e-12);
}

TEST(FollowThickness, BooksWhatAPenaltyLosesAsPlatesThinUnderIt) {
  Scene s = sheets(0.001);
  s.move("high", {0, 0, -1});
  s.run_to(0.0012);
  const contact::Interface& touch = std::get<contact::Interface>(s.model.contacts[0]);
  contact::Memory& memory = std::get<contact::Memory>(s.state.contacts[0]);
  ASSERT_GT(contact::stored(memory), 0);
  const double down = 1e-3 * 0.1;
  Scalars growth = Scalars::Zero(s.model.mesh.X.cols());
  for (const Index n : mesh::node_set(s.model.mesh, "low")) growth(n) = -down;
  double force = 0;
  for (const contact::Near& near : memory.near) force += near.element.closed ? near.element.apex.norm() : 0;
  contact::follow_thickness(touch, growth, memory);
  EXPECT_NEAR(memory.thinned, force * down, 1e-9 * force * down);
  contact::follow_thickness(touch, Scalars::Zero(s.model.mesh.X.cols()), memory);
  for (const contact::Near& near : memory.near) {
    if (near.element.closed) { EXPECT_NEAR(near.tracks.track[0].height, 0.1 - down, 1e-15) << "what presses grows no thicker"; }
  }
  EXPECT_NEAR(memory.thinned, force * down, 1e-9 * force * down);
}

/// A square of metal flies apart in its plane: it flows, thins and brings its contact height along, and its bookkeeping stays whole.
TEST(FollowThickness, ThinsWithASheetThatFlows) {
  for (const auto method : {contact::Method::penalty, contact::Method::multiplier}) {
    Scene s = sheets(0.05, method);
    for (const Index n : mesh::node_set(s.model.mesh, "low"))
      s.state.v.col(n) = 70 * (s.model.mesh.X.col(n) - Vec3(0.5, 0.5, 0)).cwiseProduct(Vec3(1, 1, 0));
    s.run_to(0.01);
    const double mean = s.state.tiles[0].thickness.mean();
    EXPECT_LT(mean, 0.09);
    update_thickness(s.model, s.state, s.forces);
    double volume = 0, mass = 0;
    const auto& nodes = element::nodes(s.model.blocks[0]);
    for (Index e = 0; e < 8; ++e) {
      const Vec3 a = s.state.x.col(nodes(1, e)) - s.state.x.col(nodes(0, e)), b = s.state.x.col(nodes(2, e)) - s.state.x.col(nodes(0, e));
      volume += 0.5 * std::abs(a.x() * b.y() - a.y() * b.x()) * s.state.tiles[0].thickness(e);
    }
    mass = element::element_masses(s.model.blocks[0]).sum();
    EXPECT_NEAR(volume, mass / soft.density, 2e-3 * volume) << "all that is elastic";
    EXPECT_LT(std::abs(created(account(s, "low"))), 1e-3 * energy_scale(s.state.ledger));
    const auto& memory = std::get<contact::Memory>(s.state.contacts[0]);
    const auto height = contact::contact_height(std::get<contact::Interface>(s.model.contacts[0]), memory, 0);
    EXPECT_LT(height, 0.1);
    EXPECT_GT(height, 0.08);
  }
}

}  // namespace
}  // namespace nereid::dynamics::thickness_test
