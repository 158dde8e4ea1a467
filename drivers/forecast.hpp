#pragma once
// What a run will take, found before it by a rehearsal: some steps of the real scene, one row and one frame.
//
//   steps    time.end over the step that is expected at the start (model/advice.hpp)
//   seconds  steps, rows, frames and looks for overlaps, each times what one took in the rehearsal
//   bytes    rows of the history, frames and summary, each as long as in the rehearsal
//   memory   what was resident at most up to the end of the rehearsal
//
// A frame of a scene at rest is mostly zeros, which are packed to nothing. So the rehearsal shakes the scene first: its frame is as long
// as those of scenes in motion, and the first frame of the run is made before it.

#include <functional>
#include <string>
#include <vector>

#include "model/advice.hpp"
#include "model/build.hpp"

namespace nereid::driver {

struct Forecast {
  dynamics::Outcome start;          ///< how the run would end at its start; good() if it would not
  model::ExpectedSteps expected;
  dynamics::StepLimits step_limits;            ///< of the start
  double steps = 0, rows = 0, frames = 0;
  double seconds = 0;               ///< [s] of this machine as busy as it is
  double bytes = 0;                 ///< of all files
  double memory = 0;                ///< [bytes] resident at most
  std::vector<std::string> advice;  ///< what would make it shorter, and what it does not know
};

/// How a run begins.
struct Start {
  dynamics::Outcome outcome;  ///< good() unless it would end there
  dynamics::Step first;
};

/// Starts a simulation, as a run of no time does.
Start start_of(model::Simulation&);

/// Rehearses a run. The simulation is worn by that: whoever wants to run it builds it again. So no copy is held beside it, and a rehearsal
/// takes no more memory than the run.
///
/// summary  how long summary.json would be, of the simulation as it then stands [bytes]
Forecast forecast(model::Simulation&, const std::function<std::size_t()>& summary);

/// "12345 steps, 3.2 s, 401 rows, 41 frames, 1.2 MB of files, 62 MB of memory"
std::string in_words(const Forecast&);

}  // namespace nereid::driver
