// SPDX-License-Identifier: GPL-3.0-or-later
// Each test spoils the town's survey as surveyors do; the right diagnosis must come first.
#include "reconstruction/diagnosis/survey_diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = Diagnosis::Kind;

class SurveyDiagnosis : public testing::Test {
 protected:
  SurveyDiagnosis() { survey_ = WithNoise(network_.survey, 7); }

  std::vector<Diagnosis> Diagnoses() const {
    return Diagnose(survey_, network_.photos, network_.cameras);
  }

  // The first diagnosis is of this file and line and contains all of these words.
  void ExpectFirst(const std::string& file, int line, Kind kind,
                   const std::vector<std::string>& words) const {
    const std::vector<Diagnosis> diagnoses = Diagnoses();
    ASSERT_FALSE(diagnoses.empty());
    const Diagnosis& first = diagnoses.front();
    EXPECT_EQ(first.place.path, file) << Text(first);
    EXPECT_EQ(first.place.line, line) << Text(first);
    EXPECT_EQ(first.kind, kind) << Text(first);
    for (const std::string& word : words) {
      EXPECT_NE(first.message.text().find(word), std::string::npos) << word << "\n" << Text(first);
    }
    if (kind == Kind::kFault) {
      EXPECT_THROW(RequireSound(survey_, network_.photos, network_.cameras), InputError);
    }
    RecordProperty("message", Text(first));
  }

  template <typename Function>
  void MoveControl(const Function& moved) {
    for (ControlPoint& point : survey_.control_points) point.position = moved(point.position);
  }

  template <typename Function>
  void MoveMarks(const Function& moved) {
    for (ImageObservation& mark : survey_.observations) mark.pixel = moved(mark.pixel);
  }

  ControlPoint& Control(const std::string& name) {
    return *std::find_if(survey_.control_points.begin(), survey_.control_points.end(),
                         [&](const auto& point) { return point.name == name; });
  }

  ImageObservation& Mark(const std::string& photo, const std::string& point) {
    return *std::find_if(
        survey_.observations.begin(), survey_.observations.end(),
        [&](const auto& mark) { return mark.photo == photo && mark.point == point; });
  }

  SyntheticNetwork network_ = MakeSyntheticNetwork({.has_extras = true});
  Survey survey_;
};

TEST_F(SurveyDiagnosis, OfMarksOnAResizedCopy) {
  MoveMarks([](const Vector2d& p) { return Vector2d((p.array() + 0.5) / 2 - 0.5); });
  ExpectFirst("observations.csv", 2, Kind::kFault, {" 0.5", "times as large", "by 2", "px (RMS)"});
}

TEST_F(SurveyDiagnosis, OfMarksOnALargerCopyOfOnePhoto) {
  for (ImageObservation& mark : survey_.observations) {
    if (mark.photo == "P1") mark.pixel = (mark.pixel.array() + 0.5) * 1.5 - 0.5;
  }
  const std::vector<Diagnosis> all = Diagnoses();
  ASSERT_FALSE(all.empty());
  EXPECT_NE(all[0].message.text().find("copy 1.50 times as large"), std::string::npos)
      << Text(all[0]);
  EXPECT_NE(all[0].message.text().find("photo 'P1'"), std::string::npos) << Text(all[0]);
}

TEST_F(SurveyDiagnosis, OfMarksInMillimetresAndInShares) {
  const Survey sound = survey_;
  MoveMarks([](const Vector2d& p) { return Vector2d((p.array() + 0.5) * 0.02 - 0.5); });
  ExpectFirst("observations.csv", 2, Kind::kFault, {"millimetres", "50"});
  survey_ = sound;
  const Vector2d size(network_.cameras[0].width(), network_.cameras[0].height());
  MoveMarks([&](const Vector2d& p) { return Vector2d((p.array() + 0.5) / size.array()); });
  ExpectFirst("observations.csv", 2, Kind::kFault, {"shares of the photograph"});
}

TEST_F(SurveyDiagnosis, OfMarksOnACroppedCopy) {
  for (ImageObservation& mark : survey_.observations) {
    if (mark.photo == "P1") mark.pixel -= Vector2d(220, 130);
  }
  const std::vector<Diagnosis> all = Diagnoses();
  ASSERT_FALSE(all.empty());
  EXPECT_NE(all[0].message.text().find("cropped by 2"), std::string::npos) << Text(all[0]);
}

TEST_F(SurveyDiagnosis, OfASoundSurveyIsNothing) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    survey_ = WithNoise(network_.survey, seed);
    const std::vector<Diagnosis> diagnoses = Diagnoses();
    EXPECT_TRUE(diagnoses.empty()) << "seed " << seed << ": " << Text(diagnoses.front());
  }
}

