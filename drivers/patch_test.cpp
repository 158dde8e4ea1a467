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

#include <cmath>

#include "drivers/driver.hpp"
#include "input/load_readers.hpp"

using namespace nereid;

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
    const auto fields = element::fields(view.model.blocks[b], view.model.mesh.X, view.now.x, view.now.blocks[b]);
    const auto& stress = fields.front().values;  // XX YY ZZ XY YZ XZ
    for (Eigen::Index e = 0; e < stress.cols(); ++e) error.see(stress(2, e), -pressure);
  }
  return error;
}

/// Of the contact pressure of all apexes.
Error pressure_error(const dynamics::View& view, double pressure) {
  Error error;
  for (std::size_t c = 0; c < contact::passes_of(view.model.contacts); ++c) {
    const auto forces = dynamics::forces_of_contact(view.model, view.now, c);
    for (Index a = 0; a < static_cast<Index>(contact::sides(view.model.contacts[c]).apexes.size()); ++a)
      error.see(dynamics::traction_at(view, c, a, forces).pressure, pressure);
  }
  return error;
}

double applied(const dynamics::View& view) { return std::get<load::Pressure>(view.model.loads[0]).pressure(view.now.t); }

model::Simulation build(const input::CaseFile& file) {
  const input::Section root = file.root(), blocks = root.section("blocks");
  const double width = blocks.quantity("width", dim::length, input::positive),
               height = blocks.quantity("height", dim::length, input::positive);
  const auto lower = blocks.counts("cells_lower", 1, 400), upper = blocks.counts("cells_upper", 1, 400);
  const bool apexes_above = blocks.choice_or("apexes", "upper", {"upper", "lower"}) == "upper";
  const auto law = input::read_law(root.section("material"));
  const auto element = input::read_hexahedron_options(root.section_or_empty("element"));
  const double pressure = root.quantity("pressure", dim::stress, input::positive);

  model::Scene scene;
  const auto block = [&](const char* name, double from, const std::array<int, 3>& cells) {
    const Vec3 low(0, 0, from);
    return model::Body{.name = name, .mesh = mesh::Box{low, low + Vec3(width, width, height), Eigen::Vector3i(cells.data())}, .law = law,
                       .solid = element, .at = "blocks"};
  };
  const auto hold = [](const char* name, const Vec3& normal, const std::vector<std::string>& nodes) {
    return model::Plane{.name = name, .kind = load::PlaneKind::constrained, .nodes = nodes, .normal = normal, .at = "blocks"};
  };
  scene.bodies = {block("lower", 0, lower), block("upper", height, upper)};
  const char* sides[] = {"lower.z_high", "upper.z_low"};
  scene.contacts = {{.name = "interface", .apexes = sides[apexes_above], .base = sides[!apexes_above], .height_from_thickness = false,
                     .interface = input::read_solid_interface(root.section_or_empty("contact")), .at = "contact"}};
  scene.planes = {hold("floor", Vec3::UnitZ(), {"lower.z_low"}),
                  hold("walls_x", Vec3::UnitX(), {"lower.x_low", "lower.x_high", "upper.x_low", "upper.x_high"}),
                  hold("walls_y", Vec3::UnitY(), {"lower.y_low", "lower.y_high", "upper.y_low", "upper.y_high"})};
  scene.loads = {{.name = "pressure", .kind = model::LoadKind::pressure, .on = "upper.z_high",
                  .value = model::uniform(Vec3(pressure, 0, 0))}};
  scene.relaxation = input::read_relaxation(root).value_or(dynamics::Relaxation{});
  scene.time = input::read_time(root.section("time"));
  scene.recording = input::read_recording(root.section_or_empty("output"), scene.time.end);
  model::Simulation simulation = input::build(file, scene);
  simulation.probes = {{"stress_error", "1", [](const auto& view, auto&) { return stress_error(view, applied(view)).mean(); }},
                       {"pressure_error", "1", [](const auto& view, auto&) { return pressure_error(view, applied(view)).mean(); }},
                       {"residual", "1", [](const auto& view, auto&) { return view.now.relaxation.residual; }}};
  return simulation;
}

std::vector<output::Result> results(const model::Simulation& simulation) {
  const dynamics::View last = model::view(simulation);
  const Error stress = stress_error(last, applied(last)), pressure = pressure_error(last, applied(last));
  return {{"stress_error_mean", stress.mean(), "1"},
          {"stress_error_largest", stress.largest, "1"},
          {"pressure_error_mean", pressure.mean(), "1"},
          {"pressure_error_largest", pressure.largest, "1"}};
}

int main(int argc, char** argv) { return driver::drive(argc, argv, "patch_test", build, results); }
