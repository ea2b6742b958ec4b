// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/site_edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <filesystem>

#include "tests/reconstruction/editing/edited_site.h"
#include "tests/shared_data.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using SiteEditTest = EditedSite;

TEST_F(SiteEditTest, OpeningAndSavingChangesNothing) {
  const auto before = Contents();
  Open();
  EXPECT_TRUE(edit_->is_saved());
  EXPECT_THAT(edit_->Save().written, IsEmpty());
  EXPECT_EQ(Contents(), before);
  EXPECT_EQ(edit_->Tables()["observations"].size(), 3u);
  EXPECT_EQ(edit_->Tables()["sun"].size(), 0u);
  EXPECT_EQ(edit_->revision(), 0);
}

TEST_F(SiteEditTest, OpensASiteOfPhotosOnly) {
  fs::remove_all(site_.survey());
  Open();
  EXPECT_TRUE(Apply("1", "observations", none_, MarkOn("A", "p", 1, 2)).is_done());
  EXPECT_TRUE(Apply("2", "drafts", none_, RowOf(R"({"id": "d", "kind": "polygon"})")).is_done());
  EXPECT_THAT(edit_->Save().written, ElementsAre("survey/observations.csv", "survey/drafts.json"));
  EXPECT_EQ(Marks(), "photo,point,x,y,sigma\nA,p,1,2,0.5\n");
  EXPECT_TRUE(edit_->Undo("3").is_done());
  EXPECT_TRUE(edit_->Undo("4").is_done());
  EXPECT_TRUE(edit_->Save().is_saved());
  EXPECT_FALSE(fs::exists(site_.survey() / "observations.csv"));
}

TEST_F(SiteEditTest, ASecondOneIsRefused) {
  Open();
  EXPECT_THAT(InputErrorOf([&] { SiteEdit(site_, {}); }), HasSubstr("in use by insitu-prepare"));
}

TEST_F(SiteEditTest, AnIdCountsOnceAlsoAfterARestart) {
  Open();
  EXPECT_EQ(Apply("1", "observations", none_, MarkOn("B", "q", 1, 2)).revision, 1);
  Reopen();
  const EditOutcome again = Apply("1", "observations", none_, MarkOn("B", "q", 1, 2));
  EXPECT_TRUE(again.is_done() && again.is_repeated);
  EXPECT_EQ(again.revision, 1);
  EXPECT_EQ(edit_->Rows("observations").size(), 4u);
  EXPECT_TRUE(edit_->Undo("2").is_done());
  EXPECT_TRUE(edit_->Undo("2").is_repeated);
}

TEST_F(SiteEditTest, ConflictsNameTheCurrentRowAndLeaveAllAsItWas) {
  Open();
  Operation operation{"1", "two", {}};
  operation.edits.push_back({"observations", none_, MarkOn("B", "q", 1, 2)});
  operation.edits.push_back({"observations", MarkOn("A", "p", 9, 2), MarkOn("A", "p", 1, 1)});
  operation.edits.push_back({"observations", none_, MarkOn("A", "q", 1, 1)});
  const EditOutcome outcome = edit_->Apply(operation);
  ASSERT_EQ(outcome.conflicts.size(), 2u);
  EXPECT_EQ(outcome.conflicts[0].current["x"], 1.5);
  EXPECT_EQ(outcome.conflicts[1].current["y"], 4.0);
  EXPECT_EQ(edit_->Rows("observations").size(), 3u);
  EXPECT_EQ(edit_->revision(), 0);
  EXPECT_FALSE(Apply("2", "observations", MarkOn("C", "p", 1, 1), none_).is_done());
}

