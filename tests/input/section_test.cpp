#include "input/section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "base/words.hpp"

namespace nereid::input::section_test {
namespace {

using Reader = std::function<void(Section)>;
using Texts = std::vector<std::string>;

/// All that is reported about a case, or "" if it is in order.
std::string report(const std::string& text, const Reader& reader, const Texts& overrides = {}) {
  try {
    auto file = CaseFile::parse(text, "case.yaml", overrides);
    reader(file.root());
    file.finish();
  } catch (const CaseError& error) {
    return error.what();
  }
  return {};
}

/// The only message there is, without place and source line.
std::string message(const std::string& text, const Reader& reader, const Texts& overrides = {}) {
  try {
    auto file = CaseFile::parse(text, "case.yaml", overrides);
    reader(file.root());
    file.finish();
  } catch (const CaseError& error) {
    EXPECT_EQ(error.faults.size(), 1U) << error.what();
    return error.faults[0].message;
  }
  return {};
}

void read_nothing(Section) {}

/// Reads key `x` as each reader function would.
Reader length_of_x(Range range = any) {
  return [range](Section root) { root.quantity("x", dim::length, range); };
}
void number_x(Section root) { root.number("x"); }
void count_x(Section root) { root.count("x"); }
void flag_x(Section root) { root.flag("x"); }
void word_x(Section root) { root.word("x"); }

// ---- what is right

TEST(Section, ReadsEveryKindOfValue) {
  auto file = CaseFile::parse(R"(
title: "Bars: two of them"
symmetric: true
domain: quarter
cells: [20, 4, 5]
origin: [1 mm, -2 cm, 0.5 m]
axis: [0, 0, 1]
output: [stress, slip]
every: [1 ms, 2 ms]
material:
  density: 1.13e-9 kgf*s^2/mm^4   # as printed
  poisson: 0
  layers: 3
)",
                              "case.yaml");
  const Section root = file.root();
  EXPECT_EQ(root.word("title"), "Bars: two of them");
  EXPECT_TRUE(root.flag("symmetric"));
  EXPECT_EQ(root.choice("domain", {"full", "quarter"}), "quarter");
  EXPECT_EQ(root.counts("cells"), (std::array<int, 3>{20, 4, 5}));
  EXPECT_EQ(root.vector("origin", dim::length), (std::array<double, 3>{0.001, -0.02, 0.5}));
  EXPECT_EQ(root.vector("axis", dim::none), (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(root.words("output"), (Texts{"stress", "slip"}));
  EXPECT_EQ(root.quantities("every", dim::time, positive), (std::vector<double>{0.001, 0.002}));
  const Section material = root.section("material");
  EXPECT_EQ(material.path(), "material");
  EXPECT_DOUBLE_EQ(material.quantity("density", dim::density, positive), 11081.5145);
  EXPECT_EQ(material.number("poisson", above(-1).below(0.5)), 0);
  EXPECT_EQ(material.count("layers"), 3);
  EXPECT_TRUE(root.sound());
  EXPECT_NO_THROW(file.finish());
  EXPECT_TRUE(file.not_used().empty());
}

TEST(Section, DefaultsStandInForAbsentKeys) {
  auto file = CaseFile::parse("title: x\n", "case.yaml");
  const Section root = file.root();
  EXPECT_TRUE(root.has("title"));
  EXPECT_FALSE(root.has("name"));
  EXPECT_EQ(root.word("title"), "x");
  EXPECT_EQ(root.quantity_or("gap", 0.5, dim::length), 0.5);
  EXPECT_EQ(root.number_or("safety", 0.9), 0.9);
  EXPECT_EQ(root.count_or("cells", 7), 7);
  EXPECT_TRUE(root.flag_or("symmetric", true));
  EXPECT_EQ(root.word_or("name", "bars"), "bars");
  EXPECT_EQ(root.choice_or("domain", "full", {"full", "half"}), "full");
  EXPECT_EQ(root.vector_or("axis", {0, 0, 1}, dim::none), (std::array<double, 3>{0, 0, 1}));
  EXPECT_TRUE(root.quantities("stops", dim::time, any, 0).empty());
  EXPECT_TRUE(root.words("probes", 0).empty());
  EXPECT_TRUE(root.list("bodies").empty());
  EXPECT_EQ(root.section_or_empty("time").number_or("safety", 0.5), 0.5);
  EXPECT_NO_THROW(file.finish());
}

TEST(Section, ListsAreSectionsInOrder) {
  auto file = CaseFile::parse("bodies:\n  - name: A\n  - {name: B}\nplanes: []\n", "case.yaml");
  const auto bodies = file.root().list("bodies", 1);
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].word("name"), "A");
  EXPECT_EQ(bodies[1].word("name"), "B");
  EXPECT_EQ(bodies[1].path(), "bodies[1]");
  EXPECT_TRUE(file.root().list("planes").empty());
  EXPECT_NO_THROW(file.finish());
}

TEST(Section, KeysAreNamesThatTheUserGives) {
  auto file = CaseFile::parse("laws:\n  steel: {n: 1}\n  lead: {n: 2}\n", "case.yaml");
  const Section laws = file.root().section("laws");
  EXPECT_EQ(laws.keys(), (Texts{"steel", "lead"}));
  EXPECT_THROW(file.finish(), CaseError);
  for (const auto& name : laws.keys()) laws.section(name).count("n");
  EXPECT_NO_THROW(file.finish());
}

TEST(Section, AliasesRepeatTheirAnchor) {
  auto file = CaseFile::parse("a: &steel {young: 210 GPa}\nb: *steel\nc: &n 3 mm\nd: *n\n", "c");
  const Section root = file.root();
  EXPECT_EQ(root.section("a").quantity("young", dim::stress), 210e9);
  EXPECT_EQ(root.section("b").quantity("young", dim::stress), 210e9);
  EXPECT_EQ(root.quantity("c", dim::length), root.quantity("d", dim::length));
  EXPECT_NO_THROW(file.finish());
}

// ---- faults as they are shown

constexpr const char* broken = R"(driver: two_blocks
title:  Two steel blocks collide face to face
blocks:
  gap:    0.1

material:
  # as delivered
  density: 7.85e3 Pa
  young:   210 GPa
  poisson: 0.5

contact:
  penality: 5.0e13 Pa/m
)";

