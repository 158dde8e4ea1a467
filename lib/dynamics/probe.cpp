#include "dynamics/probe.hpp"

#include <cmath>

namespace nereid::dynamics {

namespace {

/// A formula of what other probes have: of the step, or of the row.
double value_of(const Probe& probe, double t, const std::vector<ProbeMemory>& memories, double ProbeMemory::*which) {
  std::vector<double> inputs;
  for (const std::size_t input : probe.inputs) inputs.push_back(memories[input].*which);
  return probe.formula(inputs, t);
}

}  // namespace

void sample(const Probe& probe, const View& view, const std::vector<ProbeMemory>& memories, ProbeMemory& memory) {
  const double t = view.now.t;
  const double now = probe.formula ? value_of(probe, t, memories, &ProbeMemory::now) : probe.value(view, memory.of_steps);
  memory.now = now;
  if (!probe.is_mean) memory.last = now;
  ++memory.samples;
  const bool is_lost = probe.formula && !std::isfinite(now);
  memory.not_finite += is_lost ? 1 : 0;
  if (now != now || is_lost) return;
  if (!(now <= memory.largest)) memory.largest = now, memory.time_of_largest = t;
  if (!(now >= memory.smallest)) memory.smallest = now, memory.time_of_smallest = t;
  memory.integral += now * view.now.dt;
  if (!(now > 0)) return;
  if (memory.first_above_zero < 0) memory.first_above_zero = t;
  memory.last_above_zero = t;
}

void sample_row(const Probe& probe, const View& view, const std::vector<ProbeMemory>& memories, ProbeMemory& memory) {
  if (!probe.is_mean) return;
  memory.last = probe.formula ? value_of(probe, view.now.t, memories, &ProbeMemory::last) : probe.value(view, memory.of_rows);
  if (!(memory.last <= memory.largest_row)) memory.largest_row = memory.last;
  if (!(memory.last >= memory.smallest_row)) memory.smallest_row = memory.last;
}

}  // namespace nereid::dynamics
