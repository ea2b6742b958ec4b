// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/verdict.h"

#include <gtest/gtest.h>

#include "reconstruction/adjustment/adjust.h"
#include "reconstruction/verdict/advice.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

class Verdict : public testing::Test {
 protected:
  Adjustment Adjusted() const {
    AdjustmentOptions options;
    options.plane_sigma = options.zenith_sigma = options.sun_sigma = 1e-4;
    const size_t count = network_.cameras[0].intrinsics().size();
    const Eigen::VectorXd sigma = Eigen::VectorXd::Constant(count, 1e-6);
    const PhotoLens lens{"camera", sigma.cwiseAbs2().asDiagonal()};
    return Adjust(survey_, network_.photos, network_.cameras, options,
                  std::vector<PhotoLens>(network_.photos.size(), lens));
  }
  // "single" is a vertex that one photo shows; surveyed, nothing is weak any more.
  void SurveyThePointOfOneRay() {
    std::erase_if(survey_.observations, [](const auto& mark) { return mark.point == "single"; });
    ControlPoint surveyed = survey_.control_points.front();
    surveyed.name = "single";
    surveyed.position = network_.points.at("single");
    survey_.control_points.push_back(surveyed);
  }
  SyntheticNetwork network_ = MakeSyntheticNetwork();
  Survey survey_ = WithNoise(network_.survey, 1);
};

const Finding* Find(const std::vector<Finding>& findings, const std::string& text) {
  for (const Finding& finding : findings) {
    if (finding.reason.find(text) != std::string::npos) return &finding;
  }
  return nullptr;
}

std::string Status(const std::vector<Finding>& findings) {
  return VerdictReport(findings)["status"].asString();
}

TEST_F(Verdict, ReviewsAPointOfOneRay) {
  const auto findings = Judge(Adjusted());
  EXPECT_EQ(Status(findings), "review");
  const Finding* few = Find(findings, "fewer than two photos");
  ASSERT_TRUE(few);
  EXPECT_NE(few->reason.find("single"), std::string::npos);
  EXPECT_NE(few->remedy, "");
}

TEST_F(Verdict, HardlyEverObjectsToALensThatFits) {
  int objections = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    survey_ = WithNoise(network_.survey, seed);
    objections += Find(Judge(Adjusted()), "does not fit: the residuals") != nullptr;
  }
  EXPECT_LE(objections, 2);
}

TEST_F(Verdict, PassesWhenThereIsNothingToObjectTo) {
  SurveyThePointOfOneRay();
  const auto findings = Judge(Adjusted());
  for (const Finding& finding : findings) {
    EXPECT_EQ(finding.severity, Severity::kNote) << finding.reason;
  }
  EXPECT_EQ(Status(findings), "pass");
}

TEST_F(Verdict, LeavesControlPointsOutWhereThereAreNoCheckPoints) {
  std::erase_if(survey_.control_points,
                [](const auto& point) { return point.role == ControlRole::kCheck; });
  const auto findings = Judge(Adjusted());
  const Finding* unverified = Find(findings, "accuracy not verified independently");
  ASSERT_TRUE(unverified);
  EXPECT_NE(unverified->reason.find("predicted from the rest"), std::string::npos);
}

TEST_F(Verdict, FailsOnAGrossErrorAndNamesIt) {
  ImageObservation& wrong = survey_.observations[20];
  wrong.pixel.y() += 60;
  const auto findings = Judge(Adjusted());
  EXPECT_EQ(Status(findings), "fail");
  EXPECT_TRUE(Find(findings, "global test"));
  const Finding* suspect = Find(
      findings, "the suspect is mark '" + wrong.point + "' on photo '" + wrong.photo + "' (y)");
  ASSERT_TRUE(suspect);
  EXPECT_NE(suspect->remedy.find("measure mark '" + wrong.point + "'"), std::string::npos);
}

TEST_F(Verdict, FailsOnASurelyWrongMarkButNotOnAWrongMatch) {
  Adjustment adjustment = Adjusted();
  adjustment.residuals[0].w = 8;
  EXPECT_EQ(Find(Judge(adjustment), "the suspect is")->severity, Severity::kFail);
  adjustment.residuals[0].w = 4.5;
  EXPECT_EQ(Find(Judge(adjustment), "the suspect is")->severity, Severity::kReview);
  adjustment.residuals[0].w = 3.4;  // one in 1500; there are hundreds
  EXPECT_EQ(Find(Judge(adjustment), "the suspect is")->severity, Severity::kNote);
  adjustment.residuals[0].w = 8;
  adjustment.residuals[0].is_tie_point = true;
  EXPECT_FALSE(Find(Judge(adjustment), "the suspect is"));
  EXPECT_EQ(Suspect(adjustment)->w, 8);
  adjustment.residuals[1].w = 4;  // what the surveyor measured goes before any tie point
  EXPECT_EQ(Suspect(adjustment)->w, 4);
}

