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
Mat3 gradient_tensor(const std::array<Vector<double>, 3>& corners) {
  std::array<Vec3, 3> x;
  for (int a = 0; a < 3; ++a) x[a] = Vec3(corners[a].x, corners[a].y, corners[a].z);
  const Vec3 twice_area = (x[1] - x[0]).cross(x[2] - x[0]);
  Mat3 tensor = Mat3::Zero();
  for (int a = 0; a < 3; ++a) {
    const Vec3 gradient = twice_area.cross(x[(a + 2) % 3] - x[(a + 1) % 3]) / twice_area.squaredNorm();
    tensor += gradient * gradient.transpose();
  }
  return tensor;
}

template <class Kind, class Law>
Mat3 gradient_tensor(const Block<Kind, Law>& block, const Vectors& x, Index element) {
  std::array<Vector<double>, Kind::nodes> corners;
  for (int a = 0; a < Kind::nodes; ++a) {
    const Index node = block.nodes(a, element);
    corners[a] = {x(0, node), x(1, node), x(2, node)};
  }
  return gradient_tensor(corners);
}

/// The squared frequency of an element but for a factor, from the ascending eigenvalues g of B B^T.
template <class Kind, class Law>
double squared_frequency(const Block<Kind, Law>& block, const Vec3& g) {
  const material::Lame lame = material::lame(block.law);
  const double lambda = Kind::dimensions == 2 ? 2 * lame.lambda * lame.mu / (lame.lambda + 2 * lame.mu) : lame.lambda;  // of plane stress
  return lambda * g.sum() + 2 * lame.mu * g(2);
}

/// Of all elements.
template <class Kind, class Law>
Scalars squared_frequencies(const Block<Kind, Law>& block, const Vectors& x) {
  Scalars squared(block.nodes.cols());
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  for (Index element = 0; element < block.nodes.cols(); ++element) {
    solver.computeDirect(gradient_tensor(block, x, element), Eigen::EigenvaluesOnly);
    squared(element) = squared_frequency(block, solver.eigenvalues());
  }
  return squared;
}

template <class Kind, class Law>
Narrowest narrowest(const Block<Kind, Law>& block, const Vectors& x) {
  const Connectivity& nodes = block.nodes;
  constexpr bool plate = Kind::dimensions == 2;
  const auto squared = [&](const Vec3& g) { return squared_frequency(block, g); };

  Narrowest found;
  double most = -1;
  const Scalars all = squared_frequencies(block, x);
  for (Index element = 0; element < nodes.cols(); ++element)
    if (all(element) > most) most = all(element), found.element = element;
  if (found.element < 0) return found;
  found.frequency = std::sqrt(most / block.law.density);

  Eigen::SelfAdjointEigenSolver<Mat3> solver(gradient_tensor(block, x, found.element));
  const Vec3 g = solver.eigenvalues();  // ascending
  const double scale = plate ? 1.5 : 0.5;
  for (int i = 0; i < 3; ++i) found.width(i) = plate && i == 2 ? 0.0 : std::sqrt(scale / g(2 - i));
  found.direction = solver.eigenvectors().col(2);
  found.gain = std::sqrt(squared(g) / squared({g(0), g(1), g(1)}));
  for (Index a = 0; a < nodes.rows(); ++a) found.centre += x.col(nodes(a, found.element)) / static_cast<double>(nodes.rows());
  return found;
}

}  // namespace

Narrowest narrowest(const AnyBlock& any, const Vectors& x) {
  return std::visit([&x](const auto& block) { return narrowest(block, x); }, any);
}

Scalars relative_steps(const AnyBlock& any, const Vectors& x) {
  const Scalars squared = std::visit([&x](const auto& block) { return squared_frequencies(block, x); }, any);
  return (squared.maxCoeff() / squared.array()).sqrt();
}

}  // namespace nereid::element
