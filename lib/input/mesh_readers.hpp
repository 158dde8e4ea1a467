#pragma once
// Readers of meshes: what a body is made of, read first and built only when the whole case is sound.

#include "input/expression.hpp"
#include "model/scene.hpp"

namespace nereid::input {

/// Reads a body's `mesh` section, `kind: box | cylinder | tube | sector | revolved | sphere | disc |
/// sheet | file` and the keys of that kind: docs/meshes.md.
///
/// More than a hundred million elements are a fault, as are corners in the wrong order. A file is read at once, so
/// that what is wrong with it is told with all else.
///
/// origin  of a mesh from a file
model::MeshOptions read_mesh_options(const Section& mesh, mesh::Origin* origin = nullptr);

/// `scale` of a body's `mesh` section: the length that a coordinate of 1 becomes; 1 m if there is none. [m]
double read_scale(const Section& mesh);

/// `map` of a body's `mesh` section: three texts over x, y, z; empty if there is none.
model::Field read_map(const Section& mesh);

}  // namespace nereid::input
