#pragma once
// How far the step of a penalty is below its frequency: longer until the ledger sees what the contact creates.

#include <algorithm>

namespace nereid::contact {

/// What a penalty remembers of its step limit.
struct StepFactorMemory {
  double lowered_at = -1;  ///< [s] when the ledger saw too much created or lost energy; negative: never
  double least_created = 0, most_created = 0;  ///< [J] what the account had created whenever nothing was stored: smallest and largest
};

/// dt omega of the step limit of an interface or rigid plane by a penalty. [-]
///
/// `first_step_factor` until the contact has created or lost more than its energy-gain limit allows, then `impact_step_factor` for good;
/// never below that: docs/theory/contact_energy.md.
template <class Contact>
double step_factor(const Contact& contact, const StepFactorMemory& memory) {
  return memory.lowered_at < 0 ? std::max(contact.first_step_factor, contact.impact_step_factor) : contact.impact_step_factor;
}

}  // namespace nereid::contact
