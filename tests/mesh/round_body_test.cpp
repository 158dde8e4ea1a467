#include "mesh/round_body.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mesh/skin.hpp"

namespace nereid::mesh::round_body_test {
namespace {

Subset all_nodes(const Mesh& mesh) {
  Subset nodes;
  for (Eigen::Index i = 0; i < mesh.X.cols(); ++i) nodes.push_back(static_cast<Index>(i));
  return nodes;
}

/// The largest distance of a node of the skin of solids from the shape.
double off_shape(const Mesh& mesh, const geometry::Round& shape, const geometry::PlacedRound& at) {
  double most = 0;
  for (const Index node : surface_nodes({"", skin(mesh.X, mesh.hexahedra).facets}))
    most = std::max(most, std::abs(geometry::over_round(shape, at, mesh.X.col(node)).distance));
  return most;
}

TEST(RoundBody, AllNodesOfTheSkinOfWholeMeshesLieOnTheirShape) {
  const Sphere ball{.radius = 0.3, .part = SpherePart::full, .cells_core = 2, .cells_ring = 2};
  EXPECT_LT(off_shape(sphere("a", ball), *round_of(ball), {.centre = centre_of(ball)}), 1e-15);
  const Cylinder bar{.radius = 0.3, .length = 0.8, .turn = Revolution::full, .cells_core = 2, .cells_ring = 2, .cells_along = 3};
  EXPECT_LT(off_shape(cylinder("a", bar), *round_of(bar), {.centre = centre_of(bar)}), 1e-15);
  for (const double low : {-0.3, 0.0, 0.1}) {
    const Revolved ring{.radii = {0.2, 0.3}, .heights = {low, low + 0.4}, .cells_radial = {2}, .cells_along = {2}, .filled = {"x"},
                        .angle = 2 * pi, .cells_around = 12};
    EXPECT_LT(off_shape(revolved("a", ring), *round_of(ring), {.centre = centre_of(ring)}), 1e-15) << low;
  }
  const Tube pipe{.radius = 0.3, .length = 0.8, .turn = Revolution::full, .cells_core = 2, .cells_along = 3};
  const Mesh plates = tube("a", pipe);
  for (Eigen::Index i = 0; i < plates.X.cols(); ++i)
    EXPECT_NEAR(geometry::over_round(*round_of(pipe, 0.02), {.centre = centre_of(pipe)}, plates.X.col(i)).distance, -0.01, 1e-15);
}

TEST(RoundBody, PartsOfShapesHaveNone) {
  EXPECT_FALSE(round_of(Sphere{.radius = 1, .part = SpherePart::half, .cells_core = 1, .cells_ring = 1}));
  EXPECT_FALSE(round_of(Cylinder{.radius = 1, .length = 1, .turn = Revolution::quarter, .cells_core = 1, .cells_ring = 1,
                                 .cells_along = 1}));
  EXPECT_FALSE(round_of(Tube{.radius = 1, .length = 1, .turn = Revolution::quarter, .cells_core = 1, .cells_along = 1}, 0.1));
  EXPECT_FALSE(round_of(Revolved{.radii = {0.2, 0.3}, .heights = {0.1, 0.5}, .cells_radial = {1}, .cells_along = {2}, .filled = {"x"},
                                 .angle = pi, .cells_around = 6}));
}

TEST(RoundBody, GoesWithItsNodesAndItsWeightsAreThoseOfPointsAndForces) {
  const Cylinder bar{.radius = 0.3, .length = 0.8, .turn = Revolution::full, .cells_core = 2, .cells_ring = 2, .cells_along = 3};
  const Mesh mesh = cylinder("a", bar);
  const RoundBody body = tied(*round_of(bar), {.centre = centre_of(bar)}, mesh.X, all_nodes(mesh));
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(3, 1, 2).normalized()).toRotationMatrix();
  const Vec3 way(5, -3, 2);
  const Vectors x = (turn * mesh.X).colwise() + way;
  const geometry::PlacedRound at = placed(body, x);
  EXPECT_LT((at.centre - (turn * centre_of(bar) + way)).norm(), 1e-14);
  EXPECT_LT((at.axis - turn.col(2)).norm(), 1e-14);
  EXPECT_LT((at.across - turn.col(0)).norm(), 1e-14);
  const Vec3 point = at.centre + Vec3(0.4, -0.1, 0.7), force(2, -1, 3);
  const Eigen::Vector4d weight = weights_at(body, at, point);
  Vec3 place = Vec3::Zero(), moment = Vec3::Zero();
  for (int k = 0; k < 4; ++k) {
    const Vec3 node = x.col(body.anchor[static_cast<std::size_t>(k)]);
    place += weight(k) * node, moment += node.cross(weight(k) * force);
  }
  EXPECT_NEAR(weight.sum(), 1, 1e-14);
  EXPECT_LT((place - point).norm(), 1e-14);
  EXPECT_LT((moment - point.cross(force)).norm(), 1e-13);
}

}  // namespace
}  // namespace nereid::mesh::round_body_test
