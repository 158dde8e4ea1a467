#include "input/retired.hpp"

#include <array>
#include <cctype>

namespace nereid::input {

namespace {

struct Renamed {
  std::string_view old, now;
  std::string_view key;       // whose value the word is; empty: the word is itself a key
  std::string_view sections;  // in which it stands, with [] for any place in a list
};

// The table is that of scripts/words.py; tests/scripts/words_test.py compares the two.
constexpr std::array<Renamed, 8> all{{
    {"hardness", "penalty_scale", "", "contacts[] contact interface base planes[]"},
    {"stick", "tangential_penalty", "", "contacts[] contact interface base planes[]"},
    {"damping", "damping_ratio", "", "contacts[] contact interface base"},
    {"created_in_a_bounce", "energy_gain_limit", "", "contacts[] contact interface base planes[]"},
    {"turn", "rotate", "", "bodies[]"},
    {"turning", "angular_velocity", "", "planes[]"},
    {"bonded", "tied", "kind", "contacts[] contact interface base"},
    {"held", "constrained", "kind", "planes[]"},
}};

/// "contacts[3]" as "contacts[]".
std::string without_numbers(std::string_view path) {
  std::string plain;
  bool inside = false;
  for (const char c : path) {
    if (c == ']') inside = false;
    if (!inside) plain += c;
    if (c == '[') inside = true;
  }
  return plain;
}

bool has_word(std::string_view list, std::string_view word) {
  const std::string spaced = " " + std::string(list) + " ";
  return spaced.find(" " + std::string(word) + " ") != std::string::npos;
}

}  // namespace

std::string renamed(std::string_view section, std::string_view key, std::string_view value) {
  const std::string place = without_numbers(section);
  for (const Renamed& one : all) {
    const bool same = one.key.empty() ? value.empty() && key == one.old : key == one.key && value == one.old;
    if (same && has_word(one.sections, place))
      return "it is called '" + std::string(one.now) + "' now; scripts/update_case rewrites old case files";
  }
  return "";
}

}  // namespace nereid::input
