#pragma once
// Edges over edges: the fourth element of the family.
//
//       3                 Two edges cross, and no node of one body is inside the other: the nodes 1-2 of one and 3-4 of the other are
//        \     2          a tetrahedron of which they are opposite edges. Its height h = 6 V / |L1 x L2| is their distance, along the
//     1 --\-- /           normal of both (geometry/crossing.hpp). They touch where both lines are closest within both edges, and the
//          \             normal leads out of the ridge of each.
//           4
//
// A crossing has no tributary area, so it has no penalty: it acts by multipliers, also where its contact has a penalty, and sets no step.
// Nearly parallel edges have no crossing: their nodes are over the other edge, and apexes see that. docs/theory/contact.md, "Edges".

#include "contact/data/workspace.hpp"
#include "contact/multiplier/book.hpp"
#include "contact/multiplier/condition.hpp"

namespace nereid::contact {

/// Finds the conditions of crossings, with the impulses of the step before as a first guess. An edge that comes over another one sideways,
/// below it, starts with an offset.
///
/// Needs  look_ahead() for its nodes
void find_conditions(const EdgeContact&, const Motion&, EdgeMemory&, EdgeWorkspace&, Multipliers&);

/// Books the first half of the step that led to t, in which the forces of the memory have acted.
void book_first_half(const EdgeContact&, const Motion&, EdgeMemory&);

/// Writes the impulses of contactors `first` to `last` into the memory as forces over the time h [s]; t [s] now.
void take_over(const EdgeContact&, const Motion&, double h, double t, Index first, Index last, const Doing&, EdgeMemory&,
               const Multipliers&);

}  // namespace nereid::contact
