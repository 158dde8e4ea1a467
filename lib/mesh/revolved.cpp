#include "mesh/revolved.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.hpp"
#include "mesh/facets.hpp"

namespace nereid::mesh {

namespace {

/// Lines of nodes between given lines, and the interval of the given ones that each cell is in.
struct Lines {
  std::vector<double> at;      // [m]
  std::vector<int> interval;   // of each cell
  std::vector<int> given;      // place of each given line in `at`
};

Lines lines_of(const std::vector<double>& given, const std::vector<int>& cells) {
  Lines lines{{given[0]}, {}, {0}};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (int c = 1; c <= cells[i]; ++c) {
      const double part = static_cast<double>(c) / cells[i];
      lines.at.push_back(c == cells[i] ? given[i + 1] : (1 - part) * given[i] + part * given[i + 1]);
      lines.interval.push_back(static_cast<int>(i));
    }
    lines.given.push_back(static_cast<int>(lines.at.size()) - 1);
  }
  return lines;
}

/// The grid of a section, and which of its cells and nodes are of material.
struct Grid {
  Lines r, z;
  const Revolved& of;
  int around;  // columns of nodes

  int radial() const { return static_cast<int>(r.interval.size()); }
  int along() const { return static_cast<int>(z.interval.size()); }

  /// Whether the cell is of material; beyond the grid there is none.
  bool has(int i, int k) const {
    if (i < 0 || k < 0 || i >= radial() || k >= along()) return false;
    const std::size_t row = of.filled.size() - 1 - static_cast<std::size_t>(z.interval[static_cast<std::size_t>(k)]);
    return of.filled[row][static_cast<std::size_t>(r.interval[static_cast<std::size_t>(i)])] == 'x';
  }
  bool has_node(int i, int k) const { return has(i, k) || has(i - 1, k) || has(i, k - 1) || has(i - 1, k - 1); }
};

Grid grid_of(const Revolved& one) {
  return {lines_of(one.radii, one.cells_radial), lines_of(one.heights, one.cells_along), one,
          is_whole_turn(one) ? one.cells_around : one.cells_around + 1};
}

/// Numbers of the nodes, layer by layer and ray by ray.
class Numbers {
 public:
  explicit Numbers(const Grid& grid) : around_(grid.around), radial_(grid.radial() + 1) {
    for (int k = 0; k <= grid.along(); ++k) {
      first_.push_back(count_);
      std::vector<Index> place(static_cast<std::size_t>(radial_), -1);
      Index nodes = 0;
      for (int i = 0; i < radial_; ++i)
        if (grid.has_node(i, k)) place[static_cast<std::size_t>(i)] = nodes++;
      places_.push_back(place), in_ray_.push_back(nodes);
      count_ += nodes * around_;
    }
  }
  Index count() const { return count_; }
  Index node(int i, int j, int k) const {
    const auto layer = static_cast<std::size_t>(k);
    return first_[layer] + (j % around_) * in_ray_[layer] + places_[layer][static_cast<std::size_t>(i)];
  }

 private:
  int around_, radial_;
  Index count_ = 0;
  std::vector<Index> first_, in_ray_;
  std::vector<std::vector<Index>> places_;
};

Eigen::Vector2d ray(const Revolved& one, int j) {
  const double at = one.angle * (static_cast<double>(j) / one.cells_around);
  return {std::cos(at), std::sin(at)};
}

void check_section(const Revolved& one) {
  const auto ascend = [](const std::vector<double>& lines) {
    return lines.size() > 1 && std::adjacent_find(lines.begin(), lines.end(), [](double a, double b) { return !(a < b); }) == lines.end();
  };
  check(ascend(one.radii) && ascend(one.heights) && one.radii[0] > 0, "lines of a section ascend, outside the axis");
  check(one.cells_radial.size() + 1 == one.radii.size() && one.cells_along.size() + 1 == one.heights.size(),
        "a section has a number of cells between all its lines");
  check(one.filled.size() == one.cells_along.size() &&
            std::all_of(one.filled.begin(), one.filled.end(), [&](const auto& row) { return row.size() == one.cells_radial.size(); }),
        "a section says of each of its rectangles whether it is filled");
  check(!has_hinge(one), "rectangles of a section have sides together, or nothing");
  check(one.cells_around > 0 && one.angle > 0 && one.angle <= 2 * pi * (1 + 1e-12) && one.angle < pi * one.cells_around,
        "a section turns by no more than a whole turn, by less than half a turn for each cell");
}

}  // namespace

