// The plugs of a reactor's head are struck from below and close the gaps at their junctures: Kulak & Fiala, section 1.
//
//    axis     |    |           |    |          |    |         |    |
//      .      |    |___     ___|    |___    ___|    |___   ___|    | <- held
//      .  hole| small  |   | intermediate  |  | large   | |  flange|
//      .      |        | 1 |               | 2|         |3|        |       1, 2, 3  junctures: the shoulder of a plug
//      .      |________|   |_______________|  |_________| |________|                 below the ledge of the next one
//             ==========
//             ==========                                                         shield plates, if the case has any
//                 ^ ^ pressure, a block, a slug of sodium or a velocity
//
// Question  When do the gaps close, what is handed from plug to plug, and what moves at the end?
// Answer    docs/reactor_head.md
// Run       plug_juncture cases/plug_juncture/slug.yaml --out out/plug_juncture      head.yaml: with shield plates; sodium.yaml: a slug

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/driver.hpp"
#include "drivers/plates.hpp"
#include "dynamics/measure.hpp"
#include "input/load_readers.hpp"

using namespace nereid;
using driver::numbered, driver::plate;

namespace {

constexpr std::array<const char*, 4> names{"small", "intermediate", "large", "flange"};
constexpr std::size_t junctures = 3;

/// Radii and heights of the head. [m]
struct Head {
  std::array<double, junctures> radii;  ///< of the middles of the ledges
  double hole, outside, height, width, radial_gap, axial_gap;
};

Head read_head(const input::Section& section) {
  Head head{};
  const auto radii = section.vector("juncture_radii", dim::length);
  head.radii = radii;
  head.hole = section.quantity("hole_radius", dim::length, input::positive);
  head.outside = section.quantity("flange_radius", dim::length, input::positive);
  head.height = section.quantity("height", dim::length, input::positive);
  head.width = section.quantity("ledge_width", dim::length, input::positive);
  head.radial_gap = section.quantity("radial_gap", dim::length, input::positive);
  head.axial_gap = section.quantity("axial_gap", dim::length, input::not_negative);
  if (!section.sound()) return head;
  if (!(head.radial_gap < head.width)) section.fault_between({"radial_gap", "ledge_width"}, "'radial_gap' must be below 'ledge_width'");
  std::vector<double> lines{head.hole};
  for (const double radius : head.radii) {
    lines.push_back(radius - head.width / 2);
    lines.push_back(radius + head.width / 2 + head.radial_gap);
  }
  lines.push_back(head.outside);
  if (std::adjacent_find(lines.begin(), lines.end(), [](double a, double b) { return !(a < b); }) != lines.end())
    section.fault("juncture_radii", "'hole_radius', the ledges at 'juncture_radii' and 'flange_radius' must follow each other outwards");
  return head;
}

/// Shield plates below the small plug: rings with its hole. No plates where the case has none.
driver::Plates read_shield_plates(const input::Section& root, const Head& head) {
  if (!root.has("shield_plates")) return {};
  const input::Section section = root.section("shield_plates");
  driver::Plates plates = driver::read_plates(section, true);
  const double most = head.radii[0] + head.width / 2;
  if (section.sound() && !(plates.radius > head.hole && plates.radius <= most))
    section.fault("radius", "'radius' must be above 'hole_radius' of the head and no more than the outer radius of the small plug");
  return plates;
}

/// How much of the turn is modelled, in cells that are alike in all models of a level.
struct Part {
  double angle;  ///< [rad]
  int cells;     ///< around
};

Part part_of(const std::string& kind, int level) {
  const int quarter = 6 * level;
  if (kind == "full") return {2 * pi, 4 * quarter};
  return kind == "quarter" ? Part{pi / 2, quarter} : Part{pi / 2 / quarter, 1};
}

/// Cells of about 0.2 m / level.
int cells_in(double length, int level) { return static_cast<int>(std::clamp(std::round(5 * level * length), 1.0, 1e8)); }

/// The section of plug b, or of the flange: a shoulder outside below half the height, a ledge in the bore above it.
mesh::Revolved section_of(const Head& head, std::size_t b, int level, const Part& part) {
  mesh::Revolved made{{}, {0, head.height / 2, head.height}, {}, {2 * level, 2 * level}, {"", ""}, part.angle, part.cells};
  const auto add = [&](double radius, int cells, char above, char below) {
    made.radii.push_back(radius);
    if (cells > 0) made.cells_radial.push_back(cells), made.filled[0] += above, made.filled[1] += below;
  };
  const double inside = b == 0 ? head.hole : head.radii[b - 1] + head.width / 2 + head.radial_gap;
  if (b > 0) add(inside - head.width, level, 'x', '.');
  const double outside = b == junctures ? head.outside : head.radii[b] - head.width / 2;
  add(inside, cells_in(outside - inside, level), 'x', 'x');
  if (b < junctures) add(outside, level, '.', 'x'), add(outside + head.width, 0, ' ', ' ');
  else add(outside, 0, ' ', ' ');
  return made;
}

/// Number of the line of radii on which a face of plug b lies.
int side_above(std::size_t b) { return b == 0 ? 1 : 2; }
int side_below(std::size_t b) { return side_above(b) + 1; }

std::string face(std::size_t b, const char* word, int line) { return names[b] + std::string(".") + word + std::to_string(line); }

/// Height of the lower face of a plate; that of the small plug is at zero. [m]
double lower_face(const driver::Plates& plates, std::size_t i) { return driver::bottom(plates, i) - driver::bottom(plates, plates.size()); }

mesh::Revolved ring(double hole, double radius, double low, double high, int level, int cells_along, const Part& part) {
  return {{hole, radius}, {low, high}, {cells_in(radius - hole, level)}, {cells_along}, {"x"}, part.angle, part.cells};
}

/// Plates below the small plug, and contacts above each of them.
void add_plates(const driver::Plates& plates, const Head& head, int level, const Part& part, const element::AnyLaw& law,
                const element::AnyHexahedronOptions& element, const dynamics::InterfaceOptions& interface, model::Scene& scene) {
  for (std::size_t i = 0; i < plates.size(); ++i) {
    const double low = lower_face(plates, i);
    const mesh::Revolved made = ring(head.hole, plates.radius, low, low + plates.thickness[i], level, 2 * level, part);
    scene.bodies.push_back({.name = plate(i), .mesh = made, .law = law, .solid = element, .at = "shield_plates"});
    scene.contacts.push_back({.name = numbered("gap_plate", i), .apexes = plate(i) + ".up_1",
                              .base = i + 1 < plates.size() ? plate(i + 1) + ".down_0" : face(0, "down_", 0),
                              .height_from_thickness = false, .interface = interface, .at = "contact"});
  }
}

/// A slug of fluid below what it strikes, between rigid walls along its hole and around it, which reach up to the small plug.
void add_slug(const input::Section& section, const Head& head, double outside, double top, double height, double gap, double speed,
              const std::string& struck, int level, const Part& part, const dynamics::InterfaceOptions& interface, model::Scene& scene) {
  constexpr double thin = 0.05;  // [m] of the walls, which are held: their thickness is of no matter
  const input::Section material = section.section("material");
  model::Body slug{.name = "slug", .mesh = ring(head.hole, outside, top - gap - height, top - gap, level, cells_in(height, level), part),
                   .law = input::read_solid_or_fluid_law(material), .solid = input::read_fluid_options(section.section_or_empty("element")),
                   .at = "struck_by"};
  if (material.sound() && !material::is_fluid(slug.law))
    section.fault("material", "the slug is a fluid: expected mie_gruneisen, linear_fluid");
  scene.bodies.push_back(slug);
  const auto wall = [&](const char* name, double inner, double outer, const char* own, const char* of_slug) {
    const double low = top - gap - height;  // up to the small plug
    scene.bodies.push_back({.name = name, .mesh = ring(inner, outer, low, 0, level, cells_in(-low, level), part),
                            .law = material::Elastic{7850, 200e9, 0.3}, .at = "struck_by"});
    scene.contacts.push_back({.name = std::string("along_") + name, .apexes = std::string("slug.") + of_slug,
                              .base = std::string(name) + "." + own, .height_from_thickness = false, .interface = interface,
                              .at = "contact"});
  };
  wall("core", head.hole - thin, head.hole, "out_1", "in_0"), wall("sleeve", outside, outside + thin, "in_0", "out_1");
  scene.contacts.push_back({.name = "blow", .apexes = "slug.up_1", .base = struck, .height_from_thickness = false, .interface = interface,
                            .at = "contact"});
  scene.initial = {{.body = "slug", .value = model::uniform({0, 0, speed})}};
  driver::add_probes("slug", "slug", scene);
}

/// What strikes the head from below: a pressure on some plugs, a block or a slug under the small one, or a velocity of the lowest plate.
///
/// Plates stand in front of the small plug: what would strike that strikes the lowest of them.
void add_striker(const input::Section& root, const Head& head, const driver::Plates& plates, int level, const Part& part,
                 const element::AnyLaw& steel, const dynamics::InterfaceOptions& interface, model::Scene& scene) {
  const input::Section section = root.section("struck_by");
  const bool plated = root.has("shield_plates");
  std::vector<std::string> kinds{"pressure", "block", "slug"};
  if (plated) kinds.push_back("velocity");
  const std::string kind = section.choice("kind", kinds);
  const bool pressed = kind == "pressure", fluid = kind == "slug", blocked = kind == "block" || fluid;
  const input::Section pressure = section.when(pressed), block = section.when(blocked);
  const bool all = pressure.choice_or("plugs", "small", {"small", "all"}) == "all";
  const auto value = input::read_expression(pressure, "value", input::of_time, input::read_unit(pressure, dim::stress));
  const double speed = section.when(!pressed).quantity("speed", dim::speed, input::positive),
               height = block.quantity("height", dim::length, input::positive),
               gap = block.quantity_or("gap", 1e-3, dim::length, input::not_negative);
  const std::string first = plated ? plate(0) : names[0], struck = first + ".down_0";
  if (pressed) {
    for (std::size_t b = 0; b < (all ? junctures : 1); ++b)
      scene.loads.push_back({.name = "pressure_" + (b == 0 ? first : names[b]), .kind = model::LoadKind::pressure,
                             .on = b == 0 ? struck : face(b, "down_", 0),
                             .value = {value, model::constant(0), model::constant(0)}, .at = "struck_by"});
    return;
  }
  const double outside = plated ? plates.radius : head.radii[0] - head.width / 2, top = lower_face(plates, 0) - gap;
  if (fluid) {
    add_slug(section, head, outside, lower_face(plates, 0), height, gap, speed, struck, level, part, interface, scene);
    return;
  }
  if (blocked) {
    scene.bodies.push_back({.name = "block", .mesh = ring(head.hole, outside, top - height, top, level, cells_in(height, level), part),
                            .law = steel, .at = "struck_by"});
    scene.contacts.push_back({.name = "blow", .apexes = "block.up_1", .base = struck, .height_from_thickness = false,
                              .interface = interface, .at = "contact"});
  }
  scene.initial = {{.body = blocked ? "block" : plate(0), .value = model::uniform({0, 0, speed})}};
}

/// Width by which the shoulder of a plug still lies below the next ledge, where it is least. [m]
double overlap(const dynamics::View& view, const Subset& shoulder, const Subset& ledge) {
  double outside = 1e300, inside = 0;
  const auto radius = [](const Vectors& x, Index node) { return x.col(node).head<2>().norm(); };
  double rim = 0, edge = 1e300;  // of the reference
  for (const Index node : shoulder) rim = std::max(rim, radius(view.model.mesh.X, node));
  for (const Index node : ledge) edge = std::min(edge, radius(view.model.mesh.X, node));
  for (const Index node : shoulder)
    if (radius(view.model.mesh.X, node) > rim * (1 - 1e-9)) outside = std::min(outside, radius(view.now.x, node));
  for (const Index node : ledge)
    if (radius(view.model.mesh.X, node) < edge * (1 + 1e-9)) inside = std::max(inside, radius(view.now.x, node));
  return outside - inside;
}

/// Planes of symmetry, and the rim of the flange that is held.
std::vector<model::Plane> planes_of(const model::Scene& scene, const Part& part, bool full, bool rigid) {
  const auto plane = [&](const std::string& name, const Vec3& normal) {
    model::Plane made{.name = name, .kind = load::PlaneKind::symmetry, .nodes = {}, .normal = normal, .at = "model"};
    for (const model::Body& body : scene.bodies) made.nodes.push_back(body.name + "." + name);
    return made;
  };
  std::vector<model::Plane> planes{{.name = "hold", .kind = load::PlaneKind::constrained, .nodes = {face(junctures, "out_", 2)},
                                    .normal = Vec3::UnitZ(), .at = "head"}};
  if (rigid) planes[0].kind = load::PlaneKind::fixed, planes[0].nodes = {names[junctures]};
  for (const model::Body& body : scene.bodies)
    if (body.name == "core" || body.name == "sleeve")
      planes.push_back({.name = "held_" + body.name, .kind = load::PlaneKind::fixed, .nodes = {body.name}, .at = "struck_by"});
  if (full) return planes;
  planes.push_back(plane("first_plane", mesh::first_plane_normal()));
  planes.push_back(plane("second_plane", mesh::second_plane_normal(part.angle)));
  return planes;
}

/// Radius of the root of the shoulder of plug j. [m]
double root_radius(const Head& head, std::size_t j) { return head.radii[j] - head.width / 2; }

/// Cylinders through the roots of the shoulders, and the shear force that the plug exerts there on its shoulder.
void add_roots(const Head& head, model::Scene& scene) {
  for (std::size_t j = 0; j < junctures; ++j) {
    scene.sections.push_back({.name = numbered("root", j), .body = names[j], .normal = Vec3::UnitZ(), .radius = root_radius(head, j),
                              .at = "head"});
    scene.probes.push_back({.name = numbered("root_force", j), .quantity = "force", .of = numbered("root", j), .component = "z"});
  }
}

void add_probes(const driver::Plates& plates, model::Scene& scene) {
  for (std::size_t j = 0; j < junctures; ++j) {
    const std::string plug = names[j];
    driver::add_force(numbered("ledge", j), std::to_string(j + 1), scene);
    scene.probes.push_back({.name = numbered("gap", j), .quantity = "gap", .of = numbered("ledge", j)});
    driver::add_probes(plug, plug, scene);
    scene.probes.push_back({.name = "rise_" + plug, .quantity = "displacement", .of = plug, .component = "z"});
  }
  scene.probes.push_back({.name = "hold_force", .quantity = "force", .of = "hold", .component = "z"});
  for (std::size_t i = 0; i < plates.size(); ++i) {
    driver::add_force(numbered("gap_plate", i), plate(i), scene);
    driver::add_probes(plate(i), plate(i), scene);
  }
}

struct Asked {
  Head head;
  driver::Plates plates;
  Part part;
  bool rigid;
};

model::Simulation build(const input::CaseFile& file, Asked& asked) {
  const input::Section root = file.root();
  const Head head = read_head(root.section("head"));
  const input::Section whole = root.section("model");
  const std::string kind = whole.choice("kind", {"full", "quarter", "sector"});
  const bool rigid = whole.flag_or("rigid", false);
  if (rigid && kind != "full") whole.fault("kind", "rigid plugs need 'kind: full': a rigid body has no plane of symmetry");
  const int level = root.section("mesh").count("level", 1, 32);
  const Part part = part_of(kind, level);
  const driver::Plates plates = read_shield_plates(root, head);
  asked = {head, plates, part, rigid};
  const auto law = input::read_law(root.section("material"));
  const auto element = input::read_hexahedron_options(root.section_or_empty("element"));
  const dynamics::InterfaceOptions interface = input::read_solid_interface(root.section_or_empty("contact"));

  model::Scene scene;
  for (std::size_t b = 0; b < names.size(); ++b) {
    scene.bodies.push_back({.name = names[b], .mesh = section_of(head, b, level, part), .law = law, .solid = element, .rigid = rigid,
                            .at = "head"});
    scene.bodies.back().place.move = Vec3(0, 0, static_cast<double>(b) * head.axial_gap);
  }
  for (std::size_t j = 0; j < junctures; ++j) {
    const auto touch = [&](const char* what, const std::string& apexes, const std::string& base) {
      scene.contacts.push_back({.name = numbered(what, j), .apexes = apexes, .base = base, .height_from_thickness = false,
                                .interface = interface, .at = "contact"});
    };
    touch("ledge", face(j, "up_", 1), face(j + 1, "down_", 1));
    touch("low", face(j, "out_", side_below(j)), face(j + 1, "in_", 1));
    touch("up", face(j, "out_", side_above(j)), face(j + 1, "in_", 0));
  }
  add_plates(plates, head, level, part, law, element, interface, scene);
  add_striker(root, head, plates, level, part, law, interface, scene);
  scene.planes = planes_of(scene, part, kind == "full", rigid);
  add_probes(plates, scene);
  if (!rigid) add_roots(head, scene);
  scene.time = input::read_time(root.section("time"));
  scene.recording = input::read_recording(root.section_or_empty("output"), scene.time.end);
  scene.stops = input::read_stops(root, input::measured_by(scene.probes), scene.recording);
  model::Simulation simulation = input::build(file, scene);
  for (std::size_t j = 0; j < junctures; ++j) {
    const Subset shoulder = mesh::node_set(simulation.model.mesh, face(j, "up_", 1)),
                 ledge = mesh::node_set(simulation.model.mesh, face(j + 1, "down_", 1));
    simulation.probes.push_back({numbered("overlap", j), "m", [shoulder, ledge](const dynamics::View& view, auto&) {
                                   return overlap(view, shoulder, ledge);
                                 }});
  }
  return simulation;
}

/// Upward momentum at the start, and what pressures have given since. [kg m/s]
double given(const model::Simulation& simulation) {
  const dynamics::Ledger& ledger = simulation.state.ledger;
  const std::vector<Source> sources = dynamics::sources(simulation.model);
  double sum = ledger.initial_momentum.z();
  for (std::size_t k = 0; k < sources.size(); ++k)
    if (sources[k].kind == SourceKind::pressure) sum += ledger.accounts[k].impulse.z();
  return sum;
}

std::vector<output::Result> results(const model::Simulation& simulation, const Asked& asked) {
  const double turns = 2 * pi / asked.part.angle;  // of the model in the whole head
  std::vector<output::Result> all;
  for (std::size_t j = 0; j < junctures; ++j) {
    const std::string number = std::to_string(j + 1);
    driver::add_strike(simulation, numbered("ledge", j), number, turns, all);
    if (!asked.rigid) {
      const double root = 2 * pi * root_radius(asked.head, j) * asked.head.height / 2;  // [m2] of the shoulder
      const double most = std::max(0.0, model::probe(simulation, numbered("root_force", j)).largest_row);
      all.push_back({"root_shear_" + number, turns * most / root, "Pa"});
    }
    all.push_back({"least_overlap_" + number, model::probe(simulation, numbered("overlap", j)).smallest, "m"});
  }
  for (std::size_t i = 0; i < asked.plates.size(); ++i) driver::add_strike(simulation, numbered("gap_plate", i), plate(i), turns, all);
  const auto add_body = [&](const std::string& name) {
    all.push_back({"momentum_" + name, turns * model::probe(simulation, "momentum_" + name).last, "kg m/s"});
    all.push_back({"kinetic_energy_" + name, turns * model::probe(simulation, "kinetic_energy_" + name).last, "J"});
    all.push_back({"velocity_" + name, model::probe(simulation, "velocity_" + name).last, "m/s"});
  };
  for (std::size_t j = 0; j < junctures; ++j) {
    add_body(names[j]);
    all.push_back({std::string("largest_rise_") + names[j], model::probe(simulation, std::string("rise_") + names[j]).largest, "m"});
  }
  const double whole = given(simulation);
  for (std::size_t i = 0; i < asked.plates.size(); ++i) {
    add_body(plate(i));
    all.push_back({"part_of_momentum_" + plate(i), whole != 0 ? model::probe(simulation, "momentum_" + plate(i)).last / whole : 0, "1"});
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  Asked asked{};
  return driver::drive(
      argc, argv, "plug_juncture", [&](const input::CaseFile& file) { return build(file, asked); },
      [&](const model::Simulation& simulation) { return results(simulation, asked); });
}
