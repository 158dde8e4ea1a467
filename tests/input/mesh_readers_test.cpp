#include "input/mesh_readers.hpp"

#include <gtest/gtest.h>

namespace nereid::input {
namespace {

MeshOptions read(const std::string& text) {
  const CaseFile file = CaseFile::parse(text, "case.yaml");
  const MeshOptions options = read_mesh_options(file.root());
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

TEST(ReadMesh, ABoxIsBuiltAsItIsWritten) {
  const mesh::Mesh bar = make_mesh("bar", read(box));
  EXPECT_EQ(bar.X.cols(), 11 * 3 * 3);
  EXPECT_EQ(mesh::hexahedra(bar, "bar").nodes.cols(), 40);
  EXPECT_EQ(bar.X.rowwise().maxCoeff(), Vec3(1, 0.1, 0.1));
  EXPECT_EQ(mesh::node_set(bar, "bar.x_high").size(), 9U);
}

TEST(ReadMesh, CylinderAndTubeHaveTheirCells) {
  EXPECT_EQ(mesh::hexahedra(make_mesh("c", read(cylinder)), "c").nodes.cols(), (9 + 12) * 4);
  EXPECT_EQ(mesh::triangles(make_mesh("t", read(tube)), "t").nodes.cols(), 2 * 24 * 4);
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

TEST(ReadMesh, AHundredMillionElementsAreTheMost) {
  EXPECT_EQ(refusal("kind: box\nlow: [0 m, 0 m, 0 m]\nhigh: [1 m, 1 m, 1 m]\ncells: [1000, 1000, 100]\n"), "");
  EXPECT_TRUE(says(refusal("kind: box\nlow: [0 m, 0 m, 0 m]\nhigh: [1 m, 1 m, 1 m]\ncells: [1000, 1000, 101]\n"),
                   "101000000 elements"));
  EXPECT_TRUE(says(refusal("kind: tube\nradius: 1 m\nlength: 2 m\nturn: full\ncells_core: 2000000000\ncells_along: 2000000000\n"),
                   "at most a hundred million"));
}

}  // namespace
}  // namespace nereid::input
