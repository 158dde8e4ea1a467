#include "grid/frame_text.hpp"

#include <gtest/gtest.h>

#include "base/check.hpp"
#include "grid/vtu_check.hpp"

namespace nereid::grid::frame_text_test {
namespace {

/// Nodes of a line of hexahedra, so many that their arrays take several packed blocks.
Grid bar(double time) {
  constexpr Index cells = 3000;
  Grid grid;
  grid.time = time;
  grid.reference.resize(3, 4 * (cells + 1));
  for (Index n = 0; n < grid.reference.cols(); ++n) grid.reference.col(n) << n / 4, n % 4 / 2, n % 2;
  grid.displacement = time * grid.reference;
  Cells hexahedra{CellKind::hexahedron, {}};
  hexahedra.nodes.resize(8, cells);
  for (Index e = 0; e < cells; ++e)
    hexahedra.nodes.col(e) << 4 * e, 4 * e + 2, 4 * e + 3, 4 * e + 1, 4 * e + 4, 4 * e + 6, 4 * e + 7, 4 * e + 5;
  grid.cells = {hexahedra};
  Field number{"number", "1", {}, Eigen::MatrixXd(1, cells), true};
  for (Index e = 0; e < cells; ++e) number.values(0, e) = e;
  grid.cell_fields = {number};
  return grid;
}

std::string text_of(const Grid& grid, Kept& kept) {
  std::vector<Lost> lost;
  return frame_text(grid, GridKind::volume, Precision::single, kept, lost);
}

TEST(FrameText, IsTheSameWithAndWithoutTheFrameBefore) {
  if (!vtk_available()) GTEST_SKIP() << "built without VTK";
  Kept kept, none, other;
  text_of(bar(0), kept);
  EXPECT_EQ(text_of(bar(1), kept), text_of(bar(1), none));
  Grid moved = bar(2);
  moved.reference *= 2;
  moved.cell_fields[0].values *= 2;
  moved.cells[0].nodes.conservativeResize(Eigen::NoChange, 2999);
  moved.cell_fields[0].values.conservativeResize(Eigen::NoChange, 2999);
  EXPECT_EQ(text_of(moved, kept), text_of(moved, other)) << "what has changed after all is packed anew";
}

TEST(FrameText, IsASoundFile) {
  if (!vtk_available()) GTEST_SKIP() << "built without VTK";
  Kept kept;
  const VtuCheck found = check_vtu(text_of(bar(1), kept));
  EXPECT_EQ(found.fault, "");
  EXPECT_GT(found.unpacked, 12004 * 48);
  Grid empty;
  empty.cells = {{CellKind::hexahedron, {}}};
  Kept of_empty;
  EXPECT_EQ(check_vtu(text_of(empty, of_empty)).fault, "");
}

TEST(FrameText, RefusesWholeNumbersBeyondThirtyTwoBits) {
  if (!vtk_available()) GTEST_SKIP() << "built without VTK";
  Grid grid = bar(0);
  grid.cell_fields[0].values(0, 7) = 1e10;
  Kept kept;
  EXPECT_THROW(text_of(grid, kept), InternalError);
}

}  // namespace
}  // namespace nereid::grid::frame_text_test
