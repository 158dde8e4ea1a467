#include "base/replace_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "base/check.hpp"

namespace nereid {

namespace {

[[noreturn]] void cannot_write(const std::filesystem::path& file, int why) {
  throw MachineError("cannot write " + file.string() + ": " + std::strerror(why));
}

/// Writes all bytes to an open file; zero, or why that failed.
int write_all(int file, std::string_view bytes) {
  constexpr std::size_t most = std::size_t{1} << 30;  // [bytes] one call may take no more than two of these
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(file, bytes.data(), std::min(bytes.size(), most));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return ENOSPC;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Writes all bytes and closes the file; zero, or why that failed, first of all `why`.
int write_and_close(int file, std::string_view bytes, int why = 0) {
  if (why == 0) why = write_all(file, bytes);
  if (::close(file) != 0 && why == 0 && errno != EINTR) why = errno;  // some file systems tell only now that they are full
  return why;
}

}  // namespace

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw MachineError("cannot make the folder " + folder.string() + ": " + error.message());
}

std::filesystem::path draft_of(std::filesystem::path file) { return file += ".tmp"; }

void replace_file(const std::filesystem::path& file, std::string_view bytes) {
  const std::filesystem::path draft = draft_of(file);
  const int open_file = ::open(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (open_file < 0) cannot_write(draft, errno);
  int why = write_and_close(open_file, bytes);
  if (why == 0 && ::rename(draft.c_str(), file.c_str()) != 0) why = errno;
  if (why == 0) return;
  ::unlink(draft.c_str());
  cannot_write(file, why);
}

void append_to_file(const std::filesystem::path& file, std::uint64_t begin, std::string_view bytes) {
  const int open_file = ::open(file.c_str(), O_WRONLY | O_CLOEXEC | (begin == 0 ? O_CREAT : 0), 0666);
  if (open_file < 0) cannot_write(file, errno);
  const auto end = static_cast<::off_t>(begin);
  int why = ::ftruncate(open_file, end) != 0 || ::lseek(open_file, end, SEEK_SET) < 0 ? errno : 0;
  why = write_and_close(open_file, bytes, why);
  if (why == 0) return;
  const int cut = ::truncate(file.c_str(), end);  // a part of a row must not stand there as one
  cannot_write(file, cut == 0 ? why : errno);
}

}  // namespace nereid
