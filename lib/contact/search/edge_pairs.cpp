#include "contact/search/edge_pairs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include "contact/search/near.hpp"
#include "contact/search/partners.hpp"
#include "geometry/crossing.hpp"

namespace nereid::contact {

namespace {

constexpr double curved = 0.9962;  // cosine of 5 degrees: edges of plates that turn by more are those of a curved sheet

/// Whether an edge is one of a curved sheet. Elements that are much longer than thick leave a large part of the thickness open there.
bool is_curved(const Edges& edges, const Vectors& x, Index edge) {
  if (!of_plates(edges, edge) || edges.across(1, edge) < 0) return false;
  const Vec3 first = into(edges, x, edge, 0), second = into(edges, x, edge, 1);
  return first.dot(second) > -curved * first.norm() * second.norm();
}

/// Lists the edges from `first` to `last` with a box around each that reaches into a box.
void list_boxes(const Edges& edges, const Vectors& x, Index first, Index last, double reach, const Eigen::AlignedBox3d& within,
                std::vector<EdgeBox>& boxes) {
  boxes.clear();
  const Vec3 beside = Vec3::Constant(reach);
  for (Index e = first; e < last; ++e) {
    const Vec3 a = node_of(edges, x, 0, e), b = node_of(edges, x, 1, e), low = a.cwiseMin(b) - beside, high = a.cwiseMax(b) + beside;
    const auto can_be_searched = [](const Vec3& place) { return (place.array().abs() <= farthest_place).all(); };
    if (!can_be_searched(a) || !can_be_searched(b)) continue;  // the elements say so, and the run ends
    if (!within.intersects(Eigen::AlignedBox3d(low, high))) continue;
    boxes.push_back({e, is_ridge(edges, x, e), low, high});
  }
}

/// The box around all edges from `first` to `last`, and so far beside them.
Eigen::AlignedBox3d box_of(const Edges& edges, const Vectors& x, Index first, Index last, double reach) {
  Eigen::AlignedBox3d all;
  for (Index e = first; e < last; ++e) all.extend(node_of(edges, x, 0, e)), all.extend(node_of(edges, x, 1, e));
  if (!all.isEmpty()) all.min().array() -= reach, all.max().array() += reach;
  return all;
}

bool meet(const EdgeBox& one, const EdgeBox& other) {
  return (one.low.array() <= other.high.array()).all() && (other.low.array() <= one.high.array()).all();
}

/// Whether two edges of an automatic contact may touch: of bodies that do, each pair once, and not beside each other in the mesh.
bool can_cross(const EdgeContact& contact, Index edge, Index base_edge) {
  const Bodies& bodies = contact.bodies;
  if (bodies.count() == 0) return true;
  if (base_edge <= edge) return false;
  const Index one = contact.edges.body[edge], other = contact.base_edges.body[base_edge];
  if (bodies.touch[bodies.pair(one, other)] == 0) return false;
  if (one != other) return true;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (is_beside(contact.beside, contact.edges.nodes(i, edge), contact.base_edges.nodes(j, base_edge))) return false;
  return true;
}

/// Edges from `first` to `last`, of one body or of one side of a contact.
struct EdgeRange {
  Index first, last;
};

/// Lists the pairs of edges of two ranges that are nearer than `reach` to h_c; returns whether any is nearer than `asked`.
bool list_pairs(const EdgeContact& contact, const Vectors& x, EdgeRange of_edges, EdgeRange of_base, double reach, double asked,
                EdgeWorkspace& workspace) {
  std::vector<EdgeBox>&edges = workspace.edges, &base = workspace.base_edges, &ridges = workspace.base_ridges;
  const Eigen::AlignedBox3d around = box_of(contact.edges, x, of_edges.first, of_edges.last, 0.5 * asked);
  const Eigen::AlignedBox3d base_around = box_of(contact.base_edges, x, of_base.first, of_base.last, 0.5 * asked);
  list_boxes(contact.edges, x, of_edges.first, of_edges.last, 0.5 * asked, base_around, edges);
  list_boxes(contact.base_edges, x, of_base.first, of_base.last, 0.5 * asked, around, base);
  if (edges.empty() || base.empty()) return false;
  std::sort(base.begin(), base.end(),
            [](const EdgeBox& a, const EdgeBox& b) { return std::tie(a.low.x(), a.edge) < std::tie(b.low.x(), b.edge); });
  double widest = 0;
  for (const EdgeBox& box : base) widest = std::max(widest, box.high.x() - box.low.x());
  ridges.clear();
  std::copy_if(base.begin(), base.end(), std::back_inserter(ridges),
               [&](const EdgeBox& box) { return box.ridge || is_curved(contact.base_edges, x, box.edge); });
  bool is_near = false;
  for (const EdgeBox& one : edges) {
    const auto low = [](const EdgeBox& box, double value) { return box.low.x() < value; };
    const std::vector<EdgeBox>& others = one.ridge ? base : ridges;
    const bool only_ridges = !one.ridge && !is_curved(contact.edges, x, one.edge);
    for (auto other = std::lower_bound(others.begin(), others.end(), one.low.x() - widest, low); other != others.end(); ++other) {
      if (other->low.x() > one.high.x()) break;
      if ((only_ridges && !other->ridge) || !meet(one, *other) || !can_cross(contact, one.edge, other->edge)) continue;
      const auto p = ends_of(contact, x, one.edge, other->edge);
      const double squared = geometry::segments_squared(p[0], p[1], p[2], p[3]);
      if (!(squared < asked * asked)) continue;
      is_near = true;
      if (!(squared < reach * reach)) continue;
      workspace.edge_pairs.push_back({one.edge, other->edge, !one.ridge || !other->ridge,
                                      std::sqrt(squared) - height_between(contact, one.edge, other->edge)});
    }
  }
  return is_near;
}

/// The edges of a body of an automatic contact, which lie together.
EdgeRange edges_of(const Edges& edges, Index body) {
  const auto [first, last] = std::equal_range(edges.body.begin(), edges.body.end(), body);
  return {static_cast<Index>(first - edges.body.begin()), static_cast<Index>(last - edges.body.begin())};
}

}  // namespace

void search(const EdgeContact& contact, const Vectors& x, EdgeMemory& memory, EdgeWorkspace& workspace) {
  keep_search(contact, x, memory);
  const Index bodies = contact.bodies.count();
  std::fill(workspace.near_itself.begin(), workspace.near_itself.end(), char{0});
  const double thickest = contact.edges.half.size() > 0 ? contact.edges.half.maxCoeff() + contact.base_edges.half.maxCoeff() : 0;
  const double reach = contact.height + thickest + memory.margin;
  std::vector<EdgePair>& next = workspace.edge_pairs;
  next.clear();
  if (bodies == 0) {
    const auto all = [](const Edges& edges) { return EdgeRange{0, static_cast<Index>(edges.nodes.cols())}; };
    list_pairs(contact, x, all(contact.edges), all(contact.base_edges), reach, reach, workspace);
  } else {
    find_partners(contact, x, memory, workspace);
    for (Index a = 0; a < bodies; ++a)
      for (Index i = workspace.first_partner[a]; i < workspace.first_partner[a + 1]; ++i) {
        const Index b = workspace.partners[i];
        if (b < a) continue;
        const double asked = a == b ? reach + farther_from_itself * memory.margin : reach;
        const EdgeRange one = edges_of(contact.edges, a), other = edges_of(contact.base_edges, b);
        const bool is_near = list_pairs(contact, x, one, other, reach, asked, workspace);
        if (a == b) workspace.near_itself[static_cast<std::size_t>(a)] = is_near;
      }
  }
  const bool one_pair = bodies == 0;
  if (!one_pair) keep_apart_from_itself(contact, x, false, workspace, memory);
  std::sort(next.begin(), next.end(), in_order);
  std::swap(memory.edge_pairs, next);
  const auto is_gone = [&](Crossing& was) {
    const auto at = std::lower_bound(memory.edge_pairs.begin(), memory.edge_pairs.end(), was, in_order);
    const bool is_there = at != memory.edge_pairs.end() && !in_order(was, *at);
    if (is_there) was.in_face = at->in_face;
    else discard(was.restitution, memory.impact);
    return !is_there;
  };
  const std::size_t many = std::min<std::size_t>(memory.edge_pairs.size(), 256);  // so that a step takes no memory
  memory.crossings.reserve(many), workspace.crossings.reserve(many), workspace.over.reserve(many);
  memory.crossings.erase(std::remove_if(memory.crossings.begin(), memory.crossings.end(), is_gone), memory.crossings.end());
}

void keep_active(const EdgeContact& contact, EdgeMemory& memory) {
  memory.active.assign(static_cast<std::size_t>(contact.bodies.count()), 0);
  for (const EdgePair& pair : memory.edge_pairs) {
    memory.active[static_cast<std::size_t>(contact.edges.body[pair.edge])] = 1;
    memory.active[static_cast<std::size_t>(contact.base_edges.body[pair.base_edge])] = 1;
  }
}

}  // namespace nereid::contact
