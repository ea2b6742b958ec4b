// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/stage_runs.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

// The test's own folder holds no insitu-convert, so a run ends at once with a line that says so.
TEST(StageRuns, TellsLinesThenTheStatus) {
  const ScratchFolder folder;
  std::vector<Json::Value> told;
  StageRuns runs({folder.path()}, [&](const Json::Value& message) { told.push_back(message); });
  EXPECT_EQ(runs.Start("convert"), 1);
  runs.End();
  ASSERT_EQ(told.size(), 2U);
  EXPECT_NE(told[0]["line"].asString().find("insitu-convert"), std::string::npos);
  EXPECT_EQ(told[1]["status"], 1);
  EXPECT_EQ(told[1]["stage"], "convert");
}

TEST(StageRuns, RefusesAStageThatIsNone) {
  const ScratchFolder folder;
  StageRuns runs({folder.path()}, [](const Json::Value&) {});
  EXPECT_THROW(runs.Start("paint"), InputError);
}

}  // namespace
}  // namespace insitu
