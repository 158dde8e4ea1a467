#pragma once
// What ParaView sees of a run: bodies, contact elements and walls as grids.

#include "dynamics/run.hpp"
#include "grid/grid.hpp"

namespace nereid::output {

// What frames are made of, and the files they go to.
using grid::CellKind, grid::Cells, grid::Collection, grid::Grid, grid::GridKind, grid::Precision;
using grid::vector_components;

/// Which quantities of elements a frame has.
enum class FrameFields {
  usual,  ///< element::in_usual_frames(), and contact elements that act
  all,    ///< with strain, of plates with the middle and the pressure too, and with contact elements that are open
};

/// All elements of all blocks with displacement, velocity, contact force, the elements' fields, and the numbers and names of their bodies.
Grid body_grid(const dynamics::View&, FrameFields = FrameFields::usual);

/// Contact elements: a line from the foot to the apex (part 0), then the facet that
/// owns its base (part 1), each with kind (3 tetrahedral, 2 triangular, 1 line element), base, apex,
/// gap, tractions at the node of the apex, status and reconnections. The tractions are of the whole contact: dynamics::traction_at().
/// Elements that lost their base are points at the apex. Guards are there while they push only.
Grid contact_grid(const dynamics::View&, FrameFields = FrameFields::usual);

/// Rigid planes and floors as rectangles around the scene, at time zero.
Grid walls_grid(const dynamics::View&);

}  // namespace nereid::output
