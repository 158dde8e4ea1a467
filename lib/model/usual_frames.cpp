#include "model/usual_frames.hpp"

#include <algorithm>
#include <cmath>

#include "model/notes.hpp"

namespace nereid::model {

namespace {

constexpr double share = 0.1;          // of the steps of a run
constexpr double always_cheap = 1e6;   // [steps of an element] a tenth of a second
// [steps of an element] what is copied, packed and written, with a margin: docs/decisions.md
constexpr double cost_of_node = 4, cost_of_element = 4;

}  // namespace

double usual_frames(double nodes, double elements, double steps) {
  const double one = cost_of_node * nodes + cost_of_element * elements;
  const double frames = std::floor(std::max(always_cheap, share * elements * steps) / one);
  return std::clamp(frames - 1, 1.0, most_usual_frames);
}

double frames_every(const Simulation& simulation) {
  if (simulation.recording.frames > 0) return simulation.recording.frames;
  const auto nodes = static_cast<double>(simulation.model.mesh.X.cols());
  const auto elements = static_cast<double>(count_elements(simulation.model));
  return simulation.time.end / usual_frames(nodes, elements, simulation.time.end / simulation.state.progress.first_step);
}

}  // namespace nereid::model
