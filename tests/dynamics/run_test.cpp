#include "dynamics/run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "contact/penalty/impact_step.hpp"
#include "mesh/box.hpp"
#include "tests/dynamics/scene.hpp"

namespace nereid::dynamics::run_test {
namespace {

const material::Elastic rubber{1000, 1e6, 0.3};
const element::Hexahedron::Options inviscid{.hourglass = 0.1, .viscosity = {0, 0}};

Scene box(const Eigen::Vector3i& cells = {2, 2, 2}) {
  Scene s;
  s.model.mesh = mesh::box("box", {Vec3::Zero(), 0.1 * cells.cast<double>(), cells});
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "box", rubber, inviscid));
  finalize(s.model);
  s.ready();
  return s;
}

// --- two bars ------------------------------------------------------------------------------------

struct Bars {
  static constexpr double length = 0.1, width = 0.01, density = 7850, young = 2.1e11, speed = 10,
                          gap = 1e-5;
  static constexpr int cells = 40;
  double wave = std::sqrt(young / density), area = width * width;
  double force = density * wave * speed / 2 * area, duration = 2 * length / wave;
};

struct Collision {
  double plateau, duration, velocity_a, velocity_b, created, residual, momentum;
};

/// Bar A runs into bar B at rest; stress, duration and velocities, from the motion of B alone.
Collision collide(bool swapped, const element::Hexahedron::Options& element, double penalty_scale) {
  const Bars bars;
  Scene s;
  const double from = bars.length + bars.gap;
  s.model.mesh = mesh::join(
      mesh::box("A", {{0, 0, 0}, {bars.length, bars.width, bars.width}, {bars.cells, 1, 1}}),
      mesh::box("B",
                {{from, 0, 0}, {from + bars.length, bars.width, bars.width}, {bars.cells, 1, 1}}));
  const material::Elastic steel{bars.density, bars.young, 0};
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "A", steel, element));
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "B", steel, element));
  finalize(s.model);
  InterfaceOptions options{.method = contact::Method::penalty};
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  options.penalty_scale = penalty_scale;
  if (swapped)
    s.joined("joint", "B.x_low", "A.x_high", options);
  else
    s.joined("joint", "A.x_high", "B.x_low", options);
  s.ready();
  s.move("A", {bars.speed, 0, 0});

  const Subset A = mesh::node_set(s.model.mesh, "A"), B = mesh::node_set(s.model.mesh, "B");
  const auto momentum = [&](const Subset& nodes) {
    double sum = 0;
    for (const Index n : nodes) sum += s.model.mass(n) * s.state.v(0, n);
    return sum;
  };
  const double touch = bars.gap / bars.speed;
  double first = -1, last = -1;
  std::array<std::pair<double, double>, 2> at{
      {{-1, 0}, {-1, 0}}};  // time and momentum of B at 20 % and 80 %
  const Observer look = [&](const View& view) {
    bool closed = false;
    for (const auto status : std::get<contact::Memory>(view.now.contacts[0]).status)
      closed = closed || status == contact::Status::closed;
    if (closed) last = view.now.t;
    if (closed && first < 0) first = view.now.t;
    for (int i = 0; i < 2; ++i)
      if (at[i].first < 0 && view.now.t >= touch + (i == 0 ? 0.2 : 0.8) * bars.duration)
        at[i] = {view.now.t, momentum(B)};
  };
  const Outcome outcome = s.run_to(touch + 1.5 * bars.duration, 1e-6, {&look, 1});
  EXPECT_EQ(outcome.ending, Ending::reached_end) << outcome.reason;
  const double mass = bars.density * bars.area * bars.length;
  return {.plateau = (at[1].second - at[0].second) / (at[1].first - at[0].first) / bars.force - 1,
          .duration = (last - first) / bars.duration - 1,
          .velocity_a = momentum(A) / mass / bars.speed,
          .velocity_b = momentum(B) / mass / bars.speed - 1,
          .created = created(s.state.ledger.accounts[2]) / s.state.ledger.initial_kinetic,
          .residual = energy_residual(s.state.ledger) / s.state.ledger.initial_kinetic,
          .momentum =
              momentum_residual(s.state.ledger).norm() / s.state.ledger.initial_momentum.norm()};
}

