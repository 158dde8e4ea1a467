#include "input/section.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <tuple>
#include <utility>

namespace nereid::input {

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

struct Entry {
  std::string key;
  Place place;  // of the key
  std::unique_ptr<Node> value;

  bool asked = false;   // a reader knows the key
  bool used = false;    // and needs its value, or might
  bool needed = false;  // by the chosen kind
  bool sound = false;   // has been read without a fault while the kind was unknown
  bool faulty = false;  // a fault was found that stays
};

namespace {

constexpr std::size_t most_nodes = 1'000'000;  // so that aliases of aliases end before memory does
constexpr std::size_t gutter = 5;              // width of a line number in a report

constexpr const char* open_bracket = "are all brackets closed?";
constexpr const char* blank_needed = "a blank is needed behind ':'";

std::string quote(std::string_view text) { return "'" + std::string(text) + "'"; }

std::string counted(std::size_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

/// A value as it may be shown within a message of one line.
std::string shown(const Node& scalar) {
  constexpr std::size_t longest = 60;
  std::string text = scalar.text.substr(0, longest);
  while (!text.empty() && text.size() < scalar.text.size() &&
         (static_cast<unsigned char>(scalar.text[text.size()]) & 0xC0U) == 0x80U) {
    text.pop_back();  // not between the bytes of one character
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.size() < scalar.text.size()) text += "...";
  return text;
}

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

/// As joined, but no more than one still reads.
std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t most = 24;
  if (words.size() <= most) return joined(words);
  return joined({words.begin(), words.begin() + most}) + " and " + std::to_string(words.size() - most) + " more";
}

std::string inside(const std::string& path) {
  return path.empty() ? std::string{} : " in " + quote(path);
}

std::string range_text(const std::string& name, double low, double high, bool with_low,
                       bool with_high, const std::string& unit) {
  const auto end = [&](double value) {
    return shortest(value) + (value == 0 || unit == "1" ? "" : " " + unit);
  };
  const bool from = std::isfinite(low), to = std::isfinite(high);
  if (from && to) {
    return end(low) + (with_low ? " <= " : " < ") + name + (with_high ? " <= " : " < ") + end(high);
  }
  if (from) return name + (with_low ? " >= " : " > ") + end(low);
  return name + (with_high ? " <= " : " < ") + end(high);
}

/// A value that passes for one of the range while reading goes on after a fault.
double harmless(const Range& range) {
  const bool from = std::isfinite(range.low), to = std::isfinite(range.high);
  if (from && to) return range.low + (range.high - range.low) / 2;
  return from ? range.low + 1 : to ? range.high - 1 : 1;
}

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

namespace {

/// Position of the first byte that is neither UTF-8 nor printable, or npos.
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

/// Counted as a reader counts: the bytes that continue a character do not start a column.
int characters(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

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

struct Finding {
  Place place;
  std::string message, hint;
  const Entry* tentative = nullptr;  // does not count if this entry turns out to be in order
};

std::unique_ptr<Node> copy(const Node& node, std::size_t& count) {
  if (++count > most_nodes) throw Stop{node.place, "aliases repeat too many values", ""};
  auto result = std::make_unique<Node>();
  result->kind = node.kind;
  result->place = node.place;
  result->text = node.text;
  result->quoted = node.quoted;
  for (const auto& entry : node.entries) {
    auto value = copy(*entry->value, count);
    result->entries.push_back(std::make_unique<Entry>(Entry{entry->key, entry->place, {}}));
    result->entries.back()->value = std::move(value);
  }
  for (const auto& item : node.items) result->items.push_back(copy(*item, count));
  return result;
}

Entry* find(const Node& map, std::string_view key) {
  for (const auto& entry : map.entries) {
    if (entry->key == key) return entry.get();
  }
  return nullptr;
}

/// Builds our tree from the events of yaml-cpp, and refuses what YAML allows and a case does not.
class Builder : public YAML::EventHandler {
 public:
  Builder(const Source& source, int number, int offset, std::vector<Finding>& findings)
      : source_(source), number_(number), offset_(offset), findings_(findings) {}

  std::unique_ptr<Node> root;

  Place place(const YAML::Mark& mark) const {
    if (mark.is_null()) return {number_, 0, offset_, 1};
    return {number_, mark.line, mark.column + (mark.line == 0 ? offset_ : 0), 1};
  }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (expects_key()) throw Stop{place(mark), "the key is missing", ""};
    add(Node::Kind::empty, place(mark), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Place at = place(mark);
    at.length = word_length(at);
    if (expects_key()) throw Stop{at, "a key cannot be an alias", ""};
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) throw Stop{at, "an alias of a key is not read", ""};
    const Node* original = found->second;
    for (const Frame& frame : frames_) {
      if (frame.node == original) throw Stop{at, "the alias repeats itself without end", ""};
    }
    auto repeated = copy(*original, count_);
    repeated->place = at;
    add(std::move(repeated), 0);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    Place at = place(mark);
    const bool plain = tag != "!";
    find_extent(at, text, plain);
    if (tag != "!" && tag != "?" && !tag.empty()) {
      findings_.push_back({place(mark), "tags as in '!!float' are not read: remove it", ""});
    }
    if (expects_key()) {
      frames_.back().key = text;
      frames_.back().key_place = at;
      return;
    }
    Node* node = add(Node::Kind::scalar, at, anchor);
    node->text = text;
    node->quoted = !plain;
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(Node::Kind::list, mark, anchor);
  }
  void OnSequenceEnd() override { frames_.pop_back(); }

  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(Node::Kind::map, mark, anchor);
  }
  void OnMapEnd() override { frames_.pop_back(); }

 private:
  struct Frame {
    Node* node;
    std::string path;
    std::optional<std::string> key;
    Place key_place;
  };

  bool expects_key() const {
    return !frames_.empty() && frames_.back().node->kind == Node::Kind::map && !frames_.back().key;
  }

  void open(Node::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (expects_key()) throw Stop{place(mark), "a key must be a single word", open_bracket};
    Place at = place(mark);
    at.length = bracket_length(at);
    std::string path = frames_.empty() ? "" : frames_.back().path;
    if (!frames_.empty() && frames_.back().key) {
      path += (path.empty() ? "" : ".") + *frames_.back().key;
    } else if (!frames_.empty()) {
      path += "[" + std::to_string(frames_.back().node->items.size()) + "]";
    }
    Node* node = add(kind, at, anchor);
    frames_.push_back({node, std::move(path), std::nullopt, {}});
  }

