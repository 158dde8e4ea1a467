#pragma once
// Blocks: elements of one kind, of one material, cut into tiles and worked pack by pack.

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/account.hpp"
#include "base/field.hpp"
#include "element/fluid.hpp"
#include "element/full_hexahedron.hpp"
#include "element/hexahedron.hpp"
#include "element/limiter.hpp"
#include "element/plate.hpp"
#include "element/tiles.hpp"
#include "material/laws.hpp"
#include "mesh/mesh.hpp"

namespace nereid::element {

using Connectivity = Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic>;

/// Elements of one kind, of one material. Constant in time.
template <class Kind, class Law>
struct Block {
  std::string name;
  Law law;
  typename Kind::Options options;
  Connectivity nodes;             ///< [nodes per element x elements]
  Tiling tiling;
  std::vector<double> constants;  ///< [packs x rows x lanes]
  std::vector<FluidStart> start;  ///< [packs x lanes] of fluid; else empty
  Layers layers;                  ///< through the thickness; none in a solid
  std::vector<Index> beside;      ///< places_beside(); empty without viscosity
  std::vector<Index> rotation_column;  ///< [slots] column of each slot's angular velocity; plates only
};

using material::AnyLaw;

/// Whether elements of a kind may have a law: fluids those of fluids, plates those with an update in plane stress.
template <class Kind, class Law>
constexpr bool may_have = std::is_same_v<Kind, Fluid> ? material::FluidLaw<Law>
                          : Kind::dimensions == 3     ? material::Law<Law>
                                                      : material::PlateLaw<Law>;

/// Blocks of one kind with each law that it may have, as a list.
template <class Kind, class... Laws>
auto blocks_of(const std::variant<Laws...>*) {
  return std::tuple_cat(std::conditional_t<may_have<Kind, Laws>, std::tuple<Block<Kind, Laws>>, std::tuple<>>{}...);
}
template <class... Blocks>
std::variant<Blocks...> variant_of(const std::tuple<Blocks...>*);

/// Every kind of element with every law that it may have.
using AnyBlock = decltype(variant_of(static_cast<decltype(std::tuple_cat(
    blocks_of<Hexahedron>(static_cast<AnyLaw*>(nullptr)), blocks_of<FullHexahedron>(static_cast<AnyLaw*>(nullptr)),
    blocks_of<Fluid>(static_cast<AnyLaw*>(nullptr)), blocks_of<Plate>(static_cast<AnyLaw*>(nullptr))))*>(nullptr)));

/// Whether plates may have a law.
bool plates_may_have(const AnyLaw&);

/// What the elements of one block remember; one type for all blocks. Rows lie pack by pack.
struct Memory {
  std::vector<double> rows;         ///< [packs x rows x lanes]
  std::vector<double> along;        ///< [-] [packs x axes x lanes] Report::along of the last step; empty without viscosity
  double work = 0;                  ///< [J] done on the nodes
  Channels<Stored> stored;          ///< [J]
  Channels<Dissipated> dissipated;  ///< [J]
  Vec3 arm = Vec3::Zero();          ///< [kg m] sum of Report::arm now, of fluids with weight
  Vec3 angular_impulse = Vec3::Zero();  ///< [N m s] of that weight
};

/// Forces that a block's tiles exert on their slots. A restart needs them: the work of the next step is half theirs.
struct TileForces {
  Vectors force;   ///< [N]   [3 x slots]
  Vectors moment;  ///< [N m] [3 x slots], plates only
  Scalars thickness;  ///< [m] [elements] of plates whose thickness follows their strain; empty of all others
};

/// The element whose law asks for a thickness that is farthest from that of the reference; of plates.
struct Thinned {
  double ratio = 1;    ///< [-] what the law leaves over that of the reference
  Index element = -1;  ///< -1: none is off
};

/// The largest compression in elements of the law `Elastic`.
struct Pressed {
  double ratio = 0;    ///< [-] of a principal stress over Young's modulus
  Index element = -1;  ///< -1: none is pressed, or the law is another one
};

/// What one solid element holds by its strain.
struct Held {
  double bending = 0;   ///< [J] by bending within it: its hourglass energy
  double strain = 0;    ///< [J] in all, bending included
  double volume = 0;    ///< [m3] now
  bool stiff = false;   ///< whether it bends by springs or dashpots, or its sides lean so much that it is far too stiff
};

/// How unlike its neighbours the solid elements of a block are. [J]
struct Contrast {
  double strain = 0;   ///< what all elements hold by their strain, bending included
  double bending = 0;  ///< what elements hold by bending above the mean of their neighbours
  double density = 0;  ///< what elements hold by their strain above the mean density of their neighbours
};
inline void add(const Contrast& part, Contrast& all) {
  all.strain += part.strain, all.bending += part.bending, all.density += part.density;
}

/// What one tile reports of a step: energies in the order of Memory, the step limit and the smallest volume ratio.
struct TileReport {
  double work;
  Channels<Stored> stored;
  Channels<Dissipated> dissipated;
  double step, volume_ratio;
  Index step_element, volume_element;
  std::array<double, 3> arm;
};

/// Scratch of a step of a block.
struct TileReports {
  std::vector<TileReport> tile;  ///< [tiles]
  Departures departures;
};

/// What a block asks of the run.
struct BlockLimit {
  double step = 1e300;       ///< [s] largest stable step
  Index step_element = -1;
  double volume_ratio = 1e300;       ///< [-] smallest volume or area over that of the reference; NaN if one is
  Index volume_element = -1;
};

/// Options of hexahedra, and by their type which hexahedron is meant: one point, eight, or fluid.
using AnyHexahedronOptions = std::variant<Hexahedron::Options, FullHexahedron::Options, Fluid::Options>;

/// Throws InternalError for a fluid's law with options of solids, and the reverse: readers refuse it.
AnyBlock solids(const mesh::Mesh&, const std::string& region, const AnyLaw&, const AnyHexahedronOptions&);
AnyBlock hexahedra(const mesh::Mesh&, const std::string& region, const AnyLaw&, const Hexahedron::Options&);
/// Throws InternalError for a law that plates may not have: readers refuse it.
AnyBlock plates(const mesh::Mesh&, const std::string& region, const AnyLaw&, const Plate::Options&);
/// The same of some elements of a region, with a name of their own.
AnyBlock solids(const mesh::Mesh&, const std::string& name, const Connectivity& nodes, const AnyLaw&, const AnyHexahedronOptions&);
AnyBlock plates(const mesh::Mesh&, const std::string& name, const Connectivity& nodes, const AnyLaw&, const Plate::Options&);

const std::string& name(const AnyBlock&);
const Connectivity& nodes(const AnyBlock&);
const Tiling& tiling(const AnyBlock&);
/// Whether its nodes rotate: their rotations and moments are wanted too.
bool rotates(const AnyBlock&);
/// Channels of Memory that a block with these options has, in the order in which results list them.
std::vector<Stored> stored_channels(const AnyBlock&);
std::vector<Dissipated> dissipated_channels(const AnyBlock&);
/// How deep an element is behind a face of that area in the reference positions X. [m]
double depth(const AnyBlock&, const Vectors& X, Index element, double area);
/// Distance between the two faces of plates in the reference; zero of solids. [m]
double thickness(const AnyBlock&);
/// Stiffness of spins about the normal of plates, over the shear modulus; zero of solids. [-]
double drilling(const AnyBlock&);
/// Whether the thickness of its elements follows their strain.
bool thins(const AnyBlock&);
/// Which of its plates has thinned most, or would have if its thickness followed its strain.
Thinned thinned(const AnyBlock&, const Vectors& x, const Memory&);

/// Which of its elements is pressed most, of solids whose law is `Elastic`: beyond about 0.61 its surfaces fold.
Pressed pressed(const AnyBlock&, const Memory&);

/// Compares each solid element of a block with its neighbours; zero of plates. With h bending, w strain and V volume of Held:
///
///     bending = sum of max(0, h - mean over its nodes of the mean h there),     density = sum of V max(0, w/V - mean over its nodes of
///     sum w / sum V there)
///
/// All of h counts of an element without neighbours, of one whose sides lean and of springs. A beam that bends has little of either.
/// It takes about as long as two steps.
Contrast contrast(const AnyBlock&, const Vectors& x, const Memory&);

/// The schema of a block in the ledger, and its values now.
Source source(const AnyBlock&);
void post(const AnyBlock&, const Memory&, Account&);

/// Tells a block of plates which column of the angular velocities belongs to which node.
void set_rotations(AnyBlock&, const std::vector<Index>& column_of_node);

/// Adds the mass of the block to its nodes. [kg]
void add_mass(const AnyBlock&, Scalars& mass);
/// Mass of each element. [kg] [elements]
Scalars element_masses(const AnyBlock&);
/// Adds the rotary inertia of a block of plates to its columns of angular velocities. [kg m2]
void add_rotary_inertia(const AnyBlock&, Scalars& inertia);

Memory initial_memory(const AnyBlock&);
TileForces tile_forces(const AnyBlock&);
TileReports tile_reports(const AnyBlock&);

/// Brings a block from the old to the new positions and leaves its forces in `forces`.
///
/// x  [m] at the end of the step;  dx  [m] increment of x over the step, [3 x nodes]
/// rotation  [rad] increment of the rotation of the plate nodes, [3 x plate nodes]
/// dt  [s]; zero at the start, where increments must be zero too: rates, dx / dt, are then zero
/// Work is posted by the trapezoid rule: half with the forces found in `forces`, half with the new.
BlockLimit advance(const AnyBlock&, const Vectors& x, const Vectors& dx, const Vectors& rotation, double dt,
             Memory&, TileForces& forces, TileReports&);

/// Which quantities of elements are wanted, at which places.
using Wanted = std::function<bool(const Shown&)>;

/// A quantity over the elements of a block.
struct Reduced {
  double largest = -std::numeric_limits<double>::infinity();  ///< with its sign
  double sum = 0, mass = 0;                                   ///< of the values times the masses of the elements, and of these [kg]
};
inline void add(const Reduced& part, Reduced& all) {
  all.largest = std::max(all.largest, part.largest), all.sum += part.sum, all.mass += part.mass;
}
/// One component of what fields() has, reduced; fast enough for every step, but for strain.
///
/// X, x  [m] positions in the reference and now
/// component  row of the field
Reduced reduce(const AnyBlock&, const Vectors& X, const Vectors& x, const Memory&, const Shown&, int component);

/// Some elements of a block.
struct Picked {
  std::vector<std::size_t> place;  ///< in the packs of the block: pack * lanes + lane
  std::vector<double> mass;        ///< [kg] beside them
};
/// elements  of the block, ascending
Picked pick(const AnyBlock&, const std::vector<Index>& elements);

/// The same of some of its elements.
Reduced reduce(const AnyBlock&, const Vectors& X, const Vectors& x, const Memory&, const Shown&, int component, const Picked&);

/// What the elements show of what is wanted: stress [Pa], von_mises [Pa], pressure [Pa] (positive in compression), the law's internal
/// scalars, logarithmic strain [-], and thickness [m] of plates whose thickness follows their strain. Tensors are in the global frame.
///
/// Of solids with several points stress is their mean, von_mises and internal scalars are the largest of theirs; the strain is that of
/// the mean deformation gradient. Plates have each but the thickness at each place: at_place(), strain_at_place().
///
/// X, x  [m] reference and current positions
std::vector<Field> fields(const AnyBlock&, const Vectors& X, const Vectors& x, const Memory&, const Wanted& = in_usual_frames);

}  // namespace nereid::element
