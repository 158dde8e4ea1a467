#pragma once
// The bytes of ParaView's files: XML of VTK with inline arrays, in base64 and packed by the rules of zlib.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "grid/grid.hpp"

namespace nereid::grid {

/// Values of one field that its array cannot hold; they are written as 0.
struct Lost {
  std::string field;
  std::int64_t no_number = 0, beyond_float = 0;
};

/// The array of the whole file that says that its points are those at the start plus the displacement.
inline constexpr const char* deformed_mark = "points_are_deformed";

/// The file of one frame. Cells and whole numbers that are those of the frame before are taken from there as they were packed.
///
/// kept  of the frame before; then of this one
/// lost  by field, in the order written
/// Throws InternalError where a whole number is beyond 32 bits.
std::string frame_text(const Grid&, GridKind, Precision, Kept& kept, std::vector<Lost>& lost);

}  // namespace nereid::grid
