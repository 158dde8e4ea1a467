#include "mesh/cylinder.hpp"

#include <cmath>

#include "base/check.hpp"
#include "mesh/facets.hpp"
#include "mesh/revolution.hpp"

namespace nereid::mesh {
namespace {

// Chosen by a scan over both for cells_core = cells_ring = 1 to 8: the shortest edge, which governs
// the time step, is within two of the longest while the scaled Jacobian keeps its best value.
constexpr double core_size = 0.48;   // [-] half the width of the core, of the radius
constexpr double core_bulge = 0.52;  // [-] 0: the core is a square, 1: a disc

/// Numbering and positions of the nodes of one layer of the quarter: the core row by row, then ray
/// by ray outwards from it.
class Section {
 public:
  explicit Section(const Cylinder& cylinder)
      : radius_(cylinder.radius), core_(cylinder.cells_core), ring_(cylinder.cells_ring) {}

  int cells_around() const { return 2 * core_; }
  Index nodes() const { return (core_ + 1) * (core_ + 1) + (cells_around() + 1) * ring_; }

  Index core_node(int right, int up) const { return right + (core_ + 1) * up; }

  /// Node `outwards` of the ray `around`; node 0 lies on the edge of the core.
  Index ray_node(int around, int outwards) const {
    if (outwards > 0) return (core_ + 1) * (core_ + 1) + around * ring_ + outwards - 1;
    return around <= core_ ? core_node(core_, around) : core_node(cells_around() - around, core_);
  }

  Eigen::Matrix2Xd positions() const {
    Eigen::Matrix2Xd points(2, nodes());
    for (int up = 0; up <= core_; ++up) {
      for (int right = 0; right <= core_; ++right) {
        points.col(core_node(right, up)) = core_position(right, up);
      }
    }
    for (int around = 0; around <= cells_around(); ++around) {
      const Eigen::Vector2d inner = points.col(ray_node(around, 0));
      const Eigen::Vector2d outer = radius_ * direction(around, core_);
      for (int outwards = 1; outwards <= ring_; ++outwards) {
        const double fraction = static_cast<double>(outwards) / ring_;
        points.col(ray_node(around, outwards)) = (1 - fraction) * inner + fraction * outer;
      }
    }
    return points;
  }

  /// Counter-clockwise seen from above.
  std::vector<Quadrilateral> cells() const {
    std::vector<Quadrilateral> all;
    for (int up = 0; up < core_; ++up) {
      for (int right = 0; right < core_; ++right) {
        all.push_back({core_node(right, up), core_node(right + 1, up), core_node(right + 1, up + 1),
                       core_node(right, up + 1)});
      }
    }
    for (int around = 0; around < cells_around(); ++around) {
      for (int outwards = 0; outwards < ring_; ++outwards) {
        all.push_back({ray_node(around, outwards), ray_node(around, outwards + 1),
                       ray_node(around + 1, outwards + 1), ray_node(around + 1, outwards)});
      }
    }
    return all;
  }

  /// How to cut a cell so that nearly every node has six facets, symmetrically about x = y.
  Cut cut(std::size_t cell) const {
    const int ring_cell = static_cast<int>(cell) - core_ * core_;
    return ring_cell < core_ * ring_ ? Cut::first_to_third : Cut::second_to_fourth;
  }

 private:
  Eigen::Vector2d core_position(int right, int up) const {
    const double x = static_cast<double>(right) / core_, y = static_cast<double>(up) / core_;
    return core_size * radius_ *
           Eigen::Vector2d(x * std::sqrt(1 - core_bulge / 2 * y * y),
                           y * std::sqrt(1 - core_bulge / 2 * x * x));
  }

  double radius_;
  int core_, ring_;
};

Vectors positions(const Section& section, const Cylinder& cylinder) {
  const Eigen::Matrix2Xd points = section.positions();
  Vectors X(3, section.nodes() * (cylinder.cells_along + 1));
  for (int along = 0; along <= cylinder.cells_along; ++along) {
    auto layer = X.middleCols(along * section.nodes(), section.nodes());
    layer.topRows<2>() = points;
    layer.row(2).setConstant(height(along, cylinder.cells_along, cylinder.length));
  }
  return X;
}

Table<8> elements(const Section& section, int cells_along) {
  const std::vector<Quadrilateral> cells = section.cells();
  Table<8> nodes(8, static_cast<Eigen::Index>(cells.size()) * cells_along);
  Index element = 0;
  for (int along = 0; along < cells_along; ++along) {
    for (const Quadrilateral& cell : cells) {
      for (int a = 0; a < 4; ++a) {
        nodes(a, element) = cell[a] + along * section.nodes();
        nodes(a + 4, element) = cell[a] + (along + 1) * section.nodes();
      }
      ++element;
    }
  }
  return nodes;
}

/// The facets of one end, normals along +z.
Table<3> end(const Section& section, int along) {
  const std::vector<Quadrilateral> cells = section.cells();
  const Index first = along * section.nodes();
  Facets facets;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const auto& [a, b, c, d] = cells[cell];
    facets.add({first + a, first + b, first + c, first + d}, section.cut(cell));
  }
  return facets.table();
}

/// Cuts alternate around the side, so each node off its rims has six facets, in the full turn too.
Table<3> side(const Section& section, const Cylinder& cylinder) {
  Facets facets;
  for (int along = 0; along < cylinder.cells_along; ++along) {
    const Index low = along * section.nodes(), high = low + section.nodes();
    for (int around = 0; around < section.cells_around(); ++around) {
      const Index left = section.ray_node(around, cylinder.cells_ring);
      const Index right = section.ray_node(around + 1, cylinder.cells_ring);
      facets.add({low + left, low + right, high + right, high + left},
                 around % 2 == 0 ? Cut::first_to_third : Cut::second_to_fourth);
    }
  }
  return facets.table();
}

}  // namespace

Mesh cylinder(const std::string& name, const Cylinder& cylinder) {
  check(cylinder.radius > 0 && cylinder.length > 0, "a cylinder needs radius and length > 0");
  check(cylinder.cells_core > 0 && cylinder.cells_ring > 0 && cylinder.cells_along > 0,
        "a cylinder needs at least one cell in core, in ring and along");
  const Section section(cylinder);
  Mesh quarter;
  quarter.X = positions(section, cylinder);
  quarter.hexahedra = {{name, elements(section, cylinder.cells_along)}};
  quarter.surfaces = {{name + ".bottom", reversed(end(section, 0))},
                      {name + ".top", end(section, cylinder.cells_along)},
                      {name + ".side", side(section, cylinder)}};
  Mesh mesh = turned(quarter, cylinder.turn, name);
  add_surface_node_sets(mesh);
  return mesh;
}

}  // namespace nereid::mesh
