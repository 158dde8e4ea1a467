#include "contact/surface/foot.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contact/surface/face.hpp"
#include "geometry/closest.hpp"

namespace nereid::contact {

namespace {

constexpr double one_patch = 0.9;  // cosine between the normals of faces that go over into each other

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

/// The normal of a bilinear face at (a, b).
Vec3 normal_at(const Face& face, const Vectors& x, double a, double b) {
  const Vec3 corner[4] = {x.col(face.node[0]), x.col(face.node[1]), x.col(face.node[2]), x.col(face.node[3])};
  const Vec3 by_a = (1 - b) * (corner[1] - corner[0]) + b * (corner[2] - corner[3]);
  const Vec3 by_b = (1 - a) * (corner[3] - corner[0]) + a * (corner[2] - corner[1]);
  return by_a.cross(by_b).normalized();
}

/// The normal of the face behind an edge, at a point of that edge.
Vec3 normal_behind(const BaseSurface& base, const Vectors& x, Index facet, Index to, double way) {
  const Face face = face_of(base, facet);
  if (face.corners == 3) return facet_normal(base, x, facet);
  constexpr double along[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, start[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int e = 0; e < 4; ++e) {  // it runs the other way round
    if (face.node[e] != to) continue;
    const double back = 1 - way;
    return normal_at(face, x, start[e][0] + back * along[e][0], start[e][1] + back * along[e][1]);
  }
  return facet_normal(base, x, facet);
}

/// The area that the edges of a face span at a node, along the normal there. Both halves of a quadrilateral have the same. [m2]
Vec3 area_at(const BaseSurface& base, const Vectors& x, Index facet, Index node) {
  const Face face = face_of(base, facet);
  int at = 0;
  while (face.node[at] != node) ++at;
  const auto to = [&](int steps) { return Vec3(x.col(face.node[(at + steps) % face.corners]) - x.col(node)); };
  return to(1).cross(to(face.corners - 1));
}

/// Whether the other half of a face has this node too, and counts for both.
bool counts_in_other_half(const BaseSurface& base, Index facet, Index node) {
  const int cut = base.half[facet].cut;
  if (cut < 0) return false;
  const Index other = base.neighbour(cut, facet);
  const auto nodes = base.facets.col(other);
  return other < facet && std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

/// The mean normal of the faces around a node: of all of them if these belong to one patch, so that it does not depend on the face that is
/// asked; else of those that belong to the patch of a face with this normal.
Vec3 patch_normal(const BaseSurface& base, const Vectors& x, Index node, const Vec3& normal) {
  const auto mean_of_those_along = [&](const Vec3& along) {
    Vec3 sum = Vec3::Zero();
    bool are_all = true;
    for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) {
      if (counts_in_other_half(base, base.ring[r], node)) continue;
      const Vec3 area = area_at(base, x, base.ring[r], node);
      if (area.dot(along) > one_patch * area.norm()) sum += area;
      else are_all = false;
    }
    return std::pair(Vec3(sum.normalized()), are_all);
  };
  Vec3 all = Vec3::Zero();
  for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r)
    if (!counts_in_other_half(base, base.ring[r], node)) all += area_at(base, x, base.ring[r], node);
  if (const auto [mean, are_all] = mean_of_those_along(all.normalized()); are_all) return mean;
  return mean_of_those_along(normal.normalized()).first;
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

/// A face beside a place, by one of its halves, and how much it counts.
struct FaceAround {
  Index facet;
  double weight;
};

Index other_half(const BaseSurface& base, Index facet) {
  return base.half[facet].cut < 0 ? facet : base.neighbour(base.half[facet].cut, facet);
}

double squared_distance_of_face(const BaseSurface& base, const Vectors& x, const Vector<double>& place, Index facet) {
  const auto of = [&](Index half) { return geometry::closest_on_triangle(corners(base, x, half), place).distance_squared; };
  const Index other = other_half(base, facet);
  return other == facet ? of(facet) : std::min(of(facet), of(other));
}

/// Adds a weight to all nodes of a face; returns whether there was room.
bool add_nodes_of_face(const BaseSurface& base, const FaceAround& face, NodesAround& nodes) {
  const auto add = [&](Index node) {
    const auto end = nodes.node.begin() + nodes.count, at = std::find(nodes.node.begin(), end, node);
    if (at == nodes.node.end()) return false;
    if (at == end) *at = node, nodes.weight[static_cast<std::size_t>(nodes.count++)] = 0;
    nodes.weight[static_cast<std::size_t>(at - nodes.node.begin())] += face.weight;
    return true;
  };
  for (int I = 0; I < 3; ++I)
    if (!add(base.facets(I, face.facet))) return false;
  return base.half[face.facet].fourth < 0 || add(base.half[face.facet].fourth);
}

}  // namespace

bool stand_on_face(const BaseSurface& base, const Vectors& x, const Vec3& p, const Feature& feature, double band, const Mat3* allowed,
                   FeatureHeight& over, double& fourth) {
  const Half& half = base.half[feature.facet];
  const bool on_cut = feature.kind == geometry::Kind::edge && feature.local == half.cut;
  if (half.cut < 0 || !(feature.kind == geometry::Kind::facet || on_cut)) return false;
  const int first = half.cut, second = (first + 1) % 3, third = (first + 2) % 3;
  const auto corner = [&](Index node) { return Vector<double>{x(0, node) - p.x(), x(1, node) - p.y(), x(2, node) - p.z()}; };
  const auto node = [&](int local) { return base.facets(local, feature.facet); };
  const std::array<Vector<double>, 4> corners{corner(node(first)), corner(half.fourth), corner(node(second)), corner(node(third))};
  OverFace<double> on;
  on.at.a = over.weight[second] + fourth, on.at.b = over.weight[second] + over.weight[third];
  if (!stand_over(corners, on)) return false;
  Vec3 n = eigen(on.normal);
  double height = on.height;
  std::array<double, 4> weight = on.weight;
  if (band > 0 && is_within(band, on)) {
    const Vec3 of_face = n;
    blend(base, x, face_of(base, feature.facet), p - eigen(on.at.way), band, allowed, n);
    if (n != of_face) {
      const std::array<Vec3, 4> from_p{eigen(corners[0]), eigen(corners[1]), eigen(corners[2]), eigen(corners[3])};
      if (!geometry::bilinear_weights(from_p, Vec3::Zero(), n, on.at.a, on.at.b, weight)) return false;
      height = -n.dot(weight[0] * from_p[0] + weight[1] * from_p[1] + weight[2] * from_p[2] + weight[3] * from_p[3]);
    }
  }
  over.normal = n;
  over.height = height;
  over.weight[first] = weight[0], over.weight[second] = weight[2], over.weight[third] = weight[3];
  fourth = weight[1];
  return true;
}

NodesAround nodes_around(const BaseSurface& base, const Vectors& x, const Vec3& place, Index facet) {
  constexpr std::size_t most_faces = 8;
  const Vector<double> p{place.x(), place.y(), place.z()};
  std::array<FaceAround, most_faces> faces;
  std::size_t count = 0;
  bool has_room = true;
  const auto add_face = [&](Index other, double weight) {
    const auto is_same = [&](const FaceAround& one) { return one.facet == other || other_half(base, one.facet) == other; };
    if (std::any_of(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(count), is_same)) return;
    has_room = has_room && count < most_faces;
    if (has_room) faces[count++] = {other, weight};
  };
  add_face(facet, 1);
  for (std::size_t next = 0; next < count && has_room; ++next)
    for (const Index half : {faces[next].facet, other_half(base, faces[next].facet)})
      for (int e = 0; e < 3; ++e) {
        const Index across = base.neighbour(e, half);
        if (across < 0 || base.wall[half][static_cast<std::size_t>(e)] || e == base.half[half].cut) continue;
        const double distance = std::sqrt(squared_distance_of_face(base, x, p, across)), band = blended * base.size(across);
        if (distance < band) add_face(across, 1 - distance / band);
      }
  NodesAround nodes;
  for (std::size_t k = 0; k < count && has_room; ++k) has_room = add_nodes_of_face(base, faces[k], nodes);
  if (has_room) return nodes;
  nodes = {};
  add_nodes_of_face(base, faces[0], nodes);
  return nodes;
}

void blend_over_facet(const BaseSurface& base, const Vectors& x, const Vec3& p, const Feature& feature, double band, const Mat3* allowed,
                      FeatureHeight& over) {
  const Vec3 facet = over.normal;
  blend(base, x, face_of(base, feature.facet), p - over.height * facet, band, allowed, over.normal);
  over.weight = height_over(base, x, feature, p - over.height / over.normal.dot(facet) * over.normal).weight;
}

}  // namespace nereid::contact
