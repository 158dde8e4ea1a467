#include "model/rigid_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "base/words.hpp"
#include "mesh/placement.hpp"
#include "rigid/hold.hpp"

namespace nereid::model {

namespace {

constexpr double steps_of_rigid_scenes = 1000;  // in a run, at least
constexpr double same_velocity = 1e-6;          // of velocities: expressions of place have some digits

rigid::MassProperties mass_of(const Body& body, const dynamics::Model& model, const Subset& nodes) {
  const Vec3 about = model.mesh.X.col(nodes.front());
  rigid::Moments sum;
  for (const element::AnyBlock& block : model.blocks) {
    if (!belongs(element::name(block), body)) continue;
    const element::Connectivity& corners = element::nodes(block);
    const double density = std::visit([](const auto& one) { return one.law.density; }, block);
    if (corners.rows() == 8) rigid::add_hexahedra(model.mesh.X, corners, density, about, sum);
    else rigid::add_plates(model.mesh.X, corners, density, body.plate.thickness, about, sum);
  }
  for (const load::PointMass& point : model.point_masses)
    for (const Index node : point.nodes)
      if (std::binary_search(nodes.begin(), nodes.end(), node))
        rigid::add_point(model.mesh.X.col(node), point.mass / static_cast<double>(point.nodes.size()), about, sum);
  rigid::MassProperties mass = rigid::properties(sum, about);
  if (body.given.mass) mass.inertia *= *body.given.mass / mass.mass, mass.mass = *body.given.mass;
  if (body.given.centre) mass.centre = *body.given.centre;
  if (body.given.inertia) mass.inertia = *body.given.inertia;
  return mass;
}

/// The shape that a mesh was made of.
std::optional<geometry::Round> round_of(const Body& body) {
  if (body.shape) {
    geometry::Round given = body.shape->shape;
    if (given.kind == geometry::RoundKind::tube) given.half_thickness = body.plate.thickness / 2;
    return given;
  }
  if (body.map[0]) return std::nullopt;
  std::optional<geometry::Round> round;
  if (const auto* sphere = std::get_if<mesh::Sphere>(&body.mesh)) round = mesh::round_of(*sphere);
  if (const auto* cylinder = std::get_if<mesh::Cylinder>(&body.mesh)) round = mesh::round_of(*cylinder);
  if (const auto* ring = std::get_if<mesh::Revolved>(&body.mesh)) round = mesh::round_of(*ring);
  if (const auto* tube = std::get_if<mesh::Tube>(&body.mesh)) round = mesh::round_of(*tube, body.plate.thickness / body.scale);
  if (!round) return std::nullopt;
  for (double* length : {&round->radius, &round->inner, &round->half_length, &round->half_thickness}) *length *= body.scale;
  return round;
}

/// Where that shape stands.
geometry::PlacedRound placed_round(const Body& body) {
  mesh::Mesh frame, axes;
  const Vec3 centre = body.scale * std::visit(
      [](const auto& one) {
        if constexpr (requires { mesh::centre_of(one); }) return mesh::centre_of(one);
        else return Vec3(Vec3::Zero());
      },
      body.mesh);
  frame.X = body.shape ? body.shape->centre : centre;
  if (body.place.angle != 0) frame = mesh::rotated_about(std::move(frame), body.place.axis, body.place.angle, body.place.about);
  const Vec3 axis = body.shape ? body.shape->axis : Vec3(Vec3::UnitZ());
  axes.X.resize(3, 2);
  axes.X << axis, (body.shape ? axis.unitOrthogonal() : Vec3(Vec3::UnitX()));
  if (body.place.angle != 0) axes = mesh::rotated_about(std::move(axes), body.place.axis, body.place.angle, Vec3::Zero());
  return {.centre = frame.X.col(0) + body.place.move, .axis = axes.X.col(0), .across = axes.X.col(1)};
}

/// The nodes of the skin lie on a shape that is given, or on the mid-surface of a tube.
void refuse_nodes_off(const Body& body, const geometry::Round& round, const mesh::Mesh& mesh, Faults& faults) {
  constexpr double on_shape = 1e-6;  // of its size: files have some digits
  const geometry::PlacedRound at = placed_round(body);
  double most = 0;
  for (const Index node : mesh::node_set(mesh, body.name + ".skin"))
    most = std::max(most, std::abs(geometry::over_round(round, at, mesh.X.col(node)).distance + round.half_thickness));
  if (most > on_shape * geometry::reach(round))
    refuse(faults, part("body", body), "shape",
           formatted("nodes of the skin of '%s' lie beside the 'shape', by %.4g m at most", body.name.c_str(), most));
}

/// Lets a rigid body touch as the shape that it is.
void set_round(const Body& body, const mesh::Mesh& mesh, rigid::Body& rigid, Faults& faults) {
  const Vectors& X = mesh.X;
  if (body.surface == TouchesAs::facets) return;
  const std::optional<geometry::Round> round = round_of(body);
  if (body.shape) refuse_nodes_off(body, *round, mesh, faults);
  if (round) rigid.round = mesh::tied(*round, placed_round(body), X, rigid.nodes);
  else if (body.surface == TouchesAs::exact)
    refuse(faults, part("body", body), "surface",
           quote(body.name) + " has no exact surface: whole meshes of the kinds 'sphere', 'cylinder' and 'tube', and 'revolved' of one "
                              "rectangle have one, without 'map'");
}

/// Directions in which a plane holds its nodes.
std::vector<Vec3> normals_of(const load::Plane& plane) {
  if (plane.kind == load::PlaneKind::fixed) return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  return {plane.normal};
}

Part part_of(const Scene& scene, const load::Plane& plane) {
  for (const Plane& one : scene.planes)
    if (one.name == plane.name) return part("plane", one);
  return {"", "plane '" + plane.name + "'"};
}

/// Which directions planes hold of a body, each once, and the share of a reaction that belongs to each: the first plane has all of it that
/// is along a direction it holds.
void set_rows(const Scene& scene, const load::Constraints& constraints, const std::vector<int>& planes, dynamics::HeldBody& held,
              Faults& faults) {
  Mat3 free = Mat3::Identity();
  for (const int p : planes) {
    const load::Plane& plane = constraints.planes[static_cast<std::size_t>(p)];
    for (const Vec3& normal : normals_of(plane)) {
      const Vec3 rest = free * normal;
      if (rest.norm() > same_velocity) {
        held.rows.push_back({p, normal, Vec3::Zero()});
        free -= rest.normalized() * rest.normalized().transpose();
      } else if (load::moves(plane)) {
        refuse(faults, part_of(scene, plane), "velocity",
               quote(plane.name) + " moves a rigid body in a direction that another plane holds");
      }
    }
  }
  Eigen::MatrixXd normals(3, static_cast<Eigen::Index>(held.rows.size()));
  for (std::size_t r = 0; r < held.rows.size(); ++r) normals.col(static_cast<Eigen::Index>(r)) = held.rows[r].normal;
  const Eigen::MatrixXd inverse = pseudo_inverse(normals);
  for (std::size_t r = 0; r < held.rows.size(); ++r) held.rows[r].reaction = inverse.row(static_cast<Eigen::Index>(r)).transpose();
}

/// Whether a prescribed velocity is the same at all nodes of a body: at the start, at the end and between.
bool is_uniform(const Field& field, const rigid::Body& body, double end) {
  const auto at = [&](int axis, const Vec3& X, double t) { return field[axis] ? field[axis](X.x(), X.y(), X.z(), t) : 0; };
  const Vec3& C = body.mass.centre;
  for (const double t : {0.0, 0.3 * end, end}) {
    double most = 0, off = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (Eigen::Index i = 0; i < body.arm.cols(); ++i) {
        const double here = at(axis, C + body.arm.col(i), t);
        most = std::max(most, std::abs(here));
        off = std::max(off, std::abs(here - at(axis, C, t)));
      }
    if (off > same_velocity * most) return false;
  }
  return true;
}

/// What the planes of the scene do to a body.
dynamics::HeldBody hold(const Scene& scene, const load::Constraints& constraints, rigid::Body& body, Faults& faults) {
  dynamics::HeldBody held;
  std::vector<rigid::HeldNode> nodes;
  std::vector<int> planes;
  double size = 0;
  for (Eigen::Index i = 0; i < body.arm.cols(); ++i) size = std::max(size, body.arm.col(i).norm());
  for (std::size_t p = 0; p < constraints.planes.size(); ++p) {
    const load::Plane& plane = constraints.planes[p];
    const Part here = part_of(scene, plane);
    std::size_t count = 0;
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
      if (!std::binary_search(plane.nodes.begin(), plane.nodes.end(), body.nodes[i])) continue;
      ++count;
      if (plane.kind == load::PlaneKind::driven || plane.kind == load::PlaneKind::floor) continue;
      for (const Vec3& normal : normals_of(plane)) nodes.push_back({body.arm.col(static_cast<Eigen::Index>(i)), normal});
    }
    if (count == 0) continue;
    if (plane.kind == load::PlaneKind::floor)
      refuse(faults, here, "nodes", "a floor has nodes of the rigid body " + quote(body.name) + ": take a plane of the kind 'rigid'");
    else if (plane.kind != load::PlaneKind::driven)
      planes.push_back(static_cast<int>(p));
    else if (count < body.nodes.size())
      refuse(faults, here, "nodes", quote(plane.name) + " drives a part of the rigid body " + quote(body.name) + ": name the whole body");
    else if (!is_uniform(plane.field, body, scene.time.end))
      refuse(faults, here, "velocity",
             "the velocity of " + quote(plane.name) + " differs over the rigid body " + quote(body.name) +
                 ": give that of its centre, and its spin as 'angular_velocity'");
    else if (!is_uniform(plane.angular_velocity, body, scene.time.end))
      refuse(faults, here, "angular_velocity",
             "the angular velocity of " + quote(plane.name) + " differs over the rigid body " + quote(body.name) + ", which has one only");
    else if (held.driver < 0)
      held.driver = static_cast<int>(p);
  }
  if (planes.empty()) return held;
  const Part here = part_of(scene, constraints.planes[static_cast<std::size_t>(planes.front())]);
  if (held.driver >= 0) {
    refuse(faults, here, "nodes", "the rigid body " + quote(body.name) + " is driven: no other plane may hold it");
    return held;
  }
  const std::optional<rigid::Hold> found = rigid::hold_of(nodes, size);
  if (!found)
    refuse(faults, here, "nodes",
           "planes would leave the rigid body " + quote(body.name) + " a turn that is not about one axis through its centre: a hinge or a "
           "ball joint is not available; hold a whole face, or use springs");
  else
    body.hold = *found;
  // fixed planes first, as of nodes: shares between three axes and one more plane would depend on the axes
  std::stable_partition(planes.begin(), planes.end(), [&](int p) { return constraints.planes[p].kind == load::PlaneKind::fixed; });
  held.first = planes.front();
  set_rows(scene, constraints, planes, held, faults);
  return held;
}

}  // namespace

