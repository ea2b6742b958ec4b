// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/stage_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

StageRecord ARecord() {
  return {.version = "1.0",
          .program_hash = "aa",
          .options = {"--frame=photo"},
          .inputs = {{"a.csv", "11"}, {"b.csv", ""}},
          .outputs = {{"work/x.json", "22"}},
          .seconds = 1.5,
          .warnings = {"little light"}};
}

TEST(StageRecord, ReturnsWhatWasWritten) {
  const ScratchFolder folder;
  const SitePaths site = {folder.path()};
  WriteStageRecord(site, "light", ARecord());
  const auto read = ReadStageRecord(site, "light");
  ASSERT_TRUE(read);
  EXPECT_THAT(WhatChanged(*read, ARecord()), IsEmpty());
  EXPECT_EQ(read->inputs, ARecord().inputs);
  EXPECT_EQ(read->seconds, 1.5);
  EXPECT_EQ(read->warnings, ARecord().warnings);
  RemoveStageRecord(site, "light");
  EXPECT_FALSE(ReadStageRecord(site, "light"));
}

TEST(StageRecord, OfAnotherVersionOrCutCountsAsNone) {
  const ScratchFolder folder;
  const SitePaths site = {folder.path()};
  folder.Write("work/stages/light.json", "{\"format\": \"insitu stage record\", \"version\": 99}");
  EXPECT_FALSE(ReadStageRecord(site, "light"));
  folder.Write("work/stages/light.json", "{\"format\": \"insi");
  EXPECT_FALSE(ReadStageRecord(site, "light"));
}

TEST(WhatChanged, NamesEachInput) {
  StageRecord now = ARecord();
  now.inputs = {{"a.csv", "12"}, {"b.csv", "13"}, {"c.csv", "14"}, {"d.csv", ""}};
  EXPECT_THAT(WhatChanged(ARecord(), now),
              ElementsAre("a.csv has changed", "b.csv is new", "c.csv is new"));
  EXPECT_THAT(WhatChanged(now, ARecord()),
              ElementsAre("a.csv has changed", "b.csv is gone", "c.csv is gone"));
}

TEST(WhatChanged, NamesOptionsProgramAndResults) {
  StageRecord now = ARecord();
  now.options.clear();
  EXPECT_THAT(WhatChanged(ARecord(), now), ElementsAre("its options are none, were --frame=photo"));
  now = ARecord();
  now.program_hash = "bb";
  EXPECT_THAT(WhatChanged(ARecord(), now), ElementsAre("its program was built anew"));
  now.version = "2.0";
  EXPECT_THAT(WhatChanged(ARecord(), now), ElementsAre("insitu is version 2.0, was 1.0"));
  now = ARecord();
  now.outputs["work/x.json"] = "23";
  EXPECT_THAT(WhatChanged(ARecord(), now), ElementsAre("work/x.json is not as it was written"));
  now.outputs.clear();
  EXPECT_THAT(WhatChanged(ARecord(), now), ElementsAre("work/x.json is missing"));
}

}  // namespace
}  // namespace insitu
