#include "contact/near.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "contact/crossing.hpp"

namespace nereid::contact {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The largest squared way of nodes from where they were, less a common way; adds up the ways. [m2]
double farthest_moved(const Subset& nodes, const Vectors& x, const Vectors& then, const Vec3& common, Vec3& sum) {
  double most = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3 way = x.col(nodes[i]) - then.col(static_cast<Eigen::Index>(i));
    sum += way;
    most = std::max(most, (way - common).squaredNorm());
  }
  return most;
}

void keep_positions(const Subset& nodes, const Vectors& x, Vectors& then) {
  for (std::size_t i = 0; i < nodes.size(); ++i) then.col(static_cast<Eigen::Index>(i)) = x.col(nodes[i]);
}

/// Leaves an apex alone until a search finds it near its base again.
void unpair(Index a, Memory& memory) {
  memory.feature[a].facet = -1;
  memory.status[a] = Status::unpaired;
  memory.gap[a] = std::numeric_limits<double>::quiet_NaN();
  memory.slot[a] = -1;
}

}  // namespace

Nearest nearest_of(const Interface& interface, const Vectors& x, Index a, std::span<const Index> facets) {
  Nearest best;
  const Vector<double> p = position(x, interface.apexes[a]);
  for (const Index f : facets) {
    const geometry::Closest there = geometry::closest_on_triangle(corners(interface.base, x, f), p);
    if (there.distance_squared < best.closest.distance_squared) best.feature = {f, there.kind, there.local}, best.closest = there;
    best.clear = std::min(best.clear, std::sqrt(there.distance_squared) - whole_past_wall * interface.base.size(f));
  }
  return best;
}

double moved_since_search(const Interface& interface, const Vectors& x, Memory& memory) {
  if (interface.base_nodes.empty()) return 0;
  const Vec3 first = x.col(interface.base_nodes[0]) - memory.base_then.col(0), common = first + memory.mean_way;
  Vec3 of_apexes = Vec3::Zero(), of_base = Vec3::Zero();
  const double apexes = farthest_moved(interface.apexes, x, memory.apexes_then, common, of_apexes);
  const double base = farthest_moved(interface.base_nodes, x, memory.base_then, common, of_base);
  memory.mean_way = of_base / static_cast<double>(interface.base_nodes.size()) - first;
  return std::sqrt(apexes) + std::sqrt(base);
}

double margin_of(const Interface& interface, const Vectors& v) {
  Vec3 common = Vec3::Zero();
  for (const Index node : interface.base_nodes) common += v.col(node) / static_cast<double>(interface.base_nodes.size());
  double apexes = 0, base = 0;
  for (const Index node : interface.apexes) apexes = std::max(apexes, (v.col(node) - common).squaredNorm());
  for (const Index node : interface.base_nodes) base = std::max(base, (v.col(node) - common).squaredNorm());
  const double way = 4 * steps_ahead * interface.longest_step * (std::sqrt(apexes) + std::sqrt(base));
  return std::max(interface.margin, std::isfinite(way) ? way : 0.0);
}

void keep_search(const Interface& interface, const Vectors& x, Memory& memory) {
  keep_positions(interface.apexes, x, memory.apexes_then);
  keep_positions(interface.base_nodes, x, memory.base_then);
  memory.mean_way.setZero();
  ++memory.searches;
}

void search(const Interface& interface, const Vectors& x, Memory& memory, Workspace& workspace) {
  if (!workspace.broad.sort(interface.base, x)) return;
  keep_search(interface, x, memory);
  const auto count = static_cast<Index>(interface.apexes.size());
  const auto visit_near = [&](Index a, auto&& visit) {
    const double reach = contact_height(interface, memory, a) + memory.margin;
    workspace.broad.within(interface.base, x, position(x, interface.apexes[a]), reach, [&](Index facet, double) { visit(facet); });
  };
  parallel_for(count, 64, [&](Index a) {
    Index found = 0;
    visit_near(a, [&](Index) { ++found; });
    workspace.facets[a] = found;
  });
  workspace.near.clear();
  Index facets = 0;
  for (Index a = 0; a < count; ++a) {
    const Near* was = near(memory, a);
    if (workspace.facets[a] == 0 && !(was && was->tracks.count > 0)) {
      if (was) unpair(a, memory);
      continue;
    }
    if (was) workspace.near.push_back(*was);
    else workspace.near.push_back({.apex = a, .tracks = {}, .friction = {}, .element = {}});
    if (memory.status[a] == Status::unpaired) memory.status[a] = Status::open, ++memory.recovered;
    Near& now = workspace.near.back();
    now.first_facet = facets;
    now.facets = workspace.facets[a];
    now.clear = now.tracks.owned = -infinite;
    now.rests = false;
    facets += now.facets;
    memory.slot[a] = static_cast<Index>(workspace.near.size()) - 1;
  }
  std::swap(memory.near, workspace.near);
  memory.near_facets.resize(facets);
  parallel_for(static_cast<Index>(memory.near.size()), 64, [&](Index i) {
    const Near& one = memory.near[i];
    Index at = one.first_facet;
    visit_near(one.apex, [&](Index facet) { memory.near_facets[at++] = facet; });
    std::sort(memory.near_facets.begin() + one.first_facet, memory.near_facets.begin() + at);
  });
}

double search_where_due(const Interface& interface, const Vectors& x, const Vectors& v, Memory& memory, Workspace& workspace) {
  const double moved = memory.searches == 0 ? infinite : moved_since_search(interface, x, memory);
  if (!(moved > 0.5 * memory.margin)) return moved;
  memory.margin = margin_of(interface, v);
  if (interface.kind == InterfaceKind::edges) search_crossings(interface, x, memory, workspace);
  else search(interface, x, memory, workspace);
  return 0;
}

}  // namespace nereid::contact
