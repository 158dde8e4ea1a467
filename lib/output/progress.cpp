#include "output/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/words.hpp"

namespace nereid::output {

namespace {
constexpr std::chrono::milliseconds on_terminal{200};  // five lines a second: people read no faster
}  // namespace

std::string spoken(double seconds) {
  constexpr double longest = 1e9;  // [s] 30 years: nobody waits, and the numbers below stay small
  if (!(seconds >= 0 && seconds < longest)) return "?";
  const auto s = static_cast<long>(std::lround(seconds));
  if (s < 60) return formatted("%ld s", s);
  return s < 3600 ? formatted("%ld min %02ld s", s / 60, s % 60) : formatted("%ld h %02ld min", s / 3600, s % 3600 / 60);
}

std::string progress_line(double time, double begin, double end, std::int64_t step, double dt, double elapsed) {
  const double share = end > 0 ? std::clamp(time / end, 0.0, 1.0) : 0;
  const double rest = time > begin ? elapsed * std::max(0.0, end - time) / (time - begin) : NAN;
  return formatted("%5.1f %%  %.4g of %.4g s  step %lld  dt %.3g s  %s to go", 100 * share, time, end, static_cast<long long>(step), dt,
                   spoken(rest).c_str());
}

Progress::Progress(double begin, double end, bool quiet, std::chrono::milliseconds pause)
    : begin_(begin), end_(end), silent_(quiet), terminal_(isatty(STDERR_FILENO) != 0), pause_(terminal_ ? on_terminal : pause),
      start_(Clock::now()), last_(terminal_ ? start_ - pause_ : start_) {}

void Progress::show(double time, std::int64_t step, double dt) {
  if (silent_) return;
  const auto now = Clock::now();
  if (now - last_ < pause_) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string line = progress_line(time, begin_, end_, step, dt, elapsed);
  // On a terminal: back to the start of the line, write, clear what a longer line left behind.
  std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line.c_str());
  std::fflush(stderr);
  open_ = terminal_;
}

void Progress::done() {
  if (open_) std::fputc('\n', stderr);
  open_ = false;
}

}  // namespace nereid::output
