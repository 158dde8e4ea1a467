#include "mesh/disc.hpp"

#include "base/check.hpp"
#include "mesh/facets.hpp"
#include "mesh/wedge.hpp"

namespace nereid::mesh {
namespace {

void add_sides(Mesh& mesh, const std::string& name, const Table<3>& top) {
  mesh.triangles = {{name, top}};
  mesh.surfaces = {{name + ".top", top}, {name + ".bottom", reversed(top)}};
}

Subset below(const Subset& nodes, Index end) {
  Subset lower;
  for (const Index node : nodes)
    if (node < end) lower.push_back(node);
  return lower;
}

/// The lower end of a solid with one cell along z, its facets turned up: both ends are numbered alike, layer by layer.
Mesh lower_end(const Mesh& solid, const std::string& name, const std::vector<std::array<std::string, 2>>& sets) {
  const Index nodes = static_cast<Index>(solid.X.cols()) / 2;
  Mesh mesh;
  mesh.X = solid.X.leftCols(nodes);
  add_sides(mesh, name, (surface(solid, name + ".top").facets.array() - nodes).matrix());
  add_set_of_all(mesh, name);
  for (const auto& [from, to] : sets) mesh.node_sets.push_back({name + to, below(node_set(solid, name + from), nodes)});
  return mesh;
}

}  // namespace

Mesh disc(const std::string& name, const Disc& disc) {
  const Mesh solid = cylinder(name, {disc.radius, disc.radius, disc.turn, disc.cells_core, disc.cells_ring, 1});
  std::vector<std::array<std::string, 2>> sets{{".side", ".rim"}};
  if (disc.turn == Revolution::quarter) {
    sets.push_back({".x_plane", ".x_plane"});
    sets.push_back({".y_plane", ".y_plane"});
  }
  Mesh mesh = lower_end(solid, name, sets);
  for (Index node = 0; node < mesh.X.cols(); ++node)
    if (mesh.X.col(node) == Vec3::Zero()) mesh.node_sets.push_back({name + ".centre", {node}});  // exact by construction
  return mesh;
}

Mesh wedge_disc(const std::string& name, const WedgeDisc& disc) {
  const Mesh solid = wedge(name, {disc.radius, disc.radius, disc.angle, disc.cells_around, disc.cells_radial, 1, disc.inner_radius});
  return lower_end(solid, name, {{".side", ".rim"}, {".first_plane", ".first_plane"}, {".second_plane", ".second_plane"},
                                 disc.inner_radius > 0 ? std::array<std::string, 2>{".inside", ".inner_rim"}
                                                       : std::array<std::string, 2>{".axis", ".centre"}});
}

Mesh sheet(const std::string& name, const Sheet& sheet) {
  check(sheet.length > 0 && sheet.width > 0, "a sheet needs length and width > 0");
  check(sheet.cells_along > 0 && sheet.cells_across > 0, "a sheet needs at least one cell each way");
  const auto node = [&](int along, int across) { return along + (sheet.cells_along + 1) * across; };
  Mesh mesh;
  mesh.X = Vectors::Zero(3, node(0, sheet.cells_across + 1));
  Facets facets;
  Subset sides[4];  // x_low, x_high, y_low, y_high
  for (int across = 0; across <= sheet.cells_across; ++across) {
    for (int along = 0; along <= sheet.cells_along; ++along) {
      const Index here = node(along, across);
      mesh.X(0, here) = sheet.length * (static_cast<double>(along) / sheet.cells_along);
      mesh.X(1, here) = sheet.width * (static_cast<double>(across) / sheet.cells_across);
      if (along == 0) sides[0].push_back(here);
      if (along == sheet.cells_along) sides[1].push_back(here);
      if (across == 0) sides[2].push_back(here);
      if (across == sheet.cells_across) sides[3].push_back(here);
      if (along == sheet.cells_along || across == sheet.cells_across) continue;
      const int parity = sheet.cuts == Cuts::columns ? along : along + across;
      facets.add({here, node(along + 1, across), node(along + 1, across + 1), node(along, across + 1)},
                 parity % 2 == 0 ? Cut::first_to_third : Cut::second_to_fourth);
    }
  }
  add_sides(mesh, name, facets.table());
  add_set_of_all(mesh, name);
  const char* names[4] = {".x_low", ".x_high", ".y_low", ".y_high"};
  for (int side = 0; side < 4; ++side) mesh.node_sets.push_back({name + names[side], sides[side]});
  return mesh;
}

}  // namespace nereid::mesh
