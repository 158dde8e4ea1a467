#include "dynamics/relax.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "dynamics/run.hpp"
#include "mesh/box.hpp"
#include "tests/dynamics/scene.hpp"

namespace nereid::dynamics::relax_test {
namespace {

using load::PlaneKind;

const element::Hexahedron::Options usual{.viscosity = {}};

/// The ledger closes, and relaxation holds what everyone else lost.
void expect_closed(const Scene& s) {
  const Ledger& l = s.state.ledger;
  double energy = 0;
  for (const Account& a : l.accounts) energy = std::max(energy, std::abs(a.work));
  const double momentum = std::sqrt(2 * s.model.mass.sum() * energy);
  double impulse = momentum, angular = momentum;
  for (const Account& a : l.accounts) impulse = std::max(impulse, a.impulse.norm()), angular = std::max(angular, a.angular_impulse.norm());
  // round-off: of sums over the steps, and of gravity's work, which is a difference of positions
  const double round_off = 1e-12 + 1e-16 * static_cast<double>(s.state.step), size = s.model.mesh.X.cwiseAbs().maxCoeff();
  EXPECT_LT(std::abs(energy_residual(l)), round_off * energy + 1e-15 * s.model.mass.sum() * s.model.gravity.norm() * size);
  EXPECT_LT(momentum_residual(l).norm(), round_off * impulse);
  EXPECT_LT(angular_momentum_residual(l).norm(), round_off * angular);
  EXPECT_EQ(created(account(s, "relaxation")), 0);
}

/// A bar along z that hangs from its top and may become thinner, poisson = 0.
Scene hanging(const element::AnyLaw& law, double gravity, int cells, const element::Hexahedron::Options& options = usual) {
  Scene s;
  s.model.mesh = mesh::box("bar", {Vec3::Zero(), Vec3(0.1, 0.1, 1), {1, 1, cells}});
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "bar", law, options));
  s.model.constraints.planes = {plane("top", PlaneKind::constrained, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "bar.z_high")),
                                plane("x", PlaneKind::symmetry, Vec3::UnitX(), mesh::node_set(s.model.mesh, "bar.x_low")),
                                plane("y", PlaneKind::symmetry, Vec3::UnitY(), mesh::node_set(s.model.mesh, "bar.y_low"))};
  s.model.gravity = {0, 0, -gravity};
  s.model.relaxation = Relaxation{};
  finalize(s.model);
  s.ready();
  return s;
}

double lowest(const Scene& s) { return mesh::node_set(s.model.mesh, "bar.z_low").front(); }

TEST(Relaxation, AHangingBarComesToTheDisplacementOfTheClosedForm) {
  // u(L) = rho g L^2 / (2 E); with lumped masses the nodal values of a uniform bar are exact
  Scene s = hanging(material::Elastic{1000, 1e8, 0}, 10, 20);
  const Outcome outcome = s.run_to(10);
  EXPECT_EQ(outcome.ending, Ending::relaxed) << outcome.reason;
  EXPECT_TRUE(good(outcome.ending));
  const double exact = -1000.0 * 10 * 1 / (2 * 1e8);
  const double u = s.state.x(2, static_cast<Index>(lowest(s)));
  std::printf("hanging bar: %ld steps, u / exact - 1 = %.1e, residual %.1e\n", static_cast<long>(s.state.step), u / exact - 1,
              s.state.relaxation.residual);
  EXPECT_NEAR(u / exact, 1, 2e-4);  // strains of 1e-4 at the top
  EXPECT_LE(s.state.relaxation.residual, 1e-6);
  // half of what gravity gave is stored, the other half was removed
  const double given = account(s, "gravity").work;
  EXPECT_NEAR(dissipated(account(s, "relaxation")) / given + dissipated(account(s, "bar")) / given, 0.5, 1e-3);
  // the top carries the weight
  EXPECT_NEAR(account(s, "top").impulse.z() + account(s, "gravity").impulse.z() + account(s, "relaxation").impulse.z(), 0, 1e-4);
  expect_closed(s);
}

