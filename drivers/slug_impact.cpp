// A slug of sodium is driven up a vessel through a gap and strikes the head: Kulak & Fiala, section 1.
//
//      =====================   head: rigid, or a plate that is clamped
//      |                   |
//      |        gap        |   nothing, or a gas
//      |___________________|
//      |                   |
//      |   slug    ^       |   wall: rigid, or plates that are clamped at both ends
//      |           |       |
//      |___________________|
//             ^  ^  ^          a velocity, a pressure over time, or a bubble: a pressure over its volume
//
// Question  When does the slug strike, how hard, how does the head move, and where does the energy go?
// Answer    docs/slug_impact.md
// Run       slug_impact cases/slug_impact/rigid.yaml --out out/slug_impact       plate.yaml, bubble.yaml

#include <algorithm>
#include <cmath>

#include "drivers/driver.hpp"
#include "drivers/plates.hpp"
#include "dynamics/measure.hpp"
#include "input/load_readers.hpp"
#include "model/values.hpp"

using namespace nereid;

namespace {

/// How much of the turn is modelled, and cells, which are as wide in all models of a level.
struct Part {
  std::string kind;
  mesh::Revolution turn;
  int level, around;
  double angle;  ///< [rad]
};

Part read_part(const input::Section& model, const input::Section& mesh) {
  Part part{.kind = model.choice("kind", {"full", "quarter", "sector"}), .turn = {}, .level = 1, .around = 1, .angle = 2 * pi};
  const bool sector = part.kind == "sector";
  part.around = model.when(sector).count_or("cells_around", 1, 1, 128);
  part.level = mesh.count("level", 1, 64);
  part.turn = part.kind == "quarter" ? mesh::Revolution::quarter : mesh::Revolution::full;
  if (part.kind == "quarter") part.angle = pi / 2;
  if (sector) part.angle = part.around * pi / (4 * part.level);
  return part;
}

/// per  cells along a radius and level
int cells_along(const Part& part, double length, double radius, double per) {
  return static_cast<int>(std::clamp(std::round(per * part.level * length / radius), 1.0, 1e6));
}

model::MeshOptions column(const Part& part, double radius, double length) {
  const int n = part.level, along = cells_along(part, length, radius, 3);  // nodes that touch the wall stand closer than its own
  if (part.kind == "sector") return mesh::Wedge{radius, length, part.angle, part.around, 2 * n, along};
  return mesh::Cylinder{radius, length, part.turn, n, n, along};
}
model::MeshOptions shell(const Part& part, double radius, double length) {
  const int along = cells_along(part, length, radius, 2);
  if (part.kind == "sector") return mesh::WedgeTube{radius, length, part.angle, part.around, along};
  return mesh::Tube{radius, length, part.turn, part.level, along};
}
model::MeshOptions disc(const Part& part, double radius) {
  if (part.kind == "sector") return mesh::WedgeDisc{radius, part.angle, part.around, 2 * part.level};
  return mesh::Disc{radius, part.turn, part.level, part.level};
}

/// A body of plates: where it is rigid its nodes are fixed, and its thickness and material are of no matter.
model::Body read_plates(const input::Section& section, const std::string& name, bool rigid) {
  const input::Section given = section.when(!rigid);
  model::Body body{.name = name, .mesh = {}, .law = input::read_plate_law(given.section("material")), .at = name};
  body.plate = input::read_plate_options(given);
  if (!rigid) return body;
  body.law = material::Elastic{7850, 200e9, 0.3};
  body.plate = {};
  body.plate.thickness = 1e-2;
  return body;
}

struct Asked {
  double turns = 1;        ///< of the model in the whole vessel
  double area = 0;         ///< [m2] of the head that is modelled
  double impedance = 0;    ///< [kg/(m2 s)] of the slug
  double slope = 0;        ///< [-] of the shock velocity
  double sound_speed = 0;  ///< [m/s]
  double height = 0;       ///< [m] of the slug
  bool rigid_head = false, rigid_wall = false, with_gas = false;
};

/// turns  of the model in the whole vessel: volumes of bubbles are those of the whole
void drive_slug(const input::Section& section, double turns, model::Scene& scene) {
  const std::string kind = section.choice("kind", {"velocity", "pressure", "bubble"});
  const double speed = section.when(kind == "velocity").quantity("speed", dim::speed, input::positive);
  const input::Section pressed = section.when(kind != "velocity");
  const double volume = section.when(kind == "bubble").quantity("volume", dim::volume, input::positive);
  const input::InUnit unit = input::read_unit(pressed, dim::stress);
  const auto value = input::read_expression(pressed, "value", kind == "bubble" ? input::of_volume : input::of_time, unit);
  if (kind == "velocity") {
    scene.initial = {{.body = "slug", .value = model::uniform({0, 0, speed})}};
    return;
  }
  const bool is_bubble = kind == "bubble";
  const load::OverSpace of_part = [value, turns](double x, double y, double z, double v) { return value(x, y, z, turns * v); };
  scene.loads.push_back({.name = "drive", .kind = is_bubble ? model::LoadKind::bubble : model::LoadKind::pressure, .on = "slug.bottom",
                         .value = {is_bubble ? of_part : load::OverSpace(value), model::constant(0), model::constant(0)},
                         .volume = volume / turns, .at = "driven_by"});
}

std::vector<model::Plane> planes_of(const model::Scene& scene, const Part& part, const Asked& asked) {
  const auto plane = [&](const std::string& name, const Vec3& normal) {
    model::Plane made{.name = name, .kind = load::PlaneKind::symmetry, .nodes = {}, .normal = normal, .at = "model"};
    for (const model::Body& body : scene.bodies) made.nodes.push_back(body.name + "." + name);
    return made;
  };
  std::vector<model::Plane> planes{{.name = "hold", .kind = load::PlaneKind::fixed, .nodes = {}, .at = "vessel"}};
  planes[0].nodes = {asked.rigid_head ? "head" : "head.rim"};
  if (asked.rigid_wall) planes[0].nodes.push_back("wall");
  else planes[0].nodes.insert(planes[0].nodes.end(), {"wall.bottom", "wall.top"});
  if (part.kind == "quarter") planes.insert(planes.end(), {plane("x_plane", Vec3::UnitX()), plane("y_plane", Vec3::UnitY())});
  if (part.kind == "sector")
    planes.insert(planes.end(), {plane("first_plane", mesh::first_plane_normal()),
                                 plane("second_plane", mesh::second_plane_normal(part.angle))});
  return planes;
}

void add_probes(const Asked& asked, bool with_gas, model::Scene& scene) {
  driver::add_force("impact", "head", scene);
  driver::add_probes("slug", "slug", scene);
  const auto add = [&](const char* name, const char* quantity, const char* of, const char* along, bool largest) {
    scene.probes.push_back({.name = name, .quantity = quantity, .of = of, .component = along, .largest = largest});
  };
  add("largest_pressure_slug", "pressure", "slug", "", true);
  add("void_fraction_slug", "void_fraction", "slug", "", false);
  add("gap", "gap", "impact", "", false);
  if (with_gas) add("pressure_gas", "pressure", "gas", "", false);
  if (!asked.rigid_head) {
    add("rise_head", "displacement", "head.centre", "z", false);
    add("kinetic_energy_head", "kinetic_energy", "head", "", false);
  }
  if (!asked.rigid_wall) add("kinetic_energy_wall", "kinetic_energy", "wall", "", false);
}

/// Mean pressure on the head while the first wave goes up and down the slug: from half its way up to half its way down. [Pa]
///
/// A node of the slug that strikes gives its momentum within a step, so the force of the first rows is that of half a cell.
dynamics::Probe first_wave(const Asked& asked) {
  const double way = asked.height / asked.sound_speed;
  return {"pressure_of_first_wave", "Pa", [way, area = asked.area](const dynamics::View& view, dynamics::Kept& kept) {
            const auto touched = dynamics::touched(view.model, view.now);
            const auto at = std::find_if(touched.begin(), touched.end(), [](const auto& one) { return one.contact == "impact"; });
            if (at == touched.end()) return 0.0;
            const double after = view.now.t - at->first;
            if (after > 0.5 * way && kept.since < 0) kept = {.integral = at->impulse, .since = view.now.t};
            if (kept.since >= 0 && after <= 1.5 * way && view.now.t > kept.since)
              kept.value = (kept.integral - at->impulse) / ((view.now.t - kept.since) * area);
            return kept.value.z();
          }};
}

model::Simulation build(const input::CaseFile& file, Asked& asked) {
  const input::Section root = file.root(), vessel = root.section("vessel"), liquid = root.section("slug"), gap = root.section("gap"),
                       lid = root.section("head");
  const Part part = read_part(root.section("model"), root.section("mesh"));
  const double radius = vessel.quantity("radius", dim::length, input::positive),
               height = liquid.quantity("height", dim::length, input::positive),
               rise = gap.quantity("height", dim::length, input::positive);
  asked.rigid_wall = vessel.choice("wall", {"rigid", "plates"}) == "rigid";
  asked.rigid_head = lid.choice("kind", {"rigid", "plate"}) == "rigid";
  const bool with_gas = asked.with_gas = gap.choice_or("filled_with", "nothing", {"nothing", "gas"}) == "gas";

  model::Scene scene;
  model::Body slug{.name = "slug", .mesh = column(part, radius, height), .law = input::read_solid_or_fluid_law(liquid.section("material")),
                   .solid = input::read_fluid_options(liquid.section_or_empty("element")), .at = "slug"};
  if (liquid.section("material").sound() && !material::is_fluid(slug.law))
    liquid.fault("material", "the slug is a fluid: expected one of linear_fluid, mie_gruneisen");
  model::Body gas{.name = "gas", .mesh = column(part, radius, rise), .law = material::IdealGas{}, .solid = element::Fluid::Options{},
                  .at = "gap"};
  gas.place.move = Vec3(0, 0, height);
  auto& air = std::get<material::IdealGas>(gas.law);
  const input::Section filling = gap.when(with_gas).section("gas");
  air.density = filling.quantity("density", dim::density, input::positive);
  air.gamma = filling.number("gamma", model::range::adiabatic);
  gas.start.pressure = air.pressure = filling.quantity("pressure", dim::stress, input::positive);

  model::Body wall = read_plates(vessel, "wall", asked.rigid_wall), head = read_plates(lid, "head", asked.rigid_head);
  const double top = height + rise;
  wall.mesh = shell(part, radius + wall.plate.thickness / 2, top);
  head.mesh = disc(part, radius);
  head.place.move = Vec3(0, 0, top + head.plate.thickness / 2);
  scene.bodies = {slug, wall, head};
  if (with_gas) scene.bodies.push_back(gas);

  const dynamics::InterfaceOptions interface = input::read_solid_interface(root.section_or_empty("contact"));
  const auto touch = [&](const std::string& name, const std::string& apexes, const std::string& base, bool curved) {
    model::Contact contact{.name = name, .apexes = apexes, .base = base, .height_from_thickness = !curved, .interface = interface,
                           .at = "contact"};
    if (curved) contact.interface.height = {.from_initial_height = true, .clearance = 0, .given = 0};
    scene.contacts.push_back(contact);
  };
  touch("side", "slug.side", "wall.inside", true);
  touch("impact", with_gas ? "gas.top" : "slug.top", "head.bottom", false);
  if (with_gas) touch("gas_side", "gas.side", "wall.inside", true), touch("gas_bottom", "gas.bottom", "slug.top", false);
  drive_slug(root.section("driven_by"), 2 * pi / part.angle, scene);
  scene.planes = planes_of(scene, part, asked);
  add_probes(asked, with_gas, scene);
  scene.time = input::read_time(root.section("time"));
  scene.recording = input::read_recording(root.section_or_empty("output"), scene.time.end);
  scene.stops = input::read_stops(root, input::measured_by(scene.probes), scene.recording);
  model::Simulation simulation = input::build(file, scene);

  const mesh::Mesh& mesh = simulation.model.mesh;
  asked.turns = 2 * pi / part.angle;
  asked.area = mesh::tributary_areas(mesh, mesh::surface(mesh, "slug.top"), mesh::node_set(mesh, "slug.top")).sum();
  const double modulus = material::stiffness(slug.law), density = std::visit([](const auto& law) { return law.density; }, slug.law);
  asked.sound_speed = std::sqrt(modulus / density), asked.impedance = density * asked.sound_speed, asked.height = height;
  if (!with_gas) simulation.probes.push_back(first_wave(asked));  // a gas touches the head from the start
  if (const auto* shocked = std::get_if<material::MieGruneisen>(&slug.law)) asked.slope = shocked->slope;
  return simulation;
}

/// What a source holds or has dissipated by a channel. [J]
double energy(const model::Simulation& simulation, const std::string& name, Stored channel) {
  return simulation.state.ledger.accounts[dynamics::source_of(simulation.model, name)].stored[channel];
}
double energy(const model::Simulation& simulation, const std::string& name, Dissipated channel) {
  return simulation.state.ledger.accounts[dynamics::source_of(simulation.model, name)].dissipated[channel];
}

std::vector<output::Result> results(const model::Simulation& simulation, const Asked& asked) {
  std::vector<output::Result> all;
  driver::add_strike(simulation, "impact", "head", asked.turns, all);
  const double speed = model::probe(simulation, "velocity_slug").largest;
  const double plane = asked.impedance * speed * (1 + asked.slope * speed / asked.sound_speed);  // of a front that goes back into the slug
  const double peak = std::max(0.0, -model::probe(simulation, "force_head").smallest_row) / asked.area;
  all.push_back({"speed_of_impact", speed, "m/s"});
  all.push_back({"plane_pressure", plane, "Pa"});
  all.push_back({"peak_mean_pressure", peak, "Pa"});
  all.push_back({"largest_pressure", model::probe(simulation, "largest_pressure_slug").largest, "Pa"});
  if (!asked.with_gas) {
    const double first = model::probe(simulation, "pressure_of_first_wave").last;
    all.push_back({"pressure_of_first_wave", first, "Pa"});
    all.push_back({"first_wave_over_plane", plane > 0 ? first / plane : 0, "1"});
  }
  if (!asked.rigid_head) {
    all.push_back({"largest_rise_head", model::probe(simulation, "rise_head").largest, "m"});
    all.push_back({"time_of_largest_rise_head", model::probe(simulation, "rise_head").time_of_largest, "s"});
    all.push_back({"rise_head", model::probe(simulation, "rise_head").last, "m"});
  }
  // where the energy is at the end
  const double given = dynamics::energy_of_scene(simulation.state.ledger);
  const auto share = [&](const std::string& what, double value) { all.push_back({"part_" + what, given > 0 ? value / given : 0, "1"}); };
  share("kinetic_slug", model::probe(simulation, "kinetic_energy_slug").last);
  share("compression_slug", energy(simulation, "slug", Stored::compression) + energy(simulation, "slug", Stored::cavitation));
  share("viscous_slug", energy(simulation, "slug", Dissipated::viscous));
  share("hourglass_slug", energy(simulation, "slug", Dissipated::hourglass));
  for (const char* body : {"head", "wall"}) {
    if (std::string(body) == "head" ? asked.rigid_head : asked.rigid_wall) continue;
    share(std::string("kinetic_") + body, model::probe(simulation, std::string("kinetic_energy_") + body).last);
    share(std::string("elastic_") + body, energy(simulation, body, Stored::elastic));
    share(std::string("plastic_") + body, energy(simulation, body, Dissipated::plastic));
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  Asked asked;
  return driver::drive(
      argc, argv, "slug_impact", [&](const input::CaseFile& file) { return build(file, asked); },
      [&](const model::Simulation& simulation) { return results(simulation, asked); });
}
