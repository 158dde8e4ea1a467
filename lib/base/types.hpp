#pragma once
// The one vocabulary of arrays: [components x things], one column per thing, column-major.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

namespace nereid {

using Index = std::int32_t;  ///< the variable's name says of what
using Vec3 = Eigen::Vector3d;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
using Scalars = Eigen::VectorXd;                            ///< [things]
using Vectors = Eigen::Matrix<double, 3, Eigen::Dynamic>;   ///< [3 x things]
template <int rows>
using Table = Eigen::Matrix<Index, rows, Eigen::Dynamic>;   ///< [rows x things]
using Subset = std::vector<Index>;                          ///< node or element numbers, ascending

constexpr double pi = 3.14159265358979323846;
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace nereid
