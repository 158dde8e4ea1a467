#pragma once
// How single hexahedra bend, to compare neighbours.

#include <array>
#include <numbers>

#include "element/block.hpp"
#include "element/hexahedron.hpp"

namespace nereid::element {

/// Bending of an element from its positions and its hourglass forces.
///
///     moment = sum over nodes of f (x) d (x) d,     d from the centre
///
/// It does not depend on how nodes are numbered, and of equal cells that bend alike it is the same. Sums of products of its components do
/// not depend on the direction of the axes. Cells of unlike size that bend alike count as uneven in part. A side leans if it stands at 20
/// degrees or more to where it would on a brick: cells five times as long as high that lean so deflect by 0.74 of what they should, or by
/// 0.19 where they lean in turns. Cells that lean less differ in their moments: verification/one_layer_bends has a table.
///
/// x  [m];  Q  [N] over eight, of the hourglass modes
inline Bending bending_of(const std::array<Vector<double>, 8>& x, const std::array<Vector<double>, 4>& Q) {
  constexpr double too_much = 0.35;              // [-] sine of 20 degrees
  constexpr double root = std::numbers::sqrt2;   // in a sum of squares, xy stands for yx too
  const Modes<double> X = scaled(0.125, sums_by_mode(x));
  const Vector<double> none{0, 0, 0};
  const auto force = nodal_values(Modes<double>{none, none, none, Q}), offset = nodal_values(X);
  Bending bending{};
  for (int a = 0; a < 8; ++a) {
    const Vector<double>&f = force[a], &d = offset[a];
    const double products[6] = {d.x * d.x, d.y * d.y, d.z * d.z, root * d.x * d.y, root * d.y * d.z, root * d.x * d.z};
    for (int i = 0; i < 3; ++i)
      for (int p = 0; p < 6; ++p) bending.moment[static_cast<std::size_t>(6 * i + p)] += f[i] * products[p];
  }
  const std::array<Vector<double>, 3> g{X.xi, X.eta, X.zeta};
  for (int k = 0; k < 3; ++k) {
    const auto &a = g[static_cast<std::size_t>((k + 1) % 3)], &b = g[static_cast<std::size_t>((k + 2) % 3)];
    const double cosine = dot(a, b) / (norm(a) * norm(b));
    // side k tilts by the two modes that grow with coordinate k
    const auto &h = X.hourglass[static_cast<std::size_t>((k + 1) % 3)], &i = X.hourglass[static_cast<std::size_t>((k + 2) % 3)];
    const Vector<double>& own = g[static_cast<std::size_t>(k)];
    const double size = dot(own, own), tilt = std::max(norm(cross(h, own)), norm(cross(i, own))) / size;
    if (!(std::abs(cosine) < too_much) || !(tilt < too_much)) bending.leans = true;
  }
  return bending;
}

}  // namespace nereid::element
