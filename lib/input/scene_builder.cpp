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

/// Whether a node set, surface or region is one of this body.
bool belongs(const std::string& name, const BodyOptions& body) { return name.substr(0, name.find('.')) == body.name; }

std::array<Index, 3> sorted(const Table<3>& corners, Index facet) {
  std::array<Index, 3> nodes{corners(0, facet), corners(1, facet), corners(2, facet)};
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Half the thickness of the plates on a surface, if it is one of plates. [m]
double stand_off(const std::vector<BodyOptions>& bodies, const mesh::Mesh& mesh, const std::string& surface) {
  const BodyOptions& body = *std::find_if(bodies.begin(), bodies.end(), [&](const auto& one) { return belongs(surface, one); });
  if (!body.plates) return 0;
  if (!body.solids) return body.plate.thickness / 2;
  const auto facet = sorted(mesh::surface(mesh, surface).facets, 0);
  for (const mesh::Triangles& region : mesh.triangles)
    for (Index t = 0; t < region.nodes.cols(); ++t)
      if (sorted(region.nodes, t) == facet) return body.plate.thickness / 2;
  return 0;
}

/// A floor or wall has its nodes on its side; else the start would throw them out.
template <class Plane>
void refuse_nodes_behind(const Section& at, const Plane& plane, const mesh::Mesh& mesh) {
  const Subset& nodes = plane.nodes;
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
  at.fault("point", text);
}

/// Nodes of a symmetry plane lie on one.
void refuse_nodes_beside(const Section& at, const load::Plane& plane, const mesh::Mesh& mesh) {
  double low = 1e300, high = -1e300;
  for (const Index node : plane.nodes) {
    const double height = mesh.X.col(node).dot(plane.normal);
    low = std::min(low, height), high = std::max(high, height);
  }
  if (!(high - low > 1e-6 * diagonal(mesh))) return;
  char text[200];
  std::snprintf(text, sizeof text, "the nodes of '%s' lie on no plane: they are %.4g m apart along 'normal'", plane.name.c_str(), high - low);
  at.fault("nodes", text);
}

/// A rigid plane pushes the nodes of a surface by a penalty on their tributary areas.
contact::RigidPlane rigid_plane(const RigidOptions& plane, const dynamics::Model& model) {
  const mesh::Surface& surface = mesh::surface(model.mesh, plane.surface);
  const Subset nodes = mesh::surface_nodes(surface);
  return {.name = plane.name,
          .point = plane.point,
          .normal = plane.normal,
          .nodes = nodes,
          .area = mesh::tributary_areas(model.mesh, surface, nodes),
          .penalty = plane.penalty.value_or(plane.hardness * dynamics::surface_stiffness(model, surface)),
          .bounce_step = contact::step_for_a_bounce(plane.created_in_a_bounce),
          .friction = plane.friction,
          .depth = dynamics::surface_depth(model, surface)};
}

/// Gives names to the nodes nearest to the points of a body.
void name_points(const BodyOptions& body, mesh::Mesh& mesh) {
  const Vec3 low = mesh.X.rowwise().minCoeff(), high = mesh.X.rowwise().maxCoeff();
  for (const PointOptions& point : body.points) {
    Eigen::Index nearest = 0;
    (mesh.X.colwise() - point.near).colwise().squaredNorm().minCoeff(&nearest);
    const double away = (point.near - point.near.cwiseMax(low).cwiseMin(high)).norm();
    if (away > 1e-3 * diagonal(mesh)) {
      char text[200];
      std::snprintf(text, sizeof text, "'near' lies %.4g m beside '%s'", away, body.name.c_str());
      point.at.fault("near", text);
    }
    const std::string name = body.name + "." + point.name;
    for (const mesh::NodeSet& set : mesh.node_sets)
      if (set.name == name) point.at.fault("name", "'name' = " + point.name + " is that of a node set of the mesh already");
    mesh.node_sets.push_back({name, {static_cast<Index>(nearest)}});
  }
}

}  // namespace

