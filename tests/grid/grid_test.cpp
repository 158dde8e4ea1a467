#include "grid/grid.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/check.hpp"

namespace nereid::grid::grid_test {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder(const std::string& name) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();  // tests run side by side
  const fs::path folder = fs::path(testing::TempDir()) / ("nereid_fields_" + test + "_" + name);
  fs::remove_all(folder);
  return folder;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A ring of hexahedra about the z axis, so that pictures of it tell top from side and in from out.
Grid ring(double time) {
  constexpr Index around = 24, up = 6, in = 2, loops = in + 1;
  Grid grid;
  grid.time = time;
  grid.reference.resize(3, around * (up + 1) * loops);
  const auto node = [](Index a, Index k, Index r) {
    return ((a % around) * (up + 1) + k) * loops + r;
  };
  for (Index a = 0; a < around; ++a)
    for (Index k = 0; k <= up; ++k)
      for (Index r = 0; r < loops; ++r) {
        const double angle = 2 * pi * a / around, radius = 0.3 + 0.1 * r;
        grid.reference.col(node(a, k, r)) =
            Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.25 * k);
      }
  grid.displacement = -40 * time * grid.reference;
  grid.displacement.topRows(2).setZero();

  Cells cells{CellKind::hexahedron, {}};
  cells.nodes.resize(8, around * up * in);
  Index next = 0;
  for (Index a = 0; a < around; ++a)
    for (Index k = 0; k < up; ++k)
      for (Index r = 0; r < in; ++r)
        cells.nodes.col(next++) << node(a, k, r), node(a, k, r + 1), node(a + 1, k, r + 1),
            node(a + 1, k, r), node(a, k + 1, r), node(a, k + 1, r + 1), node(a + 1, k + 1, r + 1),
            node(a + 1, k + 1, r);
  grid.cells = {cells};

  Field speed{"velocity", "m/s", vector_components, -40 * grid.reference, false};
  Field number{"node_id", "1", {}, Eigen::MatrixXd(1, grid.reference.cols()), true};
  for (Index n = 0; n < grid.reference.cols(); ++n) number.values(0, n) = n;
  grid.point_fields = {speed, number};

  Field stress{"stress", "Pa", tensor_components, Eigen::MatrixXd(6, next), false};
  Field mises{"von_mises", "Pa", {}, Eigen::MatrixXd(1, next), false};
  for (Index e = 0; e < next; ++e) {
    stress.values.col(e) << 11, 22, 33, 12, 23, 13;
    stress.values.col(e) *= 1e6 * (e + 1);
    mises.values(0, e) = 1e6 * (e / in % up) * time / 1e-3;
  }
  grid.cell_fields = {stress, mises};
  return grid;
}

/// Contact elements under the ring: apexes as vertices, lines to them, triangles.
Grid skin(double time) {
  Grid grid = ring(time);
  grid.cells = {{CellKind::vertex, Eigen::Matrix<Index, 1, 4>(0, 21, 42, 63)},
                {CellKind::line, {}},
                {CellKind::triangle, {}}};
  grid.cells[1].nodes.resize(2, 4);
  grid.cells[2].nodes.resize(3, 46);
  for (Index a = 0; a < 4; ++a) grid.cells[1].nodes.col(a) << 21 * a, 21 * a + 3;
  for (Index a = 0; a < 23; ++a) {
    grid.cells[2].nodes.col(2 * a) << 21 * a, 21 * a + 2, 21 * a + 23;
    grid.cells[2].nodes.col(2 * a + 1) << 21 * a, 21 * a + 23, 21 * a + 21;
  }
  Field status{"contact_status", "1", {}, Eigen::MatrixXd(1, 54), true};
  Field gap{"gap", "m", {}, Eigen::MatrixXd(1, 54), false};
  for (Index e = 0; e < 54; ++e) {
    status.values(0, e) = time > 0 ? e % 3 : 0;
    gap.values(0, e) = 1e-3 * e - time;
  }
  grid.cell_fields = {status, gap};
  return grid;
}

class Fields : public testing::Test {
 protected:
  void SetUp() override {
    if (!vtk_available()) GTEST_SKIP() << "built without VTK";
  }
};

TEST(FieldsAlways, ChecksEvenWithoutVtk) {
  Collection body(fresh_folder("always"), "body", GridKind::volume);
  Grid grid = ring(0);
  grid.cell_fields[0].values.conservativeResize(6, 3);
  EXPECT_THROW(body.add(grid), InternalError);
  if (!vtk_available()) {
    body.add(ring(0));
    EXPECT_EQ(body.frames(), 0);
    EXPECT_FALSE(fs::exists(fresh_folder("always")));
  }
}

