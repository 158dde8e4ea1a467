#include "output/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>

#include "base/check.hpp"
#include "base/replace_file.hpp"
#include "grid/grid.hpp"

namespace nereid::output {

namespace {

namespace fs = std::filesystem;

constexpr const char* lock_name = "run.lock";
constexpr const char* judged_by[] = {"summary.json", "history.csv"};
constexpr const char* collections[] = {"body", "contact", "walls", "offenders"};

/// Whether two descriptions are of the same file.
bool same_file(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw MachineError("cannot remove " + file.string() + ": " + error.message());
}

fs::path stale(fs::path file) { return file += ".stale"; }

bool begins_like_a_mesh(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;  // to open a pipe takes as long as nobody writes to it
  std::ifstream stream(file, std::ios::binary);
  return stream.peek() == '<';
}

/// Opens and locks the file; -1, with a warning, where the file system cannot lock.
int lock(const fs::path& folder) {
  const fs::path file = folder / lock_name;
  for (;;) {
    const int open_file = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (open_file < 0) throw MachineError("cannot write " + file.string() + ": " + std::strerror(errno));
    struct stat mine {}, there {};
    if (::flock(open_file, LOCK_EX | LOCK_NB) == 0) {
      // the run that held it before may have removed the file between our two calls; then another run could lock a new one
      if (::fstat(open_file, &mine) == 0 && ::stat(file.c_str(), &there) == 0 && same_file(mine, there)) return open_file;
      ::close(open_file);
      continue;
    }
    const int why = errno;
    ::close(open_file);
    if (why == EINTR) continue;
    if (why == EWOULDBLOCK)
      throw MachineError("another run writes to the folder " + folder.string() + "; wait for its end or choose another one");
    std::cerr << "warning: nothing keeps a second run out of the folder " << folder.string()
              << ": its file system cannot lock files: " << std::strerror(why) << "\n";
    ::unlink(file.c_str());
    return -1;
  }
}

}  // namespace

std::vector<fs::path> result_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  const auto add = [&](const fs::path& file) {
    if (fs::exists(fs::symlink_status(file, error))) files.push_back(file);
  };
  for (const char* name : judged_by) add(folder / name), add(stale(folder / name));
  add(draft_of(folder / "summary.json"));  // of a run that was killed
  add(folder / checkpoint_name), add(draft_of(folder / checkpoint_name));
  add(folder / lock_name);
  for (const char* name : collections)
    for (const fs::path& file : grid::collection_files(folder, name)) files.push_back(file);
  return files;
}

fs::path result_that_is(const fs::path& folder, const fs::path& file) {
  for (const fs::path& result : result_files(folder)) {
    std::error_code error;  // of links that lead nowhere
    if (fs::equivalent(result, file, error) && !error) return result;
  }
  return {};
}

RunFolder::RunFolder(fs::path folder, bool goes_on) : folder_(std::move(folder)), goes_on_(goes_on) {
  std::error_code error;
  if (folder_.empty() || !fs::is_directory(folder_, error)) return;
  hold();
  if (goes_on) take_back();
  set_aside();
}

void RunFolder::set_aside() {
  if (!held_ || goes_on_) return;
  std::error_code error;
  for (const char* name : judged_by) {
    const fs::path file = folder_ / name;
    if (!fs::exists(fs::symlink_status(file, error)) || begins_like_a_mesh(file)) continue;
    fs::rename(file, stale(file), error);
    if (error) throw MachineError("cannot rename " + file.string() + ": " + error.message());
    renamed_.push_back(file);
  }
}

/// What a run that was killed before it had read its case has set aside.
void RunFolder::take_back() {
  std::error_code error;
  for (const char* name : judged_by) {
    const fs::path file = folder_ / name;
    if (!fs::exists(fs::symlink_status(file, error)) && fs::is_regular_file(stale(file), error)) fs::rename(stale(file), file, error);
  }
}

RunFolder::~RunFolder() {
  std::error_code error;  // a destructor must not throw
  const bool can_go_on = fs::exists(folder_ / checkpoint_name, error);
  for (const fs::path& file : renamed_) {
    if (can_go_on) fs::rename(stale(file), file, error);
    else fs::remove(stale(file), error);
  }
  if (lock_ < 0) return;
  struct stat mine {};
  if (::fstat(lock_, &mine) == 0 && mine.st_size == 0) ::unlink((folder_ / lock_name).c_str());  // while no other run can hold it
  ::close(lock_);
}

bool RunFolder::restore() {
  const bool any = !renamed_.empty();
  for (const fs::path& file : renamed_) {
    std::error_code error;
    fs::rename(stale(file), file, error);
    if (error) throw MachineError("cannot rename " + stale(file).string() + ": " + error.message());
  }
  renamed_.clear();
  return any;
}

void RunFolder::hold() {
  lock_ = lock(folder_);
  held_ = true;
}

void RunFolder::clear() {
  if (folder_.empty()) return;
  make_folder(folder_);
  if (!held_) hold();
  renamed_.clear();
  for (const bool is_index : {true, false})  // first, so that none lists what is gone
    for (const fs::path& file : result_files(folder_))
      if (file.filename() != lock_name && (file.extension() == ".pvd") == is_index) remove_file(file);
  std::error_code not_empty;
  for (const char* name : collections)
    if (fs::is_directory(fs::symlink_status(folder_ / name, not_empty))) fs::remove(folder_ / name, not_empty);  // a link stays
}

}  // namespace nereid::output
