#include "input/mesh_readers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "grid/file_mesh.hpp"
#include "input/readers.hpp"
#include "mesh/skin.hpp"

namespace nereid::input {

namespace {

constexpr double most_elements = 1e8;  // their memory is some 100 GB, and node numbers still fit an Index

// Elements that a mesh will have, in floating point because what is typed may be absurd.
double parts(mesh::Turn turn) { return turn == mesh::Turn::full ? 4 : 1; }

double cells_of_quarter(double core, double ring) { return core * core + 2 * core * ring; }

double elements(const mesh::Box& box) { return box.cells.cast<double>().prod(); }
double elements(const mesh::Cylinder& c) { return parts(c.turn) * cells_of_quarter(c.cells_core, c.cells_ring) * c.cells_along; }
double elements(const mesh::Tube& t) { return parts(t.turn) * 4.0 * t.cells_core * t.cells_along; }
double elements(const mesh::Wedge& w) { return 1.0 * w.cells_around * w.cells_radial * w.cells_along; }
double elements(const mesh::WedgeTube& t) { return 2.0 * t.cells_around * t.cells_along; }
double elements(const mesh::Sphere& s) {
  const double core = s.cells_core;
  return (s.part == mesh::SpherePart::full      ? 8
          : s.part == mesh::SpherePart::half    ? 4
          : s.part == mesh::SpherePart::quarter ? 2
                                                : 1) *
         core * core * (core + 3.0 * s.cells_ring);
}
double elements(const mesh::Disc& d) { return 2 * parts(d.turn) * cells_of_quarter(d.cells_core, d.cells_ring); }
double elements(const mesh::WedgeDisc& d) { return 2.0 * d.cells_around * d.cells_radial; }
double elements(const mesh::Sheet& s) { return 2.0 * s.cells_along * s.cells_across; }
double elements(const mesh::Mesh& m) {
  double sum = 0;
  for (const auto& region : m.hexahedra) sum += static_cast<double>(region.nodes.cols());
  for (const auto& region : m.triangles) sum += static_cast<double>(region.nodes.cols());
  return sum;
}

/// A mesh without its body's name, with all its faults told at `path`.
mesh::Mesh read_file(const Section& section, const std::string& path, const std::string& region_array) {
  std::string fault;
  const grid::Contents contents = grid::read_vtu(section.beside_case(path), fault);
  if (!fault.empty()) {
    section.fault("path", "'path' = " + path + ": " + fault);
    return {};
  }
  grid::FileMesh read = grid::file_mesh("", contents, region_array);
  std::string all;
  for (const std::string& one : read.faults) all += (all.empty() ? "" : "; ") + one;
  if (!all.empty()) section.fault("path", "'path' = " + path + ": " + all);
  return std::move(read.mesh);
}

mesh::Mesh with_names(const std::string& name, mesh::Mesh mesh) {
  const auto prefix = [&name](auto& all) {
    for (auto& one : all) one.name = name + one.name;
  };
  prefix(mesh.hexahedra), prefix(mesh.triangles), prefix(mesh.surfaces), prefix(mesh.node_sets);
  return mesh;
}

mesh::SpherePart part(const std::string& word) {
  return word == "full"      ? mesh::SpherePart::full
         : word == "half"    ? mesh::SpherePart::half
         : word == "quarter" ? mesh::SpherePart::quarter
                             : mesh::SpherePart::eighth;
}

}  // namespace

MeshOptions read_mesh_options(const Section& section) {
  const std::string kind = section.choice("kind", {"box", "cylinder", "tube", "sector", "sphere", "disc", "sheet", "file"});
  const auto is = [&kind](auto... kinds) { return ((kind == kinds) || ...); };

  const Section if_box = section.when(is("box"));
  const mesh::Box box{.low = read_vector(if_box, "low", dim::length),
                      .high = read_vector(if_box, "high", dim::length),
                      .cells = Eigen::Vector3i(if_box.counts("cells").data())};
  if (is("box") && section.sound() && !(box.low.array() < box.high.array()).all())
    section.fault("high", "'high' must lie beyond 'low' along x, y and z");

  const double radius = section.when(!is("box", "sheet", "file")).quantity("radius", dim::length, positive);
  const double length = section.when(is("cylinder", "tube", "sector", "sheet")).quantity("length", dim::length, positive);
  const Section if_sheet = section.when(is("sheet"));
  const double width = if_sheet.quantity("width", dim::length, positive);
  const int cells_across = if_sheet.count("cells_across");
  const bool crossed = if_sheet.choice_or("cuts", "columns", {"columns", "crossed"}) == "crossed";
  const int cells_along = section.when(is("cylinder", "tube", "sector", "sheet")).count("cells_along");

  const Section if_core_anyway = section.when(is("cylinder", "sphere"));
  std::vector<std::string> turns{"full", "quarter"};
  if (is("tube", "disc")) turns.push_back("sector");
  if (is("sphere")) turns = {"full", "half", "quarter", "eighth"};
  const std::string turn_word = section.when(is("cylinder", "tube", "sphere", "disc")).choice("turn", turns);
  const mesh::Turn turn = turn_word == "full" ? mesh::Turn::full : mesh::Turn::quarter;
  const bool sector = is("sector") || (is("tube", "disc") && turn_word == "sector");

  // a turn that is missing leaves undecided what follows from it, and nothing else
  const int cells_core = (is("tube", "disc") ? section.when(!sector) : if_core_anyway).count("cells_core");
  const int cells_ring = (is("disc") ? section.when(!sector) : if_core_anyway).count("cells_ring");
  const Section if_sector = section.when(sector), if_ring = section.when(sector && is("sector", "disc"));
  const double angle = if_sector.quantity("angle", dim::angle, between(0, 2 * pi));
  const int cells_around = if_sector.count("cells_around");
  const int cells_radial = if_ring.count("cells_radial");
  const double inner_radius = if_ring.quantity_or("inner_radius", 0, dim::length, not_negative);
  if (sector && section.sound() && !(angle < pi * cells_around))
    section.fault("cells_around", "each of the 'cells_around' must take less than half a turn");
  if (sector && !is("tube") && section.sound() && !(inner_radius < radius))
    section.fault("inner_radius", "'inner_radius' must be below 'radius'");

  const Section if_file = section.when(is("file"));
  const std::string path = if_file.word("path"), region_array = if_file.word_or("region_array", "region");

  MeshOptions options = box;
  if (is("file") && !path.empty()) options = read_file(section, path, region_array);
  if (is("cylinder")) options = mesh::Cylinder{radius, length, turn, cells_core, cells_ring, cells_along};
  if (is("tube")) options = mesh::Tube{radius, length, turn, cells_core, cells_along};
  if (is("tube") && sector) options = mesh::WedgeTube{radius, length, angle, cells_around, cells_along};
  if (is("sector")) options = mesh::Wedge{radius, length, angle, cells_around, cells_radial, cells_along, inner_radius};
  if (is("sphere")) options = mesh::Sphere{radius, part(turn_word), cells_core, cells_ring};
  if (is("disc")) options = mesh::Disc{radius, turn, cells_core, cells_ring};
  if (is("disc") && sector) options = mesh::WedgeDisc{radius, angle, cells_around, cells_radial, inner_radius};
  if (is("sheet"))
    options = mesh::Sheet{length, width, cells_along, cells_across, crossed ? mesh::Cuts::crossed : mesh::Cuts::columns};

  const double count = std::visit([](const auto& one) { return elements(one); }, options);
  if (section.sound() && count > most_elements)
    section.fault(is("box") ? "cells" : is("file") ? "path" : sector ? "cells_around" : is("sheet") ? "cells_along" : "cells_core",
                  "the mesh would have " + std::to_string(std::llround(std::min(count, 1e18))) +
                      " elements: expected at most a hundred million");
  return options;
}

mesh::Mesh make_mesh(const std::string& name, const MeshOptions& options) {
  struct Make {
    const std::string& name;
    mesh::Mesh operator()(const mesh::Box& one) const { return mesh::box(name, one); }
    mesh::Mesh operator()(const mesh::Cylinder& one) const { return mesh::cylinder(name, one); }
    mesh::Mesh operator()(const mesh::Tube& one) const { return mesh::tube(name, one); }
    mesh::Mesh operator()(const mesh::Wedge& one) const { return mesh::wedge(name, one); }
    mesh::Mesh operator()(const mesh::WedgeTube& one) const { return mesh::wedge_tube(name, one); }
    mesh::Mesh operator()(const mesh::Sphere& one) const { return mesh::sphere(name, one); }
    mesh::Mesh operator()(const mesh::Disc& one) const { return mesh::disc(name, one); }
    mesh::Mesh operator()(const mesh::WedgeDisc& one) const { return mesh::wedge_disc(name, one); }
    mesh::Mesh operator()(const mesh::Sheet& one) const { return mesh::sheet(name, one); }
    mesh::Mesh operator()(const mesh::Mesh& one) const { return with_names(name, one); }
  };
  return std::visit(Make{name}, options);
}

std::optional<MeshMap> read_map(const Section& mesh) {
  if (!mesh.has("map")) return std::nullopt;
  return MeshMap{.at = mesh, .to = read_expressions(mesh, "map", of_place)};
}

mesh::Mesh mapped(const MeshMap& map, mesh::Mesh mesh) {
  std::array<char, 300> text{};
  Vectors X(3, mesh.X.cols());
  for (Eigen::Index node = 0; node < X.cols(); ++node) {
    const Vec3 from = mesh.X.col(node);
    for (int axis = 0; axis < 3; ++axis) X(axis, node) = map.to[axis](from.x(), from.y(), from.z(), 0);
    if (X.col(node).allFinite()) continue;
    std::snprintf(text.data(), text.size(), "'map' is no finite number at x = %.6g, y = %.6g, z = %.6g", from.x(), from.y(), from.z());
    map.at.fault("map", text.data());
    return mesh;
  }
  const Vectors built = mesh.X;
  mesh.X = X;
  int wrong = 0;
  const auto look_at = [&](const auto& region, const Scalars& size, const char* what) {
    for (Eigen::Index element = 0; element < size.size(); ++element) {
      if (size(element) > 0 || wrong++ > 0) continue;
      Vec3 from = Vec3::Zero(), to = Vec3::Zero();
      for (const Index node : region.nodes.col(element)) from += built.col(node), to += X.col(node);
      from /= region.nodes.rows(), to /= region.nodes.rows();
      std::snprintf(text.data(), text.size(),
                    "'map' leaves element %lld of '%s' no positive %s: %.4g. "
                    "Its middle goes from (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g) m",
                    static_cast<long long>(element), region.name.c_str(), what, size(element), from.x(), from.y(), from.z(), to.x(),
                    to.y(), to.z());
    }
  };
  for (const mesh::Hexahedra& region : mesh.hexahedra) look_at(region, mesh::volumes(mesh, region), "volume");
  for (const mesh::Triangles& region : mesh.triangles) look_at(region, mesh::facet_areas(mesh, {"", region.nodes}), "area");
  if (wrong == 0) return mesh;
  map.at.fault("map", text.data() + (wrong > 1 ? ", and " + std::to_string(wrong - 1) + " more" : std::string()));
  mesh.X = built;
  return mesh;
}

}  // namespace nereid::input
