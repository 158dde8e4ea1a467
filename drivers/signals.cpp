#include "drivers/signals.hpp"

#include <csignal>

namespace nereid::driver {

namespace {

volatile std::sig_atomic_t heard = 0;

void remember(int signal) {
  if (heard == 0) heard = signal;
}

}  // namespace

void hear_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {}, action {};
    if (sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    action.sa_handler = remember;
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);  // files are written whole; the second time nobody hears
    sigaction(signal, &action, nullptr);
  }
}

std::string heard_signal() {
  switch (heard) {
    case SIGINT: return "SIGINT";
    case SIGTERM: return "SIGTERM";
    case SIGHUP: return "SIGHUP";
    default: return "";
  }
}

void stop_if_interrupted(const std::string& meaning) {
  const std::string signal = heard_signal();
  if (!signal.empty()) throw Interrupted("interrupted by " + signal + ": " + meaning);
}

}  // namespace nereid::driver
