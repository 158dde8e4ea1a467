#include "dynamics/connect.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "contact/penalty/impact_step.hpp"
#include "contact/report/coarseness.hpp"
#include "dynamics/shapes.hpp"
#include "dynamics/side.hpp"

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

/// Whether a block may have an element on a surface: not where the numbers of their nodes lie apart, as those of different bodies do.
bool may_be_behind(const element::AnyBlock& any, const mesh::Surface& surface) {
  const auto& nodes = element::nodes(any);
  if (nodes.size() == 0 || surface.facets.size() == 0) return false;
  return nodes.minCoeff() <= surface.facets.maxCoeff() && surface.facets.minCoeff() <= nodes.maxCoeff();
}

std::vector<Behind> elements_behind(const element::AnyBlock& any, const mesh::Mesh& mesh, const mesh::Surface& surface) {
  if (!may_be_behind(any, surface)) return {};
  const material::Lame lame = std::visit([](const auto& block) { return material::lame(block.law); }, any);
  std::vector<Behind> list;
  for (const Face& face : faces(element::nodes(any), mesh, surface)) {
    const double depth = element::depth(any, mesh.X, face.element, face.area.norm());
    list.push_back({depth, (lame.lambda + 2 * lame.mu) / depth});
  }
  return list;
}

Connected connect_one_pass(Model& model, const std::string& name, const std::string& apex_surface, const std::string& base_surface,
                           const InterfaceOptions& options, const Vectors& x, contact::Pass pass) {
  const bool in_one_direction = pass == contact::Pass::only || options.heights == contact::Heights::points;
  const double share = in_one_direction ? 1 : 0.5;
  check(model.mass.size() == model.mesh.X.cols(), "finalize() a model before it gets an interface");
  const mesh::Surface& apexes = mesh::surface(model.mesh, apex_surface);
  const mesh::Surface& base = mesh::surface(model.mesh, base_surface);
  contact::Interface interface;
  interface.name = name;
  interface.kind = options.kind;
  interface.slides = options.slides;
  interface.method = options.method;
  interface.base = contact::base_surface(base, model.mesh.X);
  contact::mark_halves(interface.base, mesh::faces(model.mesh, base));
  interface.own = contact::fans(apexes.facets, static_cast<Index>(model.mesh.X.cols()));
  interface.apexes = mesh::surface_nodes(apexes);
  interface.area = mesh::tributary_areas(model.mesh, apexes, interface.apexes);
  interface.faces = mesh::faces_around(model.mesh, apexes, interface.apexes);
  interface.facet_area = mesh::facet_areas(model.mesh, base);
  const Side of_apexes = side_of(model, apexes), of_base = side_of(model, base);
  static_cast<contact::Between&>(interface) = between(of_apexes, of_base, options, share);
  if (auto shapes = shapes_of_pair(model, apexes, base, options, interface)) interface.shapes = std::move(*shapes);
  if (options.heights == contact::Heights::points && pass != contact::Pass::only)
    interface.heights = pass == contact::Pass::back ? contact::Heights::guards : contact::Heights::points;
  check(interface.penalty > 0, "an interface needs a penalty or elements on both sides");
  interface.impact_step_factor = contact::impact_step_factor_for(options.energy_gain_limit);
  interface.first_step_factor = options.step_factor;
  interface.pass = pass;
  interface.pass_factor = share;
  interface.restitution = options.restitution;
  interface.margin = std::sqrt(2 * interface.facet_area.mean());  // about the side of a face: a search costs as much as some steps
  interface.longest_step = element_step(model);
  interface.friction = options.friction;
  interface.weights = options.weights;
  interface.area_kind = options.area;
  interface.allowed = allowed_directions(model, interface.apexes);
  for (const Subset& plane : symmetry_planes(model)) contact::goes_on_behind(interface.base, plane);
  if (of_apexes.turns || of_base.turns) interface.rotation_of_node = model.rotation_of_node;
  interface.follows_thickness = options.height.from_thickness && options.kind == contact::InterfaceKind::contact &&
                                (of_apexes.thins || of_base.thins);
  Connected connected;
  contact::Memory memory;
  contact::Workspace workspace(interface);
  // the whole scene: an apex may start far from its base, and no farther
  const double reach = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  connected.gaps =
      contact::connect(interface, x, reach, options.height, options.initial_penetration, memory, workspace);
  connected.memory = std::move(memory);
  if (in_one_direction && pass != contact::Pass::back && !contact::by_shapes_alone(interface)) {
    const mesh::FacesAround around = mesh::faces_around(model.mesh, base, interface.base_nodes);
    connected.gaps.coarseness = contact::coarseness(interface, around, x, reach, workspace);
  }
  if (options.damping_ratio > 0) {
    const contact::Memory trial = contact::tried_out(interface, x, reach, workspace);
    const double step = contact::stable_step(interface, model.mass, model.inertia, trial, workspace).step;
    interface.damping_time = 2 * options.damping_ratio * step / contact::step_factor(interface, trial.step_factor);  // 2 zeta / omega
  }
  model.contacts.push_back(std::move(interface));
  return connected;
}

