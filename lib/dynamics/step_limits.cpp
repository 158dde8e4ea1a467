#include "dynamics/step_limits.hpp"

#include <algorithm>
#include <cmath>

#include "base/words.hpp"
#include "contact/multiplier/restitution.hpp"

namespace nereid::dynamics {

namespace {

constexpr double grows_by = 1.05;          // [-] or not at all
constexpr double of_margin = 0.25;         // [-] that safety leaves: a fall may take so much of it before the step is shorter
constexpr double steepest = 0.5;           // [-] of the trend: a limit that falls faster has jumped and does not go on so
constexpr int patience = 20;               // steps: more than a period of what rings at the limit of the step
constexpr double worth_a_warning = 0.01;   // of the energy of the scene: a fifth of the usual created_limit

}  // namespace

Step choose_step(const StepLimits& limits, double safety) {
  const double most = safety + of_margin * std::max(0.0, 1 - safety);  // of the limit to come
  const double part = std::min(safety, most * limits.trend), elements = part * limits.elements.step;
  if (limits.contact.step < elements) return {limits.contact.step, limits.contact.source, limits.contact.at, 1};
  return {elements, limits.elements.source, limits.elements.at, part};
}

double next_length(const StepLimits& limits, const Pace& pace, double t, double last) {
  constexpr double shared = 20;
  if (pace.fixed > 0) return pace.fixed;
  const double most = choose_step(limits, pace.safety).dt, left = pace.end - t;
  const bool waits = limits.costly && limits.may_grow < patience;
  const double chosen = most < grows_by * last || waits ? std::min(most, last > 0 ? last : most) : most;
  if (left >= shared * chosen || !(left > 1e-12 * pace.end)) return chosen;  // at the end as if the run went on
  return left / std::max(1.0, std::ceil(left / chosen - 1e-9));
}

double step_for_blows(double usual, double step) {
  constexpr double most = 12;  // an eighth: a layer whose energy is all of the scene asks for a sixth
  return usual * std::exp2(-0.25 * std::clamp(std::ceil(4 * std::log2(usual / step)), 1.0, most));
}

void update_ringing(const StepLimits& before, double usual, double energy, StepLimits& now) {
  now.blows = before.blows, now.ringing = before.ringing, now.energy = before.energy;
  if (before.blows.source < 0) return;
  const double left = 0.5 * contact::most_ringing * energy, step = std::min(before.blows.step, std::sqrt(8 * left / before.ringing));
  if (step < usual) now.contact.lower_to({step_for_blows(usual, step), before.blows.at}, before.blows.source);
  else now.blows.source = -1;
}

void update_growth(const StepLimits& before, const Pace& pace, double dt, double created, StepLimits& now) {
  const double ratio = now.elements.step / before.elements.step;
  now.trend = ratio < 1 ? std::max(ratio, steepest) : 1;
  now.may_grow = choose_step(now, pace.safety).dt < grows_by * dt ? 0 : before.may_grow + 1;
  now.costly = before.costly || created > worth_a_warning;
}

std::string limited_by(const Step& step, const std::vector<Source>& sources) {
  if (step.source < 0) return "nothing";
  const Source& source = sources[static_cast<std::size_t>(step.source)];
  const std::string name = "'" + source.name + "'", at = std::to_string(step.at);
  const std::string part = step.safety != 1 ? formatted(", %.4g of its stable step", step.safety) : "";
  switch (source.kind) {
    case SourceKind::block:
      if (step.at == at_largest_step) return "'time.largest_step', by default a thousandth of the run where all bodies are rigid";
      if (step.at < 0) return "the turn of " + name + " in a step";
      return "element " + at + " of " + name + part;
    case SourceKind::interface: return "contact " + name + ", apex at node " + at;
    case SourceKind::rigid_plane: return "rigid plane " + name + ", node " + at;
    default: return std::string(word(source.kind)) + " " + name + part;
  }
}

}  // namespace nereid::dynamics
