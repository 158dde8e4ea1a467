// A whole scene from its case alone: bodies, contacts, loads, probes and conditions, in any number.
//
// Question  What the case asks with its probes.
// Answer    history.csv and summary.json; the syntax is in docs/scene.md
// Run       scene cases/scene/ball_on_plate.yaml --out out/ball_on_plate

#include "drivers/probes.hpp"
#include "input/scene_builder.hpp"

using namespace nereid;

driver::Scene build(const input::CaseFile& file) {
  const input::SceneOptions c = input::read_scene(file.root());
  file.finish();
  driver::Scene scene{.model = {}, .state = {}, .forces = {}, .gaps = {}, .time = c.time, .recording = c.recording,
                      .probes = {}, .watchers = {}, .results = {}, .until = {}};
  dynamics::Model& model = scene.model;
  model.mesh = input::make_mesh(c);
  input::check_names(c, model.mesh);
  file.finish();
  input::add_bodies_and_actions(c, model);
  driver::make_ready(scene, input::add_contacts(c, model));
  input::set_initial(c.actions, model, scene.state);
  driver::add_probes(c.probes, c.stops, scene);
  file.finish();
  return scene;
}

int main(int argc, char** argv) { return driver::drive(argc, argv, "scene", build); }
