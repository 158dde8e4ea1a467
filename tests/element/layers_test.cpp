#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
#include "element/plate.hpp"

namespace nereid::element::layers_test {
namespace {

TEST(GaussLayers, IntegratePolynomialsOfDegreeTwiceTheirNumberLessOne) {
  for (int count = 1; count <= Plate::most_layers; ++count) {
    const Layers layers = gauss_layers(count);
    ASSERT_EQ(layers.count, count);
    for (int degree = 0; degree <= 2 * count - 1; ++degree) {
      double sum = 0;
      for (int l = 0; l < count; ++l) sum += layers.weight[l] * std::pow(2 * layers.z[l], degree);
      EXPECT_NEAR(sum, degree % 2 == 0 ? 1.0 / (degree + 1) : 0.0, 1e-15)
          << count << " layers, degree " << degree;
    }
    double beyond = 0;
    for (int l = 0; l < count; ++l)
      beyond += layers.weight[l] * std::pow(2 * layers.z[l], 2 * count);
    EXPECT_GT(std::abs(beyond - 1.0 / (2 * count + 1)), 1e-9) << "no rule of n points does better";
  }
}

TEST(GaussLayers, LieInsideAscendingAndSymmetricWithPositiveWeights) {
  for (int count = 1; count <= Plate::most_layers; ++count) {
    const Layers layers = gauss_layers(count);
    for (int l = 0; l < count; ++l) {
      EXPECT_GT(layers.weight[l], 0);
      EXPECT_LT(std::abs(layers.z[l]), 0.5);
      EXPECT_NEAR(layers.z[l], -layers.z[count - 1 - l], 1e-16);
      EXPECT_NEAR(layers.weight[l], layers.weight[count - 1 - l], 1e-15);
      if (l > 0) {
        EXPECT_GT(layers.z[l], layers.z[l - 1]);
      }
    }
  }
}

TEST(GaussLayers, OtherCountsAreRefused) {
  EXPECT_THROW(gauss_layers(0), InternalError);
  EXPECT_THROW(gauss_layers(10), InternalError);
}

}  // namespace
}  // namespace nereid::element::layers_test
