#include "grid/file_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <fstream>

#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/skin.hpp"
#include "mesh/wedge.hpp"

namespace nereid::grid::file_mesh_test {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder(const std::string& name) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();  // tests run side by side
  const fs::path folder = fs::path(testing::TempDir()) / ("nereid_file_mesh_" + test + "_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void add_cell(Contents& file, int kind, const std::vector<Index>& nodes) {
  if (file.begin.empty()) file.begin.push_back(0);
  file.kind.push_back(kind);
  file.nodes.insert(file.nodes.end(), nodes.begin(), nodes.end());
  file.begin.push_back(static_cast<std::int64_t>(file.nodes.size()));
}

/// The contents of a file that holds the regions of a mesh.
Contents contents_of(const mesh::Mesh& mesh) {
  Contents file;
  file.points = mesh.X;
  for (const auto& region : mesh.hexahedra)
    for (const auto& nodes : region.nodes.colwise()) add_cell(file, 12, {nodes.begin(), nodes.end()});
  for (const auto& region : mesh.triangles)
    for (const auto& nodes : region.nodes.colwise()) add_cell(file, 5, {nodes.begin(), nodes.end()});
  return file;
}

mesh::Mesh brick() { return mesh::box("a", {Vec3::Zero(), Vec3(2, 2, 2), {2, 2, 2}}); }

Field set_of(const std::string& name, const Subset& nodes, Eigen::Index points) {
  Field field{name, "", {}, Eigen::MatrixXd::Zero(1, points), true};
  for (const Index node : nodes) field.values(0, node) = 1;
  return field;
}

std::string only_fault(const FileMesh& read) {
  EXPECT_EQ(read.faults.size(), 1U);
  EXPECT_EQ(read.mesh.X.cols(), 0);
  return read.faults.empty() ? "" : read.faults[0];
}

TEST(FileMesh, TakesHexahedraWithTheirSkin) {
  const mesh::Mesh expected = brick();
  const FileMesh read = file_mesh("b", contents_of(expected));
  ASSERT_TRUE(read.faults.empty());
  EXPECT_EQ(read.mesh.X, expected.X);
  EXPECT_EQ(mesh::hexahedra(read.mesh, "b").nodes, expected.hexahedra[0].nodes);
  EXPECT_EQ(mesh::surface(read.mesh, "b.skin").facets.cols(), 6 * 4 * 2);
  EXPECT_EQ(mesh::node_set(read.mesh, "b.skin").size(), 26U);
  EXPECT_EQ(mesh::node_set(read.mesh, "b").size(), 27U);
  EXPECT_NEAR(mesh::facet_areas(read.mesh, mesh::surface(read.mesh, "b.skin")).sum(), 24, 1e-13);  // round-off
}

TEST(FileMesh, WithoutCellsHasNone) {
  Contents file;
  file.points = Vectors::Zero(3, 2);
  file.begin = {0};
  file.cell_fields = {Field{"region", "", {}, Eigen::MatrixXd(1, 0), true}};
  EXPECT_EQ(only_fault(file_mesh("b", file)), "it has no cells");
}

TEST(FileMesh, TakesWedgesThatAreHexahedraWithSharedNodes) {
  const mesh::Mesh sector = mesh::wedge("a", {0.3, 0.5, 0.2, 1, 3, 2});
  const FileMesh read = file_mesh("b", contents_of(sector));
  ASSERT_TRUE(read.faults.empty());
  EXPECT_EQ(mesh::hexahedra(read.mesh, "b").nodes, sector.hexahedra[0].nodes);
}

TEST(FileMesh, CutsAQuadrilateralFromItsFirstCornerToItsThird) {
  Contents file;
  file.points.resize(3, 4);
  file.points << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  add_cell(file, 9, {0, 1, 2, 3});
  const FileMesh read = file_mesh("b", file);
  ASSERT_TRUE(read.faults.empty());
  Table<3> expected(3, 2);
  expected << 0, 2, 1, 3, 2, 0;
  EXPECT_EQ(mesh::triangles(read.mesh, "b").nodes, expected);
  EXPECT_EQ(mesh::surface(read.mesh, "b.top").facets, expected);
  EXPECT_EQ(mesh::surface(read.mesh, "b.bottom").facets.row(0), expected.row(1));
}

TEST(FileMesh, CutsAQuadrilateralWithAReEntrantCornerThere) {
  Contents file;
  file.points.resize(3, 4);
  file.points << 1, 0.2, 0, -1, 0, 0.2, 1, -1, 0, 0, 0, 0;  // the second corner lies inside the triangle of the others
  add_cell(file, 9, {0, 1, 2, 3});
  const FileMesh read = file_mesh("b", file);
  ASSERT_TRUE(read.faults.empty()) << read.faults[0];
  Table<3> expected(3, 2);
  expected << 0, 2, 1, 3, 3, 1;
  EXPECT_EQ(mesh::triangles(read.mesh, "b").nodes, expected);
  file.points << 1, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;  // sides that cross
  EXPECT_EQ(only_fault(file_mesh("b", file)),
            "it has 1 element of a quadrilateral whose halves face away from each other, as where its sides cross: cells 0");
}

TEST(FileMesh, KeepsTheNumbersOfCellsAndCountsPointsOfNone) {
  Contents file = contents_of(brick());
  file.points.conservativeResize(3, 29);
  file.points.rightCols(2) << 7, 8, 7, 8, 7, 8;
  Field region{"region", "", {}, Eigen::MatrixXd::Zero(1, 8), true};
  region.values.setConstant(2), region.values(0, 2) = region.values(0, 6) = 1;
  file.cell_fields = {region};
  const FileMesh read = file_mesh("b", file);
  ASSERT_TRUE(read.faults.empty()) << read.faults[0];
  EXPECT_EQ(read.origin.numbers, (std::vector<std::int64_t>{2, 6, 0, 1, 3, 4, 5, 7}));
  EXPECT_EQ(read.origin.lonely, 2);
}

TEST(FileMesh, RefusesABoundaryWhoseNodesWereNotMerged) {
  Contents file = contents_of(brick());
  const auto first = static_cast<Index>(file.points.cols());
  file.points.conservativeResize(3, first + 4);
  for (int a = 0; a < 4; ++a) file.points.col(first + a) = file.points.col(file.nodes[static_cast<std::size_t>(a)]);
  add_cell(file, 9, {first, first + 1, first + 2, first + 3});
  EXPECT_EQ(only_fault(file_mesh("b", file)),
            "1 of its triangles and quadrilaterals lie on faces of hexahedra and have nodes of their own; merge the nodes, or say "
            "'boundary_cells: plates': cells 8");
  EXPECT_TRUE(file_mesh("b", file, "region", BoundaryCells::plates).faults.empty());
}

TEST(FileMesh, MakesARegionOfEachNumberAndOneOfEachKindWithoutNumbers) {
  mesh::Mesh both = mesh::join(brick(), mesh::tube("t", {1, 1, mesh::Revolution::quarter, 2, 2}));
  Contents file = contents_of(both);
  const FileMesh plain = file_mesh("b", file);
  ASSERT_TRUE(plain.faults.empty());
  EXPECT_EQ(mesh::hexahedra(plain.mesh, "b.hexahedra").nodes.cols(), 8);
  EXPECT_EQ(mesh::triangles(plain.mesh, "b.triangles").nodes.cols(), 16);

  Field region{"part", "", {}, Eigen::MatrixXd::Zero(1, 24), false};
  region.values.rightCols(16).setConstant(7);
  region.values(0, 0) = 3;
  file.cell_fields = {region};
  const FileMesh read = file_mesh("b", file, "part");
  ASSERT_TRUE(read.faults.empty());
  EXPECT_EQ(mesh::hexahedra(read.mesh, "b.region_0").nodes.cols(), 7);
  EXPECT_EQ(mesh::hexahedra(read.mesh, "b.region_3").nodes.cols(), 1);
  EXPECT_EQ(mesh::triangles(read.mesh, "b.region_7").nodes.cols(), 16);
  EXPECT_EQ(mesh::surface(read.mesh, "b.skin").facets.cols(), 48);  // regions that share nodes have no skin between them

  file.cell_fields[0].values(0, 20) = 3;
  EXPECT_EQ(only_fault(file_mesh("b", file, "part")), "its region 3 holds solids and plates; give them different numbers");
  file.cell_fields[0].values(0, 20) = 3.5;
  EXPECT_EQ(only_fault(file_mesh("b", file, "part")), "its cell array 'part' does not hold one whole number, 0 or above, a cell");
  file.cell_fields[0].values(0, 20) = -1;
  EXPECT_EQ(only_fault(file_mesh("b", file, "part")), "its cell array 'part' does not hold one whole number, 0 or above, a cell");
}

/// A bar of two bricks along x, with quadrilaterals on its end, on its bottom and between the two.
Contents bar_with_boundaries() {
  const mesh::Mesh bar = mesh::box("a", {Vec3(0, 0, 0), Vec3(2, 1, 1), {2, 1, 1}});
  Contents file = contents_of(bar);
  const auto at = [&](double x, double y, double z) {
    for (Index n = 0; n < bar.X.cols(); ++n)
      if (bar.X(0, n) == x && bar.X(1, n) == y && bar.X(2, n) == z) return n;
    return Index{-1};
  };
  add_cell(file, 9, {at(2, 0, 0), at(2, 0, 1), at(2, 1, 1), at(2, 1, 0)});                      // the end, normal inwards
  add_cell(file, 9, {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)});                      // half of the bottom
  add_cell(file, 5, {at(1, 0, 0), at(2, 0, 0), at(2, 1, 0)});                                   // and of the other half two triangles
  add_cell(file, 5, {at(1, 0, 0), at(1, 1, 0), at(2, 1, 0)});
  add_cell(file, 9, {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)});                      // between the bricks
  Field region{"region", "", {}, Eigen::MatrixXd(1, 7), true};
  region.values << 1, 2, 1, 5, 5, 5, 6;
  file.cell_fields = {region};
  return file;
}

