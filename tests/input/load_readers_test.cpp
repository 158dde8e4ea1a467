#include "input/load_readers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "input/scene_readers.hpp"

namespace nereid::input::load_readers_test {
namespace {

/// Behind a text, so that its lines keep their numbers: a box of hexahedra and a tube of plates.
const std::string bodies = R"case(
bodies:
  - name: box
    mesh: {kind: box, low: [0 m, 0 m, 0 m], high: [0.2 m, 0.2 m, 0.2 m], cells: [2, 2, 2]}
    material: {kind: elastic, density: 1000 kg/m^3, young: 1 MPa, poisson: 0}
    points: [{name: tip, near: [0 m, 0 m, 0 m]}, {name: top, near: [0.2 m, 0.2 m, 0.2 m]}]
  - name: tube
    mesh: {kind: tube, radius: 0.5 m, length: 0.8 m, turn: full, cells_core: 1, cells_along: 2}
    material: {kind: elastic, density: 1000 kg/m^3, young: 1 MPa, poisson: 0}
    element: {thickness: 1 cm}
time: {end: 1 s}
)case";

using model::Scene;
using model::Simulation;

/// These bodies with what a text says acts on them.
struct Case {
  explicit Case(const std::string& text) : file(CaseFile::parse(text + bodies, "case.yaml")), scene(read_scene(file.root())) {}
  void start() {
    try {
      simulation = build(file, scene);
    } catch (const CaseError& error) {
      found = error.faults;
    }
  }
  /// Faults so far, or nothing.
  std::vector<Fault> faults() const { return found; }
  CaseFile file;
  Scene scene;
  Simulation simulation;
  const dynamics::Model& model = simulation.model;
  const dynamics::State& state = simulation.state;
  std::vector<Fault> found;
};

/// The messages of a text's faults, joined, once everything has been built; "place: message".
std::string faults_of(const std::string& text) {
  Case c(text);
  std::string all;
  c.start();
  for (const Fault& fault : c.faults())
    all += std::to_string(fault.line) + ":" + std::to_string(fault.column) + ": " + fault.message +
           (fault.hint.empty() ? "" : " (" + fault.hint + ")") + "\n";
  return all;
}

TEST(ReadActions, OfAnEmptyCaseAreNone) {
  Case c("");
  c.start();
  EXPECT_TRUE(c.model.constraints.planes.empty() && c.model.loads.empty() && c.model.point_masses.empty());
  EXPECT_FALSE(c.model.relaxation.has_value());
  EXPECT_EQ(c.model.gravity, Vec3(0, 0, 0));
}

TEST(ReadActions, ReadHowARunRelaxes) {
  Case c("relaxation: {residual: 1e-5, after: 1 ms, samples: 3}\n");
  c.start();
  EXPECT_TRUE(c.faults().empty()) << c.faults()[0].text;
  EXPECT_EQ(c.model.relaxation->residual, 1e-5);
  EXPECT_EQ(c.model.relaxation->samples, 3);
  EXPECT_EQ(c.model.relaxation->after, 1e-3);
}

TEST(ReadActions, BuildEverythingThatTheSyntaxHas) {
  Case c(R"case(
gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]
planes:
  - {name: axis, kind: symmetry, nodes: [box.y_low], normal: [0, 2, 0]}
  - {name: pull, kind: constrained, nodes: [box.x_high], normal: [1, 0, 0], velocity: {value: "2*t", unit: mm/s}}
  - {name: clamp, kind: fixed, nodes: [tube.top]}
  - {name: ground, kind: floor, nodes: [box, tube], point: [0 m, 0 m, -1 m], normal: [0, 0, 1]}
  - {name: wall, kind: rigid, surface: box.x_high, point: [1 m, 0 m, 0 m], normal: [-1, 0, 0]}
loads:
  - {name: push, kind: pressure, surface: box.z_high, value: "1e6 * min(1, t/1e-3)", unit: kPa}
  - {name: tug, kind: force, nodes: box.z_high, value: ["0", "t", "-1000"], unit: N}
  - {name: twist, kind: moment, nodes: tube.top, value: [0, 0, 1], unit: N*m}
  - {name: field, kind: body_force, body: box, value: ["x", "y*t", "-9.81"], unit: m/s^2}
springs:
  - {name: k, from: box.tip, to: box.top, stiffness: 1e6 N/m, damping: 2 N*s/m, rest_length: 1 cm}
  - {name: anchor, from: box.tip, to: ground, stiffness: 1e3 N/m}
point_masses:
  - {name: weight, nodes: box.z_high, mass: 9 kg}
initial:
  - {body: box, velocity: ["-3*y", "3*x", "0"], unit: m/s}
  - {body: box, displacement: ["1e-3*x", "0", "0"], unit: m}
  - {body: tube, velocity: ["-3*y", "3*x", "0"], unit: m/s}
)case");
  c.start();
  EXPECT_TRUE(c.faults().empty()) << c.faults()[0].text;
  ASSERT_EQ(c.model.constraints.planes.size(), 4U);
  ASSERT_EQ(c.model.rigid_planes.size(), 1U);
  EXPECT_EQ(c.model.rigid_planes[0].normal, Vec3(-1, 0, 0));
  EXPECT_EQ(c.model.constraints.planes[0].normal, Vec3(0, 1, 0));
  EXPECT_DOUBLE_EQ(c.model.constraints.planes[1].velocity(3), 6e-3);
  EXPECT_EQ(c.model.constraints.planes[2].kind, load::PlaneKind::fixed);
  EXPECT_EQ(c.model.constraints.planes[3].point, Vec3(0, 0, -1));
  EXPECT_EQ(c.model.constraints.planes[3].nodes.size(), static_cast<std::size_t>(c.model.mesh.X.cols()));
  ASSERT_EQ(c.model.loads.size(), 6U);
  const auto& push = std::get<load::Pressure>(c.model.loads[0]);
  EXPECT_DOUBLE_EQ(push.pressure(5e-4), 5e8);
  EXPECT_DOUBLE_EQ(push.pressure(1), 1e9);
  EXPECT_EQ(std::get<load::NodalForce>(c.model.loads[1]).force[2](7), -1000);
  EXPECT_EQ(std::get<load::NodalMoment>(c.model.loads[2]).moment[2](7), 1);
  const auto& field = std::get<load::BodyForce>(c.model.loads[3]);
  EXPECT_EQ(field.acceleration[1](0, 2, 0, 3), 6);
  EXPECT_NEAR(field.mass.sum(), 8, 1e-12);  // without the point masses
  EXPECT_EQ(std::get<load::Spring>(c.model.loads[4]).length, 0.01);
  EXPECT_EQ(std::get<load::Spring>(c.model.loads[5]).length, 0);
  EXPECT_NEAR(c.model.mass.head(27).sum(), 17, 1e-12);
  EXPECT_EQ(c.model.gravity, Vec3(0, 0, -9.81));
  for (Index n = 0; n < c.state.v.cols(); ++n) {
    const Vec3 X = c.model.mesh.X.col(n);
    EXPECT_NEAR((c.state.v.col(n) - Vec3(-3 * X.y(), 3 * X.x(), 0)).norm(), 0, 1e-15);
    const Index turn = c.model.rotation_of_node[n];
    if (turn >= 0) {
      EXPECT_NEAR((c.state.omega.col(turn) - Vec3(0, 0, 3)).norm(), 0, 1e-9);  // by differences
    } else {
      EXPECT_NEAR(c.state.x(0, n), 1.001 * X.x(), 1e-16);
    }
  }
  EXPECT_GT(c.state.blocks[0].stored[Stored::elastic], 0);
}

