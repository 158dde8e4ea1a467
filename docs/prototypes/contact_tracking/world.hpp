#pragma once
// Rigid bodies (isotropic inertia) and lattices of springs, velocity Verlet, and a judge that does not use the contact code.
#include <functional>
#include <memory>
#include <string>

#include "contact.hpp"

struct Mesh {
  Xs x;
  std::vector<std::array<int, 3>> f;
};

struct Body {
  bool fixed = false, soft = false;
  double m = 1, I = 1;
  V c = V::Zero(), v = V::Zero(), w = V::Zero();
  Eigen::Quaterniond q{1, 0, 0, 0};
  Xs r;  // rigid: in the body's frame
  int first = 0, count = 0;
  Xs sv;  // soft: velocities of the nodes
  struct Spring {
    int i, j;
    double l, k;
  };
  std::vector<Spring> springs;
  std::vector<std::array<int, 3>> f;  // whole skin, nodes of the world
  double size = 1;
};

struct World {
  std::vector<Body> bodies;
  Xs x, x0, F;
  V g = V::Zero();
  double time = 0;

  int add(const Mesh& mesh, const V& at, const Eigen::Quaterniond& q, double m, const V& v, const V& w = V::Zero(), bool fixed = false) {
    Body b;
    b.first = x.size();
    b.count = mesh.x.size();
    b.m = m;
    b.fixed = fixed;
    b.c = at;
    b.v = v;
    b.w = w;
    b.q = q;
    b.r = mesh.x;
    double r2 = 0;
    V lo = V::Constant(1e30), hi = -lo;
    for (auto& r : mesh.x) r2 += r.squaredNorm() / mesh.x.size(), lo = lo.cwiseMin(r), hi = hi.cwiseMax(r);
    b.I = 0.4 * m * r2;
    b.size = (hi - lo).norm();
    for (auto& t : mesh.f) b.f.push_back({t[0] + b.first, t[1] + b.first, t[2] + b.first});
    for (auto& r : mesh.x) x.push_back(at + q * r);
    bodies.push_back(b);
    return bodies.size() - 1;
  }
  void make_soft(int i, double stiffness, double reach) {  // springs between all nodes nearer than reach
    Body& b = bodies[i];
    b.soft = true;
    b.sv.assign(b.count, b.v);
    for (int a = 0; a < b.count; ++a)
      for (int c = 0; c < a; ++c) {
        const double l = (x[b.first + a] - x[b.first + c]).norm();
        if (l < reach) b.springs.push_back({b.first + a, b.first + c, l, stiffness});
      }
  }
  void kick(double h) {
    for (auto& b : bodies) {
      if (b.fixed) continue;
      if (b.soft) {
        for (int i = 0; i < b.count; ++i) b.sv[i] += h * (F[b.first + i] / (b.m / b.count) + g);
        continue;
      }
      V f = b.m * g, t = V::Zero();
      for (int i = 0; i < b.count; ++i) f += F[b.first + i], t += (x[b.first + i] - b.c).cross(F[b.first + i]);
      b.v += h / b.m * f;
      b.w += h / b.I * t;
    }
  }
  void drift(double h) {
    x0 = x;
    for (auto& b : bodies) {
      if (b.fixed) continue;
      if (b.soft) {
        for (int i = 0; i < b.count; ++i) x[b.first + i] += h * b.sv[i];
        continue;
      }
      b.c += h * b.v;
      const double a = b.w.norm() * h;
      if (a > 0) b.q = (Eigen::Quaterniond(Eigen::AngleAxisd(a, b.w.normalized())) * b.q).normalized();
      for (int i = 0; i < b.count; ++i) x[b.first + i] = b.c + b.q * b.r[i];
    }
    time += h;
  }
  double inner_forces() {
    double E = 0;
    for (auto& b : bodies)
      for (auto& s : b.springs) {
        const V d = x[s.j] - x[s.i];
        const double l = d.norm(), e = l - s.l;
        const V f = s.k * e / l * d;
        F[s.i] += f;
        F[s.j] -= f;
        E += 0.5 * s.k * e * e;
      }
    return E;
  }
  double kinetic_and_gravity() const {
    double E = 0;
    for (auto& b : bodies) {
      if (b.fixed) continue;
      if (b.soft) {
        for (int i = 0; i < b.count; ++i) E += b.m / b.count * (0.5 * b.sv[i].squaredNorm() - g.dot(x[b.first + i]));
        continue;
      }
      E += 0.5 * b.m * b.v.squaredNorm() + 0.5 * b.I * b.w.squaredNorm() - b.m * g.dot(b.c);
    }
    return E;
  }
  // -- the judge ----
  double winding(int body, const V& p) const {
    double w = 0;
    for (auto& t : bodies[body].f) {
      const V a = x[t[0]] - p, b = x[t[1]] - p, c = x[t[2]] - p;
      const double A = a.norm(), B = b.norm(), C = c.norm();
      w += 2 * std::atan2(a.dot(b.cross(c)), A * B * C + a.dot(b) * C + b.dot(c) * A + c.dot(a) * B);
    }
    return w / (4 * M_PI);
  }
  double depth(int body, const V& p) const {  // inside: distance to the skin; outside: 0
    const Body& b = bodies[body];
    V lo = V::Constant(1e30), hi = -lo;
    for (int i = 0; i < b.count; ++i) lo = lo.cwiseMin(x[b.first + i]), hi = hi.cwiseMax(x[b.first + i]);
    if ((p.array() < lo.array()).any() || (p.array() > hi.array()).any()) return 0;
    if (winding(body, p) < 0.5) return 0;
    double d2 = 1e300;
    for (auto& t : b.f) d2 = std::min(d2, closest_on_triangle(x[t[0]], x[t[1]], x[t[2]], p).d2);
    return std::sqrt(d2);
  }
};

