#include "contact/report/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/multiplier/tie.hpp"
#include "contact/multiplier/shape_points.hpp"
#include "contact/search/near.hpp"
#include "contact/surface/broad_search.hpp"
#include "contact/tracking/element.hpp"

namespace nereid::contact {

double least_gap(const Interface& interface, const Vectors& x, const Memory& memory, double reach) {
  double least = std::numeric_limits<double>::quiet_NaN();
  const auto see = [&least](double gap) {
    if (!(gap >= least)) least = gap;
  };
  for (const Near& near : memory.near) {
    if (near.element.closed) see(memory.gap[near.apex]);
    else if (near.facets > 0) {
      const Nearest nearest = nearest_of(interface, x, near.apex, near_facets(memory, near));
      see(nearest.distance() - level(interface, memory, near.apex, nearest.feature.facet));
    }
  }
  if (const double of_shapes = least_gap_of_shapes(interface, x, memory); !std::isnan(of_shapes)) see(of_shapes);
  if (!memory.near.empty() || interface.bodies.count() > 0 || by_shapes_alone(interface)) return least;  // who is not near is farther away
  BroadSearch broad(static_cast<Index>(interface.base.facets.cols()));
  if (!broad.sort(interface.base, x)) return least;
  for (std::size_t a = 0; a < interface.apexes.size(); ++a) {
    const Vector<double> p = position(x, interface.apexes[a]);
    const double height = contact_height(interface, memory, static_cast<Index>(a));
    const Index facet = broad.nearest(interface.base, x, p, std::isnan(least) ? reach : least + height);
    if (facet < 0) continue;
    see(std::sqrt(geometry::closest_on_triangle(corners(interface.base, x, facet), p).distance_squared) - height);
  }
  return least;
}

ElementView view(const Interface& interface, const Vectors& x, const Memory& memory, Index apex) {
  ElementView v{.apex = interface.apexes[apex], .feature = memory.feature[apex], .weight = {0, 0, 0}, .gap = memory.gap[apex],
                .traction = 0, .shear_traction = 0, .slides = false, .status = memory.status[apex],
                .reconnections = memory.reconnections[apex]};
  const Near* near = contact::near(memory, apex);
  if (v.status == Status::open && near && near->facets > 0 && near->tracks.count == 0) {  // where it stands now, not when last looked at
    const Nearest nearest = nearest_of(interface, x, apex, near_facets(memory, *near));
    v.feature = nearest.feature;
    v.gap = nearest.distance() - level(interface, memory, apex, nearest.feature.facet);
  }
  if (v.feature.facet >= 0) {
    const auto c = corners(interface.base, x, v.feature.facet);
    v.weight = geometry::closest_on_triangle(c, position(x, v.apex)).weight;
  }
  if (v.status != Status::closed) return v;
  if (tied_by_multipliers(interface)) {
    const Vec3 force = near->element.apex, normal = normal_of(interface, *near, x);
    v.traction = force.dot(normal) / interface.area(apex);
    v.shear_traction = (force - force.dot(normal) * normal).norm() / interface.area(apex);
    return v;
  }
  if (by_multipliers(interface)) {
    v.traction = near->element.apex.norm() / interface.area(apex);
    v.shear_traction = near->friction->acts ? near->friction->force.norm() / interface.area(apex) : 0;
    v.slides = v.shear_traction >= (1 - 1e-9) * near->friction->coefficient * v.traction;
    return v;
  }
  const double per_area = between(interface, apex, v.feature.facet).penalty;
  v.traction = -per_area * v.gap;
  if (interface.kind == InterfaceKind::tied) {
    const double k = stiffness(interface, apex, v.feature, interface.area(apex)), along = k * v.gap;
    const double all = 2 * k * memory.stored[apex];  // |k d|^2
    v.shear_traction = per_area / k * std::sqrt(std::max(0.0, all - along * along));
  } else if (!memory.slip.empty()) {
    v.shear_traction = interface.friction.tangential_penalty * per_area * memory.slip[apex].norm();
    v.slides = v.shear_traction >= (1 - 1e-9) * near->friction->coefficient * v.traction;  // round-off
  }
  return v;
}

}  // namespace nereid::contact
