// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/forward_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

constexpr double kHuge = 1e6;  // [m]

Face FaceOf(const std::vector<Vector3d>& vertices, Material material = Material::kMetal) {
  Face face;
  face.vertices = vertices;
  face.material = material;
  return FinishFace(face);
}

Face Level(double height, double reach, Material material = Material::kMetal) {
  return FaceOf({{-reach, -reach, height},
                 {reach, -reach, height},
                 {reach, reach, height},
                 {-reach, reach, height}},
                material);
}

// A wall in the plane x = 1, as long and as high as `reach`.
Face Wall(double reach) {
  return FaceOf({{1, -reach, 0}, {1, reach, 0}, {1, reach, reach}, {1, -reach, reach}});
}

struct World {
  Site site;
  Place place;
  std::unique_ptr<BouncedLight> light;
};

// Upright axes, the sun 30 degrees off the zenith towards +x.
std::unique_ptr<World> MakeWorld(const std::vector<Face>& natural,
                                 const std::vector<Face>& building = {}) {
  auto world = std::make_unique<World>();
  world->site.zenith = Vector3d::UnitZ();
  world->site.sun = Vector3d(0.5, 0, std::sqrt(0.75));
  world->site.natural = world->site.blockers = MakeScene(natural);
  world->place = {&world->site, MakeScene(building), ClearMorning()};
  constexpr BouncedLightOptions kCoarse = {1e6, 1, 4};
  world->light = std::make_unique<BouncedLight>(world->place, kCoarse);
  return world;
}

double Sky(const World& world, const Vector3d& normal) {
  return world.light->Gather({0, 0, 0.001}, normal, 40, 1).sky.before;
}

TEST(VisibleSky, IsAllOnOpenGround) {
  EXPECT_EQ(Sky(*MakeWorld({Level(0, kHuge)}), Vector3d::UnitZ()), 1);
}

TEST(VisibleSky, IsHalfOnAnUprightWall) {
  EXPECT_NEAR(Sky(*MakeWorld({}), Vector3d::UnitX()), 0.5, 0.01);
}

TEST(VisibleSky, OfATiltedFaceIsHalfOfOnePlusCosine) {
  const double tilt = 0.7;
  const Vector3d normal(std::sin(tilt), 0, std::cos(tilt));
  EXPECT_NEAR(Sky(*MakeWorld({}), normal), 0.5 * (1 + std::cos(tilt)), 0.01);
}

TEST(VisibleSky, IsNothingUnderAnEndlessRoof) {
  EXPECT_EQ(Sky(*MakeWorld({Level(3, 1e9)}), Vector3d::UnitZ()), 0);
}

TEST(VisibleSky, IsHalfAtTheFootOfAnEndlessWall) {
  const auto world = MakeWorld({Wall(1e9)});
  const double at_foot =
      world->light->Gather({0.999999, 0, 0}, Vector3d::UnitZ(), 40, 1).sky.before;
  EXPECT_NEAR(at_foot, 0.5, 0.01);
}

// A wall of height h at distance 1 without end hides (1 - 1 / sqrt(1 + h^2)) / 2 of the sky.
TEST(VisibleSky, LosesTheClosedFormBehindALongWall) {
  const double height = 2;
  const auto world = MakeWorld(
      {}, {FaceOf({{1, -kHuge, 0}, {1, kHuge, 0}, {1, kHuge, height}, {1, -kHuge, height}})});
  const BeforeAfter share = world->light->Gather({0, 0, 0}, Vector3d::UnitZ(), 40, 1).sky;
  EXPECT_EQ(share.before, 1);
  EXPECT_NEAR(share.after, 1 - 0.5 * (1 - 1 / std::sqrt(1 + height * height)), 0.01);
}

TEST(VisibleSun, IsHiddenByABuildingAndByTurningAway) {
  const auto world = MakeWorld({Level(0, kHuge)}, {Wall(kHuge)});
  const BeforeAfter behind = VisibleSun(world->place, {0, 0, 0.001}, Vector3d::UnitZ(), 1);
  EXPECT_EQ(behind.before, 1);
  EXPECT_EQ(behind.after, 0);
  const BeforeAfter away = VisibleSun(world->place, {2, 0, 1}, -Vector3d::UnitX(), 1);
  EXPECT_EQ(away.before, 0);
}

// An edge through the middle of the disc hides half of it.
TEST(VisibleSun, HasAPenumbra) {
  const auto world = MakeWorld({}, {Wall(std::sqrt(3.0))});  // the top edge stands before the sun
  double mean = 0;
  for (int seed = 0; seed < 2000; ++seed) {
    mean += VisibleSun(world->place, {0, 0, 0}, Vector3d::UnitZ(), seed).after / 2000;
  }
  EXPECT_NEAR(mean, 0.5, 0.03);
}

