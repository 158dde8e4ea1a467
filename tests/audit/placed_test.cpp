#include "audit/placed.hpp"

#include <random>

#include "tests/audit/bodies.hpp"

namespace nereid::audit::placed_test {
namespace {

/// A box with cells and its skin where it stands.
struct Standing {
  explicit Standing(const mesh::Mesh& mesh) : all(surfaces(mesh, std::vector<double>(mesh.triangles.size(), 0.1))) {
    placed = make_placed(all.list[0]);
    place(all.list[0], mesh.X, placed);
  }
  const Surface& surface() const { return all.list[0]; }
  Surfaces all;
  Placed placed;
};

TEST(LeftOpen, IsTheSagittaOfAnArcAndHalfOfWhatDiagonalsAreApart) {
  const double radius = 10, angle = 0.1;
  mesh::Mesh arc = plate("arc", 8, 1, 8, 1);
  for (Index n = 0; n < arc.X.cols(); ++n) {
    const double t = arc.X(0, n) * angle;
    arc.X(0, n) = radius * std::sin(t), arc.X(2, n) = radius * std::cos(t);
  }
  const Standing bent(arc);
  EXPECT_NEAR(bent.placed.open.maxCoeff() / (radius * (1 - std::cos(angle / 2))), 1, 1e-3);
  EXPECT_EQ(bent.placed.open_at.maxCoeff(), bent.placed.open.maxCoeff());

  mesh::Mesh cube = block("cube", Vec3::Ones(), {1, 1, 1});
  EXPECT_EQ(Standing(cube).placed.open.maxCoeff(), 0) << "its edges are meant";
  for (Index n = 0; n < 8; ++n)
    if (cube.X(0, n) > 0 && cube.X(1, n) > 0) cube.X(2, n) += 0.2;
  EXPECT_NEAR(Standing(cube).placed.open.maxCoeff(), 0.05, 1e-12) << "half of the 0.1 between the middles of its diagonals";
}

TEST(Winding, TellsInsideFromOutsideAlsoOnTheLinesOfTheMesh) {
  const Standing box(block("box", Vec3::Ones(), {4, 4, 4}));
  std::mt19937 random(1);
  std::uniform_int_distribution<int> place(-7, 7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = Vec3(place(random), place(random), place(random)) / 8;
    const double most = p.cwiseAbs().maxCoeff();
    if (most == 0.5) continue;
    EXPECT_EQ(winding(box.surface(), box.placed, p), most < 0.5 ? 1 : 0) << p.transpose();
  }
}

TEST(Winding, IsMinusOneInsideOut) {
  mesh::Mesh box = block("box", Vec3::Ones(), {2, 2, 2});
  box.X.row(0) *= -1;
  EXPECT_EQ(winding(Standing(box).surface(), Standing(box).placed, Vec3(0.1, 0.2, 0.3)), -1);
}

TEST(Winding, OfAShellIsOneBetweenItsSides) {
  const mesh::Mesh sheet = mesh::rotated_about(plate("sheet", 2, 2, 4, 4), Vec3::UnitX(), 0.3, Vec3::Zero());
  const Surfaces all = surfaces(sheet, {0.1});
  Placed placed = make_placed(all.shells[0]);
  place(all.shells[0], sheet.X, placed);
  const Vec3 across(0, -std::sin(0.3), std::cos(0.3));
  for (const double height : {-0.06, -0.04, 0.0, 0.04, 0.06})
    for (const double along : {-1.01, -0.99, 0.0, 0.99, 1.01}) {
      const bool inside = std::abs(height) < 0.05 && std::abs(along) < 1;
      EXPECT_EQ(winding(all.shells[0], placed, along * Vec3::UnitX() + height * across), inside ? 1 : 0) << height << " " << along;
    }
}

TEST(Place, GivesAShellTheThicknessThatItsPlatesHaveNow) {
  const mesh::Mesh sheet = plate("sheet", 2, 2, 4, 4);
  const Surfaces all = surfaces(sheet, {0.1});
  Placed placed = make_placed(all.shells[0]);
  Scalars growth = Scalars::Zero(sheet.X.cols());
  for (Eigen::Index n = 0; n < growth.size(); ++n) growth(n) = -0.01 * (2 + sheet.X(0, n));
  place(all.shells[0], sheet.X, placed, growth);
  const auto points = static_cast<Index>(all.shells[0].nodes.size()) / 2;
  for (Index p = 0; p < points; ++p) {
    const double half = 0.05 + growth(all.shells[0].nodes[p]);
    EXPECT_NEAR(placed.half(p), half, 1e-15);
    EXPECT_NEAR((placed.at.col(p) - placed.at.col(p + points)).norm(), 2 * half, 1e-14);
  }
}

TEST(Nearest, IsTheSmallestOfAllDistances) {
  const Standing box(block("box", {1, 2, 3}, {3, 4, 5}));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-2, 2);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p(place(random), place(random), place(random));
    const Vec3 out = (p.cwiseAbs() - Vec3(0.5, 1, 1.5));
    const double expected = out.maxCoeff() < 0 ? -out.maxCoeff() : out.cwiseMax(0).norm();
    EXPECT_NEAR(nearest(box.surface(), box.placed, p, 0, [](Index) { return true; }).distance, expected, 1e-12);
  }
}

TEST(Nearest, MayEndWithWhatIsCloseEnough) {
  const Standing box(block("box", Vec3::Ones(), {8, 8, 8}));
  const Nearest at = nearest(box.surface(), box.placed, Vec3(0, 0, 0.4), 0.3, [](Index) { return true; });
  EXPECT_LE(at.distance, 0.3);
  EXPECT_GE(at.distance, 0.1 - 1e-12);
}

TEST(Nearest, KnowsTheRimOfASheet) {
  const Standing sheet(plate("sheet", 2, 2, 4, 4));
  const auto all = [](Index) { return true; };
  EXPECT_FALSE(nearest(sheet.surface(), sheet.placed, Vec3(0.5, 0.5, 0.3), 0, all).on_rim);
  EXPECT_TRUE(nearest(sheet.surface(), sheet.placed, Vec3(1.2, 0.3, 0.3), 0, all).on_rim);
  EXPECT_TRUE(nearest(sheet.surface(), sheet.placed, Vec3(1.2, 1.2, 0), 0, all).on_rim);
}

TEST(Crossings, AreThoseOfAnEdgeThroughBothSidesOfABox) {
  const Standing box(block("box", Vec3::Ones(), {3, 3, 3}));
  std::vector<double> at;
  const auto all = [](Index) { return true; };
  const auto keep = [&](Index, double s) { at.push_back(s); };
  crossings(box.surface(), box.placed, Vec3(-1, 0.1, 0.05), Vec3(1, 0.1, 0.05), -1, all, keep);
  std::sort(at.begin(), at.end());
  ASSERT_EQ(at.size(), 2U);
  EXPECT_NEAR(at[0], 0.25, 1e-12);
  EXPECT_NEAR(at[1], 0.75, 1e-12);
  at.clear();
  crossings(box.surface(), box.placed, Vec3(-1, 0, 0.5 / 3), Vec3(1, 0, 0.5 / 3), -1, all, keep);
  EXPECT_GE(at.size(), 4U) << "along the borders of triangles none is missed";
  at.clear();
  crossings(box.surface(), box.placed, Vec3(-1, 2, 0), Vec3(1, 2, 0), -1, all, keep);
  EXPECT_TRUE(at.empty());
}

}  // namespace
}  // namespace nereid::audit::placed_test
