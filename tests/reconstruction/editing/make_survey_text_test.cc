// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/make_survey_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/reader.h>

#include <sstream>

#include "tests/calibration/files/scratch_folder.h"
#include "tests/reconstruction/editing/edited_site.h"

namespace insitu {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const Json::Value kNothing;

Json::Value Row(const std::string& json) {
  std::istringstream stream(json);
  Json::Value row;
  stream >> row;
  return row;
}

const EditedTable& Table(const std::string& name) { return *FindEditedTable(name); }

std::unique_ptr<SurveyText> TextOf(const std::string& file, const std::string& text) {
  std::vector<EditedTable> tables;
  for (const EditedTable& table : EditedTables()) {
    if (table.file == file) tables.push_back(table);
  }
  return MakeSurveyText(tables, file, text);
}

std::unique_ptr<SurveyText> Marks(const std::string& text) {
  return TextOf("survey/observations.csv", text);
}

std::string MarksAfter(const std::string& text, const std::string& before,
                       const std::string& after) {
  const auto marks = Marks(text);
  const Json::Value from = before.empty() ? kNothing : Row(before);
  const Json::Value to = after.empty() ? kNothing : Row(after);
  const Json::Value trace = marks->Edit(Table("observations"), from, to, kNothing);
  const std::string edited = marks->text();
  marks->Edit(Table("observations"), to, from, trace);
  EXPECT_EQ(marks->text(), text) << "taken back";
  return edited;
}

// Edited and taken back.
std::string JsonAfter(const std::string& table_name, const std::string& text,
                      const std::string& before, const std::string& after) {
  const EditedTable& table = Table(table_name);
  const auto file = TextOf(table.file, text);
  const Json::Value from = before.empty() ? kNothing : Row(before);
  const Json::Value to = after.empty() ? kNothing : Row(after);
  const Json::Value trace = file->Edit(table, from, to, kNothing);
  const std::string edited = file->text();
  file->Edit(table, to, from, trace);
  EXPECT_EQ(file->text(), text) << "taken back";
  return edited;
}

constexpr char kA[] = R"({"photo": "A", "point": "p", "x": 1.5, "y": 2, "sigma": 0.4})";
constexpr char kB[] = R"({"photo": "A", "point": "q", "x": 3, "y": 4, "sigma": 0.5})";

TEST(CsvSurveyText, KeepsEveryByteOfWhatItDoesNotEdit) {
  for (const std::string text :
       {"", "photo,point,x,y,sigma\n", "photo,point,x,y,sigma", "\n# only words\n\n",
        "\xEF\xBB\xBFphoto,point,x,y,sigma\r\nA,p,1.50,+2,0.4\r\n\r\n# c\r\nA,q,3,4,5e-1",
        "sigma , y,x,note,point,photo\n 0.4 ,\t2.000,1.5,,p,A\n"}) {
    EXPECT_EQ(Marks(text)->text(), text);
  }
}

TEST(CsvSurveyText, RewritesTheChangedCellOnly) {
  EXPECT_EQ(MarksAfter("\xEF\xBB\xBF# head\r\nphoto,point,x,y,sigma,extra\r\n"
                       "A , p, 1.50,2.000 ,0.40,kept\r\n\r\n# between\r\nA,q,3,4,0.5,",
                       R"({"photo": "A", "point": "p", "x": 1.5, "y": 2, "sigma": 0.4,
                           "extra": "kept"})",
                       R"({"photo": "A", "point": "p", "x": 1.25, "y": 2, "sigma": 0.4,
                           "extra": "kept"})"),
            "\xEF\xBB\xBF# head\r\nphoto,point,x,y,sigma,extra\r\n"
            "A , p, 1.25,2.000 ,0.40,kept\r\n\r\n# between\r\nA,q,3,4,0.5,");
}

TEST(CsvSurveyText, LosesNoDigit) {
  EXPECT_EQ(MarksAfter("photo,point,x,y,sigma\nA,p,1.5,2,0.4\n", kA,
                       R"({"photo": "A", "point": "p", "x": 0.30000000000000004,
                           "y": 0.1234567890123456, "sigma": 1e-7})"),
            "photo,point,x,y,sigma\nA,p,0.30000000000000004,0.1234567890123456,1e-07\n");
}

