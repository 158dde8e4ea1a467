#pragma once
// Decompositions of dense matrices for what is not done in every step. They are compiled once, here: a compiler takes seconds for each.

#include "base/types.hpp"

namespace nereid {

/// Eigenvalues, ascending, and orthonormal eigenvectors, one per column.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Of a symmetric matrix; its lower half is read.
Eigenpairs eigenpairs(const Eigen::MatrixXd& symmetric);
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

/// Of A x = lambda B x, ascending, for a symmetric A and a symmetric positive definite B.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// The Moore-Penrose inverse; the rank counts pivots above round-off of the largest one.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd&);

}  // namespace nereid
