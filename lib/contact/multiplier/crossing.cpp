#include "contact/multiplier/crossing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

#include "base/check.hpp"
#include "base/parallel.hpp"
#include "contact/multiplier/assemble.hpp"
#include "contact/multiplier/over_facet.hpp"
#include "contact/multiplier/restitution.hpp"
#include "contact/multiplier/stick.hpp"
#include "contact/search/body_ways.hpp"
#include "contact/search/edge_pairs.hpp"
#include "contact/search/near.hpp"
#include "contact/tracking/edge_over_edge.hpp"
#include "geometry/crossing.hpp"

namespace nereid::contact {

namespace {

constexpr double slow = 1e-3;        // of the depth of an element in a step: with more, no pair stays flat for long
constexpr double sideways = 0.1;     // of the depth of an element: so far below an edge may come in with an offset; farther is far behind

/// Ends what a crossing was.
void end_crossing(Crossing& crossing) {
  crossing.acts = false;
  crossing.pressed = 0;
  end_friction(crossing.friction);
}

/// Whether edges have turned past each other as parallel ones, where the product of both changes its sign: what was above then seems below.
bool has_turned(const Vec3& normal, const Vec3& earlier) { return normal.dot(earlier) <= 0; }

/// The velocity of the point of the edge against that of the base edge, as they were last over each other.
Vec3 relative(const Crossing& crossing, const Vectors& v) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t j = 0; j < 4; ++j) sum += crossing.weight[j] * v.col(crossing.node[j]);
  return sum;
}

/// Whether edges are over each other as they were in the step before, with a height that follows from how their points have moved. Where
/// their lines are across iterations along nearly parallel edges, and takes the height with it.
bool goes_on(const EdgeContact& contact, const Motion& m, const Crossing& crossing, const Over& at) {
  if (crossing.side == 0 || has_turned(at.normal, crossing.normal)) return false;
  const double moved = m.dt * crossing.normal.dot(relative(crossing, m.v));
  const double may_differ = sideways * between_edges(contact, crossing.edge, crossing.base_edge).depth;
  return at.height >= crossing.level + crossing.gap + moved - may_differ;
}

/// Brings a crossing up to date with where its edges are, and would be after the step; false if they can not touch in it.
bool follow(const EdgeContact& contact, const Motion& m, const Multipliers& all, Crossing& crossing, Over& at) {
  const auto see = [&](const Vectors& x) {
    const bool are_held = crossing.side != 0 && crossing.of_ridges;
    return over(contact, x, crossing.edge, crossing.base_edge, !are_held, crossing.side);
  };
  const auto find = [&] {
    at = see(m.x);
    if (at.is) return true;
    const Over ahead = see(all.ahead);
    return ahead.is && between_lines(contact, m.x, crossing.edge, crossing.base_edge, ahead.side, at) &&
           !has_turned(at.normal, ahead.normal);
  };
  bool is = find();
  if (crossing.side != 0 && !(is && goes_on(contact, m, crossing, at))) crossing.side = 0, is = find();
  if (!is) return false;
  const double height = height_between(contact, crossing.edge, crossing.base_edge);
  if (crossing.side == 0) {
    const double offset = std::max(0.0, height - at.height);
    if (offset > sideways * between_edges(contact, crossing.edge, crossing.base_edge).depth) return false;
    crossing.level = height - offset;
    crossing.of_ridges = false;
  }
  crossing.of_ridges = crossing.of_ridges || are_ridges(contact, m.x, crossing.edge, crossing.base_edge);
  crossing.side = at.side;
  crossing.normal = at.normal;
  crossing.level = std::max(crossing.level, std::min(at.height, height));
  crossing.gap = at.height - crossing.level;
  return true;
}

/// Sets nodes, weights, normal and gap of the condition of a crossing.
void make(const EdgeContact& contact, const Over& at, Crossing& crossing, Multipliers& all, Condition& c) {
  crossing.node = {contact.edges.nodes(0, crossing.edge), contact.edges.nodes(1, crossing.edge),
                   contact.base_edges.nodes(0, crossing.base_edge), contact.base_edges.nodes(1, crossing.base_edge)};
  crossing.weight = {1 - at.first, at.first, at.second - 1, -at.second};
  c.normal = crossing.push = at.normal;
  for (std::size_t j = 0; j < 4; ++j) add_member(crossing.node[j], crossing.weight[j], all, c);
  c.gap = crossing.gap;
}