TEST(ReadActions, ListNamesThatTheMeshDoesNotHaveAtTheirLine) {
  const std::string found = faults_of("planes:\n  - {name: a, kind: constrained, nodes: [box.x_lou], normal: [1, 0, 0]}\n");
  EXPECT_EQ(found.rfind("2:42: 'nodes' = box.x_lou is unknown: node sets are box, ", 0), 0U) << found;
  EXPECT_NE(found.find("(did you mean 'box.x_low'?)"), std::string::npos) << found;
  EXPECT_NE(faults_of("loads:\n  - {name: a, kind: pressure, surface: x, value: 1, unit: Pa}\n")
                .find("2:40: 'surface' = x is unknown: surfaces are box.x_low"),
            std::string::npos);
  EXPECT_NE(faults_of("initial:\n  - {body: bax, velocity: [1, 2, 3], unit: m/s}\n").find("did you mean 'box'?"), std::string::npos);
  EXPECT_NE(faults_of("point_masses:\n  - {name: m, nodes: nix, mass: 1 kg}\n").find("2:22: 'nodes' = nix is unknown: node sets are"),
            std::string::npos);
}

TEST(ReadActions, RefuseASpringThatDoesNotEndAtSingleNodes) {
  EXPECT_EQ(faults_of("springs:\n  - {name: k, from: box.tip, to: box.z_high, stiffness: 1 N/m}\n"),
            "2:34: the node set 'box.z_high' has 9 nodes: a spring ends at a single one\n");
  EXPECT_EQ(faults_of("springs:\n  - {name: k, from: box.tip, to: box.tip, stiffness: 1 N/m}\n"),
            "2:34: 'from' and 'to' are the same node\n");
}

