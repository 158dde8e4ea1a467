#include "contact/search/partners.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <memory>

#include "contact/data/workspace.hpp"
#include "tests/contact/surfaces.hpp"

namespace nereid::contact::partners_test {
namespace {

using namespace surfaces;

/// A bar and a cube 2 m beside it, in one automatic contact.
struct Scene {
  Vectors x;
  Interface interface;
  Memory memory;
  std::unique_ptr<Workspace> workspace;
};

Scene bar_and_cube() {
  const Shape bar = block({0, 0, 0}, {3, 1, 1}, {3, 1, 1}), cube = block({5, 0, 0}, {6, 1, 1}, {1, 1, 1});
  Scene scene;
  scene.x.resize(3, bar.x.cols() + cube.x.cols());
  scene.x << bar.x, cube.x;
  Table<3> facets(3, bar.facets.cols() + cube.facets.cols());
  facets << bar.facets, (cube.facets.array() + static_cast<Index>(bar.x.cols())).matrix();
  Interface& in = scene.interface;
  Bodies& bodies = in.bodies;
  bodies.names = {"bar", "cube"};
  bodies.thickest = Scalars::Zero(2);
  bodies.touch = {1, 1, 1, 1};
  bodies.between.resize(4);
  bodies.first_facet = {0, static_cast<Index>(bar.facets.cols()), static_cast<Index>(facets.cols())};
  bodies.of_facet.assign(static_cast<std::size_t>(bar.facets.cols()), 0);
  bodies.of_facet.resize(static_cast<std::size_t>(facets.cols()), 1);
  bodies.first_node = {0, static_cast<Index>(bar.x.cols()), static_cast<Index>(scene.x.cols())};
  for (Index n = 0; n < scene.x.cols(); ++n) {
    bodies.nodes.push_back(n), in.apexes.push_back(n), in.base_nodes.push_back(n);
    bodies.of_apex.push_back(n < bar.x.cols() ? 0 : 1);
  }
  in.base = base_surface({"all", facets}, scene.x, bodies.of_facet);
  in.own = fans(facets, static_cast<Index>(scene.x.cols()));
  in.contact_height = Scalars::Zero(scene.x.cols());
  scene.memory.margin = 0.1;
  scene.memory.slot.assign(in.apexes.size(), -1);
  scene.memory.status.assign(in.apexes.size(), Status::unpaired);
  scene.memory.apart_from_itself.assign(2, 0);
  scene.memory.apart_then = Vectors::Zero(3, scene.x.cols());
  scene.memory.apexes_then = scene.memory.base_then = scene.x;
  scene.workspace = std::make_unique<Workspace>(in);
  return scene;
}

/// Whether a body is its own partner where the nodes are.
bool is_own_partner(Scene& scene, Index body) {
  find_partners(scene.interface, scene.x, scene.memory, *scene.workspace);
  return searches_itself(*scene.workspace, body);
}

TEST(Partners, AreBodiesWhoseBoxesAreNear) {
  Scene scene = bar_and_cube();
  find_partners(scene.interface, scene.x, scene.memory, *scene.workspace);
  EXPECT_EQ(scene.workspace->partners, (Subset{0, 1}));  // each is its own
  scene.x.rightCols(8).row(0).array() -= 1.95;
  find_partners(scene.interface, scene.x, scene.memory, *scene.workspace);
  EXPECT_EQ(scene.workspace->partners, (Subset{0, 1, 0, 1}));
}

TEST(Partners, AreNotBodiesOfThemselvesThatWereApartUntilTheirShapeChanges) {
  Scene scene = bar_and_cube();
  EXPECT_TRUE(is_own_partner(scene, 0));
  keep_apart_from_itself(scene.interface, scene.x, false, *scene.workspace, scene.memory);
  EXPECT_FALSE(is_own_partner(scene, 0));
  EXPECT_EQ(scene.workspace->first_partner[1], scene.workspace->first_partner[2]) << "the cube has no partner";
  scene.x = (Eigen::AngleAxisd(2.5, Vec3(1, 2, 3).normalized()).toRotationMatrix() * scene.x).eval();
  scene.x.colwise() += Vec3(7, -8, 9);  // as a whole
  EXPECT_FALSE(is_own_partner(scene, 0));
  scene.x(1, 2) += 0.02;
  EXPECT_FALSE(is_own_partner(scene, 0));
  scene.x(1, 2) += 0.01;  // more than it was looked for beyond the margin
  EXPECT_TRUE(is_own_partner(scene, 0));
  EXPECT_FALSE(is_own_partner(scene, 1));
  scene.x(1, 2) -= 0.03;
  scene.memory.margin = 0.16;  // more than it was found apart by
  EXPECT_TRUE(is_own_partner(scene, 0));
}

TEST(Partners, OfThemselvesAreBodiesThatASearchFoundNear) {
  Scene scene = bar_and_cube();
  find_partners(scene.interface, scene.x, scene.memory, *scene.workspace);
  scene.workspace->near_itself[0] = 1;
  keep_apart_from_itself(scene.interface, scene.x, false, *scene.workspace, scene.memory);
  EXPECT_TRUE(is_own_partner(scene, 0));
  EXPECT_FALSE(is_own_partner(scene, 1));
  scene.memory.apart_from_itself.assign(2, 0);
  EXPECT_TRUE(is_own_partner(scene, 1));
  scene.workspace->near_itself[0] = 0;
  keep_apart_from_itself(scene.interface, scene.x, true, *scene.workspace, scene.memory);  // plates may become thicker
  EXPECT_TRUE(is_own_partner(scene, 1));
}

}  // namespace
}  // namespace nereid::contact::partners_test
