#include "contact/search/partners.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace nereid::contact {

namespace {

/// By how much two nodes of a body can have come nearer since it was last searched: the diagonal of the box around the displacements of all
/// from where a rigid motion of the body would have them, of that motion which fits all nodes best (Kabsch 1976). [m]
double change_of_shape(const Bodies& bodies, const Vectors& x, const SidesMemory& memory, Index body) {
  const Index first = bodies.first_node[body], last = bodies.first_node[body + 1];
  Vec3 now = Vec3::Zero(), then = Vec3::Zero();
  for (Index i = first; i < last; ++i) now += x.col(bodies.nodes[i]), then += memory.apart_then.col(i);
  now /= last - first, then /= last - first;
  Mat3 together = Mat3::Zero();
  for (Index i = first; i < last; ++i) together += (x.col(bodies.nodes[i]) - now) * (memory.apart_then.col(i) - then).transpose();
  if (!together.allFinite()) return infinite;
  const Eigen::JacobiSVD<Mat3> parts(together, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 hand = Vec3::Ones();
  hand.z() = (parts.matrixU() * parts.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Mat3 turn = parts.matrixU() * hand.asDiagonal() * parts.matrixV().transpose();
  Vec3 least = Vec3::Constant(infinite), most = -least;
  for (Index i = first; i < last; ++i) {
    const Vec3 rest = x.col(bodies.nodes[i]) - now - turn * (memory.apart_then.col(i) - then);
    least = least.cwiseMin(rest), most = most.cwiseMax(rest);
  }
  return (most - least).norm();
}

/// Whether a body may have come near to itself since it was last searched.
bool may_be_near_itself(const Bodies& bodies, const Vectors& x, const SidesMemory& memory, Index body) {
  const double apart = memory.apart_from_itself[static_cast<std::size_t>(body)];
  return !(apart > 0) || !(change_of_shape(bodies, x, memory, body) <= apart - memory.margin);
}

}  // namespace

void find_partners(const Sides& sides, const Vectors& x, const SidesMemory& memory, SearchWork& workspace) {
  const Bodies& bodies = sides.bodies;
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

bool searches_itself(const SearchWork& workspace, Index body) {
  const auto partners = workspace.partners.begin();
  return std::binary_search(partners + workspace.first_partner[body], partners + workspace.first_partner[body + 1], body);
}

void keep_apart_from_itself(const Sides& sides, const Vectors& x, bool may_thicken, const SearchWork& workspace, SidesMemory& memory) {
  const Bodies& bodies = sides.bodies;
  for (Index b = 0; b < bodies.count(); ++b) {
    if (!searches_itself(workspace, b)) continue;
    const bool near = may_thicken || workspace.near_itself[static_cast<std::size_t>(b)] != 0;
    memory.apart_from_itself[static_cast<std::size_t>(b)] = near ? 0 : (1 + farther_from_itself) * memory.margin;
    for (Index i = bodies.first_node[b]; i < bodies.first_node[b + 1]; ++i) memory.apart_then.col(i) = x.col(bodies.nodes[i]);
  }
}

}  // namespace nereid::contact
