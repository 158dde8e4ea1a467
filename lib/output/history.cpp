#include "output/history.hpp"

#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include "base/check.hpp"
#include "base/replace_file.hpp"

namespace nereid::output {

namespace {

constexpr std::size_t enough = 1 << 16;  // [bytes] one write to the disk for some hundred rows

/// As printf's %.17g, but in every locale.
void append_number(double value, std::string& text) {
  if (std::isnan(value)) {
    text += "nan";  // never "-nan": the sign of a NaN differs between compilers
    return;
  }
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17);
  text.append(digits, end.ptr);
}

void check_columns(const std::vector<Column>& columns, const std::string& first) {
  std::set<std::string> names{first};
  for (const Column& column : columns) {
    if (column.name.empty() ||
        (column.name + column.unit).find_first_of(",\"\n\r[]") != std::string::npos)
      throw InternalError("history: '" + column.name + " [" + column.unit + "]' is no column name");
    if (!names.insert(column.name).second)
      throw InternalError("history: column '" + column.name + "' comes twice");
  }
}

}  // namespace

std::string head_text(const std::vector<Column>& columns, const Column& first) {
  std::string text = first.name + " [" + first.unit + "]";
  for (const Column& column : columns) text += "," + column.name + " [" + column.unit + "]" + (column.is_mean ? " mean" : "");
  return text + "\n";
}

void append_row(double first, std::span<const double> row, std::string& text) {
  append_number(first, text);
  for (const double value : row) {
    text += ',';
    append_number(value, text);
  }
  text += '\n';
}

History::History(std::filesystem::path file, std::vector<Column> columns, const Column& first)
    : file_(std::move(file)), columns_(columns.size()) {
  check_columns(columns, first.name);
  if (file_.has_parent_path()) make_folder(file_.parent_path());
  const std::string head = head_text(columns, first);
  append_to_file(file_, 0, head);
  bytes_ = head.size();
}

History::History(std::filesystem::path file, std::vector<Column> columns, std::uint64_t bytes)
    : file_(std::move(file)), columns_(columns.size()), bytes_(bytes) {
  std::error_code error;
  const auto there = std::filesystem::file_size(file_, error);
  if (error || there < bytes) throw MachineError(file_.string() + " has not the rows that a checkpoint counts on");
  append_to_file(file_, bytes, "");
}

History::~History() {
  try {
    flush();
  } catch (const MachineError&) {
    // A destructor must not throw; who needs to know has called flush().
  }
}

void History::add(double first, std::span<const double> row) {
  if (row.size() != columns_)
    throw InternalError("history: a row of " + std::to_string(row.size()) + " values for " +
                        std::to_string(columns_) + " columns");
  append_row(first, row, lines_);
  if (lines_.size() > enough) flush();
}

void History::flush() {
  if (lines_.empty()) return;
  append_to_file(file_, bytes_, lines_);
  bytes_ += lines_.size();
  lines_.clear();
}

}  // namespace nereid::output