TEST(FileMesh, MakesSurfacesOfCellsThatLieOnFacesOfSolids) {
  const FileMesh read = file_mesh("b", bar_with_boundaries());
  ASSERT_TRUE(read.faults.empty()) << read.faults[0];
  EXPECT_TRUE(read.mesh.triangles.empty());
  const auto area = [&](const std::string& name) { return mesh::facet_areas(read.mesh, mesh::surface(read.mesh, name)).sum(); };
  EXPECT_DOUBLE_EQ(area("b.boundary_1"), 1);
  EXPECT_DOUBLE_EQ(area("b.boundary_5"), 2);
  EXPECT_EQ(mesh::node_set(read.mesh, "b.boundary_1").size(), 4U);
  EXPECT_EQ(mesh::node_set(read.mesh, "b.boundary_5").size(), 6U);
  EXPECT_EQ(mesh::node_set(read.mesh, "b.boundary_6").size(), 4U);  // of inner faces there is no surface
  EXPECT_THROW(mesh::surface(read.mesh, "b.boundary_6"), std::exception);
  const Table<3>& end = mesh::surface(read.mesh, "b.boundary_1").facets;
  for (const auto& f : end.colwise()) {
    const Vec3 one = read.mesh.X.col(f(1)) - read.mesh.X.col(f(0)), other = read.mesh.X.col(f(2)) - read.mesh.X.col(f(0));
    EXPECT_GT(one.cross(other).x(), 0);  // outwards, whatever the order in the file
  }
}

