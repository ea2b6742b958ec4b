// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/natural_environment.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "radiometry/light_report.h"
#include "radiometry/measure_daylight.h"
#include "tests/radiometry/measure/synthetic_site.h"

namespace insitu {
namespace {

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

// Eigen's == takes matrices of different sizes for equal where it does not check them.
void ExpectSameMatrix(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  EXPECT_EQ(a, b);
}

void ExpectSameScene(const SceneGeometry& a, const SceneGeometry& b) {
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.vertex_sigma, b.vertex_sigma);
  EXPECT_EQ(a.sun->unit, b.sun->unit);
  EXPECT_EQ(a.sun->covariance, b.sun->covariance);
  EXPECT_EQ(a.zenith.unit, b.zenith.unit);
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_EQ(a.cameras[i].photo, b.cameras[i].photo);
    EXPECT_EQ(a.cameras[i].camera.lens_model(), b.cameras[i].camera.lens_model());
    EXPECT_EQ(a.cameras[i].camera.intrinsics(), b.cameras[i].camera.intrinsics());
    EXPECT_EQ(a.cameras[i].camera.width(), b.cameras[i].camera.width());
    EXPECT_EQ(a.cameras[i].cam_from_world.rotation.coeffs(),
              b.cameras[i].cam_from_world.rotation.coeffs());
    EXPECT_EQ(a.cameras[i].cam_from_world.translation, b.cameras[i].cam_from_world.translation);
  }
  ASSERT_EQ(a.camera_covariances.size(), b.camera_covariances.size());
  for (size_t i = 0; i < a.camera_covariances.size(); ++i) {
    ExpectSameMatrix(a.camera_covariances[i], b.camera_covariances[i]);
  }
  ASSERT_EQ(a.polygons.size(), b.polygons.size());
  for (size_t i = 0; i < a.polygons.size(); ++i) {
    EXPECT_EQ(a.polygons[i].name, b.polygons[i].name);
    EXPECT_EQ(a.polygons[i].vertices, b.polygons[i].vertices);
    EXPECT_EQ(a.polygons[i].holes, b.polygons[i].holes);
    EXPECT_EQ(a.polygons[i].normal, b.polygons[i].normal);
    EXPECT_EQ(a.polygons[i].photo, b.polygons[i].photo);
    EXPECT_EQ(a.polygons[i].material, b.polygons[i].material);
    ExpectSameMatrix(a.polygons[i].covariance, b.polygons[i].covariance);
  }
}

void ExpectSameQualities(const std::vector<ImageQuality>& a, const std::vector<ImageQuality>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].point_spread.has_value(), b[i].point_spread.has_value());
    ASSERT_EQ(a[i].grain.has_value(), b[i].grain.has_value());
    if (const auto& spread = a[i].point_spread) {
      EXPECT_EQ(spread->center_sigma, b[i].point_spread->center_sigma);
      EXPECT_EQ(spread->corner_sigma, b[i].point_spread->corner_sigma);
      EXPECT_EQ(spread->sigma_error, b[i].point_spread->sigma_error);
      EXPECT_EQ(spread->edges, b[i].point_spread->edges);
    }
    if (const auto& grain = a[i].grain) {
      EXPECT_EQ(grain->floor, b[i].grain->floor);
      EXPECT_EQ(grain->slope, b[i].grain->slope);
      EXPECT_EQ(grain->length, b[i].grain->length);
      EXPECT_EQ(grain->shared, b[i].grain->shared);
      EXPECT_EQ(grain->patches, b[i].grain->patches);
    }
  }
}

void ExpectSameImages(const std::vector<InputImage>& a, const std::vector<InputImage>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].file, b[i].file);
    EXPECT_EQ(a[i].camera.lens_model(), b[i].camera.lens_model());
    EXPECT_EQ(a[i].camera.intrinsics(), b[i].camera.intrinsics());
    EXPECT_EQ(a[i].camera.height(), b[i].camera.height());
  }
}

// Digits that only 17 decimals bring back.
Eigen::MatrixXd SomeCovariance(int size) {
  const Eigen::MatrixXd root = Eigen::MatrixXd::Random(size, size) / 300;
  return root * root.transpose();
}

