#pragma once
// A mesh out of a file that some other program wrote.

#include <string>
#include <vector>

#include "grid/grid.hpp"
#include "mesh/judge.hpp"
#include "mesh/mesh.hpp"

namespace nereid::grid {

/// A mesh, or all that is wrong with what was to become one.
struct FileMesh {
  mesh::Mesh mesh;                  ///< names start with the body's
  mesh::Origin origin;              ///< the numbers of its cells
  std::vector<std::string> faults;  ///< each part of a sentence about the file; the mesh is empty if there are any
  mesh::Offenders offenders;        ///< the elements that faults are about; none of faults about anything else
};

/// What cells with three or four corners are where they lie on faces of hexahedra.
enum class BoundaryCells { surfaces, plates };

/// The cell array that may be missing: then a file has one region.
inline constexpr const char* usual_region_array = "region";

/// Makes a mesh of what a file holds: hexahedra, triangles, and quadrilaterals cut in two from first to third corner, or from second to
/// fourth where only that cut lies inside.
///
/// Names      of groups of cells are those of arrays of the whole file that hold [number, dimension]; else as follows.
/// Regions    by the cell array `region_array`, whole numbers n: `name.region_n`. Without that array all cells are
///            region `name`; where there are solids and plates these are `name.hexahedra` and `name.triangles`.
/// Boundaries triangles and quadrilaterals of one number n that all lie on faces of hexahedra, unless they are said to be plates: no
///            elements, but a node set and, of outer faces, a surface `name.boundary_n`. Without numbers `name.boundary`.
/// Node sets  `name` (all), one of each region, those of point_sets(), `name.lines_n` and `name.points_n` of lines and points of number n,
///            without numbers `name.lines` and `name.points`.
/// Surfaces   of solids `name.skin`, the outer faces with normals outwards and its node set, and for each node set the
///            part of the skin all of whose corners are in the set, if any. Of plates `name.top` (normals as
///            those of the triangles) and `name.bottom`, and for each node set `name.<array>_top`, `name.<array>_bottom`.
///
/// Points of no cell are dropped; those that stay keep their order. Faces of hexahedra are cut as mesh::cut_of_face()
/// says, whatever their numbers. Faults are other kinds of cells, by name and number; elements that mesh::judge() refuses;
/// points that are no numbers; regions that are no whole numbers from 0 on, hold both solids and plates or both plates and a boundary, or
/// whose cells lie at the places of faces of hexahedra without their nodes; names that are given twice.
FileMesh file_mesh(const std::string& name, const Contents&, const std::string& region_array = usual_region_array,
                   BoundaryCells = BoundaryCells::surfaces);

}  // namespace nereid::grid
