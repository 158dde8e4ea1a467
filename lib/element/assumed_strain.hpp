#pragma once
// Hourglass stiffness of the one-point hexahedron from its own elasticity: strains that bend as a beam and as a plate do.
//
// The tangents at the centre g_0, g_1, g_2 (along xi, eta, zeta) span three planes; plane k has the tangents i = k+1, j = k+2 (modulo 3).
// Hourglass displacements make a plane stress in each plane, linear in coordinate k, and a uniaxial stress along each tangent, that goes
// with xi eta zeta. Shears out of the planes are left out, so nothing locks; the stress across a plane is zero, as an
// incompatible mode would find it. On bricks this is the stiffness of incompatible modes in closed form: docs/theory/hexahedron.md.

#include <array>

#include "base/tensor.hpp"

namespace nereid::element {

/// Tangents at the centre of a hexahedron, and the metrics of the planes between them.
template <class T>
struct CentreFrame {
  /// Contravariant components of the metric of a plane. [1/m2]
  struct Raised {
    T ii, jj, ij;
  };
  std::array<Vector<T>, 3> g;     ///< [m] half the way from face to face
  std::array<T, 3> equal;         ///< [m2] g_k . g_k
  std::array<T, 3> mixed;         ///< [m2] g_i . g_j of plane k
  std::array<Raised, 3> raised;   ///< of plane k
};

template <class T>
NEREID_HOT CentreFrame<T> centre_frame(const std::array<Vector<T>, 3>& g) {
  CentreFrame<T> f{.g = g, .equal = {dot(g[0], g[0]), dot(g[1], g[1]), dot(g[2], g[2])},
                   .mixed = {dot(g[1], g[2]), dot(g[2], g[0]), dot(g[0], g[1])}, .raised = {}};
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const T per = T(1.0) / (f.equal[i] * f.equal[j] - f.mixed[k] * f.mixed[k]);
    f.raised[k] = {per * f.equal[j], per * f.equal[i], -(per * f.mixed[k])};
  }
  return f;
}

/// Moments of the linear stresses: contravariant components in each plane, and along each tangent. [N/m]
template <class T>
struct HourglassMoments {
  struct Plane {
    T ii, jj, ij;
  };
  std::array<Plane, 3> plane;
  std::array<T, 3> along;
};

/// Forces on the amplitudes of the hourglass modes, over eight. [N]
///
///     Q_j += m_ii g_i + m_ij g_j,   Q_i += m_jj g_j + m_ij g_i   of each plane,      Q_3 = sum of m_k g_k
template <class T>
NEREID_HOT std::array<Vector<T>, 4> forces_of(const CentreFrame<T>& f, const HourglassMoments<T>& m) {
  std::array<Vector<T>, 4> Q;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;  // mode k is the j of plane i and the i of plane j
    Q[k] = (m.plane[i].ij + m.plane[j].ij) * f.g[k] + m.plane[i].ii * f.g[j] + m.plane[j].jj * f.g[i];
  }
  Q[3] = m.along[0] * f.g[0] + m.along[1] * f.g[1] + m.along[2] * f.g[2];
  return Q;
}

/// The inverse of forces_of().
template <class T>
NEREID_HOT HourglassMoments<T> moments_of(const CentreFrame<T>& f, const std::array<Vector<T>, 4>& Q) {
  const std::array<Vector<T>, 3> area{cross(f.g[1], f.g[2]), cross(f.g[2], f.g[0]), cross(f.g[0], f.g[1])};
  const T per = T(1.0) / dot(f.g[0], area[0]), half(0.5);
  const std::array<Vector<T>, 3> dual{per * area[0], per * area[1], per * area[2]};
  const std::array<T, 3> own{dot(Q[0], dual[0]), dot(Q[1], dual[1]), dot(Q[2], dual[2])};
  HourglassMoments<T> m;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    m.plane[k] = {dot(Q[j], dual[i]), dot(Q[i], dual[j]), half * (own[i] + own[j] - own[k])};
    m.along[k] = dot(Q[3], dual[k]);
  }
  return m;
}

/// A plane tensor with covariant components, raised:  A e A. [1/m4 of e]
template <class T>
struct PlaneTensor {
  T ii, jj, ij;  ///< of A e A
  T trace;       ///< A : e
};
template <class T>
NEREID_HOT PlaneTensor<T> raised(const typename CentreFrame<T>::Raised& A, T ii, T jj, T ij) {
  const T a = A.ii * ii + A.ij * ij, b = A.ii * ij + A.ij * jj, c = A.ij * ii + A.jj * ij, d = A.ij * ij + A.jj * jj;
  return {a * A.ii + b * A.ij, c * A.ij + d * A.jj, a * A.ij + b * A.jj, a + d};
}

