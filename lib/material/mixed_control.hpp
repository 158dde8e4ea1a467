#pragma once
// A point of material alone: some components of its strain are told, of the others the stress.
//
//     auto point = point_of<Symmetric>(law);
//     Goal<Symmetric> goal;                        // strains unless told otherwise
//     goal.target[0] = 1e-3;                       // xx is stretched,
//     goal.strain[1] = goal.strain[2] = false;     // yy and zz are free of stress
//     advance(law, goal, point);                   // uniaxial stress

#include <algorithm>

#include "base/dual.hpp"
#include "material/law.hpp"

namespace nereid::material {

/// What a point of a law has become.
///
/// S  Symmetric in space, Plane in a plate
template <class L, template <class> class S>
struct Point {
  S<double> strain{};               ///< [-] sum of the increments, tensor components
  S<double> stress{};               ///< [Pa]
  Internal<double, L, S> internal{};
  double stored = 0, dissipated = 0;  ///< [J/m3] since the start
};

/// A point to which nothing has happened yet.
template <template <class> class S, class L>
Point<L, S> point_of(const L& law) {
  return {.strain = {}, .stress = {}, .internal = fresh<double, S>(law)};
}

/// What the next increment is to reach, component by component in the order of S.
template <template <class> class S>
struct Goal {
  static constexpr int rows = S<double>::rows;
  std::array<bool, rows> strain = all_strains();  ///< true: `target` is a strain [-]; false: a stress [Pa]
  std::array<double, rows> target{};

 private:
  static constexpr std::array<bool, rows> all_strains() {
    std::array<bool, rows> all{};
    for (bool& one : all) one = true;
    return all;
  }
};

/// How the strains to given stresses were found.
struct Sought {
  bool found = false;  ///< false: no strain that was tried gives the stresses, and the point is as it was
  int rounds = 0;      ///< of Newton
};

/// The components of a tensor in its order.
template <class T, template <class> class S>
std::array<T, S<T>::rows> components(S<T> tensor) {
  std::array<T, S<T>::rows> list;
  int row = 0;
  tensor.each_row([&](T& value) { list[row++] = value; });
  return list;
}
/// A tensor from its components.
template <template <class> class S, class T, std::size_t count>
S<T> tensor_of(const std::array<T, count>& list) {
  static_assert(count == S<T>::rows);
  S<T> tensor{};
  int row = 0;
  tensor.each_row([&](T& value) { value = list[row++]; });
  return tensor;
}

/// Solves A x = b for the first `count` unknowns, A by rows of six; returns x.
std::array<double, 6> solved(const std::array<double, 36>& A, const std::array<double, 6>& b, int count);

/// Brings a point to its goal in one increment.
///
/// Strains that are told go straight to the law. Those sought, e, are the root of  stress(e) = target  by Newton
/// from e = 0; the slope comes from dual numbers through the law itself. A step that would make the residual
/// grow is halved: beyond yield the slope falls by orders of magnitude.
///
/// dt       [s] that the increment takes
/// returns  whether stresses were met to 1e-14 of (lambda + 2 mu) times the increment, plus the stress
///
/// Needs  targets that the law can reach: perfect plasticity has no strain for a stress beyond yield
template <Law L, template <class> class S>
Sought advance(const L& law, const Goal<S>& goal, Point<L, S>& point, double dt = 1) {
  constexpr int rows = S<double>::rows, most_rounds = 100, most_halvings = 30;
  using D = Dual<rows>;
  const auto strain = components<double, S>(point.strain);
  std::array<double, rows> increment{};
  std::array<int, rows> sought{};
  int count = 0;
  for (int i = 0; i < rows; ++i) {
    if (goal.strain[i]) increment[i] = goal.target[i] - strain[i];
    else sought[count++] = i;
  }

  struct Trial {
    std::array<double, 6> miss{};   // [Pa] target less stress
    std::array<double, 36> slope{};
    double worst = 0, enough = 0;   // [Pa]
  };
  const auto lame_constants = lame(law);
  const auto try_out = [&](const std::array<double, rows>& e) {
    std::array<D, rows> de;
    for (int i = 0; i < rows; ++i) de[i] = D::variable(e[i], i);
    const auto old = components<double, S>(point.stress);
    std::array<D, rows> old_stress;
    std::copy(old.begin(), old.end(), old_stress.begin());
    S<D> stress = tensor_of<S>(old_stress);
    Internal<D, L, S> internal{};
    std::copy(point.internal.scalar.begin(), point.internal.scalar.end(), internal.scalar.begin());
    for (std::size_t t = 0; t < internal.tensor.size(); ++t) {
      const auto from = components<double, S>(point.internal.tensor[t]);
      std::array<D, rows> to;
      std::copy(from.begin(), from.end(), to.begin());
      internal.tensor[t] = tensor_of<S>(to);
    }
    update_stress(law, Increment<D, S>{tensor_of<S>(de), dt, 1.0}, stress, internal);
    const auto now = components<D, S>(stress);
    Trial trial;
    double largest_stress = 0, largest_strain = 0;
    for (int i = 0; i < rows; ++i) {
      largest_stress = std::max({largest_stress, std::abs(now[i].value), goal.strain[i] ? 0 : std::abs(goal.target[i])});
      largest_strain = std::max(largest_strain, std::abs(e[i]));
    }
    for (int r = 0; r < count; ++r) {
      trial.miss[r] = goal.target[sought[r]] - now[sought[r]].value;
      for (int c = 0; c < count; ++c) trial.slope[6 * r + c] = now[sought[r]].by[sought[c]];
      trial.worst = std::max(trial.worst, std::abs(trial.miss[r]));
    }
    trial.enough = 1e-14 * ((std::abs(lame_constants.lambda) + 2 * lame_constants.mu) * largest_strain + largest_stress);
    return trial;
  };

  Sought result;
  Trial here = count > 0 ? try_out(increment) : Trial{};
  while (count > 0 && !(here.worst <= here.enough) && result.rounds < most_rounds) {
    ++result.rounds;
    const auto way = solved(here.slope, here.miss, count);
    double part = 1;
    bool nearer = false;
    for (int half = 0; half < most_halvings && !nearer; ++half, part /= 2) {
      auto next = increment;
      for (int r = 0; r < count; ++r) next[sought[r]] += part * way[r];
      const Trial there = try_out(next);
      nearer = there.worst < here.worst;
      if (nearer) increment = next, here = there;
    }
    if (!nearer) break;
  }
  result.found = here.worst <= 1e3 * here.enough;  // round-off may keep it above what is hoped for
  if (!result.found) return result;

  const S<double> step = tensor_of<S>(increment);
  const Work<double> work = update_stress(law, Increment<double, S>{step, dt, 1.0}, point.stress, point.internal).work;
  point.strain = point.strain + step;
  point.stored += work.stored;
  point.dissipated += work.dissipated;
  return result;
}

}  // namespace nereid::material
