#include "dynamics/step.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace nereid::dynamics {

namespace {

constexpr Index range = 512;  // nodes per partial sum: fixed, so that no thread count changes a bit

/// Sum over i < count of term(i), in ranges that are added in order.
template <class Term>
double ordered_sum(Index count, std::vector<double>& partial, Term&& term) {
  const Index ranges = (count + range - 1) / range;
  partial.resize(ranges);
  parallel_for(ranges, 8, [&](Index r) {
    double sum = 0;
    for (Index i = r * range; i < std::min(count, (r + 1) * range); ++i) sum += term(i);
    partial[r] = sum;
  });
  double sum = 0;
  for (const double p : partial) sum += p;
  return sum;
}

/// Which half of a step a kick is.
enum class Half { first, second };

/// Changes velocities by the impulses of the forces over dt, within the constraints.
///
/// t  [s] to which the new velocities belong
/// returns  sum of f.f/m over what the constraints let through: the ledger's integration term
double kick(const Model& model, double dt, double t, Half half, State& now, Forces& f) {
  auto& constraints = now.constraints;
  load::set_speeds(model.constraints, model.mesh.X, t, constraints);
  const double nodes = ordered_sum(static_cast<Index>(now.v.cols()), f.partial, [&](Index node) {
    const double mass = model.mass(node);
    const Vec3 force = f.force.col(node);
    const Index held = constraints.held_of_node[node];
    now.v.col(node) += dt / mass * force;  // held nodes are restrained below, in order
    if (held < 0 || constraints.held[held].count == 0) return force.squaredNorm() / mass;
    return (constraints.held[held].allowed * force).squaredNorm() / mass;
  });
  const double turns = ordered_sum(static_cast<Index>(now.w.cols()), f.partial, [&](Index turn) {
    const double inertia = model.inertia(turn);
    const Vec3 moment = f.moment.col(turn);
    const Index held = constraints.held_of_node[model.node_of_turn[turn]];
    now.w.col(turn) += dt / inertia * moment;
    if (held < 0) return moment.squaredNorm() / inertia;
    return (constraints.held[held].allowed_turn * moment).squaredNorm() / inertia;
  });
  for (const Index place : constraints.active) {
    const load::HeldNode& held = constraints.held[place];
    const double mass = model.mass(held.node);
    const double quarter_step = half == Half::first ? -dt / 2 : dt / 2;
    Vec3 v = now.v.col(held.node);
    if (held.moves) {
      const Vec3 force = f.force.col(held.node), before = v - dt / mass * force;
      load::drive(model.constraints, held, now.x.col(held.node), mass, before, force, quarter_step, v, constraints.account);
    } else {
      load::restrain(model.constraints, held, now.x.col(held.node), mass, v, constraints.account);
    }
    now.v.col(held.node) = v;
    if (held.turn < 0) continue;
    Vec3 w = now.w.col(held.turn);
    const double inertia = model.inertia(held.turn);
    if (held.driver >= 0) {
      const Vec3 moment = f.moment.col(held.turn), before = w - dt / inertia * moment;
      load::drive_turn(held, inertia, before, moment, quarter_step, w, constraints.account);
    } else {
      load::restrain_turn(held, inertia, w, constraints.account);
    }
    now.w.col(held.turn) = w;
  }
  return nodes + turns;
}

/// Changes the velocity of a node along the normal of a floor and books it to the floor.
///
/// returns  the change [m/s]; zero if other planes hold the node in that direction already
Vec3 strike(const Model& model, const load::HeldNode& held, int plane, double to, const Vec3& x, double mass, State& now) {
  const load::Plane& floor = model.constraints.planes[plane];
  const Vec3 way = held.allowed * floor.normal;  // other planes may hold the node already
  const double along = way.dot(floor.normal);
  if (!(along > 1e-12)) return Vec3::Zero();
  const Vec3 change = (to - now.v.col(held.node).dot(floor.normal)) / along * way;
  const Vec3 impulse = mass * change;
  load::PlaneAccount& account = now.constraints.account[plane];
  account.impulse += impulse;
  account.angular_impulse += x.cross(impulse);
  account.caught -= impulse.dot(now.v.col(held.node) + 0.5 * change);
  now.v.col(held.node) += change;
  return change;
}

/// Nodes that would pass a floor in this step land on it exactly: their velocity is changed now, and
/// taken away when they have arrived.
void find_landings(const Model& model, double dt, State& now, const Forces& f) {
  auto& memory = now.constraints;
  memory.landing.clear();
  for (std::size_t p = 0; p < model.constraints.planes.size(); ++p) {
    const load::Plane& floor = model.constraints.planes[p];
    if (floor.kind != load::PlaneKind::floor) continue;
    for (std::size_t i = 0; i < floor.nodes.size(); ++i) {
      if (memory.caught[p][i]) continue;
      const Index node = floor.nodes[i];
      const double height = (now.x.col(node) - floor.point).dot(floor.normal);
      const double speed = now.v.col(node).dot(floor.normal);
      if (height + dt * speed > 0 || (height == 0 && speed > 0)) continue;
      const Index place = memory.held_of_node[node];
      const double landing_speed = dt > 0 ? -height / dt : 0;
      const Vec3 change =
          strike(model, memory.held[place], static_cast<int>(p), landing_speed, now.x.col(node), model.mass(node), now);
      // the other sources post half of this step's work with the changed velocity
      memory.account[p].caught += 0.5 * dt * f.force.col(node).dot(change);
      memory.caught[p][i] = 2;  // about to land
      memory.landing.push_back(place);
    }
  }
}

/// Takes the round-off of the drift from the positions of nodes that land.
void put_on_floors(const Model& model, State& now) {
  auto& memory = now.constraints;
  if (memory.landing.empty()) return;
  for (std::size_t p = 0; p < model.constraints.planes.size(); ++p) {
    const load::Plane& floor = model.constraints.planes[p];
    for (std::size_t i = 0; i < memory.caught[p].size(); ++i) {
      if (memory.caught[p][i] != 2) continue;
      const Index node = floor.nodes[i];
      const Vec3 way = memory.held[memory.held_of_node[node]].allowed * floor.normal;
      const double along = way.dot(floor.normal), height = (now.x.col(node) - floor.point).dot(floor.normal);
      if (along > 1e-12) now.x.col(node) -= height / along * way;
    }
  }
}

/// Nodes that have landed are held from now on.
void finish_landings(const Model& model, double dt, State& now, const Forces& f) {
  auto& memory = now.constraints;
  if (memory.landing.empty()) return;
  for (std::size_t p = 0; p < model.constraints.planes.size(); ++p) {
    const load::Plane& floor = model.constraints.planes[p];
    for (std::size_t i = 0; i < memory.caught[p].size(); ++i) {
      if (memory.caught[p][i] != 2) continue;
      const Index node = floor.nodes[i];
      load::HeldNode& held = memory.held[memory.held_of_node[node]];
      const Vec3 change = strike(model, held, static_cast<int>(p), 0, now.x.col(node), model.mass(node), now);
      memory.account[p].caught -= 0.5 * dt * f.force.col(node).dot(change);
      if (held.count == 0) memory.active.push_back(memory.held_of_node[node]);
      load::hold(model.constraints, held, static_cast<int>(p));
      memory.caught[p][i] = 1;
    }
  }
}

/// Brings every block and interface to the new positions and sums the forces by node.
Votes update(const Model& model, double dt, State& now, Forces& f) {
  Votes votes;
  const auto limit = [&votes](double step, std::string_view by, Index element) {
    if (step < votes.step) votes.step = step, votes.by = by, votes.element = element;
  };
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const element::Vote vote = element::advance(model.blocks[b], now.x, now.v, now.w, dt, now.blocks[b], f.blocks[b]);
    limit(vote.step, element::name(model.blocks[b]), vote.step_element);
    votes.element_step = std::min(votes.element_step, vote.step);
    if (vote.size < votes.size || std::isnan(vote.size)) {  // once found, a NaN stays
      votes.size = vote.size, votes.smallest_block = element::name(model.blocks[b]), votes.smallest_element = vote.size_element;
    }
  }
  for (std::size_t c = 0; c < model.interfaces.size(); ++c) {
    contact::advance(model.interfaces[c], now.x, now.v, now.w, dt, now.interfaces[c], f.interfaces[c]);
    const double step = contact::stable_step(model.interfaces[c], model.mass, model.inertia, f.interfaces[c]);
    limit(step, model.interfaces[c].name, -1);
    votes.contact_step = std::min(votes.contact_step, step);
  }
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) {
    contact::advance(model.rigid_planes[p], now.x, now.v, dt, now.rigid_planes[p]);
    const double step = contact::stable_step(model.rigid_planes[p], model.mass);
    limit(step, model.rigid_planes[p].name, -1);
    votes.contact_step = std::min(votes.contact_step, step);
  }
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    load::advance(model.loads[l], model.mesh.X, now.x, now.v, now.w, now.t, dt, now.loads[l]);
  if (f.springs.stiffest >= 0) {
    const double step = load::step_with_springs(votes.element_step, f.springs);
    // the name of the spring stands for the elements too, where it is what makes the difference
    if (step < 0.5 * votes.element_step) {
      limit(step, load::name(model.loads[f.springs.stiffest]), -1);
    } else {
      limit(step, votes.by, votes.element);
    }
    votes.element_step = step;
  }
  return votes;
}

