#include "base/check.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/facets.hpp"
#include "mesh/revolution.hpp"

namespace nereid::mesh {
namespace {

Index node_at(const Tube& tube, int around, int along) {
  return around + (2 * tube.cells_core + 1) * along;
}

Vectors positions(const Tube& tube) {
  Vectors X(3, node_at(tube, 0, tube.cells_along + 1));
  for (int along = 0; along <= tube.cells_along; ++along) {
    const double z = height(along, tube.cells_along, tube.length);
    for (int around = 0; around <= 2 * tube.cells_core; ++around) {
      X.col(node_at(tube, around, along)) << tube.radius * direction(around, tube.cells_core), z;
    }
  }
  return X;
}

Table<3> outside(const Tube& tube) {
  Facets facets;
  for (int along = 0; along < tube.cells_along; ++along) {
    for (int around = 0; around < 2 * tube.cells_core; ++around) {
      facets.add({node_at(tube, around, along), node_at(tube, around + 1, along),
                  node_at(tube, around + 1, along + 1), node_at(tube, around, along + 1)},
                 cut_at_cell(around));
    }
  }
  return facets.table();
}

Subset nodes_at_height(const Mesh& mesh, double z) {
  Subset nodes;
  for (Index node = 0; node < mesh.X.cols(); ++node) {
    if (mesh.X(2, node) == z) nodes.push_back(node);  // exact by construction
  }
  return nodes;
}

}  // namespace

Mesh tube(const std::string& name, const Tube& tube) {
  check(tube.radius > 0 && tube.length > 0, "a tube needs radius and length > 0");
  check(tube.cells_core > 0 && tube.cells_along > 0, "a tube needs at least one cell each way");
  Mesh quarter;
  quarter.X = positions(tube);
  quarter.triangles = {{name, outside(tube)}};
  quarter.surfaces = {{name + ".outside", outside(tube)},
                      {name + ".inside", reversed(outside(tube))}};
  Mesh mesh = turned(quarter, tube.turn, name);
  mesh.node_sets.push_back({name + ".bottom", nodes_at_height(mesh, 0)});
  mesh.node_sets.push_back({name + ".top", nodes_at_height(mesh, tube.length)});
  return mesh;
}

}  // namespace nereid::mesh
