#include "contact/tracking/points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

#include "base/gather.hpp"
#include "base/parallel.hpp"
#include "contact/surface/face.hpp"

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
constexpr double per_turn = 0.25;     // of the side of the base

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

using PointShapes = std::array<std::array<double, 4>, 4>;
PointShapes make_point_shapes(int corners, const ByDistance& shape) {
  PointShapes all{};
  for (int q = 0; q < corners; ++q)
    for (int j = 0; j < corners; ++j) all[static_cast<std::size_t>(q)][static_cast<std::size_t>(j)] = shape(corners, q, j);
  return all;
}
const PointShapes points_of_3 = make_point_shapes(3, shape_3), points_of_4 = make_point_shapes(4, shape_4);

/// Shape functions of a face at its Gauss points.
const std::array<double, 4>& shape_at_points(int corners, std::size_t point) { return (corners == 4 ? points_of_4 : points_of_3)[point]; }
const PointShapes duals_of_3 = make_point_shapes(3, dual_3), duals_of_4 = make_point_shapes(4, dual_4);

/// Dual weights of the corners at a Gauss point.
const std::array<double, 4>& duals_at(int corners, std::size_t point) { return (corners == 4 ? duals_of_4 : duals_of_3)[point]; }

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

/// A point of a face, and the facet over whose plane it stands.
struct Point {
  Vec3 place;
  Index facet = -1;
  FeatureHeight over;
};

/// The half of a bilinear face by which it is named, whichever of them a point is over; a facet that is a face of its own.
Index named_half(const BaseSurface& base, Index facet) {
  const int cut = base.half[facet].cut;
  return cut < 0 ? facet : std::min(facet, base.neighbour(cut, facet));
}

/// Sets the feet of points over the bilinear faces that their facets are halves of, or over the facets; a pack of points at a time. The
/// iteration begins in the middle of a face, so that no foot depends on where it was before.
///
/// points  a facet of -1 has no foot
/// all_inside  if not null, whether every point is over the inside of its face
void find_feet(const BaseSurface& base, const Vectors& x, std::span<const Point> points, std::span<Foot> feet, bool* all_inside = nullptr) {
  constexpr double edge = 1e-6;  // of a face: points that are nearer to its edge are looked for
  for (std::size_t first = 0; first < points.size(); first += lanes) {
    const std::size_t count = std::min<std::size_t>(lanes, points.size() - first);
    alignas(64) std::array<double, lanes> px, py, pz;
    std::array<std::array<Index, lanes>, 4> node;
    std::array<bool, lanes> on_face;
    std::size_t filler = lanes;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Point& one = points[first + lane];
      on_face[lane] = one.facet >= 0 && base.half[one.facet].cut >= 0;
      if (!on_face[lane]) continue;
      const Half& half = base.half[one.facet];
      const auto corner = [&](int local) { return base.facets(local % 3, one.facet); };
      node[0][lane] = corner(half.cut), node[1][lane] = half.fourth;
      node[2][lane] = corner(half.cut + 1), node[3][lane] = corner(half.cut + 2);
      px[lane] = one.place.x(), py[lane] = one.place.y(), pz[lane] = one.place.z();
      filler = lane;
    }
    alignas(64) std::array<std::array<double, lanes>, 4> weight;
    alignas(64) std::array<std::array<double, lanes>, 3> normal;
    alignas(64) std::array<double, lanes> height;
    Mask<Pack> stands(false), well_inside(false);
    if (filler < lanes) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (lane < count && on_face[lane]) continue;
        for (auto& row : node) row[lane] = row[filler];
        px[lane] = px[filler], py[lane] = py[filler], pz[lane] = pz[filler];
      }
      Vector<Pack> place;
      read_lanes(px.data(), place.x), read_lanes(py.data(), place.y), read_lanes(pz.data(), place.z);
      std::array<Vector<Pack>, 4> corner;
      for (std::size_t I = 0; I < 4; ++I) corner[I] = gather(x.data(), node[I].data()) - place;
      OverFace<Pack> over;
      over.at.a = over.at.b = Pack(0.5);
      stands = stand_over(corner, over);
      well_inside = over.at.a > Pack(edge) && over.at.a < Pack(1 - edge) && over.at.b > Pack(edge) && over.at.b < Pack(1 - edge);
      for (std::size_t I = 0; I < 4; ++I) write_lanes(over.weight[I], weight[I].data());
      for (int axis = 0; axis < 3; ++axis) write_lanes(over.normal[axis], normal[static_cast<std::size_t>(axis)].data());
      write_lanes(over.height, height.data());
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Point& one = points[first + lane];
      Foot& foot = feet[first + lane];
      foot.facet = one.facet;
      const bool has_foot = one.facet >= 0 && on_face[lane] && stands[static_cast<int>(lane)];
      if (all_inside) *all_inside = *all_inside && has_foot && well_inside[static_cast<int>(lane)];
      if (one.facet < 0) continue;
      const Half& half = base.half[one.facet];
      for (int I = 0; I < 3; ++I) foot.node[I] = base.facets(I, one.facet), foot.weight[I] = one.over.weight[I];
      foot.nodes = 3, foot.normal = one.over.normal, foot.height = one.over.height;
      if (!has_foot) continue;
      foot.weight[half.cut] = weight[0][lane], foot.weight[(half.cut + 1) % 3] = weight[2][lane];
      foot.weight[(half.cut + 2) % 3] = weight[3][lane];
      foot.nodes = 4, foot.node[3] = half.fourth, foot.weight[3] = weight[1][lane];
      foot.normal = {normal[0][lane], normal[1][lane], normal[2][lane]}, foot.height = height[lane];
    }
  }
}

