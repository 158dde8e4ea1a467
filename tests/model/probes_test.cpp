#include "model/probes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/measure.hpp"
#include "model/notes.hpp"
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
  Scene scene = with({bar(), wall(), bar()});
  Body& water = scene.bodies[2];
  water.name = "water", water.place.move = Vec3(0, 10, 0);
  water.law = material::LinearFluid{1000, 2e9}, water.solid = element::Fluid::Options{};
  const auto is_of_fluid = [](const std::string& quantity) {
    return quantity == "density" || quantity == "internal_energy" || quantity == "void_fraction";
  };
  scene.bodies[0].law = material::J2JohnsonCook{  // of all laws it has most internal variables
      8000, 200e9, 0.25, {1e8, 1e9, 0.3, 0.01, 1, 1, 293, 1793, 477, 0.9, 293}};
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.sections = {{.name = "cut", .body = "bar", .point = Vec3(0.5, 0, 0)}};
  for (const Measurable& one : measurables())
    scene.probes.push_back({.name = "p_" + one.name, .quantity = one.name,
                            .of = one.of == Of::contact || one.of == Of::any_contact || one.of == Of::source ? "touch"
                                  : one.of == Of::section                                                    ? "cut"
                                  : one.of == Of::surface                                                    ? "water.y_high"
                                  : is_of_fluid(one.name)                                                    ? "water"
                                                                                                             : "bar",
                            .component = one.required ? one.components.back() : ""});
  scene.gravity = Vec3(0, -10, 0);
  scene.time.end = 1e-5;
  Simulation simulation = build(scene);
  run(simulation);
  for (const Measurable& one : measurables()) EXPECT_FALSE(std::isnan(probe(simulation, "p_" + one.name).last)) << one.name;
}