TEST_F(SiteEditTest, RefusesRowsThatNoProgramWouldRead) {
  Open();
  const auto refusal = [&](const std::string& table, const std::string& row) {
    const EditOutcome outcome = Apply("x", table, none_, RowOf(row));
    EXPECT_EQ(outcome.revision, 0);
    return outcome.refused.text();
  };
  const auto mark = [&](const std::string& point, const std::string& rest) {
    return refusal("observations", R"({"photo": "A", "point": ")" + point + "\"," + rest + "}");
  };
  const std::string fine = R"("x": 1, "y": 2, "sigma": 1)";
  EXPECT_THAT(mark(" a", fine), HasSubstr("blank"));
  EXPECT_THAT(mark("a\\tb", fine), HasSubstr("control character"));
  EXPECT_THAT(mark("tie_000001", fine), HasSubstr("tie points"));
  EXPECT_THAT(mark("", fine), HasSubstr("empty"));
  EXPECT_THAT(mark("a", R"("x": 1, "y": 2, "sigma": 0)"), HasSubstr("more than 0"));
  EXPECT_THAT(mark("a", R"("x": "1", "y": 2, "sigma": 1)"), HasSubstr("no number"));
  EXPECT_THAT(mark("a", R"("x": -3, "y": 2, "sigma": 1)"), HasSubstr("outside any photograph"));
  EXPECT_THAT(mark("a", fine + R"(, "state": "maybe")"), HasSubstr("on or off or dubious"));
  EXPECT_THAT(mark("a", fine + R"(, "colour": "red")"), HasSubstr("no column \"colour\""));
  EXPECT_THAT(
      refusal("observations", R"({"photo": "C", "point": "a", "x": 1, "y": 2, "sigma": 1})"),
      HasSubstr("'C' is not in the folder photos"));
  EXPECT_THAT(refusal("control_points", R"({"name": "a", "x": 1, "y": 2, "z": 3, "sigma_x": 1,
      "sigma_y": 1, "sigma_z": 1, "role": "tie"})"),
              HasSubstr("control or check"));
  EXPECT_THAT(refusal("polygons", R"({"name": "v", "vertices": ["a", "b", "a"], "material": "m"})"),
              HasSubstr("distinct"));
  EXPECT_THAT(refusal("polygons", R"({"name": "v", "vertices": ["a", "b", "c"], "material": "m",
      "colour": 1})"),
              HasSubstr("no key"));
  const auto holes = [&](const std::string& text) {
    return refusal("polygons", R"({"name": "v", "vertices": ["a", "b", "c"], "material": "m", )" +
                                   ("\"holes\": " + text + "}"));
  };
  EXPECT_THAT(holes(R"(["d", "e", "f"])"), HasSubstr("a hole has not three vertices"));
  EXPECT_THAT(holes(R"([["d", "e"]])"), HasSubstr("a hole has not three vertices"));
  EXPECT_THAT(holes(R"([["d", "e", "a"]])"), HasSubstr("vertex \"a\" occurs twice"));
  EXPECT_THAT(holes(R"([["d", "e", "f"], ["g", "h", "d"]])"),
              HasSubstr("vertex \"d\" occurs twice"));
  EXPECT_THAT(holes(R"([["d", "e", 1]])"), HasSubstr("no name"));
  EXPECT_THAT(refusal("sun", R"({"shadow": "a", "object": "a"})"), HasSubstr("same point"));
  EXPECT_THAT(refusal("constraints", R"({"kind": "distance", "points": ["a", "b"], "value_m": -1,
      "sigma_m": 1})"),
              HasSubstr("more than 0"));
  EXPECT_THAT(refusal("edge", "{}"), HasSubstr("no table"));
}

// Names of any letters: in quotes where a comma, a quote or a leading # asks for it.
TEST_F(SiteEditTest, NamesThatNeedQuotesAreQuoted) {
  const auto before = Contents();
  Open();
  for (const std::string name : {"a,b", "#a", "5\" pipe"}) {
    const Json::Value mark = MarkOn("B", name, 7, 8);
    EXPECT_EQ(Apply("add " + name, "observations", none_, mark).refused.text(), "") << name;
    edit_->Save();
    Reopen();
    EXPECT_EQ(Apply("move " + name, "observations", mark, MarkOn("B", name, 9, 8)).refused.text(),
              "")
        << name;
  }
  edit_->Save();
  for (const std::string row :
       {"B,\"a,b\",9,8,0.5", "B,\"#a\",9,8,0.5", "B,\"5\"\" pipe\",9,8,0.5"}) {
    EXPECT_THAT(Marks(), HasSubstr(row));
  }
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(edit_->Undo("u" + std::to_string(i)).is_done());
  edit_->Save();
  EXPECT_EQ(Contents(), before);
}

TEST_F(SiteEditTest, UndoAllAndRedoAllGiveTheSameBytesAcrossSavesAndRestarts) {
  const auto before = Contents();
  Open();
  Apply("1", "observations", MarkOn("A", "p", 1.5, 2), none_);
  edit_->Save();
  Apply("2", "observations", MarkOn("A", "q", 3, 4), MarkOn("A", "q", 3, 4, "dubious"));
  Apply("3", "polygons", RowOf(kPolygons)["polygons"][0], none_);
  edit_->Save();
  Reopen();
  Apply("4", "zenith", none_, RowOf(R"({"bottom": "p", "top": "q"})"));
  Apply("5", "observations", MarkOn("B", "p", 5, 6), MarkOn("B", "p", 5, 6, "off"));
  edit_->Save();
  const auto after = Contents();
  EXPECT_EQ(Marks(),
            "photo,point,x,y,sigma,state\n# left\nA,q,3,4,0.5,dubious\n\n"
            "#off B,p,5,6,0.5,\n");
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(edit_->Undo("u" + std::to_string(i)).is_done());
    if (i % 2 == 0) edit_->Save();
    if (i == 3) Reopen();
  }
  EXPECT_FALSE(edit_->Undo("more").is_done());
  edit_->Save();
  EXPECT_EQ(Contents(), before);
  EXPECT_EQ(edit_->ToRedo(), "label of 1");
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(edit_->Redo("r" + std::to_string(i)).is_done());
  edit_->Save();
  EXPECT_EQ(Contents(), after);
}