TEST_P(BinsTest, EnvironmentReturnsToTheLastBit) {
  const SyntheticSite truth = MakeSyntheticSite("round_trip_" + std::to_string(GetParam()));
  WriteWhole(
      truth.site.survey() / "materials.json",
      R"({"materials": {"gravel": {"specular": "fresnel", "specular_weight": 0.3, "ior": 1.4},
                               "steel": {"specular": "mirror"}}})");
  LightOptions options;
  options.bins = GetParam();
  LightMeasurement measured = MeasureDaylight(truth.site, options);
  SceneGeometry& scene = measured.environment.scene;
  scene.camera_covariances = {SomeCovariance(6), SomeCovariance(10)};  // pose alone; with its lens
  Polygon& pierced = scene.polygons[1];
  const auto corner = [&](int i) { return pierced.vertices[i]; };
  const Eigen::Vector3d middle = (corner(0) + corner(1) + corner(2)) / 3;
  pierced.holes.emplace_back();
  for (int i = 0; i < 3; ++i) pierced.holes[0].push_back(0.9 * middle + 0.1 * corner(i));
  pierced.covariance = SomeCovariance(21);
  measured.environment.qualities = {
      {PointSpread{0.5, 0.7, 0.03, 12}, std::nullopt},
      {std::nullopt, Grain{{1e-5, 2e-5, 3e-5}, {0, 1e-4, 0}, 0.6, 0.25, 300}}};
  const Spectrum used = measured.environment.spectra.Ones();
  measured.environment.light.sky_shape = {used / 3, used * 0.7};
  measured.environment.light.photographed_sky = used / 7;
  measured.environment.light.sun_is_one_direction = true;
  measured.environment.spectra = SpectralBasis(Rec709(), {GetParam()}, Ntsc1953());
  WriteEnvironment(truth.site, measured);
  const NaturalEnvironment& a = measured.environment;
  const NaturalEnvironment b = ReadEnvironment(truth.site);
  ExpectSameScene(a.scene, b.scene);
  EXPECT_EQ(b.input_images[1].file, truth.site.input_image("B"));
  ExpectSameImages(a.input_images, b.input_images);
  EXPECT_EQ(a.spectra.bins().count, b.spectra.bins().count);
  EXPECT_TRUE(a.spectra.basis() == b.spectra.basis());
  EXPECT_TRUE(b.light.sun_is_one_direction);
  EXPECT_TRUE((a.air.horizon == b.air.horizon).all());
  EXPECT_TRUE((a.air.transmittance == b.air.transmittance).all());
  EXPECT_EQ(a.light.sun_direction, b.light.sun_direction);
  EXPECT_EQ(a.light.sun_solid_angle, b.light.sun_solid_angle);
  EXPECT_EQ(a.light.zenith_direction, b.light.zenith_direction);
  EXPECT_EQ(a.light.polar_facets, b.light.polar_facets);
  EXPECT_TRUE((a.light.sun_radiance == b.light.sun_radiance).all());
  EXPECT_TRUE((a.light.sky_radiance == b.light.sky_radiance).all());
  EXPECT_TRUE((a.light.ambient_radiance == b.light.ambient_radiance).all());
  EXPECT_TRUE((a.light.sky_shape.gradation == b.light.sky_shape.gradation).all());
  EXPECT_TRUE((a.light.sky_shape.glow == b.light.sky_shape.glow).all());
  EXPECT_TRUE((*a.light.photographed_sky == *b.light.photographed_sky).all());
  ASSERT_EQ(b.materials.size(), 3u);
  EXPECT_EQ(b.materials.at("gravel").specular->index, 1.4);
  EXPECT_EQ(b.materials.at("gravel").specular->weight, 0.3);
  EXPECT_FALSE(b.materials.at("steel").specular->index);
  EXPECT_FALSE(b.materials.at("concrete").specular);
  ExpectSameQualities(a.qualities, b.qualities);
}

TEST(ReadEnvironment, RefusesImpossibleImageQuality) {
  const SyntheticSite truth = MakeSyntheticSite("bad_quality");
  LightMeasurement measured = MeasureDaylight(truth.site);
  measured.environment.qualities[0].point_spread = PointSpread{0.5, 0.7, 0.03, 12};
  measured.environment.qualities[0].grain = Grain{{1e-5, 2e-5, 3e-5}, {0, 0, 0}, 0.6, 0.25, 300};
  const auto error_after = [&](const std::string& from, const std::string& to) {
    WriteEnvironment(truth.site, measured);
    Replace(truth.site.environment(), from, to);
    return ErrorOf([&] { ReadEnvironment(truth.site); });
  };
  EXPECT_EQ(error_after("", ""), "");
  EXPECT_NE(error_after("\"center_sigma_px\" : 0.5", "\"center_sigma_px\" : -0.5")
                .find("expected pixels above 0 and up to 5"),
            std::string::npos);
  EXPECT_NE(error_after("\"shared\" : 0.25", "\"shared\" : 1.5").find("expected up to 5 px"),
            std::string::npos);
}

TEST(ReadEnvironment, FaultsNameFileAndLine) {
  const SyntheticSite truth = MakeSyntheticSite("bad_environment");
  LightMeasurement measured = MeasureDaylight(truth.site);
  SceneGeometry& scene = measured.environment.scene;
  scene.camera_covariances = {SomeCovariance(6), SomeCovariance(6)};
  scene.polygons[1].covariance = SomeCovariance(9);
  const auto error_after = [&](const std::string& from, const std::string& to) {
    WriteEnvironment(truth.site, measured);
    Replace(truth.site.environment(), from, to);
    return ErrorOf([&] { ReadEnvironment(truth.site); });
  };
  EXPECT_NE(error_after("", "").find("is not a covariance of 12 unknowns"), std::string::npos);
  scene.polygons[1].covariance = SomeCovariance(12);
  const std::string version = error_after("\"version\" : 3", "\"version\" : 1");
  EXPECT_NE(version.find("expected 3: run insitu-light again"), std::string::npos) << version;
  const std::string covariance = error_after("\"covariance\"", "\"covariances\"");
  EXPECT_NE(covariance.find("expected the same of all cameras"), std::string::npos) << covariance;
  const std::string image = error_after("\"input_image\"", "\"image\"");
  EXPECT_NE(image.find("input_image"), std::string::npos) << image;
  EXPECT_NE(error_after("natural environment", "scene").find("expected \"insitu natural"),
            std::string::npos);
  EXPECT_NE(error_after("\"bins\" : 16", "\"bins\" : 9").find("expected one for each of 9 bins"),
            std::string::npos);
  const std::string missing = error_after("\"gravel\" :", "\"grave\" :");
  EXPECT_NE(missing.find("lacks \"gravel\""), std::string::npos) << missing;
  EXPECT_NE(missing.find("environment.json:"), std::string::npos) << missing;
}

}  // namespace
}  // namespace insitu
