#include "audit/surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/check.hpp"
#include "mesh/skin.hpp"

namespace nereid::audit {

namespace {

constexpr Index leaf = 4;  // triangles in a leaf of a tree, at most

/// Corners of each face of a hexahedron, counter-clockwise seen from outside.
constexpr int face_corners[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// A face of an element, by nodes of the mesh.
struct Face {
  std::array<Index, 4> corner{-1, -1, -1, -1};
  std::array<Index, 4> key{-1, -1, -1, -1};  ///< the same in order of their numbers
  int corners = 0;
  Index region = 0;
  double size = 0;    ///< [m] of its element where it is flattest
  double half = 0;    ///< [m] half the thickness of its plate
  bool cut = false;   ///< see Surface::cut

  Index lowest() const { return key[4 - corners]; }
};

/// The face with each node once: where two corners of a wedge are one node, it is a triangle or nothing.
Face face_of(const Index* nodes, int count) {
  Face face;
  for (int i = 0; i < count; ++i)
    if (std::find(face.corner.begin(), face.corner.end(), nodes[i]) == face.corner.end()) face.corner[face.corners++] = nodes[i];
  face.key = face.corner;
  std::sort(face.key.begin(), face.key.end());
  return face;
}

double area(const Vectors& X, const Face& face) {
  const Vec3 a = X.col(face.corner[0]), b = X.col(face.corner[1]), c = X.col(face.corner[2]);
  if (face.corners == 3) return 0.5 * (b - a).cross(c - a).norm();
  const Vec3 d = X.col(face.corner[3]);
  return 0.5 * (c - a).cross(d - b).norm();
}

/// Faces of hexahedra that belong to one of them alone, in their order.
std::vector<Face> outer_faces(const mesh::Mesh& mesh) {
  std::vector<Face> all;
  for (std::size_t r = 0; r < mesh.hexahedra.size(); ++r) {
    const Table<8>& nodes = mesh.hexahedra[r].nodes;
    const Scalars volume = mesh::volumes(mesh, mesh.hexahedra[r]);
    for (Index e = 0; e < nodes.cols(); ++e) {
      const std::size_t first = all.size();
      double largest = 0;
      for (const auto& at : face_corners) {
        const Index around[4] = {nodes(at[0], e), nodes(at[1], e), nodes(at[2], e), nodes(at[3], e)};
        Face face = face_of(around, 4);
        if (face.corners < 3) continue;
        face.region = static_cast<Index>(r);
        largest = std::max(largest, area(mesh.X, face));
        all.push_back(face);
      }
      for (std::size_t f = first; f < all.size(); ++f) all[f].size = largest > 0 ? volume(e) / largest : std::cbrt(volume(e));
    }
  }
  // faces by their lowest node: the few that share it are compared one by one
  std::vector<Index> begin(mesh.X.cols() + 1, 0), order(all.size());
  for (const Face& face : all) ++begin[face.lowest() + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  for (std::size_t f = 0; f < all.size(); ++f) order[next[all[f].lowest()]++] = static_cast<Index>(f);
  std::vector<Face> outer;
  for (const Face& face : all) {
    int same = 0;
    for (Index i = begin[face.lowest()]; i < begin[face.lowest() + 1]; ++i) same += all[order[i]].key == face.key;
    if (same == 1) outer.push_back(face);
  }
  return outer;
}

std::vector<Face> faces_of_plates(const mesh::Mesh& mesh, const std::vector<double>& thickness) {
  std::vector<Face> all;
  for (std::size_t r = 0; r < mesh.triangles.size(); ++r) {
    const Table<3>& nodes = mesh.triangles[r].nodes;
    for (Index e = 0; e < nodes.cols(); ++e) {
      Face face = face_of(nodes.col(e).data(), 3);
      if (face.corners < 3) continue;
      face.region = static_cast<Index>(mesh.hexahedra.size() + r);
      const double side = std::sqrt(2 * area(mesh.X, face));
      face.size = thickness[r] > 0 ? std::min(thickness[r], side) : side;
      face.half = thickness[r] / 2;
      all.push_back(face);
    }
  }
  return all;
}

/// The connected piece of each node, counted by their lowest nodes; -1 where there is no element.
std::vector<Index> pieces(const mesh::Mesh& mesh) {
  std::vector<Index> leader(mesh.X.cols(), -1);
  const auto find = [&](Index node) {
    while (leader[node] != node) node = leader[node] = leader[leader[node]];
    return node;
  };
  const auto join = [&](const auto& nodes) {
    for (Index e = 0; e < nodes.cols(); ++e)
      for (Index a = 0; a < nodes.rows(); ++a) {
        if (leader[nodes(a, e)] < 0) leader[nodes(a, e)] = nodes(a, e);
        const Index one = find(nodes(0, e)), other = find(nodes(a, e));
        leader[std::max(one, other)] = std::min(one, other);
      }
  };
  for (const auto& region : mesh.hexahedra) join(region.nodes);
  for (const auto& region : mesh.triangles) join(region.nodes);
  std::vector<Index> piece(leader.size(), -1);
  Index count = 0;
  for (Index n = 0; n < static_cast<Index>(leader.size()); ++n)
    if (leader[n] >= 0) piece[n] = leader[n] == n ? count++ : piece[find(n)];
  return piece;
}

/// For each node the directions into its piece from the planes of symmetry on which it lies, added up.
Vectors inward_directions(const mesh::Mesh& mesh, const std::vector<Index>& piece, const std::vector<Symmetry>& planes) {
  Vectors inward = Vectors::Zero(3, mesh.X.cols());
  if (planes.empty()) return inward;
  const Index count = piece.empty() ? 0 : *std::max_element(piece.begin(), piece.end()) + 1;
  Vectors middle = Vectors::Zero(3, count);
  Scalars nodes = Scalars::Zero(count);
  for (Index n = 0; n < static_cast<Index>(piece.size()); ++n)
    if (piece[n] >= 0) middle.col(piece[n]) += mesh.X.col(n), nodes(piece[n]) += 1;
  for (const Symmetry& plane : planes)
    for (const Index n : plane.nodes) {
      if (piece[n] < 0) continue;
      const double side = (middle.col(piece[n]) / nodes(piece[n]) - mesh.X.col(n)).dot(plane.normal);
      inward.col(n) += side < 0 ? Vec3(-plane.normal) : plane.normal;
    }
  return inward;
}

/// Whether all corners of a face lie on one plane of symmetry.
bool lies_on(const Face& face, const std::vector<std::vector<char>>& on_plane) {
  return std::any_of(on_plane.begin(), on_plane.end(), [&](const std::vector<char>& on) {
    return std::all_of(face.corner.begin(), face.corner.begin() + face.corners, [&](Index n) { return on[n] != 0; });
  });
}

/// Halves a range of triangles along the longest side of their box until few are left.
void grow(Tree& tree, const Vectors& middle, std::vector<Index>& order, Index first, Index last) {
  const auto here = tree.nodes.size();
  tree.nodes.push_back({first, last, 0});
  if (last - first <= leaf) return;
  Vec3 low = middle.col(order[first]), high = low;
  for (Index i = first; i < last; ++i) low = low.cwiseMin(middle.col(order[i])), high = high.cwiseMax(middle.col(order[i]));
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const Index half = first + (last - first) / 2;
  std::nth_element(order.begin() + first, order.begin() + half, order.begin() + last, [&](Index a, Index b) {
    return middle(axis, a) != middle(axis, b) ? middle(axis, a) < middle(axis, b) : a < b;
  });
  grow(tree, middle, order, first, half);
  tree.nodes[here].second = static_cast<Index>(tree.nodes.size());
  grow(tree, middle, order, half, last);
}

/// Finds for each edge a triangle that has it.
void find_owners(Surface& surface) {
  surface.owner.assign(surface.edges.cols(), 0);
  const auto begin = surface.edges.colwise().begin();
  const auto points = static_cast<Index>(surface.nodes.size());
  for (Index t = 0; t < surface.triangles.cols(); ++t)
    for (int side = 0; side < 3; ++side) {
      const Index a = surface.triangles(side, t), b = surface.triangles((side + 1) % 3, t);
      if (a >= points || b >= points) continue;
      const std::pair edge{std::min(a, b), std::max(a, b)};
      const auto less = [](const auto& column, const auto& key) { return std::pair{column(0), column(1)} < key; };
      surface.owner[std::lower_bound(begin, surface.edges.colwise().end(), edge, less) - begin] = t;
    }
}

/// Finds the face across each side of a face.
void find_beside(Surface& surface) {
  const auto count = static_cast<Index>(surface.faces.cols());
  std::vector<std::array<Index, 4>> sides;  // two points, a face, which of its sides
  const auto corners = [&](Index f) { return surface.faces(3, f) < 0 ? 3 : 4; };
  for (Index f = 0; f < count; ++f)
    for (int i = 0; i < corners(f); ++i) {
      const Index a = surface.faces(i, f), b = surface.faces((i + 1) % corners(f), f);
      sides.push_back({std::min(a, b), std::max(a, b), f, i});
    }
  std::sort(sides.begin(), sides.end());
  surface.beside.setConstant(4, count, -1);
  const auto same = [](const auto& one, const auto& other) { return one[0] == other[0] && one[1] == other[1]; };
  for (std::size_t s = 0, next = 0; s < sides.size(); s = next) {
    while (next < sides.size() && same(sides[s], sides[next])) ++next;
    if (next - s != 2) continue;
    surface.beside(sides[s][3], sides[s][2]) = sides[s + 1][2];
    surface.beside(sides[s + 1][3], sides[s + 1][2]) = sides[s][2];
  }
}

/// Cuts the faces into triangles and puts a tree around them.
void cut_into_triangles(const Vectors& X, Surface& surface) {
  const auto points = static_cast<Index>(surface.nodes.size());
  std::vector<std::array<Index, 3>> corners;
  std::vector<Index> face_of_triangle;
  for (Index f = 0; f < surface.faces.cols(); ++f) {
    const auto at = surface.faces.col(f);
    const int triangles = at(3) < 0 ? 1 : 4;
    for (int i = 0; i < triangles; ++i) {
      corners.push_back({at(i), at((i + 1) % 4), triangles == 1 ? at(2) : points + f});
      face_of_triangle.push_back(f);
    }
  }
  const auto count = static_cast<Index>(corners.size());
  Vectors middle(3, count);
  std::vector<Index> order(count);
  for (Index t = 0; t < count; ++t) {
    order[t] = t;
    const auto at = surface.faces.col(face_of_triangle[t]);
    Vec3 sum = Vec3::Zero();  // of the triangle, its face counted once more, so that the four of a face stay together
    for (int i = 0; i < (at(3) < 0 ? 3 : 4); ++i) sum += X.col(surface.nodes[at(i)]);
    middle.col(t) = sum / (at(3) < 0 ? 3 : 4);
  }
  if (count > 0) grow(surface.tree, middle, order, 0, count);
  surface.triangles.resize(3, count);
  surface.face_of.resize(count);
  for (Index t = 0; t < count; ++t) {
    for (int i = 0; i < 3; ++i) surface.triangles(i, t) = corners[order[t]][i];
    surface.face_of[t] = face_of_triangle[order[t]];
  }
}

/// Whether a sheet goes on behind a side, on a plane of symmetry: the directions into the body at both ends.
bool goes_on(const Vec3& inward_a, const Vec3& inward_b) { return inward_a.dot(inward_b) > 0; }

/// Finds the sides that belong to one triangle alone.
void find_rim(Surface& surface) {
  const auto key = [&](Index t, int side) {
    const Index a = surface.triangles(side, t), b = surface.triangles((side + 1) % 3, t);
    return std::pair{std::min(a, b), std::max(a, b)};
  };
  std::map<std::pair<Index, Index>, int> count;
  for (Index t = 0; t < surface.triangles.cols(); ++t)
    for (int side = 0; side < 3; ++side) ++count[key(t, side)];
  surface.rim.assign(surface.triangles.cols(), {false, false, false});
  surface.on_rim.assign(surface.nodes.size(), 0);
  std::vector<std::pair<Index, Index>> edges;
  for (Index t = 0; t < surface.triangles.cols(); ++t)
    for (int side = 0; side < 3; ++side) {
      const auto edge = key(t, side);
      if (count[edge] != 1) continue;
      if (goes_on(surface.inward.col(edge.first), surface.inward.col(edge.second))) continue;
      surface.rim[t][side] = true;
      surface.on_rim[edge.first] = surface.on_rim[edge.second] = 1;
      edges.push_back(edge);
    }
  surface.rim_edges.resize(2, static_cast<Eigen::Index>(edges.size()));
  for (std::size_t e = 0; e < edges.size(); ++e) surface.rim_edges.col(e) << edges[e].first, edges[e].second;
}

/// Makes a surface of its faces, whose corners are columns of X and `inward`.
Surface surface_of(const Vectors& X, const std::vector<Face>& faces, const Vectors& inward) {
  Surface surface;
  for (const Face& face : faces) surface.nodes.insert(surface.nodes.end(), face.corner.begin(), face.corner.begin() + face.corners);
  std::sort(surface.nodes.begin(), surface.nodes.end());
  surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()), surface.nodes.end());
  const auto points = static_cast<Index>(surface.nodes.size()), count = static_cast<Index>(faces.size());
  surface.inward.resize(3, points);
  for (Index p = 0; p < points; ++p) surface.inward.col(p) = inward.col(surface.nodes[p]);
  surface.size = surface.half = Scalars::Constant(points, INFINITY);
  surface.region.assign(points, 0);
  surface.faces.setConstant(4, count, -1);
  surface.face_size.resize(count);
  surface.smallest = INFINITY;
  std::vector<std::pair<Index, Index>> edges;
  for (Index f = 0; f < count; ++f) {
    const Face& face = faces[f];
    for (int i = 0; i < face.corners; ++i) {
      const auto at = std::lower_bound(surface.nodes.begin(), surface.nodes.end(), face.corner[i]) - surface.nodes.begin();
      surface.faces(i, f) = static_cast<Index>(at);
    }
    for (int i = 0; i < face.corners; ++i) {
      const Index a = surface.faces(i, f), b = surface.faces((i + 1) % face.corners, f);
      edges.emplace_back(std::min(a, b), std::max(a, b));
      if (face.size < surface.size(a)) surface.size(a) = face.size, surface.region[a] = face.region;
      surface.half(a) = std::min(surface.half(a), face.half);
    }
    surface.face_size(f) = face.size;
    surface.smallest = std::min(surface.smallest, face.size);
    surface.face_region.push_back(face.region);
    surface.cut.push_back(face.cut);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  surface.edges.resize(2, static_cast<Eigen::Index>(edges.size()));
  for (std::size_t e = 0; e < edges.size(); ++e) surface.edges.col(e) << edges[e].first, edges[e].second;
  cut_into_triangles(X, surface);
  find_owners(surface);
  find_beside(surface);
  return surface;
}

/// Closes plates to a shell: their two sides, and a wall at each side of a plate where not just one other goes on in the same sense. There
/// plates have points of their own, so the shell is closed however plates meet and their normals look.
Surface shell_of(const std::vector<Face>& plates, const Vectors& X, const Vectors& inward) {
  const auto count = static_cast<Index>(plates.size());
  const auto node = [&](Index corner) { return plates[corner / 3].corner[corner % 3]; };  // corners are counted through all plates,
  const auto next = [](Index corner) { return corner - corner % 3 + (corner + 1) % 3; };  // and sides as their first corners
  std::map<std::pair<Index, Index>, std::vector<Index>> sides;
  for (Index c = 0; c < 3 * count; ++c) sides[{std::min(node(c), node(next(c))), std::max(node(c), node(next(c)))}].push_back(c);
  std::vector<Index> leader(3 * count), point(3 * count);
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](Index c) {
    while (leader[c] != c) c = leader[c] = leader[leader[c]];
    return c;
  };
  const auto join = [&](Index a, Index b) { leader[std::max(find(a), find(b))] = std::min(find(a), find(b)); };
  const auto are_joined = [&](const std::vector<Index>& at) { return at.size() == 2 && node(at[0]) != node(at[1]); };
  for (const auto& [nodes, at] : sides)
    if (are_joined(at)) join(at[0], next(at[1])), join(next(at[0]), at[1]);
  std::vector<Index> node_of;
  for (Index c = 0; c < 3 * count; ++c) {
    if (find(c) == c) node_of.push_back(node(c));
    point[c] = find(c) == c ? static_cast<Index>(node_of.size()) - 1 : point[find(c)];
  }
  const auto points = static_cast<Index>(node_of.size());
  Vectors at_points(3, 2 * points), into(3, 2 * points);
  for (Index p = 0; p < 2 * points; ++p) at_points.col(p) = X.col(node_of[p % points]), into.col(p) = inward.col(node_of[p % points]);

  std::vector<Face> faces = plates;
  for (Index c = 0; c < 3 * count; ++c) faces[c / 3].corner[c % 3] = point[c];
  for (Index f = 0; f < count; ++f) {
    Face other = faces[f];
    other.corner = {faces[f].corner[2] + points, faces[f].corner[1] + points, faces[f].corner[0] + points, -1};
    faces.push_back(other);
  }
  for (const auto& [nodes, at] : sides)
    for (std::size_t i = 0; i < at.size() && !are_joined(at); ++i) {
      const Index a = point[at[i]], b = point[next(at[i])];
      Face wall = plates[at[i] / 3];
      wall.corner = {a + points, b + points, b, a}, wall.corners = 4;
      wall.cut = at.size() > 1 || goes_on(inward.col(nodes.first), inward.col(nodes.second));
      faces.push_back(wall);
    }
  Surface shell = surface_of(at_points, faces, into);
  for (Index& n : shell.nodes) n = node_of[n % points];
  shell.plates = count;
  return shell;
}

/// Makes surfaces of the faces of each piece, and shells where the thickness of all plates is known.
void add_surfaces(const Vectors& X, const std::vector<Face>& faces, bool closed, const Vectors& inward, Surfaces& all) {
  std::vector<std::vector<Face>> of_piece;
  for (const Face& face : faces) {
    const auto piece = static_cast<std::size_t>(all.piece_of_node[face.corner[0]]);
    if (of_piece.size() <= piece) of_piece.resize(piece + 1);
    of_piece[piece].push_back(face);
  }
  for (std::size_t piece = 0; piece < of_piece.size(); ++piece) {
    if (of_piece[piece].empty()) continue;
    all.list.push_back(surface_of(X, of_piece[piece], inward));
    all.list.back().closed = closed, all.list.back().piece = static_cast<Index>(piece);
    if (!closed) find_rim(all.list.back());
    all.shells.push_back(!closed && all.list.back().half.minCoeff() > 0 ? shell_of(of_piece[piece], X, inward) : Surface{});
  }
}

}  // namespace

Surfaces surfaces(const mesh::Mesh& mesh, const std::vector<double>& thickness, const std::vector<Symmetry>& planes) {
  check(thickness.size() == mesh.triangles.size(), "an audit needs the thickness of every region of plates");
  Surfaces all;
  for (const auto& region : mesh.hexahedra) all.names.push_back(region.name);
  for (const auto& region : mesh.triangles) all.names.push_back(region.name);
  all.piece_of_node = pieces(mesh);
  const Vectors inward = inward_directions(mesh, all.piece_of_node, planes);
  std::vector<std::vector<char>> on_plane;
  for (const Symmetry& plane : planes) {
    on_plane.emplace_back(mesh.X.cols(), 0);
    for (const Index n : plane.nodes) on_plane.back()[n] = 1;
  }
  std::vector<Face> skin = outer_faces(mesh);
  for (Face& face : skin) face.cut = lies_on(face, on_plane);
  add_surfaces(mesh.X, skin, true, inward, all);
  add_surfaces(mesh.X, faces_of_plates(mesh, thickness), false, inward, all);
  return all;
}

}  // namespace nereid::audit
