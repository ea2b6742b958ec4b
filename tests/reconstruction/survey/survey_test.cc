// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "calibration/files/whole_file.h"
#include "reconstruction/survey/read_survey.h"
#include "tests/reconstruction/survey/survey_files.h"

namespace insitu {
namespace {

TEST_F(SurveyFiles, AreReadAsTheyWereWritten) {
  const Survey read = ReadSurvey(site_, network_.photos);
  const Survey& written = network_.survey;
  ASSERT_EQ(read.control_points.size(), written.control_points.size());
  for (size_t i = 0; i < read.control_points.size(); ++i) {
    EXPECT_EQ(read.control_points[i].name, written.control_points[i].name);
    EXPECT_EQ(read.control_points[i].position, written.control_points[i].position);
    EXPECT_EQ(read.control_points[i].sigma, written.control_points[i].sigma);
    EXPECT_EQ(read.control_points[i].role, written.control_points[i].role);
    EXPECT_EQ(read.control_points[i].place.line, written.control_points[i].place.line);
  }
  ASSERT_EQ(read.observations.size(), written.observations.size());
  for (size_t i = 0; i < read.observations.size(); ++i) {
    EXPECT_EQ(read.observations[i].point, written.observations[i].point);
    EXPECT_EQ(read.observations[i].pixel, written.observations[i].pixel);
    EXPECT_EQ(read.observations[i].place.line, written.observations[i].place.line);
  }
  ASSERT_EQ(read.polygons.size(), written.polygons.size());
  for (size_t i = 0; i < read.polygons.size(); ++i) {
    EXPECT_EQ(read.polygons[i].vertices, written.polygons[i].vertices);
    EXPECT_EQ(read.polygons[i].photo, written.polygons[i].photo);
    EXPECT_EQ(read.polygons[i].place.line, written.polygons[i].place.line);
  }
  ASSERT_EQ(read.sun_pairs.size(), written.sun_pairs.size());
  EXPECT_EQ(read.sun_pairs[1].from, "shadow_a5");
  EXPECT_EQ(read.sun_pairs[1].to, "a5");
  EXPECT_EQ(read.sun_pairs[1].place.line, written.sun_pairs[1].place.line);
  ASSERT_EQ(read.zenith_pairs.size(), written.zenith_pairs.size());
  EXPECT_EQ(read.zenith_pairs[0].from, "a0");
  EXPECT_EQ(read.zenith_pairs[0].to, "a4");
}

TEST_F(SurveyFiles, MayLackDirections) {
  std::erase_if(network_.survey.observations,
                [](const auto& mark) { return mark.point.starts_with("shadow"); });
  WriteSurvey(site_, network_.survey);
  std::filesystem::remove(site_.survey() / "directions.json");
  const Survey read = ReadSurvey(site_, network_.photos);
  EXPECT_TRUE(read.sun_pairs.empty());
  EXPECT_TRUE(read.zenith_pairs.empty());
}

// Poses alone need no polygons.
TEST_F(SurveyFiles, MustHoldControlAndMarks) {
  for (const std::string file : {"control_points.csv", "observations.csv"}) {
    const std::string content = ReadWhole(site_.survey() / file);
    std::filesystem::remove(site_.survey() / file);
    try {
      ReadSurvey(site_, network_.photos);
      ADD_FAILURE() << file;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()), (site_.survey() / file).string() + ": is missing");
    }
    WriteWhole(site_.survey() / file, content);
  }
  std::filesystem::remove(site_.survey() / "polygons.json");
  std::filesystem::remove(site_.survey() / "constraints.json");
  EXPECT_TRUE(ReadSurvey(site_, network_.photos).polygons.empty());
}

// Spreadsheets drop leading zeros: "1" of the control is "001" of the marks.
TEST_F(SurveyFiles, TellControlPointsThatDifferInZerosOnly) {
  ControlPoint& point = network_.survey.control_points[0];
  const std::string name = point.name;
  point.name = name.substr(0, name.size() - 1) + "00" + name.back();
  const int line = point.place.line;
  WriteSurvey(site_, network_.survey);
  ExpectError("control_points.csv", line, "differ only in leading zeros");
}

// macOS writes "ü" as u with a mark, tables as one letter.
TEST_F(SurveyFiles, TakeNamesOfEitherUnicodeForm) {
  const std::string composed =
                        "S\xC3\xBC"
                        "d",
                    decomposed =
                        "Su\xCC\x88"
                        "d";
  std::vector<std::string> photos = network_.photos;
  for (ImageObservation& mark : network_.survey.observations) {
    if (mark.photo == photos[0]) mark.photo = composed;
  }
  std::erase_if(network_.survey.polygons,
                [&](const auto& each) { return each.photo == photos[0]; });
  network_.survey.camera_positions.clear();
  network_.survey.edges.clear();
  photos[0] = decomposed;
  WriteSurvey(site_, network_.survey);
  const Survey survey = ReadSurvey(site_, photos);
  EXPECT_TRUE(std::any_of(survey.observations.begin(), survey.observations.end(),
                          [&](const auto& mark) { return mark.photo == decomposed; }));
}

