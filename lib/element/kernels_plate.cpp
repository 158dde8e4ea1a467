#include "element/kernels_body.hpp"

namespace nereid::element {

constinit auto kernels_of_plate = kernels_of_each_law<Plate>(static_cast<AnyLaw*>(nullptr));

}  // namespace nereid::element
