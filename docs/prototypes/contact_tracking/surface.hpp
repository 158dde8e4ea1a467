#pragma once
// A triangulated surface with adjacency, cut into patches by sharp ridges and borders,
// and how a point stands over the patch of a facet.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>

using V = Eigen::Vector3d;
using Xs = std::vector<V>;

enum class Kind { vertex, edge, facet };
struct Closest {
  Kind kind;
  int local;  // edge 0-1, 1-2, 2-0 or vertex
  std::array<double, 3> w;
  V foot;
  double d2;
};
inline Closest closest_on_triangle(const V& a, const V& b, const V& c, const V& p) {
  const auto found = [&](Kind k, int l, double w0, double w1, double w2) {
    const V q = w0 * a + w1 * b + w2 * c;
    return Closest{k, l, {w0, w1, w2}, q, (p - q).squaredNorm()};
  };
  const V ab = b - a, ac = c - a, pa = p - a, pb = p - b, pc = p - c;
  const double d1 = ab.dot(pa), d2 = ac.dot(pa);
  if (d1 <= 0 && d2 <= 0) return found(Kind::vertex, 0, 1, 0, 0);
  const double d3 = ab.dot(pb), d4 = ac.dot(pb);
  if (d3 >= 0 && d4 <= d3) return found(Kind::vertex, 1, 0, 1, 0);
  const double d5 = ab.dot(pc), d6 = ac.dot(pc);
  if (d6 >= 0 && d5 <= d6) return found(Kind::vertex, 2, 0, 0, 1);
  const double C = d1 * d4 - d3 * d2;
  if (C <= 0 && d1 >= 0 && d3 <= 0) {
    const double s = d1 / (d1 - d3);
    return found(Kind::edge, 0, 1 - s, s, 0);
  }
  const double A = d3 * d6 - d5 * d4;
  if (A <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double s = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return found(Kind::edge, 1, 0, 1 - s, s);
  }
  const double B = d5 * d2 - d1 * d6;
  if (B <= 0 && d2 >= 0 && d6 <= 0) {
    const double s = d2 / (d2 - d6);
    return found(Kind::edge, 2, 1 - s, 0, s);
  }
  const double t = A + B + C;
  return found(Kind::facet, 0, A / t, B / t, C / t);
}

struct Surface {
  std::vector<std::array<int, 3>> f;      // nodes
  std::vector<std::array<int, 3>> nb;     // facet across edge 0-1, 1-2, 2-0; -1 at a border
  std::vector<std::array<char, 3>> wall;  // the patch ends behind this edge: border or sharp ridge (of the reference)
  std::vector<std::array<char, 3>> rim;   // a wall ends in this vertex
  std::vector<double> ell;                // least fading length: 2 % of the face
  std::vector<double> thick;              // material behind the facet
  std::vector<double> lean, longest;      // tan of half the largest turn around the facet, with room; its longest edge
  std::vector<std::vector<int>> ring;     // facets around each node
  std::vector<int> nodes;
  double size = 1;

  V normal(const Xs& x, int i) const { return (x[f[i][1]] - x[f[i][0]]).cross(x[f[i][2]] - x[f[i][0]]).normalized(); }
  Closest closest(const Xs& x, int i, const V& p) const { return closest_on_triangle(x[f[i][0]], x[f[i][1]], x[f[i][2]], p); }
  V angle_normal(const Xs& x, int node, int only_patch_of = -1) const {  // angle-weighted
    V n = V::Zero();
    (void)only_patch_of;
    for (int g : ring[node]) {
      int a = 0;
      while (f[g][a] != node) ++a;
      const V u = (x[f[g][(a + 1) % 3]] - x[node]).normalized(), v = (x[f[g][(a + 2) % 3]] - x[node]).normalized();
      n += std::acos(std::clamp(u.dot(v), -1.0, 1.0)) * normal(x, g);
    }
    return n.normalized();
  }
};

struct SurfaceOptions {
  double sharp_cosine = getenv("SHARP") ? atof(getenv("SHARP")) : 0.1;
};  // a ridge that turns by more than 84 degrees is sharp