TEST_F(Verdict, ReviewsTiePointsWhenMoreAreWrongThanChanceExplains) {
  Adjustment adjustment = Adjusted();
  ObservationResidual tie = adjustment.residuals[0];
  tie.is_tie_point = true;
  const auto with_flagged = [&](int flagged) {
    Adjustment more = adjustment;
    for (int i = 0; i < 10000; ++i) {
      tie.w = i < flagged ? 5 : 0.5;
      more.residuals.push_back(tie);
    }
    return Judge(more);
  };
  EXPECT_FALSE(Find(with_flagged(12), "coordinates of tie points"));
  EXPECT_EQ(Find(with_flagged(60), "60 of 10000 coordinates of tie points")->severity,
            Severity::kReview);
}

TEST_F(Verdict, FailsWithoutConvergence) {
  Adjustment adjustment = Adjusted();
  adjustment.is_converged = false;
  EXPECT_EQ(Find(Judge(adjustment), "has not converged")->severity, Severity::kFail);
}

TEST_F(Verdict, FailsWhenCheckPointsAreFarOff) {
  for (ControlPoint& point : survey_.control_points) {
    if (point.role == ControlRole::kCheck) point.position.x() += 0.5;
  }
  const auto findings = Judge(Adjusted());
  EXPECT_EQ(Status(findings), "fail");
  const Finding* differ = Find(findings, "the check points differ");
  ASSERT_TRUE(differ);
  EXPECT_NE(differ->reason.find("b4"), std::string::npos);
}

TEST_F(Verdict, NamesCorrelationsAndAFreeDatumWithTheirRemedies) {
  Adjustment adjustment = Adjusted();
  adjustment.correlations = {
      {Correlation::Of::kPhoto, "photo P1 center x", "photo P1 rotation y", -0.997}};
  adjustment.datum_defect = 7;
  adjustment.datum = "free in 7 of 7";
  const auto findings = Judge(adjustment);
  const Finding* correlated = Find(findings, "photo P1 center x with photo P1 rotation y -0.997");
  ASSERT_TRUE(correlated);
  EXPECT_NE(correlated->remedy, "");
  EXPECT_EQ(correlated->severity, Severity::kReview);
  int said = 0;
  for (const Finding& finding : findings) {
    said += finding.reason.find("the datum is free") != std::string::npos;
  }
  EXPECT_EQ(said, 1);
}

TEST_F(Verdict, SeesControlOnOneLineAndPhotosFromOnePlace) {
  Adjustment adjustment = Adjusted();
  for (size_t i = 0; i < adjustment.control.size(); ++i) {
    adjustment.control[i].surveyed = Eigen::Vector3d(1, 2, 0.1) * static_cast<double>(i);
  }
  for (AdjustedPose& pose : adjustment.poses) {
    pose.cam_from_world = adjustment.poses[0].cam_from_world;
  }
  const auto findings = Judge(adjustment);
  EXPECT_TRUE(Find(findings, "nearly on one line"));
  EXPECT_TRUE(Find(findings, "from nearly one place"));
  EXPECT_TRUE(Find(findings, "within 5 degrees"));
}

TEST_F(Verdict, NamesMarksWhereNoBoardWasPhotographed) {
  CameraContexts cameras;
  CameraContext& camera = cameras[0];
  camera.calibrated_region = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};  // mrcal's, the only word on it
  const auto findings = Judge(Adjusted(), cameras);
  const Finding* outside = Find(findings, "no board was photographed");
  ASSERT_TRUE(outside);
  EXPECT_EQ(outside->severity, Severity::kReview);
  camera.calibration["width"] = network_.cameras[0].width();
  camera.calibration["height"] = network_.cameras[0].height();
  Json::Value& counts = camera.calibration["cells"]["counts"];
  counts[0][0] = counts[0][1] = counts[1][0] = counts[1][1] = 5;
  EXPECT_FALSE(Find(Judge(Adjusted(), cameras), "no board was photographed"));
}

TEST(IsCalibratedAt, CountsCellsFromTheFramesCorner) {
  CameraContext camera;
  EXPECT_TRUE(IsCalibratedAt(camera, {0, 0}));  // nothing is known
  camera.calibration["width"] = 30;
  camera.calibration["height"] = 20;
  Json::Value& counts = camera.calibration["cells"]["counts"];
  counts[0][0] = counts[0][1] = counts[1][0] = counts[1][1] = counts[1][2] = 1;
  counts[0][2] = 0;
  EXPECT_TRUE(IsCalibratedAt(camera, {19.4, 9.4}));
  EXPECT_FALSE(IsCalibratedAt(camera, {19.6, 9.4}));
  EXPECT_FALSE(IsCalibratedAt(camera, {29.5, -0.5}));
  EXPECT_TRUE(IsCalibratedAt(camera, {29.5, 19.5}));
}

