#pragma once
// Which features of other bodies the exact shapes of rigid bodies are near to.

#include "contact/data/memory.hpp"

namespace nereid::contact {

/// Lists the features that shapes are near to, nearer than the margin of a search.
void search_shapes(const Interface&, const Vectors& x, Memory&);

}  // namespace nereid::contact
