#include "contact/surface/base_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/BVH>

#include "geometry/height.hpp"
#include "mesh/adjacency.hpp"

namespace nereid::contact {

namespace {

using geometry::Kind;

constexpr double sharp = 0.1;           // cosine between the normals at a ridge: below it the edge is a wall
constexpr double least_cosine = -0.94;  // between two facets, so that the tangent of half the angle stays finite


/// Which edge of a facet leads to a neighbour.
int edge_to(const BaseSurface& base, Index from, Index to) {
  return base.neighbour(0, from) == to ? 0 : base.neighbour(1, from) == to ? 1 : 2;
}

/// The way from a point along a direction to the first facet that faces along it, by a tree of boxes.
struct Ray {
  const BaseSurface& base;
  const Vectors& X;
  const Subset& body_of_facet;  // or empty
  Vec3 from, along;
  Index not_this;
  double first = std::numeric_limits<double>::infinity();

  bool intersectVolume(const Eigen::AlignedBox3d& box) const {
    double enter = 0, leave = first;
    for (int i = 0; i < 3; ++i) {
      const double low = box.min()[i] - from[i], high = box.max()[i] - from[i];
      if (along[i] == 0 && (low > 0 || high < 0)) return false;
      if (along[i] == 0) continue;
      enter = std::max(enter, std::min(low / along[i], high / along[i]));
      leave = std::min(leave, std::max(low / along[i], high / along[i]));
    }
    return enter <= leave;
  }
  bool intersectObject(Index facet) {
    const Vec3 area = area_vector(base, X, facet);
    const double through = area.dot(along);
    if (!body_of_facet.empty() && body_of_facet[static_cast<std::size_t>(facet)] != body_of_facet[static_cast<std::size_t>(not_this)])
      return false;  // two bodies that touch or overlap
    if (facet == not_this || !(through > 1e-9 * area.norm())) return false;
    const auto c = corners(base, X, facet);
    const double way = area.dot(Vec3(X.col(base.facets(0, facet))) - from) / through;
    const Vec3 hit = from + way * along;
    const double size = base.longest(facet);
    if (way > -1e-9 * size && way < first &&
        geometry::closest_on_triangle(c, {hit.x(), hit.y(), hit.z()}).distance_squared < 1e-16 * size * size)
      first = std::max(0.0, way);
    return false;  // the others may be nearer
  }
};

void measure_thickness(BaseSurface& base, const Vectors& X, const Subset& body_of_facet) {
  const auto count = static_cast<Index>(base.facets.cols());
  Subset all(count);
  std::vector<Eigen::AlignedBox3d> boxes(count);
  for (Index f = 0; f < count; ++f) {
    all[f] = f;
    for (int a = 0; a < 3; ++a) boxes[f].extend(Vec3(X.col(base.facets(a, f))));
    boxes[f].min().array() -= 1e-8 * base.longest(f);
    boxes[f].max().array() += 1e-8 * base.longest(f);
  }
  base.thickness = Scalars::Constant(count, std::numeric_limits<double>::infinity());
  if (count == 0) return;
  const Eigen::KdBVH<double, 3, Index> tree(all.begin(), all.end(), boxes.begin(), boxes.end());
  for (Index f = 0; f < count; ++f) {
    if (is_sheet(base, f)) continue;  // what is behind it is its other side
    Ray ray{base, X, body_of_facet, centre(base, X, f), -facet_normal(base, X, f), f};
    Eigen::BVIntersect(tree, ray);
    base.thickness(f) = ray.first;
  }
}

/// Walls, lengths and the sharpest turn.
void measure_edges(BaseSurface& base, const Vectors& X) {
  const auto count = static_cast<Index>(base.facets.cols());
  base.wall.assign(count, {true, true, true});
  base.longest = base.size = Scalars::Zero(count);
  for (Index f = 0; f < count; ++f) {
    const Vec3 n = facet_normal(base, X, f);
    base.size(f) = std::sqrt(area_vector(base, X, f).norm());
    for (int e = 0; e < 3; ++e) {
      const Index one = base.facets(e, f), other = base.facets((e + 1) % 3, f), across = base.neighbour(e, f);
      base.longest(f) = std::max(base.longest(f), (X.col(one) - X.col(other)).norm());
      if (across < 0) continue;
      const double cosine = std::clamp(n.dot(facet_normal(base, X, across)), -1.0, 1.0);
      const bool convex = n.dot(centre(base, X, across) - Vec3(X.col(one))) < 0;
      base.wall[f][e] = is_rim_of_sheet(base, f, e) || (convex && cosine < sharp);
    }
  }
  for (Index f = 0; f < count; ++f)  // both sides see the same wall, whatever round-off says
    for (int e = 0; e < 3; ++e)
      if (base.neighbour(e, f) > f) base.wall[base.neighbour(e, f)][edge_to(base, base.neighbour(e, f), f)] = base.wall[f][e];
  for (Index f = 0; f < count; ++f) base.sharpest = std::max(base.sharpest, lean(base, X, f));
}

double cosine_between(const Vec3& a, const Vec3& b) { return a.dot(b) / std::sqrt(a.squaredNorm() * b.squaredNorm()); }

double lean_of(double cosine) {
  if (!(cosine > least_cosine)) cosine = least_cosine;
  return 1.5 * std::sqrt((1 - cosine) / (1 + cosine));
}

}  // namespace

double lean(const BaseSurface& base, const Vectors& x, Index facet) {
  // of the pair with the least cosine; compared by the squares with their signs, without a root or a division
  Vec3 least_one = Vec3::UnitZ(), least_other = least_one;
  double signed_square = 1, of_sizes = 1;
  for (int a = 0; a < 3; ++a) {
    const Index node = base.facets(a, facet);
    for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) {
      const Index one = base.ring[r];
      const Vec3 n = area_vector(base, x, one);
      const double size = n.squaredNorm();
      for (int e = 0; e < 3; ++e) {
        const Index other = base.neighbour(e, one);
        const bool at_node = base.facets(e, one) == node || base.facets((e + 1) % 3, one) == node;
        if (other < one || !at_node || base.wall[one][e]) continue;  // the other is seen from its own side
        const Vec3 normal = area_vector(base, x, other);
        const double product = n.dot(normal), sizes = size * normal.squaredNorm();
        if (!(product * std::abs(product) * of_sizes < signed_square * sizes)) continue;
        signed_square = product * std::abs(product), of_sizes = sizes;
        least_one = n, least_other = normal;
      }
    }
  }
  return lean_of(std::min(1.0, cosine_between(least_one, least_other)));
}

