#pragma once
// Which values a scene may have, wherever it comes from: readers of cases and build() go by the same ranges.

#include "base/range.hpp"
#include "model/fault.hpp"
#include "model/scene.hpp"

namespace nereid::model {

/// Ranges of values that are not just positive or not negative.
namespace range {
inline constexpr Range poisson = between(-1, 0.5), share = within(0, 1), hardening_exponent = above(0).up_to(1),
                       thermal_exponent = above(0).up_to(10), hourglass = above(0).up_to(1), drilling = within(0, 1),
                       distortion = within(0, 10), hourglass_of_fluids = within(0, 100), adiabatic = above(1).up_to(10),
                       shock_slope = within(0, 10), cowper_exponent = within(1, 100),
                       linear_viscosity = within(0, 1),
                       quadratic_viscosity = within(0, 10), friction = within(0, 10), tangential_penalty = above(0).up_to(1),
                       damping_ratio = within(0, 1), energy_gain_limit = within(1e-5, 0.04), step_factor = within(0, 0.5),
                       safety = above(0).up_to(10), residual = between(0, 1), restitution = within(0, 1), fallen = above(0).up_to(1),
                       rest_part = between(0, 1);
}  // namespace range

inline constexpr const char* fluids_are_solid_meshes = "a fluid has solid elements: this body has plates";

inline constexpr const char* plates_may_have_other_laws =
    "plates have laws with an update in plane stress: expected elastic, j2_bilinear, j2_curve or johnson_cook";

/// What is wrong with the points of a hardening curve, or nothing.
std::string wrong_with(const material::MeasuredCurve&);

// Bounds on what one run writes and computes.
inline constexpr double most_rows = 1e7, most_frames = 1e6;

/// Why an interval of rows or frames is refused; empty if it is not.
///
/// key         as in "frames_every"
/// every, end  [s]
std::string too_many(const std::string& key, double every, double end);

/// Why an interval of frames is refused that is shorter than that of the rows at which they are written; empty if it is not.
///
/// frames, rows  [s]; 0: by default
std::string frames_between_rows(double frames, double rows);

/// The interval of rows by default: 400 to the end, but none longer than that of frames. [s]
double usual_rows(double frames, double end);

/// Why a window over which a condition to stop takes a mean is refused. [s]
std::string window_too_short(double window, double row);

/// Faults of one part: `before` stands in front of the keys.
void check_relaxation(const Part&, const std::string& before, const dynamics::Relaxation&, Faults&);
void check_duration(const Part&, double duration, Faults&);

/// Faults: values that are no finite number or out of their range, directions that are no unit vectors, functions that are
/// empty, laws that plates may not have, planes on no nodes.
void check_values(const Scene&, Faults&);

}  // namespace nereid::model
