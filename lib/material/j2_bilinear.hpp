#pragma once
// Plasticity of von Mises with linear isotropic hardening; derived in
// docs/theory/bilinear_plasticity.md.

#include "material/law.hpp"

namespace nereid::material {

/// Isotropic elasticity up to a von Mises stress that grows linearly with the plastic strain.
struct J2Bilinear {
  static constexpr std::array<std::string_view, 1> internal{"plastic_strain"};
  static constexpr std::array<std::string_view, 0> tensors{};
  double density, young, poisson, yield, tangent;  // [kg/m3] [Pa] [-] [Pa] [Pa]
};

/// Growth of the yield stress with plastic strain:  H = E E_t / (E - E_t).
///
/// The tangent E_t is the slope of stress over *total* strain in uniaxial stress beyond yield, as
/// tables of materials give it; H is the slope over plastic strain: 1/E_t = 1/E + 1/H.
///
/// returns  [Pa]
/// Needs    0 <= tangent < young
inline double hardening_modulus(const J2Bilinear& law) {
  return law.young * law.tangent / (law.young - law.tangent);
}

/// The stress up to which the material is elastic now:  Y = yield + H plastic_strain.
///
/// plastic_strain  equivalent, accumulated [-]
/// returns         [Pa]
template <class T>
NEREID_HOT T yield_stress(const J2Bilinear& law, const T& plastic_strain) {
  return T(law.yield) + T(hardening_modulus(law)) * plastic_strain;
}

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
/// With q the von Mises stress of the trial and Y the yield stress so far,
///     flow = (q - Y) / (3 mu + H)  if q > Y, else 0,
///     stress = trial - 2 mu plastic,     plastic = (3/2) (flow / q) dev trial.
/// With linear hardening this is the closed solution of the implicit step: Simo & Hughes,
/// Computational Inelasticity (1998), Box 3.1; docs/theory/bilinear_plasticity.md.
///
/// What is stored changes by 1/2 s : C^-1 : s exactly. As in Elastic that is per current volume,
/// and what an element stores is an integral over its path. Hardening counts as dissipated.
///
/// strain    increment over the step, tensor components, in a frame that does not turn [-]
/// stress    Cauchy [Pa], old on entry and new on return
/// internal  equivalent plastic strain [-], updated
/// returns   work per current volume [J/m3]
///
/// Invariants  stored + dissipated = 1/2 (old + new) : strain;  dissipated >= 0;
///             von_mises(stress) <= yield_stress(law, internal.scalar[0]), equal after flow;
///             a step without flow is that of Elastic, to the last bit;
///             a rotation of strain and stress rotates the result.
/// Needs       yield > 0, 0 <= tangent < young, -1 < poisson < 1/2
template <class T>
NEREID_HOT Work<T> update_stress(const J2Bilinear& law, const Symmetric<T>& strain, Symmetric<T>& stress,
                      Internal<T, J2Bilinear, Symmetric>& internal) {
  const double mu = shear_modulus(law);
  const Symmetric<T> old = stress;
  const Symmetric<T> trial = old + hooke(law, strain);
  const Symmetric<T> shape = deviator(trial);

  // The larger of q^2 and Y^2 stands in for `if it yields`: sqrt(Y^2) is Y to the last bit, so
  // flow is exactly zero in elastic lanes, and none of them divides by zero.
  const T yield = yield_stress(law, internal.scalar[0]);
  const T q = root(larger(T(1.5) * contract(shape, shape), yield * yield));
  const T flow = T(1.0 / (3.0 * mu + hardening_modulus(law))) * (q - yield);
  const Symmetric<T> plastic = (T(1.5) * flow / q) * shape;

  stress = trial - T(2.0 * mu) * plastic;
  internal.scalar[0] = internal.scalar[0] + flow;
  return split_work(old, stress, strain, plastic);
}

/// The multiplier g >= 0 of the flow in a plate: zero, or the root of
///     q(g) (1 - slope g) = yield,     q(g)^2 = sum / (1 + sum_rate g)^2 + shear / (1 + shear_rate g)^2.
///
/// Newton runs on  1/q(g) - (1 - slope g) / yield,  which has the same root. This function is
/// increasing and concave for g >= 0, so from g = 0 the iterates climb to the root and never pass
/// it; and it is nearly straight, so about four suffice even for a trial a hundred times beyond
/// yield.
///
/// sum, shear             [Pa2] the two parts of the squared von Mises stress of the trial
/// yield                  [Pa] von Mises stress at which flow begins
/// sum_rate, shear_rate   [Pa] how fast the flow takes them back
/// slope                  [Pa] two thirds of the modulus by which the yield stress grows
/// returns                [1/Pa] exactly zero where sum + shear <= yield^2
///
/// Needs  yield, sum_rate, shear_rate > 0, slope >= 0
template <class T>
NEREID_HOT T flow_multiplier(const T& sum, const T& shear, const T& yield, const T& sum_rate, const T& shear_rate,
                             const T& slope) {
  const T one(1.0);
  Mask<T> moving = sum + shear > yield * yield;

  // Elastic lanes run along on the yield surface, where nothing divides by zero, and stay at g = 0.
  const T q2_sum = select(moving, sum, yield * yield);
  const T q2_shear = select(moving, shear, T(0.0));

  T g(0.0);
  constexpr int most = 30;          // four are usual; the bound only keeps a NaN from hanging
  constexpr double at_rest = 1e-9;  // relative; Newton squares it, so round-off alone is left
  for (int iteration = 0; iteration < most && any(moving); ++iteration) {
    const T a = one / (one + sum_rate * g), b = one / (one + shear_rate * g);
    const T part_sum = q2_sum * a * a, part_shear = q2_shear * b * b;
    const T q2 = part_sum + part_shear, q = root(q2);
    const T decay = (part_sum * sum_rate * a + part_shear * shear_rate * b) / q2;  // -(dq/dg) / q
    const T step = ((one - slope * g) * q - yield) / (yield * decay + slope * q);
    g = select(moving, larger(g + step, T(0.0)), g);  // round-off must not undo a tiny flow
    // A lane that has come to rest is left alone, so its bits do not depend on its neighbours.
    moving = moving && step * shear_rate > T(at_rest) * (one + shear_rate * g);
  }
  return g;
}

/// Return in plane stress: the plate thins plastically and its zz stress stays zero.
///
/// With s = xx + yy, d = xx - yy, t = xy of the trial stress, the multiplier g >= 0 of the flow
/// rule  plastic = g dev s_new  shrinks s by 1 / (1 + E g / (3 (1 - nu))) and d, t by
/// 1 / (1 + 2 mu g). It is the root of
///     q(g) (1 - 2/3 H g) = Y,     q(g)^2 = s(g)^2 / 4 + 3/4 d(g)^2 + 3 t(g)^2,
/// and the equivalent plastic strain grows by 2/3 g q(g). Simo & Taylor, Int. J. Numer. Meth. Engng
/// 22 (1986) 649; docs/theory/bilinear_plasticity.md.
///
/// strain, stress, internal, returns  as in space, with the components of the plane
///
/// Invariants  as in space
/// Needs       as in space
template <class T>
NEREID_HOT Work<T> update_stress(const J2Bilinear& law, const Plane<T>& strain, Plane<T>& stress,
                      Internal<T, J2Bilinear, Plane>& internal) {
  const double mu = shear_modulus(law), hardening = hardening_modulus(law);
  const T sum_rate(law.young / (3.0 * (1.0 - law.poisson))), shear_rate(2.0 * mu);
  const T one(1.0), slope(2.0 / 3.0 * hardening);

  const Plane<T> old = stress;
  const Plane<T> trial = old + hooke(law, strain);
  const T sum = trial.xx + trial.yy, difference = trial.xx - trial.yy;
  const T yield = yield_stress(law, internal.scalar[0]);
  const T trial_sum = T(0.25) * sum * sum;
  const T trial_shear = T(0.75) * difference * difference + T(3.0) * trial.xy * trial.xy;
  const T g = flow_multiplier(trial_sum, trial_shear, yield, sum_rate, shear_rate, slope);

  // Differences of the trial, not new values, so that g = 0 leaves every bit of it.
  const T a = one / (one + sum_rate * g), b = one / (one + shear_rate * g);
  const T less_sum = T(0.5) * sum * (sum_rate * g * a);
  const T less_difference = T(0.5) * difference * (shear_rate * g * b);
  stress = {trial.xx - less_sum - less_difference, trial.yy - less_sum + less_difference,
            trial.xy - trial.xy * (shear_rate * g * b)};
  // 2/3 g q, with q the new yield stress
  internal.scalar[0] = internal.scalar[0] + T(2.0 / 3.0) * g * yield / (one - slope * g);
  return split_work(old, stress, strain, g * deviator(stress));
}

static_assert(Law<J2Bilinear>);

}  // namespace nereid::material
