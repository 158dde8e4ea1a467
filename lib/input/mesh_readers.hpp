#pragma once
// Readers of meshes: what a body is made of, read first and built only when the whole case is sound.

#include <optional>
#include <string>
#include <variant>

#include "input/expression.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/disc.hpp"
#include "mesh/sphere.hpp"
#include "mesh/wedge.hpp"

namespace nereid::input {

/// What a body's mesh is made from: the options of one generator, or a mesh from a file, its names yet without the body's.
using MeshOptions = std::variant<mesh::Box, mesh::Cylinder, mesh::Tube, mesh::Wedge, mesh::WedgeTube, mesh::Sphere,
                                 mesh::Disc, mesh::WedgeDisc, mesh::Sheet, mesh::Mesh>;

/// Reads a body's `mesh` section, `kind: box | cylinder | tube | sector | sphere | disc | sheet |
/// file` and the keys of that kind: docs/meshes.md.
///
/// More than a hundred million elements are a fault, as are corners in the wrong order. A file is read at once, so
/// that what is wrong with it is told with all else.
MeshOptions read_mesh_options(const Section& mesh);

/// Builds the mesh of a body; its regions, surfaces and node sets are called `name` and `name.…`.
///
/// Needs  options of a sound case, so call it after finish() of the case file
mesh::Mesh make_mesh(const std::string& name, const MeshOptions&);

/// Where the nodes of a mesh go, x' = f(x): its position [m] over x, y, z [m] of the mesh as it is built.
struct MeshMap {
  Section at;  ///< the `mesh` section
  std::array<Expression, 3> to;
};

/// `map` of a body's `mesh` section: three texts over x, y, z; nothing if there is none.
std::optional<MeshMap> read_map(const Section& mesh);

/// The mesh with its nodes moved; names and elements stay, and nodes that meet stay two.
///
/// Faults, with the mesh as it was: places that are no number, elements whose volume or area is not positive
mesh::Mesh mapped(const MeshMap&, mesh::Mesh);

}  // namespace nereid::input
