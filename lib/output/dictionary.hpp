#pragma once
// What results, columns of histories, fields of frames and members of summary.json are called and mean.

#include <string>
#include <vector>

namespace nereid::output {

/// One of them.
struct Described {
  std::string name;     ///< capitals stand for names of the scene, as in "CONTACT_deepest"
  std::string unit;     ///< SI; empty: that of the probe, or no quantity
  std::string meaning;  ///< one sentence or two, with the sign
  /// Of results and columns: the programs that have it; empty: every one that makes steps. Of fields: the data set, and whether its points,
  /// its cells or the whole file have it, as in "body, cells".
  std::string of = {};
};

const std::vector<Described>& described_results();
const std::vector<Described>& described_columns();
const std::vector<Described>& described_fields();
/// Members of summary.json, with dots between members of members.
const std::vector<Described>& described_summary();

}  // namespace nereid::output
