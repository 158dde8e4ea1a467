#pragma once
// Blocks: elements of one kind, of one material, cut into tiles and worked pack by pack.

#include <string>
#include <variant>
#include <vector>

#include "base/account.hpp"
#include "base/field.hpp"
#include "element/full_hexahedron.hpp"
#include "element/hexahedron.hpp"
#include "element/plate.hpp"
#include "element/tiles.hpp"
#include "material/elastic.hpp"
#include "material/j2_bilinear.hpp"
#include "material/j2_mixed.hpp"
#include "mesh/mesh.hpp"

namespace nereid::element {

using Connectivity = Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic>;

/// Elements of one kind, of one material. Constant in time.
template <class Kind, material::Law Law>
struct Block {
  std::string name;
  Law law;
  typename Kind::Options options;
  Connectivity nodes;             ///< [nodes per element x elements]
  Tiling tiling;
  std::vector<double> constants;  ///< [packs x rows x lanes]
  Layers layers;                  ///< through the thickness; none in a solid
  std::vector<Index> turning;     ///< [places] column of each place's angular velocity; plates only
};

/// Every combination that exists. One that is not on this list does not compile.
using AnyBlock = std::variant<Block<Hexahedron, material::Elastic>, Block<Hexahedron, material::J2Bilinear>,
                              Block<FullHexahedron, material::Elastic>, Block<FullHexahedron, material::J2Bilinear>,
                              Block<Plate, material::Elastic>, Block<Plate, material::J2Bilinear>,
                              Block<Hexahedron, material::J2Mixed>, Block<FullHexahedron, material::J2Mixed>,
                              Block<Plate, material::J2Mixed>>;
using AnyLaw = std::variant<material::Elastic, material::J2Bilinear, material::J2Mixed>;

/// What the elements of one block remember; one type for all blocks. Rows lie pack by pack.
struct Memory {
  std::vector<double> rows;      ///< [packs x rows x lanes]
  double work = 0;               ///< [J] done on the nodes
  std::array<double, 2> stored{};  ///< [J] in the order of Kind::stored
  double plastic = 0, viscous = 0, hourglass = 0;  ///< [J] dissipated, in the order of Kind::dissipated
};

/// Forces that a block's tiles exert on their places; a function of the state, thrown away at will.
struct TileForces {
  Vectors force;   ///< [N]   [3 x places]
  Vectors moment;  ///< [N m] [3 x places], plates only
  /// One column per tile: sums in the order of Memory, the step vote and the smallest size.
  struct Report {
    double work, stored[2], plastic, viscous, hourglass, step, size;
    Index step_element, size_element;
  };
  std::vector<Report> reports;  ///< [tiles]
};

/// What a block asks of the run.
struct Vote {
  double step = 1e300;       ///< [s] largest stable step
  Index step_element = -1;
  double size = 1e300;       ///< [-] smallest volume or area over that of the reference; NaN if one is
  Index size_element = -1;
};

/// Options of hexahedra, and by their type which hexahedron is meant: one point or eight.
using AnyHexahedronOptions = std::variant<Hexahedron::Options, FullHexahedron::Options>;

AnyBlock solids(const mesh::Mesh&, const std::string& region, const AnyLaw&, const AnyHexahedronOptions&);
AnyBlock hexahedra(const mesh::Mesh&, const std::string& region, const AnyLaw&, const Hexahedron::Options&);
AnyBlock plates(const mesh::Mesh&, const std::string& region, const AnyLaw&, const Plate::Options&);

const std::string& name(const AnyBlock&);
const Connectivity& nodes(const AnyBlock&);
const Tiling& tiling(const AnyBlock&);
bool is_plate(const AnyBlock&);
/// Names of the shares of Memory that a block with these options has, in order.
std::vector<std::string> stored_names(const AnyBlock&);
std::vector<std::string> dissipated_names(const AnyBlock&);

/// The schema of a block in the ledger, and its values now.
Source source(const AnyBlock&);
void post(const AnyBlock&, const Memory&, Account&);

/// Tells a block of plates which column of the angular velocities belongs to which node.
void set_turning(AnyBlock&, const std::vector<Index>& column_of_node);

/// Adds the mass of the block to its nodes. [kg]
void add_mass(const AnyBlock&, Scalars& mass);
/// Mass of each element. [kg] [elements]
Scalars element_masses(const AnyBlock&);
/// Adds the rotary inertia of a block of plates to its columns of angular velocities. [kg m2]
void add_rotary_inertia(const AnyBlock&, Scalars& inertia);

Memory initial_memory(const AnyBlock&);
TileForces tile_forces(const AnyBlock&);

/// Brings a block from the old to the new positions and leaves its forces in `forces`.
///
/// x  [m] at the end of the step;  v [m/s], w [rad/s] constant over it;  dt [s], zero at the start
/// Work is posted by the trapezoid rule: half with the forces found in `forces`, half with the new.
Vote advance(const AnyBlock&, const Vectors& x, const Vectors& v, const Vectors& w, double dt,
             Memory&, TileForces& forces);

/// What the elements show: stress in the global frame (mean over points or through the thickness),
/// von_mises and the law's internal scalars (largest over points or through the thickness), pressure
/// (positive in compression).
std::vector<Field> fields(const AnyBlock&, const Vectors& x, const Memory&);

}  // namespace nereid::element
