#include "input/table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/words.hpp"

namespace nereid::input {

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0;;) {
    const std::size_t comma = line.find(',', at);
    parts.push_back(trimmed(line.substr(at, comma - at)));
    if (comma == std::string_view::npos) return parts;
    at = comma + 1;
  }
}

/// A column of the header, as in "pressure [MPa]".
struct Column {
  std::string name;
  Dimension dimension;
  double unit = 1;    ///< in SI
  std::string wrong;  ///< what is wrong with it, or nothing
};

Column column_of(std::string_view head) {
  const std::size_t open = head.find('[');
  Column column{std::string(trimmed(head.substr(0, open))), dim::none, 1, ""};
  if (open == std::string_view::npos) return column;
  constexpr std::string_view mean = " mean";  // behind the unit, as histories mark means over time
  if (head.ends_with(mean)) head = trimmed(head.substr(0, head.size() - mean.size()));
  if (head.back() != ']') {
    column.wrong = "expected ']' at the end of " + quote(head);
    return column;
  }
  const std::string unit(trimmed(head.substr(open + 1, head.size() - open - 2)));
  if (unit == "1") return column;
  const auto parsed = parse_quantity("1 " + unit);
  if (const auto* fault = std::get_if<TextFault>(&parsed)) {
    column.wrong = "cannot read the unit of " + quote(head) + ": " + fault->message;
    return column;
  }
  column.dimension = std::get<Quantity>(parsed).dimension, column.unit = std::get<Quantity>(parsed).value;
  return column;
}

/// The place of the column of values, or what is wrong.
std::variant<std::size_t, std::string> place_of_values(const std::vector<Column>& columns, std::string_view name) {
  if (columns.size() < 2) return "expected two columns, as in 'time [ms], pressure [MPa]'";
  if (name.empty()) {
    if (columns.size() == 2) return std::size_t{1};
    return "there are " + std::to_string(columns.size() - 1) + " columns of values: name one behind the file, as in " +
           quote("file.csv:" + columns[1].name);
  }
  std::vector<std::string> names;
  for (std::size_t c = 1; c < columns.size(); ++c) names.push_back(columns[c].name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin()) + 1;
  const std::string hint = nearest(name, names);
  return "there is no column " + quote(name) + ": columns are " + listed(names) + (hint.empty() ? "" : "; " + hint);
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::variant<Table, std::string> parse_table(std::string_view text, std::string_view column) {
  constexpr std::string_view mark = "\xef\xbb\xbf";  // of UTF-8, which spreadsheets write
  if (text.substr(0, mark.size()) == mark) text.remove_prefix(mark.size());
  if (const std::size_t at = find_unprintable(text); at != std::string_view::npos)
    return "line " + std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) +
           ": it has a byte that is neither UTF-8 nor printable";
  Table table;
  std::vector<Column> columns;
  std::size_t of_values = 0;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    const std::string_view row = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (row.empty() || row.front() == '#') continue;
    const auto wrong = [line](const std::string& why) { return "line " + std::to_string(line) + ": " + why; };
    const std::vector<std::string_view> parts = split(row);
    if (columns.empty()) {
      for (const std::string_view part : parts) columns.push_back(column_of(part));
      const auto place = place_of_values(columns, column);
      if (const auto* why = std::get_if<std::string>(&place)) return wrong(*why);
      of_values = std::get<std::size_t>(place);
      for (const Column& one : {columns[0], columns[of_values]})
        if (!one.wrong.empty()) return wrong(one.wrong);
      table.of_argument = columns[0].dimension, table.of_value = columns[of_values].dimension;
      continue;
    }
    if (parts.size() != columns.size())
      return wrong(counted(parts.size(), "value") + ": expected " + std::to_string(columns.size()) + " as in the first line");
    std::array<double, 2> point;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t place = i == 0 ? 0 : of_values;
      const std::optional<double> read = number(parts[place]);
      point[i] = read ? *read * columns[place].unit : 0;
      if (!read || !std::isfinite(point[i])) return wrong(quote(clipped(parts[place], 40)) + " is no finite number");
    }
    if (!table.argument.empty() && !(point[0] > table.argument.back()))
      return wrong(quote(columns[0].name) + " does not grow: expected more than in the line before");
    table.argument.push_back(point[0]), table.value.push_back(point[1]);
  }
  if (columns.empty()) return "it is empty: expected a first line as in 'time [ms], pressure [MPa]'";
  if (table.argument.empty()) return "it has no line of numbers";
  return table;
}

double value_at(const Table& table, double argument) {
  const auto behind = std::upper_bound(table.argument.begin(), table.argument.end(), argument);
  if (behind == table.argument.begin()) return table.value.front();
  if (behind == table.argument.end()) return std::isnan(argument) ? argument : table.value.back();
  const auto i = static_cast<std::size_t>(behind - table.argument.begin());
  const double part = (argument - table.argument[i - 1]) / (table.argument[i] - table.argument[i - 1]);
  return table.value[i - 1] + part * (table.value[i] - table.value[i - 1]);
}

}  // namespace nereid::input
