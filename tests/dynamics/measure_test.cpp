#include "dynamics/measure.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "dynamics/balance.hpp"
#include "dynamics/connect.hpp"
#include "dynamics/step.hpp"
#include "mesh/box.hpp"
#include "mesh/skin.hpp"

namespace nereid::dynamics::measure_test {
namespace {

const material::Elastic rubber{1000, 1e6, 0.25};
const element::Hexahedron::Options inviscid{.viscosity = {0, 0}};

/// Boxes of unit section along x, two cells each, with what a view needs.
struct Scene {
  Model model;
  State state;
  Forces forces;

  explicit Scene(const std::vector<std::pair<std::string, double>>& from) {
    for (const auto& [name, x] : from) {
      const mesh::Mesh here = mesh::box(name, {Vec3(x, 0, 0), Vec3(x + 2, 1, 1), Eigen::Vector3i(2, 1, 1)});
      model.mesh = model.mesh.X.cols() == 0 ? here : mesh::join(model.mesh, here);
    }
    for (const auto& [name, x] : from) model.blocks.push_back(element::hexahedra(model.mesh, name, rubber, inviscid));
    finalize(model);
  }
  void ready() { state = initial_state(model, {}), forces = make_forces(model); }
  View view() const { return {model, state, forces, true}; }
};

Scene one_box() {
  Scene scene({{"box", 0}});
  scene.ready();
  return scene;
}

const Subset& all(const Scene& scene) { return mesh::node_set(scene.model.mesh, "box"); }

TEST(Mean, OfARigidTranslationIsTheTranslation) {
  Scene scene = one_box();
  const Vec3 moved(1, 2, 3), velocity(4, 5, 6);
  scene.state.x.colwise() += moved;
  scene.state.v.colwise() = velocity;
  EXPECT_LT((mean_displacement(scene.view(), all(scene)) - moved).norm(), 1e-14);  // round-off of sums of ten numbers
  EXPECT_LT((mean_velocity(scene.view(), all(scene)) - velocity).norm(), 1e-14);
  EXPECT_LT((mean_position(scene.view(), all(scene)) - (Vec3(1, 0.5, 0.5) + moved)).norm(), 1e-14);
}

TEST(Momentum, OfABodyIsItsMassTimesItsVelocity) {
  Scene scene = one_box();
  const Vec3 velocity(4, 5, 6);
  scene.state.v.colwise() = velocity;
  EXPECT_LT((momentum(scene.view(), all(scene)) - 2000 * velocity).norm(), 1e-10);  // 2 m3 of 1000 kg/m3; round-off
  EXPECT_NEAR(kinetic_energy(scene.view(), all(scene)), 0.5 * 2000 * velocity.squaredNorm(), 1e-9);
}

TEST(Extent, IsFromTheLowestToTheHighestNode) {
  Scene scene = one_box();
  scene.state.x.row(0) *= 1.5;
  EXPECT_EQ(extent(scene.view(), all(scene), 0), 3);
  EXPECT_EQ(extent(scene.view(), all(scene), 1), 1);
  EXPECT_EQ(extent(scene.view(), mesh::node_set(scene.model.mesh, "box.x_low"), 0), 0);
}

TEST(Radius, IsTheDistanceFromACoordinateAxis) {
  const Scene scene = one_box();
  EXPECT_DOUBLE_EQ(radius(scene.view(), all(scene), 0), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(radius(scene.view(), all(scene), 1), std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(radius(scene.view(), all(scene), 2), std::sqrt(5.0));
}

TEST(OfBody, IsTheMeanOverTheVolumeOrTheLargestElement) {
  Scene scene = one_box();
  constexpr double rate = 1e-3, dt = 1e-3;
  for (const Index node : mesh::node_set(scene.model.mesh, "box.x_high")) scene.state.v(0, node) = rate;  // only the second cell stretches
  const Vectors start = scene.state.x;
  scene.forces.dx = dt * scene.state.v;
  scene.state.x += scene.forces.dx;
  element::advance(scene.model.blocks[0], scene.state.x, scene.forces.dx, scene.forces.rotation, dt, scene.state.blocks[0],
                   scene.state.tiles[0], scene.forces.reports[0]);
  const double largest = of_body(scene.view(), {0}, {"stress"}, 0, Take::largest);
  const double mean = of_body(scene.view(), {0}, {"stress"}, 0, Take::mean);
  EXPECT_NEAR(largest / (1.2e6 * rate * dt), 1, 1e-5);  // lambda + 2 mu; strains of the middle of a step of 1e-6
  EXPECT_NEAR(mean, largest / 2, 1e-12 * largest);      // the other cell has half of the volume and no stress
  EXPECT_NEAR(of_body(scene.view(), {0}, {"pressure"}, 0, Take::largest), 0, 1e-12 * largest);
  EXPECT_THROW(of_body(scene.view(), {0}, {"plastic_strain"}, 0, Take::mean), InternalError);
}

TEST(ContactForce, IsPenaltyTimesAreaTimesDepthOnTheApexes) {
  Scene scene({{"left", 0}, {"right", 2}});
  InterfaceOptions options{.method = contact::Method::penalty, .edges = false};
  options.penalty = 1e6;
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  Connected connected = std::move(connect(scene.model, "touch", "left.x_high", "right.x_low", options)[0]);
  scene.state = initial_state(scene.model, {connected.memory});
  scene.forces = make_forces(scene.model);
  constexpr double depth = 1e-3;
  for (const Index node : mesh::node_set(scene.model.mesh, "left")) scene.state.x(0, node) += depth;
  start(scene.model, scene.state, scene.forces);
  const Vec3 force = contact::sides(scene.state.contacts[0]).force;
  EXPECT_LT((force - Vec3(-1e6 * depth, 0, 0)).norm(), 1e-9);  // round-off of coordinates of 2 m
  const ContactState all_of_it = contact_state(scene.view(), 0);
  EXPECT_NEAR(least_gap(scene.view(), 0), -depth, 1e-15);
  EXPECT_NEAR(all_of_it.largest_pressure, 1e6 * depth, 1e-9);
  EXPECT_NEAR(all_of_it.area, 1, 1e-15);
  EXPECT_NEAR(area_across(scene.view(), 0, 0, Vec3(-2, 0, 0)), std::get<contact::Interface>(scene.model.contacts[0]).area(0), 1e-15);
  EXPECT_NEAR(area_across(scene.view(), 0, 0, Vec3(0, 0, 1)), 0, 1e-15);  // along the face
  std::get<contact::Interface>(scene.model.contacts[0]).faces = {};
  EXPECT_EQ(area_across(scene.view(), 0, 0, Vec3(0, 0, 1)), std::get<contact::Interface>(scene.model.contacts[0]).area(0));
}

/// Two boxes, the left one pressed into the other, with one or two passes between surfaces of theirs.
Scene pressed_boxes(const std::string& apexes, bool two_passes, double depth) {
  Scene scene({{"left", 0}, {"right", 2}});
  for (const auto* name : {"left", "right"}) {
    const auto& blocks = scene.model.mesh.hexahedra;
    const auto region = std::find_if(blocks.begin(), blocks.end(), [&](const auto& one) { return one.name == name; });
    scene.model.mesh.surfaces.push_back({std::string(name) + ".skin", mesh::skin(scene.model.mesh.X, {*region}).facets});
  }
  InterfaceOptions options{.method = contact::Method::penalty, .edges = false, .two_passes = two_passes};
  options.penalty = 1e6;
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  std::vector<contact::AnyMemory> memories;
  for (Connected& connected : connect(scene.model, "touch", apexes, "right.x_low", options)) memories.push_back(connected.memory);
  scene.state = initial_state(scene.model, memories);
  scene.forces = make_forces(scene.model);
  for (const Index node : mesh::node_set(scene.model.mesh, "left")) scene.state.x(0, node) += depth;
  start(scene.model, scene.state, scene.forces);
  return scene;
}

void expect_pressure(const Scene& scene, std::size_t pass, double pressure) {
  const std::vector<contact::NodeForce> forces = forces_of_contact(scene.model, scene.state, pass);
  const contact::Interface& interface = std::get<contact::Interface>(scene.model.contacts[pass]);
  Vec3 sum = Vec3::Zero();
  for (const contact::NodeForce& force : forces) sum += force.push;
  EXPECT_LT(sum.norm(), 1e-9 * pressure);
  EXPECT_EQ(forces.size(), 8U);
  for (Index a = 0; a < static_cast<Index>(interface.apexes.size()); ++a) {
    const bool touches = std::get<contact::Memory>(scene.state.contacts[pass]).status[a] == contact::Status::closed;
    EXPECT_NEAR(traction_at(scene.view(), pass, a, forces).pressure, touches ? pressure : 0, 1e-9 * pressure);
  }
  EXPECT_NEAR(contact_state(scene.view(), pass).largest_pressure, pressure, 1e-9 * pressure);
  EXPECT_NEAR(contact_state(scene.view(), pass).area, 1, 1e-12);
}

TEST(ContactPressure, IsTheForceAtANodeOverItsAreaWhicheverDirectionActs) {
  constexpr double depth = 1e-3;
  for (const double first : {0.5, 0.9, 0.0}) {  // of the impulse by the first pass: like grids leave that open
    Scene scene = pressed_boxes("left.x_high", true, depth);
    ASSERT_EQ(scene.model.contacts.size(), 2U);
    for (std::size_t pass : {0U, 1U})
      for (contact::Near& near : std::get<contact::Memory>(scene.state.contacts[pass]).near)
        near.element.scale = 2 * (pass == 0 ? first : 1 - first);
    for (std::size_t pass : {0U, 1U}) expect_pressure(scene, pass, 1e6 * depth);
  }
}

TEST(ContactPressure, OfACornerIsOverTheSideThatIsPressed) {
  expect_pressure(pressed_boxes("left.skin", false, 1e-3), 0, 1e6 * 1e-3);
}

TEST(ContactPressure, IsNegativeWhereAFaceIsPulled) {
  Scene scene = pressed_boxes("left.x_high", false, 1e-3);
  for (contact::Near& near : std::get<contact::Memory>(scene.state.contacts[0]).near) near.element.scale = -1;
  const auto forces = forces_of_contact(scene.model, scene.state, 0);
  for (Index a = 0; a < 4; ++a) EXPECT_NEAR(traction_at(scene.view(), 0, a, forces).pressure, -1e3, 1e-6);
}

TEST(ContactPressure, OfAForceAlongItsFacesIsOverAllOfThem) {
  Scene scene = pressed_boxes("left.x_high", false, 1e-3);
  contact::NodeForce along{std::get<contact::Interface>(scene.model.contacts[0]).apexes[0], Vec3(0, 0, 3), Vec3(0, 2, 0)};
  const Traction traction = traction_at(scene.view(), 0, 0, {along});
  EXPECT_NEAR(traction.pressure, 3 / 0.25, 1e-12);
  EXPECT_NEAR(traction.shear, 2 / 0.25, 1e-12);
}

TEST(ContactForce, IsZeroWhereSurfacesAreApart) {
  Scene scene({{"left", 0}, {"right", 2.5}});
  InterfaceOptions options{.method = contact::Method::penalty, .edges = false};
  options.penalty = 1e6;
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  Connected connected = std::move(connect(scene.model, "touch", "left.x_high", "right.x_low", options)[0]);
  scene.state = initial_state(scene.model, {connected.memory});
  scene.forces = make_forces(scene.model);
  start(scene.model, scene.state, scene.forces);
  EXPECT_EQ(std::get<contact::Memory>(scene.state.contacts[0]).force, Vec3::Zero());
  EXPECT_DOUBLE_EQ(least_gap(scene.view(), 0), 0.5);
  EXPECT_EQ(contact_state(scene.view(), 0).area, 0);
  EXPECT_EQ(contact_state(scene.view(), 0).largest_pressure, 0);
}

TEST(MeanForce, OfGravityIsTheWeight) {
  Scene scene({{"box", 0}});
  scene.model.gravity = Vec3(0, 0, -10);
  scene.ready();
  const Probe weight{"weight", "N", [source = source_of(scene.model, "gravity")](const View& view, Kept& kept) {
                       return mean_force(view, source, kept).z();
                     }, true};
  ProbeMemory memory;
  const auto sampled = [&] {
    sample_row(weight, scene.view(), {}, memory);
    return memory.last;
  };
  start(scene.model, scene.state, scene.forces);
  EXPECT_EQ(sampled(), 0);  // nothing has passed yet
  for (int sample = 0; sample < 3; ++sample) {
    for (int i = 0; i < 5; ++i) step(scene.model, 1e-3, scene.state, scene.forces);
    update_ledger(scene.model, scene.state);
    EXPECT_NEAR(sampled(), -20000, 1e-8);  // 2000 kg; round-off of differences of times
    EXPECT_NEAR(sampled(), -20000, 1e-8);  // asked again at the same time
  }
  EXPECT_THROW(source_of(scene.model, "levity"), InternalError);
}

}  // namespace
}  // namespace nereid::dynamics::measure_test
