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
#include <memory>

#include "drivers/driver.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/wedge.hpp"

using namespace nereid;

enum class Kind { full, quarter, sector };

struct Case {
  Kind kind;
  int cells_around;       // of a sector
  bool clad;
  int level;
  double radius, length;  // [m]
  element::AnyLaw lead, steel;
  element::AnyHexahedronOptions lead_element;
  element::Plate::Options cladding_element;
  dynamics::InterfaceOptions interface;
  double speed;           // [m/s]
  dynamics::Time time;
  input::Recording recording;
};

Case read(const input::Section& root) {
  const auto model = root.section("model"), mesh = root.section("mesh"), cylinder = root.section("cylinder");
  const auto cladding = root.section("cladding");
  const bool clad = cladding.choice("kind", {"plates", "none"}) == "plates";
  const std::string kind = model.choice("kind", {"full", "quarter", "sector"});
  Case c{.kind = kind == "full" ? Kind::full : kind == "quarter" ? Kind::quarter : Kind::sector,
         .cells_around = model.when(kind == "sector").count_or("cells_around", 1, 1, 128),
         .clad = clad,
         .level = mesh.count("level", 1, 64),
         .radius = cylinder.quantity("radius", dim::length, input::positive),
         .length = cylinder.quantity("length", dim::length, input::positive),
         .lead = input::read_law(root.section("lead")),
         .steel = input::read_law(root.when(clad).section("steel")),
         .lead_element = input::read_hexahedron_options(root.section_or_empty("element"), "lead"),
         .cladding_element = input::read_plate_options(cladding.when(clad)),
         .interface = input::read_interface(root.when(clad).section_or_empty("interface")),
         .speed = root.section("initial").quantity("speed", dim::speed, input::positive),
         .time = input::read_time(root.section("time")),
         .recording = {}};
  c.recording = input::read_recording(root.section_or_empty("output"), c.time.end);
  return c;
}

/// Nodes of lead and cladding with that ending, ascending.
Subset both(const Case& c, const mesh::Mesh& mesh, const std::string& ending) {
  Subset nodes = mesh::node_set(mesh, "lead" + ending);
  if (!c.clad) return nodes;
  const Subset& more = mesh::node_set(mesh, "cladding" + ending);
  nodes.insert(nodes.end(), more.begin(), more.end());
  return nodes;
}

/// Angle of a sector: its cells are as wide as those of the quarter of the same level. [rad]
double angle(const Case& c) { return c.cells_around * pi / (4 * c.level); }

mesh::Mesh lead(const Case& c) {
  const int n = c.level, along = 12 * n;  // cells as long as they are wide at every level
  if (c.kind == Kind::sector) return mesh::wedge("lead", {c.radius, c.length, angle(c), c.cells_around, 2 * n, along});
  return mesh::cylinder("lead", {c.radius, c.length, c.kind == Kind::quarter ? mesh::Turn::quarter : mesh::Turn::full, n, n, along});
}

mesh::Mesh cladding(const Case& c) {
  const double skin = c.radius + c.cladding_element.thickness / 2;  // the plates' mid-surface
  const int n = c.level, along = 12 * n;
  if (c.kind == Kind::sector) return mesh::wedge_tube("cladding", {skin, c.length, angle(c), c.cells_around, along});
  return mesh::tube("cladding", {skin, c.length, c.kind == Kind::quarter ? mesh::Turn::quarter : mesh::Turn::full, n, along});
}

void add_bodies(const Case& c, dynamics::Model& model) {
  model.mesh = lead(c);
  model.blocks.push_back(element::solids(model.mesh, "lead", c.lead, c.lead_element));
  if (!c.clad) return;
  model.mesh = mesh::join(model.mesh, cladding(c));
  model.blocks.push_back(element::plates(model.mesh, "cladding", c.steel, c.cladding_element));
}

void constrain(const Case& c, dynamics::Model& model) {
  auto& planes = model.constraints.planes;
  planes.push_back({.name = "floor", .kind = load::PlaneKind::floor, .point = Vec3::Zero(), .normal = Vec3::UnitZ(),
                    .nodes = both(c, model.mesh, "")});
  if (c.kind == Kind::full) return;
  const bool quarter = c.kind == Kind::quarter;
  for (const auto& [name, normal] : {quarter ? std::pair{"x_plane", Vec3(Vec3::UnitX())} : std::pair{"first_plane", mesh::first_plane_normal()},
                                     quarter ? std::pair{"y_plane", Vec3(Vec3::UnitY())} : std::pair{"second_plane", mesh::second_plane_normal(angle(c))}})
    planes.push_back({.name = name, .kind = load::PlaneKind::symmetry, .point = Vec3::Zero(), .normal = normal,
                      .nodes = both(c, model.mesh, std::string(".") + name)});
}