/// Adds the edges of a contact, if both surfaces have such that can cross. What the passes have of both sides together is theirs too;
/// needs one of these at the end of the model.
std::optional<Connected> connect_edges(Model& model, const std::string& name, const std::string& apex_surface,
                                       const std::string& base_surface, const InterfaceOptions& options, const Vectors& x) {
  const mesh::Surface& apexes = mesh::surface(model.mesh, apex_surface);
  const mesh::Surface& base = mesh::surface(model.mesh, base_surface);
  const std::vector<Subset> planes = symmetry_planes(model);
  const contact::Sides& pass = contact::sides(model.contacts.back());
  contact::EdgeContact edges;
  static_cast<contact::Sides&>(edges) = pass;
  edges.edges = contact::edges_of(model.mesh, apexes, planes);
  edges.base_edges = contact::edges_of(model.mesh, base, planes);
  if (!has_ridges(edges.edges, model.mesh.X) || !has_ridges(edges.base_edges, model.mesh.X)) return std::nullopt;
  edges.name = name + "_edges";
  edges.apexes = contact::nodes_of(edges.edges);
  edges.base_nodes = contact::nodes_of(edges.base_edges);
  edges.height = options.height.from_initial_height ? side_of(model, apexes).half_thickness + side_of(model, base).half_thickness
                                                    : options.height.given;
  Connected connected;
  contact::EdgeMemory memory;
  contact::EdgeWorkspace workspace(edges);
  connected.gaps = contact::connect(edges, x, memory, workspace);
  connected.memory = std::move(memory);
  model.contacts.push_back(std::move(edges));
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
                               const InterfaceOptions& options, const Vectors* start) {
  const Vectors& x = start != nullptr ? *start : model.mesh.X;
  std::vector<Connected> passes;
  const mesh::Surface &apexes = mesh::surface(model.mesh, apex_surface), &base = mesh::surface(model.mesh, base_surface);
  if (shapes_of_pair(model, apexes, base, options, {})) {
    passes.push_back(connect_one_pass(model, name, apex_surface, base_surface, options, x, contact::Pass::only));
    return passes;
  }
  const auto side = [&](const std::string& surface) { return side_of(model, mesh::surface(model.mesh, surface)); };
  const bool by_nodes = options.heights == contact::Heights::points && !may_have_points(side(apex_surface), side(base_surface));
  if (!options.two_passes || by_nodes) {
    passes.push_back(connect_one_pass(model, name, apex_surface, base_surface, options, x, contact::Pass::only));
  } else {
    passes.push_back(connect_one_pass(model, name, apex_surface, base_surface, options, x, contact::Pass::forth));
    passes.push_back(connect_one_pass(model, name + "_back", base_surface, apex_surface, options, x, contact::Pass::back));
  }
  if (options.kind == contact::InterfaceKind::tied || !options.edges) return passes;
  std::optional<Connected> edges = connect_edges(model, name, apex_surface, base_surface, options, x);
  if (edges) passes.push_back(std::move(*edges));
  return passes;
}

}  // namespace nereid::dynamics
