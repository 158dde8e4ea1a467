#pragma once
// Hooke's law of the logarithmic strain, in rate form.

#include "material/law.hpp"

namespace nereid::material {

/// Isotropic elasticity: the increment of stress is Hooke's of the increment of strain.
struct Elastic {
  static constexpr std::array<Variable, 0> internal{};
  static constexpr std::array<Variable, 0> tensors{};
  double density, young, poisson;  // [kg/m3] [Pa] [-]
};

/// [h, [h, d]] of symmetric tensors: (h_i - h_j)^2 d_ij along the principal directions of h.
template <class T>
NEREID_HOT Symmetric<T> commuted_twice(const Symmetric<T>& h, const Symmetric<T>& d) {
  // the axial vector of the skew h d - d h
  const T z = h.xx * d.xy + h.xy * d.yy + h.xz * d.yz - d.xx * h.xy - d.xy * h.yy - d.xz * h.yz;
  const T y = h.xx * d.xz + h.xy * d.yz + h.xz * d.zz - d.xx * h.xz - d.xy * h.yz - d.xz * h.zz;
  const T x = h.xy * d.xz + h.yy * d.yz + h.yz * d.zz - d.xy * h.xz - d.yy * h.yz - d.yz * h.zz;
  const T two(2.0);
  return {-two * (h.xy * z + h.xz * y), two * (h.xy * z - h.yz * x), two * (h.xz * y + h.yz * x),
          (h.xx - h.yy) * z - h.xz * x - h.yz * y, (h.yy - h.zz) * x + h.xy * y + h.xz * z, (h.xx - h.zz) * y + h.xy * x - h.yz * z};
}
template <class T>
NEREID_HOT Plane<T> commuted_twice(const Plane<T>& h, const Plane<T>& d) {
  const T difference = h.xx - h.yy, z = difference * d.xy - h.xy * (d.xx - d.yy);
  const T along = T(2.0) * h.xy * z;
  return {-along, along, difference * z};
}

constexpr double small_shape = 1e-6;    ///< [-] dev h : dev h, below which Jaumann's rate differs by less than 7e-7
constexpr double largest_shape = 2.0;   ///< [-] the same, up to which x stays below 2; larger strains count as this one

/// What the logarithmic rate adds to Jaumann's: with the logarithmic strain h and its principal values h_i, the rate of h_ij is
/// d_ij x coth x, x = h_i - h_j, in the frame that turns with the spin (Xiao, Bruhns & Meyers 1997):
///
///     x coth x = 1 + x^2/3 - x^4/45 + 0.00151 x^6,      within 0.2 % up to x = 2; the last coefficient makes it exact there
///
/// so a path that only stretches has the rate of Jaumann, and a cycle of strain that closes leaves no stress.
///
/// h  [-] elastic strain of the stress before;  d  [-] increment of strain
template <class T, template <class> class S>
NEREID_HOT S<T> added_by_logarithmic_rate(const S<T>& h, const S<T>& d) {
  const S<T> second = commuted_twice(h, d), fourth = commuted_twice(h, second);
  return T(1.0 / 3.0) * second - T(1.0 / 45.0) * fourth + T(0.00151) * commuted_twice(h, fourth);
}

/// dev s : dev s. [Pa2]
template <class T>
NEREID_HOT T square_of_shape(const Symmetric<T>& stress) {
  const Symmetric<T> shape = deviator(stress);
  return contract(shape, shape);
}
template <class T>
NEREID_HOT T square_of_shape(const Plane<T>& s) {
  return T(2.0 / 3.0) * (s.xx * s.xx - s.xx * s.yy + s.yy * s.yy) + T(2.0) * s.xy * s.xy;
}

/// Adds the stress of added_by_logarithmic_rate() where the strain of the stress before is not small.
///
/// old  [Pa] the stress before;  strain  [-] increment
template <class T, template <class> class S>
NEREID_HOT void add_logarithmic_rate(const Elastic& law, const S<T>& old, const S<T>& strain, S<T>& stress) {
  const double mu = shear_modulus(law), square = 4.0 * mu * mu;
  const T shape = square_of_shape(old);
  const auto large = shape > T(square * small_shape);
  if (!any(large)) return;
  const T part = select(large, T(2.0 * mu), T(0.0)), within = root(T(square * largest_shape) / larger(shape, T(square * largest_shape)));
  stress = stress + part * added_by_logarithmic_rate((T(0.5 / mu) * within) * old, strain);  // spherical parts commute
}

/// Adds to the stress what Hooke's law makes of a strain increment:  s += lambda (tr e) 1 + 2 mu (e + e'),  with what the logarithmic rate
/// adds where the strain is not small.
///
/// All work 1/2 (old + new) : e is stored, per *current* volume. At small strains that is the change of the energy 1/2 s : C^-1 : s
/// exactly; what the rate adds does no work against the old stress. As the volume changes with the strain, the law has no potential at
/// large strain (it is hypoelastic), and what an element stores is an integral over its path.
///
/// The moduli are those of small strains. Shear between principal axes is stiffer by x coth x, up to twice at x = 2, which the bound on the
/// step does not count.
///
/// increment  its strain, tensor components, in a frame that does not turn [-]
/// stress     Cauchy [Pa], old on entry and new on return
/// returns    work per current volume [J/m3] and the moduli, which are constant [Pa]
///
/// Invariants  stored + dissipated = 1/2 (old + new) : strain;  dissipated = 0;
///             a rotation of strain and stress rotates the result.
/// Needs       -1 < poisson < 1/2
template <class T>
NEREID_HOT Response<T> update_stress(const Elastic& law, const Increment<T, Symmetric>& increment, Symmetric<T>& stress,
                                     Internal<T, Elastic, Symmetric>& /*internal*/) {
  const Symmetric<T> old = stress;
  stress = old + hooke(law, increment.strain);
  add_logarithmic_rate(law, old, increment.strain, stress);
  return {{T(0.5) * contract(old + stress, increment.strain), T(0.0)}, lame(law)};
}

/// The same in a plate, which thins so that its zz stress stays zero and does no work.
template <class T>
NEREID_HOT Response<T> update_stress(const Elastic& law, const Increment<T, Plane>& increment, Plane<T>& stress,
                                     Internal<T, Elastic, Plane>& /*internal*/) {
  const Plane<T> old = stress;
  stress = old + hooke(law, increment.strain);
  add_logarithmic_rate(law, old, increment.strain, stress);
  return {{T(0.5) * contract(old + stress, increment.strain), T(0.0)}, lame(law)};
}

static_assert(PlateLaw<Elastic>);

}  // namespace nereid::material