/// Finds the feet of points of a face; without a facet where there is none, or far away from it.
///
/// shape(k)  shape functions of the face at point k
/// last      facets where the points may still be; empty: not known
/// is_same_part(foot)  whether a foot there would be of the part of the base that `from` is of
template <class Shape, class SamePart>
void find_feet_of(const BaseSurface& base, const Vectors& x, const Face& face, Index from, Shape&& shape, std::span<const Index> last,
                  SamePart&& is_same_part, std::span<Foot> feet) {
  std::array<Point, static_cast<std::size_t>(4 * points_of_corner)> all;
  const std::span points = std::span(all).first(feet.size());
  bool known = !last.empty();
  for (std::size_t k = 0; k < feet.size(); ++k) {
    const std::array<double, 4>& phi = shape(k);
    points[k].place.setZero();
    for (int j = 0; j < face.corners; ++j) points[k].place += phi[static_cast<std::size_t>(j)] * x.col(face.node[j]);
    if (!last.empty()) points[k].facet = last[k], known = known && last[k] >= 0;
  }
  if (known) find_feet(base, x, points, feet, &known);
  known = known && std::all_of(feet.begin(), feet.end(), is_same_part);
  if (!known) {
    for (Point& one : points) {
      const Index facet = facet_below(base, x, one.place, from, one.over);
      one.facet = facet < 0 ? -1 : named_half(base, facet);
      if (one.facet != facet) one.over = height_over(base, x, {one.facet, geometry::Kind::facet, 0}, one.place);
    }
    find_feet(base, x, points, feet);
  }
  for (Foot& foot : feet)
    if (foot.facet >= 0 && (foot.height < -deepest * face.side || foot.height > farthest * face.side)) foot.facet = -1;
}

/// Shares a point out over the corners of a face that have most points of their own: the nearest of them, or several that are as near.
std::array<double, 4> share_out(const std::array<double, 4>& phi, int corners, const std::array<int, 4>& count, int most) {
  constexpr double as_near = 1e-9;  // of a shape function: these are the same numbers but for round-off
  double largest = 0;
  int sharing = 0;
  std::array<double, 4> part{};
  const auto has_most = [&](std::size_t j) { return count[j] == most; };
  for (std::size_t j = 0; j < static_cast<std::size_t>(corners); ++j)
    if (has_most(j)) largest = std::max(largest, phi[j]);
  for (std::size_t j = 0; j < static_cast<std::size_t>(corners); ++j)
    if (has_most(j) && phi[j] > largest - as_near) part[j] = 1, ++sharing;
  for (double& one : part) one /= sharing;
  return part;
}

