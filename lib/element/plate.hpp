#pragma once
// The 3-node C0 plate (Belytschko, Stolarski & Carpenter, Int. J. Num. Meth. Engng 20, 1984):
// linear displacements and rotations, one point in the plane, layers through the thickness,
// co-rotational, with transverse shear taken from the edges: docs/theory/plate.md.

#include <algorithm>
#include <array>

#include "base/tensor.hpp"
#include "element/report.hpp"
#include "element/shown.hpp"
#include "element/viscosity.hpp"
#include "material/j2_mixed.hpp"
#include "material/j2_search.hpp"

namespace nereid::element {

/// Orthonormal axes of a triangle: e1 along side 1-2, e3 along its normal.
template <class T>
struct PlateFrame {
  Vector<T> e1, e2, e3;
};

/// A triangle in its own plane, node 1 at the origin, node 2 at (x2, 0), node 3 at (x3, y3).
template <class T>
struct PlateShape {
  PlateFrame<T> frame;
  T area;                            // [m2]
  T x2, x3, y3;                      // [m]
  std::array<T, 3> gradient_x, gradient_y;  // [1/m] of the linear shape functions
};

template <class T>
NEREID_HOT PlateShape<T> plate_shape(const std::array<Vector<T>, 3>& x) {
  const Vector<T> side = x[1] - x[0], other = x[2] - x[0];
  const Vector<T> normal = cross(side, other);
  PlateShape<T> s;
  s.x2 = norm(side);
  const T twice_area = norm(normal);
  s.frame.e1 = (T(1.0) / s.x2) * side;
  s.frame.e3 = (T(1.0) / twice_area) * normal;
  s.frame.e2 = cross(s.frame.e3, s.frame.e1);
  s.x3 = dot(other, s.frame.e1);
  s.y3 = dot(other, s.frame.e2);
  s.area = T(0.5) * twice_area;
  const T scale = T(1.0) / twice_area;
  s.gradient_x = {-(scale * s.y3), scale * s.y3, T(0.0)};
  s.gradient_y = {scale * (s.x3 - s.x2), -(scale * s.x3), scale * s.x2};
  return s;
}

/// A vector in the plane of the triangle.
template <class T>
struct InPlane {
  T x, y;
};

/// How the transverse shear strain follows from the edges.
///
/// Along an edge from I to J, with beta = (theta_y, -theta_x) the rotation of the normal,
///     g_IJ = (w_J - w_I) + (beta_I + beta_J)/2 . (x_J - x_I)
/// is the edge's mean shear times its length. Each corner has one shear vector that agrees with its
/// two edges; the element takes the mean of the three:
///     gamma = sum over edges of  by_edge[IJ] g_IJ,     by_edge[IJ] = (grad N_J - grad N_I) / 3
/// Pure bending then gives no shear along any edge, which is what a plain one-point rule lacks.
template <class T>
NEREID_HOT std::array<InPlane<T>, 3> shear_by_edge(const PlateShape<T>& s) {
  const T third(1.0 / 3.0);
  const auto& [x1, x2, x3] = s.gradient_x;
  const auto& [y1, y2, y3] = s.gradient_y;
  return {InPlane<T>{third * (x2 - x1), third * (y2 - y1)}, {third * (x3 - x2), third * (y3 - y2)},
          {third * (x1 - x3), third * (y1 - y3)}};
}

/// The edges 1-2, 2-3, 3-1 as vectors in the plane. [m]
template <class T>
NEREID_HOT std::array<InPlane<T>, 3> edges(const PlateShape<T>& s) {
  return {InPlane<T>{s.x2, T(0.0)}, {s.x3 - s.x2, s.y3}, {-s.x3, -s.y3}};
}

/// Share of the transverse shear stiffness that an element keeps beside its residual bending flexibility.
///
/// Rotations are linear, so a triangle has the mean of the moments and none of their gradient, which balances the shear. That gradient
/// would bend it: a shear q along x has moments q x about the centroid, and their energy q^2 <x^2> / 2 D, which the triangle lacks, is
/// added to that of the shear (MacNeal 1978). Of both directions the mean is taken, <x^2 + y^2>/2 = (sum of squared edges) / 72:
///     1 / (1 + kappa mu thickness <r^2>/2 / D),     D = (lambda' + 2 mu) thickness^3 / 12
///
/// returns  [-] in (0, 1]
template <class T, class N>
NEREID_HOT T share_of_shear(const material::Moduli<N>& moduli, double shear_factor, T thickness, const PlateShape<T>& s) {
  const T third_side = s.x3 - s.x2;
  const T squares = s.x2 * s.x2 + third_side * third_side + s.x3 * s.x3 + T(2.0) * s.y3 * s.y3;
  const N shear_over_bending = N(shear_factor) * moduli.mu / (material::plane_lambda(moduli) + N(2.0) * moduli.mu);
  return T(1.0) / (T(1.0) + T(shear_over_bending * N(1.0 / 6.0)) * squares / (thickness * thickness));
}

/// Largest eigenvalue of [[xx, xy], [xy, yy]].
template <class T>
NEREID_HOT T largest_eigenvalue(const Plane<T>& a) {
  const T half(0.5);
  const T mean = half * (a.xx + a.yy), difference = half * (a.xx - a.yy);
  return mean + root(difference * difference + a.xy * a.xy);
}

/// Points and weights of Gauss's rule on [-1/2, 1/2], for 1 to 9 layers; the weights sum to one.
struct Layers {
  int count = 0;
  std::array<double, 9> z{}, weight{};
};
Layers gauss_layers(int count);

/// The plate as a kind of element: what it is made of and what it remembers.
struct Plate {
  static constexpr int nodes = 3, dimensions = 2, axes = 1, sides = 3, arms = 0;
  static constexpr bool rotates = true, layered = true;
  static constexpr std::array stored_channels{Stored::elastic, Stored::transverse_shear, Stored::residual_bending,
                                              Stored::drilling};
  static constexpr std::array dissipated_channels{Dissipated::plastic, Dissipated::viscous};
  static constexpr int most_layers = 9;
  static constexpr double shear_factor = 5.0 / 6.0;  ///< [-] of a homogeneous section
  static constexpr double drilling_limit = 0.2;      ///< [-] adds at most a fifteenth to the membrane's squared frequency

