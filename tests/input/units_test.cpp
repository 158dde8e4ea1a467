#include "input/units.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace nereid::input::units_test {
namespace {

Quantity read(std::string_view text) {
  auto parsed = parse_quantity(text);
  if (const auto* fault = std::get_if<TextFault>(&parsed)) {
    ADD_FAILURE() << text << ": " << fault->message;
    return {0, {}, false};
  }
  return std::get<Quantity>(parsed);
}

/// "column:length: message", or the empty text if there is no fault.
std::string fault(std::string_view text) {
  const auto parsed = parse_quantity(text);
  const auto* fault = std::get_if<TextFault>(&parsed);
  if (fault == nullptr) return {};
  return std::to_string(fault->column) + ":" + std::to_string(fault->length) + ": " +
         fault->message;
}

TEST(Units, EachSymbolHasItsValueInSi) {
  struct Row {
    const char* symbol;
    double value;
    Dimension dimension;
  };
  // Written out by hand from the definitions; 1 lbf = 0.45359237 kg * 9.80665 m/s^2, and
  // 1 psi = 1 lbf / (0.0254 m)^2.
  const std::vector<Row> rows{
      {"m", 1, dim::length},
      {"cm", 0.01, dim::length},
      {"mm", 0.001, dim::length},
      {"um", 0.000001, dim::length},
      {"km", 1000, dim::length},
      {"in", 0.0254, dim::length},
      {"ft", 0.3048, dim::length},
      {"s", 1, dim::time},
      {"ms", 0.001, dim::time},
      {"us", 0.000001, dim::time},
      {"min", 60, dim::time},
      {"kg", 1, dim::mass},
      {"g", 0.001, dim::mass},
      {"t", 1000, dim::mass},
      {"lb", 0.45359237, dim::mass},
      {"N", 1, dim::force},
      {"kN", 1000, dim::force},
      {"kgf", 9.80665, dim::force},
      {"lbf", 4.4482216152605, dim::force},
      {"Pa", 1, dim::stress},
      {"kPa", 1e3, dim::stress},
      {"MPa", 1e6, dim::stress},
      {"GPa", 1e9, dim::stress},
      {"psi", 6894.757293168361, dim::stress},
      {"J", 1, dim::energy},
      {"kJ", 1000, dim::energy},
      {"Hz", 1, dim::frequency},
      {"rad", 1, dim::angle},
      {"deg", 0.017453292519943295, dim::angle},
      {"K", 1, dim::temperature},
  };
  for (const Row& row : rows) {
    const Quantity got = read(std::string("1 ") + row.symbol);
    EXPECT_DOUBLE_EQ(got.value, row.value) << row.symbol;
    EXPECT_EQ(got.dimension, row.dimension) << row.symbol;
    EXPECT_TRUE(got.has_unit) << row.symbol;
  }
  // DOUBLE_EQ allows four units in the last place; the definitions allow none.
  EXPECT_EQ(read("1 kgf").value, 9.80665);
  EXPECT_EQ(read("1 lbf").value, 4.4482216152605);
}

TEST(Units, DimensionsFollowFromTheBaseUnits) {
  EXPECT_EQ(dim::force, (Dimension{1, 1, -2, 0}));
  EXPECT_EQ(dim::energy, (Dimension{1, 2, -2, 0}));
  EXPECT_EQ(dim::stress, (Dimension{1, -1, -2, 0}));
  EXPECT_EQ(dim::penalty, (Dimension{1, -2, -2, 0}));
  EXPECT_EQ(dim::density, (Dimension{1, -3, 0, 0}));
  EXPECT_EQ(dim::viscosity, (Dimension{1, -1, -1, 0}));
}

TEST(Units, QuantitiesAreReadAsTyped) {
  struct Row {
    const char* text;
    double value;
    Dimension dimension;
  };
  const std::vector<Row> rows{
      {"1.13e-9 kgf*s^2/mm^4", 11081.5145, dim::density},  // 1.13e-9 * 9.80665 * 1e12
      {"13330 mm/s", 13.33, dim::speed},
      {"19.5 kgf/mm^2", 191229675, dim::stress},  // 19.5 * 9.80665 * 1e6
      {"8 ms", 0.008, dim::time},
      {"5e13 Pa/m", 5e13, dim::penalty},
      {"1/s", 1, dim::frequency},
      {"20 1/s", 20, dim::frequency},
      {"20 s^-1", 20, dim::frequency},
      {"7850 kg/m^3", 7850, dim::density},
      {"7850 kg m^-3", 7850, dim::density},
      {"7.85 g/cm^3", 7850, dim::density},
      {"9.81 (m/s)/s", 9.81, dim::acceleration},
      {"9.81 m/(s*s)", 9.81, dim::acceleration},
      {"2 (m/s)^2", 2, dim::speed * dim::speed},
      {"3 J/m/m/m", 3, dim::stress},
      {"1.5mm", 0.0015, dim::length},
      {"3*mm", 0.003, dim::length},
      {"-4 mm", -0.004, dim::length},
      {"+.5 m", 0.5, dim::length},
      {"5. m", 5, dim::length},
      {"1E3 m", 1000, dim::length},
      {" 2  m ^ 2 ", 2, dim::area},
      {"180 deg", std::numbers::pi, dim::angle},
      {"60 deg/min", std::numbers::pi / 180, dim::angular_speed},
      {"1 m^0*s", 1, dim::time},
  };
  for (const Row& row : rows) {
    const Quantity got = read(row.text);
    EXPECT_DOUBLE_EQ(got.value, row.value) << row.text;
    EXPECT_EQ(got.dimension, row.dimension) << row.text;
  }
}

TEST(Units, PlainNumbersHaveNoUnit) {
  for (const char* text : {"0", "-0.5", "1e3", "3.25", ".5"}) {
    EXPECT_FALSE(read(text).has_unit) << text;
    EXPECT_EQ(read(text).dimension, dim::none) << text;
  }
  EXPECT_EQ(read("0.1").value, 0.1);
  EXPECT_TRUE(read("1 mm/m").has_unit);
  EXPECT_EQ(read("1 mm/m").dimension, dim::none);
}

TEST(Units, DecimalPrefixesDoNotCostAnyDigit) {
  for (const int number : {1, 3, 7, 9, 11, 13330, 123457}) {
    const std::string digits = std::to_string(number);
    EXPECT_EQ(read(digits + " mm").value, number / 1e3) << digits;
    EXPECT_EQ(read(digits + " us").value, number / 1e6) << digits;
  }
}

TEST(Units, FaultsSayWhatAndWhere) {
  EXPECT_EQ(fault(""), "1:0: a number is needed");
  EXPECT_EQ(fault("mm"), "1:2: a number is needed");
  EXPECT_EQ(fault("1,5 mm"), "2:1: unexpected ',', the decimal sign is a point");
  EXPECT_EQ(fault("1_000 mm"), "2:1: unexpected '_'");
  EXPECT_EQ(fault("1d-3"), "2:1: unknown unit 'd'");
  EXPECT_EQ(fault("0x10"), "2:1: unknown unit 'x'");
  EXPECT_EQ(fault("210 Gpa"), "5:3: unknown unit 'Gpa', did you mean 'GPa'?");
  EXPECT_EQ(fault("20 degC"), "4:4: unknown unit 'degC', temperatures are in K");
  EXPECT_EQ(fault("5 J/(kg*C)"), "9:1: unknown unit 'C', temperatures are in K");
  EXPECT_EQ(fault("20 \xC2\xB0" "C"), "4:2: unexpected '\xC2\xB0', temperatures are in K and angles in deg or rad");
  EXPECT_EQ(fault("7850 kg/m3"), "9:2: a power needs '^', as in 'm^3'");
  EXPECT_EQ(fault("2 m^0.5"), "5:2: a power is a whole number");
  EXPECT_EQ(fault("2 m^"), "5:1: a power is a whole number");
  EXPECT_EQ(fault("2 m^12"), "5:2: a power is at most 9");
  EXPECT_EQ(fault("2 kg/m s"), "8:1: a blank behind '/' is ambiguous, write '*' or parentheses");
  EXPECT_EQ(fault("2 kg (m s"), "6:1: ')' is missing");
  EXPECT_EQ(fault("2 kg)"), "5:1: unexpected ')'");
  EXPECT_EQ(fault("2 kg/"), "6:0: the unit ends too early");
  EXPECT_EQ(fault("2 3 mm"), "3:1: unexpected '3'");
  EXPECT_EQ(fault("2 m**2"), "5:1: unexpected '*'");
  EXPECT_EQ(fault("2 \xC2\xB5m"), "3:2: unexpected '\xC2\xB5'");
  EXPECT_EQ(fault("010 mm"), "1:3: a leading zero could mean an octal number");
  EXPECT_EQ(fault("-010"), "2:3: a leading zero could mean an octal number");
}

TEST(Units, NumbersThatDoublePrecisionCannotHoldAreFaults) {
  EXPECT_EQ(fault("1e400 m"), "1:5: double precision cannot hold this number");
  EXPECT_EQ(fault("1e-400"), "1:6: double precision cannot hold this number");
  EXPECT_EQ(fault("1e305 GPa"), "1:9: double precision cannot hold this number");
  EXPECT_EQ(fault("1e-320 um"), "1:9: double precision cannot hold this number");
}

TEST(Units, NumbersAreFinite) {
  for (const char* text : {".nan", "nan", "NaN", ".inf", "-.inf", "inf", "Infinity", "-inf m"}) {
    EXPECT_NE(fault(text).find("a finite number is needed"), std::string::npos) << text;
  }
}

TEST(Units, NoTextExhaustsTheStackOrThePowers) {
  EXPECT_NE(fault("1 " + std::string(100000, '(')).find("too many parentheses"), std::string::npos);
  EXPECT_NE(fault("1 (((m^9)^9)^9)^9").find("the power is too large"), std::string::npos);
  EXPECT_NE(fault("1 ((km^9)^9)^9").find("the power is too large"), std::string::npos);
}

TEST(Units, DimensionsAreDescribedByBaseUnits) {
  EXPECT_EQ(describe(dim::penalty), "kg m^-2 s^-2");
  EXPECT_EQ(describe(dim::length), "m");
  EXPECT_EQ(describe(dim::angular_speed), "s^-1 rad");
  EXPECT_EQ(describe(dim::specific_heat), "m^2 s^-2 K^-1");
  EXPECT_EQ(describe(dim::none), "1");
}

TEST(Units, OutputUsesTheUnitsPeopleWrite) {
  EXPECT_EQ(si_unit(dim::penalty), "Pa/m");
  EXPECT_EQ(si_unit(dim::stress), "Pa");
  EXPECT_EQ(si_unit(dim::energy), "J");
  EXPECT_EQ(si_unit(dim::momentum), "kg m/s");
  EXPECT_EQ(si_unit(dim::area), "m^2");
  EXPECT_EQ(si_unit(dim::specific_heat), "J/(kg*K)");
  EXPECT_EQ(std::get<Quantity>(parse_quantity("1 " + si_unit(dim::specific_heat))).dimension, dim::specific_heat);
  EXPECT_EQ(si_unit(dim::none), "1");
  EXPECT_EQ(si_unit(dim::stress / dim::speed), "kg m^-2 s^-1");
}

TEST(Units, WhatIsWrittenReadsBackWithFactorOne) {
  for (int mass = -2; mass <= 2; ++mass) {
    for (int length = -4; length <= 4; ++length) {
      for (int time = -3; time <= 3; ++time) {
        for (int angle = -1; angle <= 1; ++angle) {
          const Dimension dimension{mass, length, time, angle};
          if (dimension == dim::none) continue;
          for (const std::string& unit : {si_unit(dimension), describe(dimension)}) {
            EXPECT_EQ(read("1 " + unit).dimension, dimension) << unit;
            EXPECT_EQ(read("1 " + unit).value, 1) << unit;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace nereid::input::units_test
