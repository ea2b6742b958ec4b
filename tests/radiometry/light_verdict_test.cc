// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light_verdict.h"

#include <gtest/gtest.h>

#include "calibration/files/whole_file.h"
#include "radiometry/measure_daylight.h"
#include "tests/radiometry/measure/synthetic_site.h"

namespace insitu {
namespace {

class LightVerdictTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const SyntheticSite truth = MakeSyntheticSite("light_verdict");
    LightOptions options;
    options.uniform_ambient = true;  // as the site has it
    measured_ = new LightMeasurement(MeasureDaylight(truth.site, options));
    measured_->is_simplified = false;  // nor is it here
  }
  static void TearDownTestSuite() { delete measured_; }

  void SetUp() override { light_ = *measured_; }

  // The severity of the finding whose reason holds `part`; nullopt: there is none.
  std::optional<Severity> Found(const std::string& part) const {
    for (const Finding& finding : JudgeLight(light_)) {
      if (finding.reason.find(part) == std::string::npos) continue;
      EXPECT_NE(finding.remedy, "") << finding.reason;
      return finding.severity;
    }
    return std::nullopt;
  }

  static LightMeasurement* measured_;
  LightMeasurement light_;
};

LightMeasurement* LightVerdictTest::measured_ = nullptr;

TEST_F(LightVerdictTest, AGoodMeasurementHasNoObjections) {
  for (const Finding& finding : JudgeLight(light_)) {
    EXPECT_EQ(finding.severity, Severity::kNote) << finding.reason;
  }
}

TEST_F(LightVerdictTest, AnAssumedResponseIsToldWithWhatItCanCost) {
  EXPECT_FALSE(Found("assumed to be light"));  // the site's photographs are linear
  light_.assumed_response = {"A", "B"};
  EXPECT_EQ(Found("assumed to be light by the curve of their colour space"), Severity::kNote);
  EXPECT_TRUE(Found("A, B"));
  EXPECT_TRUE(Found("sun : sky off by a tenth"));
}

TEST_F(LightVerdictTest, ASunThatSamplesDoNotShowFails) {
  light_.daylight_fit.sun_radiance.setZero();
  EXPECT_EQ(Found("the samples do not show it"), Severity::kFail);
  for (DaylightSample& sample : light_.daylight) sample.geometry.sun = 0;
  EXPECT_EQ(Found("no daylight sample lies in it"), Severity::kFail);
  light_.environment.scene.sun.reset();
  EXPECT_EQ(Found("overcast"), Severity::kNote);
}

TEST_F(LightVerdictTest, ASunWithoutSomeColorsIsReviewed) {
  light_.daylight_fit.sun_radiance[3] = 0;
  EXPECT_EQ(Found("nothing in 1 of 16 bands"), Severity::kReview);
}

TEST_F(LightVerdictTest, ResidualsFarBeyondTheirSigmaAreNamed) {
  light_.daylight_fit.rms = 50;
  light_.daylight_fit.over_sigma[4] = 150;
  light_.daylight_fit.residuals[4] = -0.42;
  EXPECT_EQ(Found("residuals of 50.0 sigma"), Severity::kFail);
  const PixelSample& sample = light_.samples.daylight[4];
  EXPECT_TRUE(Found("A (" + std::to_string(std::lround(sample.pixel.x())) + ", "));
  EXPECT_TRUE(Found(" by -42 %"));
  light_.daylight_fit.rms = 5;
  EXPECT_EQ(Found("residuals of 5.0 sigma"), Severity::kReview);
}

TEST_F(LightVerdictTest, ASimplifiedModelIsNoFaultOfTheSamples) {
  light_.is_simplified = true;
  light_.daylight_fit.rms = 50;
  EXPECT_EQ(Found("the simplified light: residuals of 50.0 sigma"), Severity::kReview);
  EXPECT_FALSE(Found("contradict one another"));
}

TEST_F(LightVerdictTest, SamplesOnSeveralMaterialsFail) {
  light_.environment.scene.polygons[1].material = "gravel";
  EXPECT_EQ(Found("daylight samples lie on several materials (2): concrete on ground, gravel on"),
            Severity::kFail);
  light_.samples.haze[2].polygon = 2;
  EXPECT_EQ(Found("haze samples lie on several materials"), Severity::kFail);
}

TEST_F(LightVerdictTest, SamplesOnAMirrorFail) {
  light_.environment.materials["concrete"].specular = Specular{0.5, 1.33};
  EXPECT_EQ(Found("daylight samples lie on what mirrors"), Severity::kFail);
  light_.environment.materials["concrete"].specular->weight = 0;
  EXPECT_FALSE(Found("mirrors"));
}

