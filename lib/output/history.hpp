#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace nereid::output {

/// One column of a history.
struct Column {
  std::string name;  ///< letters, digits, underscore, points
  std::string unit;  ///< "Pa", "m", "1" for a pure number
  bool is_mean = false;  ///< over the time since the row before; else the value at the row
};

/// The first line of a history, with the word `mean` behind the unit of a mean; and one more of its lines.
std::string head_text(const std::vector<Column>& columns, const Column& first = {"time", "s"});
void append_row(double first, std::span<const double> row, std::string& text);

/// A table over time as CSV: `time [s],settlement_mean [m],...`, one row per add(); or over another number.
///
/// Numbers have 17 digits, so that reading them gives the same bits; what is no number is `nan`.
/// Rows reach the disk at flush(), which belongs beside the frames, and when the history goes. Where the disk takes no more, the file ends
/// behind a whole row.
///
/// Invariants  equal rows give equal bytes.
class History {
 public:
  /// columns  those after the first
  History(std::filesystem::path file, std::vector<Column> columns, const Column& first = {"time", "s"});
  /// Goes on with a file after so many of its bytes; the rest is dropped. MachineError where it has fewer, or writing fails.
  History(std::filesystem::path file, std::vector<Column> columns, std::uint64_t bytes);
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// first: time [s], or what the first column is; row in the order of the columns. MachineError where writing fails.
  void add(double first, std::span<const double> row);
  /// Puts all rows on the disk. MachineError where that fails.
  void flush();
  /// Of the file, after flush().
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::filesystem::path file_;
  std::size_t columns_;
  std::uint64_t bytes_ = 0;  ///< on the disk
  std::string lines_;        ///< not yet there
};

}  // namespace nereid::output
