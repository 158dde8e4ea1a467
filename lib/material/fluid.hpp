#pragma once
// What every law of a fluid is. A fluid has a pressure and no other stress; its pressure follows from its volume and its internal energy.
//
// A law is data plus free functions: start_at() finds the state of a pressure, update_pressure() carries a state over a step. It knows no
// element, no mesh and no file. Volumes are over that of the reference, at which the law has no pressure: of a gas, that of the start.

#include <concepts>

#include "material/law.hpp"

namespace nereid::material {

/// Where a fluid stands.
template <class T>
struct FluidState {
  T ratio;     ///< [-] volume over that of the reference
  T pressure;  ///< [Pa]
  T energy;    ///< [J/m3] internal energy per volume of the reference, without that of bubbles
};

/// What a step did to a fluid.
template <class T>
struct FluidResponse {
  T compression;  ///< [J/m3] work taken up by compression, per volume of the reference
  T cavitation;   ///< [J/m3] the same by bubbles
  T lost;         ///< [J/m3] what bubbles that close within the step take for good; below zero where they open
  T modulus;      ///< [Pa] bulk modulus now, -V dp/dV without exchange of heat
};

/// A law of a fluid.
template <class L>
concept FluidLaw = requires(const L& law, FluidState<double>& state, double number) {
  { law.density } -> std::convertible_to<double>;             // [kg/m3] at the start
  { bulk_modulus_at_start(law) } -> std::convertible_to<double>;  // [Pa]
  { start_at(law, number) } -> std::convertible_to<FluidState<double>>;
  { update_pressure(law, number, state) } -> std::convertible_to<FluidResponse<double>>;
  { void_part(law, state) } -> std::convertible_to<double>;   // [-] part of the volume that is bubbles
};

/// What results show of a fluid beside its pressure.
constexpr std::array<Variable, 3> shown_of_fluids{{{"density", "kg/m^3"}, {"internal_energy", "J/kg"}, {"void_fraction", "1"}}};

/// Whether a law is of a gas, which may lose most of its volume: distortion control, which begins at a part of it, is left out.
template <class L>
constexpr bool may_be_compressed = false;

/// Moduli of a fluid at the start, for contact and forecasts: lambda is the bulk modulus.
template <FluidLaw L>
Lame lame(const L& law) {
  return {bulk_modulus_at_start(law), 0.0};
}

/// Carries pressure and energy over a step where the pressure is linear in the energy,  p = a + b e:
///
///     e' = e - 1/2 (p + p') (J' - J),     p' = a' + b' e'
///
/// solved for p', which is not below the cut-off. Between two states at the cut-off the work goes to bubbles, and the energy stays.
///
/// a, b     [Pa] [-] at the new volume;  ratio  J';  cutoff  [Pa]
/// returns  compression and cavitation; `modulus` is left to the law
template <class T>
NEREID_HOT FluidResponse<T> carry_over(T a, T b, T ratio, T cutoff, FluidState<T>& state) {
  const T half(0.5), one(1.0), zero(0.0), growth = ratio - state.ratio;
  const T free = (a + b * (state.energy - half * state.pressure * growth)) / (one + half * b * growth);
  const T now = larger(free, cutoff);
  const auto is_void = state.pressure <= cutoff && !(free > cutoff);
  const T taken = -(half * (state.pressure + now) * growth);
  const T compression = select(is_void, zero, taken);
  state = {ratio, now, state.energy + compression};
  return {compression, taken - compression, zero, zero};
}

}  // namespace nereid::material
