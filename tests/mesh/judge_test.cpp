#include "mesh/judge.hpp"

#include <gtest/gtest.h>

#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/disc.hpp"
#include "mesh/sphere.hpp"
#include "mesh/wedge.hpp"

namespace nereid::mesh::judge_test {
namespace {

Mesh brick(int x = 2, int y = 2, int z = 2) { return box("b", {Vec3::Zero(), Vec3(x, y, z), {x, y, z}}); }

Mesh of_triangles(const Vectors& X, const Table<3>& nodes) { return {X, {}, {{"p", nodes}}, {}, {}}; }

/// The findings by name, as in "inverted 3 4".
std::vector<std::string> said(const std::vector<Finding>& findings) {
  std::vector<std::string> all;
  for (const Finding& one : findings) {
    std::string& text = all.emplace_back(words(one.flaw).name);
    for (const Index e : one.elements) text += " " + std::to_string(e);
  }
  return all;
}

using Said = std::vector<std::string>;

TEST(Judge, FindsNothingInOurShapes) {
  EXPECT_EQ(said(judge(brick())), Said{});
  EXPECT_EQ(said(judge(cylinder("a", {0.3, 0.7, Revolution::full, 3, 2, 4}))), Said{});
  EXPECT_EQ(said(judge(sphere("a", {1, SpherePart::full, 2, 2}))), Said{});
  EXPECT_EQ(said(judge(wedge("a", {0.3, 0.5, 0.01, 1, 3, 2}))), Said{});
  EXPECT_EQ(said(judge(tube("a", {1, 1, Revolution::full, 2, 2}))), Said{});
  EXPECT_EQ(said(judge(disc("a", {1, Revolution::full, 2, 2}))), Said{});
}

TEST(Judge, FindsNodesThatAreExchangedWhereTheVolumeIsPositive) {
  Mesh twisted = brick();
  std::swap(twisted.hexahedra[0].nodes(0, 1), twisted.hexahedra[0].nodes(1, 1));
  EXPECT_EQ(said(judge(twisted))[0], "inverted 1");
  Mesh inside_out = brick(1, 1, 1);
  inside_out.hexahedra[0].nodes.topRows(4).swap(inside_out.hexahedra[0].nodes.bottomRows(4));
  EXPECT_EQ(said(judge(inside_out)), Said{"inverted 0"});
}

TEST(Judge, TellsADentFromAnInversion) {
  Mesh mesh = brick(1, 1, 1);  // one corner is moved along the diagonal: J = 1 - 3 d there, and 0 at the Gauss point near it at d = 0.536
  const auto dent = [&](double d) {
    mesh.X.col(mesh.hexahedra[0].nodes(0, 0)) = Vec3(d, d, d);
    return said(judge(mesh));
  };
  EXPECT_EQ(dent(0.33), Said{});
  EXPECT_EQ(dent(0.34), Said{"dented 0"});
  EXPECT_EQ(dent(0.53), Said{"dented 0"});
  EXPECT_EQ(dent(0.54), Said{"inverted 0"});
}

/// A hexahedron whose corners are these of six points: those of a wedge, or of a pyramid and a point above it.
Said of_corners(const std::array<Index, 8>& corners, bool wedge) {
  Mesh mesh;
  mesh.X.resize(3, 6);
  if (wedge) mesh.X << 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 1, 1;
  else mesh.X << 0, 1, 1, 0, 0.5, 0, 0, 0, 1, 1, 0.5, 0, 0, 0, 0, 0, 1, 1;
  mesh.hexahedra = {{"b", Eigen::Map<const Table<8>>(corners.data(), 8, 1)}};
  return said(judge(mesh));
}

TEST(Judge, TellsWedgesPyramidsAndTetrahedraFromCornersThatCoincideOtherwise) {
  for (const auto& corners : {std::array<Index, 8>{0, 1, 2, 2, 3, 4, 5, 5}, {0, 0, 1, 2, 3, 3, 4, 5}, {0, 3, 4, 1, 2, 5, 5, 2}})
    EXPECT_EQ(of_corners(corners, true), Said{}) << corners[1];
  for (const auto& corners : {std::array<Index, 8>{0, 1, 2, 3, 4, 4, 4, 4}, {0, 1, 3, 3, 4, 4, 4, 4}, {0, 1, 1, 3, 4, 4, 4, 4}})
    EXPECT_EQ(of_corners(corners, false), Said{}) << corners[2];
  EXPECT_EQ(of_corners({0, 1, 3, 4, 4, 4, 4, 4}, false), Said{"misfolded 0"});
  EXPECT_NE(of_corners({0, 1, 2, 3, 4, 5, 4, 5}, false), Said{});
}

TEST(Judge, FindsElementsThatStandThereTwice) {
  Mesh twice = brick();
  twice.hexahedra.push_back({"c", twice.hexahedra[0].nodes.col(5)});
  EXPECT_EQ(said(judge(twice)), Said{"repeated 5 8"});
}

TEST(Judge, FindsHexahedraThatShareAFaceAndOverlap) {
  Mesh mesh = brick(2, 1, 1);
  const Vec3 out(0, 0, 0.5);
  const Index nodes = static_cast<Index>(mesh.X.cols());
  Table<8> third = mesh.hexahedra[0].nodes.col(0);  // on the lower face of the first, and half as high
  mesh.X.conservativeResize(3, nodes + 4);
  for (int a = 0; a < 4; ++a) mesh.X.col(nodes + a) = mesh.X.col(third(a)) + out, third(a + 4) = nodes + a;
  mesh.hexahedra.push_back({"c", third});
  EXPECT_EQ(said(judge(mesh)), Said{"same_side 0 2"});
  Table<8> fourth = third;
  for (int a = 0; a < 4; ++a) fourth(a) = third(a), fourth(a + 4) = mesh.hexahedra[0].nodes(a + 4, 1);
  mesh.hexahedra.push_back({"d", fourth});
  EXPECT_EQ(said(judge(mesh))[0], "crowded 0 2 3");
}

TEST(Judge, FindsTrianglesOnTheSameNodesInEitherOrder) {
  Vectors X(3, 4);
  X << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  Table<3> nodes(3, 3);
  nodes << 0, 2, 1, 1, 3, 0, 2, 0, 2;
  EXPECT_EQ(said(judge(of_triangles(X, nodes))), Said{"repeated 0 2"});
}

TEST(Judge, FindsTrianglesThatLieOnEachOtherAndThoseWhoseNormalsAreOpposed) {
  Vectors X(3, 5);
  X << 0, 1, 1, 0, 0.5, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0.7;
  Table<3> nodes(3, 2);
  nodes << 0, 0, 1, 2, 2, 3;
  EXPECT_EQ(said(judge(of_triangles(X, nodes))), Said{});  // both halves of a square
  nodes << 0, 0, 1, 3, 2, 2;
  EXPECT_EQ(said(judge(of_triangles(X, nodes))), Said{"opposed 0 1"});
  nodes << 0, 0, 1, 1, 2, 3;  // halves of the square by its two cuts
  EXPECT_EQ(said(judge(of_triangles(X, nodes))), Said{"flat_fold 0 1"});
  Table<3> three(3, 3);
  three << 0, 1, 0, 1, 0, 1, 2, 4, 3;  // at one edge, two of them on each other: of three nobody can say whose normal is opposed
  EXPECT_EQ(said(judge(of_triangles(X, three))), Said{"flat_fold 0 2"});
  X.col(3) = Vec3(0.2, -1, 0);  // a plate with a web
  EXPECT_EQ(said(judge(of_triangles(X, three))), Said{});
}

TEST(Judge, FindsQuadrilateralsThatAreThereTwiceWhateverTheirCut) {
  Vectors X(3, 4);
  X << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  Table<3> nodes(3, 4);
  nodes << 0, 2, 1, 3, 1, 3, 2, 0, 2, 0, 3, 1;
  const Origin origin{{7, 7, 9, 9}, 0};
  const std::vector<Finding> found = judge(of_triangles(X, nodes), origin);
  ASSERT_EQ(said(found)[0], "repeated 0 2");
  EXPECT_EQ(in_words(found[0], origin, "cells"), "2 elements on the same nodes as another one: cells 7, 9");
}

TEST(Judge, FindsQuadrilateralsWhoseSidesCrossAndTrianglesWithoutArea) {
  Vectors X(3, 4);
  X << 0, 1, 1, 0, 0, 1, 0, 1, 0, 0, 0, 0;
  Table<3> nodes(3, 2);
  nodes << 0, 2, 1, 3, 2, 0;
  EXPECT_EQ(said(judge(of_triangles(X, nodes), {{3, 3}, 0})), Said{"folded 0 1"});
  EXPECT_EQ(said(judge(of_triangles(X, nodes))), Said{"flat_fold 0 1"});  // two triangles on one side of an edge may be meant
  X.col(1) = Vec3(0.5, 0, 0);
  EXPECT_EQ(said(judge(of_triangles(X, nodes))), Said{"no_area 0"});
}

TEST(Judge, FindsElementsThatHaveLostTheirDigits) {
  Mesh mesh = brick();
  mesh.X.colwise() += Vec3(1e15, 0, 0);
  EXPECT_EQ(said(judge(mesh)), Said{"far_away 0 1 2 3 4 5 6 7"});
  EXPECT_EQ(said(judge_digits(mesh)), said(judge(mesh)));
  mesh.X.colwise() -= Vec3(1e15 - 1e6, 0, 0);
  EXPECT_EQ(said(judge(mesh)), Said{});
  Mesh point = brick(1, 1, 1);
  point.X.colwise() += Vec3(1e30, 1e30, 1e30);
  EXPECT_EQ(said(judge(point)), Said{"far_away 0"});
}

TEST(Judge, FindsNodesThatCoincideAndAreNotOne) {
  Mesh two = join(brick(1, 1, 1), box("c", {Vec3(1, 0, 0), Vec3(2, 1, 1), {1, 1, 1}}));
  EXPECT_EQ(said(judge(two)), Said{"coincident 0 1"});
  two.X.rightCols(8).row(0).array() += 0.9e-5;
  EXPECT_EQ(said(judge(two)), Said{"coincident 0 1"});
  two.X.rightCols(8).row(0).array() += 0.2e-5;
  EXPECT_EQ(said(judge(two)), Said{});
}

TEST(Judge, FindsElementsAtThePlacesOfOthers) {
  const Mesh two = join(brick(), box("c", {Vec3::Zero(), Vec3(2, 2, 1), {2, 2, 1}}));
  EXPECT_EQ(said(judge(two))[1].substr(0, 9), "laid_over");
  const std::vector<Overlay> found = overlays(two);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].regions, (std::array<std::string, 2>{"b", "c"}));
  EXPECT_EQ(found[0].elements, (std::vector<Index>{8, 9, 10, 11}));
  EXPECT_TRUE(overlays(brick()).empty());
}