double lean_at_edges(const BaseSurface& base, const Vectors& x, Index facet) {
  const Vec3 n = area_vector(base, x, facet);
  double cosine = 1;
  for (int e = 0; e < 3; ++e) {
    const Index other = base.neighbour(e, facet);
    if (other < 0 || base.wall[facet][e]) continue;
    cosine = std::min(cosine, cosine_between(n, area_vector(base, x, other)));
  }
  return lean_of(cosine);
}

Fans fans(const Table<3>& facets, Index nodes_of_mesh) {
  Fans made{.facets = facets, .other_side = mesh::other_sides(facets), .ring_begin = std::vector<Index>(nodes_of_mesh + 1, 0), .ring = {}};
  for (Index f = 0; f < facets.cols(); ++f)
    for (int a = 0; a < 3; ++a) ++made.ring_begin[facets(a, f) + 1];
  for (Index n = 0; n < nodes_of_mesh; ++n) made.ring_begin[n + 1] += made.ring_begin[n];
  made.ring.resize(made.ring_begin.back());
  std::vector<Index> next(made.ring_begin.begin(), made.ring_begin.end() - 1);
  for (Index f = 0; f < facets.cols(); ++f)
    for (int a = 0; a < 3; ++a) made.ring[next[facets(a, f)]++] = f;
  return made;
}

BaseSurface base_surface(const mesh::Surface& surface, const Vectors& X, const Subset& body_of_facet) {
  BaseSurface base;
  static_cast<Fans&>(base) = fans(surface.facets, static_cast<Index>(X.cols()));
  base.neighbour = mesh::neighbours(X, surface.facets);
  base.half.assign(base.facets.cols(), {});
  measure_edges(base, X);
  measure_thickness(base, X, body_of_facet);
  return base;
}

void goes_on_behind(BaseSurface& base, const Subset& nodes) {
  const auto on_plane = [&](Index node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
  for (Index f = 0; f < base.facets.cols(); ++f)
    for (int e = 0; e < 3; ++e)
      if ((base.neighbour(e, f) < 0 || is_rim_of_sheet(base, f, e)) && on_plane(base.facets(e, f)) && on_plane(base.facets((e + 1) % 3, f)))
        base.neighbour(e, f) = image_of_facet, base.wall[f][e] = false;
}

void mark_halves(BaseSurface& base, const Table<4>& faces) {
  for (const auto& face : faces.colwise()) {
    if (face(3) < 0) continue;
    const auto around = [&](Index node) { return (face.array() == node).any(); };
    for (Index r = base.ring_begin[face(0)]; r < base.ring_begin[face(0) + 1]; ++r) {
      const Index f = base.ring[r];
      for (int e = 0; e < 3; ++e) {
        const Index other = base.neighbour(e, f);
        if (other < 0) continue;
        const auto whole = [&](Index facet) {
          return around(base.facets(0, facet)) && around(base.facets(1, facet)) && around(base.facets(2, facet));
        };
        if (!whole(f) || !whole(other)) continue;
        for (const auto& [one, across] : {std::pair{f, other}, std::pair{other, f}}) {
          const int cut = edge_to(base, one, across), apart = edge_to(base, across, one);
          base.half[one] = {cut, base.facets((apart + 2) % 3, across)};
        }
      }
    }
  }
}

bool at_wall(const BaseSurface& base, Index node) {
  for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) {
    const Index f = base.ring[r];
    for (int e = 0; e < 3; ++e)
      if (base.wall[f][e] && (base.facets(e, f) == node || base.facets((e + 1) % 3, f) == node)) return true;
  }
  return false;
}

