#include "contact/tracking/edge_over_edge.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/search/edge_pairs.hpp"
#include "geometry/crossing.hpp"

namespace nereid::contact {

namespace {

constexpr double parallel = 1e-3;    // sine between edges: with less, an edge 1 m long is over the other where its nodes are, within 1 mm
constexpr double bent = 0.05;        // sine: bodies bend, and a face that lies on an edge may rise by so much above it
constexpr double steep = 0.2;        // sine: so far a ridge stands up that is held off edges in a face; flatter ones come in by a fifth
constexpr double stays_steep = 0.1;  // the same while they are over each other
constexpr double slightly = 0.02;    // sine: so far facets must fall away from an edge in the mean where one edge is of a plate
constexpr double leans = 0.3;        // sine: the same while they are over each other, so that none goes through as a face leans to and fro
constexpr double past_end = 1e-6;    // of an edge: two that follow one another have no gap
constexpr double left_to_nodes = 0.02;  // of an edge at its ends, where it lies in a face of the other body: its node is over that

/// The mean sine by which the facets at an edge fall away from a direction.
double mean_fall(const Edges& edges, const Vectors& x, Index edge, const Vec3& direction) {
  const Flanks flanks(edges, x, edge);
  double sum = 0;
  for (int i = 0; i < flanks.count; ++i) sum -= flanks.into[static_cast<std::size_t>(i)].dot(direction);
  return sum / flanks.count;
}

/// Whether both edges, of which one is of a plate, stand up off each other: the facets at both fall away by `least` in the mean.
bool are_crests(const EdgeContact& contact, const Vectors& x, Index edge, Index base_edge, const Vec3& normal, double least) {
  return (of_plates(contact.edges, edge) || of_plates(contact.base_edges, base_edge)) &&
         mean_fall(contact.edges, x, edge, -normal) >= least && mean_fall(contact.base_edges, x, base_edge, normal) >= least;
}

/// Whether what lies from an edge along a way is over a facet at it that does not fall away from a direction. Such a facet reaches a little
/// past the edge where this is a wall, as for nodes.
bool is_under(const Flanks& flanks, const Vec3& way, const Vec3& direction) {
  const bool is_wall = flanks.count < 2 || flanks.into[0].dot(flanks.into[1]) > -far_turn;
  for (std::size_t i = 0; i < static_cast<std::size_t>(flanks.count); ++i)
    if ((is_wall || flanks.into[i].dot(way) > 0) && !(flanks.into[i].dot(direction) <= -bent)) return true;
  return false;
}

/// Whether a place on an edge is so near an end of it that its node is over a face of the other edge, which leaves it to the node.
///
/// along      from the first node of the edge to the second
/// direction  out of the other edge
bool is_left_to_node(double place, const Vec3& along, const Flanks& other, const Vec3& direction) {
  return (place < left_to_nodes && is_under(other, -along, direction)) || (place > 1 - left_to_nodes && is_under(other, along, direction));
}

}  // namespace

bool are_ridges(const EdgeContact& contact, const Vectors& x, Index edge, Index base_edge) {
  return is_ridge(contact.edges, x, edge) && is_ridge(contact.base_edges, x, base_edge);
}

bool is_within(double place) { return place >= -past_end && place <= 1 + past_end; }

bool between_lines(const EdgeContact& contact, const Vectors& x, Index edge, Index base_edge, int side, Over& at) {
  const auto p = ends_of(contact, x, edge, base_edge);
  const Vector<double> L1 = p[1] - p[0], L2 = p[3] - p[2];
  if (!(norm(cross(L1, L2)) > parallel * norm(L1) * norm(L2))) return false;
  const geometry::Crossing<double> lines = geometry::crossing(p[0], p[1], p[2], p[3]);
  at = {.is = false, .side = side, .normal = side * eigen(lines.normal), .height = side * lines.height, .first = lines.first,
        .second = lines.second};
  return true;
}

bool meet_beside(const EdgeContact& contact, const Vectors& x, const Vectors& ahead, Index edge, Index base_edge, double part) {
  const auto now = ends_of(contact, x, edge, base_edge), later = ends_of(contact, ahead, edge, base_edge);
  const auto are_beside = [&](double t) {
    const auto end = [&](std::size_t i) { return (1 - t) * now[i] + t * later[i]; };
    const geometry::Crossing<double> lines = geometry::crossing(end(0), end(1), end(2), end(3));
    return lines.first < 0 || lines.first > 1 || lines.second < 0 || lines.second > 1;
  };
  return !are_beside(0) && are_beside(part);
}

double stays_beside(const EdgeContact& contact, const Vectors& x, Index edge, Index base_edge, const Over& lines) {
  constexpr double small = 0.1;  // of the width of an edge across the other one: with more the lines are others
  if (is_within(lines.first) && is_within(lines.second)) return 0;
  const Vec3 L1 = along(contact.edges, x, edge), L2 = along(contact.base_edges, x, base_edge);
  const double area = L1.cross(L2).norm(), height = std::abs(lines.height);
  const auto way = [&](double place, double width, double other) {
    const double beside = std::max(-place, place - 1) - past_end;
    const double moves = 1 + std::abs(other) + std::abs(1 - other) + 4 * height / width;
    return std::min(beside * width / (2 * moves), small * width);
  };
  return std::max(way(lines.first, area / L2.norm(), lines.second), way(lines.second, area / L1.norm(), lines.first));
}

Over over(const EdgeContact& contact, const Vectors& x, Index edge, Index base_edge, bool in_face, int side) {
  Over at, lines;
  if (!between_lines(contact, x, edge, base_edge, 1, lines) || !is_within(lines.first) || !is_within(lines.second)) return at;
  for (const int sign : {1, -1}) {
    if (side != 0 && sign != side) continue;
    Over found = lines;
    found.side = sign, found.normal = sign * lines.normal, found.height = sign * lines.height;
    const Flanks flanks(contact.edges, x, edge), base_flanks(contact.base_edges, x, base_edge);
    const double first = rise(flanks, -found.normal), second = rise(base_flanks, found.normal);
    const double touches = side != 0 ? leans : bent, stands = -(side != 0 ? stays_steep : steep);
    if (!(first <= touches) || !(second <= touches)) continue;
    const bool stand = !in_face || first <= stands || second <= stands || are_ridges(contact, x, edge, base_edge) ||
                       are_crests(contact, x, edge, base_edge, found.normal, side != 0 ? 0 : slightly);
    if (!stand) continue;
    if (is_left_to_node(found.first, along(contact.edges, x, edge), base_flanks, found.normal) ||
        is_left_to_node(found.second, along(contact.base_edges, x, base_edge), flanks, -found.normal))
      continue;
    found.is = true;
    if (!at.is || found.height > at.height) at = found;
  }
  return at;
}

double stays_beside(const EdgeContact& contact, const Vectors& x, Index edge, Index base_edge) {
  Over lines;
  return between_lines(contact, x, edge, base_edge, 1, lines) ? stays_beside(contact, x, edge, base_edge, lines) : 0;
}

double stays_flat(const EdgeContact& contact, const Vectors& x, Index edge, Index base_edge) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool plates = of_plates(contact.edges, edge) || of_plates(contact.base_edges, base_edge);
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
  see(contact.edges, edge, contact.base_edges, base_edge);
  see(contact.base_edges, base_edge, contact.edges, edge);
  return std::min(way, until_crests);
}

}  // namespace nereid::contact
