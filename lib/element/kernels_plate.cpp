#include "element/kernels_body.hpp"

namespace nereid::element {

template struct Kernels<Plate, material::Elastic>;
template struct Kernels<Plate, material::J2Bilinear>;
template struct Kernels<Plate, material::J2Mixed>;

}  // namespace nereid::element
