#include "contact/multiplier/shape_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "base/check.hpp"
#include "contact/multiplier/over_facet.hpp"
#include "contact/multiplier/restitution.hpp"
#include "contact/multiplier/stick.hpp"

namespace nereid::contact {

using geometry::PlacedRound;
using geometry::Round;

namespace {

constexpr double goes_on_beside = 0.05;  // of the size of a shape: so far a point of contact may have gone to another feature in a step
constexpr double strictly = -1e-9;       // sine: a sphere touches facets, and edges and nodes only that stand out between them
constexpr double nearly = 1e-3;          // sine: sides of other shapes touch edges, also those that are as good as flat

Vec3 place_of(const Vectors& x, Index node) { return x.col(node); }

/// Nodes of a feature of another body.
struct OnFeature {
  int count = 0;
  std::array<Index, 3> node{};
};
OnFeature on_feature(const Faceted& faceted, NearKind kind, Index id) {
  OnFeature on;
  const auto add = [&](Index node) { on.node[static_cast<std::size_t>(on.count++)] = node; };
  if (kind == NearKind::node) add(faceted.nodes[static_cast<std::size_t>(id)]);
  if (kind == NearKind::edge) add(faceted.edges(0, id)), add(faceted.edges(1, id));
  if (kind == NearKind::facet)
    for (int i = 0; i < 3; ++i) add(faceted.facets(i, id));
  return on;
}

/// Whether a direction leads out of the other body at an edge or a node: no facet or edge there rises along it by more than a sine. What
/// lies behind a facet beside a feature is no place of contact.
bool leads_out(const Faceted& faceted, const NearFeature& near, const Vectors& x, const Vec3& direction, double sine) {
  const auto id = static_cast<std::size_t>(near.id);
  if (near.kind == NearKind::node) {
    const Vec3 here = x.col(faceted.nodes[id]);
    return std::none_of(faceted.beside.begin() + faceted.first_beside[id], faceted.beside.begin() + faceted.first_beside[id + 1],
                        [&](Index node) { return direction.dot(Vec3(x.col(node) - here).normalized()) > sine; });
  }
  if (near.kind != NearKind::edge) return true;
  const Vec3 a = x.col(faceted.edges(0, near.id)), along = (x.col(faceted.edges(1, near.id)) - a).normalized();
  for (int side = 0; side < 2; ++side) {
    const Index node = faceted.across(side, near.id);
    if (node < 0) continue;
    const Vec3 way = x.col(node) - a, into = (way - along.dot(way) * along).normalized();
    if (direction.dot(into) > sine) return false;
  }
  return true;
}

/// Half the thickness of plates at a node now. [m]
double half_at(const Faceted& faceted, const Memory& memory, Index node) {
  const auto at = std::lower_bound(faceted.nodes.begin(), faceted.nodes.end(), node) - faceted.nodes.begin();
  const double grown = faceted.apex.empty() || memory.thicker.empty()
                           ? 0 : memory.thicker[static_cast<std::size_t>(faceted.apex[static_cast<std::size_t>(at)])];
  return faceted.half(at) + grown;
}

/// Adds the spots of a shape over a feature at positions x.
///
/// whole  planes of facets count, and not only what is within them
void find_spots(const Interface& interface, const std::vector<PlacedRound>& placed, const NearFeature& near, const Vectors& x,
                const Memory& memory, bool whole, std::vector<Spot>& spots) {
  const ShapePair& pair = interface.shapes.pairs[static_cast<std::size_t>(near.pair)];
  const auto round = static_cast<std::size_t>(pair.round);
  const Round& shape = interface.shapes.rounds[round].shape;
  const PlacedRound& at = placed[round];
  spots.clear();
  if (near.kind == NearKind::shape) {
    const auto other = static_cast<std::size_t>(pair.other);
    return spots_between(shape, at, interface.shapes.rounds[other].shape, placed[other], spots);
  }
  const Faceted& faceted = interface.shapes.faceted[static_cast<std::size_t>(pair.faceted)];
  const OnFeature on = on_feature(faceted, near.kind, near.id);
  if (near.kind == NearKind::node) {
    const Vec3 p = x.col(on.node[0]);
    const geometry::OverRound over = geometry::over_round(shape, at, p);
    spots.push_back({.part = 0, .gap = over.distance, .normal = over.normal, .place = p, .weight = {1, 0, 0}});
  } else if (near.kind == NearKind::edge) {
    spots_on_edge(shape, at, {place_of(x, on.node[0]), place_of(x, on.node[1])}, spots);
  } else {
    const bool is_plate = faceted.is_plate[static_cast<std::size_t>(near.id)] != 0;
    spots_on_facet(shape, at, {place_of(x, on.node[0]), place_of(x, on.node[1]), place_of(x, on.node[2])}, is_plate, whole, spots);
  }
  const double sine = shape.kind == geometry::RoundKind::sphere ? strictly : nearly;
  if (!whole)
    std::erase_if(spots, [&](const Spot& spot) { return !leads_out(faceted, near, x, -spot.normal, sine); });
  for (Spot& spot : spots)
    for (int j = 0; j < on.count; ++j)
      spot.gap -= spot.weight[static_cast<std::size_t>(j)] * half_at(faceted, memory, on.node[static_cast<std::size_t>(j)]);
}

/// The spot that goes on from another one: with its part, or of a rim the minimum that is nearest to it. Null if there is none.
const Spot* same_spot(const Spot& spot, bool between_shapes, const std::vector<Spot>& spots) {
  const Spot* best = nullptr;
  double least = infinite;
  const bool is_minimum = between_shapes && spot.part >= 0 && spot.part % parts_of_rim < first_sample;
  for (const Spot& one : spots) {
    if (!is_minimum && one.part == spot.part) return &one;
    const bool alike = is_minimum && one.part >= 0 && one.part / parts_of_rim == spot.part / parts_of_rim &&
                       one.part % parts_of_rim < first_sample;
    if (!alike) continue;
    const double apart = (one.place - spot.place).squaredNorm();
    if (apart < least) least = apart, best = &one;
  }
  return best;
}

/// Gives a point the four nodes of a shape, with weights for its place.
void add_anchors(const mesh::RoundBody& round, const PlacedRound& at, double sign, ShapePoint& point) {
  const Eigen::Vector4d rubs = mesh::weights_at(round, at, point.place);
  const Vec3 on_line = point.place + point.normal.dot(at.centre - point.place) * point.normal;
  const Eigen::Vector4d weight = mesh::weights_at(round, at, on_line);
  for (int k = 0; k < 4; ++k) {
    const auto place = static_cast<std::size_t>(point.nodes++);
    point.node[place] = round.anchor[static_cast<std::size_t>(k)];
    point.weight[place] = sign * weight(k), point.rub_weight[place] = sign * rubs(k);
  }
}

/// Sets nodes, weights, normal and place of a point at positions x.
void set_point(const Interface& interface, const std::vector<PlacedRound>& placed, const NearFeature& near, const Spot& spot,
               const Vectors& x, ShapePoint& point) {
  const ShapePair& pair = interface.shapes.pairs[static_cast<std::size_t>(near.pair)];
  point.pair = near.pair, point.kind = near.kind, point.id = near.id, point.part = spot.part;
  point.normal = -pair.side * spot.normal, point.place = spot.place;
  point.gap = spot.gap;
  point.area = point.loaded = pair.area;
  if (near.kind == NearKind::shape) {
    const auto other = static_cast<std::size_t>(pair.other);
    add_anchors(interface.shapes.rounds[other], placed[other], -pair.side, point);
  } else {
    const Faceted& faceted = interface.shapes.faceted[static_cast<std::size_t>(pair.faceted)];
    const OnFeature on = on_feature(faceted, near.kind, near.id);
    for (int j = 0; j < on.count; ++j) {
      const auto at = static_cast<std::size_t>(j), place = static_cast<std::size_t>(point.nodes++);
      point.node[place] = on.node[at], point.weight[place] = point.rub_weight[place] = -pair.side * spot.weight[at];
    }
    if (near.kind == NearKind::node)  // the shape pushes the node along the normal of the spot
      point.area = faceted.area(near.id), point.loaded = mesh::tributary_area_loaded(faceted.faces, x, near.id, spot.normal, point.area);
  }
  const auto round = static_cast<std::size_t>(pair.round);
  add_anchors(interface.shapes.rounds[round], placed[round], pair.side, point);
}

/// The order of points: as their features are listed.
auto key(const ShapePoint& point) { return std::tie(point.pair, point.kind, point.id, point.part); }
bool is_before(const ShapePoint& a, const ShapePoint& b) { return key(a) < key(b); }

/// Gives new points what those of the step before remember: of the same feature, or of the nearest one of the pair that pressed. What
/// ended goes to the others of its shape.
template <class Ended>
void take_over_memories(double size, std::vector<ShapePoint>& before, std::vector<ShapePoint>& next, Ended&& ended) {
  std::vector<char> taken(before.size(), 0), known(next.size(), 0);
  const auto copy = [&](const ShapePoint& from, ShapePoint& to) {
    to.pressed = from.pressed, to.friction = from.friction, to.stuck = from.stuck, to.closed = from.closed, to.rubs = from.rubs;
    to.restitution = from.restitution;
  };
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto at = std::lower_bound(before.begin(), before.end(), next[i], is_before);
    if (at == before.end() || key(*at) != key(next[i])) continue;
    copy(*at, next[i]);
    taken[static_cast<std::size_t>(at - before.begin())] = known[i] = 1;
  }
  for (std::size_t b = 0; b < before.size(); ++b) {
    if (taken[b] != 0 || !(before[b].pressed > 0 || before[b].restitution.held != 0)) continue;
    std::size_t best = next.size();
    double least = goes_on_beside * size;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (known[i] != 0 || next[i].pair != before[b].pair) continue;
      const double apart = (next[i].place - before[b].place).norm();
      if (apart < least) least = apart, best = i;
    }
    if (best < next.size()) copy(before[b], next[best]), taken[b] = known[best] = 1;
  }
  for (std::size_t b = 0; b < before.size(); ++b)
    if (taken[b] == 0) ended(before[b]);
}

