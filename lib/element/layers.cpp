#include <cmath>

#include "base/check.hpp"
#include "element/plate.hpp"

namespace nereid::element {

Layers gauss_layers(int count) {
  check(count >= 1 && count <= Plate::most_layers, "a plate has 1 to 9 layers");
  Layers layers;
  layers.count = count;
  for (int i = 0; i < count; ++i) {
    // Newton's method on the Legendre polynomial from the usual first guess
    double z = std::cos(3.14159265358979323846 * (count - i - 0.25) / (count + 0.5));
    double slope = 0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double p = 1, before = 0;
      for (int n = 1; n <= count; ++n) {
        const double older = before;
        before = p;
        p = ((2 * n - 1) * z * before - (n - 1) * older) / n;
      }
      slope = count * (z * p - before) / (z * z - 1.0);
      const double change = p / slope;
      z -= change;
      if (std::abs(change) < 1e-16) break;
    }
    layers.z[i] = 0.5 * z;
    layers.weight[i] = 1.0 / ((1.0 - z * z) * slope * slope);
  }
  if (count % 2 == 1) layers.z[count / 2] = 0;
  return layers;
}

}  // namespace nereid::element
