// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiometry/light/split_mix.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

const SurfacePoint kLawnOrigin = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};

LightDirections WholeSky(const MontageScene& scene) {
  return {scene.natural.light.sun_direction, 0, 1};
}

SurfaceMaterial Grey(double albedo) {
  return {"grey", Eigen::Vector3d::Constant(albedo), 1, std::nullopt};
}

SurfaceMaterial BareMirror() {
  return {"mirror", Eigen::Vector3d::Zero(), 1, Specular{1, std::nullopt}};
}

PrimaryRay Primary(const MontageScene& scene, const Eigen::Vector3d& origin,
                   const Eigen::Vector3d& target) {
  return {{origin, (target - origin).normalized()},
          Eigen::Vector3d::Constant(kLawnRadiance),
          WholeSky(scene)};
}

double Red(const MontageScene& scene, const Spectrum& stimulus) {
  return scene.natural.spectra.RgbFromSpectrum(stimulus).x();
}

TEST(CaseA, RayIntoTheSkyChangesNothing) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {0, 0, 2}, 1, Grey(0.5)));
  const RayOutcome outcome = TracePrimary(scene, Primary(scene, {0, -10, 3}, {0, 0, 20}));
  EXPECT_FALSE(outcome.hits_building);
  EXPECT_TRUE(outcome.rgb.isZero(0));
}

TEST(CaseB, SecondaryRayIntoTheSkyReturnsTheHorizonColor) {
  const MontageScene scene = MakeSmallSite().With({});
  const Spectrum L =
      TraceSecondary(scene, {{0, 0, 1}, {0, 0, 1}}, WholeSky(scene), World::kWithBuilding, 1);
  EXPECT_TRUE((L == scene.natural.air.horizon).all());
}

// Where photographs show that the sky is not alike everywhere, a mirror shows it as they do.
TEST(CaseB, APhotographedSkyIsBrighterWhereItIsBrighter) {
  SmallSite site = MakeSmallSite();
  site.natural.light.sky_shape.gradation.setOnes();  // overcast
  site.natural.light.photographed_sky = 0.7 * site.natural.air.horizon;
  const MontageScene scene = site.With({});
  const auto towards = [&](const Eigen::Vector3d& direction) {
    return Red(scene, TraceSecondary(scene, {{0, 0, 1}, direction.normalized()}, WholeSky(scene),
                                     World::kWithBuilding, 1));
  };
  const double zenith = 0.7 * 0.5 * 9 / 7;  // of the mean, 7 / 9 of the zenith
  EXPECT_NEAR(towards({0, 0, 1}), zenith, 0.002);
  EXPECT_NEAR(towards({0, 1, 1e-3}), zenith / 3, 0.002);
}

TEST(CaseB, BelowTheHorizonTheGroundGoesOnBeyondItsPolygon) {
  const MontageScene scene = MakeSmallSite().With({});
  const Ray ray = {{150, 0, 2}, Eigen::Vector3d(1, 0, -0.1).normalized()};  // lawn ends at 100 m
  const Spectrum L = TraceSecondary(scene, ray, WholeSky(scene), World::kWithBuilding, 1);
  EXPECT_NEAR(Red(scene, L), kLawnRadiance, 0.02);  // no photo shows it: its material's mean
}

TEST(CaseB, AsPrintedWhatLeavesHasTheHorizonsColorBelowTheHorizonToo) {
  MontageScene scene = MakeSmallSite().With({});
  scene.as_printed = true;
  const Ray ray = {{150, 0, 2}, Eigen::Vector3d(1, 0, -0.1).normalized()};
  const Spectrum L = TraceSecondary(scene, ray, WholeSky(scene), World::kWithBuilding, 1);
  EXPECT_TRUE((L == scene.natural.air.horizon).all());
}

