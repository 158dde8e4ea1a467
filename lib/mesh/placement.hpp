#pragma once
// Putting a mesh where it is wanted: generators build about the origin.

#include "mesh/mesh.hpp"

namespace nereid::mesh {

/// The mesh turned by `angle` [rad] about the line through `about` [m] along `axis`, by the right-hand rule.
///
///     X' = about + R (X - about),   R = cos I + sin [n]x + (1 - cos) n n^T,   n = axis / |axis|
///
/// Turns by whole quarters about x, y or z are exact to the last bit where `about` is the origin.
/// axis  any length but zero, else InternalError
Mesh rotated_about(Mesh, const Vec3& axis, double angle, const Vec3& about);

/// The mesh with all its nodes moved by the same displacement. [m]
Mesh moved(Mesh, const Vec3& by);

}  // namespace nereid::mesh
