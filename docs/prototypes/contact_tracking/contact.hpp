#pragma once
// Contact of apexes with a base surface: common parts, and the methods `closest` and `tracked`.
#include <string>

#include "surface.hpp"

// ---- potential 1/2 k |d|^2: d the shortest vector with n_i . d >= depth_i ------------------------------------------
struct Cut {
  V n;
  double depth;
  double lambda = 0;
};
inline V shortest(std::vector<Cut>& c) {  // at most a few cuts: try all subsets of up to three
  const int m = c.size();
  V best = V::Zero();
  double least = 1e300, scale = 0;
  for (auto& k : c) k.lambda = 0, scale = std::max(scale, k.depth);
  if (scale <= 0) return best;
  std::vector<double> keep(m, 0.0);
  const auto attempt = [&](std::initializer_list<int> set) {
    const int s = set.size();
    Eigen::MatrixXd G(s, s);
    Eigen::VectorXd b(s);
    int i = 0;
    for (int a : set) {
      int j = 0;
      b(i) = c[a].depth;
      for (int e : set) G(i, j++) = c[a].n.dot(c[e].n);
      ++i;
    }
    const Eigen::VectorXd l = s == 1 ? Eigen::VectorXd(b / G(0, 0)) : Eigen::VectorXd(G.fullPivLu().solve(b));
    V d = V::Zero();
    i = 0;
    for (int a : set) {
      if (!(l(i) >= 0)) return;
      d += l(i++) * c[a].n;
    }
    if (!(d.squaredNorm() < least)) return;
    for (auto& k : c)
      if (k.n.dot(d) < k.depth - 1e-9 * scale) return;
    least = d.squaredNorm();
    best = d;
    std::fill(keep.begin(), keep.end(), 0.0);
    i = 0;
    for (int a : set) keep[a] = l(i++);
  };
  for (int i = 0; i < m; ++i) attempt({i});
  if (least > 1e299)
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < i; ++j) attempt({i, j});
  if (least > 1e299)
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < i; ++j)
        for (int k = 0; k < j; ++k) attempt({i, j, k});
  for (int i = 0; i < m; ++i) c[i].lambda = keep[i];
  return best;
}

inline std::array<double, 3> weights_in_plane(const Surface& S, const Xs& x, int f, const V& p) {
  const V &a = x[S.f[f][0]], e1 = x[S.f[f][1]] - a, e2 = x[S.f[f][2]] - a, r = p - a, N = e1.cross(e2);
  const double i = 1 / N.squaredNorm(), w1 = r.cross(e2).dot(N) * i, w2 = e1.cross(r).dot(N) * i;
  return {1 - w1 - w2, w1, w2};
}
/// Gives -force to the nodes of a facet where the line of the force through a point meets the facet's plane.
inline void react(const Surface& S, const Xs& x, int f, const V& point, const V& force, Xs& F) {
  const V n = S.normal(x, f);
  const double nf = n.dot(force), h = n.dot(point - x[S.f[f][0]]);
  const V c = std::abs(nf) > 1e-9 * force.norm() ? V(point - force * (h / nf)) : V(point - h * n);
  const auto w = weights_in_plane(S, x, f, c);
  for (int a = 0; a < 3; ++a) F[S.f[f][a]] -= w[a] * force;
}