bool is_whole_turn(const Revolved& one) { return one.angle >= 2 * pi * (1 - 1e-12); }

bool has_hinge(const Revolved& one) {
  for (std::size_t row = 0; row + 1 < one.filled.size(); ++row)
    for (std::size_t i = 0; i + 1 < one.cells_radial.size(); ++i) {
      const bool a = one.filled[row][i] == 'x', b = one.filled[row][i + 1] == 'x';
      const bool c = one.filled[row + 1][i] == 'x', d = one.filled[row + 1][i + 1] == 'x';
      if (a == d && b == c && a != b) return true;
    }
  return false;
}

double count(const Revolved& one) {
  double sum = 0;
  for (std::size_t row = 0; row < one.filled.size() && row < one.cells_along.size(); ++row)
    for (std::size_t i = 0; i < one.cells_radial.size() && i < one.filled[row].size(); ++i)
      if (one.filled[row][i] == 'x') sum += 1.0 * one.cells_radial[i] * one.cells_along[one.cells_along.size() - 1 - row];
  return sum * one.cells_around;
}

Mesh revolved(const std::string& name, const Revolved& one) {
  check_section(one);
  const Grid grid = grid_of(one);
  const Numbers numbers(grid);
  check(numbers.count() > 0, "a section has at least one rectangle of material");
  Mesh mesh;
  mesh.X.resize(3, numbers.count());
  Subset first, second;
  for (int k = 0; k <= grid.along(); ++k)
    for (int j = 0; j < grid.around; ++j)
      for (int i = 0; i <= grid.radial(); ++i) {
        if (!grid.has_node(i, k)) continue;
        const Index node = numbers.node(i, j, k);
        mesh.X.col(node) << grid.r.at[static_cast<std::size_t>(i)] * ray(one, j), grid.z.at[static_cast<std::size_t>(k)];
        if (j == 0) first.push_back(node);
        if (j == one.cells_around) second.push_back(node);
      }
  Table<8> nodes(8, static_cast<Eigen::Index>(count(one)));
  Index element = 0;
  std::vector<Facets> out(one.radii.size()), in(one.radii.size()), up(one.heights.size()), down(one.heights.size());
  for (int k = 0; k < grid.along(); ++k)
    for (int j = 0; j < one.cells_around; ++j)
      for (int i = 0; i < grid.radial(); ++i) {
        if (!grid.has(i, k)) continue;
        std::array<Index, 8> c;
        for (int layer = 0; layer < 2; ++layer)
          for (int a = 0; a < 4; ++a)
            c[static_cast<std::size_t>(4 * layer + a)] = numbers.node(i + (a == 1 || a == 2), j + (a > 1), k + layer);
        for (int a = 0; a < 8; ++a) nodes(a, element) = c[static_cast<std::size_t>(a)];
        ++element;
        // a face without material before it lies on a given line, for only there does the section change
        const auto line = [](const Lines& lines, int at) {
          return static_cast<std::size_t>(std::find(lines.given.begin(), lines.given.end(), at) - lines.given.begin());
        };
        if (!grid.has(i + 1, k)) out[line(grid.r, i + 1)].add({c[1], c[2], c[6], c[5]}, cut_at_cell(j));
        if (!grid.has(i - 1, k)) in[line(grid.r, i)].add({c[0], c[4], c[7], c[3]}, cut_at_cell(j));
        if (!grid.has(i, k + 1)) up[line(grid.z, k + 1)].add({c[4], c[5], c[6], c[7]}, cut_at_cell(j));
        if (!grid.has(i, k - 1)) down[line(grid.z, k)].add({c[0], c[3], c[2], c[1]}, cut_at_cell(j));
      }
  mesh.hexahedra = {{name, nodes}};
  const auto add = [&](const char* word, const std::vector<Facets>& lines) {
    for (std::size_t at = 0; at < lines.size(); ++at)
      if (lines[at].table().cols() > 0) mesh.surfaces.push_back({name + word + std::to_string(at), lines[at].table()});
  };
  add(".out_", out), add(".in_", in), add(".up_", up), add(".down_", down);
  add_set_of_all(mesh, name);
  add_surface_node_sets(mesh);
  if (is_whole_turn(one)) return mesh;
  std::sort(first.begin(), first.end()), std::sort(second.begin(), second.end());
  mesh.node_sets.push_back({name + ".first_plane", first});
  mesh.node_sets.push_back({name + ".second_plane", second});
  return mesh;
}

}  // namespace nereid::mesh
