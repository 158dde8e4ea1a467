#pragma once
// Points of the bilinear surface of a quadrilateral:  s = sum of w_I x_I,  w = ((1-a)(1-b), a(1-b), a b, (1-a) b).

#include <array>

#include "base/types.hpp"

namespace nereid::geometry {

/// A point of a bilinear surface, seen from a point p.
struct OnQuadrilateral {
  double a, b;      ///< [-] 0 to 1 on the face
  Vec3 by_a, by_b;  ///< [m] ds/da, ds/db
  Vec3 way;         ///< [m] p - s
};

/// Weights of the corners at (a, b); they sum to one.
inline std::array<double, 4> weights_at(double a, double b) { return {(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b}; }

/// The point of the bilinear surface that is closest to p: the way from there is along the normal,  (p - s) . ds/da = (p - s) . ds/db = 0.
///
/// corner  around the face
/// at      a, b: where to begin
/// returns whether there is one, on the face or a quarter of its sides beyond
bool closest_on_quadrilateral(const std::array<Vec3, 4>& corner, const Vec3& p, OnQuadrilateral& at);

/// Weights of the corners at the point of the bilinear surface that lies on the line through p along n.
///
///     s = p - h n
///
/// corner  around the face;  n  unit vector, not in the face
/// a, b    where to begin: at best the place of p on the half of the face that it is over
/// weight  set if there is such a point, on the face or a quarter of its sides beyond; they sum to one
/// returns whether there is one
bool bilinear_weights(const std::array<Vec3, 4>& corner, const Vec3& p, const Vec3& n, double a, double b, std::array<double, 4>& weight);

}  // namespace nereid::geometry