TEST(MakeProbe, HasTheEnergyOfAWaveAboveTheMeanLevelOfTheStart) {
  Scene scene = with({bar()});
  Body& water = scene.bodies[0];
  water.name = "water", water.law = material::LinearFluid{1000, 2e9}, water.solid = element::Fluid::Options{};
  scene.gravity = Vec3(0, 0, -10);
  scene.probes = {{.name = "wave", .quantity = "wave_energy", .of = "water.z_high"}};
  Simulation simulation = build(scene);
  const Vectors start = simulation.state.x;
  const mesh::Surface& top = mesh::surface(simulation.model.mesh, "water.z_high");
  double length = 0, width = 0;
  for (const Index n : mesh::surface_nodes(top)) length = std::max(length, start(0, n)), width = std::max(width, start(1, n));
  // it leans by 0.1 about its middle line, and sinks by 0.02:  int eta^2 dA = area (0.1^2 length^2/12 + 0.02^2)
  for (Index n = 0; n < start.cols(); ++n) simulation.state.x(2, n) += 0.1 * (start(0, n) - 0.5 * length) - 0.02;
  const double expected = 0.5 * 1000 * 10 * length * width * (0.01 * length * length / 12 + 0.0004);
  dynamics::Kept kept;
  EXPECT_NEAR(simulation.probes[0].value(view(simulation), kept), expected, 1e-9 * expected);
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

TEST(Sections, OfAPlateHaveTheMomentsOfItsNodesSoThatBothSidesBalance) {
  const auto nothing = [](double, double, double, double) { return 0.0; };
  Scene scene = with({sheet()});
  scene.bodies[0].mesh = mesh::Sheet{4, 1, 12, 3};
  scene.initial = {{.body = "sheet", .displacement = false,
                    .value = {nothing, nothing, [](double x, double y, double, double) { return x * x + 0.5 * x * y; }}}};
  scene.sections = {{.name = "cut", .body = "sheet", .point = Vec3(2.5, 0.5, 1.5), .normal = Vec3::UnitX()},
                    {.name = "back", .body = "sheet", .point = Vec3(2.5, 0.5, 1.5), .normal = -Vec3::UnitX()}};
  Simulation simulation = build(scene);
  run(simulation);
  const Vec3 moment = simulation.state.sections[0].moment;
  EXPECT_GT(std::abs(moment.y()), 1);
  EXPECT_LT((simulation.state.sections[1].moment + moment).norm(), 1e-10 * moment.norm());
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
  for (std::size_t c = 0; c < simulation.model.contacts.size(); ++c) {
    if (contact::interface_of(simulation.model.contacts[c]) == nullptr) continue;
    const contact::Interface& interface = *contact::interface_of(simulation.model.contacts[c]);
    const auto forces = dynamics::forces_of_contact(view.model, view.now, c);
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
  for (const double end : {14e-6, 18e-6, 20e-6})  // round-off differs: a sheet has the same area on both sides but for that
    for (const Kind kind : {skin_on_block, block_on_skin, two_passes, automatic})
      for (const auto method : {contact::Method::multiplier, contact::Method::penalty}) {
        SCOPED_TRACE(std::to_string(kind) + (method == contact::Method::penalty ? " penalty" : " multiplier"));
        Scene scene = with({block, skin});
        scene.planes = {{.name = "ground", .kind = load::PlaneKind::fixed, .nodes = {"block.z_low"}}};
        scene.loads = {{.name = "push", .kind = LoadKind::pressure, .on = "skin.top", .value = uniform(Vec3(pressure, 0, 0))}};
        scene.time.end = end;
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
          EXPECT_NEAR(below.pressure_by_area, above.force, 1e-4 * above.force);  // pushes at corners lean by edges
          EXPECT_LT(below.area, size * size * (1 + 1e-4));
        }
        if (kind != block_on_skin) {
          EXPECT_NEAR(above.pressure_by_area, above.force, 1e-4 * above.force);
          EXPECT_LT(above.area, size * size * (1 + 1e-4));
        }
      }
}

TEST(ContactPressure, OfTwoPassesIsTheLargestOfBothSurfacesWhicheverHasTheApexes) {
  constexpr double pressure = 1e6;
  int larger_on_the_base = 0;
  enum Kind { points, two_passes, two_passes_by_penalty };
  for (const Kind kind : {points, two_passes, two_passes_by_penalty})
    for (const bool small_has_apexes : {true, false}) {
      Scene scene;
      scene.bodies = {{.name = "large", .mesh = mesh::Box{Vec3(0, 0, -20e-3), Vec3(60e-3, 60e-3, 0), {2, 2, 1}}, .law = steel},
                      {.name = "small", .mesh = mesh::Box{Vec3(17e-3, 13e-3, 0), Vec3(37e-3, 33e-3, 20e-3), {3, 3, 1}}, .law = steel}};
      scene.planes = {{.name = "ground", .kind = load::PlaneKind::fixed, .nodes = {"large.z_low"}}};
      scene.loads = {{.name = "push", .kind = LoadKind::pressure, .on = "small.z_high", .value = uniform(Vec3(pressure, 0, 0))}};
      scene.time.end = 14e-6, scene.recording.history = 14e-6;
      dynamics::InterfaceOptions options;
      options.two_passes = true;
      if (kind == points) options.heights = contact::Heights::points;
      if (kind == two_passes_by_penalty) options.method = contact::Method::penalty;
      scene.contacts = {{.name = "touch", .apexes = "small.z_low", .base = "large.z_high", .interface = options}};
      if (!small_has_apexes) std::swap(scene.contacts[0].apexes, scene.contacts[0].base);
      scene.probes = {{.name = "p", .quantity = "contact_pressure", .of = "touch"}};
      Simulation simulation = build(scene);
      run(simulation);
      const mesh::Mesh& mesh = simulation.model.mesh;
      Vectors force = Vectors::Zero(3, mesh.X.cols()), moment = Vectors::Zero(3, 0);
      for (std::size_t c = 0; c < simulation.model.contacts.size(); ++c)
        contact::with_memory(simulation.model.contacts[c], simulation.state.contacts[c],
                             [&](const auto& one, const auto& memory) { contact::add_forces(one, memory, force, moment); });
      std::array<double, 2> largest{};
      for (const bool of_small : {false, true}) {
        const std::string face = of_small ? "small.z_low" : "large.z_high";
        const Subset& nodes = mesh::node_set(mesh, face);
        const Scalars areas = mesh::tributary_areas(mesh, mesh::surface(mesh, face), nodes);
        for (std::size_t i = 0; i < nodes.size(); ++i)
          largest[of_small] =
              std::max(largest[of_small], (of_small ? 1 : -1) * force(2, nodes[i]) / areas(static_cast<Eigen::Index>(i)));
      }
      const double expected = std::max(largest[0], largest[1]);
      EXPECT_GT(expected, 0.1 * pressure);
      EXPECT_NEAR(probe(simulation, "p").last, expected, 1e-3 * expected) << kind << " " << small_has_apexes;
      larger_on_the_base += largest[!small_has_apexes] > 1.5 * largest[small_has_apexes];
    }
  EXPECT_GT(larger_on_the_base, 0);
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

// --- all pairs -----------------------------------------------------------------------------------
//
// Every quantity of every target with every component: a word that is accepted has the value that its definition says. Which pairs are
// accepted stands in probe_pairs.csv; NEREID_WRITE=1 writes it anew.

constexpr double end = 6e-5;  // [s]

/// Something that a probe may be of. A source of force acts on `body` alone, which feels nothing else.
struct Target {
  std::string name, kind;
  std::string body = {};
  Vec3 normal = Vec3::Zero();  ///< of planes that have one
  std::function<bool(const Vec3&)> ahead = {};  ///< of sections: the part of the body that feels it
};

/// A cube of 1 m whose lower corner is at 10 i, so that each stands alone.
Body cube(const std::string& name, int i, double below = 0) {
  const Vec3 low(10.0 * i, 0, -below);
  Body body{.name = name, .mesh = mesh::Box{low, low + Vec3(1, 1, 1), {2, 2, 2}}, .law = steel};
  body.points = {{.name = "tip", .near = low + Vec3(1, 1, 1)}};
  return body;
}

/// A scene with a target of each kind, and what these are.
struct Everything {
  Scene scene;
  std::vector<Target> targets;
};

Everything everything() {
  Everything all;
  Scene& scene = all.scene;
  scene.time.end = end, scene.recording.history = end;
  int place = 0;
  // about where the body stands; a rigid motion without shear
  const auto thrown = [&](const std::string& body, int at, const Vec3& velocity, double shear = 5) {
    const double low = 10.0 * at;
    scene.initial.push_back({.body = body, .displacement = false,
                             .value = {[=](double, double y, double z, double) { return velocity.x() + 2 * y - z; },
                                       [=](double x, double, double z, double) {
                                         return velocity.y() - 2 * (x - low) + 3 * z + shear * z * (x - low);
                                       },
                                       [=](double x, double y, double, double) { return velocity.z() + (x - low) - 3 * y; }}});
  };
  const auto source = [&](const std::string& kind, const Vec3& normal, auto&& add) {
    const std::string body = "b" + std::to_string(place);
    scene.bodies.push_back(cube(body, place++));
    thrown(body, place - 1, Vec3(3, -2, -20));
    add(body);
    all.targets.push_back({"of_" + body, kind, body, normal, {}});
  };
  const Vec3 oblique = Vec3(1, 2, -2) / 3;
  const auto plane = [&](const std::string& kind, load::PlaneKind word, const Vec3& normal) {
    source(kind, word == load::PlaneKind::fixed || word == load::PlaneKind::driven ? Vec3(0, 0, 0) : normal, [&](const std::string& body) {
      Plane one{.name = "of_" + body, .kind = word, .nodes = {body + ".z_low"}, .point = Vec3(0, 0, 0), .normal = normal};
      if (word == load::PlaneKind::driven) one.field = uniform(Vec3(1, 2, 3));
      scene.planes.push_back(one);
    });
  };
  plane("constrained plane", load::PlaneKind::constrained, oblique);
  plane("symmetry plane", load::PlaneKind::symmetry, Vec3::UnitZ());
  plane("fixed plane", load::PlaneKind::fixed, oblique);
  plane("driven plane", load::PlaneKind::driven, oblique);
  plane("floor", load::PlaneKind::floor, Vec3::UnitZ());
  source("rigid plane", Vec3::UnitZ(), [&](const std::string& body) {
    scene.rigid_planes.push_back({.name = "of_" + body, .surface = body + ".z_low", .point = Vec3(0, 0, 0), .normal = Vec3::UnitZ()});
  });
  for (const LoadKind kind : {LoadKind::pressure, LoadKind::radiation, LoadKind::force, LoadKind::body_force})
    source(load_syntax[static_cast<std::size_t>(kind)].word, Vec3::Zero(), [&](const std::string& body) {
      const bool on_surface = kind == LoadKind::pressure || kind == LoadKind::radiation;
      const std::string on = on_surface ? body + ".x_high" : kind == LoadKind::force ? body + ".tip" : body;
      scene.loads.push_back({.name = "of_" + body, .kind = kind, .on = on, .value = uniform(Vec3(1e6, -2e6, 3e6))});
    });
  source("spring to the ground", Vec3::Zero(), [&](const std::string& body) {
    scene.springs.push_back({.name = "of_" + body, .from = body + ".tip", .to = "ground", .stiffness = 1e9});
  });
  for (const double radius : {0.0, 0.6})
    source(radius > 0 ? "round section" : "flat section", Vec3::Zero(), [&](const std::string& body) {
      const Vec3 point(10.0 * (place - 1) + 0.4, 0.5, 0.5);
      scene.sections.push_back({.name = "of_" + body, .body = body, .point = point, .normal = Vec3::UnitX(), .radius = radius});
    });
  for (Target& target : all.targets)
    if (target.kind.find("section") != std::string::npos) {
      const Section& section = scene.sections[target.kind == "flat section" ? 0 : 1];
      target.ahead = [section](const Vec3& X) {
        const Vec3 d = X - section.point;
        return section.radius > 0 ? d.tail<2>().norm() > section.radius : d.x() > 0;
      };
    }
  const auto contact = [&](const std::string& kind, dynamics::InterfaceOptions options, bool skins) {
    source(kind, Vec3::Zero(), [&](const std::string& body) {
      scene.bodies.push_back(cube("under_" + body, place - 1, 1));
      scene.contacts.push_back({.name = "of_" + body, .apexes = body + (skins ? ".skin" : ".z_low"),
                                .base = "under_" + body + (skins ? ".skin" : ".z_high"), .interface = options});
    });
  };
  dynamics::InterfaceOptions options;
  options.friction = {0.3, 1};
  contact("contact of one pass", options, false);
  options.two_passes = true;
  contact("contact of two passes", options, true);
  options.two_passes = false, options.method = contact::Method::penalty;
  contact("contact by a penalty", options, false);
  options = {}, options.kind = contact::InterfaceKind::tied;
  contact("tie", options, false);
  source("automatic contact", Vec3::Zero(), [&](const std::string& body) {
    scene.bodies.push_back(cube("under_" + body, place - 1, 1));
    scene.automatic_contacts.push_back({.name = "of_" + body, .bodies = {body, "under_" + body}});
  });

  Body plastic = cube("plastic", place++), full = cube("full", place++), die = cube("die", place++), water = cube("water", place++);
  Body plates = sheet();
  plastic.law = material::J2Bilinear{8000, 200e9, 0.25, {1e8, 1e9}}, full.solid = element::FullHexahedron::Options{}, die.rigid = true;
  water.law = material::LinearFluid{1000, 2e9}, water.solid = element::Fluid::Options{}, water.start.pressure = 1e6;
  plates.name = "plates", plates.place.move = Vec3(10.0 * place++, 0, 0);
  place -= 5;
  for (const Body& body : {plastic, full, die, water, plates}) {
    scene.bodies.push_back(body);
    thrown(body.name, place++, Vec3(1, 2, -20), body.rigid ? 0 : 5);
  }
  for (const char* body : {"plastic", "full", "water", "plates"}) all.targets.push_back({body, std::string("body that is ") + body, body});
  all.targets.push_back({"die", "rigid body", "die"});
  all.targets.push_back({"plastic.x_high", "node set", "plastic"});
  all.targets.push_back({"plastic.tip", "node", "plastic"});
  return all;
}

// ------------------------------------------------------------------------------------------------ definitions

using Value = std::vector<double>;  ///< of the components in their order

Value parts(const Vec3& vector, const Vec3& normal = Vec3::Zero()) {
  return {vector.norm(), vector.x(), vector.y(), vector.z(), vector.dot(normal)};
}

struct Seen {
  const Simulation& simulation;
  const std::vector<Vectors>& velocities;  ///< at the start and after each step
  const Target& target;
};

const Subset& nodes(const Seen& seen) { return mesh::node_set(seen.simulation.model.mesh, seen.target.name); }

Vec3 momentum_of_body(const Seen& seen, const Vectors& v) {
  Vec3 sum = Vec3::Zero();
  for (const Index n : mesh::node_set(seen.simulation.model.mesh, seen.target.body))
    if (!seen.target.ahead || seen.target.ahead(seen.simulation.model.mesh.X.col(n))) sum += seen.simulation.model.mass(n) * v.col(n);
  return sum;
}

/// The momentum that a body has gained, which is the impulse of the one source that acts on it.
Vec3 gained(const Seen& seen, bool since_the_start = true) {
  const Vectors& before = since_the_start ? seen.velocities[0] : seen.velocities[1];
  return momentum_of_body(seen, seen.velocities.back()) - momentum_of_body(seen, before);
}
/// Whether a source takes initial velocities that go against it at once: these are in its impulse and in no force.
bool holds_at_start(const Target& target) {
  const std::string& kind = target.kind;
  return kind != "rigid plane" && (kind.find("plane") != std::string::npos || kind == "floor");
}

Vec3 mean(const Seen& seen, const Vectors& values) {
  Vec3 sum = Vec3::Zero();
  for (const Index n : nodes(seen)) sum += values.col(n);
  return sum / static_cast<double>(nodes(seen).size());
}

/// Mass of a node: equal shares of its elements, in rigid bodies too. [kg]
Scalars masses(const Seen& seen) {
  Scalars all = Scalars::Zero(seen.simulation.model.mesh.X.cols());
  for (const element::AnyBlock& block : seen.simulation.model.blocks) {
    const element::Connectivity& nodes = element::nodes(block);
    const Scalars mass = element::element_masses(block);
    for (Eigen::Index e = 0; e < nodes.cols(); ++e)
      for (const Index n : nodes.col(e)) all(n) += mass(e) / static_cast<double>(nodes.rows());
  }
  return all;
}

/// What a rigid cube of 1 m has besides its momentum: its inertia is a sixth of its mass.
struct Turning {
  Vec3 centre = Vec3::Zero(), momentum = Vec3::Zero(), spin = Vec3::Zero();
  double mass = 0;
};
Turning turning(const Seen& seen) {
  const dynamics::State& now = seen.simulation.state;
  const Subset& set = nodes(seen);
  const Scalars mass = masses(seen);
  Turning all;
  for (const Index n : set) all.mass += mass(n), all.centre += mass(n) * now.x.col(n), all.momentum += mass(n) * now.v.col(n);
  all.centre /= all.mass;
  for (int axis = 0; axis < 3; ++axis) {  // half the sum of e x (omega x e) over three edges
    Index first = set[0], last = set[0];
    for (const Index n : set) {
      const Vec3 X = seen.simulation.model.mesh.X.col(n), low = seen.simulation.model.mesh.X.col(first);
      if ((X - low).maxCoeff() > 0 && (X - low).minCoeff() >= 0 && (X - low)(axis) > 0.9 && (X - low).norm() < 1.1) last = n;
    }
    const Vec3 edge = now.x.col(last) - now.x.col(first), change = now.v.col(last) - now.v.col(first);
    all.spin += 0.5 * edge.cross(change) / edge.squaredNorm();
  }
  return all;
}

bool is_rigid(const Seen& seen) { return seen.target.kind == "rigid body"; }

Vec3 angular_momentum(const Seen& seen) {
  if (is_rigid(seen)) {
    const Turning all = turning(seen);
    return all.centre.cross(all.momentum) + all.mass / 6 * all.spin;
  }
  Vec3 sum = Vec3::Zero();
  const Scalars mass = masses(seen);
  for (const Index n : nodes(seen))
    sum += mass(n) * Vec3(seen.simulation.state.x.col(n)).cross(Vec3(seen.simulation.state.v.col(n)));
  const auto& model = seen.simulation.model;
  for (const Index n : nodes(seen))
    if (model.rotation_of_node[n] >= 0)
      sum += model.inertia(model.rotation_of_node[n]) * seen.simulation.state.omega.col(model.rotation_of_node[n]);
  return sum;
}

/// Contact forces on the nodes of the target's body.
Vectors contact_forces(const Seen& seen) {
  const dynamics::Model& model = seen.simulation.model;
  Vectors force = Vectors::Zero(3, model.mesh.X.cols()), moment = Vectors::Zero(3, model.inertia.size());
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    contact::with_memory(model.contacts[c], seen.simulation.state.contacts[c],
                         [&](const auto& one, const auto& memory) { contact::add_forces(one, memory, force, moment); });
  return force;
}

/// Largest pressure and area in touch of the lower face of a cube, from the areas of the reference.
std::pair<double, double> pressed(const Seen& seen) {
  const mesh::Mesh& mesh = seen.simulation.model.mesh;
  const Vectors force = contact_forces(seen);
  double largest = 0, area = 0;
  for (const std::string& face : {seen.target.body + ".z_low", "under_" + seen.target.body + ".z_high"}) {
    const Subset& set = mesh::node_set(mesh, face);
    const Scalars areas = mesh::tributary_areas(mesh, mesh::surface(mesh, face), set);
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double push = std::abs(force(2, set[i])), here = areas(static_cast<Eigen::Index>(i));
      largest = std::max(largest, push / here);
      if (push > 0 && face[0] == 'b') area += here;
    }
  }
  return {largest, area};
}

const nereid::Field* field_of(const std::vector<nereid::Field>& fields, const std::string& name) {
  const auto at = std::find_if(fields.begin(), fields.end(), [&](const nereid::Field& one) { return one.name == name; });
  return at == fields.end() ? nullptr : &*at;
}

/// What the definition of a quantity says, component by component; empty where another test has it.
Value defined(const std::string& quantity, const std::string& place, bool largest, const Seen& seen) {
  const dynamics::State& now = seen.simulation.state;
  const Vectors& X = seen.simulation.model.mesh.X;
  if (quantity == "displacement") return parts(mean(seen, now.x - X));
  if (quantity == "velocity") return parts(mean(seen, now.v));
  if (quantity == "position") return {mean(seen, now.x).x(), mean(seen, now.x).y(), mean(seen, now.x).z()};
  if (quantity == "extent" || quantity == "radius") {
    Value all;
    for (int axis = 0; axis < 3; ++axis) {
      double low = 1e300, high = -1e300, far = 0;
      for (const Index n : nodes(seen)) {
        Vec3 across = now.x.col(n);
        low = std::min(low, across(axis)), high = std::max(high, across(axis));
        across(axis) = 0, far = std::max(far, across.norm());
      }
      all.push_back(quantity == "extent" ? high - low : far);
    }
    return all;
  }
  if (quantity == "momentum") {
    Vec3 sum = Vec3::Zero();
    const Scalars mass = masses(seen);
    for (const Index n : nodes(seen)) sum += mass(n) * now.v.col(n);
    return parts(sum);
  }
  if (quantity == "kinetic_energy") {
    if (is_rigid(seen)) {
      const Turning all = turning(seen);
      return {0.5 * all.momentum.squaredNorm() / all.mass + all.mass / 12 * all.spin.squaredNorm()};
    }
    double sum = 0;
    const auto& model = seen.simulation.model;
    const Scalars mass = masses(seen);
    for (const Index n : nodes(seen)) {
      sum += 0.5 * mass(n) * now.v.col(n).squaredNorm();
      if (model.rotation_of_node[n] >= 0)
        sum += 0.5 * model.inertia(model.rotation_of_node[n]) * now.omega.col(model.rotation_of_node[n]).squaredNorm();
    }
    return {sum};
  }
  if (quantity == "angular_momentum") return parts(angular_momentum(seen));
  if (quantity == "impulse") return parts(gained(seen), seen.target.normal);
  if (quantity == "force" && seen.target.kind.find("spring") != std::string::npos) return {};  // the value at the row: tests of loads
  if (quantity == "force") return parts(gained(seen, !holds_at_start(seen.target)) / end, seen.target.normal);
  if (quantity == "current_force") {
    Vec3 sum = Vec3::Zero();
    const Vectors force = contact_forces(seen);
    for (const Index n : mesh::node_set(seen.simulation.model.mesh, seen.target.body)) sum += force.col(n);
    return parts(sum);
  }
  if (quantity == "contact_pressure") return {pressed(seen).first};
  if (quantity == "contact_area") return {pressed(seen).second};
  if (const Measurable* one = find_measurable(quantity); one->of == Of::body)
    for (std::size_t b = 0; b < seen.simulation.model.blocks.size(); ++b) {
      const element::AnyBlock& block = seen.simulation.model.blocks[b];
      if (element::name(block) != seen.target.name) continue;
      const std::vector<nereid::Field> fields = element::fields(block, X, now.x, now.blocks[b], [](const element::Shown&) { return true; });
      const nereid::Field* field = field_of(fields, place.empty() ? quantity : quantity + "_" + place);
      if (field == nullptr) return {};
      const Scalars weights = element::element_masses(block);
      Eigen::VectorXd values = field->values * weights / weights.sum();
      if (largest) values = field->values.rowwise().maxCoeff();
      return {values.data(), values.data() + values.size()};
    }
  return {};  // gap, angular velocity and section moment have tests of their own
}

// ------------------------------------------------------------------------------------------------ the table

const std::vector<std::string>& words() {
  static const std::vector<std::string> all{"", "magnitude", "x", "y", "z", "normal", "xx", "yy", "zz", "xy", "yz", "xz"};
  return all;
}

/// Whether each probe of a scene is accepted: those that are refused are left out until no fault is left.
std::vector<char> accepted(Scene scene, const std::vector<Probe>& probes) {
  std::vector<char> is(probes.size(), 1);
  std::map<std::string, std::size_t> place;
  for (std::size_t p = 0; p < probes.size(); ++p) place["probe '" + probes[p].name + "'"] = p;
  for (bool refused = true; refused;) {
    scene.probes.clear();
    for (std::size_t p = 0; p < probes.size(); ++p)
      if (is[p]) scene.probes.push_back(probes[p]);
    refused = false;
    try {
      build(scene);
    } catch (const SceneError& error) {
      for (const Fault& fault : error.faults)
        if (const auto at = place.find(fault.part); at != place.end()) is[at->second] = 0, refused = true;
      if (!refused) throw;
    }
  }
  return is;
}

/// The value of an accepted word within a definition: in the order of the quantity's components, the first without a word.
std::size_t place_of(const Measurable& quantity, const std::string& word) {
  if (word.empty()) return 0;
  return static_cast<std::size_t>(std::find(quantity.components.begin(), quantity.components.end(), word) - quantity.components.begin());
}

TEST(ProbePairs, HaveTheValueOfTheirDefinitionOrAreRefused) {
  Everything all = everything();
  std::ostringstream table;
  table << "quantity,target,components\n";
  struct Asked {
    Probe probe;
    const Target* target;
    const Measurable* quantity;
  };
  std::vector<Probe> asked;
  std::vector<Asked> candidates;
  for (const Measurable& quantity : measurables())
    for (const Target& target : all.targets)
      for (const char* place : {"", "top", "middle", "bottom", "membrane"}) {
        if (*place != 0 && quantity.of != Of::body) continue;  // a word of bodies alone: bad_cases has it elsewhere
        for (const std::string& word : words())
          for (const bool largest : {false, true}) {
            if (largest && quantity.of != Of::body) continue;
            Probe probe{.name = "p" + std::to_string(asked.size()), .quantity = quantity.name, .of = target.name, .component = word};
            probe.place = place, probe.largest = largest;
            asked.push_back(probe), candidates.push_back({probe, &target, &quantity});
          }
      }
  const std::vector<char> is = accepted(all.scene, asked);
  std::vector<Probe> probes;
  std::vector<Asked> of;
  std::string row, said;
  for (std::size_t p = 0; p <= asked.size(); ++p) {
    const std::string now = p < asked.size() ? candidates[p].quantity->name + "," + candidates[p].target->kind + "," : "";
    if (now != row && !row.empty()) table << row << (said.empty() ? "refused" : said) << "\n";
    if (now != row) row = now, said.clear();
    if (p == asked.size() || !is[p]) continue;
    const Probe& probe = asked[p];
    if (!probe.largest)
      said += (said.empty() ? "" : " ") + (probe.component.empty() ? std::string("-") : probe.component) +
              (probe.place.empty() ? "" : "@" + probe.place);
    probes.push_back(probe), of.push_back(candidates[p]);
  }
  all.scene.probes = probes;
  Simulation simulation = build(all.scene);
  std::vector<Vectors> velocities;
  const dynamics::Observer see = [&](const dynamics::View& view) { velocities.push_back(view.now.v); };
  // the state before the start, as contacts and planes may stop nodes in it
  velocities.push_back(simulation.state.v);
  ASSERT_EQ(run(simulation, {&see, 1}).ending, dynamics::Ending::reached_end);
  int checked = 0;
  std::set<std::string> unchecked;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const Target* target = of[p].target;
    const Measurable* quantity = of[p].quantity;
    SCOPED_TRACE(probes[p].quantity + " of a " + target->kind + ", component '" + probes[p].component + "'");
    const double got = probe(simulation, probes[p].name).last;
    ASSERT_TRUE(std::isfinite(got));
    const Value value = defined(quantity->name, probes[p].place, probes[p].largest, {simulation, velocities, *target});
    if (value.empty()) {
      unchecked.insert(quantity->name);
      continue;
    }
    const std::size_t at = place_of(*quantity, probes[p].component);
    ASSERT_LT(at, value.size());
    double scale = 0;  // round-off of a small component is that of the large ones; areas are those of the reference
    for (const double one : value) scale = std::max(scale, std::abs(one));
    const bool over_area = quantity->name == "contact_pressure" || quantity->name == "contact_area";
    const double round_off = quantity->name == "contact_pressure" ? 1 : 1e-300;  // [Pa] of contacts that are open at the end
    EXPECT_NEAR(got, value[at], (over_area ? 0.01 : 1e-9) * scale + round_off);
    if (quantity->of == Of::source && target->kind != "round section") {
      EXPECT_GT(scale, 0) << "the source acts";
    }
    ++checked;
  }
  EXPECT_GT(checked, 400);
  EXPECT_EQ(unchecked, (std::set<std::string>{"acceleration", "angular_velocity", "force", "gap", "section_moment"}));
  const std::string file = (std::filesystem::path(__FILE__).parent_path() / "probe_pairs.csv").string();
  if (std::getenv("NEREID_WRITE") != nullptr) std::ofstream(file) << table.str();
  std::ifstream stream(file);
  std::stringstream kept;
  kept << stream.rdbuf();
  EXPECT_EQ(kept.str(), table.str()) << "NEREID_WRITE=1 writes " << file;
}

