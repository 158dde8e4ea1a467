#include "grid/frame_text.hpp"

#ifdef NEREID_WITH_VTK
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

#include "base/check.hpp"

namespace nereid::grid {

namespace {

constexpr int level = 1;                        // docs/decisions.md has what others take
constexpr std::size_t block = std::size_t{1} << 17;  // [bytes] packed at once

using Compressor = std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;

template <class Number>
std::string_view as_bytes(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

/// Two digits of base64 for each number of twelve bits.
std::array<std::array<char, 2>, 4096> pairs_of_digits() {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::array<char, 2>, 4096> pairs{};
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {digits[i / 64], digits[i % 64]};
  return pairs;
}

void append_base64(std::string_view bytes, std::string& text) {
  static const auto pairs = pairs_of_digits();
  const std::size_t first = text.size(), whole = bytes.size() / 3 * 3;
  text.resize(first + (bytes.size() + 2) / 3 * 4);
  char* to = text.data() + first;
  const auto add = [&to](const char* from) {
    const auto byte = [from](int i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(from[i])); };
    const std::uint32_t three = byte(0) << 16U | byte(1) << 8U | byte(2);
    std::memcpy(to, pairs[three >> 12U].data(), 2), std::memcpy(to + 2, pairs[three & 4095U].data(), 2);
    to += 4;
  };
  for (std::size_t i = 0; i < whole; i += 3) add(bytes.data() + i);
  if (whole == bytes.size()) return;
  std::string last(bytes.substr(whole));
  const std::size_t missing = 3 - last.size();
  add(last.append(missing, '\0').data());
  std::fill_n(text.end() - static_cast<std::ptrdiff_t>(missing), missing, '=');
}

template <class Number>
std::string_view type_name() {
  if constexpr (std::is_same_v<Number, float>) return "Float32";
  if constexpr (std::is_same_v<Number, double>) return "Float64";
  if constexpr (std::is_same_v<Number, std::int32_t>) return "Int32";
  return "UInt8";
}

/// Values one after the other as an array of numbers; what it cannot hold is counted and becomes 0.
template <class Number, class Values>
std::vector<Number> numbers_of(const Values& values, Lost& lost) {
  const double* from = values.data();
  std::vector<Number> numbers(static_cast<std::size_t>(values.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double value = from[i];
    if (std::abs(value) <= static_cast<double>(std::numeric_limits<Number>::max())) {
      numbers[i] = static_cast<Number>(value);
      continue;
    }
    // Also what only Float32 cannot hold: ParaView would show infinity as a hole.
    if (std::is_integral_v<Number> && std::isfinite(value)) throw InternalError("field '" + lost.field + "': an integer beyond 32 bits");
    ++(std::isfinite(value) ? lost.beyond_float : lost.no_number);
    numbers[i] = 0;
  }
  return numbers;
}

/// A file as it grows.
class File {
 public:
  File(GridKind kind, Kept& kept)
      : kept_(kept), compressor_(libdeflate_alloc_compressor(level), libdeflate_free_compressor) {
    if (!compressor_) throw std::bad_alloc();
    text_.reserve(kept.length + kept.length / 8);  // to grow would copy it
    const bool little = std::endian::native == std::endian::little;
    text_ += std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"") + (kind == GridKind::volume ? "UnstructuredGrid" : "PolyData") +
            "\" version=\"1.0\" byte_order=\"" + (little ? "LittleEndian" : "BigEndian") +
            "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n";
  }

  void tag(const std::string& inside) { text_ += "<" + inside + ">\n"; }

  /// An array of so many components each; with their names, if they have any.
  ///
  /// attributes  more of its tag, as in ` NumberOfTuples="1"`
  template <class Number>
  void array(const std::string& name, const std::vector<std::string>& components, std::size_t count, const std::vector<Number>& numbers,
             bool keep = false, const std::string& attributes = "") {
    const std::string_view bytes = as_bytes(numbers);
    text_ += "<DataArray type=\"";
    text_ += type_name<Number>();
    text_ += "\" Name=\"" + name + "\"";
    if (count > 1) text_ += " NumberOfComponents=\"" + std::to_string(count) + "\"";
    for (std::size_t c = 0; c < components.size(); ++c) text_ += " ComponentName" + std::to_string(c) + "=\"" + components[c] + "\"";
    text_ += attributes + " format=\"binary\">\n";
    if (keep) {
      Kept::Array& before = kept_.arrays[place_ + name];
      if (before.text.empty() || before.bytes != bytes) {
        const std::size_t from = text_.size();
        append_packed(bytes);
        before = {std::string(bytes), text_.substr(from)};
      } else {
        text_ += before.text;
      }
    } else {
      append_packed(bytes);
    }
    text_ += "\n</DataArray>\n";
  }

  /// Begins a section, as "PointData", whose arrays are told from those of others of the same name.
  void begin(const std::string& section, const std::string& attributes = "") {
    place_ = section + " ";
    tag(section + attributes);
  }

  std::string take() {
    kept_.length = text_.size();
    return std::move(text_);
  }

 private:
  /// A head of numbers of blocks and sizes, then the packed blocks, each part in base64.
  void append_packed(std::string_view bytes) {
    const std::size_t blocks = (bytes.size() + block - 1) / block;
    std::vector<std::uint64_t> head{blocks, block, bytes.size() % block};
    room_.resize(std::max(room_.size(), blocks * libdeflate_zlib_compress_bound(compressor_.get(), block)));
    std::size_t end = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::string_view one = bytes.substr(b * block, block);
      const std::size_t size =
          libdeflate_zlib_compress(compressor_.get(), one.data(), one.size(), room_.data() + end, room_.size() - end);
      check(size > 0, "a packed block has no room");
      head.push_back(size), end += size;
    }
    append_base64(as_bytes(head), text_);
    append_base64(std::string_view(room_).substr(0, end), text_);
  }

