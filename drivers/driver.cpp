#include "drivers/driver.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>

#include "base/check.hpp"
#include "base/parallel.hpp"
#include "dynamics/measure.hpp"
#include "element/width.hpp"
#include "output/progress.hpp"

namespace nereid::driver {

namespace {

constexpr int most_threads = 1024;  // beyond it the system may refuse, in words of its own

enum Status { done = 0, bad_case = 2, stopped = 3, our_fault = 4, machine = 5 };

struct CommandLine {
  std::string case_path, out;
  std::vector<std::string> overrides;
  int threads = 0;
  bool dry_run = false, quiet = false;
};

std::int64_t count_elements(const dynamics::Model& model) {
  std::int64_t sum = 0;
  for (const auto& block : model.blocks) sum += element::tiling(block).elements;
  return sum;
}

std::string row(const char* format, auto... values) {
  char buffer[300];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

/// The table of initial gaps, one interface a line.
std::vector<std::string> gap_table(const Scene& scene) {
  std::vector<std::string> table;
  if (scene.gaps.empty()) return table;
  table.push_back("initial gaps   apexes  on facet  on edge  on vertex  no base  penetrating  least [m]    mean [m]     largest [m]");
  for (std::size_t c = 0; c < scene.gaps.size(); ++c) {
    const contact::InitialGaps& g = scene.gaps[c];
    table.push_back(row("%-14s %6d  %8d  %7d  %9d  %7d  %11d  %-11.4g  %-11.4g  %-11.4g", scene.model.interfaces[c].name.c_str(),
                        g.apexes, g.by_kind[3], g.by_kind[2], g.by_kind[1], g.without_base, g.penetrating, g.least, g.mean, g.largest));
    table.push_back(row("%-14s penalty %.4g Pa/m", "", scene.model.interfaces[c].penalty));
  }
  return table;
}

/// Says of each block whose step a narrow element sets what that width costs, one block a line.
std::vector<std::string> width_notes(const Scene& scene) {
  constexpr double worth_saying = 2;  // [-] a brick twice as long as wide and high stays unmentioned
  std::vector<std::string> notes;
  for (const auto& block : scene.model.blocks) {
    const element::Narrowest at = element::narrowest(block, scene.state.x);
    if (at.gain < worth_saying) continue;
    notes.push_back(row("%s: its step is that of element %d at (%.4g, %.4g, %.4g) m, only %.3g m wide along "
                        "(%.3g, %.3g, %.3g) and %.3g m across; that width makes its step %.3g times smaller",
                        element::name(block).c_str(), at.element, at.centre.x(), at.centre.y(), at.centre.z(), at.width(0),
                        at.direction.x(), at.direction.y(), at.direction.z(), at.width(1), at.gain));
  }
  return notes;
}

/// Says of each interface and rigid plane that was penetrated by more than half an element that it was, one a line.
std::vector<std::string> depth_notes(const Scene& scene) {
  std::vector<std::string> notes;
  const auto look = [&notes](const std::string& name, double deepest, double depth) {
    if (depth > 0 && deepest > (0.5 + 1e-6) * depth)  // more than round-off beyond
      notes.push_back(row("%s: an apex went %.3g m deep, %.3g of the depth of an element: too soft a penalty or too fast an approach",
                          name.c_str(), deepest, deepest / depth));
  };
  const dynamics::Model& model = scene.model;
  for (std::size_t c = 0; c < model.interfaces.size(); ++c)
    look(model.interfaces[c].name, scene.state.interfaces[c].deepest, model.interfaces[c].depth);
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p)
    look(model.rigid_planes[p].name, scene.state.rigid_planes[p].deepest, model.rigid_planes[p].depth);
  return notes;
}

/// Writes histories, frames and the progress line while a run goes on.
class Recorder {
 public:
  Recorder(const Scene& scene, const CommandLine& line)
      : out_(line.out), frames_every_(scene.recording.frames), probes_(scene.probes), progress_(scene.time.end, line.quiet) {
    for (const dynamics::Probe& probe : dynamics::ledger_probes(scene.model))
      probes_.push_back({probe.name, probe.unit, [value = probe.value](const dynamics::View& view) {
                           dynamics::ProbeMemory none;
                           return value(view, none);
                         }});
    std::vector<output::Column> columns;
    for (const Probe& probe : probes_) columns.push_back({probe.name, probe.unit});
    history_ = std::make_unique<output::History>(out_ / "history.csv", columns);
    row_.resize(probes_.size());
    const auto precision = scene.recording.full_precision ? output::Precision::full : output::Precision::single;
    body_ = std::make_unique<output::Collection>(out_, "body", output::GridKind::volume, precision);
    contact_ = std::make_unique<output::Collection>(out_, "contact", output::GridKind::surface, precision);
    walls_ = std::make_unique<output::Collection>(out_, "walls", output::GridKind::surface, precision);
  }

