#include "input/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>

namespace nereid::input {
namespace {

constexpr double standard_gravity = 9.80665;       // [m/s2] exact, 3rd CGPM 1901
constexpr double pound = 0.45359237;               // [kg] exact, international pound 1959
constexpr double inch = 0.0254;                    // [m] exact, 1959
constexpr double pound_force = 4.4482216152605;    // [N] exact product of the two above
constexpr double degree = std::numbers::pi / 180;  // [rad]

/// A unit is `over / under` of its SI unit: a quotient of two exact numbers, because 7 / 1000 is
/// the double nearest to 7 mm and 7 * 0.001 need not be.
struct Unit {
  double over = 1, under = 1;
  Dimension dimension;
};

struct Symbol {
  std::string_view name;
  Unit unit;
};

constexpr std::array symbols{
    Symbol{"m", {1, 1, dim::length}},
    Symbol{"cm", {1, 100, dim::length}},
    Symbol{"mm", {1, 1e3, dim::length}},
    Symbol{"um", {1, 1e6, dim::length}},
    Symbol{"km", {1e3, 1, dim::length}},
    Symbol{"in", {inch, 1, dim::length}},
    Symbol{"ft", {12 * inch, 1, dim::length}},
    Symbol{"s", {1, 1, dim::time}},
    Symbol{"ms", {1, 1e3, dim::time}},
    Symbol{"us", {1, 1e6, dim::time}},
    Symbol{"min", {60, 1, dim::time}},
    Symbol{"kg", {1, 1, dim::mass}},
    Symbol{"g", {1, 1e3, dim::mass}},
    Symbol{"t", {1e3, 1, dim::mass}},
    Symbol{"lb", {pound, 1, dim::mass}},
    Symbol{"N", {1, 1, dim::force}},
    Symbol{"kN", {1e3, 1, dim::force}},
    Symbol{"kgf", {standard_gravity, 1, dim::force}},
    Symbol{"lbf", {pound_force, 1, dim::force}},
    Symbol{"Pa", {1, 1, dim::stress}},
    Symbol{"kPa", {1e3, 1, dim::stress}},
    Symbol{"MPa", {1e6, 1, dim::stress}},
    Symbol{"GPa", {1e9, 1, dim::stress}},
    Symbol{"psi", {pound_force, inch* inch, dim::stress}},
    Symbol{"J", {1, 1, dim::energy}},
    Symbol{"kJ", {1e3, 1, dim::energy}},
    Symbol{"W", {1, 1, dim::power}},
    Symbol{"kW", {1e3, 1, dim::power}},
    Symbol{"Hz", {1, 1, dim::frequency}},
    Symbol{"rad", {1, 1, dim::angle}},
    Symbol{"deg", {degree, 1, dim::angle}},
    Symbol{"K", {1, 1, dim::temperature}},
};

/// What people write for temperatures, in small letters. Most have another zero, so that no factor leads to K.
constexpr std::array<std::string_view, 8> other_temperatures{"degc", "degf", "c", "f", "celsius", "fahrenheit", "kelvin", "degk"};

constexpr const char* beyond_precision = "double precision cannot hold this number";

constexpr int largest_power = 9;      // of one symbol; more is a slip of the finger
constexpr int largest_exponent = 99;  // of a whole expression, so that sums of powers stay small
constexpr int deepest_nesting = 16;   // of parentheses, so that no text can exhaust the stack

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string quote(std::string_view text) { return "'" + std::string(text) + "'"; }

Unit multiply(const Unit& a, const Unit& b) {
  return {a.over * b.over, a.under * b.under, a.dimension * b.dimension};
}

Unit inverse(const Unit& a) { return {a.under, a.over, dim::none / a.dimension}; }

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Quantity quantity() {
    skip_blanks();
    const double number = this->number();
    skip_blanks();
    if (at_end()) return {number, dim::none, false};
    const Unit unit = expression(0);
    if (!at_end()) fail_here();
    const double value = number * unit.over / unit.under;
    if (!std::isfinite(value) || (value == 0 && number != 0))
      fail(0, text_.size(), beyond_precision);
    return {value, unit.dimension, true};
  }

