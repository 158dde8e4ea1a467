#include "contact/penalty/impact_step.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"

namespace nereid::contact {

double energy_created_in_a_bounce(double step) {
  constexpr int phases = 400;
  double worst = 0;
  for (int phase = 0; phase < phases; ++phase) {
    double x = step * (phase + 0.5) / phases, v = -1;  // the last sample before contact, speed 1
    bool touched = false;
    for (int sample = 0; sample < 100000; ++sample) {
      x += step * v;
      if (x < 0) touched = true;
      if (touched && x >= 0) break;
      if (x < 0) v -= step * x;
    }
    worst = std::max(worst, v * v - 1);
  }
  return worst;
}

double most_created_in_a_bounce(double step) { return step * step / (4 - step * step); }

double impact_step_factor_for(double bound) {
  check(bound > 0 && bound < 1, "the energy a bounce may create lies between 0 and 1");
  return std::min(0.5, 2 * std::sqrt(bound / (1 + bound)));
}

}  // namespace nereid::contact