/// Ends the memory of a point: what it holds goes to where its shape touches else.
template <class Contact, class Memory>
void end_point(const Contact& contact, ShapePoint& point, Memory& memory, Multipliers& all) {
  const std::span<const Index> nodes(point.node.data() + point.nodes - 4, 4);
  end(nodes, contact.restitution, point.restitution, memory, all);
}

/// Adds the condition of a point with its friction; false where constraints hold all of it.
template <class Contact>
bool add_condition(const Contact& contact, const Between& pair, const Motion& m, ShapePoint& point, Multipliers& all) {
  const double h = 0.5 * (m.dt + m.next);
  const auto first = static_cast<Index>(all.conditions.size());
  Condition& c = begin_condition(all);
  const double ends = (point.gap > 0 ? point.gap : corrected * point.gap) + point.curved;  // of a penetration a part is taken back
  c.normal = point.normal, c.gap = ends > 0 ? ends : ends / corrected;
  const int own = point.nodes - 4;
  for (int j = 0; j < point.nodes; ++j) {
    const auto at = static_cast<std::size_t>(j);
    // the sign of a weight tells the side, also where that of a point outside of the four nodes is another one
    const bool is_apex = point.weight[static_cast<std::size_t>(own)] + point.weight[static_cast<std::size_t>(own + 1)] +
                             point.weight[static_cast<std::size_t>(own + 2)] + point.weight[static_cast<std::size_t>(own + 3)] > 0
                             ? j >= own : j < own;
    const double size = std::abs(point.weight[at]);
    add_member(point.node[at], is_apex ? size : -size, point.weight[at] * c.normal, all, c);
  }
  if (!complete(m, m.dt > 0 ? point.pressed : 0, point.restitution.held, all, all, c)) {
    take_back(all);
    return false;
  }
  // what a curve takes back of the approach before makes no energy, and is no penetration
  c.least = std::max(c.least, std::min({-ends, -point.curved, -m.next * c.before}) / m.next);
  c.impulse = c.met = m.dt > 0 ? point.pressed * h : 0;
  Index friction = -1;
  if (contact.friction.coefficient > 0 && m.dt > 0)
    friction = add_friction(touch_of(point), contact.friction, point.friction, point.stuck, m, all.frictions);
  add({.memory = &point.restitution, .first = first, .last = first + 1, .friction = friction, .area = point.area, .depth = pair.depth,
       .impedance = pair.impedance * point.loaded, .square = contact.restitution * contact.restitution}, all);
  return true;
}

