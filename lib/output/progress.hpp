#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace nereid::output {

/// A span of time as people say it: "12 s", "3 min 20 s", "2 h 05 min"; "?" if it is no number.
std::string spoken(double seconds);

/// What the terminal shows: how far, where, and how long it will still take.
///
/// begin    [s] time of the simulation where this run began or went on
/// elapsed  [s] of the wall clock since then; the rest is guessed at the same speed
std::string progress_line(double time, double begin, double end, std::int64_t step, double dt, double elapsed);

/// One line on the terminal that is written over and over; where stderr is no terminal, a line a minute.
class Progress {
 public:
  static constexpr std::chrono::milliseconds usual_pause = std::chrono::minutes(1);

  /// begin, end  [s];  quiet: never say anything;  pause: between two lines where there is no terminal
  Progress(double begin, double end, bool quiet, std::chrono::milliseconds pause = usual_pause);
  ~Progress() { done(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap enough for every step: writes five times a second at most on a terminal.
  void show(double time, std::int64_t step, double dt);
  /// Ends the line, so that what follows starts on a new one.
  void done();

 private:
  using Clock = std::chrono::steady_clock;
  double begin_, end_;
  bool silent_, terminal_;
  bool open_ = false;  ///< the cursor stands in our line
  std::chrono::milliseconds pause_;
  Clock::time_point start_, last_;
};

}  // namespace nereid::output
