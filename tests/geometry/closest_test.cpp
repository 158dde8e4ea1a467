#include "geometry/closest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace nereid::geometry::closest_test {
namespace {

using Point = Vector<double>;
using Triangle = std::array<Point, 3>;

class Draw {
 public:
  double uniform(double size = 1) { return size * std::uniform_real_distribution<double>(-1, 1)(random_); }
  Point point(double size) { return {uniform(size), uniform(size), uniform(size)}; }
  /// every fourth triangle is a sliver a thousand times longer than wide
  Triangle triangle() {
    const double squeeze = ++drawn_ % 4 == 0 ? 1e-3 : 1;
    Triangle x;
    for (Point& p : x) p = {uniform(), squeeze * uniform(), squeeze * uniform()};
    return x;
  }

 private:
  std::mt19937 random_{11};
  int drawn_ = 0;
};

double squared_to_segment(const Point& a, const Point& b, const Point& p) {
  const Point L = b - a;
  const double s = std::clamp(dot(p - a, L) / dot(L, L), 0.0, 1.0);
  const Point away = p - (a + s * L);
  return dot(away, away);
}

/// Least distance by trying all: the plane where the projection lies within, and the three borders.
double squared_by_trying_all(const Triangle& x, const Point& p) {
  double least = 1e300;
  for (int e = 0; e < 3; ++e) least = std::min(least, squared_to_segment(x[e], x[(e + 1) % 3], p));
  const Point N = cross(x[1] - x[0], x[2] - x[0]);
  bool within = true;  // Eq. 14
  for (int e = 0; e < 3; ++e) within = within && dot(p - x[e], cross(N, x[(e + 1) % 3] - x[e])) > 0;
  const double h = dot(p - x[0], N) / norm(N);
  return within ? std::min(least, h * h) : least;
}

TEST(ClosestOnTriangle, IsNoFartherThanTheBestOfAllFeatures) {
  Draw draw;
  for (int c = 0; c < 5000; ++c) {
    const Triangle x = draw.triangle();
    const Point p = draw.point(1.5);
    EXPECT_NEAR(closest_on_triangle(x, p).distance_squared, squared_by_trying_all(x, p), 1e-12);
  }
}

TEST(ClosestOnTriangle, IsCloserThanAnySampledPoint) {
  Draw draw;
  for (int c = 0; c < 300; ++c) {
    const Triangle x = draw.triangle();
    const Point p = draw.point(1.5);
    const double found = closest_on_triangle(x, p).distance_squared;
    double least = 1e300;
    constexpr int cells = 40;
    for (int i = 0; i <= cells; ++i) {
      for (int j = 0; i + j <= cells; ++j) {
        const double a = static_cast<double>(i) / cells, b = static_cast<double>(j) / cells;
        const Point away = p - ((1 - a - b) * x[0] + a * x[1] + b * x[2]);
        least = std::min(least, dot(away, away));
      }
    }
    EXPECT_LE(found, least + 1e-12);
    EXPECT_LT(std::sqrt(least) - std::sqrt(found), 4.0 / cells);
  }
}

TEST(ClosestOnTriangle, HasWeightsOfItsOwnFeatureThatSumToOne) {
  Draw draw;
  std::array<int, 4> met{};
  for (int c = 0; c < 5000; ++c) {
    const Triangle x = draw.triangle();
    const Point p = draw.point(1.5);
    const Closest at = closest_on_triangle(x, p);
    ++met[static_cast<int>(at.kind)];
    EXPECT_NEAR(at.weight[0] + at.weight[1] + at.weight[2], 1, 1e-12);
    const auto zeros = std::count(at.weight.begin(), at.weight.end(), 0.0);
    if (at.kind == Kind::vertex) {
      EXPECT_EQ(at.weight[at.local], 1);
    } else if (at.kind == Kind::edge) {
      EXPECT_EQ(at.weight[(at.local + 2) % 3], 0);
    } else {
      EXPECT_EQ(zeros, 0);
    }
    for (const double w : at.weight) EXPECT_GE(w, 0);
  }
  for (const Kind kind : {Kind::vertex, Kind::edge, Kind::facet}) EXPECT_GT(met[static_cast<int>(kind)], 100);
}

TEST(ClosestOnTriangle, IsTheFacetsExactlyWhereEquation14Holds) {
  Draw draw;
  for (int c = 0; c < 5000; ++c) {
    const Triangle x = draw.triangle();
    const Point p = draw.point(1.0), n = cross(x[1] - x[0], x[2] - x[0]);
    double least = 1e300;  // of the three products of Eq. 14, over their size
    for (int e = 0; e < 3; ++e) {
      const Point N = cross(n, x[(e + 1) % 3] - x[e]), L = p - x[e];
      least = std::min(least, dot(L, N) / (norm(L) * norm(N)));
    }
    if (std::abs(least) < 1e-9) continue;  // on a border
    EXPECT_EQ(closest_on_triangle(x, p).kind == Kind::facet, least > 0);
  }
}

TEST(ClosestOnTriangle, NamesTheRegionsOfARightTriangle) {
  const Triangle x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const auto at = [&](double px, double py) {
    const Closest c = closest_on_triangle(x, {px, py, 0.3});
    return std::pair(c.kind, c.local);
  };
  EXPECT_EQ(at(0.2, 0.2), std::pair(Kind::facet, 0));
  EXPECT_EQ(at(0.5, -1), std::pair(Kind::edge, 0));
  EXPECT_EQ(at(1, 1), std::pair(Kind::edge, 1));
  EXPECT_EQ(at(-1, 0.5), std::pair(Kind::edge, 2));
  EXPECT_EQ(at(-1, -1), std::pair(Kind::vertex, 0));
  EXPECT_EQ(at(2, 0), std::pair(Kind::vertex, 1));
  EXPECT_EQ(at(0, 2), std::pair(Kind::vertex, 2));
}

TEST(ClosestOnTriangle, CountsABorderAsTheSmallerFeature) {
  const Triangle x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_EQ(closest_on_triangle(x, {0.5, 0, 1}).kind, Kind::edge);
  EXPECT_EQ(closest_on_triangle(x, {0, 0, 1}).kind, Kind::vertex);
  EXPECT_EQ(closest_on_triangle(x, {1, 0, 0}).kind, Kind::vertex);
  EXPECT_EQ(closest_on_triangle(x, {1, 0, 0}).distance_squared, 0);
}

}  // namespace
}  // namespace nereid::geometry::closest_test