// ------------------------------------------------------------------------------------------------ gauges, pairs, formulas

/// A cube of 4 x 4 x 4 cells with the displacement (a x^2, b x y, 0) at the start.
Scene strained(double a, double b) {
  Scene scene;
  scene.bodies = {{.name = "cube", .mesh = mesh::Box{Vec3::Zero(), Vec3::Ones(), {4, 4, 4}}, .law = material::Elastic{1000, 1e9, 0}}};
  scene.initial = {{.body = "cube", .displacement = true,
                    .value = {[a](double x, double, double, double) { return a * x * x; },
                              [b](double x, double y, double, double) { return b * x * y; }, constant(0)}}};
  scene.time.end = 1e-9;
  return scene;
}

Probe strain(const std::string& name, const Vec3& near, const std::string& component) {
  return {.name = name, .quantity = "strain", .of = "cube", .component = component, .near = near};
}

double last(Simulation& simulation, const std::string& name) { return probe(simulation, name).last; }

TEST(Gauge, MeasuresTheElementThatIsNearest) {
  Scene scene = strained(1e-6, 0);
  scene.probes = {strain("g", Vec3(0.3, 0.1, 0.9), "xx")};
  Simulation simulation = build(scene);
  run(simulation);
  EXPECT_NEAR(last(simulation, "g"), 1e-6 * (0.25 + 0.5), 1e-9) << "between x = 0.25 and 0.5";
}

