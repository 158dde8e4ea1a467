#include "output/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "base/check.hpp"

namespace nereid::output::summary_test {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder(const std::string& name) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();  // tests run side by side
  const fs::path folder = fs::path(testing::TempDir()) / ("nereid_summary_" + test + "_" + name);
  fs::remove_all(folder);
  return folder;
}

/// The summary without its white space, so that tests can speak of pieces of it.
std::string written(const Summary& summary) {
  const fs::path folder = fresh_folder("written");
  write_summary(folder, summary);
  EXPECT_FALSE(fs::exists(folder / "summary.json.tmp"));
  std::ifstream stream(folder / "summary.json");
  std::stringstream text;
  text << stream.rdbuf();
  EXPECT_EQ(text.str(), text_of(summary));
  std::string packed;
  bool word = false;
  for (const char c : text.str()) {
    if (c == '"') word = !word;
    if (word || (c != ' ' && c != '\n')) packed += c;
  }
  return packed;
}

#define EXPECT_HAS(text, piece) EXPECT_NE(text.find(piece), std::string::npos) << text

Summary example() {
  Summary summary;
  summary.driver = "two_blocks";
  summary.case_path = "cases/two_blocks.yaml";
  summary.case_hash = "abc";
  summary.ending = {"reached_end", "the end time was reached", 0.25, "", -1};
  summary.results = {{"settlement", 0.5, "m"}};
  summary.ledger.initial_available = summary.ledger.initial_kinetic = 8;
  summary.ledger.kinetic = 4;
  summary.ledger.momentum = Vec3(1, 2, 3);
  Account contact;
  contact.work = -4;
  contact.stored[Stored::penalty] = 1;
  contact.dissipated[Dissipated::friction] = 2;
  contact.impulse = Vec3(1, 2, 2.5), contact.angular_impulse = Vec3(0.5, 0, -1);
  summary.sources = {{"A_on_B", SourceKind::interface, {Stored::penalty}, {Dissipated::friction}}};
  summary.ledger.accounts = {contact};
  summary.overlaps = {{{"A", "B"}, {"A_on_B"}, 0.5, 0.25, 2, Vec3(1, 2, 3), 0.125}};
  summary.touched = {{.contact = "A_on_B", .sides = {"A", "B"}, .first = 0.0625, .last = 0.1875, .impulse = Vec3(4, 5, 6)}};
  summary.ledger.flows = {{.passed = 6, .work = -4, .recent = 0, .worst = -0.15}};
  summary.resolved = {{"contact.penalty", 5e11, "Pa/m", false},
                      {"contact.friction", 0.0, "1", true},
                      {"material", std::string("steel"), "", false},
                      {"material.density", 7850.0, "kg/m3", false},
                      {"planes[0].normal", std::vector<double>{0, 0, 1}, "1", false},
                      {"cells", std::int64_t{40}, "", false},
                      {"walk", true, "", true}};
  summary.not_used = {"contact.colour"};
  summary.notes = {"all is well"};
  return summary;
}

TEST(Summary, SaysHowTheRunEndedAndWhatItFound) {
  const std::string text = written(example());
  EXPECT_EQ(text.rfind(R"({"driver":"two_blocks","ending":{"word":"reached_end",)", 0), 0u) << text;
  EXPECT_HAS(text, R"("time":{"value":0.25,"unit":"s"},"block":null,"element":null})");
  EXPECT_HAS(text, R"("results":{"settlement":{"value":0.5,"unit":"m"}})");
  EXPECT_HAS(text, R"("overlaps":[{"bodies":["A","B"],"contacts":["A_on_B"],"deepest":{"value":0.5,"unit":"m"})");
  EXPECT_HAS(text, R"("place":{"value":[1.0,2.0,3.0],"unit":"m"},"time":{"value":0.125,"unit":"s"}})");
  EXPECT_HAS(text, R"("not_used":["contact.colour"],"notes":["all is well"],"warnings":[]})");
}

TEST(Summary, SaysOfEachPairWhenItTouchedFirstAndLastAndWhatItTransmitted) {
  EXPECT_HAS(written(example()), R"("touched":[{"contact":"A_on_B","sides":["A","B"],"first_touch":{"value":0.0625,"unit":"s"},)"
                                 R"("last_touch":{"value":0.1875,"unit":"s"},"impulse":{"value":[4.0,5.0,6.0],"unit":"N*s"}}])");
}

TEST(Summary, NamesTheElementThatEndedTheRun) {
  Summary summary = example();
  summary.ending = {"inverted_element", "volume below zero", 0.25, "cask", 0};
  EXPECT_HAS(written(summary), R"("block":"cask","element":0})");
}

