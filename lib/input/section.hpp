#pragma once
// Reads a case file: every value is checked where it is asked for, and all faults are told at once.
//
// A reader takes a Section and asks for what it needs:
//
//     Contact read_contact(input::Section root) {
//       auto penalty = root.section("contact").section("penalty");
//       const bool given = penalty.choice("kind", {"given", "automatic"}) == "given";
//       return {
//           .penalty = penalty.when(given).quantity("value", dim::penalty, input::positive),
//           .scale = penalty.when(!given).number_or("penalty_scale", 10, input::positive),
//       };
//     }
//
//     auto file = input::CaseFile::read("cases/bars.yaml", {"contact.penalty.kind=automatic"});
//     const Contact contact = read_contact(file.root());
//     file.finish();  // throws all faults at once; only now are the values to be trusted
//
// A reader never stops at a fault and never throws: it notes the fault and gets a harmless value.
// What no reader has asked for is a fault too, so a reader asks for exactly what it uses.

#include <array>
#include <exception>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/range.hpp"
#include "base/resolved.hpp"
#include "input/units.hpp"
#include "mesh/judge.hpp"

namespace nereid::input {

struct CaseMesh;  // input/preset.hpp
struct AskedKey;  // input/survey.hpp
struct Survey;

// Ranges stand in every reader: input::positive, input::within.
using nereid::above, nereid::at_least, nereid::below, nereid::between, nereid::not_negative, nereid::positive, nereid::Range,
    nereid::up_to, nereid::within;
inline constexpr Range any = nereid::finite;

/// One thing that is wrong with a case, and its place.
struct Fault {
  std::string source;   ///< path of the case file, or "--set key=value"
  int line, column;     ///< 1-based, in characters; line 0: on the command line; column 0: no place
  std::string message;  ///< one line
  std::string hint;     ///< as in "did you mean 'penalty'?", or empty
  std::string text;     ///< the whole report: place, message, source line, underline, hint
};

/// The case is wrong. Exit status 2.
class CaseError : public std::exception {
 public:
  /// more  how many faults there are beside those that are told
  CaseError(std::string case_path, std::vector<Fault> all, std::size_t more = 0);
  const char* what() const noexcept override { return text_.c_str(); }

  std::string path;
  std::vector<Fault> faults;  ///< the first of them by place: down the file, then along the command line

 private:
  std::string text_;
};

class Document;
struct Place;
struct Node;
struct Entry;

/// A map of keys in a case, as its reader sees it. A light handle: pass it by value.
///
/// Every reading function marks its key as known, so that finish() does not report it. In a Section
/// that is itself missing or wrong, reading returns harmless values without further faults.
///
/// Harmless values lie inside the range asked for, or are the default; the value of a key which is
/// absent because the chosen kind does not use it is NaN, or the default.
class Section {
 public:
  /// A required section; a section without keys is a fault.
  Section section(std::string_view key) const;

  /// An optional section: if it is absent, everything in it is.
  Section section_or_empty(std::string_view key) const;

  /// A list of sections, `[]` for none. An absent list is a fault only if `fewest` > 0.
  std::vector<Section> list(std::string_view key, int fewest = 0) const;

  /// The same section, of which this reader uses keys only if `used` holds.
  ///
  /// In `when(true)` all is as usual. In `when(false)` no key is required; keys that are present
  /// are checked as usual and listed as not used, unless someone else reads them. So the reader of
  /// an alternative reads the keys of all kinds, each through the condition of its kind. Where the
  /// `kind` itself is missing or unknown, no kind's keys are missing and none counts as unused.
  Section when(bool used) const;

  /// Whether all choices read so far are there and known; else a reader does not judge what has another meaning or
  /// shape in each kind.
  bool decided() const;

  /// Whether no case is read, but all keys are asked for: CaseFile::surveyed.
  bool surveyed() const;

  /// What counts of cells are multiplied by, as CaseFile::refine_factor(). [-]
  double refine_factor() const;

  /// Whether the case has the key, with whatever value. A key only asked for by has() and never
  /// read is listed as not used.
  bool has(std::string_view key) const;

  /// The keys as written, in the order of the file, for sections whose keys are names that the
  /// user gives. Does not mark them as known.
  std::vector<std::string> keys() const;

