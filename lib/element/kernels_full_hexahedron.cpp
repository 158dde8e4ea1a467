#include "element/kernels_body.hpp"

namespace nereid::element {

template struct Kernels<FullHexahedron, material::Elastic>;
template struct Kernels<FullHexahedron, material::J2Bilinear>;
template struct Kernels<FullHexahedron, material::J2Mixed>;

}  // namespace nereid::element
