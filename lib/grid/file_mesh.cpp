#include "grid/file_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "grid/boundary.hpp"
#include "grid/file_sets.hpp"
#include "mesh/facets.hpp"
#include "mesh/skin.hpp"

namespace nereid::grid {
namespace {

using mesh::Facets;

constexpr int vertex = 1, line = 3, triangle = 5, quadrilateral = 9, hexahedron = 12;  // VTK's numbers
constexpr std::size_t most_named = 8;  // of the cells at fault: enough to find them, few enough for a line

std::string kind_name(int kind) {
  static const std::map<int, std::string> names{
      {0, "empty cells"}, {2, "groups of vertices"}, {4, "polylines"}, {6, "triangle strips"},
      {7, "polygons"}, {8, "pixels"}, {10, "tetrahedra"}, {11, "voxels"}, {13, "wedges"}, {14, "pyramids"},
      {15, "pentagonal prisms"}, {16, "hexagonal prisms"}, {21, "quadratic edges"}, {22, "quadratic triangles"},
      {23, "quadratic quadrilaterals"}, {24, "quadratic tetrahedra"}, {25, "quadratic hexahedra"}, {26, "quadratic wedges"},
      {27, "quadratic pyramids"}, {28, "biquadratic quadrilaterals"}, {29, "triquadratic hexahedra"}, {42, "polyhedra"}};
  const auto found = names.find(kind);
  return found == names.end() ? "cells of VTK's kind " + std::to_string(kind) : found->second;
}

std::string listed(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

std::string numbers(const std::vector<std::int64_t>& cells) {
  std::string text;
  for (std::size_t i = 0; i < std::min(cells.size(), most_named); ++i) text += (i == 0 ? "" : ", ") + std::to_string(cells[i]);
  return text + (cells.size() > most_named ? ", …" : "");
}

/// Cells at fault, by their numbers in the file.
struct Wrong {
  std::vector<std::int64_t> cells;
  void tell(const std::string& what, std::vector<std::string>& faults) const {
    if (!cells.empty()) faults.push_back(std::to_string(cells.size()) + what + numbers(cells));
  }
};

/// Elements of one region, in the order of the file, and the cells they are.
struct Part {
  std::vector<std::array<Index, 8>> hexahedra;
  Facets triangles;
  std::vector<std::int64_t> cell_of_hexahedron, cell_of_triangle;
};

Table<8> table(const std::vector<std::array<Index, 8>>& columns) {
  return Eigen::Map<const Table<8>>(columns.empty() ? nullptr : columns[0].data(), 8, static_cast<Eigen::Index>(columns.size()));
}

const Field* array_called(const std::vector<Field>& fields, const std::string& name) {
  const auto at = std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
  return at == fields.end() ? nullptr : &*at;
}

bool whole(const Field& field) {
  return field.values.rows() == 1 && field.values.allFinite() && (field.values.array() == field.values.array().round()).all();
}

/// Whether the halves of a quadrilateral that is cut from its first corner to its third face away from each other.
bool is_folded(const Vectors& X, const std::array<Index, 4>& at) {
  const Vec3 a = X.col(at[0]), cut = X.col(at[2]) - a;
  return (X.col(at[1]) - a).cross(cut).dot(cut.cross(X.col(at[3]) - a)) < 0;
}

/// Where to cut a quadrilateral: from its first corner, unless that folds it and the other cut does not.
mesh::Cut cut_of(const Vectors& X, const std::array<Index, 4>& at) {
  const bool other = is_folded(X, at) && !is_folded(X, {at[1], at[2], at[3], at[0]});
  return other ? mesh::Cut::second_to_fourth : mesh::Cut::first_to_third;
}

/// What a group of cells of a dimension is called: by its name in the file, else by its number, or without one.
std::string group_name(const Contents& file, int dimension, int number, const std::string& usual) {
  const std::map<int, std::string> names = group_names(file, dimension);
  const auto found = names.find(number);
  return found != names.end() ? found->second : number < 0 ? usual : usual + "_" + std::to_string(number);
}

/// The points of lines and single points, by dimension and number.
using PointsOfGroups = std::map<std::array<int, 2>, std::set<Index>>;

/// Cells by region and kind; -1 stands for the one region of a file without regions.
std::map<int, Part> parts(const Contents& file, const std::string& region_array, PointsOfGroups& of_groups,
                          std::vector<std::string>& faults) {
  const Field* region = array_called(file.cell_fields, region_array);
  if (region == nullptr && region_array != usual_region_array) {
    std::vector<std::string> there;
    for (const Field& field : file.cell_fields) there.push_back("'" + field.name + "'");
    faults.push_back("it has no cell array '" + region_array + "'" + (there.empty() ? "" : "; there are " + listed(there)));
  }
  if (region != nullptr && region->values.size() > 0 &&
      !(whole(*region) && region->values.minCoeff() >= 0 && region->values.maxCoeff() <= 1e9)) {
    faults.push_back("its cell array '" + region_array + "' does not hold one whole number, 0 or above, a cell");
    region = nullptr;
  }
  std::map<int, Part> found;
  std::map<int, std::int64_t> others;
  Wrong torn;
  for (std::size_t c = 0; c < file.kind.size(); ++c) {
    const auto cell = static_cast<std::int64_t>(c);
    const Index* nodes = file.nodes.data() + file.begin[c];
    const int kind = file.kind[c], number = region == nullptr ? -1 : static_cast<int>(region->values(0, cell));
    if (kind == line || kind == vertex) {
      of_groups[{kind == line ? 1 : 0, number}].insert(nodes, file.nodes.data() + file.begin[c + 1]);
      continue;
    }
    if (kind != triangle && kind != quadrilateral && kind != hexahedron) {
      ++others[kind];
      continue;
    }
    if (file.begin[c + 1] - file.begin[c] != (kind == hexahedron ? 8 : kind == quadrilateral ? 4 : 3)) {
      torn.cells.push_back(cell);
      continue;
    }
    Part& part = found[number];
    if (kind == hexahedron) {
      auto& to = part.hexahedra.emplace_back();
      std::copy_n(nodes, 8, to.begin());
      part.cell_of_hexahedron.push_back(cell);
    } else if (kind == triangle) {
      part.triangles.add(nodes[0], nodes[1], nodes[2]);
      part.cell_of_triangle.push_back(cell);
    } else {
      const std::array<Index, 4> at{nodes[0], nodes[1], nodes[2], nodes[3]};
      part.triangles.add(at, cut_of(file.points, at));
      part.cell_of_triangle.insert(part.cell_of_triangle.end(), 2, cell);
    }
  }
  torn.tell(" of its cells have another number of points than their kind: cells ", faults);
  if (!others.empty()) {
    std::vector<std::string> said;
    for (const auto& [kind, count] : others) said.push_back(std::to_string(count) + " " + kind_name(kind));
    faults.push_back("it has " + listed(said) + "; expected hexahedra, triangles and quadrilaterals");
  } else if (file.kind.empty()) {
    faults.push_back("it has no cells");
  } else if (found.empty() && torn.cells.empty()) {
    faults.push_back("it has lines and points only; expected hexahedra, triangles and quadrilaterals");
  }
  return found;
}

/// Takes from the parts those triangles that are a boundary of solids.
std::vector<Boundary> take_boundaries(const Contents& file, std::map<int, Part>& parts, std::vector<std::string>& faults) {
  std::vector<std::array<Index, 8>> hexahedra;
  for (const auto& [number, part] : parts) hexahedra.insert(hexahedra.end(), part.hexahedra.begin(), part.hexahedra.end());
  const FacesOfSolids faces(hexahedra);
  std::vector<Boundary> boundaries;
  Wrong half;
  for (auto& [number, part] : parts) {
    const Table<3> triangles = part.triangles.table();
    std::set<Corners> marked;
    for (const auto& t : triangles.colwise()) marked.insert(corners(t(0), t(1), t(2)));
    Boundary boundary{group_name(file, 2, number, "boundary"), {}};
    std::int64_t on = 0;
    for (Eigen::Index i = 0; i < triangles.cols(); ++i) {
      const Corners one = corners(triangles(0, i), triangles(1, i), triangles(2, i));
      if (!faces.has(one)) continue;
      ++on;
      const std::int64_t cell = part.cell_of_triangle[static_cast<std::size_t>(i)];
      if (!faces.is_covered(one, marked) && (half.cells.empty() || half.cells.back() != cell)) half.cells.push_back(cell);
      faces.add_to(boundary, one);
    }
    if (on == 0) continue;
    if (on < triangles.cols()) {
      faults.push_back((number < 0 ? std::string("its") : "of its region " + std::to_string(number) + " the") +
                       " triangles and quadrilaterals lie on faces of hexahedra in part; give those another number in the region array, "
                       "or say 'boundary_cells: plates'");
      continue;
    }
    part.triangles = {};
    part.cell_of_triangle.clear();
    boundaries.push_back(std::move(boundary));
  }
  half.tell(" of its triangles and quadrilaterals, with those of the same number, cover a part of a face of a hexahedron only: cells ",
            faults);
  return boundaries;
}

/// Adds the regions to a mesh that has its points.
void add_regions(const std::string& name, const Contents& file, const std::map<int, Part>& parts, mesh::Mesh& mesh,
                 std::vector<std::string>& faults) {
  for (const auto& [number, part] : parts) {
    const Table<3> triangles = part.triangles.table();
    const bool solid = !part.hexahedra.empty(), plates = triangles.cols() > 0;
    if (solid && plates && number >= 0)
      faults.push_back("its region " + std::to_string(number) + " holds solids and plates; give them different numbers");
    const std::string region = number < 0 ? name : name + "." + group_name(file, solid ? 3 : 2, number, "region");
    if (solid) mesh.hexahedra.push_back({plates ? name + ".hexahedra" : region, table(part.hexahedra)});
    if (plates) mesh.triangles.push_back({solid ? name + ".triangles" : region, triangles});
  }
}

/// What the elements of a mesh that add_regions() made are called in the file.
std::vector<std::int64_t> numbers_of(const std::map<int, Part>& parts) {
  std::vector<std::int64_t> numbers;
  for (const auto& [number, part] : parts) numbers.insert(numbers.end(), part.cell_of_hexahedron.begin(), part.cell_of_hexahedron.end());
  for (const auto& [number, part] : parts) numbers.insert(numbers.end(), part.cell_of_triangle.begin(), part.cell_of_triangle.end());
  return numbers;
}

/// Says which cells are no elements.
void judge(FileMesh& result) {
  const std::vector<mesh::Finding> found = mesh::refused(mesh::judge(result.mesh, result.origin));
  for (const mesh::Finding& one : found) result.faults.push_back("it has " + mesh::in_words(one, result.origin, "cells"));
  if (!found.empty()) result.offenders = mesh::offenders("", result.mesh, result.origin, found);
}

/// Says which triangles have nodes of their own at those of a face of hexahedra: a boundary whose nodes were not merged.
void refuse_loose_boundaries(FileMesh& result) {
  const mesh::Mesh& mesh = result.mesh;
  if (mesh.hexahedra.empty() || mesh.triangles.empty()) return;
  const std::vector<Index> place = mesh::places(mesh);
  const auto at = [&](Index node) { return place[static_cast<std::size_t>(node)]; };
  std::vector<std::array<Index, 8>> hexahedra;
  for (const auto& region : mesh.hexahedra)
    for (const auto& nodes : region.nodes.colwise())
      for (auto& to = hexahedra.emplace_back(); const int a : {0, 1, 2, 3, 4, 5, 6, 7}) to[static_cast<std::size_t>(a)] = at(nodes(a));
  const FacesOfSolids faces(hexahedra);
  Wrong loose;
  mesh::Finding found{mesh::Flaw::coincident, {}};
  std::size_t element = hexahedra.size();
  for (const auto& region : mesh.triangles)
    for (const auto& t : region.nodes.colwise()) {
      const std::size_t here = element++;
      const std::int64_t cell = result.origin.numbers[here];
      if (!faces.has(corners(at(t(0)), at(t(1)), at(t(2))))) continue;
      found.elements.push_back(static_cast<Index>(here));
      if (loose.cells.empty() || loose.cells.back() != cell) loose.cells.push_back(cell);
    }
  loose.tell(" of its triangles and quadrilaterals lie on faces of hexahedra and have nodes of their own; merge the nodes, or say "
             "'boundary_cells: plates': cells ", result.faults);
  if (!found.elements.empty() && result.offenders.numbers.empty())
    result.offenders = mesh::offenders("", mesh, result.origin, {found});
}

/// New number of each point, or -1 for one of no cell; they keep their order.
std::vector<Index> drop_lonely_points(mesh::Mesh& mesh) {
  std::vector<Index> number(static_cast<std::size_t>(mesh.X.cols()), -1);
  const auto mark = [&](const auto& nodes) {
    for (const Index node : nodes.reshaped()) number[static_cast<std::size_t>(node)] = 0;
  };
  for (const auto& region : mesh.hexahedra) mark(region.nodes);
  for (const auto& region : mesh.triangles) mark(region.nodes);
  Index next = 0;
  for (Index& one : number) one = one < 0 ? -1 : next++;
  for (std::size_t point = 0; point < number.size(); ++point)
    if (number[point] >= 0) mesh.X.col(number[point]) = mesh.X.col(static_cast<Index>(point));  // never behind itself
  mesh.X.conservativeResize(3, next);
  const auto renumber = [&](auto& nodes) {
    for (Index& node : nodes.reshaped()) node = number[static_cast<std::size_t>(node)];
  };
  for (auto& region : mesh.hexahedra) renumber(region.nodes);
  for (auto& region : mesh.triangles) renumber(region.nodes);
  return number;
}

/// The facets all of whose corners are in the set.
Table<3> facets_within(const Table<3>& facets, const std::vector<char>& in_set) {
  Facets inside;
  for (Index f = 0; f < facets.cols(); ++f) {
    const auto has = [&](int a) { return in_set[static_cast<std::size_t>(facets(a, f))] != 0; };
    if (has(0) && has(1) && has(2)) inside.add(facets(0, f), facets(1, f), facets(2, f));
  }
  return inside.table();
}

void add_surface(mesh::Mesh& mesh, const std::string& name, const Table<3>& facets) {
  if (facets.cols() > 0) mesh.surfaces.push_back({name, facets});
}

void add_names(const std::string& name, const std::vector<FileSet>& sets, const std::vector<Boundary>& boundaries,
               const std::vector<Index>& number, mesh::Mesh& mesh, std::vector<std::string>& faults) {
  const mesh::Skin skin = mesh::skin(mesh.X, mesh.hexahedra);
  Table<3> plates(3, 0);
  for (const auto& region : mesh.triangles) {
    const Eigen::Index before = plates.cols();
    plates.conservativeResize(3, before + region.nodes.cols());
    plates.rightCols(region.nodes.cols()) = region.nodes;
  }
  add_set_of_all(mesh, name);
  add_surface(mesh, name + ".skin", skin.facets);
  if (skin.facets.cols() > 0) mesh.node_sets.push_back({name + ".skin", mesh::surface_nodes(mesh.surfaces.back())});
  add_surface(mesh, name + ".top", plates);
  add_surface(mesh, name + ".bottom", mesh::reversed(plates));
  const auto add_set = [&](const std::string& set, const Subset& nodes) {
    std::vector<char> in_set(static_cast<std::size_t>(mesh.X.cols()), 0);
    for (const Index node : nodes) in_set[static_cast<std::size_t>(node)] = 1;
    mesh.node_sets.push_back({set, nodes});
    add_surface(mesh, set, facets_within(skin.facets, in_set));
    const Table<3> top = facets_within(plates, in_set);
    add_surface(mesh, set + "_top", top);
    add_surface(mesh, set + "_bottom", mesh::reversed(top));
  };
  const auto add_region = [&](const auto& region) {
    if (region.name == name) return;  // the set of all
    const std::set<Index> nodes(region.nodes.data(), region.nodes.data() + region.nodes.size());
    add_set(region.name, {nodes.begin(), nodes.end()});
  };
  for (const auto& region : mesh.hexahedra) add_region(region);
  for (const auto& region : mesh.triangles) add_region(region);
  for (const Boundary& boundary : boundaries) {
    mesh.node_sets.push_back({name + "." + boundary.name, nodes_on(boundary)});
    add_surface(mesh, name + "." + boundary.name, facets_on(skin.facets, boundary));
  }
  for (const FileSet& set : sets) {
    Subset nodes;
    for (const Index point : set.points)
      if (const Index node = number[static_cast<std::size_t>(point)]; node >= 0) nodes.push_back(node);
    if (!nodes.empty()) add_set(name + "." + set.name, nodes);  // else only points of no element
  }
  const auto twice = [&](const auto& all, const char* kind) {
    std::set<std::string> names;
    for (const auto& one : all)
      if (!names.insert(one.name).second)
        faults.push_back(std::string("it makes two ") + kind + " called '" + one.name.substr(name.size()) +
                         "'; call one of them something else");
  };
  twice(mesh.node_sets, "node sets");
  twice(mesh.surfaces, "surfaces");
}

}  // namespace

FileMesh file_mesh(const std::string& name, const Contents& file, const std::string& region_array, BoundaryCells boundary_cells) {
  FileMesh result;
  result.mesh.X = file.points;
  if (!file.points.allFinite()) result.faults.push_back("some of its points are no numbers");
  PointsOfGroups of_groups;
  std::map<int, Part> found = parts(file, region_array, of_groups, result.faults);
  std::vector<Boundary> boundaries;
  if (boundary_cells == BoundaryCells::surfaces) boundaries = take_boundaries(file, found, result.faults);
  if (file.points.allFinite()) {
    add_regions(name, file, found, result.mesh, result.faults);
    result.origin.numbers = numbers_of(found);
    judge(result);
    if (boundary_cells == BoundaryCells::surfaces && result.faults.empty()) refuse_loose_boundaries(result);
  }
  if (result.faults.empty()) {
    const std::vector<Index> number = drop_lonely_points(result.mesh);
    result.origin.lonely = std::count(number.begin(), number.end(), -1);
    for (Boundary& boundary : boundaries) renumber(boundary, number);
    std::vector<FileSet> sets = point_sets(file, result.origin.doubts);
    for (const auto& [group, points] : of_groups)
      sets.push_back({group_name(file, group[0], group[1], group[0] == 1 ? "lines" : "points"), {points.begin(), points.end()}});
    for (const std::string& doubt : unused_regions(file, region_array)) result.origin.doubts.push_back(doubt);
    add_names(name, sets, boundaries, number, result.mesh, result.faults);
  }
  if (!result.faults.empty()) result.mesh = {};
  return result;
}

}  // namespace nereid::grid
