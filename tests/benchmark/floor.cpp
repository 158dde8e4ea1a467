// The floor under the cost of an element: how fast one core can cycle a plastic hexahedron.
//
//     g++ -std=c++20 -O3 -march=native -o floor floor.cpp
//     floor 20 400        8000 elements, in cache
//     floor 100 20        a million elements, in memory
//
// prints nanoseconds per element and step, and a checksum that shows that the work was done. The
// project quotes its own element speed as a ratio to this figure, taken in the same minute on the
// same machine. It is a reference to measure with: nothing of it goes into the product, and it shares
// no code with it. It omits what a product needs: checks, viscosity, an account of energy, an
// estimate of the stable step, threads, any mesh but a cube.
//
// Physics: hexahedra with one point, stiffness control of hourglass modes (Flanagan & Belytschko
// 1981), Jaumann rate, von Mises plasticity with linear hardening, central differences.
//
// Design: corner I of the parent cube sits at (r, s, t) = (+-1, +-1, +-1); a bit of I that is set
// means minus. The products of these signs are the eight modes of the element: one constant, three
// linear (r, s, t), four hourglass (rs, rt, st, rst). A transform of 24 additions takes eight
// corner values to eight modes, and is its own transpose, so it takes forces of modes back to
// corners. In between nothing is summed over corners any more. With X_m, V_m the modes of position
// and velocity and F_m those of force:
//
//     columns of the Jacobian  X_r, X_s, X_t (times 8);  A_r = X_s x X_t, and so around;
//     det = X_r . A_r = 64 volume;
//     gradient of velocity     L = sum over linear m of  V_m A_m^T / det;
//     hourglass rate           V_h - L X_h: the gradient's share is taken out, so that linear
//     motion
//                              of a distorted element is left in peace;
//     force, the adjoint       F_h = Q_h,   F_m = (volume stress - sum over h of Q_h X_h^T) A_m /
//     det.

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <experimental/simd>
#include <vector>

