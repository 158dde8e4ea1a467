// What one update of an element costs in Nereid, to be put beside tests/benchmark/floor.cpp.
//
//     cost hexahedra|springs|viscous|full|elastic|fluid|plates|kept|contact|automatic|tied N STEPS
//
// A block of N^3 hexahedra (one point with assumed strains, springs or dashpots, or eight points), or a sheet of about 2 N^2 plates
// whose thickness follows their strain or is kept, plastic, on one thread; `elastic` and `fluid` have the options of a scene that says
// nothing, with viscosity, and are compressed. Prints the nanoseconds per element update of the element
// kernels alone and of the whole step with its ledger.
// Contact presses a block of 2N x 2N x N cells on one of N x N x N/2, and prints the nanoseconds of the interface per near apex and step,
// closed and open, beside the step of the elements, the bytes that an apex takes that is near and one that is far, and what contact adds
// to the step of two blocks that are pressed together, with waves in them and a tenth of their nodes on the interface. Tied joins two
// blocks of N x N x 9 and M x M x 9 cells in which waves go, and prints what the tie adds per tied apex and step of the elements, and
// the iterations of its solver. Automatic prints what an automatic contact adds to the step of a hundred bodies of N^3 cells that are far
// apart and swing, how often it searches and how many steps a search takes; then what it adds to the step of two bodies pressed together,
// beside a declared contact.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <tuple>

#include "base/parallel.hpp"
#include "contact/search/near.hpp"
#include "dynamics/automatic.hpp"
#include "dynamics/step.hpp"
#include "element/corners.hpp"
#include "mesh/box.hpp"
#include "mesh/skin.hpp"

using namespace nereid;

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

dynamics::Model hexahedra(int n, const element::AnyLaw& law, const element::AnyHexahedronOptions& options) {
  dynamics::Model model;
  model.mesh = mesh::box("block", {Vec3::Zero(), Vec3::Ones(), {n, n, n}});
  model.blocks.push_back(element::solids(model.mesh, "block", law, options));
  dynamics::finalize(model);
  return model;
}

/// One face of a box as a sheet.
dynamics::Model plates(int n, const material::J2Bilinear& law, element::Plate::Thinning thinning) {
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
  options.thinning = thinning;
  model.blocks.push_back(element::plates(model.mesh, "sheet", law, options));
  dynamics::finalize(model);
  return model;
}

/// Nanoseconds per apex and step of an interface: finding, forces, and its step limit on the time step.
double contact_cost(const dynamics::Model& model, dynamics::State& state, dynamics::Forces& forces, double dt, int steps) {
  contact::Memory& memory = std::get<contact::Memory>(state.contacts[0]);
  const contact::Interface& interface = std::get<contact::Interface>(model.contacts[0]);
  double sum = 0;
  const double began = seconds();
  for (int s = 0; s < steps; ++s) {
    contact::advance(interface, state.x, state.v, state.omega, dt, memory, std::get<contact::Workspace>(forces.contacts[0]));
    contact::add_forces(interface, memory, forces.force, forces.moment);
    sum += contact::stable_step(interface, model.mass, model.inertia, memory, std::get<contact::Workspace>(forces.contacts[0])).step;
  }
  const double spent = seconds() - began;
  if (!(sum > 0)) std::printf("no vote\n");
  return spent * 1e9 / (static_cast<double>(steps) * static_cast<double>(interface.apexes.size()));
}

void add_skin(mesh::Mesh& mesh, const std::string& name) {
  mesh.surfaces.push_back({name + ".skin", mesh::skin(mesh.X, mesh.hexahedra).facets});
}

/// Two blocks, and the state of a run.
struct Pressed {
  dynamics::Model model;
  dynamics::State state;
  dynamics::Forces forces;
};

enum class Joined { no, declared, both_passes, automatic };

