// A uniform pressure presses two blocks together whose meshes need not match: the contact patch test.
//
//      v v v v v v v  p
//     +---+---+---+---+       The blocks stand on a smooth floor between smooth walls. They are relaxed to
//     |     upper     |       rest, where every element should carry -p along z and every apex sink in by
//     +==+==+==+==+===+       p over the penalty.
//     |     lower     |
//     +---+---+---+---+
//
// Question  How uniform are stress and contact pressure, for a formulation of contact and a pair of meshes?
// Answer    the same question as a scene: verification/contact_patch/README.md
// Run       patch_test cases/patch_test/three_on_four.yaml --out out/patch_test

#include <algorithm>
#include <cmath>
#include <memory>

#include "drivers/driver.hpp"
#include "dynamics/measure.hpp"
#include "input/load_readers.hpp"
#include "mesh/box.hpp"

using namespace nereid;

struct Case {
  double width, height;  // [m] of both blocks
  std::array<int, 3> lower, upper;
  bool apexes_above;
  element::AnyLaw material;
  element::AnyHexahedronOptions element;
  double pressure;       // [Pa]
  dynamics::InterfaceOptions contact;
  dynamics::Relaxation relaxation;
  dynamics::Time time;
  input::Recording recording;
};

Case read(const input::Section& root) {
  const auto blocks = root.section("blocks");
  Case c{.width = blocks.quantity("width", dim::length, input::positive),
         .height = blocks.quantity("height", dim::length, input::positive),
         .lower = blocks.counts("cells_lower", 1, 400),
         .upper = blocks.counts("cells_upper", 1, 400),
         .apexes_above = blocks.choice_or("apexes", "upper", {"upper", "lower"}) == "upper",
         .material = input::read_law(root.section("material")),
         .element = input::read_hexahedron_options(root.section_or_empty("element")),
         .pressure = root.quantity("pressure", dim::stress, input::positive),
         .contact = input::read_solid_interface(root.section_or_empty("contact")),
         .relaxation = input::read_relaxation(root).value_or(dynamics::Relaxation{}),
         .time = input::read_time(root.section("time")),
         .recording = {}};
  c.recording = input::read_recording(root.section_or_empty("output"), c.time.end);
  return c;
}

void add_blocks(const Case& c, dynamics::Model& model) {
  const auto cells = [](const std::array<int, 3>& n) { return Eigen::Vector3i(n[0], n[1], n[2]); };
  const Vec3 size(c.width, c.width, c.height), up(0, 0, c.height);
  model.mesh = mesh::join(mesh::box("lower", {Vec3::Zero(), size, cells(c.lower)}), mesh::box("upper", {up, up + size, cells(c.upper)}));
  for (const char* name : {"lower", "upper"}) model.blocks.push_back(element::solids(model.mesh, name, c.material, c.element));
  const auto hold = [&model](const std::string& name, const Vec3& normal, const std::vector<std::string>& sets) {
    Subset nodes;
    for (const std::string& set : sets) nodes.insert(nodes.end(), mesh::node_set(model.mesh, set).begin(), mesh::node_set(model.mesh, set).end());
    model.constraints.planes.push_back({.name = name, .kind = load::PlaneKind::held, .normal = normal, .nodes = nodes});
  };
  hold("floor", Vec3::UnitZ(), {"lower.z_low"});
  hold("walls_x", Vec3::UnitX(), {"lower.x_low", "lower.x_high", "upper.x_low", "upper.x_high"});
  hold("walls_y", Vec3::UnitY(), {"lower.y_low", "lower.y_high", "upper.y_low", "upper.y_high"});
  dynamics::finish(model);
  model.loads.emplace_back(load::pressure_on("pressure", model.mesh, mesh::surface(model.mesh, "upper.z_high"), [p = c.pressure](double) { return p; }));
  model.relaxation = c.relaxation;
}

/// Deviations from what is exact: root of the mean square, and largest. [-]
struct Error {
  double square = 0, largest = 0;
  int count = 0;
  void see(double value, double exact) {
    const double off = std::abs(value / exact - 1);
    square += off * off, largest = std::max(largest, off), ++count;
  }
  double mean() const { return count > 0 ? std::sqrt(square / count) : 0; }
};

/// Of the axial stress of all elements.
Error stress_error(const dynamics::View& view, double pressure) {
  Error error;
  for (std::size_t b = 0; b < view.model.blocks.size(); ++b) {
    const auto fields = element::fields(view.model.blocks[b], view.now.x, view.now.blocks[b]);
    const auto& stress = fields.front().values;  // XX YY ZZ XY YZ XZ
    for (Eigen::Index e = 0; e < stress.cols(); ++e) error.see(stress(2, e), -pressure);
  }
  return error;
}

/// Of the contact pressure of all apexes; where there are two passes the mean over both is half the pressure.
Error pressure_error(const dynamics::View& view, double pressure) {
  Error error;
  const std::size_t passes = view.model.interfaces.size();
  for (std::size_t c = 0; c < passes; ++c)
    for (Index a = 0; a < static_cast<Index>(view.model.interfaces[c].apexes.size()); ++a)
      error.see(contact::view(view.model.interfaces[c], view.now.x, view.now.interfaces[c], a).traction, pressure / static_cast<double>(passes));
  return error;
}

driver::Scene build(const input::CaseFile& file) {
  const Case c = read(file.root());
  file.finish();
  driver::Scene scene{.model = {}, .state = {}, .forces = {}, .gaps = {}, .time = c.time, .recording = c.recording,
                      .probes = {}, .watchers = {}, .results = {}};
  add_blocks(c, scene.model);
  const char* sides[] = {"lower.z_high", "upper.z_low"};
  driver::make_ready(scene, dynamics::connect(scene.model, "interface", sides[c.apexes_above], sides[!c.apexes_above], c.contact));

  const auto last = std::make_shared<std::pair<Error, Error>>();
  const double p = c.pressure;
  scene.probes = {{"stress_error", "1", [p](const auto& view) { return stress_error(view, p).mean(); }},
                  {"pressure_error", "1", [p](const auto& view) { return pressure_error(view, p).mean(); }},
                  {"residual", "1", [](const auto& view) { return view.now.relaxation.residual; }}};
  scene.watchers.emplace_back([last, p](const dynamics::View& view) {
    if (view.ledger_is_current) *last = {stress_error(view, p), pressure_error(view, p)};
  });
  scene.results = [last] {
    const auto& [stress, pressure] = *last;
    return std::vector<output::Result>{{"stress_error_mean", stress.mean(), "1"},
                                       {"stress_error_largest", stress.largest, "1"},
                                       {"pressure_error_mean", pressure.mean(), "1"},
                                       {"pressure_error_largest", pressure.largest, "1"}};
  };
  return scene;
}

int main(int argc, char** argv) { return driver::drive(argc, argv, "patch_test", build); }
