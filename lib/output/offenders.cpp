#include "output/offenders.hpp"

#include <algorithm>
#include <system_error>

#include "base/check.hpp"

namespace nereid::output {

grid::Grid grid_of(const std::vector<mesh::Offenders>& all) {
  grid::Grid grid;
  std::size_t count = 0;
  std::int32_t flaws = 0;
  for (const mesh::Offenders& one : all) {
    count += one.numbers.size();
    for (const std::int32_t flaw : one.flaws) flaws |= flaw;
  }
  const auto cells = static_cast<Eigen::Index>(count);
  const auto field = [&](const char* name) { return Field{name, "1", {}, Eigen::MatrixXd::Zero(1, cells), true}; };
  grid.cell_fields = {field("number"), field("mesh")};
  std::vector<int> shown;
  for (int flaw = 0; flaw < static_cast<int>(mesh::flaw_words.size()); ++flaw)
    if ((flaws >> flaw & 1) != 0)
      shown.push_back(flaw), grid.cell_fields.push_back(field(mesh::flaw_words[static_cast<std::size_t>(flaw)].name));
  Eigen::Index cell = 0;
  for (std::size_t m = 0; m < all.size(); ++m) {
    const mesh::Offenders& one = all[m];
    const auto first = static_cast<Index>(grid.reference.cols());
    grid.reference.conservativeResize(3, first + one.X.cols());
    grid.reference.rightCols(one.X.cols()) = one.X;
    if (one.hexahedra.cols() > 0) grid.cells.push_back({grid::CellKind::hexahedron, (one.hexahedra.array() + first).matrix()});
    if (one.triangles.cols() > 0) grid.cells.push_back({grid::CellKind::triangle, (one.triangles.array() + first).matrix()});
    for (std::size_t e = 0; e < one.numbers.size(); ++e, ++cell) {
      grid.cell_fields[0].values(0, cell) = static_cast<double>(one.numbers[e]);
      grid.cell_fields[1].values(0, cell) = static_cast<double>(m);
      for (std::size_t f = 0; f < shown.size(); ++f) grid.cell_fields[f + 2].values(0, cell) = one.flaws[e] >> shown[f] & 1;
    }
  }
  grid.displacement = Vectors::Zero(3, grid.reference.cols());
  return grid;
}

void write_offenders(const std::filesystem::path& directory, const std::vector<mesh::Offenders>& all) {
  if (directory.empty()) return;
  for (const std::filesystem::path& file : grid::collection_files(directory, "offenders")) {
    std::error_code error;
    std::filesystem::remove(file, error);
    if (error) throw MachineError("cannot remove " + file.string() + ": " + error.message());
  }
  const bool any = std::any_of(all.begin(), all.end(), [](const mesh::Offenders& one) { return !one.numbers.empty(); });
  if (any) grid::Collection(directory, "offenders", grid::GridKind::volume).add(grid_of(all));
}

}  // namespace nereid::output