  /// A number with a unit, in SI units. With dim::none: a number, which must not have a unit.
  double quantity(std::string_view key, Dimension, Range = any) const;
  double quantity_or(std::string_view key, double default_si, Dimension, Range = any) const;

  /// A number without unit.
  double number(std::string_view key, Range = any) const;
  double number_or(std::string_view key, double otherwise, Range = any) const;

  /// A whole number, low <= count <= high.
  int count(std::string_view key, int low = 1, int high = std::numeric_limits<int>::max()) const;
  int count_or(std::string_view key, int otherwise, int low = 1,
               int high = std::numeric_limits<int>::max()) const;

  /// `true` or `false`, and no other spelling.
  bool flag(std::string_view key) const;
  bool flag_or(std::string_view key, bool otherwise) const;

  /// Any text that is not empty.
  std::string word(std::string_view key) const;
  std::string word_or(std::string_view key, std::string_view otherwise) const;

  /// What is wrong with a text and where in it, or nothing.
  using TextCheck = std::function<std::optional<TextFault>(const std::string&)>;

  /// A text in a language of its own, quoted or not, which `check` reads; "0" after a fault.
  std::string text(std::string_view key, const TextCheck& check) const;

  /// Three such texts, as in `["0", "0", "-9.81*t"]`.
  std::array<std::string, 3> texts(std::string_view key, const TextCheck& check) const;

  /// One of the words in `options`; the first of them after a fault.
  std::string choice(std::string_view key, const std::vector<std::string>& options) const;
  std::string choice_or(std::string_view key, std::string_view otherwise,
                        const std::vector<std::string>& options) const;

  /// Three quantities, as in `[1 m, 2 m, 3 m]`; with dim::none three numbers.
  std::array<double, 3> vector(std::string_view key, Dimension) const;
  std::array<double, 3> vector_or(std::string_view key, const std::array<double, 3>& default_si,
                                  Dimension) const;

  /// Three whole numbers, as in `cells: [20, 4, 4]`.
  std::array<int, 3> counts(std::string_view key, int low = 1,
                            int high = std::numeric_limits<int>::max()) const;

  /// Any number of quantities, at least `fewest`. An absent list is a fault only if `fewest` > 0.
  std::vector<double> quantities(std::string_view key, Dimension, Range = any,
                                 int fewest = 1) const;

  /// Any number of words, at least `fewest`. An absent list is a fault only if `fewest` > 0.
  std::vector<std::string> words(std::string_view key, int fewest = 1) const;

  /// The reader's own check has failed: `message` at the key's value, or at the section if the key
  /// is absent. Ignored if the value of this key is already at fault.
  void fault(std::string_view key, std::string message, std::string hint = "") const;

  /// Keeps the elements that a fault is about: CaseFile::offenders().
  void show(mesh::Offenders) const;

  /// Values of several keys do not go together: `message` at the one that was set last, on the command line, else at the first.
  void fault_between(std::initializer_list<std::string_view> keys, std::string message) const;

  /// The word `name` at this key, or in its list, names nothing: the fault says what there is (`what`, in the
  /// plural, and `names`) and which of it is near. For names of things that are known only after reading.
  void unknown_name(std::string_view key, const std::string& name, const std::string& what,
                    const std::vector<std::string>& names) const;

  /// No fault has been found in the case so far. Checks that combine values ask this first, so
  /// that one wrong value does not make two faults.
  bool sound() const;

  /// The file that the case names at this key by `path`, for CaseFile::check_files: relative ones start at the folder of the case file.
  std::string beside_case(std::string_view key, std::string_view path) const;

  /// What a file held that a value of this key names: its path and the checksum of its bytes become a resolved value KEY_file, so that
  /// hash() changes with it.
  void saw(std::string_view key, const std::string& path, std::uint64_t sum) const;

  /// Where the section is, as in "bodies[0].material"; empty for the root.
  const std::string& path() const { return path_; }

 private:
  friend class CaseFile;
  enum class Use { used, not_used, undecided };

  Section(std::shared_ptr<Document> document, Node* node, std::string path, Use use);
  Section descend(Node* node, std::string path) const;
  std::string path_of(std::string_view key) const;