/// Adds the conditions of points, and ends those that have none.
template <class Contact, class Memory, class PairOf>
void add_conditions(const Contact& contact, const Motion& m, double size, std::vector<ShapePoint>& before, std::vector<ShapePoint>& next,
                    PairOf&& pair_of, Memory& memory, Multipliers& all) {
  take_over_memories(size, before, next, [&](ShapePoint& gone) { end_point(contact, gone, memory, all); });
  std::swap(before, next);
  for (ShapePoint& point : before) {
    const Between& pair = pair_of(point);
    const double speed = relative(point, all.velocity).norm();
    point.acts = (point.pressed > 0 || can_touch(pair, m, point.gap, speed)) && add_condition(contact, pair, m, point, all);
    if (!point.acts) end_point(contact, point, memory, all);
  }
  std::erase_if(before, [](const ShapePoint& point) { return !point.acts; });
  Index last = static_cast<Index>(all.contactors.size());  // points have moved
  for (auto point = before.rbegin(); point != before.rend(); ++point) 
    all.contactors[static_cast<std::size_t>(--last)].memory = &point->restitution;
}

/// What a gap at the end of a step without multipliers has beyond what its rate tells, as where the centre of a ball goes along a bowl. [m]
double curved_by(const ShapePoint& point, double now, double at_end, double next, const Multipliers& all) {
  return at_end - now - next * point.normal.dot(relative(point, all.velocity));
}

