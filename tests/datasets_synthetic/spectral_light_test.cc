// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/spectral_light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insitu::demo {
namespace {

Eigen::Vector2d Chromaticity(const Spectrum& spectrum) {
  const Eigen::Vector3d xyz = XyzFromSpectrum(spectrum);
  return xyz.head<2>() / xyz.sum();
}

TEST(Observer, SeesEqualEnergyAsWhite) {
  const Eigen::Vector2d white = Chromaticity(Spectrum::Ones());
  EXPECT_NEAR(white.x(), 1.0 / 3, 0.01);
  EXPECT_NEAR(white.y(), 1.0 / 3, 0.01);
  EXPECT_NEAR(XyzFromSpectrum(Spectrum::Ones()).y(), 1, 1e-12);
}

// Chromaticities of the Planckian locus, Wyszecki and Stiles 1982.
TEST(Observer, SeesBlackBodiesOnThePlanckianLocus) {
  const Eigen::Vector2d tungsten = Chromaticity(BlackBody(2856));
  EXPECT_NEAR(tungsten.x(), 0.4476, 0.006);
  EXPECT_NEAR(tungsten.y(), 0.4074, 0.006);
  const Eigen::Vector2d daylight = Chromaticity(BlackBody(6500));
  EXPECT_NEAR(daylight.x(), 0.3135, 0.006);
  EXPECT_NEAR(daylight.y(), 0.3237, 0.006);
}

TEST(Observer, PutsGreenLightIntoTheGreenChannel) {
  const Eigen::Vector3d rgb = RgbFromSpectrum(Bell(535, 8));
  EXPECT_GT(rgb.y(), 0);
  EXPECT_LT(rgb.x(), rgb.y());
  EXPECT_LT(rgb.z(), rgb.y());
}

TEST(Spectra, HaveTheirShapes) {
  EXPECT_EQ(Wavelengths()[0], 380);
  EXPECT_EQ(Wavelengths()[kBands - 1], 780);
  EXPECT_NEAR(BlackBody(5000)[(560 - 380) / 5], 1, 1e-12);
  EXPECT_NEAR(Step(580, 20)[(580 - 380) / 5], 0.5, 1e-12);
  EXPECT_NEAR(Bell(550, 30)[(550 - 380) / 5], 1, 1e-12);
  int peak = 0;  // Wien: 2.898e6 nm K / 5796 K = 500 nm
  BlackBody(5796).maxCoeff(&peak);
  EXPECT_NEAR(Wavelengths()[peak], 500, 5);
}

TEST(Haze, LeavesNearThingsAndHidesFarOnes) {
  const Daylight daylight = ClearMorning();
  const Spectrum dark = Spectrum::Constant(0.02);
  EXPECT_LT((ThroughAir(daylight, dark, 0) - dark).abs().maxCoeff(), 1e-15);
  const Spectrum horizon = ThroughAir(daylight, dark, 1e5);
  EXPECT_LT((horizon - daylight.sky_radiance).abs().maxCoeff(), 1e-12);
}

// Air of d1 seen through air of d2 is air of d1 + d2: Eq. (2) is a semigroup.
TEST(Haze, Composes) {
  const Daylight daylight = ClearMorning();
  const Spectrum wall = 0.3 * daylight.sun_irradiance;
  const Spectrum twice = ThroughAir(daylight, ThroughAir(daylight, wall, 80), 170);
  EXPECT_LT((twice - ThroughAir(daylight, wall, 250)).abs().maxCoeff(), 1e-14);
}

TEST(Haze, TransmitsRedBetterThanBlue) {
  const Daylight daylight = ClearMorning();
  const Eigen::Vector3d per_metre = EffectiveTransmittance(daylight, 100);
  EXPECT_GT(per_metre.x(), per_metre.y());
  EXPECT_GT(per_metre.y(), per_metre.z());
  EXPECT_LT(per_metre.maxCoeff(), std::exp(-daylight.extinction.minCoeff()));
  EXPECT_GT(per_metre.minCoeff(), std::exp(-daylight.extinction.maxCoeff()));
}

TEST(Reflectance, OfAGreyCardIsGrey) {
  const Eigen::Vector3d rgb = ReflectanceRgb(ClearMorning(), Spectrum::Constant(0.18));
  EXPECT_LT((rgb - Eigen::Vector3d::Constant(0.18)).norm(), 1e-12);
}

TEST(Fresnel, HasItsLimits) {
  EXPECT_NEAR(Fresnel(1, 1.8), std::pow(0.8 / 2.8, 2), 1e-12);
  EXPECT_NEAR(Fresnel(1e-9, 1.8), 1, 1e-7);
  EXPECT_NEAR(Fresnel(0.4, 1.0), 0, 1e-12);
  // At Brewster's angle only one polarisation is left: ((n^2 - 1) / (n^2 + 1))^2 / 2.
  const double n = 1.5, brewster = std::cos(std::atan(n));
  EXPECT_NEAR(Fresnel(brewster, n), 0.5 * std::pow((n * n - 1) / (n * n + 1), 2), 1e-12);
}

}  // namespace
}  // namespace insitu::demo
