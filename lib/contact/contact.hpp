#pragma once
// Contact: what happens in a step of it, in which order, and where to read on.
//
// Two surfaces may touch. The nodes of one are apexes, the other one is the base (the field says secondary and primary surface). An
// automatic contact is one contact of the skins of many bodies; in each pair of bodies one has the apexes.
//
//       o---------a---------o     apex a, and the faces around it with points q. A point stands h over its foot on the base, along
//          q   q     q   q        the normal n there. The gap g of the apex is a sum of the heights h with constant weights, and its
//          |   |     |   |  h     rate v is a sum over the nodes of both sides:  v = sum of p_j . v_j  (pushes p_j).
//       1----f-----2----f---3
//
// A step of the default, contact by multipliers, at time t. All other forces at t are known.
//
//     search      bodies that have moved far enough: which apexes and facets, and which edges, are near each other        search/
//     predict     velocities and positions at t + dt if nothing touched                                multiplier/predict.hpp
//     track       the facets that each near apex is in contact with there: it goes from facet to facet as it slides      tracking/
//     conditions  for each apex its gap g at t, and pushes p_j on the nodes                            multiplier/assemble.hpp
//     edges       the same where an edge is over an edge                                               multiplier/crossing.hpp
//     solve       the smallest impulses J >= 0 after which v >= -g/dt, v >= -(v before); friction |J_t| <= mu J. All impulses
//                 change at once in each iteration, so their order does not matter                     multiplier/solve.hpp
//     release     what stopped bodies have stored in the contact is given back as they separate        multiplier/restitution.hpp
//     book        J over the time of a step becomes the force of the contact; works and momenta        multiplier/book.hpp
//
// enforce() in multiplier/enforce.hpp does all of this. There is no stiffness, and nothing is pressed in first. An impulse acts along the
// gradient of the gap, so momentum and angular momentum are kept.
//
// The elements of Kulak & Fiala. An apex over a facet is their tetrahedral element, over an edge the triangular one, over a vertex the line
// element; docs/paper.md says where each acts. The walk from base to base is tracking/tracking.hpp and surface/stand.hpp. Between solids
// (`heights: points`, tracking/points.hpp) the apexes of the elements are the points q of faces; nodes of the base guard: they act where
// they would be too deep. With `heights: nodes` the apexes are the nodes (multiplier/over_facet.hpp), as on plates, ridges and corners.
//
// Other kinds of contact:
//
//     a penalty      a spring of 1/delta per area, shortest exit d, energy 1/2 k |d|^2: tracking/shortest_exit.hpp, penalty/advance.hpp
//     a tie          an apex stays over its point of the base: multiplier/tie.hpp, or by a penalty
//     a rigid plane  nodes over a plane that stands still: penalty/rigid_plane.hpp
//     edges          an edge over an edge, where no node is inside: tracking/edge_over_edge.hpp
//
// Each has what is constant (data/interface.hpp), what it remembers (data/memory.hpp: checkpoints have it), and what it works with in a
// step (data/workspace.hpp, multiplier/condition.hpp).
//
// lib/dynamics calls:
//
//     connect()        at the start: first features, contact heights, initial gaps                     connect.hpp
//     advance()        springs of penalties, with stable_step()                                        penalty/advance.hpp
//     enforce()        all contacts by multipliers together                                            multiplier/enforce.hpp
//     add_forces()     forces at the nodes                                                             report/forces.hpp
//     post()           work and stored energy into the ledger                                          report/account.hpp
//     update_pair_records()   which bodies have touched                                                       data/pair_records.hpp

#include "contact/connect.hpp"
#include "contact/data/any.hpp"
#include "contact/data/pair_records.hpp"
#include "contact/multiplier/enforce.hpp"
#include "contact/penalty/advance.hpp"
#include "contact/report/account.hpp"
#include "contact/report/forces.hpp"
#include "contact/report/view.hpp"
#include "contact/tracking/thickness.hpp"
