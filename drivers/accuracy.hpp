#pragma once
// --accuracy 2% --of RESULT: the same case on finer and finer meshes, until the error of a result is within a target.

#include <functional>
#include <string>
#include <vector>

#include "base/convergence.hpp"
#include "input/preset.hpp"
#include "output/summary.hpp"

namespace nereid::driver {

struct Target {
  double part = 0;       ///< [-] of the result; zero: none is asked for
  std::string of;        ///< the result; empty: the first that is not zero
  double longest = 3600; ///< [s] that a run may take, as foreseen
};

/// The part that a text says, as in `2%` and `0.02`; 0 if it says none between 0 and 1.
double part_of(const std::string& text);

/// How a run ended and what it answered with.
struct Ran {
  int status = 0;
  std::vector<output::Result> results;
  double updates = 0, seconds = 0;
};

/// Adds what is known of the error of a run to its results, before its summary is written.
using Judge = std::function<void(const Ran&, std::vector<output::Result>&)>;

/// Runs the case with its counts of cells times a factor [-]; a first look writes nothing and may stop without a word.
using RunOnce = std::function<Ran(double refine, bool first_look, const Judge&)>;

/// The factors on counts of cells [-] that all meshes of a case can follow, those of split_factors where any is from a file.
struct Factors {
  std::vector<double> all;  ///< rising
  double first = 1;         ///< that of the first mesh
  std::string at_end;       ///< why there is none beyond
};
Factors factors_of(const std::vector<input::CaseMesh>&);

/// Runs on a coarse mesh and then on finer ones until the estimated error of the result (mesh_error()) is within the target.
///
/// The last run is the one that is written, with RESULT_mesh_error among its results.
///
/// say      takes a line for each mesh
/// status   exit status of the last run; 2 if the result is not there; 6, and no text, where a signal ended it
/// returns  an empty text, or why the target is not met: before a run that is foreseen to take too long
std::string run_to_target(const Target&, const Factors&, const RunOnce&, const std::function<void(const std::string&)>& say, int& status);

/// Why no factor on counts of cells makes a case finer as a whole; empty if one does.
///
/// all_rigid  no body of the case deforms, so that what its meshes have is geometry
std::string why_not_finer(const std::vector<input::CaseMesh>&, bool all_rigid);

/// What an estimate of the error of meshes leaves out, a line each.
std::vector<std::string> left_out(const std::vector<input::CaseMesh>&);

/// "12 s", or from a minute on "3 min".
std::string duration(double seconds);

}  // namespace nereid::driver