void add_rigid_bodies(const Scene& scene, dynamics::Model& model, Faults& faults) {
  if (std::none_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& body) { return body.rigid; })) return;
  model.rigid_of_block.assign(model.blocks.size(), -1);
  for (const Body& body : scene.bodies) {
    if (!body.rigid) continue;
    const Subset& nodes = mesh::node_set(model.mesh, body.name);
    const rigid::MassProperties mass = mass_of(body, model, nodes);
    if (!(mass.mass > 0) || !rigid::is_possible(mass.inertia)) {
      refuse(faults, part("body", body), body.given.inertia ? "mass_properties.inertia" : "rigid",
             "no body has the inertia of " + quote(body.name) + ": each principal moment is positive and at most the sum of the others");
      continue;
    }
    for (std::size_t b = 0; b < model.blocks.size(); ++b)
      if (belongs(element::name(model.blocks[b]), body)) model.rigid_of_block[b] = static_cast<Index>(model.rigid_bodies.size());
    model.rigid_bodies.push_back(rigid::make_body(body.name, mass, model.mesh.X, nodes));
    set_round(body, model.mesh, model.rigid_bodies.back(), faults);
  }
  hold_rigid_bodies(scene, model.constraints, model, faults);
  const bool all = std::none_of(model.rigid_of_block.begin(), model.rigid_of_block.end(), [](Index body) { return body < 0; });
  if (all && !(scene.time.largest_step > 0)) model.longest_step = scene.time.end / steps_of_rigid_scenes;
}

