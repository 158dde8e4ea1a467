#include "input/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "base/types.hpp"

namespace nereid::input::expression_test {
namespace {

double value(const std::string& text, double x = 0, double y = 0, double z = 0, double t = 0) {
  return std::get<Expression>(parse_expression(text, of_both))(x, y, z, t);
}

TextFault fault(const std::string& text, Variables variables = of_both) {
  const auto parsed = parse_expression(text, variables);
  return std::holds_alternative<TextFault>(parsed) ? std::get<TextFault>(parsed) : TextFault{0, 0, ""};
}

/// The first fault of a case that has one.
std::string first_fault(const std::string& text, Variables variables) {
  const CaseFile file = CaseFile::parse(text, "case.yaml");
  read_expression(file.root(), "value", variables, {1, dim::stress});
  try {
    file.finish();
  } catch (const CaseError& error) {
    return error.faults[0].text;
  }
  return "";
}

TEST(Expression, IsAFunctionOfPlaceAndTime) {
  EXPECT_EQ(value("1"), 1);
  EXPECT_DOUBLE_EQ(value("x + 10*y + 100*z + 1000*t", 1, 2, 3, 4), 4321);
  EXPECT_DOUBLE_EQ(value("1e6 * min(1, t/1e-3)", 0, 0, 0, 5e-4), 5e5);
  EXPECT_DOUBLE_EQ(value("t < 1 ? sin(pi*t) : 0", 0, 0, 0, 0.25), std::sin(pi * 0.25));
  EXPECT_DOUBLE_EQ(value("2^3^1"), 8);
  EXPECT_DOUBLE_EQ(value("-x^2", 3), -9);
  EXPECT_DOUBLE_EQ(value("log(x)", 3), std::log(3));
}

TEST(Expression, CopiesOfOneGiveWhatTheOriginalGives) {
  const auto original = std::get<Expression>(parse_expression("x*t", of_both));
  const Expression copy = original;
  EXPECT_EQ(copy(2, 0, 0, 3), 6);
  EXPECT_EQ(original(5, 0, 0, 3), 15);
  EXPECT_EQ(copy(2, 0, 0, 3), 6);
}

TEST(Expression, MayHaveNoFiniteValueSomewhere) {
  EXPECT_TRUE(std::isinf(value("1/t")));
  EXPECT_TRUE(std::isnan(value("0/t")));
  EXPECT_TRUE(std::isnan(value("sqrt(t-1)")));
}

TEST(Expression, FaultsSayWhereAndWhatIsExpected) {
  EXPECT_EQ(fault("2*u").column, 3);
  EXPECT_EQ(fault("2*u").message, "'u' is unknown: expected x, y, z, t, pi, or a function such as sin, min, exp");
  EXPECT_EQ(fault("1 + x", of_time).message, "'x' is unknown: expected t, pi, or a function such as sin, min, exp");
  EXPECT_EQ(fault("t", of_place).message, "'t' is unknown: expected x, y, z, pi, or a function such as sin, min, exp");
  EXPECT_EQ(fault("1 +").message, "unexpected end of expression at position 4");
  EXPECT_EQ(fault("sin(t").message, "missing parenthesis");
  EXPECT_EQ(fault("1, 2").message, "these are 2 values: expected one");
  EXPECT_EQ(fault("t = 3").message, "an expression assigns nothing: '==' compares");
  EXPECT_EQ(fault("t = 3").column, 3);
  EXPECT_EQ(fault("t == 3 ? 1 : 2").message, "");
  EXPECT_EQ(fault("(t <= 3) + (t >= 1) + (t != 2)").message, "");
  EXPECT_NE(fault("t += 3").message, "");
  EXPECT_NE(fault(" ").message, "");
}

/// What a text with a table of time [ms] and force [kN] gives at a time, in a unit.
double with_table(const std::string& text, const InUnit& unit, double t) {
  const ReadFile read = [](const std::string& name, std::string& why) -> std::optional<std::string> {
    if (name == "push.csv") return "time [ms], force [kN]\n0, 0\n10, 5\n";
    why = "No such file";
    return std::nullopt;
  };
  const auto parsed = parse_expression(text, of_time, unit, read);
  if (const auto* wrong = std::get_if<TextFault>(&parsed)) throw std::runtime_error(std::to_string(wrong->column) + ": " + wrong->message);
  return std::get<Expression>(parsed)(0, 0, 0, t);
}

TEST(Expression, HasTablesInTheUnitOfTheKey) {
  EXPECT_DOUBLE_EQ(with_table("table(\"push.csv\", t)", {1, dim::force}, 4e-3), 2000);
  EXPECT_DOUBLE_EQ(with_table("2*table( \"push.csv\", t - 1e-3) + 1", {1000, dim::force}, 5e-3), 5);
}

TEST(Expression, TablesMustFit) {
  const auto said = [](const std::string& text, const InUnit& unit) {
    try {
      with_table(text, unit, 0);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(said("3*table(\"pull.csv\", t)", {1, dim::force}), "10: 'pull.csv': No such file");
  EXPECT_EQ(said("table(\"push.csv\", t)", {1, dim::stress}),
            "8: 'push.csv': its values have the dimension [kg m s^-2]: expected [kg m^-1 s^-2], for example 'Pa'");
  EXPECT_NE(said("table(\"push.csv\")", {1, dim::force}), "");
  EXPECT_NE(said("table(t)", {1, dim::force}), "");
}

TEST(ReadExpression, PointsIntoTheText) {
  EXPECT_EQ(first_fault("value: \"2 * sim(t)\"\n", of_time),
            "case.yaml:1:13: cannot read 'value' = 2 * sim(t): 'sim' is unknown: expected t, pi, or a function such as sin, min, exp\n"
            "    1 | value: \"2 * sim(t)\"\n"
            "      |             ^~~");
  EXPECT_EQ(first_fault("value: 2*u\n", of_time).substr(0, 16), "case.yaml:1:10: ");
  EXPECT_EQ(first_fault("value: [1, 2]\n", of_time).substr(0, 55), "case.yaml:1:8: 'value' is a list: expected a single val");
}

TEST(ReadExpression, TakesAConstantWithOrWithoutQuotesAndItsUnit) {
  const CaseFile file = CaseFile::parse("a: 3\nb: \"3\"\nc: [0, \"t\", 2*t]\n", "case.yaml");
  EXPECT_EQ(read_expression(file.root(), "a", of_time, {})(0, 0, 0, 0), 3);
  EXPECT_EQ(read_expression(file.root(), "b", of_time, {1000, dim::force})(0, 0, 0, 0), 3000);
  const auto c = read_expressions(file.root(), "c", of_time, {10, dim::force});
  EXPECT_EQ(c[1](0, 0, 0, 7), 70);
  EXPECT_EQ(c[2](0, 0, 0, 7), 140);
  file.finish();
}

TEST(ReadExpression, WantsThreeOfThem) {
  const CaseFile file = CaseFile::parse("c: [0, 1]\n", "case.yaml");
  EXPECT_EQ(read_expressions(file.root(), "c", of_time, {})[2](0, 0, 0, 0), 0);
  EXPECT_THROW(file.finish(), CaseError);
}

}  // namespace
}  // namespace nereid::input::expression_test
