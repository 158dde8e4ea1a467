#pragma once
// A case as a tree of our own, and the one door to yaml-cpp that builds it.

#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nereid::input {

struct Entry;

/// A piece of one source line. Source 0 is the file, source k the k-th override.
struct Place {
  int source = 0;
  int line = -1;  // 0-based; -1: no place
  int byte = 0;   // 0-based, in the line
  int length = 1;
};

/// A value of the case: our own tree, because a YAML::Node changes when it is looked at.
struct Node {
  enum class Kind { empty, scalar, map, list };
  Kind kind = Kind::empty;
  Place place;
  std::string text;     // of a scalar
  bool quoted = false;  // the scalar
  std::vector<std::unique_ptr<Entry>> entries;
  std::vector<std::unique_ptr<Node>> items;

  bool opened = false;             // a reader has taken it as a section
  std::vector<std::string> known;  // keys that readers asked for, in this order
  bool undecided = false;          // a choice among the keys is missing or wrong
};

/// A key of a map with its value, and what readers made of it.
struct Entry {
  std::string key;
  Place place;  // of the key
  std::unique_ptr<Node> value;

  bool of_preset = false;  // the case does not have it
  bool asked = false;   // a reader knows the key
  bool used = false;    // and needs its value, or might
  bool needed = false;  // by the chosen kind
  bool sound = false;   // has been read without a fault while the kind was unknown
  bool faulty = false;  // a fault was found that stays
};

/// What faults are shown in: the file, or one override.
struct Source {
  std::string name;
  bool is_file;
  std::vector<std::string> lines;

  Source(std::string called, bool file, const std::string& text)
      : name(std::move(called)), is_file(file) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      lines.push_back(std::move(line));
    }
  }

  std::string_view line(int number) const {
    if (number < 0 || number >= static_cast<int>(lines.size())) return {};
    return lines[static_cast<std::size_t>(number)];
  }
};

/// Reading cannot go on behind this fault.
struct Stop {
  Place place;
  std::string message, hint;
};

/// A fault in the making.
struct Finding {
  Place place;
  std::string message, hint;
  const Entry* tentative = nullptr;  // does not count if this entry turns out to be in order
  std::function<std::string()> late_hint = {};  // of findings of which there may be thousands: asked for those that are told
};

/// What usually lies behind a value that looks like 'key:value'.
inline constexpr const char* blank_needed = "a blank is needed behind ':'";

/// The entry of a key, or null.
Entry* find(const Node& map, std::string_view key);

/// Where to point at when a whole value is wrong: at the key, unless the value is within one line.
inline const Place& place_of(const Entry& entry, const Node& value) {
  const bool spread = value.kind == Node::Kind::map || value.kind == Node::Kind::list;
  return &value == entry.value.get() && spread && value.place.length == 1 ? entry.place
                                                                          : value.place;
}

/// The tree of one text, or null if there is nothing in it. Refuses what YAML allows and a case does not.
///
/// number, offset  of the source, and where in its first line the text begins
/// findings        gets what is wrong and does not end reading
/// Throws Stop where reading cannot go on.
std::unique_ptr<Node> parse_yaml(const std::string& text, const Source&, int number, int offset, std::vector<Finding>& findings);

}  // namespace nereid::input
