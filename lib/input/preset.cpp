#include "input/preset.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace nereid::input {

namespace {

/// A whole number that a case may have as a count, or 0: readers say what is wrong with 08.
int count_in(const Node& node) {
  int count = 0;
  const char* last = node.text.data() + node.text.size();
  const auto read = std::from_chars(node.text.data(), last, count);
  const bool whole = node.kind == Node::Kind::scalar && !node.quoted && read.ec == std::errc{} && read.ptr == last;
  return whole && count > 0 && node.text == std::to_string(count) ? count : 0;
}

bool refine_count(Node& node, double factor, std::vector<int>& counts) {
  const int count = count_in(node);
  if (count < 1) return false;
  if (count > 1) counts.push_back(count);
  node.text = std::to_string(refined(count, factor));
  return true;
}

}  // namespace

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all{
      {"fast", 0.5, {}},
      {"balanced", 1, {}},
      {"reference", 2, {{"element", "layers", "9"}, {"cladding", "layers", "9"}}},
  };
  return all;
}

const Preset* find_preset(std::string_view name) {
  for (const Preset& preset : presets())
    if (preset.name == name) return &preset;
  return nullptr;
}

const Setting* find_setting(const Preset& preset, std::string_view section_path, std::string_view key) {
  std::string_view section = section_path.substr(section_path.rfind('.') + 1);  // npos + 1 is 0
  section = section.substr(0, section.find('['));
  for (const Setting& setting : preset.settings)
    if (setting.section == section && setting.key == key) return &setting;
  return nullptr;
}

int refined(int count, double factor) {
  if (count == 1) return 1;
  const double most = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(std::round(count * factor), 1.0, most));
}

bool refine(Node& node, double factor, std::vector<int>& counts) {
  bool any = false;
  for (const auto& item : node.items) any |= refine(*item, factor, counts);
  for (const auto& entry : node.entries) {
    Node& value = *entry->value;
    if (entry->key.rfind("cells", 0) == 0) {
      any |= refine_count(value, factor, counts);
      for (const auto& item : value.items) any |= refine_count(*item, factor, counts);
      continue;
    }
    if (Entry* level = entry->key == "mesh" ? find(value, "level") : nullptr) any |= refine_count(*level->value, factor, counts);
    any |= refine(value, factor, counts);
  }
  return any;
}

}  // namespace nereid::input
