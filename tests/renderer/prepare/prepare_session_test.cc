// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/prepare_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <condition_variable>
#include <csignal>
#include <mutex>
#include <vector>

#include "calibration/files/whole_file.h"
#include "calibration/lens/camera.h"
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
    const auto tell = [this](const std::string& text) {
      const std::lock_guard lock(mutex_);
      told_.push_back(RowOf(text));
      came_.notify_all();
    };
    session_ = std::make_unique<PrepareSession>(site_, tell, [this](const std::string& text) {
      const std::lock_guard lock(mutex_);
      warnings_ += text + "\n";
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

  std::string Warnings() {
    const std::lock_guard lock(mutex_);
    return warnings_;
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
  std::string warnings_;
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

TEST_F(PrepareSessionTest, FilmIsToldAtOnceWithEachMark) {
  Start();
  EXPECT_TRUE(session_->Site()["film"].isNull());
  const Json::Value row =
      RowOf(R"({"mark": "1", "x_mm": -28, "y_mm": 28, "photo": "A", "x": 1, "y": 1})");
  EXPECT_EQ(session_->Apply(ToJson(OneEdit("1", "fiducials", Json::Value(), row))).status, 200);
  EXPECT_EQ(Wait("film", 0)["photos"]["A"]["placed"], 1);
  Wait("saved", 1);
  EXPECT_EQ(ReadWhole(site_.boards() / "fiducials.csv"),
            "mark,x_mm,y_mm,photo,x,y\n1,-28,28,A,1,1\n");
}

TEST_F(PrepareSessionTest, FilmBesideAnotherCameraIsRefused) {
  folder_.Write("calibration/board_01.jpg", "");
  Start();
  const Json::Value row = RowOf(R"({"focal_mm": 60})");
  const auto answer = session_->Apply(ToJson(OneEdit("1", "film", Json::Value(), row)));
  EXPECT_EQ(answer.status, 400);
  EXPECT_THAT(answer.body["error"].asString(), HasSubstr("board_01.jpg is of another camera"));
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
  session_->TakeSite(RowOf(R"({"latitude": 1, "longitude": 8})"), "place");
  const Json::Value site = session_->Site()["tables"]["site"][0];
  EXPECT_EQ(site["latitude"], 47);
  EXPECT_EQ(site["longitude"], 8);
}

TEST_F(PrepareSessionTest, ASecondOneOnTheSameSiteIsRefused) {
  Start();
  EXPECT_THROW(PrepareSession(
                   site_, [](const std::string&) {}, [](const std::string&) {}),
               InputError);
}

TEST_F(PrepareSessionTest, AFileThatParsesNoMoreIsToldSoThatPagesLoadAnew) {
  Start();
  Wait("adjusted", 0);
  WriteWhole(site_.survey() / "polygons.json", "{\"polygons\": [");
  Wait("reload", 0);
  const Json::Value read_only = session_->Site()["read_only"];
  ASSERT_EQ(read_only.size(), 1U);
  EXPECT_EQ(read_only[0]["table"], "polygons");
  EXPECT_THAT(read_only[0]["file"].asString(), HasSubstr("polygons.json"));
  EXPECT_THAT(Warnings(), HasSubstr("survey/polygons.json:1: "));
}

// While it lives no file of this process grows, as on a full disk.
class FullDisk {
 public:
  FullDisk() {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit none = {0, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &none);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_ = {};
};

TEST_F(PrepareSessionTest, WhatTheJournalCannotTakeIsNotDone) {
  Start();
  Wait("adjusted", 0);
  const Json::Value operation = Mark("1", Json::nullValue, MarkOn("A", "p", 3, 2));
  {
    const FullDisk full;
    const auto answer = session_->Apply(operation);
    EXPECT_EQ(answer.status, 507);
    EXPECT_THAT(answer.body["error"].asString(), HasSubstr("journal.jsonl"));
    EXPECT_TRUE(session_->MarksOf("p").empty());
    session_->Apply(operation);  // a page asks again and again
    EXPECT_EQ(Warnings(), answer.body["error"].asString() + "\n");
  }
  EXPECT_EQ(session_->Apply(operation).status, 200);
  EXPECT_TRUE(session_->MarksOf("p").contains("A"));
}

TEST_F(PrepareSessionTest, APhotographOfAnotherSizeThanItsCamerasIsNamed) {
  std::filesystem::create_directories(site_.camera("").parent_path());
  const Camera camera = Camera::Pinhole(10, 10, 3.5, 2.5, 8, 6);
  WritePosedCamera(site_.camera(""), {"A", camera, {}}, "of photographs of 8 x 6 pixels");
  WritePng(site_.photos() / "B.png", Raster(10, 6, 3), Encoding::kSrgb8);
  Start();
  const Json::Value photos = Wait("adjusted", 0)["photos"];
  EXPECT_TRUE(photos["B"]["needs_lens"].asBool());
  EXPECT_THAT(photos["B"]["why"].asString(), HasSubstr("B.png: is 10x6 px, expected 8x6 px"));
  Wait("todo", 0);
  EXPECT_THAT(Warnings(), HasSubstr("B.png: is 10x6 px, expected 8x6 px"));
  EXPECT_FALSE(photos["A"].isMember("needs_lens"));
}

TEST_F(PrepareSessionTest, WhatCouldNotBeSavedIsSavedAndAdjustedLater) {
  using std::filesystem::perms;
  Start();
  session_->Apply(Mark("1", Json::nullValue, MarkOn("A", "p", 3, 2)));
  Wait("adjusted", 1);
  const std::filesystem::path file = site_.survey() / "observations.csv";
  std::filesystem::permissions(file, perms::owner_read);
  session_->Apply(Mark("2", Json::nullValue, MarkOn("B", "p", 4, 2)));
  EXPECT_THAT(Wait("not_saved", 0)["text"].asString(), HasSubstr("observations.csv"));
  EXPECT_EQ(session_->Site()["saved"], 1);
  std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
  Wait("saved", 2);
  EXPECT_THAT(ReadWhole(file), HasSubstr("B,p,4,2,0.5"));
  Wait("adjusted", 2);
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
