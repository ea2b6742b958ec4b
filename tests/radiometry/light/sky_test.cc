// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/sky.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
const Eigen::Vector3d kZenith = Eigen::Vector3d(0.01, -0.02, 1).normalized();
const Eigen::Vector3d kSun = Eigen::Vector3d(0.5, 0.6, 0.5).normalized();
const SkyShape kOvercast = {Spectrum::Ones(), Spectrum::Zero()};
const SkyShape kClear = {Spectrum::Constant(-1.2), Spectrum::LinSpaced(1.1, 0.7)};

// Directions spread evenly over the sphere (Fibonacci).
std::vector<Eigen::Vector3d> Sphere(int count) {
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - 2 * (i + 0.5) / count, r = std::sqrt(1 - z * z), turn = 2.399963 * i;
    directions.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return directions;
}

// On a surface in the open, of the sky alone.
Spectrum Irradiance(const RelativeSky& sky, const Eigen::Vector3d& normal) {
  constexpr int kCount = 200000;
  Spectrum sum = Spectrum::Zero();
  for (const Eigen::Vector3d& direction : Sphere(kCount)) {
    const double cosine = normal.dot(direction);
    if (cosine > 0 && kZenith.dot(direction) > 0) sum += cosine * sky.Towards(direction);
  }
  return sum * (4 * kPi / kCount);
}

TEST(SkyGradation, OfTheOvercastSkyIsThreeTimesAsBrightOnTop) {
  EXPECT_NEAR(std::exp(SkyGradation(1) - SkyGradation(0)), 3, 1e-12);
  EXPECT_EQ(SkyGradation(-0.5), SkyGradation(0));
}

// The CIE's figures for the indicatrix 4: f(0) = 11.36, f(90 degrees) = 1.
TEST(SkyGlow, IsTheIndicatrixOfAClearSky) {
  EXPECT_NEAR(std::exp(SkyGlow(1)), 1 + 10 * (1 - std::exp(-1.5 * kPi)) + 0.45, 1e-9);
  EXPECT_NEAR(SkyGlow(0), 0, 1e-12);
  EXPECT_GT(SkyGlow(0.9), SkyGlow(0.8));
}

TEST(RelativeSky, OfAUniformSkyIsExactlyOne) {
  EXPECT_TRUE((RelativeSky().Towards(kSun) == 1).all());
  EXPECT_TRUE((RelativeSky({}, kZenith, kSun).Towards(-kSun) == 1).all());
}

TEST(RelativeSky, LevelGroundReceivesWhatAUniformSkySends) {
  for (const SkyShape& shape : {kOvercast, kClear}) {
    const Spectrum E = Irradiance({shape, kZenith, kSun}, kZenith);
    EXPECT_LT((E / kPi - 1).abs().maxCoeff(), 0.005);
  }
}

// Of the overcast sky a wall receives (pi / 6 + 4 / 9) / (7 pi / 9) of what the ground does.
TEST(RelativeSky, AWallUnderAnOvercastSkyHasItsClosedForm) {
  const Spectrum E = Irradiance({kOvercast, kZenith, kSun}, kZenith.unitOrthogonal());
  EXPECT_NEAR(E[3] / kPi, (kPi / 6 + 4.0 / 9) / (7 * kPi / 9), 0.002);
}

TEST(SkyPieces, FollowTheSky) {
  const RelativeSky sky(kClear, kZenith, kSun);
  const SkyPieces pieces(sky, false, kZenith);
  for (const Eigen::Vector3d& direction : Sphere(2000)) {
    if (kZenith.dot(direction) <= 0 || kSun.dot(direction) > 0.98) continue;
    const Spectrum error = pieces.At(pieces.Of(direction)) / sky.Towards(direction) - 1;
    EXPECT_LT(error.abs().maxCoeff(), 0.15) << direction.transpose();
  }
}

TEST(SkyPieces, OfAUniformSkyAreOne) {
  const SkyPieces pieces({}, true, kZenith);
  EXPECT_EQ(pieces.Of(kSun), 0);
  EXPECT_TRUE((pieces.At(0) == 1).all());
}

}  // namespace
}  // namespace insitu
