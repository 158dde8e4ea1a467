#include "output/frames.hpp"

#include <gtest/gtest.h>

#include "dynamics/connect.hpp"
#include "mesh/box.hpp"

namespace nereid::output::frames_test {
namespace {

/// Two cubes of two by two elements, face to face, one with a point per element and one with eight, with a floor; some steps done.
struct Scene {
  dynamics::Model model;
  dynamics::State state;
  dynamics::Forces forces;

  /// against_wall  A moves into a rigid plane behind it instead of into B
  explicit Scene(bool against_wall = false) {
    model.mesh = mesh::join(mesh::box("A", {Vec3::Zero(), Vec3::Ones(), {2, 2, 2}}),
                            mesh::box("B", {Vec3(1, 0, 0), Vec3(2, 1, 1), {2, 2, 2}}));
    const material::Elastic law{1, 1, 0};
    model.blocks.push_back(element::hexahedra(model.mesh, "A", law, {.viscosity = {0, 0}}));
    model.blocks.push_back(element::solids(model.mesh, "B", law, element::FullHexahedron::Options{{0, 0}}));
    model.constraints.planes.push_back({"floor", load::PlaneKind::floor, Vec3::Zero(), Vec3::UnitZ(), mesh::node_set(model.mesh, "A")});
    if (against_wall) {
      contact::RigidPlane wall;
      wall.name = "wall", wall.method = contact::Method::multiplier, wall.normal = Vec3::UnitX();
      wall.nodes = mesh::node_set(model.mesh, "A.x_low");
      wall.area = Scalars::Constant(wall.nodes.size(), 1.0 / 9), wall.impedance = 1;
      model.rigid_planes.push_back(wall);
    }
    dynamics::finalize(model);
    const auto connected = dynamics::connect(model, "contact", "A.x_high", "B.x_low", {.edges = false}).front();
    std::vector<contact::AnyMemory> memories{connected.memory};
    state = dynamics::initial_state(model, memories);
    forces = dynamics::make_forces(model);
    for (const Index node : mesh::node_set(model.mesh, "A")) state.v(0, node) = against_wall ? -0.1 : 0.1;
    dynamics::start(model, state, forces);
    for (int i = 0; i < 3; ++i) dynamics::step(model, 0.9 * state.step_limits.elements.step, state, forces);
  }
  dynamics::View view() const { return {model, state, forces, true}; }
};

const Field& field(const std::vector<Field>& fields, const std::string& name) {
  for (const Field& f : fields)
    if (f.name == name) return f;
  throw std::runtime_error("no field " + name);
}

TEST(BodyGrid, ShowsEveryElementWithStressAndDisplacement) {
  const Scene scene;
  const Grid grid = body_grid(scene.view());
  EXPECT_EQ(grid.cells.size(), 2U);
  for (const auto& cells : grid.cells) EXPECT_EQ(cells.kind, CellKind::hexahedron);
  EXPECT_EQ(field(grid.cell_fields, "stress").values.cols(), 16);
  EXPECT_EQ(field(grid.cell_fields, "part_id").values.sum(), 8);
  EXPECT_TRUE(grid.displacement.isApprox(scene.state.x - scene.model.mesh.X));
}

TEST(BodyGrid, ShowsContactForcesThatCancel) {
  const Scene scene;
  const Eigen::MatrixXd force = field(body_grid(scene.view()).point_fields, "contact_force").values;
  EXPECT_GT(force.norm(), 0);
  EXPECT_LT(force.rowwise().sum().norm(), 1e-12 * force.norm());
}

TEST(BodyGrid, ShowsTheForcesOfRigidPlanes) {
  Scene scene(true);
  const Eigen::MatrixXd force = field(body_grid(scene.view()).point_fields, "contact_force").values;
  const Vec3 of_plane = contact::force(scene.model.rigid_planes[0], scene.state.rigid_planes[0]);
  EXPECT_GT(of_plane.x(), 0);
  EXPECT_LT((Vec3(force.rowwise().sum()) - of_plane).norm(), 1e-12 * of_plane.norm()) << "those of bodies on each other cancel";
}

TEST(ContactGrid, ShowsEveryPotentialElementOnceAsLineAndOnceAsFacet) {
  const Scene scene;
  const Grid grid = contact_grid(scene.view(), FrameFields::all);
  const auto apexes = static_cast<Eigen::Index>(std::get<contact::Interface>(scene.model.contacts[0]).apexes.size());
  EXPECT_EQ(grid.cells[0].nodes.cols(), apexes);
  EXPECT_EQ(grid.cells[1].nodes.cols(), apexes);
  const Eigen::MatrixXd gap = field(grid.cell_fields, "gap").values, status = field(grid.cell_fields, "contact_status").values;
  for (Eigen::Index e = 0; e < apexes; ++e) EXPECT_TRUE(status(0, e) == 1 || gap(0, e) >= 0);
  EXPECT_GT(status.sum(), 0);
}

TEST(ContactGrid, PutsTheFootOnTheBaseAndTheApexWhereItIs) {
  const Scene scene;
  const Grid grid = contact_grid(scene.view(), FrameFields::all);
  const auto& interface = std::get<contact::Interface>(scene.model.contacts[0]);
  for (std::size_t a = 0; a < interface.apexes.size(); ++a) {
    const auto first = static_cast<Eigen::Index>(5 * a);
    const Vec3 apex = grid.reference.col(first + 1) + grid.displacement.col(first + 1);
    EXPECT_LT((apex - scene.state.x.col(interface.apexes[a])).norm(), 1e-15);
    const Vec3 foot = grid.reference.col(first) + grid.displacement.col(first);
    EXPECT_NEAR((apex - foot).norm(), std::abs(std::get<contact::Memory>(scene.state.contacts[0]).gap[a]),
                1e-4 * (apex - foot).norm() + 1e-12);  // the foot stays on its facet
  }
}

TEST(ContactGrid, ShowsEdgesWhereTheyCross) {
  using contact::Crossing;
  Scene scene;
  dynamics::State state = scene.state;
  dynamics::Model& model = scene.model;
  const Eigen::Index before = contact_grid(scene.view(), FrameFields::all).cells[0].nodes.cols();
  model.contacts.push_back(contact::EdgeContact());
  contact::EdgeMemory memory;
  Crossing crossing;
  crossing.side = 1;
  crossing.node = {0, 1, 2, 3}, crossing.weight = {0.5, 0.5, -0.25, -0.75};
  memory.crossings = {crossing, Crossing{}};  // the second is not over its base edge
  state.contacts.push_back(memory);
  const Grid grid = contact_grid({model, state, scene.forces, true}, FrameFields::all);
  ASSERT_EQ(grid.cells[0].nodes.cols(), before + 1);
  const Eigen::Index last = 5 * before;
  const Vectors& X = model.mesh.X;
  EXPECT_LT((grid.reference.col(last) - 0.25 * X.col(2) - 0.75 * X.col(3)).norm(), 1e-15);
  EXPECT_LT((grid.reference.col(last + 1) - 0.5 * X.col(0) - 0.5 * X.col(1)).norm(), 1e-15);
  EXPECT_EQ(field(grid.cell_fields, "kind").values(0, before), 4);
}

TEST(ContactGrid, SaysOfCrossingsWhichTouchAndWhichSlide) {
  Scene scene;
  dynamics::State state = scene.state;
  scene.model.contacts.push_back(contact::EdgeContact());
  struct Kind {
    bool closed, acts, stuck;
    double slides;
  };
  const std::vector<Kind> kinds{{false, false, false, 0}, {true, false, false, 0}, {true, true, true, 0}, {true, true, false, 1}};
  contact::EdgeMemory memory;
  for (const Kind& kind : kinds) {
    contact::Crossing crossing;
    crossing.side = 1, crossing.closed = kind.closed;
    crossing.node = {0, 1, 2, 3}, crossing.weight = {0.5, 0.5, -0.25, -0.75};
    if (kind.acts) crossing.friction.make().acts = true, crossing.friction.make().stuck = kind.stuck;
    memory.crossings.push_back(crossing);
  }
  state.contacts.push_back(memory);
  const Grid grid = contact_grid({scene.model, state, scene.forces, true}, FrameFields::all);
  const Eigen::MatrixXd slides = field(grid.cell_fields, "slides").values, status = field(grid.cell_fields, "contact_status").values;
  const Eigen::Index elements = slides.cols() / 2;
  for (std::size_t k = 0; k < kinds.size(); ++k)
    for (const Eigen::Index half : {Eigen::Index{0}, elements}) {  // as a line and as a facet
      const Eigen::Index at = half + elements - static_cast<Eigen::Index>(kinds.size() - k);
      EXPECT_EQ(slides(0, at), kinds[k].slides) << k;
      EXPECT_EQ(status(0, at), kinds[k].closed ? 1 : 0) << k;
    }
}

TEST(WallsGrid, ShowsEachFloorAsARectangleInItsPlane) {
  const Scene scene;
  const Grid grid = walls_grid(scene.view());
  EXPECT_EQ(grid.cells[0].nodes.cols(), 2);
  EXPECT_LT(grid.reference.row(2).norm(), 1e-15);
}

}  // namespace
}  // namespace nereid::output::frames_test
