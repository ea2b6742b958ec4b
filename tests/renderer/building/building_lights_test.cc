// SPDX-License-Identifier: GPL-3.0-or-later
// Lamps by their closed forms.
#include "renderer/building/building_lights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "calibration/files/error.h"
#include "renderer/building/ies.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

class Lights : public testing::Test {
 protected:
  std::vector<PointLight> Read(const std::string& light, const std::string& root = "") {
    return ReadLights(
        folder_.Write("building/lights.json", "{" + root + "\"lights\": [" + light + "]}"));
  }
  std::string Complaint(const std::string& light) {
    try {
      Read(light);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  ScratchFolder folder_;
};

const char kSite[] = "\"site_luminance_cd_m2\": 100, ";

double Luminance(const Vector3d& rgb) { return rgb.dot(Vector3d(0.2126, 0.7152, 0.0722)); }

TEST_F(Lights, PhotometricUnitsNeedTheSitesLuminance) {
  const std::string lamp =
      R"({"name": "a", "position": [1, 2, 3], "spectrum": "D65", "luminous_intensity_cd": 500})";
  EXPECT_EQ(Read(lamp)[0].candela, 500);
  EXPECT_EQ(Read(lamp)[0].intensity_rgb, Vector3d(0, 0, 0));
  const Vector3d rgb = Read(lamp, kSite)[0].intensity_rgb;
  EXPECT_NEAR(Luminance(rgb), 5, 1e-3);                       // 500 cd / 100 cd/m2
  EXPECT_NEAR((rgb - Vector3d::Constant(5)).norm(), 0, 0.1);  // D65 is white
}

TEST_F(Lights, FluxOverAllDirections) {
  const std::string start = R"({"name": "a", "position": [0, 0, 0], "spectrum": "A",
      "luminous_flux_lm": 1000)";
  EXPECT_NEAR(Read(start + "}")[0].candela, 1000 / (4 * kPi), 1e-9);
  // A cone of half angle 60 degrees holds 2 pi (1 - cos 60) = pi steradians.
  const PointLight spot =
      Read(start + R"(, "type": "spot", "direction": [0, 0, -1], "half_angle_deg": 60})")[0];
  EXPECT_NEAR(spot.candela, 1000 / kPi, 2);
  EXPECT_EQ(spot.distribution->At({0, 0, -1}), 1);
  EXPECT_EQ(spot.distribution->At(Vector3d(1, 0, -0.5).normalized()), 0);
}

// Far away an area light of luminance L is a lamp of intensity L A cos; close by it is one of the
// site's radiances: E = pi L beneath a large one.
TEST_F(Lights, AreaLight) {
  const std::vector<PointLight> lamps = Read(
      R"({"name": "a", "type": "area", "position": [-1, -1, 5], "edge_u": [0, 2, 0],
          "edge_v": [2, 0, 0], "spectrum": "D65", "luminance_cd_m2": 300, "samples": 8})");
  ASSERT_EQ(lamps.size(), 64u);
  double candela = 0, irradiance = 0;
  for (const PointLight& lamp : lamps) {
    candela += lamp.candela * lamp.distribution->At({0, 0, -1});
    const Vector3d path = -lamp.position;
    irradiance += lamp.candela * lamp.distribution->At(path.normalized()) * lamp.position.z() /
                  std::pow(path.norm(), 3);
  }
  EXPECT_NEAR(candela, 300 * 4, 1e-9);
  // Exact form factor of a square of half side a at height h: 4 times the corner's.
  const double x = 1 / 4.99, r = std::sqrt(1 + x * x);
  const double exact = 300 * 4 * (x / r) * std::atan(x / r);
  EXPECT_NEAR(irradiance, exact, 0.002 * exact);
}

const char kIes[] =
    "IESNA:LM-63-2002\r\n[TEST] x\r\nTILT=NONE\r\n1 1000 2.0 3 2 1 2 0 0 0\r\n1.0 1.0 10\r\n"
    "0 45 90\r\n0 90\r\n100 50\r\n0 100 25 0\r\n";

