// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/interreflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/wrong_field.h"
#include "tests/radiometry/measure/synthetic_site.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
const Eigen::Vector3d kRadiance(0.3, 0.2, 0.1);
const Eigen::Vector3d kSkyRadiance(0.5, 0.6, 0.7);

// The synthetic site's ground and wall, photographed in one colour; nothing is planned.
class SurroundingsTest : public testing::Test {
 protected:
  void SetUp() override {
    scene_ = MakeSyntheticSite(std::string("surroundings_") +
                               testing::UnitTest::GetInstance()->current_test_info()->name())
                 .scene;
    photos_.resize(2);
    for (Photograph& photo : photos_) {
      photo.linear = Raster(900, 600);
      for (int y = 0; y < 600; ++y) {
        for (int x = 0; x < 900; ++x) photo.linear.SetRgb(x, y, kRadiance);
      }
    }
  }

  // Calls use(solved interreflection) for a site whose pieces are small about `point`.
  template <typename Use>
  auto Solved(const SurfacePoint& point, const Use& use, const Atmosphere& air = {},
              const InterreflectionOptions& options = {}) const {
    const PolygonMesh polygons = MeshOfPolygons(scene_);
    const RayScene rays(polygons.mesh);
    std::vector<LocalImage> images;
    for (size_t i = 0; i < photos_.size(); ++i) {
      images.emplace_back(scene_.cameras[i], scene_.origin, photos_[i].linear);
    }
    const TriangleMesh nothing;
    const RayScene nothing_rays(nothing);
    const TransportScene scene = {
        {scene_, rays, polygons.polygon_of_triangle, images, air, spectra_},
        polygons.mesh,
        {nothing, nothing_rays, no_normals_, no_materials_, no_brdfs_},
        {}};
    Daylight light;
    light.sky_radiance = spectra_.SpectrumFromRgb(kSkyRadiance);
    const PatchGrid grid{{Eigen::AlignedBox3d(point.position)}, 0.5};
    Interreflection interreflection(scene, light, grid, options);
    interreflection.Solve(light);
    return use(interreflection);
  }

  GatheredLight Gather(const SurfacePoint& point, const Atmosphere& air = {},
                       const InterreflectionOptions& options = {}) const {
    return Solved(
        point, [&](const Interreflection& light) { return light.At(point); }, air, options);
  }

  SurfacePoint OnGround(double x, double y) const {
    return {Eigen::Vector3d(x, y, 0), Eigen::Vector3d::UnitZ()};
  }
  SurfacePoint OnWall(double x, double z) const {
    return {Eigen::Vector3d(x, 10, z), -Eigen::Vector3d::UnitY()};
  }

  double RelativeError(const Spectrum& irradiance, double solid_angle) const {
    const Eigen::Vector3d expected = solid_angle * kRadiance;
    return (spectra_.RgbFromSpectrum(irradiance) - expected).norm() / expected.norm();
  }

  SceneGeometry scene_;
  std::vector<Photograph> photos_;
  SpectralBasis spectra_;
  const std::vector<Eigen::Vector3d> no_normals_ = {};
  const std::vector<int> no_materials_ = {};
  const std::vector<Spectrum> no_brdfs_ = {};
};

// Projected solid angle that a long wall of 6 m hides of the sky at a distance from it.
double HiddenByWall(double distance) { return kPi * (1 - std::cos(std::atan(6 / distance))) / 2; }

TEST_F(SurroundingsTest, AWallReceivesHalfItsLightFromTheGround) {
  const GatheredLight light = Gather(OnWall(0, 2));
  EXPECT_LT(RelativeError(light.surroundings_before, kPi / 2), 0.01);
  EXPECT_NEAR(light.sky, kPi / 2, 0.01);
}

TEST_F(SurroundingsTest, GroundReceivesWhatTheWallHidesOfTheSky) {
  for (const double to_wall : {4.0, 8.0}) {
    const GatheredLight light = Gather(OnGround(0, 10 - to_wall), {}, {.point_directions = 1024});
    EXPECT_LT(RelativeError(light.surroundings_before, HiddenByWall(to_wall)), 0.03) << to_wall;
    EXPECT_NEAR(light.sky, kPi - HiddenByWall(to_wall), 0.01) << to_wall;
  }
}

