#pragma once
// What a run owes an account of: energy by source, momentum and angular momentum.
//
// The schema is sources(model); the values are here, beside it. Each source posts its own, see base/account.hpp.

#include <vector>

#include "base/account.hpp"

namespace nereid::dynamics {

double stored(const Account&);      ///< [J] sum of the channels
double dissipated(const Account&);  ///< [J] sum of the channels
/// What the law of a block has given and never took: its store is an integral over the path, and none holds less than nothing. [J]
double overdrawn(const Account&);
/// Work that the source can neither take from its store nor has dissipated: nobody can explain it.
double created(const Account&);     ///< [J] work + stored + dissipated + overdrawn

/// Energy that a source created, beside what it transferred.
struct Created {
  double part = 0;    ///< [-] spurious_part()
  double energy = 0;  ///< [J] created() then, with its sign
  double passed = 0;  ///< [J] Flow::passed then
};

/// What passed through a source, summed step by step.
struct Flow {
  double passed = 0;     ///< [J] sum over the steps of |work in the step|
  double work = 0;       ///< [J] done up to now, as the account has it
  double recent = 0;     ///< [J] |work in a step|: the largest so far, halved with each step since
  double deficit = 0;       ///< [J] the part of created() that it knows of and takes back as soon as it takes energy: of multipliers
  double worst = 0;      ///< [-] spurious_part() where it was largest so far, with its sign
  Created told = {};     ///< the same of times at which more than least_share of the energy scale was created: what is worth a warning
  double worst_of_scene = 0;  ///< [-] created energy over the energy scale where it was largest at any update of the ledger, with its sign
};

struct Ledger {
  double initial_kinetic = 0;  ///< [J]
  double kinetic = 0;          ///< [J] now
  /// [J] the part of initial_kinetic that a scene can lose: where nothing acts from outside but gravity, about the common centre of mass.
  double initial_available = 0;
  /// [J] what the two half kicks of central differences add to the kinetic energy beyond the work of
  /// the trapezoid rule: the sum over steps of dt^2/8 (f'.f'/m - f.f/m).
  double integration = 0;
  /// [J] the most that came in from outside at any update of the ledger so far: the positive works of gravity and of
  /// the sources that take their work from outside (loads, planes and nodes that are moved).
  double external_work = 0;
  Vec3 initial_momentum = Vec3::Zero(), momentum = Vec3::Zero();                  ///< [kg m/s]
  Vec3 initial_angular_momentum = Vec3::Zero(), angular_momentum = Vec3::Zero();  ///< [kg m2/s]
  std::vector<Account> accounts;  ///< beside sources(model)
  std::vector<Flow> flows;        ///< beside accounts
  /// [J] The part of `integration` that stays: the rest, dt^2/8 f.f/m now less that at the start, comes back as the forces fall.
  double integration_kept = 0;
  double worst_kept = 0;   ///< [-] kept_part() where it was largest so far, with its sign
  double most_integration = 0;  ///< [J] `integration` where it was largest at any update, without its sign
  double size = 0;              ///< [m] of the scene at the start: twice the largest distance of a node from the centre of mass
  double largest_force = 0;     ///< [N] the largest of the weight of the scene and of what loads have applied in any step so far
  double round_off = 0;         ///< [J] energy at which all nodes move by a hundred times the round-off of positions in the first step
};

/// What the stores of an account, or all stores together, held at the start. [J]
double initial_stored(const Account&);
double initial_stored(const Ledger&);

/// Work that gravity and all sources that take it from outside have done, those that took energy out left aside. [J]
double work_from_loads(const Ledger&);

/// The energy of the scene: the largest of the available kinetic energy at the start, of the energy stored then, and of the external work
/// since. It does not depend on the frame of reference, down to 1e-6 of the kinetic energy. It never falls during a run. 0 while nothing
/// has moved. [J]
double energy_of_scene(const Ledger&);

/// The least energy that created energy is compared with: the work of the largest force over a thousandth of the size of the scene, and no
/// less than that of round-off. [J]
///
///     max(largest_force size / 1000, round_off)
///
/// At the start of a run that begins at rest the energy of the scene is round-off, and so are the energies of its sources.
double energy_floor(const Ledger&);

/// What created energy is compared with: the energy of the scene, and no less than its floor. It never falls during a run. 0 while nothing
/// has moved and no force acts: round-off alone is no energy to compare with. [J]
double energy_scale(const Ledger&);

/// Sources through which less than this part of the energy scale has passed are not judged. [-] The work of what
/// they may create unseen is less than that; most of it is round-off and chatter.
constexpr double least_share = 1e-4;
/// What passed through a source counts at least as this part of the energy scale. [-] Else the first bounce of a source whose flow has just
/// become worth judging would count as all that ever passes; at the usual limit 5e-5 of the scale are created unseen, half of least_share.
constexpr double least_flow = 1e-3;

/// Created energy of a source over what passed through it: positive where energy appears, negative where it vanishes. [-]
///
///     sign(c) max(0, |c| - w - o) / max(passed, 1e-3 scale),   c = created(account),  w = Flow::recent,
///                                                              o = min(Flow::deficit, 1e-4 scale) if c > 0
///
/// Work and store of one step differ by up to the work of that step while a contact closes or opens, which the next steps make good: with
/// the longest steps an impact is over after two or three. What a contact owes it pays from what it takes next; of that least_share of the
/// scene waits, no more than may be created unseen.
/// Zero of sources below least_share.
double spurious_part(const Ledger&, std::size_t source);

/// The energy scale without the work of gravity, which is only known at updates of the ledger: it does not depend on them. [J]
double steady_scale(const Ledger&);

/// An energy over what passed through a source, or over the scale where that is less. [-]
///
///     energy / min(passed, scale)
///
/// scale  [J] steady_scale(); zero: what passed alone counts.  Zero of sources below least_share
double part_of_flow(const Ledger&, std::size_t source, double energy, double scale);

/// What time integration has created, or lost where negative, for good, over the energy scale; 0 without a scale. [-]
///
/// The smaller of `integration_kept` and `integration` where both have one sign, else zero: what the forces now still make up for is no
/// loss of the kinetic energy yet, and comes to be one as they fall.
double kept_part(const Ledger&);

/// By how much the kinetic energy was too large at worst, over the energy scale now: `integration`, which but for kept_part() comes back as
/// the forces fall. 0 without a scale. [-]
double swing_part(const Ledger&);

/// Notes what each source has created of the energy of the scene, and `integration`, at an update of the ledger.
void update_created(Ledger&);

/// Brings the flows up to the works that stand in the accounts, at the end of a step.
void update_flows(Ledger&);

/// Energy that stands in no account: kinetic - initial - integration - sum of work; round-off. [J]
double energy_residual(const Ledger&);
/// Momentum that no impulse explains; round-off. [kg m/s]
Vec3 momentum_residual(const Ledger&);
/// Angular momentum that no impulse explains; round-off. [kg m2/s]
Vec3 angular_momentum_residual(const Ledger&);

}  // namespace nereid::dynamics
