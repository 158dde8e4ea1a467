#pragma once
// What every law is, and what every isotropic law shares.
//
// A law is data plus two free functions `update_stress`, one in space and one in the plane of a
// plate. It knows no element, no mesh and no file. It sees increments of strain in a frame that
// does not turn, and says where their work went.

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <string_view>

#include "base/number.hpp"
#include "base/tensor.hpp"

namespace nereid::material {

/// Where the work of one strain increment went, per current volume. [J/m3]
template <class T>
struct Work {
  T stored, dissipated;
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

/// A law: isotropic data, the names of its internal scalars and tensors, and the two updates of stress.
///
/// The updates are templates on the number type; the concept asks for `double`, and
/// tests/material/law_test.cpp runs every law on packs and dual numbers too.
template <class L>
concept Law = Isotropic<L> &&
    requires(const L& law, Internal<double, L, Symmetric>& internal, Internal<double, L, Plane>& plane_internal,
             const Symmetric<double>& strain, Symmetric<double>& stress,
             const Plane<double>& plane_strain, Plane<double>& plane_stress) {
  { L::internal[0] } -> std::convertible_to<std::string_view>;
  { L::tensors[0] } -> std::convertible_to<std::string_view>;
  { update_stress(law, strain, stress, internal) } -> std::same_as<Work<double>>;
  { update_stress(law, plane_strain, plane_stress, plane_internal) } -> std::same_as<Work<double>>;
};

/// Lame's constants. [Pa]
struct Lame {
  double lambda, mu;
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

/// Speed of the fastest wave in space, the dilatational one:  c = sqrt((lambda + 2 mu) / density).
///
/// returns  [m/s]
template <Isotropic L>
NEREID_HOT double wave_speed(const L& law) {
  const auto [lambda, mu] = lame(law);
  return std::sqrt((lambda + 2.0 * mu) / law.density);
}

/// Speed of the fastest wave in a thin plate:  c = sqrt(E / (density (1 - nu^2))).
///
/// returns  [m/s]
template <Isotropic L>
NEREID_HOT double plate_wave_speed(const L& law) {
  return std::sqrt(law.young / (law.density * (1.0 - law.poisson * law.poisson)));
}

/// The part of a tensor that changes shape and not volume:  dev a = a - (tr a / 3) 1.
template <class T>
NEREID_HOT Symmetric<T> deviator(const Symmetric<T>& a) {
  const T mean = T(1.0 / 3.0) * trace(a);
  return {a.xx - mean, a.yy - mean, a.zz - mean, a.xy, a.yz, a.xz};
}

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
