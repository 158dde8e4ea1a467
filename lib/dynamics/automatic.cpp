#include "dynamics/automatic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "contact/penalty/impact_step.hpp"
#include "dynamics/shapes.hpp"
#include "dynamics/side.hpp"
#include "mesh/adjacency.hpp"

namespace nereid::dynamics {

namespace {

constexpr double share = 0.5;  // of the penalty in each of two passes
constexpr double fold = 1.5;   // times the thickness: a plate folded over half of it, along pi/2 of it, touches what is farther

/// The facets of a skin that are solids, or plates from both sides.
mesh::Surface part_of(const mesh::Surface& skin, bool plates) {
  const std::vector<Index> others = mesh::other_sides(skin.facets);
  mesh::Surface part = skin;
  Index kept = 0;
  for (Index f = 0; f < skin.facets.cols(); ++f)
    if ((others[static_cast<std::size_t>(f)] >= 0) == plates) part.facets.col(kept++) = skin.facets.col(f);
  part.facets.conservativeResize(3, kept);
  return part;
}

/// A body with what its skin brings into a contact. Where it has solids and plates, the stiffer and the thinner of both count.
struct Skin {
  const mesh::Surface* surface = nullptr;
  Side side;
  double half = 0;  // [m] of its plates
  double area = 0, face_side = 0;  // [m2] of all its facets, [m] mean
};

std::vector<Skin> skins_of(const Model& model, const std::vector<TouchingBody>& bodies) {
  std::vector<Skin> skins;
  for (const TouchingBody& body : bodies) {
    const mesh::Surface& surface = mesh::surface(model.mesh, body.name + ".skin");
    const mesh::Surface plates = part_of(surface, true);
    Side side = side_of(model, surface);
    const Side of_plates = plates.facets.cols() > 0 ? side_of(model, plates) : Side{};
    side.turns = of_plates.turns, side.half_thickness = of_plates.half_thickness;
    const Scalars areas = mesh::facet_areas(model.mesh, surface);
    skins.push_back({&surface, side, of_plates.half_thickness, areas.sum(), std::sqrt(2 * areas.mean())});
  }
  return skins;
}

/// Which nodes are beside each other, of the bodies that touch themselves.
contact::Beside beside_of(const Model& model, const std::vector<TouchingBody>& list, const std::vector<Skin>& skins) {
  Scalars reach = Scalars::Zero(model.mesh.X.cols());
  std::vector<Index> folding;
  for (std::size_t b = 0; b < list.size(); ++b) {
    if (!list[b].touches_itself || skins[b].side.is_rigid) continue;
    const Table<3>& facets = skins[b].surface->facets;
    folding.insert(folding.end(), facets.data(), facets.data() + facets.size());
    for (const Index node : facets.reshaped()) reach(node) = fold * 2 * skins[b].half;
  }
  if (folding.empty()) return {};
  const Eigen::Map<const Table<3>> facets(folding.data(), 3, static_cast<Eigen::Index>(folding.size() / 3));
  return contact::find_beside(facets, model.mesh.X, reach);
}

/// Whether a body has the apexes against another one: that with the smaller faces, whose nodes follow what is under them; of like ones that
/// which is not rigid, then the softer one, then the smaller one, whose faces lie on the other as a whole; else that which is `first`.
bool has_apexes(const Skin& one, const Skin& other, bool first) {
  constexpr double alike = 0.05;
  const auto is_less = [](double a, double b, bool& differs) {
    differs = std::abs(a - b) > alike * std::max(a, b);
    return a < b;
  };
  bool differs = false;
  if (const bool finer = is_less(one.face_side, other.face_side, differs); differs) return finer;
  if (one.side.is_rigid != other.side.is_rigid) return other.side.is_rigid;
  if (const bool softer = is_less(one.side.stiffness, other.side.stiffness, differs); differs) return softer;
  const bool smaller = is_less(one.area, other.area, differs);
  return differs ? smaller : first;
}

/// Which bodies touch, and what each pair has together.
contact::Bodies bodies_of(const Model& model, const std::vector<TouchingBody>& list, const std::vector<Skin>& skins,
                          const PairsApart& apart, const InterfaceOptions& options) {
  contact::Bodies bodies;
  const auto count = list.size();
  bodies.thickest = Scalars::Zero(static_cast<Eigen::Index>(count));
  bodies.of_node.assign(static_cast<std::size_t>(model.mesh.X.cols()), -1);
  bodies.first_facet.assign(1, 0);
  bodies.first_node.assign(1, 0);
  for (std::size_t b = 0; b < count; ++b) {
    bodies.names.push_back(list[b].name);
    bodies.thickest(static_cast<Eigen::Index>(b)) = skins[b].half;
    const Table<3>& facets = skins[b].surface->facets;
    bodies.first_facet.push_back(bodies.first_facet.back() + static_cast<Index>(facets.cols()));
    bodies.of_facet.resize(static_cast<std::size_t>(bodies.first_facet.back()), static_cast<Index>(b));
    const Subset nodes = mesh::surface_nodes(*skins[b].surface);
    bodies.nodes.insert(bodies.nodes.end(), nodes.begin(), nodes.end());
    for (const Index node : nodes) bodies.of_node[static_cast<std::size_t>(node)] = static_cast<Index>(b);
    bodies.first_node.push_back(static_cast<Index>(bodies.nodes.size()));
  }
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      bodies.between.push_back(between(skins[a].side, skins[b].side, options, share));
      if (options.heights == contact::Heights::points && a != b && may_have_points(skins[a].side, skins[b].side))
        bodies.between.back().heights = has_apexes(skins[a], skins[b], a < b) ? contact::Heights::points : contact::Heights::guards;
      const bool itself = a == b && list[a].touches_itself && !skins[a].side.is_rigid;
      bodies.touch.push_back(a != b ? !are_apart(apart, list[a].name, list[b].name) : itself);
    }
  return bodies;
}

/// All skins as one surface, in the order of the bodies.
mesh::Surface joined(const std::string& name, const std::vector<Skin>& skins) {
  Index count = 0;
  for (const Skin& skin : skins) count += static_cast<Index>(skin.surface->facets.cols());
  mesh::Surface all{name, Table<3>(3, count)};
  count = 0;
  for (const Skin& skin : skins) {
    all.facets.middleCols(count, skin.surface->facets.cols()) = skin.surface->facets;
    count += static_cast<Index>(skin.surface->facets.cols());
  }
  return all;
}

/// What an interface has of all its pairs: the least depth, the largest penalty.
contact::Between of_all(const contact::Bodies& bodies) {
  contact::Between all;
  all.depth = all.release_height = std::numeric_limits<double>::infinity();
  for (const contact::Between& pair : bodies.between) {
    if (pair.heights != contact::Heights::nodes) all.heights = contact::Heights::points;
    all.penalty = std::max(all.penalty, pair.penalty), all.impedance = std::max(all.impedance, pair.impedance);
    if (pair.depth > 0) all.depth = std::min(all.depth, pair.depth), all.release_height = std::min(all.release_height, pair.release_height);
  }
  if (std::isinf(all.depth)) all.depth = all.release_height = 0;
  return all;
}

/// About the side of a face: of bodies with fine and coarse meshes that which as many have longer as shorter. [m]
double usual_side(const mesh::Mesh& mesh, const mesh::Surface& surface) {
  Scalars areas = mesh::facet_areas(mesh, surface);
  const auto middle = areas.begin() + areas.size() / 2;
  std::nth_element(areas.begin(), middle, areas.end());
  return std::sqrt(2 * *middle);
}

/// What apexes and edges of an automatic contact both have.
contact::Sides common_to_both(const Model& model, const std::string& name, const contact::Bodies& bodies, const mesh::Surface& surface,
                              const InterfaceOptions& options) {
  contact::Sides sides;
  static_cast<contact::Between&>(sides) = of_all(bodies);
  sides.name = name;
  sides.bodies = bodies;
  sides.restitution = options.restitution;
  sides.friction = options.friction;
  sides.margin = usual_side(model.mesh, surface);
  sides.longest_step = element_step(model);
  if (model.inertia.size() > 0) sides.rotation_of_node = model.rotation_of_node;
  return sides;
}

Connected connect_nodes(Model& model, const std::string& name, const contact::Bodies& bodies, const contact::Shapes& shapes,
                        const contact::Beside& beside, const std::vector<Skin>& skins, const mesh::Surface& surface,
                        const InterfaceOptions& options, const Vectors& x) {
  contact::Interface interface;
  static_cast<contact::Sides&>(interface) = common_to_both(model, name, bodies, surface, options);
  const auto nodes_of_mesh = static_cast<Index>(model.mesh.X.cols());
  interface.method = options.method;
  interface.shapes = shapes;
  interface.base = contact::base_surface(surface, model.mesh.X, bodies.of_facet);
  contact::mark_halves(interface.base, mesh::faces(model.mesh, surface));
  for (const Subset& plane : symmetry_planes(model)) contact::goes_on_behind(interface.base, plane);
  interface.own = contact::fans(surface.facets, nodes_of_mesh);
  interface.apexes = mesh::surface_nodes(surface);
  interface.area = mesh::tributary_areas(model.mesh, surface, interface.apexes);
  interface.faces = mesh::faces_around(model.mesh, surface, interface.apexes);
  interface.facet_area = mesh::facet_areas(model.mesh, surface);
  interface.impact_step_factor = contact::impact_step_factor_for(options.energy_gain_limit);
  interface.first_step_factor = options.step_factor;
  interface.pass_factor = share;
  interface.allowed = allowed_directions(model, interface.apexes);
  interface.follows_thickness = std::any_of(skins.begin(), skins.end(), [](const Skin& skin) { return skin.side.thins; });

  Scalars half = Scalars::Zero(nodes_of_mesh);
  interface.base.beside = beside;
  interface.base.stand_off = Scalars::Zero(surface.facets.cols());
  for (Index f = 0; f < surface.facets.cols(); ++f) {
    const Index body = bodies.of_facet[static_cast<std::size_t>(f)];
    const double here = contact::is_sheet(interface.base, f) ? skins[static_cast<std::size_t>(body)].half : 0;
    interface.base.stand_off(f) = here;
    for (const Index node : surface.facets.col(f)) {
      half(node) = std::max(half(node), here);
    }
  }
  if (interface.base.stand_off.isZero(0)) interface.base.stand_off.resize(0);
  interface.contact_height.resize(static_cast<Eigen::Index>(interface.apexes.size()));
  for (std::size_t a = 0; a < interface.apexes.size(); ++a) {
    interface.contact_height(static_cast<Eigen::Index>(a)) = half(interface.apexes[a]);
    interface.bodies.of_apex.push_back(bodies.of_node[static_cast<std::size_t>(interface.apexes[a])]);
  }

  Connected connected;
  contact::Memory memory;
  contact::Workspace workspace(interface);
  connected.gaps = contact::connect(interface, x, 0, {.from_initial_height = false, .clearance = 0, .given = 0},
                                    options.initial_penetration, memory, workspace);
  connected.memory = std::move(memory);
  model.contacts.push_back(std::move(interface));
  return connected;
}

std::vector<Connected> connect_edges(Model& model, const std::string& name, const contact::Bodies& bodies, const contact::Beside& beside,
                                     const std::vector<Skin>& skins, const mesh::Surface& surface, const InterfaceOptions& options,
                                     const Vectors& x) {
  contact::EdgeContact all;
  static_cast<contact::Sides&>(all) = common_to_both(model, name + "_edges", bodies, surface, options);
  const std::vector<Subset> planes = symmetry_planes(model);
  for (std::size_t b = 0; b < skins.size(); ++b)
    for (const bool plates : {false, true}) {
      const mesh::Surface part = part_of(*skins[b].surface, plates);
      if (part.facets.cols() == 0) continue;
      contact::add_edges(contact::edges_of(model.mesh, part, planes), plates ? skins[b].half : 0, static_cast<Index>(b), all.edges);
    }
  if (!has_ridges(all.edges, model.mesh.X)) return {};
  all.beside = beside;
  all.base_edges = all.edges;
  all.apexes = all.base_nodes = contact::nodes_of(all.edges);
  Connected connected;
  contact::EdgeMemory memory;
  contact::EdgeWorkspace workspace(all);
  connected.gaps = contact::connect(all, x, memory, workspace);
  connected.memory = std::move(memory);
  model.contacts.push_back(std::move(all));
  std::vector<Connected> list;
  list.push_back(std::move(connected));
  return list;
}

}  // namespace

