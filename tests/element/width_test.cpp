#include "element/width.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/dense.hpp"
#include "mesh/box.hpp"
#include "mesh/placement.hpp"
#include "mesh/wedge.hpp"

namespace nereid::element::width_test {
namespace {

using material::Elastic;

const Elastic steel{7850, 2.1e11, 0.3};

constexpr auto springs = Hexahedron::Hourglass::stiffness;

AnyBlock solid(const mesh::Mesh& mesh, double hourglass = 0.1) {
  return hexahedra(mesh, "a", steel, {.hourglass = hourglass, .viscosity = {0, 0}, .hourglass_kind = springs});
}

AnyBlock usual(const mesh::Mesh& mesh) { return hexahedra(mesh, "a", steel, {.viscosity = {0, 0}}); }

AnyBlock full(const mesh::Mesh& mesh) { return solids(mesh, "a", steel, FullHexahedron::Options{.viscosity = {0, 0}}); }

Scalars masses(const AnyBlock& block, const mesh::Mesh& mesh) {
  Scalars mass = Scalars::Zero(mesh.X.cols());
  add_mass(block, mass);
  return mass;
}

/// Forces on the nodes after a displacement u from rest, small enough for its square not to show.
Vectors forces(const AnyBlock& block, const mesh::Mesh& mesh, const Vectors& u, BlockLimit* limit = nullptr) {
  Memory memory = initial_memory(block);
  TileForces here = tile_forces(block);
  TileReports reports = tile_reports(block);
  const Vectors x = mesh.X + u;
  const BlockLimit said = advance(block, x, u, Vectors::Zero(3, u.cols()), 1.0, memory, here, reports);
  if (limit != nullptr) *limit = said;
  Vectors force = Vectors::Zero(3, u.cols());
  for (std::size_t p = 0; p < tiling(block).node.size(); ++p) force.col(tiling(block).node[p]) += here.force.col(p);
  return force;
}

/// M^-1/2 K M^-1/2 of a block, column by column.
Eigen::MatrixXd scaled_stiffness(const AnyBlock& block, const mesh::Mesh& mesh) {
  const Index freedoms = static_cast<Index>(mesh.X.size());
  const double small = 1e-8 * mesh.X.cwiseAbs().maxCoeff();
  const Scalars mass = masses(block, mesh);
  Eigen::MatrixXd K(freedoms, freedoms);
  for (Index i = 0; i < freedoms; ++i) {
    Vectors u = Vectors::Zero(3, mesh.X.cols());
    u.data()[i] = small;
    const Vectors force = forces(block, mesh, u);
    for (Index j = 0; j < freedoms; ++j) K(j, i) = -force.data()[j] / small / std::sqrt(mass(i / 3) * mass(j / 3));
  }
  return 0.5 * (K + K.transpose());
}

/// Stable step 2/omega of a stiffness in the space of the columns of Q. [s]
double exact_step(const Eigen::MatrixXd& K, const Eigen::MatrixXd& Q) {
  const Eigen::MatrixXd reduced = Q.transpose() * K * Q;
  return 2 / std::sqrt(eigenvalues(reduced).maxCoeff());
}

/// Orthonormal columns for what the planes of a sector allow, all of them or only what is the same on both.
Eigen::MatrixXd allowed(const mesh::Mesh& mesh, double angle, bool only_even) {
  std::vector<Eigen::VectorXd> columns;
  const auto freedom = [&](Index node, const Vec3& direction) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(mesh.X.size());
    column.segment<3>(3 * node) = direction;
    return column;
  };
  const Subset first = mesh::node_set(mesh, "a.first_plane"), second = mesh::node_set(mesh, "a.second_plane");
  const Vec3 out_first = Vec3::UnitX(), out_second(std::cos(angle), std::sin(angle), 0);
  for (std::size_t n = 0; n < first.size(); ++n) {
    if (first[n] == second[n]) {
      columns.push_back(freedom(first[n], Vec3::UnitZ()));
      continue;
    }
    for (const auto& [one, other] : {std::pair(out_first, out_second), std::pair<Vec3, Vec3>(Vec3::UnitZ(), Vec3::UnitZ())}) {
      const Eigen::VectorXd a = freedom(first[n], one), b = freedom(second[n], other);
      columns.push_back((a + b) / std::sqrt(2.0));
      if (!only_even) columns.push_back((a - b) / std::sqrt(2.0));
    }
  }
  Eigen::MatrixXd Q(mesh.X.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) Q.col(static_cast<Eigen::Index>(c)) = columns[c];
  return Q;
}

// ------------------------------------------------------------------------------------------------
// Wedges at the axis: hexahedra with an edge of no length

TEST(WedgeAtTheAxis, HasItsExactVolumeAndAllOfItsMass) {
  for (const double angle : {0.01, 0.1, 0.5, 1.5}) {
    const mesh::Mesh mesh = mesh::wedge("a", {0.2, 0.3, angle, 1, 1, 1});
    const AnyBlock block = solid(mesh);
    const double exact = std::sin(angle) / 2 * 0.2 * 0.2 * 0.3 * steel.density;
    const Scalars mass = masses(block, mesh);
    EXPECT_NEAR(mass.sum() / exact, 1, 1e-14);  // round-off
    for (const Index node : mesh::node_set(mesh, "a"))  // an eighth at each corner, and two of them meet at the axis
      EXPECT_NEAR(mass(node) / exact, mesh.X.col(node).head<2>().norm() == 0 ? 0.25 : 0.125, 1e-14);
  }
}

TEST(WedgeAtTheAxis, PassesThePatchTestWithOnePointOrEight) {
  const mesh::Mesh mesh =
      mesh::moved(mesh::rotated_about(mesh::wedge("a", {0.2, 0.3, 0.7, 2, 3, 3}), Vec3(1, 2, 3), 0.4, Vec3::Zero()), Vec3(1, 0, 2));
  Mat3 H;
  H << 3, 1, -2, 4, -1, 5, 2, 2, 1;
  H *= 1e-9;
  const Vectors u = H * mesh.X;
  for (const AnyBlock& block : {solid(mesh), usual(mesh), full(mesh)}) {
    Memory memory = initial_memory(block);
    TileForces tiles = tile_forces(block);
    TileReports reports = tile_reports(block);
    advance(block, mesh.X + u, u, Vectors::Zero(3, u.cols()), 1.0, memory, tiles, reports);
    const auto [lambda, mu] = material::lame(steel);
    const Mat3 stress = lambda * H.trace() * Mat3::Identity() + mu * (H + H.transpose());
    const auto stresses = fields(block, mesh.X, mesh.X + u, memory)[0].values;
    Eigen::VectorXd expected(6);
    expected << stress(0, 0), stress(1, 1), stress(2, 2), stress(0, 1), stress(1, 2), stress(0, 2);
    for (Index e = 0; e < stresses.cols(); ++e)  // displacements of 1e-9 in a body of 1 leave seven digits
      EXPECT_LT((stresses.col(e) - expected).norm(), 1e-6 * expected.norm());
    if (!std::holds_alternative<Block<FullHexahedron, Elastic>>(block)) {
      EXPECT_LT(std::abs(memory.stored[Stored::hourglass]),
                1e-12 * memory.stored[Stored::elastic]);  // no hourglass energy, by the square of 1e-6
    }
    // inside, forces cancel; none of the nodes off the surface, the axis among them, feels any
    const Vectors force = forces(block, mesh, u);
    const double scale = force.cwiseAbs().maxCoeff();
    Subset outside;
    for (const auto& surface : mesh.surfaces) for (const Index n : mesh::surface_nodes(surface)) outside.push_back(n);
    for (const char* plane : {"a.first_plane", "a.second_plane"})
      for (const Index n : mesh::node_set(mesh, plane)) outside.push_back(n);
    int inside = 0;
    for (Index n = 0; n < mesh.X.cols(); ++n) {
      if (std::count(outside.begin(), outside.end(), n) > 0) continue;
      ++inside;
      EXPECT_LT(force.col(n).norm(), 1e-6 * scale);  // as the stresses
    }
    EXPECT_EQ(inside, 2 * 2);
  }
}

TEST(WedgeAtTheAxis, HasNoMotionWithoutEnergyButRigidOnesWithOnePointOrEight) {
  const mesh::Mesh mesh = mesh::wedge("a", {0.2, 0.2, 0.6, 1, 1, 1});
  for (const AnyBlock& block : {solid(mesh), usual(mesh), full(mesh)}) {
    const Eigen::MatrixXd K = scaled_stiffness(block, mesh);
    const Eigen::VectorXd values = eigenvalues(K);
    ASSERT_EQ(values.size(), 18);
    EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-6 * values.maxCoeff());  // differences of 1e-8 leave seven digits
    EXPECT_GT(values(6), 1e-4 * values.maxCoeff());
  }
}

