// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/surface_textures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "radiometry/light/fresnel.h"
#include "renderer/building/data_map.h"
#include "renderer/building/shown_environment.h"
#include "renderer/trace/scene_hit.h"
#include "renderer/trace/through_glass.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

constexpr double kPixel = 1e-3;  // [rad]

// A wall 2 m wide and 2 m high that looks south, far from the origin of its grid; its model's
// coordinates span one repeat.
ArtificialEnvironment Wall() {
  const Eigen::Vector3d foot(2600000, 1200000, 400);
  ArtificialEnvironment wall;
  wall.vertices = {foot, foot + Eigen::Vector3d(2, 0, 0), foot + Eigen::Vector3d(2, 0, 2),
                   foot + Eigen::Vector3d(0, 0, 2)};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  wall.material_of_triangle = {0, 0};
  wall.corner_uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  wall.materials = {{"brick"}};
  wall.materials[0].texture = "brick.png";
  return wall;
}

// Red on the left, blue on the right; the lower half is black.
Raster Quarters() {
  Raster image(64, 64);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      image.SetRgb(x, y, x < 32 ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(0, 0, 1));
    }
  }
  return image;
}

class SurfaceTexturesTest : public testing::Test {
 protected:
  SurfaceTexturesTest() {
    WritePng(folder_.path() / "brick.png", Quarters(), Encoding::kSrgb8);
    wall_.materials[0].diffuse_rgb = {0.25, 0, 0.25};  // the image's mean
  }
  SurfaceTextures Textures() const {
    return {wall_, folder_.path(), folder_.path() / "textures", kPixel};
  }
  // Of the place (x, z) [m] of the wall's lower right triangle, from a distance before it.
  static Eigen::Vector3d At(const SurfaceTextures& textures, double x, double z, double distance) {
    const Eigen::Vector2d place((x - z) / 2, z / 2);
    return textures.Albedo({0, place, false}, distance, Eigen::Vector3d::UnitY()).value();
  }

  ScratchFolder folder_;
  ArtificialEnvironment wall_ = Wall();
};

TEST_F(SurfaceTexturesTest, StandUprightByTheModelsCoordinates) {
  const SurfaceTextures textures = Textures();
  EXPECT_LT((At(textures, 1.75, 1.25, 1) - Eigen::Vector3d(0, 0, 1)).norm(), 0.02);
  EXPECT_LT(At(textures, 1.5, 0.5, 1).norm(), 0.02);
  const auto left = textures.Albedo({1, {0.1, 0.8}, false}, 1, Eigen::Vector3d::UnitY());
  EXPECT_LT((*left - Eigen::Vector3d(1, 0, 0)).norm(), 0.02);
}

// sRGB code 188 is the mean light of black and white, not 128.
TEST_F(SurfaceTexturesTest, FarAwayIsTheMeanInLinearLight) {
  EXPECT_LT((At(Textures(), 1.75, 1.25, 1e5) - Eigen::Vector3d(0.25, 0, 0.25)).norm(), 0.01);
}

TEST_F(SurfaceTexturesTest, RepeatInMetresWhereASizeIsStated) {
  wall_.corner_uvs.clear();
  wall_.materials[0].texture_size = {0.5, 1.0};
  const SurfaceTextures textures = Textures();
  for (double x : {1.0, 1.5}) {  // 2 600 000 m holds whole repeats
    EXPECT_LT((At(textures, x + 0.12, 0.75, 1) - Eigen::Vector3d(1, 0, 0)).norm(), 0.02) << x;
    EXPECT_LT((At(textures, x + 0.38, 0.75, 1) - Eigen::Vector3d(0, 0, 1)).norm(), 0.02) << x;
  }
}

TEST_F(SurfaceTexturesTest, AreTimesTheModelsColour) {
  wall_.materials[0].diffuse_rgb = {0.125, 0, 0.125};
  EXPECT_LT((At(Textures(), 1.75, 1.25, 1) - Eigen::Vector3d(0, 0, 0.5)).norm(), 0.02);
}

