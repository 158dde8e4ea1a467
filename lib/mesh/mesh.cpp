#include "mesh/mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "base/check.hpp"

namespace nereid::mesh {
namespace {

template <class Named>
const Named& find(const std::vector<Named>& all, std::string_view name, const char* kind) {
  for (const Named& one : all) {
    if (one.name == name) return one;
  }
  throw InternalError("the mesh has no " + std::string(kind) + " '" + std::string(name) + "'");
}

template <int rows>
Table<rows> offset(const Table<rows>& nodes, Index first) {
  return (nodes.array() + first).matrix();
}

Subset offset(Subset nodes, Index first) {
  for (Index& node : nodes) node += first;
  return nodes;
}

template <class Named>
void insert_names(const std::vector<Named>& all, std::set<std::string_view>& names) {
  for (const Named& one : all) {
    if (!names.insert(one.name).second) {
      throw InternalError("the name '" + one.name + "' is given twice in one mesh");
    }
  }
}

/// Regions of both kinds share their names; surfaces and node sets have names of their own.
void check_names(const Mesh& mesh) {
  std::set<std::string_view> regions, surfaces, node_sets;
  insert_names(mesh.hexahedra, regions);
  insert_names(mesh.triangles, regions);
  insert_names(mesh.surfaces, surfaces);
  insert_names(mesh.node_sets, node_sets);
}

}  // namespace

const Hexahedra& hexahedra(const Mesh& mesh, std::string_view name) {
  return find(mesh.hexahedra, name, "hexahedra");
}

const Triangles& triangles(const Mesh& mesh, std::string_view name) {
  return find(mesh.triangles, name, "triangles");
}

const Surface& surface(const Mesh& mesh, std::string_view name) {
  return find(mesh.surfaces, name, "surface");
}

const Subset& node_set(const Mesh& mesh, std::string_view name) {
  return find(mesh.node_sets, name, "node set").nodes;
}

Mesh join(const Mesh& a, const Mesh& b) {
  const Index first = static_cast<Index>(a.X.cols());
  Mesh both = a;
  both.X.resize(3, a.X.cols() + b.X.cols());
  both.X << a.X, b.X;
  for (const auto& [name, nodes] : b.hexahedra)
    both.hexahedra.push_back({name, offset(nodes, first)});
  for (const auto& [name, nodes] : b.triangles)
    both.triangles.push_back({name, offset(nodes, first)});
  for (const auto& [name, facets] : b.surfaces)
    both.surfaces.push_back({name, offset(facets, first)});
  for (const auto& [name, nodes] : b.node_sets)
    both.node_sets.push_back({name, offset(nodes, first)});
  check_names(both);
  return both;
}

Subset surface_nodes(const Surface& surface) {
  Subset nodes(surface.facets.data(), surface.facets.data() + surface.facets.size());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Scalars facet_areas(const Mesh& mesh, const Surface& surface) {
  Scalars areas(surface.facets.cols());
  for (Index facet = 0; facet < areas.size(); ++facet) {
    const Vec3 first = mesh.X.col(surface.facets(0, facet));
    const Vec3 to_second = mesh.X.col(surface.facets(1, facet)) - first;
    const Vec3 to_third = mesh.X.col(surface.facets(2, facet)) - first;
    areas(facet) = to_second.cross(to_third).norm() / 2;
  }
  return areas;
}

Scalars tributary_areas(const Mesh& mesh, const Surface& surface, const Subset& nodes) {
  const Scalars areas = facet_areas(mesh, surface);
  Scalars at_node = Scalars::Zero(mesh.X.cols());
  for (Index facet = 0; facet < areas.size(); ++facet) {
    for (const Index node : surface.facets.col(facet)) at_node(node) += areas(facet) / 3;
  }
  Scalars wanted(nodes.size());
  std::transform(nodes.begin(), nodes.end(), wanted.begin(),
                 [&](Index node) { return at_node(node); });
  return wanted;
}

}  // namespace nereid::mesh
