// What one update of an element costs in Nereid, to be put beside tests/benchmark/floor.cpp.
//
//     cost hexahedra|viscous|full|plates N STEPS
//
// A block of N^3 hexahedra (one point with springs or dashpots, or eight points), or a sheet of about 2 N^2 plates, plastic, on one thread.
// Prints the nanoseconds per element update of the element kernels alone and of the whole step with its ledger.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/parallel.hpp"
#include "dynamics/step.hpp"
#include "mesh/box.hpp"

using namespace nereid;

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

dynamics::Model hexahedra(int n, const material::J2Bilinear& law, const element::AnyHexahedronOptions& options) {
  dynamics::Model model;
  model.mesh = mesh::box("block", {Vec3::Zero(), Vec3::Ones(), {n, n, n}});
  model.blocks.push_back(element::solids(model.mesh, "block", law, options));
  dynamics::finalize(model);
  return model;
}

/// One face of a box as a sheet.
dynamics::Model plates(int n, const material::J2Bilinear& law) {
  const mesh::Mesh box = mesh::box("block", {Vec3::Zero(), Vec3::Ones(), {n, n, 1}});
  const mesh::Surface& face = mesh::surface(box, "block.z_low");
  const Subset nodes = mesh::surface_nodes(face);
  std::vector<Index> number(box.X.cols(), -1);
  dynamics::Model model;
  model.mesh.X.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    number[nodes[i]] = static_cast<Index>(i);
    model.mesh.X.col(static_cast<Eigen::Index>(i)) = box.X.col(nodes[i]);
  }
  Table<3> triangles = face.facets;
  for (Index& node : triangles.reshaped()) node = number[node];
  model.mesh.triangles = {{"sheet", triangles}};
  element::Plate::Options options;
  options.thickness = 0.1 / n;
  model.blocks.push_back(element::plates(model.mesh, "sheet", law, options));
  dynamics::finalize(model);
  return model;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "hexahedra";
  const int n = argc > 2 ? std::atoi(argv[2]) : 20, steps = argc > 3 ? std::atoi(argv[3]) : 400;
  use_threads(1);
  const material::J2Bilinear law{1.0, 1.0, 0.3, 1e-3, 0.1};
  using element::Hexahedron;
  const auto control = kind == "viscous" ? Hexahedron::Hourglass::viscous : Hexahedron::Hourglass::stiffness;
  const Hexahedron::Options one_point{.viscosity = {}, .hourglass_kind = control};
  const dynamics::Model model = kind == "plates" ? plates(n, law)
                                : kind == "full" ? hexahedra(n, law, element::FullHexahedron::Options{})
                                                 : hexahedra(n, law, one_point);
  dynamics::State state = dynamics::initial_state(model, {});
  dynamics::Forces forces = dynamics::make_forces(model);
  for (Eigen::Index node = 0; node < state.v.cols(); ++node)  // stretched and sheared, so that it flows
    state.v.col(node) = Vec3(0.02 * model.mesh.X(0, node), 0.01 * model.mesh.X(0, node), 0.01 * model.mesh.X(1, node));
  const double dt = 0.5 * dynamics::start(model, state, forces).elements.step;

  double began = seconds();
  for (int s = 0; s < steps; ++s) dynamics::step(model, dt, state, forces);
  const double step_seconds = seconds() - began;
  forces.dx *= 1e-9, forces.rotation *= 1e-9;
  began = seconds();
  for (int s = 0; s < steps; ++s)
    element::advance(model.blocks[0], state.x, forces.dx, forces.rotation, 1e-9 * dt, state.blocks[0], state.tiles[0], forces.reports[0]);
  const double kernel_seconds = seconds() - began;

  const double updates = static_cast<double>(element::tiling(model.blocks[0]).elements) * steps;
  std::printf("%s lanes %d elements %d  kernel %.2f  step %.2f ns per element update  (work %.6g)\n", kind.c_str(), lanes,
              element::tiling(model.blocks[0]).elements, kernel_seconds * 1e9 / updates, step_seconds * 1e9 / updates,
              state.blocks[0].work);
}
