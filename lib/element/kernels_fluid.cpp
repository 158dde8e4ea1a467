#include "element/kernels_body.hpp"

namespace nereid::element {

constinit auto kernels_of_fluid = kernels_of_each_law<Fluid>(static_cast<AnyLaw*>(nullptr));

}  // namespace nereid::element
