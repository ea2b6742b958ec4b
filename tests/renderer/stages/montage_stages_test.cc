// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/montage_stages.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "renderer/commands/commands.h"

namespace insitu {
namespace {

TEST(MontageStages, AreTheStagesThatHelpLists) {
  std::vector<std::string> listed, run;
  for (const Command& command : StageCommands()) listed.push_back(command.name);
  for (const MontageStage& stage : MontageStages()) run.push_back(stage.name);
  EXPECT_EQ(run, listed);
}

TEST(MontageStages, ComeAfterWhatTheyTakeResultsOf) {
  for (size_t i = 0; i < MontageStages().size(); ++i) {
    for (const std::string& before : MontageStages()[i].after) EXPECT_LT(StageNamed(before), i);
  }
}

TEST(MontageStages, RefusesANameThatIsNone) { EXPECT_THROW(StageNamed("paint"), InputError); }

}  // namespace
}  // namespace insitu