void hold_rigid_bodies(const Scene& scene, const load::Constraints& constraints, dynamics::Model& model, Faults& faults) {
  model.held_bodies.clear();
  for (rigid::Body& body : model.rigid_bodies) {
    body.hold = {};
    model.held_bodies.push_back(hold(scene, constraints, body, faults));
  }
}

void refuse_to_relax_free_bodies(const Part& part, const dynamics::Model& model, Faults& faults) {
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const rigid::Body& body = model.rigid_bodies[b];
    const bool is_held = model.held_bodies[b].driver < 0 && body.hold.shift.isZero(0) && body.hold.turns == 0;
    if (!is_held)
      refuse(faults, part, "relaxation", "relaxation does not damp the rigid body " + quote(body.name) + ": hold it by a fixed plane");
  }
}

void refuse_late_holds(const Scene& scene, const load::Constraints& before, const load::Constraints& after, const dynamics::Model& model,
                       Faults& faults) {
  for (std::size_t p = 0; p < after.planes.size(); ++p) {
    const load::Plane& plane = after.planes[p];
    if (!before.planes[p].nodes.empty() || plane.kind != load::PlaneKind::constrained) continue;
    for (const rigid::Body& body : model.rigid_bodies)
      if (std::find_first_of(body.nodes.begin(), body.nodes.end(), plane.nodes.begin(), plane.nodes.end()) != body.nodes.end())
        refuse(faults, part_of(scene, plane), "nodes",
               quote(plane.name) + " begins to hold the rigid body " + quote(body.name) +
                   " in a later stage, when this may have turned: let it act from the start, or say 'fixed'");
  }
}

