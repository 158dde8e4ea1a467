#include "input/mesh_readers.hpp"

#include <algorithm>
#include <cmath>

#include "base/words.hpp"
#include "grid/file_mesh.hpp"
#include "input/readers.hpp"
#include "mesh/split.hpp"
#include "model/meshes.hpp"

namespace nereid::input {

namespace {

/// Splits a mesh from a file as `refine` says. Elements that cannot be split are told by their numbers in the file.
void split(const Section& section, const std::string& path, grid::FileMesh& read) {
  const auto factor = static_cast<int>(section.refine_factor());
  const auto& splits = mesh::split_factors;
  if (factor == 1 || std::find(splits.begin(), splits.end(), section.refine_factor()) == splits.end()) return;  // another is a fault
  double elements = 0;
  for (const auto& region : read.mesh.hexahedra) elements += mesh::times_hexahedra(factor) * static_cast<double>(region.nodes.cols());
  for (const auto& region : read.mesh.triangles) elements += mesh::times_triangles(factor) * static_cast<double>(region.nodes.cols());
  const std::string said = "'path' = " + path + ": with 'refine' = " + std::to_string(factor) + " ";
  if (elements > model::most_elements) {
    section.fault("path", said + "the mesh would have " + std::to_string(std::llround(elements)) +
                              " elements: expected at most a hundred million");
    return;
  }
  mesh::Split finer = mesh::split(read.mesh, factor);
  if (!finer.refused.empty()) {
    const mesh::Finding found{mesh::Flaw::unsplittable, finer.refused};
    section.fault("path", said + "it has " + mesh::in_words(found, read.origin, "cells"), mesh::where_shown);
    section.show(mesh::offenders(path, read.mesh, read.origin, {found}));
    return;
  }
  std::vector<std::int64_t> numbers;
  for (const Index parent : finer.parents) numbers.push_back(read.origin.numbers[static_cast<std::size_t>(parent)]);
  read.origin.numbers = std::move(numbers);
  read.mesh = std::move(finer.mesh);
}

/// A mesh without its body's name, with all its faults told at `path`.
mesh::Mesh read_file(const Section& section, const std::string& path, const std::string& region_array, grid::BoundaryCells boundary_cells,
                     mesh::Origin* origin) {
  std::string fault;
  const grid::Contents contents = grid::read_vtu(section.beside_case("path", path), fault);
  if (!fault.empty()) {
    section.fault("path", "'path' = " + path + ": " + fault);
    return {};
  }
  section.saw("path", path, contents.checksum);
  grid::FileMesh read = grid::file_mesh("", contents, region_array, boundary_cells);
  std::string all;
  for (const std::string& one : read.faults) all += (all.empty() ? "" : "; ") + one;
  if (!all.empty()) section.fault("path", "'path' = " + path + ": " + all, read.offenders.numbers.empty() ? "" : mesh::where_shown);
  if (!read.offenders.numbers.empty()) {
    read.offenders.of = path;
    section.show(std::move(read.offenders));
  }
  if (all.empty()) split(section, path, read);
  if (origin != nullptr) *origin = std::move(read.origin);
  return std::move(read.mesh);
}

mesh::SpherePart part(const std::string& word) {
  return word == "full"      ? mesh::SpherePart::full
         : word == "half"    ? mesh::SpherePart::half
         : word == "quarter" ? mesh::SpherePart::quarter
                             : mesh::SpherePart::eighth;
}

/// Numbers of cells between lines; as many as `lines` less one.
std::vector<int> read_cells(const Section& section, const char* key, const char* lines, std::size_t wanted) {
  std::vector<int> cells;
  for (const double number : section.quantities(key, dim::none, between(0, 1e8))) {
    if (number != std::floor(number)) section.fault(key, quote(key) + ": " + shortest(number) + " is no whole number");
    cells.push_back(static_cast<int>(number));
  }
  if (section.sound() && cells.size() != wanted)
    section.fault(key, quote(key) + " has " + counted(cells.size(), "number") + ": expected " + std::to_string(wanted) +
                           ", one between each two of " + quote(lines));
  return cells;
}

std::vector<double> read_lines(const Section& section, const char* key, Range range) {
  const std::vector<double> lines = section.quantities(key, dim::length, range, 2);
  for (std::size_t i = 1; i < lines.size() && section.sound(); ++i)
    if (!(lines[i] > lines[i - 1])) section.fault(key, quote(key) + ": expected ascending lengths");
  return lines;
}

mesh::Revolved read_revolved(const Section& section) {
  mesh::Revolved body{.radii = read_lines(section, "radii", positive), .heights = read_lines(section, "heights", any),
                      .cells_radial = {}, .cells_along = {}, .filled = section.words("filled"),
                      .angle = section.quantity("angle", dim::angle, between(0, 2 * pi * (1 + 1e-12))),
                      .cells_around = section.count("cells_around")};
  const std::size_t radial = body.radii.empty() ? 0 : body.radii.size() - 1, along = body.heights.empty() ? 0 : body.heights.size() - 1;
  body.cells_radial = read_cells(section, "cells_radial", "radii", radial);
  body.cells_along = read_cells(section, "cells_along", "heights", along);
  if (!section.sound()) return body;
  if (body.filled.size() != along)
    section.fault("filled", "'filled' has " + counted(body.filled.size(), "row") + ": expected " + std::to_string(along) +
                                ", from the top down one between each two of 'heights'");
  bool any_filled = false;
  for (const std::string& row : body.filled) {
    const bool plain = row.find_first_not_of("x.") == std::string::npos;
    if (row.size() != radial || !plain)
      section.fault("filled", "'filled': " + quote(row) + ": expected " + counted(radial, "letter") +
                                  ", one between each two of 'radii': x for material, . for none");
    any_filled = any_filled || row.find('x') != std::string::npos;
  }
  if (!any_filled) section.fault("filled", "'filled' has no x: the body is empty");
  if (section.sound() && mesh::has_hinge(body))
    section.fault("filled", "'filled' has rectangles that meet at a corner only: the body would hinge there");
  if (section.sound() && !(body.angle < pi * body.cells_around))
    section.fault_between({"cells_around", "angle"}, "each of the 'cells_around' must take less than half a turn");
  return body;
}

}  // namespace

model::MeshOptions read_mesh_options(const Section& section, mesh::Origin* origin) {
  const std::string kind = section.choice("kind", {"box", "cylinder", "tube", "sector", "revolved", "sphere", "disc", "sheet", "file"});
  const auto is = [&kind](auto... kinds) { return ((kind == kinds) || ...); };
  if (is("revolved")) {
    const mesh::Revolved body = read_revolved(section);
    if (section.sound() && mesh::count(body) > model::most_elements)
      section.fault_between({"cells_around", "cells_radial", "cells_along"}, "the mesh would have " + shortest(mesh::count(body)) +
                                                                               " elements: expected at most a hundred million");
    return body;
  }

  const Section if_box = section.when(is("box"));
  const mesh::Box box{.low = read_vector(if_box, "low", dim::length),
                      .high = read_vector(if_box, "high", dim::length),
                      .cells = Eigen::Vector3i(if_box.counts("cells").data())};
  if (is("box") && section.sound() && !(box.low.array() < box.high.array()).all())
    section.fault_between({"high", "low"}, "'high' must lie beyond 'low' along x, y and z");

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
  if (!section.decided()) turns = {"full", "half", "quarter", "eighth", "sector"};
  const std::string turn_word = section.when(is("cylinder", "tube", "sphere", "disc")).choice("turn", turns);
  const mesh::Revolution turn = turn_word == "full" ? mesh::Revolution::full : mesh::Revolution::quarter;
  const bool sector = is("sector") || (is("tube", "disc") && turn_word == "sector");

  // a `turn` that is missing leaves undecided what follows from it, and nothing else
  const int cells_core = (is("tube", "disc") ? section.when(!sector) : if_core_anyway).count("cells_core");
  const int cells_ring = (is("disc") ? section.when(!sector) : if_core_anyway).count("cells_ring");
  const Section if_sector = section.when(sector), if_ring = section.when(sector && is("sector", "disc"));
  const double angle = if_sector.quantity("angle", dim::angle, between(0, 2 * pi));
  const int cells_around = if_sector.count("cells_around");
  const int cells_radial = if_ring.count("cells_radial");
  const double inner_radius = if_ring.quantity_or("inner_radius", 0, dim::length, not_negative);
  if (sector && section.sound() && !(angle < pi * cells_around))
    section.fault_between({"cells_around", "angle"}, "each of the 'cells_around' must take less than half a turn");
  if (sector && !is("tube") && section.sound() && !(inner_radius < radius))
    section.fault_between({"inner_radius", "radius"}, "'inner_radius' must be below 'radius'");

  const Section if_file = section.when(is("file"));
  const std::string path = if_file.word("path"), region_array = if_file.word_or("region_array", grid::usual_region_array);
  const grid::BoundaryCells boundary_cells = if_file.choice_or("boundary_cells", "surfaces", {"surfaces", "plates"}) == "plates"
                                                 ? grid::BoundaryCells::plates
                                                 : grid::BoundaryCells::surfaces;

  model::MeshOptions options = box;
  if (is("file") && !path.empty()) options = read_file(section, path, region_array, boundary_cells, origin);
  if (is("cylinder")) options = mesh::Cylinder{radius, length, turn, cells_core, cells_ring, cells_along};
  if (is("tube")) options = mesh::Tube{radius, length, turn, cells_core, cells_along};
  if (is("tube") && sector) options = mesh::WedgeTube{radius, length, angle, cells_around, cells_along};
  if (is("sector")) options = mesh::Wedge{radius, length, angle, cells_around, cells_radial, cells_along, inner_radius};
  if (is("sphere")) options = mesh::Sphere{radius, part(turn_word), cells_core, cells_ring};
  if (is("disc")) options = mesh::Disc{radius, turn, cells_core, cells_ring};
  if (is("disc") && sector) options = mesh::WedgeDisc{radius, angle, cells_around, cells_radial, inner_radius};
  if (is("sheet"))
    options = mesh::Sheet{length, width, cells_along, cells_across, crossed ? mesh::Cuts::crossed : mesh::Cuts::columns};

  const double count = model::count_elements(options);
  if (section.sound() && count > model::most_elements)
    section.fault_between({is("box") ? "cells" : is("file") ? "path" : sector ? "cells_around" : is("sheet") ? "cells_along" : "cells_core",
                           "cells_ring", "cells_radial", "cells_along", "cells_across"},
                          "the mesh would have " + std::to_string(std::llround(std::min(count, 1e18))) +
                              " elements: expected at most a hundred million");
  return options;
}

double read_scale(const Section& mesh) { return mesh.quantity_or("scale", 1, dim::length, positive); }

model::Field read_map(const Section& mesh) {
  return mesh.has("map") ? read_expressions(mesh, "map", of_place, {1, dim::length}) : model::Field{};
}

}  // namespace nereid::input
