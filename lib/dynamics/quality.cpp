#include "dynamics/quality.hpp"

#include <algorithm>
#include <cmath>

#include "element/corners.hpp"

namespace nereid::dynamics {

namespace {

constexpr double round_off = 1e-9;  // [-] of the energy scale: what is stored below it says nothing

}  // namespace

void see_quality(const Model& model, bool look, State& now) {
  const bool looks = look || now.step - now.progress.corners_seen >= corners_every;
  if (looks) now.progress.corners_seen = now.step;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    Quality& seen = now.quality[b];
    const Account& account = now.ledger.accounts[b];  // blocks come first
    seen.hourglass = std::max(seen.hourglass, account.stored[Stored::hourglass] + account.dissipated[Dissipated::hourglass]);
    seen.internal = std::max(seen.internal, stored(account) + dissipated(account));
    if (!looks || is_rigid_block(model, b)) continue;
    if (element::thickness(model.blocks[b]) > 0 && !element::thins(model.blocks[b])) {
      const element::Thinned thinned = element::thinned(model.blocks[b], now.x, now.blocks[b]);
      if (std::abs(std::log(thinned.ratio)) > std::abs(std::log(seen.thinned.ratio))) seen.thinned = thinned, seen.thinned_at = now.t;
    }
    const element::Corner corner = element::smallest_corner(model.blocks[b], model.mesh.X, now.x);
    seen.inverted = corner.element >= 0 && !(corner.ratio > 0);
    if (corner.element < 0 || !(corner.ratio < seen.corner)) continue;
    seen.corner = corner.ratio, seen.element = corner.element, seen.time = now.t;
  }
}

double hourglass_fraction(const Quality& seen, double scale) {
  return seen.internal > round_off * scale ? seen.hourglass / seen.internal : 0;
}

}  // namespace nereid::dynamics
