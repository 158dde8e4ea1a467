#include "base/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nereid {

namespace {

constexpr double formal_order = 1.5;                 // no error is taken to fall faster, whatever three meshes show: docs/accuracy.md
constexpr double least_order = 0.5, most_order = 3;  // outside, these meshes are not fine enough to tell
constexpr double of_index = 1.25, of_two = 3, of_spread = 3;  // Roache's factors: with an order, of two meshes, without an order
constexpr double uneven = 0.02;                      // [-] of a count: rounding moves it no farther
constexpr double parts = 6, finest = 64;
constexpr double wider = 1.5, least_step = 1.2, most_step = 2;  // [-] between neighbouring levels

/// The order through three levels, by bisection of a ratio that rises with it; NaN where there is none.
double observed_order(const Level& coarse, const Level& middle, const Level& fine) {
  const double ratio = (coarse.value - middle.value) / (middle.value - fine.value);
  const auto right = [&](double p) {
    const double h1 = std::pow(fine.refine, -p), h2 = std::pow(middle.refine, -p), h3 = std::pow(coarse.refine, -p);
    return (h3 - h2) / (h2 - h1);
  };
  double low = least_order, high = most_order;
  if (!(ratio >= right(low) && ratio <= right(high))) return std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 60; ++i) {
    const double p = (low + high) / 2;
    (right(p) < ratio ? low : high) = p;
  }
  return (low + high) / 2;
}

/// The first even factor from `least` on, or 0.
double at_least_of(const std::vector<double>& even, double least) {
  const auto found = std::lower_bound(even.begin(), even.end(), least * (1 - 1e-9));
  return found == even.end() ? 0 : *found;
}

}  // namespace

MeshError mesh_error(const std::vector<Level>& levels) {
  const std::size_t n = levels.size();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (n < 2) return {std::numeric_limits<double>::infinity(), none};
  if (n < 3) return {of_two * std::abs(levels[0].value - levels[1].value) / (levels[1].refine / levels[0].refine - 1), none};
  const Level &coarse = levels[n - 3], &middle = levels[n - 2], &fine = levels[n - 1];
  const double order = observed_order(coarse, middle, fine);
  if (std::isnan(order)) {
    const auto [low, high] = std::minmax({coarse.value, middle.value, fine.value});
    return {of_spread * (high - low), order};
  }
  const double used = std::min(order, formal_order);
  return {of_index * std::abs(middle.value - fine.value) / (std::pow(fine.refine / middle.refine, used) - 1), order};
}

std::vector<double> even_factors(const std::vector<int>& counts, std::vector<double> among) {
  if (among.empty())
    for (int part = 1; part <= finest * parts; ++part) among.push_back(part / parts);
  std::vector<double> even;
  for (const double factor : among) {
    const auto follows = [factor](int count) {
      const double wanted = count * factor, kept = std::max(1.0, std::round(wanted));
      return std::abs(kept / wanted - 1) <= uneven;
    };
    if (std::all_of(counts.begin(), counts.end(), follows)) even.push_back(factor);
  }
  return even;
}

double first_factor(const std::vector<double>& even, const std::vector<int>& counts) {
  const int fewest = counts.empty() ? 1 : *std::min_element(counts.begin(), counts.end());
  return at_least_of(even, std::min(1.0, std::max(0.25, 2.0 / fewest)));
}

double next_factor(const std::vector<double>& even, const std::vector<Level>& levels, double target) {
  const double now = levels.back().refine;
  const MeshError seen = mesh_error(levels);
  if (levels.size() < 3) return at_least_of(even, wider * now);
  const double order = std::isnan(seen.order) ? 1 : std::min(seen.order, formal_order);
  const double wanted = std::pow(seen.error / target, 1 / order);
  return at_least_of(even, now * std::clamp(wanted, least_step, most_step));
}

double updates_at(const std::vector<Level>& levels, double refine) {
  const Level& last = levels.back();
  double power = 4;
  if (levels.size() > 1) {
    const Level& before = levels[levels.size() - 2];
    if (before.updates > 0 && last.updates > 0)
      power = std::clamp(std::log(last.updates / before.updates) / std::log(last.refine / before.refine), 1.0, 4.0);
  }
  return last.updates * std::pow(refine / last.refine, power);
}

}  // namespace nereid