TEST_F(SurveyDiagnosis, OfMarksThreeTimesWorseThanSaidIsNothing) {
  for (ImageObservation& mark : network_.survey.observations) mark.sigma_px *= 3;
  for (unsigned seed = 0; seed < 20; ++seed) {
    survey_ = WithNoise(network_.survey, seed);
    for (ImageObservation& mark : survey_.observations) mark.sigma_px /= 3;
    const std::vector<Diagnosis> diagnoses = Diagnoses();
    EXPECT_TRUE(diagnoses.empty()) << "seed " << seed << ": " << Text(diagnoses.front());
  }
}

TEST_F(SurveyDiagnosis, ControlWithXAndYExchanged) {
  MoveControl([](const Vector3d& p) { return Vector3d(p.y(), p.x(), p.z()); });
  ExpectFirst("control_points.csv", 2, Kind::kFault,
              {"left-handed", "x and y are exchanged", "px (RMS) as given"});
}

TEST_F(SurveyDiagnosis, ControlOfTheOtherHand) {
  MoveControl([](const Vector3d& p) { return Vector3d(-p.x(), p.y(), p.z()); });
  ExpectFirst("control_points.csv", 2, Kind::kFault, {"left-handed", "an axis counts backwards"});
}

TEST_F(SurveyDiagnosis, DepthsForHeights) {
  MoveControl([](const Vector3d& p) { return Vector3d(p.x(), p.y(), -p.z()); });
  ExpectFirst("control_points.csv", 2, Kind::kFault, {"left-handed", "z counts downwards"});
}

TEST_F(SurveyDiagnosis, MarksWithXAndYExchanged) {
  MoveMarks([](const Vector2d& p) { return Vector2d(p.y(), p.x()); });
  ExpectFirst("observations.csv", 2, Kind::kFault, {"the marks' x and y are exchanged", "'P1'"});
}

TEST_F(SurveyDiagnosis, MarksCountedFromTheBottom) {
  MoveMarks([](const Vector2d& p) { return Vector2d(p.x(), 1199 - p.y()); });
  ExpectFirst("observations.csv", 2, Kind::kFault,
              {"y is counted from the bottom", "height - 1 - y"});
}

TEST_F(SurveyDiagnosis, MarksOfATurnedCopy) {
  MoveMarks([](const Vector2d& p) { return Vector2d(1199 - p.y(), p.x()); });
  ExpectFirst("observations.csv", 2, Kind::kFault, {"turned copy", "EXIF"});
}

TEST_F(SurveyDiagnosis, MarksOfOnePhotoCountedFromTheBottom) {
  for (ImageObservation& mark : survey_.observations) {
    if (mark.photo == "P3") mark.pixel.y() = 1199 - mark.pixel.y();
  }
  ExpectFirst("observations.csv", Mark("P3", "a0").place.line, Kind::kFault,
              {"y is counted from the bottom", "on photo 'P3' fit"});
}

TEST_F(SurveyDiagnosis, HeightsInFeet) {
  MoveControl([](const Vector3d& p) { return Vector3d(p.x(), p.y(), p.z() / 0.3048); });
  ExpectFirst("control_points.csv", 2, Kind::kFault, {"z of the control points in feet"});
}

TEST_F(SurveyDiagnosis, HeightsInMillimetres) {
  MoveControl([](const Vector3d& p) { return Vector3d(p.x(), p.y(), p.z() * 1000); });
  ExpectFirst("control_points.csv", 2, Kind::kFault, {"z of the control points in millimetres"});
}

TEST_F(SurveyDiagnosis, AllInMillimetresAgainstDistances) {
  for (const std::string to : {"a1", "a4"}) {
    survey_.constraints.push_back({GeometricConstraint::Kind::kDistance,
                                   {},
                                   {"a0", to},
                                   (network_.points.at(to) - network_.points.at("a0")).norm(),
                                   0.01,
                                   {"constraints.json", 20}});
  }
  survey_.camera_positions.clear();
  MoveControl([](const Vector3d& p) { return Vector3d(1000 * p); });
  for (ControlPoint& point : survey_.control_points) point.sigma *= 1000;
  ExpectFirst("control_points.csv", 2, Kind::kFault, {"in millimetres", "constraints.json:"});
}

TEST_F(SurveyDiagnosis, AllInMillimetresAgainstCameraPositions) {
  survey_.constraints.clear();
  MoveControl([](const Vector3d& p) { return Vector3d(1000 * p); });
  for (ControlPoint& point : survey_.control_points) point.sigma *= 1000;
  ExpectFirst("camera_positions.csv", 2, Kind::kFault, {"control points in millimetres"});
}

