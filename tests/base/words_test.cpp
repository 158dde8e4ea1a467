#include "base/words.hpp"

#include <gtest/gtest.h>

namespace nereid::words_test {
namespace {

TEST(Words, AreFormattedWhole) {
  EXPECT_EQ(formatted("%d of %s: %.3g %%", 3, "bar", 0.12345), "3 of bar: 0.123 %");
  EXPECT_EQ(formatted("nothing"), "nothing");
  const std::string name(1000, 'x');
  EXPECT_EQ(formatted("'%s'", name.c_str()), "'" + name + "'");
}

TEST(Nearest, IsTheWordWithTheFewestWrongLetters) {
  EXPECT_EQ(nearest("penalyt", {"penalty_scale", "penalty", "penal"}), "did you mean 'penalty'?");
  EXPECT_EQ(nearest("Penalty", {"penalty"}), "did you mean 'penalty'?");  // capitals cost nothing
  EXPECT_EQ(nearest("x_hihg", {"x_low", "x_high"}), "did you mean 'x_high'?");
}

TEST(Nearest, IsSilentWhereMoreThanAThirdIsWrong) {
  EXPECT_EQ(nearest("abc", {"xyz"}), "");
  EXPECT_EQ(nearest("tip", {}), "");
  EXPECT_EQ(nearest(std::string(1000, 'a'), {std::string(1000, 'a')}), "");  // too long to be a key
}

TEST(Listed, EndsWhereNobodyReadsOn) {
  EXPECT_EQ(listed({"a", "b"}), "a, b");
  EXPECT_EQ(listed({}), "");
  const std::string long_list = listed(std::vector<std::string>(30, "a"));
  EXPECT_EQ(long_list.substr(long_list.size() - 11), " and 6 more");
}

TEST(Counted, KnowsOneFromMany) {
  EXPECT_EQ(counted(0, "item"), "0 items");
  EXPECT_EQ(counted(1, "item"), "1 item");
}

TEST(Shortest, ReadsBackToTheSameNumber) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(std::stod(shortest(1.0 / 3.0)), 1.0 / 3.0);
}

TEST(Words, APercentageIsReadable) {
  EXPECT_EQ(percent(0.123), "12 %");
  EXPECT_EQ(percent(1.2e-5), "0.0012 %");
  EXPECT_EQ(percent(3e-7), "3e-07");
}

TEST(Characters, CountsWhatOneSees) {
  EXPECT_EQ(characters("a\xC3\xA4z"), 3);
  EXPECT_EQ(characters(""), 0);
}

TEST(FindUnprintable, FindsControlBytesAndBrokenUtf8) {
  EXPECT_EQ(find_unprintable("a\tb\n\xC3\xA4"), std::string_view::npos);
  EXPECT_EQ(find_unprintable("ab\x01"), 2U);
  EXPECT_EQ(find_unprintable("a\xC3"), 1U);
}

TEST(Clipped, EndsBetweenCharacters) {
  EXPECT_EQ(clipped("abc", 3), "abc");
  EXPECT_EQ(clipped("abcd", 3), "abc...");
  EXPECT_EQ(clipped("ab\xC3\xA9z", 3), "ab...");
  EXPECT_EQ(clipped("\x80\x80\x80", 1), "...");
}

}  // namespace
}  // namespace nereid::words_test
