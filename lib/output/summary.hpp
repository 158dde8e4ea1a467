#pragma once
// summary.json: how a run ended, what it found, what it cost and where it came from.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/resolved.hpp"
#include "dynamics/ledger.hpp"
#include "dynamics/measure.hpp"

namespace nereid::output {

/// A number the run answers with. NaN says that there is none.
struct Result {
  std::string name;
  double value = 0;
  std::string unit;
};

struct Cost {
  std::int64_t elements = 0, steps = 0, element_updates = 0;
  double wall_seconds = 0, nanoseconds_per_element_update = 0;
  int threads = 1;
  std::int64_t frames = 0;  ///< of the bodies
  double frames_every = 0;  ///< [s] between them
  contact::Spent contact;   ///< by multipliers
};

struct Ending {
  std::string word;           ///< "reached_end", "inverted_element", ...
  std::string reason;         ///< the sentence a person reads
  double time = 0;            ///< [s]
  std::string block;          ///< empty where no block is to blame
  std::int64_t element = -1;  ///< -1 where no element is to blame
};

/// Two bodies that were in each other, or one in itself, as the audit found them.
struct Overlap {
  std::array<std::string, 2> bodies;
  std::vector<std::string> contacts;  ///< those declared between them
  double deepest = 0, at_start = 0;   ///< [m]
  double elements = 0;                ///< [-] by which it grew since the start
  Vec3 place = Vec3::Zero();          ///< [m] of the worst
  double time = 0;                    ///< [s]
};

struct Summary {
  std::string driver, case_path, case_hash;
  Ending ending;
  std::vector<Result> results;
  std::vector<Source> sources;  ///< of the ledger
  dynamics::Ledger ledger;
  std::vector<Overlap> overlaps;
  std::vector<dynamics::Touched> touched;
  Cost cost;
  std::vector<Resolved> resolved;
  std::vector<std::string> not_used;  ///< paths of the case that this driver did not read
  std::vector<std::string> notes;     ///< sentences that a reader of the results needs, warnings among them
  std::vector<std::string> warnings;  ///< those of them that tell of an error, or of what may be one
};

/// Which program on which machine, as the build knew it.
struct Provenance {
  std::string version;
  std::string commit;  ///< 40 digits, "-dirty" behind them if the code was changed; or "unknown"
  std::string compiler, flags, build_type;
  bool native = false;    ///< built for the processor that built it
  std::string processor;  ///< of the machine that runs
};

Provenance provenance();

/// What summary.json holds. Needs names that come once, else InternalError.
std::string text_of(const Summary&);

/// How a run ended that has left a summary, and of which case it was; empty without one.
struct Ended {
  std::string word, case_hash;
};
Ended ended(const std::filesystem::path& directory);

/// Writes DIRECTORY/summary.json; in one go, so that half a summary never stands there.
///
/// Every physical quantity is {"value", "unit"}; what is no number is null.
/// Needs  names that come once, else InternalError; a disk that takes it, else MachineError.
void write_summary(const std::filesystem::path& directory, const Summary& summary);

}  // namespace nereid::output
