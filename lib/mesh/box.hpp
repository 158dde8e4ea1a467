#pragma once
#include <string>

#include "mesh/mesh.hpp"

namespace nereid::mesh {

struct Box {
  Vec3 low, high;         ///< [m] opposite corners, low < high in each component
  Eigen::Vector3i cells;  ///< along x, y, z
};

/// A block of hexahedra, region `name`. Node sets and surfaces `name.x_low`, `name.x_high`,
/// `name.y_low`, ..., `name.z_high`, normals outwards, and the node set `name` of all nodes. Nodes
/// and elements are numbered along x, then y, then z. All facets of a face are cut the same way.
Mesh box(const std::string& name, const Box&);

}  // namespace nereid::mesh