TEST(ReadActions, RefuseAMomentOnNodesOfSolids) {
  EXPECT_EQ(faults_of("loads:\n  - {name: m, kind: moment, nodes: box.tip, value: [1, 0, 0], unit: N*m}\n"),
            "2:36: a moment acts on nodes of plates or on rigid bodies only: 'box.tip' has others\n");
}

TEST(ReadActions, RefusePlanesThatMoveNodesAgainstOneAnother) {
  EXPECT_EQ(faults_of("planes:\n  - {name: a, kind: constrained, nodes: [box.x_low], normal: [1, 0, 0], velocity: {value: 1, unit: m/s}}\n"
                      "  - {name: b, kind: fixed, nodes: [box.tip]}\n"),
            "2:83: 'a' moves nodes that 'b' constrains in the same direction\n");
  EXPECT_EQ(faults_of("planes:\n  - {name: a, kind: constrained, nodes: [box.x_low], normal: [1, 0, 0], velocity: {value: 1, unit: m/s}}\n"
                      "  - {name: b, kind: constrained, nodes: [box.x_low], normal: [1, 1, 0]}\n"),
            "");
}

TEST(ReadActions, DrivenNodesHaveFieldsOverPlaceAndTime) {
  Case c(
      "planes:\n  - {name: a, kind: driven, nodes: [tube.top], velocity: {value: [x*t, y, \"1\"], unit: mm/s}, angular_velocity: {value: "
      "[0, z, t], unit: rad/s}}\n"
      "  - {name: b, kind: driven, nodes: [box.x_low, box.z_low], velocity: {value: [0, 0, x], unit: m/s}}\n");
  c.start();
  EXPECT_TRUE(c.faults().empty()) << c.faults()[0].text;
  const load::Plane &a = c.model.constraints.planes[0], &b = c.model.constraints.planes[1];
  EXPECT_DOUBLE_EQ(a.field[0](2, 3, 4, 5), 0.01);
  EXPECT_DOUBLE_EQ(a.angular_velocity[1](2, 3, 4, 5), 4);
  EXPECT_FALSE(b.angular_velocity[0]);
  EXPECT_EQ(b.nodes.size(), 15U);
}

TEST(ReadActions, RefuseDrivenNodesThatCannotBe) {
  const std::string a = "planes:\n  - {name: a, kind: driven, nodes: [box.x_low], ";
  EXPECT_EQ(
      faults_of(a + "velocity: {value: [1, 0, 0], unit: m/s}}\n  - {name: b, kind: constrained, nodes: [box.tip], normal: [0, 1, 0]}\n"),
      "2:59: 'a' drives nodes that 'b' constrains in the same direction\n");
  EXPECT_EQ(faults_of(a + "velocity: {value: [1/x, 0, 0], unit: m/s}}\n"), "2:67: 'value' is infinite at x = 0, y = 0, z = 0, t = 0\n");
  EXPECT_EQ(faults_of(a + "velocity: {value: 1, unit: m/s}}\n").substr(0, 5), "2:67:");
  EXPECT_EQ(faults_of(a + "velocity: {value: [1, 0, 0], unit: m/s}, angular_velocity: {value: [1, 0, 0], unit: rad/s}}\n"),
            "2:108: 'angular_velocity' is of nodes of plates or rigid bodies: 'a' has none\n");
  EXPECT_EQ(faults_of(a + "velocity: {value: [1, 0, 0], unit: m}}\n").substr(0, 24), "2:84: 'unit' = m has the");
  EXPECT_NE(faults_of(a + "}\n").find("missing section 'velocity'"), std::string::npos);
}

