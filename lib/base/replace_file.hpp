#pragma once
#include <filesystem>
#include <string_view>

namespace nereid {

/// Makes the folder and those above it; MachineError where that fails.
void make_folder(const std::filesystem::path& folder);

/// Writes a text file in one go: NAME.tmp first, then renamed, so that whoever watches a running
/// job reads either the old file or the new one and never half of one. MachineError where that
/// fails.
void replace_file(const std::filesystem::path& file, std::string_view text);

}  // namespace nereid