// Who is still measuring is not stopped by it, and hears of it.
TEST_F(SurveyFiles, LeaveOutAPointOfOneMarkByName) {
  ReplaceLine("observations.csv", 5, "P1,nobody,100,100,0.4");
  const Survey survey = ReadSurvey(site_, network_.photos);
  ASSERT_EQ(survey.lone_marks.size(), 1u);
  EXPECT_EQ(survey.lone_marks[0].mark.point, "nobody");
  EXPECT_EQ(survey.lone_marks[0].question.text(), "");
  EXPECT_EQ(survey.lone_marks[0].mark.place.line, 5);
  EXPECT_FALSE(PointsInUse(survey).contains("nobody"));
}

// Two names of one point, each marked once: neither stops, both are asked about.
TEST_F(SurveyFiles, AskOfLonePointsOfNearNames) {
  auto& marks = network_.survey.observations;
  marks.push_back({"P1", "chimney", {100, 100}, 0.4, {}});
  marks.push_back({"P2", "chimny", {110, 100}, 0.4, {}});
  WriteSurvey(site_, network_.survey);
  const Survey survey = ReadSurvey(site_, network_.photos);
  ASSERT_EQ(survey.lone_marks.size(), 2u);
  EXPECT_EQ(survey.lone_marks[0].question.text(), "; did you mean 'chimny'?");
  EXPECT_EQ(survey.lone_marks[1].question.text(), "; did you mean 'chimney'?");
}

TEST_F(SurveyFiles, RefuseALoneMarkUnderASlipOfAKnownName) {
  auto& marks = network_.survey.observations;
  const auto mark = std::find_if(marks.begin(), marks.end(),
                                 [](const auto& each) { return each.point == "shadow_a5"; });
  mark->point = "shaddow_a5";
  const int line = mark->place.line;
  WriteSurvey(site_, network_.survey);
  ExpectError("observations.csv", line, "did you mean 'shadow_a5'?");
}

TEST_F(SurveyFiles, TakeAPointThatTwoPhotosShow) {
  auto& marks = network_.survey.observations;
  marks.push_back({"P1", "knob", {100, 100}, 0.4, {}});
  marks.push_back({"P2", "knob", {110, 100}, 0.4, {}});
  WriteSurvey(site_, network_.survey);
  EXPECT_EQ(ReadSurvey(site_, network_.photos).observations.back().point, "knob");
}

TEST_F(SurveyFiles, RefuseASlipOfAKnownNameThoughTwoPhotosShowIt) {
  int first = 0;
  for (ImageObservation& mark : network_.survey.observations) {
    if (mark.point != "shadow_a5" || mark.photo > "P2") continue;
    mark.point = "shaddow_a5";
    if (first == 0) first = mark.place.line;
  }
  WriteSurvey(site_, network_.survey);
  ExpectError("observations.csv", first, "did you mean 'shadow_a5'?");
}

TEST_F(SurveyFiles, RefuseAMarkOnAnUnknownPhoto) {
  ReplaceLine("observations.csv", 7, "P9,g0,100,100,0.4");
  ExpectError("observations.csv", 7, "P9");
}

TEST_F(SurveyFiles, RefuseTwoMarksOfAPointOnAPhoto) {
  ReplaceLine("observations.csv", 3, "P1,g0,100,100,0.4");
  ReplaceLine("observations.csv", 4, "P1,g0,101,100,0.4");
  ExpectError("observations.csv", 4, "line 3");
}

TEST_F(SurveyFiles, RefuseNaN) {
  ReplaceLine("observations.csv", 4, "P1,g0,nan,100,0.4");
  ExpectError("observations.csv", 4, "nan");
}

TEST_F(SurveyFiles, RefuseNaNInControl) {
  ReplaceLine("control_points.csv", 3, "g8,1,NaN,3,0.01,0.01,0.01,control");
  ExpectError("control_points.csv", 3, "NaN");
}

TEST_F(SurveyFiles, RefuseAMarkOutsideAnyFrame) {
  ReplaceLine("observations.csv", 4, "P1,g0,-20,100,0.4");
  ExpectError("observations.csv", 4, "-20");
}

TEST_F(SurveyFiles, RefuseASigmaOfZero) {
  ReplaceLine("control_points.csv", 4, "g8,1,2,3,0.01,0,0.01,control");
  ExpectError("control_points.csv", 4, "sigma_y");
}

TEST_F(SurveyFiles, RefuseAnUnknownRole) {
  ReplaceLine("control_points.csv", 4, "g8,1,2,3,0.01,0.01,0.01,chekc");
  ExpectError("control_points.csv", 4, "chekc");
}

TEST_F(SurveyFiles, RefuseAPointSurveyedTwice) {
  ReplaceLine("control_points.csv", 4, "twin,1,2,3,0.01,0.01,0.01,control");
  ReplaceLine("control_points.csv", 6, "twin,1,2,3,0.01,0.01,0.01,check");
  ExpectError("control_points.csv", 6, "twin");
}

