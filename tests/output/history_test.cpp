#include "output/history.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/check.hpp"

namespace nereid::output::history_test {
namespace {

namespace fs = std::filesystem;

fs::path fresh_file(const std::string& name) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();  // tests run side by side
  const fs::path folder = fs::path(testing::TempDir()) / ("nereid_history_" + test + "_" + name);
  fs::remove_all(folder);
  return folder / "history.csv";
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

const std::vector<Column> two{{"settlement_mean", "m"}, {"interface_stress", "Pa"}};

TEST(History, HeaderCarriesUnitsAndNumbersCarryAllDigits) {
  const fs::path file = fresh_file("header");
  History history(file, two);
  history.add(0, std::vector<double>{0.1, -203e6});
  history.add(1e-3, std::vector<double>{1.0 / 3, std::numeric_limits<double>::infinity()});
  history.flush();
  EXPECT_EQ(text_of(file),
            "time [s],settlement_mean [m],interface_stress [Pa]\n"
            "0,0.10000000000000001,-203000000\n"
            "0.001,0.33333333333333331,inf\n");
}

TEST(History, MayCountSomethingElseThanTime) {
  const fs::path file = fresh_file("modes");
  History history(file, {{"frequency", "Hz"}}, {"mode", "1"});
  history.add(1, std::vector<double>{50.5});
  history.flush();
  EXPECT_EQ(text_of(file), "mode [1],frequency [Hz]\n1,50.5\n");
  EXPECT_THROW(History(file, {{"mode", "1"}}, {"mode", "1"}), InternalError);
}

TEST(History, HasLinesThatCanBeHadWithoutAFile) {
  std::string text = head_text(two);
  append_row(0, std::vector<double>{0.1, -203e6}, text);
  EXPECT_EQ(text, "time [s],settlement_mean [m],interface_stress [Pa]\n0,0.10000000000000001,-203000000\n");
}

TEST(History, ItsHeaderSaysWhatIsAMeanOverTime) {
  EXPECT_EQ(head_text({{"tip", "m"}, {"pull", "N", true}}), "time [s],tip [m],pull [N] mean\n");
}

TEST(History, NotANumberHasNoSign) {
  const fs::path file = fresh_file("nan");
  History history(file, two);
  history.add(0, std::vector<double>{std::nan(""), -std::nan("")});
  history.flush();
  EXPECT_NE(text_of(file).find("\n0,nan,nan\n"), std::string::npos);
}

TEST(History, ColumnsStandOnTheDiskBeforeTheFirstRow) {
  const fs::path file = fresh_file("early");
  const History history(file, two);
  EXPECT_EQ(text_of(file), "time [s],settlement_mean [m],interface_stress [Pa]\n");
}

TEST(History, EveryRowReachesTheDiskWhenTheHistoryGoes) {
  const fs::path file = fresh_file("end");
  {
    History history(file, two);
    for (int i = 0; i < 10000; ++i) history.add(i, std::vector<double>{i / 7.0, i / 11.0});
  }
  const std::string text = text_of(file);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10001);
}

TEST(History, NumbersReadBackAreTheSameBits) {
  const fs::path file = fresh_file("bits");
  const std::vector<double> row{std::pow(3.3, 40), -4.9406564584124654e-324};
  History history(file, two);
  history.add(0.1, row);
  history.flush();
  std::stringstream lines(text_of(file));
  std::string header, word;
  std::getline(lines, header);
  std::getline(lines, word, ',');
  EXPECT_EQ(std::strtod(word.c_str(), nullptr), 0.1);
  for (const double value : row) {
    std::getline(lines, word, ',');
    EXPECT_EQ(std::strtod(word.c_str(), nullptr), value);
  }
}

TEST(History, RowOfAnotherLengthIsRefused) {
  History history(fresh_file("length"), two);
  EXPECT_THROW(history.add(0, std::vector<double>{1}), InternalError);
}

TEST(History, NameThatBreaksTheTableIsRefused) {
  EXPECT_THROW(History(fresh_file("name"), {{"a,b", "m"}}), InternalError);
  EXPECT_THROW(History(fresh_file("name"), {{"a", "m"}, {"a", "m"}}), InternalError);
  EXPECT_THROW(History(fresh_file("name"), {{"time", "s"}}), InternalError);
}

TEST(History, FullDiskIsTheMachinesFault) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  EXPECT_THROW(History("/dev/full", two), MachineError);
  EXPECT_THROW(History("/proc/nowhere/history.csv", two), MachineError);
}

TEST(History, AFullDiskLeavesWholeRows) {
  const fs::path file = fresh_file("full");
  History history(file, two);
  history.add(1, std::vector<double>{0.1, 2});
  history.flush();
  const std::string before = text_of(file);
  void (*const signal)(int) = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{before.size() + 10, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  history.add(2, std::vector<double>{0.1, 2});
  EXPECT_THROW(history.flush(), MachineError);
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, signal);
  EXPECT_EQ(text_of(file), before);
}

TEST(History, AFileThatHasVanishedIsTheMachinesFault) {
  const fs::path file = fresh_file("vanished");
  History history(file, two);
  fs::remove(file);
  history.add(1, std::vector<double>{0.1, 2});
  EXPECT_THROW(history.flush(), MachineError);
}

}  // namespace
}  // namespace nereid::output::history_test