TEST_F(SiteEditTest, AFileThatDoesNotParseIsReadOnlyUntilMended) {
  folder_.Write("survey/polygons.json", "{\n\"polygons\": [}\n");
  Open();
  ASSERT_EQ(edit_->read_only().size(), 1u);
  EXPECT_EQ(edit_->read_only()[0].table, "polygons");
  EXPECT_EQ(edit_->read_only()[0].fault.file, "survey/polygons.json");
  EXPECT_EQ(edit_->read_only()[0].fault.line, 2);
  EXPECT_THAT(edit_->read_only()[0].fault.text.text(), HasSubstr("not valid JSON"));
  const Json::Value polygon = RowOf(kPolygons)["polygons"][0];
  EXPECT_THAT(Apply("1", "polygons", none_, polygon).refused.text(), HasSubstr("polygons.json:2:"));
  folder_.Write("survey/polygons.json", kPolygons);
  EXPECT_THAT(edit_->Refresh().reread, ElementsAre("survey/polygons.json"));
  EXPECT_THAT(edit_->read_only(), IsEmpty());
  EXPECT_TRUE(Apply("2", "polygons", polygon, none_).is_done());
  folder_.Write("survey/polygons.json", "{\"polygons\": [");  // an editor saves half a file
  EXPECT_FALSE(edit_->Save().is_saved());
  EXPECT_EQ(edit_->read_only().size(), 1u);
  EXPECT_THAT(edit_->Rows("polygons"), IsEmpty());  // ours, as it is in the journal
  folder_.Write("survey/polygons.json", kPolygons);
  edit_->Refresh();
  EXPECT_TRUE(edit_->Save().is_saved());
  EXPECT_EQ(Content("survey/polygons.json"), "{\"polygons\": []}\n");
}

TEST_F(SiteEditTest, HoldsWhatWasConfirmedAfterAKill) {
  Open();
  Apply("1", "observations", MarkOn("A", "p", 1.5, 2), MarkOn("A", "p", 1.5, 8));
  edit_->Save();
  Apply("2", "observations", none_, MarkOn("B", "q", 1, 2));
  Apply("3", "zenith", none_, RowOf(R"({"bottom": "p", "top": "q"})"));
  edit_->Undo("4");
  const Json::Value tables = edit_->Tables();
  Kill();
  folder_.Write("survey/observations.csv", Replaced(Marks(), "5,6", "5,7"));  // meanwhile
  Open();
  EXPECT_FALSE(edit_->is_saved());
  EXPECT_EQ(edit_->saved_revision(), 1);
  EXPECT_EQ(edit_->found().operations.size(), 1u);
  EXPECT_TRUE(edit_->Save().is_saved());
  EXPECT_EQ(Marks(),
            "photo,point,x,y,sigma\n# left\nA,p,1.50,8,0.5\nA,q,3,4,0.5\n\n"
            "B,p,5,7,0.5\nB,q,1,2,0.5\n");
  EXPECT_EQ(edit_->ToRedo(), "label of 3");
}

TEST_F(SiteEditTest, AKillBetweenTheFileAndItsCopyTakesNothingTwice) {
  Open();
  const std::string copy = "work/prepare/files/observations.csv";
  Apply("1", "observations", none_, MarkOn("B", "q", 1, 2));
  const std::string old = Content(copy);
  edit_->Save();
  Kill();
  folder_.Write(copy, old);
  Open();
  EXPECT_TRUE(edit_->is_saved());
  EXPECT_EQ(edit_->revision(), 1);
  EXPECT_EQ(edit_->Rows("observations").size(), 4u);
  Kill();
  folder_.Write(copy, old);
  folder_.Write("survey/observations.csv", Replaced(Marks(), "5,6", "5,7"));
  Open();
  EXPECT_THAT(edit_->found().conflicts, IsEmpty());
  ASSERT_EQ(edit_->found().operations.size(), 1u);
  EXPECT_EQ(edit_->found().operations[0].edits.size(), 1u);
  EXPECT_TRUE(edit_->is_saved());
}

TEST_F(SiteEditTest, AReadOnlyFileIsAFaultAndStaysToBeSaved) {
  Open();
  const fs::path file = site_.survey() / "observations.csv";
  fs::permissions(file, fs::perms::owner_read);
  Apply("1", "observations", none_, MarkOn("B", "q", 1, 2));
  const SaveReport report = edit_->Save();
  ASSERT_EQ(report.faults.size(), 1u);
  EXPECT_EQ(report.faults[0].file, "survey/observations.csv");
  EXPECT_THAT(report.faults[0].text.text(), HasSubstr("is read-only"));
  EXPECT_EQ(report.faults[0].text.ToJson()["text_said"]["key"], "fileReadOnly");
  EXPECT_EQ(edit_->saved_revision(), 0);
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_TRUE(edit_->Save().is_saved());
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_THAT(Marks(), HasSubstr("B,q,1,2"));
}