/// A block over another, so many cells each and so far above it. The lower face of the one rests, and the upper one of the other goes down.
Pressed pressed(const Eigen::Vector3i& above, const Eigen::Vector3i& below, double gap, Joined joined, const material::J2Bilinear& law,
                const element::Hexahedron::Options& options, contact::Method method = contact::Method::penalty) {
  dynamics::Model model;
  const Vec3 low(-0.2257, -0.2457, 1 + gap), high(1.2457, 1.2257, 2 + gap);  // so that apexes stand anywhere over facets
  mesh::Mesh base = mesh::box("base", {low, high, below});
  mesh::Mesh block = mesh::box("block", {Vec3::Zero(), Vec3::Ones(), above});
  add_skin(base, "base"), add_skin(block, "block");
  model.mesh = mesh::join(base, block);
  model.blocks.push_back(element::solids(model.mesh, "base", law, options));
  model.blocks.push_back(element::solids(model.mesh, "block", law, options));
  load::Plane rests, presses;
  rests.name = "rests", rests.nodes = mesh::node_set(model.mesh, "block.z_low");
  presses.name = "presses", presses.nodes = mesh::node_set(model.mesh, "base.z_high");
  presses.velocity = [](double) { return -1e-4; };
  model.constraints.planes = {rests, presses};
  dynamics::finalize(model);
  dynamics::InterfaceOptions joint;
  joint.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  joint.method = method;
  joint.restitution = 0;  // nothing bounces
  std::vector<contact::AnyMemory> memories;
  std::vector<dynamics::Connected> connected;
  joint.two_passes = joined == Joined::both_passes;
  if (joined == Joined::declared || joined == Joined::both_passes)
    connected = dynamics::connect(model, "joint", "block.z_high", "base.z_low", joint);
  if (joined == Joined::automatic) connected = dynamics::connect_automatic(model, "joint", {{"base"}, {"block"}}, {}, joint);
  for (auto& one : connected) memories.push_back(std::move(one.memory));
  dynamics::State state = dynamics::initial_state(model, std::move(memories));
  dynamics::Forces forces = dynamics::make_forces(model);
  dynamics::start(model, state, forces);
  return {std::move(model), std::move(state), std::move(forces)};
}

/// Moves the base down until all apexes are in contact.
void close(Pressed& scene) {
  const Index base = static_cast<Index>(mesh::node_set(scene.model.mesh, "base").size());
  scene.state.v.row(2).leftCols(base).setConstant(-1e-9);
  scene.state.x.row(2).leftCols(base).array() -= 1e-10;
  for (int s = 0; s < 2; ++s) {
    scene.state.x += 1e-9 * scene.state.v;
    contact::advance(std::get<contact::Interface>(scene.model.contacts[0]), scene.state.x, scene.state.v, scene.state.omega, 1,
                     std::get<contact::Memory>(scene.state.contacts[0]),
                     std::get<contact::Workspace>(scene.forces.contacts[0]));
  }
}

Index closed_apexes(const Pressed& scene) {
  const auto& status = std::get<contact::Memory>(scene.state.contacts[0]).status;
  return static_cast<Index>(std::count(status.begin(), status.end(), contact::Status::closed));
}

/// Nanoseconds per step of a scene.
double step_cost(Pressed& scene, double dt, int steps) {
  dynamics::step(scene.model, dt, scene.state, scene.forces);
  const double began = seconds();
  for (int s = 0; s < steps; ++s) dynamics::step(scene.model, dt, scene.state, scene.forces);
  return (seconds() - began) * 1e9 / steps;
}

/// The step of a scene that is pressed. [s]
double step_of(const Pressed& scene) { return 0.5 * std::min(scene.state.step_limits.elements.step, scene.state.step_limits.contact.step); }
constexpr int until_closed = 600;  // steps; the scenes begin with a blow

