// SPDX-License-Identifier: GPL-3.0-or-later
// A thousand operations at random, with a fixed seed: what is confirmed is never lost, and can be
// undone to the byte.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <vector>

#include "reconstruction/editing/make_survey_text.h"
#include "tests/reconstruction/editing/edited_site.h"

namespace insitu {
namespace {

class RandomEdits : public EditedSite {
 protected:
  int Below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  double Number() { return std::uniform_real_distribution<double>(0, 4000)(random_); }
  template <typename T>
  T OneOf(const std::vector<T>& values) {
    return values[static_cast<size_t>(Below(static_cast<int>(values.size())))];
  }
  std::string Name() { return "p" + std::to_string(Below(12)); }
  std::string Id() { return "id " + std::to_string(++ids_); }

  Json::Value RandomRow(const std::string& table) {
    Json::Value row;
    if (table == "observations") {
      row = MarkOn(OneOf<std::string>({"A", "B"}), Name(), Number(), Below(9),
                   OneOf<std::string>({"", "on", "off", "dubious"}));
      if (Below(4) == 0) row["note"] = OneOf<std::string>({"wet", "ü", "a;b"});
    } else if (table == "polygons") {
      row = RowOf(R"({"material": "m", "vertices": ["a", "b", "c"]})");
      row["name"] = Name();
      if (Below(2)) row["photo"] = OneOf<Json::Value>({"A", Json::Value()});
      for (int i = Below(3); i > 0; --i) row["vertices"].append("v" + std::to_string(i));
    } else if (table == "zenith") {
      row["bottom"] = "b" + Name();
      row["top"] = "t" + Name();
    } else if (table == "haze") {
      row = RowOf(R"({"photo": "A", "polygon": "w"})");
      row["x"] = Below(5);
      row["y"] = Number();
    } else if (table == "materials") {
      row["name"] = Name();
      row["ior"] = OneOf<Json::Value>({1.5, Json::Value(), 2});
    } else {
      row["daylight_reflectance_rgb"] = RowOf("[0.5, 0.25, 0.125]");
      row["daylight_reflectance_rgb"][1] = 1 / (1 + Number());
      if (Below(2)) row["comment"] = Name();
    }
    return row;
  }

  RowEdit RandomEdit() {
    const std::string table = OneOf<std::string>(
        {"observations", "observations", "polygons", "zenith", "haze", "light", "materials"});
    const std::vector<Json::Value> rows = edit_->Rows(table);
    const int what = rows.empty() ? 0 : Below(3);
    if (what == 0) return {table, Json::Value(), RandomRow(table)};
    const Json::Value before = OneOf(rows);
    return {table, before, what == 1 ? Json::Value() : RandomRow(table)};
  }

  void Step() {
    const int what = Below(20);
    if (what < 12) {
      Operation operation{Id(), "edit", {}};
      for (int i = 1 + Below(3); i > 0; --i) operation.edits.push_back(RandomEdit());
      done_ += edit_->Apply(operation).is_done();
    } else if (what < 16) {
      edit_->Undo(Id());
    } else if (what < 18) {
      edit_->Redo(Id());
    } else if (what < 19) {
      ASSERT_TRUE(edit_->Save().is_saved());
    } else {
      const Json::Value tables = edit_->Tables();
      const int revision = edit_->revision();
      Reopen();
      ASSERT_EQ(edit_->revision(), revision);
      ExpectTables(tables);
    }
  }

  // By meaning: rows read again may lack what says nothing.
  void ExpectTables(const Json::Value& expected) {
    for (const EditedTable& table : EditedTables()) {
      const auto rows = edit_->Rows(table.name);
      ASSERT_EQ(rows.size(), expected[table.name].size()) << table.name;
      for (size_t i = 0; i < rows.size(); ++i) {
        const Json::Value& row = expected[table.name][static_cast<Json::ArrayIndex>(i)];
        ASSERT_TRUE(IsSameRow(table, rows[i], row)) << rows[i].toStyledString();
      }
    }
  }

