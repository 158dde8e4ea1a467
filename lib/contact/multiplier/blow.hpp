#pragma once
// Blows between rigid bodies: the energy that contact takes while bodies are stopped, and the impulses that give it back.
//
// Contactors of all connected pairs of bodies share a blow. Impulses J stopped them, and took the energy E in all. When the bodies do not
// approach each other any more, impulses s J act at once, with the s >= 0 for which they give back e^2 of what each contactor took:
//
//     sum of 1/2 J_k (v_b + v_a)_k  over all steps of the blow  =  - sum of (1 - e_k^2) E_k
//
// This is Poisson's hypothesis for the direction of the release and Stronge's for its size. If the blow is simultaneous and frictionless,
// then s = e: each contactor that was pressed leaves with e times the rate of its approach, and for e = 1 the kinetic energy is that
// before. docs/theory/multipliers.md.

#include <span>

#include "contact/multiplier/condition.hpp"

namespace nereid::contact {

/// Finds the blows that end in this step: marks contactors between rigid bodies, and takes what is lost of what they hold.
///
/// returns  whether there are any
bool find_blows(const Motion&, Multipliers&);

/// Adds to the impulses of the blows until these have given back their energy; friction follows. Needs find_blows().
void give_back_blows(const Motion&, Multipliers&);

/// Shares out what is left of each blow over its contactors, by their impulses in the blow. Single contactors have given more or less than
/// they held, since each one acts at the rates that all of them make.
void share_out_blows(std::span<Pool>, Multipliers&);

/// Adds the impulse of the step to that of the blow of a contactor, or ends the blow if the contactor has given back what it held.
void update_blow(const Contactor&, const Multipliers&);

}  // namespace nereid::contact
