#include "element/width.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace nereid::element {

namespace {

/// B B^T of a hexahedron. [1/m2]
Mat3 gradient_tensor(const std::array<Vector<double>, 8>& x) {
  Modes<double> m = sums_by_mode(x);
  m.xi = 0.125 * m.xi, m.eta = 0.125 * m.eta, m.zeta = 0.125 * m.zeta;
  for (auto& h : m.hourglass) h = 0.125 * h;
  const Gradient<double> g = volume_gradient(m);
  const Symmetric<double> G = gradient_products(g);
  Mat3 tensor;
  tensor << G.xx, G.xy, G.xz, G.xy, G.yy, G.yz, G.xz, G.yz, G.zz;
  return tensor / (g.volume * g.volume);
}

/// B B^T of a triangle, in space; its normal is the direction of the eigenvalue zero. [1/m2]
Mat3 gradient_tensor(const std::array<Vec3, 3>& x) {
  const Vec3 twice_area = (x[1] - x[0]).cross(x[2] - x[0]);
  Mat3 tensor = Mat3::Zero();
  for (int a = 0; a < 3; ++a) {
    const Vec3 gradient = twice_area.cross(x[(a + 2) % 3] - x[(a + 1) % 3]) / twice_area.squaredNorm();
    tensor += gradient * gradient.transpose();
  }
  return tensor;
}

}  // namespace

Narrowest narrowest(const AnyBlock& any, const Vectors& x) {
  const Connectivity& nodes = element::nodes(any);
  const bool plate = is_plate(any);
  const material::Lame lame = std::visit([](const auto& block) { return material::lame(block.law); }, any);
  const double lambda = plate ? 2 * lame.lambda * lame.mu / (lame.lambda + 2 * lame.mu) : lame.lambda;  // of plane stress
  const auto tensor = [&](Index element) {
    if (plate) {
      std::array<Vec3, 3> corners;
      for (int a = 0; a < 3; ++a) corners[a] = x.col(nodes(a, element));
      return gradient_tensor(corners);
    }
    std::array<Vector<double>, 8> corners;
    for (int a = 0; a < 8; ++a) {
      const Index node = nodes(a, element);
      corners[a] = {x(0, node), x(1, node), x(2, node)};
    }
    return gradient_tensor(corners);
  };
  const auto squared = [&](const Vec3& g) { return lambda * g.sum() + 2 * lame.mu * g(2); };

  Narrowest found;
  double most = -1;
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  for (Index element = 0; element < nodes.cols(); ++element) {
    solver.computeDirect(tensor(element), Eigen::EigenvaluesOnly);
    const double here = squared(solver.eigenvalues());
    if (here > most) most = here, found.element = element;
  }
  if (found.element < 0) return found;

  solver.compute(tensor(found.element));
  const Vec3 g = solver.eigenvalues();  // ascending
  const double scale = plate ? 1.5 : 0.5;
  for (int i = 0; i < 3; ++i) found.width(i) = plate && i == 2 ? 0.0 : std::sqrt(scale / g(2 - i));
  found.direction = solver.eigenvectors().col(2);
  found.gain = std::sqrt(squared(g) / squared({g(0), g(1), g(1)}));
  for (Index a = 0; a < nodes.rows(); ++a) found.centre += x.col(nodes(a, found.element)) / static_cast<double>(nodes.rows());
  return found;
}

}  // namespace nereid::element
