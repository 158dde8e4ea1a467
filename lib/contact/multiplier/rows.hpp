#pragma once
// What multipliers iterate over: rows of pushes on movers.
//
// A mover is what has a velocity of its own: a node, the rotation of a plate node, the motion of a rigid body, its turn. With M what an
// impulse on it does to its velocity, the push p of a row on each of its movers, and the impulses J of all rows,
//
//     velocity = velocity without impulses + M sum of J p,        rate of a row = offset + sum of p . velocity
//
// A rigid body is one mover for its motion and one for its turn, whose velocities are what impulses have changed; the rest of the rate is
// the offset. Rows come in ranges of contactors. Each range has copies of its movers, which only it adds to, and the copies of a mover are
// summed in order: the same bits on any number of threads.

#include <vector>

#include "base/tensor.hpp"
#include "base/types.hpp"

namespace nereid::contact {

/// Three components and a zero, as registers have them.
using Vec4 = Eigen::Vector4d;
inline Vec4 padded(const Vec3& v) { return {v.x(), v.y(), v.z(), 0}; }

/// Contactors of a range.
constexpr Index contactors_of_a_range = 128;

/// Entries of Rows, one after the other.
struct Row {
  Index first = 0, count = 0;
  Index bodies = 0;   ///< rigid bodies: the last entries are the motion and the turn of each
  double offset = 0;  ///< [m/s] of its rate that is not of the movers
};

enum class MoverKind : std::uint8_t { node, rotation, motion, turn };

/// What has a velocity of its own: that of its slots, [m/s] or [rad/s], with the impulses so far; of rigid bodies the change since
/// Row::offset was set.
struct Mover {
  MoverKind kind;
  Index of;                    ///< node, column of the angular velocity, or rigid body
  Index slot = -1;             ///< its first copy; -1: none
  Index first = 0, count = 0;  ///< of all of them in Rows::copies, where it has several
  double mobility;             ///< [1/kg] or [1/(kg m2)]; 1 of rigid bodies
  const Mat3* through;         ///< projector of constraints, or what impulses do to a rigid body; null: nothing
  Vec3 given = Vec3::Zero();   ///< [N s] or [N m s] of rigid bodies, since then
};

struct Rows {
  std::vector<Index> slot;  ///< [entries] copies of movers
  std::vector<Vec4> push;   ///< [entries]
  std::vector<Vec4> velocity, given;  ///< [slots] of the mover; impulses since it last moved
  std::vector<Index> mover_of_slot;
  std::vector<Mover> movers;
  std::vector<Index> copies;          ///< slots of movers that have several, in order
  std::vector<double> mobility;       ///< [1/kg] [slots] of movers with one slot that go wherever they are pushed; zero of all others
  std::vector<Index> others;          ///< movers with several slots, or that something holds or carries
  Index bodies = 0;                   ///< movers of rigid bodies come first: two of each
  /// Where something has its slot: right if the stamp is that of the range at hand, as the mover is if the stamp is of this step.
  struct Place {
    std::int32_t stamp = 0;
    Index slot = 0, mover = 0;
  };
  std::vector<Place> of_node, of_rotation, of_body;
  std::int32_t stamp = 0, first_stamp = 0;  ///< of the last range, and of the first one of the step
};

/// Rate of a row. [m/s]
NEREID_HOT double rate(const Row& row, const Rows& rows) {
  Vec4 sum = Vec4::Zero();
  const Index* slot = &rows.slot[static_cast<std::size_t>(row.first)];
  const Vec4* push = &rows.push[static_cast<std::size_t>(row.first)];
  for (Index j = 0; j < row.count; ++j) sum += push[j].cwiseProduct(rows.velocity[static_cast<std::size_t>(slot[j])]);
  return row.offset + sum.sum();
}

/// Adds an impulse to what the movers of a row will be given. [N s]
NEREID_HOT void give(const Row& row, double impulse, Rows& rows) {
  const Index* slot = &rows.slot[static_cast<std::size_t>(row.first)];
  const Vec4* push = &rows.push[static_cast<std::size_t>(row.first)];
  for (Index j = 0; j < row.count; ++j) rows.given[static_cast<std::size_t>(slot[j])] += impulse * push[j];
}

/// Moves all movers by what they were given.
void move(Rows&);

/// The velocity of a mover; zero if no row acts on it. [m/s] or [rad/s]
Vec3 velocity_of(const Mover&, const Rows&);
/// Gives it one.
void place(const Mover&, const Vec4& velocity, Rows&);

/// q of a row and its rigid body number k:  q^2 = p . M p  of its motion and its turn. [1/sqrt(kg)] It is zero along what planes hold, but
/// for round-off of either sign.
double size_on_body(const Row&, Index k, const Rows&);
/// Which body that is.
Index body_of(const Row&, Index k, const Rows&);

}  // namespace nereid::contact
