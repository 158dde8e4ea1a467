#include "input/readers.hpp"

#include <gtest/gtest.h>

namespace nereid::input::readers_test {
namespace {

/// What a reader makes of a text, with all faults.
template <class Read>
auto read(const std::string& text, Read&& reader, bool finish = true) {
  const CaseFile file = CaseFile::parse(text, "case.yaml");
  auto result = reader(file.root());
  if (finish) file.finish();
  return result;
}

TEST(ReadLaw, TakesTableTwoAsPrintedIntoSI) {
  const auto law = read("kind: j2_bilinear\ndensity: 1.13e-9 kgf*s^2/mm^4\nyoung: 19.5 kgf/mm^2\npoisson: 0.42\n"
                        "yield: 3.02 kgf/mm^2\ntangent: 1.85 kgf/mm^2\n", read_law);
  const auto& lead = std::get<material::J2Bilinear>(law);
  EXPECT_NEAR(lead.density, 11081.5, 0.1);
  EXPECT_NEAR(lead.young, 191.2297e6, 1e2);
  EXPECT_NEAR(lead.flow.tangent, 18.1423e6, 1e2);
}

TEST(ReadLaw, ListsWhatAnElasticLawDoesNotUse) {
  const CaseFile file = CaseFile::parse("kind: elastic\ndensity: 1 kg/m^3\nyoung: 1 Pa\npoisson: 0\nyield: 2 Pa\n", "case.yaml");
  EXPECT_TRUE(std::holds_alternative<material::Elastic>(read_law(file.root())));
  file.finish();
  ASSERT_EQ(file.not_used().size(), 1U);
  EXPECT_EQ(file.not_used()[0].rfind("yield", 0), 0U);
}

TEST(ReadLaw, RefusesATangentAboveYoung) {
  EXPECT_THROW(read("kind: j2_bilinear\ndensity: 1 kg/m^3\nyoung: 1 Pa\npoisson: 0\nyield: 2 Pa\ntangent: 2 Pa\n", read_law), CaseError);
}

const std::string steel = "kind: j2_bilinear\ndensity: 1 kg/m^3\nyoung: 4 Pa\npoisson: 0\nyield: 1 Pa\ntangent: 2 Pa\n";

TEST(ReadLaw, HardensIsotropicallyUnlessToldOtherwise) {
  EXPECT_TRUE(std::holds_alternative<material::J2Bilinear>(read(steel, read_law)));
  EXPECT_TRUE(std::holds_alternative<material::J2Bilinear>(read(steel + "hardening: isotropic\n", read_law)));
  const auto kinematic = read(steel + "hardening: kinematic\n", read_law);
  EXPECT_EQ(std::get<material::J2Mixed>(kinematic).isotropic, 0.0);
  EXPECT_EQ(std::get<material::J2Mixed>(kinematic).tangent, 2.0);
  const auto mixed = read(steel + "hardening: mixed\nisotropic_share: 0.25\n", read_law);
  EXPECT_EQ(std::get<material::J2Mixed>(mixed).isotropic, 0.25);
}

TEST(ReadLaw, WantsTheShareOfMixedHardeningAndOfNoOther) {
  EXPECT_THROW(read(steel + "hardening: mixed\n", read_law), CaseError);
  EXPECT_THROW(read(steel + "hardening: mixed\nisotropic_share: 1.5\n", read_law), CaseError);
  const CaseFile file = CaseFile::parse(steel + "hardening: kinematic\nisotropic_share: 0.5\n", "case.yaml");
  EXPECT_EQ(std::get<material::J2Mixed>(read_law(file.root())).isotropic, 0.0);
  file.finish();
  ASSERT_EQ(file.not_used().size(), 1U);
  EXPECT_EQ(file.not_used()[0].rfind("isotropic_share", 0), 0U);
}

const std::string hot_steel =
    "kind: johnson_cook\ndensity: 7830 kg/m^3\nyoung: 200 GPa\npoisson: 0.29\nyield: 792 MPa\nhardening_coefficient: 510 MPa\n"
    "hardening_exponent: 0.26\nrate_coefficient: 0.014\nthermal_exponent: 1.03\nreference_temperature: 293 K\n"
    "melting_temperature: 1793 K\nspecific_heat: 477 J/(kg*K)\n";

TEST(ReadLaw, ReadsJohnsonAndCookWithTheirUnits) {
  const auto law = std::get<material::J2JohnsonCook>(read(hot_steel + "reference_rate: 1 1/ms\n", read_law));
  EXPECT_EQ(law.young, 200e9);
  EXPECT_EQ(law.flow.yield, 792e6);
  EXPECT_EQ(law.flow.specific_heat, 477);
  EXPECT_EQ(law.flow.reference_rate, 1000);
  EXPECT_EQ(law.flow.heat_share, 0.9);
  EXPECT_EQ(law.flow.temperature, 293) << "that of reference unless told otherwise";
  EXPECT_EQ(std::get<material::J2JohnsonCook>(read(hot_steel + "temperature: 500 K\n", read_law)).flow.temperature, 500);
}

TEST(ReadLaw, KeepsTheConstantsOfAnotherKindUnused) {
  std::string cold = hot_steel;
  cold.replace(cold.find("johnson_cook"), 12, "elastic");
  const CaseFile file = CaseFile::parse(cold, "case.yaml");
  EXPECT_TRUE(std::holds_alternative<material::Elastic>(read_law(file.root())));
  file.finish();
  EXPECT_EQ(file.not_used().size(), 8U);
}

TEST(ReadLaw, RefusesAMeltingTemperatureBelowThatOfReference) {
  std::string cold = hot_steel;
  cold.replace(cold.find("1793 K"), 6, "200 K");
  EXPECT_THROW(read(cold, read_law), CaseError);
}

TEST(ReadLaw, RefusesTheConstantOfTwoThatWasSet) {
  const CaseFile file = CaseFile::parse(hot_steel, "case.yaml", {"reference_temperature=2000 K"});
  read_law(file.root());
  try {
    file.finish();
    FAIL();
  } catch (const CaseError& error) {
    ASSERT_EQ(error.faults.size(), 1U);
    EXPECT_EQ(error.faults[0].source, "--set reference_temperature=2000 K");
  }
}

TEST(ReadPlateLaw, RefusesALawThatPlatesMayNotHaveAndNamesThoseTheyMay) {
  EXPECT_TRUE(std::holds_alternative<material::J2Bilinear>(read(steel, read_plate_law)));
  try {
    read("kind: neo_hookean\ndensity: 1 kg/m^3\nyoung: 4 Pa\npoisson: 0\n", read_plate_law);
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what()).find("elastic, j2_bilinear, j2_curve or johnson_cook"), std::string::npos) << error.what();
  }
}

