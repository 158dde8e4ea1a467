#include "contact/tracking/thickness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nereid::contact {

void follow_thickness(const Interface& interface, const Scalars& half_growth, Memory& memory) {
  constexpr double worth_following = 1e-5;  // of h_c
  if (!interface.follows_thickness) return;
  memory.thicker.resize(interface.apexes.size(), 0);
  for (std::size_t i = 0; i < interface.apexes.size(); ++i) {
    const auto a = static_cast<Index>(i);
    Near* near = memory.slot[a] < 0 ? nullptr : &memory.near[memory.slot[a]];
    const Index facet = near && near->tracks.count > 0 ? near->tracks.track[0].facet : memory.feature[a].facet;
    double wanted = half_growth(interface.apexes[a]);
    if (facet >= 0)
      for (int I = 0; I < 3; ++I) wanted += half_growth(interface.base.facets(I, facet)) / 3;
    double change = wanted - memory.thicker[a];
    if (near && near->tracks.count == 0 && change > 0) change = std::min(change, std::max(0.0, 0.5 * memory.gap[a]));
    if (!(std::abs(change) > worth_following * interface.contact_height(a))) continue;
    memory.thicker[a] += change;
    if (!near) continue;
    near->no_condition_until -= std::max(0.0, change);
    near->safe_distance -= std::max(0.0, change);
    if (near->is_idle) continue;
    near->safe_distance = -std::numeric_limits<double>::infinity();
    const double height = contact_height(interface, memory, a);
    for (int t = 0; t < near->tracks.count; ++t) {
      double& level = near->tracks.track[t].height;
      const double most = height + stand_off(interface.base, near->tracks.track[t].facet);
      if (!(level > most)) continue;
      if (near->element.closed && !by_multipliers(interface)) memory.thinned += near->element.apex.norm() * (level - most);
      level = most;
    }
  }
}

}  // namespace nereid::contact
