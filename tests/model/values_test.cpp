#include "model/values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/model/scenes.hpp"

namespace nereid::model::values_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

const material::J2JohnsonCook hot{8000, 200e9, 0.25, {4e8, 5e8, 0.3, 0.01, 1, 1, 300, 1800, 470, 0.9, 300}};

/// A scene with one part of each kind, which is built.
Scene whole() {
  Scene scene = with({bar(), wall(), sheet()});
  scene.bodies[0].points = {{.name = "tip", .near = Vec3::Zero()}};
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.planes = {{.name = "side", .nodes = {"wall.x_high"}, .normal = Vec3::UnitX()}};
  scene.rigid_planes = {{.name = "ground", .surface = "bar.x_low", .normal = Vec3::UnitX()}};
  scene.loads = {{.name = "push", .on = "wall.y_low", .value = {constant(1), {}, {}}}};
  scene.springs = {{.name = "coil", .from = "bar.tip", .to = "ground", .stiffness = 1}};
  scene.point_masses = {{.name = "weight", .nodes = "bar.tip", .mass = 1}};
  scene.initial = {{.body = "bar", .value = uniform(Vec3(1, 0, 0))}};
  scene.probes = {{.name = "speed", .quantity = "velocity", .of = "bar"}};
  scene.stops = {{.probe = "speed", .value = 1e9}};
  return scene;
}

TEST(CheckValues, TakesAWholeScene) { EXPECT_EQ(refusal(whole()), ""); }

/// A number in a scene, a key of the fault, and values that it may not have.
struct Wrong {
  const char* said;
  std::function<void(Scene&, double)> set;
  std::vector<double> values;
};

/// A scene in which nothing is given a velocity, and which relaxes.
void relax(Scene& scene, const dynamics::Relaxation& relaxation) {
  scene.initial.clear();
  scene.relaxation = relaxation;
}

