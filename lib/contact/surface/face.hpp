#pragma once
// How a point stands over a bilinear face of a hexahedron: one formula for one apex and for a pack of them.

#include "geometry/quadrilateral.hpp"

namespace nereid::contact {

template <class T>
struct OverFace {
  geometry::OnQuadrilateral<T> at;  ///< the foot
  T area2;                          ///< [m4] squared area of the tangents there
  Vector<T> normal;                 ///< unit vector
  T height;                         ///< [m] along it
  std::array<T, 4> weight;          ///< of the corners at the foot
};

/// Finds the foot of a point over a face: the closest point of it.
///
/// corner  [m] around the face less the point; the first, third and fourth are the facet that is half of the face
/// over    its a and b are where the search begins
/// returns whether the point has a foot there: not where the face is warped too much, or the point stands too high over a warped one
template <class T>
NEREID_HOT Mask<T> stand_over(const std::array<Vector<T>, 4>& corner, OverFace<T>& over) {
  constexpr double turned = 0.5;  // cosine between the normals of a face and of its half: a face that is warped more stays cut
  const T zero(0.0);
  const Mask<T> has_foot = closest_on_quadrilateral(corner, Vector<T>{zero, zero, zero}, over.at);
  const Vector<T> area = cross(over.at.by_a, over.at.by_b), facet = cross(corner[2] - corner[0], corner[3] - corner[0]);
  over.area2 = dot(area, area);
  over.normal = T(1.0) / root(over.area2) * area;
  over.height = dot(over.normal, over.at.way);
  over.weight = geometry::weights_at(over.at.a, over.at.b);
  const T same_way = dot(area, facet);
  return has_foot && same_way > zero && same_way * same_way > T(turned * turned) * over.area2 * dot(facet, facet);
}

/// Whether a foot is nearer to an edge of its face than a band [m].
template <class T>
NEREID_HOT Mask<T> is_within(const T& band, const OverFace<T>& over) {
  const auto& [a, b, by_a, by_b, way] = over.at;
  const T along = smaller(a, T(1.0) - a), across = smaller(b, T(1.0) - b), limit = band * band;
  return !(along > T(0.0) && across > T(0.0) && along * along * over.area2 > limit * dot(by_b, by_b) &&
           across * across * over.area2 > limit * dot(by_a, by_a));
}

}  // namespace nereid::contact
