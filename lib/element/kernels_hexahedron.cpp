#include "element/kernels_body.hpp"

namespace nereid::element {

constinit auto kernels_of_hexahedron = kernels_of_each_law<Hexahedron>(static_cast<AnyLaw*>(nullptr));

}  // namespace nereid::element
