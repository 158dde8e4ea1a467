// A bar of steel flies against a rigid wall: the scene of bar_on_a_wall.yaml in C++. All values are in SI units.
#include <nereid/model/build.hpp>

#include <cstdio>

using namespace nereid;

int main() try {
  model::Scene scene;
  scene.bodies = {{.name = "bar",
                   .mesh = mesh::Box{Vec3(0, 0, 0), Vec3(0.5, 0.05, 0.05), {20, 2, 2}},
                   .law = material::Elastic{7850, 210e9, 0.3}}};
  scene.rigid_planes = {{.name = "wall", .surface = "bar.x_low", .normal = Vec3::UnitX()}};
  scene.initial = {{.body = "bar", .value = model::uniform(Vec3(-10, 0, 0))}};
  scene.probes = {{.name = "push", .quantity = "force", .of = "wall", .component = "x"},
                  {.name = "speed", .quantity = "velocity", .of = "bar", .component = "x"}};
  scene.time.end = 0.4e-3;

  model::Simulation simulation = model::build(scene);
  const dynamics::Outcome outcome = model::run(simulation);
  for (const dynamics::Probe& probe : simulation.probes) {
    const dynamics::ProbeMemory& seen = model::probe(simulation, probe.name);
    std::printf("%s: at the end %.17g, largest %.17g %s\n", probe.name.c_str(), seen.last, seen.largest, probe.unit.c_str());
  }
  return dynamics::good(outcome.ending) ? 0 : 3;
} catch (const model::SceneError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
