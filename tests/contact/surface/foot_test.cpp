#include "contact/surface/foot.hpp"

#include <gtest/gtest.h>

#include "contact/surface/stand.hpp"
#include "tests/contact/surfaces.hpp"

namespace nereid::contact::foot_test {
namespace {

using namespace surfaces;

double wavy(double x, double y) { return 0.01 * std::sin(3 * x + y) * y; }

/// A sheet of 4 x 4 warped faces of hexahedra, whose cuts may go the other way.
struct Sheet {
  Shape shape;
  BaseSurface base;

  explicit Sheet(bool turned, double jitter = 0.1) : shape(sheet(4, 4, wavy, jitter)) {
    const Table<4> faces = faces_of_sheet(4, 4);
    for (Index f = 0; f < (turned ? faces.cols() : 0); ++f) {
      const Index a = faces(0, f), b = faces(1, f), c = faces(2, f), d = faces(3, f);
      const bool up = shape.facets(2, 2 * f) == c;
      shape.facets.col(2 * f) = up ? Eigen::Vector3i(a, b, d) : Eigen::Vector3i(a, b, c);
      shape.facets.col(2 * f + 1) = up ? Eigen::Vector3i(b, c, d) : Eigen::Vector3i(a, c, d);
    }
    base = base_of(shape);
    mark_halves(base, faces);
  }
  /// The facet that a point is over, and what it has there.
  struct Found {
    Feature feature;
    FeatureHeight over;
    double fourth;
    Vec3 foot;
  };
  Found over(const Vec3& p, bool blends = true) const {
    Index nearest = 0;
    double least = 1e300;
    for (Index f = 0; f < base.facets.cols(); ++f) {
      const double there = geometry::closest_on_triangle(corners(base, shape.x, f), {p.x(), p.y(), p.z()}).distance_squared;
      if (there < least) least = there, nearest = f;
    }
    const Stand at = stand(base, shape.x, p, nearest);
    Found found{at.feature, at.over, 0, Vec3::Zero()};
    const double band = blends ? blend_band(base, nearest, 0) : 0;
    if (!stand_on_face(base, shape.x, p, found.feature, band, nullptr, found.over, found.fourth) && blends && base.half[nearest].cut < 0)
      blend_over_facet(base, shape.x, p, found.feature, band, nullptr, found.over);
    for (int I = 0; I < 3; ++I) found.foot += found.over.weight[I] * shape.x.col(base.facets(I, found.feature.facet));
    if (found.fourth != 0) found.foot += found.fourth * shape.x.col(base.half[found.feature.facet].fourth);
    return found;
  }
};

TEST(Foot, LiesAlongTheNormalAndItsWeightsSumToOne) {
  const Sheet sheet(false);
  for (double u = 0.13; u < 4; u += 0.37)
    for (double w = 0.11; w < 4; w += 0.41) {
      const Vec3 p(u, w, 0.05);
      const auto at = sheet.over(p);
      EXPECT_NEAR(at.over.weight[0] + at.over.weight[1] + at.over.weight[2] + at.fourth, 1, 1e-13);
      EXPECT_LT((at.foot + at.over.height * at.over.normal - p).norm(), 1e-13);  // a push makes no moment
      EXPECT_NEAR(at.over.normal.norm(), 1, 1e-14);
    }
}

TEST(Foot, DoesNotKnowAlongWhichDiagonalAFaceIsCut) {
  const Sheet one(false), other(true);
  for (double u = 0.13; u < 4; u += 0.17)
    for (double w = 0.11; w < 4; w += 0.13) {
      const auto a = one.over(Vec3(u, w, 0.04), false), b = other.over(Vec3(u, w, 0.04), false);
      ASSERT_NE(a.fourth, 0);
      EXPECT_LT((a.over.normal - b.over.normal).norm(), 1e-2);  // along whose triangle it began
      EXPECT_NEAR(a.over.height, b.over.height, 1e-4);
      EXPECT_LT((a.foot - b.foot).norm(), 1e-3);
    }
  const auto a = one.over(Vec3(1.3, 2.2, 0), false);  // on the surface itself nothing is left of it
  const auto again = other.over(a.foot, false), same = one.over(a.foot, false);
  EXPECT_LT((again.foot - a.foot).norm(), 1e-13);
  EXPECT_LT((again.over.normal - same.over.normal).norm(), 1e-12);
}

TEST(Foot, HeightAndNormalGoEvenlyOverCutsEdgesAndNodes) {
  const Sheet sheet(false);
  const Vec3 from(0.3, 0.45, 0);
  for (const Vec3& end : {Vec3(3.6, 3.4, 0), Vec3(0.3, 3.4, 0), Vec3(3.6, 0.45, 0)}) {
    constexpr int steps = 100000;
    const auto close = [&](const Vec3& p) { return sheet.over(sheet.over(p).foot); };  // an apex in contact
    auto before = close(from);
    double turn = 0, jump = 0;
    for (int i = 1; i <= steps; ++i) {
      const auto now = close(from + double(i) / steps * (end - from));
      turn = std::max(turn, (now.over.normal - before.over.normal).norm());
      jump = std::max(jump, std::abs(now.over.height - before.over.height));
      before = now;
    }
    EXPECT_LT(turn, 1e-3);  // in the bands of 0.02 some tenths of a radian in 500 steps
    EXPECT_LT(jump, 1e-4);
  }
}

/// The weight of each node of a sheet around a place.
Scalars around(const Sheet& sheet, const Vec3& place, Index facet) {
  const NodesAround nodes = nodes_around(sheet.base, sheet.shape.x, place, facet);
  Scalars weight = Scalars::Zero(sheet.shape.x.cols());
  for (int I = 0; I < nodes.count; ++I) weight(nodes.node[I]) = nodes.weight[I];
  return weight;
}

TEST(NodesAround, AreThoseOfAllFacesAtTheFootWhicheverIsAskedAndHoweverFacesAreCut) {
  const Sheet sheet(false), turned(true);
  constexpr Index middle = 12;  // of 25 nodes, where four faces meet
  const Vec3 place = sheet.shape.x.col(middle);
  Scalars due = Scalars::Zero(25);
  due(6) = due(8) = due(16) = due(18) = 1, due(7) = due(11) = due(13) = due(17) = 2, due(middle) = 4;
  for (const Sheet* one : {&sheet, &turned})
    for (Index r = one->base.ring_begin[middle]; r < one->base.ring_begin[middle + 1]; ++r)
      EXPECT_LT((around(*one, place, one->base.ring[r]) - due).cwiseAbs().maxCoeff(), 1e-12) << "asked of facet " << one->base.ring[r];
  const auto over = sheet.over(Vec3(1.5, 1.4, 0));
  EXPECT_EQ((around(sheet, over.foot, over.feature.facet).array() > 0).count(), 4) << "inside a face its own nodes alone";
}

TEST(NodesAround, GoOverEvenlyFromFaceToFace) {
  const Sheet sheet(false);
  Scalars before = Scalars::Zero(25);
  for (double u = 0.5; u < 2.5; u += 1e-4) {
    const auto over = sheet.over(Vec3(u, 1 + 0.1 * (u - 1), 0));
    const Scalars now = around(sheet, over.foot, over.feature.facet);
    // a step is 0.005 of the band, and at most three faces beside a place share a node
    if (u > 0.5) {
      ASSERT_LT((now - before).cwiseAbs().maxCoeff(), 0.02) << "at " << u;
    }
    before = now;
  }
}

TEST(Foot, OfAPlateHasANarrowerBandByTheHeightAtWhichItTouches) {
  const Sheet sheet(false);
  const double whole = blend_band(sheet.base, 0, 0), size = sheet.base.size(0);
  EXPECT_DOUBLE_EQ(whole, 0.02 * size);
  EXPECT_NEAR(blend_band(sheet.base, 0, 0.015 * size), 0.005 * size, 1e-15);
  EXPECT_NEAR(blend_band(sheet.base, 0, 0.02 * size * (1 - 1e-12)), 0, 1e-13);  // nothing is decided where both are as large
  EXPECT_EQ(blend_band(sheet.base, 0, 0.021 * size), 0);
}

TEST(Foot, OfANodeHasTheNormalOfAllFacesAroundItWhicheverIsAsked) {
  Shape shape = sheet(2, 2, [](double x, double y) { return -0.2 * (std::abs(x - 1) + std::abs(y - 1)); });  // opposite faces: 31 degrees
  BaseSurface base = base_of(shape);
  mark_halves(base, faces_of_sheet(2, 2));
  const Vec3 p(1, 1, 1e-9);  // the foot along the normal of a face is as far from the node, of a band of 0.02
  for (Index facet = 0; facet < base.facets.cols(); ++facet) {
    int local = 0;
    while (local < 3 && (Vec3(shape.x.col(base.facets(local, facet))) - Vec3(1, 1, 0)).norm() > 0.1) ++local;
    if (local == 3) continue;
    const Feature feature{facet, geometry::Kind::facet, 0};
    FeatureHeight over = height_over(base, shape.x, feature, p);
    double fourth = 0;
    ASSERT_TRUE(stand_on_face(base, shape.x, p, feature, blend_band(base, facet, 0), nullptr, over, fourth));
    EXPECT_LT((over.normal - Vec3::UnitZ()).norm(), 1e-7) << facet;
    EXPECT_NEAR(over.height, 1e-9, 1e-15);
  }
}

}  // namespace
}  // namespace nereid::contact::foot_test
