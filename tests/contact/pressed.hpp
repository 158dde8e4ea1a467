#pragma once
// Apexes pressed on a base surface, for the tests of this folder.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contact/contact.hpp"
#include "tests/contact/surfaces.hpp"

namespace nereid::contact::pressed {

using namespace surfaces;

constexpr double penalty = 1000;
inline const Vectors none(3, 0);      // no plates, so nothing turns
inline const Scalars no_inertia(0);

/// An interface with its state: the nodes of a shape first, then the apexes.
struct Scene {
  Vectors x;
  Interface interface;
  Memory memory;
  Workspace workspace;
  InitialGaps gaps;
  Index base_nodes;

  Index apex(Index a = 0) const { return interface.apexes[a]; }
  void move(const Vec3& to, Index a = 0) { x.col(apex(a)) = to; }
  const Near& near(Index a = 0) const { return *contact::near(memory, a); }
  const ElementForces& element(Index a = 0) const { return near(a).element; }
  double offset(Index a) const { return near(a).tracks.count > 0 ? interface.contact_height(a) - near(a).tracks.track[0].height : 0; }
  void update(double dt = 0) { advance(interface, x, Vectors::Zero(3, x.cols()), none, dt, memory, workspace); }
  Vectors forces() const {
    Vectors f = Vectors::Zero(3, x.cols());
    Vectors moment = none;
    add_forces(interface, memory, f, moment);
    return f;
  }
};

inline Interface interface_over(const Shape& shape, Index apexes) {
  Interface in;
  in.name = "interface";
  const auto first = static_cast<Index>(shape.x.cols());
  Vectors X = Vectors::Zero(3, first + apexes);
  X.leftCols(first) = shape.x;
  in.base = base_surface({"base", shape.facets}, X);
  for (Index a = 0; a < apexes; ++a) in.apexes.push_back(first + a);
  in.area = Scalars::Constant(apexes, 1.0);
  in.facet_area.resize(shape.facets.cols());
  for (Index f = 0; f < in.base.facets.cols(); ++f) {
    const auto c = corners(in.base, shape.x, f);
    in.facet_area(f) = 0.5 * norm(cross(c[1] - c[0], c[2] - c[0]));
  }
  in.penalty = penalty;
  in.margin = 100;
  return in;
}

inline Scene scene_of(Vectors x, Interface in, const ContactHeight& height,
               InitialPenetration penetration = InitialPenetration::refuse) {
  Memory memory;
  Workspace workspace(in);
  const InitialGaps gaps = connect(in, x, 100, height, penetration, memory, workspace);
  const Index base_nodes = in.apexes.front();
  return {std::move(x), std::move(in), std::move(memory), std::move(workspace), gaps, base_nodes};
}

inline Scene press(const Shape& shape, const std::vector<Vec3>& apexes, double contact_height) {
  Vectors x(3, shape.x.cols() + static_cast<Index>(apexes.size()));
  x.leftCols(shape.x.cols()) = shape.x;
  for (std::size_t a = 0; a < apexes.size(); ++a) x.col(shape.x.cols() + static_cast<Index>(a)) = apexes[a];
  Scene scene = scene_of(std::move(x), interface_over(shape, static_cast<Index>(apexes.size())), {false, 0, contact_height});
  scene.update();
  return scene;
}

inline double flat(double, double) { return 0; }

/// The nodes on the plane x = 0, or y = 0 or z = 0.
inline Subset nodes_at_zero(const Vectors& x, int axis) {
  Subset nodes;
  for (Index n = 0; n < static_cast<Index>(x.cols()); ++n)
    if (std::abs(x(axis, n)) < 1e-12) nodes.push_back(n);
  return nodes;
}

/// Two flanks that meet at x = 2 and rise by `slope` on both sides; a ridge for slope < 0.
inline auto fold(double slope) {
  return [slope](double x, double) { return slope * std::abs(x - 2); };
}
/// The inside of a corner of a cube, or its outside.
inline Shape corner(bool inside) {
  Shape shape{Vectors(3, 4), Table<3>(3, 3)};
  shape.x << 0, 1, 0, 0,
             0, 0, 1, 0,
             0, 0, 0, 1;
  if (inside) shape.facets << 0, 0, 0, 1, 2, 3, 2, 3, 1;
  else shape.facets << 0, 0, 0, 2, 3, 1, 1, 2, 3;
  return shape;
}


/// Largest difference of a force from minus the slope of the stored energy, over the force on the apex.
inline double gradient_error(const Scene& scene, double step = 1e-6) {
  const auto energy = [&](const Vectors& x) {
    Scene there = scene;
    there.x = x;
    there.update();
    return stored(there.memory);
  };
  const Vectors f = scene.forces();
  double worst = 0;
  for (Index n = 0; n < scene.x.cols(); ++n) {
    for (int i = 0; i < 3; ++i) {
      Vectors ahead = scene.x, behind = scene.x;
      ahead(i, n) += step;
      behind(i, n) -= step;
      worst = std::max(worst, std::abs(f(i, n) + (energy(ahead) - energy(behind)) / (2 * step)));
    }
  }
  return worst / f.col(scene.apex()).norm();
}

inline void has_a_potential(const Scene& scene, double tolerance) {
  ASSERT_EQ(scene.memory.status[0], Status::closed);
  const Vectors f = scene.forces();
  EXPECT_LT(gradient_error(scene), tolerance);
  Vec3 moment = Vec3::Zero();
  for (Index n = 0; n < scene.x.cols(); ++n) {
    const Vec3 at = scene.x.col(n), push = f.col(n);
    moment += at.cross(push);
  }
  EXPECT_LT(f.rowwise().sum().norm(), 1e-11 * f.col(scene.apex()).norm());
  EXPECT_LT(moment.norm(), tolerance * f.col(scene.apex()).norm());
}

constexpr double by_differences = 2e-7;  // second differences of energies of 1e-1 over steps of 1e-6

/// Moves an apex and steps on with the velocity that led there.
inline void step_to(Scene& scene, Index a, const Vec3& place, double dt = 1e-3) {
  Vectors v = Vectors::Zero(3, scene.x.cols());
  v.col(scene.apex(a)) = (place - scene.x.col(scene.apex(a))) / dt;
  scene.x.col(scene.apex(a)) = place;
  advance(scene.interface, scene.x, v, none, dt, scene.memory, scene.workspace);
}

}  // namespace nereid::contact::pressed
