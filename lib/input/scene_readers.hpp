#pragma once
// Readers of a whole scene: bodies, contacts, planes, loads, probes and conditions. Syntax: docs/scene.md.
//
// What a scene names (node sets, surfaces) exists only when the meshes do. So each part keeps the Section
// it was read from, where a name that names nothing is then a fault: Section::unknown_name.

#include "input/mesh_readers.hpp"
#include "input/readers.hpp"

namespace nereid::input {

/// A rigid motion of a mesh before anything else happens: a turn, then a shift.
struct Placement {
  Vec3 axis = Vec3::UnitZ();   ///< unit vector
  double angle = 0;            ///< [rad]
  Vec3 about = Vec3::Zero();   ///< [m] a point on the axis
  Vec3 move = Vec3::Zero();    ///< [m]
};

/// One body: its mesh, where it stands, and what it is made of.
struct BodyOptions {
  Section at;
  std::string name;
  MeshOptions mesh;
  Placement place;
  element::AnyLaw law;
  bool plates;  ///< else solid
  element::AnyHexahedronOptions solid;
  element::Plate::Options plate;
};

/// One pair of surfaces.
struct ContactOptions {
  Section at;
  std::string name, apexes, base;  ///< surfaces
  bool height_from_thickness;      ///< of the plates on both sides, half of each
  dynamics::InterfaceOptions interface;
};

/// What a plane of the scene does to its nodes.
enum class ScenePlane { symmetry, held, fixed, floor, rigid };

struct PlaneOptions {
  Section at;
  std::string name;
  ScenePlane kind;
  std::vector<std::string> nodes;  ///< node sets; of all but rigid
  std::string surface;             ///< of rigid
  Vec3 point, normal;              ///< [m] of floor and rigid; unit vector, of all but fixed
  std::optional<double> penalty;   ///< [Pa/m] of rigid; without it hardness counts
  double hardness;                 ///< [-] penalty over the stiffness of the surface
  contact::Coulomb friction;       ///< of rigid
  double created_in_a_bounce;      ///< [-]
};

/// A velocity that a body starts with.
struct InitialOptions {
  Section at;
  std::string body;
  Vec3 velocity;  ///< [m/s]
};

/// Of what something is measured.
enum class Of { nodes, body, contact, source };

/// What a probe can measure.
struct Measurable {
  std::string name;
  Dimension dimension;
  Of of;
  std::vector<std::string> components;  ///< the first one unless the case says; empty: it has none
  bool required = false;                ///< the case must say which component
};

/// All that probes can measure: quantities of motion, of force and contact, of stress, and the internal variables of all laws.
const std::vector<Measurable>& measurables();

struct ProbeOptions {
  Section at;
  std::string name;
  Measurable quantity;
  std::string of;
  int component = 0;     ///< in Measurable::components
  bool largest = false;  ///< of a body: the largest of its elements, else the mean
};

/// A condition that ends the run.
struct StopOptions {
  std::string probe;
  bool above;      ///< else below
  double value;    ///< in the unit of the probe
  double after;    ///< [s] not looked at before
};

struct SceneOptions {
  std::vector<BodyOptions> bodies;
  std::vector<ContactOptions> contacts;
  std::vector<PlaneOptions> planes;
  Vec3 gravity;  ///< [m/s2]
  std::vector<InitialOptions> initial;
  std::vector<ProbeOptions> probes;
  std::vector<StopOptions> stops;
  dynamics::Time time;
  Recording recording;
};

/// Reads a scene, with all faults that can be found without meshes: names given twice, conditions on no probe.
SceneOptions read_scene(const Section& root);

}  // namespace nereid::input
