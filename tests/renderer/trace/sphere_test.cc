// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres stay spheres: what a mesh of facets could not give.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiometry/light/fresnel.h"
#include "renderer/trace/glass.h"
#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/scene_hit.h"
#include "renderer/trace/through_glass.h"
#include "renderer/trace/trace.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

const Vector3d kCenter(0.3, -2, 3);
constexpr double kRadius = 1.25;

ArtificialEnvironment Ball(const SmallSite& site, const SurfaceMaterial& material) {
  ArtificialEnvironment ball;
  ball.materials = {material};
  ball.spheres = {{site.natural.scene.origin + kCenter, kRadius, 0}};
  return ball;
}

SurfaceMaterial Grey(double albedo) {
  return {"grey", Vector3d::Constant(albedo), 1, std::nullopt};
}

SurfaceMaterial Crystal(double index, double absorption) {
  SurfaceMaterial crystal{"crystal", Vector3d::Zero(), 0, Specular{1, index}};
  crystal.glass =
      Glass{.is_solid = true, .index = index, .absorption_rgb = Vector3d::Constant(absorption)};
  return crystal;
}

LightDirections Along(const MontageScene& scene) {
  return {scene.natural.light.sun_direction, 0, 1};
}

// In the plane of a ray and the middle: all angles are of one triangle, i at the face, t within.
TEST(GlassBall, RefractsAsItsClosedForm) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Ball(site, Crystal(1.5, 0)));
  for (const double sine : {0.0, 0.31, 0.74, 0.97}) {
    const Ray ray = {kCenter + Vector3d(-4, sine * kRadius, 0), Vector3d::UnitX()};
    const auto hit = FindHit(scene, ray, World::kWithBuilding);
    ASSERT_TRUE(hit && hit->is_building);
    std::vector<Ray> left;  // mirrored, then through, then by a reflection within ...
    const auto trace = [&](const Ray& out, const LightDirections&) {
      left.push_back(out);
      return Spectrum::Ones().eval();
    };
    GlassColor(
        scene, *hit, scene.MaterialOfTriangle(hit->index), ray, Along(scene), 0,
        [] { return Spectrum::Zero().eval(); }, trace);
    ASSERT_GE(left.size(), 2u);
    const double i = std::asin(sine), t = std::asin(sine / 1.5);
    const double mirrored = std::numbers::pi - 2 * i, bent = 2 * (i - t);  // turns
    EXPECT_LT((left[0].direction - Vector3d(std::cos(mirrored), std::sin(mirrored), 0)).norm(),
              1e-9);
    // A tenth of a millimetre off the faces is all that is missing.
    EXPECT_LT((left[1].direction - Vector3d(std::cos(bent), -std::sin(bent), 0)).norm(), 3e-4);
    const Vector3d out(std::cos(i - bent), std::sin(i - bent), 0);  // the way in turned by pi - 2 t
    EXPECT_LT((left[1].origin - kCenter - kRadius * out).norm(), 1e-3);
  }
}

TEST(GlassBall, AbsorbsAlongTheChord) {
  SmallSite site = MakeSmallSite();
  site.natural.air.horizon =
      site.natural.spectra.SpectrumFromRgb(Vector3d::Constant(kLawnRadiance));
  site.natural.light.sun_radiance.setZero();
  const MontageScene scene = site.With(Ball(site, Crystal(1.5, 0.4)));
  const Vector3d eye = kCenter + Vector3d(0, -6, 0);
  for (const double sine : {0.1, 0.6, 0.95}) {
    const double to_rim = std::asin(sine * kRadius / 6);
    const PrimaryRay primary = {{eye, Vector3d(std::sin(to_rim), std::cos(to_rim), 0)},
                                Vector3d::Constant(kLawnRadiance),
                                Along(scene)};
    const double cosine = std::sqrt(1 - sine * sine);
    const double F = FresnelReflectance(cosine, 1.5);
    const double a = std::exp(-0.4 * 2 * kRadius * RefractedCosine(cosine, 1.5));
    // Every face within is met at the same angle.
    const double expected = F + (1 - F) * (1 - F) * a / (1 - F * a);
    EXPECT_NEAR(TracePrimary(scene, primary).rgb.x() / kLawnRadiance, expected, 0.01);
  }
}

TEST(GlassBall, LetsLightThroughItsChord) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Ball(site, Crystal(1.5, 0.4)));
  const double cosine = std::sqrt(1 - 0.36), F = FresnelReflectance(cosine, 1.5);
  const double way = 2 * kRadius * cosine * cosine / RefractedCosine(cosine, 1.5);
  const Ray ray = {kCenter + Vector3d(-4, 0.6 * kRadius, 0), Vector3d::UnitX()};
  EXPECT_NEAR(TransmittanceAlong(scene, ray)[2], (1 - F) * (1 - F) * std::exp(-0.4 * way), 1e-4);
}

