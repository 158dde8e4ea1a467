#pragma once
// Accuracy against cost in one word: what a preset sets where the case does not, and meshes made finer as a whole.

#include <string>
#include <string_view>
#include <vector>

#include "input/yaml.hpp"

namespace nereid::input {

/// A key and its value in every section of a name, as in `time`, `element`, `contacts`.
struct Setting {
  std::string_view section, key, value;
};

/// What `accuracy: NAME` means. A key that the case has is not touched.
struct Preset {
  std::string_view name;
  double refine;                  ///< [-] what counts of cells are multiplied by
  std::vector<Setting> settings;
};

/// From cheap to dear; docs/trade.md has what each costs and misses.
const std::vector<Preset>& presets();

/// The preset of a name, or null.
const Preset* find_preset(std::string_view name);

/// The value of a key in a section of this path, as in "bodies[0].element", or null.
const Setting* find_setting(const Preset&, std::string_view section_path, std::string_view key);

/// A count of cells in a direction of a mesh that is finer by a factor: one stays one, and none becomes less.
///
///     1 if count = 1, else max(1, round(count factor))
int refined(int count, double factor);

/// Multiplies every count of cells below a node: keys that begin with `cells`, and `level` of a `mesh`. What is no whole number stays.
///
/// counts   those that are more than one, before
/// returns  whether there was any
bool refine(Node&, double factor, std::vector<int>& counts);

}  // namespace nereid::input
