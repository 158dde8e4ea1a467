#pragma once
// How coarse the surface of the apexes is beside its base: nodes of a finer base are not held between the apexes.

#include "contact/data/initial_gaps.hpp"
#include "contact/data/workspace.hpp"

namespace nereid::contact {

/// The median over the apexes, by area, that face the base and come into touch first: no more than the side of a face higher above it than
/// the nearest.
///
///     T = mean of  g1 g1^T + g2 g2^T  over the faces at a node,   g between the middles of opposite sides;  of a triangle  2 A (1 - n n^T)
///     apexes^2 = largest eigenvalue of  T_base^-1 T_apexes  in the plane of the base
///
/// base_faces  around interface.base_nodes;  reach  [m] apexes farther away have no base
/// Needs       an interface after connect()
Coarseness coarseness(const Interface&, const mesh::FacesAround& base_faces, const Vectors& x, double reach, Workspace&);

}  // namespace nereid::contact
