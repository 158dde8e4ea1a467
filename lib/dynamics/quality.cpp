#include "dynamics/quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "element/corners.hpp"

namespace nereid::dynamics {

namespace {

constexpr double nothing = 1e-9;  // [-] of the energy scale: what is stored below it says nothing

/// Whether a block has nodes whose spin about the normal nothing resists.
bool spins_freely(const element::AnyBlock& block) { return element::rotates(block) && element::drilling(block) == 0; }

}  // namespace

Spin free_spin(const Model& model, std::size_t block, const State& now) {
  constexpr double one_plane = 0.99;  // [-] what normals add up to over the sum of their areas
  const element::Connectivity& nodes = element::nodes(model.blocks[block]);
  Vectors normal = Vectors::Zero(3, now.omega.cols());
  Scalars area = Scalars::Zero(now.omega.cols()), turning = area;
  for (Eigen::Index e = 0; e < nodes.cols(); ++e) {
    const auto x = [&](int a) -> Vec3 { return now.x.col(nodes(a, e)); };
    const Vec3 twice = (x(1) - x(0)).cross(x(2) - x(0));
    const double size = twice.norm();
    if (!(size > 0)) continue;
    double w = 0;  // [m2/s] times twice the area: the circulation of the linear velocity around the plate
    for (int a = 0; a < 3; ++a) w += 0.5 * (x((a + 1) % 3) - x((a + 2) % 3)).dot(now.v.col(nodes(a, e)));
    for (int a = 0; a < 3; ++a) {
      const Index r = model.rotation_of_node[nodes(a, e)];
      normal.col(r) += twice, area(r) += size, turning(r) += w;
    }
  }
  Spin spin{.energy = 0, .node = -1, .time = now.t};
  double fastest = 0;
  for (Eigen::Index r = 0; r < now.omega.cols(); ++r) {
    const double size = normal.col(r).norm();
    if (!(size > one_plane * area(r)) || size == 0) continue;
    const double turns = now.omega.col(r).dot(normal.col(r)) / size, w = turning(r) / area(r);
    const double squares = turns * turns - w * w;
    if (!(squares > 0)) continue;
    spin.energy += 0.5 * model.inertia(r) * squares;
    if (squares > fastest) fastest = squares, spin.node = model.node_of_rotation[r];
  }
  return spin;
}

void check_elements(const Model& model, bool look, State& now) {
  Progress& progress = now.progress;
  if (!look && now.step < progress.corners_next) return;
  double smallest = 1;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    if (is_rigid_block(model, b)) continue;
    Quality& seen = now.quality[b];
    if (element::thickness(model.blocks[b]) > 0 && !element::thins(model.blocks[b])) {
      const element::Thinned thinned = element::thinned(model.blocks[b], now.x, now.blocks[b]);
      if (std::abs(std::log(thinned.ratio)) > std::abs(std::log(seen.thinned.ratio))) seen.thinned = thinned, seen.thinned_at = now.t;
    }
    const element::Pressed pressed = element::pressed(model.blocks[b], now.blocks[b]);
    if (pressed.ratio > seen.pressed.ratio) seen.pressed = pressed, seen.pressed_at = now.t;
    if (spins_freely(model.blocks[b])) {
      const Spin spin = free_spin(model, b, now);
      if (spin.energy > seen.spin.energy) seen.spin = spin;
    }
    const element::Corner corner = element::smallest_corner(model.blocks[b], model.mesh.X, now.x);
    seen.inverted = corner.element >= 0 && !(corner.ratio > 0);
    if (corner.element < 0) continue;
    smallest = std::min(smallest, corner.ratio);
    if (corner.ratio < seen.corner) seen.corner = corner.ratio, seen.element = corner.element, seen.time = now.t;
  }
  const double fell = progress.corner - smallest, passed = static_cast<double>(now.step - progress.corners_seen);
  const double left = fell > 0 ? 0.5 * smallest / fell * passed : static_cast<double>(corners_every);
  progress.corners_next = now.step + std::clamp(static_cast<std::int64_t>(std::clamp(left, 0.0, 1e9)), corners_least, corners_every);
  progress.corners_seen = now.step, progress.corner = smallest;
}

int inverted_block(const State& now, double limit) {
  for (std::size_t b = 0; b < now.quality.size(); ++b)
    if (now.quality[b].element >= 0 && now.quality[b].corner <= limit) return static_cast<int>(b);
  return -1;
}

void compare_elements(const Model& model, double end, bool look, State& now) {
  Progress& progress = now.progress;
  const double begin = progress.stages.empty() ? 0 : progress.stages.back();
  const bool is_time = now.t >= progress.contrast_seen + (end - begin) / least_contrast_looks ||
                       now.step >= progress.contrast_step + contrast_every;
  if (!look && !is_time) return;
  if (now.step == progress.contrast_step) return;  // it has looked
  for (std::size_t b = 0; b < model.blocks.size(); ++b)
    if (!is_rigid_block(model, b)) add(element::contrast(model.blocks[b], now.x, now.blocks[b]), now.quality[b].contrast);
  progress.contrast_seen = now.t, progress.contrast_step = now.step, ++progress.contrast_looks;
}

element::Contrast contrast(const State& now) {
  constexpr double worth_comparing = 1e-4;  // [-] of the energy of the scene
  element::Contrast sum;
  for (const Quality& seen : now.quality) add(seen.contrast, sum);
  const double looks = std::max(1.0, static_cast<double>(now.progress.contrast_looks));
  const double mean = sum.strain / looks, scene = energy_of_scene(now.ledger);
  if (!(mean > worth_comparing * scene)) return {};
  return {.strain = mean / scene, .bending = sum.bending / sum.strain, .density = sum.density / sum.strain};
}

double dissipated_share(const Ledger& ledger, Dissipated channel) {
  double sum = 0;
  for (const Account& account : ledger.accounts) sum += account.dissipated[channel];
  const double scene = energy_of_scene(ledger);
  return scene > 0 ? sum / scene : 0;
}

void check_artificial_energy(const Model& model, State& now) {
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    Quality& seen = now.quality[b];
    const Account& account = now.ledger.accounts[b];  // blocks come first
    const auto held = [&](Stored channel) { return account.stored[channel] + account.at_start[channel]; };
    const double hourglass = held(Stored::hourglass) + account.dissipated[Dissipated::hourglass];
    const double drilling = held(Stored::drilling), residual = held(Stored::residual_bending), distortion = held(Stored::distortion);
    seen.hourglass = std::max(seen.hourglass, hourglass);
    seen.distortion = std::max(seen.distortion, distortion);
    seen.drilling = std::max(seen.drilling, drilling), seen.residual_bending = std::max(seen.residual_bending, residual);
    seen.artificial = std::max(seen.artificial, hourglass + distortion + drilling + residual);
    seen.internal = std::max(seen.internal, stored(account) + initial_stored(account) + dissipated(account));
  }
}

double of_internal(const Quality& seen, double energy, double scale) {
  return seen.internal > nothing * scale ? energy / seen.internal : 0;
}

}  // namespace nereid::dynamics
