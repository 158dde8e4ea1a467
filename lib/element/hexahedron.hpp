#pragma once
// The 8-node hexahedron with uniform strain and hourglass control by springs, dashpots
// (Flanagan & Belytschko, Int. J. Num. Meth. Engng 17, 1981) or assumed strains, worked out in modes.
//
// Eight nodal vectors are eight modes: the mean, three linear ones (xi, eta, zeta) and four hourglass
// ones (eta zeta, zeta xi, xi eta, xi eta zeta). In modes, volume, gradient, the gradient of an increment
// and its hourglass part are a few cross products each, without any 3 x 8 matrix: docs/theory/hexahedron.md.

#include <algorithm>
#include <array>

#include "base/tensor.hpp"
#include "element/assumed_strain.hpp"
#include "element/distortion.hpp"
#include "element/report.hpp"
#include "element/viscosity.hpp"
#include "material/law.hpp"

namespace nereid::element {

/// Nodal vectors by modes, without the mean.
template <class T>
struct Modes {
  Vector<T> xi, eta, zeta;                // linear
  std::array<Vector<T>, 4> hourglass;     // eta zeta, zeta xi, xi eta, xi eta zeta
};

/// Sums the nodal values with the signs of each mode: the amplitude is this sum / 8.
template <class T>
NEREID_HOT Modes<T> sums_by_mode(const std::array<Vector<T>, 8>& a) {
  // differences and sums along xi, then eta, then zeta; nodes in the order of VTK
  const auto s01 = a[1] + a[0], d01 = a[1] - a[0], s32 = a[2] + a[3], d32 = a[2] - a[3];
  const auto s45 = a[5] + a[4], d45 = a[5] - a[4], s76 = a[6] + a[7], d76 = a[6] - a[7];
  const auto ss_low = s32 + s01, sd_low = s32 - s01, ds_low = d32 + d01, dd_low = d32 - d01;
  const auto ss_high = s76 + s45, sd_high = s76 - s45, ds_high = d76 + d45, dd_high = d76 - d45;
  return {.xi = ds_high + ds_low,
          .eta = sd_high + sd_low,
          .zeta = ss_high - ss_low,
          .hourglass = {sd_high - sd_low, ds_high - ds_low, dd_high + dd_low, dd_high - dd_low}};
}

/// Nodal values from amplitudes by mode, without the mean: the transpose of sums_by_mode.
template <class T>
NEREID_HOT std::array<Vector<T>, 8> nodal_values(const Modes<T>& m) {
  const auto& h = m.hourglass;
  const auto ss_high = m.zeta, ss_low = -m.zeta;
  const auto sd_high = m.eta + h[0], sd_low = m.eta - h[0];
  const auto ds_high = m.xi + h[1], ds_low = m.xi - h[1];
  const auto dd_high = h[2] + h[3], dd_low = h[2] - h[3];
  const auto s01 = ss_low - sd_low, s32 = ss_low + sd_low, d01 = ds_low - dd_low, d32 = ds_low + dd_low;
  const auto s45 = ss_high - sd_high, s76 = ss_high + sd_high;
  const auto d45 = ds_high - dd_high, d76 = ds_high + dd_high;
  return {s01 - d01, s01 + d01, s32 + d32, s32 - d32, s45 - d45, s45 + d45, s76 + d76, s76 - d76};
}

template <class T>
NEREID_HOT Modes<T> scaled(T s, Modes<T> m) {
  m.xi = s * m.xi, m.eta = s * m.eta, m.zeta = s * m.zeta;
  for (auto& h : m.hourglass) h = s * h;
  return m;
}

/// a - s b
template <class T>
NEREID_HOT Modes<T> subtracted(const Modes<T>& a, T s, const Modes<T>& b) {
  Modes<T> m{a.xi - s * b.xi, a.eta - s * b.eta, a.zeta - s * b.zeta, {}};
  for (int i = 0; i < 4; ++i) m.hourglass[i] = a.hourglass[i] - s * b.hourglass[i];
  return m;
}

/// Volume of the hexahedron and its gradient by the modal amplitudes.
///
/// With amplitudes X (xi, eta, zeta, h1..h3), exact for every trilinear shape:
///     V/8 = [xi, eta, zeta] + ([h2, h1, zeta] + [h3, eta, h1] + [xi, h3, h2]) / 3
/// where [a, b, c] = a . (b x c). The mean gradient of the shape function of node I times V is the
/// sum over modes of (sign of the mode at I) * (d(V/8) / d amplitude): Flanagan & Belytschko's B.
template <class T>
struct Gradient {
  T volume, per_volume;                // [m3] and its inverse
  Vector<T> xi, eta, zeta;             // [m2] by the linear amplitudes
  std::array<Vector<T>, 3> hourglass;  // [m2] by the first three hourglass amplitudes
};

template <class T>
NEREID_HOT Gradient<T> volume_gradient(const Modes<T>& X) {
  const T third(1.0 / 3.0);
  const auto& [h1, h2, h3, h4] = X.hourglass;
  (void)h4;  // xi eta zeta moves no volume
  Gradient<T> g;
  g.xi = cross(X.eta, X.zeta) + third * cross(h3, h2);
  g.eta = cross(X.zeta, X.xi) + third * cross(h1, h3);
  g.zeta = cross(X.xi, X.eta) + third * cross(h2, h1);
  g.hourglass[0] = third * (cross(X.zeta, h2) + cross(h3, X.eta));
  g.hourglass[1] = third * (cross(h1, X.zeta) + cross(X.xi, h3));
  g.hourglass[2] = third * (cross(X.eta, h1) + cross(h2, X.xi));
  // V/8 is linear in (xi, h1..h3 products): Euler's theorem on a form of degree three
  g.volume = T(8.0 / 3.0) * (dot(X.xi, g.xi) + dot(X.eta, g.eta) + dot(X.zeta, g.zeta) +
                             dot(h1, g.hourglass[0]) + dot(h2, g.hourglass[1]) + dot(h3, g.hourglass[2]));
  g.per_volume = T(1.0) / g.volume;
  return g;
}

/// Adds u (x) c to a matrix.
template <class T>
NEREID_HOT void add_outer(const Vector<T>& u, const Vector<T>& c, Matrix<T>& to) {
  to.x = to.x + u.x * c;
  to.y = to.y + u.y * c;
  to.z = to.z + u.z * c;
}

/// Mean gradient of a field with modal amplitudes U: (8/V) sum of U (x) g over the modes.
template <class T>
NEREID_HOT Matrix<T> mean_gradient(const Modes<T>& U, const Gradient<T>& g) {
  Matrix<T> L{U.xi.x * g.xi, U.xi.y * g.xi, U.xi.z * g.xi};
  add_outer(U.eta, g.eta, L);
  add_outer(U.zeta, g.zeta, L);
  for (int m = 0; m < 3; ++m) add_outer(U.hourglass[m], g.hourglass[m], L);
  const T s = T(8.0) * g.per_volume;
  return {s * L.x, s * L.y, s * L.z};
}

/// Mean divergence of a field with modal amplitudes U, the trace of its mean gradient; of displacements the
/// growth of the volume over the volume, exactly in the limit of small ones.
template <class T>
NEREID_HOT T mean_divergence(const Modes<T>& U, const Gradient<T>& g) {
  const auto& h = U.hourglass;
  return T(8.0) * g.per_volume *
         (dot(U.xi, g.xi) + dot(U.eta, g.eta) + dot(U.zeta, g.zeta) + dot(h[0], g.hourglass[0]) +
          dot(h[1], g.hourglass[1]) + dot(h[2], g.hourglass[2]));
}

/// Sums over the nodes of the products of the mean gradients' components, times V^2: V^2 B B^T. [m4]
template <class T>
NEREID_HOT Symmetric<T> gradient_products(const Gradient<T>& g) {
  Symmetric<T> G{};
  const auto add = [&G](const Vector<T>& c) {
    G.xx = G.xx + c.x * c.x, G.yy = G.yy + c.y * c.y, G.zz = G.zz + c.z * c.z;
    G.xy = G.xy + c.x * c.y, G.yz = G.yz + c.y * c.z, G.xz = G.xz + c.x * c.z;
  };
  G = {T(0.0), T(0.0), T(0.0), T(0.0), T(0.0), T(0.0)};
  add(g.xi), add(g.eta), add(g.zeta);
  for (const auto& c : g.hourglass) add(c);
  return T(8.0) * G;
}

/// Upper bound on the largest eigenvalue of a symmetric positive tensor, exact if the two smaller
/// eigenvalues are equal; it does not depend on the frame.
///     mean + 2 sqrt(tr(dev^2) / 6)
template <class T>
NEREID_HOT T largest_eigenvalue_bound(const Symmetric<T>& G) {
  const T mean = T(1.0 / 3.0) * trace(G);
  const Symmetric<T> d{G.xx - mean, G.yy - mean, G.zz - mean, G.xy, G.yz, G.xz};
  return mean + T(2.0) * root(T(1.0 / 6.0) * contract(d, d));
}

/// Upper bound on the squared frequencies of one element, an eighth of its mass at each node:
///     omega^2 <= 8/(m V) (max(lambda, 0) tr G + 2 mu g_max),     G = V^2 B B^T
/// Exact for a cube, where it is (2 c/h)^2 (1 + nu)/(1 - nu). The hourglass stiffness is not in it; with
/// its default it adds less than 0.2 % to the frequencies of distorted elements. [1/s2]
template <class T, class N>
NEREID_HOT T largest_frequency_squared(const Symmetric<T>& G, T per_volume, T per_mass, const material::Moduli<N>& moduli) {
  return T(8.0) * per_mass * per_volume *
         (T(larger(moduli.lambda, N(0.0))) * trace(G) + T(N(2.0) * moduli.mu) * largest_eigenvalue_bound(G));
}

/// What coupling of strain and hourglass modes raises the squared frequencies by, with the stiffness of assumed strains. [-]
///
///     2/3 + sqrt(1/9 + c^2/3),   c^2 = min(1, 8 sum of d_a . G^-1 d_a),   d_a = g_a - G H_a / V
///
/// from two positive forms, the second at most a third of the first, between whose ranges the smallest angle is arccos c. One for a
/// parallelepiped, for which the third is exact; for others it was compared with exact frequencies.
template <class T>
NEREID_HOT T coupling_of_hourglass(const Symmetric<T>& G, const Gradient<T>& g, const Modes<T>& X) {
  const Symmetric<T> a = adjugate(G);
  const T determinant = G.xx * a.xx + G.xy * a.xy + G.xz * a.xz;
  T sum(0.0);
  for (int m = 0; m < 4; ++m) {
    Vector<T> d = -(g.per_volume * (G * X.hourglass[m]));
    if (m < 3) d = d + g.hourglass[m];
    sum = sum + dot(d, a * d);
  }
  const T c2 = smaller(T(1.0), T(8.0) * sum / determinant);
  return T(2.0 / 3.0) + root(T(1.0 / 9.0) + T(1.0 / 3.0) * c2);
}

/// The hexahedron as a kind of element: what it is made of and what it remembers.
struct Hexahedron {
  static constexpr int nodes = 8, dimensions = 3, axes = 3, sides = 6, arms = 0;
  static constexpr bool rotates = false, layered = false;
  static constexpr std::array stored_channels{Stored::elastic, Stored::hourglass, Stored::distortion};
  static constexpr std::array dissipated_channels{Dissipated::plastic, Dissipated::viscous, Dissipated::hourglass};

