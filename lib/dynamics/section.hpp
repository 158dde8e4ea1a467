#pragma once
// Sections: what the material behind a plane or within a cylinder through a body exerts on the material ahead of it or outside.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// Where a section cuts a body in the reference: a plane, or a cylinder about an axis.
struct Cut {
  Vec3 point = Vec3::Zero();    ///< [m] moments are about it
  Vec3 normal = Vec3::UnitX();  ///< across the plane, or along the axis
  double radius = 0;            ///< [m] of the cylinder; 0: a plane
};

/// Cuts the blocks of a body.
///
///     F = sum of f_I,   M = sum of (x_I - point) x f_I + m_I
///
/// over the nodes I ahead, (X_I - point).normal > 0, or outside of the cylinder, with f_I and m_I what elements exert on them: stress,
/// hourglass control and viscosity. Elements whose nodes are all ahead add nothing, so that F is what those exert that the section cuts or
/// that stand on it.
///
/// blocks  places in Model::blocks, of no rigid body
/// returns a section without parts where all nodes are on one side
/// Needs   a model after finalize()
Section make_section(const Model&, const std::string& name, const std::vector<std::size_t>& blocks, const Cut&);

/// Takes the forces of the sections from those of the elements, after a step of length dt [s], and adds up their impulses by the
/// trapezoid rule.
void update_sections(const Model&, double dt, State&);

}  // namespace nereid::dynamics
