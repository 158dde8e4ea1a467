#pragma once
// Units exist in two places, the reader and the writer; between them everything is SI.

#include <string>
#include <string_view>
#include <variant>

namespace nereid::input {

/// Of what a quantity is made: the powers of kilogram, metre, second, radian and kelvin.
///
/// The radian counts as a base unit, so that `30 deg` is required where an angle is wanted.
struct Dimension {
  int mass = 0, length = 0, time = 0, angle = 0, temperature = 0;

  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
  friend constexpr Dimension operator*(Dimension a, Dimension b) {
    return {a.mass + b.mass, a.length + b.length, a.time + b.time, a.angle + b.angle,
            a.temperature + b.temperature};
  }
  friend constexpr Dimension operator/(Dimension a, Dimension b) {
    return {a.mass - b.mass, a.length - b.length, a.time - b.time, a.angle - b.angle,
            a.temperature - b.temperature};
  }
};

}  // namespace nereid::input

/// The dimensions that readers ask for; others are products and quotients of these.
namespace nereid::dim {

using input::Dimension;

inline constexpr Dimension none{};
inline constexpr Dimension mass{1, 0, 0};                 // [kg]
inline constexpr Dimension length{0, 1, 0};               // [m]
inline constexpr Dimension time{0, 0, 1};                 // [s]
inline constexpr Dimension angle{0, 0, 0, 1};             // [rad]
inline constexpr Dimension temperature{0, 0, 0, 0, 1};    // [K]
inline constexpr Dimension area{0, 2, 0};                 // [m2]
inline constexpr Dimension volume{0, 3, 0};               // [m3]
inline constexpr Dimension speed = length / time;         // [m/s]
inline constexpr Dimension acceleration = speed / time;   // [m/s2]
inline constexpr Dimension frequency = none / time;       // [1/s], strain rates too
inline constexpr Dimension angular_speed = angle / time;  // [rad/s]
inline constexpr Dimension density = mass / volume;       // [kg/m3]
inline constexpr Dimension areal_density = mass / area;   // [kg/m2]
inline constexpr Dimension momentum = mass * speed;       // [kg m/s]
inline constexpr Dimension force = mass * acceleration;   // [N]
inline constexpr Dimension energy = force * length;       // [J]
inline constexpr Dimension power = energy / time;         // [J/s]
inline constexpr Dimension stress = force / area;         // [Pa]
inline constexpr Dimension penalty = stress / length;     // [Pa/m]
inline constexpr Dimension stiffness = force / length;    // [N/m]
inline constexpr Dimension viscosity = stress * time;     // [Pa s]
inline constexpr Dimension curvature = none / length;     // [1/m]
inline constexpr Dimension slowness = time / length;      // [s/m]
inline constexpr Dimension specific_heat = energy / mass / temperature;  // [J/(kg K)]

}  // namespace nereid::dim

namespace nereid::input {

/// A number with its unit, already converted.
struct Quantity {
  double value;         ///< in SI units
  Dimension dimension;  ///< none also for `1 mm/m`, which has a unit all the same
  bool has_unit;        ///< whether a unit was written
};

/// Why a text is not a quantity, and where in it.
struct TextFault {
  int column;  ///< 1-based, in bytes
  int length;  ///< of the part that is wrong, at least 1 except at the end of the text
  std::string message;
};

/// Reads a number and its unit, as in `1.13e-9 kgf*s^2/mm^4`, `8 ms`, `1/s` or `0.3`.
///
/// Between number and unit a blank is optional. A unit is made of symbols with whole powers `^`,
/// of `*`, `/` and parentheses, from left to right: `a/b*c` is `(a/b)*c`. A blank also multiplies,
/// but not behind a `/`, where readers would disagree. Numbers are finite, with a decimal point,
/// without superfluous leading zeros; one that double precision cannot hold is a fault.
///
/// Known symbols: m cm mm um km in ft, s ms us min, kg g t lb, N kN kgf lbf, Pa kPa MPa GPa psi,
/// J kJ, Hz, rad deg, K.
std::variant<Quantity, TextFault> parse_quantity(std::string_view text);

/// The powers of the base units, as in "kg m^-2 s^-2"; "1" for a plain number.
std::string describe(Dimension);

/// The SI unit as people write it, as in "Pa/m"; "1" for a plain number.
///
/// Invariants  parse_quantity reads it back to the same dimension, with factor one.
std::string si_unit(Dimension);

}  // namespace nereid::input
