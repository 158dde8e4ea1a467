#pragma once
// Bodies that overlap by known amounts, for the tests of this folder.

#include <gtest/gtest.h>

#include "audit/audit.hpp"
#include "mesh/box.hpp"
#include "mesh/disc.hpp"
#include "mesh/placement.hpp"

namespace nereid::audit {

/// A box with its middle at the origin.
inline mesh::Mesh block(const std::string& name, const Vec3& sides, const Eigen::Vector3i& cells) {
  return mesh::box(name, {-0.5 * sides, 0.5 * sides, cells});
}

/// A sheet with its middle at the origin, normal to z.
inline mesh::Mesh plate(const std::string& name, double x, double y, int cells_x, int cells_y) {
  return mesh::moved(mesh::sheet(name, {x, y, cells_x, cells_y}), Vec3(-x / 2, -y / 2, 0));
}

/// All of a mesh rotated, scaled and moved as one.
inline mesh::Mesh placed_anywhere(mesh::Mesh mesh, const Vec3& axis, double angle, double scale, const Vec3& move) {
  mesh = mesh::rotated_about(std::move(mesh), axis, angle, Vec3::Zero());
  mesh.X *= scale;
  return mesh::moved(std::move(mesh), move);
}

inline Workspace workspace_of(const mesh::Mesh& mesh, double thickness = 0.01, const std::vector<Symmetry>& planes = {}) {
  return make_workspace(surfaces(mesh, std::vector<double>(mesh.triangles.size(), thickness), planes));
}

/// What a first look finds of two surfaces.
inline Found found(Workspace& work, const Vectors& x, Index one = 0, Index other = 1) {
  place(x, work);
  return one == other ? overlap_with_itself(work, one) : overlap(work, one, other);
}

inline Found found(const mesh::Mesh& mesh, Index one = 0, Index other = 1, double thickness = 0.01) {
  Workspace work = workspace_of(mesh, thickness);
  return found(work, mesh.X, one, other);
}

}  // namespace nereid::audit