  enum class RotaryInertia {
    physical,  ///< thickness^2 / 12 per mass
    scaled,    ///< raised until bending and transverse shear need no smaller step than the membrane
  };

  enum class Thinning {
    by_law,          ///< follows_strain where the law flows, else constant
    constant,        ///< the thickness stays, whatever the strain
    follows_strain,  ///< the thickness is the volume that the law leaves, over the area
  };

  struct Options {
    double thickness = 0;  ///< [m] of the reference
    int layers = 5;
    RotaryInertia rotary_inertia = RotaryInertia::scaled;
    Viscosity viscosity;
    Thinning thinning = Thinning::by_law;
    double drilling = 0.1;  ///< [-] stiffness of spins about the normal, over the shear modulus; see drilling_part
  };

  static bool has(const Options& options, Stored channel) { return channel != Stored::drilling || options.drilling > 0; }
  static bool has(const Options&, Dissipated) { return true; }
  /// How deep the element is behind its face, whatever its volume and area. [m]
  static double depth(const Options& options, double, double) { return options.thickness; }
  /// Distance between the two faces of a plate in the reference; zero of a solid. [m]
  static double thickness(const Options& options) { return options.thickness; }
  /// Whether the thickness changes with the strain.
  template <class Law>
  static bool thins(const Options& options) {
    return options.thinning == Thinning::follows_strain || (options.thinning == Thinning::by_law && material::flows<Law>);
  }

  template <class T>
  struct Constants {
    T mass;      ///< [kg]
    T gyration;  ///< [m2] rotary inertia per mass
    template <class F>
    void each_row(F&& f) { f(mass), f(gyration); }
    static constexpr int rows = 2;
  };

