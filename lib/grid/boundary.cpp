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
      const std::array<Index, 4> ring{nodes[at[0]], nodes[at[1]], nodes[at[2]], nodes[at[3]]};
      std::array<Index, 4> face = ring;
      std::sort(face.begin(), face.end());
      const auto end = std::unique(face.begin(), face.end());  // two corners in one at the axis of a sector
      if (end - face.begin() < 3) continue;
      std::fill(end, face.end(), -1);
      if (face[3] < 0) triples_.push_back({{face[0], face[1], face[2]}, face, {-1, -1, -1}});
      for (std::size_t i = 0; i < 4 && face[3] >= 0; ++i) {
        const Index before = ring[i], here = ring[(i + 1) % 4], behind = ring[(i + 2) % 4], across = ring[(i + 3) % 4];
        triples_.push_back({corners(before, here, behind), face, corners(before, across, behind)});
      }
    }
  std::sort(triples_.begin(), triples_.end());
  triples_.erase(std::unique(triples_.begin(), triples_.end()), triples_.end());
}

bool FacesOfSolids::has(const Corners& one) const {
  const auto at = std::lower_bound(triples_.begin(), triples_.end(), first_of(one));
  return at != triples_.end() && at->corners == one;
}

bool FacesOfSolids::is_covered(const Corners& one, const std::set<Corners>& part) const {
  for (auto at = std::lower_bound(triples_.begin(), triples_.end(), first_of(one)); at != triples_.end() && at->corners == one; ++at)
    if (at->face[3] < 0 || part.count(at->other_half) > 0) return true;
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
