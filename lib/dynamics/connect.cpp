#include "dynamics/connect.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "contact/coarseness.hpp"
#include "contact/impact_step.hpp"

namespace nereid::dynamics {

namespace {

/// A face of an element on a surface: its facets that look about the same way.
struct Face {
  Index element;
  Vec3 area;  // [m2] of the facets together, along their normal
};

constexpr double same_way = 0.7;  // [-] cosine, of 45 degrees: halves of a warped face are nearer, faces of a brick farther

/// Faces of the elements of a block on a surface: a facet belongs to the element that has all its nodes.
std::vector<Face> faces(const element::Connectivity& nodes, const mesh::Mesh& mesh, const mesh::Surface& surface) {
  std::vector<std::vector<Index>> elements_of(mesh.X.cols());
  for (Index e = 0; e < nodes.cols(); ++e)
    for (Index a = 0; a < nodes.rows(); ++a) {
      std::vector<Index>& there = elements_of[nodes(a, e)];
      if (there.empty() || there.back() != e) there.push_back(e);  // a wedge has some of its nodes twice
    }
  std::vector<Face> list;
  std::vector<std::vector<std::size_t>> of_element(nodes.cols());
  for (Index f = 0; f < surface.facets.cols(); ++f) {
    const auto corner = [&](int a) { return Vec3(mesh.X.col(surface.facets(a, f))); };
    const Vec3 area = (corner(1) - corner(0)).cross(corner(2) - corner(0)) / 2;
    for (const Index e : elements_of[surface.facets(0, f)]) {
      const auto has = [&](Index node) { return (nodes.col(e).array() == node).any(); };
      if (!has(surface.facets(1, f)) || !has(surface.facets(2, f))) continue;
      const auto same = std::find_if(of_element[e].begin(), of_element[e].end(), [&](std::size_t at) {
        return list[at].area.dot(area) > same_way * list[at].area.norm() * area.norm();
      });
      if (same != of_element[e].end()) {
        list[*same].area += area;
        continue;
      }
      of_element[e].push_back(list.size());
      list.push_back({e, area});
    }
  }
  return list;
}

/// Depth behind a face of an element along its normal, and stiffness per area there.
struct Behind {
  double depth, stiffness;  // [m] [Pa/m]
};

std::vector<Behind> elements_behind(const element::AnyBlock& any, const mesh::Mesh& mesh, const mesh::Surface& surface) {
  const material::Lame lame = std::visit([](const auto& block) { return material::lame(block.law); }, any);
  std::vector<Behind> list;
  for (const Face& face : faces(element::nodes(any), mesh, surface)) {
    const double depth = element::depth(any, mesh.X, face.element, face.area.norm());
    list.push_back({depth, (lame.lambda + 2 * lame.mu) / depth});
  }
  return list;
}

/// For each apex on a symmetry plane the directions the plane allows; empty without such planes.
std::vector<Mat3> allowed_directions(const Model& model, const Subset& apexes) {
  const auto& planes = model.constraints.planes;
  const bool any = std::any_of(planes.begin(), planes.end(), [](const auto& p) { return p.kind == load::PlaneKind::symmetry; });
  if (!any) return {};
  load::Constraints symmetry;
  for (const auto& plane : planes)
    if (plane.kind == load::PlaneKind::symmetry) symmetry.planes.push_back(plane);
  const std::vector<Index> no_turns(model.mesh.X.cols(), -1);
  const load::Memory memory = load::prepare(symmetry, static_cast<Index>(model.mesh.X.cols()), no_turns);
  std::vector<Mat3> allowed(apexes.size(), Mat3::Identity());
  for (std::size_t a = 0; a < apexes.size(); ++a) {
    const Index place = memory.row_of_node[apexes[a]];
    if (place >= 0) allowed[a] = memory.nodes[place].allowed;
  }
  return allowed;
}

/// Whether all nodes of a surface are plate nodes.
bool rotates(const Model& model, const mesh::Surface& surface) {
  const Index node = surface.facets.size() > 0 ? surface.facets(0, 0) : -1;
  return node >= 0 && model.rotation_of_node[node] >= 0;
}

/// Whether a surface is of a rigid body.
bool is_rigid(const Model& model, const mesh::Surface& surface) {
  const Index node = surface.facets.size() > 0 ? surface.facets(0, 0) : -1;
  return std::any_of(model.rigid_bodies.begin(), model.rigid_bodies.end(),
                     [&](const rigid::Body& body) { return std::binary_search(body.nodes.begin(), body.nodes.end(), node); });
}

/// Stiffness of the softer of two sides; a rigid body gives way nowhere, and only between two of them its modulus counts. [Pa/m]
double softer_stiffness(const Model& model, const mesh::Surface& apexes, const mesh::Surface& base) {
  const double of_apexes = surface_stiffness(model, apexes), of_base = surface_stiffness(model, base);
  if (is_rigid(model, apexes) == is_rigid(model, base)) return std::min(of_apexes, of_base);
  return is_rigid(model, apexes) ? of_base : of_apexes;
}

/// Half the thickness of the plates of a surface. [m]
double half_thickness(const Model& model, const mesh::Surface& surface) {
  for (const auto& block : model.blocks) {
    const bool has = (element::nodes(block).array() == surface.facets(0, 0)).any();
    const double half = has ? element::thickness(block) / 2 : 0;
    if (half > 0) return half;
  }
  return 0;
}

/// Whether a surface has plates whose thickness changes.
bool thins(const Model& model, const mesh::Surface& surface) {
  return std::any_of(model.blocks.begin(), model.blocks.end(), [&](const auto& block) {
    return element::thins(block) && (element::nodes(block).array() == surface.facets(0, 0)).any();
  });
}

/// The stable step of the elements as they stand, without safety; of rigid bodies alone the longest of the model. [s]
double element_step(const Model& model) {
  const Vectors rest = Vectors::Zero(3, model.mesh.X.cols()), no_rotation = Vectors::Zero(3, model.inertia.size());
  double step = model.longest_step;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const auto& block = model.blocks[b];
    if (is_rigid_block(model, b)) continue;
    element::Memory memory = element::initial_memory(block);
    element::TileForces tiles = element::tile_forces(block);
    element::TileReports reports = element::tile_reports(block);
    step = std::min(step, element::advance(block, model.mesh.X, rest, no_rotation, 0, memory, tiles, reports).step);
  }
  return step;
}

Connected connect_one_pass(Model& model, const std::string& name, const std::string& apex_surface, const std::string& base_surface,
                           const InterfaceOptions& options, contact::Pass pass) {
  const double share = pass == contact::Pass::only ? 1 : 0.5;
  check(model.mass.size() == model.mesh.X.cols(), "finalize() a model before it gets an interface");
  const mesh::Surface& apexes = mesh::surface(model.mesh, apex_surface);
  const mesh::Surface& base = mesh::surface(model.mesh, base_surface);
  contact::Interface interface;
  interface.name = name;
  interface.kind = options.kind;
  interface.method = options.method;
  interface.base = contact::base_surface(base, model.mesh.X);
  contact::mark_halves(interface.base, mesh::faces(model.mesh, base));
  interface.own = contact::fans(apexes.facets, static_cast<Index>(model.mesh.X.cols()));
  interface.apexes = mesh::surface_nodes(apexes);
  interface.area = mesh::tributary_areas(model.mesh, apexes, interface.apexes);
  interface.faces = mesh::faces_around(model.mesh, apexes, interface.apexes);
  interface.facet_area = mesh::facet_areas(model.mesh, base);
  interface.penalty = share * options.penalty.value_or(options.penalty_scale * softer_stiffness(model, apexes, base));
  check(interface.penalty > 0, "an interface needs a penalty or elements on both sides");
  interface.impact_step_factor = contact::impact_step_factor_for(options.energy_gain_limit);
  interface.first_step_factor = options.step_factor;
  interface.pass = pass;
  interface.pass_factor = share;
  interface.restitution = options.restitution;
  interface.impedance = 1 / (1 / surface_impedance(model, apexes) + 1 / surface_impedance(model, base));
  const double depths[] = {surface_depth(model, apexes), surface_depth(model, base)};
  interface.depth = depths[0] > 0 && depths[1] > 0 ? std::min(depths[0], depths[1]) : std::max(depths[0], depths[1]);
  interface.release_height = contact::by_multipliers(interface) ? contact::multipliers_reach * interface.depth : 0;
  interface.margin = std::sqrt(2 * interface.facet_area.mean());  // about the side of a face: a search costs as much as some steps
  interface.longest_step = element_step(model);
  interface.friction = options.friction;
  interface.weights = options.weights;
  interface.area_kind = options.area;
  interface.allowed = allowed_directions(model, interface.apexes);
  for (const load::Plane& plane : model.constraints.planes)
    if (plane.kind == load::PlaneKind::symmetry) contact::goes_on_behind(interface.base, plane.nodes);
  if (rotates(model, apexes) || rotates(model, base)) {
    interface.rotation_of_node = model.rotation_of_node;
    const double apex_half = half_thickness(model, apexes), base_half = half_thickness(model, base);
    interface.arm_of_apex = apex_half / (apex_half + base_half);
  }

  interface.follows_thickness = options.height.from_thickness && options.kind == contact::InterfaceKind::contact &&
                                (thins(model, apexes) || thins(model, base));

  Connected connected;
  contact::Workspace workspace(interface);
  // the whole scene: an apex may start far from its base, and no farther
  const double reach = (model.mesh.X.rowwise().maxCoeff() - model.mesh.X.rowwise().minCoeff()).norm();
  connected.gaps =
      contact::connect(interface, model.mesh.X, reach, options.height, options.initial_penetration, connected.memory, workspace);
  if (pass == contact::Pass::only) {
    const mesh::FacesAround around = mesh::faces_around(model.mesh, base, interface.base_nodes);
    connected.gaps.coarseness = contact::coarseness(interface, around, model.mesh.X, reach, workspace);
  }
  if (options.damping_ratio > 0) {
    const contact::Memory trial = contact::tried_out(interface, model.mesh.X, reach, workspace);
    const double step = contact::stable_step(interface, model.mass, model.inertia, trial, workspace).step;
    interface.damping_time = 2 * options.damping_ratio * step / contact::step_factor(interface, trial.step_factor);  // 2 zeta / omega
  }
  model.interfaces.push_back(std::move(interface));
  return connected;
}

/// Whether one of the edges of a surface is a ridge or a rim.
bool has_ridges(const contact::Edges& edges, const Vectors& X) {
  for (Index e = 0; e < edges.nodes.cols(); ++e)
    if (contact::is_ridge(edges, X, e)) return true;
  return false;
}

/// Adds the edges of a contact, if both surfaces have such that can cross. What the passes have of both sides together is theirs too;
/// needs one of these at the end of the model.
std::optional<Connected> connect_edges(Model& model, const std::string& name, const std::string& apex_surface,
                                       const std::string& base_surface, const InterfaceOptions& options) {
  const mesh::Surface& apexes = mesh::surface(model.mesh, apex_surface);
  const mesh::Surface& base = mesh::surface(model.mesh, base_surface);
  std::vector<Subset> planes;
  for (const load::Plane& plane : model.constraints.planes)
    if (plane.kind == load::PlaneKind::symmetry) planes.push_back(plane.nodes);
  const contact::Interface& pass = model.interfaces.back();
  contact::Interface interface;
  interface.edges = contact::edges_of(model.mesh, apexes, planes);
  interface.base_edges = contact::edges_of(model.mesh, base, planes);
  if (!has_ridges(interface.edges, model.mesh.X) || !has_ridges(interface.base_edges, model.mesh.X)) return std::nullopt;
  interface.name = name + "_edges";
  interface.kind = contact::InterfaceKind::edges;
  interface.method = contact::Method::multiplier;
  interface.apexes = contact::nodes_of(interface.edges);
  interface.base_nodes = contact::nodes_of(interface.base_edges);
  interface.restitution = pass.restitution;
  interface.impedance = pass.impedance;
  interface.depth = pass.depth;
  interface.margin = pass.margin;
  interface.longest_step = pass.longest_step;
  interface.friction = pass.friction;
  interface.rotation_of_node = pass.rotation_of_node;
  interface.edge_height =
      options.height.from_initial_height ? half_thickness(model, apexes) + half_thickness(model, base) : options.height.given;
  Connected connected;
  contact::Workspace workspace(interface);
  connected.gaps = contact::connect_edges(interface, model.mesh.X, connected.memory, workspace);
  model.interfaces.push_back(std::move(interface));
  return connected;
}

}  // namespace

