// The plugs of a reactor's head are struck from below and close the gaps at their junctures: Kulak & Fiala, section 1.
//
//    axis     |    |           |    |          |    |         |    |
//      .      |    |___     ___|    |___    ___|    |___   ___|    | <- held
//      .  hole| small  |   | intermediate  |  | large   | |  flange|
//      .      |        | 1 |               | 2|         |3|        |       1, 2, 3  junctures: the shoulder of a plug
//      .      |________|   |_______________|  |_________| |________|                 below the ledge of the next one
//                 ^ ^ pressure or a block
//
// Question  When do the gaps close, what is handed from plug to plug, and what moves at the end?
// Answer    docs/reactor_head.md
// Run       plug_juncture cases/plug_juncture/slug.yaml --out out/plug_juncture

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/driver.hpp"
#include "dynamics/measure.hpp"
#include "input/load_readers.hpp"

using namespace nereid;

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

std::string name_of(const char* what, std::size_t juncture) { return what + std::string("_") + std::to_string(juncture + 1); }

std::string face(std::size_t b, const char* word, int line) { return names[b] + std::string(".") + word + std::to_string(line); }

/// What strikes the head from below: a pressure on some plugs, or a block under the small one.
void add_striker(const input::Section& section, const Head& head, int level, const Part& part, const element::AnyLaw& steel,
                 const dynamics::InterfaceOptions& interface, model::Scene& scene) {
  const bool pressed = section.choice("kind", {"pressure", "block"}) == "pressure";
  const input::Section pressure = section.when(pressed), block = section.when(!pressed);
  const bool all = pressure.choice_or("plugs", "small", {"small", "all"}) == "all";
  const auto value = input::read_expression(pressure, "value", input::of_time, input::read_unit(pressure, dim::stress));
  const double speed = block.quantity("speed", dim::speed, input::positive),
               height = block.quantity("height", dim::length, input::positive),
               gap = block.quantity_or("gap", 1e-3, dim::length, input::not_negative);
  if (pressed) {
    for (std::size_t b = 0; b < (all ? junctures : 1); ++b)
      scene.loads.push_back({.name = "pressure_" + std::string(names[b]), .kind = model::LoadKind::pressure, .on = face(b, "down_", 0),
                             .value = {value, model::constant(0), model::constant(0)}, .at = "struck_by"});
    return;
  }
  const double outside = head.radii[0] - head.width / 2;
  const mesh::Revolved ring{{head.hole, outside}, {-gap - height, -gap}, {cells_in(outside - head.hole, level)}, {cells_in(height, level)},
                            {"x"}, part.angle, part.cells};
  scene.bodies.push_back({.name = "block", .mesh = ring, .law = steel, .at = "struck_by"});
  scene.contacts.push_back({.name = "blow", .apexes = "block.up_1", .base = face(0, "down_", 0), .height_from_thickness = false,
                            .interface = interface, .at = "contact"});
  scene.initial = {{.body = "block", .value = model::uniform({0, 0, speed})}};
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
std::vector<model::Plane> planes_of(const model::Scene& scene, const Part& part, bool full) {
  const auto plane = [&](const std::string& name, const Vec3& normal) {
    model::Plane made{.name = name, .kind = load::PlaneKind::symmetry, .nodes = {}, .normal = normal, .at = "model"};
    for (const model::Body& body : scene.bodies) made.nodes.push_back(body.name + "." + name);
    return made;
  };
  std::vector<model::Plane> planes{{.name = "hold", .kind = load::PlaneKind::constrained, .nodes = {face(junctures, "out_", 2)},
                                    .normal = Vec3::UnitZ(), .at = "head"}};
  if (full) return planes;
  planes.push_back(plane("first_plane", mesh::first_plane_normal()));
  planes.push_back(plane("second_plane", mesh::second_plane_normal(part.angle)));
  return planes;
}

std::vector<model::Probe> probes_of_scene() {
  std::vector<model::Probe> probes;
  for (std::size_t j = 0; j < junctures; ++j) {
    const std::string plug = names[j];
    probes.push_back({.name = name_of("force", j), .quantity = "force", .of = name_of("ledge", j), .component = "z"});
    probes.push_back({.name = name_of("gap", j), .quantity = "gap", .of = name_of("ledge", j)});
    probes.push_back({.name = "velocity_" + plug, .quantity = "velocity", .of = plug, .component = "z"});
    probes.push_back({.name = "momentum_" + plug, .quantity = "momentum", .of = plug, .component = "z"});
    probes.push_back({.name = "kinetic_energy_" + plug, .quantity = "kinetic_energy", .of = plug});
    probes.push_back({.name = "rise_" + plug, .quantity = "displacement", .of = plug, .component = "z"});
  }
  probes.push_back({.name = "hold_force", .quantity = "force", .of = "hold", .component = "z"});
  return probes;
}

struct Asked {
  Head head;
  Part part;
};

model::Simulation build(const input::CaseFile& file, Asked& asked) {
  const input::Section root = file.root();
  const Head head = read_head(root.section("head"));
  const std::string kind = root.section("model").choice("kind", {"full", "quarter", "sector"});
  const int level = root.section("mesh").count("level", 1, 32);
  const Part part = part_of(kind, level);
  asked = {head, part};
  const auto law = input::read_law(root.section("material"));
  const auto element = input::read_hexahedron_options(root.section_or_empty("element"));
  const dynamics::InterfaceOptions interface = input::read_solid_interface(root.section_or_empty("contact"));

  model::Scene scene;
  for (std::size_t b = 0; b < names.size(); ++b) {
    scene.bodies.push_back({.name = names[b], .mesh = section_of(head, b, level, part), .law = law, .solid = element, .at = "head"});
    scene.bodies.back().place.move = Vec3(0, 0, static_cast<double>(b) * head.axial_gap);
  }
  for (std::size_t j = 0; j < junctures; ++j) {
    const auto touch = [&](const char* what, const std::string& apexes, const std::string& base) {
      scene.contacts.push_back({.name = name_of(what, j), .apexes = apexes, .base = base, .height_from_thickness = false,
                                .interface = interface, .at = "contact"});
    };
    touch("ledge", face(j, "up_", 1), face(j + 1, "down_", 1));
    touch("low", face(j, "out_", side_below(j)), face(j + 1, "in_", 1));
    touch("up", face(j, "out_", side_above(j)), face(j + 1, "in_", 0));
  }
  add_striker(root.section("struck_by"), head, level, part, law, interface, scene);
  scene.planes = planes_of(scene, part, kind == "full");
  scene.probes = probes_of_scene();
  scene.time = input::read_time(root.section("time"));
  scene.recording = input::read_recording(root.section_or_empty("output"), scene.time.end);
  scene.stops = input::read_stops(root, input::measured_by(scene.probes), scene.recording);
  model::Simulation simulation = input::build(file, scene);
  for (std::size_t j = 0; j < junctures; ++j) {
    const Subset shoulder = mesh::node_set(simulation.model.mesh, face(j, "up_", 1)),
                 ledge = mesh::node_set(simulation.model.mesh, face(j + 1, "down_", 1));
    simulation.probes.push_back({name_of("overlap", j), "m", [shoulder, ledge](const dynamics::View& view, auto&) {
                                   return overlap(view, shoulder, ledge);
                                 }});
  }
  return simulation;
}

std::vector<output::Result> results(const model::Simulation& simulation, const Asked& asked) {
  const double turns = 2 * pi / asked.part.angle;  // of the model in the whole head
  const auto touched = dynamics::touched(simulation.model, simulation.state);
  std::vector<output::Result> all;
  for (std::size_t j = 0; j < junctures; ++j) {
    const std::string number = std::to_string(j + 1);
    const auto at = std::find_if(touched.begin(), touched.end(), [&](const auto& one) { return one.contact == name_of("ledge", j); });
    const bool closed = at != touched.end();
    if (closed) all.push_back({"closes_" + number, at->first, "s"});
    const double impulse = closed ? -at->impulse.z() : 0, peak = -model::probe(simulation, name_of("force", j)).smallest;
    const double root = 2 * pi * (asked.head.radii[j] - asked.head.width / 2) * asked.head.height / 2;  // [m2] of the shoulder
    all.push_back({"impulse_" + number, turns * impulse, "N*s"});
    all.push_back({"peak_force_" + number, turns * std::max(0.0, peak), "N"});
    all.push_back({"ledge_shear_" + number, turns * std::max(0.0, peak) / root, "Pa"});
    all.push_back({"least_overlap_" + number, model::probe(simulation, name_of("overlap", j)).smallest, "m"});
  }
  for (std::size_t j = 0; j < junctures; ++j) {
    const std::string name = names[j];
    all.push_back({"momentum_" + name, turns * model::probe(simulation, "momentum_" + name).last, "kg m/s"});
    all.push_back({"kinetic_energy_" + name, turns * model::probe(simulation, "kinetic_energy_" + name).last, "J"});
    all.push_back({"velocity_" + name, model::probe(simulation, "velocity_" + name).last, "m/s"});
    all.push_back({"largest_rise_" + name, model::probe(simulation, "rise_" + name).largest, "m"});
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
