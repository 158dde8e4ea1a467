#include "dynamics/displace.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "dynamics/balance.hpp"
#include "dynamics/step.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "tests/dynamics/scene.hpp"

namespace nereid::dynamics::displace_test {
namespace {

Scene box(const element::AnyLaw& law) {
  Scene s;
  s.model.mesh = mesh::box("box", {Vec3::Zero(), Vec3(0.3, 0.2, 0.2), {3, 2, 2}});
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "box", law, {}));
  finalize(s.model);
  s.ready();
  return s;
}

double stress(const Scene& s, int component) {
  return element::fields(s.model.blocks[0], s.model.mesh.X, s.state.x, s.state.blocks[0])[0].values(component, 0);
}

Vectors linear(const Model& model, const Mat3& G) { return G * model.mesh.X; }

double residual(const Scene& s) { return std::abs(energy_residual(s.state.ledger)); }

TEST(Displace, AStretchedBarStartsWithItsElasticStressAndEnergy) {
  const double strain = 1e-4, young = 1e6, poisson = 0.3;
  Scene s = box(material::Elastic{1000, young, poisson});
  Mat3 G = Mat3::Zero();
  G.diagonal() = strain * Vec3(1, -poisson, -poisson);  // uniaxial stress
  const element::BlockLimit smallest = displace(s.model, s.state, linear(s.model, G), {});
  EXPECT_NEAR(smallest.volume_ratio, 1, 1e-4);
  EXPECT_NEAR(stress(s, 0) / (young * strain), 1, 1e-3);  // second order in the strain
  EXPECT_NEAR(stress(s, 1) / (young * strain), 0, 1e-3);
  start(s.model, s.state, s.forces);
  const double exact = 0.5 * young * strain * strain * 0.3 * 0.2 * 0.2;
  EXPECT_NEAR(initial_stored(s.state.ledger) / exact, 1, 1e-3);
  EXPECT_EQ(s.state.ledger.initial_kinetic, 0);
  EXPECT_EQ(created(s.state.ledger.accounts[0]), 0);
  EXPECT_LT((s.state.x - s.model.mesh.X - linear(s.model, G)).norm(), 1e-15);
}

TEST(Displace, ASheetStretchedByTenPerCentHasHenckyStress) {
  Scene s = box(material::Elastic{1000, 1e6, 0});
  Mat3 G = Mat3::Zero();
  G(0, 0) = 0.1;
  displace(s.model, s.state, linear(s.model, G), {});
  EXPECT_NEAR(stress(s, 0) / (1e6 * std::log(1.1)), 1, 1e-6);  // hypoelastic: log strain, a hundred midpoint steps
}

TEST(Displace, LetsGoABarWhoseLedgerClosesAndWhoseEnergyIsThatOfTheStart) {
  Scene s = box(material::Elastic{1000, 1e6, 0.3});
  Mat3 G = Mat3::Zero();
  G(0, 0) = 0.01, G(1, 0) = 0.005;
  displace(s.model, s.state, linear(s.model, G), {});
  s.model.gravity = {1, 2, 3};
  s.state.ledger = initial_state(s.model, {}).ledger;  // with an account of gravity
  StepLimits limits = start(s.model, s.state, s.forces);
  for (int i = 0; i < 300; ++i) limits = step(s.model, 0.5 * least(limits), s.state, s.forces);
  update_ledger(s.model, s.state);
  const double held = initial_stored(s.state.ledger);
  EXPECT_GT(held, 0);
  EXPECT_LT(residual(s), 1e-12 * held);
  EXPECT_LT(stored(s.state.ledger.accounts[0]), 0);  // it gives back
  std::printf("let go: created %.1e of the initial stored energy\n", created(s.state.ledger.accounts[0]) / held);
  EXPECT_LT(std::abs(created(s.state.ledger.accounts[0])), 1e-3 * held);
  EXPECT_NEAR(created(s.state.ledger.accounts[1]), 0, 1e-15);
}

TEST(Displace, BeyondYieldLeavesPlasticStrainAndBooksNoDissipationToTheRun) {
  const double yield = 1e3;
  Scene s = box(material::J2Bilinear{1000, 1e6, 0, yield, 0});
  Mat3 G = Mat3::Zero();
  G(0, 0) = 0.01;
  displace(s.model, s.state, linear(s.model, G), {});
  const auto fields = element::fields(s.model.blocks[0], s.model.mesh.X, s.state.x, s.state.blocks[0]);
  EXPECT_NEAR(fields[1].values(0, 0) / yield, 1, 1e-9);
  EXPECT_GT(fields[3].values(0, 0), 0.001);
  start(s.model, s.state, s.forces);
  EXPECT_NEAR(dissipated(s.state.ledger.accounts[0]), 0, 1e-12 * yield * 0.01 * 0.012);  // round-off of a return to the yield surface
}

TEST(Displace, SaysThatAnElementIsTurnedInsideOut) {
  Scene s = box(material::Elastic{1000, 1e6, 0});
  Mat3 G = Mat3::Zero();
  G(0, 0) = -1.5;
  EXPECT_LE(displace(s.model, s.state, linear(s.model, G), {}).volume_ratio, 0);
}

