#pragma once
// How an edge stands over another one, and for how long it cannot come over it.

#include "contact/data/workspace.hpp"

namespace nereid::contact {

/// How an edge stands over a base edge.
///
/// in_face  one of them may be no ridge: where that is so now, the other has to stand on it, and not to lie flat in that face, where nodes
///          keep both apart
/// side     where they were over each other in the step before: faces beside them may lean farther over the other edge; 0: to be found.
///          Between rims both sides may be right, then it is the one with a positive height
Over over(const EdgeContact&, const Vectors& x, Index edge, Index base_edge, bool in_face, int side);

/// The way by which nodes may move against each other before the lines of two edges can be closest within both; not positive where they
/// are, or are parallel. [m]
///
///     way = d / (2 (1 + |t| + |1 - t| + 4 h / w))
///
/// w      width of one edge across the other one, |L1 x L2| / |L2|
/// d      by which it ends beside the plane of the other edge and of the normal of both
/// t, h   place on the other edge, height; the point there goes with the ends of that edge by |t| + |1 - t|, and the normal turns
/// The larger of both edges counts. The factor of 2 is for turns that are not small.
double stays_beside(const EdgeContact&, const Vectors& x, Index edge, Index base_edge);

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
double stays_flat(const EdgeContact&, const Vectors& x, Index edge, Index base_edge);

/// Whether both edges are ridges or rims as they stand now, whenever the last search was.
bool are_ridges(const EdgeContact&, const Vectors& x, Index edge, Index base_edge);

/// Whether a place on an edge is within it.
bool is_within(double place);

/// Lines of two edges where they are closest, whatever their ends and what is in front of them; false if they are parallel.
bool between_lines(const EdgeContact&, const Vectors& x, Index edge, Index base_edge, int side, Over& at);

/// Whether edges that are over each other have left each other sideways when their lines meet, so that neither touches the other: the
/// lines are then closest outside of an edge.
///
/// ahead  [m] where the nodes will be at the end of a step;  part  [-] of the step after which the lines meet
bool meet_beside(const EdgeContact&, const Vectors& x, const Vectors& ahead, Index edge, Index base_edge, double part);

/// stays_beside() of edges whose lines are known.
double stays_beside(const EdgeContact&, const Vectors& x, Index edge, Index base_edge, const Over& lines);

}  // namespace nereid::contact