void read_broken(Section root) {
  root.word("driver");
  root.word("title");
  root.section("blocks").quantity("gap", dim::length, not_negative);
  const Section material = root.section("material");
  material.quantity("density", dim::density, positive);
  material.quantity("young", dim::stress, positive);
  material.number("poisson", at_least(0).below(0.5));
  root.section("contact").quantity("penalty", dim::penalty, positive);
}

TEST(Faults, AreAllReportedAtOnceInOrderOfPlace) {
  EXPECT_EQ(
      report(broken, read_broken),
      R"(case.yaml:4:11: 'gap' = 0.1 has no unit: expected one of dimension [m], for example 'm'
    4 |   gap:    0.1
      |           ^~~
case.yaml:8:12: 'density' = 7.85e3 Pa has the dimension [kg m^-1 s^-2]: expected [kg m^-3], for example 'kg/m^3'
    8 |   density: 7.85e3 Pa
      |            ^~~~~~~~~
case.yaml:10:12: 'poisson' = 0.5 is out of range: expected 0 <= poisson < 0.5
   10 |   poisson: 0.5
      |            ^~~
case.yaml:13:3: missing 'penalty' [kg m^-2 s^-2] in 'contact'
   13 |   penality: 5.0e13 Pa/m
      |   ^
case.yaml:13:3: unknown key 'penality' in 'contact'
   13 |   penality: 5.0e13 Pa/m
      |   ^~~~~~~~  did you mean 'penalty'?
5 faults in case.yaml)");
}

TEST(Faults, CarryTheirPlaceForPrograms) {
  try {
    auto file = CaseFile::parse(broken, "case.yaml");
    read_broken(file.root());
    EXPECT_FALSE(file.root().sound());
    file.finish();
    FAIL();
  } catch (const CaseError& error) {
    ASSERT_EQ(error.faults.size(), 5U);
    EXPECT_EQ(error.path, "case.yaml");
    EXPECT_EQ(error.faults[4].source, "case.yaml");
    EXPECT_EQ(error.faults[4].line, 13);
    EXPECT_EQ(error.faults[4].column, 3);
    EXPECT_EQ(error.faults[4].message, "unknown key 'penality' in 'contact'");
    EXPECT_EQ(error.faults[4].hint, "did you mean 'penalty'?");
  }
}

TEST(Faults, PointIntoTheValueWhereTheUnitIsWrong) {
  EXPECT_EQ(report("x: 210 Gm\n", length_of_x()),
            R"(case.yaml:1:8: cannot read 'x' = 210 Gm: unknown unit 'Gm'
    1 | x: 210 Gm
      |        ^~
1 fault in case.yaml)");
}

TEST(Faults, CountColumnsInCharactersAndKeepTabs) {
  EXPECT_EQ(report("{\"\xC3\xA9\xC3\xA9\": a,\tx: 1 s}\n",
                   [](Section root) {
                     root.word("\xC3\xA9\xC3\xA9");
                     root.quantity("x", dim::length);
                   }),
            "case.yaml:1:14: 'x' = 1 s has the dimension [s]: expected [m], for example 'm'\n"
            "    1 | {\"\xC3\xA9\xC3\xA9\": a,\tx: 1 s}\n"
            "      |          \t   ^~~\n"
            "1 fault in case.yaml");
}

TEST(Faults, AreTheSameWithWindowsLinesAndByteOrderMark) {
  EXPECT_EQ(report("\xEF\xBB\xBFx: 1\r\ny: 2 s\r\n",
                   [](Section root) {
                     root.number("x");
                     root.quantity("y", dim::length);
                   }),
            R"(case.yaml:2:4: 'y' = 2 s has the dimension [s]: expected [m], for example 'm'
    2 | y: 2 s
      |    ^~~
1 fault in case.yaml)");
}

TEST(Faults, OfValuesReadTwiceAreReportedOnce) {
  EXPECT_EQ(message("x: 1\n",
                    [](Section root) {
                      root.quantity("x", dim::length);
                      root.quantity("x", dim::length);
                    }),
            "'x' = 1 has no unit: expected one of dimension [m], for example 'm'");
}

TEST(Faults, NameMissingKeysAtTheirSection) {
  EXPECT_EQ(report("time:\n  end: 1 s\n",
                   [](Section root) {
                     root.section("time").quantity("end", dim::time);
                     root.section("time").number("safety");
                     root.section("contact").quantity("penalty", dim::penalty);
                     root.word("title");
                   }),
            R"(case.yaml:1:1: missing section 'contact'
    1 | time:
      | ^
case.yaml:1:1: missing 'title'
    1 | time:
      | ^
case.yaml:2:3: missing 'safety' in 'time'
    2 |   end: 1 s
      |   ^
3 faults in case.yaml)");
}

TEST(Faults, OfAMissingSectionDoNotMultiply) {
  EXPECT_EQ(message("x: 1\n",
                    [](Section root) {
                      root.number("x");
                      const Section lost = root.section("contact").section("penalty");
                      EXPECT_EQ(lost.choice("kind", {"given", "automatic"}), "given");
                      lost.when(true).quantity("value", dim::penalty, positive);
                      lost.list("faces", 1);
                      lost.fault("value", "is odd");
                      EXPECT_TRUE(lost.keys().empty());
                    }),
            "missing section 'contact'");
}

TEST(Faults, LeaveValuesWithWhichReadingGoesOn) {
  auto file = CaseFile::parse("a: x\nb: 3\nc: 99\nd: maybe\ne: [1]\nf: 5 m\n", "case.yaml");
  const Section root = file.root();
  EXPECT_GT(root.quantity("a", dim::length, positive), 0);
  EXPECT_TRUE(between(2, 2.5).contains(root.number("b", between(2, 2.5))));
  EXPECT_EQ(root.count("c", 1, 9), 1);
  EXPECT_EQ(root.choice("d", {"yes", "no"}), "yes");
  for (const double value : root.vector("e", dim::none)) EXPECT_TRUE(std::isfinite(value));
  EXPECT_EQ(root.quantity_or("f", 0.25, dim::time), 0.25);
}

TEST(Faults, SuggestTheNearestKeyOrListTheKnownOnes) {
  const Reader reader = [](Section root) {
    root.number_or("young", 1);
    root.number_or("poisson", 0);
  };
  EXPECT_NE(report("Young: 2\n", reader).find("^~~~~  did you mean 'young'?"), std::string::npos);
  EXPECT_NE(report("posison: 2\n", reader).find("did you mean 'poisson'?"), std::string::npos);
  EXPECT_NE(report("colour: 2\n", reader).find("^~~~~~  known here: young, poisson"),
            std::string::npos);
  EXPECT_NE(report("young: 2\nyuong: 2\n", reader).find("did you mean 'young'?"),
            std::string::npos);
}

