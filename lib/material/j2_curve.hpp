#pragma once
// Flow stresses that are curves over the plastic strain: measured tables, Voce's and the power laws, at one rate or at several.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "material/j2_search.hpp"

namespace nereid::material {

/// True stress over plastic strain at one rate: linear between its points, and constant beyond the last one.
struct MeasuredCurve {
  double rate = 0;                     ///< [1/s] of plastic strain
  std::vector<double> strain, stress;  ///< [-] ascending from 0; [Pa] positive, not descending
};

/// A flow stress over plastic strain p and its rate:
///
///     measured  linear between the points of each curve; between curves linear in the logarithm of the rate, beyond them the nearest one
///     voce      A + Q (1 - e^(-b p))
///     ludwik    A + K p^n
///     swift     K (e + p)^n
///
/// and each of them times  1 + (rate / D)^(1/q)  with the law of Cowper and Symonds (where `cowper_rate` is above zero).
struct HardeningCurve {
  enum class Kind { measured, voce, ludwik, swift };
  static constexpr bool searched = true;
  static constexpr std::array<Variable, 1> internal{{{"plastic_strain", "1"}}};
  Kind kind = Kind::voce;
  std::vector<MeasuredCurve> curves = {};        ///< ascending rates
  double yield = 0;                              ///< [Pa] A
  double growth = 0, exponent = 0, offset = 0;   ///< Q or K [Pa]; b or n [-]; e [-]
  double cowper_rate = 0, cowper_exponent = 1;   ///< D [1/s], 0: none; q [-]
};

/// A flow stress that is a curve over Hooke's law.
///
/// Needs  curves, or A > 0, Q and K >= 0, b > 0, 0 < n <= 1, e > 0; D >= 0, q >= 1
using J2Curve = J2<HardeningCurve>;

/// A measured curve and its slope at a plastic strain.
inline FlowStress<double> value_at(const MeasuredCurve& curve, double strain) {
  const auto behind = std::upper_bound(curve.strain.begin(), curve.strain.end(), strain);
  if (behind == curve.strain.end()) return {strain != strain ? strain : curve.stress.back(), 0.0};
  const auto i = std::max<std::size_t>(static_cast<std::size_t>(behind - curve.strain.begin()), 1);
  const double slope = (curve.stress[i] - curve.stress[i - 1]) / (curve.strain[i] - curve.strain[i - 1]);
  return {curve.stress[i - 1] + slope * (strain - curve.strain[i - 1]), slope};
}

/// Measured curves at a plastic strain and a rate.
inline Tangent<double> value_at(const std::vector<MeasuredCurve>& curves, double strain, double rate) {
  const auto behind = std::upper_bound(curves.begin(), curves.end(), rate, [](double r, const MeasuredCurve& one) { return r < one.rate; });
  if (behind == curves.begin() || behind == curves.end()) {
    const FlowStress<double> at = value_at(behind == curves.begin() ? curves.front() : curves.back(), strain);
    return {at.value, at.slope, 0.0};
  }
  const MeasuredCurve &slow = behind[-1], &fast = *behind;
  const FlowStress<double> low = value_at(slow, strain), high = value_at(fast, strain);
  const double width = std::log(fast.rate / slow.rate), part = std::log(rate / slow.rate) / width;
  return {low.value + part * (high.value - low.value), low.slope + part * (high.slope - low.slope),
          (high.value - low.value) / (width * rate)};
}

/// The flow stress at a plastic strain and a rate, with its slopes. [Pa] [Pa] [Pa s]
inline Tangent<double> value_at(const HardeningCurve& f, double strain, double rate) {
  Tangent<double> at{0, 0, 0};
  if (f.kind == HardeningCurve::Kind::measured) {
    at = value_at(f.curves, strain, rate);
  } else if (f.kind == HardeningCurve::Kind::voce) {
    const double left = f.growth * std::exp(-f.exponent * strain);
    at = {f.yield + f.growth - left, f.exponent * left, 0};
  } else {
    const double whole = strain + f.offset, power = f.growth * std::pow(whole, f.exponent);
    at = {f.yield + power, whole > 0 ? f.exponent * power / whole : 0, 0};
  }
  if (f.cowper_rate > 0 && rate > 0) {
    const double more = std::pow(rate / f.cowper_rate, 1 / f.cowper_exponent), factor = 1 + more;
    at = {at.value * factor, at.by_first * factor, at.by_second * factor + at.value * more / (f.cowper_exponent * rate)};
  }
  return at;
}

/// The flow stress after some flow in an increment: docs/theory/hardening_curves.md.
///
/// flow    [-] not negative;  dt  [s];  scalar  plastic strain [-] before the increment
template <class T>
NEREID_HOT FlowStress<T> flow_stress(const J2Curve& law, const T& flow, const T& /*work*/, const T& /*power*/, const T& dt,
                                     const T& /*volume*/, const std::array<T, 1>& scalar) {
  const auto curve = [&law](double strain, double rate) { return value_at(law.flow, strain, rate); };
  const Tangent<T> at = at_each_lane(curve, scalar[0] + flow, flow / dt);
  return {at.value, at.by_first + at.by_second / dt};
}

/// The von Mises stress at which a point begins to flow: the flow stress at no rate. [Pa]
template <class T>
NEREID_HOT T yield_stress(const J2Curve& law, const std::array<T, 1>& scalar) {
  const auto curve = [&law](double strain, double rate) { return value_at(law.flow, strain, rate); };
  return at_each_lane(curve, scalar[0], T(0.0)).value;
}

/// The flow stress before any flow: no curve descends. [Pa]
NEREID_HOT double least_flow_stress(const J2Curve& law) { return yield_stress(law, std::array<double, 1>{0.0}); }

template <class T>
NEREID_HOT void remember(const J2Curve&, const T& flow, const T& /*dissipated*/, const T& /*volume*/, std::array<T, 1>& scalar) {
  scalar[0] = scalar[0] + flow;
}

static_assert(PlateLaw<J2Curve>);

}  // namespace nereid::material
