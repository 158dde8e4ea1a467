#pragma once
// A liquid by its shock velocity.

#include <algorithm>
#include <cmath>

#include "material/fluid.hpp"

namespace nereid::material {

/// Mie and Grueneisen's law about the line of shocks  Us = c + s up,  with mu = 1 - V/V0:
///
///     p = pH (1 - G mu/2) + G e,     pH = density c^2 mu / (1 - s mu)^2 in compression,  density c^2 mu in tension
///
/// no lower than the cut-off. Grueneisen's ratio goes with the volume: (ratio)(density) = G density0, as most programs have it.
struct MieGruneisen {
  static constexpr std::array internal = shown_of_fluids;
  static constexpr std::array<Variable, 0> tensors{};
  double density, sound_speed, slope, gamma;  // [kg/m3] [m/s] [-] [-]
  double cutoff = 0;                          // [Pa] lowest pressure: bubbles keep it
};

inline double bulk_modulus_at_start(const MieGruneisen& law) { return law.density * law.sound_speed * law.sound_speed; }

/// The pressure without energy, and its derivative by mu. [Pa]
template <class T>
struct ColdPressure {
  T value, slope;
};

constexpr double closest_to_infinite = 0.05;  ///< [-] least 1 - s mu that counts: beyond, no shock goes

/// returns  pH (1 - G mu/2) and its derivative
template <class T>
NEREID_HOT ColdPressure<T> cold_pressure(const MieGruneisen& law, T mu) {
  const T K(bulk_modulus_at_start(law)), s(law.slope), one(1.0), zero(0.0), half_gamma(0.5 * law.gamma);
  const T left = larger(one - s * larger(mu, zero), T(closest_to_infinite)), per = one / left;
  const T shock = K * mu * per * per, by_mu = select(mu > zero, K * (one + s * mu) * per * per * per, K);
  const T share = one - half_gamma * mu;
  return {shock * share, by_mu * share - half_gamma * shock};
}

/// The state of a pressure [Pa], with the energy of its shock,  e = p mu/2:  then  p = pH,  whatever Grueneisen's ratio, so mu is a root of
///
///     p (1 - s mu)^2 = K mu,   in tension of  p = K mu
///
/// Needs    a pressure below highest_start(law)
inline FluidState<double> start_at(const MieGruneisen& law, double pressure) {
  const double K = bulk_modulus_at_start(law), sp = law.slope * std::max(0.0, pressure);
  const double mu = 2 * pressure / (K + 2 * sp + std::sqrt(K * (K + 4 * sp)));
  return {1.0 - mu, pressure, 0.5 * pressure * mu};
}

/// The pressure of a shock beyond which  1 - s mu  or the volume is nearly none. [Pa]
inline double highest_start(const MieGruneisen& law) {
  const MieGruneisen cold{law.density, law.sound_speed, law.slope, 0};
  return cold_pressure(cold, (1 - closest_to_infinite) / std::max(1.0, law.slope)).value;
}

/// Carries a state to the volume `ratio`.
template <class T>
NEREID_HOT FluidResponse<T> update_pressure(const MieGruneisen& law, T ratio, FluidState<T>& state) {
  const T gamma(law.gamma);
  const ColdPressure<T> cold = cold_pressure(law, T(1.0) - ratio);
  FluidResponse<T> response = carry_over(cold.value, gamma, ratio, T(law.cutoff), state);
  const T now = ratio * (cold.slope + gamma * state.pressure);
  response.modulus = select(state.pressure <= T(law.cutoff), smaller(now, T(bulk_modulus_at_start(law))), now);  // bubbles have none
  return response;
}

template <class T>
NEREID_HOT T void_part(const MieGruneisen& law, const FluidState<T>& state) {
  // in tension the law is all but linear
  const T open = T(1.0) - (T(law.cutoff) - T(law.gamma) * state.energy) / T(bulk_modulus_at_start(law));
  return select(state.pressure <= T(law.cutoff), larger(T(0.0), T(1.0) - open / state.ratio), T(0.0));
}

static_assert(FluidLaw<MieGruneisen>);

}  // namespace nereid::material
