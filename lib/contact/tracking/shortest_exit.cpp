#include "contact/tracking/shortest_exit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/surface/stand.hpp"

namespace nereid::contact {

namespace {

using geometry::Kind;

constexpr int most_rounds = 60;      // in which feet over edges are found; few need more than six
constexpr double least_fade = 0.02;   // of the size of a face: least way over which a force fades then
constexpr double right_angle = 1e-6;  // cosine: features across each other are left together
constexpr double least_cosine = 1e-9;  // of opposite features, from their opposite
constexpr int most_looks = 3;        // at what is at the end of the way
constexpr double high_enough = 1e-9;  // of the longest edge

/// Features that are left together, by the shortest vector d.
struct Together {
  struct Cut {
    Feature feature;
    FeatureHeight over;       // at the end of d
    double contact_height;    // [m]
    int track;
    bool outside = false;     // of a wall: the height is a distance
    bool nearest = false;     // without contact height the nearest point is the way out: a symmetry plane takes what leads out of it
    bool below = false;       // of an edge or vertex without contact height: the way out ends on it, or beside it where others push along
  };
  int count = 0;
  std::array<Cut, most_candidates> cut;
  std::array<double, most_candidates> lambda{};
  Vec3 d = Vec3::Zero();
  double squared = 0;   // of the way: twice the energy
  bool curved = false;  // heights over edges and vertices are not linear in d