/// Finds the feet of the points of a face that is covered in part, and who takes them: those of a corner that has not all of them are taken
/// by the nearest corners that have most, so that no two conditions are nearly the same.
void find_parts(const BaseSurface& base, const Vectors& x, const Face& face, Index from, FacePoints& points) {
  const auto all = static_cast<std::size_t>(points_of_corner * face.corners);
  points.foot.resize(all), points.taken_by.resize(all);
  std::array<int, 4> count{};
  find_feet_of(base, x, face, from, [&](std::size_t k) -> const auto& { return shape_of_part(face.corners, k); }, {},
               [](const Foot&) { return true; }, points.foot);
  for (std::size_t k = 0; k < all; ++k)
    if (points.foot[k].facet >= 0) ++count[k / points_of_corner];
  const int most = *std::max_element(count.begin(), count.end());
  for (std::size_t k = 0; k < all; ++k) {
    const std::size_t corner = k / points_of_corner;
    points.taken_by[k] = {};
    if (count[corner] == points_of_corner) points.taken_by[k][corner] = 1;
    else points.taken_by[k] = share_out(shape_of_part(face.corners, k), face.corners, count, most);
  }
}

/// The part of a base that a facet belongs to: of its body, and turned like it.
struct PartOfBase {
  const Subset& of_facet;
  Index facet;
  Vec3 normal;

  PartOfBase(const Interface& interface, const Vectors& x, Index one)
      : of_facet(interface.bodies.of_facet), facet(one), normal(facet_normal(interface.base, x, one)) {}
  bool has(const Foot& foot) const {
    return foot.facet >= 0 && foot.normal.dot(normal) > plain &&
           (of_facet.empty() || of_facet[static_cast<std::size_t>(foot.facet)] == of_facet[static_cast<std::size_t>(facet)]);
  }
};

/// Whether the feet that were found for another apex are over the same part of the base.
bool is_same_part(const Interface& interface, const Vectors& x, const FacePoints& points, Index from) {
  if (points.from == from) return true;
  const PartOfBase part(interface, x, from);
  return std::any_of(points.foot.begin(), points.foot.end(), [&](const Foot& foot) { return part.has(foot); });
}

/// Whether a face turns to the side of the base that a facet is on.
bool faces(const BaseSurface& base, const Vectors& x, const Face& face, Index facet) {
  return -face.normal.dot(facet_normal(base, x, facet)) >= facing;
}

/// Finds how a face lies on the part of a base that a facet belongs to, and where its points are.
void find_points(const Interface& interface, const Vectors& x, const Face& face, Index from, FacePoints& points) {
  const BaseSurface& base = interface.base;
  points.foot.assign(static_cast<std::size_t>(face.corners), {});
  points.lies = Lies::apart;
  const PartOfBase part(interface, x, from);
  const auto corners = static_cast<std::size_t>(face.corners);
  find_feet_of(base, x, face, from, [&](std::size_t q) -> const auto& { return shape_at_points(face.corners, q); },
               std::span(points.last).first(corners), [&](const Foot& foot) { return part.has(foot); }, points.foot);
  for (std::size_t q = 0; q < corners; ++q) points.last[q] = points.foot[q].facet;
  int found = 0;
  bool is_near = false, leans = false;
  for (std::size_t q = 0; q < points.foot.size(); ++q) {
    const Foot& foot = points.foot[q];
    if (foot.facet < 0) continue;
    ++found;
    is_near = is_near || foot.height < close * face.side;
    leans = leans || -foot.normal.dot(face.normal) < plain;
    for (std::size_t before = 0; before < q; ++before) {
      const Foot& other = points.foot[before];
      leans = leans || (other.facet >= 0 && foot.normal.dot(other.normal) < plain);
    }
  }
  if (leans) points.lies = Lies::leaning;
  else if (found == face.corners) points.lies = Lies::whole;
  else if (found > 0 && is_near) find_parts(base, x, face, from, points), points.lies = Lies::in_part;
}

