#include "base/words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace nereid {

std::string quote(std::string_view text) { return "'" + std::string(text) + "'"; }

std::string formatted(const char* format, ...) {
  std::va_list values, again;
  va_start(values, format);
  va_copy(again, values);
  std::string text(static_cast<std::size_t>(std::max(0, std::vsnprintf(nullptr, 0, format, values))), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(values);
  return text;
}

std::string counted(std::size_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

std::string percent(double share) { return std::abs(share) < 1e-5 ? formatted("%.2g", share) : formatted("%.2g %%", 100 * share); }

std::string shortest(double value) {
  std::array<char, 32> buffer{};  // the shortest text that reads back has at most 24 characters
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

std::string joined(const std::vector<std::string>& words) {
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : ", ") + word;
  return result;
}

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t most = 24;
  if (words.size() <= most) return joined(words);
  return joined({words.begin(), words.begin() + most}) + " and " + std::to_string(words.size() - most) + " more";
}

std::string clipped(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;  // not between the bytes of one character
  return std::string(text.substr(0, most)) + "...";
}

std::string inside(const std::string& path) {
  return path.empty() ? std::string{} : " in " + quote(path);
}

namespace {

/// Letters to insert, remove, replace or swap with their neighbour to make one word the other.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> steps(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  const auto same = [](char left, char right) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; };
    return lower(left) == lower(right);
  };
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        steps[i][j] = i + j;
        continue;
      }
      steps[i][j] = std::min({steps[i - 1][j] + 1, steps[i][j - 1] + 1,
                              steps[i - 1][j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1)});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1])) {
        steps[i][j] = std::min(steps[i][j], steps[i - 2][j - 2] + 1);
      }
    }
  }
  return steps[a.size()][b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& words) {
  constexpr std::size_t longest = 100;  // a longer one is no key, and the table of steps would grow
  if (word.size() > longest) return {};
  const std::string* best = nullptr;
  std::size_t least = 0;
  for (const std::string& candidate : words) {
    const std::size_t steps = distance(word, candidate);
    // With more than a third of the letters wrong, a suggestion misleads more often than it helps.
    if (steps > std::max(word.size(), candidate.size()) / 3) continue;
    if (best == nullptr || steps < least) best = &candidate, least = steps;
  }
  return best == nullptr ? std::string{} : "did you mean " + quote(*best) + "?";
}

std::size_t find_unprintable(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t ahead) {
      return at + ahead < text.size() ? static_cast<unsigned char>(text[at + ahead]) : 0U;
    };
    const unsigned first = byte(0);
    std::size_t length = 1;
    if (first < 0x20 && first != '\t' && first != '\n' && first != '\r') return at;
    if (first >= 0x80) {
      if (first < 0xC2 || first > 0xF4) return at;
      length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
      for (std::size_t ahead = 1; ahead < length; ++ahead) {
        if ((byte(ahead) & 0xC0U) != 0x80U) return at;
      }
      const unsigned second = byte(1);  // shorter spellings exist, or no character has this number
      if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
          (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) {
        return at;
      }
    }
    at += length;
  }
  return std::string_view::npos;
}

int characters(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

}  // namespace nereid
