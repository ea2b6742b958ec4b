// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/surface_textures.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "renderer/building/shown_environment.h"
#include "tests/calibration/files/scratch_folder.h"

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

}  // namespace
}  // namespace insitu
