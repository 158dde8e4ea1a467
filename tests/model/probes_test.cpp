#include "model/probes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "dynamics/measure.hpp"
#include "tests/model/scenes.hpp"

namespace nereid::model::probes_test {
namespace {

TEST(Measurables, HaveTheInternalVariablesOfAllLawsAndNoNameTwice) {
  std::set<std::string> names;
  for (const Measurable& one : measurables()) EXPECT_TRUE(names.insert(one.name).second) << one.name;
  EXPECT_TRUE(names.contains("plastic_strain"));
  EXPECT_EQ(find_measurable("speed"), nullptr);
}

TEST(MakeProbe, MeasuresEveryQuantityOfAScene) {
  Scene scene = with({bar(), wall()});
  scene.bodies[0].law = material::J2JohnsonCook{  // of all laws it has most internal variables
      8000, 200e9, 0.25, {1e8, 1e9, 0.3, 0.01, 1, 1, 293, 1793, 477, 0.9, 293}};
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.sections = {{.name = "cut", .body = "bar", .point = Vec3(0.5, 0, 0)}};
  for (const Measurable& one : measurables())
    scene.probes.push_back({.name = "p_" + one.name, .quantity = one.name,
                            .of = one.of == Of::contact || one.of == Of::any_contact || one.of == Of::source ? "touch"
                                  : one.of == Of::section                                                    ? "cut"
                                                                                                             : "bar",
                            .component = one.required ? one.components.back() : ""});
  scene.time.end = 1e-5;
  Simulation simulation = build(scene);
  run(simulation);
  for (const Measurable& one : measurables()) EXPECT_FALSE(std::isnan(probe(simulation, "p_" + one.name).last)) << one.name;
}

TEST(MakeProbe, TakesTheMeanForceOfAPlaneAlongItsNormal) {
  Scene scene = with({bar()});
  scene.planes = {{.name = "ground", .kind = load::PlaneKind::constrained, .nodes = {"bar"}, .normal = -Vec3::UnitZ()}};
  scene.gravity = Vec3(0, 0, -10);
  scene.probes = {{.name = "f", .quantity = "force", .of = "ground", .component = "normal"}};
  Simulation simulation = build(scene);
  run(simulation);
  EXPECT_NEAR(probe(simulation, "f").last, -160000, 1e-3);  // carries 16 t
}

TEST(MakeProbe, RefusesWhatCannotBeMeasured) {
  Scene scene = with({bar(), wall()});
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.probes = {{.name = "a", .quantity = "plastic_strain", .of = "bar"},
                  {.name = "b", .quantity = "force", .of = "touch", .component = "normal"},
                  {.name = "c", .quantity = "stress", .of = "bar"},
                  {.name = "d", .quantity = "velocity", .of = "bar", .component = "xx"}};
  scene.springs = {{.name = "spring", .from = "bar.far", .to = "wall.far", .stiffness = 1}};
  scene.bodies[0].points = {{.name = "far", .near = Vec3(0, 0, 0)}}, scene.bodies[1].points = {{.name = "far", .near = Vec3(4, 0, 0)}};
  scene.probes.push_back({.name = "e", .quantity = "impulse", .of = "spring"});
  const std::string said = refusal(scene);
  EXPECT_TRUE(says(said, "probe 'e': 'quantity' = impulse: spring is a spring"));
  EXPECT_TRUE(says(said, "probe 'a': 'quantity' = plastic_strain: the material of bar has no such variable"));
  EXPECT_TRUE(says(said, "probe 'b': 'component' = normal: touch is no plane and has no normal"));
  EXPECT_TRUE(says(said, "probe 'c': 'component' is missing: one of xx, yy"));
  EXPECT_TRUE(says(said, "probe 'd': 'component' = xx is unknown: components of velocity are magnitude, x, y, z"));
}

TEST(MakeProbe, AsksForAPlaceOfPlatesAndOfNothingElse) {
  Scene scene = with({bar(), sheet()});
  scene.probes = {{.name = "a", .quantity = "stress", .of = "sheet", .component = "xx"},
                  {.name = "b", .quantity = "von_mises", .of = "bar", .place = "top"},
                  {.name = "c", .quantity = "strain", .of = "sheet", .component = "xy", .place = "inside"}};
  const std::string said = refusal(scene);
  EXPECT_TRUE(says(said, "probe 'a': 'place' is missing: the stress of plates differs through their thickness: one of top, middle, bottom, "
                         "membrane")) << said;
  EXPECT_TRUE(says(said, "probe 'b': 'place' = top: bar has no plates: leave 'place' out")) << said;
  EXPECT_TRUE(says(said, "probe 'c': 'place' = inside is unknown: places of plates are top, middle, bottom, membrane")) << said;
}

TEST(MakeProbe, RefusesABodyOfSolidsAndPlatesAndTakesItsRegions) {
  mesh::Mesh both = mesh::box("", {Vec3(0, 0, 0), Vec3(2, 1, 1), {2, 1, 1}});
  both.hexahedra[0].name = ".core";
  both.triangles.push_back({".skin", mesh::surface(both, ".z_high").facets});
  Scene scene = with({{.name = "m", .mesh = both, .law = steel}});
  scene.bodies[0].plate.thickness = 2e-3;
  scene.probes = {{.name = "a", .quantity = "von_mises", .of = "m"}};
  const std::string said = refusal(scene);
  EXPECT_TRUE(says(said, "probe 'a': 'of' = m has solids and plates, whose von_mises differ: take one of its regions")) << said;
}

/// What the nodes have for which is_ahead(X). [kg m/s]
template <class Ahead>
Vec3 momentum_of(const Simulation& simulation, Ahead&& is_ahead) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index n = 0; n < simulation.state.v.cols(); ++n)
    if (is_ahead(Vec3(simulation.model.mesh.X.col(n)))) sum += simulation.model.mass(n) * simulation.state.v.col(n);
  return sum;
}

