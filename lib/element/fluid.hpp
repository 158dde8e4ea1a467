#pragma once
// The 8-node hexahedron of fluid: one pressure, no stiffness against a change of shape. docs/theory/fluid.md.

#include <array>
#include <cmath>

#include "element/distortion.hpp"
#include "element/hexahedron.hpp"
#include "element/report.hpp"
#include "element/viscosity.hpp"
#include "element/weight.hpp"
#include "material/fluid.hpp"

namespace nereid::element {

/// The hexahedron of fluid as a kind of element: what it is made of and what it remembers.
struct Fluid {
  static constexpr int nodes = 8, dimensions = 3, axes = 3, sides = 6, arms = 3;
  static constexpr bool rotates = false, layered = false;
  static constexpr std::array stored_channels{Stored::compression, Stored::cavitation, Stored::weight, Stored::distortion};
  static constexpr std::array dissipated_channels{Dissipated::viscous, Dissipated::hourglass, Dissipated::inelastic_impact};

  struct Options {
    double hourglass = usual_hourglass;  ///< [-] of dashpots that grow with the speed of hourglass motion
    Viscosity viscosity;
    Distortion distortion{usual_distortion};  ///< over the bulk modulus at the start
    double pressure = 0;                 ///< [Pa] at the start, at the height of `level`
    std::array<double, 3> gravity{0, 0, 0};  ///< [m/s2] whose weight is at centroids, and by which the pressure grows at the start
    double level = 0;                    ///< [m2/s2] gravity . x where the pressure is `pressure`
  };
  static constexpr double usual_hourglass = 1;
  /// [-] The corner of a cell that closes with the speed v stops at about  usual_distortion c^2/v^2  of where the control begins.
  static constexpr double usual_distortion = 1e-3;

  static bool has_weight(const Options& o) { return o.gravity[0] != 0 || o.gravity[1] != 0 || o.gravity[2] != 0; }
  static bool has(const Options& o, Stored channel) {
    return channel == Stored::weight ? has_weight(o) : channel != Stored::distortion || acts(o.distortion);
  }
  static bool has(const Options& o, Dissipated channel) { return channel != Dissipated::hourglass || o.hourglass > 0; }
  /// How deep the element is behind a face of it, from its volume and the area of the face. [m]
  static double depth(const Options&, double volume, double area) { return volume / area; }
  /// Distance between the two faces of a plate; zero of a solid. [m]
  static double thickness(const Options&) { return 0; }

  /// Constants of one element.
  template <class T>
  struct Constants {
    T mass, per_mass;           ///< [kg] and its inverse
    T reference, per_reference; ///< [m3] volume at which the law has no pressure, and its inverse
    T per_length;               ///< [1/m] of the cube of its volume at the start
    T start;                    ///< [m3] Jacobian of a corner below which distortion control acts
    std::array<T, 8> per_node;  ///< [1/kg] of what each node has of the mass
    template <class F>
    void each_row(F&& f) {
      f(mass), f(per_mass), f(reference), f(per_reference), f(per_length), f(start);
      for (T& row : per_node) f(row);
    }
    static constexpr int rows = 14;
  };

