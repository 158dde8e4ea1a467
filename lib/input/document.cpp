#include "input/document.hpp"

#include <algorithm>
#include <charconv>
#include <tuple>

#include "base/words.hpp"
#include "input/retired.hpp"

namespace nereid::input {

namespace {

constexpr std::size_t gutter = 5;          // width of a line number in a report
constexpr std::size_t most_faults = 50;    // that are told; one mends no more at a time
constexpr std::size_t longest_said = 600;  // [bytes] of a message, of a hint
constexpr std::size_t longest_set = 100;   // [bytes] that are shown of --set
constexpr std::size_t before_fault = 80, behind_fault = 120;  // [bytes] that are shown of a longer line
constexpr std::size_t most_steps = 100;    // keys of a path

/// A key of a path on the command line, with the items of lists behind it.
struct Step {
  std::string key;
  std::vector<std::size_t> indices;
  Place place;
  std::string path;  // up to here, items without leading zeros: one text for each value
};

std::string join(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::vector<Step> split_path(const std::string& path, int number) {
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
    step.path = join(steps.empty() ? "" : steps.back().path, step.key);
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
      step.path += "[" + std::to_string(index) + "]";
      bracket = static_cast<std::size_t>(read.ptr + 1 - part.data());
    }
    if (steps.size() == most_steps) throw Stop{step.place, "the path has more than " + std::to_string(most_steps) + " keys", ""};
    steps.push_back(std::move(step));
    if (end == path.size()) return steps;
    start = end + 1;
  }
}

/// also  keys that may stand here and that no reader asks for where they do not
std::string hint_for(const Entry& unknown, const Node& map, const std::vector<std::string>& also) {
  std::vector<std::string> absent = also;
  for (const std::string& key : map.known) {
    if (find(map, key) == nullptr) absent.push_back(key);
  }
  std::string hint = nearest(unknown.key, absent);
  if (hint.empty()) hint = nearest(unknown.key, map.known);
  if (hint.empty() && unknown.key.find(':') != std::string::npos) return blank_needed;
  constexpr std::size_t most = 13;  // words one still reads
  if (hint.empty() && !map.known.empty() && map.known.size() <= most) {
    return "known here: " + joined(map.known);
  }
  return hint;
}

/// A part of a line, and where in it a fault is.
struct Excerpt {
  std::string text;
  std::size_t byte, length;
};

/// What is shown of a line: all of it, or what is around the fault.
Excerpt excerpt(std::string_view line, std::size_t byte, std::size_t length) {
  if (line.size() <= before_fault + behind_fault) return {std::string(line), byte, length};
  const auto begins = [line](std::size_t at) { return at >= line.size() || (static_cast<unsigned char>(line[at]) & 0xC0U) != 0x80U; };
  std::size_t from = byte - std::min(byte, before_fault), to = std::min(line.size(), byte + behind_fault);
  while (!begins(from)) --from;
  while (!begins(to)) ++to;
  const std::string left = from > 0 ? "..." : "", right = to < line.size() ? "..." : "";
  return {left + std::string(line.substr(from, to - from)) + right, left.size() + byte - from, std::min(length, to - byte)};
}

}  // namespace

Document::Document(std::string path, std::string text, const std::vector<std::string>& overrides) {
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
    sources_.emplace_back("--set " + clipped(override_text, longest_set), false, override_text);
    try {
      apply(override_text, number);
    } catch (Stop& stop) {
      findings.push_back({stop.place, std::move(stop.message), std::move(stop.hint)});
    }
  }
}

Node* Document::empty_section(const Place& place) {
  extra_.emplace_back();
  extra_.back().kind = Node::Kind::map;
  extra_.back().place = place;
  return &extra_.back();
}

void Document::fault(const std::string& path, std::string message, std::string hint) {
  const Node* node = root_.get();
  Place place = node->place;
  for (const Step& step : path.empty() ? std::vector<Step>{} : split_path(path, 0)) {
    place = node->place;
    const Entry* entry = node->kind == Node::Kind::map ? find(*node, step.key) : nullptr;
    if (entry == nullptr) break;
    node = entry->value.get();
    for (const std::size_t index : step.indices)
      if (node->kind == Node::Kind::list && index < node->items.size()) node = node->items[index].get();
    place = place_of(*entry, *node);
  }
  findings.push_back({place, std::move(message), std::move(hint)});
}

