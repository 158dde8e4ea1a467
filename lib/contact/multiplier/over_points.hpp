#pragma once
// The condition of an apex over points of the faces around it.

#include "contact/multiplier/condition.hpp"
#include "contact/tracking/points.hpp"

namespace nereid::contact {

/// How an apex stands over the plane of a facet.
struct OverPlane {
  Index facet;
  FeatureHeight over;
  double least_gap;  ///< [m] no more than the gap over the bilinear face that the facet is half of
};
OverPlane over_plane(const Interface&, const Vectors& x, Index apex, Index facet, double level);

/// No more than allowance(). [m]
double least_allowance(const Interface&, Index apex, Index facet);

/// Moves the one track and stencil of an apex to the facet that it is over now.
void move_to(const OverPlane&, Near&);

/// Whether a guard acts: where it would be deeper than it may be, in this step or soon. Others would slow the iterations down.
bool guard_acts(const Interface&, const Motion&, const Near&, Index facet, const Multipliers&, const ConditionList&, Condition&);

/// Moves an apex whose points are known alone to the facet that it is over now.
void follow_facet(const Interface&, const Vectors& x, Memory&, Near&);

/// Finds the condition of a stencil over points of the faces around the apex, or by the apex itself where none of them lies on the base;
/// false if there is none. Friction has the foot of the apex in any case.
bool find_over_points(const Interface&, const Motion&, const Memory&, Near&, int s, Moved, const PointWork&, FoundInRange&,
                      const Multipliers&, Condition&);

}  // namespace nereid::contact
