#include "dynamics/archive.hpp"

#include <cstring>
#include <vector>

#include "base/archive.hpp"
#include "mesh/box.hpp"
#include "tests/dynamics/scene.hpp"

namespace nereid::dynamics::archive_test {
namespace {

const material::Elastic rubber{1000, 1e6, 0.3};

/// A block that falls askew on another one, with friction. 30 elements and 8: no multiple of what a vector holds.
Scene blocks(contact::Method method) {
  Scene s;
  s.model.mesh = mesh::join(mesh::box("below", {{0, 0, 0}, {0.4, 0.4, 0.2}, {5, 3, 2}}),
                            mesh::box("above", {{0.05, 0.05, 0.201}, {0.35, 0.35, 0.4}, {2, 2, 2}}));
  for (const char* name : {"below", "above"}) s.model.blocks.push_back(element::hexahedra(s.model.mesh, name, rubber, {}));
  finalize(s.model);
  InterfaceOptions options;
  options.method = method;
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  options.friction = {.coefficient = 0.4, .kinetic = 0.2, .decay = 1};
  s.joined("joint", "above.z_low", "below.z_high", options);
  s.ready();
  s.move("above", Vec3(1, 0.5, -3));
  return s;
}

TEST(StateAsBytes, ThatIsReadAgainGoesOnWithTheSameBits) {
  for (const auto method : {contact::Method::penalty, contact::Method::multiplier}) {
    Scene whole = blocks(method), broken = blocks(method);
    std::string half;
    int steps = 0;
    const Observer keep = [&](const View& view) {
      if (++steps == 30) half = bytes_of(view.model, view.now);
    };
    whole.run_to(0.06, 1e300, {&keep, 1});
    ASSERT_GT(steps, 40);
    broken.state = state_of(broken.model, half);
    EXPECT_EQ(bytes_of(broken.model, broken.state), half);
    broken.run_to(0.06);
    const auto one = numbers(whole.state), other = numbers(broken.state);  // what is not in use may differ
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      ASSERT_EQ(one[i].second.size(), other[i].second.size()) << one[i].first;
      EXPECT_EQ(std::memcmp(one[i].second.data(), other[i].second.data(), one[i].second.size() * sizeof(double)), 0) << one[i].first;
    }
    EXPECT_NE(std::get<contact::Memory>(whole.state.contacts[0]).work, 0);
  }
}

TEST(StateAsBytes, HasALayoutThatTheVersionOfCheckpointsKnows) {
  Scene scene = blocks(contact::Method::multiplier);
  contact::RigidPlane floor;
  floor.name = "floor", floor.method = contact::Method::multiplier, floor.friction.coefficient = 0.4;
  floor.nodes = mesh::node_set(scene.model.mesh, "below.z_low");
  floor.area = Scalars::Constant(floor.nodes.size(), 1e-2), floor.impedance = 1;
  scene.model.rigid_planes.push_back(floor);
  scene.ready();
  scene.state.rigid_planes[0].shape_points.resize(1);  // as if a round body lay on it
  EXPECT_EQ(bytes_of(scene.model, scene.state).size(), 33710U)
      << "what a checkpoint holds has changed: raise `version` in drivers/restart.cpp, then write the new size here";
}

/// Gives each number of a part of a state a value of its own. Needs a part that has nothing but numbers of eight bytes.
template <class Part>
void mark(Part& part, double& next) {
  static_assert(sizeof(Part) % sizeof(double) == 0);
  for (std::size_t place = 0; place < sizeof(Part); place += sizeof(double), next += 1)
    std::memcpy(reinterpret_cast<char*>(&part) + place, &next, sizeof next);
}
template <class Part>
void expect_same(const std::vector<Part>& one, const std::vector<Part>& other, const char* what) {
  ASSERT_EQ(one.size(), other.size()) << what;
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t place = 0; place < sizeof(Part); place += sizeof(double))
      EXPECT_EQ(std::memcmp(reinterpret_cast<const char*>(&one[i]) + place, reinterpret_cast<const char*>(&other[i]) + place,
                            sizeof(double)), 0) << what << ", number " << place / sizeof(double);
}

TEST(StateAsBytes, HasEveryNumberOfPartsThatAreNumbersAlone) {
  const Scene scene = blocks(contact::Method::multiplier);
  State state = scene.state;
  double next = 1.5;
  const auto fill = [&next](auto& parts, std::size_t count) {
    parts.resize(count);
    for (auto& part : parts) mark(part, next);
  };
  fill(state.conditions, 2), fill(state.probes, 2), fill(state.sections, 2), fill(state.footings, 2), fill(state.rigid_bodies, 2);
  fill(state.constraints.account, 2), fill(state.ledger.accounts, 2);
  const State read = state_of(scene.model, bytes_of(scene.model, state));
  expect_same(state.conditions, read.conditions, "condition");
  expect_same(state.probes, read.probes, "probe");
  expect_same(state.sections, read.sections, "section");
  expect_same(state.footings, read.footings, "footing");
  expect_same(state.rigid_bodies, read.rigid_bodies, "rigid body");
  expect_same(state.constraints.account, read.constraints.account, "plane");
  expect_same(state.ledger.accounts, read.ledger.accounts, "account");
}

TEST(StateAsBytes, OfAnotherModelIsRefused) {
  const Scene one = blocks(contact::Method::penalty);
  const std::string bytes = bytes_of(one.model, one.state);
  Scene other;
  other.model.mesh = mesh::box("below", {{0, 0, 0}, {0.4, 0.4, 0.2}, {5, 3, 2}});
  other.model.blocks.push_back(element::hexahedra(other.model.mesh, "below", rubber, {}));
  finalize(other.model);
  other.ready();
  EXPECT_THROW(state_of(other.model, bytes), DamagedArchive);
  EXPECT_THROW(state_of(one.model, bytes + "x"), DamagedArchive);
  EXPECT_THROW(state_of(one.model, std::string_view(bytes).substr(0, bytes.size() - 1)), DamagedArchive);
  EXPECT_NE(fingerprint(one.model), fingerprint(other.model));
  EXPECT_EQ(fingerprint(one.model), fingerprint(blocks(contact::Method::penalty).model));
}

}  // namespace
}  // namespace nereid::dynamics::archive_test
