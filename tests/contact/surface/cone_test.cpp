#include "contact/surface/cone.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mesh/adjacency.hpp"
#include "tests/contact/pressed.hpp"

namespace nereid::contact::cone_test {
namespace {

using namespace pressed;

Index node_at(const Shape& shape, const Vec3& place) {
  Eigen::Index nearest = 0;
  (shape.x.colwise() - place).colwise().squaredNorm().minCoeff(&nearest);
  return static_cast<Index>(nearest);
}

struct Own {
  Shape shape;
  Fans fans;
};
Own own_of(Shape shape) {
  const auto nodes = static_cast<Index>(shape.x.cols());
  Fans own = fans(shape.facets, nodes);
  return {std::move(shape), std::move(own)};
}

double behind(const Own& own, const Vec3& place, const Vec3& n) {
  return reach_behind(own.fans, own.shape.x, node_at(own.shape, place), n.normalized());
}
bool pushes(const Own& own, const Vec3& place, const Vec3& n, double most = behind_in_two_directions, const Mat3* allowed = nullptr) {
  return may_push(own.fans, own.shape.x, node_at(own.shape, place), n.normalized(), most, allowed);
}

TEST(ReachBehind, OfAFlatSurfaceIsTheSineOfItsTiltWhateverTheAxes) {
  Own own = own_of(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}));
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).matrix();
  for (const double tilt : {0.0, 0.1, 0.5, 1.0, 0.5 * M_PI})
    for (const double around : {0.0, 0.7, 2.0, 4.5}) {  // along edges and inside of facets
      const Vec3 n(std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), -std::cos(tilt)), place(2, 2, 1);
      EXPECT_NEAR(behind(own, place, n), std::sin(tilt), 1e-14);
      Own turned = own;
      turned.shape.x = turn * own.shape.x;
      EXPECT_NEAR(reach_behind(turned.fans, turned.shape.x, node_at(own.shape, place), turn * n), std::sin(tilt), 1e-14);
    }
}

TEST(ReachBehind, OnARidgeIsZeroInItsFanAndOnACornerInItsCone) {
  const Own own = own_of(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}));
  const Vec3 ridge(0, 2, 1), corner(0, 0, 1);
  for (const double angle : {0.0, 0.3, 0.8, 0.5 * M_PI})  // from the top to the side
    EXPECT_LT(behind(own, ridge, {std::sin(angle), 0, -std::cos(angle)}), 1e-15) << angle;
  EXPECT_NEAR(behind(own, ridge, {0, 1, 0}), 1, 1e-15) << "along the ridge";
  EXPECT_NEAR(behind(own, ridge, {0, 1, -1}), std::sqrt(0.5), 1e-15);
  EXPECT_LT(behind(own, corner, {1, 1, -1}), 0);
  EXPECT_NEAR(behind(own, corner, {-1, 0, -1}), std::sqrt(0.5), 1e-15);
}

TEST(MayPush, NeverPushesANodeAlongItsFlatSurfaceNorOutOfItsBody) {
  const Own own = own_of(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}));
  const Vec3 place(2, 2, 1);  // what touches the top pushes down
  for (const double most : {behind_in_two_directions, behind_in_one_direction}) {
    EXPECT_TRUE(pushes(own, place, {0, 0, -1}, most));
    EXPECT_FALSE(pushes(own, place, {1, 0, 0}, most));
    EXPECT_FALSE(pushes(own, place, {0, 0, 1}, most)) << "from inside";
    EXPECT_TRUE(pushes(own, place, {std::sin(0.5), 0, -std::cos(0.5)}, most)) << "a bevel of 29 degrees";
    EXPECT_EQ(pushes(own, place, {1, 0, -1}, most), most > 0.9) << "the bisector of a ridge";
    EXPECT_EQ(pushes(own, place, {1, 1, -1}, most), most > 0.9) << "that of a corner";
  }
  EXPECT_TRUE(pushes(own, {0, 2, 1}, {1, 0, 0})) << "a ridge is pushed at its side";
  EXPECT_TRUE(pushes({own.shape, {}}, place, {1, 0, 0})) << "without facets all normals are admissible";
}

TEST(MayPush, PushesAPlateFromBothSidesAndItsRimFromOutsideToo) {
  Shape shape = sheet(4, 4, flat);
  shape.facets = mesh::both_sides(shape.facets);
  Own own = own_of(shape);
  // the other sides, as base_surface() finds them
  const auto half = static_cast<Index>(own.shape.facets.cols()) / 2;
  own.fans.other_side.assign(static_cast<std::size_t>(2 * half), -1);
  for (Index f = 0; f < 2 * half; ++f)
    for (Index g = 0; g < 2 * half; ++g) {
      auto one = own.shape.facets.col(f).eval(), other = own.shape.facets.col(g).eval();
      std::sort(one.data(), one.data() + 3), std::sort(other.data(), other.data() + 3);
      if (f != g && one == other) own.fans.other_side[static_cast<std::size_t>(f)] = g;
    }
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(pushes(own, {2, 2, 0}, {0, 0, side}));
    EXPECT_TRUE(pushes(own, {4, 2, 0}, {0, 0, side}));
  }
  EXPECT_FALSE(pushes(own, {2, 2, 0}, {1, 0, 0}));
  EXPECT_TRUE(pushes(own, {4, 2, 0}, {-1, 0, 0})) << "from outside of the rim";
  EXPECT_FALSE(pushes(own, {4, 2, 0}, {1, 0, 0})) << "from within the plate";
  EXPECT_FALSE(pushes(own, {4, 2, 0}, {0, 1, 0})) << "along the rim";
}

TEST(MayPush, OnASymmetryPlaneGoesByThePartInThePlane) {
  const Own own = own_of(block({0, 0, 0}, {4, 4, 1}, {4, 4, 1}));
  const Mat3 allowed = Vec3(1, 0, 1).asDiagonal();  // the plane y = 2
  EXPECT_FALSE(pushes(own, {2, 2, 1}, {0, 0.9, -0.43}));
  EXPECT_TRUE(pushes(own, {2, 2, 1}, {0, 0.9, -0.43}, behind_in_two_directions, &allowed)) << "the image takes what leads out of the plane";
  EXPECT_FALSE(pushes(own, {2, 2, 1}, {0.9, 0.1, -0.4}, behind_in_two_directions, &allowed));
}

}  // namespace
}  // namespace nereid::contact::cone_test
