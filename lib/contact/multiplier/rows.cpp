#include "contact/multiplier/rows.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "contact/multiplier/condition.hpp"
#include "contact/multiplier/rigid_nodes.hpp"

namespace nereid::contact {

namespace {

constexpr Index movers_of_a_thread = 512, slots_of_a_thread = 2048;  // fewer than twice as many are moved by one

/// Makes the rows of one step.
class Maker {
 public:
  Maker(const Motion& m, Multipliers& all) : m_(m), all_(all), rows_(all.rows) {
    constexpr std::size_t most_of_bodies = 4;                     // entries: motion and turn of two
    constexpr std::size_t entries_of_friction = 2 * (2 * 5 + 4);  // both rows: nodes with rotations, rigid bodies
    const std::size_t most = all.members.size() + most_of_bodies * all.conditions.size() + entries_of_friction * all.frictions.size();
    if (rows_.slot.size() < most) rows_.slot.resize(most), rows_.push.resize(most);
    rows_.velocity.clear(), rows_.mover_of_slot.clear(), rows_.movers.clear();
    rows_.bodies = m.rigid ? static_cast<Index>(m.rigid->bodies.size()) : 0;
    rows_.of_node.resize(static_cast<std::size_t>(all.velocity.cols()));
    rows_.of_rotation.resize(static_cast<std::size_t>(all.spin.cols()));
    rows_.of_body.resize(static_cast<std::size_t>(2 * rows_.bodies));
    if (rows_.stamp > std::numeric_limits<std::int32_t>::max() / 2)
      for (auto* list : {&rows_.of_node, &rows_.of_rotation, &rows_.of_body})
        std::fill(list->begin(), list->end(), Rows::Place{}), rows_.stamp = 0;
    rows_.first_stamp = rows_.stamp + 1;
    for (Index b = 0; b < rows_.bodies; ++b) {
      const MovingBody& body = m.rigid->bodies[static_cast<std::size_t>(b)];
      rows_.movers.push_back({.kind = MoverKind::motion, .of = b, .mobility = 1, .through = &body.shift});
      rows_.movers.push_back({.kind = MoverKind::turn, .of = b, .mobility = 1, .through = &body.turn});
      for (std::size_t k = 0; k < 2; ++k)
        rows_.of_body[2 * static_cast<std::size_t>(b) + k] = {rows_.first_stamp, -1, 2 * b + static_cast<Index>(k)};
    }
    ++rows_.stamp;  // of no range, so that bodies have no slots
  }

  void begin_range() { ++rows_.stamp; }

  /// A row of pushes on nodes: push(place) with node(place), for so many places.
  template <class Node, class Push>
  Row row(Index places, Node&& node, Push&& push) {
    begin();
    for (Index j = 0; j < places; ++j) add(node(j), push(j));
    return end();
  }

  /// Both rows of a friction, along directions in its plane.
  void rows(FrictionCondition& friction) {
    for (std::size_t k = 0; k < 2; ++k) {
      const FrictionShares shares = share_friction(friction.touch, friction.along[k]);
      begin();
      for (int i = 0; i < shares.count; ++i) {
        add(shares.node[i], shares.force[i]);
        if (shares.turns[i]) add_entry(slot_of_rotation(m_.rotation_of_node[shares.node[i]]), shares.moment[i]);
      }
      friction.row[k] = end();
    }
  }

  /// Lists the copies of all movers that have several.
  void finish() {
    for (std::size_t slot = 0; slot < rows_.mover_of_slot.size(); ++slot) {
      Mover& mover = rows_.movers[static_cast<std::size_t>(rows_.mover_of_slot[slot])];
      if (mover.count++ == 0) mover.slot = static_cast<Index>(slot);
    }
    Index first = 0;
    for (Mover& one : rows_.movers)
      if (one.count > 1) one.first = first, first += one.count;
    rows_.copies.assign(static_cast<std::size_t>(first), -1);
    for (std::size_t slot = rows_.mover_of_slot.size(); first > 0 && slot-- > 0;) {
      const Mover& mover = rows_.movers[static_cast<std::size_t>(rows_.mover_of_slot[slot])];
      if (mover.count < 2) continue;
      auto at = static_cast<std::size_t>(mover.first + mover.count - 1);
      while (rows_.copies[at] >= 0) --at;
      rows_.copies[at] = static_cast<Index>(slot);
    }
    rows_.given.assign(rows_.velocity.size(), Vec4::Zero());
    rows_.mobility.assign(rows_.velocity.size(), 0), rows_.others.clear();
    for (std::size_t i = 0; i < rows_.movers.size(); ++i) {
      const Mover& mover = rows_.movers[i];
      if (mover.count == 1 && mover.through == nullptr) rows_.mobility[static_cast<std::size_t>(mover.slot)] = mover.mobility;
      else if (mover.slot >= 0) rows_.others.push_back(static_cast<Index>(i));
    }
  }

