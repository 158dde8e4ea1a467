#pragma once
// The 8-node hexahedron with eight points (2 x 2 x 2 of Gauss) and assumed strains.
//
// The strains are those of the one-point hexahedron, taken at eight points: the mean one, and what assumed_strain.hpp makes of the
// hourglass motions, linear in the coordinates. So it bends as a beam and as a plate do at any aspect ratio, it does not lock as it becomes
// incompressible, and it needs no hourglass control. Plasticity is followed at each point. docs/theory/hexahedron.md.

#include <algorithm>
#include <array>

#include "element/hexahedron.hpp"

namespace nereid::element {

/// A tensor field of a hexahedron over the signs of its points: linear[k] goes with coordinate k, product[k] with the two others.
template <class T>
struct PointField {
  Symmetric<T> mean;
  std::array<Symmetric<T>, 3> linear, product;
};

/// Values at the eight points, numbered like the nodes:  mean + sum of s_k linear_k + s_i s_j product_k,   s = -1 or 1
template <class T>
NEREID_HOT std::array<Symmetric<T>, 8> at_points(const PointField<T>& f) {
  std::array<Symmetric<T>, 8> at;
  const auto four = [&at](int first, const Symmetric<T>& mean, const Symmetric<T>& xi, const Symmetric<T>& eta, const Symmetric<T>& both) {
    const Symmetric<T> low = mean - eta, high = mean + eta, low_xi = xi - both, high_xi = xi + both;
    at[first] = low - low_xi, at[first + 1] = low + low_xi, at[first + 2] = high + high_xi, at[first + 3] = high - high_xi;
  };
  four(0, f.mean - f.linear[2], f.linear[0] - f.product[1], f.linear[1] - f.product[0], f.product[2]);
  four(4, f.mean + f.linear[2], f.linear[0] + f.product[1], f.linear[1] + f.product[0], f.product[2]);
  return at;
}

/// The transpose of at_points(): sums of eight values with the signs of each part.
template <class T>
NEREID_HOT PointField<T> sums_over_points(const std::array<Symmetric<T>, 8>& at) {
  struct Four {
    Symmetric<T> mean, xi, eta, both;
  };
  const auto four = [&at](int first) {
    const Symmetric<T> low = at[first + 1] + at[first], high = at[first + 2] + at[first + 3];
    const Symmetric<T> low_xi = at[first + 1] - at[first], high_xi = at[first + 2] - at[first + 3];
    return Four{high + low, high_xi + low_xi, high - low, high_xi - low_xi};
  };
  const Four low = four(0), high = four(4);
  return {.mean = high.mean + low.mean, .linear = {high.xi + low.xi, high.eta + low.eta, high.mean - low.mean},
          .product = {high.eta - low.eta, high.xi - low.xi, high.both + low.both}};
}

constexpr double gauss = 0.57735026918962576451;  // 1/sqrt(3), where the points are

/// The fully integrated hexahedron as a kind of element.
struct FullHexahedron {
  static constexpr int nodes = 8, dimensions = 3, axes = 3, sides = 6, arms = 0;
  static constexpr int gauss_points = 8;
  static constexpr bool rotates = false, layered = false;
  static constexpr std::array stored_channels{Stored::elastic, Stored::distortion};
  static constexpr std::array dissipated_channels{Dissipated::plastic, Dissipated::viscous};

  struct Options {
    Viscosity viscosity;
    Distortion distortion{};
  };
  static bool has(const Options& options, Stored channel) { return channel != Stored::distortion || acts(options.distortion); }
  static bool has(const Options&, Dissipated) { return true; }
  /// How deep the element is behind a face of it, from its volume and the area of the face. [m]
  static double depth(const Options&, double volume, double area) { return volume / area; }
  /// Distance between the two faces of a plate; zero of a solid. [m]
  static double thickness(const Options&) { return 0; }

