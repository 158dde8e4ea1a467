#include "rigid/hold.hpp"

#include <Eigen/Geometry>

#include "base/dense.hpp"

namespace nereid::rigid {

namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;
constexpr double same = 1e-5;  // [-] of unit vectors, and of the size of the body: normals are typed with some digits

}  // namespace

std::optional<Hold> hold_of(std::span<const HeldNode> held, double size) {
  Hold hold;
  if (held.empty()) return hold;
  Mat6 all = Mat6::Zero();
  Mat3 normals = Mat3::Zero();
  for (const HeldNode& one : held) {
    Eigen::Matrix<double, 6, 1> row;
    row << one.normal, one.arm.cross(one.normal) / size;
    all += row * row.transpose();
    normals += one.normal * one.normal.transpose();
  }
  const Eigenpairs shifts = eigenpairs(normals);
  hold.shift.setZero();
  for (int k = 0; k < 3; ++k)
    if (shifts.values(k) < same * same * shifts.values(2)) hold.shift += shifts.vectors.col(k) * shifts.vectors.col(k).transpose();
  for (int i = 0; i < 9; ++i) {  // exact along axes
    double& entry = hold.shift.data()[i];
    if (std::abs(entry) < 1e-14) entry = 0;
    if (std::abs(entry - 1) < 1e-14) entry = 1;
  }
  const Eigenpairs motions = eigenpairs(all);
  Mat3 turning = Mat3::Zero();
  for (int k = 0; k < 6; ++k) {
    if (!(motions.values(k) < same * same * motions.values(5))) continue;
    const Vec3 turn = motions.vectors.col(k).tail<3>();
    turning += turn * turn.transpose();
  }
  const Eigenpairs turns = eigenpairs(turning);
  hold.turns = static_cast<int>((turns.values.array() > same * same).count());
  if (hold.turns == 0) return hold;
  hold.axis = turns.vectors.col(2);
  if (hold.axis(0) + hold.axis(1) + hold.axis(2) < 0) hold.axis = -hold.axis;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(hold.axis(i)) < 1e-12) hold.axis(i) = 0;
    if (std::abs(hold.axis(i) - 1) < 1e-12) hold.axis(i) = 1;
  }
  for (const HeldNode& one : held) {
    const Vec3 along = hold.axis.cross(one.arm), inward = hold.axis.cross(along);
    const bool stays = hold.turns == 1 ? std::abs(one.normal.dot(along)) < same * size && std::abs(one.normal.dot(inward)) < same * size
                                       : hold.turns == 3 && one.arm.norm() < same * size;
    if (!stays) return std::nullopt;
  }
  return hold;
}

}  // namespace nereid::rigid
