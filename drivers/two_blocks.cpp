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
#include <memory>
#include <string>

#include "drivers/driver.hpp"
#include "mesh/box.hpp"

using namespace nereid;

struct Case {
  double length, width, gap;  // [m]
  int cells_along, cells_across;
  element::AnyLaw material;
  element::AnyHexahedronOptions element;
  double closing_speed;       // [m/s]
  dynamics::InterfaceOptions contact;
  dynamics::Time time;
  input::Recording recording;
};

constexpr double most_elements = 1e8;  // their memory is some 100 GB, and node numbers still fit an Index

Case read(const input::Section& root) {
  const auto blocks = root.section("blocks");
  const auto time = root.section("time");
  Case c{.length = blocks.quantity("length", dim::length, input::positive),
         .width = blocks.quantity("width", dim::length, input::positive),
         .gap = blocks.quantity("gap", dim::length, input::not_negative),
         .cells_along = blocks.count("cells_along", 1, 100000),
         .cells_across = blocks.count("cells_across", 1, 1000),
         .material = input::read_law(root.section("material")),
         .element = input::read_hexahedron_options(root.section_or_empty("element")),
         .closing_speed = root.quantity("closing_speed", dim::speed, input::positive),
         .contact = input::read_solid_interface(root.section_or_empty("contact")),
         .time = input::read_time(time),
         .recording = {}};
  c.recording = input::read_recording(root.section_or_empty("output"), c.time.end);
  const double elements = 2.0 * c.cells_along * c.cells_across * c.cells_across;
  if (root.sound() && elements > most_elements)
    blocks.fault("cells_along", "'cells_along' and 'cells_across' make " + std::to_string(std::llround(elements)) +
                                    " elements: expected at most a hundred million");
  return c;
}

/// Mean velocity of a block along x. [m/s]
double velocity(const dynamics::View& view, const Subset& nodes) {
  double momentum = 0, mass = 0;
  for (const Index node : nodes) momentum += view.model.mass(node) * view.now.v(0, node), mass += view.model.mass(node);
  return momentum / mass;
}

driver::Scene build(const input::CaseFile& file) {
  const Case c = read(file.root());
  file.finish();
  driver::Scene scene{.model = {}, .state = {}, .forces = {}, .gaps = {}, .time = c.time, .recording = c.recording,
                      .probes = {}, .watchers = {}, .results = {}};
  dynamics::Model& model = scene.model;
  const Eigen::Vector3i cells{c.cells_along, c.cells_across, c.cells_across};
  const Vec3 size{c.length, c.width, c.width}, right{c.length + c.gap, 0, 0};
  model.mesh = mesh::join(mesh::box("A", {Vec3::Zero(), size, cells}), mesh::box("B", {right, right + size, cells}));
  for (const char* name : {"A", "B"}) model.blocks.push_back(element::solids(model.mesh, name, c.material, c.element));
  dynamics::finish(model);
  std::vector<dynamics::Connected> connected = dynamics::connect(model, "contact", "A.x_high", "B.x_low", c.contact);
  driver::make_ready(scene, std::move(connected));

  const Subset A = mesh::node_set(model.mesh, "A"), B = mesh::node_set(model.mesh, "B");
  for (const Index node : A) scene.state.v(0, node) = c.closing_speed / 2;
  for (const Index node : B) scene.state.v(0, node) = -c.closing_speed / 2;

  const double area = c.width * c.width;
  const auto stress = [area](const dynamics::View& view) {
    double force = 0;
    for (const auto& element : view.now.interfaces[0].elements) force -= element.apex.x();
    return force / area;
  };
  struct Seen {
    double impulse = 0, peak = 0, first = -1, last = 0, velocity_A = 0, velocity_B = 0;
  };
  const auto seen = std::make_shared<Seen>();
  scene.probes = {{"interface_stress", "Pa", stress},
                  {"velocity_A", "m/s", [A](const auto& view) { return velocity(view, A); }},
                  {"velocity_B", "m/s", [B](const auto& view) { return velocity(view, B); }}};
  scene.watchers.emplace_back([=](const dynamics::View& view) {
    const double now = stress(view);
    seen->impulse += now * area * view.now.dt;
    seen->peak = std::max(seen->peak, now);
    if (now > 0 && seen->first < 0) seen->first = view.now.t;
    if (now > 0) seen->last = view.now.t;
    if (view.ledger_is_current) seen->velocity_A = velocity(view, A), seen->velocity_B = velocity(view, B);
  });
  scene.results = [=] {
    const double duration = seen->first < 0 ? 0 : seen->last - seen->first;
    return std::vector<output::Result>{
        {"interface_stress_mean", duration > 0 ? seen->impulse / area / duration : 0, "Pa"},
        {"interface_stress_peak", seen->peak, "Pa"},
        {"contact_time", duration, "s"},
        {"impulse", seen->impulse, "N s"},
        {"velocity_A", seen->velocity_A, "m/s"},
        {"velocity_B", seen->velocity_B, "m/s"}};
  };
  return scene;
}

int main(int argc, char** argv) { return driver::drive(argc, argv, "two_blocks", build); }