TEST_F(SurfaceTexturesTest, FacesWithoutAPlaceHaveNone) {
  wall_.corner_uvs.clear();
  EXPECT_FALSE(Textures().Albedo({0, {0.2, 0.2}, false}, 1, Eigen::Vector3d::UnitY()));
  EXPECT_EQ(NotShown(wall_).size(), 1u);
  EXPECT_TRUE(NotShown(Wall()).empty());
}

TEST_F(SurfaceTexturesTest, AMissingImageIsNamed) {
  std::filesystem::remove(folder_.path() / "brick.png");
  EXPECT_THROW(Textures(), InputError);
}

// An image of one colour, of codes 0 to 1.
Raster OneColor(const Eigen::Vector3d& codes) {
  Raster image(8, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) image.SetRgb(x, y, codes);
  }
  return image;
}

class SurfaceMapsTest : public SurfaceTexturesTest {
 protected:
  // Codes are linear in files of 32 bits, which say so, and in those of 8, which say sRGB.
  void AddMap(SurfaceMap map, const Raster& codes) {
    map.file = "map" + std::to_string(wall_.materials[0].maps.size()) + ".exr";
    WriteExr(folder_.path() / map.file, codes);
    wall_.materials[0].maps.push_back(map);
  }
  MapValues Values(const Eigen::Vector2d& uv = {0.25, 0.5}, double distance = 1) const {
    return Textures().Maps({0, uv, false}, distance, Eigen::Vector3d::UnitY());
  }
  // Of the wall, which looks south.
  static Eigen::Vector3d NormalOf(const MapValues& values) {
    return (-Eigen::Vector3d::UnitY() - values.gradient).normalized();
  }
};

TEST_F(SurfaceMapsTest, NormalsAreTangentSpaceWithGreenUp) {
  wall_.corner_uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  AddMap({.kind = SurfaceMap::Kind::kNormal}, OneColor({0.8, 0.5, 0.9}));  // (0.6, 0, 0.8)
  EXPECT_LT((NormalOf(Values()) - Eigen::Vector3d(0.6, -0.8, 0)).norm(), 1e-3);
  wall_.materials[0].maps.clear();
  AddMap({.kind = SurfaceMap::Kind::kNormal}, OneColor({0.5, 0.8, 0.9}));
  EXPECT_LT((NormalOf(Values()) - Eigen::Vector3d(0, -0.8, 0.6)).norm(), 1e-3);
  // Where the image is mirrored, red is west.
  for (Eigen::Vector2f& uv : wall_.corner_uvs) uv.x() = -uv.x();
  wall_.materials[0].maps.clear();
  AddMap({.kind = SurfaceMap::Kind::kNormal, .factor = 0.5}, OneColor({0.8, 0.5, 0.9}));
  EXPECT_LT((NormalOf(Values()) - Eigen::Vector3d(-0.3, -0.8, 0).normalized()).norm(), 1e-3);
}

// h = (1 + sin 2 pi u) / 2 of 5 cm over 2 m: slopes up to pi 0.05 / 2.
TEST_F(SurfaceMapsTest, HeightsAreInMetresAndRoughFarAway) {
  Raster waves(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double h = (1 + std::sin(2 * std::numbers::pi * (x + 0.5) / 64)) / 2;
      waves.SetRgb(x, y, Eigen::Vector3d::Constant(h));
    }
  }
  AddMap({.kind = SurfaceMap::Kind::kHeight, .factor = 0.05}, waves);
  const double steepest = std::numbers::pi * 0.05 / 2;
  const MapValues near = Values({1, 0});  // u = 1
  EXPECT_NEAR(near.gradient.x(), steepest, 0.01 * steepest);
  EXPECT_LT(std::abs(near.gradient.z()), 1e-4);
  EXPECT_LT(near.variance, 1e-4 * steepest);
  const MapValues far = Values({0.9, 0}, 20000);
  EXPECT_LT(far.gradient.norm(), 0.02 * steepest);
  EXPECT_NEAR(far.variance, steepest * steepest / 2, 0.03 * steepest * steepest);
}