const std::vector<Wrong> numbers{
    {"time: 'end'", [](Scene& s, double v) { s.time.end = v; }, {0, -1, nan, infinity}},
    {"time: 'safety'", [](Scene& s, double v) { s.time.safety = v; }, {0, -1, 11, nan}},
    {"time: 'created_limit'", [](Scene& s, double v) { s.time.created_limit = v; }, {0, nan, infinity}},
    {"time: 'overlap_limit'", [](Scene& s, double v) { s.time.overlap_limit = v; }, {0, -1, nan, infinity}},
    {"'history_every'", [](Scene& s, double v) { s.recording.history = v; }, {-1, nan, infinity}},
    {"'frames_every'", [](Scene& s, double v) { s.recording.frames = v; }, {-1, nan, infinity}},
    {"'gravity'", [](Scene& s, double v) { s.gravity.y() = v; }, {nan, infinity}},
    {"body 'bar': 'density'", [](Scene& s, double v) { s.bodies[0].law = material::Elastic{v, 1, 0}; }, {0, -1, nan, infinity}},
    {"body 'bar': 'young'", [](Scene& s, double v) { s.bodies[0].law = material::Elastic{1, v, 0}; }, {0, -1, nan, infinity}},
    {"body 'bar': 'poisson'", [](Scene& s, double v) { s.bodies[0].law = material::Elastic{1, 1, v}; }, {-1, 0.5, 0.7, nan}},
    {"body 'bar': 'yield'", [](Scene& s, double v) { s.bodies[0].law = material::J2Bilinear{1, 1, 0, {v, 0.1}}; }, {0, nan, infinity}},
    {"body 'bar': 'tangent'", [](Scene& s, double v) { s.bodies[0].law = material::J2Bilinear{1, 1, 0, {1, v}}; }, {-1, 1, 2, nan}},
    {"body 'bar': 'isotropic_share'", [](Scene& s, double v) { s.bodies[0].law = material::J2Mixed{1, 1, 0, 1, 0.1, v}; }, {-1, 2, nan}},
    {"body 'bar': 'hourglass'", [](Scene& s, double v) { s.bodies[0].solid = element::Hexahedron::Options{v, {}}; }, {0, 2, nan}},
    {"body 'bar': 'linear'", [](Scene& s, double v) { s.bodies[0].solid = element::FullHexahedron::Options{{v, 1}}; }, {-1, 2, nan}},
    {"body 'sheet': 'thickness'", [](Scene& s, double v) { s.bodies[2].plate.thickness = v; }, {0, -1, nan, infinity}},
    {"body 'sheet': 'layers'", [](Scene& s, double v) { s.bodies[2].plate.layers = static_cast<int>(v); }, {0, -1, 10}},
    {"body 'sheet': 'quadratic'", [](Scene& s, double v) { s.bodies[2].plate.viscosity.quadratic = v; }, {-1, 11, nan}},
    {"body 'bar': 'angle'", [](Scene& s, double v) { s.bodies[0].place.angle = v; }, {nan, infinity}},
    {"body 'bar': 'move'", [](Scene& s, double v) { s.bodies[0].place.move.z() = v; }, {nan, infinity}},
    {"point 'tip': 'near'", [](Scene& s, double v) { s.bodies[0].points[0].near.x() = v; }, {nan, infinity}},
    {"contact 'touch': 'penalty_scale'", [](Scene& s, double v) { s.contacts[0].interface.penalty_scale = v; }, {0, -1, nan}},
    {"contact 'touch': 'penalty'", [](Scene& s, double v) {
       s.contacts[0].interface.penalty = v; }, {0, -1, nan}},
    {"contact 'touch': 'friction'", [](Scene& s, double v) { s.contacts[0].interface.friction.coefficient = v; }, {-1, 11, nan}},
    {"'kinetic_friction'", [](Scene& s, double v) { s.contacts[0].interface.friction.kinetic = v; }, {-1, 11, nan}},
    {"'friction_decay'", [](Scene& s, double v) { s.contacts[0].interface.friction.decay = v; }, {-1, nan, infinity}},
    {"'tangential_penalty'", [](Scene& s, double v) { s.contacts[0].interface.friction.tangential_penalty = v; }, {0, 2, nan}},
    {"contact 'touch': 'damping_ratio'", [](Scene& s, double v) { s.contacts[0].interface.damping_ratio = v; }, {-1, 2, nan}},
    {"contact 'touch': 'energy_gain_limit'", [](Scene& s, double v) { s.contacts[0].interface.energy_gain_limit = v; }, {0, 1, nan}},
    {"contact 'touch': 'step_factor'", [](Scene& s, double v) { s.contacts[0].interface.step_factor = v; }, {-0.1, 0.6, nan}},
    {"contact 'touch': 'height'", [](Scene& s, double v) { s.contacts[0].interface.height.given = v; }, {-1, nan}},
    {"contact 'touch': 'clearance'", [](Scene& s, double v) { s.contacts[0].interface.height.clearance = v; }, {-1, nan}},
    {"contact 'touch': 'kind'", [](Scene& s, double v) {
       s.contacts[0].interface.kind = static_cast<contact::InterfaceKind>(static_cast<int>(v)); }, {-1, 2}},
    {"contact 'touch': 'method'", [](Scene& s, double v) {
       s.contacts[0].interface.method = static_cast<contact::Method>(static_cast<int>(v)); }, {-1, 2}},
    {"contact 'touch': 'restitution'", [](Scene& s, double v) { s.contacts[0].interface.restitution = v; }, {-1, 2, nan}},
    {"plane 'side': 'kind'", [](Scene& s, double v) { s.planes[0].kind = static_cast<load::PlaneKind>(static_cast<int>(v)); }, {-1, 99}},
    {"plane 'side': 'point'", [](Scene& s, double v) { s.planes[0].point.x() = v; }, {nan, infinity}},
    {"plane 'side': 'normal'", [](Scene& s, double v) { s.planes[0].normal.x() = v; }, {0, 2, nan}},
    {"plane 'ground': 'point'", [](Scene& s, double v) { s.rigid_planes[0].point.x() = v; }, {nan, infinity}},
    {"plane 'ground': 'normal'", [](Scene& s, double v) { s.rigid_planes[0].normal.x() = v; }, {0, 2, nan}},
    {"plane 'ground': 'penalty'", [](Scene& s, double v) { s.rigid_planes[0].penalty = v; }, {0, -1, nan, infinity}},
    {"plane 'ground': 'penalty_scale'", [](Scene& s, double v) { s.rigid_planes[0].penalty_scale = v; }, {0, -1, nan}},
    {"plane 'ground': 'method'", [](Scene& s, double v) {
       s.rigid_planes[0].method = static_cast<contact::Method>(static_cast<int>(v)); }, {-1, 2}},
    {"plane 'ground': 'restitution'", [](Scene& s, double v) { s.rigid_planes[0].restitution = v; }, {-1, 2, nan}},
    {"plane 'ground': 'friction'", [](Scene& s, double v) { s.rigid_planes[0].friction.coefficient = v; }, {-1, nan}},
    {"plane 'ground': 'energy_gain_limit'", [](Scene& s, double v) { s.rigid_planes[0].energy_gain_limit = v; }, {0, nan}},
    {"plane 'ground': 'step_factor'", [](Scene& s, double v) { s.rigid_planes[0].step_factor = v; }, {-0.1, 0.6, nan}},
    {"load 'push': 'kind'", [](Scene& s, double v) { s.loads[0].kind = static_cast<LoadKind>(static_cast<int>(v)); }, {-1, 9}},
    {"spring 'coil': 'stiffness'", [](Scene& s, double v) { s.springs[0].stiffness = v; }, {-1, nan, infinity}},
    {"spring 'coil': 'damping'", [](Scene& s, double v) { s.springs[0].damping = v; }, {-1, nan}},
    {"spring 'coil': 'rest_length'", [](Scene& s, double v) { s.springs[0].length = v; }, {-1, nan}},
    {"point mass 'weight': 'mass'", [](Scene& s, double v) { s.point_masses[0].mass = v; }, {0, -1, nan, infinity}},
    {"condition to stop: 'above'", [](Scene& s, double v) { s.stops[0].value = v; }, {nan, infinity}},
    {"condition to stop: 'fallen'", [](Scene& s, double v) {
       s.stops[0] = {.probe = "speed", .kind = StopKind::peak, .part = v, .span = 1}; }, {-1, 2, nan}},
    {"condition to stop: 'within'", [](Scene& s, double v) {
       s.stops[0] = {.probe = "speed", .value = v, .kind = StopKind::steady, .span = 1}; }, {0, -1, nan}},
    {"condition to stop: 'part'", [](Scene& s, double v) { s.stops[0] = {.kind = StopKind::rest, .part = v, .span = 1}; }, {0, 1, nan}},
    {"condition to stop: 'for'", [](Scene& s, double v) { s.stops[0] = {.kind = StopKind::rest, .part = 0.1, .span = v}; }, {0, -1, nan}},
    {"condition to stop: 'window'", [](Scene& s, double v) {
       s.stops[0] = {.probe = "speed", .value = 1, .kind = StopKind::steady, .span = v}; }, {0, 1e-9, nan}},
    {"condition to stop: 'after'", [](Scene& s, double v) { s.stops[0].after = v; }, {-1, nan}},
    {"relaxation: 'residual'", [](Scene& s, double v) { relax(s, {.residual = v}); }, {0, 1, nan}},
    {"relaxation: 'samples'", [](Scene& s, double v) { relax(s, {.samples = static_cast<int>(v)}); }, {0, -1}},
};

