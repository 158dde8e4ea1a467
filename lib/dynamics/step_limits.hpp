#pragma once
// How long the next step may be: each source has a limit, and one function chooses.

#include <string>
#include <vector>

#include "base/account.hpp"
#include "base/step_limit.hpp"

namespace nereid::dynamics {

struct Model;

/// In the place of an element: no element but `time.largest_step` limits the step of rigid bodies.
constexpr Index at_largest_step = -2;

/// The smallest limit of several sources, and whose it is.
struct SourceLimit {
  double step = 1e300;  ///< [s]; 1e300: no limit
  int source = -1;      ///< in sources(model)
  Index at = -1;        ///< element of a block, -1 the turn of a rigid body, at_largest_step; node of an apex or of a rigid plane
  void lower_to(const StepLimit& limit, int from) {
    if (limit.step < step) step = limit.step, source = from, at = limit.at;
  }
};

/// What limits the next step, and whether any element is lost.
struct StepLimits {
  SourceLimit elements;           ///< the linear bound of elements and springs; a run stays below it by its safety
  SourceLimit contact;            ///< of interfaces and rigid planes: their own bound, which has its margin in it
  SourceLimit blows;              ///< what multipliers ask for; it has a source from the step on that was shorter for it: update_ringing()
  double ringing = 0;             ///< [W/s] the sum of f.f/m, the largest of some twenty steps
  double energy = 0;              ///< [J] of the scene, as it was found where blows asked for a shorter step
  double volume_ratio = 1e300;  ///< [-] smallest volume or area ratio; not positive or NaN: inverted
  int smallest_block = -1; ///< in sources(model)
  Index smallest_element = -1;
  int may_grow = 0;             ///< steps in a row after which the next one might have been longer by a twentieth; see update_growth()
  bool costly = false;          ///< whether changes of the step have created what is worth a warning
  double trend = 1;             ///< [-] 0.5 to 1: the limit of the elements over the one a step before, where it falls; see choose_step()
};

/// The length of a step, and what limits it.
struct Step {
  double dt = 1e300;    ///< [s]
  int source = -1;      ///< in sources(model)
  Index at = -1;        ///< see SourceLimit
  double safety = 1;    ///< [-] of the limit that the source voted for
};

/// How long the steps of a run are.
struct Pace {
  double end = 1e300;   ///< [s] of the run
  double safety = 0.9;  ///< [-] fraction of the elements' stable step; contact has a bound of its own
  double fixed = 0;     ///< [s] positive: every step is so long
};

/// Chooses the next step: the smaller of `safety` times the limit of the elements and the limit of contact.
///
/// The limit of the elements is the one of their shape at the start of the step. Where it falls, as when elements are pressed, it is taken
/// to fall as much again within the step, which then takes at most `safety` and a quarter of what that leaves of the limit to come. So
/// small swings of the limit do not change the step.
Step choose_step(const StepLimits&, double safety);

/// The length of the step that begins at t: as chosen, but it grows only by a twentieth or more, because every change of the step costs
/// energy; and the last twenty share what is left evenly, so that none is vanishingly short. [s]
///
/// Where bodies ring at the limit of the step, it falls as they are pressed and grows as they let go: energy is created in each cycle,
/// dt^2/8 f.f/m being large in the one and small in the other. So once that is worth a warning, the step grows only where twenty in a row
/// would have let it.
///
/// last  [s] the step that led to t; 0: none
double next_length(const StepLimits&, const Pace&, double t, double last);

/// The longest of  usual 2^-k/4,  k = 1 to 12,  that is no longer than a step: round-off in what blows ask for then changes no step. [s]
double step_for_blows(double usual, double step);

/// Keeps a step that was made shorter for blows until neither these nor what they left ask for it:
///
///     dt^2/8 sum of f.f/m <= 0.01 E,    half of what blows may ask for: a step that grows while bodies ring takes energy
///
/// usual  [s] the step without it;  energy  [J] E
void update_ringing(const StepLimits& before, double usual, double energy, StepLimits& now);

/// Brings up to date what choose_step() and next_length() ask of the steps before.
///
/// before   the limits of the step dt that has been done;  created  [-] what changes of the step have created, over steady_scale()
void update_growth(const StepLimits& before, const Pace&, double dt, double created, StepLimits& now);

/// What limits a step, in words: "element 17 of 'lead', 0.9 of its stable step", "contact 'skin', apex at node 204".
std::string limited_by(const Step&, const std::vector<Source>&);

}  // namespace nereid::dynamics
