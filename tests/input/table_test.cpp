#include "input/table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nereid::input::table_test {
namespace {

Table table(const std::string& text, const std::string& column = "") { return std::get<Table>(parse_table(text, column)); }

std::string fault(const std::string& text, const std::string& column = "") {
  const auto parsed = parse_table(text, column);
  return std::holds_alternative<std::string>(parsed) ? std::get<std::string>(parsed) : "";
}

constexpr const char* pulse = "# of a slug\ntime [ms], pressure [MPa]\n\n0, 0\n1, 45\r\n3, 5\n";

TEST(Table, IsLinearBetweenItsPointsAndInSi) {
  const Table slug = table(pulse);
  EXPECT_EQ(slug.of_argument, dim::time);
  EXPECT_EQ(slug.of_value, dim::stress);
  EXPECT_DOUBLE_EQ(value_at(slug, 0.5e-3), 22.5e6);
  EXPECT_DOUBLE_EQ(value_at(slug, 1e-3), 45e6);
  EXPECT_DOUBLE_EQ(value_at(slug, 2e-3), 25e6);
}

TEST(Table, StaysAtItsEndsOutside) {
  const Table slug = table(pulse);
  EXPECT_EQ(value_at(slug, -1), 0);
  EXPECT_EQ(value_at(slug, 3e-3), 5e6);
  EXPECT_EQ(value_at(slug, 1e300), 5e6);
  EXPECT_TRUE(std::isnan(value_at(slug, std::nan(""))));
  EXPECT_EQ(value_at(table("t [s], f [N]\n2, 7\n"), 0), 7) << "of one point it is constant";
}

TEST(Table, TakesAColumnThatAHistoryMarksAsAMean) {
  const Table pull = table("time [s],tip [m],pull [kN] mean\n0,1,2\n", "pull");
  EXPECT_EQ(pull.of_value, dim::force);
  EXPECT_EQ(value_at(pull, 0), 2000);
  EXPECT_NE(fault("time [s],pull [kN] means\n0,2\n"), "");
}

TEST(Table, TakesAColumnByItsName) {
  const std::string history = "\xef\xbb\xbftime [s],energy [J],tip [m]\n0,1,2\n1,3,4\n";
  EXPECT_EQ(value_at(table(history, "tip"), 0.5), 3);
  EXPECT_EQ(table(history, "energy").of_value, dim::energy);
  EXPECT_EQ(fault(history, "tap"), "line 1: there is no column 'tap': columns are energy, tip; did you mean 'tip'?");
  EXPECT_EQ(fault(history), "line 1: there are 2 columns of values: name one behind the file, as in 'file.csv:energy'");
}

TEST(Table, FaultsNameTheLine) {
  EXPECT_EQ(fault(""), "it is empty: expected a first line as in 'time [ms], pressure [MPa]'");
  EXPECT_EQ(fault("t [s], f [N]\n"), "it has no line of numbers");
  EXPECT_EQ(fault("t [s]\n0\n"), "line 1: expected two columns, as in 'time [ms], pressure [MPa]'");
  EXPECT_EQ(fault("t [s], f [N\n0, 0\n"), "line 1: expected ']' at the end of 'f [N'");
  EXPECT_NE(fault("t [s], f [Newton]\n0, 0\n").find("cannot read the unit of 'f [Newton]'"), std::string::npos);
  EXPECT_EQ(fault("t [s], f [N]\n0, 0\n1\n"), "line 3: 1 value: expected 2 as in the first line");
  EXPECT_EQ(fault("t [s], f [N]\n0, 0\n1, 2e999\n"), "line 3: '2e999' is no finite number");
  EXPECT_EQ(fault("t [s], f [kN]\n0, 0\n1, 1e307\n"), "line 3: '1e307' is no finite number") << "in N it is none";
  EXPECT_EQ(fault("t [s], f [N]\n0, 0\n1, nan\n"), "line 3: 'nan' is no finite number");
  EXPECT_EQ(fault(std::string("t [s], f [N]\n0, 0\0\n", 20)), "line 2: it has a byte that is neither UTF-8 nor printable");
  EXPECT_EQ(fault("t [s], f [N]\n0, 0\n\n0, 1\n"), "line 4: 't' does not grow: expected more than in the line before");
}

}  // namespace
}  // namespace nereid::input::table_test
