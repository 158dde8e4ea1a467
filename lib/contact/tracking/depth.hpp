#pragma once
// How deep apexes are, for the largest penetration of a run.

#include "contact/data/memory.hpp"

namespace nereid::contact {

/// By how much the layers of an apex and of a body that presses it overlap where the apex stands, of the deepest such body. [m]
///
///     h_c - s,   s the distance of the apex from the body: negative behind the surface of a solid; a sheet has the apex in front
///
/// Negative where no layers overlap; -infinity of an apex without a condition; the depth of its element where no facets of the body are
/// near.
double overlap_of(const Interface&, const Vectors& x, const Near&, const Memory&);

/// Remembers the depth of an apex that is the deepest so far. A deep one may stand beside the body that it is pushed out of, near another
/// of its faces, past a rim or between folds: it is no deeper than its layer and that of the body overlap, overlap_of().
void update_deepest(const Interface&, const Vectors& x, const Near&, Memory&);

}  // namespace nereid::contact