TEST(Gauge, BetweenElementsHasTheirMean) {
  Scene scene = strained(1e-6, 0);
  scene.probes = {strain("g", Vec3(0.5, 0.5, 0.5), "xx"), strain("h", Vec3(0.5, 0.1, 0.1), "xx")};
  Simulation simulation = build(scene);
  run(simulation);
  EXPECT_NEAR(last(simulation, "g"), 1e-6, 1e-10) << "the mean of eight";
  EXPECT_EQ(simulation.remarks.at(0), "gauge 'g': the mean of 8 elements of 'cube', whose middles lie 0.217 m from its place");
  EXPECT_NEAR(last(simulation, "h"), 1e-6, 1e-10) << "the mean of two";
}

TEST(Gauge, AlongADirectionHasTheTensorThere) {
  Scene scene = strained(1e-6, 2e-6);
  const Vec3 along = Vec3(1, 2, 0).normalized();
  scene.probes = {strain("xx", Vec3(0.3, 0.3, 0.3), "xx"), strain("yy", Vec3(0.3, 0.3, 0.3), "yy"), strain("xy", Vec3(0.3, 0.3, 0.3), "xy"),
                  {.name = "n", .quantity = "strain", .of = "cube", .near = Vec3(0.3, 0.3, 0.3), .along = along}};
  Simulation simulation = build(scene);
  run(simulation);
  const double xx = last(simulation, "xx"), yy = last(simulation, "yy"), xy = last(simulation, "xy");
  EXPECT_GT(std::abs(xy), 1e-7);
  EXPECT_NEAR(last(simulation, "n"), (xx + 4 * yy + 4 * xy) / 5, 1e-18);
}

