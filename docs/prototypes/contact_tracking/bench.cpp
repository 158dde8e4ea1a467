// What a near apex costs: the prototype, a lean scalar version of the common case, and a pack of it.
#include <chrono>
#include <cstdio>
#include <experimental/simd>
#include <random>

#include "world.hpp"
namespace stdx = std::experimental;
using P = stdx::native_simd<double>;
constexpr int lanes = P::size();

struct Pos {
  double x, y, z;
};
double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// one track per apex: facet, hc; per facet: three nodes, room factor lean * longest
struct Flat {
  std::vector<int> n0, n1, n2;
  std::vector<double> room;
};

template <class T>
struct Out {
  T h, w1, w2, fx, fy, fz;
};
// T = double or pack: height, weights and force; sure: nothing around the facet can be nearer
template <class T, class M>
inline void element(const T (&c)[9], const T (&p)[3], T room_factor, T hc, T k, T& h, T& w1, T& w2, T (&f)[3], M& sure) {
  using std::sqrt;
  const T ax = c[3] - c[0], ay = c[4] - c[1], az = c[5] - c[2], bx = c[6] - c[0], by = c[7] - c[1], bz = c[8] - c[2];
  const T rx = p[0] - c[0], ry = p[1] - c[1], rz = p[2] - c[2];
  T nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
  const T i = 1.0 / sqrt(nx * nx + ny * ny + nz * nz);
  nx *= i;
  ny *= i;
  nz *= i;
  h = nx * rx + ny * ry + nz * rz;
  w1 = i * (nx * (ry * bz - rz * by) + ny * (rz * bx - rx * bz) + nz * (rx * by - ry * bx));
  w2 = i * (nx * (ay * rz - az * ry) + ny * (az * rx - ax * rz) + nz * (ax * ry - ay * rx));
  using std::abs;
  const T room = abs(h) * room_factor * i - 1e-9;
  sure = w1 >= room && w2 >= room && 1.0 - w1 - w2 >= room;
  const T D = hc - h;
  const T s = k * D;
  f[0] = s * nx;
  f[1] = s * ny;
  f[2] = s * nz;
}

