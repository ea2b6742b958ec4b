// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/residual_report.h"

#include <gtest/gtest.h>
#include <json/reader.h>
#include <json/writer.h>

#include <sstream>

#include "reconstruction/verdict.h"
#include "tests/reconstruction/synthetic_network.h"

namespace insitu {
namespace {

Adjustment AdjustNetwork(const SyntheticNetwork& network, const Survey& survey) {
  AdjustmentOptions options;
  options.plane_sigma = options.zenith_sigma = options.sun_sigma = 1e-4;
  return Adjust(survey, network.photos, network.cameras, options);
}

bool HasReason(const Json::Value& report, const std::string& text) {
  for (const Json::Value& reason : report["verdict"]["reasons"]) {
    if (reason.asString().find(text) != std::string::npos) return true;
  }
  return false;
}

class Report : public testing::Test {
 protected:
  Json::Value Make() const { return ResidualReport(AdjustNetwork(network_, survey_), survey_); }
  SyntheticNetwork network_ = MakeSyntheticNetwork();
  Survey survey_ = WithNoise(network_.survey, 1);
};

TEST_F(Report, SumsItsGroupsToTheWhole) {
  const Json::Value report = Make();
  int count = 0;
  double redundancy = 0;
  for (const Json::Value& group : report["groups"]) {
    count += group["count"].asInt();
    redundancy += group["redundancy"].asDouble();
  }
  EXPECT_EQ(count, report["summary"]["observations"].asInt());
  EXPECT_NEAR(redundancy, report["summary"]["redundancy"].asDouble(), 1e-6);
  EXPECT_EQ(report["observations"].size(), report["summary"]["observations"].asUInt());
  EXPECT_EQ(report["photos"].size(), 4u);
  EXPECT_EQ(report["polygons"].size(), network_.survey.polygons.size());
  EXPECT_EQ(report["check"]["points"].size(), 2u);
}

TEST_F(Report, GivesTheViewingAnglesOfThePhotos) {
  // Looking level along +y, then turned clockwise by 30 degrees, raised by 10, rolled by 5.
  Adjustment adjustment = AdjustNetwork(network_, survey_);
  const double degree = M_PI / 180;
  const auto about = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
  };
  const Eigen::Quaterniond level = about(M_PI / 2, Eigen::Vector3d::UnitX());
  adjustment.poses[0].cam_from_world.rotation =
      about(-5 * degree, Eigen::Vector3d::UnitZ()) * about(-10 * degree, Eigen::Vector3d::UnitX()) *
      level * about(30 * degree, Eigen::Vector3d::UnitZ());
  const Json::Value angles = ResidualReport(adjustment, survey_)["photos"][0]["angles_deg"];
  EXPECT_NEAR(angles["azimuth"].asDouble(), 30, 1e-9);
  EXPECT_NEAR(angles["elevation"].asDouble(), 10, 1e-9);
  EXPECT_NEAR(std::abs(angles["roll"].asDouble()), 5, 1e-9);
}

TEST_F(Report, ReviewsAPointOfOneRay) {
  const Json::Value report = Make();
  EXPECT_EQ(report["verdict"]["status"].asString(), "review");
  EXPECT_TRUE(HasReason(report, "single"));
}

TEST_F(Report, PassesWhenThereIsNothingToObjectTo) {
  for (const std::string name : {"single"}) {
    std::erase_if(survey_.observations, [&](const auto& mark) { return mark.point == name; });
    ControlPoint surveyed = survey_.control_points.front();
    surveyed.name = name;
    surveyed.position = network_.points.at(name);
    survey_.control_points.push_back(surveyed);
  }
  Adjustment adjustment = AdjustNetwork(network_, survey_);
  const auto objections = Judge(adjustment, survey_);
  for (const Objection& objection : objections) ADD_FAILURE() << objection.reason;
  EXPECT_EQ(VerdictReport(objections)["status"].asString(), "pass");
}

TEST_F(Report, SaysLoudlyThatAccuracyIsNotVerified) {
  std::erase_if(survey_.control_points,
                [](const auto& point) { return point.role == ControlRole::kCheck; });
  EXPECT_TRUE(HasReason(Make(), "accuracy not verified"));
}

TEST_F(Report, FailsOnAGrossErrorAndNamesIt) {
  ImageObservation& wrong = survey_.observations[20];
  wrong.pixel.y() += 60;
  const Json::Value report = Make();
  EXPECT_EQ(report["verdict"]["status"].asString(), "fail");
  EXPECT_TRUE(HasReason(report, "global test"));
  EXPECT_TRUE(HasReason(report, "over 3.29"));
  EXPECT_TRUE(HasReason(report, wrong.point + " (" + wrong.photo));
}

TEST_F(Report, FailsWhenCheckPointsAreFarOff) {
  for (ControlPoint& point : survey_.control_points) {
    if (point.role == ControlRole::kCheck) point.position.x() += 0.5;
  }
  EXPECT_EQ(Make()["verdict"]["status"].asString(), "fail");
}

TEST(TestValue, IsTheResidualOverItsOwnSigma) {
  ObservationResidual row;
  row.residual = 0.6;
  row.sigma = 0.4;
  row.redundancy = 0.25;
  EXPECT_NEAR(*TestValue(row), 3, 1e-12);
  row.redundancy = 0;
  EXPECT_FALSE(TestValue(row));
}

TEST_F(Report, PageHoldsTheReportAndNothingFromOutside) {
  const Json::Value report = Make();
  const std::string page = ResidualPage(report);
  const std::string open = "<script type=\"application/json\" id=\"report\">";
  const size_t begin = page.find(open) + open.size();
  std::istringstream embedded(page.substr(begin, page.find("</script>", begin) - begin));
  Json::Value read;
  std::string errors;
  ASSERT_TRUE(Json::parseFromStream(Json::CharReaderBuilder(), embedded, &read, &errors)) << errors;
  const Json::StreamWriterBuilder writer;
  EXPECT_EQ(Json::writeString(writer, read), Json::writeString(writer, report));
  for (const std::string reference : {"src=", "href=", "@import", "url(", "fetch("}) {
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
  }
}

TEST(ResidualPage, DoesNotLetANameEndItsScript) {
  Json::Value report;
  report["name"] = "</script><script>alert(1)</script><!--";
  const std::string page = ResidualPage(report);
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  EXPECT_NE(page.find("\\u003c/script>"), std::string::npos);
}

}  // namespace
}  // namespace insitu
