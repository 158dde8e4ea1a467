#include "grid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <new>
#include <sstream>
#include <system_error>
#include <utility>

#include "base/archive.hpp"
#include "base/check.hpp"
#include "base/checksum.hpp"
#include "base/child.hpp"
#include "base/memory.hpp"
#include "base/replace_file.hpp"
#include "base/words.hpp"
#include "grid/frame_text.hpp"
#include "grid/vtu_check.hpp"

#ifdef NEREID_WITH_VTK
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#endif

namespace nereid {

template <class Archive>
void visit(Archive& archive, Field& field) {
  auto& [name, unit, components, values, integer] = field;
  archive(name, unit, components, values, integer);
}

}  // namespace nereid

namespace nereid::grid {

template <class Archive>
void visit(Archive& archive, Contents& contents) {
  auto& [points, kind, begin, nodes, point_fields, cell_fields, fields, checksum] = contents;
  archive(points, kind, begin, nodes, point_fields, cell_fields, fields, checksum);
}

namespace {

namespace fs = std::filesystem;

[[noreturn]] void wrong(const std::string& collection, const std::string& what) {
  throw InternalError("results '" + collection + "': " + what);
}

bool plain(const std::string& name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), allowed);
}

Index nodes_per_cell(CellKind kind) {
  switch (kind) {
    case CellKind::vertex:
      return 1;
    case CellKind::line:
      return 2;
    case CellKind::triangle:
      return 3;
    case CellKind::hexahedron:
      return 8;
  }
  throw InternalError("a kind of cell that results do not know");
}

Eigen::Index count_cells(const Grid& grid) {
  Eigen::Index count = 0;
  for (const Cells& cells : grid.cells) count += cells.nodes.cols();
  return count;
}

void check_cells(const std::string& collection, GridKind kind, const Grid& grid) {
  const auto points = grid.reference.cols();
  CellKind last = CellKind::vertex;
  for (const Cells& cells : grid.cells) {
    const auto& nodes = cells.nodes;
    // An empty table may come without its rows.
    if (nodes.size() > 0 && nodes.rows() != nodes_per_cell(cells.kind))
      wrong(collection, "cells with " + std::to_string(nodes.rows()) + " nodes");
    if (nodes.size() > 0 && (nodes.minCoeff() < 0 || nodes.maxCoeff() >= points))
      wrong(collection, "a cell with a node that is none of the points");
    if (kind == GridKind::surface) {
      if (cells.kind == CellKind::hexahedron) wrong(collection, "hexahedra in a surface");
      // vtkPolyData counts cells so, whatever order they were given in: fields would be shuffled.
      if (cells.kind < last) wrong(collection, "cells not ordered vertices, lines, triangles");
      last = cells.kind;
    }
  }
}

void check_fields(const std::string& collection, const std::vector<Field>& fields,
                  Eigen::Index things) {
  std::set<std::string> names;
  for (const Field& field : fields) {
    const std::string named = "field '" + field.name + "' ";
    if (!plain(field.name)) wrong(collection, named + "is not letters, digits and underscores");
    if (!names.insert(field.name).second) wrong(collection, named + "comes twice");
    if (field.unit.find_first_of("\"<&") != std::string::npos) wrong(collection, named + "has a unit that a file cannot hold");
    if (field.values.cols() != things)
      wrong(collection, named + "has " + std::to_string(field.values.cols()) + " values for " +
                            std::to_string(things) + " things");
    const auto components = static_cast<Eigen::Index>(field.components.size());
    // No things, no shape: a table of no columns may have lost its rows.
    if (things > 0 && field.values.rows() != std::max<Eigen::Index>(components, 1))
      wrong(collection, named + "has " + std::to_string(field.values.rows()) + " components and " +
                            std::to_string(components) + " names for them");
    // ParaView labels any six numbers in VTK's order, so any other order would carry wrong labels.
    if (components == 6 && field.components != tensor_components &&
        std::is_permutation(field.components.begin(), field.components.end(),
                            tensor_components.begin()))
      wrong(collection, named + "is a tensor not in the order XX YY ZZ XY YZ XZ");
  }
}

/// The arrays of a frame in words, to tell whether two frames hold the same ones.
std::string arrays_of(const Grid& grid) {
  std::string text;
  const auto add = [&](const char* place, const std::vector<Field>& fields) {
    for (const Field& field : fields) {
      text += std::string(place) + " " + field.name + " [" + field.unit + "]";
      for (const std::string& component : field.components) text += " " + component;
      text += field.integer ? " integer\n" : "\n";
    }
  };
  add("point", grid.point_fields);
  add("cell", grid.cell_fields);
  return text;
}