  template <class T, class Law>
  struct Layer {
    Plane<T> stress;  ///< [Pa] in the element's own axes
    material::Internal<T, Law, Plane> internal;
  };

  /// What one element remembers, in its own axes. Layers beyond Options::layers are not stored.
  template <class T, class Law>
  struct Memory {
    std::array<Layer<T, Law>, most_layers> layers;
    InPlane<T> shear;  ///< [Pa] transverse shear resultant per thickness
    Plane<T> viscous;  ///< [Pa] in the plane; not stored without viscosity
    Plane<T> bent;     ///< [-] strain of the top less that of the middle surface, as curvature times half the thickness has made it
    std::array<T, 3> drilling;  ///< [Pa] moments about the normal at the nodes per third of the volume; not stored without a stiffness
    template <class F>
    void each_row(F&& f, const Options& options) {
      for (int l = 0; l < options.layers; ++l) {
        auto& layer = layers[l];
        layer.stress.each_row(f);
        layer.internal.each_row(f);
      }
      f(shear.x), f(shear.y);
      bent.each_row(f);
      if (acts(options.viscosity)) viscous.each_row(f);
      if (options.drilling > 0)
        for (T& each : drilling) f(each);
    }
    template <class F>
    void each_internal(F&& f) {
      for (auto& layer : layers) f(layer.internal);
    }
    static constexpr int rows(const Options& options) {
      return options.layers * (3 + material::Internal<T, Law, Plane>::rows) + 5 + (acts(options.viscosity) ? 3 : 0) +
             (options.drilling > 0 ? 3 : 0);
    }
  };
};

/// What a plate has at a place through its thickness.
template <class Law>
struct AtPlace {
  Plane<double> stress;  ///< [Pa] in the element's own axes
  material::Internal<double, Law, Plane> internal;
};

/// By what factor the strain rate lifts the stress of a layer above its yield stress; 1 of laws that do not depend on the rate.
template <class Law>
double overstress(const Law& law, const Plane<double>& stress, const material::Internal<double, Law, Plane>& internal) {
  if constexpr (requires { requires material::SearchedFlow<decltype(law.flow)>; })
    return std::max(1.0, material::von_mises(stress) / yield_stress(law, internal.scalar));
  else return 1.0;
}

/// Draws a stress back to the yield surface along its line to the centre of that surface; laws without a yield stress keep it.
///
/// over  [-] factor of the yield stress
template <class Law>
void limit_by_yield(const Law& law, double over, AtPlace<Law>& at) {
  if constexpr (requires { yield_stress(law, at.internal.scalar); }) {
    Plane<double> centre{0, 0, 0};
    if constexpr (Law::tensors.size() > 0) centre = material::surface_centre(at.internal.tensor[0]);
    const Plane<double> shifted = at.stress - centre;
    const double yield = over * yield_stress(law, at.internal.scalar), mises = material::von_mises(shifted);
    if (mises > yield) at.stress = centre + (yield / mises) * shifted;
  }
}

/// Stress and internal variables of a plate at a place, from its layers.
///
/// The top and the bottom lie on the straight line through the two outermost layers, the middle on that through the two beside it; a single
/// layer stands for all. Internal scalars are no less than those of the start, and the stress is limited by the yield stress at them,
/// with the rate of those layers. The membrane is the mean through the thickness.
template <class Law>
AtPlace<Law> at_place(const Law& law, const Layers& layers, const Plate::Memory<double, Law>& memory, Place place) {
  AtPlace<Law> sum{};
  const auto add = [&](int l, double weight) {
    const auto& layer = memory.layers[l];
    sum.stress = sum.stress + weight * layer.stress;
    for (std::size_t i = 0; i < sum.internal.scalar.size(); ++i) sum.internal.scalar[i] += weight * layer.internal.scalar[i];
    for (std::size_t i = 0; i < sum.internal.tensor.size(); ++i)
      sum.internal.tensor[i] = sum.internal.tensor[i] + weight * layer.internal.tensor[i];
  };
  if (place == Place::membrane || layers.count == 1) {
    for (int l = 0; l < layers.count; ++l) add(l, layers.weight[l]);
    return sum;
  }
  const int upper = place == Place::top ? layers.count - 1 : place == Place::bottom ? 1 : layers.count / 2;
  const double z = place == Place::top ? 0.5 : place == Place::bottom ? -0.5 : 0.0;
  const double weight = (z - layers.z[upper - 1]) / (layers.z[upper] - layers.z[upper - 1]);
  add(upper - 1, 1 - weight), add(upper, weight);
  const auto start = material::fresh<double, Plane>(law).scalar;
  for (std::size_t i = 0; i < start.size(); ++i) sum.internal.scalar[i] = std::max(sum.internal.scalar[i], start[i]);
  double over = 1;
  for (const int l : {upper - 1, upper}) over = std::max(over, overstress(law, memory.layers[l].stress, memory.layers[l].internal));
  limit_by_yield(law, over, sum);
  return sum;
}

/// Strain of a plate at a place: that of Hencky of the middle surface, and of the top and the bottom what bending has added. Along the
/// normal it is what the law leaves of the volume there. No transverse shear, as of the stress.
///
///     in the plane  1/2 ln(F F^T) + 2 z/t bent,      along the normal  theta(stress) - xx - yy
///
/// from, to  triangle in the reference and now
/// stress    [Pa] at that place
/// returns   [-] in the element's own axes, tensor components
template <class Law>
Symmetric<double> strain_at_place(const Law& law, const PlateShape<double>& from, const PlateShape<double>& to,
                                  const Plate::Memory<double, Law>& memory, const Plane<double>& stress, Place place) {
  const double stretch = to.x2 / from.x2;
  const Mat2 F{{stretch, (to.x3 - stretch * from.x3) / from.y3}, {0.0, to.y3 / from.y3}};
  const double side = place == Place::top ? 1 : place == Place::bottom ? -1 : 0;
  const Plane<double> e = hencky_strain(F) + side * memory.bent;
  return {e.xx, e.yy, material::volume_strain(law, stress) - e.xx - e.yy, e.xy, 0, 0};
}

/// The strain of volume of a plate, a mean over its layers. [-]
template <class T, class Law>
NEREID_HOT T volume_strain(const Law& law, const Layers& layers, const Plate::Memory<T, Law>& memory) {
  T sum(0.0);
  for (int l = 0; l < layers.count; ++l) sum = sum + T(layers.weight[l]) * material::volume_strain(law, memory.layers[l].stress);
  return sum;
}

/// The volume that the law leaves a plate: the strain of volume theta is logarithmic,
///     exp(theta) = (12 + 6 theta + theta^2) / (12 - 6 theta + theta^2),     theta^5 / 720 off in its logarithm.
///
/// returns  [m3] above zero
template <class T, class Law>
NEREID_HOT T volume_left(const Law& law, const Layers& layers, const Plate::Constants<T>& constants, const Plate::Memory<T, Law>& memory) {
  const T theta = volume_strain(law, layers, memory), even = T(12.0) + theta * theta, odd = T(6.0) * theta;
  return constants.mass * (even + odd) / (T(law.density) * (even - odd));
}

/// The thickness that the law leaves a plate: its volume over its area. [m]
template <class T, class Law>
NEREID_HOT T thickness_left(const Law& law, const Layers& layers, const Plate::Constants<T>& constants, const std::array<Vector<T>, 3>& x,
                            const Plate::Memory<T, Law>& memory) {
  return volume_left(law, layers, constants, memory) / (T(0.5) * norm(cross(x[1] - x[0], x[2] - x[0])));
}

/// Bounds on the squared frequencies of one plate, a third of its mass at each node. [1/s2]
template <class T>
struct PlateFrequencies {
  T membrane, bending_and_shear;
};

/// membrane  3/rho (lambda' tr G + 2 mu g_max), G = sum of grad N (x) grad N, plane stress
/// bending   the same times (thickness^2/12) / gyration
/// shear     3 kappa mu share / rho times the largest eigenvalue of G + C / gyration, where C collects how
///           the edges' shear follows the rotations, and the share is share_of_shear; bending and shear share
///           the rotations, so their bounds are added.
template <class T, class N>
NEREID_HOT PlateFrequencies<T> largest_frequencies_squared(const material::Moduli<N>& moduli, double density, T thickness,
                                                           T gyration, const PlateShape<T>& s) {
  const N mu = moduli.mu;
  // a trace is no smaller than its largest eigenvalue, so for poisson < 0 the first term is left out
  const N lambda = larger(material::plane_lambda(moduli), N(0.0));
  Plane<T> G{T(0.0), T(0.0), T(0.0)}, C = G;
  const auto add = [](Plane<T>& to, const InPlane<T>& a) {
    to.xx = to.xx + a.x * a.x, to.yy = to.yy + a.y * a.y, to.xy = to.xy + a.x * a.y;
  };
  for (int a = 0; a < 3; ++a) add(G, {s.gradient_x[a], s.gradient_y[a]});
  const auto by_edge = shear_by_edge(s);
  const auto edge = edges(s);
  const T half(0.5);
  for (int a = 0; a < 3; ++a) {  // node a ends edge a - 1 and begins edge a
    const auto& [p, e] = std::pair{by_edge[a], edge[a]};
    const auto& [q, d] = std::pair{by_edge[(a + 2) % 3], edge[(a + 2) % 3]};
    add(C, {half * (p.x * e.x + q.x * d.x), half * (p.y * e.x + q.y * d.x)});  // by beta_x
    add(C, {half * (p.x * e.y + q.x * d.y), half * (p.y * e.y + q.y * d.y)});  // by beta_y
  }
  const T three_by_density(3.0 / density);
  const T membrane = three_by_density * (T(lambda) * (G.xx + G.yy) + T(N(2.0) * mu) * largest_eigenvalue(G));
  const T per_gyration = T(1.0) / gyration;
  const T shear = three_by_density * T(N(Plate::shear_factor) * mu) * share_of_shear(moduli, Plate::shear_factor, thickness, s) *
                  (largest_eigenvalue(G) + per_gyration * largest_eigenvalue(C));
  return {.membrane = membrane,
          .bending_and_shear = T(1.0 / 12.0) * thickness * thickness * per_gyration * membrane + shear};
}

/// How the mean rotation of a plate in its plane follows from the displacement of a node,
///     w = 1/2 sum of  dN/dx u_y - dN/dy u_x
template <class T>
NEREID_HOT Vector<T> gradient_of_spin(const PlateShape<T>& s, int a) {
  const T half(0.5);
  return (half * s.gradient_x[a]) * s.frame.e2 - (half * s.gradient_y[a]) * s.frame.e1;
}

/// tr G, the sum of the squares of the gradients. [1/m2]
template <class T>
NEREID_HOT T trace_of_gradients(const PlateShape<T>& s) {
  T sum(0.0);
  for (int a = 0; a < 3; ++a) sum = sum + s.gradient_x[a] * s.gradient_x[a] + s.gradient_y[a] * s.gradient_y[a];
  return sum;
}

/// The part of the shear modulus that resists drilling: no more than Plate::drilling_limit gyration tr G, so that the step of plates that
/// are thin beside their sides is not that of their spin. [-]
template <class T>
NEREID_HOT T drilling_part(double part, T gyration, T trace) {
  return smaller(T(part), T(Plate::drilling_limit) * gyration * trace);
}

/// Bound on the squared frequency that drilling adds to that of the membrane. [1/s2]
///
/// The moments k (turn_a - w), k = part mu volume / 3, with m/3 and m gyration/3 at each node, have in all modes of one plate no more than
///     3 k / m (1/gyration + 3 sum of |grad_a w|^2) = part mu / density (1/gyration + 3/4 tr G)
template <class T>
NEREID_HOT T drilling_frequency_squared(T part, double mu, double density, T gyration, T trace) {
  return part * T(mu / density) * (T(1.0) / gyration + T(0.75) * trace);
}

/// Brings one plate from the old to the new positions and gives its nodal forces and moments.
///
/// Strains come from the triangle in the middle of the step. The element's axes follow side 1-2; the
/// material spins by minus the shear strain against them, and the stress and the tensors of the law with it, so that
/// the numbering of the nodes does not matter.
///
/// Of what transverse shear stores the share of share_of_shear is that of shear, the rest that of residual bending.
///
/// With `drilling` each node is held to turn about the normal as the plate does in its plane: moments of a spring of that part of the shear
/// modulus times a third of the volume, and forces that balance them (Hughes & Brezzi 1989).
///
/// A plate that follows its strain has the thickness that the law leaves: in the middle of the step with the stress of its beginning, at
/// the end with that of the end.
///
/// viscous_share  [-] of the viscosity
/// x  [m] at the end of the step;  dx [m] and rotation [rad] increments of position and rotation over the step;
/// dt  [s] above zero; rates are increments / dt
/// force [N] and moment [N m] that the element exerts on its nodes
template <class T, class Law>
NEREID_HOT Report<T, Plate> advance(const Law& law, const Plate::Options& options, const Layers& layers,
                  const Plate::Constants<T>& constants, const Shares<T, 1>& viscous_share, const std::array<Vector<T>, 3>& x,
                  const std::array<Vector<T>, 3>& dx, const std::array<Vector<T>, 3>& rotation, T dt,
                  Plate::Memory<T, Law>& memory, std::array<Vector<T>, 3>& force,
                  std::array<Vector<T>, 3>& moment) {
  const T half(0.5), zero(0.0), given(options.thickness);
  const bool thins = Plate::thins<Law>(options);

  // in the middle of the step: increments of membrane strain, curvature and transverse shear
  std::array<Vector<T>, 3> x_middle;
  for (int a = 0; a < 3; ++a) x_middle[a] = x[a] - half * dx[a];
  const PlateShape<T> middle = plate_shape(x_middle);
  Plane<T> strain{zero, zero, zero}, curvature = strain;
  std::array<T, 3> deflection;
  std::array<InPlane<T>, 3> beta;
  for (int a = 0; a < 3; ++a) {
    const auto& [e1, e2, e3] = middle.frame;
    const T ux = dot(dx[a], e1), uy = dot(dx[a], e2);
    const T bx = middle.gradient_x[a], by = middle.gradient_y[a];
    deflection[a] = dot(dx[a], e3);
    beta[a] = {dot(rotation[a], e2), -dot(rotation[a], e1)};
    strain = strain + Plane<T>{bx * ux, by * uy, half * (bx * uy + by * ux)};
    curvature = curvature + Plane<T>{bx * beta[a].x, by * beta[a].y, half * (bx * beta[a].y + by * beta[a].x)};
  }
  InPlane<T> shear{zero, zero};
  {
    const auto by_edge = shear_by_edge(middle);
    const auto edge = edges(middle);
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const T g = deflection[b] - deflection[a] +
                  half * ((beta[a].x + beta[b].x) * edge[a].x + (beta[a].y + beta[b].y) * edge[a].y);
      shear = {shear.x + by_edge[a].x * g, shear.y + by_edge[a].y * g};
    }
  }