TEST(Relaxation, APlasticBarStretchesByTheBilinearLaw) {
  // sigma(z) = rho g z from the free end, strain beyond yield (sigma - yield)/tangent + yield/young
  const double rho = 1000, g = 100, young = 1e8, yield = 5e4, tangent = 1e7;
  // hourglass stiffness would resist a width that changes along the bar
  Scene s = hanging(material::J2Bilinear{rho, young, 0, yield, tangent}, g, 40, {.hourglass = 1e-3, .viscosity = {}});
  const Outcome outcome = s.run_to(20);
  EXPECT_EQ(outcome.ending, Ending::relaxed) << outcome.reason;
  double exact = 0;  // element by element: stress at its middle
  for (int e = 0; e < 40; ++e) {
    const double stress = rho * g * (e + 0.5) / 40;
    exact += (stress <= yield ? stress / young : yield / young + (stress - yield) / tangent) / 40;
  }
  const double u = -s.state.x(2, static_cast<Index>(lowest(s)));
  std::printf("plastic bar: %ld steps, u / exact - 1 = %.1e\n", static_cast<long>(s.state.step), u / exact - 1);
  EXPECT_GT(account(s, "bar").dissipated[Dissipated::plastic], 0);
  EXPECT_NEAR(u / exact, 1, 0.02);  // strains of half a per cent thin the bar; and no overshoot is left behind
  expect_closed(s);
}

TEST(Relaxation, AStripOfPlatesBendsAsABeamUnderAnEndForce) {
  const double length = 1, width = 0.1, thickness = 0.01, young = 2e9, force = 0.1;
  Scene s;
  const mesh::Mesh solid = mesh::box("box", {Vec3::Zero(), Vec3(length, width, 1), {20, 2, 1}});
  const mesh::Surface& top = mesh::surface(solid, "box.z_low");
  mesh::Mesh& mesh = s.model.mesh;
  const Subset used = mesh::surface_nodes(top);
  mesh.X.resize(3, static_cast<Eigen::Index>(used.size()));
  Table<3> facets = top.facets;
  for (std::size_t i = 0; i < used.size(); ++i) mesh.X.col(static_cast<Eigen::Index>(i)) = solid.X.col(used[i]);
  for (Eigen::Index i = 0; i < facets.size(); ++i)
    facets.data()[i] = static_cast<Index>(std::lower_bound(used.begin(), used.end(), facets.data()[i]) - used.begin());
  mesh.triangles.push_back({"strip", facets});
  Subset clamped, end;
  for (Index n = 0; n < mesh.X.cols(); ++n) {
    if (mesh.X(0, n) < 1e-9) clamped.push_back(n);
    if (mesh.X(0, n) > length - 1e-9) end.push_back(n);
  }
  element::Plate::Options options;
  options.thickness = thickness;
  s.model.blocks.push_back(element::plates(mesh, "strip", material::Elastic{1000, young, 0}, options));
  s.model.constraints.planes = {plane("clamp", PlaneKind::fixed, Vec3::UnitZ(), clamped)};
  s.model.relaxation = Relaxation{};
  finalize(s.model);
  const auto none = [](double) { return 0.0; };
  s.model.loads.emplace_back(load::NodalForce{"force", end, {none, none, [=](double) { return force; }}});
  s.ready();
  const Outcome outcome = s.run_to(20);
  EXPECT_EQ(outcome.ending, Ending::relaxed) << outcome.reason;
  const double inertia = width * std::pow(thickness, 3) / 12;
  const double exact = force * std::pow(length, 3) / (3 * young * inertia);
  double u = 0;
  for (const Index n : end) u += s.state.x(2, n) / static_cast<double>(end.size());
  std::printf("strip of plates: %ld steps, t = %.3g s, u = %.4g, u / exact - 1 = %.1e\n", static_cast<long>(s.state.step), s.state.t, u,
              u / exact - 1);
  EXPECT_NEAR(u / exact, 1, 0.01);
  expect_closed(s);
}

/// A block that a pressure of 1 kPa pushes down.
Scene pressed() {
  Scene s;
  s.model.mesh = mesh::box("bar", {Vec3::Zero(), Vec3(0.2, 0.2, 0.2), {2, 2, 2}});
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "bar", material::Elastic{1000, 1e7, 0.3}, usual));
  s.model.relaxation = Relaxation{};
  finalize(s.model);
  s.model.loads.emplace_back(
      load::pressure_on("pressure", s.model.mesh, mesh::surface(s.model.mesh, "bar.z_high"), [](double) { return 1e3; }));
  return s;
}