/// What contact adds to the step where a tenth of the nodes lies on the interface.
struct Added {
  double share, per_apex;  // [-] [ns]
  Index closed;
};
Added share_of_contact(int n, int steps, const material::J2Bilinear& law, const element::Hexahedron::Options& options,
                       contact::Method method) {
  const Eigen::Vector3i cells(n, n, 9);
  Pressed with = pressed(cells, cells, 0, Joined::declared, law, options, method);
  Pressed without = pressed(cells, cells, 0, Joined::no, law, options, method);
  const double dt = step_of(with);
  step_cost(with, dt, until_closed), step_cost(without, dt, until_closed);
  constexpr int rounds = 21;
  std::vector<double> added, base;
  for (int round = 0; round < rounds; ++round) {
    base.push_back(step_cost(without, dt, steps / rounds));
    added.push_back(step_cost(with, dt, steps / rounds) / base.back() - 1);
  }
  for (auto* values : {&added, &base}) std::nth_element(values->begin(), values->begin() + rounds / 2, values->end());
  const double share = added[rounds / 2];
  return {share, share * base[rounds / 2] / ((n + 1) * (n + 1)), closed_apexes(with)};
}

int contact_costs(int n, int steps, const material::J2Bilinear& law, const element::Hexahedron::Options& options) {
  const auto over = [&](double gap) { return pressed({n, n, n / 2}, {2 * n, 2 * n, n}, gap, Joined::declared, law, options); };
  Pressed closed = over(0), open = over(0.3 / n), far = over(5);
  close(closed);
  const Index in_contact = closed_apexes(closed);
  const double of_closed = contact_cost(closed.model, closed.state, closed.forces, 1e-30, steps);
  const double of_open = contact_cost(open.model, open.state, open.forces, 1e-30, steps);
  const double of_far = contact_cost(far.model, far.state, far.forces, 1e-30, steps);
  const double element_step = step_cost(far, step_of(far), steps);
  double elements = 0;
  for (const auto& block : far.model.blocks) elements += static_cast<double>(element::tiling(block).elements);
  const auto apexes = static_cast<double>(std::get<contact::Interface>(closed.model.contacts[0]).apexes.size());
  const contact::Memory& memory = std::get<contact::Memory>(far.state.contacts[0]);
  const double bytes = static_cast<double>(memory.near.size() * sizeof(contact::Near)) / apexes + sizeof(Index) + sizeof(contact::Feature) +
                       sizeof(contact::Status) + 2 * sizeof(double) + sizeof(std::int64_t) + 3 * sizeof(double);
  const Added penalty = share_of_contact(n, steps, law, options, contact::Method::penalty);
  const Added multiplier = share_of_contact(n, steps, law, options, contact::Method::multiplier);
  std::printf("contact apexes %.0f (%d closed)  closed %.2f  open %.2f  far %.3f ns per apex and step; elements %.2f ns; "
              "an apex that is near takes %zu bytes, one that is far %.0f; contact of a tenth of the nodes adds to the step of two blocks "
              "that are pressed %.1f %%, %.1f ns per apex (%d closed), by multipliers %.1f %%, %.1f ns (%d closed)\n",
              apexes, in_contact, of_closed, of_open, of_far, element_step / elements, sizeof(contact::Near), bytes,
              100 * penalty.share, penalty.per_apex, penalty.closed, 100 * multiplier.share, multiplier.per_apex, multiplier.closed);
  return 0;
}

/// A hundred blocks of N^3 cells, two edges apart, in an automatic contact, that swing with strains of up to so much.
Pressed far_and_swinging(int n, double strain, const material::J2Bilinear& law, const element::Hexahedron::Options& options) {
  constexpr int rows = 10;
  dynamics::Model model;
  std::vector<dynamics::TouchingBody> bodies;
  for (int i = 0; i < rows * rows; ++i) {
    bodies.push_back({"block" + std::to_string(i)});
    const Vec3 low(3 * (i % rows), 3 * (i / rows), 0);  // NOLINT(bugprone-integer-division): rows and columns
    mesh::Mesh block = mesh::box(bodies.back().name, {low, low + Vec3::Ones(), {n, n, n}});
    add_skin(block, bodies.back().name);
    model.mesh = i == 0 ? block : mesh::join(model.mesh, block);
  }
  for (const auto& body : bodies) model.blocks.push_back(element::solids(model.mesh, body.name, law, options));
  dynamics::finalize(model);
  std::vector<contact::AnyMemory> memories;
  for (auto& one : dynamics::connect_automatic(model, "all", bodies, {}, {})) memories.push_back(std::move(one.memory));
  dynamics::State state = dynamics::initial_state(model, std::move(memories));
  dynamics::Forces forces = dynamics::make_forces(model);
  for (Eigen::Index node = 0; node < state.v.cols(); ++node) state.v(0, node) = strain * std::sin(7 * model.mesh.X(0, node));
  dynamics::start(model, state, forces);
  return {std::move(model), std::move(state), std::move(forces)};
}

