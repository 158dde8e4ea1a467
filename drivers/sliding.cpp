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
#include <memory>

#include "contact/bounce.hpp"
#include "drivers/driver.hpp"
#include "dynamics/displace.hpp"
#include "dynamics/measure.hpp"
#include "mesh/box.hpp"
#include "mesh/placement.hpp"

using namespace nereid;

struct Case {
  std::array<double, 3> size;  // [m] of the block
  std::array<int, 3> cells;
  double turned;               // [rad] about the normal of the plane
  element::AnyLaw material;
  element::AnyHexahedronOptions element;
  bool mesh_below;
  std::array<double, 3> base_size;  // [m]
  std::array<int, 3> base_cells;
  double slope, gravity, speed;     // [rad] [m/s2] [m/s]
  double ease;                      // [s] over which the pull down the slope grows
  dynamics::InterfaceOptions contact;
  dynamics::Time time;
  input::Recording recording;
};

/// Of a mesh below, all that an interface knows; of a rigid plane, how hard it is, how rough, and what a bounce may create.
dynamics::InterfaceOptions read_contact(const input::Section& section, bool mesh_below) {
  dynamics::InterfaceOptions options = input::read_solid_interface(section.when(mesh_below));
  if (mesh_below) return options;
  const bool given = section.has("penalty");
  options.penalty_from = given ? dynamics::PenaltyFrom::value : dynamics::PenaltyFrom::stiffness;
  options.penalty = section.when(given).quantity("penalty", dim::penalty, input::positive);
  options.hardness = section.when(!given).number_or("hardness", options.hardness, input::positive);
  options.friction = input::read_friction(section);
  options.created_in_a_bounce = section.number_or("created_in_a_bounce", options.created_in_a_bounce, input::within(1e-5, 0.04));
  return options;
}

Case read(const input::Section& root) {
  const auto block = root.section("block"), base = root.section("base"), contact = root.section("contact");
  const bool mesh_below = base.choice("kind", {"plane", "mesh"}) == "mesh";
  const auto meshed = base.when(mesh_below);
  Case c{.size = block.vector("size", dim::length),
         .cells = block.counts("cells", 1, 400),
         .turned = block.quantity_or("turned", 0, dim::angle),
         .material = input::read_law(root.section("material")),
         .element = input::read_hexahedron_options(root.section_or_empty("element")),
         .mesh_below = mesh_below,
         .base_size = meshed.vector("size", dim::length),
         .base_cells = meshed.counts("cells", 1, 400),
         .slope = base.quantity_or("slope", 0, dim::angle, input::between(-1.5, 1.5)),
         .gravity = root.quantity_or("gravity", 9.81, dim::acceleration, input::positive),
         .speed = root.quantity_or("speed", 0, dim::speed),
         .ease = base.quantity_or("ease", 0, dim::time, input::not_negative),
         .contact = read_contact(contact, mesh_below),
         .time = input::read_time(root.section("time")),
         .recording = {}};
  c.recording = input::read_recording(root.section_or_empty("output"), c.time.end);
  const auto flat = [](const std::array<double, 3>& size) { return !(*std::min_element(size.begin(), size.end()) > 0); };
  if (root.sound() && flat(c.size)) block.fault("size", "'size' must be positive in each direction");
  if (root.sound() && mesh_below && flat(c.base_size)) base.fault("size", "'size' must be positive in each direction");
  return c;
}

/// The block over the origin, its sole at z = 0, and under it the base where that is a mesh.
void add_bodies(const Case& c, dynamics::Model& model) {
  const auto vec = [](const auto& a) { return Vec3(a[0], a[1], a[2]); };
  const auto cells = [](const std::array<int, 3>& n) { return Eigen::Vector3i(n[0], n[1], n[2]); };
  const Vec3 size = vec(c.size), corner(size.x() / 2, size.y() / 2, 0);
  model.mesh = mesh::turned_about(mesh::box("block", {-corner, size - corner, cells(c.cells)}), Vec3::UnitZ(), c.turned, Vec3::Zero());
  model.blocks.push_back(element::solids(model.mesh, "block", c.material, c.element));
  if (!c.mesh_below) return;
  const Vec3 base = vec(c.base_size), low(-size.norm(), -base.y() / 2, -base.z());
  model.mesh = mesh::join(model.mesh, mesh::box("base", {low, low + base, cells(c.base_cells)}));
  model.blocks.push_back(element::solids(model.mesh, "base", c.material, c.element));
  model.constraints.planes.push_back({.name = "bed", .kind = load::PlaneKind::fixed, .nodes = mesh::node_set(model.mesh, "base")});
}

/// Gravity along the slope. Let loose at once it would swing the block to twice the shear of rest; so it may grow
/// from zero as 3 s^2 - 2 s^3, s = t / ease.
void pull_down_the_slope(const Case& c, dynamics::Model& model) {
  const double pull = c.gravity * std::sin(c.slope), ease = c.ease;
  if (pull == 0) return;
  load::BodyForce force{.name = "slope", .nodes = mesh::node_set(model.mesh, "block"), .mass = {}, .acceleration = {}};
  force.mass.resize(static_cast<Eigen::Index>(force.nodes.size()));
  for (std::size_t i = 0; i < force.nodes.size(); ++i) force.mass(static_cast<Eigen::Index>(i)) = model.mass(force.nodes[i]);
  const auto none = [](double, double, double, double) { return 0.0; };
  force.acceleration = {[pull, ease](double, double, double, double t) {
                          const double s = t < ease ? t / ease : 1;
                          return pull * s * s * (3 - 2 * s);
                        },
                        none, none};
  model.loads.emplace_back(std::move(force));
}

