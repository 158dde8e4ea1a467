#include "drivers/plates.hpp"

#include <algorithm>
#include <numeric>

#include "dynamics/measure.hpp"

namespace nereid::driver {

Plates read_plates(const input::Section& section, bool gap_above_last) {
  Plates plates{section.quantities("thicknesses", dim::length, input::positive, gap_above_last ? 1 : 2),
                section.quantities("gaps", dim::length, input::not_negative, 1),
                section.quantity("radius", dim::length, input::positive)};
  const std::size_t gaps = gap_above_last ? plates.size() : std::max<std::size_t>(plates.size(), 1) - 1;
  if (section.sound() && plates.gap.size() != gaps)
    section.fault_between({"gaps", "thicknesses"}, "'gaps' has " + std::to_string(plates.gap.size()) + " lengths: expected " +
                                                       std::to_string(gaps) +
                                                       (gap_above_last ? ", one above each plate" : ", one between each two plates"));
  plates.gap.resize(gaps);
  return plates;
}

double bottom(const Plates& plates, std::size_t i) {
  const auto n = static_cast<std::ptrdiff_t>(i);
  return std::accumulate(plates.thickness.begin(), plates.thickness.begin() + n, 0.0) +
         std::accumulate(plates.gap.begin(), plates.gap.begin() + n, 0.0);
}

std::string numbered(const std::string& what, std::size_t i) { return what + "_" + std::to_string(i + 1); }
std::string plate(std::size_t i) { return numbered("plate", i); }

void add_probes(const std::string& body, const std::string& label, model::Scene& scene) {
  scene.probes.push_back({.name = "velocity_" + label, .quantity = "velocity", .of = body, .component = "z"});
  scene.probes.push_back({.name = "momentum_" + label, .quantity = "momentum", .of = body, .component = "z"});
  scene.probes.push_back({.name = "kinetic_energy_" + label, .quantity = "kinetic_energy", .of = body});
}

void add_force(const std::string& contact, const std::string& label, model::Scene& scene) {
  scene.probes.push_back({.name = "force_" + label, .quantity = "force", .of = contact, .component = "z"});
}

void add_strike(const model::Simulation& simulation, const std::string& contact, const std::string& label, double whole,
                std::vector<output::Result>& all) {
  const auto touched = dynamics::touched(simulation.model, simulation.state);
  const auto at = std::find_if(touched.begin(), touched.end(), [&](const auto& one) { return one.contact == contact; });
  const bool closed = at != touched.end();
  if (closed) all.push_back({"closes_" + label, at->first, "s"});
  all.push_back({"impulse_" + label, closed ? -whole * at->impulse.z() : 0, "N*s"});
  all.push_back({"peak_force_" + label, whole * std::max(0.0, -model::probe(simulation, "force_" + label).smallest_row), "N"});
}

}  // namespace nereid::driver
