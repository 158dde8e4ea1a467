// A stack of plates with gaps, as the shield plates below a reactor's head, is struck at its lowest plate: Kulak & Fiala, section 1.
//
//      ===================  4          rigid   rigid bodies: a chain of collisions
//      ===================  3          bars    a column of bricks in uniaxial strain: waves with steps of impedance
//      ===================  2   gaps   plates  discs of plates that bend, with loose or held rims
//      ===================  1
//        ^   ^   ^   ^   ^
//
// Question  When do the gaps close, what is handed on, and what do the first and the last plate keep?
// Answer    docs/reactor_head.md
// Run       shield_plates cases/shield_plates/rigid.yaml --out out/shield_plates

#include <algorithm>
#include <cmath>

#include "drivers/driver.hpp"
#include "drivers/plates.hpp"
#include "dynamics/measure.hpp"
#include "input/load_readers.hpp"

using namespace nereid;
using driver::numbered, driver::plate;

namespace {

enum class Kind { rigid, bars, plates };

struct Stack : driver::Plates {
  Kind kind = Kind::rigid;
  bool held = false;  ///< at the rims
  int level = 1;

  double side() const { return thickness.empty() ? 1 : *std::max_element(thickness.begin(), thickness.end()); }  ///< of a column [m]
  /// What is modelled of the area of the plates. [-]
  double part() const { return kind == Kind::plates ? 0.25 : side() * side() / (pi * radius * radius); }
};

Stack read_stack(const input::Section& root) {
  const std::string word = root.section("model").choice("kind", {"rigid", "bars", "plates"});
  const input::Section section = root.section("stack");
  Stack stack{driver::read_plates(section, false), word == "rigid" ? Kind::rigid : word == "bars" ? Kind::bars : Kind::plates};
  stack.held = section.when(stack.kind == Kind::plates).choice_or("rim", "loose", {"loose", "held"}) == "held";
  stack.level = root.when(stack.kind != Kind::rigid).section_or_empty("mesh").count_or("level", 2, 1, 64);
  return stack;
}

std::vector<model::Body> bodies_of(const Stack& stack, const element::AnyLaw& law) {
  std::vector<model::Body> bodies;
  const double thinnest = *std::min_element(stack.thickness.begin(), stack.thickness.end());
  for (std::size_t i = 0; i < stack.size(); ++i) {
    const double thickness = stack.thickness[i], low = bottom(stack, i), side = stack.side();
    const double wanted = std::round(10 * stack.level * thickness / thinnest);
    const int cells = stack.kind == Kind::rigid ? 1 : static_cast<int>(std::clamp(wanted, 1.0, 1e8));
    model::Body body{.name = plate(i), .mesh = mesh::Box{Vec3(0, 0, low), Vec3(side, side, low + thickness), {1, 1, cells}}, .law = law,
                     .rigid = stack.kind == Kind::rigid, .at = "stack"};
    if (stack.kind == Kind::plates) {
      body.mesh = mesh::Disc{stack.radius, mesh::Revolution::quarter, 3 * stack.level, 3 * stack.level};
      body.place.move = Vec3(0, 0, low + thickness / 2);
      body.plate.thickness = thickness;
    }
    bodies.push_back(body);
  }
  return bodies;
}

std::vector<model::Plane> planes_of(const Stack& stack) {
  std::vector<model::Plane> planes;
  const auto add = [&](const std::string& name, load::PlaneKind kind, const std::string& ending, const Vec3& normal) {
    planes.push_back({.name = name, .kind = kind, .nodes = {}, .normal = normal, .at = "stack"});
    for (std::size_t i = 0; i < stack.size(); ++i) planes.back().nodes.push_back(plate(i) + ending);
  };
  using load::PlaneKind;
  if (stack.kind == Kind::plates) {
    add("x_plane", PlaneKind::symmetry, ".x_plane", -Vec3::UnitX()), add("y_plane", PlaneKind::symmetry, ".y_plane", -Vec3::UnitY());
    if (stack.held) add("rim", PlaneKind::constrained, ".rim", Vec3::UnitZ());
  } else if (stack.kind == Kind::bars) {  // no strain across the column
    add("x_low", PlaneKind::symmetry, ".x_low", -Vec3::UnitX()), add("y_low", PlaneKind::symmetry, ".y_low", -Vec3::UnitY());
    add("x_high", PlaneKind::symmetry, ".x_high", Vec3::UnitX()), add("y_high", PlaneKind::symmetry, ".y_high", Vec3::UnitY());
  }
  return planes;
}

void add_striker(const input::Section& section, const Stack& stack, model::Scene& scene) {
  const bool pressed = section.choice("kind", {"velocity", "pressure"}) == "pressure";
  const input::Section pressure = section.when(pressed);
  const auto value = input::read_expression(pressure, "value", input::of_time, input::read_unit(pressure, dim::stress));
  const double speed = section.when(!pressed).quantity("speed", dim::speed, input::positive);
  const std::string below = plate(0) + (stack.kind == Kind::plates ? ".bottom" : ".z_low");
  if (pressed)
    scene.loads = {{.name = "pressure", .kind = model::LoadKind::pressure, .on = below,
                    .value = {value, model::constant(0), model::constant(0)}, .at = "struck_by"}};
  else
    scene.initial = {{.body = plate(0), .value = model::uniform({0, 0, speed})}};
}

void add_probes(const Stack& stack, model::Scene& scene) {
  for (std::size_t i = 0; i < stack.size(); ++i) driver::add_probes(plate(i), std::to_string(i + 1), scene);
  for (std::size_t i = 0; i + 1 < stack.size(); ++i) driver::add_force(numbered("gap", i), std::to_string(i + 1), scene);
}

model::Simulation build(const input::CaseFile& file, Stack& asked) {
  const input::Section root = file.root();
  const Stack stack = asked = read_stack(root);
  const bool bends = stack.kind == Kind::plates;
  const auto law = bends ? input::read_plate_law(root.section("material")) : input::read_law(root.section("material"));
  const dynamics::InterfaceOptions interface = input::read_solid_interface(root.section_or_empty("contact"));
  model::Scene scene;
  const input::Section striker = root.section("struck_by");
  if (root.sound()) scene.bodies = bodies_of(stack, law);
  scene.planes = planes_of(stack);
  for (std::size_t i = 0; i + 1 < stack.size(); ++i)
    scene.contacts.push_back({.name = numbered("gap", i), .apexes = plate(i) + (bends ? ".top" : ".z_high"),
                              .base = plate(i + 1) + (bends ? ".bottom" : ".z_low"), .height_from_thickness = bends,
                              .interface = interface, .at = "contact"});
  add_striker(striker, stack, scene);
  add_probes(stack, scene);
  scene.time = input::read_time(root.section("time"));
  scene.recording = input::read_recording(root.section_or_empty("output"), scene.time.end);
  scene.stops = input::read_stops(root, input::measured_by(scene.probes), scene.recording);
  model::Simulation simulation = input::build(file, scene);
  for (std::size_t i = 0; bends && i < stack.size(); ++i) {
    const Subset centre = mesh::node_set(simulation.model.mesh, plate(i) + ".centre"),
                 rim = mesh::node_set(simulation.model.mesh, plate(i) + ".rim");
    simulation.probes.push_back({numbered("deflection", i), "m", [centre, rim](const dynamics::View& view, auto&) -> double {
                                   return dynamics::mean_displacement(view, centre).z() - dynamics::mean_displacement(view, rim).z();
                                 }});
  }
  return simulation;
}

/// All of the plates: what is modelled, over its part of their area.
std::vector<output::Result> results(const model::Simulation& simulation, const Stack& stack) {
  std::vector<output::Result> all;
  for (std::size_t i = 0; i + 1 < stack.size(); ++i)
    driver::add_strike(simulation, numbered("gap", i), std::to_string(i + 1), 1 / stack.part(), all);
  double momentum = 0;
  for (std::size_t i = 0; i < stack.size(); ++i) momentum += model::probe(simulation, numbered("momentum", i)).last;
  for (std::size_t i = 0; i < stack.size(); ++i) {
    const auto& of_plate = model::probe(simulation, numbered("momentum", i));
    all.push_back({numbered("velocity", i), model::probe(simulation, numbered("velocity", i)).last, "m/s"});
    all.push_back({numbered("momentum", i), of_plate.last / stack.part(), "kg m/s"});
    if (!stack.held) all.push_back({numbered("part_of_momentum", i), momentum != 0 ? of_plate.last / momentum : 0, "1"});
    all.push_back({numbered("kinetic_energy", i), model::probe(simulation, numbered("kinetic_energy", i)).last / stack.part(), "J"});
    if (stack.kind != Kind::plates) continue;
    const auto& deflection = model::probe(simulation, numbered("deflection", i));
    all.push_back({numbered("largest_deflection", i), deflection.largest, "m"});
    all.push_back({numbered("last_deflection", i), deflection.last, "m"});
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  Stack stack;
  return driver::drive(
      argc, argv, "shield_plates", [&](const input::CaseFile& file) { return build(file, stack); },
      [&](const model::Simulation& simulation) { return results(simulation, stack); });
}
