#include "output/run_folder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <set>
#include <string>

#include "base/check.hpp"

namespace nereid::output::run_folder_test {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text = "old") {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

fs::path fresh_folder() {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();  // tests run side by side
  fs::path folder = fs::path(testing::TempDir()) / ("nereid_run_folder_" + test);
  fs::remove_all(folder);
  return folder;
}

/// A folder with all that a run leaves, and files of others among it.
fs::path used_folder() {
  fs::path folder = fresh_folder();
  write(folder / "summary.json", "{}");
  write(folder / "history.csv", "time [s]\n0\n");
  for (const std::string name : {"body", "contact", "walls"}) {
    write(folder / (name + ".pvd"));
    write(folder / name / (name + (name == "body" ? "_000000.vtu" : "_000000.vtp")));
  }
  write(folder / "case.yaml");
  write(folder / "body/mesh.vtu");
  write(folder / "body/body_12.vtu");
  return folder;
}

std::set<std::string> files(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& at : fs::recursive_directory_iterator(folder))
    if (at.is_regular_file()) names.insert(fs::relative(at.path(), folder).string());
  return names;
}

TEST(ResultFiles, AreThoseARunWritesOrClearsAndNoOthers) {
  const fs::path folder = used_folder();
  std::set<std::string> names;
  for (const fs::path& file : result_files(folder)) names.insert(fs::relative(file, folder).string());
  EXPECT_EQ(names, (std::set<std::string>{"summary.json", "history.csv", "body.pvd", "contact.pvd", "walls.pvd", "body/body_000000.vtu",
                                          "contact/contact_000000.vtp", "walls/walls_000000.vtp"}));
  EXPECT_TRUE(result_files(folder / "none").empty());
}

TEST(ResultFiles, TellWhichOfThemAFileIsByAnyName) {
  const fs::path folder = used_folder();
  EXPECT_EQ(result_that_is(folder, folder / "body/../body/body_000000.vtu"), folder / "body/body_000000.vtu");
  EXPECT_EQ(result_that_is(folder, folder / "body/mesh.vtu"), "");
  EXPECT_EQ(result_that_is(folder, folder / "none.vtu"), "");
  fs::create_symlink(folder / "history.csv", folder / "link");
  EXPECT_EQ(result_that_is(folder, folder / "link"), folder / "history.csv");
  fs::create_symlink(folder / "body/mesh.vtu", folder / "body/body_000001.vtu");
  EXPECT_EQ(result_that_is(folder, folder / "body/mesh.vtu"), folder / "body/body_000001.vtu");
}

TEST(RunFolder, LosesTheOldSummaryAndHistoryAtOnceAndTheRestWhenCleared) {
  const fs::path folder = used_folder();
  {
    RunFolder run(folder);
    EXPECT_FALSE(fs::exists(folder / "summary.json"));
    EXPECT_FALSE(fs::exists(folder / "history.csv"));
    EXPECT_TRUE(fs::exists(folder / "body/body_000000.vtu"));
    run.clear();
  }
  EXPECT_EQ(files(folder), (std::set<std::string>{"case.yaml", "body/mesh.vtu", "body/body_12.vtu"}));
  EXPECT_FALSE(fs::exists(folder / "contact"));
}

TEST(RunFolder, OfARunThatIsRefusedHasAllAsItWas) {
  const fs::path folder = used_folder();
  const auto before = files(folder);
  {
    RunFolder run(folder);
    run.restore();
  }
  EXPECT_EQ(files(folder), before);
}

TEST(RunFolder, OfARunThatEndsBeforeItIsClearedKeepsNothingStale) {
  const fs::path folder = used_folder();
  { RunFolder run(folder); }
  for (const char* name : {"summary.json", "history.csv"}) {
    EXPECT_FALSE(fs::exists(folder / name));
    EXPECT_FALSE(fs::exists(folder / (std::string(name) + ".stale")));
  }
}

TEST(RunFolder, KeepsAMeshThatIsCalledAsASummaryUntilItIsCleared) {
  const fs::path folder = used_folder();
  write(folder / "summary.json", "<?xml version=\"1.0\"?>");
  RunFolder run(folder);
  EXPECT_TRUE(fs::exists(folder / "summary.json"));
  EXPECT_EQ(result_that_is(folder, folder / "summary.json"), folder / "summary.json");
}

TEST(RunFolder, IsMadeOnlyWhenCleared) {
  const fs::path folder = fresh_folder();
  RunFolder run(folder / "a/b");
  EXPECT_FALSE(fs::exists(folder));
  run.clear();
  EXPECT_EQ(files(folder), std::set<std::string>{"a/b/run.lock"});
  EXPECT_THROW(RunFolder(folder / "a/b"), MachineError);
}

TEST(RunFolder, WithoutANameIsNone) {
  RunFolder run("");
  run.clear();
  EXPECT_TRUE(result_files("").empty());
}

TEST(RunFolder, RefusesASecondRunByItsNameAndTouchesNothing) {
  const fs::path folder = used_folder();
  RunFolder first(folder);
  write(folder / "summary.json", "{}");
  const auto before = files(folder);
  try {
    RunFolder second(folder);
    FAIL() << "two runs hold one folder";
  } catch (const MachineError& error) {
    const std::string expected = "another run writes to the folder " + folder.string() + "; wait for its end or choose another one";
    EXPECT_EQ(std::string(error.what()), expected);
  }
  EXPECT_EQ(files(folder), before);
}

TEST(RunFolder, RefusesASecondRunThatFoundNoFolderAtFirst) {
  const fs::path folder = fresh_folder();
  RunFolder first(folder), second(folder);
  first.clear();
  write(folder / "summary.json", "{}");
  EXPECT_THROW(second.clear(), MachineError);
  EXPECT_TRUE(fs::exists(folder / "summary.json"));
}

TEST(RunFolder, IsFreeAgainAtTheEnd) {
  const fs::path folder = used_folder();
  { RunFolder run(folder); }
  EXPECT_FALSE(fs::exists(folder / "run.lock"));
  RunFolder again(folder);
  EXPECT_TRUE(fs::exists(folder / "run.lock"));
}

TEST(RunFolder, IsFreeAgainWhenItsRunWasKilled) {
  const fs::path folder = used_folder();
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    RunFolder run(folder);
    const char told = 1;
    if (::write(ready[1], &told, 1) != 1) _exit(1);
    pause();
  }
  char heard = 0;
  ASSERT_EQ(read(ready[0], &heard, 1), 1);
  EXPECT_THROW(RunFolder{folder}, MachineError);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(folder / "run.lock"));
  EXPECT_NO_THROW(RunFolder{folder});
}

TEST(RunFolder, LeavesAFileThatIsCalledAsAFolderOfFrames) {
  const fs::path folder = fresh_folder();
  write(folder / "body", "a text");
  RunFolder(folder).clear();
  EXPECT_TRUE(fs::is_regular_file(folder / "body"));
}

TEST(RunFolder, LeavesAFileOfAnotherCalledAsItsLock) {
  const fs::path folder = used_folder();
  write(folder / "run.lock", "a text");
  { RunFolder(folder).clear(); }
  EXPECT_TRUE(fs::exists(folder / "run.lock"));
}

}  // namespace
}  // namespace nereid::output::run_folder_test
