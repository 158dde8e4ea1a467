#include "input/scene_builder.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace nereid::input {
namespace {

const std::string steel = "{kind: elastic, density: 8000 kg/m^3, young: 200 GPa, poisson: 0.25}";
const std::string bar =
    "bodies:\n  - name: bar\n    mesh: {kind: box, low: [0 m, 0 m, 0 m], high: [2 m, 1 m, 1 m], cells: [2, 1, 1]}\n"
    "    material: " + steel + "\n";
const std::string wall =
    "  - name: wall\n    mesh: {kind: box, low: [2 m, 0 m, 0 m], high: [4 m, 1 m, 1 m], cells: [2, 1, 1]}\n    material: " + steel + "\n";
const std::string sheet =
    "  - name: sheet\n    mesh: {kind: sheet, length: 2 m, width: 1 m, cells_along: 2, cells_across: 1}\n"
    "    move: [0 m, 0 m, 1.5 m]\n    material: " + steel + "\n    element: {thickness: 2 mm}\n";
const std::string time = "time: {end: 1 ms}\n";

/// A scene as far as its contacts.
struct Built {
  dynamics::Model model;
  std::vector<dynamics::Connected> connected;
};

Built build(const std::string& text) {
  const CaseFile file = CaseFile::parse(text, "case.yaml");
  const SceneOptions scene = read_scene(file.root());
  file.finish();
  Built built;
  built.model.mesh = make_mesh(scene);
  check_names(scene, built.model.mesh);
  file.finish();
  add_bodies_and_actions(scene, built.model);
  built.connected = add_contacts(scene, built.model);
  file.finish();
  return built;
}

std::string refusal(const std::string& text) {
  try {
    build(text);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(MakeMesh, TurnsBeforeItMoves) {
  const auto model = build(bar + "    turn: {axis: [0, 0, 1], angle: 90 deg}\n    move: [0 m, 5 m, 0 m]\n" + time).model;
  EXPECT_LT((model.mesh.X.rowwise().minCoeff() - Vec3(-1, 5, 0)).norm(), 1e-15);
  EXPECT_LT((model.mesh.X.rowwise().maxCoeff() - Vec3(0, 7, 1)).norm(), 1e-15);
}

TEST(MakeMesh, MapsBeforeItTurnsAndMoves) {
  const std::string mapped = "bodies:\n  - name: bar\n    mesh: {kind: box, low: [0 m, 0 m, 0 m], high: [1 m, 1 m, 1 m], cells: [1, 1, 1],"
                             " map: [2*x, y, z + x]}\n    material: {kind: elastic, density: 1 kg/m^3, young: 1 Pa, poisson: 0}\n";
  const auto model = build(mapped + "    turn: {axis: [0, 0, 1], angle: 90 deg}\n    move: [0 m, 5 m, 0 m]\n" + time).model;
  EXPECT_LT((model.mesh.X.rowwise().minCoeff() - Vec3(-1, 5, 0)).norm(), 1e-15);
  EXPECT_LT((model.mesh.X.rowwise().maxCoeff() - Vec3(0, 7, 2)).norm(), 1e-15);
  EXPECT_NEAR(model.mass.sum(), 2, 1e-15);
}

TEST(AddBodies, HaveTheirMassAndKind) {
  const auto model = build(bar + sheet + time).model;
  ASSERT_EQ(model.blocks.size(), 2U);
  EXPECT_FALSE(element::is_plate(model.blocks[0]));
  EXPECT_TRUE(element::is_plate(model.blocks[1]));
  EXPECT_NEAR(model.mass.sum(), 16000 + 32, 1e-9);  // 2 m3 and 2 m2 of 2 mm, of 8000 kg/m3; round-off
}

TEST(AddPlanes, HoldTheUnionOfTheirSets) {
  const auto model = build(bar + "planes:\n  - {name: side, kind: held, nodes: [bar.x_low, bar.y_low], normal: [0, 3, 4]}\n" + time).model;
  ASSERT_EQ(model.constraints.planes.size(), 1U);
  EXPECT_EQ(model.constraints.planes[0].nodes.size(), 8U);  // four and six, two of them common
  EXPECT_LT((model.constraints.planes[0].normal - Vec3(0, 0.6, 0.8)).norm(), 1e-15);
}

TEST(AddPlanes, MakeARigidWallAsHardAsItsSurface) {
  const std::string text = bar + "planes:\n  - {name: wall, kind: rigid, surface: bar.x_high, point: [2.5 m, 0 m, 0 m], normal: [-1, 0, 0], ";
  const auto chosen = build(text + "hardness: 3, friction: 0.2}\n" + time).model, given = build(text + "penalty: 5 GPa/m}\n" + time).model;
  ASSERT_EQ(chosen.rigid_planes.size(), 1U);
  EXPECT_NEAR(chosen.rigid_planes[0].penalty, 3 * 240e9, 1e-3);  // lambda + 2 mu over cells of 1 m; round-off
  EXPECT_NEAR(chosen.rigid_planes[0].area.sum(), 1, 1e-14);
  EXPECT_EQ(chosen.rigid_planes[0].friction.coefficient, 0.2);
  EXPECT_EQ(given.rigid_planes[0].penalty, 5e9);
}

TEST(AddPlanes, RefuseNodesThatStartBehindThem) {
  const auto text = [](const std::string& kind, double height) {
    return bar + "planes:\n  - {name: ground, kind: " + kind + ", point: [0 m, 0 m, " + std::to_string(height) + " m], normal: [0, 0, 1]}\n" + time;
  };
  EXPECT_EQ(refusal(text("floor, nodes: [bar]", 0)), "");
  EXPECT_TRUE(says(refusal(text("floor, nodes: [bar]", 0.25)), "6 of 12 nodes start behind 'ground', by 0.25 m at most"));
  EXPECT_EQ(refusal(text("rigid, surface: bar.z_low", -0.25)), "");
  EXPECT_TRUE(says(refusal(text("rigid, surface: bar.z_low", 0.5)), "6 of 6 nodes start behind 'ground'"));
}

TEST(AddPlanes, RefuseASymmetryPlaneWhoseNodesLieOnNone) {
  const auto text = [](const std::string& nodes) {
    return bar + "planes:\n  - {name: side, kind: symmetry, nodes: [" + nodes + "], normal: [0, 1, 0]}\n" + time;
  };
  EXPECT_EQ(refusal(text("bar.y_low")), "");
  EXPECT_TRUE(says(refusal(text("bar")), "lie on no plane: they are 1 m apart"));
}

TEST(AddContacts, StandOffHalfTheThicknessOfPlates) {
  const auto built = build(bar + sheet + "contacts:\n  - {name: touch, apexes: bar.z_high, base: sheet.bottom}\n" + time);
  ASSERT_EQ(built.connected.size(), 1U);
  EXPECT_NEAR(built.connected[0].gaps.least, 0.5 - 1e-3, 1e-15);
  EXPECT_EQ(built.model.interfaces[0].contact_height(0), 1e-3);
}

TEST(AddContacts, SolidsTouchWhereTheyMeet) {
  const auto built = build(bar + wall + "contacts:\n  - {name: touch, apexes: bar.x_high, base: wall.x_low}\n" + time);
  EXPECT_EQ(built.connected[0].gaps.least, 0);
  EXPECT_EQ(built.connected[0].gaps.penetrating, 0);
}

TEST(AddContacts, MayHaveTwoPasses) {
  const auto built = build(bar + wall + "contacts:\n  - {name: touch, apexes: bar.x_high, base: wall.x_low, passes: two}\n" + time);
  ASSERT_EQ(built.model.interfaces.size(), 2U);
  EXPECT_EQ(built.connected.size(), 2U);
  EXPECT_EQ(built.model.interfaces[1].name, "touch_back");
}

TEST(AddContacts, RefuseASurfaceThatTouchesItself) {
  EXPECT_TRUE(says(refusal(bar + "contacts:\n  - {name: touch, apexes: bar.x_high, base: bar.y_low}\n" + time), "share nodes"));
}

TEST(CheckNames, TellsAllThatNameNothingWithTheNearest) {
  const std::string said = refusal(bar + wall + "contacts:\n  - {name: touch, apexes: bar.x_hihg, base: wal.x_low}\n"
                                   "probes:\n  - {name: tip, quantity: displacement, of: bar.tip}\n" + time);
  EXPECT_TRUE(says(said, "did you mean 'bar.x_high'?"));
  EXPECT_TRUE(says(said, "did you mean 'wall.x_low'?"));
  EXPECT_TRUE(says(said, "'of' = bar.tip is unknown: node sets are bar, "));
  EXPECT_TRUE(says(said, "3 faults in case.yaml"));
}

}  // namespace
}  // namespace nereid::input