/// A long bar that swings in all directions.
Scene swinging() {
  Scene scene = with({bar()});
  scene.bodies[0].mesh = mesh::Box{Vec3(0, 0, 0), Vec3(4, 1, 1), {12, 3, 3}};
  scene.initial = {{.body = "bar", .displacement = false,
                    .value = {[](double x, double, double, double) { return x; }, [](double x, double, double z, double) { return x * z; },
                              [](double x, double y, double, double) { return 2 * x * x - y; }}}};
  scene.sections = {{.name = "cut", .body = "bar", .point = Vec3(2.5, 0.5, 0.5), .normal = Vec3::UnitX()},
                    {.name = "back", .body = "bar", .point = Vec3(2.5, 0.5, 0.5), .normal = -Vec3::UnitX()}};
  scene.probes = {{.name = "f", .quantity = "force", .of = "cut", .component = "x"},
                  {.name = "p", .quantity = "impulse", .of = "cut", .component = "x"},
                  {.name = "m", .quantity = "section_moment", .of = "cut", .component = "y"}};
  return scene;
}

TEST(Sections, HandOverTheMomentumOfWhatIsAhead) {
  Simulation simulation = build(swinging());
  const auto ahead = [](const Vec3& X) { return X.x() > 2.5; };
  const Vec3 before = momentum_of(simulation, ahead);
  run(simulation);
  const Vec3 gained = momentum_of(simulation, ahead) - before, impulse = simulation.state.sections[0].impulse;
  EXPECT_GT(gained.norm(), 1000);
  EXPECT_LT((gained - impulse).norm(), 1e-10 * gained.norm());  // round-off
  EXPECT_LT((simulation.state.sections[1].impulse + impulse).norm(), 1e-10 * impulse.norm()) << "what is behind gets the opposite";
  EXPECT_NEAR(probe(simulation, "p").last, impulse.x(), 1e-12 * std::abs(impulse.x()));
}

TEST(Sections, OfACylinderHandOverTheMomentumOfWhatIsOutside) {
  for (const double radius : {0.4, std::hypot(0.5, 1.0 / 6.0)}) {  // between nodes, and through some: these are within
    Scene scene = swinging();
    scene.sections.push_back({.name = "round", .body = "bar", .point = Vec3(7, 0.5, 0.5), .normal = Vec3::UnitX(), .radius = radius});
    Simulation simulation = build(scene);
    const auto outside = [&](const Vec3& X) { return std::hypot(X.y() - 0.5, X.z() - 0.5) > radius + 1e-6; };
    const Vec3 before = momentum_of(simulation, outside);
    run(simulation);
    const Vec3 gained = momentum_of(simulation, outside) - before;
    EXPECT_GT(gained.norm(), 10);
    EXPECT_LT((gained - simulation.state.sections[2].impulse).norm(), 1e-10 * gained.norm());
  }
}

