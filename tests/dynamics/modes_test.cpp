#include "dynamics/modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/dense.hpp"
#include "mesh/box.hpp"
#include "mesh/disc.hpp"
#include "mesh/placement.hpp"
#include "mesh/sphere.hpp"

namespace nereid::dynamics::modes_test {
namespace {

using load::PlaneKind;
using material::Elastic;

const Elastic steel{7850, 2.1e11, 0.3};
const element::Viscosity none{0, 0};

Model solid(const mesh::Mesh& mesh, const Elastic& law, bool full = false) {
  Model model;
  model.mesh = mesh;
  element::AnyHexahedronOptions options = element::Hexahedron::Options{
      .hourglass = element::Hexahedron::usual_stiffness, .viscosity = none, .hourglass_kind = element::Hexahedron::Hourglass::stiffness};
  if (full) options = element::FullHexahedron::Options{.viscosity = none};
  model.blocks.push_back(element::solids(mesh, "a", law, options));
  return model;
}

Model box(const Vec3& size, const Eigen::Vector3i& cells, const Elastic& law, bool full = false) {
  return solid(mesh::box("a", {Vec3::Zero(), size, cells}), law, full);
}

Model sheet(double side, int cells, double thickness, double angle = 0, double drilling = element::Plate::Options{}.drilling) {
  Model model;
  model.mesh = mesh::sheet("a", {.length = side, .width = side, .cells_along = cells, .cells_across = cells, .cuts = mesh::Cuts::crossed});
  if (angle != 0) model.mesh = mesh::rotated_about(std::move(model.mesh), Vec3(1, 2, 3).normalized(), angle, Vec3::Zero());
  const element::Plate::Options options{.thickness = thickness, .layers = 2, .rotary_inertia = element::Plate::RotaryInertia::physical,
                                        .viscosity = none, .drilling = drilling};
  model.blocks.push_back(element::plates(model.mesh, "a", steel, options));
  return model;
}

void hold(Model& model, const std::string& set, PlaneKind kind, const Vec3& normal) {
  load::Plane plane;
  plane.name = set + std::to_string(model.constraints.planes.size());
  plane.kind = kind, plane.normal = normal, plane.nodes = mesh::node_set(model.mesh, set);
  model.constraints.planes.push_back(plane);
}

double omega(const Mode& mode) { return 2 * pi * mode.frequency; }

/// u^T M u of a mode.
double mass_of(const Model& model, const Mode& mode) {
  double sum = 0;
  for (Eigen::Index n = 0; n < mode.shape.cols(); ++n) sum += model.mass(n) * mode.shape.col(n).squaredNorm();
  for (Eigen::Index n = 0; n < mode.rotations.cols(); ++n) sum += model.inertia(n) * mode.rotations.col(n).squaredNorm();
  return sum;
}

TEST(Modes, OfABarAreThoseOfAChain) {
  const int cells = 6;
  const double h = 0.5, c = std::sqrt(steel.young / steel.density);
  Model model = box({cells * h, 0.1, 0.1}, {cells, 1, 1}, {7850, 2.1e11, 0});
  hold(model, "a.x_low", PlaneKind::fixed, Vec3::UnitX());
  hold(model, "a", PlaneKind::constrained, Vec3::UnitY());
  hold(model, "a", PlaneKind::constrained, Vec3::UnitZ());
  finalize(model);
  const Modes modes = find_modes(model, 3, 1);
  ASSERT_EQ(modes.lowest.size(), 3U);
  EXPECT_EQ(modes.freedoms, 4 * cells);
  EXPECT_EQ(modes.without_stiffness, 0);
  for (int k = 0; k < 3; ++k)  // a chain of masses and springs, half a mass at its free end
    EXPECT_NEAR(omega(modes.lowest[k]) / (2 * c / h * std::sin((2 * k + 1) * pi / (4 * cells))), 1, 1e-10);
}

TEST(Modes, OfAFreeBrickHaveTheHighestInClosedForm) {
  for (const Vec3& h : {Vec3(0.1, 0.1, 0.1), Vec3(0.1, 0.2, 0.5), Vec3(0.3, 0.05, 0.07)})
    for (const double poisson : {0.0, 0.3, 0.49})
      for (const bool full : {false, true}) {
        Model model = box(h, {1, 1, 1}, {7850, 2.1e11, poisson}, full);
        finalize(model);
        const auto lame = material::lame(Elastic{7850, 2.1e11, poisson});
        Mat3 M;
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) M(i, j) = 4 * (lame.lambda + (i == j ? 2 * lame.mu : 0)) / (7850 * h(i) * h(j));
        const Modes modes = find_modes(model, 10, 1);
        const double exact = std::sqrt(eigenvalues(M)(2));
        EXPECT_NEAR(omega(modes.highest[0]) / exact, 1, 1e-10) << h.transpose() << " " << poisson << " " << full;
        EXPECT_NEAR(modes.exact_step * exact / 2, 1, 1e-10);
        EXPECT_LE(modes.voted_step, modes.exact_step * (1 + 1e-9));
        EXPECT_EQ(modes.without_stiffness, 6);
      }
}

TEST(Modes, OfWhatIsBeyondNumbersAreToldAndOfTheLastOnesFound) {
  const auto modes_of = [](double density, double young) {
    Model model = box({1, 1, 1}, {3, 3, 3}, {density, young, steel.poisson});
    finalize(model);
    return find_modes(model, 8, 2);
  };
  const double soft = 1e-280, light = 1e-150;
  const Modes usual = modes_of(steel.density, steel.young), of_soft = modes_of(steel.density, soft * steel.young);
  const Modes of_light = modes_of(light * steel.density, steel.young), beyond = modes_of(1e-300, steel.young);
  for (std::size_t i : {6, 7}) {
    EXPECT_NEAR(of_soft.lowest.at(i).frequency / std::sqrt(soft) / usual.lowest.at(i).frequency, 1, 1e-9);
    EXPECT_NEAR(of_light.lowest.at(i).frequency * std::sqrt(light) / usual.lowest.at(i).frequency, 1, 1e-9);
  }
  EXPECT_TRUE(usual.finite && of_soft.finite && of_light.finite);
  EXPECT_FALSE(beyond.finite);
  EXPECT_TRUE(beyond.lowest.empty() && beyond.highest.empty());
  EXPECT_FALSE(modes_of(steel.density, 1e-311).finite);  // of whose digits hardly any are left: iterations would not end
}

TEST(Modes, HaveASymmetricStiffness) {
  Model ball = solid(mesh::sphere("a", {.radius = 1, .part = mesh::SpherePart::full, .cells_core = 2, .cells_ring = 1}), steel);
  finalize(ball);
  EXPECT_LT(find_modes(ball, 1, 1).asymmetry, 1e-12);
  Model plate = sheet(1, 3, 0.05, 0.7);
  finalize(plate);
  EXPECT_LT(find_modes(plate, 1, 1).asymmetry, 1e-12);
}

TEST(Modes, OfAFreeSolidBeginWithSixRigidOnes) {
  Model model = solid(mesh::sphere("a", {.radius = 1, .part = mesh::SpherePart::full, .cells_core = 2, .cells_ring = 2}), steel, true);
  finalize(model);
  const Modes modes = find_modes(model, 8, 1);  // so many freedoms that the matrix stays sparse
  EXPECT_GT(modes.freedoms, 300);
  EXPECT_TRUE(modes.complete);
  EXPECT_EQ(modes.without_stiffness, 6);
  EXPECT_GT(modes.lowest[6].frequency, 100);
  for (const Mode& mode : modes.lowest) EXPECT_NEAR(mass_of(model, mode), 1, 1e-9);
}

TEST(Modes, OfAPlateLeaveOutTurnsAboutItsNormal) {
  for (const double angle : {0.0, 0.7}) {
    Model model = sheet(1, 8, 0.01, angle, 0);
    finalize(model);
    const Modes modes = find_modes(model, 12, 1);
    const Eigen::Index nodes = model.mesh.X.cols();
    EXPECT_EQ(modes.drilling, nodes);
    EXPECT_EQ(modes.freedoms, 5 * nodes);
    EXPECT_EQ(modes.without_stiffness, 6);
    EXPECT_TRUE(modes.complete);
    for (const Mode& mode : modes.lowest) {
      EXPECT_LT(mode.residual, 1e-8);
      EXPECT_NEAR(mass_of(model, mode), 1, 1e-9);
    }
  }
}

TEST(Modes, OfAPlateThatResistsDrillingHaveAllTurnsAndTheSameLowFrequencies) {
  Model with = sheet(1, 8, 0.01), without = sheet(1, 8, 0.01, 0, 0);
  finalize(with), finalize(without);
  const Modes some = find_modes(with, 12, 1), others = find_modes(without, 12, 1);
  EXPECT_EQ(some.drilling, 0);
  EXPECT_EQ(some.freedoms, 6 * with.mesh.X.cols());
  EXPECT_EQ(some.without_stiffness, 6);
  for (std::size_t i = 6; i < 12; ++i) EXPECT_NEAR(some.lowest[i].frequency, others.lowest[i].frequency, 1e-6 * others.lowest[i].frequency);
}

TEST(Modes, ComeInPairsWhereTheShapeIsSymmetric) {
  Model model = sheet(1, 8, 0.01);
  for (const char* edge : {"a.x_low", "a.x_high", "a.y_low", "a.y_high"}) hold(model, edge, PlaneKind::constrained, Vec3::UnitZ());
  hold(model, "a", PlaneKind::constrained, Vec3::UnitX()), hold(model, "a", PlaneKind::constrained, Vec3::UnitY());
  finalize(model);
  const Modes modes = find_modes(model, 6, 2);  // waves 1 and 2; 1 and 3 are of one symmetry and may part
  EXPECT_TRUE(modes.complete);
  EXPECT_EQ(modes.without_stiffness, 0);
  EXPECT_NEAR(modes.lowest[2].frequency / modes.lowest[1].frequency, 1, 1e-9);
  EXPECT_GT(modes.lowest[3].frequency / modes.lowest[2].frequency, 1.1);
  EXPECT_GE(modes.highest[0].frequency, modes.highest[1].frequency);
}

TEST(Modes, OfAHalfAreAmongThoseOfTheWhole) {
  Model whole = box({2, 0.4, 0.3}, {8, 2, 2}, steel, true), half = box({1, 0.4, 0.3}, {4, 2, 2}, steel, true);
  hold(half, "a.x_high", PlaneKind::symmetry, Vec3::UnitX());
  finalize(whole), finalize(half);
  const Modes all = find_modes(whole, 12, 1), some = find_modes(half, 6, 1);
  EXPECT_EQ(some.without_stiffness, 3);  // two shifts and the rotation about the normal
  double nearest = 1e300;
  for (const Mode& mode : all.lowest) nearest = std::min(nearest, std::abs(mode.frequency / some.lowest[3].frequency - 1));
  EXPECT_LT(nearest, 1e-8);
}

TEST(Modes, SeeSpringsAndPointMasses) {
  Model model = box({0.1, 0.1, 0.1}, {1, 1, 1}, steel);
  model.point_masses.push_back({"m", mesh::node_set(model.mesh, "a"), 20});
  finalize(model);
  hold(model, "a", PlaneKind::constrained, Vec3::UnitX()), hold(model, "a", PlaneKind::constrained, Vec3::UnitY());
  const double k = 1000;
  for (Index node = 0; node < 8; ++node)
    model.loads.emplace_back(load::spring_to_point("s" + std::to_string(node), model.mesh.X, node,
                                                   model.mesh.X.col(node) + Vec3(0, 0, 1), k / 8, 0));
  const Modes modes = find_modes(model, 1, 1);
  EXPECT_NEAR(omega(modes.lowest[0]) / std::sqrt(k / (20 + 7.850)), 1, 1e-6);
}

TEST(Modes, OfTwoBodiesOnASpringAreOneOfTheirReducedMassAndARigidMotion) {
  const double k = 1000;
  for (const bool second_first : {false, true}) {
    Model model = box({0.1, 0.1, 0.1}, {1, 1, 1}, steel);
    model.mesh = mesh::join(model.mesh, mesh::box("b", {Vec3(0, 0, 0.3), Vec3(0.1, 0.1, 0.5), {1, 1, 1}}));
    model.blocks.push_back(element::hexahedra(model.mesh, "b", steel, {.viscosity = none}));
    finalize(model);
    for (const char* body : {"a", "b"})
      for (const Vec3& normal : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) hold(model, body, PlaneKind::constrained, normal);
    const Subset &low = mesh::node_set(model.mesh, "a.z_high"), &high = mesh::node_set(model.mesh, "b.z_low");
    for (std::size_t i = 0; i < 4; ++i) {
      const Index from = second_first ? high[i] : low[i], to = second_first ? low[i] : high[i];
      model.loads.emplace_back(load::spring_between("s" + std::to_string(i), model.mesh.X, from, to, k / 4, 0));
    }
    const double a = model.mass.head(8).sum(), b = model.mass.tail(8).sum();
    const Modes modes = find_modes(model, 2, 1);
    EXPECT_EQ(modes.without_stiffness, 1);
    EXPECT_LT(modes.asymmetry, 1e-9);
    EXPECT_NEAR(omega(modes.lowest[1]) / std::sqrt(k * (1 / a + 1 / b)), 1, 1e-4);
  }
}

TEST(Modes, ForgetDashpotsAndViscosity) {
  Model still = sheet(1, 3, 0.05), viscous = sheet(1, 3, 0.05);
  viscous.blocks.clear();
  viscous.blocks.push_back(element::plates(viscous.mesh, "a", steel, {.thickness = 0.05, .layers = 2,
                                           .rotary_inertia = element::Plate::RotaryInertia::physical, .viscosity = {1, 10}}));
  finalize(still), finalize(viscous);
  const Modes a = find_modes(still, 8, 1), b = find_modes(viscous, 8, 1);
  EXPECT_NEAR(a.lowest[7].frequency / b.lowest[7].frequency, 1, 1e-10);
  EXPECT_NEAR(a.exact_step / b.exact_step, 1, 1e-10);
  EXPECT_LT(b.voted_step, a.voted_step);
}

}  // namespace
}  // namespace nereid::dynamics::modes_test
