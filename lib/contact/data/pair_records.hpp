#pragma once
// Which sides of a contact have touched, when, and what they have handed to each other.

#include "contact/data/memory.hpp"

namespace nereid::contact {

/// Room for the pair_records of an interface, so that a step takes no memory before many pairs have met.
void make_room_for_pair_records(const Sides&, SidesMemory&);

/// Sees who touches at time t [s], and adds up the impulses of the step of length dt [s] that led there, by the trapezoid rule.
///
/// Of a tie nothing is seen: its sides never part.
void update_pair_records(const Interface&, double dt, double t, Memory&);
void update_pair_records(const EdgeContact&, double dt, double t, EdgeMemory&);

/// Books an impulse [N s] on the first of two nodes that stopped at the start what two bodies of an automatic contact did.
void record_at_start(const Sides&, Index node, Index other_node, const Vec3& impulse, double t, SidesMemory&);

}  // namespace nereid::contact
