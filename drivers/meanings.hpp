#pragma once
// What the keys of cases mean, a sentence and an example each.

#include <string_view>
#include <vector>

namespace nereid::driver {

/// One entry: the end of a path, so that "material.young" is that of every material. Or program and path, as in "sliding:gravity".
struct MeaningOfPath {
  std::string_view path;
  std::string_view text;            ///< one sentence or two
  std::string_view example;         ///< as a case has it, as in "young: 210 GPa"
  std::string_view otherwise = {};  ///< the default in words, where it is no single value; empty: as the reader has it
  std::string_view unit = {};       ///< in words, the same
  std::string_view range = {};      ///< number of values of a list, where readers only know the least: "two", "six"
};

/// All entries.
const std::vector<MeaningOfPath>& all_meanings();

/// The entry of a key: that of its program and path, else the longest one that the path ends with, word by word; null if there is none.
const MeaningOfPath* meaning_of(std::string_view program, std::string_view path);

}  // namespace nereid::driver