/// Whether a point can be left out before its memory is looked up: far, and not near in the step before.
bool is_far(const Between& pair, const Motion& m, const ShapePoint& point, const Multipliers& all) {
  return !can_touch(pair, m, point.gap, relative(point, all.velocity).norm());
}

/// The size of the largest of some shapes. [m]
double largest_of(const std::vector<mesh::RoundBody>& rounds) {
  double most = 0;
  for (const mesh::RoundBody& round : rounds) most = std::max(most, geometry::reach(round.shape));
  return most;
}

bool pressed_before(const std::vector<ShapePoint>& before, const ShapePoint& point) {
  const auto at = std::lower_bound(before.begin(), before.end(), point, is_before);
  return at != before.end() && key(*at) == key(point) && at->pressed > 0;
}

/// Takes the impulse of a contactor into a point as a force.
void take_over_point(double h, const Contactor& one, const Multipliers& all, ShapePoint& point) {
  const Condition& c = all.conditions[static_cast<std::size_t>(one.first)];
  point.closed = c.impulse > 0;
  point.pressed = c.impulse / h;
  point.rubs = point.closed && one.friction >= 0;
  point.stuck = point.closed && (one.friction < 0 || !all.frictions[static_cast<std::size_t>(one.friction)].slides);
  point.friction.setZero();
  if (!point.rubs) return;
  const FrictionCondition& friction = all.frictions[static_cast<std::size_t>(one.friction)];
  point.friction = friction.impulse / h, point.coefficient = friction.coefficient;
}

/// The force of a point on the side of the apexes. [N]
Vec3 force_of(const ShapePoint& point) { return point.pressed * point.normal + point.friction; }

/// The power of a point with the velocities of the step that led to t. [W]
double power_of(const ShapePoint& point, const Motion& m) {
  const double rubs = point.rubs ? point.friction.dot(slip_rate(touch_of(point), m.v, m.omega, m.rotation_of_node)) : 0;
  return point.pressed * point.normal.dot(relative(point, m.v)) + rubs;
}

/// Books a force of a plane in half of a step, as of one that acts on nodes where they were `later` [s] after t.
void book_half(const Motion& m, double later, const ShapePoint& point, PlaneMemory& memory) {
  if (!point.closed) return;
  const double half = 0.5 * m.dt;
  memory.work += half * power_of(point, m);
  memory.impulse += half * force_of(point);
  for (int j = 0; j < point.nodes; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const Vec3 x = m.x.col(point.node[at]) + later * m.v.col(point.node[at]);
    memory.angular_impulse += half * x.cross(point.weight[at] * point.pressed * point.normal + point.rub_weight[at] * point.friction);
  }
}

}  // namespace