/// Two blocks with a tie between them or none, in which waves go.
Pressed in_waves(int above, int below, double gap, bool joined, contact::Method method, const material::J2Bilinear& law,
                 const element::Hexahedron::Options& options) {
  dynamics::Model model;
  model.mesh = mesh::join(mesh::box("base", {Vec3(0, 0, 1 + gap), Vec3(1, 1, 2 + gap), {below, below, 9}}),
                          mesh::box("block", {Vec3::Zero(), Vec3::Ones(), {above, above, 9}}));
  for (const char* name : {"base", "block"}) model.blocks.push_back(element::solids(model.mesh, name, law, options));
  dynamics::finalize(model);
  dynamics::InterfaceOptions joint;
  joint.kind = contact::InterfaceKind::tied, joint.method = method;
  std::vector<contact::AnyMemory> memories;
  if (joined)
    for (auto& pass : dynamics::connect(model, "joint", "block.z_high", "base.z_low", joint)) memories.push_back(std::move(pass.memory));
  dynamics::State state = dynamics::initial_state(model, std::move(memories));
  dynamics::Forces forces = dynamics::make_forces(model);
  for (Eigen::Index node = 0; node < state.v.cols(); ++node) {
    const Vec3 X = model.mesh.X.col(node);
    state.v.col(node) = 1e-4 * Vec3(std::sin(5 * X.y() + 3 * X.z()), std::cos(7 * X.x() + X.z()), std::sin(4 * X.x() * X.z() + X.y()));
  }
  dynamics::start(model, state, forces);
  return {std::move(model), std::move(state), std::move(forces)};
}

int bonded_costs(int n, int steps, const material::J2Bilinear& law, const element::Hexahedron::Options& options) {
  for (const auto& [above, below, gap] : {std::tuple(n, n, 0.0), std::tuple(n, n, 0.02), std::tuple(n, 3 * n / 4, 0.0),
                                          std::tuple(3 * n / 4, n, 0.0), std::tuple(n, 3 * n / 4, 0.02), std::tuple(n, n / 4, 0.0)})
    for (const auto method : {contact::Method::multiplier, contact::Method::penalty}) {
      Pressed with = in_waves(above, below, gap, true, method, law, options);
      Pressed without = in_waves(above, below, gap, false, method, law, options);
      const double dt = 0.5 * with.state.step_limits.elements.step;
      const double smaller = std::max(1.0, 0.9 * with.state.step_limits.elements.step / with.state.step_limits.contact.step);
      const auto cost = [&](Pressed& scene) {
        const double began = seconds();
        for (int s = 0; s < steps; ++s)
          dynamics::step(scene.model, method == contact::Method::penalty ? dt / smaller : dt, scene.state, scene.forces);
        return (seconds() - began) * 1e9 / steps;
      };
      double least_with = INFINITY, least_without = INFINITY;
      for (int round = 0; round < 3; ++round)
        least_with = std::min(least_with, cost(with)), least_without = std::min(least_without, cost(without));
      const double ties = (above + 1.0) * (above + 1.0);
      std::printf("tied %d x %d on %d x %d, gap %g, %s: %.0f ns per tie and step, step %.1f %% dearer, %.1f times the steps of the "
                  "elements",
                  above, above, below, below, gap, method == contact::Method::penalty ? "penalty" : "multiplier",
                  (least_with - least_without) / ties, 100 * (least_with / least_without - 1),
                  method == contact::Method::penalty ? smaller : 1.0);
      if (method == contact::Method::multiplier)
        std::printf(", %.1f iterations", static_cast<double>(with.forces.multipliers.ties.iterations) / (3.0 * steps));
      std::printf("\n");
    }
  return 0;
}

