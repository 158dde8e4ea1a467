#pragma once
// Floors of inelastic impact: a node that would pass one meets it exactly and is constrained from then on.
//
// A step calls the three functions in this order: before the drift, after it, and before its second kick.

#include "load/constraints.hpp"

namespace nereid::load {

/// Gives the nodes that would pass a floor in this step the velocity with which they reach it at its end.
///
/// x [m], v [m/s] of all nodes before the drift;  force [N] at x;  mass [kg]
/// dt  [s] of the step; zero at the start, where nodes that touch a floor stop at once
void find_impacts(const Constraints&, const Scalars& mass, const Vectors& x, const Vectors& force, double dt, Vectors& v, Memory&);

/// Takes the round-off of the drift from the positions of nodes that land.
void put_on_floors(const Constraints&, const Memory&, Vectors& x);

/// Takes the velocity towards the floor from nodes that have landed; the floor constrains them from now on.
void finish_impacts(const Constraints&, const Scalars& mass, const Vectors& x, const Vectors& force, double dt, Vectors& v, Memory&);

}  // namespace nereid::load
