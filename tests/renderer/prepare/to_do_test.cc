// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/to_do.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "reconstruction/editing/edited_tables.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/reconstruction/editing/edited_site.h"

namespace insitu {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class ToDoTest : public testing::Test {
 protected:
  ToDoTest() {
    for (const EditedTable& table : EditedTables()) {
      input_.tables[table.name] = Json::Value(Json::arrayValue);
    }
    input_.site.root = folder_.path();
    input_.adjusted = RowOf(R"({"photos": {}, "left_out": [], "diagnoses": [], "failed": null})");
  }

  // All that a montage needs.
  void Complete() {
    folder_.Write("building/house.dxf", "");
    folder_.Write("work/building.json", "");
    for (const char* table : {"control_points", "daylight"}) {
      for (int i = 0; i < 3; ++i) input_.tables[table].append(Json::objectValue);
    }
    for (const char* table : {"polygons", "horizon", "haze", "sun", "zenith"}) {
      input_.tables[table].append(RowOf(R"({"photo": "A"})"));
    }
    input_.tables["light"].append(RowOf(R"({"daylight_reflectance_rgb": [0.4, 0.4, 0.4]})"));
    input_.tables["site"].append(
        RowOf(R"({"latitude": 47, "local_time": "2024-05-15T09:45:00Z"})"));
  }

  std::vector<std::string> Texts() const {
    std::vector<std::string> texts;
    for (const Json::Value& item : ToDo(input_)) texts.push_back(item["text"].asString());
    return texts;
  }

  ScratchFolder folder_;
  ToDoInput input_;
};

TEST_F(ToDoTest, WhyTheAdjustmentFailsIsSaidInTheLanguageOfThePage) {
  Sentence("pointBehind", "point {point} lies behind photo {photo}",
           {{"point", "p"}, {"photo", "A"}})
      .SayIn(&input_.adjusted, "failed");
  const Json::Value items = ToDo(input_);
  EXPECT_EQ(items[0]["text"], "point p lies behind photo A");
  EXPECT_EQ(items[0]["text_said"]["key"], "pointBehind");
}

TEST_F(ToDoTest, ACompleteSiteIsReadyForItsMontage) {
  Complete();
  const Json::Value items = ToDo(input_);
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(items[0]["run"], "montage");
}

TEST_F(ToDoTest, AnEmptySurveyBeginsWithItsControlPoints) {
  const Json::Value items = ToDo(input_);
  EXPECT_EQ(items[0]["text"], "3 more control points");
  EXPECT_EQ(items[0]["where"]["table"], "control_points");
  for (const Json::Value& item : items) EXPECT_NE(item["run"], "montage");
}

TEST_F(ToDoTest, ALensComesBeforeAllElse) {
  input_.adjusted =
      RowOf(R"({"photos": {"A": {"needs_lens": true}}, "diagnoses": [], "failed": null,
    "left_out": [{"kind": "photo", "name": "A", "reason": "its lens is not known yet"}]})");
  EXPECT_EQ(ToDo(input_)[0]["run"], "exif-camera");
  folder_.Write("calibration/board.txt", "10 7 0.03");
  EXPECT_EQ(ToDo(input_)[0]["run"], "calibrate");
}

// Without a lens no point is determined: it is the lens that a person sees to, not point by point.
TEST_F(ToDoTest, PointsAreAskedForOnceALensIsKnown) {
  folder_.Write("calibration/board.txt", "10 7 0.03");
  input_.adjusted =
      RowOf(R"({"photos": {"A": {"needs_lens": true}}, "diagnoses": [], "failed": null,
    "left_out": [{"kind": "photo", "name": "A", "reason": "its lens is not known yet"},
                 {"kind": "point", "name": "roof", "reason": "no oriented photo sees it"}]})");
  const auto asks_for_point = [&] {
    const Json::Value items = ToDo(input_);
    return std::any_of(items.begin(), items.end(),
                       [](const Json::Value& item) { return item["where"]["point"] == "roof"; });
  };
  EXPECT_EQ(ToDo(input_)[0]["run"], "calibrate");
  EXPECT_FALSE(asks_for_point());
  input_.adjusted["photos"]["B"]["oriented"] = true;
  EXPECT_TRUE(asks_for_point());
}

TEST_F(ToDoTest, WithoutACameraFilmMayBeMeant) {
  input_.adjusted =
      RowOf(R"({"photos": {"A": {"needs_lens": true}}, "diagnoses": [], "failed": null,
    "left_out": [{"kind": "photo", "name": "A", "reason": "its lens is not known yet"}]})");
  const Json::Value items = ToDo(input_);
  EXPECT_EQ(items[1]["where"]["mode"], "film");
  EXPECT_EQ(items[1]["where"]["table"], "film");
}

