#pragma once
#include "base/types.hpp"

namespace nereid {

/// The largest step that one source of force allows, and where in it.
struct StepLimit {
  double step = 1e300;  ///< [s]; 1e300: no limit
  Index at = -1;        ///< element of a block, node of an apex or of a plane; -1: nowhere in particular
};

}  // namespace nereid
