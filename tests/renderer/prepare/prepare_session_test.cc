// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/prepare_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <vector>

#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "renderer/prepare/site_of_photos.h"
#include "tests/reconstruction/editing/edited_site.h"

namespace insitu {
namespace {

using testing::HasSubstr;

// A site of two photographs, and what its session tells.
class PrepareSessionTest : public testing::Test {
 protected:
  PrepareSessionTest() {
    site_.root = folder_.path();
    std::filesystem::create_directories(site_.photos());
    const Raster grey(8, 6, 3);
    for (const char* name : {"A.png", "B.png"}) {
      WritePng(site_.photos() / name, grey, Encoding::kSrgb8);
    }
  }

  void Start() {
    session_ = std::make_unique<PrepareSession>(site_, [this](const std::string& text) {
      const std::lock_guard lock(mutex_);
      told_.push_back(RowOf(text));
      came_.notify_all();
    });
  }

  // The first message of a type from a revision on.
  Json::Value Wait(const std::string& type, int revision) {
    std::unique_lock lock(mutex_);
    Json::Value found;
    const bool is_there = came_.wait_for(lock, std::chrono::seconds(20), [&] {
      for (const Json::Value& message : told_) {
        if (message["type"] != type || message["revision"].asInt() < revision) continue;
        found = message;
        return true;
      }
      return false;
    });
    EXPECT_TRUE(is_there) << type;
    return found;
  }

  static Json::Value Mark(const std::string& id, const Json::Value& before,
                          const Json::Value& after) {
    return ToJson(OneEdit(id, "observations", before, after));
  }

