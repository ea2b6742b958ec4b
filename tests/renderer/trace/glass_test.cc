// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/glass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiometry/light/fresnel.h"
#include "radiometry/light/split_mix.h"
#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/mirror.h"
#include "renderer/trace/sampling.h"
#include "renderer/trace/through_glass.h"
#include "renderer/trace/trace.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr double kAbsorption = 20;  // [1/m], of all colours
const SurfacePoint kLawnOrigin = {Vector3d::Zero(), Vector3d::UnitZ()};

SurfaceMaterial Pane(double index, double absorption) {
  SurfaceMaterial pane{"pane", Vector3d::Zero(), 0, Specular{1, index}};
  pane.glass =
      Glass{.index = index, .thickness = 0.01, .absorption_rgb = Vector3d::Constant(absorption)};
  return pane;
}

SurfaceMaterial Body(double index, double absorption) {
  SurfaceMaterial body = Pane(index, absorption);
  body.glass->is_solid = true;
  return body;
}

LightDirections Along(const Vector3d& sun) { return {sun, 0, 1}; }

Vector3d Seen(const MontageScene& scene, const Vector3d& from, const Vector3d& to) {
  const PrimaryRay primary = {{from, (to - from).normalized()},
                              Vector3d::Constant(kLawnRadiance),
                              Along(scene.natural.light.sun_direction)};
  return TracePrimary(scene, primary).rgb;
}

double Red(const MontageScene& scene, const Spectrum& stimulus) {
  return scene.natural.spectra.RgbFromSpectrum(stimulus).x();
}

// Everything around sends the lawn's photographed radiance; no sun.
SmallSite Furnace() {
  SmallSite site = MakeSmallSite();
  site.natural.air.horizon =
      site.natural.spectra.SpectrumFromRgb(Vector3d::Constant(kLawnRadiance));
  site.natural.light.sun_radiance.setZero();
  return site;
}

TEST(Pane, ThatDoesNothingShowsThePhotographItself) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {0, -5, 1.5}, 1, Pane(1 + 1e-9, 0)));
  EXPECT_LT((Seen(scene, {0, -10, 3}, {0, 0, 0}) - Vector3d::Constant(kLawnRadiance)).norm(), 1e-6);
}

TEST(Pane, DimsThePhotographAndMirrorsTheSky) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {0, -5, 1.5}, 1, Pane(1.52, kAbsorption)));
  const double cosine = 3 / std::sqrt(109.0);
  const SheetOptics pane = ThinSheet(cosine, 1.52, Spectrum::Constant(kAbsorption), 0.01);
  const double expected = pane.transmittance[0] * kLawnRadiance + pane.reflectance[0] * 0.5;
  EXPECT_NEAR(Seen(scene, {0, -10, 3}, {0, 0, 0}).x(), expected, 1e-3);
}

TEST(Pane, ShadowIsPaleAndNotBlack) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Plate(site, {3, 0, 3}, 1, Pane(1.52, kAbsorption)));
  const Spectrum through =
      ThinSheet(std::numbers::sqrt2 / 2, 1.52, Spectrum::Constant(kAbsorption), 0.01).transmittance;
  const SplitSun sun =
      SplitSunlight(scene, kLawnOrigin, Along(scene.natural.light.sun_direction), true);
  EXPECT_TRUE(sun.is_blocked);
  EXPECT_NEAR(sun.blocked[3] / sun.natural, 1 - through[3], 1e-3);
}

TEST(Pane, LetsTheSkyThroughToWhatIsBehind) {
  SmallSite site = MakeSmallSite();
  site.natural.light.sun_radiance.setZero();
  MontageScene scene = site.With(Plate(site, {0, 0, 0.5}, 60, Pane(1.52, 0)));
  AddInterreflection(&scene, std::nullopt);
  const GatheredLight light = scene.interreflected->interreflection.At(kLawnOrigin);
  const double before = Red(scene, light.sky_before + light.surroundings_before);
  double mean = 0;  // over the hemisphere
  for (int i = 0; i < 100; ++i) {
    mean +=
        ThinSheet(std::sqrt((i + 0.5) / 100), 1.52, Spectrum::Zero(), 0.01).transmittance[0] / 100;
  }
  EXPECT_NEAR(Red(scene, light.change) / before, mean - 1, 0.02);
}