TEST(Gauge, AlongAnyDirectionHasWhatTheSixComponentsHaveThere) {
  Scene scene = strained(0, 0);
  Mat3 slopes;  // of the displacement, all unlike
  slopes << 1, 2, -3, 4, -5, 6, 7, -8, 9;
  slopes *= 1e-6;
  for (int axis = 0; axis < 3; ++axis)
    scene.initial[0].value[static_cast<std::size_t>(axis)] = [row = Vec3(slopes.row(axis))](double x, double y, double z, double) {
      return row.dot(Vec3(x, y, z));
    };
  const Vec3 place(0.3, 0.3, 0.3);
  const std::vector<std::string> components{"xx", "yy", "zz", "xy", "yz", "xz"};
  const std::vector<Vec3> directions{Vec3(1, 0, 0), Vec3(0, 1, 0),  Vec3(0, 0, 1), Vec3(1, 1, 0),
                                     Vec3(0, 1, 1), Vec3(1, 0, -1), Vec3(1, 2, -3)};
  for (const char* quantity : {"strain", "stress"}) {
    for (const std::string& component : components)
      scene.probes.push_back({.name = quantity + component, .quantity = quantity, .of = "cube", .component = component, .near = place});
    for (std::size_t d = 0; d < directions.size(); ++d)
      scene.probes.push_back({.name = quantity + std::to_string(d), .quantity = quantity, .of = "cube", .near = place,
                              .along = directions[d].normalized()});
  }
  Simulation simulation = build(scene);
  run(simulation);
  for (const std::string quantity : {"strain", "stress"}) {
    const auto at = [&](const char* component) { return last(simulation, quantity + component); };
    Mat3 tensor;
    tensor << at("xx"), at("xy"), at("xz"), at("xy"), at("yy"), at("yz"), at("xz"), at("yz"), at("zz");
    for (std::size_t d = 0; d < directions.size(); ++d) {
      const Vec3 n = directions[d].normalized();
      EXPECT_NEAR(last(simulation, quantity + std::to_string(d)), n.dot(tensor * n), 1e-12 * tensor.norm()) << quantity << " " << d;
    }
    if (quantity == "strain") {
      EXPECT_LT((tensor - 0.5 * (slopes + slopes.transpose())).norm(), 1e-3 * tensor.norm());
    }
  }
}