element::AnyHexahedronOptions hexahedron(const Section& section) { return read_hexahedron_options(section); }

TEST(ReadPlateLaw, HasOneFaultWhereThePlatesMayNotHaveTheLaw) {
  try {
    read("kind: neo_hookean\ndensity: 1 kg/m^3\nyoung: 4 Pa\npoisson: 0\n", read_plate_law);
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_EQ(error.faults.size(), 1U) << error.what();
  }
}

TEST(ReadHexahedron, HasOnePointAndAssumedStrainsUnlessToldOtherwise) {
  using element::FullHexahedron;
  using element::Hexahedron;
  const auto usual = std::get<Hexahedron::Options>(read("{}\n", hexahedron));
  EXPECT_EQ(usual.hourglass_kind, Hexahedron::Hourglass::assumed_strain);
  EXPECT_EQ(usual.hourglass, 1);
  const auto springs = std::get<Hexahedron::Options>(read("hourglass_kind: stiffness\n", hexahedron));
  EXPECT_EQ(springs.hourglass_kind, Hexahedron::Hourglass::stiffness);
  EXPECT_EQ(springs.hourglass, Hexahedron::usual_stiffness);
  const auto viscous = std::get<Hexahedron::Options>(read("kind: one_point\nhourglass_kind: viscous\n", hexahedron));
  EXPECT_EQ(viscous.hourglass_kind, Hexahedron::Hourglass::viscous);
  EXPECT_EQ(viscous.hourglass, Hexahedron::usual_viscous);
  EXPECT_EQ(std::get<Hexahedron::Options>(read("hourglass_kind: viscous\nhourglass: 0.2\n", hexahedron)).hourglass, 0.2);
  EXPECT_EQ(read("hourglass_kind: viscous\n", read_one_point_options).hourglass_kind, Hexahedron::Hourglass::viscous);
  const auto full = std::get<FullHexahedron::Options>(read("kind: full\nviscosity: {linear: 0.1}\n", hexahedron));
  EXPECT_EQ(full.viscosity.linear, 0.1);
  EXPECT_THROW(read("kind: eight\n", hexahedron), CaseError);
  EXPECT_THROW(read("hourglass_kind: none\n", hexahedron), CaseError);
}

