#pragma once
// Probes that a case asks for: columns of history.csv, extremes in summary.json, and conditions that stop a run.

#include <limits>
#include <memory>

#include "drivers/driver.hpp"
#include "input/scene_readers.hpp"

namespace nereid::driver {

/// A value over the samples of a run: where it stands, and how far it went.
struct Seen {
  double last = std::numeric_limits<double>::quiet_NaN();
  double largest = last, smallest = last;       ///< NaN where no sample had a value
  double time_of_largest = 0, time_of_smallest = 0;  ///< [s] first of equal ones
  void see(double now, double t);
};

/// What a probe of the case measures. The model must stand and its ledger have its accounts.
///
/// Where the scene has what the probe asks for but cannot measure it, that is a fault of the case.
std::function<double(const dynamics::View&)> measure(const input::ProbeOptions&, const Scene&);

/// Adds the probes of a case to a scene, their results and its conditions. Call finish() of the file afterwards.
void add_probes(const std::vector<input::ProbeOptions>&, const std::vector<input::StopOptions>&, Scene&);

}  // namespace nereid::driver
