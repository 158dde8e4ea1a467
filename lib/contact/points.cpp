#include "contact/points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contact/foot.hpp"

namespace nereid::contact {

namespace {

constexpr int most_steps = 64;        // from facet to facet, to a foot
constexpr double inside = 1e-7;       // of a facet: so far past a border a foot is on it
constexpr double plain = 0.9063;      // cosine of 25 degrees between normals of a base under a face, and the face and its base
constexpr double facing = 0.5;        // cosine of 60 degrees: a face that turns farther away from its base does not press it
constexpr double deepest = 0.5, farthest = 2;  // of the side of a face: points that are deeper or higher are not over a base
constexpr double close = 1;           // of the side of a face: one that is covered in part counts if one of its points is nearer
constexpr int points_of_corner = 4;   // of a face that is covered in part
constexpr double most_turn = 0.35;    // [rad] of the faces at a guard: a ridge has no sag
constexpr double always_allowed = 0.01, per_turn = 0.25;  // of the side of the base
constexpr double most_allowed = 0.025;  // of the depth of an element, a quarter of what the audit warns of

/// A face as it stands at x.
Face face_at(const mesh::FacesAround& around, const Vectors& x, Index f) {
  Face face;
  face.corners = around.faces(3, f) < 0 ? 3 : 4;
  for (int j = 0; j < face.corners; ++j) face.node[j] = around.faces(j, f);
  const auto at = [&](int j) { return Vec3(x.col(face.node[j])); };
  const Vec3 area = face.corners == 4 ? Vec3(0.5 * (at(2) - at(0)).cross(at(3) - at(1))) : Vec3(0.5 * (at(1) - at(0)).cross(at(2) - at(0)));
  const double size = area.norm();
  face.normal = size > 0 ? Vec3(area / size) : Vec3(Vec3::Zero());
  face.side = std::sqrt((face.corners == 4 ? 1 : 2) * size);
  return face;
}

/// The same, measured once in a step.
const Face& face_of(const mesh::FacesAround& around, const Vectors& x, Index f, PointWork& work) {
  FacePoints& points = work.of_face[static_cast<std::size_t>(f)];
  if (points.measured != work.step) points.face = face_at(around, x, f), points.measured = work.step;
  return points.face;
}

/// Shape functions or dual weights at the Gauss point next to a corner: by how many edges a node is away from it.
struct ByDistance {
  double here, beside, opposite;
  double operator()(int corners, int point, int corner) const {
    const int apart = std::abs(point - corner);
    return apart == 0 ? here : corners == 4 && apart == 2 ? opposite : beside;
  }
};
const double third = 1 / std::sqrt(3.0);
const ByDistance shape_4{(1 + third) * (1 + third) / 4, (1 - third * third) / 4, (1 - third) * (1 - third) / 4};
const ByDistance dual_4{1 + 0.5 * std::sqrt(3.0), -0.5, 1 - 0.5 * std::sqrt(3.0)};
const ByDistance shape_3{2.0 / 3, 1.0 / 6, 0}, dual_3{5.0 / 3, -1.0 / 3, 0};

double shape(int corners, int point, int corner) { return (corners == 4 ? shape_4 : shape_3)(corners, point, corner); }
double dual(int corners, int point, int corner) { return (corners == 4 ? dual_4 : dual_3)(corners, point, corner); }

int corner_of(const Face& face, Index node) {
  return static_cast<int>(std::find(face.node.begin(), face.node.begin() + face.corners, node) - face.node.begin());
}

/// Shape functions at one of the points of a face that is covered in part: each corner has two by two, between it, the middles of its edges
/// and that of the face.
std::array<double, 4> make_shape_of_part(int corners, std::size_t place) {
  const auto corner = static_cast<int>(place) / points_of_corner, point = static_cast<int>(place) % points_of_corner;
  const double s = point % 2 == 0 ? 0.25 : 0.75, t = point < 2 ? 0.25 : 0.75;
  std::array<double, 4> phi{};
  const int next = (corner + 1) % corners, last = (corner + corners - 1) % corners;
  for (int j = 0; j < corners; ++j) phi[j] = s * t / corners;
  phi[corner] += (1 - s) * (1 - t) + 0.5 * s * (1 - t) + 0.5 * (1 - s) * t;
  phi[next] += 0.5 * s * (1 - t);
  phi[last] += 0.5 * (1 - s) * t;
  return phi;
}

using PartShapes = std::array<std::array<double, 4>, 4 * points_of_corner>;
PartShapes make_part_shapes(int corners) {
  PartShapes all{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(points_of_corner * corners); ++k) all[k] = make_shape_of_part(corners, k);
  return all;
}
const PartShapes parts_of_3 = make_part_shapes(3), parts_of_4 = make_part_shapes(4);
const std::array<double, 4>& shape_of_part(int corners, std::size_t place) { return (corners == 4 ? parts_of_4 : parts_of_3)[place]; }

/// The foot of a point of a face; without a facet where there is none, or far away from it.
Foot foot_of(const BaseSurface& base, const Vectors& x, const Face& face, const std::array<double, 4>& phi, Index from) {
  Vec3 p = Vec3::Zero();
  for (int j = 0; j < face.corners; ++j) p += phi[j] * x.col(face.node[j]);
  Foot foot;
  if (!find_foot(base, x, p, from, foot) || foot.height < -deepest * face.side || foot.height > farthest * face.side) foot.facet = -1;
  return foot;
}

/// Finds the feet of the points of a face that is covered in part, and who takes them: those of a corner that has not all of them are taken
/// by the nearest of the corners that have most, so that no two conditions are nearly the same.
void find_parts(const BaseSurface& base, const Vectors& x, const Face& face, Index from, FacePoints& points) {
  const auto all = static_cast<std::size_t>(points_of_corner * face.corners);
  points.foot.resize(all), points.taken_by.resize(all);
  std::array<int, 4> count{};
  for (std::size_t k = 0; k < all; ++k) {
    points.foot[k] = foot_of(base, x, face, shape_of_part(face.corners, k), from);
    if (points.foot[k].facet >= 0) ++count[k / points_of_corner];
  }
  const int most = *std::max_element(count.begin(), count.end());
  for (std::size_t k = 0; k < all; ++k) {
    auto corner = static_cast<int>(k) / points_of_corner;
    if (count[corner] < points_of_corner) {
      const std::array<double, 4>& phi = shape_of_part(face.corners, k);
      corner = -1;
      for (int j = 0; j < face.corners; ++j)
        if (count[j] == most && (corner < 0 || phi[j] > phi[corner])) corner = j;
    }
    points.taken_by[k] = corner;
  }
}

/// Finds how a face lies on the part of a base that a facet belongs to, and where its points are.
void find_points(const BaseSurface& base, const Vectors& x, const Face& face, Index from, FacePoints& points) {
  points.foot.assign(static_cast<std::size_t>(face.corners), {});
  points.lies = Lies::apart;
  if (-face.normal.dot(facet_normal(base, x, from)) < facing) return;
  int found = 0;
  bool is_near = false, leans = false;
  for (int q = 0; q < face.corners; ++q) {
    std::array<double, 4> phi{};
    for (int j = 0; j < face.corners; ++j) phi[j] = shape(face.corners, q, j);
    const Foot& foot = points.foot[static_cast<std::size_t>(q)] = foot_of(base, x, face, phi, from);
    if (foot.facet < 0) continue;
    ++found;
    is_near = is_near || foot.height < close * face.side;
    leans = leans || -foot.normal.dot(face.normal) < plain;
    for (int before = 0; before < q; ++before) {
      const Foot& other = points.foot[static_cast<std::size_t>(before)];
      leans = leans || (other.facet >= 0 && foot.normal.dot(other.normal) < plain);
    }
  }
  if (leans) points.lies = Lies::leaning;
  else if (found == face.corners) points.lies = Lies::whole;
  else if (found > 0 && is_near) find_parts(base, x, face, from, points), points.lies = Lies::in_part;
}

/// Whether the feet that were found for another apex are over the same part of the base.
bool is_same_part(const Interface& interface, const Vectors& x, const FacePoints& points, Index from) {
  const Vec3 normal = facet_normal(interface.base, x, from);
  const auto& of_facet = interface.bodies.of_facet;
  return std::any_of(points.foot.begin(), points.foot.end(), [&](const Foot& foot) {
    return foot.facet >= 0 && foot.normal.dot(normal) > plain &&
           (of_facet.empty() || of_facet[static_cast<std::size_t>(foot.facet)] == of_facet[static_cast<std::size_t>(from)]);
  });
}

}  // namespace

bool find_foot(const BaseSurface& base, const Vectors& x, const Vec3& p, Index from, Foot& foot) {
  Index before = -1, facet = from;
  FeatureHeight over;
  for (int step = 0;; ++step) {
    over = height_over(base, x, {facet, geometry::Kind::facet, 0}, p);
    if (std::min({over.weight[0], over.weight[1], over.weight[2]}) >= -inside) break;
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return over.weight[a] < over.weight[b]; });
    Index next = -1;
    for (const int corner : order) {
      if (over.weight[corner] >= -inside) break;
      const int edge = (corner + 1) % 3;
      if (base.wall[facet][edge] || base.neighbour(edge, facet) < 0) continue;
      next = base.neighbour(edge, facet);
      break;
    }
    if (next < 0 || step == most_steps) return false;
    if (next == before) break;  // over the edge between both
    before = facet, facet = next;
  }
  double fourth = 0;
  stand_on_face(base, x, p, {facet, geometry::Kind::facet, 0}, false, nullptr, over, fourth);
  foot.facet = facet;
  foot.nodes = fourth != 0 ? 4 : 3;
  for (int I = 0; I < 3; ++I) foot.node[I] = base.facets(I, facet), foot.weight[I] = over.weight[I];
  if (fourth != 0) foot.node[3] = base.half[facet].fourth, foot.weight[3] = fourth;
  foot.normal = over.normal, foot.height = over.height;
  return true;
}