void expect_exchange(const Collision& c, double velocity, const char* name) {
  std::printf(
      "%s: plateau %+.2f %%, duration %+.2f %%, velocities %.4f %+.4f, created %.2e, residual "
      "%.1e, momentum %.1e\n",
      name, 100 * c.plateau, 100 * c.duration, c.velocity_a, c.velocity_b, c.created, c.residual,
      c.momentum);
  EXPECT_LT(std::abs(c.plateau), 0.01);
  EXPECT_LT(std::abs(c.duration), 0.03);
  EXPECT_LT(std::abs(c.velocity_a), velocity);
  EXPECT_LT(std::abs(c.velocity_b), velocity);
  EXPECT_LT(std::abs(c.created), 0.01);
  EXPECT_LT(std::abs(c.residual), 1e-12);
  EXPECT_LT(c.momentum, 1e-12);
}

// Equal and matching meshes, so that every apex has a vertex below it. The penalty is twice the
// stiffness of the elements: softer ones lengthen the contact, harder ones leave the bars ringing.
constexpr double penalty_over_stiffness = 2;

TEST(TwoBars, CarryHalfTheImpedanceForOneRoundTripAndExchangeVelocities) {
  expect_exchange(collide(false, inviscid, penalty_over_stiffness), 0.01, "bars");
}

TEST(TwoBars, DoSoWithApexesAndBasesSwapped) {
  const Collision one = collide(false, inviscid, penalty_over_stiffness);
  const Collision other = collide(true, inviscid, penalty_over_stiffness);
  expect_exchange(other, 0.01, "bars swapped");
  EXPECT_NEAR(one.plateau, other.plateau, 1e-6);
  EXPECT_NEAR(one.velocity_b, other.velocity_b, 1e-6);
}

TEST(TwoBars, LoseLittleOfTheirVelocityByDefault) {
  expect_exchange(collide(false, {}, 10), 0.02, "bars with what the code chooses");
}

// --- how a run ends ------------------------------------------------------------------------------

TEST(Run, EndsAtTheEndWithoutAVanishingStep) {
  for (const double end : {1e-3, 3.3333e-3, 5e-3, 1e-5}) {
    Scene s = box();
    s.state.v(0, 0) = 0.1;
    double shortest = 1e300, before = 0, longest = 0;
    const Observer look = [&](const View& view) {
      if (view.now.step > 0)
        shortest = std::min(shortest, view.now.t - before),
        longest = std::max(longest, view.now.t - before);
      before = view.now.t;
    };
    const Outcome outcome = s.run_to(end, 1e300, {&look, 1});
    EXPECT_EQ(outcome.ending, Ending::reached_end);
    EXPECT_EQ(outcome.reason, "");
    EXPECT_EQ(s.state.t, end);
    EXPECT_GT(shortest, 0.45 * longest);
    EXPECT_EQ(outcome.limited_by.rfind("element ", 0), 0U) << outcome.limited_by;
    EXPECT_EQ(outcome.element_updates, 8 * (s.state.step + 1));
  }
}

TEST(Run, StaysBelowTheVotesBySafety) {
  Scene s = box();
  s.state.v(0, 0) = 0.1;
  double limit = 0;
  const Observer look = [&](const View& view) {
    if (view.now.step > 0) {
      EXPECT_LE(view.now.dt, 0.9 * limit * (1 + 1e-12));
    }
    limit = view.now.step_limits.elements.step;
  };
  const Outcome outcome = s.run_to(0.01, 1e300, {&look, 1});
  EXPECT_LE(outcome.smallest_step, outcome.largest_step);
  EXPECT_NEAR(outcome.largest_step / (0.9 * limit), 1, 0.01);
}

TEST(Run, StopsAtAnInvertedElementWithItsPlace) {
  Scene s = box({3, 2, 2});
  Index element = 7;  // of the second layer
  const Index node = element::nodes(s.model.blocks[0])(6, element);
  s.state.v(0, node) = -1e5;
  const Outcome outcome = s.run_to(1, 1e300, {}, 1e300);
  EXPECT_EQ(outcome.ending, Ending::inverted_element);
  EXPECT_EQ(outcome.block, "box");
  EXPECT_GE(outcome.element, 0);
  EXPECT_LT(outcome.element, 12);
  EXPECT_TRUE((element::nodes(s.model.blocks[0]).col(outcome.element).array() == node).any());
  EXPECT_NE(outcome.reason.find("of the reference"), std::string::npos) << outcome.reason;
  EXPECT_LT(s.state.t, 1);
}

TEST(Run, LooksAtTheLastStepToo) {
  Scene s = box();
  s.state.v(0, 13) = -1e5;
  const Outcome outcome = s.run_to(1e-5, 1e300, {}, 1e300);  // one step or two
  EXPECT_LE(s.state.step, 2);
  EXPECT_EQ(outcome.ending, Ending::inverted_element);
}

