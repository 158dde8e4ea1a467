#include "base/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace nereid {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// A number in a file of the system, with what stands before it; infinity where there is none. [-]
double number_in(const char* file, const std::string& before = "") {
  std::ifstream stream(file);
  std::string word;
  while (!before.empty() && word != before)
    if (!(stream >> word)) return unlimited;
  double value = 0;
  return stream >> value ? value : unlimited;
}

/// [bytes] that the limit on address space leaves.
double address_space_left() {
  rlimit most{};
  if (getrlimit(RLIMIT_AS, &most) != 0 || most.rlim_cur == RLIM_INFINITY) return unlimited;
  const double pages = number_in("/proc/self/statm");
  return static_cast<double>(most.rlim_cur) - (pages < unlimited ? pages * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0);
}

}  // namespace

double memory_left() {
  const double machine = 1024 * number_in("/proc/meminfo", "MemAvailable:");  // given in kB
  double group = number_in("/sys/fs/cgroup/memory.max");
  if (group < unlimited) group -= number_in("/sys/fs/cgroup/memory.current");
  return std::max(0.0, std::min({machine, group, address_space_left()}));
}

double most_resident() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return 1024.0 * static_cast<double>(used.ru_maxrss);  // given in kB
}

}  // namespace nereid
