#pragma once
// The one door to OpenMP. Results never depend on the number of threads: every loop below writes
// to places of its own, and sums over things are taken in the order of the things.

#include <omp.h>

#include "base/types.hpp"

namespace nereid {

inline void use_threads(int count) { omp_set_num_threads(count); }
inline int threads() { return omp_get_max_threads(); }

/// Calls body(i) for i in [0, count), shared out among the threads in contiguous ranges.
///
/// grain  calls that are worth a thread of their own; fewer than two grains run on the caller's
template <class Body>
void parallel_for(Index count, Index grain, Body&& body) {
#pragma omp parallel for schedule(static) if (count >= 2 * grain)
  for (Index i = 0; i < count; ++i) body(i);
}

}  // namespace nereid
