#include "model/actions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/words.hpp"
#include "contact/penalty/impact_step.hpp"
#include "contact/multiplier/shape_points.hpp"
#include "dynamics/displace.hpp"
#include "dynamics/shapes.hpp"
#include "mesh/adjacency.hpp"
#include "model/meshes.hpp"
#include "model/stages.hpp"

namespace nereid::model {

namespace {

constexpr double round_off = 1e-9;  // of a mesh that was turned, over the size of the scene

std::string at_place(const Vec3& X) { return formatted("x = %.6g, y = %.6g, z = %.6g", X.x(), X.y(), X.z()); }

load::OverTime over_time(const load::OverSpace& value) {
  return [value](double t) { return value(0, 0, 0, t); };
}

/// The last word of a key: what a message calls the value.
/// A value at the start, where what gives it can still be blamed.
void refuse_infinite(Faults& faults, const Part& part, const std::string& key, double value, const std::string& where) {
  if (std::isfinite(value)) return;
  refuse(faults, part, key, quote(last_of(key)) + (std::isnan(value) ? " is no number" : " is infinite") + " at " + where);
}

void refuse_infinite_start(Faults& faults, const Part& part, const std::string& key, const Field& field, const Vec3& X) {
  for (const load::OverSpace& value : field) refuse_infinite(faults, part, key, value(X.x(), X.y(), X.z(), 0), at_place(X) + ", t = 0");
}

/// A floor or wall has its nodes on its side; else the start would throw them out.
///
/// x  [m] positions at the start
template <class Plane>
void refuse_nodes_behind(Faults& faults, const Part& part, const Plane& plane, const Vectors& x) {
  const double behind = -round_off * (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  double deepest = 0;
  std::size_t count = 0;
  for (const Index node : plane.nodes) {
    const double height = (x.col(node) - plane.point).dot(plane.normal);
    if (height < behind) ++count;
    deepest = std::min(deepest, height);
  }
  if (count == 0) return;
  refuse(faults, part, "point",
         formatted("%zu of %zu nodes start behind '%s', by %.4g m at most: move the body, or turn 'normal' to its side", count,
                   plane.nodes.size(), plane.name.c_str(), -deepest));
}

/// The same of a body that touches as a shape.
void refuse_shapes_behind(Faults& faults, const Part& part, const contact::RigidPlane& plane, const Vectors& x) {
  const double behind = -round_off * (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  for (const mesh::RoundBody& round : plane.rounds) {
    std::vector<contact::Spot> spots;
    contact::spots_on_plane(round.shape, mesh::placed(round, x), plane.point, plane.normal, spots);
    double least = 0;
    for (const contact::Spot& spot : spots) least = std::min(least, spot.gap);
    if (least < behind)
      refuse(faults, part, "point",
             formatted("the shape of a body starts behind '%s', by %.4g m: move the body, or turn 'normal' to its side",
                       plane.name.c_str(), -least));
  }
}

/// Nodes of a symmetry plane lie on one.
void refuse_nodes_beside(Faults& faults, const Part& part, const load::Plane& plane, const mesh::Mesh& mesh) {
  double low = 1e300, high = -1e300;
  for (const Index node : plane.nodes) {
    const double height = mesh.X.col(node).dot(plane.normal);
    low = std::min(low, height), high = std::max(high, height);
  }
  if (!(high - low > 1e-6 * diagonal(mesh))) return;
  refuse(faults, part, "nodes",
         formatted("the nodes of '%s' lie on no plane: they are %.4g m apart along 'normal'", plane.name.c_str(), high - low));
}

Part part_of(const Plane& plane) { return part("plane", plane); }

load::Plane with_nodes(const Plane& plane, const mesh::Mesh& mesh) {
  load::Plane made{.name = plane.name, .kind = plane.kind, .point = plane.point, .normal = plane.normal, .nodes = {},
                   .velocity = plane.velocity, .field = plane.field, .angular_velocity = plane.angular_velocity};
  for (const std::string& name : plane.nodes) {
    const Subset& nodes = mesh::node_set(mesh, name);
    made.nodes.insert(made.nodes.end(), nodes.begin(), nodes.end());
  }
  std::sort(made.nodes.begin(), made.nodes.end());
  made.nodes.erase(std::unique(made.nodes.begin(), made.nodes.end()), made.nodes.end());
  return made;
}

/// Whether planes move a node against one another, or constrain too many directions of one.
bool conflict(const std::vector<Plane>& planes, const load::Constraints& made, Faults& faults) {
  const load::Conflict found = load::find_conflict(made);
  if (found.moving >= 0) {
    const Plane& moving = planes[static_cast<std::size_t>(found.moving)];
    refuse(faults, part_of(moving), "velocity",
           quote(moving.name) + (moving.kind == load::PlaneKind::driven ? " drives" : " moves") + " nodes that " +
               quote(planes[static_cast<std::size_t>(found.other)].name) + " constrains in the same direction");
  }
  const Index overheld = load::find_overconstrained(made);
  for (std::size_t p = planes.size(); overheld >= 0 && p-- > 0;) {
    if (!std::binary_search(made.planes[p].nodes.begin(), made.planes[p].nodes.end(), overheld)) continue;
    refuse(faults, part_of(planes[p]), "nodes",
           "too many planes constrain one node: there is room for " + std::to_string(load::ConstrainedNode::most_rows) +
               " directions, and a fixed or driven one takes three");
    break;
  }
  return found.moving >= 0 || overheld >= 0;
}

/// The single node of a set; -1 after a fault.
Index single_node(const mesh::Mesh& mesh, const Part& part, const char* key, const std::string& name, Faults& faults) {
  const Subset& nodes = mesh::node_set(mesh, name);
  if (nodes.size() == 1) return nodes.front();
  refuse(faults, part, key,
         "the node set " + quote(name) + " has " + std::to_string(nodes.size()) + " nodes: a spring ends at a single one");
  return -1;
}

void add_spring(const Spring& spring, dynamics::Model& model, Faults& faults) {
  const Part here = part("spring", spring);
  const Index from = single_node(model.mesh, here, "from", spring.from, faults);
  const bool grounded = spring.to == "ground";
  const Index to = grounded ? -1 : single_node(model.mesh, here, "to", spring.to, faults);
  if (from < 0 || (!grounded && to < 0)) return;
  if (from == to) {
    refuse(faults, here, "to", "'from' and 'to' are the same node");
    return;
  }
  const double* length = spring.length ? &*spring.length : nullptr;
  model.loads.emplace_back(grounded ? load::spring_to_point(spring.name, model.mesh.X, from, model.mesh.X.col(from), spring.stiffness,
                                                            spring.damping, length)
                                    : load::spring_between(spring.name, model.mesh.X, from, to, spring.stiffness, spring.damping, length));
}

load::BodyForce body_force(const Load& load, const dynamics::Model& model, Faults& faults) {
  const Subset& nodes = mesh::node_set(model.mesh, load.on);
  load::BodyForce force{.name = load.name, .nodes = nodes, .mass = Scalars(static_cast<Eigen::Index>(nodes.size())),
                        .acceleration = load.value};
  Scalars mass = Scalars::Zero(model.mesh.X.cols());
  for (const auto& block : model.blocks) element::add_mass(block, mass);  // without point masses
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    force.mass(static_cast<Eigen::Index>(i)) = mass(nodes[i]);
    refuse_infinite_start(faults, part("load", load), "value", load.value, model.mesh.X.col(nodes[i]));
  }
  for (const rigid::Body& body : model.rigid_bodies) {
    if (body.name != load.on) continue;
    force.mass = rigid::shares_of_mass(body, mass);
    if (!(force.mass.minCoeff() > 0))
      refuse(faults, part("load", load), "body", "the centre of " + quote(load.on) + " is too far out of its mesh for a body force");
  }
  return force;
}

load::NodalMoment moment_on(const Load& load, const dynamics::Model& model, const std::array<load::OverTime, 3>& values, Faults& faults) {
  load::NodalMoment moment{.name = load.name, .nodes = mesh::node_set(model.mesh, load.on), .rotations = {}, .moment = values};
  for (const Index node : moment.nodes) {
    moment.rotations.push_back(model.rotation_of_node[node]);
    if (moment.rotations.back() < 0)
      refuse(faults, part("load", load), "nodes",
             "a moment acts on nodes of plates or on rigid bodies only: " + quote(load.on) + " has others");
  }
  return moment;
}

bool is_rigid_body(const dynamics::Model& model, const std::string& name) {
  return std::any_of(model.rigid_bodies.begin(), model.rigid_bodies.end(), [&](const rigid::Body& body) { return body.name == name; });
}

void add_load(const Load& load, dynamics::Model& model, Faults& faults) {
  if (load.kind == LoadKind::body_force) {
    model.loads.emplace_back(body_force(load, model, faults));
    return;
  }
  for (const load::OverSpace& value : load.value)
    if (value)
      refuse_infinite(faults, part("load", load), "value", value(0, 0, 0, load.kind == LoadKind::bubble ? load.volume : 0),
                      load.kind == LoadKind::bubble ? "the volume of the start" : "t = 0");
  const std::array<load::OverTime, 3> values{over_time(load.value[0]), over_time(load.value[1]), over_time(load.value[2])};
  switch (load.kind) {
    case LoadKind::pressure:
      if (mesh::has_both_sides(mesh::surface(model.mesh, load.on).facets))
        refuse(faults, part("load", load), "surface",
               quote(load.on) + " has both sides of plates, on which a pressure cancels: expected one side of them");
      model.loads.emplace_back(load::pressure_on(load.name, model.mesh, mesh::surface(model.mesh, load.on), values[0]));
      break;
    case LoadKind::force:
      model.loads.emplace_back(load::NodalForce{.name = load.name, .nodes = mesh::node_set(model.mesh, load.on), .force = values});
      break;
    case LoadKind::moment:
      if (is_rigid_body(model, load.on)) model.loads.emplace_back(load::Couple{load.name, mesh::node_set(model.mesh, load.on), values});
      else model.loads.emplace_back(moment_on(load, model, values, faults));
      break;
    case LoadKind::radiation: {
      const mesh::Surface& surface = mesh::surface(model.mesh, load.on);
      if (mesh::has_both_sides(surface.facets))
        refuse(faults, part("load", load), "surface", quote(load.on) + " has both sides of plates: waves leave through one of them");
      const double impedance = load.impedance.value_or(dynamics::surface_impedance(model, surface));
      if (!std::isfinite(impedance) || !(impedance > 0))
        refuse(faults, part("load", load), "impedance",
               quote(load.on) + " is of plates or of a rigid body, which have none of their own: 'impedance' is missing");
      const load::OverTime none = [](double) { return 0.0; };
      model.loads.emplace_back(load::radiation_from(load.name, model.mesh, surface, values[0],
                                                    load.incident[0] ? over_time(load.incident[0]) : none, impedance));
      break;
    }
    case LoadKind::bubble:
      if (mesh::has_both_sides(mesh::surface(model.mesh, load.on).facets))
        refuse(faults, part("load", load), "surface", quote(load.on) + " has both sides of plates: a bubble lies on one of them");
      model.loads.emplace_back(load::bubble_under(load.name, model.mesh, mesh::surface(model.mesh, load.on), values[0], load.volume));
      break;
    case LoadKind::body_force: break;  // above
  }
}

/// The gradient of a field at X, by differences over a hundred-thousandth of the scene's size.
Mat3 gradient_at(const Field& field, const Vec3& X, double size) {
  Mat3 gradient;
  const double h = 1e-5 * size;  // halves the digits between round-off and curvature
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 ahead = X + h * Vec3::Unit(axis), behind = X - h * Vec3::Unit(axis);
    for (int i = 0; i < 3; ++i)
      gradient(i, axis) = (field[i](ahead.x(), ahead.y(), ahead.z(), 0) - field[i](behind.x(), behind.y(), behind.z(), 0)) / (2 * h);
  }
  return gradient;
}

Part part_of_initial(const Initial& initial) { return {initial.at, "initial motion of '" + initial.body + "'"}; }

/// The last displacement that a body is given, which a fault of all together is told of; null without any.
const Initial* last_displacement(const Scene& scene) {
  const auto last = std::find_if(scene.initial.rbegin(), scene.initial.rend(), [](const Initial& one) { return one.displacement; });
  return last == scene.initial.rend() ? nullptr : &*last;
}

/// The sum of all velocities, or of all displacements.
InitialField field_of(const std::vector<Initial>& all, bool displacements, const dynamics::Model& model, Faults& faults) {
  InitialField sum{Vectors::Zero(3, model.mesh.X.cols()), std::vector<Mat3>(model.node_of_rotation.size(), Mat3::Zero())};
  const double size = diagonal(model.mesh);
  for (const Initial& initial : all) {
    if (initial.displacement != displacements) continue;
    for (const Index node : mesh::node_set(model.mesh, initial.body)) {
      const Vec3 X = model.mesh.X.col(node);
      for (int axis = 0; axis < 3; ++axis) {
        const double value = initial.value[axis](X.x(), X.y(), X.z(), 0);
        refuse_infinite(faults, part_of_initial(initial), displacements ? "displacement" : "velocity", value, at_place(X));
        sum.value(axis, node) += value;
      }
      const Index turn = model.rotation_of_node[node];
      if (turn >= 0) sum.gradient[turn] += gradient_at(initial.value, X, size);
    }
  }
  return sum;
}

}  // namespace

void add_planes(const Scene& scene, dynamics::Model& model, Faults& faults) {
  load::Constraints made;
  for (const Plane& plane : scene.planes) {
    made.planes.push_back(with_nodes(plane, model.mesh));
    const load::Plane& last = made.planes.back();
    if (plane.velocity) refuse_infinite(faults, part_of(plane), "velocity.value", plane.velocity(0), "t = 0");
    for (const Index node : last.nodes) {  // what drives nodes is a number at the start
      if (plane.field[0]) refuse_infinite_start(faults, part_of(plane), "velocity.value", plane.field, model.mesh.X.col(node));
      if (plane.angular_velocity[0])
        refuse_infinite_start(faults, part_of(plane), "angular_velocity.value", plane.angular_velocity, model.mesh.X.col(node));
    }
    if (plane.kind == load::PlaneKind::symmetry) refuse_nodes_beside(faults, part_of(plane), last, model.mesh);
  }
  bool conflicts = false;
  if (scene.stages.empty()) conflicts = conflict(scene.planes, made, faults);
  for (const Stage& stage : scene.stages) conflicts = conflicts || conflict(scene.planes, constraints_in(stage, made), faults);
  if (!conflicts) model.constraints.planes = std::move(made.planes);
  for (const PointMass& point : scene.point_masses)
    model.point_masses.push_back({point.name, mesh::node_set(model.mesh, point.nodes), point.mass});
}

void add_rigid_planes(const Scene& scene, dynamics::Model& model) {
  for (const RigidPlane& plane : scene.rigid_planes) {
    const mesh::Surface& surface = mesh::surface(model.mesh, plane.surface);
    const rigid::Body* round = plane.method == contact::Method::multiplier ? dynamics::round_body_of(model, surface) : nullptr;
    const Subset nodes = round != nullptr ? Subset() : mesh::surface_nodes(surface);
    model.rigid_planes.push_back({.name = plane.name,
                                  .point = plane.point,
                                  .normal = plane.normal,
                                  .nodes = nodes,
                                  .area = mesh::tributary_areas(model.mesh, surface, nodes),
                                  .faces = mesh::faces_around(model.mesh, surface, nodes),
                                  .rounds = round != nullptr ? std::vector{*round->round} : std::vector<mesh::RoundBody>(),
                                  .round_area = mesh::facet_areas(model.mesh, surface).mean(),
                                  .method = plane.method,
                                  .restitution = plane.restitution,
                                  .impedance = dynamics::surface_impedance(model, surface),
                                  .penalty = plane.penalty.value_or(plane.penalty_scale * dynamics::surface_stiffness(model, surface)),
                                  .impact_step_factor = contact::impact_step_factor_for(plane.energy_gain_limit),
                                  .first_step_factor = plane.step_factor,
                                  .friction = plane.friction,
                                  .depth = dynamics::surface_depth(model, surface)});
  }
}

void check_sides_of_planes(const Scene& scene, const dynamics::Model& model, const Vectors& x, Faults& faults) {
  const auto& planes = model.constraints.planes;  // none after a conflict
  for (std::size_t p = 0; p < planes.size(); ++p)
    if (planes[p].kind == load::PlaneKind::floor) refuse_nodes_behind(faults, part_of(scene.planes[p]), planes[p], x);
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) {
    refuse_nodes_behind(faults, part("plane", scene.rigid_planes[p]), model.rigid_planes[p], x);
    refuse_shapes_behind(faults, part("plane", scene.rigid_planes[p]), model.rigid_planes[p], x);
  }
}

