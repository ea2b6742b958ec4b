// SPDX-License-Identifier: GPL-3.0-or-later
// A journal that is made shorter loses nothing that can be undone, asked again or is not saved yet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include "tests/reconstruction/editing/edited_site.h"

namespace insitu {
namespace {

using testing::HasSubstr;

class ShortJournal : public EditedSite {
 protected:
  void OpenShort(const HistoryLimits& limits = {20, 6, 10}) {
    edit_.reset();
    edit_ = std::make_unique<SiteEdit>(site_, std::vector<std::string>{"A", "B"}, limits);
  }

  // Mark p of photo A, one pixel to the right each time.
  EditOutcome Move(int step) {
    return Apply("m" + std::to_string(step), "observations", MarkOn("A", "p", At(step), 2),
                 MarkOn("A", "p", At(step + 1), 2));
  }
  static double At(int step) { return 1.5 + step; }
  double Now() const { return edit_->Rows("observations")[0]["x"].asDouble(); }

  std::string JournalText() const { return Content("work/prepare/journal.jsonl"); }
  size_t Lines() const {
    const std::string text = JournalText();
    return static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
  }
};

TEST_F(ShortJournal, StaysShortWithItsRevisionAndItsLastSteps) {
  OpenShort();
  for (int step = 0; step < 100; ++step) {
    Move(step);
    edit_->Save();
    EXPECT_LE(Lines(), 24u) << step;
  }
  OpenShort();
  EXPECT_EQ(edit_->revision(), 100);
  EXPECT_TRUE(edit_->is_saved());
  EXPECT_EQ(edit_->found().conflicts.size() + edit_->found().operations.size(), 0u);
  EXPECT_EQ(Now(), At(100));
  for (int undone = 1; undone <= 6; ++undone) {
    EXPECT_TRUE(edit_->Undo("u" + std::to_string(undone)).is_done());
    EXPECT_EQ(Now(), At(100 - undone));
    OpenShort();
  }
  for (int redone = 1; redone <= 6; ++redone) {
    EXPECT_TRUE(edit_->Redo("r" + std::to_string(redone)).is_done());
    OpenShort();
  }
  EXPECT_EQ(Now(), At(100));
}

TEST_F(ShortJournal, LetsAThousandOperationsBeUndoneAcrossRestarts) {
  const auto before = Contents();
  const HistoryLimits limits{3000, 1000, 20000};
  OpenShort(limits);
  for (int step = 0; step < 1000; ++step) Move(step);
  edit_->Save();
  const auto after = Contents();
  OpenShort({1, 1000, 20000});
  EXPECT_EQ(Lines(), 1u);
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(edit_->Undo("u" + std::to_string(i)).is_done());
  edit_->Save();
  EXPECT_EQ(Contents(), before);
  OpenShort(limits);
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(edit_->Redo("r" + std::to_string(i)).is_done());
  edit_->Save();
  EXPECT_EQ(Contents(), after);
}

TEST_F(ShortJournal, AnIdCountsOnceThereafter) {
  OpenShort();
  int step = 0;
  for (; step < 40; ++step) {
    Move(step);
    edit_->Save();
  }
  OpenShort();
  const EditOutcome again = Move(step - 1);
  EXPECT_TRUE(again.is_repeated);
  EXPECT_EQ(again.revision, step);
  EXPECT_EQ(Now(), At(step));
}

TEST_F(ShortJournal, WaitsUntilAllIsInTheFiles) {
  OpenShort();
  for (int step = 0; step < 60; ++step) Move(step);
  EXPECT_GT(Lines(), 60u);
  OpenShort();
  EXPECT_GT(Lines(), 60u);
  EXPECT_FALSE(edit_->is_saved());
  EXPECT_EQ(Now(), At(60));
  edit_->Save();
  EXPECT_EQ(Lines(), 1u);
  OpenShort();
  EXPECT_EQ(Now(), At(60));
}

TEST_F(ShortJournal, TellsOthersChangesFromItsOwnThereafter) {
  OpenShort();
  for (int step = 0; step < 30; ++step) Move(step);
  edit_->Save();
  ASSERT_LT(Lines(), 10u);
  Kill();
  folder_.Write("survey/observations.csv", Replaced(Marks(), "B,p,5,6", "B,p,5,7"));
  OpenShort();
  ASSERT_EQ(edit_->found().operations.size(), 1u);
  EXPECT_EQ(edit_->found().operations[0].edits.size(), 1u);
  EXPECT_EQ(Now(), At(30));
}

TEST_F(ShortJournal, WhatAKilledOneLeftBesideItIsRemoved) {
  OpenShort();
  for (int step = 0; step < 15; ++step) Move(step);
  edit_->Save();
  Kill();
  const auto half = folder_.Write("work/prepare/.journal.2147483.jsonl", R"({"kind": "beg)");
  OpenShort();
  EXPECT_FALSE(std::filesystem::exists(half));
  EXPECT_EQ(Now(), At(15));
}

TEST_F(ShortJournal, ThatIsNoneOfOursIsRefusedByItsLine) {
  folder_.Write("work/prepare/journal.jsonl",
                "{\"kind\": \"begin\", \"revision\": \"many\", \"done\": [], \"undone\": [], "
                "\"ids\": {}, \"files\": []}\n{\"kind\": \"drop\", \"id\": \"undo\"}\n");
  EXPECT_THAT(InputErrorOf([&] { OpenShort(); }), HasSubstr("journal.jsonl:1: "));
}

// A process that moves the mark and says so, byte by byte, until it is killed.
TEST_F(ShortJournal, KilledAtAnyMomentHoldsWhatWasConfirmed) {
  std::mt19937 random(3);
  int confirmed = 0;
  for (int kill_count = 0; kill_count < 40; ++kill_count) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      OpenShort({4, 3, 5});
      for (int step = edit_->revision();; ++step) {
        if (!Move(step).is_done() || write(ends[1], "m", 1) != 1) _exit(1);
        if (step % 2 == 0) edit_->Save();
      }
    }
    close(ends[1]);
    char byte;
    for (int i = 0; i < 3; ++i) {  // however slow the machine is
      ASSERT_EQ(read(ends[0], &byte, 1), 1);
      ++confirmed;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 40000));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    while (read(ends[0], &byte, 1) == 1) ++confirmed;
    close(ends[0]);
    OpenShort({1000000, 3, 5});
    ASSERT_GE(edit_->revision(), confirmed);
    ASSERT_LE(edit_->revision(), confirmed + 1);
    ASSERT_EQ(Now(), At(edit_->revision()));
    confirmed = edit_->revision();
    Kill();
  }
  std::printf("%d operations, 40 kills\n", confirmed);
  EXPECT_GT(confirmed, 100);
}

}  // namespace
}  // namespace insitu
