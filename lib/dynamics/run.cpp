#include "dynamics/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/words.hpp"
#include "dynamics/balance.hpp"
#include "dynamics/footing.hpp"
#include "dynamics/overlaps.hpp"
#include "dynamics/quality.hpp"
#include "dynamics/relax.hpp"

namespace nereid::dynamics {

namespace {

/// Elements of bodies that are not rigid: those of rigid ones are not computed.
std::int64_t computed_elements(const Model& model) {
  std::int64_t sum = 0;
  for (std::size_t b = 0; b < model.blocks.size(); ++b)
    if (!is_rigid_block(model, b)) sum += element::tiling(model.blocks[b]).elements;
  return sum;
}

constexpr double smallest_fraction = 1e-4;   // of the first step: something has collapsed
constexpr std::int64_t footings_every = 16;  // steps; looks take a hundredth of a run, and miss the peak of a single step

std::string name(const Model& model, int source) { return sources(model)[static_cast<std::size_t>(source)].name; }

/// The source whose created or lost energy is the largest part of what passed through it, and that part with its sign.
struct Suspect {
  int source = -1;  // -1: time integration
  double part = 0;
};

/// The nearest to its limit: a source or time integration.
///
/// except  a source that is left out, if any
Suspect suspect(const Model& model, const Ledger& ledger, int except = -1) {
  Suspect worst{-1, kept_part(ledger)};
  double most = std::abs(worst.part);
  for (int a = 0; a < static_cast<int>(ledger.accounts.size()); ++a) {
    const double part = a == except ? 0 : spurious_part(ledger, static_cast<std::size_t>(a));
    const double size = std::abs(part) / times_the_limit(model, ledger, a);
    if (size > most) worst = {a, part}, most = size;
  }
  return worst;
}

std::string name(const Model& model, const Suspect& one) { return one.source < 0 ? "time integration" : name(model, one.source); }

/// "created 30 % of the energy that it transferred (3 J of 10 J)", or lost.
std::string deed(const Ledger& ledger, const Suspect& one) {
  const double share = std::abs(one.part);
  const std::string did = (one.part > 0 ? "created " : "lost ") + percent(share) + " of the energy ";
  if (one.source < 0) return did + formatted("of the scene (%.2g J of %.2g J)", share * energy_scale(ledger), energy_scale(ledger));
  const auto a = static_cast<std::size_t>(one.source);
  return did + formatted("that it transferred (%.2g J of %.2g J)", std::abs(created(ledger.accounts[a])), ledger.flows[a].passed);
}

/// What had gone wrong before an element was lost or the step collapsed: the source that made most energy, if it made too much.
///
/// except  the block whose element is lost: its own account is spoiled by that
std::string made_before(const Model& model, const Ledger& ledger, double limit, int except = -1) {
  const Suspect one = suspect(model, ledger, except);
  const bool too_much = std::abs(one.part) > limit * times_the_limit(model, ledger, one.source);
  return too_much ? "; before that " + name(model, one) + " had " + deed(ledger, one) : "";
}

/// Stops the run with a place if an element is lost, a number is no number or the step collapsed.
bool stop(const Model& model, const State& now, const Step& next, const Time& time, Outcome& outcome) {
  const StepLimits& limits = now.step_limits;
  const double end = time.end;
  if (std::isinf(now.ledger.initial_kinetic)) {
    outcome.ending = Ending::not_finite;
    outcome.reason = "the kinetic energy of the given velocities is no finite number";
    return true;
  }
  if (!(limits.volume_ratio > 0)) {
    outcome.ending = std::isnan(limits.volume_ratio) ? Ending::not_finite : Ending::inverted_element;
    outcome.reason = std::isnan(limits.volume_ratio) ? "positions are not finite"
                                            : formatted("its volume or area is %.3g of the reference", limits.volume_ratio);
    outcome.reason += made_before(model, now.ledger, time.created_limit, limits.smallest_block);
    outcome.block = name(model, limits.smallest_block);
    outcome.element = limits.smallest_element;
    return true;
  }
  const double first = now.progress.first_step;
  const bool fell = !(next.dt > smallest_fraction * first);
  if (fell || !(next.dt * most_steps > end)) {
    outcome.ending = Ending::step_too_small;
    outcome.reason = fell ? formatted("the step fell from %.3g s to %.3g s", first, next.dt)
                          : formatted("with a step of %.3g s the end at %.3g s is out of reach", next.dt, end);
    outcome.reason += ", limited by " + limited_by(next, sources(model)) + made_before(model, now.ledger, time.created_limit);
    if (next.source >= 0) outcome.block = name(model, next.source);
    if (next.source < static_cast<int>(model.blocks.size())) outcome.element = std::max(next.at, -1);
    return true;
  }
  return false;
}

std::string floor_in_words(const Ledger& ledger) {
  const std::string energy = formatted("energy floor of %.3g J, ", energy_floor(ledger));
  if (energy_floor(ledger) == ledger.round_off) return energy + "that of the round-off of positions";
  return energy + formatted("a force of %.3g N over a thousandth of %.3g m", ledger.largest_force, ledger.size);
}

/// Stops the run where a source has created or lost too much of the energy of the scene: the ledger must be current.
bool too_much_of_the_scene(const Model& model, const Ledger& ledger, double limit, Outcome& outcome) {
  const double scale = energy_scale(ledger);
  if (!std::isfinite(energy_residual(ledger))) {  // as squares of forces beyond 1e154 N
    outcome.ending = Ending::not_finite;
    outcome.reason = "the energy that time integration makes, or the kinetic energy, is no finite number";
    return true;
  }
  for (std::size_t a = 0; a < ledger.accounts.size(); ++a) {
    const double excess = created(ledger.accounts[a]);
    if (!std::isnan(excess) && !(scale > 0 && std::abs(excess) > limit * scale)) continue;
    outcome.ending = std::isnan(excess) ? Ending::not_finite : excess > 0 ? Ending::energy_created : Ending::energy_lost;
    const std::string part = (excess > 0 ? "created " : "lost ") + percent(std::abs(excess) / scale) + " of the ";
    const std::string bound = formatted(" (%.2g J of %.2g J); the limit is ", std::abs(excess), scale) + percent(limit);
    const bool of_centre = ledger.initial_available < ledger.initial_kinetic;
    outcome.reason = std::isnan(excess)                  ? "its energy is not finite"
                     : scale == energy_floor(ledger)     ? part + floor_in_words(ledger) + bound
                     : scale == ledger.external_work     ? part + "external work so far" + bound
                     : scale == initial_stored(ledger)   ? part + "energy stored at the start" + bound
                     : of_centre ? part + "initial kinetic energy about the common centre of mass" + bound
                                 : part + "initial kinetic energy" + bound;
    outcome.block = name(model, static_cast<int>(a));
    return true;
  }
  return false;
}

bool overlap_too_much(const Model& model, const State& now, const Forces& forces, double limit, Outcome& outcome) {
  const audit::Overlap* surest = audit::surest(now.audit);
  if (surest == nullptr || !(surest->sure > limit)) return false;
  audit::Overlap most = *surest;
  most.worst = most.surest, most.time = most.sure_time;
  outcome.ending = Ending::bodies_overlap;
  const audit::Surfaces& surfaces = forces.audit.surfaces;
  const bool joined = std::any_of(model.contacts.begin(), model.contacts.end(),
                                  [&](const contact::AnyContact& one) { return joins(one, surfaces, most); });
  const double open = audit::unsure(most.worst);
  outcome.reason = in_words(surfaces, most) + (most.at_start > 0 ? formatted(", %.3g m of it at the start", most.at_start) : "") +
                   (open > 0 ? formatted(", %.3g m of it within the gap that bent faces leave", open) : "") +
                   (joined ? "" : ", without a contact between them") + formatted("; the limit is %.3g of an element", limit);
  outcome.block = surfaces.names[static_cast<std::size_t>(most.worst.region[0])];
  return true;
}

/// Why a run that relaxes has not relaxed by the time t.
std::string unrest(const Relaxation& wanted, const RelaxationMemory& found, double t) {
  if (found.residual > wanted.residual) return formatted("the residual is %.3g; the limit is %.3g", found.residual, wanted.residual);
  if (const double moving = found.kinetic / found.most_kinetic; moving > wanted.residual)
    return formatted("the forces balance, but the kinetic energy is %.3g of its largest value; the limit is %.3g", moving,
                     wanted.residual);
  if (t < wanted.after) return formatted("it ended before 'after' = %.3g s", wanted.after);
  return formatted("the forces balanced in %d samples in a row; %d are required", found.balanced, wanted.samples);
}

/// Stops the run where a corner of an element has inverted.
bool corner_inverted(const Model& model, const State& now, const Time& time, Outcome& outcome) {
  const int block = inverted_block(now, time.corner_limit);
  if (block < 0) return false;
  const Quality& seen = now.quality[static_cast<std::size_t>(block)];
  outcome.ending = Ending::inverted_element;
  outcome.reason = formatted("the Jacobian of a corner is %.3g of the reference; the limit is %.3g", seen.corner, time.corner_limit) +
                   made_before(model, now.ledger, time.created_limit, block);
  outcome.block = name(model, block);
  outcome.element = seen.element;
  return true;
}

/// Stops the run where a source has created or lost too much of what passed through it, or time integration of the scene; after any step.
bool too_much_of_what_passed(const Model& model, const Ledger& ledger, double created_limit, Outcome& outcome) {
  const Suspect one = suspect(model, ledger);
  const double limit = created_limit * times_the_limit(model, ledger, one.source);
  if (!(std::abs(one.part) > limit)) return false;
  outcome.ending = one.part > 0 ? Ending::energy_created : Ending::energy_lost;
  outcome.reason = deed(ledger, one) + "; the limit is " + percent(limit);
  outcome.block = name(model, one);
  return true;
}

}  // namespace

double times_the_limit(const Model& model, const Ledger& ledger, int source) {
  constexpr double of_a_block = 5, of_little = 5, little = 0.01;
  if (source < 0) return 1;
  if (source < static_cast<int>(model.blocks.size())) return of_a_block;
  return ledger.flows[static_cast<std::size_t>(source)].passed < little * energy_scale(ledger) ? of_little : 1;
}

std::string_view word(Ending ending) {
  switch (ending) {
    case Ending::reached_end: return "reached_end";
    case Ending::stopped_by_condition: return "stopped_by_condition";
    case Ending::interrupted: return "interrupted";
    case Ending::inverted_element: return "inverted_element";
    case Ending::not_finite: return "not_finite";
    case Ending::step_too_small: return "step_too_small";
    case Ending::energy_created: return "energy_created";
    case Ending::bodies_overlap: return "bodies_overlap";
    case Ending::energy_lost: return "energy_lost";
    case Ending::relaxed: return "relaxed";
    case Ending::not_relaxed: return "not_relaxed";
  }
  return "";
}

bool good(Ending ending) {
  return ending == Ending::reached_end || ending == Ending::stopped_by_condition || ending == Ending::relaxed;
}

Outcome run(const Model& model, State& now, Forces& forces, const Time& time, double update_every, const Watch& watch) {
  Outcome outcome;
  Progress& progress = now.progress;
  const Pace pace{.end = time.end, .safety = time.safety};
  const auto clock = [] { return std::chrono::steady_clock::now(); };
  const auto began = clock();
  // A state that was shown before its ledger was current is shown again at the end: probes have seen its step.
  const auto show = [&](bool again = false) {
    const View view{model, now, forces, progress.ledger_is_current};
    for (std::size_t p = 0; p < watch.probes.size(); ++p) {
      if (!again) sample(watch.probes[p], view, now.probes, now.probes[p]);
      if (view.ledger_is_current) sample_row(watch.probes[p], view, now.probes, now.probes[p]);
    }
    for (const Observer& observer : watch.observers) observer(view);
  };
  const auto enough = [&] {  // as the case has it
    if (watch.until && progress.ledger_is_current) outcome.reason = watch.until({model, now, forces, true}, now.conditions);
    if (!outcome.reason.empty()) outcome.ending = Ending::stopped_by_condition;
    return outcome.ending == Ending::stopped_by_condition;
  };
  if (progress.started) {
    check(now.probes.size() == watch.probes.size(), "a run goes on with the probes that it began with");
    resume(model, now, forces);
  } else {
    start(model, pace, now, forces);
    progress.started = progress.ledger_is_current = true;
    progress.first_step = choose_step(now.step_limits, time.safety).dt;
    progress.smallest.dt = std::numeric_limits<double>::infinity();
    now.probes.assign(watch.probes.size(), {});
    update_overlaps(model, false, time.audit_every, now, forces);
    show();
  }
  bool wanted = enough();
  for (Step next = choose_step(now.step_limits, time.safety);
       !stop(model, now, next, time, outcome) && !wanted && now.t < time.end;  // also the last step is looked at
       next = choose_step(now.step_limits, time.safety)) {
    if (watch.interrupt && now.step > 0) outcome.reason = watch.interrupt({model, now, forces, progress.ledger_is_current});
    if (!outcome.reason.empty()) {
      outcome.ending = Ending::interrupted;
      break;
    }
    if (next.dt < progress.smallest.dt) progress.smallest = next;
    progress.largest_step = std::max(progress.largest_step, next.dt);
    const double dt = next_length(now.step_limits, pace, now.t, now.dt);
    const bool last = dt >= time.end - now.t;
    step(model, dt, pace, now, forces);
    if (last) now.t = time.end;
    const bool at_rest = model.relaxation && model.relaxes && relax(model, next_length(now.step_limits, pace, now.t, now.dt), now, forces);
    progress.ledger_is_current = last || at_rest || now.t >= static_cast<double>(progress.updates + 1) * update_every;
    check_elements(model, progress.ledger_is_current && audit_is_due(time.audit_every, now), now);
    if (now.step_limits.volume_ratio > 0) compare_elements(model, time.end, last || at_rest, now);
    if (now.step % footings_every == 0) look_at_footings(model, now);  // by steps: rows of another spacing change no result
    if (progress.ledger_is_current) {
      progress.updates = static_cast<std::int64_t>(now.t / update_every);
      update_ledger(model, now);
      check_artificial_energy(model, now);
      if (now.step_limits.volume_ratio > 0) update_overlaps(model, last || at_rest, time.audit_every, now, forces);
    }
    show();
    if (!(now.step_limits.volume_ratio > 0)) continue;  // stop() says so
    if (corner_inverted(model, now, time, outcome)) break;
    if (progress.ledger_is_current && too_much_of_the_scene(model, now.ledger, time.created_limit, outcome)) break;
    if (too_much_of_what_passed(model, now.ledger, time.created_limit, outcome)) break;
    if (progress.ledger_is_current && overlap_too_much(model, now, forces, time.overlap_limit, outcome)) break;
    if (at_rest) {
      outcome.ending = Ending::relaxed;
      break;
    }
    wanted = enough();
  }
  if (model.relaxation && model.relaxes && outcome.ending == Ending::reached_end) {
    outcome.ending = Ending::not_relaxed;
    outcome.reason = unrest(*model.relaxation, now.relaxation, now.t);
  }
  if (!progress.ledger_is_current) {
    update_ledger(model, now);
    progress.ledger_is_current = true;
    show(true);
  }
  check_artificial_energy(model, now);
  check_elements(model, true, now);
  look_at_footings(model, now);
  if (now.step_limits.volume_ratio > 0) {
    compare_elements(model, time.end, true, now);
    update_overlaps(model, true, time.audit_every, now, forces);
  }
  if (good(outcome.ending)) corner_inverted(model, now, time, outcome);
  if (good(outcome.ending)) overlap_too_much(model, now, forces, time.overlap_limit, outcome);
  outcome.wall_seconds = std::chrono::duration<double>(clock() - began).count();
  outcome.element_updates = computed_elements(model) * (now.step + 1);
  outcome.contact = forces.multipliers.spent;
  outcome.smallest_step = progress.smallest.dt, outcome.largest_step = progress.largest_step;
  outcome.limited_by = limited_by(progress.smallest, sources(model));
  return outcome;
}

}  // namespace nereid::dynamics
