#include "contact/search/near.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

namespace nereid::contact::near_test {
namespace {

/// Six apexes over six nodes of a base, as they were at the last search.
struct Scene {
  Sides sides;
  SidesMemory memory;
  Vectors then = Vectors::Random(3, 12);

  Scene() {
    sides.apexes = {0, 1, 2, 3, 4, 5}, sides.base_nodes = {6, 7, 8, 9, 10, 11};
    memory.apexes_then = memory.base_then = Vectors::Zero(3, 6);
    keep_search(sides, then, memory);
  }
  /// By how much an apex and a node of the base have come nearer to each other, or gone apart, at the most.
  double most_changed(const Vectors& x) const {
    double most = 0;
    for (const Index a : sides.apexes)
      for (const Index b : sides.base_nodes)
        most = std::max(most, std::abs((x.col(a) - x.col(b)).norm() - (then.col(a) - then.col(b)).norm()));
    return most;
  }
};

/// Positions of one side after a turn about a point, and after random ways of its nodes.
Vectors turned(const Vectors& x, double angle, const Vec3& about) {
  const Mat3 turn = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return (turn * (x.colwise() - about)).colwise() + about;
}
Vectors scattered(const Vectors& x, double way) { return x + way * Vectors::Random(3, x.cols()); }

TEST(MovedSinceSearch, IsNoLessThanNodesOfBothSidesHaveComeNearerWhicheverMoves) {
  using Motion = std::function<Vectors(const Vectors&, double)>;
  const Motion rests = [](const Vectors& x, double) { return x; };
  const Motion turns_about_a_node = [](const Vectors& x, double t) { return turned(x, t, x.col(0)); };
  const Motion turns_about_its_middle = [](const Vectors& x, double t) { return turned(x, t, x.rowwise().mean()); };
  const Motion flies = [](const Vectors& x, double t) { return Vectors(x.colwise() + Vec3(3, -1, 2) * t); };
  const Motion deforms = [](const Vectors& x, double t) { return scattered(x, t); };
  const std::vector<Motion> all{rests, turns_about_a_node, turns_about_its_middle, flies, deforms};
  for (std::size_t one = 0; one < all.size(); ++one)
    for (std::size_t other = 0; other < all.size(); ++other) {
      Scene scene;
      for (double t = 0; t < 1; t += 0.1) {
        Vectors x = scene.then;
        x.leftCols(6) = all[one](scene.then.leftCols(6), t), x.rightCols(6) = all[other](scene.then.rightCols(6), t);
        EXPECT_GE(moved_since_search(scene.sides, x, scene.memory), scene.most_changed(x) - 1e-12) << one << " " << other << " " << t;
      }
    }
}

TEST(MovedSinceSearch, CountsNoWayThatBothSidesGoTogether) {
  Scene scene;
  for (double t = 0; t < 1; t += 0.1) {
    const Vectors x = scene.then.colwise() + Vec3(300, -100, 200) * t;
    EXPECT_LT(moved_since_search(scene.sides, x, scene.memory), 1e-12 * 400);
  }
}

TEST(MovedSinceSearch, OfManyBodiesIsNoLessThanAnyTwoNodesHaveComeNearer) {
  Scene scene;
  scene.sides.bodies.names = {"one", "other"};
  scene.sides.apexes = scene.sides.base_nodes = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  scene.memory.apexes_then = scene.memory.base_then = Vectors::Zero(3, 12);
  keep_search(scene.sides, scene.then, scene.memory);
  for (double t = 0; t < 1; t += 0.1) {
    Vectors x = scene.then;
    x.leftCols(6) = turned(scene.then.leftCols(6), t, scene.then.col(0)).colwise() + Vec3(3, 0, 0) * t;
    x.rightCols(6) = scattered(scene.then.rightCols(6), t).colwise() - Vec3(3, 0, 0) * t;
    EXPECT_GE(moved_since_search(scene.sides, x, scene.memory), scene.most_changed(x) - 1e-12) << t;
  }
}

}  // namespace
}  // namespace nereid::contact::near_test
