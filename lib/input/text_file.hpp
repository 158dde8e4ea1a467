#pragma once
// Reading a whole text from a file that may be anything.

#include <optional>
#include <string>

namespace nereid::input {

constexpr std::size_t most_text = 10'000'000;  ///< [bytes] of a case, or of a table

/// The bytes of a file; nothing, and `why`, if it is none, cannot be read, or is larger than most_text.
std::optional<std::string> read_text(const std::string& path, std::string& why);

}  // namespace nereid::input