TEST(FileMesh, MakesANodeSetAndASurfaceOfEachRegion) {
  const FileMesh read = file_mesh("b", bar_with_boundaries());
  EXPECT_EQ(mesh::node_set(read.mesh, "b.region_2").size(), 8U);
  EXPECT_EQ(mesh::facet_areas(read.mesh, mesh::surface(read.mesh, "b.region_2")).sum(), 5);
}

TEST(FileMesh, MakesPlatesOnSolidsWhereThatIsSaid) {
  const FileMesh read = file_mesh("b", bar_with_boundaries(), "region", BoundaryCells::plates);
  EXPECT_EQ(only_fault(read), "its region 1 holds solids and plates; give them different numbers");
  Contents file = bar_with_boundaries();
  file.cell_fields[0].values(0, 2) = 7;
  EXPECT_EQ(file_mesh("b", file, "region", BoundaryCells::plates).mesh.triangles.size(), 3U);
}

TEST(FileMesh, RefusesBoundariesThatCoverAPartOfAFace) {
  Contents file = bar_with_boundaries();
  const std::string refused = " cover a part of a face of a hexahedron only: cells ";
  file.cell_fields[0].values(0, 5) = 6;  // the halves have two numbers
  const FileMesh halves = file_mesh("b", file);
  EXPECT_NE(only_fault(halves).find(refused + "4, 5"), std::string::npos) << only_fault(halves);
  file = bar_with_boundaries();
  std::swap(file.nodes[file.begin[3] + 1], file.nodes[file.begin[3] + 2]);  // a quadrilateral whose sides cross
  const FileMesh crossed = file_mesh("b", file);
  EXPECT_NE(only_fault(crossed).find(refused + "3"), std::string::npos) << only_fault(crossed);
}

