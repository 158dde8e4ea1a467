#pragma once
// What the elements of a block show: names of quantities and places, strain of a deformation, layers of a plate at a place.

#include <array>
#include <string>
#include <string_view>

#include "base/tensor.hpp"
#include "base/types.hpp"

namespace nereid::element {

/// Where through the thickness of a plate a quantity is shown. Top is the side to which the normal of the triangle points; the membrane
/// is the mean through the thickness. Solids have no place.
enum class Place { none, top, middle, bottom, membrane };

inline constexpr std::array<std::string_view, 4> words_of_places{"top", "middle", "bottom", "membrane"};
inline constexpr std::array places_of_plates{Place::top, Place::middle, Place::bottom, Place::membrane};

/// One quantity of elements, at a place if these are plates.
struct Shown {
  std::string_view quantity;  ///< stress, strain, von_mises, pressure, thickness or an internal variable of the law
  Place place = Place::none;
};

/// The place of that word; none for an empty one. Throws InternalError for any other word.
Place place_of(std::string_view word);

/// "stress" of solids, "stress_top" of plates.
std::string name(const Shown&);

/// Whether frames have a quantity unless the case asks for all: stress, von Mises stress, internal variables and thickness, of plates
/// at their surfaces and as the mean; the pressure of solids.
bool in_usual_frames(const Shown&);

/// Logarithmic strain of Hencky in the axes of the present shape, of a deformation gradient F = dx/dX with any rotation in it.
///
///     1/2 ln(F F^T)
///
/// returns  [-] tensor components; zero of a rotation
Symmetric<double> hencky_strain(const Mat3& F);
Plane<double> hencky_strain(const Mat2& F);

}  // namespace nereid::element
