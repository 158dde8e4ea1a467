#pragma once
// Sections: what the material behind a plane through a body exerts on the material ahead of it.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// Cuts the blocks of a body by a plane in the reference.
///
///     F = sum of f_I,   M = sum of (x_I - point) x f_I + m_I
///
/// over the nodes I ahead, (X_I - point).normal > 0, with f_I and m_I what elements exert on them: stress, hourglass control and viscosity.
/// Elements whose nodes are all ahead add nothing, so that F is what those exert that the plane cuts or that stand on it.
///
/// blocks  places in Model::blocks, of no rigid body
/// returns a section without parts where all nodes are on one side
/// Needs   a model after finalize()
Section make_section(const Model&, const std::string& name, const std::vector<std::size_t>& blocks, const Vec3& point, const Vec3& normal);

/// Takes the forces of the sections from those of the elements, after a step of length dt [s], and adds up their impulses by the
/// trapezoid rule.
void see_sections(const Model&, double dt, State&);

}  // namespace nereid::dynamics