TEST(Faults, NameBothLinesOfARepeatedKey) {
  EXPECT_EQ(report("bodies:\n  - young: 1\n    poisson: 0\n    young: 2\n",
                   [](Section root) {
                     for (const auto& body : root.list("bodies")) {
                       body.number("young");
                       body.number("poisson");
                     }
                   }),
            R"(case.yaml:4:5: repeated key 'young' in 'bodies[0]': first given in line 2
    4 |     young: 2
      |     ^~~~~
1 fault in case.yaml)");
}

TEST(Faults, NameTheRange) {
  const auto out = [](const std::string& value, Range range) {
    return message("x: " + value + "\n", length_of_x(range));
  };
  EXPECT_EQ(out("0 m", positive), "'x' = 0 m is out of range: expected x > 0");
  EXPECT_EQ(out("-3 mm", not_negative), "'x' = -3 mm is out of range: expected x >= 0");
  EXPECT_EQ(out("3 m", up_to(2)), "'x' = 3 m is out of range: expected x <= 2 m");
  EXPECT_EQ(out("2 m", below(2)), "'x' = 2 m is out of range: expected x < 2 m");
  EXPECT_EQ(out("2 m", between(0, 2)), "'x' = 2 m is out of range: expected 0 < x < 2 m");
  EXPECT_EQ(out("1 mm", within(0.25, 2)),
            "'x' = 1 mm is out of range: expected 0.25 m <= x <= 2 m");
  EXPECT_EQ(out("2 m", within(0.25, 2)), "");
  EXPECT_EQ(message("x: 0.5\n", [](Section root) { root.number("x", between(-1, 0.5)); }),
            "'x' = 0.5 is out of range: expected -1 < x < 0.5");
}

// ---- values

TEST(Values, PlainNumbersMustNotHaveAUnitAndOthersMust) {
  EXPECT_EQ(message("x: 0\n", length_of_x()),
            "'x' = 0 has no unit: expected one of dimension [m], for example 'm'");
  EXPECT_EQ(message("x: 1 mm/m\n", number_x), "'x' = 1 mm/m has a unit: expected a plain number");
  EXPECT_EQ(message("x: 30\n", [](Section root) { root.quantity("x", dim::angle); }),
            "'x' = 30 has no unit: expected one of dimension [rad], for example 'rad'");
}

TEST(Values, NumbersAreNotGuessed) {
  EXPECT_EQ(message("x: \"2.5\"\n", number_x),
            "'x' is a quoted text: write the number without quotes");
  EXPECT_EQ(message("x: '2'\n", count_x), "'x' is a quoted text: write the number without quotes");
  EXPECT_EQ(message("x: 1,5\n", number_x),
            "cannot read 'x' = 1,5: unexpected ',', the decimal sign is a point");
  EXPECT_EQ(message("x: 010\n", number_x),
            "cannot read 'x' = 010: a leading zero could mean an octal number");
  EXPECT_EQ(message("x: 1e400\n", number_x),
            "cannot read 'x' = 1e400: double precision cannot hold this number");
  EXPECT_EQ(message("x: .nan\n", number_x), "cannot read 'x' = .nan: a finite number is needed");
  EXPECT_EQ(message("x: -.inf\n", number_x), "cannot read 'x' = -.inf: a finite number is needed");
  EXPECT_EQ(message("x: 0.3x\n", [](Section root) { root.number_or("x", 0.1); }),
            "cannot read 'x' = 0.3x: unknown unit 'x'");
}

TEST(Values, WholeNumbersAreWhole) {
  EXPECT_EQ(message("x: 3.7\n", count_x), "'x' = 3.7 is not a whole number");
  EXPECT_EQ(message("x: 1e3\n", count_x), "'x' = 1e3 is not a whole number");
  EXPECT_EQ(message("x: true\n", count_x), "'x' = true is not a whole number");
  EXPECT_EQ(message("x: 0x10\n", count_x), "'x' = 0x10 is not a whole number");
  EXPECT_EQ(message("x: 010\n", count_x),
            "'x' = 010 has a leading zero, which could mean an octal number");
  EXPECT_EQ(message("x: 0\n", count_x), "'x' = 0 is out of range: expected x >= 1");
  EXPECT_EQ(message("x: 99999999999\n", count_x),
            "'x' = 99999999999 is out of range: expected a number of at most nine digits");
  EXPECT_EQ(message("x: -99999999999\n", count_x), "'x' = -99999999999 is out of range: expected x >= 1");
  EXPECT_EQ(message("x: 5\n", [](Section root) { root.count("x", -1, 4); }),
            "'x' = 5 is out of range: expected -1 <= x <= 4");
  EXPECT_EQ(message("x: +4\n", [](Section root) { EXPECT_EQ(root.count("x"), 4); }), "");
}

TEST(Values, FlagsAreTrueOrFalse) {
  for (const char* text : {"yes", "on", "Y", "TRUE", "1", "no"}) {
    EXPECT_EQ(message(std::string("x: ") + text + "\n", flag_x),
              std::string("'x' = ") + text + " is unknown: expected true or false");
  }
  EXPECT_EQ(message("x: 'true'\n", flag_x), "'x' is a quoted text: expected true or false");
}

TEST(Values, WordsAreChosenFromTheirList) {
  EXPECT_EQ(report("domain: quater\n",
                   [](Section root) {
                     root.choice("domain", {"full", "quarter"});
                   }),
            R"(case.yaml:1:9: 'domain' = quater is unknown: expected one of full, quarter
    1 | domain: quater
      |         ^~~~~~  did you mean 'quarter'?
1 fault in case.yaml)");
  EXPECT_EQ(message("x: ''\n", word_x), "'x' is empty");
}

TEST(Values, ThatAreNotThereAreFaults) {
  EXPECT_EQ(report("x:\n# nothing\ny: 1\n",
                   [](Section root) {
                     root.quantity("x", dim::length);
                     root.number("y");
                   }),
            R"(case.yaml:1:1: 'x' has no value
    1 | x:
      | ^
1 fault in case.yaml)");
  EXPECT_EQ(message("x: ~\n", word_x), "'x' has no value");
  EXPECT_EQ(message("x: null\n", count_x), "'x' has no value");
}

