#include "dynamics/archive.hpp"

#include <algorithm>
#include <cmath>

#include "base/archive.hpp"
#include "base/checksum.hpp"

namespace nereid {

template <class Archive, class Channel>
void visit(Archive& archive, Channels<Channel>& channels) {
  auto values = std::bit_cast<std::array<double, sizeof(Channels<Channel>) / sizeof(double)>>(channels);
  archive(values);
  channels = std::bit_cast<Channels<Channel>>(values);
}

template <class Archive>
void visit(Archive& archive, Account& account) {
  auto& [work, stored, at_start, dissipated, by_reconnection, impulse, angular_impulse] = account;
  archive(work, stored, at_start, dissipated, by_reconnection, impulse, angular_impulse);
}

namespace contact {

template <class Archive>
void visit(Archive& archive, Feature& feature) {
  auto& [facet, kind, local] = feature;
  archive(facet, kind, local);
}

template <class Archive>
void visit(Archive& archive, Restitution& one) {
  auto& [held, kept, mean_force, most_force, last_loss, blow] = one;
  archive(held, kept, mean_force, most_force, last_loss, blow);
}

template <class Archive>
void visit(Archive& archive, StepFactorMemory& memory) {
  auto& [lowered_at, least_created, most_created] = memory;
  archive(lowered_at, least_created, most_created);
}

template <class Archive>
void visit(Archive& archive, Track& track) {
  auto& [facet, height] = track;
  archive(facet, height);
}

template <class Archive>
void visit(Archive& archive, Place& place) {
  auto& [facet, weight, height] = place;
  archive(facet, weight, height);
}

template <class Archive>
void visit(Archive& archive, Tracks& tracks) {
  auto& [count, track, owned, out] = tracks;
  archive(count, track, owned, out);
}

template <class Archive>
void visit(Archive& archive, Share& share) {
  archive(share.node, share.push, share.of_apex_side);
}

template <class Archive>
void visit(Archive& archive, Stencil& stencil) {
  auto& [facet, apex, weight, fourth, push, share, kind, local, on_ridge, level, over_points, first_share, shares] = stencil;
  archive(facet, apex, weight, fourth, push, share, kind, local, on_ridge, level, over_points, first_share, shares);
}

template <class Archive>
void visit(Archive& archive, Stencils& stencils, int& count) {
  archive(count);
  for (int s = 0; s < std::min(count, most_stencils); ++s) archive(stencils[s]);
}

template <class Archive>
void visit(Archive& archive, ElementForces& element) {
  auto& [closed, has_moment, moved, lost, count, penalty, stiffness, scale, depth, closes_in, work, created, dissipated, apex,
         angular_impulse, stencil] = element;
  archive(closed, has_moment, moved, lost, penalty, stiffness, scale, depth, closes_in, work, created, dissipated, apex, angular_impulse);
  visit(archive, stencil, count);
}

template <class Archive>
void visit(Archive& archive, Touch& touch) {
  auto& [normal, arm, apex, nodes, node, weight, lift, base_arm, apex_arm, base_rotates, offset, per_inertia] = touch;
  archive(normal, arm, apex, nodes, node, weight, lift, base_arm, apex_arm, base_rotates, offset, per_inertia);
}

template <class Archive>
void visit(Archive& archive, FrictionForces& friction) {
  auto& [acts, stuck, touch, force, stiffness, coefficient, sliding, work, dissipated, created] = friction;
  archive(acts, stuck, touch, force, stiffness, coefficient, sliding, work, dissipated, created);
}

template <class Archive>
void visit(Archive& archive, Near& near) {
  auto& [apex, first_facet, facets, safe_distance, area, is_idle, kept, by_points, no_condition_until, pressed, earlier, pressed_most,
         tracks, element, friction] = near;
  archive(apex, first_facet, facets, safe_distance, area, is_idle, kept, by_points, no_condition_until, pressed, earlier, pressed_most,
          tracks, element, friction);
}

template <class Archive>
void visit(Archive& archive, EdgePair& pair) {
  auto& [edge, base_edge, in_face, apart, flat] = pair;
  archive(edge, base_edge, in_face, apart, flat);
}

template <class Archive>
void visit(Archive& archive, Crossing& crossing) {
  auto& [edge, base_edge, in_face, side, of_ridges, normal, level, acts, closed, node, weight, push, gap, pressed, restitution, friction] =
      crossing;
  archive(edge, base_edge, in_face, side, of_ridges, normal, level, acts, closed, node, weight, push, gap, pressed, restitution, friction);
}

template <class Archive>
void visit(Archive& archive, NearFeature& near) {
  auto& [pair, kind, id] = near;
  archive(pair, kind, id);
}

template <class Archive>
void visit(Archive& archive, ShapePoint& point) {
  auto& [pair, kind, id, part, nodes, node, weight, rub_weight, normal, place, gap, curved, area, loaded, acts, closed, rubs, stuck,
         pressed, coefficient, friction, restitution] = point;
  archive(pair, kind, id, part, nodes, node, weight, rub_weight, normal, place, gap, curved, area, loaded, acts, closed, rubs, stuck,
          pressed, coefficient, friction, restitution);
}

template <class Archive>
void visit(Archive& archive, PairRecord& record) {
  auto& [one, other, first, last, impulse, now, before] = record;
  archive(one, other, first, last, impulse, now, before);
}

template <class Archive>
void visit(Archive& archive, SidesMemory& memory) {
  auto& [work, friction_dissipated, friction_to_come, friction_deficit, impact, force, impulse, transferred, held, power_rate,
         angular_impulse, pair_records, deepest, deepest_apex, deepest_time, deepest_in, deepest_now, searches, looks, margin, way,
         way_of_body, apart_from_itself, apart_then, active, apexes_then, base_then, mean_way] = memory;
  archive(work, friction_dissipated, friction_to_come, friction_deficit, impact, force, impulse, transferred, held, power_rate,
          angular_impulse, pair_records, deepest, deepest_apex, deepest_time, deepest_in, deepest_now, searches, looks, margin, way,
          way_of_body, apart_from_itself, apart_then, active, apexes_then, base_then, mean_way);
}

/// Each kind adds what it has to what all have.
template <class Archive>
void visit(Archive& archive, Memory& memory) {
  archive(static_cast<SidesMemory&>(memory));
  archive(memory.near_shapes, memory.shape_points, memory.shape_overlap, memory.shares, memory.near, memory.near_facets, memory.slot,
          memory.feature, memory.status, memory.gap, memory.stored, memory.slip,
          memory.tangential_stored, memory.reconnections, memory.thicker, memory.damped, memory.thinned, memory.restitution,
          memory.has_trend, memory.created_by_reconnection, memory.step_factor, memory.walks, memory.lost, memory.recovered);
}

template <class Archive>
void visit(Archive& archive, EdgeMemory& memory) {
  archive(static_cast<SidesMemory&>(memory), memory.edge_pairs, memory.crossings);
}

template <class Archive>
void visit(Archive& archive, PlaneMemory& memory) {
  auto& [shape_points, force, restitution, next_force, area, friction, next_friction, stuck, slip, sliding, work, stored,
         friction_to_come, friction_deficit, tangential_stored, friction_dissipated, transferred, impact, power_rate, step_factor, deepest,
         deepest_node, deepest_time, impulse, angular_impulse] = memory;
  archive(shape_points, force, restitution, next_force, area, friction, next_friction, stuck, slip, sliding, work, stored,
          friction_to_come, friction_deficit, tangential_stored, friction_dissipated, transferred, impact, power_rate, step_factor, deepest,
          deepest_node, deepest_time, impulse, angular_impulse);
}

}  // namespace contact

namespace rigid {

template <class Archive>
void visit(Archive& archive, Turn& turn) {
  auto& [real, vector] = turn;
  archive(real, vector);
}

template <class Archive>
void visit(Archive& archive, State& state) {
  auto& [shift, turn, momentum, angular_momentum] = state;
  archive(shift, turn, momentum, angular_momentum);
}

}  // namespace rigid

namespace load {

template <class Archive>
void visit(Archive& archive, ConstrainedNode& one) {
  auto& [node, rotation, count, moves, rotation_constrained, driver, plane, normal, reaction, speed, angular_velocity, allowed,
         allowed_rotation] = one;
  archive(node, rotation, count, moves, rotation_constrained, driver, plane, normal, reaction, speed, angular_velocity, allowed,
          allowed_rotation);
}

template <class Archive>
void visit(Archive& archive, PlaneAccount& account) {
  auto& [impulse, angular_impulse, stopped, driven] = account;
  archive(impulse, angular_impulse, stopped, driven);
}

template <class Archive>
void visit(Archive& archive, Memory& memory) {
  auto& [nodes, row_of_node, account, stopped, active, impacting, speed] = memory;
  archive(nodes, row_of_node, account, stopped, active, impacting, speed);
}

template <class Archive>
void visit(Archive& archive, LoadMemory& memory) {
  auto& [force, moment, work, drag, swept, stored, dissipated, impulse, angular_impulse] = memory;
  archive(force, moment, work, drag, swept, stored, dissipated, impulse, angular_impulse);
}

}  // namespace load

namespace audit {

template <class Archive>
void visit(Archive& archive, Depth& at) {
  auto& [depth, size, open, place, region] = at;
  archive(depth, size, open, place, region);
}

template <class Archive>
void visit(Archive& archive, Overlap& overlap) {
  auto& [surface, at_start, accepted, allowed, deepest, grown, worst, time, sure, surest, sure_time] = overlap;
  archive(surface, at_start, accepted, allowed, deepest, grown, worst, time, sure, surest, sure_time);
}

template <class Archive>
void visit(Archive& archive, Memory& memory) {
  auto& [overlaps, looks] = memory;
  archive(overlaps, looks);
}

}  // namespace audit

namespace element {

template <class Archive>
void visit(Archive& archive, TileForces& forces) {
  auto& [force, moment, thickness] = forces;  // slots are numbered element by element
  archive(force, moment, thickness);
}

template <class Archive>
void visit(Archive& archive, Thinned& thinned) {
  auto& [ratio, element] = thinned;
  archive(ratio, element);
}
template <class Archive>
void visit(Archive& archive, Contrast& contrast) {
  auto& [strain, bending, density] = contrast;
  archive(strain, bending, density);
}
template <class Archive>
void visit(Archive& archive, Pressed& pressed) {
  auto& [ratio, element] = pressed;
  archive(ratio, element);
}

}  // namespace element

namespace dynamics {

template <class Archive>
void visit(Archive& archive, RelaxationMemory& memory) {
  auto& [removed, impulse, angular_impulse, residual, kinetic, most_force, most_kinetic, balanced, since, x, rotated, force, moment,
         omega] = memory;
  archive(removed, impulse, angular_impulse, residual, kinetic, most_force, most_kinetic, balanced, since, x, rotated, force, moment,
          omega);
}

template <class Archive>
void visit(Archive& archive, Kept& kept) {
  auto& [integral, value, since] = kept;
  archive(integral, value, since);
}

template <class Archive>
void visit(Archive& archive, ProbeMemory& memory) {
  auto& [last, now, largest, smallest, time_of_largest, time_of_smallest, largest_row, smallest_row, integral, first_above_zero,
         last_above_zero, samples, not_finite, of_steps, of_rows] = memory;
  archive(last, now, largest, smallest, time_of_largest, time_of_smallest, largest_row, smallest_row, integral, first_above_zero,
          last_above_zero, samples, not_finite, of_steps, of_rows);
}

template <class Archive>
void visit(Archive& archive, ConditionMemory& memory) {
  auto& [first, last, time, extreme, time_of_extreme, since, integral, mean] = memory;
  archive(first, last, time, extreme, time_of_extreme, since, integral, mean);
}

template <class Archive>
void visit(Archive& archive, Step& step) {
  auto& [dt, source, at, safety] = step;
  archive(dt, source, at, safety);
}

template <class Archive>
void visit(Archive& archive, Progress& progress) {
  auto& [started, stages, first_step, updates, ledger_is_current, corners_seen, corners_next, corner, contrast_seen, contrast_step,
         contrast_looks, audits, audited, audited_itself, smallest, largest_step] = progress;
  archive(started, stages, first_step, updates, ledger_is_current, corners_seen, corners_next, corner, contrast_seen, contrast_step,
          contrast_looks, audits, audited, audited_itself, smallest, largest_step);
}

template <class Archive>
void visit(Archive& archive, Spin& spin) {
  auto& [energy, node, time] = spin;
  archive(energy, node, time);
}

template <class Archive>
void visit(Archive& archive, Quality& quality) {
  auto& [corner, element, time, hourglass, internal, distortion, drilling, residual_bending, artificial, contrast, inverted,
         thinned, thinned_at, pressed, pressed_at, spin] = quality;
  archive(corner, element, time, hourglass, internal, distortion, drilling, residual_bending, artificial, contrast, inverted,
          thinned, thinned_at, pressed, pressed_at, spin);
}

template <class Archive>
void visit(Archive& archive, Footing& footing) {
  auto& [force, nodes] = footing;
  archive(force, nodes);
}

template <class Archive>
void visit(Archive& archive, Created& created) {
  auto& [part, energy, passed] = created;
  archive(part, energy, passed);
}

template <class Archive>
void visit(Archive& archive, Flow& flow) {
  auto& [passed, work, recent, deficit, worst, told, worst_of_scene] = flow;
  archive(passed, work, recent, deficit, worst, told, worst_of_scene);
}

template <class Archive>
void visit(Archive& archive, Ledger& ledger) {
  auto& [initial_kinetic, kinetic, initial_available, integration, external_work, initial_momentum, momentum, initial_angular_momentum,
         angular_momentum, accounts, flows, integration_kept, worst_kept, most_integration, size, largest_force, round_off] = ledger;
  archive(initial_kinetic, kinetic, initial_available, integration, external_work, initial_momentum, momentum, initial_angular_momentum,
          angular_momentum, accounts, flows, integration_kept, worst_kept, most_integration, size, largest_force, round_off);
}

template <class Archive>
void visit(Archive& archive, SourceLimit& limit) {
  auto& [step, source, at] = limit;
  archive(step, source, at);
}

template <class Archive>
void visit(Archive& archive, StepLimits& limits) {
  auto& [elements, contact, blows, ringing, energy, volume_ratio, smallest_block, smallest_element, may_grow, costly, trend] = limits;
  archive(elements, contact, blows, ringing, energy, volume_ratio, smallest_block, smallest_element, may_grow, costly, trend);
}

template <class Archive>
void visit(Archive& archive, SectionMemory& memory) {
  auto& [force, moment, impulse] = memory;
  archive(force, moment, impulse);
}

/// All of a state but what blocks remember.
template <class Archive>
void visit_rest(Archive& archive, State& state) {
  auto& [t, step, dt, x, v, omega, blocks, tiles, contacts, rigid_planes, rigid_bodies, constraints, loads, sections, relaxation, ledger,
         limits, progress, quality, footings, audit, probes, conditions] = state;
  archive(t, step, dt, x, v, omega, tiles, contacts, rigid_planes, rigid_bodies, constraints, loads, sections, relaxation, ledger, limits,
          progress, quality, footings, audit, probes, conditions);
}

namespace {

constexpr auto width = static_cast<std::size_t>(lanes);

/// Rows of a block's memory, element after element in the order of its tiles.
std::vector<double> by_element(const element::Tiling& tiling, const std::vector<double>& rows) {
  const std::size_t packs = tiling.filled.size(), count = packs == 0 ? 0 : rows.size() / (packs * width);
  std::vector<double> values;
  values.reserve(count * static_cast<std::size_t>(tiling.elements));
  for (std::size_t pack = 0; pack < packs; ++pack)
    for (int lane = 0; lane < tiling.filled[pack]; ++lane)
      for (std::size_t row = 0; row < count; ++row) values.push_back(rows[(pack * count + row) * width + static_cast<std::size_t>(lane)]);
  return values;
}

/// The same back; fillers repeat the last element of their pack.
void by_lane(const element::Tiling& tiling, const std::vector<double>& values, std::vector<double>& rows) {
  const std::size_t packs = tiling.filled.size(), count = packs == 0 ? 0 : rows.size() / (packs * width);
  if (values.size() != count * static_cast<std::size_t>(tiling.elements)) throw DamagedArchive("its elements remember something else");
  std::size_t first = 0;
  for (std::size_t pack = 0; pack < packs; ++pack) {
    const auto filled = static_cast<std::size_t>(tiling.filled[pack]);
    for (std::size_t lane = 0; lane < width; ++lane)
      for (std::size_t row = 0; row < count; ++row)
        rows[(pack * count + row) * width + lane] = values[first + std::min(lane, filled - 1) * count + row];
    first += filled * count;
  }
}

}  // namespace

std::string bytes_of(const Model& model, const State& state) {
  Writer writer;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const auto& [rows, along, work, stored, dissipated, arm, angular_impulse] = state.blocks[b];
    const element::Tiling& tiling = element::tiling(model.blocks[b]);
    writer(by_element(tiling, rows), by_element(tiling, along), work, stored, dissipated, arm, angular_impulse);
  }
  visit_rest(writer, const_cast<State&>(state));  // which names members and changes none
  return writer.bytes();
}

State state_of(const Model& model, std::string_view bytes) {
  Reader reader(bytes);
  State state;
  for (const element::AnyBlock& block : model.blocks) {
    element::Memory memory = element::initial_memory(block);
    std::vector<double> values, along;
    reader(values, along, memory.work, memory.stored, memory.dissipated, memory.arm, memory.angular_impulse);
    by_lane(element::tiling(block), values, memory.rows);
    by_lane(element::tiling(block), along, memory.along);
    state.blocks.push_back(std::move(memory));
  }
  visit_rest(reader, state);
  if (!reader.is_at_end()) throw DamagedArchive("something is behind its end");
  return state;
}

std::uint64_t fingerprint(const Model& model) {
  constexpr double digits = 1e9, aside = 0.2371;  // so that round-off of another build changes no number, even of even coordinates
  Writer writer;
  const auto rounded = [](const Vectors& places, double extent) {
    return Vectors((places * (digits / (extent > 0 ? extent : 1))).array().unaryExpr([](double x) { return std::round(x + aside); }));
  };
  const Vec3 low = model.mesh.X.rowwise().minCoeff(), high = model.mesh.X.rowwise().maxCoeff();
  const double farthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  writer(rounded(low, farthest), rounded(model.mesh.X.colwise() - low, (high - low).maxCoeff()));
  for (const element::AnyBlock& block : model.blocks)
    writer(element::name(block), element::nodes(block), element::tiling(block).node, element::tiling(block).elements);
  for (const contact::AnyContact& any : model.contacts) {
    const contact::Interface* interface = contact::interface_of(any);
    writer(contact::sides(any).name, contact::sides(any).apexes, interface != nullptr ? interface->base.facets : Table<3>());
  }
  for (const contact::RigidPlane& plane : model.rigid_planes) writer(plane.name, plane.nodes);
  return checksum(writer.bytes());
}

}  // namespace dynamics
}  // namespace nereid