  /// Constants of one element.
  template <class T>
  struct Constants {
    T mass, per_mass;  ///< [kg] and its inverse
    T start;           ///< [m3] Jacobian of a corner below which distortion control acts
    template <class F>
    void each_row(F&& f) { f(mass), f(per_mass), f(start); }
    static constexpr int rows = 3;
  };

  template <class T, class Law>
  struct Point {
    Symmetric<T> stress;                             ///< [Pa] Cauchy
    material::Internal<T, Law, Symmetric> internal;  ///< of the law
  };

  /// What one element remembers from step to step; in the global frame, turned with the element.
  template <class T, class Law>
  struct Memory {
    std::array<Point<T, Law>, gauss_points> points;  ///< numbered like the nodes
    std::array<T, 3> across;                         ///< [Pa] sums over the points of +- the stress across each plane of the centre
    T distortion;                                    ///< [J] that distortion control stores; no row without it
    Symmetric<T> viscous;                            ///< [Pa] not stored without viscosity
    template <class F>
    void each_row(F&& f, const Options& options) {
      for (auto& point : points) point.stress.each_row(f), point.internal.each_row(f);
      for (T& left : across) f(left);
      if (acts(options.distortion)) f(distortion);
      if (acts(options.viscosity)) viscous.each_row(f);
    }
    template <class F>
    void each_internal(F&& f) {
      for (auto& point : points) f(point.internal);
    }
    static constexpr int rows(const Options& options) {
      return FullHexahedron::gauss_points * (6 + material::Internal<T, Law, Symmetric>::rows) + 3 + (acts(options.distortion) ? 1 : 0) +
             (acts(options.viscosity) ? 6 : 0);
    }
  };
};

/// Vectors of plane k of a centre frame: dual to its tangents i and j, and the unit normal.
template <class T>
struct PlaneBasis {
  Vector<T> i, j;  ///< [1/m]
  Vector<T> normal;
};
template <class T>
NEREID_HOT PlaneBasis<T> plane_basis(const CentreFrame<T>& f, int k) {
  const Vector<T>&a = f.g[(k + 1) % 3], &b = f.g[(k + 2) % 3], area = cross(a, b);
  const auto& A = f.raised[k];
  return {.i = A.ii * a + A.ij * b, .j = A.ij * a + A.jj * b, .normal = (T(1.0) / norm(area)) * area};
}

/// a (x) b where the sum of all such terms is symmetric.
template <class T>
NEREID_HOT Symmetric<T> outer(const Vector<T>& a, const Vector<T>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z, a.x * b.y, a.y * b.z, a.x * b.z};
}

/// The assumed strains at the points; see moments_from() for e.
///
///     mean + s_k/sqrt(3) (e_ii a^i a^i + e_jj a^j a^j + e_ij (a^i a^j + a^j a^i)) + s_k c_k n n     of each plane
///          + s_i s_j/3 (g_k . q_3)/(g_k . g_k) (3/2 u u - 1/2)                                     along each tangent, u = g_k/|g_k|
///
/// c_k makes the stress across the plane what an incompatible mode makes it, nothing: by its elastic growth, and by what is left of it
/// from the step before, as fast as the element is strained (at rest nothing changes).
///
/// mean    [-] increment of the mean strain;  q  [m] increments of the hourglass amplitudes
/// left    [Pa] sums over the points of s_k n . stress n before the step
/// across  [-] the strains c_k
template <class T>
NEREID_HOT PointField<T> assumed_strains(const CentreFrame<T>& f, const Symmetric<T>& mean, const std::array<Vector<T>, 4>& q,
                                         T lambda, T mu, const std::array<T, 3>& left, std::array<T, 3>& across) {
  PointField<T> field{.mean = mean, .linear = {}, .product = {}};
  const T g(gauss), half(0.5), stiff = T(1.0) / (lambda + T(2.0) * mu);
  const std::array<T, 3> own{dot(f.g[0], q[0]), dot(f.g[1], q[1]), dot(f.g[2], q[2])};
  T squares = contract(mean, mean);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const PlaneBasis<T> a = plane_basis(f, k);
    const T ii = g * dot(f.g[i], q[j]), jj = g * dot(f.g[j], q[i]), ij = g * half * (own[i] + own[j]);
    field.linear[k] = outer(ii * a.i + ij * a.j, a.i) + outer(ij * a.i + jj * a.j, a.j);
    squares = squares + contract(field.linear[k], field.linear[k]);
    const T per = T(1.0) / f.equal[k], stretch = T(1.0 / 3.0) * per * dot(f.g[k], q[3]), side = half * stretch;
    const Symmetric<T> along = (T(1.5) * per * stretch) * outer(f.g[k], f.g[k]);
    field.product[k] = {along.xx - side, along.yy - side, along.zz - side, along.xy, along.yz, along.xz};
  }
  const T most = root(larger(squares - T(1e-26), T(0.0)));  // a rotation leaves 1e-16
  for (int k = 0; k < 3; ++k) {
    const Vector<T> n = plane_basis(f, k).normal;
    const T deficit = T(0.125) * stiff * left[k];
    across[k] = -(stiff * lambda * trace(field.linear[k]) + larger(-most, smaller(most, deficit)));
    field.linear[k] = field.linear[k] + across[k] * outer(n, n);
  }
  return field;
}