  enum class Hourglass {
    assumed_strain,  ///< the element's own bending stiffness: assumed_strain.hpp
    stiffness,       ///< springs: they hold under load, and store what they take
    viscous,         ///< dashpots: they add no stiffness, and dissipate what they take
  };

  struct Options {
    double hourglass = usual_assumed;  ///< [-] part of the stiffness of assumed strains; coefficient of springs, or of dashpots
    Viscosity viscosity;
    Hourglass hourglass_kind = Hourglass::assumed_strain;
    Distortion distortion{};
  };
  static constexpr double usual_stiffness = 0.1;  ///< 1 would give a cube with poisson = 0 its full bending stiffness
  static constexpr double usual_viscous = 0.05;   ///< fraction of critical at the bound of the frequencies
  static constexpr double usual_assumed = 1;      ///< all of it

  /// Whether an element with these options uses a channel: springs store, dashpots dissipate.
  static bool has(const Options& options, Stored channel) {
    if (channel == Stored::distortion) return acts(options.distortion);
    return channel != Stored::hourglass || options.hourglass_kind != Hourglass::viscous;
  }
  static bool has(const Options& options, Dissipated channel) {
    return channel != Dissipated::hourglass || options.hourglass_kind == Hourglass::viscous;
  }
  /// How deep the element is behind a face of it, from its volume and the area of the face. [m]
  static double depth(const Options&, double volume, double area) { return volume / area; }
  /// Distance between the two faces of a plate; zero of a solid. [m]
  static double thickness(const Options&) { return 0; }

