#include "input/preset.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/words.hpp"

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

void refine_count(Node& node, double factor, std::vector<int>& counts) {
  const int count = count_in(node);
  if (count < 1) return;
  counts.push_back(count);
  node.text = std::to_string(refined(count, factor));
}

/// Multiplies the counts that a section has itself.
std::vector<int> refine_own(Node& section, double factor) {
  std::vector<int> counts;
  for (const auto& entry : section.entries) {
    if (entry->key.rfind("cells", 0) != 0) continue;
    refine_count(*entry->value, factor, counts);
    for (const auto& item : entry->value->items) refine_count(*item, factor, counts);
  }
  return counts;
}

bool says(const Node& section, std::string_view key, std::string_view word) {
  const Entry* entry = find(section, key);
  return entry != nullptr && entry->value->text == word;
}

bool is_one(int count) { return count == 1; }

/// Collects the meshes in a section.
///
/// owner  the section that has it under a key: the body, if that is `mesh`
void refine(Node& section, const Node* owner, const std::string& path, double factor, std::vector<CaseMesh>& found) {
  const bool is_mesh = owner != nullptr && path.substr(path.rfind('.') + 1) == "mesh";  // npos + 1 is 0
  CaseMesh mesh{.name = path, .from_file = is_mesh && says(section, "kind", "file"), .counts = refine_own(section, factor)};
  if (Entry* level = is_mesh ? find(section, "level") : nullptr) refine_count(*level->value, factor, mesh.counts);
  if (is_mesh) {
    const Entry* name = find(*owner, "name");
    if (name != nullptr && name->value->kind == Node::Kind::scalar) mesh.name = name->value->text;
    mesh.rigid = says(*owner, "rigid", "true");
    mesh.stays = find(section, "kind") != nullptr && !mesh.counts.empty() && std::all_of(mesh.counts.begin(), mesh.counts.end(), is_one);
  }
  if (mesh.from_file || !mesh.counts.empty()) found.push_back(std::move(mesh));
  std::size_t number = 0;
  for (const auto& item : section.items) refine(*item, nullptr, path + "[" + std::to_string(number++) + "]", factor, found);
  for (const auto& entry : section.entries)
    if (entry->key.rfind("cells", 0) != 0)
      refine(*entry->value, &section, path.empty() ? entry->key : path + "." + entry->key, factor, found);
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

std::vector<CaseMesh> refine(Node& root, double factor) {
  std::vector<CaseMesh> found;
  refine(root, nullptr, "", factor, found);
  return found;
}

std::vector<int> counts_of_cells(const std::vector<CaseMesh>& meshes) {
  std::vector<int> counts;
  for (const CaseMesh& mesh : meshes) std::remove_copy_if(mesh.counts.begin(), mesh.counts.end(), std::back_inserter(counts), is_one);
  return counts;
}

namespace {

template <class Which>
std::string names_of(const std::vector<CaseMesh>& meshes, const Which& which) {
  std::vector<std::string> names;
  for (const CaseMesh& mesh : meshes)
    if (which(mesh)) names.push_back(quote(mesh.name));
  return joined(names);
}

}  // namespace

std::string names_from_files(const std::vector<CaseMesh>& meshes) {
  return names_of(meshes, [](const CaseMesh& mesh) { return mesh.from_file; });
}

std::string names_that_stay(const std::vector<CaseMesh>& meshes) {
  return names_of(meshes, [](const CaseMesh& mesh) { return mesh.stays && !mesh.rigid; });
}

}  // namespace nereid::input
