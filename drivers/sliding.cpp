// A block slides over a plane, level or inclined, under its own weight and with friction.
//
//          +------+  v
//          | block| --->         The drawing is turned so that the plane is level: gravity g leans by `slope`
//     =====+======+=========     along x. The plane is rigid, or the facets of a mesh that is held fast.
//            \ g
//
// Question  How far does a block with a speed slide and when does it stop; does it stay on an incline, or how fast
//           does it go; and what does it feel as its apexes walk over facets?
// Answer    the same questions as scenes: verification/sliding_block, block_on_an_incline, dragged_over_facets
// Run       sliding cases/sliding/stop.yaml --out out/sliding

#include <algorithm>
#include <cmath>

#include "drivers/driver.hpp"
#include "dynamics/displace.hpp"

using namespace nereid;

/// A body from its lowest corner on.
model::Body box(const std::string& name, const std::array<double, 3>& size, const std::array<int, 3>& cells, const Vec3& low) {
  return {.name = name, .mesh = mesh::Box{low, low + Vec3(size.data()), Eigen::Vector3i(cells.data())}, .at = name};
}

/// Gravity along the slope. Let loose at once it would swing the block to twice the shear of rest; so it may grow
/// from zero as 3 s^2 - 2 s^3, s = t / ease.
load::OverSpace eased(double pull, double ease) {
  return [pull, ease](double, double, double, double t) {
    const double s = t < ease ? t / ease : 1;
    return pull * s * s * (3 - 2 * s);
  };
}

/// By how much the sole stands in the base under a pressure [Pa]. [m]
double overlap(const dynamics::Model& model, double pressure) {
  if (contact::any_by_multipliers(model.contacts, model.rigid_planes)) return 0;
  const auto passes = static_cast<double>(contact::passes_of(model.contacts));
  return pressure / (model.rigid_planes.empty() ? contact::sides(model.contacts[0]).penalty * passes : model.rigid_planes[0].penalty);
}

/// The block starts where its weight has pressed it: its sole in the base by weight over penalty, and itself
/// shortened as a column is. Exact for poisson = 0; otherwise what is left is a small bounce.
void press(double weight, double height, double young, model::Simulation& simulation) {
  const dynamics::Model& model = simulation.model;
  const double sole = -overlap(model, weight * height);
  Vectors u = Vectors::Zero(3, model.mesh.X.cols());
  for (const Index node : mesh::node_set(model.mesh, "block")) {
    const double z = model.mesh.X(2, node);
    u(2, node) = sole - weight / young * (height * z - z * z / 2);
  }
  dynamics::displace(model, simulation.state, u, {});
}

/// On the block, at this moment, of all passes. [N]
Vec3 force(const dynamics::View& view) {
  if (!view.model.rigid_planes.empty()) return contact::force(view.model.rigid_planes[0], view.now.rigid_planes[0]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t c = 0; c < view.model.contacts.size(); ++c)
    sum += contact::side_of(view.model.contacts[c]) * contact::sides(view.now.contacts[c]).force;
  return sum;
}

/// A number without a column, measured until half of the run and kept from there on.
template <class Value>
dynamics::Probe until_half(double end, Value value) {
  return {"", "1", [=](const dynamics::View& view, dynamics::Kept& kept) {
            if (kept.since > 0) return kept.value.x();
            kept.value.x() = value(view);
            if (view.now.t >= end / 2) kept.since = view.now.t;
            return kept.value.x();
          }};
}

std::vector<dynamics::Probe> probes(const dynamics::Model& model, double end) {
  const Subset block = mesh::node_set(model.mesh, "block"), sole = mesh::node_set(model.mesh, "block.z_low");
  const auto way = [sole](const dynamics::View& view) { return dynamics::mean_displacement(view, sole).x(); };
  const auto speed = [block](const dynamics::View& view) { return dynamics::mean_velocity(view, block).x(); };
  return {{"way", "m", [way](const auto& view, auto&) { return way(view); }},
          {"speed", "m/s", [speed](const auto& view, auto&) { return speed(view); }},
          {"normal_force", "N", [](const auto& view, auto&) { return force(view).z(); }},
          {"friction_force", "N", [](const auto& view, auto&) { return force(view).x(); }},
          {"", "1", [speed](const auto& view, auto&) { return view.now.step > 0 && speed(view) <= 0 ? 1.0 : 0.0; }},
          until_half(end, way),
          until_half(end, speed)};
}

