#include "audit/surfaces.hpp"

#include "tests/audit/bodies.hpp"

namespace nereid::audit::surfaces_test {
namespace {

TEST(Surfaces, OfABoxIsItsSkin) {
  const mesh::Mesh box = block("box", {2, 1, 1}, {4, 2, 2});
  const Surfaces all = surfaces(box, {});
  ASSERT_EQ(all.list.size(), 1U);
  const Surface& skin = all.list[0];
  EXPECT_TRUE(skin.closed);
  EXPECT_EQ(skin.faces.cols(), 2 * (4 + 8 + 8));
  EXPECT_EQ(skin.triangles.cols(), 4 * skin.faces.cols());
  EXPECT_EQ(skin.nodes.size(), 5U * 3 * 3 - 3U);
  EXPECT_EQ(static_cast<Eigen::Index>(skin.nodes.size()) - skin.edges.cols() + skin.faces.cols(), 2) << "Euler";
  EXPECT_NEAR(skin.face_size.maxCoeff(), 0.5, 1e-12);
  for (Index e = 0; e < skin.edges.cols(); ++e) {
    const auto at = skin.triangles.col(skin.owner[e]);
    EXPECT_TRUE((at.array() == skin.edges(0, e)).any() && (at.array() == skin.edges(1, e)).any());
  }
}

TEST(Surfaces, MeasureAnElementWhereItIsFlattestWhateverTheFace) {
  const Surface skin = surfaces(block("brick", {1, 2, 4}, {1, 1, 1}), {}).list[0];
  EXPECT_NEAR(skin.face_size.minCoeff(), 1, 1e-12);
  EXPECT_NEAR(skin.face_size.maxCoeff(), 1, 1e-12);
}

TEST(Surfaces, AreThoseOfConnectedPiecesWhateverTheRegions) {
  mesh::Mesh two = block("a", Vec3::Ones(), {2, 1, 1});
  two.hexahedra.push_back({"b", two.hexahedra[0].nodes.rightCols(1)});
  two.hexahedra[0].nodes = Table<8>(two.hexahedra[0].nodes.leftCols(1));
  EXPECT_EQ(surfaces(two, {}).list.size(), 1U);
  EXPECT_EQ(surfaces(two, {}).list[0].faces.cols(), 10);
  const mesh::Mesh apart = mesh::join(block("a", Vec3::Ones(), {1, 1, 1}), block("b", Vec3::Ones(), {1, 1, 1}));
  EXPECT_EQ(surfaces(apart, {}).list.size(), 2U);
}

TEST(Surfaces, OfASheetHaveARim) {
  const Surfaces all = surfaces(plate("sheet", 3, 2, 3, 2), {0.1});
  ASSERT_EQ(all.list.size(), 1U);
  EXPECT_FALSE(all.list[0].closed);
  EXPECT_EQ(all.list[0].rim_edges.cols(), 10);
  EXPECT_EQ(all.list[0].smallest, 0.1);
  EXPECT_NEAR(surfaces(plate("sheet", 3, 2, 3, 2), {0}).list[0].smallest, 1, 1e-12) << "without a thickness the side counts";
}

TEST(Surfaces, OfASheetHaveAShell) {
  const mesh::Mesh sheet = plate("sheet", 3, 2, 3, 2);
  const Surfaces all = surfaces(sheet, {0.1});
  ASSERT_EQ(all.shells.size(), 1U);
  const Surface& shell = all.shells[0];
  EXPECT_TRUE(shell.closed);
  EXPECT_EQ(shell.nodes.size(), 2 * all.list[0].nodes.size());
  EXPECT_EQ(shell.faces.cols(), 2 * 12 + 10);
  EXPECT_EQ(static_cast<Eigen::Index>(shell.nodes.size()) - shell.edges.cols() + shell.faces.cols(), 2) << "Euler";
  EXPECT_EQ(surfaces(sheet, {0}).shells[0].plates, 0) << "no thickness is known";
  EXPECT_EQ(surfaces(block("box", Vec3::Ones(), {1, 1, 1}), {}).shells[0].plates, 0);
}

TEST(Surfaces, HaveNoOutsideWhereAPlateGoesOnBehindItsPlane) {
  const mesh::Mesh sheet = plate("sheet", 3, 2, 3, 2);
  const Surface shell = surfaces(sheet, {0.1}, {{Vec3::UnitX(), mesh::node_set(sheet, "sheet.x_low")}}).shells[0];
  EXPECT_EQ(std::count(shell.cut.begin(), shell.cut.end(), 1), 2);
}

TEST(Surfaces, KnowTheFacesThatAPlaneOfSymmetryCuts) {
  const mesh::Mesh box = block("box", Vec3::Ones(), {2, 2, 2});
  const Surfaces all = surfaces(box, {}, {{Vec3::UnitX(), mesh::node_set(box, "box.x_low")}});
  const Surface& skin = all.list[0];
  EXPECT_EQ(std::count(skin.cut.begin(), skin.cut.end(), 1), 4);
  for (std::size_t p = 0; p < skin.nodes.size(); ++p) {
    const bool on = box.X(0, skin.nodes[p]) == -0.5;
    EXPECT_EQ(skin.inward.col(static_cast<Eigen::Index>(p)), on ? Vec3(Vec3::UnitX()) : Vec3(Vec3::Zero()));
  }
}

}  // namespace
}  // namespace nereid::audit::surfaces_test
