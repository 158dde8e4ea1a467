#pragma once
// Small scenes for the tests of this folder.

#include "model/build.hpp"

namespace nereid::model {

inline const material::Elastic steel{8000, 200e9, 0.25};

/// A bar of two cells of 1 m along x.
inline Body bar() { return {.name = "bar", .mesh = mesh::Box{Vec3(0, 0, 0), Vec3(2, 1, 1), {2, 1, 1}}, .law = steel}; }
/// The same behind it, face to face.
inline Body wall() { return {.name = "wall", .mesh = mesh::Box{Vec3(2, 0, 0), Vec3(4, 1, 1), {2, 1, 1}}, .law = steel}; }
/// A sheet 2 mm thick, half a metre above the bar.
inline Body sheet() {
  Body body{.name = "sheet", .mesh = mesh::Sheet{2, 1, 2, 1}, .law = steel};
  body.place.move = Vec3(0, 0, 1.5);
  body.plate.thickness = 2e-3;
  return body;
}

inline Scene with(std::vector<Body> bodies) {
  Scene scene;
  scene.bodies = std::move(bodies);
  scene.time.end = 1e-3;
  return scene;
}

/// What is said of a scene that is refused; empty if it is not.
inline std::string refusal(const Scene& scene) {
  try {
    build(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace nereid::model
