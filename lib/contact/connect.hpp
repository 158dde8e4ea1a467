#pragma once
// The start of a contact: first features of the apexes, contact heights, initial gaps.

#include <array>
#include <vector>

#include "contact/data/initial_gaps.hpp"
#include "contact/data/workspace.hpp"

namespace nereid::contact {

/// How h_c is chosen: from the initial heights so that the initial gap is the clearance, or given.
struct ContactHeight {
  bool from_initial_height = true;
  double clearance = 0;  ///< [m]
  double given = 0;      ///< [m]
  bool from_thickness = false;  ///< given is that of plates, and follows it where it changes
};

/// Finds the first feature of every apex, sets h_c and reports the initial gaps.
///
/// reach  [m] apexes farther away have no base
/// Penetrations are reported and, where InitialPenetration::accept is not asked for, left for the
/// caller to refuse: nothing is pushed. Slight ones are accepted in any case.
InitialGaps connect(Interface&, const Vectors& x, double reach, const ContactHeight&, InitialPenetration, Memory&, Workspace&);

/// Finds the edges that are near each other at the start. Those that stand below the level at which they touch count as penetrating, but
/// for slight overlaps.
InitialGaps connect(const EdgeContact&, const Vectors& x, EdgeMemory&, EdgeWorkspace&);

/// The memory of an interface whose apexes all stand over their nearest facets, also those that are far: for damping, which goes by the
/// stiffest pair of all.
///
/// reach  [m] apexes farther away have no base
Memory tried_out(const Interface&, const Vectors& x, double reach, Workspace&);

}  // namespace nereid::contact
