#include "dynamics/probe.hpp"

namespace nereid::dynamics {

void sample(const Probe& probe, const View& view, ProbeMemory& memory) {
  const double now = probe.value(view, memory.of_steps), t = view.now.t;
  if (!probe.is_mean) memory.last = now;
  ++memory.samples;
  if (now != now) return;
  if (!(now <= memory.largest)) memory.largest = now, memory.time_of_largest = t;
  if (!(now >= memory.smallest)) memory.smallest = now, memory.time_of_smallest = t;
  memory.integral += now * view.now.dt;
  if (!(now > 0)) return;
  if (memory.first_above_zero < 0) memory.first_above_zero = t;
  memory.last_above_zero = t;
}

void sample_row(const Probe& probe, const View& view, ProbeMemory& memory) {
  if (!probe.is_mean) return;
  memory.last = probe.value(view, memory.of_rows);
  if (!(memory.last <= memory.largest_row)) memory.largest_row = memory.last;
  if (!(memory.last >= memory.smallest_row)) memory.smallest_row = memory.last;
}

}  // namespace nereid::dynamics