TEST_F(Fields, IndexListsEveryFrameWithItsTimeAndARelativeName) {
  const fs::path folder = fresh_folder("index");
  Collection body(folder, "body", GridKind::volume);
  body.add(ring(0));
  body.add(ring(3e-4));
  EXPECT_EQ(body.frames(), 2);
  const std::string index = text_of(folder / "body.pvd");
  EXPECT_NE(index.find("timestep=\"0\" part=\"0\" file=\"body/body_000000.vtu\""),
            std::string::npos);
  EXPECT_NE(
      index.find("timestep=\"0.00029999999999999997\" part=\"0\" file=\"body/body_000001.vtu\""),
      std::string::npos);
  EXPECT_NE(index.find("</VTKFile>"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "body/body_000001.vtu"));
  EXPECT_FALSE(fs::exists(folder / "body.pvd.tmp"));
}

TEST_F(Fields, FilesAreInlineBinaryAndCompressed) {
  const fs::path folder = fresh_folder("inline");
  Collection body(folder, "body", GridKind::volume);
  body.add(ring(0));
  const std::string text = text_of(folder / "body/body_000000.vtu");
  EXPECT_NE(text.find("compressor=\"vtkZLibDataCompressor\""), std::string::npos);
  EXPECT_EQ(text.find("AppendedData"), std::string::npos);
  EXPECT_EQ(text.find("format=\"appended\""), std::string::npos);
  EXPECT_NE(text.find("Vectors=\"displacement\""), std::string::npos);
}

TEST_F(Fields, DerivedFieldsAreSingleUnlessAskedFor) {
  const fs::path folder = fresh_folder("precision");
  Collection(folder, "single", GridKind::volume).add(ring(0));
  Collection(folder, "full", GridKind::volume, Precision::full).add(ring(0));
  const auto type = [&](const char* name, const std::string& array) {
    const std::string text = text_of(folder / name / (std::string(name) + "_000000.vtu"));
    const auto name_at = text.find("Name=\"" + array + "\""),
               at = text.rfind("type=\"", name_at) + 6;
    return text.substr(at, text.find('"', at) - at);
  };
  EXPECT_EQ(type("single", "stress"), "Float32");
  EXPECT_EQ(type("full", "stress"), "Float64");
  EXPECT_EQ(type("single", "displacement"), "Float64");
  EXPECT_EQ(type("single", "node_id"), "Int32");
}

TEST_F(Fields, EqualGridsGiveEqualBytes) {
  const fs::path one = fresh_folder("bytes_one"), two = fresh_folder("bytes_two");
  for (const auto& folder : {one, two}) {
    Collection(folder, "body", GridKind::volume).add(ring(1e-3));
    Collection(folder, "contact", GridKind::surface).add(skin(1e-3));
  }
  for (const char* file : {"body.pvd", "body/body_000000.vtu", "contact/contact_000000.vtp"}) {
    EXPECT_FALSE(text_of(one / file).empty());
    EXPECT_EQ(text_of(one / file), text_of(two / file));
  }
}

TEST_F(Fields, KnowHowLongAFileWouldBe) {
  for (const Precision precision : {Precision::single, Precision::full}) {
    const fs::path folder = fresh_folder(precision == Precision::full ? "full" : "single");
    Collection(folder, "body", GridKind::volume, precision).add(ring(1e-3));
    EXPECT_EQ(bytes_of(ring(1e-3), GridKind::volume, precision), fs::file_size(folder / "body/body_000000.vtu"));
  }
}

TEST_F(Fields, WhatAFileCannotHoldIsReplacedCountedAndWarnedOfOnce) {
  Collection body(fresh_folder("nan"), "body", GridKind::volume);
  Grid grid = ring(0);
  grid.cell_fields[1].values(0, 3) = std::nan("");
  grid.cell_fields[1].values(0, 4) = std::numeric_limits<double>::infinity();
  grid.cell_fields[1].values(0, 5) = 1e300;  // infinite as Float32
  testing::internal::CaptureStderr();
  body.add(grid);
  grid.time = 1;
  body.add(grid);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(body.replaced(), 6);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 2);
  EXPECT_NE(said.find("'von_mises' holds no number in 2 places at 0 s; written as 0"), std::string::npos) << said;
  EXPECT_NE(said.find("'von_mises' holds a number beyond the range of Float32 in 1 place at 0 s"), std::string::npos) << said;
}