  // the material turns by minus the shear strain against the element's axes
  const T spin = -strain.xy, quarter = T(0.25) * spin * spin;
  const T cosine = (T(1.0) - quarter) / (T(1.0) + quarter), sine = spin / (T(1.0) + quarter);
  const T cc = cosine * cosine, ss = sine * sine, cs = cosine * sine;

  const auto turned = [&](const Plane<T>& s) {
    const T shear_twice = T(2.0) * cs * s.xy;
    return Plane<T>{cc * s.xx + ss * s.yy - shear_twice, ss * s.xx + cc * s.yy + shear_twice,
                    cs * (s.xx - s.yy) + (cc - ss) * s.xy};
  };

  // and by half of it from the middle of the step, where strains were taken, to its end
  const auto rotated_by = [&](const Plane<T>& e) {
    return Plane<T>{e.xx - spin * e.xy, e.yy + spin * e.xy, e.xy + half * spin * (e.xx - e.yy)};
  };
  const Plane<T> stretch = rotated_by(strain), bend = rotated_by(curvature);
  const InPlane<T> slide{shear.x - half * spin * shear.y, shear.y + half * spin * shear.x};

  const T volume_before = thins ? volume_left(law, layers, constants, memory) : middle.area * given;
  const T thickness = thins ? volume_before / middle.area : given;
  const T volume_ratio = volume_before * T(law.density) / constants.mass;
  memory.bent = turned(memory.bent) + (half * thickness) * bend;
  material::ModuliOf<T, Plane, Law> moduli{};
  T stored(0.0), dissipated(0.0);
  Plane<T> membrane{zero, zero, zero}, bending = membrane, turned_membrane = membrane;  // [Pa] resultants per thickness and per its square
  for (int l = 0; l < layers.count; ++l) {
    auto& layer = memory.layers[l];
    layer.stress = turned(layer.stress);
    for (Plane<T>& tensor : layer.internal.tensor) tensor = turned(tensor);
    const T z = T(layers.z[l]) * thickness, weight(layers.weight[l]);
    turned_membrane = turned_membrane + weight * layer.stress;
    const auto [work, here] =
        update_stress(law, material::Increment<T, Plane>{stretch + z * bend, dt, volume_ratio}, layer.stress, layer.internal);
    moduli = l == 0 ? here : stiffer(moduli, here);
    stored = stored + weight * work.stored;
    dissipated = dissipated + weight * work.dissipated;
    membrane = membrane + weight * layer.stress;
    bending = bending + (weight * T(layers.z[l])) * layer.stress;
  }

