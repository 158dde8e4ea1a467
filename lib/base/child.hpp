#pragma once
// Work that may crash, hang or ask for all memory, done in a process of its own.

#include <functional>
#include <string>

namespace nereid {

/// What became of work in a child process.
struct OfChild {
  std::string bytes;          ///< what the work returned
  std::string why = {};       ///< empty, or why it did not return, as part of a sentence: "it crashed: Aborted"
  bool out_of_memory = false; ///< it did not return since memory did not suffice
};

/// What the child may take.
struct OfChildAtMost {
  double memory = 0;    ///< [bytes] beyond what this process has; zero: as much as this process may
  double seconds = 60;  ///< then it is ended
};

/// Does the work in a copy of this process, which writes nothing to the terminal, and waits for what it returns. The work must not use
/// threads that were started before, as share_loop() does. MachineError where no process can be started.
OfChild in_child(const std::function<std::string()>& work, const OfChildAtMost&);

}  // namespace nereid
