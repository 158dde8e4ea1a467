#include "mesh/adjacency.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/check.hpp"
#include "mesh/facets.hpp"

namespace nereid::mesh {

namespace {

constexpr double same_place = 1e-9;  // [rad] facets that are nearer lie on each other

struct Place {
  Index facet;
  int edge;
};
using Directed = std::map<std::pair<Index, Index>, std::vector<Place>>;  // facets by the ends of their edges, in their order

Directed directed_edges(const Table<3>& facets) {
  Directed all;
  for (Index f = 0; f < facets.cols(); ++f)
    for (int e = 0; e < 3; ++e) all[{facets(e, f), facets((e + 1) % 3, f)}].push_back({f, e});
  return all;
}

/// The way in a facet from an edge to its third node, across the edge. [m]
Vec3 into(const Vectors& X, const Table<3>& facets, const Place& at) {
  const Vec3 from = X.col(facets(at.edge, at.facet)), L = X.col(facets((at.edge + 1) % 3, at.facet)) - from;
  const Vec3 way = X.col(facets((at.edge + 2) % 3, at.facet)) - from;
  return way - way.dot(L) / L.squaredNorm() * L;
}

/// The angle around a common edge from a facet to another one, in front of the first. [rad] above 0, up to a whole turn
double turn(const Vectors& X, const Table<3>& facets, const Place& from, const Place& to) {
  const Vec3 L = X.col(facets((from.edge + 1) % 3, from.facet)) - X.col(facets(from.edge, from.facet));
  const Vec3 along = into(X, facets, from), up = L.cross(along).normalized() * along.norm(), there = into(X, facets, to);
  const double angle = std::atan2(there.dot(up), there.dot(along));
  return angle > same_place ? angle : angle + 2 * std::numbers::pi;
}

}  // namespace

Table<3> both_sides(const Table<3>& facets) {
  Table<3> both(3, 2 * facets.cols());
  both << facets, reversed(facets);
  return both;
}

bool goes_on(const Table<3>& facets) {
  const Directed all = directed_edges(facets);
  return std::all_of(all.begin(), all.end(), [&](const auto& edge) {
    const auto back = all.find({edge.first.second, edge.first.first});
    return edge.second.size() == 1 ? back == all.end() || back->second.size() == 1
                                   : back != all.end() && back->second.size() == edge.second.size();
  });
}

std::vector<Index> other_sides(const Table<3>& facets) {
  std::map<std::array<Index, 3>, Index> seen;  // by nodes, from the least one on in their order
  const auto in_order = [](Index a, Index b, Index c) {
    return a < b && a < c ? std::array{a, b, c} : b < c ? std::array{b, c, a} : std::array{c, a, b};
  };
  for (Index f = 0; f < facets.cols(); ++f) seen[in_order(facets(0, f), facets(1, f), facets(2, f))] = f;
  std::vector<Index> others(static_cast<std::size_t>(facets.cols()), -1);
  for (Index f = 0; f < facets.cols(); ++f) {
    const auto other = seen.find(in_order(facets(1, f), facets(0, f), facets(2, f)));
    if (other != seen.end()) others[static_cast<std::size_t>(f)] = other->second;
  }
  return others;
}

bool has_both_sides(const Table<3>& facets) {
  const std::vector<Index> others = other_sides(facets);
  return std::any_of(others.begin(), others.end(), [](Index other) { return other >= 0; });
}

Table<3> neighbours(const Vectors& X, const Table<3>& facets) {
  check(goes_on(facets), "an edge of a surface belongs to two facets in the same direction");
  const Directed all = directed_edges(facets);
  Table<3> across = Table<3>::Constant(3, facets.cols(), -1);
  for (const auto& [ends, here] : all) {
    const auto back = all.find({ends.second, ends.first});
    if (back == all.end()) continue;
    for (const Place& one : here) {
      const Place* first = &back->second.front();
      for (const Place& other : back->second)
        if (&other != first && turn(X, facets, one, other) < turn(X, facets, one, *first)) first = &other;
      across(one.edge, one.facet) = first->facet;
    }
  }
  return across;
}

}  // namespace nereid::mesh
