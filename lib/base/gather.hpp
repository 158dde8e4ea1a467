#pragma once
// Packs of what lies apart in memory. Built in registers: a detour over memory would read a pack that was just written in pieces, and
// wait for it.

#include "base/tensor.hpp"
#include "base/types.hpp"

namespace nereid {

/// One vector for each lane.
///
/// vector  [3 x things], column-major
NEREID_HOT Vector<Pack> gather(const double* vector, const Index* column) {
  const auto component = [&](int axis) {
    return Pack([&](auto lane) { return vector[3 * column[static_cast<int>(lane)] + axis]; });
  };
  return {component(0), component(1), component(2)};
}

/// One number for each lane, from the places of a table.
NEREID_HOT Pack gather_numbers(const double* table, const Index* place) {
  return Pack([&](auto lane) { return table[place[static_cast<int>(lane)]]; });
}

}  // namespace nereid