const char* extension(GridKind kind) { return kind == GridKind::volume ? ".vtu" : ".vtp"; }

/// Frames of a collection, of whatever run and kind, and drafts of them.
std::vector<std::filesystem::path> frames_in(const std::filesystem::path& folder, const std::string& name, std::error_code& error) {
  std::vector<std::filesystem::path> frames;
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const fs::path file = at->path().extension() == ".tmp" ? at->path().stem() : at->path().filename();
    const std::string stem = file.stem().string(), kind = file.extension().string();
    const std::string number = stem.substr(std::min(stem.size(), name.size() + 1));
    if (stem.rfind(name + "_", 0) == 0 && number.size() >= 6 && (kind == ".vtu" || kind == ".vtp") &&
        number.find_first_not_of("0123456789") == std::string::npos)
      frames.push_back(at->path());
  }
  return frames;
}

/// The frames of an earlier run would stand beside ours, and who opens the folder would see both.
void remove_frames(const std::filesystem::path& folder, const std::string& name) {
  std::error_code error;
  for (const auto& path : frames_in(folder, name, error)) std::filesystem::remove(path, error);
  if (error) throw MachineError("cannot clear " + folder.string() + ": " + error.message());
}

#ifdef NEREID_WITH_VTK

/// Keeps VTK from starting threads: it needs none here, a machine may refuse them, and a child process must not wait for those of its
/// parent.
void use_no_threads() { ::setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 1); }  // its header of threads is no C++20

constexpr const char* unreadable = "VTK cannot read it: it is damaged, or written in a form that this VTK does not know";

/// Arrays of numbers, in the order of the file.
std::vector<Field> fields_of(vtkFieldData& attributes) {
  std::vector<Field> fields;
  for (int a = 0; a < attributes.GetNumberOfArrays(); ++a) {
    vtkDataArray* array = attributes.GetArray(a);
    if (array == nullptr || array->GetName() == nullptr) continue;  // texts
    Field field{array->GetName(), "", {}, Eigen::MatrixXd(array->GetNumberOfComponents(), array->GetNumberOfTuples()), false};
    const int type = array->GetDataType();
    field.integer = type != VTK_FLOAT && type != VTK_DOUBLE;
    for (vtkIdType thing = 0; thing < array->GetNumberOfTuples(); ++thing)
      for (int c = 0; c < array->GetNumberOfComponents(); ++c) field.values(c, thing) = array->GetComponent(thing, c);
    fields.push_back(std::move(field));
  }
  return fields;
}

/// The grid in our arrays; where its cells have points that are none, why it cannot be.
Contents contents_of(vtkUnstructuredGrid& data, std::string& fault) {
  Contents contents;
  if (data.GetCells() != nullptr && !data.GetCells()->IsValid()) {
    fault = "its 'offsets' do not ascend to the end of its 'connectivity'";
    return contents;
  }
  vtkIdType lost = 0;  // cells with points that are none
  contents.points.resize(3, data.GetNumberOfPoints());
  for (vtkIdType point = 0; point < data.GetNumberOfPoints(); ++point) data.GetPoint(point, contents.points.col(point).data());
  contents.begin.push_back(0);
  vtkNew<vtkIdList> nodes;
  for (vtkIdType cell = 0; cell < data.GetNumberOfCells(); ++cell) {
    contents.kind.push_back(data.GetCellType(cell));
    data.GetCellPoints(cell, nodes);
    bool all_there = true;
    for (vtkIdType a = 0; a < nodes->GetNumberOfIds(); ++a) {
      all_there = all_there && nodes->GetId(a) >= 0 && nodes->GetId(a) < data.GetNumberOfPoints();
      contents.nodes.push_back(static_cast<Index>(nodes->GetId(a)));
    }
    if (!all_there) ++lost;
    contents.begin.push_back(static_cast<std::int64_t>(contents.nodes.size()));
  }
  if (lost > 0) {
    fault = std::to_string(lost) + " of its cells have a point that is none of its " + std::to_string(contents.points.cols());
    return contents;
  }
  contents.point_fields = fields_of(*data.GetPointData());
  contents.cell_fields = fields_of(*data.GetCellData());
  contents.fields = fields_of(*data.GetFieldData());
  const auto look = [&fault](const std::vector<Field>& fields, vtkIdType things, const char* what) {
    for (const Field& field : fields)
      if (field.values.cols() != things)
        fault = "its array " + quote(clipped(field.name, 40)) + " has " + std::to_string(field.values.cols()) + " values for its " +
                std::to_string(things) + " " + what;
  };
  look(contents.point_fields, data.GetNumberOfPoints(), "points");
  look(contents.cell_fields, data.GetNumberOfCells(), "cells");
  return contents;
}

