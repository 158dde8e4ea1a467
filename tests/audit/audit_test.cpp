#include "audit/audit.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/parallel.hpp"
#include "tests/audit/bodies.hpp"

namespace nereid::audit::audit_test {
namespace {

/// Two cubes of side 1 with n cells along each edge, the second above the first and `depth` in it.
mesh::Mesh stacked(double depth, int n = 4, int m = 4, double aside = 0.07) {
  return mesh::join(block("a", Vec3::Ones(), {n, n, n}),
                    mesh::moved(block("b", Vec3::Ones(), {m, m, m}), Vec3(aside, 1.3 * aside, 1 - depth)));
}

TEST(Overlap, OfCubesIsTheDepthAtAnyPlaceScaleAndRotation) {
  const double depth = 0.03;
  const mesh::Mesh cubes = stacked(depth);
  for (const double scale : {1.0, 1e-9, 1e6})
    for (const double far : {0.0, 1e6})
      for (const double angle : {0.0, 0.3, 1.1, 2.9}) {
        const Found at = found(placed_anywhere(cubes, Vec3(1, 2, -0.5), angle, scale, far * scale * Vec3(1, -1, 0.5)));
        EXPECT_NEAR(at.deepest / scale, depth, far > 0 ? 1e-8 : 1e-12) << scale << " " << far << " " << angle;
        EXPECT_NEAR(in_elements(at.worst), depth / 0.25, 1e-6);
      }
}

TEST(Overlap, OfCubesOfUnlikeMeshesIsMeasuredInTheSmallerElement) {
  const Found at = found(stacked(0.02, 2, 10));
  EXPECT_NEAR(at.deepest, 0.02, 1e-12);
  EXPECT_NEAR(in_elements(at.worst), 0.2, 1e-6);
  EXPECT_NEAR(at.worst.place.z(), 0.48, 1e-12);
  EXPECT_LE(at.worst.place.cwiseAbs().maxCoeff(), 0.6);
}

TEST(Overlap, OfFacesThatTouchIsNothing) {
  for (const double aside : {0.0, 0.25, 0.1})
    for (const double angle : {0.0, 0.7}) {
      const mesh::Mesh cubes = placed_anywhere(stacked(0, 4, 4, aside), Vec3(1, 2, 3), angle, 1, Vec3(3, 4, 5));
      EXPECT_EQ(found(cubes).deepest, 0) << aside << " " << angle;
    }
  EXPECT_EQ(found(stacked(0, 4, 3, 0)).deepest, 0);
  EXPECT_EQ(found(stacked(-0.5)).deepest, 0);
}

TEST(Overlap, OfBarsWhoseSidesAreFlushIsFoundByTheMiddlesOfFaces) {
  const mesh::Mesh bars = mesh::join(block("a", {4, 1, 1}, {4, 1, 1}), mesh::moved(block("b", {4, 1, 1}, {4, 1, 1}), Vec3(3.8, 0, 0)));
  EXPECT_NEAR(found(bars).deepest, 0.2, 1e-12);
}

TEST(Overlap, OfBodiesInTheSamePlaceIsFoundHalfAnElementBehindTheirFaces) {
  EXPECT_NEAR(found(stacked(1, 4, 4, 0)).deepest, 0.125, 1e-12);
}

TEST(Overlap, OfABodyWithAnExactShapeIsMeasuredFromThatShape) {
  const mesh::Cylinder bar{.radius = 1, .length = 4, .turn = mesh::Revolution::full, .cells_core = 2, .cells_ring = 2, .cells_along = 4};
  const Vec3 beside = 1.47 * Vec3(std::cos(pi / 8), std::sin(pi / 8), 0) + Vec3(0, 0, 2);
  const mesh::Mesh all = mesh::join(mesh::cylinder("bar", bar), mesh::moved(block("cube", Vec3::Ones(), {4, 4, 4}), beside));
  Surfaces surfaces = audit::surfaces(all, {});
  for (Surface& surface : surfaces.list) {
    if (surface.nodes[0] != 0) continue;
    Subset nodes = surface.nodes;
    surface.round = mesh::tied(*mesh::round_of(bar), {.centre = mesh::centre_of(bar)}, all.X, nodes);
  }
  Workspace work = make_workspace(std::move(surfaces));
  place(all.X, work);
  double least = 1;  // of the corners of the cube from the axis
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) least = std::min(least, std::hypot(1.47 * std::cos(pi / 8) + x, 1.47 * std::sin(pi / 8) + y));
  EXPECT_NEAR(overlap(work, 0, 1).deepest, 1 - least, 1e-12);
}

TEST(Overlap, OfACubeWithinACubeIsHowFarItsDeepestPointIsFromTheSkin) {
  const mesh::Mesh cubes = mesh::join(block("shell", Vec3::Constant(4), {4, 4, 4}), block("core", Vec3::Ones(), {2, 2, 2}));
  EXPECT_NEAR(found(cubes).deepest, 1.75, 1e-12);  // half an element behind the middle of a face
  EXPECT_EQ(found(cubes).worst.region, (std::array<Index, 2>{1, 0}));
}

TEST(Overlap, OfCrossingBarsHasNoNodeInTheOther) {
  const double depth = 0.04;
  for (const double angle : {pi / 2, 0.6, 1.2}) {
    const mesh::Mesh bars = mesh::join(
        block("a", {6, 1, 1}, {1, 1, 1}),
        mesh::moved(mesh::rotated_about(block("b", {6, 1, 1}, {1, 1, 1}), Vec3::UnitZ(), angle, Vec3::Zero()), Vec3(0, 0, 1 - depth)));
    EXPECT_NEAR(found(bars).deepest, depth, 1e-12) << angle;
  }
}

TEST(Overlap, OfRidgesThatCrossIsTheDistanceFromTheFlanks) {
  const double depth = 0.05;
  const auto ridge = [](const std::string& name) {
    return mesh::rotated_about(block(name, {6, 1, 1}, {1, 1, 1}), Vec3::UnitX(), pi / 4, Vec3::Zero());
  };
  const mesh::Mesh bars = mesh::join(ridge("a"), mesh::moved(mesh::rotated_about(ridge("b"), Vec3::UnitZ(), pi / 2, Vec3::Zero()),
                                                             Vec3(0, 0, std::sqrt(2.0) - depth)));
  EXPECT_NEAR(found(bars).deepest, depth / std::sqrt(2.0), 1e-9);
}

TEST(Overlap, OfASheetThatPokesIntoABlockIsHowFar) {
  const double depth = 0.03;
  const mesh::Mesh upright = mesh::rotated_about(plate("sheet", 1, 1, 3, 3), Vec3::UnitX(), pi / 2, Vec3::Zero());
  const mesh::Mesh bodies = mesh::join(block("block", {3, 3, 1}, {5, 5, 2}), mesh::moved(upright, Vec3(0.05, 0.02, 1 - depth)));
  EXPECT_NEAR(found(bodies).deepest, depth, 1e-12);
}

TEST(Overlap, OfASheetThroughABlockWithoutANodeInIt) {
  const mesh::Mesh sheet = mesh::moved(plate("sheet", 9, 9, 1, 1), Vec3(0.1, 0.2, 0.46));
  const mesh::Mesh bodies = mesh::join(block("block", Vec3::Ones(), {3, 3, 3}), sheet);
  EXPECT_NEAR(found(bodies).deepest, 0.04 + 0.005, 1e-12) << "half the thickness more";
}

/// A cube of side 1 with its top at the origin, and a plate whose middle is at a height.
mesh::Mesh under_plate(double height, int cells = 7) {
  return mesh::join(mesh::moved(block("block", Vec3::Ones(), {3, 3, 3}), Vec3(0.013, 0.007, -0.5)),
                    mesh::moved(plate("plate", 3, 3, cells, cells), Vec3(0, 0, height)));
}

TEST(Overlap, OfAPlateThatABlockRestsOnIsNothing) {
  for (const double round_off : {0.0, 1e-14, 1e-13, -1e-14}) {
    EXPECT_EQ(found(under_plate(0.05 + round_off), 0, 1, 0.1).deepest, 0) << round_off;
    EXPECT_NEAR(found(under_plate(round_off), 0, 1, 0.1).deepest, 0.05, 1e-9) << "on the mid-surface, from one side " << round_off;
    EXPECT_NEAR(found(under_plate(round_off), 0, 1, 0).deepest, 0, 1e-9) << "without a thickness " << round_off;
  }
}

TEST(Overlap, OfABlockInAPlateIsTheDepthFromEitherSide) {
  const double thickness = 0.1;
  for (const int cells : {1, 7})
    for (const double depth : {0.03, 0.05, 0.08, 0.1, 0.2})  // up to the mid-surface, past it, out at the other side
      for (const double angle : {0.0, 0.4, pi}) {
        const mesh::Mesh bodies = placed_anywhere(under_plate(thickness / 2 - depth, cells), Vec3(1, 0.2, 0), angle, 1, Vec3(0.3, 0, 0));
        EXPECT_NEAR(found(bodies, 0, 1, thickness).deepest, depth, 1e-12) << cells << " " << depth << " " << angle;
        EXPECT_NEAR(in_elements(found(bodies, 0, 1, thickness).worst), depth / thickness, 1e-9);
      }
}

/// A plate with a crease along y, `rise` high, under a block whose nodes all stand over it, `gap` over its flat parts.
mesh::Mesh creased(double rise, double gap) {
  mesh::Mesh sheet = plate("plate", 4, 4, 8, 8);
  for (Index n = 0; n < sheet.X.cols(); ++n)
    if (std::abs(sheet.X(0, n)) < 1e-9) sheet.X(2, n) = rise;
  return mesh::join(mesh::moved(block("block", {2, 2, 1}, {1, 1, 1}), Vec3(0.01, 0.02, 0.5 + gap)), sheet);
}

TEST(Overlap, OfACreaseOfAPlateBetweenTheNodesOfABlockIsHowFarTheBlockIsBehindIt) {
  const double thickness = 1e-3, rise = 0.05, gap = 0.03;
  const double slope = std::atan(rise / 0.5);  // of the flanks
  const Found at = found(creased(rise, gap), 0, 1, thickness);
  // of the edge along x: at half of the piece that is behind the crease it is nearly below its top; not the height of the block
  EXPECT_NEAR(at.deepest, (rise - gap) * std::cos(slope) + thickness / 2, 0.1 * (rise - gap));
  EXPECT_EQ(found(creased(rise, rise + thickness), 0, 1, thickness).deepest, 0);
}

/// A wall of one layer whose face is warped by `way`, and a block that is in it by `depth`.
mesh::Mesh warped_wall(double thickness, double way, double depth) {
  mesh::Mesh wall = block("wall", {4, 4, thickness}, {1, 1, 1});
  for (Index n = 0; n < wall.X.cols(); ++n) wall.X(2, n) += 0.25 * way * wall.X(0, n) * wall.X(1, n);
  return mesh::join(mesh::moved(block("block", {0.1, 0.1, 1}, {1, 1, 1}), Vec3(0, 0, 0.5 + thickness / 2 - depth)), wall);
}

TEST(Overlap, IsNotSureWhereBentFacesLeaveMoreOpenThanElementsAreThick) {
  const double thickness = 0.1;
  const Found flat = found(warped_wall(thickness, 0, 0.04));
  EXPECT_NEAR(in_elements(flat.worst), 0.4, 1e-9);
  EXPECT_NEAR(surely_in_elements(flat.surest), 0.4, 1e-9);
  const Found slightly = found(warped_wall(thickness, 0.09, 0.04));  // less than the thickness
  EXPECT_NEAR(slightly.worst.open, 0.09, 1e-9);
  EXPECT_EQ(unsure(slightly.worst), 0);
  EXPECT_NEAR(surely_in_elements(slightly.surest), in_elements(slightly.worst), 1e-12);
  const Found bent = found(warped_wall(thickness, 0.3, 0.04));
  EXPECT_NEAR(unsure(bent.worst), 0.3 - thickness, 1e-9);
  EXPECT_GT(in_elements(bent.worst), 0.2);
  EXPECT_EQ(bent.surest.depth, 0) << "none of it is sure";
}

TEST(Overlap, OfABlockThatIsThroughABentFoilIsSure) {
  const double thickness = 1e-5;
  mesh::Mesh foil = plate("foil", 4, 4, 8, 8);
  for (Index n = 0; n < foil.X.cols(); ++n) foil.X(2, n) = 0.02 * foil.X.col(n).head<2>().squaredNorm();
  const mesh::Mesh cube = mesh::moved(block("block", Vec3::Ones(), {2, 2, 2}), Vec3(0.1, 0.2, 0.2));
  const Found through = found(mesh::join(cube, foil), 0, 1, thickness);
  EXPECT_GT(unsure(through.worst), 50 * thickness);
  EXPECT_GT(surely_in_elements(through.surest), 1e4);
}

TEST(Overlap, OfAPlateWhollyInABlockIsThatOfItsDeepestPoint) {
  const mesh::Mesh inner = mesh::moved(plate("plate", 0.5, 0.5, 2, 2), Vec3(0, 0, 0.2));
  const mesh::Mesh bodies = mesh::join(block("block", Vec3::Ones(), {3, 3, 3}), inner);
  EXPECT_NEAR(found(bodies, 0, 1, 0.1).deepest, 0.35, 1e-12);
}

TEST(Overlap, OfPlatesIsHowFarTheirShellsAreInEachOther) {
  const auto over = [](double height, int cells) {
    return mesh::join(plate("a", 3, 3, 7, 7), mesh::moved(plate("b", 1, 1, cells, cells), Vec3(0.013, 0.007, height)));
  };
  for (const int cells : {1, 3}) {
    EXPECT_EQ(found(over(0.1, cells), 0, 1, 0.1).deepest, 0);
    EXPECT_NEAR(found(over(0.07, cells), 0, 1, 0.1).deepest, 0.03, 1e-12);
    EXPECT_NEAR(found(over(-0.07, cells), 0, 1, 0.1).deepest, 0.03, 1e-12);
    EXPECT_NEAR(found(over(0, cells), 0, 1, 0.1).deepest, 0.1, 1e-12) << "out of the plate by all of the thickness";
  }
}

TEST(Overlap, OfAPlateStartsAtItsRim) {
  const auto beside = [](double gap) {
    return mesh::join(block("block", Vec3::Ones(), {3, 3, 3}), mesh::moved(plate("plate", 3, 3, 4, 4), Vec3(2 + gap, 0.013, 0.1)));
  };
  EXPECT_EQ(found(beside(0.001), 0, 1, 0.1).deepest, 0);
  EXPECT_NEAR(found(beside(-0.02), 0, 1, 0.1).deepest, 0.02, 1e-12);
}

TEST(Overlap, OfAPlateAtAPlaneOfSymmetryIsAsIfItWentOn) {
  const double thickness = 0.1, depth = 0.04;
  mesh::Mesh bodies = mesh::join(mesh::box("block", {Vec3(0, -0.5, -1), Vec3(1, 0.5, 0), {1, 1, 1}}),
                                 mesh::moved(mesh::sheet("plate", {3, 3, 2, 2}), Vec3(0, -1.4, thickness / 2 - depth)));
  Symmetry plane{Vec3::UnitX(), {}};
  for (Index n = 0; n < bodies.X.cols(); ++n)
    if (bodies.X(0, n) == 0) plane.nodes.push_back(n);
  Workspace work = workspace_of(bodies, thickness, {plane});
  EXPECT_NEAR(found(work, bodies.X).deepest, depth, 1e-12);
  for (Index n = 0; n < 8; ++n)
    if (bodies.X(0, n) == 1) bodies.X(0, n) = 0.02;  // a thin block: on the plane of symmetry there is no way out
  EXPECT_NEAR(found(work, bodies.X).deepest, depth, 1e-12);
}

/// Three plates that meet at an edge, the third upright; their normals agree or not.
mesh::Mesh joint(bool turned) {
  mesh::Mesh mesh = plate("plates", 2, 2, 2, 2);
  const auto n = static_cast<Index>(mesh.X.cols());
  mesh.X.conservativeResize(3, n + 2);
  mesh.X.col(n) = Vec3(0, -1, -1), mesh.X.col(n + 1) = Vec3(0, 0, -1);
  Index low = -1, middle = -1;
  for (Index i = 0; i < n; ++i)
    if (mesh.X(0, i) == 0 && mesh.X(1, i) <= 0) (mesh.X(1, i) < 0 ? low : middle) = i;
  Table<3>& nodes = mesh.triangles[0].nodes;
  const auto count = static_cast<Index>(nodes.cols());
  nodes.conservativeResize(3, count + 2);
  nodes.col(count) << low, n, middle;
  nodes.col(count + 1) << middle, n, n + 1;
  if (turned)
    for (Index e = 0; e < count; e += 3) std::swap(nodes(0, e), nodes(1, e));
  return mesh;
}

TEST(Overlap, OfPlatesThatMeetAtAnEdgeIsThatOfOneShell) {
  const double thickness = 0.1;
  for (const bool turned : {false, true}) {
    const auto with = [&](double depth) {
      return mesh::join(joint(turned), mesh::moved(block("block", Vec3::Constant(0.6), {2, 2, 2}),
                                                   Vec3(0.05, 0.03, 0.3 + thickness / 2 - depth)));
    };
    EXPECT_EQ(found(with(-0.001), 0, 1, thickness).deepest, 0);
    EXPECT_NEAR(found(with(0.03), 0, 1, thickness).deepest, 0.03, 1e-12) << turned;
  }
}

TEST(Overlap, OfTheBorderOfASheetInTheSideOfABlockIsHowFarTheBorderIsIn) {
  const mesh::Mesh sheet = mesh::moved(plate("sheet", 3, 9, 1, 1), Vec3(1.98, 0, 0.1));
  const mesh::Mesh bodies = mesh::join(block("block", Vec3::Ones(), {2, 2, 2}), sheet);
  EXPECT_NEAR(found(bodies).deepest, 0.02, 1e-12);
}

TEST(Overlap, OfASheetThroughASheetIsTheShortestWayOut) {
  const double depth = 0.03;
  for (const int cells : {1, 6}) {
    const mesh::Mesh upright = mesh::rotated_about(plate("a", 1, 1, 3, 3), Vec3::UnitX(), pi / 2, Vec3::Zero());
    const mesh::Mesh bodies = mesh::join(mesh::moved(upright, Vec3(0.01, 0.02, 0.5 - depth)), plate("b", 3, 3, cells, cells));
    EXPECT_NEAR(found(bodies).deepest, depth + 0.005, 1e-12) << cells;
  }
}

TEST(Overlap, OfABlockThatBulgesThroughASheetAtItsRimIsTheBulge) {
  const mesh::Mesh upright = mesh::rotated_about(plate("sheet", 5.5, 9, 1, 1), Vec3::UnitY(), pi / 2, Vec3::Zero());
  mesh::Mesh bodies = mesh::join(block("block", Vec3::Ones(), {1, 1, 1}), mesh::moved(upright, Vec3(0.5, 0, 2.25)));
  for (Index n = 0; n < 8; ++n)
    if (bodies.X(0, n) > 0) bodies.X(0, n) += bodies.X(2, n) < 0 ? 0.02 : -0.05;  // the lower corners stand over the rim
  EXPECT_NEAR(found(bodies).deepest, 0.02 + 0.005, 1e-12);
}

/// A strip along x, bent about the y axis so that its second half comes back over the first at a height, its end lowered.
mesh::Mesh folded(mesh::Mesh strip, double height, double lowered = 0) {
  for (Index n = 0; n < strip.X.cols(); ++n) {
    Vec3 x = strip.X.col(n);
    if (x.x() > 2) {
      const double turn = std::min(x.x() - 2, 2.0) / 2 * pi, on = std::max(x.x() - 4, 0.0);
      const double middle = height / 2, out = middle - x.z();
      x = Vec3(2 + out * std::sin(turn) - on, x.y(), middle - out * std::cos(turn) - lowered * std::clamp(2 * on - 0.4, 0.0, 1.0));
    }
    strip.X.col(n) = x;
  }
  return strip;
}

TEST(OverlapWithItself, OfAFoldedStripIsTheDepthOfOneLayerInTheOther) {
  const mesh::Mesh strip = mesh::box("strip", {Vec3(0, 0, -0.1), Vec3(5.53, 1, 0.1), {40, 4, 1}});
  Workspace work = workspace_of(strip);
  EXPECT_EQ(found(work, strip.X, 0, 0).deepest, 0);
  EXPECT_EQ(found(work, folded(strip, 0.5, 0.25).X, 0, 0).deepest, 0);
  EXPECT_NEAR(found(work, folded(strip, 0.5, 0.33).X, 0, 0).deepest, 0.03, 1e-9);
}

TEST(OverlapWithItself, OfANodeThatComesOutBelowAThinLayerIsHowFarItHasComeOut) {
  mesh::Mesh layered = mesh::box("box", {Vec3::Zero(), Vec3(2, 2, 2), {2, 2, 2}});
  Index rim = -1;
  for (Index n = 0; n < layered.X.cols(); ++n) {
    if (layered.X(2, n) == 2) layered.X(2, n) = 1.001;
    if ((layered.X.col(n) - Vec3(1, 2, 1.001)).norm() < 1e-9) rim = n;
  }
  Workspace work = workspace_of(layered);
  Vectors x = layered.X;
  EXPECT_EQ(found(work, x, 0, 0).deepest, 0);
  x.col(rim) = Vec3(1.01, 2.0005, 0.998);  // before the face below; the other end of its edge is a metre behind that, where it belongs
  const Found here = found(work, x, 0, 0);
  EXPECT_GT(here.deepest, 1e-4);
  EXPECT_LT(here.deepest, 3e-3) << "so far it is below its layer";
}

TEST(OverlapWithItself, OfASheetIsFoundWhereItGoesThroughItself) {
  const mesh::Mesh sheet = mesh::sheet("sheet", {5.53, 1, 40, 4});
  Workspace work = workspace_of(sheet);
  EXPECT_EQ(found(work, folded(sheet, 0.2).X, 0, 0).deepest, 0);
  EXPECT_NEAR(found(work, folded(sheet, 0.2, 0.23).X, 0, 0).deepest, 0.03, 1e-9);
}

TEST(OverlapWithItself, OfASheetIsFoundWhereItsRimGoesThroughIt) {
  const mesh::Mesh sheet = mesh::sheet("sheet", {4, 4, 4, 4});
  Workspace work = workspace_of(sheet);
  Vectors x = sheet.X;
  const auto at = [&](double X, double Y) {
    Eigen::Index node = 0;
    (sheet.X.colwise() - Vec3(X, Y, 0)).colwise().squaredNorm().minCoeff(&node);
    return x.col(node);
  };
  const Vec3 corner = sheet.X.rowwise().minCoeff();
  at(corner.x() + 1, corner.y()) += Vec3(0, 0, 0.3);
  at(corner.x(), corner.y()) += Vec3(2.6, 1.6, -0.1);  // only an edge of the rim goes through the sheet
  EXPECT_NEAR(found(work, x, 0, 0).deepest, 0.1, 1e-9) << "not zero, how far it is from itself";
}

TEST(Overlap, OnAPlaneOfSymmetryDoesNotHideBehindIt) {
  const auto two = [](double begin) {
    const mesh::Mesh a = mesh::box("a", {Vec3::Zero(), Vec3(4, 1, 1), {4, 1, 1}});
    return mesh::join(a, mesh::box("b", {Vec3(begin, 0, 0), Vec3(8, 1, 1), {4, 1, 1}}));
  };
  const mesh::Mesh bars = two(3.8);
  std::vector<Symmetry> planes(2);
  for (int axis = 1; axis < 3; ++axis) {
    planes[axis - 1].normal = Vec3::Unit(axis);
    for (Index n = 0; n < bars.X.cols(); ++n)
      if (bars.X(axis, n) == 0) planes[axis - 1].nodes.push_back(n);
  }
  Workspace work = workspace_of(bars, 0, planes);
  EXPECT_NEAR(found(work, bars.X).deepest, 0.2, 1e-9);
  EXPECT_EQ(found(work, two(4).X).deepest, 0);
}

TEST(Overlap, OfPositionsThatAreNoNumbersOrTurnedInsideOutIsNoCrash) {
  const mesh::Mesh cubes = stacked(0.1);
  Workspace work = workspace_of(cubes);
  Vectors x = cubes.X;
  x(1, 7) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(found(work, x).deepest, 0);
  x = cubes.X;
  x.row(0) *= -1;
  found(work, x);
  x.setZero();
  EXPECT_EQ(found(work, x).deepest, 0);
  Memory memory;
  x = cubes.X, x(0, 0) = std::numeric_limits<double>::infinity();
  look(x, 0, true, work, memory);
  EXPECT_TRUE(memory.overlaps.empty());
}

TEST(Look, CountsOnlyWhatGrowsAndAfterPartingAll) {
  const mesh::Mesh cubes = stacked(0.1);
  Workspace work = workspace_of(cubes);
  Memory memory;
  look(cubes.X, 0, true, work, memory);
  ASSERT_EQ(memory.overlaps.size(), 1U);
  EXPECT_NEAR(memory.overlaps[0].at_start, 0.1, 1e-12);
  EXPECT_EQ(memory.overlaps[0].grown, 0);
  look(stacked(0.15).X, 1, true, work, memory);
  EXPECT_NEAR(worst(memory)->grown, 0.05 / 0.25, 1e-9);
  EXPECT_NEAR(worst(memory)->worst.depth, 0.15, 1e-12);
  EXPECT_EQ(worst(memory)->time, 1);
  look(stacked(-0.1).X, 2, true, work, memory);
  look(stacked(0.12).X, 3, true, work, memory);
  EXPECT_NEAR(worst(memory)->grown, 0.12 / 0.25, 1e-9);
  EXPECT_NEAR(worst(memory)->deepest, 0.15, 1e-12);
  EXPECT_EQ(memory.looks, 4);
}

TEST(Look, KeepsWhatIsSureBesideWhatIsDeepest) {
  const mesh::Mesh apart = warped_wall(0.1, 0.3, -0.5);
  Workspace work = workspace_of(apart);
  Memory memory;
  look(apart.X, 0, true, work, memory);
  look(warped_wall(0.1, 0.3, 0.04).X, 1, true, work, memory);
  ASSERT_EQ(memory.overlaps.size(), 1U);
  EXPECT_GT(worst(memory)->grown, 0.2);
  EXPECT_EQ(surest(memory)->sure, 0);
  look(warped_wall(0.1, 0, 0.03).X, 2, true, work, memory);
  EXPECT_NEAR(surest(memory)->sure, 0.3, 1e-9);
  EXPECT_EQ(surest(memory)->sure_time, 2);
  EXPECT_EQ(worst(memory)->time, 1);
}

TEST(Look, CountsAsSureWhatIsBeyondTheGapOfBentFaces) {
  const mesh::Mesh apart = warped_wall(0.1, 0.12, -0.5);
  Workspace work = workspace_of(apart);
  Memory memory;
  look(apart.X, 0, true, work, memory);
  look(warped_wall(0.1, 0.12, 0.04).X, 1, true, work, memory);
  const double sure = surely_in_elements(found(warped_wall(0.1, 0.12, 0.04)).surest);
  EXPECT_GT(sure, 0.1);
  EXPECT_GT(worst(memory)->grown, sure + 0.1);
  EXPECT_NEAR(surest(memory)->sure, sure, 1e-9);
}

TEST(Look, CountsOfAPlateWhatGrows) {
  const mesh::Mesh start = under_plate(0.03);
  Workspace work = workspace_of(start, 0.1);
  Memory memory;
  look(start.X, 0, true, work, memory);
  ASSERT_EQ(memory.overlaps.size(), 1U);
  EXPECT_NEAR(memory.overlaps[0].at_start, 0.02, 1e-12);
  EXPECT_EQ(memory.overlaps[0].grown, 0);
  look(under_plate(-0.01).X, 1, true, work, memory);
  EXPECT_NEAR(worst(memory)->grown, 0.4, 1e-9) << "0.06 deep, 0.02 of it from the start";
}

TEST(Look, CountsOnlyBeyondWhatIsAllowed) {
  const mesh::Mesh apart = under_plate(0.2);
  Workspace work = workspace_of(apart, 0.1);
  work.allowed[{0, 1}] = 0.05;
  Memory memory;
  look(apart.X, 0, true, work, memory);
  look(under_plate(0.001).X, 1, true, work, memory);
  EXPECT_NEAR(worst(memory)->deepest, 0.049, 1e-12);
  EXPECT_EQ(worst(memory)->grown, 0);
  look(under_plate(-0.02).X, 2, true, work, memory);
  EXPECT_NEAR(worst(memory)->grown, 0.2, 1e-9);
}

TEST(Look, HasTheSameBitsWithAnyNumberOfThreads) {
  const mesh::Mesh cubes = placed_anywhere(stacked(0.11, 20, 17), Vec3(1, 2, 3), 0.4, 1, Vec3::Zero());
  const int before = threads();
  use_threads(1);
  const Found one = found(cubes);
  use_threads(3);
  const Found three = found(cubes);
  use_threads(before);
  EXPECT_EQ(one.deepest, three.deepest);
  EXPECT_EQ(one.worst.place, three.worst.place);
  EXPECT_EQ(one.worst.region, three.worst.region);
}

TEST(Look, IsOverBeforeAnyPointWhereBodiesAreApart) {
  const auto looked_at = [](double overlap_of_them) {
    const mesh::Mesh cubes = stacked(overlap_of_them, 5, 4);
    Workspace work = workspace_of(cubes);
    work.inside.assign(500, 7);  // of no point
    found(work, cubes.X);
    return std::count_if(work.inside.begin(), work.inside.end(), [](char inside) { return inside != 7; });
  };
  EXPECT_EQ(looked_at(-0.3), 0);
  EXPECT_GT(looked_at(0.1), 0);
}

}  // namespace
}  // namespace nereid::audit::audit_test
