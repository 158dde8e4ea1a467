#pragma once
// Where the audit of overlaps meets a run: what it is given of a model, when it looks, and when it stops the run.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// The surfaces of a model for its audit: all regions of its mesh, plates with their thickness, and its planes of symmetry.
audit::Surfaces audited_surfaces(const Model&);

/// By how much the shells of two surfaces may overlap, since a contact closes at a height that is less than their half thicknesses. [m]
std::map<std::array<Index, 2>, double> allowed_overlaps(const Model&, const audit::Surfaces&);

/// Element updates between two looks for overlaps of bodies with themselves, over the edges of all surfaces: about a hundredth of the
/// time of a run.
constexpr std::int64_t updates_per_edge = 200;

/// Whether a look is due: `every` seconds, or at each update of the ledger where that is zero.
bool audit_is_due(double every, const State&);

/// Looks at the overlaps of all bodies where a look is due, or in any case if the run ends here. Needs a state whose ledger is current.
///
/// every  [s] between two looks; zero: at each update of the ledger
void update_overlaps(const Model&, bool last, double every, State&, Forces&);

/// Whether a contact joins two surfaces of the audit, either way round; edges over edges go with other contacts.
bool joins(const contact::AnyContact&, const audit::Surfaces&, const audit::Overlap&);

/// Which two bodies overlap, as in "a and b"; of a body and itself, or two parts of one, its name alone.
std::string bodies(const audit::Surfaces&, const audit::Overlap&);

/// An overlap in words: which bodies, how deep at its worst, where and when.
std::string in_words(const audit::Surfaces&, const audit::Overlap&);

}  // namespace nereid::dynamics
