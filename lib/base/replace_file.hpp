#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace nereid {

/// Makes the folder and those above it; MachineError where that fails.
void make_folder(const std::filesystem::path& folder);

/// Where replace_file() writes before it renames: NAME.tmp beside the file.
std::filesystem::path draft_of(std::filesystem::path file);

/// Writes a file in one go: NAME.tmp first, then renamed, so that whoever watches a running job reads either the old file or the new
/// one and never half of one. MachineError in the system's words where that fails; then the old file stays and the draft goes.
void replace_file(const std::filesystem::path& file, std::string_view bytes);

/// Writes behind the first `begin` bytes of a file and drops what followed them; makes the file where `begin` is zero. MachineError where
/// that fails; then the file ends at `begin`, behind what is whole.
void append_to_file(const std::filesystem::path& file, std::uint64_t begin, std::string_view bytes);

}  // namespace nereid
