#pragma once
// Hooke's law in rate form.

#include "material/law.hpp"

namespace nereid::material {

/// Isotropic elasticity: the increment of stress is Hooke's of the increment of strain.
struct Elastic {
  static constexpr std::array<Variable, 0> internal{};
  static constexpr std::array<std::string_view, 0> tensors{};
  double density, young, poisson;  // [kg/m3] [Pa] [-]
};

/// Adds to the stress what Hooke's law makes of a strain increment:  s += lambda (tr e) 1 + 2 mu e.
///
/// All work is stored: 1/2 (old + new) : e is the change of the energy 1/2 s : C^-1 : s exactly.
/// That is an energy per *current* volume. As the volume changes with the strain, and as a law in
/// rates has no potential at large strain, what an element stores is an integral over its path;
/// only a cycle that closes in the frame of the law gives everything back.
///
/// increment  its strain, tensor components, in a frame that does not turn [-]
/// stress     Cauchy [Pa], old on entry and new on return
/// returns    work per current volume [J/m3] and the moduli, which are constant [Pa]
///
/// Invariants  stored + dissipated = 1/2 (old + new) : strain;  dissipated = 0;
///             a rotation of strain and stress rotates the result.
/// Needs       -1 < poisson < 1/2
template <class T>
NEREID_HOT Response<T> update_stress(const Elastic& law, const Increment<T, Symmetric>& increment, Symmetric<T>& stress,
                                     Internal<T, Elastic, Symmetric>& /*internal*/) {
  const Symmetric<T> old = stress;
  stress = old + hooke(law, increment.strain);
  return {{T(0.5) * contract(old + stress, increment.strain), T(0.0)}, lame(law)};
}

/// The same in a plate, which thins so that its zz stress stays zero and does no work.
template <class T>
NEREID_HOT Response<T> update_stress(const Elastic& law, const Increment<T, Plane>& increment, Plane<T>& stress,
                                     Internal<T, Elastic, Plane>& /*internal*/) {
  const Plane<T> old = stress;
  stress = old + hooke(law, increment.strain);
  return {{T(0.5) * contract(old + stress, increment.strain), T(0.0)}, lame(law)};
}

static_assert(PlateLaw<Elastic>);

}  // namespace nereid::material
