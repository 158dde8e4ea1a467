#pragma once
// The two ways in which a program says that something is wrong with itself or with its machine.

#include <stdexcept>
#include <string>

namespace nereid {

/// We are wrong: a shape does not match, something was not initialised. Exit status 4.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

/// The machine is wrong: a file cannot be written, the disk is full. Exit status 5.
struct MachineError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws InternalError unless `condition` holds; for set-up code, not for the step.
inline void check(bool condition, const char* what) {
  if (!condition) throw InternalError(what);
}

}  // namespace nereid
