#pragma once
// The quality of elements during a run: inverted corners, hourglass energy, thicknesses that should have changed and nodes of plates that
// spin about their normals, which stop nothing and spoil results.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// Steps between two looks at the corners of all elements: less than a hundredth of the time of a step each.
constexpr std::int64_t corners_every = 500;

/// The energy of nodes of a block of plates that spin about their normals, beyond that of the plate's own rotation in its plane:
///     sum over nodes of  1/2 inertia max(0, (omega . n)^2 - w^2)
/// Where plates meet at an angle each resists the spin of the other: nodes whose normals differ by more than some degrees are left out.
Spin free_spin(const Model&, std::size_t block, const State&);

/// Notes what the elements of each block have come to. Needs a ledger that is current.
///
/// look  whether corners are looked at in any case: as a look for overlaps is due, or the run ends
void see_quality(const Model&, bool look, State&);

/// The largest hourglass energy of a block over its largest internal energy so far; zero where the latter is round-off. [-]
///
/// Internal energy is all that the block stores and has dissipated, hourglass energy included.
/// scale  [J] energy_scale() of the ledger
double hourglass_fraction(const Quality&, double scale);

}  // namespace nereid::dynamics
