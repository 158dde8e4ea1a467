#pragma once
// What multipliers take from nodes that they stop, and give back as these let go.

#include "contact/condition.hpp"

namespace nereid::contact {

/// Gives back what contactors hold that let go: without a force, or with one that is only what it stands for itself.
void let_go(const Motion&, const Parts&, double t, Multipliers&);

/// Brings what is held up to date with the works of the step.
///
/// returns  what was taken for good [J]
double keep(const Motion&, double t, Index first, Index last, Multipliers&);

/// What some contactors have given too much is taken from all of some pools in proportion; what all cannot pay stays owed.
void pay(std::span<const Pool>, Multipliers&);

/// What is still owed is created.
void forget_debts(Index first, Index last, Multipliers&);

/// What contactors hold. [J]
double held(Index first, Index last, const Multipliers&);

/// What goes with a node that is no longer near what it touched is lost.
void lose(Restitution&, double& impact);

}  // namespace nereid::contact
