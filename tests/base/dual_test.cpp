#include "base/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nereid::dual_test {
namespace {

/// A formula of two variables that uses every operation.
template <class T>
T formula(const T& x, const T& y) {
  T sum = x * y - x / y + root(x * x + T(3.0) * y) + -(y * y) / (T(1.0) + x);
  sum += x;
  return sum * select(x < y, x, y) + larger(x, y) - smaller(x * x, y);
}

TEST(Dual, DerivativesMatchDifferences) {
  for (const auto& [x, y] : {std::pair{0.7, 1.3}, {2.1, 0.4}, {0.2, 3.0}}) {
    const Dual<2> d = formula(Dual<2>::variable(x, 0), Dual<2>::variable(y, 1));
    const double h = 1e-5;
    EXPECT_DOUBLE_EQ(d.value, formula(x, y));
    EXPECT_NEAR(d.by[0], (formula(x + h, y) - formula(x - h, y)) / (2 * h), 1e-8);
    EXPECT_NEAR(d.by[1], (formula(x, y + h) - formula(x, y - h)) / (2 * h), 1e-8);
  }
}

TEST(Dual, ConstantsHaveNoDerivatives) {
  const Dual<3> c(2.0);
  for (const double by : c.by) EXPECT_EQ(by, 0.0);
}

TEST(Dual, VariableHasOneDerivative) {
  const auto x = Dual<3>::variable(2.0, 1);
  EXPECT_EQ(x.value, 2.0);
  EXPECT_EQ(x.by, (std::array<double, 3>{0.0, 1.0, 0.0}));
}

TEST(Dual, ComparesByValue) {
  const auto x = Dual<1>::variable(2.0, 0);
  EXPECT_TRUE(x > Dual<1>(1.0));
  EXPECT_FALSE(x < Dual<1>(2.0));
}

}  // namespace
}  // namespace nereid::dual_test