void add_loads(const Scene& scene, dynamics::Model& model, Faults& faults) {
  model.gravity = scene.gravity;
  model.relaxation = any_relaxation(scene);
  for (const Load& load : scene.loads) add_load(load, model, faults);
  for (const Spring& spring : scene.springs) add_spring(spring, model, faults);
  for (const Plane& plane : scene.planes) {
    if (!plane.angular_velocity[0]) continue;
    const Subset nodes = with_nodes(plane, model.mesh).nodes;
    const auto turns = [&](Index node) { return model.rotation_of_node[node] >= 0 || dynamics::is_rigid_node(model, node); };
    if (std::none_of(nodes.begin(), nodes.end(), turns))
      refuse(faults, part_of(plane), "angular_velocity",
             "'angular_velocity' is of nodes of plates or rigid bodies: " + quote(plane.name) + " has none");
  }
}

void add_velocities(const std::vector<Initial>& all, const dynamics::Model& model, Vectors& velocity, Vectors& spin, Faults& faults) {
  const InitialField given = field_of(all, false, model, faults);
  velocity += given.value;
  spin += dynamics::angular_velocities_of(model, given.gradient);
}

std::optional<InitialField> initial_displacement(const Scene& scene, const dynamics::Model& model, Faults& faults) {
  const Initial* last = last_displacement(scene);
  if (last == nullptr) return {};
  const std::size_t before = faults.size();
  InitialField displacement = field_of(scene.initial, true, model, faults);
  if (faults.size() > before) return {};
  if (const double most = (model.mesh.X + displacement.value).cwiseAbs().maxCoeff(); !(most < farthest)) {
    refuse(faults, part_of_initial(*last), "displacement",
           formatted("'displacement' puts a node %.4g m from the origin: expected less than %g m", most, farthest));
    return {};
  }
  return displacement;
}

void set_initial(const Scene& scene, const dynamics::Model& model, const std::optional<InitialField>& displacement, dynamics::State& state,
                 Faults& faults) {
  add_velocities(scene.initial, model, state.v, state.omega, faults);
  if (!displacement || !faults.empty()) return;
  const element::BlockLimit smallest = dynamics::displace(model, state, displacement->value, displacement->gradient);
  if (!(smallest.volume_ratio > 0))
    refuse(faults, part_of_initial(*last_displacement(scene)), "displacement",
           "'displacement' turns element " + std::to_string(smallest.volume_element) + " inside out");
}

}  // namespace nereid::model
