// Two masses and one contact element: a bounce on the penalty.
//
//          * apex, moves down           While the element is closed the pair is an oscillator of the reduced
//          |                            mass m = m1 m2/(m1 + m2): it closes, turns back after half a period
//     -----+-----  base, at rest        and opens. Sampled at steps, the spring is switched on and off late.
//
// Question  How long and how deep is the contact, how strong its peak, and how much faster do the masses part than
//           they met?
// Answer    verification/penalty_oscillator/README.md
// Run       penalty_oscillator cases/penalty_oscillator/bounce.yaml --out out/penalty_oscillator

#include <algorithm>
#include <cmath>

#include "base/words.hpp"
#include "contact/penalty/impact_step.hpp"
#include "drivers/driver.hpp"
#include "dynamics/balance.hpp"
#include "dynamics/run.hpp"
#include "model/values.hpp"

using namespace nereid;

struct Case {
  int base_nodes;            // 3, 2, 1: tetrahedral, triangular, line element
  double apex_mass, base_mass;  // [kg]; the base nodes share theirs
  double stiffness;          // [N/m]
  double speed;              // [m/s] of the apex
  double step;               // [-] over sqrt(m/k)
  int phases;                // of the first sample in contact, evenly spread over a step
  contact::Area area;
};

Case read(const input::Section& root) {
  const auto masses = root.section("masses");
  const std::vector<std::string> kinds{"line", "triangular", "tetrahedral"};
  const std::string kind = root.choice_or("element", "tetrahedral", kinds);
  return {.base_nodes = 1 + static_cast<int>(std::find(kinds.begin(), kinds.end(), kind) - kinds.begin()),
          .apex_mass = masses.quantity("apex", dim::mass, input::positive),
          .base_mass = masses.quantity("base", dim::mass, input::positive),
          .stiffness = root.quantity("stiffness", dim::stiffness, input::positive),
          .speed = root.quantity("speed", dim::speed, input::positive),
          .step = root.number("step", input::between(0, 2)),
          .phases = root.count_or("phases", 400, 1, 100000),
          .area = root.choice_or("area", "apex", {"apex", "base"}) == "base" ? contact::Area::base : contact::Area::apex};
}

/// Steps of one bounce at most: those of ten periods of a mass on a spring.
double most_steps_of(const Case& c) { return 20 * pi / c.step + 20; }

/// Refuses what would not end, or would write more rows than any run may.
void check_work(const Case& c, const input::CaseFile& file) {
  const double steps = most_steps_of(c), all = steps * (c.phases + 1.0);
  const std::string said = quote("step") + " = " + shortest(c.step) + " takes up to ";
  if (steps > model::most_rows) file.fault("step", said + formatted("%.3g rows of the history: expected at most ten million", steps), "");
  else if (all > dynamics::most_steps)
    file.fault("step", said + formatted("%.3g steps for %d phases: expected at most a billion", all, c.phases), "");
  file.finish();
}

constexpr double contact_height = 0.1;  // [m] over edges and vertices only a height has a direction

/// What swings: the apex is the last node, the base nodes are the first ones.
struct Pair {
  dynamics::Model model;
  contact::Memory memory;
  Index apex;
};

