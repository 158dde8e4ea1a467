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
#include <numeric>

#include "drivers/driver.hpp"
#include "dynamics/measure.hpp"
#include "input/load_readers.hpp"

using namespace nereid;

namespace {

enum class Kind { rigid, bars, plates };

struct Stack {
  Kind kind = Kind::rigid;
  std::vector<double> thickness, gap;  ///< [m] from below; a gap between each two
  double radius = 0;                   ///< [m]
  bool held = false;                   ///< at the rims
  int level = 1;

  std::size_t plates() const { return thickness.size(); }
  double side() const { return thickness.empty() ? 1 : *std::max_element(thickness.begin(), thickness.end()); }  ///< of a column [m]
  /// What is modelled of the area of the plates. [-]
  double part() const { return kind == Kind::plates ? 0.25 : side() * side() / (pi * radius * radius); }
};

Stack read_stack(const input::Section& root) {
  const std::string word = root.section("model").choice("kind", {"rigid", "bars", "plates"});
  const input::Section section = root.section("stack");
  Stack stack{.kind = word == "rigid" ? Kind::rigid : word == "bars" ? Kind::bars : Kind::plates,
              .thickness = section.quantities("thicknesses", dim::length, input::positive, 2),
              .gap = section.quantities("gaps", dim::length, input::not_negative, 1),
              .radius = section.quantity("radius", dim::length, input::positive)};
  stack.held = section.when(stack.kind == Kind::plates).choice_or("rim", "loose", {"loose", "held"}) == "held";
  stack.level = root.when(stack.kind != Kind::rigid).section_or_empty("mesh").count_or("level", 2, 1, 64);
  if (section.sound() && stack.gap.size() + 1 != stack.thickness.size())
    section.fault_between({"gaps", "thicknesses"}, "'gaps' has " + std::to_string(stack.gap.size()) + " lengths: expected " +
                                                       std::to_string(stack.thickness.size() - 1) + ", one between each two plates");
  return stack;
}

std::string plate(std::size_t i) { return "plate_" + std::to_string(i + 1); }
std::string numbered(const char* what, std::size_t i) { return what + std::string("_") + std::to_string(i + 1); }

/// Where the lower face of a plate is. [m]
double bottom(const Stack& stack, std::size_t i) {
  const auto n = static_cast<std::ptrdiff_t>(i);
  return std::accumulate(stack.thickness.begin(), stack.thickness.begin() + n, 0.0) +
         std::accumulate(stack.gap.begin(), stack.gap.begin() + n, 0.0);
}

std::vector<model::Body> bodies_of(const Stack& stack, const element::AnyLaw& law) {
  std::vector<model::Body> bodies;
  const double thinnest = *std::min_element(stack.thickness.begin(), stack.thickness.end());
  for (std::size_t i = 0; i < stack.plates(); ++i) {
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
    for (std::size_t i = 0; i < stack.plates(); ++i) planes.back().nodes.push_back(plate(i) + ending);
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
  for (std::size_t i = 0; i < stack.plates(); ++i) {
    scene.probes.push_back({.name = numbered("velocity", i), .quantity = "velocity", .of = plate(i), .component = "z"});
    scene.probes.push_back({.name = numbered("momentum", i), .quantity = "momentum", .of = plate(i), .component = "z"});
    scene.probes.push_back({.name = numbered("kinetic_energy", i), .quantity = "kinetic_energy", .of = plate(i)});
  }
  for (std::size_t i = 0; i + 1 < stack.plates(); ++i)
    scene.probes.push_back({.name = numbered("force", i), .quantity = "force", .of = numbered("gap", i), .component = "z"});
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
  for (std::size_t i = 0; i + 1 < stack.plates(); ++i)
    scene.contacts.push_back({.name = numbered("gap", i), .apexes = plate(i) + (bends ? ".top" : ".z_high"),
                              .base = plate(i + 1) + (bends ? ".bottom" : ".z_low"), .height_from_thickness = bends,
                              .interface = interface, .at = "contact"});
  add_striker(striker, stack, scene);
  add_probes(stack, scene);
  scene.time = input::read_time(root.section("time"));
  scene.recording = input::read_recording(root.section_or_empty("output"), scene.time.end);
  scene.stops = input::read_stops(root, input::measured_by(scene.probes), scene.recording);
  model::Simulation simulation = input::build(file, scene);
  for (std::size_t i = 0; bends && i < stack.plates(); ++i) {
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
  const auto touched = dynamics::touched(simulation.model, simulation.state);
  std::vector<output::Result> all;
  for (std::size_t i = 0; i + 1 < stack.plates(); ++i) {
    const auto at = std::find_if(touched.begin(), touched.end(), [&](const auto& one) { return one.contact == numbered("gap", i); });
    if (at != touched.end()) all.push_back({numbered("closes", i), at->first, "s"});
    all.push_back({numbered("impulse", i), at != touched.end() ? -at->impulse.z() / stack.part() : 0, "N*s"});
    all.push_back({numbered("peak_force", i), std::max(0.0, -model::probe(simulation, numbered("force", i)).smallest) / stack.part(), "N"});
  }
  double momentum = 0;
  for (std::size_t i = 0; i < stack.plates(); ++i) momentum += model::probe(simulation, numbered("momentum", i)).last;
  for (std::size_t i = 0; i < stack.plates(); ++i) {
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