 private:
  [[noreturn]] static void fail(std::size_t from, std::size_t length, std::string message) {
    throw TextFault{static_cast<int>(from) + 1, static_cast<int>(length), std::move(message)};
  }

  [[noreturn]] void fail_here() {
    if (at_end()) fail(at_, 0, "the unit ends too early");
    std::size_t end = at_ + 1;  // a character outside ASCII is shown with all its bytes
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) ++end;
    std::string message = "unexpected " + quote(text_.substr(at_, end - at_));
    if (text_[at_] == ',') message += ", the decimal sign is a point";
    if (text_.substr(at_, end - at_) == "\xC2\xB0") message += ", temperatures are in K and angles in deg or rad";  // the degree sign
    fail(at_, end - at_, std::move(message));
  }

  bool at_end() const { return at_ >= text_.size(); }
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void skip_blanks() {
    while (is_blank(peek())) ++at_;
  }
  void skip_digits() {
    while (is_digit(peek())) ++at_;
  }

  double number() {
    const std::size_t start = at_;
    if (peek() == '+' || peek() == '-') ++at_;
    const std::size_t digits = at_;
    skip_digits();
    const std::size_t whole = at_ - digits;
    std::size_t fraction = 0;
    if (peek() == '.') {
      ++at_;
      skip_digits();
      fraction = at_ - digits - whole - 1;
    }
    if (whole + fraction == 0) fail_as_number(start);
    if (whole > 1 && text_[digits] == '0') {
      fail(digits, whole, "a leading zero could mean an octal number");
    }
    if (peek() == 'e' || peek() == 'E') {
      const std::size_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
      if (is_digit(peek(1 + sign))) {
        at_ += 1 + sign;
        skip_digits();
      }
    }
    const std::size_t from = text_[start] == '+' ? start + 1 : start;  // from_chars knows no '+'
    double value = 0;
    const auto result = std::from_chars(text_.data() + from, text_.data() + at_, value);
    if (result.ec == std::errc::result_out_of_range) fail(start, at_ - start, beyond_precision);
    return value;
  }

  [[noreturn]] void fail_as_number(std::size_t start) {
    std::size_t end = start;
    while (end < text_.size() && !is_blank(text_[end])) ++end;
    std::string word = lower(text_.substr(start, end - start));
    if (!word.empty() && (word[0] == '+' || word[0] == '-')) word.erase(0, 1);
    if (!word.empty() && word[0] == '.') word.erase(0, 1);
    const bool is_infinite = word == "nan" || word == "inf" || word == "infinity";
    fail(start, end - start, is_infinite ? "a finite number is needed" : "a number is needed");
  }

  Unit expression(int depth) {
    if (depth > deepest_nesting) fail(at_, 1, "too many parentheses");
    Unit result;
    bool divide = false, divided = false;
    if (depth == 0 && take('/')) {
      divide = divided = true;  // as in 1/s
    } else if (depth == 0) {
      take('*');
    }
    while (true) {
      skip_blanks();
      const std::size_t start = at_;
      const Unit factor = power(depth);
      result = multiply(result, divide ? inverse(factor) : factor);
      check_size(result, start);
      const std::size_t end = at_;
      skip_blanks();
      if (at_end() || peek() == ')') return result;
      if (take('*')) {
        divide = false;
      } else if (take('/')) {
        divide = divided = true;
      } else if (at_ > end && (is_letter(peek()) || peek() == '(')) {
        if (divided) fail(at_, 1, "a blank behind '/' is ambiguous, write '*' or parentheses");
        divide = false;
      } else {
        fail_here();
      }
    }
  }

  Unit power(int depth) {
    const std::size_t start = at_;
    const Unit base = atom(depth);
    const std::size_t end = at_;
    skip_blanks();
    if (!take('^')) {
      at_ = end;  // the blank may stand for a product
      return base;
    }
    skip_blanks();
    const std::size_t sign = at_;
    const bool negative = take('-');
    if (!negative) take('+');
    const std::size_t digits = at_;
    skip_digits();
    if (at_ == digits || peek() == '.') fail(sign, at_ - sign + 1, "a power is a whole number");
    int exponent = 0;
    std::from_chars(text_.data() + digits, text_.data() + at_, exponent);
    if (exponent > largest_power || at_ - digits > 1)
      fail(sign, at_ - sign, "a power is at most 9");
    Unit result;
    for (int factor = 0; factor < exponent; ++factor) result = multiply(result, base);
    check_size(result, start);
    return negative ? inverse(result) : result;
  }

