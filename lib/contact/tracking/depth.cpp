#include "contact/tracking/depth.hpp"

#include <algorithm>
#include <cmath>

#include "contact/search/near.hpp"
#include "contact/surface/stand.hpp"

namespace nereid::contact {

namespace {

constexpr double depth_to_check = 0.25;  // of the depth of an element: half of what is warned of
constexpr double faces_back = -0.5;      // cosine between normals of a body: facets that are turned so far are at its far side

/// Whether an apex is behind the surface that presses it, of which a feature is nearest: of a solid, or of one side of a sheet. Of a sheet
/// with both sides the nearest facet has the apex in front.
bool is_behind(const Interface& interface, const Vectors& x, Index apex, const Feature& nearest, const ElementForces& element) {
  const BaseSurface& base = interface.base;
  const Vec3 p = x.col(apex);
  if (is_sheet(base, nearest.facet)) return false;
  const bool at_border = nearest.kind != geometry::Kind::facet && ends_at(base, nearest);
  if (at_border && stand_whole(base, x, p, nearest.facet, apex).past > 0) return false;
  if (height_over(base, x, nearest, p).height < 0) return true;
  const Vec3 normal = facet_normal(base, x, nearest.facet);  // or it has gone out at the far side of a thin body
  return any_of(element.stencil, element.count, [&](const Stencil& one) {
    const FeatureHeight over = height_over(base, x, {one.facet, geometry::Kind::facet, 0}, p);
    return one.apex != 0 && over.height < 0 && over.normal.dot(normal) < faces_back;
  });
}

}  // namespace

double overlap_of(const Interface& interface, const Vectors& x, const Near& near, const Memory& memory) {
  double most = -infinite;
  const auto body_of = [&](int s) {
    return interface.bodies.count() > 0 ? interface.bodies.of_facet[near.element.stencil[s].facet] : -1;
  };
  for (int s = 0; s < near.element.count; ++s) {
    if (near.element.stencil[s].apex == 0 || (s > 0 && body_of(s) == body_of(s - 1))) continue;
    const Nearest nearest = nearest_of(interface, x, near.apex, near_facets(memory, near), body_of(s));
    if (nearest.feature.facet < 0) return near.element.depth;
    const bool behind = is_behind(interface, x, interface.apexes[near.apex], nearest.feature, near.element);
    const double distance = nearest.distance();
    most = std::max(most, level(interface, memory, near.apex, nearest.feature.facet) + (behind ? distance : -distance));
  }
  return most;
}

void update_deepest(const Interface& interface, const Vectors& x, const Near& near, Memory& memory) {
  double depth = near.element.depth;
  const Index on = memory.feature[near.apex].facet;
  const double of_element = on < 0 ? interface.depth : between(interface, near.apex, on).depth;
  if (depth > depth_to_check * of_element) depth = std::min(depth, overlap_of(interface, x, near, memory));
  if (depth > memory.deepest) memory.deepest = depth, memory.deepest_apex = interface.apexes[near.apex], memory.deepest_in = of_element;
}

}  // namespace nereid::contact
