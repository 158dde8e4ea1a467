#pragma once
// The one kind of data between finding contact and acting on it: a push of an apex and of the nodes of one facet.

#include <array>
#include <limits>

#include "base/seldom.hpp"
#include "base/types.hpp"
#include "geometry/closest.hpp"

namespace nereid::contact {

/// A push of the apex by `apex` times `push`, and of node I of the facet by minus weight_I times `push`.
///
/// Over a facet, an edge or a vertex the weights are those of the foot, and apex is one; by multipliers they are bilinear over a face of
/// a hexahedron. The weights of a couple sum to zero, and apex is zero: it turns the facet.
struct Stencil {
  Index facet = -1;
  double apex = 1;
  std::array<double, 3> weight{};
  double fourth = 0;               ///< weight of Half::fourth
  Vec3 push = Vec3::Zero();        ///< [N]
  std::array<double, 3> share{};   ///< of the spring's stiffness at the nodes; a node that several stencils of an apex share has it once
  geometry::Kind kind = geometry::Kind::facet;  ///< of the feature of the facet that the apex is over
  int local = 0;                                ///< which edge or vertex of the facet that is
  bool on_ridge = false;           ///< by multipliers: both sides of that edge push the apex, which goes out between them
  /// [m] over the feature at which a contact closes; NaN: the stencil only goes with another one
  double level = std::numeric_limits<double>::quiet_NaN();
  bool over_points = false;        ///< by multipliers: its condition is over points of faces
  Index first_share = 0;           ///< in Memory::shares
  int shares = 0;                  ///< over points: how many nodes have shares of the push; else 0
};

constexpr int most_stencils = 9;  ///< of an apex

/// The stencils of an apex. Most apexes have one.
class Stencils {
 public:
  Stencil& operator[](int s) { return s == 0 ? first_ : others_.make()[static_cast<std::size_t>(s - 1)]; }
  const Stencil& operator[](int s) const { return s == 0 ? first_ : (*others_)[static_cast<std::size_t>(s - 1)]; }
  bool has_others() const { return others_.exists(); }

 private:
  Stencil first_;
  Seldom<std::array<Stencil, most_stencils - 1>> others_;
};

/// Whether any of the first `count` stencils has a property.
template <class Has>
bool any_of(const Stencils& stencils, int count, Has&& has) {
  for (int s = 0; s < count; ++s)
    if (has(stencils[s])) return true;
  return false;
}

}  // namespace nereid::contact