/// Moments of the stresses at the points: the transpose of assumed_strains() without what c_k adds. [N/m]
///
/// sums  [Pa] of the stresses over the points;  eighth_of_volume  [m3] that belongs to each
template <class T>
NEREID_HOT HourglassMoments<T> moments_of(const CentreFrame<T>& f, const PointField<T>& sums, T eighth_of_volume,
                                          std::array<T, 3>& left) {
  HourglassMoments<T> m;
  const T eighth(0.125), weight = T(gauss) * eighth * eighth_of_volume, weight2 = T(1.0 / 3.0) * eighth * eighth_of_volume;
  for (int k = 0; k < 3; ++k) {
    const PlaneBasis<T> a = plane_basis(f, k);
    const Symmetric<T>& s = sums.linear[k];
    const Vector<T> si = s * a.i, sj = s * a.j;
    m.plane[k] = {weight * dot(a.i, si), weight * dot(a.j, sj), weight * dot(a.i, sj)};
    left[k] = dot(a.normal, s * a.normal);
    const Symmetric<T>& t = sums.product[k];
    const T per = T(1.0) / f.equal[k];
    m.along[k] = weight2 * per * (T(1.5) * per * dot(f.g[k], t * f.g[k]) - T(0.5) * trace(t));
  }
  return m;
}

