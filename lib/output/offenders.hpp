#pragma once
// Elements of a mesh at fault, as files for ParaView.

#include <filesystem>
#include <vector>

#include "grid/grid.hpp"
#include "mesh/judge.hpp"

namespace nereid::output {

/// The elements of all meshes as one grid, with cell fields `number`, as their origin calls them, `mesh`, counted from 0 in the order
/// given, and for each flaw that any of them has one of its name, 1 on the elements that have it and else 0.
grid::Grid grid_of(const std::vector<mesh::Offenders>&);

/// Writes DIRECTORY/offenders.pvd and its one file, or removes older ones if there are no elements.
/// MachineError where the disk does not take it.
void write_offenders(const std::filesystem::path& directory, const std::vector<mesh::Offenders>&);

}  // namespace nereid::output
