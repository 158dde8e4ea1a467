#pragma once
// What single hexahedra hold by their strain and by bending within them, to compare neighbours.

#include <algorithm>
#include <array>
#include <cmath>

#include "element/block.hpp"
#include "element/full_hexahedron.hpp"
#include "element/hexahedron.hpp"

namespace nereid::element {

/// Whether a side stands at 20 degrees or more to where it would on a brick: cells five times as long as high that lean so deflect by 0.74
/// of what they should, or by 0.19 where they lean in turns (verification/one_layer_bends has a table).
///
/// x  [m]
inline bool leans(const std::array<Vector<double>, 8>& x) {
  constexpr double too_much = 0.35;  // [-] sine of 20 degrees
  const Modes<double> X = sums_by_mode(x);
  const std::array<Vector<double>, 3> g{X.xi, X.eta, X.zeta};
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>((k + 1) % 3), j = static_cast<std::size_t>((k + 2) % 3);
    const Vector<double>& own = g[static_cast<std::size_t>(k)];
    const double cosine = dot(g[i], g[j]) / (norm(g[i]) * norm(g[j]));
    // side k tilts by the two modes that grow with coordinate k
    const double tilt = std::max(norm(cross(X.hourglass[i], own)), norm(cross(X.hourglass[j], own))) / dot(own, own);
    if (!(std::abs(cosine) < too_much) || !(tilt < too_much)) return true;
  }
  return false;
}

/// What a hexahedron holds: of its mean stress by Hooke's law, and what assumed strains or springs store.
///
/// x  [m]
template <class Law>
Held held_by(const Block<Hexahedron, Law>& block, const Hexahedron::Constants<double>& constants,
             const Hexahedron::Memory<double, Law>& memory, const std::array<Vector<double>, 8>& x) {
  using Kind = Hexahedron::Hourglass;
  const double volume = volume_gradient(scaled(0.125, sums_by_mode(x))).volume;
  double bending = memory.bent;
  if (block.options.hourglass_kind == Kind::stiffness && constants.hourglass > 0) {
    bending = 0;
    for (const Vector<double>& force : memory.hourglass) bending += 0.5 * dot(force, force) / constants.hourglass;
  }
  const bool by_assumed_strain = block.options.hourglass_kind == Kind::assumed_strain;
  return {bending, volume * material::hooke_energy(block.law, memory.stress) + bending, volume, !by_assumed_strain || leans(x)};
}

/// The same with eight points: bending is what the energy of the points is beyond that of their mean stress.
template <class Law>
Held held_by(const Block<FullHexahedron, Law>& block, const FullHexahedron::Constants<double>&,
             const FullHexahedron::Memory<double, Law>& memory, const std::array<Vector<double>, 8>& x) {
  const double volume = volume_gradient(scaled(0.125, sums_by_mode(x))).volume, part = 1.0 / FullHexahedron::gauss_points;
  Symmetric<double> mean{0, 0, 0, 0, 0, 0};
  double strain = 0;
  for (const auto& point : memory.points) {
    mean = mean + part * point.stress;
    strain += part * material::hooke_energy(block.law, point.stress);
  }
  return {volume * std::max(strain - material::hooke_energy(block.law, mean), 0.0), volume * strain, volume, leans(x)};
}

}  // namespace nereid::element
