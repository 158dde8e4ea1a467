#include "dynamics/thickness.hpp"

namespace nereid::dynamics {

void update_thickness(const Model& model, const State& now, Forces& f) {
  if (f.half_growth.size() == 0) return;
  f.half_growth.setZero();
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const Scalars& thickness = now.tiles[b].thickness;
    if (thickness.size() == 0) continue;
    const double given = element::thickness(model.blocks[b]);
    const element::Connectivity& nodes = element::nodes(model.blocks[b]);
    const Scalars& mass = f.element_mass[b];
    for (Index e = 0; e < static_cast<Index>(thickness.size()); ++e) {
      const double grown = 0.5 * (thickness(e) - given) * mass(e) / 3;
      for (int a = 0; a < 3; ++a) f.half_growth(nodes(a, e)) += grown;
    }
  }
  for (Eigen::Index n = 0; n < f.half_growth.size(); ++n)
    if (f.plate_mass(n) > 0) f.half_growth(n) /= f.plate_mass(n);
}

}  // namespace nereid::dynamics
