#include "base/memory.hpp"

#include <sys/resource.h>

namespace nereid {

double most_resident() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return 1024.0 * static_cast<double>(used.ru_maxrss);  // given in kB
}

}  // namespace nereid
