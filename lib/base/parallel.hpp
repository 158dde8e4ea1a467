#pragma once
// The one door to threads. Results never depend on their number: every loop below writes to places
// of its own, and sums over things are taken in the order of the things.

#include <algorithm>

#include "base/types.hpp"

namespace nereid {

/// Uses that many threads from now on, the caller's own among them. At first it is one for each core.
///
/// Needs  that no parallel_for is running
/// Throws MachineError where the system does not start so many.
void use_threads(int count);
int threads();

/// Calls range(context, first, last) on every thread, with its contiguous share of [0, count).
void share_loop(Index count, void (*range)(void*, Index, Index), void* context);

/// Calls body(i) for i in [0, count), shared out among the threads in contiguous ranges.
///
/// grain  calls that are worth a thread of their own; fewer than two grains run on the caller's
/// Needs  a body that does not throw and does not call parallel_for
template <class Body>
void parallel_for(Index count, Index grain, Body&& body) {
  auto range = [&body](Index first, Index last) {
    for (Index i = first; i < last; ++i) body(i);
  };
  if (count < 2 * grain) return range(0, count);
  share_loop(count, [](void* context, Index first, Index last) { (*static_cast<decltype(range)*>(context))(first, last); }, &range);
}

/// Sum over i < count of term(i): in ranges of a fixed length, whose sums are added in order.
///
/// partial  scratch, which grows once to the number of ranges
template <class Term>
double ordered_sum(Index count, std::vector<double>& partial, Term&& term) {
  constexpr Index length = 512;  // fixed, so that no number of threads changes a bit
  const Index ranges = (count + length - 1) / length;
  partial.resize(ranges);
  parallel_for(ranges, 8, [&](Index r) {
    double sum = 0;
    for (Index i = r * length; i < std::min(count, (r + 1) * length); ++i) sum += term(i);
    partial[r] = sum;
  });
  double sum = 0;
  for (const double p : partial) sum += p;
  return sum;
}

}  // namespace nereid
