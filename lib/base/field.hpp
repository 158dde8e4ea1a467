#pragma once
#include <string>
#include <vector>

#include "base/types.hpp"

namespace nereid {

/// One array over nodes, elements or contact elements, as results files show it.
struct Field {
  std::string name;                     ///< letters, digits, underscore
  std::string unit;                     ///< "Pa", "m", "1" for a pure number
  std::vector<std::string> components;  ///< empty for a scalar
  Eigen::MatrixXd values;               ///< [components x things]
  bool integer = false;                 ///< numbers of things, flags and kinds
};

}  // namespace nereid