/// Sums what points give each corner of a face, and what the nodes of the face and of its base get of it.
void sum_by_corner(const BaseSurface& base, FacePoints& points) {
  const Face& face = points.face;
  points.corner = {};
  points.base.clear();
  if (points.lies != Lies::whole && points.lies != Lies::in_part) return;
  const bool whole = points.lies == Lies::whole;
  const auto corners = static_cast<std::size_t>(face.corners);
  std::array<std::array<std::size_t, 4>, static_cast<std::size_t>(4 * points_of_corner)> place;  // of the nodes of feet in points.base
  for (std::size_t q = 0; q < points.foot.size(); ++q) {
    const Foot& foot = points.foot[q];
    for (std::size_t l = 0; foot.facet >= 0 && l < static_cast<std::size_t>(foot.nodes); ++l) {
      const auto at = std::find(points.base.begin(), points.base.end(), foot.node[l]);
      place[q][l] = static_cast<std::size_t>(at - points.base.begin());
      if (at == points.base.end()) points.base.push_back(foot.node[l]);
    }
  }
  using Four = Eigen::Array4d;  // of the corners
  const std::size_t nodes = corners + points.base.size();
  constexpr std::size_t most_nodes = 4 + 4 * 4 * points_of_corner;
  std::array<double, 12 * most_nodes> by_node;  // [4 corners x 3 axes x nodes]
  std::fill_n(by_node.begin(), 12 * nodes, 0.0);
  const auto add = [&](std::size_t node, const Vec3& part, const Four& weight) {
    double* at = &by_node[12 * node];
    for (int axis = 0; axis < 3; ++axis) Eigen::Map<Four>(at + 4 * axis) += part(axis) * weight;
  };
  Four gap = Four::Zero(), part = gap, nx = gap, ny = gap, nz = gap;
  for (std::size_t q = 0; q < points.foot.size(); ++q) {
    const Foot& foot = points.foot[q];
    if (foot.facet < 0) continue;
    const std::array<double, 4>& phi = whole ? shape_at_points(face.corners, q) : shape_of_part(face.corners, q);
    Four weight = Four::Zero();
    if (whole) weight = Eigen::Map<const Four>(duals_at(face.corners, q).data());
    else weight = Eigen::Map<const Four>(points.taken_by[q].data()) / points_of_corner;
    gap += (foot.height - stand_off(base, foot.facet)) * weight, part += weight;
    nx += foot.normal.x() * weight, ny += foot.normal.y() * weight, nz += foot.normal.z() * weight;
    for (std::size_t j = 0; j < corners; ++j) add(j, phi[j] * foot.normal, weight);
    for (std::size_t l = 0; l < static_cast<std::size_t>(foot.nodes); ++l)
      add(corners + place[q][l], -foot.weight[l] * foot.normal, weight);
  }
  points.push.resize(corners * nodes);
  const auto size = [](double value) { return std::abs(value) < no_weight ? 0 : value; };  // dual weights leave round-off
  for (std::size_t a = 0; a < corners; ++a) {
    const auto i = static_cast<Eigen::Index>(a);
    points.corner[a] = {whole ? 1 : part(i), gap(i), Vec3(nx(i), ny(i), nz(i))};
    for (std::size_t node = 0; node < nodes; ++node) {
      const double* at = &by_node[12 * node + a];
      points.push[a * nodes + node] = {size(at[0]), size(at[4]), size(at[8])};
    }
  }
}

