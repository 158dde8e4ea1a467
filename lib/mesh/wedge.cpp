#include "mesh/wedge.hpp"

#include <cmath>

#include "base/check.hpp"
#include "mesh/facets.hpp"
#include "mesh/revolution.hpp"

namespace nereid::mesh {
namespace {

void check_angle(double angle, int cells_around) {
  check(cells_around > 0, "a sector needs at least one cell around");
  check(angle > 0 && angle < 2 * pi && angle < pi * cells_around,
        "a sector's angle lies between 0 and a whole turn, that of each of its cells below half a turn");
}

/// Unit vector at `around` of the equal angles.
Eigen::Vector2d ray(double angle, int around, int cells_around) {
  const double at = angle * (static_cast<double>(around) / cells_around);
  return {std::cos(at), std::sin(at)};
}

/// Nodes of one layer: ray by ray outwards; the axis, if there is one, comes first.
class WedgeNumbers {
 public:
  explicit WedgeNumbers(const Wedge& wedge)
      : around_(wedge.cells_around), radial_(wedge.cells_radial), axis_(wedge.inner_radius == 0) {}

  bool has_axis() const { return axis_; }
  Index nodes() const { return axis_ ? 1 + (around_ + 1) * radial_ : (around_ + 1) * (radial_ + 1); }
  Index node(int around, int outwards) const {
    if (!axis_) return around * (radial_ + 1) + outwards;
    return outwards == 0 ? 0 : 1 + around * radial_ + outwards - 1;
  }

  /// Counter-clockwise seen from above, from the inner node of the first ray on.
  Quadrilateral cell(int around, int outwards) const {
    return {node(around, outwards), node(around, outwards + 1), node(around + 1, outwards + 1),
            node(around + 1, outwards)};
  }

