#include "contact/tracking/points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/contact/pressed.hpp"

namespace nereid::contact::points_test {
namespace {

using namespace pressed;

/// Quadrilateral faces of an upper side, or triangles, with normals down, over a base.
struct Setting {
  Vectors x;
  Interface interface;
  PointWork work;
  PointSum range;
  Index side;  // nodes of the upper side along an edge

  /// low, cell  [m] corner and size of the faces;  rise  of the upper side over x and y
  template <class Rise>
  Setting(const Shape& base, int cells, const Vec3& low, double cell, bool triangles, Rise&& rise) : side(cells + 1) {
    interface = interface_over(base, side * side);
    const Index first = interface.apexes[0];
    x = Vectors::Zero(3, first + side * side);
    x.leftCols(first) = base.x;
    for (Index j = 0; j < side; ++j)
      for (Index i = 0; i < side; ++i) {
        const double a = low.x() + cell * i, b = low.y() + cell * j;
        x.col(first + i + side * j) = Vec3(a, b, low.z() + rise(a, b));
      }
    mesh::FacesAround& around = interface.faces;
    const int parts = triangles ? 2 : 1;
    around.faces.resize(4, parts * cells * cells);
    Index at = 0;
    for (Index j = 0; j < cells; ++j)
      for (Index i = 0; i < cells; ++i) {
        const Index a = first + i + side * j, b = a + 1, c = b + side, d = a + side;
        if (!triangles) around.faces.col(at++) = Eigen::Vector4i(a, d, c, b);
        else around.faces.col(at++) = Eigen::Vector4i(a, c, b, -1), around.faces.col(at++) = Eigen::Vector4i(a, d, c, -1);
      }
    around.begin = {0};
    for (const Index apex : interface.apexes) {
      for (Index f = 0; f < around.faces.cols(); ++f)
        if ((around.faces.col(f).array() == apex).any()) around.shares.push_back({f, cell * cell / (triangles ? 6 : 4)});
      around.begin.push_back(static_cast<Index>(around.shares.size()));
    }
    work.of_face.resize(static_cast<std::size_t>(around.faces.cols()));
  }
  OverPoints sum(Index apex, Index facet = 0) {
    ++work.step;
    begin_range(range);
    return sum_points(interface, x, apex, facet, work, range);
  }
  /// Sum of the pushes, and of their moments about the origin.
  std::pair<Vec3, Vec3> resultant() const {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (const Share& one : range.sum) force += one.push, moment += x.col(one.node).cross(one.push);
    return {force, moment};
  }
};

double plane(double, double) { return 0; }
double dome(double a, double b) { return -0.02 * ((a - 2) * (a - 2) + (b - 2) * (b - 2)); }

TEST(Points, LeaveTheApexAloneOfItsSideOverAPlane) {
  for (const bool triangles : {false, true}) {
    Setting at(sheet(5, 5, flat), 3, Vec3(0.7, 0.9, 1e-3), 1.1, triangles, plane);
    for (Index apex = 0; apex < at.side * at.side; ++apex) {
      const OverPoints sum = at.sum(apex);
      ASSERT_GT(sum.area, 0);
      EXPECT_FALSE(sum.covered_elsewhere);
      EXPECT_NEAR(sum.gap, 1e-3 * sum.area, 1e-15);
      Vec3 under = Vec3::Zero();
      for (const Share& one : at.range.sum) {
        const bool is_apex = one.node == at.interface.apexes[apex];
        if (one.of_apex_side) {
          EXPECT_NEAR(one.push.z(), is_apex ? sum.area : 0, 1e-13);
        } else {
          under -= one.push.z() * at.x.col(one.node);
        }
      }
      // of a plane base the weights give any linear field: they load it where the apex is
      EXPECT_LT((under / sum.area - Vec3(at.x.col(at.interface.apexes[apex]) - 1e-3 * Vec3::UnitZ())).norm(), 1e-12);
    }
  }
}

TEST(Points, ShareAUniformLoadAsUnlikeFacesWould) {
  Setting at(sheet(4, 4, flat), 6, Vec3(0, 0, 0), 4.0 / 6, false, plane);
  std::vector<double> load(static_cast<std::size_t>(at.x.cols()), 0);
  for (Index apex = 0; apex < at.side * at.side; ++apex) {
    at.sum(apex);
    for (const Share& one : at.range.sum)
      if (!one.of_apex_side) load[static_cast<std::size_t>(one.node)] -= one.push.z();
  }
  std::vector<double> even(load.size(), 0);  // of a uniform pressure on the facets of the base
  for (Index f = 0; f < at.interface.base.facets.cols(); ++f)
    for (int I = 0; I < 3; ++I) even[static_cast<std::size_t>(at.interface.base.facets(I, f))] += at.interface.facet_area(f) / 3;
  double squares = 0, sum = 0;
  for (std::size_t node = 0; node < static_cast<std::size_t>(at.interface.apexes[0]); ++node)
    squares += std::pow(load[node] / even[node] - 1, 2), sum += load[node];
  const double rms = std::sqrt(squares / at.interface.apexes[0]);
  EXPECT_NEAR(sum, 16, 1e-12);
  EXPECT_LT(rms, 0.1);
}

TEST(Points, KeepMomentumAndAngularMomentumOverACurvedBase) {
  for (const bool triangles : {false, true}) {
    Setting at(sheet(5, 5, dome), 3, Vec3(0.7, 0.9, 0.3), 1.1, triangles, [](double a, double b) { return 0.3 * dome(a, b); });
    for (Index apex = 0; apex < at.side * at.side; ++apex) {
      const OverPoints sum = at.sum(apex);
      ASSERT_GT(sum.area, 0);
      const auto [force, moment] = at.resultant();
      EXPECT_LT(force.norm(), 1e-14);
      EXPECT_LT(moment.norm(), 1e-13);
      EXPECT_LT((Vec3(sum.normal.normalized()) - Vec3::UnitZ()).norm(), 0.3);
    }
  }
}

TEST(Points, RatesAreThoseOfGaps) {
  Setting at(sheet(5, 5, dome), 3, Vec3(0.7, 0.9, 0.2), 1.1, false, [](double a, double b) { return 0.3 * dome(a, b); });
  const Vectors x = at.x;
  Vectors v = Vectors::Random(3, x.cols());
  constexpr double step = 1e-6;
  for (Index apex = 0; apex < at.side * at.side; ++apex) {
    at.x = x;
    at.sum(apex);
    double rate = 0;
    for (const Share& one : at.range.sum) rate += one.push.dot(v.col(one.node));
    at.x = x + step * v;
    const double ahead = at.sum(apex).gap;
    at.x = x - step * v;
    EXPECT_NEAR((ahead - at.sum(apex).gap) / (2 * step), rate, 1e-7) << apex;  // the foot moves along the base, and areas are constant
  }
}

TEST(Points, AddUpNodeByNodeHoweverManyThereAre) {
  PointSum work;
  work.place.assign(4, -1);
  for (int turn = 1; turn <= 2; ++turn)
    for (Index node = 0; node < 3000; ++node) add_to(7 * node, Vec3(node, 1, 0), true, work);
  ASSERT_EQ(work.sum.size(), 3000U);
  for (Index node = 0; node < 3000; ++node) EXPECT_EQ(work.sum[static_cast<std::size_t>(node)].push, Vec3(2 * node, 2, 0));
}

TEST(Points, OfAFaceThatIsCoveredInPartGoToItsBestCoveredNodes) {
  // the base ends at 4: of the outer faces, from 3 to 5, the inner half is covered
  Setting at(sheet(4, 4, flat), 2, Vec3(1, 1, 0), 2, false, plane);
  double area = 0;
  for (Index apex = 0; apex < 9; ++apex) {
    const OverPoints sum = at.sum(apex);
    const Vec3 place = at.x.col(at.interface.apexes[apex]);
    const bool outside = place.x() > 4.5 || place.y() > 4.5;
    EXPECT_EQ(sum.area == 0, outside) << apex;
    EXPECT_EQ(sum.covered_elsewhere, outside) << apex;
    area += sum.area;
    const auto [force, moment] = at.resultant();
    EXPECT_LT(force.norm(), 1e-13);
    EXPECT_LT(moment.norm(), 1e-12);
  }
  EXPECT_NEAR(area, 9, 1e-12);  // of what lies on the base
}

TEST(Points, DoNotDependOnWhichWayTheNodesOfAFaceAreCounted) {
  Setting at(sheet(4, 4, flat), 2, Vec3(0.5, 0.5, 0), 2, false, plane), turned = at;  // covers 0.5 to 4 of 4.5
  for (Index f = 0; f < turned.interface.faces.faces.cols(); ++f) {
    const Eigen::Vector4i nodes = turned.interface.faces.faces.col(f);
    turned.interface.faces.faces.col(f) << nodes(1), nodes(2), nodes(3), nodes(0);
  }
  for (Index apex = 0; apex < 9; ++apex) {
    const OverPoints one = at.sum(apex), other = turned.sum(apex);
    EXPECT_NEAR(one.area, other.area, 1e-14) << apex;
    for (const Share& share : at.range.sum) {
      const std::vector<Share>& sum = turned.range.sum;
      const auto same = std::find_if(sum.begin(), sum.end(), [&](const Share& s) { return s.node == share.node; });
      ASSERT_NE(same, sum.end());
      EXPECT_LT((same->push - share.push).norm(), 1e-14);
    }
  }
}

TEST(Points, OfACornerThatIsNotCoveredAreSharedByItsNeighboursInAMirror) {
  // a face from 0.8 to 2.4 over a base with a hole from 2 to 3: its corner at (2.4, 2.4) has three of four points, of which that at
  // (1.8, 1.8) is as near to the corners beside the diagonal
  Shape base = sheet(4, 4, flat);
  const Index hole = 2 * (2 * 4 + 2);
  base.facets.middleCols(hole, base.facets.cols() - hole - 2) = Table<3>(base.facets.rightCols(base.facets.cols() - hole - 2));
  base.facets = Table<3>(base.facets.leftCols(base.facets.cols() - 2));
  const auto sums = [&](int first) {
    Setting at(base, 1, Vec3(0.8, 0.8, 0), 1.6, false, plane);
    const Eigen::Vector4i nodes = at.interface.faces.faces.col(0);
    for (int j = 0; j < 4; ++j) at.interface.faces.faces(j, 0) = nodes((j + first) % 4);
    std::array<double, 4> gap{};
    at.x.col(at.interface.apexes[1]).z() = 0.1, at.x.col(at.interface.apexes[2]).z() = 0.1;  // as in the mirror x = y
    for (Index apex = 0; apex < 4; ++apex) gap[static_cast<std::size_t>(apex)] = at.sum(apex).gap;
    return gap;
  };
  const auto one = sums(0);
  EXPECT_GT(one[1], 0);
  EXPECT_NEAR(one[1], one[2], 1e-15);  // both beside the diagonal
  for (int first = 1; first < 4; ++first)
    for (std::size_t apex = 0; apex < 4; ++apex) EXPECT_NEAR(sums(first)[apex], one[apex], 1e-15) << first << " " << apex;
}

TEST(Points, FacesThatLeanAreLeftToTheirNodes) {
  const double slope = std::tan(0.5);  // 29 degrees
  Setting at(sheet(4, 4, flat), 2, Vec3(1, 1, 0), 0.8, false, [slope](double a, double) { return slope * (a - 1); });
  const OverPoints sum = at.sum(4);
  EXPECT_EQ(sum.area, 0);
  EXPECT_GT(sum.of_node, 0);
  EXPECT_FALSE(sum.covered_elsewhere);
}

TEST(Foot, OfAPointIsFoundFromAnyFacetAndNotPastABorder) {
  Setting at(sheet(5, 5, dome), 1, Vec3(1, 1, 1), 1, false, plane);
  const BaseSurface& base = at.interface.base;
  for (Index from = 0; from < base.facets.cols(); ++from)
    for (const Vec3& p : {Vec3(0.3, 4.6, 0.2), Vec3(2.5, 2.5, 0.1), Vec3(4.2, 0.7, 0.3)}) {
      Foot foot;
      ASSERT_TRUE(find_foot(base, at.x, p, from, foot)) << from;
      Vec3 there = foot.height * foot.normal;
      for (int l = 0; l < foot.nodes; ++l) there += foot.weight[l] * at.x.col(foot.node[l]);
      EXPECT_LT((there - p).norm(), 1e-12);
      EXPECT_FALSE(find_foot(base, at.x, Vec3(-0.5, p.y(), 0), from, foot)) << from;
    }
}

TEST(Guard, MayBeAsDeepAsAFaceSagsBelowIt) {
  Setting at(sheet(4, 4, flat), 2, Vec3(1, 1, 0), 1, false, plane);
  EXPECT_NEAR(allowance(at.interface, at.x, 4, 0), 0.01 * at.interface.base.size(0), 1e-12);
  Setting bent(sheet(4, 4, flat), 2, Vec3(1, 1, 0), 1, false, [](double a, double) { return 0.1 * std::abs(a - 2); });
  EXPECT_NEAR(allowance(bent.interface, bent.x, 4, 0), (0.01 + 0.25 * std::atan(0.1)) * bent.interface.base.size(0), 1e-3);
  Setting ridge(sheet(4, 4, flat), 2, Vec3(1, 1, 0), 1, false, [](double a, double) { return std::abs(a - 2); });
  EXPECT_NEAR(allowance(ridge.interface, ridge.x, 4, 0), 0.01 * ridge.interface.base.size(0), 1e-12);
}

}  // namespace
}  // namespace nereid::contact::points_test
