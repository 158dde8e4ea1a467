#pragma once
#include <array>

namespace nereid::element {

/// What one update of an element has to report.
template <class T>
struct Report {
  std::array<T, 2> stored;  ///< [J] increments, in the order of Kind::stored; zero where a kind has fewer
  T plastic, viscous, hourglass;  ///< [J] dissipated in this step
  T step;                   ///< [s] largest stable step of this element as it is now
  T size;                   ///< [-] volume (plates: area) over that of the reference; <= 0: inverted
};

}  // namespace nereid::element
