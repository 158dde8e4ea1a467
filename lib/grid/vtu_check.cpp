#include "grid/vtu_check.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace nereid::grid {

namespace {

using View = std::string_view;

constexpr double most_things = 2147483647;    // points or cells that can be numbered
constexpr double most_components = 1000;      // of one array
constexpr double most_block = 1e9;             // [bytes] of packed data, unpacked
constexpr std::size_t most_depth = 16;        // of tags within tags
constexpr std::size_t most_tags = 1'000'000;
constexpr std::size_t longest_shown = 40;     // [bytes] of a value within a message

/// What is wrong, and where.
struct Stop {
  std::size_t at;
  std::string what;
};

struct Tag {
  View name;
  std::map<View, View> attributes;
  std::size_t begin = 0, end = 0;  ///< from '<' to behind '>'
  bool closes = false;             ///< as </Piece>
  bool is_empty = false;           ///< as <Piece/>

  View operator[](View key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? View() : found->second;
  }
  bool has(View key) const { return attributes.count(key) != 0; }
};

/// How the arrays of a file are written.
struct Form {
  std::size_t word = 4;  ///< [bytes] of the numbers before packed data
  bool little = true;    ///< the lowest byte of a number comes first
  double most_packed = 0;  ///< [-] bytes unpacked over packed; zero: nothing is packed
  View appended = {};      ///< behind the '_' of AppendedData
  bool appended_raw = false;
};

std::string shown(View text) {
  std::string said;
  for (const char c : text.substr(0, longest_shown)) said += c >= ' ' && c <= '~' ? c : '?';
  return "'" + said + (text.size() > longest_shown ? "...'" : "'");
}

std::string said_of(const Tag& tag, View key) { return std::string(key) + " = " + shown(tag[key]) + " of its " + shown(tag.name); }

std::string called(const Tag& array) { return array["Name"].empty() ? "an array without a name" : "its array " + shown(array["Name"]); }

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

bool is_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == ':' || c == '-' || c == '.';
}

/// The next tag from a place on, past comments; none at the end of the text.
std::optional<Tag> next_tag(View text, std::size_t& at) {
  for (;;) {
    at = text.find('<', at);
    if (at == View::npos) return std::nullopt;
    View past;
    if (text.substr(at, 4) == "<!--") past = "-->";
    else if (text.substr(at, 2) == "<?") past = "?>";
    else if (text.substr(at, 2) == "<!") throw Stop{at, "it has a declaration '<!', which is not read"};
    else break;
    const std::size_t end = text.find(past, at + 2);
    if (end == View::npos) throw Stop{at, "it ends within a comment"};
    at = end + past.size();
  }
  Tag tag;
  tag.begin = at++;
  const auto cut = [&] { return Stop{tag.begin, "it ends within a tag, or a tag is damaged"}; };
  const auto skip = [&](auto&& is) {
    const std::size_t from = at;
    while (at < text.size() && is(text[at])) ++at;
    return text.substr(from, at - from);
  };
  if (at < text.size() && text[at] == '/') tag.closes = true, ++at;
  tag.name = skip(is_of_name);
  if (tag.name.empty()) throw cut();
  for (;;) {
    skip(is_blank);
    if (at >= text.size()) throw cut();
    if (text[at] == '/') tag.is_empty = true, ++at;
    if (at < text.size() && text[at] == '>') break;
    const View key = skip(is_of_name);
    skip(is_blank);
    if (key.empty() || tag.is_empty || at >= text.size() || text[at] != '=') throw cut();
    ++at;
    skip(is_blank);
    if (at >= text.size() || (text[at] != '"' && text[at] != '\'')) throw cut();
    const std::size_t end = text.find(text[at], at + 1);
    if (end == View::npos) throw cut();
    const View value = text.substr(at + 1, end - at - 1);
    constexpr std::size_t most = 100;  // VTK looks through all of them for each
    if (tag.attributes.size() == most) throw Stop{tag.begin, "a tag has more than " + std::to_string(most) + " attributes"};
    if (value.find('<') != View::npos || !tag.attributes.emplace(key, value).second) throw cut();
    at = end + 1;
  }
  tag.end = ++at;
  if (tag.closes && (tag.is_empty || !tag.attributes.empty())) throw cut();
  return tag;
}

/// A whole number of an attribute.
double whole(const Tag& tag, View key, double low, double high) {
  View text = tag[key];
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  std::int64_t value = -1;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto number = static_cast<double>(value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || !(number >= low && number <= high))
    throw Stop{tag.begin, said_of(tag, key) + " is no whole number from " + std::to_string(static_cast<std::int64_t>(low)) + " to " +
                              std::to_string(static_cast<std::int64_t>(high))};
  return number;
}

/// One of the words; the first where the attribute is missing.
std::size_t one_of(const Tag& tag, View key, const std::vector<View>& words) {
  if (!tag.has(key)) return 0;
  const auto found = std::find(words.begin(), words.end(), tag[key]);
  if (found == words.end()) {
    std::string all;
    for (const View word : words) all += (all.empty() ? "" : ", ") + (word.empty() ? "none" : std::string(word));
    throw Stop{tag.begin, said_of(tag, key) + " is unknown: expected " + all};
  }
  return static_cast<std::size_t>(found - words.begin());
}

