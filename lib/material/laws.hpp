#pragma once
// The closed list of laws. Blocks, kernels, readers and tests follow from it.

#include <variant>

#include "material/elastic.hpp"
#include "material/j2_bilinear.hpp"
#include "material/j2_mixed.hpp"
#include "material/johnson_cook.hpp"
#include "material/neo_hookean.hpp"

namespace nereid::material {

/// Every law.
using AnyLaw = std::variant<Elastic, J2Bilinear, J2Mixed, J2JohnsonCook, NeoHookean>;

}  // namespace nereid::material
