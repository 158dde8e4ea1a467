#pragma once
// Corners of hexahedra: what the volume of an element, and one point in its middle, do not see.

#include "element/block.hpp"

namespace nereid::element {

/// The corner of a block whose Jacobian has become smallest.
struct Corner {
  double ratio = 1;    ///< [-] Jacobian over that of the reference; not positive: inverted; NaN if a position is
  Index element = -1;  ///< -1: no element has corners to look at
};

/// The smallest corner Jacobian of the hexahedra of a block, over those of the reference; of plates there is none.
///
/// At node a with its three edges e1, e2, e3:  J = e1 x e2 . e3.  A corner whose edges lie in a plane in the reference, as where
/// two nodes of a wedge are one, is passed over.
///
/// X [m] reference positions, x [m] positions now, [3 x nodes]
Corner smallest_corner(const AnyBlock&, const Vectors& X, const Vectors& x);

}  // namespace nereid::element
