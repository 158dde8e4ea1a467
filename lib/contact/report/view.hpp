#pragma once
// Contact elements as output and probes show them.

#include <array>

#include "contact/data/memory.hpp"

namespace nereid::contact {

/// One potential contact element as it stands, for output and tests.
struct ElementView {
  Index apex;                    ///< node
  Feature feature;               ///< facet -1 where lost
  std::array<double, 3> weight;  ///< of the foot on the facet's nodes
  double gap, traction;          ///< [m], [Pa] compression positive, without what contact damping adds
  double shear_traction;         ///< [Pa] of friction, not negative
  bool slides;                   ///< friction is at its limit
  Status status;
  std::int64_t reconnections;
};
ElementView view(const Interface&, const Vectors& x, const Memory&, Index apex);

/// The smallest distance of any apex from the base less its h_c, by a search of its own where no apex is near. [m]
///
/// reach  [m] NaN if none is nearer
double least_gap(const Interface&, const Vectors& x, const Memory&, double reach);

}  // namespace nereid::contact