TEST_F(SurfaceMapsTest, RoughnessAndMetalAreGreenAndBlueAndLinear) {
  const Raster codes = OneColor({1, 0.5, 0.25});
  AddMap({.kind = SurfaceMap::Kind::kRoughness, .channel = 1, .factor = 0.8, .is_squared = true},
         codes);
  AddMap({.kind = SurfaceMap::Kind::kMetallic, .channel = 2}, codes);
  EXPECT_NEAR(*Values().roughness, 0.16, 1e-3);
  EXPECT_NEAR(*Values().metallic, 0.25, 1e-3);
  EXPECT_FALSE(Values().transmission);
  // Codes of 8 bits are no sRGB: 188 is not half.
  const std::string file = (folder_.path() / "half.png").string();
  WritePng(file, OneColor(Eigen::Vector3d::Constant(0.5)), Encoding::kSrgb8);
  EXPECT_NEAR(ReadDataMap(file, {}).data[0], 188 / 255.0, 1e-3);
}

// Of a plate whose left half is metal, rough, and let through.
class MappedPlateTest : public testing::Test {
 protected:
  MontageScene With(SurfaceMap map, SurfaceMaterial material) {
    Raster halves(16, 16);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 8; ++x) halves.SetRgb(x, y, Eigen::Vector3d::Ones());
    }
    WriteExr(folder_.path() / "halves.exr", halves);
    map.file = "halves.exr";
    material.maps = {map};
    ArtificialEnvironment plate = Plate(site_, {0, 0, 1}, 2, material);
    plate.corner_uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    MontageScene scene = site_.With(plate);
    scene.textures =
        std::make_shared<const SurfaceTextures>(plate, folder_.path(), folder_.path(), kPixel);
    return scene;
  }
  static BumpedSurface At(const MontageScene& scene, double x) {
    const Ray ray = {{x, 0, 3}, -Eigen::Vector3d::UnitZ()};
    const auto hit = FindHit(scene, ray, World::kWithBuilding);
    return BuildingSurfaceAt(scene, hit.value().surface, hit->place.value(), hit->distance,
                             Eigen::Vector3d::UnitZ(), 0.5);
  }

  ScratchFolder folder_;
  SmallSite site_ = MakeSmallSite();
  const SurfaceMaterial coated_{"m", {0.2, 0.4, 0.6}, 1, Specular{1, 1.5, {0.1}}};
};

TEST_F(MappedPlateTest, MetalIsBareAndOfItsColor) {
  const MontageScene scene = With({.kind = SurfaceMap::Kind::kMetallic, .mean = 0.5}, coated_);
  const SpectralMaterial metal = At(scene, -1).material, coat = At(scene, 1).material;
  EXPECT_FALSE(metal.specular->index);
  EXPECT_TRUE((metal.brdf == 0).all());
  const Spectrum color = scene.natural.spectra.ReflectanceFromRgb({0.2, 0.4, 0.6});
  EXPECT_LT((metal.mirror_color - color).abs().maxCoeff(), 1e-9);
  EXPECT_EQ(coat.specular->index, 1.5);
  EXPECT_TRUE((coat.brdf > 0).head(scene.natural.spectra.bins().count).all());
}

TEST_F(MappedPlateTest, RoughnessIsThatOfThePlace) {
  const MontageScene scene = With({.kind = SurfaceMap::Kind::kRoughness, .factor = 0.7}, coated_);
  EXPECT_NEAR(At(scene, -1).material.specular->roughness.slope, 0.7, 1e-6);
  EXPECT_NEAR(At(scene, 1).material.specular->roughness.slope, 0, 1e-6);
}

TEST_F(MappedPlateTest, LightComesThroughWhereTheMapSays) {
  SurfaceMaterial pane = coated_;
  pane.specular->roughness = {};
  pane.glass = Glass{.weight = 0.4, .index = 1.5};
  const MontageScene scene = With({.kind = SurfaceMap::Kind::kTransmission, .factor = 0.8}, pane);
  const double T = ThinSheet(1, 1.5, Spectrum::Zero(), 0).transmittance[0];
  const auto through = [&](double x) {
    return TransmittanceAlong(scene, {{x, 0, 0.1}, Eigen::Vector3d::UnitZ()})[0];
  };
  EXPECT_NEAR(through(-1), 0.8 * T, 1e-3);
  EXPECT_NEAR(through(1), 0, 1e-3);
  EXPECT_NEAR(At(scene, -1).material.glass->weight, 0.8, 1e-3);
}

}  // namespace
}  // namespace insitu
