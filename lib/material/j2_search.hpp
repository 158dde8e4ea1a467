#pragma once
// The return to the yield surface where the flow stress is a curve: a search for the root, in space and in the plane of a plate.
// Derived in docs/theory/johnson_cook.md.
//
// A flow stress that is searched has `static constexpr bool searched = true`, and for J2<Flow> two functions:
//     flow_stress(law, flow, work, power, dt, volume, scalar)   the flow stress after some flow in an increment, and its slope
//     least_flow_stress(law)                                    [Pa] above zero; no flow stress is below it

#include "material/j2.hpp"

namespace nereid::material {

/// A flow stress and its slope over the flow of an increment. [Pa]
template <class T>
struct FlowStress {
  T value, slope;
};

template <class Flow>
concept SearchedFlow = Flow::searched;

/// The ends between which a root lies, and how far the search for it has come.
template <class T>
struct Search {
  T low, high;    ///< the residual is positive at the lower end, and negative at the higher one
  T at;           ///< where the residual is computed next; with the root after the search
  T before;       ///< size of the residual before
  Mask<T> moving;
};

/// Newton's method between two ends. A step that would leave them, or that did not halve the residual, is replaced by their middle; so
/// every input converges. A lane that has come to rest is left alone, so its bits do not depend on its neighbours.
///
/// residual   [Pa] a function of the unknown that gives itself and a step of Newton's method, towards the root
/// scale      [Pa] the search ends at 2e-16 of it
template <class T, class Residual>
NEREID_HOT void search(Search<T>& s, const T& scale, Residual&& residual) {
  const T half(0.5);
  constexpr int most = 200;            // ten are usual; every second round halves the residual or what is between the ends
  constexpr double at_rest = 1e-12;    // relative to the unknown; Newton squares it
  constexpr double round_off = 2e-16;  // relative to the scale
  const Mask<T> all = s.moving;
  for (int round = 0; round < most && any(s.moving); ++round) {
    const auto [value, step_of_newton] = residual(s.at);
    const T size = larger(value, -value);
    s.low = select(s.moving && value > T(0.0), s.at, s.low);
    s.high = select(s.moving && value < T(0.0), s.at, s.high);
    const T newton = s.at + step_of_newton, middle = half * (s.low + s.high);
    const Mask<T> sound = newton > s.low && newton < s.high && size < half * s.before;
    const T next = select(sound, newton, middle), step = next - s.at;
    const Mask<T> goes_on = s.moving && size > T(round_off) * scale && larger(step, -step) > T(at_rest) * s.at;
    s.at = select(goes_on, next, s.at);
    s.before = select(goes_on, size, s.before);
    s.moving = goes_on;
  }
  if (!any(all)) return;
  const T step = residual(s.at).step;  // one step of Newton at the end gives dual numbers their derivative
  s.at = select(all && larger(step, -step) < T(1e-6) * s.at, s.at + step, s.at);
}

/// A residual and a step of Newton's method.
template <class T>
struct Residual {
  T value;  ///< [Pa]
  T step;
};

/// Flow of the return in space: the root of  q - 3 mu flow = Y(flow),  Y with the rate and the heat of this very increment.
///
/// returns  [-] exactly zero where q <= the stress at which flow begins
template <SearchedFlow Flow, class T>
NEREID_HOT T flow_increment(const J2<Flow>& law, const Trial<T>& trial, const T& dt, const T& volume,
                            const std::array<T, J2<Flow>::internal.size()>& scalar) {
  const T zero(0.0), half(0.5), stiffness(3.0 * shear_modulus(law));
  const Mask<T> flows = trial.mises > trial.yield;
  Search<T> s{.low = zero,
              .high = trial.mises / stiffness,
              .at = select(flows, (trial.mises - trial.yield) / stiffness, zero),
              .before = trial.mises,
              .moving = flows};
  search(s, trial.mises, [&](const T& flow) {
    // dissipated: half of old and new stress over the flow; a stress that turns round gives none back
    const T sum = trial.old + trial.mises - stiffness * flow;
    const T work = larger(half * sum * flow, zero), power = select(sum > zero, half * sum - half * stiffness * flow, zero);
    const FlowStress<T> now = flow_stress(law, flow, work, power, dt, volume, scalar);
    const T residual = trial.mises - stiffness * flow - now.value;
    return Residual<T>{residual, residual / (stiffness + now.slope)};
  });
  return s.at;
}

/// The trial stress of a plate in the parts that its return shrinks, and how fast.
template <class T>
struct PlaneTrial {
  T sum, difference, shear;              ///< [Pa] xx + yy, xx - yy, xy
  T old_sum, old_difference, old_shear;  ///< [Pa] the same before the increment
  T sum_rate, shear_rate;                ///< [Pa] of what the multiplier takes from the sum, and from the two others
};

/// A plate on its way back to the yield surface.
template <class T>
struct PlaneReturn {
  T mises, mises_slope;  ///< [Pa] and over the multiplier
  T flow, flow_slope;    ///< [-]  2/3 g q
  T work, power;         ///< [J/m3] dissipated, and its slope over the flow
};

/// With g the multiplier, a = 1/(1 + sum_rate g) and b = 1/(1 + shear_rate g) shrink the sum and the two others; the work is
///     W = g/2 (old + new) : dev new = g/2 (s_old s a / 6 + d_old d b / 2 + 2 t_old t b + 2/3 q^2).
template <class T>
NEREID_HOT PlaneReturn<T> plane_return(const PlaneTrial<T>& trial, const T& g) {
  const T zero(0.0), one(1.0), half(0.5), two_thirds(2.0 / 3.0);
  const T a = one / (one + trial.sum_rate * g), b = one / (one + trial.shear_rate * g);
  const T a_slope = -trial.sum_rate * a * a, b_slope = -trial.shear_rate * b * b;
  const T of_sum = T(0.25) * trial.sum * trial.sum;
  const T of_shear = T(0.75) * trial.difference * trial.difference + T(3.0) * trial.shear * trial.shear;
  const T q = root(of_sum * a * a + of_shear * b * b), q_slope = (of_sum * a * a_slope + of_shear * b * b_slope) / q;
  const T flow = two_thirds * g * q, flow_slope = two_thirds * (q + g * q_slope);
  const T with_sum = T(1.0 / 6.0) * trial.old_sum * trial.sum;
  const T with_shear = half * trial.old_difference * trial.difference + T(2.0) * trial.old_shear * trial.shear;
  const T rate = with_sum * a + with_shear * b + two_thirds * q * q;
  const T rate_slope = with_sum * a_slope + with_shear * b_slope + T(4.0 / 3.0) * q * q_slope;
  const Mask<T> dissipates = rate > zero;
  return {q, q_slope, flow, flow_slope, select(dissipates, half * g * rate, zero),
          select(dissipates, half * (rate + g * rate_slope) / flow_slope, zero)};
}

/// Return in plane stress with a flow stress that is searched: the multiplier g >= 0 is the root of
///     q(g) = Y(2/3 g q(g)),     plastic = g dev s_new,
/// with q(g) as of J2Bilinear. Newton's method runs on 1/Y - 1/q, which is nearly straight.
/// Simo & Taylor, Int. J. Numer. Meth. Engng 22 (1986) 649; docs/theory/bilinear_plasticity.md.
///
/// increment, stress, internal, returns  as in space, with the components of the plane
///
/// Invariants  as in space
template <SearchedFlow Flow, class T>
NEREID_HOT Response<T> update_stress(const J2<Flow>& law, const Increment<T, Plane>& increment, Plane<T>& stress,
                                     Internal<T, J2<Flow>, Plane>& internal) {
  const T zero(0.0), one(1.0), half(0.5);
  const Plane<T> old = stress;
  const Plane<T> trial = old + hooke(law, increment.strain);
  const T yield = yield_stress(law, internal.scalar);
  const T sum = trial.xx + trial.yy, difference = trial.xx - trial.yy;
  const T squares = T(0.25) * sum * sum + T(0.75) * difference * difference + T(3.0) * trial.xy * trial.xy;
  const Mask<T> flows = squares > yield * yield;
  // Elastic lanes run along on the yield surface, where nothing divides by zero, and stay at g = 0.
  const PlaneTrial<T> start{.sum = select(flows, sum, yield + yield),
                            .difference = select(flows, difference, zero),
                            .shear = select(flows, trial.xy, zero),
                            .old_sum = old.xx + old.yy,
                            .old_difference = old.xx - old.yy,
                            .old_shear = old.xy,
                            .sum_rate = T(law.young / (3.0 * (1.0 - law.poisson))),
                            .shear_rate = T(2.0 * shear_modulus(law))};
  const PlaneReturn<T> first = plane_return(start, zero);
  const T slowest = smaller(start.sum_rate, start.shear_rate);
  Search<T> s{.low = zero,
              .high = first.mises / (T(least_flow_stress(law)) * slowest),  // there q is below any flow stress
              .at = select(flows, (first.mises - yield) * first.mises / (yield * -first.mises_slope), zero),
              .before = first.mises,
              .moving = flows};
  s.at = smaller(s.at, s.high);
  search(s, first.mises, [&](const T& g) {
    const PlaneReturn<T> now = plane_return(start, g);
    const FlowStress<T> flow = flow_stress(law, now.flow, now.work, now.power, increment.dt, increment.volume, internal.scalar);
    const T residual = now.mises - flow.value;
    const T slope = flow.slope * now.flow_slope * now.mises / flow.value - flow.value * now.mises_slope / now.mises;
    return Residual<T>{residual, residual / slope};
  });
  const T g = s.at;

  // Differences of the trial, not new values, so that g = 0 leaves every bit of it.
  const T a = one / (one + start.sum_rate * g), b = one / (one + start.shear_rate * g);
  const T less_sum = half * sum * (start.sum_rate * g * a), less_difference = half * difference * (start.shear_rate * g * b);
  stress = {trial.xx - less_sum - less_difference, trial.yy - less_sum + less_difference, trial.xy - trial.xy * (start.shear_rate * g * b)};
  const Work<T> work = split_work(old, stress, increment.strain, g * deviator(stress));
  remember(law, plane_return(start, g).flow, work.dissipated, increment.volume, internal.scalar);
  return {work, lame(law)};
}

}  // namespace nereid::material
