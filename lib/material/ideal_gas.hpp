#pragma once
// The ideal gas.

#include "material/fluid.hpp"

namespace nereid::material {

/// p = (gamma - 1) e, e the internal energy per volume now. The reference is the start.
struct IdealGas {
  static constexpr std::array internal = shown_of_fluids;
  static constexpr std::array<Variable, 0> tensors{};
  double density, gamma, pressure;  // [kg/m3] [-] above 1, [Pa] at the start
};

inline double bulk_modulus_at_start(const IdealGas& law) { return law.gamma * law.pressure; }

/// The state of a pressure [Pa] at the density of the start.
inline FluidState<double> start_at(const IdealGas& law, double pressure) { return {1.0, pressure, pressure / (law.gamma - 1.0)}; }

/// Carries a state to the volume `ratio`. Along an isentrope p V^gamma keeps its value to the second order in the step.
template <class T>
NEREID_HOT FluidResponse<T> update_pressure(const IdealGas& law, T ratio, FluidState<T>& state) {
  FluidResponse<T> response = carry_over(T(0.0), T(law.gamma - 1.0) / ratio, ratio, T(-1e300), state);
  response.modulus = T(law.gamma) * state.pressure;
  return response;
}

template <class T>
NEREID_HOT T void_part(const IdealGas&, const FluidState<T>&) { return T(0.0); }

template <>
constexpr bool may_be_compressed<IdealGas> = true;

static_assert(FluidLaw<IdealGas>);

}  // namespace nereid::material
