// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/interreflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "calibration/photo/photograph.h"
#include "tests/radiometry/measure/synthetic_site.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
const Eigen::Vector3d kRadiance(0.3, 0.2, 0.1);

// The synthetic site's ground and wall, photographed in one colour.
class InterreflectionTest : public testing::Test {
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

  std::vector<Spectrum> Gather(const std::vector<SurfacePoint>& points, const Atmosphere& air = {},
                               std::optional<int> bounces = {}) const {
    const PolygonMesh polygons = MeshOfPolygons(scene_);
    const RayScene rays(polygons.mesh);
    std::vector<LocalImage> images;
    for (size_t i = 0; i < photos_.size(); ++i) {
      images.emplace_back(scene_.cameras[i], scene_.origin, photos_[i].linear);
    }
    const TriangleMesh none;
    const std::vector<Eigen::Vector3d> normals;
    const std::vector<int> materials;
    const std::vector<Spectrum> brdfs;
    const RayScene no_rays(none);
    const TransportScene transport = {
        {scene_, rays, polygons.polygon_of_triangle, images, air, spectra_},
        polygons.mesh,
        {none, no_rays, normals, materials, brdfs},
        {}};
    Daylight light;
    light.zenith_direction = scene_.zenith.unit;
    PatchGrid grid{{}, 0.3};
    for (const SurfacePoint& point : points) grid.foci.emplace_back(point.position, point.position);
    Interreflection interreflection(transport, light, grid, {.bounces = bounces});
    interreflection.Solve(light);
    std::vector<Spectrum> irradiances;
    for (const SurfacePoint& point : points) {
      const GatheredLight gathered = interreflection.At(point);
      EXPECT_TRUE((gathered.change == 0).all());  // nothing is planned
      irradiances.push_back(gathered.surroundings_before);
    }
    return irradiances;
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
};

TEST_F(InterreflectionTest, AWallReceivesHalfItsLightFromTheGround) {
  // Of the far ground no photograph shows a part, which is dark here: no light is given.
  EXPECT_LT(RelativeError(Gather({OnWall(0, 2)})[0], kPi / 2), 0.02);
}

TEST_F(InterreflectionTest, GroundReceivesWhatTheWallHidesOfTheSky) {
  for (const double to_wall : {4.0, 8.0}) {
    const double elevation = std::atan(6 / to_wall);
    const double hidden = kPi * (1 - std::cos(elevation)) / 2;
    EXPECT_LT(RelativeError(Gather({OnGround(0, 10 - to_wall)})[0], hidden), 0.06) << to_wall;
  }
}

TEST_F(InterreflectionTest, HazeIsTakenOff) {
  Atmosphere air;
  air.horizon = 2 * spectra_.SpectrumFromRgb(kRadiance);
  air.transmittance.setConstant(0.99);
  const Spectrum hazy = Gather({OnWall(0, 2)}, air)[0];
  EXPECT_LT((hazy / Gather({OnWall(0, 2)})[0]).maxCoeff(), 0.95);
}

TEST_F(InterreflectionTest, WithoutBouncesTheSkyAloneSends) {
  EXPECT_TRUE((Gather({OnWall(0, 2)}, {}, 0)[0] == 0).all());
}

}  // namespace
}  // namespace insitu
