#pragma once
// Contact: what happens in a step of it, in which order, and where to read on.
//
// Two surfaces may touch. The nodes of one are apexes, the other one is the base (the field says secondary and primary surface). An
// automatic contact is one contact of the skins of many bodies. Between two solids the body with the smaller faces has the apexes, and the
// nodes of the other one are guards (below). With plates, between rigid bodies, and of a body with itself, both sides have apexes.
//
//       o---------a---------o     apex a, and the faces around it with Gauss points q. A point has the height h over its foot on the
//          q   q     q   q        base, along the normal n there. The gap g of the apex is a weighted sum of these heights, and its
//          |   |     |   |  h     rate v is a sum over the nodes of both sides:  v = sum of p_j . v_j  (pushes p_j).
//       1----f-----2----f---3     g is that sum less the contact height h_c: half the thickness of plates on each side, 0 between solids.
//
// A step of the default, contact by multipliers. dynamics::step() calls it at its end: t is the time there, dt the step that led to t, and
// dt' the step that begins at t. All other forces at t are known.
//
//     search      only after nodes may have moved by half of the search margin: lists which apexes and facets, and which edges, are
//                 near each other. A declared contact asks in `track` and `edges` whether a search is due       search/
//     predict     velocities in dt' and positions at its end if nothing touched; then impulses of ties multiplier/predict.hpp, tie.hpp
//     track       the facets that each near apex touches at its predicted position; an apex slides from facet to facet   tracking/
//     conditions  for each apex that may touch: gap g, points q and pushes p_j, with positions at t    multiplier/assemble.hpp
//     edges       the same where an edge is over an edge                                               multiplier/crossing.hpp
//     solve       one impulse J >= 0 for each condition: the smallest after which v (in dt') >= min(-g/dt', -(v in dt)), with g/5 for
//                 g < 0. So a gap just closes, and no apex leaves faster than it came, but for energy held. Friction adds one J_t
//                 for each apex, |J_t| <= mu J. The first guess is the impulses of the step before, or their trend. All impulses
//                 change at once in each iteration, so their order does not matter                     multiplier/solve.hpp
//                 Where these impulses stop a layer of elements that would ring too much, dt' is made shorter and all is found again
//     release     the memory keeps for each apex the energy that its impulses took (Restitution::held). When the apex is no longer
//                 pressed, or its force has fallen by half to less than that energy presses, one more impulse returns e^2 of it; e is
//                 `restitution`, 1 by default. Rigid bodies give back all apexes of a blow together, blow.hpp  multiplier/restitution.hpp
//     book        J / h, h = (dt + dt')/2, is the force at t: it acts in the last half of dt and the first half of dt'. Works and
//                 momenta                                                                              multiplier/book.hpp
//
// enforce() in multiplier/enforce.hpp does all of this. There is no stiffness, and nothing is pressed in first. An impulse acts along the
// gradient of the gap, so momentum and angular momentum are kept.
//
// The elements of Kulak & Fiala. An apex over a facet is their tetrahedral element, over an edge the triangular one, over a vertex the line
// element; docs/paper.md says where each acts. The walk from base to base is tracking/tracking.hpp and surface/stand.hpp. Between solids
// (`heights: points`, tracking/points.hpp) each point q is the apex of one element, and a condition adds up those around a node. Nodes of
// the base are guards: a guard has a condition only where it would be deeper than its allowance, about 0.01 of a face. With
// `heights: nodes`, on plates, ridges and corners, the apex of an element is a node (multiplier/over_facet.hpp).
//
// Other kinds of contact:
//
//     a penalty      a spring of 1/delta per area, shortest exit d, energy 1/2 k |d|^2: tracking/shortest_exit.hpp, penalty/advance.hpp.
//                    Nothing is predicted or solved; friction has an elastic stick; the spring may shorten the time step
//     a tie          an apex stays over its point of the base, pulled as well as pushed, or slides at its height: multiplier/tie.hpp, or
//                    by a penalty. By multipliers a solver of its own finds the impulses of all ties: before contact, and again after
//                    each iteration if contact acts on nodes of ties
//     a rigid plane  nodes over a plane that stands still, by multipliers (default, multiplier/assemble.hpp) or by a penalty
//                    (penalty/rigid_plane.hpp). Floors and symmetry planes are constraints and no contact: load/constraints.hpp
//     a shape        a round rigid body that touches as a shape, not by its facets: data/shape.hpp, multiplier/shape_points.hpp
//     edges          an edge over an edge, where no node is inside; by multipliers beside a penalty too: tracking/edge_over_edge.hpp
//
// Each has constant data (data/interface.hpp), a memory, which checkpoints save (data/memory.hpp), and a workspace, which they do not
// (data/workspace.hpp, multiplier/condition.hpp). Of a near apex the memory has its facets, each with h_c less the overlap at entry, the
// normal and friction force of the last step, whether it stuck, and the energy held; of a contact also the positions at the last search.
//
// lib/dynamics calls:
//
//     connect()        at the start: first features, contact heights, initial gaps                     connect.hpp
//     advance()        springs of penalties, with stable_step()                                        penalty/advance.hpp
//     stop_at_start()  takes the velocities that would close gaps in the first step                     multiplier/enforce.hpp
//     enforce()        all contacts by multipliers together                                            multiplier/enforce.hpp
//     add_forces()     forces at the nodes                                                             report/forces.hpp
//     post()           work and stored energy into the ledger                                          report/account.hpp
//     update_pair_records()  which bodies have touched                                                 data/pair_records.hpp

#include "contact/connect.hpp"
#include "contact/data/any.hpp"
#include "contact/data/pair_records.hpp"
#include "contact/multiplier/enforce.hpp"
#include "contact/penalty/advance.hpp"
#include "contact/report/account.hpp"
#include "contact/report/forces.hpp"
#include "contact/report/view.hpp"
#include "contact/tracking/thickness.hpp"