model::Simulation build(const input::CaseFile& file) {
  const input::Section root = file.root(), block = root.section("block"), base = root.section("base"), contact = root.section("contact");
  const bool mesh_below = base.choice("kind", {"plane", "mesh"}) == "mesh";
  const auto meshed = base.when(mesh_below);
  const auto size = block.vector("size", dim::length);
  const auto cells = block.counts("cells", 1, 400);
  const double turned = block.quantity_or("turned", 0, dim::angle);
  const auto law = input::read_law(root.section("material"));
  const auto element = input::read_hexahedron_options(root.section_or_empty("element"));
  const auto base_size = meshed.vector("size", dim::length);
  const auto base_cells = meshed.counts("cells", 1, 400);
  const double slope = base.quantity_or("slope", 0, dim::angle, input::between(-1.5, 1.5));
  const double gravity = root.quantity_or("gravity", 9.81, dim::acceleration, input::positive);
  const double speed = root.quantity_or("speed", 0, dim::speed);
  const double ease = base.quantity_or("ease", 0, dim::time, input::not_negative);
  const auto flat = [](const std::array<double, 3>& lengths) { return !(*std::min_element(lengths.begin(), lengths.end()) > 0); };

  model::Scene scene;  // the block over the origin, its sole at z = 0, and under it the base where that is a mesh
  scene.bodies = {box("block", size, cells, -Vec3(size[0] / 2, size[1] / 2, 0))};
  scene.bodies[0].place.angle = turned;
  if (mesh_below) {
    const Vec3 low(-Vec3(size.data()).norm(), -base_size[1] / 2, -base_size[2]);
    scene.bodies.push_back(box("base", base_size, base_cells, low));
    scene.planes = {{.name = "bed", .kind = load::PlaneKind::fixed, .nodes = {"base"}, .at = "base"}};
    scene.contacts = {{.name = "contact", .apexes = "block.z_low", .base = "base.z_high", .height_from_thickness = false,
                       .interface = input::read_solid_interface(contact), .at = "contact"}};
  } else {
    input::read_solid_interface(contact.when(false));  // keys of the other kind are checked too
    scene.rigid_planes = {{.name = "contact", .surface = "block.z_low", .at = "contact"}};
    input::read_rigid_contact(contact, scene.rigid_planes[0]);
  }
  for (model::Body& body : scene.bodies) body.law = law, body.solid = element;
  scene.gravity = gravity * Vec3(0, 0, -std::cos(slope));
  const double pull = gravity * std::sin(slope);
  if (pull != 0)
    scene.loads = {{.name = "slope", .kind = model::LoadKind::body_force, .on = "block",
                    .value = {eased(pull, ease), model::constant(0), model::constant(0)}, .at = "base"}};
  scene.initial = {{.body = "block", .value = model::uniform({speed, 0, 0})}};
  scene.time = input::read_time(root.section("time"));
  scene.recording = input::read_recording(root.section_or_empty("output"), scene.time.end);
  if (root.sound() && flat(size)) block.fault("size", "'size' must be positive in each direction");
  if (root.sound() && mesh_below && flat(base_size)) base.fault("size", "'size' must be positive in each direction");

  const std::vector<input::Measured> measured{{"way", "m"}, {"speed", "m/s"}, {"normal_force", "N"}, {"friction_force", "N"}};
  const auto stops = input::read_stops(root, measured, scene.recording);
  model::Simulation simulation = input::build(file, scene);
  simulation.stops = stops;
  const double density = std::visit([](const auto& one) { return one.density; }, law);
  press(density * gravity * std::cos(slope), size[2], material::stiffness(law), simulation);
  simulation.probes = probes(simulation.model, scene.time.end);
  return simulation;
}

std::vector<output::Result> results(const model::Simulation& simulation) {
  const auto& seen = simulation.state.probes;  // in the order of probes()
  const double way = seen[0].last, speed = seen[1].last, stop = seen[4].first_above_zero;
  const double largest = std::max(0.0, seen[2].largest), smallest = seen[2].smallest, mean = (largest + smallest) / 2;
  const bool half = seen[5].of_steps.since > 0;
  const double half_way = half ? seen[5].last : 0, half_speed = half ? seen[6].last : 0;
  const double later = half ? simulation.state.t - seen[5].of_steps.since : 0;  // the second half of the run
  std::vector<output::Result> all{{"way", way, "m"},
                                  {"way_in_second_half", way - half_way, "m"},
                                  {"speed", speed, "m/s"},
                                  {"acceleration", later > 0 ? (speed - half_speed) / later : 0, "m/s^2"},
                                  {"normal_force_ripple", mean > 0 ? (largest - smallest) / mean : 0, "1"}};
  if (stop >= 0) all.push_back({"stop_time", stop, "s"});
  return all;
}

int main(int argc, char** argv) { return driver::drive(argc, argv, "sliding", build, results); }
