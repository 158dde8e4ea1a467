#pragma once
// One formula, three number types.
//
// Kernels are templates on their number type T and are written once. They run on
//     double     to be read and tested,
//     Dual<n>    to have their gradients checked (base/dual.hpp),
//     Pack       to be fast: a row of doubles that one instruction treats at once.
// A kernel therefore has no `if` on a number: it selects. The functions below are all it needs.

#include <cmath>

#ifdef NEREID_ONE_LANE
#include "base/one_lane.hpp"
#define NEREID_HOT inline
namespace nereid {
namespace stdx = one_lane;
}
#else
#include <experimental/simd>
/// Kernels are made of small functions on packs; left to itself the compiler calls them one by one.
#define NEREID_HOT [[gnu::always_inline]] inline
namespace nereid {
namespace stdx = std::experimental;
}
#endif

namespace nereid {

using Pack = stdx::native_simd<double>;
constexpr int lanes = static_cast<int>(Pack::size());

/// What a comparison of two T gives.
template <class T>
struct MaskOf {
  using type = bool;
};
template <>
struct MaskOf<Pack> {
  using type = Pack::mask_type;
};
template <class T>
using Mask = typename MaskOf<T>::type;

NEREID_HOT double select(bool condition, double yes, double no) { return condition ? yes : no; }
NEREID_HOT Pack select(Pack::mask_type condition, Pack yes, Pack no) {
#if defined(__clang__) && defined(__AVX512F__) && !defined(NEREID_ONE_LANE)
  // where() of libstdc++ 12 assigns nothing here: it blends by `mask ? a : b` with the bits of all lanes as one condition
  return Pack([&](auto lane) {
    const auto i = static_cast<std::size_t>(lane);
    return condition[i] ? yes[i] : no[i];
  });
#else
  stdx::where(!condition, yes) = no;
  return yes;
#endif
}

NEREID_HOT bool any(bool condition) { return condition; }
NEREID_HOT bool any(Pack::mask_type condition) { return stdx::any_of(condition); }

NEREID_HOT double root(double a) { return std::sqrt(a); }
NEREID_HOT Pack root(Pack a) { return stdx::sqrt(a); }

NEREID_HOT double logarithm(double a) { return std::log(a); }
NEREID_HOT Pack logarithm(const Pack& a) {
  return Pack([&](auto lane) { return std::log(a[static_cast<std::size_t>(lane)]); });
}
/// a^n for a >= 0, lane by lane with the same bits as of a double.
NEREID_HOT double power_of(double a, double n) { return std::pow(a, n); }
NEREID_HOT Pack power_of(const Pack& a, double n) {
  return Pack([&](auto lane) { return std::pow(a[static_cast<std::size_t>(lane)], n); });
}

/// A function of two numbers at a point, with its slopes.
template <class T>
struct Tangent {
  T value, by_first, by_second;
};
/// A function of two numbers that is no formula of packs, as a measured curve: lane by lane.
///
/// function  Tangent<double>(double, double)
template <class F>
NEREID_HOT Tangent<double> at_each_lane(const F& function, double a, double b) {
  return function(a, b);
}
template <class F>
NEREID_HOT Tangent<Pack> at_each_lane(const F& function, const Pack& a, const Pack& b) {
  Tangent<Pack> all{Pack(0.0), Pack(0.0), Pack(0.0)};
  for (std::size_t lane = 0; lane < Pack::size(); ++lane) {
    const Tangent<double> at = function(static_cast<double>(a[lane]), static_cast<double>(b[lane]));
    all.value[lane] = at.value, all.by_first[lane] = at.by_first, all.by_second[lane] = at.by_second;
  }
  return all;
}

/// The larger and the smaller of two, by select, so that every number type has them.
template <class T>
NEREID_HOT T larger(T a, T b) {
  return select(a > b, a, b);
}
template <class T>
NEREID_HOT T smaller(T a, T b) {
  return select(a < b, a, b);
}

/// Reads a T from, and writes it to, the first of `lanes` adjacent doubles (one for double).
NEREID_HOT void read_lanes(const double* from, double& to) { to = *from; }
NEREID_HOT void read_lanes(const double* from, Pack& to) { to.copy_from(from, stdx::element_aligned); }
NEREID_HOT void write_lanes(double from, double* to) { *to = from; }
NEREID_HOT void write_lanes(Pack from, double* to) { from.copy_to(to, stdx::element_aligned); }

}  // namespace nereid