TEST(CsvSurveyText, PutsANewRowBehindTheLastAndDropsALine) {
  EXPECT_EQ(MarksAfter("photo,point,x,y,sigma\nA,p,1.5,2,0.4\n# the end\n", "", kB),
            "photo,point,x,y,sigma\nA,p,1.5,2,0.4\nA,q,3,4,0.5\n# the end\n");
  EXPECT_EQ(MarksAfter("photo,point,x,y,sigma\r\nA,p,1.5,2,0.4", "", kB),
            "photo,point,x,y,sigma\r\nA,p,1.5,2,0.4\r\nA,q,3,4,0.5");
  EXPECT_EQ(MarksAfter("point,sigma,photo,y,x\np,0.4,A,2,1.5\n# c\nq,0.50,A,4,3", kB, ""),
            "point,sigma,photo,y,x\np,0.4,A,2,1.5\n# c");
  EXPECT_EQ(MarksAfter("point,sigma,photo,y,x\n p,0.4,A,2.0,1.5\n# c\nq,0.50,A,4,3\n", kA, ""),
            "point,sigma,photo,y,x\n# c\nq,0.50,A,4,3\n");
}

TEST(CsvSurveyText, MakesAFileWithTheHeader) {
  EXPECT_EQ(MarksAfter("", "", kA), "photo,point,x,y,sigma\nA,p,1.5,2,0.4\n");
  EXPECT_EQ(MarksAfter("# mine", "", kA), "# mine\nphoto,point,x,y,sigma\nA,p,1.5,2,0.4\n");
}

TEST(CsvSurveyText, SwitchesAMarkOffByAComment) {
  const std::string on = "photo,point,x,y,sigma\nA,p,1.50,2,0.4\n";
  const std::string off = "photo,point,x,y,sigma\n#off A,p,1.50,2,0.4\n";
  std::string kOffA = kA;
  kOffA.insert(kOffA.size() - 1, R"(, "state": "off")");
  EXPECT_EQ(MarksAfter(on, kA, kOffA), off);
  EXPECT_EQ(MarksAfter(off, kOffA, kA), on);
  EXPECT_EQ(Marks(off)->Rows(Table("observations")).front()->get("state", ""), "off");
}

TEST(CsvSurveyText, AddsColumnsWhenFirstNeeded) {
  std::string dubious = kA;
  dubious.insert(dubious.size() - 1, R"(, "state": "dubious", "method": "hand")");
  EXPECT_EQ(
      MarksAfter("photo,point,x,y,sigma\nA,p,1.5,2,0.4\n#off A,q,3,4,0.5\n# A,q\n", kA, dubious),
      "photo,point,x,y,sigma,state,method\nA,p,1.5,2,0.4,dubious,hand\n"
      "#off A,q,3,4,0.5,,\n# A,q\n");
  EXPECT_EQ(MarksAfter("photo,point,x,y,sigma,state\nA,p,1.5,2,0.4,dubious\n",
                       R"({"photo": "A", "point": "p", "x": 1.5, "y": 2, "sigma": 0.4,
                           "state": "dubious"})",
                       kA),
            "photo,point,x,y,sigma,state\nA,p,1.5,2,0.4,\n");
}

TEST(CsvSurveyText, TakesOtherCommentsForComments) {
  const auto marks = Marks(
      "photo,point,x,y,sigma,state\n#off A,p,far,2,0.4,\n#offside A,p,1,2,0.4,\n#off\n#off "
      "A,p,1,2\n"
      "A,q,3,4,0.5,off\n");
  ASSERT_EQ(marks->Rows(Table("observations")).size(), 1u);
  EXPECT_FALSE(marks->Rows(Table("observations"))[0]->isMember("state"));  // programs read the row
}

TEST(CsvSurveyText, SaysWhereItCannotBeUnderstood) {
  const auto error = [](const std::string& text) { return InputErrorOf([&] { Marks(text); }); };
  EXPECT_THAT(error("# c\nphoto,point,x,y\n"),
              StartsWith("survey/observations.csv:2: column \"sigma\" is missing"));
  EXPECT_THAT(error("photo,point,x,y,sigma,x\n"), HasSubstr("stands twice"));
  EXPECT_THAT(error("photo,point,x,y,sigma\n\nA,p,1,2\n"), HasSubstr(":3: 4 cells, expected 5"));
  EXPECT_THAT(error("photo,point,x,y,sigma\nA,p,1,2,nan\n"), HasSubstr(":2: \"nan\" in column"));
  EXPECT_THAT(error("photo,point,x,y,sigma\nA,B\xFCro,1,2,3\n"), HasSubstr(":2: is not UTF-8"));
}

