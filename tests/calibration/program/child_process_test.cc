// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <thread>

namespace insitu {
namespace {

struct Outcome {
  int status = -1;
  std::vector<std::string> out, err;
};

Outcome RunShell(const std::string& script) {
  Outcome outcome;
  outcome.status = RunChild({.command = {"/bin/sh", "-c", script},
                             .environment = {"INSITU_TEST=told"},
                             .on_output = [&](const auto& line) { outcome.out.push_back(line); },
                             .on_error = [&](const auto& line) { outcome.err.push_back(line); }});
  return outcome;
}

TEST(RunChild, HandsOverItsLinesAndStatus) {
  const Outcome outcome = RunShell("echo a; echo b >&2; echo $INSITU_TEST; printf c; exit 3");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out, testing::ElementsAre("a", "told", "c"));
  EXPECT_THAT(outcome.err, testing::ElementsAre("b"));
}

TEST(RunChild, LosesNothingOfALongOutput) {
  const Outcome outcome =
      RunShell("i=0; while [ $i -lt 20000 ]; do echo line $i; i=$((i+1)); done");
  ASSERT_EQ(outcome.out.size(), 20000);
  EXPECT_EQ(outcome.out.back(), "line 19999");
}

TEST(RunChild, HasNoInputAndSaysHowItEnded) {
  EXPECT_EQ(RunShell("read line").status, 1);
  EXPECT_EQ(RunShell("kill -KILL $$").status, 128 + SIGKILL);
  EXPECT_EQ(RunChild({{"/nowhere/insitu-nothing"}, {}, [](auto&) {}, [](auto&) {}}), 127);
}

TEST(RunChild, EndsItsGroupWhenItIsToStop) {
  std::stop_source source;
  std::thread stopper([&] {
    usleep(200000);
    source.request_stop();
  });
  std::vector<std::string> lines;
  const int status =
      RunChild({.command = {"/bin/sh", "-c", "echo begun; sleep 30 & wait; echo late"},
                .environment = {},
                .on_output = [&](const std::string& line) { lines.push_back(line); },
                .on_error = [](const std::string&) {},
                .stop = source.get_token()});
  stopper.join();
  EXPECT_EQ(status, 128 + SIGTERM);
  EXPECT_THAT(lines, testing::ElementsAre("begun"));
}

// In a process of its own, since the signals stay forwarded.
TEST(ForwardSignalsToChildren, EndsThemAndTells) {
  EXPECT_EXIT(
      {
        ForwardSignalsToChildren();
        std::thread sender([] {
          usleep(200000);
          kill(getpid(), SIGINT);
        });
        const Outcome outcome = RunShell("sleep 30 & wait; echo too late");
        sender.join();
        _exit(outcome.status == 128 + SIGINT && outcome.out.empty() && ReceivedSignal() == SIGINT
                  ? 0
                  : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace insitu
