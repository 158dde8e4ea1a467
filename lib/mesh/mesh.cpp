#include "mesh/mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "base/check.hpp"
#include "mesh/adjacency.hpp"

namespace nereid::mesh {
namespace {

/// A surface without the second side of sheets that have both.
Surface one_side(const Surface& surface) {
  const std::vector<Index> other = other_sides(surface.facets);
  Surface one = surface;
  Index kept = 0;
  for (Index f = 0; f < surface.facets.cols(); ++f)
    if (other[static_cast<std::size_t>(f)] < 0 || f < other[static_cast<std::size_t>(f)]) one.facets.col(kept++) = surface.facets.col(f);
  one.facets.conservativeResize(3, kept);
  return one;
}

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

namespace {

/// Corners of a hexahedron's six faces, in the order of VTK.
constexpr int face_corners[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 4, 7, 3}, {1, 2, 6, 5}};

/// A number for the hexahedron and face that a facet lies in, or -1: the first that has all its nodes.
///
/// elements_of  those of each node from `first` on
std::int64_t face_of(const Mesh& mesh, const std::vector<std::vector<std::int64_t>>& elements_of, Index first,
                     const Eigen::Matrix<Index, 3, 1>& facet) {
  for (const std::int64_t at : elements_of[static_cast<std::size_t>(facet(0) - first)]) {
    const auto region = static_cast<std::size_t>(at >> 32);
    const auto corners = mesh.hexahedra[region].nodes.col(static_cast<Eigen::Index>(at & 0xffffffff));
    for (int f = 0; f < 6; ++f) {
      const auto has = [&](Index node) {
        return std::any_of(face_corners[f], face_corners[f] + 4, [&](int a) { return corners(a) == node; });
      };
      if (has(facet(0)) && has(facet(1)) && has(facet(2))) return 6 * at + f;
    }
  }
  return -1;
}

}  // namespace

Table<4> faces(const Mesh& mesh, const Surface& surface) {
  if (surface.facets.cols() == 0) return Table<4>(4, 0);
  const Index first_node = surface.facets.minCoeff(), last_node = surface.facets.maxCoeff();  // of one body, of many
  std::vector<std::vector<std::int64_t>> elements_of(static_cast<std::size_t>(last_node - first_node) + 1);
  for (std::size_t region = 0; region < mesh.hexahedra.size(); ++region) {
    const auto& nodes = mesh.hexahedra[region].nodes;
    if (nodes.cols() == 0 || nodes.minCoeff() > last_node || nodes.maxCoeff() < first_node) continue;
    for (Index element = 0; element < nodes.cols(); ++element)
      for (const Index node : nodes.col(element))
        if (node >= first_node && node <= last_node)
          elements_of[static_cast<std::size_t>(node - first_node)].push_back(static_cast<std::int64_t>(region) << 32 | element);
  }
  std::vector<Eigen::Matrix<Index, 4, 1>> all;
  std::map<std::int64_t, std::size_t> half;  // faces of which one facet has been seen
  for (Index f = 0; f < surface.facets.cols(); ++f) {
    const Eigen::Matrix<Index, 3, 1> facet = surface.facets.col(f);
    const std::int64_t face = face_of(mesh, elements_of, first_node, facet);
    const auto other = face < 0 ? half.end() : half.find(face);
    if (other == half.end()) {
      if (face >= 0) half[face] = all.size();
      all.push_back({facet(0), facet(1), facet(2), -1});
      continue;
    }
    Eigen::Matrix<Index, 4, 1>& first = all[other->second];
    const auto in_facet = [&](Index node) { return (facet.array() == node).any(); };
    Index fourth = -1;
    for (const Index node : facet)
      if ((first.head<3>().array() != node).all()) fourth = node;
    // it goes between the two nodes of the cut
    if (in_facet(first(0)) && in_facet(first(1))) first = {first(0), fourth, first(1), first(2)};
    else if (in_facet(first(1)) && in_facet(first(2))) first = {first(0), first(1), fourth, first(2)};
    else first(3) = fourth;
    half.erase(other);
  }
  return Eigen::Map<const Table<4>>(all.empty() ? nullptr : all[0].data(), 4, static_cast<Eigen::Index>(all.size()));
}

namespace {

/// Calls give(corner, area) with what a face gives to the tributary area of each of its nodes.
template <class Give>
void share_out(const Vectors& X, const Eigen::Matrix<Index, 4, 1>& face, Give&& give) {
  const int corners = face(3) < 0 ? 3 : 4;
  double at_corner[4], sum = 0;  // areas of the triangles at the corners
  for (int a = 0; a < corners; ++a) {
    const Vec3 here = X.col(face(a)), to_next = X.col(face((a + 1) % corners)) - here;
    const Vec3 to_last = X.col(face((a + corners - 1) % corners)) - here;
    sum += at_corner[a] = to_next.cross(to_last).norm() / 2;
  }
  for (int a = 0; a < corners; ++a) give(a, corners == 3 ? at_corner[0] / 3 : (sum / 2 + at_corner[a]) / 6);
}

}  // namespace

Scalars tributary_areas(const Mesh& mesh, const Surface& surface, const Subset& nodes) {
  const Table<4> all = faces(mesh, one_side(surface));
  Scalars at_node = Scalars::Zero(mesh.X.cols());
  for (Index f = 0; f < all.cols(); ++f) share_out(mesh.X, all.col(f), [&](int a, double area) { at_node(all(a, f)) += area; });
  Scalars wanted(nodes.size());
  std::transform(nodes.begin(), nodes.end(), wanted.begin(),
                 [&](Index node) { return at_node(node); });
  return wanted;
}

FacesAround faces_around(const Mesh& mesh, const Surface& surface, const Subset& nodes) {
  FacesAround around{.faces = faces(mesh, surface), .shares = {}, .begin = {0}};
  std::vector<std::vector<FacesAround::Share>> at_node(static_cast<std::size_t>(mesh.X.cols()));
  for (Index f = 0; f < around.faces.cols(); ++f)
    share_out(mesh.X, around.faces.col(f), [&](int a, double area) { at_node[around.faces(a, f)].push_back({f, area}); });
  for (const Index node : nodes) {
    around.shares.insert(around.shares.end(), at_node[node].begin(), at_node[node].end());
    around.begin.push_back(static_cast<Index>(around.shares.size()));
  }
  return around;
}

namespace {

/// Calls visit(area, cosine) for the faces around a node: what each gives, and the cosine between its normal and a direction.
template <class Visit>
void faces_against(const FacesAround& around, const Vectors& x, Index place, const Vec3& direction, Visit&& visit) {
  const double length = direction.norm();
  for (Index s = around.begin[place]; s < around.begin[place + 1]; ++s) {
    const FacesAround::Share& share = around.shares[s];
    const Index face = share.face;
    const auto corner = [&](int a) { return Vec3(x.col(around.faces(a, face))); };
    const bool triangle = around.faces(3, face) < 0;
    // twice the area and along the normal: of a quadrilateral by its diagonals
    const Vec3 across = triangle ? Vec3(corner(0) - corner(1)) : Vec3(corner(3) - corner(1));
    const Vec3 normal = (corner(2) - corner(0)).cross(across);
    const double size = normal.norm() * length;
    visit(share.area, size > 0 ? normal.dot(direction) / size : -1);
  }
}

}  // namespace

double tributary_area_facing(const FacesAround& around, const Vectors& x, Index place, const Vec3& direction) {
  double sum = 0;
  faces_against(around, x, place, direction, [&sum](double area, double cosine) { sum += area * std::max(0.0, -cosine); });
  return sum;
}

double tributary_area_against(const FacesAround& around, const Vectors& x, Index place, const Vec3& direction) {
  double sum = 0;
  faces_against(around, x, place, direction, [&sum](double area, double cosine) { sum += cosine < -0.5 ? area : 0; });
  return sum;
}

double tributary_area_loaded(const FacesAround& around, const Vectors& x, Index place, const Vec3& direction, double whole,
                             double least) {
  if (around.begin.empty()) return whole;
  const double facing = tributary_area_against(around, x, place, direction);
  return facing > least * whole ? facing : whole;
}

}  // namespace nereid::mesh