  Node* add(Node::Kind kind, const Place& at, YAML::anchor_t anchor) {
    auto node = std::make_unique<Node>();
    node->kind = kind;
    node->place = at;
    return add(std::move(node), anchor);
  }

  Node* add(std::unique_ptr<Node> node, YAML::anchor_t anchor) {
    Node* added = node.get();
    if (++count_ > most_nodes) throw Stop{node->place, "the case has too many values", ""};
    if (anchor != 0) anchors_[anchor] = added;
    if (frames_.empty()) {
      root = std::move(node);
      return added;
    }
    Frame& frame = frames_.back();
    if (frame.node->kind == Node::Kind::list) {
      frame.node->items.push_back(std::move(node));
      return added;
    }
    // The place of what is not there would be that of whatever follows.
    if (node->kind == Node::Kind::empty) node->place = frame.key_place;
    auto entry = std::make_unique<Entry>();
    entry->key = *std::exchange(frame.key, std::nullopt);
    entry->place = frame.key_place;
    entry->value = std::move(node);
    if (entry->key == "<<") {
      findings_.push_back({entry->place, "the merge key '<<' is not read: write its keys out", ""});
      unwanted_.push_back(std::move(entry));
    } else if (const Entry* first = find(*frame.node, entry->key)) {
      findings_.push_back({entry->place,
                           "repeated key " + quote(entry->key) + inside(frame.path) +
                               ": first given in line " + std::to_string(first->place.line + 1),
                           ""});
      unwanted_.push_back(std::move(entry));
    } else {
      frame.node->entries.push_back(std::move(entry));
    }
    return added;
  }

  /// Finds the text itself behind an anchor or a tag, and what to underline.
  void find_extent(Place& at, const std::string& text, bool plain) const {
    const std::string_view line = source_.line(at.line);
    const auto from = static_cast<std::size_t>(at.byte);
    if (from >= line.size()) return;
    if (plain) {
      const std::size_t found = line.find(text, from);
      if (found != std::string_view::npos && !text.empty()) {
        at.byte = static_cast<int>(found);
        at.length = static_cast<int>(text.size());
      } else {
        at.length = static_cast<int>(line.size() - from);  // goes on in the next line
      }
      return;
    }
    const std::size_t start = line.find_first_of("'\"|>", from);
    if (start == std::string_view::npos) return;
    at.byte = static_cast<int>(start);
    const char mark = line[start];
    if (mark == '|' || mark == '>') return;
    at.length = static_cast<int>(line.size() - start);
    int number = at.line;
    for (std::size_t next = start + 1;; ++next) {
      std::string_view current = source_.line(number);
      while (next >= current.size()) {  // yaml-cpp accepts a quote that is never closed
        if (++number >= static_cast<int>(source_.lines.size())) {
          throw Stop{at, "the quotation mark is not closed", ""};
        }
        next = 0;
        current = source_.line(number);
      }
      if (mark == '"' && current[next] == '\\') {
        ++next;
      } else if (current[next] == mark) {
        const bool doubled = mark == '\'' && next + 1 < current.size() && current[next + 1] == mark;
        if (!doubled) {
          if (number == at.line) at.length = static_cast<int>(next + 1 - start);
          return;
        }
        ++next;
      }
    }
  }

  int word_length(const Place& at) const {
    const std::string_view line = source_.line(at.line);
    const auto from = std::min(static_cast<std::size_t>(at.byte), line.size());
    const std::size_t end = std::min(line.find_first_of(" ,]}", from), line.size());
    return static_cast<int>(std::max<std::size_t>(end - from, 1));
  }

  /// Up to the closing bracket if it is in the same line, else 1.
  int bracket_length(const Place& at) const {
    const std::string_view line = source_.line(at.line);
    int depth = 0;
    for (auto next = static_cast<std::size_t>(at.byte); next < line.size(); ++next) {
      if (line[next] == '[' || line[next] == '{') ++depth;
      if (line[next] == ']' || line[next] == '}') --depth;
      if (depth == 0) return static_cast<int>(next) - at.byte + 1;
    }
    return 1;
  }

  const Source& source_;
  int number_, offset_;
  std::vector<Finding>& findings_;
  std::vector<Frame> frames_;
  std::map<YAML::anchor_t, const Node*> anchors_;
  std::vector<std::unique_ptr<Entry>> unwanted_;  // kept for aliases of what is inside
  std::size_t count_ = 0;
};

/// What usually lies behind a message of yaml-cpp.
std::string yaml_hint(const std::string& message, const Source& source, int line) {
  if (message.find("flow") != std::string::npos) return open_bracket;
  const bool map = message == "illegal map value" || message == "end of map not found";
  if (!map) return {};
  // A line 'key:value' is no key, and the fault is only noticed at the key below it.
  int above = line - 1;
  while (above > 0 && source.line(above).find_first_not_of(' ') == std::string_view::npos) --above;
  for (const int number : {line, above}) {
    const std::string_view text = source.line(number);
    const std::size_t colon = text.find(':');
    const bool commented = text.substr(0, colon).find_first_of("#'\"") != std::string_view::npos;
    if (colon != std::string_view::npos && colon + 1 < text.size() && text[colon + 1] != ' ' &&
        !commented) {
      return "a blank is needed behind ':' in line " + std::to_string(number + 1);
    }
  }
  return message == "illegal map value" ? "a text with ': ' in it needs quotation marks"
                                        : "keys of one section begin in the same column";
}

/// The tree of one text, or null if there is nothing in it.
std::unique_ptr<Node> parse_yaml(const std::string& text, const Source& source, int number,
                                 int offset, std::vector<Finding>& findings) {
  Builder builder(source, number, offset, findings);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) return nullptr;

