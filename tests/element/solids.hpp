#pragma once
// What every solid element must do, over all laws; hexahedron_test.cpp and full_hexahedron_test.cpp ask it of their kinds.

#include <string>

#include "tests/element/corners.hpp"

namespace nereid::element {

template <class Kind_, class Law_>
struct Solid {
  using Kind = Kind_;
  using Law = Law_;
};
template <class Kind, class List>
struct WithEachLaw;
template <class Kind, class... Laws>
struct WithEachLaw<Kind, ::testing::Types<Laws...>> {
  using type = ::testing::Types<Solid<Kind, Laws>...>;
};

/// The one-point element with its own bending stiffness.
struct AssumedStrain : Hexahedron {};

constexpr auto springs = Hexahedron::Hourglass::stiffness;

inline Hexahedron::Options usual_of(Hexahedron) {
  return {.hourglass = Hexahedron::usual_stiffness, .viscosity = {}, .hourglass_kind = springs};
}
inline Hexahedron::Options usual_of(AssumedStrain) { return {}; }
inline FullHexahedron::Options usual_of(FullHexahedron) { return {}; }

/// Options without viscosity, and with hourglass springs that show.
inline Hexahedron::Options inviscid_of(AssumedStrain) { return {.viscosity = no_viscosity}; }
inline Hexahedron::Options inviscid_of(Hexahedron) { return {.hourglass = 0.4, .viscosity = no_viscosity, .hourglass_kind = springs}; }
inline FullHexahedron::Options inviscid_of(FullHexahedron) { return {.viscosity = no_viscosity}; }

/// What round-off leaves of an elastic energy that is zero, and of what is remembered after a rotation, by the size of the stress.
inline double energy_round_off(Hexahedron) { return 1e-16; }
inline double energy_round_off(FullHexahedron) { return 1e-15; }
inline double flow_round_off(Hexahedron) { return 0; }
inline double flow_round_off(AssumedStrain) { return 1e-19; }   // of what they store
inline double flow_round_off(FullHexahedron) { return 1e-17; }  // the strain across its planes does work of second order
inline double memory_round_off(Hexahedron, double stress) { return 1e-12 * stress; }
inline double memory_round_off(FullHexahedron, double) { return 1e-13; }

template <std::size_t count>
double total(const std::array<double, count>& channels) {
  double sum = 0;
  for (const double channel : channels) sum += channel;
  return sum;
}
template <std::size_t count>
double total_size(const std::array<double, count>& channels) {
  double sum = 0;
  for (const double channel : channels) sum += std::abs(channel);
  return sum;
}

template <class Of>
class EverySolid : public ::testing::Test {
 protected:
  using Kind = typename Of::Kind;
  using Law = typename Of::Law;
  using One = OneElement<Kind, Law>;
  static One usual(const Corners& X) { return {metal<Law>(), usual_of(Kind{}), X}; }
  static One inviscid(const Corners& X) { return {metal<Law>(), inviscid_of(Kind{}), X}; }
};
TYPED_TEST_SUITE_P(EverySolid);

TYPED_TEST_P(EverySolid, RigidRotationByAFiniteAngleTurnsStressAndNothingElse) {
  for (int trial = 0; trial < 20; ++trial) {
    auto e = this->usual(distorted(0.2));
    e.randomise(0.005);
    const auto before = e;
    const Mat3 Q = random_rotation(2.0);
    Corners to = times(Q, e.X);
    for (Point& p : to) p = p + Point{0.3, -0.2, 0.1};
    const double size = this->usual(e.X).step(e.X, Corners{}, 1.0).volume_ratio;
    const auto report = e.move(to);
    EXPECT_LT(difference_of_memory(e, before, Q), 1e-13);
    EXPECT_NEAR(report[Stored::elastic], 0, energy_round_off(typename TypeParam::Kind{}));
    EXPECT_NEAR(report[Stored::hourglass], 0, 1e-15);
    EXPECT_NEAR(report[Dissipated::plastic], 0, flow_round_off(typename TypeParam::Kind{}));
    EXPECT_NEAR(report[Dissipated::viscous], 0, 1e-16);
    EXPECT_NEAR(report.volume_ratio, size, 1e-14);
  }
}

TYPED_TEST_P(EverySolid, TenTurnsKeepStressInTheBodyFrameAndTheStoredEnergy) {
  for (const int steps_per_turn : {100, 1000}) {
    auto e = this->usual(distorted(0.2));
    e.move(sum(e.X, random_field(1e-3)));  // prestress and hourglass
    const auto start = e;
    const Corners at_start = e.x, force = (e.rest(), e.force);
    const Vec3 axis = Vec3(0.3, -0.5, 0.8).normalized();
    double stored = 0, size = 0;
    for (const auto* s : stresses(e.memory)) size = std::max(size, full(*s).norm());
    Mat3 R;
    for (int step = 1; step <= 10 * steps_per_turn; ++step) {
      R = Eigen::AngleAxisd(2 * pi * (step % steps_per_turn) / steps_per_turn, axis).toRotationMatrix();
      stored += total_size(e.move(times(R, at_start)).stored);
    }
    const double drift = difference_of_memory(e, start, R) / size;
    ::testing::Test::RecordProperty("drift_of_stress_" + std::to_string(steps_per_turn), std::to_string(drift * 1e12) + "e-12");
    EXPECT_LT(drift, 1e-10 * 10);
    EXPECT_LT(largest(sum(e.force, times(R, force), -1.0)), 1e-10 * largest(force));
    EXPECT_LT(stored, 1e-8 * size * size / e.law.young);  // 1/2 s : C^-1 : s is about size^2 / E
  }
}

TYPED_TEST_P(EverySolid, ForcesHaveNoNetForceAndNoNetMoment) {
  for (int trial = 0; trial < 50; ++trial) {
    auto e = this->usual(distorted(0.2));
    e.randomise(0.01);
    e.step(distorted(0.2), random_field(1e-2), 0.05);
    Point force{}, moment{};
    for (int i = 0; i < 8; ++i) force = force + e.force[i], moment = moment + cross(e.x[i], e.force[i]);
    EXPECT_LT(norm(force), 1e-14 * 10 * largest(e.force));
    EXPECT_LT(norm(moment), 1e-14 * 10 * largest(e.force));
  }
}

TYPED_TEST_P(EverySolid, ForceIsTheGradientOfTheStoredEnergy) {
  for (int trial = 0; trial < 10; ++trial) {
    const Corners X = distorted(0.2), u = random_field(1e-5), direction = random_field(1e-6);
    const auto stored = [&](const Corners& displacement) {
      auto e = this->inviscid(X);
      const auto report = e.move(sum(X, displacement));
      EXPECT_GT(report.stored[0], 0);
      EXPECT_EQ(report[Stored::distortion], 0);
      return total(report.stored);
    };
    auto e = this->inviscid(X);
    e.move(sum(X, u));
    const double change = stored(sum(u, direction)) - stored(sum(u, direction, -1.0));
    EXPECT_NEAR(-2.0 * product(e.force, direction), change,
                1e-4 * 2 * std::sqrt(product(e.force, e.force) * product(direction, direction)));
  }
}

TYPED_TEST_P(EverySolid, AdvanceIsFrameIndifferent) {
  for (int trial = 0; trial < 20; ++trial) {
    auto e = this->usual(distorted(0.2));
    e.randomise(0.02);
    const Mat3 R = random_rotation();
    auto turned = e;
    turned.X = times(R, e.X);
    turned.turn(R);
    const Corners to = sum(e.X, random_field(0.1)), du = random_field(0.05);
    const auto report = e.step(to, du, 0.1), same = turned.step(times(R, to), times(R, du), 0.1);
    EXPECT_LT(difference_of_memory(turned, e, R), memory_round_off(typename TypeParam::Kind{}, full(*stresses(e.memory)[0]).norm()));
    EXPECT_LT(largest(sum(turned.force, times(R, e.force), -1.0)), 1e-12 * largest(e.force));
    for (std::size_t c = 0; c < report.stored.size(); ++c) EXPECT_NEAR(same.stored[c], report.stored[c], 1e-13);
    for (std::size_t c = 0; c < report.dissipated.size(); ++c) EXPECT_NEAR(same.dissipated[c], report.dissipated[c], 1e-13);
    EXPECT_NEAR(same.step, report.step, 1e-12 * report.step);
    EXPECT_NEAR(same.volume_ratio, report.volume_ratio, 1e-13);
  }
}

TYPED_TEST_P(EverySolid, PacksAndDoublesAgree) {
  using K = typename TypeParam::Kind;
  using L = typename TypeParam::Law;
  std::vector<OneElement<K, L>> one;
  std::array<Corners, lanes> to, dx;
  std::array<Vector<Pack>, 8> xs, dxs, fs;
  typename K::template Constants<Pack> constants;
  typename K::template Memory<Pack, L> memory;
  const auto rows_of = [](auto& kept, const auto&... options) {
    std::vector<double> rows;
    kept.each_row([&](double& row) { rows.push_back(row); }, options...);
    return rows;
  };
  for (int l = 0; l < lanes; ++l) {
    one.push_back(this->usual(distorted(0.2)));
    one[l].randomise(0.02);
    to[l] = sum(one[l].X, random_field(0.1)), dx[l] = random_field(0.05);
    for (int i = 0; i < 24; ++i) {
      (&xs[i / 3].x)[i % 3][l] = to[l][i / 3][i % 3];
      (&dxs[i / 3].x)[i % 3][l] = dx[l][i / 3][i % 3];
    }
    const auto of_constants = rows_of(one[l].constants), of_memory = rows_of(one[l].memory, one[l].options);
    std::size_t c = 0, r = 0;
    constants.each_row([&](Pack& row) { row[l] = of_constants[c++]; });
    memory.each_row([&](Pack& row) { row[l] = of_memory[r++]; }, one[l].options);
    EXPECT_EQ(c, (K::template Constants<double>::rows));
    EXPECT_EQ(static_cast<int>(r), (K::template Memory<double, L>::rows(one[l].options)));
  }
  const auto all = advance(one[0].law, one[0].options, constants, {Pack(1.0), Pack(1.0), Pack(1.0)}, xs, dxs, Pack(0.1), memory, fs);
  for (int l = 0; l < lanes; ++l) {
    auto& e = one[l];
    const auto report = e.step(to[l], dx[l], 0.1);
    for (int i = 0; i < 24; ++i) EXPECT_NEAR((&fs[i / 3].x)[i % 3][l], e.force[i / 3][i % 3], 1e-13 * largest(e.force));
    EXPECT_NEAR(all.step[l], report.step, 1e-13 * report.step);
    EXPECT_NEAR(all.volume_ratio[l], report.volume_ratio, 1e-13);
    for (std::size_t c = 0; c < report.stored.size(); ++c) EXPECT_NEAR(all.stored[c][l], report.stored[c], 1e-13);
    for (std::size_t c = 0; c < report.dissipated.size(); ++c) EXPECT_NEAR(all.dissipated[c][l], report.dissipated[c], 1e-13);
    const auto rows = rows_of(e.memory, e.options);
    std::size_t r = 0;
    memory.each_row([&](Pack& row) {
      EXPECT_NEAR(row[l], rows[r], 1e-13 * std::max(1.0, std::abs(rows[r])));
      ++r;
    }, e.options);
  }
}

TYPED_TEST_P(EverySolid, WorkAndStoredEnergyDifferInTheThirdOrderOfTheStep) {
  double squares[2] = {0, 0};  // of a long and of a short step, over elements of any shape: in one the third order may be nearly none
  for (int trial = 0; trial < 20; ++trial) {
    auto start = this->inviscid(distorted(0.2));
    start.randomise(0.003);
    start.rest();
    const Corners direction = random_field(1.0);
    const auto error = [&](double s) {
      auto e = start;
      Corners du;
      for (int i = 0; i < 8; ++i) du[i] = s * direction[i];
      const auto report = e.move(sum(e.x, du));
      const double work = 0.5 * (product(start.force, du) + product(e.force, du));
      return work + total(report.stored) + report[Dissipated::plastic];
    };
    squares[0] += error(1e-3) * error(1e-3);  // so short that nothing flows: a kink has no order
    squares[1] += error(5e-4) * error(5e-4);
  }
  EXPECT_NEAR(std::sqrt(squares[0] / squares[1]), 8.0, 0.2);
}

TYPED_TEST_P(EverySolid, MassIsDensityTimesVolume) {
  for (int trial = 0; trial < 20; ++trial) {
    const Corners X = distorted(0.3);
    double volume = 0;
    integrate(X, [&](const auto&, double det) { volume += det; });
    EXPECT_NEAR(this->usual(X).constants.mass, 2.0 * volume, 1e-13);
  }
}

REGISTER_TYPED_TEST_SUITE_P(EverySolid, RigidRotationByAFiniteAngleTurnsStressAndNothingElse,
                            TenTurnsKeepStressInTheBodyFrameAndTheStoredEnergy, ForcesHaveNoNetForceAndNoNetMoment,
                            ForceIsTheGradientOfTheStoredEnergy, AdvanceIsFrameIndifferent, PacksAndDoublesAgree,
                            WorkAndStoredEnergyDifferInTheThirdOrderOfTheStep, MassIsDensityTimesVolume);

}  // namespace nereid::element