/// Brings one hexahedron from the old to the new positions and gives its nodal forces.
///
/// As with one point, strain and spin come from the middle of the step, stress and tensors of the law are turned by the mean rotation, and
/// forces are taken at the end. The points have equal parts of the volume, so that a constant stress gives the forces of the mean
/// gradient and no others. What the strain across the planes does, half the sum of `across` before and after times it, is no work of
/// nodes; it is of second order in the step, and goes off the dissipation, or the energy of a law that has none.
///
/// share  [-] of the viscosity
/// x  [m] at the end of the step;  dx  [m] increment of x over the step;  dt  [s] above zero; rates are dx / dt
/// force  [N] by which the element pulls its nodes
template <class T, class Law>
NEREID_HOT Report<T, FullHexahedron> advance(const Law& law, const FullHexahedron::Options& options,
                  const FullHexahedron::Constants<T>& constants, const Shares<T, 3>& share, const std::array<Vector<T>, 8>& x,
                  const std::array<Vector<T>, 8>& dx, T dt, FullHexahedron::Memory<T, Law>& memory,
                  std::array<Vector<T>, 8>& force) {
  const T eighth(0.125), half(0.5), zero(0.0);
  const Modes<T> X = scaled(eighth, sums_by_mode(x)), D = scaled(eighth, sums_by_mode(dx));
  const auto [middle, at_middle, L, strain, half_spin, Q, growth] = mean_motion(X, D);

  std::array<Vector<T>, 4> q;
  for (int a = 0; a < 4; ++a) q[a] = rotated_by(half_spin, D.hourglass[a] - L * middle.hourglass[a]);
  const auto there =
      centre_frame<T>({rotated_by(half_spin, middle.xi), rotated_by(half_spin, middle.eta), rotated_by(half_spin, middle.zeta)});
  const auto lame = material::lame(law);
  std::array<T, 3> across, left;
  const auto strains = at_points(assumed_strains(there, strain, q, T(lame.lambda), T(lame.mu), memory.across, across));

  const T volume = at_middle.volume * T(law.density) * constants.per_mass;
  material::ModuliOf<T, Symmetric, Law> moduli{};
  T stored = zero, dissipated = zero;
  std::array<Symmetric<T>, 8> stresses;
  Symmetric<T> before{zero, zero, zero, zero, zero, zero};  // sum over the points, turned
  for (int p = 0; p < FullHexahedron::gauss_points; ++p) {
    auto& point = memory.points[p];
    point.stress = rotate(Q, point.stress);
    before = before + point.stress;
    for (Symmetric<T>& tensor : point.internal.tensor) tensor = rotate(Q, tensor);
    const auto [work, here] = update_stress(law, material::Increment<T, Symmetric>{strains[p], dt, volume}, point.stress, point.internal);
    moduli = p == 0 ? here : stiffer(moduli, here);
    stored = stored + work.stored;
    dissipated = dissipated + work.dissipated;
    stresses[p] = point.stress;
  }
  const PointField<T> sums = sums_over_points(stresses);

  const Gradient<T> at_end = volume_gradient(X);
  const auto frame = centre_frame<T>({X.xi, X.eta, X.zeta});
  const std::array<Vector<T>, 4> Qs = forces_of(frame, moments_of(frame, sums, eighth * at_end.volume, left));
  const T part = eighth * at_middle.volume;
  T slack = zero;
  for (int k = 0; k < 3; ++k) slack = slack + half * across[k] * (memory.across[k] + left[k]);
  memory.across = left;
  stored = part * stored, dissipated = part * dissipated, slack = part * slack;
  constexpr bool flows = requires { yield_stress(law, memory.points[0].internal.scalar); };
  (flows ? dissipated : stored) = (flows ? dissipated : stored) - slack;

  const Symmetric<T> G = gradient_products(at_end);
  const T omega_squared = largest_frequency_squared(G, at_end.per_volume, constants.per_mass, moduli) * coupling_of_hourglass(G, at_end, X);
  const Motion<T> motion{X.xi, X.eta, X.zeta, D.xi, D.eta, D.zeta, strain, eighth * (sums.mean - before), growth, dt};
  const ViscousStep<T> viscous = advance_viscous(options.viscosity, motion, strain_at_start(L, half_spin),
                                                 material::wave_speed(moduli, law.density), omega_squared, share, memory.viscous);

  force = forces_of_stress(matrix(eighth * sums.mean + memory.viscous), Qs, X, at_end);
  const Controlled<T> controlled =
      control_distortion(options.distortion, law.young, law.density, constants.start, constants.per_mass, x, memory.distortion, force);

  return {.stored = {stored, controlled.stored},
          .dissipated = {dissipated, viscous.work * at_middle.volume},
          .step = stable_step(omega_squared + controlled.omega_squared, viscous.damping),
          .volume_ratio = at_end.volume * T(law.density) * constants.per_mass,
          .along = viscous.along};
}

/// Constants of a fully integrated hexahedron in its reference positions.
template <class T, class Law>
NEREID_HOT FullHexahedron::Constants<T> constants(const Law& law, const FullHexahedron::Options&,
                                                  const std::array<Vector<T>, 8>& X) {
  const T mass = T(law.density) * volume_gradient(scaled(T(0.125), sums_by_mode(X))).volume;
  return {.mass = mass, .per_mass = T(1.0) / mass, .start = start_of_control(X)};
}

}  // namespace nereid::element