  bool has(Index facet) const {
    for (int i = 0; i < count; ++i)
      if (cut[i].feature.facet == facet) return true;
    return false;
  }
  /// Whether to leave a feature together with these is nearer to the energy of both than to leave it alone, positive if so. Of two features
  /// of the same depth, with a cosine c between their normals, the energy of both alone is 1 + c times that of both together.
  double suits(const Vec3& normal) const {
    double like = 0, against = 0;
    for (int i = 0; i < count; ++i) {
      const double cosine = cut[i].over.normal.dot(normal);
      like = std::max(like, cosine), against = std::max(against, -cosine - right_angle);
    }
    return like / (1 + like) - against / std::max(1 - against, least_cosine);
  }
};

/// The way of two on which a feature is left, with those that push as it does and not with those that push against it: the `first`, if the
/// other one does not suit it better.
int way_of(const std::array<Together, 2>& way, const Vec3& normal, int first) {
  return way[1 - first].suits(normal) > way[first].suits(normal) ? 1 - first : first;
}

FeatureHeight height_of(const BaseSurface& base, const Vectors& x, const Together::Cut& cut, const Vec3& end) {
  FeatureHeight over = height_over(base, x, cut.feature, end);
  if (cut.outside && over.height < 0) over.height = -over.height, over.normal = -over.normal;
  return over;
}

/// Finds the shortest vector, with the foot of every push at its end, so that the potential has the pushes as its gradient and their
/// moments cancel.
void solve(const BaseSurface& base, const Vectors& x, const Vec3& p, const Mat3* allowed, Together& all) {
  all.squared = 0;
  if (all.count == 1 && (allowed == nullptr || all.cut[0].nearest)) {  // the foot is the apex's own
    Together::Cut& cut = all.cut[0];
    all.lambda[0] = std::max(0.0, cut.contact_height - cut.over.height);
    all.d = all.lambda[0] * (allowed ? Vec3(*allowed * cut.over.normal) : cut.over.normal);
    all.squared = all.lambda[0] * all.lambda[0];
    if (all.lambda[0] > 0) cut.over.height = cut.contact_height;
    return;
  }
  for (int round = 0; round < most_rounds; ++round) {
    Contacts contacts;
    contacts.count = all.count;
    for (int i = 0; i < all.count; ++i) {
      const Together::Cut& cut = all.cut[i];
      contacts.normal[i] = allowed ? *allowed * cut.over.normal : cut.over.normal;
      contacts.depth[i] = cut.contact_height - cut.over.height + contacts.normal[i].dot(all.d);
    }
    all.lambda = projection_multipliers(contacts);
    Vec3 d = Vec3::Zero();
    for (int i = 0; i < all.count; ++i) d += all.lambda[i] * contacts.normal[i];
    const Vec3 farther = d - all.d;
    const bool converged = farther.squaredNorm() <= 1e-28 * d.squaredNorm();
    all.d = d;
    all.squared = d.squaredNorm();
    if (converged) return;
    for (int i = 0; i < all.count; ++i) {
      const FeatureHeight there = height_of(base, x, all.cut[i], p + d);
      Together::Cut& cut = all.cut[i];
      // With h_c = 0 the vector ends on the edge or vertex itself, which has no normal: its own stays, and the foot is there. Where others
      // push along the surface it ends beside, and the distance from there would turn aside and be none.
      if (cut.below) {
        cut.over.weight = there.weight;
        cut.over.height += contacts.normal[i].dot(farther);
      } else if (std::abs(there.height) > 1e-6 * d.norm() || cut.feature.kind == Kind::facet) {
        cut.over = there;
      } else {
        cut.over.weight = there.weight;
        cut.over.height = cut.contact_height;
      }
    }
    if (!all.curved) return;  // for facets one look is exact
  }
}

void add(const BaseSurface& base, const Vectors& x, const Vec3& p, const Mat3* allowed, const Together::Cut& cut, Together& all) {
  if (all.count == most_candidates) return;
  all.cut[all.count++] = cut;
  all.curved = all.curved || cut.feature.kind != Kind::facet;
  solve(base, x, p, allowed, all);
}

void add(const Stencil& stencil, Exit& out) {
  if (out.count < most_stencils) (*out.stencils)[out.count++] = stencil;
}

/// Past a wall: a depth that falls along the normal and outward, and its push.
///
/// With D the depth, dD = -by_normal dh - by_way ds; h and s have as gradients
///     dh = n . (dp - sum w_I dx_I),   ds = t . (dp - sum u_I dx_I) + h/s n . sum (w_I - u_I) dx_I
/// with w the weights in the plane of the facet and u those of the closest point of the wall.
struct Faded {
  double depth = 0;                   ///< [m] what is left
  double by_normal = 0, by_way = 0;
};

/// way  where the point stands that is past the wall, from the apex: other parts may have pushed it there
void push(const Stand& at, const Faded& faded, double level, const Vec3& way, Exit& out) {
  const Index facet = at.feature.facet;
  const Vec3 normal = faded.depth * at.over.normal;
  add({.facet = facet, .apex = 1, .weight = at.over.weight, .push = faded.by_normal * normal, .level = level}, out);
  add({.facet = facet, .apex = 1, .weight = at.wall_weight, .push = faded.by_way * faded.depth * at.outward}, out);
  Stencil couple{.facet = facet, .apex = 0, .weight = {}, .push = normal};
  const double lever = -faded.by_way * at.over.height / at.past;
  for (int I = 0; I < 3; ++I) couple.weight[I] = lever * (at.over.weight[I] - at.wall_weight[I]);
  add(couple, out);
  out.squared += faded.depth * faded.depth;
  out.has_moment = out.has_moment || !way.isZero(0);
  out.steepest = std::max(out.steepest, faded.by_normal * faded.by_normal + faded.by_way * faded.by_way);
  if (faded.depth > out.length) out.length = faded.depth, out.strongest = at.feature;
}

/// What is left of a depth D past the plateau by s, within L = max(0.02 of the face, 2 D):  D (1 - (s/L)^2).  No kink where it begins.
Faded faded(const Stand& at, double D, double size) {
  const bool wide = 2 * D > least_fade * size;
  const double L = wide ? 2 * D : least_fade * size, u = (at.past - whole_past_wall * size) / L;
  if (!(u < 1)) return {};
  return {D * (1 - u * u), wide ? 1 + u * u : 1 - u * u, 2 * D * u / L};
}

/// The height of a point at h < 0 below a facet and past its wall, for a layer h_c around the surface: -a over the wall, the distance s
/// from where the next face takes over.
///
///     s - a w(s / 3a),   w(u) = (1 - u)^2 (1 + 5 u)
struct Below {
  double height, by_normal, by_way;
};
Below below_wall(double height, double past) {
  const double a = -height, u = past / (3 * a);
  if (!(u < 1)) return {past, 0, 1};
  const double w = (1 - u) * (1 - u) * (1 + 5 * u), slope = (1 - u) * (3 - 15 * u);
  return {past - a * w, w - u * slope, 1 - slope / 3};
}

/// Of the faces across the wall where a point stands, the nearest that has it in front; -1 if there is none.
Index face_across(const BaseSurface& base, const Vectors& x, const Vec3& point, const Feature& wall, Index self) {
  Index best = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (int e = 0; e < 3; ++e) {
    const bool here = e == wall.local || (wall.kind == Kind::vertex && (e + 1) % 3 == wall.local);
    const Index across = base.neighbour(e, wall.facet);
    if (!here || !base.wall[wall.facet][e] || across < 0 || is_beside(base, self, across)) continue;
    const Vector<double> p{point.x(), point.y(), point.z()};
    const auto c = corners(base, x, across);
    const double squared = geometry::closest_on_triangle(c, p).distance_squared;
    const Vec3 corner = x.col(base.facets(0, across));
    if (facet_normal(base, x, across).dot(point - corner) < 0 || squared >= nearest) continue;
    best = across, nearest = squared;
  }
  return best;
}

/// The way out over the inside of one facet.
Exit over_one_facet(const FeatureHeight& over, double level, double release_height, Tracks& tracks, Stencils& stencils) {
  Exit out;
  out.stencils = &stencils;
  Track& track = tracks.track[0];
  const double depth = track.height - over.height;
  out.strongest = {track.facet, Kind::facet, 0};
  out.gap = -depth, out.level = track.height;
  out.depth = std::max(0.0, depth);
  if (depth > 0) {
    add({.facet = track.facet, .apex = 1, .weight = over.weight, .push = depth * over.normal, .level = track.height}, out);
    out.length = depth, out.squared = depth * depth;
  } else if (over.height >= level + release_height) {
    tracks.count = 0;
  }
  tracks.out = {tracks.count > 0 ? track.facet : -1, over.weight, std::max(over.height, track.height)};
  if (tracks.count > 0) track.height = std::max(track.height, std::min(over.height, level));
  return out;
}

}  // namespace

Exit shortest_exit(const BaseSurface& base, const Vectors& x, const Vec3& p, double contact_height, const Mat3* allowed, Moved moved,
               Tracks& tracks, Stencils& stencils, double release_height, Index self) {
  const auto level = [&](Index facet) { return contact_height + stand_off(base, facet); };
  if (tracks.count == 1 && allowed == nullptr) {  // well inside a facet
    Track& track = tracks.track[0];
    const FeatureHeight over = height_over(base, x, {track.facet, Kind::facet, 0}, p);
    if (moved.now < tracks.owned) return over_one_facet(over, level(track.facet), release_height, tracks, stencils);
    const Ownership owner = ownership(base, x, track.facet, over, std::max(std::abs(over.height), track.height));
    tracks.owned = moved.until(owner.room);
    if (owner.whole) return over_one_facet(over, level(track.facet), release_height, tracks, stencils);
  }
  tracks.owned = -infinite;
  Exit out;
  out.stencils = &stencils;
  std::array<Together, 2> way;
  std::array<bool, most_tracks> ends{}, acts{};
  std::array<double, most_tracks> height;  // at the end of the way
  height.fill(infinite);
  out.gap = infinite;
  for (int i = 0; i < tracks.count; ++i) {
    Track& track = tracks.track[i];
    Stand at = stand_whole(base, x, p + way[0].d, track.facet, self);
    const int g = way_of(way, at.over.normal, 0);
    if (g == 1) at = stand_whole(base, x, p + way[1].d, track.facet, self);
    Together& all = way[g];
    track.facet = at.feature.facet;
    for (int j = 0; j < i; ++j) ends[i] = ends[i] || (!ends[j] && tracks.track[j].facet == track.facet);  // two parts have met
    if (ends[i]) continue;
    if (way[0].has(track.facet) || way[1].has(track.facet)) {  // seen already at the end of the way of another track
      acts[i] = true;
      continue;
    }
    if (out.strongest.facet < 0) out.strongest = at.feature, out.level = track.height;
    bool outside = false;
    if (at.past > 0 && track.height > 0) {
      const bool open = ends_at(base, at.wall);
      const double h = at.over.height, past = at.past - (open ? whole_past_wall * base.size(track.facet) : 0);
      if (open || h < 0) {
        const double distance = std::hypot(h, past);
        const Below below = h < 0 ? below_wall(h, past) : Below{distance, h / distance, past / distance};
        const Index across = open || past < -3 * h ? -1 : face_across(base, x, p + all.d, at.wall, self);
        if (across < 0) {
          const double depth = track.height - below.height;
          out.gap = std::min(out.gap, -depth);
          if (depth > 0) push(at, {depth, below.by_normal, below.by_way}, track.height, all.d, out);
          else ends[i] = below.height >= level(track.facet);
          if (depth > 0) out.depth = std::max(out.depth, depth), acts[i] = true;
          continue;
        }
        at = stand_whole(base, x, p + all.d, across, self);
        track.facet = at.feature.facet;
      }
      if (at.past > 0 && at.over.height >= 0) {  // outside the layer is round
        outside = true;
        at.feature = at.wall;
        at.past = 0;
        at.over = height_over(base, x, at.wall, p + all.d);
        if (at.over.height < 0) at.over.height = -at.over.height, at.over.normal = -at.over.normal;
      }
    }
    if (at.past <= whole_past_wall * base.size(track.facet)) at.past = 0;
    const double depth = track.height - at.over.height;
    out.gap = std::min(out.gap, -depth);
    if (at.past > 0) {
      if (at.over.height >= level(track.facet)) {
        ends[i] = true;
      } else if (!(depth > 0)) {
        track.height = at.over.height;
      } else {
        const double steep = allowed ? 1 / (*allowed * at.over.normal).norm() : 1;  // the way out lies in the symmetry plane
        Faded left = faded(at, steep * depth, base.size(track.facet));
        left.by_normal *= steep;
        if (left.depth > 0) push(at, left, track.height, all.d, out), acts[i] = true;
        else ends[i] = true, ++out.lost;
      }
      continue;
    }
    out.depth = std::max(out.depth, depth);
    const bool nearest = track.height <= high_enough * base.longest(track.facet);
    const bool below = nearest && at.over.height < 0 && at.feature.kind != Kind::facet;
    add(base, x, p, allowed, {at.feature, at.over, track.height, i, outside, nearest, below}, all);
    // is the end of the way high enough over what is there?
    for (int look = 0; look < most_looks && track.height > 0 && all.count > 0 && all.lambda[all.count - 1] > 0; ++look) {
      const Stand end = stand_whole(base, x, p + all.d, track.facet, self);
      const bool high = end.over.height > track.height - high_enough * base.longest(track.facet);
      if (end.past > 0 || high) break;
      if (way_of(way, end.over.normal, g) != g) {  // the other side of a slot or of a sharp valley
        Together& other = way[1 - g];
        if (other.has(end.feature.facet)) break;
        const Vec3 there = p + other.d;
        add(base, x, p, allowed, {end.feature, height_over(base, x, end.feature, there), track.height, i}, other);
        break;
      }
      add(base, x, p, allowed, {end.feature, end.over, track.height, i}, all);
    }
  }

  double strongest = out.length;
  for (const Together& all : way) {
    const double length = std::sqrt(all.squared);
    out.squared += all.squared;
    out.length = std::max(out.length, length);
    out.has_moment = out.has_moment || (all.curved && all.count > 1);
    for (int i = 0; i < all.count; ++i) {
      const Together::Cut& cut = all.cut[i];
      height[cut.track] = std::min(height[cut.track], all.lambda[i] > 0 ? cut.contact_height : cut.over.height);
      acts[cut.track] = acts[cut.track] || all.lambda[i] > 0;
      if (!(all.lambda[i] > 0)) continue;
      if (all.lambda[i] > strongest) strongest = all.lambda[i], out.strongest = cut.feature;
      add({.facet = cut.feature.facet, .apex = 1, .weight = cut.over.weight, .push = all.lambda[i] * cut.over.normal,
           .kind = cut.feature.kind, .local = cut.feature.local, .level = cut.contact_height}, out);
    }
  }
  int kept = 0;
  for (int i = 0; i < tracks.count; ++i) {
    Track track = tracks.track[i];
    if (ends[i]) continue;
    if (height[i] < infinite) {
      if (height[i] >= level(track.facet) + release_height && !acts[i]) continue;
      track.height = std::max(track.height, std::min(height[i], level(track.facet)));
    }
    tracks.track[kept++] = track;
  }
  tracks.count = kept;
  tracks.out.facet = -1;
  if (kept > 0) {
    const Index facet = tracks.track[kept - 1].facet;
    const FeatureHeight over = height_over(base, x, {facet, Kind::facet, 0}, p + way[0].d);
    tracks.out = {facet, over.weight, over.height};
  }
  return out;
}

}  // namespace nereid::contact