TEST(RelativeSteps, AreTheVotesOfEachElementByItself) {
  mesh::Mesh mesh = mesh::box("a", {Vec3(0, 0, 0), Vec3(4, 1, 1), {4, 1, 1}});
  mesh.X.row(0) = mesh.X.row(0).array().square();  // cells of 1, 3, 5 and 7
  const auto check = [&mesh](const AnyBlock& whole, const auto& make) {
    const Scalars relative = relative_steps(whole, mesh.X);
    Scalars own(relative.size());
    for (Index e = 0; e < static_cast<Index>(own.size()); ++e) {
      mesh::Mesh alone;
      alone.X = mesh.X(Eigen::all, Eigen::VectorXi(nodes(whole).col(e)));
      alone.hexahedra = {{"a", Eigen::Matrix<Index, 8, 1>::LinSpaced(8, 0, 7)}};
      BlockLimit limit;
      forces(make(alone), alone, Vectors::Zero(3, 8), &limit);
      own(e) = limit.step;
    }
    for (Index e = 0; e < static_cast<Index>(own.size()); ++e)
      EXPECT_NEAR(relative(e), own(e) / own.minCoeff(), 0.07 * relative(e)) << e;  // bending is left out: 6 % of these
    EXPECT_GT(relative.maxCoeff(), 1.1);
  };
  check(usual(mesh), usual);
  check(full(mesh), full);
}

