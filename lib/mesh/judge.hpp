#pragma once
// What is wrong with a mesh, found before anything moves: from positions and the nodes of elements alone.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace nereid::mesh {

/// What can be wrong with elements.
enum class Flaw {
  far_away, inverted, misfolded, no_area, folded, repeated, crowded, same_side,  // refused
  coincident, laid_over, hinged, dented, opposed, flat_fold,                     // warned of
  unsplittable                                                                   // refused where meshes are split: mesh/split.hpp
};

/// What is said of a flaw, and what follows.
struct FlawWords {
  const char* name;    ///< of a field of elements that have it
  bool is_refused;     ///< it cannot be meant; else it is warned of
  const char* phrase;  ///< behind "3 elements"
};
/// In the order of Flaw.
inline constexpr std::array<FlawWords, 15> flaw_words{{
    {"far_away", true, "so far from the origin that fewer than six digits are left of their size"},
    {"inverted", true, "whose Jacobian is not positive at a Gauss point, as where two nodes are exchanged"},
    {"misfolded", true, "whose corners coincide in an order that is no solid; right are 1 2 3 3 4 5 6 6 (wedge), 1 2 3 4 5 5 5 5 "
                        "(pyramid) and 1 2 3 3 4 4 4 4 (tetrahedron), also turned"},
    {"no_area", true, "without area"},
    {"folded", true, "of a quadrilateral whose halves face away from each other, as where its sides cross"},
    {"repeated", true, "on the same nodes as another one"},
    {"crowded", true, "at a face shared by more than two hexahedra"},
    {"same_side", true, "on the same side of a face as a neighbour"},
    {"coincident", false, "with a node at the place of another node, not joined to it"},
    {"laid_over", false, "at the place of another one that has nodes of its own"},
    {"hinged", false, "joined to others by an edge or a corner only, as by a hinge"},
    {"dented", false, "with a corner whose Jacobian is not positive, which a run does not check"},
    {"opposed", false, "whose top continues as the bottom of a neighbour, since their nodes are in opposite orders"},
    {"flat_fold", false, "folded flat onto a neighbour, so that one lies on the other"},
    {"unsplittable", true, "that cannot be split: collapsed and no wedge, or beside one whose edge is the diagonal of their face"},
}};
inline const FlawWords& words(Flaw flaw) { return flaw_words[static_cast<std::size_t>(flaw)]; }

/// Where a mesh comes from.
struct Origin {
  /// What an element is called there: hexahedra, then triangles, region after region; the halves of a quadrilateral are called alike.
  /// Empty: they are counted in that order.
  std::vector<std::int64_t> numbers;
  std::int64_t lonely = 0;  ///< points of no element, which were left out
  std::vector<std::string> doubts = {};  ///< about its file, each a part of a sentence
};

/// Elements with one flaw, counted as in Origin, ascending.
struct Finding {
  Flaw flaw;
  std::vector<Index> elements;
};

/// Looks at a mesh. Of elements that have lost their digits nothing else is said, and of a face only where the corners are in order.
///
///     inverted    J <= 1e-9 V at one of the eight Gauss points of a hexahedron, whatever its integration
///     misfolded   corners of a hexahedron coincide so that two of its faces have three in common, or one has a corner twice
///     dented      not so, but J <= 1e-9 |e1| |e2| |e3| at a corner; one with an edge of no length is passed over
///     no_area     2 A <= 1e-9 of the square of the longest side
///     folded      n1 . n2 < 0 of the two halves of a quadrilateral
///     far_away    the shortest edge <= 1e6 epsilon max |x|
///     flat_fold   two triangles at an edge with an angle of less than 1e-6 between them
///     opposed     the only two triangles at an edge, not folded flat, which both run along it in the same direction
///     coincident  two nodes nearer than 1e-5 of the shortest edge at either
///
/// Faces join hexahedra to each other and to triangles on them, edges join triangles; all else is a hinge.
std::vector<Finding> judge(const Mesh&, const Origin& = {});

/// The same of digits alone, for meshes that are sound by their making.
std::vector<Finding> judge_digits(const Mesh&);

/// Those that are refused, or those that are not.
std::vector<Finding> refused(const std::vector<Finding>&, bool is_refused = true);

/// A finding in words, as "3 elements without area: cells 4, 7, 9"; at most eight numbers. `elements` is what those are called.
std::string in_words(const Finding&, const Origin&, const std::string& elements = "elements");

/// Where a program that has an --out shows elements with flaws.
inline constexpr const char* where_shown = "a run with --out shows them in offenders.pvd";

/// Elements with flaws, as they can be shown.
struct Offenders {
  std::string of;                     ///< the body, or the file
  Vectors X;                          ///< [m]
  Table<8> hexahedra;                 ///< the first elements
  Table<3> triangles;                 ///< the rest
  std::vector<std::int64_t> numbers;  ///< [elements] as the origin calls them
  std::vector<std::int32_t> flaws;    ///< [elements] the sum of 2^Flaw
};
Offenders offenders(const std::string& of, const Mesh&, const Origin&, const std::vector<Finding>&);

/// For each node the first one at its place: itself if it is alone. [nodes]
std::vector<Index> places(const Mesh&);

/// Two regions with elements at the same places and nodes of their own.
struct Overlay {
  std::array<std::string, 2> regions;
  std::vector<Index> elements;  ///< of the second, counted as in Origin, ascending
};
/// Elements of one region laid over those of another, by their places; regions in the order of the mesh.
std::vector<Overlay> overlays(const Mesh&);

}  // namespace nereid::mesh
