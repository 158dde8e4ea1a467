#pragma once
// Which parts of a base surface an apex is in contact with: remembered from its entry until it leaves.

#include <limits>
#include <span>

#include "contact/base_surface.hpp"

namespace nereid::contact {

/// Contact of an apex with one part of a base surface.
struct Track {
  Index facet = -1;   ///< where it slides now
  double height = 0;  ///< [m] h_c less the offset: the part of a penetration that makes no force. It rises to h_c as the apex leaves.
};

/// A point carried along with a facet.
struct Place {
  Index facet = -1;
  std::array<double, 3> weight{};
  double height = 0;  ///< [m]
};
Vec3 at(const Place&, const BaseSurface&, const Vectors& x);
/// The same where the nodes were `earlier` [s], with velocities constant since.
Vec3 at(const Place&, const BaseSurface&, const Vectors& x, const Vectors& v, double earlier);

/// How far apexes and base can have gone against each other since the last search. What holds here, and within some room around, holds as
/// long as `now` stays below until(room).
struct Moved {
  double now;   ///< [m]
  double from;  ///< [m]
  double until(double room) const { return from + room; }
};
/// Where a distance is known: two states can be apart by the sum of their distances from the search.
inline Moved from_search(double distance) { return {distance, -distance}; }
/// Where the way is known that steps have made, and what comes `ahead` of them: two states can be apart by the way between them.
inline Moved along_way(double way, double ahead) { return {way + ahead, way - ahead}; }

constexpr int most_tracks = 3;

/// All that an apex is in contact with.
struct Tracks {
  int count = 0;
  std::array<Track, most_tracks> track;
  /// [m] As long as Moved::now is less, the apex stays over the inside of the one facet that it slides on.
  double owned = -std::numeric_limits<double>::infinity();
  Place out;  ///< where the apex would be if it were pushed out; the next sweep starts there. Without a facet: where the apex is

  void begin(Index facet, double height) {
    if (count < most_tracks) track[count++] = {facet, height};
    owned = -std::numeric_limits<double>::infinity();
  }
};

/// One apex, and what it may have come through in a step.
struct Sweep {
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
void enter(const Sweep&, double deepest, Tracks&);

/// Where an apex in contact has come to another part of the surface, which the path of its pushed-out place crosses. In two directions it
/// has not where that part may not push the apex.
///
/// before, after   tracks at the start of the step and at its end
/// deepest  [m] contact of any apex in the step before
/// returns  a track to begin, without a facet if there is no such part
Track other_part(const Sweep&, const Tracks& before, const Tracks& after, double deepest);

/// The facet that an apex stands behind at the start: the shallowest that faces it, no deeper than the material behind it.
///
/// deepest   [m] no facet is looked for from deeper
/// returns  the facet, or -1;  depth: [m] below h_c
Index behind(const Sweep&, double deepest, double& depth);

/// [m] The distance of the nearest facet that can be another part for an apex in contact: of those that do not touch its tracks.
double nearest_other_part(const Sweep&, const Tracks&);

}  // namespace nereid::contact
