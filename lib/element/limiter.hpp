#pragma once
// The limiter of viscosity: which share of it the motion along an axis of an element gets, from the strains of the step before there and
// beside it. The share is zero where the strain varies linearly. It is one at a front, and where the sign alternates from element to
// element: docs/theory/viscosity.md.

#include <vector>

#include "base/gather.hpp"
#include "base/types.hpp"
#include "element/tiles.hpp"
#include "element/viscosity.hpp"

namespace nereid::element {

/// How far a strain is from a smooth continuation of its neighbours' strains, after the limiter of Christensen:
///
///     min(1, 2 (|e| - phi) / (|e| + 1e-12))^2,     phi = max(0, min(mean, 2 least, |e|))
///
/// size, mean, least  [-] |e|, and of the strains beside it with the sign of e as plus
/// returns            [-] zero where strains are linear and the smaller neighbour has at least half of |e|, and where they are far below
///                    1e-12 in a step; one where the mean of the neighbours is at most half of |e|, or the least at most a quarter
template <class T>
NEREID_HOT T departure(T size, T mean, T least) {
  const T phi = larger(T(0.0), smaller(size, smaller(mean, T(2.0) * least)));
  const T part = smaller(T(1.0), T(2.0) * (size - phi) / (size + T(1e-12)));
  return part * part;
}

/// Where the strains beside an element lie, one place for each of its sides: of a hexahedron 2 k and 2 k + 1 across its axis k, of a
/// triangle side a from node a to the next.
///
/// The place is that of the neighbour's own axis through the face that both share. Sides on the surface of the block, those that have
/// collapsed to an edge or a point, and those of more than two elements have the element's own place.
///
/// nodes    [8 or 3 x elements]
/// returns  [packs x sides x lanes] places in a table [packs x axes x lanes]; a triangle has one axis
std::vector<Index> places_beside(const Tiling&, const Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic>& nodes);

/// Departures of all elements. [-] [packs x axes x lanes] scratch of a step
struct Departures {
  std::vector<double> own;     ///< of triangles only
  std::vector<double> spread;  ///< what shares_of() takes: of hexahedra their own, of triangles the largest of each and its neighbours
};
/// Room for them; none without viscosity.
Departures departures_for(const Tiling&, bool is_viscous);

/// Departures from the strains along the axes, spread once over the sides of triangles, whose fronts cross cells in any direction.
///
/// along  [-] [packs x axes x lanes] of the step before
void find_departures(const Tiling&, const std::vector<Index>& beside, const std::vector<double>& along, Departures&);

/// The largest departure of an element and of those beside it, by axis. Fillers of a pack have their own alone.
///
/// departures  [-] [packs x axes x lanes];  beside  of the pack
template <int axes, int sides>
NEREID_HOT Shares<Pack, axes> shares_of(const double* departures, std::size_t pack, const Index* beside) {
  constexpr int of_axis = sides / axes;
  Shares<Pack, axes> share;
  for (int k = 0; k < axes; ++k) {
    Pack& most = share[static_cast<std::size_t>(k)];
    read_lanes(departures + (pack * axes + static_cast<std::size_t>(k)) * lanes, most);
    for (int s = k * of_axis; s < (k + 1) * of_axis; ++s) most = larger(most, gather_numbers(departures, beside + s * lanes));
  }
  return share;
}

}  // namespace nereid::element
