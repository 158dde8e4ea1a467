#include "dynamics/step.hpp"

#include "contact/contact.hpp"
#include "dynamics/balance.hpp"
#include "dynamics/forces.hpp"
#include "dynamics/kick.hpp"
#include "dynamics/relax.hpp"
#include "dynamics/rigid_step.hpp"
#include "dynamics/touch.hpp"
#include "load/floor.hpp"

namespace nereid::dynamics {

const StepLimits& step(const Model& model, double dt, const Pace& pace, State& now, Forces& f) {
  const double first = kick_to_the_middle(model, dt, now, f);  // v at t + dt/2, by the forces at t, with those of contact
  drift(model, dt, now, f);                                    // x at t + dt
  update(model, dt, pace, now, f);                             // stress of elements, springs of penalties, limits of the next step
  gather(model, now, f);                                       // forces at t + dt, without contact by multipliers
  enforce(model, dt, pace, now, f);                            // adds that contact: no gap is negative at the end of the next step
  const Ended ended = kick_to_the_end(model, dt, now, f);      // v at t + dt
  book(model, dt, first, ended, now);                          // energies and momenta
  return now.step_limits;
}

const StepLimits& start(const Model& model, const Pace& pace, State& now, Forces& f) {
  start_rigid_bodies(model, now);
  begin_ledger(model, now);
  constrain_velocities(model, now.ledger.initial_kinetic, now, f);
  load::find_impacts(model.constraints, model.mass, now.x, f.force, 0, now.v, now.constraints);
  load::finish_impacts(model.constraints, model.mass, now.x, f.force, 0, now.v, now.constraints);
  f.dx.setZero(), f.rotation.setZero();
  update(model, 0, pace, now, f);
  gather(model, now, f);
  open_ledger(model, pace, now);
  if (!f.allowed.empty()) {
    stop_at_start(model, pace, now, f);
    enforce(model, 0, pace, now, f);
    update_ledger(model, now);
  }
  update_reports(model, 0, now);
  return now.step_limits;
}

void resume(const Model& model, const State& now, Forces& f) {
  gather(model, now, f);
  add_contact_forces(model, now, true, f);
  gather_rigid_forces(model, f);
}

void change(const Model& model, const Vectors& velocity, const Vectors& spin, State& now, Forces& f) {
  const auto nodes = static_cast<Index>(now.x.cols());
  now.constraints = load::in_place_of(now.constraints, constraints_of_nodes(model), nodes, model.rotation_of_node);
  Ledger& ledger = now.ledger;
  const double before = kinetic_energy(model, now);
  Vec3 linear, angular, given, given_angular;
  momenta(model, now, linear, angular);
  if (!velocity.isZero(0) || !spin.isZero(0)) {
    now.v += velocity, now.omega += spin;
    start_rigid_bodies(model, now);
  }
  const double kinetic = kinetic_energy(model, now);
  momenta(model, now, given, given_angular);
  ledger.initial_kinetic += kinetic - before, ledger.initial_available += kinetic - before;
  ledger.initial_momentum += given - linear, ledger.initial_angular_momentum += given_angular - angular;
  constrain_velocities(model, kinetic, now, f);
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    load::advance(model.loads[l], model.mesh.X, now.x, now.v, now.omega, now.t, 0, now.loads[l]);
  update_ledger(model, now);
  if (!model.relaxation || !model.relaxes) return;
  resume(model, now, f);
  begin_relaxation(model, now, f);
}

}  // namespace nereid::dynamics