TEST_F(Lights, IesProfileGoesDownAndTurns) {
  folder_.Write("building/lamp.ies", kIes);
  const std::string lamp = R"({"name": "a", "type": "ies", "position": [0, 0, 0], "spectrum": "A",
      "ies": "lamp.ies")";
  const LightDistribution down = *Read(lamp + "}")[0].distribution;
  EXPECT_NEAR(down.At({0, 0, -1}), 200, 1e-9);                        // the multiplier is 2
  EXPECT_NEAR(down.At(Vector3d(1, 0, -1).normalized()), 100, 1e-9);   // C = 0
  EXPECT_NEAR(down.At(Vector3d(-1, 0, -1).normalized()), 100, 1e-9);  // mirrored
  EXPECT_NEAR(down.At(Vector3d(0, 1, -1).normalized()), 50, 1e-9);    // C = 90
  EXPECT_EQ(down.At({0, 0, 1}), 0);
  const LightDistribution turned = *Read(lamp + R"(, "turn_deg": 90})")[0].distribution;
  EXPECT_NEAR(turned.At(Vector3d(0, 1, -1).normalized()), 100, 1e-9);
}

TEST_F(Lights, FaultyIesFiles) {
  const auto complaint = [&](const std::string& what, const std::string& with) {
    std::string text = kIes;
    text.replace(text.find(what), what.size(), with);
    folder_.Write("building/lamp.ies", text);
    return Complaint(R"({"name": "a", "position": [0, 0, 0], "spectrum": "A", "ies": "lamp.ies"})");
  };
  EXPECT_EQ(complaint("100 50", "100 50"), "");
  EXPECT_THAT(complaint("0 100 25 0", "0 100 25"), HasSubstr("lamp.ies:9: the file ends here"));
  EXPECT_THAT(complaint("0 45 90", "0 95 90"), HasSubstr("lamp.ies:6: an angle does not rise"));
  EXPECT_THAT(complaint("3 2 1 2", "3 2 2 2"), HasSubstr("expected type C"));
  EXPECT_THAT(complaint("TILT=NONE", "TILTED"), HasSubstr("no line TILT="));
  EXPECT_THAT(complaint("25 0", "nan 0"), HasSubstr("expected a number"));
}

TEST_F(Lights, SpectraOfTheLibrary) {
  folder_.Write("library/sodium.json", R"({"kind": "lamp", "source": "us", "licence": "-",
    "spectrum_table": [[580, 0], [589, 1], [600, 0]]})");
  const auto file = folder_.Write("lamps.json", R"({"site_luminance_cd_m2": 1000, "lights": [
    {"name": "a", "position": [0, 0, 0], "spectrum": "sodium", "luminous_intensity_cd": 100}]})");
  const PointLight lamp = ReadLights(file, MaterialLibrary({folder_.path() / "library"})).at(0);
  EXPECT_EQ(lamp.spectrum.size(), 3u);
  EXPECT_GT(lamp.intensity_rgb.x(), lamp.intensity_rgb.y());
  EXPECT_EQ(lamp.intensity_rgb.z(), 0);
}

TEST_F(Lights, BadInput) {
  const std::string start = R"({"name": "a", "position": [0, 0, 0], )";
  EXPECT_THAT(Complaint(start + R"("type": "laser"})"), HasSubstr("expected point, spot"));
  EXPECT_THAT(Complaint(start + R"("spectrum": "F11", "luminous_flux_lm": 1})"),
              HasSubstr("expected D65, A, blackbody or a lamp of the library"));
  EXPECT_THAT(Complaint(start + R"("spectrum": "A"})"), HasSubstr("names no strength"));
  EXPECT_THAT(Complaint(start + R"("spectrum": "A", "luminous_flux_lm": -1})"),
              HasSubstr("is negative"));
  EXPECT_THAT(Complaint(start + R"("spectrum": "A", "ies": "none.ies"})"),
              HasSubstr("which is not there"));
}

}  // namespace
}  // namespace insitu
