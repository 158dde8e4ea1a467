#pragma once
// The energy that multipliers take from nodes that they stop, and give back as these are released.

#include <algorithm>
#include <span>

#include "contact/condition.hpp"

namespace nereid::contact {

/// Gives back what released contactors hold: those without a force, or with one that only what they hold could make.
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

/// What a contact or rigid plane by multipliers has given without having held it, and has not taken back yet: the deficits of its nodes and
/// of its friction. It is created until then. [J]
template <class Memory>
double owed(const Memory& memory) {
  double sum = memory.friction_owed;
  for (const Restitution& one : memory.restitution) sum += one.held < 0 ? -one.held : 0;
  return sum;
}

/// Books what a node holds as lost that is no longer near what it touched.
void discard(Restitution&, double& impact);

/// Ends what a contactor between some nodes holds; hand_on() says what becomes of it.
template <class Memory>
void leave_behind(std::span<const Index> nodes, Restitution& restitution, Memory& memory, Multipliers& all) {
  if (restitution.held > 0) {
    LeftBehind& left = all.left_behind.emplace_back();
    left.nodes = static_cast<int>(nodes.size());
    std::copy(nodes.begin(), nodes.end(), left.node.begin());
    left.held = restitution.held, left.kept = restitution.kept;
    left.impact = &memory.impact, left.transferred = &memory.transferred;
  }
  restitution = {};
}

/// Spreads what has been left behind over the nodes where it was held and conditions act. What was held where none act is lost.
void find_heirs(Multipliers&);

/// Gives a contact's contactors, first to last, what was left behind at their nodes.
void inherit(Index first, Index last, double& transferred, Multipliers&);

}  // namespace nereid::contact