namespace {

namespace stdx = std::experimental;
using Pack = stdx::native_simd<double>;
constexpr int lanes = Pack::size();

struct Vec {
  Pack x, y, z;
};
inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(const Pack& s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Pack dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The bits of a corner are its signs; those of a mode say which of r, s, t it is the product of.
enum Mode { constant = 0, r = 1, s = 2, rs = 3, t = 4, rt = 5, st = 6, rst = 7 };
constexpr std::array<Mode, 4> hourglass_modes{rs, rt, st, rst};
using Octet = std::array<Vec, 8>;  // by corner or by mode

/// Corner values to modes, or modes to corner values, in place: value_m = sum of +-value_I.
inline void transform(Octet& a) {
  for (const int bit : {1, 2, 4})
    for (int low = 0; low < 8; ++low)
      if (!(low & bit)) {
        const Vec plus = a[low], minus = a[low | bit];
        a[low] = plus + minus;
        a[low | bit] = plus - minus;
      }
}

struct Material {
  double lambda, mu, yield, hardening;
  double hourglass;  // share of the elastic stiffness
};

/// What elements read of a node, and what they add to it. Each lies together, and nothing is
/// padded: a large mesh waits for memory.
struct Node {
  double x[3], v[3];
};
struct Force {
  double f[3] = {0.0, 0.0, 0.0}, inverse_mass = 1.0;
};

/// What `lanes` elements remember, and which nodes they have.
struct Packet {
  std::array<std::array<std::int32_t, lanes>, 8> node;
  Pack xx, yy, zz, xy, yz, xz, plastic_strain;
  std::array<Vec, 4> hourglass;
};

/// Adds the forces of a packet of elements to those of the nodes.
///
/// velocities are those between the last positions and the next, as central differences have them
__attribute__((noinline)) void add_force(const Material& law, double dt,
                                         const std::vector<Node>& nodes, Packet& packet,
                                         std::vector<Force>& forces) {
  Octet X, V;
  for (int corner = 0; corner < 8; ++corner) {
    const auto gather = [&](auto get) { return Pack([&](int lane) { return get(lane); }); };
    const auto& id = packet.node[corner];
    X[corner] = {gather([&](int l) { return nodes[id[l]].x[0]; }),
                 gather([&](int l) { return nodes[id[l]].x[1]; }),
                 gather([&](int l) { return nodes[id[l]].x[2]; })};
    V[corner] = {gather([&](int l) { return nodes[id[l]].v[0]; }),
                 gather([&](int l) { return nodes[id[l]].v[1]; }),
                 gather([&](int l) { return nodes[id[l]].v[2]; })};
  }
  transform(X);
  transform(V);

  const Vec Ar = cross(X[s], X[t]), As = cross(X[t], X[r]), At = cross(X[r], X[s]);
  const Pack det = dot(X[r], Ar), over_det = 1.0 / det;
  const Pack step = dt * over_det;

  // Increment of the displacement gradient, by rows.
  const auto row = [&](const Pack& vr, const Pack& vs, const Pack& vt) {
    return step * (vr * Ar + vs * As + vt * At);
  };
  const Vec Lx = row(V[r].x, V[s].x, V[t].x);
  const Vec Ly = row(V[r].y, V[s].y, V[t].y);
  const Vec Lz = row(V[r].z, V[s].z, V[t].z);

  // Jaumann: the spin W turns the stress by  W s - s W;  twice the shear strains come along.
  const Pack wz = 0.5 * (Ly.x - Lx.y), wx = 0.5 * (Lz.y - Ly.z), wy = 0.5 * (Lx.z - Lz.x);
  const Pack xx = packet.xx, yy = packet.yy, zz = packet.zz;
  const Pack xy = packet.xy, yz = packet.yz, xz = packet.xz;
  const Pack spin_z = 2.0 * wz * xy, spin_x = 2.0 * wx * yz, spin_y = 2.0 * wy * xz;
  const Pack mean_strain = law.lambda * (Lx.x + Ly.y + Lz.z), twice_mu = 2.0 * law.mu;
  Pack nxx = xx + mean_strain + twice_mu * Lx.x + spin_y - spin_z;
  Pack nyy = yy + mean_strain + twice_mu * Ly.y + spin_z - spin_x;
  Pack nzz = zz + mean_strain + twice_mu * Lz.z + spin_x - spin_y;
  Pack nxy = xy + law.mu * (Lx.y + Ly.x) + wz * (xx - yy) + wy * yz - wx * xz;
  Pack nyz = yz + law.mu * (Ly.z + Lz.y) + wx * (yy - zz) + wz * xz - wy * xy;
  Pack nxz = xz + law.mu * (Lx.z + Lz.x) + wy * (zz - xx) + wx * xy - wz * yz;

  // Radial return. The larger of the two squares makes the flow zero where the trial is elastic.
  const Pack mean = (1.0 / 3.0) * (nxx + nyy + nzz);
  nxx -= mean, nyy -= mean, nzz -= mean;
  const Pack q2 =
      1.5 * (nxx * nxx + nyy * nyy + nzz * nzz) + 3.0 * (nxy * nxy + nyz * nyz + nxz * nxz);
  const Pack yield = law.yield + law.hardening * packet.plastic_strain;
  const Pack q = stdx::sqrt(stdx::max(q2, yield * yield));
  const Pack flow = (1.0 / (3.0 * law.mu + law.hardening)) * (q - yield);
  const Pack shrink = 1.0 - 3.0 * law.mu * flow / q;
  packet.plastic_strain += flow;
  packet.xx = nxx = mean + shrink * nxx;
  packet.yy = nyy = mean + shrink * nyy;
  packet.zz = nzz = mean + shrink * nzz;
  packet.xy = nxy = shrink * nxy;
  packet.yz = nyz = shrink * nyz;
  packet.xz = nxz = shrink * nxz;

  // Sum over corners of the squared gradients of the shape functions is 8 (A_m . A_m) / det^2, the
  // element's largest eigenvalue; hourglass stiffness is a small share of it.
  const Pack largest = dot(Ar, Ar) + dot(As, As) + dot(At, At);
  const Pack stiffness = law.hourglass * (law.lambda + 2.0 * law.mu) * largest * over_det;
  // Rows of  S = (volume stress - sum of Q_h X_h^T) / det,  volume / det being 1 / 64.
  const double share = 1.0 / 64.0;
  Vec Sx{share * nxx, share * nxy, share * nxz};
  Vec Sy{share * nxy, share * nyy, share * nyz};
  Vec Sz{share * nxz, share * nyz, share * nzz};
  Octet F;
  for (int k = 0; k < 4; ++k) {
    const Mode h = hourglass_modes[k];
    const Vec rate{dt * V[h].x - dot(Lx, X[h]), dt * V[h].y - dot(Ly, X[h]),
                   dt * V[h].z - dot(Lz, X[h])};
    const Vec Q = packet.hourglass[k] + stiffness * rate;
    packet.hourglass[k] = Q;
    F[h] = Q;
    const Vec lever = over_det * X[h];
    Sx = Sx - Q.x * lever;
    Sy = Sy - Q.y * lever;
    Sz = Sz - Q.z * lever;
  }
  const auto times = [&](const Vec& A) { return Vec{dot(Sx, A), dot(Sy, A), dot(Sz, A)}; };
  F[constant] = {0.0, 0.0, 0.0};
  F[r] = times(Ar);
  F[s] = times(As);
  F[t] = times(At);
  transform(F);

  for (int corner = 0; corner < 8; ++corner) {
    alignas(64) double f[3][lanes];
    F[corner].x.copy_to(f[0], stdx::vector_aligned);
    F[corner].y.copy_to(f[1], stdx::vector_aligned);
    F[corner].z.copy_to(f[2], stdx::vector_aligned);
    for (int lane = 0; lane < lanes; ++lane) {
      Force& at = forces[packet.node[corner][lane]];
      for (int axis = 0; axis < 3; ++axis) at.f[axis] -= f[axis][lane];
    }
  }
}

/// Velocities by half a step ahead of positions; forces are used up.
void advance(double dt, std::vector<Node>& nodes, std::vector<Force>& forces) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      nodes[i].v[axis] += dt * forces[i].inverse_mass * forces[i].f[axis];
      nodes[i].x[axis] += dt * nodes[i].v[axis];
      forces[i].f[axis] = 0.0;
    }
}

}  // namespace

