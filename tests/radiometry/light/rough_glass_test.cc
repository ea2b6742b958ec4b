// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/rough_glass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "calibration/files/error.h"

namespace insitu {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr int kSide = 128;  // of facets, squared
const Roughness kGlass[] = {
    {0.02, FacetDistribution::kGgx},     {0.2, FacetDistribution::kGgx},
    {0.6, FacetDistribution::kGgx},      {1, FacetDistribution::kGgx},
    {0.1, FacetDistribution::kBeckmann}, {0.5, FacetDistribution::kBeckmann},
    {1, FacetDistribution::kBeckmann}};

Vector3d At(double cosine, double angle) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

template <typename Function>
double MeanOverFacets(const Function& function) {
  double sum = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int column = i % kSide, row = i / kSide;
    sum += function(Vector2d((column + 0.5) / kSide, (row + 0.5) / kSide));
  }
  return sum / (kSide * kSide);
}

TEST(RoughInterface, WhiteFurnaceKeepsAllLightAtEveryRoughness) {
  for (const Roughness& rough : kGlass) {
    for (const double index : {1.5, 1 / 1.5, 1.1, 2.4}) {
      const RoughInterface face(rough, index);
      for (const double cosine : {0.08, 0.23, 0.61, 0.97, 1.0}) {
        const double all = MeanOverFacets([&](const Vector2d& uniform) {
          const GlassFacet facet = face.Choose(At(cosine, 0.4), uniform);
          return facet.mirrors + facet.lets_through;
        });
        EXPECT_NEAR(all, 1, 0.01) << rough.slope << " n " << index << " at " << cosine;
      }
    }
  }
  EXPECT_THROW(RoughInterface({0}, 1.5), CheckError);
}

TEST(RoughInterface, RefractsAsSnellSaysWhereItIsNearlySmooth) {
  const RoughInterface face({1e-3}, 1.5);
  const Vector3d view = At(0.5, 0);
  const GlassFacet facet = face.Choose(view, {0.2, 0.3});
  EXPECT_NEAR(facet.refracted.x(), -view.x() / 1.5, 3e-3);
  EXPECT_NEAR(facet.lets_through, 1 - FresnelReflectance(0.5, 1.5), 3e-3);
  const RoughInterface from_inside({1e-3}, 1 / 1.5);
  EXPECT_NEAR(from_inside.Choose(view, {0.2, 0.3}).mirrors, 1, 3e-3);  // totally reflected
}

// What Choose draws is the integral of Lobe over all directions, of a radiance that varies.
TEST(RoughInterface, DrawsWhatTheLobeSays) {
  const auto radiance = [](const Vector3d& w) { return 1 + 0.8 * w.x() + 0.5 * w.z(); };
  for (const Roughness& rough : {kGlass[1], kGlass[3], kGlass[5]}) {
    for (const double index : {1.5, 1 / 1.5}) {
      const RoughInterface face(rough, index);
      const Vector3d view = At(0.7, 0.9);
      double by_lobe = 0;
      constexpr int kCosines = 1200, kAngles = 600;
      for (int i = 0; i < kCosines; ++i) {
        const double z = -1 + 2 * (i + 0.5) / kCosines;
        for (int j = 0; j < kAngles; ++j) {
          const double a = 2 * kPi * (j + 0.5) / kAngles, s = std::sqrt(1 - z * z);
          const Vector3d to_light(s * std::cos(a), s * std::sin(a), z);
          by_lobe += face.Lobe(view, to_light) * radiance(to_light);
        }
      }
      by_lobe *= 4 * kPi / (kCosines * kAngles);
      const double drawn = MeanOverFacets([&](const Vector2d& uniform) {
        const GlassFacet facet = face.Choose(view, uniform);
        double sum = 0;
        if (facet.mirrors > 0) sum += facet.mirrors * radiance(facet.mirrored);
        if (facet.lets_through > 0) sum += facet.lets_through * radiance(facet.refracted);
        return sum;
      });
      EXPECT_NEAR(by_lobe, drawn, 0.01) << rough.slope << " n " << index;
    }
  }
}

TEST(RoughSheet, IsTheSmoothPaneWhereItIsNearlySmooth) {
  Spectrum absorption = Spectrum::Constant(20);
  absorption[1] = 200;
  const RoughSheet sheet({0.005}, 1.52, absorption, 0.01);
  for (const double cosine : {0.3, 0.6, 1.0}) {
    const SheetOptics rough = sheet.Optics(cosine);
    const SheetOptics smooth = ThinSheet(cosine, 1.52, absorption, 0.01);
    EXPECT_TRUE(((rough.transmittance - smooth.transmittance).abs() < 0.01).all()) << cosine;
    EXPECT_TRUE(((rough.reflectance - smooth.reflectance).abs() < 0.01).all()) << cosine;
  }
}

TEST(RoughSheet, WhiteFurnaceKeepsAllLightAtEveryRoughness) {
  for (const Roughness& rough : kGlass) {
    const RoughSheet sheet(rough, 1.5, Spectrum::Zero(), 0.01);
    for (const double cosine : {0.1, 0.5, 1.0}) {
      const SheetOptics optics = sheet.Optics(cosine);
      EXPECT_NEAR((optics.transmittance + optics.reflectance)[0], 1, 0.01)
          << rough.slope << " at " << cosine;
    }
  }
}

// Straight sight through it is spread by both its faces: as wide as Snell has it for small slopes.
TEST(RoughSheet, SpreadsSightByItsSlopes) {
  const double m = 0.1, n = 1.5;
  const RoughSheet sheet({m, FacetDistribution::kBeckmann}, n, Spectrum::Zero(), 0.01);
  double variance = 0, weight = 0;
  PathNumbers numbers{7};
  for (int i = 0; i < 40000; ++i) {
    const double u = numbers.Next(), v = numbers.Next();
    const GlassFacet facet = sheet.from_outside().Choose(Vector3d::UnitZ(), {u, v});
    if (facet.lets_through <= 0) continue;
    const RoughSheet::Origin origin = sheet.Follow(facet.refracted, &numbers);
    if (origin.direction.z() > -0.5) continue;
    const double share = facet.lets_through * origin.share[0];
    variance += share * origin.direction.head<2>().squaredNorm();
    weight += share;
  }
  // Each face turns the ray in air by (n - 1) times its slope, whose variance is m^2.
  EXPECT_NEAR(std::sqrt(variance / weight), std::sqrt(2) * (n - 1) * m, 0.05 * m);
}

}  // namespace
}  // namespace insitu
