#pragma once
// What every law is, and what every isotropic law shares.
//
// A law is data plus a free function `update_stress` in space and, if plates may have it, one in the plane of a
// plate. It knows no element, no mesh and no file. It sees increments of strain in a frame that does not turn; it
// answers with the new stress, where the work went, and its elastic moduli as they are now.

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <utility>

#include "base/number.hpp"
#include "base/tensor.hpp"

namespace nereid::material {

/// One increment of a point, as its law sees it.
///
/// S  Symmetric in space, Plane in a plate
template <class T, template <class> class S>
struct Increment {
  S<T> strain;  ///< [-] tensor components, in a frame that does not turn
  T dt;         ///< [s] above zero
  T volume;     ///< [-] current over reference, in the middle of the increment, where the strain is taken
};

/// Where the work of one strain increment went, per current volume. [J/m3]
template <class T>
struct Work {
  T stored, dissipated;
};

/// Elastic moduli: those of Lame. [Pa]
///
/// N  double where they never change, which costs nothing; T where they follow the state
template <class N>
struct Moduli {
  N lambda, mu;
};
using Lame = Moduli<double>;

/// What a law answers besides the stress. Stable steps and viscosity follow from the moduli.
template <class T, class N = double>
struct Response {
  Work<T> work;
  Moduli<N> moduli;
};

/// A scalar or a tensor that a point remembers: its name and its SI unit.
struct Variable {
  std::string_view name, unit;
};

/// Data that has the two constants of isotropic elasticity and a density.
template <class L>
concept Isotropic = requires(const L& law) {
  { law.density } -> std::convertible_to<double>;  // [kg/m3]
  { law.young } -> std::convertible_to<double>;    // [Pa]
  { law.poisson } -> std::convertible_to<double>;  // [-] above -1 and below 1/2
};

/// What one point remembers for a law besides its stress: a number for each name in `internal` and a
/// tensor for each name in `tensors`.
///
/// S  Symmetric in space, Plane in a plate; elements turn these tensors with the stress
template <class T, class L, template <class> class S>
struct Internal {
  std::array<T, L::internal.size()> scalar;
  std::array<S<T>, L::tensors.size()> tensor;
  template <class F>
  void each_row(F&& f) {
    for (T& row : scalar) f(row);
    for (S<T>& each : tensor) each.each_row(f);
  }
  static constexpr int rows = static_cast<int>(L::internal.size() + L::tensors.size() * S<T>::rows);
};

/// What a point remembers before anything has happened to it: the values that the law starts its scalars with.
///
/// returns  zeros, unless the law has a function `start_values`
template <class T, template <class> class S, class L>
Internal<T, L, S> fresh(const L& law) {
  Internal<T, L, S> internal{};
  if constexpr (requires { start_values(law); }) {
    const std::array<double, L::internal.size()> values = start_values(law);
    for (std::size_t i = 0; i < values.size(); ++i) internal.scalar[i] = T(values[i]);
  }
  return internal;
}
/// The same, of the type of another memory.
template <class T, template <class> class S, class L>
Internal<T, L, S> fresh_like(const Internal<T, L, S>&, const L& law) {
  return fresh<T, S>(law);
}

/// A law: isotropic data, its internal scalars and the names of its tensors, and the update of stress.
///
/// The updates are templates on the number type; the concept asks for `double`, and
/// tests/material/law_test.cpp and neo_hookean_test.cpp run every law on packs and dual numbers too.
template <class L>
concept Law = Isotropic<L> &&
    requires(const L& law, Internal<double, L, Symmetric>& internal, const Increment<double, Symmetric>& increment,
             Symmetric<double>& stress) {
  { L::internal[0] } -> std::convertible_to<Variable>;
  { L::tensors[0] } -> std::convertible_to<Variable>;
  { update_stress(law, increment, stress, internal).work } -> std::convertible_to<Work<double>>;
  { update_stress(law, increment, stress, internal).moduli } -> std::convertible_to<Lame>;
};

/// A law that plates may have: it also has an update with zz = 0.
template <class L>
concept PlateLaw = Law<L> &&
    requires(const L& law, Internal<double, L, Plane>& internal, const Increment<double, Plane>& increment, Plane<double>& stress) {
  { update_stress(law, increment, stress, internal).work } -> std::convertible_to<Work<double>>;
  { update_stress(law, increment, stress, internal).moduli } -> std::convertible_to<Lame>;
};

/// The shear modulus:  mu = E / (2 (1 + nu)).
///
/// returns  [Pa]
template <Isotropic L>
NEREID_HOT double shear_modulus(const L& law) {
  return law.young / (2.0 * (1.0 + law.poisson));
}

/// The bulk modulus:  K = E / (3 (1 - 2 nu)).
///
/// returns  [Pa]
/// Needs    poisson < 1/2
template <Isotropic L>
NEREID_HOT double bulk_modulus(const L& law) {
  return law.young / (3.0 * (1.0 - 2.0 * law.poisson));
}

/// Lame's constants:  lambda = nu E / ((1 + nu) (1 - 2 nu)),  mu = E / (2 (1 + nu)).
///
/// returns  [Pa]
/// Needs    poisson < 1/2
template <Isotropic L>
NEREID_HOT Lame lame(const L& law) {
  const double mu = shear_modulus(law);
  return {2.0 * mu * law.poisson / (1.0 - 2.0 * law.poisson), mu};
}

/// What a law gives as moduli: Moduli<double> where they never change.
template <class T, template <class> class S, class L>
using ModuliOf = decltype(update_stress(std::declval<const L&>(), std::declval<const Increment<T, S>&>(), std::declval<S<T>&>(),
                                        std::declval<Internal<T, L, S>&>()).moduli);

/// The larger moduli of two points: what a stable step must reckon with.
template <class N>
NEREID_HOT Moduli<N> stiffer(const Moduli<N>& a, const Moduli<N>& b) {
  return {larger(a.lambda, b.lambda), larger(a.mu, b.mu)};
}

/// Speed of the fastest wave in space, the dilatational one:  c = sqrt((lambda + 2 mu) / density).
///
/// density  [kg/m3] of the reference
/// returns  [m/s]
template <class N>
NEREID_HOT N wave_speed(const Moduli<N>& m, double density) {
  return root((m.lambda + N(2.0) * m.mu) / N(density));
}
template <Isotropic L>
NEREID_HOT double wave_speed(const L& law) {
  return wave_speed(lame(law), law.density);
}

/// lambda of plane stress, of a plate that is free to thin:  2 lambda mu / (lambda + 2 mu) = nu E / (1 - nu^2).
///
/// returns  [Pa]
template <class N>
NEREID_HOT N plane_lambda(const Moduli<N>& m) {
  return N(2.0) * m.lambda * m.mu / (m.lambda + N(2.0) * m.mu);
}

/// Speed of the fastest wave in a thin plate:  c = sqrt((plane lambda + 2 mu) / density) = sqrt(E / (density (1 - nu^2))).
///
/// returns  [m/s]
template <class N>
NEREID_HOT N plate_wave_speed(const Moduli<N>& m, double density) {
  return root((plane_lambda(m) + N(2.0) * m.mu) / N(density));
}
template <Isotropic L>
NEREID_HOT double plate_wave_speed(const L& law) {
  return plate_wave_speed(lame(law), law.density);
}

/// The part of a tensor that changes shape and not volume:  dev a = a - (tr a / 3) 1.
template <class T>
NEREID_HOT Symmetric<T> deviator(const Symmetric<T>& a) {
  const T mean = T(1.0 / 3.0) * trace(a);
  return {a.xx - mean, a.yy - mean, a.zz - mean, a.xy, a.yz, a.xz};
}

/// The logarithmic strain of volume at a stress in a plate:  tr s / 3 K = (1 - 2 nu) / E (xx + yy).
///
/// It holds, at any strain and after any flow, for every law that adds Hooke's stress and whose flow keeps volume; a rotation does
/// not change the trace.
template <Isotropic L, class T>
NEREID_HOT T volume_strain(const L& law, const Plane<T>& stress) {
  return T((1.0 - 2.0 * law.poisson) / law.young) * (stress.xx + stress.yy);
}

/// Whether a law flows: it remembers a plastic strain.
template <class L>
constexpr bool flows = [] {
  for (const Variable& variable : L::internal)
    if (variable.name == "plastic_strain") return true;
  return false;
}();

/// The deviator, in the plane, of a tensor whose zz component is zero.
///
/// Its zz component is minus the sum of the two normal ones. For a strain that is plastic, and so
/// keeps volume, that is the thinning of the plate.
template <class T>
NEREID_HOT Plane<T> deviator(const Plane<T>& a) {
  const T mean = T(1.0 / 3.0) * (a.xx + a.yy);
  return {a.xx - mean, a.yy - mean, a.xy};
}

/// The stress of von Mises:  q = sqrt(3/2 dev s : dev s); in uniaxial stress q = |s|.
///
/// stress   [Pa] Cauchy
/// returns  [Pa]
/// Needs    a stress that is not hydrostatic, if T is a dual number: q has a kink there
template <class T>
NEREID_HOT T von_mises(const Symmetric<T>& stress) {
  const Symmetric<T> shape = deviator(stress);
  return root(T(1.5) * contract(shape, shape));
}

/// The stress of von Mises in a plate:  q^2 = (xx + yy)^2 / 4 + 3 (xx - yy)^2 / 4 + 3 xy^2.
///
/// stress   [Pa] Cauchy, zz = 0
/// returns  [Pa]
/// Needs    a stress that is not zero, if T is a dual number
template <class T>
NEREID_HOT T von_mises(const Plane<T>& stress) {
  const T sum = stress.xx + stress.yy, difference = stress.xx - stress.yy;
  return root(T(0.25) * sum * sum + T(0.75) * difference * difference +
              T(3.0) * stress.xy * stress.xy);
}

/// Pressure, positive in compression:  p = -tr s / 3.
///
/// returns  [Pa]
template <class T>
NEREID_HOT T pressure(const Symmetric<T>& stress) {
  return T(-1.0 / 3.0) * trace(stress);
}

/// Stress of an elastic strain by Hooke's law:  lambda (tr e) 1 + 2 mu e.
///
/// returns  [Pa]
template <Isotropic L, class T>
NEREID_HOT Symmetric<T> hooke(const L& law, const Symmetric<T>& strain) {
  const auto [lambda, mu] = lame(law);
  const T volumetric = T(lambda) * trace(strain), twice_mu(2.0 * mu);
  return {volumetric + twice_mu * strain.xx,
          volumetric + twice_mu * strain.yy,
          volumetric + twice_mu * strain.zz,
          twice_mu * strain.xy,
          twice_mu * strain.yz,
          twice_mu * strain.xz};
}

/// Energy of a stress by Hooke's law, per volume:  ((1 + nu) s : s - nu (tr s)^2) / 2 E. [J/m3]
template <class T, Isotropic L>
NEREID_HOT T hooke_energy(const L& law, const Symmetric<T>& s) {
  const T tr = trace(s);
  return T(0.5 / law.young) * (T(1.0 + law.poisson) * contract(s, s) - T(law.poisson) * tr * tr);
}

/// Stress of an elastic strain in a plate, free to thin so that zz = 0:
/// E / (1 - nu^2) (xx + nu yy) along x, and so along y;  2 mu xy in shear.
///
/// returns  [Pa]
template <Isotropic L, class T>
NEREID_HOT Plane<T> hooke(const L& law, const Plane<T>& strain) {
  const T stiffness(law.young / (1.0 - law.poisson * law.poisson)), poisson(law.poisson);
  return {stiffness * (strain.xx + poisson * strain.yy),
          stiffness * (strain.yy + poisson * strain.xx), T(2.0 * shear_modulus(law)) * strain.xy};
}

}  // namespace nereid::material