TEST(FileMesh, RefusesARegionArrayThatIsNamedAndNotThere) {
  EXPECT_EQ(only_fault(file_mesh("b", bar_with_boundaries(), "regoin")), "it has no cell array 'regoin'; there are 'region'");
  EXPECT_TRUE(file_mesh("b", contents_of(brick())).faults.empty());
}

TEST(FileMesh, RefusesCellsOfOneNumberOnAndOffFacesOfSolids) {
  Contents file = bar_with_boundaries();
  file.points.conservativeResize(3, file.points.cols() + 1);
  file.points.rightCols(1) << 3, 0, 0;
  const auto last = static_cast<Index>(file.points.cols() - 1);
  add_cell(file, 5, {file.nodes[1], file.nodes[2], last});
  file.cell_fields[0].values.conservativeResize(1, 8);
  file.cell_fields[0].values(0, 7) = 5;
  EXPECT_EQ(only_fault(file_mesh("b", file)),
            "of its region 5 the triangles and quadrilaterals lie on faces of hexahedra in part; give those another number in the region "
            "array, or say 'boundary_cells: plates'");
  file.cell_fields.clear();
  EXPECT_EQ(only_fault(file_mesh("b", file)).substr(0, 32), "its triangles and quadrilaterals");
}

TEST(FileMesh, NamesNodeSetsAndTheirPartOfTheSkin) {
  const mesh::Mesh expected = brick();
  Contents file = contents_of(expected);
  file.point_fields = {set_of("low", mesh::node_set(expected, "a.z_low"), 27), set_of("tip", {26}, 27), set_of("none", {}, 27)};
  file.point_fields.push_back({"node_id", "", {}, Eigen::VectorXd::LinSpaced(27, 0, 26).transpose(), true});
  file.point_fields.push_back({"temperature", "", {}, Eigen::MatrixXd::Ones(1, 27), false});
  file.point_fields.push_back(set_of("vtkGhostType", {1}, 27));
  const FileMesh read = file_mesh("b", file);
  ASSERT_TRUE(read.faults.empty());
  EXPECT_EQ(mesh::node_set(read.mesh, "b.low"), mesh::node_set(expected, "a.z_low"));
  EXPECT_EQ(mesh::surface(read.mesh, "b.low").facets.cols(), 8);
  EXPECT_NEAR(mesh::facet_areas(read.mesh, mesh::surface(read.mesh, "b.low")).sum(), 4, 1e-14);
  EXPECT_EQ(mesh::node_set(read.mesh, "b.tip"), Subset{26});
  EXPECT_EQ(read.mesh.node_sets.size(), 4U);  // all, skin, low, tip
  EXPECT_EQ(read.mesh.surfaces.size(), 2U);   // skin, low
  file.point_fields[0].name = "skin";
  const FileMesh twice = file_mesh("b", file);
  ASSERT_EQ(twice.faults.size(), 2U);
  EXPECT_NE(twice.faults[0].find("two node sets called '.skin'"), std::string::npos);
  EXPECT_NE(twice.faults[1].find("two surfaces called '.skin'"), std::string::npos);
}

