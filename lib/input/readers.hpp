#pragma once
// Readers of what every scene has: materials, element options, interfaces, floors, time, output.
//
// One syntax for all drivers; a driver composes these and reads only what is its own.

#include "input/section.hpp"
#include "model/scene.hpp"

namespace nereid::input {

/// `kind: elastic | neo_hookean | j2_bilinear | johnson_cook`, `density`, `young`, `poisson`, and the constants of the kind.
///
/// j2_bilinear   `yield` and `tangent`, the slope of the uniaxial stress-strain curve beyond the yield stress, below young; optionally
///               `hardening: isotropic | kinematic | mixed`, where `mixed` needs `isotropic_share`, 0 (kinematic) to 1 (isotropic)
/// johnson_cook  the keys of docs/input.md
element::AnyLaw read_law(const Section&);
/// The same for plates: a law that they may not have is a fault that names those they may.
element::AnyLaw read_plate_law(const Section&);
/// The same for a body that may be a fluid: `kind` may also be
///
/// linear_fluid   `density`, `bulk_modulus` or `sound_speed`, optional `cutoff`, the lowest pressure
/// mie_gruneisen  `density`, `sound_speed`, `slope`, `gamma`, optional `cutoff`
/// ideal_gas      `density`, `gamma`; its pressure is that of the body at the start
element::AnyLaw read_solid_or_fluid_law(const Section&);

/// Optional `viscosity: {linear, quadratic}` of a body.
element::Viscosity read_viscosity(const Section&);

/// Optional `distortion` of hexahedra, in [0, 10].
element::Distortion read_distortion(const Section&);

/// Optional `hourglass_kind: assumed_strain | stiffness | viscous`, its coefficient `hourglass` in (0, 1], `distortion` and the viscosity.
element::Hexahedron::Options read_one_point_options(const Section&);

/// Optional `kind: one_point | full`; options of the former as above, of the latter `distortion` and the viscosity.
///
/// kind_key  a driver may call the kind by the name of the body
element::AnyHexahedronOptions read_hexahedron_options(const Section&, std::string_view kind_key = "kind");

/// Optional `hourglass` of fluids, not negative, `distortion` and the viscosity.
element::Fluid::Options read_fluid_options(const Section&);

/// `thickness`, optional `layers` (1 to 9), `rotary_inertia: scaled | physical`, `thinning: by_law | constant |
/// follows_strain`, `drilling`, and the viscosity.
element::Plate::Options read_plate_options(const Section&);

/// `kind: contact | tied`, `method: multiplier | penalty`, `passes: one | two`; of a contact also `friction`, and by multipliers
/// `restitution`. By a penalty `penalty` or `penalty_scale`, `area: apex | base`; and of a contact `tangential_penalty`,
/// `weights: consistent | paper`, `damping_ratio`, `energy_gain_limit`. All optional. For solid bodies, which touch at h = 0.
dynamics::InterfaceOptions read_solid_interface(const Section&);
/// The same without `kind`, which says whether it is tied.
dynamics::InterfaceOptions read_solid_interface(const Section&, bool tied);

/// Of an automatic contact: `method`, `restitution`, `penalty`, `penalty_scale`, `edges`, `friction` with its keys, `energy_gain_limit`,
/// `step_factor` and `initial_penetration`, all optional.
dynamics::InterfaceOptions read_automatic_interface(const Section&);

/// The same keys as far as a rigid plane has them: `method`, `restitution`, `penalty`, `penalty_scale`, `friction`, `tangential_penalty`,
/// `energy_gain_limit`.
void read_rigid_contact(const Section&, model::RigidPlane&);

/// The same, and for plates, whose mid-surface stands off:
/// `contact_height: initial | given`, `clearance` (with initial), `height` (with given),
/// `initial_penetration: refuse | accept`. All optional but `height`.
dynamics::InterfaceOptions read_interface(const Section&);

/// Where the height comes from at which an interface touches.
enum class HeightFrom {
  initial,    ///< where the apexes start, less a clearance
  given,
  thickness,  ///< half of that of the plates on each side; the caller knows it
};

/// `contact_height: initial | given`, `clearance` (with initial), `height` (with given), `initial_penetration:
/// refuse | accept`, all optional but `height`. Where thickness is the usual one, `thickness` is a word too.
HeightFrom read_contact_height(const Section&, HeightFrom usual, dynamics::InterfaceOptions&);

/// `end`, and optional `safety` in (0, 10], `created_limit`, `overlap_limit` and `corner_limit`.
dynamics::Time read_time(const Section&, bool has_end = true);

/// `history_every`, `frames_every`, `precision: single | double`; all optional, by default 400 rows
/// over the time to `end` and frames as model::usual_frames() has them. A frame is written with a row, so rows are no farther apart.
model::Recording read_recording(const Section&, double end);

/// Three quantities as a vector.
Vec3 read_vector(const Section&, std::string_view key, Dimension);

/// Three numbers of any length but zero as a unit vector.
Vec3 read_direction(const Section&, std::string_view key);

}  // namespace nereid::input
