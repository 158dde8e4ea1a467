#pragma once
// Tables: functions given by points, as measured.

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "input/units.hpp"

namespace nereid::input {

/// A function of one number: linear between its points, and outside them as at the nearer end.
struct Table {
  Dimension of_argument, of_value;
  std::vector<double> argument, value;  ///< in SI, ascending arguments, at least one
};

/// Reads a table from the text of a CSV file:
///
///     time [ms], pressure [MPa]
///     0, 0
///     0.1, 45
///
/// column  the name of the second column, where there are more than two; else empty
/// returns the table, or what is wrong, with the line
/// Blank lines and those that begin with # count for nothing. A column without a unit is a plain number.
std::variant<Table, std::string> parse_table(std::string_view text, std::string_view column = {});

double value_at(const Table&, double argument);

}  // namespace nereid::input
