#include "input/expression.hpp"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "base/checksum.hpp"
#include "base/types.hpp"
#include "base/words.hpp"
#include "input/table.hpp"
#include "input/text_file.hpp"

namespace nereid::input {

namespace {

/// A parser with the variables and tables it is bound to; it must stay where it is.
struct Bound {
  mu::Parser parser;
  double x = 0, y = 0, z = 0, t = 0;
  std::map<std::string, Table> tables;
  double unit = 1;  ///< in which these answer
};

/// What muParser calls for table("name", argument).
double ask_table(void* bound, const char* name, double argument) {
  const auto& [parser, x, y, z, t, tables, unit] = *static_cast<const Bound*>(bound);
  const auto found = tables.find(name);
  return found == tables.end() ? std::nan("") : value_at(found->second, argument) / unit;
}

/// The names of files in a text, as in table("slug.csv", t), with where they stand.
std::vector<std::pair<std::string, std::size_t>> named_tables(const std::string& text) {
  std::vector<std::pair<std::string, std::size_t>> names;
  constexpr std::string_view word = "table", blanks = " \t\n";
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t open = text.find_first_not_of(blanks, at + word.size());
    if (open == std::string::npos || text[open] != '(') continue;
    const std::size_t quoted = text.find_first_not_of(blanks, open + 1);
    if (quoted == std::string::npos || text[quoted] != '"') continue;
    const std::size_t end = text.find('"', quoted + 1);
    if (end != std::string::npos) names.emplace_back(text.substr(quoted + 1, end - quoted - 1), quoted + 1);
  }
  return names;
}

/// The file of a name such as "slug.csv" or "slug.csv:pressure", and its table, or what is wrong with it.
std::pair<std::string, std::variant<Table, std::string>> named_table(const std::string& name, const ReadFile& read) {
  const std::size_t colon = name.rfind(':');
  const std::string file = name.substr(0, colon), column = colon == std::string::npos ? "" : name.substr(colon + 1);
  std::string why = "tables cannot be read here";
  const std::optional<std::string> bytes = read ? read(file, why) : std::nullopt;
  if (!bytes) return {file, quote(file) + ": " + why};
  auto parsed = parse_table(*bytes, column);
  if (const auto* wrong = std::get_if<std::string>(&parsed)) return {file, quote(file) + ": " + *wrong};
  return {file, std::move(parsed)};
}

/// Reads the table of a name into those that an expression uses; what is wrong with it.
std::string read_table(const std::string& name, Variables variables, const InUnit& unit, const ReadFile& read,
                       std::map<std::string, Table>& tables) {
  const auto [file, parsed] = named_table(name, read);
  if (const auto* wrong = std::get_if<std::string>(&parsed)) return *wrong;
  const Table& table = std::get<Table>(parsed);
  const bool of_time = variables.time && table.of_argument == dim::time, of_place = variables.place && table.of_argument == dim::length;
  const bool of_volume = variables.volume && table.of_argument == dim::volume;
  if (!of_time && !of_place && !of_volume)
    return quote(file) + ": the first column has the dimension [" + describe(table.of_argument) + "]: expected a " +
           (variables.volume ? "volume" : variables.time ? variables.place ? "time or a length" : "time" : "length");
  if (!(table.of_value == unit.dimension))
    return quote(file) + ": its values have the dimension [" + describe(table.of_value) + "]: expected [" + describe(unit.dimension) +
           "], for example '" + si_unit(unit.dimension) + "'";
  tables[name] = table;
  return "";
}

std::string allowed(Variables variables) {
  return std::string(variables.place ? "x, y, z, " : "") + (variables.time ? "t, " : "") + (variables.volume ? "v, " : "") + "pi";
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
TextFault fault_of(const mu::Parser::exception_type& error, const std::string& text, const std::string& variables) {
  const auto length = static_cast<int>(text.size());
  const std::string token = error.GetToken();
  int column = std::min(std::max(error.GetPos(), 0), length) + 1;
  // muParser's place is that of the token, or behind it
  const auto found = token.empty() ? std::string::npos : text.rfind(token, static_cast<std::size_t>(column - 1));
  if (found != std::string::npos) column = static_cast<int>(found) + 1;
  const int extent = std::max(1, std::min(static_cast<int>(token.size()), length - column + 1));
  if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
    return {column, extent, "'" + token + "' is unknown: expected " + variables + ", or a function such as sin, min, exp"};
  std::string message = error.GetMsg();
  while (!message.empty() && (message.back() == '.' || message.back() == '\n')) message.pop_back();
  if (!message.empty() && message[0] >= 'A' && message[0] <= 'Z') message[0] = static_cast<char>(message[0] - 'A' + 'a');
  return {column, extent, message};
}

}  // namespace

std::variant<Expression, TextFault> parse_expression(const std::string& text, Variables variables, const InUnit& unit,
                                                     const ReadFile& read) {
  if (const auto fault = find_assignment(text)) return *fault;
  const auto bound = std::make_shared<Bound>();
  bound->unit = unit.size;
  for (const auto& [name, at] : named_tables(text)) {
    const std::string wrong = read_table(name, variables, unit, read, bound->tables);
    if (!wrong.empty()) return TextFault{static_cast<int>(at) + 1, static_cast<int>(std::max<std::size_t>(1, name.size())), wrong};
  }
  try {
    bound->parser.ClearConst();
    bound->parser.DefineConst("pi", pi);
    bound->parser.DefineFunUserData("table", ask_table, bound.get(), false);
    if (variables.place) {
      bound->parser.DefineVar("x", &bound->x);
      bound->parser.DefineVar("y", &bound->y);
      bound->parser.DefineVar("z", &bound->z);
    }
    if (variables.time) bound->parser.DefineVar("t", &bound->t);
    if (variables.volume) bound->parser.DefineVar("v", &bound->t);
    bound->parser.SetExpr(text);
    int values = 0;
    bound->parser.Eval(values);
    if (values != 1) return TextFault{1, static_cast<int>(text.size()), "these are " + std::to_string(values) + " values: expected one"};
  } catch (const mu::Parser::exception_type& error) {
    return fault_of(error, text, allowed(variables));
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

/// Reads the files that the expressions of a key name, each once.
ReadFile files_of(const Section& section, std::string_view key) {
  const auto known = std::make_shared<std::map<std::string, std::string>>();
  return [section, key = std::string(key), known](const std::string& name, std::string& why) -> std::optional<std::string> {
    const auto found = known->find(name);
    if (found != known->end()) return found->second;
    const std::optional<std::string> bytes = read_text(section.beside_case(key, name), why);
    if (bytes) section.saw(key, name, checksum(*bytes)), (*known)[name] = *bytes;
    return bytes;
  };
}

Section::TextCheck check_for(Variables variables, const InUnit& unit, const ReadFile& read) {
  return [=](const std::string& text) -> std::optional<TextFault> {
    const auto parsed = parse_expression(text, variables, unit, read);
    if (const auto* fault = std::get_if<TextFault>(&parsed)) return *fault;
    return std::nullopt;
  };
}

Expression in_si(const std::string& text, Variables variables, const InUnit& unit, const ReadFile& read) {
  auto expression = std::get<Expression>(parse_expression(text, variables, unit, read));
  if (unit.size == 1) return expression;
  return [expression, size = unit.size](double x, double y, double z, double t) { return size * expression(x, y, z, t); };
}

}  // namespace

Expression read_expression(const Section& section, std::string_view key, Variables variables, const InUnit& unit) {
  const ReadFile read = files_of(section, key);
  return in_si(section.text(key, check_for(variables, unit, read)), variables, unit, read);
}

std::array<Expression, 3> read_expressions(const Section& section, std::string_view key, Variables variables, const InUnit& unit) {
  const ReadFile read = files_of(section, key);
  const std::array<std::string, 3> texts = section.texts(key, check_for(variables, unit, read));
  return {in_si(texts[0], variables, unit, read), in_si(texts[1], variables, unit, read), in_si(texts[2], variables, unit, read)};
}

std::optional<Table> read_table(const Section& section, std::string_view key, const std::string& name) {
  const auto parsed = named_table(name, files_of(section, key)).second;
  if (const auto* wrong = std::get_if<std::string>(&parsed)) {
    section.fault(key, *wrong);
    return std::nullopt;
  }
  return std::get<Table>(parsed);
}

std::variant<FormulaText, TextFault> parse_formula(const std::string& text, const std::vector<std::string>& names) {
  if (const auto fault = find_assignment(text)) return *fault;
  struct Variables {
    mu::Parser parser;
    std::vector<double> inputs;
    double t = 0;
  };
  const auto bound = std::make_shared<Variables>();
  FormulaText formula;
  try {
    bound->parser.ClearConst();
    bound->parser.DefineConst("pi", pi);
    bound->parser.DefineVar("t", &bound->t);
    std::vector<double> all(names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] != "t" && names[i] != "pi") bound->parser.DefineVar(names[i], &all[i]);
    bound->parser.SetExpr(text);
    const auto used = bound->parser.GetUsedVar();
    for (const std::string& name : names)
      if (name != "t" && used.count(name) > 0) formula.inputs.push_back(name);
    bound->inputs.resize(formula.inputs.size());
    bound->parser.ClearVar();
    bound->parser.DefineVar("t", &bound->t);
    for (std::size_t i = 0; i < formula.inputs.size(); ++i) bound->parser.DefineVar(formula.inputs[i], &bound->inputs[i]);
    int values = 0;
    bound->parser.Eval(values);
    if (values != 1) return TextFault{1, static_cast<int>(text.size()), "these are " + std::to_string(values) + " values: expected one"};
  } catch (const mu::Parser::exception_type& error) {
    return fault_of(error, text, "t, pi or a probe above this one" + (names.empty() ? std::string() : " (" + listed(names) + ")"));
  }
  formula.value = [bound](const std::vector<double>& inputs, double t) {
    bound->inputs = inputs, bound->t = t;
    try {
      return bound->parser.Eval();
    } catch (const mu::Parser::exception_type&) {
      return std::nan("");
    }
  };
  return formula;
}

FormulaText read_formula(const Section& section, std::string_view key, const std::vector<std::string>& names) {
  const auto check = [&names](const std::string& text) -> std::optional<TextFault> {
    const auto parsed = parse_formula(text, names);
    if (const auto* fault = std::get_if<TextFault>(&parsed)) return *fault;
    return std::nullopt;
  };
  return std::get<FormulaText>(parse_formula(section.text(key, check), names));
}

}  // namespace nereid::input
