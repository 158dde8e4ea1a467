#pragma once
// What must hold of a .vtu file before VTK may read it: VTK 9.1 trusts the numbers in a file, and crashes where they are wrong.

#include <string>
#include <string_view>

namespace nereid::grid {

/// What is said of a file that does not begin as one.
inline constexpr const char* no_vtu = "it is no .vtu file";

/// What a look at a .vtu file found.
struct VtuCheck {
  std::string fault = {};  ///< empty, or what is wrong with the file, as part of a sentence
  double unpacked = 0;     ///< [bytes] that its arrays have in memory
};

/// Looks at the tags of a .vtu file and at the sizes of its arrays: tags are nested and closed, counts are whole numbers, types,
/// compressors and encodings are known, each array has the values that the counts ask for, and packed blocks lie within the file.
VtuCheck check_vtu(std::string_view bytes);

}  // namespace nereid::grid