    struct Second : Builder {
      using Builder::Builder;
      YAML::Mark start;
      void OnDocumentStart(const YAML::Mark& mark) override { start = mark; }
    } second(source, number, offset, findings);
    auto seen = findings.size();
    bool more = false;
    try {
      more = parser.HandleNextDocument(second);
    } catch (const Stop&) {
      more = true;  // whatever is wrong with a second document, that it is there matters more
    }
    if (more) {
      findings.resize(seen);
      Place at = second.place(second.start);
      if (source.line(at.line).substr(0, 3) == "---") at.length = 3;
      throw Stop{at, "a second document begins here: a case is one document", ""};
    }
  } catch (const YAML::Exception& error) {
    Place at = builder.place(error.mark);
    std::string hint = yaml_hint(error.msg, source, at.line);
    const int last = static_cast<int>(source.lines.size()) - 1;
    if (at.line > last && last >= 0)
      at = {number, last, static_cast<int>(source.line(last).size())};
    throw Stop{at, "cannot be read as YAML: " + error.msg, std::move(hint)};
  }
  return std::move(builder.root);
}

}  // namespace

/// All that is known about one case. Sections and CaseFile share it.
class Document {
 public:
  Document(std::string path, std::string text, const std::vector<std::string>& overrides) {
    const std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.compare(0, byte_order_mark.size(), byte_order_mark) == 0) {
      text.erase(0, byte_order_mark.size());
    }
    sources_.emplace_back(std::move(path), true, text);
    try {
      check_text(text);
      root_ = parse_yaml(text, sources_[0], 0, 0, findings);
      if (root_ == nullptr || root_->kind == Node::Kind::empty) {
        throw Stop{Place{0, 0, 0, 1}, "the case is empty", ""};
      }
      if (root_->kind != Node::Kind::map) {
        throw Stop{root_->place, "the case is not a map of keys: expected lines like 'key: value'",
                   colon_hint(*root_)};
      }
    } catch (Stop& stop) {
      findings.push_back({stop.place, std::move(stop.message), std::move(stop.hint)});
      throw_if_any();
    }
    for (const std::string& override_text : overrides) {
      const int number = static_cast<int>(sources_.size());
      sources_.emplace_back("--set " + override_text, false, override_text);
      try {
        apply(override_text, number);
      } catch (Stop& stop) {
        findings.push_back({stop.place, std::move(stop.message), std::move(stop.hint)});
      }
    }
  }

  Node* root() { return root_.get(); }

  Node* empty_section(const Place& place) {
    extra_.emplace_back();
    extra_.back().kind = Node::Kind::map;
    extra_.back().place = place;
    return &extra_.back();
  }

  bool sound() const {
    return std::all_of(findings.begin(), findings.end(),
                       [](const Finding& finding) { return finding.tentative != nullptr; });
  }

  void throw_if_any() const {
    std::vector<Finding> all;
    for (const Finding& finding : findings) {
      const Entry* entry = finding.tentative;
      if (entry == nullptr || !(entry->needed || entry->sound)) all.push_back(finding);
    }
    if (root_ != nullptr) find_unknown(*root_, "", all);
    if (all.empty()) return;

    std::stable_sort(all.begin(), all.end(), [](const Finding& a, const Finding& b) {
      return std::tie(a.place.source, a.place.line, a.place.byte) <
             std::tie(b.place.source, b.place.line, b.place.byte);
    });
    std::vector<Fault> faults;
    std::set<std::string> seen;  // what is read twice or through aliases is at fault once
    for (const Finding& finding : all) {
      Fault fault = report(finding);
      if (seen.insert(fault.text).second) faults.push_back(std::move(fault));
    }
    throw CaseError(sources_[0].name, std::move(faults));
  }

  std::vector<std::string> not_used() const {
    std::vector<std::string> result;
    find_not_used(*root_, "", result);
    return result;
  }

  /// A value that looks like 'key:value' was meant to be a key.
  static std::string colon_hint(const Node& node) {
    const bool likely =
        node.kind == Node::Kind::scalar && !node.quoted && node.text.find(':') != std::string::npos;
    return likely ? blank_needed : "";
  }

  const Source& source(int number) const { return sources_[static_cast<std::size_t>(number)]; }

  std::vector<Finding> findings;
  std::vector<Resolved> resolved;
  std::set<std::string> recorded;

 private:
  void check_text(const std::string& text) const {
    const std::size_t bad = find_unprintable(text);
    if (bad != std::string::npos) {
      const std::string_view before = std::string_view(text).substr(0, bad);
      const auto line = std::count(before.begin(), before.end(), '\n');
      const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
      // Without the line itself: a terminal would not show it.
      throw Stop{Place{0, -1, 0, 1},
                 "a byte in line " + std::to_string(line + 1) + ", column " +
                     std::to_string(characters(before.substr(start)) + 1) +
                     " is neither UTF-8 text nor printable",
                 ""};
    }
    for (std::size_t number = 0; number < sources_[0].lines.size(); ++number) {
      const std::string_view line = sources_[0].lines[number];
      const std::size_t content = line.find_first_not_of(" \t");
      const std::size_t tab = line.find('\t');
      if (content == std::string_view::npos || line[content] == '#' || tab > content) continue;
      throw Stop{Place{0, static_cast<int>(number), static_cast<int>(tab), 1},
                 "a tab in the indentation: write blanks", ""};
    }
  }

  struct Step {
    std::string key;
    std::vector<std::size_t> indices;
    Place place;
    std::string path;  // up to here
  };

  static std::vector<Step> split_path(const std::string& path, int number) {
    std::vector<Step> steps;
    std::size_t start = 0;
    while (true) {
      const std::size_t end = std::min(path.find('.', start), path.size());
      const std::string part = path.substr(start, end - start);
      Step step;
      step.place = {number, 0, static_cast<int>(start),
                    static_cast<int>(std::max<std::size_t>(part.size(), 1))};
      std::size_t bracket = part.find('[');
      step.key = part.substr(0, bracket);
      if (step.key.empty()) throw Stop{step.place, "a key is missing in the path", ""};
      while (bracket != std::string::npos && bracket < part.size()) {
        std::size_t index = 0;
        const char* first = part.data() + bracket + 1;
        const char* last = part.data() + part.size();
        const auto read = std::from_chars(first, last, index);
        if (part[bracket] != '[' || read.ec != std::errc{} || read.ptr == last ||
            *read.ptr != ']') {
          throw Stop{step.place, "an item of a list is written as in 'bodies[0]'", ""};
        }
        step.indices.push_back(index);
        bracket = static_cast<std::size_t>(read.ptr + 1 - part.data());
      }
      step.path = path.substr(0, end);
      steps.push_back(std::move(step));
      if (end == path.size()) return steps;
      start = end + 1;
    }
  }

  void apply(const std::string& text, int number) {
    Place whole{number, 0, 0,
                static_cast<int>(std::max<std::size_t>(source(number).line(0).size(), 1))};
    if (find_unprintable(text) != std::string::npos || text.find('\n') != std::string::npos) {
      throw Stop{Place{number, -1, 0, 1}, "expected one line of UTF-8 text", ""};
    }
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw Stop{whole, "expected 'key.path=value'", ""};
    std::string path = text.substr(0, equals);
    while (!path.empty() && path.back() == ' ') path.pop_back();

    const std::vector<Step> steps = split_path(path, number);
    auto value = parse_yaml(text.substr(equals + 1), source(number), number,
                            static_cast<int>(equals) + 1, findings);
    const auto& last = steps.back();
    if (value == nullptr || value->kind == Node::Kind::empty) {
      throw Stop{last.place, "no value for " + quote(path), ""};
    }
    if (value->kind == Node::Kind::map) {
      throw Stop{value->place, quote(path) + " is set to a section: set one key at a time", ""};
    }
    const auto [earlier, fresh] = set_.emplace(path, number);
    if (!fresh) {
      throw Stop{whole,
                 "repeated --set of " + quote(path) + ": first given by " +
                     quote(source(earlier->second).name),
                 ""};
    }

    Node* at = root_.get();
    for (const Step& step : steps) {
      std::string path_here = step.path;
      if (at->kind == Node::Kind::empty) at->kind = Node::Kind::map;
      if (at->kind != Node::Kind::map) {
        const std::string above = path_here.substr(0, path_here.rfind('.'));
        throw Stop{step.place, quote(above) + " is not a section, so it has no " + quote(step.key),
                   ""};
      }
      Entry* entry = find(*at, step.key);
      if (entry == nullptr && !step.indices.empty()) {
        throw Stop{step.place, "the case has no list " + quote(step.key), ""};
      }
      if (entry == nullptr) {
        at->entries.push_back(std::make_unique<Entry>());
        entry = at->entries.back().get();
        entry->key = step.key;
        entry->place = step.place;
        entry->value = std::make_unique<Node>();
        entry->value->place = step.place;
      }
      at = entry->value.get();
      for (const std::size_t index : step.indices) {
        if (at->kind != Node::Kind::list || index >= at->items.size()) {
          const std::string items =
              at->kind == Node::Kind::list ? counted(at->items.size(), "item") : "no list";
          throw Stop{step.place,
                     quote(step.key) + " has " + items + ", so there is no " +
                         quote(path_here.substr(path_here.rfind('.') + 1)),
                     ""};
        }
        at = at->items[index].get();
      }
      if (&step == &last && step.indices.empty()) entry->place = step.place;
    }
    if (at->kind == Node::Kind::map) {
      throw Stop{last.place, quote(path) + " is a section: set one of its keys", ""};
    }
    *at = std::move(*value);
  }

  static std::string join(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  void find_unknown(const Node& node, const std::string& path, std::vector<Finding>& all) const {
    for (std::size_t item = 0; item < node.items.size(); ++item) {
      find_unknown(*node.items[item], path + "[" + std::to_string(item) + "]", all);
    }
    if (!node.opened) return;  // read as something else, which is a fault of its own
    for (const auto& entry : node.entries) {
      if (entry->asked) {
        find_unknown(*entry->value, join(path, entry->key), all);
      } else {
        all.push_back({entry->place, "unknown key " + quote(entry->key) + inside(path),
                       hint_for(*entry, node)});
      }
    }
  }

  static std::string hint_for(const Entry& unknown, const Node& map) {
    std::vector<std::string> absent;
    for (const std::string& key : map.known) {
      if (find(map, key) == nullptr) absent.push_back(key);
    }
    std::string hint = nearest(unknown.key, absent);
    if (hint.empty()) hint = nearest(unknown.key, map.known);
    if (hint.empty() && unknown.key.find(':') != std::string::npos) return blank_needed;
    constexpr std::size_t most = 12;  // words one still reads
    if (hint.empty() && !map.known.empty() && map.known.size() <= most) {
      return "known here: " + joined(map.known);
    }
    return hint;
  }

  void find_not_used(const Node& node, const std::string& path,
                     std::vector<std::string>& result) const {
    for (std::size_t item = 0; item < node.items.size(); ++item) {
      find_not_used(*node.items[item], path + "[" + std::to_string(item) + "]", result);
    }
    for (const auto& entry : node.entries) {
      const std::string here = join(path, entry->key);
      if (entry->asked && !entry->used) {
        result.push_back(here + " (" + text_of(entry->place) + ")");
      } else if (entry->asked) {
        find_not_used(*entry->value, here, result);
      }
    }
  }

  int column(const Place& place) const {
    const auto byte = static_cast<std::size_t>(place.byte);
    return characters(source(place.source).line(place.line).substr(0, byte)) + 1;
  }

  std::string text_of(const Place& place) const {
    const Source& from = source(place.source);
    std::string result = from.name;
    if (place.line < 0) return result;
    if (from.is_file) result += ":" + std::to_string(place.line + 1);
    return result + ":" + std::to_string(column(place));
  }

  Fault report(const Finding& finding) const {
    const Place& place = finding.place;
    const Source& from = source(place.source);
    const bool placed = place.line >= 0;
    Fault fault{from.name,
                placed && from.is_file ? place.line + 1 : 0,
                placed ? column(place) : 0,
                finding.message,
                finding.hint,
                text_of(place) + ": " + finding.message};
    if (!placed || place.line >= static_cast<int>(from.lines.size())) {
      if (!finding.hint.empty()) fault.text += "; " + finding.hint;
      return fault;
    }
    const std::string_view line = from.line(place.line);
    const auto byte = std::min(static_cast<std::size_t>(place.byte), line.size());
    const auto length = static_cast<std::size_t>(std::max(place.length, 0));
    std::string number = from.is_file ? std::to_string(place.line + 1) : "";
    if (number.size() < gutter) number.insert(0, gutter - number.size(), ' ');

    std::string underline(number.size(), ' ');
    underline += " | ";
    for (const char c : line.substr(0, byte)) {
      // A tab as in the line above, so that both are shown as wide.
      if (c == '\t')
        underline += '\t';
      else if (characters({&c, 1}) == 1)
        underline += ' ';
    }
    underline += '^';
    underline.append(
        static_cast<std::size_t>(std::max(characters(line.substr(byte, length)) - 1, 0)), '~');
    fault.text += "\n" + number + " | " + std::string(line) + "\n" + underline;
    if (!finding.hint.empty()) fault.text += "  " + finding.hint;
    return fault;
  }

  std::deque<Source> sources_;
  std::unique_ptr<Node> root_;
  std::deque<Node> extra_;
  std::map<std::string, int> set_;  // path: number of the override
};