 private:
  Index around_, radial_;
  bool axis_;
};

Vectors positions(const Wedge& wedge, const WedgeNumbers& numbers) {
  Vectors X(3, numbers.nodes() * (wedge.cells_along + 1));
  for (int along = 0; along <= wedge.cells_along; ++along) {
    const double z = height(along, wedge.cells_along, wedge.length);
    for (int around = 0; around <= wedge.cells_around; ++around) {
      const Eigen::Vector2d outwards = ray(wedge.angle, around, wedge.cells_around);
      for (int cell = 0; cell <= wedge.cells_radial; ++cell) {
        const double fraction = static_cast<double>(cell) / wedge.cells_radial;
        const double r = (1 - fraction) * wedge.inner_radius + fraction * wedge.radius;
        X.col(along * numbers.nodes() + numbers.node(around, cell)) << r * outwards, z;
      }
    }
  }
  return X;
}

template <class Visit>
void each_cell(const Wedge& wedge, Visit&& visit) {
  for (int around = 0; around < wedge.cells_around; ++around)
    for (int outwards = 0; outwards < wedge.cells_radial; ++outwards) visit(around, outwards);
}

Table<8> elements(const Wedge& wedge, const WedgeNumbers& numbers) {
  Table<8> nodes(8, static_cast<Eigen::Index>(wedge.cells_around) * wedge.cells_radial * wedge.cells_along);
  Index element = 0;
  for (int along = 0; along < wedge.cells_along; ++along) {
    each_cell(wedge, [&](int around, int outwards) {
      const Quadrilateral cell = numbers.cell(around, outwards);
      for (int a = 0; a < 4; ++a) {
        nodes(a, element) = cell[a] + along * numbers.nodes();
        nodes(a + 4, element) = cell[a] + (along + 1) * numbers.nodes();
      }
      ++element;
    });
  }
  return nodes;
}

/// The facets of one end, normals along +z; at the axis a cell is one triangle.
Table<3> end(const Wedge& wedge, const WedgeNumbers& numbers, int along) {
  const Index first = along * numbers.nodes();
  Facets facets;
  each_cell(wedge, [&](int around, int outwards) {
    const auto& [a, b, c, d] = numbers.cell(around, outwards);
    if (a == d)
      facets.add(first + a, first + b, first + c);
    else
      facets.add({first + a, first + b, first + c, first + d}, cut_at_cell(around));
  });
  return facets.table();
}

/// The facets around at one ring of nodes, normals away from the axis.
template <class Node>
Table<3> around_at(int cells_around, int cells_along, Node&& node) {
  Facets facets;
  for (int along = 0; along < cells_along; ++along)
    for (int around = 0; around < cells_around; ++around)
      facets.add({node(around, along), node(around + 1, along), node(around + 1, along + 1), node(around, along + 1)},
                 cut_at_cell(around));
  return facets.table();
}

}  // namespace

Vec3 first_plane_normal() { return -Vec3::UnitY(); }

Vec3 second_plane_normal(double angle) { return {-std::sin(angle), std::cos(angle), 0}; }

Mesh wedge(const std::string& name, const Wedge& wedge) {
  check_angle(wedge.angle, wedge.cells_around);
  check(wedge.inner_radius >= 0 && wedge.radius > wedge.inner_radius && wedge.length > 0,
        "a sector needs length > 0 and radius > inner_radius >= 0");
  check(wedge.cells_radial > 0 && wedge.cells_along > 0, "a sector needs at least one cell each way");
  const WedgeNumbers numbers(wedge);
  const auto ring = [&](int outwards) {
    return around_at(wedge.cells_around, wedge.cells_along, [&](int around, int along) {
      return along * numbers.nodes() + numbers.node(around, outwards);
    });
  };
  Mesh mesh;
  mesh.X = positions(wedge, numbers);
  mesh.hexahedra = {{name, elements(wedge, numbers)}};
  mesh.surfaces = {{name + ".bottom", reversed(end(wedge, numbers, 0))},
                   {name + ".top", end(wedge, numbers, wedge.cells_along)},
                   {name + ".side", ring(wedge.cells_radial)}};
  if (!numbers.has_axis()) mesh.surfaces.push_back({name + ".inside", reversed(ring(0))});
  add_set_of_all(mesh, name);
  add_surface_node_sets(mesh);
  Subset first, second, axis;
  for (int along = 0; along <= wedge.cells_along; ++along) {
    for (int outwards = 0; outwards <= wedge.cells_radial; ++outwards) {
      first.push_back(along * numbers.nodes() + numbers.node(0, outwards));
      second.push_back(along * numbers.nodes() + numbers.node(wedge.cells_around, outwards));
    }
    axis.push_back(along * numbers.nodes());
  }
  mesh.node_sets.push_back({name + ".first_plane", first});
  mesh.node_sets.push_back({name + ".second_plane", second});
  if (numbers.has_axis()) mesh.node_sets.push_back({name + ".axis", axis});
  return mesh;
}

Mesh wedge_tube(const std::string& name, const WedgeTube& tube) {
  check_angle(tube.angle, tube.cells_around);
  check(tube.radius > 0 && tube.length > 0, "a tube needs radius and length > 0");
  check(tube.cells_along > 0, "a tube needs at least one cell each way");
  const auto node = [&](int around, int along) { return around + (tube.cells_around + 1) * along; };
  Mesh mesh;
  mesh.X.resize(3, node(0, tube.cells_along + 1));
  Subset bottom, top, first, second;
  for (int along = 0; along <= tube.cells_along; ++along) {
    const double z = height(along, tube.cells_along, tube.length);
    for (int around = 0; around <= tube.cells_around; ++around)
      mesh.X.col(node(around, along)) << tube.radius * ray(tube.angle, around, tube.cells_around), z;
    first.push_back(node(0, along));
    second.push_back(node(tube.cells_around, along));
  }
  for (int around = 0; around <= tube.cells_around; ++around) {
    bottom.push_back(node(around, 0));
    top.push_back(node(around, tube.cells_along));
  }
  const Table<3> outside = around_at(tube.cells_around, tube.cells_along, node);
  mesh.triangles = {{name, outside}};
  mesh.surfaces = {{name + ".outside", outside}, {name + ".inside", reversed(outside)}};
  add_set_of_all(mesh, name);
  mesh.node_sets.insert(mesh.node_sets.end(), {{name + ".bottom", bottom},
                                               {name + ".top", top},
                                               {name + ".first_plane", first},
                                               {name + ".second_plane", second}});
  return mesh;
}

}  // namespace nereid::mesh