 private:
  struct OnBody {
    Index body;
    Vec3 force, moment;
  };

  const Motion& m_;
  Multipliers& all_;
  Rows& rows_;
  Index entries_ = 0;
  Row row_;
  std::array<OnBody, 2> on_;
  Index bodies_ = 0;

  void begin() {
    row_ = {.first = entries_};
    bodies_ = 0;
  }

  Row end() {
    for (Index k = 0; k < bodies_; ++k) {
      const OnBody& one = on_[static_cast<std::size_t>(k)];
      add_entry(slot_of_body(2 * one.body), one.force), add_entry(slot_of_body(2 * one.body + 1), one.moment);
    }
    row_.bodies = bodies_;
    row_.count = entries_ - row_.first;
    return row_;
  }

  void add(Index node, const Vec3& push) {
    const Index body = m_.rigid ? m_.rigid->of_node[static_cast<std::size_t>(node)] : -1;
    if (body < 0) return add_entry(slot_of_node(node), push);
    row_.offset += push.dot(all_.velocity.col(node));
    Index k = 0;
    while (k < bodies_ && on_[static_cast<std::size_t>(k)].body != body) ++k;
    OnBody& on = on_[static_cast<std::size_t>(k)];  // contact has two sides, so no more than two of them
    if (k == bodies_) on = {body, Vec3::Zero(), Vec3::Zero()}, ++bodies_;
    on.force += push;
    on.moment += (m_.x.col(node) - m_.rigid->bodies[static_cast<std::size_t>(body)].centre).cross(push);
  }

  void add_entry(Index slot, const Vec3& push) {
    const auto at = static_cast<std::size_t>(entries_++);
    rows_.slot[at] = slot, rows_.push[at] = padded(push);
  }

