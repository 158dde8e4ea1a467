#include "contact/search/near.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "contact/search/partners.hpp"
#include "contact/search/shapes.hpp"
#include "contact/surface/nearer.hpp"
#include "contact/surface/stand.hpp"
#include "geometry/height.hpp"

namespace nereid::contact {

namespace {

/// Cosine between the normals of an apex and a facet of one solid: with a larger one they are taken not to come to face each other before
/// the next search, for which they would turn by 30 degrees and more. It leaves next to nothing of a body that does not fold.
constexpr double looks_away = 0.5;

constexpr int looks_of_a_search = 256;  // after so many a search costs less than it spares
constexpr double noticeable = 0.001;   // of the margin: with less way it spares nothing

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
  if (!memory.restitution.empty()) discard(memory.restitution[a], memory.impact);
  memory.feature[a].facet = -1;
  memory.status[a] = Status::unpaired;
  memory.gap[a] = std::numeric_limits<double>::quiet_NaN();
  memory.slot[a] = -1;
}

}  // namespace

Nearest nearest_of(const Interface& interface, const Vectors& x, Index a, std::span<const Index> facets, Index body) {
  Nearest best;
  const Vector<double> p = position(x, interface.apexes[a]);
  for (const Index f : facets) {
    if (body >= 0 && interface.bodies.of_facet[f] != body) continue;
    const auto corner = corners(interface.base, x, f);
    if (is_sheet(interface.base, f) && geometry::facet_height(corner, p).height < 0) continue;  // its other side is as near
    const geometry::Closest there = geometry::closest_on_triangle(corner, p);
    const double distance = std::sqrt(there.distance_squared), gap = distance - stand_off(interface.base, f);
    if (is_nearer(interface.base, x, p, f, gap, best.feature.facet, best.gap))
      best.feature = {f, there.kind, there.local}, best.closest = there, best.gap = gap;
    const double past_border = there.kind == geometry::Kind::facet ? 0 : whole_past_wall * interface.base.size(f);
    const double reaches = past_border + stand_off(interface.base, f);
    best.safe_distance = std::min(best.safe_distance, distance - reaches);
  }
  return best;
}

double moved_since_search(const Sides& sides, const Vectors& x, SidesMemory& memory) {
  if (sides.base_nodes.empty()) return 0;
  const Vec3 first = x.col(sides.base_nodes[0]) - memory.base_then.col(0), common = first + memory.mean_way;
  Vec3 of_apexes = Vec3::Zero(), of_base = Vec3::Zero();
  const double base = farthest_moved(sides.base_nodes, x, memory.base_then, common, of_base);
  const bool same = sides.bodies.count() > 0;  // all are apexes and base
  const double apexes = same ? base : farthest_moved(sides.apexes, x, memory.apexes_then, common, of_apexes);
  memory.mean_way = of_base / static_cast<double>(sides.base_nodes.size()) - first;
  return std::sqrt(apexes) + std::sqrt(base);
}

double margin_of(const Sides& sides, const Vectors& v) {
  Vec3 common = Vec3::Zero();
  for (const Index node : sides.base_nodes) common += v.col(node) / static_cast<double>(sides.base_nodes.size());
  double apexes = 0, base = 0;
  for (const Index node : sides.apexes) apexes = std::max(apexes, (v.col(node) - common).squaredNorm());
  for (const Index node : sides.base_nodes) base = std::max(base, (v.col(node) - common).squaredNorm());
  const double way = 4 * steps_ahead * sides.longest_step * (std::sqrt(apexes) + std::sqrt(base));
  return std::max(sides.margin, std::isfinite(way) ? way : 0.0);
}

void keep_search(const Sides& sides, const Vectors& x, SidesMemory& memory) {
  keep_positions(sides.apexes, x, memory.apexes_then);
  keep_positions(sides.base_nodes, x, memory.base_then);
  memory.looks = 0;
  memory.mean_way.setZero();
  ++memory.searches;
}