TEST(Run, StopsWhereAPositionIsNoNumber) {
  for (const bool first : {true, false}) {
    Scene s;
    s.model.mesh = mesh::join(mesh::box("one", {{0, 0, 0}, {1, 1, 1}, {6, 6, 6}}),
                              mesh::box("two", {{2, 0, 0}, {3, 1, 1}, {6, 6, 6}}));
    for (const char* name : {"one", "two"})
      s.model.blocks.push_back(element::hexahedra(s.model.mesh, name, rubber, inviscid));
    finalize(s.model);
    s.ready();
    s.move("one", {0.1, 0, 0});
    const Index node = mesh::node_set(s.model.mesh, first ? "one" : "two").front();
    s.state.v(1, node) = std::numeric_limits<double>::quiet_NaN();
    const Outcome outcome = s.run_to(0.1);
    EXPECT_EQ(outcome.ending, Ending::not_finite) << word(outcome.ending);
    EXPECT_EQ(outcome.block, first ? "one" : "two");
    EXPECT_LT(s.state.step, 20);
  }
}

TEST(Run, SaysThatANumberIsMissingAndNotThatEnergyWasCreated) {
  Scene s = box();
  s.move("box", {1, 0, 0});
  const Observer spoil = [&](const View& view) {  // an observer should not, but a machine might
    if (view.now.step == 3) s.state.v(0, 0) = std::numeric_limits<double>::infinity();
  };
  const Outcome outcome = s.run_to(0.1, 1e-9, {&spoil, 1});
  EXPECT_EQ(outcome.ending, Ending::not_finite) << word(outcome.ending) << ": " << outcome.reason;
}

/// A small box that slides over the border onto a large one.
Scene sliding() {
  Scene s;
  s.model.mesh =
      mesh::join(mesh::box("below", {{0, 0, 0}, {0.4, 0.4, 0.2}, {4, 4, 2}}),
                 mesh::box("above", {{-0.25, 0.15, 0.201}, {-0.05, 0.25, 0.3}, {2, 1, 1}}));
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "below", rubber, inviscid));
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "above", rubber, inviscid));
  finalize(s.model);
  return s;
}

TEST(Run, StopsWhenTheStepCollapsesAndSaysWhoAskedForIt) {
  Scene s = sliding();
  InterfaceOptions options{.method = contact::Method::penalty};
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  options.penalty = 1e25;
  s.joined("joint", "above.z_low", "below.z_high", options);
  s.ready();
  s.move("above", {1, 0, 0});
  const Outcome outcome = s.run_to(1);
  EXPECT_EQ(outcome.ending, Ending::step_too_small) << word(outcome.ending);
  EXPECT_EQ(outcome.block, "joint");
  EXPECT_NE(outcome.reason.find("the step fell from"), std::string::npos);
  EXPECT_GT(s.state.t, 0.03) << "a quarter of an element away, at 0.02, it begins to fall bit by bit";
  EXPECT_LT(s.state.t, 0.035);
}

/// Two boxes, one over the other.
void add_boxes(Scene& s) {
  s.model.mesh =
      mesh::join(mesh::box("below", {{0, 0, 0}, {0.4, 0.4, 0.2}, {4, 4, 2}}),
                 mesh::box("above", {{0.05, 0.05, 0.201}, {0.35, 0.35, 0.4}, {3, 3, 2}}));
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "below", rubber, inviscid));
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "above", rubber, inviscid));
}

/// An interface of these boxes that asks for steps far too long.
void join_carelessly(Scene& s) {
  InterfaceOptions options{.method = contact::Method::penalty};
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  options.penalty_scale = 30;
  s.joined("joint", "above.z_low", "below.z_high", options);
  std::get<contact::Interface>(s.model.contacts[0]).impact_step_factor = 1.9;  // the linear bound, nearly
  s.ready();
}

/// A box falls on another whose interface asks for steps far too long.
Scene careless(const Vec3& gravity = Vec3::Zero(), double speed = 3) {
  Scene s;
  add_boxes(s);
  s.model.gravity = gravity;
  if (!gravity.isZero(0)) {
    load::Plane ground;
    ground.name = "ground";
    ground.kind = load::PlaneKind::fixed;
    ground.nodes = mesh::node_set(s.model.mesh, "below.z_low");
    s.model.constraints.planes.push_back(ground);
  }
  finalize(s.model);
  join_carelessly(s);
  s.move("above", {0, 0, -speed});
  return s;
}

/// Whether the ledger stopped a run. With steps as long as the impact itself a contact first loses what it gains later.
bool stopped_by_the_ledger(const Outcome& outcome) {
  return outcome.ending == Ending::energy_created || outcome.ending == Ending::energy_lost;
}