TEST(ReadHexahedron, WithEightPointsListsWhatOnePointWouldUse) {
  const CaseFile file = CaseFile::parse("kind: full\nhourglass: 0.1\nhourglass_kind: viscous\nviscosity: {linear: 0.1}\n", "case.yaml");
  read_hexahedron_options(file.root());
  file.finish();
  EXPECT_EQ(file.not_used().size(), 2U);
  EXPECT_THROW(read("kind: full\nhourglass: 2\n", hexahedron), CaseError);
}

TEST(ReadInterface, LetsTheCodeChooseUnlessAPenaltyIsGiven) {
  EXPECT_EQ(read("method: penalty\npenalty_scale: 5\n", read_interface).penalty_scale, 5);
  EXPECT_FALSE(read("method: penalty\npenalty_scale: 5\n", read_interface).penalty.has_value());
  EXPECT_EQ(read("method: penalty\npenalty: 5e13 Pa/m\n", read_interface).penalty, 5e13);
}

TEST(ReadInterface, DefaultsToTheBetterForms) {
  const auto options = read("clearance: 0.5 mm\n", read_interface);
  EXPECT_EQ(options.method, contact::Method::multiplier);
  EXPECT_EQ(options.restitution, 1);
  EXPECT_EQ(options.weights, contact::Weights::consistent);
  EXPECT_EQ(options.area, contact::Area::apex);
  EXPECT_EQ(options.damping_ratio, 0);
  EXPECT_EQ(options.kind, contact::InterfaceKind::contact);
  EXPECT_EQ(options.friction.coefficient, 0);
  EXPECT_EQ(options.heights, contact::Heights::points);
  EXPECT_TRUE(options.two_passes);  // of which the second guards
  EXPECT_TRUE(options.height.from_initial_height);
  EXPECT_DOUBLE_EQ(options.height.clearance, 5e-4);
}

TEST(ReadInterface, HeightsAreThoseOfNodesWherePointsHaveNoMeaning) {
  for (const char* text : {"heights: nodes\n", "passes: two\n", "kind: tied\n", "method: penalty\n", "kind: tied\nmethod: penalty\n"})
    EXPECT_EQ(read(text, read_interface).heights, contact::Heights::nodes) << text;
  EXPECT_FALSE(read("heights: nodes\n", read_interface).two_passes);
  EXPECT_EQ(read("friction: 0.1\n", read_automatic_interface).heights, contact::Heights::points);
  EXPECT_EQ(read("method: penalty\n", read_automatic_interface).heights, contact::Heights::nodes);
}

TEST(ReadInterface, BondsHaveAMethodToo) {
  EXPECT_EQ(read("kind: tied\n", read_interface).method, contact::Method::multiplier);
  EXPECT_EQ(read("kind: tied\nmethod: penalty\npenalty_scale: 5\n", read_interface).penalty_scale, 5);
  EXPECT_EQ(read("kind: tied\nmethod: penalty\npenalty_scale: 5\n", read_interface).method, contact::Method::penalty);
}

TEST(ReadInterface, WantsBothOfKineticFrictionAndItsDecay) {
  const auto options = read("friction: 0.4\nkinetic_friction: 0.3\nfriction_decay: 20 ms/m\n", read_interface);
  EXPECT_EQ(options.friction.kinetic, 0.3);
  EXPECT_DOUBLE_EQ(options.friction.decay, 0.02);
  EXPECT_EQ(read("friction: 0.4\n", read_interface).friction.decay, 0);
  EXPECT_THROW(read("friction: 0.4\nkinetic_friction: 0.3\n", read_interface), CaseError);
  EXPECT_THROW(read("friction: 0.4\nfriction_decay: 1 s/m\n", read_interface), CaseError);
}

TEST(ReadRecording, GivesFourHundredRowsByDefaultAndLeavesFramesToTheRun) {
  const model::Recording recording = read("precision: double\nfields: all\n", [](const Section& s) { return read_recording(s, 8e-3); });
  EXPECT_DOUBLE_EQ(recording.history, 2e-5);
  EXPECT_EQ(recording.frames, 0);
  EXPECT_TRUE(recording.full_precision && recording.all_fields);
}

TEST(ReadRecording, TakesNoFrameWithoutARow) {
  const auto read_it = [](const Section& s) { return read_recording(s, 8e-3); };
  EXPECT_DOUBLE_EQ(read("frames_every: 1 us\n", read_it).history, 1e-6);
  EXPECT_DOUBLE_EQ(read("frames_every: 1 ms\n", read_it).history, 2e-5);
  EXPECT_DOUBLE_EQ(read("{frames_every: 1 us, history_every: 1 us}\n", read_it).frames, 1e-6);
  EXPECT_THROW(read("{frames_every: 1 us, history_every: 2 us}\n", read_it), CaseError);
}

}  // namespace
}  // namespace nereid::input::readers_test