TEST(Values, MustHaveTheShapeAskedFor) {
  EXPECT_EQ(message("x: [1, 2]\n", number_x), "'x' is a list: expected a single value");
  EXPECT_EQ(message("x: {a: 1}\n", number_x), "'x' is a section: expected a single value");
  EXPECT_EQ(message("x: 1\n", [](Section root) { root.section("x"); }),
            "'x' must be a section of keys");
  EXPECT_EQ(message("x: [1]\n", [](Section root) { root.section("x"); }),
            "'x' must be a section of keys");
  EXPECT_EQ(message("x: {a: 1}\n", [](Section root) { root.list("x"); }),
            "'x' is no list: expected a list of sections");
  EXPECT_EQ(message("x:\n", [](Section root) { root.list("x"); }),
            "'x' has no value: expected a list of sections, '[]' for none");
  EXPECT_EQ(message("x: [3]\n", [](Section root) { root.list("x"); }),
            "'x[0]' must be a section of keys");
  EXPECT_EQ(message("x: []\n", [](Section root) { root.list("x", 1); }),
            "'x' has 0 items: expected at least 1");
  EXPECT_EQ(message("x: [1, 2]\n", [](Section root) { root.vector("x", dim::none); }),
            "'x' has 2 values: expected 3");
  EXPECT_EQ(message("x: 1\n", [](Section root) { root.vector("x", dim::none); }),
            "'x' is no list: expected three values as in '[0, 0, 1]'");
}

TEST(Values, OfAListAreNamedByTheirPlace) {
  EXPECT_EQ(
      report("x: [1 m, 2, 3 mm]\n", [](Section root) { root.vector("x", dim::length); }),
      R"(case.yaml:1:10: 'x[1]' = 2 has no unit: expected one of dimension [m], for example 'm'
    1 | x: [1 m, 2, 3 mm]
      |          ^
1 fault in case.yaml)");
  EXPECT_EQ(message("x: [1, 0, 3]\n", [](Section root) { root.counts("x"); }),
            "'x[1]' = 0 is out of range: expected x[1] >= 1");
  EXPECT_EQ(
      message("x: [1 s, -1 s]\n", [](Section root) { root.quantities("x", dim::time, positive); }),
      "'x[1]' = -1 s is out of range: expected x[1] > 0");
  EXPECT_EQ(message("x: [a, [b]]\n", [](Section root) { root.words("x"); }),
            "'x[1]' is a list: expected a single value");
}

TEST(Values, MayBeCheckedByTheReader) {
  const Reader reader = [](Section root) {
    const double low = root.quantity("low", dim::length);
    const double high = root.quantity("high", dim::length);
    if (root.sound() && high < low) root.fault("high", "'high' must be above 'low'");
  };
  EXPECT_EQ(report("low: 2 m\nhigh: 1 m\n", reader), R"(case.yaml:2:7: 'high' must be above 'low'
    2 | high: 1 m
      |       ^~~
1 fault in case.yaml)");
  EXPECT_EQ(message("high: 1 m\n", reader), "missing 'low' [m]");
  EXPECT_EQ(message("x: 1\n",
                    [](Section root) {
                      root.number("x");
                      root.fault("y", "either 'y' or 'z' is needed");
                    }),
            "either 'y' or 'z' is needed");
  EXPECT_EQ(message("x: 1 m\n",
                    [](Section root) {
                      root.number("x");
                      root.fault("x", "not said twice");
                    }),
            "'x' = 1 m has a unit: expected a plain number");
}

// ---- sections and files

TEST(Sections, WithoutKeysAreFaults) {
  const Reader reader = [](Section root) { root.section("materials").number("x"); };
  EXPECT_EQ(report("materials:\n  # steel: ...\n", reader),
            R"(case.yaml:1:1: section 'materials' is empty
    1 | materials:
      | ^~~~~~~~~
1 fault in case.yaml)");
  EXPECT_EQ(message("materials: {}\n", reader), "section 'materials' is empty");
  EXPECT_EQ(message("time:\n", [](Section root) { root.section_or_empty("time"); }),
            "section 'time' is empty");
  EXPECT_EQ(message("x: 1\n",
                    [](Section root) {
                      root.number("x");
                      root.section_or_empty("time").quantity("end", dim::time);
                    }),
            "missing 'end' [s] in 'time'");
}

TEST(Sections, NeedABlankBehindTheColon) {
  EXPECT_EQ(report("x:\n  young:3\n", [](Section root) { root.section("x").number("young"); }),
            R"(case.yaml:2:3: 'x' must be a section of keys
    2 |   young:3
      |   ^~~~~~~  a blank is needed behind ':'
1 fault in case.yaml)");
  EXPECT_EQ(report("x: 1\ny:2\n", number_x), R"(case.yaml:2:1: unknown key 'y:2'
    2 | y:2
      | ^~~  a blank is needed behind ':'
1 fault in case.yaml)");
  EXPECT_EQ(report("x:1\n", number_x),
            R"(case.yaml:1:1: the case is not a map of keys: expected lines like 'key: value'
    1 | x:1
      | ^~~  a blank is needed behind ':'
1 fault in case.yaml)");
}

TEST(Files, ThatAreNoCaseAreRefused) {
  EXPECT_EQ(message("- a\n- b\n", read_nothing),
            "the case is not a map of keys: expected lines like 'key: value'");
  EXPECT_EQ(message("", read_nothing), "the case is empty");
  EXPECT_EQ(message("# only a comment\n", read_nothing), "the case is empty");
  EXPECT_EQ(message("---\n", read_nothing), "the case is empty");
  EXPECT_EQ(report("", read_nothing), "case.yaml:1:1: the case is empty\n1 fault in case.yaml");
}

TEST(Files, HoldOneDocument) {
  EXPECT_EQ(report("x: 1\n---\ny: 2\n", number_x),
            R"(case.yaml:2:1: a second document begins here: a case is one document
    2 | ---
      | ^~~
1 fault in case.yaml)");
  EXPECT_EQ(message("x: 1\n---\n", number_x),
            "a second document begins here: a case is one document");
  EXPECT_EQ(message("--- # the only one\nx: 1\n...\n", number_x), "");
}

