#include "element/shown.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "base/check.hpp"

namespace nereid::element {

Place place_of(std::string_view word) {
  if (word.empty()) return Place::none;
  const auto at = std::find(words_of_places.begin(), words_of_places.end(), word);
  check(at != words_of_places.end(), "plates have no such place");
  return places_of_plates[static_cast<std::size_t>(at - words_of_places.begin())];
}

std::string name(const Shown& shown) {
  if (shown.place == Place::none) return std::string(shown.quantity);
  const auto at = std::find(places_of_plates.begin(), places_of_plates.end(), shown.place) - places_of_plates.begin();
  return std::string(shown.quantity) + "_" + std::string(words_of_places[static_cast<std::size_t>(at)]);
}

bool in_usual_frames(const Shown& shown) {
  return shown.quantity != "strain" && shown.place != Place::middle && !(shown.quantity == "pressure" && shown.place != Place::none);
}

namespace {

/// 1/2 ln(F F^T); an element without volume has a strain that is large and still a number.
template <class Matrix>
Matrix half_logarithm(const Matrix& F) {
  const Eigen::SelfAdjointEigenSolver<Matrix> axes(F * F.transpose());
  const auto strains = 0.5 * axes.eigenvalues().array().max(1e-300).log();
  return axes.eigenvectors() * strains.matrix().asDiagonal() * axes.eigenvectors().transpose();
}

}  // namespace

Symmetric<double> hencky_strain(const Mat3& F) {
  const Mat3 e = half_logarithm(F);
  return {e(0, 0), e(1, 1), e(2, 2), e(0, 1), e(1, 2), e(0, 2)};
}

Plane<double> hencky_strain(const Mat2& F) {
  const Mat2 e = half_logarithm(F);
  return {e(0, 0), e(1, 1), e(0, 1)};
}

}  // namespace nereid::element