// ---- shapes ---------------------------------------------------------------------------------------------------------
inline Mesh box(double lx, double ly, double lz, int nx, int ny, int nz, int diagonals = 0) {
  Mesh m;
  std::map<std::array<int, 3>, int> id;
  const auto node = [&](int i, int j, int k) {
    auto [it, fresh] = id.try_emplace({i, j, k}, (int)m.x.size());
    if (fresh) m.x.push_back(V(lx * (double(i) / nx - 0.5), ly * (double(j) / ny - 0.5), lz * (double(k) / nz - 0.5)));
    return it->second;
  };
  const auto quad = [&](int a, int b, int c, int d, int par) {
    if ((diagonals == 1) || (diagonals == 2 && par % 2)) {
      m.f.push_back({b, c, d});
      m.f.push_back({b, d, a});
    } else {
      m.f.push_back({a, b, c});
      m.f.push_back({a, c, d});
    }
  };
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      quad(node(i, j, nz), node(i + 1, j, nz), node(i + 1, j + 1, nz), node(i, j + 1, nz), i + j);
      quad(node(i, j, 0), node(i, j + 1, 0), node(i + 1, j + 1, 0), node(i + 1, j, 0), i + j);
    }
  for (int i = 0; i < nx; ++i)
    for (int k = 0; k < nz; ++k) {
      quad(node(i, 0, k), node(i + 1, 0, k), node(i + 1, 0, k + 1), node(i, 0, k + 1), i + k);
      quad(node(i, ny, k), node(i, ny, k + 1), node(i + 1, ny, k + 1), node(i + 1, ny, k), i + k);
    }
  for (int j = 0; j < ny; ++j)
    for (int k = 0; k < nz; ++k) {
      quad(node(0, j, k), node(0, j, k + 1), node(0, j + 1, k + 1), node(0, j + 1, k), j + k);
      quad(node(nx, j, k), node(nx, j + 1, k), node(nx, j + 1, k + 1), node(nx, j, k + 1), j + k);
    }
  return m;
}
inline Mesh icosphere(int level, double R = 0.5) {
  const double t = (1 + std::sqrt(5.0)) / 2;
  Mesh m;
  for (auto a : {V(-1, t, 0), V(1, t, 0), V(-1, -t, 0), V(1, -t, 0), V(0, -1, t), V(0, 1, t), V(0, -1, -t), V(0, 1, -t), V(t, 0, -1),
                 V(t, 0, 1), V(-t, 0, -1), V(-t, 0, 1)})
    m.x.push_back(R * a.normalized());
  m.f = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
         {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<int, int>, int> mid;
    std::vector<std::array<int, 3>> g;
    const auto half = [&](int a, int b) {
      auto [it, fresh] = mid.try_emplace({std::min(a, b), std::max(a, b)}, (int)m.x.size());
      if (fresh) m.x.push_back(R * (m.x[a] + m.x[b]).normalized());
      return it->second;
    };
    for (auto& f : m.f) {
      const int a = half(f[0], f[1]), b = half(f[1], f[2]), c = half(f[2], f[0]);
      g.push_back({f[0], a, c});
      g.push_back({f[1], b, a});
      g.push_back({f[2], c, b});
      g.push_back({a, b, c});
    }
    m.f = g;
  }
  return m;
}
inline Mesh octahedron() {
  return {{V(.5, 0, 0), V(-.5, 0, 0), V(0, .5, 0), V(0, -.5, 0), V(0, 0, .5), V(0, 0, -.5)},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}
inline Mesh tetrahedron() {
  Mesh m{{V(1, 1, 1), V(1, -1, -1), V(-1, 1, -1), V(-1, -1, 1)}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
  for (auto& x : m.x) x *= 0.35;
  return m;
}
/// A closed prism: the polygon in the x-z plane (counter-clockwise seen from -y), from y = -b to b, in ny strips; ends fan-triangulated
/// from the polygon's first corner, which must see all others.
inline Mesh prism(const std::vector<std::array<double, 2>>& poly, double b, int ny) {
  Mesh m;
  const int n = poly.size();
  for (int j = 0; j <= ny; ++j)
    for (auto& p : poly) m.x.push_back(V(p[0], -b + 2 * b * j / ny, p[1]));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * n + i, c = j * n + (i + 1) % n;
      m.f.push_back({a, c, c + n});
      m.f.push_back({a, c + n, a + n});
    }
  for (int i = 1; i + 1 < n; ++i) {
    m.f.push_back({0, i + 1, i});
    m.f.push_back({ny * n, ny * n + i, ny * n + i + 1});
  }
  return m;
}
inline void outward(Mesh& m) {  // flips all facets if the volume is negative
  double vol = 0;
  for (auto& f : m.f) vol += m.x[f[0]].dot(m.x[f[1]].cross(m.x[f[2]]));
  if (vol < 0)
    for (auto& f : m.f) std::swap(f[1], f[2]);
}

// ---- a scene and its verdict ------------------------------------------------------------------------------------------
struct Verdict {
  double created = 0, lost = 0, deepest = 0, missed_depth = 0;
  bool missed = false, wrong = false, blown = false;
  bool bad() const { return created > 0.01 || lost > 0.01 || missed || wrong || blown; }
};
struct Scene {
  World world;
  std::vector<std::unique_ptr<Surface>> surfaces;
  std::vector<Interface> interfaces;
  double dt = 0, T = 1, reference = 0;      // energy of reference
  double miss_depth = 0.01;                 // [of the length 1] inside deeper than this without being held: missed
  std::function<bool(const World&)> wrong;  // at the end
  bool judge_nodes = true;
  int judge_every = 10;

  Surface* surface(int body, std::function<bool(const V&, const V&)> pick = {},
                   SurfaceOptions o = {}) {  // by normal and centre in the world now
    std::vector<std::array<int, 3>> f;
    for (auto& t : world.bodies[body].f) {
      const V n = (world.x[t[1]] - world.x[t[0]]).cross(world.x[t[2]] - world.x[t[0]]).normalized();
      const V c = (world.x[t[0]] + world.x[t[1]] + world.x[t[2]]) / 3;
      if (!pick || pick(n, c)) f.push_back(t);
    }
    surfaces.push_back(std::make_unique<Surface>(make_surface(f, world.x, o)));
    return surfaces.back().get();
  }
  void contact(int apex_body, Surface* own, int base_body, Surface* base, double K, double H = 0) {
    Interface I;
    I.base = base;
    I.own = own;
    I.H = H;
    I.apex = own->nodes;
    I.apex_body = apex_body;
    I.base_body = base_body;
    double all = 0;
    for (int a : I.apex) {
      double A = 0;
      for (int g : own->ring[a])
        A += (world.x[own->f[g][1]] - world.x[own->f[g][0]]).cross(world.x[own->f[g][2]] - world.x[own->f[g][0]]).norm() / 6;
      I.k.push_back(A);
      all += A;
    }
    for (double& k : I.k) k *= K / all;
    interfaces.push_back(std::move(I));
  }
  /// A step in which the stiffest thinkable bounce creates little: dt = c / sqrt(sum of k (1/m + r^2/I)).
  void choose_step(double c = 0.25) {
    double w2 = 0;
    for (auto& I : interfaces) {
      double k = 0;
      for (double a : I.k) k += a;
      for (int b : {I.apex_body, I.base_body}) {
        const Body& B = world.bodies[b];
        if (B.fixed) continue;
        if (B.soft) {
          double big = 0;
          for (double a : I.k) big = std::max(big, a);
          w2 += 4 * big / (B.m / B.count);
          continue;
        }
        double r2 = 0;
        for (auto& r : B.r) r2 = std::max(r2, r.squaredNorm());
        w2 += k * 0.4 * (1 / B.m + r2 / B.I);
      }
    }
    for (auto& B : world.bodies) {
      std::vector<double> sum(world.x.size(), 0.0);
      for (auto& s : B.springs) sum[s.i] += s.k, sum[s.j] += s.k;
      double most = 0;
      for (double s : sum) most = std::max(most, s);
      if (B.soft) w2 = std::max(w2, 4 * 2 * most / (B.m / B.count) * 0.3);
    }
    dt = c / std::sqrt(w2) * (getenv("DT") ? atof(getenv("DT")) : 1);
  }

  Verdict run(const std::function<std::unique_ptr<Method>()>& make, bool verbose = false) {
    Verdict v;
    std::vector<std::unique_ptr<Method>> methods;
    World& w = world;
    for (auto& I : interfaces) {
      (void)I;
      methods.push_back(make());
    }
    w.x0 = w.x;
    w.F.assign(w.x.size(), V::Zero());
    double pot = w.inner_forces();
    for (size_t i = 0; i < interfaces.size(); ++i) {
      methods[i]->start(interfaces[i], w.x);
      pot += methods[i]->forces(interfaces[i], w.x, w.x, w.F);
    }
    const double E0 = w.kinetic_and_gravity() + pot;
    if (reference == 0) {
      reference = 0;
      for (auto& b : w.bodies)
        if (!b.fixed) reference += 0.5 * b.m * b.v.squaredNorm() + 0.5 * b.I * b.w.squaredNorm();
    }
    std::vector<std::vector<int>> unheld(interfaces.size());
    for (size_t i = 0; i < interfaces.size(); ++i) unheld[i].assign(interfaces[i].apex.size(), 0);
    double e_before = 0;
    std::vector<std::vector<std::string>> told(interfaces.size());
    if (verbose)
      for (size_t i = 0; i < interfaces.size(); ++i) told[i].resize(interfaces[i].apex.size());
    const long steps = std::lround(T / dt);
    for (long n = 1; n <= steps; ++n) {
      w.kick(dt / 2);
      w.drift(dt);
      std::fill(w.F.begin(), w.F.end(), V::Zero());
      pot = w.inner_forces();
      for (size_t i = 0; i < interfaces.size(); ++i) pot += methods[i]->forces(interfaces[i], w.x0, w.x, w.F);
      w.kick(dt / 2);
      const double e = (w.kinetic_and_gravity() + pot - E0) / reference;
      if (!(std::abs(e) < 1e3)) {
        v.blown = true;
        v.created = 1e3;
        break;
      }
      v.created = std::max(v.created, e);
      v.lost = std::max(v.lost, -e);
      if (judge_nodes && n % judge_every == 0)
        for (size_t i = 0; i < interfaces.size(); ++i) {
          Interface& I = interfaces[i];
          for (size_t a = 0; a < I.apex.size(); ++a) {
            if (I.near[a].empty()) continue;
            const double d = w.depth(I.base_body, w.x[I.apex[a]]);
            v.deepest = std::max(v.deepest, d);
            if (d > miss_depth && !methods[i]->holds(a)) {
              if (++unheld[i][a] >= 3) v.missed = true, v.missed_depth = std::max(v.missed_depth, d);
            } else
              unheld[i][a] = 0;
          }
        }
      if (verbose && std::abs(e - e_before) > 1.5e-3) {
        printf("jump at t %.5f step %ld: E %.5f -> %.5f\n", w.time, n, e_before, e);
        for (size_t i = 0; i < interfaces.size(); ++i)
          for (size_t a = 0; a < interfaces[i].apex.size(); ++a) {
            const auto now = methods[i]->tell(a);
            if (now != told[i][a])
              printf("    interface %zu apex %d: %s -> %s\n", i, interfaces[i].apex[a], told[i][a].c_str(), now.c_str());
          }
      }
      if (verbose)
        for (size_t i = 0; i < interfaces.size(); ++i) {
          told[i].resize(interfaces[i].apex.size());
          for (size_t a = 0; a < interfaces[i].apex.size(); ++a) told[i][a] = methods[i]->tell(a);
        }
      e_before = e;
      if (verbose && getenv("TRACE"))
        for (size_t i = 0; i < interfaces.size(); ++i) {
          const size_t a = atoi(getenv("TRACE"));
          if (a < interfaces[i].apex.size()) printf("%ld z %.4f %s\n", n, w.x[interfaces[i].apex[a]].z(), methods[i]->tell(a).c_str());
        }
      if (verbose && getenv("FRAMES") && n % (steps / 40 + 1) == 0) {
        printf("t %.4f E %.5f pot %.5f", w.time, e, pot / reference);
        for (auto& b : w.bodies)
          if (!b.fixed && !b.soft)
            printf(" | c %.4f %.4f %.4f v %.3f %.3f %.3f w %.2f", b.c.x(), b.c.y(), b.c.z(), b.v.x(), b.v.y(), b.v.z(), b.w.norm());
        printf("\n");
      }
    }
    if (wrong && wrong(w)) v.wrong = true;
    return v;
  }
};
