// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure_daylight.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "radiometry/light_report.h"
#include "reconstruction/geometry/ray_scene.h"
#include "tests/calibration/files/wrong_field.h"
#include "tests/radiometry/measure/synthetic_site.h"

namespace insitu {
namespace {

double RelativeError(const Eigen::Vector3d& value, const Eigen::Vector3d& truth) {
  return (value.array() / truth.array() - 1).abs().maxCoeff();
}

bool HasWarning(const LightMeasurement& measured, const std::string& part) {
  for (const Sentence& warning : measured.warnings) {
    if (warning.text().find(part) != std::string::npos) return true;
  }
  return false;
}

void Replace(const std::filesystem::path& path, const std::string& from, const std::string& to) {
  std::string text = ReadWhole(path);
  ASSERT_NE(text.find(from), std::string::npos);
  WriteWhole(path, text.replace(text.find(from), from.size(), to));
}

template <typename Function>
std::string ErrorOf(Function function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class BinsTest : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, BinsTest, testing::Values(9, 16));

TEST_P(BinsTest, MeasureDaylightFindsTheTruth) {
  const SyntheticSite truth = MakeSyntheticSite("measure_" + std::to_string(GetParam()));
  LightOptions options;
  options.bins = GetParam();
  options.polar_facets = kMostPolarFacets;
  options.uniform_ambient = true;  // as the site has it
  const LightMeasurement measured = MeasureDaylight(truth.site, options);
  const SpectralBasis& spectra = measured.environment.spectra;
  const Daylight& light = measured.environment.light;
  const Eigen::Vector3d tau = truth.transmittance.array().pow(200);
  EXPECT_LT((TransmittanceRgb(measured.environment, 200) - tau).cwiseAbs().maxCoeff(), 0.005);
  EXPECT_LT(RelativeError(SunIrradianceRgb(measured.environment), truth.sun_irradiance), 0.01);
  EXPECT_LT(RelativeError(spectra.RgbFromSpectrum(light.sky_radiance), truth.sky_radiance), 0.04);
  EXPECT_LT(
      RelativeError(OpenSkyRgb(measured.environment), truth.sky_radiance + truth.ambient_radiance),
      0.03);
  EXPECT_LT(measured.daylight_fit.rms, 0.5);
}

TEST(MeasureDaylight, TellsWhichPhotographsAreLightByAssumption) {
  const SyntheticSite truth = MakeSyntheticSite("assumed_response");
  const std::filesystem::path photos = truth.site.photos();
  const auto assumed = [&] {
    LightOptions options;
    options.uniform_ambient = true;
    return MeasureDaylight(truth.site, options).assumed_response;
  };
  EXPECT_EQ(assumed(), std::vector<std::string>());  // linear
  WritePng(photos / "B.png", ReadPhotograph(photos / "B.exr").linear, Encoding::kSrgb16);
  std::filesystem::remove(photos / "B.exr");
  EXPECT_EQ(assumed(), std::vector<std::string>{"B"});
  WriteWhole(photos / "response.json",
             R"({"curves": [{"all": [[0, 0], [0.25, 0.05], [0.5, 0.21], [1, 1]]}]})");
  EXPECT_EQ(assumed(), std::vector<std::string>());
}

// One photograph a stop brighter than the other: in one unit the light is what it was.
TEST(MeasureDaylight, PhotographsOfDifferentExposureAreBroughtToOneUnit) {
  const SyntheticSite truth = MakeSyntheticSite("exposures");
  LightOptions options;
  options.uniform_ambient = true;  // as the site has it
  const LightMeasurement alike = MeasureDaylight(truth.site, options);
  EXPECT_TRUE(alike.exposure_fit.photos[0].IsOne() && alike.exposure_fit.photos[1].IsOne());
  WriteEnvironment(truth.site, alike);
  EXPECT_EQ(ReadPhotoGains(truth.site)[1], Eigen::Vector3d(1, 1, 1));
  Raster brighter = ReadPhotograph(truth.site.photos() / "B.exr").linear;
  for (float& value : brighter.data) value *= 2;
  WriteExr(truth.site.photos() / "B.exr", brighter);
  const LightMeasurement measured = MeasureDaylight(truth.site, options);
  EXPECT_NEAR(measured.exposure_fit.photos[1].gain.y(), 2, 0.02);
  EXPECT_LT(RelativeError(SunIrradianceRgb(measured.environment), truth.sun_irradiance), 0.01);
  const Eigen::Vector3d tau = truth.transmittance.array().pow(200);
  EXPECT_LT((TransmittanceRgb(measured.environment, 200) - tau).cwiseAbs().maxCoeff(), 0.01);
  WriteEnvironment(truth.site, measured);
  EXPECT_EQ(ReadPhotoGains(truth.site)[0], Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(ReadPhotoGains(truth.site)[1], measured.exposure_fit.photos[1].gain);
}

TEST(MeasureDaylight, PolygonsThatLieOnEachOtherDoNotShadeEachOther) {
  const SyntheticSite truth = MakeSyntheticSite("coplanar");
  LightOptions options;
  options.uniform_ambient = true;
  const LightMeasurement measured = MeasureDaylight(truth.site, options);
  EXPECT_LT(std::abs(measured.daylight_fit.residuals[6]), 0.02);  // below the path, in full sun
}

// The ambient term stands for what is around; without bounces that is black.
TEST(MeasureDaylight, WithoutBouncesNothingButSunAndSkyIsFound) {
  const SyntheticSite truth = MakeSyntheticSite("bounces");
  const LightMeasurement all = MeasureDaylight(truth.site);
  EXPECT_TRUE((all.environment.light.ambient_radiance > 0).all());
  const LightMeasurement bare = MeasureDaylight(truth.site, {.bounces = 0});
  EXPECT_TRUE((bare.environment.light.ambient_radiance == 0).all());
  EXPECT_GT(bare.environment.light.sky_radiance.sum(), all.environment.light.sky_radiance.sum());
}

// A grey card of the site's library is as good as its colour.
TEST(MeasureDaylight, AMaterialAndASpectrumOfTheLibrary) {
  const SyntheticSite truth = MakeSyntheticSite("library");
  const LightMeasurement by_color = MeasureDaylight(truth.site);
  std::filesystem::create_directories(truth.site.root / "library");
  WriteWhole(truth.site.root / "library/card.json",
             R"({"kind": "material", "source": "us", "licence": "-",
                 "reflectance": [[380, 0.4], [780, 0.4]]})");
  WriteWhole(truth.site.root / "library/evening.json",
             R"({"kind": "lamp", "source": "us", "licence": "-",
                 "spectrum_table": [[380, 0], [780, 1]]})");
  const std::filesystem::path samples = truth.site.survey() / "samples.json";
  Replace(samples, "\"daylight_reflectance_rgb\"",
          R"("daylight_spectrum": "evening", "daylight_material": "card", "note")");
  const LightMeasurement measured = MeasureDaylight(truth.site, {.average_over_wavelength = true});
  EXPECT_TRUE(measured.reflectance_known);
  const Spectrum& sun = measured.environment.light.sun_radiance;
  EXPECT_NEAR(sun[15] / sun[0], 31, 1e-6);  // the middles of 25 nm
  const double luminance =
      SunIrradianceRgb(measured.environment).dot(Eigen::Vector3d(0.2126, 0.7152, 0.0722));
  EXPECT_NEAR(
      luminance /
          SunIrradianceRgb(by_color.environment).dot(Eigen::Vector3d(0.2126, 0.7152, 0.0722)),
      1, 2e-3);
  Replace(samples, "\"note\"", "\"daylight_reflectance_rgb\"");
  EXPECT_NE(ErrorOf([&] { MeasureDaylight(truth.site); }).find("expected one of them"),
            std::string::npos);
  Replace(samples, "\"daylight_reflectance_rgb\"", "\"note\"");
  Replace(samples, "\"card\"", "\"kard\"");
  EXPECT_NE(ErrorOf([&] { MeasureDaylight(truth.site); }).find("is card meant?"),
            std::string::npos);
}

TEST(MeasureDaylight, WarnsOfWhatIsMissing) {
  const SyntheticSite truth = MakeSyntheticSite("warnings");
  const std::filesystem::path samples = truth.site.survey() / "samples.json";
  Replace(samples, "\"haze\"", "\"no_haze\"");
  Replace(samples, "daylight_reflectance_rgb", "note");
  const LightMeasurement measured = MeasureDaylight(truth.site);
  EXPECT_TRUE(HasWarning(measured, "air is taken as clear"));
  EXPECT_TRUE((measured.environment.air.transmittance == 1).all());
  EXPECT_TRUE(HasWarning(measured, "daylight_reflectance_rgb"));
  EXPECT_FALSE(measured.reflectance_known);
  EXPECT_TRUE(HasWarning(measured, "concrete, gravel"));
  EXPECT_EQ(measured.environment.materials.size(), 2u);
}

TEST(MeasureDaylight, WithoutSunDirectionTheSkyIsOvercast) {
  SyntheticSite truth = MakeSyntheticSite("overcast");
  truth.scene.sun.reset();
  WriteSceneGeometry(truth.site, truth.scene);
  const LightMeasurement measured = MeasureDaylight(truth.site);
  EXPECT_TRUE((measured.environment.light.sun_radiance == 0).all());
  EXPECT_TRUE(HasWarning(measured, "overcast"));
}

TEST(MeasureDaylight, ASkyOfOneColourStaysUniform) {
  const SyntheticSite truth = MakeSyntheticSite("uniform_sky");
  const LightMeasurement measured = MeasureDaylight(truth.site);
  EXPECT_EQ(measured.sky.photos, 2);
  EXPECT_TRUE(measured.environment.light.sky_shape.IsUniform());
  EXPECT_FALSE(measured.environment.light.photographed_sky);
  const SpectralBasis& spectra = measured.environment.spectra;
  EXPECT_LT(RelativeError(spectra.RgbFromSpectrum(*measured.sky.fit.level), truth.horizon), 1e-5);
  EXPECT_TRUE(HasWarning(measured, "times as bright as that which lights"));  // as painted
}

// Sky pixels as those of an overcast sky, of the brightness that lights the site.
TEST(MeasureDaylight, FindsHowTheSkyIsSpread) {
  const SyntheticSite truth = MakeSyntheticSite("overcast_sky");
  const Eigen::Vector3d level = truth.sky_radiance + truth.ambient_radiance;
  const Eigen::Vector3d up = truth.scene.zenith.unit;
  const RelativeSky overcast({Spectrum::Ones(), Spectrum::Zero()}, up, up);
  const RayScene rays(MeshOfPolygons(truth.scene).mesh);
  for (const PosedCamera& posed : truth.scene.cameras) {
    const std::filesystem::path file = truth.site.photos() / (posed.photo + ".exr");
    Raster image = ReadPhotograph(file).linear;
    const Eigen::Vector3d center = Center(posed.cam_from_world) - truth.scene.origin;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const Eigen::Vector3d direction =
            posed.cam_from_world.rotation.conjugate() * posed.camera.Unproject({x, y});
        if (rays.IsOccluded({center, direction}) || up.dot(direction) <= 0) continue;
        image.SetRgb(x, y, level * overcast.Towards(direction)[0]);
      }
    }
    WriteExr(file, image);
  }
  const LightMeasurement measured = MeasureDaylight(truth.site);
  const Daylight& light = measured.environment.light;
  EXPECT_LT((light.sky_shape.gradation - 1).abs().maxCoeff(), 0.05);
  EXPECT_TRUE((light.sky_shape.glow == 0).all());
  ASSERT_TRUE(light.photographed_sky);
  const SpectralBasis& spectra = measured.environment.spectra;
  EXPECT_LT(RelativeError(spectra.RgbFromSpectrum(*light.photographed_sky), level), 0.02);
  // The paper's light has one sky.
  const LightMeasurement paper = MeasureDaylight(truth.site, {.uniform_ambient = true});
  EXPECT_TRUE(paper.environment.light.sky_shape.IsUniform());
}

TEST(MeasureDaylight, RefusesPhotographsThatDoNotFit) {
  const SyntheticSite truth = MakeSyntheticSite("photos");
  WriteExr(truth.site.photos() / "B.exr", Raster(90, 60));
  EXPECT_NE(
      ErrorOf([&] { MeasureDaylight(truth.site); }).find("B.exr: is 90x60 px, expected 900x600 px"),
      std::string::npos);
  std::filesystem::remove(truth.site.photos() / "B.exr");
  EXPECT_NE(ErrorOf([&] { MeasureDaylight(truth.site); }).find("no photograph \"B\""),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(truth.site.environment()));
}

TEST(LightOptions, NameTheFieldThatIsWrong) {
  EXPECT_EQ(WrongField(LightOptions()), "");
  EXPECT_NE(WrongField(LightOptions{.bins = 17}).find("bins"), std::string::npos);
  EXPECT_NE(WrongField(LightOptions{.polar_facets = 0}).find("polar_facets"), std::string::npos);
  const SyntheticSite truth = MakeSyntheticSite("options");
  EXPECT_THROW(MeasureDaylight(truth.site, {.bins = 2}), CheckError);
}

}  // namespace
}  // namespace insitu