TEST(Sections, HaveTheForceAndMomentOfAnEvenStress) {
  Scene scene = swinging();
  scene.time.end = 1e-9;
  scene.initial = {{.body = "bar", .displacement = true,
                    .value = {[](double x, double, double, double) { return 1e-5 * x; },
                              [](double, double y, double, double) { return -0.25e-5 * y; },
                              [](double, double, double z, double) { return -0.25e-5 * z; }}}};
  scene.sections[0].point = Vec3(2.5, 0, 2);
  Simulation simulation = build(scene);
  run(simulation);
  const double tension = 200e9 * 1e-5;  // on 1 m2, pulls what is ahead back
  EXPECT_NEAR(simulation.state.sections[0].force.x(), -tension, 1e-4 * tension);  // the stress of a displacement is linear up to its strain
  EXPECT_NEAR(simulation.state.sections[0].moment.y(), (0.5 - 2) * -tension, 1e-4 * tension);
  EXPECT_NEAR(simulation.state.sections[0].moment.z(), -0.5 * -tension, 1e-4 * tension);
}

TEST(Sections, AreRefusedWhereTheyCutNothing) {
  Scene scene = swinging();
  scene.sections[1] = {.name = "beside", .body = "bar", .point = Vec3(5, 0, 0), .normal = Vec3::UnitX()};
  EXPECT_TRUE(says(refusal(scene), "the plane does not cut bar: all its nodes are on one side"));
  scene.sections[1] = {.name = "around", .body = "bar", .normal = Vec3::UnitX(), .radius = 2};
  EXPECT_TRUE(says(refusal(scene), "the cylinder does not cut bar: all its nodes are on one side"));
  scene.sections[1].radius = -1, scene.sections[1].normal = Vec3(1, 1, 0);
  EXPECT_TRUE(says(refusal(scene), "'radius' = -1"));
  EXPECT_TRUE(says(refusal(scene), "'normal'"));
  scene.sections[1] = {.name = "cut", .body = "bar"};
  EXPECT_TRUE(says(refusal(scene), "'name' = cut is given twice"));
  scene.sections[1] = {.name = "rod", .body = "rod"};
  EXPECT_TRUE(says(refusal(scene), "'body' = rod is unknown"));
  scene = swinging();
  scene.bodies[0].rigid = true, scene.initial.clear();
  EXPECT_TRUE(says(refusal(scene), "is a rigid body: no stress carries a force across it"));
}

