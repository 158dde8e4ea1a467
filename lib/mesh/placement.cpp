#include "mesh/placement.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "base/check.hpp"

namespace nereid::mesh {

Mesh rotated_about(Mesh mesh, const Vec3& axis, double angle, const Vec3& about) {
  check(axis.norm() > 0, "an axis to turn about needs a direction");
  Mat3 R = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  for (int i = 0; i < 9; ++i) {  // so that a face turned by a quarter lies on its plane exactly
    double& entry = R.data()[i];
    for (const double whole : {-1.0, 0.0, 1.0})
      if (std::abs(entry - whole) < 1e-15) entry = whole;
  }
  mesh.X = (R * (mesh.X.colwise() - about)).colwise() + about;
  return mesh;
}

Mesh moved(Mesh mesh, const Vec3& by) {
  mesh.X.colwise() += by;
  return mesh;
}

}  // namespace nereid::mesh