/// Settlement of the lead's top: its area mean, and that of its centre. [m]
struct Top {
  Subset nodes;
  Scalars share;  // of the area, [nodes]
  Index centre;
  double mean(const Vectors& X, const Vectors& x) const {
    double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      sum += share(static_cast<Eigen::Index>(i)) * (X(2, nodes[i]) - x(2, nodes[i]));
    return sum;
  }
};

Top top_of_lead(const mesh::Mesh& mesh) {
  Top top{mesh::node_set(mesh, "lead.top"), {}, -1};
  top.share = mesh::tributary_areas(mesh, mesh::surface(mesh, "lead.top"), top.nodes);
  top.share /= top.share.sum();
  const auto off_axis = [&mesh](Index node) { return mesh.X.col(node).head<2>().squaredNorm(); };
  top.centre = *std::min_element(top.nodes.begin(), top.nodes.end(), [&](Index a, Index b) { return off_axis(a) < off_axis(b); });
  return top;
}

/// Largest outward displacement of the outermost nodes: of the cladding or, without it, of the lead's side. [m]
double bulge(const dynamics::View& view, const Subset& outside) {
  double most = 0;
  for (const Index node : outside)
    most = std::max(most, view.now.x.col(node).head<2>().norm() - view.model.mesh.X.col(node).head<2>().norm());
  return most;
}

driver::Scene build(const input::CaseFile& file) {
  const Case c = read(file.root());
  file.finish();
  driver::Scene scene{.model = {}, .state = {}, .forces = {}, .gaps = {}, .time = c.time, .recording = c.recording,
                      .probes = {}, .watchers = {}, .results = {}};
  dynamics::Model& model = scene.model;
  add_bodies(c, model);
  constrain(c, model);
  dynamics::finish(model);
  std::vector<dynamics::Connected> connected;
  if (c.clad) connected = dynamics::connect(model, "interface", "lead.side", "cladding.inside", c.interface);
  for (const auto& pass : connected) input::refuse_penetration(file.root().section_or_empty("interface"), c.interface, pass.gaps);
  file.finish();
  driver::make_ready(scene, std::move(connected));
  scene.state.v.row(2).setConstant(-c.speed);

  const Top top = top_of_lead(model.mesh);
  const Subset outside = mesh::node_set(model.mesh, c.clad ? "cladding" : "lead.side");
  const auto mean = [top](const dynamics::View& view) { return top.mean(view.model.mesh.X, view.now.x); };
  const auto centre = [top](const dynamics::View& view) {
    return view.model.mesh.X(2, top.centre) - view.now.x(2, top.centre);
  };
  struct Seen {
    driver::Peak mean, centre, bulge;
    double impulse = 0, time = 0;  // of the floor at the last sample
  };
  const auto seen = std::make_shared<Seen>();
  const auto floor_force = [seen](const dynamics::View& view) {  // mean since the last sample
    const double impulse = view.now.constraints.account[0].impulse.z(), elapsed = view.now.t - seen->time;
    const double force = elapsed > 0 ? (impulse - seen->impulse) / elapsed : 0;
    seen->impulse = impulse, seen->time = view.now.t;
    return force;
  };
  scene.probes = {{"settlement_mean", "m", mean}, {"settlement_centre", "m", centre}, {"floor_force", "N", floor_force},
                  {"floor_impulse", "N s", [](const auto& view) { return view.now.constraints.account[0].impulse.z(); }},
                  {"bulge", "m", [outside](const auto& view) { return bulge(view, outside); }}};
  scene.watchers.emplace_back([=](const dynamics::View& view) {
    seen->mean.see(mean(view), view.now.t);
    seen->centre.see(centre(view), view.now.t);
    if (view.ledger_is_current) seen->bulge.see(bulge(view, outside), view.now.t);
  });
  scene.results = [seen] {
    return std::vector<output::Result>{{"settlement_mean", seen->mean.value, "m"},
                                       {"time_of_settlement_mean", seen->mean.time, "s"},
                                       {"settlement_centre", seen->centre.value, "m"},
                                       {"time_of_settlement_centre", seen->centre.time, "s"},
                                       {"bulge", seen->bulge.value, "m"}};
  };
  return scene;
}

int main(int argc, char** argv) { return driver::drive(argc, argv, "cask_drop", build); }