constexpr char kPolygons[] = R"({
 "format": "mine",
 "polygons": [
  {
   "name": "wall",
   "vertices": [
    "a",
    "b",
    "c"
   ],
   "material": "brick",
   "comment": "seen \u00fc at noon",
   "mask": null
  },
  { "name": "path", "vertices": ["a", "b", "d"], "photo":"A", "material" : "gravel"}
 ]
}
)";

TEST(JsonSurveyText, KeepsEveryByteOfWhatItDoesNotEdit) {
  for (const std::string& text : {std::string(), std::string("{}"), std::string(" { }\n\n"),
                                  std::string("{\"polygons\" :[ ] }"), std::string(kPolygons)}) {
    EXPECT_EQ(TextOf("survey/polygons.json", text)->text(), text);
  }
}

TEST(JsonSurveyText, RewritesTheChangedMemberOnly) {
  const char wall[] = R"({"name": "wall", "vertices": ["a", "b", "c"], "material": "brick",
                          "comment": "seen ü at noon"})";
  EXPECT_EQ(JsonAfter("polygons", kPolygons, wall,
                      R"({"name": "wall", "vertices": ["a", "b", "c"], "material": "stone",
                          "comment": "seen ü at noon", "photo": "A"})"),
            Replaced(Replaced(kPolygons, "brick", "stone"), "\"mask\": null",
                     "\"mask\": null,\n   \"photo\": \"A\""));
  EXPECT_EQ(JsonAfter("polygons", kPolygons, wall,
                      R"({"name": "wall", "vertices": ["a", "e", "c", "f"], "material": "brick",
                          "comment": "seen ü at noon"})"),
            Replaced(Replaced(kPolygons, "\"b\"", "\"e\""), "\"c\"", "\"c\",\n    \"f\""));
  EXPECT_EQ(JsonAfter("polygons", kPolygons,
                      R"({"name": "path", "vertices": ["a", "b", "d"], "photo": "A",
                          "material": "gravel"})",
                      R"({"name": "path", "vertices": ["a", "b", "d"], "material": "gravel"})"),
            Replaced(kPolygons, ", \"photo\":\"A\"", ""));
}

TEST(JsonSurveyText, AddsAndDropsItemsInTheFilesManner) {
  EXPECT_EQ(JsonAfter("polygons", kPolygons, "",
                      R"({"material": "brick", "name": "new", "photo": null,
                          "vertices": ["x", "y", "z"]})"),
            Replaced(kPolygons, "\"gravel\"}",
                     "\"gravel\"},\n  { \"name\": \"new\", \"vertices\": [\"x\", \"y\", \"z\"], "
                     "\"photo\": null, \"material\": \"brick\"}"));
  EXPECT_EQ(JsonAfter("sun",
                      "{\"zenith\": [],\r\n  \"sun\": [{\"object\": \"a\", \"shadow\": \"b\"}, "
                      "{\"object\": \"c\", \"shadow\": \"d\"}]}",
                      R"({"object": "a", "shadow": "b"})", ""),
            "{\"zenith\": [],\r\n  \"sun\": [{\"object\": \"c\", \"shadow\": \"d\"}]}");
  EXPECT_EQ(JsonAfter("sun",
                      "{\"sun\": [{\"object\": \"a\", \"shadow\": \"b\"}, "
                      "{\"object\": \"c\", \"shadow\": \"d\"} ]}",
                      R"({"object": "c", "shadow": "d"})", ""),
            "{\"sun\": [{\"object\": \"a\", \"shadow\": \"b\"} ]}");
}

