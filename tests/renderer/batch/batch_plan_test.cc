// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/batch_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class BatchPlanTest : public testing::Test {
 protected:
  BatchPlanTest() {
    for (const char* photo : {"IMG_1.jpg", "IMG_2.png"}) {
      scratch_.Write(std::string("site/photos/") + photo, "");
    }
    scratch_.Write("site/variants/tower/model.obj", "");
    scratch_.Write("site/variants/low/model.obj", "");
  }
  std::filesystem::path Write(const std::string& text) const {
    return scratch_.Write("plans/evening.json", text);
  }
  // Of a plan of one key, at its line.
  std::string FaultOf(const std::string& member) const {
    const auto file = Write("{\"site\": \"../site\",\n" + member + "}\n");
    const std::string fault = InputErrorOf([&] { ReadBatchPlan(file); });
    EXPECT_THAT(fault, StartsWith(file.string() + ":2: ")) << member;
    return fault;
  }

  ScratchFolder scratch_;
};

TEST_F(BatchPlanTest, WhatIsMissingIsEveryPhotographOnceAsItIs) {
  const BatchPlan plan = ReadBatchPlan(Write(R"({"site": "../site"})"));
  EXPECT_EQ(plan.site.root, (scratch_.path() / "site").lexically_normal());
  EXPECT_THAT(plan.views, ElementsAre("IMG_1", "IMG_2"));
  EXPECT_THAT(plan.variants, ElementsAre(""));
  EXPECT_THAT(plan.qualities, ElementsAre("final"));
  ASSERT_EQ(plan.hours.size(), 1U);
  EXPECT_TRUE(plan.hours[0].is_measured());
  EXPECT_EQ(plan.sheet(), plan.site.root / "montages/evening.sheet.html");
}

TEST_F(BatchPlanTest, ReadsAllOfIt) {
  const BatchPlan plan = ReadBatchPlan(Write(R"({
    "comment": "for the jury", "site": "../site", "views": ["IMG_2"],
    "variants": ["tower", "building"],
    "hours": ["measured", "16:30", {"azimuth_deg": 180, "elevation_deg": 30}],
    "qualities": ["fast", "final"], "options": ["--grain"]})"));
  EXPECT_THAT(plan.views, ElementsAre("IMG_2"));
  EXPECT_THAT(plan.variants, ElementsAre("tower", ""));
  ASSERT_EQ(plan.hours.size(), 3U);
  EXPECT_EQ(plan.hours[1].request.time, "16:30");
  EXPECT_NEAR(plan.hours[2].request.sun->azimuth, M_PI, 1e-12);
  EXPECT_THAT(plan.qualities, ElementsAre("fast", "final"));
  EXPECT_THAT(plan.options, ElementsAre("--grain"));
}

TEST_F(BatchPlanTest, NamesWhatThereIsNot) {
  EXPECT_THAT(FaultOf(R"("views": ["IMG_3"])"),
              HasSubstr("is \"IMG_3\", no photograph, expected one of IMG_1, IMG_2"));
  EXPECT_THAT(FaultOf(R"("variants": ["towr"])"),
              HasSubstr("is \"towr\", no variant, expected one of building, low, tower"));
  EXPECT_THAT(FaultOf(R"("variants": ["../.."])"), HasSubstr("no variant"));
  EXPECT_THAT(FaultOf(R"("qualities": ["best"])"),
              HasSubstr("is \"best\", no quality, expected one of fast, draft, final, avr0"));
  EXPECT_THAT(FaultOf(R"("hours": ["teatime"])"), HasSubstr("no time, expected for example 16:30"));
  EXPECT_THAT(FaultOf(R"("options": ["--photo=IMG_1"])"), HasSubstr("is \"--photo=IMG_1\", "));
  EXPECT_THAT(FaultOf(R"("options": ["grain"])"), HasSubstr("expected options of insitu-render"));
  EXPECT_THAT(FaultOf(R"("view": ["IMG_1"])"), HasSubstr("is no key of a plan"));
}

TEST_F(BatchPlanTest, RefusesEmptyListsAndWhatIsNamedTwice) {
  for (const char* key : {"views", "variants", "hours", "qualities"}) {
    EXPECT_THAT(FaultOf('"' + std::string(key) + "\": []"), HasSubstr("is empty")) << key;
  }
  EXPECT_THAT(FaultOf(R"("views": ["IMG_1", "IMG_1"])"), HasSubstr("named twice"));
  EXPECT_THAT(FaultOf(R"("hours": ["16:30", "16:30"])"), HasSubstr("named twice"));
}

TEST_F(BatchPlanTest, RefusesASunWhoseLightCannotBeSimulated) {
  EXPECT_THAT(FaultOf(R"("hours": [{"azimuth_deg": 180, "elevation_deg": 1}])"),
              HasSubstr("expected 3 to 90"));
  EXPECT_THAT(FaultOf(R"("hours": [{"azimuth_deg": 400, "elevation_deg": 30}])"),
              HasSubstr("expected 0 to 360"));
  EXPECT_THAT(FaultOf(R"("hours": [{"azimuth_deg": 180}])"), HasSubstr("elevation_deg"));
  EXPECT_THAT(FaultOf(R"("hours": [16.5])"), HasSubstr("hours"));
}

TEST_F(BatchPlanTest, RefusesADamagedPlanAndAFolderThatIsNoSite) {
  EXPECT_THROW(ReadBatchPlan(Write("")), InputError);
  EXPECT_THROW(ReadBatchPlan(Write(R"({"site": "../site", "views": ["IM)")), InputError);
  EXPECT_THROW(ReadBatchPlan(Write("[]")), InputError);
  EXPECT_THAT(InputErrorOf([&] { ReadBatchPlan(Write("{}")); }), HasSubstr("is no site's folder"));
}

}  // namespace
}  // namespace insitu