  Index slot_of_node(Index node) {
    Rows::Place& place = rows_.of_node[static_cast<std::size_t>(node)];
    if (place.stamp == rows_.stamp) return place.slot;
    if (place.stamp < rows_.first_stamp)
      place.mover = new_mover(MoverKind::node, node, all_.mobility(node), m_.allowed[static_cast<std::size_t>(node)]);
    return new_slot(place, all_.velocity.col(node));
  }
  Index slot_of_rotation(Index column) {
    Rows::Place& place = rows_.of_rotation[static_cast<std::size_t>(column)];
    if (place.stamp == rows_.stamp) return place.slot;
    const Mat3* through = m_.allowed_rotation[static_cast<std::size_t>(column)];
    if (place.stamp < rows_.first_stamp) place.mover = new_mover(MoverKind::rotation, column, 1 / m_.inertia(column), through);
    return new_slot(place, all_.spin.col(column));
  }
  Index slot_of_body(Index mover) {
    Rows::Place& place = rows_.of_body[static_cast<std::size_t>(mover)];
    return place.stamp == rows_.stamp ? place.slot : new_slot(place, Vec3::Zero());
  }
  Index new_mover(MoverKind kind, Index of, double mobility, const Mat3* through) {
    rows_.movers.push_back({.kind = kind, .of = of, .mobility = mobility, .through = through});
    return static_cast<Index>(rows_.movers.size()) - 1;
  }
  Index new_slot(Rows::Place& place, const Vec3& velocity) {
    place.stamp = rows_.stamp, place.slot = static_cast<Index>(rows_.velocity.size());
    rows_.velocity.push_back(padded(velocity));
    rows_.mover_of_slot.push_back(place.mover);
    return place.slot;
  }
};

bool is_of_body(const Mover& mover) { return mover.kind == MoverKind::motion || mover.kind == MoverKind::turn; }

}  // namespace

Vec3 velocity_of(const Mover& mover, const Rows& rows) {
  return mover.slot < 0 ? Vec3::Zero() : Vec3(rows.velocity[static_cast<std::size_t>(mover.slot)].head<3>());
}

void place(const Mover& mover, const Vec4& velocity, Rows& rows) {
  if (mover.count == 1) rows.velocity[static_cast<std::size_t>(mover.slot)] = velocity;
  for (Index k = mover.first; mover.count > 1 && k < mover.first + mover.count; ++k)
    rows.velocity[static_cast<std::size_t>(rows.copies[static_cast<std::size_t>(k)])] = velocity;
}

void move(Rows& rows) {
  parallel_for(static_cast<Index>(rows.others.size()), movers_of_a_thread, [&](Index i) {
    Mover& mover = rows.movers[static_cast<std::size_t>(rows.others[static_cast<std::size_t>(i)])];
    Vec4& given = rows.given[static_cast<std::size_t>(mover.slot)];
    Vec4 sum = given;
    given.setZero();
    for (Index k = mover.first + 1; k < mover.first + mover.count; ++k) {
      Vec4& other = rows.given[static_cast<std::size_t>(rows.copies[static_cast<std::size_t>(k)])];
      sum += other;
      other.setZero();
    }
    Vec4& velocity = rows.velocity[static_cast<std::size_t>(mover.slot)];
    if (mover.through) {
      if (is_of_body(mover)) mover.given += sum.head<3>();
      sum = padded(*mover.through * sum.head<3>());
    }
    velocity += mover.mobility * sum;
    if (mover.count > 1) place(mover, velocity, rows);
  });
  parallel_for(static_cast<Index>(rows.velocity.size()), slots_of_a_thread, [&](Index i) {
    const auto slot = static_cast<std::size_t>(i);
    rows.velocity[slot] += rows.mobility[slot] * rows.given[slot];
    rows.given[slot].setZero();
  });
}

double size_on_body(const Row& row, Index k, const Rows& rows) {
  double squared = 0;
  for (Index entry = row.first + row.count - 2 * (row.bodies - k), end = entry + 2; entry < end; ++entry) {
    const auto at = static_cast<std::size_t>(entry);
    const Mover& mover = rows.movers[static_cast<std::size_t>(rows.mover_of_slot[static_cast<std::size_t>(rows.slot[at])])];
    const Vec3 push = rows.push[at].head<3>();
    squared += push.dot(*mover.through * push);
  }
  return std::sqrt(std::max(0.0, squared));
}

Index body_of(const Row& row, Index k, const Rows& rows) {
  const auto entry = static_cast<std::size_t>(row.first + row.count - 2 * (row.bodies - k));
  return rows.movers[static_cast<std::size_t>(rows.mover_of_slot[static_cast<std::size_t>(rows.slot[entry])])].of;
}

void make_rows(const Motion& m, Multipliers& all) {
  Maker maker(m, all);
  for (std::size_t k = 0; k < all.contactors.size(); ++k) {
    if (k % contactors_of_a_range == 0) maker.begin_range();
    const Contactor& one = all.contactors[k];
    for (Index i = one.first; i < one.last; ++i) {
      Condition& c = all.conditions[static_cast<std::size_t>(i)];
      const std::span<const Member> members = members_of(c, all);
      c.row = maker.row(
          c.nodes, [&](Index j) { return members[static_cast<std::size_t>(j)].node; },
          [&](Index j) -> const Vec3& { return members[static_cast<std::size_t>(j)].push; });
    }
    if (one.friction >= 0) maker.rows(all.frictions[static_cast<std::size_t>(one.friction)]);
  }
  maker.finish();
}

double find_velocities(const Motion& m, Multipliers& all) {
  Rows& rows = all.rows;
  for (const Mover& mover : rows.movers) {
    if (mover.kind == MoverKind::node) all.velocity.col(mover.of) = velocity_of(mover, rows);
    if (mover.kind == MoverKind::rotation) all.spin.col(mover.of) = velocity_of(mover, rows);
  }
  if (!m.rigid) return 0;
  const auto each_on_bodies = [&](auto&& visit) {  // visit(row, its rate by the velocities of all nodes)
    for (Condition& c : all.conditions)
      if (c.row.bodies > 0) visit(c.row, [&] { return relative(c, all, all.velocity); });
    for (FrictionCondition& f : all.frictions)
      for (std::size_t k = 0; k < 2; ++k)
        if (f.row[k].bodies > 0)
          visit(f.row[k], [&] { return f.along[k].dot(slip_rate(f.touch, all.velocity, all.spin, m.rotation_of_node)); });
  };
  each_on_bodies([&](Row& row, auto&&) { row.offset = rate(row, rows); });
  for (Index b = 0; b < rows.bodies; ++b) {
    Mover &motion = rows.movers[static_cast<std::size_t>(2 * b)], &turn = rows.movers[static_cast<std::size_t>(2 * b + 1)];
    if (motion.given.isZero(0) && turn.given.isZero(0)) continue;
    push(m.rigid->bodies[static_cast<std::size_t>(b)], motion.given, turn.given, m, all.velocity);
    for (Mover* one : {&motion, &turn}) one->given.setZero(), place(*one, Vec4::Zero(), rows);
  }
  double most = 0;
  each_on_bodies([&](Row& row, auto&& found) {
    const double by_movers = row.offset, is = found();
    row.offset = 0;
    row.offset = is - rate(row, rows);
    most = std::max(most, std::abs(is - by_movers));
  });
  return most;
}

}  // namespace nereid::contact
