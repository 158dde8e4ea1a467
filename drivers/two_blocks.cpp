// Two equal elastic blocks collide face to face.
//
//      +-------+  v/2     v/2  +-------+      poisson = 0, so each block is exactly
//      |   A   | --->     <--- |   B   |      a one-dimensional bar of wave speed c
//      +-------+               +-------+
//
// Question  Does the interface carry the stress rho c v/2 for the time 2L/c,
//           and do the blocks then part with their velocities exchanged?
// Answer    verification/two_blocks/README.md
// Run       two_blocks cases/two_blocks/bars.yaml --out out/two_blocks

#include <cmath>
#include <numeric>

#include "drivers/driver.hpp"
#include "model/meshes.hpp"

using namespace nereid;

/// Mean velocity of a block along x, as a probe. [m/s]
dynamics::Probe velocity(const std::string& block, const model::Simulation& simulation) {
  const Subset nodes = mesh::node_set(simulation.model.mesh, block);
  return {"velocity_" + block, "m/s", [nodes](const dynamics::View& view, dynamics::Kept&) {
            double momentum = 0, mass = 0;
            for (const Index node : nodes) momentum += view.model.mass(node) * view.now.v(0, node), mass += view.model.mass(node);
            return momentum / mass;
          }};
}

model::Simulation build(const input::CaseFile& file) {
  const input::Section root = file.root(), blocks = root.section("blocks");
  const double length = blocks.quantity("length", dim::length, input::positive),
               width = blocks.quantity("width", dim::length, input::positive),
               gap = blocks.quantity("gap", dim::length, input::not_negative);
  const int along = blocks.count("cells_along", 1, 100000), across = blocks.count("cells_across", 1, 1000);
  const double elements = 2.0 * along * across * across;
  const auto law = input::read_law(root.section("material"));
  const auto element = input::read_hexahedron_options(root.section_or_empty("element"));
  const double speed = root.quantity("closing_speed", dim::speed, input::positive);

  model::Scene scene;
  const auto block = [&](const char* name, const Vec3& corner) {
    return model::Body{.name = name, .mesh = mesh::Box{corner, corner + Vec3(length, width, width), {along, across, across}}, .law = law,
                       .solid = element, .at = "blocks"};
  };
  scene.bodies = {block("A", Vec3::Zero()), block("B", {length + gap, 0, 0})};
  scene.contacts = {{.name = "contact", .apexes = "A.x_high", .base = "B.x_low", .height_from_thickness = false,
                     .interface = input::read_solid_interface(root.section_or_empty("contact")), .at = "contact"}};
  scene.initial = {{.body = "A", .value = model::uniform({speed / 2, 0, 0})}, {.body = "B", .value = model::uniform({-speed / 2, 0, 0})}};
  scene.time = input::read_time(root.section("time"));
  scene.recording = input::read_recording(root.section_or_empty("output"), scene.time.end);
  if (root.sound() && elements > model::most_elements)
    blocks.fault_between({"cells_along", "cells_across"}, "'cells_along' and 'cells_across' make " +
                                                              std::to_string(std::llround(elements)) +
                                                              " elements: expected at most a hundred million");
  const auto stops = input::read_stops(root, {{"interface_stress", "Pa"}, {"velocity_A", "m/s"}, {"velocity_B", "m/s"}}, scene.recording);
  model::Simulation simulation = input::build(file, scene);
  simulation.stops = stops;
  const double area = width * width;
  std::vector<std::size_t> passes(simulation.model.contacts.size());  // of two passes each carries a part of the stress
  std::iota(passes.begin(), passes.end(), std::size_t{0});
  const auto mean_stress = [area, passes](const dynamics::View& view, dynamics::Kept& kept) {
    return -dynamics::mean_contact_force(view, passes, kept).x() / area;
  };
  const auto stress = [area](const dynamics::View& view, dynamics::Kept&) {
    double force = 0;
    for (std::size_t c = 0; c < view.now.contacts.size(); ++c)
      force += contact::side_of(view.model.contacts[c]) * contact::sides(view.now.contacts[c]).force.x();
    return -force / area;
  };
  simulation.probes = {{"interface_stress", "Pa", mean_stress, true}, velocity("A", simulation), velocity("B", simulation),
                       {"", "Pa", stress}};
  return simulation;
}

std::vector<output::Result> results(const model::Simulation& simulation) {
  const auto& seen = simulation.state.probes;  // in the order in which build() added them
  const double duration = seen[3].first_above_zero < 0 ? 0 : seen[3].last_above_zero - seen[3].first_above_zero;
  const double area = std::get<contact::Interface>(simulation.model.contacts[0]).area.sum(), stress_time = seen[3].integral;
  return {{"interface_stress_mean", duration > 0 ? stress_time / duration : 0, "Pa"},
          {"interface_stress_peak", std::max(0.0, seen[0].largest_row), "Pa"},
          {"contact_time", duration, "s"},
          {"impulse", area * stress_time, "N s"},
          {"velocity_A", seen[1].last, "m/s"},
          {"velocity_B", seen[2].last, "m/s"}};
}

int main(int argc, char** argv) { return driver::drive(argc, argv, "two_blocks", build, results); }