  /// Constants of one element.
  template <class T>
  struct Constants {
    T mass, per_mass;  ///< [kg] and its inverse
    T hourglass;       ///< [N/m] against gamma . dx; viscous: [N s/m] against the hourglass rate gamma . dx / dt; assumed strains: [-]
    T start;           ///< [m3] Jacobian of a corner below which distortion control acts
    template <class F>
    void each_row(F&& f) { f(mass), f(per_mass), f(hourglass), f(start); }
    static constexpr int rows = 4;
  };

  /// What one element remembers from step to step; in the global frame, turned with the element.
  template <class T, class Law>
  struct Memory {
    Symmetric<T> stress;                            ///< [Pa] Cauchy
    material::Internal<T, Law, Symmetric> internal;  ///< of the law
    std::array<Vector<T>, 4> hourglass;             ///< [N]
    T bent;                                         ///< [J] that assumed strains store
    T distortion;                                   ///< [J] that distortion control stores; no row without it
    Symmetric<T> viscous;                           ///< [Pa] not stored without viscosity
    template <class F>
    void each_row(F&& f, const Options& options) {
      stress.each_row(f);
      internal.each_row(f);
      for (auto& q : hourglass) f(q.x), f(q.y), f(q.z);
      f(bent);
      if (acts(options.distortion)) f(distortion);
      if (acts(options.viscosity)) viscous.each_row(f);
    }
    template <class F>
    void each_internal(F&& f) { f(internal); }
    static constexpr int rows(const Options& options) {
      return 6 + material::Internal<T, Law, Symmetric>::rows + 12 + 1 + (acts(options.distortion) ? 1 : 0) +
             (acts(options.viscosity) ? 6 : 0);
    }
  };
};

/// A small tensor turned by a small angle:  e + W e - e W,  W v = w x v; the trace stays.
///
/// w  [rad] axial vector of the rotation; what is left out is of order |w|^2 e
template <class T>
NEREID_HOT Symmetric<T> rotated_by(const Vector<T>& w, const Symmetric<T>& e) {
  const T xy_z = w.z * e.xy, xz_y = w.y * e.xz, yz_x = w.x * e.yz, two(2.0);
  return {e.xx + two * (xz_y - xy_z), e.yy + two * (xy_z - yz_x), e.zz + two * (yz_x - xz_y),
          e.xy + w.z * (e.xx - e.yy) + w.y * e.yz - w.x * e.xz,
          e.yz + w.x * (e.yy - e.zz) + w.z * e.xz - w.y * e.xy,
          e.xz + w.y * (e.zz - e.xx) + w.x * e.xy - w.z * e.yz};
}

/// A vector turned by a small angle:  v + w x v.
template <class T>
NEREID_HOT Vector<T> rotated_by(const Vector<T>& w, const Vector<T>& v) { return v + cross(w, v); }

/// The mean motion of a hexahedron in a step, taken in the middle of it, where a rigid rotation gives no strain at all.
template <class T>
struct MeanMotion {
  Modes<T> middle;         ///< [m] amplitudes of the positions
  Gradient<T> at_middle;   ///< theirs
  Matrix<T> L;             ///< [-] gradient of the increment
  Symmetric<T> strain;     ///< [-] its symmetric part, turned by half the rotation to meet the stress of the end
  Vector<T> half_spin;     ///< [rad] half of its axial vector
  Matrix<T> Q;             ///< the rotation of Hughes & Winget
  T growth;                ///< [-] of the volume
};

/// X, D  [m] amplitudes of the positions at the end of the step, and of their increments
template <class T>
NEREID_HOT MeanMotion<T> mean_motion(const Modes<T>& X, const Modes<T>& D) {
  const T half(0.5);
  MeanMotion<T> m{.middle = subtracted(X, half, D), .at_middle = {}, .L = {}, .strain = {}, .half_spin = {}, .Q = {}, .growth = {}};
  m.at_middle = volume_gradient(m.middle);
  const Matrix<T> L = m.L = mean_gradient(D, m.at_middle);
  const Vector<T> spin = half * Vector<T>{L.z.y - L.y.z, L.x.z - L.z.x, L.y.x - L.x.y};
  m.half_spin = half * spin;
  m.Q = cayley_rotation(spin);
  m.strain = rotated_by(m.half_spin, Symmetric<T>{L.x.x, L.y.y, L.z.z, half * (L.x.y + L.y.x), half * (L.y.z + L.z.y),
                                                  half * (L.x.z + L.z.x)});
  m.growth = L.x.x + L.y.y + L.z.z;
  return m;
}

/// The strain of mean_motion() turned back by half the rotation instead, to meet the stress of the beginning.
template <class T>
NEREID_HOT Symmetric<T> strain_at_start(const Matrix<T>& L, const Vector<T>& half_spin) {
  const T half(0.5);
  return rotated_by(-half_spin, Symmetric<T>{L.x.x, L.y.y, L.z.z, half * (L.x.y + L.y.x), half * (L.y.z + L.z.y), half * (L.x.z + L.z.x)});
}

/// Where the work against hourglass control went. [J]
template <class T>
struct HourglassWork {
  T stored, dissipated;
};

/// What the mean stress of an element did in a step.
template <class T>
struct MeanFlow {
  Symmetric<T> strain;         ///< [-]
  Symmetric<T> before, after;  ///< [Pa] turned to the end of the step
  T dissipated;                ///< [J/m3] above zero where it flowed
};

/// Brings the hourglass forces of assumed strains over a step: elastic, then what flow leaves of them.
///
/// The change of the forces follows from the increment and the frame of this step, and not from a potential: where a bent element is also
/// strained, its forces would give back more than they took. They end with what they hold, so that `bent` is never below zero.
///
/// Moments along the deviator of the mean stress are at most those of a plastic section beside it, M = M_p (1 - (s/yield)^2); where the
/// mean stress flows they go. There the others fall as the trial stress falls to the yield surface. Everywhere all together are at most
/// those of a fully plastic section, whose stresses of bending have an rms of sqrt(3)/2 of yield: docs/theory/hexahedron.md.
///
/// share   of the stiffness;  frame, q  in the middle of the step, turned to its end;  volume  [m3] there, and its inverse
/// forces  [N] of the step before, turned to the end of this one;  bent  [J]
template <class T, class Law>
NEREID_HOT HourglassWork<T> hold_by_assumed_strain(const Law& law, const T& share, const CentreFrame<T>& frame,
                                                   const std::array<Vector<T>, 4>& q, T volume, T per_volume,
                                                   const material::Moduli<T>& moduli, const MeanFlow<T>& mean,
                                                   const material::Internal<T, Law, Symmetric>& internal, std::array<Vector<T>, 4>& forces,
                                                   T& bent) {
  const auto change = forces_of(frame, moments_from(frame, q, volume, share * moduli.lambda, share * moduli.mu));
  std::array<Vector<T>, 4> now;
  T old_work(0.0), new_work(0.0);
  for (int a = 0; a < 4; ++a) {
    now[a] = forces[a] + change[a];
    old_work = old_work + T(4.0) * dot(forces[a], q[a]);
    new_work = new_work + T(4.0) * dot(now[a], q[a]);
  }
  const T before = bent, none(1e-300), zero(0.0), one(1.0);
  const auto too_much = before + old_work + new_work < T(-1e-6) * before;  // more than round-off
  if (any(too_much)) {
    const T room = larger(before + old_work, zero), part = select(new_work < zero, room / larger(-new_work, none), zero);
    for (int a = 0; a < 4; ++a) now[a] = select(too_much, part, one) * now[a];
    new_work = select(too_much, part, one) * new_work;
  }
  bent = larger(before + old_work + new_work, zero);
  constexpr bool flows = requires { yield_stress(law, internal.scalar); };
  if constexpr (flows) {
    const T yield = yield_stress(law, internal.scalar), per_yield = one / larger(yield, none);
    Symmetric<T> shape = material::deviator(mean.after);
    if constexpr (Law::tensors.size() > 0) shape = shape - internal.tensor[0];
    const T size2 = contract(shape, shape), left_of_section = larger(one - T(1.5) * size2 * per_yield * per_yield, zero);
    const T most = T(0.375 / law.young) * share * yield * yield * volume;
    const auto flowing = mean.dissipated > zero;
    const T most_along = select(flowing, zero, most * left_of_section * left_of_section);
    if (any(bent > most_along)) {
      HourglassMoments<T> m = moments_of(frame, now);
      const T whole = energy_of(frame, m, per_volume, law.young, law.poisson);
      HourglassMoments<T> across = m;
      take_along(frame, shape, one, law.poisson, across);
      const T along = larger(whole - energy_of(frame, across, per_volume, law.young, law.poisson), none);
      take_along(frame, shape, one - root(smaller(one, most_along / along)), law.poisson, m);
      const Symmetric<T> flowed = material::deviator(mean.strain - T(0.5 / material::lame(law).mu) * (mean.after - mean.before));
      const T size = root(size2), more = T(2.0 * material::lame(law).mu) * root(contract(flowed, flowed));
      const T keeps = select(flowing, size / (size + more + none), one);
      const T left = keeps * keeps * energy_of(frame, m, per_volume, law.young, law.poisson);
      const auto kept = forces_of(frame, m);
      const auto hot = bent > most_along;
      bent = bent * select(hot, left / larger(whole, left + none), one);
      for (int a = 0; a < 4; ++a) {
        now[a].x = select(hot, keeps * kept[a].x, now[a].x);
        now[a].y = select(hot, keeps * kept[a].y, now[a].y);
        now[a].z = select(hot, keeps * kept[a].z, now[a].z);
      }
    }
    const T room = most / larger(most, bent), part = root(room);
    bent = room * bent;
    for (auto& force : now) force = part * force;
  }
  T work(0.0);
  for (int a = 0; a < 4; ++a) work = work + T(4.0) * dot(forces[a] + now[a], q[a]);
  forces = now;
  const T dissipated = flows ? larger(work - (bent - before), T(0.0)) : T(0.0);
  return {work - dissipated, dissipated};
}

/// Nodal forces of a mean stress and of forces on the hourglass amplitudes.
///
///     S = stress - 8/V sum of Q_a (x) H_a,     F_m = S g_m (+ Q_a of the hourglass modes),     minus the nodal values of F
///
/// The second term of S is what the hourglass forces owe to the linear field. S need not be symmetric.
///
/// S  [Pa] mean stress with its viscous part;  Q  [N] over eight;  X  [m] amplitudes of the positions, and their gradient
template <class T>
NEREID_HOT std::array<Vector<T>, 8> forces_of_stress(Matrix<T> S, const std::array<Vector<T>, 4>& Q, const Modes<T>& X,
                                                     const Gradient<T>& gradient) {
  const T share = T(-8.0) * gradient.per_volume;
  for (int a = 0; a < 4; ++a) add_outer(share * Q[a], X.hourglass[a], S);
  Modes<T> F{S * gradient.xi, S * gradient.eta, S * gradient.zeta, Q};
  for (int a = 0; a < 3; ++a) F.hourglass[a] = F.hourglass[a] + S * gradient.hourglass[a];
  return nodal_values(scaled(T(-1.0), F));
}

/// A symmetric tensor as a matrix.
template <class T>
NEREID_HOT Matrix<T> matrix(const Symmetric<T>& s) { return {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}}; }

