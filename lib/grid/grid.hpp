#pragma once
// ParaView files, written by our own code and read by VTK: the one door to VTK. Built without VTK, a Collection checks and writes nothing.

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/field.hpp"
#include "base/types.hpp"

namespace nereid::grid {

/// Whether this build writes and reads ParaView files at all (NEREID_WITH_VTK).
bool vtk_available();

/// Component names in the order in which ParaView labels every array of three or six components.
inline const std::vector<std::string> vector_components{"X", "Y", "Z"};
inline const std::vector<std::string> tensor_components{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

enum class CellKind { vertex, line, triangle, hexahedron };

/// Cells of one kind, nodes counted as the points of the grid are.
struct Cells {
  CellKind kind;
  Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic> nodes;  ///< [nodes per cell x cells]
};

/// What the number of a group of cells is called, as gmsh has it.
struct GroupName {
  std::string name;
  int number, dimension;  ///< 3 of solids, 2 of plates
};

/// What one frame shows. In the file points stand where they are now, with the displacement that brought them there.
struct Grid {
  double time = 0;           ///< [s]
  Vectors reference;         ///< [m] points at the start
  Vectors displacement;      ///< [m]
  std::vector<GroupName> names = {};  ///< of the numbers in a cell field
  std::vector<Cells> cells;  ///< cell fields are counted in this order
  std::vector<Field> point_fields, cell_fields;
};

enum class GridKind {
  volume,  ///< .vtu, any cells in any order
  surface  ///< .vtp: vertices before lines before triangles, the order in which VTK counts them
};

enum class Precision {
  single,  ///< derived fields as Float32; points and displacement are always Float64
  full     ///< everything as Float64, for verification
};

/// Arrays of a frame that are mostly those of the frame before, and what they are in a file: they need not be packed again.
struct Kept {
  struct Array {
    std::string bytes, text;
  };
  std::map<std::string, Array> arrays;
  std::size_t length = 0;  ///< [bytes] of its file
};

/// How far a Collection has come.
struct CollectionMark {
  std::vector<double> times;  ///< [s] of its frames
  std::int64_t replaced = 0;
};

/// One data set over time: DIRECTORY/NAME.pvd with its frames in DIRECTORY/NAME/NAME_000000.vtu.
///
/// Frames and .pvd are written aside and renamed, the .pvd after its frame: what it lists is there and whole, whatever the
/// disk does. Frames of an earlier run of the same name are removed first. A value that is no number, or beyond the range of
/// Float32, is written as 0 and counted, with one warning of each per field.
///
/// Invariants  equal grids give equal bytes, in any run.
class Collection {
 public:
  Collection(std::filesystem::path directory, std::string name, GridKind kind,
             Precision precision = Precision::single);

  /// Goes on with a collection after some of its frames; those behind them are removed. MachineError where frames are missing.
  Collection(std::filesystem::path directory, std::string name, GridKind kind, Precision precision, const CollectionMark&);

  /// Writes one frame; one at the time of the last frame replaces it.
  ///
  /// Needs  times that do not fall and the same arrays in the same order in every frame, else
  ///        InternalError; a disk that takes it, else MachineError.
  void add(const Grid& grid);

  int frames() const { return static_cast<int>(times_.size()); }  ///< written so far; 0 without VTK
  std::int64_t replaced() const { return replaced_; }             ///< values replaced by 0 so far
  CollectionMark mark() const { return {times_, replaced_}; }

 private:
  std::string frame_name(int frame) const;  ///< relative to the directory
  void write_index() const;

  std::filesystem::path directory_;
  std::string name_;
  GridKind kind_;
  [[maybe_unused]] Precision precision_;  // without VTK nothing is written
  std::string arrays_;  ///< what the first frame held; every frame must hold the same
  std::vector<double> times_;
  std::int64_t replaced_ = 0;
  [[maybe_unused]] Kept kept_;
  std::set<std::string> warned_;  ///< fields whose warnings have been given, with what was wrong
};

/// How long the file of a frame would be; zero without VTK. [bytes]
///
/// kept  of the frame before, if there is one; then of this one
std::size_t bytes_of(const Grid&, GridKind, Precision = Precision::single, Kept* kept = nullptr);

/// The files of a collection that are in a directory: its .pvd and its frames, of whatever run and kind, and drafts of them.
std::vector<std::filesystem::path> collection_files(const std::filesystem::path& directory, const std::string& name);

/// What a file of ParaView's holds, as it stands there.
struct Contents {
  Vectors points;                   ///< [m]
  std::vector<int> kind;            ///< VTK's number of each cell's kind, as 12 for a hexahedron
  std::vector<std::int64_t> begin;  ///< [cells + 1] where the points of each cell begin
  std::vector<Index> nodes;         ///< points of the cells
  std::vector<Field> point_fields, cell_fields;  ///< arrays of numbers; unit and components are left empty
  std::vector<Field> fields;                     ///< those of the file as a whole
  std::uint64_t checksum = 0;                    ///< of all bytes of the file
};

/// Reads a .vtu file.
///
/// fault  left as it is if the file could be read, else why it could not, as part of a sentence
Contents read_vtu(const std::filesystem::path& file, std::string& fault);

}  // namespace nereid::grid
