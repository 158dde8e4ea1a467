#pragma once
// What all drivers share: the command line, the files, the exit status.
//
//     DRIVER --keys
//     DRIVER CASE.yaml --out DIR [--set key=value]... [--threads N] [--dry-run] [--quiet] [--checkpoint-every TIME] [--resume]

#include <functional>
#include <string>
#include <vector>

#include "input/readers.hpp"
#include "input/scene_readers.hpp"
#include "mesh/judge.hpp"
#include "output/frames.hpp"
#include "output/history.hpp"
#include "output/summary.hpp"

namespace nereid::driver {

/// Exit status of a program: docs/running.md.
enum Status { done = 0, bad_case = 2, stopped = 3, our_fault = 4, machine = 5, interrupted = 6 };

/// Reads a case and builds its simulation: fills a model::Scene and ends with input::build.
using Build = std::function<model::Simulation(const input::CaseFile&)>;

/// What the driver answers with, asked after the run: from the last state and what its probes remember.
using Results = std::function<std::vector<output::Result>(const model::Simulation&)>;

/// Runs a driver from its command line to its exit status.
int drive(int argc, char** argv, const std::string& name, const Build&, const Results&);

/// What a question that takes no run answers with.
struct Answer {
  std::vector<output::Column> columns;     ///< of history.csv, behind its first
  std::vector<double> time;                ///< [rows] of the first, which is `counted`
  std::vector<std::vector<double>> rows;   ///< [rows][columns]
  std::vector<output::Result> results;
  std::vector<Source> sources = {};        ///< of the ledger; empty where nothing moves
  dynamics::Ledger ledger = {};
  std::string stopped = {}, reason = {};   ///< the word of an ending before the end, and its sentence
  output::Column counted = {"time", "s"};  ///< the first column
  std::vector<output::Grid> frames = {};   ///< of body.pvd, which is not written without them
  std::vector<std::string> notes = {};
  std::vector<mesh::Offenders> offenders = {};  ///< of offenders.pvd, the same
  std::int64_t elements = 0;
};

/// Reads a case, with finish() of the file, and returns what is to be computed of it.
using Plan = std::function<std::function<Answer()>(const input::CaseFile&)>;

/// Runs a driver that computes without a Simulation; command line, files and exit status are those of drive().
int answer(int argc, char** argv, const std::string& name, const Plan&);

}  // namespace nereid::driver