mesh::Mesh make_mesh(const SceneOptions& scene) {
  mesh::Mesh all;
  for (const BodyOptions& body : scene.bodies) {
    mesh::Mesh here = make_mesh(body.name, body.mesh);
    if (body.map) here = mapped(*body.map, std::move(here));
    if (body.place.angle != 0) here = mesh::turned_about(std::move(here), body.place.axis, body.place.angle, body.place.about);
    if (!body.place.move.isZero(0)) here = mesh::moved(std::move(here), body.place.move);
    name_points(body, here);
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
  const Actions& actions = scene.actions;
  for (const PlaneRequest& plane : actions.planes)
    for (const std::string& set : plane.nodes) expect(plane.section, "nodes", set, "node sets", sets);
  for (const RigidOptions& plane : scene.rigid_planes) expect(plane.at, "surface", plane.surface, "surfaces", surfaces);
  for (const LoadRequest& load : actions.loads) {
    using Kind = LoadRequest::Kind;
    if (load.kind == Kind::pressure) expect(load.section, "surface", load.on, "surfaces", surfaces);
    if (load.kind == Kind::body_force) expect(load.section, "body", load.on, "bodies", bodies);
    if (load.kind == Kind::force || load.kind == Kind::moment) expect(load.section, "nodes", load.on, "node sets", sets);
  }
  Names ends{"ground"};
  ends.insert(ends.end(), sets.begin(), sets.end());
  for (const SpringRequest& spring : actions.springs) {
    expect(spring.section, "from", spring.from, "node sets", sets);
    expect(spring.section, "to", spring.to, "the ends of springs", ends);
  }
  for (const PointMassRequest& mass : actions.point_masses) expect(mass.section, "nodes", mass.nodes, "node sets", sets);
  for (const InitialRequest& initial : actions.initial) expect(initial.section, "body", initial.body, "bodies", bodies);
  Names regions = bodies;
  for (const Names& more : {names_of(mesh.hexahedra), names_of(mesh.triangles)})
    for (const std::string& name : more)
      if (name.find('.') != std::string::npos) regions.push_back(name);
  const Names contacts = names_of(scene.contacts);
  Names sources = contacts;
  for (const Names& more : {names_of(actions.planes), names_of(actions.loads), names_of(actions.springs)})
    sources.insert(sources.end(), more.begin(), more.end());
  for (const ProbeOptions& probe : scene.probes) {
    switch (probe.quantity.of) {
      case Of::nodes:
        expect(probe.at, "of", probe.of, "node sets", sets);
        for (const mesh::NodeSet& set : mesh.node_sets)
          if (set.name == probe.of && set.nodes.empty()) probe.at.fault("of", "'of' = " + probe.of + " has no nodes");
        break;
      case Of::body: expect(probe.at, "of", probe.of, "bodies and regions", regions); break;
      case Of::contact: expect(probe.at, "of", probe.of, "contacts", contacts); break;
      case Of::source: expect(probe.at, "of", probe.of, "contacts, planes, loads and springs", sources); break;
    }
  }
}

void add_bodies_and_actions(const SceneOptions& scene, dynamics::Model& model) {
  for (const BodyOptions& body : scene.bodies) {  // a mesh from a file may have several regions
    for (const mesh::Hexahedra& region : model.mesh.hexahedra)
      if (belongs(region.name, body)) model.blocks.push_back(element::solids(model.mesh, region.name, body.law, body.solid));
    for (const mesh::Triangles& region : model.mesh.triangles)
      if (belongs(region.name, body)) model.blocks.push_back(element::plates(model.mesh, region.name, body.law, body.plate));
  }
  constrain(scene.actions, model);
  for (const load::Plane& plane : model.constraints.planes) {
    const auto& planes = scene.actions.planes;
    const Section& at = std::find_if(planes.begin(), planes.end(), [&](const auto& one) { return one.name == plane.name; })->section;
    if (plane.kind == load::PlaneKind::floor) refuse_nodes_behind(at, plane, model.mesh);
    if (plane.kind == load::PlaneKind::symmetry) refuse_nodes_beside(at, plane, model.mesh);
  }
  dynamics::finish(model);
  for (const RigidOptions& plane : scene.rigid_planes) {
    model.rigid_planes.push_back(rigid_plane(plane, model));
    refuse_nodes_behind(plane.at, model.rigid_planes.back(), model.mesh);
  }
  add_loads(scene.actions, model);
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
      options.height.given = stand_off(scene.bodies, model.mesh, contact.apexes) + stand_off(scene.bodies, model.mesh, contact.base);
    for (dynamics::Connected& pass : dynamics::connect(model, contact.name, contact.apexes, contact.base, options)) {
      refuse_penetration(contact.at, options, pass.gaps);
      connected.push_back(std::move(pass));
    }
  }
  return connected;
}

}  // namespace nereid::input
