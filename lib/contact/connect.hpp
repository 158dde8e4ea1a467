#pragma once
// The start of a contact: first features of the apexes, contact heights, initial gaps.

#include <array>
#include <vector>

#include "contact/data/workspace.hpp"
#include "contact/report/coarseness.hpp"

namespace nereid::contact {

/// Part of the flattest element behind two surfaces by which they may overlap at the start. [-] It is round-off of whoever placed them.
constexpr double slight = 1e-6;

/// Apexes or edges of two bodies that overlap by no more than this part of an element at the start: they are taken as contact.
struct SlightOverlap {
  Index apex_body = -1, base_body = -1;  ///< in Bodies, the lower one first; -1 of a pair of surfaces
  Index count = 0;
  double deepest = 0;                    ///< [m] positive
};

/// What the broad search found before the first step.
struct InitialGaps {
  double least = 0, mean = 0, largest = 0;  ///< [m] over the apexes that have a base in front of them; 0 without any
  Index apexes = 0, without_base = 0;
  Index behind = 0;                         ///< apexes that stand behind the base without being in contact, as under a table
  Index penetrating = 0;                    ///< apexes nearer than h_c at the start
  Index free = 0;                           ///< apexes of a bonded interface that stand past its border or have no base: nothing holds them
  double deepest = 0;                       ///< [m] penetration, positive
  Index pairs = 0;                          ///< of edges within the margin, of edges over edges; the numbers above are then of these
  std::array<Index, 4> by_kind{};           ///< apexes by Kind of feature
  std::vector<SlightOverlap> slight_overlaps;  ///< of round-off size, beyond that of the program itself
  Coarseness coarseness;                    ///< of a single pass: see coarseness.hpp
};

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
