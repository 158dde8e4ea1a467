#include "contact/data/shape.hpp"

#include <algorithm>

namespace nereid::contact {

using geometry::PlacedRound;

std::vector<PlacedRound> placed_all(const std::vector<mesh::RoundBody>& rounds, const Vectors& x) {
  std::vector<PlacedRound> all;
  for (const mesh::RoundBody& one : rounds) all.push_back(mesh::placed(one, x));
  return all;
}

Index count_acting(const std::vector<ShapePoint>& points) { return static_cast<Index>(points.size()); }

Touch touch_of(const ShapePoint& point) {
  Touch touch;
  touch.normal = point.normal, touch.nodes = point.nodes;
  std::copy(point.node.begin(), point.node.end(), touch.node.begin());
  for (std::size_t j = 0; j < point.rub_weight.size(); ++j) touch.weight[j] = -point.rub_weight[j], touch.lift[j].setZero();
  return touch;
}

Vec3 relative(const ShapePoint& point, const Vectors& v) {
  Vec3 sum = Vec3::Zero();
  for (int j = 0; j < point.nodes; ++j) {
    const auto at = static_cast<std::size_t>(j);
    sum += point.weight[at] * v.col(point.node[at]);
  }
  return sum;
}

}  // namespace nereid::contact
