#pragma once
// What contact by multipliers costs, by the stages of a step.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace nereid::contact {

/// Stages of contact by multipliers in a step, in the order in which they act.
enum class Stage : std::size_t {
  search,      ///< contact detection of automatic contacts
  predict,     ///< free velocities and positions after the step, ties
  track,       ///< which parts of a base an apex is in contact with; contact detection of declared contacts
  conditions,  ///< feet, weights, normals and gaps of apexes
  edges,       ///< the same where edges cross
  solve,       ///< impulses, by iteration
  release,     ///< of energy held by restitution
  book,        ///< forces into the memories, energies and momenta
};
constexpr std::size_t stages = 8;
constexpr std::array<const char*, stages> stage_names{"search", "predict", "track", "conditions", "edges", "solve", "release", "book"};

/// What contact by multipliers has taken in this process.
struct Spent {
  std::int64_t steps = 0;       ///< in which any apex had a condition
  std::int64_t apexes = 0;      ///< with conditions, of all these steps together; nodes over planes and edges that cross too
  std::int64_t conditions = 0;  ///< of these
  std::int64_t iterations = 0;
  double seconds = 0;           ///< on the wall, with search and tracking
  std::array<double, stages> of_stage{};            ///< [s] of these
  std::chrono::steady_clock::time_point last;       ///< when the stage before ended

  void begin() { last = std::chrono::steady_clock::now(); }
  /// Adds the time since the stage before ended.
  void end(Stage stage) {
    const auto before = last;
    begin();
    const double took = std::chrono::duration<double>(last - before).count();
    of_stage[static_cast<std::size_t>(stage)] += took, seconds += took;
  }
};

}  // namespace nereid::contact
