#include "base/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>

#include "base/check.hpp"

namespace nereid {

namespace {

#ifdef NEREID_SANITIZED
constexpr bool limits_memory = false;  // sanitizers take a large address space and no memory
#else
constexpr bool limits_memory = true;
#endif

enum Exit { returned = 0, no_memory = 10, threw = 11 };

/// Address space that this process has. [bytes]
double address_space() {
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

void limit(int what, double most) {
  rlimit now{};
  if (::getrlimit(static_cast<__rlimit_resource>(what), &now) != 0) return;
  const double known = now.rlim_cur == RLIM_INFINITY ? 1e18 : static_cast<double>(now.rlim_cur);
  now.rlim_cur = static_cast<rlim_t>(std::min(known, most));
  ::setrlimit(static_cast<__rlimit_resource>(what), &now);
}

/// What the copy does.
[[noreturn]] void work_and_leave(const std::function<std::string()>& work, const OfChildAtMost& most, int to) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would wait for it
  ::signal(SIGPIPE, SIG_DFL);
  for (const int one : {SIGINT, SIGTERM, SIGHUP}) ::signal(one, SIG_IGN);  // which the first process answers
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int one : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, one);
  limit(RLIMIT_CORE, 0);
  if (limits_memory && most.memory > 0) limit(RLIMIT_AS, address_space() + most.memory);
  try {
    const std::string bytes = work();
    for (std::size_t begin = 0; begin < bytes.size();) {
      const ::ssize_t written = ::write(to, bytes.data() + begin, bytes.size() - begin);
      if (written < 0 && errno != EINTR) ::_exit(threw);
      begin += static_cast<std::size_t>(std::max<::ssize_t>(written, 0));
    }
  } catch (const std::bad_alloc&) {
    ::_exit(no_memory);
  } catch (...) {
    ::_exit(threw);
  }
  ::_exit(returned);
}

/// Reads what the child writes; whether it ended in time.
bool read_all(int from, double seconds, std::string& bytes) {
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::duration<double>(seconds);
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const double left = std::chrono::duration<double>(until - Clock::now()).count();
    if (left <= 0) return false;
    pollfd one{from, POLLIN, 0};
    if (::poll(&one, 1, static_cast<int>(std::min(left, 1.0) * 1e3) + 1) <= 0) continue;
    const ::ssize_t read = ::read(from, buffer.data(), buffer.size());
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) return true;
    bytes.append(buffer.data(), static_cast<std::size_t>(read));
  }
}

}  // namespace

OfChild in_child(const std::function<std::string()>& work, const OfChildAtMost& most) {
  const auto cannot = [] { return MachineError(std::string("cannot start a process: ") + std::strerror(errno)); };
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw cannot();
  const ::pid_t child = ::fork();
  if (child < 0) {
    const auto error = cannot();
    ::close(ends[0]), ::close(ends[1]);
    throw error;
  }
  if (child == 0) work_and_leave(work, most, ends[1]);
  ::close(ends[1]);
  const auto wait = [child] {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  };
  OfChild found;
  bool in_time = false;
  try {
    in_time = read_all(ends[0], most.seconds, found.bytes);
  } catch (...) {  // memory
    ::close(ends[0]), ::kill(child, SIGKILL), wait();
    throw;
  }
  ::close(ends[0]);
  if (!in_time) ::kill(child, SIGKILL);
  const int status = wait();
  if (!in_time) found.why = "it took more than " + std::to_string(static_cast<int>(most.seconds)) + " s";
  else if (WIFSIGNALED(status)) found.why = std::string("it crashed: ") + ::strsignal(WTERMSIG(status));
  else if (WEXITSTATUS(status) == no_memory) found.why = "it takes too much memory", found.out_of_memory = true;
  else if (WEXITSTATUS(status) != returned) found.why = "it failed";
  if (!found.why.empty()) found.bytes.clear();
  return found;
}

}  // namespace nereid
