#pragma once
// Plasticity of von Mises whose yield surface grows, moves, or does both, linearly; derived in
// docs/theory/bilinear_plasticity.md, "Kinematic hardening".

#include "material/j2_bilinear.hpp"

namespace nereid::material {

/// Isotropic elasticity inside a yield surface that grows with the plastic strain and moves along with it.
///
/// `isotropic` is the share of the hardening modulus that makes the surface grow; the rest moves it
/// (Prager): 0 is kinematic hardening, 1 is J2Bilinear. Under a load that only grows all shares give one curve.
struct J2Mixed {
  static constexpr std::array<Variable, 1> internal{{{"plastic_strain", "1"}}};
  static constexpr std::array<Variable, 1> tensors{{{"back_stress", "Pa"}}};
  double density, young, poisson, yield, tangent;  // [kg/m3] [Pa] [-] [Pa] [Pa]
  double isotropic;                                // [-] 0 to 1
};

/// How the hardening modulus  H = E E_t / (E - E_t)  is shared out. [Pa]
struct HardeningModuli {
  double isotropic, kinematic;  // their sum is H
};

/// The two moduli:  isotropic = share H,  kinematic = (1 - share) H.
///
/// returns  [Pa]
/// Needs    0 <= tangent < young
inline HardeningModuli hardening_moduli(const J2Mixed& law) {
  const double both = law.young * law.tangent / (law.young - law.tangent);
  return {law.isotropic * both, (1.0 - law.isotropic) * both};
}

/// Radius of the yield surface now, as a von Mises stress:  Y = yield + H_isotropic plastic_strain.
///
/// plastic_strain  equivalent, accumulated [-]
/// returns         [Pa]
template <class T>
NEREID_HOT T yield_stress(const J2Mixed& law, const T& plastic_strain) {
  return T(law.yield) + T(hardening_moduli(law).isotropic) * plastic_strain;
}
template <class T>
NEREID_HOT T yield_stress(const J2Mixed& law, const std::array<T, 1>& scalar) {
  return yield_stress(law, scalar[0]);
}

/// Where in space the yield surface has its centre: the back stress itself.
template <class T>
NEREID_HOT Symmetric<T> surface_centre(const Symmetric<T>& back_stress) {
  return back_stress;
}
/// Where in the plane of a plate it has: the stress with zz = 0 whose deviator is the back stress.
///
/// back_stress  [Pa] components in the plane of a deviator, so its zz is -(xx + yy)
/// returns      [Pa]
template <class T>
NEREID_HOT Plane<T> surface_centre(const Plane<T>& back_stress) {
  const T across = back_stress.xx + back_stress.yy;
  return {back_stress.xx + across, back_stress.yy + across, back_stress.xy};
}

/// Splits the work of a plastic step:  total = 1/2 (old + new) : strain,
/// dissipated = 1/2 (old + new - both centres) : plastic,  stored = total - dissipated.
///
/// S        Symmetric<T> or Plane<T>
/// both     sum of the old and the new stress [Pa]
/// shifted  the same of stress less centre [Pa]
/// plastic  increment of plastic strain [-]
/// returns  work per current volume [J/m3]
///
/// Invariants  dissipated >= 0: what split_work of J2Bilinear says of the stress holds here of the shifted one
template <class T, template <class> class S>
NEREID_HOT Work<T> split_shifted_work(const S<T>& both, const S<T>& shifted, const S<T>& strain, const S<T>& plastic) {
  const T total = T(0.5) * contract(both, strain);
  const T dissipated = larger(T(0.5) * contract(shifted, plastic), T(0.0));
  return {total - dissipated, dissipated};
}

/// Radial return about the back stress.
///
/// With xi = dev trial - back_stress, q its von Mises stress and Y the radius so far,
///     flow = (q - Y) / (3 mu + H)  if q > Y, else 0,     plastic = (3/2) (flow / q) xi,
///     stress = trial - 2 mu plastic,     back_stress += 2/3 H_kinematic plastic.
/// Simo & Hughes, Computational Inelasticity (1998), Box 3.1; Prager, J. Appl. Mech. 23 (1956) 493;
/// docs/theory/bilinear_plasticity.md.
///
/// What is stored changes by 1/2 s : C^-1 : s + 3/(4 H_kinematic) a : a exactly, a the back stress: to move the
/// surface costs work that its way back returns. Growth of the surface counts as dissipated.
///
/// increment  its strain, tensor components, in a frame that does not turn [-]
/// stress    Cauchy [Pa], old on entry and new on return
/// internal  equivalent plastic strain [-]; back stress [Pa], a deviator; updated
/// returns   work per current volume [J/m3] and the moduli, which are constant [Pa]
///
/// Invariants  stored + dissipated = 1/2 (old + new) : strain;  dissipated >= 0;
///             von_mises(stress - back_stress) <= yield_stress(law, plastic strain), equal after flow;
///             a step without flow is that of Elastic, to the last bit;
///             a rotation of strain, stress and back stress rotates the result.
/// Needs       yield > 0, 0 <= tangent < young, -1 < poisson < 1/2, 0 <= isotropic <= 1
template <class T>
NEREID_HOT Response<T> update_stress(const J2Mixed& law, const Increment<T, Symmetric>& increment, Symmetric<T>& stress,
                                     Internal<T, J2Mixed, Symmetric>& internal) {
  const double mu = shear_modulus(law);
  const auto [isotropic, kinematic] = hardening_moduli(law);
  Symmetric<T>& back = internal.tensor[0];
  const Symmetric<T> old = stress, old_shifted = old - back;
  const Symmetric<T> trial = old + hooke(law, increment.strain);
  const Symmetric<T> shape = deviator(trial - back);

  // The larger of q^2 and Y^2 stands in for `if it yields`, as in J2Bilinear.
  const T yield = yield_stress(law, internal.scalar[0]);
  const T q = root(larger(T(1.5) * contract(shape, shape), yield * yield));
  const T flow = T(1.0 / (3.0 * mu + isotropic + kinematic)) * (q - yield);
  const Symmetric<T> plastic = (T(1.5) * flow / q) * shape;

  stress = trial - T(2.0 * mu) * plastic;
  back = back + T(2.0 / 3.0 * kinematic) * plastic;
  internal.scalar[0] = internal.scalar[0] + flow;
  return {split_shifted_work(old + stress, old_shifted + (stress - back), increment.strain, plastic), lame(law)};
}

/// Return in plane stress about the centre of the surface.
///
/// J2Bilinear's return with s, d, t of the trial stress less the centre, in which the centre comes to meet the
/// stress: s shrinks by 1 / (1 + (E / (3 (1 - nu)) + 2/3 H_kinematic) g), and d, t by
/// 1 / (1 + (2 mu + 2/3 H_kinematic) g), while the radius grows with H_isotropic alone.
/// Simo & Taylor, Int. J. Numer. Meth. Engng 22 (1986) 649; docs/theory/bilinear_plasticity.md.
///
/// increment, stress, internal, returns  as in space, with the components of the plane; the back stress is a deviator
///                                    of space, with zz = -(xx + yy)
///
/// Invariants  as in space, with surface_centre(back stress) in the place of the back stress
/// Needs       as in space
template <class T>
NEREID_HOT Response<T> update_stress(const J2Mixed& law, const Increment<T, Plane>& increment, Plane<T>& stress,
                                     Internal<T, J2Mixed, Plane>& internal) {
  const auto [isotropic, kinematic] = hardening_moduli(law);
  const T elastic_sum(law.young / (3.0 * (1.0 - law.poisson))), elastic_shear(2.0 * shear_modulus(law));
  const T one(1.0), half(0.5), slope(2.0 / 3.0 * isotropic), motion(2.0 / 3.0 * kinematic);
  const T sum_rate = elastic_sum + motion, shear_rate = elastic_shear + motion;

  const Plane<T> old = stress, centre = surface_centre(internal.tensor[0]), old_shifted = old - centre;
  const Plane<T> trial = old + hooke(law, increment.strain), shifted = trial - centre;
  const T half_sum = half * (shifted.xx + shifted.yy), half_difference = half * (shifted.xx - shifted.yy);
  const T yield = yield_stress(law, internal.scalar[0]);
  const T g = flow_multiplier(half_sum * half_sum,
                              T(3.0) * (half_difference * half_difference + shifted.xy * shifted.xy), yield,
                              sum_rate, shear_rate, slope);

  // Differences of the trial, not new values, so that g = 0 leaves every bit of it.
  const T now_sum = half_sum / (one + sum_rate * g), b = one / (one + shear_rate * g);
  const T now_difference = half_difference * b, now_xy = shifted.xy * b;
  const T less_sum = elastic_sum * g * now_sum, less_difference = elastic_shear * g * now_difference;
  stress = {trial.xx - less_sum - less_difference, trial.yy - less_sum + less_difference,
            trial.xy - elastic_shear * g * now_xy};
  const Plane<T> now_shifted{now_sum + now_difference, now_sum - now_difference, now_xy};
  const Plane<T> plastic = g * deviator(now_shifted);
  internal.tensor[0] = internal.tensor[0] + motion * plastic;
  // 2/3 g q, with q the new radius
  internal.scalar[0] = internal.scalar[0] + T(2.0 / 3.0) * g * yield / (one - slope * g);
  return {split_shifted_work(old + stress, old_shifted + now_shifted, increment.strain, plastic), lame(law)};
}

static_assert(PlateLaw<J2Mixed>);

}  // namespace nereid::material