TEST(FileMesh, MakesNodeSetsOfLinesAndPointsByNumberAndByName) {
  Contents file;
  file.points.resize(3, 5);
  file.points << 0, 1, 1, 0, 9, 0, 0, 1, 1, 9, 0, 0, 0, 0, 9;
  add_cell(file, 9, {0, 1, 2, 3}), add_cell(file, 3, {3, 0}), add_cell(file, 1, {2}), add_cell(file, 3, {1, 4});
  const FileMesh plain = file_mesh("b", file);
  ASSERT_TRUE(plain.faults.empty()) << plain.faults[0];
  EXPECT_EQ(mesh::node_set(plain.mesh, "b.lines"), (Subset{0, 1, 3})) << "point 4 is of no element";
  EXPECT_EQ(mesh::node_set(plain.mesh, "b.points"), Subset{2});
  Field region{"region", "", {}, Eigen::MatrixXd(1, 4), true};
  region.values << 7, 7, 7, 8;
  file.cell_fields = {region};
  const FileMesh numbered = file_mesh("b", file);
  ASSERT_TRUE(numbered.faults.empty()) << numbered.faults[0];
  EXPECT_EQ(mesh::node_set(numbered.mesh, "b.lines_7"), (Subset{0, 3}));
  EXPECT_EQ(mesh::node_set(numbered.mesh, "b.lines_8"), Subset{1});
  EXPECT_EQ(mesh::triangles(numbered.mesh, "b.region_7").nodes.cols(), 2);
  const auto group = [](const char* name, double number, double dimension) {
    return Field{name, "", {}, (Eigen::MatrixXd(1, 2) << number, dimension).finished(), true};
  };
  file.fields = {group("skin", 7, 2), group("edge", 7, 1), group("corner", 7, 0), group("none", 7, 3)};
  const FileMesh named = file_mesh("b", file);
  ASSERT_TRUE(named.faults.empty()) << named.faults[0];
  EXPECT_EQ(mesh::node_set(named.mesh, "b.edge"), (Subset{0, 3}));
  EXPECT_EQ(mesh::node_set(named.mesh, "b.corner"), Subset{2});
  EXPECT_EQ(mesh::node_set(named.mesh, "b.lines_8"), Subset{1});
  EXPECT_EQ(mesh::triangles(named.mesh, "b.skin").nodes.cols(), 2);
}

TEST(FileMesh, RefusesLinesAlone) {
  Contents file;
  file.points = Vectors::Random(3, 2);
  add_cell(file, 3, {0, 1});
  EXPECT_EQ(only_fault(file_mesh("b", file)), "it has lines and points only; expected hexahedra, triangles and quadrilaterals");
}

TEST(FileMesh, NamesArraysThatLookLikeRegionsAndAreNotUsed) {
  Contents file = contents_of(brick());
  Field region{"material", "", {}, Eigen::MatrixXd::Ones(1, 8), true};
  file.cell_fields = {region};
  EXPECT_TRUE(file_mesh("b", file).origin.doubts.empty()) << "it is one region all the same";
  file.cell_fields[0].values(0, 3) = 2;
  const std::string doubt = "its cell array 'material' looks like regions, and is not used: 'region_array' names the one that is";
  EXPECT_EQ(file_mesh("b", file).origin.doubts, std::vector<std::string>{doubt});
  EXPECT_TRUE(file_mesh("b", file, "material").origin.doubts.empty());
}

