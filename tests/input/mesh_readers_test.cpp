#include "input/mesh_readers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "grid/grid.hpp"
#include "mesh/skin.hpp"
#include "model/meshes.hpp"

namespace nereid::input::mesh_readers_test {
namespace {

model::MeshOptions read(const std::string& text) {
  const CaseFile file = CaseFile::parse(text, "case.yaml");
  const model::MeshOptions options = read_mesh_options(file.root());
  file.finish();
  return options;
}

/// What is said of a mesh that is refused; empty if it is not.
std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::string box = "kind: box\nlow: [0 m, 0 m, 0 m]\nhigh: [1 m, 10 cm, 100 mm]\ncells: [10, 2, 2]\n";
const std::string cylinder = "kind: cylinder\nradius: 1 m\nlength: 2 m\nturn: quarter\ncells_core: 3\ncells_ring: 2\ncells_along: 4\n";
const std::string tube = "kind: tube\nradius: 1 m\nlength: 2 m\nturn: full\ncells_core: 3\ncells_along: 4\n";

TEST(ReadMesh, AKindThatIsUnknownIsTheOnlyFault) {
  const std::string said = refusal("kind: tub\nradius: 1 m\nlength: 2 m\nturn: sector\nangle: 30 deg\ncells_around: 3\ncells_along: 4\n");
  EXPECT_TRUE(says(said, "'kind' = tub is unknown") && says(said, "\n1 fault in")) << said;
}

TEST(ReadMesh, ABoxIsBuiltAsItIsWritten) {
  const mesh::Mesh bar = model::make_mesh("bar", read(box));
  EXPECT_EQ(bar.X.cols(), 11 * 3 * 3);
  EXPECT_EQ(mesh::hexahedra(bar, "bar").nodes.cols(), 40);
  EXPECT_EQ(bar.X.rowwise().maxCoeff(), Vec3(1, 0.1, 0.1));
  EXPECT_EQ(mesh::node_set(bar, "bar.x_high").size(), 9U);
}

TEST(ReadMesh, CylinderAndTubeHaveTheirCells) {
  EXPECT_EQ(mesh::hexahedra(model::make_mesh("c", read(cylinder)), "c").nodes.cols(), (9 + 12) * 4);
  EXPECT_EQ(mesh::triangles(model::make_mesh("t", read(tube)), "t").nodes.cols(), 2 * 24 * 4);
}

TEST(ReadMesh, SectorsAreSolidOrOfPlates) {
  const mesh::Mesh solid = model::make_mesh("a", read("kind: sector\nradius: 1 m\nlength: 2 m\nangle: 5 deg\ncells_around: 1\n"
                                               "cells_radial: 4\ncells_along: 3\n"));
  EXPECT_EQ(mesh::hexahedra(solid, "a").nodes.cols(), 12);
  EXPECT_EQ(mesh::node_set(solid, "a.axis").size(), 4U);
  const mesh::Mesh ring = model::make_mesh("a", read("kind: sector\nradius: 1 m\nlength: 2 m\nangle: 5 deg\ncells_around: 1\n"
                                              "cells_radial: 4\ncells_along: 3\ninner_radius: 50 cm\n"));
  EXPECT_EQ(mesh::node_set(ring, "a.inside").size(), 8U);
  const mesh::Mesh skin = model::make_mesh("a", read("kind: tube\nradius: 1 m\nlength: 2 m\nturn: sector\nangle: 5 deg\n"
                                              "cells_around: 1\ncells_along: 3\n"));
  EXPECT_EQ(mesh::triangles(skin, "a").nodes.cols(), 6);
  const mesh::Mesh plate = model::make_mesh("a", read("kind: disc\nradius: 1 m\nturn: sector\nangle: 5 deg\ncells_around: 1\n"
                                               "cells_radial: 3\n"));
  EXPECT_EQ(mesh::triangles(plate, "a").nodes.cols(), 5);
}

TEST(ReadMesh, SpheresDiscsAndSheetsHaveTheirCells) {
  const auto sphere = [](const std::string& turn) {
    return model::make_mesh("a", read("kind: sphere\nradius: 1 m\nturn: " + turn + "\ncells_core: 2\ncells_ring: 1\n"));
  };
  for (const auto& [turn, parts] : {std::pair("full", 8), {"half", 4}, {"quarter", 2}, {"eighth", 1}})
    EXPECT_EQ(mesh::hexahedra(sphere(turn), "a").nodes.cols(), parts * (8 + 12));
  const mesh::Mesh disc = model::make_mesh("a", read("kind: disc\nradius: 1 m\nturn: full\ncells_core: 2\ncells_ring: 1\n"));
  EXPECT_EQ(mesh::triangles(disc, "a").nodes.cols(), 2 * 4 * (4 + 4));
  const std::string sheet = "kind: sheet\nlength: 1 m\nwidth: 2 m\ncells_along: 3\ncells_across: 2\n";
  EXPECT_EQ(std::get<mesh::Sheet>(read(sheet)).cuts, mesh::Cuts::columns);
  EXPECT_EQ(std::get<mesh::Sheet>(read(sheet + "cuts: crossed\n")).cuts, mesh::Cuts::crossed);
  EXPECT_EQ(mesh::triangles(model::make_mesh("a", read(sheet)), "a").nodes.cols(), 12);
}

TEST(ReadMesh, SectorsThatCannotBeAreRefused) {
  const std::string sector = "kind: sector\nradius: 1 m\nlength: 2 m\ncells_radial: 4\ncells_along: 3\n";
  EXPECT_TRUE(says(refusal(sector + "angle: 360 deg\ncells_around: 9\n"), "'angle' = 360 deg is out of range"));
  EXPECT_TRUE(says(refusal(sector + "angle: 200 deg\ncells_around: 1\n"), "less than half a turn"));
  EXPECT_TRUE(says(refusal(sector + "angle: 20 deg\ncells_around: 1\ninner_radius: 1 m\n"), "'inner_radius' must be below"));
  EXPECT_TRUE(says(refusal("kind: cylinder\nradius: 1 m\nlength: 2 m\nturn: sector\ncells_core: 1\ncells_ring: 1\ncells_along: 1\n"),
                   "sector is unknown"));
  EXPECT_TRUE(says(refusal("kind: tube\nradius: 1 m\nlength: 2 m\nturn: sector\ncells_along: 1\n"), "missing 'angle'"));
}

/// Writes a file of one cell on the corners of a cube.
void write_file(const std::filesystem::path& file, const std::string& nodes, int count, int kind) {
  std::ofstream(file) << "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
      "<Piece NumberOfPoints=\"8\" NumberOfCells=\"1\"><CellData><DataArray type=\"Int32\" Name=\"grain\" format=\"ascii\">5"
      "</DataArray></CellData><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
      "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1</DataArray></Points>"
      "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" << nodes << "</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" << count << "</DataArray>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" << kind << "</DataArray></Cells>"
      "</Piece></UnstructuredGrid></VTKFile>";
}

/// A folder with a case and, beside it, a file of one hexahedron or of one tetrahedron.
std::filesystem::path folder_with_files() {
  // one for each test: they may run side by side
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / (std::string("nereid_mesh_readers_") + test->name());
  std::filesystem::create_directories(folder);
  write_file(folder / "cube.vtu", "0 1 2 3 4 5 6 7", 8, 12);
  write_file(folder / "tetrahedron.vtu", "0 1 2 4", 4, 10);
  return folder;
}

model::MeshOptions read_beside(const std::filesystem::path& folder, const std::string& text) {
  std::ofstream(folder / "case.yaml") << text;
  const CaseFile file = CaseFile::read((folder / "case.yaml").string());
  const model::MeshOptions options = read_mesh_options(file.root());
  file.finish();
  return options;
}

TEST(ReadMesh, AFileIsFoundBesideTheCaseAndNamedAfterItsBody) {
  if (!grid::vtk_available()) GTEST_SKIP() << "built without VTK";
  const auto folder = folder_with_files();
  const mesh::Mesh plain = model::make_mesh("bar", read_beside(folder, "kind: file\npath: cube.vtu\n"));
  EXPECT_EQ(mesh::hexahedra(plain, "bar").nodes.cols(), 1);
  EXPECT_EQ(mesh::surface(plain, "bar.skin").facets.cols(), 12);
  EXPECT_EQ(mesh::node_set(plain, "bar").size(), 8U);
  const mesh::Mesh grains = model::make_mesh("bar", read_beside(folder, "kind: file\npath: ./cube.vtu\nregion_array: grain\n"));
  EXPECT_EQ(mesh::hexahedra(grains, "bar.region_5").nodes.cols(), 1);
  const std::string whole = (folder / "cube.vtu").string();
  EXPECT_EQ(model::make_mesh("bar", read_beside(testing::TempDir(), "kind: file\npath: " + whole + "\n")).X.cols(), 8);
}

TEST(ReadMesh, AFileThatIsNoMeshIsAFaultOfTheCaseWithItsPlace) {
  const auto folder = folder_with_files();
  const auto refusal_beside = [&](const std::string& text) -> std::string {
    try {
      read_beside(folder, text);
    } catch (const CaseError& error) {
      return error.what();
    }
    return "";
  };
  if (!grid::vtk_available()) {
    EXPECT_TRUE(says(refusal_beside("kind: file\npath: cube.vtu\n"), "NEREID_WITH_VTK=OFF"));
    return;
  }
  EXPECT_TRUE(says(refusal_beside("kind: file\npath: none.vtu\n"), "case.yaml:2:7: 'path' = none.vtu: there is no such file"));
  EXPECT_TRUE(says(refusal_beside("kind: file\npath: tetrahedron.vtu\n"), "it has 1 tetrahedra; expected hexahedra"));
  EXPECT_TRUE(says(refusal_beside("kind: file\n"), "missing 'path'"));
  const std::string both = refusal_beside("kind: file\npath: none.vtu\nradius: 1 m\ncolour: red\n");
  EXPECT_TRUE(says(both, "there is no such file") && says(both, "unknown key 'colour'")) << both;
}

TEST(ReadMesh, AFileTellsTheNumbersOfItsCellsAndShowsThoseAtFault) {
  if (!grid::vtk_available()) GTEST_SKIP() << "built without VTK";
  const auto folder = folder_with_files();
  write_file(folder / "twisted.vtu", "1 0 2 3 4 5 6 7", 8, 12);
  std::ofstream(folder / "case.yaml") << "kind: file\npath: cube.vtu\n";
  mesh::Origin origin;
  read_mesh_options(CaseFile::read((folder / "case.yaml").string()).root(), &origin);
  EXPECT_EQ(origin.numbers, std::vector<std::int64_t>{0});
  std::ofstream(folder / "case.yaml") << "kind: file\npath: twisted.vtu\n";
  const CaseFile file = CaseFile::read((folder / "case.yaml").string());
  read_mesh_options(file.root());
  ASSERT_EQ(file.offenders().size(), 1U);
  EXPECT_EQ(file.offenders()[0].of, "twisted.vtu");
  EXPECT_EQ(file.files(), std::vector<std::string>{(folder / "twisted.vtu").string()});
  try {
    file.finish();
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_TRUE(says(error.what(), "case.yaml:2:7: 'path' = twisted.vtu: it has 1 element whose Jacobian is not positive at a Gauss"));
    EXPECT_TRUE(says(error.what(), "a run with --out shows them in offenders.pvd")) << error.what();
  }
}

TEST(ReadMesh, ScaleIsTheLengthOfOneAndAMetreWithoutIt) {
  const auto scale = [](const std::string& text) {
    const CaseFile file = CaseFile::parse(box + text, "case.yaml");
    read_mesh_options(file.root());
    const double found = read_scale(file.root());
    file.finish();
    return found;
  };
  EXPECT_EQ(scale(""), 1);
  EXPECT_EQ(scale("scale: 1 mm\n"), 1e-3);
  EXPECT_THROW(scale("scale: 0 mm\n"), CaseError);
  EXPECT_THROW(scale("scale: 0.001\n"), CaseError);
}

TEST(ReadMesh, KeysOfAnotherKindAreListedAsNotUsed) {
  const CaseFile file = CaseFile::parse(tube + "cells_ring: 4\nlow: [0 m, 0 m, 0 m]\n", "case.yaml");
  read_mesh_options(file.root());
  file.finish();
  EXPECT_EQ(file.not_used().size(), 2U);
}

TEST(ReadMesh, EveryKeyOfAKindIsAskedForAndNoOther) {
  const std::string all = refusal("kind: cylinder\n");
  for (const char* key : {"radius", "length", "turn", "cells_core", "cells_ring", "cells_along"})
    EXPECT_TRUE(says(all, "missing '" + std::string(key) + "'")) << all;
  EXPECT_FALSE(says(all, "missing 'low'"));
  EXPECT_TRUE(says(refusal(box + "colour: 3\n"), "unknown key 'colour'"));
}

TEST(ReadMesh, CornersInTheWrongOrderAreRefusedWithTheirPlace) {
  const std::string said = refusal("kind: box\nlow: [0 m, 0 m, 0 m]\nhigh: [1 m, 0 m, 1 m]\ncells: [1, 1, 1]\n");
  EXPECT_TRUE(says(said, "case.yaml:3:7: 'high' must lie beyond 'low'")) << said;
}

/// A body of one file, as `refine` finds it.
const std::string body = "name: bar\nmesh: {kind: file, path: PATH}\n";

model::MeshOptions read_body_beside(const std::filesystem::path& folder, const std::string& path, int factor, mesh::Origin& origin) {
  std::string text = body;
  text.replace(text.find("PATH"), 4, path);
  std::ofstream(folder / "case.yaml") << text;
  const CaseFile file = CaseFile::read((folder / "case.yaml").string(), {"refine=" + std::to_string(factor)});
  file.root().word("name");
  const model::MeshOptions options = read_mesh_options(file.root().section("mesh"), &origin);
  file.finish();
  return options;
}

TEST(ReadMesh, AFileIsSplitAndItsPartsKeepTheNumberOfTheirCell) {
  if (!grid::vtk_available()) GTEST_SKIP() << "built without VTK";
  const auto folder = folder_with_files();
  mesh::Origin origin;
  const mesh::Mesh bar = model::make_mesh("bar", read_body_beside(folder, "cube.vtu", 4, origin));
  EXPECT_EQ(mesh::hexahedra(bar, "bar").nodes.cols(), 64);
  EXPECT_EQ(bar.X.cols(), 125);
  EXPECT_EQ(mesh::surface(bar, "bar.skin").facets.cols(), 6 * 2 * 16);
  EXPECT_EQ(origin.numbers, std::vector<std::int64_t>(64, 0));
}

TEST(ReadMesh, ACollapsedHexahedronThatIsNoWedgeIsNotSplit) {
  if (!grid::vtk_available()) GTEST_SKIP() << "built without VTK";
  const auto folder = folder_with_files();
  write_file(folder / "pyramid.vtu", "0 1 2 3 4 4 4 4", 8, 12);
  mesh::Origin origin;
  EXPECT_EQ(model::count_elements(read_body_beside(folder, "pyramid.vtu", 1, origin)), 1);
  try {
    read_body_beside(folder, "pyramid.vtu", 2, origin);
    FAIL() << "it is split";
  } catch (const CaseError& error) {
    EXPECT_TRUE(says(error.what(), "with 'refine' = 2 it has 1 element that cannot be split: collapsed and no wedge")) << error.what();
    EXPECT_TRUE(says(error.what(), ": cells 0")) << error.what();
  }
}

mesh::Mesh mapped_mesh(const std::string& text) {
  const CaseFile file = CaseFile::parse(text, "case.yaml");
  const model::MeshOptions options = read_mesh_options(file.root());
  const auto map = read_map(file.root());
  file.finish();
  model::Faults faults;
  const mesh::Mesh mesh = model::mapped(map, model::make_mesh("a", options), {"", "body 'a'"}, faults);
  for (const model::Fault& fault : faults) file.fault(fault.key, fault.message);
  file.finish();
  return mesh;
}

std::string map_refusal(const std::string& text) {
  try {
    mapped_mesh(text);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(MapMesh, BendsABoxIntoARingAndASheetIntoACylinder) {
  const std::string ring = "kind: box\nlow: [1 m, 0 m, 0 m]\nhigh: [2 m, 1.5 m, 1 m]\ncells: [2, 40, 1]\n";
  const mesh::Mesh sector = mapped_mesh(ring + "map: [x*cos(y), x*sin(y), z]\n");
  EXPECT_EQ(sector.surfaces.size(), 7U);  // with its skin
  for (const Index node : mesh::node_set(sector, "a.x_low")) EXPECT_NEAR(sector.X.col(node).head<2>().norm(), 1, 1e-15);
  for (const Index node : mesh::node_set(sector, "a.y_high")) EXPECT_NEAR(std::atan2(sector.X(1, node), sector.X(0, node)), 1.5, 1e-15);
  // chords: the area between two circles falls by sin(a)/a
  const double chord = 1.5 / 40;
  EXPECT_NEAR(mesh::volumes(sector, mesh::hexahedra(sector, "a")).sum(), 1.5 * 1.5 * std::sin(chord) / chord, 1e-13);
  const mesh::Mesh panel = mapped_mesh("kind: sheet\nlength: 1 m\nwidth: 2 m\ncells_along: 8\ncells_across: 2\nmap: [cos(x), sin(x), y]\n");
  for (Index node = 0; node < panel.X.cols(); ++node) EXPECT_NEAR(panel.X.col(node).head<2>().norm(), 1, 1e-15);
}

TEST(MapMesh, IsOptionalAndIdentityIsExact) {
  const CaseFile file = CaseFile::parse(box, "case.yaml");
  EXPECT_FALSE(read_map(file.root())[0]);
  EXPECT_EQ(mapped_mesh(box + "map: [x, y, z]\n").X, model::make_mesh("a", read(box)).X);
}

TEST(MapMesh, ElementsWithoutVolumeOrAreaAreToldWithPlaceAndNumber) {
  const std::string mirrored = map_refusal(box + "map: [-x, y, z]\n");
  EXPECT_TRUE(says(mirrored, "case.yaml:5:6: 'map' leaves element 0 of 'a' no positive volume: -0.00025.")) << mirrored;
  EXPECT_TRUE(says(mirrored, "and 39 more")) << mirrored;
  const std::string folded = map_refusal(box + "map: [\"x < 0.95 ? x : 0.85\", y, z]\n");
  EXPECT_TRUE(says(folded, "element 9 of 'a'") && says(folded, "and 3 more")) << folded;
  const std::string flat = map_refusal("kind: sheet\nlength: 1 m\nwidth: 2 m\ncells_along: 1\ncells_across: 1\nmap: [x, 0, 0]\n");
  EXPECT_TRUE(says(flat, "element 0 of 'a' no positive area: 0.")) << flat;
  const std::string infinite = map_refusal(box + "map: [1/x, y, z]\n");
  EXPECT_TRUE(says(infinite, "'map' is no finite number at x = 0, y = 0, z = 0")) << infinite;
  EXPECT_TRUE(says(map_refusal(box + "map: [x, y, t]\n"), "'t' is unknown"));
}

TEST(ReadMesh, AHundredMillionElementsAreTheMost) {
  EXPECT_EQ(refusal("kind: box\nlow: [0 m, 0 m, 0 m]\nhigh: [1 m, 1 m, 1 m]\ncells: [1000, 1000, 100]\n"), "");
  EXPECT_TRUE(says(refusal("kind: box\nlow: [0 m, 0 m, 0 m]\nhigh: [1 m, 1 m, 1 m]\ncells: [1000, 1000, 101]\n"),
                   "101000000 elements"));
  EXPECT_TRUE(says(refusal("kind: tube\nradius: 1 m\nlength: 2 m\nturn: full\ncells_core: 2000000000\ncells_along: 2000000000\n"),
                   "at most a hundred million"));
}

}  // namespace
}  // namespace nereid::input::mesh_readers_test
