#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace nereid::output {

/// A span of time as people say it: "12 s", "3 min 20 s", "2 h 05 min"; "?" if it is no number.
std::string spoken(double seconds);

/// What the terminal shows: how far, where, and how long it will still take.
///
/// elapsed  [s] of the wall clock since the start; the rest is guessed at the same speed
std::string progress_line(double time, double end_time, std::int64_t step, double dt,
                          double elapsed);

/// One line on the terminal that is written over and over; silent where stderr is no terminal.
class Progress {
 public:
  /// end_time [s]; quiet: never say anything
  Progress(double end_time, bool quiet);
  ~Progress() { done(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap enough for every step: writes five times a second at most.
  void show(double time, std::int64_t step, double dt);
  /// Ends the line, so that what follows starts on a new one.
  void done();

 private:
  using Clock = std::chrono::steady_clock;
  double end_time_;
  bool silent_;
  bool open_ = false;  ///< the cursor stands in our line
  Clock::time_point start_, last_;
};

}  // namespace nereid::output
