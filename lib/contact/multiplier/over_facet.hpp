#pragma once
// The condition of an apex over one feature of its base: the paper's elements.

#include <array>

#include "contact/multiplier/condition.hpp"

namespace nereid::contact {

/// The gap up to which nodes that go such a way against each other in the step to come, in m, count in it. [m]
double reach_of(const Between&, double way);

/// Whether a gap is so small, or closes so fast, that it counts in the step to come.
///
/// speed  [m/s] of the nodes against each other
bool can_touch(const Between&, const Motion&, double gap, double speed);

/// Whether a normal leads into the surface of the apex, and another one less: as that of a bevel where a flat surface touches the sole of a
/// body, and never its bevel.
bool leads_farther_in(const Interface&, const Vectors& x, Index apex, const Vec3& normal, const Vec3& other);

/// Nodes, weights, normal and gap of an apex over the feature of a stencil where the nodes are at t; false if it is out of reach.
///
/// A stencil with a push was found where the nodes would be: it counts however far the apex is now, and the push has the direction.
bool make(const Interface&, const Motion&, const Memory&, const Near&, Stencil&, bool& has_moment, const Multipliers&, ConditionList&,
          Condition&);

/// Where an apex is just on a ridge or a corner and its sides push it alike, makes one stencil of theirs: to press on one side, and on
/// another, would turn a blow aside, and what was held could not be given back along the way it was taken.
void join_on_ridge(const BaseSurface&, const Vectors& x, const Vec3& p, ElementForces&);

/// Whether a stencil before this one has the other half of its face: both are one bilinear surface.
bool is_same_face(const BaseSurface&, const ElementForces&, int s);

/// Where the apexes stand that come next in the list of near ones and stay over one bilinear face each.
struct Ahead {
  int count = 0, next = 0;
  std::array<bool, lanes> stands;                  ///< false: this is to be found alone
  std::array<std::array<Index, lanes>, 4> corner;  ///< around the face, from the first of its cut
  alignas(64) std::array<std::array<double, lanes>, 4> weight;
  alignas(64) std::array<std::array<double, lanes>, 3> normal;
  alignas(64) std::array<double, lanes> height;
};

/// Makes the condition of a near apex as make() does, if it stays over a bilinear face. To be asked apex after apex.
///
/// last  place in Memory::near at which the range of apexes ends
bool make_ahead(const Interface&, const Vectors& x, const Memory&, Near&, Index last, Ahead&, ConditionList&, Condition&);

}  // namespace nereid::contact