// The disk is full for whoever writes behind the limit.
TEST_F(SiteEditTest, WhatTheJournalCannotHoldIsNotDone) {
  Open();
  Apply("1", "observations", none_, MarkOn("B", "q", 1, 2));
  const std::string journal = Content("work/prepare/journal.jsonl");
  const Json::Value tables = edit_->Tables();
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old = {};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit full = {journal.size() + 20, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  EXPECT_THROW(Apply("2", "observations", MarkOn("A", "p", 1.5, 2), none_), InputError);
  EXPECT_THROW(edit_->Undo("3"), InputError);
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(edit_->Tables(), tables);
  EXPECT_EQ(Content("work/prepare/journal.jsonl"), journal);
  EXPECT_EQ(edit_->revision(), 1);
  EXPECT_TRUE(Apply("2", "observations", MarkOn("A", "p", 1.5, 2), none_).is_done());
}

// Each row of a real survey taken out, put back and changed: not a byte differs.
TEST_F(SiteEditTest, EveryRowOfTheGalleryComesBackToTheByte) {
  INSITU_SHARED_DATA_OR_SKIP(gallery, "gallery");
  fs::remove_all(site_.survey());
  fs::copy(gallery / "survey", site_.survey(), fs::copy_options::recursive);
  fs::copy(gallery / "site.json", site_.root);
  for (const auto& entry : fs::recursive_directory_iterator(site_.root)) {
    fs::permissions(entry, fs::perms::owner_write, fs::perm_options::add);
  }
  const auto before = Contents();
  edit_ = std::make_unique<SiteEdit>(
      site_, std::vector<std::string>{"IMG_2101", "IMG_2102", "IMG_2103", "IMG_2104"});
  EXPECT_THAT(edit_->read_only(), IsEmpty());
  int count = 0;
  for (const EditedTable& table : EditedTables()) {
    const auto rows = edit_->Rows(table.name);
    for (size_t i = 0; i < rows.size(); i += 1 + rows.size() / 20) {
      const std::string id = std::to_string(++count);
      EXPECT_TRUE(Apply(id, table.name, rows[i], none_).is_done());
      EXPECT_TRUE(Apply(id + " back", table.name, none_, rows[i]).is_done())
          << OneLineJson(rows[i]);
    }
  }
  EXPECT_GT(count, 100);
  EXPECT_TRUE(edit_->Save().is_saved());
  for (int i = 0; i < 2 * count; ++i) EXPECT_TRUE(edit_->Undo("u" + std::to_string(i)).is_done());
  EXPECT_TRUE(edit_->Save().is_saved());
  EXPECT_EQ(Contents(), before);
}

// Not asserted: other programs run beside this.
TEST_F(SiteEditTest, FortyThousandMarks) {
  std::string marks = "photo,point,x,y,sigma\n";
  for (int i = 0; i < 40000; ++i) marks += "A,p" + std::to_string(i) + ",123.456,78.9,0.5\n";
  folder_.Write("survey/observations.csv", marks);
  auto start = std::chrono::steady_clock::now();
  const auto lap = [&](const std::string& what) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start).count();
    std::printf("%-28s %.3f s\n", what.c_str(), seconds);
    RecordProperty(what, std::to_string(seconds));
    start = std::chrono::steady_clock::now();
  };
  Open();
  lap("open");
  Apply("1", "observations", MarkOn("A", "p20000", 123.456, 78.9), none_);
  lap("edit");
  edit_->Save();
  lap("save");
  for (int i = 0; i < 1000; ++i) {
    const std::string id = std::to_string(2 + i);
    Apply(id, "observations", MarkOn("A", "p" + id, 123.456, 78.9), MarkOn("A", "p" + id, 1, i));
  }
  lap("1000 edits");
  for (int i = 0; i < 100; ++i) edit_->Undo("u" + std::to_string(i));
  lap("100 undone");
  edit_->Save();
  lap("save");
  edit_->Refresh();
  lap("refresh");
  folder_.Write("survey/observations.csv", Replaced(Marks(), "A,p39999,123", "A,p39999,124"));
  EXPECT_EQ(edit_->Refresh().operations.size(), 1u);
  lap("merge of an outside change");
  edit_->Tables();
  lap("all tables as JSON");
  Reopen();
  lap("open with 1100 entries");
  EXPECT_EQ(edit_->Rows("observations").size(), 39999u);
}

}  // namespace
}  // namespace insitu
