#pragma once
// Readers of what acts on a scene: planes, loads, springs, point masses, initial fields, relaxation, gravity.

#include <variant>

#include "input/expression.hpp"
#include "model/scene.hpp"

namespace nereid::input {

/// All of these sections of a case, into a scene; each is optional. Names of planes, loads, springs and point masses must differ.
///
/// runs  whether time passes; else only planes, springs and point masses count, and the rest is listed as not used
void read_actions(const Section& root, bool runs, model::Scene&);

/// `relaxation: {residual, after, samples}`; nothing if the case has no such section.
std::optional<dynamics::Relaxation> read_relaxation(const Section& root);

/// `stages: [{name, duration, relaxation, off, initial}]`, in the order in which they run; `off` names planes and loads.
std::vector<model::Stage> read_stages(const Section& root);

/// `kind: symmetry | constrained | fixed | floor | rigid | driven`, `name`, `nodes`, `normal`, of a floor `point`, of constrained
/// nodes optionally `velocity: {value, unit}`, of driven ones `velocity` and optionally `angular_velocity` with three values; of a
/// rigid plane `surface`, `point`, `penalty` or `penalty_scale`, `friction`, `tangential_penalty`, `energy_gain_limit`.
std::variant<model::Plane, model::RigidPlane> read_plane(const Section&);

/// The unit of a text's value as a factor to SI; a fault if it has another dimension.
InUnit read_unit(const Section&, Dimension);

/// The dimension of an SI unit such as "kg m/s"; of "1" none.
Dimension dimension_of(const std::string& unit);

}  // namespace nereid::input
