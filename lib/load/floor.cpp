#include "load/floor.hpp"

#include <Eigen/Geometry>

namespace nereid::load {

namespace {

enum Caught : char { free = 0, caught = 1, landing = 2 };  // of a node and a floor, in Memory::caught

/// Changes the velocity of a node along the normal of a floor and books it to the floor.
///
/// to  [m/s] velocity along the normal that the node shall have
/// returns  the change [m/s]; zero if other planes constrain the node in that direction already
Vec3 strike(const Plane& floor, const HeldNode& held, double to, const Vec3& x, double mass, Vectors& v, PlaneAccount& account) {
  const Vec3 way = held.allowed * floor.normal;  // other planes may constrain the node already
  const double along = way.dot(floor.normal);
  if (!(along > 1e-12)) return Vec3::Zero();
  const Vec3 change = (to - v.col(held.node).dot(floor.normal)) / along * way;
  const Vec3 impulse = mass * change;
  account.impulse += impulse;
  account.angular_impulse += x.cross(impulse);
  account.caught -= impulse.dot(v.col(held.node) + 0.5 * change);
  v.col(held.node) += change;
  return change;
}

}  // namespace

void find_landings(const Constraints& constraints, const Scalars& mass, const Vectors& x, const Vectors& force, double dt, Vectors& v,
                   Memory& memory) {
  memory.landing.clear();
  for (std::size_t p = 0; p < constraints.planes.size(); ++p) {
    const Plane& floor = constraints.planes[p];
    if (floor.kind != PlaneKind::floor) continue;
    for (std::size_t i = 0; i < floor.nodes.size(); ++i) {
      if (memory.caught[p][i] != free) continue;
      const Index node = floor.nodes[i];
      const double height = (x.col(node) - floor.point).dot(floor.normal);
      const double speed = v.col(node).dot(floor.normal);
      if (height + dt * speed > 0 || (height == 0 && speed > 0)) continue;
      const Index place = memory.held_of_node[node];
      const double landing_speed = dt > 0 ? -height / dt : 0;
      const Vec3 change = strike(floor, memory.held[place], landing_speed, x.col(node), mass(node), v, memory.account[p]);
      // the other sources post half of this step's work with the changed velocity
      memory.account[p].caught += 0.5 * dt * force.col(node).dot(change);
      memory.caught[p][i] = landing;
      memory.landing.push_back(place);
    }
  }
}

void put_on_floors(const Constraints& constraints, const Memory& memory, Vectors& x) {
  if (memory.landing.empty()) return;
  for (std::size_t p = 0; p < constraints.planes.size(); ++p) {
    const Plane& floor = constraints.planes[p];
    for (std::size_t i = 0; i < memory.caught[p].size(); ++i) {
      if (memory.caught[p][i] != landing) continue;
      const Index node = floor.nodes[i];
      const Vec3 way = memory.held[memory.held_of_node[node]].allowed * floor.normal;
      const double along = way.dot(floor.normal), height = (x.col(node) - floor.point).dot(floor.normal);
      if (along > 1e-12) x.col(node) -= height / along * way;
    }
  }
}

void finish_landings(const Constraints& constraints, const Scalars& mass, const Vectors& x, const Vectors& force, double dt, Vectors& v,
                     Memory& memory) {
  if (memory.landing.empty()) return;
  for (std::size_t p = 0; p < constraints.planes.size(); ++p) {
    const Plane& floor = constraints.planes[p];
    for (std::size_t i = 0; i < memory.caught[p].size(); ++i) {
      if (memory.caught[p][i] != landing) continue;
      const Index node = floor.nodes[i];
      HeldNode& held = memory.held[memory.held_of_node[node]];
      const Vec3 change = strike(floor, held, 0, x.col(node), mass(node), v, memory.account[p]);
      memory.account[p].caught -= 0.5 * dt * force.col(node).dot(change);
      if (held.count == 0) memory.active.push_back(memory.held_of_node[node]);
      hold(constraints, held, static_cast<int>(p));
      memory.caught[p][i] = caught;
    }
  }
}

}  // namespace nereid::load
