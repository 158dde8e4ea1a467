#include "contact/crossing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

#include "base/check.hpp"
#include "contact/partners.hpp"
#include "contact/restitution.hpp"
#include "geometry/crossing.hpp"

namespace nereid::contact {

namespace {

constexpr double parallel = 1e-3;    // sine between edges: with less, an edge 1 m long is over the other where its nodes are, within 1 mm
constexpr double bent = 0.05;        // sine: bodies bend, and a face that lies on an edge may rise by so much above it
constexpr double steep = 0.2;        // sine: so far a ridge stands up that is held off edges in a face; flatter ones come in by a fifth
constexpr double stays_steep = 0.1;  // the same while they are over each other
constexpr double slightly = 0.02;    // sine: so far facets must fall away from an edge in the mean where one edge is of a plate
constexpr double curved = 0.9962;    // cosine of 5 degrees: edges of plates that turn by more are those of a curved sheet
constexpr double leans = 0.3;        // sine: the same while they are over each other, so that none goes through as a face leans to and fro
constexpr double past_end = 1e-6;    // of an edge: two that follow one another have no gap
constexpr double left_to_nodes = 0.02;  // of an edge at its ends, where it lies in a face of the other body: its node is over that
constexpr double slow = 1e-3;        // of the depth of an element in a step: with more, no pair stays flat for long
constexpr double sideways = 0.1;     // of the depth of an element: so far below an edge may come in with an offset; farther is far behind

Vec3 node_of(const Edges& edges, const Vectors& x, int end, Index edge) { return x.col(edges.nodes(end, edge)); }

/// Positions of both edges, less that of the first node, so that differences keep their digits.
std::array<Vector<double>, 4> ends_of(const Interface& interface, const Vectors& x, Index edge, Index base_edge) {
  const Vec3 origin = node_of(interface.edges, x, 0, edge);
  std::array<Vector<double>, 4> ends;
  for (int i = 0; i < 4; ++i) {
    const Vec3 at = (i < 2 ? node_of(interface.edges, x, i, edge) : node_of(interface.base_edges, x, i - 2, base_edge)) - origin;
    ends[static_cast<std::size_t>(i)] = {at.x(), at.y(), at.z()};
  }
  return ends;
}

bool of_plates(const Edges& edges, Index edge) { return edges.of_plates[static_cast<std::size_t>(edge)] != 0; }

/// Whether an edge is one of a curved sheet. Elements that are much longer than thick leave a large part of the thickness open there.
bool is_curved(const Edges& edges, const Vectors& x, Index edge) {
  if (!of_plates(edges, edge) || edges.across(1, edge) < 0) return false;
  const Vec3 first = into(edges, x, edge, 0), second = into(edges, x, edge, 1);
  return first.dot(second) > -curved * first.norm() * second.norm();
}

/// The mean sine by which the facets at an edge fall away from a direction.
double mean_fall(const Edges& edges, const Vectors& x, Index edge, const Vec3& direction) {
  const Flanks flanks(edges, x, edge);
  double sum = 0;
  for (int i = 0; i < flanks.count; ++i) sum -= flanks.into[static_cast<std::size_t>(i)].dot(direction);
  return sum / flanks.count;
}

/// Whether both edges, of which one is of a plate, stand up off each other: the facets at both fall away by `least` in the mean.
bool are_crests(const Interface& interface, const Vectors& x, Index edge, Index base_edge, const Vec3& normal, double least) {
  return (of_plates(interface.edges, edge) || of_plates(interface.base_edges, base_edge)) &&
         mean_fall(interface.edges, x, edge, -normal) >= least && mean_fall(interface.base_edges, x, base_edge, normal) >= least;
}

/// Whether both edges are ridges or rims as they stand now, whenever the last search was.
bool are_ridges(const Interface& interface, const Vectors& x, Index edge, Index base_edge) {
  return is_ridge(interface.edges, x, edge) && is_ridge(interface.base_edges, x, base_edge);
}

/// Whether what lies from an edge along a way is over a facet at it that does not fall away from a direction. Such a facet reaches a little
/// past the edge where this is a wall, as for nodes.
bool is_under(const Flanks& flanks, const Vec3& way, const Vec3& direction) {
  const bool is_wall = flanks.count < 2 || flanks.into[0].dot(flanks.into[1]) > -far_turn;
  for (std::size_t i = 0; i < static_cast<std::size_t>(flanks.count); ++i)
    if ((is_wall || flanks.into[i].dot(way) > 0) && !(flanks.into[i].dot(direction) <= -bent)) return true;
  return false;
}

bool is_within(double place) { return place >= -past_end && place <= 1 + past_end; }

/// Whether a place on an edge is so near an end of it that its node is over a face of the other edge, which leaves it to the node.
///
/// along      from the first node of the edge to the second
/// direction  out of the other edge
bool is_left_to_node(double place, const Vec3& along, const Flanks& other, const Vec3& direction) {
  return (place < left_to_nodes && is_under(other, -along, direction)) || (place > 1 - left_to_nodes && is_under(other, along, direction));
}

/// Lines of two edges where they are closest, whatever their ends and what is in front of them; false if they are parallel.
bool between_lines(const Interface& interface, const Vectors& x, Index edge, Index base_edge, int side, Over& at) {
  const auto p = ends_of(interface, x, edge, base_edge);
  const Vector<double> L1 = p[1] - p[0], L2 = p[3] - p[2];
  if (!(norm(cross(L1, L2)) > parallel * norm(L1) * norm(L2))) return false;
  const geometry::Crossing<double> lines = geometry::crossing(p[0], p[1], p[2], p[3]);
  at = {.is = false, .side = side, .normal = side * eigen(lines.normal), .height = side * lines.height, .first = lines.first,
        .second = lines.second};
  return true;
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
bool can_cross(const Interface& interface, Index edge, Index base_edge) {
  const Bodies& bodies = interface.bodies;
  if (bodies.count() == 0) return true;
  if (base_edge <= edge) return false;
  const Index one = interface.edges.body[edge], other = interface.base_edges.body[base_edge];
  if (bodies.touch[bodies.pair(one, other)] == 0) return false;
  if (one != other) return true;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (is_beside(interface.base.beside, interface.edges.nodes(i, edge), interface.base_edges.nodes(j, base_edge))) return false;
  return true;
}

/// The order of pairs, and of crossings as of their pairs.
constexpr auto in_order = [](const auto& a, const auto& b) { return std::tie(a.edge, a.base_edge) < std::tie(b.edge, b.base_edge); };

/// Ends what a crossing was.
void let_go(Crossing& crossing) {
  crossing.acts = false;
  crossing.pressed = 0;
  crossing.friction.acts = crossing.friction.stuck = false;
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
/// their lines are across sweeps along nearly parallel edges, and takes the height with it.
bool goes_on(const Interface& interface, const Motion& m, const Crossing& crossing, const Over& at) {
  if (crossing.side == 0 || has_turned(at.normal, crossing.normal)) return false;
  const double moved = m.dt * crossing.normal.dot(relative(crossing, m.v));
  const double may_differ = sideways * between_edges(interface, crossing.edge, crossing.base_edge).depth;
  return at.height >= crossing.level + crossing.gap + moved - may_differ;
}

/// Brings a crossing up to date with where its edges are, and would be after the step; false if they can not touch in it.
bool follow(const Interface& interface, const Motion& m, const Multipliers& all, Crossing& crossing, Over& at) {
  const auto see = [&](const Vectors& x) {
    const bool are_held = crossing.side != 0 && crossing.of_ridges;
    return over(interface, x, crossing.edge, crossing.base_edge, !are_held, crossing.side);
  };
  const auto find = [&] {
    at = see(m.x);
    if (at.is) return true;
    const Over ahead = see(all.ahead);
    return ahead.is && between_lines(interface, m.x, crossing.edge, crossing.base_edge, ahead.side, at) &&
           !has_turned(at.normal, ahead.normal);
  };
  bool is = find();
  if (crossing.side != 0 && !(is && goes_on(interface, m, crossing, at))) crossing.side = 0, is = find();
  if (!is) return false;
  const double height = height_between(interface, crossing.edge, crossing.base_edge);
  if (crossing.side == 0) {
    const double offset = std::max(0.0, height - at.height);
    if (offset > sideways * between_edges(interface, crossing.edge, crossing.base_edge).depth) return false;
    crossing.level = height - offset;
    crossing.of_ridges = false;
  }
  crossing.of_ridges = crossing.of_ridges || are_ridges(interface, m.x, crossing.edge, crossing.base_edge);
  crossing.side = at.side;
  crossing.normal = at.normal;
  crossing.level = std::max(crossing.level, std::min(at.height, height));
  crossing.gap = at.height - crossing.level;
  return true;
}

/// Sets nodes, weights, normal and gap of the condition of a crossing.
void make(const Interface& interface, const Over& at, Crossing& crossing, Multipliers& all, Condition& c) {
  crossing.node = {interface.edges.nodes(0, crossing.edge), interface.edges.nodes(1, crossing.edge),
                   interface.base_edges.nodes(0, crossing.base_edge), interface.base_edges.nodes(1, crossing.base_edge)};
  crossing.weight = {1 - at.first, at.first, at.second - 1, -at.second};
  c.normal = crossing.push = at.normal;
  for (std::size_t j = 0; j < 4; ++j) add_member(crossing.node[j], crossing.weight[j], all, c);
  c.gap = crossing.gap;
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

/// stays_beside() of edges whose lines are known.
double stays_beside(const Interface& interface, const Vectors& x, Index edge, Index base_edge, const Over& lines) {
  constexpr double small = 0.1;  // of the width of an edge across the other one: with more the lines are others
  if (is_within(lines.first) && is_within(lines.second)) return 0;
  const Vec3 L1 = along(interface.edges, x, edge), L2 = along(interface.base_edges, x, base_edge);
  const double area = L1.cross(L2).norm(), height = std::abs(lines.height);
  const auto way = [&](double place, double width, double other) {
    const double beside = std::max(-place, place - 1) - past_end;
    const double moves = 1 + std::abs(other) + std::abs(1 - other) + 4 * height / width;
    return std::min(beside * width / (2 * moves), small * width);
  };
  return std::max(way(lines.first, area / L2.norm(), lines.second), way(lines.second, area / L1.norm(), lines.first));
}

}  // namespace

Over over(const Interface& interface, const Vectors& x, Index edge, Index base_edge, bool in_face, int side) {
  Over at, lines;
  if (!between_lines(interface, x, edge, base_edge, 1, lines) || !is_within(lines.first) || !is_within(lines.second)) return at;
  for (const int sign : {1, -1}) {
    if (side != 0 && sign != side) continue;
    Over found = lines;
    found.side = sign, found.normal = sign * lines.normal, found.height = sign * lines.height;
    const Flanks flanks(interface.edges, x, edge), base_flanks(interface.base_edges, x, base_edge);
    const double first = rise(flanks, -found.normal), second = rise(base_flanks, found.normal);
    const double touches = side != 0 ? leans : bent, stands = -(side != 0 ? stays_steep : steep);
    if (!(first <= touches) || !(second <= touches)) continue;
    const bool stand = !in_face || first <= stands || second <= stands || are_ridges(interface, x, edge, base_edge) ||
                       are_crests(interface, x, edge, base_edge, found.normal, side != 0 ? 0 : slightly);
    if (!stand) continue;
    if (is_left_to_node(found.first, along(interface.edges, x, edge), base_flanks, found.normal) ||
        is_left_to_node(found.second, along(interface.base_edges, x, base_edge), flanks, -found.normal))
      continue;
    found.is = true;
    if (!at.is || found.height > at.height) at = found;
  }
  return at;
}

double stays_beside(const Interface& interface, const Vectors& x, Index edge, Index base_edge) {
  Over lines;
  return between_lines(interface, x, edge, base_edge, 1, lines) ? stays_beside(interface, x, edge, base_edge, lines) : 0;
}

double stays_flat(const Interface& interface, const Vectors& x, Index edge, Index base_edge) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool plates = of_plates(interface.edges, edge) || of_plates(interface.base_edges, base_edge);
  double way = -infinity, until_crests = plates ? -infinity : infinity;
  const auto see = [&](const Edges& of_face, Index flat, const Edges& of_ridge, Index ridge) {
    if (of_face.across(0, flat) < 0 || of_face.across(1, flat) < 0) return;
    const Vec3 first = into(of_face, x, flat, 0).normalized(), second = into(of_face, x, flat, 1).normalized();
    const Vec3 normal = along(of_face, x, flat).cross(first).normalized();
    const double fold = (first + second).norm();
    const Flanks flanks(of_ridge, x, ridge);
    const double stands = std::max(-rise(flanks, normal), -rise(flanks, -normal));
    const double turn = turn_of_facets(of_ridge, x, ridge) + 3 * turn_of_facets(of_face, x, flat);
    way = std::max(way, (steep - bent - fold - stands) / (2 * turn));
    until_crests = std::max(until_crests, (slightly - 0.5 * fold) / (2 * turn_of_facets(of_face, x, flat)));
  };
  see(interface.edges, edge, interface.base_edges, base_edge);
  see(interface.base_edges, base_edge, interface.edges, edge);
  return std::min(way, until_crests);
}

namespace {

/// Edges from `first` to `last`, of one body or of one side of a contact.
struct EdgeRange {
  Index first, last;
};

/// Lists the pairs of edges of two ranges that are nearer than `reach` to h_c; returns whether any is nearer than `asked`.
bool list_pairs(const Interface& interface, const Vectors& x, EdgeRange of_edges, EdgeRange of_base, double reach, double asked,
                Workspace& workspace) {
  std::vector<EdgeBox>&edges = workspace.edges, &base = workspace.base_edges, &ridges = workspace.base_ridges;
  const Eigen::AlignedBox3d around = box_of(interface.edges, x, of_edges.first, of_edges.last, 0.5 * asked);
  const Eigen::AlignedBox3d base_around = box_of(interface.base_edges, x, of_base.first, of_base.last, 0.5 * asked);
  list_boxes(interface.edges, x, of_edges.first, of_edges.last, 0.5 * asked, base_around, edges);
  list_boxes(interface.base_edges, x, of_base.first, of_base.last, 0.5 * asked, around, base);
  if (edges.empty() || base.empty()) return false;
  std::sort(base.begin(), base.end(),
            [](const EdgeBox& a, const EdgeBox& b) { return std::tie(a.low.x(), a.edge) < std::tie(b.low.x(), b.edge); });
  double widest = 0;
  for (const EdgeBox& box : base) widest = std::max(widest, box.high.x() - box.low.x());
  ridges.clear();
  std::copy_if(base.begin(), base.end(), std::back_inserter(ridges),
               [&](const EdgeBox& box) { return box.ridge || is_curved(interface.base_edges, x, box.edge); });
  bool is_near = false;
  for (const EdgeBox& one : edges) {
    const auto low = [](const EdgeBox& box, double value) { return box.low.x() < value; };
    const std::vector<EdgeBox>& others = one.ridge ? base : ridges;
    const bool only_ridges = !one.ridge && !is_curved(interface.edges, x, one.edge);
    for (auto other = std::lower_bound(others.begin(), others.end(), one.low.x() - widest, low); other != others.end(); ++other) {
      if (other->low.x() > one.high.x()) break;
      if ((only_ridges && !other->ridge) || !meet(one, *other) || !can_cross(interface, one.edge, other->edge)) continue;
      const auto p = ends_of(interface, x, one.edge, other->edge);
      const double squared = geometry::segments_squared(p[0], p[1], p[2], p[3]);
      if (!(squared < asked * asked)) continue;
      is_near = true;
      if (!(squared < reach * reach)) continue;
      workspace.edge_pairs.push_back({one.edge, other->edge, !one.ridge || !other->ridge,
                                      std::sqrt(squared) - height_between(interface, one.edge, other->edge)});
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

void search_crossings(const Interface& interface, const Vectors& x, Memory& memory, Workspace& workspace) {
  keep_search(interface, x, memory);
  const Index bodies = interface.bodies.count();
  std::fill(workspace.near_itself.begin(), workspace.near_itself.end(), char{0});
  const double thickest = interface.edges.half.size() > 0 ? interface.edges.half.maxCoeff() + interface.base_edges.half.maxCoeff() : 0;
  const double reach = interface.edge_height + thickest + memory.margin;
  std::vector<EdgePair>& next = workspace.edge_pairs;
  next.clear();
  if (bodies == 0) {
    const auto all = [](const Edges& edges) { return EdgeRange{0, static_cast<Index>(edges.nodes.cols())}; };
    list_pairs(interface, x, all(interface.edges), all(interface.base_edges), reach, reach, workspace);
  } else {
    find_partners(interface, x, memory, workspace);
    for (Index a = 0; a < bodies; ++a)
      for (Index i = workspace.first_partner[a]; i < workspace.first_partner[a + 1]; ++i) {
        const Index b = workspace.partners[i];
        if (b < a) continue;
        const double asked = a == b ? reach + farther_from_itself * memory.margin : reach;
        const EdgeRange one = edges_of(interface.edges, a), other = edges_of(interface.base_edges, b);
        const bool is_near = list_pairs(interface, x, one, other, reach, asked, workspace);
        if (a == b) workspace.near_itself[static_cast<std::size_t>(a)] = is_near;
      }
  }
  const bool one_pair = bodies == 0;
  if (!one_pair) keep_apart_from_itself(interface, x, workspace, memory);
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

namespace {

/// By how much the nodes of both edges go against each other in the step to come. [m]
double way_of(const Interface& interface, const Vectors& x, const Vectors& ahead, const EdgePair& pair) {
  const auto way = [&](const Edges& edges, int end, Index edge) {
    return Vec3(node_of(edges, ahead, end, edge) - node_of(edges, x, end, edge));
  };
  const Vec3 first = way(interface.edges, 0, pair.edge);
  const double squared = std::max({(way(interface.edges, 1, pair.edge) - first).squaredNorm(),
                                   (way(interface.base_edges, 0, pair.base_edge) - first).squaredNorm(),
                                   (way(interface.base_edges, 1, pair.base_edge) - first).squaredNorm()});
  return 2 * std::sqrt(squared);  // between any two
}

/// Whether one edge of a pair can come over the other in the step to come, as far as distance and lines tell. Where it cannot, and will not
/// before nodes have gone some way, the pair is left alone until then.
///
/// moved, way  [m] since the last search, and in the step to come;  passed  [m] Memory::way
bool can_come_over(const Interface& interface, const Vectors& x, const Vectors& ahead, double moved, double passed, double way,
                   EdgePair& pair) {
  if (passed + way < pair.flat) return false;
  const Between& both = between_edges(interface, pair.edge, pair.base_edge);
  const double reach = std::max(sideways * both.depth, reach_of(both, way));
  if (!(pair.apart - moved <= reach)) return false;
  Over lines;
  const bool have_normal = between_lines(interface, x, pair.edge, pair.base_edge, 1, lines);
  if (have_normal && is_within(lines.first) && is_within(lines.second)) return true;
  const auto p = ends_of(interface, x, pair.edge, pair.base_edge);
  const double distance = std::sqrt(geometry::segments_squared(p[0], p[1], p[2], p[3]));
  const double beside = have_normal ? stays_beside(interface, x, pair.edge, pair.base_edge, lines) : 0;
  const double until = std::max(beside, distance - height_between(interface, pair.edge, pair.base_edge) - reach);
  pair.flat = passed + until;
  if (until > way || until > way_of(interface, x, ahead, pair)) return false;
  return between_lines(interface, ahead, pair.edge, pair.base_edge, 1, lines) && is_within(lines.first) && is_within(lines.second);
}

/// Brings the crossings up to date, pair after pair: those that were over each other, and what can come over the other in the step to come.
///
/// moved  [m] by which edges can have come nearer since the last search
/// way    [m] by which they can in the step to come
/// over   how the edges of each stand; `is` false where they do not act
void follow_all(const Interface& interface, const Motion& m, double moved, double way, Memory& memory, std::vector<Crossing>& next,
                std::vector<Over>& over, Multipliers& all) {
  next.clear(), over.clear();
  auto was = memory.crossings.begin();
  for (EdgePair& pair : memory.edge_pairs) {
    const bool is_known = was != memory.crossings.end() && !in_order(pair, *was);
    if (is_known || can_come_over(interface, m.x, all.ahead, moved, memory.way, way, pair)) {
      Crossing crossing = is_known ? *was++ : crossing_of(pair);
      Over at;
      at.is = follow(interface, m, all, crossing, at);
      if (crossing.side != 0) {
        next.push_back(crossing), over.push_back(at);
        continue;
      }
      end(crossing.node, interface.restitution, crossing.restitution, memory, all);
      const bool is_slow = way < slow * between_edges(interface, pair.edge, pair.base_edge).depth;
      if (pair.in_face && is_slow) pair.flat = memory.way + stays_flat(interface, m.x, pair.edge, pair.base_edge);
    }
  }
  std::swap(memory.crossings, next);
}

}  // namespace

void find_crossings(const Interface& interface, const Motion& m, Memory& memory, Workspace& workspace, Multipliers& all) {
  const double h = 0.5 * (m.dt + m.next);
  const bool one_pair = interface.bodies.count() == 0;
  const double moved = one_pair ? search_where_due(interface, m.x, all.way, memory, workspace) : memory.way;
  const auto apart = [&](const Vectors& v) { return speed_apart(v, {interface.apexes, interface.base_nodes}); };
  const double way = one_pair ? m.next * apart(all.velocity) : all.way_apart;
  if (one_pair) memory.way += m.dt * apart(m.v);
  follow_all(interface, m, moved, way, memory, workspace.crossings, workspace.over, all);
  for (std::size_t i = 0; i < memory.crossings.size(); ++i) {
    Crossing& crossing = memory.crossings[i];
    const Between& pair = between_edges(interface, crossing.edge, crossing.base_edge);
    bool acts = workspace.over[i].is;
    const auto first = static_cast<Index>(all.conditions.size());
    if (acts) {
      Condition& c = begin_condition(all);
      make(interface, workspace.over[i], crossing, all, c);
      const double speed = relative(crossing, all.velocity).norm();
      acts = can_touch(pair, m, c.gap, speed) && complete(m, crossing.pressed, crossing.restitution.held, all, c);
      if (!acts) take_back(all);
    }
    if (!acts) {
      end(crossing.node, interface.restitution, crossing.restitution, memory, all);
      let_go(crossing);
      continue;
    }
    crossing.acts = true;
    Condition& c = all.conditions[first];
    c.impulse = c.met = crossing.pressed * h;
    Index friction = -1;
    if (interface.friction.coefficient > 0 && m.dt > 0) {
      const Vec3 force = crossing.friction.acts ? crossing.friction.force : Vec3(Vec3::Zero());
      friction = add_friction(touch_of(m.x, crossing), interface.friction, force, crossing.friction.stuck, m, all);
    }
    const double area = std::min(interface.edges.area(crossing.edge), interface.base_edges.area(crossing.base_edge));
    add({.memory = &crossing.restitution, .first = first, .last = first + 1, .friction = friction, .area = area, .depth = pair.depth,
         .impedance = pair.impedance * area, .square = interface.restitution * interface.restitution}, all);
  }
}

void book_first_half_of_crossings(const Motion& m, Memory& memory) {
  const double half = 0.5 * m.dt;
  for (const Crossing& crossing : memory.crossings) {
    if (!crossing.closed) continue;
    memory.work += half * crossing.push.dot(relative(crossing, m.v));
    if (!crossing.friction.acts) continue;
    memory.work += half * crossing.friction.force.dot(slip_rate(crossing.friction.touch, m.v, m.omega, m.rotation_of_node));
  }
}

void take_over_crossings(const Interface& interface, double h, double t, Index first, Index last, const Multipliers& all,
                         Memory& memory) {
  Index contactor = first;
  memory.deepest_now = 0;
  for (Crossing& crossing : memory.crossings) {
    crossing.closed = crossing.friction.acts = crossing.friction.stuck = false;
    crossing.friction.force.setZero();
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
    crossing.friction.stuck = crossing.closed && (one.friction < 0 || !all.frictions[one.friction].slides);
    if (one.friction >= 0 && crossing.closed) {
      const FrictionCondition& friction = all.frictions[one.friction];
      crossing.friction.acts = true;
      crossing.friction.touch = friction.touch;
      crossing.friction.coefficient = friction.coefficient;
      crossing.friction.force = friction.impulse / h;
      memory.force += crossing.friction.force;
    }
    const double depth = height_between(interface, crossing.edge, crossing.base_edge) - crossing.level - c.gap;
    memory.deepest_now = std::max(memory.deepest_now, depth);
    if (!(depth > memory.deepest)) continue;
    memory.deepest = depth, memory.deepest_apex = crossing.node[0], memory.deepest_time = t;
    memory.deepest_in = between_edges(interface, crossing.edge, crossing.base_edge).depth;
  }
  check(contactor == last, "every contactor of an interface of edges is a crossing");
}

}  // namespace nereid::contact