// ------------------------------------------------------------------------------------------------
// What the width of a sector costs

struct Steps {
  double limit, free, on_planes, even;  // [s] the block's vote, and exact ones: without planes, with, mirrored too
};

mesh::Mesh rings(double angle) { return mesh::wedge("a", {1.0, 0.25, angle, 1, 4, 1}); }

Steps steps(double angle, const AnyBlock& block) {
  const mesh::Mesh mesh = rings(angle);
  const Eigen::MatrixXd K = scaled_stiffness(block, mesh);
  BlockLimit limit;
  forces(block, mesh, Vectors::Zero(3, mesh.X.cols()), &limit);
  const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(K.rows(), K.cols());
  return {limit.step, exact_step(K, all), exact_step(K, allowed(mesh, angle, false)), exact_step(K, allowed(mesh, angle, true))};
}

constexpr double angles[] = {0.02, 0.05, 0.1, 0.2, 0.5, 1.0};
const double cell = 0.25 / material::wave_speed(steel);  // [s] a wave's way through a ring

void record(const char* name, double angle, double value) {
  ::testing::Test::RecordProperty(std::string(name) + "_at_" + std::to_string(angle), std::to_string(value));
}

Steps steps(double angle, double hourglass) { return steps(angle, solid(rings(angle), hourglass)); }

TEST(SectorWidth, VoteIsBelowEveryExactStep) {
  for (const double angle : angles) {
    const Steps s = steps(angle, 0.1);
    for (const auto& [name, step] : {std::pair("vote", s.limit), {"free", s.free}, {"planes", s.on_planes}, {"even", s.even}})
      record(name, angle, step / cell);
    EXPECT_LE(s.limit, s.free * 1.002);  // hourglass stiffness is not in the step limit: 0.2 % at most
    EXPECT_LE(s.free, s.on_planes * (1 + 1e-6));  // differences of 1e-8 leave seven digits
    EXPECT_LE(s.on_planes, s.even * (1 + 1e-6));
  }
}

