#pragma once
// The energy that multipliers take from nodes that they stop, and give back as these are released.

#include <algorithm>
#include <span>

#include "contact/multiplier/condition.hpp"

namespace nereid::contact {

/// What steps may let bodies ring, by central differences, over the energy of the scene. [-]
constexpr double most_ringing = 0.02;

/// How long a step may be in which nodes are stopped, and those after it while contacts hold what was taken from them:
///
///     sum of b dt^2 / 4 tau^2 <= 0.02 E,    tau = m / Z
///
/// with b what is held, m the mass and Z the impedance of a node. A layer of elements whose node is stopped rings with a force F up to Z v,
/// and central differences let that have dt^2/8 F^2/m too much energy (docs/theory/central_differences.md).
struct BlowLimit {
  double step = 1e300;  ///< [s]
  double energy = 0;    ///< [J] E
  std::size_t of = 0;   ///< the contact, or the plane after all contacts, that asks most
  Index node = -1;
};

/// The limit by the works of this step, before release().
///
/// energy    [J] E, or less where it is not known: it is no less than the sum of b
/// goes_on   whether steps are shorter for a blow: else only nodes count that come in much faster than forces move them in a step
BlowLimit limit_of_blows(double energy, bool goes_on, const Multipliers&);

/// Gives back what released contactors hold: those without a force, or with one that has fallen to what only what they hold could make.
void release(const Motion&, double t, Multipliers&);

/// Brings what is held up to date with the works of the step.
///
/// returns  what was taken for good [J]
double update_restitution(const Motion&, double t, Pool&, Multipliers&);

/// Covers the deficits of contactors, that have given more than they held, from all of some pools in proportion to what each holds. What
/// remains is created energy, until they take it back from the nodes.
void balance(std::span<Pool>, Multipliers&);

/// The same of what friction has given in a step: that of the other pools covers it as far as it reaches.
void balance_friction(std::span<Pool>);

/// Covers what friction has given in a step and no other friction took from what the contactors of its own pool hold.
void pay_for_friction(Pool&, Multipliers&);

/// What contactors hold, without deficits. [J]
double held(Index first, Index last, const Multipliers&);

/// What a contact or rigid plane by multipliers has given without having held it, and has not taken back yet: the deficits of its nodes or
/// edges and of its friction. It is created until then. [J]
double deficit(const Memory&);
double deficit(const EdgeMemory&);
double deficit(const PlaneMemory&);

/// Ends a contactor: what its coefficient gives back of what it holds goes to Multipliers::unreleased, the rest is lost. A deficit stays
/// created.
template <class Memory>
void end(std::span<const Index> nodes, double coefficient, Restitution& restitution, Memory& memory, Multipliers& all) {
  if (restitution.held > 0) {
    const double lost = (1 - coefficient * coefficient) * std::max(0.0, restitution.held - restitution.kept);
    memory.impact += lost;
    Unreleased& one = all.unreleased.emplace_back();
    one.nodes = static_cast<int>(nodes.size());
    std::copy(nodes.begin(), nodes.end(), one.node.begin());
    one.energy = restitution.held - lost;
    one.impact = &memory.impact, one.transferred = &memory.transferred;
  }
  restitution = {};
}

/// Spreads what ended contactors have not released over those of their nodes where conditions act. Where none acts it is lost.
void spread_unreleased(Multipliers&);

/// Gives the contactors of a contact, first to last, the part of this at their nodes; its loss has been taken.
void take_unreleased(Index first, Index last, double& transferred, Multipliers&);

}  // namespace nereid::contact