int main() {
  const int N = 100;
  Mesh m = box(1, 1, .1, N, N, 1);
  Xs x;
  for (auto& q : m.x) x.push_back(q);
  std::vector<std::array<int, 3>> top;
  for (auto& f : m.f) {
    V n = (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]);
    if (n.z() > .99 * n.norm()) top.push_back(f);
  }
  // make_surface finds the thickness with a plain loop: too slow here, an open face needs none
  Surface S = [&] {
    auto cut = top;
    cut.resize(0);
    Surface s;
    s = make_surface(std::vector<std::array<int, 3>>(top.begin(), top.begin() + 2), x);
    return s;
  }();
  {  // adjacency by hand through a small make_surface without thickness
    std::map<std::pair<int, int>, int> e;
    const int n = top.size();
    S.f = top;
    S.nb.assign(n, {-1, -1, -1});
    S.wall.assign(n, {1, 1, 1});
    S.rim.assign(n, {0, 0, 0});
    S.ell.assign(n, 2e-4);
    S.thick.assign(n, 1e30);
    S.lean.assign(n, 1e-9);
    S.longest.assign(n, 1.5 / N);
    S.ring.assign(x.size(), {});
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k) e[{top[i][k], top[i][(k + 1) % 3]}] = i, S.ring[top[i][k]].push_back(i);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k) {
        auto it = e.find({top[i][(k + 1) % 3], top[i][k]});
        if (it != e.end()) S.nb[i][k] = it->second, S.wall[i][k] = 0;
      }
    S.nodes.clear();
    for (size_t i = 0; i < x.size(); ++i)
      if (!S.ring[i].empty()) S.nodes.push_back(i);
    S.size = 1.4;
  }
  std::mt19937 gen(1);
  std::uniform_real_distribution<double> u(0, 1);
  for (int kind : {0, 1, 2}) {  // inside facets; exactly over vertices; free, one facet in the near list crossed by nobody
    std::vector<int> facet;
    Xs all = x;
    Interface I;
    I.base = &S;
    I.own = nullptr;
    I.H = 0;
    I.margin = .004;
    for (int i = 0; i < (int)top.size(); ++i) {
      V p;
      if (kind != 1) {
        double a = .2 + .2 * u(gen), b = .2 + .2 * u(gen);
        p = (1 - a - b) * x[top[i][0]] + a * x[top[i][1]] + b * x[top[i][2]];
      } else {
        p = x[top[i][0]];
        if (std::abs(p.x()) > .45 || std::abs(p.y()) > .45) continue;
      }
      p.z() += kind == 2 ? 1e-3 : -1e-4;
      I.apex.push_back(all.size());
      I.k.push_back(1);
      all.push_back(p);
      facet.push_back(i);
    }
    const int n = facet.size();
    Xs F(all.size(), V::Zero());
    S.ring.resize(all.size());
    I.near.assign(n, {});
    I.when = all;
    for (int a = 0; a < n; ++a) {
      I.near[a].push_back(facet[a]);
      for (int g : S.nb[facet[a]])
        if (g >= 0) I.near[a].push_back(g);
    }
    TrackedMethod M({.facing = false, .others = false});
    M.state.assign(n, {});
    if (kind < 2)
      for (int a = 0; a < n; ++a) M.state[a].count = 1, M.state[a].track[0] = {facet[a], 0.0};
    double best = 1e9, E = 0;
    for (int r = 0; r < 20; ++r) {
      const double t = now();
      E += M.forces(I, all, all, F);
      best = std::min(best, now() - t);
    }
    printf("kind %d: prototype %.0f ns per near apex (others swept: no)  [E %g, looked per stand %.2f]\n", kind, best / n * 1e9, E,
           M.stands ? double(M.looked) / M.stands : 0.0);
    if (kind == 2) continue;
    // lean scalar and pack
    std::vector<Pos> X(all.size());
    for (size_t i = 0; i < all.size(); ++i) X[i] = {all[i].x(), all[i].y(), all[i].z()};
    Flat B;
    for (auto& f : S.f) B.n0.push_back(f[0]), B.n1.push_back(f[1]), B.n2.push_back(f[2]), B.room.push_back(1e-9 * 1.5 / N);
    std::vector<Pos> G(all.size(), {0, 0, 0});
    std::vector<double> hc(n, 0.0), k(n, 1.0);
    long unsure = 0;
    const auto scatter = [&](int a, int f, double w1, double w2, double fx, double fy, double fz) {
      const double w[3] = {1 - w1 - w2, w1, w2};
      const int c[3] = {B.n0[f], B.n1[f], B.n2[f]};
      Pos& g = G[I.apex[a]];
      g.x += fx;
      g.y += fy;
      g.z += fz;
      for (int j = 0; j < 3; ++j) G[c[j]].x -= w[j] * fx, G[c[j]].y -= w[j] * fy, G[c[j]].z -= w[j] * fz;
    };
    best = 1e9;
    for (int r = 0; r < 50; ++r) {
      const double t = now();
      for (int a = 0; a < n; ++a) {
        const int f = facet[a];
        const Pos &A = X[B.n0[f]], &C = X[B.n1[f]], &D = X[B.n2[f]], &q = X[I.apex[a]];
        const double c[9] = {A.x, A.y, A.z, C.x, C.y, C.z, D.x, D.y, D.z}, p[3] = {q.x, q.y, q.z};
        double h, w1, w2, ff[3];
        bool sure;
        element<double, bool>(c, p, B.room[f], hc[a], k[a], h, w1, w2, ff, sure);
        if (!sure) {
          ++unsure;
          continue;
        }
        if (h < hc[a])
          scatter(a, f, w1, w2, ff[0], ff[1], ff[2]);
        else
          hc[a] = std::min(h, 0.0);
      }
      best = std::min(best, now() - t);
    }
    printf("   lean scalar %.1f ns, unsure %ld\n", best / n * 1e9, unsure);
    best = 1e9;
    unsure = 0;
    for (int r = 0; r < 50; ++r) {
      const double t = now();
      for (int a0 = 0; a0 + lanes <= n; a0 += lanes) {
        double cb[9][lanes], pb[3][lanes], rb[lanes];
        for (int l = 0; l < lanes; ++l) {
          const int f = facet[a0 + l];
          const Pos &A = X[B.n0[f]], &C = X[B.n1[f]], &D = X[B.n2[f]], &q = X[I.apex[a0 + l]];
          cb[0][l] = A.x;
          cb[1][l] = A.y;
          cb[2][l] = A.z;
          cb[3][l] = C.x;
          cb[4][l] = C.y;
          cb[5][l] = C.z;
          cb[6][l] = D.x;
          cb[7][l] = D.y;
          cb[8][l] = D.z;
          pb[0][l] = q.x;
          pb[1][l] = q.y;
          pb[2][l] = q.z;
          rb[l] = B.room[f];
        }
        P c[9], p[3], room(rb, stdx::element_aligned), h, w1, w2, ff[3];
        for (int j = 0; j < 9; ++j) c[j].copy_from(cb[j], stdx::element_aligned);
        for (int j = 0; j < 3; ++j) p[j].copy_from(pb[j], stdx::element_aligned);
        const P hcp(&hc[a0], stdx::element_aligned), kp(&k[a0], stdx::element_aligned);
        P::mask_type sure;
        element<P, P::mask_type>(c, p, room, hcp, kp, h, w1, w2, ff, sure);
        for (int l = 0; l < lanes; ++l) {
          if (!sure[l]) {
            ++unsure;
            continue;
          }
          if (h[l] < hc[a0 + l])
            scatter(a0 + l, facet[a0 + l], w1[l], w2[l], ff[0][l], ff[1][l], ff[2][l]);
          else
            hc[a0 + l] = std::min(double(h[l]), 0.0);
        }
      }
      best = std::min(best, now() - t);
    }
    printf("   pack of %d: %.1f ns, unsure %ld\n", lanes, best / n * 1e9, unsure);
  }
}
