#include "contact/surface/projection.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace nereid::contact {

namespace {

using Lambda = std::array<double, most_candidates>;

Vec3 way(const Contacts& contacts, const Lambda& lambda) {
  Vec3 d = Vec3::Zero();
  for (int i = 0; i < contacts.count; ++i) d += lambda[i] * contacts.normal[i];
  return d;
}

/// Lambda for which the first `size` contacts of `active` are met exactly.
Eigen::Vector3d meet(const Contacts& contacts, const std::array<int, 3>& active, int size) {
  if (size == 1) {
    const double n = contacts.normal[active[0]].squaredNorm();
    return {contacts.depth[active[0]] / n, 0, 0};
  }
  Mat3 gram = Mat3::Identity();
  Vec3 depth = Vec3::Zero();
  for (int a = 0; a < size; ++a) {
    for (int b = 0; b < size; ++b) gram(a, b) = contacts.normal[active[a]].dot(contacts.normal[active[b]]);
    depth[a] = contacts.depth[active[a]];
  }
  return gram.ldlt().solve(depth);
}

/// The shortest way among those that meet one, two or three contacts exactly and satisfy the others;
/// leaves lambda as it is if there is none. For the few corners where more than three contacts crowd.
void try_all(const Contacts& contacts, double tolerance, Lambda& lambda) {
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::array<int, 3>& active, int size) {
    const Vec3 at = meet(contacts, active, size);
    Lambda trial{};
    for (int a = 0; a < size; ++a) {
      if (!(at[a] >= 0)) return;
      trial[active[a]] = at[a];
    }
    const Vec3 d = way(contacts, trial);
    if (!(d.squaredNorm() < least)) return;
    for (int i = 0; i < contacts.count; ++i)
      if (!(contacts.depth[i] - contacts.normal[i].dot(d) <= tolerance)) return;
    least = d.squaredNorm();
    lambda = trial;
  };
  for (int i = 0; i < contacts.count; ++i) {
    consider({i, 0, 0}, 1);
    for (int j = i + 1; j < contacts.count; ++j) {
      consider({i, j, 0}, 2);
      for (int k = j + 1; k < contacts.count; ++k) consider({i, j, k}, 3);
    }
  }
}

}  // namespace

Lambda projection_multipliers(const Contacts& contacts) {
  Lambda lambda{};
  if (contacts.count == 0) return lambda;
  const auto deepest = std::max_element(contacts.depth.begin(), contacts.depth.begin() + contacts.count);
  if (!(*deepest > 0)) return lambda;
  const double tolerance = 1e-10 * *deepest;  // far above round-off, far below any effect

  // Dual active-set method: add the contact violated most, drop those that would have to pull
  std::array<int, 3> active{static_cast<int>(deepest - contacts.depth.begin()), 0, 0};
  int size = 1;
  for (int round = 0; round < 4 * most_candidates; ++round) {
    const Vec3 at = meet(contacts, active, size);
    int pulls = -1;
    for (int a = 0; a < size; ++a)
      if (at[a] <= 0 && (pulls < 0 || at[a] < at[pulls])) pulls = a;
    if (pulls >= 0 && size > 1) {
      active[pulls] = active[--size];
      continue;
    }
    lambda.fill(0);
    for (int a = 0; a < size; ++a) lambda[active[a]] = at[a];
    const Vec3 d = way(contacts, lambda);
    int worst = -1;
    double missing = tolerance;
    for (int i = 0; i < contacts.count; ++i) {
      if (std::find(active.begin(), active.begin() + size, i) != active.begin() + size) continue;
      const double lack = contacts.depth[i] - contacts.normal[i].dot(d);
      if (lack > missing) worst = i, missing = lack;
    }
    if (worst < 0) return lambda;
    if (size == 3) break;
    active[size++] = worst;
  }
  try_all(contacts, tolerance, lambda);
  return lambda;
}

}  // namespace nereid::contact