TEST_F(SurveyDiagnosis, AllInMillimetresWithoutWitnessIsTheLikelyCause) {
  survey_.constraints.clear();
  survey_.camera_positions.clear();
  MoveControl([](const Vector3d& p) { return Vector3d(1000 * p); });
  for (ControlPoint& point : survey_.control_points) point.sigma *= 1000;
  ExpectFirst("control_points.csv", 2, Kind::kMisfit, {"are these in millimetres?"});
}

TEST_F(SurveyDiagnosis, AControlPointUnderAMisspeltName) {
  Control("a1").name = "a1x";
  ExpectFirst("control_points.csv", Control("a1x").place.line, Kind::kMisfit,
              {"'a1x' is marked on no photo", "did you mean 'a1'?"});
  Control("a1x").name = "a9";  // another number is another point
  EXPECT_TRUE(Diagnoses().empty());
}

TEST_F(SurveyDiagnosis, SigmasInMillimetres) {
  for (ControlPoint& point : survey_.control_points) point.sigma *= 1000;
  ExpectFirst("control_points.csv", 2, Kind::kQuestion, {"sigmas of 5.00 m", "in millimetres?"});
}

TEST_F(SurveyDiagnosis, ADistanceInMillimetres) {
  survey_.constraints.front().value *= 1000;
  ExpectFirst("constraints.json", 2, Kind::kFault, {"'b4' to 'b5'", "is value_m in millimetres?"});
}

// The control points could be in kilometres as well, but nobody measures sites in kilometres.
TEST_F(SurveyDiagnosis, AllDistancesInMillimetres) {
  survey_.constraints.clear();
  for (const std::string to : {"a1", "a4", "a3"}) {
    const double distance = (network_.points.at(to) - network_.points.at("a0")).norm();
    survey_.constraints.push_back({GeometricConstraint::Kind::kDistance,
                                   {},
                                   {"a0", to},
                                   1000 * distance,
                                   10,
                                   {"constraints.json", 20}});
  }
  ExpectFirst("constraints.json", 20, Kind::kFault, {"'a0' to 'a1'", "is value_m in millimetres?"});
}

TEST_F(SurveyDiagnosis, TwoControlRowsExchanged) {
  std::swap(Control("a1").name, Control("g8").name);
  const int line = Control("g8").place.line;  // where a1 stood
  ExpectFirst("control_points.csv", line, Kind::kFault, {"'g8' and 'a1'", "exchanged"});
}

TEST_F(SurveyDiagnosis, TwoNamesExchangedOnAPhoto) {
  std::swap(Mark("P2", "a2").point, Mark("P2", "g5").point);
  const ImageObservation& first = Mark("P2", "g5");
  ExpectFirst("observations.csv", first.place.line, Kind::kFault,
              {"exchanged on this photo", "'P2'"});
}

TEST_F(SurveyDiagnosis, AMarkOfTheWrongName) {
  std::erase_if(survey_.observations,
                [](const auto& mark) { return mark.photo == "P4" && mark.point == "g6"; });
  Mark("P4", "g7").point = "g6";
  ExpectFirst("observations.csv", Mark("P4", "g6").place.line, Kind::kFault,
              {"did you mean 'g7'?"});
}

TEST_F(SurveyDiagnosis, AMarkNamedAsACheckPoint) {
  std::erase_if(survey_.observations,
                [](const auto& mark) { return mark.photo == "P4" && mark.point == "a6"; });
  Mark("P4", "b4").point = "a6";
  ExpectFirst("observations.csv", Mark("P4", "a6").place.line, Kind::kFault,
              {"did you mean 'b4'?"});
}

TEST_F(SurveyDiagnosis, APointNamedWronglyOnAllPhotos) {
  std::erase_if(survey_.observations, [](const auto& mark) { return mark.point == "a6"; });
  for (ImageObservation& mark : survey_.observations) {
    if (mark.point == "b5") mark.point = "a6";
  }
  ExpectFirst("observations.csv", Mark("P1", "a6").place.line, Kind::kFault,
              {"did you mean 'b5'?"});
}

TEST_F(SurveyDiagnosis, AMarkWithXAndYExchanged) {
  ImageObservation& mark = Mark("P1", "g4");
  std::swap(mark.pixel.x(), mark.pixel.y());
  ExpectFirst("observations.csv", mark.place.line, Kind::kFault, {"its x and y are exchanged"});
}

TEST_F(SurveyDiagnosis, AMarkFarOffIsAQuestion) {
  ImageObservation& mark = Mark("P1", "g4");
  mark.pixel += Vector2d(40, -30);
  ExpectFirst("observations.csv", mark.place.line, Kind::kMisfit,
              {"'g4'", "px from where its coordinates appear"});
}