// A surface that stands sees the sky through it at grazing angles, where less comes through.
TEST(Pane, LetsTheSkyThroughByTheAngleAtWhichItIsMet) {
  SmallSite site = MakeSmallSite();
  site.natural.light.sun_radiance.setZero();
  MontageScene scene = site.With(Plate(site, {0, 0, 0.5}, 90, Pane(1.52, 0)));
  AddInterreflection(&scene, std::nullopt);
  const GatheredParts light =
      scene.interreflected->interreflection.PartsAt({Vector3d(0, 0, 0.2), Vector3d::UnitX()});
  double through = 0, all = 0;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {  // rings of height z about the zenith weigh sqrt(1 - z^2)
    const double z = (i + 0.5) / kSteps, weight = std::sqrt(1 - z * z);
    through += weight * ThinSheet(z, 1.52, Spectrum::Zero(), 0.01).transmittance[0];
    all += weight;
  }
  const double share = Red(scene, light.sky) / Red(scene, light.sky + light.sky_blocked);
  EXPECT_NEAR(share, through / all, 0.015);
}

// The sun's patch on a floor inside is the sun times T at its angle, and the sky's light the sky's
// times its own.
TEST(Pane, LightsTheFloorBehindIt) {
  SmallSite site = MakeSmallSite();
  site.natural.light.ambient_radiance.setZero();
  SurfaceMaterial pane = Pane(1.52, 0);
  pane.glass->absorption_rgb = {60, 15, 30};  // tinted
  ArtificialEnvironment room = Plate(site, {0, 0, 2}, 60, pane);
  const ArtificialEnvironment floor =
      Plate(site, {0, 0, 1}, 1, {"floor", Vector3d::Constant(0.5), 1, std::nullopt});
  for (const Vector3d& vertex : floor.vertices) room.vertices.push_back(vertex);
  for (const Eigen::Vector3i& t : floor.triangles) {
    room.triangles.emplace_back(t + Eigen::Vector3i::Constant(4));
    room.material_of_triangle.push_back(1);
  }
  room.materials.push_back(floor.materials[0]);
  MontageScene scene = site.With(room);
  AddInterreflection(&scene, std::nullopt);
  const SpectralGlass& glass = *scene.artificial_materials[0].glass;
  const auto T = [&](double cosine) {
    return ThinSheet(cosine, 1.52, glass.absorption, 0.01).transmittance;
  };
  Spectrum of_sky = Spectrum::Zero();
  for (int i = 0; i < 100; ++i) of_sky += T(std::sqrt((i + 0.5) / 100)) / 100;
  const Daylight& light = scene.natural.light;
  const double slant = std::numbers::sqrt2 / 2;
  const Spectrum E = T(slant) * slant * light.sun_solid_angle * light.sun_radiance +
                     of_sky * std::numbers::pi * light.sky_radiance;
  const Vector3d expected = scene.natural.spectra.RgbFromSpectrum(0.5 / std::numbers::pi * E);
  const Vector3d seen = Seen(scene, {0, -3, 1.5}, {0, 0, 1});  // from below the pane
  EXPECT_LT((seen - expected).norm(), 0.01 * expected.norm());
  EXPECT_LT(seen.x(), 0.9 * seen.y());
}

TEST(TransmittanceAlong, OfABodyIsBothFacesAndTheBentWay) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Box(site, {-5, -5, 1}, {5, 5, 1.25}, Body(1.5, 4)));
  const Vector3d slanted = Vector3d(0.3, 0, 1).normalized();
  const double F = FresnelReflectance(slanted.z(), 1.5);
  const double way = 0.25 / RefractedCosine(slanted.z(), 1.5);
  const Spectrum share = TransmittanceAlong(scene, {{0, 0, 0.1}, slanted});
  EXPECT_NEAR(share[0], (1 - F) * (1 - F) * std::exp(-4 * way), 1e-3);
  EXPECT_EQ(TransmittanceAlong(scene, {{0, 0, 0.1}, -Vector3d::UnitZ()})[0], 1);
}

