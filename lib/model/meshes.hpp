#pragma once
// The meshes of a scene: each body's own, mapped and placed, and all of them as one.

#include "model/fault.hpp"
#include "model/scene.hpp"

namespace nereid::model {

constexpr double most_elements = 1e8;  ///< their memory is some 100 GB, and node numbers still fit an Index

/// Elements that a mesh will have, in floating point because what is asked for may be absurd.
double count_elements(const MeshOptions&);

/// Whether the mesh has hexahedra, or triangles; a mesh from a file may have both.
bool has_solids(const MeshOptions&);
bool has_plates(const MeshOptions&);

/// Builds the mesh of a body; its regions, surfaces and node sets are called `name` and `name.…`.
///
/// Throws InternalError for options that no mesh has, such as a negative radius.
mesh::Mesh make_mesh(const std::string& name, const MeshOptions&);

/// The mesh with its nodes moved to `map` of their places; names and elements stay, and nodes that meet stay two.
///
/// Faults, with the mesh as it was: places that are no number; elements whose volume or area is not positive, which it shows by the names
/// of the origin
mesh::Mesh mapped(const Field& map, mesh::Mesh, const Part&, Faults&, const mesh::Origin& = {});

/// What may be wrong with meshes and is not refused.
struct MeshWarnings {
  std::vector<std::string> texts;          ///< a line each
  std::vector<mesh::Offenders> offenders;  ///< the elements that they are about, by body
};

/// The meshes of all bodies, each where it stands.
///
/// Faults: options that no mesh has, maps that turn elements inside out, positions whose cubes are no number, elements
/// that mesh::judge() refuses, points beside their body, points named like a node set. Bodies without a mesh are left out.
mesh::Mesh make_mesh(const Scene&, Faults&, MeshWarnings&);

/// How far from the origin any node may be: volumes, their squares and what elements make of these are still numbers. [m]
inline constexpr double farthest = 1e30;

/// Length of the diagonal of the box around all nodes. [m]
double diagonal(const mesh::Mesh&);

}  // namespace nereid::model
