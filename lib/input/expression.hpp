#pragma once
// Numbers that are written as texts: functions of place and time, read by muParser behind this door.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "input/section.hpp"
#include "input/table.hpp"
#include "input/units.hpp"

namespace nereid::input {

/// A number as a function of the reference position x, y, z [m] and of the time t [s].
///
/// Copies share their variables, so one expression is asked by one thread at a time.
using Expression = std::function<double(double x, double y, double z, double t)>;

/// What an expression may speak of, beside `pi` and muParser's functions.
struct Variables {
  bool place = false;  ///< x, y, z
  bool time = false;   ///< t
  bool volume = false; ///< v [m3], which takes the place of t
};
inline constexpr Variables of_time{.place = false, .time = true};
inline constexpr Variables of_place{.place = true, .time = false};
inline constexpr Variables of_both{.place = true, .time = true};
inline constexpr Variables of_volume{.volume = true};

/// What an expression is multiplied by to be in SI, and of what it is.
struct InUnit {
  double size = 1;
  Dimension dimension = dim::none;
};

/// The text of a file that an expression names; nothing, and why, where there is none.
using ReadFile = std::function<std::optional<std::string>(const std::string& name, std::string& why)>;

/// Reads a text such as "1e6 * min(1, t/1e-3)" or "2*table(\"slug.csv\", t - 1e-3)".
///
/// It is one value: no assignment, no list. What it gives may still be no finite number somewhere.
/// A table gives its values in the unit of the expression, and must be of its dimension; its argument is in SI, a time where the
/// expression may speak of it, or a length where it may speak of places.
std::variant<Expression, TextFault> parse_expression(const std::string& text, Variables, const InUnit& = {}, const ReadFile& = {});

/// The expression of a key in SI; zero after a fault. Faults point into the text.
Expression read_expression(const Section&, std::string_view key, Variables, const InUnit&);

/// Three expressions, as in `["0", "0", "-9.81"]`.
std::array<Expression, 3> read_expressions(const Section&, std::string_view key, Variables, const InUnit&);

/// The table that a key names, as in "steel.csv" or "steel.csv:slow"; nothing after a fault.
std::optional<Table> read_table(const Section&, std::string_view key, const std::string& name);

/// A number as a function of other numbers and of the time [s].
struct FormulaText {
  std::vector<std::string> inputs;  ///< those of the names that it speaks of, in their order
  std::function<double(const std::vector<double>& inputs, double t)> value;
};

/// Reads a text such as "push * tip / 2" that may speak of some names, of `t` and of `pi`.
std::variant<FormulaText, TextFault> parse_formula(const std::string& text, const std::vector<std::string>& names);

/// The formula of a key; zero after a fault.
FormulaText read_formula(const Section&, std::string_view key, const std::vector<std::string>& names);

}  // namespace nereid::input