/// What a contact presses on a body: the sum of pressure times area over its apexes there, its forces on the nodes along z, and the area.
struct Pressed {
  double pressure_by_area = 0, force = 0, area = 0;
};
Pressed pressed(const Simulation& simulation, const std::string& body) {
  const dynamics::View view{simulation.model, simulation.state, simulation.forces, true};
  const Subset& nodes = mesh::node_set(simulation.model.mesh, body);
  const auto is_inside = [&](Index node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
  Pressed sum;
  for (std::size_t c = 0; c < simulation.model.interfaces.size(); ++c) {
    const contact::Interface& interface = simulation.model.interfaces[c];
    if (interface.kind == contact::InterfaceKind::edges) continue;
    const auto forces = dynamics::forces_of_contact(view, c);
    sum.force = 0;  // of the whole contact, whatever its pass
    for (const contact::NodeForce& one : forces)
      if (is_inside(one.node)) sum.force += one.push.z();
    for (Index a = 0; a < static_cast<Index>(interface.apexes.size()); ++a) {
      if (!is_inside(interface.apexes[static_cast<std::size_t>(a)])) continue;
      const double pressure = dynamics::traction_at(view, c, a, forces).pressure, area = dynamics::area_across(view, c, a, Vec3::UnitZ());
      const double other = dynamics::area_across(view, c, a, -Vec3::UnitZ());
      sum.pressure_by_area += pressure * std::max(area, other), sum.area += pressure > 0 ? std::max(area, other) : 0;
    }
  }
  return sum;
}

TEST(ContactPressure, TimesAreaSumsToTheForceOfEveryKindPassAndMethod) {
  constexpr double size = 60e-3, pressure = 1e6;
  Body block{.name = "block", .mesh = mesh::Box{Vec3(0, 0, 0), Vec3(size, size, 20e-3), {3, 3, 1}}, .law = steel};
  Body skin{.name = "skin", .mesh = mesh::Sheet{size, size, 4, 4, mesh::Cuts::columns}, .law = steel};
  skin.plate.thickness = 2e-3, skin.place.move = Vec3(0, 0, 21e-3);
  enum Kind { skin_on_block, block_on_skin, two_passes, automatic };
  for (const Kind kind : {skin_on_block, block_on_skin, two_passes, automatic})
    for (const auto method : {contact::Method::multiplier, contact::Method::penalty}) {
      SCOPED_TRACE(std::to_string(kind) + (method == contact::Method::penalty ? " penalty" : " multiplier"));
      Scene scene = with({block, skin});
      scene.planes = {{.name = "ground", .kind = load::PlaneKind::fixed, .nodes = {"block.z_low"}}};
      scene.loads = {{.name = "push", .kind = LoadKind::pressure, .on = "skin.top", .value = uniform(Vec3(pressure, 0, 0))}};
      scene.time.end = 20e-6;
      dynamics::InterfaceOptions options;
      options.method = method, options.two_passes = kind == two_passes;
      Contact pair{.name = "touch", .apexes = "skin.bottom", .base = "block.z_high", .interface = options};
      if (kind == block_on_skin) std::swap(pair.apexes, pair.base);
      if (kind == automatic) scene.automatic_contacts = {{.name = "touch", .interface = options}};
      else scene.contacts = {pair};
      Simulation simulation = build(scene);
      run(simulation);
      const Pressed below = pressed(simulation, "block"), above = pressed(simulation, "skin");
      EXPECT_GT(above.force, 0.1 * pressure * size * size);
      EXPECT_NEAR(below.force, -above.force, 1e-9 * above.force);
      if (kind != skin_on_block) {
        EXPECT_NEAR(below.pressure_by_area, above.force, 1e-6 * above.force);  // normals turn by strains
        EXPECT_LT(below.area, size * size * (1 + 1e-4));
      }
      if (kind != block_on_skin) {
        EXPECT_NEAR(above.pressure_by_area, above.force, 1e-6 * above.force);
        EXPECT_LT(above.area, size * size * (1 + 1e-4));
      }
    }
}

/// A bar that flies into a wall; they touch by an automatic contact or by a declared one.
Scene struck(bool automatic, contact::Method method) {
  Scene scene = with({bar(), wall()});
  scene.time.end = 2e-3;
  scene.bodies[0].place.move = Vec3(-0.001, 0, 0);
  scene.initial = {{.body = "bar", .displacement = false, .value = uniform(Vec3(10, 0, 0))}};
  dynamics::InterfaceOptions options;
  options.method = method;
  if (automatic) scene.automatic_contacts = {{.name = "touch", .interface = options}};
  else scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low", .interface = options}};
  return scene;
}

TEST(Touched, HandsOverTheMomentumOfTheBodies) {
  for (const bool automatic : {false, true})
    for (const auto method : {contact::Method::multiplier, contact::Method::penalty}) {
      Simulation simulation = build(struck(automatic, method));
      EXPECT_TRUE(dynamics::touched(simulation.model, simulation.state).empty());
      run(simulation);
      const Vec3 gained = momentum_of(simulation, [](const Vec3& X) { return X.x() > 1.9995; });
      const auto all = dynamics::touched(simulation.model, simulation.state);
      SCOPED_TRACE(std::string(automatic ? "automatic" : "declared") + (method == contact::Method::penalty ? " penalty" : " multiplier"));
      ASSERT_EQ(all.size(), 1U);
      EXPECT_EQ(all[0].contact, "touch");
      EXPECT_EQ(all[0].sides[0], automatic ? "bar" : "apexes");
      EXPECT_GT(gained.x(), 1000);
      EXPECT_LT((gained + all[0].impulse).norm(), 1e-10 * gained.norm());  // round-off
      EXPECT_LT(all[0].first, 1.2e-4);  // multipliers slow down at the start what would pass the gap in the first step
      EXPECT_GT(all[0].last, all[0].first + 5e-4);
      EXPECT_LT(all[0].last, simulation.state.t) << "the bar has flown off";
    }
}

TEST(Touched, CountsWhatStopsAtTheStart) {
  Scene scene = struck(true, contact::Method::multiplier);
  scene.bodies[0].place.move = Vec3::Zero();
  Simulation simulation = build(scene);
  run(simulation);
  const auto all = dynamics::touched(simulation.model, simulation.state);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].first, 0);
  Vec3 wall = Vec3::Zero();
  for (const Index node : mesh::node_set(simulation.model.mesh, "wall")) wall += simulation.model.mass(node) * simulation.state.v.col(node);
  EXPECT_LT((wall + all[0].impulse).norm(), 1e-10 * wall.norm());
  EXPECT_GT(wall.x(), 1000);
}

}  // namespace
}  // namespace nereid::model::probes_test
