#include "base/replace_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "base/check.hpp"

namespace nereid::replace_file_test {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder() {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();  // tests run side by side
  const fs::path folder = fs::path(testing::TempDir()) / ("nereid_replace_file_" + test);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string why(const fs::path& file, std::string_view bytes) {
  try {
    replace_file(file, bytes);
  } catch (const MachineError& error) {
    return error.what();
  }
  return "";
}

/// Lets no file grow beyond so many bytes while it lives: a disk that is full.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit small{bytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, before_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  void (*before_)(int);
  rlimit limit_{};
};

TEST(ReplaceFile, WritesAllBytesAndLeavesNoDraft) {
  const fs::path file = fresh_folder() / "a.txt";
  const std::string bytes("a\0b\n", 4);
  replace_file(file, "before");
  replace_file(file, bytes);
  EXPECT_EQ(text_of(file), bytes);
  EXPECT_FALSE(fs::exists(draft_of(file)));
}

TEST(ReplaceFile, AFullDiskLeavesTheOldFileAndNoDraft) {
  const fs::path file = fresh_folder() / "a.txt";
  replace_file(file, "before");
  {
    const SmallDisk disk(1000);
    EXPECT_EQ(why(file, std::string(2000, 'x')), "cannot write " + file.string() + ": File too large");
  }
  EXPECT_EQ(text_of(file), "before");
  EXPECT_FALSE(fs::exists(draft_of(file)));
}

TEST(ReplaceFile, SaysWhyItFails) {
  const fs::path folder = fresh_folder();
  EXPECT_EQ(why(folder / "none/a.txt", "x"), "cannot write " + (folder / "none/a.txt.tmp").string() + ": No such file or directory");
  fs::create_directories(folder / "b/full");
  EXPECT_EQ(why(folder / "b", "x"), "cannot write " + (folder / "b").string() + ": Is a directory");
  EXPECT_FALSE(fs::exists(folder / "b.tmp"));
}

TEST(AppendToFile, DropsWhatFollowed) {
  const fs::path file = fresh_folder() / "a.txt";
  append_to_file(file, 0, "abc");
  append_to_file(file, 3, "defg");
  EXPECT_EQ(text_of(file), "abcdefg");
  append_to_file(file, 5, "X");
  EXPECT_EQ(text_of(file), "abcdeX");
}

TEST(AppendToFile, AFullDiskLeavesWhatWasWhole) {
  const fs::path file = fresh_folder() / "a.txt";
  append_to_file(file, 0, std::string(900, 'a'));
  {
    const SmallDisk disk(1000);
    EXPECT_THROW(append_to_file(file, 900, std::string(900, 'b')), MachineError);
  }
  EXPECT_EQ(text_of(file), std::string(900, 'a'));
}

TEST(AppendToFile, AFileThatHasVanishedIsTheMachinesFault) {
  const fs::path file = fresh_folder() / "a.txt";
  append_to_file(file, 0, "abc");
  fs::remove(file);
  EXPECT_THROW(append_to_file(file, 3, "def"), MachineError);
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace nereid::replace_file_test
