// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light_page.h"

#include <gtest/gtest.h>

#include "calibration/files/whole_file.h"
#include "calibration/program/report_paths.h"
#include "radiometry/measure_daylight.h"
#include "tests/radiometry/measure/synthetic_site.h"

namespace insitu {
namespace {

class LightPageTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    site_ = new SyntheticSite(MakeSyntheticSite("light_page"));
    LightOptions options;
    options.uniform_ambient = true;  // as the site has it
    report_ = new Json::Value(LightPageReport(site_->site, MeasureDaylight(site_->site, options)));
  }
  static void TearDownTestSuite() {
    delete site_;
    delete report_;
  }

  static SyntheticSite* site_;
  static Json::Value* report_;
};

SyntheticSite* LightPageTest::site_ = nullptr;
Json::Value* LightPageTest::report_ = nullptr;

TEST_F(LightPageTest, TellsEachSampleWithItsResidual) {
  const Json::Value& report = *report_;
  ASSERT_EQ(report["daylight_samples"].size(), 9U);
  ASSERT_EQ(report["haze_samples"].size(), 6U);
  EXPECT_EQ(report["daylight_samples"][0]["material"], "concrete");
  EXPECT_LT(std::abs(report["daylight_samples"][0]["residual"].asDouble()), 0.02);
  EXPECT_NEAR(report["daylight_samples"][0]["sun_cosine"].asDouble(), 0.52, 0.01);
  EXPECT_EQ(report["daylight_samples"][7]["sun_cosine"].asDouble(), 0);
  EXPECT_EQ(report["photos"].size(), 2U);
}

// -ln 0.02 over the extinction that the site has at 555 nm: 0.9990 a metre.
TEST_F(LightPageTest, TellsTheMeteorologicalRange) {
  const Json::Value& haze = (*report_)["haze"];
  EXPECT_NEAR(haze["range_m"].asDouble(), 3912, 300);
  EXPECT_LT(haze["range_from_m"].asDouble(), haze["range_m"].asDouble());
  EXPECT_GT(haze["range_to_m"].asDouble(), haze["range_m"].asDouble());
}

TEST_F(LightPageTest, TellsSunToSkyAndColorTemperatures) {
  const Json::Value& daylight = (*report_)["daylight"];
  const Eigen::Vector3d rec709(0.2126, 0.7152, 0.0722);
  const double sun = rec709.dot(site_->sun_irradiance),
               sky = rec709.dot(site_->sky_radiance + site_->ambient_radiance);
  const double sine = 0.52 / Eigen::Vector3d(0.3, 0.8, 0.52).norm();
  EXPECT_NEAR(daylight["sun_to_sky"].asDouble(), sun * sine / (3.14159 * sky), 0.05);
  EXPECT_NEAR(daylight["sun"]["kelvin"].asDouble(), 5800, 400);
  EXPECT_GT(daylight["sky"]["kelvin"].asDouble(), 7000);
  EXPECT_GT(daylight["sky"]["kelvin_sigma"].asDouble(), 0);
  EXPECT_EQ(daylight["clear_skies"].size(), 4U);
}

TEST_F(LightPageTest, IsWrittenWithItsVerdict) {
  Json::Value report = *report_;
  report["photos"][0]["photo"] = "</script><b>";
  WriteLightPage(site_->site, report);
  const std::string page = ReadWhole(LightPagePath(site_->site));
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_NE(page.find("showVerdict(verdict)"), std::string::npos);
  EXPECT_NE(VerdictLines(site_->site, report).find("Verdict: pass, see "), std::string::npos);
}

}  // namespace
}  // namespace insitu
