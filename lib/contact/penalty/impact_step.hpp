#pragma once
// How much energy one bounce on a sampled on/off spring creates.

namespace nereid::contact {

/// Largest energy that central differences create in one bounce of a mass on a unilateral spring,
/// over the kinetic energy of the impact, for all phases of the first sampled penetration.
///
/// Also the linearly stable steps below 2 create energy, because the spring is switched on and off
/// at samples and not at the instant of touch: docs/theory/contact_energy.md.
///
/// step     [-] dt sqrt(k/m)
/// returns  [-] (rebound speed / impact speed)^2 - 1, not negative
double energy_created_in_a_bounce(double step);

/// The most that a bounce creates at any step up to this one:  step^2 / (4 - step^2). [-]
///
/// step  [-] dt sqrt(k/m), below 2
double most_created_in_a_bounce(double step);

/// The largest step such that neither it nor any smaller step creates more than `bound`.
/// [-] dt sqrt(k/m)
///
/// What a bounce creates swings with the step, between nothing and  step^2 / (4 - step^2);  this
/// inverts the upper end, so that a step cut short by another limit is safe too.
///
/// Needs  0 < bound < 1; the step is capped at 0.5, where a bounce creates 4.5 %
double impact_step_factor_for(double bound);

}  // namespace nereid::contact