/// Takes the contacts out of a scene, or puts them back.
void swap_contacts(Pressed& scene, Pressed& kept) {
  std::swap(scene.model.contacts, kept.model.contacts);
  std::swap(scene.state.contacts, kept.state.contacts);
  std::swap(scene.forces.contacts, kept.forces.contacts);
}

/// The median step of a scene with its contacts and of the same without, which take turns on the same memory. [ns] [ns]
std::array<double, 2> with_and_without(Pressed& scene, double dt, int steps) {
  constexpr int rounds = 41;
  std::vector<double> with, without;
  Pressed taken_out;
  const auto cost = [&] {
    const double began = seconds();
    for (int s = 0; s < steps / rounds; ++s) dynamics::step(scene.model, dt, scene.state, scene.forces);
    return (seconds() - began) * 1e9 / (steps / rounds);
  };
  for (int round = 0; round < rounds; ++round) {
    with.push_back(cost());
    swap_contacts(scene, taken_out);
    without.push_back(cost());
    swap_contacts(scene, taken_out);
  }
  for (auto* costs : {&with, &without}) std::nth_element(costs->begin(), costs->begin() + rounds / 2, costs->end());
  return {with[rounds / 2], without[rounds / 2]};
}

/// A step of two blocks that are pressed on each other by an automatic contact, a declared one, and one of two passes, over one without
/// contact: medians. [-] [-] [-]
/// Where the memory of a scene comes to lie counts, so scenes are made anew in every round.
std::array<double, 3> costs_of_pressed(int n, int steps, const material::J2Bilinear& law, const element::Hexahedron::Options& options) {
  constexpr int rounds = 15;
  const Eigen::Vector3i cells(2 * n, 2 * n, 9);
  std::array<std::vector<double>, 3> ratios;
  for (int round = 0; round < rounds; ++round) {
    std::array<double, 4> cost;
    std::array<Pressed, 4> scenes;
    for (const Joined joined : {Joined::no, Joined::automatic, Joined::declared, Joined::both_passes})
      scenes[static_cast<std::size_t>(joined)] = pressed(cells, cells, 0, joined, law, options, contact::Method::multiplier);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      step_cost(scenes[i], step_of(scenes[i]), until_closed);
      cost[i] = step_cost(scenes[i], step_of(scenes[i]), steps / rounds);
    }
    const auto at = [&](Joined joined) { return cost[static_cast<std::size_t>(joined)]; };
    std::size_t i = 0;
    for (const Joined joined : {Joined::automatic, Joined::declared, Joined::both_passes})
      ratios[i++].push_back(at(joined) / at(Joined::no));
  }
  for (auto& ratio : ratios) std::nth_element(ratio.begin(), ratio.begin() + rounds / 2, ratio.end());
  return {ratios[0][rounds / 2], ratios[1][rounds / 2], ratios[2][rounds / 2]};
}

