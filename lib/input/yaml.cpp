#include "input/yaml.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

#include "base/words.hpp"

namespace nereid::input {

Entry* find(const Node& map, std::string_view key) {
  for (const auto& entry : map.entries) {
    if (entry->key == key) return entry.get();
  }
  return nullptr;
}

namespace {

constexpr std::size_t most_nodes = 1'000'000;  // so that aliases of aliases end before memory does
constexpr std::size_t most_depth = 500;        // of sections and lists within each other: yaml-cpp goes as deep
constexpr const char* open_bracket = "are all brackets closed?";

/// depth  of the node
std::unique_ptr<Node> copy(const Node& node, std::size_t& count, std::size_t depth) {
  if (depth > most_depth) throw Stop{node.place, "aliases stand too deep within each other", ""};
  if (++count > most_nodes) throw Stop{node.place, "aliases repeat too many values", ""};
  auto result = std::make_unique<Node>();
  result->kind = node.kind;
  result->place = node.place;
  result->text = node.text;
  result->quoted = node.quoted;
  for (const auto& entry : node.entries) {
    auto value = copy(*entry->value, count, depth + 1);
    result->entries.push_back(std::make_unique<Entry>(Entry{entry->key, entry->place, {}}));
    result->entries.back()->value = std::move(value);
  }
  for (const auto& item : node.items) result->items.push_back(copy(*item, count, depth + 1));
  return result;
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
    auto repeated = copy(*original, count_, frames_.size());
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
    std::unordered_map<std::string, const Entry*> keys;  // of a map, by name
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
    frames_.push_back({node, std::move(path), std::nullopt, {}, {}});
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
    } else if (const auto [first, fresh] = frame.keys.emplace(entry->key, entry.get()); !fresh) {
      findings_.push_back({entry->place,
                           "repeated key " + quote(entry->key) + inside(frame.path) +
                               ": first given in line " + std::to_string(first->second->place.line + 1),
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

}  // namespace

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

}  // namespace nereid::input
