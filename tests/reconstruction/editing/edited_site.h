// SPDX-License-Identifier: GPL-3.0-or-later
// A small site in a folder of a test's own, and short words for operations on it.
#pragma once

#include <gtest/gtest.h>
#include <json/reader.h>

#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "calibration/files/whole_file.h"
#include "reconstruction/editing/site_edit.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {

inline Json::Value RowOf(const std::string& json) {
  std::istringstream stream(json);
  Json::Value row;
  stream >> row;
  return row;
}

inline Json::Value MarkOn(const std::string& photo, const std::string& point, double x, double y,
                          const std::string& state = "") {
  Json::Value row;
  row["photo"] = photo;
  row["point"] = point;
  row["x"] = x;
  row["y"] = y;
  row["sigma"] = 0.5;
  if (!state.empty()) row["state"] = state;
  return row;
}

inline Operation OneEdit(const std::string& id, const std::string& table, const Json::Value& before,
                         const Json::Value& after) {
  return {id, "label of " + id, {{table, before, after}}};
}

// The text with its first `from` replaced, which must be there.
inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

class EditedSite : public testing::Test {
 protected:
  EditedSite() {
    folder_.Write("survey/observations.csv", kMarks);
    folder_.Write("survey/polygons.json", kPolygons);
  }

  void Open() { edit_ = std::make_unique<SiteEdit>(site_, std::vector<std::string>{"A", "B"}); }

  // As kill -9 would: nothing is written any more.
  void Kill() { edit_.reset(); }
  void Reopen() {
    Kill();
    Open();
  }

  std::string Content(const std::string& file) const { return ReadIfThere(site_.root / file); }
  std::string Marks() const { return Content("survey/observations.csv"); }

  // All files of the survey and site.json.
  std::map<std::string, std::string> Contents() const {
    std::map<std::string, std::string> contents;
    for (const EditedTable& table : EditedTables()) contents[table.file] = Content(table.file);
    return contents;
  }

  EditOutcome Apply(const std::string& id, const std::string& table, const Json::Value& before,
                    const Json::Value& after) {
    return edit_->Apply(OneEdit(id, table, before, after));
  }

  static constexpr char kMarks[] =
      "photo,point,x,y,sigma\n# left\nA,p,1.50,2,0.5\nA,q,3,4,0.5\n\nB,p,5,6,0.5\n";
  static constexpr char kPolygons[] =
      "{\"polygons\": [\n  {\"name\": \"w\", \"vertices\": [\"p\", \"q\", \"r\"], \"photo\": null, "
      "\"material\": \"m\"}\n]}\n";
  const Json::Value none_;
  ScratchFolder folder_;
  SitePaths site_{folder_.path()};
  std::unique_ptr<SiteEdit> edit_;
};

}  // namespace insitu
