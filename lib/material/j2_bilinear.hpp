#pragma once
// Plasticity of von Mises with linear isotropic hardening; derived in
// docs/theory/bilinear_plasticity.md.

#include "material/j2.hpp"

namespace nereid::material {

/// A flow stress that grows linearly with the plastic strain.
struct LinearHardening {
  static constexpr std::array<Variable, 1> internal{{{"plastic_strain", "1"}}};
  double yield, tangent;  // [Pa] [Pa]
};

/// Isotropic elasticity up to a von Mises stress that grows linearly with the plastic strain.
///
/// Needs  yield > 0, 0 <= tangent < young, -1 < poisson < 1/2
using J2Bilinear = J2<LinearHardening>;

/// Growth of the yield stress with plastic strain:  H = E E_t / (E - E_t).
///
/// The tangent E_t is the slope of stress over *total* strain in uniaxial stress beyond yield, as
/// tables of materials give it; H is the slope over plastic strain: 1/E_t = 1/E + 1/H.
///
/// returns  [Pa]
/// Needs    0 <= tangent < young
inline double hardening_modulus(const J2Bilinear& law) {
  return law.young * law.flow.tangent / (law.young - law.flow.tangent);
}

/// The stress up to which the material is elastic now:  Y = yield + H plastic_strain.
///
/// plastic_strain  equivalent, accumulated [-]
/// returns         [Pa]
template <class T>
NEREID_HOT T yield_stress(const J2Bilinear& law, const T& plastic_strain) {
  return T(law.flow.yield) + T(hardening_modulus(law)) * plastic_strain;
}
template <class T>
NEREID_HOT T yield_stress(const J2Bilinear& law, const std::array<T, 1>& scalar) {
  return yield_stress(law, scalar[0]);
}

/// Flow of the return:  flow = (q - Y) / (3 mu + H), the closed solution with linear hardening.
///
/// returns  [-] exactly zero where q == Y
template <class T>
NEREID_HOT T flow_increment(const J2Bilinear& law, const Trial<T>& trial, const T& /*dt*/, const T& /*volume*/,
                            const std::array<T, 1>& /*scalar*/) {
  return T(1.0 / (3.0 * shear_modulus(law) + hardening_modulus(law))) * (trial.mises - trial.yield);
}

template <class T>
NEREID_HOT void remember(const J2Bilinear&, const T& flow, const T& /*dissipated*/, const T& /*volume*/, std::array<T, 1>& scalar) {
  scalar[0] = scalar[0] + flow;
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
/// increment, stress, internal, returns  as in space, with the components of the plane
///
/// Invariants  as in space
/// Needs       as in space
template <class T>
NEREID_HOT Response<T> update_stress(const J2Bilinear& law, const Increment<T, Plane>& increment, Plane<T>& stress,
                                     Internal<T, J2Bilinear, Plane>& internal) {
  const double mu = shear_modulus(law), hardening = hardening_modulus(law);
  const T sum_rate(law.young / (3.0 * (1.0 - law.poisson))), shear_rate(2.0 * mu);
  const T one(1.0), slope(2.0 / 3.0 * hardening);

  const Plane<T> old = stress;
  const Plane<T> trial = old + hooke(law, increment.strain);
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
  return {split_work(old, stress, increment.strain, g * deviator(stress)), lame(law)};
}

static_assert(PlateLaw<J2Bilinear>);

}  // namespace nereid::material
