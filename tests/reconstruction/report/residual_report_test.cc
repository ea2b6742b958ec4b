// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/residual_report.h"

#include <gtest/gtest.h>
#include <json/writer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "reconstruction/adjustment/adjust.h"
#include "reconstruction/report/residual_csv.h"
#include "reconstruction/report/residual_page.h"
#include "tests/calibration/program/drawn_page.h"
#include "tests/calibration/program/embedded_report.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

AdjustmentOptions StrictOptions() {
  AdjustmentOptions options;
  options.plane_sigma = options.zenith_sigma = options.sun_sigma = 1e-4;
  return options;
}

Adjustment AdjustNetwork(const SyntheticNetwork& network, const Survey& survey) {
  return Adjust(survey, network.photos, network.cameras, StrictOptions());
}

class Report : public testing::Test {
 protected:
  Json::Value Make() const { return ResidualReport(adjustment_, survey_); }
  SyntheticNetwork network_ = MakeSyntheticNetwork();
  Survey survey_ = WithNoise(network_.survey, 1);
  Adjustment adjustment_ = AdjustNetwork(network_, survey_);
};

TEST_F(Report, HasEverySection) {
  const Json::Value report = Make();
  for (const char* key : {"format",         "verdict",    "identity",     "conventions",
                          "summary",        "groups",     "correlations", "cameras",
                          "photos",         "control",    "check",        "left_out",
                          "points",         "tie_points", "polygons",     "adjoining_polygons",
                          "plane_effect",   "directions", "observations", "histogram",
                          "lens_residuals", "montage"}) {
    EXPECT_TRUE(report.isMember(key)) << key;
  }
  for (const char* key : {"statistic", "low", "high", "alpha", "p", "is_met"}) {
    EXPECT_TRUE(report["summary"]["global_test"].isMember(key)) << key;
  }
  for (const char* key : {"center", "center_sigma_m", "angles_deg", "cam_from_world_rotation",
                          "covariance", "lens_correlation", "rms_xy_px", "max_xy_px", "coverage",
                          "marks", "tie_point_grid", "outside_calibrated_region"}) {
    EXPECT_TRUE(report["photos"][0].isMember(key)) << key;
  }
  for (const char* key :
       {"mean_m", "rms_m", "rms_plan_m", "rms_space_m", "max_m", "rms_over_sigma"}) {
    EXPECT_TRUE(report["control"].isMember(key)) << key;
    EXPECT_TRUE(report["check"].isMember(key)) << key;
  }
}

TEST_F(Report, SumsItsGroupsToTheWhole) {
  const Json::Value report = Make();
  int count = 0;
  double redundancy = 0, squares = 0;
  for (const Json::Value& group : report["groups"]) {
    count += group["count"].asInt();
    redundancy += group["redundancy"].asDouble();
    squares += std::pow(group["sigma0"].asDouble(), 2) * group["redundancy"].asDouble();
  }
  EXPECT_EQ(count, report["summary"]["observations"].asInt());
  EXPECT_NEAR(redundancy, report["summary"]["redundancy"].asDouble(), 1e-6);
  EXPECT_NEAR(squares, report["summary"]["global_test"]["statistic"].asDouble(), 1e-6 * squares);
  EXPECT_EQ(report["observations"]["count"].asInt(), count);
  int unknowns = 0;
  for (const Json::Value& part : report["summary"]["unknowns_of"]) unknowns += part.asInt();
  EXPECT_EQ(unknowns, report["summary"]["unknowns"].asInt());
  EXPECT_EQ(report["summary"]["unknowns_of"]["exterior orientations"].asInt(), 4 * 6);
  EXPECT_EQ(report["summary"]["termination"].asString(), "converged");
  EXPECT_EQ(report["photos"].size(), 4u);
  EXPECT_EQ(report["polygons"].size(), network_.survey.polygons.size());
  EXPECT_EQ(report["check"]["points"].size(), 2u);
}

TEST_F(Report, CountsEveryMarkOnceInItsPlots) {
  const Json::Value report = Make();
  const int marks = report["summary"]["marks"].asInt();
  EXPECT_EQ(marks, static_cast<int>(survey_.observations.size()));
  int in_photos = 0, in_grid = 0, in_rings = 0, in_histogram = 0;
  for (const Json::Value& photo : report["photos"]) in_photos += photo["marks"].size();
  for (const Json::Value& cell : report["lens_residuals"][0]["grid"]) {
    in_grid += cell["marks"].asInt();
  }
  for (const Json::Value& ring : report["lens_residuals"][0]["by_radius"]) {
    in_rings += ring["marks"].asInt();
  }
  for (const Json::Value& bin : report["histogram"]["counts"]) in_histogram += bin.asInt();
  EXPECT_EQ(in_photos, marks);
  EXPECT_EQ(in_grid, marks);
  EXPECT_EQ(in_rings, marks);
  EXPECT_EQ(in_histogram, report["observations"]["controlled"].asInt());
}