  Kept& kept_;
  Compressor compressor_;
  std::string place_, text_, room_;
};

void add_field(const Field& field, Precision precision, std::vector<Lost>& lost, File& file) {
  Lost& of_field = lost.emplace_back(Lost{field.name});
  const std::size_t count = std::max<std::size_t>(field.components.size(), 1);
  const auto add = [&]<class Number>(const std::vector<Number>& numbers) {
    file.array(field.name, field.components, count, numbers, field.integer);
  };
  if (field.integer) add(numbers_of<std::int32_t>(field.values, of_field));
  else if (precision == Precision::full) add(numbers_of<double>(field.values, of_field));
  else add(numbers_of<float>(field.values, of_field));
}

unsigned char vtk_number(CellKind kind) {
  switch (kind) {
    case CellKind::vertex:
      return 1;
    case CellKind::line:
      return 3;
    case CellKind::triangle:
      return 5;
    case CellKind::hexahedron:
      return 12;
  }
  throw InternalError("a kind of cell that results do not know");
}

/// Nodes of cells one after the other, and where each cell ends; all of them, or those of one kind.
void add_cells(const Grid& grid, const CellKind* kind, File& file) {
  std::vector<std::int32_t> nodes, ends;
  for (const Cells& cells : grid.cells) {
    if (kind != nullptr && cells.kind != *kind) continue;
    const auto all = cells.nodes.reshaped();
    for (Eigen::Index cell = 1; cell <= cells.nodes.cols(); ++cell)
      ends.push_back(static_cast<std::int32_t>(static_cast<Eigen::Index>(nodes.size()) + cell * cells.nodes.rows()));
    nodes.insert(nodes.end(), all.begin(), all.end());
  }
  check(nodes.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()), "results have more cells than can be numbered");
  file.array("connectivity", {}, 1, nodes, true);
  file.array("offsets", {}, 1, ends, true);
}

