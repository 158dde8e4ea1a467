#pragma once
// What a point remembers before anything has happened to it.

#include "material/law.hpp"

namespace nereid::material {

/// All zeros, for the law L and a point with this kind of stress.
template <class L, template <class> class S, class T>
Internal<T, L, S> fresh(const S<T>&) {
  return {};
}

}  // namespace nereid::material