int main(int count, char** words) {
  const int N = count > 1 ? std::atoi(words[1]) : 20;
  const int steps = count > 2 ? std::atoi(words[2]) : 400;
  if (N < 1 || steps < 1) return std::fprintf(stderr, "usage: floor N steps\n"), 2;

  // A cube of N^3 unit cells, everything of order one: c = 1.6, so that dt is a third of a
  // transit. It starts in a smooth motion fast enough that a good part of it flows.
  const Material law{1.0, 0.8, 2e-3, 0.05, 0.002};
  const double dt = 0.2;
  const int side = N + 1;
  const auto number = [side](int i, int j, int k) { return (k * side + j) * side + i; };
  std::vector<Node> nodes(static_cast<std::size_t>(side) * side * side);
  const double wave = 3.14159265358979 / N;
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i)
        nodes[number(i, j, k)] = {{double(i), double(j), double(k)},
                                  {0.01 * std::cos(wave * i + 0.3), 0.01 * std::cos(wave * (j + i)),
                                   0.01 * std::cos(wave * (k - j) + 0.7)}};

  // Lanes that only fill up the last packet hold one more cell, apart from the cube and at rest.
  const int spare = static_cast<int>(nodes.size());
  for (int corner = 0; corner < 8; ++corner)
    nodes.push_back({{double(!(corner & 1)), double(!(corner & 2)), double(!(corner & 4))}, {}});
  std::vector<Force> forces(nodes.size());

  const std::int64_t elements = std::int64_t(N) * N * N;
  std::vector<Packet> packets((elements + lanes - 1) / lanes);
  for (std::int64_t e = 0; e < std::int64_t(packets.size()) * lanes; ++e) {
    Packet& packet = packets[e / lanes];
    const int lane = e % lanes;
    const int i = e % N, j = e / N % N, k = e / N / N;
    for (int corner = 0; corner < 8; ++corner)
      packet.node[corner][lane] =
          e < elements ? number(i + !(corner & 1), j + !(corner & 2), k + !(corner & 4))
                       : spare + corner;
  }
  for (Packet& packet : packets) {
    packet.xx = packet.yy = packet.zz = packet.xy = packet.yz = packet.xz = 0.0;
    packet.plastic_strain = 0.0;
    packet.hourglass.fill({0.0, 0.0, 0.0});
  }

  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < steps; ++i) {
    for (Packet& packet : packets) add_force(law, dt, nodes, packet, forces);
    advance(dt, nodes, forces);
  }
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;

  double checksum = 0.0, flowed = 0.0;
  for (const Node& node : nodes)
    for (const double x : node.x) checksum += x * x;
  for (const Packet& packet : packets) flowed += stdx::reduce(packet.plastic_strain);
  std::printf(
      "%.2f ns per element and step (%d lanes, %lld elements); checksum %.12g, mean plastic "
      "strain %.6g\n",
      time.count() / steps / double(elements), lanes, static_cast<long long>(elements), checksum,
      flowed / double(elements));
}
