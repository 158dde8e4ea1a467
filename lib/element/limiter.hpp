#pragma once
// The limiter of viscosity: which part of it the motion along an axis of an element gets, from the strains of the step before there and
// beside it. Linear strains get none, a front all, and what turns from element to element too: docs/theory/viscosity.md.

#include <vector>

#include "base/gather.hpp"
#include "base/types.hpp"
#include "element/tiles.hpp"
#include "element/viscosity.hpp"

namespace nereid::element {

/// How far a strain is from what the two beside it let expect, after the limiter of Christensen:
///
///     min(1, 2 (|e| - phi) / (|e| + 1e-12))^2,     phi = max(0, min(mean, 2 least, |e|))
///
/// size, mean, least  [-] |e|, and of the strains beside it with the sign of e as plus
/// returns            [-] zero where strains are linear, or far below 1e-12 in a step; one where none beside it is half its size
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
  std::vector<double> spread;  ///< what elements share
};
Departures departures_for(const Tiling&);

/// Departures from the strains along the axes, spread once over the sides of triangles, whose fronts cross cells in any direction.
///
/// along  [-] [packs x axes x lanes] of the step before
void find_departures(const Tiling&, const std::vector<Index>& beside, const std::vector<double>& along, Departures&);

/// The largest departure of an element and of those beside it, by axis.
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