namespace {

/// Where to point at when a whole value is wrong: at the key, unless the value is within one line.
const Place& place_of(const Entry& entry, const Node& value) {
  const bool spread = value.kind == Node::Kind::map || value.kind == Node::Kind::list;
  return &value == entry.value.get() && spread && value.place.length == 1 ? entry.place
                                                                          : value.place;
}

std::string name_of(std::string_view key, std::size_t item) {
  return std::string(key) + "[" + std::to_string(item) + "]";
}

std::string missing_quantity(std::string_view key, Dimension dimension) {
  return quote(key) + (dimension == dim::none ? "" : " [" + describe(dimension) + "]");
}

bool is_whole_number(std::string_view text) {
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

Section::Section(std::shared_ptr<Document> document, Node* node, std::string path, Use use)
    : document_(std::move(document)), node_(node), path_(std::move(path)), use_(use) {
  if (node_ != nullptr) node_->opened = true;
}

Section Section::descend(Node* node, std::string path) const {
  return {document_, node, std::move(path), use_};
}

std::string Section::path_of(std::string_view key) const {
  return (path_.empty() ? "" : path_ + ".") + std::string(key);
}

/// The entry of a key that is known from now on, or null.
Entry* Section::ask(std::string_view key) const {
  if (node_ == nullptr) return nullptr;
  auto& known = node_->known;
  if (std::find(known.begin(), known.end(), key) == known.end()) known.emplace_back(key);
  Entry* entry = find(*node_, key);
  if (entry != nullptr) entry->asked = true;
  return entry;
}

/// The entry of a key whose value is wanted, or null. `what` is missing if it is required.
Entry* Section::get(std::string_view key, bool required, const std::string& what) const {
  Entry* entry = ask(key);
  if (entry != nullptr) {
    entry->used = entry->used || use_ != Use::not_used;
    entry->needed = entry->needed || use_ == Use::used;
  } else if (node_ != nullptr && required && use_ == Use::used) {
    document_->findings.push_back({node_->place, "missing " + what + inside(path_), ""});
  }
  return entry;
}

void Section::wrong(Entry& entry, const Place& at, std::string message, std::string hint) const {
  const bool stays = use_ == Use::used;
  entry.faulty = entry.faulty || stays;
  document_->findings.push_back(
      {at, std::move(message), std::move(hint), stays ? nullptr : &entry});
}

void Section::accept(Entry& entry, std::string_view key, Resolved::Value value,
                     std::string unit) const {
  entry.sound = entry.sound || use_ == Use::undecided;
  record(key, std::move(value), std::move(unit), false);
}

void Section::record(std::string_view key, Resolved::Value value, std::string unit,
                     bool is_default) const {
  if (node_ == nullptr || use_ == Use::not_used) return;
  std::string path = path_of(key);
  if (!document_->recorded.insert(path).second) return;  // read twice
  document_->resolved.push_back({std::move(path), std::move(value), std::move(unit), is_default});
}

bool Section::is_scalar(Entry& entry, const Node& value, const std::string& name) const {
  if (value.kind == Node::Kind::scalar) return true;
  const Place& at = place_of(entry, value);
  if (value.kind == Node::Kind::empty) {
    wrong(entry, at, quote(name) + " has no value");
  } else {
    const char* kind = value.kind == Node::Kind::list ? " is a list" : " is a section";
    wrong(entry, at, quote(name) + kind + ": expected a single value");
  }
  return false;
}

bool Section::is_list(Entry& entry, std::string_view key, const std::string& expected) const {
  const Node& value = *entry.value;
  if (value.kind == Node::Kind::list) return true;
  const Place& at = place_of(entry, value);
  if (value.kind == Node::Kind::empty) {
    wrong(entry, at, quote(key) + " has no value: expected " + expected + ", '[]' for none");
  } else {
    wrong(entry, at, quote(key) + " is no list: expected " + expected);
  }
  return false;
}

bool Section::read(Entry& entry, const Node& node, const std::string& name, Dimension dimension,
                   const Range& range, double& value) const {
  if (!is_scalar(entry, node, name)) return false;
  const std::string said = quote(name) + " = " + shown(node);
  if (node.quoted) {
    wrong(entry, node.place, quote(name) + " is a quoted text: write the number without quotes");
    return false;
  }
  const auto parsed = parse_quantity(node.text);
  if (const auto* fault = std::get_if<TextFault>(&parsed)) {
    Place at = node.place;
    const auto line = document_->source(at.source).line(at.line);
    const auto from = std::min(static_cast<std::size_t>(at.byte), line.size());
    if (line.substr(from, node.text.size()) == node.text) {
      at.byte += fault->column - 1;
      at.length = fault->length;
    }
    wrong(entry, at, "cannot read " + said + ": " + fault->message);
    return false;
  }
  const auto& quantity = std::get<Quantity>(parsed);
  const std::string unit = si_unit(dimension);
  std::string message;
  if (dimension == dim::none && quantity.has_unit) {
    message = said + " has a unit: expected a plain number";
  } else if (dimension != dim::none && !quantity.has_unit) {
    message = said + " has no unit: expected one of dimension [" + describe(dimension) +
              "], for example '" + unit + "'";
  } else if (quantity.dimension != dimension) {
    message = said + " has the dimension [" + describe(quantity.dimension) + "]: expected [" +
              describe(dimension) + "], for example '" + unit + "'";
  } else if (!range.contains(quantity.value)) {
    message = said + " is out of range: expected " +
              range_text(name, range.low, range.high, range.with_low, range.with_high, unit);
  }
  if (!message.empty()) {
    wrong(entry, node.place, std::move(message));
    return false;
  }
  value = quantity.value;
  return true;
}

bool Section::read(Entry& entry, const Node& node, const std::string& name, int low, int high,
                   int& value) const {
  if (!is_scalar(entry, node, name)) return false;
  const std::string said = quote(name) + " = " + shown(node);
  if (node.quoted) {
    wrong(entry, node.place, quote(name) + " is a quoted text: write the number without quotes");
    return false;
  }
  if (!is_whole_number(node.text)) {
    wrong(entry, node.place, said + " is not a whole number");
    return false;
  }
  const bool has_sign = node.text[0] == '-' || node.text[0] == '+';
  const std::string_view digits = std::string_view(node.text).substr(has_sign ? 1 : 0);
  if (digits.size() > 1 && digits[0] == '0') {
    wrong(entry, node.place, said + " has a leading zero, which could mean an octal number");
    return false;
  }
  int number = 0;
  const std::string_view text = std::string_view(node.text).substr(node.text[0] == '+' ? 1 : 0);
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc{} || number < low || number > high) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double from = low == std::numeric_limits<int>::min() ? -infinity : low;
    const double to = high == std::numeric_limits<int>::max() ? infinity : high;
    const std::string expected = std::isfinite(from) || std::isfinite(to)
                                     ? range_text(name, from, to, true, true, "1")
                                     : "a number of at most nine digits";
    wrong(entry, node.place, said + " is out of range: expected " + expected);
    return false;
  }
  value = number;
  return true;
}