TEST(Gauge, BesideItsBodyIsRefusedAndSoIsOneOfARigidBody) {
  Scene scene = strained(0, 0);
  scene.probes = {strain("g", Vec3(1.1, 0.5, 0.5), "xx")};
  EXPECT_TRUE(says(refusal(scene), "'near' lies 0.1 m beside 'cube'")) << refusal(scene);
  scene.initial.clear();
  scene.probes = {strain("g", Vec3(0.5, 0.5, 0.5), "xx")};
  scene.bodies[0].rigid = true;
  EXPECT_TRUE(says(refusal(scene), "is a rigid body and has no strain")) << refusal(scene);
}

TEST(Probe, OfASetHasItsElementsAlone) {
  Scene scene = strained(1e-6, 0);
  scene.bodies[0].sets = {
      {.name = "right", .zone = Zone{.kind = Zone::Kind::half_space, .from = Vec3(0.5, 0, 0), .normal = Vec3::UnitX()}}};
  scene.probes = {{.name = "mean", .quantity = "strain", .of = "cube.right", .component = "xx"},
                  {.name = "most", .quantity = "strain", .of = "cube.right", .component = "xx", .largest = true}};
  Simulation simulation = build(scene);
  run(simulation);
  EXPECT_NEAR(last(simulation, "mean"), 1e-6 * 1.5, 1e-9);
  EXPECT_NEAR(last(simulation, "most"), 1e-6 * 1.75, 1e-9);
}

