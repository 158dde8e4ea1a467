#include "contact/connect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/data/pair_records.hpp"
#include "contact/multiplier/tie.hpp"
#include "contact/search/edge_pairs.hpp"
#include "contact/search/near.hpp"
#include "contact/search/shapes.hpp"
#include "contact/multiplier/shape_points.hpp"
#include "contact/surface/stand.hpp"
#include "contact/tracking/edge_over_edge.hpp"
#include "contact/tracking/element.hpp"
#include "contact/tracking/tracking.hpp"

namespace nereid::contact {

namespace {

using geometry::Closest;
using geometry::Kind;

/// How an apex stands over its nearest facet at the start.
struct Start {
  Index facet = -1;   ///< -1: none within reach
  Stand stand;
  double distance = 0;  ///< [m]
};
Start start_of(const Interface& interface, const Vectors& x, Index a, double reach, const BroadSearch& broad) {
  const Index node = interface.apexes[a], facet = broad.nearest(interface.base, x, position(x, node), reach);
  if (facet < 0) return {};
  const Closest closest = geometry::closest_on_triangle(corners(interface.base, x, facet), position(x, node));
  return {facet, stand(interface.base, x, x.col(node), facet), std::sqrt(closest.distance_squared)};
}

/// What every contact remembers at the start.
void prepare(const Sides& sides, SidesMemory& memory) {
  memory.apexes_then = Vectors::Zero(3, static_cast<Eigen::Index>(sides.apexes.size()));
  memory.base_then = Vectors::Zero(3, static_cast<Eigen::Index>(sides.base_nodes.size()));
  make_room_for_pair_records(sides, memory);
  memory.apart_from_itself.assign(static_cast<std::size_t>(sides.bodies.count()), 0);
  memory.apart_then = Vectors::Zero(3, static_cast<Eigen::Index>(sides.bodies.nodes.size()));
}

Memory memory_at_start(const Interface& interface) {
  const auto count = static_cast<Index>(interface.apexes.size());
  Memory memory;
  prepare(interface, memory);
  memory.near.reserve(count);
  memory.near_facets.reserve(static_cast<std::size_t>(facets_at_first) * count);
  memory.slot.assign(count, -1);
  memory.feature.resize(count);
  memory.status.assign(count, Status::unpaired);
  memory.gap.assign(count, std::numeric_limits<double>::quiet_NaN());
  memory.stored.assign(count, 0.0);
  if (interface.friction.coefficient > 0 && !by_multipliers(interface)) {
    memory.slip.assign(count, Vec3::Zero());
    memory.tangential_stored.assign(count, 0.0);
  }
  if (by_multipliers(interface) && interface.kind != InterfaceKind::tied) memory.restitution.resize(count);
  memory.reconnections.assign(count, 0);
  return memory;
}

/// Puts a tied apex over its point of the base, unless it stands past the border.
bool tie(const Vectors& x, Index a, const Start& start, Interface& interface, Memory& memory) {
  if (start.facet < 0) return false;
  const Index facet = start.stand.feature.facet;
  if (is_past_border(interface.base, x, start.stand)) return false;
  interface.ties[a] = tie_over(interface, x, a, facet);
  memory.feature[a] = {facet, Kind::facet, 0};
  memory.status[a] = Status::open;
  memory.slot[a] = static_cast<Index>(memory.near.size());
  memory.near.push_back({.apex = a, .tracks = {}, .element = {}, .friction = {}});
  return true;
}

/// Whether an overlap is slight, and adds it to those that are listed unless it is the round-off of the program itself.
///
/// element    [m] depth of the flattest element behind either surface
/// round_off  [m] of the program
bool is_slight(Index apex_body, Index base_body, double depth, double element, double round_off, std::vector<SlightOverlap>& all) {
  if (depth > std::max(round_off, slight * element)) return false;
  if (!(depth > round_off)) return true;
  const auto [one, other] = std::minmax(apex_body, base_body);
  auto at = std::find_if(all.begin(), all.end(), [&](const SlightOverlap& o) { return o.apex_body == one && o.base_body == other; });
  if (at == all.end()) at = all.insert(at, {.apex_body = one, .base_body = other});
  ++at->count, at->deepest = std::max(at->deepest, depth);
  return true;
}

}  // namespace

InitialGaps connect(Interface& interface, const Vectors& x, double reach, const ContactHeight& height, InitialPenetration penetration,
                    Memory& memory, Workspace& workspace) {
  const auto count = static_cast<Index>(interface.apexes.size());
  const bool tied = interface.kind == InterfaceKind::tied;
  interface.base_nodes.assign(interface.base.facets.data(), interface.base.facets.data() + interface.base.facets.size());
  std::sort(interface.base_nodes.begin(), interface.base_nodes.end());
  interface.base_nodes.erase(std::unique(interface.base_nodes.begin(), interface.base_nodes.end()), interface.base_nodes.end());
  memory = memory_at_start(interface);
  interface.ties.assign(tied ? count : 0, Tie{});
  if (interface.contact_height.size() == 0) interface.contact_height = Scalars::Constant(count, height.given);
  memory.margin = interface.margin;

  InitialGaps gaps;
  gaps.apexes = count;
  gaps.least = infinite;
  gaps.largest = -infinite;
  if (by_shapes_alone(interface)) {
    gaps.apexes = gaps.without_base = 0, gaps.least = gaps.largest = 0;
    search_shapes(interface, x, memory);
    add_gaps_of_shapes(interface, x, penetration == InitialPenetration::accept, memory, gaps);
    return gaps;
  }
  std::vector<double> initial(count, std::numeric_limits<double>::quiet_NaN());
  std::vector<int> kind(count, -1);     // of the feature that an apex is over; -1: over none
  std::vector<char> crosses(count, 0);  // whether an apex stands behind a facet that it touches
  const bool one_pair = interface.bodies.count() == 0;
  if (one_pair) workspace.broad[0].sort(interface.base, x);
  for (Index a = 0; one_pair && a < count; ++a) {
    const Start start = start_of(interface, x, a, reach, workspace.broad[0]);
    if (tied && !tie(x, a, start, interface, memory)) ++gaps.free;
    if (start.facet < 0) {
      ++gaps.without_base;
      continue;
    }
    // past a wall only the distance has a meaning
    const double h = start.stand.past > 0 ? start.distance : start.stand.over.height;
    if (height.from_initial_height) interface.contact_height(a) = h - height.clearance;
    // a height of round-off would be a layer around walls and edges, and none is meant
    const double least_height = 1e-9 * interface.base.longest(start.stand.feature.facet);
    if (std::abs(interface.contact_height(a)) < least_height) interface.contact_height(a) = 0;
    initial[a] = h - interface.contact_height(a);
    if (tied) memory.gap[a] = initial[a];
    kind[a] = static_cast<int>(start.stand.feature.kind);
  }
  if (!tied) {
    search(interface, x, memory, workspace);
    memory.recovered = memory.searches = 0;
  }
  const Vectors rest = Vectors::Zero(3, x.cols());
  for (Near& near : memory.near) {
    if (tied) break;
    const Index a = near.apex, node = interface.apexes[a];
    double contact_height = interface.contact_height(a);
    const Mat3* allowed = allowed_of(interface, a);
    const ApexPath path{interface.base, interface.own, x, rest, 0, near_facets(memory, near), node, allowed, contact_height,
                      most_behind(interface)};
    const Nearest nearest = nearest_of(interface, x, a, path.near);
    memory.feature[a] = nearest.feature;
    if (nearest.feature.facet < 0) continue;
    memory.gap[a] = nearest.distance() - path.level(nearest.feature.facet);
    kind[a] = static_cast<int>(nearest.feature.kind);  // of what is near, which the facet of the start need not be
    if (!one_pair) initial[a] = memory.gap[a];
    double depth = 0;
    const double deepest = between(interface, a, nearest.feature.facet).depth;
    const Index facet = behind(path, deepest > 0 ? deepest : infinite, depth);
    if (facet < 0) continue;
    crosses[a] = 1;
    contact_height = path.level(facet);
    // positions are no more exact than their distance from the origin allows, and differences no more than the facet's size
    const double round_off = 1e-12 * (std::abs(depth) + 2 * std::abs(contact_height) + interface.base.longest(facet));
    const Index body = one_pair ? -1 : interface.bodies.of_apex[a], other = one_pair ? -1 : interface.bodies.of_facet[facet];
    const double element = deepest > 0 ? deepest : interface.base.longest(facet);
    const bool counts = !is_slight(body, other, depth, element, round_off, gaps.slight_overlaps);
    // a slight overlap is a state that a penalty can have, and multipliers not
    const bool accepted = penetration == InitialPenetration::accept || (by_multipliers(interface) ? !counts : !(depth > round_off));
    near.tracks.begin(facet, accepted ? contact_height - depth : contact_height);
    memory.gap[a] = initial[a] = accepted ? 0 : -depth;
    if (!counts) continue;
    ++gaps.penetrating;
    gaps.deepest = std::max(gaps.deepest, depth);
  }
  for (Index a = 0; a < count; ++a) {
    const double gap = initial[a];
    if (kind[a] >= 0) ++gaps.by_kind[kind[a]];
    if (std::isnan(gap)) continue;
    if (!tied && !crosses[a] && gap < -slight * interface.margin) {
      ++gaps.behind;
      continue;
    }
    gaps.least = std::min(gaps.least, gap);
    gaps.largest = std::max(gaps.largest, gap);
    gaps.mean += gap;
  }
  if (!one_pair) gaps.without_base = count - static_cast<Index>(memory.near.size());
  const Index connected = gaps.apexes - gaps.without_base - gaps.behind;
  if (connected == 0) gaps.least = gaps.largest = 0;
  else gaps.mean /= connected;
  add_gaps_of_shapes(interface, x, penetration == InitialPenetration::accept, memory, gaps);
  return gaps;
}

InitialGaps connect(const EdgeContact& contact, const Vectors& x, EdgeMemory& memory, EdgeWorkspace& workspace) {
  memory = {};
  prepare(contact, memory);
  memory.margin = contact.margin;
  search(contact, x, memory, workspace);
  memory.searches = 0;
  InitialGaps gaps;
  gaps.pairs = static_cast<Index>(memory.edge_pairs.size());
  memory.crossings.clear();
  for (const EdgePair& pair : memory.edge_pairs) {
    const Over at = over(contact, x, pair.edge, pair.base_edge, pair.in_face, 0);
    const double depth = height_between(contact, pair.edge, pair.base_edge) - at.height;
    const double element = between_edges(contact, pair.edge, pair.base_edge).depth, round_off = 1e-12 * contact.margin;
    if (!at.is || !(depth > round_off) || depth > element) continue;
    const bool many = contact.bodies.count() > 0;
    const Index body = many ? contact.edges.body[pair.edge] : -1, other = many ? contact.base_edges.body[pair.base_edge] : -1;
    if (!is_slight(body, other, depth, element, round_off, gaps.slight_overlaps)) {
      ++gaps.penetrating;
      gaps.deepest = std::max(gaps.deepest, depth);
    }
    Crossing& crossing = memory.crossings.emplace_back(crossing_of(pair));
    crossing.side = at.side, crossing.normal = at.normal, crossing.level = at.height;  // an offset, if the caller accepts it
  }
  return gaps;
}

Memory tried_out(const Interface& interface, const Vectors& x, double reach, Workspace& workspace) {
  Memory trial = memory_at_start(interface);
  if (!workspace.broad[0].sort(interface.base, x)) return trial;
  const auto count = static_cast<Index>(interface.apexes.size());
  for (Index a = 0; a < count; ++a) {
    const Start start = start_of(interface, x, a, reach, workspace.broad[0]);
    const bool tied = interface.kind == InterfaceKind::tied;
    if (start.facet < 0 || (tied && interface.ties[a].facet < 0)) continue;
    trial.slot[a] = static_cast<Index>(trial.near.size());
    trial.near.push_back({.apex = a, .tracks = {}, .element = {}, .friction = {}});
    Near& near = trial.near.back();
    trial.feature[a] = start.stand.feature;
    if (tied) hold_tie(interface, x, near, trial);
    else vote_over(interface, x, a, start.stand.feature,
                   weights_of(interface, x, a, start.stand.feature.facet), interface.contact_height(a), near.element);
  }
  return trial;
}

}  // namespace nereid::contact