bool Section::read(Entry& entry, const Node& node, const std::string& name,
                   std::string& value) const {
  if (!is_scalar(entry, node, name)) return false;
  if (node.text.empty()) {
    wrong(entry, node.place, quote(name) + " is empty");
    return false;
  }
  value = node.text;
  return true;
}

bool Section::read(Entry& entry, const Node& node, const std::string& name, const TextCheck& check,
                   std::string& value) const {
  std::string said;
  if (!read(entry, node, name, said)) return false;
  if (const auto fault = check(said)) {
    Place at = node.place;
    const auto line = document_->source(at.source).line(at.line);
    const std::size_t from = line.find(said, std::min(static_cast<std::size_t>(at.byte), line.size()));
    if (from != std::string_view::npos) {
      at.byte = static_cast<int>(from) + fault->column - 1;
      at.length = fault->length;
    }
    wrong(entry, at, "cannot read " + quote(name) + " = " + shown(node) + ": " + fault->message);
    return false;
  }
  value = said;
  return true;
}

Section Section::section(std::string_view key) const {
  std::string path = path_of(key);
  Entry* entry = get(key, true, "section " + quote(key));
  if (entry == nullptr) return descend(nullptr, std::move(path));
  Node& value = *entry->value;
  const bool is_map = value.kind == Node::Kind::map;
  if (is_map && !value.entries.empty()) return descend(&value, std::move(path));
  const Place& at = place_of(*entry, value);
  if (is_map || value.kind == Node::Kind::empty) {
    wrong(*entry, at, "section " + quote(key) + " is empty");
  } else {
    wrong(*entry, at, quote(key) + " must be a section of keys", Document::colon_hint(value));
  }
  return descend(nullptr, std::move(path));
}

