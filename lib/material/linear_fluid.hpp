#pragma once
// A liquid whose pressure is linear in its volume.

#include "material/fluid.hpp"

namespace nereid::material {

/// p = K (1 - V/V0), no lower than the cut-off. For it the pressure of a wave is density c v exactly, at any strength.
struct LinearFluid {
  static constexpr std::array internal = shown_of_fluids;
  static constexpr std::array<Variable, 0> tensors{};
  double density, bulk_modulus;  // [kg/m3] [Pa]
  double cutoff = 0;             // [Pa] lowest pressure: bubbles keep it
};

inline double bulk_modulus_at_start(const LinearFluid& law) { return law.bulk_modulus; }

/// Volume at which bubbles open:  1 - cutoff/K. [-]
inline double ratio_of_void(const LinearFluid& law) { return 1.0 - law.cutoff / law.bulk_modulus; }

/// The state of a pressure [Pa], which is below K and no lower than the cut-off.
inline FluidState<double> start_at(const LinearFluid& law, double pressure) {
  const double strain = pressure / law.bulk_modulus;
  return {1.0 - strain, pressure, 0.5 * strain * pressure};
}

/// Carries a state to the volume `ratio`. The energy is that of the volume, 1/2 K (1 - J)^2 where the fluid is whole, exactly; heat does
/// not change the pressure. Where bubbles close within a step, the force of its end counts over half of the step that led there: work
/// beyond that energy is lost, as in an inelastic impact. Where they open, less of it is given back; as bubbles close faster than they
/// open, the sum of both is a loss.
template <class T>
NEREID_HOT FluidResponse<T> update_pressure(const LinearFluid& law, T ratio, FluidState<T>& state) {
  const T K(law.bulk_modulus), one(1.0), half(0.5), open(ratio_of_void(law));
  const auto whole = [&](T J) { return smaller(J, open); };  // without bubbles
  const T before = one - whole(state.ratio), now = one - whole(ratio);
  const T compression = half * K * (now - before) * (now + before);
  const T cavitation = T(-law.cutoff) * (larger(ratio, open) - larger(state.ratio, open));
  const auto opens_or_closes = (state.ratio > open) != (ratio > open);
  const T taken = -(half * K * (before + now) * (ratio - state.ratio));
  const T lost = select(opens_or_closes, taken - compression - cavitation, T(0.0));
  state = {ratio, K * now, state.energy + compression};
  return {compression, cavitation, lost, K * whole(ratio)};
}

template <class T>
NEREID_HOT T void_part(const LinearFluid& law, const FluidState<T>& state) {
  return larger(T(0.0), T(1.0) - T(ratio_of_void(law)) / state.ratio);
}

static_assert(FluidLaw<LinearFluid>);

}  // namespace nereid::material
