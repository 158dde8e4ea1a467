#pragma once
// Names of the parts of a scene: what is one, which are taken, and which columns of the history follow from them.

#include <algorithm>
#include <string>
#include <vector>

#include "model/fault.hpp"
#include "model/scene.hpp"

namespace nereid::model {

/// Whether a name is among others.
inline bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Letters, digits and '_', no digit first. Points are kept for what belongs to a body, as in `bar.x_low`.
bool is_name(const std::string&);

/// What is said of a name that is none.
std::string is_no_name(const std::string&);

/// Whether every history has a column of this name, so that no probe may.
bool is_column_of_every_history(const std::string&);

/// Faults: names that are none, are given twice, or are columns of every history.
///
/// Sources of force and bodies are called by names that come once: the ledger has an account for each.
void check_names_given(const Scene&, Faults&);

/// Faults: names that give the history one column twice, as bodies called `created` and `elastic` do.
void check_columns(const Scene&, const dynamics::Model&, Faults&);

}  // namespace nereid::model