// Hall and Greenberg: k_d rho E + k_s F L_mirror, sharp whatever the roughness; in a ray's world
// without sun a rough mirror is a smooth one's equal.
TEST(CaseC, AsPrintedMirrorsAddToTheDiffusePartAndAreSharp) {
  SmallSite site = MakeSmallSite();
  site.natural.light.sun_radiance.setZero();
  SurfaceMaterial glossy = Grey(0.5);
  glossy.specular = Specular{0.3, std::nullopt};
  SurfaceMaterial rough = glossy;
  rough.specular->roughness = {0.3, FacetDistribution::kBeckmann};
  const auto color_of = [&](const SurfaceMaterial& material) {
    MontageScene scene = site.With(Plate(site, {0, 0, 2}, 1, material));
    scene.as_printed = true;
    return TracePrimary(scene, Primary(scene, {0, -10, 6}, {0, 0, 2})).rgb.x();
  };
  const MontageScene scene = site.With({});
  const double horizon = Red(scene, scene.natural.air.horizon);
  EXPECT_NEAR(color_of(glossy), color_of(Grey(0.5)) + 0.3 * horizon, 1e-6);
  EXPECT_NEAR(color_of(rough), color_of(glossy), 1e-12);
}

// Where the half vector is the normal, cos^n is 1: (n + 2) / (8 pi) times the sun's 2 across its
// rays.
TEST(CaseC, AsPrintedARoughMirrorsHighlightHasItsClosedForm) {
  const SmallSite site = MakeSmallSite();
  const double m = 0.3, power = 2 / (m * m) - 2;
  SurfaceMaterial rough = Grey(0.5);
  rough.specular = Specular{0.3, std::nullopt, {m, FacetDistribution::kBeckmann}};
  const auto color_of = [&](const SurfaceMaterial& material) {
    MontageScene scene = site.With(Plate(site, {0, 0, 2}, 1, material));
    scene.as_printed = true;
    return TracePrimary(scene, Primary(scene, {-10, 0, 12}, {0, 0, 2})).rgb.x();
  };
  const MontageScene scene = site.With({});
  const double horizon = Red(scene, scene.natural.air.horizon);
  const double highlight = (power + 2) / (8 * std::numbers::pi) * 2;
  EXPECT_NEAR(color_of(rough) - color_of(Grey(0.5)), 0.3 * (horizon + highlight), 1e-5);
}

// Open plate: sun 2 cos 45, sky pi 0.3, ambient pi 0.05, albedo over pi.
TEST(CaseC, OpenHorizontalPlateHasItsClosedForm) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {0, 0, 2}, 1, Grey(0.4)));
  const RayOutcome outcome = TracePrimary(scene, Primary(scene, {0, -3, 8}, {0, 0, 2}));
  ASSERT_TRUE(outcome.hits_building);
  const double E = 2 * std::sqrt(0.5) + std::numbers::pi * 0.35;
  EXPECT_NEAR(outcome.rgb.x(), 0.4 / std::numbers::pi * E, 1e-4);
  EXPECT_NEAR(outcome.rgb.y(), outcome.rgb.x(), 1e-9);
}

TEST(CaseC, HazeLiesBeforeTheBuilding) {
  SmallSite site = MakeSmallSite();
  site.natural.air.transmittance = 0.9 * site.natural.spectra.Ones();
  const MontageScene scene = site.With(Plate(site, {0, 0, 2}, 1, Grey(0)));
  const RayOutcome outcome = TracePrimary(scene, Primary(scene, {0, -3, 6}, {0, 0, 2}));
  ASSERT_TRUE(outcome.hits_building);
  EXPECT_NEAR(outcome.rgb.x(), 0.5 * (1 - std::pow(0.9, 5)), 1e-4);
}

// Straight between them a ray would go to and fro for ever.
TEST(CaseC, TwoFacingMirrorsEndInTheHorizonColor) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment mirrors = Plate(site, {0, 0, 2}, 1, BareMirror());
  const ArtificialEnvironment upper = Plate(site, {0, 0, 4}, 1, BareMirror());
  for (const Eigen::Vector3i& triangle : upper.triangles) {
    mirrors.triangles.push_back(triangle + Eigen::Vector3i::Constant(4));
    mirrors.material_of_triangle.push_back(0);
  }
  mirrors.vertices.insert(mirrors.vertices.end(), upper.vertices.begin(), upper.vertices.end());
  const MontageScene scene = site.With(mirrors);
  const Spectrum L =
      TraceSecondary(scene, {{0.3, 0.1, 3}, {0, 0, 1}}, WholeSky(scene), World::kWithBuilding, 1);
  EXPECT_LT((L - scene.natural.air.horizon).abs().maxCoeff(), 1e-12);
}

