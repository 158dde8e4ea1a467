#pragma once
// The way out of contact: the potential of an apex over the parts of a surface that it is in contact with.

#include "contact/data/stencil.hpp"
#include "contact/surface/projection.hpp"
#include "contact/tracking/tracking.hpp"

namespace nereid::contact {

/// How an apex is pushed out, for a spring of 1 N/m: the energy is half of `squared`.
struct Exit {
  int count = 0;
  Stencils* stencils = nullptr;  ///< [count] what pushes
  Feature strongest;       ///< the feature that pushes hardest; without a push that of the first track
  double length = 0;       ///< [m] of the longest penetration vector
  double squared = 0;      ///< [m2] twice the energy
  double gap = 0;          ///< [m] without a push: the least height above that of a track
  double level = 0;        ///< [m] without a push: the height of the first track
  double depth = 0;        ///< [m] the deepest penetration, without the offset
  double steepest = 1;     ///< [-] squared gradient of the potential's depth: past a wall it is more than one
  int lost = 0;            ///< tracks that ended past a wall
  bool has_moment = false;  ///< feet are found by iteration, or parts act one after the other: the pushes may leave a small moment
};

/// Finds the shortest way out of all that an apex is in contact with: docs/theory/contact.md.
///
/// Moves the tracks to the facets where the apex stands now, raises their heights where a penetration with an offset has shrunk, and ends
/// those that the apex has left. What pushes against another push is left on a way of its own.
///
/// allowed   directions of an apex on a symmetry plane, or null
/// moved     of apexes and base against each other since a state at which Tracks::owned was cleared; infinite: not known
/// stencils  where the pushes are written
/// release_height  [m] above the contact height up to which an apex has not left yet
/// self            node of the apex if it is of the same surface, or -1
Exit shortest_exit(const BaseSurface&, const Vectors& x, const Vec3& apex, double contact_height, const Mat3* allowed, Moved moved, Tracks&,
               Stencils& stencils, double release_height = 0, Index self = -1);

}  // namespace nereid::contact
