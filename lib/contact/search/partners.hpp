#pragma once
// Which bodies of an automatic contact a search has to look at.

#include "contact/data/workspace.hpp"

namespace nereid::contact {

constexpr double farther_from_itself = 0.25;  ///< of the margin: so much farther a search looks how far a body is from itself

/// Finds which bodies are so near to each other that they may touch before the next search.
///
/// A body is a partner of itself unless a search has found its folds apart and its shape has changed by less since, whatever its rigid
/// motion.
void find_partners(const Interface&, const Vectors& x, const Memory&, Workspace&);

/// Whether a body is a partner of itself.
bool searches_itself(const Workspace&, Index body);

/// Notes which of the bodies that were searched are far from themselves: none of Workspace::near_itself.
void keep_apart_from_itself(const Interface&, const Vectors& x, const Workspace&, Memory&);

}  // namespace nereid::contact