namespace {

/// Computes the normals of the facets of bodies that are searched near themselves.
void find_normals(const Interface& interface, const Vectors& x, Workspace& workspace) {
  const Bodies& bodies = interface.bodies;
  workspace.normals.resize(3, interface.base.facets.cols());
  for (Index b = 0; b < bodies.count(); ++b) {
    if (!searches_itself(workspace, b)) continue;
    for (Index f = bodies.first_facet[b]; f < bodies.first_facet[b + 1]; ++f) workspace.normals.col(f) = facet_normal(interface.base, x, f);
  }
}

/// The mean normal of the facets of solids at an apex; zero on sheets.
Vec3 mean_normal(const BaseSurface& base, const Vectors& normals, Index node) {
  Vec3 sum = Vec3::Zero();
  for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r)
    if (!is_sheet(base, base.ring[r])) sum += normals.col(base.ring[r]);
  return sum.isZero(0) ? sum : Vec3(sum.normalized());
}

/// Sorts the facets that may be near an apex by where they are; false where positions cannot be searched.
bool sort(const Interface& interface, const Vectors& x, const Memory& memory, Workspace& workspace) {
  if (interface.bodies.count() == 0) return workspace.broad[0].sort(interface.base, x);
  find_partners(interface, x, memory, workspace);
  find_normals(interface, x, workspace);
  std::vector<char> wanted(static_cast<std::size_t>(interface.bodies.count()), 0);
  for (const Index partner : workspace.partners) wanted[static_cast<std::size_t>(partner)] = 1;
  for (std::size_t b = 0; b < wanted.size(); ++b)
    if (wanted[b] != 0 && !workspace.broad[b].sort(interface.base, x)) return false;
  return true;
}

/// Calls visit(facet) for the facets nearer to an apex than its h_c and the margin, that it may touch; returns whether it is nearer than
/// was asked to its own body.
template <class Visit>
bool visit_near(const Interface& interface, const Vectors& x, const Memory& memory, const Workspace& workspace, Index a, Visit&& visit) {
  const Vector<double> p = position(x, interface.apexes[a]);
  const double reach = contact_height(interface, memory, a) + memory.margin;
  const Bodies& bodies = interface.bodies;
  bool near_itself = false;
  if (bodies.count() == 0) {
    workspace.broad[0].within(interface.base, x, p, reach, [&](Index facet, double) { visit(facet); });
    return near_itself;
  }
  const Index own = bodies.of_apex[a];
  for (Index i = workspace.first_partner[own]; i < workspace.first_partner[own + 1]; ++i) {
    const Index other = workspace.partners[i];
    const auto body = static_cast<std::size_t>(other);
    const double farther = reach + bodies.thickest(other);
    const BodyBox& box = workspace.boxes[body];
    if (((box.low - eigen(p)).array() > farther).any() || ((eigen(p) - box.high).array() > farther).any()) continue;
    if (own != other) {
      workspace.broad[body].within(interface.base, x, p, farther, [&](Index facet, double) { visit(facet); });
      continue;
    }
    const auto see = [&](Index facet, double squared) {
      near_itself = true;
      if (squared < farther * farther) visit(facet);
    };
    const Vec3 mine = mean_normal(interface.base, workspace.normals, interface.apexes[a]);
    workspace.broad[body].within(interface.base, x, p, farther + farther_from_itself * memory.margin, see, [&](Index facet) {
      return mine.dot(workspace.normals.col(facet)) < looks_away && !is_beside(interface.base, interface.apexes[a], facet);
    });
  }
  return near_itself;
}

}  // namespace

