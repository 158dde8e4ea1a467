#include "input/section.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <utility>

#include "base/checksum.hpp"
#include "base/words.hpp"
#include "input/document.hpp"
#include "input/preset.hpp"
#include "input/retired.hpp"
#include "input/survey.hpp"
#include "input/text_file.hpp"
#include "mesh/split.hpp"

namespace nereid::input {

namespace {

constexpr std::size_t longest_name = 4096;  // [bytes] that is shown of a path
constexpr double most_refined = 64;         // [-] a count of cells is multiplied by no more, and divided

/// A value as it may be shown within a message of one line.
std::string shown(const Node& scalar) {
  constexpr std::size_t longest = 60;
  std::string text = clipped(scalar.text, longest);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// A value that passes for one of the range while reading goes on after a fault.
double harmless(const Range& range) {
  const bool from = std::isfinite(range.low), to = std::isfinite(range.high);
  if (from && to) return range.low + (range.high - range.low) / 2;
  return from ? range.low + 1 : to ? range.high - 1 : 1;
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

/// Keeps what is asked, where a case is surveyed: its path, whether it is used, and what the caller knows of it.
void Section::note(std::string_view key, AskedKey asked) const {
  if (document_->survey == nullptr) return;
  asked.path = path_of(key);
  for (std::size_t at = asked.path.find("[0]"); at != std::string::npos; at = asked.path.find("[0]", at)) asked.path.erase(at + 1, 1);
  asked.required = asked.required && use_ == Use::used;
  document_->survey->asked.push_back({std::move(asked), use_ != Use::not_used});
}

/// Whether a surveyed case is asked; then the question is kept, and answered by the first answer unless the survey says another one.
bool Section::answer(std::string_view key, const std::vector<std::string>& answers, std::string& given) const {
  if (document_->survey == nullptr) return false;
  std::string path = path_of(key);
  for (std::size_t at = path.find("[0]"); at != std::string::npos; at = path.find("[0]", at)) path.erase(at + 1, 1);
  document_->survey->questions.push_back({path, answers, use_ != Use::not_used});
  const auto said = document_->survey->answers.find(path);
  const bool fits = said != document_->survey->answers.end() && std::find(answers.begin(), answers.end(), said->second) != answers.end();
  given = fits ? said->second : answers.front();
  return true;
}

/// The entry of a key that is known from now on, or null.
Entry* Section::ask(std::string_view key) const {
  if (node_ == nullptr) return nullptr;
  auto& known = node_->known;
  if (std::find(known.begin(), known.end(), key) == known.end()) known.emplace_back(key);
  Entry* entry = find(*node_, key);
  if (entry == nullptr) entry = document_->from_preset(*node_, path_, key);
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
              words_of(range, name, unit);
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
    const bool too_long = result.ec == std::errc::result_out_of_range && !std::isfinite(text[0] == '-' ? from : to);
    const std::string expected = too_long ? "a number of at most nine digits" : words_of(within(from, to), name, "1");
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
  note(key, {.path = {}, .type = "section", .unit = {}, .range = {}, .otherwise = {}, .required = true});
  if (document_->survey != nullptr) return descend(document_->empty_section({}), std::move(path));
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
  if (document_->survey != nullptr) {
    note(key, {.path = {}, .type = "section", .unit = {}, .range = {}, .otherwise = {}});
    return descend(document_->empty_section({}), path_of(key));
  }
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
  note(key, {.path = {}, .type = "sections", .unit = {}, .range = {}, .otherwise = {}, .required = fewest > 0});
  if (document_->survey != nullptr) return {descend(document_->empty_section({}), path_of(name_of(key, 0)))};
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

bool Section::surveyed() const { return document_->survey != nullptr; }

bool Section::decided() const { return node_ != nullptr && !node_->undecided; }

bool Section::has(std::string_view key) const {
  std::string given;
  if (answer(key, {"", "given"}, given)) return !given.empty();
  return ask(key) != nullptr;
}

std::vector<std::string> Section::keys() const {
  std::vector<std::string> result;
  if (node_ == nullptr) return result;
  for (const auto& entry : node_->entries) result.push_back(entry->key);
  return result;
}

double Section::quantity(std::string_view key, const double* otherwise, Dimension dimension,
                         const Range& range) const {
  note(key, {.path = {},
             .type = dimension == dim::none ? "number" : "quantity",
             .unit = dimension == dim::none ? "1" : si_unit(dimension),
             .range = std::isfinite(range.low) || std::isfinite(range.high) ? words_of(range, std::string(key), si_unit(dimension)) : "",
             .otherwise = otherwise == nullptr ? "" : shortest(*otherwise),
             .required = otherwise == nullptr});
  std::string given;
  if (dimension == dim::none && otherwise != nullptr && *otherwise == 0 && range.contains(1) && answer(key, {"0", above_zero}, given))
    return given == above_zero ? 1 : 0;
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
  const double infinity = std::numeric_limits<double>::infinity();
  const double to = high == std::numeric_limits<int>::max() ? infinity : high;
  note(key, {.path = {},
             .type = "count",
             .unit = "1",
             .range = words_of(within(low == std::numeric_limits<int>::min() ? -infinity : low, to), std::string(key), "1"),
             .otherwise = otherwise == nullptr ? "" : std::to_string(*otherwise),
             .required = otherwise == nullptr});
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
  std::string given;
  const bool usual = otherwise != nullptr && *otherwise;
  note(key, {.path = {},
             .type = "flag",
             .unit = {},
             .range = {},
             .otherwise = otherwise == nullptr ? "" : usual ? "true" : "false",
             .required = otherwise == nullptr});
  if (answer(key, usual ? std::vector<std::string>{"true", "false"} : std::vector<std::string>{"false", "true"}, given))
    return given == "true";
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
  note(key, {.path = {},
             .type = options == nullptr ? "word" : "choice",
             .unit = {},
             .range = {},
             .otherwise = otherwise == nullptr ? "" : std::string(*otherwise),
             .required = otherwise == nullptr,
             .options = options == nullptr ? std::vector<std::string>{} : *options});
  if (std::string given; options != nullptr) {
    std::vector<std::string> answers = *options;
    if (otherwise != nullptr) std::stable_partition(answers.begin(), answers.end(), [&](const auto& one) { return one == *otherwise; });
    if (answer(key, answers, given)) return given;
  }
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
    const std::string now = renamed(path_, key, said);
    wrong(*entry, entry->value->place, quote(key) + " = " + shown(*entry->value) + " is unknown: expected one of " + joined(*options),
          now.empty() ? nearest(said, *options) : now);
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
  note(key, {.path = {}, .type = "expression", .unit = {}, .range = {}, .otherwise = {}, .required = true});
  Entry* entry = get(key, true, quote(key));
  std::string value = "0";
  if (entry != nullptr && read(*entry, *entry->value, std::string(key), check, value)) accept(*entry, key, value, "");
  return value;
}

std::array<std::string, 3> Section::texts(std::string_view key, const TextCheck& check) const {
  note(key, {.path = {}, .type = "expressions", .unit = {}, .range = "three", .otherwise = {}, .required = true});
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
  const auto usual = [otherwise] {
    std::string text;
    for (const double one : *otherwise) text += (text.empty() ? "[" : ", ") + shortest(one);
    return text + "]";
  };
  note(key, {.path = {},
             .type = dimension == dim::none ? "numbers" : "quantities",
             .unit = dimension == dim::none ? "1" : si_unit(dimension),
             .range = "three",
             .otherwise = otherwise == nullptr ? "" : usual(),
             .required = otherwise == nullptr});
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
  note(key, {.path = {}, .type = "counts", .unit = "1", .range = "three", .otherwise = {}, .required = true});
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
  note(key, {.path = {},
             .type = dimension == dim::none ? "numbers" : "quantities",
             .unit = dimension == dim::none ? "1" : si_unit(dimension),
             .range = fewest > 0 ? "at least " + std::to_string(fewest) : "",
             .otherwise = {},
             .required = fewest > 0});
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
  note(key, {.path = {},
             .type = "words",
             .unit = {},
             .range = fewest > 0 ? "at least " + std::to_string(fewest) : "",
             .otherwise = {},
             .required = fewest > 0});
  if (surveyed()) return std::vector<std::string>(static_cast<std::size_t>(std::max(fewest, 0)));
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
  if (surveyed() && use_ == Use::used) document_->survey->faults.insert(message);
  Entry* entry = ask(key);
  if (entry != nullptr && !entry->faulty) {
    wrong(*entry, place_of(*entry, *entry->value), std::move(message), std::move(hint));
  } else if (entry == nullptr && node_ != nullptr && use_ == Use::used) {
    document_->findings.push_back({node_->place, std::move(message), std::move(hint)});
  }
}

void Section::show(mesh::Offenders one) const { document_->offenders.push_back(std::move(one)); }

void Section::fault_between(std::initializer_list<std::string_view> keys, std::string message) const {
  const auto set = [this](std::string_view key) {
    const Entry* entry = ask(key);
    return entry == nullptr ? -1 : place_of(*entry, *entry->value).source;
  };
  fault(*std::max_element(keys.begin(), keys.end(), [&](auto a, auto b) { return set(a) < set(b); }), std::move(message));
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

std::string Section::beside_case(std::string_view key, std::string_view path) const {
  const std::string file = (std::filesystem::path(document_->source(0).name).parent_path() / path).string();
  if (Entry* entry = ask(key)) document_->files.push_back({file, place_of(*entry, *entry->value)});
  return file;
}

void Section::saw(std::string_view key, const std::string& path, std::uint64_t sum) const {
  const Resolved::Value value = std::vector<std::string>{path, formatted("%016llx", static_cast<unsigned long long>(sum))};
  std::string name = std::string(key) + "_file";
  for (int number = 2;; ++number) {
    const auto at = std::find_if(document_->resolved.begin(), document_->resolved.end(),
                                 [&](const Resolved& one) { return one.path == path_of(name); });
    if (at == document_->resolved.end()) break;
    if (at->value == value) return;
    name = std::string(key) + "_file_" + std::to_string(number);
  }
  record(name, value, "", false);
}

bool Section::sound() const { return document_->sound(); }

CaseError::CaseError(std::string case_path, std::vector<Fault> all, std::size_t more)
    : path(std::move(case_path)), faults(std::move(all)) {
  for (const Fault& fault : faults) text_ += fault.text + "\n";
  text_ += counted(faults.size() + more, "fault") + " in " + path;
  if (more > 0) text_ += ": these are the first " + std::to_string(faults.size());
}

CaseFile CaseFile::read(const std::string& path, const std::vector<std::string>& overrides) {
  const auto refuse = [&](const std::string& why) {
    const std::string called = clipped(path, longest_name), message = "cannot be read: " + why;
    throw CaseError(called, {Fault{called, 0, 0, message, "", called + ": " + message}});
  };
  std::string why;
  const std::optional<std::string> text = read_text(path, why);
  if (!text) refuse(why);
  return parse(*text, path, overrides);
}

CaseFile CaseFile::surveyed(const std::shared_ptr<Survey>& survey) {
  CaseFile file(std::make_shared<Document>("survey", "none: 0\n", std::vector<std::string>{}));
  file.document_->survey = survey;
  const Section root = file.root();
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  if (root.has("accuracy")) root.choice("accuracy", names);
  root.number_or("refine", 1, within(1.0 / most_refined, most_refined));
  return file;
}

CaseFile CaseFile::parse(const std::string& text, const std::string& path,
                         const std::vector<std::string>& overrides) {
  CaseFile file(std::make_shared<Document>(path, text, overrides));
  file.set_accuracy();
  return file;
}

void CaseFile::set_accuracy() {
  const Section root = this->root();
  const auto has = [this](std::string_view key) { return find(*document_->root(), key) != nullptr; };
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  const Preset* preset = has("accuracy") ? find_preset(root.choice("accuracy", names)) : nullptr;
  const double of_preset = preset == nullptr ? 1 : preset->refine;
  document_->refine = has("refine") ? root.number("refine", within(1.0 / most_refined, most_refined)) : of_preset;
  document_->meshes = refine(*document_->root(), document_->refine);
  if (document_->meshes.empty() && has("refine")) root.fault("refine", "'refine' multiplies counts of cells, and this case has none");
  refuse_factor_of_files();
  if (preset == nullptr) return;
  document_->preset_place = find(*document_->root(), "accuracy")->value->place;
  document_->preset = preset;
}

void CaseFile::refuse_factor_of_files() {
  const std::string names = names_from_files(document_->meshes), factor = shortest(document_->refine);
  const auto& splits = mesh::split_factors;
  if (names.empty() || std::find(splits.begin(), splits.end(), document_->refine) != splits.end()) return;
  const Section root = this->root();
  const std::string why = ": meshes from files are split by 2 or by 4 only, also " + names + ": expected ";
  if (find(*document_->root(), "refine") != nullptr) root.fault("refine", "'refine' = " + factor + why + "1, 2 or 4");
  else root.fault("accuracy", "'accuracy' multiplies counts of cells by " + factor + why + "another preset, or 'refine: 1' beside it");
}

double Section::refine_factor() const { return document_->refine; }

double CaseFile::refine_factor() const { return document_->refine; }

const std::vector<CaseMesh>& CaseFile::meshes() const { return document_->meshes; }

std::vector<std::string> CaseFile::refine_notes() const {
  if (document_->refine == 1) return {};
  const std::string name = "refine " + shortest(document_->refine), files = names_from_files(document_->meshes);
  const std::string stay = names_that_stay(document_->meshes);
  std::vector<std::string> notes;
  if (!files.empty())
    notes.push_back(name + ": the elements of " + files + " are split; edges stay straight, so the geometry stays that of the file");
  if (!stay.empty()) notes.push_back(name + ": not finer is the mesh of " + stay + ", which has one cell in every direction");
  return notes;
}

std::vector<std::string> CaseFile::preset_lines() const {
  if (document_->preset == nullptr) return {};
  const std::string name = "accuracy " + std::string(document_->preset->name);
  std::vector<std::string> lines;
  if (!counts_of_cells(document_->meshes).empty()) lines.push_back(name + ": counts of cells times " + shortest(document_->refine));
  for (const std::string& line : document_->preset_lines()) lines.push_back(name + ": " + line);
  return lines;
}

Section CaseFile::root() const { return {document_, document_->root(), "", Section::Use::used}; }

void CaseFile::fault(const std::string& path, std::string message, std::string hint) const {
  document_->fault(path, std::move(message), std::move(hint));
}

void CaseFile::show(mesh::Offenders one) const { document_->offenders.push_back(std::move(one)); }

const std::vector<mesh::Offenders>& CaseFile::offenders() const { return document_->offenders; }

void CaseFile::finish() const {
  if (document_->survey != nullptr) throw SurveyEnds();
  document_->throw_if_any();
}

void CaseFile::check_files(const FileCheck& check) const {
  for (const Document::NamedFile& file : document_->files) {
    std::string wrong = check(file.path);
    if (!wrong.empty()) document_->findings.push_back({file.place, std::move(wrong), ""});
  }
  finish();
}

std::vector<std::string> CaseFile::files() const {
  std::vector<std::string> paths;
  for (const Document::NamedFile& file : document_->files) paths.push_back(file.path);
  return paths;
}

std::vector<std::string> CaseFile::not_used() const { return document_->not_used(); }

const std::vector<Resolved>& CaseFile::resolved() const { return document_->resolved; }

std::string CaseFile::hash() const {
  std::uint64_t state = checksum("");
  const auto add = [&](std::string_view text) {
    state = checksum({"\0", 1}, checksum(text, state));  // a byte of value zero behind each, so that "ab", "c" differs from "a", "bc"
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
