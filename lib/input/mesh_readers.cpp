#include "input/mesh_readers.hpp"

#include <algorithm>
#include <cmath>

#include "input/readers.hpp"

namespace nereid::input {

namespace {

constexpr double most_elements = 1e8;  // their memory is some 100 GB, and node numbers still fit an Index

// Elements that a mesh will have, in floating point because what is typed may be absurd.
double elements(const mesh::Box& box) { return box.cells.cast<double>().prod(); }

double parts(mesh::Turn turn) { return turn == mesh::Turn::full ? 4 : 1; }

double elements(const mesh::Cylinder& c) {
  const double core = c.cells_core;
  return parts(c.turn) * (core * core + 2 * core * c.cells_ring) * c.cells_along;
}

double elements(const mesh::Tube& t) { return parts(t.turn) * 2 * (2.0 * t.cells_core) * t.cells_along; }

}  // namespace

MeshOptions read_mesh_options(const Section& section) {
  const std::string kind = section.choice("kind", {"box", "cylinder", "tube"});
  const bool is_box = kind == "box", is_cylinder = kind == "cylinder", is_tube = kind == "tube";

  const Section if_box = section.when(is_box);
  const mesh::Box box{.low = read_vector(if_box, "low", dim::length),
                      .high = read_vector(if_box, "high", dim::length),
                      .cells = Eigen::Vector3i(if_box.counts("cells").data())};

  // all conditions before `turn` is read: a missing choice leaves those after it undecided
  const Section if_round = section.when(is_cylinder || is_tube), if_cylinder = section.when(is_cylinder);
  const double radius = if_round.quantity("radius", dim::length, positive);
  const double length = if_round.quantity("length", dim::length, positive);
  const mesh::Turn turn = if_round.choice("turn", {"full", "quarter"}) == "full" ? mesh::Turn::full : mesh::Turn::quarter;
  const int cells_core = if_round.count("cells_core");
  const int cells_ring = if_cylinder.count("cells_ring");
  const int cells_along = if_round.count("cells_along");

  if (is_box && section.sound() && !(box.low.array() < box.high.array()).all())
    section.fault("high", "'high' must lie beyond 'low' along x, y and z");

  MeshOptions options = box;
  if (is_cylinder) options = mesh::Cylinder{radius, length, turn, cells_core, cells_ring, cells_along};
  if (is_tube) options = mesh::Tube{radius, length, turn, cells_core, cells_along};
  const double count = std::visit([](const auto& one) { return elements(one); }, options);
  if (section.sound() && count > most_elements)
    section.fault(is_box ? "cells" : "cells_core",
                  "the mesh would have " + std::to_string(std::llround(std::min(count, 1e18))) +
                      " elements: expected at most a hundred million");
  return options;
}

mesh::Mesh make_mesh(const std::string& name, const MeshOptions& options) {
  struct Make {
    const std::string& name;
    mesh::Mesh operator()(const mesh::Box& one) const { return mesh::box(name, one); }
    mesh::Mesh operator()(const mesh::Cylinder& one) const { return mesh::cylinder(name, one); }
    mesh::Mesh operator()(const mesh::Tube& one) const { return mesh::tube(name, one); }
  };
  return std::visit(Make{name}, options);
}

}  // namespace nereid::input
