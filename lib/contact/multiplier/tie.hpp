#pragma once
// Ties without a penalty: in each step the impulses after which every tied apex is over its point of the base again, or at its height.
//
// Its point of the base is the point (a, b) of a bilinear face of a hexahedron, else of a facet. There t_a and t_b are the derivatives of
// place, n = t_a x t_b / A with A = |t_a x t_b|, and the gradients of the shape functions in the surface are
//
//     G_I = (dN_I/da t_b x n + dN_I/db n x t_a) / A,        so dn = - sum of (n . dx_I) G_I
//
// With d = x_apex - sum of w_I x_I - h n of a tie the rate of d and the nodes' parts of an impulse J on the apex are
//
//     r = v_apex - sum of w_I v_I + h sum of (n . v_I) G_I,        apex  J,    base nodes  -w_I J + h (G_I . J) n
//
// so impulses have no resultant, and no moment where d vanishes. They keep d zero to the end of the step to come, with all turns of facets,
// and take a fifth of what round-off has left of it. Preconditioned conjugate residuals find them all together: no order of the ties
// counts, and ties may say the same twice. docs/theory/multipliers.md has more.
//
// A tie that slides (Interface::slides) holds n . d alone, with the foot of its apex at t in place of the point where it began. The
// gradient of this height is n on the apex and -w_I n on the base, whatever h is, so an impulse along n has no couple.

#include <span>

#include "contact/data/any.hpp"
#include "contact/multiplier/motion.hpp"
#include "contact/surface/stand.hpp"

namespace nereid::contact {

/// One tied apex in a step.
struct HeldTie {
  int nodes;                     ///< 4 over a facet, 5 over a face of a hexahedron; 1 of an apex that has slid off its base
  Index facet;                   ///< over which it is now
  int first;                     ///< of the facet's nodes: that where the cut of the face begins
  std::array<Index, 5> node;     ///< the apex, then those of the facet from `first` on, then Half::fourth
  std::array<double, 5> weight;  ///< 1, then minus those of the tie
  std::array<Vec3, 4> gradient;  ///< [1/m] of the shape functions, at t; of a tie with a height
  Vec3 normal;                   ///< of the base at the point of the tie, at t
  double height;                 ///< [m] that the facet's turns move; zero of a tie that slides
  Vec3 off;                      ///< [m] d at t
  Mat3 inverse;                  ///< [kg] of what an impulse on it does to its own rate; without directions in which nothing moves
  double along;                  ///< [kg] the same along the normal, of a tie that slides
  bool slides;                   ///< it holds along the normal alone
  double per_mass;               ///< [1/kg] mean over the directions, as if nothing were constrained
  double still;                  ///< [m/s] rate that is round-off
  Vec3 impulse;                  ///< [N s] on the apex, so far
  Vec3 change;                   ///< [N s] what the solver adds to it
  Vec3 residual, guess, answer;  ///< of the solver: missing rate [m/s], impulse of that alone [N s], rate that this makes [m/s]
  Vec3 way, way_answer;          ///< the same of its direction
  bool has_walked = false;       ///< of a tie that slides: in this step to another facet
};

/// What ties by multipliers work with and may throw away between steps.
struct Ties {
  struct Use {
    Index tie;
    int place;  ///< in HeldTie::node
  };
  std::vector<HeldTie> held;
  std::vector<Index> first;      ///< [interfaces, then one] of their ties
  Subset nodes;                  ///< ascending
  std::vector<Index> begin;      ///< [nodes, then one] of their uses
  std::vector<Use> uses;         ///< with room for all ties over faces
  std::vector<bool> has;         ///< [nodes of the mesh]
  Subset begin_of;               ///< [nodes of the mesh] where uses are counted
  Vectors change;                ///< [m/s] [nodes of the mesh] what the impulses of the solver do
  std::vector<double> partial;   ///< sums of ranges, in order
  bool any_height = false;       ///< some tie has one
  bool touched = false;          ///< a contact acts on a node of a tie
  std::int64_t iterations = 0;   ///< of the solver, since the start
};

/// The ties of one interface, in the order of Memory::near.
inline std::span<const HeldTie> ties_of(const Ties& all, std::size_t interface) {
  return {all.held.data() + all.first[interface], all.held.data() + all.first[interface + 1]};
}

/// nodes  of the mesh
/// Needs  tie_here() where that is called
Ties make_ties(std::span<const AnyContact>, Index nodes);

/// Starts a step: ties as they stand at t, with the impulses of the step before as a first guess, and solves them.
///
/// Ties that slide are moved to where their apexes stand; those past the border of their base are let go for good.
///
/// velocity  [m/s] of the step to come without ties; then with them
void find_ties(std::span<const AnyContact>, const Motion&, std::span<const AnyMemory>, Vectors& velocity, Ties&);

/// Changes impulses and velocities until the ties hold at the end of the step to come.
void hold(const Motion&, Vectors& velocity, Ties&);

/// The rate of d with these velocities of the nodes. [m/s]
Vec3 rate(const HeldTie&, const Vectors& v);

/// What an impulse on the apex gives to a node of a tie. [N s]
Vec3 part(const HeldTie&, int place, const Vec3& impulse);

/// Writes impulses into the memory of an interface as forces, and books what the tie does but for half steps.
///
/// ties     of this interface
/// velocity  [m/s] in the step to come
void take_over(const Interface&, const Motion&, std::span<const HeldTie> ties, const Vectors& velocity, Memory&);

/// Books impulses at the start, which stop what moves against the tie.
///
/// impulse  [N s] on the nodes, added to
void book_start(const Motion&, std::span<const HeldTie> ties, const Vectors& velocity, Memory&, Vectors& impulse);

/// Whether an apex stands too far past the border of its base to be tied: half of what a border apex stands for lies inside.
bool is_past_border(const BaseSurface&, const Vectors& x, const Stand&);

/// The tie of an apex at x over a facet; by multipliers over the face that this is half of.
Tie tie_over(const Interface&, const Vectors& x, Index apex, Index facet);

/// Puts the ties of an interface where its apexes are at x.
void tie_here(const Vectors& x, Interface&);

/// The normal of the base at the point where an apex is tied. Unit vector.
Vec3 normal_of(const Interface&, const Near&, const Vectors& x);

}  // namespace nereid::contact