TEST_F(SurveyFiles, RefuseAPolygonOfTwoVertices) {
  ReplaceLine("polygons.json", 4,
              R"({"name": "slit", "vertices": ["a0", "a1"], "photo": "P1", "material": "m"},)");
  ExpectError("polygons.json", 4, "slit");
}

TEST_F(SurveyFiles, RefuseAPolygonThatRepeatsAVertex) {
  ReplaceLine("polygons.json", 4,
              R"({"name": "loop", "vertices": ["a0", "a1", "a2", "a1"], "material": "m"},)");
  ExpectError("polygons.json", 4, "loop");
}

TEST_F(SurveyFiles, TakeHolesOfAPolygon) {
  ReplaceLine("polygons.json", 4,
              R"({"name": "wall", "vertices": ["a0", "a1", "a2"], "material": "m",)"
              R"( "holes": [["b0", "b1", "b2"], ["c0", "c1", "c2", "c3"]]},)");
  const Survey survey = ReadSurvey(site_, network_.photos);
  const PolygonOutline& polygon = *std::find_if(survey.polygons.begin(), survey.polygons.end(),
                                                [](const auto& p) { return p.name == "wall"; });
  ASSERT_EQ(polygon.holes.size(), 2u);
  EXPECT_EQ(polygon.holes[1], (std::vector<std::string>{"c0", "c1", "c2", "c3"}));
  EXPECT_EQ(AllVertices(polygon).size(), 10u);
}

TEST_F(SurveyFiles, RefuseHolesOfTwoVerticesOrOfVerticesTwice) {
  const std::string start = R"({"name": "wall", "vertices": ["a0", "a1", "a2"], "material": "m",)";
  ReplaceLine("polygons.json", 4, start + R"( "holes": [["b0", "b1"]]},)");
  ExpectError("polygons.json", 4, "a hole of polygon 'wall' has 2 vertices");
  ReplaceLine("polygons.json", 4, start + R"( "holes": [["b0", "b1", "a2"]]},)");
  ExpectError("polygons.json", 4, "has vertex 'a2', which the polygon has already");
  ReplaceLine("polygons.json", 4,
              start + R"( "holes": [["b0", "b1", "b2"], ["b2", "c0", "c1"]]},)");
  ExpectError("polygons.json", 4, "has vertex 'b2', which the polygon has already");
}

TEST_F(SurveyFiles, RefuseAPolygonColouredFromAnUnknownPhoto) {
  ReplaceLine("polygons.json", 4,
              R"({"name": "w", "vertices": ["a0", "a1", "a2"], "photo": "P7", "material": "m"},)");
  ExpectError("polygons.json", 4, "P7");
}

TEST_F(SurveyFiles, RefuseAMissingMask) {
  ReplaceLine(
      "polygons.json", 4,
      R"({"name": "w", "vertices": ["a0", "a1", "a2"], "material": "m", "mask": "w.png"},)");
  ExpectError("polygons.json", 4, "w.png");
}

TEST_F(SurveyFiles, RefuseADirectionPairOfOnePoint) {
  ReplaceLine("directions.json", 2, R"({"shadow": "a4", "object": "a4"},)");
  ExpectError("directions.json", 2, "a4");
}

TEST_F(SurveyFiles, RefuseAMisspeltKey) {
  ReplaceLine("polygons.json", 4,
              R"({"name": "w", "vertices": ["a0", "a1", "a2"], "material": "m", "Photo": "P1"},)");
  ExpectError("polygons.json", 4, "is not a key of a polygon, expected name, vertices, photo");
}

TEST_F(SurveyFiles, RefuseAMisspeltKeyOfDirections) {
  WriteWhole(site_.survey() / "directions.json", "{\"zeniths\":\n[]}\n");
  ExpectError("directions.json", 2, "zeniths");
  WriteWhole(site_.survey() / "directions.json", "{\"comment\": \"none yet\", \"sun\": []}\n");
  EXPECT_TRUE(ReadSurvey(site_, network_.photos).zenith_pairs.empty());
}

TEST_F(SurveyFiles, RefuseNamesOfTiePoints) {
  ReplaceLine("control_points.csv", 4, "tie_000012,1,2,3,0.01,0.01,0.01,control");
  ExpectError("control_points.csv", 4, "'tie_000012' is named as tie points are");
}

TEST_F(SurveyFiles, RefuseAPolygonsFileCutShort) {
  const std::string content = ReadWhole(site_.survey() / "polygons.json");
  WriteWhole(site_.survey() / "polygons.json", content.substr(0, content.size() / 2));
  EXPECT_THROW(ReadSurvey(site_, network_.photos), InputError);
}

TEST(PlaceOfPoint, IsItsFirstMark) {
  const Survey survey = MakeSyntheticNetwork().survey;
  EXPECT_EQ(PlaceOfPoint(survey, "buried").path, "control_points.csv");
  const FilePlace place = PlaceOfPoint(survey, "c6");
  EXPECT_EQ(place.path, "observations.csv");
  EXPECT_EQ(survey.observations[place.line - 2].point, "c6");
}

}  // namespace
}  // namespace insitu