double allowance(const Interface& interface, const Vectors& x, Index apex, Index facet) {
  const Vec3 into = -facet_normal(interface.base, x, facet);
  std::array<Vec3, 16> normal;
  std::size_t count = 0;
  Vec3 mean = Vec3::Zero();
  for (Index s = interface.faces.begin[apex]; s < interface.faces.begin[apex + 1] && count < normal.size(); ++s) {
    const Face face = face_at(interface.faces, x, interface.faces.shares[static_cast<std::size_t>(s)].face);
    if (face.normal.dot(into) < facing) continue;
    normal[count++] = face.normal;
    mean += face.normal;
  }
  double least = 1;
  mean.normalize();
  for (std::size_t i = 0; i < count; ++i) least = std::min(least, normal[i].dot(mean));
  const double turn = std::acos(std::clamp(least, -1.0, 1.0));
  const double depth = between(interface, apex, facet).depth;
  const double sag = interface.base.size(facet) * (always_allowed + (turn < most_turn ? per_turn * turn : 0));
  return depth > 0 ? std::min(sag, most_allowed * depth) : sag;
}

void add_to(Index node, const Vec3& push, bool of_apex_side, PointWork& work) {
  auto& place = work.place[static_cast<std::size_t>(node)];
  const auto at = static_cast<std::size_t>(place);
  if (at < work.sum.size() && work.sum[at].node == node) {
    work.sum[at].push += push;
    return;
  }
  place = static_cast<std::int32_t>(work.sum.size());
  work.sum.push_back({node, push, of_apex_side});
}