/// Finds the points of a face from a facet on, and sums them by corner.
void measure(const Interface& interface, const Vectors& x, const Face& face, Index from, std::int64_t step, FacePoints& points) {
  find_points(interface, x, face, from, points);
  sum_by_corner(interface.base, points);
  points.step = step, points.from = from;
}

}  // namespace

void begin_points(const Interface& interface, const Vectors& x, PointWork& work) {
  constexpr Index faces_of_a_thread = 16;
  ++work.step;
  std::swap(work.used, work.used_before);
  work.used.clear();
  parallel_for(static_cast<Index>(work.used_before.size()), faces_of_a_thread, [&](Index i) {
    const Index f = work.used_before[static_cast<std::size_t>(i)];
    FacePoints& points = work.of_face[static_cast<std::size_t>(f)];
    const Face& face = face_of(interface.faces, x, f, work);
    if (faces(interface.base, x, face, points.from)) measure(interface, x, face, points.from, work.step, points);
  });
}

Index facet_below(const BaseSurface& base, const Vectors& x, const Vec3& p, Index from, FeatureHeight& over) {
  Index before = -1, facet = from;
  for (int step = 0;; ++step) {
    over = height_over(base, x, {facet, geometry::Kind::facet, 0}, p);
    const auto& w = over.weight;
    if (std::min({w[0], w[1], w[2]}) >= -inside) return facet;
    std::array<int, 3> order{0, 1, 2};
    if (w[1] < w[0]) std::swap(order[0], order[1]);
    if (w[2] < w[static_cast<std::size_t>(order[1])]) std::swap(order[1], order[2]);
    if (w[static_cast<std::size_t>(order[1])] < w[static_cast<std::size_t>(order[0])]) std::swap(order[0], order[1]);
    Index next = -1;
    for (const int corner : order) {
      if (w[static_cast<std::size_t>(corner)] >= -inside) break;
      const int edge = (corner + 1) % 3;
      if (base.wall[facet][edge] || base.neighbour(edge, facet) < 0) continue;
      next = base.neighbour(edge, facet);
      break;
    }
    if (next < 0 || step == most_steps) return -1;
    if (next == before) return facet;  // over the edge between both
    before = facet, facet = next;
  }
}

