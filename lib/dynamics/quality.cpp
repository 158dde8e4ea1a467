#include "dynamics/quality.hpp"

#include <algorithm>
#include <cmath>

#include "element/corners.hpp"

namespace nereid::dynamics {

namespace {

constexpr double round_off = 1e-9;  // [-] of the energy scale: what is stored below it says nothing

}  // namespace

void see_corners(const Model& model, bool look, State& now) {
  Progress& progress = now.progress;
  if (!look && now.step < progress.corners_next) return;
  double smallest = 1;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    if (is_rigid_block(model, b)) continue;
    Quality& seen = now.quality[b];
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

void see_hourglass_energy(const Model& model, State& now) {
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    Quality& seen = now.quality[b];
    const Account& account = now.ledger.accounts[b];  // blocks come first
    seen.hourglass = std::max(seen.hourglass, account.stored[Stored::hourglass] + account.dissipated[Dissipated::hourglass]);
    seen.internal = std::max(seen.internal, stored(account) + dissipated(account));
  }
}

double hourglass_fraction(const Quality& seen, double scale) {
  return seen.internal > round_off * scale ? seen.hourglass / seen.internal : 0;
}

}  // namespace nereid::dynamics
