#pragma once
// Where an apex stands over its base for multipliers: bilinear faces of hexahedra, and normals of contacts that go evenly over edges.

#include <algorithm>

#include "contact/surface/base_surface.hpp"

namespace nereid::contact {

/// [-] of the size of a face: band along edges in which normals go over into each other.
constexpr double blended = 0.02;

/// The width of that band for an apex that touches at some height over a facet: it falls with the height, since over plates the foot would
/// leave its node. [m]
inline double blend_band(const BaseSurface& base, Index facet, double height) { return std::max(0.0, blended * base.size(facet) - height); }

/// Sets weights, normal and height of an apex over the bilinear face that a facet is half of, so that the cut of the face does not count.
/// The foot is the closest point, so a push makes no moment, and its rate is that of the height.
///
/// band     [m] along edges, in which the normal goes evenly from face to face, so that an apex over an edge can come to rest; 0: none
/// allowed  null, or of an apex on a symmetry plane: images of faces take from a normal what leads out of it
/// over     its weights are where the search begins
/// fourth   the weight of Half::fourth, the same
/// returns  whether the feature is on such a face, or its cut, and the apex has a foot there: not where the face is warped too much, or the
///          apex stands too high over a warped one; else nothing is changed
bool stand_on_face(const BaseSurface&, const Vectors& x, const Vec3& point, const Feature&, double band, const Mat3* allowed,
                   FeatureHeight& over, double& fourth);

/// Nodes around a place on a surface, with weights that have no jump where the place goes from face to face.
struct NodesAround {
  static constexpr int most = 12;
  int count = 0;
  std::array<Index, most> node{};  ///< those of the facet first, then Half::fourth
  std::array<double, most> weight{};
};

/// The nodes of the face that a facet is half of, and of the faces of its patch that are nearer to a place on it than a band of their own
/// size. A face counts fully where the place is on it or on its border, and less the farther off it is. Where there are more than `most`
/// nodes, those of the face alone.
///
/// place  [m] on the face
NodesAround nodes_around(const BaseSurface&, const Vectors& x, const Vec3& place, Index facet);

/// Lets the normal over a facet that is a face of its own go evenly from face to face, with height and weights.
void blend_over_facet(const BaseSurface&, const Vectors& x, const Vec3& point, const Feature&, double band, const Mat3* allowed,
                      FeatureHeight& over);

}  // namespace nereid::contact
