#include "dynamics/automatic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/side.hpp"
#include "dynamics/step.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/box.hpp"
#include "mesh/disc.hpp"
#include "mesh/placement.hpp"
#include "mesh/skin.hpp"
#include "rigid/mass.hpp"
#include "tests/dynamics/scene.hpp"

namespace nereid::dynamics::automatic_test {
namespace {

const material::Elastic soft{1000, 1e8, 0.3}, hard{8000, 2e11, 0.25};

mesh::Mesh box(const std::string& name, const Vec3& low, const Vec3& high) {
  mesh::Mesh mesh = mesh::box(name, {low, high, {3, 3, 2}});
  mesh.surfaces.push_back({name + ".skin", mesh::skin(mesh.X, mesh.hexahedra).facets});
  return mesh;
}

mesh::Mesh plate(const std::string& name, const Vec3& at) {
  mesh::Mesh mesh = mesh::moved(mesh::sheet(name, {.length = 1, .width = 1, .cells_along = 5, .cells_across = 5}), at);
  mesh.surfaces.push_back({name + ".skin", mesh::both_sides(mesh.triangles[0].nodes)});
  return mesh;
}

/// A soft box below, a plate 0.02 thick 0.05 above it, and a hard box 0.05 above that.
Model pile() {
  Model model;
  const mesh::Mesh lower = mesh::join(box("below", {0, 0, 0}, {1, 1, 0.4}), plate("plate", {0, 0, 0.45}));
  model.mesh = mesh::join(lower, box("above", {0, 0, 0.5}, {1, 1, 1}));
  model.blocks.push_back(element::hexahedra(model.mesh, "below", soft, {}));
  model.blocks.push_back(element::hexahedra(model.mesh, "above", hard, {}));
  element::Plate::Options options;
  options.thickness = 0.02;
  model.blocks.push_back(element::plates(model.mesh, "plate", hard, options));
  finalize(model);
  return model;
}
const std::vector<TouchingBody> all{{"below", false}, {"plate", true}, {"above", false}};

TEST(ConnectAutomatic, HasOfEachPairWhatTheirSkinsHaveTogether) {
  Model model = pile();
  const std::vector<Connected> connected = connect_automatic(model, "all", all, {}, {});
  ASSERT_EQ(connected.size(), 2U);
  const contact::Interface& nodes = std::get<contact::Interface>(model.contacts[0]);
  EXPECT_EQ(nodes.name, "all");
  EXPECT_EQ(contact::sides(model.contacts[1]).name, "all_edges");
  const auto side = [&](const char* name) { return side_of(model, mesh::surface(model.mesh, std::string(name) + ".skin")); };
  for (std::size_t a = 0; a < nodes.apexes.size(); a += 7)
    for (Index f = 0; f < static_cast<Index>(nodes.base.facets.cols()); f += 11) {
      const Index one = nodes.bodies.of_apex[a], other = nodes.bodies.of_facet[static_cast<std::size_t>(f)];
      const contact::Between expected = between(side(all[static_cast<std::size_t>(one)].name.c_str()),
                                                side(all[static_cast<std::size_t>(other)].name.c_str()), {}, 0.5);
      const contact::Between& pair = contact::between(nodes, static_cast<Index>(a), f);
      EXPECT_EQ(pair.penalty, expected.penalty);
      EXPECT_EQ(pair.impedance, expected.impedance);
      EXPECT_EQ(pair.depth, expected.depth);
      EXPECT_EQ(pair.arm_of_apex, expected.arm_of_apex);
    }
}

TEST(ConnectAutomatic, StandsOffByHalfOfThePlatesOfBothSides) {
  Model model = pile();
  const std::vector<Connected> connected = connect_automatic(model, "all", all, {}, {});
  const contact::Interface& nodes = std::get<contact::Interface>(model.contacts[0]);
  EXPECT_EQ(connected[0].gaps.penetrating, 0);
  EXPECT_NEAR(connected[0].gaps.least, 0.04, 1e-15);  // of boxes over the plate, and of the plate over boxes
  for (std::size_t a = 0; a < nodes.apexes.size(); ++a)
    EXPECT_EQ(nodes.contact_height(static_cast<Index>(a)), nodes.bodies.of_apex[a] == 1 ? 0.01 : 0);
  for (Index f = 0; f < static_cast<Index>(nodes.base.facets.cols()); ++f)
    EXPECT_EQ(contact::stand_off(nodes.base, f), nodes.bodies.of_facet[static_cast<std::size_t>(f)] == 1 ? 0.01 : 0);
}

TEST(ConnectAutomatic, LeavesPairsToOthers) {
  Model model = pile();
  const std::vector<Connected> connected = connect_automatic(model, "all", all, {{"plate", "below"}}, {});
  const contact::Interface& nodes = std::get<contact::Interface>(model.contacts[0]);
  const auto& memory = std::get<contact::Memory>(connected[0].memory);
  for (const contact::Near& near : memory.near)
    for (Index i = 0; i < near.facets; ++i) {
      const Index facet = memory.near_facets[static_cast<std::size_t>(near.first_facet + i)];
      const Index one = nodes.bodies.of_apex[static_cast<std::size_t>(near.apex)];
      const Index other = nodes.bodies.of_facet[static_cast<std::size_t>(facet)];
      EXPECT_FALSE(one + other == 1) << "below and plate";
      EXPECT_FALSE(one == other && one != 1) << "a box touches itself";
    }
  EXPECT_GT(memory.near.size(), 0U);
}

TEST(ConnectAutomatic, OfABodyWithItselfLooksOnlyAtWhatIsNotBesideInTheMesh) {
  Model model;
  model.mesh = mesh::sheet("strip", {.length = 4, .width = 1, .cells_along = 20, .cells_across = 5});
  for (auto x : model.mesh.X.colwise())  // folded, both halves 0.1 apart
    if (x(0) > 2) x = Vec3(4 - x(0), x(1), 0.1);
  model.mesh.surfaces.push_back({"strip.skin", mesh::both_sides(model.mesh.triangles[0].nodes)});
  element::Plate::Options options;
  options.thickness = 0.04;
  model.blocks.push_back(element::plates(model.mesh, "strip", hard, options));
  finalize(model);
  const std::vector<Connected> connected = connect_automatic(model, "all", {{"strip", true}}, {}, {});
  const contact::Interface& nodes = std::get<contact::Interface>(model.contacts[0]);
  const auto& memory = std::get<contact::Memory>(connected[0].memory);
  int seen = 0;
  for (const contact::Near& near : memory.near)
    for (Index i = 0; i < near.facets; ++i, ++seen) {
      const Index facet = memory.near_facets[static_cast<std::size_t>(near.first_facet + i)];
      for (const Index node : nodes.base.facets.col(facet))
        EXPECT_FALSE(contact::is_beside(nodes.base.beside, nodes.apexes[static_cast<std::size_t>(near.apex)], node));
    }
  EXPECT_GT(seen, 100);
  EXPECT_NEAR(connected[0].gaps.least, 0.06, 1e-12);
}

TEST(ConnectAutomatic, OfAPlateThatIsThickerThanItsElementsAreLongStartsApartFromItself) {
  Model model;
  model.mesh = mesh::sheet("strip", {.length = 4, .width = 1, .cells_along = 40, .cells_across = 10});
  model.mesh.surfaces.push_back({"strip.skin", mesh::both_sides(model.mesh.triangles[0].nodes)});
  element::Plate::Options options;
  options.thickness = 0.4;
  model.blocks.push_back(element::plates(model.mesh, "strip", hard, options));
  finalize(model);
  for (const Connected& one : connect_automatic(model, "all", {{"strip", true}}, {}, {})) EXPECT_EQ(one.gaps.penetrating, 0);
}

/// A box of a material, which may be a rigid body.
struct Brick {
  Vec3 size;
  Eigen::Vector3i cells;
  material::Elastic law;
  bool is_rigid = false;
};

/// Heights of contact of one brick over another one, in an automatic contact that lists them in this order or in the other one.
contact::Heights heights_of(const Brick& one, const Brick& other, bool one_first) {
  Model model;
  const Vec3 above(0, 0, one.size.z() + 0.1);
  model.mesh = mesh::join(mesh::box("one", {Vec3::Zero(), one.size, one.cells}),
                          mesh::box("other", {above, above + other.size, other.cells}));
  for (const char* name : {"one", "other"}) {
    const bool is_one = std::string(name) == "one";
    const Brick& brick = is_one ? one : other;
    const Table<8>& nodes = mesh::hexahedra(model.mesh, name).nodes;
    model.mesh.surfaces.push_back({std::string(name) + ".skin", mesh::skin(model.mesh.X, {mesh::hexahedra(model.mesh, name)}).facets});
    model.blocks.push_back(element::hexahedra(model.mesh, name, brick.law, {}));
    model.rigid_of_block.push_back(brick.is_rigid ? static_cast<Index>(model.rigid_bodies.size()) : -1);
    if (!brick.is_rigid) continue;
    rigid::Moments sum;
    rigid::add_hexahedra(model.mesh.X, nodes, brick.law.density, Vec3::Zero(), sum);
    model.rigid_bodies.push_back(
        rigid::make_body(name, rigid::properties(sum, Vec3::Zero()), model.mesh.X, mesh::node_set(model.mesh, name)));
  }
  model.held_bodies.resize(model.rigid_bodies.size());
  finalize(model);
  InterfaceOptions options;
  options.heights = contact::Heights::points;
  std::vector<TouchingBody> list{{"one", false}, {"other", false}};
  if (!one_first) std::swap(list[0], list[1]);
  connect_automatic(model, "all", list, {}, options);
  const contact::Bodies& bodies = std::get<contact::Interface>(model.contacts[0]).bodies;
  const Index place = one_first ? 0 : 1;
  const contact::Between& there = bodies.between[bodies.pair(place, 1 - place)];
  const contact::Between& back = bodies.between[bodies.pair(1 - place, place)];
  EXPECT_NE(there.heights, back.heights) << "one has the apexes over points, the other one guards";
  return there.heights;
}

TEST(ConnectAutomatic, GivesTheApexesToFinerFacesThenToWhatIsNotRigidThenToTheSofterThenToTheSmaller) {
  const Brick usual{Vec3(1, 1, 1), {2, 2, 2}, hard};
  Brick finer = usual, rigid = usual, softer = usual, smaller = usual;
  finer.cells = {3, 3, 3}, rigid.is_rigid = true, softer.law = soft, smaller.size.x() = 0.5, smaller.cells.x() = 1;
  Brick rigid_and_finer = finer, rigid_and_smaller = smaller, softer_and_coarser = softer;
  rigid_and_finer.is_rigid = rigid_and_smaller.is_rigid = true, softer_and_coarser.cells = {1, 1, 1};
  const std::vector<std::pair<Brick, Brick>> apexes_and_guards{{finer, usual},         {rigid_and_finer, usual},    {usual, rigid},
                                                               {usual, rigid_and_smaller}, {usual, softer_and_coarser}, {softer, usual},
                                                               {smaller, usual}};
  for (std::size_t i = 0; i < apexes_and_guards.size(); ++i)
    for (const bool first : {true, false}) {
      const auto& [apexes, guards] = apexes_and_guards[i];
      EXPECT_EQ(heights_of(apexes, guards, first), contact::Heights::points) << i << " " << first;
      EXPECT_EQ(heights_of(guards, apexes, first), contact::Heights::guards) << i << " " << first;
    }
}

constexpr double askew = 0.2;  // [rad]

/// A block that lies askew on a larger one, before anything moves them.
Scene block_on_base() {
  Scene s;
  const auto turned = mesh::rotated_about(box("block", {0, 0, 0}, {1, 1, 0.4}), Vec3::UnitZ(), askew, Vec3::Zero());
  s.model.mesh = mesh::join(box("base", {-0.5, -0.4, -0.5}, {1.6, 1.7, 0}), turned);
  for (const char* name : {"base", "block"}) s.model.blocks.push_back(element::hexahedra(s.model.mesh, name, soft, {}));
  return s;
}

void connect_both(bool automatic, Scene& s) {
  finalize(s.model);
  InterfaceOptions joint;
  joint.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  joint.method = contact::Method::multiplier;
  const auto connected = automatic ? connect_automatic(s.model, "all", {{"base", false}, {"block", false}}, {}, joint)
                                   : connect(s.model, "joint", "block.skin", "base.skin", joint);
  for (const Connected& one : connected) s.memories.push_back(one.memory);
  s.ready();
}

/// What becomes of a base on which a block lies that is turned over one of its edges until it stands on it; how many pairs of edges were
/// left alone in all steps, and how many had a condition.
struct Tipped {
  Vectors x;
  double left_alone = 0, acted = 0;
};
Tipped tip(bool automatic, bool looks_at_all) {
  constexpr double spin = 1;  // [rad/s]
  Scene s = block_on_base();
  const Vec3 edge(-std::sin(askew), std::cos(askew), 0), end(std::cos(askew), std::sin(askew), 0);
  load::Plane turner = plane("turner", load::PlaneKind::driven, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "block"));
  for (int axis = 0; axis < 3; ++axis)
    turner.field[static_cast<std::size_t>(axis)] = [=](double x, double y, double z, double t) {
      const Vec3 arm = Eigen::AngleAxisd(spin * t, edge) * (Vec3(x, y, z) - end);
      return spin * edge.cross(arm)(axis) - (axis == 2 ? 0.001 : 0);  // and down, so that it presses
    };
  s.model.constraints.planes = {turner};
  connect_both(automatic, s);
  const double least = start(s.model, s.state, s.forces).elements.step;
  Tipped found;
  for (int i = 0; s.state.t < 0.6; ++i) {
    for (contact::AnyMemory& any : s.state.contacts) {
      if (!std::holds_alternative<contact::EdgeMemory>(any)) continue;
      contact::EdgeMemory& memory = std::get<contact::EdgeMemory>(any);
      for (const contact::Crossing& crossing : memory.crossings) found.acted += crossing.acts ? 1 : 0;
      for (contact::EdgePair& pair : memory.edge_pairs)
        if (looks_at_all) pair.flat = -INFINITY;
      const double way = automatic ? *std::max_element(memory.way_of_body.begin(), memory.way_of_body.end()) : memory.way;
      const auto is_left = [&](const contact::EdgePair& pair) { return pair.flat > way; };
      found.left_alone += static_cast<double>(std::count_if(memory.edge_pairs.begin(), memory.edge_pairs.end(), is_left));
    }
    step(s.model, (i % 50 < 25 ? 0.5 : 0.3) * least, s.state, s.forces);
  }
  found.x = s.state.x;
  return found;
}

TEST(FlatEdges, AreLeftAloneWithoutChangingABit) {
  for (const bool automatic : {false, true}) {
    const Tipped some = tip(automatic, false), all_of_them = tip(automatic, true);
    EXPECT_EQ(some.acted, all_of_them.acted);
    EXPECT_GT(some.acted, 1000);
    EXPECT_EQ(all_of_them.left_alone, 0);
    EXPECT_GT(some.left_alone, some.acted);
    EXPECT_TRUE((some.x.array() == all_of_them.x.array()).all());
  }
}

/// What becomes of two blocks of which one slides over the other, while both go aside together; how many apexes were pressed in all
/// steps, and how many of them were not looked at in full.
struct Slid {
  Vectors x;
  double pressed = 0, stay = 0;
};
Slid slide(bool automatic, bool looks_at_all) {
  Scene s = block_on_base();
  Subset top, bottom;
  for (Index node = 0; node < s.model.mesh.X.cols(); ++node) {
    if (s.model.mesh.X(2, node) > 0.39) top.push_back(node);
    if (s.model.mesh.X(2, node) < -0.49) bottom.push_back(node);
  }
  load::Plane pusher = plane("pusher", load::PlaneKind::driven, Vec3::UnitZ(), top);
  load::Plane holder = plane("holder", load::PlaneKind::driven, Vec3::UnitZ(), bottom);
  const auto speed = [](double value) { return [=](double, double, double, double) { return value; }; };
  pusher.field = {speed(0.1), speed(0), speed(-0.01)};
  holder.field = {speed(-0.1), speed(0.2), speed(0)};
  s.model.constraints.planes = {pusher, holder};
  connect_both(automatic, s);
  const double dt = 0.5 * start(s.model, s.state, s.forces).elements.step;
  Slid found;
  while (s.state.t < 0.6) {
    for (contact::AnyMemory& any : s.state.contacts) {
      if (!std::holds_alternative<contact::Memory>(any)) continue;
      for (contact::Near& near : std::get<contact::Memory>(any).near) {
        found.pressed += near.pressed > 0 ? 1 : 0;
        found.stay += near.kept != contact::Kept::nothing ? 1 : 0;
        if (looks_at_all) near.safe_distance = near.tracks.owned = -INFINITY;
      }
    }
    step(s.model, dt, s.state, s.forces);
  }
  found.x = s.state.x;
  return found;
}

TEST(ApexesThatStay, AreLeftAloneWithoutChangingWhatComesOut) {
  for (const bool automatic : {false, true}) {
    const Slid some = slide(automatic, false), all_of_them = slide(automatic, true);
    EXPECT_GT(some.pressed, 1000);
    EXPECT_EQ(all_of_them.stay, 0);
    EXPECT_LT((some.x - all_of_them.x).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_GT(some.stay, (automatic ? 0.8 : 0.7) * some.pressed);
  }
}

}  // namespace
}  // namespace nereid::dynamics::automatic_test
