#include "model/notes.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "dynamics/quality.hpp"
#include "model/remedies.hpp"
#include "tests/model/scenes.hpp"

namespace nereid::model::notes_test {
namespace {

TEST(BodyTable, HasNodesElementsAndMassOfBodiesAndOfTheirRegions) {
  mesh::Mesh given = mesh::box("", {Vec3(0, 0, 0), Vec3(2, 1, 1), {2, 1, 1}});
  const Table<8> nodes = given.hexahedra[0].nodes;
  given.hexahedra = {{".region_1", nodes.col(0)}, {".region_2", nodes.col(1)}};
  Body rigid = wall();
  rigid.rigid = true, rigid.given.mass = 5, rigid.place.move = Vec3(9, 0, 0);
  const std::vector<std::string> table = body_table(build(with({{.name = "two", .mesh = given, .law = steel}, sheet(), rigid})));
  ASSERT_EQ(table.size(), 6U);
  const auto numbers = [](const std::string& line) {
    std::istringstream stream(line);
    std::string name, rest, all;
    stream >> name;
    for (all = name; stream >> rest;) all += " " + rest;
    return all;
  };
  EXPECT_EQ(numbers(table[0]), "bodies nodes elements mass [kg]");
  EXPECT_EQ(numbers(table[1]), "two 12 2 16000");
  EXPECT_EQ(numbers(table[2]), ".region_1 8 1 8000");
  EXPECT_EQ(numbers(table[3]), ".region_2 8 1 8000");
  EXPECT_EQ(numbers(table[4]), "sheet 6 4 32");
  EXPECT_EQ(numbers(table[5]), "wall 12 2 5");
}

TEST(GapTable, HasTwoLinesForEachInterface) {
  Scene scene = with({bar(), wall()});
  EXPECT_TRUE(gap_table(build(scene)).empty());
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  ASSERT_EQ(gap_table(build(scene)).size(), 3U);
  EXPECT_TRUE(says(gap_table(build(scene))[2], "pairs"));
  scene.contacts[0].interface.edges = false;
  ASSERT_EQ(gap_table(build(scene)).size(), 2U);
  scene.contacts[0].interface.method = contact::Method::penalty;
  const auto table = gap_table(build(scene));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_TRUE(says(table[1], "touch"));
  EXPECT_TRUE(says(table[2], "penalty"));
}

TEST(GapTable, LeavesOutApexesBehindTheBaseAndSaysHowMany) {
  Scene scene = with({bar(), wall()});
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_high"}};  // which faces away from the bar
  scene.contacts[0].interface.edges = false;
  const Simulation simulation = build(scene);
  EXPECT_EQ(simulation.gaps[0].behind, 4);
  EXPECT_EQ(simulation.gaps[0].least, 0);
  const auto table = gap_table(simulation);
  ASSERT_EQ(table.size(), 3U);
  EXPECT_TRUE(says(table[1], "  0  -            -            -")) << table[1];
  EXPECT_TRUE(says(table[2], "4 of 4 apexes are behind the base and not in contact, as below a table")) << table[2];
}

TEST(GapTable, ListsTheFreeApexesOfABond) {
  Scene scene = with({bar(), wall()});
  scene.bodies[1].place.move = Vec3(0, 0.5, 0);  // half of the face has nothing to be tied to
  scene.contacts = {{.name = "glue", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.contacts[0].interface.kind = contact::InterfaceKind::tied;
  const auto table = gap_table(build(scene));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_TRUE(says(table[2], "2 of 4 apexes are free")) << table[2];
  scene.contacts[0].interface.method = contact::Method::penalty;
  EXPECT_EQ(gap_table(build(scene)).size(), 4U);
  scene.contacts[0].interface.two_passes = true;
  EXPECT_EQ(gap_table(build(scene)).size(), 7U);
  scene.contacts[0].interface.method = contact::Method::multiplier;
  EXPECT_TRUE(says(refusal(scene), "contact 'glue': a tie by multipliers has one pass")) << refusal(scene);
  scene.contacts[0].interface.two_passes = false;
  scene.contacts[0].interface.slides = true, scene.contacts[0].interface.method = contact::Method::penalty;
  EXPECT_TRUE(says(refusal(scene), "contact 'glue': only a tie by multipliers slides")) << refusal(scene);
  scene.contacts[0].interface.slides = false, scene.contacts[0].interface.method = contact::Method::multiplier;
  scene.bodies[1].place.move = Vec3(0, 1.5, 0);
  EXPECT_TRUE(says(refusal(scene), "contact 'glue': 0 of the 4 apexes of 'bar.x_high' are over 'wall.x_low'")) << refusal(scene);
}

TEST(WidthNotes, SayWhatANarrowElementCosts) {
  Scene scene = with({bar()});
  EXPECT_TRUE(width_notes(build(scene)).empty());
  scene.bodies[0].mesh = mesh::Box{Vec3(0, 0, 0), Vec3(2, 1, 1), {200, 1, 1}};
  ASSERT_EQ(width_notes(build(scene)).size(), 1U);
  scene.bodies.push_back(wall());
  EXPECT_EQ(width_notes(build(scene)).size(), 1U);
  scene.bodies[1].mesh = mesh::Box{Vec3(3, 0, 0), Vec3(3.01, 0.01, 0.01), {4, 4, 4}};
  EXPECT_TRUE(width_notes(build(scene)).empty()) << "the other body sets the step";
  scene.bodies[1].rigid = true;
  EXPECT_EQ(width_notes(build(scene)).size(), 1U) << "whose elements limit nothing";
  scene.bodies[0].rigid = true;
  EXPECT_TRUE(width_notes(build(scene)).empty());
}

TEST(CoarsenessNotes, SayThatApexesAreTooFarApartAndWhatToDo) {
  Scene scene = with({bar(), wall()});
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  const auto cells = [&scene](std::size_t body, int y, int z) {
    const double at = body == 0 ? 0 : 2;
    scene.bodies[body].mesh = mesh::Box{Vec3(at, 0, 0), Vec3(at + 2, 1, 1), {2, y, z}};
  };
  const auto notes = [&scene] { return coarseness_notes(build(scene)); };
  EXPECT_TRUE(notes().empty());
  cells(0, 5, 5), cells(1, 6, 6);
  EXPECT_TRUE(notes().empty());
  cells(0, 4, 4), cells(1, 6, 5);
  ASSERT_EQ(notes().size(), 1U);
  EXPECT_TRUE(says(notes()[0], "touch: its apexes are 1.5 times as far apart as the nodes of its base")) << notes()[0];
  EXPECT_TRUE(says(notes()[0], "exchange 'apexes' and 'base', or take 'passes: two'")) << notes()[0];
  scene.contacts[0].interface.kind = contact::InterfaceKind::tied;
  EXPECT_EQ(notes().size(), 1U) << "nodes between the apexes of a tie are free as well";
  cells(1, 6, 2);  // coarser the other way
  ASSERT_EQ(notes().size(), 1U);
  EXPECT_TRUE(says(notes()[0], "refine the surface of the apexes")) << notes()[0];
  scene.contacts[0].interface.kind = contact::InterfaceKind::contact;
  EXPECT_TRUE(says(notes()[0], "150 %: take 'passes: two'")) << notes()[0];
  scene.contacts[0].interface.two_passes = true;
  EXPECT_TRUE(notes().empty());
  scene.contacts[0].interface.two_passes = false;
  scene.planes = {{.name = "held", .kind = load::PlaneKind::fixed, .nodes = {"wall"}}};
  EXPECT_TRUE(notes().empty()) << "a base that is held gives way nowhere";
  scene.planes = {};
  EXPECT_EQ(notes().size(), 1U);
  scene.bodies[1].rigid = true;
  EXPECT_TRUE(notes().empty()) << "nor does a rigid one";
  scene.bodies[1].rigid = false;
  ASSERT_EQ(notes().size(), 1U);
  scene.bodies[0].law = material::LinearFluid{1000, 2e9}, scene.bodies[0].solid = element::Fluid::Options{};
  EXPECT_TRUE(notes().empty()) << "a fluid presses evenly";
}

TEST(RoundingNotes, SayThatASceneLiesFarFromTheOrigin) {
  Scene scene = with({bar()});
  scene.bodies[0].place.move = Vec3(0, 1000, 0);
  EXPECT_TRUE(rounding_notes(build(scene)).empty());
  scene.bodies[0].place.move = Vec3(0, 1e5, 0);
  const auto notes = rounding_notes(build(scene));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(says(notes[0], "bar: this far from the origin, positions are rounded by 1.1e-11 m, 1.1e-11 of an element")) << notes[0];
}

TEST(DepthNotes, SayThatARigidPlaneWasPenetratedTooDeep) {
  Scene scene = with({bar()});
  scene.rigid_planes = {{.name = "ground", .surface = "bar.z_low", .method = contact::Method::penalty, .penalty = 1e6}};
  scene.initial = {{.body = "bar", .value = uniform(Vec3(0, 0, -1000))}};
  Simulation simulation = build(scene);
  EXPECT_TRUE(depth_notes(simulation).empty());
  run(simulation);
  const auto notes = depth_notes(simulation);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(says(notes[0], "ground: node ")) << notes[0];
  EXPECT_TRUE(says(notes[0], said(Remedy::firmer_contact))) << notes[0];
}

TEST(DepthNotes, NameNoMultipliersForATieThatMayHaveNone) {
  for (const bool rigid : {false, true}) {
    Scene scene = with({bar(), wall()});
    scene.contacts = {{.name = "glue", .apexes = "bar.x_high", .base = "wall.x_low"}};
    scene.contacts[0].interface.kind = contact::InterfaceKind::tied;
    scene.contacts[0].interface.method = contact::Method::penalty;
    scene.bodies[1].rigid = rigid;
    Simulation simulation = build(scene);
    auto& memory = std::get<contact::Memory>(simulation.state.contacts[0]);
    memory.deepest = memory.deepest_in = 1;
    const auto notes = depth_notes(simulation);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(says(notes[0], said(Remedy::firmer_contact)), !rigid) << notes[0];
  }
}

TEST(OverlapNotes, SayWhichBodiesOverlapAndThatNoContactIsDeclared) {
  Scene scene = with({bar(), wall()});
  scene.bodies[1].place.move = Vec3(-0.2, 0.1, 0);
  Simulation simulation = build(scene);
  EXPECT_TRUE(overlap_notes(simulation).empty()) << "nothing has looked yet";
  EXPECT_TRUE(good(run(simulation).ending)) << "what overlaps from the start does not stop a run";
  const auto notes = overlap_notes(simulation);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(says(notes[0], "bar and wall overlap by 0.2 m, 0.2 of an element") || says(notes[0], "wall and bar overlap by 0.2 m"))
      << notes[0];
  EXPECT_TRUE(says(notes[0], ", and by 0.2 m at the start; no contact between them is declared")) << notes[0];
}

TEST(GapTable, ListsOverlapsOfRoundOffSizeThatAreTakenAsContact) {
  for (const bool automatic : {false, true}) {
    Scene scene = with({bar(), wall()});
    scene.bodies[1].mesh = mesh::Box{Vec3(2, -1, -1), Vec3(4, 2, 2), {2, 2, 2}};  // automatic contact has no corners on corners
    scene.bodies[1].place.move = Vec3(-1e-8, 0, 0);
    if (automatic) scene.automatic_contacts = {{.name = "all"}};
    else scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
    const std::vector<std::string> table = gap_table(build(scene));
    const std::string expected = std::string(automatic ? "bar and wall: 5" : "touch: 4") +
                                 " apexes overlap at the start, by 1e-08 m at most, less than 1e-06 of an element: taken as contact";
    const auto is_it = [&](const std::string& row) { return says(row, expected); };
    EXPECT_EQ(std::count_if(table.begin(), table.end(), is_it), 1) << (table.empty() ? "" : table.back());
  }
}

TEST(OverlapNotes, SayNothingOfWhatTheCaseAccepts) {
  Scene scene = with({bar(), wall()});
  scene.bodies[1].place.move = Vec3(-0.2, 0.1, 0);
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.contacts[0].interface.initial_penetration = contact::InitialPenetration::accept;
  Simulation simulation = build(scene);
  run(simulation);
  EXPECT_NEAR(audit::worst(simulation.state.audit)->at_start, 0.2, 1e-9);
  EXPECT_TRUE(overlap_notes(simulation).empty());
}

TEST(QualityNotes, SayWhichPlatesAreNoLongerAsThickAsTheyShouldBe) {
  Simulation simulation = build(with({sheet()}));
  run(simulation);
  EXPECT_TRUE(quality_notes(simulation).empty());
  simulation.state.quality[0].thinned = {0.96, 2};
  EXPECT_TRUE(quality_notes(simulation).empty());
  simulation.state.quality[0].thinned = {0.8, 2};
  const auto notes = quality_notes(simulation);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(says(notes[0], "sheet: plates keep their thickness, but with the strain of element 2 it would be 0.8 of the initial one"))
      << notes[0];
}

TEST(QualityNotes, SayWhichPlatesHaveNodesThatSpin) {
  Simulation simulation = build(with({sheet()}));
  run(simulation);
  simulation.state.ledger.initial_available = simulation.state.ledger.initial_kinetic = 1;
  simulation.state.quality[0].spin = {.energy = 0.009, .node = 5, .time = 1e-3};
  EXPECT_TRUE(quality_notes(simulation).empty());
  simulation.state.quality[0].spin.energy = 0.1;
  const auto notes = quality_notes(simulation);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(says(notes[0], "sheet: the spin of nodes about their normals, fastest at node 5, had 0.1 of the energy of the scene at"))
      << notes[0];
}

TEST(QualityNotes, SayWhereDistortionControlHoldsTooMuchAndWhereALawInRatesIsPressedTooFar) {
  Simulation simulation = build(with({bar()}));
  run(simulation);
  simulation.state.ledger.initial_available = simulation.state.ledger.initial_kinetic = 1;
  dynamics::Quality& seen = simulation.state.quality[0];
  seen.internal = 0.5, seen.distortion = 0.004, seen.pressed = {0.49, 1};
  EXPECT_TRUE(quality_notes(simulation).empty());
  seen.distortion = 0.01, seen.pressed = {0.6, 1}, seen.pressed_at = 2e-3;
  const auto notes = quality_notes(simulation);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_TRUE(says(notes[0], "bar: the energy of distortion control reached 0.02 of the internal energy (limit 0.01)")) << notes[0];
  EXPECT_TRUE(says(notes[1], "bar: element 1 was pressed by 0.6 of Young's modulus at 0.002 s")) << notes[1];
}

TEST(QualityNotes, SayWhichCornerIsInverted) {
  Simulation simulation = build(with({bar()}));
  run(simulation);
  EXPECT_TRUE(quality_notes(simulation).empty());
  simulation.state.ledger.initial_available = simulation.state.ledger.initial_kinetic = 1;
  dynamics::Quality& seen = simulation.state.quality[0];
  seen = {}, seen.corner = -0.25, seen.element = 3, seen.time = 1e-3, seen.hourglass = 0.3, seen.internal = 0.5;
  const auto notes = quality_notes(simulation);
  ASSERT_EQ(notes.size(), 1U) << "a beam of one layer bends as it should";
  EXPECT_TRUE(says(notes[0], "bar: a corner of element 3 was inverted, its Jacobian -0.25 of the reference at 0.001 s")) << notes[0];
}

TEST(QualityNotes, SayHowMuchEnergySpringsHold) {
  Scene scene = with({bar()});
  element::Hexahedron::Options springs;
  springs.hourglass = 0.1, springs.hourglass_kind = element::Hexahedron::Hourglass::stiffness;
  scene.bodies[0].solid = springs;
  Simulation simulation = build(scene);
  run(simulation);
  simulation.state.ledger.initial_available = simulation.state.ledger.initial_kinetic = 1;
  simulation.state.quality[0] = {}, simulation.state.quality[0].hourglass = 0.3, simulation.state.quality[0].internal = 0.5;
  const auto notes = quality_notes(simulation);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(says(notes[0], "bar: hourglass energy reached 0.6 of the internal energy: 'hourglass_kind: assumed_strain'")) << notes[0];
  simulation.state.quality[0].contrast = {2, 0.6, 0.2}, simulation.state.progress.contrast_looks = 2;
  EXPECT_TRUE(mesh_notes(simulation).empty()) << "the warning says more";
  simulation.state.quality[0].hourglass = 0.04;
  EXPECT_TRUE(quality_notes(simulation).empty());
  EXPECT_EQ(mesh_notes(simulation).size(), 1U);
}

/// A bar after a run, as if it had been seen so. contrast  [J] sums of two looks
Simulation seen_so(const element::Contrast& contrast, double plastic = 0) {
  Simulation simulation = build(with({bar()}));
  run(simulation);
  dynamics::State& now = simulation.state;
  now.ledger.initial_available = now.ledger.initial_kinetic = 1;
  now.quality[0] = {}, now.quality[0].contrast = contrast, now.progress.contrast_looks = 2;
  now.ledger.accounts[0].dissipated[Dissipated::plastic] = plastic;
  return simulation;
}

TEST(MeshNotes, SayWhatTheRunCannotTell) {
  EXPECT_TRUE(mesh_notes(seen_so({2, 0.01, 0.2})).empty());
  const auto bends = mesh_notes(seen_so({2, 0.6, 0.2}));
  ASSERT_EQ(bends.size(), 1U);
  EXPECT_TRUE(says(bends[0], "bar: hourglass energy above that of the neighbours is 0.3 of the strain energy")) << bends[0];
  EXPECT_TRUE(says(bends[0], said(Remedy::estimate_error))) << bends[0];
}

TEST(MeshNotes, AreNoneWhereAWarningSaysMore) {
  const Simulation simulation = seen_so({2, 0.6, 1.5}, 0.1);
  EXPECT_TRUE(mesh_notes(simulation).empty());
  const auto warnings = mesh_warnings(simulation);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(says(warnings[0], "bar: bodies of the scene deform plastically, and 0.75 of the strain energy of all solids")) << warnings[0];
  EXPECT_TRUE(says(warnings[0], said(Remedy::finer_mesh))) << warnings[0];
  EXPECT_TRUE(quality_notes(simulation).empty());
  EXPECT_TRUE(mesh_warnings(seen_so({2, 0.6, 0.2}, 0.1)).empty()) << "a note is no warning";
  EXPECT_TRUE(mesh_warnings(seen_so({2, 0.6, 1.5})).empty()) << "what elastic bodies concentrate they give back";
}

TEST(MeshNotes, OfAForceOnANodeNameThat) {
  Simulation simulation = seen_so({2, 0.6, 1.5});  // no need to flow
  simulation.model.loads.push_back(load::NodalForce{.name = "prick", .nodes = {0}, .force = {}});
  ASSERT_EQ(mesh_warnings(simulation).size(), 1U);
  EXPECT_TRUE(says(mesh_warnings(simulation)[0], said(Remedy::spread_force)));
}

TEST(MeshNotes, SayWhereRestitutionGivesBackWhatFlowTakes) {
  Scene scene = with({bar(), wall()});
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  for (const double restitution : {1.0, 0.0}) {
    scene.contacts[0].interface.restitution = restitution;
    Simulation simulation = build(scene);
    run(simulation);
    simulation.state.ledger.initial_available = simulation.state.ledger.initial_kinetic = 1;
    simulation.state.quality[0] = {}, simulation.state.quality[1] = {};
    std::vector<dynamics::Flow>& flows = simulation.state.ledger.flows;
    for (std::size_t s = 0; s < flows.size(); ++s) flows[s].passed = dynamics::sources(simulation.model)[s].name == "touch" ? 1 : 0;
    EXPECT_TRUE(mesh_notes(simulation).empty()) << "nothing flows";
    simulation.state.ledger.accounts[0].dissipated[Dissipated::plastic] = 0.3;
    const auto notes = mesh_notes(simulation);
    ASSERT_EQ(notes.size(), restitution > 0 ? 1U : 0U);
    if (restitution > 0) {
      EXPECT_TRUE(says(notes[0], "touch: bodies of the scene deform plastically, and 'restitution' returns")) << notes[0];
    }
    for (dynamics::Flow& flow : flows) flow.passed = 0;
    EXPECT_TRUE(mesh_notes(simulation).empty()) << "it was never touched";
  }
}

TEST(MeshNotes, SayThatNoMeasureOfPlatesIsKnown) {
  Simulation simulation = build(with({sheet()}));
  run(simulation);
  simulation.state.ledger.initial_available = simulation.state.ledger.initial_kinetic = 1;
  dynamics::Quality& seen = simulation.state.quality[0];
  seen.internal = 0.5, seen.artificial = 0.06;
  const auto notes = mesh_notes(simulation);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(says(notes[0], "sheet (artificial modes 0.12 of its internal energy): one run cannot estimate the error")) << notes[0];
  seen.internal = 1e-3;
  EXPECT_TRUE(mesh_notes(simulation).empty()) << "it holds next to nothing";
}

TEST(MeshNotes, SayWhichProbesFollowTheMesh) {
  Scene scene = with({bar(), wall()});
  scene.bodies[0].law = material::J2Bilinear{8000, 2e11, 0.3, {2e8, 1e9}};
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.probes = {{.name = "push", .quantity = "force", .of = "touch"},
                  {.name = "most", .quantity = "plastic_strain", .of = "bar", .largest = true},
                  {.name = "mean", .quantity = "plastic_strain", .of = "bar"}};
  Scene of_eight = scene;
  of_eight.bodies[0].solid = element::FullHexahedron::Options{};
  EXPECT_EQ(build(of_eight).probes[1].follows_mesh, dynamics::FollowsMesh::yes) << "'full' has been taken";
  Simulation simulation = build(scene);
  EXPECT_EQ(simulation.probes[0].footing, 0);
  EXPECT_EQ(simulation.probes[1].follows_mesh, dynamics::FollowsMesh::less_with_eight_points);
  EXPECT_EQ(simulation.probes[2].follows_mesh, dynamics::FollowsMesh::no);
  run(simulation);
  simulation.state.probes.resize(3), simulation.state.probes[1].largest = 0.01;
  const auto shows = [](double what) { return [what](const dynamics::View&, dynamics::Kept&) { return what; }; };
  ASSERT_TRUE(simulation.probes[1].mean);
  simulation.probes[1].value = shows(0.01), simulation.probes[1].mean = shows(0.005);
  simulation.state.quality[0] = {}, simulation.state.quality[1] = {};
  simulation.state.footings = {{.force = 1, .nodes = 2.5}};
  auto notes = mesh_notes(simulation);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_TRUE(says(notes[0], "push: the largest force of this contact acted on 2.5 nodes (fewer than 4)")) << notes[0];
  EXPECT_TRUE(says(notes[1], "most: the largest plastic strain depends on the mesh")) << notes[1];
  EXPECT_TRUE(says(notes[1], said(Remedy::eight_points))) << notes[1];
  simulation.state.footings[0].nodes = 4;
  EXPECT_EQ(mesh_notes(simulation).size(), 1U);
  simulation.probes[1].follows_mesh = dynamics::FollowsMesh::yes;
  EXPECT_TRUE(says(mesh_notes(simulation)[0], said(Remedy::estimate_error)));
  simulation.probes[1].mean = shows(0.0099);
  EXPECT_TRUE(mesh_notes(simulation).empty()) << "an even field";
  simulation.probes[1].mean = shows(0.005);
  simulation.state.probes[1].largest = 0;
  EXPECT_TRUE(mesh_notes(simulation).empty()) << "nothing has flowed";
  simulation.state.ledger.accounts[0].dissipated[Dissipated::viscous] = 0.11, simulation.state.ledger.initial_available = 1;
  notes = mesh_notes(simulation);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(says(notes[0], "the viscosity of shocks dissipated 0.11 of the energy")) << notes[0];
}

/// A strip 1 m long and 10 mm thick, clamped, with a force at its other end, after a swing to one side; cells along it.
double artificial_part_of_a_strip(int cells) {
  Scene scene = with({{.name = "strip", .mesh = mesh::Sheet{1, 0.1, cells, 1, mesh::Cuts::columns}, .law = steel}});
  scene.bodies[0].plate.thickness = 10e-3;
  scene.planes = {{.name = "clamp", .kind = load::PlaneKind::fixed, .nodes = {"strip.x_low"}}};
  scene.loads = {{.name = "push", .kind = LoadKind::force, .on = "strip.x_high",
                  .value = {[](double, double, double, double) { return 0.0; }, [](double, double, double, double) { return 0.0; },
                            [](double, double, double, double) { return 100.0; }}}};
  scene.time.end = 50e-3;
  Simulation simulation = build(scene);
  run(simulation);
  const dynamics::Quality& seen = simulation.state.quality[0];
  EXPECT_EQ(seen.hourglass, 0);
  return dynamics::of_internal(seen, seen.artificial, 0);
}

TEST(QualityNotes, OfAStripThatBendsFindMuchInACoarseMeshAndLittleInAFineOne) {
  // a constant shear q has the moments q x: the part that is within long narrow elements is (h/L)^2/12 of all
  const double coarse = artificial_part_of_a_strip(1), fine = artificial_part_of_a_strip(8);
  EXPECT_GT(coarse, 1.0 / 24);
  EXPECT_LT(fine, 1.0 / 12 / 64 * 4);
}

TEST(EnergyNotes, NameTheSourceThatMadeEnergyAndWhatItIsHeldAgainst) {
  Simulation simulation = build(with({bar()}));
  run(simulation);
  EXPECT_TRUE(energy_notes(simulation).empty());
  simulation.state.ledger.initial_available = simulation.state.ledger.initial_kinetic = 1;
  simulation.state.ledger.flows[0].told = {-0.02, -2e-3, 0.1};
  simulation.state.ledger.worst_kept = 0.016;
  const auto notes = energy_notes(simulation);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(notes[0], "bar: lost 2 % of the energy that it transferred, 0.002 J of 0.1 J, which is 0.2 % of the energy of the scene, at "
                      "worst; a run stops at 25 %");
  EXPECT_EQ(notes[1], "time integration: created 1.6 % of the energy of the scene, 1 J, at worst; a run stops at 5 %");
  simulation.state.ledger.flows[0].told = {0.004, 4e-4, 0.1}, simulation.state.ledger.worst_kept = 0;
  EXPECT_TRUE(energy_notes(simulation).empty());  // below a fifth of the limit
  simulation.state.ledger.initial_available = simulation.state.ledger.initial_kinetic = 1;
  simulation.state.ledger.most_integration = 0.06;
  for (const double kept : {0.0, 0.009}) {
    simulation.state.ledger.worst_kept = kept;
    ASSERT_EQ(energy_notes(simulation).size(), 1U);
    EXPECT_TRUE(says(energy_notes(simulation)[0],
                     "time integration: the staggering error of the kinetic energy reached 6 % of the energy of the scene, 1 J"));
  }
  simulation.state.ledger.worst_kept = 0, simulation.state.ledger.most_integration = 0.04;
  EXPECT_TRUE(energy_notes(simulation).empty());  // it comes back, and the histories tell it
}

TEST(EnergyNotes, SayThatBodiesWhichDoNotTouchHaveNotGotBackWhatContactTook) {
  Scene scene = with({bar(), wall()});
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  Simulation simulation = build(scene);
  dynamics::State& state = simulation.state;
  state.ledger.initial_available = state.ledger.initial_kinetic = 1;
  const std::vector<Source> all = dynamics::sources(simulation.model);
  for (std::size_t s = 0; s < all.size(); ++s)
    if (all[s].name == "touch") state.ledger.flows[s].passed = 0.5;
  ASSERT_FALSE(std::get<contact::Memory>(state.contacts[0]).near.empty());
  contact::Near& near = std::get<contact::Memory>(state.contacts[0]).near[0];
  double& held = std::get<contact::Memory>(state.contacts[0]).restitution[static_cast<std::size_t>(near.apex)].held;
  held = 0.1;
  const auto notes = energy_notes(simulation);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "touch: its bodies do not touch at the end, and the contact still holds 0.1 J of the 0.5 J that it transferred, "
                      "20 %: they separate too slowly");
  near.element.closed = true;  // it may still do so
  EXPECT_TRUE(energy_notes(simulation).empty());
  near.element.closed = false, held = 0.004;  // below a hundredth
  EXPECT_TRUE(energy_notes(simulation).empty());
}

TEST(EnergyLine, BalancesWhatWasThereWithWhereItIs) {
  Simulation simulation = build(with({bar()}));
  dynamics::Ledger& ledger = simulation.state.ledger;
  Account bar, load;
  bar.work = -6, bar.at_start[Stored::elastic] = 0.5, bar.stored[Stored::elastic] = 3, bar.dissipated[Dissipated::plastic] = 2;
  load.work = 1, load.stored[Stored::external_work] = -1;
  ledger.accounts = {bar, load};
  ledger.initial_kinetic = 10, ledger.kinetic = 5.5, ledger.integration = 0.5;
  EXPECT_EQ(energy_line(simulation),
            "energy: 10.5 J at the start and 1 J of external work became 5.5 J kinetic, 3.5 J stored, 2 J dissipated; created -1 J, "
            "time integration 0.5 J");
}

TEST(CountElements, SumsOverAllBlocks) { EXPECT_EQ(count_elements(build(with({bar(), sheet()})).model), 6); }

TEST(CurveNotes, TellOfAPlasticStrainBeyondTheLastPointOfAMeasuredCurve) {
  const auto notes_of = [](double last) {
    Scene scene = with({bar()});
    material::J2Curve law{8000, 200e9, 0.25, {}};
    law.flow.kind = material::HardeningCurve::Kind::measured;
    law.flow.curves = {{0, {0, last}, {1e8, 1.1e8}}};
    scene.bodies[0].law = law;
    scene.initial = {{.body = "bar", .displacement = true,
                      .value = {[](double x, double, double, double) { return 0.05 * x; }, constant(0), constant(0)}}};
    scene.time.end = 1e-7;
    Simulation simulation = build(scene);
    run(simulation);
    return curve_notes(simulation);
  };
  ASSERT_EQ(notes_of(0.01).size(), 1U);
  EXPECT_TRUE(says(notes_of(0.01)[0], "and the hardening curve ends at 0.01")) << notes_of(0.01)[0];
  EXPECT_TRUE(notes_of(0.1).empty());
}

}  // namespace
}  // namespace nereid::model::notes_test
