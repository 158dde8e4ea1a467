#pragma once
// What a contact finds before the first step.

#include <array>
#include <vector>

#include "base/types.hpp"

namespace nereid::contact {

/// Spacing of the nodes of one surface over that of the other, in the direction of the surface where it is largest. [-]
struct Coarseness {
  double apexes = 0;  ///< of the apexes over the base; zero where none was looked for, or no apex faces the base
  double base = 0;    ///< of the base over the apexes: what it would be with the sides exchanged
};

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
  Index free = 0;                           ///< apexes of a tied interface that stand past its border or have no base: nothing holds them
  double deepest = 0;                       ///< [m] penetration, positive
  Index pairs = 0;                          ///< of edges within the margin, of edges over edges; the numbers above are then of these
  std::array<Index, 4> by_kind{};           ///< apexes by Kind of feature
  std::vector<SlightOverlap> slight_overlaps;  ///< of round-off size, beyond that of the program itself
  Coarseness coarseness;                    ///< of a single pass: see coarseness.hpp
};

}  // namespace nereid::contact