/// Gap g of the condition of a crossing. Where edges have left each other sideways when their lines would meet, it is that of an apex that
/// passes an edge: max(g, g_e - dt' v_f), with the distance g_e after the free step, so that the free step closes nothing. [m]
///
/// rate  [m/s] v_f, at which the gap grows in the free step
double gap_of_step(const EdgeContact& contact, const Motion& m, const Crossing& crossing, double rate, const Multipliers& all) {
  const double closes = -m.next * rate;
  if (!(crossing.gap > 0 && closes > crossing.gap)) return crossing.gap;
  if (!meet_beside(contact, m.x, all.ahead, crossing.edge, crossing.base_edge, crossing.gap / closes)) return crossing.gap;
  const auto end = ends_of(contact, all.ahead, crossing.edge, crossing.base_edge);
  const double distance = std::sqrt(geometry::segments_squared(end[0], end[1], end[2], end[3]));
  return std::max(crossing.gap, distance - crossing.level + closes);
}

/// Where friction acts: on both edges, by the weights of the points that touch. With these a height h apart along n they would be turned by
/// h n x f; forces b_1 n and b_2 n at the ends of both edges, up at one and down at the other, take that back:
///
///     h f = b_1 L1 + b_2 L2,   b_1 = h (L2 x n) . f / n . (L1 x L2),   b_2 = h (n x L1) . f / n . (L1 x L2)
Touch touch_of(const Vectors& x, const Crossing& crossing) {
  Touch touch;
  touch.normal = crossing.push;
  touch.nodes = 4;
  touch.node = {crossing.node[2], crossing.node[3], crossing.node[0], crossing.node[1]};
  touch.weight = {-crossing.weight[2], -crossing.weight[3], -crossing.weight[0], -crossing.weight[1]};
  const auto at = [&](std::size_t j) { return Vec3(x.col(crossing.node[j])); };
  const Vec3 L1 = at(1) - at(0), L2 = at(3) - at(2), n = touch.normal;
  double height = 0;
  for (std::size_t j = 0; j < 4; ++j) height += crossing.weight[j] * n.dot(at(j) - at(0));
  const double scale = height / n.dot(L1.cross(L2));
  const Vec3 first = scale * L2.cross(n), second = scale * n.cross(L1);
  touch.lift = {-second, second, -first, first};
  return touch;
}

/// By how much the nodes of both edges go against each other in the step to come. [m]
double way_of(const EdgeContact& contact, const Vectors& x, const Vectors& ahead, const EdgePair& pair) {
  const auto way = [&](const Edges& edges, int end, Index edge) {
    return Vec3(node_of(edges, ahead, end, edge) - node_of(edges, x, end, edge));
  };
  const Vec3 first = way(contact.edges, 0, pair.edge);
  const double squared = std::max({(way(contact.edges, 1, pair.edge) - first).squaredNorm(),
                                   (way(contact.base_edges, 0, pair.base_edge) - first).squaredNorm(),
                                   (way(contact.base_edges, 1, pair.base_edge) - first).squaredNorm()});
  return 2 * std::sqrt(squared);  // between any two
}

/// Whether one edge of a pair can come over the other in the step to come, as far as distance and lines tell. Where it cannot, and will not
/// before nodes have gone some way, the pair is left alone until then.
///
/// moved, way  [m] since the last search, and in the step to come;  passed  [m] Memory::way
bool can_come_over(const EdgeContact& contact, const Vectors& x, const Vectors& ahead, double moved, double passed, double way,
                   EdgePair& pair) {
  if (passed + way < pair.flat) return false;
  const Between& both = between_edges(contact, pair.edge, pair.base_edge);
  const double reach = std::max(sideways * both.depth, reach_of(both, way));
  if (!(pair.apart - moved <= reach)) return false;
  Over lines;
  const bool have_normal = between_lines(contact, x, pair.edge, pair.base_edge, 1, lines);
  if (have_normal && is_within(lines.first) && is_within(lines.second)) return true;
  const auto p = ends_of(contact, x, pair.edge, pair.base_edge);
  const double distance = std::sqrt(geometry::segments_squared(p[0], p[1], p[2], p[3]));
  const double beside = have_normal ? stays_beside(contact, x, pair.edge, pair.base_edge, lines) : 0;
  const double until = std::max(beside, distance - height_between(contact, pair.edge, pair.base_edge) - reach);
  pair.flat = passed + until;
  if (until > way || until > way_of(contact, x, ahead, pair)) return false;
  return between_lines(contact, ahead, pair.edge, pair.base_edge, 1, lines) && is_within(lines.first) && is_within(lines.second);
}