/// Forces on the nodes, summed over sources and tiles in a fixed order.
void gather(const Model& model, const State& now, Forces& f) {
  for (Eigen::Index node = 0; node < f.force.cols(); ++node) f.force.col(node) = model.mass(node) * model.gravity;
  f.moment.setZero();
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const PlacesOfNodes& places = model.places[b];
    const element::TileForces& tiles = f.blocks[b];
    const bool turns = tiles.moment.cols() > 0;
    parallel_for(static_cast<Index>(places.node.size()), 2000, [&](Index i) {
      const Index node = places.node[i];
      Vec3 force = f.force.col(node), moment = Vec3::Zero();
      for (Index p = places.begin[i]; p < places.begin[i + 1]; ++p) {
        force += tiles.force.col(places.place[p]);
        if (turns) moment += tiles.moment.col(places.place[p]);
      }
      f.force.col(node) = force;
      if (turns) f.moment.col(model.turn_of_node[node]) += moment;
    });
  }
  for (std::size_t c = 0; c < model.interfaces.size(); ++c) contact::add_forces(model.interfaces[c], f.interfaces[c], f.force, f.moment);
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p)
    contact::add_forces(model.rigid_planes[p], now.rigid_planes[p], f.force);
  for (std::size_t l = 0; l < model.loads.size(); ++l) load::add_forces(model.loads[l], now.loads[l], f.force, f.moment);
}