// ---- interface and near list ----------------------------------------------------------------------------------------
struct Method;
struct Interface {
  const Surface* base;
  const Surface* own;  // own: the surface the apexes belong to (may be null)
  std::vector<int> apex;
  std::vector<double> k;
  double H = 0;  // h_c
  int base_body = -1, apex_body = -1;
  double margin = 0.1;
  std::vector<std::vector<int>> near;
  Xs when;  // positions of the last search
  long searches = 0;
  void search(const Xs& x) {
    if (!when.empty()) {
      double a = 0, b = 0;
      for (int i : apex) a = std::max(a, (x[i] - when[i]).squaredNorm());
      for (int i : base->nodes) b = std::max(b, (x[i] - when[i]).squaredNorm());
      if (std::sqrt(a) + std::sqrt(b) < margin / 2) return;
    }
    when = x;
    ++searches;
    near.assign(apex.size(), {});
    for (int f = 0; f < (int)base->f.size(); ++f) {
      V lo = x[base->f[f][0]], hi = lo;
      for (int a : base->f[f]) lo = lo.cwiseMin(x[a]), hi = hi.cwiseMax(x[a]);
      lo.array() -= margin;
      hi.array() += margin;
      for (size_t i = 0; i < apex.size(); ++i) {
        const V& p = x[apex[i]];
        if ((p.array() >= lo.array()).all() && (p.array() <= hi.array()).all()) near[i].push_back(f);
      }
    }
  }
};

struct Method {
  virtual ~Method() = default;
  virtual void start(Interface&, const Xs&) {}
  /// Adds forces at x1, reached from x0; returns the energy stored.
  virtual double forces(Interface&, const Xs& x0, const Xs& x1, Xs& F) = 0;
  virtual bool holds(int apex) const = 0;  // pushes or watches this apex
  virtual std::string tell(int) const { return {}; }
};

// ---- closest: the shallowest way out, sign by the angle-weighted normal ----------------------------------------------
struct ClosestMethod : Method {
  std::vector<char> held;
  bool holds(int a) const override { return held[a]; }
  double forces(Interface& I, const Xs&, const Xs& x, Xs& F) override {
    I.search(x);
    const Surface& S = *I.base;
    held.assign(I.apex.size(), 0);
    double E = 0;
    for (size_t a = 0; a < I.apex.size(); ++a) {
      const V p = x[I.apex[a]];
      int best = -1;
      Closest c{};
      c.d2 = 1e300;
      for (int f : I.near[a]) {
        const Closest t = S.closest(x, f, p);
        if (t.d2 < c.d2) c = t, best = f;
      }
      if (best < 0) continue;
      V n = S.normal(x, best), mean = n;
      bool border = false;
      if (c.kind == Kind::edge) {
        const int g = S.nb[best][c.local];
        if (g < 0)
          border = true;
        else
          mean += S.normal(x, g);
      }
      if (c.kind == Kind::vertex) {
        mean = S.angle_normal(x, S.f[best][c.local]);
        for (int g : S.ring[S.f[best][c.local]])
          for (int e = 0; e < 3; ++e)
            if (S.nb[g][e] < 0 && (S.f[g][e] == S.f[best][c.local] || S.f[g][(e + 1) % 3] == S.f[best][c.local])) border = true;
      }
      const V r = p - c.foot;
      if (border && (r - n.dot(r) * n).norm() > 0.05 * 50 * S.ell[best]) continue;  // past the border
      const double d = r.norm();
      double h = border || c.kind == Kind::facet ? n.dot(r) : (r.dot(mean) < 0 ? -d : d);
      if (h >= I.H) continue;
      V out = border || c.kind == Kind::facet || d == 0 ? n : V(r * ((h < 0 ? -1 : 1) / d));
      const V f = I.k[a] * (I.H - h) * out;
      E += 0.5 * I.k[a] * (I.H - h) * (I.H - h);
      held[a] = 1;
      F[I.apex[a]] += f;
      if (border)
        react(S, x, best, p, f, F);
      else
        for (int i = 0; i < 3; ++i) F[S.f[best][i]] -= c.w[i] * f;
    }
    return E;
  }
};