/// [bytes] of one value of an array; zero: a text.
double size_of_value(const Tag& tag) {
  static const std::vector<View> types{"",        "Int8",  "UInt8",  "Int16",   "UInt16", "Int32", "UInt32",
                                       "Float32", "Int64", "UInt64", "Float64", "String", "Bit"};
  constexpr std::array<double, 13> sizes{0, 1, 1, 2, 2, 4, 4, 4, 8, 8, 8, 0, 0};
  const std::size_t type = one_of(tag, "type", types);
  if (type == 0) throw Stop{tag.begin, "an array has no type"};
  return sizes[type];
}

int value_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Bytes of an array as they come, out of the file itself or out of base64.
class Bytes {
 public:
  Bytes(View text, bool raw) : text_(text), raw_(raw) {}

  /// The next byte, or -1 at the end.
  int next() {
    if (raw_) return at_ < text_.size() ? static_cast<unsigned char>(text_[at_++]) : -1;
    if (have_ == 0) read_four();
    if (have_ == 0) return -1;
    const auto byte = static_cast<int>((four_ >> 16U) & 0xFFU);
    four_ <<= 8U, --have_;
    return byte;
  }
  /// Base64 begins anew, as it does behind the numbers before packed data.
  void begin_anew() { have_ = 0; }
  /// How many bytes there can be still.
  double left() const {
    const auto rest = static_cast<double>(text_.size() - at_);
    return raw_ ? rest : have_ + 0.75 * rest;
  }

 private:
  void read_four() {
    int read = 0;
    four_ = 0;
    while (at_ < text_.size() && read < 4) {
      const char c = text_[at_++];
      if (is_blank(c)) continue;
      const int value = value_of(c);
      if (value < 0 && c != '=') return;
      four_ = (four_ << 6U) | static_cast<std::uint32_t>(std::max(value, 0));
      ++read;
      if (value >= 0) have_ = read - 1;
    }
    if (read < 4) have_ = 0;
  }

  View text_;
  bool raw_;
  std::size_t at_ = 0;
  std::uint32_t four_ = 0;
  int have_ = 0;
};

/// A number before packed data.
double word(const Form& form, Bytes& bytes, const Tag& tag) {
  double value = 0, place = 1;
  for (std::size_t b = 0; b < form.word; ++b) {
    const int byte = bytes.next();
    if (byte < 0) throw Stop{tag.begin, "the data of " + called(tag) + " end too early"};
    if (form.little) value += place * byte, place *= 256;
    else value = 256 * value + byte;
  }
  return value;
}

/// [bytes] that the packed or plain data of an array say they have in memory, once it is known that the file can hold them.
double size_said(const Form& form, Bytes bytes, const Tag& tag) {
  const double first = word(form, bytes, tag);
  if (form.most_packed == 0) {
    if (first > bytes.left()) throw Stop{tag.begin, called(tag) + " would have more bytes than the file"};
    return first;
  }
  if (first == 0) return 0;
  const double block = word(form, bytes, tag), last = word(form, bytes, tag);
  if (first > bytes.left()) throw Stop{tag.begin, called(tag) + " would have more packed blocks than the file has bytes"};
  double packed = 0;
  for (double b = 0; b < first; ++b) packed += word(form, bytes, tag);
  bytes.begin_anew();
  if (packed > bytes.left() + 3) throw Stop{tag.begin, called(tag) + " would have more packed bytes than the file"};
  const double size = (last > 0 ? first - 1 : first) * block + last;
  if (last > block || block > most_block || size > form.most_packed * packed + 1e4)
    throw Stop{tag.begin, called(tag) + " is damaged: the sizes of its packed blocks cannot be"};
  return size;
}

/// How many numbers stand in a text, up to `most`.
double count_numbers(View text, double most) {
  double count = 0;
  bool within = false;
  for (const char c : text) {
    if (!is_blank(c) && !within && ++count >= most) break;
    within = !is_blank(c);
  }
  return count;
}

/// The tags that an array stands in.
struct Place {
  View section;               ///< as "PointData"
  double points = 0, cells = 0;  ///< of its piece
};

