#pragma once
// How often a run writes frames where its case does not say it.

#include "model/build.hpp"

namespace nereid::model {

inline constexpr double most_usual_frames = 40;

/// How many intervals between frames a run has by default: 40, or fewer where these would take more than a tenth of its steps; at least
/// one.
///
///   0.1 elements steps / (cost_of_node nodes + cost_of_element elements) - 1
///
/// It follows from these numbers alone, so it is the same on any machine, with any threads and after a checkpoint. [-]
double usual_frames(double nodes, double elements, double steps);

/// The interval of frames of a run that has begun: that of its case, or the usual one, with steps as long as the first. [s]
double frames_every(const Simulation&);

}  // namespace nereid::model