// ---- tracked ---------------------------------------------------------------------------------------------------------
struct Rules {
  bool facing = true;     // an apex enters only facets that its own surface faces
  bool fade = true;       // past a rim the force fades
  bool offset = true;     // sideways and initial entries begin without force
  bool others = true;     // separate parts of the surface get a track of their own
  bool sideways = true;   // entries through a rim
  bool linger = true;     // a faded track of small depth waits a while
  bool thickness = true;  // nothing begins deeper than 0.9 of the material behind
  bool middle = true;     // no jump to another facet from deeper than the middle of the material (in stand())
  bool groups = true;     // flanks that face each other push each on its own
  bool smooth = true;     // the fading begins and ends without a kink
  bool round = true;      // h_c > 0: outside, the layer goes round sharp edges and borders
  double hold = 0.3;      // n_apex . n_facet below this: faces
  double overlap = 1e-3;  // of a triangle's weights: neighbours overlap by so much, so that there is no hole
};
struct Track {
  int facet;
  double hc;
  double h = 0, s = 0;
  int kind = 0;
};  // hc: contact height of this track, lowered by an accepted overlap
struct State {
  int count = 0;
  Track track[3];
  int anchor = -1;
  std::array<double, 3> w;
  double height;  // where the apex would be if pushed out: start of the next sweep
  bool pushes = false;
  double E = 0;
};

struct TrackedMethod : Method {
  Rules R;
  std::vector<State> state;
  double deepest = 0, deepest_now = 0;
  long looked = 0, stands = 0, entries = 0, side_entries = 0, refused = 0, dropped_rim = 0;
  explicit TrackedMethod(Rules r = {}) : R(r) {}
  bool holds(int a) const override { return state[a].pushes || state[a].count > 0; }

  Stand stand_(const Surface& S, const Xs& x, const V& p, int f) const { return stand(S, x, p, f, R.middle); }
  std::string tell(int a) const override {
    std::string t;
    for (int i = 0; i < state[a].count; ++i) {
      const Track& k = state[a].track[i];
      char b[120];
      snprintf(b, 120, "E%.5f [f%d hc %.5f h %.5f s %.5f kind %d]", state[a].E, k.facet, k.hc, k.h, k.s, k.kind);
      t += b;
    }
    return t;
  }
  bool faces(const Interface& I, const Xs& x, int apex, const V& n) const {
    return !R.facing || !I.own || I.own->angle_normal(x, apex).dot(n) < R.hold;
  }
  double allowed_depth(const Surface& S, int f) const { return R.thickness ? std::min(0.9 * S.thick[f], 0.2 * S.longest[f]) : 1e30; }

  /// Of the facets the apex stands behind, the one it is least deep behind: for overlaps that did not come through the front.
  int least_deep(const Interface& I, int a, const Xs& x, const V& p, double& h_best, int through = -1) const {
    const Surface& S = *I.base;
    int best = -1;
    h_best = -1e300;
    for (int f : I.near[a]) {
      const V n = S.normal(x, f);
      const double h = n.dot(p - x[S.f[f][0]]);
      if (h >= I.H || h < -allowed_depth(S, f) || h <= h_best || !faces(I, x, I.apex[a], n)) continue;
      if (through >= 0 && n.dot(S.normal(x, through)) < -0.5) continue;  // the far side is not round the corner
      const auto w = weights_in_plane(S, x, f, p);
      if (std::min({w[0], w[1], w[2]}) < -R.overlap) continue;
      best = f, h_best = h;
    }
    return best;
  }

  void begin(const Interface& I, State& s, int f, double hc) {
    if (s.count < 3) s.track[s.count++] = Track{f, R.offset ? hc : I.H};
  }

  void start(Interface& I, const Xs& x) override {
    state.assign(I.apex.size(), {});
    I.search(x);
    for (size_t a = 0; a < I.apex.size(); ++a) {
      double h;
      const int f = least_deep(I, a, x, x[I.apex[a]], h);
      if (f >= 0) begin(I, state[a], f, h);
    }
  }

