#pragma once
// What blocks of one kind and law can do, behind the functions of block.hpp. Each kind is compiled in a
// source of its own, because packs are slow to compile: kernels_hexahedron.cpp and its companions.

#include "element/block.hpp"

namespace nereid::element {

/// The functions of block.hpp that need the element itself; bodies in kernels_body.hpp.
template <class Kind, class Law>
struct Kernels {
  static Block<Kind, Law> make(const mesh::Mesh&, const std::string& name, const Connectivity& nodes, const Law&,
                               const typename Kind::Options&);
  static void add_mass(const Block<Kind, Law>&, Scalars& mass);
  static Scalars element_masses(const Block<Kind, Law>&);
  static void add_rotary_inertia(const Block<Kind, Law>&, Scalars& inertia);
  static Memory initial_memory(const Block<Kind, Law>&);
  static BlockLimit advance(const Block<Kind, Law>&, const Vectors& x, const Vectors& dx, const Vectors& rotation, double dt, Memory&,
                      TileForces&, TileReports&);
  static Thinned thinned(const Block<Kind, Law>&, const Vectors& x, const Memory&);
  static Pressed pressed(const Block<Kind, Law>&, const Memory&);
  static std::vector<Held> held(const Block<Kind, Law>&, const Vectors& x, const Memory&);
  static Reduced reduce(const Block<Kind, Law>&, const Vectors& X, const Vectors& x, const Memory&, const Shown&, int component);
  static Reduced reduce_picked(const Block<Kind, Law>&, const Vectors& X, const Vectors& x, const Memory&, const Shown&, int component,
                               const Picked&);
  static std::vector<Field> fields(const Block<Kind, Law>&, const Vectors& X, const Vectors& x, const Memory&, const Wanted&);
};

}  // namespace nereid::element
