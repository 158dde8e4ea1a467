#pragma once
// Signals that ask a run to end: SIGINT, SIGTERM and SIGHUP.

#include <stdexcept>
#include <string>

namespace nereid::driver {

/// A signal that came where no run can be kept.
struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// From now on a signal ends the program at once, with this exit status and a sentence: while a case is read and its model is built there
/// is nothing to keep. The folder of results is left as by SIGKILL. What is ignored stays so, as SIGHUP under nohup.
void hear_signals(const std::string& name, int status);

/// Whether there are results to keep: then the first signal of each kind is only remembered, and a second one ends the program at once.
void keep_results(bool keep);

/// The name of the first signal that was remembered, as "SIGTERM"; empty without one.
std::string heard_signal();

/// Throws Interrupted if a signal was remembered; says what that means.
void stop_if_interrupted(const std::string& meaning);

}  // namespace nereid::driver
