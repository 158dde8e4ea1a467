#include "dynamics/connect.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/check.hpp"
#include "contact/penalty/impact_step.hpp"
#include "dynamics/step.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/placement.hpp"
#include "mesh/wedge.hpp"

namespace nereid::dynamics::connect_test {
namespace {

const material::Elastic soft{1000, 1e8, 0.3}, hard{8000, 2e11, 0.25};
double modulus(const material::Elastic& law) {  // of uniaxial strain
  return law.young * (1 - law.poisson) / ((1 + law.poisson) * (1 - 2 * law.poisson));
}

/// A soft box of height 0.4 in 4 layers below a hard one in 2 layers of 0.3, with a gap.
Model two_boxes(double gap) {
  Model model;
  model.mesh =
      mesh::join(mesh::box("below", {{0, 0, 0}, {1, 1, 0.4}, {4, 4, 4}}),
                 mesh::box("above", {{0.1, 0.1, 0.4 + gap}, {0.9, 0.9, 1 + gap}, {3, 3, 2}}));
  model.blocks.push_back(element::hexahedra(model.mesh, "below", soft, {}));
  model.blocks.push_back(element::hexahedra(model.mesh, "above", hard, {}));
  finalize(model);
  return model;
}

TEST(SurfaceStiffness, OfHexahedraIsTheModulusOverTheirDepth) {
  Model model = two_boxes(0.01);
  model.blocks[1] = element::solids(model.mesh, "above", hard, element::FullHexahedron::Options{});
  const auto of = [&](const char* name) {
    return surface_stiffness(model, mesh::surface(model.mesh, name));
  };
  EXPECT_NEAR(of("below.z_high") / (modulus(soft) / 0.1), 1, 1e-12);
  EXPECT_NEAR(of("below.x_low") / (modulus(soft) / 0.25), 1, 1e-12);
  EXPECT_NEAR(of("above.z_low") / (modulus(hard) / 0.3), 1, 1e-12);
}

TEST(SurfaceStiffness, IsThatOfTheStiffestElement) {
  Model model = two_boxes(0.01);
  const Index layer = 5 * 5;
  for (Index node = 4 * layer; node < 4 * layer + 5; ++node)
    model.mesh.X(2, node) = 0.36;  // one edge lower
  model.blocks[0] = element::hexahedra(model.mesh, "below", soft, {});
  finalize(model);
  const double lowest = modulus(soft) / 0.08;  // mean depth of the row at the lowered edge, nearly
  const double k = surface_stiffness(model, mesh::surface(model.mesh, "below.z_high"));
  EXPECT_NEAR(k / lowest, 1, 0.03);
  EXPECT_GT(k, 1.1 * modulus(soft) / 0.1);
}

TEST(SurfaceStiffness, OfPlatesIsTheModulusOverTheThickness) {
  Model model;
  model.mesh = mesh::tube("tube", {0.5, 2, mesh::Revolution::full, 2, 6});
  element::Plate::Options plate;
  plate.thickness = 0.02;
  model.blocks.push_back(element::plates(model.mesh, "tube", hard, plate));
  finalize(model);
  EXPECT_NEAR(
      surface_stiffness(model, mesh::surface(model.mesh, "tube.inside")) / (modulus(hard) / 0.02),
      1, 1e-12);
}

TEST(SurfaceStiffness, CountsAWedgeAtTheAxisOnce) {
  Model model;
  model.mesh = mesh::wedge("core", {0.5, 0.4, 0.3, 1, 3, 4});
  model.blocks.push_back(element::hexahedra(model.mesh, "core", hard, {}));
  finalize(model);
  for (const char* name : {"core.top", "core.bottom"})
    EXPECT_NEAR(surface_stiffness(model, mesh::surface(model.mesh, name)) / (modulus(hard) / 0.1), 1, 1e-12);  // round-off
}

TEST(SurfaceDepth, IsThatOfTheFlattestElement) {
  Model model = two_boxes(0.01);
  EXPECT_NEAR(surface_depth(model, mesh::surface(model.mesh, "below.z_high")), 0.1, 1e-12);
  EXPECT_NEAR(surface_depth(model, mesh::surface(model.mesh, "below.x_low")), 0.25, 1e-12);
  connect(model, "joint", "above.z_low", "below.z_high", {});
  EXPECT_NEAR(std::get<contact::Interface>(model.contacts[0]).depth, 0.1, 1e-12);  // the other side has 0.3
  model.blocks.pop_back();
  EXPECT_EQ(surface_depth(model, mesh::surface(model.mesh, "above.z_low")), 0);
}

TEST(SurfaceDepth, OfASkinIsThatBehindEachOfItsSides) {
  Model model;
  model.mesh = mesh::box("cube", {{0, 0, 0}, {1, 1, 1}, {4, 2, 1}});
  mesh::Surface skin{"cube.skin", Table<3>(3, 0)};
  for (const mesh::Surface& side : model.mesh.surfaces) {
    const Table<3> before = skin.facets;
    skin.facets.resize(3, before.cols() + side.facets.cols());
    skin.facets << before, side.facets;
  }
  model.blocks.push_back(element::hexahedra(model.mesh, "cube", soft, {}));
  finalize(model);
  EXPECT_NEAR(surface_depth(model, skin), 0.25, 1e-12);  // across x, though corner elements have four more faces on the skin
  EXPECT_NEAR(surface_stiffness(model, skin) / (modulus(soft) / 0.25), 1, 1e-12);
  const mesh::Surface low = mesh::surface(model.mesh, "cube.z_low");
  EXPECT_NEAR(surface_depth(model, low), 1, 1e-12);
}

TEST(SurfaceStiffness, OfASurfaceWithoutElementsIsZero) {
  Model model = two_boxes(0.01);
  model.blocks.pop_back();
  EXPECT_EQ(surface_stiffness(model, mesh::surface(model.mesh, "above.z_low")), 0);
}

TEST(Connect, ThePenaltyOfARigidBodyIsThatOfTheOtherSide) {
  for (const int rigid : {0, 1, 2}) {  // the soft one below, the hard one above, both
    Model model = two_boxes(0.01);
    model.rigid_of_block = {rigid == 1 ? -1 : 0, rigid == 0 ? -1 : rigid == 1 ? 0 : 1};
    for (const char* name : {"below", "above"})
      if (rigid == 2 || (rigid == 0) == (std::string_view(name) == "below"))
        model.rigid_bodies.push_back(
            rigid::make_body(name, {1, Vec3::Zero(), Mat3::Identity()}, model.mesh.X, mesh::node_set(model.mesh, name)));
    model.held_bodies.resize(model.rigid_bodies.size());
    model.longest_step = 1e-3;
    finalize(model);
    connect(model, "joint", "above.z_low", "below.z_high", {});
    const double soft_side = modulus(soft) / 0.1, hard_side = modulus(hard) / 0.3;
    EXPECT_NEAR(std::get<contact::Interface>(model.contacts[0]).penalty / (20 * (rigid == 0 ? hard_side : soft_side)), 1, 1e-12) << rigid;
  }
}

TEST(Connect, ThePenaltyChosenIsHardnessTimesTheSofterSide) {
  for (const bool swapped : {false, true}) {
    Model model = two_boxes(0.01);
    InterfaceOptions options{.method = contact::Method::penalty};
    options.penalty_scale = 7;
    const char* names[] = {"above.z_low", "below.z_high"};
    connect(model, "joint", names[swapped], names[!swapped], options);
    EXPECT_NEAR(std::get<contact::Interface>(model.contacts[0]).penalty / (7 * modulus(soft) / 0.1), 1, 1e-12);
    EXPECT_EQ(std::get<contact::Interface>(model.contacts[0]).name, "joint");
  }
}

TEST(Connect, SurfacesNeedNotMatch) {
  for (const double angle : {0.0, 0.3, pi / 4}) {
    Model model;
    const Vec3 middle(0.5, 0.5, 0);
    const mesh::Mesh below = mesh::box("below", {{0, 0, 0}, {1, 1, 0.4}, {4, 4, 2}});
    const mesh::Mesh above = mesh::moved(
        mesh::rotated_about(mesh::box("above", {{0.2, 0.2, 0}, {0.8, 0.8, 0.3}, {3, 3, 1}}), Vec3::UnitZ(), angle, middle), {0, 0, 0.4});
    model.mesh = mesh::join(below, above);
    for (const char* name : {"below", "above"}) model.blocks.push_back(element::hexahedra(model.mesh, name, soft, {}));
    finalize(model);
    const mesh::Surface &top = mesh::surface(model.mesh, "below.z_high"), &bottom = mesh::surface(model.mesh, "above.z_low");
    EXPECT_NEAR(mesh::facet_areas(model.mesh, top).sum(), 1, 1e-14);       // round-off
    EXPECT_NEAR(mesh::facet_areas(model.mesh, bottom).sum(), 0.36, 1e-14);
    for (const auto& [surface, up] : {std::pair(&top, 1.0), std::pair(&bottom, -1.0)}) {
      for (const auto& facet : surface->facets.colwise()) {
        const Vec3 a = model.mesh.X.col(facet(1)) - model.mesh.X.col(facet(0)), b = model.mesh.X.col(facet(2)) - model.mesh.X.col(facet(0));
        EXPECT_NEAR(a.cross(b).normalized().z(), up, 1e-14);
      }
    }
    const Connected joined = connect(model, "joint", "above.z_low", "below.z_high", {})[0];
    EXPECT_EQ(joined.gaps.apexes, 16);
    EXPECT_EQ(joined.gaps.without_base, 0);
    EXPECT_NEAR(joined.gaps.least, 0, 1e-15);
    EXPECT_NEAR(joined.gaps.largest, 0, 1e-15);
  }
}

TEST(Connect, AGivenPenaltyIsTaken) {
  Model model = two_boxes(0.01);
  InterfaceOptions options{.method = contact::Method::penalty};
  options.penalty = 3e9;
  options.energy_gain_limit = 1e-3;
  connect(model, "joint", "above.z_low", "below.z_high", options);
  EXPECT_EQ(std::get<contact::Interface>(model.contacts[0]).penalty, 3e9);
  EXPECT_EQ(std::get<contact::Interface>(model.contacts[0]).impact_step_factor, contact::impact_step_factor_for(1e-3));
}

TEST(Connect, WithoutElementsOnOneSideAPenaltyIsNeeded) {
  Model model = two_boxes(0.01);
  model.blocks.pop_back();
  EXPECT_THROW(connect(model, "joint", "above.z_low", "below.z_high", {}), InternalError);
}

TEST(Connect, ApexesCarryTheAreaOfTheirSurface) {
  Model model = two_boxes(0.01);
  connect(model, "joint", "above.z_low", "below.z_high", {});
  const contact::Interface& joint = std::get<contact::Interface>(model.contacts[0]);
  EXPECT_EQ(joint.apexes, mesh::node_set(model.mesh, "above.z_low"));
  EXPECT_NEAR(joint.area.sum(), 0.64, 1e-14);
  EXPECT_NEAR(joint.facet_area.sum(), 1, 1e-14);
}

TEST(Connect, ContactHeightFromTheInitialHeightLeavesTheClearance) {
  Model model = two_boxes(0.01);
  InterfaceOptions options{.method = contact::Method::penalty};
  options.height.clearance = 0.002;
  const Connected joint = connect(model, "joint", "above.z_low", "below.z_high", options).front();
  EXPECT_EQ(joint.gaps.apexes, 16);
  EXPECT_EQ(joint.gaps.without_base, 0);
  EXPECT_EQ(joint.gaps.penetrating, 0);
  EXPECT_NEAR(joint.gaps.least, 0.002, 1e-15);
  EXPECT_NEAR(joint.gaps.mean, 0.002, 1e-15);
  EXPECT_NEAR(joint.gaps.largest, 0.002, 1e-15);
}

TEST(Connect, AGivenContactHeightLeavesTheGapOfTheGeometry) {
  Model model = two_boxes(0.01);
  InterfaceOptions options{.method = contact::Method::penalty};
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  const Connected joint = connect(model, "joint", "above.z_low", "below.z_high", options).front();
  EXPECT_NEAR(joint.gaps.least, 0.01, 1e-15);
  EXPECT_NEAR(joint.gaps.largest, 0.01, 1e-15);
}

TEST(Connect, PenetrationsAreReportedAndWhereAcceptedRemoved) {
  for (const auto wanted :
       {contact::InitialPenetration::refuse, contact::InitialPenetration::accept}) {
    Model model = two_boxes(0.01);
    InterfaceOptions options{.method = contact::Method::penalty};
    options.height = {.from_initial_height = false, .clearance = 0, .given = 0.015};
    options.initial_penetration = wanted;
    const Connected joint = connect(model, "joint", "above.z_low", "below.z_high", options).front();
    EXPECT_EQ(joint.gaps.penetrating, 16);
    EXPECT_NEAR(joint.gaps.deepest, 0.005, 1e-15);
    EXPECT_NEAR(joint.gaps.least, wanted == contact::InitialPenetration::accept ? 0 : -0.005,
                1e-15);
  }
}

TEST(Connect, AnOverlapThatIsAcceptedMovesNothingAndIsNoPenetration) {
  for (const auto heights : {contact::Heights::nodes, contact::Heights::points})
    for (const auto method : {contact::Method::multiplier, contact::Method::penalty})
      for (const double overlap : {0.002, 0.02}) {  // of elements 0.1 m deep
        Model model = two_boxes(-overlap);
        InterfaceOptions options;
        options.method = method, options.heights = heights, options.two_passes = heights == contact::Heights::points;
        options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
        options.initial_penetration = contact::InitialPenetration::accept;
        std::vector<contact::AnyMemory> memories;
        for (Connected& one : connect(model, "joint", "above.z_low", "below.z_high", options)) memories.push_back(std::move(one.memory));
        State state = initial_state(model, memories);
        Forces forces = make_forces(model);
        start(model, state, forces);
        const double dt = 0.5 * state.step_limits.elements.step;
        for (int i = 0; i < 5; ++i) step(model, dt, state, forces);
        SCOPED_TRACE((heights == contact::Heights::points ? "points " : "nodes ") + std::to_string(static_cast<int>(method)));
        EXPECT_LT(state.v.cwiseAbs().maxCoeff(), 1e-9 * overlap / dt);
        for (const contact::AnyMemory& any : state.contacts) {
          EXPECT_LT(contact::sides(any).deepest, 1e-9 * overlap);
          if (!std::holds_alternative<contact::Memory>(any)) continue;
          for (const contact::Near& near : std::get<contact::Memory>(any).near)
            EXPECT_GT(std::get<contact::Memory>(any).gap[static_cast<std::size_t>(near.apex)], -1e-9 * overlap);
        }
      }
}

TEST(Connect, RoundOffIsNoPenetration) {
  // where surfaces meet at z = 0 the round-off of a map or a rotation is larger than any part of the height itself
  for (const double depth : {1e-22, 1e-9}) {
    Model model;
    model.mesh = mesh::join(mesh::box("below", {{0, 0, -0.4}, {1, 1, 0}, {4, 4, 2}}),
                            mesh::box("above", {{0, 0, -depth}, {1, 1, 0.4}, {3, 3, 2}}));
    for (const char* name : {"below", "above"}) model.blocks.push_back(element::hexahedra(model.mesh, name, soft, {}));
    finalize(model);
    InterfaceOptions options{.method = contact::Method::penalty};
    options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
    const Connected joint = connect(model, "joint", "above.z_low", "below.z_high", options)[0];
    EXPECT_EQ(joint.gaps.penetrating, 0);
    EXPECT_EQ(joint.gaps.slight_overlaps.size(), depth > 1e-12 ? 1U : 0U);
  }
}

/// The gaps are those of the geometry.
const contact::ContactHeight geometric{.from_initial_height = false, .clearance = 0, .given = 0};

/// Two boxes of elements 0.2 m deep that overlap.
Model overlapping(double depth) {
  Model model;
  model.mesh = mesh::join(mesh::box("below", {{0, 0, -0.4}, {1, 1, 0}, {4, 4, 2}}),
                          mesh::box("above", {{0, 0, -depth}, {1, 1, 0.4 - depth}, {3, 3, 2}}));
  for (const char* name : {"below", "above"}) model.blocks.push_back(element::hexahedra(model.mesh, name, soft, {}));
  finalize(model);
  return model;
}

TEST(Connect, OverlapsOfAMillionthOfAnElementAreContactAndListed) {
  for (const auto& [depth, is_slight] : {std::pair{1e-10, true}, {1.9e-7, true}, {2.1e-7, false}, {1e-3, false}}) {
    Model model = overlapping(depth);
    const Connected joint = connect(model, "joint", "above.z_low", "below.z_high", {.height = geometric})[0];
    EXPECT_EQ(joint.gaps.penetrating, is_slight ? 0 : 16) << depth;
    ASSERT_EQ(joint.gaps.slight_overlaps.size(), is_slight ? 1U : 0U) << depth;
    if (!is_slight) continue;
    EXPECT_EQ(joint.gaps.slight_overlaps[0].count, 16);
    EXPECT_NEAR(joint.gaps.slight_overlaps[0].deepest, depth, 1e-15);
    EXPECT_EQ(joint.gaps.least, 0) << "nothing is pushed";
  }
}

TEST(Connect, GapsAndHeightsAreThoseOfTheStart) {
  const double overlap = 0.01;
  Model model = overlapping(overlap);
  Vectors start = model.mesh.X;
  for (const Index node : mesh::node_set(model.mesh, "above")) start(2, node) += 3 * overlap;
  const InterfaceOptions options{.height = geometric};
  EXPECT_EQ(connect(model, "reference", "above.z_low", "below.z_high", options)[0].gaps.penetrating, 16);
  const contact::InitialGaps gaps = connect(model, "joint", "above.z_low", "below.z_high", options, &start)[0].gaps;
  EXPECT_EQ(gaps.penetrating, 0);
  EXPECT_NEAR(gaps.least, 2 * overlap, 1e-15);
  EXPECT_NEAR(gaps.largest, 2 * overlap, 1e-15);
}

TEST(Connect, ApexesOnSymmetryPlanesKnowTheDirectionsTheseAllow) {
  Model model;
  model.mesh = mesh::join(mesh::cylinder("core", {0.5, 1, mesh::Revolution::quarter, 2, 2, 3}),
                          mesh::tube("skin", {0.51, 1, mesh::Revolution::quarter, 2, 3}));
  element::Plate::Options plate;
  plate.thickness = 0.01;
  model.blocks.push_back(element::hexahedra(model.mesh, "core", soft, {}));
  model.blocks.push_back(element::plates(model.mesh, "skin", hard, plate));
  for (int axis = 0; axis < 2; ++axis) {
    load::Plane p;
    p.kind = load::PlaneKind::symmetry;
    p.normal = Vec3::Unit(axis);
    for (const std::string body : {"core", "skin"}) {
      const Subset& nodes =
          mesh::node_set(model.mesh, body + (axis == 0 ? ".x_plane" : ".y_plane"));
      p.nodes.insert(p.nodes.end(), nodes.begin(), nodes.end());
    }
    model.constraints.planes.push_back(p);
  }
  load::Plane clamp;  // no mirror, so contact does not know of it
  clamp.normal = Vec3::UnitZ();
  clamp.nodes = mesh::node_set(model.mesh, "core.side");
  model.constraints.planes.push_back(clamp);
  finalize(model);
  const Connected joint = connect(model, "joint", "core.side", "skin.inside", {}).front();
  const contact::Interface& interface = std::get<contact::Interface>(model.contacts[0]);
  ASSERT_EQ(interface.allowed.size(), interface.apexes.size());
  int on_planes = 0;
  for (std::size_t a = 0; a < interface.apexes.size(); ++a) {
    const Vec3 at = model.mesh.X.col(interface.apexes[a]);
    Mat3 expected = Mat3::Identity();
    for (int axis = 0; axis < 2; ++axis)
      if (at(axis) == 0) expected(axis, axis) = 0, ++on_planes;
    EXPECT_EQ(interface.allowed[a], expected);
  }
  EXPECT_EQ(on_planes, 8);
  EXPECT_EQ(joint.gaps.without_base, 0);
}

TEST(Connect, TwoPassesAreTwoInterfacesOfHalfThePenalty) {
  Model model = two_boxes(0.01);
  InterfaceOptions options{.method = contact::Method::penalty};
  options.two_passes = true;
  const std::vector<Connected> passes = connect(model, "joint", "above.z_low", "below.z_high", options);
  ASSERT_EQ(passes.size(), 3U);
  EXPECT_EQ(std::get<contact::Interface>(model.contacts[1]).name, "joint_back");
  EXPECT_EQ(std::get<contact::Interface>(model.contacts[1]).apexes, mesh::node_set(model.mesh, "below.z_high"));
  EXPECT_EQ(contact::sides(model.contacts[2]).name, "joint_edges");
  EXPECT_TRUE(contact::by_multipliers(model.contacts[2]));  // a crossing has no area for a penalty
  model.contacts.pop_back();
  for (const auto& pass : model.contacts) EXPECT_NEAR(contact::sides(pass).penalty / (0.5 * 20 * modulus(soft) / 0.1), 1, 1e-12);
}

StepLimits votes_of_matching_boxes(InterfaceOptions options, bool two_passes) {
  Model model;
  model.mesh = mesh::join(mesh::box("below", {{0, 0, 0}, {1, 1, 0.4}, {3, 3, 2}}),
                          mesh::box("above", {{0, 0, 0.4}, {1, 1, 0.8}, {3, 3, 2}}));
  model.blocks.push_back(element::hexahedra(model.mesh, "below", soft, {}));
  model.blocks.push_back(element::hexahedra(model.mesh, "above", soft, {}));
  finalize(model);
  options.two_passes = two_passes;
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  std::vector<contact::AnyMemory> memories;
  for (const Connected& pass : connect(model, "joint", "above.z_low", "below.z_high", options)) memories.push_back(pass.memory);
  State state = initial_state(model, memories);
  Forces forces = make_forces(model);
  return start(model, state, forces);
}

TEST(Connect, TwoPassesOverTheSameNodesKeepTheBoundTogether) {
  // Where the grids match, two passes are one: half the springs from either side between the same pairs of nodes.
  for (const auto kind : {contact::InterfaceKind::contact, contact::InterfaceKind::tied}) {
    InterfaceOptions options{.method = contact::Method::penalty};
    options.kind = kind;
    const double one = votes_of_matching_boxes(options, false).contact.step, two = votes_of_matching_boxes(options, true).contact.step;
    EXPECT_NEAR(two / one, 1, 1e-12);  // round-off
  }
}

TEST(Connect, WithoutSymmetryPlanesEveryDirectionIsAllowed) {
  Model model = two_boxes(0.01);
  load::Plane clamp;
  clamp.nodes = mesh::node_set(model.mesh, "above.z_low");
  model.constraints.planes.push_back(clamp);
  connect(model, "joint", "above.z_low", "below.z_high", {});
  EXPECT_TRUE(std::get<contact::Interface>(model.contacts[0]).allowed.empty());
}

}  // namespace
}  // namespace nereid::dynamics::connect_test