TEST_F(Report, GivesTheViewingAnglesOfThePhotos) {
  // Looking level along +y, then turned clockwise by 30 degrees, raised by 10, rolled by 5.
  const double degree = M_PI / 180;
  const auto about = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
  };
  const Eigen::Quaterniond level = about(M_PI / 2, Eigen::Vector3d::UnitX());
  adjustment_.poses[0].cam_from_world.rotation =
      about(-5 * degree, Eigen::Vector3d::UnitZ()) * about(-10 * degree, Eigen::Vector3d::UnitX()) *
      level * about(30 * degree, Eigen::Vector3d::UnitZ());
  const Json::Value angles = Make()["photos"][0]["angles_deg"];
  EXPECT_NEAR(angles["azimuth"].asDouble(), 30, 1e-9);
  EXPECT_NEAR(angles["elevation"].asDouble(), 10, 1e-9);
  EXPECT_NEAR(std::abs(angles["roll"].asDouble()), 5, 1e-9);
}

TEST_F(Report, GivesTheAxesOfAnErrorEllipsoid) {
  // Semi-axes 3, 2, 1 mm; the longest to azimuth 60 degrees, level.
  const Eigen::Vector3d longest(std::sin(M_PI / 3), std::cos(M_PI / 3), 0);
  Eigen::Matrix3d axes;
  axes << longest, longest.unitOrthogonal(), longest.cross(longest.unitOrthogonal());
  adjustment_.points[0].covariance =
      axes * Eigen::Vector3d(9e-6, 4e-6, 1e-6).asDiagonal() * axes.transpose();
  const Json::Value ellipsoid = Make()["points"][0]["ellipsoid"];
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(ellipsoid["semi_axes_m"][i].asDouble(), (3 - i) * 1e-3, 1e-9);
  }
  EXPECT_NEAR(std::fmod(ellipsoid["azimuth_deg"].asDouble() + 360, 180), 60, 1e-6);
  EXPECT_NEAR(ellipsoid["elevation_deg"].asDouble(), 0, 1e-6);
}

