#pragma once
// Adding an interface to a model: which surfaces, how hard, and where the gaps are at the start.

#include <optional>
#include <string>

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// How an interface is wanted.
struct InterfaceOptions {
  std::optional<double> penalty;   ///< [Pa/m]; without it the code chooses, see hardness
  double hardness = 20;            ///< [-] chosen penalty over the stiffness of the softer side
  double damping = 0;              ///< [-] of an apex on its base, over the critical damping of the stiffest pair
  contact::Weights weights = contact::Weights::consistent;
  contact::Area area = contact::Area::apex;
  contact::ContactHeight height;
  contact::InitialPenetration initial_penetration = contact::InitialPenetration::refuse;
  double created_in_a_bounce = 0.005;  ///< [-] bound on the energy of a single bounce
};

/// An interface joined to a model, with the memory and workspace that its state needs.
struct Connected {
  contact::InitialGaps gaps;
  contact::Memory memory;
  contact::Workspace workspace;
};

/// Stiffness per area with which a body resists pressure on a surface, at its stiffest element.
///
///     hexahedra  (lambda + 2 mu) / (V / A),  A the area of the element on the surface
///     plates     (lambda + 2 mu) / thickness
///
/// returns  [Pa/m]; zero if no element has a face on the surface
double surface_stiffness(const Model&, const mesh::Surface&);

/// Adds an interface between the apexes of one surface and the bases of another.
///
/// The penalty chosen by the code is hardness times the stiffness of the softer side: hard against
/// what it presses on, and refined with the mesh. Symmetry planes of the model must stand already.
///
/// Penetrations are reported in Connected::gaps; where InitialPenetration::refuse is asked for, the
/// caller refuses the scene.
Connected connect(Model&, const std::string& name, const std::string& apex_surface,
                  const std::string& base_surface, const InterfaceOptions&);

}  // namespace nereid::dynamics