TEST_F(ToDoTest, FilmAsksForItsCertificateThenForTheMarksOfEachScan) {
  Complete();
  input_.film = RowOf(R"({"folder": "calibration", "missing": [{"text": "the principal distance"}],
    "faults": [], "photos": {
      "A": {"needed": 3, "placed": 1, "unplaced": ["2", "3", "4"], "suspicions": [], "redundancy": 0},
      "B": {"needed": 3, "placed": 3, "unplaced": ["4"], "suspicions": [], "redundancy": 0},
      "C": {"needed": 3, "placed": 4, "unplaced": [], "redundancy": 2,
            "suspicions": [{"text": "marks 1 and 2 are exchanged"}]},
      "D": {"needed": 3, "placed": 4, "unplaced": [], "redundancy": 2, "usable": true,
            "suspicions": [{"text": "the marks fit to 1.20 px only"}]}}})");
  const Json::Value items = ToDo(input_);
  EXPECT_THAT(Texts(), ElementsAre("the film's certificate lacks: the principal distance",
                                   "A: fiducials to be placed (3): 2, 3, 4",
                                   "C: marks 1 and 2 are exchanged", "B: one more fiducial",
                                   "D: the marks fit to 1.20 px only"));
  EXPECT_EQ(items[0]["where"]["table"], "film");
  EXPECT_EQ(items[1]["where"]["photo"], "A");
  EXPECT_EQ(items[1]["where"]["fiducial"], "2");
  EXPECT_THAT(items[3]["why"].asString(), HasSubstr("cannot be checked"));
}

TEST_F(ToDoTest, CompleteFilmIsCalibratedAndAgainAfterAChange) {
  Complete();
  for (const char* file : {"calibration/film.json", "calibration/fiducials.csv"}) {
    folder_.Write(file, "");
  }
  input_.film = RowOf(R"({"folder": "calibration", "missing": [], "faults": [], "photos": {
      "A": {"needed": 3, "placed": 4, "unplaced": [], "suspicions": [], "redundancy": 2}}})");
  EXPECT_EQ(ToDo(input_)[0]["run"], "calibrate");
  const auto camera = folder_.Write("work/calibration/A/camera.cameramodel", "");
  EXPECT_EQ(ToDo(input_)[0]["run"], "montage");
  const auto changed = std::filesystem::last_write_time(camera) + std::chrono::seconds(1);
  std::filesystem::last_write_time(folder_.path() / "calibration/film.json", changed);
  EXPECT_EQ(ToDo(input_)[0]["text"], "calibrate the scans");
}

TEST_F(ToDoTest, WhatTakesNoPartIsNamedWithItsPlace) {
  Complete();
  input_.adjusted["left_out"] = RowOf(R"([
    {"kind": "photo", "name": "B", "reason": "needs one more control point"},
    {"kind": "point", "name": "roof", "photo": "A", "reason": "one ray"}])");
  const Json::Value items = ToDo(input_);
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0]["text"], "B: needs one more control point");
  EXPECT_EQ(items[0]["where"]["photo"], "B");
  EXPECT_EQ(items[1]["where"]["point"], "roof");
}

TEST_F(ToDoTest, ManyOfAKindAreCounted) {
  Complete();
  for (int i = 0; i < 30; ++i) {
    input_.adjusted["left_out"].append(
        RowOf(R"({"kind": "point", "name": "p", "reason": "one ray"})"));
  }
  EXPECT_EQ(Texts().back(), "and 22 more that take no part");
}

TEST_F(ToDoTest, WhatOnlyMakesItBetterStandsBehindTheMontage) {
  Complete();
  input_.tables["sun"].clear();
  EXPECT_THAT(Texts(), ElementsAre("make the montage", HasSubstr("a sun pair")));
}

TEST_F(ToDoTest, ControlThatNothingChecksIsToldWhereSomeCanBeSpared) {
  Complete();
  for (int i = 0; i < 2; ++i) input_.tables["control_points"].append(Json::objectValue);
  EXPECT_THAT(Texts(), ElementsAre("make the montage"));
  input_.tables["control_points"].append(Json::objectValue);
  EXPECT_THAT(Texts(), ElementsAre("make the montage", HasSubstr("check points: none is one")));
  input_.tables["control_points"][5]["role"] = "check";
  EXPECT_THAT(Texts(), ElementsAre("make the montage"));
}

TEST_F(ToDoTest, AFileAtFaultAndAGrossErrorComeFirst) {
  Complete();
  input_.file_faults = {Sentence::Verbatim("polygons.json:3: no such key")};
  input_.adjusted["diagnoses"] =
      RowOf(R"([{"kind": "misfit", "text": "x and y exchanged", "point": "p"},
    {"kind": "question", "text": "on purpose?"}])");
  EXPECT_THAT(Texts(), ElementsAre("polygons.json:3: no such key", "x and y exchanged"));
}

}  // namespace
}  // namespace insitu