TEST(ReadActions, RefuseANameGivenTwice) {
  EXPECT_EQ(
      faults_of(
          "planes:\n  - {name: a, kind: fixed, nodes: [box.tip]}\nsprings:\n  - {name: a, from: box.tip, to: ground, stiffness: 1 N/m}\n"),
      "4:12: the name 'a' is given twice: 'planes[0]' has it too\n");
}

TEST(ReadActions, RefuseUnitsOfAnotherDimensionAndValuesThatAreNoNumber) {
  EXPECT_EQ(faults_of("loads:\n  - {name: a, kind: pressure, surface: box.x_low, value: 1, unit: N}\n"),
            "2:67: 'unit' = N has the dimension [kg m s^-2]: expected [kg m^-1 s^-2], for example 'Pa'\n");
  EXPECT_EQ(faults_of("loads:\n  - {name: a, kind: pressure, surface: box.x_low, value: 1/t, unit: Pa}\n"),
            "2:58: 'value' is infinite at t = 0\n");
  EXPECT_EQ(faults_of("loads:\n  - {name: a, kind: body_force, body: box, value: [\"log(x)\", 0, 0], unit: m/s^2}\n").substr(0, 5),
            "2:51:");
  EXPECT_EQ(faults_of("initial:\n  - {body: box, velocity: [\"0/y\", 0, 0], unit: m/s}\n"),
            "2:27: 'velocity' is no number at x = 0, y = 0, z = 0\n");
  EXPECT_EQ(faults_of("initial:\n  - {body: box, velocity: [\"t\", 0, 0], unit: m/s}\n"),
            "2:29: cannot read 'velocity[0]' = t: 't' is unknown: expected x, y, z, pi, or a function such as sin, min, exp\n");
  EXPECT_EQ(faults_of("planes:\n  - {name: a, kind: constrained, nodes: [box.tip], normal: [0, 0, 0]}\n"),
            "2:60: 'normal' has no direction: its length is zero\n");
  for (const char* far : {"1e155", "1e-170", "5e-324"})
    EXPECT_EQ(faults_of(std::string("planes:\n  - {name: a, kind: constrained, nodes: [box.tip], normal: [") + far + ", 0, 0]}\n"), "");
}

TEST(ReadActions, RefuseADisplacementThatTurnsElementsInsideOut) {
  EXPECT_EQ(faults_of("initial:\n  - {body: box, displacement: [\"-2*x\", 0, 0], unit: m}\n").substr(0, 41),
            "2:31: 'displacement' turns element 0 insi");
}

TEST(ReadActions, WantEitherAVelocityOrADisplacement) {
  EXPECT_EQ(faults_of("initial:\n  - {body: box, unit: m}\n").substr(0, 60),
            "2:5: expected 'velocity' or 'displacement' in 'initial[0]'\n2");
  EXPECT_NE(faults_of("initial:\n  - {body: box, velocity: [0, 0, 0], displacement: [0, 0, 0], unit: m}\n").find("make two items"),
            std::string::npos);
}

TEST(ReadActions, ListKeysThatAKindDoesNotUse) {
  Case c("planes:\n  - {name: a, kind: fixed, nodes: [box.tip], normal: [1, 0, 0]}\n");
  c.start();
  EXPECT_TRUE(c.faults().empty());
  ASSERT_EQ(c.file.not_used().size(), 1U);
  EXPECT_EQ(c.file.not_used()[0].rfind("planes[0].normal", 0), 0U);
}

}  // namespace
}  // namespace nereid::input::load_readers_test