TEST(Judge, FindsHingesOfSolidsAtAnEdgeOrACorner) {
  Mesh mesh = brick(2, 2, 1);
  Table<8> two(8, 2);
  two << mesh.hexahedra[0].nodes.col(0), mesh.hexahedra[0].nodes.col(3);  // across the edge in the middle
  mesh.hexahedra[0].nodes = two;
  EXPECT_EQ(said(judge(mesh)), Said{"hinged 0 1"});
  Mesh whole = brick();
  whole.hexahedra[0].nodes.conservativeResize(8, 7);  // without the last all still hang together
  EXPECT_EQ(said(judge(whole)), Said{});
}

TEST(Judge, FindsHingesOfPlatesAtACornerAndOfPlatesThatStandOnSolids) {
  Vectors X(3, 5);
  X << 0, 1, 0, -1, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0;
  Table<3> nodes(3, 2);
  nodes << 0, 0, 1, 3, 2, 4;
  EXPECT_EQ(said(judge(of_triangles(X, nodes))), Said{"hinged 0 1"});
  Mesh mesh = brick(1, 1, 1);
  const auto& corner = mesh.hexahedra[0].nodes;
  mesh.triangles = {{"skin", Table<3>(3, 1)}};
  mesh.triangles[0].nodes << corner(4), corner(5), corner(6);
  EXPECT_EQ(said(judge(mesh)), Said{});
  mesh.X.conservativeResize(3, 9);
  mesh.X.col(8) = Vec3(0, 0, 2);
  mesh.triangles[0].nodes << corner(4), corner(5), 8;
  EXPECT_EQ(said(judge(mesh)), Said{"hinged 0 1"});
}