TEST(CheckValues, RefusesEachNumberThatIsOutOfItsRange) {
  for (const Wrong& wrong : numbers)
    for (const double value : wrong.values) {
      Scene scene = whole();
      wrong.set(scene, value);
      const std::string said = refusal(scene);
      EXPECT_TRUE(says(said, wrong.said)) << wrong.said << " = " << value << ": " << said;
      EXPECT_FALSE(says(said, "\n")) << "one fault is enough: " << said;
    }
}

TEST(CheckValues, RefusesEachConstantOfJohnsonAndCook) {
  using Flow = material::JohnsonCook;
  const std::vector<std::pair<const char*, double Flow::*>> constants{
      {"yield", &Flow::yield}, {"hardening_coefficient", &Flow::hardening}, {"hardening_exponent", &Flow::hardening_exponent},
      {"rate_coefficient", &Flow::rate_coefficient}, {"reference_rate", &Flow::reference_rate},
      {"thermal_exponent", &Flow::thermal_exponent},
      {"reference_temperature", &Flow::reference_temperature}, {"melting_temperature", &Flow::melting_temperature},
      {"specific_heat", &Flow::specific_heat}, {"taylor_quinney", &Flow::heat_share}, {"temperature", &Flow::temperature}};
  Scene scene = whole();
  scene.bodies[0].law = hot;
  EXPECT_EQ(refusal(scene), "");
  for (const auto& [key, constant] : constants)
    for (const double value : {-1.0, nan, infinity}) {
      material::J2JohnsonCook law = hot;
      law.flow.*constant = value;
      scene.bodies[0].law = law;
      EXPECT_EQ(refusal(scene).rfind("body 'bar': '" + std::string(key) + "' = ", 0), 0U) << refusal(scene);
    }
  material::J2JohnsonCook law = hot;
  law.flow.melting_temperature = 200;
  scene.bodies[0].law = law;
  EXPECT_TRUE(says(refusal(scene), "'melting_temperature' = 200 is out of range: expected melting_temperature > 300 K"));
}

