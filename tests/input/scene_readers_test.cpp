#include "input/scene_readers.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "model/meshes.hpp"

namespace nereid::input::scene_readers_test {
namespace {

const std::string steel = "{kind: elastic, density: 7850 kg/m^3, young: 210 GPa, poisson: 0.3}";
const std::string bar =
    "bodies:\n  - name: bar\n    mesh: {kind: box, low: [0 m, 0 m, 0 m], high: [1 m, 1 m, 1 m], cells: [2, 2, 2]}\n"
    "    material: " + steel + "\n";
const std::string skin =
    "  - name: skin\n    mesh: {kind: tube, radius: 1 m, length: 1 m, turn: full, cells_core: 2, cells_along: 2}\n"
    "    material: " + steel + "\n    element: {thickness: 2 mm, layers: 3, drilling: 0.01}\n";
const std::string time = "time: {end: 1 ms}\n";

model::Scene read(const std::string& text) {
  const CaseFile file = CaseFile::parse(text, "case.yaml");
  model::Scene scene = read_scene(file.root());
  file.finish();
  return scene;
}

/// What is said of a scene that is refused; empty if it is not.
std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ReadBody, TakesMeshMaterialAndElement) {
  const model::Scene scene = read(bar + skin + time);
  ASSERT_EQ(scene.bodies.size(), 2U);
  EXPECT_EQ(scene.bodies[0].name, "bar");
  EXPECT_FALSE(model::has_plates(scene.bodies[0].mesh));
  EXPECT_TRUE(std::holds_alternative<element::Hexahedron::Options>(scene.bodies[0].solid));
  EXPECT_TRUE(model::has_plates(scene.bodies[1].mesh));
  EXPECT_EQ(scene.bodies[1].plate.thickness, 2e-3);
  EXPECT_EQ(scene.bodies[1].plate.thinning, element::Plate::Thinning::by_law);
  EXPECT_EQ(scene.bodies[1].plate.drilling, 0.01);
  EXPECT_EQ(scene.bodies[1].plate.layers, 3);
}

TEST(ReadBody, StandsWhereItIsTurnedAndMoved) {
  const model::Scene scene =
      read(bar + "    rotate: {axis: [0, 0, 2], angle: 90 deg, about: [1 m, 0 m, 0 m]}\n    move: [0 m, 0 m, 1 mm]\n" + time);
  const model::Placement& place = scene.bodies[0].place;
  EXPECT_EQ(place.axis, Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(place.angle, std::numbers::pi / 2);
  EXPECT_EQ(place.about, Vec3(1, 0, 0));
  EXPECT_EQ(place.move, Vec3(0, 0, 1e-3));
  const model::Placement still = read(bar + time).bodies[0].place;
  EXPECT_EQ(still.angle, 0);
  EXPECT_EQ(still.move, Vec3::Zero());
}

TEST(ReadBody, TakesProductsOfInertiaInTheirOrder) {
  const model::Scene scene = read(bar + "    rigid: true\n    mass_properties: {inertia: [1 kg*m^2, 2 kg*m^2, 3 kg*m^2, 0.1 kg*m^2, "
                                        "0.2 kg*m^2, 0.3 kg*m^2]}\n" + time);
  const Mat3 inertia = scene.bodies[0].given.inertia.value();
  EXPECT_EQ(Vec3(inertia.diagonal()), Vec3(1, 2, 3));
  EXPECT_EQ(Vec3(inertia(0, 1), inertia(1, 2), inertia(0, 2)), Vec3(0.1, 0.2, 0.3)) << "xy, yz, xz";
  EXPECT_EQ(inertia, Mat3(inertia.transpose()));
}

TEST(ReadBody, MayHaveFullHexahedra) {
  const model::Scene scene = read(bar + "    element: {kind: full}\n" + time);
  EXPECT_TRUE(std::holds_alternative<element::FullHexahedron::Options>(scene.bodies[0].solid));
}

TEST(ReadBody, ListsWhatItsElementsDoNotUse) {
  const CaseFile file = CaseFile::parse(bar + "    element: {thickness: 1 mm}\n" + time, "case.yaml");
  read_scene(file.root());
  file.finish();
  ASSERT_EQ(file.not_used().size(), 1U);
  EXPECT_EQ(file.not_used()[0].rfind("bodies[0].element.thickness", 0), 0U);
}

TEST(ReadContact, ReachesHalfTheThicknessOfPlatesUnlessTold) {
  const std::string contact = "contacts:\n  - {name: touch, apexes: bar.x_high, base: skin.inside";
  const model::Scene usual = read(bar + skin + contact + "}\n" + time),
                     given = read(bar + skin + contact + ", contact_height: given, height: 3 mm}\n" + time),
                     initial = read(bar + skin + contact + ", contact_height: initial, clearance: 1 mm}\n" + time);
  EXPECT_TRUE(usual.contacts[0].height_from_thickness);
  EXPECT_FALSE(given.contacts[0].height_from_thickness);
  EXPECT_EQ(given.contacts[0].interface.height.given, 3e-3);
  EXPECT_FALSE(initial.contacts[0].height_from_thickness);
  EXPECT_TRUE(initial.contacts[0].interface.height.from_initial_height);
  EXPECT_EQ(initial.contacts[0].interface.height.clearance, 1e-3);
}

TEST(Names, AreGivenOnceAmongAllThatTheLedgerHas) {
  const std::string contact = "contacts:\n  - {name: touch, apexes: bar.x_high, base: skin.inside, passes: two}\n";
  EXPECT_EQ(refusal(bar + skin + contact + time), "");
  EXPECT_TRUE(says(refusal(bar + bar.substr(8) + time), "'name' = bar is given twice"));
  EXPECT_TRUE(says(refusal(bar + skin + contact + "planes:\n  - {name: touch_back, kind: fixed, nodes: [bar]}\n" + time),
                   "'name' = touch_back is given twice"));  // the account of the second pass
  EXPECT_TRUE(says(refusal(bar + "planes:\n  - {name: gravity, kind: fixed, nodes: [bar]}\n" + time), "given twice"));
}

TEST(Names, HaveNoPointsBlanksOrFirstDigits) {
  for (const char* name : {"a.b", "a b", "1a", "a-b"})
    EXPECT_TRUE(says(refusal(bar + "planes:\n  - {name: " + name + ", kind: fixed, nodes: [bar]}\n" + time), "is no name")) << name;
}

TEST(ReadProbe, HasAComponentOnlyWhereItsQuantityHas) {
  const model::Scene scene =
      read(bar +
           "probes:\n  - {name: u, quantity: displacement, of: bar}\n  - {name: v, quantity: velocity, of: bar, component: y}\n"
           "  - {name: s, quantity: stress, of: bar, component: xz, take: largest}\n  - {name: p, quantity: pressure, of: bar}\n" +
           time);
  ASSERT_EQ(scene.probes.size(), 4U);
  EXPECT_EQ(scene.probes[0].component, "magnitude");
  EXPECT_EQ(scene.probes[1].component, "y");
  EXPECT_EQ(scene.probes[2].component, "xz");
  EXPECT_TRUE(scene.probes[2].largest);
  EXPECT_TRUE(scene.probes[3].component.empty());
  EXPECT_FALSE(scene.probes[3].largest);
}

TEST(ReadProbe, OfABodyMayNameAPlace) {
  const std::string probe = "probes:\n  - {name: p, quantity: strain, of: skin, component: xx, place: ";
  EXPECT_EQ(read("bodies:\n" + skin + probe + "top}\n" + time).probes[0].place, "top");
  EXPECT_TRUE(says(refusal("bodies:\n" + skin + probe + "inside}\n" + time), "'place' = inside"));
  const std::string placed = "probes:\n  - {name: p, quantity: velocity, of: skin, place: top}\n";
  EXPECT_TRUE(says(refusal("bodies:\n" + skin + placed + time), "unknown key 'place'"));
}

TEST(ReadStop, IsInTheDimensionOfItsProbe) {
  const std::string probes = bar + "probes:\n  - {name: u, quantity: displacement, of: bar, component: x}\n";
  const model::Scene scene = read(probes + "stop:\n  - {probe: u, below: -2 mm, after: 1 us}\n" + time);
  ASSERT_EQ(scene.stops.size(), 1U);
  EXPECT_EQ(scene.stops[0].probe, "u");
  EXPECT_FALSE(scene.stops[0].above);
  EXPECT_EQ(scene.stops[0].value, -2e-3);
  EXPECT_EQ(scene.stops[0].after, 1e-6);
  EXPECT_TRUE(says(refusal(probes + "stop:\n  - {probe: u, below: 1 N}\n" + time), "has the dimension"));
  EXPECT_TRUE(says(refusal(probes + "stop:\n  - {probe: w, below: 1 N}\n" + time), "'probe' = w is unknown: probes are u"));
}

TEST(ReadStop, HasOneConditionWithItsOwnKeys) {
  const std::string probes = bar + "probes:\n  - {name: u, quantity: displacement, of: bar, component: x}\n";
  const auto stop = [&](const std::string& what) { return probes + "stop:\n  - {" + what + "}\n" + time; };
  const model::Stop peak = read(stop("probe: u, peaked: {fallen: 0.1, for: 1 us}, after: 2 us")).stops[0];
  EXPECT_TRUE(peak.kind == model::StopKind::peak && peak.above);
  EXPECT_EQ(std::vector({peak.part, peak.span, peak.after}), std::vector({0.1, 1e-6, 2e-6}));
  EXPECT_FALSE(read(stop("probe: u, dipped: {for: 1 us}")).stops[0].above);
  const model::Stop steady = read(stop("probe: u, steady: {window: 100 us, within: 1 mm}")).stops[0];
  EXPECT_TRUE(steady.kind == model::StopKind::steady);
  EXPECT_EQ(std::vector({steady.span, steady.value}), std::vector({1e-4, 1e-3}));
  const model::Stop rest = read(stop("rest: {part: 1e-3, for: 1 us, of: scene}")).stops[0];
  EXPECT_TRUE(rest.kind == model::StopKind::rest && rest.of_scene && rest.probe.empty());
  EXPECT_EQ(std::vector({rest.part, rest.span}), std::vector({1e-3, 1e-6}));
  EXPECT_FALSE(read(stop("rest: {part: 1e-3, for: 1 us}")).stops[0].of_scene);

  EXPECT_TRUE(says(refusal(stop("probe: u, peaked: {for: 1 us}, rest: {part: 1e-3, for: 1 us}")), "are two conditions"));
  EXPECT_TRUE(says(refusal(stop("probe: u, peaked: {after: 1 us}")), "'peaked' needs 'fallen', 'for' or both"));
  EXPECT_TRUE(says(refusal(stop("probe: u, peaked: {fallen: 1.5}")), "out of range"));
  EXPECT_TRUE(says(refusal(stop("probe: u, steady: {window: 100 us, within: 1 N}")), "has the dimension"));
  EXPECT_TRUE(says(refusal(stop("probe: u, steady: {window: 0.001 us, within: 1 mm}")), "is shorter than two rows of the history"));
  EXPECT_TRUE(says(refusal(stop("rest: {part: 1e-3}")), "missing 'for'"));
  EXPECT_TRUE(says(refusal(stop("probe: w, steady: {window: 1 ms, within: 1 mm}")), "'probe' = w is unknown: probes are u"));
}

TEST(Kinds, ThatAreUnknownOrMissingAreTheOnlyFault) {
  const std::string load = "loads:\n  - {name: pull, nodes: bar, value: [\"1\", \"0\", \"0\"], unit: N";
  const std::string driven = "planes:\n  - {name: end, nodes: [bar], velocity: {value: [\"t\", \"0\", \"0\"], unit: m/s}";
  const std::string probe = "probes:\n  - {name: p, of: bar, component: xz, take: largest";
  for (const std::string& text : {load, load + ", kind: forse", driven, driven + ", kind: drivn", driven + ", kind: held",
                                  probe, probe + ", quantity: stres"}) {
    const std::string said = refusal(bar + text + "}\n" + time);
    EXPECT_TRUE(says(said, "\n1 fault in")) << said;
  }
  const std::string stop = refusal(bar + probe + "}\nstop:\n  - {probe: p, above: 1 Pa}\n" + time);
  EXPECT_TRUE(says(stop, "missing 'quantity'") && says(stop, "\n1 fault in")) << stop;
}

TEST(ReadSceneAtRest, LeavesOutWhatBelongsToARun) {
  const std::string text =
      bar +
      "planes: [{name: end, kind: fixed, nodes: [bar.x_low]}]\npoint_masses: [{name: m, nodes: bar.x_high, mass: 1 kg}]\n"
      "loads: [{name: push, kind: pressure, surface: bar.x_high, value: \"1\", unit: Pa}]\n"
      "probes: [{name: tip, quantity: displacement, of: bar.x_high, component: x}]\nstop: [{probe: tip, above: 1 m}]\n"
      "gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]\nrelaxation: {}\ninitial: [{body: bar, velocity: [\"1\", \"0\", \"0\"], unit: m/s}]\n";
  for (const std::string& with : {text, text + time}) {
    const CaseFile file = CaseFile::parse(with, "case.yaml");
    const model::Scene scene = read_scene_at_rest(file.root());
    file.finish();
    EXPECT_EQ(scene.bodies.size(), 1U);
    EXPECT_EQ(scene.planes.size(), 1U);
    EXPECT_EQ(scene.point_masses.size(), 1U);
    EXPECT_TRUE(scene.loads.empty() && scene.initial.empty() && scene.probes.empty() && scene.stops.empty());
    EXPECT_TRUE(scene.gravity.isZero(0));
    EXPECT_FALSE(scene.relaxation);
    std::string not_used;
    for (const std::string& one : file.not_used()) not_used += one + "\n";
    for (const char* key : {"gravity", "loads", "probes", "stop", "relaxation", "initial"})
      EXPECT_TRUE(says(not_used, key)) << key << " in\n" << not_used;
  }
}

}  // namespace
}  // namespace nereid::input::scene_readers_test
