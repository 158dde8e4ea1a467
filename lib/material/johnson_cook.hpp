#pragma once
// The flow stress of Johnson and Cook: hardening, strain rate and heat; derived in docs/theory/johnson_cook.md.

#include "material/j2.hpp"

namespace nereid::material {

/// The flow stress of Johnson & Cook, with the heat of plastic work kept where it is made (adiabatic):
///
///     Y = (A + B p^n) (1 + C ln(rate / rate_0)) (1 - T*^m),     T* = (T - T_0) / (T_melt - T_0)
///
/// Below rate_0 the rate has no effect, below T_0 the temperature has none, and above T_melt there is no strength.
/// Proc. 7th Int. Symp. Ballistics (1983) 541.
struct JohnsonCook {
  static constexpr std::array<Variable, 2> internal{{{"plastic_strain", "1"}, {"temperature", "K"}}};
  double yield, hardening, hardening_exponent;  // A [Pa], B [Pa], n [-]
  double rate_coefficient, reference_rate;      // C [-], rate_0 [1/s]
  double thermal_exponent;                      // m [-]
  double reference_temperature, melting_temperature;  // T_0 [K], T_melt [K]
  double specific_heat, heat_share;             // [J/(kg K)], [-] share of the plastic work that heats (Taylor & Quinney)
  double temperature;                           // [K] at the start
};

/// Johnson and Cook's flow stress over Hooke's law. Plates do not have it: no return in plane stress is given.
///
/// Needs  yield > 0, hardening >= 0, hardening_exponent > 0, rate_coefficient >= 0, reference_rate > 0, thermal_exponent > 0,
///        reference_temperature < melting_temperature, specific_heat > 0, 0 <= heat_share <= 1
using J2JohnsonCook = J2<JohnsonCook>;

inline std::array<double, 2> start_values(const J2JohnsonCook& law) { return {0.0, law.flow.temperature}; }

/// A flow stress and its slope over the flow of an increment. [Pa]
template <class T>
struct FlowStress {
  T value, slope;
};

/// The flow stress after some flow in an increment, with the rate flow / dt and the heat of that flow.
///
/// flow    [-] not negative;  work  [J/m3] dissipated by it;  power  [J/m3] its slope over the flow
/// dt      [s];  volume  [-] current over reference
/// scalar  plastic strain [-] and temperature [K] before the increment
///
/// A millionth of the yield stress is left of metal that has melted, so that nothing divides by zero.
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

  const T value = hard * rate * cold, least(1e-6 * f.yield);
  const T slope = hard_slope * rate * cold + hard * rate_slope * cold + hard * rate * cold_slope;
  return {larger(value, least), select(value > least, slope, zero)};
}

/// The von Mises stress at which a point begins to flow: the flow stress at no rate and at its temperature. [Pa]
template <class T>
NEREID_HOT T yield_stress(const J2JohnsonCook& law, const std::array<T, 2>& scalar) {
  const T zero(0.0), one(1.0);
  return flow_stress(law, zero, zero, zero, one, one, scalar).value;
}

/// Flow of the return: the root of  q - 3 mu flow = Y(flow),  Y with the rate and the heat of this very increment.
///
/// Newton's method between two ends, of which the left side is larger at the lower and Y at the upper. A step that would
/// leave them, or that did not halve the residual, is replaced by their middle; so every input converges. A lane
/// that has come to rest is left alone, so its bits do not depend on its neighbours. One step of Newton at the end
/// gives dual numbers their derivative.
///
/// returns  [-] exactly zero where q <= the stress at which flow begins
template <class T>
NEREID_HOT T flow_increment(const J2JohnsonCook& law, const Trial<T>& trial, const T& dt, const T& volume,
                            const std::array<T, 2>& scalar) {
  const T zero(0.0), half(0.5), stiffness(3.0 * shear_modulus(law));
  const Mask<T> flows = trial.mises > trial.yield;
  T low = zero, high = trial.mises / stiffness;
  T flow = select(flows, (trial.mises - trial.yield) / stiffness, zero);

  T residual = zero, slope = stiffness;
  const auto look = [&] {
    // dissipated: half of old and new stress over the flow; a stress that turns round gives none back
    const T sum = trial.old + trial.mises - stiffness * flow;
    const T work = larger(half * sum * flow, zero), power = select(sum > zero, half * sum - half * stiffness * flow, zero);
    const FlowStress<T> now = flow_stress(law, flow, work, power, dt, volume, scalar);
    residual = trial.mises - stiffness * flow - now.value;
    slope = stiffness + now.slope;
  };
  constexpr int most = 200;             // ten are usual; every second round halves the residual or what is between the ends
  constexpr double at_rest = 1e-12;     // relative to the flow; Newton squares it
  constexpr double round_off = 2e-16;   // relative to the trial stress
  Mask<T> moving = flows;
  T before = trial.mises;
  for (int round = 0; round < most && any(moving); ++round) {
    look();
    const T size = larger(residual, -residual);
    low = select(moving && residual > zero, flow, low);
    high = select(moving && residual < zero, flow, high);
    const T newton = flow + residual / slope, middle = half * (low + high);
    const Mask<T> sound = newton > low && newton < high && size < half * before;
    const T next = select(sound, newton, middle), step = next - flow;
    const Mask<T> goes_on = moving && size > T(round_off) * trial.mises && larger(step, -step) > T(at_rest) * flow;
    flow = select(goes_on, next, flow);
    before = select(goes_on, size, before);
    moving = goes_on;
  }
  if (any(flows)) {
    look();
    const T step = residual / slope;
    flow = select(flows && larger(step, -step) < T(1e-6) * flow, flow + step, flow);
  }
  return flow;
}

/// Adds the flow to the plastic strain, and the heat of what was dissipated to the temperature.
///
/// dissipated  [J/m3] per current volume;  volume  [-] current over reference
template <class T>
NEREID_HOT void remember(const J2JohnsonCook& law, const T& flow, const T& dissipated, const T& volume, std::array<T, 2>& scalar) {
  scalar[0] = scalar[0] + flow;
  scalar[1] = scalar[1] + T(law.flow.heat_share / (law.density * law.flow.specific_heat)) * volume * dissipated;
}

static_assert(Law<J2JohnsonCook> && !PlateLaw<J2JohnsonCook>);

}  // namespace nereid::material