TEST(Acceleration, OfAFreeBodyIsItsLoadOverItsMassInStepsAndRows) {
  for (const bool rigid : {false, true}) {
    Scene scene;
    scene.bodies = {{.name = "cube", .mesh = mesh::Box{Vec3::Zero(), Vec3::Ones(), {2, 2, 2}}, .law = material::Elastic{1000, 1e9, 0},
                     .rigid = rigid}};
    scene.loads = {{.name = "push", .kind = LoadKind::force, .on = "cube", .value = uniform(Vec3(3000, 0, 0))}};
    scene.probes = {{.name = "a", .quantity = "acceleration", .of = "cube", .component = "x"}};
    scene.time.end = 1e-3;
    Simulation simulation = build(scene);
    run(simulation);
    EXPECT_NEAR(last(simulation, "a"), 3, 1e-9);
    EXPECT_NEAR(probe(simulation, "a").largest, 3, 1e-9);
    EXPECT_NEAR(probe(simulation, "a").smallest, 0, 1e-12) << "at the start no time has passed";
  }
}

TEST(PairForce, OfAStackIsTheWeightThatIsAboveWhateverTheOrder) {
  Scene scene;
  const auto block = [](const char* name, double z) {
    return Body{.name = name, .mesh = mesh::Box{Vec3(0, 0, z), Vec3(1, 1, z + 1), {1, 1, 1}}, .law = material::Elastic{1000, 1e7, 0}};
  };
  scene.bodies = {block("low", 0), block("middle", 1), block("high", 2)};
  scene.planes = {{.name = "ground", .kind = load::PlaneKind::fixed, .nodes = {"low.z_low"}}};
  scene.automatic_contacts = {{.name = "all", .self_contact = false}};
  scene.gravity = Vec3(0, 0, -10);
  scene.relaxation = dynamics::Relaxation{};
  scene.probes = {
      {.name = "top", .quantity = "force", .of = "all", .component = "z", .between = {"high", "middle"}},
      {.name = "back", .quantity = "force", .of = "all", .component = "z", .between = {"middle", "high"}},
      {.name = "under", .quantity = "force", .of = "all", .component = "z", .between = {"middle", "low"}},
      {.name = "far", .quantity = "impulse", .of = "all", .component = "z", .between = {"high", "low"}},
      {.name = "ratio",
       .formula = {.inputs = {"under", "top"}, .value = [](const auto& in, double) { return in[0] / in[1]; }, .unit = "1"}}};
  scene.time.end = 10;
  Simulation simulation = build(scene);
  EXPECT_EQ(run(simulation).ending, dynamics::Ending::relaxed);
  EXPECT_NEAR(last(simulation, "top"), 1e4, 50);
  EXPECT_NEAR(last(simulation, "under"), 2e4, 100);
  EXPECT_EQ(last(simulation, "back"), -last(simulation, "top"));
  EXPECT_EQ(last(simulation, "far"), 0);
  EXPECT_EQ(last(simulation, "ratio"), last(simulation, "under") / last(simulation, "top"));
}