  /// What one element remembers from step to step.
  template <class T, class Law>
  struct Memory {
    material::FluidState<T> state;
    T viscous;                           ///< [Pa] mean stress, positive in tension; not stored without viscosity
    std::array<Vector<T>, 4> hourglass;  ///< [N] on the amplitudes, over eight; not stored without dashpots
    T weight;                            ///< [J] of add_weight(); not stored without gravity
    T distortion;                        ///< [J] that distortion control stores; no row without it
    template <class F>
    void each_row(F&& f, const Options& options) {
      f(state.ratio), f(state.pressure), f(state.energy);
      if (acts(options.viscosity)) f(viscous);
      if (options.hourglass > 0)
        for (auto& q : hourglass) f(q.x), f(q.y), f(q.z);
      if (has_weight(options)) f(weight);
      if (acts(options.distortion)) f(distortion);
    }
    static constexpr int rows(const Options& options) {
      return 3 + (acts(options.viscosity) ? 1 : 0) + (options.hourglass > 0 ? 12 : 0) + (has_weight(options) ? 1 : 0) +
             (acts(options.distortion) ? 1 : 0);
    }
  };
};

template <class T>
NEREID_HOT Vector<T> gravity_of(const Fluid::Options& options) {
  return {T(options.gravity[0]), T(options.gravity[1]), T(options.gravity[2])};
}

/// The gradient of the volume by the nodes. [m2]
template <class T>
NEREID_HOT std::array<Vector<T>, 8> nodal_gradient(const Gradient<T>& g) {
  const T zero(0.0);
  return nodal_values(Modes<T>{g.xi, g.eta, g.zeta, {g.hourglass[0], g.hourglass[1], g.hourglass[2], {zero, zero, zero}}});
}

/// The squared frequency of one element alone:  K/V sum over the nodes of |dV/dx|^2 / m. [1/s2]
template <class T>
NEREID_HOT T squared_frequency_of_fluid(const std::array<Vector<T>, 8>& gradient, const std::array<T, 8>& per_node, T per_volume,
                                        T modulus) {
  T sum(0.0);
  for (int a = 0; a < 8; ++a) sum = sum + per_node[a] * dot(gradient[a], gradient[a]);
  return modulus * per_volume * sum;
}

/// What the viscosity of a fluid needs to know of a step.
template <class T>
struct FluidMotion {
  Vector<T> xi, eta, zeta;                    ///< [m] from the centre to a face of each axis, at the end of the step
  Vector<T> moved_xi, moved_eta, moved_zeta;  ///< [m] how much they changed in it
  T change;                                   ///< [Pa] of the pressure
  T growth, per_dt;                           ///< [-] of the volume, [1/s]
};

/// The viscous stress of viscous_stress() where all stress is pressure; its mean, positive in tension.
template <class T>
struct ViscousPressure {
  T stress;                ///< [Pa]
  T damping;               ///< [1/s] s of stable_step
  std::array<T, 3> along;  ///< [-] strain of the step along each axis
};

/// The length on which viscosity acts along an axis.  square  [m2] of half of it [m]
template <class T>
NEREID_HOT T length_of_axis(T square, T most) {
  return root(smaller(T(4.0) * square, most * most));
}
template <class T>
NEREID_HOT T size_of(T number) {
  return larger(number, -number);
}

/// Longest length on which viscosity acts, over 2 c/omega: that of a cube, whose frequency is sqrt(3) 2 c/h. [-]
constexpr double most_crossings_of_fluid = 1.7320508075688772;

/// speed  c [m/s] of sound now;  omega_squared  [1/s2] bound on the squared frequencies
template <class T>
NEREID_HOT ViscousPressure<T> viscous_pressure(const Viscosity& viscosity, const FluidMotion<T>& m, T speed, T omega_squared,
                                               const Shares<T, 3>& share) {
  const T zero(0.0), half(0.5), crossing = T(2.0 * most_crossings_of_fluid) / root(omega_squared), most = speed * crossing;
  const T part = viscous_part(viscosity, crossing, m.growth * m.per_dt) / speed;
  const T xi2 = dot(m.xi, m.xi), eta2 = dot(m.eta, m.eta), zeta2 = dot(m.zeta, m.zeta);
  const T per_all = T(1.0) / (xi2 * eta2 * zeta2);  // a division costs as much as the rest of an axis
  const T xi = dot(m.xi - half * m.moved_xi, m.moved_xi) * (eta2 * zeta2 * per_all);
  const T eta = dot(m.eta - half * m.moved_eta, m.moved_eta) * (zeta2 * xi2 * per_all);
  const T zeta = dot(m.zeta - half * m.moved_zeta, m.moved_zeta) * (xi2 * eta2 * per_all);
  const T on_xi = length_of_axis(xi2, most), on_eta = length_of_axis(eta2, most), on_zeta = length_of_axis(zeta2, most);
  const T sum = larger(size_of(xi) + size_of(eta) + size_of(zeta), size_of(m.growth));
  const T limited = size_of(xi) * share[0] * on_xi + size_of(eta) * share[1] * on_eta + size_of(zeta) * share[2] * on_zeta;
  const T length = select(m.change * m.growth < zero, limited / (sum + T(1e-300)), zero);
  return {-(part * length * m.per_dt) * m.change, half * part * larger(larger(on_xi, on_eta), on_zeta) * omega_squared, {xi, eta, zeta}};
}

/// What the dashpots against hourglass motion did in a step.
template <class T>
struct HourglassDrag {
  T work;     ///< [J] that they took
  T damping;  ///< [1/s] s of stable_step
};

/// Dashpots against hourglass motion, which grow with its speed and know no speed of sound:
///
///     Q_a = m/8 kappa w/l w_a,     w_a = q_a/dt,  w^2 = sum of w_a^2
///
/// A motion that begins with w has gone by  l/kappa ln(1 + kappa w t/l)  after the time t: it hardly ever closes an element, however fast.
/// In slow smooth motion the force is of the third order in the amplitude, so that waves on a free surface go on.
///
/// q  [m] hourglass increments of the step without what the linear field makes of them;  force  [N] over eight, before and then now
template <class T>
NEREID_HOT HourglassDrag<T> drag_hourglass(T kappa, T mass, T per_length, const std::array<Vector<T>, 4>& q, T per_dt,
                                           std::array<Vector<T>, 4>& force) {
  T square(0.0);
  for (int a = 0; a < 4; ++a) square = square + dot(q[a], q[a]);
  const T rate = kappa * per_length * root(square) * per_dt, part = T(0.125) * mass * rate * per_dt;
  T work(0.0);
  for (int a = 0; a < 4; ++a) {
    const Vector<T> now = part * q[a];
    work = work + T(4.0) * dot(force[a] + now, q[a]);
    force[a] = now;
  }
  return {work, rate};
}

/// Brings one hexahedron of fluid from the old to the new positions and gives its nodal forces.
///
/// The pressure follows from the volume, which is exact, and from the energy at the end of the step before; what viscosity and dashpots
/// take in a step heats the fluid from the next one on.
///
/// share  [-] of the viscosity
/// x  [m] at the end of the step;  dx  [m] increment of x over the step;  dt  [s] above zero
/// force  [N] by which the element pulls its nodes
template <class T, class Law>
NEREID_HOT Report<T, Fluid> advance(const Law& law, const Fluid::Options& options, const Fluid::Constants<T>& constants,
                                    const Shares<T, 3>& share, const std::array<Vector<T>, 8>& x, const std::array<Vector<T>, 8>& dx, T dt,
                                    Fluid::Memory<T, Law>& memory, std::array<Vector<T>, 8>& force) {
  const T eighth(0.125), zero(0.0), half(0.5), per_dt = T(1.0) / dt;
  const Modes<T> X = scaled(eighth, sums_by_mode(x)), D = scaled(eighth, sums_by_mode(dx));
  const Gradient<T> at_end = volume_gradient(X);
  const T ratio = at_end.volume * constants.per_reference;
  const T before = memory.state.ratio, pressure = memory.state.pressure;
  const material::FluidResponse<T> response = update_pressure(law, ratio, memory.state);
  const std::array<Vector<T>, 8> gradient = nodal_gradient(at_end);
  const T omega_squared = squared_frequency_of_fluid(gradient, constants.per_node, at_end.per_volume, response.modulus);

  ViscousPressure<T> viscous{zero, zero, {zero, zero, zero}};
  T viscous_work(zero);
  if (acts(options.viscosity)) {
    const T growth = (ratio - before) / (half * (ratio + before));
    const FluidMotion<T> motion{X.xi, X.eta, X.zeta, D.xi, D.eta, D.zeta, memory.state.pressure - pressure, growth, per_dt};
    const T speed = root(response.modulus * constants.per_mass * at_end.volume);
    viscous = viscous_pressure(options.viscosity, motion, speed, omega_squared, share);
    viscous_work = half * (memory.viscous + viscous.stress) * (ratio - before);  // per volume of the reference
    memory.viscous = viscous.stress;
  }

  const T pull = viscous.stress - memory.state.pressure;
  HourglassDrag<T> drag{zero, zero};
  if (options.hourglass > 0) {
    // by the gradient at the end, which a rigid rotation satisfies as well as that of the middle
    const Matrix<T> L = mean_gradient(D, at_end);
    std::array<Vector<T>, 4> q;
    for (int a = 0; a < 4; ++a) q[a] = D.hourglass[a] - L * X.hourglass[a];
    drag = drag_hourglass(T(options.hourglass), constants.mass, constants.per_length, q, per_dt, memory.hourglass);
    force = forces_of_stress(Matrix<T>{{pull, zero, zero}, {zero, pull, zero}, {zero, zero, pull}}, memory.hourglass, X, at_end);
  } else {
    for (int a = 0; a < 8; ++a) force[a] = -pull * gradient[a];
  }
  memory.state.energy = memory.state.energy + viscous_work + drag.work * constants.per_reference;

  T lifted(zero);
  Vector<T> arm{zero, zero, zero};
  if (Fluid::has_weight(options)) {
    const Weight<T> now = add_weight(x, X, at_end, constants.mass, constants.per_node, gravity_of<T>(options), force);
    lifted = now.energy - memory.weight;
    memory.weight = now.energy, arm = now.arm;
  }
  const Controlled<T> controlled = control_distortion(options.distortion, bulk_modulus_at_start(law), law.density, constants.start,
                                                      constants.per_mass, x, memory.distortion, force);
  const T reference = constants.reference;
  return {.stored = {response.compression * reference, response.cavitation * reference, lifted, controlled.stored},
          .dissipated = {viscous_work * reference, drag.work, response.lost * reference},
          .step = stable_step(omega_squared + controlled.omega_squared, viscous.damping + drag.damping),
          .volume_ratio = at_end.volume * constants.per_length * constants.per_length * constants.per_length,
          .along = viscous.along,
          .arm = {arm.x, arm.y, arm.z}};
}

/// The pressure at the centroid of a hexahedron at the start: it grows with the depth. [Pa]
template <class Law>
double pressure_at_start(const Law& law, const Fluid::Options& options, const std::array<Vector<double>, 8>& X) {
  const Modes<double> modes = scaled(0.125, sums_by_mode(X));
  const Vector<double> g = gravity_of<double>(options);
  Vector<double> mean{0, 0, 0};
  for (const Vector<double>& corner : X) mean = mean + 0.125 * corner;
  const double depth = dot(g, mean) + first_moment(modes, g).value / volume_gradient(modes).volume - options.level;
  return options.pressure + law.density * depth;
}

/// Constants of a hexahedron of fluid in its reference positions, in which it is at the start: its density is that of the law there.
template <class Law>
Fluid::Constants<double> constants(const Law& law, const Fluid::Options& options, const std::array<Vector<double>, 8>& X) {
  const Modes<double> modes = scaled(0.125, sums_by_mode(X));
  const double volume = volume_gradient(modes).volume, mass = law.density * volume;
  const double reference = volume / start_at(law, pressure_at_start(law, options, X)).ratio;
  Fluid::Constants<double> made{.mass = mass, .per_mass = 1 / mass, .reference = reference, .per_reference = 1 / reference,
                                .per_length = 1 / std::cbrt(volume),
                                .start = material::may_be_compressed<Law> ? -1e300 : start_of_control(X), .per_node = {}};
  const std::array<double, 8> share = volume_shares(modes);
  for (std::size_t a = 0; a < 8; ++a) made.per_node[a] = 1 / (law.density * share[a]);
  return made;
}

/// How an element of fluid is at the start.
struct FluidStart {
  double pressure;  ///< [Pa]
  double weight;    ///< [J] of add_weight()
};
template <class Law>
FluidStart start_of(const Law& law, const Fluid::Options& options, const std::array<Vector<double>, 8>& X) {
  const Fluid::Constants<double> made = constants(law, options, X);
  const Modes<double> modes = scaled(0.125, sums_by_mode(X));
  std::array<Vector<double>, 8> force{};
  const Weight<double> weight =
      add_weight(X, modes, volume_gradient(modes), made.mass, made.per_node, gravity_of<double>(options), force);
  return {pressure_at_start(law, options, X), weight.energy};
}

/// What an element remembers at the start.
template <class Law>
Fluid::Memory<double, Law> at_start(const Law& law, const FluidStart& start) {
  Fluid::Memory<double, Law> memory{};
  memory.state = start_at(law, start.pressure), memory.weight = start.weight;
  return memory;
}

}  // namespace nereid::element
