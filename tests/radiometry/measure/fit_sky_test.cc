// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/fit_sky.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

namespace insitu {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const Eigen::Vector3d kZenith = Eigen::Vector3d(0.01, -0.006, 1).normalized();
const Eigen::Vector3d kSun = Eigen::Vector3d(0.6, -0.5, 0.62).normalized();
const Eigen::Vector3d kColor(0.4, 0.48, 0.57);

Eigen::Vector3d Direction(double azimuth, double height) {
  return {std::cos(height) * std::cos(azimuth), std::cos(height) * std::sin(azimuth),
          std::sin(height)};
}

// What photographs show between some heights, of a sky as bright at all wavelengths as it is spread
// at the first, with noise.
std::vector<SkyPlace> Seen(const SkyShape& shape, double lowest, double highest,
                           double noise = 0.005) {
  const RelativeSky sky(shape, kZenith, kSun);
  std::mt19937 random(3);
  std::normal_distribution<double> error(0, noise);
  std::vector<SkyPlace> places;
  for (double azimuth = 0; azimuth < 200 * kDegree; azimuth += 1.5 * kDegree) {
    for (double height = lowest * kDegree; height < highest * kDegree; height += 1.5 * kDegree) {
      const Eigen::Vector3d direction = Direction(azimuth, height);
      places.push_back({direction, kColor * (sky.Towards(direction)[0] * (1 + error(random)))});
    }
  }
  return places;
}

double Mean(const Spectrum& spectrum) { return spectrum.mean(); }

SkyShape Shape(double gradation, double glow) {
  return {Spectrum::Constant(gradation), Spectrum::Constant(glow)};
}

TEST(FitSky, AUniformSkyStaysUniform) {
  const SpectralBasis spectra;
  const SkyFit fit = FitSky(Seen({}, 2, 35), kZenith, kSun, spectra);
  EXPECT_TRUE(fit.shape.IsUniform());
  EXPECT_GT(Mean(fit.sigma.gradation), 0);
  ASSERT_TRUE(fit.level);
  EXPECT_LT((spectra.RgbFromSpectrum(*fit.level) - kColor).norm(), 0.002);
  EXPECT_NEAR(fit.highest / kDegree, 33, 3);
}

TEST(FitSky, AnOvercastSkyIsFoundFromItsLowerHalf) {
  const SpectralBasis spectra;
  const SkyFit fit = FitSky(Seen(Shape(1, 0), 2, 35), kZenith, std::nullopt, spectra);
  EXPECT_NEAR(Mean(fit.shape.gradation), 1, 0.02);
  EXPECT_TRUE((fit.shape.glow == 0).all());
  EXPECT_LT((spectra.RgbFromSpectrum(*fit.level) - kColor).norm(), 0.01);
  EXPECT_LT(std::abs(Mean(fit.shape.gradation) - 1), 4 * Mean(fit.sigma.gradation));
}

TEST(FitSky, AClearSkyIsFoundWithItsGlow) {
  const SkyFit fit = FitSky(Seen(Shape(-1.1, 0.9), 2, 40), kZenith, kSun, SpectralBasis());
  EXPECT_NEAR(Mean(fit.shape.gradation), -1.1, 0.05);
  EXPECT_NEAR(Mean(fit.shape.glow), 0.9, 0.05);
}

// Told beyond doubt, but it changes what is seen by 2 %: lenses do as much.
TEST(FitSky, AGradationThatHardlyShowsIsNotBelieved) {
  const SkyFit fit =
      FitSky(Seen(Shape(0.03, 0), 2, 35, 0.001), kZenith, std::nullopt, SpectralBasis());
  EXPECT_LT(3 * Mean(fit.sigma.gradation), 0.03);
  EXPECT_TRUE(fit.shape.IsUniform());
}

// The level for level ground is told as well as the shape tells what is not seen.
TEST(FitSky, TheLevelIsLessCertainTheLessIsSeen) {
  const auto relative_sigma = [](const std::vector<SkyPlace>& places, bool has_sun) {
    const auto sun = has_sun ? std::optional(kSun) : std::nullopt;
    const SkyFit fit = FitSky(places, kZenith, sun, SpectralBasis());
    return Mean(fit.level_sigma / *fit.level);
  };
  const double half = relative_sigma(Seen(Shape(1, 0), 2, 45), false);
  const double even = relative_sigma(Seen(Shape(0, 0), 2, 45), false);
  EXPECT_GT(even, 0.03);
  EXPECT_LT(even, 0.04);
  EXPECT_GT(half, 1.5 * even);  // whose shape carries it far from what is seen
  const double strip = relative_sigma(Seen(Shape(0.3, 0), 3, 6, 0.02), false);
  EXPECT_GT(strip, 2 * even);
  EXPECT_GT(relative_sigma(Seen(Shape(0.3, 0), 3, 6, 0.02), true), strip);      // its glow, too
  EXPECT_GT(relative_sigma(Seen(Shape(1, 0), 2, 45, 0.3), false), 1.2 * half);  // clouds
}

// Sky that is blue on top and white at the horizon.
TEST(FitSky, EachWavelengthHasItsOwn) {
  const RelativeSky red(Shape(-1.2, 0), kZenith, kSun), blue(Shape(-0.4, 0), kZenith, kSun);
  std::vector<SkyPlace> places = Seen({}, 2, 40, 0);
  for (SkyPlace& place : places) {
    place.rgb[0] *= red.Towards(place.direction)[0];
    place.rgb[2] *= blue.Towards(place.direction)[0];
  }
  const SkyFit fit = FitSky(places, kZenith, std::nullopt, SpectralBasis());
  EXPECT_LT(fit.shape.gradation[kMaxBins - 2], -1);
  EXPECT_GT(fit.shape.gradation[2], -0.7);
}

// A hill that passes for sky, darker, in a tenth of the places.
TEST(FitSky, WhatContradictsTheRestCountsLess) {
  std::vector<SkyPlace> places = Seen(Shape(1, 0), 2, 35);
  for (SkyPlace& place : places) {
    if (place.direction.z() < 0.12 && place.direction.x() > 0.4) place.rgb *= 0.6;
  }
  const SkyFit fit = FitSky(places, kZenith, std::nullopt, SpectralBasis());
  EXPECT_NEAR(Mean(fit.shape.gradation), 1, 0.1);
}

TEST(FitSky, ANarrowStripTellsNoShape) {
  const SkyFit fit =
      FitSky(Seen(Shape(0.3, 0), 3, 6, 0.02), kZenith, std::nullopt, SpectralBasis());
  EXPECT_TRUE(fit.shape.IsUniform());
  EXPECT_TRUE(fit.level);
}

TEST(FitSky, NothingSeenIsUniformWithoutALevel) {
  const SkyFit fit = FitSky({}, kZenith, kSun, SpectralBasis());
  EXPECT_TRUE(fit.shape.IsUniform());
  EXPECT_FALSE(fit.level);
  EXPECT_EQ(fit.cells, 0);
}

TEST(FitSky, NoSkyIsSteeperThanTheStandardOnes) {
  const SkyFit fit = FitSky(Seen(Shape(-2.5, 0), 2, 35), kZenith, std::nullopt, SpectralBasis());
  EXPECT_TRUE((fit.shape.gradation == -1.7).all());
}

}  // namespace
}  // namespace insitu
