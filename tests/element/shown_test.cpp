#include "element/shown.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/check.hpp"

namespace nereid::element::shown_test {
namespace {

Mat3 full(const Symmetric<double>& e) { return (Mat3() << e.xx, e.xy, e.xz, e.xy, e.yy, e.yz, e.xz, e.yz, e.zz).finished(); }
Mat3 rotation() { return Eigen::AngleAxisd(2.3, Vec3(1, -2, 0.5).normalized()).toRotationMatrix(); }

TEST(HenckyStrain, OfARotationIsZero) { EXPECT_LT(full(hencky_strain(rotation())).norm(), 1e-15); }

TEST(HenckyStrain, OfStretchesIsTheirLogarithm) {
  const Symmetric<double> e = hencky_strain(Mat3(Vec3(2, 0.5, 0.1).asDiagonal()));
  EXPECT_LT((full(e) - Mat3(Vec3(std::log(2), std::log(0.5), std::log(0.1)).asDiagonal())).norm(), 1e-14);
}

TEST(HenckyStrain, OfSimpleShearHasItsClosedForm) {
  // F F^T has the principal stretches l = g/2 + sqrt(1 + g^2/4) and 1/l, the larger one at the angle a with tan 2a = 2/g
  for (const double g : {1e-6, 0.1, 3.0}) {
    Mat2 F = Mat2::Identity();
    F(0, 1) = g;
    const Plane<double> e = hencky_strain(F);
    const double size = std::log(g / 2 + std::sqrt(1 + g * g / 4)), twice = std::atan2(2, g);
    EXPECT_NEAR(e.xy, size * std::sin(twice), 1e-14);
    EXPECT_NEAR(e.xx, size * std::cos(twice), 1e-14);
    EXPECT_NEAR(e.yy, -e.xx, 1e-14);
  }
  Mat3 small = Mat3::Identity();
  small(0, 1) = 2e-9;
  EXPECT_NEAR(hencky_strain(small).xy, 1e-9, 1e-16) << "a tensor component, half of the angle";
}

TEST(HenckyStrain, TurnsWithTheBodyAndNotWithItsReference) {
  const Mat3 F = (Mat3() << 1.2, 0.3, -0.1, 0, 0.8, 0.2, 0.1, 0, 1.1).finished(), Q = rotation(), e = full(hencky_strain(F));
  EXPECT_LT((full(hencky_strain(Mat3(Q * F))) - Q * e * Q.transpose()).norm(), 1e-14);
  EXPECT_LT((full(hencky_strain(Mat3(F * Q))) - e).norm(), 1e-14);
  EXPECT_NEAR(e.trace(), std::log(F.determinant()), 1e-14);
}

TEST(HenckyStrain, OfNoVolumeIsANumber) { EXPECT_TRUE(std::isfinite(hencky_strain(Mat3(Vec3(1, 1, 0).asDiagonal())).zz)); }

TEST(Shown, HasThePlaceInItsName) {
  EXPECT_EQ(name({"stress"}), "stress");
  EXPECT_EQ(name({"stress", Place::membrane}), "stress_membrane");
  EXPECT_EQ(place_of("bottom"), Place::bottom);
  EXPECT_EQ(place_of(""), Place::none);
  EXPECT_THROW(place_of("inside"), InternalError);
  EXPECT_TRUE(in_usual_frames({"stress", Place::top}) && in_usual_frames({"pressure"}) && in_usual_frames({"thickness"}));
  EXPECT_FALSE(in_usual_frames({"strain"}) || in_usual_frames({"stress", Place::middle}) || in_usual_frames({"pressure", Place::top}));
}

}  // namespace
}  // namespace nereid::element::shown_test
