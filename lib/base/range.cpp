#include "base/range.hpp"

#include <cmath>

#include "base/words.hpp"

namespace nereid {

std::string words_of(const Range& range, const std::string& name, const std::string& unit) {
  constexpr std::size_t longest = 10;  // letters: a bound that is computed has round-off behind them, another one on another machine
  const auto end = [&](double value) {
    const std::string text = shortest(value);
    return (text.size() > longest ? formatted("%.6g", value) : text) + (value == 0 || unit == "1" ? "" : " " + unit);
  };
  const bool from = std::isfinite(range.low), to = std::isfinite(range.high);
  const std::string after_low = range.with_low ? " <= " : " < ", before_high = range.with_high ? " <= " : " < ";
  if (from && to) return end(range.low) + after_low + name + before_high + end(range.high);
  if (from) return name + (range.with_low ? " >= " : " > ") + end(range.low);
  return to ? name + before_high + end(range.high) : "a finite number";
}

}  // namespace nereid
