#pragma once
// How a point stands over the patch of a facet. This is the paper's walk: Kulak & Fiala, chapter 4.

#include "contact/surface/base_surface.hpp"

namespace nereid::contact {

/// Where a point stands over a patch.
struct Stand {
  Feature feature;     ///< of the patch, closest to the point
  FeatureHeight over{};  ///< over that feature; past a wall over the plane of its facet
  double past = 0;     ///< [m] way in that plane past the wall; zero where no wall was passed
  Vec3 outward = Vec3::Zero();            ///< unit vector of that way
  Feature wall{};                         ///< the edge or vertex where it was passed
  std::array<double, 3> wall_weight{};    ///< of its closest point on the nodes of the facet
};

/// Whether no other facet of the patch can be closer to a point over the inside of a facet.
struct Ownership {
  bool whole = false;
  double room = 0;  ///< [m] so far point and nodes may move against each other, and it stays so
};

/// height  [m] up to which no other may be closer
Ownership ownership(const BaseSurface&, const Vectors& x, Index facet, const FeatureHeight& over, double height);

/// Finds the closest point of the patch, walking from facet to facet with falling distance.
///
/// Over the inside of a facet that Eq. 14 owns with some room only that facet is looked at. Else the walk tries all facets that meet
/// the sphere around the foot and are connected to it without a wall between. Its radius is twice the distance, or more where the surface
/// had sharp valleys in the reference, or has one next to the facet.
/// From deeper than 0.45 of the thickness behind a facet it goes nowhere: the far side of the body is nearer there.
///
/// from     facet to start from
/// self     the node at the point if it is of the same surface: the walk leaves out what is beside it in the mesh; or -1
Stand stand(const BaseSurface&, const Vectors& x, const Vec3& point, Index from, Index self = -1);

/// The same, if the surface reached so far past its open borders as a force stays whole.
Stand stand_whole(const BaseSurface&, const Vectors& x, const Vec3& point, Index from, Index self = -1);

}  // namespace nereid::contact