/// Angular impulse of gravity over a step, by the trapezoid rule: the centre of mass in its middle.
void post_moment_of_gravity(const Model& model, double dt, State& now) {
  if (model.gravity.isZero(0)) return;
  Vec3 middle = Vec3::Zero();
  for (Eigen::Index n = 0; n < now.x.cols(); ++n) middle += model.mass(n) * (now.x.col(n) - 0.5 * dt * now.v.col(n));
  now.ledger.accounts.back().angular_impulse += dt * middle.cross(model.gravity);
}

/// Books what a store holds now, less what it held at the start.
void hold(Account& account, int share, double now) {
  Share& store = account.stored[static_cast<std::size_t>(share)];
  store.value = now - store.at_start;
}

double kinetic_energy(const Model& model, const State& now) {
  double sum = 0;
  for (Eigen::Index n = 0; n < now.v.cols(); ++n) sum += 0.5 * model.mass(n) * now.v.col(n).squaredNorm();
  for (Eigen::Index n = 0; n < now.w.cols(); ++n) sum += 0.5 * model.inertia(n) * now.w.col(n).squaredNorm();
  return sum;
}

void momenta(const Model& model, const State& now, Vec3& linear, Vec3& angular) {
  linear.setZero();
  angular.setZero();
  for (Eigen::Index n = 0; n < now.v.cols(); ++n) {
    const Vec3 p = model.mass(n) * now.v.col(n), at = now.x.col(n);
    linear += p;
    angular += at.cross(p);
  }
  for (Eigen::Index n = 0; n < now.w.cols(); ++n) angular += model.inertia(n) * now.w.col(n);
}

}  // namespace

Votes step(const Model& model, double dt, State& now, Forces& f) {
  const double before = kick(model, dt / 2, now.t + dt / 2, Half::first, now, f);  // v at the half step
  find_landings(model, dt, now, f);
  now.x += dt * now.v;
  now.t += dt;
  put_on_floors(model, now);
  post_moment_of_gravity(model, dt, now);
  const Votes votes = update(model, dt, now, f);        // memory: stress, connectivity; forces by source
  gather(model, now, f);
  finish_landings(model, dt, now, f);
  const double after = kick(model, dt / 2, now.t, Half::second, now, f);  // v at t + dt
  now.ledger.integration += dt * dt / 8 * (after - before);
  now.dt = dt;
  ++now.step;
  return votes;
}

