#pragma once
// Edges over edges: the fourth element of the family.
//
//       3                 Two edges cross, and no node of one body is inside the other: the nodes 1-2 of one and 3-4 of the other are
//        \     2          a tetrahedron of which they are opposite edges. Its height h = 6 V / |L1 x L2| is their distance, along the
//     1 --\-- /           normal of both (geometry/crossing.hpp). They touch where both lines are closest within both edges, and the
//          \             normal leads out of the ridge of each.
//           4
//
// A crossing has no tributary area, so it has no penalty: it acts by multipliers, also where its contact has a penalty, and sets no step.
// Nearly parallel edges have no crossing: their nodes are over the other edge, and apexes see that. docs/theory/contact.md, "Edges".

#include "contact/condition.hpp"
#include "contact/near.hpp"

namespace nereid::contact {

/// h_c between two edges. [m]
inline double height_between(const Interface& interface, Index edge, Index base_edge) {
  const Scalars &one = interface.edges.half, &other = interface.base_edges.half;
  return interface.edge_height + (one.size() > 0 ? one(edge) + other(base_edge) : 0);
}

/// What two edges have together.
inline const Between& between_edges(const Interface& interface, Index edge, Index base_edge) {
  const Bodies& bodies = interface.bodies;
  if (bodies.count() == 0) return interface;
  return bodies.between[bodies.pair(interface.edges.body[edge], interface.base_edges.body[base_edge])];
}

/// A crossing of two edges that has not been looked at.
inline Crossing crossing_of(const EdgePair& pair) {
  Crossing crossing;
  crossing.edge = pair.edge, crossing.base_edge = pair.base_edge, crossing.in_face = pair.in_face;
  return crossing;
}

/// How an edge stands over a base edge.
///
/// in_face  one of them may be no ridge: where that is so now, the other has to stand on it, and not to lie flat in that face, where nodes
///          keep both apart
/// side     where they were over each other in the step before: faces beside them may lean farther over the other edge; 0: to be found.
///          Between rims both sides may be right, then it is the one with a positive height
Over over(const Interface&, const Vectors& x, Index edge, Index base_edge, bool in_face, int side);

/// The way by which nodes may move against each other before the lines of two edges can be closest within both; not positive where they
/// are, or are parallel. [m]
///
///     way = d / (2 (1 + |t| + |1 - t| + 4 h / w))
///
/// w      width of one edge across the other one, |L1 x L2| / |L2|
/// d      by which it ends beside the plane of the other edge and of the normal of both
/// t, h   place on the other edge, height; the point there goes with the ends of that edge by |t| + |1 - t|, and the normal turns
/// The larger of both edges counts. The factor of 2 is for turns that are not small.
double stays_beside(const Interface&, const Vectors& x, Index edge, Index base_edge);

/// The way by which nodes may move against each other before one edge of a pair can come over the other, where one of them lies in a face
/// and the other is a ridge; not positive where it may be over it now. [m]
///
///     way = (s - b - |t_1 + t_2| - r) / (2 T)
///
/// s, b      the sines of `over`: so steep the facets of the ridge must stand, and so far what is in front of an edge may rise
/// t_1, t_2  unit vectors from the edge in the face into its facets; a direction that leads out of both is off the normal of the face by a
///           sine of b + |t_1 + t_2| at most
/// r         the sine by which both facets of the ridge stand off the face now
/// T         [rad/m] by which this difference turns per way at the most; the factor of 2 is for turns that are not small
///
/// Where one of both is of a plate, both may stand up off each other by the sine c, each by |t_1 + t_2| / 2 at the most. It is then no
/// more than the larger (c - |t_1 + t_2| / 2) / (2 T) of both edges, with T of the edge alone.
double stays_flat(const Interface&, const Vectors& x, Index edge, Index base_edge);

/// Lists the pairs of edges that are nearer than h_c and the margin, of which one at least is a ridge or a rim, or both turn on plates.
void search_crossings(const Interface&, const Vectors& x, Memory&, Workspace&);

/// Finds the conditions of crossings, with the impulses of the step before as a first guess. An edge that comes over another one sideways,
/// below it, starts with an offset.
///
/// Needs  look_ahead() for its nodes
void find_crossings(const Interface&, const Motion&, Memory&, Workspace&, Multipliers&);

/// Books the first half of the step that led to t, in which the forces of the memory have acted.
void book_first_half_of_crossings(const Motion&, Memory&);

/// Writes the impulses of contactors `first` to `last` into the memory as forces over the time h [s]; t [s] now.
void take_over_crossings(const Interface&, double h, double t, Index first, Index last, const Multipliers&, Memory&);

}  // namespace nereid::contact
