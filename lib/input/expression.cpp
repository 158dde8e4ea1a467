#include "input/expression.hpp"

#include <muParser.h>

#include <cmath>
#include <memory>

#include "base/types.hpp"

namespace nereid::input {

namespace {

/// A parser with the variables it is bound to; it must stay where it is.
struct Bound {
  mu::Parser parser;
  double x = 0, y = 0, z = 0, t = 0;
};

std::string allowed(Variables variables) {
  return std::string(variables.place ? "x, y, z, " : "") + (variables.time ? "t, " : "") + "pi";
}

/// muParser takes `t = 3` for an assignment to a variable; a text that does not compare is meant to.
std::optional<TextFault> find_assignment(const std::string& text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '=') continue;
    const bool second = at > 0 && std::string("=<>!").find(text[at - 1]) != std::string::npos;
    const bool first = at + 1 < text.size() && text[at + 1] == '=';
    if (!second && !first) return TextFault{static_cast<int>(at) + 1, 1, "an expression assigns nothing: '==' compares"};
    if (first) ++at;
  }
  return std::nullopt;
}

/// The fault of the parser, in our words where the variables are concerned.
TextFault fault_of(const mu::Parser::exception_type& error, const std::string& text, Variables variables) {
  const auto length = static_cast<int>(text.size());
  const std::string token = error.GetToken();
  int column = std::min(std::max(error.GetPos(), 0), length) + 1;
  // muParser's place is that of the token, or behind it
  const auto found = token.empty() ? std::string::npos : text.rfind(token, static_cast<std::size_t>(column - 1));
  if (found != std::string::npos) column = static_cast<int>(found) + 1;
  const int extent = std::max(1, std::min(static_cast<int>(token.size()), length - column + 1));
  if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
    return {column, extent, "'" + token + "' is unknown: expected " + allowed(variables) + ", or a function such as sin, min, exp"};
  std::string message = error.GetMsg();
  while (!message.empty() && (message.back() == '.' || message.back() == '\n')) message.pop_back();
  if (!message.empty() && message[0] >= 'A' && message[0] <= 'Z') message[0] = static_cast<char>(message[0] - 'A' + 'a');
  return {column, extent, message};
}

}  // namespace

std::variant<Expression, TextFault> parse_expression(const std::string& text, Variables variables) {
  if (const auto fault = find_assignment(text)) return *fault;
  const auto bound = std::make_shared<Bound>();
  try {
    bound->parser.ClearConst();
    bound->parser.DefineConst("pi", pi);
    if (variables.place) {
      bound->parser.DefineVar("x", &bound->x);
      bound->parser.DefineVar("y", &bound->y);
      bound->parser.DefineVar("z", &bound->z);
    }
    if (variables.time) bound->parser.DefineVar("t", &bound->t);
    bound->parser.SetExpr(text);
    int values = 0;
    bound->parser.Eval(values);
    if (values != 1) return TextFault{1, static_cast<int>(text.size()), "these are " + std::to_string(values) + " values: expected one"};
  } catch (const mu::Parser::exception_type& error) {
    return fault_of(error, text, variables);
  }
  return Expression([bound](double x, double y, double z, double t) {
    bound->x = x, bound->y = y, bound->z = z, bound->t = t;
    try {
      return bound->parser.Eval();
    } catch (const mu::Parser::exception_type&) {
      return std::nan("");  // ends the run as any value that is no number
    }
  });
}

namespace {

Section::TextCheck check_for(Variables variables) {
  return [variables](const std::string& text) -> std::optional<TextFault> {
    const auto parsed = parse_expression(text, variables);
    if (const auto* fault = std::get_if<TextFault>(&parsed)) return *fault;
    return std::nullopt;
  };
}

Expression in_unit(const std::string& text, Variables variables, double unit) {
  auto expression = std::get<Expression>(parse_expression(text, variables));
  if (unit == 1) return expression;
  return [expression, unit](double x, double y, double z, double t) { return unit * expression(x, y, z, t); };
}

}  // namespace

Expression read_expression(const Section& section, std::string_view key, Variables variables, double unit) {
  return in_unit(section.text(key, check_for(variables)), variables, unit);
}

std::array<Expression, 3> read_expressions(const Section& section, std::string_view key, Variables variables, double unit) {
  const std::array<std::string, 3> texts = section.texts(key, check_for(variables));
  return {in_unit(texts[0], variables, unit), in_unit(texts[1], variables, unit), in_unit(texts[2], variables, unit)};
}

}  // namespace nereid::input