/// What the viscosity of a hexahedron did in a step.
template <class T>
struct ViscousStep {
  T work;                  ///< [J/m3] that it took
  T damping;               ///< [1/s] s of stable_step
  std::array<T, 3> along;  ///< [-] strain of the step along each axis
};

/// Updates the viscous stress by a step; zero without viscosity.
///
/// strain_at_start  [-] the strain of the step turned back to its beginning;  speed  [m/s] of dilatational waves
/// omega_squared  [1/s2] bound on the squared frequencies
/// stress  [Pa] of the step before, then of this one
template <class T, class N>
NEREID_HOT ViscousStep<T> advance_viscous(const Viscosity& viscosity, const Motion<T>& motion, const Symmetric<T>& strain_at_start, N speed,
                                          T omega_squared, const Shares<T, 3>& share, Symmetric<T>& stress) {
  const T zero(0.0);
  if (!acts(viscosity)) {
    stress = {zero, zero, zero, zero, zero, zero};
    return {zero, zero, {zero, zero, zero}};
  }
  const T old_work = contract(stress, strain_at_start);
  const auto now = viscous_stress(viscosity, motion, speed, omega_squared, share);
  stress = now.stress;
  return {T(0.5) * (old_work + contract(stress, motion.strain)), now.damping, now.along};
}

