#pragma once
// A pack of one lane, for builds that check rather than run: with NEREID_ONE_LANE number.hpp takes it in place of <experimental/simd>.
//
// Sanitizers and coverage look at every call, and a pack of the standard library makes hundreds: a kernel takes ten minutes to compile.

#include <cmath>
#include <cstddef>
#include <type_traits>

namespace nereid::one_lane {

/// What a comparison of two packs gives.
struct Mask {
  bool set;
  Mask() = default;
  explicit Mask(bool all) : set(all) {}
  friend Mask operator!(Mask a) { return Mask(!a.set); }
  friend Mask operator&&(Mask a, Mask b) { return Mask(a.set && b.set); }
  friend Mask operator||(Mask a, Mask b) { return Mask(a.set || b.set); }
  bool operator[](std::size_t) const { return set; }
};

struct Unaligned {};
constexpr Unaligned element_aligned{};

/// A number with the interface of a pack.
struct Number {
  using mask_type = Mask;
  double value;

  Number() = default;
  Number(double all) : value(all) {}
  template <class Lane>
    requires std::is_invocable_v<Lane, std::integral_constant<std::size_t, 0>>
  explicit Number(Lane&& lane) : value(lane(std::integral_constant<std::size_t, 0>{})) {}

  static constexpr std::size_t size() { return 1; }
  double operator[](std::size_t) const { return value; }
  double& operator[](std::size_t) { return value; }
  void copy_from(const double* from, Unaligned) { value = *from; }
  void copy_to(double* to, Unaligned) const { *to = value; }

  friend Number operator-(Number a) { return -a.value; }
  friend Number operator+(Number a, Number b) { return a.value + b.value; }
  friend Number operator-(Number a, Number b) { return a.value - b.value; }
  friend Number operator*(Number a, Number b) { return a.value * b.value; }
  friend Number operator/(Number a, Number b) { return a.value / b.value; }
  Number& operator+=(Number b) { return *this = *this + b; }
  Number& operator-=(Number b) { return *this = *this - b; }
  Number& operator*=(Number b) { return *this = *this * b; }
  Number& operator/=(Number b) { return *this = *this / b; }
  friend Mask operator<(Number a, Number b) { return Mask(a.value < b.value); }
  friend Mask operator>(Number a, Number b) { return Mask(a.value > b.value); }
  friend Mask operator<=(Number a, Number b) { return Mask(a.value <= b.value); }
  friend Mask operator>=(Number a, Number b) { return Mask(a.value >= b.value); }
  friend Mask operator==(Number a, Number b) { return Mask(a.value == b.value); }
  friend Mask operator!=(Number a, Number b) { return Mask(a.value != b.value); }
};

template <class>
using native_simd = Number;

/// What where() gives: takes a number where the mask is set.
struct Where {
  bool set;
  Number& to;
  void operator=(Number from) {
    if (set) to = from;
  }
};
inline Where where(Mask mask, Number& to) { return {mask.set, to}; }
inline bool any_of(Mask mask) { return mask.set; }
inline Number sqrt(Number a) { return std::sqrt(a.value); }

}  // namespace nereid::one_lane
