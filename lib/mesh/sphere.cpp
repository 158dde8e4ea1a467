#include "mesh/sphere.hpp"

#include <array>
#include <cmath>
#include <map>

#include "base/check.hpp"
#include "mesh/facets.hpp"
#include "mesh/revolution.hpp"

namespace nereid::mesh {
namespace {

// Chosen by a scan over both for cells_core = cells_ring = 1 to 6, as for the cylinder: the best scaled Jacobian, and
// of these the longest shortest edge.
constexpr double ball_core_size = 0.46;   // [-] half the width of the core, of the radius
constexpr double ball_core_bulge = 0.45;  // [-] 0: the core is a cube, 1: a ball

using CorePlace = std::array<int, 3>;  // in the core along x, y, z

double core_coordinate(double x, double y, double z) {
  const double b = ball_core_bulge;
  return ball_core_size * x * std::sqrt(1 - b * (y * y + z * z) / 2 + b * b * y * y * z * z / 3);
}

/// The eighth in the making: nodes of the core, then those of the shells over its outer faces.
class Eighth {
 public:
  explicit Eighth(const Sphere& sphere) : sphere_(sphere), core_(sphere.cells_core) {
    for (int k = 0; k <= core_; ++k)
      for (int j = 0; j <= core_; ++j)
        for (int i = 0; i <= core_; ++i) points_.push_back(sphere.radius * core_point({i, j, k}));
    for (int face = 0; face < 3; ++face) each_on_face(face, [&](const CorePlace& at) { add_ray(at); });
  }

  Mesh mesh(const std::string& name) const {
    std::vector<std::array<Index, 8>> cells;
    for (int k = 0; k < core_; ++k)
      for (int j = 0; j < core_; ++j)
        for (int i = 0; i < core_; ++i)
          cells.push_back({core_node({i, j, k}), core_node({i + 1, j, k}), core_node({i + 1, j + 1, k}),
                           core_node({i, j + 1, k}), core_node({i, j, k + 1}), core_node({i + 1, j, k + 1}),
                           core_node({i + 1, j + 1, k + 1}), core_node({i, j + 1, k + 1})});
    Facets facets;
    for (int face = 0; face < 3; ++face) {
      for (int up = 0; up < core_; ++up) {
        for (int right = 0; right < core_; ++right) {
          const std::array<CorePlace, 4> corner{on_face(face, right, up), on_face(face, right + 1, up),
                                                on_face(face, right + 1, up + 1), on_face(face, right, up + 1)};
          for (int shell = 0; shell < sphere_.cells_ring; ++shell) {
            std::array<Index, 8> cell;
            for (int a = 0; a < 4; ++a) {
              cell[a] = ray_node(corner[a], shell);
              cell[a + 4] = ray_node(corner[a], shell + 1);
            }
            cells.push_back(cell);
          }
          const auto outer = [&](int a) { return ray_node(corner[a], sphere_.cells_ring); };
          facets.add({outer(0), outer(1), outer(2), outer(3)}, Cut::first_to_third);
        }
      }
    }
    Mesh mesh;
    mesh.X = Eigen::Map<const Vectors>(points_[0].data(), 3, static_cast<Eigen::Index>(points_.size()));
    mesh.hexahedra = {{name, Eigen::Map<const Table<8>>(cells[0].data(), 8, static_cast<Eigen::Index>(cells.size()))}};
    mesh.surfaces = {{name + ".surface", facets.table()}};
    return mesh;
  }

 private:
  /// Axes follow in cyclic order, so that right, up and outwards are right-handed on every face.
  CorePlace on_face(int face, int right, int up) const {
    CorePlace at{};
    at[face] = core_, at[(face + 1) % 3] = right, at[(face + 2) % 3] = up;
    return at;
  }

  template <class Visit>
  void each_on_face(int face, Visit&& visit) const {
    for (int up = 0; up <= core_; ++up)
      for (int right = 0; right <= core_; ++right) visit(on_face(face, right, up));
  }

  Index core_node(const CorePlace& at) const { return at[0] + (core_ + 1) * (at[1] + (core_ + 1) * at[2]); }

  Vec3 core_point(const CorePlace& at) const {
    const double x = static_cast<double>(at[0]) / core_, y = static_cast<double>(at[1]) / core_,
                 z = static_cast<double>(at[2]) / core_;
    return {core_coordinate(x, y, z), core_coordinate(y, z, x), core_coordinate(z, x, y)};
  }

  /// Unit vector through a node of the core's outer faces; the same from each of the faces that meet there.
  Vec3 direction(const CorePlace& at) const {
    Vec3 towards;
    for (int i = 0; i < 3; ++i) towards(i) = at[i] == core_ ? 1 : std::tan(pi / 4 * at[i] / core_);
    return towards.normalized();
  }

  void add_ray(const CorePlace& at) {
    if (!ray_.try_emplace(at, static_cast<Index>(points_.size())).second) return;  // faces share their edges
    const Vec3 inner = points_[static_cast<std::size_t>(core_node(at))], outer = sphere_.radius * direction(at);
    for (int shell = 1; shell <= sphere_.cells_ring; ++shell) {
      const double fraction = static_cast<double>(shell) / sphere_.cells_ring;
      points_.push_back((1 - fraction) * inner + fraction * outer);
    }
  }

  Index ray_node(const CorePlace& at, int shell) const { return shell == 0 ? core_node(at) : ray_.at(at) + shell - 1; }

  const Sphere& sphere_;
  int core_;
  std::vector<Vec3> points_;
  std::map<CorePlace, Index> ray_;  // first node of each ray beyond the core
};

}  // namespace

Mesh sphere(const std::string& name, const Sphere& sphere) {
  check(sphere.radius > 0, "a sphere needs radius > 0");
  check(sphere.cells_core > 0 && sphere.cells_ring > 0, "a sphere needs at least one cell in core and in ring");
  Mesh mesh = Eighth(sphere).mesh(name);
  const bool is_cut[3] = {sphere.part == SpherePart::quarter || sphere.part == SpherePart::eighth,
                          sphere.part == SpherePart::quarter || sphere.part == SpherePart::eighth,
                          sphere.part == SpherePart::half || sphere.part == SpherePart::eighth};
  for (int axis = 0; axis < 3; ++axis)
    if (!is_cut[axis]) mesh = with_image(mesh, axis);
  add_set_of_all(mesh, name);
  add_surface_node_sets(mesh);
  for (int axis = 0; axis < 3; ++axis)
    if (is_cut[axis]) add_plane(mesh, name + "." + "xyz"[axis] + "_plane", axis);
  return mesh;
}

}  // namespace nereid::mesh
