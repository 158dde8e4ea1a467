#include "mesh/box.hpp"

#include "base/check.hpp"
#include "mesh/facets.hpp"

namespace nereid::mesh {
namespace {

using Cell = Eigen::Vector3i;  // counted along x, y, z

Index node_at(const Box& box, const Cell& at) {
  return at.x() + (box.cells.x() + 1) * (at.y() + (box.cells.y() + 1) * at.z());
}

Vectors positions(const Box& box) {
  Vectors X(3, (box.cells.array() + 1).prod());
  Cell at;
  for (at.z() = 0; at.z() <= box.cells.z(); ++at.z()) {
    for (at.y() = 0; at.y() <= box.cells.y(); ++at.y()) {
      for (at.x() = 0; at.x() <= box.cells.x(); ++at.x()) {
        const Eigen::Array3d fraction =
            at.cast<double>().array() / box.cells.cast<double>().array();
        // In this form both ends are met exactly.
        X.col(node_at(box, at)) = (1 - fraction) * box.low.array() + fraction * box.high.array();
      }
    }
  }
  return X;
}

Table<8> elements(const Box& box) {
  const std::array<Cell, 8> corners{Cell(0, 0, 0), Cell(1, 0, 0), Cell(1, 1, 0), Cell(0, 1, 0),
                                    Cell(0, 0, 1), Cell(1, 0, 1), Cell(1, 1, 1), Cell(0, 1, 1)};
  Table<8> nodes(8, box.cells.prod());
  Index element = 0;
  Cell at;
  for (at.z() = 0; at.z() < box.cells.z(); ++at.z()) {
    for (at.y() = 0; at.y() < box.cells.y(); ++at.y()) {
      for (at.x() = 0; at.x() < box.cells.x(); ++at.x()) {
        for (int a = 0; a < 8; ++a) nodes(a, element) = node_at(box, at + corners[a]);
        ++element;
      }
    }
  }
  return nodes;
}

/// The face across `axis`, normals along +axis; the other two axes follow in cyclic order.
Table<3> face(const Box& box, int axis, int level) {
  const int right = (axis + 1) % 3, up = (axis + 2) % 3;
  const Cell step_right = Cell::Unit(right), step_up = Cell::Unit(up);
  Facets facets;
  Cell at = level * Cell::Unit(axis);
  for (at(up) = 0; at(up) < box.cells(up); ++at(up)) {
    for (at(right) = 0; at(right) < box.cells(right); ++at(right)) {
      facets.add({node_at(box, at), node_at(box, at + step_right),
                  node_at(box, at + step_right + step_up), node_at(box, at + step_up)},
                 Cut::first_to_third);
    }
  }
  return facets.table();
}

}  // namespace

Mesh box(const std::string& name, const Box& box) {
  check((box.cells.array() > 0).all(), "a box needs at least one cell along each axis");
  check((box.low.array() < box.high.array()).all(), "a box needs low < high along each axis");
  Mesh mesh;
  mesh.X = positions(box);
  mesh.hexahedra = {{name, elements(box)}};
  for (int axis = 0; axis < 3; ++axis) {
    const std::string plane = name + "." + "xyz"[axis];
    mesh.surfaces.push_back({plane + "_low", reversed(face(box, axis, 0))});
    mesh.surfaces.push_back({plane + "_high", face(box, axis, box.cells(axis))});
  }
  add_set_of_all(mesh, name);
  add_surface_node_sets(mesh);
  return mesh;
}

}  // namespace nereid::mesh
