#include "contact/data/friction.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace nereid::contact {

namespace {

/// Forces on the base nodes that make a moment [N m] and no net force: per_inertia . moment x offset. [N]
Vec3 couple(const Touch& touch, const Vec3& moment, int I) { return (touch.per_inertia * moment).cross(touch.offset[I]); }

}  // namespace

void measure_base(std::span<const Vec3> place, std::span<const double> share, Touch& touch) {
  Vec3 centre = Vec3::Zero();
  double sum = 0;
  for (std::size_t I = 0; I < place.size(); ++I) centre += share[I] * place[I], sum += share[I];
  centre /= sum;
  Mat3 inertia = Mat3::Zero();
  touch.offset.fill(Vec3::Zero());
  for (std::size_t I = 0; I < place.size(); ++I) {
    const Vec3 r = place[I] - centre;
    touch.offset[I] = share[I] * r;
    inertia += share[I] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  touch.per_inertia = inertia.inverse();
}

Vec3 spin_of_base(const Touch& touch, const Vectors& v) {
  Vec3 sum = Vec3::Zero();
  for (int I = 0; I < touch.nodes; ++I) sum += touch.offset[I].cross(v.col(touch.node[I]));
  return touch.per_inertia * sum;
}

Vec3 slip_rate(const Touch& touch, const Vectors& v, const Vectors& omega, const std::vector<Index>& rotation_of_node) {
  Vec3 rate = Vec3::Zero();
  if (touch.apex >= 0) rate = v.col(touch.apex);
  if (!touch.apex_arm.isZero(0)) rate -= Vec3(omega.col(rotation_of_node[touch.apex])).cross(touch.apex_arm);
  Vec3 spin = Vec3::Zero();
  if (!touch.base_rotates && !touch.base_arm.isZero(0)) spin = spin_of_base(touch, v);
  for (int I = 0; I < touch.nodes; ++I) {
    rate -= touch.weight[I] * v.col(touch.node[I]);
    if (touch.apex < 0) rate += touch.normal.dot(v.col(touch.node[I])) * touch.lift[I];
    if (touch.base_rotates && touch.weight[I] != 0) spin += touch.weight[I] * omega.col(rotation_of_node[touch.node[I]]);
  }
  rate -= spin.cross(touch.base_arm);
  return rate - touch.normal.dot(rate) * touch.normal;
}

FrictionShares share_friction(const Touch& touch, const Vec3& friction) {
  FrictionShares shares;
  const int first = touch.apex >= 0 ? 1 : 0;
  shares.count = touch.nodes + first;
  shares.node[0] = touch.apex, shares.force[0] = friction, shares.turns = {};
  if (!touch.apex_arm.isZero(0)) shares.turns[0] = true, shares.moment[0] = -touch.apex_arm.cross(friction);
  const Vec3 on_base = -touch.base_arm.cross(friction);
  const bool turns_facet = !touch.base_rotates && !touch.base_arm.isZero(0);
  for (int I = 0; I < touch.nodes; ++I) {
    const int at = I + first;
    shares.node[at] = touch.node[I];
    shares.force[at] = -touch.weight[I] * friction;
    if (turns_facet) shares.force[at] += couple(touch, on_base, I);
    if (touch.apex < 0) shares.force[at] += touch.lift[I].dot(friction) * touch.normal;
    if (touch.base_rotates && touch.weight[I] != 0) shares.turns[at] = true, shares.moment[at] = touch.weight[I] * on_base;
  }
  return shares;
}

void add_friction(const Touch& touch, const Vec3& friction, const std::vector<Index>& rotation_of_node, Vectors& force, Vectors& moment) {
  const FrictionShares shares = share_friction(touch, friction);
  for (int i = 0; i < shares.count; ++i) {
    force.col(shares.node[i]) += shares.force[i];
    if (shares.turns[i]) moment.col(rotation_of_node[shares.node[i]]) += shares.moment[i];
  }
}

Vec3 moment_of_friction(const Touch& touch, const Vec3& friction, const Vectors& x, const Vectors& v, double later) {
  const auto at = [&](Index node) { return Vec3(x.col(node) + later * v.col(node)); };
  const Vec3 on_base = -touch.base_arm.cross(friction);
  Vec3 sum = at(touch.apex).cross(friction) - touch.apex_arm.cross(friction);
  const bool turns_facet = !touch.base_rotates && !touch.base_arm.isZero(0);
  for (int I = 0; I < touch.nodes; ++I) {
    sum -= touch.weight[I] * at(touch.node[I]).cross(friction);
    if (turns_facet) sum += at(touch.node[I]).cross(couple(touch, on_base, I));
  }
  return touch.base_rotates ? Vec3(sum + on_base) : sum;
}

Vec3 carried(const Vec3& vector, const Vec3& rotation, const Vec3& normal) {
  const double length = vector.norm();
  if (length == 0) return vector;
  // Cayley's transform, as for the stress of an element
  const Vec3 half = rotation / 2, turned = vector + 2 / (1 + half.squaredNorm()) * (half.cross(vector) + half.cross(half.cross(vector)));
  const Vec3 flat = turned - normal.dot(turned) * normal;
  const double left = flat.norm();
  return left > 1e-9 * length ? Vec3(length / left * flat) : Vec3(Vec3::Zero());  // turned out of the plane: nothing to carry
}

}  // namespace nereid::contact