TEST(Run, StopsWhenASourceCreatesEnergyAndNamesIt) {
  Scene s = careless();
  const Outcome outcome = s.run_to(0.05, 1e-4);
  EXPECT_TRUE(stopped_by_the_ledger(outcome)) << word(outcome.ending);
  EXPECT_EQ(outcome.block, "joint");
  EXPECT_NE(outcome.reason.find("the limit is 5 %"), std::string::npos) << outcome.reason;
  EXPECT_GT(std::abs(created(s.state.ledger.accounts[2])), 0.05 * s.state.ledger.initial_kinetic);
  EXPECT_LT(std::abs(energy_residual(s.state.ledger)),
            1e-11 * s.state.ledger.initial_kinetic);  // closes all the same
}

/// A heavy box that flies by, far away, with ten thousand times the energy of what else is there.
void add_ship(Scene& s) {
  s.model.mesh = mesh::join(s.model.mesh, mesh::box("ship", {{9, 9, 9}, {10, 10, 10}, {1, 1, 1}}));
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "ship", rubber, inviscid));
}

TEST(Run, StopsWhenASourceCreatesMuchOfWhatPassesThroughItThoughAnotherBodyHasMore) {
  Scene s;
  add_boxes(s);
  add_ship(s);
  finalize(s.model);
  join_carelessly(s);
  s.move("above", {0, 0, -3});
  s.move("ship", {10, 0, 0});
  const Outcome outcome = s.run_to(0.05, 0.01);
  EXPECT_TRUE(stopped_by_the_ledger(outcome)) << word(outcome.ending) << " " << outcome.reason;
  EXPECT_EQ(outcome.block, "joint");
  EXPECT_NE(outcome.reason.find("; the limit is 5 %"), std::string::npos) << outcome.reason;
  EXPECT_LT(std::abs(created(s.state.ledger.accounts[3])), 0.05 * energy_scale(s.state.ledger));
  EXPECT_NE(std::fmod(s.state.t, 0.01), 0);  // between two updates
}

/// Two boxes of which one loses stored energy in every step, as a faulty law would.
TEST(Run, StopsWhenASourceLosesEnergyAndNamesIt) {
  Scene s = careless();
  std::get<contact::Interface>(s.model.contacts[0]).impact_step_factor = contact::impact_step_factor_for(0.005);
  s.ready();
  s.move("above", {0, 0, -3});
  const std::vector<Observer> observers{[&s](const View&) { s.state.blocks[0].stored[Stored::elastic] *= 0.98; }};
  const Outcome outcome = s.run_to(0.05, 1e-3, observers);
  EXPECT_EQ(outcome.ending, Ending::energy_lost) << word(outcome.ending) << " " << outcome.reason;
  EXPECT_EQ(outcome.block, "below");
  EXPECT_NE(outcome.reason.find("lost "), std::string::npos) << outcome.reason;
}

TEST(Run, AnInvertedElementNamesTheSourceThatMadeEnergyBefore) {
  Scene s = careless();
  s.ready();
  s.move("above", {0, 0, -3});
  start(s.model, s.state, s.forces);
  s.state.progress.started = s.state.progress.ledger_is_current = true;
  s.state.progress.first_step = s.state.step_limits.elements.step;
  s.state.ledger.accounts[2].work = s.state.ledger.initial_kinetic;  // of the contact, and nothing that it comes from
  s.state.ledger.flows[2].passed = 2 * s.state.ledger.initial_kinetic;
  s.state.step_limits.volume_ratio = -0.5, s.state.step_limits.smallest_block = 1, s.state.step_limits.smallest_element = 3;
  const Outcome outcome = s.run_to(0.05);
  EXPECT_EQ(outcome.ending, Ending::inverted_element);
  EXPECT_EQ(outcome.block, "above");
  EXPECT_EQ(outcome.element, 3);
  EXPECT_EQ(outcome.reason,
            "its volume or area is -0.5 of the reference; before that joint had created 50 % of the energy that it transferred (81 J of "
            "1.6e+02 J)");
}

TEST(Run, AnInvertedElementBlamesNoBodyThatIsWithinItsLimit) {
  for (const double part : {0.2, 0.3}) {
    Scene s = careless();
    s.ready();
    s.move("above", {0, 0, -3});
    start(s.model, s.state, s.forces);
    s.state.progress.started = s.state.progress.ledger_is_current = true;
    s.state.progress.first_step = s.state.step_limits.elements.step;
    s.state.ledger.accounts[0].work = part * s.state.ledger.initial_available;
    s.state.ledger.flows[0].passed = s.state.ledger.initial_available;
    s.state.step_limits.volume_ratio = -0.5, s.state.step_limits.smallest_block = 1, s.state.step_limits.smallest_element = 3;
    const Outcome outcome = s.run_to(0.05);
    EXPECT_EQ(outcome.reason.find("before that below") != std::string::npos, part > 0.25) << outcome.reason;
  }
}

