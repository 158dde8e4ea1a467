#include "dynamics/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "dynamics/relax.hpp"

namespace nereid::dynamics {

namespace {

constexpr double smallest_fraction = 1e-4;  // of the first step: something has collapsed
constexpr double most_steps = 1e9;           // a run that would take more does not end in a lifetime

std::string text(const char* format, double a, double b) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

/// Stops the run with a place if an element is lost, a number is no number or the step collapsed.
bool stop(const Votes& votes, double first_step, double end, Outcome& outcome) {
  if (!(votes.size > 0)) {
    outcome.ending = std::isnan(votes.size) ? Ending::not_finite : Ending::inverted_element;
    outcome.reason = std::isnan(votes.size) ? "positions are not finite"
                                            : text("its volume or area is %.3g of the reference", votes.size, 0);
    outcome.block = votes.smallest_block;
    outcome.element = votes.smallest_element;
    return true;
  }
  const bool fell = !(votes.step > smallest_fraction * first_step);
  if (fell || !(votes.step * most_steps > end)) {
    outcome.ending = Ending::step_too_small;
    outcome.reason = fell ? text("the step fell from %.3g s to %.3g s", first_step, votes.step)
                          : text("with a step of %.3g s the end at %.3g s is out of reach", votes.step, end);
    outcome.block = votes.by;
    outcome.element = votes.element;
    return true;
  }
  return false;
}

bool created_too_much(const Ledger& ledger, double limit, Outcome& outcome) {
  const double scale = energy_scale(ledger);
  for (const Account& account : ledger.accounts) {
    if (std::isnan(created(account))) {
      outcome.ending = Ending::not_finite;
      outcome.reason = "its energy is not finite";
      outcome.block = account.name;
      return true;
    }
    if (scale > 0 && created(account) > limit * scale) {
      outcome.ending = Ending::energy_created;
      outcome.reason = text(scale == ledger.initial_kinetic ? "created %.3g of the initial kinetic energy; the limit is %.3g"
                            : scale == ledger.brought_in    ? "created %.3g of the energy brought in so far; the limit is %.3g"
                                                            : "created %.3g of the energy stored at the start; the limit is %.3g",
                            created(account) / scale, limit);
      outcome.block = account.name;
      return true;
    }
  }
  return false;
}

std::int64_t elements(const Model& model) {
  std::int64_t sum = 0;
  for (const auto& block : model.blocks) sum += element::tiling(block).elements;
  return sum;
}

}  // namespace

std::string_view word(Ending ending) {
  switch (ending) {
    case Ending::reached_end: return "reached_end";
    case Ending::stopped_by_condition: return "stopped_by_condition";
    case Ending::inverted_element: return "inverted_element";
    case Ending::not_finite: return "not_finite";
    case Ending::step_too_small: return "step_too_small";
    case Ending::energy_created: return "energy_created";
    case Ending::relaxed: return "relaxed";
    case Ending::not_relaxed: return "not_relaxed";
  }
  return "";
}

bool good(Ending ending) {
  return ending == Ending::reached_end || ending == Ending::stopped_by_condition || ending == Ending::relaxed;
}

Outcome run(const Model& model, State& now, Forces& forces, const Time& time, double settle_every,
            std::span<const Observer> observers, const Until& until) {
  Outcome outcome;
  const auto clock = [] { return std::chrono::steady_clock::now(); };
  const auto began = clock();
  Votes votes = start(model, now, forces);
  const auto show = [&](bool settled) {
    const View view{model, now, forces, votes, settled};
    for (const Observer& observer : observers) observer(view);
  };
  const auto enough = [&] {  // as the case has it
    if (until) outcome.reason = until({model, now, forces, votes, true});
    if (!outcome.reason.empty()) outcome.ending = Ending::stopped_by_condition;
    return outcome.ending == Ending::stopped_by_condition;
  };
  const double first_step = votes.step;
  std::int64_t samples = 0;  // multiples of settle_every that have passed
  bool settled = true;
  outcome.smallest_step = std::numeric_limits<double>::infinity();
  show(settled);
  bool wanted = enough();
  while (!stop(votes, first_step, time.end, outcome) && !wanted && now.t < time.end) {  // also the last step is looked at
    double dt = std::min(time.safety * votes.element_step, votes.contact_step);
    if (dt < outcome.smallest_step) outcome.smallest_step = dt, outcome.limited_by = votes.by;
    outcome.largest_step = std::max(outcome.largest_step, dt);
    // the last two steps share what is left, so that none is vanishingly short
    const double left = time.end - now.t;
    const bool last = left <= dt;
    if (left < 2 * dt) dt = last ? left : 0.5 * left;
    votes = step(model, dt, now, forces);
    if (last) now.t = time.end;
    const bool rests = model.relaxation && relax(model, now, forces);
    settled = last || rests || now.t >= static_cast<double>(samples + 1) * settle_every;
    if (settled) {
      samples = static_cast<std::int64_t>(now.t / settle_every);
      settle(model, now);
    }
    show(settled);
    if (settled && votes.size > 0 && created_too_much(now.ledger, time.created_limit, outcome)) break;
    if (rests && votes.size > 0) {
      outcome.ending = Ending::relaxed;
      break;
    }
    wanted = settled && enough();
  }
  if (model.relaxation && outcome.ending == Ending::reached_end) {
    outcome.ending = Ending::not_relaxed;
    outcome.reason = text("not relaxed: residual %.3g, the limit is %.3g", now.relaxation.residual, model.relaxation->residual);
  }
  if (!settled) {
    settle(model, now);
    show(true);
  }
  outcome.wall_seconds = std::chrono::duration<double>(clock() - began).count();
  outcome.element_updates = elements(model) * (now.step + 1);
  return outcome;
}

}  // namespace nereid::dynamics