TEST(Files, ThatAreNoYamlAreRefusedWithTheirPlace) {
  EXPECT_EQ(report("title: Bars: two\n", read_nothing),
            R"(case.yaml:1:12: cannot be read as YAML: illegal map value
    1 | title: Bars: two
      |            ^  a text with ': ' in it needs quotation marks
1 fault in case.yaml)");
  EXPECT_EQ(report("a:\n  b: 1\n c: 2\n", read_nothing),
            R"(case.yaml:3:2: cannot be read as YAML: end of map not found
    3 |  c: 2
      |  ^  keys of one section begin in the same column
1 fault in case.yaml)");
  EXPECT_EQ(report("a: {b: 1}}\n", read_nothing),
            R"(case.yaml:1:10: cannot be read as YAML: illegal flow end
    1 | a: {b: 1}}
      |          ^  are all brackets closed?
1 fault in case.yaml)");
  EXPECT_EQ(report("a:\n  b: [1\n", read_nothing),
            R"(case.yaml:2:8: cannot be read as YAML: end of sequence flow not found
    2 |   b: [1
      |        ^  are all brackets closed?
1 fault in case.yaml)");
  EXPECT_EQ(report("a:\n  b:1\n\n  c: 2\n", read_nothing),
            R"(case.yaml:4:4: cannot be read as YAML: illegal map value
    4 |   c: 2
      |    ^  a blank is needed behind ':' in line 2
1 fault in case.yaml)");
  EXPECT_EQ(report("a:\n\tb: 1\n", read_nothing),
            "case.yaml:2:1: a tab in the indentation: write blanks\n"
            "    2 | \tb: 1\n"
            "      | ^\n"
            "1 fault in case.yaml");
  EXPECT_EQ(message("x: 'open\ny: 1\n", read_nothing), "the quotation mark is not closed");
  EXPECT_EQ(message("? [1, 2]\n: 3\n", read_nothing), "a key must be a single word");
  EXPECT_EQ(message(": 3\n", read_nothing), "the key is missing");
  EXPECT_EQ(message("x: 1\xFF\n", read_nothing),
            "a byte in line 1, column 5 is neither UTF-8 text nor printable");
  EXPECT_EQ(message(std::string("x: 1\ny: \0", 9), read_nothing),
            "a byte in line 2, column 4 is neither UTF-8 text nor printable");
}

TEST(Files, DoNotUseWhatYamlWouldSilentlyLose) {
  EXPECT_EQ(message("a: &a {x: 1}\nb:\n  <<: *a\n  y: 2\n",
                    [](Section root) {
                      root.section("a").number("x");
                      root.section("b").number("y");
                    }),
            "the merge key '<<' is not read: write its keys out");
  EXPECT_EQ(message("x: !!float 3\n", number_x), "tags as in '!!float' are not read: remove it");
  EXPECT_EQ(message("a: &a {b: *a}\n", read_nothing), "the alias repeats itself without end");
  EXPECT_EQ(message("a: *b\n", read_nothing),
            "cannot be read as YAML: the referenced anchor is not defined");
}

TEST(Files, CannotFillTheMemoryWithAliases) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int level = 1; level < 12; ++level) {
    const std::string below = "*a" + std::to_string(level - 1);
    text += "a" + std::to_string(level) + ": &a" + std::to_string(level) + " [" + below;
    for (int item = 1; item < 10; ++item) text += ", " + below;
    text += "]\n";
  }
  EXPECT_EQ(message(text, read_nothing), "aliases repeat too many values");
}

TEST(Files, WithFaultsInAliasesPointToTheAlias) {
  EXPECT_EQ(report("a: &gap 3 mm\nb: *gap\n",
                   [](Section root) {
                     root.quantity("a", dim::length);
                     root.quantity("b", dim::time);
                   }),
            R"(case.yaml:2:4: 'b' = 3 mm has the dimension [m]: expected [s], for example 's'
    2 | b: *gap
      |    ^~~~
1 fault in case.yaml)");
}

