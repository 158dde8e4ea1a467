#pragma once
// Builds what a scene's options say: the model with its mesh, blocks, planes and contacts, and the first state.
//
// A part that does not fit the meshes is a fault at its place in the case: call finish() of the case file behind
// each function that says so, before the next one.

#include "input/scene_readers.hpp"

namespace nereid::input {

/// The meshes of all bodies, each where it stands. Faults: maps that turn elements inside out,
/// points beside their body, points named like a node set.
mesh::Mesh make_mesh(const SceneOptions&);

/// Faults: node sets, surfaces, bodies and sources that are named and do not exist.
void check_names(const SceneOptions&, const mesh::Mesh&);

/// Adds blocks, planes, loads and springs to a model that has its mesh, and finishes it.
///
/// Faults: nodes behind a floor or wall, nodes of a symmetry plane that lie on none, and those of constrain() and
/// add_loads().
void add_bodies_and_actions(const SceneOptions&, dynamics::Model&);

/// Adds the contacts to a model that is finished. Faults: penetrations, surfaces that share nodes.
std::vector<dynamics::Connected> add_contacts(const SceneOptions&, dynamics::Model&);

}  // namespace nereid::input
