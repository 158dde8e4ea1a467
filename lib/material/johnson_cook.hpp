#pragma once
// The flow stress of Johnson and Cook: hardening, strain rate and heat; derived in docs/theory/johnson_cook.md.

#include "material/j2_search.hpp"

namespace nereid::material {

/// The flow stress of Johnson & Cook, with the heat of plastic work kept where it is made (adiabatic):
///
///     Y = (A + B p^n) (1 + C ln(rate / rate_0)) (1 - T*^m),     T* = (T - T_0) / (T_melt - T_0)
///
/// Below rate_0 the rate has no effect, below T_0 the temperature has none, and above T_melt there is no strength.
/// Proc. 7th Int. Symp. Ballistics (1983) 541.
struct JohnsonCook {
  static constexpr bool searched = true;
  static constexpr std::array<Variable, 2> internal{{{"plastic_strain", "1"}, {"temperature", "K"}}};
  double yield, hardening, hardening_exponent;  // A [Pa], B [Pa], n [-]
  double rate_coefficient, reference_rate;      // C [-], rate_0 [1/s]
  double thermal_exponent;                      // m [-]
  double reference_temperature, melting_temperature;  // T_0 [K], T_melt [K]
  double specific_heat, heat_share;             // [J/(kg K)], [-] share of the plastic work that heats (Taylor & Quinney)
  double temperature;                           // [K] at the start
};

/// Johnson and Cook's flow stress over Hooke's law.
///
/// Needs  yield > 0, hardening >= 0, hardening_exponent > 0, rate_coefficient >= 0, reference_rate > 0, thermal_exponent > 0,
///        reference_temperature < melting_temperature, specific_heat > 0, 0 <= heat_share <= 1
using J2JohnsonCook = J2<JohnsonCook>;

inline std::array<double, 2> start_values(const J2JohnsonCook& law) { return {0.0, law.flow.temperature}; }

/// What is left of metal that has melted, so that nothing divides by zero: a millionth of the yield stress. [Pa]
NEREID_HOT double least_flow_stress(const J2JohnsonCook& law) { return 1e-6 * law.flow.yield; }

/// The flow stress after some flow in an increment, with the rate flow / dt and the heat of that flow.
///
/// flow    [-] not negative;  work  [J/m3] dissipated by it;  power  [J/m3] its slope over the flow
/// dt      [s];  volume  [-] current over reference
/// scalar  plastic strain [-] and temperature [K] before the increment
template <class T>
NEREID_HOT FlowStress<T> flow_stress(const J2JohnsonCook& law, const T& flow, const T& work, const T& power, const T& dt,
                                     const T& volume, const std::array<T, 2>& scalar) {
  const JohnsonCook& f = law.flow;
  const T zero(0.0), one(1.0);
  const T strain = scalar[0] + flow;
  const T grown = T(f.hardening) * power_of(strain, f.hardening_exponent);
  const T hard = T(f.yield) + grown;
  const T hard_slope = select(strain > zero, T(f.hardening_exponent) * grown / strain, zero);

  const T times = flow / (T(f.reference_rate) * dt);
  const Mask<T> fast = times > one;
  const T rate = one + T(f.rate_coefficient) * logarithm(select(fast, times, one));
  const T rate_slope = select(fast, T(f.rate_coefficient) / flow, zero);

  const double range = f.melting_temperature - f.reference_temperature;
  const T heating = T(f.heat_share / (law.density * f.specific_heat)) * volume;  // [K m3/J]
  const T hot = (scalar[1] + heating * work - T(f.reference_temperature)) * T(1.0 / range);
  const T inside = larger(smaller(hot, one), zero);
  const T lost = power_of(inside, f.thermal_exponent);
  const T cold = one - lost;
  const T cold_slope = select(hot > zero && hot < one, T(-f.thermal_exponent / range) * heating * power * lost / inside, zero);

  const T value = hard * rate * cold, least(least_flow_stress(law));
  const T slope = hard_slope * rate * cold + hard * rate_slope * cold + hard * rate * cold_slope;
  return {larger(value, least), select(value > least, slope, zero)};
}

/// The von Mises stress at which a point begins to flow: the flow stress at no rate and at its temperature. [Pa]
template <class T>
NEREID_HOT T yield_stress(const J2JohnsonCook& law, const std::array<T, 2>& scalar) {
  const T zero(0.0), one(1.0);
  return flow_stress(law, zero, zero, zero, one, one, scalar).value;
}

/// Adds the flow to the plastic strain, and the heat of what was dissipated to the temperature.
///
/// dissipated  [J/m3] per current volume;  volume  [-] current over reference
template <class T>
NEREID_HOT void remember(const J2JohnsonCook& law, const T& flow, const T& dissipated, const T& volume, std::array<T, 2>& scalar) {
  scalar[0] = scalar[0] + flow;
  scalar[1] = scalar[1] + T(law.flow.heat_share / (law.density * law.flow.specific_heat)) * volume * dissipated;
}

static_assert(PlateLaw<J2JohnsonCook>);

}  // namespace nereid::material
