#pragma once
// What observers and probes see of a run, and probes: numbers over time whose memory belongs to the state.

#include <functional>
#include <string>
#include <vector>

#include "dynamics/model.hpp"

namespace nereid::dynamics {

struct View {
  const Model& model;
  const State& now;
  const Forces& forces;
  bool ledger_is_current;  ///< whether the ledger is that of this very state
};

/// Whether the largest value of a probe follows the mesh, as that of a plastic strain, which grows at an edge with each finer one.
enum class FollowsMesh { no, yes, less_with_eight_points };

/// One number over time. A probe remembers nothing itself: all that it needs from one look to the next is in its memory.
struct Probe {
  std::string name, unit;
  std::function<double(const View&, Kept&)> value;
  bool is_mean = false;  ///< over the time since the look before, as a force from its impulse; else the value at the look
  FollowsMesh follows_mesh = FollowsMesh::no;
  std::function<double(const View&, Kept&)> mean = {};  ///< of one that follows the mesh: the mean of the same elements
  std::vector<std::size_t> inputs = {};  ///< of a formula: places of the probes that it takes, all before it
  std::function<double(const std::vector<double>& inputs, double t)> formula = {};  ///< in the place of `value`
  int footing = -1;      ///< in State::footings: of the contact or rigid plane whose force it is; -1: it is none
};

/// Measures the start or a step: extremes with their times, the integral and the times above zero; `last` of what is no mean.
///
/// memories  of all probes of the run: those before this one have been sampled
void sample(const Probe&, const View&, const std::vector<ProbeMemory>& memories, ProbeMemory&);

/// `last` of a mean, that since the row before, and its extremes over the rows. To be called where the ledger is current.
void sample_row(const Probe&, const View&, const std::vector<ProbeMemory>& memories, ProbeMemory&);

}  // namespace nereid::dynamics
