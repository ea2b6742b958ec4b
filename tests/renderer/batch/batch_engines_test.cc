// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/batch_engines.h"

#include <gtest/gtest.h>

#include "calibration/files/json_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

TEST(NumbersText, JoinsNeighbours) {
  EXPECT_EQ(NumbersText({}), "");
  EXPECT_EQ(NumbersText({4}), "4");
  EXPECT_EQ(NumbersText({0, 1, 2, 5, 7, 8}), "0-2,5,7-8");
}

TEST(WriteOpenJdTemplate, HasATaskForEachJobAndTheSheetAfterThem) {
  const ScratchFolder scratch;
  BatchPlan plan;
  plan.file = scratch.path() / "a plan.json";
  plan.site.root = scratch.path();
  const auto file =
      WriteOpenJdTemplate({.plan = plan, .numbers = {0, 1, 2, 5}, .program = "/bin/insitu-batch"});
  const Json::Value json = ReadJson(file);
  EXPECT_EQ(json["specificationVersion"], "jobtemplate-2023-09");
  const Json::Value& render = json["steps"][0];
  EXPECT_EQ(render["parameterSpace"]["taskParameterDefinitions"][0]["range"], "0-2,5");
  const Json::Value& run = render["script"]["actions"]["onRun"];
  EXPECT_EQ(run["command"], "/bin/insitu-batch");
  EXPECT_EQ(run["args"][0], plan.file.string());
  EXPECT_EQ(run["args"][2], "{{Task.Param.Job}}");
  EXPECT_EQ(json["steps"][1]["dependencies"][0]["dependsOn"], render["name"]);
}

}  // namespace
}  // namespace insitu