bool ends_at(const BaseSurface& base, const Feature& at) {
  if (at.kind == Kind::edge) return base.neighbour(at.local, at.facet) == no_facet;
  const Index node = base.facets(at.local, at.facet);
  for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r)
    for (int e = 0; e < 3; ++e) {
      const bool here = base.facets(e, base.ring[r]) == node || base.facets((e + 1) % 3, base.ring[r]) == node;
      if (here && base.neighbour(e, base.ring[r]) == no_facet) return true;
    }
  return false;
}

Vec3 centre(const BaseSurface& base, const Vectors& x, Index facet) {
  return (x.col(base.facets(0, facet)) + x.col(base.facets(1, facet)) + x.col(base.facets(2, facet))) / 3.0;
}

Vec3 node_normal(const Fans& base, const Vectors& x, Index node) {
  Vec3 sum = Vec3::Zero();
  for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) {
    const Index f = base.ring[r];
    if (is_sheet(base, f)) continue;  // both sides cancel
    int a = 0;
    while (base.facets(a, f) != node) ++a;
    const Vec3 side = x.col(base.facets((a + 1) % 3, f)) - x.col(node), other = x.col(base.facets((a + 2) % 3, f)) - x.col(node);
    const double angle = std::acos(std::clamp(side.normalized().dot(other.normalized()), -1.0, 1.0));
    sum += angle * facet_normal(base, x, f);
  }
  return sum.normalized();
}

namespace {

/// The normal on whose side a vertex has points in front. Of a sheet with both sides that of the facets around it on the side of one; zero
/// at its rim, where all is in front.
Vec3 front_of_vertex(const BaseSurface& base, const Vectors& x, Index facet, int local) {
  const Index node = base.facets(local, facet);
  if (!is_sheet(base, facet)) return node_normal(base, x, node);
  Vec3 sum = facet_normal(base, x, facet);
  for (const int before : {0, 2}) {  // across the edge that begins at the node, then across that which ends there
    Index here = facet;
    for (Index hop = base.ring_begin[node]; hop < base.ring_begin[node + 1]; ++hop) {  // around it: no more than its facets
      int at = 0;
      while (base.facets(at, here) != node) ++at;
      const int edge = (at + before) % 3;
      if (is_rim_of_sheet(base, here, edge)) return Vec3::Zero();
      here = base.neighbour(edge, here);
      if (here == facet) return sum.normalized();
      if (here < 0) break;  // in a symmetry plane
      sum += facet_normal(base, x, here);
    }
  }
  return sum.normalized();
}

}  // namespace

FeatureNodes nodes_of(const BaseSurface& base, const Feature& f) {
  const auto at = [&](int local) { return base.facets(local % 3, f.facet); };
  if (f.kind == Kind::facet) return {3, {at(0), at(1), at(2)}};
  if (f.kind == Kind::edge) return {2, {at(f.local), at(f.local + 1), -1}};
  return {1, {at(f.local), -1, -1}};
}

FeatureHeight height_over(const BaseSurface& base, const Vectors& x, const Feature& f, const Vec3& point) {
  const auto c = corners(base, x, f.facet);
  const Vector<double> p{point.x(), point.y(), point.z()};
  if (f.kind == Kind::facet) {
    const auto at = geometry::facet_height(c, p);
    return {at.height, eigen(at.normal), at.weight};
  }
  FeatureHeight over;
  // Behind the surface the way back leads through the edge to the other side. The side is that of the mean normal.
  Vec3 mean;
  if (f.kind == Kind::edge) {
    const auto at = geometry::edge_height(std::array{c[f.local], c[(f.local + 1) % 3]}, p);
    over.height = at.height, over.normal = eigen(at.normal);
    over.weight[f.local] = at.weight[0], over.weight[(f.local + 1) % 3] = at.weight[1];
    const Index across = base.neighbour(f.local, f.facet);
    mean.setZero();
    if (!is_rim_of_sheet(base, f.facet, f.local)) {  // else all is in front
      mean = facet_normal(base, x, f.facet);
      if (across >= 0) mean += facet_normal(base, x, across);
    }
  } else {
    const auto at = geometry::vertex_height(std::array{c[f.local]}, p);
    over.height = at.height, over.normal = eigen(at.normal);
    over.weight[f.local] = 1;
    mean = front_of_vertex(base, x, f.facet, f.local);
  }
  if (!(over.height > 0)) over.normal = mean.isZero(0) ? facet_normal(base, x, f.facet) : Vec3(mean.normalized());  // on it
  else if (over.normal.dot(mean) < 0) over.height = -over.height, over.normal = -over.normal;
  return over;
}

}  // namespace nereid::contact