inline Surface make_surface(std::vector<std::array<int, 3>> facets, const Xs& x, SurfaceOptions o = {}) {
  Surface s;
  s.f = std::move(facets);
  const int n = s.f.size();
  s.nb.assign(n, {-1, -1, -1});
  s.wall.assign(n, {1, 1, 1});
  s.rim.assign(n, {0, 0, 0});
  s.ell.assign(n, 0);
  s.thick.assign(n, 1e30);
  s.ring.resize(x.size());
  std::map<std::pair<int, int>, std::pair<int, int>> edge;
  for (int i = 0; i < n; ++i)
    for (int e = 0; e < 3; ++e) edge[{s.f[i][e], s.f[i][(e + 1) % 3]}] = {i, e};
  for (int i = 0; i < n; ++i)
    for (int e = 0; e < 3; ++e) {
      auto it = edge.find({s.f[i][(e + 1) % 3], s.f[i][e]});
      if (it == edge.end()) continue;
      const int g = it->second.first;
      s.nb[i][e] = g;
      const V ni = s.normal(x, i), ng = s.normal(x, g);
      V cg = V::Zero();
      for (int a : s.f[g]) cg += x[a] / 3;
      const bool convex = ni.dot(cg - x[s.f[i][e]]) < 0;
      s.wall[i][e] = convex && ni.dot(ng) < o.sharp_cosine;
    }
  for (int i = 0; i < n; ++i)
    for (int a : s.f[i]) s.ring[a].push_back(i);
  for (int a = 0; a < (int)x.size(); ++a)
    if (!s.ring[a].empty()) s.nodes.push_back(a);
  for (int i = 0; i < n; ++i)
    for (int a = 0; a < 3; ++a)
      for (int g : s.ring[s.f[i][a]])
        for (int e = 0; e < 3; ++e)
          if (s.wall[g][e] && (s.f[g][e] == s.f[i][a] || s.f[g][(e + 1) % 3] == s.f[i][a])) s.rim[i][a] = 1;
  s.lean.assign(n, 0);
  s.longest.assign(n, 0);
  for (int i = 0; i < n; ++i)
    for (int e = 0; e < 3; ++e) {
      s.longest[i] = std::max(s.longest[i], (x[s.f[i][e]] - x[s.f[i][(e + 1) % 3]]).norm());
      for (int g : s.ring[s.f[i][e]])
        for (int k = 0; k < 3; ++k) {
          if (s.nb[g][k] < 0 || s.wall[g][k]) continue;
          const double turn = std::acos(std::clamp(s.normal(x, g).dot(s.normal(x, s.nb[g][k])), -1.0, 1.0));
          s.lean[i] = std::max(s.lean[i], 1.5 * std::tan(std::min(turn, 2.8) / 2));
        }
    }
  V lo = V::Constant(1e30), hi = -lo;
  for (int a : s.nodes) lo = lo.cwiseMin(x[a]), hi = hi.cwiseMax(x[a]);
  s.size = (hi - lo).norm();
  for (int i = 0; i < n; ++i) {
    s.ell[i] =
        (getenv("ELL") ? atof(getenv("ELL")) : 0.02) * std::sqrt((x[s.f[i][1]] - x[s.f[i][0]]).cross(x[s.f[i][2]] - x[s.f[i][0]]).norm());
    // material behind: first back face met by a ray from the centre against the normal
    V c = V::Zero();
    for (int a : s.f[i]) c += x[a] / 3;
    const V dir = -s.normal(x, i);
    for (int g = 0; g < n; ++g) {
      if (g == i) continue;
      const V ng = s.normal(x, g);
      const double den = ng.dot(dir);
      if (den < 1e-9) continue;
      const double t = ng.dot(x[s.f[g][0]] - c) / den;
      if (t < -1e-9 * s.size || t > s.thick[i]) continue;
      const auto q = s.closest(x, g, c + t * dir);
      if (q.d2 < 1e-16 * s.size * s.size) s.thick[i] = std::max(t, 0.0);
    }
  }
  return s;
}