  Unit atom(int depth) {
    const std::size_t start = at_;
    if (take('(')) {
      const Unit inside = expression(depth + 1);
      if (!take(')')) fail(start, 1, "')' is missing");
      return inside;
    }
    if (peek() == '1' && !is_digit(peek(1)) && peek(1) != '.') {
      ++at_;  // as in 20 1/s
      return {};
    }
    while (is_letter(peek())) ++at_;
    if (at_ == start) fail_here();
    const std::string_view name = text_.substr(start, at_ - start);
    const auto* found = std::find_if(symbols.begin(), symbols.end(),
                                     [&](const Symbol& symbol) { return symbol.name == name; });
    if (found != symbols.end() && !is_digit(peek())) return found->unit;
    if (found != symbols.end()) {
      const std::size_t digits = at_;
      skip_digits();
      fail(start, at_ - start,
           "a power needs '^', as in " +
               quote(std::string(name) + "^" + std::string(text_.substr(digits, at_ - digits))));
    }
    std::string message = "unknown unit " + quote(name);
    if (std::find(other_temperatures.begin(), other_temperatures.end(), lower(name)) != other_temperatures.end())
      fail(start, name.size(), message + ", temperatures are in K");
    for (const Symbol& symbol : symbols) {
      if (lower(symbol.name) == lower(name)) {
        message += ", did you mean " + quote(symbol.name) + "?";
        break;
      }
    }
    fail(start, name.size(), std::move(message));
  }

  void check_size(const Unit& unit, std::size_t start) const {
    for (const int exponent :
         {unit.dimension.mass, unit.dimension.length, unit.dimension.time, unit.dimension.angle,
          unit.dimension.temperature}) {
      if (std::abs(exponent) > largest_exponent) fail(start, at_ - start, "the power is too large");
    }
    for (const double factor : {unit.over, unit.under}) {
      if (!std::isnormal(factor)) fail(start, at_ - start, "the power is too large");
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

struct Name {
  Dimension dimension;
  std::string_view unit;
};

constexpr std::array names{
    Name{dim::speed, "m/s"},
    Name{dim::acceleration, "m/s^2"},
    Name{dim::frequency, "1/s"},
    Name{dim::angular_speed, "rad/s"},
    Name{dim::density, "kg/m^3"},
    Name{dim::areal_density, "kg/m^2"},
    Name{dim::momentum, "kg m/s"},
    Name{dim::force, "N"},
    Name{dim::energy, "J"},
    Name{dim::power, "J/s"},
    Name{dim::stress, "Pa"},
    Name{dim::penalty, "Pa/m"},
    Name{dim::stiffness, "N/m"},
    Name{dim::viscosity, "Pa s"},
    Name{dim::curvature, "1/m"},
    Name{dim::slowness, "s/m"},
    Name{dim::specific_heat, "J/(kg*K)"},
    Name{dim::stress / dim::area, "Pa/m^2"},
    Name{dim::mass / dim::time, "kg/s"},
};

}  // namespace

std::variant<Quantity, TextFault> parse_quantity(std::string_view text) {
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  try {
    return Parser(text).quantity();
  } catch (TextFault& fault) {
    return std::move(fault);
  }
}

std::string describe(Dimension dimension) {
  std::string result;
  const auto add = [&](std::string_view symbol, int exponent) {
    if (exponent == 0) return;
    if (!result.empty()) result += ' ';
    result += symbol;
    if (exponent != 1) result += "^" + std::to_string(exponent);
  };
  add("kg", dimension.mass);
  add("m", dimension.length);
  add("s", dimension.time);
  add("rad", dimension.angle);
  add("K", dimension.temperature);
  return result.empty() ? "1" : result;
}

std::string si_unit(Dimension dimension) {
  for (const Name& name : names) {
    if (name.dimension == dimension) return std::string(name.unit);
  }
  return describe(dimension);
}

}  // namespace nereid::input