void find_shape_conditions(const Interface& interface, const Motion& m, Memory& memory, Multipliers& all) {
  if (interface.shapes.pairs.empty()) return;
  const Shapes& shapes = interface.shapes;
  const std::vector<PlacedRound> now = placed_all(shapes.rounds, m.x), ahead = placed_all(shapes.rounds, all.ahead);
  std::vector<ShapePoint> next;
  std::vector<Spot> spots, at_end;
  std::vector<double> least(shapes.pairs.size(), 0);
  memory.shape_overlap.resize(shapes.pairs.size(), 0);
  for (const NearFeature& near : memory.near_shapes) {
    const ShapePair& pair = shapes.pairs[static_cast<std::size_t>(near.pair)];
    double& overlap = memory.shape_overlap[static_cast<std::size_t>(near.pair)];
    find_spots(interface, now, near, m.x, memory, false, spots);
    bool looked = false;
    for (const Spot& spot : spots) {
      ShapePoint point;
      set_point(interface, now, near, spot, m.x, point);
      least[static_cast<std::size_t>(near.pair)] = std::min(least[static_cast<std::size_t>(near.pair)], point.gap);
      point.gap -= overlap;
      if (is_far(pair.between, m, point, all) && !pressed_before(memory.shape_points, point)) continue;
      if (m.dt > 0) {
        if (!looked) find_spots(interface, ahead, near, all.ahead, memory, true, at_end), looked = true;
        if (const Spot* then = same_spot(spot, near.kind == NearKind::shape, at_end))
          point.curved = curved_by(point, spot.gap, then->gap, m.next, all);
      }
      next.push_back(point);
    }
  }
  for (std::size_t p = 0; p < least.size(); ++p)
    memory.shape_overlap[p] = std::max(memory.shape_overlap[p], least[p]);  // what has parted does not come back
  add_conditions(interface, m, largest_of(shapes.rounds), memory.shape_points, next,
                 [&](const ShapePoint& point) -> const Between& { return shapes.pairs[static_cast<std::size_t>(point.pair)].between; },
                 memory, all);
}

void find_shape_conditions(const RigidPlane& plane, const Motion& m, PlaneMemory& memory, Multipliers& all) {
  if (plane.rounds.empty()) return;
  const std::vector<PlacedRound> now = placed_all(plane.rounds, m.x), ahead = placed_all(plane.rounds, all.ahead);
  Between between;
  between.depth = plane.depth, between.impedance = plane.impedance;
  std::vector<ShapePoint> next;
  std::vector<Spot> spots, at_end;
  for (std::size_t r = 0; r < plane.rounds.size(); ++r) {
    spots.clear(), at_end.clear();
    spots_on_plane(plane.rounds[r].shape, now[r], plane.point, plane.normal, spots);
    spots_on_plane(plane.rounds[r].shape, ahead[r], plane.point, plane.normal, at_end);
    for (const Spot& spot : spots) {
      ShapePoint point;
      point.pair = static_cast<Index>(r), point.kind = NearKind::shape, point.part = spot.part;
      point.normal = plane.normal, point.place = spot.place;
      point.gap = spot.gap;
      point.area = point.loaded = plane.round_area;
      add_anchors(plane.rounds[r], now[r], 1, point);
      if (is_far(between, m, point, all) && !pressed_before(memory.shape_points, point)) continue;
      const Spot* then = m.dt > 0 ? same_spot(spot, false, at_end) : nullptr;
      if (then != nullptr) point.curved = curved_by(point, spot.gap, then->gap, m.next, all);
      next.push_back(point);
    }
  }
  std::sort(next.begin(), next.end(), is_before);
  add_conditions(plane, m, largest_of(plane.rounds), memory.shape_points, next,
                 [&](const ShapePoint&) -> const Between& { return between; }, memory, all);
}

void book_first_half_of_shapes(const Motion& m, Memory& memory) {
  const double half = 0.5 * m.dt;
  for (const ShapePoint& point : memory.shape_points)
    if (point.closed) memory.work += half * power_of(point, m);
}