TEST(FileMesh, DropsPointsOfNoCellAndKeepsTheOrderOfTheOthers) {
  const mesh::Mesh expected = brick();
  Contents file = contents_of(expected);
  Vectors points(3, 29);
  points << Vec3(9, 9, 9), expected.X.leftCols(13), Vec3(8, 8, 8), expected.X.rightCols(14);
  file.points = points;
  for (Index& node : file.nodes) node += node < 13 ? 1 : 2;
  file.point_fields = {set_of("tip", {0, 28}, 29), set_of("lonely", {0}, 29)};
  const FileMesh read = file_mesh("b", file);
  ASSERT_TRUE(read.faults.empty());
  EXPECT_EQ(read.mesh.X, expected.X);
  EXPECT_EQ(mesh::hexahedra(read.mesh, "b").nodes, expected.hexahedra[0].nodes);
  EXPECT_EQ(mesh::node_set(read.mesh, "b.tip"), Subset{26});
  EXPECT_EQ(read.mesh.node_sets.size(), 3U);
}

TEST(FileMesh, RefusesOtherCellsByNameAndNumberAndTellsAllFaultsAtOnce) {
  Contents file = contents_of(brick());
  for (int i = 0; i < 12; ++i) add_cell(file, 10, {0, 1, 2, 9});
  for (int i = 0; i < 3; ++i) add_cell(file, 13, {0, 1, 2, 9, 10, 11});
  add_cell(file, 99, {0});
  EXPECT_EQ(only_fault(file_mesh("b", file)),
            "it has 12 tetrahedra, 3 wedges and 1 cells of VTK's kind 99; expected hexahedra, triangles and quadrilaterals");
  std::swap(file.nodes[8], file.nodes[9]);  // twists the second hexahedron
  for (const int e : {3, 4})
    for (int a = 0; a < 4; ++a) std::swap(file.nodes[8 * e + a], file.nodes[8 * e + a + 4]);
  add_cell(file, 5, {0, 1, 2});  // in line
  add_cell(file, 12, {0, 1, 2});
  const FileMesh read = file_mesh("b", file);
  ASSERT_EQ(read.faults.size(), 4U);
  EXPECT_NE(read.faults[0].find("1 of its cells have another number of points than their kind: cells 25"), std::string::npos);
  EXPECT_EQ(read.faults[2], "it has 3 elements whose Jacobian is not positive at a Gauss point, as where two nodes are exchanged: "
                            "cells 1, 3, 4");
  EXPECT_EQ(read.faults[3], "it has 1 element without area: cells 24");
  EXPECT_EQ(read.offenders.numbers, (std::vector<std::int64_t>{1, 3, 4, 24}));
  EXPECT_EQ(only_fault(file_mesh("b", {})), "it has no cells");
}

// ------------------------------------------------------------------------------------------------
// Files

class Vtu : public testing::Test {
 protected:
  void SetUp() override {
    if (!vtk_available()) GTEST_SKIP() << "built without VTK";
  }
};

TEST_F(Vtu, ReadsWhatWasWrittenBitForBit) {
  const mesh::Mesh both = mesh::join(mesh::cylinder("a", {0.3, 0.7, mesh::Revolution::quarter, 2, 2, 3}),
                                     mesh::wedge_tube("t", {0.4, 0.7, 0.3, 2, 3}));
  const Eigen::Index solids = both.hexahedra[0].nodes.cols(), all = solids + both.triangles[0].nodes.cols();
  Grid grid;
  grid.reference = both.X;
  grid.displacement = Vectors::Constant(3, both.X.cols(), 0.1);
  grid.cells = {{CellKind::hexahedron, both.hexahedra[0].nodes}, {CellKind::triangle, both.triangles[0].nodes}};
  grid.point_fields = {set_of("axis_plane", mesh::node_set(both, "a.x_plane"), both.X.cols())};
  Field region{"region", "1", {}, Eigen::MatrixXd::Ones(1, all), true};
  region.values.leftCols(solids).setConstant(4);
  grid.cell_fields = {region};
  const fs::path folder = fresh_folder("round_trip");
  Collection(folder, "body", GridKind::volume).add(grid);

  std::string fault;
  const FileMesh read = file_mesh("b", read_vtu(folder / "body/body_000000.vtu", fault));
  EXPECT_EQ(fault, "");
  ASSERT_TRUE(read.faults.empty()) << read.faults[0];
  EXPECT_EQ(read.mesh.X, both.X + grid.displacement) << "where they stand in the frame";
  EXPECT_EQ(mesh::hexahedra(read.mesh, "b.region_4").nodes, both.hexahedra[0].nodes);
  EXPECT_EQ(mesh::triangles(read.mesh, "b.region_1").nodes, both.triangles[0].nodes);
  EXPECT_EQ(mesh::node_set(read.mesh, "b.axis_plane"), mesh::node_set(both, "a.x_plane"));
  const double plane = mesh::facet_areas(read.mesh, mesh::surface(read.mesh, "b.axis_plane")).sum();
  EXPECT_NEAR(plane, 0.3 * 0.7, 1e-15);  // of the quarter's plane, a rectangle
}

