#include "element/kernels_body.hpp"

namespace nereid::element {

template struct Kernels<Plate, material::Elastic>;
template struct Kernels<Plate, material::J2Bilinear>;

}  // namespace nereid::element