// The sky's shape tells in which direction a mirror ball looks.
TEST(MirrorBall, ReflectsTowardsTheClosedFormDirection) {
  SmallSite site = MakeSmallSite();
  site.natural.light.sky_shape.gradation.setOnes();
  site.natural.light.photographed_sky = 0.7 * site.natural.air.horizon;
  site.natural.light.sun_radiance.setZero();
  const MontageScene scene =
      site.With(Ball(site, {"mirror", Vector3d::Zero(), 1, Specular{1, std::nullopt}}));
  for (const double latitude : {0.4, 0.55, 0.63, 0.9}) {
    const Vector3d normal(0, -std::cos(latitude), std::sin(latitude));
    const Vector3d eye = kCenter + Vector3d(0, -7, 0.5);
    const Vector3d way = (kCenter + kRadius * normal - eye).normalized();
    const PrimaryRay primary = {{eye, way}, Vector3d::Zero(), Along(scene)};
    const Vector3d mirrored = way - 2 * way.dot(normal) * normal;
    ASSERT_GT(mirrored.z(), 0.05);
    const Spectrum sky = TraceSecondary(scene, {kCenter + 2 * kRadius * normal, mirrored},
                                        Along(scene), World::kWithBuilding, 1);
    const double expected = scene.natural.spectra.RgbFromSpectrum(sky).x();
    EXPECT_NEAR(TracePrimary(scene, primary).rgb.x(), expected, 1e-6);
  }
}

// The sun 45 degrees up in the east.
TEST(BallShadow, EndsWhereTheSunGrazesTheBall) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Ball(site, Grey(0.5)));
  const Vector3d sun = scene.natural.light.sun_direction;
  const Vector3d across = sun.cross(Vector3d::UnitY());
  for (int degrees = 0; degrees < 360; degrees += 7) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vector3d out = std::cos(angle) * Vector3d::UnitY() + std::sin(angle) * across;
    for (const double off : {-1e-4, 1e-4}) {
      const Vector3d rim = kCenter + (kRadius + off) * out;
      const Vector3d start = rim - (rim.z() - kSurveyClearance) / sun.z() * sun;
      const SurfacePoint lawn = {start - kSurveyClearance * Vector3d::UnitZ(), Vector3d::UnitZ()};
      EXPECT_EQ(SplitSunlight(scene, lawn, Along(scene), true).is_blocked, off < 0) << degrees;
    }
  }
}

// All around is alike: wherever a ball is looked at, it receives the same, and nothing of itself.
TEST(BallIrradiance, IsThatOfAllAround) {
  SmallSite site = MakeSmallSite();
  const Spectrum around = site.natural.spectra.SpectrumFromRgb(Vector3d::Constant(kLawnRadiance));
  site.natural.air.horizon = site.natural.light.sky_radiance = around;
  site.natural.light.ambient_radiance.setZero();
  site.natural.light.sun_radiance.setZero();
  MontageScene scene = site.With(Ball(site, Grey(0)));
  AddInterreflection(&scene, std::nullopt);
  for (int i = 0; i < 30; ++i) {
    const double z = 0.95 - 0.04 * i, angle = 2.4 * i;  // what is lower sees the ball's shadow
    const Vector3d normal(std::sqrt(1 - z * z) * std::cos(angle),
                          std::sqrt(1 - z * z) * std::sin(angle), z);
    const auto hit =
        FindHit(scene, {kCenter + 2 * kRadius * normal, -normal}, World::kWithBuilding);
    ASSERT_TRUE(hit && hit->is_building);
    const SmoothLight light = *LightAround(scene, *hit);
    EXPECT_NEAR((light.before + light.change)[3] / (std::numbers::pi * around[3]), 1, 0.04) << z;
  }
}

// The sky above, the lawn below: smooth over the edges of the facets that carry it.
TEST(BallIrradiance, GoesWithTheExactNormal) {
  SmallSite site = MakeSmallSite();
  const Spectrum white = site.natural.spectra.SpectrumFromRgb(Vector3d::Ones());
  site.natural.light.sky_radiance = white;
  site.natural.light.ambient_radiance.setZero();
  site.natural.light.sun_radiance.setZero();
  MontageScene scene = site.With(Ball(site, Grey(0)));
  AddInterreflection(&scene, 0);
  for (int i = 0; i < 200; ++i) {
    const double z = 0.005 * i - 0.2;
    const Vector3d normal(0.6 * std::sqrt(1 - z * z), 0.8 * std::sqrt(1 - z * z), z);
    const auto hit =
        FindHit(scene, {kCenter + 2 * kRadius * normal, -normal}, World::kWithBuilding);
    const SmoothLight light = *LightAround(scene, *hit);
    const double sky = (light.before + light.change)[3] / (std::numbers::pi * white[3]);
    EXPECT_NEAR(sky, (1 + z) / 2, 0.012) << z;
  }
}

}  // namespace
}  // namespace insitu
