#pragma once
// Near sets: which apexes can touch their base before the next search, and over which facets.

#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <span>

#include "contact/data/workspace.hpp"
#include "contact/search/body_ways.hpp"
#include "geometry/closest.hpp"

namespace nereid::contact {

constexpr double steps_ahead = 2;  ///< apexes that may be in contact after so many of the longest steps limit the step

/// The closest of the facets near an apex; of those that are as near, that which faces it most: surface/nearer.hpp.
struct Nearest {
  Feature feature;  ///< facet -1: none is near
  geometry::Closest closest{geometry::Kind::facet, 0, {}, std::numeric_limits<double>::infinity()};
  /// [m] way to where the first of the facets can be entered, but for h_c of the apex; it may reach past a border
  double safe_distance = std::numeric_limits<double>::infinity();
  double gap = std::numeric_limits<double>::infinity();  ///< [m] its distance less what it stands off
  double distance() const { return std::sqrt(closest.distance_squared); }
};
/// body  of an automatic contact, whose facets alone are taken; -1: those of all
Nearest nearest_of(const Interface&, const Vectors& x, Index apex, std::span<const Index> facets, Index body = -1);

/// How far apexes and base have moved against each other since the last search, at most. [m]
///
/// Any way taken as common gives a bound. That of the base in the mean is good: here that of its first node now, and what the mean was
/// beyond it a step before, which takes no pass of its own.
double moved_since_search(const Sides&, const Vectors& x, SidesMemory&);

/// The margin of a search, or what apexes and base can go against each other in some steps where that is more. [m]
double margin_of(const Sides&, const Vectors& v);

/// Lists the apexes nearer to their base than h_c and the margin, with the facets that are so near, and those in contact.
///
/// All stay as they are where the base surface has positions that are not finite or beyond farthest_place: the elements say so at this
/// very state, and the run ends.
void search(const Interface&, const Vectors& x, Memory&, Workspace&);

inline bool has_near(const Memory& memory) { return !memory.near.empty(); }

/// Notes where a search has found apexes and base.
void keep_search(const Sides&, const Vectors& x, SidesMemory&);

/// The largest speed of nodes against each other, at most: the diagonal of the box around their velocities. [m/s]
double speed_apart(const Vectors& v);
double speed_apart(const Vectors& v, std::initializer_list<std::reference_wrapper<const Subset>> nodes);

/// Notes which bodies of an automatic contact are near another one, or folds of them near each other.
void keep_active(const Interface&, Memory&);

/// Searches for an automatic contact if its bodies may have gone by half of the margin since the last search, and looks which are active.
///
/// way    [m] that nodes have gone against each other at most in the step that led to x
/// ahead  [m] the same of the step to come
/// returns  whether it has searched
template <class Contact, class Remembered, class Work>
bool search_bodies_where_due(const Contact& contact, const Vectors& x, const Vectors& v, double way, double ahead, Remembered& memory,
                             Work& workspace) {
  memory.way += way;
  if (memory.searches > 0 && memory.way + ahead <= 0.5 * memory.margin) return false;
  memory.margin = margin_of(contact, v);
  memory.way = 0;
  memory.way_of_body.assign(static_cast<std::size_t>(contact.bodies.count()), 0);
  search(contact, x, memory, workspace);
  keep_active(contact, memory);
  find_near_bodies(contact, memory, workspace);
  return true;
}

/// Whether a search is due: apexes and base have moved by half of the margin since the last one, or after many looks at all. What is known
/// of where each apex stands holds for less way the more all have moved.
///
/// has_near  whether anything is near
/// moved     [m] how far they have moved since the last search, at most
bool is_due(const Sides&, const Vectors& x, bool has_near, SidesMemory&, double& moved);

/// Searches where it is due.
///
/// v  [m/s] that they may go on with
/// returns  how far they have moved since the last search, at most [m]
template <class Contact, class Remembered, class Work>
double search_where_due(const Contact& contact, const Vectors& x, const Vectors& v, Remembered& memory, Work& workspace) {
  double moved = 0;
  if (!is_due(contact, x, has_near(memory), memory, moved)) return moved;
  memory.margin = margin_of(contact, v);
  search(contact, x, memory, workspace);
  return 0;
}

}  // namespace nereid::contact
