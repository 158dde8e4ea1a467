#pragma once
// Heights over points: where faces of the apexes' side lie on their base, an apex has one condition of what the points of all faces around
// it find, with dual weights. Stiffness is not added then, as by nodes of both sides, nor is a load of one face given to another, as by
// nodes of one side: docs/theory/points.md.
//
// A point q of a face, at sum of phi_b(q) x_b, stands h_q over its foot, the point of the base with shape functions N_l(q). Weights w_aq
// that are dual to the shape functions of the face,
//
//     sum over q of w_aq phi_b(q) = 1 if b is a, else 0,
//
// leave of the face the apex alone where the base is plane; for the Gauss points of a face they are constants. With the part A_f of the
// tributary area of the apex that lies on face f
//
//     A g = sum of A_f w_aq h_q,     A v = sum of A_f w_aq n_q . (sum of phi_b(q) v_b - sum of N_l(q) v_l),     A = |sum of A_f w_aq n_q|
//
// with the normal n_q of the base at each foot. The forces of each point lie on one line, so they keep momentum and angular momentum.
//
// Points at the nodes make this the contact element of Kulak & Fiala. It remains where a face leans to its base, as at a ridge or corner.

#include <vector>

#include "contact/data/workspace.hpp"

namespace nereid::contact {

/// Parts of the side of a base and of the depth of an element that a guard may be deep in any case: the latter is a quarter of what the
/// audit warns of.
constexpr double always_allowed = 0.01, most_allowed = 0.025;

constexpr double no_weight = 1e-14;  ///< of a push: round-off

/// Finds the facet over whose plane a point stands: from a facet on across edges that are no walls.
///
/// returns  the facet, or -1 past a border or wall
Index facet_below(const BaseSurface&, const Vectors& x, const Vec3& point, Index from, FeatureHeight& over);

/// Finds the foot of a point: from a facet on across edges that are no walls.
///
/// returns whether it has one; not past a border or wall
bool find_foot(const BaseSurface&, const Vectors& x, const Vec3& point, Index from, Foot& foot);

/// What points of faces give an apex.
struct OverPoints {
  double area = 0;                ///< [m2] of faces whose points count
  double of_node = 0;             ///< [m2] of faces that lean: the height of the node itself counts for them
  bool covered_elsewhere = false; ///< a face is covered in part, and nodes of it that are better covered have its points
  double gap = 0;                 ///< [m3] height times area, without the level of contact
  Vec3 normal = Vec3::Zero();     ///< [m2]
};

/// [m] What a guard may be deep without acting: a hundredth of the side of the base, and what a plane face of the base leaves between it
/// and a surface that is curved like that of the guard.
double allowance(const Interface&, const Vectors& x, Index apex, Index facet);

/// Begins a step: measures the faces that apexes asked for in the step before, all at once.
void begin_points(const Interface&, const Vectors& x, PointWork&);

/// Begins a range of apexes.
void begin_range(PointSum&);

/// Sums the points of all faces around an apex over the part of the base that a facet belongs to, and lists in PointSum::sum what each
/// node gets, in m2 along the normals of the points; the apex comes first.
OverPoints sum_points(const Interface&, const Vectors& x, Index apex, Index facet, const PointWork&, PointSum&);

/// Adds to what a node gets. [m2]
void add_to(Index node, const Vec3& push, bool of_apex_side, PointSum&);

/// Notes which faces the apexes of a range asked for. What was found aside goes where the next step begins from, unless an apex asked for
/// what is there. Range after range, so that nothing depends on the number of threads.
void end_range(PointSum&, PointWork&);

}  // namespace nereid::contact
