// What every law must do, over the whole list of laws, in space and in the plane of a plate.

#include "material/law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "base/dual.hpp"
#include "tests/base/chance.hpp"
#include "tests/material/point.hpp"

namespace nereid::material::law_test {
namespace {

// -- Materials: Table II of Kulak & Fiala (NEPTUNE) ----------------------------------------------

constexpr double kgf_per_mm2 = 9.80665e6;  // [Pa]
struct Row {
  double density, young, poisson, yield, tangent;  // [kg/m3] [kgf/mm2] [-] [kgf/mm2] [kgf/mm2]
  double isotropic;  // [-] where the law has a share; not in the table
};
constexpr Row lead{11340.0, 19.5, 0.42, 3.02, 1.85, 0.0}, steel{7800.0, 1.96e4, 0.33, 31.6, 195.0, 0.35};

void make(const Row& row, Elastic& law) {
  law = {row.density, row.young * kgf_per_mm2, row.poisson};
}
void make(const Row& row, J2Bilinear& law) {
  law = {row.density, row.young * kgf_per_mm2, row.poisson, {row.yield * kgf_per_mm2, row.tangent * kgf_per_mm2}};
}
void make(const Row& row, J2Mixed& law) {
  J2Bilinear same{};
  make(row, same);
  law = {same.density, same.young, same.poisson, same.flow.yield, same.flow.tangent, row.isotropic};
}
/// Without heat, so that a slow load has a curve of stress over strain.
void make(const Row& row, J2JohnsonCook& law) {
  law = {row.density, row.young * kgf_per_mm2, row.poisson,
         {.yield = row.yield * kgf_per_mm2, .hardening = row.tangent * kgf_per_mm2, .hardening_exponent = 0.5,
          .rate_coefficient = 0.02, .reference_rate = 1, .thermal_exponent = 1, .reference_temperature = 300,
          .melting_temperature = 1500, .specific_heat = 450, .heat_share = 0, .temperature = 300}};
}
/// The bilinear law as a table, to forty times the strains of interest.
J2Bilinear same_as(const J2Curve& law) {
  const MeasuredCurve& curve = law.flow.curves.at(0);
  const double hardening = (curve.stress[1] - curve.stress[0]) / curve.strain[1];
  return {law.density, law.young, law.poisson, {curve.stress[0], law.young * hardening / (law.young + hardening)}};
}
void make(const Row& row, J2Curve& law) {
  J2Bilinear same{};
  make(row, same);
  const double yield = same.flow.yield, far = 1e4 * yield / same.young, H = hardening_modulus(same);
  law = {same.density, same.young, same.poisson, {}};
  law.flow.kind = HardeningCurve::Kind::measured;
  law.flow.curves = {{0, {0, 0.3 * far, far}, {yield, yield + 0.3 * H * far, yield + H * far}}};
}
/// Under a load that only grows, the share of the hardening that is isotropic makes no difference.
J2Bilinear under_growing_load(const J2Mixed& law) {
  return {law.density, law.young, law.poisson, {law.yield, law.tangent}};
}

/// Stress that a curve with a kink at `limit` reaches: slope `before` up to it, `after` beyond.
double bilinear(double strain, double limit, double before, double after) {
  const double stress = before * strain;
  return stress < limit ? stress : limit + after * (strain - limit / before);
}
// The exact answers of each law, to a strain that grows from zero.
double uniaxial_stress(const Elastic& law, double strain) { return law.young * strain; }
double uniaxial_stress(const J2Bilinear& law, double strain) {
  return bilinear(strain, law.flow.yield, law.young, law.flow.tangent);
}
double uniaxial_stress(const J2Mixed& law, double strain) {
  return uniaxial_stress(under_growing_load(law), strain);
}
double uniaxial_strain(const Elastic& law, double strain) {
  return (bulk_modulus(law) + 4.0 / 3.0 * shear_modulus(law)) * strain;
}
double uniaxial_strain(const J2Bilinear& law, double strain) {
  const double K = bulk_modulus(law), G = shear_modulus(law), H = hardening_modulus(law);
  const double elastic = K + 4.0 / 3.0 * G;
  return bilinear(strain, elastic * law.flow.yield / (2.0 * G), elastic,
                  K + 4.0 / 3.0 * G * H / (H + 3.0 * G));
}
double uniaxial_stress(const J2Curve& law, double strain) { return uniaxial_stress(same_as(law), strain); }
double uniaxial_strain(const J2Curve& law, double strain) { return uniaxial_strain(same_as(law), strain); }
double uniaxial_strain(const J2Mixed& law, double strain) {
  return uniaxial_strain(under_growing_load(law), strain);
}
double shear(const Elastic& law, double angle) { return shear_modulus(law) * angle; }
double shear(const J2Bilinear& law, double angle) {
  const double G = shear_modulus(law), H = hardening_modulus(law);
  return bilinear(angle, law.flow.yield / std::sqrt(3.0), G, 1.0 / (1.0 / G + 3.0 / H));
}
double shear(const J2Curve& law, double angle) { return shear(same_as(law), angle); }
double shear(const J2Mixed& law, double angle) { return shear(under_growing_load(law), angle); }
/// Flow of a slow load without heat: the root p of  a - b p = A + B p^n, found by halving.
double flow_under(const J2JohnsonCook& law, double a, double b) {
  double low = 0.0, high = a / b;
  for (int i = 0; i < 200; ++i) {
    const double p = 0.5 * (low + high);
    (a - b * p > law.flow.yield + law.flow.hardening * std::pow(p, law.flow.hardening_exponent) ? low : high) = p;
  }
  return a > law.flow.yield ? low : 0.0;
}
double uniaxial_stress(const J2JohnsonCook& law, double strain) {
  return law.young * (strain - flow_under(law, law.young * strain, law.young));
}
double uniaxial_strain(const J2JohnsonCook& law, double strain) {
  const double G = shear_modulus(law), p = flow_under(law, 2.0 * G * strain, 3.0 * G);
  return bulk_modulus(law) * strain + 2.0 * G * (2.0 / 3.0 * strain - p);
}
double shear(const J2JohnsonCook& law, double angle) {
  const double G = shear_modulus(law);
  return G * (angle - std::sqrt(3.0) * flow_under(law, std::sqrt(3.0) * G * angle, 3.0 * G));
}
/// A strain of the size of interest.
double unit(const Elastic&) { return 1e-5; }  // the logarithmic rate is no different there
double unit(const J2Bilinear& law) { return law.flow.yield / law.young; }
double unit(const J2JohnsonCook& law) { return law.flow.yield / law.young; }
double unit(const J2Curve& law) { return law.flow.curves[0].stress[0] / law.young; }
double unit(const J2Mixed& law) { return law.yield / law.young; }
/// How far from the centre of its elastic range, in uniaxial stress, a point with this memory flows next; without
/// flow, more than any.
template <template <class> class S>
double flow_stress(const Elastic& law, const Internal<double, Elastic, S>&) {
  return law.young;
}
template <template <class> class S>
double flow_stress(const J2Bilinear& law, const Internal<double, J2Bilinear, S>& internal) {
  return yield_stress(law, internal.scalar[0]);
}
template <template <class> class S>
double flow_stress(const J2JohnsonCook& law, const Internal<double, J2JohnsonCook, S>& internal) {
  return yield_stress(law, internal.scalar);
}
template <template <class> class S>
double flow_stress(const J2Curve& law, const Internal<double, J2Curve, S>& internal) {
  return yield_stress(law, internal.scalar);
}
template <template <class> class S>
double flow_stress(const J2Mixed& law, const Internal<double, J2Mixed, S>& internal) {
  return yield_stress(law, internal.scalar[0]);
}
/// That centre. [Pa]
template <class L, template <class> class S>
double centre_of_range(const Internal<double, L, S>&) {
  return 0.0;
}
template <template <class> class S>
double centre_of_range(const Internal<double, J2Mixed, S>& internal) {
  return 1.5 * internal.tensor[0].xx;  // the back stress is the deviator of a uniaxial stress
}
/// What the law stores besides the elastic energy of the stress, per volume. [J/m3]
template <class L, template <class> class S>
double stored_besides(const L&, const Internal<double, L, S>&) {
  return 0.0;
}
template <template <class> class S>
double stored_besides(const J2Mixed& law, const Internal<double, J2Mixed, S>& internal) {
  const double q = von_mises(surface_centre(internal.tensor[0]));
  return q * q / (2.0 * hardening_moduli(law).kinematic);  // 3/(4 H_k) a : a with q^2 = 3/2 a : a
}

// -- Random strains ------------------------------------------------------------------------------

Chance64 random_source(11);
double draw(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_source);
}
template <class S>
S draw_strain(double size) {
  S strain{};
  for (double* c : components(strain)) *c = draw(-size, size);
  return strain;
}
/// From far below yield to far beyond.
double draw_size() { return std::pow(10.0, draw(-8.0, 1.0)); }

template <class L>
class EveryLaw : public ::testing::Test {
 protected:
  EveryLaw() : laws(2) {
    make(lead, laws[0]);
    make(steel, laws[1]);
  }
  std::vector<L> laws;
};
TYPED_TEST_SUITE(EveryLaw, LawsInRates);
template <class L>
class EveryPlateLaw : public EveryLaw<L> {};
TYPED_TEST_SUITE(EveryPlateLaw, PlateLaws);

// -- Known answers
// ----------------------------------------------------------------------------------

TYPED_TEST(EveryLaw, FollowsTheTableInUniaxialStress) {
  const auto run = [](const TypeParam& law, auto stress, int steps) {
    auto internal = fresh<TypeParam>(stress);
    const double step = 5.0 * unit(law) / steps;
    for (int i = 1; i <= steps; ++i) {
      stretch(law, step, stress, internal);
      const double exact = uniaxial_stress(law, i * step);
      ASSERT_NEAR(stress.xx / exact, 1.0, 1e-12);
      ASSERT_NEAR(stress.yy / exact, 0.0, 1e-12);
    }
  };
  for (const auto& law : this->laws)
    for (const int steps : {1, 3, 200}) {
      run(law, Symmetric<double>{}, steps);
      if constexpr (PlateLaw<TypeParam>) run(law, Plane<double>{}, steps);
    }
}

TYPED_TEST(EveryLaw, FollowsTheExactCurveInUniaxialStrain) {
  for (const auto& law : this->laws)
    for (const int steps : {1, 3, 200}) {
      Symmetric<double> stress{};
      auto internal = fresh<TypeParam>(stress);
      const double step = 5.0 * unit(law) / steps;
      for (int i = 1; i <= steps; ++i) {
        strain_by(law, Symmetric<double>{step, 0, 0, 0, 0, 0}, stress, internal);
        ASSERT_NEAR(stress.xx / uniaxial_strain(law, i * step), 1.0, 1e-12);
      }
    }
}

TYPED_TEST(EveryLaw, FollowsTheExactCurveInShear) {
  const auto run = [](const TypeParam& law, auto stress, int steps) {
    auto internal = fresh<TypeParam>(stress);
    decltype(stress) strain{};
    strain.xy = 0.5 * 5.0 * unit(law) / steps;  // half the angle
    for (int i = 1; i <= steps; ++i) {
      strain_by(law, strain, stress, internal);
      ASSERT_NEAR(stress.xy / shear(law, i * 2.0 * strain.xy), 1.0, 1e-12);
    }
  };
  for (const auto& law : this->laws)
    for (const int steps : {1, 3, 200}) {
      run(law, Symmetric<double>{}, steps);
      if constexpr (PlateLaw<TypeParam>) run(law, Plane<double>{}, steps);
    }
}

TEST(LawOfTableII, HasTheShearYieldAndShearTangentOfTheCatalogue) {
  // Catalogue M-2, in kgf/mm2, five printed decimals; driven, not from the formula.
  const auto slope = [](const Row& row, double& at_yield) {
    J2Bilinear law{};
    make(row, law);
    Symmetric<double> stress{};
    auto internal = fresh<J2Bilinear>(stress);
    const double angle = 10.0 * unit(law);
    strain_by(law, Symmetric<double>{0, 0, 0, 0.5 * angle, 0, 0}, stress, internal);
    const double first = stress.xy;
    strain_by(law, Symmetric<double>{0, 0, 0, 0.5 * angle, 0, 0}, stress, internal);
    const double tangent = (stress.xy - first) / angle, G = shear_modulus(law);
    at_yield = (first - tangent * angle) / (1.0 - tangent / G) / kgf_per_mm2;
    return tangent / kgf_per_mm2;
  };
  double at_yield = 0.0;
  EXPECT_NEAR(slope(lead, at_yield), 0.61980, 5e-6);
  EXPECT_NEAR(at_yield, 1.74360, 5e-6);
  EXPECT_NEAR(slope(steel, at_yield), 65.07337, 5e-6);
  EXPECT_NEAR(at_yield, 18.24427, 5e-6);
}

TYPED_TEST(EveryLaw, FlowsWhereItsElasticRangeEndsInCyclesOfTensionAndCompression) {
  // Each half cycle: up to the end of the range as the last flow left it the answer is elastic, and
  // beyond it the law flows again (+-3 yield strains). With isotropic hardening the range is centred
  // at zero, so that the end is minus the largest stress so far.
  const auto run = [](const TypeParam& law, auto stress) {
    auto internal = fresh<TypeParam>(stress);
    double at = 0.0;
    for (const double target : {3.0, -3.0, 3.0, -3.0}) {
      const double range = flow_stress(law, internal), centre = centre_of_range(internal);
      const double start = stress.xx;
      const int steps = 600;
      const double step = (target * unit(law) - at) / steps;
      for (int i = 1; i <= steps; ++i) {
        stretch(law, step, stress, internal);
        const double elastic = start + law.young * i * step;
        if (std::abs(elastic - centre) < range * (1.0 + 1e-12)) {  // round-off may touch the limit
          ASSERT_NEAR(stress.xx, elastic, 1e-10 * range);
        } else {
          ASSERT_GT(std::abs(stress.xx - centre), range);
          ASSERT_LT(std::abs(stress.xx - centre), std::abs(elastic - centre));
          ASSERT_NEAR(std::abs(stress.xx - centre_of_range(internal)), flow_stress(law, internal), 1e-10 * range);
        }
      }
      at = target * unit(law);
    }
  };
  for (const auto& law : this->laws) {
    run(law, Symmetric<double>{});
    if constexpr (PlateLaw<TypeParam>) run(law, Plane<double>{});
  }
}

// -- Work
// ----------------------------------------------------------------------------------------------

TYPED_TEST(EveryLaw, GivesBackAllWorkOfAClosedElasticCycle) {
  const auto run = [](const TypeParam& law, auto stress) {
    using S = decltype(stress);
    auto internal = fresh<TypeParam>(stress);
    S sum{};
    double stored = 0.0, most = 0.0, dissipated = 0.0;
    for (int i = 0; i < 20; ++i) {
      S strain = draw_strain<S>(0.02 * unit(law));
      if (i == 19) strain = -1.0 * sum;
      sum = sum + strain;
      const Work<double> work = strain_by(law, strain, stress, internal);
      stored += work.stored;
      dissipated += work.dissipated;
      most = std::max(most, stored);
    }
    EXPECT_LT(std::abs(stored), 1e-13 * most);
    EXPECT_EQ(dissipated, 0.0);
    EXPECT_LT(largest(stress), 1e-14 * law.young * unit(law));
  };
  for (const auto& law : this->laws)
    for (int cycle = 0; cycle < 50; ++cycle) {
      run(law, Symmetric<double>{});
      if constexpr (PlateLaw<TypeParam>) run(law, Plane<double>{});
    }
}

TYPED_TEST(EveryLaw, SplitsTheWorkOfRandomHistoriesAndNeverDissipatesLessThanNothing) {
  const auto run = [](const TypeParam& law, auto stress) {
    using S = decltype(stress);
    auto internal = fresh<TypeParam>(stress);
    for (int i = 0; i < 100; ++i) {
      const S strain = draw_strain<S>(draw_size() * unit(law));
      const S old = stress;
      const Work<double> work = strain_by(law, strain, stress, internal);
      const double total = 0.5 * contract(old + stress, strain);
      const double size = largest(old + stress) * largest(strain);
      ASSERT_GE(work.dissipated, 0.0);
      ASSERT_NEAR(work.stored + work.dissipated, total, 1e-14 * size);
    }
  };
  for (const auto& law : this->laws)
    for (int history = 0; history < 100; ++history) {
      run(law, Symmetric<double>{});
      if constexpr (PlateLaw<TypeParam>) run(law, Plane<double>{});
    }
}

TYPED_TEST(EveryLaw, StoresTheElasticEnergyOfTheStressAndThatOfItsTensors) {
  // 1/2 s : C^-1 : s, with zz = 0 in the plane, and what the law stores besides.
  const auto run = [](const TypeParam& law, auto stress, auto pressure_of) {
    using S = decltype(stress);
    auto internal = fresh<TypeParam>(stress);
    double stored = 0.0, turned_over = 0.0;
    for (int i = 0; i < 50; ++i) {
      const Work<double> work = strain_by(law, draw_strain<S>(draw_size() * unit(law)), stress, internal);
      stored += work.stored;
      turned_over += std::abs(work.stored) + work.dissipated;
    }
    const double q = von_mises(stress), p = pressure_of(stress);
    EXPECT_NEAR(stored, q * q / (6.0 * shear_modulus(law)) + p * p / (2.0 * bulk_modulus(law)) + stored_besides(law, internal),
                1e-13 * turned_over);
  };
  for (const auto& law : this->laws)
    for (int history = 0; history < 50; ++history) {
      run(law, Symmetric<double>{}, [](const Symmetric<double>& s) { return pressure(s); });
      if constexpr (PlateLaw<TypeParam>) run(law, Plane<double>{}, [](const Plane<double>& s) { return -(s.xx + s.yy) / 3.0; });
    }
}

// -- Frames
// ------------------------------------------------------------------------------------------

TYPED_TEST(EveryLaw, DoesNotCareHowTheFrameIsTurned) {
  double worst = 0.0;
  for (const auto& law : this->laws)
    for (int sample = 0; sample < 300; ++sample) {
      const Matrix<double> Q =
          cayley_rotation(Vector<double>{draw(-3, 3), draw(-3, 3), draw(-3, 3)});
      Symmetric<double> stress{}, turned{};
      auto internal = fresh<TypeParam>(stress), turned_internal = internal;
      for (int i = 0; i < 5; ++i) {
        const auto strain = draw_strain<Symmetric<double>>(draw_size() * unit(law));
        const Work<double> work = strain_by(law, strain, stress, internal);
        const Work<double> again = strain_by(law, rotate(Q, strain), turned, turned_internal);
        worst = std::max(worst, largest(rotate(Q, stress) - turned) / largest(stress));
        const double size = largest(stress) * unit(law);
        EXPECT_NEAR(work.dissipated, again.dissipated, 1e-12 * std::max(work.dissipated, size));
      }
      for (std::size_t i = 0; i < internal.scalar.size(); ++i)
        worst = std::max(worst, std::abs(internal.scalar[i] - turned_internal.scalar[i]) / unit(law));
      for (std::size_t i = 0; i < internal.tensor.size(); ++i)
        worst = std::max(worst, largest(rotate(Q, internal.tensor[i]) - turned_internal.tensor[i]) / largest(stress));
    }
  EXPECT_LT(worst, 1e-12);
}

TYPED_TEST(EveryPlateLaw, DoesNotCareHowThePlateIsTurnedInItsPlane) {
  const auto turn = [](double angle, const Plane<double>& a) {
    const double c = std::cos(angle), s = std::sin(angle);
    return Plane<double>{c * c * a.xx + s * s * a.yy - 2.0 * c * s * a.xy,
                         s * s * a.xx + c * c * a.yy + 2.0 * c * s * a.xy,
                         c * s * (a.xx - a.yy) + (c * c - s * s) * a.xy};
  };
  double worst = 0.0;
  for (const auto& law : this->laws)
    for (int sample = 0; sample < 300; ++sample) {
      const double angle = draw(-3, 3);
      Plane<double> stress{}, turned{};
      auto internal = fresh<TypeParam>(stress), turned_internal = internal;
      for (int i = 0; i < 5; ++i) {
        const auto strain = draw_strain<Plane<double>>(draw_size() * unit(law));
        strain_by(law, strain, stress, internal);
        strain_by(law, turn(angle, strain), turned, turned_internal);
        worst = std::max(worst, largest(turn(angle, stress) - turned) / largest(stress));
      }
      for (std::size_t i = 0; i < internal.scalar.size(); ++i)
        worst = std::max(worst, std::abs(internal.scalar[i] - turned_internal.scalar[i]) / unit(law));
      for (std::size_t i = 0; i < internal.tensor.size(); ++i)
        worst = std::max(worst, largest(turn(angle, internal.tensor[i]) - turned_internal.tensor[i]) / largest(stress));
    }
  EXPECT_LT(worst, 1e-12);
}

TYPED_TEST(EveryPlateLaw, GivesAPlateTheStressOfSpaceWithoutStressAcross) {
  // Both updates are implicit with the same flow rule, so they agree for any size of step.
  double worst = 0.0, worst_internal = 0.0, worst_work = 0.0;
  for (const auto& law : this->laws)
    for (const double size : {0.05, 1.0, 10.0})
      for (int history = 0; history < 20; ++history) {
        Symmetric<double> space{};
        Plane<double> plane{};
        auto in_space = fresh<TypeParam>(space);
        auto in_plane = fresh<TypeParam>(plane);
        for (int i = 0; i < 100; ++i) {
          const auto strain = draw_strain<Plane<double>>(size * unit(law));
          const Work<double> a = strain_as_plate(law, strain, space, in_space);
          const Work<double> b = strain_by(law, strain, plane, in_plane);
          const double scale = law.young * unit(law);
          const Plane<double> across{space.zz, space.yz, space.xz};
          worst = std::max(worst, largest(across) / scale);
          worst =
              std::max(worst, largest(Plane<double>{space.xx, space.yy, space.xy} - plane) / scale);
          worst_work = std::max(worst_work, std::abs(a.dissipated - b.dissipated) / scale / size);
          worst_work = std::max(worst_work, std::abs(a.stored - b.stored) / scale / size);
        }
        for (std::size_t i = 0; i < in_space.scalar.size(); ++i)
          worst_internal = std::max(worst_internal, std::abs(in_space.scalar[i] - in_plane.scalar[i]) /
                                                        in_plane.scalar[i]);
        for (std::size_t i = 0; i < in_space.tensor.size(); ++i) {
          const Symmetric<double>& a = in_space.tensor[i];
          worst_internal = std::max(worst_internal, largest(Plane<double>{a.xx, a.yy, a.xy} - in_plane.tensor[i]) /
                                                        (law.young * unit(law)));
        }
      }
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(worst_internal, 1e-12);
  EXPECT_LT(worst_work, 1e-12);
}

// -- Number types
// ------------------------------------------------------------------------------------

TYPED_TEST(EveryLaw, GivesAPackWhatItGivesEachOfItsLanes) {
  double worst = 0.0;
  const auto run = [&worst](const TypeParam& law, auto number_stress, auto pack_stress) {
    using S = decltype(number_stress);
    using P = decltype(pack_stress);
    for (int sample = 0; sample < 200; ++sample) {
      std::array<S, lanes> stress{}, strain{};
      std::array<decltype(fresh<TypeParam>(S{})), lanes> internal{};
      for (int i = 0; i < 4; ++i) {
        P pack_strain{};
        auto pack_internal = fresh<TypeParam>(pack_stress);
        std::array<double, lanes> trial{};  // size of what the update subtracts from
        for (int lane = 0; lane < lanes; ++lane) {
          strain[lane] = draw_strain<S>(draw_size() * unit(law));
          trial[lane] = largest(stress[lane]) + largest(hooke(law, strain[lane]));
          for (const S& tensor : internal[lane].tensor) trial[lane] += largest(tensor);
          for (std::size_t c = 0; c < components(pack_strain).size(); ++c) {
            (*components(pack_strain)[c])[lane] = *components(strain[lane])[c];
            (*components(pack_stress)[c])[lane] = *components(stress[lane])[c];
          }
          const auto remembered = rows(internal[lane]);
          std::size_t next = 0;
          pack_internal.each_row([&](Pack& row) { row[lane] = remembered[next++]; });
        }
        const Work<Pack> pack_work = strain_by(law, pack_strain, pack_stress, pack_internal);
        for (int lane = 0; lane < lanes; ++lane) {
          const Work<double> work = strain_by(law, strain[lane], stress[lane], internal[lane]);
          for (std::size_t c = 0; c < components(pack_strain).size(); ++c)
            worst = std::max(worst, std::abs((*components(pack_stress)[c])[lane] -
                                             *components(stress[lane])[c]) /
                                        trial[lane]);
          for (std::size_t c = 0; c < pack_internal.scalar.size(); ++c)
            worst = std::max(worst, std::abs(pack_internal.scalar[c][lane] - internal[lane].scalar[c]) /
                                        std::max(internal[lane].scalar[c], trial[lane] / law.young));
          for (std::size_t t = 0; t < pack_internal.tensor.size(); ++t)
            for (std::size_t c = 0; c < components(pack_strain).size(); ++c)
              worst = std::max(worst, std::abs((*components(pack_internal.tensor[t])[c])[lane] -
                                               *components(internal[lane].tensor[t])[c]) /
                                          trial[lane]);
          // What stress and plastic strain lose to round-off, times the nine terms of a
          // contraction.
          const double size = 9.0 * trial[lane] * (largest(strain[lane]) + trial[lane] / law.young);
          worst = std::max(worst, std::abs(pack_work.stored[lane] - work.stored) / size);
          worst = std::max(worst, std::abs(pack_work.dissipated[lane] - work.dissipated) / size);
        }
      }
    }
  };
  for (const auto& law : this->laws) {
    run(law, Symmetric<double>{}, Symmetric<Pack>{});
    if constexpr (PlateLaw<TypeParam>) run(law, Plane<double>{}, Plane<Pack>{});
  }
  EXPECT_LE(worst, 1e-15);
}

TYPED_TEST(EveryLaw, HasTheTangentOfItsFiniteDifferences) {
  // The algorithmic tangent, within elasticity and within flow, by central differences of 1e-5 of
  // the unit strain: their truncation is 1e-10 and their round-off 1e-11 of the stiffness.
  double worst = 0.0;
  const auto run = [&worst](const TypeParam& law, auto number_stress, auto dual_stress) {
    using S = decltype(number_stress);
    using D = decltype(dual_stress);
    constexpr int n = std::tuple_size_v<decltype(components(number_stress))>;
    for (const double size : {0.05, 2.0, 10.0})
      for (int sample = 0; sample < 50; ++sample) {
        S before{};
        auto memory = fresh<TypeParam>(before);
        strain_by(law, draw_strain<S>(size * unit(law)), before, memory);
        S strain = draw_strain<S>(size * unit(law));

        D dual_strain{};
        for (int i = 0; i < n; ++i) {
          *components(dual_strain)[i] = Dual<n>::variable(*components(strain)[i], i);
          *components(dual_stress)[i] = Dual<n>(*components(before)[i]);
        }
        auto dual_memory = as_dual<n>(memory);
        strain_by(law, dual_strain, dual_stress, dual_memory);

        const double h = 1e-5 * unit(law);
        for (int by = 0; by < n; ++by) {
          S high = strain, low = strain, high_stress = before, low_stress = before;
          auto high_memory = memory, low_memory = memory;
          *components(high)[by] += h;
          *components(low)[by] -= h;
          strain_by(law, high, high_stress, high_memory);
          strain_by(law, low, low_stress, low_memory);
          // A difference across the kink of first flow says nothing.
          if ((rows(high_memory) == rows(memory)) != (rows(low_memory) == rows(memory))) continue;
          for (int i = 0; i < n; ++i) {
            const double slope =
                (*components(high_stress)[i] - *components(low_stress)[i]) / (2 * h);
            worst =
                std::max(worst, std::abs((*components(dual_stress)[i]).by[by] - slope) / law.young);
          }
        }
      }
  };
  for (const auto& law : this->laws) {
    run(law, Symmetric<double>{}, Symmetric<Dual<6>>{});
    if constexpr (PlateLaw<TypeParam>) run(law, Plane<double>{}, Plane<Dual<3>>{});
  }
  EXPECT_LT(worst, 1e-7);
}

}  // namespace
}  // namespace nereid::material::law_test
