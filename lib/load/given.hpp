#pragma once
// What a case gives as a function of place and time.

#include <functional>

namespace nereid::load {

/// A number over time [s]; asked for once per load and step.
using OverTime = std::function<double(double t)>;
/// A number over the reference positions [m] and time [s].
using OverSpace = std::function<double(double x, double y, double z, double t)>;

/// A value with its time counted from `start` [s]; off: zero. An empty one stays so.
inline OverTime in_stage(const OverTime& value, bool is_on, double start) {
  if (!value || (is_on && start == 0)) return value;
  if (!is_on) return [](double) { return 0.0; };
  return [value, start](double t) { return value(t - start); };
}
inline OverSpace in_stage(const OverSpace& value, bool is_on, double start) {
  if (!value || (is_on && start == 0)) return value;
  if (!is_on) return [](double, double, double, double) { return 0.0; };
  return [value, start](double x, double y, double z, double t) { return value(x, y, z, t - start); };
}

}  // namespace nereid::load