  const T share = share_of_shear(moduli, Plate::shear_factor, thickness, middle);
  const T shear_stiffness = T(moduli.mu * decltype(moduli.mu)(Plate::shear_factor)) * share;
  const InPlane<T> old{cosine * memory.shear.x - sine * memory.shear.y,
                       sine * memory.shear.x + cosine * memory.shear.y};
  const InPlane<T> now{old.x + shear_stiffness * slide.x, old.y + shear_stiffness * slide.y};
  const T shear_stored = half * ((old.x + now.x) * slide.x + (old.y + now.y) * slide.y);
  memory.shear = now;

  T drilling_stored(0.0);
  const double elastic_mu = material::lame(law).mu;
  if (options.drilling > 0) {
    const T stiffness = T(elastic_mu) * drilling_part(options.drilling, constants.gyration, trace_of_gradients(middle));
    T mean(0.0);
    for (int a = 0; a < 3; ++a) mean = mean + dot(gradient_of_spin(middle, a), dx[a]);
    for (int a = 0; a < 3; ++a) {
      const T turn = dot(rotation[a], middle.frame.e3) - mean, before = memory.drilling[a];
      memory.drilling[a] = before + stiffness * turn;
      drilling_stored = drilling_stored + T(1.0 / 6.0) * (before + memory.drilling[a]) * turn;
    }
  }