  void operator()(const dynamics::View& view) {
    progress_.show(view.now.t, view.now.step, view.now.dt);
    if (!view.ledger_is_current) return;
    for (std::size_t p = 0; p < probes_.size(); ++p) row_[p] = probes_[p].value(view);
    history_->add(view.now.t, row_);
    const auto due = static_cast<std::int64_t>(view.now.t / frames_every_ + 1e-9);
    if (view.now.step > 0 && due <= frame_) return;
    frame_ = due;
    add_frame(view);
    if (view.now.step == 0) walls_->add(output::walls_grid(view));
  }

  /// The last state, whatever the run ended with.
  void finish(const dynamics::View& view) {
    progress_.done();
    add_frame(view);
    history_->flush();
  }

  std::int64_t not_finite() const { return body_->not_finite() + contact_->not_finite(); }

 private:
  void add_frame(const dynamics::View& view) {
    body_->add(output::body_grid(view));
    contact_->add(output::contact_grid(view));
    history_->flush();
  }

  std::filesystem::path out_;
  double frames_every_;
  std::vector<Probe> probes_;
  output::Progress progress_;
  std::unique_ptr<output::History> history_;
  std::unique_ptr<output::Collection> body_, contact_, walls_;
  std::vector<double> row_;
  std::int64_t frame_ = 0;
};

/// The part of a summary that does not depend on what was computed.
output::Summary summary_of(const std::string& name, const CommandLine& line, const input::CaseFile& file) {
  output::Summary summary;
  summary.driver = name;
  summary.case_path = line.case_path;
  summary.case_hash = file.hash();
  summary.resolved = file.resolved();
  summary.not_used = file.not_used();
  return summary;
}

output::Summary summarise(const std::string& name, const CommandLine& line, const input::CaseFile& file, const Scene& scene,
                          const dynamics::Outcome& outcome, std::vector<std::string> notes) {
  output::Summary summary = summary_of(name, line, file);
  summary.ending = {std::string(dynamics::word(outcome.ending)), outcome.reason, scene.state.t, outcome.block, outcome.element};
  summary.results = scene.results();
  for (std::size_t c = 0; c < scene.model.interfaces.size(); ++c) {
    const auto& interface = scene.model.interfaces[c];
    const auto& memory = scene.state.interfaces[c];
    summary.results.push_back({interface.name + "_penalty", interface.penalty, "Pa/m"});
    summary.results.push_back({interface.name + "_deepest", memory.deepest, "m"});
    summary.results.push_back({interface.name + "_walks", static_cast<double>(memory.walks), "1"});
    summary.results.push_back({interface.name + "_lost", static_cast<double>(memory.lost), "1"});
    summary.results.push_back({interface.name + "_recovered", static_cast<double>(memory.recovered), "1"});
  }
  for (std::size_t p = 0; p < scene.model.rigid_planes.size(); ++p)
    summary.results.push_back({scene.model.rigid_planes[p].name + "_deepest", scene.state.rigid_planes[p].deepest, "m"});
  summary.results.push_back({"smallest_step", outcome.smallest_step, "s"});
  summary.results.push_back({"largest_step", outcome.largest_step, "s"});
  summary.sources = dynamics::sources(scene.model);
  summary.ledger = scene.state.ledger;
  const auto updates = static_cast<double>(outcome.element_updates);
  summary.cost = {count_elements(scene.model), scene.state.step, outcome.element_updates, outcome.wall_seconds,
                  updates > 0 ? outcome.wall_seconds * 1e9 / updates : 0, threads()};
  notes.push_back("the smallest step was limited by " + outcome.limited_by);
  summary.notes = notes;
  return summary;
}

void print(const std::vector<std::string>& lines) {
  for (const std::string& text : lines) std::printf("%s\n", text.c_str());
}

void print(const std::vector<output::Result>& results) {
  for (const output::Result& result : results) std::printf("%-28s %.8g %s\n", result.name.c_str(), result.value, result.unit.c_str());
}

void print_size(const dynamics::Model& model) {
  std::printf("%ld nodes, %ld elements, mass %.6g kg\n", static_cast<long>(model.mesh.X.cols()), static_cast<long>(count_elements(model)),
              model.mass.sum());
}

void print_not_used(const input::CaseFile& file) {
  for (const std::string& key : file.not_used()) std::printf("not used: %s\n", key.c_str());
}

/// So that the summary of an earlier run is not taken for this one's.
void remove_summary(const std::string& folder) {
  std::error_code none_there;
  std::filesystem::remove(std::filesystem::path(folder) / "summary.json", none_there);
}

/// What would be run, and what limits its step.
int dry_run(Scene& scene, bool quiet) {
  if (quiet) return done;
  const dynamics::Votes& votes = dynamics::start(scene.model, scene.state, scene.forces);
  const dynamics::Step first = dynamics::choose_step(votes, scene.time.safety);
  print_size(scene.model);
  const std::string contact = votes.contact.step < 1e299 ? row(", contact %.4g s", votes.contact.step) : "";
  std::printf("first step %.4g s, limited by %s (stable step of elements %.4g s%s); about %.0f steps\n", first.dt,
              dynamics::limited_by(first, dynamics::sources(scene.model)).c_str(), votes.elements.step, contact.c_str(),
              scene.time.end / first.dt);
  return done;
}

int run_case(const std::string& name, const CommandLine& line, const Build& build) {
  if (line.threads > 0) use_threads(line.threads);
  const input::CaseFile file = input::CaseFile::read(line.case_path, line.overrides);
  Scene scene = build(file);
  std::vector<std::string> table = gap_table(scene);
  for (const std::string& note : width_notes(scene)) table.push_back(note);
  if (!line.quiet) {
    print_not_used(file);
    print(table);
  }
  if (line.dry_run) return dry_run(scene, line.quiet);

  remove_summary(line.out);
  Recorder recorder(scene, line);
  std::vector<dynamics::Observer> observers = scene.watchers;
  observers.emplace_back([&recorder](const dynamics::View& view) { recorder(view); });
  const dynamics::Outcome outcome =
      dynamics::run(scene.model, scene.state, scene.forces, scene.time, scene.recording.history,
                    {.observers = observers, .until = scene.until});
  recorder.finish({scene.model, scene.state, scene.forces, true});

  std::vector<std::string> notes = table;
  if (recorder.not_finite() > 0) notes.push_back(row("%ld values that were no number stand as 0 in the ParaView files", static_cast<long>(recorder.not_finite())));
  for (const std::string& note : depth_notes(scene)) {
    notes.push_back(note);
    std::fprintf(stderr, "warning: %s\n", note.c_str());
  }
  const output::Summary summary = summarise(name, line, file, scene, outcome, notes);
  output::write_summary(line.out, summary);
  if (!line.quiet) {
    print(summary.results);
    std::printf("%ld steps in %.2f s, %.1f ns per element update; results in %s\n", static_cast<long>(summary.cost.steps),
                outcome.wall_seconds, summary.cost.nanoseconds_per_element_update, line.out.c_str());
  }
  if (dynamics::good(outcome.ending)) return done;
  std::fprintf(stderr, "%s: stopped at %.6g s: %s%s%s: %s\n", name.c_str(), scene.state.t, summary.ending.word.c_str(),
               outcome.block.empty() ? "" : (" in " + outcome.block).c_str(),
               outcome.element < 0 ? "" : (", element " + std::to_string(outcome.element)).c_str(), outcome.reason.c_str());
  return stopped;
}

int answer_case(const std::string& name, const CommandLine& line, const Plan& plan) {
  if (line.threads > 0) use_threads(line.threads);
  const input::CaseFile file = input::CaseFile::read(line.case_path, line.overrides);
  const std::function<Answer()> compute = plan(file);
  if (!line.quiet) print_not_used(file);
  if (line.dry_run) return done;
  remove_summary(line.out);
  const auto began = std::chrono::steady_clock::now();
  const Answer found = compute();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();

  output::History history(std::filesystem::path(line.out) / "history.csv", found.columns, found.counted);
  for (std::size_t r = 0; r < found.rows.size(); ++r) history.add(found.time[r], found.rows[r]);
  history.flush();
  if (!found.frames.empty()) {
    output::Collection bodies(line.out, "body", output::GridKind::volume, output::Precision::single);
    for (const output::Grid& frame : found.frames) bodies.add(frame);
  }
  output::Summary summary = summary_of(name, line, file);
  const double last = found.time.empty() ? 0 : found.time.back();
  summary.ending = {found.stopped.empty() ? "reached_end" : found.stopped, found.reason, last, "", -1};
  summary.results = found.results;
  summary.sources = found.sources;
  summary.ledger = found.ledger;
  summary.notes = found.notes;
  summary.cost = {found.elements, 0, 0, seconds, 0, threads()};
  output::write_summary(line.out, summary);
  if (!line.quiet) {
    print(found.results);
    print(found.notes);
    std::printf("%.2f s; results in %s\n", seconds, line.out.c_str());
  }
  if (found.stopped.empty()) return done;
  std::fprintf(stderr, "%s: stopped: %s: %s\n", name.c_str(), found.stopped.c_str(), found.reason.c_str());
  return stopped;
}

/// Reads the command line, and turns what `work` throws into words and an exit status.
int from_command_line(int argc, char** argv, const std::string& name, const std::function<int(const CommandLine&)>& work) {
  CommandLine line;
  CLI::App app("Nereid " + name, name);
  app.failure_message([&name](const CLI::App*, const CLI::Error& error) {
    return name + ": " + error.what() + "; '" + name + " --help' lists what may be given\n";
  });
  app.add_option("case", line.case_path, "case file, YAML with units")->required();
  app.add_option("--out", line.out, "folder for results; made if it is not there");
  app.add_option("--set", line.overrides, "key.path=value, in place of what the case says; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)  // else it would swallow the case that follows it
      ->take_all();
  app.add_option("--threads", line.threads, "threads; results do not depend on them")->check(CLI::Range(1, most_threads));
  app.add_flag("--dry-run", line.dry_run, "check the case, show initial gaps and the first step, and stop");
  app.add_flag("--quiet", line.quiet, "print faults only");
  try {
    app.parse(argc, argv);
    if (line.out.empty() && !line.dry_run) throw CLI::RequiredError("--out");
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? done : bad_case;
  }
  try {
    return work(line);
  } catch (const input::CaseError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return bad_case;
  } catch (const InternalError& error) {
    std::fprintf(stderr, "%s: this is a fault of the program, not of the case: %s\n", name.c_str(), error.what());
    return our_fault;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s: memory does not suffice for a case of this size\n", name.c_str());
    return machine;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return machine;
  }
}

}  // namespace

void make_ready(Scene& scene, std::vector<dynamics::Connected> connected) {
  std::vector<contact::Memory> memories;
  for (dynamics::Connected& one : connected) {
    scene.gaps.push_back(one.gaps);
    memories.push_back(std::move(one.memory));
  }
  scene.state = dynamics::initial_state(scene.model, std::move(memories));
  scene.forces = dynamics::make_forces(scene.model);
}

int drive(int argc, char** argv, const std::string& name, const Build& build) {
  return from_command_line(argc, argv, name, [&](const CommandLine& line) { return run_case(name, line, build); });
}

int answer(int argc, char** argv, const std::string& name, const Plan& plan) {
  return from_command_line(argc, argv, name, [&](const CommandLine& line) { return answer_case(name, line, plan); });
}

}  // namespace nereid::driver
