#pragma once
// Which bodies of an automatic contact a search has to look at.

#include "contact/data/workspace.hpp"

namespace nereid::contact {

constexpr double farther_from_itself = 0.25;  ///< of the margin: so much farther a search looks how far a body is from itself

/// Finds which bodies are so near to each other that they may touch before the next search.
///
/// A body is a partner of itself unless a search has found its folds apart and its shape has changed by less since, whatever its rigid
/// motion.
void find_partners(const Sides&, const Vectors& x, const SidesMemory&, SearchWork&);

/// Whether a body is a partner of itself.
bool searches_itself(const SearchWork&, Index body);

/// Notes which of the bodies that were searched are far from themselves: none of SearchWork::near_itself, and none if plates may grow
/// thicker.
void keep_apart_from_itself(const Sides&, const Vectors& x, bool may_thicken, const SearchWork&, SidesMemory&);

}  // namespace nereid::contact