  /// The first facet that the path p0 - p1 crosses from its front, in the frame of the facet. -1: none. -2: only facets it does not face.
  int crossed(const Interface& I, int a, const Xs& x0, const Xs& x1, const V& p0, const V& p1, double level, bool must_face,
              const State* not_around) const {
    const Surface& S = *I.base;
    int best = -1;
    double first = 1e300, steepest = 0;
    int unfaced = -1;
    for (int f : I.near[a]) {
      const auto& c = S.f[f];
      const V n1 = S.normal(x1, f);
      const double h1 = n1.dot(p1 - x1[c[0]]);
      if (h1 >= level) continue;
      const double h0 = S.normal(x0, f).dot(p0 - x0[c[0]]);
      if (h0 < level - 1e-9 * S.size || h0 <= h1) continue;
      const double t = std::clamp((h0 - level) / (h0 - h1), 0.0, 1.0);
      if (t > first + 1e-9) continue;
      // weights of the crossing point: of the triangle where it is then
      const V A = x0[c[0]] + t * (x1[c[0]] - x0[c[0]]), B = x0[c[1]] + t * (x1[c[1]] - x0[c[1]]), C = x0[c[2]] + t * (x1[c[2]] - x0[c[2]]);
      const V p = p0 + t * (p1 - p0), e1 = B - A, e2 = C - A, r = p - A, N = e1.cross(e2);
      const double i = 1 / N.squaredNorm(), w1 = r.cross(e2).dot(N) * i, w2 = e1.cross(r).dot(N) * i;
      if (std::min({w1, w2, 1 - w1 - w2}) < -R.overlap) continue;
      if (not_around) {
        bool around = false;
        for (int k = 0; k < not_around->count;
             ++k) {  // the patch around a track is looked after by the track, but not the opposite flank of a valley
          const int t = not_around->track[k].facet;
          const V nt = S.normal(x1, t), centre = (x1[c[0]] + x1[c[1]] + x1[c[2]]) / 3;
          if (t != f && nt.dot(n1) <= 0 && nt.dot(centre - x1[S.f[t][0]]) > 0) continue;
          for (int u : S.f[t])
            for (int v : c) around = around || u == v;
        }
        if (around) continue;
      }
      if (must_face && !faces(I, x1, I.apex[a], n1)) {
        unfaced = f;
        continue;
      }
      if (t < first - 1e-9 || h0 - h1 > steepest) best = f, steepest = h0 - h1, first = std::min(t, first);
    }
    return best >= 0 ? best : unfaced >= 0 ? -2 - unfaced : -1;
  }

