#include "contact/base_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/check.hpp"

namespace nereid::contact {

namespace {
constexpr int most_hops = 200;
constexpr std::size_t cells_per_facet = 8;  // enough to find few facets in a cell, however the surface lies
constexpr double closer = 1.0 - 1e-12;  // a walk goes on only downhill, so that it ends

Vec3 centre(const BaseSurface& base, const Vectors& x, Index facet) {
  return (x.col(base.facets(0, facet)) + x.col(base.facets(1, facet)) + x.col(base.facets(2, facet))) / 3.0;
}

/// Whether a place can be searched for; false for NaN, infinity and what lies beyond farthest_place.
bool can_be_searched(const Vec3& place) { return (place.array().abs() <= farthest_place).all(); }

/// A place along one axis, in cells, as the number of its cell from first to last; NaN counts as first.
int cell_number(double place, int first, int last) {
  if (!(place > first)) return first;
  return place < last ? static_cast<int>(std::floor(place)) : last;
}
}  // namespace

BaseSurface base_surface(const mesh::Surface& surface, Index nodes_of_mesh) {
  BaseSurface base{.facets = surface.facets, .neighbour = Table<3>::Constant(3, surface.facets.cols(), no_facet),
                   .ring_begin = std::vector<Index>(nodes_of_mesh + 1, 0), .ring = {}};
  std::map<std::pair<Index, Index>, std::pair<Index, int>> directed;
  for (Index f = 0; f < base.facets.cols(); ++f) {
    for (int e = 0; e < 3; ++e) {
      const bool is_new = directed.try_emplace({base.facets(e, f), base.facets((e + 1) % 3, f)}, f, e).second;
      check(is_new, "an edge of a base surface belongs to two facets in the same direction");
    }
  }
  for (const auto& [edge, place] : directed) {
    const auto other = directed.find({edge.second, edge.first});
    if (other != directed.end()) base.neighbour(place.second, place.first) = other->second.first;
  }
  for (Index f = 0; f < base.facets.cols(); ++f)
    for (int a = 0; a < 3; ++a) ++base.ring_begin[base.facets(a, f) + 1];
  for (Index n = 0; n < nodes_of_mesh; ++n) base.ring_begin[n + 1] += base.ring_begin[n];
  base.ring.resize(base.ring_begin.back());
  std::vector<Index> next(base.ring_begin.begin(), base.ring_begin.end() - 1);
  for (Index f = 0; f < base.facets.cols(); ++f)
    for (int a = 0; a < 3; ++a) base.ring[next[base.facets(a, f)]++] = f;
  return base;
}

void goes_on_behind(BaseSurface& base, const Subset& nodes) {
  const auto on_plane = [&](Index node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
  for (Index f = 0; f < base.facets.cols(); ++f)
    for (int e = 0; e < 3; ++e)
      if (base.neighbour(e, f) < 0 && on_plane(base.facets(e, f)) && on_plane(base.facets((e + 1) % 3, f)))
        base.neighbour(e, f) = image_of_facet;
}

WalkEnd walk(const BaseSurface& base, const Vectors& x, const Vector<double>& apex, Index from) {
  WalkEnd end{{from, geometry::Kind::facet, 0}, geometry::closest_on_triangle(corners(base, x, from), apex), 0};
  while (end.hops < most_hops) {
    end.feature.kind = end.closest.kind;
    end.feature.local = end.closest.local;
    Index best = -1;
    geometry::Closest best_closest = end.closest;
    const auto consider = [&](Index facet) {
      if (facet < 0 || facet == end.feature.facet) return;
      const auto there = geometry::closest_on_triangle(corners(base, x, facet), apex);
      if (there.distance_squared < closer * best_closest.distance_squared) best = facet, best_closest = there;
    };
    const auto consider_ring = [&](Index node) {
      for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) consider(base.ring[r]);
    };
    if (end.closest.kind == geometry::Kind::facet) {
      // Eq. 14 may hold for both flanks of a valley: what lies behind a near border may be nearer still
      const auto c = corners(base, x, end.feature.facet);
      const double twice_area = norm(cross(c[1] - c[0], c[2] - c[0]));
      const double within = look_around * std::sqrt(end.closest.distance_squared);
      std::array<bool, 3> near{};
      for (int e = 0; e < 3; ++e) {
        near[e] = end.closest.weight[(e + 2) % 3] * twice_area < within * norm(c[(e + 1) % 3] - c[e]);
        if (near[e]) consider(base.neighbour(e, end.feature.facet));
      }
      for (int a = 0; a < 3; ++a)
        if (near[a] && near[(a + 2) % 3]) consider_ring(base.facets(a, end.feature.facet));
    } else if (end.closest.kind == geometry::Kind::edge) {
      consider(base.neighbour(end.closest.local, end.feature.facet));
    } else {
      consider_ring(base.facets(end.closest.local, end.feature.facet));
    }
    if (best < 0) return end;
    end.feature.facet = best;
    end.closest = best_closest;
    ++end.hops;
  }
  end.feature.facet = -1;
  return end;
}

BroadSearch::BroadSearch(Index facets)
    : begin_(cells_per_facet * (static_cast<std::size_t>(facets) + 1) + 1, 0), facets_(facets) {}

Index BroadSearch::cell_of(const Vec3& point) const {
  const Vec3 at = (point - low_) / cell_;
  const auto number = [&](int axis) { return cell_number(at[axis], 0, count_[axis] - 1); };
  return cell_of(number(0), number(1), number(2));
}

bool BroadSearch::sort(const BaseSurface& base, const Vectors& x) {
  const auto facets = static_cast<Index>(facets_.size());
  sorted_ = false;
  for (Index f = 0; f < facets; ++f)
    for (int a = 0; a < 3; ++a)
      if (!can_be_searched(x.col(base.facets(a, f)))) return false;
  Vec3 high = Vec3::Zero();
  radius_ = 0;
  for (Index f = 0; f < facets; ++f) {
    const Vec3 c = centre(base, x, f);
    low_ = f == 0 ? c : low_.cwiseMin(c);
    high = f == 0 ? c : high.cwiseMax(c);
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
  for (Index f = 0; f < facets; ++f) ++begin_[cell_of(centre(base, x, f))];
  for (Index c = 0; c < last; ++c) begin_[c + 1] += begin_[c];
  for (Index f = facets - 1; f >= 0; --f) facets_[--begin_[cell_of(centre(base, x, f))]] = f;
  sorted_ = true;
  return true;
}

Index BroadSearch::nearest(const BaseSurface& base, const Vectors& x, const Vector<double>& point, double reach) const {
  const Vec3 p(point.x, point.y, point.z);
  if (!sorted_ || !can_be_searched(p)) return -1;
  for (double within = std::min(reach, radius_ > 0 ? radius_ : cell_);; within = std::min(reach, 2 * within)) {
    // a facet nearer than `within` has its centre nearer than within + radius
    const double margin = within + radius_;
    Eigen::Vector3i first, last;
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = cell_number((p[axis] - margin - low_[axis]) / cell_, 0, count_[axis]);
      last[axis] = cell_number((p[axis] + margin - low_[axis]) / cell_, -1, count_[axis] - 1);
    }
    Index best = -1;
    double best_squared = within * within;
    for (int k = first.z(); k <= last.z(); ++k)
      for (int j = first.y(); j <= last.y(); ++j)
        for (int i = first.x(); i <= last.x(); ++i)
          for (Index at = begin_[cell_of(i, j, k)]; at < begin_[cell_of(i, j, k) + 1]; ++at) {
            const auto there = geometry::closest_on_triangle(corners(base, x, facets_[at]), point);
            const bool tie = there.distance_squared == best_squared && best >= 0 && facets_[at] < best;
            if (there.distance_squared < best_squared || tie) best = facets_[at], best_squared = there.distance_squared;
          }
    if (best >= 0 || !(within < reach)) return best;
  }
}

}  // namespace nereid::contact
