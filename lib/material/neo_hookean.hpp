#pragma once
// The neo-Hookean law: elasticity with a potential, for strains at which a hypoelastic law is unstable.

#include "material/law.hpp"

namespace nereid::material {

/// Isotropic hyperelasticity, from the left Cauchy-Green tensor b = F F^T:
///
///     W = mu/2 (tr b - 3 - 2 ln J) + lambda/2 (ln J)^2  per volume of the reference,     s = (mu (b - 1) + lambda ln J 1) / J
///
/// (Simo & Pister 1984). A point remembers b - 1. Hooke's law in the limit of small strains.
struct NeoHookean {
  static constexpr std::array<Variable, 0> internal{};
  static constexpr std::array<Variable, 1> tensors{{{"left_cauchy_green_less_one", "1"}}};
  double density, young, poisson;  // [kg/m3] [Pa] [-]
};

/// a b, where the product is symmetric: where they have the same principal directions.
template <class T>
NEREID_HOT Symmetric<T> coaxial_product(const Symmetric<T>& a, const Symmetric<T>& b) {
  return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xy * b.xy + a.yy * b.yy + a.yz * b.yz, a.xz * b.xz + a.yz * b.yz + a.zz * b.zz,
          a.xx * b.xy + a.xy * b.yy + a.xz * b.yz, a.xy * b.xz + a.yy * b.yz + a.yz * b.zz, a.xx * b.xz + a.xy * b.yz + a.xz * b.zz};
}

/// det (1 + c).
template <class T>
NEREID_HOT T determinant_of_one_and(const Symmetric<T>& c) {
  const T second = c.xx * c.yy + c.yy * c.zz + c.xx * c.zz - c.xy * c.xy - c.yz * c.yz - c.xz * c.xz;
  const T third = c.xx * (c.yy * c.zz - c.yz * c.yz) - c.xy * (c.xy * c.zz - c.yz * c.xz) + c.xz * (c.xy * c.yz - c.yy * c.xz);
  return T(1.0) + (trace(c) + second + third);
}

/// Carries the left Cauchy-Green tensor over a step, and takes the stress from it:
///
///     b <- U b U,     U = (1 - e/2)^-1 (1 + e/2) = 1 + (1 - e/2)^-1 e
///
/// the stretch of a step whose strain e is of the middle; |e| stays below 2, where a length has gone to nothing. The potential is that of
/// the end, so a cycle that closes gives everything back, but for what the trapezoid rule makes of the work of its steps.
///
/// increment  its strain, tensor components, in a frame that does not turn [-]
/// stress     Cauchy [Pa], old on entry and new on return
/// internal   b - 1, updated [-]
/// returns    work per current volume [J/m3] and moduli whose squared frequencies bound those of the tangent:
///            lambda/J, and mu' with  2 J mu' = |mu - lambda ln J| + mu b_max [Pa]
///
/// Invariants  stored + dissipated = 1/2 (old + new) : strain;  dissipated = 0;
///             a rotation of strain, stress and tensor rotates the result.
/// Needs       -1 < poisson < 1/2
template <class T>
NEREID_HOT Response<T, T> update_stress(const NeoHookean& law, const Increment<T, Symmetric>& increment, Symmetric<T>& stress,
                                        Internal<T, NeoHookean, Symmetric>& internal) {
  const T half(0.5), one(1.0), zero(0.0);
  const Symmetric<T>& e = increment.strain;
  const Symmetric<T> old = stress;
  const Symmetric<T> A{one - half * e.xx, one - half * e.yy, one - half * e.zz, -half * e.xy, -half * e.yz, -half * e.xz};
  const Symmetric<T> over = adjugate(A);
  const Symmetric<T> u = (one / (A.xx * over.xx + A.xy * over.xy + A.xz * over.xz)) * coaxial_product(over, e);  // U - 1
  Symmetric<T>& c = internal.tensor[0];
  const Matrix<T> U{{one + u.xx, u.xy, u.xz}, {u.xy, one + u.yy, u.yz}, {u.xz, u.yz, one + u.zz}};
  c = rotate(U, c) + (T(2.0) * u + coaxial_product(u, u));

  const Lame small = lame(law);
  const T J2 = determinant_of_one_and(c), per_J = one / root(J2), log_J = half * logarithm(J2);
  const T spherical = T(small.lambda) * log_J, mu(small.mu);
  stress = per_J * Symmetric<T>{mu * c.xx + spherical, mu * c.yy + spherical, mu * c.zz + spherical, mu * c.xy, mu * c.yz, mu * c.xz};

  const Symmetric<T> shape = deviator(c);
  const T transverse = mu - spherical;
  const T largest = one + T(1.0 / 3.0) * trace(c) + T(2.0) * root(T(1.0 / 6.0) * contract(shape, shape) + T(1e-300));
  return {{half * contract(old + stress, e), zero},
          {T(small.lambda) * per_J, half * per_J * (larger(transverse, -transverse) + mu * largest)}};
}

static_assert(Law<NeoHookean> && !PlateLaw<NeoHookean>);

}  // namespace nereid::material
