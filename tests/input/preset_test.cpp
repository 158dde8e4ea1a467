#include "input/preset.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "input/readers.hpp"

namespace nereid::input::preset_test {
namespace {

/// A case with counts of cells and a time, as a reader with defaults sees it.
struct Read {
  std::array<int, 3> cells{};
  int along = 0, level = 0, other = 0;
  explicit Read(const CaseFile& file) {
    const Section root = file.root(), mesh = root.section("mesh");
    cells = mesh.counts("cells");
    along = mesh.count("cells_along"), level = mesh.count("level");
    other = root.count("level");
    file.finish();
  }
};

const std::string text = "mesh: {cells: [4, 1, 5], cells_along: 3, level: 2}\nlevel: 7\n";

CaseFile parse(const std::vector<std::string>& overrides) { return CaseFile::parse(text, "case.yaml", overrides); }

std::string fault_of(const std::string& of, const std::vector<std::string>& overrides) {
  try {
    const CaseFile file = CaseFile::parse(of, "case.yaml", overrides);
    file.root().when(false).section("mesh");
    file.finish();
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(Refine, MultipliesAllCountsOfCellsAndKeepsWhatHasNoMesh) {
  const Read finer(parse({"refine=1.5"}));
  EXPECT_EQ(finer.cells, (std::array<int, 3>{6, 1, 8}));
  EXPECT_EQ(finer.along, 5);
  EXPECT_EQ(finer.level, 3);
  EXPECT_EQ(finer.other, 7) << "no count of a mesh";
  const Read coarser(parse({"refine=0.1"}));
  EXPECT_EQ(coarser.cells, (std::array<int, 3>{1, 1, 1}));
  std::vector<int> counts = counts_of_cells(parse({"refine=1.5"}).meshes());
  std::sort(counts.begin(), counts.end());
  EXPECT_EQ(counts, (std::vector<int>{2, 3, 4, 5})) << "as in the case";
}

TEST(Refine, ComesFromThePresetUnlessTheCaseHasIt) {
  EXPECT_EQ(Read(parse({})).along, 3);
  EXPECT_EQ(Read(parse({"accuracy=balanced"})).along, 3);
  EXPECT_EQ(Read(parse({"accuracy=reference"})).along, 6);
  EXPECT_EQ(Read(parse({"accuracy=reference", "refine=1"})).along, 3);
  EXPECT_EQ(parse({"accuracy=fast"}).refine_factor(), find_preset("fast")->refine);
}

TEST(Refine, OfACaseWithoutCountsIsAFault) {
  EXPECT_NE(fault_of("mesh: {path: a.vtu}", {"refine=2"}).find("this case has none"), std::string::npos);
  EXPECT_EQ(fault_of("mesh: {path: a.vtu}", {"accuracy=fast"}).find("none"), std::string::npos) << "the preset has other keys";
}

const std::string scene = "bodies:\n"
                          "  - {name: a, mesh: {kind: file, path: a.vtu}}\n"
                          "  - {name: b, mesh: {kind: box, cells: [4, 1, 2]}}\n"
                          "  - {name: c, mesh: {kind: box, cells: [1, 1, 1]}}\n"
                          "  - {name: d, rigid: true, mesh: {kind: box, cells: [1, 1, 1]}}\n";

/// What is said of the root alone.
std::string fault_of_scene(const std::vector<std::string>& overrides) {
  try {
    CaseFile::parse(scene, "case.yaml", overrides).finish();
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(Refine, FindsWhoseMeshesTheseAre) {
  const CaseFile file = CaseFile::parse(scene, "case.yaml", {"refine=2"});
  const std::vector<CaseMesh>& meshes = file.meshes();
  ASSERT_EQ(meshes.size(), 4U);
  EXPECT_EQ(names_from_files(meshes), "'a'");
  EXPECT_EQ(names_that_stay(meshes), "'c'") << "a rigid body is geometry";
  EXPECT_EQ(counts_of_cells(meshes), (std::vector<int>{4, 2}));
  const std::vector<std::string> notes = file.refine_notes();
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find("refine 2: the elements of 'a' are split"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("not finer is the mesh of 'c'"), std::string::npos) << notes[1];
  EXPECT_TRUE(CaseFile::parse(scene, "case.yaml", {}).refine_notes().empty());
}

TEST(Refine, OfMeshesFromFilesIsTwoOrFour) {
  for (const char* factor : {"0.5", "1.5", "3", "8"})
    EXPECT_NE(fault_of_scene({std::string("refine=") + factor}).find("are split by 2 or by 4 only, also 'a': expected 1, 2 or 4"),
              std::string::npos) << factor;
  EXPECT_NE(fault_of_scene({"accuracy=fast"}).find("'accuracy' multiplies counts of cells by 0.5"), std::string::npos);
  for (const std::vector<std::string>& fits : std::vector<std::vector<std::string>>{
           {"refine=1"}, {"refine=2"}, {"refine=4"}, {"accuracy=reference"}, {"accuracy=fast", "refine=1"}})
    EXPECT_EQ(fault_of_scene(fits).find("meshes from files"), std::string::npos) << fits[0];
}

TEST(Refine, IsAPureNumberWithinItsRange) {
  for (const char* wrong : {"0", "-1", "65", "nan", "inf", "2 m", "fine", "[2]"})
    EXPECT_NE(fault_of("mesh: {cells: 3}", {std::string("refine=") + wrong}).find("refine"), std::string::npos) << wrong;
  EXPECT_EQ(fault_of("mesh: {cells: 3}\nrefine: 64", {}).find("refine"), std::string::npos) << "the range has its ends";
  EXPECT_NE(fault_of("mesh: {cells: 3}\nrefin: 2", {}).find("did you mean 'refine'"), std::string::npos);
  EXPECT_NE(fault_of("mesh: {cells: 3}\nacuracy: fast", {}).find("did you mean 'accuracy'"), std::string::npos);
}

TEST(Preset, OfAnUnknownNameIsAFaultThatNamesThem) {
  const std::string said = fault_of("mesh: {cells: 3}", {"accuracy=quick"});
  for (const Preset& preset : presets()) EXPECT_NE(said.find(preset.name), std::string::npos) << said;
}

TEST(Preset, SetsAKeyInEverySectionOfItsNameThatDoesNotHaveIt) {
  const Preset preset{"mine", 1, {{"element", "hourglass", "0.5"}, {"contacts", "passes", "two"}}};
  ASSERT_NE(find_setting(preset, "bodies[3].element", "hourglass"), nullptr);
  EXPECT_EQ(find_setting(preset, "bodies[3].element", "hourglass")->value, "0.5");
  EXPECT_NE(find_setting(preset, "contacts[0]", "passes"), nullptr);
  EXPECT_EQ(find_setting(preset, "bodies[3]", "hourglass"), nullptr);
  EXPECT_EQ(find_setting(preset, "", "element"), nullptr);
}

TEST(Preset, LeavesWhatTheCaseHasAndTellsWhatItSet) {
  const std::string two = "accuracy: reference\nbodies: [{element: {layers: 3}}, {element: {kind: thin}}]\n";
  const CaseFile file = CaseFile::parse(two, "case.yaml", {});
  std::vector<int> layers;
  for (const Section& body : file.root().list("bodies")) {
    const Section element = body.section("element");
    element.word_or("kind", "thick");
    layers.push_back(element.count_or("layers", 5));
  }
  file.finish();
  EXPECT_EQ(layers, (std::vector<int>{3, 9}));
  ASSERT_EQ(file.preset_lines().size(), 1U);  // without a count of cells there is no factor to tell of
  EXPECT_NE(file.preset_lines()[0].find("bodies[1].element.layers = 9"), std::string::npos);
  EXPECT_TRUE(file.not_used().empty());
}

}  // namespace
}  // namespace nereid::input::preset_test
