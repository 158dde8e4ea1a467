#pragma once
// What a run names as a remedy in its warnings and notes. A remedy stands here if a run has shown that it helps; no other is named.

#include <array>
#include <string>

namespace nereid::model {

enum class Remedy {
  multiplier, firmer_contact, exchange_sides, two_passes, refine_apexes, near_origin, declare_contact,
  follow_strain, drilling, neo_hookean, assumed_strain, spread_force, finer_mesh, eight_points, estimate_error,
  shorter_step, wider_elements
};

struct RemedyWords {
  const char* id;     ///< of its test in tests/drivers/remedies.py
  const char* cause;  ///< what it removes
  const char* where;  ///< it is named, and nowhere else
  const char* words;  ///< in a message, behind what happened
};

/// In the order of Remedy. docs/remedies.md is generated from it.
inline constexpr std::array<RemedyWords, 17> remedy_words{{
    {"multiplier", "a penalty whose stiffness shortens the steps of the run", "contacts, rigid planes and ties that may have multipliers",
     "'method: multiplier' has no step limit of its own"},
    {"firmer_contact", "a penalty that is penetrated by more than half an element",
     "contacts, rigid planes and ties by a penalty that may have multipliers", "'method: multiplier' prevents such a penetration"},
    {"exchange_sides", "apexes farther apart than the nodes of the base", "one pass with a base that is finer both ways",
     "exchange 'apexes' and 'base'"},
    {"two_passes", "nodes of the base that no apex holds", "contacts in one pass", "take 'passes: two'"},
    {"refine_apexes", "nodes of the base that no apex holds", "ties whose sides are each finer in one direction",
     "refine the surface of the apexes"},
    {"near_origin", "round-off of positions far from the origin", "bodies ten times their size away from it",
     "move the scene to the origin"},
    {"declare_contact", "bodies that pass through each other", "overlaps of bodies that no contact joins",
     "no contact between them is declared"},
    {"follow_strain", "plates of constant thickness under large strain", "plates with a constant thickness",
     "'thinning: follows_strain' updates the thickness"},
    {"drilling", "nodes of plates that spin about their normals", "plates with 'drilling: 0'",
     "'drilling: 0.1', the default, adds this stiffness"},
    {"neo_hookean", "the hypoelastic law, pressed until it is unstable", "solids of the law 'elastic'",
     "'kind: neo_hookean' is hyperelastic"},
    {"assumed_strain", "springs or dashpots that are weaker than the bending of an element", "solids with either",
     "'hourglass_kind: assumed_strain', the default, gives elements their own bending stiffness"},
    {"spread_force", "a force on a single node, which no mesh resolves", "bodies with a force, a spring or a point mass on one node",
     "a force on a single node should act on a surface"},
    {"finer_mesh", "strain energy that is concentrated in single elements", "solids without a force on a single node",
     "run again with '--set refine=1.5' (2 for meshes from files), about 6 times the element updates"},
    {"eight_points", "the largest plastic strain of a coarse mesh", "probes of it",
     "'kind: full' comes nearer to that of a finer mesh"},
    {"estimate_error", "results whose mesh error is unknown", "notes on meshes",
     "'--accuracy' with '--of' estimates the mesh error of a result"},
    {"shorter_step", "a temporary error of the kinetic energy by time integration", "all scenes",
     "a smaller 'time.safety' reduces it with the square of the step"},
    {"wider_elements", "few elements that are much smaller than the others", "scenes whose steps they limit",
     "a mesh without such elements allows longer steps"},
}};

inline const RemedyWords& words(Remedy remedy) { return remedy_words[static_cast<std::size_t>(remedy)]; }

/// A remedy as the end of a message.
inline std::string said(Remedy remedy) { return words(remedy).words; }

}  // namespace nereid::model
