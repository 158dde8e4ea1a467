#include "load/constraints.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>

#include "base/check.hpp"

namespace nereid::load {

void hold(const Constraints& constraints, HeldNode& held, int plane) {
  check(held.count < HeldNode::most_planes, "a node lies on more than four planes");
  held.plane[held.count++] = plane;
  constexpr double same_plane = 1e-6;  // [rad]: normals typed with eight digits agree to less
  Eigen::Matrix<double, 3, HeldNode::most_planes> normals = Eigen::Matrix<double, 3, HeldNode::most_planes>::Zero();
  Mat3 turn = Mat3::Identity(), free = Mat3::Identity();
  for (int p = 0; p < held.count; ++p) {
    const Plane& here = constraints.planes[held.plane[p]];
    // a plane that allows what those before it allow anyway takes no part and no reaction
    const Vec3 rest = free * here.normal;
    if (rest.norm() > same_plane) {
      normals.col(p) = here.normal;
      free -= rest.normalized() * rest.normalized().transpose();
    }
    if (here.kind != PlaneKind::symmetry) continue;
    // a turn about the normal is its own mirror image; two different normals leave none
    const Mat3 about = here.normal * here.normal.transpose();
    turn = about * turn;
    if (turn.norm() < 1 - 1e-9) turn.setZero();
  }
  held.allowed_turn = turn;
  // A reaction R = sum of c_p n_p has c = pseudo-inverse of the normals times R
  const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, 3, HeldNode::most_planes>> decomposition(normals);
  const Eigen::Matrix<double, HeldNode::most_planes, 3> inverse = decomposition.pseudoInverse();
  held.allowed = Mat3::Identity() - normals * inverse;
  for (int p = 0; p < held.count; ++p) held.share[p] = inverse.row(p).transpose();
  // along an axis the projector is exact, so that a held node stays on its plane to the last bit
  for (int i = 0; i < 9; ++i) {
    double& entry = held.allowed.data()[i];
    if (std::abs(entry) < 1e-14) entry = 0;
    if (std::abs(entry - 1) < 1e-14) entry = 1;
  }
}

Memory prepare(const Constraints& constraints, Index nodes, const std::vector<Index>& turn_of_node) {
  Memory memory;
  memory.held_of_node.assign(nodes, -1);
  memory.account.resize(constraints.planes.size());
  Subset all;
  for (const Plane& plane : constraints.planes) all.insert(all.end(), plane.nodes.begin(), plane.nodes.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (const Index node : all) {
    memory.held_of_node[node] = static_cast<Index>(memory.held.size());
    HeldNode held;
    held.node = node;
    held.turn = turn_of_node[node];
    memory.held.push_back(held);
  }
  for (std::size_t p = 0; p < constraints.planes.size(); ++p) {
    const Plane& plane = constraints.planes[p];
    const bool is_floor = plane.kind == PlaneKind::floor;
    memory.caught.emplace_back(is_floor ? plane.nodes.size() : 0, 0);
    if (is_floor) continue;
    for (const Index node : plane.nodes) hold(constraints, memory.held[memory.held_of_node[node]], static_cast<int>(p));
  }
  std::vector<int> planes_of(memory.held.size(), 0);  // floors too: no exception may cross a step
  for (const Plane& plane : constraints.planes)
    for (const Index node : plane.nodes)
      check(++planes_of[memory.held_of_node[node]] <= HeldNode::most_planes, "a node lies on more than four planes");
  memory.active.reserve(memory.held.size());
  for (std::size_t place = 0; place < memory.held.size(); ++place)
    if (memory.held[place].count > 0) memory.active.push_back(static_cast<Index>(place));
  memory.landing.reserve(memory.held.size() * constraints.planes.size());
  return memory;
}

void restrain(const Constraints& constraints, const HeldNode& held, const Vec3& x, double mass, Vec3& v,
              std::vector<PlaneAccount>& accounts) {
  if (held.count == 0) return;
  const Vec3 wanted = v;
  v = held.allowed * wanted;
  const Vec3 impulse = mass * (v - wanted);
  for (int p = 0; p < held.count; ++p) {
    const Vec3 share = held.share[p].dot(impulse) * constraints.planes[held.plane[p]].normal;
    accounts[held.plane[p]].impulse += share;
    accounts[held.plane[p]].angular_impulse += x.cross(share);
  }
}

void restrain_turn(const HeldNode& held, double inertia, Vec3& w, std::vector<PlaneAccount>& accounts) {
  if (held.count == 0) return;
  const Vec3 wanted = w;
  w = held.allowed_turn * wanted;
  accounts[held.plane[0]].angular_impulse += inertia * (w - wanted);
}

}  // namespace nereid::load
