// SPDX-License-Identifier: GPL-3.0-or-later
// Lamps, spectra and materials by their closed forms.
#include "renderer/building/building_lights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "calibration/files/error.h"
#include "radiometry/spectrum/color.h"
#include "renderer/building/building_materials.h"
#include "renderer/building/ies.h"
#include "renderer/building/spectral_table.h"
#include "renderer/trace/light_split.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/trace/small_site.h"

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

TEST_F(Lights, BadInput) {
  const std::string start = R"({"name": "a", "position": [0, 0, 0], )";
  EXPECT_THAT(Complaint(start + R"("type": "laser"})"), HasSubstr("expected point, spot"));
  EXPECT_THAT(Complaint(start + R"("spectrum": "F11", "luminous_flux_lm": 1})"),
              HasSubstr("expected D65, A or blackbody"));
  EXPECT_THAT(Complaint(start + R"("spectrum": "A"})"), HasSubstr("names no strength"));
  EXPECT_THAT(Complaint(start + R"("spectrum": "A", "luminous_flux_lm": -1})"),
              HasSubstr("is negative"));
  EXPECT_THAT(Complaint(start + R"("spectrum": "A", "ies": "none.ies"})"),
              HasSubstr("which is not there"));
}

// Below a lamp 2 m up, straight down 8 / 2^2, and nothing where its cone does not reach.
TEST(LampIrradiance, FollowsTheDistribution) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment building;
  PointLight spot{"spot", site.natural.scene.origin + Vector3d(0, 0, 2 + kSurveyClearance),
                  Vector3d::Constant(8)};
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, 1, 0, 0, 0, -1;
  spot.distribution = LightDistribution{axes, {0, 30, 31}, {0}, {0.5, 0.5, 0}};
  building.lights = {spot};
  const MontageScene scene = site.With(building);
  const SurfacePoint below{{0, 0, 0}, {0, 0, 1}}, aside{{3, 0, 0}, {0, 0, 1}};
  EXPECT_NEAR(scene.natural.spectra.RgbFromSpectrum(LampIrradiance(scene, below)).x(), 1, 1e-9);
  EXPECT_TRUE((LampIrradiance(scene, aside) == 0).all());
}

TEST(SpectralTable, KnownChromaticities) {
  const auto xy = [](const SpectralTable& table) {
    return Eigen::Vector2d(Chromaticity(Tristimulus(Sampled(table, {}), {})).head<2>());
  };
  EXPECT_NEAR((xy(IlluminantATable()) - Eigen::Vector2d(0.44758, 0.40745)).norm(), 0, 1e-3);
  EXPECT_NEAR((xy(D65Table()) - Eigen::Vector2d(0.31271, 0.32902)).norm(), 0, 2e-3);
  EXPECT_NEAR((xy(BlackbodyTable(6500)) - Eigen::Vector2d(0.3135, 0.3237)).norm(), 0, 1e-3);
  EXPECT_NEAR((ColorOfReflectance({{380, 0.4}, {780, 0.4}}) - Vector3d::Constant(0.4)).norm(), 0,
              2e-3);
  EXPECT_NEAR(Sampled({{380, 0}, {780, 400}}, {})[0], 12.5, 1e-9);  // the middle of 25 nm
}

// CIELAB of the sRGB primaries, from Lindbloom's calculator: D65 as is, D50 adapted by Bradford.
TEST(LinearFromLab, OfPublishedColors) {
  EXPECT_NEAR((LinearFromLab({100, 0, 0}, false) - Vector3d(1, 1, 1)).norm(), 0, 2e-3);
  EXPECT_NEAR((LinearFromLab({100, 0, 0}, true) - Vector3d(1, 1, 1)).norm(), 0, 2e-3);
  EXPECT_NEAR((LinearFromLab({53.2408, 80.0925, 67.2032}, false) - Vector3d(1, 0, 0)).norm(), 0,
              3e-3);
  EXPECT_NEAR((LinearFromLab({54.2917, 80.8125, 69.8851}, true) - Vector3d(1, 0, 0)).norm(), 0,
              3e-3);
}