Votes start(const Model& model, State& now, Forces& f) {
  now.ledger.initial_kinetic = kinetic_energy(model, now);
  momenta(model, now, now.ledger.initial_momentum, now.ledger.initial_angular_momentum);
  f.force.setZero();
  f.moment.setZero();
  const double unrestrained = now.ledger.initial_kinetic;
  kick(model, 0, now.t, Half::second, now, f);  // nodes start as their planes allow
  double lost = unrestrained - kinetic_energy(model, now);
  for (const load::PlaneAccount& plane : now.constraints.account) lost += plane.driven - plane.caught;  // booked already
  if (lost != 0) {
    for (std::size_t p = 0; p < model.constraints.planes.size(); ++p) {
      if (now.constraints.account[p].impulse.isZero(0) && now.constraints.account[p].angular_impulse.isZero(0)) continue;
      now.constraints.account[p].caught += lost;  // by the first plane that had to act
      break;
    }
  }
  find_landings(model, 0, now, f);
  finish_landings(model, 0, now, f);
  const Votes votes = update(model, 0, now, f);
  gather(model, now, f);
  for (Account& account : now.ledger.accounts)
    for (Share& share : account.stored) share.at_start = 0;
  settle(model, now);
  for (Account& account : now.ledger.accounts)
    for (Share& share : account.stored) share.at_start = share.name == "outside" ? 0 : share.value;
  now.ledger.brought_in = 0;
  settle(model, now);
  return votes;
}

void settle(const Model& model, State& now) {
  Ledger& ledger = now.ledger;
  ledger.kinetic = kinetic_energy(model, now);
  momenta(model, now, ledger.momentum, ledger.angular_momentum);
  std::size_t a = 0;
  for (const element::Memory& block : now.blocks) {
    Account& account = ledger.accounts[a++];
    account.work = block.work;
    const double dissipated[] = {block.plastic, block.viscous, block.hourglass};
    for (std::size_t s = 0; s < account.stored.size(); ++s) hold(account, static_cast<int>(s), block.stored[s]);
    for (std::size_t s = 0; s < account.dissipated.size(); ++s) account.dissipated[s].value = dissipated[s];
  }
  for (const contact::Memory& interface : now.interfaces) {
    Account& account = ledger.accounts[a++];
    account.work = interface.work;
    hold(account, 0, contact::stored(interface));
    account.dissipated[0].value = interface.damped;
    if (!interface.slip.empty()) {
      hold(account, 1, contact::stick_stored(interface));
      account.dissipated[1].value = interface.rubbed;
    }
    account.created_by_reconnection = interface.created_by_reconnection;
    account.angular_impulse = interface.angular_impulse;
  }
  for (const contact::PlaneMemory& plane : now.rigid_planes) {
    Account& account = ledger.accounts[a++];
    account.work = plane.work;
    hold(account, 0, plane.stored);
    if (!plane.slip.empty()) {
      hold(account, 1, plane.stick_stored);
      account.dissipated[0].value = plane.rubbed;
    }
    account.impulse = plane.impulse;
    account.angular_impulse = plane.angular_impulse;
  }
  for (const load::PlaneAccount& plane : now.constraints.account) {
    Account& account = ledger.accounts[a++];
    account.work = plane.driven - plane.caught;
    if (!account.stored.empty()) account.stored[0].value = -plane.driven;
    account.dissipated[0].value = plane.caught;
    account.impulse = plane.impulse;
    account.angular_impulse = plane.angular_impulse;
  }
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const load::LoadMemory& memory = now.loads[l];
    Account& account = ledger.accounts[a++];
    account.work = memory.work;
    if (load::is_spring(model.loads[l])) {
      hold(account, 0, memory.stored);
      account.dissipated[0].value = memory.dissipated;
    } else {
      account.stored[0].value = -memory.work;  // what a load does, it takes from outside
    }
    account.impulse = memory.impulse;
    account.angular_impulse = memory.angular_impulse;
  }
  if (model.relaxation) {
    Account& account = ledger.accounts[a++];
    account.work = -now.relaxation.removed;
    account.dissipated[0].value = now.relaxation.removed;
    account.impulse = now.relaxation.impulse;
    account.angular_impulse = now.relaxation.angular_impulse;
  }
  if (!model.gravity.isZero(0)) {
    Account& account = ledger.accounts[a];
    const double mass = model.mass.sum();
    Vec3 fallen = Vec3::Zero();
    for (Eigen::Index n = 0; n < now.x.cols(); ++n) fallen += model.mass(n) * (now.x.col(n) - model.mesh.X.col(n));
    hold(account, 0, -fallen.dot(model.gravity));
    account.work = -account.stored[0].value;
    account.impulse = mass * now.t * model.gravity;
  }
  ledger.brought_in = std::max(ledger.brought_in, work_from_outside(ledger));
}

}  // namespace nereid::dynamics