double penalty(const Case& c, const dynamics::Model& model) {
  const mesh::Surface& sole = mesh::surface(model.mesh, "block.z_low");
  return c.contact.penalty_from == dynamics::PenaltyFrom::value ? c.contact.penalty
                                                                : c.contact.hardness * dynamics::surface_stiffness(model, sole);
}

std::vector<dynamics::Connected> add_contact(const Case& c, dynamics::Model& model) {
  if (c.mesh_below) return dynamics::connect(model, "contact", "block.z_low", "base.z_high", c.contact);
  const mesh::Surface& sole = mesh::surface(model.mesh, "block.z_low");
  const Subset nodes = mesh::surface_nodes(sole);
  model.rigid_planes.push_back({.name = "contact", .point = Vec3::Zero(), .normal = Vec3::UnitZ(), .nodes = nodes,
                                .area = mesh::tributary_areas(model.mesh, sole, nodes), .penalty = penalty(c, model),
                                .bounce_step = contact::step_for_a_bounce(c.contact.created_in_a_bounce),
                                .friction = c.contact.friction});
  return {};
}

/// The block starts where its weight has pressed it: its sole in the base by weight over penalty, and itself
/// shortened as a column is. Exact for poisson = 0; otherwise what is left is a small bounce.
void press(const Case& c, double stiffness, driver::Scene& scene) {
  const double density = std::visit([](const auto& law) { return law.density; }, c.material);
  const double young = std::visit([](const auto& law) { return law.young; }, c.material);
  const double weight = density * c.gravity * std::cos(c.slope), height = c.size[2];
  Vectors u = Vectors::Zero(3, scene.model.mesh.X.cols());
  for (const Index node : mesh::node_set(scene.model.mesh, "block")) {
    const double z = scene.model.mesh.X(2, node);
    u(2, node) = -weight * height / stiffness - weight / young * (height * z - z * z / 2);
  }
  dynamics::displace(scene.model, scene.state, u, {});
}

driver::Scene build(const input::CaseFile& file) {
  const Case c = read(file.root());
  file.finish();
  driver::Scene scene{.model = {}, .state = {}, .forces = {}, .gaps = {}, .time = c.time, .recording = c.recording,
                      .probes = {}, .watchers = {}, .results = {}};
  dynamics::Model& model = scene.model;
  add_bodies(c, model);
  model.gravity = c.gravity * Vec3(0, 0, -std::cos(c.slope));
  dynamics::finish(model);
  pull_down_the_slope(c, model);
  driver::make_ready(scene, add_contact(c, model));
  press(c, c.mesh_below ? model.interfaces[0].penalty * static_cast<double>(model.interfaces.size()) : model.rigid_planes[0].penalty, scene);
  const Subset block = mesh::node_set(model.mesh, "block"), sole = mesh::node_set(model.mesh, "block.z_low");
  for (const Index node : block) scene.state.v(0, node) = c.speed;

  const bool rigid = !c.mesh_below;
  const auto force = [rigid](const dynamics::View& view) {  // of all passes on the block, at this moment
    Vec3 sum = Vec3::Zero();
    if (rigid) return contact::force(view.model.rigid_planes[0], view.now.rigid_planes[0]);
    for (std::size_t pass = 0; pass < view.model.interfaces.size(); ++pass)
      sum += (pass == 0 ? 1 : -1) * dynamics::contact_force(view, pass);
    return sum;
  };
  struct Seen {
    double way = 0, stop = -1, speed = 0, half_time = -1, half_speed = 0, half_way = 0, time = 0, largest_push = 0, smallest_push = 1e300;
  };
  const auto seen = std::make_shared<Seen>();
  const double end = c.time.end;
  const auto way = [sole](const dynamics::View& view) { return dynamics::mean_displacement(view, sole).x(); };
  const auto speed = [block](const dynamics::View& view) { return dynamics::mean_velocity(view, block).x(); };
  scene.probes = {{"way", "m", way}, {"speed", "m/s", speed},
                  {"normal_force", "N", [force](const auto& view) { return force(view).z(); }},
                  {"friction_force", "N", [force](const auto& view) { return force(view).x(); }}};
  scene.watchers.emplace_back([=](const dynamics::View& view) {
    seen->way = way(view), seen->speed = speed(view), seen->time = view.now.t;
    if (seen->half_time < 0 && view.now.t >= end / 2) seen->half_time = view.now.t, seen->half_speed = seen->speed, seen->half_way = seen->way;
    if (seen->stop < 0 && view.now.step > 0 && seen->speed <= 0) seen->stop = view.now.t;
    const double push = force(view).z();
    seen->largest_push = std::max(seen->largest_push, push), seen->smallest_push = std::min(seen->smallest_push, push);
  });
  scene.results = [seen] {
    const double mean = (seen->largest_push + seen->smallest_push) / 2;
    const double later = seen->half_time < 0 ? 0 : seen->time - seen->half_time;  // the second half of the run
    std::vector<output::Result> results{{"way", seen->way, "m"}, {"way_in_second_half", seen->way - seen->half_way, "m"},
                                        {"speed", seen->speed, "m/s"},
                                        {"acceleration", later > 0 ? (seen->speed - seen->half_speed) / later : 0, "m/s^2"},
                                        {"normal_force_ripple", mean > 0 ? (seen->largest_push - seen->smallest_push) / mean : 0, "1"}};
    if (seen->stop >= 0) results.push_back({"stop_time", seen->stop, "s"});
    return results;
  };
  return scene;
}

int main(int argc, char** argv) { return driver::drive(argc, argv, "sliding", build); }
