#include "element/kernels_body.hpp"

namespace nereid::element {

template struct Kernels<Hexahedron, material::Elastic>;
template struct Kernels<Hexahedron, material::J2Bilinear>;
template struct Kernels<Hexahedron, material::J2Mixed>;

}  // namespace nereid::element
