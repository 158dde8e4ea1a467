#pragma once
// What a narrow side of an element costs: which element asks for the smallest step, and why.

#include "element/block.hpp"

namespace nereid::element {

/// The element of a block with the smallest stable step, and its widths as that step sees them.
struct Narrowest {
  Index element = -1;
  Vec3 centre = Vec3::Zero();     ///< [m]
  Vec3 width = Vec3::Zero();      ///< [m] ascending: edges of a brick, heights of an equilateral triangle (two)
  Vec3 direction = Vec3::UnitX(); ///< unit vector along the smallest width
  double frequency = 0;           ///< [1/s] proportional to that of the element, within a factor of two for all kinds
  double gain = 1;  ///< [-] how many times larger the step would be if the smallest width were the next one
};

/// Looks at all elements of a block at positions x.
///
/// With the eigenvalues g1 >= g2 >= g3 of B B^T, B the mean gradients of the shape functions,
///     widths 1 / sqrt(2 g),   omega^2 ~ lambda (g1 + g2 + g3) + 2 mu g1,   gain = omega(g1) / omega(g2 for g1)
/// (plates: 1.5 for 1/2, and the lambda of plane stress): the bound of docs/theory/hexahedron.md.
Narrowest narrowest(const AnyBlock&, const Vectors& x);

/// The stable step of each element of a block over the smallest of them, by omega(g) of the same bound. [-] [elements]
///
/// Step limits of elements that bend stiffly include their bending: those of bricks up to seven times as long as wide differ by 7 %.
Scalars relative_steps(const AnyBlock&, const Vectors& x);

}  // namespace nereid::element
