#include "input/survey.hpp"

#include <gtest/gtest.h>

#include "input/section.hpp"

namespace nereid::input::survey_test {
namespace {

using Where = std::vector<std::string>;

/// The keys of a reader by path, without those that every case has.
std::map<std::string, AskedKey> keys_of(const std::function<void(const Section&)>& read) {
  std::map<std::string, AskedKey> keys;
  for (const AskedKey& key : asked_keys([&](const CaseFile& file) { read(file.root()), file.finish(); })) keys[key.path] = key;
  EXPECT_EQ(keys.erase("refine"), 1u);
  EXPECT_EQ(keys.erase("accuracy"), 1u);
  return keys;
}

std::vector<std::string> paths(const std::map<std::string, AskedKey>& keys) {
  std::vector<std::string> all;
  for (const auto& [path, key] : keys) all.push_back(path);
  return all;
}

TEST(AskedKeys, HaveTypeUnitRangeAndDefaultAsTheReaderAsksForThem) {
  const auto keys = keys_of([](const Section& root) {
    root.quantity("length", dim::length, positive);
    root.quantity_or("angle", 0.5, dim::angle);
    root.number_or("safety", 0.9, above(0).up_to(10));
    root.count_or("layers", 5, 1, 9);
    root.flag_or("rigid", false);
    root.word("name");
    root.words("nodes");
    root.words("off", 0);
    root.vector_or("move", {0, 0, 0}, dim::length);
    root.counts("cells");
    root.choice_or("passes", "one", {"two", "one"});
    root.text("value", [](const std::string&) { return std::nullopt; });
  });
  EXPECT_EQ(paths(keys),
            (Where{"angle", "cells", "layers", "length", "move", "name", "nodes", "off", "passes", "rigid", "safety", "value"}));
  EXPECT_EQ(keys.at("length").type, "quantity");
  EXPECT_EQ(keys.at("length").unit, "m");
  EXPECT_EQ(keys.at("length").range, "length > 0");
  EXPECT_EQ(keys.at("length").otherwise, "");
  EXPECT_EQ(keys.at("angle").otherwise, "0.5");
  EXPECT_EQ(keys.at("safety").range, "0 < safety <= 10");
  EXPECT_EQ(keys.at("safety").otherwise, "0.9");
  EXPECT_EQ(keys.at("layers").type, "count");
  EXPECT_EQ(keys.at("layers").range, "1 <= layers <= 9");
  EXPECT_EQ(keys.at("rigid").otherwise, "false");
  EXPECT_EQ(keys.at("nodes").type, "words");
  EXPECT_EQ(keys.at("nodes").range, "at least 1");
  EXPECT_EQ(keys.at("move").otherwise, "[0, 0, 0]");
  EXPECT_EQ(keys.at("passes").options, (Where{"two", "one"}));
  EXPECT_EQ(keys.at("passes").otherwise, "one");
  EXPECT_EQ(keys.at("value").type, "expression");
  for (const char* path : {"length", "name", "nodes", "cells", "value"}) EXPECT_TRUE(keys.at(path).required) << path;
  for (const char* path : {"angle", "safety", "layers", "rigid", "off", "move", "passes"}) EXPECT_FALSE(keys.at(path).required) << path;
  for (const auto& [path, key] : keys) EXPECT_TRUE(key.where.empty()) << path;
}

TEST(AskedKeys, OfKindsStandWhereTheirKindIsChosen) {
  const auto keys = keys_of([](const Section& root) {
    for (const Section& shape : root.list("shapes", 1)) {
      const std::string kind = shape.choice("kind", {"box", "ball", "tube"});
      shape.when(kind == "box").quantity("side", dim::length, positive);
      shape.when(kind != "box").quantity("radius", dim::length, positive);
      const Section tube = shape.when(kind == "tube");
      const bool part = tube.choice_or("turn", "full", {"full", "part"}) == "part";
      tube.when(part).quantity("angle", dim::angle);
    }
  });
  EXPECT_EQ(paths(keys), (Where{"shapes", "shapes[].angle", "shapes[].kind", "shapes[].radius", "shapes[].side", "shapes[].turn"}));
  EXPECT_TRUE(keys.at("shapes").required);
  EXPECT_EQ(keys.at("shapes").type, "sections");
  EXPECT_EQ(keys.at("shapes[].side").where, (Where{"shapes[].kind = box"}));
  EXPECT_EQ(keys.at("shapes[].radius").where, (Where{"shapes[].kind = ball | tube"}));
  EXPECT_EQ(keys.at("shapes[].turn").where, (Where{"shapes[].kind = tube"}));
  EXPECT_EQ(keys.at("shapes[].angle").where, (Where{"shapes[].kind = tube", "shapes[].turn = part"}));
  EXPECT_TRUE(keys.at("shapes[].angle").required);
}

TEST(AskedKeys, ThatOthersReplaceStandWhereTheseAreAbsent) {
  const auto keys = keys_of([](const Section& root) {
    const bool given = root.has("penalty");
    root.when(given).quantity("penalty", dim::penalty, positive);
    root.when(!given).number_or("scale", 20, positive);
    if (root.has("shape")) root.section("shape").quantity("radius", dim::length, positive);
    root.section_or_empty("output").quantity_or("every", 1, dim::time);
  });
  EXPECT_EQ(paths(keys), (Where{"output", "output.every", "penalty", "scale", "shape", "shape.radius"}));
  EXPECT_FALSE(keys.at("penalty").required);
  EXPECT_EQ(keys.at("penalty").where, Where{});
  EXPECT_EQ(keys.at("scale").where, (Where{"without penalty"}));
  EXPECT_FALSE(keys.at("shape").required);
  EXPECT_TRUE(keys.at("shape.radius").required);
  EXPECT_EQ(keys.at("shape.radius").where, Where{});
}

TEST(AskedKeys, OfANumberThatIsZeroByDefaultStandWhereItIsAboveZero) {
  const auto keys = keys_of([](const Section& root) {
    const double friction = root.number_or("friction", 0, within(0, 10));
    root.when(friction > 0).choice_or("weights", "consistent", {"consistent", "equal"});
  });
  EXPECT_EQ(keys.at("weights").where, (Where{"friction = above 0"}));
}

TEST(AskedKeys, SayWhichDefaultComesWithWhichChoice) {
  const auto keys = keys_of([](const Section& root) {
    const bool springs = root.choice_or("kind", "strains", {"strains", "springs"}) == "springs";
    root.number_or("hourglass", springs ? 0.1 : 1, springs ? within(0, 1) : within(0, 2));
  });
  EXPECT_EQ(keys.at("hourglass").otherwise, "1; 0.1 with kind = springs");
  EXPECT_EQ(keys.at("hourglass").range, "0 <= hourglass <= 2 | 0 <= hourglass <= 1");
}

TEST(AskedKeys, OfTwoTypesHaveBoth) {
  const auto keys = keys_of([](const Section& root) {
    if (root.choice("kind", {"sector", "revolved"}) == "sector") root.count("cells");
    else root.quantities("cells", dim::none);
  });
  EXPECT_EQ(keys.at("cells").type, "count | numbers");
  EXPECT_TRUE(keys.at("cells").required);
}

TEST(AskedKeys, ThatDoNotGoTogetherMakeNoCondition) {
  const auto keys = keys_of([](const Section& root) {
    const bool both = root.has("above") && root.has("below");
    if (both) root.fault("below", "'above' and 'below' are two conditions");
    if (both) return;
    for (const char* key : {"above", "below"})
      if (root.has(key)) root.quantity(key, dim::length);
  });
  EXPECT_EQ(paths(keys), (Where{"above", "below"}));
  EXPECT_EQ(keys.at("above").where, Where{});
  EXPECT_EQ(keys.at("below").where, Where{});
}

TEST(AskedKeys, ThatNoCaseUsesAreToldAsSuch) {
  const auto keys = keys_of([](const Section& root) {
    const Section never = root.when(false);
    if (never.choice_or("kind", "a", {"a", "b"}) == "b") never.word("only_of_b");
  });
  EXPECT_EQ(paths(keys), (Where{"kind", "only_of_b"}));
  EXPECT_EQ(keys.at("only_of_b").where, (Where{"never"}));
  EXPECT_FALSE(keys.at("only_of_b").required);
}

TEST(AskedKeys, AreNoneIfTheReaderAsksForNothing) {
  EXPECT_TRUE(keys_of([](const Section&) {}).empty());
}

}  // namespace
}  // namespace nereid::input::survey_test
