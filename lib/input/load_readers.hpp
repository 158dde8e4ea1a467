#pragma once
// What acts on a scene: planes, loads, springs, point masses, initial fields, relaxation, gravity.
//
//     const Actions actions = read_actions(root);   // names are texts so far
//     file.finish();
//     ... mesh, blocks ...
//     constrain(actions, model);                    // planes and point masses, before dynamics::finish
//     dynamics::finish(model);
//     add_loads(actions, model);                    // the rest
//     file.finish();                                // names that the mesh does not have are faults
//     ... interfaces, dynamics::initial_state, dynamics::make_forces ...
//     set_initial(actions, model, state);
//     file.finish();                                // fields that are no number somewhere are faults

#include <optional>

#include "dynamics/run.hpp"
#include "input/expression.hpp"

namespace nereid::input {

/// One item of `planes`. Of a rigid plane only section, name, point and normal are read here; its other keys
/// belong to its own reader.
struct PlaneRequest {
  Section section;
  std::string name;
  bool rigid = false;             ///< `kind: rigid`; else `kind` below
  load::PlaneKind kind = load::PlaneKind::held;
  std::vector<std::string> nodes; ///< node sets
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();
  load::OverTime velocity;        ///< [m/s] along the normal, of `held` only; empty: held at rest
  std::array<Expression, 3> field, turning;  ///< [m/s], [rad/s] over x, y, z, t, of `driven` only; turning may be empty
};

/// One item of `loads`.
struct LoadRequest {
  enum class Kind { pressure, force, moment, body_force };
  Section section;
  std::string name;
  Kind kind = Kind::pressure;
  std::string on;                      ///< surface, node set or body
  std::array<Expression, 3> value;     ///< SI; of a pressure the first
};

/// One item of `springs`.
struct SpringRequest {
  Section section;
  std::string name, from, to;          ///< node sets of one node; `to` may be "ground"
  double stiffness = 0, damping = 0;   ///< [N/m] [N s/m]
  std::optional<double> length;        ///< [m] without force
};

/// One item of `point_masses`.
struct PointMassRequest {
  Section section;
  std::string name, nodes;
  double mass = 0;                     ///< [kg]
};

/// One item of `initial`: a velocity or a displacement of a body.
struct InitialRequest {
  Section section;
  std::string body;
  bool displacement = false;
  std::array<Expression, 3> value;     ///< [m/s] or [m], of x, y, z
};

struct Actions {
  Vec3 gravity = Vec3::Zero();         ///< [m/s2]
  std::vector<PlaneRequest> planes;    ///< rigid ones too, for their reader
  std::vector<LoadRequest> loads;
  std::vector<SpringRequest> springs;
  std::vector<PointMassRequest> point_masses;
  std::vector<InitialRequest> initial;
  std::optional<dynamics::Relaxation> relaxation;
};

/// All of these sections of a case; each is optional. Names of planes, loads and springs must differ.
///
/// runs  whether time passes; else only planes, springs and point masses count, and the rest is listed as not used
Actions read_actions(const Section& root, bool runs = true);

/// `relaxation: {residual, after, samples}`; nothing if the case has no such section.
std::optional<dynamics::Relaxation> read_relaxation(const Section& root);

/// `kind: symmetry | held | fixed | floor | rigid | driven`, `name`, `nodes`, `normal`, of a floor `point`, of held nodes
/// optionally `velocity: {value, unit}`, of driven ones `velocity` and optionally `turning` with three values.
PlaneRequest read_plane(const Section&);

/// The unit of a text's value as a factor to SI; a fault if it has another dimension.
double read_unit(const Section&, Dimension);

/// The node set (surface, region) of that name in the mesh, or a fault at the key that lists what there is.
/// returns  null after a fault
const Subset* find_nodes(const mesh::Mesh&, const Section&, std::string_view key, const std::string& name);
const mesh::Surface* find_surface(const mesh::Mesh&, const Section&, std::string_view key, const std::string& name);

/// Adds planes (without rigid ones) and point masses to a model whose mesh stands, before dynamics::finish.
///
/// Faults: a name that is not in the mesh; planes that move a node against one another; a floor that moves.
void constrain(const Actions&, dynamics::Model&);

/// Adds gravity, loads, springs and relaxation to a model after dynamics::finish.
void add_loads(const Actions&, dynamics::Model&);

/// Sets velocities and walks the bodies to their initial displacements; before dynamics::start.
void set_initial(const Actions&, const dynamics::Model&, dynamics::State&);

}  // namespace nereid::input
