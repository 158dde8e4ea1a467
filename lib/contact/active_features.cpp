#include "contact/active_features.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/height.hpp"

namespace nereid::contact {

namespace {

using geometry::Closest;
using geometry::Kind;

constexpr double border_margin = 0.05;  // of a facet's size: half of what a border apex stands for lies inside

Vec3 eigen(const Vector<double>& a) { return {a.x, a.y, a.z}; }

/// The facets around an apex and where it stands over them: one local closest feature on a plain or a
/// ridge, one for each flank in a valley.
struct Neighbourhood {
  static constexpr int most_facets = 32;
  int facets = 0;
  std::array<Index, most_facets> facet;
  std::array<Closest, most_facets> closest;
  std::array<FeatureHeight, most_facets> height;  ///< over the facet, where the facet owns the apex

  /// The place of a facet in the list, looked at now if it was not before; -1 if the list is full.
  int look(const BaseSurface& base, const Vectors& x, const Vector<double>& p, Index f) {
    for (int i = 0; i < facets; ++i)
      if (facet[i] == f) return i;
    if (facets == most_facets) return -1;
    const auto c = corners(base, x, f);
    const auto at = geometry::facet_height(c, p);
    facet[facets] = f;
    // Eq. 14 with room for round-off: over the common border of two facets an apex belongs to both
    if (std::min({at.weight[0], at.weight[1], at.weight[2]}) >= -border_tolerance) {
      closest[facets] = {Kind::facet, 0, at.weight, at.height * at.height};
      height[facets] = {at.height, eigen(at.normal), at.weight};
    } else {
      closest[facets] = geometry::closest_on_triangle(c, p);
    }
    return facets++;
  }
};

/// Whether the same vertex or edge is the closest feature of every facet around it.
bool all_agree(const BaseSurface& base, const Vectors& x, const Vector<double>& p, Neighbourhood& near, int i) {
  const Closest mine = near.closest[i];
  const Index facet = near.facet[i];
  if (mine.kind == Kind::edge) {
    const Index other = base.neighbour(mine.local, facet);
    if (other < 0) return true;
    const int j = near.look(base, x, p, other);
    if (j < 0) return true;
    const Closest& theirs = near.closest[j];
    return theirs.kind == Kind::edge && base.neighbour(theirs.local, other) == facet;
  }
  const Index node = base.facets(mine.local, facet);
  for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) {
    const int j = near.look(base, x, p, base.ring[r]);
    if (j < 0) continue;
    const Closest& theirs = near.closest[j];
    if (theirs.kind != Kind::vertex || base.facets(theirs.local, near.facet[j]) != node) return false;
  }
  return true;
}

/// Of two facets that meet in a ridge the higher one has the apex: who is outside of one is outside,
/// and from inside the shorter way leads out. In a valley both are active.
///
///     n_i . (foot_j - foot_i) = h_i - h_j n_i . n_j,  negative where the foot of j lies behind i
void settle_ridges(ActiveFeatures& active) {
  std::array<bool, most_candidates> drop{};
  for (int i = 0; i < active.count; ++i) {
    for (int j = 0; j < i; ++j) {
      if (active.feature[i].kind != Kind::facet || active.feature[j].kind != Kind::facet) continue;
      const double cosine = active.at[i].normal.dot(active.at[j].normal);
      const double hi = active.at[i].height, hj = active.at[j].height;
      if (hi - cosine * hj < 0 && hj - cosine * hi < 0) drop[hi < hj ? i : j] = true;
    }
  }
  int kept = 0;
  for (int i = 0; i < active.count; ++i) {
    if (drop[i]) continue;
    active.feature[kept] = active.feature[i];
    active.at[kept++] = active.at[i];
  }
  active.count = kept;
}

/// Whether the closest edge, or an edge that meets in the closest vertex, has an entry in the table of
/// neighbours that is wanted.
template <class Wanted>
bool touches_an_edge(const BaseSurface& base, Index facet, const Closest& closest, const Wanted& wanted) {
  if (closest.kind == Kind::edge) return wanted(base.neighbour(closest.local, facet));
  const Index node = base.facets(closest.local, facet);
  for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) {
    for (int e = 0; e < 3; ++e) {
      const bool touches = base.facets(e, base.ring[r]) == node || base.facets((e + 1) % 3, base.ring[r]) == node;
      if (touches && wanted(base.neighbour(e, base.ring[r]))) return true;
    }
  }
  return false;
}

}  // namespace

FeatureNodes nodes_of(const BaseSurface& base, const Feature& f) {
  const auto at = [&](int local) { return base.facets(local % 3, f.facet); };
  if (f.kind == Kind::facet) return {3, {at(0), at(1), at(2)}};
  if (f.kind == Kind::edge) return {2, {at(f.local), at(f.local + 1), -1}};
  return {1, {at(f.local), -1, -1}};
}