TEST_F(SurroundingsTest, HazeIsTakenOff) {
  Atmosphere air;
  air.horizon = 2 * spectra_.SpectrumFromRgb(kRadiance);
  air.transmittance.setConstant(0.99);
  const Spectrum clear = Gather(OnWall(0, 2)).surroundings_before;
  EXPECT_LT((Gather(OnWall(0, 2), air).surroundings_before / clear).maxCoeff(), 0.95);
}

// Behind the wall nothing is photographed: it reflects as the same material does before it. There
// L = rho E, with half of the sky and as much ground, which is darker the nearer the wall.
TEST_F(SurroundingsTest, WhatNoPhotographShowsReflectsAsItsMaterialDoes) {
  const SurfacePoint behind = OnGround(0, 14);
  const GatheredLight light = Gather(behind);
  EXPECT_NEAR(light.unseen, HiddenByWall(4), 0.03);
  const double red = spectra_.RgbFromSpectrum(light.surroundings_before).x() / HiddenByWall(4);
  const double rho = Solved(behind, [&](const Interreflection& solved) {
    return spectra_.RgbFromSpectrum(solved.MeanBrdf(1)).x();
  });
  const double sky = kSkyRadiance.x();
  EXPECT_GT(rho, kRadiance.x() / (kPi * sky));  // seen surfaces receive less than an open sky
  EXPECT_GT(red, rho * kPi / 2 * sky);
  EXPECT_LT(red, rho * kPi / 2 * (sky + rho * kPi * sky));
  EXPECT_EQ(Gather(OnGround(0, -10)).unseen, 0);
}

TEST_F(SurroundingsTest, AMaterialThatNoPhotographShowsReflectsAsTheSiteDoes) {
  Polygon shed = scene_.polygons[1];  // the wall, moved behind itself
  for (Eigen::Vector3d& vertex : shed.vertices) vertex.y() += 10;
  shed.material = "tin";
  scene_.polygons.push_back(shed);
  const SurfacePoint behind = OnGround(0, 16);
  const auto [tin, concrete, gravel] = Solved(behind, [](const Interreflection& light) {
    return std::tuple(light.MeanBrdf(3), light.MeanBrdf(1), light.MeanBrdf(2));
  });
  EXPECT_TRUE((tin >= concrete.min(gravel)).all());
  EXPECT_TRUE((tin <= concrete.max(gravel)).all());
  EXPECT_TRUE((tin > 0).all());
}

TEST_F(SurroundingsTest, WithoutABuildingNothingChanges) {
  for (const SurfacePoint& point : {OnGround(0, 2), OnWall(3, 1)}) {
    EXPECT_TRUE((Gather(point).change == 0).all());
  }
}

TEST_F(SurroundingsTest, WithoutBouncesTheSkyAloneCounts) {
  const GatheredLight all = Gather(OnGround(0, 6));
  const GatheredLight bare = Gather(OnGround(0, 6), {}, {.bounces = 0});
  EXPECT_TRUE((bare.surroundings_before == 0).all());
  EXPECT_TRUE((bare.sky_before == all.sky_before).all());
  EXPECT_GT(bare.sky, 0);
}

TEST(InterreflectionOptions, NameTheFieldThatIsWrong) {
  EXPECT_EQ(WrongField(InterreflectionOptions()), "");
  EXPECT_NE(WrongField(InterreflectionOptions{.bounces = -1}).find("bounces"), std::string::npos);
  EXPECT_NE(WrongField(InterreflectionOptions{.patch_directions = 8}).find("patch_directions"),
            std::string::npos);
  EXPECT_NE(WrongField(InterreflectionOptions{.point_directions = 0}).find("point_directions"),
            std::string::npos);
}

}  // namespace
}  // namespace insitu
