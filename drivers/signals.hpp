#pragma once
// Signals that ask a run to end: SIGINT, SIGTERM and SIGHUP.

#include <stdexcept>
#include <string>

namespace nereid::driver {

/// A signal that came where no run can be kept.
struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// From now on a signal ends the program with this exit status and a sentence, at once: while a case is read and its model is built there is
/// nothing to keep. What is ignored stays so, as SIGHUP under nohup.
void hear_signals(const std::string& name, int status);

/// While it lives the first signal of each kind is only remembered, since there are results to keep; a second one ends the program at once.
class KeepResults {
public:
  KeepResults();
  ~KeepResults();
  KeepResults(const KeepResults&) = delete;
  KeepResults& operator=(const KeepResults&) = delete;
};

/// The name of the first signal that came, as "SIGTERM"; empty without one.
std::string heard_signal();

/// Throws Interrupted if a signal has come; says what that means.
void stop_if_interrupted(const std::string& meaning);

}  // namespace nereid::driver
