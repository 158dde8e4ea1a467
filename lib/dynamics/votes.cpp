#include "dynamics/votes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nereid::dynamics {

Step choose_step(const Votes& votes, double safety) {
  const double elements = safety * votes.elements.step;
  if (votes.contact.step < elements) return {votes.contact.step, votes.contact.source, votes.contact.at, 1};
  return {elements, votes.elements.source, votes.elements.at, safety};
}

double next_length(const Votes& votes, const Pace& pace, double t, double last) {
  constexpr double grows_by = 1.05, shared = 20;
  if (pace.fixed > 0) return pace.fixed;
  const double most = choose_step(votes, pace.safety).dt, left = pace.end - t;
  const double chosen = most < grows_by * last ? std::min(most, last) : most;
  if (left >= shared * chosen || !(left > 1e-12 * pace.end)) return chosen;  // at the end as if the run went on
  return left / std::max(1.0, std::ceil(left / chosen - 1e-9));
}

std::string limited_by(const Step& step, const std::vector<Source>& sources) {
  if (step.source < 0) return "nothing";
  const Source& source = sources[static_cast<std::size_t>(step.source)];
  const std::string name = "'" + source.name + "'", at = std::to_string(step.at);
  char part[40] = "";
  if (step.safety != 1) std::snprintf(part, sizeof part, ", %.4g of its stable step", step.safety);
  switch (source.kind) {
    case SourceKind::block: return "element " + at + " of " + name + part;
    case SourceKind::interface: return "contact " + name + ", apex at node " + at;
    case SourceKind::rigid_plane: return "rigid plane " + name + ", node " + at;
    default: return std::string(word(source.kind)) + " " + name + part;
  }
}

}  // namespace nereid::dynamics
