#pragma once
// A model with everything that a run of it needs, for the tests of this folder.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/connect.hpp"
#include "dynamics/measure.hpp"
#include "dynamics/run.hpp"

namespace nereid::dynamics {

struct Scene {
  Model model;
  std::vector<contact::AnyMemory> memories;
  State state;
  Forces forces;

  void joined(const std::string& name, const std::string& apexes, const std::string& bases, const InterfaceOptions& options) {
    for (Connected& connected : connect(model, name, apexes, bases, options)) memories.push_back(std::move(connected.memory));
  }
  void ready() {
    state = initial_state(model, memories);
    forces = make_forces(model);
  }
  void move(const std::string& body, const Vec3& velocity) {
    for (const Index node : mesh::node_set(model.mesh, body)) state.v.col(node) = velocity;
  }
  Outcome run_to(double end, double update_every = 1e300, std::span<const Observer> observers = {}, double created_limit = 0.05) {
    Time time;
    time.end = end;
    time.created_limit = created_limit;
    return run(model, state, forces, time, update_every, {.observers = observers});
  }
};

/// The smallest of all limits on the next step, without any safety. [s]
inline double least(const StepLimits& limits) { return std::min(limits.elements.step, limits.contact.step); }

/// The account of a source by its name.
inline const Account& account(const Scene& s, const std::string& name) {
  return s.state.ledger.accounts[source_of(s.model, name)];
}

inline load::Plane plane(const std::string& name, load::PlaneKind kind, const Vec3& normal, const Subset& nodes,
                         const Vec3& point = Vec3::Zero()) {
  load::Plane p;
  p.name = name, p.kind = kind, p.normal = normal, p.nodes = nodes, p.point = point;
  return p;
}

/// All numbers that a state remembers, part by part.
inline std::vector<std::pair<std::string, std::vector<double>>> numbers(const State& s) {
  std::vector<std::pair<std::string, std::vector<double>>> parts;
  const auto part = [&](const std::string& name) { parts.emplace_back(name, std::vector<double>()); };
  const auto add = [&](auto... values) { (parts.back().second.push_back(static_cast<double>(values)), ...); };
  const auto all = [&](const auto& array) {
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(array.size()); ++i) add(array.data()[i]);
  };
  part("time"), add(s.t, s.dt, s.step);
  part("positions and velocities"), all(s.x), all(s.v), all(s.omega);
  for (const auto& block : s.blocks) {
    part("block"), all(block.rows), all(block.along), add(block.work);
    for (std::size_t c = 0; c < words_of_stored.size(); ++c) add(block.stored[Stored(c)], block.dissipated[Dissipated(c)]);
  }
  for (const auto& tiles : s.tiles) part("forces of a block"), all(tiles.force), all(tiles.moment);
  for (const contact::AnyMemory& any : s.contacts) {
    if (const auto* edges = std::get_if<contact::EdgeMemory>(&any)) {
      part("edges"), all(edges->force), all(edges->impulse);
      add(edges->work, edges->impact, edges->held, edges->friction_dissipated, edges->searches, edges->way, edges->edge_pairs.size());
      for (const contact::Crossing& one : edges->crossings) {
        all(one.push), all(one.normal), all(one.friction->force);
        add(one.edge, one.base_edge, one.side, one.level, one.gap, one.pressed, one.restitution.held, one.friction->acts);
      }
      continue;
    }
    const contact::Memory& c = std::get<contact::Memory>(any);
    part("interface");
    for (const auto& feature : c.feature) add(feature.facet, static_cast<int>(feature.kind), feature.local);
    for (const auto status : c.status) add(static_cast<int>(status));
    all(c.gap), all(c.stored), all(c.tangential_stored), all(c.reconnections), all(c.angular_impulse);
    for (const Vec3& slip : c.slip) all(slip);
    all(c.slot), all(c.near_facets);
    for (const contact::Near& near : c.near) {
      add(near.pressed, near.apex, near.first_facet, near.facets, near.safe_distance, near.is_idle, near.area, near.tracks.count,
          near.tracks.owned);
      for (int i = 0; i < near.tracks.count; ++i) add(near.tracks.track[i].facet, near.tracks.track[i].height);
      add(near.tracks.out.facet, near.tracks.out.height);
      if (near.tracks.out.facet >= 0) all(near.tracks.out.weight);
      const contact::ElementForces& e = near.element;
      all(e.apex), all(e.angular_impulse);
      add(e.closed, e.count, e.scale, e.stiffness, e.work, e.dissipated, e.created, e.moved, e.has_moment, e.depth, e.lost);
      for (int i = 0; i < e.count; ++i)
        add(e.stencil[i].facet, e.stencil[i].apex, static_cast<int>(e.stencil[i].kind), e.stencil[i].local, e.stencil[i].level),
            all(e.stencil[i].weight), all(e.stencil[i].push), all(e.stencil[i].share);
      const contact::FrictionForces& f = *near.friction;
      all(f.force), add(f.acts, f.stuck, f.sliding, f.stiffness, f.work, f.dissipated, f.created);
      if (!f.acts) continue;
      all(f.touch.normal), all(f.touch.arm), all(f.touch.node), all(f.touch.weight), all(f.touch.base_arm), all(f.touch.apex_arm);
      add(f.touch.apex, f.touch.base_rotates);
    }
    add(c.work, c.damped, c.friction_dissipated, c.created_by_reconnection, c.deepest, c.deepest_apex, c.deepest_time, c.walks);
    add(c.lost, c.recovered, c.impact, c.transferred, c.held, c.power_rate, c.friction_to_come);
    add(c.step_factor.lowered_at, c.step_factor.least_created, c.step_factor.most_created);
    for (const contact::Restitution& r : c.restitution) add(r.held, r.kept, r.mean_force, r.most_force, r.last_loss);
    all(c.force), all(c.impulse), add(c.searches, c.deepest_now, c.margin), all(c.apexes_then), all(c.base_then), all(c.mean_way);
  }
  for (const contact::PlaneMemory& p : s.rigid_planes) {
    part("rigid plane"), all(p.force), all(p.impulse), all(p.angular_impulse),
        add(p.work, p.stored, p.tangential_stored, p.friction_dissipated, p.deepest, p.deepest_node, p.deepest_time,
            p.step_factor.lowered_at, p.step_factor.least_created, p.step_factor.most_created);
    for (const Vec3& slip : p.slip) all(slip);
    for (const Vec3& force : p.friction) all(force);
    for (const char stuck : p.stuck) add(stuck);
    all(p.sliding), all(p.area);
    add(p.impact, p.transferred, p.power_rate, p.friction_to_come);
    for (const contact::Restitution& r : p.restitution) add(r.held, r.kept, r.mean_force, r.most_force, r.last_loss);
  }
  part("constraints");
  for (const auto& plane : s.constraints.account) all(plane.impulse), all(plane.angular_impulse), add(plane.stopped, plane.driven);
  for (const auto& stopped : s.constraints.stopped) all(stopped);
  all(s.constraints.active), all(s.constraints.row_of_node);
  for (const load::ConstrainedNode& node : s.constraints.nodes) {
    add(node.node, node.rotation, node.count, node.moves, node.rotation_constrained, node.driver);
    for (int i = 0; i < node.count; ++i) add(node.plane[i]), all(node.normal[i]), all(node.reaction[i]);
    all(node.allowed), all(node.allowed_rotation);
  }
  for (const auto& load : s.loads)
    part("load"), all(load.force), all(load.moment), all(load.impulse), all(load.angular_impulse),
        add(load.work, load.stored, load.dissipated);
  part("relaxation"), all(s.relaxation.x), all(s.relaxation.rotated), all(s.relaxation.force), all(s.relaxation.moment),
      all(s.relaxation.omega);
  add(s.relaxation.removed, s.relaxation.residual, s.relaxation.most_force, s.relaxation.most_kinetic, s.relaxation.balanced,
      s.relaxation.since);
  all(s.relaxation.impulse), all(s.relaxation.angular_impulse);
  part("ledger"), add(s.ledger.initial_kinetic, s.ledger.initial_available, s.ledger.kinetic, s.ledger.integration, s.ledger.external_work,
                      s.ledger.integration_kept, s.ledger.worst_kept, s.ledger.most_integration, s.ledger.size, s.ledger.largest_force,
                      s.ledger.round_off);
  all(s.ledger.momentum), all(s.ledger.angular_momentum), all(s.ledger.initial_momentum), all(s.ledger.initial_angular_momentum);
  for (const Account& a : s.ledger.accounts) {
    part("account"), add(a.work, a.created_by_reconnection), all(a.impulse), all(a.angular_impulse);
    for (std::size_t c = 0; c < words_of_stored.size(); ++c) add(a.stored[Stored(c)], a.at_start[Stored(c)], a.dissipated[Dissipated(c)]);
  }
  for (const Flow& f : s.ledger.flows) part("flow"), add(f.passed, f.work, f.recent, f.deficit, f.worst, f.worst_of_scene);
  part("quality"), add(s.progress.corners_seen), add(s.progress.corners_next), add(s.progress.corner);
  for (const Quality& seen : s.quality) add(seen.corner, seen.element, seen.time, seen.hourglass, seen.internal, seen.inverted);
  part("audit"), add(s.audit.looks, s.progress.audits, s.progress.audited, s.progress.audited_itself);
  for (const audit::Overlap& o : s.audit.overlaps) {
    add(o.surface[0], o.surface[1], o.at_start, o.accepted, o.allowed, o.deepest, o.grown, o.time, o.worst.depth, o.worst.size,
        o.worst.region[0], o.worst.region[1], o.worst.open, o.sure, o.sure_time, o.surest.depth, o.surest.size, o.surest.open);
    all(o.worst.place), all(o.surest.place);
  }
  const StepLimits& limits = s.step_limits;
  part("step limits"), add(limits.elements.step, limits.elements.source, limits.elements.at, limits.contact.step, limits.contact.source,
                           limits.contact.at, limits.volume_ratio, limits.smallest_block, limits.smallest_element, limits.may_grow,
                           limits.costly, limits.trend);
  part("progress"), add(s.progress.started, s.progress.first_step, s.progress.updates, s.progress.ledger_is_current,
                        s.progress.smallest.dt, s.progress.smallest.source, s.progress.smallest.at, s.progress.largest_step);
  for (const ProbeMemory& p : s.probes) {
    part("probe"), add(p.last, p.largest, p.smallest, p.time_of_largest, p.time_of_smallest, p.integral, p.first_above_zero,
                       p.last_above_zero, p.samples, p.largest_row, p.smallest_row);
    for (const Kept& kept : {p.of_steps, p.of_rows}) add(kept.since), all(kept.integral), all(kept.value);
  }
  return parts;
}

inline void expect_same_bits(const State& a, const State& b) {
  const auto p = numbers(a), q = numbers(b);
  ASSERT_EQ(p.size(), q.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    ASSERT_EQ(p[i].second.size(), q[i].second.size()) << p[i].first;
    EXPECT_EQ(std::memcmp(p[i].second.data(), q[i].second.data(), sizeof(double) * p[i].second.size()), 0) << p[i].first;
  }
}

}  // namespace nereid::dynamics
