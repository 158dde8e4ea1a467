#include "contact/surface/edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <vector>

#include "mesh/skin.hpp"

namespace nereid::contact {

namespace {

constexpr double ridge = 0.94;  // cosine of 20 degrees

using Ends = std::array<Index, 2>;

Ends sorted(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// The sides of faces around an edge.
struct Around {
  int faces = 0;
  Ends nodes{};  // as the first face has them
  std::array<Index, 2> across{-1, -1}, opposite{-1, -1};
};
using Sides = std::map<Ends, Around>;

Sides sides_of(const Table<4>& faces) {
  Sides all;
  for (Index f = 0; f < faces.cols(); ++f) {
    const int corners = faces(3, f) < 0 ? 3 : 4;
    for (int e = 0; e < corners; ++e) {
      const Index a = faces(e, f), b = faces((e + 1) % corners, f), across = faces((e + 2) % corners, f);
      const Index opposite = faces((e + corners - 1) % corners, f);
      Around& around = all[sorted(a, b)];
      if (around.faces == 0) around.nodes = {a, b};
      const auto side = static_cast<std::size_t>(around.faces);
      if (around.faces < 2) around.across[side] = across, around.opposite[side] = opposite;
      ++around.faces;
    }
  }
  return all;
}

/// Whether a face at an edge of a body is one of a surface too.
bool is_side(const Sides& surface, const Ends& ends, const Around& of_body, std::size_t side) {
  const auto at = surface.find(ends);
  if (at == surface.end()) return false;
  const Around& own = at->second;
  const Ends wanted = sorted(of_body.across[side], of_body.opposite[side]);
  return sorted(own.across[0], own.opposite[0]) == wanted || sorted(own.across[1], own.opposite[1]) == wanted;
}

/// Whether a surface is one of plates: its facets are elements.
bool has_plates(const mesh::Mesh& mesh, const mesh::Surface& surface) {
  const auto key = [](const auto& nodes) {
    std::array<Index, 3> all{nodes(0), nodes(1), nodes(2)};
    std::sort(all.begin(), all.end());
    return all;
  };
  if (surface.facets.cols() == 0) return false;
  const auto first = key(surface.facets.col(0));
  for (const mesh::Triangles& region : mesh.triangles)
    for (Index t = 0; t < region.nodes.cols(); ++t)
      if (key(region.nodes.col(t)) == first) return true;
  return false;
}

/// The regions that have nodes of a surface.
std::vector<mesh::Hexahedra> behind(const mesh::Mesh& mesh, const Subset& nodes) {
  std::vector<char> marked(static_cast<std::size_t>(mesh.X.cols()), 0);
  for (const Index node : nodes) marked[static_cast<std::size_t>(node)] = 1;
  std::vector<mesh::Hexahedra> regions;
  for (const mesh::Hexahedra& region : mesh.hexahedra) {
    const auto all = region.nodes.reshaped();
    const bool has = std::any_of(all.begin(), all.end(), [&](Index node) { return marked[static_cast<std::size_t>(node)] != 0; });
    if (has) regions.push_back(region);
  }
  return regions;
}

/// The faces of all plates, or the skin of the solids behind a surface.
Table<4> faces_of_bodies(const mesh::Mesh& mesh, const Subset& nodes, bool plates) {
  if (!plates) return mesh::faces(mesh, {"", mesh::skin(mesh.X, behind(mesh, nodes)).facets});
  Index count = 0;
  for (const mesh::Triangles& region : mesh.triangles) count += static_cast<Index>(region.nodes.cols());
  Table<4> faces(4, count);
  Index f = 0;
  for (const mesh::Triangles& region : mesh.triangles)
    for (Index t = 0; t < region.nodes.cols(); ++t) faces.col(f++) << region.nodes.col(t), -1;
  return faces;
}

}  // namespace

Vec3 along(const Edges& edges, const Vectors& x, Index edge) { return x.col(edges.nodes(1, edge)) - x.col(edges.nodes(0, edge)); }

namespace {

/// From the middle of an edge to the middle of what is opposite in a facet. [m]
Vec3 way_across(const Edges& edges, const Vectors& x, Index edge, int side) {
  const Vec3 here = x.col(edges.nodes(0, edge)) + x.col(edges.nodes(1, edge));
  return 0.5 * (x.col(edges.across(side, edge)) + x.col(edges.opposite(side, edge)) - here);
}

}  // namespace

Vec3 into(const Edges& edges, const Vectors& x, Index edge, int side) {
  const Vec3 L = along(edges, x, edge), way = way_across(edges, x, edge, side);
  return way - way.dot(L) / L.squaredNorm() * L;
}

Edges edges_of(const mesh::Mesh& mesh, const mesh::Surface& surface, std::span<const Subset> symmetry_planes) {
  Edges edges;
  const bool plates = has_plates(mesh, surface);
  const Subset nodes = mesh::surface_nodes(surface);
  const Sides sides = sides_of(faces_of_bodies(mesh, nodes, plates));
  const Scalars area = mesh::tributary_areas(mesh, surface, nodes);
  const auto area_of = [&](Index node) { return area(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()); };
  const auto in_plane = [&](const Ends& ends) {
    return std::any_of(symmetry_planes.begin(), symmetry_planes.end(), [&](const Subset& plane) {
      return std::binary_search(plane.begin(), plane.end(), ends[0]) && std::binary_search(plane.begin(), plane.end(), ends[1]);
    });
  };
  const Sides on_surface = sides_of(mesh::faces(mesh, surface));
  std::map<Ends, const Around*> found;  // each once, in an order that is of the mesh alone
  for (Index f = 0; f < surface.facets.cols(); ++f)
    for (int e = 0; e < 3; ++e) {
      const Ends ends = sorted(surface.facets(e, f), surface.facets((e + 1) % 3, f));
      const auto at = sides.find(ends);
      if (at != sides.end() && at->second.faces <= 2 && !in_plane(ends)) found[ends] = &at->second;
    }
  const auto count = static_cast<Eigen::Index>(found.size());
  edges.nodes.resize(2, count), edges.across.resize(2, count), edges.opposite.resize(2, count), edges.area.resize(count);
  edges.counts.resize(2, count);
  edges.of_plates.assign(found.size(), plates ? 1 : 0);
  Eigen::Index e = 0;
  for (const auto& [ends, around] : found) {
    edges.nodes.col(e) << around->nodes[0], around->nodes[1];
    edges.across.col(e) << around->across[0], around->across[1];
    edges.opposite.col(e) << around->opposite[0], around->opposite[1];
    for (std::size_t side = 0; side < 2; ++side) edges.counts(static_cast<Index>(side), e) = is_side(on_surface, ends, *around, side);
    edges.area(e++) = 0.5 * (area_of(ends[0]) + area_of(ends[1]));
  }
  return edges;
}

void add_edges(const Edges& more, double half, Index body, Edges& all) {
  const Eigen::Index before = all.nodes.cols(), count = before + more.nodes.cols();
  all.nodes.conservativeResize(2, count), all.across.conservativeResize(2, count), all.opposite.conservativeResize(2, count);
  all.counts.conservativeResize(2, count), all.counts.rightCols(more.counts.cols()) = more.counts;
  all.area.conservativeResize(count), all.half.conservativeResize(count);
  all.nodes.rightCols(more.nodes.cols()) = more.nodes, all.across.rightCols(more.nodes.cols()) = more.across;
  all.opposite.rightCols(more.nodes.cols()) = more.opposite;
  all.area.tail(more.area.size()) = more.area, all.half.tail(more.area.size()).setConstant(half);
  all.of_plates.insert(all.of_plates.end(), more.of_plates.begin(), more.of_plates.end());
  all.body.resize(static_cast<std::size_t>(count), body);
}

Subset nodes_of(const Edges& edges) {
  Subset nodes(edges.nodes.data(), edges.nodes.data() + edges.nodes.size());
  for (const Table<2>* some : {&edges.across, &edges.opposite})
    std::copy_if(some->data(), some->data() + some->size(), std::back_inserter(nodes), [](Index node) { return node >= 0; });
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

bool is_ridge(const Edges& edges, const Vectors& x, Index edge) {
  if (edges.across(1, edge) < 0) return true;
  const Vec3 L = along(edges, x, edge), first = into(edges, x, edge, 0), second = into(edges, x, edge, 1);
  const double sizes = first.norm() * second.norm();
  if (!(first.dot(second) > -ridge * sizes)) return false;
  if (edges.of_plates[static_cast<std::size_t>(edge)] != 0) return true;
  return L.cross(first).dot(second) < 0;  // the normal of the first facet leads away from the second one
}

Flanks::Flanks(const Edges& edges, const Vectors& x, Index edge) {
  for (int side = 0; side < 2; ++side)
    if (edges.across(side, edge) >= 0) into[static_cast<std::size_t>(count++)] = contact::into(edges, x, edge, side).normalized();
}

double area_loaded(const Edges& edges, const Vectors& x, Index edge, const Vec3& direction) {
  if (edges.of_plates[static_cast<std::size_t>(edge)] != 0) return edges.area(edge);
  const Vec3 L = along(edges, x, edge);
  double facing = 0, all = 0;
  for (int side = 0; side < 2; ++side) {
    if (edges.across(side, edge) < 0 || edges.counts(side, edge) == 0) continue;
    const Vec3 area = (side == 0 ? 1.0 : -1.0) * L.cross(into(edges, x, edge, side));  // along the normal of the facet
    all += area.norm();
    if (area.dot(direction) < -0.5 * area.norm()) facing += area.norm();
  }
  return facing > 0 ? facing / all * edges.area(edge) : edges.area(edge);
}

double rise(const Flanks& flanks, const Vec3& direction) {
  double most = -1;
  for (int i = 0; i < flanks.count; ++i) most = std::max(most, flanks.into[static_cast<std::size_t>(i)].dot(direction));
  return most;
}

double turn_of_facets(const Edges& edges, const Vectors& x, Index edge) {
  const Vec3 L = along(edges, x, edge);
  double most = 0;
  for (int side = 0; side < 2; ++side) {
    if (edges.across(side, edge) < 0) continue;
    const double along_edge = std::abs(way_across(edges, x, edge, side).dot(L)) / L.squaredNorm();
    most = std::max(most, (1 + along_edge) / into(edges, x, edge, side).norm() + 1 / L.norm());
  }
  return most;
}

}  // namespace nereid::contact