TEST(JsonSurveyText, MakesFilesAndLists) {
  const char pair[] = R"({"top": "b", "bottom": "a"})";
  const std::string made =
      "{\n \"zenith\": [\n  {\n   \"bottom\": \"a\",\n   \"top\": \"b\"\n  }\n ]\n}\n";
  EXPECT_EQ(JsonAfter("zenith", "", "", pair), made);
  EXPECT_EQ(JsonAfter("zenith", "{}", "", pair), made.substr(0, made.size() - 1));
  EXPECT_EQ(JsonAfter("zenith", "{\"sun\": [ ]}", "", pair),
            "{\"sun\": [ ], \"zenith\": [{\"bottom\": \"a\", \"top\": \"b\"}]}");
  EXPECT_EQ(JsonAfter("zenith", "{\"zenith\": [ ]}", "", pair),
            "{\"zenith\": [{\"bottom\": \"a\", \"top\": \"b\"}]}");
  EXPECT_EQ(JsonAfter("zenith", made, pair, ""), "{\n \"zenith\": []\n}\n");
}

// ReadSamples refuses an empty list of haze samples, but not the lack of one.
TEST(JsonSurveyText, LeavesNoEmptyListOfHaze) {
  EXPECT_EQ(
      JsonAfter("haze", "{\n\"haze\": [ {\"photo\": \"A\", \"x\": 1, \"y\": 2} ],\n\"light\": 1}",
                R"({"photo": "A", "x": 1.0, "y": 2})", ""),
      "{\n\"haze\": null,\n\"light\": 1}");
}

TEST(JsonSurveyText, EditsTheRootsOtherMembersAsARow) {
  const std::string samples =
      "{\n \"horizon\": [],\n \"daylight_reflectance_rgb\": [0.2, 0.20, 0.3],"
      "\n \"comment\": \"c\",\n \"version\": 1\n}\n";
  const char row[] =
      R"({"daylight_reflectance_rgb": [0.2, 0.2, 0.3], "comment": "c", "version": 1})";
  EXPECT_EQ(
      JsonAfter("light", samples, row,
                R"({"daylight_reflectance_rgb": [0.2, 0.2, 0.5], "comment": "c", "version": 1})"),
      Replaced(samples, "0.3", "0.5"));
  EXPECT_EQ(JsonAfter("light", samples, row, R"({"version": 1})"),
            "{\n \"horizon\": [],\n \"version\": 1\n}\n");
  EXPECT_EQ(JsonAfter("light", samples, row, ""), "{\n \"horizon\": []\n}\n");
  EXPECT_EQ(JsonAfter("site", "", "", R"({"name": "here", "latitude": 47.25})"),
            "{\n \"name\": \"here\",\n \"latitude\": 47.25\n}\n");
}

TEST(JsonSurveyText, EditsMaterialsByTheirNames) {
  const std::string materials =
      "{\n  \"materials\": {\n    \"brick\" : {\"ior\": null, \"specular\": "
      "\"none\"}\n  }\n}";
  EXPECT_EQ(JsonAfter("materials", materials, R"({"name": "brick", "specular": "none"})",
                      R"({"name": "brick", "specular": "none", "ior": 1.5})"),
            Replaced(materials, "null", "1.5"));
  EXPECT_EQ(JsonAfter("materials", materials, R"({"name": "brick", "specular": "none"})",
                      R"({"name": "stone", "specular": "none"})"),
            Replaced(materials, "brick", "stone"));
  EXPECT_EQ(JsonAfter("materials", materials, "", R"({"name": "wood", "specular": "none"})"),
            Replaced(materials, "\n  }\n}", ",\n    \"wood\" : {\"specular\": \"none\"}\n  }\n}"));
}

TEST(JsonSurveyText, SaysWhereItCannotBeUnderstood) {
  const auto error = [](const std::string& text) {
    return InputErrorOf([&] { TextOf("survey/directions.json", text); });
  };
  EXPECT_THAT(error("{\n\"sun\": [}"), StartsWith("survey/directions.json:2: not valid JSON"));
  EXPECT_THAT(error("[]"), HasSubstr("expected an object"));
  EXPECT_THAT(error("{\n\n\"sun\": {}}"), HasSubstr(":3: \"sun\" expected an array"));
  EXPECT_THAT(error("{\n\"sun\": [\n7]}"), HasSubstr(":3: \"sun\" holds what is no object"));
}

}  // namespace
}  // namespace insitu
