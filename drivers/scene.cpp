// A whole scene from its case alone: bodies, contacts, loads, probes and conditions, in any number.
//
// Question  What the case asks with its probes.
// Answer    history.csv and summary.json; the syntax is in docs/scene.md
// Run       scene cases/scene/ball_on_plate.yaml --out out/ball_on_plate

#include "drivers/driver.hpp"

using namespace nereid;

model::Simulation build(const input::CaseFile& file) { return input::build(file, input::read_scene(file.root())); }

/// How each probe ended and how far it went.
std::vector<output::Result> results(const model::Simulation& simulation) {
  std::vector<output::Result> all;
  for (const dynamics::Probe& probe : simulation.probes) {
    const dynamics::ProbeMemory& seen = model::probe(simulation, probe.name);
    all.push_back({probe.name + "_last", seen.last, probe.unit});
    all.push_back({probe.name + "_largest", seen.largest, probe.unit});
    all.push_back({probe.name + "_largest_at", seen.time_of_largest, "s"});
    all.push_back({probe.name + "_smallest", seen.smallest, probe.unit});
    all.push_back({probe.name + "_smallest_at", seen.time_of_smallest, "s"});
  }
  return all;
}

int main(int argc, char** argv) { return driver::drive(argc, argv, "scene", build, results); }