TEST_F(SurveyDiagnosis, AControlPointFarOffIsAQuestion) {
  Control("g2").position.z() += 10;
  ExpectFirst("control_points.csv", Control("g2").place.line, Kind::kMisfit,
              {"'g2'", "only z is wrong"});
}

TEST_F(SurveyDiagnosis, AControlPointInMillimetres) {
  Control("g2").position *= 1000;
  ExpectFirst("control_points.csv", Control("g2").place.line, Kind::kFault, {"'g2'"});
}

TEST_F(SurveyDiagnosis, TwoSystemsFarApart) {
  for (const std::string name : {"a0", "a1", "a2"}) {
    Control(name).position += Vector3d(2e6, 1e6, 0);
  }
  ExpectFirst("control_points.csv", Control("a0").place.line, Kind::kFault,
              {"two coordinate systems", "'a0', 'a1' and 'a2'", "2000 km"});
}

TEST_F(SurveyDiagnosis, TwoSystemsThatLieNear) {
  for (const std::string name : {"a0", "a2", "a5", "g7"}) {
    Control(name).position += Vector3d(3, -2, 47);
  }
  ExpectFirst("control_points.csv", Control("a0").place.line, Kind::kFault,
              {"two coordinate systems", "'a0', 'a2', 'a5' and 'g7'", "shifted"});
}

TEST_F(SurveyDiagnosis, DegreesForMetres) {
  MoveControl(
      [](const Vector3d& p) { return Vector3d(8.5 + p.x() * 1e-5, 47 + p.y() * 1e-5, p.z()); });
  ExpectFirst("control_points.csv", 2, Kind::kFault, {"longitude and latitude"});
}

TEST_F(SurveyDiagnosis, TheSameCoordinatesTwiceAreAQuestion) {
  survey_.constraints.clear();
  Control("b5").position = Control("b4").position;
  ExpectFirst("control_points.csv", Control("b5").place.line, Kind::kQuestion,
              {"same coordinates as 'b4'"});
}

TEST_F(SurveyDiagnosis, TheSameMarksOnTwoPhotos) {
  std::erase_if(survey_.observations, [](const auto& mark) { return mark.photo == "P2"; });
  const std::vector<ImageObservation> marks = survey_.observations;
  for (ImageObservation mark : marks) {
    if (mark.photo != "P1") continue;
    mark.photo = "P2";
    mark.place.line += 500;
    survey_.observations.push_back(mark);
  }
  survey_.camera_positions.clear();
  ExpectFirst("observations.csv", 502, Kind::kFault, {"'P2'", "very marks of photo 'P1'"});
}

TEST_F(SurveyDiagnosis, TheSamePhotoMarkedTwiceIsAQuestion) {
  std::erase_if(survey_.observations, [](const auto& mark) { return mark.photo == "P2"; });
  for (ImageObservation mark : WithNoise(network_.survey, 8).observations) {
    if (mark.photo != "P1") continue;
    mark.photo = "P2";
    mark.place.line += 500;
    survey_.observations.push_back(mark);
  }
  survey_.camera_positions.clear();
  ExpectFirst("observations.csv", 502, Kind::kQuestion,
              {"'P1' and 'P2'", "one exterior orientation"});
}

TEST_F(SurveyDiagnosis, CameraPositionsExchanged) {
  std::swap(survey_.camera_positions[1].photo, survey_.camera_positions[3].photo);
  ExpectFirst("camera_positions.csv", 3, Kind::kFault, {"photo 'P4'", "did you mean photo 'P2'?"});
}

TEST_F(SurveyDiagnosis, CameraPositionsWithXAndYExchanged) {
  for (CameraPosition& camera : survey_.camera_positions) {
    std::swap(camera.position.x(), camera.position.y());
  }
  ExpectFirst("camera_positions.csv", 2, Kind::kFault, {"have x and y exchanged"});
}

TEST_F(SurveyDiagnosis, ACameraPositionFarOffIsAQuestion) {
  survey_.camera_positions[1].position.z() += 1.6;  // to the ground instead of the lens
  ExpectFirst("camera_positions.csv", 3, Kind::kMisfit, {"'P2'", "centre of the lens"});
}

TEST_F(SurveyDiagnosis, APointLeftOutForItsSingleMark) {
  survey_.lone_marks = {{{"P1", "knob", {100, 100}, 0.4, {"observations.csv", 900}}, {}}};
  ExpectFirst("observations.csv", 900, Kind::kQuestion,
              {"point 'knob'", "one ray only", "photo 'P1'", "left out", "second photo"});
}

}  // namespace
}  // namespace insitu
