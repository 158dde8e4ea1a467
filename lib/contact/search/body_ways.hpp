#pragma once
// How far bodies of an automatic contact have gone against those near them since the last search.
//
// What is known of where an apex or a pair of edges stands holds until its nodes have gone some way against each other. All bodies of a
// scene together go farther than each of them against its neighbours: that of other bodies far away need not count.

#include "contact/data/workspace.hpp"

namespace nereid::contact {

/// Lists the pairs of bodies of which an apex and a facet, or two edges, were near each other at the last search.
void find_near_bodies(const Interface&, const Memory&, SearchWork&);
void find_near_bodies(const EdgeContact&, const EdgeMemory&, SearchWork&);

/// How fast nodes of each body and of those near it go against each other, at most: the largest diagonal of the boxes around the velocities
/// of both; zero where no body is near. Sets SearchWork::apart. [m/s]
void find_speeds_apart(const Sides&, const Vectors& v, SearchWork&);

/// Adds the ways of a step to SidesMemory::way_of_body. Needs find_near_bodies().
///
/// v, dt  [m/s] [s] velocities in the step, and its length
void add_ways(const Sides&, const Vectors& v, double dt, SidesMemory&, SearchWork&);

/// Where the way since the last search is known, of one body and those near it.
///
/// next  [s] length of the step to come, with the velocities of find_speeds_apart()
inline Moved moved_of_body(const SidesMemory& memory, const SearchWork& workspace, Index body, double next) {
  return along_way(memory.way_of_body[static_cast<std::size_t>(body)], next * workspace.apart[static_cast<std::size_t>(body)]);
}

}  // namespace nereid::contact
