#pragma once
// Which parts of a base surface an apex is in contact with: remembered from its entry until it leaves.

#include <span>

#include "contact/data/tracks.hpp"
#include "contact/surface/base_surface.hpp"

namespace nereid::contact {

Vec3 at(const Place&, const BaseSurface&, const Vectors& x);
/// The same where the nodes were `earlier` [s], with velocities constant since.
Vec3 at(const Place&, const BaseSurface&, const Vectors& x, const Vectors& v, double earlier);

/// One apex, and what it may have come through in a step.
struct ApexPath {
  const BaseSurface& base;
  const Fans& own;              ///< the surface of the apexes; without facets every base faces the apex
  const Vectors& x;             ///< [m] at the end of the step
  const Vectors& v;             ///< [m/s] constant over the step
  double dt;                    ///< [s]
  std::span<const Index> near;  ///< facets that can have been reached
  Index apex;                   ///< node
  const Mat3* allowed;          ///< directions of an apex on a symmetry plane, or null
  double contact_height;        ///< [m] h_c, beside BaseSurface::stand_off
  double most_behind;           ///< [-] of may_push()

  double level(Index facet) const { return contact_height + stand_off(base, facet); }
};

/// Begins the contact of a free apex that its path in a step has led into the base.
///
/// It has where its path crosses the plane of a near facet, at h_c or at the surface itself, from the front, inside the facet, and the
/// facet may push it. On a ridge whose sides are walls it gets a track on both. Where the facet may not push it, the apex came over a
/// wall: the track begins at the shallowest facet that may, with an offset, so that there is no initial force. If there is none, apexes of
/// the other surface hold it; only where there are no such does the track begin at that facet itself. An offset also has what slides flush
/// from one body onto the next one: it crosses the side of that at a ridge, and is no deeper below the other side than a flush_step()
/// and twice the deepest contact of the step before. Under an open border an apex may enter sideways down to the latter.
///
/// deepest  [m] contact of any apex in the step before
void enter(const ApexPath&, double deepest, Tracks&);

/// Where an apex in contact has come to another part of the surface, which the path of its pushed-out place crosses. In two directions it
/// has not where that part may not push the apex.
///
/// before, after   tracks at the start of the step and at its end
/// deepest  [m] contact of any apex in the step before
/// returns  a track to begin, without a facet if there is no such part
Track other_part(const ApexPath&, const Tracks& before, const Tracks& after, double deepest);

/// The facet that an apex stands behind at the start: the shallowest that faces it, no deeper than the material behind it.
///
/// deepest   [m] no facet is looked for from deeper
/// returns  the facet, or -1;  depth: [m] below h_c
Index behind(const ApexPath&, double deepest, double& depth);

/// [m] The distance of the nearest facet that can be another part for an apex in contact: of those that do not touch its tracks.
double nearest_other_part(const ApexPath&, const Tracks&);

}  // namespace nereid::contact