/// Hears what VTK would tell the terminal; the case's report is the place for it.
class Listener : public vtkOutputWindow {
 public:
  static Listener* New() { return new Listener; }
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char*) override { heard_an_error = true; }
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  bool heard_an_error = false;
};

/// Lets a listener stand in for the terminal while it lives.
class Listening {
 public:
  Listening() : before_(vtkOutputWindow::GetInstance()), log_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::SetInstance(listener);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // VTK's log has a way of its own
  }
  ~Listening() {
    vtkLogger::SetStderrVerbosity(log_);
    vtkOutputWindow::SetInstance(before_);
  }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;
  vtkNew<Listener> listener;

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity log_;
};

#endif

}  // namespace

#ifdef NEREID_WITH_VTK
namespace {

constexpr double most_file = 16e9;  // [bytes]
constexpr double patience = 600;    // [s] for the largest file on a slow disk

/// Whether a file begins as XML does, so that it is worth its memory.
bool begins_like_xml(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return (stream >> std::ws).peek() == '<';
}

/// The bytes of a file; why it cannot be read is added to `fault`.
std::string bytes_in(const std::filesystem::path& file, double size, std::string& fault) {
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream || stream.peek() != std::ifstream::traits_type::eof()) fault = "it cannot be read to its end";
  return bytes;
}

/// What VTK makes of a file that check_vtu() has found sound.
Contents read_by_vtk(const std::filesystem::path& file, std::string& fault) {
  use_no_threads();
  const Listening here;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* data = reader->GetOutput();
  // an error code does not tell everything, as a file that ends too early
  if (here.listener->heard_an_error || reader->GetErrorCode() != 0 || data == nullptr) {
    fault = unreadable;
    return {};
  }
  if (data->GetNumberOfPoints() > std::numeric_limits<Index>::max()) {
    fault = "it has more points than can be numbered";
    return {};
  }
  return contents_of(*data, fault);
}

}  // namespace

Contents read_vtu(const std::filesystem::path& file, std::string& fault) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    fault = std::filesystem::exists(file, error) ? "it is a device, a pipe or a folder, and no file" : "there is no such file";
    return {};
  }
  const auto size = static_cast<double>(std::filesystem::file_size(file, error));
  if (error || size > most_file) {
    fault = error ? error.message() : "it is larger than " + shortest(most_file / 1e9) + " GB";
    return {};
  }
  if (!begins_like_xml(file)) {
    fault = no_vtu;
    return {};
  }
  if (size > memory_left()) throw MachineError("memory does not suffice to read " + file.string());
  double unpacked = 0;
  std::uint64_t sum = 0;
  {
    const std::string bytes = bytes_in(file, size, fault);
    if (!fault.empty()) return {};
    const VtuCheck found = check_vtu(bytes);
    fault = found.fault, unpacked = found.unpacked, sum = checksum(bytes);
  }
  if (!fault.empty()) return {};
  const auto work = [&file] {
    std::string seen;
    Writer writer;
    Contents contents = read_by_vtk(file, seen);
    writer(seen);
    visit(writer, contents);
    return writer.bytes();
  };
  // [bytes] what VTK has of the arrays, what we make of them, and that in bytes
  const double needed = 1e9 + 4 * size + 40 * unpacked;
  const bool suffices = needed <= memory_left();
  const OfChild read = in_child(work, {.memory = needed, .seconds = patience});
  if (read.out_of_memory && !suffices) throw std::bad_alloc();
  if (!read.why.empty()) {
    fault = std::string(unreadable) + " (" + read.why + ")";
    return {};
  }
  Contents contents;
  Reader reader(read.bytes);
  reader(fault);
  if (!fault.empty()) return {};
  visit(reader, contents);
  contents.checksum = sum;
  return contents;
}
#else
Contents read_vtu(const std::filesystem::path&, std::string& fault) {
  fault = "this program was built without VTK (NEREID_WITH_VTK=OFF) and reads no files of meshes";
  return {};
}
#endif

std::size_t bytes_of([[maybe_unused]] const Grid& grid, [[maybe_unused]] GridKind kind, [[maybe_unused]] Precision precision,
                     [[maybe_unused]] Kept* kept) {
#ifdef NEREID_WITH_VTK
  std::vector<Lost> lost;
  Kept none;
  return frame_text(grid, kind, precision, kept == nullptr ? none : *kept, lost).size();
#else
  return 0;
#endif
}