TEST(CaseC, MirrorShowsThePhotographedLawn) {
  const SmallSite site = MakeSmallSite();
  // A standing mirror north of the lawn's origin throws the view back onto the lawn.
  const MontageScene scene = site.With(Box(site, {-1, 1, 0}, {1, 2, 2}, BareMirror()));
  const RayOutcome outcome = TracePrimary(scene, Primary(scene, {0, -10, 3}, {0, 1, 1}));
  ASSERT_TRUE(outcome.hits_building);
  EXPECT_NEAR(outcome.rgb.x(), kLawnRadiance, 1e-3);
}

TEST(CaseC, LampLightsTheBuilding) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment plate = Plate(site, {0, 0, 2}, 1, Grey(0.4));
  const MontageScene dark = site.With(plate);
  plate.lights = {{"lamp", site.natural.scene.origin + Eigen::Vector3d(0, 0, 4.02),
                   Eigen::Vector3d::Constant(4 * std::numbers::pi)}};
  const MontageScene lit = site.With(plate);
  const auto red = [](const MontageScene& scene) {
    return TracePrimary(scene, Primary(scene, {0, -3, 8}, {0, 0, 2})).rgb.x();
  };
  EXPECT_NEAR(red(lit) - red(dark), 0.4, 1e-4);  // 0.4 / pi * 4 pi / 2^2
}

TEST(CaseD1, BlackLampEqualsD2) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment lamp;
  lamp.lights = {
      {"black", site.natural.scene.origin + Eigen::Vector3d(0, 0, 2), Eigen::Vector3d::Zero()}};
  const MontageScene scene = site.With(lamp);
  const RayOutcome outcome = TracePrimary(scene, Primary(scene, {0, -10, 3}, {0, 0, 0}));
  EXPECT_TRUE(outcome.rgb.isZero(0));
}

TEST(CaseD1, LampAddsInProportionToItsIrradiance) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment lamp;
  lamp.lights = {{"lamp", site.natural.scene.origin + Eigen::Vector3d(0, 0, 2 + kSurveyClearance),
                  Eigen::Vector3d::Constant(4)}};
  const MontageScene scene = site.With(lamp);
  const RayOutcome outcome = TracePrimary(scene, Primary(scene, {0, -10, 3}, {0, 0, 0}));
  const double E_natural = 2 * std::sqrt(0.5) + std::numbers::pi * 0.35;
  EXPECT_NEAR(outcome.rgb.x(), kLawnRadiance * 1.0 / E_natural, 1e-4);  // E_lamp = 4 / 2^2
}

TEST(CaseD2, LitByTheSameLightAsBeforeIsExactlyUnchanged) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {0, 0, -3}, 1, Grey(0.5)));
  EXPECT_TRUE(TracePrimary(scene, Primary(scene, {0, -10, 3}, {0, 0, 0})).rgb.isZero(0));
}

// What comes from behind a window does not hang on the light on it.
TEST(CaseD3, DarkensOnlyWhatAWindowDoesNotLetThrough) {
  SmallSite site = MakeSmallSite();
  const auto change = [&](double transmission) {
    site.natural.materials["lawn"].transmission = transmission;
    const MontageScene scene = site.With(Plate(site, {20, 0, 20}, 2, Grey(0.5)));
    return TracePrimary(scene, Primary(scene, {0, -10, 3}, {0, 0, 0})).rgb.x();
  };
  EXPECT_LT(change(0), -0.1);
  EXPECT_NEAR(change(0.7), 0.3 * change(0), 1e-6);
  EXPECT_EQ(change(1), 0);
}