/// A facet, two facets that meet in a ridge, or three that meet in a vertex; the apex stands above at `height` [m].
Pair pair_of(const Case& c, double height) {
  Vectors X;
  Table<3> facets;
  if (c.base_nodes == 3) {
    X.resize(3, 4), facets.resize(3, 1);
    X << -1, 2, -1, 0,
         -1, -1, 2, 0,
         0, 0, 0, height;
    facets << 0, 1, 2;
  } else if (c.base_nodes == 2) {
    X.resize(3, 5), facets.resize(3, 2);
    X << -1, 1, 0, 0, 0,
         0, 0, 1, -1, 0,
         0, 0, -1, -1, height;
    facets << 0, 1,
              1, 0,
              2, 3;
  } else {
    X.resize(3, 5), facets.resize(3, 3);
    X << 0, 2, -1, -1, 0,
         0, 0, 2, -2, 0,
         0, -2, -2, -2, height;
    facets << 0, 0, 0,
              1, 2, 3,
              2, 3, 1;
  }
  const auto apex = static_cast<Index>(X.cols() - 1);
  dynamics::Model model;
  model.mesh.X = X;
  model.mesh.surfaces.push_back({"base", facets});
  Subset touched, others;
  for (Index node = 0; node < apex; ++node) (node < c.base_nodes ? touched : others).push_back(node);
  model.point_masses.push_back({"apex", {apex}, c.apex_mass});
  model.point_masses.push_back({"base", touched, c.base_mass});
  if (!others.empty()) model.point_masses.push_back({"rest", others, c.base_mass});
  dynamics::finalize(model);

  contact::Interface interface;
  interface.name = "contact";
  interface.base = contact::base_surface(model.mesh.surfaces[0], X);
  interface.apexes = {apex};
  interface.area = Scalars::Ones(1);
  interface.facet_area = mesh::facet_areas(model.mesh, model.mesh.surfaces[0]);
  interface.penalty = c.stiffness;  // over an area of 1 m2
  interface.area_kind = c.area;
  interface.margin = 10;
  interface.impact_step_factor = contact::impact_step_factor_for(0.005);
  Pair pair{std::move(model), {}, apex};
  contact::Workspace workspace(interface);
  contact::connect(interface, pair.model.mesh.X, 10, {.from_initial_height = false, .clearance = 0, .given = contact_height},
                   contact::InitialPenetration::refuse, pair.memory, workspace);
  pair.model.contacts.push_back(std::move(interface));
  return pair;
}

/// Upward velocity of the base nodes that the element pushes. [m/s]
double base_velocity(const Case& c, const dynamics::State& state) {
  double sum = 0;
  for (Index node = 0; node < c.base_nodes; ++node) sum += state.v(2, node);
  return sum / c.base_nodes;
}

struct Bounce {
  double contact_time = 0, peak_force = 0, penetration = 0;  // [s] [N] [m]
  double rebound = 0;                                        // [-] speed apart over speed of approach
  double voted_step = 0;                                     // [s]
  double booked = 0;                                         // [-] energy created by the ledger less that gained, over the impact's
  std::vector<Source> sources;
  dynamics::Ledger ledger;
};

double reduced_mass(const Case& c) { return c.apex_mass * c.base_mass / (c.apex_mass + c.base_mass); }

/// One bounce whose first sample in contact comes `phase` steps after the touch; rows of history where wanted.
Bounce bounce(const Case& c, double phase, driver::Answer* record) {
  const double dt = c.step * std::sqrt(reduced_mass(c) / c.stiffness), start_gap = c.speed * dt * (1 - phase);
  Pair pair = pair_of(c, contact_height + start_gap);
  dynamics::State state = dynamics::initial_state(pair.model, {std::move(pair.memory)});
  dynamics::Forces forces = dynamics::make_forces(pair.model);
  state.v(2, pair.apex) = -c.speed;

  Bounce seen;
  seen.voted_step = dynamics::start(pair.model, state, forces).contact.step;
  double last_gap = start_gap, touch = 0;
  const auto look = [&](double gap) {
    const double force = forces.force(2, pair.apex);
    seen.peak_force = std::max(seen.peak_force, force);
    seen.penetration = std::max(seen.penetration, -gap);
    if (record == nullptr) return;
    record->time.push_back(state.t);
    record->rows.push_back({gap, force, state.v(2, pair.apex), base_velocity(c, state)});
  };
  look(start_gap);
  const auto most_steps = static_cast<int>(most_steps_of(c));
  for (int s = 0; s < most_steps; ++s) {
    dynamics::step(pair.model, dt, state, forces);
    const double gap = std::get<contact::Memory>(state.contacts[0]).gap[0];
    look(gap);
    const double crossing = state.t - dt * gap / (gap - last_gap);
    if (last_gap >= 0 && gap < 0) touch = crossing;
    const bool released = last_gap < 0 && gap >= 0;
    if (released) seen.contact_time = crossing - touch;
    last_gap = gap;
    if (released) break;
  }
  seen.rebound = (state.v(2, pair.apex) - base_velocity(c, state)) / c.speed;
  dynamics::update_ledger(pair.model, state);
  seen.sources = dynamics::sources(pair.model);
  seen.ledger = state.ledger;
  const double impact = 0.5 * reduced_mass(c) * c.speed * c.speed;
  seen.booked = (dynamics::created(state.ledger.accounts[0]) - (state.ledger.kinetic - state.ledger.initial_kinetic)) / impact;
  return seen;
}

