#include "geometry/round.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace nereid::geometry {

namespace {

/// Distance of a point in the plane from a rectangle, and its gradient there.
///
/// a, b  [m] how far the point is beyond the sides of the rectangle along both axes
double beyond(double a, double b, double& along_a, double& along_b) {
  if (a > 0 && b > 0) {
    const double d = std::hypot(a, b);
    along_a = a / d, along_b = b / d;
    return d;
  }
  along_a = a > b ? 1 : 0, along_b = a > b ? 0 : 1;
  return std::max(a, b);
}

}  // namespace

OverRound over_round(const Round& round, const PlacedRound& at, const Vec3& point) {
  const Vec3 arm = point - at.centre;
  if (round.kind == RoundKind::sphere) {
    const double d = arm.norm();
    return {d - round.radius, d > 0 ? Vec3(arm / d) : at.axis};
  }
  const double z = at.axis.dot(arm);
  const Vec3 radial = arm - z * at.axis;
  const double rho = radial.norm(), up = z < 0 ? -1 : 1;
  const Vec3 out = rho > 0 ? Vec3(radial / rho) : at.across;
  if (round.kind == RoundKind::tube) {
    const double a = rho - round.radius, b = std::max(0.0, std::abs(z) - round.half_length), d = std::hypot(a, b);
    if (!(d > 0)) return {-round.half_thickness, out};
    return {d - round.half_thickness, (a / d) * out + (up * b / d) * at.axis};
  }
  const double middle = 0.5 * (round.radius + round.inner);
  const bool bore = round.kind == RoundKind::ring && rho < middle;
  double along_a, along_b;
  const double distance =
      beyond(bore ? round.inner - rho : rho - round.radius, std::abs(z) - round.half_length, along_a, along_b);
  return {distance, (bore ? -along_a : along_a) * out + (up * along_b) * at.axis};
}

double reach(const Round& round) {
  return (round.kind == RoundKind::sphere ? round.radius : std::hypot(round.radius, round.half_length)) + round.half_thickness;
}

double outer_radius(const Round& round) { return round.radius + round.half_thickness; }

double bore_radius(const Round& round) {
  return round.kind == RoundKind::ring ? round.inner : round.kind == RoundKind::tube ? round.radius - round.half_thickness : 0;
}

std::vector<Rim> rims(const Round& round) {
  if (round.kind == RoundKind::sphere) return {};
  std::vector<Rim> list{{round.radius, -round.half_length}, {round.radius, round.half_length}};
  if (round.kind == RoundKind::ring) list.push_back({round.inner, -round.half_length}), list.push_back({round.inner, round.half_length});
  return list;
}

Vec3 rim_centre(const Rim& rim, const PlacedRound& at) { return at.centre + rim.along * at.axis; }

Vec3 rim_point(const Rim& rim, const PlacedRound& at, double angle) {
  return rim_centre(rim, at) + rim.radius * (std::cos(angle) * at.across + std::sin(angle) * at.axis.cross(at.across));
}

Vec3 rim_tangent(const PlacedRound& at, double angle) {
  return std::cos(angle) * at.axis.cross(at.across) - std::sin(angle) * at.across;
}

double rim_angle(const PlacedRound& at, const Vec3& direction) {
  return std::atan2(at.axis.cross(at.across).dot(direction), at.across.dot(direction));
}

}  // namespace nereid::geometry
