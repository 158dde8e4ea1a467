#pragma once
// Writes histories, frames and the progress line while a simulation runs.

#include <filesystem>

#include "base/beside.hpp"
#include "model/build.hpp"
#include "output/frames.hpp"
#include "output/history.hpp"
#include "output/progress.hpp"

namespace nereid::output {

Precision output_precision(const model::Recording&);
FrameFields frame_fields(const model::Recording&);

/// Columns of the history behind the time: the probes with a name, and the ledger; and a row of them.
std::vector<Column> columns_of(const std::vector<dynamics::Probe>&, const std::vector<dynamics::Probe>& ledger);
std::vector<double> row_of(const dynamics::View&, const std::vector<dynamics::Probe>&, const std::vector<dynamics::Probe>& ledger);

/// How far the results of a run have come: what a checkpoint counts on.
struct RecorderMark {
  std::uint64_t history = 0;  ///< [bytes] of history.csv
  std::int64_t frame = 0;     ///< the last one, as multiple of the interval
  grid::CollectionMark body, contact, walls;
};

/// An observer of a run: columns are the probes of the simulation that have a name, then the ledger. Frames are written beside the run, one
/// at a time; where the next one is due before that is done, the run waits. What goes wrong with one is thrown by a later call.
class Recorder {
 public:
  /// The simulation must outlive the recorder.
  Recorder(const model::Simulation&, const std::filesystem::path& out, bool quiet);
  /// Goes on with results where they were; what was written after that is dropped.
  Recorder(const model::Simulation&, const std::filesystem::path& out, bool quiet, const RecorderMark&);

  void operator()(const dynamics::View&);
  /// The last state, whatever the run ended with.
  void finish(const dynamics::View&);

  /// Puts all on the disk and says how far it has come.
  RecorderMark mark();

  /// After finish(): values of frames that are written as 0, and how many frames there are.
  std::int64_t replaced() const { return body_.replaced() + contact_.replaced(); }
  int frames() const { return body_.frames(); }

 private:
  void add_frame(const dynamics::View&, bool with_walls = false);

  const model::Simulation& simulation_;
  const std::vector<dynamics::Probe>& probes_;
  std::vector<dynamics::Probe> ledger_;
  FrameFields fields_;
  Progress progress_;
  History history_;
  Collection body_, contact_, walls_;
  std::int64_t frame_ = 0;
  Beside writer_;  // the last member, so that it ends before what it writes to
};

}  // namespace nereid::output
