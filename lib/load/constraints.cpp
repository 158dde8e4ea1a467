#include "load/constraints.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/check.hpp"
#include "base/dense.hpp"

namespace nereid::load {

namespace {

constexpr double same_plane = 1e-6;  // [rad]: normals typed with eight digits agree to less

bool constrains_all(const Plane& plane) { return plane.kind == PlaneKind::fixed || plane.kind == PlaneKind::driven; }
int rows_of(const Plane& plane) { return constrains_all(plane) ? 3 : 1; }
Vec3 normal_of(const Plane& plane, int row) { return constrains_all(plane) ? Vec3(Vec3::Unit(row)) : plane.normal; }

double at(const OverSpace& value, const Vec3& X, double t) { return value ? value(X.x(), X.y(), X.z(), t) : 0; }

}  // namespace

void add_plane(const Constraints& constraints, ConstrainedNode& node, int plane) {
  const Plane& added = constraints.planes[plane];
  check(node.count + rows_of(added) <= ConstrainedNode::most_rows, "too many planes constrain one node");
  int place = node.count;
  if (constrains_all(added))  // before all planes of one direction
    for (place = 0; place < node.count && constrains_all(constraints.planes[node.plane[place]]);) ++place;
  const int last = node.count;
  for (int row = 0; row < rows_of(added); ++row) {
    node.plane[node.count] = plane;
    node.normal[node.count++] = normal_of(added, row);
  }
  std::rotate(node.plane.begin() + place, node.plane.begin() + last, node.plane.begin() + node.count);
  std::rotate(node.normal.begin() + place, node.normal.begin() + last, node.normal.begin() + node.count);
  node.moves = node.moves || moves(added);
  node.rotation_constrained = node.rotation_constrained || constrains_all(added);
  if (added.kind == PlaneKind::driven) node.driver = plane;
  Eigen::Matrix<double, 3, ConstrainedNode::most_rows> normals = Eigen::Matrix<double, 3, ConstrainedNode::most_rows>::Zero();
  Mat3 rotation = Mat3::Identity(), free = Mat3::Identity();
  for (int p = 0; p < node.count; ++p) {
    const Plane& here = constraints.planes[node.plane[p]];
    // a plane that allows what those before it allow anyway takes no part and no reaction
    const Vec3 rest = free * node.normal[p];
    if (rest.norm() > same_plane) {
      normals.col(p) = node.normal[p];
      free -= rest.normalized() * rest.normalized().transpose();
    }
    if (here.kind != PlaneKind::symmetry) continue;
    // a rotation about the normal is its own mirror image; two different normals leave none
    const Mat3 about = here.normal * here.normal.transpose();
    rotation = about * rotation;
    if (rotation.norm() < 1 - 1e-9) rotation.setZero();
  }
  if (node.rotation_constrained) rotation.setZero();
  node.allowed_rotation = rotation;
  // A reaction R = sum of c_p n_p has c = pseudo-inverse of the normals times R
  const Eigen::Matrix<double, ConstrainedNode::most_rows, 3> inverse = pseudo_inverse(normals);
  node.allowed = Mat3::Identity() - normals * inverse;
  for (int p = 0; p < node.count; ++p) node.reaction[p] = inverse.row(p).transpose();
  // along an axis the projector is exact, so that a constrained node stays on its plane to the last bit
  for (int i = 0; i < 9; ++i) {
    double& entry = node.allowed.data()[i];
    if (std::abs(entry) < 1e-14) entry = 0;
    if (std::abs(entry - 1) < 1e-14) entry = 1;
  }
}

Memory prepare(const Constraints& constraints, Index nodes, const std::vector<Index>& rotation_of_node) {
  Memory memory;
  memory.row_of_node.assign(nodes, -1);
  memory.account.resize(constraints.planes.size());
  memory.speed.assign(constraints.planes.size(), 0);
  Subset all;
  for (const Plane& plane : constraints.planes) all.insert(all.end(), plane.nodes.begin(), plane.nodes.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (const Index node : all) {
    memory.row_of_node[node] = static_cast<Index>(memory.nodes.size());
    ConstrainedNode constrained;
    constrained.node = node;
    constrained.rotation = rotation_of_node[node];
    memory.nodes.push_back(constrained);
  }
  for (std::size_t p = 0; p < constraints.planes.size(); ++p) {
    const Plane& plane = constraints.planes[p];
    const bool is_floor = plane.kind == PlaneKind::floor;
    memory.stopped.emplace_back(is_floor ? plane.nodes.size() : 0, 0);
    if (is_floor) continue;
    for (const Index node : plane.nodes) add_plane(constraints, memory.nodes[memory.row_of_node[node]], static_cast<int>(p));
  }
  std::vector<int> rows_of_node(memory.nodes.size(), 0);  // floors too: no exception may cross a step
  for (const Plane& plane : constraints.planes)
    for (const Index node : plane.nodes)
      check((rows_of_node[memory.row_of_node[node]] += rows_of(plane)) <= ConstrainedNode::most_rows, "too many planes constrain one node");
  memory.active.reserve(memory.nodes.size());
  for (std::size_t place = 0; place < memory.nodes.size(); ++place)
    if (memory.nodes[place].count > 0) memory.active.push_back(static_cast<Index>(place));
  memory.impacting.reserve(memory.nodes.size() * constraints.planes.size());
  return memory;
}

Memory in_place_of(const Memory& before, const Constraints& constraints, Index nodes, const std::vector<Index>& rotation_of_node) {
  Memory memory = prepare(constraints, nodes, rotation_of_node);
  memory.account = before.account;
  for (std::size_t p = 0; p < constraints.planes.size(); ++p) {
    const Plane& plane = constraints.planes[p];
    if (plane.kind != PlaneKind::floor) continue;
    memory.stopped[p] = before.stopped[p];
    for (std::size_t i = 0; i < plane.nodes.size(); ++i) {
      if (memory.stopped[p][i] == 0) continue;
      const Index row = memory.row_of_node[plane.nodes[i]];
      if (memory.nodes[row].count == 0) memory.active.push_back(row);
      add_plane(constraints, memory.nodes[row], static_cast<int>(p));
    }
  }
  return memory;
}

void restrain(const Constraints&, const ConstrainedNode& node, const Vec3& x, double mass, Vec3& v,
              std::vector<PlaneAccount>& accounts) {
  if (node.count == 0) return;
  const Vec3 wanted = v;
  v = node.allowed * wanted;
  const Vec3 impulse = mass * (v - wanted);
  for (int p = 0; p < node.count;) {
    const int plane = node.plane[p];
    Vec3 share = Vec3::Zero();  // one sum for each plane: an addition to an account waits for the one before
    for (; p < node.count && node.plane[p] == plane; ++p) share += node.reaction[p].dot(impulse) * node.normal[p];
    accounts[plane].impulse += share;
    accounts[plane].angular_impulse += x.cross(share);
  }
}

void set_speeds(const Constraints& constraints, const Vectors& X, double t, Memory& memory) {
  for (std::size_t p = 0; p < constraints.planes.size(); ++p)
    if (constraints.planes[p].velocity) memory.speed[p] = constraints.planes[p].velocity(t);
  for (const Index place : memory.active) {
    ConstrainedNode& node = memory.nodes[place];
    if (!node.moves) continue;
    for (int p = 0, row = 0; p < node.count; ++p) {
      const Plane& plane = constraints.planes[node.plane[p]];
      const bool driven = plane.kind == PlaneKind::driven;
      node.speed[p] = driven ? at(plane.field[row++ % 3], X.col(node.node), t) : memory.speed[node.plane[p]];
    }
    if (node.driver < 0 || node.rotation < 0) continue;
    for (int axis = 0; axis < 3; ++axis)
      node.angular_velocity(axis) = at(constraints.planes[node.driver].angular_velocity[axis], X.col(node.node), t);
  }
}

void drive(const Constraints& constraints, const ConstrainedNode& node, const Vec3& x, double mass, const Vec3& before, const Vec3& force,
           double quarter_step, Vec3& v, std::vector<PlaneAccount>& accounts) {
  const Vec3 wanted = v;
  v = node.allowed * wanted;
  for (int p = 0; p < node.count; ++p) v += node.speed[p] * node.reaction[p];
  const Vec3 impulse = mass * (v - wanted), change = v - before, twice_mean = v + before;
  for (int p = 0; p < node.count; ++p) {
    const Vec3& normal = node.normal[p];
    const Vec3 share = node.reaction[p].dot(impulse) * normal;
    PlaneAccount& account = accounts[node.plane[p]];
    account.impulse += share;
    account.angular_impulse += x.cross(share);
    const double work = 0.5 * share.dot(twice_mean) + quarter_step * node.reaction[p].dot(force) * normal.dot(change);
    if (moves(constraints.planes[node.plane[p]])) {
      account.driven += work;
    } else {
      account.stopped -= work;  // of a plane at rest: only at the start
    }
  }
}

void restrain_rotation(const ConstrainedNode& node, double inertia, Vec3& omega, std::vector<PlaneAccount>& accounts) {
  if (node.count == 0) return;
  const Vec3 wanted = omega;
  omega = node.allowed_rotation * wanted;
  accounts[node.plane[0]].angular_impulse += inertia * (omega - wanted);
}

void drive_rotation(const ConstrainedNode& node, double inertia, const Vec3& before, const Vec3& moment, double quarter_step, Vec3& omega,
                std::vector<PlaneAccount>& accounts) {
  const Vec3 impulse = inertia * (node.angular_velocity - omega);
  omega = node.angular_velocity;
  PlaneAccount& account = accounts[node.driver];
  account.angular_impulse += impulse;
  account.driven += 0.5 * impulse.dot(omega + before) + quarter_step * moment.dot(omega - before);
}

void constrain(const Constraints& constraints, const Kick& kick, const Vectors& x, Vectors& v, Vectors& omega, Memory& memory) {
  for (const Index place : memory.active) {
    const ConstrainedNode& node = memory.nodes[place];
    const double mass = kick.mass(node.node);
    Vec3 velocity = v.col(node.node);
    if (node.moves) {
      const Vec3 force = kick.force.col(node.node), before = velocity - kick.dt / mass * force;
      drive(constraints, node, x.col(node.node), mass, before, force, kick.quarter_step, velocity, memory.account);
    } else {
      restrain(constraints, node, x.col(node.node), mass, velocity, memory.account);
    }
    v.col(node.node) = velocity;
    if (node.rotation < 0) continue;
    Vec3 spin = omega.col(node.rotation);
    const double inertia = kick.inertia(node.rotation);
    if (node.driver >= 0) {
      const Vec3 moment = kick.moment.col(node.rotation), before = spin - kick.dt / inertia * moment;
      drive_rotation(node, inertia, before, moment, kick.quarter_step, spin, memory.account);
    } else {
      restrain_rotation(node, inertia, spin, memory.account);
    }
    omega.col(node.rotation) = spin;
  }
}

Source source(const Plane& plane) {
  constexpr std::array kinds{SourceKind::constrained, SourceKind::fixed, SourceKind::symmetry, SourceKind::floor, SourceKind::driven};
  return {plane.name, kinds[static_cast<std::size_t>(plane.kind)],
          moves(plane) ? std::vector{Stored::external_work} : std::vector<Stored>{}, {Dissipated::inelastic_impact}};
}

void post(const PlaneAccount& plane, Account& account) {
  account.work = plane.driven - plane.stopped;
  account.stored[Stored::external_work] = -plane.driven;
  account.dissipated[Dissipated::inelastic_impact] = plane.stopped;
  account.impulse = plane.impulse;
  account.angular_impulse = plane.angular_impulse;
}

Conflict find_conflict(const Constraints& constraints) {
  const auto& planes = constraints.planes;
  for (std::size_t p = 0; p < planes.size(); ++p) {
    if (!moves(planes[p])) continue;
    for (const Index node : planes[p].nodes) {
      // the plane must add a direction to what all others of this node constrain
      Mat3 free = Mat3::Identity();
      int last = -1;
      for (std::size_t q = 0; q < planes.size(); ++q) {
        if (q == p || planes[q].kind == PlaneKind::floor || !std::binary_search(planes[q].nodes.begin(), planes[q].nodes.end(), node))
          continue;
        for (int row = 0; row < rows_of(planes[q]); ++row) {
          const Vec3 rest = free * normal_of(planes[q], row);
          if (rest.norm() > same_plane) free -= rest.normalized() * rest.normalized().transpose();
        }
        const bool adds = planes[p].kind != PlaneKind::driven && (free * planes[p].normal).norm() > same_plane;
        if (!adds) {
          last = static_cast<int>(q);
          break;
        }
      }
      if (last >= 0) return {static_cast<int>(p), last, node};
    }
  }
  return {};
}

Index find_overconstrained(const Constraints& constraints) {
  Subset all;
  for (const Plane& plane : constraints.planes)
    for (int row = 0; row < rows_of(plane); ++row) all.insert(all.end(), plane.nodes.begin(), plane.nodes.end());
  std::sort(all.begin(), all.end());
  for (std::size_t i = ConstrainedNode::most_rows; i < all.size(); ++i)
    if (all[i] == all[i - ConstrainedNode::most_rows]) return all[i];
  return -1;
}

}  // namespace nereid::load
