#pragma once
// Words of case files that were renamed, so that a fault of an old case names the new word.

#include <string>
#include <string_view>

namespace nereid::input {

/// What the key of a section, or a value of that key, is called now, as a hint; empty if it was never renamed.
///
/// section  path of the section in the case, as in "contacts[3]"
/// value    empty: the key itself is meant
std::string renamed(std::string_view section, std::string_view key, std::string_view value = {});

}  // namespace nereid::input
