#pragma once
// One metal for every law, of modulus 3 and density 2, that yields at a hundredth of its modulus.

#include "tests/material/point.hpp"

namespace nereid::element {

inline void make_metal(double poisson, material::Elastic& law) { law = {2.0, 3.0, poisson}; }
inline void make_metal(double poisson, material::NeoHookean& law) { law = {2.0, 3.0, poisson}; }
inline void make_metal(double poisson, material::J2Bilinear& law) { law = {2.0, 3.0, poisson, {0.03, 0.3}}; }
inline void make_metal(double poisson, material::J2Mixed& law) { law = {2.0, 3.0, poisson, 0.03, 0.3, 0.25}; }
inline void make_metal(double poisson, material::J2JohnsonCook& law) {
  law = {2.0, 3.0, poisson,
         {.yield = 0.03, .hardening = 0.1, .hardening_exponent = 0.5, .rate_coefficient = 0.02, .reference_rate = 1e-2,
          .thermal_exponent = 1, .reference_temperature = 300, .melting_temperature = 1500, .specific_heat = 1e-5,
          .heat_share = 0.9, .temperature = 300}};
}

inline void make_metal(double poisson, material::J2Curve& law) {
  law = {2.0, 3.0, poisson, {}};
  law.flow.kind = material::HardeningCurve::Kind::voce;
  law.flow.yield = 0.03, law.flow.growth = 0.03, law.flow.exponent = 5, law.flow.cowper_rate = 10, law.flow.cowper_exponent = 5;
}

// And one fluid for each of its laws, about as stiff.
inline void make_metal(double /*poisson*/, material::LinearFluid& law) { law = {2.0, 3.0}; }
inline void make_metal(double /*poisson*/, material::MieGruneisen& law) { law = {2.0, 1.2, 1.75, 0.28}; }
inline void make_metal(double /*poisson*/, material::IdealGas& law) { law = {2.0, 1.4, 0.3}; }

template <class Law>
Law metal(double poisson = 0.3) {
  Law law;
  make_metal(poisson, law);
  return law;
}

}  // namespace nereid::element