/// How far the edges of a pair have come nearer since the last search, the way since then that EdgePair::flat is held against, and the way
/// of the step to come. [m]
struct EdgeWays {
  double moved, passed, ahead;
};

/// Brings the crossings of a range of pairs up to date: those that were over each other, and what can come over the other in the step to
/// come. Reads the memory and writes EdgePair::flat of these pairs alone.
template <class WaysOf>
void follow_range(const EdgeContact& contact, const Motion& m, WaysOf&& ways_of, std::span<EdgePair> pairs,
                  const std::vector<Crossing>& before, const Multipliers& all, CrossingRange& range) {
  range.crossings.clear(), range.over.clear(), range.ended.clear();
  auto was = std::lower_bound(before.begin(), before.end(), pairs.front(), in_order);
  for (EdgePair& pair : pairs) {
    const bool is_known = was != before.end() && !in_order(pair, *was);
    const EdgeWays ways = ways_of(pair);
    if (!is_known && !can_come_over(contact, m.x, all.ahead, ways.moved, ways.passed, ways.ahead, pair)) continue;
    Crossing crossing = is_known ? *was++ : crossing_of(pair);
    Over at;
    at.is = follow(contact, m, all, crossing, at);
    if (crossing.side != 0) {
      range.crossings.push_back(crossing), range.over.push_back(at);
      continue;
    }
    if (crossing.restitution.held > 0) range.ended.push_back(crossing);
    const bool is_slow = ways.ahead < slow * between_edges(contact, pair.edge, pair.base_edge).depth;
    if (pair.in_face && is_slow) pair.flat = ways.passed + stays_flat(contact, m.x, pair.edge, pair.base_edge);
  }
}

/// Brings the crossings up to date, range after range of pairs; `is` of EdgeWorkspace::over is false where they do not act.
template <class WaysOf>
void follow_all(const EdgeContact& contact, const Motion& m, WaysOf&& ways_of, EdgeMemory& memory, EdgeWorkspace& workspace,
                Multipliers& all) {
  constexpr Index pairs_of_a_range = 128;  // whatever the number of threads
  const auto count = static_cast<Index>(memory.edge_pairs.size()), ranges = (count + pairs_of_a_range - 1) / pairs_of_a_range;
  std::vector<CrossingRange>& found = workspace.crossing_ranges;
  if (found.size() < static_cast<std::size_t>(ranges)) found.resize(static_cast<std::size_t>(ranges));
  parallel_for(ranges, 1, [&](Index r) {
    const Index first = r * pairs_of_a_range, last = std::min(count, first + pairs_of_a_range);
    const std::span<EdgePair> pairs(&memory.edge_pairs[static_cast<std::size_t>(first)], static_cast<std::size_t>(last - first));
    follow_range(contact, m, ways_of, pairs, memory.crossings, all, found[static_cast<std::size_t>(r)]);
  });
  std::vector<Crossing>& next = workspace.crossings;
  next.clear(), workspace.over.clear();
  for (Index r = 0; r < ranges; ++r) {
    CrossingRange& range = found[static_cast<std::size_t>(r)];
    next.insert(next.end(), range.crossings.begin(), range.crossings.end());
    workspace.over.insert(workspace.over.end(), range.over.begin(), range.over.end());
    for (Crossing& one : range.ended) end(one.node, contact.restitution, one.restitution, memory, all);
  }
  std::swap(memory.crossings, next);
}

}  // namespace

