#include "base/dense.hpp"

#include <gtest/gtest.h>

namespace nereid::dense_test {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

MatrixXd symmetric(int rows, int seed) {
  MatrixXd A(rows, rows);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) A(i, j) = std::sin(seed + 1.7 * i * j + i + j);
  return A;
}

TEST(Dense, EigenpairsSolveTheirEquation) {
  const MatrixXd A = symmetric(7, 1);
  const Eigenpairs pairs = eigenpairs(A);
  EXPECT_LT((A * pairs.vectors - pairs.vectors * pairs.values.asDiagonal()).norm(), 1e-13);
  EXPECT_LT((pairs.vectors.transpose() * pairs.vectors - MatrixXd::Identity(7, 7)).norm(), 1e-13);
  for (int i = 1; i < 7; ++i) EXPECT_LE(pairs.values(i - 1), pairs.values(i));
  EXPECT_LT((eigenvalues(A) - pairs.values).norm(), 1e-13);
}

TEST(Dense, GeneralizedEigenvaluesMakeTheDifferenceSingular) {
  const MatrixXd A = symmetric(5, 1), C = symmetric(5, 2), B = C * C + MatrixXd::Identity(5, 5);
  for (const double value : eigenvalues(A, B)) EXPECT_LT(eigenvalues(A - value * B).cwiseAbs().minCoeff(), 1e-13);
}

TEST(Dense, PseudoInverseOfAMatrixWithoutFullRankHasItsFourProperties) {
  const MatrixXd A = (MatrixXd(3, 4) << 1, 2, 0, 0, 2, 4, 0, 0, 0, 0, 3, 0).finished(), P = pseudo_inverse(A);
  EXPECT_LT((A * P * A - A).norm(), 1e-14);
  EXPECT_LT((P * A * P - P).norm(), 1e-14);
  EXPECT_LT(((A * P).transpose() - A * P).norm(), 1e-14);
  EXPECT_LT(((P * A).transpose() - P * A).norm(), 1e-14);
}

}  // namespace
}  // namespace nereid::dense_test
