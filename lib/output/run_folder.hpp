#pragma once
// The folder that a run writes to: whose it is, what of an older run stands in it, and when that goes.

#include <filesystem>
#include <vector>

namespace nereid::output {

/// The file from which a run goes on.
inline constexpr const char* checkpoint_name = "checkpoint";

/// Files of a folder that a run writes or clears, of those that are there: summary.json, history.csv, these two with
/// `.stale` behind, checkpoint, run.lock, and index and frames of the collections body, contact, walls and offenders.
std::vector<std::filesystem::path> result_files(const std::filesystem::path& folder);

/// The one of result_files() that is this very file, by whatever name or link; empty if none is, or there is no such file.
std::filesystem::path result_that_is(const std::filesystem::path& folder, const std::filesystem::path& file);

/// The folder of one run, held from before the case is read until the object or its process ends.
///
/// Held by a lock on FOLDER/run.lock, so that a killed run leaves nothing that blocks. MachineError, with nothing
/// touched, where another run holds the folder. A file system that cannot lock gives a warning on stderr.
class RunFolder {
 public:
  /// goes_on  whether the run goes on with the results that are there: it holds the folder, nothing becomes stale, and names that a killed
  ///          run had changed are given back.
  /// Holds a folder that is there, and calls set_aside(). A folder that is not there is left so; "" is none at all.
  explicit RunFolder(std::filesystem::path folder, bool goes_on = false);
  /// Removes what is stale, and the lock. Beside a checkpoint it gives stale files their names back: the older run can still go on.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// Adds `.stale` to the names of what an older run would be judged by: summary.json and history.csv, unless one begins like a mesh, with
  /// '<', and so may be an input.
  void set_aside();

  /// Gives back the names of what is stale, if anything is, and says whether: to see whether they are inputs, and for a run that is refused
  /// because it would overwrite them.
  bool restore();

  /// Makes and holds the folder if it was not there, and removes all results of an older run. Call it once it is known
  /// that none of them is an input. MachineError where that fails.
  void clear();

 private:
  void hold();
  void take_back();

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> renamed_;  ///< their names as they were
  bool held_ = false, goes_on_ = false;
  int lock_ = -1;  ///< the open run.lock; -1 if there is none, or it could not be locked
};

}  // namespace nereid::output
