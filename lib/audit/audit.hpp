#pragma once
// The audit: which bodies overlap, how deep and where, from positions and the connectivity of elements alone.
//
// The depth of a point of one body inside another is its distance from the skin of the other. Points are the nodes of the skin, the
// middles of its faces, those half an element behind them, and the edges of the skin as far as they run inside: two bodies that
// pass through each other without a node in the other are found by their edges. docs/theory/audit.md.

#include <map>

#include "audit/placed.hpp"

namespace nereid::audit {

/// The deepest place of two surfaces in each other, as parts of an element.
struct Depth {
  double depth = 0;           ///< [m]
  double size = 1;            ///< [m] of the smaller element there
  double open = 0;            ///< [m] what the faces of both leave open there: left_open()
  Vec3 place = Vec3::Zero();  ///< [m]
  std::array<Index, 2> region{-1, -1};  ///< places in Surfaces::names: whose point it is, and what it is in
};

inline double in_elements(const Depth& at) { return at.depth / at.size; }
/// By how much a depth is unsure: what the faces leave open, where that is more than the elements are thick. [m]
inline double unsure(const Depth& at) { return std::max(0.0, at.open - at.size); }
/// What is sure of a depth, in elements; below zero where nothing is.
inline double surely_in_elements(const Depth& at) { return (at.depth - unsure(at)) / at.size; }

/// What one look finds of two surfaces.
struct Found {
  Depth worst;         ///< the largest part of an element
  Depth surest;        ///< where the sure part is largest
  double deepest = 0;  ///< [m] the largest depth, which may be elsewhere
};

/// What a run has seen of two surfaces that overlap.
struct Overlap {
  std::array<Index, 2> surface{-1, -1};  ///< places in Surfaces::list, ascending; twice the same: itself
  double at_start = 0;                   ///< [m] how deep they were in each other at the start
  double accepted = 0;                   ///< [m] the same, but zero once they have parted: what comes after is new
  double allowed = 0;                    ///< [m] see Workspace::allowed
  double deepest = 0;                    ///< [m] the largest so far
  double grown = 0;                      ///< [-] elements, beyond what was accepted or is allowed; the largest so far
  Depth worst;                           ///< where that was
  double time = 0;                       ///< [s] when
  double sure = 0;                       ///< [-] the same of what is sure of the depths
  Depth surest;                          ///< where that was
  double sure_time = 0;                  ///< [s] when
};

/// What a restart needs of the audit.
struct Memory {
  std::vector<Overlap> overlaps;  ///< in the order of their surfaces
  std::int64_t looks = 0;
};

/// Surfaces and the scratch of a look at them; made anew from the mesh at a restart.
struct Workspace {
  Surfaces surfaces;
  std::vector<Placed> placed;   ///< beside Surfaces::list
  std::vector<Placed> shells;   ///< beside Surfaces::shells
  /// [m] by which two surfaces, their places ascending, may always overlap; nothing where they are not named
  std::map<std::array<Index, 2>, double> allowed;
  std::vector<char> inside;     ///< [points] of one surface: in another, or on which side of a sheet
  std::vector<Found> parts;     ///< of ranges of points, faces or edges, in order
  std::vector<Index> group;     ///< [points] of a surface that a sheet cuts: connected on one side of the sheet
  std::vector<double> reach;    ///< [m] [points] how far from the sheet
  Scalars half_growth;          ///< [m] [nodes] by which half the thickness of plates has grown since the start; empty where it has not
};

Workspace make_workspace(Surfaces);

/// Brings the positions of all surfaces and shells up to date.
void place(const Vectors& x, Workspace&);

/// How deep surfaces are in each other where they stand; nothing if they are apart or only touch. Needs place() before.
Found overlap(Workspace&, Index first, Index second);
/// How deep a surface is in itself.
Found overlap_with_itself(Workspace&, Index surface);

/// Looks at all surfaces, each with every other piece and with itself, and notes what overlaps. The first look is that at the start.
///
/// x  [m] positions now, t [s]
/// also_itself  whether bodies are looked at for overlaps with themselves too, which costs the most
/// Invariants  the same bits with any number of threads; no memory but for a pair that overlaps for the first time
void look(const Vectors& x, double t, bool also_itself, Workspace&, Memory&);

/// The overlap that has grown most, in elements; null if there is none.
const Overlap* worst(const Memory&);
/// The same of what is sure of the depths.
const Overlap* surest(const Memory&);

}  // namespace nereid::audit
