#include "output/offenders.hpp"

#include <gtest/gtest.h>

#include "mesh/box.hpp"
#include "mesh/disc.hpp"
#include "output/run_folder.hpp"

namespace nereid::output::offenders_test {
namespace {

namespace fs = std::filesystem;

std::vector<mesh::Offenders> two_meshes() {
  const mesh::Mesh brick = mesh::box("b", {Vec3::Zero(), Vec3(2, 1, 1), {2, 1, 1}});
  const mesh::Mesh both = mesh::join(brick, mesh::sheet("s", {1, 1, 1, 1}));
  return {mesh::offenders("one", brick, {{7, 8}, 0}, {{mesh::Flaw::inverted, {1}}}),
          mesh::offenders("two", both, {}, {{mesh::Flaw::hinged, {0, 3}}, {mesh::Flaw::inverted, {3}}})};
}

TEST(OffendersGrid, HasElementsOfAllMeshesWithTheirNumbersAndAFieldForEachFlaw) {
  const grid::Grid shown = grid_of(two_meshes());
  ASSERT_EQ(shown.cells.size(), 3U);
  EXPECT_EQ(shown.reference.cols(), 8 + 8 + 3);
  EXPECT_EQ(shown.cells[1].nodes.minCoeff(), 8);
  const auto field = [&](std::size_t f) { return Eigen::RowVector3d(shown.cell_fields[f].values); };
  ASSERT_EQ(shown.cell_fields.size(), 4U);
  EXPECT_EQ(shown.cell_fields[0].name, "number");
  EXPECT_EQ(field(0), Eigen::RowVector3d(8, 0, 3));
  EXPECT_EQ(field(1), Eigen::RowVector3d(0, 1, 1));
  EXPECT_EQ(shown.cell_fields[2].name, "inverted");
  EXPECT_EQ(field(2), Eigen::RowVector3d(1, 0, 1));
  EXPECT_EQ(shown.cell_fields[3].name, "hinged");
  EXPECT_EQ(field(3), Eigen::RowVector3d(0, 1, 1));
}

TEST(OffendersFiles, AreResultsOfTheFolderAndOnlyWrittenIfThereAreAny) {
  const fs::path folder = fs::path(testing::TempDir()) / "nereid_offenders";
  fs::remove_all(folder);
  write_offenders(folder, {});
  EXPECT_FALSE(fs::exists(folder));
  if (!grid::vtk_available()) GTEST_SKIP() << "built without VTK";
  write_offenders(folder, two_meshes());
  EXPECT_EQ(result_files(folder), (std::vector<fs::path>{folder / "offenders/offenders_000000.vtu", folder / "offenders.pvd"}));
  std::string fault;
  EXPECT_EQ(grid::read_vtu(folder / "offenders/offenders_000000.vtu", fault).kind, (std::vector<int>{12, 12, 5}));
  write_offenders(folder, {});
  EXPECT_TRUE(result_files(folder).empty()) << "they would be taken for those of this run";
}

}  // namespace
}  // namespace nereid::output::offenders_test
