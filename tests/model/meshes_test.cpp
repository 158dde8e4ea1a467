#include "model/meshes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "tests/model/scenes.hpp"

namespace nereid::model::meshes_test {
namespace {

TEST(MakeMesh, TurnsBeforeItMoves) {
  Scene scene = with({bar()});
  scene.bodies[0].place = {.axis = Vec3::UnitZ(), .angle = std::numbers::pi / 2, .about = Vec3::Zero(), .move = Vec3(0, 5, 0)};
  const mesh::Mesh mesh = build(scene).model.mesh;
  EXPECT_LT((mesh.X.rowwise().minCoeff() - Vec3(-1, 5, 0)).norm(), 1e-15);
  EXPECT_LT((mesh.X.rowwise().maxCoeff() - Vec3(0, 7, 1)).norm(), 1e-15);
}

TEST(MakeMesh, GivesPlatesASkinOfBothSidesAndSolidsOneOfTheirOuterFaces) {
  const mesh::Mesh plate = make_mesh("p", mesh::Sheet{.length = 2, .width = 1, .cells_along = 2, .cells_across = 1});
  EXPECT_EQ(mesh::surface(plate, "p.skin").facets.cols(), 2 * plate.triangles[0].nodes.cols());
  EXPECT_EQ(mesh::node_set(plate, "p.skin").size(), 6U);
  const mesh::Mesh box = make_mesh("b", mesh::Box{Vec3(0, 0, 0), Vec3(1, 1, 1), {1, 1, 1}});
  EXPECT_EQ(mesh::surface(box, "b.skin").facets.cols(), 12);
  mesh::Mesh both{.X = Vectors::Zero(3, 10), .hexahedra = box.hexahedra, .triangles = {{".region_1", Table<3>(3, 2)}}, .surfaces = {},
                  .node_sets = {{"", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}}};
  both.X.leftCols(8) = box.X;
  both.X.col(8) = Vec3(3, 0, 0), both.X.col(9) = Vec3(3, 1, 0);
  both.hexahedra[0].name = ".region_0";
  const auto corners = box.hexahedra[0].nodes.col(0);
  both.triangles[0].nodes << corners(0), corners(1), corners(1), 8, corners(2), 9;  // one on the box, one beside it
  EXPECT_EQ(mesh::surface(make_mesh("m", both), "m.skin").facets.cols(), 12 + 2);
}

TEST(Build, RefusesAPressureOnBothSidesOfPlates) {
  Scene scene = with({bar()});
  Body plate{.name = "plate", .mesh = mesh::Sheet{.length = 2, .width = 1, .cells_along = 2, .cells_across = 1}};
  plate.place.move = Vec3(0, 0, 9);
  plate.law = material::Elastic{1, 1, 0};
  plate.plate.thickness = 0.1;
  scene.bodies.push_back(plate);
  scene.loads = {{.name = "p", .kind = LoadKind::pressure, .on = "plate.skin", .value = uniform(Vec3(1, 0, 0))}};
  EXPECT_TRUE(says(refusal(scene), "'plate.skin' has both sides of plates, on which a pressure cancels")) << refusal(scene);
}

TEST(MakeMesh, MapsBeforeItTurnsAndMoves) {
  Scene scene = with({{.name = "bar", .mesh = mesh::Box{Vec3(0, 0, 0), Vec3(1, 1, 1), {1, 1, 1}}, .law = material::Elastic{1, 1, 0}}});
  scene.bodies[0].map = {[](double x, double, double, double) { return 2 * x; }, [](double, double y, double, double) { return y; },
                         [](double x, double, double z, double) { return z + x; }};
  scene.bodies[0].place = {.axis = Vec3::UnitZ(), .angle = std::numbers::pi / 2, .about = Vec3::Zero(), .move = Vec3(0, 5, 0)};
  const dynamics::Model model = build(scene).model;
  EXPECT_LT((model.mesh.X.rowwise().minCoeff() - Vec3(-1, 5, 0)).norm(), 1e-15);
  EXPECT_LT((model.mesh.X.rowwise().maxCoeff() - Vec3(0, 7, 2)).norm(), 1e-15);
  EXPECT_NEAR(model.mass.sum(), 2, 1e-15);
}

TEST(MakeMesh, RefusesMapsThatInvertElementsAndPlacesThatAreNone) {
  Scene scene = with({bar()});
  scene.bodies[0].map = {[](double x, double, double, double) { return -x; }, [](double, double y, double, double) { return y; },
                         [](double, double, double z, double) { return z; }};
  EXPECT_TRUE(says(refusal(scene), "body 'bar': 'map' leaves element 0 of 'bar' no positive volume: -1.")) << refusal(scene);
  EXPECT_TRUE(says(refusal(scene), "and 1 more"));
  scene.bodies[0].map[0] = constant(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(says(refusal(scene), "'map' is no finite number at x = 0, y = 0, z = 0"));
}

TEST(MakeMesh, RefusesWhatNoMeshHas) {
  Scene scene = with({bar()});
  scene.bodies[0].mesh = mesh::Box{Vec3(0, 0, 0), Vec3(2, 0, 1), {2, 1, 1}};
  EXPECT_TRUE(says(refusal(scene), "body 'bar': a box needs low < high along each axis")) << refusal(scene);
  scene.bodies[0].mesh = mesh::Box{Vec3(0, 0, 0), Vec3(2, 1, 1), {1000, 1000, 1000}};
  EXPECT_TRUE(says(refusal(scene), "more than a hundred million elements"));
  scene.bodies[0].mesh = mesh::Box{Vec3(0, 0, 0), Vec3(1e300, 1, 1), {2, 1, 1}};
  EXPECT_TRUE(says(refusal(scene), "a node stands 1e+300 m from the origin: expected less than 1e+30 m")) << refusal(scene);
  scene.bodies[0].mesh = mesh::Box{Vec3(0, 0, 0), Vec3(1e-100, 1e-100, 1e-100), {2, 1, 1}};
  EXPECT_TRUE(says(refusal(scene), "the body is 1.732e-100 m across: expected more than 1e-25 m")) << refusal(scene);
  scene.bodies[0].mesh = mesh::Box{Vec3(0, 0, 0), Vec3(1, 1e-300, 1), {2, 1, 1}};
  EXPECT_TRUE(says(refusal(scene), "a side of an element is 1e-300 m long: expected more than 1e-25 m")) << refusal(scene);
}

TEST(MakeMesh, RefusesAGivenMeshWithInvertedElements) {
  mesh::Mesh given = mesh::box("", {Vec3(0, 0, 0), Vec3(1, 1, 1), {1, 1, 1}});
  Scene scene = with({{.name = "bar", .mesh = given, .law = steel}});
  EXPECT_EQ(refusal(scene), "");
  for (int corner = 0; corner < 4; ++corner) std::swap(given.hexahedra[0].nodes(corner, 0), given.hexahedra[0].nodes(corner + 4, 0));
  scene.bodies[0].mesh = given;
  EXPECT_TRUE(says(refusal(scene), "body 'bar': the mesh leaves element 0 of 'bar' no positive volume")) << refusal(scene);
}

TEST(MakeMesh, RefusesAGivenMeshThatCannotBeOne) {
  const mesh::Mesh sound = mesh::box("", {Vec3(0, 0, 0), Vec3(1, 1, 1), {1, 1, 1}});
  const auto said_of = [](const mesh::Mesh& given) {
    return refusal(with({{.name = "bar", .mesh = given, .law = steel, .plate = sheet().plate}}));
  };
  EXPECT_EQ(said_of(sound), "");
  EXPECT_TRUE(says(said_of({}), "body 'bar': the mesh has no nodes")) << said_of({});
  for (const Index node : {-1, 8, 77}) {
    mesh::Mesh given = sound;
    given.hexahedra[0].nodes(3, 0) = node;
    EXPECT_TRUE(says(said_of(given), "the mesh has no node " + std::to_string(node) + ", which its region '' names")) << said_of(given);
    given = sound, given.surfaces[0].facets(0, 0) = node;
    EXPECT_TRUE(says(said_of(given), "which its surface '.")) << said_of(given);
    given = sound, given.node_sets.back().nodes = {node};
    EXPECT_TRUE(says(said_of(given), "which its node set '")) << said_of(given);
    given = sound, given.triangles = {{"", Table<3>::Constant(3, 1, node)}};
    EXPECT_TRUE(says(said_of(given), "the mesh has no node ")) << said_of(given);
  }
  mesh::Mesh given = sound;
  given.hexahedra[0].name = "lead";
  EXPECT_TRUE(says(said_of(given), "so its names begin with a point as '.x_low' does: its region 'lead' does not")) << said_of(given);
  given = sound, given.node_sets.clear();
  EXPECT_TRUE(says(said_of(given), "the mesh has no node set '' of all its nodes")) << said_of(given);
}

/// A given mesh of a bar with its second cell on nodes of its own, and what a file calls its elements.
Body cut_bar() {
  const mesh::Mesh half = mesh::box("", {Vec3(0, 0, 0), Vec3(1, 1, 1), {1, 1, 1}});
  mesh::Mesh both{.X = Vectors(3, 16), .hexahedra = {{"", Table<8>(8, 2)}}, .triangles = {}, .surfaces = {}, .node_sets = {{"", {}}}};
  both.X << half.X, half.X.colwise() + Vec3(1, 0, 0);
  both.hexahedra[0].nodes << half.hexahedra[0].nodes, (half.hexahedra[0].nodes.array() + 8).matrix();
  for (Index node = 0; node < 16; ++node) both.node_sets[0].nodes.push_back(node);
  return {.name = "bar", .mesh = both, .law = steel, .origin = {{40, 41}, 3}};
}

TEST(MakeMesh, WarnsOfWhatMayBeMeantWithTheNamesOfTheFile) {
  Scene scene = with({cut_bar()});
  scene.bodies[0].place.move = Vec3(0, 0, 7);
  const MeshWarnings warnings = build(scene).mesh_warnings;
  ASSERT_EQ(warnings.texts.size(), 2U);
  EXPECT_EQ(warnings.texts[0], "bar: 2 elements with a node at the place of another node, not joined to it: cells 40, 41 "
                               "(a run with --out shows them in offenders.pvd)");
  EXPECT_EQ(warnings.texts[1], "bar: its file has 3 points without an element (left out)");
  ASSERT_EQ(warnings.offenders.size(), 1U);
  EXPECT_EQ(warnings.offenders[0].of, "bar");
  EXPECT_EQ(warnings.offenders[0].numbers, (std::vector<std::int64_t>{40, 41}));
  EXPECT_EQ(warnings.offenders[0].X.row(2).minCoeff(), 7);  // where the body stands
  EXPECT_TRUE(build(with({bar(), wall()})).mesh_warnings.texts.empty());  // bodies that touch are no overlay
}

TEST(MakeMesh, WarnsOfABodyThatIsLaidOverAnother) {
  Scene scene = with({bar(), bar()});
  scene.bodies[1].name = "copy";
  const MeshWarnings warnings = build(scene).mesh_warnings;
  ASSERT_EQ(warnings.texts.size(), 1U);
  EXPECT_EQ(warnings.texts[0].substr(0, 24), "copy: lies on bar, 2 ele") << warnings.texts[0];
  EXPECT_TRUE(says(warnings.texts[0], ": is the same body given twice? (a run with --out shows them in offenders.pvd)"))
      << warnings.texts[0];
  ASSERT_EQ(warnings.offenders.size(), 1U);
  EXPECT_EQ(warnings.offenders[0].of, "copy");
  EXPECT_EQ(warnings.offenders[0].numbers, (std::vector<std::int64_t>{0, 1}));
}

TEST(MakeMesh, RefusesElementsThatCannotBeMeantAndShowsThem) {
  Body body = cut_bar();
  auto& nodes = std::get<mesh::Mesh>(body.mesh).hexahedra[0].nodes;
  std::swap(nodes(0, 1), nodes(1, 1));  // its volume is still positive
  try {
    build(with({body}));
    FAIL();
  } catch (const SceneError& error) {
    ASSERT_EQ(error.faults.size(), 1U);
    EXPECT_EQ(error.faults[0].message, "the mesh has 1 element whose Jacobian is not positive at a Gauss point, as where two nodes are "
                                       "exchanged: cells 41");
    ASSERT_EQ(error.faults[0].offenders.size(), 1U);
    EXPECT_EQ(error.faults[0].offenders[0].numbers, std::vector<std::int64_t>{41});
  }
}

TEST(MakeMesh, JudgesMappedMeshesAndPlacesAsWell) {
  Scene scene = with({bar()});
  scene.bodies[0].map = {[](double x, double y, double z, double) { return x == 0 && y == 0 && z == 0 ? 0.7 : x; },
                         [](double x, double y, double z, double) { return x == 0 && y == 0 && z == 0 ? 0.7 : y; },
                         [](double x, double y, double z, double) { return x == 0 && y == 0 && z == 0 ? 0.7 : z; }};
  EXPECT_TRUE(says(refusal(scene), "body 'bar': 'map' makes a mesh with 1 element whose Jacobian is not positive")) << refusal(scene);
  scene = with({bar()});
  scene.bodies[0].place.move = Vec3(1e15, 0, 0);
  EXPECT_TRUE(says(refusal(scene), "2 elements so far from the origin that fewer than six digits are left")) << refusal(scene);
}

TEST(MakeMesh, ScalesBeforeItMaps) {
  Scene scene = with({bar()});
  scene.bodies[0].scale = 1e-3;
  scene.bodies[0].map = {[](double x, double, double, double) { return x + 1; }, [](double, double y, double, double) { return y; },
                         [](double, double, double z, double) { return z; }};
  const mesh::Mesh mesh = build(scene).model.mesh;
  EXPECT_LT((mesh.X.rowwise().maxCoeff() - Vec3(1.002, 1e-3, 1e-3)).norm(), 1e-15);
  scene.bodies[0].scale = -1;
  EXPECT_TRUE(says(refusal(scene), "body 'bar': 'scale' = -1 is out of range")) << refusal(scene);
}

TEST(NamePoints, NamesTheNearestNodeAndRefusesWhatLiesBesideTheBody) {
  Scene scene = with({bar()});
  scene.bodies[0].points = {{.name = "tip", .near = Vec3(2, 0, 0)}};
  const mesh::Mesh mesh = build(scene).model.mesh;
  EXPECT_EQ(mesh.X.col(mesh::node_set(mesh, "bar.tip").front()), Vec3(2, 0, 0));
  scene.bodies[0].points = {{.name = "tip", .near = Vec3(3, 0, 0)}, {.name = "x_high", .near = Vec3(2, 0, 0)}};
  EXPECT_TRUE(says(refusal(scene), "point 'tip': 'near' lies 1 m beside 'bar'"));
  EXPECT_TRUE(says(refusal(scene), "point 'x_high': 'name' = x_high is that of a node set of the mesh already"));
}

TEST(HasPlates, TellsSolidsFromPlates) {
  EXPECT_TRUE(has_solids(bar().mesh) && !has_plates(bar().mesh));
  EXPECT_TRUE(has_plates(sheet().mesh) && !has_solids(sheet().mesh));
}

TEST(CountElements, KnowsEveryGenerator) {
  EXPECT_EQ(count_elements(bar().mesh), 2);
  EXPECT_EQ(count_elements(sheet().mesh), 4);
  for (const MeshOptions& options : std::initializer_list<MeshOptions>{
           mesh::Cylinder{1, 1, mesh::Revolution::full, 2, 1, 3}, mesh::Tube{1, 1, mesh::Revolution::quarter, 2, 3},
           mesh::Wedge{1, 1, 1, 2, 3, 4}, mesh::Revolved{{1, 2, 3}, {0, 1, 2}, {2, 1}, {1, 3}, {"x.", "xx"}, 1, 2},
           mesh::WedgeTube{1, 1, 1, 2, 3}, mesh::Sphere{1, mesh::SpherePart::half, 2, 1},
           mesh::Disc{1, mesh::Revolution::full, 2, 1}, mesh::WedgeDisc{1, 1, 2, 3}})
    EXPECT_EQ(count_elements(options), count_elements(make_mesh("a", options)));
}

}  // namespace
}  // namespace nereid::model::meshes_test
