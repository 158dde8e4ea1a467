#pragma once
// The forces of contact on the nodes.

#include <vector>

#include "contact/data/memory.hpp"

namespace nereid::contact {

/// Adds the forces of all elements to the nodes [N], and their moments to plate nodes [N m], apex by apex.
void add_forces(const Interface&, const Memory&, Vectors& force, Vectors& moment);
void add_forces(const EdgeContact&, const EdgeMemory&, Vectors& force, Vectors& moment);

/// What contact does to a node. [N]
struct NodeForce {
  Index node = -1;
  Vec3 push = Vec3::Zero(), friction = Vec3::Zero();
};

/// Adds the forces on nodes to a list, element after element: a node is there as often as elements act on it. Moments are left out.
void list_forces(const Interface&, const Memory&, std::vector<NodeForce>&);
void list_forces(const EdgeContact&, const EdgeMemory&, std::vector<NodeForce>&);

}  // namespace nereid::contact