TEST(Body, AbsorbsAlongTheBentWay) {
  const SmallSite site = Furnace();
  const MontageScene scene = site.With(Box(site, {-5, -5, 1}, {5, 5, 1.25}, Body(1.5, 4)));
  const Vector3d eye(0, -4, 3), target(0, 0, 1.25);
  const double cosine = (eye - target).normalized().z();
  const double F = FresnelReflectance(cosine, 1.5);
  const double a = std::exp(-4 * 0.25 / RefractedCosine(cosine, 1.5));
  // As a thick pane: all reflections between its faces, those below a hundredth left out.
  const double T = (1 - F) * (1 - F) * a / (1 - F * F * a * a), R = F + F * a * T;
  EXPECT_NEAR(Seen(scene, eye, target).x() / kLawnRadiance, T + R, 0.01);
}

TEST(Body, WithoutAbsorptionDisappearsInAFurnace) {
  const SmallSite site = Furnace();
  const MontageScene scene = site.With(Box(site, {-1, -1, 0.5}, {1, 1, 2}, Body(1.5, 0)));
  for (const double x : {-0.7, 0.1, 0.9}) {
    EXPECT_NEAR(Seen(scene, {0.5, -10, 3}, {x, -1, 1}).x(), kLawnRadiance, 0.02 * kLawnRadiance);
  }
}

Roughness Rough(double slope, FacetDistribution distribution = FacetDistribution::kGgx) {
  return {slope, distribution};
}

// Of many rays that choose as those of a picture do.
Vector3d SeenByMany(const MontageScene& scene, const Vector3d& from, const Vector3d& to, int rays) {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < rays; ++i) {
    PrimaryRay primary = {{from, (to - from).normalized()},
                          Vector3d::Constant(kLawnRadiance),
                          Along(scene.natural.light.sun_direction)};
    primary.light.facet = SpreadAfter({0.5, 0.5}, i * kFacetsPerRay);
    primary.light.seed = SplitMix64(i);
    sum += TracePrimary(scene, primary).rgb / rays;
  }
  return sum;
}

// At all roughnesses, panes and bodies.
TEST(RoughGlass, DisappearsInAFurnace) {
  SmallSite site = Furnace();
  site.natural.light.sky_radiance = site.natural.air.horizon;
  site.natural.light.ambient_radiance.setZero();
  for (const auto distribution : {FacetDistribution::kGgx, FacetDistribution::kBeckmann}) {
    for (const double slope : {0.05, 0.3, 0.6, 1.0}) {
      SurfaceMaterial pane = Pane(1.5, 0), body = Body(1.5, 0);
      pane.specular->roughness = body.specular->roughness = Rough(slope, distribution);
      const MontageScene with_pane = site.With(Plate(site, {0, 0, 1}, 3, pane));
      EXPECT_NEAR(SeenByMany(with_pane, {0, -10, 6}, {0, 0, 1}, 64).x() / kLawnRadiance, 1, 0.01);
      const MontageScene with_body = site.With(Box(site, {-1, -1, 0.5}, {1, 1, 2}, body));
      EXPECT_NEAR(SeenByMany(with_body, {0.5, -10, 3}, {0.1, -1, 1}, 64).x() / kLawnRadiance, 1,
                  0.01);
    }
  }
}

// A pane that is hardly rough shows and casts what a smooth one does.
TEST(RoughGlass, IsSmoothGlassWhereItIsNearlySmooth) {
  const SmallSite site = MakeSmallSite();
  SurfaceMaterial rough = Pane(1.52, kAbsorption);
  rough.specular->roughness = Rough(0.004);
  const MontageScene a = site.With(Plate(site, {0, -5, 1.5}, 1, Pane(1.52, kAbsorption)));
  const MontageScene b = site.With(Plate(site, {0, -5, 1.5}, 1, rough));
  EXPECT_NEAR(SeenByMany(b, {0, -10, 3}, {0, 0, 0}, 256).x(), Seen(a, {0, -10, 3}, {0, 0, 0}).x(),
              0.01);
  const Ray up = {{0, -5, 0.1}, Vector3d(0.5, 0.1, 1).normalized()};
  EXPECT_NEAR(TransmittanceAlong(b, up)[0], TransmittanceAlong(a, up)[0], 0.01);
}