TEST(InWords, NamesEightElementsAsTheirOriginDoes) {
  Finding all{Flaw::hinged, {}};
  Origin origin;
  for (Index e = 0; e < 9; ++e) all.elements.push_back(e), origin.numbers.push_back(100 - e);
  const std::string phrase = "joined to others by an edge or a corner only, as by a hinge: ";
  EXPECT_EQ(in_words(all, origin), "9 elements " + phrase + "elements 92, 93, 94, 95, 96, 97, 98, 99, …");
  EXPECT_EQ(in_words({Flaw::hinged, {3}}, {}, "cells"), "1 element " + phrase + "cells 3");
  EXPECT_EQ(refused({all, {Flaw::inverted, {1}}}).size(), 1U);
  EXPECT_EQ(refused({all, {Flaw::inverted, {1}}}, false)[0].flaw, Flaw::hinged);
}

TEST(Offenders, HoldTheElementsAtFaultWithTheirNumbersAndFlaws) {
  const Mesh mesh = join(brick(2, 1, 1), sheet("s", {1, 1, 1, 1}));
  const Offenders shown = offenders("it", mesh, {{5, 6, 7, 8}, 0}, {{Flaw::inverted, {1}}, {Flaw::hinged, {1, 3}}});
  EXPECT_EQ(shown.of, "it");
  EXPECT_EQ(shown.hexahedra.cols(), 1);
  EXPECT_EQ(shown.triangles.cols(), 1);
  EXPECT_EQ(shown.numbers, (std::vector<std::int64_t>{6, 8}));
  EXPECT_EQ(shown.flaws, (std::vector<std::int32_t>{(1 << 1) + (1 << 10), 1 << 10}));
  for (int a = 0; a < 8; ++a) EXPECT_EQ(shown.X.col(shown.hexahedra(a, 0)), mesh.X.col(mesh.hexahedra[0].nodes(a, 1)));
  EXPECT_EQ(shown.X.cols(), 11);
}

}  // namespace
}  // namespace nereid::mesh::judge_test