  std::mt19937 random_{1992};
  int ids_ = 0, done_ = 0;
};

TEST_F(RandomEdits, AreNeverLostAndUndoneToTheByte) {
  folder_.Write("survey/samples.json", "{\r\n\t\"comment\" : \"c\", \"haze\": [ ]\r\n}");
  folder_.Write("survey/materials.json", "{\"materials\":{\"a\":{}},\"version\":1}");
  const auto before = Contents();
  Open();
  for (int i = 0; i < 1000; ++i) {
    ASSERT_NO_FATAL_FAILURE(Step()) << "step " << i;
  }
  EXPECT_GT(done_, 300);
  ASSERT_TRUE(edit_->Save().is_saved());
  const auto after = Contents();
  const Json::Value tables = edit_->Tables();
  Kill();
  std::filesystem::remove_all(site_.root / "work");  // costs the history only
  Open();
  ExpectTables(tables);
  EXPECT_EQ(Contents(), after);
  EXPECT_NE(after, before);
}

TEST_F(RandomEdits, AllUndoneIsTheSameFileAndAllRedoneTheSameEdit) {
  folder_.Write("survey/samples.json", "{\r\n\t\"comment\" : \"c\", \"haze\": [ ]\r\n}");
  folder_.Write("survey/materials.json", "{\"materials\":{\"a\":{}},\"version\":1}");
  const auto before = Contents();
  Open();
  for (int i = 0; i < 300; ++i) {
    ASSERT_NO_FATAL_FAILURE(Step()) << "step " << i;
  }
  while (edit_->Redo(Id()).is_done()) {
  }
  edit_->Save();
  const auto after = Contents();
  int steps = 0;
  for (; edit_->Undo(Id()).is_done(); ++steps) {
    if (steps % 7 == 0) edit_->Save();
    if (steps % 31 == 0) Reopen();
  }
  edit_->Save();
  EXPECT_GT(steps, 50);
  EXPECT_EQ(Contents(), before);
  while (edit_->Redo(Id()).is_done()) {
  }
  edit_->Save();
  EXPECT_EQ(Contents(), after);
}

// Two people at one file, of which each edits points of their own: nobody's work is lost, whenever
// the one is killed.
TEST_F(RandomEdits, OfTwoPeopleAreBothKept) {
  Open();
  const EditedTable& table = *FindEditedTable("observations");
  std::map<std::string, Json::Value> expected;
  for (const Json::Value& row : edit_->Rows("observations")) expected[KeyOfRow(table, row)] = row;
  for (int i = 0; i < 400; ++i) {
    const int what = Below(10);
    Json::Value row = RandomRow("observations");
    if (what >= 4) row["point"] = "their " + row["point"].asString();
    const std::string key = KeyOfRow(table, row);
    const Json::Value before = expected.contains(key) ? expected[key] : Json::Value();
    const Json::Value after = Below(3) || before.isNull() ? row : Json::Value();
    if (what < 4) {
      ASSERT_TRUE(edit_->Apply({Id(), "", {{"observations", before, after}}}).is_done());
    } else if (what < 6) {
      const auto text = MakeSurveyText({table}, "theirs", Marks());
      text->Edit(table, before, after, Json::Value());
      folder_.Write("survey/observations.csv", text->text());
    } else if (what == 6) {
      ASSERT_TRUE(edit_->Save().is_saved());
    } else if (what == 7) {
      EXPECT_TRUE(edit_->Refresh().conflicts.empty());
    } else if (what == 8) {
      Reopen();
      EXPECT_TRUE(edit_->found().conflicts.empty());
    }
    if (what < 6) expected[key] = after;
    if (what < 6 && after.isNull()) expected.erase(key);
  }
  ASSERT_TRUE(edit_->Save().is_saved());
  const auto rows = edit_->Rows("observations");
  EXPECT_EQ(rows.size(), expected.size());
  for (const Json::Value& row : rows) {
    EXPECT_TRUE(IsSameRow(table, row, expected[KeyOfRow(table, row)])) << row.toStyledString();
  }
  EXPECT_EQ(MakeSurveyText({table}, "ours", Marks())->Rows(table).size(), rows.size());
}

}  // namespace
}  // namespace insitu
