#pragma once
// The quality of elements during a run: inverted corners, which end it; energy of artificial modes, elastic solids that are pressed too
// far, thicknesses that should have changed and nodes of plates that spin about their normals, which spoil results.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// The energy of nodes of a block of plates that spin about their normals, beyond that of the plate's own rotation in its plane:
///     sum over nodes of  1/2 inertia max(0, (omega . n)^2 - w^2)
/// Where plates meet at an angle each resists the spin of the other: nodes whose normals differ by more than some degrees are left out.
Spin free_spin(const Model&, std::size_t block, const State&);

/// Steps between two looks at the shapes of all elements: most, where they keep their shape, and least, where one is about to invert.
///
/// A look takes about as long as a step.
constexpr std::int64_t corners_every = 500, corners_least = 50;

/// Looks at the shapes of all elements if it is time: at half of the steps after which the smallest corner would invert at its pace.
///
/// look  whether to look in any case: as a look for overlaps is due, or the run ends
void check_elements(const Model&, bool look, State&);

/// The block whose smallest corner so far is at or below a limit, or -1.
int inverted_block(const State&, double limit);

/// Looks of a run, or of one of its stages, at how solid elements differ from their neighbours, at least, and steps between two, at most.
///
/// A look takes about as long as two steps.
constexpr int least_contrast_looks = 20;
constexpr std::int64_t contrast_every = 500;

/// Adds up how solid elements differ from their neighbours (element::contrast), if it is time.
///
/// end   [s] of the run or stage
/// look  whether to look in any case: as it ends
void compare_elements(const Model&, double end, bool look, State&);

/// What deformable solids hold by their strain, a mean over the looks of a run, and how much of it by elements unlike their neighbours.
///
/// returns  [-] bending and density over the strain, and the strain over the energy of the scene; strain zero where that is less than 1e-4,
///          which says nothing
element::Contrast contrast(const State&);

/// What all sources have dissipated by a channel over the energy of the scene; zero while nothing has moved. [-]
double dissipated_share(const Ledger&, Dissipated channel);

/// Notes how much energy each block has in artificial modes: hourglassing and distortion control of solids, drilling and residual bending
/// of plates. Needs a ledger that is current.
void check_artificial_energy(const Model&, State&);

/// An energy of a block, such as Quality::artificial, over its largest internal energy so far; zero where the latter is round-off. [-]
///
/// Internal energy is all that the block stores and has dissipated, that of artificial modes included.
/// scale  [J] energy_of_scene() of the ledger
double of_internal(const Quality&, double energy, double scale);

}  // namespace nereid::dynamics