int automatic_costs(int n, int steps, const material::J2Bilinear& law, const element::Hexahedron::Options& options) {
  for (const double strain : {1e-9, 1e-3, 1e-2, 3e-2}) {
    Pressed scene = far_and_swinging(n, strain, law, options);
    const auto [with, without] = with_and_without(scene, 0.5 * scene.state.step_limits.elements.step, steps);
    contact::Memory& memory = std::get<contact::Memory>(scene.state.contacts[0]);
    const auto searches = memory.searches;
    const double began = seconds();
    contact::search(std::get<contact::Interface>(scene.model.contacts[0]), scene.state.x, memory,
                    std::get<contact::Workspace>(scene.forces.contacts[0]));
    std::printf("automatic, 100 bodies that swing by %g: adds %.1f %% to a step, %lld searches in %d steps, one takes %.1f steps\n", strain,
                100 * (with / without - 1), static_cast<long long>(searches), steps, (seconds() - began) * 1e9 / without);
  }
  const auto [automatic, declared, both_passes] = costs_of_pressed(n, steps, law, options);
  std::printf("automatic, two bodies on each other: %.2f of the step without contact, declared %.2f, of two passes %.2f; %.2f of that with "
              "the declared one, %.2f of that of two passes\n",
              automatic, declared, both_passes, automatic / declared, automatic / both_passes);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "hexahedra";
  const int n = argc > 2 ? std::atoi(argv[2]) : 20, steps = argc > 3 ? std::atoi(argv[3]) : 400;
  use_threads(1);
  const material::J2Bilinear law{1.0, 1.0, 0.3, {1e-3, 0.1}};
  using element::Hexahedron;
  using Control = Hexahedron::Hourglass;
  const auto control = kind == "viscous" ? Control::viscous : kind == "springs" ? Control::stiffness : Control::assumed_strain;
  const double coefficient = kind == "viscous"   ? Hexahedron::usual_viscous
                             : kind == "springs" ? Hexahedron::usual_stiffness
                                                 : Hexahedron::usual_assumed;
  const Hexahedron::Options one_point{.hourglass = coefficient, .viscosity = {}, .hourglass_kind = control};
  const material::J2Bilinear elastic{1.0, 1.0, 0.3, {1e3, 0.1}};
  if (kind == "contact") return contact_costs(n, steps, elastic, one_point);
  if (kind == "automatic") return automatic_costs(n, steps, elastic, one_point);
  if (kind == "tied") return bonded_costs(n, steps, law, one_point);
  const dynamics::Model model = kind == "plates" ? plates(n, law, element::Plate::Thinning::by_law)
                                : kind == "kept" ? plates(n, law, element::Plate::Thinning::constant)
                                : kind == "full" ? hexahedra(n, law, element::FullHexahedron::Options{})
                                : kind == "fluid"   ? hexahedra(n, material::LinearFluid{1.0, 1.0, 0.0}, element::Fluid::Options{})
                                : kind == "elastic" ? hexahedra(n, material::Elastic{1.0, 1.0, 0.3}, Hexahedron::Options{})
                                                 : hexahedra(n, law, one_point);
  dynamics::State state = dynamics::initial_state(model, {});
  dynamics::Forces forces = dynamics::make_forces(model);
  const double along = kind == "fluid" || kind == "elastic" ? -0.02 : 0.02;
  for (Eigen::Index node = 0; node < state.v.cols(); ++node)  // stretched or compressed, and sheared, so that it flows
    state.v.col(node) = Vec3(along * model.mesh.X(0, node), 0.01 * model.mesh.X(0, node), 0.01 * model.mesh.X(1, node));
  const double dt = 0.5 * dynamics::start(model, state, forces).elements.step;

  double began = seconds();
  for (int s = 0; s < steps; ++s) dynamics::step(model, dt, state, forces);
  const double step_seconds = seconds() - began;
  forces.dx *= 1e-9, forces.rotation *= 1e-9;
  began = seconds();
  for (int s = 0; s < steps; ++s)
    element::advance(model.blocks[0], state.x, forces.dx, forces.rotation, 1e-9 * dt, state.blocks[0], state.tiles[0], forces.reports[0]);
  const double kernel_seconds = seconds() - began;

  constexpr int looks = 10;
  began = seconds();
  double seen = 0;
  for (int look = 0; look < looks; ++look) seen += element::smallest_corner(model.blocks[0], model.mesh.X, state.x).ratio;
  const double corner_seconds = (seconds() - began) / looks;
  began = seconds();
  for (int look = 0; look < looks; ++look) seen += element::contrast(model.blocks[0], state.x, state.blocks[0]).strain;
  const double contrast_seconds = (seconds() - began) / looks, one_step = step_seconds / steps;

  const double updates = static_cast<double>(element::tiling(model.blocks[0]).elements) * steps;
  std::printf("%s lanes %d elements %d  kernel %.2f  step %.2f ns per element update; looks at corners %.1f and at neighbours %.1f steps  "
              "(work %.6g, seen %.6g)\n",
              kind.c_str(), lanes, element::tiling(model.blocks[0]).elements, kernel_seconds * 1e9 / updates, step_seconds * 1e9 / updates,
              corner_seconds / one_step, contrast_seconds / one_step, state.blocks[0].work, seen);
}
