#include "contact/rigid_plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace nereid::contact {

PlaneMemory initial_memory(const RigidPlane& plane) {
  PlaneMemory memory;
  memory.force.assign(plane.nodes.size(), 0.0);
  return memory;
}

void advance(const RigidPlane& plane, const Vectors& x, const Vectors& v, double dt, PlaneMemory& memory) {
  memory.stored = 0;
  for (std::size_t i = 0; i < plane.nodes.size(); ++i) {
    const Vec3 at = x.col(plane.nodes[i]), moved = dt * v.col(plane.nodes[i]);
    const double gap = std::min(0.0, (at - plane.point).dot(plane.normal));
    const double k = plane.penalty * plane.area(static_cast<Eigen::Index>(i));
    const double before = memory.force[i], after = -k * gap;
    memory.force[i] = after;
    memory.stored += 0.5 * k * gap * gap;
    if (before == 0 && after == 0) continue;
    memory.work += 0.5 * (before + after) * moved.dot(plane.normal);
    memory.impulse += 0.5 * dt * (before + after) * plane.normal;
    memory.angular_impulse += 0.5 * dt * (before * (at - moved) + after * at).cross(plane.normal);
  }
}

void add_forces(const RigidPlane& plane, const PlaneMemory& memory, Vectors& force) {
  for (std::size_t i = 0; i < plane.nodes.size(); ++i) force.col(plane.nodes[i]) += memory.force[i] * plane.normal;
}

double stable_step(const RigidPlane& plane, const Scalars& mass) {
  double most = 0;
  for (std::size_t i = 0; i < plane.nodes.size(); ++i)
    most = std::max(most, plane.penalty * plane.area(static_cast<Eigen::Index>(i)) / mass(plane.nodes[i]));
  return most > 0 ? plane.bounce_step / std::sqrt(most) : 1e300;
}

}  // namespace nereid::contact