TEST_F(Fields, FrameAtTheSameTimeReplacesTheLastOne) {
  const fs::path folder = fresh_folder("again");
  Collection body(folder, "body", GridKind::volume);
  body.add(ring(0));
  body.add(ring(1e-3));
  body.add(ring(1e-3));
  EXPECT_EQ(body.frames(), 2);
  EXPECT_FALSE(fs::exists(folder / "body/body_000002.vtu"));
  EXPECT_THROW(body.add(ring(0)), InternalError);
}

TEST(CollectionFiles, AreItsIndexAndFramesAndNothingElse) {
  const fs::path folder = fresh_folder("files");
  fs::create_directories(folder / "body");
  for (const char* name : {"body.pvd", "body.pvd.tmp", "body.txt", "contact.pvd", "body/body_000000.vtu", "body/body_1234567.vtp",
                           "body/body_12.vtu", "body/mesh.vtu", "body/body_000001.txt", "body/body_000002.vtu.tmp"})
    std::ofstream(folder / name) << "a text";
  const std::vector<fs::path> expected{folder / "body.pvd", folder / "body.pvd.tmp", folder / "body/body_000000.vtu",
                                       folder / "body/body_000002.vtu.tmp", folder / "body/body_1234567.vtp"};
  std::vector<fs::path> found = collection_files(folder, "body");
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found.size(), expected.size());
  for (const fs::path& file : expected) EXPECT_EQ(std::count(found.begin(), found.end(), file), 1) << file;
  EXPECT_TRUE(collection_files(folder / "none", "body").empty());
}

TEST_F(Fields, FramesOfAnEarlierRunAreRemovedAndNothingElse) {
  const fs::path folder = fresh_folder("rerun");
  {
    Collection body(folder, "body", GridKind::volume);
    body.add(ring(0));
    body.add(ring(1));
  }
  std::ofstream(folder / "body/body_mine.vtu") << "mine";
  Collection body(folder, "body", GridKind::volume);
  EXPECT_FALSE(fs::exists(folder / "body/body_000001.vtu"));
  EXPECT_TRUE(fs::exists(folder / "body/body_mine.vtu"));
}

TEST_F(Fields, OtherArraysThanInTheFirstFrameAreRefused) {
  Collection body(fresh_folder("arrays"), "body", GridKind::volume);
  body.add(ring(0));
  Grid swapped = ring(1), missing = ring(1), renamed = ring(1);
  std::swap(swapped.cell_fields[0], swapped.cell_fields[1]);
  missing.point_fields.pop_back();
  renamed.cell_fields[1].unit = "MPa";
  EXPECT_THROW(body.add(swapped), InternalError);
  EXPECT_THROW(body.add(missing), InternalError);
  EXPECT_THROW(body.add(renamed), InternalError);
  body.add(ring(1));
}

TEST_F(Fields, WrongShapesNamesAndOrdersAreRefused) {
  const auto refused = [](GridKind kind, Grid grid) {
    Collection collection(fresh_folder("refused"), "body", kind);
    EXPECT_THROW(collection.add(grid), InternalError);
  };
  Grid grid = ring(0);
  grid.cell_fields[0].components = {"XX", "YY", "ZZ", "XY", "XZ", "YZ"};
  refused(GridKind::volume, grid);
  grid = ring(0);
  grid.cell_fields[0].components.clear();
  refused(GridKind::volume, grid);
  grid = ring(0);
  grid.cell_fields[0].name = "stress %";
  refused(GridKind::volume, grid);
  grid = ring(0);
  grid.cells[0].nodes(0, 0) = 100000;
  refused(GridKind::volume, grid);
  refused(GridKind::surface, ring(0));  // hexahedra
  grid = skin(0);
  std::swap(grid.cells[1], grid.cells[2]);
  refused(GridKind::surface, grid);
  grid = ring(0);
  grid.displacement.conservativeResize(3, 5);
  refused(GridKind::volume, grid);
  EXPECT_THROW(Collection(fresh_folder("refused"), "../body", GridKind::volume), InternalError);
}

TEST_F(Fields, FolderThatCannotBeMadeIsTheMachinesFault) {
  EXPECT_THROW(Collection("/proc/nowhere", "body", GridKind::volume), MachineError);
}

