// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "reconstruction/editing/site_edit.h"
#include "tests/reconstruction/editing/edited_site.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using SiteEditOutsideTest = EditedSite;

TEST_F(SiteEditOutsideTest, TakesInWhatOthersWrite) {
  Open();
  Apply("1", "observations", MarkOn("A", "p", 1.5, 2), MarkOn("A", "p", 1.5, 8));
  folder_.Write("survey/observations.csv",
                "photo,point,x,y,sigma\n# theirs\nA,p,1.50,2,0.5\nB,p,5.5,6,0.5\nB,q,7,8,0.5\n");
  const SaveReport report = edit_->Save();
  EXPECT_TRUE(report.is_saved());
  ASSERT_EQ(report.outside.operations.size(), 1u);
  EXPECT_EQ(report.outside.operations[0].edits.size(), 3u);
  EXPECT_THAT(report.outside.conflicts, IsEmpty());
  EXPECT_EQ(Marks(),
            "photo,point,x,y,sigma\n# theirs\nA,p,1.50,8,0.5\nB,p,5.5,6,0.5\nB,q,7,8,0.5\n");
  EXPECT_EQ(edit_->revision(), 2);
  EXPECT_EQ(edit_->saved_revision(), 2);
  EXPECT_TRUE(edit_->Undo("2").is_done());  // ours, not theirs
  EXPECT_TRUE(edit_->Save().is_saved());
  EXPECT_EQ(Marks(),
            "photo,point,x,y,sigma\n# theirs\nA,p,1.50,2,0.5\nB,p,5.5,6,0.5\nB,q,7,8,0.5\n");
}

TEST_F(SiteEditOutsideTest, WhereBothChangedARowTheirsStandsAndOursIsToldAndKept) {
  Open();
  Apply("1", "observations", MarkOn("A", "p", 1.5, 2), MarkOn("A", "p", 1.5, 8));
  folder_.Write("survey/observations.csv", Replaced(kMarks, "1.50,2", "1.50,9"));
  const SaveReport report = edit_->Save();
  ASSERT_EQ(report.outside.conflicts.size(), 1u);
  EXPECT_EQ(report.outside.conflicts[0].before["y"], 2.0);
  EXPECT_EQ(report.outside.conflicts[0].current["y"], 9.0);
  EXPECT_EQ(report.outside.conflicts[0].after["y"], 8.0);
  EXPECT_EQ(Marks(), Replaced(kMarks, "1.50,2", "1.50,9"));
  EXPECT_THAT(Content("work/prepare/journal.jsonl"), HasSubstr("\"y\": 8"));
  EXPECT_FALSE(edit_->Undo("2").is_done());
  EXPECT_THAT(edit_->ToUndo(), testing::Eq(std::nullopt));  // it can no more be undone
  EXPECT_TRUE(
      Apply("3", "observations", MarkOn("A", "p", 1.5, 9), MarkOn("A", "p", 1.5, 8)).is_done());
}

TEST_F(SiteEditOutsideTest, RefreshSeesChangesOfOtherFilesToo) {
  Open();
  EXPECT_THAT(edit_->Refresh().operations, IsEmpty());
  folder_.Write("survey/observations.csv", Replaced(kMarks, "3,4", "3,5"));
  folder_.Write("survey/directions.json", R"({"sun": [{"shadow": "p", "object": "q"}]})");
  folder_.Write("site.json", R"({"name": "n"})");
  const OutsideChanges changes = edit_->Refresh();
  EXPECT_EQ(changes.operations.size(), 3u);
  EXPECT_EQ(edit_->Rows("site")[0]["name"], "n");
  EXPECT_EQ(edit_->Rows("sun").size(), 1u);
  EXPECT_TRUE(edit_->is_saved());
  EXPECT_THAT(edit_->Refresh().operations, IsEmpty());
  Reopen();
  EXPECT_EQ(edit_->revision(), 3);
  EXPECT_THAT(edit_->found().operations, IsEmpty());
}

TEST_F(SiteEditOutsideTest, ARemovedFileIsWrittenAgain) {
  Open();
  Apply("1", "observations", none_, MarkOn("B", "q", 1, 2));
  edit_->Save();
  const std::string saved = Marks();
  fs::remove(site_.survey() / "observations.csv");
  EXPECT_EQ(edit_->Refresh().remarks.size(), 1u);
  EXPECT_TRUE(edit_->Save().is_saved());
  EXPECT_EQ(Marks(), saved);
  Kill();
  fs::remove(site_.survey() / "observations.csv");
  Open();
  EXPECT_EQ(edit_->found().remarks.size(), 1u);
  EXPECT_TRUE(edit_->Save().is_saved());
  EXPECT_EQ(Marks(), saved);
}

TEST_F(SiteEditOutsideTest, MergesAColleaguesSurvey) {
  const ScratchFolder& other = folder_;
  other.Write("other/survey/observations.csv",
              "photo,point,x,y,sigma\nA,p,2.5,2,0.5\nA,q,9,4,0.5\nB,q,7,8,0.5\nC,q,7,8,0.5\n");
  other.Write("other/survey/polygons.json", Replaced(kPolygons, "\"m\"", "\"stone\""));
  other.Write("other/survey/directions.json", "{\"sun\": 1}");
  Open();
  const auto report = edit_->Merge({other.path() / "other"}, "merge 1");
  ASSERT_TRUE(report.outcome.operation);
  EXPECT_EQ(report.outcome.operation->edits.size(), 1u);
  ASSERT_EQ(report.conflicts.size(), 2u);
  EXPECT_EQ(report.conflicts[0].current["x"], 3.0);
  EXPECT_EQ(report.conflicts[0].after["x"], 9.0);
  EXPECT_EQ(report.conflicts[1].table, "polygons");
  EXPECT_EQ(report.remarks.size(), 2u);  // photo C, the broken file
  EXPECT_EQ(edit_->Rows("observations").size(), 4u);
  EXPECT_TRUE(edit_->Undo("2").is_done());
}

}  // namespace
}  // namespace insitu
