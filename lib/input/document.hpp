#pragma once
// All that is known about one case: its tree, what is set on the command line, what was asked and what was found.

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/resolved.hpp"
#include "input/preset.hpp"
#include "input/section.hpp"
#include "input/survey.hpp"
#include "input/yaml.hpp"

namespace nereid::input {

/// Sections and CaseFile share it.
class Document {
 public:
  /// Throws CaseError if nothing can be read at all.
  Document(std::string path, std::string text, const std::vector<std::string>& overrides);

  Node* root() { return root_.get(); }
  /// A section that the case does not have, for readers of optional ones.
  Node* empty_section(const Place& place);

  /// Adds a fault at the value of a path, as in "planes[0].nodes[1]", or at the deepest part of it that the case has.
  void fault(const std::string& path, std::string message, std::string hint);

  bool sound() const;
  /// Throws CaseError with all faults by place, unknown keys among them, if there are any.
  void throw_if_any() const;
  std::vector<std::string> not_used() const;

  /// What the preset says of a key that a section does not have, as if it had it; null if it says nothing.
  Entry* from_preset(Node& section, const std::string& section_path, std::string_view key);
  /// `path = value` of all that the preset has set and a reader uses.
  std::vector<std::string> preset_lines() const;

  /// A value that looks like 'key:value' was meant to be a key.
  static std::string colon_hint(const Node& node);

  const Source& source(int number) const { return sources_[static_cast<std::size_t>(number)]; }

  /// A file that the case names, and where it does.
  struct NamedFile {
    std::string path;
    Place place;
  };

  std::shared_ptr<Survey> survey;   // null: a case is read
  const Preset* preset = nullptr;   // of `accuracy`
  Place preset_place;
  double refine = 1;                // what counts of cells were multiplied by
  std::vector<CaseMesh> meshes;     // whose counts these are, and meshes from files

  std::vector<NamedFile> files;
  std::vector<Finding> findings;
  std::vector<mesh::Offenders> offenders;  // elements that findings are about
  std::vector<Resolved> resolved;
  std::set<std::string> recorded;

 private:
  void check_text(const std::string& text) const;
  void apply(const std::string& text, int number);
  void find_unknown(const Node& node, const std::string& path, std::vector<Finding>& all) const;
  void find_not_used(const Node& node, const std::string& path, std::vector<std::string>& result) const;
  int column(const Place& place) const;
  std::string text_of(const Place& place) const;
  Fault report(const Finding& finding) const;

  std::deque<Source> sources_;
  std::unique_ptr<Node> root_;
  std::deque<Node> extra_;
  std::vector<std::pair<std::string, const Entry*>> of_preset_;
  std::map<std::string, int> set_;  // path: number of the override
};

}  // namespace nereid::input
