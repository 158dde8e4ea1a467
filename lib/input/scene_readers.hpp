#pragma once
// Readers of a whole scene: bodies, contacts, planes, loads, probes and conditions. Syntax: docs/scene.md.
//
// What a scene names (node sets, surfaces) exists only when the meshes do. So each part keeps the Section
// it was read from, where a name that names nothing is then a fault: Section::unknown_name.

#include "input/load_readers.hpp"
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

/// A name for the node of a body that is nearest to a point.
struct PointOptions {
  Section at;
  std::string name;
  Vec3 near;  ///< [m] where the body stands
};

/// One body: its mesh, where it stands, and what it is made of.
struct BodyOptions {
  Section at;
  std::string name;
  MeshOptions mesh;
  std::optional<MeshMap> map;  ///< of the mesh as built, before it is placed
  Placement place;
  std::vector<PointOptions> points;
  element::AnyLaw law;
  bool solids, plates;  ///< which of them the mesh has; a file may have both
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

/// What a rigid plane has beside its point and normal.
struct RigidOptions {
  Section at;
  std::string name, surface;
  Vec3 point, normal;              ///< [m], unit vector
  std::optional<double> penalty;   ///< [Pa/m] without it hardness counts
  double hardness;                 ///< [-] penalty over the stiffness of the surface
  contact::Coulomb friction;
  double created_in_a_bounce;      ///< [-]
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
  std::vector<RigidOptions> rigid_planes;  ///< those of Actions::planes, with what is theirs alone
  Actions actions;
  std::vector<ProbeOptions> probes;
  std::vector<StopOptions> stops;
  dynamics::Time time;
  Recording recording;
};

/// Reads a scene, with all faults that can be found without meshes: names given twice, conditions on no probe.
SceneOptions read_scene(const Section& root);

/// Reads of a scene what it is at rest: bodies, planes, springs and point masses. The rest is listed as not used.
///
/// Faults: contacts, floors and rigid planes, which are nothing that small motions about rest could keep.
SceneOptions read_scene_at_rest(const Section& root);

}  // namespace nereid::input
