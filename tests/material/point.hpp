#pragma once
// One material point: its tensors and memory as rows of numbers, and strains that keep some stresses zero.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <variant>
#include <vector>

#include "base/dual.hpp"
#include "material/laws.hpp"

namespace nereid::material {

/// Every law of solids, and those of them that plates may have.
template <class List>
struct TypesOf;
template <class... Laws>
struct TypesOf<std::variant<Laws...>> {
  using type = ::testing::Types<Laws...>;
};
template <class... Laws>
struct TypesOf<std::tuple<Laws...>> {
  using type = ::testing::Types<Laws...>;
};
template <class... Laws>
auto those_of_plates(const std::variant<Laws...>*) {
  return std::tuple_cat(std::conditional_t<PlateLaw<Laws>, std::tuple<Laws>, std::tuple<>>{}...);
}
template <class... Laws>
auto those_of_solids(const std::variant<Laws...>*) {
  return std::tuple_cat(std::conditional_t<Law<Laws>, std::tuple<Laws>, std::tuple<>>{}...);
}
template <class... Laws>
auto those_in_rates(const std::variant<Laws...>*) {
  return std::tuple_cat(std::conditional_t<!Law<Laws> || std::is_same_v<Laws, NeoHookean>, std::tuple<>, std::tuple<Laws>>{}...);
}
using Laws = TypesOf<decltype(those_of_solids(static_cast<AnyLaw*>(nullptr)))>::type;
/// Those whose stress is that of Hooke's law less what flows; neo_hookean_test.cpp has the other.
using LawsInRates = TypesOf<decltype(those_in_rates(static_cast<AnyLaw*>(nullptr)))>::type;
using PlateLaws = TypesOf<decltype(those_of_plates(static_cast<AnyLaw*>(nullptr)))>::type;

/// Strains a point, so slowly that no rate counts unless a time is told.
template <class L, template <class> class S, class T>
Work<T> strain_by(const L& law, const S<T>& strain, S<T>& stress, Internal<T, L, S>& internal, double dt = 1e12) {
  return update_stress(law, Increment<T, S>{strain, T(dt), T(1.0)}, stress, internal).work;
}

template <class T>
std::array<T*, 6> components(Symmetric<T>& a) {
  return {&a.xx, &a.yy, &a.zz, &a.xy, &a.yz, &a.xz};
}
template <class T>
std::array<T*, 3> components(Plane<T>& a) {
  return {&a.xx, &a.yy, &a.xy};
}
template <class S>
double largest(S a) {
  double size = 0.0;
  for (double* c : components(a)) size = std::max(size, std::abs(*c));
  return size;
}

/// What a point remembers before anything has happened to it, for the law L and this kind of stress.
template <class L, template <class> class S, class T>
Internal<T, L, S> fresh(const S<T>&) {
  return {};
}
/// Everything a point remembers for its law, in one order.
template <class T, class L, template <class> class S>
std::vector<T> rows(Internal<T, L, S> internal) {
  std::vector<T> all;
  internal.each_row([&all](const T& row) { all.push_back(row); });
  return all;
}
/// The same memory in dual numbers, without derivatives.
template <int n, class L, template <class> class S>
Internal<Dual<n>, L, S> as_dual(const Internal<double, L, S>& internal) {
  Internal<Dual<n>, L, S> dual{};
  std::size_t next = 0;
  const auto all = rows(internal);
  dual.each_row([&](Dual<n>& row) { row = Dual<n>(all[next++]); });
  return dual;
}

/// Stretches along x and finds by Newton the free strains that keep the other normal stresses zero.
template <Law L>
Work<double> stretch(const L& law, double axial, Symmetric<double>& stress,
                     Internal<double, L, Symmetric>& internal) {
  double lateral = -law.poisson * axial;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const auto free = Dual<1>::variable(lateral, 0);
    Symmetric<Dual<1>> s{stress.xx, stress.yy, stress.zz, stress.xy, stress.yz, stress.xz};
    auto memory = as_dual<1>(internal);
    strain_by(law, Symmetric<Dual<1>>{axial, free, free, 0, 0, 0}, s, memory);
    const double change = -s.yy.value / s.yy.by[0];
    lateral += change;
    if (std::abs(change) < 1e-16 * std::abs(axial)) break;
  }
  return strain_by(law, Symmetric<double>{axial, lateral, lateral, 0, 0, 0}, stress, internal);
}
template <PlateLaw L>
Work<double> stretch(const L& law, double axial, Plane<double>& stress,
                     Internal<double, L, Plane>& internal) {
  double lateral = -law.poisson * axial;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const auto free = Dual<1>::variable(lateral, 0);
    Plane<Dual<1>> s{stress.xx, stress.yy, stress.xy};
    auto memory = as_dual<1>(internal);
    strain_by(law, Plane<Dual<1>>{axial, free, 0}, s, memory);
    const double change = -s.yy.value / s.yy.by[0];
    lateral += change;
    if (std::abs(change) < 1e-16 * std::abs(axial)) break;
  }
  return strain_by(law, Plane<double>{axial, lateral, 0}, stress, internal);
}

/// Strains a point of space in the plane xy and finds by Newton the zz strain that keeps zz free.
template <Law L>
Work<double> strain_as_plate(const L& law, const Plane<double>& e, Symmetric<double>& stress,
                             Internal<double, L, Symmetric>& internal) {
  double thinning = -law.poisson / (1.0 - law.poisson) * (e.xx + e.yy);
  for (int iteration = 0; iteration < 50; ++iteration) {
    const auto free = Dual<1>::variable(thinning, 0);
    Symmetric<Dual<1>> s{stress.xx, stress.yy, stress.zz, stress.xy, stress.yz, stress.xz};
    auto memory = as_dual<1>(internal);
    strain_by(law, Symmetric<Dual<1>>{e.xx, e.yy, free, e.xy, 0, 0}, s, memory);
    const double change = -s.zz.value / s.zz.by[0];
    thinning += change;
    if (std::abs(change) < 1e-16 * largest(e)) break;
  }
  return strain_by(law, Symmetric<double>{e.xx, e.yy, thinning, e.xy, 0, 0}, stress, internal);
}

}  // namespace nereid::material
