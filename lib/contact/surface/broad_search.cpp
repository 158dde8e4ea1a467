#include "contact/surface/broad_search.hpp"

#include <algorithm>
#include <cmath>

namespace nereid::contact {

namespace {
constexpr std::size_t cells_per_facet = 8;  // enough to find few facets in a cell, however the surface lies

/// Whether a place can be searched for; false for NaN, infinity and what lies beyond farthest_place.
bool can_be_searched(const Vec3& place) { return (place.array().abs() <= farthest_place).all(); }

/// A place along one axis, in cells, as the number of its cell from first to last; NaN counts as first.
int cell_number(double place, int first, int last) {
  if (!(place > first)) return first;
  return place < last ? static_cast<int>(std::floor(place)) : last;
}
}  // namespace

BroadSearch::BroadSearch(Index facets, Index first)
    : begin_(cells_per_facet * (static_cast<std::size_t>(facets) + 1) + 1, 0), facets_(facets), first_(first) {}

Index BroadSearch::cell_of(const Vec3& point) const {
  const Vec3 at = (point - low_) / cell_;
  const auto number = [&](int axis) { return cell_number(at[axis], 0, count_[axis] - 1); };
  return cell_of(number(0), number(1), number(2));
}

bool BroadSearch::sort(const BaseSurface& base, const Vectors& x) {
  const auto facets = static_cast<Index>(facets_.size()), last_facet = first_ + facets;
  sorted_ = false;
  for (Index f = first_; f < last_facet; ++f)
    for (int a = 0; a < 3; ++a)
      if (!can_be_searched(x.col(base.facets(a, f)))) return false;
  Vec3 high = Vec3::Zero();
  radius_ = 0;
  for (Index f = first_; f < last_facet; ++f) {
    const Vec3 c = centre(base, x, f);
    low_ = f == first_ ? c : low_.cwiseMin(c);
    high = f == first_ ? c : high.cwiseMax(c);
    for (int a = 0; a < 3; ++a) radius_ = std::max(radius_, (x.col(base.facets(a, f)) - c).norm());
  }
  const Vec3 extent = high - low_;
  const auto cells = [&](int axis) { return std::floor(extent[axis] / cell_) + 1; };
  cell_ = radius_ > 0 ? radius_ : 1;
  while (cells(0) * cells(1) * cells(2) > static_cast<double>(cells_per_facet) * (facets + 1)) cell_ *= 1.3;
  count_ = {static_cast<int>(cells(0)), static_cast<int>(cells(1)), static_cast<int>(cells(2))};

  // counting sort: how many facets in each cell, where each cell ends, then fill from the end
  const Index last = count_.prod();
  std::fill_n(begin_.begin(), last + 1, 0);
  for (Index f = first_; f < last_facet; ++f) ++begin_[cell_of(centre(base, x, f))];
  for (Index c = 0; c < last; ++c) begin_[c + 1] += begin_[c];
  centres_.resize(3, facets);
  for (Index f = last_facet - 1; f >= first_; --f) {
    const Vec3 c = centre(base, x, f);
    const Index at = --begin_[cell_of(c)];
    facets_[at] = f, centres_.col(at) = c;
  }
  sorted_ = true;
  return true;
}

bool BroadSearch::can_find(const Vector<double>& point) const { return sorted_ && can_be_searched({point.x, point.y, point.z}); }

BroadSearch::Box BroadSearch::cells_around(const Vector<double>& point, double reach) const {
  // a facet nearer than `reach` has its centre nearer than reach + radius
  const double margin = reach + radius_;
  const Vec3 p(point.x, point.y, point.z);
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.first[axis] = cell_number((p[axis] - margin - low_[axis]) / cell_, 0, count_[axis]);
    box.last[axis] = cell_number((p[axis] + margin - low_[axis]) / cell_, -1, count_[axis] - 1);
  }
  return box;
}

Index BroadSearch::nearest(const BaseSurface& base, const Vectors& x, const Vector<double>& point, double reach) const {
  if (!can_find(point)) return -1;
  for (double near = std::min(reach, radius_ > 0 ? radius_ : cell_);; near = std::min(reach, 2 * near)) {
    Index best = -1;
    double best_squared = near * near;
    within(base, x, point, near, [&](Index facet, double squared) {
      const bool tie = squared == best_squared && best >= 0 && facet < best;
      if (squared < best_squared || tie) best = facet, best_squared = squared;
    });
    if (best >= 0 || !(near < reach)) return best;
  }
}

}  // namespace nereid::contact