TEST(Relaxation, ABlockPressedOnAFloorIsCompressedByItsLoad) {
  Scene s = pressed();
  s.model.constraints.planes = {plane("floor", PlaneKind::floor, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "bar"), Vec3(0, 0, -1e-4))};
  s.ready();
  const Outcome outcome = s.run_to(20);
  EXPECT_EQ(outcome.ending, Ending::relaxed) << outcome.reason;
  for (const Index n : mesh::node_set(s.model.mesh, "bar.z_low")) EXPECT_EQ(s.state.x(2, n), -1e-4);
  // halves of quadrilaterals load their corners unevenly, but (Betti) the mean with even weights is that of even loads
  double mean = 0;
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) mean += (i == 1 ? 0.5 : 0.25) * (j == 1 ? 0.5 : 0.25) * s.state.x(2, 18 + 3 * j + i);
  const double compression = (0.2 - 1e-4 - mean) / (0.2 * 1e3 / 1e7);
  std::printf("pressed block: %ld steps, compression / exact - 1 = %.1e\n", static_cast<long>(s.state.step), compression - 1);
  EXPECT_NEAR(compression, 1, 1e-3);  // strain of 1e-4, uneven by as much
  expect_closed(s);
}

TEST(Relaxation, OnARigidPlaneEndsWhereItsPenaltyCarriesTheLoad) {
  Scene s = pressed();
  contact::RigidPlane floor;
  floor.name = "floor", floor.point = Vec3(0, 0, -1e-4), floor.normal = Vec3::UnitZ();
  floor.nodes = mesh::node_set(s.model.mesh, "bar.z_low");
  floor.area = mesh::tributary_areas(s.model.mesh, mesh::surface(s.model.mesh, "bar.z_low"), floor.nodes);
  floor.penalty = 1e9;
  s.model.rigid_planes.push_back(floor);
  s.ready();
  const Outcome outcome = s.run_to(20);
  EXPECT_EQ(outcome.ending, Ending::relaxed) << outcome.reason;
  double force = 0;
  for (const double f : s.state.rigid_planes[0].force) force += f;
  std::printf("block on a penalty: %ld steps, force / load - 1 = %.1e\n", static_cast<long>(s.state.step), force / 40 - 1);
  EXPECT_LT(s.state.step, 2000);  // 1510; with a frequency that follows the chatter on the penalty it creeps, 2350
  EXPECT_NEAR(force / 40, 1, 1e-3);  // the pressure follows an area that grows by 2 nu sigma / E
  expect_closed(s);
}

TEST(Relaxation, HeatOfFrictionAndWhatContactsHoldIsTheirWorkThoughVelocitiesAreScaled) {
  for (const bool on_a_plane : {true, false})
    for (const double friction : {0.0, 0.1, 0.3, 0.9}) {
      Scene s;
      mesh::Mesh block = mesh::box("block", {Vec3(0, 0, 0), Vec3(0.1, 0.1, 0.05), {3, 3, 2}});
      const mesh::Mesh bed = mesh::box("bed", {Vec3(-0.05, -0.05, -0.05), Vec3(0.15, 0.15, 0), {4, 4, 2}});
      s.model.mesh = on_a_plane ? block : mesh::join(block, bed);
      for (const char* name : {"block", "bed"})
        if (!on_a_plane || name == std::string("block"))
          s.model.blocks.push_back(element::hexahedra(s.model.mesh, name, material::Elastic{1000, 1e7, 0.3}, {}));
      if (!on_a_plane)
        s.model.constraints.planes = {plane("ground", PlaneKind::fixed, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "bed.z_low"))};
      s.model.gravity = {0, 0, -9.81};
      s.model.relaxation = Relaxation{.residual = 1e-4, .after = 0.02};
      finalize(s.model);
      if (on_a_plane) {
        const mesh::Surface& sole = mesh::surface(s.model.mesh, "block.z_low");
        contact::RigidPlane ground;
        ground.name = "touch", ground.method = contact::Method::multiplier, ground.point = Vec3::Zero(), ground.normal = Vec3::UnitZ();
        ground.nodes = mesh::surface_nodes(sole), ground.area = mesh::tributary_areas(s.model.mesh, sole, ground.nodes);
        ground.impedance = surface_impedance(s.model, sole), ground.friction.coefficient = friction;
        s.model.rigid_planes = {ground};
      } else {
        InterfaceOptions options;
        options.friction.coefficient = friction;
        s.joined("touch", "block.z_low", "bed.z_high", options);
      }
      s.ready();
      const Outcome outcome = s.run_to(0.5, 1e-3);
      EXPECT_EQ(outcome.ending, Ending::relaxed) << outcome.reason;
      const Account& touch = account(s, "touch");
      // an apex that holds less than the correction takes from it has a deficit, which is created until it is covered
      EXPECT_LT(std::abs(created(touch)), 1e-5 * s.state.ledger.external_work) << on_a_plane << " " << friction;
      EXPECT_LT(std::abs(s.state.ledger.flows[source_of(s.model, "touch")].worst), 1e-6);
      const double weight = 1000 * 0.1 * 0.1 * 0.05 * 9.81;
      const Vec3 force = on_a_plane ? contact::force(s.model.rigid_planes[0], s.state.rigid_planes[0])
                                    : contact::sides(s.state.contacts[0]).force;
      EXPECT_NEAR(force.z() / weight, 1, 1e-3);
    }
}