  void enter(Interface& I, int a, const Xs& x0, const Xs& x1, const V& p0, const V& p1) {
    const Surface& S = *I.base;
    State& s = state[a];
    int f = crossed(I, a, x0, x1, p0, p1, I.H, true, nullptr);
    if (f >= 0) {
      begin(I, s, f, I.H);
      ++entries;
      return;
    }
    if (f == -1 && I.H > 0) {
      f = crossed(I, a, x0, x1, p0, p1, 0, true, nullptr);  // between the layers of two facets, through the surface itself
      if (f >= 0) {
        begin(I, s, f, std::sqrt(S.closest(x0, f, p0).d2) < I.H ? S.normal(x1, f).dot(p1 - x1[S.f[f][0]]) : I.H);
        ++entries;
        return;
      }
      f = -1;  // within the layer a facet that it does not face is the far side of what holds it
    }
    if (f <= -2) {  // through a facet that it does not face: it came over a rim, and belongs to a facet it faces
      double h;
      const int g = least_deep(I, a, x1, p1, h, -2 - f);
      if (g >= 0 && R.sideways)
        begin(I, s, g, h), ++side_entries;
      else
        begin(I, s, -2 - f, I.H), ++refused;
      return;
    }
    if (!R.sideways) return;
    // under an open border, not deeper than twice the deepest contact
    int best = -1;
    double hb = -1e300;
    if (I.H > 0 && R.round) {  // into the rounded layer around an edge or vertex
      double least = I.H;
      for (int g : I.near[a]) {
        const Closest c = S.closest(x1, g, p1);
        const double d = std::sqrt(c.d2);
        if (c.kind == Kind::facet || d >= least || S.normal(x1, g).dot(p1 - c.foot) < 0) continue;
        const V r = p1 - c.foot, n = S.normal(x1, g);
        if ((r - n.dot(r) * n).norm() < 1e-6 * S.size) continue;  // over a flat edge
        least = d;
        best = g;
        hb = I.H;
      }
      double before = 1e300;  // who was in the layer already came from elsewhere
      if (best >= 0)
        for (int g : I.near[a]) before = std::min(before, S.closest(x0, g, p0).d2);
      if (best >= 0 && before >= I.H * I.H * (1 - 1e-9)) {
        begin(I, s, best, hb);
        ++entries;
        return;
      }
      best = -1;
      hb = -1e300;
    }
    for (int g : I.near[a]) {
      if (!(S.wall[g][0] || S.wall[g][1] || S.wall[g][2])) continue;
      const V n = S.normal(x1, g);
      const double h = n.dot(p1 - x1[S.f[g][0]]);
      if (h >= I.H || h <= hb) continue;
      const auto w1 = weights_in_plane(S, x1, g, p1);
      if (std::min({w1[0], w1[1], w1[2]}) < 0) continue;
      const auto w0 = weights_in_plane(S, x0, g, p0);
      bool over = false;
      for (int e = 0; e < 3; ++e) {
        if (!S.wall[g][e] || w0[(e + 2) % 3] >= 0) continue;
        over = over || (S.nb[g][e] < 0 && I.H - h <= 2 * deepest);
      }
      if (!over || !faces(I, x1, I.apex[a], n)) continue;
      best = g, hb = h;
    }
    if (best >= 0) begin(I, s, best, hb), ++side_entries;
  }

  /// Planes that are left together, by the shortest way: 1/2 k |d|^2.
  struct Group {
    std::vector<Cut> cuts;
    std::vector<Stand> feet;
    std::vector<int> track;
    V d = V::Zero();
    void add(const Stand& st, double depth, int i) {
      cuts.push_back({st.n, depth + st.n.dot(d)});
      feet.push_back(st);
      track.push_back(i);
      d = shortest(cuts);
    }
  };

  /// Of the faces across the sharp edges where a point stands past the rim, the nearest that has it in front; -1 if none.
  int face_behind(const Surface& S, const Xs& x, const V& p, const Stand& st) const {
    int best = -1;
    double least = 1e300;
    for (int e = 0; e < 3; ++e) {
      const bool here = st.at.kind == Kind::edge ? st.at.local == e : st.at.local == e || st.at.local == (e + 1) % 3;
      const int g = S.nb[st.facet][e];
      if (!here || !S.wall[st.facet][e] || g < 0) continue;
      const Closest c = S.closest(x, g, p);
      if (S.normal(x, g).dot(p - c.foot) < 0 || c.d2 >= least) continue;
      best = g;
      least = c.d2;
    }
    return best;
  }

  /// Past a rim: the depth that is left, and the force along its gradient. False where nothing is left.
  bool fade(const Stand& st, double D, double ell, double& left, V& gradient) const {
    const double L = std::max(ell, 2 * D), u = st.s / L;
    if (!R.fade || u >= 1) return false;
    if (!R.smooth) {
      left = D * (1 - u);
      gradient = (2 * D > ell ? 1 : 1 - u) * st.n + D / L * st.t;
      return true;
    }
    left = D * (1 - u * u);  // no kink where the fading begins, none where it ends
    gradient = (2 * D > ell ? 1 + u * u : 1 - u * u) * st.n + 2 * D * u / L * st.t;
    return true;
  }

