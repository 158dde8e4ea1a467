#include "input/scene_builder.hpp"

#include <algorithm>
#include <cstdio>

#include "contact/bounce.hpp"
#include "mesh/placement.hpp"

namespace nereid::input {

namespace {

using Names = std::vector<std::string>;

/// Names of a list of named things.
template <class Named>
Names names_of(const std::vector<Named>& all) {
  Names names;
  for (const auto& one : all) names.push_back(one.name);
  return names;
}

/// A name that names one of these.
void expect(const Section& at, std::string_view key, const std::string& name, const std::string& what, const Names& names) {
  if (std::find(names.begin(), names.end(), name) == names.end()) at.unknown_name(key, name, what, names);
}

constexpr double round_off = 1e-9;  // of a mesh that was turned, over the size of the scene

double diagonal(const mesh::Mesh& mesh) { return (mesh.X.rowwise().maxCoeff() - mesh.X.rowwise().minCoeff()).norm(); }

/// Nodes of several sets, ascending, each once.
Subset union_of(const mesh::Mesh& mesh, const std::vector<std::string>& sets) {
  Subset nodes;
  for (const std::string& set : sets) {
    const Subset& more = mesh::node_set(mesh, set);
    nodes.insert(nodes.end(), more.begin(), more.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Half the thickness of the plates on a surface, if it is one of plates. [m]
double stand_off(const std::vector<BodyOptions>& bodies, const std::string& surface) {
  for (const BodyOptions& body : bodies)
    if (body.plates && body.name == surface.substr(0, surface.find('.'))) return body.plate.thickness / 2;
  return 0;
}

/// A floor or wall has its nodes on its side; else the start would throw them out.
void refuse_nodes_behind(const PlaneOptions& plane, const Subset& nodes, const mesh::Mesh& mesh) {
  double deepest = 0;
  std::size_t count = 0;
  for (const Index node : nodes) {
    const double height = (mesh.X.col(node) - plane.point).dot(plane.normal);
    if (height < -round_off * diagonal(mesh)) ++count;  // round-off of a mesh that was turned
    deepest = std::min(deepest, height);
  }
  if (count == 0) return;
  char text[200];
  std::snprintf(text, sizeof text, "%zu of %zu nodes start behind '%s', by %.4g m at most: move the body, or turn 'normal' to its side",
                count, nodes.size(), plane.name.c_str(), -deepest);
  plane.at.fault("point", text);
}

/// Nodes of a symmetry plane lie on one.
void refuse_nodes_beside(const PlaneOptions& plane, const Subset& nodes, const mesh::Mesh& mesh) {
  double low = 1e300, high = -1e300;
  for (const Index node : nodes) {
    const double height = mesh.X.col(node).dot(plane.normal);
    low = std::min(low, height), high = std::max(high, height);
  }
  if (!(high - low > 1e-6 * diagonal(mesh))) return;
  char text[200];
  std::snprintf(text, sizeof text, "the nodes of '%s' lie on no plane: they are %.4g m apart along 'normal'", plane.name.c_str(), high - low);
  plane.at.fault("nodes", text);
}

/// A rigid plane pushes the nodes of a surface by a penalty on their tributary areas.
contact::RigidPlane rigid_plane(const PlaneOptions& plane, const dynamics::Model& model) {
  const mesh::Surface& surface = mesh::surface(model.mesh, plane.surface);
  const Subset nodes = mesh::surface_nodes(surface);
  return {.name = plane.name,
          .point = plane.point,
          .normal = plane.normal,
          .nodes = nodes,
          .area = mesh::tributary_areas(model.mesh, surface, nodes),
          .penalty = plane.penalty.value_or(plane.hardness * dynamics::surface_stiffness(model, surface)),
          .bounce_step = contact::step_for_a_bounce(plane.created_in_a_bounce),
          .friction = plane.friction};
}

/// The constraints that a plane of the case stands for: three for a fixed one, else one.
std::vector<load::Plane> constraints(const PlaneOptions& plane, const Subset& nodes) {
  if (plane.kind == ScenePlane::fixed) {
    std::vector<load::Plane> three;
    for (int axis = 0; axis < 3; ++axis)
      three.push_back({.name = plane.name + "_" + "xyz"[axis], .kind = load::PlaneKind::held, .point = Vec3::Zero(),
                       .normal = Vec3::Unit(axis), .nodes = nodes});
    return three;
  }
  const auto kind = plane.kind == ScenePlane::symmetry ? load::PlaneKind::symmetry
                    : plane.kind == ScenePlane::floor  ? load::PlaneKind::floor
                                                       : load::PlaneKind::held;
  const Vec3 point = plane.kind == ScenePlane::floor ? plane.point : Vec3(Vec3::Zero());
  return {{.name = plane.name, .kind = kind, .point = point, .normal = plane.normal, .nodes = nodes}};
}

/// A node has room for a few planes only.
void refuse_too_many(const SceneOptions& scene, const mesh::Mesh& mesh) {
  std::vector<int> count(static_cast<std::size_t>(mesh.X.cols()), 0);
  for (const PlaneOptions& plane : scene.planes) {
    if (plane.kind == ScenePlane::rigid) continue;
    for (const Index node : union_of(mesh, plane.nodes)) {
      int& planes = count[static_cast<std::size_t>(node)];
      planes += plane.kind == ScenePlane::fixed ? 3 : 1;
      if (planes <= load::HeldNode::most_planes) continue;
      plane.at.fault("nodes", "'" + plane.name + "' has nodes that other planes hold already: a node may lie on " +
                                  std::to_string(load::HeldNode::most_planes) + " planes, where 'fixed' counts as three");
      break;
    }
  }
}

}  // namespace

mesh::Mesh make_mesh(const SceneOptions& scene) {
  mesh::Mesh all;
  for (const BodyOptions& body : scene.bodies) {
    mesh::Mesh here = make_mesh(body.name, body.mesh);
    if (body.place.angle != 0) here = mesh::turned_about(std::move(here), body.place.axis, body.place.angle, body.place.about);
    if (!body.place.move.isZero(0)) here = mesh::moved(std::move(here), body.place.move);
    all = all.X.cols() == 0 ? here : mesh::join(all, here);
  }
  return all;
}

void check_names(const SceneOptions& scene, const mesh::Mesh& mesh) {
  const Names sets = names_of(mesh.node_sets), surfaces = names_of(mesh.surfaces), bodies = names_of(scene.bodies);
  for (const ContactOptions& contact : scene.contacts) {
    expect(contact.at, "apexes", contact.apexes, "surfaces", surfaces);
    expect(contact.at, "base", contact.base, "surfaces", surfaces);
  }
  for (const PlaneOptions& plane : scene.planes) {
    for (const std::string& set : plane.nodes) expect(plane.at, "nodes", set, "node sets", sets);
    if (plane.kind == ScenePlane::rigid) expect(plane.at, "surface", plane.surface, "surfaces", surfaces);
  }
  for (const InitialOptions& initial : scene.initial) expect(initial.at, "body", initial.body, "bodies", bodies);
  const Names contacts = names_of(scene.contacts), planes = names_of(scene.planes);
  Names sources = contacts;
  sources.insert(sources.end(), planes.begin(), planes.end());
  for (const ProbeOptions& probe : scene.probes) {
    switch (probe.quantity.of) {
      case Of::nodes: expect(probe.at, "of", probe.of, "node sets", sets); break;
      case Of::body: expect(probe.at, "of", probe.of, "bodies", bodies); break;
      case Of::contact: expect(probe.at, "of", probe.of, "contacts", contacts); break;
      case Of::source: expect(probe.at, "of", probe.of, "contacts and planes", sources); break;
    }
  }
}

void add_bodies_and_planes(const SceneOptions& scene, dynamics::Model& model) {
  model.gravity = scene.gravity;
  for (const BodyOptions& body : scene.bodies)
    model.blocks.push_back(body.plates ? element::plates(model.mesh, body.name, body.law, body.plate)
                                       : element::solids(model.mesh, body.name, body.law, body.solid));
  refuse_too_many(scene, model.mesh);
  for (const PlaneOptions& plane : scene.planes) {
    const bool rigid = plane.kind == ScenePlane::rigid;
    const Subset nodes = rigid ? mesh::surface_nodes(mesh::surface(model.mesh, plane.surface)) : union_of(model.mesh, plane.nodes);
    if (rigid || plane.kind == ScenePlane::floor) refuse_nodes_behind(plane, nodes, model.mesh);
    if (plane.kind == ScenePlane::symmetry) refuse_nodes_beside(plane, nodes, model.mesh);
    if (rigid)
      model.rigid_planes.push_back(rigid_plane(plane, model));
    else
      for (load::Plane& one : constraints(plane, nodes)) model.constraints.planes.push_back(std::move(one));
  }
  dynamics::finish(model);
}

std::vector<dynamics::Connected> add_contacts(const SceneOptions& scene, dynamics::Model& model) {
  std::vector<dynamics::Connected> connected;
  for (const ContactOptions& contact : scene.contacts) {
    const Subset apexes = mesh::surface_nodes(mesh::surface(model.mesh, contact.apexes)),
                 base = mesh::surface_nodes(mesh::surface(model.mesh, contact.base));
    if (std::find_first_of(apexes.begin(), apexes.end(), base.begin(), base.end()) != apexes.end()) {
      contact.at.fault("base", "'apexes' and 'base' share nodes: a surface does not touch itself");
      continue;
    }
    dynamics::InterfaceOptions options = contact.interface;
    if (contact.height_from_thickness)
      options.height.given = stand_off(scene.bodies, contact.apexes) + stand_off(scene.bodies, contact.base);
    for (dynamics::Connected& pass : dynamics::connect(model, contact.name, contact.apexes, contact.base, options)) {
      refuse_penetration(contact.at, options, pass.gaps);
      connected.push_back(std::move(pass));
    }
  }
  return connected;
}

void set_initial(const SceneOptions& scene, const dynamics::Model& model, dynamics::State& state) {
  for (const InitialOptions& initial : scene.initial)
    for (const Index node : mesh::node_set(model.mesh, initial.body)) state.v.col(node) = initial.velocity;
}

}  // namespace nereid::input