  void note(std::string_view key, AskedKey asked) const;
  bool answer(std::string_view key, const std::vector<std::string>& answers, std::string& given) const;
  Entry* ask(std::string_view key) const;
  Entry* get(std::string_view key, bool required, const std::string& what) const;
  void wrong(Entry&, const Place& at, std::string message, std::string hint = "") const;
  void accept(Entry&, std::string_view key, Resolved::Value, std::string unit) const;
  void record(std::string_view key, Resolved::Value, std::string unit, bool is_default) const;

  bool is_scalar(Entry&, const Node&, const std::string& name) const;
  bool is_list(Entry&, std::string_view key, const std::string& expected) const;
  bool read(Entry&, const Node&, const std::string& name, Dimension, const Range&, double&) const;
  bool read(Entry&, const Node&, const std::string& name, int low, int high, int&) const;
  bool read(Entry&, const Node&, const std::string& name, std::string&) const;
  bool read(Entry&, const Node&, const std::string& name, const TextCheck&, std::string&) const;

  double quantity(std::string_view key, const double* otherwise, Dimension, const Range&) const;
  int count(std::string_view key, const int* otherwise, int low, int high) const;
  bool flag(std::string_view key, const bool* otherwise) const;
  std::string word(std::string_view key, const std::string_view* otherwise,
                   const std::vector<std::string>* options) const;
  std::array<double, 3> vector(std::string_view key, const std::array<double, 3>* otherwise,
                               Dimension) const;

  std::shared_ptr<Document> document_;
  Node* node_;  // null: missing or wrong, and that has been said
  std::string path_;
  Use use_;
};

/// A case file with the values set on the command line, and the record of what was asked of it.
class CaseFile {
 public:
  /// Reads a file. Each override is `key.path=value`, where `bodies[0].length` names an item of a
  /// list; it replaces a value of the file or adds one, and goes through the same checks.
  ///
  /// Throws CaseError if nothing can be read at all: no such file, no YAML, not a map of keys.
  static CaseFile read(const std::string& path, const std::vector<std::string>& overrides = {});

  /// The same from a text; `path` is what faults call it.
  static CaseFile parse(const std::string& text, const std::string& path,
                        const std::vector<std::string>& overrides = {});

  /// A case without keys, of which all that readers ask is kept.
  static CaseFile surveyed(const std::shared_ptr<Survey>&);

  Section root() const;

  /// Notes a fault found after reading, at the value of a path as in "planes[0].nodes[1]", or at the deepest part of it that
  /// the case has. Call finish() afterwards.
  void fault(const std::string& path, std::string message, std::string hint = "") const;

  /// Keeps the elements that a fault is about.
  void show(mesh::Offenders) const;
  const std::vector<mesh::Offenders>& offenders() const;

  /// Throws CaseError with all faults, by place, if there are any. Reports the keys that nobody has
  /// asked for; call it after all reading.
  void finish() const;

  /// What is wrong with the use of a file, given its path; empty if nothing is.
  using FileCheck = std::function<std::string(const std::string& path)>;

  /// Asks `check` of each file that the case names, so far as it has been read. Throws CaseError, each fault at its key.
  void check_files(const FileCheck& check) const;

  /// Paths of the files that the case names, so far as it has been read.
  std::vector<std::string> files() const;

  /// Keys that the chosen kinds do not use, as in "contact.penalty_scale (cases/bars.yaml:12:5)".
  std::vector<std::string> not_used() const;

  /// What counts of cells were multiplied by: `refine` of the case, else that of its preset `accuracy`, else 1. [-]
  double refine_factor() const;

  /// The meshes of the case, with their counts of cells as they stand there.
  const std::vector<CaseMesh>& meshes() const;

  /// What `refine` does to meshes from files and does not do to others, a line each; nothing where it is 1.
  std::vector<std::string> refine_notes() const;

  /// What the preset `accuracy` has set, a line each; nothing without one. Needs all reading done.
  std::vector<std::string> preset_lines() const;

  /// Every value that is used, defaults included, in the order of reading.
  const std::vector<Resolved>& resolved() const;

  /// Fingerprint of the resolved values, 16 hexadecimal digits (FNV-1a, 64 bit).
  ///
  /// Invariants  it does not change with units, comments, order in the file, or by writing out a
  ///             default; it changes with every value.
  std::string hash() const;

 private:
  explicit CaseFile(std::shared_ptr<Document> document) : document_(std::move(document)) {}
  void set_accuracy();
  void refuse_factor_of_files();
  std::shared_ptr<Document> document_;
};

}  // namespace nereid::input
