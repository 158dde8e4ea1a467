#pragma once
// The closed list of laws. Blocks, kernels, readers and tests follow from it.

#include <variant>

#include "material/elastic.hpp"
#include "material/ideal_gas.hpp"
#include "material/j2_bilinear.hpp"
#include "material/j2_curve.hpp"
#include "material/j2_mixed.hpp"
#include "material/johnson_cook.hpp"
#include "material/linear_fluid.hpp"
#include "material/mie_gruneisen.hpp"
#include "material/neo_hookean.hpp"

namespace nereid::material {

/// Every law.
using AnyLaw = std::variant<Elastic, J2Bilinear, J2Mixed, J2JohnsonCook, J2Curve, NeoHookean, LinearFluid, MieGruneisen, IdealGas>;

/// Young's modulus, of a fluid the bulk modulus at the start. [Pa]
inline double stiffness(const AnyLaw& any) {
  return std::visit(
      []<class Law>(const Law& law) -> double {
        if constexpr (FluidLaw<Law>) return bulk_modulus_at_start(law);
        else return law.young;
      },
      any);
}

/// Whether a law is one of fluids.
inline bool is_fluid(const AnyLaw& any) {
  return std::visit([]<class Law>(const Law&) { return FluidLaw<Law>; }, any);
}

}  // namespace nereid::material
