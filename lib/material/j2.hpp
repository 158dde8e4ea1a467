#pragma once
// Plasticity of von Mises over Hooke's law, with a flow stress of any kind; derived in
// docs/theory/bilinear_plasticity.md and docs/theory/johnson_cook.md.
//
// A flow stress is data with the scalars it lets a point remember, the first of them the plastic strain, and three
// functions: `yield_stress`, `flow_increment` and `remember`. j2_bilinear.hpp and johnson_cook.hpp have one each.

#include "material/law.hpp"

namespace nereid::material {

/// Isotropic elasticity up to a von Mises stress that a flow stress sets.
template <class Flow>
struct J2 {
  static constexpr auto internal = Flow::internal;  ///< plastic_strain, then what else the flow stress remembers
  static constexpr std::array<Variable, 0> tensors{};
  double density, young, poisson;  // [kg/m3] [Pa] [-]
  Flow flow;
};

/// What the return to the yield surface starts from.
template <class T>
struct Trial {
  T mises;  ///< [Pa] von Mises stress of the elastic trial, not below `yield`
  T yield;  ///< [Pa] at which flow begins: mises == yield where there is none
  T old;    ///< [Pa] stress before the increment, along the flow: old : plastic / flow
};

/// Splits the work of a plastic step:  total = 1/2 (old + new) : strain,
/// dissipated = 1/2 (old + new) : plastic,  stored = total - dissipated.
///
/// S        Symmetric<T> or Plane<T>
/// plastic  increment of plastic strain [-]
/// returns  work per current volume [J/m3]
///
/// Invariants  dissipated >= 0. By Cauchy and Schwarz  old : plastic >= -q_old flow, and
///             new : plastic = Y_new flow, so the sum is at least (Y_new - Y_old) flow = H flow^2.
///             Without hardening that bound is zero: the cut-off below takes round-off away.
template <class T, template <class> class S>
NEREID_HOT Work<T> split_work(const S<T>& old, const S<T>& now, const S<T>& strain, const S<T>& plastic) {
  const S<T> both = old + now;
  const T total = T(0.5) * contract(both, strain);
  const T dissipated = larger(T(0.5) * contract(both, plastic), T(0.0));
  return {total - dissipated, dissipated};
}

/// Radial return: the elastic trial stress is drawn back to the yield surface along its deviator.
///
/// With q the von Mises stress of the trial and Y(flow) the flow stress, `flow` is zero if q <= Y(0), else the root of
///     q - 3 mu flow = Y(flow),     plastic = (3/2) (flow / q) dev trial,     stress = trial - 2 mu plastic.
/// Simo & Hughes, Computational Inelasticity (1998), Box 3.1.
///
/// What is stored changes by 1/2 s : C^-1 : s exactly. As in Elastic that is per current volume,
/// and what an element stores is an integral over its path. Hardening counts as dissipated.
///
/// increment  strain, tensor components, in a frame that does not turn [-]; dt [s]; volume ratio [-]
/// stress     Cauchy [Pa], old on entry and new on return
/// internal   equivalent plastic strain [-] and what else the flow stress remembers, updated
/// returns    work per current volume [J/m3] and the moduli, which are constant [Pa]
///
/// Invariants  stored + dissipated = 1/2 (old + new) : strain;  dissipated >= 0;
///             von_mises(stress) <= the flow stress at the end of the increment, equal after flow;
///             a step without flow is that of Elastic, to the last bit;
///             a rotation of strain and stress rotates the result.
template <class Flow, class T>
NEREID_HOT Response<T> update_stress(const J2<Flow>& law, const Increment<T, Symmetric>& increment, Symmetric<T>& stress,
                                     Internal<T, J2<Flow>, Symmetric>& internal) {
  const double mu = shear_modulus(law);
  const Symmetric<T> old = stress;
  const Symmetric<T> trial = old + hooke(law, increment.strain);
  const Symmetric<T> shape = deviator(trial);

  // The larger of q^2 and Y^2 stands in for `if it yields`: sqrt(Y^2) is Y to the last bit, so
  // flow is exactly zero in elastic lanes, and none of them divides by zero.
  const T yield = yield_stress(law, internal.scalar);
  const T q = root(larger(T(1.5) * contract(shape, shape), yield * yield));
  const Trial<T> start{.mises = q, .yield = yield, .old = T(1.5) * contract(old, shape) / q};
  const T flow = flow_increment(law, start, increment.dt, increment.volume, internal.scalar);
  const Symmetric<T> plastic = (T(1.5) * flow / q) * shape;

  stress = trial - T(2.0 * mu) * plastic;
  const Work<T> work = split_work(old, stress, increment.strain, plastic);
  remember(law, flow, work.dissipated, increment.volume, internal.scalar);
  return {work, lame(law)};
}

}  // namespace nereid::material
