#include "dynamics/displace.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "base/check.hpp"

namespace nereid::dynamics {

namespace {

/// [s] of the whole path: so slow that viscosity has no part in it, whatever the material.
constexpr double duration = 1e9;

/// Half the curl of a field with gradient L.
Vec3 half_curl(const Mat3& L) { return 0.5 * Vec3(L(2, 1) - L(1, 2), L(0, 2) - L(2, 0), L(1, 0) - L(0, 1)); }

/// Normals of the plates at their nodes in the reference, weighted by area. [3 x plate nodes]
Vectors normals(const Model& model) {
  Vectors normal = Vectors::Zero(3, model.inertia.size());
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const auto& block = model.blocks[b];
    if (!element::rotates(block) || is_rigid_block(model, b)) continue;
    const element::Connectivity& nodes = element::nodes(block);
    for (Eigen::Index e = 0; e < nodes.cols(); ++e) {
      const Vec3 first = model.mesh.X.col(nodes(0, e));
      const Vec3 to_second = model.mesh.X.col(nodes(1, e)) - first, to_third = model.mesh.X.col(nodes(2, e)) - first;
      for (int a = 0; a < 3; ++a) normal.col(model.rotation_of_node[nodes(a, e)]) += to_second.cross(to_third);
    }
  }
  return normal;
}

}  // namespace

element::BlockLimit displace(const Model& model, State& now, const Vectors& u, const std::vector<Mat3>& gradient, int steps) {
  check(u.cols() == now.x.cols() && static_cast<Eigen::Index>(gradient.size()) == now.omega.cols() && steps > 0,
        "a displacement for every node and a gradient for every plate node");
  const Vectors du = u / steps, normal = normals(model);
  Vectors rotations = Vectors::Zero(3, now.omega.cols());
  element::BlockLimit smallest;
  const auto deformation = [&](Index rotation, double step) { return Mat3(Mat3::Identity() + step / steps * gradient[rotation]); };
  const auto material_normal = [&](Index rotation, double step) {
    return Vec3((deformation(rotation, step).inverse().transpose() * normal.col(rotation)).normalized());
  };
  std::vector<element::TileReports> reports;
  for (const auto& block : model.blocks) reports.push_back(element::tile_reports(block));
  for (int s = 0; s < steps; ++s) {
    for (Index rotation = 0; rotation < now.omega.cols(); ++rotation) {
      const Vec3 before = material_normal(rotation, s), after = material_normal(rotation, s + 1);
      const Vec3 between = material_normal(rotation, s + 0.5);
      const Mat3 L = gradient[rotation] / steps * deformation(rotation, s + 0.5).inverse();
      // Cayley's vector of the normal's rotation; about the normal, which differs from that of the facets, the material's
      rotations.col(rotation) = 2 / (1 + before.dot(after)) * before.cross(after) + half_curl(L).dot(between) * between;
      const Index place = now.constraints.row_of_node[model.node_of_rotation[rotation]];
      // driven nodes go from where the displacement puts them
      if (place >= 0 && now.constraints.nodes[place].driver < 0)
        rotations.col(rotation) = now.constraints.nodes[place].allowed_rotation * rotations.col(rotation);
    }
    now.x = model.mesh.X + (static_cast<double>(s + 1) / steps) * u;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
      if (is_rigid_block(model, b)) continue;
      const element::BlockLimit limit =
          element::advance(model.blocks[b], now.x, du, rotations, duration / steps, now.blocks[b], now.tiles[b], reports[b]);
      if (limit.volume_ratio < smallest.volume_ratio || std::isnan(limit.volume_ratio)) smallest = limit;
    }
  }
  for (element::Memory& block : now.blocks) block.work = 0, block.dissipated = {}, block.angular_impulse.setZero();
  return smallest;
}

Vectors angular_velocities_of(const Model& model, const std::vector<Mat3>& gradient) {
  check(gradient.size() == model.node_of_rotation.size(), "a gradient for every plate node");
  const Vectors normal = normals(model);
  Vectors omega = Vectors::Zero(3, model.inertia.size());
  for (Eigen::Index rotation = 0; rotation < omega.cols(); ++rotation) {
    const Vec3 n = normal.col(rotation).normalized();
    const Mat3& L = gradient[static_cast<std::size_t>(rotation)];
    omega.col(rotation) = half_curl(L).dot(n) * n - n.cross(L.transpose() * n);
  }
  return omega;
}

}  // namespace nereid::dynamics
