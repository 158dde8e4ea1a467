#pragma once
// What cylinder and tube share: where nodes lie around and along, and the way from a quarter to the
// full turn.

#include <string>

#include "mesh/cylinder.hpp"

namespace nereid::mesh {

/// Unit vector at `around` of the 2 * cells_core equal angles of the quarter. Exact on both axes
/// and, bit for bit, symmetric about the diagonal x = y. [-]
Eigen::Vector2d direction(int around, int cells_core);

/// Height of a layer of nodes, exact at both ends. [m]
double height(int along, int cells_along, double length);

/// The mesh and its image in the plane through the origin across `axis` (0: x, 1: y, 2: z). Nodes whose
/// coordinate is exactly zero are shared. Elements and facets of the image are ordered backwards,
/// so that neighbours across the plane keep near numbers.
/// Needs  no node sets yet
Mesh with_image(const Mesh& half, int axis);

/// Renumbers nodes, elements and facets layer by layer along z; within a layer their order stays.
/// Needs  no node sets yet
Mesh in_layers(const Mesh& mesh);

/// Adds the node set of all nodes whose coordinate along `axis` is exactly zero.
void add_plane(Mesh&, const std::string& name, int axis);

/// The quarter as it is, or completed to the full turn, then its node set of all nodes and, for a
/// quarter, the node sets of its two planes.
Mesh turned(const Mesh& quarter, Revolution turn, const std::string& name);

}  // namespace nereid::mesh
