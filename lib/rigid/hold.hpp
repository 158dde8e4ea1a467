#pragma once
// What planes that hold nodes of a rigid body leave to it.

#include <optional>
#include <span>

#include "rigid/body.hpp"

namespace nereid::rigid {

/// A node that does not move along a direction.
struct HeldNode {
  Vec3 arm;     ///< [m] from the centre
  Vec3 normal;  ///< unit vector
};

/// The shifts and turns about the centre that keep all nodes on their planes, however far they go; nothing where a turn that is left to the
/// body leads about another point, as a hinge beside the centre, or about two axes.
///
/// size  [m] of the body
std::optional<Hold> hold_of(std::span<const HeldNode>, double size);

}  // namespace nereid::rigid
