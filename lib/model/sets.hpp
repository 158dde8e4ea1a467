#pragma once
// Sets of a body by place: nodes, parts of its skin, elements.

#include "model/fault.hpp"
#include "model/scene.hpp"

namespace nereid::model {

/// Whether a place lies in a zone, or within `tolerance` [m] of its boundary; of a plane, within that of the plane.
bool holds(const Zone&, const Vec3& place, double tolerance);

/// Adds the sets of a body to its mesh, where it stands: node sets that are not empty, surfaces of the skin of solids whose facets have
/// all corners in a set, and of plates both of their sides, `_top` and `_bottom`.
///
/// Faults: names that are taken or that name nothing, sets without nodes and elements.
void add_sets(const Body&, mesh::Mesh&, Faults&);

/// Which elements of a region a set of the body has: those whose middle lies in its zone.
///
/// set      its name, without that of the body
/// mesh     where the body stands, alone or with others
/// nodes    [corners x elements] of the region
/// returns  [elements] 0 or 1; empty if the set has no elements, as a node set of the mesh
std::vector<char> elements_in(const Body&, const std::string& set, const mesh::Mesh&, const element::Connectivity& nodes);

/// Whether a set of that name of the body has elements.
bool has_elements(const Body&, const std::string& set);

/// The middles of elements: means of their distinct corners. [m] [3 x elements]
Vectors middles(const Vectors& X, const element::Connectivity& nodes);

}  // namespace nereid::model
