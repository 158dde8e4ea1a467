#pragma once
// The active features of an apex: those of a base surface to which it is closest locally.
//
// On a plain or a ridge that is one feature, the paper's contact element. In a valley each flank is
// active, and contact.cpp pushes it out of all of them at once.

#include "contact/base_surface.hpp"
#include "contact/projection.hpp"

namespace nereid::contact {

constexpr double border_tolerance = 1e-6;  // of a facet's size: on a common border both facets have the apex

/// The nodes of a feature.
struct FeatureNodes {
  int count;
  std::array<Index, 3> node;
};
FeatureNodes nodes_of(const BaseSurface&, const Feature&);

/// Height of a point over a feature, signed by the facet's side, with the weights of its nodes.
struct FeatureHeight {
  double height;  ///< [m]
  Vec3 normal;
  std::array<double, 3> weight;
};
FeatureHeight height_over(const BaseSurface&, const Vectors& x, const Feature&, const Vector<double>& point);

/// Whether a closest point lies on the border of the surface.
bool on_border(const BaseSurface&, Index facet, const geometry::Closest&);

/// Whether a closest point lies where the surface ends: on a border edge behind which there is no image, or where
/// such an edge meets a symmetry plane.
bool at_end(const BaseSurface&, Index facet, const geometry::Closest&);

/// Whether a closest point on the border of the surface belongs to an apex that has left it; if not,
/// the apex is on the border to within a margin and the plane of its facet is its base.
///
/// allowed  directions of an apex on a symmetry plane, or null: where the foot lies in the plane too,
///          the surface goes on behind it and the margin is that of round-off, except at_end()
/// image    count the image of the facet behind the plane: no apex is past a border there, except at_end(), where the
///          normal between the two lies in the plane
bool past_border(const BaseSurface&, const Vectors& x, Index facet, const geometry::Closest&,
                 const Vector<double>& apex, const Mat3* allowed, bool image);

/// The features that may push an apex.
struct ActiveFeatures {
  int count = 0;
  std::array<Feature, most_candidates> feature;
  std::array<FeatureHeight, most_candidates> at;

  /// Once the list is full the lowest are kept: they push hardest.
  void add(const Feature&, const FeatureHeight&);
};

/// Collects the active features of an apex, starting from where the walk ended.
///
/// height   [m] of the apex or h_c, whichever is larger: how far around it is worth looking
/// allowed  directions of an apex on a symmetry plane, or null
ActiveFeatures active_features_on(const BaseSurface&, const Vectors& x, const Vector<double>& apex, const WalkEnd& from,
                 double height, const Mat3* allowed);

}  // namespace nereid::contact
