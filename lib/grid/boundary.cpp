#include "grid/boundary.hpp"

#include <algorithm>

#include "mesh/facets.hpp"
#include "mesh/skin.hpp"

namespace nereid::grid {
namespace {

template <class Use>
void each_triple(const std::array<Index, 4>& face, Use&& use) {
  if (face[3] < 0) return use(Corners{face[0], face[1], face[2]});
  for (int without = 0; without < 4; ++without) use(corners(face[(without + 1) % 4], face[(without + 2) % 4], face[(without + 3) % 4]));
}

}  // namespace

Corners corners(Index a, Index b, Index c) {
  Corners made{a, b, c};
  std::sort(made.begin(), made.end());
  return made;
}

FacesOfSolids::FacesOfSolids(const std::vector<std::array<Index, 8>>& hexahedra) {
  for (const auto& nodes : hexahedra)
    for (const auto& at : mesh::corners_of_faces) {
      std::array<Index, 4> face{nodes[at[0]], nodes[at[1]], nodes[at[2]], nodes[at[3]]};
      const auto lowest = std::min_element(face.begin(), face.end());
      const Index across = face[static_cast<std::size_t>((lowest - face.begin() + 2) % 4)];
      std::sort(face.begin(), face.end());
      const auto end = std::unique(face.begin(), face.end());  // two corners in one at the axis of a sector
      if (end - face.begin() < 3) continue;
      std::fill(end, face.end(), -1);
      const int opposite = face[3] < 0 ? 0 : static_cast<int>(std::find(face.begin(), face.end(), across) - face.begin());
      each_triple(face, [&](const Corners& one) { triples_.push_back({one, face, opposite}); });
    }
  std::sort(triples_.begin(), triples_.end());
  triples_.erase(std::unique(triples_.begin(), triples_.end()), triples_.end());
}

bool FacesOfSolids::has(const Corners& one) const {
  const auto at = std::lower_bound(triples_.begin(), triples_.end(), first_of(one));
  return at != triples_.end() && at->corners == one;
}

bool FacesOfSolids::is_covered(const Corners& one, const std::set<Corners>& part) const {
  for (auto at = std::lower_bound(triples_.begin(), triples_.end(), first_of(one)); at != triples_.end() && at->corners == one; ++at) {
    const auto& face = at->face;
    if (face[3] < 0) return true;
    const auto place = [&](Index node) { return std::find(face.begin(), face.end(), node) - face.begin(); };
    const auto left_out = 6 - place(one[0]) - place(one[1]) - place(one[2]);  // of the places 0 + 1 + 2 + 3
    const std::array<int, 2> first{0, at->opposite};
    std::array<int, 2> second{-1, -1};
    for (int i = 1, to = 0; i < 4; ++i)
      if (i != at->opposite) second[static_cast<std::size_t>(to++)] = i;
    const auto across = [&](const std::array<int, 2>& diagonal) {
      return diagonal[0] == left_out ? diagonal[1] : diagonal[1] == left_out ? diagonal[0] : -1;
    };
    const int other = std::max(across(first), across(second));
    Corners rest{};
    for (int i = 0, to = 0; i < 4; ++i)
      if (i != other) rest[static_cast<std::size_t>(to++)] = face[static_cast<std::size_t>(i)];
    if (part.count(rest) > 0) return true;
  }
  return false;
}

void FacesOfSolids::add_to(Boundary& boundary, const Corners& one) const {
  for (auto at = std::lower_bound(triples_.begin(), triples_.end(), first_of(one)); at != triples_.end() && at->corners == one; ++at)
    each_triple(at->face, [&](const Corners& triple) { boundary.faces.insert(triple); });
}

void renumber(Boundary& boundary, const std::vector<Index>& number) {
  std::set<Corners> faces;
  const auto now = [&](Index node) { return number[static_cast<std::size_t>(node)]; };
  for (const Corners& one : boundary.faces) faces.insert({now(one[0]), now(one[1]), now(one[2])});
  boundary.faces = std::move(faces);
}

Table<3> facets_on(const Table<3>& facets, const Boundary& boundary) {
  mesh::Facets on;
  for (const auto& f : facets.colwise())
    if (boundary.faces.count(corners(f(0), f(1), f(2))) > 0) on.add(f(0), f(1), f(2));
  return on.table();
}

Subset nodes_on(const Boundary& boundary) {
  std::set<Index> nodes;
  for (const Corners& face : boundary.faces) nodes.insert(face.begin(), face.end());
  return {nodes.begin(), nodes.end()};
}

}  // namespace nereid::grid