class Materials : public testing::Test {
 protected:
  BuildingMaterials Read(const std::string& text) {
    return BuildingMaterials::Read(folder_.Write("materials.json", text));
  }
  std::string Complaint(const std::string& text) {
    try {
      Read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  ScratchFolder folder_;
};

SurfaceNames Names(const std::string& layer, const std::string& block = "",
                   const std::string& material = "") {
  return {layer, block, material, std::nullopt, 1, "", ""};
}

TEST_F(Materials, MaterialGoesBeforeBlockBeforeLayer) {
  BuildingMaterials materials = Read(R"({
    "library": {"oak": {"diffuse_rgb": [0.3, 0.2, 0.1]}},
    "materials": {"Glas": {"diffuse_rgb": [0, 0, 0]}},
    "blocks": {"DOOR": {"use": "oak"}},
    "layers": {"IfcWindow*": {"diffuse_srgb": [255, 255, 255]}, "Ifc*": {"hidden": true},
               "WALL": {"diffuse_lab": [100, 0, 0]}, "Holz": {"diffuse_rgb": [1, 1, 0]}}})");
  EXPECT_EQ(materials.Find(Names("WALL", "DOOR", "Glas"))->surface.name, "Glas");
  EXPECT_EQ(materials.Find(Names("WALL", "DOOR"))->surface.diffuse_rgb, Vector3d(0.3, 0.2, 0.1));
  EXPECT_EQ(materials.Find(Names("wall"))->surface.name, "WALL");
  EXPECT_EQ(materials.Find(Names("x", "", "Holz"))->surface.name, "Holz");  // as OBJ materials
  EXPECT_FALSE(materials.Find(Names("IfcWindow_EG-1"))->hidden);            // the longer pattern
  EXPECT_TRUE(materials.Find(Names("IfcSite_x"))->hidden);
  EXPECT_EQ(materials.Find(Names("roof")), nullptr);
  EXPECT_TRUE(materials.Unused().empty());
}

TEST_F(Materials, ColorsInEveryForm) {
  folder_.Write("brick.csv", "wavelength,value\n400,0.1\n700,0.5\n");
  BuildingMaterials materials = Read(R"({"layers": {
    "a": {"diffuse_srgb": [188, 188, 188]}, "b": {"reflectance": [[400, 0.2], [700, 0.2]]},
    "c": {"reflectance_file": "brick.csv"}}})");
  EXPECT_NEAR(materials.Find(Names("a"))->surface.diffuse_rgb.x(), 0.503, 1e-3);
  EXPECT_NEAR(materials.Find(Names("b"))->surface.diffuse_rgb.y(), 0.2, 1e-3);
  const Vector3d brick = materials.Find(Names("c"))->surface.diffuse_rgb;
  EXPECT_GT(brick.x(), brick.z());
}

TEST_F(Materials, BadInput) {
  const auto complaint = [&](const std::string& material) {
    return Complaint("{\"layers\": {\n\"W\": {" + material + "}}}");
  };
  EXPECT_THAT(complaint(""), HasSubstr("names no colour"));
  EXPECT_THAT(complaint(R"("diffuse_srgb": [0, 0, 256])"), HasSubstr("materials.json:2: "));
  EXPECT_THAT(complaint(R"("reflectance": [[500, 1.5], [600, 0]])"), HasSubstr("above 1"));
  EXPECT_THAT(complaint(R"("reflectance": [[500, 0.5], [500, 0]])"), HasSubstr("does not rise"));
  EXPECT_THAT(complaint(R"("diffuse_rgb": [0, 0, 0], "texture": "no.png")"),
              HasSubstr("no.png, which is not there"));
  EXPECT_THAT(complaint(R"("use": "gold")"), HasSubstr("\"gold\", which is not in \"library\""));
}

}  // namespace
}  // namespace insitu
