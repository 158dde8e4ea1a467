#pragma once
// How contact is enforced, and what multipliers remember of a node.

namespace nereid::contact {

/// What keeps two surfaces apart.
enum class Method {
  penalty,     ///< a spring that is pressed
  multiplier,  ///< the smallest impulses after which no gap is negative, see multiplier/enforce.hpp
};

/// What a multiplier has taken from a node that it stopped, and gives back at its release: docs/theory/multipliers.md.
struct Restitution {
  double held = 0;        ///< [J]; negative: a deficit, more than it held was given
  double kept = 0;        ///< [J] part of it that is given back whole: its loss was taken at an earlier release
  double mean_force = 0;  ///< [N] over twice the time that a wave takes through the node's own mass
  double most_force = 0;  ///< [N] largest of that since it last took energy
  double last_loss = 0;   ///< [s] when it last took energy
  double blow = 0;        ///< [N s] between rigid bodies: normal impulse since first touch, along which `held` is given back; 0: no blow
};

/// Books what a node holds as lost that is no longer near what it touched.
inline void discard(Restitution& memory, double& impact) {
  impact += memory.held > 0 ? memory.held : 0;
  memory = {};
}

/// Whether a contact or rigid plane acts by multipliers.
template <class Contact>
bool by_multipliers(const Contact& contact) {
  return contact.method == Method::multiplier;
}

}  // namespace nereid::contact