bool are_apart(const PairsApart& apart, const std::string& one, const std::string& other) {
  return std::any_of(apart.begin(), apart.end(), [&](const auto& pair) {
    return (pair.first == one && pair.second == other) || (pair.first == other && pair.second == one);
  });
}

std::vector<Connected> connect_automatic(Model& model, const std::string& name, const std::vector<TouchingBody>& list,
                                         const PairsApart& apart, const InterfaceOptions& options, const Vectors* start) {
  check(model.mass.size() == model.mesh.X.cols(), "finalize() a model before it gets an interface");
  const Vectors& x = start != nullptr ? *start : model.mesh.X;
  const std::vector<Skin> skins = skins_of(model, list);
  contact::Bodies bodies = bodies_of(model, list, skins, apart, options);
  const contact::Beside beside = beside_of(model, list, skins);
  const mesh::Surface surface = joined(name, skins);
  std::vector<const mesh::Surface*> surfaces;
  for (const Skin& skin : skins) surfaces.push_back(skin.surface);
  const contact::Shapes shapes = shapes_of_bodies(model, surfaces, mesh::surface_nodes(surface), options, bodies);
  std::vector<Connected> connected;
  connected.push_back(connect_nodes(model, name, bodies, shapes, beside, skins, surface, options, x));
  if (!options.edges) return connected;
  for (Connected& edges : connect_edges(model, name, bodies, beside, skins, surface, options, x)) connected.push_back(std::move(edges));
  return connected;
}

}  // namespace nereid::dynamics