/// A tube of plates, bent by a field with a gradient.
Scene tube() {
  Scene s;
  s.model.mesh = mesh::tube("tube", {0.5, 0.8, mesh::Revolution::full, 2, 4});
  element::Plate::Options options;
  options.thickness = 0.01;
  s.model.blocks.push_back(element::plates(s.model.mesh, "tube", material::Elastic{1000, 1e6, 0.3}, options));
  finalize(s.model);
  s.ready();
  return s;
}

/// Of the shear itself, and of the bending within elements that it makes. [J]
double of_shear(const element::Memory& memory) { return memory.stored[Stored::transverse_shear] + memory.stored[Stored::residual_bending]; }

TEST(Displace, ARigidTurnOfPlatesLeavesThemWithoutStress) {
  Scene s = tube();
  const Mat3 G = Eigen::AngleAxisd(1e-3, Vec3(1, 2, 3).normalized()).toRotationMatrix() - Mat3::Identity();
  displace(s.model, s.state, linear(s.model, G), std::vector<Mat3>(s.model.node_of_rotation.size(), G));
  // the straight path cuts the corner by the angle squared
  EXPECT_LT(s.state.blocks[0].stored[Stored::elastic] + of_shear(s.state.blocks[0]),
            1e-6 * 0.5 * 1e6 * 1e-6 * 0.025);
}

TEST(Displace, NormalsOfAPlateFollowItsBending) {
  // w = x^2/2 kappa on a strip: bending energy E I kappa^2/2 per length and no shear
  Scene s;
  mesh::Mesh& mesh = s.model.mesh;
  const int cells = 10;
  mesh.X.resize(3, 2 * (cells + 1));
  Table<3> facets(3, 2 * cells);
  for (int i = 0; i <= cells; ++i) mesh.X.col(2 * i) = Vec3(0.1 * i, 0, 0), mesh.X.col(2 * i + 1) = Vec3(0.1 * i, 0.1, 0);
  for (int i = 0; i < cells; ++i) {
    facets.col(2 * i) << 2 * i, 2 * i + 2, 2 * i + 1;
    facets.col(2 * i + 1) << 2 * i + 2, 2 * i + 3, 2 * i + 1;
  }
  mesh.triangles.push_back({"strip", facets});
  element::Plate::Options options;
  options.thickness = 0.01;
  s.model.blocks.push_back(element::plates(mesh, "strip", material::Elastic{1000, 1e9, 0}, options));
  finalize(s.model);
  s.ready();
  const double kappa = 1e-4;
  Vectors u = Vectors::Zero(3, mesh.X.cols());
  std::vector<Mat3> gradient;
  for (Index n = 0; n < mesh.X.cols(); ++n) {
    const double x = mesh.X(0, n);
    u(2, n) = 0.5 * kappa * x * x;
  }
  for (const Index n : s.model.node_of_rotation) {
    Mat3 G = Mat3::Zero();
    G(2, 0) = kappa * mesh.X(0, n);
    gradient.push_back(G);
  }
  displace(s.model, s.state, u, gradient);
  const double exact = 0.5 * 1e9 * 0.1 * 1e-6 / 12 * kappa * kappa;
  std::printf("bent strip: elastic %.4f, shear %.1e of the beam's energy\n", s.state.blocks[0].stored[Stored::elastic] / exact,
              of_shear(s.state.blocks[0]) / exact);
  EXPECT_NEAR(s.state.blocks[0].stored[Stored::elastic] / exact, 1, 0.01);
  EXPECT_NEAR(of_shear(s.state.blocks[0]) / exact, 0, 0.01);
}

TEST(TurnsOf, ARigidRotationAreItsAngularVelocity) {
  const Scene s = tube();
  const Vec3 omega(3, -2, 5);
  Mat3 L;
  L << 0, -omega.z(), omega.y(), omega.z(), 0, -omega.x(), -omega.y(), omega.x(), 0;
  const Vectors w = angular_velocities_of(s.model, std::vector<Mat3>(s.model.node_of_rotation.size(), L));
  for (Eigen::Index rotation = 0; rotation < w.cols(); ++rotation) EXPECT_NEAR((w.col(rotation) - omega).norm(), 0, 1e-14);
}

TEST(TurnsOf, AStretchAlongAFlatPlateAreNone) {
  Scene s;
  s.model.mesh.X.resize(3, 3);
  s.model.mesh.X << 0, 1, 0.2, 0, 0.1, 0.8, 0, 0, 0;
  Table<3> nodes(3, 1);
  nodes << 0, 1, 2;
  s.model.mesh.triangles.push_back({"plate", nodes});
  element::Plate::Options options;
  options.thickness = 0.01;
  s.model.blocks.push_back(element::plates(s.model.mesh, "plate", material::Elastic{1000, 1e6, 0.3}, options));
  finalize(s.model);
  s.ready();
  Mat3 L = Mat3::Zero();
  L(0, 0) = 1, L(1, 1) = -2, L(2, 2) = 3;
  EXPECT_EQ(angular_velocities_of(s.model, std::vector<Mat3>(3, L)).norm(), 0);
}

}  // namespace
}  // namespace nereid::dynamics::displace_test