  // at the end of the step: stable step, viscous stress, forces and moments
  const PlateShape<T> end = plate_shape(x);
  const T volume = thins ? volume_left(law, layers, constants, memory) : end.area * given;
  const T middle_volume = thins ? half * (volume_before + volume) : volume_before;
  const T thickness_now = thins ? volume / end.area : given;
  const T density = constants.mass / volume;
  const auto omega_squared = largest_frequencies_squared(moduli, law.density, thickness_now, constants.gyration, end);
  const T lighter = T(law.density) / density;  // a plate that keeps its thickness gains volume as it stretches, and no mass
  const T growth = strain.xx + strain.yy;
  T viscous_work(0.0), damping(0.0);
  if (acts(options.viscosity)) {
    const auto modulus = material::plane_lambda(moduli) + decltype(moduli.mu)(2.0) * moduli.mu;
    const PlaneMotion<T> motion{stretch, membrane - turned_membrane, growth, dt};
    const auto viscous = viscous_stress(options.viscosity, motion, modulus, lighter * omega_squared.membrane, viscous_share);
    viscous_work = half * contract(turned(memory.viscous) + viscous.stress, stretch) * middle_volume;
    memory.viscous = viscous.stress;
    damping = viscous.damping;
  } else {
    memory.viscous = {zero, zero, zero};
  }

