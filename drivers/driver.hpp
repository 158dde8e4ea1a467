#pragma once
// What all drivers share: the command line, the files, the exit status.
//
//     DRIVER CASE.yaml --out DIR [--set key=value]... [--threads N] [--dry-run] [--quiet]
//
// Exit status  0 done   2 the case is wrong   3 the physics stopped   4 our fault   5 the machine

#include <functional>
#include <string>
#include <vector>

#include "input/readers.hpp"
#include "output/frames.hpp"
#include "output/history.hpp"
#include "output/summary.hpp"

namespace nereid::driver {

/// One number over time, for history.csv.
struct Probe {
  std::string name, unit;
  std::function<double(const dynamics::View&)> value;
};

/// A scene ready to run, and what its driver wants to know of it.
struct Scene {
  dynamics::Model model;
  dynamics::State state;
  dynamics::Forces forces;
  std::vector<contact::InitialGaps> gaps;              ///< beside Model::interfaces
  dynamics::Time time;
  input::Recording recording;
  std::vector<Probe> probes;                           ///< sampled
  std::vector<dynamics::Observer> watchers;            ///< called at every step
  std::function<std::vector<output::Result>()> results;  ///< asked after the run
  dynamics::Until until = {};                          ///< asked at every sample why to stop; may be empty
};

/// Adds what follows from the model once all blocks, constraints and interfaces are there.
void make_ready(Scene&, std::vector<dynamics::Connected>);

/// Reads a case and builds its scene; must call finish() of the file before it trusts a value.
using Build = std::function<Scene(const input::CaseFile&)>;

/// Runs a driver from its command line to its exit status.
int drive(int argc, char** argv, const std::string& name, const Build&);

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
  std::int64_t elements = 0;
};

/// Reads a case, with finish() of the file, and returns what is to be computed of it.
using Plan = std::function<std::function<Answer()>(const input::CaseFile&)>;

/// Runs a driver that computes without a Scene; command line, files and exit status are those of drive().
int answer(int argc, char** argv, const std::string& name, const Plan&);

/// The largest value that a number takes over all steps, and when.
struct Peak {
  double value = 0, time = 0;
  void see(double now, double t) {
    if (now > value) value = now, time = t;
  }
};

}  // namespace nereid::driver