TEST_F(LightVerdictTest, ExposuresThatExifAloneTellsFail) {
  for (PhotoExposure& photo : light_.exposure_fit.photos) photo.points = 0;
  light_.exposures = {{0.01, 8, 100}, {0.005, 8, 100}};
  EXPECT_EQ(Found("by EXIF A got 1.0 EV more light than B"), Severity::kFail);
  light_.exposure_fit.photos[1].gain.setConstant(0.5);  // brought to the unit
  light_.exposure_fit.photos[1].measured = 0.5;
  EXPECT_FALSE(Found("by EXIF A got"));
  light_.exposures[1].iso = 90;
  EXPECT_EQ(Found("by EXIF A got 0.2 EV more light than B"), Severity::kReview);
}

TEST_F(LightVerdictTest, MeasuredExposuresAreTold) {
  ASSERT_EQ(light_.exposure_fit.photos.size(), 2U);
  PhotoExposure& photo = light_.exposure_fit.photos[1];
  photo.gain.setConstant(2);
  photo.measured = 2;
  photo.sigma = 0.01;
  photo.points = 900;
  EXPECT_EQ(Found("brought to one unit (1): B by +1.00 EV +- 0.01"), Severity::kNote);
  photo.sigma = 0.1;
  EXPECT_EQ(Found("known badly (1): B"), Severity::kReview);
  photo.by_exif = 1;
  photo.sigma = 0.2;
  EXPECT_FALSE(Found("darker than EXIF says"));  // not surely
  photo.sigma = 0.01;
  EXPECT_EQ(Found("darker than EXIF says (1): B by +1.0 EV"), Severity::kReview);
  photo.white_balance = {1.2, 1, 0.9};
  photo.gain = 2 * photo.white_balance;
  EXPECT_EQ(Found("another white balance, brought to one (1): B (red 1.20, blue 0.90)"),
            Severity::kNote);
  light_.exposure_fit.corner_falloff = -0.2;
  light_.exposure_fit.corner_falloff_sigma = 0.01;
  EXPECT_EQ(Found("corners are -18 %"), Severity::kReview);
}

TEST_F(LightVerdictTest, WithoutExifResidualsTellAPhotographOfAnotherExposure) {
  EXPECT_FALSE(Found("exposure"));
  for (const size_t i : {0, 2, 4, 6}) {
    light_.samples.daylight[i].photo = 1;
    light_.daylight_fit.residuals[i] += 0.3;
  }
  EXPECT_EQ(Found("another exposure"), Severity::kReview);
}

TEST_F(LightVerdictTest, SurroundingsCannotSendMoreThanPhotographsShow) {
  EXPECT_FALSE(Found("the surroundings would send"));
  for (DaylightSample& sample : light_.daylight) {
    sample.geometry.sky = 2;
    sample.surroundings = 3 * (sample.geometry.ambient - 2) * light_.environment.spectra.Ones();
  }
  EXPECT_EQ(Found("the surroundings would send 3.0"), Severity::kFail);
  light_.brightest = 5;
  EXPECT_EQ(Found("% of the daylight"), Severity::kFail);
}

TEST_F(LightVerdictTest, ASkyTooDarkForACloudlessOneIsReviewed) {
  light_.environment.light.sky_radiance *= 0.1;
  light_.environment.light.ambient_radiance *= 0.1;
  EXPECT_EQ(Found("the sky is found too dark"), Severity::kReview);
}

TEST_F(LightVerdictTest, ClippedPolygonsAreNamed) {
  light_.clipped = {{1, 0, 0.9}, {0, 0, 0.2}, {0, 2, 0.01}};  // the ground's colour is A's
  EXPECT_EQ(Found("a lower bound (1): ground 20 % in A"), Severity::kNote);
  light_.clipped[1].share = 0.5;
  EXPECT_EQ(Found("a lower bound (1): ground 50 % in A"), Severity::kReview);
}

TEST_F(LightVerdictTest, WeakGeometryIsReviewed) {
  light_.daylight_fit.condition = 120;
  EXPECT_EQ(Found("(condition 120)"), Severity::kReview);
  light_.reflectance_known = false;
  EXPECT_EQ(Found("daylight_reflectance_rgb is not stated"), Severity::kReview);
  light_.air_fit.transmittance_sigma.setConstant(0.01);
  EXPECT_EQ(Found("transmittance over 200 m"), Severity::kReview);
  light_.haze.clear();
  EXPECT_EQ(Found("no haze samples"), Severity::kNote);
  light_.unseen.assign(light_.daylight.size(), 0.3);
  EXPECT_EQ(Found("no photograph shows the surroundings"), Severity::kReview);
}

}  // namespace
}  // namespace insitu