TEST(Relaxation, ThatIsNotThereAtTheEndSaysHowFarItIs) {
  Scene s = hanging(material::Elastic{1000, 1e8, 0}, 10, 20);
  const Outcome outcome = s.run_to(5e-3);
  EXPECT_EQ(outcome.ending, Ending::not_relaxed);
  EXPECT_FALSE(good(outcome.ending));
  double residual = 0, limit = 0;
  ASSERT_EQ(std::sscanf(outcome.reason.c_str(), "the residual is %lg; the limit is %lg", &residual, &limit), 2) << outcome.reason;
  EXPECT_NEAR(residual, s.state.relaxation.residual, 1e-2 * residual);  // three digits are told
  EXPECT_NEAR(limit, s.model.relaxation->residual, 1e-2 * limit);
}

TEST(Relaxation, OfWhatFallsSaysThatItMoves) {
  Scene s;
  s.model.mesh = mesh::box("bar", {Vec3::Zero(), Vec3(0.1, 0.1, 1), {1, 1, 5}});
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "bar", material::Elastic{1000, 1e8, 0}, usual));
  for (const double sign : {-1.0, 1.0}) {  // two forces that squeeze it, beside which its weight is little
    const auto none = [](double) { return 0.0; };
    const std::string end = sign < 0 ? "bar.z_high" : "bar.z_low";
    s.model.loads.emplace_back(load::NodalForce{end, mesh::node_set(s.model.mesh, end),
                                                {none, none, [sign](double) { return sign * 1000; }}});
  }
  s.model.gravity = {0, 0, -10};
  s.model.relaxation = Relaxation{.residual = 0.2};
  finalize(s.model);
  s.ready();
  const Outcome outcome = s.run_to(0.1);
  EXPECT_EQ(outcome.ending, Ending::not_relaxed);
  EXPECT_EQ(outcome.reason.rfind("the forces balance, but the kinetic energy is ", 0), 0U) << outcome.reason;
}

TEST(Relaxation, WaitsForLoadsThatGrow) {
  Scene s = hanging(material::Elastic{1000, 1e8, 0}, 0, 5);
  s.model.relaxation->after = 0.02;
  const auto none = [](double) { return 0.0; };
  s.model.loads.emplace_back(load::NodalForce{"pull", mesh::node_set(s.model.mesh, "bar.z_low"),
                                              {none, none, [](double t) { return -100 * std::min(1.0, t / 0.02); }}});
  s.ready();
  const Outcome outcome = s.run_to(10);
  EXPECT_EQ(outcome.ending, Ending::relaxed);
  EXPECT_GE(s.state.t, 0.02);
  EXPECT_NEAR(s.state.x(2, static_cast<Index>(lowest(s))) / (-100 / (1e8 * 0.01)), 1, 1e-3);
}

TEST(Relaxation, OfABodyThatFliesFreelyNeverEnds) {
  Scene s = hanging(material::Elastic{1000, 1e8, 0}, 0, 2);
  s.model.constraints.planes.clear();
  s.ready();
  s.state.v.row(0).setConstant(3);
  EXPECT_EQ(s.run_to(0.05).ending, Ending::not_relaxed);
  EXPECT_NEAR(s.state.v(0, 0), 3, 1e-9);  // nothing resists it, so nothing damps it
}

}  // namespace
}  // namespace nereid::dynamics::relax_test
