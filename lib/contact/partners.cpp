#include "contact/partners.hpp"

#include <algorithm>

namespace nereid::contact {

namespace {


/// Whether a body may have come near to itself since it was last searched.
bool may_be_near_itself(const Bodies& bodies, const Vectors& x, const Memory& memory, Index body) {
  const double apart = memory.apart_from_itself[static_cast<std::size_t>(body)];
  if (!(apart > 0)) return true;
  Vec3 least = Vec3::Constant(infinite), most = -least;
  for (Index i = bodies.first_node[body]; i < bodies.first_node[body + 1]; ++i) {
    const Vec3 way = x.col(bodies.nodes[i]) - memory.apart_then.col(i);
    least = least.cwiseMin(way), most = most.cwiseMax(way);
  }
  const double change = (most - least).norm();
  return !(change <= apart - memory.margin);
}

}  // namespace

void find_partners(const Interface& interface, const Vectors& x, const Memory& memory, Workspace& workspace) {
  const Bodies& bodies = interface.bodies;
  const Index count = bodies.count();
  workspace.boxes.resize(static_cast<std::size_t>(count));
  for (Index b = 0; b < count; ++b) {
    BodyBox& box = workspace.boxes[static_cast<std::size_t>(b)];
    box = {Vec3::Constant(infinite), Vec3::Constant(-infinite)};
    for (Index i = bodies.first_node[b]; i < bodies.first_node[b + 1]; ++i) {
      const auto node = x.col(bodies.nodes[i]);
      box.low = box.low.cwiseMin(node), box.high = box.high.cwiseMax(node);
    }
  }
  workspace.first_partner.assign(1, 0);
  workspace.partners.clear();
  for (Index a = 0; a < count; ++a) {
    for (Index b = 0; b < count; ++b) {
      if (bodies.touch[bodies.pair(a, b)] == 0) continue;
      const double reach = memory.margin + bodies.thickest(a) + bodies.thickest(b);
      const BodyBox &one = workspace.boxes[static_cast<std::size_t>(a)], &other = workspace.boxes[static_cast<std::size_t>(b)];
      const bool apart = ((one.low - other.high).array() > reach).any() || ((other.low - one.high).array() > reach).any();
      if (a == b ? may_be_near_itself(bodies, x, memory, a) : !apart) workspace.partners.push_back(b);
    }
    workspace.first_partner.push_back(static_cast<Index>(workspace.partners.size()));
  }
}

bool has_partners(const Workspace& workspace, Index body) { return workspace.first_partner[body + 1] > workspace.first_partner[body]; }

bool searches_itself(const Workspace& workspace, Index body) {
  const auto partners = workspace.partners.begin();
  return std::binary_search(partners + workspace.first_partner[body], partners + workspace.first_partner[body + 1], body);
}

void keep_apart_from_itself(const Interface& interface, const Vectors& x, const Workspace& workspace, Memory& memory) {
  const Bodies& bodies = interface.bodies;
  for (Index b = 0; b < bodies.count(); ++b) {
    if (!searches_itself(workspace, b)) continue;
    const bool near = interface.follows_thickness || workspace.near_itself[static_cast<std::size_t>(b)] != 0;
    memory.apart_from_itself[static_cast<std::size_t>(b)] = near ? 0 : (1 + farther_from_itself) * memory.margin;
    for (Index i = bodies.first_node[b]; i < bodies.first_node[b + 1]; ++i) memory.apart_then.col(i) = x.col(bodies.nodes[i]);
  }
}

}  // namespace nereid::contact
