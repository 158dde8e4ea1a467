#include "drivers/signals.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace nereid::driver {

namespace {

struct Signal {
  int number;
  const char* name;
  // whole before any signal is heard, since a handler may not compose them
  std::array<char, 200> sentence;  ///< said where nothing is kept
  std::array<char, 200> again;     ///< said the second time
  std::atomic<bool> came = false;
};

std::array<Signal, 3> signals{{{SIGINT, "SIGINT", {}, {}}, {SIGTERM, "SIGTERM", {}, {}}, {SIGHUP, "SIGHUP", {}, {}}}};
std::atomic<int> heard = 0, exit_status = 0;
std::atomic<bool> keeps = false;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free, "a handler may use them");

/// Remembers a signal, or ends the program, as where the same one comes again. Calls only what a handler may.
void take(int number) {
  int none = 0;
  const bool remembers = keeps;
  for (Signal& one : signals) {
    if (one.number != number) continue;
    if (remembers && !one.came.exchange(true)) {
      heard.compare_exchange_strong(none, number);
      return;
    }
    const char* said = remembers ? one.again.data() : one.sentence.data();
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, said, std::strlen(said));
  }
  ::_exit(exit_status);
}

}  // namespace

void keep_results(bool keep) { keeps = keep; }

void hear_signals(const std::string& name, int status) {
  exit_status = status;
  for (Signal& one : signals) {
    std::snprintf(one.sentence.data(), one.sentence.size(), "%s: interrupted by %s before it wrote results\n", name.c_str(), one.name);
    std::snprintf(one.again.data(), one.again.size(), "%s: interrupted by a second %s before it could write its last results\n",
                  name.c_str(), one.name);
    struct sigaction before {}, action {};
    if (sigaction(one.number, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    action.sa_handler = take;
    action.sa_flags = SA_RESTART;  // files are written whole
    sigaction(one.number, &action, nullptr);
  }
}

std::string heard_signal() {
  for (const Signal& one : signals)
    if (one.number == heard) return one.name;
  return "";
}

void stop_if_interrupted(const std::string& meaning) {
  const std::string signal = heard_signal();
  if (!signal.empty()) throw Interrupted("interrupted by " + signal + ": " + meaning);
}

}  // namespace nereid::driver