/// Brings one hexahedron from the old to the new positions and gives its nodal forces.
///
/// Strain and spin come from the gradient in the middle of the step, where a rigid rotation gives
/// no strain at all; stress, tensors of the law and hourglass forces are turned by Hughes & Winget's rotation; forces
/// are taken with the gradient at the end. The strain of the middle turns on by half the rotation to
/// meet the stress of the end; without that, large shear and the energy are off in the first order.
///
/// share  [-] of the viscosity
/// x  [m] at the end of the step;  dx  [m] increment of x over the step;  dt  [s] above zero; rates are dx / dt
/// force  [N] by which the element pulls its nodes
template <class T, class Law>
NEREID_HOT Report<T, Hexahedron> advance(const Law& law, const Hexahedron::Options& options,
                  const Hexahedron::Constants<T>& constants, const Shares<T, 3>& share, const std::array<Vector<T>, 8>& x,
                  const std::array<Vector<T>, 8>& dx, T dt, Hexahedron::Memory<T, Law>& memory,
                  std::array<Vector<T>, 8>& force) {
  const T eighth(0.125), eight(8.0), half(0.5), per_dt = T(1.0) / dt;
  const Modes<T> X = scaled(eighth, sums_by_mode(x)), D = scaled(eighth, sums_by_mode(dx));
  const auto [middle, at_middle, L, strain, half_spin, Q, growth] = mean_motion(X, D);

  memory.stress = rotate(Q, memory.stress);
  for (Symmetric<T>& tensor : memory.internal.tensor) tensor = rotate(Q, tensor);
  const material::Increment<T, Symmetric> increment{
      .strain = strain, .dt = dt, .volume = at_middle.volume * T(law.density) * constants.per_mass};
  const Symmetric<T> before = memory.stress;
  const auto [work, moduli] = update_stress(law, increment, memory.stress, memory.internal);

  const T zero(0.0);
  using Kind = Hexahedron::Hourglass;
  const Kind kind = options.hourglass_kind;
  HourglassWork<T> hourglass{zero, zero};
  std::array<Vector<T>, 4> bent;
  for (int a = 0; a < 4; ++a) {
    bent[a] = rotated_by(half_spin, eight * (D.hourglass[a] - L * middle.hourglass[a]));
    memory.hourglass[a] = Q * memory.hourglass[a];
  }
  if (kind == Kind::assumed_strain) {
    std::array<Vector<T>, 4> q;
    for (int a = 0; a < 4; ++a) q[a] = eighth * bent[a];
    const auto frame =
        centre_frame<T>({rotated_by(half_spin, middle.xi), rotated_by(half_spin, middle.eta), rotated_by(half_spin, middle.zeta)});
    hourglass = hold_by_assumed_strain(law, constants.hourglass, frame, q, at_middle.volume, at_middle.per_volume,
                                       {T(moduli.lambda), T(moduli.mu)}, {increment.strain, before, memory.stress, work.dissipated},
                                       memory.internal, memory.hourglass, memory.bent);
  } else {
    const bool springs = kind == Kind::stiffness;
    const T keeps(springs ? 1.0 : 0.0), grows = constants.hourglass * (springs ? T(1.0) : per_dt);
    for (int a = 0; a < 4; ++a) {
      const Vector<T> old = memory.hourglass[a], now = keeps * old + grows * bent[a];
      hourglass.stored = hourglass.stored + half * dot(old + now, bent[a]);
      memory.hourglass[a] = now;
    }
  }

  // at the end of the step: stable step, viscous stress, forces
  const Gradient<T> at_end = volume_gradient(X);
  const Symmetric<T> G = gradient_products(at_end);
  T omega_squared = largest_frequency_squared(G, at_end.per_volume, constants.per_mass, moduli);
  if (kind == Kind::assumed_strain) omega_squared = omega_squared * coupling_of_hourglass(G, at_end, X);
  const Motion<T> motion{X.xi, X.eta, X.zeta, D.xi, D.eta, D.zeta, strain, memory.stress - before, growth, dt};
  const ViscousStep<T> viscous = advance_viscous(options.viscosity, motion, strain_at_start(L, half_spin),
                                                 material::wave_speed(moduli, law.density), omega_squared, share, memory.viscous);

  force = forces_of_stress(matrix(memory.stress + memory.viscous), memory.hourglass, X, at_end);
  const Controlled<T> controlled =
      control_distortion(options.distortion, law.young, law.density, constants.start, constants.per_mass, x, memory.distortion, force);

  const bool dashpots = kind == Kind::viscous;
  const T damping = dashpots ? viscous.damping + T(32.0) * constants.hourglass * constants.per_mass : viscous.damping;
  return {.stored = {work.stored * at_middle.volume, dashpots ? zero : hourglass.stored, controlled.stored},
          .dissipated = {work.dissipated * at_middle.volume + hourglass.dissipated, viscous.work * at_middle.volume,
                         dashpots ? hourglass.stored : zero},
          .step = stable_step(omega_squared + controlled.omega_squared, damping),
          .volume_ratio = at_end.volume * T(law.density) * constants.per_mass,
          .along = viscous.along};
}

