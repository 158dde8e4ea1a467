#pragma once
// What an apex is in contact with, from its entry until it leaves.

#include <array>
#include <limits>

#include "contact/surface/base_surface.hpp"

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
  Place out;  ///< where the apex would be if it were pushed out; its next path starts there. Without a facet: where the apex is

  void begin(Index facet, double height) {
    if (count < most_tracks) track[count++] = {facet, height};
    owned = -std::numeric_limits<double>::infinity();
  }
};

}  // namespace nereid::contact