TEST(Files, ThatCannotBeOpenedAreFaults) {
  const auto what = [](const std::string& path) -> std::string {
    try {
      CaseFile::read(path);
    } catch (const CaseError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(what("/no/such/case.yaml"),
            "/no/such/case.yaml: cannot be read: No such file or directory\n"
            "1 fault in /no/such/case.yaml");
  EXPECT_EQ(what("/"), "/: cannot be read: it is a folder\n1 fault in /");
  EXPECT_EQ(what("/dev/zero"), "/dev/zero: cannot be read: it is a device or a pipe and no file\n1 fault in /dev/zero");
  EXPECT_LT(what(std::string(100'000, 'a')).size(), 10'000U);
}

TEST(Files, BeyondAnyCaseAreNotRead) {
  const std::string path = testing::TempDir() + "nereid_large_case.yaml";
  std::ofstream(path) << "a: 1\n";
  std::filesystem::resize_file(path, 1'000'000'000);  // a hole
  try {
    CaseFile::read(path);
    ADD_FAILURE();
  } catch (const CaseError& error) {
    EXPECT_EQ(error.faults.at(0).message, "cannot be read: it is larger than 10 MB");
  }
  std::filesystem::remove(path);
}

TEST(Faults, ByTheThousandAreCountedAndTheFirstOnesTold) {
  std::string text = "a: 1\n";
  for (int key = 0; key < 40'000; ++key) text += "k" + std::to_string(key) + ": 1\n";
  const std::string said = report(text, [](Section root) { root.number("a"); });
  EXPECT_LT(said.size(), 10'000U);
  EXPECT_NE(said.find("\n40000 faults in case.yaml: these are the first 50"), std::string::npos) << said;
  EXPECT_NE(said.find("case.yaml:51:1: unknown key 'k49'"), std::string::npos);
  EXPECT_EQ(said.find("unknown key 'k50'"), std::string::npos);
}

TEST(Faults, InALongLineShowWhatIsAroundThem) {
  std::string text = "a: [";
  for (int item = 0; item < 1000; ++item) text += "0 Pa \xC3\xA9, ";
  const std::string said = report(text + "1]", [](Section root) { root.quantities("a", dim::stress, any, 1); });
  EXPECT_LT(said.size(), 40'000U);
  EXPECT_NE(said.find("1001 faults in case.yaml: these are the first 50"), std::string::npos) << said.substr(said.size() - 100);
  EXPECT_EQ(nereid::find_unprintable(said), std::string::npos) << "characters stay whole";
  const std::string last = report("a: [" + std::string(10'000, ' ') + "1 Q" + std::string(10'000, ' ') + "]",
                                  [](Section root) { root.quantities("a", dim::stress, any, 1); });
  EXPECT_EQ(last, "case.yaml:1:10007: cannot read 'a[0]' = 1 Q: unknown unit 'Q'\n    1 | ..." + std::string(78, ' ') + "1 Q" +
                      std::string(119, ' ') + "...\n      | " + std::string(83, ' ') + "^\n1 fault in case.yaml");
}

TEST(Faults, OfLongWordsAreShort) {
  const std::string word(100'000, 'k');
  EXPECT_LT(report(word + ": 1\n", read_nothing).size(), 3000U);
  EXPECT_LT(report("a: 1\n", [](Section root) { root.number("a"); }, {word + "=1", "a=" + word}).size(), 6000U);
}

TEST(Files, GoNoDeeperThanAnyCase) {
  EXPECT_NE(report(std::string(10'000, '['), read_nothing), "");
  EXPECT_NE(report("a: " + std::string(10'000, '{'), read_nothing), "");
  std::string text;
  for (int level = 0; level < 60; ++level)
    text += "a" + std::to_string(level) + ": &a" + std::to_string(level) + " " + std::string(100, '[') +
            (level > 0 ? "*a" + std::to_string(level - 1) : "1") + std::string(100, ']') + "\n";
  EXPECT_NE(report(text, read_nothing).find("aliases stand too deep within each other"), std::string::npos);
  std::string path;
  for (int key = 0; key < 100'000; ++key) path += "a.";
  EXPECT_NE(report("a: 1\n", read_nothing, {path + "a=1"}).find("the path has more than 100 keys"), std::string::npos);
}

TEST(Files, AreReadFromDisk) {
  const auto path = std::filesystem::temp_directory_path() / "nereid_section_test_case.yaml";
  std::ofstream(path) << "x: 3 mm\n";
  auto file = CaseFile::read(path.string(), {"y=2"});
  EXPECT_EQ(file.root().quantity("x", dim::length), 0.003);
  EXPECT_EQ(file.root().number("y"), 2);
  EXPECT_NO_THROW(file.finish());
  std::filesystem::remove(path);
}

// ---- alternatives

struct Penalty {
  double value, penalty_scale;
};

Penalty read_penalty(Section root) {
  const Section penalty = root.section("penalty");
  const bool given = penalty.choice("kind", {"given", "automatic"}) == "given";
  return {penalty.when(given).quantity("value", dim::penalty, positive),
          penalty.when(!given).number_or("penalty_scale", 10, positive)};
}

TEST(Alternatives, NeedOnlyTheKeysOfTheChosenKind) {
  auto file = CaseFile::parse("penalty: {kind: automatic}\n", "case.yaml");
  const Penalty read = read_penalty(file.root());
  EXPECT_TRUE(std::isnan(read.value));
  EXPECT_EQ(read.penalty_scale, 10);
  EXPECT_NO_THROW(file.finish());
  EXPECT_TRUE(file.not_used().empty());
  EXPECT_EQ(message("penalty: {kind: given}\n", read_penalty),
            "missing 'value' [kg m^-2 s^-2] in 'penalty'");
}

TEST(Alternatives, ListWhatTheChosenKindDoesNotUse) {
  auto file = CaseFile::parse("penalty:\n  kind: given\n  value: 5e13 Pa/m\n  penalty_scale: 7\n",
                              "case.yaml", {});
  read_penalty(file.root());
  EXPECT_NO_THROW(file.finish());
  EXPECT_EQ(file.not_used(), Texts{"penalty.penalty_scale (case.yaml:4:3)"});
  for (const Resolved& one : file.resolved()) EXPECT_NE(one.path, "penalty.penalty_scale");
}

TEST(Alternatives, CheckWhatTheChosenKindDoesNotUse) {
  EXPECT_EQ(message("penalty: {kind: automatic, value: 5e13 Pa}\n", read_penalty),
            "'value' = 5e13 Pa has the dimension [kg m^-1 s^-2]: expected [kg m^-2 s^-2], "
            "for example 'Pa/m'");
  EXPECT_EQ(message("penalty: {kind: automatic, valeu: 5e13 Pa/m}\n", read_penalty),
            "unknown key 'valeu' in 'penalty'");
}

TEST(Alternatives, MissNothingWhileTheKindIsUnknown) {
  EXPECT_EQ(message("penalty: {kind: autmatic}\n", read_penalty),
            "'kind' = autmatic is unknown: expected one of given, automatic");
  EXPECT_EQ(message("penalty: {penalty_scale: 3}\n", read_penalty), "missing 'kind' in 'penalty'");
}

/// Two kinds share the key `size`, with different dimensions.
void read_shape(Section root) {
  const auto kind = root.choice("kind", {"ball", "drop"});
  root.when(kind == "ball").quantity("size", dim::length, positive);
  root.when(kind == "drop").quantity("size", dim::volume, positive);
  const Section shell = root.when(kind == "ball").section("shell");
  shell.quantity("thickness", dim::length, positive);
}

TEST(Alternatives, MayShareAKeyWithDifferentMeanings) {
  EXPECT_EQ(message("{kind: ball, size: 2 m, shell: {thickness: 1 mm}}", read_shape), "");
  EXPECT_EQ(message("{kind: drop, size: 2 m^3}", read_shape), "");
  EXPECT_EQ(message("{kind: dorp, size: 2 m^3}", read_shape),
            "'kind' = dorp is unknown: expected one of ball, drop");
  auto file = CaseFile::parse("{kind: drop, size: 2 m^3}", "case.yaml");
  read_shape(file.root());
  EXPECT_TRUE(file.not_used().empty());
  ASSERT_EQ(file.resolved().size(), 2U);
  EXPECT_EQ(std::get<double>(file.resolved()[1].value), 2);
}

TEST(Alternatives, MayHoldSections) {
  EXPECT_EQ(message("{kind: ball, size: 2 m}", read_shape), "missing section 'shell'");
  EXPECT_EQ(message("{kind: ball, size: 2 m, shell: {thickness: 0 m}}", read_shape),
            "'thickness' = 0 m is out of range: expected thickness > 0");
  EXPECT_EQ(message("{kind: drop, size: 2 m^3, shell: {thikness: 1 m}}", read_shape),
            "unknown key 'thikness' in 'shell'");
  auto file = CaseFile::parse("{kind: drop, size: 2 m^3, shell: {thickness: 1 m}}", "case.yaml");
  read_shape(file.root());
  EXPECT_NO_THROW(file.finish());
  EXPECT_EQ(file.not_used(), Texts{"shell (case.yaml:1:27)"});
}

TEST(Alternatives, MayBeToldByThePresenceOfAKey) {
  const Reader reader = [](Section root) {
    const bool automatic = !root.has("dt");
    root.when(!automatic).quantity("dt", dim::time, positive);
    root.when(automatic).number_or("safety", 0.9);
  };
  EXPECT_EQ(message("dt: 1 us\n", reader), "");
  EXPECT_EQ(message("safety: 0.5\n", reader), "");
  auto file = CaseFile::parse("dt: 1 us\nsafety: 0.5\n", "case.yaml");
  reader(file.root());
  EXPECT_EQ(file.not_used(), Texts{"safety (case.yaml:2:1)"});
}

TEST(Alternatives, ListAKeyThatWasOnlyLookedFor) {
  auto file = CaseFile::parse("x: {a: 1}\n", "case.yaml");
  EXPECT_TRUE(file.root().has("x"));
  EXPECT_NO_THROW(file.finish());
  EXPECT_EQ(file.not_used(), Texts{"x (case.yaml:1:1)"});
}

// ---- the command line

void read_bars(Section root) {
  root.word_or("title", "");
  const Section contact = root.section_or_empty("contact");
  contact.choice_or("kind", "penalty", {"penalty", "none"});
  contact.quantity_or("penalty", 1e12, dim::penalty, positive);
  for (const auto& body : root.list("bodies")) body.quantity("length", dim::length, positive);
}

constexpr const char* bars =
    "title: Bars\ncontact:\n  penalty: 5e13 Pa/m\nbodies:\n  - length: 1 m\n  - length: 2 m\n";

TEST(Overrides, ReplaceValuesOfTheFile) {
  auto file =
      CaseFile::parse(bars, "case.yaml", {"contact.penalty=1e11 Pa/m", "bodies[1].length = 3 mm"});
  const Section root = file.root();
  read_bars(root);
  EXPECT_NO_THROW(file.finish());
  EXPECT_EQ(root.section("contact").quantity("penalty", dim::penalty), 1e11);
  EXPECT_EQ(root.list("bodies")[0].quantity("length", dim::length), 1);
  EXPECT_EQ(root.list("bodies")[1].quantity("length", dim::length), 0.003);
}

TEST(Overrides, AddKeysAndSections) {
  auto file =
      CaseFile::parse("title: Bars\n", "case.yaml",
                      {"contact.kind=none", "contact.penalty=2 Pa/m", "at=[1 m, 2 m, 3 m]"});
  const Section root = file.root();
  EXPECT_EQ(root.word("title"), "Bars");
  EXPECT_EQ(root.section("contact").choice("kind", {"penalty", "none"}), "none");
  EXPECT_EQ(root.section("contact").quantity("penalty", dim::penalty), 2);
  EXPECT_EQ(root.vector("at", dim::length), (std::array<double, 3>{1, 2, 3}));
  EXPECT_NO_THROW(file.finish());
  EXPECT_EQ(message("contact:\n", read_bars, {"contact.kind=none"}), "");
}

TEST(Overrides, OfOneAliasLeaveTheOthers) {
  auto file = CaseFile::parse("a: &s {young: 1 Pa}\nb: *s\n", "case.yaml", {"b.young=2 Pa"});
  EXPECT_EQ(file.root().section("a").quantity("young", dim::stress), 1);
  EXPECT_EQ(file.root().section("b").quantity("young", dim::stress), 2);
}

TEST(Overrides, AreCheckedLikeTheFile) {
  EXPECT_EQ(
      report(bars, read_bars, {"contact.penalty=-5e11 Pa/m"}),
      R"(--set contact.penalty=-5e11 Pa/m:17: 'penalty' = -5e11 Pa/m is out of range: expected penalty > 0
      | contact.penalty=-5e11 Pa/m
      |                 ^~~~~~~~~~
1 fault in case.yaml)");
  EXPECT_EQ(report(bars, read_bars, {"contact.penality=5e11 Pa/m"}),
            R"(--set contact.penality=5e11 Pa/m:9: unknown key 'penality' in 'contact'
      | contact.penality=5e11 Pa/m
      |         ^~~~~~~~  did you mean 'penalty'?
1 fault in case.yaml)");
  EXPECT_EQ(report(bars, read_bars, {"contcat.penalty=5e11 Pa/m"}),
            R"(--set contcat.penalty=5e11 Pa/m:1: unknown key 'contcat'
      | contcat.penalty=5e11 Pa/m
      | ^~~~~~~  did you mean 'contact'?
1 fault in case.yaml)");
  EXPECT_EQ(message(bars, read_bars, {"contact.penalty=5e11 Pa/m/x"}),
            "cannot read 'penalty' = 5e11 Pa/m/x: unknown unit 'x'");
}

TEST(Overrides, WithoutMeaningAreFaults) {
  EXPECT_EQ(message(bars, read_bars, {"title.x=3"}), "'title' is not a section, so it has no 'x'");
  EXPECT_EQ(message(bars, read_bars, {"contact=3"}), "'contact' is a section: set one of its keys");
  EXPECT_EQ(message(bars, read_bars, {"contact={penalty: 3 Pa/m}"}),
            "'contact' is set to a section: set one key at a time");
  EXPECT_EQ(message(bars, read_bars, {"bodies[2].length=1 m"}),
            "'bodies' has 2 items, so there is no 'bodies[2]'");
  EXPECT_EQ(message(bars, read_bars, {"planes[0].x=1 m"}), "the case has no list 'planes'");
  EXPECT_EQ(message(bars, read_bars, {"bodies.length=1 m"}),
            "'bodies' is not a section, so it has no 'length'");
  EXPECT_EQ(message(bars, read_bars, {"bodies[x].length=1 m"}),
            "an item of a list is written as in 'bodies[0]'");
  EXPECT_EQ(message(bars, read_bars, {"title"}), "expected 'key.path=value'");
  EXPECT_EQ(message(bars, read_bars, {"contact..x=1"}), "a key is missing in the path");
  EXPECT_EQ(message(bars, read_bars, {"=1"}), "a key is missing in the path");
  EXPECT_EQ(message(bars, read_bars, {"title="}), "no value for 'title'");
  EXPECT_EQ(message(bars, read_bars, {"title=[1"}), "a key must be a single word");
}

TEST(Overrides, OfOneKeyAreGivenOnce) {
  EXPECT_EQ(report(bars, read_bars, {"title=A", "title=B"}),
            R"(--set title=B:1: repeated --set of 'title': first given by '--set title=A'
      | title=B
      | ^~~~~~~
1 fault in case.yaml)");
  EXPECT_EQ(message(bars, read_bars, {"bodies[0].length=1 m", "bodies[00].length=2 m"}),
            "repeated --set of 'bodies[00].length': first given by '--set bodies[0].length=1 m'");
  EXPECT_EQ(message(bars, read_bars, {"bodies[0].length=1 m", "bodies[1].length=2 m"}), "");
}

TEST(Overrides, ThatDoNotGoWithTheFileAreAtFaultThemselves) {
  const Reader reader = [](Section root) {
    root.number("low"), root.number("high");
    root.fault_between({"high", "low"}, "'high' must be above 'low'");
  };
  EXPECT_NE(report("low: 2\nhigh: 1\n", reader).find("case.yaml:2:7: 'high' must"), std::string::npos);
  EXPECT_NE(report("low: 0\nhigh: 1\n", reader, {"low=2"}).find("--set low=2:5: 'high' must"), std::string::npos);
  EXPECT_NE(report("low: 0\nhigh: 3\n", reader, {"low=2", "high=1"}).find("--set high=1:6: 'high' must"), std::string::npos);
}

TEST(Overrides, HaveTheirFaultsAfterThoseOfTheFile) {
  const std::string all = report("colour: red\n", read_bars, {"b=1", "a=1"});
  EXPECT_LT(all.find("'colour'"), all.find("'b'"));
  EXPECT_LT(all.find("'b'"), all.find("'a'"));
}

TEST(Overrides, AreNamedAmongWhatIsNotUsed) {
  auto file = CaseFile::parse("penalty: {kind: given, value: 1 Pa/m}\n", "case.yaml",
                              {"penalty.penalty_scale=3"});
  read_penalty(file.root());
  EXPECT_NO_THROW(file.finish());
  EXPECT_EQ(file.not_used(), Texts{"penalty.penalty_scale (--set penalty.penalty_scale=3:9)"});
}

// ---- the record

TEST(Files, AreCheckedEachAtItsKey) {
  const auto file = CaseFile::parse("a: one.vtu\nb: two.vtu\n", "folder/case.yaml");
  for (const char* key : {"a", "b"}) file.root().beside_case(key, file.root().word(key));
  EXPECT_NO_THROW(file.check_files([](const std::string&) { return ""; }));
  try {
    file.check_files([](const std::string& path) { return path == "folder/two.vtu" ? "is read and written" : ""; });
    FAIL() << "the fault is not told";
  } catch (const CaseError& error) {
    ASSERT_EQ(error.faults.size(), 1U);
    EXPECT_EQ(error.faults[0].line, 2);
    EXPECT_EQ(error.faults[0].column, 4);
    EXPECT_EQ(error.faults[0].message, "is read and written");
  }
}

TEST(Record, HoldsEveryValueInSiInOrderOfReading) {
  auto file = CaseFile::parse(
      "n: 3\nbodies: [{length: 5 mm}]\nat: [1 mm, 2 mm, 3 mm]\nout: [a, b]\n", "case.yaml");
  const Section root = file.root();
  root.list("bodies")[0].quantity("length", dim::length);
  root.count("n");
  root.vector("at", dim::length);
  root.words("out");
  root.flag_or("symmetric", false);
  root.quantity_or("penalty", 5, dim::penalty);
  root.choice_or("kind", "a", {"a", "b"});
  root.count("n");
  file.finish();
  const auto& all = file.resolved();
  ASSERT_EQ(all.size(), 7U);
  EXPECT_EQ(all[0].path, "bodies[0].length");
  EXPECT_EQ(std::get<double>(all[0].value), 0.005);
  EXPECT_EQ(all[0].unit, "m");
  EXPECT_FALSE(all[0].is_default);
  EXPECT_EQ(std::get<std::int64_t>(all[1].value), 3);
  EXPECT_EQ(all[1].unit, "1");
  EXPECT_EQ(std::get<std::vector<double>>(all[2].value),
            (std::vector<double>{0.001, 0.002, 0.003}));
  EXPECT_EQ(std::get<Texts>(all[3].value), (Texts{"a", "b"}));
  EXPECT_FALSE(std::get<bool>(all[4].value));
  EXPECT_TRUE(all[4].is_default);
  EXPECT_EQ(all[5].unit, "Pa/m");
  EXPECT_EQ(std::get<std::string>(all[6].value), "a");
  EXPECT_EQ(all[6].unit, "");
}

TEST(Record, HashKnowsTheMeaningAndNotTheSpelling) {
  const auto hash = [](const std::string& text, const Texts& overrides = {}) {
    auto file = CaseFile::parse(text, "case.yaml", overrides);
    read_bars(file.root());
    file.finish();
    return file.hash();
  };
  const std::string reference = hash(bars);
  EXPECT_EQ(reference.size(), 16U);
  EXPECT_EQ(hash("contact: {kind: penalty, penalty: 5e7 MPa/m}\n"
                 "bodies: [{length: 1000 mm}, {length: 2 m}]\ntitle: 'Bars' # a\n"),
            reference);
  EXPECT_NE(hash(bars, {"title=Rods"}), reference);
  EXPECT_NE(hash(bars, {"bodies[1].length=2.0000000000000004 m"}), reference);
}

TEST(FaultByPath, StandsAtTheValueOrAtTheDeepestPartThatIsThere) {
  const auto place = [](const std::string& path) -> std::string {
    const auto file = CaseFile::parse("planes:\n  - {name: side, nodes: [bar, bat]}\n", "case.yaml");
    for (const Section& plane : file.root().list("planes")) plane.word("name"), plane.words("nodes");
    file.fault(path, "is wrong", "look again");
    try {
      file.finish();
    } catch (const CaseError& error) {
      const Fault& fault = error.faults.at(0);
      EXPECT_EQ(fault.message + ", " + fault.hint, "is wrong, look again");
      return std::to_string(fault.line) + ":" + std::to_string(fault.column);
    }
    return "";
  };
  EXPECT_EQ(place("planes[0].nodes[1]"), "2:31");
  EXPECT_EQ(place("planes[0].nodes"), "2:25");
  EXPECT_EQ(place("planes[0].point"), "2:5");
  EXPECT_EQ(place("planes[0]"), "2:5");
  EXPECT_EQ(place("contacts[0].base"), "1:1");
  EXPECT_EQ(place(""), "1:1");
}

}  // namespace
}  // namespace nereid::input::section_test
