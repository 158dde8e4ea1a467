#pragma once
// One apex in a step: what it is in contact with, and the forces that come of it.

#include <span>

#include "contact/data/memory.hpp"

namespace nereid::contact {

/// Visits the base nodes of a stencil with what they take of the push and of the stiffness.
template <class Visit>
void for_each_node(const Interface& interface, const Stencil& stencil, Visit&& visit) {
  for (int I = 0; I < 3; ++I) visit(interface.base.facets(I, stencil.facet), stencil.weight[I], stencil.share[I]);
  if (stencil.fourth != 0) visit(interface.base.half[stencil.facet].fourth, stencil.fourth, 0.0);
}

/// Visits all nodes of a stencil with the force on each. [N]
///
/// shares  Memory::shares
template <class Visit>
void for_each_force(const Interface& interface, std::span<const Share> shares, Index apex, const Stencil& stencil, Visit&& visit) {
  if (stencil.shares > 0) {
    const double size = stencil.push.norm();
    for (const Share& one : shares.subspan(static_cast<std::size_t>(stencil.first_share), static_cast<std::size_t>(stencil.shares)))
      visit(one.node, Vec3(size * one.push));
    return;
  }
  visit(interface.apexes[apex], Vec3(stencil.apex * stencil.push));
  for_each_node(interface, stencil, [&](Index node, double weight, double) { visit(node, Vec3(-weight * stencil.push)); });
}

/// How fast an apex moves against the nodes of a feature: no slower than against a foot on it. [m/s]
double speed_over(const Interface&, const Vectors& v, Index apex, const Feature&);

/// Weights of the point of a facet that is closest to an apex.
std::array<double, 3> weights_of(const Interface&, const Vectors& x, Index apex, Index facet);

/// A stencil without a push, so that the apex limits the time step, or is looked at by multipliers.
///
/// level  [m] over the feature at which the contact closes
void vote_over(const Interface&, const Vectors& x, Index apex, const Feature&, const std::array<double, 3>& weight, double level,
               ElementForces&);

/// Where the apex stands on its base, for friction.
///
/// foot  its stencil by multipliers, whose weights friction has too; else null
Touch touch_of(const Interface&, const Vectors& x, Index apex, const Feature&, const Vec3& normal, const Stencil* foot = nullptr);

/// Power of the forces of one apex and its bases, without Interface::damping_time. [W]
double power(const Interface&, std::span<const Share> shares, const Vectors& v, Index apex, const ElementForces&);

/// Moment about the origin of the normal forces of one apex, at the positions `later` [s] after x. It is computed where there can be one.
Vec3 moment(const Interface&, std::span<const Share> shares, const Vectors& x, const Vectors& v, double later, Index apex,
            const ElementForces&);

/// Sums the force on the apexes, and adds to its impulse that of the step dt [s] that led here.
void sum_force(double dt, Memory&);

/// Stiffness of an apex over a feature: penalty times the chosen area. [N/m]
///
/// area  [m2] tributary, of the sides that are in contact
double stiffness(const Interface&, Index apex, const Feature&, double area);

/// Pulls or pushes a tied apex back over its point of the base.
///
/// With d = x_apex - sum of w_I x_I - h n the potential is 1/2 k d.d, and with G_I the gradients of the
/// facet's shape functions  dn = - sum of (n . dx_I) G_I,  so the forces are exactly its gradient:
///     apex  -k d,     base nodes  k (w_I d - h (d . G_I) n), the second part a couple
void hold_tie(const Interface&, const Vectors& x, Near&, Memory&);

/// Finds what one apex is in contact with at x, or near to, and what its penalty is there; nothing is booked.
///
/// v   [m/s] constant over the step dt [s] that led to x
void find_contact(const Interface&, const Vectors& x, const Vectors& v, double dt, Moved moved, Near&, Memory&);

}  // namespace nereid::contact
