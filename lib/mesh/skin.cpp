#include "mesh/skin.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "mesh/facets.hpp"

namespace nereid::mesh {
namespace {

/// A face with its different corners in order, and in ascending order to find it again.
struct Face {
  std::array<Index, 4> corner{-1, -1, -1, -1}, key{-1, -1, -1, -1};
  int corners = 0;
};

Face face(const Table<8>& nodes, Index element, const int (&at)[4]) {
  Face found;
  for (const int a : at) {
    const Index node = nodes(a, element);
    if (std::count(found.corner.begin(), found.corner.end(), node) == 0) found.corner[found.corners++] = node;
  }
  found.key = found.corner;
  std::sort(found.key.begin(), found.key.end());
  return found;
}

/// Mean of the positions that are marked; zero if none is.
Vec3 mean_of(const Vectors& X, const std::vector<char>& marked) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (Index node = 0; node < X.cols(); ++node)
    if (marked[static_cast<std::size_t>(node)]) sum += X.col(node), ++count;
  return count > 0 ? Vec3(sum / count) : sum;
}

}  // namespace

Scalars volumes(const Mesh& mesh, const Hexahedra& region) {
  Scalars all(region.nodes.cols());
  for (Index e = 0; e < all.size(); ++e) {
    const Vec3 origin = mesh.X.col(region.nodes(0, e));  // differences keep their digits far from the origin
    double sum = 0;
    for (const auto& at : corners_of_faces) {
      Vec3 x[4];
      for (int a = 0; a < 4; ++a) x[a] = mesh.X.col(region.nodes(at[a], e)) - origin;
      // both ways to cut a bilinear patch, and their mean: six times the volume under it, exactly
      for (const auto& [a, b, c] : {std::array{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}}) sum += x[a].dot(x[b].cross(x[c])) / 2;
    }
    all(e) = sum / 6;
  }
  return all;
}

Skin skin(const Vectors& X, const std::vector<Hexahedra>& regions) {
  std::vector<Face> faces;
  for (const Hexahedra& region : regions)
    for (Index e = 0; e < region.nodes.cols(); ++e)
      for (const auto& at : corners_of_faces) {
        const Face one = face(region.nodes, e, at);
        if (one.corners > 2) faces.push_back(one);
      }
  std::vector<std::size_t> order(faces.size());
  for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return faces[a].key < faces[b].key; });
  std::vector<char> outer(faces.size(), 0);
  Skin result;
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && faces[order[end]].key == faces[order[begin]].key) ++end;
    if (end - begin == 1) outer[order[begin]] = 1;
    if (end - begin > 2) ++result.crowded;
    begin = end;
  }
  std::vector<char> on_skin(static_cast<std::size_t>(X.cols()), 0);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int a = 0; outer[f] && a < faces[f].corners; ++a) on_skin[static_cast<std::size_t>(faces[f].corner[a])] = 1;
  const Vec3 middle = mean_of(X, on_skin);
  Facets facets;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!outer[f]) continue;
    const auto& c = faces[f].corner;
    if (faces[f].corners == 3)
      facets.add(c[0], c[1], c[2]);
    else
      facets.add(X, c, middle);
  }
  result.facets = facets.table();
  return result;
}

}  // namespace nereid::mesh
