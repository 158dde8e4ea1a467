#include "drivers/signals.hpp"

#include <unistd.h>

#include <csignal>
#include <string>

namespace nereid::driver {

namespace {

volatile std::sig_atomic_t heard = 0, keeps_results = 0;
std::string of_program;  // set before any signal is heard
int exit_status = 0;

const char* name_of(int signal) {
  switch (signal) {
    case SIGINT: return "SIGINT";
    case SIGTERM: return "SIGTERM";
    case SIGHUP: return "SIGHUP";
    default: return "";
  }
}

/// A part of what is said; what does not reach its reader cannot be helped.
void say(const char* text) {
  std::size_t size = 0;
  while (text[size] != 0) ++size;
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, size);
}

/// Calls only what a handler may.
void remember(int signal) {
  if (keeps_results == 0) {
    say(of_program.c_str()), say(": interrupted by "), say(name_of(signal)), say(" before the run began\n");
    ::_exit(exit_status);
  }
  if (heard == 0) heard = signal;
}

}  // namespace

KeepResults::KeepResults() { keeps_results = 1; }
KeepResults::~KeepResults() { keeps_results = 0; }

void hear_signals(const std::string& name, int status) {
  of_program = name;
  exit_status = status;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {}, action {};
    if (sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    action.sa_handler = remember;
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);  // files are written whole; the second time nobody hears
    sigaction(signal, &action, nullptr);
  }
}

std::string heard_signal() {
  return name_of(heard);
}

void stop_if_interrupted(const std::string& meaning) {
  const std::string signal = heard_signal();
  if (!signal.empty()) throw Interrupted("interrupted by " + signal + ": " + meaning);
}

}  // namespace nereid::driver