/// A cube that falls on one a million times lighter, which stands on the ground.
Scene heavy_on_light() {
  const double speed = 0.7;
  Scene s;
  s.model.mesh = mesh::join(mesh::box("a", {Vec3(-0.0039, -0.0043, 0.0002), Vec3(0.0061, 0.0057, 0.0102), {2, 2, 2}}),
                            mesh::box("b", {Vec3(-0.012, -0.012, -0.01), Vec3(0.012, 0.012, 0), {3, 3, 1}}));
  for (const auto& [name, density] : {std::pair{"a", 1e3}, std::pair{"b", 1e-3}})
    s.model.blocks.push_back(element::hexahedra(s.model.mesh, name, material::Elastic{density, 1e6, 0.3}, {}));
  s.model.constraints.planes = {plane("ground", load::PlaneKind::fixed, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "b.z_low"))};
  finalize(s.model);
  s.joined("touch", "a.z_low", "b.z_high", {});
  s.ready();
  s.move("a", {0, 0, -speed});
  return s;
}

TEST(Run, WhatAContactCreatesWhereMassesDifferIsADebtThatItPays) {
  Scene s = heavy_on_light();
  double most = 0, differs = 0, as_creation = 0;
  const Observer observer = [&](const View& view) {
    const Ledger& ledger = view.now.ledger;
    const Flow& flow = ledger.flows[2];
    const double made = created(ledger.accounts[2]);
    if (made > 0) differs = std::max(differs, std::abs(made - flow.deficit));
    const double scale = energy_scale(ledger), passed = std::max(flow.passed, least_flow * scale);
    if (flow.passed > least_share * scale) as_creation = std::max(as_creation, (made - flow.recent) / passed);
    most = std::max(most, made);
  };
  const Outcome outcome = s.run_to(1.2e-3, 1e300, std::span(&observer, 1));
  EXPECT_EQ(outcome.ending, Ending::reached_end) << outcome.reason;
  const double scale = energy_scale(s.state.ledger);
  EXPECT_GT(most, 1e-6 * scale);
  EXPECT_GT(as_creation, 0.01) << "judged as if it stayed, it would be warned of";
  EXPECT_LT(differs, 0.1 * most) << "but for what apexes owe that went away";
  EXPECT_LT(std::abs(created(s.state.ledger.accounts[2])), 0.2 * most);
}

TEST(Run, StopsWhenTimeIntegrationCreatesEnergy) {
  Scene s;
  s.model.mesh = mesh::box("cube", {{0, 0, 0}, {1, 1, 1}, {4, 4, 4}});
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "cube", material::J2Bilinear{7850, 2.1e11, 0.3, 3e8, 1e9},
                                                {.viscosity = {}, .distortion = {0}}));
  s.model.constraints.planes = {plane("mirror", load::PlaneKind::symmetry, -Vec3::UnitZ(), mesh::node_set(s.model.mesh, "cube.z_low"))};
  finalize(s.model);
  s.ready();
  s.move("cube", {0, 0, -4000});
  Time time{.end = 2e-3, .safety = 1.65};  // beyond the stable step
  time.created_limit = 0.05;
  const Outcome outcome = run(s.model, s.state, s.forces, time, 1e-5, {});
  EXPECT_EQ(outcome.ending, Ending::energy_created) << word(outcome.ending) << " " << outcome.reason;
  EXPECT_EQ(outcome.block, "time integration");
  EXPECT_NE(outcome.reason.find(" J); the limit is 5 %"), std::string::npos) << outcome.reason;
}

TEST(Run, ThatStartsAtRestIsHeldAgainstTheEnergyThatGravityBroughtIn) {
  Scene s = careless({0, 0, -200}, 0);
  const Outcome outcome = s.run_to(0.1, 1e-4);
  const Ledger& ledger = s.state.ledger;
  EXPECT_EQ(ledger.initial_kinetic, 0);
  EXPECT_TRUE(stopped_by_the_ledger(outcome)) << word(outcome.ending);
  EXPECT_EQ(outcome.block, "joint");
  EXPECT_GT(energy_scale(ledger), 0);
  EXPECT_GE(energy_scale(ledger), work_from_loads(ledger));
  EXPECT_GT(std::abs(spurious_part(ledger, 2)), 0.05);
}

