#include "load/constraints.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>

#include "base/check.hpp"

namespace nereid::load {

namespace {

constexpr double same_plane = 1e-6;  // [rad]: normals typed with eight digits agree to less

bool holds_all(const Plane& plane) { return plane.kind == PlaneKind::fixed || plane.kind == PlaneKind::driven; }
int rows_of(const Plane& plane) { return holds_all(plane) ? 3 : 1; }
Vec3 normal_of(const Plane& plane, int row) { return holds_all(plane) ? Vec3(Vec3::Unit(row)) : plane.normal; }

double at(const OverSpace& value, const Vec3& X, double t) { return value ? value(X.x(), X.y(), X.z(), t) : 0; }

}  // namespace

void hold(const Constraints& constraints, ConstrainedNode& held, int plane) {
  const Plane& added = constraints.planes[plane];
  check(held.count + rows_of(added) <= ConstrainedNode::most_rows, "too many planes hold one node");
  for (int row = 0; row < rows_of(added); ++row) {
    held.plane[held.count] = plane;
    held.normal[held.count++] = normal_of(added, row);
  }
  held.moves = held.moves || moves(added);
  held.rotation_constrained = held.rotation_constrained || holds_all(added);
  if (added.kind == PlaneKind::driven) held.driver = plane;
  Eigen::Matrix<double, 3, ConstrainedNode::most_rows> normals = Eigen::Matrix<double, 3, ConstrainedNode::most_rows>::Zero();
  Mat3 rotation = Mat3::Identity(), free = Mat3::Identity();
  for (int p = 0; p < held.count; ++p) {
    const Plane& here = constraints.planes[held.plane[p]];
    // a plane that allows what those before it allow anyway takes no part and no reaction
    const Vec3 rest = free * held.normal[p];
    if (rest.norm() > same_plane) {
      normals.col(p) = held.normal[p];
      free -= rest.normalized() * rest.normalized().transpose();
    }
    if (here.kind != PlaneKind::symmetry) continue;
    // a rotation about the normal is its own mirror image; two different normals leave none
    const Mat3 about = here.normal * here.normal.transpose();
    rotation = about * rotation;
    if (rotation.norm() < 1 - 1e-9) rotation.setZero();
  }
  if (held.rotation_constrained) rotation.setZero();
  held.allowed_rotation = rotation;
  // A reaction R = sum of c_p n_p has c = pseudo-inverse of the normals times R
  const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, 3, ConstrainedNode::most_rows>> decomposition(normals);
  const Eigen::Matrix<double, ConstrainedNode::most_rows, 3> inverse = decomposition.pseudoInverse();
  held.allowed = Mat3::Identity() - normals * inverse;
  for (int p = 0; p < held.count; ++p) held.reaction[p] = inverse.row(p).transpose();
  // along an axis the projector is exact, so that a constrained node stays on its plane to the last bit
  for (int i = 0; i < 9; ++i) {
    double& entry = held.allowed.data()[i];
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
    ConstrainedNode held;
    held.node = node;
    held.rotation = rotation_of_node[node];
    memory.nodes.push_back(held);
  }
  for (std::size_t p = 0; p < constraints.planes.size(); ++p) {
    const Plane& plane = constraints.planes[p];
    const bool is_floor = plane.kind == PlaneKind::floor;
    memory.stopped.emplace_back(is_floor ? plane.nodes.size() : 0, 0);
    if (is_floor) continue;
    for (const Index node : plane.nodes) hold(constraints, memory.nodes[memory.row_of_node[node]], static_cast<int>(p));
  }
  std::vector<int> rows_of_node(memory.nodes.size(), 0);  // floors too: no exception may cross a step
  for (const Plane& plane : constraints.planes)
    for (const Index node : plane.nodes)
      check((rows_of_node[memory.row_of_node[node]] += rows_of(plane)) <= ConstrainedNode::most_rows, "too many planes hold one node");
  memory.active.reserve(memory.nodes.size());
  for (std::size_t place = 0; place < memory.nodes.size(); ++place)
    if (memory.nodes[place].count > 0) memory.active.push_back(static_cast<Index>(place));
  memory.impacting.reserve(memory.nodes.size() * constraints.planes.size());
  return memory;
}

void restrain(const Constraints&, const ConstrainedNode& held, const Vec3& x, double mass, Vec3& v,
              std::vector<PlaneAccount>& accounts) {
  if (held.count == 0) return;
  const Vec3 wanted = v;
  v = held.allowed * wanted;
  const Vec3 impulse = mass * (v - wanted);
  for (int p = 0; p < held.count; ++p) {
    const Vec3 share = held.reaction[p].dot(impulse) * held.normal[p];
    accounts[held.plane[p]].impulse += share;
    accounts[held.plane[p]].angular_impulse += x.cross(share);
  }
}

void set_speeds(const Constraints& constraints, const Vectors& X, double t, Memory& memory) {
  for (std::size_t p = 0; p < constraints.planes.size(); ++p)
    if (constraints.planes[p].velocity) memory.speed[p] = constraints.planes[p].velocity(t);
  for (const Index place : memory.active) {
    ConstrainedNode& held = memory.nodes[place];
    if (!held.moves) continue;
    for (int p = 0, row = 0; p < held.count; ++p) {
      const Plane& plane = constraints.planes[held.plane[p]];
      const bool driven = plane.kind == PlaneKind::driven;
      held.speed[p] = driven ? at(plane.field[row++ % 3], X.col(held.node), t) : memory.speed[held.plane[p]];
    }
    if (held.driver < 0 || held.rotation < 0) continue;
    for (int axis = 0; axis < 3; ++axis) held.angular_velocity(axis) = at(constraints.planes[held.driver].angular_velocity[axis], X.col(held.node), t);
  }
}

void drive(const Constraints& constraints, const ConstrainedNode& held, const Vec3& x, double mass, const Vec3& before, const Vec3& force,
           double quarter_step, Vec3& v, std::vector<PlaneAccount>& accounts) {
  const Vec3 wanted = v;
  v = held.allowed * wanted;
  for (int p = 0; p < held.count; ++p) v += held.speed[p] * held.reaction[p];
  const Vec3 impulse = mass * (v - wanted), change = v - before, twice_mean = v + before;
  for (int p = 0; p < held.count; ++p) {
    const Vec3& normal = held.normal[p];
    const Vec3 share = held.reaction[p].dot(impulse) * normal;
    PlaneAccount& account = accounts[held.plane[p]];
    account.impulse += share;
    account.angular_impulse += x.cross(share);
    const double work = 0.5 * share.dot(twice_mean) + quarter_step * held.reaction[p].dot(force) * normal.dot(change);
    if (moves(constraints.planes[held.plane[p]])) {
      account.driven += work;
    } else {
      account.stopped -= work;  // of a plane at rest: only at the start
    }
  }
}

void restrain_rotation(const ConstrainedNode& held, double inertia, Vec3& omega, std::vector<PlaneAccount>& accounts) {
  if (held.count == 0) return;
  const Vec3 wanted = omega;
  omega = held.allowed_rotation * wanted;
  accounts[held.plane[0]].angular_impulse += inertia * (omega - wanted);
}

void drive_rotation(const ConstrainedNode& held, double inertia, const Vec3& before, const Vec3& moment, double quarter_step, Vec3& omega,
                std::vector<PlaneAccount>& accounts) {
  const Vec3 impulse = inertia * (held.angular_velocity - omega);
  omega = held.angular_velocity;
  PlaneAccount& account = accounts[held.driver];
  account.angular_impulse += impulse;
  account.driven += 0.5 * impulse.dot(omega + before) + quarter_step * moment.dot(omega - before);
}

void constrain(const Constraints& constraints, const Kick& kick, const Vectors& x, Vectors& v, Vectors& omega, Memory& memory) {
  for (const Index place : memory.active) {
    const ConstrainedNode& held = memory.nodes[place];
    const double mass = kick.mass(held.node);
    Vec3 velocity = v.col(held.node);
    if (held.moves) {
      const Vec3 force = kick.force.col(held.node), before = velocity - kick.dt / mass * force;
      drive(constraints, held, x.col(held.node), mass, before, force, kick.quarter_step, velocity, memory.account);
    } else {
      restrain(constraints, held, x.col(held.node), mass, velocity, memory.account);
    }
    v.col(held.node) = velocity;
    if (held.rotation < 0) continue;
    Vec3 spin = omega.col(held.rotation);
    const double inertia = kick.inertia(held.rotation);
    if (held.driver >= 0) {
      const Vec3 moment = kick.moment.col(held.rotation), before = spin - kick.dt / inertia * moment;
      drive_rotation(held, inertia, before, moment, kick.quarter_step, spin, memory.account);
    } else {
      restrain_rotation(held, inertia, spin, memory.account);
    }
    omega.col(held.rotation) = spin;
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
      // the plane must add a direction to what all others of this node hold
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