/// Whether the pair, pressed together so that it never opens, swings without growing. Pressed so gently that
/// the apex, which stands on its base like a pole, has no time to fall over.
bool stays_bounded(const Case& c, double step) {
  const double dt = step * std::sqrt(reduced_mass(c) / c.stiffness), depth = 1e-6, press = c.stiffness * depth;
  Pair pair = pair_of(c, contact_height - depth);
  const auto constant = [](double z) {
    const load::OverTime none = [](double) { return 0.0; };
    return std::array<load::OverTime, 3>{none, none, [z](double) { return z; }};
  };
  Subset base;
  for (Index node = 0; node < c.base_nodes; ++node) base.push_back(node);
  pair.model.loads.push_back(load::NodalForce{"on_apex", {pair.apex}, constant(-press)});
  pair.model.loads.push_back(load::NodalForce{"on_base", base, constant(press)});
  dynamics::State state = dynamics::initial_state(pair.model, {std::move(pair.memory)});
  dynamics::Forces forces = dynamics::make_forces(pair.model);
  state.v(2, pair.apex) = 1e-6 * depth / dt;
  dynamics::start(pair.model, state, forces);
  constexpr int steps = 2000;
  for (int s = 0; s < steps; ++s) {
    dynamics::step(pair.model, dt, state, forces);
    if (!(std::abs(std::get<contact::Memory>(state.contacts[0]).gap[0] + depth) < 0.1 * depth)) return false;
  }
  return true;
}

/// The largest stable step of the closed pair by halving. [s]
double critical_step(const Case& c) {
  double stable = 1, unstable = 3;  // [-] over sqrt(m/k)
  while (unstable - stable > 1e-6) {
    const double middle = 0.5 * (stable + unstable);
    (stays_bounded(c, middle) ? stable : unstable) = middle;
  }
  return stable * std::sqrt(reduced_mass(c) / c.stiffness);
}

std::function<driver::Answer()> plan(const input::CaseFile& file) {
  const Case c = read(file.root());
  file.finish();
  check_work(c, file);
  return [c] {
    driver::Answer answer{.columns = {{"gap", "m"}, {"force", "N"}, {"velocity_apex", "m/s"}, {"velocity_base", "m/s"}},
                          .time = {}, .rows = {}, .results = {}};
    double least = 1e300, most = 0, booked = 0, momentum = 0;
    const Bounce middle = bounce(c, 0.5, &answer);
    for (int p = 0; p < c.phases; ++p) {
      const Bounce one = bounce(c, (p + 0.5) / c.phases, nullptr);
      least = std::min(least, one.rebound), most = std::max(most, one.rebound);
      booked = std::max(booked, std::abs(one.booked));
      momentum = std::max(momentum, std::abs(one.ledger.momentum.z() / (c.apex_mass * c.speed) + 1));
    }
    answer.sources = middle.sources, answer.ledger = middle.ledger;
    answer.results = {{"contact_time", middle.contact_time, "s"},
                      {"peak_force", middle.peak_force, "N"},
                      {"penetration", middle.penetration, "m"},
                      {"rebound_largest", most, "1"},
                      {"rebound_smallest", least, "1"},
                      {"booked_amiss", booked, "1"},
                      {"momentum_lost", momentum, "1"},
                      {"voted_step", middle.voted_step, "s"},
                      {"critical_step", critical_step(c), "s"}};
    return answer;
  };
}

int main(int argc, char** argv) { return driver::answer(argc, argv, "penalty_oscillator", plan); }