  /// Pushes the apex out of what its tracks stand behind; drops tracks that have ended. Returns the energy stored.
  double push(Interface& I, int a, const Xs& x, Xs& F) {
    const Surface& S = *I.base;
    State& s = state[a];
    const V p = x[I.apex[a]];
    const double k = I.k[a];
    double E = 0;
    std::array<Group, 2> group;  // flanks that face each other push each on its own, the others are left together
    std::array<char, 3> keep{1, 1, 1};
    s.pushes = false;
    for (int i = 0; i < s.count; ++i) {
      Track& t = s.track[i];
      int g = 0;
      Stand st = stand_(S, x, p + group[0].d, t.facet);
      looked += st.looked;
      ++stands;
      for (const Cut& c : group[0].cuts)
        if (R.groups && c.n.dot(st.n) < 0) g = 1;
      if (g == 1) st = stand_(S, x, p + group[1].d, t.facet), looked += st.looked, ++stands;
      t.facet = st.facet;
      t.h = st.h;
      t.s = st.s;
      t.kind = (int)st.at.kind;
      for (int j = 0; j < i; ++j)
        if (keep[j] && s.track[j].facet == t.facet) keep[i] = 0;  // two tracks have met
      if (!keep[i]) continue;
      if (R.round && st.s > 0 && t.hc > 0 &&
          st.h < 0) {  // below the surface and past its rim: is it nearer to the outside of the next face?
        // height = s - a w(s / 3a): -a above the rim, the distance s from where the next face takes over; no kinks
        const double below = -st.h, u = st.s / (3 * below), w = (1 - u) * (1 - u) * (1 + 5 * u), by_u = (1 - u) * (3 - 15 * u);
        const int next = u < 1 ? -1 : face_behind(S, x, p + group[g].d, st);
        if (next >= 0) {
          st = stand_(S, x, p + group[g].d, next);
          t.facet = st.facet;
        } else {
          const double height = u < 1 ? st.s - below * w : st.s, left = t.hc - height;
          if (left > 0) {
            const V f = k * left * ((u < 1 ? w - u * by_u : 0) * st.n + (u < 1 ? 1 - by_u / 3 : 1) * st.t);
            E += 0.5 * k * left * left;
            F[I.apex[a]] += f;
            react(S, x, st.facet, p, f, F);
            s.pushes = true;
          } else if (height >= I.H)
            keep[i] = 0, ++dropped_rim;
          continue;
        }
      }
      if (R.round && st.s > 0 && t.hc > 0 && st.h >= 0) {  // outside the layer is round
        const V r = p + group[g].d - st.at.foot;
        const double d = std::sqrt(st.at.d2);
        st.h = d;
        st.n = r / d;
        st.s = 0;
      }
      const double D = t.hc - st.h;
      if (st.s > 0) {
        double left;
        V gradient;
        if (st.h >= I.H)
          keep[i] = 0;
        else if (D <= 0)
          t.hc = st.h;
        else if (fade(st, D, S.ell[st.facet], left, gradient)) {
          const V f = k * left * gradient;
          E += 0.5 * k * left * left;
          F[I.apex[a]] += f;
          react(S, x, st.facet, p, f, F);
          s.pushes = true;
        } else if (!(R.fade && R.linger && D < S.ell[st.facet] / 2 && st.s < 2 * S.ell[st.facet])) {
          keep[i] = 0;
          ++dropped_rim;
        }
        continue;
      }
      deepest_now = std::max(deepest_now, D);
      group[g].add(st, D, i);
      for (int round = 0; round < 3 && t.hc > 0 && group[g].cuts.back().lambda > 0;
           ++round) {  // is the end of the way high enough over what is there?
        const Stand end = stand_(S, x, p + group[g].d, t.facet);
        looked += end.looked;
        ++stands;
        if (end.s > 0 || end.h > t.hc - 1e-9 * S.size) break;
        bool facing = false;
        for (const Cut& c : group[g].cuts) facing = facing || (R.groups && c.n.dot(end.n) < 0);
        if (facing) break;
        group[g].add(end, t.hc - end.h, i);
      }
    }
    int q_facet = -1;
    V q = p;
    std::array<double, 3> height{1e300, 1e300, 1e300};
    std::array<char, 3> acts{};
    for (Group& G : group) {
      E += 0.5 * k * G.d.squaredNorm();
      for (size_t c = 0; c < G.cuts.size(); ++c) {
        const int i = G.track[c];
        height[i] = std::min(height[i], s.track[i].hc - G.cuts[c].depth + G.cuts[c].n.dot(G.d));  // at the end of the way
        acts[i] = acts[i] || G.cuts[c].lambda > 0;
        if (G.cuts[c].lambda <= 0) continue;
        const V f = k * G.cuts[c].lambda * G.cuts[c].n;
        const Stand& st = G.feet[c];
        s.pushes = true;
        F[I.apex[a]] += f;
        if (st.at.kind == Kind::facet)
          react(S, x, st.facet, p + G.d, f, F);
        else
          for (int j = 0; j < 3; ++j) F[S.f[st.facet][j]] -= st.at.w[j] * f;
      }
    }
    for (int i = 0; i < s.count; ++i) {  // an accepted overlap shrinks with the overlap
      if (height[i] > 1e299) continue;
      if (height[i] >= I.H && !acts[i])
        keep[i] = 0;
      else
        s.track[i].hc = std::max(s.track[i].hc, std::min(height[i], I.H));
    }
    int kept = 0;
    for (int i = 0; i < s.count; ++i)
      if (keep[i]) {
        q_facet = s.track[i].facet;
        s.track[kept++] = s.track[i];
      }
    s.count = kept;
    q = p + group[0].d;
    s.anchor = q_facet;
    s.E = E;
    if (q_facet >= 0) {
      s.w = weights_in_plane(S, x, q_facet, q);
      s.height = S.normal(x, q_facet).dot(q - x[S.f[q_facet][0]]);
    }
    return E;
  }