TEST(SectorWidth, VoteOfEightPointsIsBelowEveryExactStepToo) {
  for (const double angle : angles) {
    const Steps s = steps(angle, full(rings(angle)));
    for (const auto& [name, step] :
         {std::pair("full_vote", s.limit), {"full_free", s.free}, {"full_planes", s.on_planes}, {"full_even", s.even}})
      record(name, angle, step / cell);
    EXPECT_LE(s.limit, s.free * (1 + 1e-6));  // differences of 1e-8 leave seven digits
  }
}

TEST(SectorWidth, VoteOfAssumedStrainsIsBelowEveryExactStepTooAndTheSectionIsNotStiffened) {
  for (const double angle : angles) {
    const Steps s = steps(angle, usual(rings(angle)));
    for (const auto& [name, step] :
         {std::pair("usual_vote", s.limit), {"usual_free", s.free}, {"usual_planes", s.on_planes}, {"usual_even", s.even}})
      record(name, angle, step / cell);
    EXPECT_LE(s.limit, s.free * (1 + 1e-6));
    EXPECT_GT(s.even / cell, 0.85);
  }
}

TEST(SectorWidth, PlanesHoldItsPressureWavesAndLeaveItsShearWaves) {
  const double ratio = material::wave_speed(steel) / std::sqrt(material::lame(steel).mu / steel.density);
  for (const double angle : {0.02, 0.05, 0.1}) {  // narrow enough for the width to govern both
    const Steps s = steps(angle, 0.1);
    EXPECT_NEAR(s.on_planes / s.free / ratio, 1, 0.01);  // second order in the angle
  }
}

TEST(SectorWidth, IsNotFeltByMotionThatIsTheSameOnBothPlanesButForHourglassStiffness) {
  for (const double angle : angles) EXPECT_NEAR(steps(angle, 1e-6).even / cell, 0.9, 1e-3);  // of rings, not of widths
  EXPECT_LT(steps(0.02, 0.1).even / cell, 0.2);  // its stiffness follows the narrowest width
}

TEST(SectorWidth, IsSaidWithWhatItCosts) {
  for (const double angle : {0.02, 0.05, 0.1, 0.2, 0.5}) {
    const mesh::Mesh mesh = rings(angle);
    const Narrowest at = narrowest(solid(mesh), mesh.X);
    record("gain", angle, at.gain);
    EXPECT_EQ(at.element, 0);
    EXPECT_NEAR(std::abs(at.direction.dot(mesh::second_plane_normal(angle / 2))), 1, 1e-12);  // across, by symmetry
    const double mean_width = 0.25 * std::sin(angle / 2);  // of a wedge, half that of its outer face
    EXPECT_NEAR(at.width(0) / mean_width, 1, 0.1);  // both edges at the axis count: 6 % at most
    // without it, the step of a cell of the rings' size
    EXPECT_NEAR(at.gain * angle / 2, 1, 0.35);
  }
}

TEST(Narrowest, FindsTheWidthsOfABrickAndItsPlace) {
  const mesh::Mesh mesh =
      mesh::rotated_about(mesh::box("a", {Vec3::Zero(), Vec3(1, 2, 0.1), {1, 1, 1}}), Vec3::UnitX(), pi / 2, Vec3::Zero());
  const Narrowest at = narrowest(solid(mesh), mesh.X);
  EXPECT_EQ(at.element, 0);
  EXPECT_LT((at.width - Vec3(0.1, 1, 2)).norm(), 1e-13);  // round-off
  EXPECT_NEAR(std::abs(at.direction.y()), 1, 1e-14);
  EXPECT_LT((at.centre - Vec3(0.5, -0.05, 1)).norm(), 1e-14);
}

TEST(Narrowest, GainsNothingWithACube) {
  const mesh::Mesh mesh = mesh::box("a", {Vec3::Zero(), Vec3(1, 1, 1), {1, 1, 1}});
  EXPECT_NEAR(narrowest(solid(mesh), mesh.X).gain, 1, 1e-12);
}

}  // namespace
}  // namespace nereid::element::width_test
