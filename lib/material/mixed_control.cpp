#include "material/mixed_control.hpp"

#include <Eigen/LU>

#include "base/types.hpp"

namespace nereid::material {

std::array<double, 6> solved(const std::array<double, 36>& A, const std::array<double, 6>& b, int count) {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 6, 6>;
  const Square matrix = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(A.data()).topLeftCorner(count, count);
  std::array<double, 6> x{};
  Eigen::Map<Eigen::VectorXd>(x.data(), count) = matrix.fullPivLu().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), count));
  return x;
}

}  // namespace nereid::material