/// What increments of the hourglass amplitudes add to the moments.
///
///     e_ii = g_i . q_j,   e_jj = g_j . q_i,   e_ij = (g_i . q_i + g_j . q_j)/2            strains of plane k, covariant
///     m   += V/24 [ 2 lambda mu/(lambda + 2 mu) (A : e) A + 2 mu A e A ],    m_k += V/72 E (g_k . q_3)/(g_k . g_k)^2
///
/// q  [m] of eta zeta, zeta xi, xi eta, xi eta zeta, without what the linear field makes of them
template <class T>
NEREID_HOT HourglassMoments<T> moments_from(const CentreFrame<T>& f, const std::array<Vector<T>, 4>& q, T volume, T lambda, T mu) {
  const T two_mu = T(2.0) * mu, weight = T(1.0 / 24.0) * volume;
  const T plane = weight * (two_mu * lambda / (lambda + two_mu)), shear = weight * two_mu;
  const T young = T(1.0 / 72.0) * volume * (mu * (T(3.0) * lambda + two_mu) / (lambda + mu));
  const std::array<T, 3> own{dot(f.g[0], q[0]), dot(f.g[1], q[1]), dot(f.g[2], q[2])};
  HourglassMoments<T> m;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const auto& A = f.raised[k];
    const PlaneTensor<T> e = raised<T>(A, dot(f.g[i], q[j]), dot(f.g[j], q[i]), T(0.5) * (own[i] + own[j]));
    const T t = plane * e.trace;
    m.plane[k] = {t * A.ii + shear * e.ii, t * A.jj + shear * e.jj, t * A.ij + shear * e.ij};
    m.along[k] = young * dot(f.g[k], q[3]) / (f.equal[k] * f.equal[k]);
  }
  return m;
}

/// Elastic energy of the moments:  half of them times the strains that they belong to. [J]
template <class T>
NEREID_HOT T energy_of(const CentreFrame<T>& f, const HourglassMoments<T>& m, T per_volume, double young, double poisson) {
  T planes(0.0), along(0.0);
  for (int k = 0; k < 3; ++k) {
    const auto& s = m.plane[k];
    const T a = f.equal[(k + 1) % 3], b = f.equal[(k + 2) % 3], c = f.mixed[k];
    const T ii = s.ii * a + s.ij * c, jj = s.ij * c + s.jj * b, ij = s.ii * c + s.ij * b, ji = s.ij * a + s.jj * c, t = ii + jj;
    planes = planes + ii * ii + jj * jj + T(2.0) * ij * ji - T(poisson / (1 + poisson)) * t * t;
    const T l = m.along[k] * f.equal[k];
    along = along + l * l;
  }
  return per_volume * (T(96.0 * (1 + poisson) / young) * planes + T(288.0 / young) * along);
}

/// Takes from the moments what the flow of the mean stress does not leave. All points of the element are on the yield surface then, so
/// a stress that is linear in the coordinates has no part along the deviator s of the mean. It goes along the flow, which lets the energy
/// fall:
///
///     m -= (m : s)/(s : u) u,    u = A s A + nu/(1 - nu) (A : s) A       of each plane
///
/// shape   [Pa] that deviator, less the back stress;  part  1: all of it
template <class T>
NEREID_HOT void take_along(const CentreFrame<T>& f, const Symmetric<T>& shape, T part, double poisson, HourglassMoments<T>& m) {
  const std::array<Vector<T>, 3> s{shape * f.g[0], shape * f.g[1], shape * f.g[2]};
  const T size = contract(shape, shape) + T(1e-300), widening(poisson / (1 - poisson));
  const std::array<T, 3> equal{dot(f.g[0], s[0]), dot(f.g[1], s[1]), dot(f.g[2], s[2])};
  const std::array<T, 3> mixed{dot(f.g[1], s[2]), dot(f.g[2], s[0]), dot(f.g[0], s[1])};
  for (int k = 0; k < 3; ++k) {
    const T ii = equal[(k + 1) % 3], jj = equal[(k + 2) % 3], ij = mixed[k];
    const auto& A = f.raised[k];
    PlaneTensor<T> u = raised<T>(A, ii, jj, ij);
    const T wide = widening * u.trace;
    u.ii = u.ii + wide * A.ii, u.jj = u.jj + wide * A.jj, u.ij = u.ij + wide * A.ij;
    auto& p = m.plane[k];
    const T within = u.ii * ii + u.jj * jj + T(2.0) * u.ij * ij;
    const T take = part * (p.ii * ii + p.jj * jj + T(2.0) * p.ij * ij) / larger(within, T(1e-3) * size);
    p.ii = p.ii - take * u.ii, p.jj = p.jj - take * u.jj, p.ij = p.ij - take * u.ij;
    const T t = equal[k] / f.equal[k];
    m.along[k] = m.along[k] * (T(1.0) - part * smaller(T(1.0), T(1.5) * t * t / size));
  }
}

}  // namespace nereid::element