  const T nx = volume * (membrane.xx + memory.viscous.xx), ny = volume * (membrane.yy + memory.viscous.yy);
  const T nxy = volume * (membrane.xy + memory.viscous.xy);
  const T arm = volume * thickness_now;
  const T mx = arm * bending.xx, my = arm * bending.yy, mxy = arm * bending.xy;
  const auto by_edge = shear_by_edge(end);
  const auto edge = edges(end);
  std::array<T, 3> q;  // [N m / m] work of the shear resultant per edge shear g
  for (int a = 0; a < 3; ++a) q[a] = volume * (now.x * by_edge[a].x + now.y * by_edge[a].y);
  for (int a = 0; a < 3; ++a) {
    const int before = (a + 2) % 3;
    const auto& [e1, e2, e3] = end.frame;
    const T bx = end.gradient_x[a], by = end.gradient_y[a];
    const T fx = nx * bx + nxy * by, fy = nxy * bx + ny * by, fz = q[before] - q[a];
    const T bend_x = mx * bx + mxy * by + half * (q[a] * edge[a].x + q[before] * edge[before].x);
    const T bend_y = mxy * bx + my * by + half * (q[a] * edge[a].y + q[before] * edge[before].y);
    force[a] = -(fx * e1 + fy * e2 + fz * e3);
    moment[a] = bend_y * e1 - bend_x * e2;  // beta = (theta_y, -theta_x)
  }

