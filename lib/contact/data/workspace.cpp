#include "contact/data/workspace.hpp"

#include <algorithm>

namespace nereid::contact {

Workspace::Workspace(const Interface& interface)
    : apex_near_itself(interface.apexes.size(), 0),
      facets(interface.apexes.size(), 0),
      spring_sum(Scalars::Zero(std::max<Eigen::Index>(1, static_cast<Eigen::Index>(interface.base.ring_begin.size())) - 1)),
      rotation_sum(Scalars::Zero(interface.friction.coefficient > 0 && !interface.rotation_of_node.empty() ? spring_sum.size() : 0)) {
  near_itself.assign(static_cast<std::size_t>(interface.bodies.count()), 0);
  near.reserve(interface.apexes.size());
  found.resize((interface.apexes.size() + apexes_of_a_range - 1) / apexes_of_a_range);
  for (Subset& one : found) one.reserve(static_cast<std::size_t>(facets_at_first * apexes_of_a_range));
  if (interface.heights != Heights::nodes) {
    const auto faces = static_cast<std::size_t>(interface.faces.faces.cols());
    points.of_face.resize(faces), points.used.reserve(faces), points.used_before.reserve(faces);
  }
  const Bodies& bodies = interface.bodies;
  if (bodies.count() == 0) broad.emplace_back(static_cast<Index>(interface.base.facets.cols()));
  for (Index b = 0; b < bodies.count(); ++b)
    broad.emplace_back(bodies.first_facet[b + 1] - bodies.first_facet[b], bodies.first_facet[b]);
}

EdgeWorkspace::EdgeWorkspace(const EdgeContact& contact) { near_itself.assign(static_cast<std::size_t>(contact.bodies.count()), 0); }

}  // namespace nereid::contact
