#include "model/stops.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/check.hpp"
#include "base/words.hpp"

namespace nereid::model {

namespace {

using dynamics::ConditionMemory;

/// Takes a value into the memory; sign: 1 to look for the largest, -1 for the smallest.
void see(double t, double value, double sign, ConditionMemory& memory) {
  if (memory.time < 0) {
    memory.first = value;
    memory.since = t;
  } else {
    memory.integral += 0.5 * (memory.last + value) * (t - memory.time);
  }
  if (!(sign * value <= sign * memory.extreme)) memory.extreme = value, memory.time_of_extreme = t;
  memory.last = value, memory.time = t;
}

std::string peaked(const Stop& stop, const char* unit, const ConditionMemory& now) {
  const double sign = stop.above ? 1 : -1, rise = sign * (now.extreme - now.first), fall = sign * (now.extreme - now.last);
  if (!(rise > 0 && fall > 0 && fall >= stop.part * rise && now.time - now.time_of_extreme >= stop.span)) return "";
  return formatted("%s passed its %s value, %.6g %s, at %.6g s", stop.probe.c_str(), stop.above ? "largest" : "smallest", now.extreme, unit,
                   now.time_of_extreme);
}

/// Closes a window that is over.
std::string steady(const Stop& stop, const char* unit, ConditionMemory& now) {
  constexpr double round_off = 1e-9;
  const double span = now.time - now.since;
  if (!(span >= (1 - round_off) * stop.span)) return "";
  const double before = now.mean;
  now.mean = now.integral / span;
  now.integral = 0, now.since = now.time;
  if (!(std::abs(now.mean - before) <= stop.value)) return "";  // no window before is no number
  return formatted("the mean of %s over %.4g s changed from %.6g to %.6g %s, by no more than %.4g %s", stop.probe.c_str(), stop.span,
                   before, now.mean, unit, stop.value, unit);
}

std::string at_rest(const Stop& stop, double scale, ConditionMemory& now) {
  const double most = stop.of_scene ? scale : now.extreme;
  if (!(now.time >= stop.after && most > 0 && now.last <= stop.part * most)) {
    now.since = -1;
    return "";
  }
  if (now.since < 0) now.since = now.time;
  if (!(now.time - now.since >= stop.span)) return "";
  return formatted("the kinetic energy has been below %.4g of the %s since %.6g s", stop.part,
                   stop.of_scene ? "energy of the scene" : "largest one", now.since);
}

}  // namespace

std::string wanted_stop(const Stop& stop, double t, double value, const std::string& unit, double scale, ConditionMemory& memory) {
  if (t < stop.after && stop.kind != StopKind::rest) return "";
  if (stop.kind == StopKind::level) {
    if (!(stop.above ? value > stop.value : value < stop.value)) return "";
    return formatted("%s is %.6g %s, %s %.6g %s", stop.probe.c_str(), value, unit.c_str(), stop.above ? "above" : "below", stop.value,
                     unit.c_str());
  }
  if (!(t > memory.time) || std::isnan(value)) return "";
  see(t, value, stop.above ? 1 : -1, memory);
  switch (stop.kind) {
    case StopKind::peak: return peaked(stop, unit.c_str(), memory);
    case StopKind::steady: return steady(stop, unit.c_str(), memory);
    case StopKind::rest: return at_rest(stop, scale, memory);
    case StopKind::level: break;  // above
  }
  return "";
}

std::string wanted_stop(const Simulation& simulation, const dynamics::View& view, std::vector<ConditionMemory>& memories) {
  memories.resize(simulation.stops.size());
  std::string wanted;
  for (std::size_t s = 0; s < memories.size(); ++s) {  // all are shown what there is, also after one that is met
    const Stop& stop = simulation.stops[s];
    std::string here;
    if (stop.kind == StopKind::rest) {
      const dynamics::Ledger& ledger = view.now.ledger;
      here = wanted_stop(stop, view.now.t, ledger.kinetic, "J", dynamics::energy_of_scene(ledger), memories[s]);
    } else {
      const auto named = [&](const auto& one) { return one.name == stop.probe; };
      const auto at = std::find_if(simulation.probes.begin(), simulation.probes.end(), named) - simulation.probes.begin();
      check(at < static_cast<std::ptrdiff_t>(simulation.probes.size()), "a condition to stop has no probe");
      const auto p = static_cast<std::size_t>(at);
      here = wanted_stop(stop, view.now.t, view.now.probes[p].last, simulation.probes[p].unit, 0, memories[s]);
    }
    if (wanted.empty()) wanted = here;
  }
  return wanted;
}

}  // namespace nereid::model