void book_first_half_of_shapes(const Motion& m, PlaneMemory& memory) {
  for (const ShapePoint& point : memory.shape_points) book_half(m, -m.dt, point, memory);
}

void take_over_shapes(const Interface& interface, double h, double t, Index last, const Multipliers& all, Memory& memory) {
  Index contactor = last - count_acting(memory.shape_points);
  for (ShapePoint& point : memory.shape_points) {
    take_over_point(h, all.contactors[static_cast<std::size_t>(contactor++)], all, point);
    memory.force += force_of(point);
    memory.deepest_now = std::max(memory.deepest_now, -point.gap);
    if (!(-point.gap > memory.deepest)) continue;
    memory.deepest = -point.gap, memory.deepest_apex = point.node[0], memory.deepest_time = t;
    memory.deepest_in = interface.shapes.pairs[static_cast<std::size_t>(point.pair)].between.depth;
  }
}

void take_over_shapes(const RigidPlane&, const Motion& m, double h, double t, Index last, const Multipliers& all, PlaneMemory& memory) {
  Index contactor = last - count_acting(memory.shape_points);
  for (ShapePoint& point : memory.shape_points) {
    take_over_point(h, all.contactors[static_cast<std::size_t>(contactor++)], all, point);
    book_half(m, 0, point, memory);
    if (-point.gap > memory.deepest) memory.deepest = -point.gap, memory.deepest_node = point.node[0], memory.deepest_time = t;
  }
}

double least_gap_of_shapes(const Interface& interface, const Vectors& x, const Memory& memory) {
  double least = std::numeric_limits<double>::quiet_NaN();
  const std::vector<PlacedRound> placed = placed_all(interface.shapes.rounds, x);
  std::vector<Spot> spots;
  for (const NearFeature& near : memory.near_shapes) {
    find_spots(interface, placed, near, x, memory, false, spots);
    for (const Spot& spot : spots)
      if (!(spot.gap >= least)) least = spot.gap;
  }
  return least;
}

void add_gaps_of_shapes(const Interface& interface, const Vectors& x, bool accepts, Memory& memory, InitialGaps& gaps) {
  const Shapes& shapes = interface.shapes;
  memory.shape_overlap.assign(shapes.pairs.size(), 0);
  const std::vector<PlacedRound> placed = placed_all(shapes.rounds, x);
  std::vector<Spot> spots;
  std::vector<double> least(shapes.pairs.size(), infinite);
  std::vector<Index> inside(shapes.pairs.size(), 0);
  for (const NearFeature& near : memory.near_shapes) {
    find_spots(interface, placed, near, x, memory, false, spots);
    const auto p = static_cast<std::size_t>(near.pair);
    for (const Spot& spot : spots) least[p] = std::min(least[p], spot.gap), inside[p] += spot.gap < 0;
  }
  for (std::size_t p = 0; p < least.size(); ++p) {
    const ShapePair& pair = shapes.pairs[p];
    if (std::isinf(least[p])) continue;
    const bool first = gaps.apexes == gaps.without_base + gaps.behind;
    ++gaps.apexes;
    gaps.least = first ? least[p] : std::min(gaps.least, least[p]), gaps.largest = first ? least[p] : std::max(gaps.largest, least[p]);
    gaps.mean += (least[p] - gaps.mean) / gaps.apexes;
    if (!(least[p] < 0)) continue;
    const double depth = -least[p], size = geometry::reach(shapes.rounds[static_cast<std::size_t>(pair.round)].shape);
    const double round_off = 1e-12 * (size + x.col(shapes.rounds[static_cast<std::size_t>(pair.round)].anchor[0]).norm());
    const bool is_slight = depth <= std::max(round_off, slight * pair.between.depth);
    if (is_slight && depth > round_off) {
      const auto [one, other] = std::minmax(pair.body, pair.other_body);
      gaps.slight_overlaps.push_back({.apex_body = one, .base_body = other, .count = inside[p], .deepest = depth});
    }
    if (is_slight || accepts) memory.shape_overlap[p] = least[p];
    if (is_slight) continue;
    gaps.penetrating += inside[p];
    gaps.deepest = std::max(gaps.deepest, depth);
  }
}

}  // namespace nereid::contact