Entry* Document::from_preset(Node& section, const std::string& section_path, std::string_view key) {
  const Setting* setting = preset == nullptr ? nullptr : find_setting(*preset, section_path, key);
  if (setting == nullptr) return nullptr;
  section.entries.push_back(std::make_unique<Entry>());
  Entry& entry = *section.entries.back();
  entry.key = key;
  entry.place = preset_place;
  entry.of_preset = true;
  entry.value = std::make_unique<Node>();
  entry.value->kind = Node::Kind::scalar;
  entry.value->place = preset_place;
  entry.value->text = setting->value;
  of_preset_.emplace_back(join(section_path, entry.key), &entry);
  return &entry;
}

std::vector<std::string> Document::preset_lines() const {
  std::vector<std::string> lines;
  for (const auto& [path, entry] : of_preset_)
    if (entry->used) lines.push_back(path + " = " + entry->value->text);
  return lines;
}

bool Document::sound() const {
  return std::all_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.tentative != nullptr; });
}

void Document::throw_if_any() const {
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
  std::set<std::tuple<int, int, int, std::string_view>> seen;  // what is read twice or through aliases is at fault once
  for (const Finding& finding : all) {
    const Place& at = finding.place;
    if (seen.emplace(at.source, at.line, at.byte, finding.message).second && faults.size() < most_faults) faults.push_back(report(finding));
  }
  const std::size_t told = faults.size();
  throw CaseError(sources_[0].name, std::move(faults), seen.size() - told);
}

std::vector<std::string> Document::not_used() const {
  std::vector<std::string> result;
  find_not_used(*root_, "", result);
  return result;
}

std::string Document::colon_hint(const Node& node) {
  const bool likely =
      node.kind == Node::Kind::scalar && !node.quoted && node.text.find(':') != std::string::npos;
  return likely ? blank_needed : "";
}

void Document::check_text(const std::string& text) const {
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

void Document::apply(const std::string& text, int number) {
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
  const auto [earlier, fresh] = set_.emplace(last.path, number);
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

void Document::find_unknown(const Node& node, const std::string& path, std::vector<Finding>& all) const {
  for (std::size_t item = 0; item < node.items.size(); ++item) {
    find_unknown(*node.items[item], path + "[" + std::to_string(item) + "]", all);
  }
  if (!node.opened) return;  // read as something else, which is a fault of its own
  const std::vector<std::string> of_root = path.empty() ? std::vector<std::string>{"accuracy", "refine"} : std::vector<std::string>{};
  for (const auto& entry : node.entries) {
    if (entry->asked) {
      find_unknown(*entry->value, join(path, entry->key), all);
    } else {
      const std::string now = renamed(path, entry->key);
      all.push_back({entry->place, "unknown key " + quote(entry->key) + inside(path), now});
      if (now.empty()) all.back().late_hint = [&one = *entry, &node, of_root] { return hint_for(one, node, of_root); };
    }
  }
}

void Document::find_not_used(const Node& node, const std::string& path,
                   std::vector<std::string>& result) const {
  for (std::size_t item = 0; item < node.items.size(); ++item) {
    find_not_used(*node.items[item], path + "[" + std::to_string(item) + "]", result);
  }
  for (const auto& entry : node.entries) {
    const std::string here = join(path, entry->key);
    if (entry->of_preset) continue;
    if (entry->asked && !entry->used) {
      result.push_back(here + " (" + text_of(entry->place) + ")");
    } else if (entry->asked) {
      find_not_used(*entry->value, here, result);
    }
  }
}

int Document::column(const Place& place) const {
  const auto byte = static_cast<std::size_t>(place.byte);
  return characters(source(place.source).line(place.line).substr(0, byte)) + 1;
}

std::string Document::text_of(const Place& place) const {
  const Source& from = source(place.source);
  std::string result = from.name;
  if (place.line < 0) return result;
  if (from.is_file) result += ":" + std::to_string(place.line + 1);
  return result + ":" + std::to_string(column(place));
}

Fault Document::report(const Finding& finding) const {
  const Place& place = finding.place;
  const Source& from = source(place.source);
  const bool placed = place.line >= 0;
  const std::string message = clipped(finding.message, longest_said);
  const std::string hint = clipped(finding.late_hint ? finding.late_hint() : finding.hint, longest_said);
  Fault fault{from.name,
              placed && from.is_file ? place.line + 1 : 0,
              placed ? column(place) : 0,
              message,
              hint,
              text_of(place) + ": " + message};
  if (!placed || place.line >= static_cast<int>(from.lines.size())) {
    if (!hint.empty()) fault.text += "; " + hint;
    return fault;
  }
  const std::string_view whole = from.line(place.line);
  const auto [shown, byte, length] = excerpt(whole, std::min(static_cast<std::size_t>(place.byte), whole.size()),
                                             static_cast<std::size_t>(std::max(place.length, 0)));
  const std::string_view line = shown;
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
  if (!hint.empty()) fault.text += "  " + hint;
  return fault;
}

}  // namespace nereid::input