OverPoints sum_points(const Interface& interface, const Vectors& x, Index apex, Index facet, PointWork& work) {
  OverPoints sum;
  const Index node = interface.apexes[apex];
  work.sum.clear();
  add_to(node, Vec3::Zero(), true, work);
  const auto add_point = [&](const Face& face, double area, const auto& phi, const Foot& foot) {
    for (int j = 0; j < face.corners; ++j) add_to(face.node[j], area * phi(j) * foot.normal, true, work);
    for (int l = 0; l < foot.nodes; ++l) add_to(foot.node[l], -area * foot.weight[l] * foot.normal, false, work);
    sum.gap += area * (foot.height - stand_off(interface.base, foot.facet));
    sum.normal += area * foot.normal;
  };
  for (Index s = interface.faces.begin[apex]; s < interface.faces.begin[apex + 1]; ++s) {
    const mesh::FacesAround::Share& share = interface.faces.shares[static_cast<std::size_t>(s)];
    FacePoints& points = work.of_face[static_cast<std::size_t>(share.face)];
    const Face& face = face_of(interface.faces, x, share.face, work);
    if (points.step != work.step || !is_same_part(interface, x, points, facet)) {
      find_points(interface.base, x, face, facet, points);
      points.step = work.step;
    }
    const int corner = corner_of(face, node);
    if (points.lies == Lies::leaning) sum.of_node += share.area;
    if (points.lies == Lies::whole) {
      sum.area += share.area;
      for (int q = 0; q < face.corners; ++q)
        add_point(face, share.area * dual(face.corners, q, corner), [&](int j) { return shape(face.corners, q, j); },
                  points.foot[static_cast<std::size_t>(q)]);
    }
    if (points.lies != Lies::in_part) continue;
    const double area = share.area / points_of_corner;
    bool takes = false;
    for (std::size_t k = 0; k < points.foot.size(); ++k) {
      if (points.taken_by[k] != corner || points.foot[k].facet < 0) continue;
      takes = true;
      sum.area += area;
      const std::array<double, 4>& phi = shape_of_part(face.corners, k);
      add_point(face, area, [&](int j) { return phi[static_cast<std::size_t>(j)]; }, points.foot[k]);
    }
    sum.covered_elsewhere = sum.covered_elsewhere || !takes;
  }
  return sum;
}

}  // namespace nereid::contact