// How a point stands over the patch of a facet: the closest point of the patch, found from that facet.
inline bool across_a_wall(const Surface& S, int f, int g) {
  for (int e = 0; e < 3; ++e)
    if (S.wall[f][e] && S.nb[f][e] == g) return true;
  return false;
}
struct Stand {
  int facet;
  Closest at;
  V n;           // unit, to the outside
  double h;      // signed height
  double s = 0;  // past the rim by s in direction t (h is then over the plane of the facet)
  V t = V::Zero();
  int looked = 0;
};

inline Stand stand(const Surface& S, const Xs& x, const V& p, int from, bool middle = true) {
  int facet = from;
  static const bool quick = !getenv("SLOW");
  if (quick) {  // well inside a facet, nothing around it can be nearer: one plane, no neighbour is looked at
    const auto& c = S.f[facet];
    const V a = x[c[1]] - x[c[0]], b = x[c[2]] - x[c[0]], r = p - x[c[0]], N = a.cross(b);
    const double i = 1 / std::sqrt(N.squaredNorm());
    const V n = i * N;
    const double h = n.dot(r), w1 = i * r.cross(b).dot(n), w2 = i * a.cross(r).dot(n), w0 = 1 - w1 - w2;
    const double room = std::abs(h) * S.lean[facet] * S.longest[facet] * i;
    if (std::min({w0, w1, w2}) >= room && std::abs(h) < 0.3 * S.longest[facet])
      return Stand{facet, {Kind::facet, 0, {w0, w1, w2}, p - h * n, h * h}, n, h};
  }
  Closest best = S.closest(x, facet, p);
  constexpr int most = 48;
  std::array<int, most> queue;
  int looked = 1;
  for (int hop = 0; hop < 100; ++hop) {
    const Closest here = best;
    const int at = facet;
    const double reach = 2 * std::sqrt(here.d2) + 1e-9 * S.size;
    const bool inside = here.kind == Kind::facet;
    int count = 1;
    queue[0] = at;
    for (int i = 0; i < count; ++i) {
      const int q = queue[i];
      for (int e = 0; e < 3; ++e) {
        const int g = S.nb[q][e];
        if (g < 0 || S.wall[q][e] || count == most) continue;
        if (std::find(queue.begin(), queue.begin() + count, g) != queue.begin() + count) continue;
        const V &a = x[S.f[q][e]], &b = x[S.f[q][(e + 1) % 3]];
        const double u = std::clamp((here.foot - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        if ((a + u * (b - a) - here.foot).squaredNorm() > reach * reach) continue;
        queue[count++] = g;
        const Closest there = S.closest(x, g, p);
        ++looked;
        if (!(there.d2 < (1 - 1e-12) * best.d2)) continue;
        // no jump to another facet from deeper than the middle of the material: there the far sides are nearer

        if (inside && middle && here.d2 > 0.2 * S.thick[at] * S.thick[at]) continue;

        best = there, facet = g;
      }
    }
    if (facet == at) break;
  }
  Stand st{facet, best, S.normal(x, facet), 0};
  st.looked = looked;
  const V r = p - best.foot;
  if (best.kind == Kind::facet) {
    st.h = st.n.dot(r);
    return st;
  }
  const bool rim = best.kind == Kind::edge ? S.wall[facet][best.local] : S.rim[facet][best.local];
  if (rim) {
    st.h = st.n.dot(r);
    const V along = r - st.h * st.n;
    st.s = along.norm();
    if (st.s > 1e-9 * S.size)
      st.t = along / st.s;
    else
      st.s = 0;
    return st;
  }
  const double d = std::sqrt(best.d2);
  V mean = best.kind == Kind::edge ? V(st.n + S.normal(x, S.nb[facet][best.local])) : S.angle_normal(x, S.f[facet][best.local]);
  const double sign = r.dot(mean) < 0 ? -1 : 1;
  st.h = sign * d;
  if (d > 1e-14 * S.size)
    st.n = sign / d * r;
  else
    st.n = mean.normalized();
  return st;
}