/// A hard block that stands on the ground, and its energy floor: weight times diagonal over a thousand.
Scene standing(double& floor) {
  Scene s;
  s.model.mesh = mesh::box("block", {{0, 0, 0}, {0.3, 0.4, 1.2}, {1, 1, 3}});
  s.model.blocks.push_back(element::hexahedra(s.model.mesh, "block", material::Elastic{1000, 1e12, 0.3}, {}));
  s.model.constraints.planes = {plane("ground", load::PlaneKind::fixed, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "block.z_low"))};
  s.model.gravity = {0, 0, -10};
  finalize(s.model);
  s.ready();
  floor = 1000 * 0.3 * 0.4 * 1.2 * 10 * 1.3 / 1000;
  return s;
}

TEST(Run, ThatStandsStillStopsWhereASourceCreatesATwentiethOfTheEnergyFloor) {
  for (const double part : {1e-6, -1e-6, 0.049, -0.049, 0.051, -0.051, 1.0, -1.0, 1e3, 1e9}) {  // of the floor, all in one step
    double floor = 0;
    Scene s = standing(floor);
    const std::vector<Observer> faulty_law{[&](const View& view) {
      element::Memory& block = s.state.blocks[0];  // a store below zero is no loss
      if (view.now.step == 3) (part > 0 ? block.stored[Stored::elastic] : block.dissipated[Dissipated::viscous]) += part * floor;
    }};
    const Outcome outcome = s.run_to(1e-3, 1e-5, faulty_law);
    EXPECT_NEAR(energy_floor(s.state.ledger) / floor, 1, 1e-12);
    EXPECT_LT(s.state.ledger.external_work, 1e-4 * floor);
    const Ending expected = std::abs(part) < 0.05 ? Ending::reached_end : part > 0 ? Ending::energy_created : Ending::energy_lost;
    EXPECT_EQ(outcome.ending, expected) << part << " " << outcome.reason;
    if (expected == Ending::reached_end) continue;
    EXPECT_EQ(outcome.block, "block");
    EXPECT_NE(outcome.reason.find("of the energy floor of 1.87 J, a force of 1.44e+03 N over a thousandth of 1.3 m ("),
              std::string::npos) << outcome.reason;
  }
}

TEST(EnergyFloorOfARun, IsOfTheLargestForceOfLoadsSoFarWhereThatIsMoreThanTheWeight) {
  double floor = 0;
  Scene s = standing(floor);
  const auto pulse = [](double t) { return t < 5e-4 ? 1e5 * t / 5e-4 : 0.0; };  // [Pa] on two faces of 0.36 m2
  for (const char* side : {"block.y_low", "block.y_high"})
    s.model.loads.emplace_back(load::pressure_on(side, s.model.mesh, mesh::surface(s.model.mesh, side), pulse));
  s.ready();
  start(s.model, s.state, s.forces);
  EXPECT_NEAR(energy_floor(s.state.ledger) / floor, 1, 1e-12);
  Scene again = s;
  again.ready();
  EXPECT_EQ(again.run_to(1e-3).ending, Ending::reached_end);
  EXPECT_NEAR(energy_floor(again.state.ledger) / (2 * 0.36 * 1e5 * 1.3e-3), 1, 0.02) << "opposite forces do not cancel";
}

enum class Acts { gravity, body_force, driven_plane };

/// Two blocks, one on the other, tied: the positions of their nodes agree to round-off.
///
/// power  of the time with which a body force, or the speed of a plane, grows from zero
Scene tied(double size, contact::Method method, Acts acts, int power) {
  Scene s;
  s.model.mesh = mesh::join(mesh::box("low", {{0, 0, 0}, {size, size, size}, {4, 4, 4}}),
                            mesh::box("high", {{0, 0, size}, {size, size, 2 * size}, {4, 4, 4}}));
  for (const char* name : {"low", "high"})
    s.model.blocks.push_back(element::hexahedra(s.model.mesh, name, material::Elastic{1000, 1e7, 0.3}, {}));
  s.model.constraints.planes = {plane("ground", load::PlaneKind::fixed, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "low.z_low"))};
  const auto none = [](double, double, double, double) { return 0.0; };
  const auto grows = [power](double most) { return [=](double, double, double, double t) { return -most * std::pow(t / 1e-3, power); }; };
  if (acts == Acts::gravity) s.model.gravity = {0, 0, -9.81};
  if (acts == Acts::driven_plane) {
    s.model.constraints.planes.push_back(
        plane("press", load::PlaneKind::driven, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "high.z_high")));
    s.model.constraints.planes.back().field = {none, none, grows(0.1)};
  }
  finalize(s.model);
  if (acts == Acts::body_force) {
    Subset nodes(static_cast<std::size_t>(s.model.mesh.X.cols()));
    std::iota(nodes.begin(), nodes.end(), 0);
    s.model.loads.emplace_back(load::BodyForce{.name = "weight", .nodes = nodes, .mass = s.model.mass,
                                               .acceleration = {none, none, grows(9.81)}});
  }
  InterfaceOptions tie{.kind = contact::InterfaceKind::tied, .method = method};
  tie.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  s.joined("tie", "high.z_low", "low.z_high", tie);
  s.ready();
  return s;
}

