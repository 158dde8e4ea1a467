#pragma once
// Contact heights that follow the thickness of plates.

#include "contact/data/memory.hpp"

namespace nereid::contact {

/// Lets the contact height follow the thickness of plates: that of an apex and that of the base below it.
///
/// What presses never becomes thicker: an h_c that falls takes tracks with it, and one that rises lets them rise as the apex leaves, since
/// a track that rose by itself would push in one step. An apex near its base is given no more than half its gap.
///
/// half_growth  [m] [nodes] by which half the thickness of plates has grown since the start; zero elsewhere
void follow_thickness(const Interface&, const Scalars& half_growth, Memory&);

}  // namespace nereid::contact
