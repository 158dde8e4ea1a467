#include "element/kernels_body.hpp"

namespace nereid::element {

template struct Kernels<Hexahedron, material::Elastic>;
template struct Kernels<Hexahedron, material::J2Bilinear>;

}  // namespace nereid::element