Section Section::section_or_empty(std::string_view key) const {
  const Entry* entry = ask(key);
  if (entry != nullptr &&
      !(entry->value->kind == Node::Kind::map && entry->value->entries.empty())) {
    return section(key);
  }
  if (entry != nullptr) get(key, false, "");
  if (node_ == nullptr || use_ == Use::not_used) return descend(nullptr, path_of(key));
  return descend(document_->empty_section(entry == nullptr ? node_->place : entry->place),
                 path_of(key));
}

std::vector<Section> Section::list(std::string_view key, int fewest) const {
  std::vector<Section> result;
  Entry* entry = get(key, fewest > 0, "list " + quote(key));
  if (entry == nullptr || !is_list(*entry, key, "a list of sections")) return result;
  const auto& items = entry->value->items;
  for (std::size_t item = 0; item < items.size(); ++item) {
    const std::string name = name_of(key, item);
    Node& value = *items[item];
    const bool good = value.kind == Node::Kind::map && !value.entries.empty();
    if (!good) {
      wrong(*entry, value.place, quote(name) + " must be a section of keys",
            Document::colon_hint(value));
    }
    result.push_back(descend(good ? &value : nullptr, path_of(name)));
  }
  if (static_cast<int>(items.size()) < fewest) {
    wrong(*entry, place_of(*entry, *entry->value),
          quote(key) + " has " + counted(items.size(), "item") + ": expected at least " +
              std::to_string(fewest));
  }
  return result;
}

Section Section::when(bool used) const {
  Section result = *this;
  if (use_ != Use::used) return result;
  if (node_ != nullptr && node_->undecided) {
    result.use_ = Use::undecided;
  } else if (!used) {
    result.use_ = Use::not_used;
  }
  return result;
}

bool Section::has(std::string_view key) const { return ask(key) != nullptr; }

std::vector<std::string> Section::keys() const {
  std::vector<std::string> result;
  if (node_ == nullptr) return result;
  for (const auto& entry : node_->entries) result.push_back(entry->key);
  return result;
}

double Section::quantity(std::string_view key, const double* otherwise, Dimension dimension,
                         const Range& range) const {
  Entry* entry = get(key, otherwise == nullptr, missing_quantity(key, dimension));
  if (entry == nullptr && otherwise != nullptr) {
    record(key, *otherwise, si_unit(dimension), true);
    return *otherwise;
  }
  if (entry == nullptr && use_ != Use::used) return std::numeric_limits<double>::quiet_NaN();
  double value = otherwise != nullptr ? *otherwise : harmless(range);
  if (entry != nullptr && read(*entry, *entry->value, std::string(key), dimension, range, value)) {
    accept(*entry, key, value, si_unit(dimension));
  }
  return value;
}

double Section::quantity(std::string_view key, Dimension dimension, Range range) const {
  return quantity(key, nullptr, dimension, range);
}

double Section::quantity_or(std::string_view key, double default_si, Dimension dimension,
                            Range range) const {
  return quantity(key, &default_si, dimension, range);
}

