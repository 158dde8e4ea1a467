#pragma once
// What observers and probes see of a run, and probes: numbers over time whose memory belongs to the state.

#include <functional>
#include <string>

#include "dynamics/model.hpp"

namespace nereid::dynamics {

struct View {
  const Model& model;
  const State& now;
  const Forces& forces;
  bool ledger_is_current;  ///< whether the ledger is that of this very state
};

/// One number over time. A probe remembers nothing itself: all that it needs from one sample to the next is in its memory.
struct Probe {
  std::string name, unit;
  std::function<double(const View&, ProbeMemory&)> value;
  bool every_step = false;  ///< sampled after every step; else whenever the ledger is brought up to date
};

/// Measures once: `last`, extremes with their times, the integral and the times above zero.
void sample(const Probe&, const View&, ProbeMemory&);

}  // namespace nereid::dynamics
