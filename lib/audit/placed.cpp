#include "audit/placed.hpp"

#include <cmath>

namespace nereid::audit {

namespace {

constexpr double pad = 1e-12;        // [-] of the size of a box, by which it is larger than what it holds
constexpr double round_off = 1e-14;  // [-] of its distance from the origin

// A direction that no mesh is built along, and two across it.
const Vec3 u(0.80252871, -0.59660537, 0);
const Vec3 v(0.40337647, 0.54260638, -0.73682593);
const Vec3 ray = cross(u, v);

Box around(const Box& one, const Box& other) { return {one.low.cwiseMin(other.low), one.high.cwiseMax(other.high)}; }

Box around(const Surface& surface, const Placed& placed, const Tree::Node& node) {
  Box box{corner(surface, placed, node.first, 0), corner(surface, placed, node.first, 0)};
  for (Index t = node.first; t < node.last; ++t)
    for (int i = 0; i < 3; ++i) {
      const Vec3 at = corner(surface, placed, t, i);
      box.low = box.low.cwiseMin(at), box.high = box.high.cwiseMax(at);
    }
  const double larger = pad * (box.high - box.low).norm() + round_off * box.high.cwiseAbs().cwiseMax(box.low.cwiseAbs()).maxCoeff();
  box.low.array() -= larger, box.high.array() += larger;
  return box;
}

Box around_normals(const Surface& surface, const Placed& placed, const Tree::Node& node) {
  Box box{Vec3::Constant(INFINITY), Vec3::Constant(-INFINITY)};
  for (Index t = node.first; t < node.last; ++t) {
    const Vec3 n = normal(surface, placed, t);
    const double size = n.norm();
    if (!(size > 0)) return {Vec3::Constant(-1), Vec3::Constant(1)};
    box.low = box.low.cwiseMin(n / size), box.high = box.high.cwiseMax(n / size);
  }
  return box;
}

/// Whether the ray passes to the left of the side from corner a to corner b: by the same numbers, whoever asks.
bool is_left(Index a, Index b, const double (&at_a)[2], const double (&at_b)[2], double& area) {
  const bool turned = b < a;
  const double(&first)[2] = turned ? at_b : at_a;
  const double(&last)[2] = turned ? at_a : at_b;
  const double twice = first[0] * last[1] - first[1] * last[0];
  area = turned ? -twice : twice;
  return (twice >= 0) != turned;
}

void add_normals(const Surface& surface, Index faces, Placed& placed) {
  placed.normals.setZero();
  for (Index f = 0; f < faces; ++f) {
    const Vec3 n = face_normal(surface, placed, f);
    for (int i = 0; i < 4; ++i)
      if (surface.faces(i, f) >= 0) placed.normals.col(surface.faces(i, f)) += n;
  }
}

/// Moves the points of a shell from the mid-surface to its two sides.
void stand_off(const Surface& surface, Placed& placed) {
  const auto points = static_cast<Index>(surface.nodes.size()) / 2;
  add_normals(surface, surface.plates, placed);
  for (Index p = 0; p < points; ++p) {
    Vec3 n = placed.normals.col(p);
    const Vec3 inward = surface.inward.col(p);  // on a plane of symmetry the mirrored plates turn the normal into the plane
    if (inward.squaredNorm() > 0) n -= inward.dot(n) / inward.squaredNorm() * inward;
    const double size = n.norm();
    if (!(size > 0)) continue;
    placed.at.col(p) += placed.half(p) / size * n;
    placed.at.col(p + points) -= placed.half(p) / size * n;
  }
}

/// Moves the points and the centres of a closed surface onto the exact shape of its body.
void move_onto_shape(const Surface& surface, const Vectors& x, Placed& placed) {
  placed.round = mesh::placed(*surface.round, x);
  for (Eigen::Index p = 0; surface.closed && p < placed.at.cols(); ++p) {
    const geometry::OverRound over = geometry::over_round(surface.round->shape, placed.round, placed.at.col(p));
    placed.at.col(p) -= over.distance * over.normal;
  }
}

}  // namespace

Placed make_placed(const Surface& surface) {
  Placed placed;
  placed.at = Vectors::Zero(3, static_cast<Eigen::Index>(surface.nodes.size()) + surface.faces.cols());
  placed.half = surface.half;
  placed.normals = Vectors::Zero(3, surface.closed ? static_cast<Eigen::Index>(surface.nodes.size()) : 0);
  placed.open = Scalars::Zero(surface.faces.cols());
  placed.open_at = Scalars::Zero(static_cast<Eigen::Index>(surface.nodes.size()));
  placed.boxes.assign(surface.tree.nodes.size(), {Vec3::Zero(), Vec3::Zero()});
  placed.looks = placed.boxes;
  return placed;
}

void place(const Surface& surface, const Vectors& x, Placed& placed, const Scalars& half_growth) {
  const auto points = static_cast<Index>(surface.nodes.size());
  for (Index p = 0; p < points; ++p) placed.at.col(p) = x.col(surface.nodes[p]);
  if (half_growth.size() > 0)
    for (Index p = 0; p < points; ++p) placed.half(p) = surface.half(p) + half_growth(surface.nodes[p]);
  placed.finite = placed.at.leftCols(points).allFinite();
  if (surface.plates > 0) stand_off(surface, placed);
  for (Index f = 0; f < surface.faces.cols(); ++f) {
    const auto at = surface.faces.col(f);
    const Vec3 three = placed.at.col(at(0)) + placed.at.col(at(1)) + placed.at.col(at(2));
    placed.at.col(points + f) = at(3) < 0 ? Vec3(three / 3) : Vec3((three + placed.at.col(at(3))) / 4);
  }
  if (surface.round && placed.finite) move_onto_shape(surface, x, placed);
  if (surface.closed) add_normals(surface, static_cast<Index>(surface.faces.cols()), placed);
  placed.open_at.setZero();
  for (Index f = 0; f < surface.faces.cols(); ++f) {
    placed.open(f) = surface.round ? 0 : left_open(surface, placed, f);
    for (int i = 0; i < 4; ++i)
      if (surface.faces(i, f) >= 0) placed.open_at(surface.faces(i, f)) = std::max(placed.open_at(surface.faces(i, f)), placed.open(f));
  }
  for (auto n = static_cast<Index>(surface.tree.nodes.size()) - 1; n >= 0; --n) {
    const Tree::Node& node = surface.tree.nodes[n];
    if (node.second == 0) {
      placed.boxes[n] = around(surface, placed, node);
      placed.looks[n] = around_normals(surface, placed, node);
      continue;
    }
    placed.boxes[n] = around(placed.boxes[n + 1], placed.boxes[node.second]);
    placed.looks[n] = around(placed.looks[n + 1], placed.looks[node.second]);
  }
  if (surface.round && !placed.boxes.empty()) {  // the shape bulges out between its points
    const Vec3 reach = Vec3::Constant(geometry::reach(surface.round->shape));
    placed.boxes[0] = {placed.round.centre - reach, placed.round.centre + reach};
  }
}

Vec3 face_normal(const Surface& surface, const Placed& placed, Index face) {
  const auto at = surface.faces.col(face);
  const Vec3 a = placed.at.col(at(0)), b = placed.at.col(at(1)), c = placed.at.col(at(2));
  if (at(3) < 0) return cross(b - a, c - a);
  const Vec3 d = placed.at.col(at(3));
  return cross(c - a, d - b);
}

double left_open(const Surface& surface, const Placed& placed, Index face) {
  constexpr double an_edge = 0.5;  // [-] cosine: the border of a face that is meant to be one
  const auto at = surface.faces.col(face);
  const int corners = at(3) < 0 ? 3 : 4;
  const Vec3 n = face_normal(surface, placed, face);
  const double size = n.norm();
  if (!(size > 0)) return 0;
  const auto p = [&](int i) -> Vec3 { return placed.at.col(at(i)); };
  double open = corners == 4 ? 0.25 * (p(0) - p(1) + p(2) - p(3)).norm() : 0;
  for (int i = 0; i < corners; ++i) {
    const Index other = surface.beside(i, face);
    if (other < 0) continue;
    const Vec3 m = face_normal(surface, placed, other);
    const double side = (p((i + 1) % corners) - p(i)).norm(), both = size * m.norm();
    if (!(n.dot(m) > an_edge * both) || !(side > 0)) continue;
    const double width = (corners == 4 ? 0.5 : 1) * size / side;
    open = std::max(open, 0.125 * width * (n / size - m.normalized()).norm());
  }
  return open;
}

int winding(const Surface& surface, const Placed& placed, const Vec3& p) {
  int count = 0;
  if (surface.tree.nodes.empty()) return count;
  const Vec3 middle = 0.5 * (placed.boxes[0].low + placed.boxes[0].high);
  const int way = (p - middle).dot(ray) < 0 ? -1 : 1;  // of the two ways along the ray that which leaves the boxes sooner
  const Vec3 inverse = way * ray.cwiseInverse();
  detail::Stack stack;
  stack.node[stack.count++] = 0;
  while (stack.count > 0) {
    const Index here = stack.node[--stack.count];
    if (!detail::is_met(placed.boxes[here], p, inverse, std::numeric_limits<double>::infinity())) continue;
    const Tree::Node& node = surface.tree.nodes[here];
    if (node.second != 0) {
      stack.node[stack.count++] = node.second;
      stack.node[stack.count++] = here + 1;
      continue;
    }
    for (Index t = node.first; t < node.last; ++t) {
      double flat[3][2], height[3], area[3];
      for (int i = 0; i < 3; ++i) {
        const Vec3 away = corner(surface, placed, t, i) - p;
        flat[i][0] = away.dot(u), flat[i][1] = away.dot(v), height[i] = away.dot(ray);
      }
      int left = 0;
      for (int i = 0; i < 3; ++i)
        left += is_left(surface.triangles(i, t), surface.triangles((i + 1) % 3, t), flat[i], flat[(i + 1) % 3], area[i]);
      if (left != 0 && left != 3) continue;
      const double whole = area[0] + area[1] + area[2];
      const double above = area[1] * height[0] + area[2] * height[1] + area[0] * height[2];  // times the whole area
      if (whole == 0 || !(way * above / whole > 0)) continue;
      count += left == 3 ? way : -way;
    }
  }
  return count;
}

}  // namespace nereid::audit
