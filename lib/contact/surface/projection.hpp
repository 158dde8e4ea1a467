#pragma once
// The shortest penetration vector of a set of contacts.

#include <array>

#include "base/types.hpp"

namespace nereid::contact {

constexpr int most_candidates = 8;

/// Contacts of one apex: unit normals (or their parts in the allowed directions) and depths.
struct Contacts {
  int count = 0;
  std::array<Vec3, most_candidates> normal;
  std::array<double, most_candidates> depth{};  ///< [m] h_c - h
};

/// Multipliers of the shortest vector d with  n_i . d >= depth_i  for all contacts.
///
///     d = sum of lambda_i n_i,   lambda_i >= 0,   lambda_i (n_i . d - depth_i) = 0
///
/// d leads to the closest point of an intersection of half spaces. |d|^2/2 is convex in the depths
/// and has a continuous gradient, so contacts come and go without a jump of the force. A contact
/// that the others satisfy already takes no part: coplanar facets count once.
///
/// returns  lambda [m]; at most three differ from zero
std::array<double, most_candidates> projection_multipliers(const Contacts&);

}  // namespace nereid::contact