TEST(CheckValues, RefusesALawThatPlatesMayNotHave) {
  Scene scene = whole();
  scene.bodies[2].law = material::NeoHookean{8000, 200e9, 0.25};
  EXPECT_EQ(refusal(scene), std::string("body 'sheet': ") + plates_may_have_other_laws);
}

TEST(CheckValues, RefusesFunctionsThatAreEmpty) {
  const auto said_after = [](const std::function<void(Scene&)>& change) {
    Scene scene = whole();
    change(scene);
    return refusal(scene);
  };
  const Field half{constant(1), {}, {}};
  EXPECT_TRUE(says(said_after([&](Scene& s) { s.bodies[0].map = half; }), "'map' needs a function for each of x, y and z"));
  EXPECT_TRUE(says(said_after([](Scene& s) { s.initial[0].value = {}; }), "initial motion of 'bar': 'velocity' needs"));
  EXPECT_TRUE(says(said_after([&](Scene& s) { s.initial[0] = {.body = "bar", .displacement = true, .value = half}; }),
                   "'displacement' needs"));
  EXPECT_TRUE(says(said_after([](Scene& s) { s.loads[0].value = {}; }), "load 'push': 'value' needs a function"));
  EXPECT_TRUE(says(said_after([](Scene& s) { s.loads[0].kind = LoadKind::force; }), "load 'push': 'value' needs a function for each"));
  EXPECT_TRUE(says(said_after([](Scene& s) { s.planes[0].kind = load::PlaneKind::driven; }), "plane 'side': 'velocity' needs"));
  EXPECT_TRUE(says(said_after([&](Scene& s) { s.planes[0].angular_velocity = half; }), "plane 'side': 'angular_velocity' needs"));
  EXPECT_TRUE(says(said_after([](Scene& s) { s.planes[0].nodes.clear(); }), "plane 'side': 'nodes' names no node set"));
}

TEST(CheckValues, NamesThePlaceOfThePart) {
  Scene scene = whole();
  scene.bodies[1].at = "bodies[1]", scene.bodies[1].law = material::Elastic{1, nan, 0};
  scene.contacts[0].at = "contacts[0]", scene.contacts[0].interface.damping_ratio = 2;
  try {
    build(scene);
    FAIL();
  } catch (const SceneError& error) {
    ASSERT_EQ(error.faults.size(), 2U);
    EXPECT_EQ(error.faults[0].at + "." + error.faults[0].key, "bodies[1].material.young");
    EXPECT_EQ(error.faults[1].at + "." + error.faults[1].key, "contacts[0].damping_ratio");
  }
}

TEST(TooMany, RowsAndFramesAreRefusedByTheirCount) {
  EXPECT_EQ(too_many("history_every", 1e-3, 1), "");
  EXPECT_EQ(too_many("frames_every", 1e-6, 1), "");
  EXPECT_EQ(too_many("frames_every", 0, 1), "") << "the default";
  EXPECT_EQ(too_many("frames_every", 1e-30, 1),
            "'frames_every' = 1e-30 s gives 1e+30 frames by the end at 1 s: expected at most a million");
  EXPECT_EQ(too_many("history_every", 1e-8, 1),
            "'history_every' = 1e-08 s gives 1e+08 rows by the end at 1 s: expected at most ten million");
}

TEST(FramesBetweenRows, AreRefused) {
  EXPECT_EQ(frames_between_rows(0, 1), "") << "the default";
  EXPECT_EQ(frames_between_rows(1e-3, 0), "");
  EXPECT_EQ(frames_between_rows(1e-3, 1e-3), "");
  EXPECT_EQ(frames_between_rows(1e-3, 2e-3),
            "'frames_every' = 0.001 s is shorter than 'history_every' = 0.002 s: a frame is written with a row of the history");
  EXPECT_EQ(usual_rows(0, 4), 0.01);
  EXPECT_EQ(usual_rows(1e-3, 4), 1e-3);
  EXPECT_EQ(usual_rows(1, 4), 0.01);
}

}  // namespace
}  // namespace nereid::model::values_test