/// The tag of the one piece, with what it holds so many of.
std::string piece(const Grid& grid, GridKind kind) {
  const auto count = [&](CellKind wanted) {
    Eigen::Index sum = 0;
    for (const Cells& cells : grid.cells)
      if (kind == GridKind::volume || cells.kind == wanted) sum += cells.nodes.cols();
    return "\"" + std::to_string(sum) + "\"";
  };
  std::string text = "Piece NumberOfPoints=\"" + std::to_string(grid.reference.cols()) + "\"";
  if (kind == GridKind::volume) return text + " NumberOfCells=" + count(CellKind::hexahedron);
  return text + " NumberOfVerts=" + count(CellKind::vertex) + " NumberOfLines=" + count(CellKind::line) + " NumberOfStrips=\"0\"" +
         " NumberOfPolys=" + count(CellKind::triangle);
}

}  // namespace

std::string frame_text(const Grid& grid, GridKind kind, Precision precision, Kept& kept, std::vector<Lost>& lost) {
  File file(kind, kept);
  const std::string data = kind == GridKind::volume ? "UnstructuredGrid" : "PolyData";
  lost.reserve(lost.size() + 2 + grid.point_fields.size() + grid.cell_fields.size());
  Lost& of_points = lost.emplace_back(Lost{"points"});
  Lost& of_displacement = lost.emplace_back(Lost{"displacement"});
  file.tag(data);
  file.begin("FieldData");
  const std::string one_tuple = " NumberOfTuples=\"1\"";
  file.array("TimeValue", {}, 1, std::vector<double>{grid.time}, false, one_tuple);  // so that a file is useful without its .pvd
  file.array(deformed_mark, {}, 1, std::vector<std::int32_t>{1}, true, one_tuple);
  // units and names as names of arrays of numbers: some readers know no arrays of texts, and none loses the name of an array
  const auto add_unit = [&](const std::string& name, const std::string& unit) {
    file.array(name + " [" + unit + "]", {}, 1, std::vector<float>{1}, true, one_tuple);
  };
  add_unit("displacement", "m");
  for (const auto* fields : {&grid.point_fields, &grid.cell_fields})
    for (const Field& field : *fields) add_unit(field.name, field.unit);
  for (const GroupName& group : grid.names)
    file.array(group.name, {}, 1, std::vector<std::int32_t>{group.number, group.dimension}, true, " NumberOfTuples=\"2\"");
  file.tag("/FieldData");
  file.tag(piece(grid, kind));
  file.begin("PointData", " Vectors=\"displacement\"");  // what Warp By Vector picks, to magnify it
  file.array("displacement", vector_components, 3, numbers_of<double>(grid.displacement, of_displacement));
  for (const Field& field : grid.point_fields) add_field(field, precision, lost, file);
  file.tag("/PointData");
  file.begin("CellData");
  for (const Field& field : grid.cell_fields) add_field(field, precision, lost, file);
  file.tag("/CellData");
  file.begin("Points");
  file.array("points", vector_components, 3, numbers_of<double>(Vectors(grid.reference + grid.displacement), of_points));
  file.tag("/Points");
  if (kind == GridKind::volume) {
    std::vector<unsigned char> types;
    for (const Cells& cells : grid.cells) types.insert(types.end(), static_cast<std::size_t>(cells.nodes.cols()), vtk_number(cells.kind));
    file.begin("Cells");
    add_cells(grid, nullptr, file);
    file.array("types", {}, 1, types, true);
    file.tag("/Cells");
  } else {
    const std::array<std::pair<const char*, CellKind>, 3> sections{
        {{"Verts", CellKind::vertex}, {"Lines", CellKind::line}, {"Polys", CellKind::triangle}}};
    for (const auto& [section, of] : sections) {
      file.begin(section);
      add_cells(grid, &of, file);
      file.tag(std::string("/") + section);
    }
  }
  file.tag("/Piece");
  file.tag("/" + data);
  file.tag("/VTKFile");
  return file.take();
}

}  // namespace nereid::grid
#else
#include "base/check.hpp"

namespace nereid::grid {

std::string frame_text(const Grid&, GridKind, Precision, Kept&, std::vector<Lost>&) { throw InternalError("built without VTK"); }

}  // namespace nereid::grid
#endif