TEST_F(Vtu, ReadsAFileWrittenByHand) {
  const fs::path file = fresh_folder("by_hand") / "one.vtu";
  std::ofstream(file) << R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="2">
<PointData><DataArray type="UInt8" Name="tip" format="ascii">0 0 1 0 0</DataArray>
<DataArray type="String" Name="words" format="ascii">65 0 66 0 67 0 68 0 69 0</DataArray></PointData>
<CellData><DataArray type="Int64" Name="region" format="ascii">1 2</DataArray></CellData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0 2 0.5 0</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 1 4 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 7</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">9 5</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>)";
  std::string fault;
  const FileMesh read = file_mesh("b", read_vtu(file, fault));
  EXPECT_EQ(fault, "");
  ASSERT_TRUE(read.faults.empty()) << read.faults[0];
  EXPECT_EQ(mesh::triangles(read.mesh, "b.region_1").nodes.cols(), 2);
  EXPECT_EQ(mesh::triangles(read.mesh, "b.region_2").nodes.cols(), 1);
  EXPECT_EQ(mesh::node_set(read.mesh, "b.tip"), Subset{2});
  EXPECT_EQ(read.mesh.X(0, 4), 2);
}

TEST_F(Vtu, SaysWhyAFileCannotBeReadAndSaysItOnce) {
  const fs::path folder = fresh_folder("bad");
  const auto fault_of = [&](const std::string& name, const std::string& text) {
    if (!text.empty()) std::ofstream(folder / name) << text;
    std::string fault;
    testing::internal::CaptureStderr();
    const Contents contents = read_vtu(folder / name, fault);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << name;
    EXPECT_EQ(contents.points.cols(), fault.empty() ? 5 : 0);
    return fault;
  };
  EXPECT_EQ(fault_of("missing.vtu", ""), "there is no such file");
  EXPECT_EQ(fault_of("words.vtu", "not a mesh"), "it is no .vtu file");
  EXPECT_EQ(fault_of("surface.vtu", "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData/></VTKFile>"), "it is no .vtu file");
  const std::string head = "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
                           "<Piece NumberOfPoints=\"5\" NumberOfCells=\"1\">";
  EXPECT_NE(fault_of("cut_short.vtu", head), "");
  EXPECT_NE(fault_of("no_points.vtu", head + "</Piece></UnstructuredGrid></VTKFile>"), "");
  const auto triangle = [&](const std::string& points, const std::string& offset) {
    return head +
           "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0 2 0 "
           "0</DataArray></Points>"
           "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" + points + "</DataArray>"
           "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offset + "</DataArray>"
           "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
  };
  EXPECT_EQ(fault_of("triangle.vtu", triangle("0 1 2", "3")), "");
  EXPECT_NE(fault_of("far_node.vtu", triangle("0 1 77", "3")), "");
  for (const char* offset : {"4", "-3", "4294967297"})
    EXPECT_NE(fault_of("offsets.vtu", triangle("0 1 2", offset)), "") << offset;
}

TEST(WithoutVtk, AFileIsAFaultThatNamesTheSwitch) {
  if (vtk_available()) GTEST_SKIP() << "built with VTK";
  std::string fault;
  read_vtu("any.vtu", fault);
  EXPECT_NE(fault.find("NEREID_WITH_VTK=OFF"), std::string::npos);
}

}  // namespace
}  // namespace nereid::grid::file_mesh_test