bool vtk_available() {
#ifdef NEREID_WITH_VTK
  return true;
#else
  return false;
#endif
}

std::vector<std::filesystem::path> collection_files(const std::filesystem::path& directory, const std::string& name) {
  std::error_code error;  // of a folder that is not there
  std::vector<std::filesystem::path> files = frames_in(directory / name, name, error);
  for (const char* ending : {".pvd", ".pvd.tmp"})
    if (std::filesystem::exists(std::filesystem::symlink_status(directory / (name + ending), error)))
      files.push_back(directory / (name + ending));
  std::sort(files.begin(), files.end());
  return files;
}

Collection::Collection(std::filesystem::path directory, std::string name, GridKind kind,
                       Precision precision)
    : directory_(std::move(directory)), name_(std::move(name)), kind_(kind), precision_(precision) {
  if (!plain(name_)) wrong(name_, "the name is not letters, digits and underscores");
  if (!vtk_available()) return;
  make_folder(directory_ / name_);
  remove_frames(directory_ / name_, name_);
  write_index();
}

Collection::Collection(std::filesystem::path directory, std::string name, GridKind kind, Precision precision, const CollectionMark& mark)
    : directory_(std::move(directory)), name_(std::move(name)), kind_(kind), precision_(precision), times_(mark.times),
      replaced_(mark.replaced) {
  if (!vtk_available()) return;
  std::error_code error;
  std::set<std::filesystem::path> kept;
  for (int frame = 0; frame < frames(); ++frame) {
    const auto file = directory_ / frame_name(frame);
    if (!std::filesystem::is_regular_file(file, error)) throw MachineError(file.string() + " is missing, which a checkpoint counts on");
    kept.insert(file);
  }
  write_index();  // first, so that it never lists what is gone
  for (const auto& path : frames_in(directory_ / name_, name_, error))
    if (kept.count(path) == 0) std::filesystem::remove(path, error);
  if (error) throw MachineError("cannot clear " + (directory_ / name_).string() + ": " + error.message());
}

void Collection::add(const Grid& grid) {
  if (!std::isfinite(grid.time)) wrong(name_, "a frame whose time is no number");
  if (!times_.empty() && grid.time < times_.back()) wrong(name_, "a frame before the last one");
  if (grid.displacement.cols() != grid.reference.cols())
    wrong(name_, "not one displacement for each point");
  check_cells(name_, kind_, grid);
  check_fields(name_, grid.point_fields, grid.reference.cols());
  check_fields(name_, grid.cell_fields, count_cells(grid));
  for (const Field& field : grid.point_fields)
    if (field.name == "displacement") wrong(name_, "field 'displacement' comes twice");
  const std::string arrays = arrays_of(grid) + "end";  // so that no arrays differ from no frame
  if (arrays_.empty()) arrays_ = arrays;
  if (arrays_ != arrays) wrong(name_, "other arrays than in the first frame");

#ifdef NEREID_WITH_VTK
  const bool again = !times_.empty() && grid.time == times_.back();
  const int frame = again ? frames() - 1 : frames();
  std::vector<Lost> all;
  replace_file(directory_ / frame_name(frame), frame_text(grid, kind_, precision_, kept_, all));
  for (const Lost& lost : all) {
    replaced_ += lost.no_number + lost.beyond_float;
    const auto warn = [&](std::int64_t count, const std::string& what) {
      if (count == 0 || !warned_.insert(lost.field + what).second) return;
      std::ostringstream text;  // in one piece, since other threads may write too
      text << "warning: results '" << name_ << "': field '" << lost.field << "' holds " << what << " in "
           << counted(static_cast<std::size_t>(count), "place") << " at " << grid.time << " s; written as 0\n";
      std::cerr << text.str();
    };
    warn(lost.no_number, "no number");
    warn(lost.beyond_float, "a number beyond the range of Float32");
  }
  if (!again) times_.push_back(grid.time);
  write_index();
#endif
}

std::string Collection::frame_name(int frame) const {
  char number[16];
  std::snprintf(number, sizeof number, "%06d", frame);
  return name_ + "/" + name_ + "_" + number + extension(kind_);
}

void Collection::write_index() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (int frame = 0; frame < frames(); ++frame) {
    char time[32];
    std::snprintf(time, sizeof time, "%.17g", times_[static_cast<std::size_t>(frame)]);
    text += std::string("    <DataSet timestep=\"") + time + "\" part=\"0\" file=\"" +
            frame_name(frame) + "\"/>\n";
  }
  replace_file(directory_ / (name_ + ".pvd"), text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace nereid::grid
