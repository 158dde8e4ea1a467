#pragma once
// The 8-node hexahedron with eight points (2 x 2 x 2 of Gauss) and mean dilatation: the B-bar element of
// Hughes (Int. J. Num. Meth. Engng 15, 1980) in the modes of hexahedron.hpp, in rates.
//
// It needs no hourglass control, and no volumetric locking is left; bending is too stiff, as in every
// hexahedron whose shear is taken at all eight points. docs/theory/hexahedron.md.

#include <algorithm>
#include <array>

#include "element/hexahedron.hpp"

namespace nereid::element {

/// Derivatives of a trilinear field by xi, eta and zeta at the eight points of Gauss.
///
/// The derivative by xi does not depend on xi: four values are enough. They stand at (-,-), (+,-), (-,+),
/// (+,+) in the two other coordinates, taken in cyclic order: (eta, zeta), (zeta, xi), (xi, eta).
template <class T>
struct Tangents {
  std::array<Vector<T>, 4> xi, eta, zeta;
};

/// Where point p, numbered like the nodes, finds its derivatives in Tangents.
constexpr int xi_at[8] = {0, 0, 1, 1, 2, 2, 3, 3}, eta_at[8] = {0, 2, 2, 0, 1, 3, 3, 1},
              zeta_at[8] = {0, 1, 3, 2, 0, 1, 3, 2};

constexpr double gauss = 0.57735026918962576451;  // 1/sqrt(3), where the points are

/// Derivatives at the points of a field with modal amplitudes a, for example
///     d/d xi = a_xi + a_3 eta + a_2 zeta + a_4 eta zeta,     eta, zeta = -+ 1/sqrt(3)
template <class T>
NEREID_HOT Tangents<T> tangents(const Modes<T>& a) {
  const T g(gauss), g2(1.0 / 3.0);
  const Vector<T> h1 = g * a.hourglass[0], h2 = g * a.hourglass[1], h3 = g * a.hourglass[2], h4 = g2 * a.hourglass[3];
  const auto four = [&h4](const Vector<T>& mean, const Vector<T>& first, const Vector<T>& second) {
    const Vector<T> low = mean - second, high = mean + second, low_first = first - h4, high_first = first + h4;
    return std::array<Vector<T>, 4>{low - low_first, low + low_first, high - high_first, high + high_first};
  };
  return {.xi = four(a.xi, h3, h2), .eta = four(a.eta, h1, h3), .zeta = four(a.zeta, h2, h1)};
}

/// The transpose of tangents: what pulls at derivatives, gathered by mode.
template <class T>
NEREID_HOT Modes<T> pulls_by_mode(const Tangents<T>& f) {
  const T g(gauss), g2(1.0 / 3.0);
  struct Four {
    Vector<T> mean, first, second, both;
  };
  const auto four = [](const std::array<Vector<T>, 4>& q) {
    const Vector<T> low = q[1] + q[0], high = q[3] + q[2], low_first = q[1] - q[0], high_first = q[3] - q[2];
    return Four{high + low, high_first + low_first, high - low, high_first - low_first};
  };
  const Four xi = four(f.xi), eta = four(f.eta), zeta = four(f.zeta);
  return {.xi = xi.mean, .eta = eta.mean, .zeta = zeta.mean,
          .hourglass = {g * (eta.first + zeta.second), g * (xi.second + zeta.first), g * (xi.first + eta.second),
                        g2 * (xi.both + eta.both + zeta.both)}};
}

/// Gradients of the coordinates at one point, times the determinant: areas of the parallelepiped that the
/// tangents a, b, c span. The gradient of a field with tangents u, v, w is (u xi + v eta + w zeta) / volume.
template <class T>
struct Cofactors {
  Vector<T> xi, eta, zeta;  // b x c, c x a, a x b
  T volume;                 // a . (b x c)
};

template <class T>
NEREID_HOT Cofactors<T> cofactors(const Tangents<T>& x, int point) {
  const Vector<T>&a = x.xi[xi_at[point]], &b = x.eta[eta_at[point]], &c = x.zeta[zeta_at[point]];
  const Vector<T> area = cross(b, c);
  return {.xi = area, .eta = cross(c, a), .zeta = cross(a, b), .volume = dot(a, area)};
}

/// Products of the gradients of the coordinates at one point, times its volume:  J grad xi_i . grad xi_j.
template <class T>
struct Metric {
  std::array<Vector<T>, 8> equal;  // [m] xi xi, eta eta, zeta zeta
  std::array<Vector<T>, 8> mixed;  // [m] xi eta, eta zeta, zeta xi
};

/// Upper bound on  sum over points of J |grad phi|^2  over  |nodal values of phi|^2.
///
/// In amplitudes by mode the sum is a matrix; with norms of its linear block (3 x 3), of its hourglass block
/// (4 x 4) and of what couples them, the bound is the largest eigenvalue of [[l, c], [c, h]]:
///     (l + h)/2 + sqrt((l - h)^2/4 + c^2)
/// where l and h are bounds by trace and deviator (Wolkowicz & Styan 1980) and c is Frobenius's norm. On a
/// parallelepiped c = 0 and h < l, and the bound is l: that of the one-point element. [m]
template <class T>
NEREID_HOT T laplacian_bound(const Metric<T>& metric) {
  Vector<T> E = metric.equal[0], M = metric.mixed[0];
  for (int p = 1; p < 8; ++p) E = E + metric.equal[p], M = M + metric.mixed[p];
  const Modes<T> e = sums_by_mode(metric.equal), m = sums_by_mode(metric.mixed);
  const auto& [e1, e2, e3, e4] = e.hourglass;
  const auto& [m1, m2, m3, m4] = m.hourglass;
  (void)e4;
  const T linear = largest_eigenvalue_bound(Symmetric<T>{E.x, E.y, E.z, M.x, M.y, M.z});

  const T two(2.0), g2(1.0 / 3.0);
  const auto norm2 = [](T a, T b, T c) { return a * a + b * b + c * c; };
  const T coupling = root(g2 * (norm2(m.zeta.x + m.eta.z, e.zeta.y + m.eta.y, m.zeta.y + e.eta.z) +
                                norm2(e.zeta.x + m.xi.z, m.zeta.x + m.xi.y, m.zeta.z + e.xi.z) +
                                norm2(e.eta.x + m.xi.x, m.eta.x + e.xi.y, m.eta.z + m.xi.y) +
                                g2 * norm2(e1.x + m2.x + m3.z, m1.x + e2.y + m3.y, m1.z + m2.y + e3.z)));

  // the hourglass block over 1/3
  const T h11 = E.y + E.z + two * m1.y, h22 = E.x + E.z + two * m2.z, h33 = E.x + E.y + two * m3.x;
  const T h44 = g2 * (E.x + E.y + E.z + two * (m1.y + m2.z + m3.x));
  const T between = norm2(M.x + m2.y + m1.z + e3.z, m1.x + e2.y + M.z + m3.y, e1.x + m2.x + m3.z + M.y);
  const T to_last = norm2(m.eta.x + e.xi.y + two * m4.y + m.zeta.z + e.xi.z,
                          e.eta.x + m.xi.x + two * m4.z + m.zeta.y + e.eta.z,
                          e.zeta.x + two * m4.x + m.xi.z + e.zeta.y + m.eta.y);
  const T mean = T(0.25) * (h11 + h22 + h33 + h44);
  const T squares = norm2(h11 - mean, h22 - mean, h33 - mean) + (h44 - mean) * (h44 - mean) +
                    two * (between + g2 * to_last);
  const T hourglass = g2 * (mean + root(T(0.75) * squares));

  const T half(0.5), difference = half * (linear - hourglass);
  return T(0.125) * (half * (linear + hourglass) + root(difference * difference + coupling * coupling));
}

/// The fully integrated hexahedron as a kind of element.
struct FullHexahedron {
  static constexpr int nodes = 8, dimensions = 3;
  static constexpr int gauss_points = 8;
  static constexpr bool rotates = false, layered = false;
  static constexpr std::array stored_channels{Stored::elastic};
  static constexpr std::array dissipated_channels{Dissipated::plastic, Dissipated::viscous};

