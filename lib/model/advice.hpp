#pragma once
// What the steps of a run will be, and what in a scene makes them short: known at the start.

#include <string>
#include <vector>

#include "model/build.hpp"

namespace nereid::model {

/// The steps that a run is expected to have.
///
/// Elements are taken as they are at the start. A contact by a penalty that is still open, and does not limit the step yet, counts as if
/// what comes into contact first were in contact: its apexes no higher than the lowest one and the depth of an element.
struct ExpectedSteps {
  dynamics::Step first;            ///< the first one
  double dt = 0;                   ///< [s] length of the others
  double elements = 0;             ///< [s] what it would be without contacts and rigid planes by a penalty
  std::vector<double> contacts;  ///< [s] largest step of each contact; 1e300 of those that set none
  std::vector<double> rigid_planes;
};

/// Needs  a simulation that has been started (dynamics::start), at its start
ExpectedSteps expected_steps(const Simulation&);

/// How many steps that makes. [-]
double count(const ExpectedSteps&, double end);

/// Whether an interface may have multipliers in the place of its penalty: all but ties in two passes and to rigid bodies.
bool may_have_multipliers(const dynamics::Model&, const contact::Interface&);

/// What makes the steps at least half as long again, if it were changed: each contact and rigid plane by a penalty, and the few elements
/// (a twentieth of them at most) that are so much smaller than the rest. One a line; empty where nothing does.
///
/// Needs  the same
std::vector<std::string> step_advice(const Simulation&, const ExpectedSteps&);

/// A warning that elements will be deformed, and steps then differ from the expected ones: where the kinetic energy at the start is more
/// than a twentieth of yield stress times volume, so that strains of as much are to be expected. Empty elsewhere.
///
/// Needs  the same
std::vector<std::string> strain_notes(const Simulation&);

}  // namespace nereid::model
