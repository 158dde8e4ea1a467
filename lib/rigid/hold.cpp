#include "rigid/hold.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

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
  const Eigen::SelfAdjointEigenSolver<Mat3> shifts(normals);
  hold.shift.setZero();
  for (int k = 0; k < 3; ++k)
    if (shifts.eigenvalues()(k) < same * same * shifts.eigenvalues()(2))
      hold.shift += shifts.eigenvectors().col(k) * shifts.eigenvectors().col(k).transpose();
  for (int i = 0; i < 9; ++i) {  // exact along axes
    double& entry = hold.shift.data()[i];
    if (std::abs(entry) < 1e-14) entry = 0;
    if (std::abs(entry - 1) < 1e-14) entry = 1;
  }
  const Eigen::SelfAdjointEigenSolver<Mat6> motions(all);
  Mat3 turning = Mat3::Zero();
  for (int k = 0; k < 6; ++k) {
    if (!(motions.eigenvalues()(k) < same * same * motions.eigenvalues()(5))) continue;
    const Vec3 turn = motions.eigenvectors().col(k).tail<3>();
    turning += turn * turn.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> turns(turning);
  hold.turns = static_cast<int>((turns.eigenvalues().array() > same * same).count());
  if (hold.turns == 0) return hold;
  hold.axis = turns.eigenvectors().col(2);
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
