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

/// A mesh of a case, as `refine` finds it.
struct CaseMesh {
  std::string name;          ///< of the body, else the path of its section; empty at the root
  bool rigid = false;        ///< of a rigid body: the faces of its geometry, and no mesh that anything is computed on
  bool from_file = false;    ///< has no counts and is split
  bool stays = false;        ///< is that of a body and has one cell in every direction, so that no factor makes it finer
  std::vector<int> counts;   ///< of cells, before `refine`
};

/// A count of cells in a direction of a mesh that is finer by a factor: one stays one, and none becomes less.
///
///     1 if count = 1, else max(1, round(count factor))
int refined(int count, double factor);

/// Multiplies every count of cells below a node: keys that begin with `cells`, and `level` of a `mesh`. What is no whole number stays.
/// Meshes from files are found and left to their reader.
///
/// returns  the meshes with counts or from files
std::vector<CaseMesh> refine(Node&, double factor);

/// The counts that are more than one, of all meshes.
std::vector<int> counts_of_cells(const std::vector<CaseMesh>&);

/// Names of meshes from files, and of meshes of deformable bodies that stay, as in "'bar', 'lid'"; empty without any.
std::string names_from_files(const std::vector<CaseMesh>&);
std::string names_that_stay(const std::vector<CaseMesh>&);

}  // namespace nereid::input
