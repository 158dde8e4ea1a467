#pragma once
// Adding an interface to a model: which surfaces, how hard, and where the gaps are at the start.

#include <optional>
#include <string>

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// How an interface is wanted.
struct InterfaceOptions {
  contact::InterfaceKind kind = contact::InterfaceKind::contact;
  contact::Method method = contact::Method::multiplier;  ///< of ties too, which then have one pass
  double restitution = 1;     ///< [-] of nodes that multipliers stop
  std::optional<double> penalty = {};  ///< [Pa/m] without it `penalty_scale` counts
  double penalty_scale = 20;  ///< [-] chosen penalty over the stiffness of the softer side
  contact::Coulomb friction = {};
  bool edges = true;         ///< of both surfaces touch each other too, by multipliers
  /// Of points: in two passes, of which the second guards; with plates, and between rigid bodies, nodes in one pass
  contact::Heights heights = contact::Heights::nodes;
  bool slides = false;       ///< of ties by multipliers: they hold along the normal alone
  bool two_passes = false;   ///< each surface has apexes over the other, with half the penalty each
  double damping_ratio = 0;  ///< [-] of an apex on its base, over the critical damping of the stiffest pair
  contact::Weights weights = contact::Weights::consistent;
  contact::Area area = contact::Area::apex;
  contact::ContactHeight height = {};
  contact::InitialPenetration initial_penetration = contact::InitialPenetration::refuse;
  /// [-] part of its energy that one bounce may gain; with a `step_factor`, all bounces together before the step is lowered
  double energy_gain_limit = 0.005;
  double step_factor = 0;  ///< [-] dt omega until then; 0: from the start no bounce creates more than the limit
};

/// A contact joined to a model, with the memory that its state needs.
struct Connected {
  contact::InitialGaps gaps;
  contact::AnyMemory memory;
};

/// Stiffness per area with which a body resists pressure on a surface, at its stiffest element.
///
///     hexahedra  (lambda + 2 mu) / (V / A),  A the area of one face: an edge element of a skin counts once for each side
///     plates     (lambda + 2 mu) / thickness
///
/// returns  [Pa/m]; zero if no element has a face on the surface
double surface_stiffness(const Model&, const mesh::Surface&);

/// Impedance of a wave that goes into a body across a surface, at its stiffest element: rho c = sqrt(rho (lambda + 2 mu)).
///
/// returns  [Pa s/m]; infinite for plates, whose thickness moves as one, and rigid bodies; zero if no element has a face on the surface
double surface_impedance(const Model&, const mesh::Surface&);

/// Depth along the normal of the flattest element behind a face of a surface: of hexahedra V/A, of plates the thickness.
///
/// returns  [m]; zero if no element has a face on the surface
double surface_depth(const Model&, const mesh::Surface&);

/// Adds an interface between the apexes of one surface and the bases of another.
///
/// A penalty that is not given is `penalty_scale` times the stiffness of the softer side: refined with the mesh.
///
/// Needs    a model after finalize(), with its symmetry planes
/// returns  one interface, or two passes: `name`, and `name`_back with the sides exchanged; then `name`_edges, where both surfaces have
///          ridges or rims
/// Penetrations are reported in Connected::gaps; where InitialPenetration::refuse is asked for, the
/// caller refuses the scene.
///
/// start    [m] positions at the start, where they are not the reference: gaps, overlaps and heights are those there
std::vector<Connected> connect(Model&, const std::string& name, const std::string& apex_surface,
                               const std::string& base_surface, const InterfaceOptions&, const Vectors* start = nullptr);

}  // namespace nereid::dynamics