  struct Options {
    Viscosity viscosity;
  };
  static bool has(const Options&, Stored) { return true; }
  static bool has(const Options&, Dissipated) { return true; }
  /// How deep the element is behind a face of it, from its volume and the area of the face. [m]
  static double depth(const Options&, double volume, double area) { return volume / area; }
  /// Distance between the two faces of a plate; zero of a solid. [m]
  static double thickness(const Options&) { return 0; }

  /// Constants of one element.
  template <class T>
  struct Constants {
    T mass, per_mass;  ///< [kg] and its inverse
    template <class F>
    void each_row(F&& f) { f(mass), f(per_mass); }
    static constexpr int rows = 2;
  };

  template <class T, class Law>
  struct Point {
    Symmetric<T> stress;                             ///< [Pa] Cauchy
    material::Internal<T, Law, Symmetric> internal;  ///< of the law
  };

  /// What one element remembers from step to step; in the global frame, turned with each point.
  template <class T, class Law>
  struct Memory {
    std::array<Point<T, Law>, gauss_points> points;  ///< numbered like the nodes
    T viscous;                                       ///< [Pa] viscous pressure, positive in compression
    template <class F>
    void each_row(F&& f) {
      for (auto& point : points) point.stress.each_row(f), point.internal.each_row(f);
      f(viscous);
    }
    template <class F>
    void each_internal(F&& f) {
      for (auto& point : points) f(point.internal);
    }
    static constexpr int rows = FullHexahedron::gauss_points * (6 + material::Internal<T, Law, Symmetric>::rows) + 1;
  };
};

/// Brings one hexahedron from the old to the new positions and gives its nodal forces.
///
/// Each point does what the one-point element does: strain and spin in the middle of the step, stress and
/// tensors of the law turned by Hughes & Winget's rotation, forces with the gradient at the end. The trace
/// of the strain is everywhere the mean one, which is that of the exact volume:
///     strain = sym L + (growth - tr L)/3 1,     L the gradient of dx,     growth = dV/V
/// so that, by the transpose, the mean stress in the forces is everywhere its mean over the volume.
///
/// x  [m] at the end of the step;  dx  [m] increment of x over the step;  dt  [s] above zero; rates are dx / dt
/// force  [N] by which the element pulls its nodes
template <class T, class Law>
NEREID_HOT Report<T, FullHexahedron> advance(const Law& law, const FullHexahedron::Options& options,
                  const FullHexahedron::Constants<T>& constants, const std::array<Vector<T>, 8>& x,
                  const std::array<Vector<T>, 8>& dx, T dt, FullHexahedron::Memory<T, Law>& memory,
                  std::array<Vector<T>, 8>& force) {
  const T eighth(0.125), half(0.5), third(1.0 / 3.0), zero(0.0);
  const Modes<T> X = scaled(eighth, sums_by_mode(x)), D = scaled(eighth, sums_by_mode(dx));
  const Gradient<T> at_middle = volume_gradient(subtracted(X, half, D)), at_end = volume_gradient(X);
  const T growth = mean_divergence(D, at_middle), volume = at_middle.volume * T(law.density) * constants.per_mass;

  const Tangents<T> end = tangents(X), change = tangents(D);
  Tangents<T> middle, pull;
  const Vector<T> none{zero, zero, zero};
  for (int i = 0; i < 4; ++i) {
    middle.xi[i] = end.xi[i] - half * change.xi[i];
    middle.eta[i] = end.eta[i] - half * change.eta[i];
    middle.zeta[i] = end.zeta[i] - half * change.zeta[i];
    pull.xi[i] = pull.eta[i] = pull.zeta[i] = none;
  }
  Metric<T> metric;
  material::ModuliOf<T, Symmetric, Law> moduli{};
  T stored = zero, dissipated = zero, mean_stress = zero, least = at_end.volume;  // NaN stays
  for (int p = 0; p < FullHexahedron::gauss_points; ++p) {
    auto& point = memory.points[p];
    {
      const Cofactors<T> c = cofactors(middle, p);
      const T scale = T(1.0) / c.volume;
      const Vector<T> xi = scale * c.xi, eta = scale * c.eta, zeta = scale * c.zeta;
      const Vector<T>&a = change.xi[xi_at[p]], &b = change.eta[eta_at[p]], &d = change.zeta[zeta_at[p]];
      Matrix<T> L{a.x * xi, a.y * xi, a.z * xi};  // gradient of the increment
      add_outer(b, eta, L);
      add_outer(d, zeta, L);
      const T more = third * (growth - (L.x.x + L.y.y + L.z.z));
      const Symmetric<T> strain{L.x.x + more, L.y.y + more, L.z.z + more, half * (L.x.y + L.y.x),
                                half * (L.y.z + L.z.y), half * (L.x.z + L.z.x)};
      const Vector<T> half_spin = T(0.25) * (Vector<T>{L.z.y - L.y.z, L.x.z - L.z.x, L.y.x - L.x.y});
      const Matrix<T> Q = cayley_rotation(T(2.0) * half_spin);
      point.stress = rotate(Q, point.stress);
      for (Symmetric<T>& tensor : point.internal.tensor) tensor = rotate(Q, tensor);
      const auto [work, here] = update_stress(law, material::Increment<T, Symmetric>{rotated_by(half_spin, strain), dt, volume},
                                              point.stress, point.internal);
      moduli = p == 0 ? here : stiffer(moduli, here);
      stored = stored + c.volume * work.stored;
      dissipated = dissipated + c.volume * work.dissipated;
    }
    const Cofactors<T> c = cofactors(end, p);
    const T third_of_trace = third * trace(point.stress);
    mean_stress = mean_stress + c.volume * third_of_trace;
    least = smaller(T(8.0) * c.volume, least);
    const Symmetric<T>& s = point.stress;
    const Symmetric<T> shape{s.xx - third_of_trace, s.yy - third_of_trace, s.zz - third_of_trace, s.xy, s.yz, s.xz};
    Vector<T>&along_xi = pull.xi[xi_at[p]], &along_eta = pull.eta[eta_at[p]], &along_zeta = pull.zeta[zeta_at[p]];
    along_xi = along_xi + shape * c.xi;
    along_eta = along_eta + shape * c.eta;
    along_zeta = along_zeta + shape * c.zeta;
    const T per_volume = T(1.0) / c.volume;
    metric.equal[p] = per_volume * Vector<T>{dot(c.xi, c.xi), dot(c.eta, c.eta), dot(c.zeta, c.zeta)};
    metric.mixed[p] = per_volume * Vector<T>{dot(c.xi, c.eta), dot(c.eta, c.zeta), dot(c.zeta, c.xi)};
  }
  mean_stress = mean_stress * at_end.per_volume;

  const T trace_of_products = trace(gradient_products(at_end));
  const T omega_squared = T(8.0) * constants.per_mass *
                          (T(larger(moduli.lambda, decltype(moduli.lambda)(0.0))) * trace_of_products * at_end.per_volume +
                           T(decltype(moduli.mu)(2.0) * moduli.mu) * laplacian_bound(metric));
  const auto bulk = viscous_pressure(options.viscosity, material::wave_speed(moduli, law.density), growth / dt, omega_squared,
                                     trace_of_products, constants.mass, constants.per_mass, at_end.per_volume);
  const T viscous_work = half * (memory.viscous + bulk.pressure) * growth * at_middle.volume;
  memory.viscous = bulk.pressure;

  Modes<T> F = scaled(eighth, pulls_by_mode(pull));
  const T mean = mean_stress - bulk.pressure;
  F.xi = F.xi + mean * at_end.xi, F.eta = F.eta + mean * at_end.eta, F.zeta = F.zeta + mean * at_end.zeta;
  for (int a = 0; a < 3; ++a) F.hourglass[a] = F.hourglass[a] + mean * at_end.hourglass[a];
  force = nodal_values(scaled(T(-1.0), F));

  return {.stored = {stored},
          .dissipated = {dissipated, -viscous_work},
          .step = stable_step(omega_squared, bulk.damping),
          .volume_ratio = least * T(law.density) * constants.per_mass};
}

/// Constants of a fully integrated hexahedron in its reference positions.
template <class T, class Law>
NEREID_HOT FullHexahedron::Constants<T> constants(const Law& law, const FullHexahedron::Options&,
                                                  const std::array<Vector<T>, 8>& X) {
  const T mass = T(law.density) * volume_gradient(scaled(T(0.125), sums_by_mode(X))).volume;
  return {.mass = mass, .per_mass = T(1.0) / mass};
}

}  // namespace nereid::element
