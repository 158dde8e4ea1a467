#pragma once
// What a case gives as a function of place and time.

#include <functional>

namespace nereid::load {

/// A number over time [s]; asked for once per load and step.
using OverTime = std::function<double(double t)>;
/// A number over the reference positions [m] and time [s].
using OverSpace = std::function<double(double x, double y, double z, double t)>;

}  // namespace nereid::load
