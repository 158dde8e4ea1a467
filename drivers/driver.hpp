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

/// What a program found that runs nothing over time.
struct Findings {
  std::vector<output::Result> results;
  output::Column counted;                 ///< first column of history.csv
  std::vector<output::Column> columns;    ///< those after it
  std::vector<std::vector<double>> rows;  ///< of history.csv, as long as all columns together
  std::vector<output::Grid> frames;       ///< of body.pvd
  std::vector<std::string> notes;
  std::string missing = {};               ///< why the answer is not the whole one; empty if it is
};

/// A model, and the question that is asked of it as it stands.
struct Inquiry {
  dynamics::Model model;
  std::function<Findings(const dynamics::Model&)> ask;
};

/// Reads a case and builds its model; must call finish() of the file before it trusts a value.
using Prepare = std::function<Inquiry(const input::CaseFile&)>;

/// The same as drive() for a question that takes no run: one row of history.csv and one frame for each thing found.
int inquire(int argc, char** argv, const std::string& name, const Prepare&);

/// The largest value that a number takes over all steps, and when.
struct Peak {
  double value = 0, time = 0;
  void see(double now, double t) {
    if (now > value) value = now, time = t;
  }
};

}  // namespace nereid::driver
