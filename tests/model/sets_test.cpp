// Sets of a body by place: nodes, surfaces and elements; what probes and materials take of them.

#include "model/sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "element/block.hpp"
#include "model/build.hpp"
#include "tests/model/scenes.hpp"

namespace nereid::model::sets_test {
namespace {

Zone box(const Vec3& low, const Vec3& high) { return {.kind = Zone::Kind::box, .from = low, .to = high}; }

/// A bar of 10 x 2 x 2 cubes of 0.1 m, with one end at the origin.
Scene bar(std::vector<Set> sets) {
  Scene scene;
  scene.bodies = {{.name = "bar",
                   .mesh = mesh::Box{Vec3::Zero(), Vec3(1, 0.2, 0.2), {10, 2, 2}},
                   .sets = std::move(sets),
                   .law = material::Elastic{1000, 1e9, 0.25}}};
  scene.time.end = 1e-6;
  return scene;
}

TEST(Zone, HoldsItsPlacesAndItsBoundary) {
  const Zone sphere{.kind = Zone::Kind::sphere, .from = Vec3(1, 0, 0), .radius = 2};
  EXPECT_TRUE(holds(sphere, Vec3(3, 0, 0), 1e-9));
  EXPECT_FALSE(holds(sphere, Vec3(3.001, 0, 0), 1e-9));
  const Zone cylinder{.kind = Zone::Kind::cylinder, .from = Vec3(0, 0, 1), .to = Vec3(0, 0, 3), .radius = 0.5};
  EXPECT_TRUE(holds(cylinder, Vec3(0.3, 0.4, 3), 1e-9));
  EXPECT_FALSE(holds(cylinder, Vec3(0.3, 0.41, 2), 1e-9));
  EXPECT_FALSE(holds(cylinder, Vec3(0, 0, 0.9), 1e-9));
  EXPECT_FALSE(holds(cylinder, Vec3(0, 0, 3.1), 1e-9));
  const Vec3 n = Vec3(1, 1, 0).normalized();
  EXPECT_TRUE(holds({.kind = Zone::Kind::plane, .from = Vec3(1, 0, 0), .normal = n}, Vec3(0, 1, 7), 1e-9));
  EXPECT_FALSE(holds({.kind = Zone::Kind::plane, .from = Vec3(1, 0, 0), .normal = n}, Vec3(0, 1.1, 7), 1e-9));
  EXPECT_TRUE(holds({.kind = Zone::Kind::half_space, .from = Vec3(1, 0, 0), .normal = n}, Vec3(0, 1.1, 7), 1e-9));
  EXPECT_FALSE(holds({.kind = Zone::Kind::half_space, .from = Vec3(1, 0, 0), .normal = n}, Vec3(0, 0.9, 7), 1e-9));
  EXPECT_TRUE(holds(box(Vec3::Zero(), Vec3::Ones()), Vec3(1, 1, 1), 0));
  EXPECT_FALSE(holds(box(Vec3::Zero(), Vec3::Ones()), Vec3(1, 1, 1.01), 1e-9));
}

TEST(Sets, HaveNodesAndThePartOfTheSkinBetweenThem) {
  const Simulation simulation = build(bar({{.name = "end", .zone = box(Vec3(0.85, 0, 0), Vec3(1, 1, 1))},
                                           {.name = "tip", .all_of = {"end", "x_high"}},
                                           {.name = "ends", .any_of = {"x_low", "x_high"}},
                                           {.name = "inner", .zone = box(Vec3::Zero(), Vec3::Ones()), .without = {"skin"}}}));
  const mesh::Mesh& mesh = simulation.model.mesh;
  EXPECT_EQ(mesh::node_set(mesh, "bar.end").size(), 18U);
  EXPECT_EQ(mesh::node_set(mesh, "bar.tip"), mesh::node_set(mesh, "bar.x_high"));
  EXPECT_EQ(mesh::node_set(mesh, "bar.ends").size(), 18U);
  EXPECT_EQ(mesh::node_set(mesh, "bar.inner").size(), 9U);
  EXPECT_EQ(mesh::surface(mesh, "bar.tip").facets.cols(), 8);
  EXPECT_EQ(mesh::surface(mesh, "bar.end").facets.cols(), 8 + 4 * 2 * 2) << "the end face, and one cell of each side";
  EXPECT_EQ(mesh::surface(mesh, "bar.ends").facets.cols(), 16);
}

TEST(Sets, MoveWithTheBody) {
  Scene scene = bar({{.name = "end", .zone = box(Vec3(5.85, 0, 0), Vec3(6, 1, 1))}});
  scene.bodies[0].place.move = Vec3(5, 0, 0);
  EXPECT_EQ(mesh::node_set(build(scene).model.mesh, "bar.end").size(), 18U);
  scene.bodies[0].place.axis = Vec3::UnitZ(), scene.bodies[0].place.angle = 0.5 * pi;  // along y, then moved
  scene.bodies[0].sets[0].zone = box(Vec3(4.8, 0.85, 0), Vec3(5, 1, 1));
  EXPECT_EQ(mesh::node_set(build(scene).model.mesh, "bar.end").size(), 18U);
  scene.bodies[0].map = {[](double x, double, double, double) { return 2 * x; }, [](double, double y, double, double) { return y; },
                         [](double, double, double z, double) { return z; }};
  scene.bodies[0].sets[0].zone = box(Vec3(4.8, 1.7, 0), Vec3(5, 2, 1));
  EXPECT_EQ(mesh::node_set(build(scene).model.mesh, "bar.end").size(), 18U) << "after the map";
}

TEST(Sets, OfPlatesHaveBothSides) {
  Scene scene = bar({{.name = "half", .zone = box(Vec3::Zero(), Vec3(0.5, 1, 1))}});
  scene.bodies[0].mesh = mesh::Sheet{.length = 1, .width = 1, .cells_along = 4, .cells_across = 4};
  scene.bodies[0].plate.thickness = 0.01;
  const mesh::Mesh mesh = build(scene).model.mesh;
  const Table<3> top = mesh::surface(mesh, "bar.half_top").facets, bottom = mesh::surface(mesh, "bar.half_bottom").facets;
  EXPECT_EQ(top.cols(), 16);
  EXPECT_EQ(bottom.cols(), 16);
  EXPECT_EQ(mesh::facet_areas(mesh, mesh::surface(mesh, "bar.half_top")).sum(), 0.5);
  EXPECT_EQ(top(0, 0), bottom(1, 0));
}

TEST(Sets, AreRefusedWithoutNodesAndElementsAndWithNamesThatAreTakenOrNameNothing) {
  const std::string far = refusal(bar({{.name = "far", .zone = box(Vec3(2, 0, 0), Vec3(3, 1, 1))}}));
  EXPECT_TRUE(says(far, "'far' has neither nodes nor elements: 'bar' reaches from (0, 0, 0) m to (1, 0.2, 0.2) m")) << far;
  EXPECT_TRUE(says(refusal(bar({{.name = "x_low", .zone = box(Vec3::Zero(), Vec3::Ones())}})), "is that of a node set"));
  EXPECT_TRUE(says(refusal(bar({{.name = "a", .any_of = {"x_lov"}}})), "did you mean 'x_low'?"));
  EXPECT_TRUE(says(refusal(bar({{.name = "a", .any_of = {"b"}}, {.name = "b", .any_of = {"x_low"}}})), "sets above this one"));
  EXPECT_TRUE(says(refusal(bar({{.name = "a"}})), "a set needs one of"));
}

TEST(Sets, HoldPlacesThatAreAMillionthOfTheBodyBesideAZone) {
  const double size = std::sqrt(1 + 2 * 0.2 * 0.2);
  const auto nodes = [size](double beside) {  // of the end at x = 1
    const Scene scene =
        bar({{.name = "end", .zone = box(Vec3(1 + beside * size, 0, 0), Vec3(2, 1, 1))}, {.name = "x", .any_of = {"x_low"}}});
    return refusal(scene).empty() ? mesh::node_set(build(scene).model.mesh, "bar.end").size() : 0U;
  };
  EXPECT_EQ(nodes(0.9e-6), 9U);
  EXPECT_EQ(nodes(1.5e-6), 0U);
}

TEST(Sets, AreJudgedOneByOneAndBodiesBesideThemChangeNothing) {
  Scene scene = bar({{.name = "far", .zone = box(Vec3(2, 0, 0), Vec3(3, 1, 1))},
                     {.name = "farther", .zone = box(Vec3(4, 0, 0), Vec3(5, 1, 1))},
                     {.name = "of_far", .any_of = {"far"}}});
  const std::string said = refusal(scene);
  EXPECT_TRUE(says(said, "'far' has neither")) << said;
  EXPECT_TRUE(says(said, "'farther' has neither")) << said;
  // a middle 1e-4 beside a zone is outside of it, however far another body lies
  scene = bar({{.name = "end", .zone = box(Vec3(0.9501, 0, 0), Vec3(1, 1, 1))},
               {.name = "most", .zone = box(Vec3(0.8499, 0, 0), Vec3(1, 1, 1))}});
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[1].name = "other", scene.bodies[1].place.move = Vec3(1000, 0, 0), scene.bodies[1].sets.clear();
  const Simulation simulation = build(scene);
  const auto count = [&](const char* set) {
    const auto inside = elements_in(scene.bodies[0], set, simulation.model.mesh, element::nodes(simulation.model.blocks[0]));
    return std::count(inside.begin(), inside.end(), 1);
  };
  EXPECT_EQ(count("end"), 0);
  EXPECT_EQ(count("most"), 8);
}

TEST(Elements, OfASetAreThoseWhoseMiddleLiesInItAndANodeSetHasNone) {
  const Scene scene = bar({{.name = "end", .zone = box(Vec3(0.85, 0, 0), Vec3(1, 1, 1))},
                           {.name = "none", .any_of = {"x_low"}},
                           {.name = "rest", .zone = box(Vec3::Zero(), Vec3::Ones()), .without = {"end"}}});
  const Simulation simulation = build(scene);
  const Body& body = scene.bodies[0];
  const auto count = [&](const char* set) {
    const auto inside = elements_in(body, set, simulation.model.mesh, element::nodes(simulation.model.blocks[0]));
    return std::count(inside.begin(), inside.end(), 1);
  };
  EXPECT_EQ(count("end"), 8) << "the middles at 0.85 lie on its boundary";
  EXPECT_EQ(count("rest"), 32);
  EXPECT_FALSE(has_elements(body, "none"));
  const Scene mixed = bar({{.name = "end", .zone = box(Vec3(0.85, 0, 0), Vec3(1, 1, 1))},
                           {.name = "inside", .zone = box(Vec3::Zero(), Vec3::Ones()), .without = {"skin"}},
                           {.name = "both", .any_of = {"end", "x_low"}}});
  EXPECT_FALSE(has_elements(mixed.bodies[0], "inside"));
  EXPECT_FALSE(has_elements(mixed.bodies[0], "both"));
}

TEST(Parts, HaveTheirMaterialAndTheBodyKeepsTheRest) {
  Scene scene = bar({{.name = "end", .zone = box(Vec3(0.5, 0, 0), Vec3(1, 1, 1))}});
  scene.bodies[0].parts = {{.of = "end", .law = material::Elastic{3000, 2e9, 0.25}}};
  const Simulation simulation = build(scene);
  ASSERT_EQ(simulation.model.blocks.size(), 2U);
  EXPECT_EQ(element::name(simulation.model.blocks[0]), "bar");
  EXPECT_EQ(element::name(simulation.model.blocks[1]), "bar.end");
  EXPECT_EQ(element::tiling(simulation.model.blocks[1]).elements, 20);
  EXPECT_NEAR(dynamics::total_mass(simulation.model), 0.02 * 1000 + 0.02 * 3000, 1e-12);
  EXPECT_EQ(std::visit([](const auto& block) { return material::stiffness(block.law); }, simulation.model.blocks[1]), 2e9);
}

TEST(Parts, OfARigidBodyHaveTheirDensity) {
  Scene scene = bar({{.name = "end", .zone = box(Vec3(0.5, 0, 0), Vec3(1, 1, 1))}});
  scene.bodies[0].parts = {{.of = "end", .law = material::Elastic{3000, 2e9, 0.25}}};
  scene.bodies[0].rigid = true;
  const Simulation simulation = build(scene);
  EXPECT_NEAR(simulation.model.rigid_bodies[0].mass.mass, 80, 1e-12);
  EXPECT_NEAR(simulation.model.rigid_bodies[0].mass.centre.x(), (20 * 0.25 + 60 * 0.75) / 80, 1e-12);
}

TEST(Parts, ThatCoverTheBodyAreRemarked) {
  Scene scene = bar({{.name = "all", .zone = box(Vec3::Zero(), Vec3::Ones())},
                     {.name = "end", .zone = box(Vec3(0.5, 0, 0), Vec3(1, 1, 1))}});
  scene.bodies[0].parts = {{.of = "end", .law = material::Elastic{3000, 2e9, 0.25}},
                           {.of = "all", .law = material::Elastic{2000, 2e9, 0.25}}};
  const std::vector<std::string> remarks = build(scene).remarks;
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_TRUE(says(remarks[0], "no element has its 'material'")) << remarks[0];
  EXPECT_TRUE(says(remarks[1], "no element has the material of 'end'")) << remarks[1];
  scene.bodies[0].parts[1].of = "end";
  EXPECT_TRUE(says(refusal(scene), "'of' = end is given twice")) << refusal(scene);
  scene.bodies[0].parts = {{.of = "x_low", .law = material::Elastic{3000, 2e9, 0.25}}};
  EXPECT_TRUE(says(refusal(scene), "is a node set and has no elements")) << refusal(scene);
}

TEST(Parts, AreRefusedWhereTheyNameNothingOrAreFluids) {
  Scene scene = bar({{.name = "end", .zone = box(Vec3(0.5, 0, 0), Vec3(1, 1, 1))}});
  scene.bodies[0].parts = {{.of = "ende", .law = material::Elastic{3000, 2e9, 0.25}}};
  EXPECT_TRUE(says(refusal(scene), "did you mean 'end'?"));
  scene.bodies[0].parts = {{.of = "end", .law = material::LinearFluid{1000, 2e9, 0}}};
  EXPECT_TRUE(says(refusal(scene), "fluid"));
}

}  // namespace
}  // namespace nereid::model::sets_test
