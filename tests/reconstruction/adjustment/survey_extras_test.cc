// SPDX-License-Identifier: GPL-3.0-or-later
// camera_positions.csv, edges.csv and constraints.json, and what is said of names unknown.
#include <gtest/gtest.h>

#include <numbers>

#include "reconstruction/survey/read_survey.h"
#include "tests/reconstruction/survey/survey_files.h"

namespace insitu {
namespace {

class SurveyExtras : public SurveyFiles {
 protected:
  SurveyExtras() {
    network_ = MakeSyntheticNetwork({.has_extras = true});
    WriteSurvey(site_, network_.survey);
  }

  void ExpectConstraintError(const std::string& constraint, const std::string& subject) const {
    ReplaceLine("constraints.json", 3, constraint + ",");
    ExpectError("constraints.json", 3, subject);
  }
};

TEST_F(SurveyExtras, CameraPositionsAreReadAsTheyWereWritten) {
  const Survey read = ReadSurvey(site_, network_.photos);
  const auto& written = network_.survey.camera_positions;
  ASSERT_EQ(read.camera_positions.size(), 4u);
  for (size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(read.camera_positions[i].photo, written[i].photo);
    EXPECT_EQ(read.camera_positions[i].position, written[i].position);
    EXPECT_EQ(read.camera_positions[i].sigma, written[i].sigma);
    EXPECT_EQ(read.camera_positions[i].role, written[i].role);
    EXPECT_EQ(read.camera_positions[i].place.line, written[i].place.line);
  }
}

TEST_F(SurveyExtras, EdgesAreReadAsTheyWereWritten) {
  const Survey read = ReadSurvey(site_, network_.photos);
  const auto& written = network_.survey.edges;
  ASSERT_GT(written.size(), 12u);
  ASSERT_EQ(read.edges.size(), written.size());
  for (size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(read.edges[i].photo, written[i].photo);
    EXPECT_EQ(read.edges[i].from, written[i].from);
    EXPECT_EQ(read.edges[i].to, written[i].to);
    EXPECT_EQ(read.edges[i].pixel, written[i].pixel);
    EXPECT_EQ(read.edges[i].sigma_px, written[i].sigma_px);
    EXPECT_EQ(read.edges[i].place.line, written[i].place.line);
  }
}

TEST_F(SurveyExtras, ConstraintsAreReadAsTheyWereWritten) {
  const Survey read = ReadSurvey(site_, network_.photos);
  const auto& written = network_.survey.constraints;
  ASSERT_EQ(read.constraints.size(), written.size());
  for (size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(read.constraints[i].kind, written[i].kind);
    EXPECT_EQ(read.constraints[i].points, written[i].points);
    EXPECT_EQ(read.constraints[i].polygons, written[i].polygons);
    EXPECT_EQ(read.constraints[i].value, written[i].value);
    EXPECT_DOUBLE_EQ(read.constraints[i].sigma, written[i].sigma);
    EXPECT_EQ(read.constraints[i].place.line, written[i].place.line);
  }
}

TEST_F(SurveyExtras, AnAngleMayBeGivenInDegreesAndCommented) {
  ReplaceLine("constraints.json", 3,
              R"({"kind": "vertical", "points": ["a0", "a4"], "sigma_deg": 0.5, "comment": "!"},)");
  EXPECT_DOUBLE_EQ(ReadSurvey(site_, network_.photos).constraints[1].sigma,
                   0.5 * std::numbers::pi / 180);
}

TEST_F(SurveyExtras, TheirPointsAreInUse) {
  Survey survey;
  survey.edges.push_back({"P1", "e", "f", {1, 1}, 1, {"edges.csv", 2}});
  survey.constraints.push_back(
      {GeometricConstraint::Kind::kDistance, {}, {"d", "e"}, 1, 1, {"constraints.json", 3}});
  EXPECT_EQ(PointsInUse(survey), (std::set<std::string>{"d", "e", "f"}));
  EXPECT_EQ(PlaceOfPoint(survey, "e").path, "edges.csv");
  EXPECT_EQ(PlaceOfPoint(survey, "d").line, 3);
}

TEST_F(SurveyExtras, RefuseAPositionOfAnUnknownPhoto) {
  ReplaceLine("camera_positions.csv", 3, "P5,1,2,3,1,1,1,free");
  ExpectError("camera_positions.csv", 3, "photo 'P5' is not in the folder");
}

TEST_F(SurveyExtras, RefuseTwoPositionsOfAPhoto) {
  ReplaceLine("camera_positions.csv", 4, "P1,1,2,3,1,1,1,free");
  ExpectError("camera_positions.csv", 4, "already in line 2");
}

TEST_F(SurveyExtras, RefuseAnUnknownPositionRole) {
  ReplaceLine("camera_positions.csv", 4, "P3,1,2,3,1,1,1,control");
  ExpectError("camera_positions.csv", 4, "'fixed' or 'weighted' or 'free'");
}

TEST_F(SurveyExtras, RefuseAPositionWithoutSigma) {
  ReplaceLine("camera_positions.csv", 4, "P3,1,2,3,1,,1,free");
  ExpectError("camera_positions.csv", 4, "sigma_y");
}

TEST_F(SurveyExtras, RefuseAnEdgeOfOnePoint) {
  ReplaceLine("edges.csv", 5, "P1,b4,b4,10,10,0.4");
  ExpectError("edges.csv", 5, "b4");
}

TEST_F(SurveyExtras, RefuseAnEdgeOfAnUnknownPoint) {
  ReplaceLine("edges.csv", 5, "P1,b4,Shadow-A4,10,10,0.4");
  ExpectError("edges.csv", 5, "did you mean 'shadow_a4'?");
}

TEST_F(SurveyExtras, RefuseAnEdgeOutsideAnyFrame) {
  ReplaceLine("edges.csv", 5, "P1,b4,b5,1e9,10,0.4");
  ExpectError("edges.csv", 5, "1e9");
}

TEST_F(SurveyExtras, RefuseAConstraintOfAnUnknownPoint) {
  ExpectConstraintError(
      R"({"kind": "height", "points": ["a0", "soth"], "value_m": 0, "sigma_m": 1})",
      "did you mean 'south'?");
}

TEST_F(SurveyExtras, RefuseAConstraintOfAnUnknownPolygon) {
  ExpectConstraintError(R"({"kind": "vertical", "polygons": ["b_wal0"], "sigma_deg": 1})",
                        "did you mean 'b_wall0'?");
}

TEST_F(SurveyExtras, RefuseAnUnknownKind) {
  ExpectConstraintError(R"({"kind": "lenght", "points": ["a0", "a1"], "value_m": 1, "sigma_m": 1})",
                        "kind is 'lenght', expected one of distance");
}

TEST_F(SurveyExtras, RefuseAConstraintWithoutSigma) {
  ExpectConstraintError(R"({"kind": "distance", "points": ["a0", "a1"], "value_m": 1})", "sigma_m");
}

TEST_F(SurveyExtras, RefuseTwoSigmas) {
  ExpectConstraintError(
      R"({"kind": "vertical", "points": ["a0", "a4"], "sigma_deg": 1, "sigma_mm_per_m": 1})",
      "either");
}

TEST_F(SurveyExtras, RefuseALengthAsSigmaOfAnAngle) {
  ExpectConstraintError(R"({"kind": "vertical", "points": ["a0", "a4"], "sigma_m": 1})",
                        "\"constraints[1].sigma_m\" is not a key of a vertical constraint");
}

TEST_F(SurveyExtras, RefuseADistanceOfZero) {
  ExpectConstraintError(
      R"({"kind": "distance", "points": ["a0", "a1"], "value_m": 0, "sigma_m": 1})", "value_m");
}

TEST_F(SurveyExtras, RefuseAParallelOfOneEdge) {
  ExpectConstraintError(R"({"kind": "parallel", "points": ["a0", "a1"], "sigma_deg": 1})",
                        "4 distinct names in \"points\" (two edges) or 2 in \"polygons\"");
}

TEST_F(SurveyExtras, RefuseAnEdgeParallelToItself) {
  ExpectConstraintError(
      R"({"kind": "parallel", "points": ["a0", "a1", "a1", "a0"], "sigma_deg": 1})", "twice");
}

TEST_F(SurveyExtras, SayWhichNameWasProbablyMeant) {
  std::erase_if(network_.survey.observations,
                [](const auto& mark) { return mark.photo == "P1" && mark.point == "shadow_a5"; });
  WriteSurvey(site_, network_.survey);
  ReplaceLine("observations.csv", 5, "P1,SHADOW A5,100,100,0.4");
  ExpectError("observations.csv", 5, "did you mean 'shadow_a5'?");
}

TEST_F(SurveyExtras, SayThatAPhotoIsNamedWithoutItsEnding) {
  ReplaceLine("observations.csv", 5, "P1.jpg,a0,100,100,0.4");
  ExpectError("observations.csv", 5, "write 'P1', without the ending");
}

// Whatever is done to a file, it is read or refused.
TEST_F(SurveyExtras, NoCutInAFileIsMoreThanAnError) {
  network_.survey.observations.resize(9);
  network_.survey.edges.resize(4);
  network_.survey.sun_pairs.clear();
  network_.survey.control_points.resize(12);
  const std::set<std::string> kept = {"b_wall0", "b_roof", "c_wall0", "c_roof"};
  std::erase_if(network_.survey.polygons,
                [&](const auto& polygon) { return !kept.contains(polygon.name); });
  WriteSurvey(site_, network_.survey);
  for (const std::string file :
       {"control_points.csv", "observations.csv", "polygons.json", "directions.json",
        "camera_positions.csv", "edges.csv", "constraints.json"}) {
    const std::string content = ReadWhole(site_.survey() / file);
    int refused = 0;
    for (size_t size = content.size(); size-- > 0;) {
      std::filesystem::resize_file(site_.survey() / file, size);
      try {
        ReadSurvey(site_, network_.photos);
      } catch (const InputError&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, 0) << file;
    WriteWhole(site_.survey() / file, content);
  }
  EXPECT_NO_THROW(ReadSurvey(site_, network_.photos));
}

TEST_F(SurveyExtras, NoCellIsMoreThanAnError) {
  for (const std::string file :
       {"control_points.csv", "observations.csv", "camera_positions.csv", "edges.csv"}) {
    const std::string content = ReadWhole(site_.survey() / file);
    const size_t begin = content.find('\n') + 1, end = content.find('\n', begin);
    const std::string row = content.substr(begin, end - begin);
    size_t cell = 0;
    for (size_t comma = 0; comma != std::string::npos; ++cell) {
      const size_t next = row.find(',', comma + (cell > 0));
      for (const std::string text : {"", "nan", "-inf", "1e999", "1e308", "-1e308", "0x1p3", "1;2",
                                     "\"", "\xff\xfe", "1e-320", "12,5"}) {
        const size_t from = comma + (cell > 0);
        ReplaceLine(
            file, 2,
            row.substr(0, from) + text + (next == std::string::npos ? "" : row.substr(next)));
        try {
          ReadSurvey(site_, network_.photos);
        } catch (const InputError& error) {
          EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
        }
      }
      comma = next;
    }
    EXPECT_GE(cell, 5u);
    WriteWhole(site_.survey() / file, content);
  }
}

}  // namespace
}  // namespace insitu
