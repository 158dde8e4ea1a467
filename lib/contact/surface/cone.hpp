#pragma once
// Which contact normals an apex admits. A node is pushed by another body only along a direction that its own surface opposes: the plane
// through the apex with that normal supports the surface around it.

#include "contact/surface/base_surface.hpp"

namespace nereid::contact {

/// [-] The largest admissible reach_behind() where both surfaces have apexes: an excluded node is held by those of the other surface.
/// Normals of bevels to 30 degrees are admissible, bisectors of ridges (0.71) and corners (0.82) of a box against a flat surface are not.
constexpr double behind_in_two_directions = 0.5;

/// [-] The same where only one surface has apexes, so that nothing else holds an excluded node: only normals along its surface, within 11
/// degrees, are excluded.
constexpr double behind_in_one_direction = 0.98;

constexpr double level_by = 1e-3;  ///< [-] of flush_step()

/// The largest step from one surface onto a side of a ridge that is flush, so that what slides onto this does not catch. [m]
///
/// level_by of the longest edge of that side, and of how far the side across the ridge reaches behind it: an elastic floor gives way by
/// less under a load, and a mesh does not say how round a ridge is that stands out by so little. A thin sheet of long cells stands out by
/// more.
double flush_step(const BaseSurface&, const Vectors& x, Index onto, Index across);

/// How far the surface around a node reaches behind the plane through the node with a normal n. [-]
///
/// The largest of -n . e over all unit directions e from the node along its facets: the sine of the tilt of a flat surface against n, and
/// at most zero where the surface is in front of the plane. -1 without facets.
///
/// n  unit vector from the base to the node
double reach_behind(const Fans& own, const Vectors& x, Index node, const Vec3& n);

/// Whether a base may push an apex along n: its own surface reaches less than `most` behind the plane with that normal, and n does not lead
/// out of its body.
///
/// n        unit vector from the base to the apex
/// own      surface of the apex; without facets all normals are admissible
/// allowed  projector onto the directions of an apex on a symmetry plane, or null
bool may_push(const Fans& own, const Vectors& x, Index apex, const Vec3& n, double most, const Mat3* allowed);

}  // namespace nereid::contact
