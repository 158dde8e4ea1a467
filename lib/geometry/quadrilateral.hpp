#pragma once
// Bilinear weights of a point over a quadrilateral.

#include <array>

#include "base/types.hpp"

namespace nereid::geometry {

/// Weights of the corners at the point of the bilinear surface that lies on the line through p along n.
///
///     sum of w_I x_I = p - h n,   w = ((1-a)(1-b), a(1-b), a b, (1-a) b)
///
/// corner  around the face;  n  unit vector, not in the face
/// a, b    where to begin: at best the place of p on the half of the face that it is over
/// weight  set if there is such a point, on the face or a quarter of its sides beyond; they sum to one
/// returns whether there is one
bool bilinear_weights(const std::array<Vec3, 4>& corner, const Vec3& p, const Vec3& n, double a, double b, std::array<double, 4>& weight);

}  // namespace nereid::geometry
