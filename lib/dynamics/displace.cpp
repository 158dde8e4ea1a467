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
  for (const auto& block : model.blocks) {
    if (!element::rotates(block)) continue;
    const element::Connectivity& nodes = element::nodes(block);
    for (Eigen::Index e = 0; e < nodes.cols(); ++e) {
      const Vec3 first = model.mesh.X.col(nodes(0, e));
      const Vec3 to_second = model.mesh.X.col(nodes(1, e)) - first, to_third = model.mesh.X.col(nodes(2, e)) - first;
      for (int a = 0; a < 3; ++a) normal.col(model.turn_of_node[nodes(a, e)]) += to_second.cross(to_third);
    }
  }
  return normal;
}

}  // namespace

element::Vote displace(const Model& model, State& now, const Vectors& u, const std::vector<Mat3>& gradient, int steps) {
  check(u.cols() == now.x.cols() && static_cast<Eigen::Index>(gradient.size()) == now.w.cols() && steps > 0,
        "a displacement for every node and a gradient for every plate node");
  const Vectors du = u / steps, normal = normals(model);
  Vectors turns = Vectors::Zero(3, now.w.cols());
  element::Vote smallest;
  const auto deformation = [&](Index turn, double step) { return Mat3(Mat3::Identity() + step / steps * gradient[turn]); };
  const auto material_normal = [&](Index turn, double step) {
    return Vec3((deformation(turn, step).inverse().transpose() * normal.col(turn)).normalized());
  };
  for (int s = 0; s < steps; ++s) {
    for (Index turn = 0; turn < now.w.cols(); ++turn) {
      const Vec3 before = material_normal(turn, s), after = material_normal(turn, s + 1);
      const Vec3 between = material_normal(turn, s + 0.5);
      const Mat3 L = gradient[turn] / steps * deformation(turn, s + 0.5).inverse();
      // Cayley's vector of the normal's turn; about the normal, which differs from that of the facets, the material's
      turns.col(turn) = 2 / (1 + before.dot(after)) * before.cross(after) + half_curl(L).dot(between) * between;
      const Index place = now.constraints.held_of_node[model.node_of_turn[turn]];
      // driven nodes go from where the displacement puts them
      if (place >= 0 && now.constraints.held[place].driver < 0) turns.col(turn) = now.constraints.held[place].allowed_turn * turns.col(turn);
    }
    now.x = model.mesh.X + (static_cast<double>(s + 1) / steps) * u;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
      const element::Vote vote = element::advance(model.blocks[b], now.x, du, turns, duration / steps, now.blocks[b], now.tiles[b]);
      if (vote.size < smallest.size || std::isnan(vote.size)) smallest = vote;
    }
  }
  for (element::Memory& block : now.blocks) block.work = 0, block.dissipated = {};
  return smallest;
}

Vectors turns_of(const Model& model, const std::vector<Mat3>& gradient) {
  check(gradient.size() == model.node_of_turn.size(), "a gradient for every plate node");
  const Vectors normal = normals(model);
  Vectors w = Vectors::Zero(3, model.inertia.size());
  for (Eigen::Index turn = 0; turn < w.cols(); ++turn) {
    const Vec3 n = normal.col(turn).normalized();
    const Mat3& L = gradient[static_cast<std::size_t>(turn)];
    w.col(turn) = half_curl(L).dot(n) * n - n.cross(L.transpose() * n);
  }
  return w;
}

}  // namespace nereid::dynamics