TEST(CaseD3, BlockedSunIsTheQuotientOfIrradiances) {
  SmallSite site = MakeSmallSite();
  site.natural.light.sky_radiance.setZero();
  // A small plate far along the sun's direction hides the sun and nothing else.
  const MontageScene scene = site.With(Plate(site, {20, 0, 20}, 2, Grey(0.5)));
  const RayOutcome outcome = TracePrimary(scene, Primary(scene, {0, -10, 3}, {0, 0, 0}));
  const double E_s = 2 * std::sqrt(0.5), E_u = std::numbers::pi * 0.05;
  EXPECT_NEAR(kLawnRadiance + outcome.rgb.x(), kLawnRadiance * E_u / (E_s + E_u), 1e-6);
}

// The building's shadow falls on the lawn, not on the haze before it: of a pixel L it takes its
// share of L - L_inf (1 - tau). [Durisch92, Eq. (8)]
TEST(CaseD3, HazeBeforeAShadowStays) {
  SmallSite site = MakeSmallSite();
  const auto change = [&] {
    const MontageScene scene = site.With(Plate(site, {20, 0, 20}, 2, Grey(0)));
    return TracePrimary(scene, Primary(scene, {0, -10, 3}, {0, 0, 0})).rgb.x();
  };
  const double clear = change();
  EXPECT_LT(clear, -0.1);
  site.natural.air.transmittance = 0.97 * site.natural.spectra.Ones();
  site.natural.air.horizon *= 0.6;  // 0.3
  const double haze = 0.3 * (1 - std::pow(0.97, std::sqrt(109.0)));
  EXPECT_NEAR(change() / clear, (kLawnRadiance - haze) / kLawnRadiance, 0.002);
}

TEST(CaseD3, NeverNegativeNeverBrighterAndSunlessUnderACover) {
  SmallSite site = MakeSmallSite();
  site.natural.light.ambient_radiance.setZero();
  const MontageScene scene = site.With(Plate(site, {0, 0, 0.5}, 50, Grey(0.5)));
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint p = {{0.4 * i - 60, 0.1 * i, 0}, Eigen::Vector3d::UnitZ()};
    const Spectrum L0 = scene.natural.spectra.SpectrumFromRgb(Eigen::Vector3d(0.1, 0.002 * i, 0.3));
    const Spectrum change = DiffuseChange(scene, p, L0, 1, WholeSky(scene));
    EXPECT_TRUE((change <= 0).all());
    EXPECT_TRUE((L0 + change >= 0).all());
  }
}

TEST(NaturalMirror, WaterShowsTheBuildingOnlyWhereItsReflectionFalls) {
  SmallSite site = MakeSmallSite();
  site.natural.materials["lawn"].specular = Specular{1, 1.33};
  site.natural.light.sky_radiance.setZero();
  site.natural.light.sun_radiance.setZero();  // no shadows: only the mirror changes anything
  const MontageScene scene = site.With(Box(site, {-1, 5, 0.5}, {1, 6, 4}, Grey(0)));
  const RayOutcome meets = TracePrimary(scene, Primary(scene, {0, -10, 3}, {0, 2, 0}));
  EXPECT_LT(meets.rgb.x(), -0.01);  // black instead of horizon
  const RayOutcome misses = TracePrimary(scene, Primary(scene, {0, -10, 3}, {-9, 2, 0}));
  EXPECT_TRUE(misses.rgb.isZero(0));
}

// A black wall's image in a bare mirror, whose reflectance does not grow with the angle: sharp and
// straight in flat water, broken up where waves are as large as its edge, and from far away as in a
// rough mirror of the waves' slope.
class Waves : public testing::Test {
 protected:
  static constexpr double kSlope = 0.1;

  static MontageScene Water(const Bumps& bumps) {
    SmallSite site = MakeSmallSite();
    site.natural.materials["lawn"].specular = Specular{0.2, std::nullopt};
    site.natural.materials["lawn"].bumps = bumps;
    site.natural.light.sky_radiance.setZero();
    site.natural.light.sun_radiance.setZero();
    return site.With(Box(site, {-30, 5, 0.5}, {30, 6, 4}, Grey(0)));
  }