// The sun behind a frosted pane: by the lobe, as rays that find it by chance would have it.
TEST(RoughGlass, ShowsTheSunBehindItSpread) {
  SmallSite site = MakeSmallSite();
  site.natural.light.sun_direction = Vector3d(0, 1, 1).normalized();
  site.natural.light.sky_radiance.setZero();
  site.natural.light.ambient_radiance.setZero();
  site.natural.air.horizon.setZero();
  SurfaceMaterial pane = Pane(1.5, 0);
  pane.specular->roughness = Rough(0.3, FacetDistribution::kBeckmann);
  const MontageScene scene = site.With(Plate(site, {0, 0, 5}, 3, pane));
  const Vector3d eye(0, -1, 3);
  const Vector3d to_viewer = (eye - Vector3d(0, 0, 5)).normalized();
  // The share of ways through the pane that end within a cone about the sun, by its solid angle.
  const RoughSheet& sheet = *scene.artificial_materials[0].glass->rough;
  const auto down = [](const Vector3d& v) { return Vector3d(v.x(), v.y(), -v.z()); };
  constexpr double kCone = 0.12;
  double within = 0;
  PathNumbers numbers{3};
  constexpr int kWays = 400000;
  for (int i = 0; i < kWays; ++i) {
    const double u = numbers.Next(), v = numbers.Next();
    const GlassFacet facet = sheet.from_outside().Choose(down(to_viewer), {u, v});
    if (facet.lets_through <= 0) continue;
    const auto origin = sheet.Follow(facet.refracted, &numbers);
    if (down(origin.direction).dot(scene.natural.light.sun_direction) < std::cos(kCone)) continue;
    within += facet.lets_through * origin.share[0] / kWays;
  }
  const double per_solid_angle = within / (2 * std::numbers::pi * (1 - std::cos(kCone)));
  // E_s = 2 facing the sun.
  EXPECT_NEAR(SeenByMany(scene, eye, {0, 0, 5}, 512).x() / (2 * per_solid_angle), 1, 0.06);
}

// At all roughnesses, bare and as a coat over white.
TEST(RoughMirror, DisappearsInAFurnace) {
  SmallSite site = Furnace();
  site.natural.light.sky_radiance = site.natural.air.horizon;
  site.natural.light.ambient_radiance.setZero();
  const auto seen = [&](double diffuse, const std::optional<double>& index,
                        const Roughness& roughness) {
    SurfaceMaterial material{"m", Vector3d::Constant(diffuse), 1, Specular{1, index, roughness}};
    const MontageScene scene = site.With(Plate(site, {0, 0, 1}, 3, material));
    Vector3d sum = Vector3d::Zero();
    constexpr int kRays = 576;
    for (int i = 0; i < kRays; ++i) {
      PrimaryRay primary = {{{0, -10, 6}, Vector3d(0, 10, -5).normalized()},
                            Vector3d::Constant(kLawnRadiance),
                            Along(Vector3d::UnitZ())};
      primary.light.facet = SpreadAfter({0.5, 0.5}, i * kFacetsPerRay);
      sum += TracePrimary(scene, primary).rgb / kRays;
    }
    return sum.x() / kLawnRadiance;
  };
  for (const auto distribution : {FacetDistribution::kGgx, FacetDistribution::kBeckmann}) {
    for (const double slope : {0.05, 0.3, 0.6, 1.0}) {
      EXPECT_NEAR(seen(0, std::nullopt, {slope, distribution}), 1, 0.01) << slope;
      EXPECT_NEAR(seen(1, 1.5, {slope, distribution}), 1, 0.01) << slope;
    }
  }
}

