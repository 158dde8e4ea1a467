#pragma once
// A run: steps from the start to the end, with observers who look and never touch.

#include <functional>
#include <span>
#include <string>

#include "dynamics/probe.hpp"
#include "dynamics/step.hpp"

namespace nereid::dynamics {

/// When a run ends, how long its steps are and how much energy it may create.
struct Time {
  double end = 0;              ///< [s]
  double safety = 0.9;         ///< [-] fraction of the elements' stable step; contact has a bound of its own
  double created_limit = 0.05; ///< [-] created or lost energy of any source over energy_scale(), and over what passed: times_the_limit()
  double overlap_limit = 0.5;  ///< [-] elements by which bodies may go into each other or themselves, beyond what they did at the start
  double corner_limit = 0;     ///< [-] Jacobian of a corner of an element over that of the reference, below one: there a run ends
  double audit_every = 0;      ///< [s] between two looks for overlaps; zero: at each update of the ledger
  /// [s] of scenes with rigid bodies; zero: a thousandth of `end` where all bodies are rigid, else none
  double largest_step = 0;
};

inline constexpr double most_steps = 1e9;  ///< [-] a run that would take more does not end in a lifetime

enum class Ending {
  reached_end, stopped_by_condition, relaxed,
  interrupted, inverted_element, not_finite, step_too_small, energy_created, energy_lost, bodies_overlap, not_relaxed
};
std::string_view word(Ending);
/// Whether the run did what it was asked for: it reached its end, a condition of the case or its equilibrium.
bool good(Ending);

/// How a run ended. A run that stopped early is a value, with its place; the state is the last one.
struct Outcome {
  Ending ending = Ending::reached_end;
  std::string reason;            ///< empty if the end was reached
  std::string block;             ///< where it happened, if anywhere
  Index element = -1;
  std::int64_t element_updates = 0;
  contact::Spent contact;                      ///< by multipliers, in this process
  double wall_seconds = 0;                     ///< of the step loop with everything in it
  std::string limited_by;                      ///< the source of the smallest step, in words
  double smallest_step = 0, largest_step = 0;  ///< [s]
};

/// Looks at the state at the start, after every step, and at the end. Does not look again where a run goes on.
using Observer = std::function<void(const View&)>;

/// Asked wherever the ledger is brought up to date, after probes and observers: why the run should stop there, empty to go on. What it
/// remembers is State::conditions; a run that goes on asks once more where it was left.
using Until = std::function<std::string(const View&, std::vector<ConditionMemory>&)>;

/// Asked after each step that the run has done with: why it is interrupted there, empty to go on. A run that goes on from the state that it
/// is shown has the bits of one that went on at once.
using Interrupt = std::function<std::string(const View&)>;

/// What looks at a run and never touches it. Probes are sampled first; their memories are State::probes.
struct Watch {
  std::span<const Probe> probes = {};
  std::span<const Observer> observers = {};
  Until until = {};
  Interrupt interrupt = {};
};

/// Runs to the end, to the static equilibrium of a model with `relaxation`, or to what stops it: from a state that has not
/// been started (velocities set), or on from one that a run has left.
///
/// Overlaps are looked for at the start, at updates of the ledger once `Time::audit_every` has passed, and at the end.
/// The ledger is brought up to date at the start, at the first step past every multiple of `update_every` [s], and
/// at the end; View::ledger_is_current tells observers when.
/// Invariants  a run that goes on from a copy of its state has the bits of one that was never interrupted.
Outcome run(const Model&, State&, Forces&, const Time&, double update_every, const Watch& = {});

/// How many times the limit on created energy holds for that of what passed through a source: five times for a block, and for any through
/// which less than a hundredth of the energy of the scene has passed, else once. [-]
///
/// A body makes what goes with the square of the step, and the little that it takes up in a few of the longest steps, as when it begins to
/// spin, is no harm to the scene. Of a weak blow by a penalty, which is over in a few steps, some percent are never made good; at the usual
/// limit that is at most 2.5e-3 of the energy of the scene.
///
/// source  in sources(model); -1: time integration
double times_the_limit(const Model&, const Ledger&, int source);

}  // namespace nereid::dynamics
