#pragma once
// Families of scenes.
#include <random>

#include "world.hpp"

using Quat = Eigen::Quaterniond;
inline Quat turn(double degrees, V axis) { return Quat(Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized())); }
inline const Quat upright{1, 0, 0, 0};
using Make = std::function<Scene()>;
struct Family {
  std::string name;
  std::vector<std::pair<std::string, Make>> scenes;
};

inline std::string label(std::initializer_list<double> a) {
  std::string s;
  for (double v : a) {
    char b[32];
    snprintf(b, 32, "%s%g", s.empty() ? "" : "_", v);
    s += b;
  }
  return s;
}
inline void one_pass(Scene& s, int apex, Surface* A, int base, Surface* B, double K, double H = 0) { s.contact(apex, A, base, B, K, H); }
inline void two_passes(Scene& s, int a, Surface* A, int b, Surface* B, double K, double H = 0) {
  s.contact(a, A, b, B, K / 2, H);
  s.contact(b, B, a, A, K / 2, H);
}

inline Family flush() {
  Family F{"flush skins", {}};
  for (int n : {1, 2, 3})
    for (int nb : {1, 3})
      for (int passes : {1, 2})
        for (double v : {1.0, 0.2})
          for (double side : {0.0, 1e-3, 0.02})
            for (int rest : {0, 1})
              F.scenes.push_back(
                  {label({double(n), double(nb), double(passes), v, side, double(rest)}), [=] {
                     Scene s;
                     const int b = s.world.add(box(1, 1, 1, nb, nb, nb), V(0, 0, -0.5), upright, 1, V::Zero(), V::Zero(), rest);
                     const int a =
                         s.world.add(box(1, 1, 1, n, n, n), V(0, 0, 0.5 + (rest ? 0 : 1e-3)), upright, 1, V(side, side / 2, rest ? 0 : -v));
                     Surface *A = s.surface(a), *B = s.surface(b);
                     if (passes == 1)
                       one_pass(s, a, A, b, B, 2e4);
                     else
                       two_passes(s, a, A, b, B, 2e4);
                     if (rest) s.world.g = V(0, 0, -v * 5), s.reference = 0.02 * v * 5;
                     s.choose_step();
                     s.T = rest ? 0.5 : 0.3;
                     s.miss_depth = 0.05;
                     s.wrong = [=](const World& w) {
                       return w.bodies[a].c.z() - w.bodies[b].c.z() < 0.95 || (side < .01) * std::abs(w.bodies[a].c.x()) > 0.1;
                     };
                     return s;
                   }});
  return F;
}
inline Family bars() {
  Family F{"bars head-on", {}};
  for (int n : {1, 2})
    for (int n2 : {1, 2, 3})
      for (double off : {0.0, 1e-9, 1e-4, 0.01, 0.1})
        for (double v : {1.0, 4.0})
          for (int passes : {1, 2})
            F.scenes.push_back({label({double(n), double(n2), off, v, double(passes)}), [=] {
                                  Scene s;
                                  const int a = s.world.add(box(2, .5, .5, 4 * n, n, n), V(-1.01, 0, 0), upright, 1, V(v, 0, 0));
                                  const int b = s.world.add(box(2, .5, .5, 4 * n2, n2, n2), V(1.01, off, off / 3), upright, 1, V(-v, 0, 0));
                                  Surface *A = s.surface(a), *B = s.surface(b);
                                  if (passes == 1)
                                    one_pass(s, a, A, b, B, 2e5);
                                  else
                                    two_passes(s, a, A, b, B, 2e5);
                                  s.choose_step();
                                  s.T = 0.2 / v;
                                  s.miss_depth = 0.05;
                                  s.wrong = [=](const World& w) {
                                    return w.bodies[a].v.x() > 0 || w.bodies[a].c.x() > w.bodies[b].c.x() - 1.9;
                                  };
                                  return s;
                                }});
  return F;
}
inline Family rims() {
  Family F{"rims", {}};
  for (int closed : {0, 1})
    for (int n : {1, 3})
      for (double v : {0.2, 1.0, 5.0})
        for (int kind : {0, 1, 2, 3})
          for (double dir : {0.0, 30.0})
            F.scenes.push_back({label({double(closed), double(n), v, double(kind), dir}), [=] {
                                  Scene s;
                                  const int b = s.world.add(box(1, 1, .5, 2, 2, 1), V(0, 0, -.25), upright, 1, V::Zero(), V::Zero(), true);
                                  const double c = std::cos(dir * M_PI / 180), sn = std::sin(dir * M_PI / 180);
                                  V at, vel;
                                  if (kind == 0) at = V(.2, 0, .15), vel = V(v * c, v * sn, -0.1);           // slides off
                                  if (kind == 1) at = V(-.8, -.1, .15 - 1e-3), vel = V(v * c, v * sn, 0);    // in from the side, 1e-3 low
                                  if (kind == 2) at = V(.45, .1, .15 + 1e-3), vel = V(.1 * c, .1 * sn, -v);  // half over the rim
                                  if (kind == 3)
                                    at = V(.2, .1, closed ? -.65 - 1e-2 : -.15 - 1e-2), vel = V(.3 * c, .3 * sn, v);  // from below
                                  const int a = s.world.add(box(.3, .3, .3, n, n, n), at, upright, 1, vel);
                                  Surface* A = s.surface(a);
                                  Surface* B = s.surface(
                                      b, closed ? std::function<bool(const V&, const V&)>{}
                                                : [](const V& nn, const V&) { return nn.z() > .9; });
                                  one_pass(s, a, A, b, B, 4e4 * std::max(v * v, .04));
                                  if (closed && kind != 1) two_passes(s, a, A, b, B, 1e4 * std::max(v * v, .04));
                                  if (kind <= 1) s.world.g = V(0, 0, kind == 0 ? -.5 : 0);
                                  s.choose_step();
                                  s.T = std::min(1.0 / v, 2.0);
                                  s.miss_depth = 0.05;
                                  s.judge_nodes = closed;
                                  s.wrong = [=](const World& w) {
                                    if (kind == 3) return closed ? w.bodies[a].v.z() > 0 : std::abs(w.bodies[a].v.z() - v) > 1e-9;
                                    if (kind == 1 && !closed) return std::abs(w.bodies[a].v.x() - v * c) > 0.05 * v;
                                    return false;
                                  };
                                  return s;
                                }});
  return F;
}
inline Family plates() {
  Family F{"thin plate", {}};
  for (double t : {1e-3, 3e-3, 1e-2, 0.03})
    for (double per_step : {0.05, 0.2, 0.5, 1.0})
      for (int what : {0, 1, 2})
        if (t * per_step < 0.012)
          for (int passes : {1, 2})
            for (double tilt : {0.0, 25.0})
              F.scenes.push_back({label({t, per_step, double(what), double(passes), tilt}), [=] {
                                    Scene s;
                                    const int nb = what == 2 ? 6 : 3;
                                    const int b =
                                        s.world.add(box(1, 1, t, nb, nb, 1), V(0, 0, -t / 2), upright, 1, V::Zero(), V::Zero(), true);
                                    const Mesh m = what == 0 ? box(.2, .2, .2, 2, 2, 2) : what == 1 ? octahedron() : icosphere(1, .15);
                                    const int a = s.world.add(m, V(.03, .02, 0), turn(tilt, V(1, .3, 0)), 1, V(0.1, 0, -1));
                                    double low = 0;
                                    for (auto& r : m.x) low = std::min(low, (turn(tilt, V(1, .3, 0)) * r).z());
                                    World& w = s.world;
                                    w.bodies[a].c.z() = -low + 1e-3 + t * .37;
                                    for (size_t i = 0; i < m.x.size(); ++i)
                                      w.x[w.bodies[a].first + i] = w.bodies[a].c + w.bodies[a].q * m.x[i];
                                    Surface *A = s.surface(a), *B = s.surface(b);
                                    s.dt = per_step * t;
                                    double r2 = 0;
                                    for (auto& r : m.x) r2 = std::max(r2, r.squaredNorm());
                                    const double K = std::pow(0.12 / s.dt, 2) / (1 + r2 / w.bodies[a].I);
                                    if (passes == 1)
                                      one_pass(s, a, A, b, B, K);
                                    else
                                      two_passes(s, a, A, b, B, K);
                                    s.T = std::max(0.05, 200 * s.dt);
                                    s.miss_depth = 1;
                                    s.wrong = [=](const World& ww) { return ww.bodies[a].c.z() < 0; };
                                    return s;
                                  }});
  return F;
}
inline Family table() {
  Family F{"under and on a table", {}};
  for (double t : {0.01, 0.05, 0.2})
    for (double clear : {1e-4, 1e-2})
      for (double up : {0.0, 0.05, 0.3})
        for (int passes : {1, 2})
          for (int on : {0, 1})
            F.scenes.push_back({label({t, clear, up, double(passes), double(on)}), [=] {
                                  Scene s;
                                  const int b = s.world.add(box(1, 1, t, 3, 3, 1), V(0, 0, 0), upright, 1, V::Zero(), V::Zero(), true);
                                  const double z = (on ? 1 : -1) * (t / 2 + .1 + clear);
                                  const int a = s.world.add(box(.2, .2, .2, 2, 2, 2), V(-.35, .02, z), upright, 1, V(1, 0, on ? -up : up),
                                                            V(0, 0.02, 0));
                                  Surface *A = s.surface(a), *B = s.surface(b);
                                  if (passes == 1)
                                    one_pass(s, a, A, b, B, 4e4);
                                  else
                                    two_passes(s, a, A, b, B, 4e4);
                                  s.choose_step();
                                  s.T = 1.2;
                                  s.miss_depth = 0.04;
                                  s.wrong = [=](const World& w) { return (on ? -1 : 1) * w.bodies[a].c.z() > 0 || w.bodies[a].v.x() < .9; };
                                  return s;
                                }});
  return F;
}
inline Family parts() {  // a floor with a separate part standing on it, one base surface
  Family F{"floor with a separate part", {}};
  for (int closed : {0, 1})
    for (double v : {0.3, 1.0})
      for (int n : {1, 2})
        for (double yaw : {0.0, 20.0, 45.0})
          for (double thick : {0.03, 0.3})
            for (double g : {0.0, 2.0})
              F.scenes.push_back({label({double(closed), v, double(n), yaw, thick, g}), [=] {
                                    Scene s;
                                    Mesh m = box(2, 2, .2, 4, 4, 1);
                                    for (auto& x : m.x) x.z() -= .1;
                                    const Mesh part = box(thick, .8, .4, 1, 3, 2);
                                    const int off = m.x.size();
                                    for (auto x : part.x) m.x.push_back(x + V(.4 + thick / 2, 0, .2));
                                    for (auto f : part.f) m.f.push_back({f[0] + off, f[1] + off, f[2] + off});
                                    const int b = s.world.add(m, V::Zero(), upright, 1, V::Zero(), V::Zero(), true);
                                    const int a = s.world.add(box(.2, .2, .2, n, n, n), V(-.1, .05, .1 + 1e-4), turn(yaw, V(0, 0, 1)), 1,
                                                              V(v, 0, -.02));
                                    Surface* A = s.surface(a);
                                    Surface* B = s.surface(
                                        b, closed ? std::function<bool(const V&, const V&)>{}
                                                  : [](const V& nn, const V& c) { return c.z() > .01 || nn.z() > .9; });
                                    one_pass(s, a, A, b, B, 4e4);
                                    s.world.g = V(0, 0, -g);
                                    s.choose_step();
                                    s.T = .8 / v;
                                    s.miss_depth = 0.05;
                                    s.wrong = [=](const World& w) { return w.bodies[a].v.x() > 0.5 * v || w.bodies[a].c.z() < 0; };
                                    return s;
                                  }});
  return F;
}
inline Family sheets() {  // both faces of one sheet as bases; h_c = 0 and > 0
  Family F{"both faces of a sheet", {}};
  for (double H : {0.0, 2e-3, 0.02})
    for (double v : {0.3, 3.0})
      for (int what : {0, 1, 2})
        for (int below : {0, 1})
          for (double tilt : {0.0, 30.0})
            for (double edge : {0.0, .47})
              F.scenes.push_back({label({H, v, double(what), double(below), tilt, edge}), [=] {
                                    Scene s;
                                    const Mesh boxm = box(1, 1, .1, 4, 4, 1);
                                    Mesh sheet;
                                    for (auto& x : boxm.x) sheet.x.push_back(V(x.x(), x.y(), 0));
                                    for (auto& f : boxm.f) {
                                      const V n = (boxm.x[f[1]] - boxm.x[f[0]]).cross(boxm.x[f[2]] - boxm.x[f[0]]);
                                      if (n.z() > .9 * n.norm()) sheet.f.push_back(f);
                                    }
                                    Mesh back = sheet;
                                    for (auto& f : back.f) std::swap(f[1], f[2]);
                                    const int b = s.world.add(sheet, V::Zero(), upright, 1, V::Zero(), V::Zero(), true);
                                    const int c = s.world.add(back, V::Zero(), upright, 1, V::Zero(), V::Zero(), true);
                                    const Mesh m = what == 0 ? box(.2, .2, .2, 2, 2, 2) : what == 1 ? octahedron() : icosphere(1, .15);
                                    const double sg = below ? -1 : 1;
                                    const int a = s.world.add(m, V(edge, .02, sg * (.55)), turn(tilt, V(1, .3, 0)), 1, V(.1, .05, -sg * v));
                                    Surface *A = s.surface(a), *B = s.surface(b), *C = s.surface(c);
                                    one_pass(s, a, A, b, B, 4e4 * v * v, H);
                                    one_pass(s, a, A, c, C, 4e4 * v * v, H);
                                    s.choose_step();
                                    s.T = 1.0 / v;
                                    s.judge_nodes = false;
                                    s.wrong = [=](const World& w) { return edge == 0 && sg * w.bodies[a].c.z() < 0; };
                                    return s;
                                  }});
  return F;
}
inline Mesh roof(double angle, bool valley, int ny) {
  // block with a valley or ridge of the given opening angle along y
  const double half = angle / 2 * M_PI / 180;
  double w = .6, d = w / std::tan(half);
  if (d > .6) d = .6, w = d * std::tan(half);
  Mesh m;
  if (valley)
    m = prism({{0, -d}, {w, 0}, {w + .4, 0}, {w + .4, -1.2}, {-w - .4, -1.2}, {-w - .4, 0}, {-w, 0}}, .8, ny);
  else
    m = prism({{0, 0}, {-w, -d}, {-w - .2, -1.2}, {w + .2, -1.2}, {w, -d}}, .8, ny);
  outward(m);
  return m;
}
inline Mesh body_of(int what) {
  return what == 0 ? octahedron() : what == 1 ? icosphere(1, .25) : what == 2 ? box(.3, .3, .3, 2, 2, 2) : tetrahedron();
}
inline void put_low(Scene& s, int a, double above) {  // lowest node at z = above
  World& w = s.world;
  Body& b = w.bodies[a];
  double low = 1e30;
  for (int i = 0; i < b.count; ++i) low = std::min(low, w.x[b.first + i].z());
  b.c.z() += above - low;
  for (int i = 0; i < b.count; ++i) w.x[b.first + i].z() += above - low;
}
inline Family angles(bool valley) {
  Family F{valley ? "valleys" : "ridges", {}};
  for (double angle : {1.0, 5.0, 20.0, 45.0, 60.0, 80.0, 90.0, 95.0, 97.0, 110.0, 135.0, 160.0, 175.0, 179.0})
    for (int what : {0, 1, 2})
      for (double off : {0.0, .013})
        for (int passes : {1, 2})
          for (double H : {0.0, .01})
            if (H == 0 || passes == 1)
              F.scenes.push_back({label({angle, double(what), off, double(passes), H}), [=] {
                                    Scene s;
                                    const int b = s.world.add(roof(angle, valley, 4), V::Zero(), upright, 1, V::Zero(), V::Zero(), true);
                                    const int a = s.world.add(body_of(what), V(off, .03, 0), what == 2 ? turn(35, V(1, .7, .2)) : upright,
                                                              1, V(off, 0, -1), V(.3, .5, .1));
                                    put_low(s, a, H + .02);
                                    Surface *A = s.surface(a), *B = s.surface(b);
                                    if (passes == 1)
                                      one_pass(s, a, A, b, B, 4e4, H);
                                    else
                                      two_passes(s, a, A, b, B, 4e4, H);
                                    s.choose_step();
                                    s.T = .8;
                                    s.miss_depth = .05;
                                    return s;
                                  }});
  return F;
}
inline Family pits() {
  Family F{"pits and tips", {}};
  for (double slope : {-80.0, -60.0, -30.0, -5.0, 5.0, 30.0, 60.0, 80.0})
    for (int what : {0, 1, 2, 3})
      for (double off : {0.0, .017})
        for (int sides : {4, 7})
          for (int passes : {1, 2})
            F.scenes.push_back({label({slope, double(what), off, double(sides), double(passes)}), [=] {
                                  Scene s;
                                  // a pyramid (slope > 0) or pit on a block: ring of `sides` corners, centre at the tip
                                  Mesh m;
                                  const double R = std::abs(slope) > 45 ? .3 : .6, z = R * std::tan(slope * M_PI / 180);
                                  m.x.push_back(V(0, 0, z));
                                  const double zo = slope > 0 ? -.3 : 0, Ro = slope > 0 ? R + .3 : R + .5;
                                  for (int i = 0; i < sides; ++i) {
                                    const double t = 2 * M_PI * i / sides + .1;
                                    m.x.push_back(V(R * std::cos(t), R * std::sin(t), 0));
                                  }
                                  for (int i = 0; i < sides; ++i) {
                                    const double t = 2 * M_PI * i / sides + .1;
                                    m.x.push_back(V(Ro * std::cos(t), Ro * std::sin(t), zo));
                                  }
                                  for (int i = 0; i < sides; ++i) {
                                    const double t = 2 * M_PI * i / sides + .1;
                                    m.x.push_back(V(Ro * std::cos(t), Ro * std::sin(t), -2.5));
                                  }
                                  m.x.push_back(V(0, 0, -2.5));
                                  for (int i = 0; i < sides; ++i) {
                                    const int j = (i + 1) % sides, a = 1 + i, b = 1 + j;
                                    m.f.push_back({0, a, b});
                                    for (int l : {0, 1}) {
                                      const int o = l * sides;
                                      m.f.push_back({a + o, a + o + sides, b + o + sides});
                                      m.f.push_back({a + o, b + o + sides, b + o});
                                    }
                                    m.f.push_back({(int)m.x.size() - 1, b + 2 * sides, a + 2 * sides});
                                  }
                                  outward(m);
                                  const int b = s.world.add(m, V::Zero(), upright, 1, V::Zero(), V::Zero(), true);
                                  const int a = s.world.add(body_of(what), V(off, off / 2, 0), what == 2 ? turn(35, V(1, .7, .2)) : upright,
                                                            1, V(.02, 0, -1), V(.3, .5, .1));
                                  put_low(s, a, std::max(z, 0.0) + .02);
                                  Surface *A = s.surface(a), *B = s.surface(b);
                                  if (passes == 1)
                                    one_pass(s, a, A, b, B, 4e4);
                                  else
                                    two_passes(s, a, A, b, B, 4e4);
                                  s.choose_step();
                                  s.T = std::max(.8, -z + .4);
                                  s.miss_depth = .05;
                                  return s;
                                }});
  return F;
}
inline Family ties() {
  Family F{"exact ties", {}};
  for (int what : {0, 1, 2, 3})
    for (double x : {0.0, .125, .25})
      for (double y : {0.0, .125})
        for (int diag : {0, 1, 2})
          for (double side : {0.0, .3})
            for (double H : {0.0, .01})
              F.scenes.push_back(
                  {label({double(what), x, y, double(diag), side, H}), [=] {
                     Scene s;
                     const int b = s.world.add(box(2, 2, .3, 8, 8, 1, diag), V(0, 0, -.15), upright, 1, V::Zero(), V::Zero(), true);
                     Mesh m = what == 1 ? box(.5, .5, .5, 2, 2, 2) : what == 2 ? box(.25, .25, .25, 1, 1, 1) : body_of(what);
                     const int a = s.world.add(m, V(x, y, 0), upright, 1, V(side, side, -1));
                     put_low(s, a, H + .02);
                     Surface *A = s.surface(a), *B = s.surface(b);
                     one_pass(s, a, A, b, B, 4e4, H);
                     for (double& k : s.interfaces[0].k) k = 4e4 / A->nodes.size();
                     s.choose_step();
                     s.T = .3;
                     s.miss_depth = .05;
                     s.wrong = [=](const World& w) {
                       return what > 0 && what < 3 && (w.bodies[a].w.norm() > 1e-6 || (w.bodies[a].v - V(side, side, 1)).norm() > 0.02);
                     };
                     return s;
                   }});
  return F;
}
inline Family rolling() {
  Family F{"rolling", {}};
  for (int level : {0, 1, 2})
    for (double v : {.5, 2.0})
      for (int passes : {1, 2})
        for (int bed : {0, 1, 2})
          for (double H : {0.0, 5e-3})
            if (H == 0 || passes == 1)
              F.scenes.push_back({label({double(level), v, double(passes), double(bed), H}), [=] {
                                    Scene s;
                                    // bed: flat plate, faceted trough (inside of a tube), faceted hill
                                    std::vector<std::array<double, 2>> poly;
                                    if (bed == 1) {
                                      poly.push_back({0, -1});
                                      for (int i = 1; i <= 6; ++i) {
                                        const double t = M_PI * (.5 - i / 16.);
                                        poly.push_back({std::cos(t), -std::sin(t)});
                                      }
                                      poly.push_back({1.5, -.3});
                                      poly.push_back({1.5, -2});
                                      poly.push_back({-1.5, -2});
                                      poly.push_back({-1.5, -.3});
                                      for (int i = 6; i >= 1; --i) {
                                        const double t = M_PI * (.5 - i / 16.);
                                        poly.push_back({-std::cos(t), -std::sin(t)});
                                      }
                                    }
                                    if (bed == 2) {
                                      poly.push_back({0, 1});
                                      for (int i = 1; i <= 5; ++i) {
                                        const double t = M_PI * (.5 - i / 16.);
                                        poly.push_back({std::cos(t), std::sin(t)});
                                      }
                                      poly.push_back({1, -1});
                                      poly.push_back({-1, -1});
                                      for (int i = 5; i >= 1; --i) {
                                        const double t = M_PI * (.5 - i / 16.);
                                        poly.push_back({-std::cos(t), std::sin(t)});
                                      }
                                    }
                                    Mesh m = bed == 0 ? box(3, 2, .4, 9, 6, 1) : prism(poly, .8, 4);
                                    outward(m);
                                    const int b = s.world.add(m, V::Zero(), upright, 1, V::Zero(), V::Zero(), true);
                                    const double top = bed == 0 ? .2 : bed == 1 ? -1 : 1, x = bed == 0 ? -.8 : bed == 1 ? -.4 : .1;
                                    const int a = s.world.add(icosphere(level, .25), V(x, 0, 0), turn(17, V(1, 2, 3)), 1, V(v, .03, 0),
                                                              V(0, v / .25, 0));
                                    put_low(s, a, top + (bed == 1 ? .09 : .005) + H);
                                    Surface *A = s.surface(a), *B = s.surface(b);
                                    if (passes == 1)
                                      one_pass(s, a, A, b, B, 8e4, H);
                                    else
                                      two_passes(s, a, A, b, B, 8e4, H);
                                    s.world.g = V(0, 0, -3);
                                    s.choose_step();
                                    s.T = std::min(1.0, 1.2 / v);
                                    s.miss_depth = .04;
                                    return s;
                                  }});
  return F;
}
inline Family rounded() {  // thin plates whose rim is rounded by blunt facets, hit near the rim
  Family F{"thin body, rounded rim", {}};
  for (double t : {.004, .02, .1})
    for (int facets : {2, 3, 6})
      for (double from_rim : {.2, 1.0, 4.0})
        for (int what : {0, 1, 2})
          for (double depth : {.2, 1.0})
            for (int passes : {1, 2})
              F.scenes.push_back({label({t, double(facets), from_rim, double(what), depth, double(passes)}), [=] {
                                    Scene s;
                                    std::vector<std::array<double, 2>> poly{{0, -t / 2}};
                                    for (int i = 0; i <= facets; ++i) {
                                      const double a = -M_PI / 2 + M_PI * i / facets;
                                      poly.push_back({.5 + t / 2 * std::cos(a), t / 2 * std::sin(a)});
                                    }
                                    for (int i = 0; i <= facets; ++i) {
                                      const double a = M_PI / 2 + M_PI * i / facets;
                                      poly.push_back({-.5 + t / 2 * std::cos(a), t / 2 * std::sin(a)});
                                    }
                                    Mesh m = prism(poly, .5, 4);
                                    outward(m);
                                    const int b = s.world.add(m, V::Zero(), upright, 1, V::Zero(), V::Zero(), true);
                                    Mesh body = body_of(what == 0 ? 0 : what == 1 ? 1 : 2);
                                    const int a = s.world.add(body, V(.5 - from_rim * t, .03, 0),
                                                              what == 2 ? turn(50, V(1, .7, .2)) : upright, 1, V(0, 0, -1));
                                    put_low(s, a, t / 2 + .01);
                                    Surface *A = s.surface(a), *B = s.surface(b);
                                    const double want = depth * t;  // depth of one apex
                                    const double K = A->nodes.size() / (want * want);
                                    if (passes == 1)
                                      one_pass(s, a, A, b, B, K);
                                    else
                                      two_passes(s, a, A, b, B, K);
                                    s.choose_step();
                                    s.T = .1 + 5 * want;
                                    s.miss_depth = 1;
                                    if (from_rim > .5) s.wrong = [=](const World& w) { return w.bodies[a].c.z() < 0; };
                                    return s;
                                  }});
  return F;
}
inline Family accepted() {
  Family F{"accepted overlap", {}};
  for (double e : {1e-3, .01, .04})
    for (int n : {1, 2})
      for (int passes : {1, 2})
        for (double vz : {0.0, .5})
          for (double vx : {0.0, .3})
            for (double t : {.1, 1.0})
              F.scenes.push_back({label({e, double(n), double(passes), vz, vx, t}), [=] {
                                    Scene s;
                                    const int b =
                                        s.world.add(box(2, 2, t, 3, 3, 1), V(0, 0, -t / 2), upright, 1, V::Zero(), V::Zero(), true);
                                    const int a = s.world.add(box(.4, .4, .4, n, n, n), V(.03, .05, .2 - e), upright, 1, V(vx, 0, vz));
                                    Surface *A = s.surface(a), *B = s.surface(b);
                                    if (passes == 1)
                                      one_pass(s, a, A, b, B, 4e4);
                                    else
                                      two_passes(s, a, A, b, B, 4e4);
                                    s.world.g = V(0, 0, -2);
                                    s.reference = .2;
                                    s.choose_step();
                                    s.T = .9;
                                    s.miss_depth = .06;
                                    // it leaves and comes back at rest height: not lower than the deformation once it has been away
                                    s.wrong = [=](const World& w) {
                                      double low = 1e30;
                                      const Body& B2 = w.bodies[a];
                                      for (int i = 0; i < B2.count; ++i) low = std::min(low, w.x[B2.first + i].z());
                                      return low < (vz > 0 ? -.012 : -e - .012);
                                    };
                                    return s;
                                  }});
  return F;
}
inline Mesh random_body(std::mt19937& gen, bool star) {
  std::uniform_real_distribution<double> u(-1, 1);
  Mesh m;
  if (star) {
    m = icosphere(1, .5);
    for (auto& x : m.x) x *= 1 + .35 * u(gen);
  } else {
    const int k = std::uniform_int_distribution<int>(0, 5)(gen);
    m = k == 0   ? tetrahedron()
        : k == 1 ? octahedron()
        : k == 2 ? icosphere(0)
        : k == 3 ? icosphere(1)
        : k == 4 ? box(.7, .7, .7, 1, 1, 1)
                 : box(.7, .7, .7, 2, 3, 2);
    Eigen::Matrix3d M = Eigen::Matrix3d::Identity();
    for (int i = 0; i < 9; ++i) M(i / 3, i % 3) += .35 * u(gen);
    for (auto& x : m.x) x = M * x;
  }
  V c = V::Zero();
  for (auto& x : m.x) c += x / m.x.size();
  for (auto& x : m.x) x -= c;
  outward(m);
  return m;
}
inline Quat random_turn(std::mt19937& gen) {
  std::normal_distribution<double> n;
  return Quat(n(gen), n(gen), n(gen), n(gen)).normalized();
}
inline Family thrown(bool star, int seeds, int first_seed, double H = 0) {
  Family F{std::string(star ? "star-shaped bodies thrown" : "convex bodies thrown") + (H > 0 ? ", h_c" : ""), {}};
  for (int i = first_seed; i < first_seed + seeds; ++i)
    F.scenes.push_back({label({double(i)}), [=] {
                          std::mt19937 gen(i * 2 + star);
                          std::uniform_real_distribution<double> u(-1, 1);
                          Scene s;
                          const Mesh ma = random_body(gen, star), mb = random_body(gen, star);
                          const V off(0, .25 * u(gen), .25 * u(gen));
                          const int a = s.world.add(ma, V(-.9, 0, 0) + off, random_turn(gen), 1, V(1, 0, 0), V(u(gen), u(gen), u(gen)));
                          const int b =
                              s.world.add(mb, V(.9, 0, 0) - off, random_turn(gen), 1 + .8 * u(gen), V(-1, 0, 0), V(u(gen), u(gen), u(gen)));
                          Surface *A = s.surface(a), *B = s.surface(b);
                          const double K = 2e5 * std::max(ma.x.size(), mb.x.size()) / 20.0;
                          two_passes(s, a, A, b, B, K, H);
                          s.choose_step();
                          s.T = 1.2;
                          s.miss_depth = .05;
                          return s;
                        }});
  return F;
}
inline Family crossing() {
  Family F{"crossing bars", {}};
  for (double angle : {0.5, 5.0, 45.0, 90.0})
    for (double roll : {0.0, 20.0, 45.0})
      for (double off : {0.0, .15})
        for (int n : {1, 2})
          for (double H : {0.0, .01})
            for (double thin : {.04, .2})
              F.scenes.push_back(
                  {label({angle, roll, off, double(n), H, thin}), [=] {
                     Scene s;
                     const int a = s.world.add(box(1, .2, thin, 5 * n, n, n), V(0, 0, .3), turn(roll, V(1, 0, 0)), 1, V(0, 0, -1));
                     const int b = s.world.add(box(1, .2, thin, 4 * n, n, n), V(off, off / 2, 0), turn(angle, V(0, 0, 1)), 1, V(0, 0, 0));
                     put_low(s, a, thin / 2 + H + .01);
                     Surface *A = s.surface(a), *B = s.surface(b);
                     two_passes(s, a, A, b, B, 4e5, H);
                     s.choose_step();
                     s.T = .4;
                     s.miss_depth = .02;
                     return s;
                   }});
  return F;
}
inline Family layers() {  // closed skins with a contact height
  Family F{"cubes with h_c", {}};
  for (double H : {1e-3, .02})
    for (int n : {1, 2, 3})
      for (int nb : {1, 3})
        for (double side : {0.0, .02, .3})
          for (double shift : {0.0, .3})
            for (double tilt : {0.0, 5.0, 40.0})
              for (int passes : {1, 2})
                F.scenes.push_back({label({H, double(n), double(nb), side, shift, tilt, double(passes)}), [=] {
                                      Scene s;
                                      const int b = s.world.add(box(1, 1, 1, nb, nb, nb), V(0, 0, -.5), upright, 1, V::Zero());
                                      const int a = s.world.add(box(1, 1, 1, n, n, n), V(shift, shift / 2, .5), turn(tilt, V(1, .3, .2)), 1,
                                                                V(side, side / 2, -1));
                                      put_low(s, a, H + 1e-3);
                                      Surface *A = s.surface(a), *B = s.surface(b);
                                      if (passes == 1)
                                        one_pass(s, a, A, b, B, 4e4, H);
                                      else
                                        two_passes(s, a, A, b, B, 4e4, H);
                                      s.choose_step();
                                      s.T = .3;
                                      s.miss_depth = .05;
                                      return s;
                                    }});
  return F;
}
inline Family carried() {  // one loaded apex slides slowly over a ridge
  Family F{"load over a ridge", {}};
  for (double angle : {3.0, 10.0, 20.0, 30.0, 45.0, 60.0, 80.0})
    for (double v : {.03, .1, .3})
      for (double D : {1e-3, 1e-2})
        for (int across : {0, 1})
          for (double H : {0.0, .01})
            F.scenes.push_back(
                {label({angle, v, D, double(across), H}), [=] {
                   Scene s;
                   const double t = std::tan(angle * M_PI / 180);
                   Mesh m = prism({{0, 0}, {-1, 0}, {-1, -4}, {1, -4}, {1, -std::min(t, 3.5)}}, .5, 4);
                   outward(m);
                   const int b = s.world.add(m, V::Zero(), upright, 1, V::Zero(), V::Zero(), true);
                   const int a = s.world.add(octahedron(), V(-.05, .03, 0), upright, 1, V(v, across * v * .5, 0));
                   s.world.bodies[a].I = 1e6;
                   put_low(s, a, H - D);
                   Surface *A = s.surface(a), *B = s.surface(b);
                   one_pass(s, a, A, b, B, 1, H);
                   // starts at its static depth, as if it had come there from above
                   for (double& k : s.interfaces[0].k) k = 5 / D;
                   s.world.g = V(0, 0, -5);
                   s.reference = 5 * .05;
                   s.choose_step();
                   s.T = std::min(3.0, .2 / v);
                   s.miss_depth = 2 * D + .002;
                   // it stays out of the body but for its static depth
                   s.wrong = [=](const World& w) {
                     double low = 1e30;
                     for (int i = 0; i < 6; ++i) {
                       const V& p = w.x[w.bodies[a].first + i];
                       low = std::min(low, std::max(p.z(), p.z() * std::cos(angle * M_PI / 180) + p.x() * std::sin(angle * M_PI / 180)));
                     }
                     return w.bodies[a].c.x() < .9 && low < H - 6 * D - .01;
                   };
                   return s;
                 }});
  return F;
}
inline Family soft() {
  Family F{"soft cubes", {}};
  for (int n : {1, 2})
    for (int nb : {1, 2, 3})
      for (double v : {.3, 1.0})
        for (int kind : {0, 1, 2})
          for (int passes : {1, 2})
            F.scenes.push_back({label({double(n), double(nb), v, double(kind), double(passes)}), [=] {
                                  Scene s;
                                  const Quat q = kind == 2 ? turn(33, V(.2, .5, 1)) : upright;
                                  const int b = s.world.add(box(1, 1, 1, nb, nb, nb), V(0, 0, -.5), upright, 1, V::Zero());
                                  const int a =
                                      s.world.add(box(1, 1, 1, n, n, n), V(kind == 1 ? .2 : 0, kind == 1 ? .13 : 0, .5), q, 1, V(0, 0, -v));
                                  put_low(s, a, 1e-3);
                                  s.world.make_soft(a, 60, 1.8);
                                  s.world.make_soft(b, nb == 3 ? 20 : 60, 1.8);
                                  Surface *A = s.surface(a), *B = s.surface(b);
                                  if (passes == 1)
                                    one_pass(s, a, A, b, B, 4e3);
                                  else
                                    two_passes(s, a, A, b, B, 4e3);
                                  s.choose_step();
                                  s.T = .6 / std::sqrt(v);
                                  s.miss_depth = .1;
                                  return s;
                                }});
  return F;
}
