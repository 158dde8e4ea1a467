// A lead cylinder in a steel skin drops on a rigid floor: the scene of Kulak & Fiala, chapter 5.
//
//        | |         | |
//        | |  lead   | |   v        The skin is a tube of plates without end caps. Lead and skin touch
//        | |         | |   |        without friction; both stay on the floor after first touch and
//        | |_________| |   V        slide on it freely.
//      ===================== floor
//
// Question  How far does the top of the lead settle, and when?
// Answer    docs/cask_drop.md
// Run       cask_drop cases/cask_drop/neptune.yaml --out out/cask_drop

#include <algorithm>

#include "drivers/driver.hpp"
#include "dynamics/measure.hpp"

using namespace nereid;

/// Settlement of the lead's top, as an area mean, and that of its centre. [m]
std::vector<dynamics::Probe> settlements(const mesh::Mesh& mesh) {
  const Subset nodes = mesh::node_set(mesh, "lead.top");
  Scalars share = mesh::tributary_areas(mesh, mesh::surface(mesh, "lead.top"), nodes);
  share /= share.sum();
  const auto off_axis = [&mesh](Index node) { return mesh.X.col(node).head<2>().squaredNorm(); };
  const Index centre = *std::min_element(nodes.begin(), nodes.end(), [&](Index a, Index b) { return off_axis(a) < off_axis(b); });
  const auto settlement = [](const dynamics::View& view, Index node) { return view.model.mesh.X(2, node) - view.now.x(2, node); };
  const auto mean = [=](const dynamics::View& view, auto&) {
    double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) sum += share(static_cast<Eigen::Index>(i)) * settlement(view, nodes[i]);
    return sum;
  };
  return {{"settlement_mean", "m", mean},
          {"settlement_centre", "m", [=](const dynamics::View& view, auto&) { return settlement(view, centre); }}};
}

/// Largest outward displacement of the outermost nodes: of the cladding or, without it, of the lead's side. [m]
double bulge(const dynamics::View& view, const Subset& outside) {
  double most = 0;
  for (const Index node : outside)
    most = std::max(most, view.now.x.col(node).head<2>().norm() - view.model.mesh.X.col(node).head<2>().norm());
  return most;
}

model::Simulation build(const input::CaseFile& file) {
  const input::Section root = file.root(), kinds = root.section("model"), levels = root.section("mesh"),
                       cylinder = root.section("cylinder"), cladding = root.section("cladding");
  const bool clad = cladding.choice("kind", {"plates", "none"}) == "plates";
  const std::string kind = kinds.choice("kind", {"full", "quarter", "sector"});
  const bool sector = kind == "sector";
  const auto turn = kind == "quarter" ? mesh::Revolution::quarter : mesh::Revolution::full;
  const int around = kinds.when(sector).count_or("cells_around", 1, 1, 128), n = levels.count("level", 1, 64);
  const int along = 12 * n;                   // cells as long as they are wide at every level
  const double angle = around * pi / (4 * n);  // of a sector: its cells are as wide as those of the quarter of the same level
  const double radius = cylinder.quantity("radius", dim::length, input::positive),
               length = cylinder.quantity("length", dim::length, input::positive);

  model::Scene scene;
  model::Body lead{.name = "lead", .mesh = mesh::Cylinder{radius, length, turn, n, n, along},
                   .law = input::read_law(root.section("lead")), .at = "cylinder"};
  model::Body skin{.name = "cladding", .mesh = {}, .law = input::read_plate_law(root.when(clad).section("steel")), .at = "cladding"};
  lead.solid = input::read_hexahedron_options(root.section_or_empty("element"), "lead");
  skin.plate = input::read_plate_options(cladding.when(clad));
  const double middle = radius + skin.plate.thickness / 2;  // the radius of the plates' mid-surface
  skin.mesh = mesh::Tube{middle, length, turn, n, along};
  if (sector) lead.mesh = mesh::Wedge{radius, length, angle, around, 2 * n, along};
  if (sector) skin.mesh = mesh::WedgeTube{middle, length, angle, around, along};
  model::Contact contact{.name = "interface", .apexes = "lead.side", .base = "cladding.inside", .height_from_thickness = false,
                         .interface = input::read_interface(root.when(clad).section_or_empty("interface")), .at = "interface"};
  scene.bodies = {lead};
  if (clad) scene.bodies.push_back(skin), scene.contacts = {contact};
  const double speed = root.section("initial").quantity("speed", dim::speed, input::positive);
  const auto plane = [clad](const std::string& name, load::PlaneKind what, const Vec3& normal, const std::string& ending) {
    model::Plane made{.name = name, .kind = what, .nodes = {"lead" + ending}, .normal = normal, .at = "cylinder"};
    if (clad) made.nodes.push_back("cladding" + ending);
    return made;
  };
  using load::PlaneKind;
  scene.planes = {plane("floor", PlaneKind::floor, Vec3::UnitZ(), "")};
  if (kind == "quarter")
    scene.planes.insert(scene.planes.end(), {plane("x_plane", PlaneKind::symmetry, Vec3::UnitX(), ".x_plane"),
                                             plane("y_plane", PlaneKind::symmetry, Vec3::UnitY(), ".y_plane")});
  if (sector)
    scene.planes.insert(scene.planes.end(), {plane("first_plane", PlaneKind::symmetry, mesh::first_plane_normal(), ".first_plane"),
                                             plane("second_plane", PlaneKind::symmetry, mesh::second_plane_normal(angle),
                                                   ".second_plane")});
  for (const model::Body& body : scene.bodies) scene.initial.push_back({.body = body.name, .value = model::uniform({0, 0, -speed})});
  scene.time = input::read_time(root.section("time"));
  scene.recording = input::read_recording(root.section_or_empty("output"), scene.time.end);

  const std::vector<input::Measured> measured{
      {"settlement_mean", "m"}, {"settlement_centre", "m"}, {"floor_force", "N"}, {"floor_impulse", "N s"}, {"bulge", "m"}};
  const auto stops = input::read_stops(root, measured, scene.recording);
  model::Simulation simulation = input::build(file, scene);
  simulation.stops = stops;
  const mesh::Mesh& mesh = simulation.model.mesh;
  const Subset outside = mesh::node_set(mesh, clad ? "cladding" : "lead.side");
  simulation.probes = settlements(mesh);
  simulation.probes.insert(
      simulation.probes.end(),
      {{"floor_force", "N",
        [floor = dynamics::source_of(simulation.model, "floor")](const dynamics::View& view, dynamics::Kept& kept) {
          return dynamics::mean_force(view, floor, kept).z();
        },
        true},
       {"floor_impulse", "N s", [](const dynamics::View& view, auto&) { return view.now.constraints.account[0].impulse.z(); }},
       {"bulge", "m", [outside](const dynamics::View& view, auto&) { return bulge(view, outside); }}});
  return simulation;
}

std::vector<output::Result> results(const model::Simulation& simulation) {
  const auto mean = model::probe(simulation, "settlement_mean"), centre = model::probe(simulation, "settlement_centre");
  return {{"settlement_mean", mean.largest, "m"},
          {"time_of_settlement_mean", mean.time_of_largest, "s"},
          {"settlement_centre", centre.largest, "m"},
          {"time_of_settlement_centre", centre.time_of_largest, "s"},
          {"bulge", model::probe(simulation, "bulge").largest, "m"}};
}

int main(int argc, char** argv) { return driver::drive(argc, argv, "cask_drop", build, results); }