  // Mean and rms of the changes along a line of water; its mirror image ends in the wall's top.
  static Eigen::Vector2d Changes(const MontageScene& scene) {
    double sum = 0, squares = 0;
    constexpr int kRays = 1500;
    for (int i = 0; i < kRays; ++i) {
      PrimaryRay ray = Primary(scene, {0, -10, 12}, {-12 + 24.0 * i / kRays, 1.25, 0});
      ray.light.seed = SplitMix64(i);
      const uint64_t pair = 2 * static_cast<uint64_t>(i);
      ray.light.facet = {SplitMix64(pair) * 0x1p-64, SplitMix64(pair + 1) * 0x1p-64};
      const double change = TracePrimary(scene, ray).rgb.x();
      sum += change / kRays;
      squares += change * change / kRays;
    }
    return {sum, std::sqrt(squares - sum * sum)};
  }
};

TEST_F(Waves, ThatAreSeenSinglyBreakTheImageUp) {
  const Bumps bumps{kSlope, 0.4, 0.1};
  MontageScene scene = Water(bumps);
  scene.ray_angle = 1e-5;
  const Eigen::Vector2d singly = Changes(scene);
  scene.ray_angle = 1;  // all of them lie in one ray
  const Eigen::Vector2d together = Changes(scene);
  EXPECT_NEAR(singly.x(), together.x(), 0.15 * std::abs(together.x()));
  EXPECT_GT(singly.y(), 1.3 * together.y());
  SmallSite rough = MakeSmallSite();
  rough.natural.materials["lawn"].specular =
      Specular{0.2, std::nullopt, {kSlope, FacetDistribution::kBeckmann}};
  rough.natural.light.sky_radiance.setZero();
  rough.natural.light.sun_radiance.setZero();
  const MontageScene mirror = rough.With(Box(rough, {-30, 5, 0.5}, {30, 6, 4}, Grey(0)));
  EXPECT_NEAR(together.x(), Changes(mirror).x(), 0.04 * std::abs(together.x()));
}

TEST_F(Waves, WithoutABuildingInThemChangeNothing) {
  MontageScene scene = Water({kSlope, 0.4, 0.1});
  const RayOutcome misses = TracePrimary(scene, Primary(scene, {0, -10, 3}, {-90, 2, 0}));
  EXPECT_TRUE(misses.rgb.isZero(0));
}

TEST(CaseC, BumpsTurnTheBuildingsFacesToTheSun) {
  const SmallSite site = MakeSmallSite();
  SurfaceMaterial plaster = Grey(0.5);
  plaster.bumps = Bumps{0.3, 0.2, 0.05};
  const auto seen = [&](const MontageScene& scene, double x) {
    return TracePrimary(scene, Primary(scene, {0, -10, 3}, {x, 0, 1})).rgb.x();
  };
  const MontageScene flat = site.With(Plate(site, {0, 0, 1}, 3, Grey(0.5)));
  const MontageScene bumped = site.With(Plate(site, {0, 0, 1}, 3, plaster));
  double mean = 0, least = 1e9, most = 0;
  constexpr int kPlaces = 400;
  for (int i = 0; i < kPlaces; ++i) {
    const double value = seen(bumped, -2 + 4.0 * i / kPlaces) / seen(flat, 0);
    mean += value / kPlaces;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  EXPECT_NEAR(mean, 1, 0.05);
  EXPECT_LT(least, 0.95);
  EXPECT_GT(most, 1.05);
}

TEST(TraceSecondary, WithoutInfluenceBothWorldsAreBitEqual) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {0, 0, -3}, 1, Grey(0.5)));
  const Ray ray = {{0, -5, 2}, Eigen::Vector3d(0.1, 0.6, -0.4).normalized()};
  const Spectrum a = TraceSecondary(scene, ray, WholeSky(scene), World::kSiteOnly, 1);
  const Spectrum b = TraceSecondary(scene, ray, WholeSky(scene), World::kWithBuilding, 1);
  EXPECT_TRUE((a == b).all());
  EXPECT_NEAR(Red(scene, a), kLawnRadiance, 1e-6);
}

}  // namespace
}  // namespace insitu
