#pragma once
// Checkpoints: what --checkpoint-every writes, and --resume goes on from.

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/resolved.hpp"
#include "output/recorder.hpp"

namespace nereid::driver {

/// A run at one of its steps.
struct Checkpoint {
  std::string driver, case_hash;
  std::vector<std::string> resolved;  ///< lines_of() the case
  std::uint64_t fingerprint = 0;      ///< dynamics::fingerprint() of the model
  double time = 0;                    ///< [s]
  output::RecorderMark results;               ///< how far they had come
  std::string state;                  ///< dynamics::bytes_of()
};

/// A checkpoint from which a run can not go on, and why.
struct BadCheckpoint : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a case was understood to say, value by value: "time.end = 0.001 s".
std::vector<std::string> lines_of(const std::vector<Resolved>&);

/// Writes FOLDER/checkpoint in one go, in place of an older one. MachineError where that fails.
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint&);
/// The one that is there, if any. BadCheckpoint where it is damaged, cut short or of another version.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder);
void remove_checkpoint(const std::filesystem::path& folder);

/// Puts a simulation that was built of the same case where a checkpoint was. BadCheckpoint where it is of another driver, case or mesh.
void go_back_to(const Checkpoint&, const Checkpoint& of_this_run, model::Simulation&);

}  // namespace nereid::driver