TEST_F(Report, ComparesControlBeforeAndAfter) {
  PointComparison point;
  point.name = "P";
  point.surveyed = {10, 20, 30};
  point.surveyed_sigma = {0.01, 0.01, 0.02};
  point.adjusted_sigma = {0.005, 0.005, 0.005};
  point.sigma = point.surveyed_sigma;
  point.difference = {0.003, -0.004, 0.012};
  PointComparison opposite = point;
  opposite.difference = {-0.003, -0.004, 0};
  adjustment_.control = {point, opposite};
  const Json::Value control = Make()["control"];
  EXPECT_NEAR(control["points"][0]["adjusted"][2].asDouble(), 30.012, 1e-12);
  EXPECT_NEAR(control["points"][0]["sigma_ratio"][2].asDouble(), 0.25, 1e-12);
  EXPECT_NEAR(control["points"][0]["plan_m"].asDouble(), 0.005, 1e-12);
  EXPECT_NEAR(control["points"][0]["space_m"].asDouble(), 0.013, 1e-12);
  EXPECT_NEAR(control["mean_m"][0].asDouble(), 0, 1e-12);
  EXPECT_NEAR(control["mean_m"][1].asDouble(), -0.004, 1e-12);
  EXPECT_NEAR(control["rms_m"][2].asDouble(), 0.012 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(control["rms_plan_m"].asDouble(), 0.005, 1e-12);
  EXPECT_NEAR(control["max_space_m"].asDouble(), 0.013, 1e-12);
}

TEST_F(Report, ListsTheLargestTestValuesFirstAndAdvisesOnTheFlagged) {
  adjustment_.residuals[7].w = -9.5;
  adjustment_.residuals[3].w = 6;
  const Json::Value observations = Make()["observations"];
  ASSERT_EQ(observations["largest_w"].size(), 50u);
  EXPECT_EQ(observations["largest_w"][0]["w"].asDouble(), -9.5);
  EXPECT_EQ(observations["largest_w"][1]["w"].asDouble(), 6);
  EXPECT_NE(observations["largest_w"][0]["advice"].asString(), "");
  EXPECT_FALSE(observations["largest_w"][49].isMember("advice"));
  EXPECT_EQ(observations["suspect"], observations["largest_w"][0]);
}

TEST_F(Report, SaysHowWellAPlannedCornerIsSeen) {
  ReportContext context;
  context.montage = {{"ridge", network_.points.at("a0")}, {"behind", {1000, 1000, 400}}};
  const Json::Value montage = ResidualReport(adjustment_, survey_, context)["montage"];
  ASSERT_GE(montage[0]["views"].size(), 2u);
  EXPECT_GT(montage[0]["views"][0]["sigma_major_px"].asDouble(), 0);
  EXPECT_LT(montage[0]["views"][0]["sigma_major_px"].asDouble(), 5);
  EXPECT_EQ(montage[1]["views"].size(), 0u);
}

TEST_F(Report, TellsTheCalibrationOfEachCamera) {
  adjustment_.cameras.push_back(adjustment_.cameras[0]);
  adjustment_.cameras[1].name = "tele";
  ReportContext context;
  context.cameras[1].model_file = "work/calibration/tele/camera.cameramodel";
  context.cameras[1].calibration["rms_px"] = 0.25;
  context.cameras[1].calibrated_region = {{1, 2}, {9, 2}, {5, 8}};
  const Json::Value cameras = ResidualReport(adjustment_, survey_, context)["cameras"];
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_TRUE(cameras[0]["calibration"].isNull());
  EXPECT_TRUE(cameras[0]["model_file"].isNull());
  EXPECT_EQ(cameras[1]["calibration"]["rms_px"].asDouble(), 0.25);
  EXPECT_EQ(cameras[1]["model_file"].asString(), "work/calibration/tele/camera.cameramodel");
  EXPECT_EQ(cameras[1]["calibrated_region"].size(), 3u);
}

// As many as the Arch of Constantine has: 26 000 tie points, 90 000 marks.
TEST_F(Report, SumsUpTiePointsInsteadOfListingThem) {
  const Json::Value before = Make();
  for (int i = 0; i < 26000; ++i) {
    AdjustedPoint tie = adjustment_.points[0];
    tie.name = "tie " + std::to_string(i);
    tie.is_tie_point = true;
    tie.rays = 3 + i % 2;
    adjustment_.points.push_back(tie);
    for (int k = 0; k < tie.rays; ++k) {
      for (const int axis : {0, 1}) {
        ObservationResidual row{ObservationKind::kImage,  axis, network_.photos[k], tie.name,
                                (i * 7 + k) % 1000 + 0.5, 0.1};
        row.sigma = 1;
        row.redundancy = 0.5;
        row.w = 0.1;
        row.is_tie_point = true;
        adjustment_.residuals.push_back(row);
      }
    }
  }
  const Json::Value report = Make();
  EXPECT_EQ(report["points"].size(), before["points"].size());
  EXPECT_EQ(report["photos"][0]["marks"].size(), before["photos"][0]["marks"].size());
  EXPECT_EQ(report["photos"][0]["tie_point_marks"].asInt(), 26000);
  EXPECT_EQ(report["tie_points"]["count"].asInt(), 26000);
  EXPECT_LE(report["tie_points"]["shown"].size(), 2000u);
  EXPECT_EQ(report["tie_points"]["rays"][0]["count"].asInt(), 13000);
  EXPECT_LT(ResidualPage(report).size(), 2u << 20);
}

// 500 photographs more, of 400 named marks each, of 30 000 points more; the later, the worse.
void Enlarge(Adjustment* adjustment, ReportContext* context) {
  const AdjustedPoint point = adjustment->points[0];
  for (int i = 0; i < 30000; ++i) {
    adjustment->points.push_back(point);
    adjustment->points.back().name = "q" + std::to_string(i);
    adjustment->points.back().covariance *= 1e3 * i;
  }
  const AdjustedPose pose = adjustment->poses[0];
  const auto camera = adjustment->scene.cameras[0];
  for (int i = 0; i < 500; ++i) {
    adjustment->poses.push_back(pose);
    adjustment->poses.back().photo = "photo " + std::to_string(i);
    adjustment->poses.back().rms_px = 2 + i;
    adjustment->scene.cameras.push_back(camera);
    context->thumbnails["photo " + std::to_string(i)] = std::string(20000, 'A');
    for (int k = 0; k < 400; ++k) {
      ObservationResidual row;
      row.photo = "photo " + std::to_string(i);
      row.subject = "q" + std::to_string(60 * i + k % 60);
      row.residual = 2 + i;
      row.redundancy = 0.5;
      for (row.axis = 0; row.axis < 2; ++row.axis, row.residual = 0) {
        row.w = k / 1000.0;
        adjustment->residuals.push_back(row);
      }
    }
  }
  adjustment->control.resize(2000, adjustment->control[0]);
}

// What fits worst is told one by one, worst first; of the rest the figures.
TEST_F(Report, OfALargeNetworkStaysSmall) {
  ReportContext context;
  Enlarge(&adjustment_, &context);
  const Json::Value report = ResidualReport(adjustment_, survey_, context);
  EXPECT_LT(Json::writeString(Json::StreamWriterBuilder(), report).size(), 12u << 20);
  const std::string page = ResidualPage(report);
  EXPECT_LT(page.size(), 5u << 20);
  const Json::Value shown = Embedded(page);
  const size_t photos = adjustment_.poses.size();
  ASSERT_EQ(shown["photos"].size(), photos);
  const Json::Value worst = shown["photos"][0],
                    best = report["photos"][Json::ArrayIndex(photos - 1)];
  EXPECT_EQ(worst["photo"].asString(), "photo 499");
  EXPECT_TRUE(worst.isMember("thumbnail"));
  ASSERT_EQ(worst["marks"].size(), 300u);
  EXPECT_EQ(worst["marks"][0]["w"].asDouble(), 0.399);
  EXPECT_FALSE(best.isMember("thumbnail"));
  EXPECT_EQ(best["marks"].size(), 5u);
  ASSERT_EQ(report["points"].size(), 1000u);
  EXPECT_EQ(report["points"][0]["name"].asString(), "q29999");
  EXPECT_EQ(report["control"]["points"].size(), 300u);
  const std::string note = "40 of " + std::to_string(photos) + " photos";
  EXPECT_NE(shown["page_note"].asString().find(note), std::string::npos);
  EXPECT_NE(Drawn(page).find("<h2>Conventions</h2>"), std::string::npos);
}

TEST_F(Report, KeepsNumbersThatAreNotNumbersOut) {
  adjustment_.sigma0 = std::numeric_limits<double>::quiet_NaN();
  adjustment_.points[0].covariance.setConstant(std::numeric_limits<double>::infinity());
  adjustment_.poses[0].covariance(0, 0) = -1;  // its root is none
  const Json::Value report = Make();
  EXPECT_TRUE(report["summary"]["sigma0"].isNull());
  const std::string text = Json::writeString(Json::StreamWriterBuilder(), report);
  for (const char* bad : {"nan", "NaN", "inf,", "Infinity", "1e+9999"}) {
    EXPECT_EQ(text.find(bad), std::string::npos) << bad;
  }
}

TEST(ResidualReport, OfNothingIsStillAReport) {
  const Json::Value report = ResidualReport(Adjustment{}, Survey{});
  EXPECT_EQ(report["photos"].size(), 0u);
  EXPECT_TRUE(report["control"]["points"].isArray());
  EXPECT_EQ(report["verdict"]["status"].asString(), "review");
  EXPECT_NE(ResidualPage(report).find("</html>"), std::string::npos);
}

TEST_F(Report, PageIsMadeFromTheFileAlone) {
  adjustment_.control[0].name = "Dachfirst <Süd> & \"Ost\" </script> 例";
  const Json::Value report = Make();
  const auto path = std::filesystem::path(testing::TempDir()) / "residual_report_test.json";
  WriteJson(path, report);
  const std::string page = ResidualPage(ReadJson(path));
  EXPECT_EQ(page, ResidualPage(report));
  EXPECT_EQ(Json::writeString(Json::StreamWriterBuilder(), Embedded(page)),
            Json::writeString(Json::StreamWriterBuilder(), report));
}

TEST_F(Report, PageDrawsToItsEndWhateverTheNames) {
  adjustment_.control[0].name = "<b>Süd & \"Ost\"</b>";
  const std::string dom = Drawn(ResidualPage(Make()));
  EXPECT_NE(dom.find("<h2>Conventions</h2>"), std::string::npos);
  EXPECT_NE(dom.find("<td class=\"text text\">&lt;b&gt;Süd &amp; \"Ost\"&lt;/b&gt;</td>"),
            std::string::npos);
  EXPECT_NE(dom.find("<svg"), std::string::npos);
}

TEST_F(Report, CsvHasALineForEveryObservationAndPoint) {
  adjustment_.residuals[0].subject = "corner, \"old\"";
  const std::string observations = ObservationsCsv(adjustment_);
  const auto lines = [](const std::string& csv) {
    return static_cast<size_t>(std::count(csv.begin(), csv.end(), '\n'));
  };
  EXPECT_EQ(lines(observations), adjustment_.residuals.size() + 1);
  EXPECT_NE(observations.find(",\"corner, \"\"old\"\"\",0,"), std::string::npos);
  EXPECT_EQ(lines(PointsCsv(adjustment_)), adjustment_.points.size() + 1);
}

}  // namespace
}  // namespace insitu