  ScratchFolder folder_;
  SitePaths site_;
  std::mutex mutex_;
  std::condition_variable came_;
  std::vector<Json::Value> told_;
  std::unique_ptr<PrepareSession> session_;
};

TEST_F(PrepareSessionTest, AnOperationIsConfirmedToldSavedAndAdjusted) {
  Start();
  const auto answer = session_->Apply(Mark("1", Json::nullValue, MarkOn("A", "p", 3, 2)));
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body["revision"], 1);
  EXPECT_EQ(Wait("op", 1)["operation"]["id"], "1");
  Wait("saved", 1);
  EXPECT_THAT(ReadWhole(site_.survey() / "observations.csv"), HasSubstr("A,p,3,2,0.5"));
  const Json::Value adjusted = Wait("adjusted", 1);
  EXPECT_FALSE(adjusted["photos"]["A"]["oriented"].asBool());
  EXPECT_TRUE(adjusted["photos"]["A"]["needs_lens"].asBool());
}

TEST_F(PrepareSessionTest, ARepeatedOperationCountsOnce) {
  Start();
  const Json::Value operation = Mark("1", Json::nullValue, MarkOn("A", "p", 3, 2));
  session_->Apply(operation);
  EXPECT_EQ(session_->Apply(operation).body["revision"], 1);
  EXPECT_EQ(session_->Site()["tables"]["observations"].size(), 1U);
}

TEST_F(PrepareSessionTest, AConflictShowsTheRowAsItIs) {
  Start();
  session_->Apply(Mark("1", Json::nullValue, MarkOn("A", "p", 3, 2)));
  const auto answer = session_->Apply(Mark("2", MarkOn("A", "p", 9, 9), MarkOn("A", "p", 1, 1)));
  EXPECT_EQ(answer.status, 409);
  EXPECT_EQ(answer.body["conflicts"][0]["current"]["x"].asDouble(), 3);
}

TEST_F(PrepareSessionTest, ARefusedRowSaysWhy) {
  Start();
  const auto answer = session_->Apply(Mark("1", Json::nullValue, MarkOn("C", "p", 3, 2)));
  EXPECT_EQ(answer.status, 400);
  EXPECT_THAT(answer.body["error"].asString(), HasSubstr("C"));
}

TEST_F(PrepareSessionTest, AMarkOffItsPhotographIsRefused) {
  Start();
  EXPECT_EQ(session_->Apply(Mark("1", Json::nullValue, MarkOn("A", "p", 7.5, 5.5))).status, 200);
  const auto answer = session_->Apply(Mark("2", Json::nullValue, MarkOn("A", "q", 7.6, 2)));
  EXPECT_EQ(answer.status, 400);
  EXPECT_THAT(answer.body["error"].asString(), HasSubstr("off photo A"));
  EXPECT_EQ(session_->Site()["revision"], 1);
}

TEST_F(PrepareSessionTest, ACameraPositionIsNoPixel) {
  Start();
  Json::Value row;
  row["photo"] = "A";
  row["x"] = 2600480.0;
  row["y"] = 1200300.0;
  row["z"] = 436.0;
  for (const char* sigma : {"sigma_x", "sigma_y", "sigma_z"}) row[sigma] = 0.02;
  row["role"] = "weighted";
  Json::Value operation = Mark("1", Json::nullValue, row);
  operation["edits"][0]["table"] = "camera_positions";
  EXPECT_EQ(session_->Apply(operation).status, 200);
}

TEST_F(PrepareSessionTest, UndoAndRedoAreToldAsSuch) {
  Start();
  session_->Apply(Mark("1", Json::nullValue, MarkOn("A", "p", 3, 2)));
  EXPECT_EQ(session_->Undo("2").status, 200);
  EXPECT_EQ(Wait("op", 2)["kind"], "undo");
  EXPECT_TRUE(session_->MarksOf("p").empty());
  EXPECT_EQ(session_->Redo("3").status, 200);
  EXPECT_TRUE(session_->MarksOf("p").contains("A"));
}

TEST_F(PrepareSessionTest, EndingItSavesWhatWasConfirmed) {
  Start();
  session_->Apply(Mark("1", Json::nullValue, MarkOn("A", "p", 3, 2)));
  session_.reset();
  EXPECT_THAT(ReadWhole(site_.survey() / "observations.csv"), HasSubstr("A,p,3,2,0.5"));
}

TEST_F(PrepareSessionTest, PlaceAndTimeFromElsewhereLeaveWhatIsStatedAlone) {
  WriteWhole(site_.description(), R"({"name": "mine", "latitude": 47})");
  Start();
  session_->TakeSite(RowOf(R"({"latitude": 1, "longitude": 8})"));
  const Json::Value site = session_->Site()["tables"]["site"][0];
  EXPECT_EQ(site["latitude"], 47);
  EXPECT_EQ(site["longitude"], 8);
}

TEST_F(PrepareSessionTest, ASecondOneOnTheSameSiteIsRefused) {
  Start();
  EXPECT_THROW(PrepareSession(site_, [](const std::string&) {}), InputError);
}

TEST(MakeSiteOfPhotographs, LinksThePhotographsOfAPlainFolder) {
  const ScratchFolder folder;
  const SitePaths site{folder.path()};
  WritePng(folder.path() / "one.png", Raster(4, 4, 3), Encoding::kSrgb8);
  folder.Write("notes.txt", "not a photograph");
  EXPECT_EQ(MakeSiteOfPhotographs(site), 1);
  EXPECT_TRUE(std::filesystem::equivalent(folder.path() / "one.png", site.photos() / "one.png"));
  EXPECT_EQ(MakeSiteOfPhotographs(site), 0);
}

TEST(MakeSiteOfPhotographs, AFolderOfNothingIsRefused) {
  const ScratchFolder folder;
  EXPECT_THROW(MakeSiteOfPhotographs({folder.path()}), InputError);
}

TEST(MergeColleague, TakesInWhatIsNewAndTellsWhatDiffers) {
  const ScratchFolder both;
  const SitePaths ours{both.path() / "ours"}, theirs{both.path() / "theirs"};
  const std::string header = "photo,point,x,y,sigma\n";
  for (const SitePaths* site : {&ours, &theirs}) {
    std::filesystem::create_directories(site->photos());
    std::filesystem::create_directories(site->survey());
    WritePng(site->photos() / "A.png", Raster(4, 4, 3), Encoding::kSrgb8);
  }
  WriteWhole(ours.survey() / "observations.csv", header + "A,p,1,1,0.1\n");
  WriteWhole(theirs.survey() / "observations.csv", header + "A,p,3,3,0.1\nA,q,2,2,0.1\n");
  const std::string told = MergeColleague(ours, theirs);
  EXPECT_THAT(told, HasSubstr("1 rows taken in, 1 differ"));
  EXPECT_EQ(ReadWhole(ours.survey() / "observations.csv"), header + "A,p,1,1,0.1\nA,q,2,2,0.1\n");
}

}  // namespace
}  // namespace insitu