TEST(Run, OfTiesThatAreLoadedFromRestGoesOn) {
  for (const auto method : {contact::Method::penalty, contact::Method::multiplier})
    for (const double size : {0.1, 0.125})
      for (const auto acts : {Acts::gravity, Acts::body_force, Acts::driven_plane})
        for (const int power : {1, 4, 8}) {
          Scene s = tied(size, method, acts, power);
          const Outcome outcome = s.run_to(1e-3, 1e-5);
          EXPECT_EQ(outcome.ending, Ending::reached_end) << outcome.reason;
          const Flow& flow = s.state.ledger.flows[source_of(s.model, "tie")];
          EXPECT_LT(std::abs(flow.worst), 1e-3);
          EXPECT_LT(std::abs(flow.worst_of_scene), 1e-3);
        }
}

TEST(Run, OfAFreeSceneIsJudgedAlikeByWhoMovesAlongAndWhoStands) {
  std::array<double, 2> scale{};
  for (const double along : {0.0, 500.0}) {
    Scene s = careless();
    s.move("above", {along, 0, -3});
    s.move("below", {along, 0, 0});
    start(s.model, s.state, s.forces);
    scale[along > 0] = energy_scale(s.state.ledger);
    EXPECT_GT(s.state.ledger.initial_kinetic, 1.5 * s.state.ledger.initial_available);
  }
  EXPECT_NEAR(scale[1] / scale[0], 1, 1e-9);
  Scene held = careless({0, 0, -1}, 3);  // by a plane
  start(held.model, held.state, held.forces);
  EXPECT_EQ(held.state.ledger.initial_available, held.state.ledger.initial_kinetic);
}

TEST(TimesTheLimit, IsFiveForBodiesAndWhereLessThanAHundredthOfTheEnergyOfTheSceneHasPassed) {
  Model model;
  model.contacts.emplace_back(contact::Interface());
  Ledger ledger;
  ledger.initial_kinetic = ledger.initial_available = 10;
  ledger.flows.resize(1);
  EXPECT_EQ(times_the_limit(model, ledger, -1), 1) << "time integration";
  ledger.flows[0].passed = 0.099;
  EXPECT_EQ(times_the_limit(model, ledger, 0), 5);
  ledger.flows[0].passed = 0.101;
  EXPECT_EQ(times_the_limit(model, ledger, 0), 1);
  model.blocks.emplace_back();
  EXPECT_EQ(times_the_limit(model, ledger, 0), 5);
}

TEST(Run, GoesOnWithinTheLimitOfCreatedEnergyThatItIsGiven) {
  Scene s = careless();
  EXPECT_EQ(s.run_to(0.01, 1e-4, {}, 1e9).ending, Ending::reached_end);
}

TEST(Run, HasAWordForEveryEnding) {
  EXPECT_EQ(word(Ending::reached_end), "reached_end");
  EXPECT_EQ(word(Ending::inverted_element), "inverted_element");
  EXPECT_EQ(word(Ending::not_finite), "not_finite");
  EXPECT_EQ(word(Ending::step_too_small), "step_too_small");
  EXPECT_EQ(word(Ending::energy_created), "energy_created");
  EXPECT_EQ(word(Ending::energy_lost), "energy_lost");
  EXPECT_EQ(word(Ending::relaxed), "relaxed");
  EXPECT_EQ(word(Ending::not_relaxed), "not_relaxed");
}

// --- observers -----------------------------------------------------------------------------------

