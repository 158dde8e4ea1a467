#pragma once
// What a contact works with and may throw away between steps.

#include <array>
#include <vector>

#include "contact/data/memory.hpp"
#include "contact/surface/broad_search.hpp"

namespace nereid::contact {

/// Two edges where one is over the other.
struct Over {
  bool is = false;                 ///< within both edges, and in front of both
  int side = 0;                    ///< sign of the normal on the product of both edges
  Vec3 normal = Vec3::UnitZ();     ///< unit vector from the base edge to the other one
  double height = 0;               ///< [m]
  double first = 0, second = 0;    ///< [-] places along the edge and the base edge
};

/// Crossings of a range of pairs of edges, found beside those of other ranges.
struct CrossingRange {
  std::vector<Crossing> crossings;
  std::vector<Over> over;       ///< how these stand
  std::vector<Crossing> ended;  ///< those that hold energy
};

/// A box around the facets of a body.
struct BodyBox {
  Vec3 low, high;  ///< [m]
};

/// An edge in a search, with the box around it.
struct EdgeBox {
  Index edge;
  bool ridge;      ///< or a rim
  Vec3 low, high;  ///< [m]
};

constexpr Index apexes_of_a_range = 64;  ///< that are searched for one after the other, whatever the number of threads
constexpr Index facets_at_first = 32;    ///< of an apex, for which there is room before any search

/// What a search for pairs of bodies works with.
struct SearchWork {
  std::vector<BodyBox> boxes;                ///< [bodies] around the facets
  Subset first_partner, partners;            ///< [bodies + 1] bodies whose boxes are near that of each
  std::vector<char> near_itself;             ///< [bodies] whether folds of each are nearer than was asked: SidesMemory::apart_from_itself
  std::vector<char> are_near;                ///< [bodies x bodies] whether two were near each other at the last search
  std::vector<std::array<Index, 2>> near_bodies;  ///< these pairs
  std::vector<char> has_near;                ///< [bodies] whether any was near
  bool knows_near_bodies = false;            ///< whether these are listed
  std::vector<BodyBox> speeds;               ///< [m/s] [bodies] around the velocities
  std::vector<double> apart;                 ///< [m/s] [bodies] how fast each and those near it go against each other
};

/// What an interface works with and may throw away between steps.
struct Workspace : SearchWork {
  explicit Workspace(const Interface&);
  std::vector<BroadSearch> broad;            ///< of the base, or [bodies]
  std::vector<char> apex_near_itself;        ///< [apexes] of which node this is so
  Vectors normals;                           ///< [facets] of bodies that touch themselves
  PointWork points;                          ///< where heights are those of points
  Subset facets;           ///< [apexes] how many facets a search found near
  std::vector<Subset> found;  ///< these facets, by ranges of apexes
  std::vector<Near> near;  ///< the next list of near apexes
  Scalars spring_sum;      ///< [N/m] [nodes of the mesh] stiffness of all springs at a base node
  Scalars rotation_sum;    ///< [N] [nodes of the mesh] the same for the moments of friction
};

/// What edges over edges work with and may throw away between steps.
struct EdgeWorkspace : SearchWork {
  explicit EdgeWorkspace(const EdgeContact&);
  std::vector<EdgeBox> edges, base_edges, base_ridges;  ///< what a search looks at
  std::vector<EdgePair> edge_pairs;        ///< the next list of pairs
  std::vector<Crossing> crossings;         ///< the next list of crossings
  std::vector<Over> over;                  ///< how these stand
  std::vector<CrossingRange> crossing_ranges;  ///< the same by ranges of pairs
};

}  // namespace nereid::contact