/// Constants of a hexahedron in its reference positions.
///
/// Springs      k = kappa 2 mu (V^2 B:B) / (72 V): for a cube with poisson = 0 and kappa = 1, the stiffness
///              of the exact element in bending.
/// Dashpots     c = epsilon m omega/32,  omega^2 = 8/(3 m V) (lambda + 2 mu) V^2 B:B; for a cube omega is 2 c/h
///              of its wave speed c, and an hourglass velocity falls as exp(-2 epsilon omega t).
template <class T, class Law>
NEREID_HOT Hexahedron::Constants<T> constants(const Law& law, const Hexahedron::Options& options,
                                   const std::array<Vector<T>, 8>& X) {
  const Gradient<T> g = volume_gradient(scaled(T(0.125), sums_by_mode(X)));
  const auto [lambda, mu] = material::lame(law);
  const T mass = T(law.density) * g.volume, products = trace(gradient_products(g)) * g.per_volume;
  using Kind = Hexahedron::Hourglass;
  const Kind kind = options.hourglass_kind;
  return {.mass = mass,
          .per_mass = T(1.0) / mass,
          .hourglass = kind == Kind::assumed_strain ? T(options.hourglass)
                       : kind == Kind::stiffness
                           ? T(options.hourglass * 2.0 * mu / 72.0) * products
                           : T(options.hourglass / 32.0) * root(T(8.0 / 3.0 * (lambda + 2.0 * mu)) * products * mass),
          .start = start_of_control(X)};
}

}  // namespace nereid::element
