#pragma once
// Round shapes: sphere, cylinder, ring and tube, with the exact distance of a point from each.
//
// A sphere has a centre. All others have an axis through the centre, from -half_length to half_length along it: a cylinder is solid, a ring
// has a bore, and a tube is all that is no farther than half_thickness from a sheet that is rolled up to the radius, so its rims are round.

#include <vector>

#include "base/types.hpp"

namespace nereid::geometry {

enum class RoundKind { sphere, cylinder, ring, tube };

struct Round {
  RoundKind kind = RoundKind::sphere;
  double radius = 0;          ///< [m] of a tube, of its sheet
  double inner = 0;           ///< [m] of the bore of a ring
  double half_length = 0;     ///< [m] not of a sphere
  double half_thickness = 0;  ///< [m] of a tube
};

/// Where a shape stands: three unit vectors at right angles.
struct PlacedRound {
  Vec3 centre = Vec3::Zero();  ///< [m]
  Vec3 axis = Vec3::UnitZ(), across = Vec3::UnitX();
};

/// How a point stands over a shape.
struct OverRound {
  double distance;  ///< [m] from its surface; negative inside
  Vec3 normal;      ///< unit vector: the gradient of the distance, outwards
};
/// The distance of a point. With rho and z of the point in the shape's own cylindrical coordinates, it is that of a point in the plane from
/// a rectangle, or of a tube from a segment.
OverRound over_round(const Round&, const PlacedRound&, const Vec3& point);

/// Radius of a sphere around all of a shape. [m]
double reach(const Round&);
/// Radius of the outer side about the axis. [m]
double outer_radius(const Round&);
/// Radius of the bore of a ring or a tube; zero of others. [m]
double bore_radius(const Round&);

/// A circle of a shape about its axis, where a side ends: a sharp edge, or the middle of the round rim of a tube.
struct Rim {
  double radius;  ///< [m]
  double along;   ///< [m] place along the axis
};
/// None of a sphere, two of a cylinder and a tube, four of a ring.
std::vector<Rim> rims(const Round&);

/// The middle of a rim, a point of it at an angle from `across`, and the direction along which that angle grows.
Vec3 rim_centre(const Rim&, const PlacedRound&);
Vec3 rim_point(const Rim&, const PlacedRound&, double angle);
Vec3 rim_tangent(const PlacedRound&, double angle);
/// The angle of the point of a rim that is farthest along a direction. [rad]
double rim_angle(const PlacedRound&, const Vec3& direction);

}  // namespace nereid::geometry
