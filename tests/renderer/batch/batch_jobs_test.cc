// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/batch_jobs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

BatchPlan Plan(const ScratchFolder& scratch) {
  BatchPlan plan;
  plan.file = scratch.path() / "plan.json";
  plan.site.root = scratch.path();
  plan.views = {"a", "b"};
  plan.variants = {"", "tower"};
  plan.qualities = {"draft", "final"};
  plan.options = {"--grain"};
  return plan;
}

TEST(JobsOf, AreAllCombinationsInOrder) {
  const ScratchFolder scratch;
  const auto jobs = JobsOf(Plan(scratch), {"", "1630"});
  ASSERT_EQ(jobs.size(), 16U);
  EXPECT_EQ(jobs[0].Name(), "a~draft");
  EXPECT_EQ(jobs[1].Name(), "a");
  EXPECT_EQ(jobs[3].Name(), "a@1630");
  EXPECT_EQ(jobs[14].Name(), "tower/b@1630~draft");
  EXPECT_THAT(jobs[14].options, testing::ElementsAre("--grain", "--photo=b", "--variant=tower",
                                                     "--hour=1630", "--quality=draft", "--beside"));
  EXPECT_THAT(jobs[1].options, testing::ElementsAre("--grain", "--photo=a"));
}

TEST(JobsOf, ALevelOfTheBuildingIsAQuality) {
  const ScratchFolder scratch;
  BatchPlan plan = Plan(scratch);
  plan.qualities = {"avr1"};
  const BatchJob job = JobsOf(plan, {""})[0];
  EXPECT_EQ(job.Name(), "a~avr1");
  EXPECT_THAT(job.options, testing::ElementsAre("--grain", "--photo=a", "--avr=1"));
}

TEST(JobsOf, NoTwoWriteTheSameFile) {
  const ScratchFolder scratch;
  const BatchPlan plan = Plan(scratch);
  std::set<std::filesystem::path> stems;
  for (const BatchJob& job : JobsOf(plan, {"", "1630"})) {
    EXPECT_TRUE(stems.insert(job.PathsIn(plan.site).montage(job.view)).second) << job.Name();
  }
}

TEST(WriteJobs, ReadBackAsTheyWere) {
  const ScratchFolder scratch;
  auto jobs = JobsOf(Plan(scratch), {"", "1630"});
  jobs[3].inputs = {{"work/environment.json", "ab12"}, {"survey/a \"name\"\n.csv", ""}};
  const auto file = scratch.path() / "jobs.jsonl";
  WriteJobs(file, jobs);
  const auto back = ReadJobs(file);
  ASSERT_EQ(back.size(), jobs.size());
  for (size_t i = 0; i < jobs.size(); ++i) {
    EXPECT_EQ(back[i].Name(), jobs[i].Name());
    EXPECT_EQ(back[i].options, jobs[i].options);
    EXPECT_EQ(back[i].inputs, jobs[i].inputs);
  }
  EXPECT_EQ(std::ranges::count(ReadWhole(file), '\n'), std::ssize(jobs));
}

TEST(ReadJobs, TellsTheLineThatIsDamaged) {
  const ScratchFolder scratch;
  const auto file = scratch.path() / "jobs.jsonl";
  WriteJobs(file, JobsOf(Plan(scratch), {""}));
  const std::string text = ReadWhole(file);
  for (const std::string& damaged :
       {text.substr(0, text.size() - 20), text + "[1]\n", text + "{\"view\": 3}\n"}) {
    scratch.Write("jobs.jsonl", damaged);
    EXPECT_THROW(ReadJobs(file), InputError) << damaged;
  }
  scratch.Write("jobs.jsonl", "{}\n");
  EXPECT_EQ(InputErrorOf([&] { ReadJobs(file); }),
            file.string() + ":1: is no job as insitu-batch writes it, expected one a line");
}

TEST(ReadOutcome, IsWhatWasWritten) {
  const ScratchFolder scratch;
  const BatchPlan plan = Plan(scratch);
  const BatchJob job = JobsOf(plan, {""})[2];
  EXPECT_FALSE(ReadOutcome(plan.site, job));
  WriteOutcome(plan.site, job, {.status = 137, .seconds = 2.5, .message = "m", .warnings = {"w"}});
  const auto outcome = ReadOutcome(plan.site, job);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->status, 137);
  EXPECT_EQ(outcome->seconds, 2.5);
  EXPECT_EQ(outcome->message, "m");
  EXPECT_THAT(outcome->warnings, testing::ElementsAre("w"));
}

}  // namespace
}  // namespace insitu
