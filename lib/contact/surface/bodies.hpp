#pragma once
// Many bodies in one contact: which of them touch, and what each two of them have together.

#include <string>
#include <vector>

#include "contact/surface/base_surface.hpp"

namespace nereid::contact {

/// Where the height of an apex over its base is measured, by multipliers.
enum class Heights {
  nodes,   ///< at the node itself: the paper's elements
  points,  ///< at points of the faces around it: points.hpp
  guards,  ///< at the node itself, and it acts only where points of the other side leave it too deep
};

/// What two surfaces have together.
struct Between {
  double penalty = 0;         ///< [Pa/m] 1/delta
  double impedance = 0;       ///< [Pa s/m] rho c of both sides in series, of both passes together
  double arm_of_apex = 0;     ///< [-] share of the apex, a plate, in the arm of friction; the base has the rest
  double depth = 0;           ///< [m] of the flattest element behind either surface: what a penetration is held against
  double release_height = 0;  ///< [m] above h_c up to which an apex stays tracked that multipliers have released
  Heights heights = Heights::nodes;  ///< of the first over the second; of many bodies whether any pair has another one than nodes
};

/// The bodies of an automatic contact. All nodes of their skins are apexes and all facets are base; what an apex does in a pair of bodies
/// is Between::heights. Empty for a pair of surfaces.
struct Bodies {
  std::vector<std::string> names;
  Subset of_apex, of_facet;      ///< [apexes] [facets] body
  Subset of_node;                ///< [nodes of the mesh] body, or -1
  Subset first_facet;            ///< [bodies + 1] where the facets of each begin
  Subset nodes, first_node;      ///< nodes of the facets of each body, and [bodies + 1] where they begin
  Scalars thickest;              ///< [m] [bodies] the largest BaseSurface::stand_off
  std::vector<Between> between;  ///< [bodies x bodies] by the body of the apex, then that of the base
  std::vector<char> touch;       ///< [bodies x bodies] whether they touch; on the diagonal whether a body touches itself

  Index count() const { return static_cast<Index>(names.size()); }
  std::size_t pair(Index apex, Index base) const { return static_cast<std::size_t>(apex) * names.size() + static_cast<std::size_t>(base); }
};

}  // namespace nereid::contact
