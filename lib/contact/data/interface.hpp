#pragma once
// What a contact is between: two surfaces, or many bodies, and how they act on each other. Constant in time.

#include <string>
#include <vector>

#include "contact/data/friction.hpp"
#include "contact/data/method.hpp"
#include "contact/data/shape.hpp"
#include "contact/surface/bodies.hpp"
#include "contact/surface/cone.hpp"
#include "contact/surface/edges.hpp"

namespace nereid::contact {

/// Whether an apex may leave its base.
enum class InterfaceKind {
  contact,  ///< unilateral: pushes only, and the apex slides from base to base
  tied,     ///< the apex is pulled as well as pushed: it stays over the point of its base where it began, unless Interface::slides
};

/// How friction on an apex is shared out over its base, and against what its sliding is measured.
enum class Weights {
  consistent,  ///< by the foot of the apex, with the moments of Touch: keeps angular momentum
  paper,       ///< equally over the nodes of the base, Kulak & Fiala Eqs. 9 and 10: loses angular momentum
};

/// What a traction is multiplied by to become the force on an apex.
enum class Area {
  apex,  ///< the tributary area of the apex, of the sides that face the base within 60 degrees as it comes into contact
  base,  ///< the mean area of the facets of the base, as in the paper's Eqs. 6 and 12
};

/// Which of two passes, in which each surface has apexes over the other; the back pass follows the forth one in the model.
enum class Pass { only, forth, back };

/// Which penetrations of the initial geometry are accepted.
enum class InitialPenetration {
  refuse,  ///< the scene is not built
  accept,  ///< the penetration becomes an offset of the apex: no force at the start, see Track::height
};

/// Where a tied apex belongs: over fixed weights of the nodes of a facet, or of the face that it is half of, at a fixed height.
struct Tie {
  Index facet = -1;                ///< -1: the apex found no base and is free
  bool on_face = false;            ///< of a hexahedron, by bilinear weights
  std::array<double, 4> weight{};  ///< of the nodes of the facet, then of Half::fourth
  double height = 0;               ///< [m] along the normal of the facet, or of the face at that point
};

/// Both sides of a contact, and what they have together. Constant in time.
///
/// What it is between is that of its two surfaces; of many bodies the least depth and the largest penalty of all pairs.
struct Sides : Between {
  std::string name;
  Subset apexes;            ///< nodes of the first side, ascending: apexes, or ends of edges and what is across from these
  Subset base_nodes;        ///< the same of the other side
  double restitution = 1;   ///< [-] speed of a node released by a multiplier over that with which it was stopped
  Coulomb friction;
  /// [nodes] column of a plate node's angular velocity, or -1; empty where no node of the contact turns
  std::vector<Index> rotation_of_node;
  /// [m] Only what is nearer than h_c and this is looked at, or than it can move in some steps. A search is due when both sides have moved
  /// by half of it since the last one, so that nothing comes into contact unseen.
  double margin = 0;
  double longest_step = 0;  ///< [s] stable step of the elements at the start: no step is much longer
  Bodies bodies;            ///< of an automatic contact
};

/// What a penalty has besides.
struct Springs {
  double impact_step_factor = 0.1410;  ///< [-] dt sqrt(k/m) of the step limit: impact_step_factor_for(0.005)
  double first_step_factor = 0;        ///< [-] the same until the contact has created too much, where it is larger: step_factor.hpp
  /// [s] a closed element pushes with k (|d| + damping_time d|d|/dt), never pulls. It takes the chatter out of an interface; what it
  /// dissipates is booked.
  double damping_time = 0;
};

/// Apexes over a base surface. Tracking is the same for all methods, so they share a record: docs/decisions.md.
struct Interface : Sides, Springs {
  InterfaceKind kind = InterfaceKind::contact;
  Method method = Method::penalty;
  BaseSurface base;
  Fans own;                      ///< the surface of the apexes: an apex comes into contact with facets that this faces; may be empty
  Scalars area;                  ///< [m2] tributary area, [apexes]
  mesh::FacesAround faces;       ///< [apexes] what the tributary area lies on; may be empty
  Scalars facet_area;            ///< [m2] of the reference, [facets]
  Scalars contact_height;        ///< [m] h_c, [apexes], with plates as thick as at the start
  bool follows_thickness = false;  ///< whether h_c changes as plates do: see Memory::thicker
  std::vector<Tie> ties;             ///< [apexes] of a tied interface, where they begin; set by connect()
  bool slides = false;               ///< of ties by multipliers: they hold along the normal alone
  Pass pass = Pass::only;
  double pass_factor = 1;              ///< [-] part of the stiffness, or impedance, between its nodes: 1/2 in each of two passes
  Weights weights = Weights::consistent;
  Area area_kind = Area::apex;
  /// An apex on a symmetry plane meets the mirror images of its bases too: [apexes] projector onto
  /// the directions the plane allows; empty where there are no planes.
  std::vector<Mat3> allowed;
  Shapes shapes;  ///< of rigid bodies that touch as they are: of a pair of surfaces, nothing else acts; of bodies, beside others
};

/// Whether nothing acts in a contact but the shapes of rigid bodies.
inline bool by_shapes_alone(const Interface& interface) { return interface.bodies.count() == 0 && !interface.shapes.pairs.empty(); }

/// Edges over edges, by multipliers.
struct EdgeContact : Sides {
  Edges edges, base_edges;
  double height = 0;  ///< [m] h_c between them, beside Edges::half
  Beside beside;      ///< of bodies that touch themselves
};

/// Whether this is a tie by multipliers.
inline bool tied_by_multipliers(const Interface& interface) {
  return interface.kind == InterfaceKind::tied && by_multipliers(interface);
}

/// What an apex has together with a facet.
inline const Between& between(const Interface& interface, Index apex, Index facet) {
  const Bodies& bodies = interface.bodies;
  return bodies.names.empty() ? interface : bodies.between[bodies.pair(bodies.of_apex[apex], bodies.of_facet[facet])];
}

/// 1, or -1 of a back pass, whose apexes are on the other side of the contact. [-]
inline double side_of(const Interface& interface) { return interface.pass == Pass::back ? -1 : 1; }
inline double side_of(const EdgeContact&) { return 1; }

/// Whether a contact is a part of the one before it in the model: its second pass, or its edges.
inline bool follows(const Interface& interface) { return interface.pass == Pass::back; }
inline bool follows(const EdgeContact&) { return true; }

/// How far the surface of an apex may reach behind a plane along whose normal its base pushes it. [-]
inline double most_behind(const Interface& interface) {
  return interface.pass == Pass::only && interface.bodies.names.empty() ? behind_in_one_direction : behind_in_two_directions;
}

/// [-] of the depth of an element: apexes that are nearer to their base have a condition by multipliers.
constexpr double multipliers_reach = 0.02;
constexpr double steps_to_touch = 4;  ///< open apexes that can touch within so many steps have one too

/// h_c between two edges. [m]
inline double height_between(const EdgeContact& contact, Index edge, Index base_edge) {
  const Scalars &one = contact.edges.half, &other = contact.base_edges.half;
  return contact.height + (one.size() > 0 ? one(edge) + other(base_edge) : 0);
}

/// What two edges have together.
inline const Between& between_edges(const EdgeContact& contact, Index edge, Index base_edge) {
  const Bodies& bodies = contact.bodies;
  if (bodies.count() == 0) return contact;
  return bodies.between[bodies.pair(contact.edges.body[edge], contact.base_edges.body[base_edge])];
}

/// Directions that an apex on a symmetry plane may go; null for the others.
inline const Mat3* allowed_of(const Interface& interface, Index a) {
  return interface.allowed.empty() || interface.allowed[a].isIdentity(0) ? nullptr : &interface.allowed[a];
}

}  // namespace nereid::contact
