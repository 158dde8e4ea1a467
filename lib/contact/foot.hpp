#pragma once
// Where an apex stands over its base for multipliers: bilinear faces of hexahedra, and normals that go evenly over edges.

#include "contact/base_surface.hpp"

namespace nereid::contact {

/// [-] of the size of a face: band along edges in which normals go over into each other.
constexpr double blended = 0.02;

/// Spreads the foot of an apex over the face that its facet is half of, so that the cut of the face does not count: weights, normal and
/// height are those of the bilinear surface. The foot is along the normal, so a push makes no moment.
///
/// blends   whether the normal goes evenly from face to face in a band along edges, so that an apex over an edge can come to rest
/// allowed  null, or of an apex on a symmetry plane: images of faces take from a normal what leads out of it
/// over     of the feature; changed
/// returns  the weight of Half::fourth
double spread(const BaseSurface&, const Vectors& x, const Vec3& point, const Feature&, bool blends, const Mat3* allowed,
              FeatureHeight& over);

}  // namespace nereid::contact