double Section::number(std::string_view key, Range range) const {
  return quantity(key, nullptr, dim::none, range);
}

double Section::number_or(std::string_view key, double otherwise, Range range) const {
  return quantity(key, &otherwise, dim::none, range);
}

int Section::count(std::string_view key, const int* otherwise, int low, int high) const {
  Entry* entry = get(key, otherwise == nullptr, quote(key));
  int value = otherwise != nullptr ? *otherwise : low;
  if (entry == nullptr) {
    if (otherwise != nullptr) record(key, std::int64_t{value}, "1", true);
    return value;
  }
  if (read(*entry, *entry->value, std::string(key), low, high, value)) {
    accept(*entry, key, std::int64_t{value}, "1");
  }
  return value;
}

int Section::count(std::string_view key, int low, int high) const {
  return count(key, nullptr, low, high);
}

int Section::count_or(std::string_view key, int otherwise, int low, int high) const {
  return count(key, &otherwise, low, high);
}

bool Section::flag(std::string_view key, const bool* otherwise) const {
  Entry* entry = get(key, otherwise == nullptr, quote(key));
  const bool value = otherwise != nullptr && *otherwise;
  if (entry == nullptr) {
    if (otherwise != nullptr) record(key, value, "", true);
    return value;
  }
  const Node& node = *entry->value;
  if (!is_scalar(*entry, node, std::string(key))) return value;
  if (node.quoted || (node.text != "true" && node.text != "false")) {
    const std::string said = node.quoted ? quote(key) + " is a quoted text"
                                         : quote(key) + " = " + shown(node) + " is unknown";
    wrong(*entry, node.place, said + ": expected true or false");
    return value;
  }
  accept(*entry, key, node.text == "true", "");
  return node.text == "true";
}

bool Section::flag(std::string_view key) const { return flag(key, nullptr); }

bool Section::flag_or(std::string_view key, bool otherwise) const { return flag(key, &otherwise); }

std::string Section::word(std::string_view key, const std::string_view* otherwise,
                          const std::vector<std::string>* options) const {
  Entry* entry = get(key, otherwise == nullptr, quote(key));
  std::string value;
  if (otherwise != nullptr) {
    value = *otherwise;
  } else if (options != nullptr && !options->empty()) {
    value = options->front();
  }
  if (entry == nullptr && otherwise != nullptr) {
    record(key, value, "", true);
    return value;
  }
  std::string said;
  if (entry != nullptr && read(*entry, *entry->value, std::string(key), said)) {
    if (options == nullptr || std::find(options->begin(), options->end(), said) != options->end()) {
      accept(*entry, key, said, "");
      return said;
    }
    wrong(*entry, entry->value->place,
          quote(key) + " = " + shown(*entry->value) + " is unknown: expected one of " +
              joined(*options),
          nearest(said, *options));
  }
  if (options != nullptr && node_ != nullptr && use_ != Use::not_used) node_->undecided = true;
  return value;
}

std::string Section::word(std::string_view key) const { return word(key, nullptr, nullptr); }

std::string Section::word_or(std::string_view key, std::string_view otherwise) const {
  return word(key, &otherwise, nullptr);
}

std::string Section::choice(std::string_view key, const std::vector<std::string>& options) const {
  return word(key, nullptr, &options);
}

std::string Section::choice_or(std::string_view key, std::string_view otherwise,
                               const std::vector<std::string>& options) const {
  return word(key, &otherwise, &options);
}

std::string Section::text(std::string_view key, const TextCheck& check) const {
  Entry* entry = get(key, true, quote(key));
  std::string value = "0";
  if (entry != nullptr && read(*entry, *entry->value, std::string(key), check, value)) accept(*entry, key, value, "");
  return value;
}

std::array<std::string, 3> Section::texts(std::string_view key, const TextCheck& check) const {
  std::array<std::string, 3> value{"0", "0", "0"};
  Entry* entry = get(key, true, quote(key));
  if (entry == nullptr || !is_list(*entry, key, "three texts as in '[\"0\", \"0\", \"1\"]'")) return value;
  const auto& items = entry->value->items;
  if (items.size() != value.size()) {
    wrong(*entry, place_of(*entry, *entry->value), quote(key) + " has " + counted(items.size(), "value") + ": expected 3");
    return value;
  }
  std::array<std::string, 3> said = value;
  bool good = true;
  for (std::size_t axis = 0; axis < said.size(); ++axis) good &= read(*entry, *items[axis], name_of(key, axis), check, said[axis]);
  if (!good) return value;
  accept(*entry, key, std::vector<std::string>(said.begin(), said.end()), "");
  return said;
}

std::array<double, 3> Section::vector(std::string_view key, const std::array<double, 3>* otherwise,
                                      Dimension dimension) const {
  Entry* entry = get(key, otherwise == nullptr, missing_quantity(key, dimension));
  const std::string unit = si_unit(dimension);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 3> value{1, 1, 1};
  if (otherwise != nullptr) value = *otherwise;
  if (entry == nullptr) {
    if (otherwise != nullptr) {
      record(key, std::vector<double>(value.begin(), value.end()), unit, true);
    } else if (use_ != Use::used) {
      value = {nan, nan, nan};
    }
    return value;
  }
  if (!is_list(*entry, key, "three values as in '[0, 0, 1]'")) return value;
  const auto& items = entry->value->items;
  if (items.size() != value.size()) {
    wrong(*entry, place_of(*entry, *entry->value),
          quote(key) + " has " + counted(items.size(), "value") + ": expected 3");
    return value;
  }
  std::array<double, 3> said{};
  bool good = true;
  for (std::size_t axis = 0; axis < said.size(); ++axis) {
    good &= read(*entry, *items[axis], name_of(key, axis), dimension, any, said[axis]);
  }
  if (!good) return value;
  accept(*entry, key, std::vector<double>(said.begin(), said.end()), unit);
  return said;
}

std::array<double, 3> Section::vector(std::string_view key, Dimension dimension) const {
  return vector(key, nullptr, dimension);
}

std::array<double, 3> Section::vector_or(std::string_view key,
                                         const std::array<double, 3>& default_si,
                                         Dimension dimension) const {
  return vector(key, &default_si, dimension);
}