void search(const Interface& interface, const Vectors& x, Memory& memory, Workspace& workspace) {
  search_shapes(interface, x, memory);
  if (by_shapes_alone(interface)) return keep_search(interface, x, memory);
  if (!sort(interface, x, memory, workspace)) return;
  keep_search(interface, x, memory);
  const auto count = static_cast<Index>(interface.apexes.size());
  const Index ranges = (count + apexes_of_a_range - 1) / apexes_of_a_range;
  parallel_for(ranges, 1, [&](Index r) {
    Subset& found = workspace.found[static_cast<std::size_t>(r)];
    found.clear();
    for (Index a = r * apexes_of_a_range; a < std::min(count, (r + 1) * apexes_of_a_range); ++a) {
      const std::size_t before = found.size();
      workspace.apex_near_itself[a] = visit_near(interface, x, memory, workspace, a, [&](Index facet) { found.push_back(facet); });
      std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end());
      workspace.facets[a] = static_cast<Index>(found.size() - before);
    }
  });
  std::fill(workspace.near_itself.begin(), workspace.near_itself.end(), char{0});
  for (std::size_t a = 0; a < interface.bodies.of_apex.size(); ++a)
    if (workspace.apex_near_itself[a] != 0) workspace.near_itself[static_cast<std::size_t>(interface.bodies.of_apex[a])] = 1;
  keep_apart_from_itself(interface, x, interface.follows_thickness, workspace, memory);
  workspace.near.clear();
  memory.near_facets.clear();
  for (const Subset& found : workspace.found) memory.near_facets.insert(memory.near_facets.end(), found.begin(), found.end());
  Index facets = 0;
  for (Index a = 0; a < count; ++a) {
    const Near* was = near(memory, a);
    if (workspace.facets[a] == 0 && !(was && was->tracks.count > 0)) {
      if (was) unpair(a, memory);
      continue;
    }
    if (was) workspace.near.push_back(std::move(memory.near[static_cast<std::size_t>(memory.slot[a])]));
    else workspace.near.push_back({.apex = a, .tracks = {}, .element = {}, .friction = {}});
    if (memory.status[a] == Status::unpaired) memory.status[a] = Status::open, ++memory.recovered;
    Near& now = workspace.near.back();
    now.first_facet = facets;
    now.facets = workspace.facets[a];
    now.safe_distance = now.no_condition_until = now.tracks.owned = -infinite;
    now.is_idle = false;
    facets += now.facets;
    memory.slot[a] = static_cast<Index>(workspace.near.size()) - 1;
  }
  std::swap(memory.near, workspace.near);
}

double speed_apart(const Vectors& v) {
  constexpr Eigen::Index columns = 4;  // at a time, so that a whole number of registers is full
  std::array<double, 3 * columns> low, high;
  low.fill(infinite), high.fill(-infinite);
  const double* at = v.data();
  const Eigen::Index whole = v.cols() / columns * columns;
  for (Eigen::Index i = 0; i < 3 * whole; i += 3 * columns)
    for (std::size_t k = 0; k < low.size(); ++k) {
      const double value = at[static_cast<std::size_t>(i) + k];
      low[k] = value < low[k] ? value : low[k];
      high[k] = value > high[k] ? value : high[k];
    }
  Vec3 least = Vec3::Constant(infinite), most = -least;
  for (std::size_t k = 0; k < low.size(); ++k) {
    const auto axis = static_cast<Eigen::Index>(k % 3);
    least(axis) = std::min(least(axis), low[k]), most(axis) = std::max(most(axis), high[k]);
  }
  for (Eigen::Index i = whole; i < v.cols(); ++i) least = least.cwiseMin(v.col(i)), most = most.cwiseMax(v.col(i));
  return v.cols() > 0 ? (most - least).norm() : 0;
}

double speed_apart(const Vectors& v, std::initializer_list<std::reference_wrapper<const Subset>> nodes) {
  Vec3 least = Vec3::Constant(infinite), most = -least;
  for (const Subset& some : nodes)
    for (const Index node : some) least = least.cwiseMin(v.col(node)), most = most.cwiseMax(v.col(node));
  return (most.array() < least.array()).any() ? 0 : (most - least).norm();
}

void keep_active(const Interface& interface, Memory& memory) {
  memory.active.assign(static_cast<std::size_t>(interface.bodies.count()), 0);
  for (const Near& near : memory.near) {
    memory.active[static_cast<std::size_t>(interface.bodies.of_apex[near.apex])] = 1;
    for (const Index facet : near_facets(memory, near)) memory.active[static_cast<std::size_t>(interface.bodies.of_facet[facet])] = 1;
  }
  for (const NearFeature& near : memory.near_shapes) {
    const ShapePair& pair = interface.shapes.pairs[static_cast<std::size_t>(near.pair)];
    memory.active[static_cast<std::size_t>(pair.body)] = memory.active[static_cast<std::size_t>(pair.other_body)] = 1;
  }
}

bool is_due(const Sides& sides, const Vectors& x, bool has_near, SidesMemory& memory, double& moved) {
  moved = memory.searches == 0 ? infinite : moved_since_search(sides, x, memory);
  const bool worth_it = ++memory.looks > looks_of_a_search && moved > noticeable * memory.margin && has_near;
  return moved > 0.5 * memory.margin || worth_it;
}

}  // namespace nereid::contact