double surface_stiffness(const Model& model, const mesh::Surface& surface) {
  double most = 0;
  for (const auto& block : model.blocks)
    for (const Behind& element : elements_behind(block, model.mesh, surface)) most = std::max(most, element.stiffness);
  return most;
}

double surface_impedance(const Model& model, const mesh::Surface& surface) {
  double most = 0;
  for (const auto& block : model.blocks) {
    if (elements_behind(block, model.mesh, surface).empty()) continue;
    const auto place = static_cast<std::size_t>(&block - model.blocks.data());
    if (element::thickness(block) > 0 || is_rigid_block(model, place)) return std::numeric_limits<double>::infinity();
    most = std::max(most, std::visit([](const auto& b) {
                      const material::Lame lame = material::lame(b.law);
                      return std::sqrt(b.law.density * (lame.lambda + 2 * lame.mu));
                    }, block));
  }
  return most;
}

double surface_depth(const Model& model, const mesh::Surface& surface) {
  double least = 0;
  for (const auto& block : model.blocks)
    for (const Behind& element : elements_behind(block, model.mesh, surface))
      least = least > 0 ? std::min(least, element.depth) : element.depth;
  return least;
}

std::vector<Connected> connect(Model& model, const std::string& name, const std::string& apex_surface, const std::string& base_surface,
                               const InterfaceOptions& options) {
  std::vector<Connected> passes;
  if (!options.two_passes) {
    passes.push_back(connect_one_pass(model, name, apex_surface, base_surface, options, contact::Pass::only));
  } else {
    passes.push_back(connect_one_pass(model, name, apex_surface, base_surface, options, contact::Pass::forth));
    passes.push_back(connect_one_pass(model, name + "_back", base_surface, apex_surface, options, contact::Pass::back));
  }
  if (options.kind == contact::InterfaceKind::bonded || !options.edges) return passes;
  std::optional<Connected> edges = connect_edges(model, name, apex_surface, base_surface, options);
  if (edges) passes.push_back(std::move(*edges));
  return passes;
}

}  // namespace nereid::dynamics