std::array<int, 3> Section::counts(std::string_view key, int low, int high) const {
  const std::array<int, 3> lowest{low, low, low};
  Entry* entry = get(key, true, quote(key));
  if (entry == nullptr || !is_list(*entry, key, "three whole numbers")) return lowest;
  const auto& items = entry->value->items;
  if (items.size() != lowest.size()) {
    wrong(*entry, place_of(*entry, *entry->value),
          quote(key) + " has " + counted(items.size(), "value") + ": expected 3");
    return lowest;
  }
  std::array<int, 3> said{};
  bool good = true;
  for (std::size_t axis = 0; axis < said.size(); ++axis) {
    good &= read(*entry, *items[axis], name_of(key, axis), low, high, said[axis]);
  }
  if (!good) return lowest;
  accept(*entry, key, std::vector<double>(said.begin(), said.end()), "1");
  return said;
}

std::vector<double> Section::quantities(std::string_view key, Dimension dimension, Range range,
                                        int fewest) const {
  Entry* entry = get(key, fewest > 0, missing_quantity(key, dimension));
  std::vector<double> result(static_cast<std::size_t>(std::max(fewest, 0)), harmless(range));
  if (entry == nullptr || !is_list(*entry, key, "a list of values")) return result;
  const auto& items = entry->value->items;
  if (static_cast<int>(items.size()) < fewest) {
    wrong(*entry, place_of(*entry, *entry->value),
          quote(key) + " has " + counted(items.size(), "value") + ": expected at least " +
              std::to_string(fewest));
    return result;
  }
  result.assign(items.size(), harmless(range));
  bool good = true;
  for (std::size_t item = 0; item < items.size(); ++item) {
    good &= read(*entry, *items[item], name_of(key, item), dimension, range, result[item]);
  }
  if (good) accept(*entry, key, result, si_unit(dimension));
  return result;
}

std::vector<std::string> Section::words(std::string_view key, int fewest) const {
  Entry* entry = get(key, fewest > 0, quote(key));
  std::vector<std::string> result;
  if (entry == nullptr || !is_list(*entry, key, "a list of words")) return result;
  const auto& items = entry->value->items;
  if (static_cast<int>(items.size()) < fewest) {
    wrong(*entry, place_of(*entry, *entry->value),
          quote(key) + " has " + counted(items.size(), "word") + ": expected at least " +
              std::to_string(fewest));
    return result;
  }
  result.resize(items.size());
  bool good = true;
  for (std::size_t item = 0; item < items.size(); ++item) {
    good &= read(*entry, *items[item], name_of(key, item), result[item]);
  }
  if (good) accept(*entry, key, result, "");
  return result;
}

void Section::fault(std::string_view key, std::string message, std::string hint) const {
  Entry* entry = ask(key);
  if (entry != nullptr && !entry->faulty) {
    wrong(*entry, place_of(*entry, *entry->value), std::move(message), std::move(hint));
  } else if (entry == nullptr && node_ != nullptr && use_ == Use::used) {
    document_->findings.push_back({node_->place, std::move(message), std::move(hint)});
  }
}

void Section::unknown_name(std::string_view key, const std::string& name, const std::string& what,
                           const std::vector<std::string>& names) const {
  Entry* entry = ask(key);
  if (entry == nullptr || entry->faulty) return;
  const Node* at = entry->value.get();
  for (const auto& item : entry->value->items) {
    if (item->text == name) at = item.get();
  }
  document_->findings.push_back({place_of(*entry, *at),
                                 quote(key) + " = " + shown(*at) + " is unknown: " +
                                     (names.empty() ? "there are no " + what : what + " are " + listed(names)),
                                 nearest(name, names)});
}

std::string Section::beside_case(std::string_view path) const {
  return (std::filesystem::path(document_->source(0).name).parent_path() / path).string();
}

bool Section::sound() const { return document_->sound(); }

CaseError::CaseError(std::string case_path, std::vector<Fault> all)
    : path(std::move(case_path)), faults(std::move(all)) {
  for (const Fault& fault : faults) text_ += fault.text + "\n";
  text_ += counted(faults.size(), "fault") + " in " + path;
}

CaseFile CaseFile::read(const std::string& path, const std::vector<std::string>& overrides) {
  const auto refuse = [&](const std::string& why) {
    const std::string message = "cannot be read: " + why;
    throw CaseError(path, {Fault{path, 0, 0, message, "", path + ": " + message}});
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse("it is a folder");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(errno == 0 ? "it cannot be opened" : std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) refuse("reading it failed");
  return parse(text.str(), path, overrides);
}

CaseFile CaseFile::parse(const std::string& text, const std::string& path,
                         const std::vector<std::string>& overrides) {
  return CaseFile(std::make_shared<Document>(path, text, overrides));
}

Section CaseFile::root() const { return {document_, document_->root(), "", Section::Use::used}; }

void CaseFile::finish() const { document_->throw_if_any(); }

std::vector<std::string> CaseFile::not_used() const { return document_->not_used(); }

const std::vector<Resolved>& CaseFile::resolved() const { return document_->resolved; }

std::string CaseFile::hash() const {
  std::uint64_t state = 0xcbf29ce484222325U;  // FNV-1a, 64 bit: offset and prime as published
  const auto add = [&](std::string_view text) {
    for (const char c : text) {
      state = (state ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    }
    state *= 0x100000001b3U;  // as a byte of value zero, so that "ab", "c" differs from "a", "bc"
  };
  struct Text {
    std::string operator()(double value) const { return shortest(value); }
    std::string operator()(std::int64_t value) const { return std::to_string(value); }
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(const std::string& value) const { return value; }
    std::string operator()(const std::vector<double>& values) const {
      std::string result;
      for (const double value : values) result += shortest(value) + " ";
      return result;
    }
    std::string operator()(const std::vector<std::string>& values) const {
      std::string result;
      for (const std::string& value : values) result += value + '\0';
      return result;
    }
  };
  for (const Resolved& one : document_->resolved) {
    add(one.path);
    add(std::visit(Text{}, one.value));
    add(one.unit);
  }
  constexpr int digits = 16;
  std::string result(digits, '0');
  for (int digit = digits - 1; digit >= 0; --digit, state >>= 4U) {
    result[static_cast<std::size_t>(digit)] = "0123456789abcdef"[state & 0xFU];
  }
  return result;
}

}  // namespace nereid::input