void find_conditions(const EdgeContact& contact, const Motion& m, EdgeMemory& memory, EdgeWorkspace& workspace, Multipliers& all) {
  const double h = 0.5 * (m.dt + m.next);
  if (contact.bodies.count() == 0) {
    const auto apart = [&](const Vectors& v) { return speed_apart(v, {contact.apexes, contact.base_nodes}); };
    const double moved = search_where_due(contact, m.x, all.way, memory, workspace), ahead = m.next * apart(all.velocity);
    if (!m.again) memory.way += m.dt * apart(m.v);
    follow_all(contact, m, [&](const EdgePair&) { return EdgeWays{moved, memory.way, ahead}; }, memory, workspace, all);
  } else {
    find_speeds_apart(contact, all.velocity, workspace);
    const auto ways_of = [&](const EdgePair& pair) {
      const auto body = static_cast<std::size_t>(contact.edges.body[static_cast<std::size_t>(pair.edge)]);
      return EdgeWays{memory.way_of_body[body], memory.way_of_body[body], m.next * workspace.apart[body]};
    };
    follow_all(contact, m, ways_of, memory, workspace, all);
  }
  for (std::size_t i = 0; i < memory.crossings.size(); ++i) {
    Crossing& crossing = memory.crossings[i];
    const Between& pair = between_edges(contact, crossing.edge, crossing.base_edge);
    bool acts = workspace.over[i].is;
    const auto first = static_cast<Index>(all.conditions.size());
    if (acts) {
      Condition& c = begin_condition(all);
      make(contact, workspace.over[i], crossing, all, c);
      const double speed = relative(crossing, all.velocity).norm();
      const bool is_near = can_touch(pair, m, c.gap, speed);
      c.gap = gap_of_step(contact, m, crossing, relative(c, all, all.velocity), all);
      acts = is_near && complete(m, crossing.pressed, crossing.restitution.held, all, all, c);
      if (!acts) take_back(all);
    }
    if (!acts) {
      end(crossing.node, contact.restitution, crossing.restitution, memory, all);
      end_crossing(crossing);
      continue;
    }
    crossing.acts = true;
    Condition& c = all.conditions[first];
    c.impulse = c.met = crossing.pressed * h;
    Index friction = -1;
    if (contact.friction.coefficient > 0 && m.dt > 0) {
      const Vec3 force = crossing.friction->acts ? crossing.friction->force : Vec3(Vec3::Zero());
      friction = add_friction(touch_of(m.x, crossing), contact.friction, force, crossing.friction->stuck, m, all.frictions);
    }
    const double area = std::min(contact.edges.area(crossing.edge), contact.base_edges.area(crossing.base_edge));
    const double loaded = std::min(area_loaded(contact.edges, m.x, crossing.edge, c.normal),
                                   area_loaded(contact.base_edges, m.x, crossing.base_edge, -c.normal));
    add({.memory = &crossing.restitution, .first = first, .last = first + 1, .friction = friction, .area = area, .depth = pair.depth,
         .impedance = pair.impedance * loaded, .square = contact.restitution * contact.restitution}, all);
  }
  all.spent.end(Stage::edges);
}

void book_first_half(const EdgeContact&, const Motion& m, EdgeMemory& memory) {
  const double half = 0.5 * m.dt;
  for (const Crossing& crossing : memory.crossings) {
    if (!crossing.closed) continue;
    memory.work += half * crossing.push.dot(relative(crossing, m.v));
    if (!crossing.friction->acts) continue;
    memory.work += half * crossing.friction->force.dot(slip_rate(crossing.friction->touch, m.v, m.omega, m.rotation_of_node));
  }
}

void take_over(const EdgeContact& contact, const Motion& m, double h, double t, Index first, Index last, const Doing& now,
               EdgeMemory& memory, const Multipliers& all) {
  Index contactor = first;
  memory.deepest_now = 0;
  const Vec3 force_before = memory.force;
  memory.force.setZero();
  for (Crossing& crossing : memory.crossings) {
    crossing.closed = false;
    end_friction(crossing.friction);
    crossing.pressed = 0;
    if (!crossing.acts) {
      crossing.push.setZero();
      continue;
    }
    const Contactor& one = all.contactors[contactor++];
    const Condition& c = all.conditions[one.first];
    crossing.closed = c.impulse > 0;
    crossing.pressed = c.impulse / h;
    crossing.push = crossing.pressed * c.normal;
    memory.force += crossing.push;
    book_friction(one, crossing.closed, h, all, crossing.friction);
    memory.force += crossing.friction->force;
    const double depth = height_between(contact, crossing.edge, crossing.base_edge) - crossing.level - c.gap;
    memory.deepest_now = std::max(memory.deepest_now, depth);
    if (!(depth > memory.deepest)) continue;
    memory.deepest = depth, memory.deepest_apex = crossing.node[0], memory.deepest_time = t;
    memory.deepest_in = between_edges(contact, crossing.edge, crossing.base_edge).depth;
  }
  take_over(m, force_before, first, last, now, memory, all);
  check(contactor == last, "every contactor of edges over edges is a crossing");
}

}  // namespace nereid::contact