TEST_F(Verdict, PassesOnWhatTheCalibrationObjectsTo) {
  CameraContexts cameras;
  Json::Value reason;
  reason["severity"] = "fail";
  reason["reason"] = "NOT CALIBRATED";
  reason["remedy"] = "Photograph a chessboard.";
  cameras[0].calibration["verdict"]["reasons"].append(reason);
  Adjustment adjustment = Adjusted();
  const auto findings = Judge(adjustment, cameras);
  const Finding* finding = Find(findings, "NOT CALIBRATED");
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->severity, Severity::kFail);
  EXPECT_EQ(finding->remedy, "Photograph a chessboard.");
  adjustment.cameras[0].parameters[0].is_adjusted = true;
  EXPECT_EQ(Find(Judge(adjustment, cameras), "NOT CALIBRATED")->severity, Severity::kReview);
  cameras[0].calibration["verdict"]["reasons"][0]["severity"] = "review";
  EXPECT_EQ(Find(Judge(adjustment, cameras), "NOT CALIBRATED")->severity, Severity::kNote);
  adjustment.cameras[0].parameters[0].is_adjusted = false;
  EXPECT_EQ(Find(Judge(adjustment, cameras), "NOT CALIBRATED")->severity, Severity::kReview);
  cameras[0].calibration["verdict"]["reasons"][0]["severity"] = "note";
  EXPECT_EQ(Find(Judge(adjustment, cameras), "NOT CALIBRATED")->severity, Severity::kNote);
}

TEST_F(Verdict, ReviewsALensThatCountsAsExact) {
  SurveyThePointOfOneRay();
  Adjustment adjustment = Adjusted();
  EXPECT_FALSE(Find(Judge(adjustment), "counts as exact"));
  adjustment.cameras[0].is_considered = false;
  EXPECT_EQ(Status(Judge(adjustment)), "review");
  const auto findings = Judge(adjustment);
  ASSERT_TRUE(Find(findings, "counts as exact"));
  EXPECT_NE(Find(findings, "counts as exact")->remedy.find("--self-calibrate"), std::string::npos);
  adjustment.cameras[0].lens_model = "LENSMODEL_SPLINED_STEREOGRAPHIC_order=3_Nx=12_Ny=9";
  EXPECT_TRUE(Find(Judge(adjustment), "a splined model brings no covariance"));
  adjustment.cameras[0].parameters[0].is_adjusted = true;
  EXPECT_FALSE(Find(Judge(adjustment), "counts as exact"));
}

// Names of tie points are others at the next run, and no option leaves one out.
TEST(Advice, OfATiePointIsWhatCanBeDone) {
  ObservationResidual row;
  row.kind = ObservationKind::kImage;
  row.subject = "tie_000123";
  row.photo = "P";
  row.is_tie_point = true;
  EXPECT_NE(Advice(row).find("--points"), std::string::npos);
  EXPECT_EQ(Advice(row).find("tie_000123"), std::string::npos);
}

TEST(Advice, TellsWhatToDoForEveryKindOfObservation) {
  using Kind = ObservationKind;
  const std::pair<Kind, const char*> groups[] = {
      {Kind::kImage, "image y"},     {Kind::kEdge, "edge"},
      {Kind::kControl, "control y"}, {Kind::kCameraPosition, "camera y"},
      {Kind::kLens, "lens"},         {Kind::kPlane, "plane"},
      {Kind::kSun, "sun"},           {Kind::kZenith, "zenith"},
      {Kind::kDistance, "distance"}, {Kind::kHeight, "height"},
      {Kind::kAngle, "angle"}};
  for (const auto& [kind, group] : groups) {
    ObservationResidual row;
    row.kind = kind;
    row.axis = 1;
    row.subject = "S";
    row.photo = "P";
    EXPECT_EQ(Group(row), group);
    EXPECT_NE(Advice(row), "") << group;
    EXPECT_NE(Describe(row), "") << group;
  }
}

TEST(Advice, NamesAVertexWithItsPolygon) {
  ObservationResidual row;
  row.kind = ObservationKind::kPlane;
  row.polygon = "south wall";
  row.subject = "a3";
  EXPECT_EQ(Subject(row), "south wall a3");
  EXPECT_EQ(Describe(row), "plane 'south wall a3'");
}

}  // namespace
}  // namespace insitu