  const T squares = trace_of_gradients(end);
  T in_plane = omega_squared.membrane;
  if (options.drilling > 0) {
    const T part = drilling_part(options.drilling, constants.gyration, squares);
    in_plane = in_plane + drilling_frequency_squared(part, elastic_mu, law.density, constants.gyration, squares);
    const T third = T(1.0 / 3.0) * volume, all = third * (memory.drilling[0] + memory.drilling[1] + memory.drilling[2]);
    for (int a = 0; a < 3; ++a) {
      moment[a] = moment[a] - (third * memory.drilling[a]) * end.frame.e3;
      force[a] = force[a] + all * gradient_of_spin(end, a);
    }
  }
  return {.stored = {stored * middle_volume, share * shear_stored * middle_volume, (T(1.0) - share) * shear_stored * middle_volume,
                     drilling_stored * middle_volume},
          .dissipated = {dissipated * middle_volume, viscous_work},
          .step = stable_step(lighter * larger(in_plane, omega_squared.bending_and_shear), damping),
          .volume_ratio = end.area * T(law.density * options.thickness) / constants.mass,
          .along = {growth}};
}

/// Constants of a plate in its reference positions.
///
/// Scaled rotary inertia is the gyration at which the bound of bending and shear meets that of the
/// membrane; never less than the physical one.
template <class T, class Law>
NEREID_HOT Plate::Constants<T> constants(const Law& law, const Plate::Options& options,
                              const std::array<Vector<T>, 3>& X) {
  const PlateShape<T> s = plate_shape(X);
  const double physical = options.thickness * options.thickness / 12.0;
  Plate::Constants<T> c{.mass = T(law.density * options.thickness) * s.area, .gyration = T(physical)};
  if (options.rotary_inertia == Plate::RotaryInertia::scaled) {
    // bending_and_shear = a/gyration + b, by two samples; at the size of the element, where both terms are alike
    const auto with = [&](T gyration) {
      return largest_frequencies_squared(material::lame(law), law.density, T(options.thickness), gyration, s);
    };
    const auto at_one = with(s.area), at_two = with(T(2.0) * s.area);
    const T a_by_area = T(2.0) * (at_one.bending_and_shear - at_two.bending_and_shear);
    const T b = at_one.bending_and_shear - a_by_area;
    c.gyration = larger(c.gyration, s.area * a_by_area / (at_one.membrane - b));
  }
  return c;
}

}  // namespace nereid::element
