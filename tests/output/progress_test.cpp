#include "output/progress.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace nereid::output::progress_test {
namespace {

TEST(Progress, SpansOfTimeAreSpokenAsPeopleDo) {
  EXPECT_EQ(spoken(0.2), "0 s");
  EXPECT_EQ(spoken(59.4), "59 s");
  EXPECT_EQ(spoken(200), "3 min 20 s");
  EXPECT_EQ(spoken(7500), "2 h 05 min");
  EXPECT_EQ(spoken(std::nan("")), "?");
  EXPECT_EQ(spoken(INFINITY), "?");
}

TEST(Progress, LineGuessesTheRestAtTheSameSpeed) {
  EXPECT_EQ(progress_line(1.5e-3, 0, 6e-3, 12345, 1.2345e-7, 100),
            " 25.0 %  0.0015 of 0.006 s  step 12345  dt 1.23e-07 s  5 min 00 s to go");
  EXPECT_EQ(progress_line(1.5e-3, 1e-3, 6e-3, 12345, 1.2345e-7, 10),  // a run that went on at 1 ms
            " 25.0 %  0.0015 of 0.006 s  step 12345  dt 1.23e-07 s  1 min 30 s to go");
  EXPECT_NE(progress_line(0, 0, 6e-3, 0, 1e-7, 0).find("? to go"), std::string::npos);
  EXPECT_NE(progress_line(7e-3, 0, 6e-3, 0, 1e-7, 9).find("100.0 %"), std::string::npos);
}

TEST(Progress, WritesALineNowAndThenWhereThereIsNoTerminal) {
  testing::internal::CaptureStderr();  // a file takes the place of the terminal
  {
    Progress minute(0, 1, false), often(0, 1, false, std::chrono::milliseconds(0)), quiet(0, 1, true, std::chrono::milliseconds(0));
    for (Progress* one : {&minute, &often, &quiet}) one->show(0.5, 1, 0.1), one->done();
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(text.rfind(" 50.0 %  0.5 of 1 s", 0), 0u) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_EQ(Progress::usual_pause, std::chrono::seconds(60));
}

/// What Progress writes when stderr is a terminal, in how many seconds.
std::string on_a_terminal(bool quiet, double* seconds = nullptr) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) return "no terminal";
  const int screen = open(ptsname(terminal), O_RDWR | O_NOCTTY);
  const int before = dup(STDERR_FILENO);
  fflush(stderr);
  dup2(screen, STDERR_FILENO);
  const auto began = std::chrono::steady_clock::now();
  {
    Progress progress(0, 1, quiet);
    for (int step = 0; step < 1000; ++step) progress.show(1e-3 * step, step, 1e-3);
  }
  if (seconds != nullptr) *seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  fflush(stderr);
  dup2(before, STDERR_FILENO);
  std::string text;
  pollfd there{terminal, POLLIN, 0};
  while (poll(&there, 1, 100) > 0) {  // [ms] what has been written comes in pieces
    char piece[4096];
    const auto size = read(terminal, piece, sizeof piece);
    if (size <= 0) break;
    text.append(piece, piece + size);
  }
  close(before), close(screen), close(terminal);
  return text;
}

TEST(Progress, WritesOneLineAtATimeAndEndsIt) {
  double seconds = 0;
  const std::string text = on_a_terminal(false, &seconds);
  if (text == "no terminal") GTEST_SKIP();
  EXPECT_EQ(text.rfind("\r  0.0 %", 0), 0u) << text;
  EXPECT_EQ(text.back(), '\n');
  // A thousand steps, yet the screen is written five times a second at most, besides its first and last line.
  EXPECT_LE(static_cast<double>(std::count(text.begin(), text.end(), '%')), 3 + 5 * seconds);
}

TEST(Progress, IsSilentWhenAskedToBe) {
  const std::string text = on_a_terminal(true);
  if (text == "no terminal") GTEST_SKIP();
  EXPECT_EQ(text, "");
}

}  // namespace
}  // namespace nereid::output::progress_test
