#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "contact/multiplier/shape_points.hpp"

namespace nereid::contact {

using geometry::OverRound;
using geometry::PlacedRound;
using geometry::Rim;
using geometry::Round;
using geometry::RoundKind;

namespace {

constexpr int looks_on_edge = 9, looks_around = 24;  // at which a slope is sampled
constexpr double no_slope = 1e-9;       // slope: with less of it at two samples in a row a distance has no minimum of its own there
constexpr double lies_flat = 0.1;         // sine between the axis of a shape and a normal: its ends lie nearly flat
constexpr double along_axis = 0.99;  // cosine between an edge and the axis of a shape
constexpr double no_tilt = 1e-9;     // sine: with less no point of a rim is the deepest one
constexpr double on_border = 1e-6;   // part of a facet or an edge: a foot that is so little outside is on it, and none falls between two
constexpr double same_axis = 1e-6;    // sine between axes
constexpr double too_deep = 0.25;    // of the smaller radius: what is farther inside is at another side
constexpr int deepest_part = 15, of_clips = 32;

/// The zero of a slope between two places where it has different signs, by the method of regula falsi with halved ends (Illinois).
template <class Slope>
double zero_of(Slope&& slope, double a, double at_a, double b, double at_b) {
  double c = a;
  for (int i = 0; i < 60 && std::abs(b - a) > 1e-15 * (std::abs(a) + std::abs(b)); ++i) {
    c = (a * at_b - b * at_a) / (at_b - at_a);
    const double at_c = slope(c);
    if (at_c == 0) return c;
    if ((at_c > 0) == (at_b > 0)) at_a *= 0.5;
    else a = b, at_a = at_b;
    b = c, at_b = at_c;
  }
  return c;
}

/// Calls visit(place) where a slope goes from negative to positive, between `from` and `to` or around a circle.
template <class Slope, class Visit>
void each_minimum(Slope&& slope, double from, double to, int looks, bool closed, Visit&& visit) {
  std::array<double, 32> s{};
  const auto place = [&](int i) { return from + (to - from) * i / looks; };
  const int count = closed ? looks : looks + 1;
  for (int i = 0; i < count; ++i) s[static_cast<std::size_t>(i)] = slope(place(i));
  const auto at = [&](int i) { return s[static_cast<std::size_t>(closed ? (i + looks) % looks : i)]; };
  const auto is_level = [&](int i) { return std::abs(at(i)) <= no_slope; };
  for (int i = 0; i < looks; ++i) {
    if (is_level(i)) {  // a minimum at a sample, not a part where nothing changes
      const bool inside = closed || i > 0;
      if (inside && !is_level(i - 1) && !is_level(i + 1) && at(i - 1) < 0 && at(i + 1) > 0)
        visit(zero_of(slope, place(i - 1), at(i - 1), place(i + 1), at(i + 1)));
    } else if (at(i) < 0 && !is_level(i + 1) && at(i + 1) > 0) {
      visit(zero_of(slope, place(i), at(i), place(i + 1), at(i + 1)));
    }
  }
}

/// Barycentric coordinates of the foot of a point on the plane of a triangle.
std::array<double, 3> weights_in(const std::array<Vec3, 3>& corner, const Vec3& p) {
  const Vec3 u = corner[1] - corner[0], v = corner[2] - corner[0], w = p - corner[0], n = u.cross(v);
  const double square = n.squaredNorm(), second = u.cross(w).dot(n) / square, first = w.cross(v).dot(n) / square;
  return {1 - first - second, first, second};
}

/// Calls visit(angle, part) for the points of a rim that may be closest to a plane with a normal: the deepest, and all around where the end
/// lies nearly flat.
template <class Visit>
void each_over_plane(const PlacedRound& at, const Vec3& normal, int rim, Visit&& visit) {
  const Vec3 down = normal.dot(at.axis) * at.axis - normal;
  const double tilt = down.norm();
  if (tilt > no_tilt) visit(geometry::rim_angle(at, down), parts_of_rim * rim + deepest_part);
  for (int i = 0; tilt < lies_flat && i < points_of_rim; ++i) visit(2 * pi * i / points_of_rim, parts_of_rim * rim + first_sample + i);
}

/// Where the rims of one shape are closest to another one.
///
/// sign  1 where normals lead out of the other shape, -1 where they lead into it
void spots_of_rims(const Round& one, const PlacedRound& at, const Round& other, const PlacedRound& there, double sign, int first_rim,
                   std::vector<Spot>& spots) {
  const double deep = -too_deep * std::min(geometry::outer_radius(one), geometry::outer_radius(other));
  const std::vector<Rim> rims = geometry::rims(one);
  for (std::size_t r = 0; r < rims.size(); ++r) {
    const auto over = [&](double angle) { return geometry::over_round(other, there, geometry::rim_point(rims[r], at, angle)); };
    const auto add = [&](double angle, int part) {
      const OverRound o = over(angle);
      const double gap = o.distance - one.half_thickness;
      if (gap < deep) return;
      const Vec3 place = geometry::rim_point(rims[r], at, angle) - 0.5 * (o.distance + one.half_thickness) * o.normal;
      spots.push_back({.part = part, .gap = gap, .normal = sign * o.normal, .place = place});
    };
    int part = parts_of_rim * (first_rim + static_cast<int>(r));
    each_minimum([&](double angle) { return over(angle).normal.dot(geometry::rim_tangent(at, angle)); }, 0, 2 * pi, looks_around, true,
                 [&](double angle) { add(angle, part++); });
    for (int i = 0; i < points_of_rim; ++i) {
      const double angle = 2 * pi * i / points_of_rim, sine = over(angle).normal.cross(at.axis).norm();
      if (sine < lies_flat) add(angle, parts_of_rim * (first_rim + static_cast<int>(r)) + first_sample + i);
    }
  }
}

/// Where the outer sides of two shapes cross as two lines do.
void spot_of_sides(const Round& one, const PlacedRound& at, const Round& other, const PlacedRound& there, std::vector<Spot>& spots) {
  const Vec3 across = at.axis.cross(there.axis), apart = there.centre - at.centre;
  const double sine = across.norm();
  if (!(sine > same_axis)) return;
  const double c = at.axis.dot(there.axis), d = at.axis.dot(apart), e = there.axis.dot(apart);
  const double s = (d - c * e) / (sine * sine), t = (c * d - e) / (sine * sine);
  if (std::abs(s) > one.half_length || std::abs(t) > other.half_length) return;
  const Vec3 way = apart + t * there.axis - s * at.axis;
  const double distance = way.norm(), R = geometry::outer_radius(one), Q = geometry::outer_radius(other), gap = distance - R - Q;
  if (!(distance > 0) || gap < -too_deep * std::min(R, Q)) return;
  const Vec3 normal = way / distance;
  spots.push_back({.part = -1, .gap = gap, .normal = normal, .place = at.centre + s * at.axis + (R + 0.5 * gap) * normal});
}

/// Where a sphere is closest to a shape: normals lead out of the sphere. In a bore it may touch the far side too.
void spots_of_sphere(const Round& sphere, const Vec3& centre, const Round& other, const PlacedRound& there, double sign,
                     std::vector<Spot>& spots) {
  const OverRound over = geometry::over_round(other, there, centre);
  const double gap = over.distance - sphere.radius;
  spots.push_back({.part = 0, .gap = gap, .normal = -sign * over.normal, .place = centre - (sphere.radius + 0.5 * gap) * over.normal});
  const double bore = geometry::bore_radius(other), z = there.axis.dot(centre - there.centre);
  if (!(bore > 0) || std::abs(z) > other.half_length) return;
  const Vec3 radial = centre - there.centre - z * there.axis;
  const double rho = radial.norm();
  if (!(rho > 0) || rho > bore) return;
  const Vec3 out = -radial / rho;
  const double far = bore + rho - sphere.radius;
  spots.push_back({.part = 1, .gap = far, .normal = sign * out, .place = centre + (sphere.radius + 0.5 * far) * out});
}

}  // namespace

void spots_on_edge(const Round& round, const PlacedRound& at, const std::array<Vec3, 2>& end, std::vector<Spot>& spots) {
  const Vec3 way = end[1] - end[0];
  const double length = way.norm();
  const Vec3 along = way / length;
  const auto add = [&](double s, int part) {
    if (!(s > -on_border && s < 1 + on_border)) return;
    const Vec3 p = end[0] + s * way;
    const OverRound over = geometry::over_round(round, at, p);
    spots.push_back({.part = part, .gap = over.distance, .normal = over.normal, .place = p, .weight = {1 - s, s, 0}});
  };
  if (round.kind == RoundKind::sphere) return add((at.centre - end[0]).dot(along) / length, 0);
  int part = 0;
  each_minimum([&](double s) { return geometry::over_round(round, at, end[0] + s * way).normal.dot(along); }, 0, 1, looks_on_edge, false,
               [&](double s) { add(s, part++); });
  const double z = at.axis.dot(end[0] - at.centre), rise = at.axis.dot(way), cosine = std::abs(rise) / length;
  if (cosine > along_axis)
    for (const int side : {-1, 1}) add((side * round.half_length - z) / rise, of_clips + (side > 0));
  if (cosine > lies_flat || round.kind == RoundKind::tube) return;
  const Vec3 radial = end[0] - at.centre - z * at.axis, beside = way - rise * at.axis;
  const double A = beside.squaredNorm(), B = radial.dot(beside);
  for (const double R : {round.radius, round.inner}) {
    const double C = radial.squaredNorm() - R * R, square = B * B - A * C;
    const int first = of_clips + (R == round.radius ? 2 : 4);
    if (R > 0 && square > 0)
      for (const int side : {-1, 1}) add((-B + side * std::sqrt(square)) / A, first + (side > 0));
  }
}

void spots_on_facet(const Round& round, const PlacedRound& at, const std::array<Vec3, 3>& corner, bool is_plate, bool whole,
                    std::vector<Spot>& spots) {
  Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  const double height = normal.dot(at.centre - corner[0]);
  if (is_plate && height < 0) normal = -normal;
  if (!is_plate && height < 0 && !whole) return;
  const auto add = [&](const Vec3& p, double radius, int part) {
    const double h = normal.dot(p - corner[0]);
    const std::array<double, 3> weight = weights_in(corner, p);
    if (!whole && *std::min_element(weight.begin(), weight.end()) < -on_border) return;
    spots.push_back({.part = part, .gap = h - radius, .normal = -normal, .place = p - h * normal, .weight = weight});
  };
  if (round.kind == RoundKind::sphere) return add(at.centre, round.radius, 0);
  const std::vector<Rim> rims = geometry::rims(round);
  for (std::size_t r = 0; r < rims.size(); ++r)
    each_over_plane(at, normal, static_cast<int>(r),
                    [&](double angle, int part) { add(geometry::rim_point(rims[r], at, angle), round.half_thickness, part); });
}

void spots_between(const Round& one, const PlacedRound& at, const Round& other, const PlacedRound& there, std::vector<Spot>& spots) {
  if (one.kind == RoundKind::sphere) return spots_of_sphere(one, at.centre, other, there, 1, spots);
  if (other.kind == RoundKind::sphere) return spots_of_sphere(other, there.centre, one, at, -1, spots);
  spot_of_sides(one, at, other, there, spots);
  spots_of_rims(one, at, other, there, -1, 0, spots);
  spots_of_rims(other, there, one, at, 1, 4, spots);
}

void spots_on_plane(const Round& round, const PlacedRound& at, const Vec3& point, const Vec3& normal, std::vector<Spot>& spots) {
  const auto add = [&](const Vec3& p, double radius, int part) {
    const double h = normal.dot(p - point);
    spots.push_back({.part = part, .gap = h - radius, .normal = -normal, .place = p - h * normal});
  };
  if (round.kind == RoundKind::sphere) return add(at.centre, round.radius, 0);
  const std::vector<Rim> rims = geometry::rims(round);
  for (std::size_t r = 0; r < rims.size(); ++r)
    each_over_plane(at, normal, static_cast<int>(r),
                    [&](double angle, int part) { add(geometry::rim_point(rims[r], at, angle), 0, part); });
}

}  // namespace nereid::contact
