#include "mesh/round_body.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "base/check.hpp"

namespace nereid::mesh {

using geometry::PlacedRound;
using geometry::Round;
using geometry::RoundKind;

namespace {

/// The node with the largest of some measure.
template <class Measure>
Index most(const Subset& nodes, Measure&& measure) {
  Index best = nodes.front();
  double largest = -1;
  for (const Index node : nodes)
    if (const double here = measure(node); here > largest) best = node, largest = here;
  return best;
}

}  // namespace

std::optional<Round> round_of(const Sphere& sphere) {
  if (sphere.part != SpherePart::full) return std::nullopt;
  return Round{.kind = RoundKind::sphere, .radius = sphere.radius};
}

std::optional<Round> round_of(const Cylinder& cylinder) {
  if (cylinder.turn != Revolution::full) return std::nullopt;
  return Round{.kind = RoundKind::cylinder, .radius = cylinder.radius, .half_length = cylinder.length / 2};
}

std::optional<Round> round_of(const Tube& tube, double thickness) {
  if (tube.turn != Revolution::full) return std::nullopt;
  return Round{.kind = RoundKind::tube, .radius = tube.radius, .half_length = tube.length / 2, .half_thickness = thickness / 2};
}

std::optional<Round> round_of(const Revolved& revolved) {
  if (!is_whole_turn(revolved) || revolved.radii.size() != 2 || revolved.heights.size() != 2) return std::nullopt;
  return Round{.kind = RoundKind::ring, .radius = revolved.radii[1], .inner = revolved.radii[0],
               .half_length = (revolved.heights[1] - revolved.heights[0]) / 2};
}

Vec3 centre_of(const Sphere&) { return Vec3::Zero(); }
Vec3 centre_of(const Cylinder& cylinder) { return {0, 0, cylinder.length / 2}; }
Vec3 centre_of(const Tube& tube) { return {0, 0, tube.length / 2}; }
Vec3 centre_of(const Revolved& revolved) { return {0, 0, (revolved.heights[0] + revolved.heights[1]) / 2}; }

RoundBody tied(const Round& shape, const PlacedRound& at, const Vectors& x, const Subset& nodes) {
  RoundBody body;
  body.shape = shape;
  const auto place = [&](Index node) { return Vec3(x.col(node)); };
  auto& [a, b, c, d] = body.anchor;
  a = most(nodes, [&](Index node) { return (place(node) - at.centre).squaredNorm(); });
  b = most(nodes, [&](Index node) { return (place(node) - place(a)).squaredNorm(); });
  c = most(nodes, [&](Index node) { return (place(b) - place(a)).cross(place(node) - place(a)).squaredNorm(); });
  const Vec3 normal = (place(b) - place(a)).cross(place(c) - place(a));
  d = most(nodes, [&](Index node) { return std::abs(normal.dot(place(node) - place(a))); });
  Eigen::Matrix4d places;
  for (int k = 0; k < 4; ++k) places.col(k) << place(body.anchor[static_cast<std::size_t>(k)]) - at.centre, 1;
  check(std::abs(places.determinant()) > 0, "a round body needs nodes that are not all in a plane");
  const Eigen::Matrix4d inverse = places.inverse();
  Mat3 frame;
  frame << at.axis, at.across, at.axis.cross(at.across);
  body.at_centre = inverse.col(3);
  body.along = inverse.leftCols<3>() * frame;
  return body;
}

PlacedRound placed(const RoundBody& body, const Vectors& x) {
  Eigen::Matrix<double, 3, 4> places;
  for (int k = 0; k < 4; ++k) places.col(k) = x.col(body.anchor[static_cast<std::size_t>(k)]);
  const Vec3 origin = places.col(0);
  const Eigen::Matrix<double, 3, 4> from = places.colwise() - origin;  // so that differences keep their digits
  PlacedRound at;
  at.centre = origin + from * body.at_centre;
  at.axis = (from * body.along.col(0)).normalized();
  const Vec3 across = from * body.along.col(1);
  at.across = (across - at.axis.dot(across) * at.axis).normalized();
  return at;
}

Eigen::Vector4d weights_at(const RoundBody& body, const PlacedRound& at, const Vec3& point) {
  const Vec3 arm = point - at.centre;
  return body.at_centre + body.along * Vec3(at.axis.dot(arm), at.across.dot(arm), at.axis.cross(at.across).dot(arm));
}

}  // namespace nereid::mesh