// Half of what it mirrors is bright sky, half dark ground.
TEST(RoughMirror, LooksAlikeInAllPixelsOfSixteenRays) {
  SmallSite site = MakeSmallSite();
  site.natural.air.horizon = site.natural.spectra.SpectrumFromRgb(Vector3d::Constant(1));
  site.natural.light.sun_radiance.setZero();
  const SurfaceMaterial metal{"m", Vector3d::Zero(), 1, Specular{1, std::nullopt, {0.3}}};
  const MontageScene scene = site.With(Box(site, {-2, 0, 0.5}, {2, 1, 4}, metal));
  double sum = 0, squares = 0;
  constexpr int kPixels = 200, kRays = 16;
  for (int x = 0; x < kPixels; ++x) {
    const PixelSampler sampler(x, 0);
    double mean = 0;
    for (int ray = 0; ray < kRays; ++ray) {
      PrimaryRay primary = {{{0, -10, 2}, Vector3d::UnitY()},
                            Vector3d::Constant(kLawnRadiance),
                            Along(Vector3d::UnitZ())};
      primary.light.facet = sampler.OnFacet(ray);
      primary.light.seed = sampler.Seed(ray);
      mean += TracePrimary(scene, primary).rgb.x() / kRays;
    }
    sum += mean / kPixels;
    squares += mean * mean / kPixels;
  }
  EXPECT_NEAR(sum, (1 + kLawnRadiance) / 2, 0.1);
  EXPECT_LT(std::sqrt(squares - sum * sum), 0.02);
}

TEST(MirrorReflectance, IsFresnelsOrTheMetalsColor) {
  SpectralMaterial material{.specular = Specular{0.5, 1.5}};
  EXPECT_NEAR(MirrorReflectance(material, 1)[0], 0.02, 1e-15);
  material = {.specular = Specular{0.5}, .mirror_color = Spectrum::Constant(0.6)};
  EXPECT_NEAR(MirrorReflectance(material, 0.2)[0], 0.3, 1e-15);
  material.metal = SpectralMetal{Spectrum::Constant(0.2), Spectrum::Constant(3.9)};
  EXPECT_NEAR(MirrorReflectance(material, 1)[0],
              0.5 * ((0.8 * 0.8 + 3.9 * 3.9) / (1.2 * 1.2 + 3.9 * 3.9)), 1e-12);
  EXPECT_TRUE((MirrorReflectance({}, 1) == 0).all());
}

TEST(SunAlong, IsItsDiscAlone) {
  const MontageScene scene = MakeSmallSite().With({});
  const Vector3d sun = scene.natural.light.sun_direction;
  EXPECT_GT(SunAlong(scene, sun)[0], 0);
  EXPECT_TRUE((SunAlong(scene, (sun + Vector3d(0, 0.005, 0)).normalized()) == 0).all());
  EXPECT_TRUE((SunAlong(scene, -sun) == 0).all());
}

TEST(FindLamp, MeetsSpheresAndTheLuminousSideOfPanels) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment lamps;
  const Vector3d origin = site.natural.scene.origin;
  lamps.lights.push_back({.name = "globe",
                          .position = origin + Vector3d(0, 0, 3),
                          .intensity_rgb = Vector3d::Constant(2),
                          .radius = 0.1,
                          .is_visible = true});
  lamps.lights.push_back({.name = "panel",
                          .position = origin + Vector3d(5, 0, 3),
                          .intensity_rgb = Vector3d::Constant(2),
                          .edge_u = Vector3d::UnitX(),
                          .edge_v = -Vector3d::UnitY(),
                          .is_visible = true});
  const MontageScene scene = site.With(lamps);
  const auto red = [&](const Vector3d& from, const Vector3d& direction) {
    const auto lamp = FindLamp(scene, {from, direction});
    return lamp ? Red(scene, lamp->radiance) : 0;
  };
  EXPECT_NEAR(red({0.05, 0, 0}, Vector3d::UnitZ()), 2 / (std::numbers::pi * 0.01), 1e-9);
  EXPECT_EQ(red({0.11, 0, 0}, Vector3d::UnitZ()), 0);
  EXPECT_NEAR(red({5.4, 0.4, 0}, Vector3d::UnitZ()), 2, 1e-9);  // it shines down
  EXPECT_EQ(red({5.4, 0.4, 6}, -Vector3d::UnitZ()), 0);
  EXPECT_EQ(red({5.6, 0.4, 0}, Vector3d::UnitZ()), 0);
}

}  // namespace
}  // namespace insitu