TEST(Formula, ThatIsNotFiniteIsToldAndLeftOutOfTheExtremes) {
  Scene scene = strained(1e-6, 0);
  const auto inverse = [](const std::vector<double>&, double t) { return 1 / t; };
  scene.probes = {{.name = "f", .formula = {.inputs = {}, .value = inverse, .unit = "1/s"}}};
  Simulation simulation = build(scene);
  run(simulation);
  EXPECT_EQ(probe(simulation, "f").not_finite, 1) << "at the start";
  EXPECT_TRUE(std::isfinite(probe(simulation, "f").largest));
  const std::vector<std::string> notes = formula_notes(simulation);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(says(notes[0], "probe 'f': the formula was no finite number in 1 of 2 steps")) << notes[0];
}

TEST(Gauge, OfASetMustLieInItsElements) {
  Scene scene = strained(0, 0);
  scene.bodies[0].sets = {
      {.name = "right", .zone = Zone{.kind = Zone::Kind::half_space, .from = Vec3(0.5, 0, 0), .normal = Vec3::UnitX()}}};
  scene.probes = {{.name = "g", .quantity = "strain", .of = "cube.right", .component = "xx", .near = Vec3(0.1, 0.5, 0.5)}};
  EXPECT_TRUE(says(refusal(scene), "'near' lies 0.4 m beside 'cube.right'")) << refusal(scene);
}

TEST(PairForce, SaysWhatIsMissingOrTooMuch) {
  Scene scene;
  scene.bodies = {bar(), wall()};
  scene.automatic_contacts = {{.name = "all"}};
  scene.probes = {{.name = "f", .quantity = "force", .of = "all", .component = "x"}};
  scene.time.end = 1e-5;
  EXPECT_TRUE(says(refusal(scene), "'of' = all is an automatic contact: 'between: [BODY, BODY]'")) << refusal(scene);
  scene.automatic_contacts.clear();
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.probes = {{.name = "f", .quantity = "force", .of = "touch", .component = "x", .between = {"bar", "wall"}}};
  EXPECT_TRUE(says(refusal(scene), "leave it out for touch")) << refusal(scene);
}

TEST(Formula, IsRefusedIfItTakesAProbeBelowIt) {
  Scene scene = strained(0, 0);
  const Formula twice{.inputs = {"g"}, .value = [](const auto& in, double) { return 2 * in[0]; }, .unit = "1"};
  scene.probes = {{.name = "f", .formula = twice}, strain("g", Vec3(0.5, 0.5, 0.5), "xx")};
  EXPECT_TRUE(says(refusal(scene), "probe 'f': 'value' = g is unknown: there are no probes above it")) << refusal(scene);
}

}  // namespace
}  // namespace nereid::model::probes_test