FeatureHeight height_over(const BaseSurface& base, const Vectors& x, const Feature& f, const Vector<double>& p) {
  const auto c = corners(base, x, f.facet);
  if (f.kind == Kind::facet) {
    const auto at = geometry::facet_height(c, p);
    return {at.height, eigen(at.normal), at.weight};
  }
  double height = 0;
  Vec3 normal;
  std::array<double, 3> weight{};
  if (f.kind == Kind::edge) {
    const auto at = geometry::edge_height(std::array{c[f.local], c[(f.local + 1) % 3]}, p);
    height = at.height, normal = eigen(at.normal), weight = {at.weight[0], at.weight[1], 0};
  } else {
    const auto at = geometry::vertex_height(std::array{c[f.local]}, p);
    height = at.height, normal = eigen(at.normal), weight = {1, 0, 0};
  }
  // Behind the surface the way back leads through the edge to the other side. The side is that of
  // the mean normal of the facets that meet there, weighted by their angles (Baerentzen & Aanaes 2005).
  Vec3 mean = Vec3::Zero();
  const auto add = [&](Index facet, double angle) {
    const auto d = corners(base, x, facet);
    mean += angle * eigen(cross(d[1] - d[0], d[2] - d[0])).normalized();
  };
  if (f.kind == Kind::edge) {
    add(f.facet, 1);
    const Index other = base.neighbour(f.local, f.facet);
    if (other >= 0) add(other, 1);
  } else {
    const Index node = base.facets(f.local, f.facet);
    for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) {
      const Index facet = base.ring[r];
      int a = 0;
      while (base.facets(a, facet) != node) ++a;
      const Vec3 side = x.col(base.facets((a + 1) % 3, facet)) - x.col(node);
      const Vec3 other = x.col(base.facets((a + 2) % 3, facet)) - x.col(node);
      add(facet, std::acos(std::clamp(side.normalized().dot(other.normalized()), -1.0, 1.0)));
    }
  }
  if (normal.dot(mean) < 0) height = -height, normal = -normal;
  return {height, normal, weight};
}

bool past_border(const BaseSurface& base, const Vectors& x, Index facet, const Closest& closest, const Vector<double>& p,
                 const Mat3* allowed, bool image) {
  const auto c = corners(base, x, facet);
  const Vector<double> foot = closest.weight[0] * c[0] + closest.weight[1] * c[1] + closest.weight[2] * c[2];
  const Vector<double> n = cross(c[1] - c[0], c[2] - c[0]);
  const double size = std::sqrt(norm(n));
  const Vec3 away = eigen(p - foot);
  Vec3 unit = eigen(n).normalized();
  const bool in_plane = allowed != nullptr && (away - *allowed * away).norm() <= border_tolerance * size;
  const bool goes_on = in_plane && !at_end(base, facet, closest);
  if (goes_on && image) return false;
  if (in_plane && image) unit = (*allowed * unit).normalized();
  return (away - away.dot(unit) * unit).norm() > (goes_on ? border_tolerance : border_margin) * size;
}

bool on_border(const BaseSurface& base, Index facet, const Closest& closest) {
  return touches_an_edge(base, facet, closest, [](Index neighbour) { return neighbour < 0; });
}

bool at_end(const BaseSurface& base, Index facet, const Closest& closest) {
  return touches_an_edge(base, facet, closest, [](Index neighbour) { return neighbour == no_facet; });
}

void ActiveFeatures::add(const Feature& f, const FeatureHeight& height) {
  int place = count;
  if (count == most_candidates) {
    place = 0;
    for (int i = 1; i < count; ++i)
      if (at[i].height > at[place].height) place = i;
    if (!(height.height < at[place].height)) return;
  } else {
    ++count;
  }
  feature[place] = f;
  at[place] = height;
}

ActiveFeatures active_features_on(const BaseSurface& base, const Vectors& x, const Vector<double>& p, const WalkEnd& from, double height,
                 const Mat3* allowed) {
  ActiveFeatures active;
  Neighbourhood near;
  near.look(base, x, p, from.feature.facet);
  // Another flank can be active only near a border: only facets behind those have to be looked at.
  const auto c = corners(base, x, from.feature.facet);
  const double twice_area = norm(cross(c[1] - c[0], c[2] - c[0]));
  const double within = look_around * std::abs(height) + 1e-9 * std::sqrt(twice_area);
  std::array<bool, 3> near_edge{};
  for (int e = 0; e < 3; ++e) {
    const double altitude = twice_area / norm(c[(e + 1) % 3] - c[e]);
    near_edge[e] = from.closest.weight[(e + 2) % 3] * altitude < within;
    const Index other = base.neighbour(e, from.feature.facet);
    if (near_edge[e] && other >= 0) near.look(base, x, p, other);
  }
  for (int a = 0; a < 3; ++a) {
    if (!near_edge[a] || !near_edge[(a + 2) % 3]) continue;
    const Index node = base.facets(a, from.feature.facet);
    for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) near.look(base, x, p, base.ring[r]);
  }

  for (int i = 0; i < near.facets; ++i) {  // all_agree may lengthen the list
    const Closest at = near.closest[i];
    const Feature feature{near.facet[i], at.kind, at.local};
    if (at.kind == Kind::facet) {
      active.add(feature, near.height[i]);
      continue;
    }
    if (on_border(base, near.facet[i], at)) {
      if (!past_border(base, x, near.facet[i], at, p, allowed, false)) {
        const Feature facet{near.facet[i], Kind::facet, 0};
        active.add(facet, height_over(base, x, facet, p));
        continue;
      }
      // at a symmetry plane a border is a ridge between a facet and its image
      if (allowed == nullptr || past_border(base, x, near.facet[i], at, p, allowed, true)) continue;
    }
    if (all_agree(base, x, p, near, i)) {
      bool known = false;  // the same edge or vertex, seen from another facet
      const FeatureNodes mine = nodes_of(base, feature);
      for (int k = 0; k < active.count && !known; ++k) {
        const FeatureNodes other = nodes_of(base, active.feature[k]);
        known = other.count == mine.count && (mine.count == 1 ? other.node[0] == mine.node[0]
                                                              : other.node[0] == mine.node[1] && other.node[1] == mine.node[0]);
      }
      if (!known) active.add(feature, height_over(base, x, feature, p));
    }
  }
  if (active.count > 1) settle_ridges(active);
  return active;
}

}  // namespace nereid::contact
