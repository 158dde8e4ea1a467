#pragma once
// What a case was understood to say: written by the reader of cases, read by the writer of summaries.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace nereid {

/// One value of a case as the program understood it.
struct Resolved {
  using Value = std::variant<double, std::int64_t, bool, std::string, std::vector<double>,
                             std::vector<std::string>>;

  std::string path;  ///< as in "bodies[0].material.young"; indices count from 0
  Value value;       ///< in SI units
  std::string unit;  ///< of the value, "1" for a plain number, empty for words and flags
  bool is_default;   ///< the case did not say it
};

}  // namespace nereid
