#pragma once
// Points of the faces of the apexes' side, and where they stand over a base: points.hpp.

#include <array>
#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace nereid::contact {

/// Where a point stands over a base.
struct Foot {
  Index facet = -1;                ///< -1: nowhere
  int nodes = 3;                   ///< or 4 of the face that the facet is half of
  std::array<Index, 4> node{};
  std::array<double, 4> weight{};  ///< shape functions of the nodes at the foot
  Vec3 normal = Vec3::Zero();      ///< unit vector out of the base
  double height = 0;               ///< [m] along it
};

/// How a face lies on a base.
enum class Lies {
  apart,    ///< it does not face it, or none of its points has a foot
  whole,    ///< all its points have one, over what is a plane or nearly so
  leaning,  ///< its nodes are over the base by themselves
  in_part,  ///< some of its points are over the base
};

/// A face of the apexes' side.
struct Face {
  int corners = 0;
  std::array<Index, 4> node{};
  Vec3 normal = Vec3::Zero();  ///< unit vector out of it
  double side = 0;             ///< [m]
};

/// What the points of a face give one of its corners, per area of the corner on this face.
struct CornerSum {
  double part = 0;             ///< [-] of that area: points that count
  double gap = 0;              ///< [m] height times part, without the level of contact
  Vec3 normal = Vec3::Zero();  ///< [-]
};

/// The points of a face in a step.
struct FacePoints {
  std::int64_t step = -1;     ///< in which they were found
  std::int64_t measured = -1; ///< step in which the face was measured
  std::int64_t used = -1;     ///< step in which an apex last asked for them
  Face face;
  Index from = -1;            ///< facet from which they were looked for
  Lies lies = Lies::apart;
  std::vector<Foot> foot;     ///< of the Gauss points; of a face that is covered in part of four points for each of its nodes
  std::vector<std::array<double, 4>> taken_by;  ///< of such points: parts of them that count for each corner; their sum is one
  std::array<Index, 4> last{-1, -1, -1, -1};  ///< facets of the feet of the Gauss points when they were found before
  std::vector<Index> base;    ///< nodes of all feet, each once
  std::array<CornerSum, 4> corner;
  /// [corners x (nodes of the face, then those of the base)] what a node gets per area of each corner
  std::vector<Vec3> push;
};

/// What a node takes of a push.
struct Share {
  Index node;
  Vec3 push;          ///< part of it, in its direction
  bool of_apex_side;
};

/// What is worked with to find heights over points, and may be thrown away between steps.
struct PointWork {
  std::int64_t step = 0;
  std::vector<FacePoints> of_face;  ///< beside Interface::faces
  Subset used, used_before;         ///< faces whose points apexes asked for in this step, and in that before
};

/// The points of a face as they were found for the apexes of one range alone.
struct PointsAside {
  Index of_face = -1;
  FacePoints points;
};

/// What is worked with to sum the points around the apexes of one range.
struct PointSum {
  std::vector<Share> sum;           ///< of an apex
  std::vector<std::int32_t> place;  ///< in `sum`, by a hash of the node, -1: none; a power of two, more than twice as long as `sum`
  Subset used;                      ///< faces of PointWork whose points the apexes asked for
  std::vector<PointsAside> aside;   ///< of faces that were not measured before, or over another part of the base
  std::size_t set_aside = 0;        ///< how many of these are of this step
};

}  // namespace nereid::contact
