#include "geometry/height.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/dual.hpp"

namespace nereid::geometry::height_test {
namespace {

using Point = Vector<double>;

/// Random points, every fourth time squeezed into a sliver a hundred times longer than wide.
class Points {
 public:
  template <int count>
  std::array<Point, count> next() {
    std::array<Point, count> x;
    const double squeeze = ++drawn_ % 4 == 0 ? 0.01 : 1.0;
    for (Point& p : x) p = {uniform(), squeeze * uniform(), squeeze * uniform()};
    return x;
  }
  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(random_); }

 private:
  std::mt19937 random_{7};
  int drawn_ = 0;
};

constexpr int configurations = 1000;

/// One of the three elements: the first `nodes` points are its base, the last is its apex.
template <class T, int nodes>
Height<T, nodes> height_of(const std::array<Vector<T>, nodes + 1>& x) {
  std::array<Vector<T>, nodes> base;
  std::copy_n(x.begin(), nodes, base.begin());
  if constexpr (nodes == 3) return facet_height(base, x[nodes]);
  else if constexpr (nodes == 2) return edge_height(base, x[nodes]);
  else return vertex_height(base, x[nodes]);
}

/// How ill a configuration is: longest edge over the smallest length that a height divides by.
template <int nodes>
double longest(const std::array<Point, nodes + 1>& x) {
  double most = 0;
  for (const Point& a : x)
    for (const Point& b : x) most = std::max(most, norm(a - b));
  return most;
}
template <int nodes>
double sharpness(const std::array<Point, nodes + 1>& x) {
  const double most = longest<nodes>(x);
  double least = nodes == 3 ? most : std::abs(height_of<double, nodes>(x).height);
  if constexpr (nodes >= 2) least = std::min(least, norm(x[1] - x[0]));
  if constexpr (nodes == 3) least = std::min(least, norm(cross(x[1] - x[0], x[2] - x[0])) / most);
  return (nodes == 1 ? std::max(1.0, norm(x[0]) / most) : 1.0) * most / least;
}

template <int nodes>
void matches_dual_numbers() {
  constexpr int variables = 3 * (nodes + 1);
  using D = Dual<variables>;
  Points points;
  double worst = 0;
  for (int c = 0; c < configurations; ++c) {
    const auto x = points.next<nodes + 1>();
    std::array<Vector<D>, nodes + 1> y;
    for (int I = 0; I <= nodes; ++I)
      for (int i = 0; i < 3; ++i) y[I][i] = D::variable(x[I][i], 3 * I + i);
    const auto B = height_gradient(height_of<double, nodes>(x));
    const D h = height_of<D, nodes>(y).height;
    for (int I = 0; I <= nodes; ++I)
      for (int i = 0; i < 3; ++i)
        worst = std::max(worst, std::abs(B[I][i] - h.by[3 * I + i]) / std::pow(sharpness<nodes>(x), 2));
  }
  EXPECT_LT(worst, 1e-13);
}
TEST(HeightGradient, OfAFacetMatchesDualNumbers) { matches_dual_numbers<3>(); }
TEST(HeightGradient, OfAnEdgeMatchesDualNumbers) { matches_dual_numbers<2>(); }
TEST(HeightGradient, OfAVertexMatchesDualNumbers) { matches_dual_numbers<1>(); }

template <int nodes>
void matches_central_differences() {
  Points points;
  double worst = 0;
  for (int c = 0; c < configurations; ++c) {
    const auto x = points.next<nodes + 1>();
    const double sharp = sharpness<nodes>(x), step = 1e-5 * longest<nodes>(x) / sharp;
    const auto B = height_gradient(height_of<double, nodes>(x));
    for (int I = 0; I <= nodes; ++I) {
      for (int i = 0; i < 3; ++i) {
        auto ahead = x, behind = x;
        ahead[I][i] += step;
        behind[I][i] -= step;
        const double slope =
            (height_of<double, nodes>(ahead).height - height_of<double, nodes>(behind).height) / (2 * step);
        worst = std::max(worst, std::abs(B[I][i] - slope) / std::pow(sharp, 2));
      }
    }
  }
  EXPECT_LT(worst, 1e-9);  // step^2 of truncation, round-off over the step
}
TEST(HeightGradient, OfAFacetMatchesCentralDifferences) { matches_central_differences<3>(); }
TEST(HeightGradient, OfAnEdgeMatchesCentralDifferences) { matches_central_differences<2>(); }
TEST(HeightGradient, OfAVertexMatchesCentralDifferences) { matches_central_differences<1>(); }

/// Feet lie anywhere, most of them outside their features.
template <int nodes>
void exerts_no_net_force_and_no_net_moment() {
  Points points;
  int outside = 0;
  for (int c = 0; c < configurations; ++c) {
    const auto x = points.next<nodes + 1>();
    const auto at = height_of<double, nodes>(x);
    const auto B = height_gradient(at);
    Point force{0, 0, 0}, moment{0, 0, 0};
    double size = 1;
    for (int I = 0; I <= nodes; ++I) {
      force = force + B[I];
      moment = moment + cross(x[I], B[I]);
      size = std::max(size, norm(B[I]));
    }
    outside += *std::min_element(at.weight.begin(), at.weight.end()) < 0;
    EXPECT_LT(norm(force), 1e-14 * size * sharpness<nodes>(x));
    EXPECT_LT(norm(moment), 1e-13 * size * sharpness<nodes>(x));
  }
  if (nodes > 1) {
    EXPECT_GT(outside, configurations / 4);
  }
}
TEST(HeightGradient, OfAFacetExertsNoNetForceAndNoNetMoment) { exerts_no_net_force_and_no_net_moment<3>(); }
TEST(HeightGradient, OfAnEdgeExertsNoNetForceAndNoNetMoment) { exerts_no_net_force_and_no_net_moment<2>(); }
TEST(HeightGradient, OfAVertexExertsNoNetForceAndNoNetMoment) { exerts_no_net_force_and_no_net_moment<1>(); }

template <int nodes>
void is_invariant_under_rigid_motion() {
  Points points;
  for (int c = 0; c < configurations; ++c) {
    const auto x = points.next<nodes + 1>();
    const Matrix<double> Q = cayley_rotation(Point{3 * points.uniform(), 3 * points.uniform(), 3 * points.uniform()});
    const Point shift{points.uniform(), points.uniform(), points.uniform()};
    auto moved = x;
    for (Point& p : moved) p = Q * p + shift;
    const auto at = height_of<double, nodes>(x), there = height_of<double, nodes>(moved);
    const double room = 1e-14 * std::pow(sharpness<nodes>(x), 2);
    EXPECT_NEAR(there.height, at.height, room);
    EXPECT_LT(norm(there.normal - Q * at.normal), room);
    for (int I = 0; I < nodes; ++I) EXPECT_NEAR(there.weight[I], at.weight[I], room);
  }
}
TEST(Height, OverAFacetIsInvariantUnderRigidMotion) { is_invariant_under_rigid_motion<3>(); }
TEST(Height, OverAnEdgeIsInvariantUnderRigidMotion) { is_invariant_under_rigid_motion<2>(); }
TEST(Height, OverAVertexIsInvariantUnderRigidMotion) { is_invariant_under_rigid_motion<1>(); }

TEST(Height, OverAFacetTurnsWithItsNodesAndChangesSignWithTheirSense) {
  Points points;
  for (int c = 0; c < configurations; ++c) {
    const auto x = points.next<4>();
    const double room = 1e-14 * std::pow(sharpness<3>(x), 2);
    const auto at = facet_height(std::array{x[0], x[1], x[2]}, x[3]);
    const auto turned = facet_height(std::array{x[1], x[2], x[0]}, x[3]);
    const auto flipped = facet_height(std::array{x[1], x[0], x[2]}, x[3]);
    EXPECT_NEAR(turned.height, at.height, room);
    EXPECT_NEAR(flipped.height, -at.height, room);
    for (int I = 0; I < 3; ++I) EXPECT_NEAR(turned.weight[I], at.weight[(I + 1) % 3], room);
    EXPECT_NEAR(flipped.weight[0], at.weight[1], room);
    EXPECT_NEAR(flipped.weight[2], at.weight[2], room);
  }
}

TEST(Height, WithoutARootIsOnTheSideOfALevelThatItSays) {
  Points points;
  int decided = 0;
  for (int i = 0; i < configurations; ++i) {
    const auto x = points.next<4>();
    const std::array<Point, 3> base{x[0], x[1], x[2]};
    const double height = facet_height(base, x[3]).height;
    for (const double part : {0.0, 0.5, 1 - 1e-8, 1 - 1e-15, 1.0, 1 + 1e-15, 1 + 1e-8, 2.0}) {
      const double level = part * std::abs(height);
      const bool above = is_well_above(base, x[3], level), below = is_well_below(base, x[3], level);
      if (above) { EXPECT_GT(height, level); }
      if (below) { EXPECT_LT(height, -level); }
      EXPECT_EQ(above || below, part <= 1 - 1e-8) << "at " << part << " of the height";
      decided += above + below;
    }
  }
  EXPECT_EQ(decided, 3 * configurations);
}

TEST(Height, OverAnEdgeDoesNotKnowWhichNodeComesFirst) {
  Points points;
  for (int c = 0; c < configurations; ++c) {
    const auto x = points.next<3>();
    const double room = 1e-14 * std::pow(sharpness<2>(x), 2);
    const auto at = edge_height(std::array{x[0], x[1]}, x[2]), flipped = edge_height(std::array{x[1], x[0]}, x[2]);
    EXPECT_NEAR(flipped.height, at.height, room);
    EXPECT_NEAR(flipped.weight[0], at.weight[1], room);
  }
}

TEST(Height, OverAFacetIsThreeVolumesOverItsArea) {
  Points points;
  for (int c = 0; c < configurations; ++c) {
    const auto x = points.next<4>();
    const Point twice_area = cross(x[1] - x[0], x[2] - x[0]);
    const double volume = dot(twice_area, x[3] - x[0]) / 6, area = norm(twice_area) / 2;
    EXPECT_NEAR(facet_height(std::array{x[0], x[1], x[2]}, x[3]).height, 3 * volume / area, 1e-12);
  }
}

/// Largest difference of a row of Eq. 8 from the gradient, over the configurations: [base, apex].
std::array<double, 2> difference(Printing printing) {
  Points points;
  std::array<double, 2> worst{};
  for (int c = 0; c < configurations; ++c) {
    const auto x = points.next<4>();
    const std::array base{x[0], x[1], x[2]};
    const auto B = height_gradient(facet_height(base, x[3]));
    const auto paper = paper_gradient(base, x[3], printing);
    const double room = std::pow(sharpness<3>(x), 2);
    for (int I = 0; I < 4; ++I) worst[I / 3] = std::max(worst[I / 3], norm(paper[I] - B[I]) / room);
  }
  return worst;
}

TEST(PaperGradient, CorrectedIsTheGradient) {
  EXPECT_LT(difference(Printing::corrected)[0], 1e-10);
  EXPECT_LT(difference(Printing::corrected)[1], 1e-10);
}

TEST(PaperGradient, AsPrintedIsRightForTheApexOnly) {
  EXPECT_LT(difference(Printing::as_printed)[1], 1e-10);
  EXPECT_GT(difference(Printing::as_printed)[0], 1e-2);
}

TEST(PaperGradient, AsPrintedErrsByMoreThanTheGradientOnTheUnitTetrahedron) {
  // apex over the centroid: the gradient is -n/3 at each base node, length 1/3
  const std::array<Point, 3> base{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Point apex{1.0 / 3, 1.0 / 3, 1};
  const auto B = height_gradient(facet_height(base, apex));
  const auto printed = paper_gradient(base, apex, Printing::as_printed);
  double worst = 0;
  for (int I = 0; I < 3; ++I) worst = std::max(worst, norm(printed[I] - B[I]));
  EXPECT_NEAR(3 * worst, 4.3732, 1e-4);  // over the gradient's length
  // and it depends on where the origin lies, which no gradient of a height does
  const Point shift{10, 0, 0};
  const auto elsewhere = paper_gradient({base[0] + shift, base[1] + shift, base[2] + shift}, apex + shift, Printing::as_printed);
  EXPECT_GT(norm(elsewhere[0] - printed[0]) + norm(elsewhere[1] - printed[1]), 1.0);
}

TEST(PaperGradient, NeedsBothCorrections) {
  // far from the origin the sign of the middle term matters, for an area other than one the power of A
  const std::array<Point, 3> base{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}};
  const Point apex{0.02, 0.05, 0.03};
  const auto B = height_gradient(facet_height(base, apex));
  const auto corrected = paper_gradient(base, apex, Printing::corrected);
  const auto printed = paper_gradient(base, apex, Printing::as_printed);
  for (int I = 0; I < 3; ++I) EXPECT_LT(norm(corrected[I] - B[I]), 1e-10);
  EXPECT_GT(norm(printed[0] - B[0]), 0.1);
}

}  // namespace
}  // namespace nereid::geometry::height_test
