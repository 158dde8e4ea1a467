#include "contact/search/shapes.hpp"

#include <algorithm>
#include <cmath>

namespace nereid::contact {

using geometry::PlacedRound;
using geometry::Round;

void search_shapes(const Interface& interface, const Vectors& x, Memory& memory) {
  memory.near_shapes.clear();
  if (interface.shapes.pairs.empty()) return;
  const std::vector<PlacedRound> placed = placed_all(interface.shapes.rounds, x);
  for (std::size_t p = 0; p < interface.shapes.pairs.size(); ++p) {
    const ShapePair& pair = interface.shapes.pairs[p];
    const auto round = static_cast<std::size_t>(pair.round);
    const Round& shape = interface.shapes.rounds[round].shape;
    const PlacedRound& at = placed[round];
    const auto add = [&](NearKind kind, Index id) { memory.near_shapes.push_back({static_cast<Index>(p), kind, id}); };
    if (pair.other >= 0) {
      const auto other = static_cast<std::size_t>(pair.other);
      const double around = geometry::reach(shape) + geometry::reach(interface.shapes.rounds[other].shape) + memory.margin;
      if ((at.centre - placed[other].centre).norm() < around) add(NearKind::shape, 0);
      continue;
    }
    const Faceted& faceted = interface.shapes.faceted[static_cast<std::size_t>(pair.faceted)];
    const double around = geometry::reach(shape);
    // a distance changes by no more than the way of the point: the middle of a feature tells whether any of it can be near
    const auto is_near = [&](const Vec3& middle, double half, double thickness) {
      const double reach = half + thickness + memory.margin;
      return (middle - at.centre).squaredNorm() < (around + reach) * (around + reach) &&
             geometry::over_round(shape, at, middle).distance < reach;
    };
    const double thickest = faceted.half.size() > 0 ? faceted.half.maxCoeff() : 0;
    const double thickness = thickest > 0 ? 2 * thickest : 0;  // what may have grown since the start
    for (std::size_t i = 0; i < faceted.nodes.size(); ++i)
      if (is_near(x.col(faceted.nodes[i]), 0, thickness)) add(NearKind::node, static_cast<Index>(i));
    for (Index e = 0; e < faceted.edges.cols(); ++e) {
      const Vec3 a = x.col(faceted.edges(0, e)), b = x.col(faceted.edges(1, e));
      if (is_near(0.5 * (a + b), 0.5 * (b - a).norm(), thickness)) add(NearKind::edge, e);
    }
    for (Index f = 0; f < faceted.facets.cols(); ++f) {
      const Vec3 a = x.col(faceted.facets(0, f)), b = x.col(faceted.facets(1, f)), c = x.col(faceted.facets(2, f));
      const Vec3 middle = (a + b + c) / 3;
      const double half = std::sqrt(std::max({(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()}));
      if (is_near(middle, half, thickness)) add(NearKind::facet, f);
    }
  }
}

}  // namespace nereid::contact
