#include "contact/foot.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/quadrilateral.hpp"

namespace nereid::contact {

namespace {

constexpr double one_patch = 0.9;  // cosine between the normals of faces that go over into each other
constexpr double equal = 1e-14;    // between unit normals
constexpr double turned = 0.5;     // cosine between the normals of a face and of its half: a face that is warped more stays cut

/// A facet, or the face that it is half of.
struct Face {
  int corners;
  std::array<Index, 4> node;   ///< around it
  std::array<Index, 4> across; ///< facet behind the edge from each node to the next
};

int edge_from(const BaseSurface& base, Index facet, Index node) {
  return base.facets(0, facet) == node ? 0 : base.facets(1, facet) == node ? 1 : 2;
}

Face face_of(const BaseSurface& base, Index facet) {
  const auto node = [&](int I) { return base.facets(I % 3, facet); };
  const auto beyond = [&](int e) { return base.neighbour(e % 3, facet); };
  const auto& [cut, fourth] = base.half[facet];
  if (cut < 0) return {3, {node(0), node(1), node(2), -1}, {beyond(0), beyond(1), beyond(2), -1}};
  const Index other = beyond(cut);
  const int from_first = edge_from(base, other, node(cut)), from_fourth = edge_from(base, other, fourth);
  return {4,
          {node(cut), fourth, node(cut + 1), node(cut + 2)},
          {base.neighbour(from_first, other), base.neighbour(from_fourth, other), beyond(cut + 1), beyond(cut + 2)}};
}

/// How the point (a, b) of a bilinear face moves with a and b, and the area it sweeps.
struct Tangents {
  Vec3 by_a, by_b, area;
};
Tangents tangents_at(const Face& face, const Vectors& x, double a, double b) {
  const Vec3 corner[4] = {x.col(face.node[0]), x.col(face.node[1]), x.col(face.node[2]), x.col(face.node[3])};
  Tangents at;
  at.by_a = (1 - b) * (corner[1] - corner[0]) + b * (corner[2] - corner[3]);
  at.by_b = (1 - a) * (corner[3] - corner[0]) + a * (corner[2] - corner[1]);
  at.area = at.by_a.cross(at.by_b);
  return at;
}

/// Whether the point (a, b) is nearer to an edge of its face than a band.
bool is_within(double band, const Tangents& at, double a, double b) {
  const double along = std::min(a, 1 - a), across = std::min(b, 1 - b), limit = band * band, area = at.area.squaredNorm();
  return !(along > 0 && across > 0 && along * along * area > limit * at.by_b.squaredNorm() &&
           across * across * area > limit * at.by_a.squaredNorm());
}

/// The normal of the face behind an edge, at a point of that edge.
Vec3 normal_behind(const BaseSurface& base, const Vectors& x, Index facet, Index to, double way) {
  const Face face = face_of(base, facet);
  if (face.corners == 3) return facet_normal(base, x, facet);
  constexpr double along[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, start[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int e = 0; e < 4; ++e) {  // it runs the other way round
    if (face.node[e] != to) continue;
    const double back = 1 - way;
    return tangents_at(face, x, start[e][0] + back * along[e][0], start[e][1] + back * along[e][1]).area.normalized();
  }
  return facet_normal(base, x, facet);
}

/// The mean normal of the facets around a node that belong to the patch of a face with this normal.
Vec3 patch_normal(const BaseSurface& base, const Vectors& x, Index node, const Vec3& normal) {
  Vec3 sum = Vec3::Zero();
  for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) {
    const Vec3 area = area_vector(base, x, base.ring[r]);
    if (area.dot(normal) > one_patch * area.norm()) sum += area;
  }
  return sum.normalized();
}

/// Lets a normal go evenly over into those of the neighbours in a band along the edges of a face.
void blend(const BaseSurface& base, const Vectors& x, const Face& face, const Vec3& foot, double band, const Mat3* allowed, Vec3& n) {
  double to_edge = band, to_node = band;
  int nearest_edge = -1, nearest_node = -1;
  double way = 0;
  for (int e = 0; e < face.corners; ++e) {
    const Vec3 from = x.col(face.node[e]), edge = Vec3(x.col(face.node[(e + 1) % face.corners])) - from, r = foot - from;
    const double length = edge.norm(), distance = std::max(0.0, n.dot(edge.cross(r)) / length);
    if (distance < to_edge) to_edge = distance, nearest_edge = e, way = r.dot(edge) / (length * length);
    if (const double there = r.norm(); there < to_node) to_node = there, nearest_node = e;
  }
  if (nearest_edge < 0) return;
  if (const Index other = face.across[nearest_edge]; other >= 0) {
    const Vec3 there = normal_behind(base, x, other, face.node[(nearest_edge + 1) % face.corners], way);
    if (there.dot(n) > one_patch) n += 0.5 * (1 - to_edge / band) * (there - n);
  }
  if (nearest_node >= 0) n += (1 - to_node / band) * (patch_normal(base, x, face.node[nearest_node], n) - n);
  if (allowed) {  // the image of the face belongs to its patch as well
    const Vec3 let = *allowed * n;
    if (2 * let.squaredNorm() - n.squaredNorm() > one_patch * n.squaredNorm()) n = let;
  }
  n.normalize();
}

}  // namespace

double spread(const BaseSurface& base, const Vectors& x, const Vec3& p, const Feature& feature, bool blends, const Mat3* allowed,
              FeatureHeight& over) {
  const Half& half = base.half[feature.facet];
  const bool on_facet = feature.kind == geometry::Kind::facet;
  if (!on_facet && (half.cut < 0 || feature.kind != geometry::Kind::edge || feature.local != half.cut)) return 0;
  const double band = blends ? blended * base.size(feature.facet) : 0;
  const Face face = face_of(base, feature.facet);
  if (face.corners == 3) {
    if (!blends) return 0;
    const Vec3 facet = over.normal;
    blend(base, x, face, p - over.height * facet, band, allowed, over.normal);
    over.weight = height_over(base, x, feature, p - over.height / over.normal.dot(facet) * over.normal).weight;
    return 0;
  }
  const int first = half.cut, second = (first + 1) % 3, third = (first + 2) % 3;
  const std::array<Vec3, 4> corner{x.col(face.node[0]) - p, x.col(face.node[1]) - p, x.col(face.node[2]) - p, x.col(face.node[3]) - p};
  std::array<double, 4> weight;
  double a = over.weight[second], b = a + over.weight[third];
  const auto foot = [&] {  // from the apex
    return Vec3(weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2] + weight[3] * corner[3]);
  };
  if (!geometry::bilinear_weights(corner, Vec3::Zero(), over.normal, a, b, weight)) return 0;
  a = weight[1] + weight[2], b = weight[2] + weight[3];
  const Tangents at = tangents_at(face, x, a, b);
  Vec3 n = at.area.normalized();
  if (!(n.dot(over.normal) > turned)) return 0;
  if (blends && is_within(band, at, a, b)) blend(base, x, face, p + foot(), band, allowed, n);
  if ((n - over.normal).squaredNorm() > equal * equal) {
    if (!geometry::bilinear_weights(corner, Vec3::Zero(), n, a, b, weight)) return 0;
    over.normal = n;
  }
  over.height = -over.normal.dot(foot());
  over.weight[first] = weight[0], over.weight[second] = weight[2], over.weight[third] = weight[3];
  return weight[1];
}

}  // namespace nereid::contact