View LookingDown(int size) {
  View view;
  view.lens = {size, size};
  view.lens.focal_x = view.lens.focal_y = 4 * size;
  view.lens.center_x = view.lens.center_y = 0.5 * (size - 1);
  view.center = {0, 0, 10};
  view.cam_from_site << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  return view;
}

TEST(RenderView, GivesOpenGroundItsClosedFormColor) {
  const auto world = MakeWorld({Level(0, kHuge)});
  const RenderedView view = RenderView(*world->light, LookingDown(8));
  const Daylight& light = world->place.daylight;
  const double cosine = world->site.sun.z();
  const Spectrum leaving =
      PlainReflectance(Material::kMetal) *
      (light.sun_irradiance * (cosine / std::numbers::pi) + light.sky_radiance);
  const Vector3d expected = RgbFromSpectrum(ThroughAir(light, leaving, 10));
  EXPECT_LT((view.before.Rgb(4, 4) - expected).norm(), 1e-3 * expected.norm());
  EXPECT_EQ(view.records[0].sun, 1);
  EXPECT_NEAR(view.records[0].sky_share, 1, 1e-6);
}

TEST(RenderView, WithoutABuildingChangesNothing) {
  const auto world = MakeWorld({Level(0, kHuge), Wall(5)});
  const RenderedView view = RenderView(*world->light, LookingDown(16));
  EXPECT_EQ(view.before.data, view.after.data);
  for (const float code : view.mask.data) EXPECT_EQ(code, 0);
}

TEST(RenderView, MarksBuildingAndShadow) {
  const auto world =
      MakeWorld({Level(0, kHuge)}, {FaceOf({{0.5, -9, 1}, {9, -9, 1}, {9, 9, 1}, {0.5, 9, 1}})});
  const RenderedView view = RenderView(*world->light, LookingDown(32));
  EXPECT_EQ(*view.mask.At(31, 16), 1);                   // on the slab
  EXPECT_FLOAT_EQ(*view.mask.At(20, 16), 170.0f / 255);  // before its edge, in its shadow
  EXPECT_LT(view.after.Rgb(20, 16).sum(), 0.6 * view.before.Rgb(20, 16).sum());
}

// A pane that mirrors the open sky: F L_sky + (1 - F) diffuse.
TEST(RenderView, MirrorsTheSkyInGlass) {
  const auto world = MakeWorld({}, {Level(0, kHuge, Material::kGlass)});
  const RenderedView view = RenderView(*world->light, LookingDown(8));
  const Daylight& light = world->place.daylight;
  const double share = Fresnel(1, MirrorIndex(Material::kGlass));
  const Spectrum diffuse =
      PlainReflectance(Material::kGlass) *
      (light.sun_irradiance * (world->site.sun.z() / std::numbers::pi) + light.sky_radiance);
  const Vector3d expected =
      RgbFromSpectrum(ThroughAir(light, share * light.sky_radiance + (1 - share) * diffuse, 10));
  EXPECT_LT((view.after.Rgb(4, 4) - expected).norm(), 1e-3 * expected.norm());
}

// A slab stands where a pane of the site mirrored the sky: the picture loses F of the sky's light.
TEST(RenderView, MirrorsTheBuildingInAPaneOfTheSite) {
  const auto world = MakeWorld({Level(0, kHuge, Material::kPane)},
                               {FaceOf({{-9, -9, 30}, {-9, 9, 30}, {9, 9, 30}, {9, -9, 30}})});
  world->place.daylight.extinction = Spectrum::Zero();
  const RenderedView view = RenderView(*world->light, LookingDown(8));
  const double share = Fresnel(1, MirrorIndex(Material::kPane));
  const Vector3d mirrored = RgbFromSpectrum(share * world->place.daylight.sky_radiance);
  const Vector3d lost = view.before.Rgb(4, 4) - view.after.Rgb(4, 4);
  EXPECT_GT(lost.sum(), 0.8 * mirrored.sum());
  EXPECT_LT(lost.sum(), 1.2 * mirrored.sum());
}

TEST(RenderView, ShowsWavesInWhatWaterMirrors) {
  const auto world = MakeWorld({Level(0, kHuge, Material::kWater), Wall(kHuge)});
  const RenderedView calm = RenderView(*world->light, LookingDown(16));
  world->site.waves = {0.3, 1.0, 0.25, 5};
  const RenderedView rough = RenderView(*world->light, LookingDown(16));
  int changed = 0;
  for (size_t i = 0; i < calm.before.data.size(); ++i) {
    changed += std::abs(calm.before.data[i] - rough.before.data[i]) > 1e-5;
  }
  EXPECT_GT(changed, 300);  // of 768 values
}

TEST(VisibleSun, IsNoneUnderAnOvercastSky) {
  const auto world = MakeWorld({Level(0, kHuge)});
  world->site.has_sun = false;
  EXPECT_EQ(VisibleSun(world->place, {0, 0, 0.001}, Vector3d::UnitZ(), 1).before, 0);
}

}  // namespace
}  // namespace insitu::demo
