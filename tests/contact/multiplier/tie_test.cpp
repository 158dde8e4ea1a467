#include "contact/multiplier/tie.hpp"

#include <Eigen/Dense>
#include <random>

#include "base/parallel.hpp"
#include "contact/multiplier/condition.hpp"
#include "contact/multiplier/predict.hpp"
#include "contact/multiplier/solve.hpp"
#include "tests/contact/pressed.hpp"

namespace nereid::contact::tie_test {
namespace {

using namespace pressed;

enum class Base { facets, faces };

/// Apexes tied to a warped sheet of facets or of faces of hexahedra, with masses, velocities and forces at random.
struct Tied {
  pressed::Scene scene;
  Vectors v, force, none{3, 0};
  Scalars mass, no_inertia;
  std::vector<Index> turns;
  std::vector<const Mat3*> allowed, no_rotations;
  Multipliers all;
  double dt = 1e-3;

  static pressed::Scene made(const std::vector<Vec3>& apexes, Base base) {
    const Shape shape = sheet(4, 4, [](double x, double y) { return 0.1 * x * (1 + 0.3 * y) + 0.05 * y * y; }, 0.2);
    Vectors x(3, shape.x.cols() + static_cast<Index>(apexes.size()));
    x.leftCols(shape.x.cols()) = shape.x;
    for (std::size_t a = 0; a < apexes.size(); ++a) x.col(shape.x.cols() + static_cast<Index>(a)) = apexes[a];
    Interface in = interface_over(shape, static_cast<Index>(apexes.size()));
    in.kind = InterfaceKind::tied, in.method = Method::multiplier;
    if (base == Base::faces) mark_halves(in.base, faces_of_sheet(4, 4));
    return scene_of(std::move(x), std::move(in), {true, 0, 0});
  }
  explicit Tied(const std::vector<Vec3>& apexes, Base base = Base::faces, bool slides = false) : scene(made(apexes, base)) {
    scene.interface.slides = slides;
    const Index nodes = static_cast<Index>(scene.x.cols());
    std::mt19937 engine(4);
    std::uniform_real_distribution<double> number(-1, 1);
    v = force = Vectors::Zero(3, nodes);
    mass = Scalars::Zero(nodes);
    for (Index n = 0; n < nodes; ++n) {
      mass(n) = 2 + number(engine);
      for (int i = 0; i < 3; ++i) v(i, n) = number(engine), force(i, n) = 100 * number(engine);
    }
    turns.assign(nodes, -1);
    allowed.assign(nodes, nullptr);
    all = make_multipliers(std::vector<AnyContact>{scene.interface}, {}, nodes, 0);
  }
  Motion motion() const { return {scene.x, v, none, force, none, mass, no_inertia, turns, allowed, no_rotations, dt, dt}; }
  void find() {
    const Motion m = motion();
    look_ahead(scene.interface.apexes, m, all);
    look_ahead(scene.interface.base_nodes, m, all);
    find_ties(std::vector<AnyContact>{scene.interface}, m, std::vector<AnyMemory>{scene.memory}, all.velocity, all.ties);
  }
  void step() {
    find();
    take_over(scene.interface, motion(), all.ties.held, all.velocity, scene.memory);
    const Vectors before = v;
    for (Index n = 0; n < v.cols(); ++n) v.col(n) += dt / mass(n) * force.col(n);
    for (const Index n : all.ties.nodes) v.col(n) = all.velocity.col(n);
    scene.x += dt * v;
  }
  std::vector<Vec3> off() {
    find();
    std::vector<Vec3> d;
    for (const HeldTie& b : all.ties.held) d.push_back(b.off);
    return d;
  }
};

/// What an impulse of a tie does to all nodes together.
struct Wrench {
  Vec3 resultant, moment;
};
Wrench wrench(const HeldTie& tie, const Vectors& x, const Vec3& impulse) {
  Wrench sum{Vec3::Zero(), Vec3::Zero()};
  for (int j = 0; j < tie.nodes; ++j) {
    const Vec3 one = part(tie, j, impulse), place = x.col(tie.node[j]);
    sum.resultant += one, sum.moment += place.cross(one);
  }
  return sum;
}

const std::vector<Vec3> above{{1.3, 1.6, 0.4}, {1.4, 1.5, 0.5}, {2.2, 2.9, 0.9}};

class BondByMultipliersOver : public testing::TestWithParam<Base> {};
INSTANTIATE_TEST_SUITE_P(AllBases, BondByMultipliersOver, testing::Values(Base::facets, Base::faces),
                         [](const auto& base) { return base.param == Base::facets ? "Facets" : "Faces"; });

TEST_P(BondByMultipliersOver, ItsRateIsTheDerivativeOfWhatItHoldsAndItsImpulsesAreTheTranspose) {
  Tied at(above, GetParam());
  for (const Vec3& d : at.off()) EXPECT_LT(d.norm(), 1e-14);
  for (const HeldTie& b : at.all.ties.held) {
    EXPECT_EQ(b.nodes, GetParam() == Base::faces ? 5 : 4);
    EXPECT_GT(std::abs(b.height), 0.01);
  }
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> number(-1, 1);
  for (Index n = 0; n < at.scene.x.cols(); ++n)  // away from where it holds
    for (int i = 0; i < 3; ++i) at.scene.x(i, n) += 0.1 * number(engine);
  at.find();
  const std::vector<HeldTie> here = at.all.ties.held;
  const Vectors x = at.scene.x;
  constexpr double small = 1e-5;
  at.scene.x = x + small * at.v;
  const auto ahead = at.off();
  at.scene.x = x - small * at.v;
  const auto behind = at.off();
  for (std::size_t k = 0; k < here.size(); ++k) {
    EXPECT_LT((rate(here[k], at.v) - (ahead[k] - behind[k]) / (2 * small)).norm(), 1e-9);  // third derivatives times 1e-10
    const Vec3 impulse(0.3, -0.7, 0.5);
    double power = 0;
    for (int j = 0; j < here[k].nodes; ++j) power += part(here[k], j, impulse).dot(at.v.col(here[k].node[j]));
    const auto [resultant, moment] = wrench(here[k], x, impulse);
    EXPECT_NEAR(power, impulse.dot(rate(here[k], at.v)), 1e-13);
    EXPECT_LT(resultant.norm(), 1e-14);
    EXPECT_LT((moment - here[k].off.cross(impulse)).norm(), 1e-13) << "none where it holds";
  }
}

TEST_P(BondByMultipliersOver, HoldsAtTheEndOfEveryStepAndKeepsMomenta) {
  Tied at(above, GetParam());
  const auto momenta = [&] {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    for (Index n = 0; n < at.v.cols(); ++n) {
      const Vec3 p = at.mass(n) * at.v.col(n), place = at.scene.x.col(n);
      sum.head<3>() += p, sum.tail<3>() += place.cross(p);
    }
    return sum;
  };
  at.force.setZero();
  at.step();  // the first one stops what goes apart
  const auto before = momenta();
  for (int s = 0; s < 50; ++s) {
    at.step();
    for (const HeldTie& b : at.all.ties.held) {
      const Interface& glue = at.scene.interface;
      const Vec3 n = normal_of(glue, at.scene.memory.near[static_cast<std::size_t>(&b - at.all.ties.held.data())], at.scene.x);
      Vec3 d = at.scene.x.col(b.node[0]) - b.height * n;
      for (int j = 1; j < b.nodes; ++j) d += b.weight[j] * at.scene.x.col(b.node[j]);
      EXPECT_LT(d.norm(), 1e-13) << s;
    }
  }
  EXPECT_LT((momenta() - before).norm(), 1e-12 * before.norm());
}

TEST(TieByMultipliers, FindsTheImpulsesOfADenseSolution) {
  Tied at({{1.3, 1.6, 0.18}, {1.4, 1.5, 0.2}, {1.35, 1.7, 0.2}, {2.2, 2.9, 0.5}, {1.1, 1.2, 0.17}});
  for (Tie& tie : at.scene.interface.ties) tie.height = 0;  // linear
  at.find();
  const auto count = static_cast<Index>(at.all.ties.held.size()), nodes = static_cast<Index>(at.v.cols());
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(3 * count, 3 * nodes), inverse_mass = Eigen::MatrixXd::Zero(3 * nodes, 3 * nodes);
  Eigen::VectorXd missing(3 * count);
  const Motion m = at.motion();
  look_ahead(at.scene.interface.apexes, m, at.all), look_ahead(at.scene.interface.base_nodes, m, at.all);
  for (Index n = 0; n < nodes; ++n) inverse_mass.block<3, 3>(3 * n, 3 * n) = Mat3::Identity() / at.mass(n);
  for (Index k = 0; k < count; ++k) {
    const HeldTie& b = at.all.ties.held[k];
    for (int j = 0; j < b.nodes; ++j) G.block<3, 3>(3 * k, 3 * b.node[j]) += b.weight[j] * Mat3::Identity();
    missing.segment<3>(3 * k) = -0.2 * b.off / at.dt - rate(b, at.all.velocity);
  }
  const Eigen::VectorXd exact = (G * inverse_mass * G.transpose()).ldlt().solve(missing);
  for (Index k = 0; k < count; ++k)
    EXPECT_LT((at.all.ties.held[k].impulse - exact.segment<3>(3 * k)).norm(), 1e-11 * exact.norm()) << k;
}

TEST(TieByMultipliers, CollectsNothingInDirectionsInWhichNothingCanMove) {
  Tied at(above);
  const Mat3 flat = Vec3(1, 1, 0).asDiagonal();
  for (const Mat3*& one : at.allowed) one = &flat;
  at.v.row(2).setZero();
  for (Tie& tie : at.scene.interface.ties) tie.height = 0;
  at.find();
  for (const HeldTie& b : at.all.ties.held) {
    EXPECT_EQ(b.impulse.z(), 0);
    EXPECT_GT(b.impulse.norm(), 0);
    EXPECT_GT(b.off.norm(), 0.01) << "there is something to correct";
  }
}

TEST(TieByMultipliers, NormalOverAFaceIsThatOfItsBilinearSurface) {
  const Tied at(above);
  const Interface& glue = at.scene.interface;
  for (std::size_t k = 0; k < above.size(); ++k) {
    const HeldTie& b = at.all.ties.held[k];
    const auto corner = [&](int I) { return Vec3(at.scene.x.col(b.node[I])); };  // first, second, third, fourth: see HeldTie
    const Tie& tie = glue.ties[k];
    const double second = tie.weight[(b.first + 1) % 3], third = tie.weight[(b.first + 2) % 3];
    const double across = second + tie.weight[3], up = second + third;
    const auto point = [&](double u, double w) {
      return Vec3((1 - u) * (1 - w) * corner(1) + u * w * corner(2) + (1 - u) * w * corner(3) + u * (1 - w) * corner(4));
    };
    constexpr double small = 1e-5;
    const Vec3 n = (point(across + small, up) - point(across - small, up)).cross(point(across, up + small) - point(across, up - small));
    EXPECT_LT((normal_of(glue, at.scene.memory.near[k], at.scene.x) - n.normalized()).norm(), 1e-10);
    EXPECT_LT((point(across, up) + tie.height * n.normalized() - above[k]).norm(), 1e-10);
    EXPECT_GT((facet_normal(glue.base, at.scene.x, tie.facet) - n.normalized()).norm(), 1e-3) << "the face is warped";
  }
}

TEST(TieByMultipliers, FaceThatIsWarpedTooMuchStaysCut) {
  Tied at(above);
  Interface glue = at.scene.interface;
  Vectors x = at.scene.x;
  const HeldTie& b = at.all.ties.held[0];
  x.col(b.node[4]) += Vec3(0, 0, 4);
  tie_here(x, glue);
  EXPECT_FALSE(glue.ties[0].on_face);
  EXPECT_EQ(make_ties(std::vector<AnyContact>{glue}, static_cast<Index>(x.cols())).held[0].nodes, 4);
  tie_here(at.scene.x, glue);
  EXPECT_TRUE(glue.ties[0].on_face);
  EXPECT_EQ(glue.ties[0].weight, at.scene.interface.ties[0].weight);
}

TEST(TieByMultipliers, TwoThatSayTheSameShareTheImpulse) {
  const Vec3 apex(1.3, 1.6, 0.4);
  Tied one({apex}), two({apex});
  Interface again = two.scene.interface;
  const std::vector<AnyContact> both{two.scene.interface, again};
  const std::vector<AnyMemory> memories{two.scene.memory, two.scene.memory};
  two.all = make_multipliers(both, {}, static_cast<Index>(two.scene.x.cols()), 0);
  one.find();
  const Motion m = two.motion();
  look_ahead(two.scene.interface.apexes, m, two.all), look_ahead(two.scene.interface.base_nodes, m, two.all);
  find_ties(both, m, memories, two.all.velocity, two.all.ties);
  const Vec3 whole = one.all.ties.held[0].impulse;
  EXPECT_GT(whole.norm(), 0);
  for (const HeldTie& b : two.all.ties.held) EXPECT_LT((b.impulse - 0.5 * whole).norm(), 1e-11 * whole.norm());
}

/// Apexes over the inside of faces, near an edge where normals go over into each other, and high over the base.
const std::vector<Vec3> apart{{1.3, 1.6, 0.4}, {2.005, 1.5, 0.5}, {2.4, 2.55, 0.9}, {0.4, 0.3, 0.06}};

class SlidingTieOver : public BondByMultipliersOver {};
INSTANTIATE_TEST_SUITE_P(AllBases, SlidingTieOver, testing::Values(Base::facets, Base::faces),
                         [](const auto& base) { return base.param == Base::facets ? "Facets" : "Faces"; });

TEST_P(SlidingTieOver, ItsRateAlongTheNormalIsTheDerivativeOfTheHeightAndItsImpulsesHaveNoMoment) {
  Tied at(apart, GetParam(), true);
  at.find();
  const std::vector<HeldTie> here = at.all.ties.held;
  const Vectors x = at.scene.x;
  constexpr double small = 1e-6;
  at.scene.x = x + small * at.v;
  const auto ahead = at.off();
  const std::vector<HeldTie> there = at.all.ties.held;
  at.scene.x = x - small * at.v;
  const auto behind = at.off();
  for (std::size_t k = 0; k < here.size(); ++k) {
    EXPECT_LT(std::abs(here[k].off.dot(here[k].normal)), 1e-14) << "it begins at its height";
    const double grown = ahead[k].dot(there[k].normal) - behind[k].dot(at.all.ties.held[k].normal);
    EXPECT_NEAR(here[k].normal.dot(rate(here[k], at.v)), grown / (2 * small), 1e-8) << k;
    const auto [resultant, moment] = wrench(here[k], x, 0.7 * here[k].normal);
    EXPECT_LT(resultant.norm(), 1e-14);
    EXPECT_LT(moment.norm(), 1e-13);
    EXPECT_LT(here[k].impulse.cross(here[k].normal).norm(), 1e-14 * (1 + here[k].impulse.norm()));
  }
}

TEST(SlidingTie, FindsTheImpulsesOfADenseSolution) {
  Tied at({{1.3, 1.6, 0.18}, {1.4, 1.5, 0.2}, {1.35, 1.7, 0.2}, {2.2, 2.9, 0.5}, {1.1, 1.2, 0.17}}, Base::faces, true);
  const Mat3 flat = Vec3(1, 1, 0).asDiagonal();
  at.find();
  at.allowed[at.all.ties.held[3].node[1]] = &flat;
  at.find();
  const auto count = static_cast<Index>(at.all.ties.held.size()), nodes = static_cast<Index>(at.v.cols());
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(count, 3 * nodes), inverse_mass = Eigen::MatrixXd::Zero(3 * nodes, 3 * nodes);
  Eigen::VectorXd missing(count);
  const Motion m = at.motion();
  look_ahead(at.scene.interface.apexes, m, at.all), look_ahead(at.scene.interface.base_nodes, m, at.all);
  for (Index n = 0; n < nodes; ++n)
    inverse_mass.block<3, 3>(3 * n, 3 * n) = (at.allowed[n] ? flat : Mat3(Mat3::Identity())) / at.mass(n);
  for (Index k = 0; k < count; ++k) {
    const HeldTie& b = at.all.ties.held[k];
    for (int j = 0; j < b.nodes; ++j) G.block<1, 3>(k, 3 * b.node[j]) += b.weight[j] * b.normal.transpose();
    missing(k) = b.normal.dot(-0.2 * b.off / at.dt - rate(b, at.all.velocity));
  }
  const Eigen::VectorXd exact = (G * inverse_mass * G.transpose()).ldlt().solve(missing);
  for (Index k = 0; k < count; ++k)
    EXPECT_NEAR(at.all.ties.held[k].impulse.dot(at.all.ties.held[k].normal), exact(k), 1e-11 * exact.norm()) << k;
}

TEST(SlidingTie, WalksOverItsBasePullsAndIsLetGoAtTheBorder) {
  Tied at({{0.5, 1.6, 0.3}}, Base::faces, true);
  at.force.setZero();
  for (Index n = 0; n < at.v.cols(); ++n) at.v.col(n).setZero(), at.mass(n) = 1e9;  // the base stays
  const Index apex = at.scene.interface.apexes[0];
  at.mass(apex) = 1;
  at.force(2, apex) = 200;  // it is pulled off
  at.v(0, apex) = 50;
  at.step();
  const auto height = [&] {
    const HeldTie& b = at.all.ties.held[0];
    Tie foot;
    return b.nodes == 1 ? 0.0 : tie_over(at.scene.interface, at.scene.x, 0, b.facet).height;
  };
  const double begun = at.scene.interface.ties[0].height;
  int steps = 0;
  for (; steps < 100 && at.scene.memory.status[0] == Status::closed; ++steps) {
    EXPECT_NEAR(height(), begun, 2e-3) << steps;
    at.step();
  }
  EXPECT_GT(at.scene.memory.walks, 2);
  EXPECT_EQ(at.scene.memory.lost, 1);
  EXPECT_GT(at.scene.x(0, apex), 4) << "past the border";
  EXPECT_LT(at.scene.x(0, apex), 4.2);
  EXPECT_LT(at.scene.memory.impulse.dot(Vec3::UnitZ()), 0) << "it was held back";
  const double kinetic = 0.5 * at.v.col(apex).squaredNorm();
  EXPECT_GT(at.scene.memory.impact, 0) << "edges of the base stop what comes over them";
  EXPECT_LT(at.scene.memory.impact, 0.05 * kinetic);
  const Vec3 impulse = at.scene.memory.impulse;
  at.step(), at.step();
  EXPECT_EQ(at.scene.memory.status[0], Status::unpaired);
  EXPECT_EQ(at.scene.memory.impulse, impulse);
}

}  // namespace
}  // namespace nereid::contact::tie_test
