#pragma once
#include <string>

#include "mesh/mesh.hpp"

namespace nereid::mesh {

/// How much of a sphere is meshed: `half` is z >= 0, `quarter` x >= 0 and y >= 0, `eighth` all three. The others
/// are the eighth and its mirror images, node for node.
enum class SpherePart { full, half, quarter, eighth };

/// A solid sphere about the origin.
struct Sphere {
  double radius;  ///< [m]
  SpherePart part;
  int cells_core;  ///< along each edge of the eighth's core; 2 * cells_core along a quarter of a great circle
  int cells_ring;  ///< radially from the core to the surface
};

/// A core like a cube with rounded faces within shells over its faces (a cubed sphere): hexahedra, region `name`.
/// Surface and node set `name.surface`, normals outwards; node sets `name` (all) and those of the planes that cut
/// the part off, exactly on them: `name.x_plane` (nodes with x = 0), `name.y_plane`, `name.z_plane`.
///
/// Directions of the nodes on the surface are at equal angles along each face of the cube. Facets are cut so that six
/// meet at each node of the surface but those on the axes, where eight do, and midway between them, where four do.
///
/// Invariants  scaled Jacobian of each element > 0.70 and edges within a factor of 2.2 for cells_core = cells_ring up
///             to 6; nodes lie on the sphere and edges between them are chords, so the volume is a little small.
Mesh sphere(const std::string& name, const Sphere&);

}  // namespace nereid::mesh
