// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/program.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "calibration/files/error.h"

namespace insitu {
namespace {

struct Outcome {
  int status = -1;
  std::string out, err;
};

Outcome RunNothing(std::vector<std::string> arguments, const std::function<void()>& run) {
  ProgramOptions program("does nothing", "insitu-nothing");
  std::string site;
  program.Value("SITE", &site, "", {.is_required = true});
  program.Footer("Example: insitu-nothing gallery");
  arguments.insert(arguments.begin(), "insitu-nothing");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Outcome outcome;
  outcome.status = RunProgram(program, static_cast<int>(argv.size()), argv.data(), run);
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.err = testing::internal::GetCapturedStderr();
  return outcome;
}

TEST(Program, Success) {
  const Outcome outcome = RunNothing({"site"}, [] {});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST(Program, HelpHasTheExampleAndVersionTheName) {
  const Outcome help = RunNothing({"--help"}, [] { FAIL(); });
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.out.find("Example: insitu-nothing gallery"), std::string::npos);
  const Outcome version = RunNothing({"--version"}, [] { FAIL(); });
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out, "insitu-nothing " INSITU_VERSION "\n");
}

TEST(Program, BadInputIsTwoAndItsMessageAsItIs) {
  const Outcome outcome = RunNothing({"site"}, [] { throw InputError("a.csv", 7, "bad"); });
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "a.csv:7: bad\n");
}

TEST(Program, WrongOptionsAreTwo) {
  EXPECT_EQ(RunNothing({}, [] { FAIL(); }).err, "insitu-nothing: SITE is required (see --help)\n");
  EXPECT_EQ(RunNothing({"site", "--what"}, [] { FAIL(); }).status, 2);
}

TEST(Program, AnyOtherFailureIsOne) {
  const Outcome outcome = RunNothing({"site"}, [] { throw std::runtime_error("disk full"); });
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "insitu-nothing: disk full\n");
  EXPECT_EQ(RunNothing({"site"}, [] { INSITU_CHECK(1 > 2); }).status, 1);
}

TEST(Program, ProgressIsSilentWithoutATerminal) {
  testing::internal::CaptureStderr();
  {
    Progress progress("working", 3);
    for (int i = 0; i < 3; ++i) progress.Step();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// As insitu-montage reads it; nothing is said of work that is done within two seconds.
TEST(Program, ProgressTellsWhatIsBeingDone) {
  setenv(kProgressVariable, "1", 1);
  testing::internal::CaptureStderr();
  {
    Progress progress("finding boards", 0);
    progress.Show();
    std::this_thread::sleep_for(std::chrono::milliseconds(2050));
    progress.Show();
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    progress.Next("solving");
  }
  unsetenv(kProgressVariable);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "progress: finding boards\nprogress: solving\n");
}

TEST(DurationText, IsInTheUnitThatFits) {
  EXPECT_EQ(DurationText(0.4), "0 s");
  EXPECT_EQ(DurationText(99), "99 s");
  EXPECT_EQ(DurationText(150), "3 min");
  EXPECT_EQ(DurationText(7200), "2 h");
}

}  // namespace
}  // namespace insitu