  V place_of(const Surface& S, const Xs& x, const State& s) const {
    const auto& c = S.f[s.anchor];
    return s.w[0] * x[c[0]] + s.w[1] * x[c[1]] + s.w[2] * x[c[2]] + s.height * S.normal(x, s.anchor);
  }

  double forces(Interface& I, const Xs& x0, const Xs& x1, Xs& F) override {
    I.search(x1);
    const Surface& S = *I.base;
    if (state.size() != I.apex.size()) start(I, x0);
    deepest_now = 0;
    double E = 0;
    Xs G;
    for (size_t a = 0; a < I.apex.size(); ++a) {
      State& s = state[a];
      if (I.near[a].empty() && s.count == 0) {
        s.pushes = false;
        continue;
      }
      const V p1 = x1[I.apex[a]];
      if (s.count == 0) enter(I, a, x0, x1, x0[I.apex[a]], p1);
      if (s.count == 0) {
        s.pushes = false;
        continue;
      }
      const bool had = s.anchor >= 0;
      const V from = had ? place_of(S, x0, s) : x0[I.apex[a]];
      // trial push for the end of the sweep; forces only once it is known which tracks act
      if (R.others) {
        const State before = s;
        G.assign(F.size(), V::Zero());
        const double e = push(I, a, x1, G);
        const V to = s.count > 0 ? place_of(S, x1, s) : p1;
        State around = s.count > 0 ? s : before;
        const int f = crossed(I, a, x0, x1, from, to, I.H, false, s.count > 0 ? &around : nullptr);
        if (f >= 0) {
          begin(I, s, f, I.H);
          E += push(I, a, x1, F);
        } else {
          for (size_t i = 0; i < F.size(); ++i) F[i] += G[i];
          E += e;
        }
      } else {
        E += push(I, a, x1, F);
      }
      if (s.count == 0) s.anchor = -1;
    }
    deepest = deepest_now;
    return E;
  }
};
