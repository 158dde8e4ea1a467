#pragma once
// What one measures of a state: of node sets, of bodies, of contacts and of all other sources of force.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/probe.hpp"

namespace nereid::dynamics {

// Means over a node set, each node with the same weight.
Vec3 mean_position(const View&, const Subset& nodes);      ///< [m]
Vec3 mean_displacement(const View&, const Subset& nodes);  ///< [m] from the reference
Vec3 mean_velocity(const View&, const Subset& nodes);      ///< [m/s]

/// The rigid rotation that fits the velocities of a node set best, each node with the same weight. [rad/s]
Vec3 mean_spin(const View&, const Subset& nodes);

// Sums over a node set. A rigid body of which it has all nodes counts with its own mass and inertia.
Vec3 momentum(const View&, const Subset& nodes);          ///< [kg m/s]
Vec3 angular_momentum(const View&, const Subset& nodes);  ///< [kg m2/s] about the origin
double kinetic_energy(const View&, const Subset& nodes);  ///< [J] with that of turning

/// Acceleration of the centre of mass of a node set: what its velocity changed by since the last look, over that time; zero at the
/// first. Of one node that of the node, of a whole rigid body that of its centre. [m/s2]
Vec3 mean_acceleration(const View&, const Subset& nodes, Kept&);

/// A surface of a fluid on which waves go.
struct FreeSurface {
  Table<3> facets;
  double density;  ///< [kg/m3] of the fluid
  Vec3 gravity;    ///< [m/s2] not zero
  double level;    ///< [m2/s2] mean of gravity . x over it when the run began, by areas across gravity
};
FreeSurface free_surface(const Model&, const mesh::Surface&, double density, const Vectors& start);

/// The potential energy of its waves:  1/2 rho g int eta^2 dA,  eta the height above the mean level of the start, A across gravity. [J]
double wave_energy(const View&, const FreeSurface&);

/// Length of a node set along a coordinate axis (0: x, 1: y, 2: z), from its lowest to its highest node. [m]
double extent(const View&, const Subset& nodes, int axis);
/// Largest distance of a node set from a coordinate axis. [m]
double radius(const View&, const Subset& nodes, int axis);

/// How the values of a body's elements become one number.
enum class Take {
  mean,     ///< with the masses of the elements as weights: the mean over the reference volume
  largest,  ///< of all elements, with its sign
};

/// One number of what a body's elements show, as element::fields has it.
///
/// blocks     places in Model::blocks, at least one
/// component  row of the field
/// returns    in the unit of the field
/// Throws InternalError if the elements show no such thing.
double of_body(const View&, const std::vector<std::size_t>& blocks, const element::Shown&, int component, Take);

/// Some elements of a body.
struct PickedElements {
  std::vector<std::size_t> blocks;
  std::vector<element::Picked> picked;  ///< beside them
};
/// The same of some elements.
double of_elements(const View&, const PickedElements&, const element::Shown&, int component, Take);

/// Force of an interface on all its apexes, with friction, as a mean over the time between two looks. [N]
///
/// passes  places in Model::contacts: of a second pass the force on its bases
Vec3 mean_contact_force(const View&, const std::vector<std::size_t>& passes, Kept&);

/// Forces of a contact on nodes: of both passes and of the edges together, each node once, ascending.
///
/// Where two directions act, an impulse may be shared between them in many ways. Its sum at a node is the same in all of them.
///
/// interface  any of the contact
std::vector<contact::NodeForce> forces_of_contact(const Model&, const State&, std::size_t interface);

/// Tractions on the surface at an apex.
struct Traction {
  double pressure = 0;  ///< [Pa] compression positive
  double shear = 0;     ///< [Pa] of friction, or along a tied face; not negative
};
/// The force of a contact on the node of an apex over its tributary area, across the force: area_across(). Where no face of the apex is
/// within 60 degrees of the force, as at a rim that is pressed along its plate, all of its area counts. Of a tied apex the normal is that
/// of the face under it, and the area all of its own.
///
/// forces  forces_of_contact() of the interface
Traction traction_at(const View&, std::size_t interface, Index apex, const std::vector<contact::NodeForce>& forces);

/// An interface as a whole.
struct ContactState {
  double largest_pressure = 0;  ///< [Pa] of its apexes, compression positive: traction_at()
  double area = 0;              ///< [m2] tributary areas of the apexes on which the contact acts, where they face the base
};
/// Tributary area of an apex across the force of its contact, of its own faces that face the base: what lies round an edge, on another
/// side of the body, does not count. All of it where the model does not know the faces (an interface that connect() did not make). [m2]
double area_across(const View&, std::size_t interface, Index apex, const Vec3& force);
ContactState contact_state(const View&, std::size_t interface);

/// The smallest gap of an interface: negative in contact. Where no apex is near it costs a search over the whole scene. [m]
double least_gap(const View&, std::size_t interface);

/// Force of a source, as a mean over the time between two looks: what its impulse grew by. [N]
///
/// source  in sources(model)
/// Zero at the first look; where no time has passed, what it was. What a rigid plane stopped at the start belongs to the first interval.
Vec3 mean_force(const View&, std::size_t source, Kept&);

/// Force of a section on what is ahead of it, as a mean over the time between two looks. [N]
Vec3 mean_section_force(const View&, std::size_t section, Kept&);

/// Force of one body on another in an automatic contact, as mean_contact_force. [N]
///
/// contact        its name
/// one, other     bodies: the force is that on `one`
Vec3 mean_pair_force(const View&, const std::string& contact, const std::string& one, const std::string& other, Kept&);
/// Its impulse since the start. [N s]
Vec3 pair_impulse(const View&, const std::string& contact, const std::string& one, const std::string& other);

/// A contact whose sides have touched, or two bodies in an automatic one.
struct Touched {
  std::string contact;
  std::array<std::string, 2> sides;  ///< bodies; of a declared contact "apexes" and "base"
  double first = 0, last = 0;        ///< [s] steps at which they touched
  Vec3 impulse = Vec3::Zero();       ///< [N s] on the first side since the start, with friction; zero of a body and itself
};

/// Who has touched, contact by contact in the order of the model, with both passes and edges of each together.
std::vector<Touched> touched(const Model&, const State&);

/// Columns of the history that are a source's own: its channels, and what it created.
std::vector<std::string> ledger_columns(const Source&);

/// What every history has of the ledger: kinetic energy, the channels of all sources, created energy by source, the
/// integration term and what no source explains. [J]
std::vector<Probe> ledger_probes(const Model&);

/// Place of the source of that name in sources(model). Throws InternalError if there is none.
std::size_t source_of(const Model&, std::string_view name);

}  // namespace nereid::dynamics
