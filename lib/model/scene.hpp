#pragma once
// A scene as plain data: bodies, contacts, planes, loads, probes and conditions. All values are in SI units.
//
//     model::Scene scene;
//     scene.bodies.push_back({.name = "bar", .mesh = mesh::Box{...}, .law = material::Elastic{7850, 210e9, 0.3}});
//     scene.initial.push_back({.body = "bar", .value = model::uniform({0, 0, -1})});
//     scene.time.end = 1e-3;
//     model::Simulation simulation = model::build(scene);   // model/build.hpp
//
// What a part means, and what node sets and surfaces a mesh has: docs/scene.md, docs/meshes.md. The member `at` of each
// part is its path in a case, as in "bodies[0]"; it is empty for scenes made in C++.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/connect.hpp"
#include "dynamics/run.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/disc.hpp"
#include "mesh/judge.hpp"
#include "mesh/revolved.hpp"
#include "mesh/sphere.hpp"
#include "mesh/wedge.hpp"

namespace nereid::model {

/// Three numbers over reference position [m] and time [s].
using Field = std::array<load::OverSpace, 3>;

/// The same value everywhere and always.
inline load::OverSpace constant(double value) {
  return [value](double, double, double, double) { return value; };
}
inline Field uniform(const Vec3& value) { return {constant(value.x()), constant(value.y()), constant(value.z())}; }

/// What a body's mesh is made from: the options of one generator, or a mesh whose names are yet without the body's.
using MeshOptions = std::variant<mesh::Box, mesh::Cylinder, mesh::Tube, mesh::Wedge, mesh::WedgeTube, mesh::Revolved, mesh::Sphere,
                                 mesh::Disc, mesh::WedgeDisc, mesh::Sheet, mesh::Mesh>;

/// A rigid motion of a mesh before anything else happens: a rotation, then a shift.
struct Placement {
  Vec3 axis = Vec3::UnitZ();   ///< unit vector
  double angle = 0;            ///< [rad]
  Vec3 about = Vec3::Zero();   ///< [m] a point on the axis
  Vec3 move = Vec3::Zero();    ///< [m]
};

/// A name for the node of a body that is nearest to a point.
struct Point {
  std::string name;
  Vec3 near = Vec3::Zero();  ///< [m] where the body stands
  std::string at = {};
};

/// A part of space, with its boundary.
struct Zone {
  enum class Kind { box, cylinder, sphere, plane, half_space } kind = Kind::box;
  Vec3 from = Vec3::Zero();   ///< [m] lowest corner of a box, end of a cylinder's axis, centre of a sphere, point of a plane
  Vec3 to = Vec3::Zero();     ///< [m] highest corner of a box, other end of a cylinder's axis
  Vec3 normal = Vec3::UnitZ();  ///< unit vector, of a plane and of a half space, which lies ahead of it
  double radius = 0;          ///< [m] of a cylinder or a sphere
};

/// A name for the nodes of a body in a zone, for the part of its skin between them, and for the elements whose middles lie there; or for
/// what several sets make. Each of the four lists names sets of the body that come before it, or node sets of its mesh, which have no
/// elements; a set has one of the first three.
struct Set {
  std::string name;
  std::optional<Zone> zone = {};             ///< where the body stands
  std::vector<std::string> any_of = {}, all_of = {};
  std::vector<std::string> without = {};     ///< what of this is taken out again
  std::string at = {};
};

/// A material of a part of a body.
struct PartMaterial {
  std::string of;                            ///< a region of the mesh or one of `sets`
  element::AnyLaw law = {};
  std::string at = {};
};

/// Mass properties of a rigid body that are given; what is not follows from mesh and density.
struct GivenMass {
  std::optional<double> mass = {};     ///< [kg]
  std::optional<Vec3> centre = {};     ///< [m] where the body stands
  std::optional<Mat3> inertia = {};    ///< [kg m2] about the centre, in the axes of the scene
};

/// As what a rigid body touches.
enum class TouchesAs {
  usual,   ///< the shape that its mesh was made of, where that is a whole sphere, cylinder, ring or tube; else its facets
  exact,   ///< that shape
  facets,  ///< the facets of its mesh
};

/// A round shape on which the outer nodes of a mesh lie.
struct GivenShape {
  geometry::Round shape;
  Vec3 centre = Vec3::Zero(), axis = Vec3::UnitZ();  ///< [m] before the body is placed; unit vector
};

/// What a fluid starts with.
struct FluidStart {
  double pressure = 0;       ///< [Pa] everywhere, or at its highest point
  bool hydrostatic = false;  ///< it grows downward by density times gravity, so that nothing moves
};

/// One body: its mesh, where it stands, and what it is made of.
struct Body {
  std::string name;
  MeshOptions mesh;
  double scale = 1;                           ///< [m] what a coordinate of 1 becomes, before `map`
  Field map = {};                             ///< [m] where the nodes of the mesh go before it is placed; empty: they stay
  Placement place = {};
  std::vector<Point> points = {};
  std::vector<Set> sets = {};
  element::AnyLaw law = {};
  std::vector<PartMaterial> parts = {};       ///< materials of parts that are not of `law`; of those that overlap the last one counts
  element::AnyHexahedronOptions solid = {};   ///< of the solids in the mesh; those of fluids for a fluid
  element::Plate::Options plate = {};         ///< of the plates in the mesh
  bool rigid = false;                         ///< it moves as one, and its elements compute nothing
  TouchesAs surface = TouchesAs::usual;       ///< of a rigid body
  std::optional<GivenShape> shape = {};       ///< of a rigid body, in place of the shape that its mesh was made of
  GivenMass given = {};                       ///< of a rigid body
  FluidStart start = {};                      ///< of a fluid
  mesh::Origin origin = {};                   ///< of a given mesh, which has its names from a file
  std::string at = {};
};

/// Whether a region or surface of the mesh of a scene is of a body.
inline bool belongs(const std::string& name, const Body& body) { return name.substr(0, name.find('.')) == body.name; }

/// One pair of surfaces.
struct Contact {
  std::string name, apexes, base;            ///< surfaces
  bool height_from_thickness = true;         ///< of the plates on both sides, half of each; else InterfaceOptions::height
  dynamics::InterfaceOptions interface = {};
  std::string at = {};
};

/// The skins of bodies, each over every other; pairs of bodies that a Contact joins are left to it.
struct AutomaticContact {
  std::string name;
  std::vector<std::string> bodies = {};      ///< empty: all
  bool self_contact = true;                  ///< each body touches itself too; rigid bodies do not
  dynamics::InterfaceOptions interface = {};  ///< without passes, heights, areas and damping
  std::string at = {};
};

/// Nodes that are constrained, driven, or stopped by a floor.
struct Plane {
  std::string name;
  load::PlaneKind kind = load::PlaneKind::constrained;
  std::vector<std::string> nodes = {};      ///< node sets
  Vec3 point = Vec3::Zero();                ///< [m] of a floor
  Vec3 normal = Vec3::UnitZ();              ///< unit vector; not of fixed and driven nodes
  load::OverTime velocity = {};             ///< [m/s] along the normal, of `constrained` only; empty: at rest
  Field field = {}, angular_velocity = {};  ///< [m/s] [rad/s] of `driven` only; `angular_velocity` may be empty
  std::string at = {};
};

/// A wall that nodes of a surface do not pass.
struct RigidPlane {
  std::string name, surface;
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  ///< [m]; unit vector to the side of the nodes
  contact::Method method = dynamics::InterfaceOptions{}.method;
  double restitution = 1;                             ///< [-] of nodes that multipliers stop
  std::optional<double> penalty = {};                 ///< [Pa/m] without it `penalty_scale` counts
  double penalty_scale = dynamics::InterfaceOptions{}.penalty_scale;  ///< [-] penalty over the stiffness of the surface
  contact::Coulomb friction = {};
  double energy_gain_limit = dynamics::InterfaceOptions{}.energy_gain_limit;  ///< [-]
  double step_factor = dynamics::InterfaceOptions{}.step_factor;              ///< [-] dt omega until the plane has created too much
  std::string at = {};
};

enum class LoadKind { pressure, force, moment, body_force, radiation, bubble };

/// What is said of a load in a case: the word of its kind, the key of what it acts on, and its value.
struct LoadSyntax {
  const char *word, *key, *unit;
  bool is_vector, over_place;                ///< three values or one; functions of place and time, or of time (a bubble's: of its volume)
};
constexpr std::array<LoadSyntax, 6> load_syntax{{  // in the order of LoadKind
    {"pressure", "surface", "Pa", false, false},
    {"force", "nodes", "N", true, false},
    {"moment", "nodes", "N m", true, false},
    {"body_force", "body", "m/s^2", true, true},
    {"radiation", "surface", "Pa", false, false},
    {"bubble", "surface", "Pa", false, false},
}};

struct Load {
  std::string name;
  LoadKind kind = LoadKind::pressure;
  std::string on;                            ///< surface, node set or body
  Field value = {};                          ///< in the unit of load_syntax; of a pressure the first, of radiation that at rest
  Field incident = {};                       ///< [Pa] of radiation: the first is the wave that comes in; may be empty
  double volume = 0;                         ///< [m3] of a bubble at the start; its value is a function of the volume, in place of time
  std::optional<double> impedance = {};      ///< [kg/(m2 s)] of radiation; without it that of the material at the surface
  std::string at = {};
};

struct Spring {
  std::string name, from, to;                ///< node sets of one node; `to` may be "ground"
  double stiffness = 0, damping = 0;         ///< [N/m] [N s/m]
  std::optional<double> length = {};         ///< [m] without force
  std::string at = {};
};

struct PointMass {
  std::string name, nodes;
  double mass = 0;                           ///< [kg]
  std::string at = {};
};

/// A velocity or a displacement of a body at the start.
struct Initial {
  std::string body;
  bool displacement = false;
  Field value = {};                          ///< [m/s] or [m], of place
  std::string at = {};
};

/// A part of a run: until its equilibrium where it relaxes, else for its duration. Contacts, rigid planes, floors, symmetry planes, springs
/// and gravity are on in all stages.
struct Stage {
  std::string name;
  double duration = 0;                       ///< [s]; of a stage that relaxes, at most
  std::optional<dynamics::Relaxation> relaxation = {};
  std::vector<std::string> off = {};         ///< planes and loads that do not act
  std::vector<Initial> initial = {};         ///< velocities that bodies are given as it begins, in addition to what they have
  std::string at = {};
};

/// A number that is computed from probes.
struct Formula {
  std::vector<std::string> inputs = {};      ///< names of probes that come before it
  std::function<double(const std::vector<double>& inputs, double t)> value = {};  ///< empty: there is none
  std::string unit = {};                     ///< SI
};

/// A number that is measured, a column of the history.
struct Probe {
  std::string name;
  std::string quantity = {};                 ///< one of measurables(); of none with a formula
  std::string of = {};                       ///< node set, body, region, element set, contact or source of force
  std::string component = {};                ///< one of Measurable::components; empty: the first
  bool largest = false;                      ///< of a body: the largest of its elements, else the mean
  std::string place = {};                    ///< of a body of plates: one of element::words_of_places
  std::optional<Vec3> near = {};             ///< [m] of a body: of the element whose middle is nearest to it at the start; a gauge
  std::optional<Vec3> along = {};            ///< of stress and strain: that along this unit vector, in place of a component
  std::array<std::string, 2> between = {};   ///< bodies of an automatic contact: the force on the first of them by the second
  Formula formula = {};
  std::string at = {};
};

/// A plane or a cylinder through a body, across which forces are seen.
struct Section {
  std::string name;
  std::string body;
  Vec3 point = Vec3::Zero();                 ///< [m] in the reference
  Vec3 normal = Vec3::UnitX();               ///< forces are those on what is ahead of it; the axis of a cylinder
  double radius = 0;                         ///< [m] of a cylinder: forces are those on what is outside; 0: a plane
  std::string at = {};
};

/// What a condition that ends the run looks for.
enum class StopKind {
  level,   ///< a probe is above or below a value
  peak,    ///< a probe has passed its first maximum, or minimum
  steady,  ///< the mean of a probe over a window is that over the window before
  rest,    ///< the kinetic energy of all bodies stays small
};

/// A condition that ends the run.
struct Stop {
  std::string probe = {};                    ///< of all kinds but rest
  bool above = true;                         ///< level: else below; peak: a maximum, else a minimum
  double value = 0;                          ///< in the unit of the probe; level: the bound; steady: the most that the mean may change
  double after = 0;                          ///< [s] not looked at before
  StopKind kind = StopKind::level;
  /// [-] peak: part of its rise to the maximum by which it has fallen, 0: by any; rest: kinetic energy over the largest one
  double part = 0;
  double span = 0;                           ///< [s] peak, rest: for how long; steady: the window
  bool of_scene = false;                     ///< rest: over the energy of the scene, and not over the largest kinetic energy
  std::string at = {};
};

/// How often a run is recorded.
struct Recording {
  double history = 0;                        ///< [s] between rows of history.csv; zero: 400 rows
  double frames = 0;                         ///< [s] between ParaView frames; zero: as usual_frames() has them
  bool full_precision = false;
  bool all_fields = false;                   ///< frames with all quantities of elements, else with the usual ones
};

struct Scene {
  std::vector<Body> bodies;
  std::vector<Contact> contacts;
  std::vector<AutomaticContact> automatic_contacts;
  std::vector<Plane> planes;
  std::vector<RigidPlane> rigid_planes;
  Vec3 gravity = Vec3::Zero();               ///< [m/s2]
  std::vector<Load> loads;
  std::vector<Spring> springs;
  std::vector<PointMass> point_masses;
  std::vector<Initial> initial;
  std::optional<dynamics::Relaxation> relaxation;  ///< of a scene without stages
  std::vector<Stage> stages;                 ///< one after the other; time.end is the sum of their durations
  std::vector<Section> sections;
  std::vector<Probe> probes;
  std::vector<Stop> stops;
  dynamics::Time time;
  Recording recording;
};

}  // namespace nereid::model
