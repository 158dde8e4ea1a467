#pragma once
// Rigid bodies that touch as the round shapes that they are, and not with the facets of their meshes.
//
// A point of contact is a place where a shape is closest to a node, an edge or a facet of another body, to another shape, or to a rigid
// plane, with the distance there and its gradient as gap and normal. It pushes four nodes of the shape, with weights that make force and
// moment right (mesh/round_body.hpp), and on the other body the nodes of the feature. docs/theory/shapes.md

#include <array>
#include <cstdint>
#include <vector>

#include "contact/surface/bodies.hpp"
#include "contact/data/friction.hpp"
#include "contact/data/method.hpp"
#include "mesh/round_body.hpp"

namespace nereid::contact {

/// The surface of another body, of flat facets. Of plates it has one side, and both sides touch.
struct Faceted {
  Subset nodes;
  Scalars area;       ///< [m2] [nodes] tributary
  mesh::FacesAround faces;  ///< [nodes] what that lies on
  Scalars half;       ///< [m] [nodes] half the thickness of plates there
  Subset apex;        ///< [nodes] in Interface::apexes, whose growth of thickness counts too; empty where none grows
  Table<2> edges;     ///< each once
  Table<2> across;    ///< [edges] the third nodes of the facets at each; -1 where there is none
  Subset first_beside, beside;  ///< [nodes + 1] and the nodes at the other ends of the edges of each
  Table<3> facets;
  std::vector<char> is_plate;  ///< [facets]
};

/// A shape and what it touches.
struct ShapePair {
  Index round = -1;    ///< in Shapes::rounds
  Index faceted = -1;  ///< in Shapes::faceted, or -1
  Index other = -1;    ///< in Shapes::rounds, or -1
  double side = -1;    ///< of the shape: -1 that of the base, 1 that of the apexes; what it touches has the other side
  Index body = -1, other_body = -1;  ///< of an automatic contact
  double area = 0;     ///< [m2] that a point of contact without a node stands for, against others
  Between between;
};

/// All of a contact.
struct Shapes {
  std::vector<mesh::RoundBody> rounds;
  std::vector<Faceted> faceted;
  std::vector<ShapePair> pairs;
};

/// What of another body a shape is near.
enum class NearKind : std::uint8_t { node, edge, facet, shape };

/// A pair whose shape was near a feature at the last search.
struct NearFeature {
  Index pair = -1;
  NearKind kind = NearKind::node;
  Index id = 0;
};

/// A point where a shape touches, or may soon.
struct ShapePoint {
  Index pair = -1;                 ///< or round of a rigid plane
  NearKind kind = NearKind::node;
  Index id = 0, part = 0;          ///< which feature, and which point of several there
  int nodes = 0;
  std::array<Index, 8> node{};
  /// Of the push: on a shape it acts where its line passes the centre, since that point does not go around with a spin. The sum is one of
  /// the side of the apexes, and minus one of the base.
  std::array<double, 8> weight{};
  std::array<double, 8> rub_weight{};  ///< of friction: at the place of contact, on both sides
  Vec3 normal = Vec3::UnitZ();     ///< unit vector, from the base to the apexes
  Vec3 place = Vec3::Zero();       ///< [m]
  double gap = 0;                  ///< [m] now
  double curved = 0;               ///< [m] what the gap at the end of the step to come has beyond what the rate tells
  double area = 0, loaded = 0;     ///< [m2] and of the faces that the contact loads
  bool acts = false, closed = false, rubs = false, stuck = false;
  double pressed = 0;              ///< [N] in the step before
  double coefficient = 0;          ///< [-] of friction
  Vec3 friction = Vec3::Zero();    ///< [N] on the side of the apexes
  Restitution restitution;
};

/// Where shapes stand at given positions.
std::vector<geometry::PlacedRound> placed_all(const std::vector<mesh::RoundBody>&, const Vectors& x);

/// How many points have conditions.
Index count_acting(const std::vector<ShapePoint>&);

/// Where friction acts, and on what.
Touch touch_of(const ShapePoint&);

/// The velocity of the side of the apexes against that of the base. [m/s]
Vec3 relative(const ShapePoint&, const Vectors& v);

/// Calls push(node, force) for what presses nodes, and rub(touch, force) for friction.
template <class Push, class Rub>
void visit_forces(const std::vector<ShapePoint>& points, Push&& push, Rub&& rub) {
  for (const ShapePoint& point : points) {
    if (!point.closed) continue;
    for (int j = 0; j < point.nodes; ++j) {
      const auto at = static_cast<std::size_t>(j);
      push(point.node[at], Vec3(point.weight[at] * point.pressed * point.normal));
    }
    if (point.rubs) rub(touch_of(point), point.friction);
  }
}

}  // namespace nereid::contact
