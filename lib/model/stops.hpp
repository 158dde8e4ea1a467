#pragma once
// Conditions that end a run where its question is answered: levels, first maxima, means that no longer change, rest.

#include <string>
#include <vector>

#include "model/build.hpp"

namespace nereid::model {

/// What a condition says of a value at a time: why the run should stop, in words, or nothing.
///
///     level   value above (or below) the bound
///     peak    extreme - value >= part (extreme - first)  and  t - time of the extreme >= span,  after a rise:  extreme > first
///     steady  |mean - mean before| <= value,  means over windows of one span each, end to end, by the trapezoid rule
///     rest    value <= part times scale, or times the largest value so far,  since  t - span
///
/// first, extreme and windows begin with the first value that counts. A time that has been shown changes nothing.
///
/// unit   of the value
/// scale  in that unit, of rest: the energy of the scene
std::string wanted_stop(const Stop&, double t, double value, const std::string& unit, double scale, dynamics::ConditionMemory&);

/// The same of all conditions of a simulation, whose probes have been sampled: the first that is met.
///
/// memories  beside Simulation::stops; made when they are not there
std::string wanted_stop(const Simulation&, const dynamics::View&, std::vector<dynamics::ConditionMemory>& memories);

}  // namespace nereid::model