bool find_foot(const BaseSurface& base, const Vectors& x, const Vec3& p, Index from, Foot& foot) {
  Point point{p, -1, {}};
  point.facet = facet_below(base, x, p, from, point.over);
  if (point.facet < 0) return false;
  find_feet(base, x, {&point, 1}, {&foot, 1});
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

namespace {

/// Where a node is in PointWork::place, or the free place where it belongs.
std::size_t place_of(Index node, const PointSum& work) {
  const std::size_t last = work.place.size() - 1;
  std::size_t at = (static_cast<std::uint32_t>(node) * 2654435761U >> 16) & last;  // Knuth's multiplicative hash
  while (work.place[at] >= 0 && work.sum[static_cast<std::size_t>(work.place[at])].node != node) at = (at + 1) & last;
  return at;
}

/// Begins the sum of an apex.
void begin_sum(Index node, PointSum& work) {
  constexpr std::size_t usual_places = 128;
  work.sum.clear();
  work.place.assign(std::max(usual_places, work.place.size()), -1);
  add_to(node, Vec3::Zero(), true, work);
}

/// The points of a face over the part of the base that a facet belongs to, measured in this step; null if the face does not turn to it.
const FacePoints* points_over(const Interface& interface, const Vectors& x, Index f, Index facet, const PointWork& work, PointSum& range) {
  const FacePoints& known = work.of_face[static_cast<std::size_t>(f)];
  if (known.measured == work.step) {
    if (!faces(interface.base, x, known.face, facet)) return nullptr;
    if (known.step == work.step && is_same_part(interface, x, known, facet)) {
      if (range.used.empty() || range.used.back() != f) range.used.push_back(f);
      return &known;
    }
  }
  const auto end = range.aside.begin() + static_cast<std::ptrdiff_t>(range.set_aside);
  auto at = std::find_if(range.aside.begin(), end, [&](const PointsAside& one) { return one.of_face == f; });
  if (at == end) {
    const Face face = known.measured == work.step ? known.face : face_at(interface.faces, x, f);
    if (!faces(interface.base, x, face, facet)) return nullptr;
    if (range.set_aside == range.aside.size()) range.aside.emplace_back();
    at = range.aside.begin() + static_cast<std::ptrdiff_t>(range.set_aside++);
    at->of_face = f;
    at->points.face = face, at->points.last = known.last;
    at->points.measured = work.step, at->points.step = -1;
  }
  FacePoints& points = at->points;
  if (!faces(interface.base, x, points.face, facet)) return nullptr;
  if (points.step != work.step || !is_same_part(interface, x, points, facet)) measure(interface, x, points.face, facet, work.step, points);
  return &points;
}

}  // namespace

void begin_range(PointSum& range) {
  range.used.clear();
  range.set_aside = 0;
}

void end_range(PointSum& range, PointWork& work) {
  const auto use = [&](Index f) {
    FacePoints& points = work.of_face[static_cast<std::size_t>(f)];
    if (points.used != work.step) points.used = work.step, work.used.push_back(f);
  };
  for (const Index f : range.used) use(f);
  for (std::size_t i = 0; i < range.set_aside; ++i) {
    PointsAside& one = range.aside[i];
    FacePoints& known = work.of_face[static_cast<std::size_t>(one.of_face)];
    if (one.points.step != work.step || known.used == work.step) continue;
    one.points.used = known.used;
    std::swap(known, one.points);
    use(one.of_face);
  }
}

void add_to(Index node, const Vec3& push, bool of_apex_side, PointSum& work) {
  const std::size_t at = place_of(node, work);
  if (work.place[at] >= 0) {
    work.sum[static_cast<std::size_t>(work.place[at])].push += push;
    return;
  }
  work.place[at] = static_cast<std::int32_t>(work.sum.size());
  work.sum.push_back({node, push, of_apex_side});
  if (2 * work.sum.size() < work.place.size()) return;
  work.place.assign(2 * work.place.size(), -1);  // many faces around an apex, each over many of the base
  for (std::size_t i = 0; i < work.sum.size(); ++i) work.place[place_of(work.sum[i].node, work)] = static_cast<std::int32_t>(i);
}

OverPoints sum_points(const Interface& interface, const Vectors& x, Index apex, Index facet, const PointWork& work, PointSum& range) {
  OverPoints sum;
  const Index node = interface.apexes[apex];
  begin_sum(node, range);
  for (Index s = interface.faces.begin[apex]; s < interface.faces.begin[apex + 1]; ++s) {
    const mesh::FacesAround::Share& share = interface.faces.shares[static_cast<std::size_t>(s)];
    const FacePoints* found = points_over(interface, x, share.face, facet, work, range);
    if (found == nullptr) continue;
    const FacePoints& points = *found;
    const Face& face = points.face;
    if (points.lies == Lies::leaning) sum.of_node += share.area;
    if (points.lies != Lies::whole && points.lies != Lies::in_part) continue;
    const auto a = static_cast<std::size_t>(corner_of(face, node));
    const CornerSum& of_corner = points.corner[a];
    sum.covered_elsewhere = sum.covered_elsewhere || !(of_corner.part > 0);
    if (!(of_corner.part > 0)) continue;
    sum.area += share.area * of_corner.part, sum.gap += share.area * of_corner.gap, sum.normal += share.area * of_corner.normal;
    const Vec3* push = &points.push[a * (static_cast<std::size_t>(face.corners) + points.base.size())];
    const auto add = [&](Index one, bool of_apex_side) {
      if (!push->isZero(0)) add_to(one, share.area * *push, of_apex_side, range);
      ++push;
    };
    for (int j = 0; j < face.corners; ++j) add(face.node[j], true);
    for (const Index of_base : points.base) add(of_base, false);
  }
  return sum;
}

}  // namespace nereid::contact
