#pragma once
// Which values are allowed, and how one says so.

#include <limits>
#include <string>

namespace nereid {

/// Which values are allowed, in SI units. Combine as in `above(-1).below(0.5)`.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool with_low = false, with_high = false;  ///< whether the ends belong to the range

  constexpr Range below(double end) const { return {low, end, with_low, false}; }
  constexpr Range up_to(double end) const { return {low, end, with_low, true}; }
  constexpr bool contains(double value) const {
    return (with_low ? value >= low : value > low) && (with_high ? value <= high : value < high);
  }
};

constexpr Range above(double end) { return Range{.low = end}; }
constexpr Range at_least(double end) { return Range{.low = end, .with_low = true}; }
constexpr Range below(double end) { return Range{.high = end}; }
constexpr Range up_to(double end) { return Range{.high = end, .with_high = true}; }
/// low < value < high
constexpr Range between(double low, double high) { return above(low).below(high); }
/// low <= value <= high
constexpr Range within(double low, double high) { return at_least(low).up_to(high); }

inline constexpr Range finite{};  ///< every number but nan and infinity, which are in no range without an end there
inline constexpr Range positive = above(0);
inline constexpr Range not_negative = at_least(0);

/// As in "0 < safety <= 10"; ends other than zero have the unit, which is "1" for pure numbers.
std::string words_of(const Range&, const std::string& name, const std::string& unit);

}  // namespace nereid
