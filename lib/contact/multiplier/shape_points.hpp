#pragma once
// Points of contact of round shapes: where they are, their conditions, and what they do. shape.hpp

#include "contact/data/initial_gaps.hpp"
#include "contact/data/shape.hpp"
#include "contact/multiplier/condition.hpp"

namespace nereid::contact {

/// Where a shape stands over a feature.
struct Spot {
  Index part = 0;
  double gap = 0;                  ///< [m]
  Vec3 normal = Vec3::UnitZ();     ///< unit vector, out of the shape
  Vec3 place = Vec3::Zero();       ///< [m]
  std::array<double, 3> weight{};  ///< of the nodes of the feature
};

/// Where a shape is closest to a segment between two points: inside of both ends, where its distance has a minimum along the segment, and
/// where the segment passes over the rims of the shape's ends. Parts are numbered by kind, minima one after the other.
void spots_on_edge(const geometry::Round&, const geometry::PlacedRound&, const std::array<Vec3, 2>& end, std::vector<Spot>&);

/// Where a shape is closest to a flat facet, within it: a sphere at the foot of its centre, other shapes with points of their rims, those
/// that are deepest, and, where an end of the shape lies nearly flat on the facet, so many around each rim.
///
/// whole  the plane of the facet counts, and not only what is within it
void spots_on_facet(const geometry::Round&, const geometry::PlacedRound&, const std::array<Vec3, 3>& corner, bool is_plate, bool whole,
                    std::vector<Spot>&);

/// Where two shapes are closest. Normals lead out of the first.
void spots_between(const geometry::Round&, const geometry::PlacedRound&, const geometry::Round&, const geometry::PlacedRound&,
                   std::vector<Spot>&);

/// Where a shape is closest to a plane with a normal. Plates touch it with their mid-surface.
void spots_on_plane(const geometry::Round&, const geometry::PlacedRound&, const Vec3& point, const Vec3& normal, std::vector<Spot>&);

constexpr int points_of_rim = 12;  ///< where an end lies flat
/// Of the points of a rim: minima of a distance come first, then the deepest over a plane, then those all around.
constexpr int parts_of_rim = 32, first_sample = 16;

/// Finds the conditions of all shapes of a contact, with the impulses of the step before as a first guess.
///
/// Needs  look_ahead() for the nodes
void find_shape_conditions(const Interface&, const Motion&, Memory&, Multipliers&);
/// The same of shapes over a rigid plane.
void find_shape_conditions(const RigidPlane&, const Motion&, PlaneMemory&, Multipliers&);

/// Books the first half of the step that led to t, in which the forces of the memory have acted.
void book_first_half_of_shapes(const Motion&, Memory&);
void book_first_half_of_shapes(const Motion&, PlaneMemory&);

/// Writes the impulses of contactors, the last of which are those of the shapes, into the memory as forces over the time h [s]; t [s] now.
void take_over_shapes(const Interface&, double h, double t, Index last, const Multipliers&, Memory&);
void take_over_shapes(const RigidPlane&, const Motion&, double h, double t, Index last, const Multipliers&, PlaneMemory&);

/// The least gap of all points at x; NaN without any. [m]
double least_gap_of_shapes(const Interface&, const Vectors& x, const Memory&);

/// What shapes find at the start: adds to the gaps of a contact, and keeps slight overlaps, and those that are accepted, as offsets.
void add_gaps_of_shapes(const Interface&, const Vectors& x, bool accepts, Memory&, InitialGaps&);

}  // namespace nereid::contact