TEST(Summary, LedgerCarriesEveryAccountWithUnits) {
  const std::string text = written(example());
  EXPECT_HAS(text, R"("initial_kinetic":{"value":8.0,"unit":"J"})");
  EXPECT_HAS(text, R"("energy_residual":{"value":0.0,"unit":"J"})");
  EXPECT_HAS(text, R"("momentum_residual":{"value":[0.0,0.0,0.5],"unit":"kg m/s"})");
  EXPECT_HAS(text, R"("accounts":{"A_on_B":{"kind":"interface","work":{"value":-4.0,"unit":"J"},)"
                   R"("stored":{"penalty":{"value":1.0,"unit":"J"}},)"
                   R"("dissipated":{"friction":{"value":2.0,"unit":"J"}},)"
                   R"("created":{"value":-1.0,"unit":"J"},)"
                   R"("created_relative":{"value":-0.125,"unit":"1"},)"
                   R"("passed":{"value":6.0,"unit":"J"},"created_of_passed":{"value":-0.15,"unit":"1"})");
  EXPECT_HAS(text, R"("impulse":{"value":[1.0,2.0,2.5],"unit":"N s"})");
  EXPECT_HAS(text, R"("angular_impulse":{"value":[0.5,0.0,-1.0],"unit":"N m s"})");
}

TEST(Summary, CreatedEnergyIsRelativeToNothingWhenNothingMoved) {
  Summary summary = example();
  summary.ledger.initial_available = summary.ledger.initial_kinetic = 0;
  EXPECT_HAS(written(summary), R"("created_relative":{"value":null,"unit":"1"})");
  summary.ledger.external_work = 4;
  EXPECT_HAS(written(summary), R"("created_relative":{"value":-0.25,"unit":"1"})");
}

TEST(Summary, ResolvedValuesNestByPath) {
  const std::string text = written(example());
  EXPECT_HAS(text, R"("contact":{"penalty":{"value":500000000000.0,"unit":"Pa/m","default":false},)"
                   R"("friction":{"value":0.0,"unit":"1","default":true}})");
  EXPECT_HAS(text, R"("material":{"value":"steel","unit":null,"default":false,)"
                   R"("density":{"value":7850.0,"unit":"kg/m3","default":false}})");
  EXPECT_HAS(text, R"("planes":[{"normal":{"value":[0.0,0.0,1.0],"unit":"1","default":false}}])");
  EXPECT_HAS(text, R"("cells":{"value":40,"unit":null,"default":false})");
  EXPECT_HAS(text, R"("walk":{"value":true,"unit":null,"default":true})");
}

TEST(Summary, NotANumberIsNull) {
  Summary summary = example();
  summary.results = {{"peak", std::nan(""), "Pa"}, {"rate", INFINITY, "1/s"}};
  EXPECT_HAS(written(summary), R"("results":{"peak":{"value":null,"unit":"Pa"},)"
                               R"("rate":{"value":null,"unit":"1/s"}})");
}

TEST(Summary, EmptySummaryKeepsItsShape) {
  const std::string text = written({});
  EXPECT_HAS(text, R"("results":{},)");
  EXPECT_HAS(text, R"("accounts":{}})");
  EXPECT_HAS(text, R"("resolved":{}})");
  EXPECT_HAS(text, R"("not_used":[],"notes":[],"warnings":[]})");
}

TEST(Summary, NamesThatComeTwiceAreRefused) {
  Summary twice = example();
  twice.results.push_back(twice.results[0]);
  EXPECT_THROW(write_summary(fresh_folder("twice"), twice), InternalError);
  twice = example();
  twice.resolved.push_back(twice.resolved[0]);
  EXPECT_THROW(write_summary(fresh_folder("twice"), twice), InternalError);
  twice = example();
  twice.resolved.push_back({"contact[0]", 1.0, "", false});
  EXPECT_THROW(write_summary(fresh_folder("twice"), twice), InternalError);
}

TEST(Summary, BytesThatAreNoTextDoNotCostTheSummary) {
  Summary summary = example();
  summary.case_path = "\xff.yaml";
  EXPECT_HAS(written(summary), "\"case_path\":\"\xef\xbf\xbd.yaml\"");
}

TEST(Summary, FolderThatCannotBeMadeIsTheMachinesFault) {
  EXPECT_THROW(write_summary("/proc/nowhere", example()), MachineError);
}

TEST(Provenance, SaysWhatWasBuiltAndWhereItRuns) {
  const Provenance from = provenance();
  for (const std::string& text :
       {from.version, from.commit, from.compiler, from.flags, from.build_type, from.processor})
    EXPECT_FALSE(text.empty());
}

}  // namespace
}  // namespace nereid::output::summary_test
