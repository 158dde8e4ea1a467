#include "load/floor.hpp"

#include <Eigen/Geometry>

namespace nereid::load {

namespace {

enum Stop : char { free = 0, stopped = 1, impacting = 2 };  // of a node and a floor, in Memory::stopped

/// Changes the velocity of a node along the normal of a floor and books it to the floor.
///
/// to  [m/s] velocity along the normal that the node shall have
/// returns  the change [m/s]; zero if other planes constrain the node in that direction already
Vec3 change_normal_velocity(const Plane& floor, const ConstrainedNode& node, double to, const Vec3& x, double mass, Vectors& v,
                            PlaneAccount& account) {
  const Vec3 way = node.allowed * floor.normal;  // other planes may constrain the node already
  const double along = way.dot(floor.normal);
  if (!(along > 1e-12)) return Vec3::Zero();
  const Vec3 change = (to - v.col(node.node).dot(floor.normal)) / along * way;
  const Vec3 impulse = mass * change;
  account.impulse += impulse;
  account.angular_impulse += x.cross(impulse);
  account.stopped -= impulse.dot(v.col(node.node) + 0.5 * change);
  v.col(node.node) += change;
  return change;
}

/// Calls visit(plane, place among its nodes) for every node that meets a floor in this step, floor by floor.
template <class Visit>
void each_impacting(const Constraints& constraints, const Memory& memory, Visit&& visit) {
  if (memory.impacting.empty()) return;
  for (std::size_t p = 0; p < constraints.planes.size(); ++p)
    for (std::size_t i = 0; i < memory.stopped[p].size(); ++i)
      if (memory.stopped[p][i] == impacting) visit(p, i);
}

}  // namespace

void find_impacts(const Constraints& constraints, const Scalars& mass, const Vectors& x, const Vectors& force, double dt, Vectors& v,
                  Memory& memory) {
  memory.impacting.clear();
  for (std::size_t p = 0; p < constraints.planes.size(); ++p) {
    const Plane& floor = constraints.planes[p];
    if (floor.kind != PlaneKind::floor) continue;
    for (std::size_t i = 0; i < floor.nodes.size(); ++i) {
      if (memory.stopped[p][i] != free) continue;
      const Index node = floor.nodes[i];
      const double height = (x.col(node) - floor.point).dot(floor.normal);
      const double speed = v.col(node).dot(floor.normal);
      if (height + dt * speed > 0 || (height == 0 && speed > 0)) continue;
      const Index row = memory.row_of_node[node];
      const double impact_speed = dt > 0 ? -height / dt : 0;
      const Vec3 change = change_normal_velocity(floor, memory.nodes[row], impact_speed, x.col(node), mass(node), v, memory.account[p]);
      // the other sources post half of this step's work with the changed velocity
      memory.account[p].stopped += 0.5 * dt * force.col(node).dot(change);
      memory.stopped[p][i] = impacting;
      memory.impacting.push_back(row);
    }
  }
}

void put_on_floors(const Constraints& constraints, const Memory& memory, Vectors& x) {
  each_impacting(constraints, memory, [&](std::size_t p, std::size_t i) {
    const Plane& floor = constraints.planes[p];
    const Index node = floor.nodes[i];
    const Vec3 way = memory.nodes[memory.row_of_node[node]].allowed * floor.normal;
    const double along = way.dot(floor.normal), height = (x.col(node) - floor.point).dot(floor.normal);
    if (along > 1e-12) x.col(node) -= height / along * way;
  });
}

void finish_impacts(const Constraints& constraints, const Scalars& mass, const Vectors& x, const Vectors& force, double dt, Vectors& v,
                    Memory& memory) {
  each_impacting(constraints, memory, [&](std::size_t p, std::size_t i) {
    const Plane& floor = constraints.planes[p];
    const Index node = floor.nodes[i], row = memory.row_of_node[node];
    ConstrainedNode& constrained = memory.nodes[row];
    const Vec3 change = change_normal_velocity(floor, constrained, 0, x.col(node), mass(node), v, memory.account[p]);
    memory.account[p].stopped -= 0.5 * dt * force.col(node).dot(change);
    if (constrained.count == 0) memory.active.push_back(row);
    add_plane(constraints, constrained, static_cast<int>(p));
    memory.stopped[p][i] = stopped;
  });
}

}  // namespace nereid::load
