#include "geometry/height.hpp"

namespace nereid::geometry {

std::array<Vector<double>, 4> paper_gradient(const std::array<Vector<double>, 3>& base,
                                             const Vector<double>& apex, Printing printing) {
  const std::array<Vector<double>, 4> x{base[0], base[1], base[2], apex};
  const auto difference = [&x](int component, int a, int b) { return x[a][component] - x[b][component]; };
  const Vector<double> twice_area = cross(base[1] - base[0], base[2] - base[0]);
  const double area = 0.5 * norm(twice_area);
  const double volume = dot(twice_area, apex - base[0]) / 6.0;
  const bool corrected = printing == Printing::corrected;
  const double second = 1.5 * volume / (corrected ? area * area * area : area);

  std::array<Vector<double>, 4> B;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int I = 0; I < 3; ++I) {
      const int J = (I + 1) % 3, K = (I + 2) % 3;  // the paper's Table I
      const double middle = corrected ? difference(k, J, 3) : difference(k, 3, J);
      const double first = x[J][j] * difference(k, 3, K) + x[K][j] * middle + apex[j] * difference(k, K, J);
      B[I][i] = 0.5 / area * first - second * (0.5 * twice_area[j] * difference(k, K, J) +
                                               0.5 * twice_area[k] * difference(j, J, K));
    }
    B[3][i] = 0.5 / area * (x[0][j] * difference(k, 1, 2) + x[2][j] * difference(k, 0, 1) +
                            x[1][j] * difference(k, 2, 0));
  }
  return B;
}

}  // namespace nereid::geometry