TEST(Observers, LookAtTheStartAndAfterEveryStepAndChangeNothing) {
  Scene with = box(), without = box();
  with.state.v(0, 0) = without.state.v(0, 0) = 0.1;
  std::vector<double> times;
  int settled = 0;
  const Observer look = [&](const View& view) {
    times.push_back(view.now.t);
    settled += view.ledger_is_current;
    if (!view.ledger_is_current) return;
    double kinetic = 0;
    for (Eigen::Index n = 0; n < view.now.v.cols(); ++n)
      kinetic += 0.5 * view.model.mass(n) * view.now.v.col(n).squaredNorm();
    EXPECT_NEAR(view.now.ledger.kinetic / kinetic, 1, 1e-14);
  };
  const Observer observers[] = {look};
  with.run_to(0.1, 0.01, observers);
  without.run_to(0.1);  // nor does settling
  ASSERT_EQ(static_cast<std::int64_t>(times.size()), with.state.step + 1);
  EXPECT_EQ(times.front(), 0);
  EXPECT_EQ(times.back(), 0.1);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(settled, 11);
  EXPECT_EQ(with.state.step, without.state.step);
  EXPECT_EQ(std::memcmp(with.state.x.data(), without.state.x.data(),
                        sizeof(double) * static_cast<std::size_t>(with.state.x.size())),
            0);
  EXPECT_EQ(std::memcmp(with.state.v.data(), without.state.v.data(),
                        sizeof(double) * static_cast<std::size_t>(with.state.v.size())),
            0);
}

TEST(Observers, SeeTheLedgerOfTheLastStateOfARunThatStopped) {
  Scene s = box();
  s.state.v(0, 13) = -1e5;
  bool last = false;
  const Observer look = [&](const View& view) { last = view.ledger_is_current; };
  s.run_to(1, 1e300, {&look, 1}, 1e300);
  EXPECT_TRUE(last);
}

TEST(Probes, OfEveryStepSeeEachStateOnceAlsoWhereARunStopsBetweenUpdatesOfItsLedger) {
  Scene s = box();
  s.state.v(0, 13) = -1e5;  // an element inverts
  const std::vector<Probe> probes{{"one", "1", [](const View&, Kept&) { return 1.0; }}};
  Time time;
  time.end = 1, time.created_limit = 1e300;
  const Outcome outcome = run(s.model, s.state, s.forces, time, 1e300, {.probes = probes});
  EXPECT_EQ(outcome.ending, Ending::inverted_element);
  EXPECT_EQ(s.state.probes[0].samples, s.state.step + 1);
  EXPECT_NEAR(s.state.probes[0].integral, s.state.t, 1e-12 * s.state.t);
}

// --- conditions ----------------------------------------------------------------------------------

TEST(Until, EndsARunAtTheFirstSampleThatSaysWhy) {
  Scene s = box();
  s.move("box", {1, 0, 0});
  const auto moved = [](const View& view) { return view.now.x(0, 0) - view.model.mesh.X(0, 0); };
  std::vector<double> asked;
  const Until until = [&](const View& view, std::vector<ConditionMemory>&) -> std::string {
    asked.push_back(view.now.t);
    EXPECT_TRUE(view.ledger_is_current);
    return moved(view) > 0.045 ? "far enough" : "";
  };
  Time time;
  time.end = 1;
  const Outcome outcome = run(s.model, s.state, s.forces, time, 1e-2, {.until = until});
  EXPECT_EQ(outcome.ending, Ending::stopped_by_condition);
  EXPECT_TRUE(good(outcome.ending));
  EXPECT_EQ(outcome.reason, "far enough");
  ASSERT_EQ(asked.size(), 6U);  // at 0, 10, ... 50 ms
  EXPECT_EQ(asked[0], 0);
  EXPECT_EQ(asked.back(), s.state.t);
  EXPECT_NEAR(s.state.t, 5e-2, s.state.dt);  // the first step past the sample
}

TEST(Until, MayEndARunBeforeItsFirstStep) {
  Scene s = box();
  Time time;
  time.end = 1;
  const Outcome outcome = run(s.model, s.state, s.forces, time, 1e-3, {.until = [](const View&, auto&) { return "at once"; }});
  EXPECT_EQ(outcome.ending, Ending::stopped_by_condition);
  EXPECT_EQ(s.state.step, 0);
}

TEST(Until, LeavesARunAloneThatNeverMeetsIt) {
  Scene s = box(), alone = box();
  s.move("box", {1, 0, 0}), alone.move("box", {1, 0, 0});
  Time time;
  time.end = 0.01;
  EXPECT_EQ(run(s.model, s.state, s.forces, time, 1e-3, {.until = [](const View&, auto&) { return ""; }}).ending, Ending::reached_end);
  run(alone.model, alone.state, alone.forces, time, 1e-3);
  EXPECT_EQ(s.state.x, alone.state.x);
}

}  // namespace
}  // namespace nereid::dynamics::run_test