/// [bytes] that an array has in memory, once it is known that it has the values that the counts ask for.
double look_at_array(const Form& form, const Place& place, const Tag& tag, View inline_text) {
  const double size = size_of_value(tag);
  const double components = tag.has("NumberOfComponents") ? whole(tag, "NumberOfComponents", 1, most_components) : 1;
  const double given = tag.has("NumberOfTuples") ? whole(tag, "NumberOfTuples", 0, most_things) : 0;
  const bool of_points = place.section == "Points" || place.section == "PointData", of_cells = place.section == "CellData";
  const bool one_a_cell = place.section == "Cells" && (tag["Name"] == "types" || tag["Name"] == "offsets");
  if (place.section == "Points" && components != 3) throw Stop{tag.begin, "its points have not three coordinates"};
  const double tuples = of_points ? place.points : of_cells || one_a_cell ? place.cells : given;
  const double expected = tuples * components;
  const auto too_few = [&] {
    return Stop{tag.begin, called(tag) + " has fewer values than the " +
                               std::to_string(static_cast<std::int64_t>(expected)) + " that its counts ask for"};
  };
  const std::size_t format = one_of(tag, "format", {"ascii", "binary", "appended"});
  if (format == 0) {
    if (size > 0 && count_numbers(inline_text, expected) < expected) throw too_few();
    return std::max(size, 1.0) * std::max(expected, 0.5 * static_cast<double>(inline_text.size()));
  }
  View data = inline_text;
  if (format == 2) {
    if (form.appended.empty()) throw Stop{tag.begin, called(tag) + " is appended, and there are no appended data"};
    data = form.appended.substr(static_cast<std::size_t>(whole(tag, "offset", 0, static_cast<double>(form.appended.size() - 1))));
  } else if (count_numbers(data, 1) == 0) {  // nothing stands there
    if (expected > 0) throw too_few();
    return 0;
  }
  const double said = size_said(form, Bytes(data, format == 2 && form.appended_raw), tag);
  if (said < size * expected) throw too_few();
  return said;
}

/// The data behind the tag AppendedData, up to its end.
View appended(View text, const Tag& tag) {
  const std::size_t begin = text.find('_', tag.end), end = text.rfind("</AppendedData");
  if (tag.is_empty || begin == View::npos || end == View::npos || end <= begin + 1)
    throw Stop{tag.begin, "its appended data are cut short"};
  return text.substr(begin + 1, end - begin - 1);
}

/// Reads what the first tag says of the form of all arrays.
Form form_of(const Tag& file) {
  if (file["type"] != "UnstructuredGrid") throw Stop{0, no_vtu};
  Form form;
  form.little = one_of(file, "byte_order", {"LittleEndian", "BigEndian"}) == 0;
  form.word = one_of(file, "header_type", {"UInt32", "UInt64"}) == 0 ? 4 : 8;
  // what zeros take at best
  constexpr std::array<double, 4> most_packed{0, 1100, 300, 1e5};
  const std::vector<View> compressors{"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor"};
  form.most_packed = most_packed[one_of(file, "compressor", compressors)];
  return form;
}

struct Array {
  Tag tag;
  Place place;
  View text;
};

double look_at(View text) {
  std::size_t at = 0, tags = 0;
  const std::size_t begin = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");  // the first three: a byte order mark
  if (begin == View::npos || text[begin] != '<') throw Stop{0, no_vtu};
  std::optional<Tag> tag = next_tag(text, at);
  if (!tag || tag->name != "VTKFile" || tag->closes || tag->is_empty) throw Stop{0, no_vtu};
  Form form = form_of(*tag);
  std::vector<View> open{tag->name};
  std::vector<Array> arrays;
  Place place;
  int grids = 0, pieces = 0;
  while (!open.empty()) {
    tag = next_tag(text, at);
    if (!tag) throw Stop{text.size(), "it ends too early: its '" + std::string(open.back()) + "' is not closed"};
    if (++tags > most_tags) throw Stop{tag->begin, "it has more than a million tags"};
    if (tag->closes) {
      if (open.back() != tag->name) throw Stop{tag->begin, "its " + shown(open.back()) + " is closed by " + shown(tag->name)};
      open.pop_back();
      continue;
    }
    if (tag->name == "UnstructuredGrid" && ++grids > 1) throw Stop{tag->begin, "it has two grids"};
    if (tag->name == "Piece") {
      ++pieces;
      if (open.back() != "UnstructuredGrid") throw Stop{tag->begin, "a piece stands outside its grid"};
      place.points = whole(*tag, "NumberOfPoints", 0, most_things), place.cells = whole(*tag, "NumberOfCells", 0, most_things);
    }
    if (tag->name == "DataArray" || tag->name == "Array") {
      place.section = open.back();
      arrays.push_back({*tag, place, tag->is_empty ? View() : text.substr(tag->end, text.find('<', tag->end) - tag->end)});
    }
    if (tag->name == "AppendedData") {
      form.appended_raw = one_of(*tag, "encoding", {"base64", "raw"}) == 1;
      form.appended = appended(text, *tag);
      at = static_cast<std::size_t>(form.appended.data() - text.data()) + form.appended.size();
    }
    if (!tag->is_empty) open.push_back(tag->name);
    if (open.size() > most_depth) throw Stop{tag->begin, "its tags stand too deep within each other"};
  }
  if (grids == 0) throw Stop{0, "it has no 'UnstructuredGrid'"};
  if (pieces == 0) throw Stop{0, "it has no 'Piece'"};
  double sum = 0;
  for (const Array& array : arrays) sum += look_at_array(form, array.place, array.tag, array.text);
  return sum;
}

}  // namespace

VtuCheck check_vtu(std::string_view bytes) {
  try {
    return {"", look_at(bytes)};
  } catch (const Stop& stop) {
    if (stop.at == 0) return {stop.what, 0};
    const auto line = 1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(stop.at, bytes.size())), '\n');
    return {"it is damaged in line " + std::to_string(line) + ": " + stop.what, 0};
  }
}

}  // namespace nereid::grid