void refuse_no_rigid_motions(const std::vector<Initial>& all, const dynamics::Model& model, const Vectors& velocity, Faults& faults) {
  for (const Initial& initial : all) {
    const auto body = std::find_if(model.rigid_bodies.begin(), model.rigid_bodies.end(),
                                   [&](const rigid::Body& one) { return one.name == initial.body; });
    if (body == model.rigid_bodies.end()) continue;
    const rigid::Twist twist = rigid::fit(*body, velocity);
    double most = 0, off = 0;
    for (std::size_t i = 0; i < body->nodes.size(); ++i) {
      const Vec3 v = velocity.col(body->nodes[i]);
      most = std::max(most, v.norm());
      off = std::max(off, (v - rigid::velocity_at(twist, body->arm.col(static_cast<Eigen::Index>(i)), 0)).norm());
    }
    if (off > same_velocity * most)
      refuse(faults, {initial.at, "initial motion of '" + initial.body + "'"}, "velocity",
             "the velocity is no rigid motion of " + quote(initial.body) + ": v + w x (x - c) is one");
  }
}

void check_rigid_bodies(const Scene& scene, const dynamics::Model& model, const dynamics::State& state, Faults& faults) {
  if (model.rigid_bodies.empty()) return;
  const auto find = [&](const std::string& body) {
    return std::find_if(model.rigid_bodies.begin(), model.rigid_bodies.end(), [&](const rigid::Body& one) { return one.name == body; });
  };
  const auto is_of_rigid = [&](const std::string& surface) {
    return find(surface.substr(0, surface.find('.'))) != model.rigid_bodies.end();
  };
  if (scene.relaxation) refuse_to_relax_free_bodies({"", "the scene"}, model, faults);
  for (const Contact& contact : scene.contacts) {
    const bool tied = contact.interface.kind == contact::InterfaceKind::tied;
    if (tied && contact.interface.method == contact::Method::multiplier && (is_of_rigid(contact.apexes) || is_of_rigid(contact.base)))
      refuse(faults, part("contact", contact), "kind", "a tie by multipliers to a rigid body is not available: say 'method: penalty'");
  }
  for (const Initial& initial : scene.initial)
    if (initial.displacement && find(initial.body) != model.rigid_bodies.end())
      refuse(faults, {initial.at, "initial motion of '" + initial.body + "'"}, "displacement",
             "a rigid body starts where 'rotate' and 'move' put it, and has no displacement");
  refuse_no_rigid_motions(scene.initial, model, state.v, faults);
}

}  // namespace nereid::model
