#pragma once
// What the arrays of a file say of sets of points, and how the groups of cells are called.

#include <map>
#include <string>
#include <vector>

#include "grid/grid.hpp"

namespace nereid::grid {

/// Points of a file that have a name there.
struct FileSet {
  std::string name;
  std::vector<Index> points;  ///< ascending, each once
};

/// The sets that the point arrays of a file hold: an array of 0 and 1 is one set, whatever its type, and an array of whole numbers from -1
/// on several in one, as meshio writes them: the name of the array joins theirs, its values are the numbers of these names, -1 is none.
///
/// warnings  arrays that look like sets and are none of these, and arrays in which a point can be in one of several sets alone
std::vector<FileSet> point_sets(const Contents&, std::vector<std::string>& warnings);

/// Names of the groups of cells of a dimension, by number: arrays of the whole file that hold a number and a dimension, as gmsh has them.
std::map<int, std::string> group_names(const Contents&, int dimension);

/// Cell arrays of whole numbers that look like regions and are not used.
///
/// used  the array that is
std::vector<std::string> unused_regions(const Contents&, const std::string& used);

}  // namespace nereid::grid
