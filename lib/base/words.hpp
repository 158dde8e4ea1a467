#pragma once
// Words for faults: lists, hints and columns.

#include <string>
#include <string_view>
#include <vector>

namespace nereid {

std::string quote(std::string_view);  ///< 'text'

/// What std::printf would print, whole.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// "1 item", "2 items".
std::string counted(std::size_t number, const std::string& noun);

/// A share in percent, as "12 %"; below a hundred-thousandth as a power of ten.
std::string percent(double share);

/// The shortest text that reads back to the same number.
std::string shortest(double value);

std::string joined(const std::vector<std::string>& words);  ///< "a, b, c"
/// The same, but no more than one still reads.
std::string listed(const std::vector<std::string>& words);

/// The text, or as much of its beginning as so many bytes hold, with "..." behind.
std::string clipped(std::string_view text, std::size_t most);

/// " in 'bodies[0]'", or nothing for the root.
std::string inside(const std::string& path);

/// "did you mean 'penalty'?", or nothing if none of the words is near.
std::string nearest(std::string_view word, const std::vector<std::string>& words);

/// Position of the first byte that is neither UTF-8 nor printable, or npos.
std::size_t find_unprintable(std::string_view text);

/// Counted as a reader counts: the bytes that continue a character do not start a column.
int characters(std::string_view text);

}  // namespace nereid