TEST_F(Fields, AFullDiskLeavesWhatTheIndexLists) {
  const fs::path folder = fresh_folder("full");
  Collection body(folder, "body", GridKind::volume);
  body.add(ring(0));
  const std::string index = text_of(folder / "body.pvd"), frame = text_of(folder / "body/body_000000.vtu");
  void (*const signal)(int) = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{2000, limit.rlim_max};  // the index would find room, the frame does not
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(body.add(ring(1)), MachineError);
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, signal);
  EXPECT_EQ(text_of(folder / "body.pvd"), index);
  EXPECT_EQ(text_of(folder / "body/body_000000.vtu"), frame);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "body"), fs::directory_iterator()), 1);
}

class Files : public Fields {
 protected:
  /// What is wrong with a file of these bytes.
  std::string fault_of(const std::string& bytes) {
    const fs::path folder = fresh_folder("file");
    fs::create_directories(folder);
    std::ofstream(folder / "a.vtu", std::ios::binary) << bytes;
    std::string fault;
    read_vtu(folder / "a.vtu", fault);
    return fault;
  }
  std::string frame() {
    const fs::path folder = fresh_folder("frame");
    Collection(folder, "body", GridKind::volume).add(ring(0));
    return text_of(folder / "body/body_000000.vtu");
  }
};

TEST_F(Files, AreReadToTheLastBit) {
  EXPECT_EQ(fault_of(frame()), "");
  std::string fault;
  const Contents read = read_vtu(fresh_folder("none") / "a.vtu", fault);
  EXPECT_EQ(fault, "there is no such file");
  const fs::path folder = fresh_folder("read");
  Collection(folder, "body", GridKind::volume, Precision::full).add(ring(1e-3));
  fault.clear();
  const Contents file = read_vtu(folder / "body/body_000000.vtu", fault);
  EXPECT_EQ(fault, "");
  EXPECT_EQ(file.points, ring(1e-3).reference + ring(1e-3).displacement);
  EXPECT_EQ(file.kind.size(), 24U * 6 * 2);
  ASSERT_EQ(file.cell_fields.size(), 2U);
  EXPECT_EQ(file.cell_fields[0].values, ring(1e-3).cell_fields[0].values);
}

TEST_F(Files, ThatCrashVtkAreFaults) {
  // offsets of cells far beyond their points
  const std::string text = R"(<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="8" NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1</DataArray></Points><Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">1000000000000</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">12</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>)";
  EXPECT_EQ(fault_of(text).rfind("VTK cannot read it", 0), 0U) << fault_of(text);
  std::string sound = text;
  sound.replace(sound.find("1000000000000"), 13, "8");
  EXPECT_EQ(fault_of(sound), "");
}

TEST_F(Files, ThatAreCutShortAreFaults) {
  const std::string whole = frame();
  for (std::size_t part = 0; part < 12; ++part) EXPECT_NE(fault_of(whole.substr(0, whole.size() * part / 12)), "") << part;
}

TEST_F(Files, ThatAreNoFilesAreNotOpened) {
  std::string fault;
  for (const char* name : {"/dev/zero", "/dev", "/proc/self/fd"}) {
    fault.clear();
    read_vtu(name, fault);
    EXPECT_EQ(fault, "it is a device, a pipe or a folder, and no file") << name;
  }
}

/// What read_back.py reads through VTK and view.py draws; its folder comes from the environment.
TEST_F(Fields, WriteTheExampleThatReadBackReads) {
  const char* asked = std::getenv("NEREID_READ_BACK");
  const fs::path folder = asked ? fs::path(asked) : fresh_folder("read_back");
  Collection body(folder, "body", GridKind::volume), contact(folder, "contact", GridKind::surface),
      walls(folder, "walls", GridKind::surface);
  for (const double time : {0.0, 1e-3, 2e-3}) {
    body.add(ring(time));
    contact.add(skin(time));
  }
  Grid floor;
  floor.reference.resize(3, 4);
  floor.reference << -1, 1, 1, -1, -1, -1, 1, 1, -0.01, -0.01, -0.01, -0.01;
  floor.displacement = Vectors::Zero(3, 4);
  floor.cells = {{CellKind::triangle, Table<3>(3, 2)}};
  floor.cells[0].nodes << 0, 0, 1, 2, 2, 3;
  walls.add(floor);
  EXPECT_EQ(walls.frames(), 1);
  EXPECT_EQ(body.frames(), 3);
}

}  // namespace
}  // namespace nereid::grid::grid_test
