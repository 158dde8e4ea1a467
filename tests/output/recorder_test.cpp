// A recorder for users of the library: the same files that programs write.

#include "output/recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace nereid::output::recorder_test {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::path(::testing::TempDir()) / ("nereid_recorder_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A bar that flies against a wall, with 20 rows and 4 frames beside those of the start and the end.
model::Simulation bar_on_a_wall() {
  model::Scene scene;
  scene.bodies = {{.name = "bar",
                   .mesh = mesh::Box{Vec3::Zero(), Vec3(0.5, 0.05, 0.05), {20, 2, 2}},
                   .law = material::Elastic{7850, 210e9, 0.3}}};
  scene.rigid_planes = {{.name = "wall", .surface = "bar.x_low", .normal = Vec3::UnitX()}};
  scene.initial = {{.body = "bar", .value = model::uniform(Vec3(-10, 0, 0))}};
  scene.probes = {{.name = "push", .quantity = "force", .of = "wall", .component = "x"}};
  scene.time.end = 1e-4;
  scene.recording = {.history = 5e-6, .frames = 2e-5};
  return model::build(scene);
}

TEST(Recorder, WritesAHistoryAndFramesOfARun) {
  const fs::path folder = fresh_folder("run");
  model::Simulation simulation = bar_on_a_wall();
  Recorder recorder(simulation, folder, true);
  model::run(simulation, std::vector<dynamics::Observer>{[&](const dynamics::View& view) { recorder(view); }});
  recorder.finish(model::view(simulation));
  const std::string history = text_of(folder / "history.csv");
  EXPECT_EQ(history.rfind("time [s],push [N] mean,energy_kinetic [J]", 0), 0U) << history.substr(0, 80);
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 1 + 21);
  if (!grid::vtk_available()) return;
  EXPECT_EQ(recorder.frames(), 6);
  EXPECT_TRUE(fs::exists(folder / "body/body_000005.vtu"));
  EXPECT_TRUE(fs::exists(folder / "contact.pvd"));
}

TEST(Recorder, GoesOnFromItsMarkWithTheSameBytes) {
  const fs::path whole = fresh_folder("whole"), parts = fresh_folder("parts");
  const auto record = [](const fs::path& folder, bool in_parts) {
    model::Simulation simulation = bar_on_a_wall();
    std::optional<Recorder> recorder;
    recorder.emplace(simulation, folder, true);
    int rows = 0;
    model::run(simulation, std::vector<dynamics::Observer>{[&](const dynamics::View& view) {
                 (*recorder)(view);
                 if (!in_parts || !view.ledger_is_current || ++rows != 9) return;
                 const RecorderMark mark = recorder->mark();
                 recorder.reset();
                 recorder.emplace(simulation, folder, true, mark);
               }});
    recorder->finish(model::view(simulation));
  };
  record(whole, false), record(parts, true);
  EXPECT_EQ(text_of(parts / "history.csv"), text_of(whole / "history.csv"));
  if (!grid::vtk_available()) return;
  EXPECT_EQ(text_of(parts / "body.pvd"), text_of(whole / "body.pvd"));
  EXPECT_EQ(text_of(parts / "body/body_000004.vtu"), text_of(whole / "body/body_000004.vtu"));
}

}  // namespace
}  // namespace nereid::output::recorder_test
