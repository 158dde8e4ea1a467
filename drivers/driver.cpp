#include "drivers/driver.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <new>
#include <system_error>

#include "base/check.hpp"
#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "base/words.hpp"
#include "drivers/accuracy.hpp"
#include "drivers/forecast.hpp"
#include "drivers/keys.hpp"
#include "drivers/restart.hpp"
#include "drivers/signals.hpp"
#include "dynamics/archive.hpp"
#include "dynamics/measure.hpp"
#include "dynamics/overlaps.hpp"
#include "dynamics/quality.hpp"
#include "input/preset.hpp"
#include "input/survey.hpp"
#include "mesh/split.hpp"
#include "model/notes.hpp"
#include "model/usual_frames.hpp"
#include "output/offenders.hpp"
#include "output/recorder.hpp"
#include "output/run_folder.hpp"

namespace nereid::driver {

namespace {

constexpr int most_threads = 1024;  // beyond it the system may refuse, in words of its own

struct CommandLine {
  std::string case_path, out;
  std::vector<std::string> overrides;
  int threads = 0;
  bool dry_run = false, quiet = false;
  std::string accuracy, of;  ///< a target, as in 2%, and the result it is of
  double longest = 60;       ///< [min] that a run may take to meet it, as foreseen
  std::string checkpoint_every;  ///< a time of the simulation, as in 1 ms; empty: no checkpoints
  bool resume = false;
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

/// What every run answers with beside the results of its driver.
void add_common_results(const model::Simulation& simulation, const dynamics::Outcome& outcome, std::vector<output::Result>& results) {
  for (std::size_t c = 0; c < simulation.model.contacts.size(); ++c) {
    const contact::AnyContact& any = simulation.model.contacts[c];
    const contact::Sides& both = contact::sides(any);
    if (!contact::by_multipliers(any) && both.bodies.count() == 0) results.push_back({both.name + "_penalty", both.penalty, "Pa/m"});
    results.push_back({both.name + "_deepest", contact::sides(simulation.state.contacts[c]).deepest, "m"});
    const auto* memory = std::get_if<contact::Memory>(&simulation.state.contacts[c]);
    if (memory == nullptr) continue;  // edges have no base to change
    results.push_back({both.name + "_reconnections", static_cast<double>(memory->walks), "1"});
    results.push_back({both.name + "_lost", static_cast<double>(memory->lost), "1"});
    results.push_back({both.name + "_recovered", static_cast<double>(memory->recovered), "1"});
  }
  for (const dynamics::Touched& one : dynamics::touched(simulation.model, simulation.state)) {
    if (one.sides[0] != "apexes") continue;  // of bodies in an automatic contact the summary has a list
    results.push_back({one.contact + "_first_touch", one.first, "s"});
    results.push_back({one.contact + "_last_touch", one.last, "s"});
    results.push_back({one.contact + "_impulse", one.impulse.norm(), "N*s"});
  }
  double deepest = 0, grown = 0;
  for (const audit::Overlap& overlap : simulation.state.audit.overlaps)
    deepest = std::max(deepest, overlap.deepest), grown = std::max(grown, overlap.grown);
  results.push_back({"audit_deepest_overlap", deepest, "m"});
  results.push_back({"audit_overlap_elements", grown, "1"});
  const double scale = dynamics::energy_of_scene(simulation.state.ledger);
  for (std::size_t b = 0; b < simulation.model.blocks.size(); ++b) {
    const std::string& body = element::name(simulation.model.blocks[b]);
    const dynamics::Quality& seen = simulation.state.quality[b];
    if (seen.element >= 0) results.push_back({body + "_smallest_corner", seen.corner, "1"});
    const auto add = [&](const char* what, double energy) {
      results.push_back({body + what, dynamics::of_internal(seen, energy, scale), "1"});
    };
    add("_artificial_fraction", seen.artificial);
    if (element::rotates(simulation.model.blocks[b])) {
      add("_drilling_fraction", seen.drilling), add("_residual_bending_fraction", seen.residual_bending);
    } else {
      add("_hourglass_fraction", seen.hourglass), add("_distortion_fraction", seen.distortion);
    }
  }
  const element::Contrast contrast = dynamics::contrast(simulation.state);
  if (contrast.strain > 0) {
    results.push_back({"hourglass_above_neighbours", contrast.bending, "1"});
    results.push_back({"strain_energy_concentration", contrast.density, "1"});
  }
  const dynamics::Ledger& ledger = simulation.state.ledger;
  results.push_back({"viscous_share", dynamics::dissipated_share(ledger, Dissipated::viscous), "1"});
  results.push_back({"plastic_share", dynamics::dissipated_share(ledger, Dissipated::plastic), "1"});
  const auto add_footing = [&](const std::string& contact, std::size_t place) {
    if (place < simulation.state.footings.size() && simulation.state.footings[place].nodes > 0)
      results.push_back({contact + "_effective_nodes", simulation.state.footings[place].nodes, "1"});
  };
  for (std::size_t c = 0; c < simulation.model.contacts.size(); ++c)
    add_footing(contact::sides(simulation.model.contacts[c]).name, c);
  for (std::size_t p = 0; p < simulation.model.rigid_planes.size(); ++p)
    add_footing(simulation.model.rigid_planes[p].name, simulation.model.contacts.size() + p);
  for (std::size_t p = 0; p < simulation.model.rigid_planes.size(); ++p)
    results.push_back({simulation.model.rigid_planes[p].name + "_deepest", simulation.state.rigid_planes[p].deepest, "m"});
  for (std::size_t k = 1; k < simulation.state.progress.stages.size(); ++k)
    results.push_back({simulation.stages[k].name + "_began", simulation.state.progress.stages[k], "s"});
  results.push_back({"smallest_step", outcome.smallest_step, "s"});
  results.push_back({"largest_step", outcome.largest_step, "s"});
}

/// What overlapped during the run.
std::vector<output::Overlap> overlaps_of(const model::Simulation& simulation) {
  const audit::Surfaces& surfaces = simulation.forces.audit.surfaces;
  std::vector<output::Overlap> all;
  for (const audit::Overlap& overlap : simulation.state.audit.overlaps) {
    output::Overlap one;
    for (std::size_t i = 0; i < 2; ++i) one.bodies[i] = surfaces.names[static_cast<std::size_t>(overlap.worst.region[i])];
    for (const contact::AnyContact& any : simulation.model.contacts)
      if (dynamics::joins(any, surfaces, overlap)) one.contacts.push_back(contact::sides(any).name);
    one.deepest = overlap.deepest, one.elements = overlap.grown, one.at_start = overlap.at_start;
    one.place = overlap.worst.place, one.time = overlap.time;
    all.push_back(one);
  }
  return all;
}

output::Summary summarise(const std::string& name, const CommandLine& line, const input::CaseFile& file,
                          const model::Simulation& simulation, const dynamics::Outcome& outcome,
                          const std::vector<output::Result>& results, std::vector<std::string> notes, int frames,
                          const std::vector<std::string>& warnings = {}) {
  output::Summary summary = summary_of(name, line, file);
  summary.ending = {std::string(dynamics::word(outcome.ending)), outcome.reason, simulation.state.t, outcome.block, outcome.element};
  summary.results = results;
  add_common_results(simulation, outcome, summary.results);
  summary.sources = dynamics::sources(simulation.model);
  summary.ledger = simulation.state.ledger;
  summary.overlaps = overlaps_of(simulation);
  summary.touched = dynamics::touched(simulation.model, simulation.state);
  const auto updates = static_cast<double>(outcome.element_updates);
  summary.cost = {model::count_elements(simulation.model), simulation.state.step, outcome.element_updates, outcome.wall_seconds,
                  updates > 0 ? outcome.wall_seconds * 1e9 / updates : 0, threads(), frames, model::frames_every(simulation),
                  outcome.contact};
  notes.push_back("the smallest step was limited by " + outcome.limited_by);
  summary.notes = notes, summary.warnings = warnings;
  return summary;
}

void print(const std::vector<std::string>& lines) {
  for (const std::string& text : lines) std::printf("%s\n", text.c_str());
}

void print(const std::vector<output::Result>& results) {
  for (const output::Result& result : results) std::printf("%-28s %.8g %s\n", result.name.c_str(), result.value, result.unit.c_str());
}

void print_size(const model::Simulation& simulation) {
  const dynamics::Model& model = simulation.model;
  print(model::body_table(simulation));
  std::printf("%ld nodes, %ld elements, mass %.6g kg\n", static_cast<long>(model.mesh.X.cols()),
              static_cast<long>(model::count_elements(model)), dynamics::total_mass(model));
}

void print_not_used(const input::CaseFile& file) {
  for (const std::string& key : file.not_used()) std::printf("not used: %s\n", key.c_str());
}

/// Why a run must not read a file: it would overwrite or clear it. Empty if it would not.
std::string overwrites(const CommandLine& line, const std::string& file) {
  std::filesystem::path result = line.out.empty() ? "" : output::result_that_is(line.out, file);
  if (result.empty()) return "";
  if (result.extension() == ".stale") result.replace_extension();  // its name before this run
  return "this run would overwrite or clear its own input " + result.string() + "; move that file or choose another --out";
}

void check_case_path(const CommandLine& line) {
  const std::string message = overwrites(line, line.case_path);
  if (!message.empty()) throw input::CaseError(line.case_path, {{line.case_path, 0, 0, message, "", line.case_path + ": " + message}});
}

void check_inputs(const CommandLine& line, const input::CaseFile& file, output::RunFolder& folder) {
  file.check_files([&](const std::string& path) {
    std::string message = overwrites(line, path);
    if (!message.empty()) folder.restore();
    return message;
  });
}

/// What `work` makes of a case; if it is refused for elements of a mesh, these go to the folder of results first.
template <class Work>
auto or_show_offenders(const CommandLine& line, const input::CaseFile& file, output::RunFolder& folder, const Work& work) {
  try {
    return work(file);
  } catch (const input::CaseError&) {
    const std::vector<std::string> inputs = file.files();
    const bool had_results = folder.restore();  // false of a finer mesh of --accuracy: what is there is that of the coarser one
    const bool overwrites_any =
        std::any_of(inputs.begin(), inputs.end(), [&](const auto& input) { return !overwrites(line, input).empty(); });
    if (overwrites_any) {  // it may have been refused because a table that it reads was set aside
      const input::CaseFile again = input::CaseFile::read(line.case_path, line.overrides);
      work(again);
      check_inputs(line, again, folder);
    }
    if (had_results) folder.set_aside();
    if (!line.dry_run && !overwrites_any) output::write_offenders(line.out, file.offenders());
    throw;
  }
}

/// How long a run takes with meshes from files split by a factor: by 2 and 4, 16 and 256 times as long; of plates alone 8 and 64 times. [s]
///
/// seconds  of the run as the case is
double seconds_split_by(int factor, const input::CaseFile& file, const dynamics::Model& model, double seconds) {
  const bool solids =
      std::any_of(model.blocks.begin(), model.blocks.end(), [](const element::AnyBlock& block) { return !element::rotates(block); });
  const auto times = [solids](int by) { return by * (solids ? mesh::times_hexahedra(by) : mesh::times_triangles(by)); };
  return seconds * times(factor) / times(static_cast<int>(file.refine_factor()));
}

/// What runs of a case with meshes from files will take, in a line.
std::string forecast_of_splits(const input::CaseFile& file, const dynamics::Model& model, double seconds) {
  std::string text;
  const double first = seconds_split_by(1, file, model, seconds);
  for (const int factor : mesh::split_factors) {
    const double here = seconds_split_by(factor, file, model, seconds);
    text += (text.empty() ? "forecast: refine " : ", refine ") + std::to_string(factor) + " about " + duration(here) +
            (factor == 1 ? "" : formatted(" (%g times)", here / first));
  }
  return text;
}

void print_forecast(const model::Simulation& simulation, const Forecast& forecast) {
  const dynamics::Model& model = simulation.model;
  print_size(simulation);
  const dynamics::Step& first = forecast.expected.first;
  std::printf("first step %.4g s, limited by %s", first.dt, dynamics::limited_by(first, dynamics::sources(model)).c_str());
  const double elements = forecast.step_limits.elements.step, end = simulation.time.end;  // a step longer than the run limits nothing
  const dynamics::SourceLimit& contact = forecast.step_limits.contact;
  const bool touches = contact.step < end && contact.source >= static_cast<int>(model.blocks.size());  // else it is of a rigid body
  if (elements < end)
    std::printf(" (stable step of elements %.4g s%s)", elements, touches ? formatted(", of contact %.4g s", contact.step).c_str() : "");
  std::printf("\nforecast until time.end: %s\n", in_words(forecast).c_str());
  print(forecast.advice);
}

/// What a checkpoint of this run says, but for state and results.
Checkpoint checkpoint_of(const std::string& name, const input::CaseFile& file, const dynamics::Model& model) {
  return {.driver = name, .case_hash = file.hash(), .resolved = lines_of(file.resolved()), .fingerprint = dynamics::fingerprint(model),
          .time = 0, .results = {}, .state = {}};
}

/// A time with its unit, as in "1 ms"; zero if it is none. [s]
double time_of(const std::string& text) {
  const auto read = input::parse_quantity(text);
  const auto* quantity = std::get_if<input::Quantity>(&read);
  return quantity != nullptr && quantity->dimension == dim::time && quantity->value > 0 ? quantity->value : 0;
}

/// Where a run begins.
struct Beginning {
  std::optional<Checkpoint> checkpoint;  ///< empty: at the start
  bool is_over = false;                  ///< nothing is left to do
  int status = done;                     ///< of the run that is over
};

Beginning beginning(const std::string& name, const CommandLine& line, const input::CaseFile& file) {
  Beginning found;
  if (!line.resume) return found;
  found.checkpoint = read_checkpoint(line.out);
  if (found.checkpoint) return found;
  const output::Ended last = output::ended(line.out);
  if (!last.word.empty() && last.case_hash != file.hash())
    throw BadCheckpoint("there is no checkpoint in " + line.out + ", and its results are of another case; choose another --out");
  found.is_over = !last.word.empty() && last.word != "interrupted";
  if (found.is_over && last.word != "reached_end" && last.word != "stopped_by_condition" && last.word != "relaxed") found.status = stopped;
  const std::string said = found.is_over ? "there is nothing to resume: the run in " + line.out + " ended with " + last.word
                                         : "there is no checkpoint in " + line.out + ": the run starts from the beginning";
  std::fprintf(stderr, "%s: %s\n", name.c_str(), said.c_str());
  return found;
}

/// Writes a checkpoint where one is due, and where a signal ends the run.
dynamics::Interrupt checkpoints(const std::string& name, const CommandLine& line, const input::CaseFile& file,
                                const model::Simulation& simulation, output::Recorder& recorder) {
  const double every = line.checkpoint_every.empty() ? INFINITY : time_of(line.checkpoint_every);
  return [&, every, due = std::floor(simulation.state.t / every) + 1, next = checkpoint_of(name, file, simulation.model)](
             const dynamics::View& view) mutable -> std::string {
    const std::string signal = heard_signal();
    if (signal.empty() && !(view.now.t >= due * every)) return "";
    due = std::floor(view.now.t / every) + 1;
    next.time = view.now.t, next.results = recorder.mark(), next.state = dynamics::bytes_of(view.model, view.now);
    write_checkpoint(line.out, next);
    if (signal.empty()) return "";
    if (line.accuracy.empty()) return "by " + signal + "; --resume goes on from here";
    return "by " + signal + "; --resume with --set " + line.overrides.back() + " and without --accuracy goes on from here";
  };
}

/// Refuses a case whose end no run would reach.
void check_reach(const input::CaseFile& file, const model::Simulation& simulation, const dynamics::Step& first) {
  const double steps = std::ceil(simulation.time.end / first.dt);
  if (!(steps > dynamics::most_steps)) return;
  file.fault("time.end",
             formatted("'end' = %.8g s takes %.3g steps of %.3g s, limited by ", simulation.time.end, steps, first.dt) +
                 dynamics::limited_by(first, dynamics::sources(simulation.model)) + ": expected at most a billion",
             "");
  file.finish();
}

/// What a dry run ends with: as a run would at its start.
int status_of_start(const std::string& name, const dynamics::Outcome& start) {
  if (dynamics::good(start.ending)) return done;
  std::fprintf(stderr, "%s: a run would stop at its start: %s%s%s: %s\n", name.c_str(), std::string(dynamics::word(start.ending)).c_str(),
               start.block.empty() ? "" : (" in " + start.block).c_str(),
               start.element < 0 ? "" : (", element " + std::to_string(start.element)).c_str(), start.reason.c_str());
  return stopped;
}

Ran run_case(const std::string& name, const CommandLine& line, output::RunFolder& folder, const Build& build, const Results& results,
             const Judge& judge = {}) {
  if (line.threads > 0) use_threads(line.threads);
  const input::CaseFile file = input::CaseFile::read(line.case_path, line.overrides);
  model::Simulation simulation = or_show_offenders(line, file, folder, build);
  check_inputs(line, file, folder);
  const Beginning begins = beginning(name, line, file);
  if (begins.is_over) return {begins.status, {}};
  std::vector<std::string> notes = model::gap_table(simulation);
  for (const std::string& note : model::width_notes(simulation)) notes.push_back(note);
  for (const std::string& note : file.refine_notes()) notes.push_back(note);
  notes.insert(notes.end(), simulation.remarks.begin(), simulation.remarks.end());
  std::vector<std::string> told;  // warnings
  const auto warn = [&](const std::string& note) {
    notes.push_back(note), told.push_back(note);
    std::fprintf(stderr, "warning: %s\n", note.c_str());
  };
  if (!line.quiet) {
    print_not_used(file);
    print(file.preset_lines());
    print(notes);
  }
  for (const auto& warnings : {simulation.mesh_warnings.texts, model::coarseness_notes(simulation)})
    for (const std::string& note : warnings) warn(note);
  if (line.quiet && line.dry_run) {
    const Start start = start_of(simulation);
    check_reach(file, simulation, start.first);
    return {status_of_start(name, start.outcome), {}};
  }
  if (!line.quiet && !begins.checkpoint) {
    const auto summary = [&] { return output::text_of(summarise(name, line, file, simulation, {}, results(simulation), notes, 1)).size(); };
    const Forecast found = forecast(simulation, summary);
    check_reach(file, simulation, found.expected.first);
    print_forecast(simulation, found);
    if (line.dry_run && !input::names_from_files(file.meshes()).empty())
      std::printf("%s\n", forecast_of_splits(file, simulation.model, found.seconds).c_str());
    if (line.dry_run) return {status_of_start(name, found.start), {}};
  }
  if (!line.quiet && !begins.checkpoint) {  // what was rehearsed is no start of a run
    simulation = {};
    simulation = build(input::CaseFile::read(line.case_path, line.overrides));
  }

  keep_results(true);
  if (begins.checkpoint) {
    go_back_to(*begins.checkpoint, checkpoint_of(name, file, simulation.model), simulation);
    if (!line.quiet) std::printf("the run goes on from its checkpoint at %.8g s\n", begins.checkpoint->time);
  } else {
    folder.clear();
    output::write_offenders(line.out, simulation.mesh_warnings.offenders);
  }
  std::optional<output::Recorder> results_of_run;
  if (begins.checkpoint) results_of_run.emplace(simulation, line.out, line.quiet, begins.checkpoint->results);
  else results_of_run.emplace(simulation, line.out, line.quiet);
  output::Recorder& recorder = *results_of_run;
  const std::vector<dynamics::Observer> observers{[&](const dynamics::View& view) {
    if (view.now.step == 0) check_reach(file, simulation, dynamics::choose_step(view.now.step_limits, simulation.time.safety));
    recorder(view);
  }};
  const auto run = [&] {
    try {
      return model::run(simulation, observers, checkpoints(name, line, file, simulation, recorder));
    } catch (const input::CaseError&) {  // which is known only once the run has started
      results_of_run.reset(), folder.clear();
      throw;
    }
  };
  const dynamics::Outcome outcome = run();
  recorder.finish(model::view(simulation));

  if (recorder.replaced() > 0)
    notes.push_back("the ParaView files have 0 in place of " + counted(static_cast<std::size_t>(recorder.replaced()), "value") +
                    " beyond their range or not finite");
  const auto of_right_run = [&](std::vector<std::string> (*said)(const model::Simulation&)) {  // else the ending says more
    return dynamics::good(outcome.ending) ? said(simulation) : std::vector<std::string>();
  };
  for (const auto& warnings : {model::rounding_notes(simulation), model::depth_notes(simulation), model::overlap_notes(simulation),
                               model::quality_notes(simulation), of_right_run(model::mesh_warnings), model::energy_notes(simulation),
                               model::formula_notes(simulation)})
    for (const std::string& note : warnings) warn(note);
  std::vector<std::string> of_mesh = of_right_run(model::mesh_notes);
  for (const std::string& note : model::curve_notes(simulation)) of_mesh.push_back(note);
  for (std::string& note : of_mesh) note = "note: " + note;  // by which summary.json tells them from others
  notes.insert(notes.end(), of_mesh.begin(), of_mesh.end());
  if (!line.quiet) print(of_mesh);
  const std::vector<std::string> of_steps = model::step_notes(simulation);
  notes.insert(notes.end(), of_steps.begin(), of_steps.end());
  if (!line.quiet) print(of_steps);
  Ran ran{done, results(simulation), static_cast<double>(outcome.element_updates), outcome.wall_seconds};
  if (judge) {
    judge(ran, ran.results);
    for (const std::string& note : left_out(file.meshes())) notes.push_back(note);
  }
  const output::Summary summary = summarise(name, line, file, simulation, outcome, ran.results, notes, recorder.frames(), told);
  output::write_summary(line.out, summary);
  if (outcome.ending != dynamics::Ending::interrupted) remove_checkpoint(line.out);
  if (!line.quiet) {
    print(summary.results);
    std::printf("%ld steps in %.2f s, %.1f ns per element update; results in %s\n", static_cast<long>(summary.cost.steps),
                outcome.wall_seconds, summary.cost.nanoseconds_per_element_update, line.out.c_str());
    std::printf("%s\n", model::energy_line(simulation).c_str());
  }
  if (dynamics::good(outcome.ending)) {
    const std::string why = outcome.ending == dynamics::Ending::stopped_by_condition ? ": " + outcome.reason : "";
    if (!line.quiet) std::printf("ended at %.6g s: %s%s\n", simulation.state.t, summary.ending.word.c_str(), why.c_str());
    return ran;
  }
  ran.status = outcome.ending == dynamics::Ending::interrupted ? interrupted : stopped;
  std::fprintf(stderr, "%s: stopped at %.6g s: %s%s%s: %s\n", name.c_str(), simulation.state.t, summary.ending.word.c_str(),
               outcome.block.empty() ? "" : (" in " + outcome.block).c_str(),
               outcome.element < 0 ? "" : (", element " + std::to_string(outcome.element)).c_str(), outcome.reason.c_str());
  return ran;
}

/// The same without files and words.
Ran look_at_case(const CommandLine& line, const Build& build, const Results& results) {
  const input::CaseFile file = input::CaseFile::read(line.case_path, line.overrides);
  model::Simulation simulation = build(file);
  const dynamics::Outcome outcome = model::run(simulation, {}, {});
  return {dynamics::good(outcome.ending) ? done : stopped, results(simulation), static_cast<double>(outcome.element_updates),
          outcome.wall_seconds};
}

bool all_rigid(const dynamics::Model& model) {
  for (std::size_t b = 0; b < model.blocks.size(); ++b)
    if (!dynamics::is_rigid_block(model, b)) return false;
  return !model.blocks.empty();
}

/// Why the second mesh, and so any estimate, takes longer than the target allows; empty if it does not, or if no mesh is from a file.
std::string foreseen_too_long(const Target& target, const input::CaseFile& file, model::Simulation& simulation,
                              const std::function<void(const std::string&)>& say) {
  if (input::names_from_files(file.meshes()).empty()) return "";
  const double seconds = forecast(simulation, [] { return std::size_t{0}; }).seconds;
  say(forecast_of_splits(file, simulation.model, seconds));
  const double second = seconds_split_by(2, file, simulation.model, seconds);
  return second > target.longest ? "the second mesh, refine 2, would take about " + duration(second) : "";
}

int run_to_accuracy(const std::string& name, const CommandLine& line, output::RunFolder& folder, const Build& build,
                    const Results& results) {
  if (line.threads > 0) use_threads(line.threads);
  const Target target{part_of(line.accuracy), line.of, 60 * line.longest};
  const input::CaseFile file = input::CaseFile::read(line.case_path, line.overrides);
  // its faults come first: what is wrong with a mesh of another factor is none of the case
  model::Simulation simulation = or_show_offenders(line, file, folder, build);
  check_inputs(line, file, folder);
  const RunOnce run = [&](double refine, bool first_look, const Judge& judge) {
    std::fflush(stdout);  // what is known of coarser meshes: a signal may end the program while the next one is built
    keep_results(false);
    CommandLine finer = line;
    finer.overrides.push_back("refine=" + shortest(refine)), finer.quiet = true;
    try {
      const Ran ran = first_look ? look_at_case(finer, build, results) : run_case(name, finer, folder, build, results, judge);
      if (ran.status != interrupted) stop_if_interrupted(line.accuracy + " is not reached");
      return ran;
    } catch (const input::CaseError&) {
      return Ran{bad_case, {}};
    }
  };
  const auto say = [&](const std::string& text) {
    if (!line.quiet) std::printf("%s\n", text.c_str());
  };
  int status = done;
  std::string why = why_not_finer(file.meshes(), all_rigid(simulation.model));
  if (!why.empty()) status = bad_case;
  if (why.empty()) why = foreseen_too_long(target, file, simulation, say);
  simulation = {};
  if (why.empty()) why = run_to_target(target, factors_of(file.meshes()), run, say, status);
  if (why.empty()) {
    for (const std::string& text : left_out(file.meshes())) say(text);
    return status;
  }
  if (status != bad_case && folder.restore()) folder.clear();  // no run took the place of an older one
  std::fprintf(stderr, "%s: %s is not reached: %s\n", name.c_str(), line.accuracy.c_str(), why.c_str());
  return status == done ? stopped : status;
}

/// An answer that is no number is none.
void stop_if_not_finite(Answer& found) {
  if (!found.stopped.empty()) return;
  for (const output::Result& result : found.results)
    if (!std::isfinite(result.value)) found.stopped = "not_finite", found.reason = result.name + " is no finite number";
}

int answer_case(const std::string& name, const CommandLine& line, output::RunFolder& folder, const Plan& plan) {
  if (line.threads > 0) use_threads(line.threads);
  const input::CaseFile file = input::CaseFile::read(line.case_path, line.overrides);
  const std::function<Answer()> compute = or_show_offenders(line, file, folder, plan);
  check_inputs(line, file, folder);
  if (!line.quiet) print_not_used(file);
  if (line.dry_run) return done;
  keep_results(true);
  folder.clear();
  stop_if_interrupted("there are no results");
  keep_results(false);
  const auto began = std::chrono::steady_clock::now();
  Answer found = compute();
  keep_results(true);
  stop_if_not_finite(found);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();

  output::History history(std::filesystem::path(line.out) / "history.csv", found.columns, found.counted);
  for (std::size_t r = 0; r < found.rows.size(); ++r) history.add(found.time[r], found.rows[r]);
  history.flush();
  if (!found.frames.empty()) {
    output::Collection bodies(line.out, "body", output::GridKind::volume, output::Precision::single);
    for (const output::Grid& frame : found.frames) bodies.add(frame);
  }
  output::write_offenders(line.out, found.offenders);
  output::Summary summary = summary_of(name, line, file);
  const double last = found.time.empty() ? 0 : found.time.back();
  summary.ending = {found.stopped.empty() ? "reached_end" : found.stopped, found.reason, last, "", -1};
  summary.results = found.results;
  summary.sources = found.sources;
  summary.ledger = found.ledger;
  summary.notes = found.notes;
  summary.cost.elements = found.elements, summary.cost.wall_seconds = seconds, summary.cost.threads = threads();
  output::write_summary(line.out, summary);
  if (!line.quiet) {
    print(found.results);
    print(found.notes);
    std::printf("%.2f s; results in %s\n", seconds, line.out.c_str());
    if (found.stopped.empty()) std::printf("ended: %s\n", summary.ending.word.c_str());
  }
  if (found.stopped.empty()) return done;
  std::fprintf(stderr, "%s: stopped: %s: %s\n", name.c_str(), found.stopped.c_str(), found.reason.c_str());
  return stopped;
}

/// Leaves to the calls that write what the system would else answer with a signal: a reader that has gone, a file that may not grow. And
/// opens what may be closed of standard input, output and error, so that no file of results takes their place.
void expect_failing_writes() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int one : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(one, F_GETFD) == -1) ::open("/dev/null", O_RDWR);  // takes the lowest number that is free
}

/// Memory that is freed stays with the process: to take pages back from the system costs more than what is done with most of them. All
/// threads share it, so that frames are written in what others have freed.
void keep_freed_memory() {
  constexpr int most_of_glibc = 32 << 20;  // [bytes] what is larger goes back all the same
  mallopt(M_MMAP_THRESHOLD, most_of_glibc);
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

/// The status, or that of the machine where what was said did not reach its reader.
int told(const std::string& name, int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  std::fprintf(stderr, "%s: cannot write to standard output\n", name.c_str());
  return status == done ? machine : status;
}

/// Reads the command line, and turns what `work` throws into words and an exit status.
///
/// meshes  whether the program makes steps on meshes, so that it may be asked for an accuracy
/// read    reads a case to its end, for --keys
int from_command_line(int argc, char** argv, const std::string& name, bool meshes,
                      const std::function<void(const input::CaseFile&)>& read,
                      const std::function<int(const CommandLine&, output::RunFolder&)>& work) {
  expect_failing_writes();
  keep_freed_memory();
  CommandLine line;
  CLI::App app("Nereid " + name, name);
  if (argc == 2 && std::string(argv[1]) == "--keys") {  // in the place of a case
    std::fputs(keys_as_json(name, meshes, input::asked_keys(read)).c_str(), stdout);
    return told(name, done);
  }
  app.failure_message([&name](const CLI::App*, const CLI::Error& error) {
    constexpr std::size_t longest = 600;  // [bytes]
    return name + ": " + clipped(error.what(), longest) + "; '" + name + " --help' lists what may be given\n";
  });
  app.add_option("case", line.case_path, "case file, YAML with units")->required();
  app.footer(name + " --keys prints all keys of its cases, its results and what its files hold, as JSON");
  app.add_option("--out", line.out, "folder for results; made if it is not there");
  app.add_option("--set", line.overrides, "key.path=value, in place of what the case says; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)  // else it would swallow the case that follows it
      ->take_all();
  const auto is_threads = [](const std::string& text) {
    const bool fits = CLI::Range(1, most_threads)(text).empty();
    return fits ? std::string() : formatted("'%s' is no number of threads: expected is 1 to %d, also in NEREID_THREADS", text.c_str(),
                                            most_threads);
  };
  app.add_option("--threads", line.threads, "threads, by default one for each core; results do not depend on them")
      ->envname("NEREID_THREADS")
      ->check(is_threads);
  app.add_flag("--dry-run", line.dry_run, "check the case, show initial gaps, forecast the run, and stop");
  app.add_flag("--quiet", line.quiet, "print faults only");
  const auto is_part = [](const std::string& text) {
    return part_of(text) > 0 ? std::string() : "'" + text + "' is no accuracy: expected as in 2%";
  };
  const auto is_minutes = [](const std::string& text) {
    const auto read = input::parse_quantity(text);
    const auto* quantity = std::get_if<input::Quantity>(&read);
    const bool fits = quantity != nullptr && !quantity->has_unit && quantity->value > 0 && std::isfinite(quantity->value);
    return fits ? std::string() : "'" + text + "' is no number of minutes above zero";
  };
  if (meshes) {
    const auto is_time = [](const std::string& text) {
      return time_of(text) > 0 ? std::string() : "'" + text + "' is no time: expected as in '1 ms'";
    };
    app.add_option("--checkpoint-every", line.checkpoint_every, "time of the simulation between checkpoints, as in '1 ms'")->check(is_time);
    const auto resume = app.add_flag("--resume", line.resume, "go on from the last checkpoint in --out")->excludes("--dry-run");
    const auto accuracy = app.add_option("--accuracy", line.accuracy, "as in 2%: run on finer meshes until a result is that close")
                              ->check(is_part)->excludes("--dry-run")->excludes("--checkpoint-every")->excludes(resume);
    app.add_option("--of", line.of, "the result that is meant; the first without it")->needs(accuracy);
    app.add_option("--longest", line.longest, "minutes that a run may take to get there, as foreseen")->needs(accuracy)
        ->check(is_minutes)->capture_default_str();
  }
  try {
    app.parse(argc, argv);
    if (line.out.empty() && !line.dry_run) throw CLI::RequiredError("--out");
    const auto refines = [](const std::string& text) { return text.rfind("refine", 0) == 0 && text.find_first_of("= ") == 6; };
    if (!line.accuracy.empty() && std::any_of(line.overrides.begin(), line.overrides.end(), refines))
      throw CLI::ValidationError("--accuracy", "it chooses 'refine' itself, so '--set refine' does not go with it");
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? done : bad_case;
  }
  hear_signals(name, interrupted);
  try {
    check_case_path(line);
    output::RunFolder folder(line.dry_run ? "" : line.out, line.resume);
    return told(name, work(line, folder));
  } catch (const input::CaseError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return bad_case;
  } catch (const BadCheckpoint& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return bad_case;
  } catch (const Interrupted& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return interrupted;
  } catch (const MachineError& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return machine;
  } catch (const std::system_error& error) {  // of a file, or of a thread that cannot be started
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return machine;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s: memory does not suffice: up to %.3g GB were in use when more was asked for\n", name.c_str(),
                 most_resident() / 1e9);
    return machine;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: this is a fault of the program, not of the case: %s\n", name.c_str(), error.what());
    return our_fault;
  }
}

}  // namespace

int drive(int argc, char** argv, const std::string& name, const Build& build, const Results& results) {
  return from_command_line(argc, argv, name, true, build, [&](const auto& line, auto& folder) {
    return line.accuracy.empty() ? run_case(name, line, folder, build, results).status
                                 : run_to_accuracy(name, line, folder, build, results);
  });
}

int answer(int argc, char** argv, const std::string& name, const Plan& plan) {
  return from_command_line(argc, argv, name, false, plan,
                           [&](const auto& line, auto& folder) { return answer_case(name, line, folder, plan); });
}

}  // namespace nereid::driver
