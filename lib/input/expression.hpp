#pragma once
// Numbers that are written as texts: functions of place and time, read by muParser behind this door.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "input/section.hpp"

namespace nereid::input {

/// A number as a function of the reference position x, y, z [m] and of the time t [s].
///
/// Copies share their variables, so one expression is asked by one thread at a time.
using Expression = std::function<double(double x, double y, double z, double t)>;

/// What an expression may speak of, beside `pi` and muParser's functions.
struct Variables {
  bool place = false;  ///< x, y, z
  bool time = false;   ///< t
};
inline constexpr Variables of_time{.place = false, .time = true};
inline constexpr Variables of_place{.place = true, .time = false};
inline constexpr Variables of_both{.place = true, .time = true};

/// Reads a text such as "1e6 * min(1, t/1e-3)".
///
/// It is one value: no assignment, no list. What it gives may still be no finite number somewhere.
std::variant<Expression, TextFault> parse_expression(const std::string& text, Variables);

/// The expression of a key, times `unit`; zero after a fault. Faults point into the text.
Expression read_expression(const Section&, std::string_view key, Variables, double unit = 1);

/// Three expressions, as in `["0", "0", "-9.81"]`.
std::array<Expression, 3> read_expressions(const Section&, std::string_view key, Variables, double unit = 1);

}  // namespace nereid::input
