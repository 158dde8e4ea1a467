#include "input/retired.hpp"

#include <gtest/gtest.h>

#include "input/section.hpp"

namespace nereid::input::retired_test {
namespace {

TEST(Renamed, NamesTheNewWordWhereTheOldOneStood) {
  EXPECT_EQ(renamed("contacts[3]", "hardness"), "it is called 'penalty_scale' now; scripts/update_case rewrites old case files");
  EXPECT_NE(renamed("contact", "damping").find("'damping_ratio'"), std::string::npos);
  EXPECT_NE(renamed("planes[12]", "kind", "held").find("'constrained'"), std::string::npos);
}

TEST(Renamed, LeavesWordsAloneElsewhere) {
  EXPECT_EQ(renamed("springs[0]", "damping"), "");
  EXPECT_EQ(renamed("contacts[0]", "penalty_scale"), "");
  EXPECT_EQ(renamed("planes[0]", "kind", "fixed"), "");
  EXPECT_EQ(renamed("planes[0]", "held"), "");
}

std::string fault_of(const std::string& text, const std::function<void(const Section&)>& read) {
  const auto file = CaseFile::parse(text, "case.yaml");
  read(file.root());
  try {
    file.finish();
  } catch (const CaseError& error) {
    return error.faults.at(0).message + " | " + error.faults.at(0).hint;
  }
  return "";
}

TEST(Renamed, IsTheHintOfTheFault) {
  EXPECT_EQ(fault_of("contact: {hardness: 20}\n", [](const Section& root) { root.section("contact").number_or("penalty_scale", 20); }),
            "unknown key 'hardness' in 'contact' | it is called 'penalty_scale' now; scripts/update_case rewrites old case files");
  const std::string kind = fault_of("planes:\n  - {kind: held}\n", [](const Section& root) {
    for (const Section& plane : root.list("planes")) plane.choice("kind", {"constrained", "fixed"});
  });
  EXPECT_NE(kind.find("it is called 'constrained' now"), std::string::npos) << kind;
}

}  // namespace
}  // namespace nereid::input::retired_test
